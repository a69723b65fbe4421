"""Special rulings found by root finding: torsal and cylindrical ones, and stretches of them.

κκ̄ = ⟨x′, x̄′⟩ and κ² = ⟨x′, x′⟩ are smooth even where κ = 0, and so are their derivatives. Between
two neighbouring zeros of its derivative a function is monotone and has at most one zero, so the
zeros of κκ̄ are bracketed by those of its derivative, these by those of the second one. A double
zero is a zero of the derivative at which the function is 0 too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from .checks import CYLINDRICAL, Array, frozen
from .closed import MovingLine
from .jet import Jet, dot
from .quadrature import bracketed_zero

__all__ = ["SpecialRulings", "special_rulings"]

CELLS = 512
"""Cells of the grid that separates the zeros of the second derivative."""

STRETCH = 8
"""Cells in a row on which a function must be 0 to rounding to count as 0 throughout."""

TOUCH = 1e-11
"""|κκ̄| below this fraction of the terms it is made of counts as 0 at an extremum."""

Flags = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False, slots=True)
class SpecialRulings:
    """Rulings along which the surface has no skew tangent plane, and why.

    Attributes
    ----------
    torsal
        (N,) the t of single rulings with κ̄ = δ = 0 and κ ≠ 0, in order: there the tangent plane
        is the same along the ruling.
    touching
        (N,) True where κ̄ does not change sign there: a double zero.
    developable
        (M, 2) first and last t of stretches with κ̄ ≡ 0 and κ ≠ 0: cones or tangents of a curve.
    cylindrical
        (K,) the t of single rulings with κ = 0, which keep their direction for a moment.
    cylinders
        (L, 2) first and last t of stretches with κ ≡ 0: cylinders.
    """

    torsal: Array
    touching: Flags
    developable: Array
    cylindrical: Array
    cylinders: Array


@dataclass(frozen=True, eq=False, slots=True)
class _Zeros:
    places: Array
    touching: Flags
    stretches: Array


def special_rulings(moving: MovingLine) -> SpecialRulings:
    """Return the torsal and the cylindrical rulings of one surface.

    Zeros are exact to rounding: single ones to about 1e-15 of the domain, double ones to 1e-12 or
    so. Extrema of κκ̄ that lie pairwise within one 512th of the domain may escape, and a zero of
    order 6 or more counts as a short stretch. Where the line is undefined nothing is reported.
    """
    start, end = moving.domain
    turning = _zeros(_of(moving, _square), _of(moving, _resting), start, end)
    twisting = _zeros(_of(moving, _product), _of(moving, _rounding), start, end)
    near = 1e-6 * (end - start)
    free = _apart(twisting.places, turning.places, turning.stretches, near)
    stretches = twisting.stretches
    middles = stretches.mean(axis=1)
    skew = _apart(middles, np.empty(0), turning.stretches, near)
    return SpecialRulings(
        frozen(twisting.places[free]),
        twisting.touching[free],
        frozen(stretches[skew]),
        frozen(turning.places),
        frozen(turning.stretches),
    )


def _of(moving: MovingLine, part: Callable[[Jet], Array]) -> Callable[[Array], Array]:
    def function(t: Array) -> Array:
        with np.errstate(all="ignore"):
            return part(moving.jet(t, 4))

    return function


def _derivatives(a: Array, b: Array) -> Array:
    """Return ⟨a, b⟩ and three derivatives from rows of derivatives, by Leibniz' rule."""
    return np.stack(
        [
            dot(a[0], b[0]),
            dot(a[1], b[0]) + dot(a[0], b[1]),
            dot(a[2], b[0]) + 2.0 * dot(a[1], b[1]) + dot(a[0], b[2]),
            dot(a[3], b[0]) + 3.0 * (dot(a[2], b[1]) + dot(a[1], b[2])) + dot(a[0], b[3]),
        ]
    )


def _square(jet: Jet) -> Array:
    x = jet.direction[1:]
    return _derivatives(x, x)


def _product(jet: Jet) -> Array:
    return _derivatives(jet.direction[1:], jet.moment[1:])


def _resting(jet: Jet) -> Array:
    scale = np.asarray(jet.scale, dtype=np.float64)
    return np.broadcast_to((CYLINDRICAL * scale) ** 2, jet.rows.shape[3:])


def _rounding(jet: Jet) -> Array:
    lengths = np.linalg.norm(jet.rows[:2], axis=2)
    kappa = lengths[1, 0]
    return np.asarray(TOUCH * kappa * (lengths[1, 1] + kappa * lengths[0, 1]))


def _apart(t: Array, places: Array, stretches: Array, near: float) -> Flags:
    """Say which t lie neither near one of the places nor in one of the stretches."""
    at_place = (np.abs(t[:, np.newaxis] - places) <= near).any(axis=1)
    first, last = stretches[:, 0] - near, stretches[:, 1] + near
    inside = ((t[:, np.newaxis] >= first) & (t[:, np.newaxis] <= last)).any(axis=1)
    return np.asarray(~(at_place | inside))


def _zeros(
    levels: Callable[[Array], Array], allowed: Callable[[Array], Array], start: float, end: float
) -> _Zeros:
    """Return the zeros of a function given with three derivatives.

    ``allowed(t)`` is what counts as 0 for the function itself.
    """
    grid = np.linspace(start, end, CELLS + 1)
    close = 1e-12 * (end - start)
    points = grid
    for level in (2, 1):
        points = np.union1d(grid, _crossings(levels, level, points, close))
    values = levels(points)[0]
    points, values = points[np.isfinite(values)], values[np.isfinite(values)]
    signs = np.where(np.abs(values) <= allowed(points), 0.0, np.sign(values))
    return _collected(levels, allowed, points, signs, STRETCH * (end - start) / CELLS)


def _crossings(levels: Callable[[Array], Array], level: int, points: Array, close: float) -> Array:
    """Return a zero of a derivative in each cell at whose ends its signs differ."""
    values = levels(points)[level]
    turns = np.flatnonzero(values[:-1] * values[1:] < 0.0)

    def function(t: Array) -> tuple[Array, Array]:
        rows = levels(t)
        return rows[level], rows[level + 1]

    return bracketed_zero(function, points[turns], points[turns + 1], close)


def _collected(
    levels: Callable[[Array], Array],
    allowed: Callable[[Array], Array],
    points: Array,
    signs: Array,
    long: float,
) -> _Zeros:
    """Read zeros and stretches off the signs: between two firm signs there is one zero or none."""
    places: list[float] = []
    touching: list[bool] = []
    stretches: list[tuple[float, float]] = []
    firm = np.flatnonzero(signs)
    for i, j in pairwise([-1, *firm.tolist(), signs.size]):
        inside = points[i + 1 : j]
        at_end = i < 0 or j == signs.size
        if inside.size and inside[-1] - inside[0] >= long:
            stretches.append(_grown(levels, allowed, points, i, j))
        elif not at_end and signs[i] != signs[j]:
            places += _crossing(levels, allowed, points[i], points[j])
            touching += [False] * (len(places) - len(touching))
        elif inside.size:
            slopes = np.abs(levels(inside)[0 if at_end else 1])
            places.append(float(inside[slopes.argmin()]))
            touching.append(not at_end)
    return _Zeros(
        np.array(places), np.array(touching, dtype=bool), np.array(stretches).reshape(-1, 2)
    )


def _crossing(
    levels: Callable[[Array], Array], allowed: Callable[[Array], Array], low: float, high: float
) -> list[float]:
    """Return the zero between two places with different signs; none where the function jumps."""
    ends = np.array([low, high])
    zero = bracketed_zero(
        lambda t: (levels(t)[0], levels(t)[1]), ends[:1], ends[1:], 1e-13 * (high - low)
    )
    jump = 1e-6 * float(np.abs(levels(ends)[0]).min())
    continuous = abs(float(levels(zero)[0][0])) <= max(float(allowed(zero)[0]), jump)
    return zero.tolist() if continuous else []


def _grown(
    levels: Callable[[Array], Array],
    allowed: Callable[[Array], Array],
    points: Array,
    i: int,
    j: int,
) -> tuple[float, float]:
    """Return the ends of the stretch of zeros between the firm places i and j, by halving."""

    def vanishes(t: float) -> bool:
        place = np.array([t])
        return bool(np.abs(levels(place)[0]) <= allowed(place))

    return (
        float(points[0]) if i < 0 else _edge(vanishes, float(points[i]), float(points[i + 1])),
        float(points[-1]) if j == points.size else _edge(vanishes, points[j], points[j - 1]),
    )


def _edge(vanishes: Callable[[float], bool], outside: float, inside: float) -> float:
    for _ in range(40):
        middle = 0.5 * (outside + inside)
        outside, inside = (outside, middle) if vanishes(middle) else (middle, inside)
    return float(inside)
