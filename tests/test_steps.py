"""One turn in steps against the integrals: they share the rulings and nothing else."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from ruledlab.geometry import Bezier, GeometryError, RuledSurface, enclosed, gallery, stepped

from .strategies import formulas, loops

CLOSED = ["cone", "hyperboloid", "plucker_conoid", "example_2", "crown", "tower", "orchid"]


@pytest.mark.parametrize("key", [*CLOSED, "twisted_ring"])
def test_the_steps_agree_with_the_integrals(key: str) -> None:
    surface = gallery.surface(key)
    total, steps = surface.dual_angle_of_pitch(), stepped(surface)
    assert steps.count == 512
    assert -steps.bend == pytest.approx(float(total.real), abs=1e-8)
    assert steps.shift == pytest.approx(float(total.dual), abs=2e-8)


@settings(max_examples=12, deadline=None)
@given(loops(order=2), formulas, formulas)
def test_the_steps_agree_for_any_smooth_loop(curve: Bezier, ubar: str, vbar: str) -> None:
    surface = RuledSurface(curve, ubar, vbar)
    total, steps = surface.dual_angle_of_pitch(), stepped(surface, 2048)
    assert -steps.bend == pytest.approx(float(total.real), abs=1e-4)
    assert steps.shift == pytest.approx(float(total.dual), rel=1e-6, abs=1e-6)


def test_the_error_is_of_fourth_order() -> None:
    surface = gallery.surface("crown")
    exact = surface.pitch()
    errors = [abs(stepped(surface, count).shift - exact) for count in (128, 256)]
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.15)


def test_a_corner_at_the_seam_is_counted() -> None:
    points = np.array([[1, 1.2], [1.5, 1.0], [2, 1.9], [1.0, 2.2], [1, 1.2]])
    surface = RuledSurface(Bezier(points), "u", "v")
    region = enclosed(surface)
    assert abs(region.corner) > 1.0
    assert stepped(surface).bend == pytest.approx(region.tau + region.corner, abs=1e-6)


def test_a_circle_of_latitude_by_its_cap() -> None:
    """All rulings of a cone: the area of the cap is known without any of this."""
    height = 1.1
    circle = RuledSurface(Bezier([[0.0, height], [2 * math.pi, height]]), "1", "0")
    steps = stepped(circle)
    assert steps.bend == pytest.approx(2 * math.pi - 2 * math.pi * (1 - math.cos(height)), abs=1e-8)
    assert steps.shift == pytest.approx(0.0, abs=1e-12)


def test_a_reversed_way_gives_the_opposite() -> None:
    surface = gallery.surface("orchid")
    back = RuledSurface(Bezier(surface.curve.points[::-1]), surface.ubar, surface.vbar)
    there, again = stepped(surface), stepped(back)
    assert (again.shift, again.bend) == pytest.approx((-there.shift, -there.bend), abs=1e-9)


@pytest.mark.parametrize("key", ["moebius", "right_helicoid", "example_1"])
def test_a_way_that_does_not_lead_back_is_refused(key: str) -> None:
    with pytest.raises(GeometryError, match="`surface` must close as a moving oriented line"):
        stepped(gallery.surface(key))


@pytest.mark.parametrize("count", [0, 15, 17, 14, 100.5])
def test_too_few_steps_are_refused(count: float) -> None:
    with pytest.raises(GeometryError, match="`count` must be an even number ≥ 16"):
        stepped(gallery.surface("cone"), count)  # type: ignore[arg-type]
