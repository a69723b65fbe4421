"""Tangent planes, asymptotic directions and curvatures, against derivatives of the patch itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings

from ruledlab.geometry import Bezier, RuledSurface, gallery, tangent_planes

from .strategies import grid, surfaces

FEW = settings(max_examples=40, deadline=None)


def along(surface, t, w, dt, dw, h=2e-4):
    """Return r, its velocity and its acceleration on the line (t + h dt, w + h dw) by differences.

    Fourth-order central differences of `points`; no fundamental form is asked.
    """
    steps = h * np.arange(-2, 3)
    r = np.array([surface.points(t + s * dt, w + s * dw) for s in steps])
    speed = (r[0] - 8 * r[1] + 8 * r[3] - r[4]) / (12 * h)
    bend = (-r[0] + 16 * r[1] - 30 * r[2] + 16 * r[3] - r[4]) / (12 * h**2)
    return r[2], speed, bend


def ordinary(surface, t, w):
    """Whether differences can be trusted there: nothing is steep or nearly torsal."""
    known = surface.invariants(t)
    sizes = [known.kappa, known.kappa_bar, known.tau, known.tau_bar, known.kappa_prime]
    assume(np.all(np.isfinite(sizes)) and np.max(np.abs(sizes)) < 12)
    assume(abs(known.kappa_bar) > 0.1 and known.kappa > 0.3)


@given(surfaces, grid(0.1, 0.9), grid(-1.5, 1.5))
@FEW
def test_the_normal_and_the_point_are_those_of_the_patch(surface, t, w):
    ordinary(surface, t, w)
    found = tangent_planes(surface, t, w)
    point, along_t, _ = along(surface, t, w, 1.0, 0.0)
    normal = np.cross(along_t, surface.line(t).direction)
    assert np.allclose(found.point, point)
    assert np.allclose(found.normal, normal / np.linalg.norm(normal), atol=1e-6)


@given(surfaces, grid(0.1, 0.9), grid(-1.5, 1.5))
@FEW
def test_the_surface_does_not_bend_in_the_asymptotic_directions(surface, t, w):
    """Solve n·r″ = 0 for the way (1, m) by differences, and compare directions in space."""
    ordinary(surface, t, w)
    found = tangent_planes(surface, t, w)
    curving = [along(surface, t, w, 1.0, m)[2] @ found.normal for m in (-1.0, 0.0, 1.0)]
    # n·r″ = h₁₁ + 2h₁₂ m is linear in m, because h₂₂ = 0
    assert curving[0] + curving[2] == pytest.approx(2 * curving[1], abs=1e-4)
    slope = 0.5 * (curving[2] - curving[0])
    assume(abs(slope) > 0.05)
    assume(abs(curving[1] / slope) < 10)
    m = -curving[1] / slope
    _, way, _ = along(surface, t, w, 1.0, m)
    assert np.allclose(np.cross(way / np.linalg.norm(way), found.asymptotic), 0.0, atol=1e-4)
    assert np.linalg.norm(found.asymptotic) == pytest.approx(1.0)
    assert way @ found.asymptotic > 0


@given(surfaces, grid(0.0, 1.0), grid(-2.0, 2.0))
@FEW
def test_the_turn_is_the_angle_of_the_normals(surface, t, w):
    ordinary(surface, t, w)
    there, start = tangent_planes(surface, t, w), tangent_planes(surface, t, 0.0)
    assert np.cos(there.turn) == pytest.approx(there.normal @ start.normal, abs=1e-12)
    delta = float(surface.invariants(t).delta)
    assert np.tan(there.turn) == pytest.approx(w / delta, rel=1e-9, abs=1e-12)
    assert start.turn == 0.0
    x1, _, x3 = surface.frame(t)
    x2 = surface.frame(t)[1]
    held = np.cos(there.turn) * x3 + np.sin(there.turn) * x2
    assert np.abs([held @ there.normal, x1 @ there.normal]).max() < 1e-12


@given(surfaces, grid(0.0, 1.0), grid(-2.0, 2.0))
@FEW
def test_gauss_curvature_follows_from_the_turn(surface, t, w):
    ordinary(surface, t, w)
    found = tangent_planes(surface, t, w)
    delta = float(surface.invariants(t).delta)
    assert found.gauss == pytest.approx(-(np.cos(found.turn) ** 4) / delta**2, rel=1e-9)
    assert abs(tangent_planes(surface, t, 0.0).gauss) >= abs(found.gauss) * (1 - 1e-12)
    assert np.prod(found.principal) == pytest.approx(found.gauss, rel=1e-7, abs=1e-12)
    assert np.mean(found.principal) == pytest.approx(found.mean, rel=1e-9, abs=1e-12)
    both = surface.curvature(t, w)
    assert (found.gauss, found.mean) == pytest.approx((both.gauss, both.mean), rel=1e-8, abs=1e-12)


@given(surfaces, grid(0.0, 1.0), grid(-2.0, 2.0))
@FEW
def test_the_angle_of_the_asymptotic_directions_tells_the_mean_curvature(surface, t, w):
    ordinary(surface, t, w)
    found = tangent_planes(surface, t, w)
    cosine = surface.frame(t)[0] @ found.asymptotic
    assert np.cos(found.angle) == pytest.approx(cosine, abs=1e-9)
    # Euler: the directions without curvature lie at the angle α/2 from a principal one
    k1, k2 = found.principal
    assert abs(np.cos(found.angle)) == pytest.approx(abs((k1 + k2) / (k1 - k2)), abs=1e-7)


# ---- surfaces one knows -------------------------------------------------------------------------


def test_on_a_hyperboloid_the_second_direction_is_the_other_ruling():
    t, w = np.linspace(0, 1, 7), np.linspace(-2, 2, 9)
    found = tangent_planes(gallery.surface("hyperboloid"), t, w)
    x, y, z = np.moveaxis(found.point, -1, 0)
    assert np.allclose(x**2 + y**2 - z**2, 1.0)
    for s in (-3.0, 0.7, 5.0):  # the straight line in this direction never leaves the surface
        x, y, z = np.moveaxis(found.point + s * found.asymptotic, -1, 0)
        assert np.allclose(x**2 + y**2 - z**2, 1.0)
    assert np.allclose(np.abs(found.asymptotic[..., 2]), np.sqrt(0.5))


def test_on_a_hyperbolic_paraboloid_too():
    found = tangent_planes(gallery.surface("hyperbolic_paraboloid"), [0.2, 0.8], [-1.0, 0.0, 2.0])
    for s in (0.0, 1.3):
        x, y, z = np.moveaxis(found.point + s * found.asymptotic, -1, 0)
        assert np.allclose(x * z, y)


def test_on_a_right_helicoid_it_is_the_tangent_of_the_helix():
    t, w = np.linspace(0, 1, 5), np.array([-0.7, 0.0, 0.3])
    found = tangent_planes(gallery.surface("right_helicoid"), t, w)
    assert np.allclose(found.angle, np.pi / 2)
    assert np.allclose(found.mean, 0.0)
    slope = 0.5 / np.hypot(0.5, w)  # the helix at distance w climbs 0.5 for each radian
    assert np.allclose(found.asymptotic[..., 2], slope)


def test_torsal_rulings_of_the_conoid():
    """At u = π/4 the conoid has δ = 0: one plane along the ruling, none at its striction point."""
    found = tangent_planes(gallery.surface("plucker_conoid"), 0.125, [-1.0, 0.0, 0.5, 2.0])
    assert np.isnan(found.normal[1]).all()
    assert np.isnan([found.turn[1], found.gauss[1], found.mean[1], found.angle[1]]).all()
    assert np.allclose(np.abs(found.turn[[0, 2, 3]]), np.pi / 2)
    assert np.allclose(found.gauss[[0, 2, 3]], 0.0)
    assert np.allclose(np.abs(found.normal[[0, 2, 3]] @ found.normal[3]), 1.0)
    assert np.allclose(
        found.asymptotic[[0, 2, 3]], gallery.surface("plucker_conoid").frame(0.125)[0]
    )
    (report,) = found.undefined
    assert report.where.tolist() == [False, True, False, False]
    assert "torsal" in report.reason


def test_a_cone_has_no_tangent_plane_in_its_apex():
    found = tangent_planes(gallery.surface("cone"), [0.2, 0.6], [0.0, 1.0])
    assert np.isnan(found.gauss).tolist() == [[True, False], [True, False]]
    assert np.allclose(found.point[:, 0], (0, 0, 1))
    assert np.allclose(found.angle[:, 1], 0.0)


def test_a_plane_has_no_second_asymptotic_direction():
    equator = Bezier([[0.0, np.pi / 2], [1.0, np.pi / 2]])
    found = tangent_planes(RuledSurface(equator, "0", "0"), [0.1, 0.5, 0.9], [1.0, 0.3])
    assert np.abs(found.principal).max() < 1e-14
    assert np.allclose(np.abs(found.normal), (0, 0, 1))
    assert np.isnan(found.asymptotic).all()
    assert np.isnan(found.angle).all()
    assert found.undefined == ()


def test_a_pole_of_the_chart_is_named():
    (report,) = tangent_planes(gallery.surface("example_1"), [0.0, 0.5], 0.5).undefined
    assert report.where.tolist() == [True, False]
    assert "pole" in report.reason


def test_shapes_of_a_batch():
    curve = Bezier(np.random.default_rng(5).uniform(0.6, 1.6, (3, 4, 2)))
    found = tangent_planes(RuledSurface(curve, "u - v", "u + v"), np.zeros((2, 5)), np.ones(4))
    assert found.point.shape == found.normal.shape == found.asymptotic.shape == (3, 2, 5, 4, 3)
    assert found.turn.shape == found.gauss.shape == found.angle.shape == (3, 2, 5, 4)
    assert found.principal.shape == (3, 2, 5, 4, 2)


@given(surfaces, grid(0.0, 1.0), grid(-2.0, 2.0))
@FEW
def test_gauss_curvature_is_the_rate_of_the_turn_squared(surface, t, w):
    ordinary(surface, t, w)
    h = 1e-4
    before, there, after = tangent_planes(surface, t, [w - h, w, w + h]).turn
    rate = (after - before) / (2 * h)
    assert surface.curvature(t, w).gauss == pytest.approx(-(rate**2), rel=1e-4)
    assert there == pytest.approx(0.5 * (before + after), abs=1e-5)


@given(surfaces, grid(0.0, 1.0))
@FEW
def test_a_whole_ruling_has_the_curvature_two_kappa(surface, t):
    """∫ K W dw = −2κ: along every ruling the normal turns through half a circle."""
    ordinary(surface, t, 0.0)
    known = surface.invariants(t)
    turn = np.linspace(-np.pi / 2, np.pi / 2, 203)[1:-1]  # midpoints, nearly: the ends add nothing
    w = float(known.delta) * np.tan(turn)
    found = tangent_planes(surface, t, w)
    area = np.sqrt(found.forms.g11 - found.forms.g12**2)
    total = np.trapezoid(found.gauss * area * np.abs(known.delta) / np.cos(turn) ** 2, turn)
    assert total == pytest.approx(-2 * float(known.kappa), rel=1e-3)
