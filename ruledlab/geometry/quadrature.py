"""Integrals over t to a stated accuracy, and zeros of functions of t in brackets.

A function is expanded on panels in Legendre polynomials, from its values at Gauss' nodes. Where the
last coefficients have not died away, as at an edge or a jump, the panel is halved, again and again,
until what it may still hide is rounding.

SciPy's adaptive rules were measured first. They do not say where an integrand is not smooth, which
the invariants of a closed surface depend on (`closed`), do not give the primitive, and spend a
second on an edge before they give up.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import legendre

from .checks import Array, GeometryError

__all__ = [
    "Primitive",
    "bracketed_zero",
    "edges",
    "estimate",
    "integrals",
    "integrate",
    "sign_changes",
]

ACCURACY = 1e-13
PANELS = 16
MOST_PANELS = 512
SHORTEST = 1e-16
HALVINGS = 52

DEGREES = np.arange(20)
TAIL = 3
"""How many of the last coefficients must have died away: one alone may vanish by chance."""

ROUGH = 0.01
"""A tail longer than this part of what the values differ by: the panel is not resolved."""

JUMP = 4.0
"""A step between two nodes so many times as high as any other is taken for a jump."""

EDGE = 1e-4
"""Panels that had to become shorter than this part of the whole mark an edge."""

FEW = 1e-11
"""What `integrals` may be off, as a part of the largest of them and of 1."""

MOST_INTERVALS = 8_000
MOST_STRIPS = 150


# -- panels ----------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Rule:
    """Nodes on [−1, 1], and the matrix from values there to coefficients of Legendre polynomials.

    The first coefficient is the mean.
    """

    nodes: Array
    expansion: Array


def _rule(nodes: Array) -> _Rule:
    return _Rule(nodes, np.linalg.inv(legendre.legvander(nodes, DEGREES[-1])).T)


INNER = _rule(legendre.leggauss(DEGREES.size)[0])
"""Never asks for the ends, where an integrand may be undefined."""

OUTER = _rule(-np.cos(np.pi * DEGREES / DEGREES[-1]))
"""Sees the ends, so that no jump hides between the last node and them."""

GAP = float(1.0 - INNER.nodes[-1])
"""The end of a panel that no inner node sees, as a part of half its length."""


@dataclass(frozen=True, eq=False, slots=True)
class _Panels:
    """Panels [a, b], each (P,), with the values and the coefficients (…, P, K) of functions."""

    a: Array
    b: Array
    values: Array
    coefficients: Array

    @property
    def half(self) -> Array:
        return np.asarray(0.5 * (self.b - self.a))

    @property
    def pieces(self) -> Array:
        """(…, P) the integrals over the panels."""
        return np.asarray(2.0 * self.half * self.coefficients[..., 0])

    @property
    def tail(self) -> Array:
        """(P,) how far off one of these integrals may be."""
        last = np.abs(self.coefficients[..., -TAIL:]).max(axis=-1)
        return np.asarray(np.abs(self.half) * _largest(last))

    @property
    def doubt(self) -> Array:
        """(P,) the same, and on panels that are not resolved at all whatever the values allow.

        Near a singularity the coefficients alone would promise too much.
        """
        spread = np.abs(self.half) * _largest(np.ptp(self.values, axis=-1))
        return np.asarray(np.where(self.tail > ROUGH * spread, spread, self.tail))

    @property
    def hidden(self) -> Array:
        """(P,) what an edge between a panel's last inner node and its end may hide.

        Without one the expansions of neighbours agree at the corner between them.
        """
        ends = self.coefficients.sum(axis=-1)
        starts = self.coefficients @ (-1.0) ** DEGREES
        apart = _largest(np.abs(starts[..., 1:] - ends[..., :-1]))
        return np.asarray(GAP * self.half * np.maximum(np.append(apart, 0), np.append(0, apart)))

    def where(self, chosen: npt.NDArray[Any]) -> _Panels:
        values, coefficients = self.values[..., chosen, :], self.coefficients[..., chosen, :]
        return _Panels(self.a[chosen], self.b[chosen], values, coefficients)

    def parts(self, rule: _Rule) -> tuple[Array, Array, npt.NDArray[np.intp]]:
        """Return shorter panels, and of which each is a part.

        A jump is cut out between two nodes, any other panel is halved.
        """
        if not self.a.size:
            return self.a, self.b, np.arange(0)
        steps = _largest_rows(np.abs(np.diff(self.values, axis=-1)))
        first, top = steps.argmax(axis=-1), steps.max(axis=-1)
        jump = np.partition(steps, -2, axis=-1)[:, -2] * JUMP < top
        places = 0.5 * (self.a + self.b) + self.half * np.stack(
            [rule.nodes[first], rule.nodes[first + 1]]
        )
        left = np.where(jump, places[0], 0.5 * (self.a + self.b))
        right = np.where(jump, places[1], left)
        a, b = np.concatenate([self.a, left, right]), np.concatenate([left, right, self.b])
        owner = np.tile(np.arange(self.a.size), 3)
        real = a != b
        return a[real], b[real], owner[real]


def _largest(values: Array) -> Array:
    """Return the largest over all axes but the last."""
    return np.asarray(values.reshape(-1, values.shape[-1]).max(axis=0))


def _largest_rows(steps: Array) -> Array:
    """Return (P, K) for each panel the steps of that function which has the highest one."""
    rows = steps.reshape(-1, *steps.shape[-2:])
    return np.asarray(rows[rows.max(axis=-1).argmax(axis=0), np.arange(rows.shape[1])])


def _expanded(function: Callable[[Array], Array], a: Array, b: Array, rule: _Rule) -> _Panels:
    """Evaluate on all panels at once, so that ``function`` gets long arrays."""
    places = 0.5 * (a + b)[:, np.newaxis] + 0.5 * (b - a)[:, np.newaxis] * rule.nodes
    values = np.asarray(function(places.ravel()))
    values = values.reshape(*values.shape[:-1], *places.shape)
    with np.errstate(all="ignore"):
        return _Panels(a, b, values, values @ rule.expansion)


def _joined(parts: list[_Panels]) -> _Panels:
    whole = _Panels(
        np.concatenate([part.a for part in parts]),
        np.concatenate([part.b for part in parts]),
        np.concatenate([part.values for part in parts], axis=-2),
        np.concatenate([part.coefficients for part in parts], axis=-2),
    )
    return whole.where(np.argsort(whole.a))


def _refined(
    function: Callable[[Array], Array], start: float, end: float
) -> tuple[_Panels, _Panels]:
    """Return panels on which the functions are resolved, in order, and those where they are not."""
    corners = np.linspace(start, end, PANELS + 1)
    panels = _expanded(function, corners[:-1], corners[1:], INNER)
    allowed = ACCURACY * max(1.0, float(np.nansum(np.abs(panels.pieces), axis=-1).max()))
    done: list[_Panels] = []
    while True:
        good = panels.tail <= allowed  # NaN is not good
        done.append(panels.where(good))
        rest = panels.where(~good)
        if not rest.a.size:
            whole = _joined(done)
            seen = whole.hidden <= allowed
            done, rest = [whole.where(seen)], whole.where(~seen)
        if not 0 < rest.a.size <= MOST_PANELS or rest.half.min() <= SHORTEST * (end - start):
            return _joined(done), rest
        a, b, _ = rest.parts(INNER)
        panels = _expanded(function, a, b, INNER)


def _resolved(function: Callable[[Array], Array], start: float, end: float, what: str) -> _Panels:
    panels, rest = _refined(function, start, end)
    if rest.a.size:
        raise GeometryError(
            f"{what} does not converge between t = {start:g} and t = {end:g}: the integrand is "
            f"undefined or unbounded near t = {0.5 * (rest.a[0] + rest.b[0]):.4g}, as where κ "
            "comes down to 0; move the curve away from such places"
        )
    return panels


# -- integrals -------------------------------------------------------------------------------------


def integrate(function: Callable[[Array], Array], start: float, end: float, what: str) -> Array:
    """Integrate rows of functions of t over [start, end].

    Parameters
    ----------
    function
        t of shape (N,) to values of shape (…, N); they may have edges and jumps.
    what
        names the integral in the error message.

    Returns
    -------
    Array
        (…) the integrals, to about 1e-12 of the largest of them and of 1.

    Raises
    ------
    GeometryError
        if the accuracy is not reached, as where an integrand is undefined or has a pole.
    """
    return np.asarray(_resolved(function, start, end, what).pieces.sum(axis=-1))


def edges(function: Callable[[Array], Array], start: float, end: float) -> Array:
    """Return where functions of t, as for `integrate`, are not smooth: (M,), rising."""
    panels = _joined(list(_refined(function, start, end)))
    close = EDGE * (end - start)
    narrow = panels.where(2.0 * panels.half < close)
    at, half = 0.5 * (narrow.a + narrow.b), narrow.half
    # Neighbouring panels close in on one edge: the shortest of a cluster has it.
    clusters = np.split(np.arange(at.size), np.flatnonzero(np.diff(at) > close) + 1)
    return np.array([at[c[np.argmin(half[c])]] for c in clusters if c.size])


def estimate(
    function: Callable[[Array], tuple[Array, Array]], corners: Array
) -> tuple[float, float]:
    """Integrate over t as far as that can be done quickly.

    Parameters
    ----------
    function
        t of shape (N,) to values, (N,), and how far off each of them may be, inf where undefined.
    corners
        from the start to the end, with all known places between at which the values have an edge.

    Returns
    -------
    tuple
        the integral and how far off it may be; (nan, inf) where there is none.
    """
    a, b = corners[:-1], corners[1:]
    total = off = 0.0
    left = MOST_STRIPS
    while a.size:
        panels = _expanded(lambda t: np.stack(function(t)), a, b, INNER)
        if not np.isfinite(panels.values).all():
            return np.nan, np.inf
        doubt = _Panels(a, b, panels.values[0], panels.coefficients[0]).doubt
        left -= 3 * a.size
        good = (doubt <= FEW) | (left < 0)
        value, told = panels.where(good).pieces.sum(axis=-1)
        total, off = total + value, off + told + doubt[good].sum()
        a, b, _ = panels.where(~good).parts(INNER)
    return float(total), float(off)


def integrals(
    function: Callable[[Array, npt.NDArray[np.intp]], Array], low: Array, high: Array
) -> tuple[Array, Array]:
    """Integrate over many intervals at once, as far as that can be done quickly.

    Parameters
    ----------
    function
        places of shape (M,) and, of the same shape, the index of the interval each belongs to, to
        values (M,).
    low, high
        (N,) from where to where.

    Returns
    -------
    integrals, off
        (N,) each; the second is how far off the first may be, inf where there is no value.
    """
    total, off = np.zeros(low.size), np.zeros(low.size)
    owner, a, b = np.arange(low.size), low, high
    shortest = 4.0 * np.finfo(float).eps * np.maximum(np.abs(low), np.abs(high))
    allowed, left = 0.0, MOST_INTERVALS
    while owner.size:
        panels = _expanded(functools.partial(_owned, function, owner), a, b, OUTER)
        doubt, left = panels.doubt, left - owner.size
        allowed = allowed or FEW * max(1.0, float(np.nanmax(np.abs(panels.pieces), initial=0.0)))
        good = (doubt <= allowed) | (np.abs(b - a) <= shortest[owner]) | (left < 0)
        np.add.at(total, owner[good], np.nan_to_num(panels.pieces[good]))
        np.add.at(off, owner[good], np.nan_to_num(doubt[good], nan=np.inf))
        a, b, parts = panels.where(~good).parts(OUTER)
        owner = owner[~good][parts]
    return total, off


def _owned(
    function: Callable[[Array, npt.NDArray[np.intp]], Array],
    owner: npt.NDArray[np.intp],
    places: Array,
) -> Array:
    return function(places, np.repeat(owner, DEGREES.size))


# -- zeros -----------------------------------------------------------------------------------------


def sign_changes(
    function: Callable[[Array], Array], start: float, end: float, samples: int = 513
) -> Array:
    """Return where a scalar function of t changes sign between two of the samples, by bisection.

    Stretches on which it is 0 or NaN are no change by themselves: what counts is the sign before
    and after.
    """
    t = np.linspace(start, end, samples)
    signs = np.sign(function(t))
    firm = np.flatnonzero(np.abs(signs) > 0.0)
    turns = np.flatnonzero(signs[firm[:-1]] != signs[firm[1:]])
    left, right, sign = t[firm[turns]], t[firm[turns + 1]], signs[firm[turns]]
    for _ in range(HALVINGS if turns.size else 0):
        middle = 0.5 * (left + right)
        same = np.sign(function(middle)) == sign
        left, right = np.where(same, middle, left), np.where(same, right, middle)
    return 0.5 * (left + right)


def bracketed_zero(
    function: Callable[[Array], tuple[Array, Array]], low: Array, high: Array, close: float
) -> Array:
    """Return a zero between ``low`` and ``high`` for each pair, by Newton's method in brackets.

    Parameters
    ----------
    function
        t of shape (N,) to the values and the slopes of one function for each of the N brackets,
        which changes sign in it or is zero at an end. Where a step is more than half as long as
        the last but one, the bracket is halved instead.
    close
        how near in t two steps must be to end.
    """
    left_sign = np.sign(function(low)[0])
    t: Array = 0.5 * (low + high)
    last = before = high - low
    for _ in range(2 * HALVINGS if t.size else 0):
        value, slope = function(t)
        left = np.sign(value) == left_sign
        low = np.asarray(np.where(left, t, low))
        high = np.asarray(np.where(left, high, t))
        with np.errstate(all="ignore"):
            # A step out of the bracket ends on its border, where the zero may be.
            newton = np.clip(t - value / slope, low, high)
            good = np.abs(newton - t) <= np.maximum(close, 0.5 * before)
        following: Array = np.where(good, newton, 0.5 * (low + high))
        before, last = last, np.abs(following - t)
        t = following
        if (last <= close).all():
            break
    return t


# -- a primitive -----------------------------------------------------------------------------------


class Primitive:
    """F(t) = ∫ f from the start to t, for any t of the interval, and t as a function of F.

    Parameters
    ----------
    function
        f: t of shape (N,) to (N,); it may have edges and jumps.
    start, end
        the interval.
    what
        names the integral in the error message.

    Raises
    ------
    GeometryError
        where the accuracy of `integrate` is not reached, as at a pole of f.
    """

    __slots__ = ("_corners", "_function", "_rise", "_sums")

    def __init__(
        self, function: Callable[[Array], Array], start: float, end: float, what: str
    ) -> None:
        self._function = function
        panels = _resolved(function, start, end, what)
        self._corners = np.append(panels.a, end)
        self._sums = np.concatenate([[0.0], np.cumsum(panels.pieces)])
        self._rise = panels.half * legendre.legint(panels.coefficients.T, lbnd=-1.0)

    @property
    def total(self) -> float:
        """The integral over the whole interval."""
        return float(self._sums[-1])

    def __call__(self, t: Array) -> Array:
        """Return F(t), of the shape of t, from the expansions of f."""
        panel = np.searchsorted(self._corners, t, side="right") - 1
        panel = np.clip(panel, 0, self._corners.size - 2)
        a, b = self._corners[panel], self._corners[panel + 1]
        place = (2.0 * t - a - b) / (b - a)
        inside = legendre.legval(place, self._rise[:, panel], tensor=False)
        return np.asarray(self._sums[panel] + inside)

    def inverse(self, value: Array) -> Array:
        """Return t with F(t) = value, of shape (N,); f must not change sign on the interval."""
        panel = np.searchsorted(self._sums, value, side="right") - 1
        panel = np.clip(panel, 0, self._corners.size - 2)
        close = 1e-14 * float(self._corners[-1] - self._corners[0])
        return bracketed_zero(
            lambda t: (self(t) - value, self._function(t)),
            self._corners[panel],
            self._corners[panel + 1],
            close,
        )
