"""Typed vector functions of t: what they give, and what is said where they cannot be read."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ruledlab.geometry import FormulaError, GeometryError, RuledSurface, Series, Vector, vector

numbers = st.floats(-4, 4)


@given(numbers, numbers)
def test_the_components_are_those_of_the_formulas(t: float, a: float) -> None:
    found = vector("cos(t), a*sin(2*t), arctan2(t, 2) - a", a=a)(t)
    expected = (math.cos(t), a * math.sin(2 * t), math.atan2(t, 2) - a)
    np.testing.assert_allclose(found, expected, atol=1e-14)


@given(numbers)
def test_a_series_comes_out_with_its_derivatives(t: float) -> None:
    curve = vector("sin(t), a*t**3, 5", a=2.0)(Series.variable(np.array([t]), 2))
    rows = [component.derivatives()[:, 0] for component in curve[:2]]
    np.testing.assert_allclose(rows[0], [math.sin(t), math.cos(t), -math.sin(t)], atol=1e-14)
    np.testing.assert_allclose(rows[1], [2 * t**3, 6 * t**2, 12 * t], atol=1e-12)
    assert curve[2] == 5.0


@given(numbers, st.floats(0.1, 3))
def test_a_typed_surface_is_that_of_the_functions(t: float, a: float) -> None:
    typed = RuledSurface.from_base(vector("cos(t), t, a", a=a), vector("t, a, sin(t)", a=a))
    coded = RuledSurface.from_base(lambda t: (np.cos(t), t, a), lambda t: (t, a, np.sin(t)))
    for name in ("kappa", "kappa_bar", "tau", "tau_bar"):
        first, second = (getattr(s.invariants(t), name) for s in (typed, coded))
        np.testing.assert_allclose(first, second, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    "text", ["(cos(t), 2*t, 1)", " ( cos(t) , 2*t , 1 ) ", "(cos(t)), 2*t, (1)", "cos(t), 2*t, 1"]
)
def test_brackets_about_the_whole_are_no_part_of_it(text: str) -> None:
    assert vector(text)(0.5) == vector("cos(t), 2*t, 1")(0.5)
    assert vector(text).text == text


def test_equal_texts_are_equal_vectors() -> None:
    assert vector("t, a, 1", a=2.0) == vector("t, a, 1", a=2.0) != vector("t, a, 1", a=3.0)
    assert vector("t, 0, 1").text == "t, 0, 1"
    assert isinstance(vector("t, 0, 1"), Vector)


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("cos(t), sin(x), 1", 12, "unknown name 'x' at column 13; known are t, a, pi"),
        ("t, t+, 1", 4, "nothing follows '+' at column 5; write a number or t after it"),
        ("t, 2t, 1", 4, "no operator between '2' and 't' at column 5; write 2*t"),
        ("t, u, 1", 3, "unknown name 'u' at column 4; write a formula in t"),
        ("0, 0, v**2", 6, "unknown name 'v' at column 7; write a formula in t"),
        ("t,,1", 2, "a formula is missing at column 3; write a formula in t"),
        ("t, (1, 2), 3", 5, "column 6"),
        ("(t, 2*x, 1)", 6, "unknown name 'x' at column 7"),
    ],
)
def test_a_formula_that_cannot_be_read_tells_the_place(text: str, place: int, says: str) -> None:
    with pytest.raises(FormulaError) as caught:
        vector(text, "base")
    assert says in str(caught.value)
    assert (caught.value.position, caught.value.text) == (place, text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: vector("t, 1", "base"), "`base` must be three formulas .* got 2; write"),
        (lambda: vector(""), "`vector` must be three formulas .* got 1"),
        (lambda: vector("1, 2, 3, 4"), "got 4"),
        (lambda: vector(5, "base"), "`base` must be a text of three formulas in t; got int"),  # type: ignore[arg-type]
        (lambda: vector("t, t, a", a=math.nan), "`a` must"),
        (lambda: vector("t, t, a", a=[1, 2]), "`a` must be one number"),  # type: ignore[arg-type]
    ],
)
def test_what_is_no_vector_is_refused(make: object, says: str) -> None:
    with pytest.raises(GeometryError, match=says):
        make()  # type: ignore[operator]
