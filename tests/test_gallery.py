"""The gallery: each entry opens, and what its note says of it is true."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from ruledlab.geometry import gallery
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier, seam
from ruledlab.geometry.field import named_number, number
from ruledlab.geometry.motion import screw
from ruledlab.geometry.special import special_rulings
from ruledlab.geometry.surface import RuledSurface

PI = math.pi
T = np.linspace(0.0, 1.0, 81)
CLASSICAL = {
    *("cone", "right_helicoid", "oblique_helicoid", "hyperboloid", "plucker_conoid"),
    *("hyperbolic_paraboloid", "tangent_developable", "moebius", "example_1", "example_2"),
}
SPECIAL = {"wave_ring", "cusp"}
"""Made for the special rulings they have."""
FREE = [entry.key for entry in gallery.GALLERY if entry.key not in CLASSICAL | SPECIAL]


def longitudes(surface: RuledSurface) -> np.ndarray:
    return surface.curve(T)[:, 0]  # type: ignore[operator,no-any-return]


def close_to(found: object, expected: object) -> None:
    np.testing.assert_allclose(found, np.broadcast_to(expected, np.shape(found)), atol=1e-11)


# -- all of them -----------------------------------------------------------------------------------


@pytest.mark.parametrize("entry", gallery.GALLERY, ids=lambda entry: entry.key)
def test_every_entry_opens_and_closes_as_it_says(entry: gallery.Example) -> None:
    surface = gallery.surface(entry.key)
    assert gallery.example(entry.key) is entry
    order = seam(Bezier(np.array(entry.points))).order
    assert entry.closing == ("open" if order < 0 else f"C{order}")
    assert 2 <= len(entry.points) <= 9
    assert (surface.ubar.text, surface.vbar.text) == (entry.ubar, entry.vbar)
    assert entry.note.endswith(".")
    assert np.isfinite(surface.line(T).moment).all()


@pytest.mark.parametrize("entry", gallery.GALLERY, ids=lambda entry: entry.key)
def test_multiples_of_pi_are_the_doubles_one_would_type(entry: gallery.Example) -> None:
    for value in {value for point in entry.points for value in point}:
        assert number(named_number(value)) == value
        assert "pi" in named_number(value) or value in (0.0, 1.0)


@pytest.mark.parametrize("key", FREE)
def test_free_designs_have_every_value_everywhere(key: str) -> None:
    surface = gallery.surface(key)
    invariants = surface.invariants(np.linspace(0, 1, 2001))
    assert invariants.undefined == ()
    assert np.abs(invariants.delta).max() < 3
    assert (np.hypot(invariants.kappa_bar, invariants.tau_bar) > 0.1).all()
    assert np.isfinite(surface.arc_lengths().striction)


def test_keys_and_titles_are_distinct_and_in_order() -> None:
    assert gallery.names() == tuple(entry.key for entry in gallery.GALLERY)
    assert len(set(gallery.names())) == len(gallery.GALLERY) == 18
    assert len({entry.title for entry in gallery.GALLERY}) == 18
    assert set(gallery.names()) >= CLASSICAL | SPECIAL
    assert len(FREE) == 6


@pytest.mark.parametrize("ask", [gallery.example, gallery.surface])
@pytest.mark.parametrize("key", ["sphere", "", None, 3, []])
def test_an_unknown_key_is_refused_with_the_known_ones(
    ask: Callable[..., object], key: object
) -> None:
    with pytest.raises(GeometryError, match=r"`key` must be one of cone, right_helicoid, .*; got"):
        ask(key)


def test_entries_are_frozen() -> None:
    with pytest.raises(FrozenInstanceError):
        gallery.example("cone").title = "Sphere"  # type: ignore[misc]


# -- the notes, one by one -------------------------------------------------------------------------


def cone(surface: RuledSurface) -> None:
    invariants = surface.invariants(T)
    close_to(invariants.kappa_bar, 0.0)
    close_to(invariants.tau_bar, 0.0)
    close_to(surface.striction(T), [0, 0, 1])
    assert np.isnan(invariants.sigma).all()
    close_to(surface.pitch(), 0.0)
    close_to(surface.angle_of_pitch(), gallery.surface("example_2").angle_of_pitch())


def right_helicoid(surface: RuledSurface) -> None:
    invariants = surface.invariants(T)
    close_to(invariants.delta, 0.5)
    close_to([invariants.tau, invariants.tau_bar], 0.0)
    close_to(invariants.sigma, PI / 2)
    close_to(surface.striction(T)[:, :2], 0.0)
    close_to(surface.curvature(T, [-1.0, 0.0, 3.0]).mean, 0.0)
    assert not surface.closure().closed
    close_to(surface.striction(1.0) - surface.striction(0.0), [0, 0, PI])
    close_to(surface.line(1.0).direction, surface.line(0.0).direction)


def oblique_helicoid(surface: RuledSurface) -> None:
    invariants = surface.invariants(T)
    close_to(invariants.delta, 0.5)
    close_to(invariants.sigma, PI / 3)
    close_to(np.arccos(surface.line(T).direction[:, 2]), PI / 3)
    close_to(surface.striction(T)[:, :2], 0.0)
    close_to(surface.striction(1.0) - surface.striction(0.0), [0, 0, PI])
    close_to(surface.line(1.0).direction, surface.line(0.0).direction)


def hyperboloid(surface: RuledSurface) -> None:
    x, y, z = np.moveaxis(surface.points(T, [-2.0, 0.0, 1.0]), -1, 0)
    close_to(x**2 + y**2 - z**2, 1.0)
    close_to(surface.invariants(T).delta, 1.0)
    close_to(surface.invariants(T).sigma, 3 * PI / 4)
    close_to(surface.striction(T)[:, 2], 0.0)
    close_to(surface.pitch(), math.sqrt(2) * PI)
    close_to(surface.angle_of_pitch(), -math.sqrt(2) * PI)


def plucker_conoid(surface: RuledSurface) -> None:
    x, y, z = np.moveaxis(surface.points(T, [-2.0, 0.0, 1.0]), -1, 0)
    close_to(z * (x**2 + y**2), 2 * x * y)
    invariants = surface.invariants(T)
    close_to([invariants.tau, invariants.tau_bar], 0.0)
    close_to(invariants.delta, 2 * np.cos(2 * longitudes(surface)))
    close_to(surface.invariants(np.array([1, 3, 5, 7]) / 8).delta, 0.0)
    close_to([surface.pitch(), surface.angle_of_pitch()], 0.0)
    close_to(surface.line(0.7).distance_to(surface.line(0.2).foot), 0.0)
    close_to(surface.line(0.7).direction, -surface.line(0.2).direction)


def hyperbolic_paraboloid(surface: RuledSurface) -> None:
    x, y, z = np.moveaxis(surface.points(T, [-2.0, 0.0, 1.0]), -1, 0)
    close_to(x * z, y)
    invariants = surface.invariants(T)
    close_to([invariants.tau, invariants.tau_bar], 0.0)
    close_to(invariants.delta, 1 / np.cos(longitudes(surface)) ** 2)
    close_to(surface.line(T).direction[:, 2], 0.0)
    close_to(surface.striction(T)[:, :2], 0.0)


def tangent_developable(surface: RuledSurface) -> None:
    u = longitudes(surface)
    helix = np.stack([0.6 * np.sin(u), -0.6 * np.cos(u), 0.6 * u], axis=-1)
    close_to(surface.striction(T), helix)
    tangent = np.stack([np.cos(u), np.sin(u), np.ones_like(u)], axis=-1) / math.sqrt(2)
    close_to(surface.line(T).direction, tangent)
    invariants = surface.invariants(T)
    close_to([invariants.kappa_bar, invariants.delta, invariants.sigma], 0.0)
    close_to(surface.curvature(T, [-1.0, 0.5]).gauss, 0.0)


def moebius(surface: RuledSurface) -> None:
    u = longitudes(surface)
    circle = np.stack([-np.sin(2 * u), 1 + np.cos(2 * u), np.zeros_like(u)], axis=-1)
    close_to(surface.line(T).distance_to(circle), 0.0)
    close_to(surface.line(1.0).plucker, -surface.line(0.0).plucker)
    state = surface.closure()
    assert (state.closed, state.oriented, state.order) == (True, False, 2)
    with pytest.raises(GeometryError, match="Möbius"):
        surface.pitch()


def example_1(surface: RuledSurface) -> None:
    close_to(surface.curve(T), np.stack([T, T], axis=-1))  # type: ignore[operator]
    close_to(surface.ubar(T, T), 0.0)
    close_to(surface.vbar(T, T), 2 * T)
    t = T[1:]
    invariants = surface.invariants(t)
    close_to(invariants.kappa**2, 1 + np.sin(t) ** 2)
    close_to(invariants.kappa * invariants.kappa_bar, t * np.sin(2 * t) + 2)
    assert np.isnan(surface.invariants(0.0).kappa)
    assert "pole" in surface.invariants(0.0).undefined[0].reason


def example_2(surface: RuledSurface) -> None:
    grid = [[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]]
    np.testing.assert_array_equal(gallery.example("example_2").points, np.array(grid) * PI / 8)
    assert f"λ = −{-surface.angle_of_pitch():.12f}" in gallery.example("example_2").note
    assert f"l = {surface.pitch():.12f}" in gallery.example("example_2").note
    assert surface.closure().order == 1
    ends = surface.invariants([0.0, 1.0])
    close_to(ends.tau, 5 * math.sqrt(2))
    assert abs(ends.kappa_prime[1] - ends.kappa_prime[0]) > 1


def crown(surface: RuledSurface) -> None:
    close_to(surface.invariants(T).delta, 1.5 + 1.2 * np.cos(6 * longitudes(surface)))
    close_to(surface.pitch(), 3 * PI / math.sqrt(2))
    close_to(surface.angle_of_pitch(), -math.sqrt(2) * PI)


def wave_ring(surface: RuledSurface) -> None:
    wave = 1.2 * np.cos(3 * longitudes(surface))
    invariants = surface.invariants(T)
    close_to(invariants.delta, 0.6 + wave)
    close_to([invariants.kappa, invariants.tau], math.sqrt(2) * PI)
    close_to(surface.invariants(np.array([1, 2, 4, 5, 7, 8]) / 9).delta, 0.0)
    found = special_rulings(surface)
    np.testing.assert_allclose(found.torsal, np.array([1, 2, 4, 5, 7, 8]) / 9, atol=1e-13)
    assert not found.touching.any()
    close_to(distance_from_axis(surface), 0.6)
    now = screw(surface, T)
    close_to(now.pitch, wave)
    close_to(now.axis.plucker, [0, 0, 1, 0, 0, 0])
    close_to(surface.pitch(), 0.6 * math.sqrt(2) * PI)
    close_to(surface.angle_of_pitch(), -math.sqrt(2) * PI)


def cusp(surface: RuledSurface) -> None:
    colatitude, h = 17 * PI / 24, 1e-5
    x = surface.line(0.5).direction
    assert math.acos(x[2]) == pytest.approx(colatitude)
    back = [*(-x[:2] / math.tan(colatitude)), math.sin(colatitude)]  # up the meridian
    for t in (0.5 - h, 0.5 + h):  # the path comes and goes along the same way
        way = surface.line(t).direction - x
        np.testing.assert_allclose(way / np.linalg.norm(way), back, atol=1e-4)
    np.testing.assert_allclose(special_rulings(surface).cylindrical, [0.5], atol=1e-9)
    invariants = surface.invariants([0.5 - h, 0.5, 0.5 + h])
    np.testing.assert_allclose(invariants.delta[[0, 2]], 0.5, atol=1e-4)
    assert np.isnan([invariants.delta[1], *surface.striction(0.5), *surface.frame(0.5)[1]]).all()
    assert np.isfinite(surface.line(0.5).plucker).all()
    assert np.isfinite(surface.invariants(T[T != 0.5]).delta).all()


def tower(surface: RuledSurface) -> None:
    delta = surface.invariants(T).delta
    close_to(delta, 0.6 * math.sqrt(3) + np.cos(5 * longitudes(surface)))
    lowest = surface.invariants(np.arange(1, 10, 2) / 10).delta
    np.testing.assert_allclose(lowest, 0.039, atol=5e-4)
    close_to(surface.pitch(), 0.6 * PI)
    close_to(surface.angle_of_pitch(), -math.sqrt(3) * PI)


def distance_from_axis(surface: RuledSurface) -> np.ndarray:
    """Distance of each ruling from the z-axis, by the moment of one about the other."""
    line = surface.line(T)
    distance: np.ndarray = np.abs(line.moment[:, 2]) / np.hypot(*line.direction[:, :2].T)
    return distance


def twisted_ring(surface: RuledSurface) -> None:
    close_to(distance_from_axis(surface), 1.2)
    lean = surface.line(T).direction[:, 2]
    assert lean.min() < -0.05
    assert lean.max() > 0.05
    state = surface.closure()
    assert (state.oriented, state.order) == (True, 2)


def orchid(surface: RuledSurface) -> None:
    v = surface.curve(T)[:, 1]  # type: ignore[operator]
    close_to(distance_from_axis(surface), np.abs(np.cos(v)))
    level = np.abs(np.cos(v)) < 1e-12
    assert T[level].tolist() == [0.0, 0.5, 1.0]  # and no change of sign besides:
    assert (np.cos(v[1:40]) < 0).all()
    assert (np.cos(v[41:-1]) > 0).all()
    close_to(surface.line(T[level]).direction[:, 2], 0.0)
    state = surface.closure()
    assert (state.oriented, state.order) == (True, 2)
    assert v.min() > 0.5
    assert v.max() < PI - 0.5


def shell(surface: RuledSurface) -> None:
    u = longitudes(surface)
    invariants = surface.invariants(T)
    close_to(invariants.delta, 0.276 * np.exp(0.13 * u))
    close_to(invariants.sigma, invariants.sigma[0])
    turn, grow = u[10] - u[0], math.exp(0.13 * (u[10] - u[0]))
    c, s = math.cos(turn), math.sin(turn)
    rotation = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    moved = surface.points(T[:-10], [-1.0, 0.0, 2.0]) @ rotation.T * grow
    close_to(surface.points(T[10:], np.array([-1.0, 0.0, 2.0]) * grow), moved)


def ramp(surface: RuledSurface) -> None:
    close_to(distance_from_axis(surface), 0.6)
    first, last = surface.line(0.0), surface.line(1.0)
    close_to(last.direction, first.direction)
    close_to(last.distance_to(first.foot + [0, 0, 1.2 * PI]), 0.0)
    lean = surface.line(T).direction[:, 2]
    assert lean.min() < 0 < lean.max()


NOTES = [
    *(cone, right_helicoid, oblique_helicoid, hyperboloid, plucker_conoid, hyperbolic_paraboloid),
    *(tangent_developable, moebius, example_1, example_2, crown, wave_ring, tower, twisted_ring),
    *(orchid, shell, cusp, ramp),
]


@pytest.mark.parametrize("check", NOTES, ids=lambda check: check.__name__)
def test_the_note_is_true(check: Callable[[RuledSurface], None]) -> None:
    check(gallery.surface(check.__name__))


def test_every_note_is_checked() -> None:
    assert tuple(check.__name__ for check in NOTES) == gallery.names()
