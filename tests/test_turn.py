"""One turn of closed surfaces: gaps, areas, fluxes and Steiner's vector, each by another way."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ruledlab.geometry import gallery
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.congruence import Congruence
from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.line import Line
from ruledlab.geometry.steps import stepped
from ruledlab.geometry.surface import RuledSurface
from ruledlab.geometry.turn import (
    carried,
    enclosed,
    steiner,
    steiner_angle,
    trajectory,
    turning,
    winding_numbers,
)

from .strategies import formulas, grid, loops

few = settings(max_examples=8)
CLOSED = ["cone", "hyperboloid", "example_2", "crown", "tower", "twisted_ring", "orchid"]
EXAMPLE_2 = gallery.surface("example_2")
T = np.array([0.15, 0.4, 0.85])
AXES = Line(np.eye(3), np.zeros((3, 3)))


def agree(found, expected, tolerance=1e-10):
    size = max(1.0, float(np.max(np.abs(expected), initial=0.0)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * size)


def slope(function, t, h=1e-3):
    """Fourth-order central difference."""
    a, b = function(t + h) - function(t - h), function(t + 2 * h) - function(t - 2 * h)
    return (8.0 * a - b) / (12.0 * h)


def whole_turns(angle):
    return angle / (2 * math.pi) == pytest.approx(round(angle / (2 * math.pi)), abs=1e-9)


# -- gaps ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", CLOSED)
def test_an_orthogonal_trajectory_comes_back_by_the_pitch_along_the_ruling(key):
    surface = gallery.surface(key)
    path = trajectory(surface, 0.7)
    assert path.gap == pytest.approx(surface.pitch(), abs=1e-11)
    agree(path.points[-1] - path.points[0], surface.pitch() * surface.line(0.0).direction, 1e-9)
    assert path.w[0] == pytest.approx(0.7)


@pytest.mark.parametrize("w0", [0.0, -2.0])
def test_a_trajectory_crosses_the_rulings_at_right_angles(w0):
    tangent = slope(lambda t: trajectory(EXAMPLE_2, w0, t).points, T)
    agree((tangent * EXAMPLE_2.line(T).direction).sum(axis=-1), np.zeros(3), 1e-7)


def test_w_solves_its_differential_equation():
    solved = solve_ivp(
        lambda t, w: -EXAMPLE_2.invariants(t).tau_bar,
        (0, 1),
        [0.3],
        t_eval=T,
        rtol=1e-10,
        atol=1e-12,
    )
    path = trajectory(EXAMPLE_2, 0.3, T)
    agree(path.w, solved.y[0], 1e-8)
    agree(path.points, np.stack([EXAMPLE_2.points(t, w) for t, w in zip(T, path.w, strict=True)]))


@pytest.mark.parametrize("key", CLOSED)
def test_xi_comes_back_turned_by_the_angle_of_pitch(key):
    surface = gallery.surface(key)
    turn = turning(surface, 0.4)
    assert turn.gap == pytest.approx(surface.angle_of_pitch(), abs=1e-10)
    frame = surface.frame(0.0)
    first, last = (np.arctan2(frame[2] @ xi, frame[1] @ xi) for xi in turn.xi[[0, -1]])
    assert whole_turns(float(last - first) - turn.gap)


def test_xi_moves_along_the_ruling_only():
    # So the plane of the ruling and ξ′ is one and the same: ξ spans a developable.
    change = slope(lambda t: turning(EXAMPLE_2, 1.0, t).xi, T)
    agree(np.cross(change, EXAMPLE_2.line(T).direction), np.zeros((3, 3)), 1e-6)
    agree((turning(EXAMPLE_2, 1.0, T).xi * EXAMPLE_2.line(T).direction).sum(-1), np.zeros(3))


def test_a_cylindrical_ruling_on_the_way_stops_xi_and_not_the_trajectory():
    # The generator swings forth and back; at the turning points it rests for a moment.
    surface = RuledSurface.from_base(
        lambda t: (np.cos(t), np.sin(t), 0),
        lambda t: (0.3 * np.cos(np.sin(t)), 0.3 * np.sin(np.sin(t)), 1),
        (0.0, 2 * math.pi),
    )
    path = trajectory(surface, 0.0, [0.0, math.pi / 2, 5.0])
    assert np.isfinite(path.points).all() and np.isnan(path.w).tolist() == [False, True, False]
    assert path.gap == pytest.approx(surface.pitch(), abs=1e-11)


def test_w0_needs_a_striction_point_to_count_from():
    surface = RuledSurface(Bezier([[0.5, 1.0], [0.5, 1.0], [1.5, 1.2]]), "u", 1)
    with pytest.raises(GeometryError, match="`w0` must be counted from a striction point"):
        trajectory(surface)


# -- areas and fluxes ------------------------------------------------------------------------------


def consistent(surface):
    region = enclosed(surface)
    agree(region.tau_from_area, region.tau, 1e-9)
    agree(region.tau_bar_from_flux, region.tau_bar, 1e-9)
    return region


@few
@given(loops(), formulas, formulas)
def test_gauss_bonnet_and_stokes_on_simple_loops(curve, ubar, vbar):
    region = consistent(RuledSurface(curve, ubar, vbar))
    assert abs(region.turns) == 1 and region.winding == 0 and region.border == 0.0


@few
@given(loops(order=0), formulas)
def test_gauss_bonnet_with_a_corner_at_the_seam(curve, vbar):
    consistent(RuledSurface(curve, "u*v", vbar))


def test_example_2_encloses_the_known_area():
    region = consistent(EXAMPLE_2)
    # Run clockwise in the chart, which is counter-clockwise seen from outside the sphere.
    assert region.area == pytest.approx(-0.1672475240, abs=1e-10)
    assert region.turns == -1 and region.corner == 0.0
    assert region.tau == pytest.approx(6.115937783177811, abs=1e-11)
    assert region.tau_bar == pytest.approx(-0.580104765135371, abs=1e-11)


def test_area_and_flux_by_counting_cells_with_their_winding_numbers():
    u, v = np.meshgrid(np.linspace(0.4, 1.3, 160), np.linspace(0.4, 1.3, 160), indexing="ij")
    cell = (u[1, 0] - u[0, 0]) * (v[0, 1] - v[0, 0])
    region = enclosed(EXAMPLE_2)
    weights = winding_numbers(region.outline, np.stack([u, v], axis=-1)) * np.sin(v) * cell
    assert weights.sum() == pytest.approx(region.area, rel=2e-2)
    flux = (weights * Congruence("u - v", "u + v").divergence(u, v)).sum()
    assert flux == pytest.approx(region.flux, rel=2e-2)


def closed_bezier(*points):
    return Bezier(np.array(points))


def test_a_figure_of_eight_turns_as_often_back_as_forth():
    eight = closed_bezier([1, 1.5], [3, 0.2], [3, 2.8], [-1, 0.2], [-1, 2.8], [1, 1.5])
    region = consistent(RuledSurface(eight, "sin(v)", "u"))
    assert region.turns == 0
    # The curve is symmetric about its double point at t = ½: one lobe before it, one after.
    lobes = [eight(np.linspace(a, a + 0.5, 50)).mean(axis=0) for a in (0.0, 0.5)]
    numbers = winding_numbers(region.outline, [*lobes, [3.0, 1.5]])
    assert sorted(numbers[:2].tolist()) == [-1, 1] and numbers[2] == 0


def test_a_loop_run_twice_counts_twice():
    once = np.array([[0, -1], [1, -1], [1, 1], [-1, 1], [-1, -1], [0, -1]]) * 0.6 + [1.0, 1.5]
    single = consistent(RuledSurface(Bezier(once), "u", "v"))
    double = RuledSurface(_Twice(Bezier(once)), "u", "v")
    region = consistent(double)
    assert (single.turns, region.turns) == (1, 2)
    agree([region.area, region.flux], [2 * single.area, 2 * single.flux])
    assert winding_numbers(region.outline, [1.0, 1.4]) == 2


class _Twice:
    """A curve run two times, t from 0 to 2, in one piece by reducing t."""

    def __init__(self, curve):
        self.curve, self.domain, self.batch_shape, self.scale = curve, (0.0, 2.0), (), curve.scale

    def series(self, t, order):
        return self.curve.series(np.where(t > 1.0, t - 1.0, t), order)


@pytest.mark.parametrize("key", ["hyperboloid", "crown", "tower", "twisted_ring"])
def test_a_curve_round_the_axis_bounds_a_strip_with_the_equator(key):
    region = consistent(gallery.surface(key))
    assert (region.winding, region.turns) == (1, 0)


def test_the_strip_of_a_parallel_circle_is_a_zone():
    region = enclosed(gallery.surface("hyperboloid"))
    assert region.area == pytest.approx(2 * math.pi * math.cos(math.pi / 4))  # Archimedes
    # v̄ = 1: the equator's share is −∮ v̄ du, the zone has the rest.
    assert region.border == pytest.approx(-2 * math.pi)
    assert region.flux == pytest.approx(2 * math.pi * (1 - math.sin(math.pi / 4)))
    inside, outside = winding_numbers(region.outline, [[1.0, 1.2], [1.0, 0.5]])
    assert (inside, outside) != (0, 0) and outside == 0 and abs(inside) == 1


@pytest.mark.parametrize("key", ["example_1", "moebius", "right_helicoid"])
def test_what_does_not_close_encloses_nothing(key):
    with pytest.raises(GeometryError, match=r"closes as a moving oriented line|undefined"):
        enclosed(gallery.surface(key))


def test_a_surface_from_a_base_curve_has_no_region_in_the_chart():
    ring = RuledSurface.from_base(
        lambda t: (np.cos(t), np.sin(t), 0),
        lambda t: (-np.sin(t), np.cos(t), 1),
        (0, 2 * math.pi),
    )
    with pytest.raises(GeometryError, match="from the chart"):
        enclosed(ring)


def test_a_field_that_breaks_off_inside_the_loop_is_refused():
    loop = closed_bezier([1, 1.2], [2, 1.2], [2, 2.0], [0, 2.0], [0, 1.2], [1, 1.2])
    surface = RuledSurface(loop, "u", "1/(v - 1.4)")
    with pytest.raises(GeometryError, match="converge"):
        enclosed(surface)
    # Finite all along the curve, and unbounded on a circle within.
    ring = RuledSurface(EXAMPLE_2.curve, "u", "1/((u - 0.8)**2 + (v - 0.8)**2 - 0.01)")
    with pytest.raises(GeometryError, match="the flux does not converge"):
        enclosed(ring)


EDGES = ["abs(v - 0.8)", "abs(u - v)", "abs((u - 0.8)**2 + (v - 0.8)**2 - 0.01)", "abs(sin(7*u))"]


@pytest.mark.parametrize("vbar", EDGES)
def test_an_edge_of_the_field_is_no_obstacle_to_stokes(vbar):
    region = enclosed(RuledSurface(EXAMPLE_2.curve, "u - v", vbar))
    agree(region.tau_bar_from_flux, region.tau_bar, 1e-10)
    assert region.off < 1e-9


@few
@given(loops(), grid(0.9, 2.2), grid(-1.0, 1.0))
def test_stokes_holds_over_any_edge_as_well_as_is_said(curve, height, slope):
    surface = RuledSurface(curve, "u", f"abs(v - {height} - {slope}*u)")
    region = enclosed(surface)
    assert abs(region.tau_bar_from_flux - region.tau_bar) <= region.off + 1e-10


@pytest.mark.parametrize(
    "vbar", ["1/((u - 0.8)**2 + (v - 0.8)**2)", "sin(200*u*v)", "sqrt(abs(u - 0.8)) + v"]
)
def test_how_far_the_flux_may_be_off_is_said(vbar):
    region = enclosed(RuledSurface(EXAMPLE_2.curve, "u", vbar))
    assert abs(region.tau_bar_from_flux - region.tau_bar) <= region.off + 1e-11
    assert 1e-9 < region.off < 1e-3


# -- Steiner ---------------------------------------------------------------------------------------


def test_the_frames_own_lines_have_the_known_dual_angles():
    lengths = EXAMPLE_2.arc_lengths()
    angle = steiner_angle(EXAMPLE_2, AXES)
    agree(angle.real, [-lengths.tau, 0.0, -lengths.kappa])
    agree(angle.dual, [-lengths.tau_bar, 0.0, -lengths.kappa_bar])
    vector = steiner(EXAMPLE_2)
    agree(vector.real, [lengths.tau, 0.0, lengths.kappa])


def test_the_first_line_of_the_frame_sweeps_the_surface_itself():
    again = carried(EXAMPLE_2, AXES[0])
    agree(again.line(T).moment, EXAMPLE_2.line(T).moment)
    found, expected = again.invariants(T), EXAMPLE_2.invariants(T)
    for name in ("kappa", "kappa_bar", "tau", "tau_bar"):
        agree(getattr(found, name), getattr(expected, name), 1e-8)


lines = st.builds(
    Line.from_point_direction,
    st.tuples(*[grid(-1.0, 1.0)] * 3).map(np.array),
    # Away from the screw axes, which lie across x₂: such a line never rests.
    st.tuples(grid(-0.3, 0.3), grid(0.8, 1.0), grid(-0.3, 0.3)).map(np.array),
)


ROUND_A_POLE = [
    Bezier([[0, 1.1], [1, 1.3], [2, 0.7], [3.2, 1.4], [4, 0.9], [2 * math.pi - 1, 0.9],
            [2 * math.pi, 1.1]]),
    Bezier([[0, 2.2], [0.8, 2.2], [2, 2.9], [3.5, 1.6], [2 * math.pi - 0.8, 2.2],
            [2 * math.pi, 2.2]]),
]  # fmt: skip


def corner_of_the_path(surface, line):
    """The angle about y from ω at the end to ω at the start, seen along y."""
    y, ends = line.direction, surface.invariants(np.array(surface.domain))
    end, start = (np.array([ends.tau[k], 0.0, ends.kappa[k]]) for k in (1, 0))
    sine, cosine = np.cross(end, start) @ y, end @ start - (end @ y) * (start @ y)
    return math.atan2(sine, cosine)


def carried_round(surface, line):
    """λ of the swept surface is Steiner's real part + the corner at its seam, l his dual part."""
    expected, direct = steiner_angle(surface, line), carried(surface, line).dual_angle_of_pitch()
    corner = corner_of_the_path(surface, line)
    assert direct.dual == pytest.approx(float(expected.dual), abs=1e-8)
    assert direct.real == pytest.approx(float(expected.real) + corner, abs=1e-8)
    return corner


@few
@given(loops(order=2), formulas, lines)
def test_steiner_gives_pitch_and_angle_of_any_line_the_frame_carries(curve, vbar, line):
    assert carried_round(RuledSurface(curve, "u", vbar), line) == pytest.approx(0.0, abs=1e-8)


@few
@given(loops(order=1), formulas, lines)
def test_the_path_of_a_carried_line_has_a_corner_where_tau_jumps(curve, vbar, line):
    carried_round(RuledSurface(curve, "u", vbar), line)


@few
@given(st.sampled_from(ROUND_A_POLE), lines)
def test_no_whole_turn_is_lost_round_a_pole(curve, line):
    surface = RuledSurface(curve, "sin(u)", "v")
    assert abs(carried_round(surface, line)) > 1e-3


def test_the_angle_of_a_carried_line_is_that_of_its_polygon():
    # Exterior angles, the seam's among them, know of no frame: ∮τ and the corner in one.
    surface = RuledSurface(ROUND_A_POLE[0], "sin(u)", "v")
    line = Line.from_point_direction([0.3, 0.1, 0.0], [0.4, 0.8, -0.2])
    found = stepped(carried(surface, line), 2048)
    assert found.bend == pytest.approx(-float(steiner_angle(surface, line).real), abs=1e-6)
    assert abs(corner_of_the_path(surface, line)) > 0.1


@pytest.mark.parametrize("key", ["hyperboloid", "crown", "orchid", "example_2"])
def test_the_second_line_sweeps_a_surface_without_pitch(key):
    swept = carried(gallery.surface(key), AXES[1]).dual_angle_of_pitch()
    assert swept.real == pytest.approx(0.0, abs=1e-9)  # τ/κ is the same at both ends of these
    assert swept.dual == pytest.approx(0.0, abs=1e-9)


@few
@given(loops(order=1), grid(-3.0, 3.0))
def test_a_line_across_x2_has_no_corner_though_tau_jumps(curve, angle):
    # y and y′ = (κ cos − τ sin) x₂ keep one plane of the frame; y may even rest on its way.
    surface = RuledSurface(curve, "u", "v")
    line = Line.from_point_direction([0, 0.2, 0], [math.cos(angle), 0, math.sin(angle)])
    lengths = surface.arc_lengths()
    expected = -lengths.tau * math.cos(angle) - lengths.kappa * math.sin(angle)
    ends = surface.invariants(np.array(surface.domain))
    speed = ends.kappa * math.cos(angle) - ends.tau * math.sin(angle)
    assume(np.abs(speed).min() > 0.1)
    t = np.linspace(0, 1, 200)
    inside = surface.invariants(t)
    assume(np.abs(inside.kappa * math.cos(angle) - inside.tau * math.sin(angle)).min() > 0.05)
    found = carried(surface, line).dual_angle_of_pitch()
    assert found.real == pytest.approx(expected, abs=1e-8)


def test_the_third_line_of_a_crown_has_minus_the_dual_length_of_the_first():
    surface = gallery.surface("crown")
    swept, lengths = carried(surface, AXES[2]).dual_angle_of_pitch(), surface.arc_lengths()
    assert swept.real == pytest.approx(-lengths.kappa, abs=1e-9)
    assert swept.dual == pytest.approx(-lengths.kappa_bar, abs=1e-9)


def test_a_frame_that_jumps_along_the_ruling_has_no_steiner_vector():
    # ∮τ̄ over the stretches between the jumps is not −l: it is no number to be shown.
    surface = RuledSurface(EXAMPLE_2.curve, "u - v", "abs(v - 0.8)")
    for ask in (steiner, RuledSurface.arc_lengths):
        with pytest.raises(GeometryError, match="the striction point jumps along the ruling"):
            ask(surface)


def test_carried_points_keep_their_place_in_the_frame():
    line = Line.from_point_direction([0.3, -0.2, 0.5], [0.2, 0.9, 0.1])
    swept, frame, m = carried(EXAMPLE_2, line), EXAMPLE_2.frame(T), EXAMPLE_2.striction(T)
    agree(swept.line(T).direction, np.einsum("tij,i->tj", frame, line.direction))
    point = m + np.einsum("tij,i->tj", frame, np.array([0.3, -0.2, 0.5]))
    agree(swept.line(T).distance_to(point), np.zeros(3))


@pytest.mark.parametrize("key", ["ramp", "moebius"])
def test_steiner_needs_a_frame_that_comes_back(key):
    with pytest.raises(GeometryError, match="frame that comes back"):
        steiner(gallery.surface(key))


def test_a_corner_at_the_seam_leaves_the_frame_turned():
    corner = closed_bezier([1, 1.2], [1.5, 1.0], [2, 1.9], [1.0, 2.2], [1, 1.2])
    with pytest.raises(GeometryError, match="frame that comes back"):
        steiner(RuledSurface(corner, "u", "v"))


def test_only_one_line_is_carried_at_a_time():
    with pytest.raises(GeometryError, match="`line` must be a single line"):
        carried(EXAMPLE_2, AXES)
