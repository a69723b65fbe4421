"""ū and v̄: the values and derivatives of typed formulas and Python functions, and numbers."""

from __future__ import annotations

import dataclasses
import math
import warnings

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.dual import Dual
from ruledlab.geometry.field import field, named_number, number
from ruledlab.geometry.formula import FormulaError
from ruledlab.geometry.series import Series

U = np.linspace(0.2, 1.4, 7)
V = np.linspace(1.3, 0.6, 7)
PI = math.pi

# -- values ----------------------------------------------------------------------------------------

BY_HAND = {
    "u - v": U - V,
    "u + v": U + V,
    "u - v - 1": (U - V) - 1,
    "u - (v - 1)": U - V + 1,
    "u / v / 2": U / (2 * V),
    "u / (v / 2)": 2 * U / V,
    "u/2*v": 0.5 * U * V,
    "-u**2": -(U * U),
    "(-u)**2": U * U,
    "2**-u": 0.5**U,
    "2**u**2": 2.0 ** (U * U),
    "u**v": np.exp(V * np.log(U)),
    "u**0.5": np.sqrt(U),
    "u**-2": 1 / (U * U),
    "u**(4/2)": U * U,
    "- - +u": U,
    "2*-u": -2 * U,
    "1e-3*u + 2.5E2 + .5 + 3.": 0.001 * U + 253.5,
    "007*u": 7 * U,
    "pi*u + e": PI * U + math.e,
    "π*u": PI * U,
    "sqrt(u) + exp(v) + log(u)": np.sqrt(U) + np.exp(V) + np.log(U),
    "sin(u)*cos(v) - tan(u)": np.sin(U) * np.cos(V) - np.tan(U),
    "arcsin(u/2) - asin(u/2) + arccos(u/2) - acos(u/2) + 1": np.ones(7),
    "arctan(u) - atan(u) + arctan2(u, v) - atan2(u, v)": np.zeros(7),
    "arctan2(u, v)": np.arctan(U / V),
    "arctan2(u, -v)": PI - np.arctan(U / V),
    "arcsin(sin(u)) + arccos(cos(v)) + arctan(tan(u))": 2 * U + V,
    "sinh(u) + cosh(u)": np.exp(U),
    "tanh(u)*cosh(u)": np.sinh(U),
    "abs(u - 0.8)": np.where(U > 0.8, U - 0.8, 0.8 - U),
    " \tu\n -\r\n v\u00a0": U - V,
}


@pytest.mark.parametrize("text", BY_HAND)
def test_value_on_arrays(text: str) -> None:
    assert_allclose(field(text)(U, V), BY_HAND[text], rtol=1e-14, atol=1e-14)


OPERATIONS = {
    "+": (1, lambda a, b: a + b),
    "-": (1, lambda a, b: a - b),
    "*": (2, lambda a, b: a * b),
    "/": (2, lambda a, b: a / b),
}
LEAVES = {"u": 0.7, "v": 1.9, "2": 2.0, "0.5": 0.5, "pi": PI, "3e1": 30.0}


def _joined(sign: str, left: tuple, right: tuple) -> tuple[str, float, int]:
    """Join two (text, value, level), with the fewest brackets that keep the meaning."""
    level, operation = OPERATIONS[sign]
    a = left[0] if left[2] >= level else f"({left[0]})"
    b = right[0] if right[2] > level else f"({right[0]})"
    return f"{a} {sign}{b}", operation(left[1], right[1]), level


def _negated(part: tuple) -> tuple[str, float, int]:
    return f"-{part[0] if part[2] >= 2 else f'({part[0]})'}", -part[1], 1


def _raised(part: tuple, exponent: int) -> tuple[str, float, int]:
    base = part[0] if part[2] >= 4 else f"({part[0]})"
    return f"{base} ** {exponent}", part[1] ** exponent, 3


EXPRESSIONS = st.recursive(
    st.sampled_from([(name, value, 4) for name, value in LEAVES.items()]),
    lambda inner: st.one_of(
        st.builds(_joined, st.sampled_from("+-*"), inner, inner),
        st.builds(_joined, st.just("/"), inner, st.sampled_from([("u", 0.7, 4), ("2", 2.0, 4)])),
        st.builds(_negated, inner),
        st.builds(_raised, inner, st.integers(2, 3)),
        inner.map(lambda part: (f"cos({part[0]})", math.cos(part[1]), 4)),
    ),
    max_leaves=12,
)


@given(EXPRESSIONS)
@settings(deadline=None)
def test_precedence_is_that_of_arithmetic(expression: tuple[str, float, int]) -> None:
    text, expected, _ = expression
    if len(text) <= 500 and abs(expected) < 1e6:
        assert_allclose(field(text)(0.7, 1.9), expected, rtol=1e-9, atol=1e-7)


def test_plain_numbers_are_computed_as_floats() -> None:
    assert field("u**-1")(2, 0) == 0.5
    assert field("u**60")(10, 0) == 1e60
    assert field("1/u")(0, 0) == math.inf
    assert field("u/v")([1, 2], [4, 4]).tolist() == [0.25, 0.5]
    assert math.isnan(field("u**0.5")(-1, 0))


def test_outside_the_domain_is_nan_without_a_warning() -> None:
    values = field("log(u) + sqrt(v) + arccos(u)")(np.array([-1.0, 0.5, 2.0]), 1.0)
    assert_array_equal(np.isnan(values), [True, False, True])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert field("u*u - v*v + sin(u)")(np.array([1e308, np.inf]), 1e308).shape == (2,)


def test_arguments_broadcast() -> None:
    assert field("u - v")(U[:, None], V).shape == (7, 7)
    assert_array_equal(field("u - v")(U[:, None], V)[2], U[2] - V)


# -- derivatives -----------------------------------------------------------------------------------

SMOOTH = [
    "u - v",
    "u**2 - 3*u*v**3",
    "(u - 1)**-3",
    "2**u - v**u",
    "abs(u)**1.7 + u**v",
    "(u/v)**0.5/(1 + u**2)",
    "sin(2*u)*cos(v)**2 - tan(u/2)",
    "exp(-u**2)*log(v + 1)",
    "sqrt(1 + u*v) + sinh(u) - cosh(v)*tanh(u)",
    "arctan2(u, v - 3) + arctan(u*v)",
    "arcsin(u/4) - arccos(v/5)",
    "3*cos(v)/sqrt(sin(v)**2 + 4*cos(v)**2)",
]
NAMES = {
    "arctan2": sympy.atan2,
    "arctan": sympy.atan,
    "arcsin": sympy.asin,
    "arccos": sympy.acos,
    "abs": sympy.Abs,
    "pi": sympy.pi,
    "e": sympy.E,
    "u": sympy.Symbol("u", real=True),
    "v": sympy.Symbol("v", real=True),
}


def _symbolic(text: str) -> sympy.Expr:
    return sympy.sympify(text, locals=NAMES)


@pytest.mark.parametrize("text", SMOOTH)
def test_derivatives_through_series_are_those_of_sympy(text: str) -> None:
    t = sympy.Symbol("t", positive=True)
    place = {NAMES["u"]: t + t**2 / 3, NAMES["v"]: 2 - t**3}
    expected = [_symbolic(text).subs(place).diff(t, k).subs(t, 0.5).evalf() for k in range(4)]
    s = Series.variable(np.array([0.5]), 3)
    got = field(text)(s + s**2 / 3, 2 - s**3).derivatives()[:, 0]
    assert_allclose(got, np.array(expected, dtype=float), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("text", SMOOTH)
def test_partials_are_those_of_sympy(text: str) -> None:
    u, v = np.array([0.4, 1.2]), np.array([0.9, 1.1])
    for slope, name in zip(field(text).partials(u, v), "uv", strict=True):
        symbolic = _symbolic(text).diff(NAMES[name])
        expected = [symbolic.subs({NAMES["u"]: a, NAMES["v"]: b}) for a, b in zip(u, v)]  # noqa: B905
        assert_allclose(slope, np.array(expected, dtype=float), rtol=1e-12, atol=1e-13)


def test_partials_of_a_constant_are_zeros_of_the_right_shape() -> None:
    for slope in field("pi").partials(U, V):
        assert_array_equal(slope, np.zeros(7))


@pytest.mark.parametrize("text", ["u**2", "u**2.0", "u**(4/2)", "u*u"])
@pytest.mark.parametrize("place", [0.0, -1.5])
def test_whole_powers_are_smooth_at_zero_and_below(text: str, place: float) -> None:
    series = field(text)(Series.variable(place, 3), 1.0)
    assert_allclose(series.derivatives(), [place**2, 2 * place, 2, 0], atol=1e-15)
    assert_allclose(field(text).partials(place, 1.0), [2 * place, 0], atol=1e-15)
    assert field(text)(np.array([place]), 1.0) == place**2


def test_whole_negative_powers_below_zero() -> None:
    series = field("u**-2")(Series.variable(-2.0, 2), 0.0)
    assert_allclose(series.derivatives(), [1 / 4, 2 / 8, 6 / 16])
    assert field("u**-3").partials(-2.0, 0.0)[0] == pytest.approx(-3 / 16)


def test_dual_argument_gives_the_dual_value() -> None:
    value = field("u**2*v")(Dual(3.0, 0.5), Dual(2.0, -1.0))
    assert value.real == 18.0
    assert value.dual == pytest.approx(2 * 3 * 2 * 0.5 - 9)


# -- the value Field -------------------------------------------------------------------------------


def test_constant_fields() -> None:
    assert field("3*pi/8").is_constant
    assert field("3*pi/8")(U, V) == 3 * PI / 8
    assert type(field(2)(U, V)) is float
    assert not field("0*u").is_constant
    assert not field("v").is_constant


@pytest.mark.parametrize(
    ("value", "text"),
    [(2, "2"), (0.1, "0.1"), (-PI / 2, "-pi/2"), (np.float32(0.5), "0.5"), (np.array(3), "3")],
)
def test_numbers_become_text(value: object, text: str) -> None:
    assert field(value).text == text
    assert field(value)(U, V) == float(value)  # type: ignore[arg-type]


@pytest.mark.parametrize("text", [*BY_HAND, *SMOOTH])
def test_text_gives_back_the_same_field(text: str) -> None:
    first = field(text)
    again = field(first.text)
    assert again == first
    assert hash(again) == hash(first)
    assert again.latex == first.latex
    assert_array_equal(again(U, V), first(U, V))
    assert "\n" not in first.text
    assert first.text == first.text.strip()


def test_a_field_passes_through_and_cannot_be_changed() -> None:
    first = field("u - v", "ubar")
    assert field(first, "vbar") is first
    assert field("u + v") != first
    assert field("(u - v)") != first
    assert first != "u - v"
    with pytest.raises(dataclasses.FrozenInstanceError):
        first.text = "v"  # type: ignore[misc]


@pytest.mark.parametrize(
    "value", [None, True, b"u", [1], 1j, np.array([1.0, 2.0]), math.nan, -math.inf, 10**400]
)
def test_what_is_no_field(value: object) -> None:
    with pytest.raises(GeometryError, match=r"^`vbar` must be") as caught:
        field(value, "vbar")
    assert "\n" not in str(caught.value)


# -- Python functions ------------------------------------------------------------------------------


def test_python_functions() -> None:
    f = field(lambda u, v: np.sin(2 * u) / v, "ubar")
    assert f.text is None
    assert not f.is_constant
    assert_array_equal(f(U, V), np.sin(2 * U) / V)
    series = f(Series.variable(U, 2), V)
    assert_allclose(series.derivatives()[1], 2 * np.cos(2 * U) / V)
    assert_allclose(f.partials(U, V)[1], -np.sin(2 * U) / V**2)


def test_python_function_may_return_a_plain_number() -> None:
    assert field(lambda u, v: 3)(Series.variable(U, 2), V) == 3.0


def test_python_function_of_one_variable_may_return_an_array_beside_a_series() -> None:
    f = field(lambda u, v: np.cos(v))
    assert_array_equal(f(Series.variable(U, 2), V), np.cos(V))


def test_python_functions_are_equal_only_to_themselves() -> None:
    def function(u: float, v: float) -> float:
        return u

    first = field(function)
    assert first == first
    assert first != field(function)
    assert len({first, field(function)}) == 2


@pytest.mark.parametrize(
    "function",
    [
        lambda u, v: math.sin(u),
        lambda u, v: u if u > 0 else v,
        lambda u: u,
        lambda u, v: None,
        lambda u, v: 1j,
        lambda u, v: [u, v],
        lambda u, v: "u",
        lambda u, v: u.coefficients[0],
        lambda u, v: 1 / 0,
    ],
)
def test_python_function_that_fails_is_named_with_the_remedy(function: object) -> None:
    with pytest.raises(
        GeometryError, match=r"^`ubar`: the Python function .*numpy's functions"
    ) as e:
        field(function, "ubar")(Series.variable(U, 2), Series.variable(V, 2))
    assert "\n" not in str(e.value)


# -- numbers ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [("3*pi/8", 3 * PI / 8), (" -2.5 ", -2.5), ("sqrt(2)/2", math.sqrt(0.5)), ("1e-3", 0.001)],
)
def test_number(text: str, value: float) -> None:
    assert number(text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(("text", "position"), [("2*u", 2), ("0*v + 1", 2), ("1/0", 0), ("", 0)])
def test_number_refuses(text: str, position: int) -> None:
    with pytest.raises(FormulaError, match=r"^`u0`: ") as caught:
        number(text, "u0")
    assert caught.value.position == position


def test_number_refuses_what_is_not_text() -> None:
    with pytest.raises(GeometryError, match=r"^`u0` must be typed text; got 3;"):
        number(3, "u0")  # type: ignore[arg-type]


NAMED = {
    "0": -0.0,
    "2": 2.0,
    "-17": -17,
    "0.1": 0.1,
    "pi": PI,
    "-pi/2": -PI / 2,
    "3*pi/8": 3 * PI / 8,
    "2*pi/3": 2 * PI / 3,
    "-5*pi/24": -5 * PI / 24,
    "6*pi": 6 * PI,
    "1e+300": 1e300,
}


@pytest.mark.parametrize("text", NAMED)
def test_named_number(text: str) -> None:
    assert named_number(NAMED[text]) == text


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_named_number_gives_back_the_same_float(value: float) -> None:
    assert number(named_number(value)) == value


@given(st.integers(-48, 48), st.integers(1, 24), st.sampled_from([0, 1, -1]))
def test_named_number_near_a_fraction_of_pi(above: int, below: int, steps: int) -> None:
    value = above * (PI / below)
    if steps:
        value = math.nextafter(value, steps * math.inf)
    assert number(named_number(value)) == value


@pytest.mark.parametrize("value", [math.nan, math.inf, 10**400, "2", None, True])
def test_named_number_refuses(value: object) -> None:
    with pytest.raises(GeometryError, match=r"^`u0` must be"):
        named_number(value, "u0")
