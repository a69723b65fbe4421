"""Developable surfaces with a chosen spherical image.

Two ways. Either ū along the curve is given and v̄ follows from κ̄ = 0, which for functions of t is

    v′ v̄′ = −u′² sin v cos v v̄ − u′ sin²v ū′,

or the striction curve is built outright: m′ = τ̄ x with any function τ̄ makes x its tangent.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from .checks import POLE, Array, GeometryError, finite_array
from .field import Field, field
from .jet import Jet, cross, study
from .quadrature import Primitive
from .series import Series
from .source import Curve
from .surface import RuledSurface

__all__ = ["Developable", "developable_from_ubar", "tangent_developable"]

SAMPLES = 257
"""Places at which v′ is compared with 0."""

LEVEL = 1e-9
"""|v′| below this fraction of the curve's speed scale counts as 0."""

ACCURACY = 1e-12


@dataclass(frozen=True, eq=False, slots=True)
class Developable:
    """A surface with κ̄ ≡ 0 for a given curve and ū.

    Attributes
    ----------
    surface
        the surface, with the whole interface of `RuledSurface`. Its v̄ is a function of t, not of
        u and v, so it is no design for the chart; but for the equator, where v̄ is constant.
    """

    surface: RuledSurface
    _vbar: Callable[[Array], Array]

    def vbar(self, t: npt.ArrayLike) -> Array:
        """Return v̄ at t, of the shape of t."""
        places = finite_array(t, "t")
        return self._vbar(places.reshape(-1)).reshape(places.shape)


def developable_from_ubar(curve: Curve, ubar: Any, start: float = 0.0) -> Developable:
    """Return the developable surface with this curve and ū, and v̄ = ``start`` at its beginning.

    Along a parallel circle (v′ ≡ 0) the equation is none for v̄′, so v̄ = −ū′ tan v/u′ is fixed and
    ``start`` plays no part. On the equator v̄ drops out, too: where ū is constant along it every v̄
    will do, and the constant ``start`` is taken.

    Parameters
    ----------
    curve
        one curve in the chart along which v′ is nowhere 0, or 0 throughout.
    ubar
        as for `RuledSurface`.
    start
        v̄ at the first t, a length.

    Raises
    ------
    GeometryError
        where v′ changes sign or comes down to 0, where the equation is singular and v̄ in general
        infinite, and on the equator where ū changes; `tangent_developable` serves such curves too.
    """
    if curve.batch_shape:
        raise GeometryError(
            f"`curve` must be one curve; got a batch of shape {curve.batch_shape}; take one of it"
        )
    chosen = field(ubar, "ubar")
    first = float(finite_array(start, "start"))
    level = _is_parallel(curve)
    if level and _is_equator(curve):
        values = _on_equator(curve, chosen, first)
        return Developable(RuledSurface(curve, chosen, first), values)
    values = _on_parallel(curve, chosen) if level else _solved(curve, chosen, first)
    source = _FromUbar(curve, chosen, values, level)
    return Developable(RuledSurface.from_source(source), values)


def _is_parallel(curve: Curve) -> bool:
    t = np.linspace(*curve.domain, SAMPLES)
    rate = curve.series(t, 1).derivatives()[1, 1]
    floor = LEVEL * float(curve.scale)
    if (np.abs(rate) <= floor).all():
        return True
    if (rate > floor).all() or (rate < -floor).all():
        return False
    place = float(t[np.abs(rate).argmin()])
    raise GeometryError(
        f"`curve` must have v′ ≠ 0 everywhere, or v constant; got v′ = 0 near t = {place:.4g}; use "
        "tangent_developable, or a curve along which v only rises or only falls"
    )


def _terms(curve: Curve, ubar: Field, t: Array, order: int) -> tuple[Series, Series, Series]:
    """Return p, q, v′ of v′ v̄′ = −p v̄ − q as series of this order."""
    angles = curve.series(t, order + 1)
    u, v = angles[0], angles[1]
    du, dv, height = u.derivative(), v.derivative(), (ubar(u, v) + 0.0 * u).derivative()
    sine, cosine = np.sin(v), np.cos(v)
    return du * du * sine * cosine, du * sine * sine * height, dv


def _solved(curve: Curve, ubar: Field, first: float) -> Callable[[Array], Array]:
    """Solve for v̄ with the given first value."""

    def rate(t: float, vbar: Array) -> Array:
        p, q, dv = _terms(curve, ubar, np.array(t), 0)
        return np.asarray(-(p.value * vbar + q.value) / dv.value)

    with np.errstate(all="ignore"):
        solved: Any = solve_ivp(
            rate, curve.domain, [first], "DOP853", dense_output=True, rtol=ACCURACY, atol=ACCURACY
        )
    if not solved.success or not np.isfinite(solved.y).all():
        raise GeometryError(
            "`ubar` must be smooth along the curve and the curve must keep off the poles; got no "
            f"solution beyond t = {float(solved.t[-1]):.4g}; choose another ū"
        )
    return lambda t: np.asarray(solved.sol(t)[0])


def _on_parallel(curve: Curve, ubar: Field) -> Callable[[Array], Array]:
    def values(t: Array) -> Array:
        with np.errstate(all="ignore"):
            p, q, _ = _terms(curve, ubar, t, 0)
            return np.asarray((-q / p).value)

    return values


def _is_equator(curve: Curve) -> bool:
    t = np.linspace(*curve.domain, SAMPLES)
    return bool((np.abs(np.cos(curve.series(t, 0).value[1])) <= LEVEL).all())


def _on_equator(curve: Curve, ubar: Field, first: float) -> Callable[[Array], Array]:
    """Return a constant v̄, which will do where ū rests: on the equator κ κ̄ = u′ ū′."""
    t = np.linspace(*curve.domain, SAMPLES)
    angles = curve.series(t, 1)
    height = ubar(angles[0], angles[1]) + 0.0 * angles[0]
    floor = LEVEL * float(curve.scale) * np.abs(height.value).max()
    if not (np.abs(height.derivative().value) <= floor).all():
        raise GeometryError(
            "`curve` must leave the equator where ū changes along it; got v = π/2, where κ̄ does "
            "not depend on v̄; use tangent_developable, or another v"
        )
    return lambda t: np.full(t.shape, first)


@dataclass(frozen=True, eq=False, slots=True)
class _OfCurve:
    """What both sources have from the curve."""

    curve: Curve

    @property
    def domain(self) -> tuple[float, float]:
        return self.curve.domain

    @property
    def batch_shape(self) -> tuple[int, ...]:
        return ()

    @property
    def singular(self) -> str:
        return "the curve meets a pole of the chart (sin v = 0); move the curve off the pole"

    @property
    def origin(self) -> str:
        return "ū or the striction curve's speed"

    def _jet(self, rows: Array, v: Series) -> Jet:
        pole = np.asarray(np.abs(np.sin(v.value)) <= POLE)
        return Jet(rows, np.asarray(self.curve.scale), pole)


@dataclass(frozen=True, eq=False, slots=True)
class _FromUbar(_OfCurve):
    """x̄ = ū x_u + v̄ x_v; the derivatives of v̄ come from its equation, so κ̄ is 0 to rounding."""

    ubar: Field
    values: Callable[[Array], Array]
    level: bool

    def jet(self, t: Array, order: int = 2) -> Jet:
        with np.errstate(all="ignore"):
            angles = self.curve.series(t, order)
            p, q, dv = _terms(self.curve, self.ubar, t, order)
            vbar = -q / p if self.level else self._series(p, q, dv, self.values(t))
            rows = study(angles, self.ubar(angles[0], angles[1]), vbar)
        return self._jet(rows, angles[1])

    def _series(self, p: Series, q: Series, dv: Series, value: Array) -> Series:
        vbar = Series(value[np.newaxis])
        for k in range(p.order):
            rate = -(p.truncated(k) * vbar + q.truncated(k)) / dv.truncated(k)
            following = rate.coefficients[k] / (k + 1)
            vbar = Series(np.concatenate([vbar.coefficients, following[np.newaxis]]))
        return vbar


def tangent_developable(
    curve: Curve, speed: Any = 1.0, start: npt.ArrayLike = (0.0, 0.0, 0.0)
) -> RuledSurface:
    """Return the tangents of the curve m with m′ = τ̄ x: a developable over any spherical image.

    Every developable surface with κ ≠ 0 is of this kind; with τ̄ = 0 it is the cone with its apex
    in ``start``.

    Parameters
    ----------
    curve
        one curve in the chart.
    speed
        τ̄: a number, or a function of t (a `Series`) made with numpy's functions.
    start
        (3,) the first striction point.
    """
    if curve.batch_shape:
        raise GeometryError(
            f"`curve` must be one curve; got a batch of shape {curve.batch_shape}; take one of it"
        )
    first = finite_array(start, "start")
    if first.shape != (3,):
        raise GeometryError(f"`start` must have shape (3,); got {first.shape}; give x, y, z")
    rate = _rate(speed)
    ways = tuple(_way(curve, rate, k) for k in range(3))
    return RuledSurface.from_source(_Tangents(curve, rate, first, ways))


def _way(curve: Curve, rate: Callable[[Series], Series], k: int) -> Primitive:
    def slope(t: Array) -> Array:
        return np.asarray(_tangent(curve, rate, t, 0)[0, k])

    return Primitive(slope, *curve.domain, "the striction curve")


def _rate(speed: Any) -> Callable[[Series], Series]:
    if callable(speed):
        return lambda t: speed(t) + 0.0 * t
    value = float(finite_array(speed, "speed"))
    return lambda t: value + 0.0 * t


def _tangent(curve: Curve, rate: Callable[[Series], Series], t: Array, order: int) -> Array:
    """Return (order+1, 3, N) the Taylor coefficients of τ̄ x."""
    x = _directions(curve, t, order)
    speed = rate(Series.variable(t, order))
    return np.stack([(speed * x[k]).coefficients for k in range(3)], axis=1)


def _directions(curve: Curve, t: Array, order: int) -> Series:
    angles = curve.series(t, order)
    u, v = angles[0], angles[1]
    outward = np.sin(v)
    entries = (np.cos(u) * outward, np.sin(u) * outward, np.cos(v))
    return Series(np.stack([entry.coefficients for entry in entries], axis=1))


@dataclass(frozen=True, eq=False, slots=True)
class _Tangents(_OfCurve):
    """X = x + ε m × x."""

    rate: Callable[[Series], Series]
    first: Array
    ways: tuple[Primitive, ...]

    def jet(self, t: Array, order: int = 2) -> Jet:
        with np.errstate(all="ignore"):
            m = np.empty((order + 1, 3, t.size))
            m[0] = self.first[:, np.newaxis] + np.stack([way(t) for way in self.ways])
            if order:
                steps = np.arange(1.0, order + 1.0).reshape(-1, 1, 1)
                m[1:] = _tangent(self.curve, self.rate, t, order - 1) / steps
            angles = self.curve.series(t, order)
            rows = study(angles, 0.0, 0.0)
            rows[:, 1] = _moments(m, _directions(self.curve, t, order).coefficients)
        return self._jet(rows, angles[1])


def _moments(m: Array, x: Array) -> Array:
    """Return the derivatives of m × x from Taylor coefficients."""
    rows, factor = np.empty_like(m), 1.0
    for k in range(len(m)):
        factor *= max(k, 1)
        rows[k] = factor * sum(cross(m[j], x[k - j]) for j in range(k + 1))
    return rows
