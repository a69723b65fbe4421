"""Surfaces from a base curve and from dual lines: against the chart, known facts and limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.dual import Dual, normalize
from ruledlab.geometry.jet import QUANTITIES
from ruledlab.geometry.series import Series
from ruledlab.geometry.surface import RuledSurface

from .strategies import curves, formulas, grid, places

few = settings(max_examples=15)
T = np.array([0.1, 0.35, 0.8])


def agree(found, expected, tolerance=1e-10):
    """Compare relative to the largest entry, and to 1."""
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


def same_surface(a, b, t, tolerance=1e-9):
    """Same lines, same invariants, same striction points; σ compared as an angle."""
    for name in ("direction", "moment"):
        agree(getattr(a.line(t), name), getattr(b.line(t), name), tolerance)
    agree(a.striction(t), b.striction(t), tolerance)
    found, expected = a.invariants(t), b.invariants(t)
    for name in QUANTITIES:
        if name != "sigma":
            agree(getattr(found, name), getattr(expected, name), tolerance)
    moving = np.hypot(expected.kappa_bar, expected.tau_bar) > 1e-3
    turn = (found.sigma - expected.sigma)[moving]
    agree(np.sin(turn / 2), np.zeros(turn.shape), 1e-7)


def chart_lines(curve, ubar, vbar):
    """The lines of a chart design as a dual vector of t, by Study's map written out."""
    surface = RuledSurface(curve, ubar, vbar)

    def lines(t):
        angles = curve.series(t.value, t.order)
        u, v = angles[0], angles[1]
        u_hat = Dual(u, surface.ubar(u, v) + 0.0 * u)
        v_hat = Dual(v, surface.vbar(u, v) + 0.0 * u)
        return np.cos(u_hat) * np.sin(v_hat), np.sin(u_hat) * np.sin(v_hat), np.cos(v_hat)

    return surface, lines


def hyperboloid_base(t):
    return np.cos(t), np.sin(t), 0


def hyperboloid_direction(t):
    return -np.sin(t), np.cos(t), 1


def helix_tangents():
    r, p = 0.6, 0.3
    return RuledSurface.from_base(
        lambda t: (r * np.cos(t), r * np.sin(t), p * t),
        lambda t: (-r * np.sin(t), r * np.cos(t), p),
        domain=(0, 5),
    )


# -- laws ------------------------------------------------------------------------------------------


@few
@given(curves(), formulas, formulas, places)
def test_lines_given_outright_make_the_surface_of_the_chart(curve, ubar, vbar, t):
    surface, lines = chart_lines(curve, ubar, vbar)
    same_surface(RuledSurface.from_lines(lines), surface, t)


@few
@given(grid(0.2, 2.0), grid(-1.0, 1.0), grid(0.3, 1.5), st.floats(-2, 2))
def test_neither_sliding_the_base_nor_stretching_the_generator_matters(r, p, slant, slide):
    def base(t):
        return r * np.cos(t), r * np.sin(2 * t), p * t

    def direction(t):
        return -np.sin(t), np.cos(t), slant + 0.2 * np.sin(3 * t)

    def slid(t):
        return [c + slide * np.exp(t) * d for c, d in zip(base(t), direction(t), strict=True)]

    def stretched(t):
        return [(1.5 + np.cos(t)) * d for d in direction(t)]

    same_surface(
        RuledSurface.from_base(slid, stretched, (0, 3)),
        RuledSurface.from_base(base, direction, (0, 3)),
        3 * T,
    )


@few
@given(grid(-1.0, 1.0), grid(0.5, 2.0))
def test_dual_lines_and_base_curve_are_two_spellings_of_one_surface(p, a):
    def base(t):
        return a * np.cos(t), np.sin(a * t), p * t

    def direction(t):
        return np.cos(2 * t), np.sin(2 * t), 0.5 + 0.2 * t

    def lines(t):
        c, d = base(t), direction(t)
        moment = (
            c[1] * d[2] - c[2] * d[1],
            c[2] * d[0] - c[0] * d[2],
            c[0] * d[1] - c[1] * d[0],
        )
        # A factor with a dual part slides the moment along d; normalising must take it out.
        return [(2.0 + Dual(0.0, 0.7)) * Dual(x, y) for x, y in zip(d, moment, strict=True)]

    same_surface(RuledSurface.from_lines(lines), RuledSurface.from_base(base, direction), T)


def test_a_dual_vector_in_one_piece_is_read_along_its_last_axis():
    def whole(t):
        real = [np.cos(t), np.sin(t), 0.5 + 0.0 * t]
        dual = [0.3 * np.sin(t), t * t, 1.0 + 0.0 * t]
        parts = (Series(np.stack([e.coefficients for e in part], axis=-1)) for part in (real, dual))
        return normalize(Dual(*parts))

    def entries(t):
        return Dual(np.cos(t), 0.3 * np.sin(t)), Dual(np.sin(t), t * t), Dual(0.5, 1.0)

    same_surface(RuledSurface.from_lines(whole), RuledSurface.from_lines(entries), T)


# -- what is known of classical surfaces -----------------------------------------------------------


def test_hyperboloid_of_one_sheet():
    surface = RuledSurface.from_base(hyperboloid_base, hyperboloid_direction, (0, 2 * math.pi))
    inv = surface.invariants(T)
    agree(inv.kappa, np.full(3, math.sqrt(0.5)))
    # δ = det(c′, d, d′)‖d‖²/‖d × d′‖², by hand.
    agree(inv.delta, np.full(3, -1.0))
    agree(surface.striction(T), np.column_stack([np.cos(T), np.sin(T), 0 * T]))
    x, y, z = np.moveaxis(surface.points(T, [-1.0, 0.5, 2.0]), -1, 0)
    agree(x**2 + y**2 - z**2, np.ones((3, 3)))
    assert surface.closure().order == 2
    # l = ∮⟨−c′, x⟩ with c′ ⊥ e_z of length 1 against x at π/4.
    assert surface.pitch() == pytest.approx(-2 * math.pi * math.sqrt(0.5), abs=1e-11)


def test_hyperboloid_equals_its_chart_design():
    chart = RuledSurface(Bezier(np.array([[0, 1], [8, 1]]) * math.pi / 4), 0, 1)
    # u = 2πt is the longitude of the direction, a quarter turn ahead of the base point.
    turned = RuledSurface.from_base(
        lambda t: hyperboloid_base(2 * np.pi * t - np.pi / 2),
        lambda t: hyperboloid_direction(2 * np.pi * t - np.pi / 2),
    )
    foot = chart.foot(T)
    agree(np.linalg.norm(foot, axis=-1), np.ones(3))
    opposite = RuledSurface(Bezier(np.array([[0, 1], [8, 1]]) * math.pi / 4), 0, -1)
    same_surface(turned, opposite, T)


def test_tangents_of_a_helix_are_developable_with_the_helix_as_striction_curve():
    surface = helix_tangents()
    inv = surface.invariants(T)
    agree(inv.kappa_bar, np.zeros(3), 1e-14)
    agree(inv.sigma, np.zeros(3))
    agree(surface.striction(T), np.column_stack([0.6 * np.cos(T), 0.6 * np.sin(T), 0.3 * T]))
    agree(surface.curvature(T, [0.5, 1.0]).gauss, np.zeros((3, 2)))


def test_hyperbolic_paraboloid_lies_in_its_equation():
    surface = RuledSurface.from_base(lambda t: (t, 0, 0), lambda t: (0, 1, t), (-1, 1))
    x, y, z = np.moveaxis(surface.points(T, [-2.0, 0.0, 1.0]), -1, 0)
    agree(z, x * y)
    agree(surface.invariants(T).delta, 1 + T**2)


# -- striction by neighbouring rulings -------------------------------------------------------------


@pytest.mark.parametrize("h", [1e-3, -1e-3])
def test_neighbours_come_nearest_at_the_striction_point(h):
    surface = RuledSurface.from_base(
        lambda t: (np.cos(t), np.sin(2 * t), t), lambda t: (np.sin(t), 1 + t, np.cos(3 * t))
    )
    near = surface.neighbours(T, h)
    inv, frame = surface.invariants(T), surface.frame(T)
    agree(near.foot_a, surface.striction(T), 3e-2)
    # n = x × x(t + h) turns with the sign of h, and so does the way along it: d is even in h.
    agree(near.distance / abs(h), inv.kappa_bar, 2e-2)
    agree(near.angle / abs(h), inv.kappa, 2e-2)
    agree(near.line.direction * np.sign(h), frame[:, 2], 2e-2)
    # By brute force: no two points of the rulings are nearer.
    w = np.linspace(-5, 5, 201)
    a, b = surface.points(T, w), surface.points(T + h, w)
    gaps = np.linalg.norm(a[:, :, None] - b[:, None, :], axis=-1).min(axis=(1, 2))
    assert (np.abs(near.distance) <= gaps + 1e-12).all()


def test_the_feet_of_neighbours_converge_with_h_to_the_striction_point():
    surface = RuledSurface.from_base(hyperboloid_base, hyperboloid_direction, (0, 6))
    errors = [
        np.linalg.norm(surface.neighbours(1.0, h).foot_a - surface.striction(1.0))
        for h in (1e-1, 1e-2, 1e-3)
    ]
    assert errors[1] < 0.2 * errors[0] and errors[2] < 0.2 * errors[1]


# -- degenerate cases by name ----------------------------------------------------------------------


def test_a_cylinder_is_cylindrical_everywhere():
    surface = RuledSurface.from_base(lambda t: (np.cos(t), np.sin(t), 0), lambda t: (0, 0, 2))
    inv = surface.invariants(T)
    agree(inv.kappa, np.zeros(3))
    assert np.isnan(inv.kappa_bar).all() and np.isnan(surface.striction(T)).all()
    assert [report.where.all() for report in inv.undefined] == [True]
    assert "cylindrical" in inv.undefined[0].reason


def test_a_cylinder_whose_direction_is_known_to_rounding_only():
    # The factors differ from a constant by rounding, and so do their derivatives.
    surface = RuledSurface.from_base(
        lambda t: (t, 0, 0), lambda t: (np.sin(t) ** 2 + np.cos(t) ** 2, t / (0.1 * t), 3)
    )
    assert np.isnan(surface.invariants(T).tau).all()


def test_a_cone_has_one_striction_point():
    surface = RuledSurface.from_base(lambda t: (1, 2, 3), lambda t: (np.cos(t), np.sin(t), 1))
    agree(surface.striction(T), np.tile([1.0, 2.0, 3.0], (3, 1)))
    inv = surface.invariants(T)
    agree(inv.kappa_bar, np.zeros(3))
    assert np.isnan(inv.sigma).all()


def test_a_direction_that_vanishes_at_one_place_is_undefined_there_only():
    surface = RuledSurface.from_base(
        lambda t: (0, 0, t), lambda t: (t - 0.5, t * (t - 0.5), t - 0.5)
    )
    inv = surface.invariants([0.4, 0.5, 0.6])
    assert np.isnan(inv.kappa).tolist() == [False, True, False]
    (report,) = inv.undefined
    assert report.where.tolist() == [False, True, False] and "direction is zero" in report.reason


def test_a_base_outside_its_domain_is_reported_as_the_base():
    surface = RuledSurface.from_base(
        lambda t: (np.sqrt(t - 0.5), 0, 0), lambda t: (np.cos(t), np.sin(t), 1)
    )
    (report,) = surface.invariants(T).undefined
    assert report.where.tolist() == [True, True, False]
    assert report.reason.startswith("the base curve or the direction: ")
    agree(surface.invariants(T).kappa, np.full(3, math.sqrt(0.5)))


def test_a_moebius_band_closes_reversed():
    surface = RuledSurface.from_base(
        lambda t: (np.cos(t), np.sin(t), 0),
        lambda t: (np.cos(t / 2) * np.cos(t), np.cos(t / 2) * np.sin(t), np.sin(t / 2)),
        (0, 2 * math.pi),
    )
    closure = surface.closure()
    assert closure.closed and not closure.oriented


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: RuledSurface.from_base((0, 0, 0), lambda t: (t, 0, 1)), "`base` must be a func"),
        (lambda: RuledSurface.from_base(lambda t: t, lambda t: (t, 0, 1)), "three components"),
        (lambda: RuledSurface.from_base(lambda t: (0, 0), lambda t: (t, 0, 1)), "three components"),
        (lambda: RuledSurface.from_base(lambda t: (0, 0, 0), lambda t: (0, 0, 0)), "not zero"),
        (
            lambda: RuledSurface.from_base(lambda t: (math.sin(t), 0, 0), lambda t: (1, t, 0)),
            "numpy",
        ),
        (lambda: RuledSurface.from_base(lambda t: (t.value, 0, 0), lambda t: (1, t, 0)), "t whole"),
        (
            lambda: RuledSurface.from_base(lambda t: (Dual(t, 1), 0, 0), lambda t: (1, t, 0)),
            "`base` must return components",
        ),
        (
            lambda: RuledSurface.from_base(lambda t: (0, 0, 0), lambda t: (1, t, 0), (1, 1)),
            "`domain` must be two numbers",
        ),
        (lambda: RuledSurface.from_lines(lambda t: Dual(t, 1)), "three components"),
        (lambda: RuledSurface.from_lines(lambda t: (Dual(0, t), 0, 0)), "not zero"),
    ],
)
def test_errors_name_the_argument(make, says):
    with pytest.raises(GeometryError, match=says) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_the_chart_is_asked_of_chart_surfaces_only():
    surface = helix_tangents()
    for name in ("curve", "ubar", "vbar"):
        with pytest.raises(GeometryError, match=f"`{name}` must be asked of a surface from"):
            getattr(surface, name)
    assert "from_base" not in repr(surface) and "domain=(0.0, 5.0)" in repr(surface)


def test_many_values_are_worked_on_in_blocks_and_in_any_shape():
    surface = helix_tangents()
    t = np.linspace(0, 5, 9000).reshape(30, 300)
    inv = surface.invariants(t)
    assert inv.kappa.shape == (30, 300)
    agree(inv.kappa[17, 3], surface.invariants(t[17, 3]).kappa)
    assert surface.points(t[:2], [0.0, 1.0]).shape == (2, 300, 2, 3)
