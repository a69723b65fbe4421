"""The line congruence that ū and v̄ hang on the sphere: one line for every direction.

Write a = v̄ and b = −ū sin v for the parts of the foot point c = x × x̄ along the unit vectors
e₁ = x_u/sin v and e₂ = x_v. To first order the neighbour in the direction e_j moves by
M₁ⱼe₁ + M₂ⱼe₂ at c while it turns by e_j, so the point c + w x moves along the line itself for a
neighbour e with (M + w) e = 0. Everything here is read off this matrix:

    M = ( (v̄_u − ū sin v cos v)/sin v     v̄_v                )
        ( −ū_u − v̄ cot v                   −ū_v sin v − ū cos v )
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .checks import POLE, Array, GeometryError, finite_array, frozen
from .field import Field, field
from .line import Line
from .series import Series

__all__ = ["Congruence", "Focal"]

DOUBLE = 1e-12
"""A discriminant below this fraction of its terms is 0: the focal points coincide."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


@dataclass(frozen=True, eq=False, slots=True)
class Focal:
    """What neighbouring lines do along each line; w is measured from the foot point c.

    Attributes
    ----------
    kind
        ``"hyperbolic"`` (two focal points), ``"parabolic"`` (one, counted twice), ``"elliptic"``
        (none) or ``"undefined"``. A bundle counts as parabolic: its focal point is the apex.
    w
        (…, 2) the focal points, w₁ ≤ w₂; NaN where there is none.
    points
        (…, 2, 3) the same in space: there a neighbouring line is met, to first order.
    limits
        (…, 2) w of the limit points: between them lie the feet of the common perpendiculars with
        all neighbours. The focal points lie between them too.
    midpoint
        (…) w of the point halfway between the limit points, and between the focal points.
    """

    kind: npt.NDArray[np.str_]
    w: Array
    points: Array
    limits: Array
    midpoint: Array


class Congruence:
    """The lines X(u, v) = x + ε(ū x_u + v̄ x_v) of all directions (paper, (12) and (13)).

    Parameters
    ----------
    ubar, vbar
        as for `RuledSurface`: typed formulas in u and v, numbers, or callables of (u, v).

    Notes
    -----
    u and v are numbers or arrays that broadcast, in radians. At the poles of the chart, and where
    ū, v̄ are undefined, results are NaN.
    """

    __slots__ = ("_ubar", "_vbar")

    def __init__(self, ubar: Any, vbar: Any) -> None:
        self._ubar: Field = field(ubar, "ubar")
        self._vbar: Field = field(vbar, "vbar")

    @property
    def ubar(self) -> Field:
        """The choice of ū."""
        return self._ubar

    @property
    def vbar(self) -> Field:
        """The choice of v̄."""
        return self._vbar

    def __repr__(self) -> str:
        return f"Congruence(ubar={self._ubar!r}, vbar={self._vbar!r})"

    def line(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Line:
        """Return the lines of the directions (u, v)."""
        u, v = _angles(u, v)
        with np.errstate(all="ignore"):
            e1, e2, x = _axes(u, v)
            ubar, vbar = _value(self._ubar, u, v), _value(self._vbar, u, v)
            moment = (ubar * _sine(v))[..., np.newaxis] * e1 + vbar[..., np.newaxis] * e2
        return Line.unchecked(x, np.where(np.isfinite(moment), moment, np.nan))

    def matrix(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Array:
        """Return (…, 2, 2) the matrix M of the module's beginning."""
        u, v = _angles(u, v)
        with np.errstate(all="ignore"):
            sine, cosine = _sine(v), np.cos(v)
            ubar, vbar = _value(self._ubar, u, v), _value(self._vbar, u, v)
            ubar_u, ubar_v = _slopes(self._ubar, u, v)
            vbar_u, vbar_v = _slopes(self._vbar, u, v)
            first = [vbar_u / sine - ubar * cosine, vbar_v]
            second = [-ubar_u - vbar * cosine / sine, -ubar_v * sine - ubar * cosine]
            entries = np.stack([np.stack(np.broadcast_arrays(*r), -1) for r in (first, second)], -2)
        return np.where(np.isfinite(entries), entries, np.nan)

    def focal(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Focal:
        """Return focal points, limit points and the kind of each line.

        The focal w solve w² + (tr M) w + det M = 0: they are the eigenvalues of −M, the limit
        points those of its symmetric part.
        """
        m = self.matrix(u, v)
        with np.errstate(all="ignore"):
            half, cross = 0.5 * (m[..., 0, 0] - m[..., 1, 1]), m[..., 0, 1] * m[..., 1, 0]
            square = half**2 + cross
            rounding = DOUBLE * (m**2).sum(axis=(-1, -2))
            square = np.where(np.abs(square) <= rounding, 0.0, square)
            middle = -0.5 * np.trace(m, axis1=-2, axis2=-1)
            w = _around(middle, np.sqrt(square))
            limits = _around(middle, np.hypot(half, 0.5 * (m[..., 0, 1] + m[..., 1, 0])))
        points = self.line(u, v)[..., np.newaxis].point(np.nan_to_num(w))
        points = np.where(np.isnan(w)[..., np.newaxis], np.nan, points)
        return Focal(_kinds(square), frozen(w), frozen(points), frozen(limits), frozen(middle))

    def kind(self, u: npt.ArrayLike, v: npt.ArrayLike) -> npt.NDArray[np.str_]:
        """Return ``"hyperbolic"``, ``"parabolic"``, ``"elliptic"`` or ``"undefined"``."""
        return self.focal(u, v).kind

    def divergence(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Array:
        """Return ū_u + v̄_v + v̄ cot v, the divergence of the field ū x_u + v̄ x_v on the sphere.

        It is M₁₂ − M₂₁. Its flux through a loop is ∮τ̄ dt, minus the pitch of the loop's surface;
        it vanishes exactly where the lines are the normals of a surface.
        """
        u, v = _angles(u, v)
        one = np.ones_like(u)
        with np.errstate(all="ignore"):
            ubar_u = _slope(self._ubar(Series([u, one]), v), u)
            vbar_v = _slope(self._vbar(u, Series([v, one])), v)
            found = vbar_v - (-ubar_u - _value(self._vbar, u, v) * np.cos(v) / _sine(v))
        return np.where(np.isfinite(found), found, np.nan)

    def parameters(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Array:
        """Return (…, 2) the least and the greatest δ of the surfaces of this congruence there.

        A curve that leaves (u, v) in the direction e has κκ̄/κ² = δ = e₂ ⟨Me, e₁⟩ − e₁ ⟨Me, e₂⟩,
        a quadratic form of e. Its values in two perpendicular directions add up to the divergence,
        and it is zero in the directions of the neighbours that meet the line, to first order: two
        of them where the congruence is hyperbolic, none where it is elliptic.
        """
        m = self.matrix(u, v)
        middle = 0.5 * (m[..., 0, 1] - m[..., 1, 0])
        away = np.hypot(0.5 * (m[..., 0, 1] + m[..., 1, 0]), 0.5 * (m[..., 0, 0] - m[..., 1, 1]))
        return frozen(_around(middle, away))

    def flux(self, u: tuple[float, float], v: tuple[float, float]) -> float:
        """Return ∬ (ū_u + v̄_v + v̄ cot v) sin v du dv over a rectangle of the chart.

        By Gauss' rule with 40 × 40 points, exact to rounding for fields of ordinary smoothness.
        It is positive for a rectangle whose sides are given in rising order.

        Raises
        ------
        GeometryError
            where the divergence is undefined at one of the points.
        """
        (us, du), (vs, dv) = _rule(u, "u"), _rule(v, "v")
        density = self.divergence(us[:, np.newaxis], vs) * np.sin(vs)
        total = float(du @ density @ dv)
        if not math.isfinite(total):
            raise GeometryError(
                "`u` and `v` must bound a rectangle on which ū and v̄ are defined; got "
                f"u = {u}, v = {v}; choose a smaller one"
            )
        return total


def _angles(u: npt.ArrayLike, v: npt.ArrayLike) -> tuple[Array, Array]:
    u, v = np.broadcast_arrays(finite_array(u, "u"), finite_array(v, "v"))
    return u, v


def _axes(u: Array, v: Array) -> tuple[Array, Array, Array]:
    """Return e₁, e₂ and x, each (…, 3)."""
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    e1 = np.stack([-su, cu, np.zeros_like(u)], axis=-1)
    e2 = np.stack([cu * cv, su * cv, -sv], axis=-1)
    return e1, e2, np.stack([cu * sv, su * sv, cv], axis=-1)


def _sine(v: Array) -> Array:
    sine = np.sin(v)
    return np.where(np.abs(sine) <= POLE, np.nan, sine)


def _value(chosen: Field, u: Array, v: Array) -> Array:
    return np.broadcast_to(np.asarray(chosen(u, v), dtype=np.float64), u.shape)


def _slopes(chosen: Field, u: Array, v: Array) -> tuple[Array, Array]:
    """Return both partial derivatives; series, unlike dual numbers, divide by zero silently."""
    one = np.ones_like(u)
    return _slope(chosen(Series([u, one]), v), u), _slope(chosen(u, Series([v, one])), v)


def _slope(result: Any, places: Array) -> Array:
    """Return the derivative in what a field gave for a series; a constant has none."""
    return result.coefficients[1] if isinstance(result, Series) else np.zeros_like(places)


def _around(middle: Array, away: Array) -> Array:
    return np.stack([middle - away, middle + away], axis=-1)


def _kinds(square: Array) -> npt.NDArray[np.str_]:
    names = np.array(["elliptic", "parabolic", "hyperbolic", "undefined"])
    index = np.where(np.isnan(square), 3.0, np.sign(square) + 1.0).astype(int)
    result: npt.NDArray[np.str_] = names[index]
    return result


def _rule(ends: tuple[float, float], name: str) -> tuple[Array, Array]:
    """Return places and weights of Gauss' rule between two ends."""
    pair = finite_array(ends, name)
    if pair.shape != (2,):
        raise GeometryError(f"`{name}` must be two numbers, from and to; got {ends}; write (0, 1)")
    half = 0.5 * (pair[1] - pair[0])
    return pair.mean() + half * NODES, half * WEIGHTS
