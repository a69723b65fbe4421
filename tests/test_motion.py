"""The frame's motion: screw, frame equations, striction arc length; by finite motions, by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry import gallery
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.motion import StrictionLength, frame_equations, screw
from ruledlab.geometry.surface import RuledSurface

from .strategies import grid, places, rotations, surfaces, translations

few = settings(max_examples=15)
T = np.array([0.1, 0.45, 0.8])
EXAMPLE_2 = gallery.surface("example_2")


def agree(found, expected, tolerance=1e-10):
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


def slope(function, t, h=1e-3):
    """Fourth-order central difference."""
    a, b = function(t + h) - function(t - h), function(t + 2 * h) - function(t - 2 * h)
    return (8.0 * a - b) / (12.0 * h)


def moved(surface, t, q):
    """Where the point with coordinates q in the frame is at t."""
    return surface.striction(t) + np.einsum("...ij,i->...j", surface.frame(t), q)


def helicoid(p):
    return RuledSurface(Bezier([[0, math.pi / 2], [3, math.pi / 2]]), f"{p}*u", 0)


# -- the screw -------------------------------------------------------------------------------------


@few
@given(surfaces, grid(0.1, 0.9), st.tuples(*[grid(-1.0, 1.0)] * 3).map(np.array))
def test_every_point_of_the_frame_moves_on_the_screw(surface, t, q):
    move = screw(surface, t)
    axis, omega = move.axis.direction, move.angular_speed
    arm = moved(surface, t, q) - move.point
    expected = omega * (np.cross(axis, arm) + move.pitch * axis)
    # The finite difference suffers where the motion is fast: compare relative to its speed.
    fast = max(1.0, float(np.max(np.abs(surface.invariants([t - 1e-3, t, t + 1e-3]).tau))))
    if fast < 50:
        agree(slope(lambda s: moved(surface, s, q), t), expected, 1e-4)


@few
@given(surfaces, places)
def test_the_axis_meets_the_middle_line_of_the_frame_at_right_angles(surface, t):
    move, frame, m = screw(surface, t), surface.frame(t), surface.striction(t)
    away = move.point - m
    agree(np.cross(away, frame[:, 1]), np.zeros_like(away))
    agree((move.axis.direction * frame[:, 1]).sum(axis=-1), np.zeros(t.size))
    agree(np.linalg.norm(move.axis.direction, axis=-1), np.ones(t.size))
    agree(move.axis.distance_to(move.point), np.zeros(t.size))


@few
@given(rotations, translations)
def test_the_screw_moves_along_with_the_surface(rotation, translation):
    def base(t):
        return np.cos(t), np.sin(2 * t), t

    def direction(t):
        return np.sin(t), 1 + t, np.cos(3 * t)

    def turned(function, shift):
        def result(t):
            a = function(t)
            return [
                sum(r * e for r, e in zip(row, a, strict=True)) + s
                for row, s in zip(rotation.tolist(), shift, strict=True)
            ]

        return result

    here = screw(RuledSurface.from_base(base, direction), T)
    there = screw(
        RuledSurface.from_base(turned(base, translation), turned(direction, [0, 0, 0])), T
    )
    agree(there.pitch, here.pitch, 1e-9)
    moved_axis = here.axis.transformed(rotation, translation)
    agree(there.axis.direction, moved_axis.direction, 1e-9)
    agree(there.axis.moment, moved_axis.moment, 1e-9)


def test_a_right_helicoid_screws_about_its_axis_with_its_own_pitch():
    move = screw(helicoid(0.7), T)
    agree(move.axis.direction, np.tile([0.0, 0.0, 1.0], (3, 1)))
    agree(move.axis.moment, np.zeros((3, 3)))
    agree(move.pitch, np.full(3, 0.7))


def test_a_hyperboloid_turns_about_its_axis_without_sliding():
    move = screw(gallery.surface("hyperboloid"), T)
    agree(move.axis.direction, np.tile([0.0, 0.0, 1.0], (3, 1)))
    agree(move.axis.moment, np.zeros((3, 3)))
    agree(move.pitch, np.zeros(3))
    agree(move.angular_speed, np.full(3, 2 * math.pi))


def test_a_cone_turns_about_axes_through_its_apex():
    move = screw(gallery.surface("cone"), T)
    agree(move.pitch, np.zeros(3))
    agree(move.point, np.tile([0.0, 0.0, 1.0], (3, 1)))


def test_a_batch_of_surfaces_and_any_shape_of_t():
    curve = Bezier(np.array([[[0.2, 0.9], [1.5, 1.4]], [[0.1, 1.0], [1.0, 2.0]]]))
    move = screw(RuledSurface(curve, "u", "v"), T)
    one = screw(RuledSurface(Bezier(curve.points[1]), "u", "v"), T)
    assert move.pitch.shape == (2, 3) and move.point.shape == (2, 3, 3)
    agree(move.pitch[1], one.pitch)


def test_a_cylindrical_ruling_has_no_screw():
    cylinder = RuledSurface.from_base(lambda t: (np.cos(t), np.sin(t), 0), lambda t: (0, 0, 1))
    move = screw(cylinder, T)
    assert np.isnan(move.pitch).all() and np.isnan(move.axis.direction).all()


# -- the frame equations ---------------------------------------------------------------------------


@few
@given(surfaces, places)
def test_the_frame_equations_hold(surface, t):
    both = frame_equations(surface, t)
    assert both.left.shape == (t.size, 3, 2, 3)
    size = 1.0 + np.abs(both.left).max()
    assert both.residual.max() <= 1e-10 * size


def test_their_left_side_is_the_frame_differentiated():
    both = frame_equations(EXAMPLE_2, T)
    agree(both.left[:, :, 0], slope(EXAMPLE_2.frame, T), 1e-6)

    def moments(t):
        return np.cross(EXAMPLE_2.striction(t)[..., None, :], EXAMPLE_2.frame(t))

    agree(both.left[:, :, 1], slope(moments, T), 1e-6)


def test_the_printed_second_equation_would_leave_a_residual():
    # Its dual part ends in τ x̄₂ where τ x̄₃ is right.
    both, inv = frame_equations(EXAMPLE_2, 0.3), EXAMPLE_2.invariants(0.3)
    moments = np.cross(EXAMPLE_2.striction(0.3), EXAMPLE_2.frame(0.3))
    printed = both.right[1, 1] + inv.tau * (moments[1] - moments[2])
    assert np.linalg.norm(both.left[1, 1] - printed) > 1.0
    assert both.residual[1, 1] < 1e-10


def test_the_frame_equations_are_undefined_on_a_cylindrical_ruling():
    cusp = RuledSurface(Bezier([[0.5, 1.0], [0.5, 1.0], [1.5, 1.2]]), "u", 1)
    both = frame_equations(cusp, [0.0, 0.5])
    assert np.isnan(both.residual[0]).all() and np.isfinite(both.residual[1]).all()


# -- striction arc length --------------------------------------------------------------------------


@few
@given(surfaces, st.lists(grid(0.0, 1.0), min_size=1, max_size=5).map(np.array))
def test_s_and_t_undo_each_other_and_end_in_the_total(surface, fraction):
    length = StrictionLength(surface)
    assert length.total == pytest.approx(surface.arc_lengths().striction, rel=1e-9, abs=1e-11)
    if length.total > 1e-6:
        s = fraction * length.total
        agree(length.s(length.t(s)), s, 1e-11)


def test_s_is_the_length_of_the_polygon_on_the_striction_curve():
    length, t = StrictionLength(EXAMPLE_2), np.linspace(0.0, 0.7, 20001)
    polygon = np.linalg.norm(np.diff(EXAMPLE_2.striction(t), axis=0), axis=1).sum()
    assert length.s(0.7) == pytest.approx(polygon, rel=1e-6)
    assert length.s(0.0) == 0.0


def test_a_right_helicoid_climbs_in_proportion_to_t():
    length = StrictionLength(helicoid(0.5))
    agree(length.s(T), 1.5 * T)
    agree(length.t([0.3, 1.5]), [0.2, 1.0])


def test_a_striction_curve_with_cusps_is_measured_to_rounding():
    # Plücker's conoid: m = (0, 0, sin 2u) goes up and down, at rest at four torsal rulings.
    length = StrictionLength(gallery.surface("plucker_conoid"))
    assert length.total == pytest.approx(8.0, abs=1e-11)
    u = 2 * math.pi * T
    agree(length.s(1 / 16), math.sin(math.pi / 4))
    agree(length.t(length.s(T)), u / (2 * math.pi), 1e-9)


def test_a_cone_has_no_arc_length_to_invert():
    length = StrictionLength(gallery.surface("cone"))
    agree(length.s(T), np.zeros(3))
    with pytest.raises(GeometryError, match="single point"):
        length.t(0.0)


def test_arc_length_outside_the_striction_curve_is_refused():
    length = StrictionLength(helicoid(0.5))
    for s in (-0.1, 1.6):
        with pytest.raises(GeometryError, match=r"`s` must lie between 0 and 1\.5"):
            length.t(s)


def test_a_striction_curve_that_runs_to_infinity_is_refused():
    # The generator stops and turns back at t = ½, the base goes on: m = c + const/(t − ½) x + …
    surface = RuledSurface.from_base(
        lambda t: (t, t**2, 0), lambda t: (np.cos((t - 0.5) ** 2), np.sin((t - 0.5) ** 2), 0.5)
    )
    with pytest.raises(GeometryError, match=r"striction arc length does not converge.*near t = 0"):
        StrictionLength(surface)
