"""The app of lesson 05: its numbers, its pictures, and every control from end to end."""

from __future__ import annotations

import re
import threading
import xml.etree.ElementTree as ET

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab.design import Design
from ruledlab.exercises import find, lesson
from ruledlab.geometry import Bezier, RuledSurface, gallery, tangent_planes
from ruledlab.lab import bending
from ruledlab.lab.apps import example
from ruledlab.lab.scenes.bend import FAN, GAP, HEAD, HIGH, bend, graph, in_space, words


@pytest.fixture
def app():
    app = bending()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


@pytest.fixture
def drawn(app, monkeypatch):
    """The overlays that the view is asked to draw."""
    laid, draw = [], type(app.view).overlay

    def overlay(self, picture):
        laid.append(picture)
        draw(self, picture)

    monkeypatch.setattr(type(app.view), "overlay", overlay)
    return laid


def named(items, name):
    return [item for item in items if item.name == name]


def shown(app):
    return app.picture.value, app.curved.value, app.forms.value, app.place.w.field.value


# ---- pictures without widgets -------------------------------------------------------------------


@pytest.mark.parametrize("t", [0.1, 0.35, 0.8])
@pytest.mark.parametrize("key", ["right_helicoid", "hyperboloid", "example_2", "orchid"])
def test_the_drawn_plane_touches_the_surface(key, t):
    surface = gallery.surface(key)
    found = bend(surface, t, 0.4, 2.0)
    picture = in_space(found, found, 0.5, fan=True)
    (sheet,) = named(picture.sheets, "tangent plane")
    point = surface.points(t, 0.4)
    h = 1e-6
    across = (surface.points(t + h, 0.4) - surface.points(t - h, 0.4)) / (2 * h)
    corners = sheet.points.reshape(-1, 3) - point
    assert np.allclose(np.linalg.norm(corners, axis=1), 0.5 * np.sqrt(2))
    normal = np.cross(across, surface.line(t).direction)
    assert np.abs(corners @ normal).max() < 1e-6 * np.linalg.norm(normal)
    (stroke,) = named(picture.strokes, "normal")
    assert np.allclose(np.diff(stroke.points, axis=0)[0] @ (corners.T), 0.0, atol=1e-9)
    assert len(named(picture.sheets, "fan")) == len(named(picture.strokes, "fan")) == FAN
    assert len(in_space(found, found, 0.5, fan=False).sheets) == 1


def test_the_graph_is_a_picture_with_words():
    found = bend(gallery.surface("hyperboloid"), 0.3, 1.0, 2.0)
    picture = ET.fromstring(graph(found))
    assert picture.attrib["role"] == "img"
    assert "θ is 45 degrees, K is −0.25 and H is −0.1768" in picture.attrib["aria-label"]
    circles = picture.findall("circle")
    assert len(circles) == 3
    # θ = 45° stands a quarter, K = −1/4 a quarter of its panel from the top; H at its lowest here
    mean = gallery.surface("hyperboloid").curvature(0.3, np.linspace(-1, 1, 2001)).mean
    parts = 0.25, 0.25, 0.5 - 0.5 * float(mean[-1] / np.abs(mean).max())
    heights = [float(circle.attrib["cy"]) for circle in circles]
    tops = [HEAD + i * (HIGH + GAP) for i in range(3)]
    wanted = [top + part * (HIGH - HEAD) for top, part in zip(tops, parts, strict=True)]
    assert heights == pytest.approx(wanted, abs=0.06)
    assert {circle.attrib["cx"] for circle in circles} == {"426.0"}  # w = 1 is the right end


def test_a_minimal_surface_has_a_level_graph_of_h():
    picture = ET.fromstring(graph(bend(gallery.surface("right_helicoid"), 0.3, 0.4, 2.0)))
    (line,) = picture.findall("path[@class='mean']")
    middle = 2 * (HIGH + GAP) + 0.5 * (HEAD + HIGH)
    heights = {float(pair.split()[1]) for pair in re.split("[ML]", line.attrib["d"])[1:]}
    assert heights == {middle}


def test_a_ruling_without_planes_has_no_curves_and_says_so(app):
    app.gallery.menu.value = "example_1"
    app.time.t.field.value = "0"  # a pole of the chart
    picture = ET.fromstring(app.picture.value)
    assert "no tangent planes" in "".join(picture.itertext())
    assert "pole" in picture.attrib["aria-label"]
    assert picture.findall("circle") == []
    assert [path.attrib["d"] for path in picture.findall("path[@fill='none']")] == ["", "", ""]


@pytest.mark.parametrize("delta", ["0.5", "-0.5", "0.01", "40"])
def test_the_graph_shows_the_peak_however_narrow(delta):
    surface = Design(((0, np.pi / 2), (3, np.pi / 2)), f"{delta}*u", "0").surface()
    found = bend(surface, 0.5, 0.2, 2.0)
    gauss = found.planes.gauss[found.graph]
    assert np.nanmin(gauss) == pytest.approx(-1 / float(delta) ** 2)
    places = found.w[found.graph]
    assert (places.min(), places.max()) == pytest.approx((-1.0, 1.0))
    steps = np.diff(found.planes.turn[found.graph])
    assert np.ptp(steps) < 1e-9  # even in θ
    assert np.all(np.sign(steps) == np.sign(float(delta)) * np.sign(np.diff(places)))


def test_a_torsal_ruling_in_words_and_picture():
    found = bend(gallery.surface("plucker_conoid"), 0.125, 0.0, 2.0)
    assert "torsal" in found.reason
    assert "does not turn" in graph(found)
    assert "<circle" not in graph(found)
    assert "there is no tangent plane" in words(0.125, found)
    assert bend(gallery.surface("plucker_conoid"), 0.125, 0.1, 2.0).reason == ""


# ---- the app ------------------------------------------------------------------------------------


def test_it_closes_without_a_trace():
    before = set(ipywidgets.widget._instances)
    app = bending(example("hyperboloid"), 0.2)
    app.pick(0.2, -0.3)
    app.gallery.menu.value = "cone"
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not app.lab._followers
    assert not app.spot._followers
    app.close()


@pytest.mark.parametrize(
    ("control", "low", "high"),
    [
        (lambda a: a.place.w.slider, -1.0, 1.0),
        (lambda a: a.time.t.slider, 0.0, 1.0),
        (lambda a: a.place.colour, "mean", "plain"),
        (lambda a: a.place.fan, True, False),
        (lambda a: a.gallery.menu, "cone", "ramp"),
    ],
    ids=["w", "t", "colour", "fan", "gallery"],
)
def test_every_control_to_both_ends_and_back(app, control, low, high):
    widget = control(app)
    start, before = widget.value, shown(app)
    for value in (low, high, low, start):
        widget.value = value
    assert shown(app) == before


def test_the_read_outs_are_those_of_geometry(app):
    app.gallery.menu.value = "example_2"
    app.pick(0.3, -0.25)
    surface = gallery.surface("example_2")
    planes = tangent_planes(surface, 0.3, -0.25)
    for value in (planes.gauss, planes.mean, planes.turn, planes.principal[0], planes.angle):
        assert f"{float(value):.4g}".replace("-", "−") in app.curved.value
    for name in ("g11", "g12", "h11", "h12"):
        value = float(getattr(planes.forms, name))
        assert f"{value:.4g}".replace("-", "−") in app.forms.value


def test_a_pick_moves_t_and_w_and_is_one_step(app):
    start = app.lab.cursor, app.spot.value.w
    app.view._listeners[0](0.2, 0.75)
    assert (app.lab.cursor, app.spot.value.w) == (0.2, 0.75)
    assert (app.time.t.field.value, app.place.w.field.value) == ("0.2", "0.75")
    app.history.undo.click()
    assert (app.lab.cursor, app.spot.value.w) == start
    app.history.redo.click()
    assert (app.lab.cursor, app.spot.value.w) == (0.2, 0.75)


def dragged(app, handles, index, by, drag=1):
    """Move a handle by pixels; return where it was and is."""
    old = handles.picture["handles"][index]
    handles.motion = ["view", drag, index, old["x"] + by[0], old["y"] + by[1]]
    return old, handles.picture["handles"][index]


def test_the_point_is_dragged_over_the_surface(app):
    start = app.spot.value
    old, new = dragged(app, app.point, 0, (-40, 15))
    assert (new["x"], new["y"]) == pytest.approx((old["x"] - 40, old["y"] + 15), abs=0.5)
    spot, surface = app.spot.value, app.lab.result.surface
    place = surface.striction(spot.t) + spot.w * surface.line(spot.t).direction
    assert app.view.eye.seen(place)[:2] == pytest.approx((new["x"], new["y"]), abs=0.1)
    dragged(app, app.point, 0, (10, 10))
    app.history.undo.click()  # the whole drag is one step
    assert app.spot.value == start


def test_the_dots_of_the_graph_move_w(app):
    tree = ET.fromstring(app.picture.value)
    dots = [dot.attrib for dot in tree.iter("circle")]
    handles = app.dots.picture["handles"]
    assert app.dots.picture["size"] == [float(n) for n in tree.get("viewBox").split()[2:]]
    for dot, handle in zip(dots, handles, strict=True):
        assert (handle["x"], handle["y"]) == pytest.approx(
            (float(dot["cx"]), float(dot["cy"])), abs=0.06
        )
    assert [handle["label"][-1] for handle in handles] == ["θ", "K", "H"]
    per_length = (440 - 58 - 14) / app.spot.value.design.length
    dragged(app, app.dots, 1, (0.35 * per_length, 77))
    assert app.spot.value.w == pytest.approx(-0.25, abs=2e-4)
    dragged(app, app.dots, 2, (900, 0))
    assert app.spot.value.w == 1.0  # the end of the ruling
    assert app.spot.value.t == 0.68


def test_where_there_is_no_plane_the_graph_has_no_handles(app):
    app.gallery.menu.value = "plucker_conoid"
    app.pick(0.125, 0.0)
    assert app.dots.picture["handles"] == []
    assert app.point.picture["handles"][0]["x"] is not None


def test_undo_leads_back_through_surfaces_and_rulings(app):
    first = shown(app)
    app.time.t.field.value = "0.25"
    app.gallery.menu.value = "crown"
    app.place.w.field.value = "0.1"
    app.time.t.field.value = "0.5"
    for _ in range(4):
        assert app.spot.can_undo
        app.history.undo.click()
    assert not app.spot.can_undo
    assert shown(app) == first
    assert app.lab.design.name == app.spot.value.design.name == "Right helicoid"
    for _ in range(4):
        app.history.redo.click()
    assert (app.lab.design.name, app.lab.cursor, app.spot.value.w) == ("Crown", 0.5, 0.1)
    app.history.reset.click()
    assert shown(app) == first


def test_where_there_is_no_plane_the_last_one_stays_and_the_reason_is_said(app, drawn):
    app.gallery.menu.value = "plucker_conoid"
    app.pick(0.125, 0.3)
    good = named(drawn[-1].sheets, "tangent plane")[0].points
    assert app.place.w.error.value == ""
    app.place.w.field.value = "0"
    assert "no tangent plane" in app.place.w.error.value
    assert np.array_equal(named(drawn[-1].sheets, "tangent plane")[0].points, good)
    assert named(drawn[-1].dots, "point")[0].ring
    app.place.w.field.value = "0.2"
    assert app.place.w.error.value == ""
    assert not named(drawn[-1].dots, "point")[0].ring


def test_the_plane_of_another_surface_does_not_stay(app, drawn):
    app.time.t.field.value = "0"
    app.gallery.menu.value = "example_1"  # begins in a pole of the chart
    assert "pole" in app.place.w.error.value
    assert np.isnan(named(drawn[-1].sheets, "tangent plane")[0].points).all()


def test_bad_input_is_said_beside_the_control(app):
    before = shown(app)[:3]
    app.place.w.field.value = "1 +"
    assert "ruledlab-error" in app.place.w.error.value
    assert shown(app)[:3] == before
    app.time.t.field.value = "7"
    assert "between 0 and 1" in app.time.t.error.value
    assert shown(app)[:3] == before


def test_a_place_beyond_the_drawn_ruling_may_be_typed(app, drawn):
    app.place.w.field.value = "5"
    (ruling,) = [s for s in drawn[-1].strokes if s.name.startswith("ruling")]
    assert np.linalg.norm(ruling.points[1] - ruling.points[0]) == pytest.approx(10.0)
    assert app.place.w.slider.max == 5.0


def test_one_move_draws_once(app, drawn):
    for move in (
        lambda: app.place.w.field.set_trait("value", "0.1"),
        lambda: app.time.t.field.set_trait("value", "0.3"),
        app.history.undo.click,
        lambda: app.place.fan.set_trait("value", True),
    ):
        drawn.clear()
        move()
        assert len(drawn) == 1


# ---- the run of w -------------------------------------------------------------------------------


def run(play, *steps):
    """What the browser sends while a player runs: start and end come with a number."""
    for step in steps[:-1]:
        play.set_state({"playing": True, "value": step})
    play.set_state({"playing": False, "value": steps[-1]})


def test_a_run_of_w_turns_the_plane_from_end_to_end_and_back(app, drawn):
    play, been = app.place.play, []
    app.spot.follow(lambda _: been.append(app.spot.value.w))
    run(play, *range(play.value + 2, play.max + 1, 2))
    assert been[:3] == [-0.59, -0.58, -0.57]  # from where it was, on the slider's own places
    assert (max(been), been[-1]) == (1.0, -1.0)
    assert len(drawn) == len(been) == 160 + 200
    normals = [named(d.strokes, "normal")[0].points for d in drawn]
    ways = np.array([p[1] - p[0] for p in normals])
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    turns = np.degrees(np.arccos((ways[:-1] * ways[1:]).sum(axis=1).clip(-1, 1)))
    assert turns.max() < 1.5  # nowhere a jump
    there = np.degrees(np.arctan(1 / 0.5) + np.arctan(0.6 / 0.5))  # θ = arctan(w/δ), δ = 1/2
    assert turns[:159].sum() == pytest.approx(there, abs=0.02 * there)


def test_a_pause_keeps_w_and_a_run_is_one_step(app):
    app.place.w.field.value = "0.1"
    run(app.place.play, 222, 224, 226)
    assert app.spot.value.w == 0.13
    assert (app.place.w.field.value, app.place.w.slider.value) == ("0.13", pytest.approx(0.13))
    app.history.undo.click()
    assert app.spot.value.w == 0.1
    assert app.place.play.value == 220  # the next run goes on from here
    app.history.redo.click()
    assert app.spot.value.w == 0.13
    app.history.undo.click()
    app.history.undo.click()
    assert not app.spot.can_undo


def test_both_players_at_once_and_the_hand_between_are_one_step(app):
    start = app.spot.value
    app.time.play.set_state({"playing": True, "value": 280})
    app.place.play.set_state({"playing": True, "value": 100})
    app.time.play.set_state({"value": 282})
    app.place.w.slider.value = 0.5
    app.time.play.set_state({"value": 284})
    app.place.play.set_state({"value": 302})  # too late: who takes w has paused it
    assert (app.spot.value.t, app.spot.value.w) == (0.71, 0.5)
    assert app.time.play.playing and not app.place.play.playing
    app.history.undo.click()
    assert app.spot.value == start and not app.spot.can_undo
    assert app.lab.cursor == start.t


def test_a_run_over_the_gap_of_a_torsal_ruling_says_so_in_its_own_line(app):
    app.gallery.menu.value = "plucker_conoid"
    app.pick(0.125, -0.01)
    run(app.place.play, 200)
    assert app.spot.value.w == 0.0
    assert "no tangent plane here: the striction point of a torsal" in app.place.w.error.value
    assert app.place.w.error.layout.min_height == "20px"  # nothing moves as it comes and goes
    run(app.place.play, 202)
    assert app.place.w.error.value == ""


def test_the_run_is_that_of_the_drawn_ruling():
    app = bending(example("right_helicoid").with_(length=4.0), w=1.0)
    run(app.place.play, 400)
    assert app.spot.value.w == 2.0
    app.place.w.field.value = "50"
    run(app.place.play, 402)
    assert app.spot.value.w == pytest.approx(1.98)
    app.close()


def test_w_is_measured_from_the_striction_point_whatever_the_design_says():
    app = bending(example("example_2").with_(base="foot"))
    assert app.lab.design.base == "striction"
    app.close()


# ---- exercises, by the geometry of a helicoid with the δ that the question names -----------------


def helicoid(question):
    (delta,) = re.findall(r"\\delta=([-\d.]+)", question)
    return Design(((0, np.pi / 2), (1, np.pi / 2)), f"{delta}*u", "0").surface()


@pytest.mark.parametrize("seed", ["a", "b", "c", "d"])
def test_the_answers_hold_on_a_helicoid(seed):
    deepest, half, planes = (find(f"05.{n}").task(seed) for n in (1, 2, 3))
    assert helicoid(deepest.question).curvature(0.5, 0.0).gauss == pytest.approx(deepest.answer)
    gauss = helicoid(half.question).curvature(0.5, [0.0, half.answer]).gauss
    assert gauss[1] / gauss[0] == pytest.approx(0.5)
    ends = [float(w) for w in re.findall(r"w=([-\d.]+)", planes.question)]
    normals = tangent_planes(helicoid(planes.question), 0.5, ends).normal
    assert np.arccos(normals[0] @ normals[1]) == pytest.approx(planes.answer)


@pytest.mark.parametrize("seed", ["a", "b", "c", "d", "e", "f"])
def test_the_mean_curvature_by_hand_is_that_of_a_surface(seed):
    """Along a parallel circle, with ū = p u and v̄ = r, all four invariants are constant."""
    task = find("05.12").task(seed)
    k, kb, tau, tb = (
        float(re.search(rf"{name}=([-\d]+)", task.question)[1])
        for name in (r"(?<!bar)\\kappa", r"bar\\kappa", r"(?<!bar)\\tau", r"bar\\tau")
    )
    w = float(re.search(r"w=(\d+)", task.question)[1])
    speed, v = np.hypot(k, tau), np.arctan2(k, tau)
    p, r = (
        (kb * np.sin(v) + tb * np.cos(v)) / speed,
        (kb * np.cos(v) - tb * np.sin(v)) / speed,
    )
    surface = RuledSurface(Bezier([(0, v), (speed, v)]), f"{float(p)!r}*u", repr(float(r)))
    found = surface.invariants(0.5)
    given = [float(getattr(found, n)) for n in ("kappa", "kappa_bar", "tau", "tau_bar")]
    assert given == pytest.approx([k, kb, tau, tb])
    assert surface.curvature(0.5, w).mean == pytest.approx(task.answer)


def test_the_slip_that_is_printed_is_the_one_to_find():
    """h₁₁ of the right option, against finite differences of the patch; the other two fail."""
    surface, t, w, h = gallery.surface("example_1"), 0.5, 1.0, 1e-3
    r = surface.points(t + h * np.arange(-1, 2), w)
    normal = tangent_planes(surface, t, w).normal
    h11 = (r[0] - 2 * r[1] + r[2]) @ normal / h**2
    i = surface.invariants(t)
    k, kb, tau, tb, dk, dkb = (
        float(getattr(i, name))
        for name in ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
    )
    size, rest = np.hypot(kb, w * k), w * k * (w * k * tau + dkb)
    brackets = (
        kb * (k * tb + w * dk - kb * tau) - rest,
        kb * (tb + w * dk - tau) + rest,
        kb * (kb * tb + w * dk - k * tau) - rest,
        kb * (tb + w * dk - tau) - rest,  # as printed
    )
    agree = [abs(bracket / size - h11) < 1e-4 * abs(h11) for bracket in brackets]
    assert agree == [True, False, False, False]
    assert find("05.10").task().then.right_answer() == 0


def test_two_threads_do_not_wait_for_each_other(app):
    """The lab changes the memory and the memory the lab; cells run beside observers."""
    moves = (
        lambda i: app.lab.move_cursor(0.01 + 0.9 * (i % 7) / 7),
        lambda i: app.pick(0.05 + 0.8 * (i % 5) / 5, 0.1),
    )
    threads = [
        threading.Thread(target=lambda move=move: [move(i) for i in range(60)], daemon=True)
        for move in moves
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=20)
    assert not any(thread.is_alive() for thread in threads)
    assert app.spot.value.t == app.lab.cursor


@pytest.mark.parametrize("exercise", lesson("05"), ids=lambda exercise: exercise.key)
def test_no_two_slips_of_a_task_are_the_same_answer(exercise):
    """Each is recognised by its own name, whatever values a seed draws."""
    for seed in map(str, range(40)):
        task = exercise.task(seed)
        for slip in getattr(task, "slips", ()):
            assert task.judge(slip.example).slip == slip.name, seed
