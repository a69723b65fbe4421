"""B-splines in the chart, against Bézier curves, hand-made bases and what splines are known for."""

from __future__ import annotations

import copy

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ruledlab import Bezier, BSpline, GeometryError, RuledSurface

T = np.linspace(0.0, 1.0, 41)
RNG = np.random.default_rng(7)


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_as_many_points_as_one_piece_needs_make_a_bezier_curve(degree: int) -> None:
    points = RNG.normal(size=(degree + 1, 2))
    spline, bezier = BSpline(points, degree), Bezier(points)
    for k in range(degree + 1):
        np.testing.assert_allclose(spline.derivative(T, k), bezier.derivative(T, k), atol=1e-11)


def test_a_closed_quadratic_against_its_uniform_basis() -> None:
    points = RNG.normal(size=(5, 2))
    s = np.linspace(0.0, 1.0, 9)
    basis = np.stack([(1 - s) ** 2 / 2, 0.5 + s - s * s, s * s / 2], axis=-1)
    spline = BSpline(points, 2, closed=True)
    for span in range(5):
        expected = basis @ points[(span + np.arange(3)) % 5]
        np.testing.assert_allclose(spline((span + s) / 5), expected, atol=1e-13)


@given(degree=st.integers(1, 5), count=st.integers(3, 9), seed=st.integers(0, 99))
def test_a_closed_seam_is_as_smooth_as_promised(degree: int, count: int, seed: int) -> None:
    spline = BSpline(np.random.default_rng(seed).normal(size=(count, 2)), degree, closed=True)
    for k in range(degree):
        size = 1.0 + np.abs(spline.derivative(T, k)).max()
        gap = spline.derivative(1.0, k) - spline.derivative(0.0, k)
        np.testing.assert_allclose(gap / size, 0.0, atol=1e-10)


def test_one_point_moves_only_its_own_spans() -> None:
    points = RNG.normal(size=(12, 2))
    moved = points.copy()
    moved[6] += 0.3
    changed = np.abs(BSpline(points)(T) - BSpline(moved)(T)).max(axis=1) > 0
    inner = (T > 3 / 9) & (T < 7 / 9)
    assert changed[inner].all()
    assert not changed[~inner].any()


def test_open_curves_meet_their_end_points() -> None:
    points = RNG.normal(size=(7, 2))
    np.testing.assert_allclose(BSpline(points)([0.0, 1.0]), points[[0, -1]], atol=1e-14)


def test_a_winding_curve_grows_by_whole_turns_and_closes_as_a_surface() -> None:
    points = np.column_stack([np.arange(6) * np.pi / 3, np.full(6, 1.1)])
    spline = BSpline(points, 3, closed=True, winding=1)
    np.testing.assert_allclose(spline(1.25) - spline(0.25), [2 * np.pi, 0.0], atol=1e-12)
    np.testing.assert_allclose(spline(1.0) - spline(0.0), [2 * np.pi, 0.0], atol=1e-12)
    surface = RuledSurface(spline, 0, 1)
    assert surface.closure().order == 2
    assert surface.pitch() == pytest.approx(2 * np.pi * np.sin(1.1), abs=1e-11)


def test_the_series_holds_the_derivatives() -> None:
    spline = BSpline(RNG.normal(size=(8, 2)))
    series = spline.series(T, 3)
    for k in range(4):
        rows = np.moveaxis(series.derivatives()[k], 0, -1)
        np.testing.assert_allclose(rows, spline.derivative(T, k), rtol=1e-13, atol=1e-10)


def test_a_batch_is_its_curves_one_by_one() -> None:
    points = RNG.normal(size=(2, 3, 6, 2))
    batch = BSpline(points)
    assert batch.batch_shape == (2, 3)
    assert batch(T.reshape(1, -1)).shape == (2, 3, 1, 41, 2)
    np.testing.assert_array_equal(batch(T)[1, 2], BSpline(points[1, 2])(T))
    surface = RuledSurface(batch, "u - v", "u + v").invariants(T)
    single = RuledSurface(BSpline(points[1, 2]), "u - v", "u + v").invariants(T)
    np.testing.assert_allclose(surface.tau_bar[1, 2], single.tau_bar, rtol=1e-9)


def test_copies_stay_read_only() -> None:
    spline = copy.copy(BSpline(RNG.normal(size=(5, 2)), 2, closed=True))
    assert (spline.degree, spline.closed) == (2, True)
    with pytest.raises(ValueError, match="read-only"):
        spline.points[0] = 0.0


@pytest.mark.parametrize(
    ("points", "options", "words"),
    [
        (np.zeros((3, 2)), {}, "4 ≤ n"),
        (np.zeros((2, 2)), {"degree": 1, "closed": True}, "3 ≤ n"),
        (np.zeros((5, 3)), {}, "shape"),
        (np.full((5, 2), np.nan), {}, "finite"),
        (np.zeros((5, 2)), {"degree": 0}, "`degree`"),
        (np.zeros((5, 2)), {"degree": 2.5}, "`degree`"),
        (np.zeros((5, 2)), {"winding": 1}, "`winding`"),
    ],
)
def test_refusals_name_the_argument(points: object, options: dict, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        BSpline(points, **options)
