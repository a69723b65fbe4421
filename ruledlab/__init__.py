"""Learn and design ruled surfaces: dual numbers, Study's map and live invariants.

The public names of `ruledlab.geometry`; widgets live in `ruledlab.lab` and are not imported here.
"""

from __future__ import annotations

from .geometry import *  # noqa: F403
from .geometry import __all__ as _geometry_names

__version__ = "0.1.0"
__all__ = [*_geometry_names, "__version__"]
