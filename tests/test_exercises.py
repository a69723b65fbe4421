"""Exercises: reading answers, judging every kind, misconceptions by name, values by seed."""

from __future__ import annotations

import ast
import contextlib
import functools
import json
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ruledlab.design import Design
from ruledlab.exercises import check, core, misconceptions, shape
from ruledlab.exercises.answers import read_formula, read_numbers
from ruledlab.exercises.core import (
    Choose,
    Code,
    Drag,
    Draw,
    Exercise,
    FindSlip,
    Formula,
    Line,
    Misconception,
    Number,
    Option,
    Place,
    Sketch,
    Task,
    Verdict,
    find,
    lesson,
    lessons,
    made,
)
from ruledlab.exercises.record import kept
from ruledlab.exercises.store import Store
from ruledlab.geometry import Dual, GeometryError, RuledSurface, gallery, trajectory, vector
from ruledlab.geometry.curve import Bezier, drag
from ruledlab.geometry.line import Line as OrientedLine
from ruledlab.pair import OneLine, TwoLines

PACKAGE = Path(core.__file__).parent
SEEDS = ("", "1", "Ada", "Σ", "a very long name " * 20)
EVERY = [(e, seed) for number in lessons() for e in lesson(number) for seed in SEEDS]
NONSENSE = (
    "",
    "   ",
    "banana",
    "3 +",
    "[1, [2",
    "π π π π π π π",
    "None",
    "1/0",
    "__import__('os')",
    "#" * 5000,
)

every = pytest.mark.parametrize(
    ("exercise", "seed"), EVERY, ids=[f"{e.key}-{seed[:4]}" for e, seed in EVERY]
)


def number(answer: object, **more: object) -> Number:
    return Number(question="", solution="", answer=answer, **more)  # type: ignore[arg-type]


def formula(answer: str, **more: object) -> Formula:
    return Formula(question="", solution="", answer=answer, **more)  # type: ignore[arg-type]


# -- every exercise there is -----------------------------------------------------------------------


@every
def test_its_own_answer_is_right_and_another_is_wrong(exercise: Exercise, seed: str) -> None:
    task = exercise.task(seed)
    assert task.judge(task.right_answer()).right
    wrong = task.judge(task.wrong_answer())
    assert wrong.state == "wrong"
    assert len(wrong.word) > 10, "it has to say what is off"


@every
def test_nonsense_gets_a_word_and_does_not_count(exercise: Exercise, seed: str) -> None:
    task = exercise.task(seed)
    for answer in (*NONSENSE, None, ..., 1j, object(), {}, [], True, math.nan, [math.inf]):
        verdict = task.judge(answer)
        if task.kind == "code" and isinstance(answer, str) and verdict.state == "wrong":
            continue  # a text that is a number after all
        assert verdict.state == "unread", (answer, verdict)
        assert 10 < len(verdict.word) < 400
        assert "\n" not in verdict.word


MANY = tuple(map(str, range(40)))
COSTLY = {"04.8": 6, "04.9": 6, "07.8": 6, "08.4": 6, "08.11": 10}
"""Exercises that search or integrate a surface for each answer, and how many seeds are enough."""

MAY_BE_ZERO = {"02.7"}
"""Where the answer is a height, 0 is as good as any: no slip has the opposite sign."""

each = pytest.mark.parametrize(
    "exercise", [e for number in lessons() for e in lesson(number)], ids=lambda e: e.key
)


@functools.cache
def tasks(exercise: Exercise) -> tuple[tuple[str, Task], ...]:
    """Return the exercise for many students: seed and task."""
    return tuple((seed, exercise.task(seed)) for seed in MANY[: COSTLY.get(exercise.key)])


def parts(task: Task) -> Iterator[tuple[Task, Callable[[Any], Verdict]]]:
    """Return the task, and the correction a slip asks for, each with what judges it."""
    yield task, task.judge
    if isinstance(task, FindSlip):
        line = task.wrong_line
        yield task.then, lambda answer: task.judge({"line": line, "then": answer})


@each
def test_every_slip_is_wrong_and_known_by_its_own_name(exercise: Exercise) -> None:
    for seed, task in tasks(exercise):
        for part, judge in parts(task):
            assert judge(part.right_answer()).right, (seed, "the right answer")
            for slip in getattr(part, "slips", ()):
                verdict = judge(slip.example)
                assert (verdict.state, verdict.slip) == ("wrong", slip.name), (seed, slip.name)


@each
def test_options_differ_and_one_is_right(exercise: Exercise) -> None:
    for seed, task in tasks(exercise):
        for part, judge in parts(task):
            options = getattr(part, "options", ())
            assert len({option.text for option in options}) == len(options), seed
            for index, option in enumerate(options):
                verdict = judge(index)
                assert (verdict.right, verdict.slip) == (option.right, option.slip), seed


@each
def test_no_number_to_predict_is_zero_by_chance(exercise: Exercise) -> None:
    if exercise.key in MAY_BE_ZERO:
        return
    for seed, task in tasks(exercise):
        for part, _ in parts(task):
            if isinstance(part, Number):
                assert np.any(np.asarray(part.answer, dtype=float)), (seed, "0 has no sign")


@every
def test_questions_hints_and_solutions_are_there(exercise: Exercise, seed: str) -> None:
    task = exercise.task(seed)
    assert task.question
    assert 1 <= len(task.hints) <= 3
    assert task.solution
    for text in (task.question, task.solution, *task.hints):
        assert text.count("$") % 2 == 0, text
        assert text.count("{") == text.count("}"), text


@every
def test_the_same_seed_gives_the_same_values(exercise: Exercise, seed: str) -> None:
    first, again = exercise.task(seed), exercise.task(seed)
    assert (first.question, first.solution) == (again.question, again.solution)
    assert repr(first.right_answer()) == repr(again.right_answer())


def test_values_vary_with_the_seed() -> None:
    varied = [e for e in lesson("06") if len({_values(e.task(str(s))) for s in range(4)}) > 1]
    assert len(varied) >= 10


def _values(task: Task) -> str:
    order = task.order if isinstance(task, Choose) else ()
    then = task.then.right_answer() if isinstance(task, FindSlip) else ""
    return f"{task.question}{order}{then}{task.right_answer()}"


def test_there_are_two_of_each_kind() -> None:
    kinds = [e.task().kind for e in lesson("06")]
    for kind in ("choose", "number", "formula", "drag", "sketch", "code", "slip"):
        assert kinds.count(kind) >= 2, kind


def test_exercises_are_found_by_number_and_others_refused() -> None:
    assert find("06.1").key == "06.1"
    assert [e.key for e in lesson("06")] == [f"06.{n}" for n in range(1, len(lesson("06")) + 1)]
    assert lesson("6") == lesson("06")
    for wrong in ("06.99", "99.1", "", "x", "06"):
        with pytest.raises(GeometryError, match="must be"):
            find(wrong)


# -- the numbers of lesson 06, by another route ----------------------------------------------------


def test_the_torsion_that_is_called_right_is_the_determinant() -> None:
    task = find("06.14").task()
    assert isinstance(task, FindSlip)
    assert isinstance(task.then, Choose)
    u, v, t = sympy.Function("u"), sympy.Function("v"), sympy.Symbol("t")
    x = sympy.Matrix(
        [sympy.cos(u(t)) * sympy.sin(v(t)), sympy.sin(u(t)) * sympy.sin(v(t)), sympy.cos(v(t))]
    )
    determinant = sympy.Matrix.hstack(x, x.diff(t), x.diff(t, 2)).det()
    du, dv, ddu, ddv = u(t).diff(t), v(t).diff(t), u(t).diff(t, 2), v(t).diff(t, 2)
    rest = sympy.cos(v(t)) * (du**3 * sympy.sin(v(t)) ** 2 + 2 * du * dv**2)
    brackets = {
        r"(u''v'-u'v'')": ddu * dv - du * ddv,
        r"(u'v''-u''v')": du * ddv - ddu * dv,
        r"(u'v''+u''v')": du * ddv + ddu * dv,
    }
    for option in task.then.options:
        tex, bracket = next((k, b) for k, b in brackets.items() if k in option.text)
        sign = -1 if r"-\sin v\," + tex in option.text else 1
        difference = determinant - rest - sign * sympy.sin(v(t)) * bracket
        path = {u(t): 1 + 2 * t + t**3, v(t): sympy.Rational(4, 3) + t / 3 - t**2}
        value = difference.subs(path).doit().subs(t, sympy.Rational(2, 7)).evalf(25)
        right = abs(value) < 1e-20
        assert right == option.right, option.text
    printed = task.lines[task.wrong_line].text
    assert r"+\sin v\,(u'v''+u''v')" in printed


@pytest.mark.parametrize("seed", SEEDS)
def test_the_moment_is_that_of_the_surface(seed: str) -> None:
    task = find("06.4").task(seed)
    assert isinstance(task, Number)
    for u, name in ((0, "0"), (math.pi / 2, r"\tfrac\pi2"), (math.pi, r"\pi")):
        if f"$u={name}$" in task.question:
            ubar, vbar = (int(task.question.split(rf"\bar {x}=")[1][0]) for x in "uv")
            curve = Bezier([[u, math.pi / 2], [u + 1, math.pi / 2]])
            line = RuledSurface(curve, ubar, vbar).line(0.0)
            np.testing.assert_allclose(line.moment, task.answer, atol=1e-12)
            np.testing.assert_allclose(np.cross(line.direction, np.cross(
                line.direction, task.answer)), -np.asarray(task.answer), atol=1e-12)  # fmt: skip


@pytest.mark.parametrize("seed", SEEDS)
def test_the_conoids_delta_is_that_of_its_surface(seed: str) -> None:
    task = find("06.10").task(seed)
    assert isinstance(task, Sketch)
    wave = task.question.split(r"$\bar u=")[1].split("$")[0]
    text = wave.replace(r"\,", "*").replace(r"\sin ", "sin(") + ")"
    text = text.replace("(2u)", "(2*u)")
    curve = Bezier([[0, math.pi / 2], [2 * math.pi, math.pi / 2]])
    delta = RuledSurface(curve, text, 0).invariants(task.t).delta
    np.testing.assert_allclose(task.curve(task.t), delta, atol=1e-10)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_way_from_the_ellipse_is_that_to_the_striction_point(seed: str) -> None:
    task = find("03.11").task(seed)
    assert isinstance(task, Sketch)
    base, across = (
        re.sub(r"(\d?)\\(cos|sin) t", lambda m: f"{m[1] or 1}*{m[2]}(t)", part).replace(r"\ ", "")
        for part in re.findall(r"\\mathbf [cx]=\((.*?)\)[$/]", task.question)
    )
    surface = RuledSurface.from_base(vector(base), vector(across), task.span)
    start = np.stack([np.broadcast_to(x, task.t.shape) for x in vector(base)(task.t)], axis=-1)
    way = np.sum((surface.striction(task.t) - start) * surface.line(task.t).direction, axis=-1)
    np.testing.assert_allclose(task.curve(task.t), way, atol=1e-10)
    assert not task.judge([0.0] * task.KNOTS).right  # the base curve taken for the striction curve


@pytest.mark.parametrize("seed", MANY[:12])
def test_the_walk_is_an_orthogonal_trajectory_and_does_not_come_back(seed: str) -> None:
    task = find("08.12").task(seed)
    assert isinstance(task, Sketch)
    vbar = task.question.split(r"$\bar v=")[1].split("$")[0].replace(r"\sin u", "*sin(u)")
    curve = Bezier([[0, math.pi / 2], [2 * math.pi, math.pi / 2]])
    surface = RuledSurface(curve, "sin(2*u)", vbar)
    points = trajectory(surface, 0.0, task.t).points
    walked = np.sum((points - surface.foot(task.t)) * surface.line(task.t).direction, axis=-1)
    walk = np.asarray(task.curve(task.t))
    np.testing.assert_allclose(walk, walked - walked[0], atol=1e-9)
    assert walk[-1] == pytest.approx(surface.pitch(), abs=1e-9)
    assert not task.judge(list(walk - walk[-1] * task.t)).right  # as though it came back
    assert task.judge(list(0.8 * walk)).right


@pytest.mark.parametrize("seed", SEEDS)
def test_the_seam_needs_a_hand_besides_the_menu_of_closings(seed: str) -> None:
    task = find("06.9").task(seed)
    assert isinstance(task, Drag)
    assert task.judge(task.start.closed_with("C0")).slip == ""
    for closing in ("C1", "C2"):
        design = task.start.closed_with(closing)
        assert task.judge(design).slip == "smooth taken for fast"
        farther = drag(design.points, 1, (math.pi / 8, 3.2 * math.pi / 8), order=1)
        helped = design.with_(points=tuple(map(tuple, farther.tolist())), closing="C1")
        assert task.judge(helped).right


def test_the_printed_torsion_is_recognised_from_its_own_formula() -> None:
    task = find("06.13").task()
    assert isinstance(task, Code)
    t = np.array(eval_list(task.starter))
    surface = gallery.surface("example_2")
    h = 1e-6
    slope = (surface.foot(t + h) - surface.foot(t - h)) / (2 * h)
    advance = np.sum(slope * surface.line(t).direction, axis=-1)
    verdict = task.judge([round(x, 4) for x in advance])
    assert verdict.slip == "τ̄ as printed in (18)"


def eval_list(starter: str) -> list[float]:
    line = next(line for line in starter.splitlines() if line.startswith("t ="))
    return list(ast.literal_eval(line.partition("=")[2].strip()))


# -- reading ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3*pi/8", 3 * math.pi / 8),
        ("3π/8", 3 * math.pi / 8),
        ("3pi/8", 3 * math.pi / 8),
        ("-2 pi", -2 * math.pi),
        ("−6.1159", -6.1159),
        ("sqrt(2)", math.sqrt(2)),
        ("1e-3", 1e-3),
        ("(1+2)*3", 9),
        ("0.58 rad", 0.58),
        ("0.58 rad per t", 0.58),
        ("arctan2(1, 1)", math.pi / 4),
        (2, 2),
        (np.float32(0.5), 0.5),
        (np.array(0.25), 0.25),
        (Fraction(1, 4), 0.25),
        (sympy.pi / 2, math.pi / 2),
    ],
)
def test_numbers_are_read(text: object, value: float) -> None:
    assert read_numbers(text, (), "rad per t") == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1, 2, 3", [1, 2, 3]),
        ("[1, 2, 3]", [1, 2, 3]),
        ("(1; 2; 3,)", [1, 2, 3]),
        ("np.array([1, pi, 3])", [1, math.pi, 3]),
        ("[arctan2(0, 1), (1 + 1), 3π]", [0, 2, 3 * math.pi]),
        ("[[1, 2], [3, 4]]", [[1, 2], [3, 4]]),
        ((1, 2, 3), [1, 2, 3]),
        (["pi", 2], [math.pi, 2]),
        (Dual(1.5, -0.5), [1.5, -0.5]),
    ],
)
def test_arrays_are_read(text: object, value: list[float]) -> None:
    np.testing.assert_allclose(read_numbers(text, np.shape(value)), value, rtol=1e-12)


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        ("", "nothing is answered"),
        (..., "nothing is answered"),
        ("0,5", "decimal point"),
        ("30°", "radians"),
        ("x + 1", "unknown name 'x'"),
        ("[1, 2", "closed"),
        ("[1, [2, 3]]", "equal length"),
        ([1, "blah"], "unknown name"),
        (1j, "complex"),
        (True, "bool"),
        (math.nan, "NaN"),
        (math.sin, "function"),
        ("1" * 3000, "characters"),
        (object(), "type object"),
    ],
)
def test_nonsense_is_refused_with_a_remedy(answer: object, says: str) -> None:
    with pytest.raises(GeometryError, match=says) as caught:
        read_numbers(answer)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["banana + 2*", "u", "1 + v", "sin"])
def test_words_about_numbers_do_not_speak_of_u_and_v(text: str) -> None:
    with pytest.raises(GeometryError) as caught:
        read_numbers(text)
    assert "known are u" not in str(caught.value)
    assert "u or v" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "variables", "says"),
    [
        ("sin(u)", ("t",), "'u' is not meant here at column 5; write a formula in t"),
        ("3 + t2", ("t",), r"or a power at column 5; write 2\*t or t\*\*2"),
        ("t + x", ("t",), "known are t, pi"),
        ("a + ", ("a", "b"), "write a number, a or b"),
        ("t", ("u", "v"), "'t' is not meant here"),
        ("", ("t",), "such as sin"),
        (lambda t: object(), ("t",), "no number"),
        (lambda t: 1 / 0, ("t",), "failed"),
    ],
)
def test_formulas_are_refused_in_their_own_letters(
    text: object, variables: tuple[str, ...], says: str
) -> None:
    with pytest.raises(GeometryError, match=says):
        read_formula(text, variables)(*(np.ones(3) for _ in variables))


@given(st.text(max_size=40))
def test_any_text_is_read_or_refused(text: str) -> None:
    for shape_ in ((), (3,)):
        try:
            assert np.isfinite(read_numbers(text, shape_)).all()
        except GeometryError as error:
            assert "\n" not in str(error)
    for variables in (("u", "v"), ("t",), ("a", "b")):
        with contextlib.suppress(GeometryError):
            read_formula(text, variables)(*(np.linspace(0.1, 1, 3) for _ in variables))


# -- equivalent answers ----------------------------------------------------------------------------

values = st.floats(-1e3, 1e3).filter(lambda x: abs(x) > 1e-3)


@given(values, st.integers(1, 9), st.integers(1, 24))
def test_a_number_may_be_written_in_many_ways(value: float, above: int, below: int) -> None:
    task = number(value)
    for text in (
        f"{value!r}",
        f"({value!r})*2/2",
        f"sqrt(({value!r})**2)*{math.copysign(1, value)}",
    ):
        assert task.judge(text).right, text
    part = number(above * math.pi / below)
    for text in (
        f"{above}*pi/{below}",
        f"{above}π/{below}",
        f"pi*{above}/{below}",
        f"{above}pi/{below}",
    ):
        assert part.judge(text).right, text


@given(st.lists(values, min_size=1, max_size=5))
def test_an_array_may_be_written_in_many_ways(entries: list[float]) -> None:
    task = number(entries)
    text = ", ".join(map(repr, entries))
    for answer in (f"[{text}]", f"array([{text}])", entries, tuple(entries), np.array(entries)):
        assert task.judge(answer).right, answer
    if len(entries) > 1:
        assert task.judge(text).right
        assert task.judge(entries[:-1]).state == "unread"


@settings(max_examples=40)
@given(st.integers(-5, 5), st.integers(1, 5), st.integers(1, 4))
def test_equivalent_formulas_pass_and_others_do_not(a: int, b: int, n: int) -> None:
    task = formula(f"{a} + {b}*sin({n}*u)*cos(v)")
    for text in (
        f"{b}*cos(v)*sin(u*{n}) - ({-a})",
        f"{b}/2*(sin({n}*u + v) + sin({n}*u - v)) + {a}",
    ):
        assert task.judge(text).right, text
    assert task.judge(lambda u, v: a + b * np.sin(n * u) * np.cos(v)).right
    assert not task.judge(f"{a} + {b}*sin({n}*v)*cos(u)").right


# -- what is off -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given_", "says"),
    [
        (-2.0, "the sign is not"),
        (2.02, "Close"),
        (4.0, "factor of 2"),
        (2 / math.pi, "factor of π"),
        (-6.0, "sign is off"),
        (math.degrees(2.0), "degrees"),
        (50.0, "Too large"),
        (0.3, "Too small"),
    ],
)
def test_a_wrong_number_hears_what_is_off(given_: float, says: str) -> None:
    verdict = number(2.0).judge(given_)
    assert verdict.state == "wrong"
    assert says in verdict.word


@pytest.mark.parametrize(
    ("given_", "says"),
    [
        ([-1, -2, -3], "wrong sign"),
        ([3, 1, 2], "another order"),
        ([1, 2, 30], "The third entry: "),
        ([1, 2, -3], "1 of 3 entries is off"),
        ([1, -2, 9], "2 of 3 entries are off"),
    ],
)
def test_a_wrong_array_hears_what_is_off(given_: list[float], says: str) -> None:
    assert says in number([1.0, 2.0, 3.0]).judge(given_).word


@pytest.mark.parametrize(
    ("given_", "says"),
    [
        ("-sin(t)", "sign"),
        ("2*sin(t)", "factor 2"),
        ("sin(t) + 1", "constant +1"),
        ("cos(t)", "At t ="),
        ("sqrt(0.5 - t)", "no value"),
        ("1.000001*sin(t)", "Nearly: write exact numbers"),
        ("exp(1e3*exp(t))", "no value"),
        ("1e300*t", "yours is"),
    ],
)
def test_a_wrong_formula_hears_what_is_off(given_: str, says: str) -> None:
    task = formula("sin(t)", variables=("t",), box=((0.0, 1.0),))
    assert says in task.judge(given_).word


def test_a_modulus_makes_equal_what_differs_by_turns() -> None:
    task = number(0.5, modulo=2 * math.pi)
    assert task.judge("0.5 - 4*pi").right
    assert not task.judge("0.5 + pi").right


def test_zero_is_told_from_what_is_not_zero() -> None:
    assert number(0.0).judge("0").right
    assert "Too large" in number(0.0).judge("0.3").word


def test_typed_html_is_shown_and_not_obeyed() -> None:
    verdict = number(1.0).judge("<b>1</b>")
    assert "<b>" not in verdict.word


def test_twice_as_much_is_not_close_however_coarse_the_tolerance() -> None:
    task = number(1.0, tolerance=0.05)
    assert "factor of 2" in task.judge(2.0).word
    assert "factor of π" in task.judge(math.pi).word  # not of 3, which is near
    assert "factor of 3" in task.judge(3.0).word
    assert "Close" in task.judge(1.12).word


@pytest.mark.parametrize(
    ("right", "given_", "says"),
    [
        (2.0, math.degrees(2.0), "by a factor of 180/π: are these degrees?"),
        (2.0, math.radians(2.0), "Too small by a factor of 180/π."),
        (2.0, 0.0, "it is not zero."),
        (0.0, 5.0, "Too large in size."),
        ([0.0, 1.0], [5.0, 1.0], "Too large in size."),
    ],
)
def test_words_about_sizes_are_true(right: object, given_: object, says: str) -> None:
    word = number(right).judge(given_).word
    assert word.endswith(says)


def test_turns_do_not_hide_what_is_off() -> None:
    task = number(0.5, modulo=2 * math.pi)
    assert "the sign is not" in task.judge(-0.5 + 6 * math.pi).word


@pytest.mark.parametrize("size", [1e308, -1e308, 1e-320])
def test_extreme_numbers_are_judged_without_a_warning(size: float) -> None:
    slips = (misconceptions.degrees([1.0, 1.7e308 / 100]),)
    for right, given_ in ((2.0, size), ([1.0, -1e308], [size, size]), ([1.0, 2.0], [size, 1.0])):
        assert number(right, slips=slips).judge(given_).state == "wrong"
    assert number(0.5, modulo=2.0).judge(size).state in ("right", "wrong")


def test_an_array_in_another_form_hears_how_to_write_it() -> None:
    assert "write a point" in number([1.0, 2.0]).judge("1,0; 2,0").word
    assert "write a point" in number([1.5, 2.5]).judge("[1,5, 2,5]").word
    assert "Exchange rows and columns" in number(np.ones((2, 3))).judge(np.ones((3, 2))).word


@pytest.mark.parametrize("index", [np.int64(0), np.array(1), sympy.Integer(2)])
def test_whole_numbers_of_other_libraries_choose_too(index: object) -> None:
    task = find("06.1").task()
    assert task.judge(index) == task.judge(int(index))  # type: ignore[call-overload]
    slip = find("06.15").task()
    assert slip.judge({"line": index}) == slip.judge({"line": int(index)})  # type: ignore[call-overload]
    assert task.judge(np.True_).state == "unread"


# -- misconceptions --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("right", "slip", "given_"),
    [
        (0.0, misconceptions.torsion_sign(0.0), 5e-4),
        ([0.0, 0.0, 0.0], misconceptions.moment_sign([0.0, 0.0, 0.0]), [0.0, 8e-4, 0.0]),
        (1.0, misconceptions.delta_inverted(1.0), 1.0005),
        (0.0, misconceptions.degrees(0.0), -5e-4),
    ],
)
def test_a_misconception_with_the_right_value_is_not_named(
    right: object, slip: Misconception, given_: object
) -> None:
    verdict = number(right, slips=(slip,), tolerance=1e-5).judge(given_)
    assert (verdict.state, verdict.slip) == ("wrong", "")


def test_a_misconception_with_the_right_formula_is_not_named() -> None:
    slip = misconceptions.formula("t for sin t", "2*sin(t)/2", "", ("t",), ((0.0, 1.0),))
    task = formula("sin(t)*(1 + 3e-8)", variables=("t",), box=((0.0, 1.0),), slips=(slip,))
    assert task.judge("sin(t)").slip == "t for sin t"  # the two differ
    task = formula("sin(t)", variables=("t",), box=((0.0, 1.0),), slips=(slip,))
    assert task.judge("sin(t)").right
    assert task.judge("sin(t)*(1 + 2e-8)").slip == ""


@pytest.mark.parametrize(
    ("slip", "right", "wrong"),
    [
        (misconceptions.moment_sign([0.0, 2.0, -1.0]), [0, 2, -1], [0, -2, 1]),
        (misconceptions.modulo_turn(-6.1159), -6.1159, -6.1159 + 2 * math.pi),
        (misconceptions.modulo_turn(-6.1159), -6.1159, -6.1159 - 4 * math.pi),
        (misconceptions.torsion_sign(-6.1159), -6.1159, 6.1159),
        (misconceptions.pitch_sign(0.58), 0.58, -0.58),
        (misconceptions.degrees(0.58), 0.58, math.degrees(0.58)),
        (misconceptions.delta_inverted(0.5), 0.5, 2.0),
        (misconceptions.printed_tau_bar([1.0, 2.0]), [3, 4], [1, 2]),
    ],
    ids=lambda x: x.name if isinstance(x, Misconception) else None,
)
def test_a_misconception_is_recognised_and_nothing_else(
    slip: Misconception, right: object, wrong: object
) -> None:
    assert slip.test(np.asarray(wrong, dtype=float))
    assert not slip.test(np.asarray(right, dtype=float))
    assert not slip.test(np.asarray(right, dtype=float) * 1.37 + 0.11)
    assert not slip.test(np.ones((2, 2)))
    assert number(right, slips=(slip,)).judge(wrong).slip == slip.name


@settings(max_examples=20)
@given(st.integers(0, 6), st.floats(0.05, 0.9), st.floats(1.2, 3.0))
def test_collinear_points_are_told_from_c1(turn: int, size: float, factor: float) -> None:
    slip = misconceptions.collinear_for_c1(Design(gallery.LOOP))
    leg = 0.3 * size * np.array([math.cos(turn), math.sin(turn)])
    middle = np.array([1.0, 1.5])

    def design(before: float) -> Design:
        points = [middle, middle + leg, [1.5, 1.0], [0.5, 1.0], middle - before * leg, middle]
        return Design(tuple((float(u), float(v)) for u, v in points), "1", "0", closing="C0")

    assert slip.test(made(design(factor)))
    assert slip.test(made(design(1 / factor)))
    assert not slip.test(made(design(1.0)))
    assert not slip.test(made(design(-factor)))  # a cusp is no smooth seam


def test_the_named_slips_of_the_issue_are_all_there() -> None:
    names = {
        slip.name
        for e in lesson("06")
        for task in [e.task()]
        for slip in (*getattr(task, "slips", ()), *getattr(getattr(task, "then", 0), "slips", ()))
    }
    names |= {o.slip for e in lesson("06") for o in getattr(e.task(), "options", ())}
    wanted = {"sign of the moment", "λ modulo 2π", "collinear taken for C¹", "sign of (24)"}
    assert wanted | {"τ̄ as printed in (18)", "degrees for radians"} <= names


# -- designs ---------------------------------------------------------------------------------------


def test_every_equivalent_design_passes() -> None:
    task = find("06.8").task()
    model = task.right_answer()
    points = np.array(model.points)
    reparametrised = Bezier(points).raised(2).points
    rotated = points + [0.0, 0.0]
    for changed in (reparametrised, rotated):
        design = model.with_(points=tuple(map(tuple, changed.tolist())))
        for form in (design, design.to_json(), design.to_text(), made(design)):
            assert task.judge(form).right
    thrice = model.with_(length=7.0, samples=60, name="other")
    assert task.judge(thrice).right


def test_designs_that_are_near_hear_how_near() -> None:
    task = find("06.8").task()
    verdict = task.judge(task.wrong_answer())
    assert "still off by" in verdict.word
    opened = task.wrong_answer().with_(closing="open", points=gallery.LOOP[:-1])
    assert "does not close" in task.judge(opened).word


# -- two lines -------------------------------------------------------------------------------------

quarter_turns = st.floats(-math.pi, math.pi)
shift = st.floats(-0.8, 0.8)


def carried_line(line: OrientedLine, turn: np.ndarray, by: np.ndarray, slid: float) -> OneLine:
    """A line after a rigid motion, given by another of its points."""
    x, y, z = turn @ line.direction
    point = turn @ line.point(slid) + by
    return OneLine(math.atan2(y, x), math.atan2(math.hypot(x, y), z), *map(float, point))


@settings(max_examples=40)
@given(st.sampled_from(MANY[:8]), st.tuples(*[quarter_turns] * 3), st.tuples(*[shift] * 5))
def test_every_position_with_the_same_dual_angle_passes(
    seed: str, angles: tuple[float, ...], shifts: tuple[float, ...]
) -> None:
    task = find("02.12").task(seed)
    assert isinstance(task, Place)
    turn = Rotation.from_euler("zxz", angles).as_matrix()
    a, b = (
        carried_line(line, turn, np.array(shifts[:3]), slid)
        for line, slid in zip((task.model.a.line, task.model.b.line), shifts[3:], strict=True)
    )
    assert task.judge(TwoLines(a, b)).right
    assert task.judge(TwoLines(b, a)).right  # both turn round: the way and x × y
    assert task.judge(TwoLines(a.reversed(), b.reversed())).right
    for wrong in (TwoLines(a.reversed(), b), TwoLines(a, b.reversed())):
        assert task.judge(wrong).slip == "orientation ignored"
    mirrored = [replace(line, v=math.pi - line.v, z=-line.z) for line in (a, b)]
    assert task.judge(TwoLines(*mirrored)).slip == "distance unsigned"


@pytest.mark.parametrize("seed", MANY[:8])
@pytest.mark.parametrize("turn", [0.6, 2.0, -1.3, math.pi])
def test_any_line_that_is_turned_in_its_plane_about_the_origin_has_its_moment(
    seed: str, turn: float
) -> None:
    task = find("02.13").task(seed)
    assert isinstance(task, Place)
    line = task.start.a.line
    axis = turn * line.moment / np.linalg.norm(line.moment)
    matrix = Rotation.from_rotvec(axis).as_matrix()
    b = carried_line(line, matrix, np.zeros(3), 0.3)
    assert task.judge(TwoLines(task.start.a, b)).right
    assert task.judge(TwoLines(b, task.start.a)).right
    farther = replace(b, x=1.2 * b.x, y=1.2 * b.y, z=1.2 * b.z)
    assert "still off by" in task.judge(TwoLines(task.start.a, farther)).word
    reversed_ = task.judge(TwoLines(task.start.a, b.reversed()))
    assert reversed_.slip == "the other way round the origin"


def test_two_lines_may_be_given_as_the_state_of_the_lessons_picture(tmp_path: Path) -> None:
    store, task = Store(tmp_path / "p.json"), find("02.12").task()
    model = task.right_answer()
    for form in (model, model.numbers, tuple(map(tuple, model.numbers))):
        assert check("02.12", form, store)
        assert store.record("02.12")["answer"] == model.numbers
    assert "give two lines, such as app.slate.value" in check("02.12", None, store).verdict.word


# -- sketches --------------------------------------------------------------------------------------

T = np.linspace(0, 1, 65)
CURVES = {
    "cosine": np.cos(2 * np.pi * T),
    "rise": T - 0.4,
    "bump": np.exp(-((T - 0.6) ** 2) / 0.02),
    "flat": np.zeros(65),
    "level": np.full(65, 0.8),
    "two waves": np.sin(4 * np.pi * T),
}


@pytest.mark.parametrize("name", CURVES)
@settings(max_examples=30)
@given(st.integers(0, 1000), st.floats(0.6, 1.3), st.floats(-0.02, 0.02))
def test_a_shaky_hand_is_forgiven(name: str, seed: int, size: float, late: float) -> None:
    curve = CURVES[name]
    shaky = np.interp(T + late, T, curve) * size
    shaky = shaky + np.random.default_rng(seed).normal(0, 0.01, 65)
    traits = shape.compare(T, shaky, curve, 2.4)
    assert all(trait.agrees for trait in traits), traits


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("other", CURVES)
def test_another_shape_is_not_taken_for_it(name: str, other: str) -> None:
    traits = shape.compare(T, CURVES[other], CURVES[name], 2.4)
    assert all(trait.agrees for trait in traits) == (name == other)


def test_words_say_which_features_differ() -> None:
    traits = {t.name: t for t in shape.compare(T, -CURVES["cosine"], CURVES["cosine"], 2.4)}
    assert "opposite sign" in traits["sign"].word
    assert traits["zeros"].agrees
    assert (
        traits["turns"].word
        == "yours has a maximum near t = 0.50, the curve a minimum near t = 0.50"
    )
    assert not traits["rising and falling"].agrees


def test_a_gap_in_the_true_curve_is_not_held_against_a_sketch() -> None:
    truth = np.where(np.abs(T - 0.5) < 0.1, np.nan, CURVES["rise"])
    assert all(t.agrees for t in shape.compare(T, CURVES["rise"], truth, 2.4))


def test_a_flat_sketch_is_not_called_opposite() -> None:
    traits = {t.name: t for t in shape.compare(T, np.zeros(65), CURVES["cosine"], 2.4)}
    assert traits["sign"].word == "yours is zero all along; the curve is not"


@pytest.mark.parametrize(
    "sketch",
    [[10**400] * 65, ["a"] * 65, [1j] * 65, {"a": 1}, object(), [[0.0]] * 65, [1e308, -1e308] * 32],
)
def test_what_is_no_sketch_is_said(sketch: object) -> None:
    assert find("06.10").task().judge(sketch).state == "unread"


def test_heights_that_no_hand_draws_are_no_sketch() -> None:
    verdict = find("06.10").task().judge([1e308, -1e308] * 32 + [0.0])
    assert "2 % of it" in verdict.word


def test_half_a_sketch_is_not_judged() -> None:
    task = find("06.10").task()
    half = [0.1 if i < 30 else None for i in range(65)]
    verdict = task.judge(half)
    assert verdict.state == "unread"
    assert "46 %" in verdict.word


# -- the slips to find, and code -------------------------------------------------------------------


def test_the_line_comes_first_and_then_the_correction() -> None:
    task = find("06.15").task()
    assert isinstance(task, FindSlip)
    assert task.judge({"line": 0}).state == "wrong"
    assert "starts and ends" in task.judge({"line": 0}).word
    assert task.judge({"line": 2}).state == "unread"  # half an answer
    assert task.judge({"line": 2, "then": "(a + b)/2"}).slip == "middle of the leg"
    assert task.judge({"line": 2, "then": "a - (b - a)"}).right


def test_code_may_have_a_test_of_its_own() -> None:
    def even(value: object) -> Verdict:
        return Verdict("right" if value == 4 else "wrong", "four is asked for")

    task = Code(question="", solution="", starter="value = ...", test=even, model=4)
    assert task.judge(task.right_answer()).right
    assert task.judge(5).state == "wrong"
    assert "replace the dots" in task.judge(...).word


def test_faulty_data_are_refused() -> None:
    with pytest.raises(ValueError, match="hints"):
        number(1.0, hints=("a", "b", "c", "d"))
    with pytest.raises(ValueError, match="exactly one option"):
        Choose(question="", solution="", options=(Option("a", "b"), Option("c", "d")))
    with pytest.raises(ValueError, match="exactly one line"):
        FindSlip(question="", solution="", lines=(Line("a", "b"),), then=number(1.0))


# -- check, from a code cell -----------------------------------------------------------------------


def test_check_answers_and_keeps(tmp_path: Path) -> None:
    store = Store(tmp_path / "p.json")
    task = find("06.12").task(store.seed)
    assert "sign of (24)" in check("06.12", task.slips[0].example, store).verdict.slip
    done = check("06.12", np.array(task.answer), store)
    assert done
    assert repr(done) == "06.12: Right."
    assert 'role="status"' in done._repr_html_()
    record = Store(tmp_path / "p.json").record("06.12")
    assert (record["right"], record["tries"]) == (True, 2)
    assert find("06.12").task().judge(record["answer"]).right


def test_check_before_anything_is_written_counts_as_nothing(tmp_path: Path) -> None:
    store = Store(tmp_path / "p.json")
    assert not check("06.12", ..., store)
    assert store.keys() == ()
    assert not (tmp_path / "p.json").exists()


@every
def test_every_right_answer_can_be_kept_and_judged_again(exercise: Exercise, seed: str) -> None:
    task = exercise.task(seed)
    answer = kept(task, task.right_answer())
    assert json.loads(json.dumps(answer, allow_nan=False)) == answer
    assert task.judge(answer).right


@pytest.mark.parametrize(
    ("key", "answer", "stored"),
    [
        ("06.15", {"line": np.int64(2), "then": sympy.sympify("2*a - b")}, "2*a - b"),
        ("06.15", {"line": 2, "then": lambda a, b: 2 * a - b}, ""),
        ("06.14", {"line": 3, "then": np.int64(0)}, 0),
        ("06.1", np.int64(1), 1),
    ],
)
def test_answers_of_any_type_are_kept_as_json(
    tmp_path: Path, key: str, answer: Any, stored: object
) -> None:
    store = Store(tmp_path / "p.json")
    assert check(key, answer, store)
    record = Store(tmp_path / "p.json").record(key)
    found = record["answer"]
    assert (found["then"] if isinstance(found, dict) else found) == stored
    assert record["right"] is True


def test_a_design_is_kept_as_short_text_in_whatever_form_it_was_given(tmp_path: Path) -> None:
    store, task = Store(tmp_path / "p.json"), find("06.8").task()
    design = task.right_answer()
    for form in (design, design.to_json(), design.to_text(), made(design)):
        assert check("06.8", form, store)
        assert store.record("06.8")["answer"] == design.to_text()


def test_who_was_right_in_another_notebook_stays_right(tmp_path: Path) -> None:
    one, two = Store(tmp_path / "p.json"), Store(tmp_path / "p.json")
    assert check("06.1", 1, one)
    assert not check("06.1", 0, two)  # it has not read the file since
    record = Store(tmp_path / "p.json").record("06.1")
    assert (record["right"], record["tries"]) == (True, 2)


# -- the draw, and the layers ----------------------------------------------------------------------


def test_draws_are_the_same_on_every_machine() -> None:
    # sha256("7\n06.1\n1") and …2, …3, reduced: worked out with coreutils' sha256sum
    draw = Draw("7", "06.1")
    assert [draw.integer(0, 9) for _ in range(3)] == [6, 8, 5]
    assert sorted(Draw("", "x").shuffled(6)) == list(range(6))


@given(st.text(max_size=8), st.integers(-5, 5), st.integers(0, 7))
def test_draws_stay_inside(seed: str, low: int, width: int) -> None:
    draw = Draw(seed, "k")
    assert all(low <= draw.integer(low, low + width) <= low + width for _ in range(20))
    assert low <= draw.between(low, low + width) <= low + width


WITH_WIDGETS = ("__init__", "boxes", "widgets")
WITHOUT_WIDGETS = [p for p in sorted(PACKAGE.rglob("*.py")) if p.parent.name == "kinds"
                   or p.stem not in WITH_WIDGETS]  # fmt: skip


@pytest.mark.parametrize("path", WITHOUT_WIDGETS, ids=lambda p: p.stem)
def test_the_core_needs_no_widgets(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            assert (node.module or "").partition(".")[0] not in ("lab", "boxes", "widgets")
        if isinstance(node, ast.Import):
            assert not {a.name for a in node.names} & {"ipywidgets", "anywidget", "traitlets"}
