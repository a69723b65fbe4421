"""The formulas as they are printed, evaluated to the letter, slips included.

Nothing here is to be used for computing a surface: the functions of the same names in
`as_defined`, and `ruledlab.geometry`, are for that. §2.4 speaks of the invariants, which are taken
from their definitions; §4 speaks of u, v, ū, v̄ and their derivatives.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..geometry import RuledSurface
from ..geometry.checks import Array, finite_array
from . import parts
from .parts import Chart, around, bending, chart, control_points, ratio

# -- §2 and §3 -------------------------------------------------------------------------------------


def x2bar_prime(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """x̄₂′ of (5)."""
    x1, x2, x3 = np.moveaxis(surface.frame(t), -2, 0)
    m, inv = surface.striction(t), surface.invariants(t)
    kappa, kappa_bar, tau, tau_bar = (
        value[..., np.newaxis] for value in (inv.kappa, inv.kappa_bar, inv.tau, inv.tau_bar)
    )
    x1bar, x2bar = np.cross(m, x1), np.cross(m, x2)
    return np.asarray(-kappa_bar * x1 + tau_bar * x3 - kappa * x1bar + tau * x2bar)


def x3_length(surface: RuledSurface) -> Array:
    """∫τ̂ dt as a pair."""
    lengths = surface.arc_lengths()
    return np.array([lengths.tau, lengths.tau_bar])


def g11(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """g₁₁, on which all of §2.4 rests."""
    w = finite_array(w, "w")
    k = bending(surface, t, w)
    return np.asarray(k.tau_bar**2 + (w * k.kappa) ** 2 + k.kappa_bar**2)


def h11(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """h₁₁."""
    w = finite_array(w, "w")
    k = bending(surface, t, w)
    first = k.kappa_bar * (k.tau_bar + w * k.kappa_prime - k.tau)
    second = w * k.kappa * (w * k.kappa * k.tau + k.kappa_bar_prime)
    return np.asarray((first - second) / k.area)


def mean_curvature(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """K_M."""
    w = finite_array(w, "w")
    k = bending(surface, t, w)
    above = h11(surface, t, w) * k.area - 2.0 * k.kappa * k.kappa_bar * k.tau_bar
    return np.asarray(above / (2.0 * k.area**3))


def angle_of_pitch_11(surface: RuledSurface) -> Array:
    """λ of (11), with ⟨x₂′, x₃⟩ by differentiating x₂ = x′/κ."""

    def turning(t: Array) -> Array:
        x, _ = parts.line(surface, t, 2)
        slope = x.derivative()
        x2 = slope / np.sqrt(parts.dot(slope, slope))
        x3 = np.cross(x.value, x2.value, axis=0)
        return np.asarray(parts.dot(x2.derivative().value, x3))

    return around(surface, turning, "the angle of pitch")


def domain(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """1 where 0 ≤ u ≤ π and 0 ≤ v ≤ 2π, otherwise 0."""
    u, v = surface.curve.series(finite_array(t, "t"), 0).value
    within = (u >= 0.0) & (u <= math.pi) & (v >= 0.0) & (v <= 2.0 * math.pi)
    return np.asarray(within, dtype=np.float64)


def closing(surface: RuledSurface) -> Array:
    """Return the sine of the angle between p₁ − p₀ and p₀ − pₙ₋₁: 0 where collinear."""
    start, end = (surface.curve.series(np.array(t), 1).derivatives()[1] for t in surface.domain)
    area = abs(start[0] * end[1] - start[1] * end[0])
    return ratio(np.asarray(area), np.hypot(*start) * np.hypot(*end))


# -- §4 --------------------------------------------------------------------------------------------


def _kappa_square(f: Chart) -> Array:
    return np.asarray(f.du**2 * np.sin(f.v) ** 2 + f.dv**2)


def _stretch(f: Chart) -> Array:
    """κκ̄, the numerator of (19)."""
    sine, cosine = np.sin(f.v), np.cos(f.v)
    along = f.du**2 * sine * (f.vbar * cosine + f.ubar_u * sine)
    mixed = f.du * f.dv * (f.vbar_u + f.ubar_v * sine**2)
    return np.asarray(along + mixed + f.dv**2 * f.vbar_v)


def tau(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """τ of (18)."""
    f = chart(surface, t)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    first = cosine * (f.du**3 * sine**2 + 2.0 * f.du * f.dv**2)
    return ratio(first + sine * (f.du * f.ddv + f.ddu * f.dv), _kappa_square(f))


def tau_bar(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """τ̄ of (18), which is ⟨c′, x⟩."""
    f = chart(surface, t)
    return np.asarray(np.sin(f.v) * (f.ubar * f.dv - f.vbar * f.du))


def cot_sigma(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """Cot σ of (22)."""
    f = chart(surface, t)
    below = np.where(parts.torsal(surface, t), 0.0, _stretch(f))
    return ratio(tau_bar(surface, t) * np.sqrt(_kappa_square(f)), below)


def pitch_24(surface: RuledSurface) -> Array:
    """Return l of (24)."""
    return around(surface, lambda t: tau_bar(surface, t), "the pitch")


def angle_of_pitch_25(surface: RuledSurface) -> Array:
    """λ of (25)."""
    return -around(surface, lambda t: tau(surface, t), "the angle of pitch")


# -- Example 1 -------------------------------------------------------------------------------------


def example_1_kappa_bar(_surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """κ̄ of Example 1."""
    t = finite_array(t, "t")
    return np.asarray((t * np.sin(2.0 * t) + 3.0) / np.sqrt(np.sin(t) ** 2 + 1.0))


def example_1_tau_bar(_surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """τ̄ of Example 1."""
    t = finite_array(t, "t")
    return np.asarray(t * np.sin(t))


def example_1_cot_sigma(_surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """Cot σ of Example 1."""
    t = finite_array(t, "t")
    return ratio(-t * np.sqrt(np.sin(t) ** 2 + 1.0), t * np.cos(t) + 2.0 * np.sin(t))


# -- §4.2: at t = 0, and Example 2 -----------------------------------------------------------------


def _at_start(surface: RuledSurface) -> tuple[int, Array, Array, Chart]:
    """Return n, p₁ − p₀, p₂ − 2p₁ + p₀ (zero for n = 1) and the chart at t = 0."""
    points = control_points(surface)
    n = len(points) - 1
    bend = points[2] - 2.0 * points[1] + points[0] if n > 1 else np.zeros(2)
    return n, points[1] - points[0], bend, chart(surface, 0.0)


def tau_0(surface: RuledSurface) -> Array:
    """τ(0)."""
    n, (du, dv), (ddu, ddv), f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    square = du**2 * sine**2 + dv**2
    first = n * cosine * du * (du**2 * sine**2 + 2.0 * dv**2)
    return ratio(first + (n - 1) * sine * (du * ddv + dv * ddu), square)


def tau_bar_0(surface: RuledSurface) -> Array:
    """τ̄(0)."""
    n, (du, dv), _, f = _at_start(surface)
    return np.asarray(n * np.sin(f.v) * (f.ubar * dv - f.vbar * du))


def delta_0(surface: RuledSurface) -> Array:
    """δ(0)."""
    n, (du, dv), _, f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    kept = n * du**2 * sine * (f.vbar * cosine + f.ubar_u * sine)
    return ratio(kept, du**2 * sine**2 + dv**2)


def cot_sigma_0(surface: RuledSurface) -> Array:
    """Cot σ(0)."""
    _, (du, dv), _, f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    above = (f.ubar * dv - f.vbar * du) * np.sqrt(du**2 * sine**2 + dv**2)
    return ratio(above, du**2 * (f.vbar * cosine + f.ubar_u * sine))


def example_2(_surface: RuledSurface) -> Array:
    """λ and l of Example 2."""
    return np.array([1.419793061, 0.3381414433])
