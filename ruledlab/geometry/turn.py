"""One turn of a closed surface, shown: what returns with a gap, and what it encloses.

The pitch l is the gap of an orthogonal trajectory, the angle of pitch λ that of the vector ξ which
spans a developable (paper, §2.5). Gauss and Bonnet make λ an area on the sphere, Stokes makes l a
flux through it. Steiner's vector gives both for every line that the frame carries along.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import closed
from .checks import CLOSING, Array, GeometryError, finite_array, frozen
from .congruence import Congruence
from .dual import Dual
from .jet import Jet, measure
from .line import Line
from .motion import dual_frame
from .quadrature import Primitive, edges, estimate, integrals, integrate
from .series import Series
from .surface import RuledSurface

__all__ = [
    "Enclosed",
    "Trajectory",
    "Turning",
    "carried",
    "enclosed",
    "steiner",
    "steiner_angle",
    "trajectory",
    "turning",
    "winding_numbers",
]

SAMPLES = 257
"""Places of t at which a path is drawn if none are asked for."""

STRIPS = 8
"""Panels of t to begin with, where strips of the enclosed region are added up."""

GIVEN_UP = 1e-3
"""A flux of which less is certain counts as none."""


# -- what returns with a gap -----------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Trajectory:
    """A curve that crosses every ruling at right angles.

    Attributes
    ----------
    t
        as asked for.
    w
        how far along the ruling from the striction point, w′ = −τ̄; NaN where κ = 0.
    points
        (*t.shape, 3) the curve.
    gap
        how far along the ruling it ends from where a closed surface began: the pitch l. On an open
        surface, −∫⟨c′, x⟩ dt over the domain.
    """

    t: Array
    w: Array
    points: Array
    gap: float


def trajectory(
    surface: RuledSurface, w0: float = 0.0, t: npt.ArrayLike | None = None
) -> Trajectory:
    """Return the orthogonal trajectory that starts at m + w0 x on the first ruling.

    It is found from w′ = −⟨c′, x⟩, w counted from the foot point c, which needs no striction
    point on its way.

    Raises
    ------
    GeometryError
        where the first ruling has no striction point to count ``w0`` from.
    """
    places = _places(surface, t)
    start, end = surface.domain
    way = Primitive(lambda s: _advance(surface, s), start, end, "the orthogonal trajectory")
    first, shift = _shift(surface, np.array(start)), _shift(surface, places)
    if not np.isfinite(first):
        raise GeometryError(
            "`w0` must be counted from a striction point; the first ruling has none, as κ = 0 "
            "there; start the curve elsewhere"
        )
    from_foot = float(finite_array(w0, "w0")) + float(first) - way(places)
    points = surface.foot(places) + from_foot[..., np.newaxis] * surface.line(places).direction
    return Trajectory(frozen(places), frozen(from_foot - shift), frozen(points), -way.total)


def _advance(surface: RuledSurface, t: Array) -> Array:
    """Return ⟨c′, x⟩ = ⟨x × x′, x̄⟩."""
    with np.errstate(all="ignore"):
        return closed.along(surface.jet(t, 1))


def _shift(surface: RuledSurface, t: Array) -> Array:
    """Return ⟨m − c, x⟩."""
    away = surface.striction(t) - surface.foot(t)
    return np.asarray((away * surface.line(t).direction).sum(axis=-1))


@dataclass(frozen=True, eq=False, slots=True)
class Turning:
    """The unit vector ξ = cos φ x₂ + sin φ x₃ with ξ′ along x₁, normal to the ruling.

    Attributes
    ----------
    t
        as asked for.
    phi
        φ in radians, φ′ = −τ, not wrapped.
    xi
        (*t.shape, 3) the vector: drawn from the striction point it shows the plane that turns.
    gap
        how far φ ends from where it began: the angle of pitch λ of a closed surface.
    """

    t: Array
    phi: Array
    xi: Array
    gap: float


def turning(surface: RuledSurface, phi0: float = 0.0, t: npt.ArrayLike | None = None) -> Turning:
    """Return ξ along the surface, with φ = ``phi0`` on the first ruling.

    Raises
    ------
    GeometryError
        where κ comes down to 0, and with it x₂ and τ are lost.
    """
    places = _places(surface, t)

    def tau(s: Array) -> Array:
        with np.errstate(all="ignore"):
            return np.asarray(measure(surface.jet(s))[0][2])

    turn = Primitive(tau, *surface.domain, "the angle of pitch")
    phi = float(finite_array(phi0, "phi0")) - turn(places)
    frame, angle = surface.frame(places), phi[..., np.newaxis]
    xi = np.cos(angle) * frame[..., 1, :] + np.sin(angle) * frame[..., 2, :]
    return Turning(frozen(places), frozen(phi), frozen(xi), -turn.total)


def _places(surface: RuledSurface, t: npt.ArrayLike | None) -> Array:
    return np.linspace(*surface.domain, SAMPLES) if t is None else finite_array(t, "t")


# -- what is enclosed ------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Enclosed:
    """The region of the chart that a closed surface's curve encloses, and what it says of l and λ.

    Attributes
    ----------
    tau, tau_bar
        ∮τ dt = −λ and ∮τ̄ dt = −l, from the surface itself.
    area
        ∬ sin v du dv over the region: the area on the unit sphere, each part counted as often as
        the curve runs round it counter-clockwise in the chart (u to the right, v upwards).
    flux
        ∬ (ū_u + v̄_v + v̄ cot v) sin v du dv over the same region.
    turns
        how often the tangent turns counter-clockwise in the chart: ±1 for a simple loop.
    corner
        the exterior angle at the seam, seen from outside the sphere, positive to the left; 0 for
        a surface that closes with C¹.
    winding
        how often the curve goes round the axis. If it does, the region is the strip between the
        curve and the equator v = π/2.
    border
        ∫ sin v (ū dv − v̄ du) along the outline's way back; 0 without winding.
    off
        how far off ``flux`` may be. Below 1e-9 unless the divergence is so rough within the region
        that its integral was given up before: an edge of ū, v̄ that crosses the curve is no
        obstacle, one that lies across it like a ring, or a root, may be.
    outline
        (N, 2) the region's border in the chart: the curve, and with winding the way back along a
        meridian, the equator and a meridian.
    """

    tau: float
    tau_bar: float
    area: float
    flux: float
    turns: int
    corner: float
    winding: int
    border: float
    off: float
    outline: Array

    @property
    def tau_from_area(self) -> float:
        """∮τ dt after Gauss and Bonnet: area − 2π turns − corner."""
        return self.area - 2.0 * math.pi * self.turns - self.corner

    @property
    def tau_bar_from_flux(self) -> float:
        """∮τ̄ dt after Stokes: flux + border."""
        return self.flux + self.border


def enclosed(surface: RuledSurface) -> Enclosed:
    """Return the enclosed region of a closed surface from the chart, with ∮τ and ∮τ̄ beside it.

    The flux is a double integral over the region itself: for each t along the meridian from the
    region's base, v = v(0) or the equator, to the curve. So the divergence of ū, v̄ must have an
    integral between base and curve.

    Raises
    ------
    GeometryError
        where the surface is not from the chart or does not close as a moving oriented line, or an
        integral does not converge.
    """
    curve = surface.curve
    total = surface.dual_angle_of_pitch()
    ends = curve.series(np.array(surface.domain), 0).value
    winding = round(float(ends[0, 1] - ends[0, 0]) / (2.0 * math.pi))
    base = math.pi / 2 if winding else float(ends[1, 0])
    area, turned = integrate(
        lambda t: _zones(surface, t, base), *surface.domain, "the enclosed area"
    )
    flux, off = _flux(surface, base)
    jump = _corner(surface)
    return Enclosed(
        -float(total.real),
        -float(total.dual),
        float(area),
        flux,
        round((float(turned) + jump) / (2.0 * math.pi)),
        0.0 - jump,
        winding,
        _border(surface, ends, base) if winding else 0.0,
        off,
        _outline(surface, ends, base, winding),
    )


def _zones(surface: RuledSurface, t: Array, base: float) -> Array:
    """Return, per unit of t, the area between base and curve, and the turning ψ′ of the tangent.

    The zone between two parallels has, per unit of u, the area |cos v₁ − cos v₂| (Archimedes). ψ is
    the angle of the tangent in the frame of parallel and meridian, (u′ sin v, v′).
    """
    with np.errstate(all="ignore"):
        (_, v), (du, dv), (ddu, ddv) = surface.curve.series(t, 2).derivatives()
        sine, cosine = np.sin(v), np.cos(v)
        bend = du * sine * ddv - dv * (ddu * sine + du * dv * cosine)
        return np.stack([du * (cosine - math.cos(base)), bend / ((du * sine) ** 2 + dv**2)])


def _flux(surface: RuledSurface, base: float) -> tuple[float, float]:
    """Return ∬ (ū_u + v̄_v + v̄ cot v) sin v du dv, and how far off it may be."""
    start, end = surface.domain

    def borders(t: Array) -> Array:
        u, v = surface.curve.series(t, 0).value
        return np.stack([_density(surface, u, v), _density(surface, u, np.full_like(v, base))])

    def strips(t: Array) -> tuple[Array, Array]:
        (u, v), (du, _) = surface.curve.series(t, 1).derivatives()
        inner, off = integrals(
            lambda w, strip: _density(surface, u[strip], w), np.full_like(v, base), v
        )
        return -du * inner, np.abs(du) * off

    # Where an edge of the divergence leaves the region, the strips have an edge as well.
    between = edges(borders, start, end)
    flux, off = estimate(strips, np.union1d(np.linspace(start, end, STRIPS + 1), between))
    if not off <= GIVEN_UP * max(1.0, abs(flux)):
        raise GeometryError(
            "the flux does not converge: the divergence ū_u + v̄_v + v̄ cot v is undefined or "
            "unbounded in the enclosed region; choose ū, v̄ that are smooth there"
        )
    return flux, off


def _density(surface: RuledSurface, u: Array, v: Array) -> Array:
    """Return the divergence times sin v: the flux per unit of u and v."""
    with np.errstate(all="ignore"):
        return np.asarray(Congruence(surface.ubar, surface.vbar).divergence(u, v) * np.sin(v))


def _corner(surface: RuledSurface) -> float:
    """Return the jump of ψ over the seam, in (−π, π]; rounding is no jump."""
    angles = surface.curve.series(np.array(surface.domain), 1).derivatives()
    (_, v), (du, dv) = angles
    first, last = np.arctan2(dv, du * np.sin(v))
    jump = math.remainder(float(first - last), 2.0 * math.pi)
    return 0.0 if abs(jump) <= CLOSING else jump


def _way_back(ends: Array, base: float) -> list[Array]:
    """Return the three legs from the curve's end to its start, each (2, 2): (u, v) from and to."""
    (u0, u1), (v0, v1) = ends
    corners = np.array([[u1, v1], [u1, base], [u0, base], [u0, v0]])
    return [corners[k : k + 2] for k in range(3)]


def _border(surface: RuledSurface, ends: Array, base: float) -> float:
    """Return ∫ sin v (ū dv − v̄ du) along the way back, run from the curve's start to its end."""
    total = 0.0
    for start, stop in _way_back(ends, base):
        step = stop - start

        def form(s: Array, start: Array = start, step: Array = step) -> Array:
            u, v = start[:, np.newaxis] + s * step[:, np.newaxis]
            value = np.sin(v) * (surface.ubar(u, v) * step[1] - surface.vbar(u, v) * step[0])
            return np.asarray(value)

        if step.any():
            total -= float(integrate(form, 0.0, 1.0, "the flux's border"))
    return total


def _outline(surface: RuledSurface, ends: Array, base: float, winding: int) -> Array:
    t = np.linspace(*surface.domain, SAMPLES)
    curve = surface.curve.series(t, 0).value.T
    back = [leg[1:] for leg in _way_back(ends, base)] if winding else []
    return frozen(np.concatenate([curve, *back]))


def winding_numbers(outline: npt.ArrayLike, points: npt.ArrayLike) -> npt.NDArray[np.int_]:
    """Return how often a closed polygon runs round each point, counter-clockwise positive.

    Parameters
    ----------
    outline
        (N, 2) the polygon's corners; the last is joined to the first.
    points
        (…, 2); on the polygon itself either side may be reported.
    """
    a, p = finite_array(outline, "outline"), finite_array(points, "points")
    b = np.roll(a, -1, axis=0)
    x, y = p[..., 0, np.newaxis], p[..., 1, np.newaxis]
    side = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
    upward = (a[:, 1] <= y) & (b[:, 1] > y) & (side > 0.0)
    downward = (a[:, 1] > y) & (b[:, 1] <= y) & (side < 0.0)
    return np.asarray(upward.sum(axis=-1) - downward.sum(axis=-1))


# -- lines that the frame carries along ------------------------------------------------------------


def steiner(surface: RuledSurface) -> Dual:
    """Return Steiner's dual vector ∮(τ̂X₁ + κ̂X₃) dt in the moving frame: (∮τ̂, 0, ∮κ̂).

    The integral is taken where the frame rests, so that X₁ and X₃ are constant.

    Raises
    ------
    GeometryError
        where the surface does not close or its frame does not come back, as at a corner (C⁰); or
        where the frame jumps on its way, as the striction point does at an edge of ū or v̄.
    """
    _require_frame_back(surface)

    def rates(t: Array) -> Array:
        with np.errstate(all="ignore"):
            jet = surface.jet(t)
            values = measure(jet)[0][:4]
            speed = np.hypot(values[1], values[3])
            return np.stack([*values, values[3] - closed.along(jet), speed])

    found = integrate(rates, *surface.domain, "Steiner's vector")
    kappa, kappa_bar, tau, tau_bar, drift, length = found.tolist()
    closed.require_steady(surface, drift, length, "Steiner's vector")
    return Dual(np.array([tau, 0.0, kappa]), np.array([tau_bar, 0.0, kappa_bar]))


def steiner_angle(surface: RuledSurface, line: Line) -> Dual:
    """Return Λ = −⟨D̂, Y⟩, the dual angle of pitch of a line Y that the frame carries round.

    Parameters
    ----------
    line
        in the frame's coordinates: components along x₁, x₂, x₃, moment about the striction point.
        X₁, X₂, X₃ themselves have −∮τ̂, 0 and −∮κ̂.

    Notes
    -----
    The dual part is the pitch of the surface that the line sweeps (see `carried`): with the frame's
    instantaneous screw ω̂ = τ̂X₁ + κ̂X₃, ⟨ω̂, Y⟩ says at every t how fast Y runs along itself.

    The real part says how far a vector that is not turned about the line gains on the moving frame.
    The swept surface's own −∮τ counts it against the tangent y′ = ω × y of the path of y. As
    κ > 0, ω = τx₁ + κx₃ stays in a half plane of the frame, and so does its part at right angles to
    y: the tangent goes nowhere round y, and −∮τ of the swept surface is this real part + α, where
    |α| < π is the corner of the path of y at the seam, positive to the left seen from outside. It
    is the angle about y from the part of ω at right angles to y at the end to that at the start. So
    α = 0 if τ/κ passes the seam without a jump, as at a C² seam, and for every y at right angles
    to x₂, as then that part keeps its line. Only such a y can lie along ω and rest at some t, with
    τ undefined there and its integral none the worse.
    """
    vector = steiner(surface)
    real = (vector.real * line.direction).sum(axis=-1)
    dual = (vector.real * line.moment + vector.dual * line.direction).sum(axis=-1)
    return Dual(-real, -dual)


def carried(surface: RuledSurface, line: Line) -> RuledSurface:
    """Return the surface swept by a line that the frame of ``surface`` carries along.

    Parameters
    ----------
    line
        one line, in the frame's coordinates as for `steiner_angle`.
    """
    if line.shape:
        raise GeometryError(
            f"`line` must be a single line; got a batch of shape {line.shape}; take one of them"
        )
    return RuledSurface.from_source(_Carried(surface, line))


@dataclass(frozen=True, eq=False, slots=True)
class _Carried:
    """The source Y = Σ ŷᵢXᵢ with constant dual ŷᵢ."""

    surface: RuledSurface
    line: Line

    @property
    def domain(self) -> tuple[float, float]:
        return self.surface.domain

    @property
    def batch_shape(self) -> tuple[int, ...]:
        return ()

    @property
    def singular(self) -> str:
        return "κ = 0 on the first surface: its frame, which carries the line, is lost there"

    @property
    def origin(self) -> str:
        return "the frame that carries the line"

    def jet(self, t: Array, order: int = 2) -> Jet:
        places = np.asarray(t, dtype=np.float64)
        with np.errstate(all="ignore"):
            jet = self.surface.jet(places.reshape(-1), order + 1)
            terms = [
                Dual(float(real), float(dual)) * vector
                for real, dual, vector in zip(
                    self.line.direction, self.line.moment, dual_frame(jet.rows), strict=True
                )
            ]
            total = terms[0] + terms[1] + terms[2]
            parts = [_rows(part, order) for part in (total.real, total.dual)]
        rows = np.stack(parts, axis=1).reshape(order + 1, 2, 3, *places.shape)
        return Jet(rows, jet.scale, np.asarray(~np.isfinite(rows).all(axis=(0, 1, 2))))


def _rows(part: Series, order: int) -> Array:
    """Return derivatives (order+1, 3, N) of a series of shape (N, 3)."""
    return part.truncated(order).derivatives().swapaxes(-1, -2)


def _require_frame_back(surface: RuledSurface) -> None:
    state = closed.closure(surface)
    ends = np.array(surface.domain)
    frame, m = surface.frame(ends), surface.striction(ends)
    reach = 1.0 + float(np.linalg.norm(m[0]))
    gap = max(float(np.abs(np.diff(frame, axis=0)).max()), float(np.abs(m[1] - m[0]).max()) / reach)
    if not (state.oriented and gap <= 1e3 * CLOSING):
        raise GeometryError(
            "Steiner's vector needs a frame that comes back after one turn; this one: "
            f"{state.reason}; close the curve with C¹"
        )
