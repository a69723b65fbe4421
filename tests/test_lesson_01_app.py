"""Lesson 01: its picture, its app and its exercises."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")

import ipywidgets

from ruledlab.exercises import find
from ruledlab.exercises.core import Draw
from ruledlab.exercises.lesson_01 import from_one_value, inverse, product
from ruledlab.geometry import Dual, FormulaError, GeometryError
from ruledlab.lab import dual_numbers
from ruledlab.lab.apps.lesson_01 import MENU, DualNumbers
from ruledlab.lab.axes import Limits
from ruledlab.lab.scenes.dual_graph import (
    PLACES,
    STEP_SPAN,
    WINDOW,
    X_SPAN,
    DualPoint,
    dual_scene,
    height_limits,
    picture,
    readout,
    words,
)

FORMULAS = [formula for _, formula in MENU]
SVG = "{http://www.w3.org/2000/svg}"


def scene_of(formula: str, x: float = 1.0, x_bar: float = 0.5):
    return dual_scene(DualPoint(formula, x, x_bar))


def drawn(formula: str, x: float, x_bar: float, limits: Limits | None = None):
    """The picture as a tree: it has to be well-formed."""
    scene = scene_of(formula, x, x_bar)
    return ElementTree.fromstring(picture(scene, limits or height_limits(scene, None)))


def part(tree, kind: str):
    """The one element of a class."""
    (found,) = (node for node in tree.iter() if node.get("class") == kind)
    return {name: float(value) for name, value in found.items() if name[0] in "xyc" and value[-1].isdigit()}  # fmt: skip  # noqa: E501


# ---- the picture --------------------------------------------------------------------------------


@pytest.mark.parametrize("formula", ["x**2", "x**3 - x", "sin(x)", "exp(x)", "1/x", "log(x)"])
@pytest.mark.parametrize("x_bar", [0.7, -0.4])
def test_step_and_rise_have_the_slope_of_the_graph(formula: str, x_bar: float) -> None:
    limits = Limits(-8.0, 8.0)
    tree = drawn(formula, 1.3, x_bar, limits)
    step, rise, along = (part(tree, kind) for kind in ("step", "rise", "along"))
    across, up = 600 / WINDOW.span, 400 / limits.span
    assert (step["x2"] - step["x1"]) / across == pytest.approx(x_bar, abs=2e-4)
    assert step["y1"] == step["y2"]
    here, there = (float(f) for f in np.interp(1.3 + np.array([-0.01, 0.01]), PLACES,
                                               scene_of(formula).heights))  # fmt: skip
    slope = (there - here) / 0.02  # a second route: the graph itself
    assert (rise["y1"] - rise["y2"]) / up == pytest.approx(x_bar * slope, rel=0.02)
    assert (along["x2"], along["y2"]) == (rise["x2"], rise["y2"])
    assert (along["x1"], along["y1"]) == (part(tree, "point")["cx"], part(tree, "point")["cy"])


def test_the_tangent_runs_through_the_point_however_steep_it_is() -> None:
    for formula in ("x**2", "10000*x - 9990", "exp(x)"):
        tree = drawn(formula, 1.0, 0.5, Limits(-20.0, 20.0))
        line, point = part(tree, "tangent"), part(tree, "point")
        assert line["x1"] + line["x2"] == pytest.approx(2 * point["cx"], abs=0.05)
        assert line["y1"] + line["y2"] == pytest.approx(2 * point["cy"], abs=0.05)


@pytest.mark.parametrize("x_bar", [0.8, -0.8])
@pytest.mark.parametrize("x", [1.3, -1.3])
def test_the_words_stand_outside_of_the_triangle(x: float, x_bar: float) -> None:
    """x̄ on the other side of the step than the tip, x̄ f′(x) on the other side of the rise."""
    tree = drawn("x**2", x, x_bar, Limits(-2.0, 8.0))
    step, rise = part(tree, "step"), part(tree, "rise")
    words_at = {
        kind: next(node for node in tree.iter() if node.get("class") == kind)
        for kind in ("step-word", "rise-word")
    }
    below = float(words_at["step-word"].get("y")) > step["y1"]
    assert below == (rise["y2"] < step["y1"])
    right = words_at["rise-word"].get("text-anchor") == "start"
    assert right == (float(words_at["rise-word"].get("x")) > rise["x1"]) == (x_bar > 0)


def test_a_dual_number_may_be_written_with_epsilon() -> None:
    task = find("01.1").task()
    real, dual = task.answer
    for text in (f"{real} + {dual} eps", f"{real}+{dual}ε", f"[{real}, {dual}]", Dual(real, dual)):
        assert task.judge(text).right, text
    assert not task.judge(f"{real} - {dual} eps").right


def test_the_ring_is_on_the_graph_and_the_tip_is_not() -> None:
    tree = drawn("x**2", 1.5, 0.5, Limits(0.0, 8.0))
    ring, tip = part(tree, "beyond"), part(tree, "tip")
    assert ring["cx"] == tip["cx"]
    assert (tip["cy"] - ring["cy"]) / 400 * 8 == pytest.approx(0.25)


@pytest.mark.parametrize("formula", [*FORMULAS, "3", "tan(x)", "exp(exp(x**2))", "1e9*x"])
@pytest.mark.parametrize("x", [-3.0, -0.01, 0.0, 1.0, 3.0])
@pytest.mark.parametrize("x_bar", [-1.0, 0.0, 1.0])
def test_every_picture_is_well_formed_and_says_what_it_shows(
    formula: str, x: float, x_bar: float
) -> None:
    tree = drawn(formula, x, x_bar)
    assert tree.get("role") == "img"
    assert tree.get("aria-label") == words(scene_of(formula, x, x_bar))
    text = ElementTree.tostring(tree, encoding="unicode") + readout(scene_of(formula, x, x_bar))
    assert not re.search(r"\b(nan|inf)\b", text)


@pytest.mark.parametrize(("formula", "x"), [("log(x)", -1), ("1/x", 0), ("abs(x)", 0)])
def test_where_there_is_no_value_the_graph_stays_and_the_marks_go(formula: str, x: float) -> None:
    kinds = [node.get("class") for node in drawn(formula, x, 0.5).iter()]
    assert "graph" in kinds
    assert "missing" in kinds
    assert not {"tangent", "step", "rise", "tip"} & set(kinds)
    assert "There is no f(X)" in words(scene_of(formula, x))


def pen_lifts(formula: str) -> int:
    tree = drawn(formula, 1.0, 0.5)
    (path,) = (node for node in tree.iter() if node.get("class") == "graph")
    return path.get("d", "").count("M")


def test_the_graph_has_gaps_where_it_leaps() -> None:
    assert pen_lifts("x**2") == pen_lifts("sqrt(x)") == pen_lifts("exp(x)") == 1
    assert pen_lifts("1/x") == pen_lifts("1/(x - 0.3712)") == 2  # on and between the places
    assert pen_lifts("tan(x)") == 3
    assert pen_lifts("sqrt(x**2 - 1)") == 2


# ---- the axes -----------------------------------------------------------------------------------


def path_of_limits(formula: str) -> list[Limits]:
    present, seen = None, []
    for x in np.linspace(*X_SPAN, 121):
        present = height_limits(scene_of(formula, float(x)), present)
        seen.append(present)
    return seen


@pytest.mark.parametrize("formula", FORMULAS)
def test_the_axis_seldom_moves_and_holds_what_matters(formula: str) -> None:
    seen = path_of_limits(formula)
    changes = sum(a != b for a, b in itertools.pairwise(seen))
    # Of 120 moves. The heights of 1/x change four hundredfold and back: a rung for every doubling.
    assert changes <= (16 if formula == "1/x" else 8)
    for x, limits in zip(np.linspace(*X_SPAN, 121), seen, strict=True):
        scene = scene_of(formula, float(x))
        if not scene.lifted.undefined:
            assert limits.hold(min(0, scene.tip), max(0, scene.tip))
            assert limits.hold(*(2 * [float(scene.lifted.value.real)]))


def test_the_window_holds_every_step() -> None:
    assert WINDOW.low <= X_SPAN[0] + STEP_SPAN[0]
    assert X_SPAN[1] + STEP_SPAN[1] <= WINDOW.high


# ---- the app ------------------------------------------------------------------------------------


@pytest.fixture
def app() -> Iterator[DualNumbers]:
    app = dual_numbers()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


def looks(app: DualNumbers) -> tuple[str, ...]:
    """All that is shown."""
    return app.picture.value, app.numbers.value, app.words.value, app.formula.value


def test_it_begins_with_a_parabola(app: DualNumbers) -> None:
    assert "2.25 + ε 1.5" in app.numbers.value
    assert "x^{2}" in app.formula.value
    assert app.control.menu.value == app.control.typed.value == "x**2"


def test_it_begins_where_it_is_told() -> None:
    app = dual_numbers("cos(x)", 1.0, -0.5)
    assert f"{np.cos(1):.6g} + ε {0.5 * np.sin(1):.6g}" in app.numbers.value
    app.close()
    with pytest.raises(FormulaError, match=r"\*\*"):
        dual_numbers("x^2")
    with pytest.raises(GeometryError, match="between -1 and 1; got 7"):
        dual_numbers(x_bar=7)


@pytest.mark.parametrize("name", ["x", "x_bar"])
def test_a_slider_to_both_ends_and_back(app: DualNumbers, name: str) -> None:
    before, control = looks(app), getattr(app.control, name)
    start = control.slider.value
    for value in (control.slider.min, control.slider.max):
        control.slider.value = value
        assert getattr(app.slate.value, name) == value
        assert looks(app) != before
    control.slider.value = start
    assert app.slate.value == DualPoint("x**2", 1.5, 0.5)
    app.history.reset.click()
    app.control.typed.value = "sin(x)"
    app.control.typed.value = "x**2"  # another function begins with fresh limits
    assert looks(app) == before


@pytest.mark.parametrize("formula", FORMULAS)
def test_the_menu_and_the_field_agree(app: DualNumbers, formula: str) -> None:
    app.control.menu.value = formula
    assert app.control.typed.value == formula == app.slate.value.formula
    chosen = looks(app)
    app.control.typed.value = "7*x"
    assert app.control.menu.value == ""
    app.control.typed.value = formula
    assert app.control.menu.value == formula
    assert looks(app) == chosen


def test_the_numbers_are_those_of_dual_arithmetic(app: DualNumbers) -> None:
    app.control.typed.value = "x*sin(x)"
    app.control.x.field.value = "pi/2"
    app.control.x_bar.field.value = "-1/3"
    X = Dual(np.pi / 2, -1 / 3)
    Y = X * np.sin(X)
    assert f"{Y.real:.6g} − ε {-Y.dual:.6g}" in app.numbers.value


def test_what_cannot_be_read_is_said_beside_the_field_and_the_picture_stays(
    app: DualNumbers,
) -> None:
    before = looks(app)
    app.control.typed.value = "x + 1/2x"  # (1/2)x or 1/(2x)?
    assert "write 2*x" in app.control.error.value
    assert "<pre>x + 1/2x\n       ^</pre>" in app.control.error.value
    assert looks(app) == before
    app.control.x.slider.value = 1.0  # another control: the words stay to be mended
    assert app.control.typed.value == "x + 1/2x"
    assert app.control.error.value
    app.control.typed.value = "x^2 + 2x"  # as it is written on paper
    assert app.control.error.value == ""
    assert app.slate.value.formula == app.control.typed.value == "x**2+2*x"
    app.control.typed.value = "x +"
    app.control.menu.value = "sin(x)"
    assert (app.control.typed.value, app.control.error.value) == ("sin(x)", "")


def test_the_same_formula_again_takes_the_message_away(app: DualNumbers) -> None:
    app.control.typed.value = "x +"
    app.control.typed.value = "x**2"
    assert app.control.error.value == ""
    app.control.typed.value = "x +"
    app.history.reset.click()
    assert (app.control.typed.value, app.control.error.value) == ("x**2", "")


@pytest.mark.parametrize("name", ["x", "x_bar"])
def test_numbers_beyond_the_ends_are_refused_in_words(app: DualNumbers, name: str) -> None:
    before, control = looks(app), getattr(app.control, name)
    control.field.value = "100"
    assert "must lie between" in control.error.value
    assert looks(app) == before


def test_a_stroke_is_one_step_of_undo(app: DualNumbers) -> None:
    start = looks(app)
    for x in (1.0, 0.5, 0.2):
        app.control.x.slider.value = x
    app.control.menu.value = "exp(x)"
    app.history.undo.click()
    assert app.slate.value == DualPoint("x**2", 0.2, 0.5)
    app.history.undo.click()
    assert app.slate.value == DualPoint("x**2", 1.5, 0.5)
    assert app.numbers.value == start[1]
    app.history.redo.click()
    assert app.control.x.field.value == "0.2"


def pull(app: DualNumbers, index: int, to: float, drag: int = 1) -> None:
    """Drag a handle to where x is `to`, whatever the height."""
    window = 600 / (WINDOW.high - WINDOW.low)
    app.grips.motion = ["view", drag, index, 46 + (to - WINDOW.low) * window, 10.0]


def test_the_handles_stand_on_the_drawn_dots(app: DualNumbers) -> None:
    tree = ElementTree.fromstring(app.picture.value)
    for kind, handle in zip(("point", "tip"), app.grips.picture["handles"], strict=True):
        dot = part(tree, kind)
        assert (handle["x"], handle["y"]) == pytest.approx(
            (dot["cx"] + 46, dot["cy"] + 8), abs=0.02
        )
    assert tree.get("viewBox") == "-46 -8 {:g} {:g}".format(*app.grips.picture["size"])


def test_the_point_moves_x_and_the_tip_moves_the_step(app: DualNumbers) -> None:
    pull(app, 0, -0.74)
    assert app.slate.value == DualPoint("x**2", -0.75, 0.5)  # in the sliders' steps
    pull(app, 0, -0.02)
    assert app.slate.value.x == 0.0
    pull(app, 1, -0.62, drag=2)
    assert app.slate.value == DualPoint("x**2", 0.0, -0.6)
    assert (app.control.x.field.value, app.control.x_bar.field.value) == ("0", "-0.6")
    app.history.undo.click()
    app.history.undo.click()  # a drag is one step
    assert app.slate.value == DualPoint("x**2", 1.5, 0.5)


def test_a_handle_stays_within_the_ends_of_its_slider(app: DualNumbers) -> None:
    pull(app, 0, 9.0)
    pull(app, 1, -9.0)
    assert (app.slate.value.x, app.slate.value.x_bar) == (X_SPAN[1], STEP_SPAN[0])


@pytest.mark.parametrize("formula", ["abs(x)", "log(x)", "1/x"])
def test_where_there_is_no_value_there_is_no_tip_but_a_way_out(
    app: DualNumbers, formula: str
) -> None:
    app.control.typed.value = formula
    pull(app, 0, 0.0)
    (only,) = app.grips.picture["handles"]
    assert only["x"] is not None
    pull(app, 0, 1.0)
    assert len(app.grips.picture["handles"]) == 2


def test_an_undefined_value_is_named_and_gone_again(app: DualNumbers) -> None:
    app.control.menu.value = "1/x"
    app.control.x.slider.value = 0.0
    assert "pure dual number" in app.words.value
    assert "undefined" in app.numbers.value
    app.control.x.slider.value = 0.5
    assert "2 − ε 2" in app.numbers.value


def test_it_closes_without_a_trace() -> None:
    before = set(ipywidgets.widget._instances)
    app = dual_numbers()
    app.control.x.slider.value = 0.3
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not app.slate._followers
    app.close()


def test_two_apps_do_not_disturb_each_other(app: DualNumbers) -> None:
    other = dual_numbers("sin(x)")
    before = looks(app)
    other.control.x.slider.value = -1.0
    assert looks(app) == before
    other.close()


# ---- exercises ----------------------------------------------------------------------------------

MAKERS = (product, inverse, from_one_value)


@pytest.mark.parametrize("make", MAKERS, ids=lambda make: make.__name__)
def test_no_draw_makes_a_slip_right(make) -> None:
    for seed in range(60):
        task = make(Draw(str(seed), "x"))
        for slip in task.slips:
            assert task.judge(slip.example).slip == slip.name, (task.question, slip.name)


def asked(key: str, seed: int) -> list[Dual]:
    """The dual numbers in a question."""
    found = re.findall(r"(\d+)([+-])(\d*)\\varepsilon", find(key).task(str(seed)).question)
    return [Dual(float(a), float(sign + (size or "1"))) for a, sign, size in found]


def test_answers_agree_with_dual_arithmetic() -> None:
    for seed in range(20):
        first, second = asked("01.1", seed)
        assert find("01.1").task(str(seed)).judge(first * second).right
        (number,) = asked("01.2", seed)
        assert find("01.2").task(str(seed)).judge(1 / number).right


def test_the_dual_sine_by_dual_arithmetic() -> None:
    for seed in range(12):
        task = find("01.7").task(str(seed))
        below, distance = re.findall(r"tfrac\\pi(\d).*d=(\d)", task.question)[0]
        value = np.sin(Dual(np.pi / int(below), float(distance)))
        assert task.judge(value).right


def test_a_small_epsilon_is_recognised() -> None:
    task = find("01.9").task()
    n = 3 if "^3$" in task.question else 4
    wrong = f"((a + b)**{n} - a**{n}) - {1 if n == 3 else '4*a'}*b**3 - {0 if n == 3 else 1}*b**4"
    assert task.judge({"line": task.wrong_line, "then": wrong}).slip == "ε² kept"
