"""B-spline curves in the (u, v) chart: local control, smooth seams."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import interpolate

from .checks import Array, GeometryError, finite_array, frozen, positive_integer
from .series import Series

__all__ = ["BSpline"]

MAX_POINTS = 1000


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class BSpline:
    """A B-spline curve with uniform knots in the (u, v) chart, or a batch of them.

    b(t) = Σ Nᵢ(t) pᵢ over [0, 1]. Moving one control point changes the curve over at most
    degree + 1 spans. An open curve starts in the first point and ends in the last (clamped knots);
    a closed one is periodic and its seam is as smooth as every other joint, C^(degree−1).

    Parameters
    ----------
    points
        control points (u, v) in radians, shape (n, 2); leading axes are a batch. A closed curve
        does not repeat its first point.
    degree
        degree of the pieces, at least 1 and, for an open curve, at most n − 1.
    closed
        whether the curve is periodic.
    winding
        for a closed curve, how many turns of 2π in u it makes: after one period
        u has grown by 2π·winding.

    Raises
    ------
    GeometryError
        if the points are not finite, too few for the degree, or winding is given for an open curve.

    Notes
    -----
    Any real t is accepted: a closed curve repeats itself, an open one continues its end pieces.
    """

    points: Array
    degree: int = 3
    closed: bool = False
    winding: int = 0
    _spline: Any = field(init=False)

    def __post_init__(self) -> None:
        points = _checked(self.points, self.degree, bool(self.closed))
        if self.winding and not self.closed:
            raise GeometryError("`winding` must be 0 for an open curve; set closed=True")
        object.__setattr__(self, "points", frozen(points))
        object.__setattr__(self, "_spline", _spline(points, self.degree, self.closed, self.winding))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.points, self.degree, self.closed, self.winding)

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        batch = f", batch_shape={self.batch_shape}" if self.batch_shape else ""
        return f"BSpline({self.points.shape[-2]} points, degree={self.degree}, {kind}{batch})"

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of the batch of curves; () for a single curve."""
        return self.points.shape[:-2]

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t."""
        return (0.0, 1.0)

    @property
    def scale(self) -> float | Array:
        """A bound of ‖b′‖ on [0, 1]: the largest control point of the derivative."""
        rate = self._spline.derivative().c
        size = np.linalg.norm(rate, axis=-1).max(axis=0)
        return float(size) if size.ndim == 0 else np.asarray(size)

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return the points b(t), shape (*batch_shape, *t.shape, 2)."""
        return self.derivative(t, 0)

    def derivative(self, t: npt.ArrayLike, k: int = 1) -> Array:
        """Return b⁽ᵏ⁾(t) for k ≥ 0; at a knot, the limit from the right."""
        return np.asarray(np.moveaxis(self._rows(finite_array(t, "t"), k), 0, -1))

    def series(self, t: npt.ArrayLike, order: int) -> Series:
        """Return u and v as a Series whose values have shape (2, *batch_shape, *t.shape)."""
        places = finite_array(t, "t")
        rows = [self._rows(places, k) / math.factorial(k) for k in range(order + 1)]
        return Series(np.stack(rows))

    def _rows(self, t: Array, k: int) -> Array:
        turns = np.floor(t) if self.closed else np.zeros_like(t)
        if self.closed:
            turns = np.where(t == 1.0, 0.0, turns)  # the seam itself: winding is kept
        values = self._spline(t - turns, nu=k)
        rows = np.moveaxis(values, range(t.ndim), range(values.ndim - 1 - t.ndim, values.ndim - 1))
        rows = np.moveaxis(rows, -1, 0).copy()
        if k == 0:
            rows[0] += 2.0 * np.pi * self.winding * turns
        return np.asarray(rows)


def _checked(points: npt.ArrayLike, degree: int, closed: bool) -> Array:
    degree = positive_integer(degree, "degree", 30)
    array = finite_array(points, "points")
    least = 3 if closed else degree + 1
    if array.ndim < 2 or array.shape[-1] != 2 or not least <= array.shape[-2] <= MAX_POINTS:
        raise GeometryError(
            f"`points` must have shape (n, 2) with {least} ≤ n ≤ {MAX_POINTS} for a "
            f"{'closed' if closed else 'open'} B-spline of degree {degree}; got {array.shape}; "
            "give more points or a lower degree"
        )
    return array


def _spline(points: Array, degree: int, closed: bool, winding: int) -> Any:
    """Return SciPy's spline over [0, 1], its control points along the first axis."""
    control = np.moveaxis(points, -2, 0)
    count = len(control)
    if closed:
        knots = (np.arange(count + 2 * degree + 1) - degree) / count
        index = np.arange(count + degree)
        control = control[index % count].copy()
        control[..., 0] += (2.0 * np.pi * winding * (index // count)).reshape(
            -1, *(1,) * (control.ndim - 2)
        )
        return interpolate.BSpline(knots, control, degree, extrapolate=True)
    inner = np.linspace(0.0, 1.0, count - degree + 1)
    knots = np.concatenate([np.zeros(degree), inner, np.ones(degree)])
    return interpolate.BSpline(knots, control, degree, extrapolate=True)
