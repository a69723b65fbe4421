"""Series: against SymPy's Taylor coefficients, the laws of a ring, and the edges of domains."""

from __future__ import annotations

import math
import operator
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.series import Series, sine_cosine

T = sympy.Symbol("t", real=True)
ORDER = 6

# name: what numpy does to a Series, the same for SymPy, places t
TAYLOR = {
    "exp": (np.exp, sympy.exp, (-2.0, 0.0, 1.3)),
    "log": (np.log, sympy.log, (0.2, 1.0, 7.5)),
    "sqrt": (np.sqrt, sympy.sqrt, (0.3, 1.0, 9.0)),
    "sin": (np.sin, sympy.sin, (-1.0, 0.0, 4.0)),
    "cos": (np.cos, sympy.cos, (-1.0, 0.0, 4.0)),
    "tan": (np.tan, sympy.tan, (-1.0, 0.0, 2.5)),
    "sinh": (np.sinh, sympy.sinh, (-1.5, 0.0, 2.0)),
    "cosh": (np.cosh, sympy.cosh, (-1.5, 0.0, 2.0)),
    "tanh": (np.tanh, sympy.tanh, (-1.5, 0.0, 2.0)),
    "arcsin": (np.arcsin, sympy.asin, (-0.7, 0.0, 0.5)),
    "arccos": (np.arccos, sympy.acos, (-0.7, 0.0, 0.5)),
    "arctan": (np.arctan, sympy.atan, (-3.0, 0.0, 0.8)),
    "square": (np.square, lambda t: t**2, (-3.0, 0.0)),
    "reciprocal": (np.reciprocal, lambda t: 1 / t, (-3.0, 0.5)),
    "fifth power": (lambda t: t**5, lambda t: t**5, (-1.5, 0.0, 2.0)),
    "power -3": (lambda t: t**-3, lambda t: t**-3, (-1.5, 2.0)),
    "real power": (lambda t: t**1.7, lambda t: t ** sympy.Rational(17, 10), (0.4, 3.0)),
    "2 to the t": (lambda t: 2**t, lambda t: 2**t, (-1.0, 2.0)),
    "t to the t": (lambda t: t**t, lambda t: t**t, (0.5, 2.0)),
    "sin of exp": (lambda t: np.sin(np.exp(t)), lambda t: sympy.sin(sympy.exp(t)), (-1.0, 0.5)),
    "quotient": (
        lambda t: np.sqrt(1 + t * t) / (2 + np.cos(3 * t)),
        lambda t: sympy.sqrt(1 + t * t) / (2 + sympy.cos(3 * t)),
        (-0.4, 0.0, 1.1),
    ),
    "logarithm of a quotient": (
        lambda t: np.log((3 + t) / (4 - t**2)),
        lambda t: sympy.log((3 + t) / (4 - t**2)),
        (-1.0, 1.5),
    ),
    "arctan2": (
        lambda t: np.arctan2(np.sin(t), t - 2),
        lambda t: sympy.atan2(sympy.sin(t), t - 2),
        (-2.0, 0.5, 1.0, 4.0),
    ),
    "arctan2 of a number": (
        lambda t: np.arctan2(1.5, t),
        lambda t: sympy.atan2(sympy.Rational(3, 2), t),
        (-2.0, 0.0, 1.0),
    ),
}


@cache
def exact_coefficients(name):
    """Rows of f⁽ᵏ⁾(t)/k! at the places of the case, by SymPy, in 40 digits."""
    _, function, places = TAYLOR[name]
    derivatives = [function(T)]
    for _ in range(ORDER):
        derivatives.append(sympy.diff(derivatives[-1], T))
    rows = [sympy.lambdify(T, d, "mpmath") for d in derivatives]
    with mpmath.workdps(40):
        return np.array(
            [
                [float(row(mpmath.mpf(t)) / math.factorial(k)) for t in places]
                for k, row in enumerate(rows)
            ]
        )


@pytest.mark.parametrize("order", range(ORDER + 1))
@pytest.mark.parametrize("name", TAYLOR)
def test_coefficients_are_those_of_sympy(name, order):
    function, _, places = TAYLOR[name]
    got = function(Series.variable(places, order)).coefficients
    expected = exact_coefficients(name)[: order + 1]
    assert got.shape == expected.shape
    scale = np.abs(exact_coefficients(name)).max(axis=0)
    np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-13 * scale.max())


@pytest.mark.parametrize("name", TAYLOR)
def test_a_single_place_gives_the_same_as_an_array_of_places(name):
    function, _, places = TAYLOR[name]
    together = function(Series.variable(places, 4))
    for i, place in enumerate(places):
        alone = function(Series.variable(place, 4))
        assert alone.shape == ()
        np.testing.assert_allclose(alone.coefficients, together[i].coefficients, rtol=1e-13)


def test_sine_and_cosine_come_together():
    t = Series.variable([0.3, 2.0], 5)
    sine, cosine = sine_cosine(t)
    np.testing.assert_array_equal(sine.coefficients, np.sin(t).coefficients)
    np.testing.assert_array_equal(cosine.coefficients, np.cos(t).coefficients)


# -- laws -----------------------------------------------------------------------------------------

shapes = st.sampled_from([(), (3,), (2, 5), (2, 1), (5,)])


@st.composite
def whole_series(draw, shape=None, order=None):
    """Series of small whole numbers: sums and products of them are exact."""
    rows = 1 + (draw(st.integers(0, 6)) if order is None else order)
    shape = draw(shapes) if shape is None else shape
    size = rows * math.prod(shape)
    entries = draw(st.lists(st.integers(-9, 9), min_size=size, max_size=size))
    return Series(np.array(entries, dtype=float).reshape(rows, *shape))


@st.composite
def compatible(draw, count):
    """Series whose orders and shapes differ but broadcast."""
    family = draw(st.sampled_from([[()], [(3,), ()], [(2, 5), (5,), (2, 1), ()]]))
    return [draw(whole_series(shape=draw(st.sampled_from(family)))) for _ in range(count)]


def same(a, b):
    assert a.coefficients.shape == b.coefficients.shape
    np.testing.assert_array_equal(a.coefficients, b.coefficients)


def close(a, b, scale=1.0, rtol=1e-11):
    """Equal up to rounding in terms of the size ``scale``."""
    assert a.shape == b.shape
    rows = min(a.order, b.order) + 1
    difference = np.abs(a.coefficients[:rows] - b.coefficients[:rows])
    assert np.isfinite(difference).all()
    assert (difference <= rtol * (scale + np.abs(b.coefficients[:rows]))).all(), difference.max()


def size(*series):
    return math.prod(1.0 + np.abs(s.coefficients).sum(axis=0).max() for s in series)


@settings(max_examples=50)
@given(compatible(3))
def test_ring_laws_hold_exactly(abc):
    a, b, c = abc
    same(a + b, b + a)
    same(a * b, b * a)
    same((a + b) + c, a + (b + c))
    same((a * b) * c, a * (b * c))
    same(a * (b + c), a * b + a * c)
    same(a - b, a + (-b))
    same(+a, a)
    same(a * 1, a)
    same(a + 0, a)
    same((a - a), a * 0)


@settings(max_examples=50)
@given(compatible(2))
def test_order_and_shape_of_a_product_and_a_sum(ab):
    a, b = ab
    for operation in (operator.add, operator.sub, operator.mul):
        result = operation(a, b)
        assert result.order == min(a.order, b.order)
        assert result.shape == np.broadcast_shapes(a.shape, b.shape)
        np.testing.assert_array_equal(result.value, operation(a.value, b.value))


@given(whole_series(shape=()), whole_series(shape=()))
def test_product_is_the_product_of_the_polynomials(a, b):
    rows = min(a.order, b.order) + 1
    expected = np.convolve(a.coefficients, b.coefficients)[:rows]
    np.testing.assert_array_equal((a * b).coefficients, expected)


@settings(max_examples=50)
@given(compatible(2))
def test_derivative_of_a_product(ab):
    a, b = (Series(np.concatenate([s.coefficients, s.coefficients[:1]])) for s in ab)
    same((a * b).derivative(), a.derivative() * b + a * b.derivative())


@settings(max_examples=50)
@given(whole_series(order=5))
def test_derivatives_are_repeated_derivatives(a):
    for k in range(6):
        np.testing.assert_array_equal(a.derivatives()[k], a.derivative(k).value)
    same(a.derivative(2), a.derivative().derivative())
    same(a.derivative(0), a)


CHAIN = {
    np.sin: np.cos,
    np.cos: lambda a: -np.sin(a),
    np.tan: lambda a: 1 / np.cos(a) ** 2,
    np.exp: np.exp,
    np.sinh: np.cosh,
    np.cosh: np.sinh,
    np.tanh: lambda a: 1 / np.cosh(a) ** 2,
    np.arctan: lambda a: 1 / (1 + a * a),
    np.log: lambda a: 1 / a,
    np.sqrt: lambda a: 0.5 / np.sqrt(a),
    np.arcsin: lambda a: 1 / np.sqrt(1 - a * a),
    np.arccos: lambda a: -1 / np.sqrt(1 - a * a),
}


@pytest.mark.parametrize("function", CHAIN, ids=lambda f: f.__name__)
@settings(max_examples=20)
@given(a=whole_series(order=4))
def test_chain_rule(function, a):
    inside = Series(np.concatenate([0.05 * a.coefficients[:1] + 0.5, 0.3 * a.coefficients[1:]]))
    left = function(inside).derivative()
    right = CHAIN[function](inside) * inside.derivative()
    close(left, right, size(left))


@settings(max_examples=50)
@given(compatible(2))
def test_division_undoes_multiplication(ab):
    a, b = ab
    b = b + np.where(b.value < 0, -1.0, 1.0)
    quotient = a / b
    close(quotient * b, a + 0 * b, size(quotient, b), 1e-14)
    close(1 / (1 / b), b, size(1 / b, 1 / b, b), 1e-14)


@settings(max_examples=50)
@given(whole_series(order=4), st.floats(-3, 3), st.floats(-3, 3))
def test_laws_of_powers(a, p, q):
    a = Series(np.concatenate([np.abs(a.value)[None] * 0.2 + 1, 0.2 * a.coefficients[1:]]))
    left, right = a**p, a**q
    close(left * right, a ** (p + q), size(left, right))
    close(1 / left, a**-p, size(left, a**-p, a**-p))
    close(np.exp(p * np.log(a)), left, size(left))
    close(np.sqrt(a) * np.sqrt(a), a, size(a))
    close(np.sqrt(a), a**0.5, size(a))
    close(np.log(np.exp(a)), a, size(np.exp(a)))


@settings(max_examples=50)
@given(whole_series(), st.integers(0, 7))
def test_whole_powers_are_repeated_products_at_any_base(a, n):
    product = a * 0 + 1
    for _ in range(n):
        product = product * a
    same(a**n, product)
    same(a ** float(n), product)
    same(np.power(a, n), product)
    same(a ** np.int64(n), product)


@pytest.mark.parametrize("n", [-1, -2, -5])
def test_negative_whole_power_of_a_negative_base(n):
    a = Series([-2.0, 0.5, 0.25, 1.0])
    np.testing.assert_allclose((a**n * a**-n).coefficients, [1, 0, 0, 0], atol=1e-15)
    assert (a**n).value == (-2.0) ** n


@settings(max_examples=50)
@given(whole_series(order=3))
def test_trigonometric_and_hyperbolic_identities(a):
    a = a * 0.1
    sine, cosine, sinh, cosh = np.sin(a), np.cos(a), np.sinh(a), np.cosh(a)
    one = a * 0 + 1
    close(sine * sine + cosine * cosine, one, size(sine, sine))
    close(cosh * cosh - sinh * sinh, one, size(cosh, cosh))
    close(np.arctan2(2 * sine, 2 * cosine), a, size(a, a))
    close(np.tan(a), sine / cosine, size(a, a, a))


# -- numpy ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ufunc", "operation"),
    [
        (np.add, operator.add),
        (np.subtract, operator.sub),
        (np.multiply, operator.mul),
        (np.true_divide, operator.truediv),
        (np.power, operator.pow),
    ],
)
@pytest.mark.parametrize(
    "other",
    [
        2,
        2.5,
        np.float64(2.5),
        np.int32(3),
        np.array([1, 2, 3]),
        np.array([[1.5], [2.5]]),
        [1, 2, 3],
    ],
)
def test_numbers_and_arrays_on_either_side(ufunc, operation, other):
    a = Series.variable([1.0, 2.0, 4.0], 3)
    constant = np.asarray(other, dtype=float)
    constant = Series(np.concatenate([constant[None], np.zeros((3, *constant.shape))]))
    for got in (operation(a, other), ufunc(a, other)):
        assert isinstance(got, Series)
        close(got, operation(a, constant), 1.0, 1e-13)
    for got in (operation(other, a), ufunc(other, a)):
        assert isinstance(got, Series)
        close(got, operation(constant, a), 1.0, 1e-13)


def test_two_by_five_values_with_every_partner():
    a = Series.variable(np.arange(1.0, 11.0).reshape(2, 5), 2)
    for partner in (3.0, np.arange(5.0), np.array([[1.0], [2.0]]), np.ones((4, 1, 1))):
        product = a * partner
        assert product.shape == np.broadcast_shapes((2, 5), np.shape(partner))
        np.testing.assert_array_equal(product.derivatives()[1], np.ones((2, 5)) * partner)
        same(partner * a, product)
        np.testing.assert_array_equal((a + partner).value, a.value + partner)
        np.testing.assert_array_equal((a + partner).derivatives()[1], (product * 0 + 1).value)


def test_lower_order_wins():
    a, b = Series.variable(2.0, 5), Series.variable(3.0, 2)
    for result in (a + b, a * b, a / b, a**b, np.arctan2(a, b), np.arctan2(b, a)):
        assert result.order == 2
    assert a.truncated(1).order == 1


def test_indexing_reaches_the_values_and_leaves_the_order():
    a = Series.variable(np.arange(10.0).reshape(2, 5), 3)
    assert a[1].shape == (5,)
    assert a[1, 2].value == 7.0
    assert a[..., 0].shape == (2,)
    assert a[1, 2].order == 3


def test_operations_leave_their_operands_alone():
    a = Series.variable([0.25, 0.0, -0.5], 3)
    b = Series.variable([0.5, 1.0, 2.0], 3)
    before = a.coefficients.copy(), b.coefficients.copy()
    for function in (np.sin, np.sqrt, np.exp, np.log, np.absolute, np.sign, np.tanh, np.arcsin):
        function(a)
    for operation in (np.add, np.multiply, np.true_divide, np.power, np.arctan2):
        operation(a, b)
    a**3, a.derivative(), a.derivatives()
    np.testing.assert_array_equal(a.coefficients, before[0])
    np.testing.assert_array_equal(b.coefficients, before[1])


def test_what_numpy_cannot_do_is_refused_by_numpy():
    a = Series.variable(1.0, 2)
    with pytest.raises(TypeError):
        np.floor(a)
    with pytest.raises(TypeError):
        np.add(np.ones(2), a, out=np.ones(2))
    with pytest.raises(TypeError):
        a + "1"
    with pytest.raises(TypeError):
        a * 1j


# -- edges of domains -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "outside", "inside"),
    [
        (np.log, -1.0, 2.0),
        (np.sqrt, -1.0, 2.0),
        (np.arcsin, 2.0, 0.5),
        (np.arccos, -1.5, 0.5),
        (lambda a: a**0.5, -1.0, 2.0),
        (lambda a: a**a, -1.5, 2.0),
        (lambda a: np.power(-2.0, a), 0.5, None),
    ],
)
def test_outside_the_domain_every_coefficient_is_nan(function, outside, inside):
    assert np.isnan(function(Series.variable(outside, 3)).coefficients).all()
    assert np.isnan(function(Series.variable(outside, 0)).coefficients).all()
    if inside is not None:
        both = function(Series.variable([outside, inside], 3))
        assert np.isnan(both[0].coefficients).all()
        assert np.isfinite(both[1].coefficients).all()


@pytest.mark.parametrize(
    "function",
    [
        np.log,
        lambda a: 1 / a,
        lambda a: a / 0,
        lambda a: a**-2,
        lambda a: np.log(a) * a,
        lambda a: np.log(a) - np.log(a),
        lambda a: 0.0 ** (a - 1),
    ],
)
def test_at_a_pole_the_result_is_not_finite_and_nothing_is_said(function):
    coefficients = function(Series.variable(0.0, 3)).coefficients
    assert not np.isfinite(coefficients[0])
    assert np.isnan(coefficients[-1]) or np.isinf(coefficients[-1])


@pytest.mark.parametrize("function", [np.exp, np.sinh, np.cosh, np.square, np.arctan, np.tanh])
def test_overflow_is_silent(function):
    large = function(Series.variable([1e200, -1e200], 2))
    assert large.shape == (2,)
    assert not np.isnan(large.value).any()


def test_root_at_zero_has_a_value_and_no_derivative():
    root = np.sqrt(Series.variable(0.0, 2))
    assert root.value == 0.0
    assert not np.isfinite(root.coefficients[1:]).any()


def test_angle_at_the_origin_has_no_derivative():
    zero = Series.variable(0.0, 2)
    assert np.isnan(np.arctan2(zero, zero).coefficients[1:]).all()


def test_absolute_value_and_sign():
    a = Series(np.array([[2.0, -2.0, 0.0, 0.0], [3.0, 3.0, 1.0, 0.0], [-1.0, -1.0, 0.0, 0.0]]))
    for got in (abs(a), np.absolute(a), np.fabs(a)):
        np.testing.assert_array_equal(
            got.coefficients, [[2, 2, 0, 0], [3, -3, np.nan, 0], [-1, 1, np.nan, 0]]
        )
    np.testing.assert_array_equal(
        np.sign(a).coefficients, [[1, -1, 0, 0], [0, 0, np.nan, 0], [0, 0, np.nan, 0]]
    )


def test_arcsine_keeps_its_digits_near_one():
    a = 1.0 - 2.0**-40
    slope = np.arcsin(Series.variable(a, 1)).coefficients[1]
    assert slope == pytest.approx(1 / math.sqrt(2.0**-39 - 2.0**-80), rel=1e-14)


# -- refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", [3.0, [], np.array([1j]), ["1"], None])
def test_coefficients_without_an_order_or_not_real_are_refused(bad):
    with pytest.raises(GeometryError, match=r"`coefficients` must"):
        Series(bad)


@pytest.mark.parametrize("k", [-1, 4])
def test_a_derivative_beyond_the_order_is_refused(k):
    with pytest.raises(GeometryError, match=r"`k` must lie between 0 and the order 3"):
        Series.variable(1.0, 3).derivative(k)


def test_whole_numbers_become_floats():
    a = Series([1, 2, 3])
    assert a.coefficients.dtype == np.float64
    assert (a / 2).value == 0.5
