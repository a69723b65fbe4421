"""The shared computation module: dual numbers, lines, curves, ruled surfaces and invariants.

Everything else in the package, lessons, lab, tests and exports, asks this module. It needs numpy
and scipy only.
"""

from __future__ import annotations

from .bspline import BSpline
from .checks import GeometryError
from .choices import CHOICES, Choice
from .closed import ArcLengths, Closure
from .congruence import Congruence, Focal
from .curve import Bezier
from .developable import Developable, developable_from_ubar, tangent_developable
from .dual import Dual, cross, inner, norm, normalize
from .field import Field, field, named_number, number
from .formula import FormulaError
from .function import Function, Lifted, function
from .line import CommonPerpendicular, Line, common_perpendicular, dual_angle, relation
from .motion import FrameEquations, Screw, StrictionLength, frame_equations, screw
from .series import Series
from .special import SpecialRulings, special_rulings
from .steps import Stepped, stepped
from .surface import Curvature, FundamentalForms, Invariants, RuledSurface, Undefined
from .tangent import TangentPlanes, tangent_planes
from .turn import (
    Enclosed,
    Trajectory,
    Turning,
    carried,
    enclosed,
    steiner,
    steiner_angle,
    trajectory,
    turning,
    winding_numbers,
)
from .vector import Vector, vector

__all__ = [
    "CHOICES",
    "ArcLengths",
    "BSpline",
    "Bezier",
    "Choice",
    "Closure",
    "CommonPerpendicular",
    "Congruence",
    "Curvature",
    "Developable",
    "Dual",
    "Enclosed",
    "Field",
    "Focal",
    "FormulaError",
    "FrameEquations",
    "Function",
    "FundamentalForms",
    "GeometryError",
    "Invariants",
    "Lifted",
    "Line",
    "RuledSurface",
    "Screw",
    "Series",
    "SpecialRulings",
    "Stepped",
    "StrictionLength",
    "TangentPlanes",
    "Trajectory",
    "Turning",
    "Undefined",
    "Vector",
    "carried",
    "common_perpendicular",
    "cross",
    "developable_from_ubar",
    "dual_angle",
    "enclosed",
    "field",
    "frame_equations",
    "function",
    "inner",
    "named_number",
    "norm",
    "normalize",
    "number",
    "relation",
    "screw",
    "special_rulings",
    "steiner",
    "steiner_angle",
    "stepped",
    "tangent_developable",
    "tangent_planes",
    "trajectory",
    "turning",
    "vector",
    "winding_numbers",
]
