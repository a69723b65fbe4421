"""The same quantities from their definitions, without the formula in question.

x, x̄, c and m are differentiated as series; what `RuledSurface` knows it has from (3) and (6).
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..geometry import RuledSurface, cross, gallery
from ..geometry.checks import Array, finite_array
from .entry import Evaluation
from .parts import bending, control_points, dot, line, ratio, spread, striction, torsal

# -- §2 and §3 -------------------------------------------------------------------------------------


def x2bar_prime(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """x̄₂′ by differentiating x̄₂ = (x̄′ − κ̄ x₂)/κ, the dual part of X₂ = X′/κ̂."""
    x, moment = line(surface, t, 2)
    slope, moment_slope = x.derivative(), moment.derivative()
    kappa = np.sqrt(dot(slope, slope))
    x2 = slope / kappa
    x2bar = (moment_slope - dot(x2, moment_slope) * x2) / kappa
    return np.moveaxis(x2bar.derivative().value, 0, -1)


def x3_length(surface: RuledSurface) -> Array:
    """∫‖X₃′‖ dt as a pair."""
    length = surface.arc_lengths().x3
    return np.array([length.real, length.dual])


def g11_from_foot(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """⟨r_t, r_t⟩ of r = c + w x, with the foot point c = x × x̄ as the base curve."""
    w = finite_array(w, "w")
    x, moment = line(surface, t, 1)
    foot = cross(x, moment, 0)
    r_t = spread(foot.derivative().value, w) + w * spread(x.derivative().value, w)
    return np.asarray(dot(r_t, r_t))


def _patch(
    surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike
) -> tuple[Array, Array, Array, Array, Array]:
    """Return r_t, r_w, r_tt, r_tw and the unit normal of r = m + w x by differentiation."""
    w = finite_array(w, "w")
    x, moment = line(surface, t, 3)
    m0, m1, m2 = (spread(row, w) for row in striction(x, moment).derivatives())
    x0, x1, x2 = (spread(row, w) for row in x.derivatives()[:3])
    ones = np.ones_like(m0 * w)
    r_t, r_w = m1 + w * x1, x0 * ones
    normal = np.cross(r_t, r_w, axis=0)
    no_plane = np.isnan(bending(surface, t, w).area)
    size = np.where(no_plane, 0.0, np.sqrt(dot(normal, normal)))
    return r_t, r_w, m2 + w * x2, x1 * ones, ratio(normal, size)


def h11(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """⟨r_tt, n⟩."""
    _, _, r_tt, _, normal = _patch(surface, t, w)
    return np.asarray(dot(r_tt, normal))


def mean_curvature(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """H = (h₁₁g₂₂ − 2h₁₂g₁₂ + h₂₂g₁₁)/(2 det g) from the partial derivatives of r."""
    r_t, r_w, r_tt, r_tw, normal = _patch(surface, t, w)
    g11, g12, g22 = dot(r_t, r_t), dot(r_t, r_w), dot(r_w, r_w)
    h11, h12 = dot(r_tt, normal), dot(r_tw, normal)
    return np.asarray((h11 * g22 - 2.0 * h12 * g12) / (2.0 * (g11 * g22 - g12**2)))


def angle_of_pitch(surface: RuledSurface) -> Array:
    """λ = −∮τ dt."""
    return np.array(surface.angle_of_pitch())


def pitch(surface: RuledSurface) -> Array:
    """Return l = −∮⟨c′, x⟩ dt, (10)."""
    return np.array(surface.pitch())


def both_pitches(surface: RuledSurface) -> Array:
    """Return λ and l as a pair."""
    both = surface.dual_angle_of_pitch()
    return np.array([both.real, both.dual])


def domain(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """1 where 0 ≤ u ≤ 2π and 0 ≤ v ≤ π, otherwise 0."""
    u, v = surface.curve.series(finite_array(t, "t"), 0).value
    within = (u >= 0.0) & (u <= 2.0 * math.pi) & (v >= 0.0) & (v <= math.pi)
    return np.asarray(within, dtype=np.float64)


def closing(surface: RuledSurface) -> Array:
    """‖b′(1) − b′(0)‖ as a fraction of the larger of the two: 0 for C¹."""
    start, end = (surface.curve.series(np.array(t), 1).derivatives()[1] for t in surface.domain)
    largest = np.maximum(np.hypot(*start), np.hypot(*end))
    return ratio(np.asarray(np.hypot(*(end - start))), largest)


# -- §4 --------------------------------------------------------------------------------------------


def kappa_bar(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """κ̄, the dual part of ‖X′‖."""
    return surface.invariants(t).kappa_bar


def tau(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """τ of (6)."""
    return surface.invariants(t).tau


def tau_bar(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """τ̄ of (6)."""
    return surface.invariants(t).tau_bar


def delta(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """δ = κ̄/κ."""
    return surface.invariants(t).delta


def cot_sigma(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """⟨m′, x₁⟩/⟨m′, x₃⟩: the slope of the striction curve against the ruling."""
    x, moment = line(surface, t, 2)
    tangent = striction(x, moment).derivative().value
    slope = x.derivative().value
    x3 = np.cross(x.value, ratio(slope, np.sqrt(dot(slope, slope))), axis=0)
    return ratio(dot(tangent, x.value), np.where(torsal(surface, t), 0.0, dot(tangent, x3)))


# -- one place, one surface ------------------------------------------------------------------------


def first(evaluation: Evaluation) -> Evaluation:
    """Return the value of a function of (surface, t) at t = 0, for a Bézier curve."""

    def at_start(surface: RuledSurface) -> Array:
        control_points(surface)
        return evaluation(surface, 0.0)

    return at_start


def on(key: str, evaluation: Evaluation) -> Evaluation:
    """Return the evaluation on a surface of the gallery, whatever surface is given."""
    return lambda surface, *places: evaluation(gallery.surface(key), *places)
