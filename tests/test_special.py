"""Torsal and cylindrical rulings: known zeros, close pairs, double zeros, stretches."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry import gallery
from ruledlab.geometry.bspline import BSpline
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.special import special_rulings
from ruledlab.geometry.surface import RuledSurface

from .strategies import surfaces

few = settings(max_examples=10)
EQUATOR = Bezier([[0.0, math.pi / 2], [1.0, math.pi / 2]])


def conoid(height):
    """u = t on the equator, so that κ = 1 and κ̄ = dū/du."""
    return RuledSurface(EQUATOR, height, 0)


def with_kappa_bar(*zeros):
    """A conoid with κ̄ = Π(t − zero), its ū being the polynomial's integral."""
    coefficients = np.polynomial.Polynomial.fromroots(zeros).integ().coef
    return conoid(lambda u, v: sum(c * u**k for k, c in enumerate(coefficients.tolist()) if k))


def only_torsal(found, places, touching, tolerance=1e-12):
    np.testing.assert_allclose(found.torsal, places, rtol=0, atol=tolerance)
    assert found.touching.tolist() == touching
    assert found.developable.size == found.cylindrical.size == found.cylinders.size == 0


@few
@given(st.lists(st.integers(1, 99), min_size=1, max_size=4, unique=True))
def test_the_zeros_of_a_chosen_kappa_bar_are_found(hundredths):
    zeros = sorted(h / 100 for h in hundredths)
    only_torsal(special_rulings(with_kappa_bar(*zeros)), zeros, [False] * len(zeros), 1e-10)


@few
@given(surfaces)
def test_every_change_of_sign_of_delta_on_a_fine_grid_is_found_and_nothing_else(surface):
    found = special_rulings(surface)
    t = np.linspace(0, 1, 1500)
    delta = surface.invariants(t).delta
    for i in np.flatnonzero(delta[:-1] * delta[1:] < 0):
        assert ((found.torsal >= t[i]) & (found.torsal <= t[i + 1])).any()
    if found.torsal.size:
        inv = surface.invariants(found.torsal)
        size = np.linalg.norm(surface.jet(found.torsal).moment[1], axis=0) + inv.kappa
        size = size + inv.kappa * np.linalg.norm(surface.line(found.torsal).moment, axis=-1)
        assert (np.abs(inv.kappa_bar) <= 1e-9 * size).all()


def test_pluckers_conoid_has_four_torsal_rulings():
    found = special_rulings(gallery.surface("plucker_conoid"))
    only_torsal(found, [1 / 8, 3 / 8, 5 / 8, 7 / 8], [False] * 4)


def test_two_zeros_within_one_cell_of_any_sampling():
    zeros = [0.3001, 0.3001 + 1e-5]
    only_torsal(special_rulings(with_kappa_bar(*zeros)), zeros, [False, False], 1e-8)


def test_three_zeros_within_one_cell_of_any_sampling():
    zeros = [0.3, 0.3001, 0.3002]
    only_torsal(special_rulings(with_kappa_bar(*zeros)), zeros, [False] * 3, 1e-7)


def test_two_zeros_of_a_small_wave_on_a_tall_conoid():
    # κ̄ = 0.001 (t − 0.2993)(t − 0.3003): in one cell, with slopes far below the height 1.
    height = "1 + 0.001*(u**3/3 - 0.5996*u**2/2 + 0.2993*0.3003*u)"
    only_torsal(special_rulings(conoid(height)), [0.2993, 0.3003], [False] * 2, 1e-8)


@pytest.mark.parametrize("place", [0.5, 0.3, 1 / 3, 0.123456789])
def test_a_double_zero_is_found_and_said_to_touch(place):
    only_torsal(special_rulings(with_kappa_bar(place, place)), [place], [True], 1e-9)


def test_a_triple_zero_changes_sign():
    only_torsal(special_rulings(with_kappa_bar(0.4, 0.4, 0.4)), [0.4], [False], 1e-4)


def test_a_near_miss_is_no_zero():
    near = conoid("(u - 0.3)**3/3 + 1e-7*u")
    only_torsal(special_rulings(near), [], [])


def test_zeros_at_both_ends_of_the_domain():
    only_torsal(special_rulings(with_kappa_bar(0.0, 1.0)), [0.0, 1.0], [False, False])


def test_a_hyperboloid_has_no_special_ruling():
    only_torsal(special_rulings(gallery.surface("hyperboloid")), [], [])


@pytest.mark.parametrize("key", ["cone", "tangent_developable"])
def test_a_developable_surface_is_one_stretch(key):
    found = special_rulings(gallery.surface(key))
    assert found.developable.tolist() == [[0.0, 1.0]]
    assert found.torsal.size == found.cylindrical.size == found.cylinders.size == 0


def test_a_stretch_of_a_developable_ends_where_the_formula_says():
    # ū is constant for u < 0.4: a cone that becomes a conoid, with κ̄ = 3(u − 0.4)² from there.
    found = special_rulings(conoid("((u - 0.4 + abs(u - 0.4))/2)**3 + 2"))
    ((start, end),) = found.developable
    assert start == 0.0 and end == pytest.approx(0.4, abs=1e-4)
    assert found.torsal.size == 0


def test_a_cylinder_is_one_stretch_and_not_torsal():
    cylinder = RuledSurface.from_base(lambda t: (np.cos(t), np.sin(t), 0), lambda t: (0, 0, 1))
    found = special_rulings(cylinder)
    assert found.cylinders.tolist() == [[0.0, 1.0]]
    assert found.torsal.size == found.developable.size == found.cylindrical.size == 0


@pytest.mark.parametrize("place", [0.5, 0.37])
def test_a_turning_point_of_the_image_is_a_cylindrical_ruling(place):
    # u = (t − place)², v constant: the image stops and goes back, κ ∝ |t − place|.
    surface = RuledSurface.from_base(
        lambda t: (t, t**2, 0), lambda t: (np.cos((t - place) ** 2), np.sin((t - place) ** 2), 0.5)
    )
    found = special_rulings(surface)
    np.testing.assert_allclose(found.cylindrical, [place], rtol=0, atol=1e-9)
    assert not (np.abs(found.torsal - place) < 1e-6).any()
    assert found.developable.size == found.cylinders.size == 0


def test_a_curve_that_starts_at_rest_starts_cylindrical():
    surface = RuledSurface(Bezier([[0.5, 1.0], [0.5, 1.0], [1.5, 1.2]]), "1 + u", 1)
    assert special_rulings(surface).cylindrical.tolist() == [0.0]


def test_a_spline_that_rests_on_a_span_is_a_cylinder_there():
    # Four equal control points of a cubic: the first span is one point.
    points = [[0.5, 1.0]] * 4 + [[1.0, 1.2], [1.6, 1.1], [2.0, 1.5]]
    found = special_rulings(RuledSurface(BSpline(points, degree=3), "u", 1))
    ((start, end),) = found.cylinders
    # From there κ grows with the third power's slope: 0 to rounding a little beyond the knot.
    assert start == 0.0 and end == pytest.approx(0.25, abs=1e-4)


class Counted:
    """A moving line that counts how often it is asked, and at how many places."""

    def __init__(self, moving):
        self.moving, self.domain, self.calls, self.places = moving, moving.domain, 0, 0

    def jet(self, t, order=2):
        self.calls, self.places = self.calls + 1, self.places + t.size
        return self.moving.jet(t, order)


@pytest.mark.parametrize("key", gallery.names())
def test_a_search_asks_seldom(key):
    """Many places at a time, and no time spent where a derivative is 0 but for rounding."""
    counted = Counted(gallery.surface(key))
    special_rulings(counted)
    assert counted.calls <= 40
    assert counted.places <= 1500


def test_a_constant_and_its_rounding_hide_no_zeros():
    # κ² = 1 to rounding on the equator: its derivatives have no sign to go by. κ̄ has three zeros.
    counted = Counted(with_kappa_bar(0.25, 0.5, 0.75))
    only_torsal(special_rulings(counted), [0.25, 0.5, 0.75], [False] * 3)
    assert counted.places <= 700


def test_far_from_the_origin_the_same_rulings_are_found():
    # A lift adds to ū, and so to the terms that cancel in κκ̄.
    near, far = (RuledSurface(EQUATOR, f"{lift} + (u - 0.4)**3/3 - u/100", 0)
                 for lift in ("0", "1e4"))  # fmt: skip
    for surface in (near, far):
        only_torsal(special_rulings(surface), [0.3, 0.5], [False, False], 1e-7)


def test_undefined_stretches_report_nothing():
    # ū is real from u = 0.5 on, κ̄ = 1.5 √(u − 0.5) − 0.75 is 0 at u = 0.75.
    found = special_rulings(conoid("(u - 0.5)**1.5 - 0.75*u"))
    only_torsal(found, [0.75], [False])
