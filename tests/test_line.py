"""Lines: Study's map, the dual angle and the common perpendicular, in every special position."""

from __future__ import annotations

import math
from dataclasses import FrozenInstanceError

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from ruledlab.geometry.checks import PARALLEL, GeometryError
from ruledlab.geometry.dual import Dual, cross, inner, norm, normalize
from ruledlab.geometry.line import Line, common_perpendicular, dual_angle, relation

coordinate = st.floats(-10, 10).map(lambda a: round(a, 6))
points = arrays(float, 3, elements=coordinate)
directions = points.filter(lambda d: np.linalg.norm(d) > 0.1)
lines = st.builds(Line.from_point_direction, points, directions)
quaternions = arrays(float, 4, elements=coordinate).filter(lambda q: np.linalg.norm(q) > 0.1)
rotations = quaternions.map(lambda q: Rotation.from_quat(q).as_matrix())

few = settings(max_examples=50)
X_AXIS = Line.from_point_direction([0, 0, 0], [1, 0, 0])
TWO = Line.from_point_direction([[0, 0, 0], [0, 0, 1]], [[1, 0, 0], [0, 1, 0]])


def in_general_position(a, b):
    """Far enough from parallel for comparisons to 1e-9."""
    return np.linalg.norm(np.cross(a.direction, b.direction)) > 0.01


def close(a, b, atol=1e-11):
    np.testing.assert_allclose(a, b, rtol=1e-11, atol=atol)


def same_line(a, b, atol=1e-11):
    close(a.direction, b.direction, atol)
    close(a.moment, b.moment, atol)


# -- one line -------------------------------------------------------------------------------------


@few
@given(points, directions)
def test_line_is_a_dual_unit_vector_with_moment_point_times_direction(point, direction):
    line = Line.from_point_direction(point, direction)
    close(np.linalg.norm(line.direction), 1.0)
    close(line.direction @ line.moment, 0.0)
    close(line.direction * np.linalg.norm(direction), direction)
    close(line.moment, np.cross(point, line.direction))


@few
@given(points, directions, st.floats(-50, 50))
def test_moment_does_not_depend_on_the_point(point, direction, w):
    line = Line.from_point_direction(point, direction)
    same_line(Line.from_point_direction(point + w * line.direction, 3 * direction), line, 1e-12)


@few
@given(lines, points, st.floats(-20, 20))
def test_point_is_on_the_line_exactly_where_point_times_direction_is_the_moment(line, p, w):
    on = line.point(w)
    close(np.cross(on, line.direction), line.moment)
    close(line.distance_to(on), 0.0)
    nearest = line.foot + (p @ line.direction) * line.direction
    close(line.distance_to(p), np.linalg.norm(p - nearest))
    close(np.linalg.norm(np.cross(p, line.direction) - line.moment), np.linalg.norm(p - nearest))


@few
@given(lines, st.floats(-20, 20))
def test_foot_is_the_point_nearest_the_origin(line, w):
    close(line.foot @ line.direction, 0.0)
    close(line.distance_to(line.foot), 0.0)
    close(np.linalg.norm(line.foot), line.distance_to([0, 0, 0]))
    close(np.linalg.norm(line.point(w)), math.hypot(np.linalg.norm(line.foot), w))


@few
@given(points, points)
def test_line_through_two_points_holds_both_and_runs_from_the_first(p, q):
    assume(np.linalg.norm(q - p) > 1e-3)
    line = Line.through(p, q)
    close(line.distance_to(np.stack([p, q])), 0.0, 1e-9)
    assert (q - p) @ line.direction > 0
    same_line(Line.through(q, p), line.reversed(), 1e-9)


@few
@given(lines, st.floats(1e-3, 1e3))
def test_plucker_coordinates_go_there_and_back_at_any_positive_scale(line, scale):
    same_line(Line.from_plucker(line.plucker), line)
    same_line(Line.from_plucker(scale * line.plucker), line)
    same_line(Line.from_plucker(-scale * line.plucker), line.reversed())


@pytest.mark.parametrize("scale", [1e-200, 1e-30, 1e30, 1e200])
def test_plucker_coordinates_of_extreme_scale(scale):
    line = Line.through([1, 2, 3], [4, 0, -1])
    same_line(Line.from_plucker(scale * line.plucker), line)


@few
@given(lines)
def test_dual_vector_goes_there_and_back(line):
    same_line(Line.from_dual(line.dual), line)
    close(inner(line.dual, line.dual).real, 1.0)
    close(inner(line.dual, line.dual).dual, 0.0)


@few
@given(directions, points)
def test_any_dual_vector_gives_a_line_once_normalised(real, dual):
    line = Line.from_dual(normalize(Dual(real, dual)))
    close(np.cross(line.direction, real), 0.0)


@pytest.mark.parametrize("seed", range(5))
def test_a_distant_point_along_the_line_leaves_the_moment_normal(seed):
    near, direction = np.random.default_rng(seed).normal(size=(2, 3))
    line = Line.from_point_direction(near + 1e10 * direction, direction)
    same_line(Line.from_dual(line.dual), line)
    same_line(Line.from_plucker(line.plucker), line)


@few
@given(lines, rotations, points, st.floats(-20, 20))
def test_rigid_motion_moves_the_points(line, rotation, translation, w):
    moved = line.transformed(rotation, translation)
    close(moved.direction, rotation @ line.direction)
    close(moved.distance_to(rotation @ line.point(w) + translation), 0.0, 1e-10)
    back = moved.transformed(rotation.T, -rotation.T @ translation)
    same_line(back, line, 1e-10)


def test_rotation_alone_and_batches_of_motions():
    quarter = Rotation.from_rotvec([[0, 0, k * math.pi / 2] for k in range(3)]).as_matrix()
    moved = Line.through([0, 0, 1], [1, 0, 1]).transformed(quarter)
    close(moved.direction, [[1, 0, 0], [0, 1, 0], [-1, 0, 0]])
    assert X_AXIS.transformed(np.eye(3), np.zeros((4, 1, 3))).shape == (4, 1)


def test_frozen_and_read_only():
    line = Line([1, 0, 0], [0, 0, 2])
    with pytest.raises(FrozenInstanceError):
        line.direction = np.zeros(3)
    for part in (line.direction, line.moment, line[...].moment, line.reversed().direction):
        with pytest.raises(ValueError, match="read-only"):
            part[0] = 5.0


def test_a_line_does_not_follow_the_array_it_came_from():
    direction = np.array([1.0, 0.0, 0.0])
    line = Line(direction, [0, 0, 2])
    direction[:] = 7.0
    close(line.direction, [1, 0, 0])


def test_batches_index_and_broadcast():
    line = Line.from_point_direction(np.arange(24.0).reshape(2, 4, 3), [[0, 3, 4]])
    assert line.shape == (2, 4)
    assert line.foot.shape == (2, 4, 3)
    assert line.plucker.shape == (2, 4, 6)
    assert line[1].shape == (4,)
    assert line[..., 0].shape == (2,)
    assert line[1, 2].shape == ()
    assert line[:, [0, 2]].shape == (2, 2)
    assert line[line.foot[..., 0] > 5].shape == ((line.foot[..., 0] > 5).sum(),)
    same_line(line[1, 2], Line.from_point_direction([18, 19, 20], [0, 3, 4]))
    assert line.point(np.zeros((5, 1, 1))).shape == (5, 2, 4, 3)
    assert X_AXIS.point([0, 1, 2]).shape == (3, 3)
    with pytest.raises(IndexError):
        X_AXIS[0]


def test_empty_batch():
    none = Line(np.zeros((0, 3)), np.zeros((0, 3)))
    assert none.shape == (0,)
    assert dual_angle(none, X_AXIS).real.shape == (0,)
    assert common_perpendicular(none, X_AXIS).foot_a.shape == (0, 3)


# -- refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: Line([2, 0, 0], [0, 0, 0]), r"`direction` must have length 1 .* got 2; use Line"),
        (lambda: Line([1, 0, 0], [0.5, 1, 0]), r"`moment` must be normal .* = 0\.5 .*give moment"),
        (lambda: Line([1, 0], [0, 0]), r"`direction` must have shape \(…, 3\); got \(2,\)"),
        (lambda: Line([1, 0, 0], 0), r"`moment` must have shape \(…, 3\); got \(\)"),
        (lambda: Line([np.nan, 0, 1], [0, 0, 0]), r"`direction` must be finite"),
        (lambda: Line([1, 0, 0], [0, np.inf, 0]), r"`moment` must be finite"),
        (lambda: Line("x", [0, 0, 0]), r"`direction` must be made of real numbers"),
        (lambda: Line([[1, 0, 0]] * 2, [[0, 0, 0]] * 3), r"leading axes that broadcast; got"),
        (lambda: Line.from_point_direction([1, 2, 3], [0, 0, 0]), r"`direction` must not be the z"),
        (lambda: Line.through([1, 2, 3], [1, 2, 3]), r"`p` and `q` must be distinct"),
        (lambda: Line.through([[1, 2, 3], [0, 0, 0]], [1, 2, 3]), r"got 1 of 2"),
        (lambda: Line.from_plucker([0, 0, 0, 1, 0, 0]), r"`six` .* line at infinity"),
        (lambda: Line.from_plucker([2, 0, 0, 1, 2, 0]), r"Plücker relation .* = 0\.5 with"),
        (lambda: Line.from_plucker([1, 0, 0, 0, 0]), r"`six` must have shape \(…, 6\); got \(5,\)"),
        (lambda: Line.from_dual([1, 0, 0]), r"`vector` must be a Dual; got list; write Line"),
        (lambda: Line.from_dual(Dual([2.0, 0, 0], 0.0 * np.ones(3))), r"length 1"),
        (lambda: X_AXIS.transformed(2 * np.eye(3)), r"`rotation` must be orthogonal .* 3;"),
        (lambda: X_AXIS.transformed(-np.eye(3)), r"determinant \+1; got a reflection"),
        (lambda: X_AXIS.transformed(np.eye(2)), r"`rotation` must have shape \(…, 3, 3\)"),
        (lambda: X_AXIS.transformed(np.eye(3), [1, 2]), r"`translation` must have shape"),
        (lambda: X_AXIS.distance_to([1, 2]), r"`point` must have shape"),
        (lambda: X_AXIS.point(np.nan), r"`w` must be finite"),
        (lambda: dual_angle(X_AXIS, [1, 0, 0]), r"`b` must be a Line; got list"),
        (
            lambda: dual_angle(TWO, TWO[[0, 1, 1]]),
            r"`a` and `b` must have leading axes that broadcast; got \(2,\) and \(3,\)",
        ),
        (lambda: TWO.point([1, 2, 3]), r"`w` and `line` must have leading axes"),
        (lambda: TWO.distance_to(np.zeros((3, 3))), r"`point` and `line` must have leading axes"),
        (
            lambda: TWO.transformed(np.eye(3), np.zeros((3, 3))),
            r"`rotation` and `translation` and `line` must have leading axes",
        ),
    ],
)
def test_what_is_no_line_is_refused_in_one_line_with_a_remedy(make, text):
    with pytest.raises(GeometryError, match=text) as refusal:
        make()
    assert "\n" not in str(refusal.value)


def test_the_worst_line_of_a_batch_is_named():
    with pytest.raises(GeometryError, match=r"got 1\.5;"):
        Line([[1, 0, 0], [1.5, 0, 0], [0.9, 0, 0]], np.zeros(3))


def test_rounding_is_no_reason_to_refuse():
    third = np.full(3, 1 / math.sqrt(3))
    assert Line(third, 1e6 * np.cross([1, 2, 3], third)).shape == ()
    with pytest.raises(GeometryError):
        Line(third * (1 + 1e-8), np.zeros(3))


# -- two lines in general position ----------------------------------------------------------------


@few
@given(lines, lines)
def test_inner_product_is_the_cosine_of_the_dual_angle(a, b):
    """⟨X, Y⟩ = cos θ − ε d sin θ, for every position, with numpy's cosine of a dual number."""
    angle, product = dual_angle(a, b), inner(a.dual, b.dual)
    assert 0.0 <= angle.real <= math.pi
    close(product.real, math.cos(angle.real))
    close(product.dual, -angle.dual * math.sin(angle.real), 1e-10)
    cosine = np.cos(angle)
    close(product.dual, cosine.dual, 1e-10)


@few
@given(lines, lines)
def test_distance_and_feet_by_least_squares(a, b):
    """min over (s, r) of ‖p + s x − q − r y‖ is |d|, reached at the two feet."""
    assume(in_general_position(a, b))
    found = common_perpendicular(a, b)
    matrix = np.stack([a.direction, -b.direction], axis=1)
    (s, r), *_ = np.linalg.lstsq(matrix, b.foot - a.foot, rcond=None)
    close(found.foot_a, a.point(s), 1e-7)
    close(found.foot_b, b.point(r), 1e-7)
    close(abs(found.distance), np.linalg.norm(a.point(s) - b.point(r)), 1e-7)


@pytest.mark.parametrize("seed", range(5))
def test_distance_by_blind_minimisation(seed):
    rng = np.random.default_rng(seed)
    a, b = (Line.from_point_direction(*rng.normal(size=(2, 3))) for _ in range(2))
    least = minimize(lambda w: np.sum((a.point(w[0]) - b.point(w[1])) ** 2), [0.0, 0.0], tol=1e-14)
    found = common_perpendicular(a, b)
    assert abs(dual_angle(a, b).dual) == pytest.approx(math.sqrt(least.fun), rel=1e-6)
    np.testing.assert_allclose(found.foot_a, a.point(least.x[0]), atol=1e-5)
    np.testing.assert_allclose(found.foot_b, b.point(least.x[1]), atol=1e-5)


@few
@given(lines, lines)
def test_sign_is_the_way_from_a_to_b_along_the_cross_product(a, b):
    assume(in_general_position(a, b))
    found = common_perpendicular(a, b)
    n = np.cross(a.direction, b.direction)
    n /= np.linalg.norm(n)
    close(found.line.direction, n, 1e-10)
    close(found.foot_b - found.foot_a, found.distance * n, 1e-8)
    close(found.distance, dual_angle(a, b).dual)
    close(found.angle, dual_angle(a, b).real)


@few
@given(lines, lines)
def test_perpendicular_is_the_normalised_dual_cross_product(a, b):
    assume(in_general_position(a, b))
    found, product = common_perpendicular(a, b), normalize(cross(a.dual, b.dual))
    close(found.line.direction, product.real, 1e-10)
    close(found.line.moment, product.dual, 1e-7)


@few
@given(lines, lines)
def test_perpendicular_meets_both_at_right_angles(a, b):
    assume(in_general_position(a, b))
    found = common_perpendicular(a, b)
    for line, foot in ((a, found.foot_a), (b, found.foot_b)):
        close(line.distance_to(foot), 0.0, 1e-8)
        close(found.line.distance_to(foot), 0.0, 1e-8)
        close(found.line.direction @ line.direction, 0.0)
        right = dual_angle(found.line, line)
        close(right.real, math.pi / 2)
        close(right.dual, 0.0, 1e-8)


@few
@given(lines, lines)
def test_transference_gives_the_dual_angle_by_dual_trigonometry(a, b):
    """θ + ε d = arctan2(‖X × Y‖, ⟨X, Y⟩) and X × Y = sin(θ + ε d) N, as for real unit vectors."""
    assume(in_general_position(a, b))
    angle = dual_angle(a, b)
    by_duals = np.arctan2(norm(cross(a.dual, b.dual)), inner(a.dual, b.dual))
    close(by_duals.real, angle.real)
    close(by_duals.dual, angle.dual, 1e-9)
    by_arccos = np.arccos(inner(a.dual, b.dual))
    close(by_arccos.real, angle.real, 1e-9)
    close(by_arccos.dual, angle.dual, 1e-7)
    product, along = cross(a.dual, b.dual), common_perpendicular(a, b).line.dual
    expected = Dual(along.real, along.dual) * Dual(*map(np.asarray, parts(np.sin(angle))))
    close(product.real, expected.real, 1e-10)
    close(product.dual, expected.dual, 1e-7)


def parts(a):
    return a.real, a.dual


@few
@given(lines, lines, rotations, points)
def test_rigid_motion_keeps_the_dual_angle_and_moves_the_perpendicular(a, b, rotation, shift):
    assume(in_general_position(a, b))
    before = common_perpendicular(a, b)
    after = common_perpendicular(*(line.transformed(rotation, shift) for line in (a, b)))
    close(after.angle, before.angle)
    close(after.distance, before.distance, 1e-9)
    close(after.foot_a, rotation @ before.foot_a + shift, 1e-7)
    close(after.line.direction, rotation @ before.line.direction, 1e-9)


@few
@given(lines, lines)
def test_exchange_keeps_and_reversal_turns_the_dual_angle(a, b):
    assume(in_general_position(a, b))
    angle = dual_angle(a, b)
    for other, real, dual in (
        (dual_angle(b, a), angle.real, angle.dual),
        (dual_angle(a.reversed(), b), math.pi - angle.real, -angle.dual),
        (dual_angle(a, b.reversed()), math.pi - angle.real, -angle.dual),
        (dual_angle(a.reversed(), b.reversed()), angle.real, angle.dual),
    ):
        close(other.real, real)
        close(other.dual, dual, 1e-10)


def test_a_reflection_turns_the_sign_of_the_distance():
    """The sign is a screw sense: b above a, turned anticlockwise, is positive."""
    above = Line.from_point_direction([0, 0, 2], [1, 1, 0])
    below = Line.from_point_direction([0, 0, -2], [1, 1, 0])
    for line, distance in ((above, 2.0), (below, -2.0)):
        close(parts(dual_angle(X_AXIS, line)), [math.pi / 4, distance])


# -- special positions ----------------------------------------------------------------------------

# b, relation to the x-axis, angle, distance, foot on a, foot on b, direction of the perpendicular
SPECIAL = {
    "perpendicular and skew": (
        Line.from_point_direction([3, 5, -2], [0, 1, 0]),
        ("skew", math.pi / 2, -2.0, [3, 0, 0], [3, 0, -2], [0, 0, 1]),
    ),
    "skew at 45°": (
        Line.from_point_direction([1, 0, 4], [1, -1, 0]),
        ("skew", math.pi / 4, -4.0, [1, 0, 0], [1, 0, 4], [0, 0, -1]),
    ),
    "skew at 150°": (
        Line.from_point_direction([1, 0, 4], [-math.sqrt(3), 1, 0]),
        ("skew", math.radians(150), 4.0, [1, 0, 0], [1, 0, 4], [0, 0, 1]),
    ),
    "meeting": (
        Line.through([2, 0, 0], [3, 1, 0]),
        ("meeting", math.pi / 4, 0.0, [2, 0, 0], [2, 0, 0], [0, 0, 1]),
    ),
    "meeting at a right angle": (
        Line.through([-7, 0, 0], [-7, 0, 1]),
        ("meeting", math.pi / 2, 0.0, [-7, 0, 0], [-7, 0, 0], [0, -1, 0]),
    ),
    "parallel": (
        Line.from_point_direction([9, 3, 4], [2, 0, 0]),
        ("parallel", 0.0, 5.0, [0, 0, 0], [0, 3, 4], [0, 0.6, 0.8]),
    ),
    "antiparallel": (
        Line.from_point_direction([9, 3, 4], [-2, 0, 0]),
        ("antiparallel", math.pi, 5.0, [0, 0, 0], [0, 3, 4], [0, 0.6, 0.8]),
    ),
    "equal": (
        Line.through([5, 0, 0], [7, 0, 0]),
        ("equal", 0.0, 0.0, [0, 0, 0], [0, 0, 0], [np.nan] * 3),
    ),
    "opposite": (
        Line.through([7, 0, 0], [5, 0, 0]),
        ("opposite", math.pi, 0.0, [0, 0, 0], [0, 0, 0], [np.nan] * 3),
    ),
}
MOTIONS = {
    "at rest": (np.eye(3), np.zeros(3)),
    "moved": (Rotation.from_rotvec([0.4, -1.1, 2.0]).as_matrix(), np.array([3.0, -1.0, 0.5])),
}


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("name", SPECIAL)
def test_special_position(name, motion):
    b, (kind, angle, distance, foot_a, foot_b, n) = SPECIAL[name]
    rotation, shift = MOTIONS[motion]
    line_a, line_b = (line.transformed(rotation, shift) for line in (X_AXIS, b))
    found = common_perpendicular(line_a, line_b)
    assert found.relation == relation(line_a, line_b) == kind
    assert isinstance(found.relation, str)
    close(parts(dual_angle(line_a, line_b)), [angle, distance])
    close([found.angle, found.distance], [angle, distance])
    close(found.line.direction, rotation @ n)
    if kind in ("skew", "meeting"):  # the feet are unique: they move along
        foot_a, foot_b = (rotation @ foot + shift for foot in (foot_a, foot_b))
    else:  # the one through the point of a nearest the origin
        across = rotation @ (np.array(foot_b) - foot_a)
        foot_a = line_a.foot
        foot_b = foot_a + across
    close(found.foot_a, foot_a)
    close(found.foot_b, foot_b)
    close(found.line.moment, np.cross(foot_a, found.line.direction))


def test_special_positions_as_one_batch():
    b = Line.from_plucker([line.plucker for line, _ in SPECIAL.values()])
    expected = [values for _, values in SPECIAL.values()]
    found = common_perpendicular(X_AXIS, b)
    assert found.relation.tolist() == [values[0] for values in expected]
    assert relation(X_AXIS, b).tolist() == found.relation.tolist()
    for i, got in enumerate(
        (found.angle, found.distance, found.foot_a, found.foot_b, found.line.direction), start=1
    ):
        close(got, [values[i] for values in expected])
    close(parts(dual_angle(X_AXIS, b)), [found.angle, found.distance])


@few
@given(lines, st.floats(-20, 20), st.floats(-20, 20))
def test_equal_and_opposite_lines_however_they_are_given(line, w, r):
    assume(abs(w - r) > 1e-3)
    again = Line.through(line.point(w), line.point(r))
    expected = ("equal", 0.0) if r > w else ("opposite", math.pi)
    assert relation(line, again, parallel=1e-9) == expected[0]
    angle = dual_angle(line, again, parallel=1e-9)
    assert angle.real == expected[1]
    close(angle.dual, 0.0, 1e-9)
    exact = dual_angle(line, line)
    assert (exact.real, exact.dual) == (0.0, 0.0)
    assert dual_angle(line, line.reversed()).real == math.pi
    assert relation(line, line.reversed()) == "opposite"


@few
@given(lines, points)
def test_parallel_lines_have_their_distance_never_negative(line, shift):
    apart = np.linalg.norm(np.cross(shift, line.direction))
    assume(apart > 1e-3)
    for other, kind, angle in (
        (line.transformed(np.eye(3), shift), "parallel", 0.0),
        (line.transformed(np.eye(3), shift).reversed(), "antiparallel", math.pi),
    ):
        assert relation(line, other) == kind
        got = dual_angle(line, other)
        assert got.real == angle
        close(got.dual, apart)
        found = common_perpendicular(line, other)
        close(found.foot_a, line.foot)
        close(other.distance_to(found.foot_b), 0.0)
        close(found.foot_b - found.foot_a, apart * found.line.direction)


@few
@given(points, directions, directions)
def test_meeting_lines_meet_where_they_do(point, first, second):
    a, b = (Line.from_point_direction(point, d) for d in (first, second))
    assume(in_general_position(a, b))
    found = common_perpendicular(a, b)
    assert found.relation == "meeting"
    close(found.distance, 0.0, 1e-10)
    close(found.foot_a, point, 1e-8)
    close(found.foot_b, point, 1e-8)
    close(found.line.distance_to(point), 0.0, 1e-8)


@pytest.mark.parametrize("angle", [1e-3, 1e-6, 1e-9, 1e-11])
@pytest.mark.parametrize("height", [2.5, -0.75])
def test_nearly_parallel_lines_keep_every_digit(angle, height):
    """The arccos of ⟨x, y⟩ = 1 − θ²/2 would give 0 from θ = 1e-8 on."""
    cosine, sine = math.cos(angle), math.sin(angle)
    b = Line([cosine, sine, 0], [-height * sine, height * cosine, 0])
    assert relation(X_AXIS, b) == "skew"
    got = dual_angle(X_AXIS, b)
    assert got.real == pytest.approx(angle, rel=1e-14)
    assert got.dual == pytest.approx(height, rel=1e-14)
    turned = dual_angle(X_AXIS, b.reversed())
    assert math.pi - turned.real == pytest.approx(angle, rel=1e-6, abs=1e-15)
    assert turned.dual == pytest.approx(-height, rel=1e-14)
    found = common_perpendicular(X_AXIS, b)
    close(found.foot_a, [0, 0, 0])
    close(found.foot_b, [0, 0, height])


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("angle", [1e-4, 1e-7, 1e-10])
@pytest.mark.parametrize("seed", range(3))
def test_nearly_parallel_lines_of_any_direction_against_long_arithmetic(seed, angle, side):
    """Angle and distance of the very same floating-point lines, in 60 digits."""
    p, q, d, turn = np.random.default_rng(seed).normal(size=(4, 3))
    a = Line.from_point_direction(p, d)
    b = Line.from_point_direction(q, side * a.direction + angle * turn)
    exact_angle, exact_distance = in_sixty_digits(a, b)
    got = dual_angle(a, b)
    off = got.real if side > 0 else math.pi - got.real
    exact_off = exact_angle if side > 0 else mpmath.pi - exact_angle
    assert off == pytest.approx(float(exact_off), rel=1e-13, abs=0.0 if side > 0 else 1e-15)
    assert got.dual == pytest.approx(float(exact_distance), rel=1e-12, abs=1e-13)


def in_sixty_digits(a, b):
    with mpmath.workdps(60):
        x, xbar, y, ybar = (
            [mpmath.mpf(float(entry)) for entry in part]
            for part in (a.direction, a.moment, b.direction, b.moment)
        )
        n = long_cross(x, y)
        sine, cosine = mpmath.norm(n), mpmath.fdot(x, y)
        p, q = long_cross(x, xbar), long_cross(y, ybar)
        gap = [end - start for start, end in zip(p, q, strict=True)]
        return mpmath.atan2(sine, cosine), mpmath.fdot(gap, n) / sine


def long_cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def test_the_tolerance_for_parallel_is_the_named_one():
    for sine, kind in ((2 * PARALLEL, "skew"), (0.5 * PARALLEL, "parallel")):
        assert relation(X_AXIS, Line([1, sine, 0], [-sine, 1, 0])) == kind
    tilted = Line.through([0, 0, 1], [1, 1e-4, 1])
    assert relation(X_AXIS, tilted) == "skew"
    assert relation(X_AXIS, tilted, parallel=1e-3) == "parallel"
    assert common_perpendicular(X_AXIS, tilted, parallel=1e-3).relation == "parallel"
    assert dual_angle(X_AXIS, tilted, parallel=1e-3).real == 0.0


def test_the_tolerance_for_meeting_grows_with_the_distance_from_the_origin():
    for far, gap, kind in ((0, 1e-10, "meeting"), (0, 1e-8, "skew"), (1e3, 1e-8, "meeting")):
        a = Line.from_point_direction([0, 0, far], [1, 0, 0])
        b = Line.from_point_direction([0, 0, far + gap], [0, 1, 0])
        assert relation(a, b) == kind
    assert relation(X_AXIS, Line.through([0, 0, 0.1], [0, 1, 0.1]), meeting=0.2) == "meeting"


def test_places_without_a_line_are_undefined_and_disturb_nobody():
    nowhere = Line.unchecked([[np.nan] * 3, [0, 1, 0]], [[np.nan] * 3, [0, 0, 0]])
    found = common_perpendicular(X_AXIS, nowhere)
    assert found.relation.tolist() == ["undefined", "meeting"]
    assert np.isnan(found.distance[0])
    assert np.isnan(found.foot_b[0]).all()
    close(found.foot_b[1], [0, 0, 0])
    moved = nowhere.transformed(np.eye(3), [0, 0, 1])
    assert np.isnan(moved.direction[0]).all()
    close(moved.foot[1], [0, 0, 1])


def test_batches_broadcast_against_each_other():
    rng = np.random.default_rng(11)
    a = Line.from_point_direction(*rng.normal(size=(2, 4, 1, 3)))
    b = Line.from_point_direction(*rng.normal(size=(2, 5, 3)))
    found = common_perpendicular(a, b)
    assert found.relation.shape == found.angle.shape == found.line.shape == (4, 5)
    alone = common_perpendicular(a[2, 0], b[3])
    same_line(found.line[2, 3], alone.line)
    close(found.foot_b[2, 3], alone.foot_b)
    close(found.distance[2, 3], alone.distance)
    assert dual_angle(a, b).dual.shape == (4, 5)
