"""What the reader moves: each control changes its own entry, exactly, and says what it cannot do.

A trait that is set here is what the browser sends when the reader acts.
"""

from __future__ import annotations

import math
import re
import threading
from dataclasses import fields
from functools import cached_property
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("ipywidgets")

from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.design import CLOSINGS, Design
from ruledlab.geometry import gallery
from ruledlab.geometry.choices import CHOICES
from ruledlab.geometry.curve import Bezier, seam
from ruledlab.lab import controls
from ruledlab.lab.controls import (
    FieldControl,
    GalleryControl,
    Group,
    HistoryControl,
    LookControl,
    NumberControl,
    Player,
    PointControl,
    Readouts,
    TimeControl,
    design_of,
)
from ruledlab.lab.slate import Change
from ruledlab.lab.state import Lab

PI = math.pi
OPEN = Design(((0.3, 0.8), (1.0, 1.4), (1.9, 1.1), (2.5, 0.9)), "u - v", "0.5", samples=50)
LOOP = design_of(gallery.example("twisted_ring")).with_(samples=50)


class FakeView:
    """Remembers what it was asked for."""

    names = ("kappa", "tau")

    def __init__(self):
        self.asked = []

    def show(self, **parts):
        self.asked.append(("show", parts))

    def sphere(self, mode):
        self.asked.append(("sphere", mode))

    def reset_view(self):
        self.asked.append(("reset_view",))

    def legend_html(self, scene):
        return f"legend of {scene.colour_label}"

    def choose(self, names):
        self.names = tuple(names)
        self.asked.append(("choose", self.names))


class Bench:
    """The controls of one lab, each made when it is first asked for."""

    def __init__(self, design):
        self.lab, self.view, self.plots = Lab(design), FakeView(), FakeView()

    points = cached_property(lambda self: PointControl(self.lab))
    fields = cached_property(lambda self: FieldControl(self.lab))
    time = cached_property(lambda self: TimeControl(self.lab))
    history = cached_property(lambda self: HistoryControl(self.lab))
    gallery = cached_property(lambda self: GalleryControl(self.lab))
    look = cached_property(lambda self: LookControl(self.lab, self.view, self.plots))
    readouts = cached_property(lambda self: Readouts(self.lab))

    @property
    def groups(self):
        return [value for value in vars(self).values() if isinstance(value, Group)]

    def all(self):
        """Make all controls; return what there is."""
        return (self.points, self.fields, self.time, self.history, self.gallery, self.look,
                self.readouts)  # fmt: skip

    def errors(self):
        """Return every message that is shown, by place."""
        shown, made = {}, vars(self)
        if "points" in made:
            shown |= {"u": self.points.u.error, "v": self.points.v.error}
            shown |= {"degree": self.points.count.error, "points": self.points.error}
        if "look" in made:
            shown |= {"length": self.look.length.error, "samples": self.look.samples.error}
        if "time" in made:
            shown["t"] = self.time.t.error
        if "fields" in made:
            shown |= {name: row[2] for name, row in self.fields.rows.items()}
        texts = {name: re.sub("<[^>]+>", "", widget.value) for name, widget in shown.items()}
        return {name: text for name, text in texts.items() if text}

    def defects(self):
        return [group.defect.value for group in self.groups if group.defect.value]

    def close(self):
        for group in self.groups:
            group.release()


@pytest.fixture
def bench():
    bench = Bench(OPEN)
    yield bench
    assert bench.defects() == []
    bench.close()
    assert not bench.lab._followers, "a control left a follower"


@pytest.fixture
def ring():
    bench = Bench(LOOP)
    yield bench
    assert bench.defects() == []
    bench.close()


def changed(before, after):
    """Return the names of the entries that differ."""
    return {f.name for f in fields(Design) if getattr(before, f.name) != getattr(after, f.name)}


# ---- each control changes exactly its entry -----------------------------------------------------


ENTRIES = {
    "u slider": (lambda b: b.points.u.slider, 1.23, "points", lambda d: d.points[0] == (1.23, 0.8)),
    "u field": (lambda b: b.points.u.field, "3*pi/8", "points",
                lambda d: d.points[0] == (3 * PI / 8, 0.8)),
    "v slider": (lambda b: b.points.v.slider, 2.5, "points", lambda d: d.points[0] == (0.3, 2.5)),
    "v field": (lambda b: b.points.v.field, "arccos(1/3)", "points",
                lambda d: d.points[0] == (0.3, float(np.arccos(1 / 3)))),
    "degree": (lambda b: b.points.count.slider, 5, "points", lambda d: len(d.points) == 6),
    "degree field": (lambda b: b.points.count.field, "2+3", "points", lambda d: len(d.points) == 6),
    "ubar": (lambda b: b.fields.rows["ubar"][0], "sin(u)", "ubar", lambda d: d.ubar == "sin(u)"),
    "vbar": (lambda b: b.fields.rows["vbar"][0], " u*v", "vbar", lambda d: d.vbar == "u*v"),
    "ubar menu": (lambda b: b.fields.rows["ubar"][1], "u + v", "ubar", lambda d: d.ubar == "u + v"),
    "vbar menu": (lambda b: b.fields.rows["vbar"][1], "u", "vbar", lambda d: d.vbar == "u"),
    "length": (lambda b: b.look.length.slider, 3.35, "length", lambda d: d.length == 3.35),
    "length field": (lambda b: b.look.length.field, "sqrt(2)", "length",
                     lambda d: d.length == math.sqrt(2)),
    "samples": (lambda b: b.look.samples.slider, 120, "samples", lambda d: d.samples == 120),
    "samples field": (lambda b: b.look.samples.field, "123", "samples", lambda d: d.samples == 123),
    "base": (lambda b: b.look.base, "foot", "base", lambda d: d.base == "foot"),
}  # fmt: skip


@pytest.mark.parametrize(("widget", "value", "entry", "holds"), ENTRIES.values(), ids=ENTRIES)
def test_a_control_changes_exactly_its_entry(bench, widget, value, entry, holds):
    told = []
    end = bench.lab.follow(told.append)
    widget(bench).value = value
    end()
    assert holds(bench.lab.design)
    assert changed(OPEN, bench.lab.design) == {entry}
    assert len(told) == 1
    assert bench.errors() == {}
    if entry == "points" and len(bench.lab.design.points) == len(OPEN.points):
        assert bench.lab.design.points[1:] == OPEN.points[1:]
    bench.history.undo.click()
    assert bench.lab.design == OPEN
    assert not bench.lab.can_undo


@pytest.mark.parametrize("axis", ["u", "v"])
@pytest.mark.parametrize("index", range(4))
def test_sliders_move_the_chosen_point(bench, axis, index):
    bench.points.chosen.value = index
    assert bench.lab.chosen == index
    control = getattr(bench.points, axis)
    place = "uv".index(axis)
    assert control._value == OPEN.points[index][place]
    control.slider.value = 0.5
    assert bench.lab.design.points[index][place] == 0.5
    others = [i for i in range(4) if i != index]
    assert all(bench.lab.design.points[i] == OPEN.points[i] for i in others)


@pytest.mark.parametrize(
    ("typed", "kept"), [("2u v", "2*u*v"), ("u²−v", "u**2-v"), ("u - v", "u - v")]
)
def test_formulas_are_read_as_people_write_them(bench, typed, kept):
    field = bench.fields.rows["ubar"][0]
    field.value = typed
    assert (bench.lab.design.ubar, field.value) == (kept, kept)
    assert bench.fields.rows["ubar"][2].value == ""


@pytest.mark.parametrize("typed", ["3π/8", "3 pi/8", "(3/8)π"])
def test_numbers_are_read_as_people_write_them(bench, typed):
    bench.points.v.field.value = typed
    assert bench.lab.design.points[bench.lab.chosen][1] == pytest.approx(3 * np.pi / 8, rel=1e-15)
    assert bench.points.v.error.value == ""


def test_typed_numbers_are_shown_as_typed_and_slider_stands_near(bench):
    bench.points.u.field.value = "3*pi/8"
    assert bench.points.u.field.value == "3*pi/8"
    assert bench.points.u.slider.value == pytest.approx(1.18)
    bench.points.u.field.value = "0.1 + 0.2"
    assert bench.lab.design.points[0][0] == 0.1 + 0.2


@pytest.mark.parametrize(
    ("typed", "expected"),
    [("20", 20), ("-20", -20), ("100*pi", 100 * PI), ("6.31", 6.31), ("6.301", 6.301)],
)
def test_a_typed_number_beyond_the_slider_moves_its_end(bench, typed, expected):
    control = bench.points.u
    control.field.value = typed
    value = bench.lab.design.points[0][0]
    assert value == pytest.approx(expected)
    slider = control.slider
    assert slider.min <= value <= slider.max
    assert abs(slider.value - value) <= 0.51 * slider.step
    assert bench.errors() == {}
    control.field.value = "1"
    assert control.slider.value == pytest.approx(1.0)
    assert (slider.min, slider.max) == control.ends  # and back, or a hand could not use it


def test_the_ends_stay_for_numbers_within(bench):
    before = [(c.slider.min, c.slider.max) for c in (bench.points.u, bench.points.v)]
    for value in (-3.15, 6.3, 0.07, -1.14, 6.29):
        bench.points.u.field.value = repr(value)
    for value in (0.0, 3.15, 1.1):
        bench.points.v.field.value = repr(value)
    assert [(c.slider.min, c.slider.max) for c in (bench.points.u, bench.points.v)] == before


def test_a_late_echo_of_the_slider_does_not_take_a_drag_back(bench):
    """A point is dragged on; only then comes the report of a place the slider was given before."""
    places = [0.87, 0.91, 0.9224]
    for v in places:
        bench.points.place(0, (0.3, v), "drag")
    slider = bench.points.v.slider
    for v in places[:2]:
        slider.set_state({"value": v - 1e-15})
        assert bench.lab.design.points[0] == (0.3, 0.9224)
        assert slider.value == pytest.approx(0.92), "what is here is what the browser shows"
    slider.set_state({"value": 0.87})  # the same once more: that is the reader
    assert bench.lab.design.points[0] == (0.3, 0.87)


@given(st.floats(-3.15, 6.3))
@settings(max_examples=60)
def test_the_echo_of_the_slider_leaves_an_exact_value_alone(value):
    """The browser puts a slider on its grid and reports that place: no move of the reader."""
    group, committed = Group(), []
    control = NumberControl(group, "u", "u", (-3.15, 6.3), 0.01, committed.append)
    control.show(value)
    slider = control.slider
    shown = slider.value
    assert committed == []
    steps = (shown - slider.min) / slider.step
    assert abs(steps - round(steps)) < 1e-6 or shown == slider.max
    grid = slider.min + slider.step * round((value - slider.min) / slider.step)
    slider.value = min(max(grid + 1e-13, slider.min), slider.max)
    assert committed == []
    moved = shown + (3 if shown < 6 else -3) * slider.step
    slider.value = moved
    assert committed == [pytest.approx(moved)]
    group.release()


def test_exact_points_survive_all_echoes(ring):
    before = ring.lab.design
    for index in range(len(before.points)):
        ring.points.chosen.value = index
        for control in (ring.points.u, ring.points.v):
            place = control.slider.value
            control.slider.set_state({"value": place + 1e-12})
            control.slider.set_state({"value": place})
    ring.look.samples.slider.value = 50
    assert ring.lab.design == before
    assert not ring.lab.can_undo


# ---- what cannot be is said beside the control --------------------------------------------------


BAD = {
    "u": (lambda b: b.points.u.field, "3*pi/", "3*pi/8"),
    "v": (lambda b: b.points.v.field, "abc", "1.5"),
    "degree": (lambda b: b.points.count.field, "2.5", "4"),
    "t": (lambda b: b.time.t.field, "1.5", "0.5"),
    "length": (lambda b: b.look.length.field, "-1", "3"),
    "samples": (lambda b: b.look.samples.field, "1000000", "100"),
    "ubar": (lambda b: b.fields.rows["ubar"][0], "sin(u", "sin(u)"),
    "vbar": (lambda b: b.fields.rows["vbar"][0], "__import__('os')", "v"),
    "points": (lambda b: b.points.u.field, "1e101", "1"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_entry_is_refused_beside_its_control(bench, name):
    bench.all()
    widget, bad, good = BAD[name]
    before, result, cursor = bench.lab.design, bench.lab.result, bench.lab.cursor
    original = widget(bench).value
    widget(bench).value = bad
    errors = bench.errors()
    assert set(errors) == {name}
    assert "`" not in errors[name]
    assert (bench.lab.design, bench.lab.result, bench.lab.cursor) == (before, result, cursor)
    assert not bench.lab.can_undo
    widget(bench).value = good
    assert bench.errors() == {}
    # The same with the value there was before: nothing changes, but the message goes.
    bench.history.undo.click()
    bench.lab.move_cursor(cursor)
    widget(bench).value = bad
    assert set(bench.errors()) == {name}
    widget(bench).value = original
    assert bench.errors() == {}
    assert bench.lab.design == before


@pytest.mark.parametrize(
    "typed", ["", "u", "1/0", "nan", "inf", "10**10**10", "3,5", "__import__('os')"]
)
def test_bad_numbers_point_at_the_place(bench, typed):
    bench.points.v.field.value = "1"
    bench.points.v.field.value = typed
    assert set(bench.errors()) == {"v"}
    assert 'role="alert"' in bench.points.v.error.value
    assert bench.lab.design.points[0] == (0.3, 1.0)


def test_messages_are_text_not_html(bench):
    bench.fields.rows["ubar"][0].value = "<img src=x onerror=alert(1)>"
    assert "<img" not in bench.fields.rows["ubar"][2].value
    assert "&lt;img" in bench.fields.rows["ubar"][2].value


def test_a_bad_formula_shows_a_caret_under_the_place(bench):
    bench.fields.rows["vbar"][0].value = "u + $"
    assert "<pre>u + $\n    ^</pre>" in bench.fields.rows["vbar"][2].value


def test_a_degree_out_of_reach(bench):
    bench.points.count.field.value = "61"
    assert "60" in bench.errors()["points"]
    assert bench.points.count.field.value == "3"
    bench.lab.load(design_of(gallery.example("example_2")), "test")
    before = bench.lab.design
    bench.points.count.field.value = "2"
    assert "degree" in bench.errors()["points"]
    assert (bench.lab.design, bench.points.count.slider.value) == (before, 6)


def test_a_closing_out_of_reach_goes_back(bench):
    bench.points.closing.value = "C2"
    assert "degree" in bench.errors()["points"]
    assert (bench.points.closing.value, bench.lab.design) == ("open", OPEN)
    bench.points.closing.value = "C0"
    assert bench.errors() == {}
    assert bench.lab.design.closing == "C0"


# ---- points -------------------------------------------------------------------------------------


@pytest.mark.parametrize("closing", ["C0", "C1", "C2"])
@pytest.mark.parametrize("key", ["example_2", "twisted_ring"])
def test_the_closing_is_kept_while_a_point_is_dragged(closing, key):
    bench = Bench(design_of(gallery.example(key)).with_(samples=8, closing="open"))
    bench.points.closing.value = closing
    lab = bench.lab
    assert lab.design.closing == closing
    count, order = len(lab.design.points), CLOSINGS[closing]
    for index in range(count):
        before, (u, v) = lab.design.points, lab.design.points[index]
        for step in (0.05, -0.02):
            to = (u + step, v - 0.7 * step)
            assert bench.points.place(index, to, ("drag", index))
            assert lab.design.points[index] == to
            assert seam(lab.design.points).order >= order
        lab.undo()
        assert lab.design.points == before, "a drag is one step"
    assert (bench.defects(), bench.errors()) == ([], {})
    bench.close()


@pytest.mark.parametrize("closing", ["open", "C0", "C1", "C2"])
def test_points_come_and_go_also_near_the_seam(closing):
    bench = Bench(LOOP.with_(closing=closing, samples=8))
    lab, order = bench.lab, CLOSINGS[closing]
    for index in range(len(LOOP.points) + 1):
        at = (0.5 + 0.3 * index, 1.2)
        assert bench.points.insert_at(index, at)
        assert len(lab.design.points) == len(LOOP.points) + 1
        assert at in lab.design.points
        assert lab.design.points[lab.chosen] == at
        assert seam(lab.design.points).order >= order
        lab.undo()
        assert lab.design.points == LOOP.points
        if index < len(LOOP.points):
            assert bench.points.remove_at(index)
            assert len(lab.design.points) == len(LOOP.points) - 1
            assert seam(lab.design.points).order >= order
            assert lab.chosen < len(lab.design.points)
            assert len(bench.points.chosen.options) == len(lab.design.points)
            lab.undo()
    assert (bench.defects(), bench.errors()) == ([], {})
    bench.close()


def test_removing_too_many_points_is_refused(bench):
    assert bench.points.remove_at(0)
    assert bench.points.remove_at(0)
    assert not bench.points.remove_at(0)
    assert "at least 2 points" in bench.errors()["points"]
    assert not bench.points.remove_at(7)
    assert len(bench.lab.design.points) == 2


def test_the_menu_of_points_follows(bench):
    bench.lab.choose(3)
    assert bench.points.chosen.value == 3
    bench.points.remove_at(1)
    assert (bench.lab.chosen, bench.points.chosen.value) == (2, 2)
    assert [value for _, value in bench.points.chosen.options] == [0, 1, 2]
    bench.points.count.slider.value = 6
    assert [value for _, value in bench.points.chosen.options] == list(range(7))
    assert bench.points.chosen.value == 2


def test_degree_up_keeps_the_curve_and_down_again_the_points(bench):
    t = np.linspace(0, 1, 11)
    curve = Bezier(OPEN.points)(t)
    for degree in (4, 9, 20):
        bench.points.count.slider.value = degree
        assert len(bench.lab.design.points) == degree + 1
        assert np.allclose(Bezier(bench.lab.design.points)(t), curve, atol=1e-12)
    bench.points.count.slider.value = 3
    assert np.allclose(bench.lab.design.points, OPEN.points, atol=1e-9)


@pytest.mark.parametrize("closing", ["C0", "C1", "C2"])
def test_degree_up_and_down_keeps_the_closing(closing):
    bench = Bench(design_of(gallery.example("orchid")).with_(samples=8, closing=closing))
    for degree in (12, 7, 6, 9):
        bench.points.count.slider.value = degree
        assert len(bench.lab.design.points) == degree + 1
        assert bench.lab.design.closing == closing
        assert seam(bench.lab.design.points).order >= CLOSINGS[closing]
    assert (bench.defects(), bench.errors()) == ([], {})
    bench.close()


# ---- both ends and back -------------------------------------------------------------------------


SLIDERS = {
    "u": lambda b: b.points.u,
    "v": lambda b: b.points.v,
    "length": lambda b: b.look.length,
    "samples": lambda b: b.look.samples,
    "t": lambda b: b.time.t,
}


@pytest.mark.parametrize("control", SLIDERS.values(), ids=SLIDERS)
def test_to_both_ends_and_back_gives_the_same_result(bench, control):
    control = control(bench)
    text, design, mark = control.field.value, bench.lab.design, bench.lab.mark
    curves = bench.lab.result.scene.curves
    for end in (control.slider.max, control.slider.min):
        control.slider.value = end
        shown = bench.lab.cursor if control is bench.time.t else None
        assert control._value == end if shown is None else shown == end
        assert bench.errors() == {}
    control.field.value = text
    assert (bench.lab.design, bench.lab.mark.text) == (design, mark.text)
    for name, values in bench.lab.result.scene.curves.items():
        assert np.array_equal(values, curves[name], equal_nan=True)


def test_the_degree_to_both_ends_and_undo(bench):
    for end in (20, 1, 20):
        bench.points.count.slider.value = end
        assert len(bench.lab.design.points) == end + 1
    assert bench.errors() == {}
    bench.history.undo.click()
    assert bench.lab.design == OPEN


MENUS = {
    "closing": lambda b: b.points.closing,
    "pair": lambda b: b.fields.pair,
    "gallery": lambda b: b.gallery.menu,
    "colour": lambda b: b.look.colour,
    "sphere": lambda b: b.look.sphere,
    "base": lambda b: b.look.base,
    "chosen": lambda b: b.points.chosen,
}


@pytest.mark.parametrize("menu", MENUS.values(), ids=MENUS)
def test_every_choice_of_every_menu(ring, menu):
    menu, before = menu(ring), ring.lab.design
    values = [o if isinstance(o, str) else o[1] for o in menu.options]
    for value in [*values, values[0]]:
        menu.value = value
        assert ring.defects() == []
        assert ring.errors() == {}
    ring.lab.reset()
    assert ring.lab.design == before


# ---- ū and v̄ ------------------------------------------------------------------------------------


@pytest.mark.parametrize("choice", CHOICES, ids=lambda choice: choice.key)
def test_named_choices(bench, choice):
    bench.fields.pair.value = choice.key
    assert (bench.lab.design.ubar, bench.lab.design.vbar) == (choice.ubar, choice.vbar)
    assert changed(OPEN, bench.lab.design) <= {"ubar", "vbar"}
    assert bench.fields.rows["ubar"][0].value == choice.ubar
    assert bench.fields.pair.value == choice.key
    bench.fields.rows["ubar"][0].value = "0.123"
    assert bench.fields.pair.value == ""
    assert choice.meaning[:20] not in bench.fields.meaning.value
    bench.lab.undo()
    assert bench.fields.pair.value == choice.key


def test_both_formulas_change_in_one_step(bench):
    bench.fields.pair.value = "paper"
    assert bench.lab.can_undo
    bench.lab.undo()
    assert not bench.lab.can_undo


def test_formulas_are_typeset(bench):
    bench.fields.rows["ubar"][0].value = "sin(u)/v"
    text = bench.fields.typeset.value
    assert r"\bar u = " in text
    assert r"\frac" in text
    bench.fields.rows["ubar"][0].value = "sin(u)/"
    assert bench.fields.typeset.value == text, "the last good formula stays"


def test_a_menu_of_formulas_can_be_used_twice(bench):
    menu = bench.fields.rows["ubar"][1]
    menu.value = "u + v"
    assert menu.value == ""
    bench.lab.undo()
    menu.value = "u + v"
    assert bench.lab.design.ubar == "u + v"


# ---- time ---------------------------------------------------------------------------------------


def test_play_slider_and_field_are_one_cursor(bench):
    assert (bench.time.play.value, bench.time.t.field.value) == (0, "0")
    bench.time.play.value = 100
    assert (bench.lab.cursor, bench.time.t.slider.value) == (0.25, 0.25)
    bench.time.t.slider.value = 0.5
    assert (bench.lab.cursor, bench.time.play.value) == (0.5, 200)
    bench.time.t.field.value = "1/3"
    assert bench.lab.cursor == 1 / 3
    bench.lab.move_cursor(0.75)
    assert (bench.time.play.value, bench.time.t.field.value) == (300, "0.75")
    assert not bench.lab.can_undo


def test_play_walks_over_all_its_places_without_stumbling(bench):
    for step in range(0, controls.STEPS + 1, 8):
        bench.time.play.value = step
        assert bench.time.play.value == step
        assert bench.lab.cursor == pytest.approx(step / controls.STEPS)


def ticks(play):
    """Where the browser's button leads: the values it sends until it stops."""
    if play.value == play.max:
        play.value = play.min
        yield
    while play.value + play.step <= play.max:
        play.value += play.step
        yield


@pytest.mark.parametrize("t", ["0.0025", "0.9975", "1/3", "1"])
def test_a_run_gets_to_the_end_wherever_it_begins(bench, t):
    bench.time.t.field.value = t
    assert len(list(ticks(bench.time.play))) > 0
    assert bench.lab.cursor == 1.0


def run_of(span, start):
    """A number that runs there and back, and where it has been."""
    group, been = Group(), []

    def go(value):
        been.append(value)
        player.show(value, span)

    player = Player(group, "x, there and back", go, back=True)
    player.show(start, span)
    return player, been


@given(st.floats(-3, 3), st.floats(0.01, 5), st.floats(0, 1))
def test_a_run_there_and_back_has_no_jump(low, width, part):
    start = low + part * width
    player, been = run_of((low, low + width), start)
    list(ticks(player.widget))
    pace = width * player.PACE / controls.STEPS
    gone = np.diff([start, *been])
    assert np.abs(gone).max() <= 1.501 * pace  # the first may be longer by half a step
    assert low + width - max(start, *been) <= 0.501 * pace
    assert been[-1] == pytest.approx(low)
    assert np.count_nonzero(np.diff(np.sign(gone))) <= 1  # there, then back
    first = been[-1]
    next(ticks(player.widget))  # and again from there
    assert been[-1] == pytest.approx(first)


def test_a_number_moved_by_hand_keeps_the_direction_of_the_run():
    player, been = run_of((-1.0, 1.0), 0.5)
    player.widget.value = 600  # on the way back, at 0
    assert been == [0.0]
    player.show(0.5, (-1.0, 1.0))
    next(ticks(player.widget))
    assert been[-1] == pytest.approx(0.49)


def test_who_takes_the_number_pauses_the_run_until_it_is_pressed_again():
    player, been = run_of((-1.0, 1.0), 0.5)
    player.widget.set_state({"playing": True})
    player.widget.set_state({"value": 302})
    player.show(-0.5, (-1.0, 1.0))
    assert not player.widget.playing
    player.widget.set_state({"value": 304})  # it was on its way
    assert been == [pytest.approx(0.51)]
    assert player.widget.value == 100
    player.widget.set_state({"playing": True})
    player.widget.set_state({"value": 102})
    assert been == [pytest.approx(0.51), pytest.approx(-0.49)]
    player.widget.set_state({"playing": False, "value": 104})  # the last step of its own run
    assert been[-1] == pytest.approx(-0.48)


def test_a_number_that_stays_does_not_pause_its_run():
    player, _ = run_of((-1.0, 1.0), 0.5)
    player.widget.set_state({"playing": True})
    player.show(0.5, (-1.0, 1.0))
    assert player.widget.playing


def test_a_number_beyond_the_ends_runs_back_from_the_end():
    player, been = run_of((-1.0, 1.0), 50.0)
    next(ticks(player.widget))
    assert been == [pytest.approx(0.99)]


def test_a_refused_number_can_be_left_by_the_way_back():
    """The slider stands where the reader left it; its move back to the number shown is one."""
    group, asked = Group(), []
    number = NumberControl(group, "x", "x", (0.0, 2.0), 0.01, asked.append)
    number.show(1.0)
    number.slider.value = 2.0
    number.refuse("too large")
    assert "too large" in number.error.value
    number.slider.value = 1.0
    assert asked == [2.0, 1.0]
    number.show(1.0)
    assert number.error.value == ""
    number.slider.value = 1.004  # what the browser makes of it
    assert asked == [2.0, 1.0]


# ---- history and gallery ------------------------------------------------------------------------


def test_history_buttons(bench):
    history = bench.history
    assert (history.undo.disabled, history.redo.disabled) == (True, True)
    bench.look.length.slider.value = 5.0
    assert (history.undo.disabled, history.redo.disabled) == (False, True)
    history.undo.click()
    assert (bench.lab.design, bench.look.length.slider.value) == (OPEN, 2.0)
    assert (history.undo.disabled, history.redo.disabled) == (True, False)
    history.redo.click()
    history.reset.click()
    assert bench.lab.design == OPEN
    history.undo.click()
    assert bench.lab.design.length == 5.0


@pytest.mark.parametrize("key", gallery.names())
def test_gallery(bench, key):
    bench.gallery.menu.value = key
    example = gallery.example(key)
    assert bench.lab.design == design_of(example)
    assert bench.gallery.menu.value == key
    assert example.title in bench.gallery.note.value.replace("&#x27;", "'")
    bench.look.length.slider.value = 4.0
    assert bench.gallery.menu.value == key, "still that surface, drawn longer"
    bench.points.place(0, (0.77, 1.1), None)
    assert bench.gallery.menu.value == ""
    assert "<b>" not in bench.gallery.note.value


# ---- strokes ------------------------------------------------------------------------------------


@pytest.fixture
def clock(monkeypatch):
    clock = SimpleNamespace(now=100.0)
    monkeypatch.setattr(controls.group, "time", SimpleNamespace(monotonic=lambda: clock.now))
    return clock


def test_moves_without_a_pause_are_one_step(bench, clock):
    for value in (1.0, 1.1, 1.2):
        clock.now += 0.1
        bench.points.u.slider.value = value
    clock.now += 2 * controls.PAUSE
    for value in (1.3, 1.4):
        bench.points.u.slider.value = value
    bench.points.v.slider.value = 2.0
    seen = []
    while bench.lab.can_undo:
        seen.append(bench.lab.design.points[0])
        bench.lab.undo()
    assert seen == [(1.4, 2.0), (1.4, 0.8), (1.2, 0.8)]


def test_two_figures_of_one_lab_do_not_share_a_stroke(bench, clock):
    other = PointControl(bench.lab)
    bench.points.u.slider.value = 1.0
    other.u.slider.value = 2.0
    bench.lab.undo()
    assert bench.lab.design.points[0][0] == 1.0
    other.release()


# ---- look ---------------------------------------------------------------------------------------


def test_the_look_control_asks_the_views(bench):
    look = bench.look
    look.sphere.value = "large"
    look.home.click()
    look.parts[1].value = False
    assert bench.view.asked == [("sphere", "large"), ("reset_view",), ("show", {"rulings": False})]
    look.colour.value = "gauss"
    assert bench.lab.colouring == "gauss"
    assert "Gauss" in look.legend.value
    bench.lab.colour("delta")
    assert look.colour.value == "delta"
    assert bench.lab.design == OPEN


def test_at_least_one_curve_stays(bench):
    buttons = bench.look.quantities
    assert {name for name, button in buttons.items() if button.value} == {"kappa", "tau"}
    buttons["delta"].value = True
    assert bench.plots.names == ("kappa", "tau", "delta")
    for name in ("kappa", "tau", "delta"):
        buttons[name].value = False
    assert bench.plots.names == ("delta",)
    assert buttons["delta"].value


# ---- read-outs ----------------------------------------------------------------------------------


def test_the_numbers_of_example_2(bench):
    bench.gallery.menu.value = "example_2"
    text = re.sub("<[^>]+>", " ", bench.readouts.closed.value)
    for number in ("−6.115938", "0.167248", "0.580105", "−6.1159 + ε 0.5801"):
        assert number in text
    assert "The surface closes with C¹" in text


def test_a_negative_pitch_and_no_pitch(bench):
    bench.lab.load(LOOP.with_(ubar="0", vbar="-1"), "test")
    dual = bench.lab.result.pitch.dual
    assert dual < 0
    assert f"− ε {abs(float(dual)):.4f}" in bench.readouts.closed.value
    bench.lab.load(OPEN, "test")
    text = re.sub("<[^>]+>", " ", bench.readouts.closed.value)
    assert "The surface does not close: from the first ruling to the last" in text
    assert text.count("–") == 4
    bench.lab.load(Design(((1, 1), (1, 1)), closing="C0"), "test")
    text = re.sub("<[^>]+>", " ", bench.readouts.closed.value)
    assert "The surface closes with C" in text
    assert "does not converge" in text


def test_the_words_follow_design_and_cursor_while_they_are_shown(bench):
    assert "ū = u - v" in bench.readouts.words.value
    bench.lab.move_cursor(0.25)
    assert "At t = 0.25" not in bench.readouts.words.value  # folded away: they rest
    bench.readouts.listen(True)
    assert "At t = 0.25" in bench.readouts.words.value
    bench.lab.move_cursor(0.625)
    assert "At t = 0.625" in bench.readouts.words.value
    bench.lab.edit("test", ubar="u*u")
    assert "ū = u*u" in bench.readouts.words.value


# ---- the guard ----------------------------------------------------------------------------------


HANDLERS = {
    "slider": (lambda b: b.points, lambda b: setattr(b.points.u.slider, "value", 2.0)),
    "field": (lambda b: b.fields, lambda b: setattr(b.fields.rows["ubar"][0], "value", "v")),
    "button": (lambda b: b.history, lambda b: b.history.reset.click()),
    "menu": (lambda b: b.gallery, lambda b: setattr(b.gallery.menu, "value", "cone")),
    "play": (lambda b: b.time, lambda b: setattr(b.time.play, "value", 8)),
    "look": (lambda b: b.look, lambda b: setattr(b.look.base, "value", "foot")),
}  # fmt: skip


@pytest.mark.parametrize("name", HANDLERS)
def test_a_defect_in_a_handler_is_shown_and_nowhere_lost(name, monkeypatch):
    bench = Bench(OPEN)
    group, act = HANDLERS[name]
    group(bench)

    def broken(change):
        raise RuntimeError("a <view> broke")

    end = bench.lab.follow(broken)
    bench.lab._first = LOOP  # so that reset has something to do
    act(bench)
    shown = group(bench).defect.value
    assert "a &lt;view&gt; broke" in shown
    assert "Traceback" in shown
    assert "a defect of ruledlab" in shown.lower()
    assert len(bench.defects()) == 1
    end()
    bench.close()


def test_a_defect_is_replaced_by_the_next_not_hidden():
    group = Group()
    group.guard(lambda: 1 / 0)
    assert "ZeroDivisionError" in group.defect.value
    group.guard(lambda: None)
    assert "ZeroDivisionError" in group.defect.value


def test_release_leaves_no_observer():
    bench = Bench(OPEN)
    bench.all()
    bench.close()
    before = bench.lab.design
    bench.points.u.slider.value = 2.0
    bench.fields.rows["ubar"][0].value = "v"
    bench.history.reset.click()
    bench.look.base.value = "foot"
    assert bench.lab.design == before
    assert not bench.lab._followers
    bench.close()


def test_what_the_reader_does_while_another_thread_updates_is_heard(bench):
    """A control is deaf only to what it does itself."""
    inside, go_on = threading.Event(), threading.Event()
    slow = bench.points.v.slider

    def wait(_):
        if threading.current_thread() is cell:
            inside.set()
            go_on.wait(10)

    slow.observe(wait, "value")
    cell = threading.Thread(target=bench.points.put, args=(slow,), kwargs={"value": 2.22})
    cell.start()
    assert inside.wait(10)
    bench.points.u.slider.value = 1.5
    go_on.set()
    cell.join(10)
    slow.unobserve(wait, "value")
    assert bench.lab.design.points[0][0] == 1.5


def test_sliders_move_while_a_cell_edits(bench):
    def cell():
        for k in range(10):
            bench.lab.edit("cell", length=3.0 + k)

    thread = threading.Thread(target=cell)
    thread.start()
    for k in range(10):
        bench.points.u.slider.value = 1.0 + 0.1 * k
    thread.join(30)
    design = bench.lab.design
    assert (design.length, design.points[0][0]) == (12.0, pytest.approx(1.9))
    assert bench.look.length.slider.value == 12.0
    assert bench.points.u.slider.value == pytest.approx(1.9)


def test_a_change_that_is_none_of_its_business_is_ignored(bench):
    for group in bench.all():
        group.update(Change(error="`x` is wrong", source="elsewhere"))
    assert bench.errors() == {}
