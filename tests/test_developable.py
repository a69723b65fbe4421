"""Developables with a chosen spherical image: κ̄ = 0, and what they are where it is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from ruledlab.geometry import gallery
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.choices import CHOICES
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.developable import developable_from_ubar, tangent_developable
from ruledlab.geometry.special import special_rulings
from ruledlab.geometry.surface import RuledSurface

from .strategies import curves, formulas, grid

few = settings(max_examples=8)
T = np.array([0.05, 0.4, 0.8])
RISING = Bezier([[0.3, 0.6], [1.2, 1.0], [1.5, 1.4], [2.5, 2.0]])
BUNDLE = next(choice for choice in CHOICES if choice.key == "bundle")


def agree(found, expected, tolerance=1e-9):
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


@few
@given(formulas, grid(-1.0, 1.0))
def test_v_bar_solved_for_makes_kappa_bar_vanish(ubar, start):
    found = developable_from_ubar(RISING, ubar, start)
    inv = found.surface.invariants(T)
    agree(inv.kappa_bar, np.zeros(3), 1e-11)
    agree(found.vbar(0.0), start)
    # The lines have the ū that was asked for, and the v̄ that is reported.
    chart = RuledSurface(RISING, ubar, 0).line(T).moment
    u, v = RISING(T).T
    e2 = np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), -np.sin(v)], axis=-1)
    moment = chart + found.vbar(T)[:, np.newaxis] * e2
    agree(found.surface.line(T).moment, moment)


def test_its_derivatives_belong_to_its_values():
    found, h = developable_from_ubar(RISING, "sin(u) + v", 0.4), 1e-3
    moments = found.surface.line(0.5 + h * np.array([-2, -1, 1, 2])).moment
    change = (8 * (moments[2] - moments[1]) - (moments[3] - moments[0])) / (12 * h)
    agree(found.surface.jet(np.array([0.5]), 1).moment[1, :, 0], change, 1e-7)


def test_the_u_bar_of_a_bundle_gives_back_the_bundle():
    # A solution is fixed by its first value, and the cone is one.
    cone = RuledSurface(RISING, BUNDLE.ubar, BUNDLE.vbar)
    u, v = RISING(np.array([0.0, *T])).T
    expected = cone.vbar(u, v)
    found = developable_from_ubar(RISING, BUNDLE.ubar, float(expected[0]))
    agree(found.vbar(T), expected[1:])
    agree(found.surface.striction(T), np.tile([1.0, 0.8, 0.5], (3, 1)))


def test_on_a_parallel_circle_v_bar_is_fixed():
    helix = gallery.surface("tangent_developable")
    found = developable_from_ubar(helix.curve, "0.6*u", 17.0)
    agree(found.vbar(T), np.full(3, -0.6))
    agree(found.surface.striction(T), helix.striction(T))


EQUATOR = Bezier([[0.0, math.pi / 2], [2.0, math.pi / 2]])


@pytest.mark.parametrize("ubar", ["0", "0.7", "0.7 + cos(v)"])
def test_on_the_equator_a_constant_u_bar_leaves_v_bar_free(ubar):
    found = developable_from_ubar(EQUATOR, ubar, -1.5)
    agree(found.vbar(T), np.full(3, -1.5))
    agree(found.surface.line(T).moment[:, 2], np.full(3, 1.5))  # v̄ x_v, and x_v points down
    agree(found.surface.invariants(T).kappa_bar, np.zeros(3))


@pytest.mark.parametrize("ubar", ["u", "0.5*u", "1e-8*sin(u)"])
def test_on_the_equator_a_u_bar_that_changes_is_refused_with_the_other_way(ubar):
    with pytest.raises(GeometryError, match=r"leave the equator.*π/2.*use tangent_developable"):
        developable_from_ubar(EQUATOR, ubar)


def test_a_curve_that_rises_and_falls_is_refused_with_the_other_way():
    wave = Bezier([[0, 1], [1, 2], [2, 1]])
    with pytest.raises(GeometryError, match=r"v′ = 0 near t = 0\.5; use tangent_developable"):
        developable_from_ubar(wave, "u")


@few
@given(curves(), grid(0.2, 2.0))
def test_tangents_have_the_speed_asked_for_and_no_kappa_bar(curve, speed):
    surface = tangent_developable(curve, lambda t: speed + np.sin(3 * t), (1.0, -2.0, 0.5))
    inv = surface.invariants(T)
    agree(inv.kappa_bar, np.zeros(3), 1e-10)
    agree(inv.tau_bar, speed + np.sin(3 * T), 1e-7)
    agree(surface.striction(0.0), [1.0, -2.0, 0.5])
    agree(inv.kappa, RuledSurface(curve, 0, 0).invariants(T).kappa)
    assert special_rulings(surface).developable.tolist() == [[0.0, 1.0]]


def test_constant_speed_over_a_circle_is_a_helix():
    circle = Bezier([[0.0, math.pi / 3], [2 * math.pi, math.pi / 3]])
    m = tangent_developable(circle, 2.0, (math.sin(math.pi / 3) / math.pi, 0, 0)).striction(T)
    # m′ = 2x: it climbs 2 cos v for each t; centred, as ∫sin 2πt = −cos 2πt/2π.
    agree(m[:, 2], 2 * math.cos(math.pi / 3) * T)
    middle = np.array([math.sin(math.pi / 3) / math.pi, math.sin(math.pi / 3) / math.pi])
    agree(np.hypot(*(m[:, :2] - middle).T), np.full(3, middle[0]))


def test_without_speed_it_is_a_cone():
    surface = tangent_developable(RISING, 0, (1, 2, 3))
    agree(surface.striction(T), np.tile([1.0, 2.0, 3.0], (3, 1)))
    assert np.isnan(surface.invariants(T).sigma).all()


def test_arguments_are_checked():
    batch = Bezier(np.zeros((2, 3, 2)) + [[0, 1], [1, 2], [2, 3]])
    for make in (lambda: developable_from_ubar(batch, 0), lambda: tangent_developable(batch)):
        with pytest.raises(GeometryError, match="`curve` must be one curve"):
            make()
    with pytest.raises(GeometryError, match="`start` must have shape"):
        tangent_developable(RISING, 1, (0, 0))
