"""The app of lesson 02, as the kernel sees it: two lines, their controls, their read-outs."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab.exercises.core import Choose, Code, FindSlip, Number, find
from ruledlab.lab import two_lines
from ruledlab.lab.apps.lesson_02 import NUMBERS
from ruledlab.lab.scenes.line_pair import PRESETS
from ruledlab.pair import TwoLines

SEEDS = ("", "1", "2", "Ada", "Σ", "q")


@pytest.fixture
def app():
    app = two_lines()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


def shown(app):
    """All that the app shows, as texts."""
    return app.of_pair.value, app.of_lines.value, app.view._words.value


# -- controls --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["a", "b"])
def test_a_slider_goes_to_both_ends_and_back(app, name):
    app.lines.which.value = name
    before, said = app.slate.value, shown(app)
    for key, control in app.lines.numbers.items():
        for end in NUMBERS[key][1]:
            control.slider.value = end
            assert getattr(getattr(app.slate.value, name), key) == pytest.approx(end, abs=0.01)
            # line B is parallel to the x-axis: its given point slides along it, and nothing follows
            assert (shown(app) == said) == ((name, key) == ("b", "x"))
            assert not control.error.value
        control.field.value = repr(getattr(getattr(before, name), key))
        assert app.slate.value == before
        assert shown(app) == said


@pytest.mark.parametrize("key", NUMBERS)
def test_what_cannot_be_is_said_beside_the_control_and_changes_nothing(app, key):
    before, said, control = app.slate.value, shown(app), app.lines.numbers[key]
    others = [number for name, number in app.lines.numbers.items() if name != key]
    for text in ("7", "banana", "1/0", "u", ""):
        control.field.value = text
        assert "ruledlab-error" in control.error.value
        assert (app.slate.value, shown(app)) == (before, said)
        assert not any(number.error.value for number in others)
    control.field.value = "0.5"
    assert not control.error.value
    assert getattr(app.slate.value.a, key) == 0.5


def test_the_choice_of_a_line_shows_its_numbers_and_changes_nothing(app):
    before = app.slate.value
    for name in ("b", "a"):
        app.lines.which.value = name
        line = getattr(before, name)
        for key, control in app.lines.numbers.items():
            assert control.slider.value == pytest.approx(getattr(line, key), abs=0.026)
    assert app.slate.value == before
    assert not app.slate.can_undo


def test_only_the_chosen_line_moves(app):
    before = app.slate.value
    app.lines.which.value = "b"
    app.lines.numbers["x"].slider.value = 2.0
    assert app.slate.value == TwoLines(before.a, replace(before.b, x=2.0))


def test_formulas_may_be_typed(app):
    app.lines.numbers["u"].field.value = "3*pi/4"
    assert app.slate.value.a.u == 3 * math.pi / 4


def test_the_menu_puts_two_lines_in_place_and_undo_leads_back(app):
    for name, lines in PRESETS.items():
        app.lines.numbers["y"].field.value = "3"
        moved = app.slate.value
        assert app.preset.menu.value == ""
        app.preset.menu.value = name
        assert app.slate.value == lines
        assert f"<b>{name}</b>" in app.of_pair.value
        app.history.undo.click()
        assert (app.slate.value, app.preset.menu.value) == (moved, "")
        app.history.redo.click()
        assert (app.slate.value, app.preset.menu.value) == (lines, name)
        app.history.reset.click()
        assert (app.slate.value, app.preset.menu.value) == (PRESETS["skew"], "skew")


def test_the_moves_of_one_slider_are_one_step_of_undo(app):
    before = app.slate.value
    for value in (2.0, 2.5, 3.0):
        app.lines.numbers["x"].slider.value = value
    app.history.undo.click()
    assert app.slate.value == before
    assert not app.slate.can_undo


@pytest.mark.parametrize("name", ["a", "b"])
def test_reverse_changes_both_signs_of_the_chosen_line_only(app, name):
    other = {"a": "b", "b": "a"}[name]
    app.lines.which.value = name
    before = app.slate.result
    app.lines.reverse.click()
    after = app.slate.result
    for part in ("direction", "moment"):
        old, new = (getattr(getattr(pair, name), part) for pair in (before, after))
        np.testing.assert_allclose(new, -old, atol=1e-14)
        same = [getattr(getattr(pair, other), part) for pair in (before, after)]
        np.testing.assert_array_equal(*same)
    assert after.across.distance == pytest.approx(-before.across.distance)
    assert app.preset.menu.value == ""
    app.lines.reverse.click()
    np.testing.assert_allclose(app.slate.result.a.moment, before.a.moment, atol=1e-14)


# -- handles -----------------------------------------------------------------------------------


def pull(app, index, by, drag=1):
    """Move a handle in the picture by pixels."""
    handle = app.grips.picture["handles"][index]
    app.grips.motion = ["view", drag, index, handle["x"] + by[0], handle["y"] + by[1]]
    return handle


@pytest.mark.parametrize(("index", "name"), [(0, "a"), (2, "b")])
def test_the_disc_takes_the_line_along_as_it_points(app, index, name):
    before, other = getattr(app.slate.value, name), app.slate.value
    handle = pull(app, index, (30, -20))
    after = getattr(app.slate.value, name)
    assert (after.u, after.v) == (before.u, before.v)
    assert after.point.tolist() != before.point.tolist()
    assert app.slate.value == replace(other, **{name: after})
    now = app.grips.picture["handles"][index]  # within the rounding to 0.01
    assert (now["x"], now["y"]) == pytest.approx((handle["x"] + 30, handle["y"] - 20), abs=0.6)
    assert app.lines.which.value == name
    assert app.lines.numbers["x"].field.value == f"{after.x:g}"


@pytest.mark.parametrize(("index", "name"), [(1, "a"), (3, "b")])
def test_the_diamond_turns_the_line_about_its_given_point(app, index, name):
    before = getattr(app.slate.value, name)
    pivot, tip = app.grips.picture["handles"][index - 1 : index + 1]
    pull(app, index, (-25, 35))
    after = getattr(app.slate.value, name)
    assert (after.x, after.y, after.z) == (before.x, before.y, before.z)
    assert (after.u, after.v) != (before.u, before.v)
    still, now = app.grips.picture["handles"][index - 1 : index + 1]
    assert still == pivot
    wanted = complex(tip["x"] - 25 - pivot["x"], tip["y"] + 35 - pivot["y"])
    found = complex(now["x"] - pivot["x"], now["y"] - pivot["y"])
    assert abs((found / wanted).imag) < 0.03 * abs(found / wanted), "it points to the pointer"
    assert (found / wanted).real > 0


def test_a_drag_is_one_step_of_undo_and_the_next_another(app):
    first = app.slate.value
    for step in (10, 20, 30):
        pull(app, 0, (step, 0), drag=1)
    second = app.slate.value
    pull(app, 0, (10, 10), drag=2)
    app.history.undo.click()
    assert app.slate.value == second
    app.history.undo.click()
    assert app.slate.value == first
    assert not app.slate.can_undo


def test_a_handle_keeps_within_the_reach_of_the_sliders(app):
    for index in range(4):
        for by in ((5000, 0), (-5000, 0), (0, 5000), (0, -5000)):
            pull(app, index, by, drag=index)
            for name in "ab":
                line = getattr(app.slate.value, name)
                for key, (_, (low, high), _) in NUMBERS.items():
                    assert low <= getattr(line, key) <= high
    assert app.slate.result.across.relation
    for number in app.lines.numbers.values():
        assert not number.error.value


def test_the_handles_have_names(app):
    labels = [handle["label"] for handle in app.grips.picture["handles"]]
    assert labels == [f"{what} of line {n}" for n in "AB" for what in ("given point", "direction")]


# -- views -----------------------------------------------------------------------------------------


def test_the_picture_follows_and_can_leave_things_out(app, monkeypatch):
    drawn = []
    monkeypatch.setattr(app.view, "overlay", drawn.append)
    app.lines.numbers["x"].slider.value = 2.0
    app.look.moments.value = False
    app.look.sphere.value = False
    names = [{stroke.name for stroke in overlay.strokes} for overlay in drawn]
    assert len(drawn) == 3
    assert ["moment a" in seen for seen in names] == [True, False, False]
    assert [bool(overlay.sheets) for overlay in drawn] == [True, True, False]


def test_the_camera_stays_while_a_line_moves_and_comes_back_for_another_position(app, monkeypatch):
    frames = []
    monkeypatch.setattr(app.view, "frame", lambda *ball: frames.append(ball))
    app.lines.numbers["x"].slider.value = 2.0
    assert not frames
    app.preset.menu.value = "parallel"
    app.look.home.click()
    assert len(frames) == 2


def test_the_words_for_the_picture_follow(app):
    app.preset.menu.value = "meeting"
    assert "They are meeting" in app.view._words.value
    app.preset.menu.value = "equal"
    assert "one line, X = Y" in app.view._words.value


def test_an_app_begins_where_it_is_told():
    app = two_lines(PRESETS["parallel"])
    assert app.slate.value == PRESETS["parallel"]
    assert app.preset.menu.value == "parallel"
    app.close()


def test_it_closes_without_a_trace():
    before = set(ipywidgets.widget._instances)
    app = two_lines()
    app.preset.menu.value = "parallel"
    app.lines.which.value = "b"
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not app.slate._followers
    app.close()
    app.slate.load(PRESETS["equal"], "test")


# -- the numbers of the exercises, by another route ------------------------------------------------


def vectors(text):
    """The vectors that a question prints, in their order."""
    found = []
    for part in text.replace(r"\,", "").split("(")[1:]:
        entries = part.partition(")")[0].split(",")
        with suppress(ValueError):  # a letter: no printed vector
            found.append(np.array([float(entry) for entry in entries]))
    return [vector for vector in found if len(vector) == 3]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_moment_asked_for_is_that_of_the_printed_points(seed):
    task = find("02.1").task(seed)
    assert isinstance(task, Number)
    p, q = vectors(task.question)
    for point in (p, q):
        moment = np.cross(point, (q - p) / np.linalg.norm(q - p))
        np.testing.assert_allclose(task.answer, moment, atol=1e-12)
    assert task.judge(np.cross((q - p) / 5, p)).slip == "sign of the moment"
    assert task.judge(np.cross(p, q)).slip == "direction not of length 1"


@pytest.mark.parametrize("seed", SEEDS)
def test_only_the_right_pair_is_a_line(seed):
    task = find("02.3").task(seed)
    assert isinstance(task, Choose)
    for option in task.options:
        x, moment = vectors(option.text)
        line = abs(np.linalg.norm(x) - 1) < 1e-9 and abs(x @ moment) < 1e-9
        assert line == option.right


@pytest.mark.parametrize("seed", SEEDS)
def test_the_dual_angle_asked_for_is_that_of_the_printed_lines(seed):
    task = find("02.6").task(seed)
    assert isinstance(task, Code)
    c, x, e, y = vectors(task.question)
    n = np.cross(x, y) / np.linalg.norm(np.cross(x, y))
    theta = math.acos(x @ y / np.linalg.norm(x) / np.linalg.norm(y))
    d = (e - c) @ n
    np.testing.assert_allclose(task.answer, [theta, d], atol=1e-12)
    assert theta > math.pi / 2
    assert d < 0, "else an unsigned distance would be right"
    assert task.judge([theta, abs(d)]).slip == "distance unsigned"


def test_the_lines_of_the_app_meet_at_the_height_that_is_right_and_at_no_other(app):
    for seed in SEEDS:
        task = find("02.7").task(seed)
        assert isinstance(task, Number)
        a = vectors(task.question)[0]
        beside = task.question.split("(1,")[-1].split(",")[0]
        put = {"a": ("0", "pi/2", *map(str, a)), "b": ("pi/2", "pi/4", "1", beside)}
        for name, texts in put.items():
            app.lines.which.value = name
            for key, text in zip(NUMBERS, texts, strict=False):
                app.lines.numbers[key].field.value = text
        app.lines.numbers["z"].field.value = str(task.answer)
        assert app.slate.result.across.relation == "meeting"
        for slip in task.slips:
            app.lines.numbers["z"].field.value = str(slip.example)
            assert app.slate.result.across.relation == "skew"


@pytest.mark.parametrize("seed", SEEDS)
def test_the_dual_part_asked_for_is_that_of_the_lines(seed):
    from ruledlab.exercises.answers import read_formula

    task = find("02.8").task(seed)
    times = int(task.question.split("(0,0,")[1].split("h")[0])
    for a, h in ((0.4, 1.3), (2.2, -0.7)):
        moment = np.cross([0, 0, times * h], [math.cos(a), math.sin(a), 0])
        value = read_formula(task.answer, ("a", "h"))(np.array([a]), np.array([h]))
        assert value[0] == pytest.approx(moment[0])


@pytest.mark.parametrize("seed", SEEDS)
def test_only_the_right_line_meets_the_axis(seed):
    task = find("02.9").task(seed)
    assert isinstance(task, Choose)
    for option in task.options:
        point, direction = vectors(option.text)
        triple = np.linalg.det([[0, 0, 1], direction, point])
        across = np.linalg.norm(np.cross([0, 0, 1], direction))
        assert (abs(triple) < 1e-9 and across > 0) == option.right


@pytest.mark.parametrize("seed", SEEDS)
def test_the_curve_to_sketch_is_that_of_the_turning_line(seed):
    task = find("02.11").task(seed)
    height = 1.0 if "1 above" in task.question else -1.0
    for t in (0.0, 0.2, 0.5, 0.9, 1.0):
        y = np.array([math.cos(math.pi * t), math.sin(math.pi * t), 0.0])
        moment = np.cross([0.0, 0.0, height], y)
        assert task.curve(np.array([t]))[0] == pytest.approx(moment[0])  # x = e₁, x̄ = 0


@pytest.mark.parametrize("seed", SEEDS)
def test_parallel_lines_are_as_far_apart_as_their_points_seen_from_above(seed):
    task = find("02.10").task(seed)
    assert isinstance(task, FindSlip)
    (point, _) = vectors(task.question)
    assert task.then.answer == pytest.approx(math.hypot(point[0], point[1]))
    assert task.then.judge("0").slip == "d from sin θ = 0"
    assert task.judge({"line": 3, "then": task.then.answer}).right


def test_the_misconceptions_of_the_lesson_have_names():
    from ruledlab.exercises import lesson

    names = set()
    for exercise in lesson("02"):
        task = exercise.task()
        for part in (task, getattr(task, "then", None)):
            names |= {slip.name for slip in getattr(part, "slips", ())}
            names |= {option.slip for option in getattr(part, "options", ())}
    assert {"sign of the moment", "distance unsigned", "d from sin θ = 0"} <= names


def test_most_exercises_have_values_that_vary():
    from ruledlab.exercises import lesson

    varied = [e for e in lesson("02") if len({_values(e.task(str(n))) for n in range(5)}) > 1]
    assert len(varied) >= 8


def _values(task):
    return f"{task.question}{getattr(task, 'order', '')}{task.right_answer()}"
