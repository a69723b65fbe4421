"""The paper read with a computer: what is printed beside what the definitions give.

Each `Finding` holds one formula of F. Taş, *On the Design and Invariants of a Ruled Surface*, two
times: as it is printed, and as it follows from the definitions (3) to (8). Both can be evaluated
on any design, so that the difference can be seen instead of believed. What is printed is evaluated
literally, from u, v, ū, v̄ and their derivatives; what is right is taken from the definitions,
without the formula in question. The ideas of the paper are untouched by any of this, and most of
its formulas stand as printed: `CONFIRMED` names them.

Conventions: x̄ = c × x, μ = ⟨m − c, x⟩ is the place of the striction point on the ruling, seen from
the foot point c. Values that are undefined are NaN.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .geometry import Bezier, GeometryError, RuledSurface, Series, cross, gallery, inner
from .geometry.checks import Array, finite_array
from .geometry.quadrature import integrate

__all__ = ["CONFIRMED", "PRINTED", "REMARKS", "TRIED", "Finding", "Note", "finding"]

Evaluation = Callable[..., Array]
"""(surface, t), (surface, t, w) or (surface): see `Finding.over`."""

Over = Literal["t", "t, w", "surface"]


@dataclass(frozen=True, slots=True)
class Finding:
    """A printed formula and the one that the definitions give.

    Attributes
    ----------
    key
        short name.
    place
        where it stands in the paper.
    quantity
        what it is a formula for, in words and symbols.
    printed_latex, corrected_latex
        both formulas, without dollar signs.
    printed, corrected
        both as functions. What they take is told by ``over``; the shapes are (*t.shape) or
        (*t.shape, *w.shape), with a last axis where the quantity is a vector or a pair.
    how_to_see
        how a reader can notice it, and check it.
    agreement
        when the printed formula nevertheless gives the right value.
    over
        ``"t"``: functions of (surface, t). ``"t, w"``: of (surface, t, w). ``"surface"``: of the
        surface alone.
    design
        the gallery's key of a design that shows it well.
    only
        True where the statement is about ``design`` alone: both functions then look at that
        design, whatever surface they are given.
    """

    key: str
    place: str
    quantity: str
    printed_latex: str
    corrected_latex: str
    printed: Evaluation
    corrected: Evaluation
    how_to_see: str
    agreement: str
    over: Over = "t"
    design: str = "example_2"
    only: bool = False

    def difference(self, surface: RuledSurface, *places: npt.ArrayLike) -> Array:
        """Return printed − corrected; the arguments are those of the two functions."""
        result: Array = self.printed(surface, *places) - self.corrected(surface, *places)
        return result


@dataclass(frozen=True, slots=True)
class Note:
    """A place in the paper, or what was varied in `TRIED`, and a sentence about it."""

    place: str
    text: str


def finding(key: str) -> Finding:
    """Return the finding with this key.

    Raises
    ------
    GeometryError
        if there is none.
    """
    by_key = {entry.key: entry for entry in PRINTED}
    if key not in by_key:
        raise GeometryError(f"`key` must be one of {', '.join(by_key)}; got {key!r}")
    return by_key[key]


# -- what the formulas are made of -----------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Chart:
    """u, v with two derivatives by t, and ū, v̄ with their partial derivatives by u and v."""

    u: Array
    v: Array
    du: Array
    dv: Array
    ddu: Array
    ddv: Array
    ubar: Array
    vbar: Array
    ubar_u: Array
    ubar_v: Array
    vbar_u: Array
    vbar_v: Array

    @property
    def square(self) -> Array:
        """κ² = u′² sin²v + v′²."""
        return np.asarray(self.du**2 * np.sin(self.v) ** 2 + self.dv**2)

    @property
    def stretch(self) -> Array:
        """κκ̄, the numerator of (19)."""
        sine, cosine = np.sin(self.v), np.cos(self.v)
        along = self.du**2 * sine * (self.vbar * cosine + self.ubar_u * sine)
        mixed = self.du * self.dv * (self.vbar_u + self.ubar_v * sine**2)
        return np.asarray(along + mixed + self.dv**2 * self.vbar_v)

    @property
    def advance(self) -> Array:
        """⟨c′, x⟩ = sin v (ū v′ − v̄ u′)."""
        return np.asarray(np.sin(self.v) * (self.ubar * self.dv - self.vbar * self.du))


def _chart(surface: RuledSurface, t: npt.ArrayLike) -> _Chart:
    t = finite_array(t, "t")
    (u, v), (du, dv), (ddu, ddv) = surface.curve.series(t, 2).derivatives()
    fields = (surface.ubar, surface.vbar)
    with np.errstate(all="ignore"):
        values = [np.broadcast_to(f(u, v), u.shape) for f in fields]
        values += [slope for f in fields for slope in f.partials(u, v)]
    finite = (np.where(np.isfinite(value), value, np.nan) for value in values)
    return _Chart(u, v, du, dv, ddu, ddv, *finite)


def _line(surface: RuledSurface, t: npt.ArrayLike, order: int) -> tuple[Series, Series]:
    """Return x and x̄ as series whose values have the shape (3, *t.shape)."""
    jet = surface.jet(finite_array(t, "t"), order)
    factors = np.array([1.0 / math.factorial(k) for k in range(order + 1)])
    rows = jet.rows * factors.reshape(-1, *(1,) * (jet.rows.ndim - 1))
    rows = np.where(jet.pole, np.nan, rows)
    return Series(rows[:, 0]), Series(rows[:, 1])


def _striction(x: Series, moment: Series) -> Series:
    """Return m = c − (⟨x′, c′⟩/⟨x′, x′⟩) x by its definition, of an order lower by one."""
    foot, slope = cross(x, moment, 0), x.derivative()
    result: Series = foot - _dot(slope, foot.derivative()) / _dot(slope, slope) * x
    return result


def _dot(a: Any, b: Any) -> Any:
    return inner(a, b, 0)


def _ratio(above: Array, below: Array) -> Array:
    """Return the quotient, NaN where the denominator is 0."""
    result: Array = above / np.where(below == 0.0, np.nan, below)
    return result


def _last(vectors: Array) -> Array:
    return np.moveaxis(vectors, 0, -1)


def _around(surface: RuledSurface, integrand: Callable[[Array], Array], what: str) -> Array:
    """Return the integral round a surface that closes."""
    state = surface.closure()
    if not state.oriented:
        raise GeometryError(
            f"`surface` must close as a moving oriented line for {what}; this one: {state.reason}; "
            "take a closed design such as gallery.surface('example_2')"
        )
    return np.asarray(integrate(lambda t: integrand(t)[np.newaxis], *surface.domain, what)[0])


def _control_points(surface: RuledSurface) -> Array:
    curve = surface.curve
    if isinstance(curve, Bezier) and not curve.batch_shape:
        return curve.points
    raise GeometryError(
        f"`surface` must have a single Bézier curve: the formulas of §4.2 speak of its control "
        f"points; got {curve!r}; take a design with a Bezier curve"
    )


def _at_start(surface: RuledSurface) -> tuple[int, Array, Array, _Chart]:
    """Return n, p₁ − p₀, p₂ − 2p₁ + p₀ (zero for n = 1) and the chart at t = 0."""
    points = _control_points(surface)
    n = len(points) - 1
    bend = points[2] - 2.0 * points[1] + points[0] if n > 1 else np.zeros(2)
    return n, points[1] - points[0], bend, _chart(surface, 0.0)


# -- §2: the moving frame and the patch ------------------------------------------------------------


def _x2bar_prime(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """x̄₂′ by differentiating x̄₂ = (x̄′ − κ̄ x₂)/κ, the dual part of X₂ = X′/κ̂."""
    x, moment = _line(surface, t, 2)
    slope, moment_slope = x.derivative(), moment.derivative()
    kappa = np.sqrt(_dot(slope, slope))
    x2 = slope / kappa
    x2bar = (moment_slope - _dot(x2, moment_slope) * x2) / kappa
    return _last(x2bar.derivative().value)


def _x2bar_prime_printed(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    x1, x2, x3 = np.moveaxis(surface.frame(t), -2, 0)
    m, inv = surface.striction(t), surface.invariants(t)
    kappa, kappa_bar, tau, tau_bar = (
        value[..., np.newaxis] for value in (inv.kappa, inv.kappa_bar, inv.tau, inv.tau_bar)
    )
    x1bar, x2bar = np.cross(m, x1), np.cross(m, x2)
    return np.asarray(-kappa_bar * x1 + tau_bar * x3 - kappa * x1bar + tau * x2bar)


def _x3_length_printed(surface: RuledSurface) -> Array:
    lengths = surface.arc_lengths()
    return np.array([lengths.tau, lengths.tau_bar])


def _x3_length(surface: RuledSurface) -> Array:
    length = surface.arc_lengths().x3
    return np.array([length.real, length.dual])


def _spread(values: Array, w: Array) -> Array:
    return values.reshape(values.shape + (1,) * w.ndim)


def _bending(surface: RuledSurface, t: npt.ArrayLike, w: Array) -> tuple[Array, ...]:
    """Return κ, κ̄, τ, τ̄, κ′, κ̄′ and W = √(κ̄² + w²κ²), NaN for 0, ready to meet w."""
    inv = surface.invariants(t)
    names = ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
    values = [_spread(getattr(inv, name), w) for name in names]
    area = np.hypot(values[1], w * values[0])
    return *values, np.where(area == 0.0, np.nan, area)


def _h11_printed(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    w = finite_array(w, "w")
    kappa, kappa_bar, tau, tau_bar, dk, dkb, area = _bending(surface, t, w)
    first = kappa_bar * (tau_bar + w * dk - tau)
    return np.asarray((first - w * kappa * (w * kappa * tau + dkb)) / area)


def _mean_printed(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    w = finite_array(w, "w")
    kappa, kappa_bar, _, tau_bar, _, _, area = _bending(surface, t, w)
    h11 = _h11_printed(surface, t, w)
    return np.asarray((h11 - 2.0 * kappa * kappa_bar * tau_bar / area) / (2.0 * area**2))


def _patch(
    surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike
) -> tuple[Array, Array, Array, Array, Array]:
    """Return r_t, r_w, r_tt, r_tw and the unit normal of r = m + w x by differentiation."""
    w = finite_array(w, "w")
    x, moment = _line(surface, t, 3)
    m0, m1, m2 = (_spread(row, w) for row in _striction(x, moment).derivatives())
    x0, x1, x2 = (_spread(row, w) for row in x.derivatives()[:3])
    ones = np.ones_like(m0 * w)
    r_t, r_w = m1 + w * x1, x0 * ones
    normal = np.cross(r_t, r_w, axis=0)
    *_, area = _bending(surface, t, w)  # NaN where there is no tangent plane
    size = np.where(np.isnan(area), 0.0, np.sqrt(_dot(normal, normal)))
    return r_t, r_w, m2 + w * x2, x1 * ones, _ratio(normal, size)


def _h11(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    _, _, r_tt, _, normal = _patch(surface, t, w)
    return np.asarray(_dot(r_tt, normal))


def _mean(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """H = (h₁₁g₂₂ − 2h₁₂g₁₂ + h₂₂g₁₁)/(2 det g) from the partial derivatives of r."""
    r_t, r_w, r_tt, r_tw, normal = _patch(surface, t, w)
    g11, g12, g22 = _dot(r_t, r_t), _dot(r_t, r_w), _dot(r_w, r_w)
    h11, h12 = _dot(r_tt, normal), _dot(r_tw, normal)
    return np.asarray((h11 * g22 - 2.0 * h12 * g12) / (2.0 * (g11 * g22 - g12**2)))


def _g11_printed(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    w = finite_array(w, "w")
    _, _, _, tau_bar, _, _, area = _bending(surface, t, w)
    return np.asarray(tau_bar**2 + area**2)


def _g11_from_foot(surface: RuledSurface, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
    """⟨r_t, r_t⟩ of r = c + w x, with the foot point c = x × x̄ as the base curve."""
    w = finite_array(w, "w")
    x, moment = _line(surface, t, 1)
    foot = cross(x, moment, 0)
    r_t = _spread(foot.derivative().value, w) + w * _spread(x.derivative().value, w)
    return np.asarray(_dot(r_t, r_t))


# -- §2.5 and §4.1: the integral invariants --------------------------------------------------------


def _turning(surface: RuledSurface, t: Array) -> Array:
    """⟨x₂′, x₃⟩, by differentiating x₂ = x′/κ."""
    x, _ = _line(surface, t, 2)
    slope = x.derivative()
    x2 = slope / np.sqrt(_dot(slope, slope))
    x3 = np.cross(x.value, x2.value, axis=0)
    return np.asarray(_dot(x2.derivative().value, x3))


def _lambda_11_printed(surface: RuledSurface) -> Array:
    return _around(surface, lambda t: _turning(surface, t), "the angle of pitch")


def _lambda_25_printed(surface: RuledSurface) -> Array:
    return -_around(surface, lambda t: _tau_printed(surface, t), "the angle of pitch")


def _lambda(surface: RuledSurface) -> Array:
    return np.array(surface.angle_of_pitch())


def _pitch_printed(surface: RuledSurface) -> Array:
    return _around(surface, lambda t: _chart(surface, t).advance, "the pitch")


def _pitch(surface: RuledSurface) -> Array:
    return np.array(surface.pitch())


# -- §3: the domain and the closing ----------------------------------------------------------------


def _inside(surface: RuledSurface, t: npt.ArrayLike, u_most: float, v_most: float) -> Array:
    u, v = surface.curve.series(finite_array(t, "t"), 0).value
    within = (u >= 0.0) & (u <= u_most) & (v >= 0.0) & (v <= v_most)
    return np.asarray(within, dtype=np.float64)


def _end_velocities(surface: RuledSurface) -> tuple[Array, Array]:
    start, end = (surface.curve.series(np.array(t), 1).derivatives()[1] for t in surface.domain)
    return start, end


def _seam_printed(surface: RuledSurface) -> Array:
    """Return the sine of the angle between the legs p₁ − p₀ and p₀ − pₙ₋₁: 0 for collinear."""
    start, end = _end_velocities(surface)
    area = abs(start[0] * end[1] - start[1] * end[0])
    return _ratio(np.asarray(area), np.hypot(*start) * np.hypot(*end))


def _seam(surface: RuledSurface) -> Array:
    """‖b′(1) − b′(0)‖ as a fraction of the larger of the two: 0 for C¹."""
    start, end = _end_velocities(surface)
    largest = np.maximum(np.hypot(*start), np.hypot(*end))
    return _ratio(np.asarray(np.hypot(*(end - start))), largest)


# -- §4: the invariants in the chart ---------------------------------------------------------------


def _tau_printed(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    f = _chart(surface, t)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    first = cosine * (f.du**3 * sine**2 + 2.0 * f.du * f.dv**2)
    return _ratio(first + sine * (f.du * f.ddv + f.ddu * f.dv), f.square)


def _tau(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    return surface.invariants(t).tau


def _tau_bar_printed(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    return _chart(surface, t).advance


def _tau_bar(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    return surface.invariants(t).tau_bar


def _cot_sigma_printed(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    f = _chart(surface, t)
    return _ratio(f.advance * np.sqrt(f.square), np.where(_torsal(surface, t), 0.0, f.stretch))


def _cot_sigma(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    """⟨m′, x₁⟩/⟨m′, x₃⟩: the slope of the striction curve against the ruling."""
    x, moment = _line(surface, t, 2)
    tangent = _striction(x, moment).derivative().value
    slope = x.derivative().value
    x3 = np.cross(x.value, _ratio(slope, np.sqrt(_dot(slope, slope))), axis=0)
    return _ratio(_dot(tangent, x.value), np.where(_torsal(surface, t), 0.0, _dot(tangent, x3)))


def _torsal(surface: RuledSurface, t: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Tell where κ̄ = 0 but for rounding, so that cot σ is infinite or undefined."""
    return np.asarray(surface.invariants(t).kappa_bar == 0.0)


# -- §4.2: at the first control point --------------------------------------------------------------


def _tau_0_printed(surface: RuledSurface) -> Array:
    n, (du, dv), (ddu, ddv), f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    square = du**2 * sine**2 + dv**2
    first = n * cosine * du * (du**2 * sine**2 + 2.0 * dv**2)
    return _ratio(first + (n - 1) * sine * (du * ddv + dv * ddu), square)


def _tau_bar_0_printed(surface: RuledSurface) -> Array:
    n, (du, dv), _, f = _at_start(surface)
    return np.asarray(n * np.sin(f.v) * (f.ubar * dv - f.vbar * du))


def _delta_0_printed(surface: RuledSurface) -> Array:
    n, (du, dv), _, f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    kept = n * du**2 * sine * (f.vbar * cosine + f.ubar_u * sine)
    return _ratio(kept, du**2 * sine**2 + dv**2)


def _cot_sigma_0_printed(surface: RuledSurface) -> Array:
    _, (du, dv), _, f = _at_start(surface)
    sine, cosine = np.sin(f.v), np.cos(f.v)
    above = (f.ubar * dv - f.vbar * du) * np.sqrt(du**2 * sine**2 + dv**2)
    return _ratio(above, du**2 * (f.vbar * cosine + f.ubar_u * sine))


def _first(evaluation: Evaluation) -> Evaluation:
    """Return the value of a function of (surface, t) at t = 0, for a Bézier curve."""

    def at_start(surface: RuledSurface) -> Array:
        _control_points(surface)
        return evaluation(surface, 0.0)

    return at_start


def _delta(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    return surface.invariants(t).delta


# -- the two examples ------------------------------------------------------------------------------


def _formula(function: Callable[[Array], Array]) -> Evaluation:
    """Return a formula in t alone as a function of (surface, t)."""
    return lambda surface, t: function(finite_array(t, "t"))


def _on(key: str, evaluation: Evaluation) -> Evaluation:
    """Return the evaluation on a surface of the gallery, whatever surface is given."""
    return lambda surface, *places: evaluation(gallery.surface(key), *places)


def _kappa_bar(surface: RuledSurface, t: npt.ArrayLike) -> Array:
    return surface.invariants(t).kappa_bar


def _both_pitches(surface: RuledSurface) -> Array:
    both = surface.dual_angle_of_pitch()
    return np.array([both.real, both.dual])


# -- the formulas, typeset -------------------------------------------------------------------------

_KAPPA_SQUARE = r"u'^2\sin^2 v+v'^2"
_STRETCH = (
    r"u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)"
    r"+u'v'(\bar v_u+\bar u_v\sin^2 v)+v'^2\,\bar v_v"
)
_ADVANCE = r"\sin v\,(\bar u\,v'-\bar v\,u')"
_TAU = r"\cos v\,(u'^3\sin^2 v+2u'v'^2)+\sin v"
_TAU_PRINTED = rf"\frac{{{_TAU}\,(u'v''+u''v')}}{{{_KAPPA_SQUARE}}}"
_TAU_RIGHT = rf"\frac{{{_TAU}\,(u''v'-u'v'')}}{{{_KAPPA_SQUARE}}}"
_MU_ABOVE = r"\sin v\,(v'\bar u'-u'\bar v')+u'v'\,\bar v\cos v"
_MU = rf"\mu=\bar u\cos v+\frac{{{_MU_ABOVE}}}{{{_KAPPA_SQUARE}}}"
_REST = r"w\kappa\,(w\kappa\tau+\bar\kappa')"
_H11_PRINTED = rf"\bar\kappa\,(\bar\tau+w\kappa'-\tau)-{_REST}"
_H11_RIGHT = rf"\bar\kappa\,(\kappa\bar\tau+w\kappa'-\bar\kappa\tau)-{_REST}"
_MEAN_RIGHT = rf"\bar\kappa\,(w\kappa'-\kappa\bar\tau-\bar\kappa\tau)-{_REST}"
_AREA = r"\kappa^2w^2+\bar\kappa^2"
_DU, _DV = r"\Delta_u", r"\Delta_v"
_SQUARE_0 = rf"{_DU}^2\sin^2 v_0+{_DV}^2"
_STRETCH_0 = (
    rf"{_DU}^2\sin v_0\,(\bar v\cos v_0+\bar u_u\sin v_0)"
    rf"+{_DU}{_DV}\,(\bar v_u+\bar u_v\sin^2 v_0)+{_DV}^2\,\bar v_v"
)
_ADVANCE_0 = rf"\bar u\,{_DV}-\bar v\,{_DU}"
_TAU_0 = rf"n\cos v_0\,{_DU}({_DU}^2\sin^2 v_0+2{_DV}^2)+(n-1)\sin v_0"
_BEND_PRINTED = rf"{_DU}\Delta^2_v+{_DV}\Delta^2_u"
_BEND_RIGHT = rf"{_DV}\Delta^2_u-{_DU}\Delta^2_v"
_WHERE_0 = (
    r"\qquad\text{with }(\Delta_u,\Delta_v)=\mathbf p_1-\mathbf p_0,\ "
    r"(\Delta^2_u,\Delta^2_v)=\mathbf p_2-2\mathbf p_1+\mathbf p_0,\ v_0=\mathbf p_{0_2}"
)

# -- the findings, in the order of the paper -------------------------------------------------------

PRINTED: tuple[Finding, ...] = (
    Finding(
        "x2bar_prime",
        "§2.2, (5)",
        "derivative of the moment x̄₂ of the second frame line",
        r"\bar{\mathbf x}_2'=-\bar\kappa\,\mathbf x_1+\bar\tau\,\mathbf x_3"
        r"-\kappa\,\bar{\mathbf x}_1+\tau\,\bar{\mathbf x}_2",
        r"\bar{\mathbf x}_2'=-\bar\kappa\,\mathbf x_1+\bar\tau\,\mathbf x_3"
        r"-\kappa\,\bar{\mathbf x}_1+\tau\,\bar{\mathbf x}_3",
        _x2bar_prime_printed,
        _x2bar_prime,
        "Take the dual part of X₂′ = −κ̂X₁ + τ̂X₃: τ meets x̄₃. An index slipped, and only in this "
        "line: the matrix that follows (17) was made with x̄₃ and is right.",
        "Where τ = 0. Elsewhere the two differ by τ(x̄₂ − x̄₃).",
    ),
    Finding(
        "x3_length",
        "§2.2, after (5)",
        "dual arc length of the curve of X₃, as a pair (real part, dual part)",
        r"\int\|\mathbf X_3'\|\,dt=\int\hat\tau\,dt",
        r"\int\|\mathbf X_3'\|\,dt=\int|\hat\tau|\,dt,\qquad"
        r"|\hat\tau|=\operatorname{sgn}(\tau)\,(\tau+\varepsilon\bar\tau)",
        _x3_length_printed,
        _x3_length,
        "X₃′ = −τ̂X₂ has the length |τ̂|. A length does not shrink where τ is negative, as ∫τ does. "
        "Both integrals are invariants of the surface; only one of them is the arc length.",
        "Where τ ≥ 0 all along, as in Example 2.",
        over="surface",
        design="ramp",
    ),
    Finding(
        "base_curve",
        "§2.4, (9)",
        "first fundamental form g₁₁ at the place w of the ruling",
        r"\mathbf r=\mathbf c+w\,\mathbf x,\quad g_{11}=\bar\tau^2+w^2\kappa^2+\bar\kappa^2",
        r"\mathbf r=\mathbf c+w\,\mathbf x,\quad "
        r"g_{11}=\langle\mathbf c',\mathbf x\rangle^2+(w-\mu)^2\kappa^2+\bar\kappa^2,"
        r"\quad\mathbf c+\mu\,\mathbf x=\mathbf m",
        _g11_printed,
        _g11_from_foot,
        "(9) is announced for the patch (1), whose base curve is any c; by (7) its r_t is that of "
        "r = m + w x. Read this way all of §2.4 holds, apart from h₁₁. Seen from the foot point, "
        "w has to be replaced by w − μ, and the share of r_t along x by ⟨c′, x⟩.",
        "Where the foot point is the striction point, μ = 0, all along, as on a helicoid or a "
        "hyperboloid of revolution; on any surface with r = m + w x.",
        over="t, w",
    ),
    Finding(
        "h11",
        "§2.4, after (9)",
        "second fundamental form h₁₁",
        rf"h_{{11}}=\frac{{{_H11_PRINTED}}}{{\sqrt{{{_AREA}}}}}",
        rf"h_{{11}}=\frac{{{_H11_RIGHT}}}{{\sqrt{{{_AREA}}}}}",
        _h11_printed,
        _h11,
        "Look at the units: τ is an angle per unit of t, τ̄ a length, wκ′ a length per unit of t "
        "squared, so they cannot be added. Differentiate r_t once more and the factors κ and κ̄ "
        "appear.",
        "Where κ̄ = 0, where τ = τ̄ = 0, and where κ = κ̄ = 1, which the choice of t and of the unit "
        "of length can bring about at one place.",
        over="t, w",
    ),
    Finding(
        "mean_curvature",
        "§2.4, K_M",
        "mean curvature H",
        rf"K_M=\frac{{{_H11_PRINTED}-2\kappa\bar\kappa\bar\tau}}{{2\,({_AREA})^{{3/2}}}}",
        rf"H=\frac{{{_MEAN_RIGHT}}}{{2\,({_AREA})^{{3/2}}}}",
        _mean_printed,
        _mean,
        "It inherits h₁₁. Run through the same curve twice as fast: the surface, and so its mean "
        "curvature, is the same, but the printed value changes. K_G contains no h₁₁ and is right.",
        "Where h₁₁ agrees.",
        over="t, w",
    ),
    Finding(
        "angle_of_pitch_11",
        "§2.5, (11)",
        "angle of pitch λ",
        r"\lambda=\oint d\phi=\oint\langle\mathbf x_2',\mathbf x_3\rangle\,dt",
        r"\lambda=\oint d\phi=-\oint\langle\mathbf x_2',\mathbf x_3\rangle\,dt=-\oint\tau\,dt",
        _lambda_11_printed,
        _lambda,
        "ξ = cos φ x₂ + sin φ x₃ changes by −κ cos φ x₁ + (φ′ + τ)(−sin φ x₂ + cos φ x₃). To span "
        "a developable without following an orthogonal trajectory it may change along x₁ only: "
        "φ′ = −τ. (25) has this sign.",
        "Where λ = 0.",
        over="surface",
    ),
    Finding(
        "domain",
        "§3, and Example 2",
        "whether the curve's point (u, v) lies in the domain of the sphere's chart: 1 or 0",
        r"\mathcal B=\{(u,v):0\le u\le\pi,\ 0\le v\le 2\pi\}",
        r"\mathcal B=\{(u,v):0\le u\le 2\pi,\ 0\le v\le\pi\}",
        lambda surface, t: _inside(surface, t, math.pi, 2.0 * math.pi),
        lambda surface, t: _inside(surface, t, 2.0 * math.pi, math.pi),
        "In (12) u is the longitude and v the angle from the pole: one needs 2π, the other π. The "
        "printed rectangle, too, covers the sphere, but with its line v = π all in one pole and, "
        "beyond it, turned inside out (sin v < 0): ∬ sin v du dv is 0 over it instead of 4π.",
        "For curves in the square 0 ≤ u, v ≤ π that both have in common, as in Example 2.",
        design="hyperboloid",
    ),
    Finding(
        "closing",
        "§3, after (14)",
        "what has to vanish for a closed curve to be C¹ at its seam",
        r"\mathbf p_{n-1},\mathbf p_0,\mathbf p_1\ \text{collinear}",
        r"\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}",
        _seam_printed,
        _seam,
        "b′(0) = n(p₁ − p₀) and b′(1) = n(p₀ − pₙ₋₁): collinear points make them parallel, not "
        "equal. With p₀ between the others the seam is G¹ and κ = ‖x′‖ jumps; with both on one "
        "side of p₀ it is a cusp. τ contains second derivatives and jumps even at a C¹ seam, "
        "unless u″ and v″ agree as well; so does σ.",
        "Where p₀ is the midpoint of pₙ₋₁ and p₁, as in Example 2.",
        over="surface",
    ),
    Finding(
        "tau",
        "§4, (18)",
        "torsion τ",
        rf"\tau={_TAU_PRINTED}",
        rf"\tau={_TAU_RIGHT}",
        _tau_printed,
        _tau,
        "κ²τ = [x, x′, x″] is a determinant, so u″ and v″ enter as a determinant with u′ and v′. "
        "Or run through the same path at another speed: (u″, v″) gains a multiple of (u′, v′), "
        "and the part with u″, v″ must not notice.",
        "Where u′v″ = 0, for instance if v is linear in t, as in Example 1. The difference is "
        "2 sin v u′v″/κ².",
    ),
    Finding(
        "tau_bar",
        "§4, (18)",
        "dual torsion τ̄",
        rf"\bar\tau={_ADVANCE}",
        rf"\bar\tau={_ADVANCE}+\mu',\qquad {_MU}",
        _tau_bar_printed,
        _tau_bar,
        "What is printed is ⟨c′, x⟩ for the foot point c. By (7) τ̄ = ⟨m′, x⟩ belongs to the "
        "striction point m = c + μ x, which moves along the ruling at the rate μ′ besides. (6) "
        "gives the same.",
        "Where μ′ = 0; and ∮τ̄ dt is the same for both, as μ returns to its value.",
    ),
    Finding(
        "cot_sigma",
        "§4, Lemma 1, (22)",
        "cotangent of the striction σ",
        rf"\cot\sigma=\frac{{{_ADVANCE}\,\sqrt{{{_KAPPA_SQUARE}}}}}{{{_STRETCH}}}",
        rf"\cot\sigma=\frac{{\bar\tau}}{{\bar\kappa}}"
        rf"=\frac{{\bigl({_ADVANCE}+\mu'\bigr)\,\sqrt{{{_KAPPA_SQUARE}}}}}{{{_STRETCH}}}",
        _cot_sigma_printed,
        _cot_sigma,
        "cot σ = τ̄/κ̄ is right; the τ̄ of (18) went into it. Compare with the direction in which the "
        "striction curve crosses the rulings.",
        "Where μ′ = 0.",
    ),
    Finding(
        "example_1_kappa_bar",
        "§4, Example 1",
        "dual curvature κ̄",
        r"\bar\kappa=\frac{t\sin 2t+3}{\sqrt{1+\sin^2 t}}",
        r"\bar\kappa=\frac{t\sin 2t+2}{\sqrt{1+\sin^2 t}}",
        _formula(lambda t: (t * np.sin(2.0 * t) + 3.0) / np.sqrt(1.0 + np.sin(t) ** 2)),
        _on("example_1", _kappa_bar),
        "The constant is sin²t (ū_u + ū_v) + v̄_u + v̄_v = 0 + 2, whatever functions with ū = 0 and "
        "v̄ = 2t along u = v = t are meant: sin²t + cos²t + 1 in the example's δ, which is right.",
        "Nowhere: the difference is 1/κ.",
        design="example_1",
        only=True,
    ),
    Finding(
        "example_1_tau_bar",
        "§4, Example 1",
        "dual torsion τ̄",
        r"\bar\tau=t\sin t",
        r"\bar\tau=-2t\sin t+\mu'"
        r"=-2t\sin t-\frac{2t\sin t\,(1+\sin^2 t)+2(t\cos t-\sin t)\sin 2t}{(1+\sin^2 t)^2}",
        _formula(lambda t: t * np.sin(t)),
        _on("example_1", _tau_bar),
        "With ū = 0, v̄ = 2t and u′ = v′ = 1 formula (18), as printed, gives −2t sin t; a factor −2 "
        "was lost. To this μ′ must be added, μ = 2(t cos t − sin t)/(1 + sin²t).",
        "Only towards t = 0, where the curve leaves the pole and both tend to 0. At t = 1/2 the "
        "printed value is 0.2397, the right one −0.8240.",
        design="example_1",
        only=True,
    ),
    Finding(
        "example_1_cot_sigma",
        "§4, Example 1",
        "cotangent of the striction σ",
        r"\cot\sigma=\frac{-t\sqrt{1+\sin^2 t}}{t\cos t+2\sin t}",
        r"\cot\sigma=\frac{\bar\tau\,\sqrt{1+\sin^2 t}}{t\sin 2t+2}",
        _formula(lambda t: _ratio(-t * np.sqrt(1 + np.sin(t) ** 2), t * np.cos(t) + 2 * np.sin(t))),
        _on("example_1", _cot_sigma),
        "It is not the quotient of the two values printed above it: its sign is that of "
        "−2t sin t, and in place of the constant 2 in κκ̄ stands 4 sin²t.",
        "Where the two curves happen to cross; nowhere as a formula.",
        design="example_1",
        only=True,
    ),
    Finding(
        "pitch_24",
        "§4.1, (24)",
        "pitch l",
        rf"l=\oint {_ADVANCE}\,dt",
        rf"l=-\oint {_ADVANCE}\,dt",
        _pitch_printed,
        _pitch,
        "(10) has the minus: along an orthogonal trajectory w′ = −⟨c′, x⟩. The integrand ⟨c′, x⟩ "
        "is right, and here no μ′ is missed, as ∮μ′ dt = 0.",
        "Where l = 0.",
        over="surface",
    ),
    Finding(
        "angle_of_pitch_25",
        "§4.1, (25)",
        "angle of pitch λ",
        rf"\lambda=-\oint {_TAU_PRINTED}\,dt",
        rf"\lambda=-\oint {_TAU_RIGHT}\,dt",
        _lambda_25_printed,
        _lambda,
        "The sign in front is right; the τ of (18) stands under the integral. For a loop that goes "
        "round no pole ∮τ dt − ∮cos v du is a whole number of turns (Gauss and Bonnet), for the "
        "printed integrand it is not.",
        "Where ∮ 2 sin v u′v″/κ² dt = 0, for instance if v is linear in t.",
        over="surface",
    ),
    Finding(
        "tau_0",
        "§4.2",
        "torsion τ(0) from the first three control points",
        rf"\tau(0)=\frac{{{_TAU_0}\,({_BEND_PRINTED})}}{{{_SQUARE_0}}}{_WHERE_0}",
        rf"\tau(0)=\frac{{{_TAU_0}\,({_BEND_RIGHT})}}{{{_SQUARE_0}}}",
        _tau_0_printed,
        _first(_tau),
        "It is (18) at t = 0 with the same sign. The powers of n are right.",
        "Where Δ_u Δ²_v = 0, as in Example 2, whose first leg lies on a meridian.",
        over="surface",
        design="ramp",
    ),
    Finding(
        "tau_bar_0",
        "§4.2",
        "dual torsion τ̄(0) from the control points",
        rf"\bar\tau(0)=n\sin v_0\,({_ADVANCE_0}){_WHERE_0}",
        rf"\bar\tau(0)=n\sin v_0\,({_ADVANCE_0})+\mu'(0)",
        _tau_bar_0_printed,
        _first(_tau_bar),
        "It is (18) at t = 0. As μ contains first derivatives, μ′(0) depends on p₂ as well.",
        "Where μ′(0) = 0.",
        over="surface",
    ),
    Finding(
        "delta_0",
        "§4.2",
        "distribution parameter δ(0) from the first two control points",
        rf"\delta(0)=\frac{{n\,{_DU}^2\sin v_0\,(\bar v\cos v_0+\bar u_u\sin v_0)}}{{{_SQUARE_0}}}"
        rf"{_WHERE_0}",
        rf"\delta(0)=\frac{{{_STRETCH_0}}}{{{_SQUARE_0}}}",
        _delta_0_printed,
        _first(_delta),
        "δ = κ̄/κ, and the n of κ̄(0) cancels against that of κ(0), both of which are right. The "
        "terms with Δ_v are missing. Raise the degree: the curve, and so δ, stays, but the printed "
        "value grows like n.",
        "For n = 1 and Δ_v = 0. With Δ_v = 0 alone the printed value is n δ(0).",
        over="surface",
        design="twisted_ring",
    ),
    Finding(
        "cot_sigma_0",
        "§4.2",
        "cotangent of the striction σ(0) from the control points",
        rf"\cot\sigma(0)=\frac{{({_ADVANCE_0})\,\sqrt{{{_SQUARE_0}}}}}"
        rf"{{{_DU}^2\,(\bar v\cos v_0+\bar u_u\sin v_0)}}{_WHERE_0}",
        rf"\cot\sigma(0)=\frac{{\bigl(\sin v_0\,({_ADVANCE_0})+\mu'(0)/n\bigr)"
        rf"\,\sqrt{{{_SQUARE_0}}}}}{{{_STRETCH_0}}}",
        _cot_sigma_0_printed,
        _first(_cot_sigma),
        "It is (22) at t = 0 without the terms with Δ_v in κκ̄; only without them could sin v₀ be "
        "cancelled. And μ′(0) is missing. In Example 2, where Δ_u = 0, it divides by zero although "
        "cot σ(0) = 2.1213.",
        "Where Δ_v = 0 and μ′(0) = 0.",
        over="surface",
        design="twisted_ring",
    ),
    Finding(
        "example_2",
        "§4.2, Example 2",
        "the pair (λ, l) of the closed surface",
        r"\lambda=1.419793061,\qquad l=0.3381414433",
        r"\lambda=-6.115937783178,\qquad l=0.580104765135",
        lambda surface: np.array([1.419793061, 0.3381414433]),
        _on("example_2", _both_pitches),
        "Three routes give the same: the definitions; a vector ξ and an orthogonal trajectory "
        "followed round the loop, with the gap they leave; and for λ the area 0.16724752 that the "
        "loop encloses on the sphere, as ∮τ dt is 2π less this area. The slip behind the printed "
        "pair was searched for and not found: `TRIED` says where.",
        "No: not modulo 2π, not up to sign, and not with the printed (24) and (25), which give "
        "λ = 1.1193 and l = −0.5801 here.",
        over="surface",
        only=True,
    ),
)
"""What was found, in the order of the paper."""

# The search was done once, outside the package: more than 10¹⁰ comparisons, a match being ten equal
# digits up to sign, a multiple of π, or a simple factor.
TRIED: tuple[Note, ...] = (
    Note(
        "formulas",
        "Right and printed formulas, (11) as well as (25), every term with the factors 0, ±1, ±2, "
        "divided by κ⁰ to κ⁴; κ, κ̄ and δ in place of τ and τ̄; u and v exchanged, latitude for "
        "colatitude, degrees for radians. No variant gives both numbers. A handful give one of "
        "them to nine digits, as many as chance allows, each by a contrived formula.",
    ),
    Note(
        "curves",
        "Degree 5 and 7, p₆ dropped, the exponent n − i with n = 5 or 7, no binomials, some points "
        "left out, B-splines, joined pieces; all orders of the six points, each point moved "
        "anywhere on the grid of π/8 and all pairs of points moved on part of it. No l fits.",
    ),
    Note(
        "ū and v̄",
        "Each a combination of up to two of 29 simple functions of u, v or t. No l fits; λ does "
        "not depend on them.",
    ),
    Note(
        "integration",
        "Sums, trapezoids, Simpson, Newton–Cotes and Gauss with up to 200 steps: nothing nearer "
        "than 2·10⁻⁵. Other ranges of t. The nearest to a pattern: ∫τ dt from 0 reaches the "
        "printed λ at t = 0.1708, and −∫⟨c′, x⟩ dt the printed l at t = 0.1700: near, but not one "
        "place.",
    ),
)
"""What was varied in search of the slip behind Example 2's numbers, and what came of it: nothing.

For comparison, from the printed points: ∫κ dt = 1.4473, and the pair asked for is
λ = −6.1159, l = 0.5801.
"""

REMARKS: tuple[Note, ...] = (
    Note(
        "§2.1",
        "⟨U, V⟩ = cos θ − ε d sin θ: the dual part holds the distance together with the angle, and "
        "d has a sign, that of the turn about the common perpendicular.",
    ),
    Note(
        "§2.3",
        "Corollary 1: the invariants fix the surface up to its position in space, and σ in (8) is "
        "one value in 0 ≤ σ < 2π, as 0 and 2π are the same direction.",
    ),
    Note("§3, (14)", "n + 1 control points make a curve of degree n, of order n + 1."),
    Note(
        "§4, after (17)",
        "The matrix acts on the real vectors x₁, x₂, x₃, although capitals are printed, as in "
        "(21); α₁, α₂, α₃ are the coordinates of the striction point, αᵢ = ⟨m, xᵢ⟩.",
    ),
    Note(
        "§4, Example 1",
        "The example 3.1.1 it starts from is not in the text. ū = u − v and v̄ = u + v, the choice "
        "of Example 2, give the ū = 0 and v̄ = 2t it goes on with. At t = 0 the curve starts in a "
        "pole of the chart, where x̄ depends on the direction from which one comes.",
    ),
    Note("§4", "The number (23) is not used; in Example 2 the exponent n of 1 − t is 6."),
)
"""Smaller things, on which no number depends."""

CONFIRMED: tuple[Note, ...] = (
    Note("§2.2", "(4); (6), with both terms of τ̄; (7); the striction curve m"),
    Note("§2.4", "n, g₁₁, g₁₂, g₂₂, h₁₂, h₂₂ and K_G, on the patch m + w x"),
    Note("§2.5", "(10), sign and integrand"),
    Note("§4", "the matrix after (17), with x₁, x₂, x₃"),
    Note("§4, (18)", "κ and κ̄"),
    Note("§4", "(19), (20) and the formula for the foot point a(t)"),
    Note("§4, Example 1", "κ, τ and δ"),
    Note("§4.2", "the derivatives of u and v; κ(0) and κ̄(0)"),
)
"""What was checked in the same way and stands as printed."""
