"""What may come in: the one error type, the named tolerances and the argument checks."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["Array", "GeometryError", "finite_array", "frozen", "positive_integer"]

Array = npt.NDArray[np.floating[Any]]

CYLINDRICAL = 1e-10
"""κ below this fraction of the curve's own speed scale counts as zero: a cylindrical ruling."""

POLE = 1e-12
"""|sin v| below this counts as a pole of the chart."""

STILL = 1e-11
"""Striction speed below this fraction of the terms it is made of counts as zero."""

TORSAL = 1e-13
"""|κ̄| below this fraction of ‖x̄′‖ + κ‖x̄‖ is rounding and becomes 0: a torsal ruling."""

FLAT = 1e-12
"""|τ| below this fraction of κ counts as zero: the spherical image follows a great circle."""

CLOSING = 1e-9
"""A gap below this fraction of the size of what is compared counts as closed."""

UNIT = 1e-9
"""How far a dual vector may be from unit length, or a moment from being normal to its line."""

PARALLEL = 1e-12
"""Sine of the angle below which two lines count as parallel."""


class GeometryError(ValueError):
    """Input that has no geometric meaning; the text says which, why, and what to do instead."""


def frozen(array: npt.ArrayLike) -> Array:
    """Return a read-only float64 copy."""
    copy = np.array(array, dtype=np.float64)
    copy.flags.writeable = False
    return copy


def finite_array(value: npt.ArrayLike, name: str) -> Array:
    """Return ``value`` as a float64 array, refusing what is not made of finite real numbers."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError
        array = array.astype(np.float64, copy=False)
    except (TypeError, ValueError, OverflowError):
        raise GeometryError(
            f"`{name}` must be made of real numbers; got {_short(value)}; "
            "give numbers or an array of numbers"
        ) from None
    if not np.isfinite(array).all():
        raise GeometryError(
            f"`{name}` must be finite; got NaN or infinity; remove or replace these entries"
        )
    return array


def positive_integer(value: Any, name: str, most: int) -> int:
    """Return ``value`` as an int between 1 and ``most``."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise GeometryError(f"`{name}` must be a whole number; got {_short(value)}")
    if not 1 <= value <= most:
        raise GeometryError(f"`{name}` must lie between 1 and {most}; got {value}")
    return int(value)


def _short(value: object) -> str:
    text = repr(value).replace("\n", " ")
    return text if len(text) <= 60 else text[:57] + "..."
