"""Tangent planes: how they turn along a ruling, and how the surface bends away from them.

Along a ruling the tangent plane holds x₁ and cos θ x₃ + sin θ x₂ with tan θ = w/δ, so it turns by
90° from the striction point to either end of the ruling, and K = −cos⁴θ/δ². In two directions
the surface has no normal curvature: the ruling, and the second asymptotic direction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .checks import Array, finite_array
from .surface import FundamentalForms, Invariants, RuledSurface, Undefined

__all__ = ["TangentPlanes", "tangent_planes"]

TORSAL = 1e-12
"""What is below this fraction of its size counts as 0: rounding would choose plane or direction."""

NO_PLANE = (
    "κ̄ = 0 and w = 0: the striction point of a torsal ruling, where the surface has no tangent "
    "plane"
)
NAMES = ("normal", "turn", "asymptotic", "angle", "gauss", "mean", "principal")


@dataclass(frozen=True, eq=False, slots=True)
class TangentPlanes:
    """Tangent planes and curvatures at points m + w x.

    All have the shape (*batch, *t.shape, *w.shape), vectors a last axis of 3; NaN where the
    surface has no tangent plane, see `undefined`.

    Attributes
    ----------
    point
        (…, 3) the points.
    normal
        (…, 3) the unit normal n = (κ̄x₂ − wκx₃)/W, where W² = κ̄² + w²κ².
    turn
        θ in radians, tan θ = w/δ, from −π/2 to π/2: the angle from the tangent plane of the
        striction point. On a torsal ruling it is ±π/2 for w ≠ 0.
    asymptotic
        (…, 3) the asymptotic direction that is not the ruling, a unit vector; on a torsal ruling
        the two are one. NaN in a flat point, where h₁₁ = h₁₂ = 0 and every direction is asymptotic.
    angle
        α in radians, from 0 to π, between x₁ and ``asymptotic``: cot α = ∓H/√(−K), the upper sign
        for κ̄ > 0. A right angle exactly where H = 0.
    gauss, mean
        K and H.
    principal
        (…, 2) the principal curvatures H ± √(H² − K), the greater first.
    forms
        both fundamental forms.
    """

    point: Array
    normal: Array
    turn: Array
    asymptotic: Array
    angle: Array
    gauss: Array
    mean: Array
    principal: Array
    forms: FundamentalForms
    _invariants: Invariants
    _flat: npt.NDArray[np.bool_]

    @property
    def undefined(self) -> tuple[Undefined, ...]:
        """Where there is no tangent plane, and why; empty where there is one everywhere."""
        tail = (1,) * (self._flat.ndim - self._invariants.kappa.ndim)
        reports, known = [], ~np.zeros_like(self._flat)
        for report in self._invariants.undefined:
            if report.names != ("sigma",):
                where = report.where.reshape(report.where.shape + tail)
                where = np.broadcast_to(where, known.shape)
                reports.append(Undefined(NAMES, where, report.reason))
                known = known & ~where
        reports.append(Undefined(NAMES, self._flat & known, NO_PLANE))
        return tuple(report for report in reports if report.where.any())


def tangent_planes(
    surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike = 0.0
) -> TangentPlanes:
    """Return tangent planes, asymptotic directions and curvatures on m + w x (paper, §2.4, (9)).

    The second asymptotic direction follows from h₁₁ dt + 2h₁₂ dw = 0; the first, dt = 0, is the
    ruling, since h₂₂ = 0.

    Parameters
    ----------
    surface
        the surface.
    t, w
        places along the curve and, from the striction point, along each ruling.
    """
    t, w = finite_array(t, "t"), finite_array(w, "w")
    invariants, forms = surface.invariants(t), surface.fundamental_forms(t, w)
    names = ("kappa", "kappa_bar", "tau_bar")
    k, kb, tb = (_spread(getattr(invariants, name), w) for name in names)
    x1, x2, x3 = np.moveaxis(_spread_rows(surface.frame(t), w), -2, 0)
    with np.errstate(all="ignore"):
        size = np.hypot(kb, w * k)
        flat = size <= TORSAL * np.sqrt(k**2 + kb**2 + tb**2)
        side = np.where(kb < 0, -1.0, 1.0)
        area = np.where(flat, np.nan, size)
        gauss, mean = -((k * kb / area**2) ** 2), (forms.h11 - 2 * forms.h12 * tb) / (2 * area**2)
        rate = _vectors(tb) * x1 + _vectors(w * k) * x2 + _vectors(kb) * x3
        way = _vectors(2 * forms.h12) * rate - _vectors(forms.h11) * x1
        sense = np.where(forms.h12 == 0, -np.sign(forms.h11), np.sign(forms.h12))
        length = np.linalg.norm(way, axis=-1)
        planar = length <= TORSAL * k * np.sqrt(forms.g11)
        asymptotic = _vectors(sense / np.where(planar, np.nan, length)) * way
        spread = np.sqrt(np.maximum(mean**2 - gauss, 0.0))
        angle = np.arctan2(np.sqrt(-gauss), -side * mean)
    return TangentPlanes(
        point=surface.points(t, w),
        normal=_known(forms.normal, flat),
        turn=np.where(flat, np.nan, np.arctan2(side * w * k, side * kb)),
        asymptotic=_known(asymptotic, flat),
        angle=np.where(planar, np.nan, np.where(gauss == 0, 0.0, angle)),
        gauss=gauss,
        mean=mean,
        principal=np.stack([mean + spread, mean - spread], axis=-1),
        forms=forms,
        _invariants=invariants,
        _flat=flat,
    )


def _spread(values: Array, w: Array) -> Array:
    """Append axes for w."""
    return np.asarray(values.reshape(values.shape + (1,) * w.ndim) * np.ones_like(w))


def _spread_rows(frame: Array, w: Array) -> Array:
    """Insert axes for w before the two of a frame."""
    return frame.reshape(frame.shape[:-2] + (1,) * w.ndim + (3, 3))


def _vectors(values: Array) -> Array:
    """Append an axis for vectors."""
    return values[..., None]


def _known(vectors: Array, flat: npt.NDArray[np.bool_]) -> Array:
    return np.where(flat[..., None], np.nan, vectors)
