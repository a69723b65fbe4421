"""What a student may write for a number, an array or a formula, and what is said to the rest."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from ruledlab.exercises.answers import read_formula, read_numbers
from ruledlab.geometry import Dual, FormulaError, GeometryError
from ruledlab.geometry.written import in_formula_notation, without_label

PI = math.pi

# -- numbers as people write them ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3·π/8", 3 * PI / 8),
        ("3×π/8", 3 * PI / 8),
        ("3π÷8", 3 * PI / 8),
        ("3π⁄8", 3 * PI / 8),
        ("3/8 π", 3 * PI / 8),
        ("(3/8)π", 3 * PI / 8),
        ("½π", PI / 2),
        ("-2π+0.1672", -2 * PI + 0.1672),
        ("−2π + 0.1672", -2 * PI + 0.1672),
        ("–1", -1),
        ("√2/2", math.sqrt(0.5)),
        ("√(2)/2", math.sqrt(0.5)),
        ("2√2", 2 * math.sqrt(2)),
        ("1/√2", math.sqrt(0.5)),
        ("2^3", 8),
        ("2^-1", 0.5),
        ("2²", 4),
        ("117.81×10⁻²", 1.1781),
        ("1e−3", 1e-3),
        ("10^(-3)", 1e-3),
        ("e^2", math.e**2),
        ("2(1+2)", 6),
        ("(1+2)(3+4)", 21),
        ("2sqrt(2)", 2 * math.sqrt(2)),
        ("ln(2)", math.log(2)),
        ("np.pi/2", PI / 2),
        ("np.sqrt(2)*math.cos(0)", math.sqrt(2)),
        ("１.５", 1.5),
        ("١.5", 1.5),
        ("1.5\u200b", 1.5),
        ("\u00a01.5\n", 1.5),
        ("κ(0) = 1.5", 1.5),
        ("x = -1.5", -1.5),
        ("l ≈ 1.5", 1.5),
        ("= 1.5", 1.5),
        ("'1.5'", 1.5),
        ("`3π/8`", 3 * PI / 8),
        ("$1.5$", 1.5),
        ("1.5;", 1.5),
        ("[1.5]", 1.5),
        ([1.5], 1.5),
        (np.array([[1.5]]), 1.5),
    ],
)
def test_a_number_is_read_as_it_is_written(text: object, value: float) -> None:
    read = read_numbers(text)
    assert read.shape == ()
    assert float(read) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("0,5", "0.5 with a decimal point"),
        ("1.000,5", "no mark between thousands"),
        ("1,234.5", "no mark between thousands"),
        ("1'000", "no mark between thousands"),
        ("67.5°", "radians"),
        ("67.5 deg", "radians"),
        ("67.5 degrees", "radians"),
        ("cos(30°)", "radians"),
        (r"\frac{3\pi}{8}", "TeX"),
        (r"$\sqrt2$", "TeX"),
        ("3/8π", r"two ways at column 4; write 1/\(2\*π\) or \(1/2\)\*π"),
        ("π/2sqrt(2)", "two ways"),
        ("sqrt 2", r"write sqrt\(2\)"),
        ("π π", "no operator"),
        ("1 1781", "no operator"),
        ("1j", "real numbers"),
        ("2 == 2", "compare"),
        ("1 = 2", "right-hand side"),
        ("[1, 2", "closed"),
        ("2*[1, 2]", "one by one"),
        ("[1,,2]", "between two commas"),
        ("1e400", "finite"),
        ("10**10**10", "finite"),
        ("__import__('os').system('true')", "unknown function"),
        (b"12", "bytes"),
        (10**400, "too large"),
        ([1, 10**400], "numbers"),
        (np.array([1 + 0j]), "complex"),
        ([1, 2j], "complex"),
        ([[[[[[1]]]]]], "too deep"),
        ([np.array(1), np.array([1, 2])], "equal length"),
        (iter([1]), "iterator"),
    ],
)
def test_a_number_that_cannot_be_read_is_refused_with_a_remedy(text: object, says: str) -> None:
    with pytest.raises(GeometryError, match=says) as caught:
        read_numbers(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("unit", "texts"),
    [
        ("rad", ("2 rad", "2rad", "2 radians", "2")),
        ("length", ("2 length", "2 lengths", "2 units of length", "2 units")),
        ("length per t", ("2 length per t", "2 length", "2")),
        ("1/length²", ("2 1/length²", "2 1/length^2", "2")),
        ("", ("2", "2 rad", "2 radians")),
    ],
)
def test_the_unit_may_stand_behind_the_number(unit: str, texts: tuple[str, ...]) -> None:
    for text in texts:
        assert read_numbers(text, (), unit) == 2, text
    assert read_numbers("π rad", (), "rad") == pytest.approx(PI)
    np.testing.assert_array_equal(read_numbers("(1, 2) length", (2,), "length"), [1, 2])


def test_another_unit_is_not_taken_for_the_right_one() -> None:
    with pytest.raises(GeometryError, match="asked for in the unit “length”, and this is in"):
        read_numbers("2 rad", (), "length")
    for text, unit in (("2 lengths", "rad"), ("2 length", "1/length²"), ("2 rad", "1/length²")):
        with pytest.raises(GeometryError, match="convert it"):
            read_numbers(text, (), unit)


# -- arrays ----------------------------------------------------------------------------------------

VECTOR = [1.0, -2.0, PI]
VECTORS = (
    "[1, -2, π]",
    "1, -2, π",
    "(1; -2; pi)",
    "[1; -2; pi;]",
    "{1, -2, pi}",
    "⟨1, −2, π⟩",
    "<1, -2, pi>",
    "(1 | -2 | pi)",
    "1 -2 pi",
    "[1 -2 π]",
    "[ 1.          -2.          3.14159265358979]",
    "1\n-2\nπ",
    "1\t-2\tπ",
    "array([1., -2., pi])",
    "np.array([1, -2, np.pi])",
    "numpy.array([1, -2, pi], dtype=float)",
    "Matrix([1, -2, pi])",
    "tuple([1, -2, pi])",
    "[[1], [-2], [pi]]",
    "[[1, -2, pi]]",
    "(1, -2, pi)^T",
    "[1, -2, pi].T",
    "x = (1, -2, π)",
    "[a, b, c] = [1, -2, π]",
    [1, -2, PI],
    (1, "-2", "π"),
    np.array(VECTOR),
    np.array(VECTOR)[:, np.newaxis],
    np.array([VECTOR]),
    np.array(VECTOR, dtype=object),
    np.array(["1", "-2", "3.141592653589793"]),
    sympy.Matrix([1, -2, sympy.pi]),
    [sympy.Integer(1), sympy.Rational(-4, 2), sympy.pi],
)


@pytest.mark.parametrize("answer", VECTORS, ids=[str(v)[:24] for v in VECTORS])
def test_a_vector_may_be_written_in_many_ways(answer: object) -> None:
    np.testing.assert_allclose(read_numbers(answer, (3,)), VECTOR, rtol=1e-12)


@pytest.mark.parametrize(
    "text", ["[[1, 2], [3, 4]]", "[1, 2; 3, 4]", "[1 2; 3 4]", "[[1. 2.]\n [3. 4.]]", "1 2; 3 4"]
)
def test_a_matrix_may_be_written_in_many_ways(text: str) -> None:
    np.testing.assert_array_equal(read_numbers(text, (2, 2)), [[1, 2], [3, 4]])


def test_a_difference_with_spaces_is_one_entry() -> None:
    np.testing.assert_array_equal(read_numbers("[3 - 2, 2 -1]", (2,)), [1, 1])
    np.testing.assert_array_equal(read_numbers("[3 - 2 2 - 1]", (2,)), [1, 1])


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("2 + 3ε", [2, 3]),
        ("2-3eps", [2, -3]),
        ("ε", [0, 1]),
        ("4 + 0 ε", [4, 0]),
        ("(2+3ε)(1-ε)", [2, 1]),
        ("sin(π/2 + 2ε)", [1, 0]),
        ("(2 + ε)²", [4, 4]),
        ("f + ε f′ = 3 + 2*epsilon", [3, 2]),
        ("[2, 3]", [2, 3]),
        (Dual(2.0, 3.0), [2, 3]),
    ],
)
def test_a_dual_number_may_be_written_with_epsilon(text: object, parts: list[float]) -> None:
    np.testing.assert_allclose(read_numbers(text, (2,)), parts, atol=1e-12)


def test_a_dual_number_that_cannot_be_read() -> None:
    with pytest.raises(FormulaError, match="known are ε, pi") as caught:
        read_numbers("2 + 3 εε + x ε", (2,))
    assert caught.value.position == "2 + 3 εε + x ε".index("x")
    with pytest.raises(GeometryError, match="finite"):
        read_numbers("sqrt(-1 + ε)", (2,))


# -- formulas --------------------------------------------------------------------------------------

T = np.linspace(0.1, 0.9, 7)
IN_T: tuple[tuple[object, Callable[[Any], Any]], ...] = (
    ("6t(1-t)+8t^2", lambda t: 6 * t * (1 - t) + 8 * t**2),
    ("6 t (1 − t) + 8·t²", lambda t: 6 * t * (1 - t) + 8 * t**2),
    ("u(t) = 2t(t+3)", lambda t: 2 * t * (t + 3)),
    ("(1+t)(1-t)", lambda t: 1 - t**2),
    ("t(2)", lambda t: 2 * t),
    ("t½", lambda t: t / 2),
    ("2 sin(t) cos(t)", lambda t: np.sin(2 * t)),
    ("2sin(t)cos(t)", lambda t: np.sin(2 * t)),
    ("sin²(t) + cos^2(t)", lambda t: 1 + 0 * t),
    ("sin(t)^2", lambda t: np.sin(t) ** 2),
    ("sin²(3t(1+t))", lambda t: np.sin(3 * t * (1 + t)) ** 2),
    ("e^(2t)", lambda t: np.exp(2 * t)),
    ("e^{2t}", lambda t: np.exp(2 * t)),
    ("e^t", np.exp),
    ("√t", np.sqrt),
    ("2√(1+t)", lambda t: 2 * np.sqrt(1 + t)),
    ("t⁻²", lambda t: t**-2.0),
    ("1/2 t", lambda t: t / 2),
    ("1/(2t)", lambda t: 1 / (2 * t)),
    ("1/t + 2t", lambda t: 1 / t + 2 * t),
    ("t/2*3t", lambda t: t / 2 * 3 * t),
    ("ln(t)", np.log),
    ("πt", lambda t: PI * t),
    ("tπ", lambda t: PI * t),
    ("np.sin(2*t)", lambda t: np.sin(2 * t)),
    (lambda t: math.sin(2 * t), lambda t: np.sin(2 * t)),
    (lambda t: 2 * t if t > 0 else 0, lambda t: 2 * t),
    (lambda t: float(2 * t), lambda t: 2 * t),
    (lambda t: [2 * x for x in t], lambda t: 2 * t),
    (lambda t: 3, lambda t: 3 + 0 * t),
    (2.5, lambda t: 2.5 + 0 * t),
    (np.poly1d([2, 0, 1]), lambda t: 2 * t**2 + 1),
    (sympy.sin(sympy.Symbol("t")) ** 2, lambda t: np.sin(t) ** 2),
)


@pytest.mark.parametrize(("answer", "value"), IN_T, ids=[str(a)[:24] for a, _ in IN_T])
def test_a_formula_is_read_as_it_is_written(answer: object, value: Callable[[Any], Any]) -> None:
    np.testing.assert_allclose(read_formula(answer, ("t",))(T), value(T), rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("uv", lambda u, v: u * v),
        ("2u v", lambda u, v: 2 * u * v),
        ("sin(u)cos(v)", lambda u, v: np.sin(u) * np.cos(v)),
        ("½(sin(u+v) + sin(u−v))", lambda u, v: np.sin(u) * np.cos(v)),
        ("v̄ = u cos(v)/sin(v)", lambda u, v: u * np.cos(v) / np.sin(v)),
    ],
)
def test_a_formula_in_two_letters(text: str, value: Callable[[Any, Any], Any]) -> None:
    u, v = np.meshgrid(T, T + 1)
    np.testing.assert_allclose(read_formula(text, ("u", "v"))(u, v), value(u, v), rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("1/2t", r"two ways at column 4; write 1/\(2\*t\) or \(1/2\)\*t"),
        ("e^2t", r"two ways at column 4; write e\*\*\(2\*t\) or e\*\*2\*t"),
        ("1/sin(t)cos(t)", "two ways"),
        ("sin^-1(t)", r"write arcsin\(…\) or 1/sin"),
        ("sin⁻¹(t)", r"write arcsin\(…\) or 1/sin"),
        ("sin t", r"write sin\(t\)"),
        ("2t + w", "unknown name 'w' at column 6"),
        ("6t(1−t) + 8t^", "column 13"),
        ("2u", "'u' is not meant here at column 2; write a formula in t"),
        ("t.__class__", "cannot be used"),
        ([1, 2], r"type list; give a formula as text, such as '2\*t'"),
        (True, "type bool"),
        (lambda: 0, "the function of t failed"),
        (lambda t: "a", "gives 'a', no number"),
        (lambda t: None, "gives None, no number"),
        (lambda t: 2j * t, "no number"),
        (lambda t: np.ones((7, 2)), "no number"),
    ],
)
def test_a_formula_that_cannot_be_read_is_refused_with_a_remedy(text: object, says: str) -> None:
    with pytest.raises(GeometryError, match=says) as caught:
        read_formula(text, ("t",))(T)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("before", ["6t(1−t) + ", "2²·", "u(t) = sin²(t) + ", "√2 t + ½", "  '3t"])
def test_an_error_points_into_what_was_typed(before: str) -> None:
    text = before + " banana" + ("'" if "'" in before else "")
    with pytest.raises(FormulaError, match="banana") as caught:
        read_formula(text, ("t",))
    place = text.index("banana")
    assert caught.value.text == text
    assert caught.value.position == place
    assert f"at column {place + 1}" in caught.value.message
    shown, caret = caught.value.pointer().splitlines()
    assert shown.index("banana") == caret.index("^")


# A formula twice: for Python, and as people write it
atoms = st.sampled_from(
    [("t", "t"), ("2", "2"), ("pi", "π"), ("sin(t)", "sin(t)"), ("t**2", "t²"), ("sqrt(2)", "√2")]
)


def combined(parts: st.SearchStrategy[tuple[str, str]]) -> st.SearchStrategy[tuple[str, str]]:
    pairs = st.tuples(parts, parts)
    return st.one_of(
        pairs.map(lambda p: (f"({p[0][0]})*({p[1][0]})", f"({p[0][1]})({p[1][1]})")),
        pairs.map(lambda p: (f"({p[0][0]}) + ({p[1][0]})", f"({p[0][1]}) + ({p[1][1]})")),
        pairs.map(lambda p: (f"({p[0][0]}) - ({p[1][0]})", f"({p[0][1]})−({p[1][1]})")),
        pairs.map(lambda p: (f"2*({p[0][0]})*({p[1][0]})", f"2({p[0][1]})·({p[1][1]})")),
        parts.map(lambda p: (f"cos({p[0]})**2", f"cos²({p[1]})")),
        parts.map(lambda p: (f"({p[0]})**2", f"({p[1]})^2")),
    )


@given(st.recursive(atoms, combined, max_leaves=6))
def test_both_notations_mean_the_same(pair: tuple[str, str]) -> None:
    plain, written = pair
    np.testing.assert_allclose(
        read_formula(written, ("t",))(T), read_formula(plain, ("t",))(T), rtol=1e-12
    )


@given(st.text(max_size=60), st.sampled_from([(), ("t",), ("u", "v"), ("ε",)]))
def test_each_character_keeps_its_place(text: str, variables: tuple[str, ...]) -> None:
    try:
        begin, end = without_label(text)
        written = in_formula_notation(text, variables, (begin, end))
    except GeometryError:
        return
    assert 0 <= begin <= end <= len(text) or not text.strip()
    assert len(written.places) == len(written.text)
    assert all(0 <= place < max(len(text), 1) + 2 for place in written.places)


@given(st.text("0123456789+-*/^().,;|[]{}<> tuvepiε=√½²π·'x", max_size=30))
def test_whatever_is_typed_in_mathematics_is_read_or_refused(text: str) -> None:
    for shape in ((), (2,), (3,), (2, 2)):
        try:
            assert np.isfinite(read_numbers(text, shape, "length")).all()
        except GeometryError as error:
            assert "\n" not in str(error)
    for variables in (("u", "v"), ("t",)):
        try:
            read_formula(text, variables)(*(T for _ in variables))
        except GeometryError as error:
            assert "\n" not in str(error)


class _Hostile:
    def __array__(self, *_: object, **__: object) -> Any:
        raise RuntimeError("one\ntwo")


_cycle: list[Any] = [1]
_cycle.append(_cycle)
HOSTILE = {
    "a megabyte": "1" * 10**6,
    "open brackets": "(" * 1999,
    "square brackets": "[" * 999 + "1" + "]" * 999,
    "many lists": "[" * 600 + "]" * 600,
    "minus signs": "-" * 1999,
    "commas": "," * 1999,
    "semicolons": ";" * 1999,
    "spaces": "1 " * 999,
    "spaces and brackets": "(1 " * 600,
    "roots": "√" * 1999,
    "raised": "2" + "⁹" * 1900,
    "powers": "9**" * 600 + "9",
    "hats": "9^" * 900 + "9",
    "label": "x" * 1900 + "=1",
    "equals": "=" * 1999,
    "quotes": "'" * 1999,
    "units": " rad" * 499,
    "array of array": "array(" * 300 + ")" * 300,
    "epsilons": "ε" * 1999,
    "parts": "½" * 1999,
    "an object": _Hostile(),
    "objects": [_Hostile(), 1],
    "a list in itself": _cycle,
    "a long list": ["1"] * 2000,
    "a long number": 10**5000,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_nothing_hangs_or_breaks(name: str) -> None:
    began = time.perf_counter()
    for shape in ((), (2,), (3,)):
        try:
            read_numbers(HOSTILE[name], shape, "rad")
        except GeometryError as error:
            assert len(str(error)) < 400
            assert "\n" not in str(error)
    try:
        read_formula(HOSTILE[name], ("t",))(T)
    except GeometryError as error:
        assert "\n" not in str(error)
    assert time.perf_counter() - began < 1.0
