"""Lesson 04: special rulings, screw, frame equations, and the controls of the app."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.design import Design
from ruledlab.exercises.core import find
from ruledlab.geometry import (
    Dual,
    GeometryError,
    RuledSurface,
    StrictionLength,
    gallery,
    screw,
    special_rulings,
)
from ruledlab.lab.scenes.along import (
    compared_words,
    equations_html,
    found_words,
    numbers_html,
    places,
    ruling_ends,
    screw_strokes,
    screw_words,
    signed,
    special_strokes,
)

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab.geometry import frame_equations
from ruledlab.lab import along_the_rulings, example
from ruledlab.lab.arc_plots import axis_note, mark_over_arc, over_arc
from ruledlab.lab.scene import build_mark

START = example("wave_ring")
ROOT2PI = math.sqrt(2) * math.pi
TORSAL = np.array([1, 2, 4, 5, 7, 8]) / 9


@pytest.fixture
def app():
    app = along_the_rulings()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


def strokes(app, beginning):
    return [s for s in app.view._overlay.strokes if s.name.startswith(beginning)]


def shown(app):
    """Return everything the reader can read, but the pictures."""
    buttons = [(b.description, b.layout.display) for b in app.special.buttons]
    cursor = app.plots.widget.cursor["spoken"]  # its height depends on limits that stay
    numbers = app.numbers.table.value
    return (numbers, app.equations.value, app.special.note.value, buttons, cursor)


# ---- the ring in closed form --------------------------------------------------------------------


@given(st.floats(0.0, 1.0))
def test_the_ring_is_as_the_lesson_says(t):
    wave = math.cos(6 * math.pi * t)
    surface = START.surface()
    inv = surface.invariants(t)
    assert inv.kappa == pytest.approx(ROOT2PI)
    assert inv.tau == pytest.approx(ROOT2PI)
    assert inv.delta == pytest.approx(0.6 + 1.2 * wave, abs=1e-10)
    assert inv.tau_bar == pytest.approx(ROOT2PI * (1.2 * wave - 0.6), abs=1e-9)
    now = screw(surface, t)
    assert now.pitch == pytest.approx(1.2 * wave, abs=1e-10)
    assert now.axis.direction == pytest.approx(np.array([0.0, 0.0, 1.0]), abs=1e-10)
    assert now.axis.moment == pytest.approx(np.zeros(3), abs=1e-9)


def test_the_ring_has_six_torsal_rulings():
    found = special_rulings(START.surface())
    single = places(found)
    assert [place.t for place in single] == pytest.approx(TORSAL, abs=1e-13)
    assert {place.kind for place in single} == {"torsal"}
    assert "6 special rulings" in found_words(found)


# ---- what is shown, without widgets -------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "says"),
    [
        ("cone", "Torsal throughout"),
        ("tangent_developable", "Torsal throughout"),
        ("hyperboloid", "No torsal and no cylindrical"),
        ("plucker_conoid", "4 special rulings"),
    ],
)
def test_special_rulings_in_words(key, says):
    assert says in found_words(special_rulings(gallery.surface(key)))


def test_a_cylindrical_ruling_and_a_double_zero_are_named():
    cusp = Design(((0.0, 1.0), (1.0, 1.0), (0.0, 1.0), (1.0, 1.0)), "0.2*u", "0.5")
    kinds = {place.kind for place in places(special_rulings(cusp.surface()))}
    assert "cylindrical" in kinds
    flat = START.with_(ubar="0.2*sin(3*u)")  # δ = 0.6 + 0.6 cos 3u: touches zero three times
    touching = places(special_rulings(flat.surface()))
    assert [place.t for place in touching] == pytest.approx([1 / 6, 1 / 2, 5 / 6], abs=1e-7)
    assert all("keeps its sign" in place.word for place in touching)


def test_many_special_rulings_are_counted_and_the_first_get_buttons():
    waves = START.with_(ubar="0.3*sin(12*u)")
    assert "24 special rulings, of which the first 12" in found_words(
        special_rulings(waves.surface())
    )


@pytest.mark.parametrize("base", ["striction", "foot"])
def test_a_special_stroke_lies_on_its_ruling(base):
    design = START.with_(base=base, length=3.0)
    surface = design.surface()
    drawn = special_strokes(design, surface, places(special_rulings(surface)))
    assert [label.text for label in drawn.labels] == list("123456")
    for t, stroke in zip(TORSAL, drawn.strokes, strict=True):
        line = surface.line(t)
        assert np.linalg.norm(stroke.points[1] - stroke.points[0]) == pytest.approx(3.0)
        for point in stroke.points:
            assert np.cross(point, line.direction) == pytest.approx(line.moment, abs=1e-9)


@pytest.mark.parametrize("t", [0.3, 0.5])
def test_a_cylindrical_ruling_is_drawn_between_those_beside_it(t):
    design = example("cusp")  # κ = 0 at t = 1/2: no striction point there
    surface = design.surface()
    ends = ruling_ends(design, surface, np.array([t]))[0]
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(design.length)
    beside = surface.striction(np.array([t - 1e-3, t + 1e-3])).mean(axis=0)
    assert ends.mean(axis=0) == pytest.approx(beside, abs=1e-3)
    line = surface.line(t)
    assert np.cross(ends[0], line.direction) == pytest.approx(line.moment, abs=1e-9)


def test_where_nothing_turns_a_ruling_is_drawn_about_its_foot():
    still = Design(((0.5, 1.0), (0.5, 1.0)), "u", "1")
    ends = ruling_ends(still, still.surface(), np.array([0.5]))[0]
    assert ends.mean(axis=0) == pytest.approx(still.surface().foot(0.5))


@settings(max_examples=25)
@given(st.sampled_from(["example_2", "orchid", "twisted_ring", "moebius"]), st.floats(0.02, 0.98))
def test_the_screw_is_drawn_where_the_frame_turns(key, t):
    surface = gallery.surface(key)
    drawn = screw_strokes(screw(surface, t), surface.striction(t), 2.0)
    axis, way = drawn.strokes
    step = 1e-5  # the motion of the frame by finite differences: a second way to its screw
    frames = surface.frame(np.array([t - step, t + step]))
    m = surface.striction(np.array([t - step, t + step]))
    spin = (frames[1] - frames[0]).T @ surface.frame(t) / (2 * step)  # x′ = Ω x
    omega = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
    along = axis.points[1] - axis.points[0]
    assert np.cross(along, omega) == pytest.approx(np.zeros(3), abs=1e-4 * np.linalg.norm(omega))
    assert along @ omega > 0
    # A point of the axis moves along the axis only.
    velocity = (m[1] - m[0]) / (2 * step) + np.cross(omega, axis.points[0] - surface.striction(t))
    pitch = velocity @ omega / (omega @ omega)
    size = np.linalg.norm(velocity) + np.linalg.norm(omega)
    assert velocity == pytest.approx(pitch * omega, abs=1e-4 * size)
    shown = float(drawn.labels[0].text.removeprefix("h = ").replace("−", "-"))
    assert shown == pytest.approx(pitch, abs=6e-4 + 1e-4 * size)
    assert (way.points[1] - way.points[0]) @ surface.frame(t)[0] == pytest.approx(0, abs=1e-9)


@settings(max_examples=20)
@given(st.sampled_from(["example_2", "orchid", "crown", "hyperboloid"]), st.floats(0.0, 1.0))
def test_over_s_the_dual_parts_are_cosine_and_sine(key, t):
    surface = example(key).surface()
    length = StrictionLength(surface)
    inv = surface.invariants(t)
    moved = mark_over_arc(build_mark(example(key), surface, t), float(length.s(t)))
    assert moved.t == pytest.approx(float(length.s(t)))
    assert moved.values["kappa_bar"] == pytest.approx(math.sin(inv.sigma), abs=1e-9)
    assert moved.values["tau_bar"] == pytest.approx(math.cos(inv.sigma), abs=1e-9)
    assert moved.values["delta"] == pytest.approx(float(inv.delta))


def test_over_s_nothing_depends_on_the_parameter(app):
    """The same rulings, run through unevenly, give the same curves over s."""
    even = START
    uneven = START.with_(  # b(t) = 2π (t² + 0.2 t)/1.2 by a third control point
        points=((0.0, math.pi / 4), (2 * math.pi / 12, math.pi / 4), (2 * math.pi, math.pi / 4)),
        closing="C0",
    )
    curves = []
    for design in (even, uneven):
        app.lab.load(design, "test")
        scene = app.lab.result.scene
        arc = over_arc(scene, StrictionLength(app.lab.result.surface).s(scene.t))
        curves.append(arc)
    for name in ("kappa", "kappa_bar", "tau", "tau_bar", "delta"):
        first, second = curves
        grid = np.linspace(0.1, first.t[-1] - 0.1, 50)
        one, two = (np.interp(grid, c.t, c.curves[name]) for c in (first, second))
        assert one == pytest.approx(two, abs=0.05)  # interpolated between 200 samples
    assert curves[0].t[-1] == pytest.approx(curves[1].t[-1])


def test_the_table_of_equations_says_what_is_undefined():
    surface = gallery.surface("example_1")
    text = equations_html(frame_equations(surface, 0.0), math.nan)
    assert text.count("–") >= 12
    assert "nan" not in text
    assert "κ = 0" in screw_words(screw(surface, 0.0))


def test_the_numbers_say_what_they_were_where_they_differ():
    names = ("kappa", "kappa_bar", "tau", "tau_bar", "sigma", "delta", "pitch", "speed", "away")
    before = dict.fromkeys(names, 1.0)
    text = numbers_html(before | {"tau": -2.0, "delta": math.nan}, before)
    assert text.count("was 1.0000") == 2
    assert "<td>−2.0000</td><td>rad/t</td><td>was 1.0000</td>" in text
    assert "<td>–</td><td>length</td><td>was 1.0000</td>" in text
    assert text.count("<tr>") == 9
    assert signed(-1e-9) == "0.0000"


def test_what_changed_is_said_in_words():
    before = {"kappa": 1.0, "tau": 2.0, "sigma": 0.5}
    before |= dict.fromkeys(("kappa_bar", "tau_bar", "delta", "pitch", "speed", "away"), 1.0)

    def said(**changed):
        return compared_words("Lifted", before, before | changed)

    assert "Lifted: nothing changed." in said(kappa=1.0 + 1e-9)
    assert "Lifted: τ changed, nothing else." in said(tau=-2.0)
    assert "Lifted: κ, τ, σ changed, nothing else." in said(tau=-2.0, kappa=3.0, sigma=0.4)
    assert "the place of the axis changed" in said(away=2.0)


# ---- the app ------------------------------------------------------------------------------------


def test_it_begins_with_torsal_rulings_and_they_are_buttons(app):
    assert len(strokes(app, "special")) == 6
    for button, t in zip(app.special.buttons, TORSAL, strict=False):
        assert button.layout.display == ""
        button.click()
        assert app.lab.cursor == pytest.approx(t, abs=1e-13)
        assert app.lab.mark.values["delta"] == pytest.approx(0, abs=1e-12)
    assert [b.layout.display for b in app.special.buttons[6:]] == ["none"] * 6


def test_the_cursor_moves_screw_table_and_plots(app):
    before = shown(app)
    app.time.t.slider.value = 0.5
    assert all(a != b for a, b in zip(before[:2], shown(app)[:2], strict=True))
    assert "−1.2000" in app.numbers.table.value  # h = 1.2 cos 9π… at t = 1/2: cos 3π = −1
    assert app.plots.widget.cursor["t"] == pytest.approx(0.5)
    assert "−1.2" in app.view._words.value


@pytest.mark.parametrize("t", [0.0, 1.0])
def test_the_cursor_to_an_end_and_back(app, t):
    app.lab.move_cursor(0.3)
    before = shown(app)
    app.time.t.slider.value = t
    app.time.t.field.value = "0.3"
    assert shown(app) == before


def test_over_s_and_back(app):
    app.lab.move_cursor(0.3)
    before = shown(app), app.plots.widget.strips, app.plots.widget.curves
    app.axis.axis.value = "s"
    length = StrictionLength(app.lab.result.surface)
    cursor = app.plots.widget.cursor
    assert cursor["t"] == pytest.approx(float(length.s(0.3)))
    assert cursor["label"].startswith("s = ")
    assert app.plots.widget.summary.startswith("Plots over s from 0 to ")
    assert app.plots.widget.strips[-1] != before[1][-1]
    assert f"{length.total:.4g}" in app.axis.note.value
    app.plots.widget.set_state({"picked": [1, 2.0]})
    assert float(length.s(app.lab.cursor)) == pytest.approx(2.0)
    assert app.plots.widget.cursor["t"] == pytest.approx(2.0)
    app.lab.move_cursor(0.3)
    app.axis.axis.value = "t"
    assert (shown(app), app.plots.widget.strips, app.plots.widget.curves) == before


def test_a_cone_has_no_s_and_says_so_beside_the_switch(app):
    app.lab.load(example("cone"), "gallery")
    app.axis.axis.value = "s"
    assert "striction curve" in app.axis.error.value
    assert (app.axis.axis.value, app.plots.length) == ("t", None)
    app.lab.load(START, "test")
    app.axis.axis.value = "s"
    assert app.axis.error.value == ""
    app.lab.load(example("cone"), "gallery")  # while over s
    assert app.axis.axis.value == "t"
    assert app.axis.note.value == axis_note(None)


def test_another_design_moves_the_axis_of_s(app):
    app.axis.axis.value = "s"
    app.lab.load(example("hyperboloid"), "gallery")
    assert app.plots.length.total == pytest.approx(2 * math.pi)
    assert app.plots._t[-1] == pytest.approx(2 * math.pi)


def test_at_least_one_plot_stays(app):
    for button in app.axis.toggles.values():
        button.value = False
    assert len(app.plots.names) == 1
    assert app.axis.toggles[app.plots.names[0]].value
    app.axis.toggles["kappa"].value = True
    assert "kappa" in app.plots.names


def test_reversal_and_back(app):
    app.lab.move_cursor(0.3)
    old, design = dict(app.lab.mark.values), app.lab.design
    app.numbers.reverse.click()
    new = app.lab.mark.values
    assert app.lab.cursor == pytest.approx(0.7)
    for name, sign in (("kappa", 1), ("kappa_bar", 1), ("tau", -1), ("tau_bar", -1), ("delta", 1)):
        assert new[name] == pytest.approx(sign * old[name], abs=1e-9)
    assert (new["sigma"] + old["sigma"] - math.pi) % (2 * math.pi) == pytest.approx(0, abs=1e-9)
    assert app.numbers.table.value.count("was ") == 3
    assert "Reversed: τ, τ̄, σ changed, nothing else." in app.numbers.said.value
    app.numbers.reverse.click()
    assert app.lab.design == design
    app.history.undo.click()
    app.history.undo.click()
    assert app.lab.design == design
    assert not app.lab.can_undo


def test_a_lift_changes_no_invariant_and_is_undone(app):
    app.lab.move_cursor(0.3)
    old, m, design = dict(app.lab.mark.values), app.lab.mark.striction, app.lab.design
    app.numbers.lift.click()
    assert app.lab.mark.values == pytest.approx(old, abs=1e-9)
    assert app.lab.mark.striction - m == pytest.approx([0, 0, 0.5], abs=1e-12)
    assert "was" not in app.numbers.table.value
    assert "Lifted: nothing changed." in app.numbers.said.value
    app.lab.move_cursor(0.4)
    assert app.numbers.said.value == ""
    app.history.undo.click()
    assert app.lab.design == design


def test_a_refused_lift_is_said_beside_the_buttons(app):
    def refuse():
        raise GeometryError("`ubar` must be shorter")

    design = app.lab.design
    app.numbers._change("Lifted", refuse)
    assert "ubar must be shorter" in app.numbers.error.value
    assert app.lab.design == design
    assert app.numbers.said.value == ""


@pytest.mark.parametrize("key", ["cone", "cusp", "example_1", "moebius", "plucker_conoid", "ramp"])
def test_every_gallery_surface_and_back(app, key):
    before = shown(app)
    app.gallery.menu.value = key
    for t in (0.0, 0.5, 1.0):
        app.lab.move_cursor(t)
        assert "nan" not in app.numbers.table.value + app.equations.value
    app.history.undo.click()
    app.lab.move_cursor(0.05)
    assert shown(app) == before


def test_it_closes_without_a_trace():
    before = set(ipywidgets.widget._instances)
    app = along_the_rulings(example("orchid"), 0.2)
    app.axis.axis.value = "s"
    app.restyle(True)
    lab = app.lab
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not lab._followers


# ---- the exercises: what the generic tests cannot know ------------------------------------------


def test_a_developable_counts_as_torsal_and_a_touching_ruling_too():
    task = find("04.8").task()
    assert task.judge(task.start).state == "wrong"
    assert "still off by" in task.judge(task.start).word
    touching = task.start.with_(ubar="0.2*sin(3*u)", vbar=f"{0.6 * math.tan(0.6)!r}")
    assert task.judge(touching).right
    assert task.judge(task.start.with_(ubar="1", vbar="0")).right  # a cone


@pytest.mark.parametrize("key", ["wave_ring", "example_2", "twisted_ring"])
def test_turning_every_line_round_does_what_the_exercise_says(key):
    surface, t = gallery.surface(key), np.array([0.21, 0.64])
    turned = RuledSurface.from_lines(lambda t: [-part for part in _dual_parts(surface, t)], (0, 1))
    one, two = surface.invariants(t), turned.invariants(t)
    for name, sign in (("kappa", 1), ("kappa_bar", 1), ("tau", -1), ("tau_bar", -1), ("delta", 1)):
        assert getattr(two, name) == pytest.approx(sign * getattr(one, name), abs=1e-8)
    assert np.cos(two.sigma) == pytest.approx(-np.cos(one.sigma), abs=1e-8)
    assert np.sin(two.sigma) == pytest.approx(np.sin(one.sigma), abs=1e-8)
    assert "$\\sigma$ becomes $\\pi-\\sigma$" in find("04.3").task().options[0].text


def _dual_parts(surface, t):
    """Return X(t) of a chart surface as dual numbers of series, by û = u + ε ū, v̂ = v + ε v̄."""
    u, v = surface.curve.series(np.asarray(t.value), t.order)
    u, v = Dual(u, surface.ubar(u, v)), Dual(v, surface.vbar(u, v))
    return np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)


def test_three_that_touch():
    task = find("04.9").task()
    ring = task.start
    assert task.judge(ring).state == "wrong"
    for right in (ring.with_(vbar="-1.2"), ring.with_(ubar="0.2*sin(3*u)"), ring.with_(vbar="6/5")):
        assert task.judge(right).right
    assert "touching" in task.judge(ring.with_(vbar="1.2001")).slip
    assert task.judge(ring.with_(vbar="1.1")).state == "wrong"
    assert task.judge(ring.with_(vbar="9")).slip == ""


def test_a_great_circle_does_not_bend_to_both_sides_by_rounding():
    task = find("04.10").task()
    level = task.start.with_(points=tuple((u, math.pi / 2) for u, _ in task.start.points))
    assert task.judge(level).state == "wrong"


@pytest.mark.parametrize("seed", ["", "1", "Ada"])
def test_the_spiral_to_sketch_has_its_zero_where_it_crosses_the_equator(seed):
    task = find("04.5").task(seed)
    down = task.right_answer()[0] > 0
    ends = [math.pi / 6, 5 * math.pi / 6 if r"\tfrac{5\pi}6" in task.question else 2 * math.pi / 3]
    first, last = ends if down else ends[::-1]
    equator = (math.pi / 2 - first) / (last - first)
    assert task.curve(np.array([equator])) == pytest.approx([0.0], abs=1e-9)
    assert (task.curve(np.array([equator - 0.1])) > 0) == down
