"""What printed and right formulas are made of: the chart's values, series of a line, integrals."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..geometry import Bezier, GeometryError, RuledSurface, Series, cross, inner
from ..geometry.checks import Array, finite_array
from ..geometry.quadrature import integrate

__all__ = [
    "Bending",
    "Chart",
    "around",
    "bending",
    "chart",
    "control_points",
    "dot",
    "line",
    "ratio",
    "spread",
    "striction",
    "torsal",
]


@dataclass(frozen=True, eq=False, slots=True)
class Chart:
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


def chart(surface: RuledSurface, t: npt.ArrayLike) -> Chart:
    """Return all that the formulas of §4 speak of; NaN where ū or v̄ has no value."""
    t = finite_array(t, "t")
    (u, v), (du, dv), (ddu, ddv) = surface.curve.series(t, 2).derivatives()
    fields = (surface.ubar, surface.vbar)
    with np.errstate(all="ignore"):
        values = [np.broadcast_to(f(u, v), u.shape) for f in fields]
        values += [slope for f in fields for slope in f.partials(u, v)]
    finite = (np.where(np.isfinite(value), value, np.nan) for value in values)
    return Chart(u, v, du, dv, ddu, ddv, *finite)


def line(surface: RuledSurface, t: npt.ArrayLike, order: int) -> tuple[Series, Series]:
    """Return x and x̄ as series whose values have the shape (3, *t.shape)."""
    jet = surface.jet(finite_array(t, "t"), order)
    factors = np.array([1.0 / math.factorial(k) for k in range(order + 1)])
    rows = jet.rows * factors.reshape(-1, *(1,) * (jet.rows.ndim - 1))
    rows = np.where(jet.pole, np.nan, rows)
    return Series(rows[:, 0]), Series(rows[:, 1])


def striction(x: Series, moment: Series) -> Series:
    """Return m = c − (⟨x′, c′⟩/⟨x′, x′⟩) x by its definition, of an order lower by one."""
    foot, slope = cross(x, moment, 0), x.derivative()
    result: Series = foot - dot(slope, foot.derivative()) / dot(slope, slope) * x
    return result


def dot(a: Any, b: Any) -> Any:
    """Return the inner product along the first axis, of arrays or series."""
    return inner(a, b, 0)


def ratio(above: Array, below: Array) -> Array:
    """Return the quotient, NaN where the denominator is 0."""
    result: Array = above / np.where(below == 0.0, np.nan, below)
    return result


def spread(values: Array, w: Array) -> Array:
    """Return the values with as many axes of length 1 behind as w has."""
    return values.reshape(values.shape + (1,) * w.ndim)


@dataclass(frozen=True, eq=False, slots=True)
class Bending:
    """The invariants of which §2.4 makes its formulas, ready to meet w."""

    kappa: Array
    kappa_bar: Array
    tau: Array
    tau_bar: Array
    kappa_prime: Array
    kappa_bar_prime: Array
    area: Array
    """W = √(κ̄² + w²κ²), NaN where it is 0: there is no tangent plane."""


def bending(surface: RuledSurface, t: npt.ArrayLike, w: Array) -> Bending:
    """Return κ, κ̄, τ, τ̄, κ′, κ̄′ and W."""
    inv = surface.invariants(t)
    names = ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
    values = [spread(getattr(inv, name), w) for name in names]
    area = np.hypot(values[1], w * values[0])
    values.append(np.where(area == 0.0, np.nan, area))
    return Bending(*values)


def torsal(surface: RuledSurface, t: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Tell where κ̄ = 0 but for rounding, so that cot σ is infinite or undefined."""
    return np.asarray(surface.invariants(t).kappa_bar == 0.0)


def around(surface: RuledSurface, integrand: Callable[[Array], Array], what: str) -> Array:
    """Return the integral round a surface that closes.

    Raises
    ------
    GeometryError
        where it does not close as a moving oriented line.
    """
    state = surface.closure()
    if not state.oriented:
        raise GeometryError(
            f"`surface` must close as a moving oriented line for {what}; this one: {state.reason}; "
            "take a closed design such as gallery.surface('example_2')"
        )
    return np.asarray(integrate(integrand, *surface.domain, what))


def control_points(surface: RuledSurface) -> Array:
    """Return the control points, of which §4.2 speaks.

    Raises
    ------
    GeometryError
        where the curve is not a single Bézier curve.
    """
    curve = surface.curve
    if isinstance(curve, Bezier) and not curve.batch_shape:
        return curve.points
    raise GeometryError(
        f"`surface` must have a single Bézier curve: the formulas of §4.2 speak of its control "
        f"points; got {curve!r}; take a design with a Bezier curve"
    )
