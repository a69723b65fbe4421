"""A moving line and its derivatives, and the invariants read off them by their definitions.

A `Jet` holds X, X′, X″ of an oriented line X = x + ε x̄ at many values of t. Everything is computed
as it is defined, κ̂ = ‖X′‖ and τ̂ = [X, X′, X″]/‖X′‖² (paper, (3)), with the real and the dual part
carried side by side; no formula in u, v, ū, v̄ enters, so any source of moving lines will do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .checks import CYLINDRICAL, STILL, TORSAL, Array
from .series import Series, sine_cosine

Flags = npt.NDArray[np.bool_]

__all__ = ["FLAGS", "QUANTITIES", "Jet", "cross", "dot", "measure", "striction", "study"]


@dataclass(frozen=True, eq=False, slots=True)
class Jet:
    """X, X′, … of a moving line.

    Attributes
    ----------
    rows
        (order+1, 2, 3, …): derivative, real or dual part, entry; then the axes of t.
    scale
        what counts as an ordinary size of κ, to tell when it is zero.
    pole
        (…) where the chart that the line came from is singular.
    """

    rows: Array
    scale: Array | float
    pole: Flags | bool = False

    @property
    def direction(self) -> Array:
        """x, x′, … as an array (order+1, 3, …)."""
        result: Array = self.rows[:, 0]
        return result

    @property
    def moment(self) -> Array:
        """x̄, x̄′, … as an array (order+1, 3, …)."""
        result: Array = self.rows[:, 1]
        return result


def study(angles: Series, ubar: Series | float, vbar: Series | float) -> Array:
    """Put û = u + ε ū, v̂ = v + ε v̄ into the unit sphere's chart (paper, (12) and (13)).

    X = (cos û sin v̂, sin û sin v̂, cos v̂) = x + ε (ū x_u + v̄ x_v).

    Parameters
    ----------
    angles
        u and v: values of shape (2, …).
    ubar, vbar
        ū and v̄ along the curve.

    Returns
    -------
    Array
        the rows of a `Jet`: derivatives, not Taylor coefficients.
    """
    sine, cosine = sine_cosine(angles)
    meridian = Series(np.stack([cosine.coefficients[:, 0], sine.coefficients[:, 0]], axis=1))
    outward, downward = meridian * sine[1], meridian * cosine[1]
    rows = np.empty((angles.order + 1, 2, 3, *angles.shape[1:]))
    x, moment = rows[:, 0], rows[:, 1]
    x[:, :2], x[:, 2] = outward.coefficients, cosine.coefficients[:, 1]
    around, along = (outward * ubar).coefficients, (downward * vbar).coefficients
    np.subtract(along[:, 0], around[:, 1], out=moment[:, 0])
    np.add(along[:, 1], around[:, 0], out=moment[:, 1])
    np.negative((sine[1] * vbar).coefficients, out=moment[:, 2])
    for k in range(2, angles.order + 1):
        rows[k] *= math.factorial(k)
    return rows


def dot(a: Array, b: Array) -> Array:
    """Inner product of arrays of vectors whose entries lie along the first axis."""
    result: Array = np.einsum("i...,i...->...", a, b)
    return result


def cross(a: Array, b: Array) -> Array:
    """Cross product of arrays of vectors whose entries lie along the first axis."""
    result = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[i] = a[j] * b[k] - a[k] * b[j]
    return result


QUANTITIES = (
    "kappa",
    "kappa_bar",
    "tau",
    "tau_bar",
    "sigma",
    "delta",
    "kappa_prime",
    "kappa_bar_prime",
)
"""The rows of values that `measure` returns."""

DUAL = [1, 3, 5, 7, 4]
"""Rows that depend on ū and v̄: κ̄, τ̄, δ, κ̄′, and σ, which may be undefined by itself."""

NEEDED = slice(4)
"""Of these, the ones that are defined together or not at all."""

FLAGS = ("cylindrical", "still", "pole")
"""The rows of flags that `measure` returns: κ = 0; m′ = 0; a pole of the chart."""


def measure(jet: Jet) -> tuple[Array, Flags]:
    """Return the invariants (8, …) and the flags (3, …) of a jet of order 2.

    With κκ̄ = ⟨x′, x̄′⟩, n = x × x′ and n̄ = x̄ × x′ + x × x̄′:
    κ²τ = ⟨n, x″⟩ and κ²τ̄ = ⟨n̄, x″⟩ + ⟨n, x̄″⟩ − 2τκκ̄ (paper, (6)). Undefined values are NaN.
    On a torsal ruling κ̄ is exactly 0: left as rounding it would make σ flicker between 0 and 2π.
    """
    (x, x1, x2), (y, y1, y2) = jet.direction, jet.moment
    kappa = np.sqrt(dot(x1, x1))
    cylindrical = kappa <= CYLINDRICAL * np.asarray(jet.scale)
    size = np.where(cylindrical, np.nan, kappa)
    square = size * size
    lengths = np.abs(jet.rows).max(axis=2)  # squares of long vectors would overflow
    kappa_bar = dot(x1, y1) / size
    kappa_bar[np.abs(kappa_bar) < TORSAL * (lengths[1, 1] + lengths[0, 1] * kappa)] = 0.0
    kappa_prime = dot(x1, x2) / size
    kappa_bar_prime = (dot(x2, y1) + dot(x1, y2) - kappa_bar * kappa_prime) / size
    delta = kappa_bar / size
    normal = cross(x, x1)
    tau = dot(normal, x2) / square
    twist = dot(cross(y, x1) + cross(x, y1), x2) + dot(normal, y2)
    tau_bar = twist / square - 2.0 * tau * delta
    terms = _terms(lengths, size)
    still = (np.hypot(kappa_bar, tau_bar) <= STILL * terms) & np.isfinite(terms)
    sigma = _striction_angle(kappa_bar, tau_bar, still)
    values = np.stack([kappa, kappa_bar, tau, tau_bar, sigma, delta, kappa_prime, kappa_bar_prime])
    return _blanked(values, np.stack([cylindrical, still, np.broadcast_to(jet.pole, still.shape)]))


def _terms(lengths: Array, size: Array) -> Array:
    """Return the size of the terms that cancel in κ̄ and τ̄: the yardstick for m′ = 0."""
    turning = lengths[2, 0] / size
    result: Array = lengths[0, 1] * turning + lengths[2, 1] / size
    return np.asarray(result + lengths[1, 1] * (1.0 + turning / size))


def _striction_angle(kappa_bar: Array, tau_bar: Array, still: Flags) -> Array:
    """Return σ = atan2(κ̄, τ̄) in [0, 2π), NaN where the striction point rests."""
    sigma: Array = np.arctan2(kappa_bar, tau_bar)
    sigma += np.where(sigma < 0.0, 2.0 * np.pi, 0.0)
    sigma[sigma >= 2.0 * np.pi] = 0.0
    sigma[still] = np.nan
    return np.asarray(sigma)


def _blanked(values: Array, flags: Flags) -> tuple[Array, Flags]:
    """Blank the poles of the chart, and of the dual part all where any has overflowed."""
    if flags[2].any():
        values[:, flags[2]] = np.nan
    if not np.isfinite(values.sum()):
        values[~np.isfinite(values)] = np.nan
        dual = values[DUAL]
        values[DUAL] = np.where(np.isnan(dual[NEEDED]).any(axis=0), np.nan, dual)
    return values, flags


def striction(jet: Jet) -> Array:
    """Return (3, …) the striction point m = c − (⟨x′, c′⟩/⟨x′, x′⟩) x, with c = x × x̄.

    NaN where κ = 0. As ⟨x′, c′⟩ = −⟨x × x′, x̄′⟩, a jet of order 1 is enough.
    """
    (x, x1), (y, y1) = jet.direction[:2], jet.moment[:2]
    square = dot(x1, x1)
    cylindrical = square <= (CYLINDRICAL * np.asarray(jet.scale)) ** 2
    shift = dot(cross(x, x1), y1) / np.where(cylindrical, np.nan, square)
    return np.asarray(cross(x, y) + shift * x)
