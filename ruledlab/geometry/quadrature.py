"""Integrals over t to a stated accuracy, and zeros of functions of t in brackets."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import cubature

from .checks import Array, GeometryError

__all__ = ["Primitive", "bracketed_zero", "integrate", "sign_changes"]

ACCURACY = 1e-13
PANELS = 16
SUBDIVISIONS = 60
HALVINGS = 52
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
MOST_PANELS = 4096


def integrate(function: Callable[[Array], Array], start: float, end: float, what: str) -> Array:
    """Integrate rows of smooth functions of t over [start, end].

    Parameters
    ----------
    function
        t of shape (N,) to values of shape (…, N).
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
    step = (end - start) / PANELS
    corners = start + step * np.arange(PANELS)

    def folded(places: Array) -> Array:
        # The panels are summed inside, so that each call of `function` gets a long array.
        t = corners + step * places
        values = function(t.ravel())
        panels = values.reshape(*values.shape[:-1], *t.shape).sum(axis=-1)
        return np.moveaxis(panels, -1, 0)

    result = cubature(
        folded,
        [0.0],
        [1.0],
        rtol=ACCURACY,
        atol=ACCURACY / abs(step),
        max_subdivisions=SUBDIVISIONS,
    )
    estimate: Array = step * np.asarray(result.estimate)
    if result.status != "converged" or not np.isfinite(estimate).all():
        raise GeometryError(
            f"{what} does not converge between t = {start:g} and t = {end:g}: the integrand is "
            "undefined or unbounded there, as where κ comes down to 0; move the curve away from "
            "such places"
        )
    return estimate


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


class Primitive:
    """F(t) = ∫ f from the start to t, for any t of the interval, and t as a function of F.

    The interval is halved until 16-point Gauss rules agree with those of their halves to about
    1e-13 of the whole integral of |f| and of 1, which also meets the kinks of a speed.

    Parameters
    ----------
    function
        f: t of shape (N,) to (N,).
    start, end
        the interval.
    what
        names the integral in the error message.

    Raises
    ------
    GeometryError
        where the accuracy is not reached, as at a pole of f.
    """

    __slots__ = ("_corners", "_function", "_sums")

    def __init__(
        self, function: Callable[[Array], Array], start: float, end: float, what: str
    ) -> None:
        self._function = function
        starts, pieces = self._refined(start, end, what)
        order = np.argsort(starts)
        self._corners = np.append(starts[order], end)
        self._sums = np.concatenate([[0.0], np.cumsum(pieces[order])])

    def _refined(self, start: float, end: float, what: str) -> tuple[Array, Array]:
        """Return where accepted panels start, and the integral over each."""
        corners = np.linspace(start, end, PANELS + 1)
        a: Array = corners[:-1]
        b: Array = corners[1:]
        whole = self._gauss(a, b)
        allowed = ACCURACY * max(1.0, float(np.abs(whole).sum()))
        starts: list[Array] = []
        pieces: list[Array] = []
        for _ in range(HALVINGS):
            middle = 0.5 * (a + b)
            left, right = self._gauss(a, middle), self._gauss(middle, b)
            good = np.abs(left + right - whole) <= allowed
            starts += [a[good], middle[good]]
            pieces += [left[good], right[good]]
            rest = ~np.tile(good, 2)
            a, b, whole = (
                np.concatenate(pair)[rest] for pair in ((a, middle), (middle, b), (left, right))
            )
            if a.size == 0:
                return np.concatenate(starts), np.concatenate(pieces)
            if a.size > MOST_PANELS:
                break
        raise GeometryError(
            f"{what} does not converge between t = {start:g} and t = {end:g}: the integrand is "
            f"undefined or unbounded near t = {0.5 * (a[0] + b[0]):.4g}, as where κ comes down to "
            "0; move the curve away from such places"
        )

    def _gauss(self, a: Array, b: Array) -> Array:
        """Integrate over [a, b], of any shape, without regard to panels."""
        middle, half = 0.5 * (a + b), 0.5 * (b - a)
        places = middle[..., np.newaxis] + half[..., np.newaxis] * NODES
        values = self._function(places.ravel()).reshape(places.shape)
        return np.asarray(half * (values @ WEIGHTS))

    @property
    def total(self) -> float:
        """The integral over the whole interval."""
        return float(self._sums[-1])

    def __call__(self, t: Array) -> Array:
        """Return F(t), of the shape of t."""
        panel = np.searchsorted(self._corners, t, side="right") - 1
        panel = np.clip(panel, 0, self._corners.size - 2)
        return np.asarray(self._sums[panel] + self._gauss(self._corners[panel], t))

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
