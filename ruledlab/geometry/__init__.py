"""The shared computation module: dual numbers, lines, curves, ruled surfaces and invariants.

Everything else in the package, lessons, lab, tests and exports, asks this module. It needs numpy
and scipy only.
"""

from __future__ import annotations

from .bspline import BSpline
from .checks import GeometryError
from .closed import ArcLengths, Closure
from .curve import Bezier
from .dual import Dual, cross, inner, norm, normalize
from .field import CHOICES, Choice, Field, FormulaError, field, named_number, number
from .line import CommonPerpendicular, Line, common_perpendicular, dual_angle, relation
from .series import Series
from .surface import Curvature, FundamentalForms, Invariants, RuledSurface, Undefined

__all__ = [
    "CHOICES",
    "ArcLengths",
    "BSpline",
    "Bezier",
    "Choice",
    "Closure",
    "CommonPerpendicular",
    "Curvature",
    "Dual",
    "Field",
    "FormulaError",
    "FundamentalForms",
    "GeometryError",
    "Invariants",
    "Line",
    "RuledSurface",
    "Series",
    "Undefined",
    "common_perpendicular",
    "cross",
    "dual_angle",
    "field",
    "inner",
    "named_number",
    "norm",
    "normalize",
    "number",
    "relation",
]
