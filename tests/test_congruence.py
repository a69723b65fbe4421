"""Congruences: the menu's meanings, focal points by neighbouring lines, divergence and flux."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.choices import CHOICES
from ruledlab.geometry.congruence import Congruence
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.line import common_perpendicular
from ruledlab.geometry.surface import RuledSurface

from .strategies import colatitudes, formulas, grid

few = settings(max_examples=20)
MENU = {choice.key: Congruence(choice.ubar, choice.vbar) for choice in CHOICES}
U, V = np.meshgrid([-0.7, 0.4, 1.9], [0.6, 1.2, 2.3], indexing="ij")
congruences = st.builds(Congruence, formulas, formulas)
longitudes = grid(-2.0, 2.0)


def agree(found, expected, tolerance=1e-10):
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


def partial(function, u, v, du, dv, h=1e-3):
    """Fourth-order central difference along (du, dv)."""
    a = function(u + h * du, v + h * dv) - function(u - h * du, v - h * dv)
    b = function(u + 2 * h * du, v + 2 * h * dv) - function(u - 2 * h * du, v - 2 * h * dv)
    return (8.0 * a - b) / (12.0 * h)


def determinant(congruence, u, v, w):
    """[c_u + w x_u, c_v + w x_v, x]: zero where the map (u, v, w) → space is singular."""
    x = congruence.line(u, v).direction
    columns = [
        partial(lambda a, b: congruence.line(a, b).foot, u, v, *d)
        + w * partial(lambda a, b: congruence.line(a, b).direction, u, v, *d)
        for d in ((1, 0), (0, 1))
    ]
    return float(np.linalg.det(np.stack([*columns, x])))


# -- laws ------------------------------------------------------------------------------------------


@few
@given(congruences, longitudes, colatitudes)
def test_focal_points_are_where_the_map_to_space_is_singular(congruence, u, v):
    focal = congruence.focal(u, v)
    size = 1.0 + float(np.abs(congruence.matrix(u, v)).max())
    at = [determinant(congruence, u, v, w) for w in (-1.0, 0.0, 1.0)]
    a, b, c = (at[0] + at[2]) / 2 - at[1], (at[2] - at[0]) / 2, at[1]
    if focal.kind == "elliptic":
        assert b * b - 4 * a * c < 1e-6 * size**2
    else:
        agree(a * focal.w**2 + b * focal.w + c, np.zeros(2), 1e-6 * size**2)
    agree(focal.midpoint, -b / (2 * a), 1e-6 * size)


@few
@given(congruences, longitudes, colatitudes, grid(0.0, 6.2))
def test_feet_of_the_common_perpendiculars_lie_between_the_limit_points(congruence, u, v, angle):
    focal, line = congruence.focal(u, v), congruence.line(u, v)
    h = 1e-5
    near = congruence.line(u + h * math.cos(angle) / math.sin(v), v + h * math.sin(angle))
    foot = common_perpendicular(line, near).foot_a
    w = float((foot - line.foot) @ line.direction)
    slack = 1e-3 * (1.0 + float(np.abs(focal.limits).max()))
    assert focal.limits[0] - slack <= w <= focal.limits[1] + slack
    if focal.kind != "elliptic":
        assert focal.limits[0] - slack <= focal.w[0] <= focal.w[1] <= focal.limits[1] + slack
    assert float(focal.limits.mean()) == pytest.approx(float(focal.midpoint))


@few
@given(congruences, longitudes, colatitudes)
def test_divergence_by_the_formula_and_by_the_field_in_space(congruence, u, v):
    # The surface divergence of the moments, Σ ⟨∂x̄/∂e_i, e_i⟩.
    e1 = np.array([-math.sin(u), math.cos(u), 0.0])
    by_u, by_v = (
        partial(lambda a, b: congruence.line(a, b).moment, u, v, *d) for d in ((1, 0), (0, 1))
    )
    e2 = np.array([math.cos(u) * math.cos(v), math.sin(u) * math.cos(v), -math.sin(v)])
    expected = by_u @ e1 / math.sin(v) + by_v @ e2
    agree(congruence.divergence(u, v), expected, 1e-6)


@few
@given(formulas, formulas, longitudes, colatitudes, grid(0.2, 1.0), grid(-0.4, 0.4))
def test_flux_through_a_rectangle_is_the_circulation_round_it(ubar, vbar, u, v, width, height):
    congruence = Congruence(ubar, vbar)
    corners = np.array([[u, v], [u + width, v], [u + width, v + height], [u, v + height], [u, v]])
    nodes, weights = np.polynomial.legendre.leggauss(30)
    total = 0.0
    for a, b in pairwise(corners):
        p, q = a[:, None] + 0.5 * (1 + nodes) * (b - a)[:, None]
        du, dv = 0.5 * (b - a)
        form = np.sin(q) * (congruence.ubar(p, q) * dv - congruence.vbar(p, q) * du)
        total += float(np.broadcast_to(form, p.shape) @ weights)
    agree(congruence.flux((u, u + width), (v, v + height)), total, 1e-9)


@few
@given(congruences, longitudes, colatitudes, grid(-1.0, 1.0), grid(0.3, 1.0))
def test_a_surface_of_the_congruence_turns_its_striction_by_the_matrix(c, u, v, slope, step):
    # κκ̄ = ⟨x′, x̄′⟩ = x′ · (x′ × M x′) up to orientation: the same quadratic form.
    curve = Bezier([[u, v], [u + step, v + slope * step]])
    surface = RuledSurface(curve, c.ubar, c.vbar)
    inv, m = surface.invariants(0.0), c.matrix(u, v)
    p = np.array([step * math.sin(v), slope * step])
    q = m @ p
    agree(inv.kappa * inv.kappa_bar, p[0] * -q[1] + p[1] * q[0], 1e-9)


@few
@given(congruences, longitudes, colatitudes, grid(0.0, 3.1))
def test_the_parameters_of_all_surfaces_lie_between_two_that_add_up_to_the_divergence(c, u, v, way):
    def delta(angle):  # of the surface itself, by its own route
        step = 0.5 * np.array([math.cos(angle) / math.sin(v), math.sin(angle)])
        curve = Bezier([[u, v], [u, v] + step])
        return float(RuledSurface(curve, c.ubar, c.vbar).invariants(0.0).delta)

    least, greatest = c.parameters(u, v)
    size = 1.0 + float(np.abs(c.matrix(u, v)).max())
    found = np.array([delta(way + k * math.pi / 8) for k in range(8)])
    assert (least - 1e-9 * size <= found).all() and (found <= greatest + 1e-9 * size).all()
    agree((found[:4] + found[4:]) / size, np.full(4, c.divergence(u, v) / size))
    # a sinusoid of twice the angle: both ends are reached
    agree(np.hypot(found[0] - found[4], found[2] - found[6]) / size, (greatest - least) / size)
    signs = {"elliptic": least * greatest > 0, "hyperbolic": least * greatest < 0}
    assert signs.get(str(c.kind(u, v)), abs(least * greatest) < 1e-9 * size**2)


# -- the menu --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "apex"), [("origin", (0, 0, 0)), ("cone", (0, 0, 1)), ("bundle", (1, 0.8, 0.5))]
)
def test_a_bundle_has_its_apex_for_every_focal_point(key, apex):
    focal = MENU[key].focal(U, V)
    assert (focal.kind == "parabolic").all()
    agree(focal.points, np.broadcast_to(np.array(apex, dtype=float), (3, 3, 2, 3)))
    agree(focal.limits, focal.w)


def test_lines_that_touch_a_sphere_have_a_focal_point_on_it():
    focal, line = MENU["sphere"].focal(U, V), MENU["sphere"].line(U, V)
    agree(np.linalg.norm(line.foot, axis=-1), np.ones((3, 3)))
    assert (focal.kind == "hyperbolic").all()
    nearest = np.abs(np.linalg.norm(focal.points, axis=-1) - 1.0).min(axis=-1)
    agree(nearest, np.zeros((3, 3)))
    agree(np.abs(focal.w).min(axis=-1), np.zeros((3, 3)))


@pytest.mark.parametrize("key", ["torus_normals", "ellipsoid_normals", "saddle_normals"])
def test_normals_of_a_surface_have_two_focal_points_and_no_divergence(key):
    focal = MENU[key].focal(U, V)
    assert np.isin(focal.kind, ["hyperbolic", "parabolic"]).all()
    agree(MENU[key].divergence(U, V), np.zeros((3, 3)))
    agree(focal.limits, focal.w)
    assert MENU[key].flux((0.1, 1.5), (0.4, 1.2)) == pytest.approx(0.0, abs=1e-12)


def test_normals_of_a_torus_meet_its_circle_and_its_axis():
    points = MENU["torus_normals"].focal(U, V).points
    from_axis = np.sort(np.hypot(points[..., 0], points[..., 1]), axis=-1)
    agree(from_axis, np.broadcast_to([0.0, 1.0], (3, 3, 2)))


def test_normals_of_an_ellipsoid_have_its_centres_of_curvature():
    # x² + y² + z²/4 = 1 with outward normal at colatitude v: the point is (sin v, …, 4 cos v)/h,
    # h = √(sin²v + 4cos²v); its radii of curvature are 4/h³ (meridian) and 1/h (to the axis).
    points = MENU["ellipsoid_normals"].focal(U, V).points
    h = np.sqrt(np.sin(V) ** 2 + 4 * np.cos(V) ** 2)
    x = MENU["ellipsoid_normals"].line(U, V).direction
    touching = x * np.array([1.0, 1.0, 4.0]) / h[..., None]
    radii = np.stack([4 / h**3, 1 / h], axis=-1)
    along = ((touching[..., None, :] - points) * x[..., None, :]).sum(axis=-1)
    agree(np.sort(along, axis=-1), np.sort(radii, axis=-1))


def test_lines_of_a_linear_complex():
    # Plücker coordinates (x, x̄) with x̄_z + p x_z = 0, p = 0.5, and they stay so with any ū.
    for ubar in ("0", "sin(u) + v"):
        line = Congruence(ubar, "0.5*cos(v)/sin(v)").line(U, V)
        agree(line.moment[..., 2] + 0.5 * line.direction[..., 2], np.zeros((3, 3)))


def test_a_twisted_bundle_is_elliptic():
    focal = MENU["twist"].focal(U, V)
    assert (focal.kind == "elliptic").all()
    assert np.isnan(focal.w).all() and np.isnan(focal.points).all()
    assert np.isfinite(focal.limits).all()


def test_lines_round_a_cylinder_touch_it_at_a_focal_point():
    points = MENU["helix"].focal(U, V).points
    distance = np.hypot(points[..., 0], points[..., 1])
    agree(np.abs(distance - 1.0).min(axis=-1), np.zeros((3, 3)))


# -- degenerate cases by name ----------------------------------------------------------------------


def test_the_poles_of_the_chart_are_undefined():
    for congruence in (MENU["linear_complex"], MENU["paper"]):
        focal = congruence.focal(0.3, [0.0, 1.0, math.pi])
        assert focal.kind.tolist()[::2] == ["undefined"] * 2 and focal.kind[1] != "undefined"
        assert np.isnan(focal.points[[0, 2]]).all() and np.isfinite(focal.midpoint[1])


def test_outside_the_domain_of_a_formula_lines_are_undefined():
    congruence = Congruence("sqrt(u)", "1/u")
    assert congruence.kind([-1.0, 0.0, 1.0], 1.0).tolist()[:2] == ["undefined"] * 2
    assert np.isnan(congruence.line(-1.0, 1.0).moment).all()
    with pytest.raises(GeometryError, match="on which ū and v̄ are defined"):
        congruence.flux((-1.0, 1.0), (1.0, 1.5))


def test_arguments_are_checked():
    with pytest.raises(GeometryError, match="`u` must be finite"):
        MENU["paper"].line(math.nan, 1.0)
    with pytest.raises(GeometryError, match="`v` must be two numbers"):
        MENU["paper"].flux((0.0, 1.0), (0.0, 1.0, 2.0))


def test_shapes_broadcast():
    focal = MENU["paper"].focal(np.linspace(0, 1, 4)[:, None], np.linspace(1, 2, 5))
    assert focal.kind.shape == (4, 5) and focal.points.shape == (4, 5, 2, 3)
    assert MENU["paper"].line(0.0, 1.0).shape == ()
