"""Ruled surfaces: every quantity by a second route, the laws, and the degenerate cases by name.

Second routes: dual numbers over Taylor series taken literally, the closed forms in u, v, ū, v̄ by
SymPy, the real geometry at ε ≠ 0 differentiated by mpmath to 40 digits, and finite differences.
"""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable
from dataclasses import FrozenInstanceError
from functools import cache
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.dual import Dual, cross, inner, norm
from ruledlab.geometry.jet import QUANTITIES, Jet, measure
from ruledlab.geometry.series import Series
from ruledlab.geometry.surface import BLOCK, RuledSurface

from .strategies import curves, formulas, grid, places, rotations, surfaces, translations

LOCAL = QUANTITIES
few = settings(max_examples=20)
EXAMPLE_2 = np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]]) * math.pi / 8
QUARTIC = np.array([[0.2, 0.9], [0.7, 1.4], [1.5, 0.6], [2.2, 1.9], [2.9, 1.2]])

DESIGNS: dict[str, tuple[np.ndarray, str, str]] = {
    "example 1": (np.array([[0.2, 0.2], [1.9, 1.9]]), "u - v", "u + v"),
    "example 2": (EXAMPLE_2, "u - v", "u + v"),
    "quartic": (QUARTIC, "sin(u)*v", "exp(-v) + u**2/4"),
    "beyond the pole": (  # v > π: the chart covers the sphere a second time
        np.array([[0.5, 3.5], [1.0, 5.0], [2.0, 5.5]]),
        "arctan(u*v)",
        "sqrt(u + v)",
    ),
}


def design(name: str) -> RuledSurface:
    points, ubar, vbar = DESIGNS[name]
    return RuledSurface(Bezier(points), ubar, vbar)


def agree(found: Any, expected: Any, tolerance: float = 1e-10) -> None:
    """Compare arrays relative to the largest entry, and to 1."""
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


def agree_as_angles(found: Any, expected: Any, tolerance: float = 1e-8) -> None:
    np.testing.assert_allclose(np.cos(found), np.cos(expected), rtol=0, atol=tolerance)
    np.testing.assert_allclose(np.sin(found), np.sin(expected), rtol=0, atol=tolerance)


def values_of(invariants: Any) -> np.ndarray:
    return np.stack([getattr(invariants, name) for name in LOCAL])


def same(found: Any, expected: Any, tolerance: float = 1e-10) -> None:
    """Compare two sets of invariants; σ as an angle, where the striction curve moves at all."""
    for name in LOCAL:
        if name != "sigma":
            agree(getattr(found, name), getattr(expected, name), tolerance)
    moving = np.hypot(expected.kappa_bar, expected.tau_bar) > 1e-3
    agree_as_angles(found.sigma[moving], expected.sigma[moving])


def derivative(function: Callable[[np.ndarray], np.ndarray], t: np.ndarray, h: float = 1e-3) -> Any:
    """Fourth-order central difference along the first axis."""
    a, b = function(t + h) - function(t - h), function(t + 2 * h) - function(t - 2 * h)
    return (8.0 * a - b) / (12.0 * h)


def nan_is_explained(invariants: Any) -> None:
    """Every NaN is reported, and what is reported of κ̄, τ̄, σ is NaN."""
    for name in LOCAL:
        where = np.zeros(np.shape(invariants.kappa), dtype=bool)
        for report in invariants.undefined:
            if name in report.names:
                assert report.where.shape == where.shape
                where = where | report.where
        np.testing.assert_array_equal(np.isnan(getattr(invariants, name)), where, err_msg=name)


# -- the definitions, taken literally --------------------------------------------------------------


def dual_vector(*entries: Dual) -> Dual:
    rows = [[entry.real.coefficients, entry.dual.coefficients] for entry in entries]
    real, dual = (Series(np.stack([row[k] for row in rows], axis=1)) for k in (0, 1))
    return Dual(real, dual)


def derived(x: Dual) -> Dual:
    return Dual(x.real.derivative(), x.dual.derivative())


def by_definition(surface: RuledSurface, t: np.ndarray) -> dict[str, np.ndarray]:
    """κ̂ = ‖X′‖ and τ̂ = [X, X′, X″]/‖X′‖², word for word, with Dual over Series."""
    angles = surface.curve.series(t, 3)
    u, v = angles[0], angles[1]
    zero = 0.0 * u
    u_hat = Dual(u, surface.ubar(u, v) + zero)
    v_hat = Dual(v, surface.vbar(u, v) + zero)
    x = dual_vector(
        np.cos(u_hat) * np.sin(v_hat),
        np.sin(u_hat) * np.sin(v_hat),
        np.cos(v_hat) + 0.0 * u_hat,
    )
    x1 = derived(x)
    kappa = norm(x1, axis=0)
    tau = inner(cross(x, x1, axis=0), derived(x1), axis=0) / (kappa * kappa)
    return {
        "kappa": kappa.real.value,
        "kappa_bar": kappa.dual.value,
        "tau": tau.real.value,
        "tau_bar": tau.dual.value,
        "delta": kappa.dual.value / kappa.real.value,
        "sigma": np.mod(np.arctan2(kappa.dual.value, tau.dual.value), 2 * np.pi),
        "kappa_prime": kappa.real.derivative().value,
        "kappa_bar_prime": kappa.dual.derivative().value,
    }


def matches(invariants: Any, expected: dict[str, np.ndarray], tolerance: float) -> None:
    for name in expected:
        check = agree_as_angles if name == "sigma" else agree
        check(getattr(invariants, name), expected[name], tolerance)


@pytest.mark.parametrize("name", DESIGNS)
def test_the_invariants_are_the_parts_of_dual_curvature_and_torsion(name: str) -> None:
    surface, t = design(name), np.linspace(0, 1, 50)
    matches(surface.invariants(t), by_definition(surface, t), 1e-10)


@few
@given(surfaces, places)
def test_the_definitions_hold_for_random_surfaces(surface: RuledSurface, t: np.ndarray) -> None:
    expected = by_definition(surface, t)
    del expected["sigma"]  # ill-conditioned where the striction point nearly rests
    matches(surface.invariants(t), expected, 1e-10)


# -- the closed forms in u, v, ū, v̄ by SymPy -------------------------------------------------------

T, U, V = sympy.symbols("t u v", real=True)


@cache
def closed_forms(name: str) -> Callable[[Any], list[Any]]:
    points, *formulas = DESIGNS[name]
    n = len(points) - 1
    basis = [sympy.binomial(n, i) * T**i * (1 - T) ** (n - i) for i in range(n + 1)]
    u, v = (
        sum(b * sympy.Rational(float(p)) for b, p in zip(basis, row, strict=True))
        for row in points.T
    )
    ubar, vbar = (
        sympy.sympify(text.replace("arctan", "atan"), locals={"u": U, "v": V}) for text in formulas
    )
    at = {U: u, V: v}
    (a, a_u, a_v), (b, b_u, b_v) = (
        [part.subs(at, simultaneous=True) for part in (f, f.diff(U), f.diff(V))]
        for f in (ubar, vbar)
    )
    u1, v1, u2, v2 = u.diff(T), v.diff(T), u.diff(T, 2), v.diff(T, 2)
    s, c = sympy.sin(v), sympy.cos(v)
    square = u1**2 * s**2 + v1**2
    kappa = sympy.sqrt(square)
    mixed = u1**2 * s * (b * c + a_u * s) + u1 * v1 * (b_u + a_v * s**2) + v1**2 * b_v
    tau = (c * (u1**3 * s**2 + 2 * u1 * v1**2) + s * (u2 * v1 - u1 * v2)) / square
    mu = a * c + (s * (v1 * a.diff(T) - u1 * b.diff(T)) + u1 * v1 * b * c) / square
    tau_bar = s * (a * v1 - b * u1) + mu.diff(T)
    forms = [kappa, mixed / kappa, tau, tau_bar, kappa.diff(T), (mixed / kappa).diff(T)]
    return sympy.lambdify(T, forms, "mpmath", cse=True)


@pytest.mark.parametrize("name", DESIGNS)
def test_the_closed_forms(name: str) -> None:
    t = np.array([0.0, 0.21, 0.5, 0.83, 1.0])
    with mpmath.workdps(40):
        expected = [[float(x) for x in closed_forms(name)(mpmath.mpf(float(p)))] for p in t]
    names = ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
    matches(design(name).invariants(t), dict(zip(names, np.array(expected).T, strict=True)), 1e-11)


# -- the real geometry at ε ≠ 0, differentiated by mpmath ------------------------------------------


def bernstein(points: np.ndarray, t: Any) -> list[Any]:
    n = len(points) - 1
    weights = [mpmath.binomial(n, i) * t**i * (1 - t) ** (n - i) for i in range(n + 1)]
    return [mpmath.fdot(weights, [mpmath.mpf(float(p)) for p in row]) for row in points.T]


def by_mpmath(points: np.ndarray, fields: tuple[Callable[..., Any], ...], place: float) -> Any:
    """κ and τ of the spherical curve x(u + eū, v + ev̄) for real e; the bars are d/de at 0."""

    def direction(e: Any, t: Any) -> list[Any]:
        u, v = bernstein(points, t)
        u, v = u + e * fields[0](u, v), v + e * fields[1](u, v)
        return [mpmath.cos(u) * mpmath.sin(v), mpmath.sin(u) * mpmath.sin(v), mpmath.cos(v)]

    def parts(e: Any, t: Any) -> tuple[Any, Any]:
        rows = [mpmath.taylor(lambda s, i=i: direction(e, s)[i], t, 2) for i in range(3)]
        x = mpmath.matrix(rows)
        square = sum(x[i, 1] ** 2 for i in range(3))
        return mpmath.sqrt(square), 2 * mpmath.det(x) / square

    t = mpmath.mpf(place)
    values = [mpmath.diff(lambda e, k=k: parts(e, t)[k], 0, n) for k in (0, 1) for n in (0, 1)]
    values.append(mpmath.diff(lambda s: parts(0, s)[0], t))
    values.append(mpmath.diff(lambda e, s: parts(e, s)[0], (0, t), (1, 1)))
    return [float(value) for value in values]


@pytest.mark.parametrize("place", [0.1])
def test_the_dual_parts_are_derivatives_of_real_geometry(place: float) -> None:
    fields = (
        lambda u, v: mpmath.sin(u) * v,
        lambda u, v: mpmath.exp(-v) + u**2 / 4,
    )
    with mpmath.workdps(40):
        expected = by_mpmath(QUARTIC, fields, place)
    names = ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
    found = design("quartic").invariants(place)
    np.testing.assert_allclose([getattr(found, n) for n in names], expected, rtol=1e-11)


# -- line, frame, striction curve ------------------------------------------------------------------


@few
@given(surfaces, places)
def test_the_lines_are_unit_and_their_moment_is_foot_cross_direction(
    surface: RuledSurface, t: np.ndarray
) -> None:
    line, c = surface.line(t), surface.foot(t)
    x = line.direction
    u, v = np.moveaxis(surface.curve(t), -1, 0)
    agree(x, np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1), 1e-14)
    agree(np.cross(c, x), line.moment)
    agree((c * x).sum(axis=-1), 0.0)
    # ū is the height on the z-axis, v̄ the signed distance from it, of their common perpendicular.
    ubar, vbar = (np.broadcast_to(f(u, v), t.shape) for f in (surface.ubar, surface.vbar))
    zero = np.zeros_like(u)
    point = np.stack([-vbar * np.sin(u), vbar * np.cos(u), ubar + zero], axis=-1)
    agree(np.cross(point, x), line.moment)


@few
@given(surfaces, places)
def test_all_three_lines_of_the_frame_pass_through_the_striction_point(
    surface: RuledSurface, t: np.ndarray
) -> None:
    jet = surface.jet(t, 1)
    (x, x1), (y, y1) = (np.moveaxis(part, 1, -1) for part in (jet.direction, jet.moment))
    big_x, derivative_of_x = Dual(x, y), Dual(x1, y1)
    kappa = norm(derivative_of_x)
    big_x2 = derivative_of_x / Dual(kappa.real[:, None], kappa.dual[:, None])
    big_x3 = cross(big_x, big_x2)
    m, frame = surface.striction(t), surface.frame(t)
    for i, line in enumerate((big_x, big_x2, big_x3)):
        agree(frame[:, i], line.real)
        agree(np.cross(m, line.real), line.dual)
    agree(frame @ np.swapaxes(frame, -1, -2), np.broadcast_to(np.eye(3), frame.shape), 1e-13)
    agree(np.linalg.det(frame), 1.0, 1e-13)


@pytest.mark.parametrize("name", DESIGNS)
def test_the_derivative_equations_of_the_frame(name: str) -> None:
    surface, t = design(name), np.linspace(0.05, 0.95, 13)
    inv, (x1, x2, x3) = surface.invariants(t), np.moveaxis(surface.frame(t), 1, 0)
    kappa, tau = inv.kappa[:, None], inv.tau[:, None]
    d1, d2, d3 = np.moveaxis(derivative(surface.frame, t), 1, 0)
    agree(d1, kappa * x2, 1e-6)
    agree(d2, -kappa * x1 + tau * x3, 1e-6)
    agree(d3, -tau * x2, 1e-6)


@pytest.mark.parametrize("name", DESIGNS)
def test_the_striction_curve_has_the_velocity_tau_bar_x1_plus_kappa_bar_x3(name: str) -> None:
    surface, t = design(name), np.linspace(0.05, 0.95, 13)
    inv, frame = surface.invariants(t), surface.frame(t)
    velocity = derivative(surface.striction, t)
    agree(velocity, inv.tau_bar[:, None] * frame[:, 0] + inv.kappa_bar[:, None] * frame[:, 2], 1e-6)
    speed = np.linalg.norm(velocity, axis=-1)[:, None]
    cosine, sine = np.cos(inv.sigma)[:, None], np.sin(inv.sigma)[:, None]
    agree(velocity / speed, cosine * frame[:, 0] + sine * frame[:, 2], 1e-6)
    assert ((inv.sigma >= 0) & (inv.sigma < 2 * np.pi)).all()


@pytest.mark.parametrize("name", ["example 1", "example 2", "quartic"])
@pytest.mark.parametrize("place", [0.2, 0.5, 0.9])
def test_the_striction_point_is_nearest_to_the_neighbouring_rulings(
    name: str, place: float
) -> None:
    surface, h = design(name), 1e-3
    line, neighbours = surface.line(place), surface.line([place - h, place + h])

    def total(w: float) -> float:
        return float(np.square(neighbours.distance_to(line.foot + w * line.direction)).sum())

    nearest = minimize_scalar(total, bracket=(-1.0, 1.0), tol=1e-12).x
    agree(line.foot + nearest * line.direction, surface.striction(place), 1e-4)


# -- the patch -------------------------------------------------------------------------------------


def differences(surface: RuledSurface, t: float, w: float) -> dict[str, np.ndarray]:
    """First and second derivatives of the patch, from its points alone."""
    h = 2e-3
    steps = h * np.arange(-2, 3)
    first = np.array([1, -8, 0, 8, -1]) / (12 * h)
    second = np.array([-1, 16, -30, 16, -1]) / (12 * h * h)
    points = surface.points(t + steps, w + steps)
    return {
        "r": points[2, 2],
        "t": np.einsum("i,ijk,j->k", first, points, np.eye(5)[2]),
        "w": np.einsum("j,jk->k", first, points[2]),
        "tt": np.einsum("i,ik->k", second, points[:, 2]),
        "tw": np.einsum("i,j,ijk->k", first, first, points),
        "ww": np.einsum("j,jk->k", second, points[2]),
    }


PATCH = [(name, t, w) for name in ("example 1", "example 2", "quartic") for t, w in
         ((0.2, -0.8), (0.47, 0.0), (0.8, 0.65))]  # fmt: skip


@pytest.mark.parametrize(("name", "t", "w"), PATCH)
def test_fundamental_forms_and_normal_by_finite_differences(name: str, t: float, w: float) -> None:
    surface = design(name)
    d, forms = differences(surface, t, w), surface.fundamental_forms(t, w)
    normal = np.cross(d["t"], d["w"])
    normal /= np.linalg.norm(normal)
    expected = {
        "g11": d["t"] @ d["t"],
        "g12": d["t"] @ d["w"],
        "g22": d["w"] @ d["w"],
        "h11": d["tt"] @ normal,
        "h12": d["tw"] @ normal,
        "h22": d["ww"] @ normal,
        "normal": normal,
    }
    for key, value in expected.items():
        agree(getattr(forms, key), value, 2e-6)


@pytest.mark.parametrize(("name", "t", "w"), PATCH)
def test_gauss_and_mean_curvature_by_finite_differences(name: str, t: float, w: float) -> None:
    surface = design(name)
    d, found = differences(surface, t, w), surface.curvature(t, w)
    normal = np.cross(d["t"], d["w"])
    normal /= np.linalg.norm(normal)
    g11, g12, g22 = d["t"] @ d["t"], d["t"] @ d["w"], d["w"] @ d["w"]
    h11, h12, h22 = (d[key] @ normal for key in ("tt", "tw", "ww"))
    area = g11 * g22 - g12**2
    agree(found.gauss, (h11 * h22 - h12**2) / area, 1e-5)
    agree(found.mean, (g22 * h11 - 2 * g12 * h12 + g11 * h22) / (2 * area), 1e-5)


@few
@given(surfaces, places, st.lists(grid(-2, 2), min_size=1, max_size=4))
def test_curvatures_follow_from_the_forms_and_from_delta(
    surface: RuledSurface, t: np.ndarray, w: list[float]
) -> None:
    forms, found = surface.fundamental_forms(t, w), surface.curvature(t, w)
    delta = surface.invariants(t).delta[:, None]
    plain = np.square(delta) + np.square(w) > 1e-4
    area = forms.g11 * forms.g22 - forms.g12**2
    gauss = (forms.h11 * forms.h22 - forms.h12**2) / area
    mean = (forms.g22 * forms.h11 - 2 * forms.g12 * forms.h12) / (2 * area)
    by_delta = -np.square(delta / (np.square(delta) + np.square(w)))
    np.testing.assert_allclose(found.gauss[plain], gauss[plain], rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(found.gauss[plain], by_delta[plain], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found.mean[plain], mean[plain], rtol=1e-6, atol=1e-9)
    assert (found.gauss[plain] <= 0).all()


def test_points_are_striction_point_plus_w_times_direction() -> None:
    surface, t, w = design("quartic"), np.array([0.1, 0.6]), np.array([[-1.0, 0.0, 2.0]])
    found = surface.points(t, w)
    assert found.shape == (2, 1, 3, 3)
    m, x = surface.striction(t), surface.line(t).direction
    agree(found, m[:, None, None] + w[..., None] * x[:, None, None], 1e-14)


# -- laws ------------------------------------------------------------------------------------------


@few
@given(surfaces, places, rotations, translations)
def test_invariance_under_rigid_motions(
    surface: RuledSurface, t: np.ndarray, rotation: np.ndarray, shift: np.ndarray
) -> None:
    """X ↦ RX, x̄ ↦ Rx̄ + d × Rx: a dual rotation, applied to every derivative alike."""
    jet = surface.jet(t)
    x = np.einsum("ij,kj...->ki...", rotation, jet.direction)
    y = np.einsum("ij,kj...->ki...", rotation, jet.moment)
    y = y + np.cross(shift[None, :, None], x, axis=1)
    values, _ = measure(Jet(np.stack([x, y], axis=1), jet.scale))
    expected = surface.invariants(t)
    for row, name in zip(values, LOCAL, strict=True):
        if name != "sigma":
            agree(row, getattr(expected, name), 1e-9)


@few
@given(curves(), formulas, formulas, places, grid(-3, 3))
def test_turning_the_chart_about_the_axis_changes_nothing(
    curve: Bezier, ubar: str, vbar: str, t: np.ndarray, angle: float
) -> None:
    surface = RuledSurface(curve, ubar, vbar)
    turned = RuledSurface(
        Bezier(curve.points + np.array([angle, 0.0])),
        lambda u, v: surface.ubar(u - angle, v),
        lambda u, v: surface.vbar(u - angle, v),
    )
    same(turned.invariants(t), surface.invariants(t))


class Composed:
    """The curve t ↦ b(φ(t)), φ a polynomial: another parameter, another source of jets."""

    batch_shape = ()
    domain = (0.0, 1.0)

    def __init__(self, curve: Bezier, phi: np.polynomial.Polynomial) -> None:
        n = curve.degree
        variable = np.polynomial.Polynomial([0.0, 1.0])
        basis = [math.comb(n, i) * variable**i * (1 - variable) ** (n - i) for i in range(n + 1)]
        self._rows = [
            sum(b * float(p) for b, p in zip(basis, row, strict=True))(phi)
            for row in curve.points.T
        ]
        self.scale = curve.scale

    def series(self, t: np.ndarray, order: int) -> Series:
        rows = [
            np.stack([row.deriv(k)(t) / math.factorial(k) for k in range(order + 1)])
            for row in self._rows
        ]
        return Series(np.stack(rows, axis=1))


@few
@given(curves(most=4), formulas, formulas, places, grid(0.3, 1.7))
def test_reparametrisation(
    curve: Bezier, ubar: str, vbar: str, t: np.ndarray, slope: float
) -> None:
    """κ, κ̄, τ, τ̄ scale with dt; δ and σ stay; κ′ and κ̄′ follow the chain rule."""
    phi = np.polynomial.Polynomial([0.0, slope, 1.0 - slope])  # onto [0, 1]: φ′ ≥ 0.3
    old = RuledSurface(curve, ubar, vbar).invariants(phi(t))
    new = RuledSurface(Composed(curve, phi), ubar, vbar).invariants(t)
    rate, bend = phi.deriv()(t), phi.deriv(2)(t)
    for name in ("kappa", "kappa_bar", "tau", "tau_bar"):
        agree(getattr(new, name), rate * getattr(old, name), 1e-9)
    for name in ("kappa", "kappa_bar"):
        chain = bend * getattr(old, name) + rate**2 * getattr(old, f"{name}_prime")
        agree(getattr(new, f"{name}_prime"), chain, 1e-9)
    agree(new.delta, old.delta, 1e-9)
    moving = np.hypot(old.kappa_bar, old.tau_bar) > 1e-3
    agree_as_angles(new.sigma[moving], old.sigma[moving])


@few
@given(surfaces, places, grid(0.1, 0.9))
def test_a_part_of_the_curve(surface: RuledSurface, t: np.ndarray, cut: float) -> None:
    first, second = surface.curve.split(cut)
    for part, start, rate in ((first, 0.0, cut), (second, cut, 1.0 - cut)):
        new = RuledSurface(part, surface.ubar, surface.vbar).invariants(t)
        old = surface.invariants(start + rate * t)
        for name, power in zip(LOCAL, (1, 1, 1, 1, 0, 0, 2, 2), strict=True):
            if name != "sigma":
                agree(getattr(new, name), rate**power * getattr(old, name), 1e-9)


@few
@given(surfaces, places)
def test_running_backwards(surface: RuledSurface, t: np.ndarray) -> None:
    """κ̂ stays, τ̂ changes its sign, σ becomes π − σ, derivatives change their sign."""
    back = RuledSurface(surface.curve.reversed(), surface.ubar, surface.vbar).invariants(1.0 - t)
    there = surface.invariants(t)
    for name, sign in zip(LOCAL, (1, 1, -1, -1, 0, 1, -1, -1), strict=True):
        if sign:
            agree(getattr(back, name), sign * getattr(there, name), 1e-9)
    moving = np.hypot(there.kappa_bar, there.tau_bar) > 1e-3
    agree_as_angles(back.sigma[moving], np.pi - there.sigma[moving])


@few
@given(surfaces, places)
def test_the_lines_reversed(surface: RuledSurface, t: np.ndarray) -> None:
    """X ↦ −X keeps κ̂ and δ and changes the sign of τ̂."""
    jet = surface.jet(t)
    values, _ = measure(Jet(-jet.rows, jet.scale, jet.pole))
    there = surface.invariants(t)
    for row, name, sign in zip(values, LOCAL, (1, 1, -1, -1, 0, 1, 1, 1), strict=True):
        if sign:
            agree(row, sign * getattr(there, name), 1e-12)


@few
@given(surfaces, places, st.integers(1, 5))
def test_degree_raising_changes_nothing(surface: RuledSurface, t: np.ndarray, times: int) -> None:
    raised = RuledSurface(surface.curve.raised(times), surface.ubar, surface.vbar)
    same(raised.invariants(t), surface.invariants(t))


@pytest.mark.parametrize("ubar", ["u - v", 0.5, lambda u, v: np.sin(u) * v])
def test_a_batch_is_a_loop(ubar: Any) -> None:
    points = QUARTIC + np.random.default_rng(7).uniform(-0.1, 0.1, (2, 3, 5, 2))
    batch, t, w = RuledSurface(Bezier(points), ubar, "u + v"), np.linspace(0, 1, 7), [0.5, 2.0]
    found, bent = batch.invariants(t), batch.curvature(t, w)
    assert found.kappa.shape == (2, 3, 7)
    for index in np.ndindex(2, 3):
        one = RuledSurface(Bezier(points[index]), ubar, "u + v")
        np.testing.assert_allclose(
            values_of(found)[(slice(None), *index)], values_of(one.invariants(t)), rtol=1e-12
        )
        agree(batch.striction(t)[index], one.striction(t), 1e-13)
        agree(batch.frame(t)[index], one.frame(t), 1e-13)
        agree(batch.line(t).moment[index], one.line(t).moment, 1e-13)
        agree(batch.points(t, w)[index], one.points(t, w), 1e-13)
        agree(bent.gauss[index], one.curvature(t, w).gauss, 1e-12)
        agree(bent.mean[index], one.curvature(t, w).mean, 1e-12)


@pytest.mark.parametrize("shape", [(), (0,), (1,), (3,), (2, 3), (2, 0)])
@pytest.mark.parametrize("batch", [(), (4,)])
def test_t_of_every_shape(shape: tuple[int, ...], batch: tuple[int, ...]) -> None:
    points = np.broadcast_to(QUARTIC, (*batch, 5, 2))
    surface = RuledSurface(Bezier(points), "u - v", "u + v")
    t = np.linspace(0.1, 0.9, math.prod(shape)).reshape(shape)
    found, full = surface.invariants(t), (*batch, *shape)
    assert all(getattr(found, name).shape == full for name in LOCAL)
    assert found.t.shape == shape
    assert found.undefined == ()
    line = surface.line(t)
    vectors = (line.direction, line.moment, surface.foot(t), surface.striction(t))
    assert all(vector.shape == (*full, 3) for vector in vectors)
    assert surface.frame(t).shape == (*full, 3, 3)
    for w_shape in ((), (2,), (2, 1)):
        w = np.ones(w_shape)
        assert surface.points(t, w).shape == (*full, *w_shape, 3)
        assert surface.curvature(t, w).mean.shape == (*full, *w_shape)
        forms = surface.fundamental_forms(t, w)
        assert forms.h11.shape == forms.g22.shape == (*full, *w_shape)
        assert forms.normal.shape == (*full, *w_shape, 3)
    if shape == (2, 3):
        flat = surface.invariants(t.ravel())
        np.testing.assert_allclose(
            values_of(found).reshape(8, *batch, 6), values_of(flat), rtol=1e-12
        )


@pytest.mark.parametrize(
    ("size", "batch"),
    [
        (BLOCK - 1, ()),
        (BLOCK, ()),
        (BLOCK + 1, ()),
        (100_000, ()),
        (BLOCK // 3, (3,)),
        (BLOCK // 3 + 1, (3,)),
        (4 * BLOCK + 17, (3,)),
    ],
)
def test_blocks_leave_no_seam(size: int, batch: tuple[int, ...]) -> None:
    points = QUARTIC + np.random.default_rng(3).uniform(-0.1, 0.1, (*batch, 5, 2))
    surface = RuledSurface(Bezier(points), "u - v", "u + v")
    t = np.linspace(0, 1, size)
    edges = np.arange(0, size, BLOCK // 3)
    probes = np.unique(np.concatenate([edges, edges[1:] - 1, [size - 1]]))
    few_places = t[probes]
    small, large = surface.invariants(few_places), surface.invariants(t)
    np.testing.assert_allclose(values_of(large)[..., probes], values_of(small), rtol=1e-10)
    agree(surface.striction(t)[..., probes, :], surface.striction(few_places), 1e-12)
    agree(surface.frame(t)[..., probes, :, :], surface.frame(few_places), 1e-12)
    agree(surface.line(t).moment[..., probes, :], surface.line(few_places).moment, 1e-12)


@pytest.mark.parametrize("method", ["invariants", "frame"])  # the largest of each kind
def test_a_million_values_within_400_megabytes(method: str) -> None:
    surface, t = design("example 2"), np.linspace(0, 1, 10**6)
    tracemalloc.start()
    try:
        result = getattr(surface, method)(t)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert result is not None
    assert peak < 400e6


# -- degenerate cases, by name ---------------------------------------------------------------------
# Warnings are errors in the whole test suite: "no warning" is part of each of these.


def only_reason(surface: RuledSurface, t: Any) -> Any:
    invariants = surface.invariants(t)
    nan_is_explained(invariants)
    (report,) = invariants.undefined
    return report


def test_nothing_is_undefined_on_an_ordinary_surface() -> None:
    invariants = design("quartic").invariants(np.linspace(0, 1, 100))
    assert invariants.undefined == ()
    nan_is_explained(invariants)


def test_a_curve_that_stays_in_one_point_is_cylindrical_everywhere() -> None:
    surface = RuledSurface(Bezier(np.array([[0.3, 0.9]] * 4)), "u", "v")
    t = np.linspace(0, 1, 5)
    report = only_reason(surface, t)
    assert report.where.all()
    assert "κ = 0" in report.reason
    assert "kappa" not in report.names
    np.testing.assert_array_equal(surface.invariants(t).kappa, 0.0)
    assert np.isnan(surface.striction(t)).all()
    assert np.isnan(surface.curvature(t, [0.0, 1.0]).mean).all()
    frame = surface.frame(t)
    assert np.isfinite(frame[:, 0]).all()
    assert np.isnan(frame[:, 1:]).all()


def test_a_curve_that_starts_from_rest_is_cylindrical_there() -> None:
    surface = RuledSurface(Bezier(np.array([[0, 1], [0, 1], [1, 2], [2, 1.5]])), "u", "v")
    t = np.linspace(0, 1, 11)
    report = only_reason(surface, t)
    assert report.where.tolist() == [True] + [False] * 10
    assert "cylindrical" in report.reason
    assert np.isnan(surface.striction(t)).any(axis=-1).tolist() == report.where.tolist()


@pytest.mark.parametrize("stop", [0.5, 0.3])
def test_a_curve_that_stops_on_its_way(stop: float) -> None:
    a, b = -stop, 1.0 - stop  # (t − s)³ has the control values a³, a²b, ab², b³
    cubic = np.array([a**3, a * a * b, a * b * b, b**3])
    surface = RuledSurface(Bezier(np.column_stack([9 * cubic, 1.2 + cubic])), "u - v", "u + v")
    t = np.array([0.0, stop, 1.0])
    report = only_reason(surface, t)
    assert report.where.tolist() == [False, True, False]
    assert surface.invariants(t).kappa[1] < 1e-12


APEXES = {
    "the origin": ("0", "0", (0.0, 0.0, 0.0)),
    "on the axis": ("1.5", "0", (0.0, 0.0, 1.5)),
    "anywhere": (
        "0.5 - (cos(u) + 0.8*sin(u))*cos(v)/sin(v)",
        "0.8*cos(u) - sin(u)",
        (1.0, 0.8, 0.5),
    ),
}


@pytest.mark.parametrize("apex", APEXES)
@pytest.mark.parametrize("points", [EXAMPLE_2, QUARTIC], ids=["example 2", "quartic"])
def test_a_cone(points: np.ndarray, apex: str) -> None:
    ubar, vbar, place = APEXES[apex]
    surface, t = RuledSurface(Bezier(points), ubar, vbar), np.linspace(0, 1, 60)
    report, invariants = only_reason(surface, t), surface.invariants(t)
    assert report.names == ("sigma",)
    assert report.where.all()
    assert "κ̄ = τ̄ = 0" in report.reason
    np.testing.assert_array_equal(invariants.kappa_bar, 0.0)
    agree(invariants.tau_bar, 0.0, 1e-12)
    agree(surface.striction(t), np.broadcast_to(place, (60, 3)), 1e-13)
    curvature = surface.curvature(t, [-1.0, 0.0, 2.0])
    np.testing.assert_array_equal(curvature.gauss[:, [0, 2]], 0.0)
    assert np.isnan(curvature.gauss[:, 1]).all()
    assert np.isnan(curvature.mean[:, 1]).all()
    agree(curvature.mean[:, 2], -invariants.tau / invariants.kappa / 4.0, 1e-12)


@pytest.mark.parametrize("pole", [0.0, math.pi])
def test_a_pole_hit_exactly(pole: float) -> None:
    points = np.array([[0.4, pole - 0.7], [0.9, pole + 0.7]])
    surface, t = RuledSurface(Bezier(points), "u - v", "u + v"), np.linspace(0, 1, 5)
    report = only_reason(surface, t)
    assert report.where.tolist() == [False, False, True, False, False]
    assert "pole" in report.reason
    assert report.names == LOCAL


def test_a_formula_outside_its_domain_on_a_part() -> None:
    line = Bezier(np.array([[-1.0, 0.5], [1.0, 1.5]]))
    t = np.linspace(0, 1, 9)  # u = 2t − 1 and v = t + ½ pass through 0 and 1 at t = ½
    for ubar, vbar, undefined in (
        ("sqrt(u)", "1", t <= 0.5),
        ("v", "log(v - 1)", t <= 0.5),
        ("1/u", "v", t == 0.5),
        ("abs(u)", "v", t == 0.5),
        ("u**1.5", "v", t <= 0.5),
        ("v", "arccos(v)", t >= 0.5),
    ):
        surface = RuledSurface(line, ubar, vbar)
        report = only_reason(surface, t)
        assert report.where.tolist() == undefined.tolist(), ubar
        assert f"ū = {ubar}, v̄ = {vbar}" in report.reason
        assert np.isfinite(surface.invariants(t).kappa).all()
        assert np.isfinite(surface.invariants(t).tau).all()
        assert (np.isnan(surface.striction(t)).any(axis=-1) == undefined).all()
        assert (np.isnan(surface.curvature(t, 1.0).mean) == undefined).all()


def test_a_python_function_outside_its_domain_is_named_as_such() -> None:
    surface = RuledSurface(Bezier(QUARTIC), lambda u, v: np.sqrt(u - 1), 0)
    report = only_reason(surface, np.linspace(0, 1, 9))
    assert "a Python function" in report.reason


def test_overflow_is_undefined_and_not_a_spike() -> None:
    surface = RuledSurface(Bezier(EXAMPLE_2), "exp(exp(9*u))", "v")
    t = np.linspace(0, 1, 50)
    invariants = surface.invariants(t)
    nan_is_explained(invariants)
    (report,) = invariants.undefined
    assert 0 < report.where.sum() < 50
    for array in (values_of(invariants), surface.points(t, [0.0, 1.0])):
        assert not np.isinf(array).any()


def test_enormous_lengths_are_lengths() -> None:
    """Squares overflow long before the lengths do."""
    t = np.linspace(0, 1, 9)
    small = RuledSurface(Bezier(EXAMPLE_2), "u", "v").invariants(t)
    large = RuledSurface(Bezier(EXAMPLE_2), "1e200*u", "1e200*v").invariants(t)
    assert large.undefined == ()
    np.testing.assert_allclose(large.kappa_bar / 1e200, small.kappa_bar, rtol=1e-10)
    np.testing.assert_allclose(large.tau_bar / 1e200, small.tau_bar, rtol=1e-10)
    np.testing.assert_allclose(large.sigma, small.sigma, rtol=1e-10)


def test_at_the_edge_of_overflow_nothing_is_said_to_rest() -> None:
    """The yardstick for m′ = 0 overflows a little before m′ does."""
    surface = RuledSurface(Bezier(EXAMPLE_2), "5e306*u", "5e306*v")
    invariants = surface.invariants(np.linspace(0, 1, 41))
    nan_is_explained(invariants)
    assert 0 < np.isnan(invariants.tau_bar).sum() < 41
    assert not any("rests" in report.reason for report in invariants.undefined)


def test_each_place_has_its_own_reason() -> None:
    # v = 1 − 2t² comes to rest at t = 0, passes the pole at t = √½ and is negative after it.
    points = np.array([[0.0, 1.0], [0.0, 1.0], [1.0, -1.0]])
    surface = RuledSurface(Bezier(points), "log(v)", "1")
    t = np.array([0.0, 0.5, math.sqrt(0.5), 1.0])
    invariants = surface.invariants(t)
    nan_is_explained(invariants)
    found = {report.reason: report.where.tolist() for report in invariants.undefined}
    for part, where in (("pole", 2), ("cylindrical", 0), ("ū = log(v)", 3)):
        (reason,) = (text for text in found if part in text)
        assert found[reason] == [i == where for i in range(4)]


def test_a_torsal_ruling_has_no_tangent_plane_at_its_striction_point_only() -> None:
    half_turn = Bezier(np.array([[0, math.pi / 2], [math.pi, math.pi / 2]]))
    conoid = RuledSurface(half_turn, "sin(2*u)", 0)
    curvature = conoid.curvature(0.25, [-1e-6, 0.0, 1e-6])
    assert conoid.invariants(0.25).kappa_bar == 0.0
    assert np.isnan(curvature.gauss).tolist() == [False, True, False]
    assert np.isnan(conoid.fundamental_forms(0.25, 0.0).normal).all()
    assert np.isfinite(conoid.points(0.25, 0.0)).all()


@few
@given(surfaces, places)
def test_random_surfaces_have_no_unexplained_nan(surface: RuledSurface, t: np.ndarray) -> None:
    nan_is_explained(surface.invariants(t))


# -- arguments and results -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("t", "says"),
    [
        (math.nan, "`t` must be finite"),
        ([0.1, math.inf], "`t` must be finite"),
        ("half", "`t` must be made of real numbers"),
        ([1j], "`t` must be made of real numbers"),
        (None, "`t` must be made of real numbers"),
    ],
)
def test_a_bad_t_is_refused_by_name(t: Any, says: str) -> None:
    surface = design("quartic")
    for method in (surface.invariants, surface.line, surface.striction, surface.frame):
        with pytest.raises(GeometryError, match=says) as error:
            method(t)
        assert "\n" not in str(error.value)
    with pytest.raises(GeometryError, match=says.replace("`t`", "`w`")):
        surface.points(0.5, t)


def test_a_curve_must_be_a_curve() -> None:
    with pytest.raises(GeometryError, match=r"`curve` must be a curve such as Bezier.*got ndarray"):
        RuledSurface(EXAMPLE_2, "u", "v")  # type: ignore[arg-type]


def test_results_are_frozen() -> None:
    t = np.linspace(0, 1, 4)
    invariants = design("quartic").invariants(t)
    t[:] = 7.0
    assert invariants.t[0] == 0.0
    with pytest.raises(FrozenInstanceError):
        invariants.kappa = t  # type: ignore[misc]
    for name in ("t", *LOCAL):
        with pytest.raises(ValueError, match="read-only"):
            getattr(invariants, name)[0] = 1.0


def test_numbers_formulas_and_functions_give_the_same_surface() -> None:
    t = np.linspace(0, 1, 9)
    typed = RuledSurface(Bezier(QUARTIC), "2", "sin(u)*v").invariants(t)
    given_ = RuledSurface(Bezier(QUARTIC), 2, lambda u, v: np.sin(u) * v).invariants(t)
    np.testing.assert_array_equal(values_of(typed), values_of(given_))


def test_the_pieces_of_a_surface_can_be_asked_for() -> None:
    curve = Bezier(QUARTIC)
    surface = RuledSurface(curve, "u", 2)
    assert surface.curve is curve
    assert (surface.ubar.text, surface.vbar.text) == ("u", "2")
    assert surface.domain == (0.0, 1.0)
    assert repr(surface) == "RuledSurface(Bezier(degree=4), ubar=field('u'), vbar=field('2'))"
    other = RuledSurface(curve, lambda u, v: u, 2)
    assert "ubar=field(a Python function)" in repr(other)


def test_invariants_are_shown_as_plain_numbers_and_nothing_else() -> None:
    text = repr(RuledSurface(Bezier(QUARTIC), "u", 2).invariants(0.5))
    shown = dict(part.split("=") for part in text[len("Invariants(") : -1].split(", "))
    assert list(shown) == ["t", *QUANTITIES]
    assert all(math.isfinite(float(value)) for value in shown.values())


def test_values_are_the_same_one_by_one() -> None:
    surface, t = design("example 2"), np.linspace(0, 1, 12)
    together = values_of(surface.invariants(t))
    for i, place in enumerate(t):
        alone = values_of(surface.invariants(float(place)))
        np.testing.assert_allclose(together[:, i], alone, rtol=1e-12, atol=1e-14)
