"""Does a ruled surface close, how smoothly, and what is left after one turn.

Pitch and angle of pitch are the integral invariants of a closed ruled surface (paper, §2.5):
l = −∮⟨c′, x⟩ dt = −∮τ̄ dt and λ = −∮τ dt, together Λ = λ + ε l = −∮τ̂ dt.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np

from .checks import CLOSING, FLAT, Array, GeometryError, frozen
from .dual import Dual
from .jet import Jet, cross, dot, measure, striction
from .line import Line, dual_angle
from .quadrature import integrate, sign_changes

__all__ = ["ArcLengths", "Closure", "MovingLine"]

SAMPLES = 9
"""Places at which the ordinary size of X, X′, X″ is read, to judge a gap by."""

STEPS = ("X", "X′", "X″")


class MovingLine(Protocol):
    """Anything that moves a line over a domain of t."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t."""

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Return X and its derivatives at t, of shape (N,)."""


@dataclass(frozen=True, eq=False, slots=True)
class Closure:
    """How the last line of a surface meets the first.

    Attributes
    ----------
    closed
        whether it is the same line, in either orientation.
    oriented
        whether it is the same oriented line, X(end) = X(start); False for a Möbius closing,
        X(end) = −X(start), and where the surface does not close.
    order
        −1 open, 0 for C⁰, 1 for C¹, 2 for C²: how many derivatives by t agree as well.
    gaps
        (3, 2) what remains in x and x̄ for X, X′ and X″, between X(end) and X(start) or, where
        that is nearer, −X(start); NaN where one of them is undefined.
    reason
        the same in one sentence.
    """

    closed: bool
    oriented: bool
    order: int
    gaps: Array
    reason: str


@dataclass(frozen=True, slots=True)
class ArcLengths:
    """Integral invariants over the whole domain (paper, §2.2).

    ``kappa`` + ε ``kappa_bar`` = ∫κ̂ dt is the dual arc length of X₁; ``tau`` + ε ``tau_bar`` =
    ∫τ̂ dt; ``x3`` = ∫|τ̂| dt the dual arc length of X₃, in which the modulus matters, and to
    which stretches with τ = 0 add nothing, as a pure dual has no modulus;
    ``striction`` = ∫√(κ̄² + τ̄²) dt the length of the striction curve.
    """

    kappa: float
    kappa_bar: float
    tau: float
    tau_bar: float
    x3: Dual
    striction: float


def closure(moving: MovingLine) -> Closure:
    """Compare X, X′ and X″ at both ends of the domain."""
    t = np.linspace(*moving.domain, SAMPLES)
    rows = moving.jet(t, 2).rows
    missing = ~np.isfinite(rows[0]).all(axis=(0, 1))
    if missing.any():
        reason = f"not closed: the line is undefined at t = {t[missing][0]:.4g}"
        return Closure(False, False, -1, frozen(np.full((3, 2), np.nan)), reason)
    first, last = rows[..., 0], rows[..., -1]
    sign = 1.0 if dot(first[0, 0], last[0, 0]) > 0.0 else -1.0
    with np.errstate(all="ignore"):
        gaps = np.linalg.norm(last - sign * first, axis=-1)
        order = int(np.cumprod((gaps <= CLOSING * _sizes(rows)).all(axis=1)).sum()) - 1
    closed = order >= 0
    reason = _closed_reason(sign, order, gaps) if closed else _open_reason(first[0], last[0])
    return Closure(closed, closed and sign > 0.0, order, frozen(gaps), reason)


def _sizes(rows: Array) -> Array:
    """Return (3, 2) the ordinary sizes of X, X′, X″, over the samples where they are defined."""
    lengths = np.linalg.norm(rows, axis=2)
    sizes = np.where(np.isfinite(lengths), lengths, 0.0).max(axis=-1)
    sizes[:, 1] += sizes[:, 0] * sizes[0, 1]
    return np.asarray(np.maximum(sizes, np.finfo(float).tiny))


def _closed_reason(sign: float, order: int, gaps: Array) -> str:
    smooth = f"closes with C{'⁰¹²'[order]}"
    if sign < 0.0:
        return (
            f"{smooth}, but the line comes back reversed (a Möbius closing): only after two turns "
            "is it the same oriented line, and the second turn undoes the pitch and the angle of "
            "pitch of the first"
        )
    if order < 2:
        jump = gaps[order + 1].max()
        if not np.isfinite(jump):
            return f"{smooth}; at the seam {STEPS[order + 1]} is undefined"
        return f"{smooth}; at the seam {STEPS[order + 1]} jumps by {jump:.3g}"
    return smooth


def _open_reason(first: Array, last: Array) -> str:
    gap = dual_angle(Line(*first), Line(*last))
    return (
        "not closed: from the first ruling to the last the direction turns by "
        f"{float(gap.real):.4g} rad and the line moves by {abs(float(gap.dual)):.4g}"
    )


def pitch(moving: MovingLine) -> float:
    """Return l = −∮⟨c′, x⟩ dt (paper, (10)), where ⟨c′, x⟩ = ⟨x × x′, x̄⟩."""
    _require_closed(moving, "pitch")
    return -float(_integral(moving, along, "the pitch", 1))


def angle_of_pitch(moving: MovingLine) -> float:
    """Return λ = −∮τ dt (paper, (25); the sign of (11) is a slip)."""
    _require_closed(moving, "angle of pitch")
    return -float(_integral(moving, _tau, "the angle of pitch", 2))


def dual_angle_of_pitch(moving: MovingLine) -> Dual:
    """Return Λ = λ + ε l, both from one integration."""
    _require_closed(moving, "dual angle of pitch")
    both = _integral(moving, lambda j: np.stack([_tau(j), along(j)]), "Λ", 2)
    return Dual(-float(both[0]), -float(both[1]))


def arc_lengths(moving: MovingLine) -> ArcLengths:
    """Return the integral invariants; the pieces between zeros of τ are integrated one by one.

    A striction point that jumps along the ruling, as at an edge of ū or v̄, is refused.
    """
    start, end = moving.domain
    with np.errstate(all="ignore"):
        breaks = sign_changes(lambda t: _sense(measure(moving.jet(t))[0]), start, end)
        pieces = [
            integrate(lambda t: _lengths(moving.jet(t)), a, b, "an arc length")
            for a, b in pairwise([start, *breaks.tolist(), end])
        ]
    kappa, kappa_bar, tau, tau_bar, length, x3, x3_bar, advance = np.sum(pieces, axis=0)
    require_steady(moving, tau_bar - advance, length, "an arc length")
    return ArcLengths(
        float(kappa),
        float(kappa_bar),
        float(tau),
        float(tau_bar),
        Dual(float(x3), float(x3_bar)),
        float(length),
    )


def _lengths(jet: Jet) -> Array:
    values = measure(jet)[0]
    kappa, kappa_bar, tau, tau_bar = values[:4]
    speed = np.hypot(kappa_bar, tau_bar)
    sense = _sense(values)
    rows = [kappa, kappa_bar, tau, tau_bar, speed, sense * tau, sense * tau_bar, along(jet)]
    return np.stack(rows)


def require_steady(moving: MovingLine, drift: float, length: float, what: str) -> None:
    """Refuse a striction point that jumps along the ruling: ∫τ̄ dt knows nothing of the jumps.

    τ̄ = ⟨c′, x⟩ + μ′ with m = c + μ x, so without a jump the drift ∫(τ̄ − ⟨c′, x⟩) dt is what μ has
    gained, to rounding of the length of the striction curve.
    """
    jet = moving.jet(np.array(moving.domain))
    gained = np.diff(dot(jet.direction[0], striction(jet)))[0]
    if abs(drift - gained) > CLOSING * max(1.0, length):
        raise GeometryError(
            f"{what} does not converge: the striction point jumps along the ruling, as where ū or "
            "v̄ has an edge; choose ū, v̄ that are smooth along the curve"
        )


def _sense(values: Array) -> Array:
    """Return the sign of τ, 0 where the spherical image follows a great circle to rounding."""
    kappa, tau = values[0], values[2]
    return np.asarray(np.where(np.abs(tau) <= FLAT * kappa, 0.0, np.sign(tau)))


def along(jet: Jet) -> Array:
    """Return ⟨c′, x⟩ = ⟨x × x′, x̄⟩, how fast the foot point runs along the ruling."""
    return dot(cross(jet.direction[0], jet.direction[1]), jet.moment[0])


def _tau(jet: Jet) -> Array:
    x = jet.direction
    return np.asarray(dot(cross(x[0], x[1]), x[2]) / dot(x[1], x[1]))


def _integral(
    moving: MovingLine, integrand: Callable[[Jet], Array], what: str, order: int
) -> Array:
    with np.errstate(all="ignore"):
        return integrate(lambda t: integrand(moving.jet(t, order)), *moving.domain, what)


def _require_closed(moving: MovingLine, what: str) -> None:
    state = closure(moving)
    if not state.oriented:
        raise GeometryError(
            f"the {what} needs a surface that closes as a moving oriented line; this one: "
            f"{state.reason}; close the curve and choose ū, v̄ that return to their values"
        )
