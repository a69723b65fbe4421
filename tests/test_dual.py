"""Dual numbers and dual vectors: the laws of the ring, every derivative by other routes."""

from __future__ import annotations

import math
import operator
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.dual import Dual, cross, inner, norm, normalize
from ruledlab.geometry.series import Series

whole = st.integers(-20, 20).map(float)
duals = st.builds(Dual, whole, whole)
units = duals.filter(lambda a: a.real != 0)
whole_vectors = arrays(float, 3, elements=whole)
dual_vectors = st.builds(Dual, whole_vectors, whole_vectors)
directed = dual_vectors.filter(lambda a: a.real.any())
EPSILON = Dual(0.0, 1.0)
few = settings(max_examples=50)


def same(a, b):
    np.testing.assert_array_equal(a.real, b.real)
    np.testing.assert_array_equal(a.dual, b.dual)


def close(a, b, rtol=1e-12, atol=1e-12):
    np.testing.assert_allclose(a.real, b.real, rtol=rtol, atol=atol)
    np.testing.assert_allclose(a.dual, b.dual, rtol=rtol, atol=atol)


# -- the ring -------------------------------------------------------------------------------------


@few
@given(duals, duals, duals)
def test_ring_laws_hold_exactly(a, b, c):
    same(a + b, b + a)
    same(a * b, b * a)
    same((a + b) + c, a + (b + c))
    same((a * b) * c, a * (b * c))
    same(a * (b + c), a * b + a * c)
    same(a - b, a + (-b))
    same(a * 1, a)
    same(1 * a + 0, a)
    same(+a - a, Dual(0.0))


def test_epsilon_squares_to_zero():
    same(EPSILON * EPSILON, Dual(0.0))
    same(EPSILON**2, Dual(0.0))
    same(Dual(2.0, 3.0) * EPSILON, Dual(0.0, 2.0))


@few
@given(whole, whole)
def test_pure_duals_are_zero_divisors(a, b):
    same(Dual(0.0, a) * Dual(0.0, b), Dual(0.0))


@few
@given(duals)
def test_conjugate_gives_the_square_of_the_real_part(a):
    same(a * a.conjugate(), Dual(a.real**2))
    same(a.conjugate().conjugate(), a)


@few
@given(duals, units)
def test_division_undoes_multiplication(a, b):
    close((a / b) * b, a, atol=1e-10)
    close((a * b) / b, a, atol=1e-10)
    close(1 / b * b, Dual(1.0), atol=1e-10)
    close(1 / b, b.conjugate() / b.real**2)


@few
@given(units, st.integers(0, 6))
def test_whole_powers_are_repeated_products(a, n):
    a = Dual(a.real / 4, a.dual / 4)
    product = Dual(1.0)
    for _ in range(n):
        product = product * a
    close(a**n, product, rtol=1e-12, atol=1e-9)
    close(a**-n * product, Dual(1.0), atol=1e-9)


@pytest.mark.parametrize("zero", [0, 0.0, np.int64(0), Dual(0.0), np.array(0)])
def test_anything_to_the_power_zero_is_one(zero):
    same(EPSILON**zero, Dual(1.0, 0.0))
    same(Dual(np.array([0.0, 2.0]), 1.0) ** zero, Dual(np.ones(2), np.zeros(2)))


def test_power_of_an_array_of_exponents():
    a = Dual(np.zeros(3), 1.0) ** np.array([0.0, 1.0, 2.0])
    same(a, Dual([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    same(Dual(-2.0, 1.0) ** 3, Dual(-8.0, 12.0))


@pytest.mark.parametrize(
    "mate",
    [EPSILON, Dual(0.0), Dual([1.0, 0.0], [1.0, 1.0]), Dual(Series([0.0, 1.0]), 1.0)],
)
def test_division_by_a_pure_dual_is_refused_with_the_reason(mate):
    for divide in (
        lambda: Dual(1.0, 2.0) / mate,
        lambda: 1.0 / mate,
        lambda: np.ones(2) / mate,
        lambda: np.reciprocal(mate),
        lambda: mate**-1,
        lambda: mate**-0.5,
    ):
        with pytest.raises(GeometryError, match=r"zero divisor.*no inverse.*leave"):
            divide()


def test_the_refusal_counts_the_places():
    with pytest.raises(GeometryError, match="got 2 of 3 with real part 0"):
        1 / Dual([0.0, 1.0, 0.0], 1.0)


# -- functions ------------------------------------------------------------------------------------

FUNCTIONS = {
    "exp": (np.exp, mpmath.exp, (-2.0, 0.0, 1.3)),
    "log": (np.log, mpmath.log, (0.2, 1.0, 7.5)),
    "sqrt": (np.sqrt, mpmath.sqrt, (0.3, 1.0, 9.0)),
    "sin": (np.sin, mpmath.sin, (-1.0, 0.0, 4.0)),
    "cos": (np.cos, mpmath.cos, (-1.0, 0.0, 4.0)),
    "tan": (np.tan, mpmath.tan, (-1.0, 0.0, 2.5)),
    "sinh": (np.sinh, mpmath.sinh, (-1.5, 0.0, 2.0)),
    "cosh": (np.cosh, mpmath.cosh, (-1.5, 0.0, 2.0)),
    "tanh": (np.tanh, mpmath.tanh, (-1.5, 0.0, 2.0)),
    "arcsin": (np.arcsin, mpmath.asin, (-0.7, 0.0, 0.999)),
    "arccos": (np.arccos, mpmath.acos, (-0.7, 0.0, 0.999)),
    "arctan": (np.arctan, mpmath.atan, (-3.0, 0.0, 0.8)),
    "square": (np.square, lambda a: a**2, (-3.0, 0.0, 0.8)),
    "reciprocal": (np.reciprocal, lambda a: 1 / a, (-3.0, 0.8)),
    "absolute": (np.absolute, abs, (-3.0, 0.8)),
    "negative": (np.negative, lambda a: -a, (-3.0, 0.0)),
    "cube": (lambda a: a**3, lambda a: a**3, (-3.0, 0.0, 0.8)),
    "real power": (lambda a: a**1.7, lambda a: mpmath.power(a, 1.7), (0.3, 2.0)),
    "power of a number": (lambda a: 3.0**a, lambda a: mpmath.power(3, a), (-1.0, 2.0)),
    "its own power": (lambda a: a**a, lambda a: mpmath.power(a, a), (0.3, 2.0)),
    "arctan2": (
        lambda a: np.arctan2(a, 1 - a * a),
        lambda a: mpmath.atan2(a, 1 - a * a),
        (-2.0, 0.0, 1.0, 3.0),
    ),
}
REAL_ONLY = {"absolute", "arctan2"}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_dual_part_is_the_derivative_by_mpmath(name):
    function, exact, places = FUNCTIONS[name]
    with mpmath.workdps(30):
        values = [float(exact(mpmath.mpf(a))) for a in places]
        slopes = [float(mpmath.diff(exact, mpmath.mpf(a))) for a in places]
    got = function(Dual(np.array(places), 2.5))
    close(got, Dual(values, 2.5 * np.array(slopes)), rtol=1e-11, atol=1e-14)
    for i, place in enumerate(places):  # a plain float takes the same way
        close(function(Dual(place, 2.5)), got[i], rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("name", sorted(FUNCTIONS.keys() - REAL_ONLY))
def test_dual_part_is_the_derivative_by_a_complex_step(name):
    function, _, places = FUNCTIONS[name]
    inside = np.array(places) * (0.9 if name.startswith("arc") else 1.0)
    step = function(inside + 1e-30j).imag / 1e-30
    np.testing.assert_allclose(function(Dual(inside, 1.0)).dual, step, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_dual_number_is_a_series_of_order_one(name):
    function, _, places = FUNCTIONS[name]
    a, a_bar = np.array(places), np.linspace(-2.0, 3.0, len(places))
    series, dual = function(Series(np.stack([a, a_bar]))), function(Dual(a, a_bar))
    close(dual, Dual(*series.coefficients), rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("function", [np.sqrt, np.log, np.arcsin, np.arccos, lambda a: a**0.5])
def test_outside_the_domain_both_parts_are_nan_without_a_warning(function):
    for a in (Dual(-2.0, 1.0), Dual(np.array([-2.0, -3.0]), 0.0), Dual(np.float64(-2.0), 3.0)):
        assert np.isnan(function(a).real).all()
        assert np.isnan(function(a).dual).all()


def test_edges_of_domains_are_silent():
    assert np.log(EPSILON).real == -np.inf
    assert np.isnan(np.log(EPSILON).dual)
    assert np.isnan((np.log(EPSILON) * 0.0).real)
    assert not np.isfinite(np.sqrt(EPSILON).dual)
    assert np.isnan(np.arctan2(EPSILON, EPSILON).dual)
    assert (Dual(np.float64(1e200)) * 1e200).real == np.inf


def test_absolute_value_has_no_derivative_at_zero():
    a = abs(Dual([-2.0, 0.0, 0.0, 3.0], [1.0, 1.0, 0.0, 1.0]))
    np.testing.assert_array_equal(a.real, [2.0, 0.0, 0.0, 3.0])
    np.testing.assert_array_equal(a.dual, [-1.0, np.nan, 0.0, 1.0])
    assert np.isnan(abs(Dual(Series([0.0, 0.0]), Series([0.0, 1.0]))).dual.value)
    assert abs(Dual(Series([0.0, 0.0]))).dual.value == 0.0


def test_arcsine_keeps_its_digits_near_one():
    a = 1.0 - 2.0**-40
    expected = 1 / math.sqrt(2.0**-39 - 2.0**-80)
    assert np.arcsin(Dual(a, 1.0)).dual == pytest.approx(expected, rel=1e-14)
    assert np.arccos(Dual(a, 1.0)).dual == pytest.approx(-expected, rel=1e-14)


# -- numbers, arrays and series mixed in ----------------------------------------------------------

OPERATIONS = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.true_divide: operator.truediv,
    np.power: operator.pow,
}


@pytest.mark.parametrize("ufunc", OPERATIONS, ids=lambda u: u.__name__)
@pytest.mark.parametrize("other", [2, 2.5, np.float64(2.5), np.int32(3), np.array([1, 2, 3])])
def test_numbers_and_arrays_on_either_side(ufunc, other):
    a, operation = Dual([1.0, 2.0, 4.0], [0.5, -1.0, 2.0]), OPERATIONS[ufunc]
    lifted = Dual(np.asarray(other, dtype=float), np.zeros(np.shape(other)))
    for got in (operation(a, other), ufunc(a, other)):
        assert isinstance(got, Dual)
        close(got, operation(a, lifted), rtol=1e-14)
    for got in (operation(other, a), ufunc(other, a)):
        assert isinstance(got, Dual)
        close(got, operation(lifted, a), rtol=1e-14)


T, S = sympy.symbols("t s", real=True)
SYMPY = SimpleNamespace(
    sqrt=sympy.sqrt,
    sin=sympy.sin,
    exp=sympy.exp,
    log=sympy.log,
    tan=sympy.tan,
    tanh=sympy.tanh,
    cosh=sympy.cosh,
    sinh=sympy.sinh,
    arccos=sympy.acos,
    arctan2=sympy.atan2,
)
"""What a formula written for numpy needs of SymPy."""


@pytest.mark.parametrize(
    "function",
    [
        lambda a, b, m: a * b - b / a,
        lambda a, b, m: m.sqrt(a * a + b * b),
        lambda a, b, m: m.sin(a) * m.exp(-b),
        lambda a, b, m: m.log(a) ** 3 + a ** (-2),
        lambda a, b, m: m.arctan2(b, a),
        lambda a, b, m: m.arccos(b / (1 + a * a)),
        lambda a, b, m: m.tan(b) + m.tanh(a) + m.cosh(b) - m.sinh(a),
        lambda a, b, m: a**b,
    ],
)
def test_dual_over_series_is_the_expansion_in_two_variables(function):
    """Coefficients of s⁰tᵏ and s¹tᵏ of f(a(t) + s ā(t), b(t) + s b̄(t)), by SymPy."""
    parts = [1 + T / 2 + T**2 / 3, T - 2 * T**2, sympy.Rational(2, 5) - T / 3, 1 - T + T**2 / 4]
    a, a_, b, b_ = (_series(p) for p in parts)
    got = function(Dual(a, a_), Dual(b, b_), np)
    f = function(parts[0] + S * parts[1], parts[2] + S * parts[3], SYMPY)
    for part, expression in ((got.real, f.subs(S, 0)), (got.dual, sympy.diff(f, S).subs(S, 0))):
        for k in range(3):
            exact = sympy.diff(expression, T, k).subs(T, 0).evalf(20) / math.factorial(k)
            assert part.coefficients[k] == pytest.approx(float(exact), rel=1e-12, abs=1e-13)


def _series(polynomial):
    return Series([float(polynomial.coeff(T, k)) for k in range(3)])


def test_plain_series_mix_with_duals():
    t = Series.variable([1.0, 2.0], 2)
    a = Dual(t, 3.0)
    for product in (a * t, t * a):
        np.testing.assert_array_equal(product.real.coefficients, (t * t).coefficients)
        np.testing.assert_array_equal(product.dual.coefficients, (3.0 * t).coefficients)
    np.testing.assert_array_equal((t - a).real.coefficients, np.zeros((3, 2)))
    np.testing.assert_array_equal((t - a).dual, -3.0)
    assert isinstance(np.arctan2(t, a), Dual)


# -- values ---------------------------------------------------------------------------------------


def test_indexing_broadcasts_the_parts_first():
    a = Dual(np.arange(6.0).reshape(2, 3), np.array([7.0, 8.0, 9.0]))
    same(a[1], Dual([3.0, 4.0, 5.0], [7.0, 8.0, 9.0]))
    same(Dual([1.0, 2.0])[1], Dual(2.0, 0.0))
    row = Dual(Series(np.ones((2, 4, 3))), Series.variable([1.0, 2.0, 3.0], 1))[3]
    assert row.real.shape == row.dual.shape == (3,)
    with pytest.raises(IndexError):
        Dual(1.0, 2.0)[0]


@pytest.mark.parametrize("bad", ["3", None, 1j, np.array([1j]), [[1.0], [1.0, 2.0]], Dual(1.0)])
def test_parts_must_be_real_numbers(bad):
    with pytest.raises(GeometryError, match=r"`real` must be a real number"):
        Dual(bad)
    with pytest.raises(GeometryError, match=r"`dual` must be a real number"):
        Dual(1.0, bad)


def test_what_has_no_meaning_is_refused():
    with pytest.raises(TypeError):
        Dual(1.0) + "1"
    with pytest.raises(TypeError):
        Dual(1.0) * 1j
    with pytest.raises(TypeError):
        np.floor(Dual(1.0))
    with pytest.raises(TypeError):
        np.add.reduce(Dual(1.0))


# -- vectors --------------------------------------------------------------------------------------


@few
@given(dual_vectors, dual_vectors)
def test_identity_of_lagrange_holds_exactly(a, b):
    product = cross(a, b)
    same(inner(product, product), inner(a, a) * inner(b, b) - inner(a, b) * inner(a, b))


@few
@given(dual_vectors, dual_vectors, dual_vectors)
def test_cross_product_is_normal_antisymmetric_and_satisfies_jacobi(a, b, c):
    same(inner(cross(a, b), a), Dual(0.0))
    same(inner(cross(a, b), b), Dual(0.0))
    same(cross(a, b), -cross(b, a))
    same(inner(cross(a, b), c), inner(cross(b, c), a))
    same(
        cross(a, cross(b, c)) + cross(b, cross(c, a)) + cross(c, cross(a, b)),
        Dual(np.zeros(3), np.zeros(3)),
    )


@few
@given(dual_vectors, dual_vectors, dual_vectors, duals)
def test_products_are_bilinear_over_the_dual_numbers(a, b, c, scale):
    same(inner(a, b), inner(b, a))
    same(inner(scale * a, b), scale * inner(a, b))
    same(inner(a + c, b), inner(a, b) + inner(c, b))
    same(cross(scale * a, b), scale * cross(a, b))
    same(cross(a + c, b), cross(a, b) + cross(c, b))


@few
@given(directed, units)
def test_norm_is_multiplicative(a, scale):
    close(norm(scale * a), abs(scale) * norm(a), atol=1e-9)
    close(norm(a) ** 2, inner(a, a), atol=1e-9)


@few
@given(directed)
def test_norm_has_the_dual_part_of_its_definition(a):
    length = np.linalg.norm(a.real)
    close(norm(a), Dual(length, a.real @ a.dual / length), atol=1e-10)


@few
@given(directed)
def test_normalised_vectors_are_lines(a):
    unit = normalize(a)
    close(inner(unit, unit), Dual(1.0, 0.0), atol=1e-12)
    close(norm(a) * unit, a, atol=1e-10)
    close(normalize(unit), unit, atol=1e-12)


@pytest.mark.parametrize("zeros", [np.zeros(3), np.array([[1.0, 0, 0], [0, 0, 0]])])
def test_a_pure_dual_vector_cannot_be_normalised(zeros):
    with pytest.raises(GeometryError, match=r"`a` must have a real part other than the zero"):
        normalize(Dual(zeros, np.ones(3)))
    with pytest.raises(GeometryError, match="no direction"):
        normalize(zeros)


def test_norm_of_a_pure_dual_vector_is_undefined_in_its_dual_part():
    length = norm(Dual(np.zeros(3), np.ones(3)))
    assert length.real == 0.0
    assert np.isnan(length.dual)


def test_vectors_without_a_dual_part_and_plain_arrays():
    x, y = np.array([1.0, 2.0, 3.0]), np.array([-1.0, 0.5, 2.0])
    y_bar = np.array([0.0, 1.0, -1.0])
    np.testing.assert_array_equal(cross(x, y), np.cross(x, y))
    assert inner(x, y) == x @ y
    for left in (x, Dual(x)):
        same(inner(left, Dual(y, y_bar)), Dual(x @ y, x @ y_bar))
        same(cross(left, Dual(y, y_bar)), Dual(np.cross(x, y), np.cross(x, y_bar)))
    np.testing.assert_allclose(norm(x), math.sqrt(14.0), rtol=1e-15)
    np.testing.assert_allclose(normalize(x), x / math.sqrt(14.0), rtol=1e-15)


def test_batches_and_other_axes():
    rng = np.random.default_rng(3)
    a, b = (Dual(*rng.normal(size=(2, 4, 5, 3))) for _ in range(2))
    single = Dual(a.real[2, 3], a.dual[2, 3])
    assert cross(a, single).real.shape == (4, 5, 3)
    close(cross(a, b)[2, 3], cross(single, b[2, 3]), rtol=1e-14)
    turned = [Dual(np.moveaxis(v.real, -1, 0), np.moveaxis(v.dual, -1, 0)) for v in (a, b)]
    close(inner(*turned, axis=0), inner(a, b), rtol=1e-14)
    unit, expected = normalize(turned[0], axis=0), normalize(a)
    np.testing.assert_allclose(np.moveaxis(unit.dual, 0, -1), expected.dual, rtol=1e-12)


@few
@given(*[arrays(float, (4, 2, 3), elements=whole)] * 2, st.sampled_from([-1, 1]))
def test_vectors_of_series_obey_the_product_rule(p, q, axis):
    """Derivatives of ⟨a, b⟩ and a × b for parts that move with t."""
    a, b = (Dual(Series(c), Series(c[::-1])) for c in (p, q))
    da, db = (Dual(v.real.derivative(), v.dual.derivative()) for v in (a, b))
    for product in (inner, cross):
        whole_rate = product(a, b, axis)
        rate = product(da, b, axis) + product(a, db, axis)
        for part in ("real", "dual"):
            left = getattr(whole_rate, part).derivative()
            np.testing.assert_array_equal(left.coefficients, getattr(rate, part).coefficients)


def test_a_moving_line_stays_a_dual_unit_vector():
    t = Series.variable([0.3, 1.7], 4)
    ones = np.ones(2)
    rows = [np.cos(t), np.sin(t), t * 0 + 0.5], [t, ones + t * t, np.exp(t)]
    real, dual = (Series(np.stack([r.coefficients for r in part], axis=-1)) for part in rows)
    unit = normalize(Dual(real, dual))
    square = inner(unit, unit)
    np.testing.assert_allclose(square.real.coefficients[0], 1.0, rtol=1e-15)
    np.testing.assert_allclose(square.real.coefficients[1:], 0.0, atol=1e-14)
    np.testing.assert_allclose(square.dual.coefficients, 0.0, atol=1e-13)


def test_dual_numbers_and_series_show_plain_numbers():
    assert repr(Dual(3, 2) * Dual(5, -1)) == "Dual(15.0, 7.0)"
    assert repr(Dual(np.array([1.0, 2.0]), 3)) == "Dual(array([1., 2.]), 3.0)"
    t = Series.variable(2.0, 3)
    assert repr(t) == "Series(order=3, shape=(), value=2.0)"
    assert repr(Dual(t, 1)) == f"Dual({t!r}, 1.0)"
