"""Integrals of what has edges, jumps and poles: right to rounding, or said to be off."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.quadrature import Primitive, edges, estimate, integrals, integrate

within = st.floats(0.001, 0.999)


@given(within, st.floats(-3.0, 3.0))
def test_a_jump_anywhere_is_integrated_to_rounding(place, high):
    found = integrate(lambda t: np.where(t < place, 1.0, high), 0.0, 1.0, "a step")
    assert float(found) == pytest.approx(place + high * (1.0 - place), abs=1e-12)


@given(within)
def test_an_edge_anywhere_is_integrated_to_rounding(place):
    found = integrate(lambda t: np.abs(t - place) + np.sin(3 * t), 0.0, 1.0, "an edge")
    exact = (place**2 + (1 - place) ** 2) / 2 + (1 - math.cos(3)) / 3
    assert float(found) == pytest.approx(exact, abs=1e-12)


@pytest.mark.parametrize("place", [0.25 - 1e-5, 0.25, 0.25 + 3e-5, 0.3125 + 1e-6])
def test_nothing_hides_between_the_last_node_of_a_panel_and_its_end(place):
    found = integrate(lambda t: np.where(t < place, 0.0, 1.0), 0.0, 1.0, "a step")
    assert float(found) == pytest.approx(1.0 - place, abs=1e-12)


def test_functions_of_different_size_are_resolved_together():
    rows = integrate(
        lambda t: np.stack([1e3 * np.exp(t), np.abs(t - 0.3), t > 0.6]), 0.0, 1.0, "rows"
    )
    assert rows == pytest.approx([1e3 * (math.e - 1), 0.29, 0.4], rel=1e-12, abs=1e-10)


def test_many_poles_and_stretches_without_values_are_given_up():
    for wild in (lambda t: np.tan(50 * t), lambda t: np.sqrt(np.sin(9 * t)), lambda t: t * np.nan):
        with np.errstate(all="ignore"), pytest.raises(GeometryError, match="does not converge"):
            integrate(wild, 0.0, 1.0, "this")


@given(within)
def test_a_primitive_is_right_at_every_place(place):
    grown = Primitive(lambda t: np.where(t < place, np.cos(t), 2.0), 0.0, 1.0, "this")
    t = np.linspace(0.0, 1.0, 37)
    exact = np.where(t < place, np.sin(t), math.sin(place) + 2.0 * (t - place))
    np.testing.assert_allclose(grown(t), exact, atol=1e-12)
    assert grown.total == pytest.approx(exact[-1], abs=1e-12)
    np.testing.assert_allclose(grown.inverse(exact[1:-1]), t[1:-1], atol=1e-11)


def test_edges_are_found_and_smooth_places_are_not():
    found = edges(lambda t: np.stack([np.abs(t - 0.3), np.where(t < 0.7, t, 0.0)]), 0.0, 1.0)
    assert found == pytest.approx([0.3, 0.7], abs=1e-4)
    assert edges(lambda t: np.exp(np.sin(9 * t)), 0.0, 1.0).size == 0


def test_a_pole_is_an_edge_too():
    with np.errstate(all="ignore"):
        assert edges(lambda t: 1 / np.abs(t - 0.4), 0.0, 1.0) == pytest.approx([0.4], abs=1e-6)


def test_integrals_over_many_intervals():
    low, high = np.zeros(4), np.array([1.0, 0.3, -2.0, 0.0])
    found, off = integrals(lambda x, owner: np.abs(x - 0.5) * (1 + owner), low, high)
    assert found == pytest.approx([0.25, 0.21, -9.0, 0.0], abs=1e-10)
    assert off.max() < 1e-9


@given(within)
def test_integrals_say_how_far_they_are_off(place):
    with np.errstate(all="ignore"):
        found, off = integrals(
            lambda x, owner: 1 / np.sqrt(np.abs(x - place)), np.zeros(1), np.ones(1)
        )
    exact = 2 * math.sqrt(place) + 2 * math.sqrt(1 - place)
    assert abs(found[0] - exact) <= off[0]


def test_integrals_without_a_value_are_off_without_end():
    with np.errstate(all="ignore"):
        _, off = integrals(lambda x, owner: np.sqrt(x - owner), np.zeros(2), np.ones(2))
    assert off[0] < 1e-6 and np.isinf(off[1])


def test_an_estimate_adds_up_what_it_is_told_and_what_it_sees():
    corners = np.linspace(0.0, 1.0, 5)
    value, off = estimate(lambda t: (np.cos(t), 1e-3 + 0 * t), corners)
    assert value == pytest.approx(math.sin(1.0), abs=1e-12) and off == pytest.approx(1e-3)
    value, off = estimate(lambda t: (np.sqrt(np.abs(t - 0.3)), 0 * t), corners)
    assert abs(value - 2 / 3 * (0.3**1.5 + 0.7**1.5)) <= off and 1e-12 < off < 1e-4
    assert math.isinf(estimate(lambda t: (t, np.where(t > 0.9, np.inf, 0.0)), corners)[1])
