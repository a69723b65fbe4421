"""The motion of the frame: instantaneous screw, frame equations, striction arc length.

The frame X₁, X₂, X₃ moves as a rigid body with X_i′ = D̂ × X_i, D̂ = τ̂X₁ + κ̂X₃ (Darboux's dual
vector; paper, (4)): at each t it turns about the line of D̂ and slides along it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .checks import Array, GeometryError, finite_array, frozen
from .dual import Dual, cross, norm
from .jet import measure
from .line import Line
from .quadrature import Primitive
from .series import Series
from .surface import RuledSurface

__all__ = [
    "FrameEquations",
    "Screw",
    "StrictionLength",
    "dual_frame",
    "frame_equations",
    "screw",
]


@dataclass(frozen=True, eq=False, slots=True)
class Screw:
    """The instantaneous screw of the frame; all of shape (*batch, *t.shape).

    Attributes
    ----------
    axis
        the line of D̂, oriented so that the frame turns about it in the positive sense.
    angular_speed
        √(κ² + τ²), radians per unit of t.
    pitch
        (κκ̄ + ττ̄)/(κ² + τ²), the way along the axis for each radian; 0 is a pure rotation.
    point
        (…, 3) the point m + ((κτ̄ − τκ̄)/(κ² + τ²)) x₂ of the axis nearest to the striction point m:
        the axis meets X₂ there at right angles.
    """

    axis: Line
    angular_speed: Array
    pitch: Array
    point: Array


def screw(surface: RuledSurface, t: npt.ArrayLike) -> Screw:
    """Return the instantaneous screw of the frame at t; NaN where κ = 0, as there is no frame."""
    inv, frame, m = surface.invariants(t), surface.frame(t), surface.striction(t)
    with np.errstate(all="ignore"):
        speed = np.hypot(inv.kappa, inv.tau)
        turn, advance = (
            (along / speed)[..., np.newaxis] * frame[..., 0, :]
            + (across / speed)[..., np.newaxis] * frame[..., 2, :]
            for along, across in ((inv.tau, inv.kappa), (inv.tau_bar, inv.kappa_bar))
        )
        # At m the frame moves with m′, and its rotation by ω: the axis runs at ω × m′/ω² from m.
        point = m + np.cross(turn, advance)
        pitch = (turn * advance).sum(axis=-1)
    return Screw(
        Line.unchecked(turn, np.cross(point, turn)), frozen(speed), frozen(pitch), frozen(point)
    )


@dataclass(frozen=True, eq=False, slots=True)
class FrameEquations:
    """Both sides of X₁′ = κ̂X₂, X₂′ = −κ̂X₁ + τ̂X₃, X₃′ = −τ̂X₂ (paper, (4) and (5), mended).

    Attributes
    ----------
    left, right
        (…, 3, 2, 3): equation, real or dual part, entry.
    """

    left: Array
    right: Array

    @property
    def residual(self) -> Array:
        """(…, 3, 2) the length of left − right, for each equation and part."""
        result: Array = np.linalg.norm(self.left - self.right, axis=-1)
        return result


def frame_equations(surface: RuledSurface, t: npt.ArrayLike) -> FrameEquations:
    """Return both sides of the frame equations at t, for one surface.

    Left is the frame differentiated, X₂ = X′/‖X′‖ and X₃ = X₁ × X₂ as dual series of t; right is
    put together from the frame and κ̂, τ̂ as `RuledSurface.invariants` has them. So the residual is
    rounding. NaN where κ = 0.
    """
    places = finite_array(t, "t")
    with np.errstate(all="ignore"):
        jet = surface.jet(places.reshape(-1), 2)
        frame = dual_frame(jet.rows)
        left = np.stack([_parts(Dual(x.real.derivative(), x.dual.derivative())) for x in frame])
        kappa, kappa_bar, tau, tau_bar = measure(jet)[0][:4, :, np.newaxis]
        x1, x2, x3 = (Dual(x.real.value, x.dual.value) for x in frame)
        kappa_hat, tau_hat = Dual(kappa, kappa_bar), Dual(tau, tau_bar)
        right = np.stack(
            [_parts(x) for x in (kappa_hat * x2, tau_hat * x3 - kappa_hat * x1, -tau_hat * x2)]
        )
    shape = (*places.shape, 3, 2, 3)
    return FrameEquations(*(frozen(np.moveaxis(a, 2, 0).reshape(shape)) for a in (left, right)))


def dual_frame(rows: Array) -> tuple[Dual, Dual, Dual]:
    """Return X₁, X₂, X₃ as dual vectors of series of t, shape (N, 3).

    Parameters
    ----------
    rows
        those of a `Jet`, (order+1, 2, 3, N): X₂ and X₃ have one order less. Not finite where κ = 0.
    """
    factorials = np.array([math.factorial(k) for k in range(len(rows))], dtype=np.float64)
    real, dual = np.moveaxis(rows / factorials.reshape(-1, 1, 1, 1), 1, 0).swapaxes(-1, -2)
    x1 = Dual(Series(real), Series(dual))
    slope = Dual(x1.real.derivative(), x1.dual.derivative())
    x2 = Dual(*_divided(slope, norm(slope)))
    return x1, x2, cross(x1, x2)


def _divided(vector: Dual, length: Dual) -> tuple[Series, Series]:
    size, stretch = length.real[..., np.newaxis], length.dual[..., np.newaxis]
    real = vector.real / size
    return real, (vector.dual - real * stretch) / size


def _parts(vector: Dual) -> Array:
    """Return (2, N, 3) the values of both parts."""
    parts = (vector.real, vector.dual)
    return np.stack([part.value if isinstance(part, Series) else part for part in parts])


class StrictionLength:
    """The striction curve's arc length s(t) = ∫√(κ̄² + τ̄²) dt and its inverse t(s).

    Parameters
    ----------
    surface
        one surface.

    Raises
    ------
    GeometryError
        where the integral does not converge, as where κ comes down to 0 inside the domain.
    """

    __slots__ = ("_length",)

    def __init__(self, surface: RuledSurface) -> None:
        def speed(t: Array) -> Array:
            with np.errstate(all="ignore"):
                values = measure(surface.jet(t))[0]
                return np.asarray(np.hypot(values[1], values[3]))

        self._length = Primitive(speed, *surface.domain, "the striction arc length")

    @property
    def total(self) -> float:
        """Length of the whole striction curve."""
        return self._length.total

    def s(self, t: npt.ArrayLike) -> Array:
        """Return s at t, from 0 at the start of the domain; of the shape of t."""
        return self._length(finite_array(t, "t"))

    def t(self, s: npt.ArrayLike) -> Array:
        """Return t at s, for 0 ≤ s ≤ `total`; where the striction point rests, one of its t.

        Raises
        ------
        GeometryError
            where s lies outside, or the striction curve is a single point (a cone).
        """
        lengths = finite_array(s, "s")
        if not self.total > 0.0:
            raise GeometryError(
                "`s` must be measured along a striction curve; this one is a single point, the "
                "apex of a cone; use t instead"
            )
        slack = 1e-12 * self.total
        if lengths.size and not (-slack <= lengths.min() and lengths.max() <= self.total + slack):
            raise GeometryError(
                f"`s` must lie between 0 and {self.total:.6g}, the length of the striction curve; "
                f"got {lengths.min():.6g} to {lengths.max():.6g}"
            )
        inside = np.clip(lengths, 0.0, self.total)
        return self._length.inverse(inside.reshape(-1)).reshape(lengths.shape)
