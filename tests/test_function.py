"""Typed functions of x and their values at dual numbers, against SymPy, Series and plain reals."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from ruledlab.geometry import Dual, FormulaError, GeometryError, Series, function

SMOOTH = (
    "x**2",
    "x**3 - x",
    "sin(x)",
    "cos(x)",
    "exp(x)",
    "x*sin(x)",
    "exp(-x**2)",
    "sin(x**2)/(1 + x**2)",
    "arctan2(x, 2)",
    "tanh(3*x) - 2",
    "sqrt(1 + x**2)",
    "log(2 + cos(x))",
    "7",
)
reals = st.floats(-3, 3)


def in_sympy(text: str, x: sympy.Symbol) -> sympy.Expr:
    names = {"arctan2": sympy.atan2, "abs": sympy.Abs, "x": x}
    return sympy.sympify(text, locals=names)


@pytest.mark.parametrize("text", SMOOTH)
def test_the_dual_part_is_the_derivative_that_sympy_finds(text: str) -> None:
    x = sympy.Symbol("x", real=True)
    formula = in_sympy(text, x)
    for place in (-2.3, -0.5, 0.0, 0.7, 1.9):
        at = {x: sympy.Float(place, 30)}
        value, slope = (float(e.subs(at)) for e in (formula, sympy.diff(formula, x)))
        lifted = function(text).lifted(place, -0.8)
        assert lifted.undefined == ""
        assert float(lifted.value.real) == pytest.approx(value, abs=1e-13)
        assert lifted.slope == pytest.approx(slope, abs=1e-12)
        assert float(lifted.value.dual) == pytest.approx(-0.8 * slope, abs=1e-12)


@pytest.mark.parametrize("text", SMOOTH[:-1])
@given(place=reals)
def test_the_slope_is_that_of_the_taylor_series(text: str, place: float) -> None:
    f = function(text)
    expected = f(Series.variable(place, 1)).derivatives()[1]
    assert f.lifted(place, 1.0).slope == pytest.approx(float(expected), rel=1e-11, abs=1e-11)


@given(reals, st.floats(-1, 1), st.floats(-5, 5))
def test_the_dual_part_is_linear_in_x_bar(x: float, x_bar: float, factor: float) -> None:
    f = function("exp(sin(x))*x")
    one, many = f(Dual(x, x_bar)).dual, f(Dual(x, factor * x_bar)).dual
    assert many == pytest.approx(factor * one, rel=1e-12, abs=1e-12)


def test_numbers_arrays_and_constants() -> None:
    x = np.linspace(-1, 1, 5)
    np.testing.assert_allclose(function("x**2")(x), x**2)
    np.testing.assert_array_equal(function("7")(x), np.full(5, 7.0))
    assert function("7")(0.3) == 7
    constant = function("pi")(Dual(x, 1.0))
    np.testing.assert_array_equal(constant.real, np.full(5, math.pi))
    np.testing.assert_array_equal(np.broadcast_to(constant.dual, 5), np.zeros(5))


# -- where there is no value -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "x", "says"),
    [
        ("log(x)", -1.0, "no real number at x = −1"),
        ("sqrt(x)", -0.5, "no real number at x = −0.5"),
        ("log(x)", 0.0, "not finite at x = 0"),
        ("exp(exp(exp(x)))", 3.0, "not finite"),
        ("1/x", 0.0, "pure dual number"),
        ("x/(x**2 - 1)", 1.0, "zero divisor"),
        ("sqrt(x)", 0.0, "the tangent is vertical"),
        ("arcsin(x)", 1.0, "the tangent is vertical"),
        ("abs(x)", 0.0, "no single tangent"),
        ("abs(x - 1)", 1.0, "no single tangent"),
    ],
)
@pytest.mark.parametrize("x_bar", [0.5, -0.5, 0.0])
def test_what_is_undefined_is_named(text: str, x: float, says: str, x_bar: float) -> None:
    assert says in function(text).lifted(x, x_bar).undefined


def test_beside_a_corner_and_a_pole_there_is_a_slope() -> None:
    assert function("abs(x)").lifted(-1e-9, 1.0).slope == -1
    assert function("1/x").lifted(0.5, 1.0).slope == -4
    assert function("log(x)").lifted(0.5, 3.0).value.dual == 6


def test_a_pure_dual_number_has_no_inverse() -> None:
    with pytest.raises(GeometryError, match="zero divisor"):
        function("1/x")(Dual(0.0, 1.0))
    assert function("1/x")(0.0) == math.inf


# -- reading ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "position", "says"),
    [
        ("x^2", 1, r"write \*\* for a power"),
        ("2x", 1, r"write 2\*x"),
        ("x +", 2, r"write a number or x after it"),
        ("exp x", 0, r"write exp\(x\)"),
        ("1 + u", 4, "'u' is not the variable, at column 5; write x"),
        ("sin(v)", 4, "'v' is not the variable"),
        ("X", 0, "write x"),
        ("sin(theta)", 4, "write x"),
        ("", 0, r"such as x\*\*2 - 1"),
        ("foo(x)", 0, "known are x, pi"),
        ("x²", 1, r"write \*\*2"),
    ],
)
def test_a_formula_that_cannot_be_read_knows_the_place(text: str, position: int, says: str) -> None:
    with pytest.raises(FormulaError, match=says) as caught:
        function(text)
    assert caught.value.position == position
    assert caught.value.text == text


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused_without_speaking_of_u_and_v(text: str) -> None:
    try:
        made = function(text)
    except FormulaError as error:
        assert "\n" not in str(error)
        assert "u, v" not in error.message
        assert " u - v" not in error.message
    else:
        float(made(0.5))


def test_what_is_no_text() -> None:
    with pytest.raises(GeometryError, match="got int"):
        function(2)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "latex"),
    [("x**2", "x^{2}"), ("exp(-x)/x", r"\frac{\mathrm{e}^{-x}}{x}"), ("2*x", "2 x")],
)
def test_typesetting_is_in_x(text: str, latex: str) -> None:
    assert function(f" {text} ").latex == latex
    assert function(f" {text} ").text == text
