"""Bézier curves, how they close, and how they are edited.

Second routes: exact rational de Casteljau, SciPy's BPoly, SymPy, and brute force over all subsets
of points for the fewest-moved closing.
"""

from __future__ import annotations

import copy
import itertools
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import BPoly

from ruledlab.geometry import curve as module
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier, close, drag, insert, least_degree, remove, seam
from ruledlab.geometry.series import Series

EPS = np.finfo(float).eps
TURN = 2 * math.pi
DEGREES = (1, 2, 3, 7, 30, 60)
EXAMPLE_2 = np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]]) * math.pi / 8

laws = settings(max_examples=40)
coordinates = st.floats(-10, 10, allow_subnormal=False)
unit = st.floats(0, 1, allow_subnormal=False)


def polygons(least: int = 1, most: int = 12) -> st.SearchStrategy[np.ndarray]:
    return st.integers(least, most).flatmap(
        lambda n: arrays(float, (n + 1, 2), elements=coordinates)
    )


def grid_polygons(least: int, most: int) -> st.SearchStrategy[np.ndarray]:
    """Polygons whose gaps are either nothing or something, never within a tolerance."""
    steps = st.integers(-8000, 8000).map(lambda i: i / 1000)
    return st.integers(least, most).flatmap(lambda n: arrays(float, (n + 1, 2), elements=steps))


def random_points(degree: int, *batch: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng([seed, degree]).uniform(-3, 3, (*batch, degree + 1, 2))


# -- second routes -------------------------------------------------------------------------------


def exact(points: np.ndarray, t: float, k: int = 0) -> list[Fraction]:
    """b⁽ᵏ⁾(t) without rounding: k exact hodographs, then de Casteljau in rational numbers."""
    rows = [[Fraction(x) for x in row] for row in points.tolist()]
    for _ in range(k):
        n = len(rows) - 1
        rows = [
            [n * (b - a) for a, b in zip(*pair, strict=True)] for pair in itertools.pairwise(rows)
        ]
    s = Fraction(float(t))
    while len(rows) > 1:
        rows = [
            [(1 - s) * a + s * b for a, b in zip(*pair, strict=True)]
            for pair in itertools.pairwise(rows)
        ]
    return rows[0]


def error(got: np.ndarray, points: np.ndarray, t: float, k: int = 0) -> float:
    return max(
        abs(float(Fraction(float(a)) - b)) for a, b in zip(got, exact(points, t, k), strict=True)
    )


def leg_size(points: np.ndarray, k: int) -> float:
    """Size of the control polygon of the k-th derivative."""
    return math.perm(len(points) - 1, k) * np.abs(np.diff(points, n=k, axis=0)).max()


def bpoly(points: np.ndarray) -> BPoly:
    return BPoly(points[:, np.newaxis, :], [0, 1])


def jump_matrix(degree: int, order: int) -> np.ndarray:
    """b⁽ᵏ⁾(1) − b⁽ᵏ⁾(0), k = 0 … order, as linear functions of the control points, from SciPy."""
    basis = BPoly(np.eye(degree + 1)[:, np.newaxis, :], [0, 1])
    rows = [basis]
    for _ in range(order):
        rows.append(rows[-1].derivative())
    return np.array([row(1.0) - row(0.0) for row in rows])


def closes(points: np.ndarray, order: int, winding: int = 0) -> bool:
    jumps = jump_matrix(len(points) - 1, order) @ points
    jumps[0, 0] -= TURN * winding
    return bool(np.abs(jumps).max() < 1e-8 * max(1.0, np.abs(points).max()) * len(points) ** 2)


def closed_points(degree: int, order: int, seed: int = 0, winding: int = 0) -> np.ndarray:
    """Write a random closed polygon down from the conditions, without `close`."""
    p = random_points(degree, seed=seed)
    turn = np.array([TURN * winding, 0.0])
    p[-1] = p[0] + turn
    if order >= 1:
        p[-2] = p[-1] - (p[1] - p[0])
    if order >= 2:
        p[-3] = (p[2] - 2 * p[1] + p[0]) - p[-1] + 2 * p[-2]
    return p


# -- values and derivatives ----------------------------------------------------------------------


@pytest.mark.parametrize("degree", DEGREES)
def test_values_agree_with_exact_arithmetic(degree: int) -> None:
    points = random_points(degree)
    curve = Bezier(points)
    size = np.abs(points).max()
    for t in (1e-12, 1e-3, 0.1, 1 / 3, 0.5, 0.7, 0.999, 1 - 1e-12):
        assert error(curve(t), points, t) <= 4 * degree * EPS * size


@pytest.mark.parametrize("degree", DEGREES)
@pytest.mark.parametrize("k", [1, 2, 3, 4])
def test_derivatives_agree_with_the_exact_hodograph(degree: int, k: int) -> None:
    points = random_points(degree, seed=k)
    curve = Bezier(points)
    if k > degree:
        assert (curve.derivative([0.0, 0.3, 1.0], k) == 0).all()
        return
    for t in (0.0, 1e-9, 0.2, 0.5, 0.93, 1.0):
        assert error(curve.derivative(t, k), points, t, k) <= 1e-13 * leg_size(points, k)


def test_derivatives_of_a_small_curve_far_from_the_origin_keep_their_digits() -> None:
    # Taking differences first loses nothing; differences of the basis would lose six digits here.
    points = 1000.0 + 1e-3 * random_points(6)
    curve = Bezier(points)
    for t in (0.0, 0.37, 1.0):
        for k in (1, 2):
            assert error(curve.derivative(t, k), points, t, k) <= 1e-14 * leg_size(points, k)


@pytest.mark.parametrize("t", [-3.0, -0.25, 1.5, 40.0])
def test_any_real_t_is_accepted(t: float) -> None:
    points = random_points(6)
    terms = [math.comb(6, i) * t**i * (1 - t) ** (6 - i) for i in range(7)]
    bound = np.abs(terms) @ np.abs(points).max(axis=1)
    assert error(Bezier(points)(t), points, t) <= 50 * EPS * bound


def test_sympy_differentiates_to_the_same() -> None:
    points = [[1, 2], [-3, 5], [4, 0], [2, -7], [6, 1]]
    x = sympy.Symbol("x")
    n = len(points) - 1
    curve = Bezier(points)
    for axis in (0, 1):
        b = sum(
            sympy.binomial(n, i) * (1 - x) ** (n - i) * x**i * points[i][axis] for i in range(n + 1)
        )
        for k in range(7):
            for t in (sympy.Rational(-1, 2), sympy.Rational(3, 8), sympy.Integer(1)):
                want = float(sympy.diff(b, x, k).subs(x, t))
                assert curve.derivative(float(t), k)[axis] == pytest.approx(
                    want, rel=1e-13, abs=1e-12
                )


@laws
@given(polygons(), arrays(float, 5, elements=unit), st.integers(0, 4))
def test_scipy_agrees(points: np.ndarray, t: np.ndarray, k: int) -> None:
    want = bpoly(points)
    for _ in range(k):
        want = want.derivative()
    scale = (2.0 * (len(points) - 1)) ** k * max(1.0, np.abs(points).max())
    np.testing.assert_allclose(Bezier(points).derivative(t, k), want(t), rtol=0, atol=1e-13 * scale)


@laws
@given(polygons(), st.integers(0, 6))
def test_series_is_the_derivatives_over_factorials(points: np.ndarray, order: int) -> None:
    t = np.linspace(-0.2, 1.2, 6).reshape(2, 3)
    curve = Bezier(points)
    series = curve.series(t, order)
    assert isinstance(series, Series)
    assert series.shape == (2, 2, 3)
    assert series.order == order
    for k in range(order + 1):
        want = np.moveaxis(curve.derivative(t, k), -1, 0)
        np.testing.assert_allclose(
            math.factorial(k) * series.coefficients[k], want, rtol=1e-12, atol=1e-9
        )


def test_series_predicts_the_curve_nearby() -> None:
    curve = Bezier(random_points(5))
    coefficients = curve.series(0.3, 5).coefficients
    h = 0.4
    np.testing.assert_allclose(
        sum(c * h**k for k, c in enumerate(coefficients)), curve(0.7), rtol=0, atol=1e-12
    )


# -- ends, hull, shapes --------------------------------------------------------------------------


@laws
@given(polygons(1, 60))
def test_ends_are_met_to_the_last_bit(points: np.ndarray) -> None:
    curve = Bezier(points)
    n = curve.degree
    ends = curve([0.0, 1.0])
    assert (ends == points[[0, -1]]).all()
    slopes = n * np.array([points[1] - points[0], points[-1] - points[-2]])
    assert (curve.derivative([0.0, 1.0]) == slopes).all()


@pytest.mark.parametrize("samples", [2, 400, 3 * module.BLOCK + 5])
def test_a_joined_curve_ends_where_it_began_bitwise(samples: int) -> None:
    t = np.linspace(0, 1, samples)
    series = Bezier(EXAMPLE_2).series(t, 1).coefficients
    assert (series[..., 0] == series[..., -1]).all()


@laws
@given(polygons(), arrays(float, 7, elements=unit), st.floats(0, TURN))
def test_the_curve_stays_in_the_convex_hull(
    points: np.ndarray, t: np.ndarray, angle: float
) -> None:
    direction = np.array([math.cos(angle), math.sin(angle)])
    heights, slack = points @ direction, 1e-13 * np.abs(points).max()
    along = Bezier(points)(t) @ direction
    assert (along <= heights.max() + slack).all()
    assert (along >= heights.min() - slack).all()


def test_large_arrays_are_cut_into_blocks_unnoticed() -> None:
    t = np.random.default_rng(1).uniform(0, 1, (3, module.BLOCK))
    curve = Bezier(random_points(5, 2))
    whole = curve.series(t, 2).coefficients
    parts = [curve.series(row, 2).coefficients for row in t]
    np.testing.assert_allclose(whole, np.stack(parts, axis=-2), rtol=1e-13, atol=1e-12)


@pytest.mark.parametrize("shape", [(), (1,), (4,), (2, 3), (0,), (3, 0)])
@pytest.mark.parametrize("batch", [(), (2,), (3, 2)])
def test_shapes(shape: tuple[int, ...], batch: tuple[int, ...]) -> None:
    curve = Bezier(random_points(4, *batch))
    t = np.full(shape, 0.25)
    assert curve.batch_shape == batch
    assert curve(t).shape == (*batch, *shape, 2)
    assert curve.derivative(t, 1).shape == (*batch, *shape, 2)
    assert curve.derivative(t, 5).shape == (*batch, *shape, 2)
    for order in (0, 2, 6):
        assert curve.series(t, order).coefficients.shape == (order + 1, 2, *batch, *shape)
    assert np.shape(curve.scale) == batch


@pytest.mark.parametrize("degree", [1, 6, 33])
def test_a_batch_is_a_loop(degree: int) -> None:
    points = random_points(degree, 2, 3)
    t = np.linspace(0, 1, 11)
    curve = Bezier(points)
    left, right = curve.split(0.3)
    for i in np.ndindex(2, 3):
        alone = Bezier(points[i])
        size = leg_size(points[i], 0)
        np.testing.assert_allclose(curve(t)[i], alone(t), rtol=0, atol=1e-14 * size)
        np.testing.assert_allclose(
            curve.series(t, 3).coefficients[(slice(None), slice(None), *i)],
            alone.series(t, 3).coefficients,
            rtol=0,
            atol=1e-14 * size * (2 * degree) ** 3,
        )
        assert curve.scale[i] == alone.scale
        assert (left.points[i] == alone.split(0.3)[0].points).all()
        assert (right.points[i] == alone.split(0.3)[1].points).all()
        np.testing.assert_allclose(curve.raised(3).points[i], alone.raised(3).points, rtol=1e-13)


def test_scale_bounds_the_speed() -> None:
    curve = Bezier(random_points(9))
    speed = np.linalg.norm(curve.derivative(np.linspace(0, 1, 200)), axis=-1)
    assert speed.max() <= curve.scale
    assert Bezier([[0, 0], [3, 4]]).scale == 5.0


# -- laws of change ------------------------------------------------------------------------------


@laws
@given(
    polygons(), arrays(float, (2, 2), elements=coordinates), arrays(float, 2, elements=coordinates)
)
def test_affine_invariance(points: np.ndarray, matrix: np.ndarray, shift: np.ndarray) -> None:
    t = np.linspace(0, 1, 9)
    size = 20 * np.abs(matrix).max() + 10
    np.testing.assert_allclose(
        Bezier(points @ matrix + shift)(t),
        Bezier(points)(t) @ matrix + shift,
        rtol=0,
        atol=1e-13 * size,
    )


@laws
@given(polygons(), st.integers(0, 40))
def test_raising_the_degree_changes_nothing_but_the_degree(points: np.ndarray, times: int) -> None:
    curve = Bezier(points)
    raised = curve.raised(times)
    t = np.linspace(0, 1, 9)
    assert raised.degree == curve.degree + times
    np.testing.assert_allclose(raised(t), curve(t), rtol=0, atol=1e-13 * np.abs(points).max())
    assert (raised.points[[0, -1]] == points[[0, -1]]).all()


def test_raising_step_by_step_is_raising_at_once() -> None:
    curve = Bezier(random_points(5))
    slowly = curve
    for _ in range(4):
        slowly = slowly.raised()
    np.testing.assert_allclose(slowly.points, curve.raised(4).points, rtol=0, atol=1e-14)


@laws
@given(polygons(), st.floats(0.001, 0.999), unit)
def test_splitting_changes_nothing_but_the_parameter(
    points: np.ndarray, t: float, s: float
) -> None:
    curve = Bezier(points)
    left, right = curve.split(t)
    slack = 2e-14 * (1 + np.abs(points).max()) * len(points)
    np.testing.assert_allclose(left(s), curve(s * t), rtol=0, atol=slack)
    np.testing.assert_allclose(right(s), curve(t + (1 - t) * s), rtol=0, atol=slack)
    assert (left.points[-1] == right.points[0]).all()
    assert (left.points[0] == points[0]).all()
    assert (right.points[-1] == points[-1]).all()


@laws
@given(polygons())
def test_reversal(points: np.ndarray) -> None:
    t = np.linspace(0, 1, 9)
    curve = Bezier(points)
    back = curve.reversed()
    size = 1e-14 * len(points) ** 2 * (1 + np.abs(points).max())
    np.testing.assert_allclose(back(t), curve(1 - t), rtol=0, atol=size)
    np.testing.assert_allclose(back.derivative(t), -curve.derivative(1 - t), rtol=0, atol=10 * size)
    assert (back.reversed().points == points).all()


# -- what comes in and what comes out ------------------------------------------------------------


@pytest.mark.parametrize(
    ("points", "text"),
    [
        (np.zeros(7), "shape (n+1, 2)"),
        ([[0.0, 1.0]], "shape (n+1, 2)"),
        (np.zeros((4, 3)), "shape (n+1, 2)"),
        (3.0, "shape (n+1, 2)"),
        ([], "shape (n+1, 2)"),
        (np.zeros((62, 2)), "degree ≤ 60"),
        ([[0, 1], [math.nan, 0]], "finite"),
        ([[0, 1], [math.inf, 0]], "finite"),
        ([["0", "1"], ["2", "3"]], "real numbers"),
        ([[0, 1], [2, 1j]], "real numbers"),
        ([[0, 1], [2]], "real numbers"),
        (None, "real numbers"),
        ([[0, 1], [1e200, 0]], "at most"),
    ],
)
def test_points_that_are_refused(points: object, text: str) -> None:
    with pytest.raises(GeometryError, match=r"^`points`") as caught:
        Bezier(points)
    assert text in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("t", ["0.5", None, 1j, [[0, 1], [2]], [object()]])
def test_t_that_is_refused(t: object) -> None:
    with pytest.raises(GeometryError, match=r"^`t`"):
        Bezier(EXAMPLE_2)(t)


@pytest.mark.parametrize("bad", [-1, 1.0, True, "1", None])
def test_orders_that_are_refused(bad: object) -> None:
    curve = Bezier(EXAMPLE_2)
    for call in (curve.derivative, curve.series):
        with pytest.raises(GeometryError, match=r"^`(k|order)`"):
            call(0.5, bad)


@pytest.mark.parametrize("t", [0.0, 1.0, -0.5, 2.0, math.nan, "a", [0.5]])
def test_places_that_cannot_be_cut(t: object) -> None:
    with pytest.raises(GeometryError, match=r"^`t`"):
        Bezier(EXAMPLE_2).split(t)


def test_raising_beyond_the_limit_is_refused() -> None:
    assert Bezier(random_points(59)).raised().degree == 60
    with pytest.raises(GeometryError, match=r"^`times`"):
        Bezier(random_points(59)).raised(2)


def test_overflow_and_nan_are_silent_and_stay_where_they_are() -> None:
    curve = Bezier(random_points(60))
    values = curve([0.5, math.nan, 1e300, -math.inf, 1.0])
    assert not np.isfinite(values[1:4]).any()
    np.testing.assert_allclose(values[[0, 4]], curve([0.5, 1.0]), rtol=1e-14)
    with np.errstate(all="raise"):
        assert np.isfinite(curve.series([1e-300, 1e-7, 1 - 1e-16], 2).coefficients).all()


def test_values_are_frozen() -> None:
    points = random_points(3)
    curve = Bezier(points)
    points[0] = 99.0
    assert curve.points[0, 0] != 99.0
    with pytest.raises(ValueError, match="read-only"):
        curve.points[0, 0] = 1.0
    with pytest.raises(AttributeError):
        curve.points = points
    assert curve.domain == (0.0, 1.0)
    assert repr(Bezier(random_points(3, 2))) == "Bezier(degree=3, batch_shape=(2,))"


@pytest.mark.parametrize(
    "twin", [copy.copy, copy.deepcopy, lambda c: pickle.loads(pickle.dumps(c))]
)
def test_copies_are_frozen_too(twin: object) -> None:
    curve = Bezier(random_points(3))
    other = twin(curve)
    assert (other(0.3) == curve(0.3)).all()
    assert not other.points.flags.writeable


def test_integers_lists_and_single_precision_come_in() -> None:
    assert (Bezier([[0, 0], [2, 4]])(0.5) == [1, 2]).all()
    assert Bezier(np.ones((3, 2), np.float32)).points.dtype == np.float64
    assert Bezier([[0, 0], [2, 4]])(np.float32(0.5)).dtype == np.float64


# -- the seam ------------------------------------------------------------------------------------


def test_example_2_closes_once_differentiably_but_not_twice() -> None:
    report = seam(Bezier(EXAMPLE_2))
    assert (report.order, report.g1, report.winding) == (1, False, 0)
    np.testing.assert_allclose(report.gaps[:2], 0, atol=1e-14)
    # Second differences at the two ends: (2, 1) − (2, −1) eighths of π, times n(n−1) = 30.
    np.testing.assert_allclose(report.gaps[2], [0, 30 * 2 * math.pi / 8], atol=1e-13)
    assert "C¹" in report.reason


@pytest.mark.parametrize("degree", [6, 9, 20])
@pytest.mark.parametrize("order", [-1, 0, 1, 2])
@pytest.mark.parametrize("winding", [0, 1, -2])
def test_every_order_is_recognised(degree: int, order: int, winding: int) -> None:
    points = closed_points(degree, order, winding=winding)
    if order == -1:
        points[-1] += 0.01
    report = seam(points)
    assert (report.order, report.winding) == (order, winding)
    assert not report.gaps.flags.writeable


@laws
@given(polygons(1, 10))
def test_gaps_are_the_jumps_of_the_derivatives(points: np.ndarray) -> None:
    report, curve = seam(points), Bezier(points)
    for k in range(3):
        want = curve.derivative(1.0, k) - curve.derivative(0.0, k)
        if k == 0:
            want = want - [TURN * report.winding, 0]
        np.testing.assert_allclose(report.gaps[k], want, rtol=0, atol=1e-10)


def test_collinear_tangents_are_only_g1() -> None:
    points = closed_points(6, 1)
    points[-2] = points[-1] - 1.7 * (points[1] - points[0])
    report = seam(points)
    assert (report.order, report.g1) == (0, True)
    assert "G¹" in report.reason
    curve = Bezier(points)
    first, last = curve.derivative(0.0), curve.derivative(1.0)
    assert np.cross([*first, 0], [*last, 0])[2] == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose(last, 1.7 * first)


def test_collinear_but_opposite_tangents_are_a_cusp() -> None:
    points = closed_points(6, 1)
    points[-2] = points[-1] + 0.8 * (points[1] - points[0])
    report = seam(points)
    assert (report.order, report.g1) == (0, False)
    assert "turns back" in report.reason


def test_a_corner_is_neither() -> None:
    report = seam(closed_points(6, 0))
    assert (report.order, report.g1) == (0, False)
    assert "corner" in report.reason


def test_a_leg_of_length_zero_has_no_tangent() -> None:
    points = closed_points(6, 1)
    points[1] = points[0]
    report = seam(points)
    assert (report.order, report.g1) == (0, False)
    assert "stops" in report.reason


def test_all_points_equal_is_a_closed_point() -> None:
    report = seam(np.full((5, 2), 0.3))
    assert report.order == 2
    assert "single point" in report.reason


def test_a_parallel_of_degree_one_closes_with_every_order() -> None:
    report = seam([[0.4, 1.0], [0.4 + TURN, 1.0]])
    assert (report.order, report.winding) == (2, 1)
    assert seam([[0.4, 1.0], [0.4 - 2 * TURN, 1.0]]).winding == -2


def test_an_open_segment() -> None:
    report = seam([[0.0, 1.0], [1.0, 1.5]])
    assert (report.order, report.g1, report.winding) == (-1, False, 0)
    np.testing.assert_allclose(report.gaps[0], [1.0, 0.5])
    assert "0.5 rad in v" in report.reason


def test_degree_two_there_and_back_turns_back() -> None:
    report = seam([[0.0, 1.0], [1.0, 1.0], [0.0, 1.0]])
    assert (report.order, report.g1) == (0, False)
    assert "turns back" in report.reason


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_the_tolerance_is_relative_to_the_polygon(size: float) -> None:
    points = size * closed_points(8, 2)
    points[-1, 0] = points[0, 0]  # at 1e6 rad whole turns must not hide the gap
    bad, good = points.copy(), points.copy()
    bad[-1, 1] += 1e-7 * size
    good[-1, 1] += 1e-11 * size
    assert seam(bad).order == -1
    assert seam(good).order == 2


def test_rounding_of_a_tiny_polygon_far_away_is_not_a_gap() -> None:
    for seed in range(5):
        assert seam(3.0 + 1e-10 * closed_points(6, 2, seed)).order == 2


@pytest.mark.parametrize("call", [seam, lambda p: close(p, 0)])
def test_batches_are_asked_one_by_one(call: object) -> None:
    with pytest.raises(GeometryError, match="one by one"):
        call(random_points(6, 2))


# -- closing -------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("degree", range(1, 9))
def test_least_degree_by_counting_dimensions(degree: int, order: int) -> None:
    # Closed polynomials: constants and at least two more, or the curve lies on a line.
    free = degree + 1 - np.linalg.matrix_rank(jump_matrix(degree, order))
    assert (free >= 3) == (degree >= least_degree(order))


def test_a_cubic_closed_with_equal_spacing_runs_to_and_fro_on_a_segment() -> None:
    points = np.array([[0, 1], [1, 3], [-1, -1], [0, 1.0]])
    assert seam(points).order == 1
    where = Bezier(points)(np.linspace(0, 1, 20)) - points[0]
    np.testing.assert_allclose(where[:, 1], 2 * where[:, 0], atol=1e-14)


@pytest.mark.parametrize(("order", "degree"), [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4)])
def test_too_low_a_degree_is_refused_with_the_remedy(order: int, degree: int) -> None:
    with pytest.raises(GeometryError, match=r"^`points`.*raise the degree first") as caught:
        close(random_points(degree) / 3, order)
    assert "\n" not in str(caught.value)
    raised = Bezier(random_points(degree) / 3).raised(least_degree(order) - degree).points
    assert seam(close(raised, order)).order >= order


def fewest_moves(points: np.ndarray, order: int, kept: set[int]) -> tuple[int, float] | None:
    """Brute force over all subsets of all points: how many must move, and how far at least."""
    turns = round((points[-1, 0] - points[0, 0]) / TURN)
    matrix = jump_matrix(len(points) - 1, order)
    wanted = -matrix @ points
    wanted[0, 0] += TURN * turns
    free = [i for i in range(len(points)) if i not in kept]
    for size in range(1, len(free) + 1):
        costs = []
        for subset in itertools.combinations(free, size):
            block = matrix[:, subset]
            moves = np.linalg.pinv(block) @ wanted
            if np.allclose(block @ moves, wanted, rtol=0, atol=1e-8):
                costs.append(np.linalg.norm(moves))
        if costs:
            return size, min(costs)
    return None


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("start", [-1, 0, 1])
@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("kept", [set(), {1}, {0}, {2, 6}, {0, 1, 2}])
def test_the_fewest_points_move_and_least(
    start: int, order: int, kept: set[int], seed: int
) -> None:
    points = closed_points(6, start, seed) if start >= 0 else random_points(6, seed=seed)
    if start >= order:
        assert (close(points, order, kept) == points).all()
        return
    expected = fewest_moves(points, order, kept)
    assert expected is not None
    new = close(points, order, kept)
    moved = np.flatnonzero((new != points).any(axis=1))
    assert len(moved) == expected[0]
    assert np.linalg.norm(new - points) == pytest.approx(expected[1], rel=1e-9)
    assert not kept & set(moved.tolist())
    assert closes(new, order, seam(points).winding)


@settings(max_examples=150)
@given(
    grid_polygons(5, 10),
    st.integers(0, 2),
    st.sets(st.sampled_from([0, 1, 2, -1, -2, -3]), max_size=4),
)
def test_closing_closes_or_says_why(points: np.ndarray, order: int, ends: set[int]) -> None:
    n = len(points) - 1
    kept = {i % (n + 1) for i in ends}
    turns = seam(points).winding
    assume(turns == 0 or n > 5)
    try:
        new = close(points, order, kept)
    except GeometryError as refusal:
        assert str(refusal).startswith("`keep`")
        assert fewest_moves(points, order, kept) is None
        return
    assert seam(new).order >= order
    assert seam(new).winding == turns
    assert (new[sorted(kept)] == points[sorted(kept)]).all()


@pytest.mark.parametrize("order", [0, 1, 2])
def test_what_closes_already_comes_back_bit_by_bit(order: int) -> None:
    points = closed_points(8, order) + 1e-13
    new = close(points, order)
    assert new is not points
    assert new.tobytes() == points.tobytes()
    assert close(points, -1).tobytes() == points.tobytes()


def test_among_equals_the_later_end_moves() -> None:
    new = close(random_points(5) / 2, 0)
    moved = np.flatnonzero((new != random_points(5) / 2).any(axis=1))
    assert moved.tolist() == [5]
    assert (new[0] == new[-1]).all()


@pytest.mark.parametrize("order", [0, 1, 2])
def test_the_ends_of_a_closed_polygon_are_equal_bitwise(order: int) -> None:
    for seed in range(20):
        points = random_points(6, seed=seed)
        points[-1] = points[0] + [0.1, 0.7]
        new = close(points, order)
        assert (new[0] == new[-1]).all()
        assert (Bezier(new)(0.0) == Bezier(new)(1.0)).all()


def test_closing_twice_is_closing_once() -> None:
    once = close(random_points(7), 2)
    assert (close(once, 2) == once).all()


def test_keep_that_forbids_closing_is_named() -> None:
    points = closed_points(8, 0)
    with pytest.raises(GeometryError, match=r"^`keep` .*got \[0, 1, 7, 8\]") as caught:
        close(points, 1, keep=(0, 1, 7, 8))
    assert "[0, 1, 7, 8]" in str(caught.value).split("release")[1]
    with pytest.raises(GeometryError, match=r"^`keep`"):
        close(random_points(5) / 3, 0, keep=(0, 5))


@pytest.mark.parametrize("bad", [(7,), (-1,), (1.0,), ("a",), (True,)])
def test_keep_takes_indices_only(bad: tuple[object, ...]) -> None:
    with pytest.raises(GeometryError, match=r"^`keep`"):
        close(EXAMPLE_2, 2, keep=bad)


@pytest.mark.parametrize("bad", [3, -2, 1.0, "C1"])
def test_closing_orders_that_do_not_exist(bad: object) -> None:
    with pytest.raises(GeometryError, match=r"^`order`"):
        close(EXAMPLE_2, bad)


@pytest.mark.parametrize("degree", [1, 2, 3, 6])
@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_curve_round_the_sphere_stays_one(degree: int, order: int) -> None:
    points = np.linspace([0.1, 1.0], [TURN - 0.3, 1.4], degree + 1)
    new = close(points, order)
    assert seam(new).order >= order
    assert seam(new).winding == 1


# -- dragging ------------------------------------------------------------------------------------


@pytest.mark.parametrize("index", range(9))
@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("winding", [0, 1])
def test_dragging_keeps_the_closing(index: int, order: int, winding: int) -> None:
    points = closed_points(8, order, winding=winding)
    to = points[index] + [0.31, -0.17]
    new = drag(points, index, to, order)
    assert (new[index] == to).all()
    assert closes(new, order, winding)
    assert (seam(new).order, seam(new).winding) == (order, winding)


@pytest.mark.parametrize(
    ("order", "group"), [(0, [0, 8]), (1, [0, 1, 7, 8]), (2, [0, 1, 2, 6, 7, 8])]
)
@pytest.mark.parametrize("joint", [0, 8])
@pytest.mark.parametrize("winding", [0, 1])
def test_the_joint_carries_its_neighbours_rigidly(
    order: int, group: list[int], joint: int, winding: int
) -> None:
    points = closed_points(8, order, winding=winding)
    move = np.array([0.5, -0.25])
    new = drag(points, joint, points[joint] + move, order)
    np.testing.assert_allclose((new - points)[group], np.tile(move, (len(group), 1)), atol=1e-14)
    others = np.setdiff1d(np.arange(9), group)
    assert (new[others] == points[others]).all()
    assert winding or (new[0] == new[-1]).all()


def test_the_dragged_joint_stays_one_point_bitwise() -> None:
    for seed in range(20):
        points = closed_points(8, 2, seed)
        for joint in (0, 8):
            new = drag(points, joint, [1 / 3, 1 / 700], 2)
            assert (new[[0, -1]] == [1 / 3, 1 / 700]).all()


@pytest.mark.parametrize(
    ("order", "index", "follower"), [(1, 1, 7), (1, 7, 1), (2, 2, 6), (2, 6, 2)]
)
def test_a_tied_point_moves_its_mirror_image(order: int, index: int, follower: int) -> None:
    points = closed_points(8, order)
    move = np.array([0.2, 0.1])
    new = drag(points, index, points[index] + move, order)
    assert set(np.flatnonzero((new != points).any(axis=1))) == {index, follower}
    sign = -1 if order == 1 else 1
    np.testing.assert_allclose(new[follower] - points[follower], sign * move, atol=1e-14)


def test_a_free_point_moves_alone() -> None:
    points = closed_points(8, 2)
    new = drag(points, 4, [1.0, 2.0], 2)
    assert np.flatnonzero((new != points).any(axis=1)).tolist() == [4]


@pytest.mark.parametrize("order", [None, -1])
def test_an_open_curve_moves_one_point_only(order: int | None) -> None:
    points = closed_points(6, 1)
    new = drag(points, 0, [9.0, 9.0], order)
    assert np.flatnonzero((new != points).any(axis=1)).tolist() == [0]


def test_dragging_may_also_establish_the_closing() -> None:
    points = random_points(7) / 3
    new = drag(points, 0, [0.1, 0.2], 2)
    assert (new[0] == [0.1, 0.2]).all()
    assert seam(new).order == 2


def test_a_long_drag_does_not_drift() -> None:
    points = start = closed_points(8, 2)
    for step in range(300):
        points = drag(points, 1, start[1] + [math.sin(step), math.cos(step)], 2)
    points = drag(points, 1, start[1], 2)
    np.testing.assert_allclose(points, start, atol=1e-12)


@pytest.mark.parametrize("bad", [9, -1, 1.5])
def test_dragging_a_point_that_is_not_there(bad: object) -> None:
    with pytest.raises(GeometryError, match=r"^`index`"):
        drag(EXAMPLE_2, bad, [0, 0], 1)


@pytest.mark.parametrize("to", [[0, math.nan], [1, 2, 3], 1.0, "ab"])
def test_dragging_to_nowhere(to: object) -> None:
    with pytest.raises(GeometryError, match=r"^`to`"):
        drag(EXAMPLE_2, 1, to, 1)


# -- more and fewer points -----------------------------------------------------------------------


@pytest.mark.parametrize("leg", range(6))
@pytest.mark.parametrize("order", [None, 0, 1, 2])
def test_inserting(leg: int, order: int | None) -> None:
    points = closed_points(6, 2 if order is None else order)
    new = insert(points, leg, [0.4, 0.6], order)
    assert len(new) == 8
    assert (new[leg + 1] == [0.4, 0.6]).all()
    if order is None:
        assert (np.delete(new, leg + 1, axis=0) == points).all()
    else:
        assert seam(new).order >= order


@pytest.mark.parametrize("index", range(8))
@pytest.mark.parametrize("order", [None, 0, 1, 2])
def test_removing(index: int, order: int | None) -> None:
    points = closed_points(7, 2 if order is None else order)
    new = remove(points, index, order)
    assert len(new) == 7
    if order is None:
        assert (new == np.delete(points, index, axis=0)).all()
    else:
        assert seam(new).order >= order


@pytest.mark.parametrize("joint", [0, 7])
@pytest.mark.parametrize("winding", [0, 1])
@pytest.mark.parametrize("order", [0, 1])
def test_removing_the_joint_makes_the_next_point_the_joint(
    joint: int, winding: int, order: int
) -> None:
    for seed in range(5):
        points = closed_points(7, order, seed, winding)
        new = remove(points, joint, order)
        assert (new[0] == points[1]).all()
        assert (new[-1] == points[1] + [TURN * winding, 0]).all()
        unmoved = (new[:-1] == points[1:-1]).all(axis=1)
        assert np.count_nonzero(~unmoved) == order


def test_removing_what_was_inserted_gives_the_polygon_back() -> None:
    points = closed_points(7, 1)
    assert (remove(insert(points, 3, [1.0, 1.0], 1), 4, 1) == points).all()


def test_limits_of_inserting_and_removing() -> None:
    with pytest.raises(GeometryError, match="degree ≤ 60"):
        insert(random_points(60), 3, [0, 0])
    with pytest.raises(GeometryError, match="at least 2 points"):
        remove([[0, 0], [1, 1]], 0)
    with pytest.raises(GeometryError, match=r"^`leg`"):
        insert(EXAMPLE_2, 6, [0, 0])
    with pytest.raises(GeometryError, match=r"^`index`"):
        remove(EXAMPLE_2, 7)
    with pytest.raises(GeometryError, match=r"^`at`"):
        insert(EXAMPLE_2, 0, [0, math.inf])
    with pytest.raises(GeometryError, match="raise the degree first"):
        remove(closed_points(4, 1), 1, 1)
