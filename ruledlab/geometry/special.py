"""Special rulings found by root finding: torsal and cylindrical ones, and stretches of them.

κκ̄ = ⟨x′, x̄′⟩ and κ² = ⟨x′, x′⟩ are smooth even where κ = 0, and so are their derivatives. Between
two neighbouring zeros of its derivative a function is monotone and has at most one zero, so the
zeros of κκ̄ are bracketed by those of its derivative, these by those of the second one. A double
zero is a zero of the derivative at which the function is 0 too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from .checks import CYLINDRICAL, Array, frozen
from .closed import MovingLine
from .jet import Jet
from .quadrature import bracketed_zero

__all__ = ["SpecialRulings", "special_rulings"]

CELLS = 512
"""Cells of the grid that separates the zeros of the second derivative."""

STRETCH = 8
"""Cells in a row on which a function must be 0 to rounding to count as 0 throughout."""

TOUCH = 1e-11
"""|κκ̄| below this fraction of the terms it is made of counts as 0 at an extremum."""

ROUNDING = 64 * np.finfo(float).eps
"""A derivative below this fraction of the terms it is made of has no sign to go by."""

SQUARE, PRODUCT = 0, 1
"""The two functions: κ² and κκ̄."""

Flags = npt.NDArray[np.bool_]
Indices = npt.NDArray[np.intp]


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
class _Known:
    """κ² and κκ̄ with two derivatives at places in their order.

    Attributes
    ----------
    t
        (N,) the places.
    values
        (2, 3, N) the functions and their derivatives.
    noise
        (2, 3, N) what rounding may make of them.
    zero
        (2, N) what counts as 0 for the functions themselves.
    """

    t: Array
    values: Array
    noise: Array
    zero: Array

    def joined(self, other: _Known) -> _Known:
        """Return all places of both in their order, each of them once."""
        t, first = np.unique(np.concatenate([self.t, other.t]), return_index=True)
        parts = [(getattr(self, n), getattr(other, n)) for n in ("values", "noise", "zero")]
        return _Known(t, *(np.concatenate(pair, axis=-1)[..., first] for pair in parts))


@dataclass(frozen=True, eq=False, slots=True)
class _Zeros:
    places: Array
    touching: Flags
    stretches: Array


@np.errstate(all="ignore")
def special_rulings(moving: MovingLine) -> SpecialRulings:
    """Return the torsal and the cylindrical rulings of one surface.

    Zeros are exact to rounding: single ones to about 1e-15 of the domain, double ones to 1e-12 or
    so. Extrema of κκ̄ that lie pairwise within one 512th of the domain may escape, and a zero of
    order 6 or more counts as a short stretch. Where the line is undefined nothing is reported.
    """
    start, end = moving.domain
    known = _refined(moving)
    turning, twisting = (_zeros(moving, known, kind) for kind in (SQUARE, PRODUCT))
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


def _apart(t: Array, places: Array, stretches: Array, near: float) -> Flags:
    """Say which t lie neither near one of the places nor in one of the stretches."""
    at_place = (np.abs(t[:, np.newaxis] - places) <= near).any(axis=1)
    first, last = stretches[:, 0] - near, stretches[:, 1] + near
    inside = ((t[:, np.newaxis] >= first) & (t[:, np.newaxis] <= last)).any(axis=1)
    return np.asarray(~(at_place | inside))


# -- κ², κκ̄ and their derivatives ------------------------------------------------------------------


def _leibniz(a: Array, both: Array) -> Array:
    """Return (2, M, N) the derivatives of ⟨a, b⟩ for two b, by Leibniz' rule.

    ``a`` is (M, entries, N), derivative by derivative, and ``both`` is (M, 2, entries, N).
    """
    products = np.einsum("ikn,jpkn->pijn", a, both)
    return np.stack(
        [sum(math.comb(m, i) * products[:, i, m - i] for i in range(m + 1)) for m in range(len(a))],
        axis=1,
    )


def _values(jet: Jet) -> Array:
    rates = jet.rows[1:]
    return _leibniz(rates[:, 0], rates)


def _known(moving: MovingLine, t: Array) -> _Known:
    jet = moving.jet(t, 3)
    lengths = np.linalg.norm(jet.rows, axis=2, keepdims=True)
    kappa, moment, rate = lengths[1, 0, 0], lengths[0, 1, 0], lengths[1, 1, 0]
    resting = np.broadcast_to((CYLINDRICAL * np.asarray(jet.scale)) ** 2, kappa.shape)
    noise = ROUNDING * _leibniz(lengths[1:, 0], lengths[1:])
    return _Known(
        t, _values(jet), noise, np.stack([resting, TOUCH * kappa * (rate + kappa * moment)])
    )


# -- where a derivative is zero --------------------------------------------------------------------


def _refined(moving: MovingLine) -> _Known:
    """Return the grid together with the zeros of the second, then of the first derivatives."""
    start, end = moving.domain
    known = _known(moving, np.linspace(start, end, CELLS + 1))
    for level in (2, 1):
        values = known.values[:, level]
        signs = np.where(np.abs(values) <= known.noise[:, level], 0.0, np.sign(values))
        kinds, left = np.nonzero(signs[:, :-1] * signs[:, 1:] < 0.0)
        if left.size:
            ends = known.t[left], known.t[left + 1]
            places = _bracketed(moving, kinds, level, *ends, 1e-12 * (end - start))
            known = known.joined(_known(moving, places))
    return known


def _bracketed(
    moving: MovingLine, kinds: Indices, level: int, low: Array, high: Array, close: float
) -> Array:
    """Return a zero of a derivative in each bracket; ``kinds`` says of which function."""
    each = np.arange(kinds.size)

    def function(t: Array) -> tuple[Array, Array]:
        values = _values(moving.jet(t, level + 2))
        return values[kinds, level, each], values[kinds, level + 1, each]

    return bracketed_zero(function, low, high, close)


# -- where a function is zero ----------------------------------------------------------------------


def _zeros(moving: MovingLine, known: _Known, kind: int) -> _Zeros:
    """Read zeros and stretches off the signs: between two firm signs there is one zero or none."""
    finite = np.isfinite(known.values[kind, 0])
    t, zero = known.t[finite], known.zero[kind, finite]
    value, slope = np.abs(known.values[kind, :2, finite].T)
    signs = np.where(value <= zero, 0.0, np.sign(known.values[kind, 0, finite]))
    start, end = moving.domain
    crossings, touching, stretches = [], [], []
    for i, j in pairwise([-1, *np.flatnonzero(signs).tolist(), signs.size]):
        inside = slice(i + 1, j)
        at_end = i < 0 or j == signs.size
        if j - i > 1 and t[j - 1] - t[i + 1] >= STRETCH * (end - start) / CELLS:
            stretches.append((i, j))
        elif not at_end and signs[i] != signs[j]:
            crossings.append((i, j))
        elif j - i > 1:
            least = (value if at_end else slope)[inside].argmin()
            touching.append((float(t[inside][least]), not at_end))
    found = [(x, False) for x in _crossed(moving, kind, t, value, crossings)]
    places = sorted(found + touching)
    return _Zeros(
        np.array([x for x, _ in places]),
        np.array([touches for _, touches in places], dtype=bool),
        np.array(list(_grown(moving, kind, t, stretches))).reshape(-1, 2),
    )


def _crossed(
    moving: MovingLine, kind: int, t: Array, value: Array, pairs: list[tuple[int, int]]
) -> list[float]:
    """Return the zeros between pairs of places with different signs; none where it jumps."""
    if not pairs:
        return []
    left, right = np.array(pairs).T
    start, end = moving.domain
    close = 1e-13 * (end - start) / CELLS
    kinds = np.full(left.size, kind)
    places = _bracketed(moving, kinds, 0, t[left], t[right], close)
    there = _known(moving, places)
    jump = 1e-6 * np.minimum(value[left], value[right])
    small = np.abs(there.values[kind, 0]) <= np.maximum(there.zero[kind], jump)
    return [float(place) for place in places[small]]


def _grown(
    moving: MovingLine, kind: int, t: Array, pairs: list[tuple[int, int]]
) -> Iterator[tuple[float, float]]:
    """Yield the ends of the stretches of zeros between pairs of firm places."""
    for i, j in pairs:
        yield (
            float(t[0]) if i < 0 else _edge(moving, kind, float(t[i]), float(t[i + 1])),
            float(t[-1]) if j == t.size else _edge(moving, kind, float(t[j]), float(t[j - 1])),
        )


def _edge(moving: MovingLine, kind: int, outside: float, inside: float) -> float:
    """Return where a stretch of zeros ends, by halving."""
    for _ in range(40):
        middle = 0.5 * (outside + inside)
        there = _known(moving, np.array([middle]))
        if np.abs(there.values[kind, 0, 0]) <= there.zero[kind, 0]:
            inside = middle
        else:
            outside = middle
    return inside
