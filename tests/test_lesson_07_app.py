"""The app of lesson 7: the congruence about a curve, one line of it, and its exercises' truth."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab.design import Design
from ruledlab.exercises import find, lesson
from ruledlab.exercises.core import made
from ruledlab.geometry import Bezier, Congruence, RuledSurface, gallery
from ruledlab.geometry.choices import CHOICES
from ruledlab.lab import Lab, dual_part
from ruledlab.lab.apps import example
from ruledlab.lab.scene import build_scene
from ruledlab.lab.scenes import congruence
from ruledlab.lab.scenes.congruence_chart import chart_signs
from ruledlab.lab.scenes.congruence_numbers import enclosure
from ruledlab.lab.scenes.straightened import straightened, straightened_words

ARC = Design(((0.3, 0.6), (0.9, 0.9), (1.6, 1.0), (2.2, 1.5)), "0.5*u", "-1")


@pytest.fixture
def app():
    app = dual_part()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


def shown(app):
    """Return all that the reader sees in words and in space."""
    over = app.view._overlay
    parts = [stroke.points for stroke in over.strokes] + [sheet.points for sheet in over.sheets]
    parts += [dot.point for dot in over.dots]
    drawn = [np.round(part, 9).tobytes() for part in parts]
    return app.words.value, app.numbers.value, app.legend.value, app.said.value, tuple(drawn)


def scene_of(design):
    return build_scene(design, design.surface(), True)


# -- arrays and words ------------------------------------------------------------------------------


@pytest.mark.parametrize("choice", CHOICES, ids=lambda choice: choice.key)
def test_every_drawn_piece_lies_on_a_line_of_the_congruence(choice):
    design = example("example_2").with_(ubar=choice.ubar, vbar=choice.vbar)
    chosen, scene = Congruence(choice.ubar, choice.vbar), scene_of(design)
    found = congruence.lines(chosen, scene, 5)
    assert sum(found.counts.values()) == 25
    for stroke in found.strokes:
        piece = stroke.points.reshape(-1, 3, 3)[:, :2]
        piece = piece[np.isfinite(piece).all(axis=(1, 2))]
        x = (piece[:, 1] - piece[:, 0]) / design.length
        line = chosen.line(np.arctan2(x[:, 1], x[:, 0]), np.arccos(np.clip(x[:, 2], -1, 1)))
        np.testing.assert_allclose(np.linalg.norm(x, axis=1), 1.0, atol=1e-9)
        np.testing.assert_allclose(np.cross(piece[:, 0], x), line.moment, atol=1e-6)


def test_the_window_holds_the_curve_and_is_not_narrow():
    ends = congruence.window(np.array([[0.0, 1.0], [3.0, 1.0], [np.nan, 2.0]]))
    assert ends[0, 0] < 0.0 and ends[0, 1] > 3.0
    assert 0.0 <= np.ptp(ends[1]) - congruence.NARROWEST <= 2 * congruence.STEP
    wide = congruence.window(np.array([[0.0, 1.0], [40.0, 1.0]]))
    assert np.ptp(wide[0]) == pytest.approx(2 * math.pi)  # not the same lines twice


def test_focal_surfaces_of_a_spheres_tangents_hold_the_sphere():
    design = example("example_2").with_(ubar="cos(pi/3)/sin(v)", vbar="sin(pi/3)")
    found = congruence.focal_surfaces(Congruence(design.ubar, design.vbar), scene_of(design))
    both = np.stack([sheet.points for sheet in found.sheets]).reshape(2, -1, 3)
    off = np.abs(np.linalg.norm(both, axis=-1) - 1.0).min(axis=0)
    assert np.nanmax(off) < 1e-9 and np.isfinite(off).mean() > 0.5


def test_a_focal_surface_that_is_a_curve_is_drawn_as_one(app):
    app.fields.pair.value = "torus_normals"
    app.control.focal.value = True
    strokes = [s.points for s in app.view._overlay.strokes if "focal" in s.name]
    known = [points[np.isfinite(points).all(axis=1)] for points in strokes]
    axis = [np.abs(points[:, :2]).max() < 1e-9 for points in known]
    ring = [
        max(np.abs(np.hypot(*points[:, :2].T) - 1.0).max(), np.abs(points[:, 2]).max()) < 1e-9
        for points in known
    ]
    assert sorted(zip(axis, ring, strict=True)) == 2 * [(False, True)] + 2 * [(True, False)]
    assert all(np.ptp(points, axis=0).max() > 1.0 for points in known)


@pytest.mark.parametrize(
    ("key", "dots", "says"),
    [
        ("sphere", 2, "hyperbolic: neighbouring lines meet it in two focal points"),
        ("bundle", 1, "parabolic: its two focal points coincide"),
        ("twist", 0, "elliptic: no neighbouring line meets it"),
    ],
)
def test_the_kinds_in_dots_and_words(key, dots, says):
    choice = next(choice for choice in CHOICES if choice.key == key)
    design = example("example_2").with_(ubar=choice.ubar, vbar=choice.vbar)
    at = congruence.place(Congruence(choice.ubar, choice.vbar), 0.7, 0.8)
    over = congruence.highlighted(at, scene_of(design))
    assert len(over.dots) == len(over.labels) == dots
    assert says in congruence.place_words(at)
    (stroke,) = over.strokes
    for dot in over.dots:  # the drawn line reaches them
        a, b = stroke.points - dot.point
        assert np.linalg.norm(np.cross(a, b)) < 1e-9 and a @ b < 0


def test_a_pole_has_no_line_and_says_so():
    design = example("example_2")
    at = congruence.place(Congruence("u - v", "u + v"), 0.3, 0.0)
    over = congruence.highlighted(at, scene_of(design))
    assert np.isnan(over.strokes[0].points).all() and over.dots == ()
    assert "a pole of the chart" in congruence.place_words(at)


def test_developable_keeps_the_directions_and_loses_kappa_bar():
    surface, t = ARC.surface(), np.linspace(0, 1, 23)
    after, how = straightened(surface, ARC.ubar)
    assert "begins with −1 as before" in how
    before, now = surface.invariants(t), after.invariants(t)
    np.testing.assert_allclose(now.kappa, before.kappa, atol=1e-9)
    np.testing.assert_allclose(now.tau, before.tau, atol=1e-9)
    assert np.abs(now.kappa_bar).max() < 1e-8 < np.abs(before.kappa_bar).max()
    said = straightened_words(surface, after, how)
    assert "now it is 0 to rounding" in said


def test_a_loop_gets_its_tangents_and_the_reason():
    surface = gallery.surface("example_2")
    after, how = straightened(surface, "u - v")
    assert "v′ = 0 near t" in how and "tangents" in how
    assert np.abs(after.invariants(np.linspace(0, 1, 23)).kappa_bar).max() < 1e-8
    assert "does not close" in straightened_words(surface, after, how)


def test_a_curve_on_the_equator_gets_tangents_because_no_vbar_will_do():
    after, how = straightened(gallery.surface("right_helicoid"), "0.5*u")
    assert "tangents" in how and "π/2" in how
    assert np.abs(after.invariants(np.linspace(0, 1, 23)).kappa_bar).max() < 1e-8


def test_a_first_value_that_is_not_kept_is_not_said_to_be():
    after, how = straightened(gallery.surface("hyperboloid"), "0")
    assert "begins with 0 and not 1" in how and "0 throughout" in how
    assert "as before" not in how and "−0" not in how
    assert np.abs(after.invariants(np.linspace(0, 1, 23)).kappa_bar).max() < 1e-8


# -- the signs in the chart ------------------------------------------------------------------------


def signs_of(key, count=5):
    choice = next(choice for choice in CHOICES if choice.key == key)
    chosen = Congruence(choice.ubar, choice.vbar)
    found = congruence.lines(chosen, scene_of(example("example_2")), count)
    return chosen, found, chart_signs(found)


@pytest.mark.parametrize("key", ["waves", "linear_complex", "torus_normals", "paper"])
def test_each_sign_is_that_of_the_divergence_at_its_place_in_the_colour_of_the_kind(key):
    chosen, _, signs = signs_of(key, 9)
    u, v = signs.places.T
    divergence = chosen.divergence(u, v)
    assert len(signs.signs) == 81 == len(set(map(tuple, signs.places.tolist())))
    for sign, value in zip(signs.signs, divergence, strict=True):
        assert sign == ("0" if abs(value) < 1e-9 else "+" if value > 0 else "−")
    assert list(signs.colours) == [congruence.LOOKS[kind] for kind in chosen.kind(u, v).tolist()]


def test_the_tiles_fill_the_window_and_the_signs_are_told_in_words():
    _, found, signs = signs_of("paper", 7)
    low, high = signs.places.min(axis=0), signs.places.max(axis=0)
    np.testing.assert_allclose(np.stack([low, high], axis=1), found.ends)
    np.testing.assert_allclose(6 * np.array(signs.tile), high - low)
    assert "49 lines" in signs.words and "The divergence lies between" in signs.words


def test_the_tiles_are_darker_where_the_divergence_is_greater():
    assert not signs_of("torus_normals")[2].shades.any()
    chosen, _, signs = signs_of("waves", 9)
    size = np.abs(chosen.divergence(*signs.places.T))
    order = np.argsort(size)
    assert (np.diff(signs.shades[order]) >= -1e-12).all()
    assert signs.shades[order[-1]] > signs.shades[order[0]]


def test_where_there_is_no_line_there_is_no_sign():
    design = example("example_2").with_(vbar="sqrt(u - 1)")
    found = congruence.lines(Congruence(design.ubar, "sqrt(u - 1)"), scene_of(design), 7)
    signs = chart_signs(found)
    assert 0 < len(signs.signs) < 49
    assert (signs.places[:, 0] > 1.0).all()
    assert len(signs.signs) == 49 - found.counts["undefined"]


def test_the_window_stays_while_the_curve_moves_a_little():
    chart = scene_of(example("example_2")).chart
    shifts = np.linspace(0.0, congruence.STEP, 33)
    ends = {congruence.window(chart + shift).tobytes() for shift in shifts}
    assert len(ends) <= 5  # each of its four ends has moved on by one step, once


@pytest.mark.parametrize("choice", CHOICES, ids=lambda choice: choice.key)
def test_the_flux_through_the_loop_is_its_pitch(choice):
    surface = example("example_2").with_(ubar=choice.ubar, vbar=choice.vbar).surface()
    found = enclosure(surface)
    assert found.flux == pytest.approx(surface.pitch(), abs=1e-8)
    assert found.area == pytest.approx(0.1672475240, abs=1e-9)
    assert found.reason == ""


def test_a_loop_run_backwards_and_loops_that_enclose_nothing():
    design = example("example_2")
    back = enclosure(design.with_(points=design.points[::-1]).surface())
    forth = enclosure(design.surface())
    assert (back.area, back.flux) == pytest.approx((-forth.area, -forth.flux))
    assert enclosure(ARC.surface()).reason == "no closed loop"
    ring = enclosure(gallery.surface("hyperboloid"))
    assert "pole" in ring.reason and math.isnan(ring.flux)


# -- the app ---------------------------------------------------------------------------------------


def test_it_begins_with_example_2_and_its_numbers(app):
    assert app.lab.design == example("example_2")
    for number in ("none real", "3.178097", "0.902042, 2.276055", "1.000000", "0.580105"):
        assert number in app.numbers.value
    assert "49 lines" in app.legend.value and "elliptic" in app.legend.value


@pytest.mark.parametrize("name", ["u", "v", "lines", "length"])
def test_a_slider_to_both_ends_and_back(app, name):
    control = getattr(app.control, name)
    start = control.field.value
    control.field.value = "0.8" if name in "uv" else start  # leave the curve
    before, place = shown(app), control.field.value
    for end in (control.slider.min, control.slider.max):
        control.slider.value = end
        if name in ("u", "v"):
            assert control.field.value != place
    assert shown(app) != before
    control.field.value = place
    assert shown(app) == before


def test_the_place_leaves_the_curve_and_returns_with_t(app):
    before = shown(app)
    app.control.u.field.value = "1.2"
    assert "At u = 1.2, v = 0.7854" in app.words.value
    assert app.pad.ring == [1.2, pytest.approx(math.pi / 4)]
    assert app.pad.cursor == [pytest.approx(math.pi / 8), pytest.approx(math.pi / 4)]
    assert "δ along this curve <i>δ</i></td><td>–" in app.numbers.value
    app.lab.edit("ubar", ubar="u - 2*v")  # another field: still the same place
    assert "At u = 1.2" in app.words.value
    app.lab.undo()
    app.time.t.field.value = "0.25"
    assert "At u = 1.2" not in app.words.value and app.pad.ring == []
    app.time.t.field.value = "0"
    assert shown(app) == before


def test_the_place_on_the_curve_is_read_with_six_digits(app):
    assert (app.control.u.field.value, app.control.v.field.value) == ("pi/8", "pi/4")
    app.time.t.field.value = "0.3"
    u = float(app.lab.mark.chart[0])
    assert app.control.u.field.value == f"{u:.6f}".rstrip("0") != repr(u)
    app.control.v.field.value = "1"
    assert app.control.at == (u, 1.0)  # u itself has not been rounded


def test_switches_take_away_and_bring_back(app):
    app.fields.pair.value = "sphere"
    before = shown(app)
    app.control.focal.value = True
    assert len(app.view._overlay.sheets) == 2
    app.control.grid.value = False
    names = {stroke.name for stroke in app.view._overlay.strokes}
    assert names == {"line", "first focal surface", "second focal surface"}
    app.control.grid.value, app.control.focal.value = True, False
    assert shown(app) == before


def test_the_signs_are_sent_anew_only_when_they_change(app, monkeypatch):
    sent = []
    app.pad.observe(lambda change: sent.append(change["new"]), "signs")
    app.lab.move_cursor(0.3)
    app.control.u.field.value = "1.2"
    app.control.length.field.value = "3"
    app.control.focal.value = True
    app.restyle(dark=True)
    app.restyle(dark=False)
    with monkeypatch.context() as patch:  # the curve alone: not even made anew
        patch.setattr("ruledlab.lab.apps.lesson_07.chart_signs", None)
        u, v = app.lab.design.points[3]
        app.points.place(3, (u - 0.002, v), ("drag",))
    assert sent == []
    app.control.lines.field.value = "9"
    app.lab.edit("ubar", ubar="u - 2*v")
    assert [len(signs["signs"]) for signs in sent] == [81, 81]


def test_the_signs_follow_the_curve(app):
    before = app.pad.signs
    points = np.array(app.lab.design.points) + [1.0, 0.4]
    app.lab.edit("points", points=tuple(map(tuple, points.tolist())))
    assert app.pad.signs["places"] != before["places"]
    app.lab.undo()
    assert app.pad.signs == before


def look(app, u, v, seq=1, kind="look"):
    app.pad._handle_custom_msg({"kind": kind, "view": "a", "seq": seq, "u": u, "v": v}, [])


def test_the_reader_looks_at_a_place_of_the_chart(app):
    design, before = app.lab.design, shown(app)
    look(app, 1.2, 0.9)
    assert "At u = 1.2, v = 0.9 the congruence" in app.words.value
    assert (app.control.u.field.value, app.control.v.field.value) == ("1.2", "0.9")
    assert app.pad.ring == [1.2, 0.9]
    assert app.lab.design is design and not app.lab.can_undo
    look(app, 1.3, 0.0, seq=2)  # a pole has no line, and that is said
    assert "a pole of the chart" in app.words.value
    app.lab.move_cursor(0.1)
    app.lab.move_cursor(0.0)
    assert app.pad.ring == [] and shown(app) == before


def test_area_flux_and_pitch_stand_in_the_table(app):
    app.fields.pair.value = "linear_complex"
    for number in ("0.167248", "−0.083624", "−0.500000"):
        assert number in app.numbers.value
    assert app.numbers.value.count("−0.083624") == 2  # flux and pitch
    app.lab.load(example("hyperboloid"), "gallery")
    assert app.numbers.value.count("goes round a pole") == 2


def test_undo_redo_and_reset(app):
    first = shown(app)
    app.fields.pair.value = "torus_normals"
    second = shown(app)
    assert second != first and "hyperbolic" in app.legend.value
    app.history.undo.click()
    assert shown(app) == first
    app.history.redo.click()
    assert shown(app) == second
    app.control.u.field.value = "1.2"
    app.history.reset.click()
    assert shown(app) == first


@pytest.mark.parametrize(
    ("control", "text", "says"),
    [("lines", "40", "between 5 and 15"), ("lines", "6.5", "whole"), ("u", "2u", "")],
)
def test_what_cannot_be_is_said_beside_it_and_changes_nothing(app, control, text, says):
    before, asked = shown(app), getattr(app.control, control)
    asked.field.value = text
    assert asked.error.value and shown(app) == before
    if control == "lines":
        assert says in asked.error.value
    asked.field.value = "6" if control == "lines" else "0.4"
    assert asked.error.value == ""


def test_a_wrong_formula_keeps_the_last_picture(app):
    before = shown(app)
    app.fields.rows["vbar"][0].value = "u +"
    assert "ruledlab-error" in app.fields.rows["vbar"][2].value
    assert shown(app) == before


def test_developable_is_shown_until_something_changes(app):
    before = shown(app)
    app.control.develop.click()
    assert "0 to rounding" in app.said.value
    assert [sheet.name for sheet in app.view._overlay.sheets] == ["developable"]
    app.lab.move_cursor(0.5)  # the cursor changes no surface
    assert app.view._overlay.sheets
    app.lab.move_cursor(0.0)
    app.lab.edit("vbar", vbar="1")
    assert app.said.value == "" and app.view._overlay.sheets == ()
    app.lab.undo()
    assert shown(app) == before


def test_no_design_breaks_it(app):
    for key in gallery.names():
        app.lab.load(example(key), "gallery")
        assert "At u" in app.words.value
        app.control.develop.click()
        assert app.said.value


@pytest.mark.parametrize("vbar", ["1/(u - pi/8)", "sqrt(u - 5)", "exp(40*u)"])
def test_fields_without_values_do_not_break_it(app, vbar):
    app.lab.edit("vbar", vbar=vbar)
    app.control.develop.click()
    assert app.words.value and app.numbers.value and app.said.value


def test_the_picture_is_told_in_words(app):
    assert "elliptic" in app.view._words.value and "49 lines" in app.view._words.value


def test_it_closes_without_a_trace():
    before = set(ipywidgets.widget._instances)
    app = dual_part(ARC)
    lab = app.lab
    app.control.develop.click()
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not lab._followers
    lab.move_cursor(0.5)


def test_a_lab_of_its_own():
    app = dual_part(ARC)
    assert isinstance(app.lab, Lab) and app.lab.design == ARC
    assert "<td>–</td>" in app.numbers.value  # an open surface has no pitch
    app.close()


# -- the exercises' answers by another route -------------------------------------------------------

SEEDS = ("", "1", "Ada", "Σ")


@pytest.mark.parametrize("seed", SEEDS)
def test_07_1_and_2_give_the_lines_they_say(seed):
    u, v = np.array([0.3, 1.7]), np.array([0.7, 2.0])
    task = find("07.2").task(seed)
    radius, across = (int(part) for part in _numbers(task.question, "radius $", "v="))
    foot = Congruence(task.answer, str(across)).line(u, v).foot
    np.testing.assert_allclose(np.linalg.norm(foot, axis=-1), radius)
    task = find("07.1").task(seed)
    point = np.array(eval(task.question.split("point $")[1].split("$")[0]), dtype=float)
    line = Congruence(task.answer, f"{point[1]}*cos(u) - {point[0]}*sin(u)").line(u, v)
    np.testing.assert_allclose(np.cross(point, line.direction), line.moment, atol=1e-12)


def _numbers(text, *before):
    for mark in before:
        rest = text.split(mark, 1)[1]
        yield rest[: next(i for i, c in enumerate(rest) if not c.isdigit())]


def test_07_3_counts_focal_points_as_the_congruence_does():
    from ruledlab.exercises.lesson_07 import TRIPLES, _focal_count

    counts = {"elliptic": 0, "parabolic": 1, "hyperbolic": 2}
    for row in (row for triple in TRIPLES for row in triple):
        a, b, c, d = row
        found = Congruence(f"{a}*u + {b}*(v - pi/2)", f"{c}*u + {d}*(v - pi/2)")
        assert counts[str(found.kind(0.0, math.pi / 2))] == _focal_count(*row)
    assert all(sorted(_focal_count(*row) for row in triple) == [0, 1, 2] for triple in TRIPLES)


def test_07_4_is_true_of_example_2():
    u, v = np.meshgrid(np.linspace(0.3, 1.3, 21), np.linspace(0.3, 1.3, 21))
    assert (Congruence("u - v", "u + v").kind(u, v) == "elliptic").all()


def test_07_5_is_the_delta_of_surfaces():
    task = find("07.5").task("b")  # ū = 2u, v̄ = −z
    assert r"\bar u=2u" in task.question and r"-(v-\tfrac\pi2)" in task.question
    for t in (0.2, 1.1, 2.5):
        step = 0.4 * np.array([math.cos(t), math.sin(t)])
        curve = Bezier(np.array([[0.0, math.pi / 2], [0.0, math.pi / 2] + step]))
        delta = RuledSurface(curve, "2*u", "pi/2 - v").invariants(0.0).delta
        assert delta == pytest.approx(float(task.curve(np.array(t))))


def test_07_7_and_10_by_the_surface_of_the_loop():
    u, v = Bezier(np.array(gallery.LOOP)).series(np.linspace(0, 1, 2001), 0).value
    area = abs(float(np.trapezoid(np.cos(v), u)))  # Example 2 is counter-clockwise from outside
    assert np.trapezoid(v, u) > 0  # with v downwards
    surface = RuledSurface(Bezier(np.array(gallery.LOOP)), "0", "3*cos(v)/sin(v)")
    assert surface.pitch() == pytest.approx(-3 * area, rel=1e-5)
    task = find("07.10").task("")
    (u0, u1), (v0, v1) = eval(task.solution.split("flux(")[1].split(")</pre>")[0])
    corners = [(u0, v0), (u0, v1), (u1, v1), (u1, v0), (u0, v0)]  # down, right, up, left
    sides = [Bezier(np.array(pair)) for pair in pairwise(corners)]
    total = sum(_advance(RuledSurface(side, "u - v", "u + v")) for side in sides)
    assert -total == pytest.approx(task.answer)


def _advance(surface):
    """∫⟨c′, x⟩dt by Gauss' rule."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    t = 0.5 + 0.5 * nodes
    sample = surface.sample(t)
    return float(0.5 * weights @ np.einsum("ti,ti->t", sample.foot_rate, sample.direction))


@pytest.mark.parametrize(
    ("ubar", "vbar", "right"),
    [
        ("-2*cos(v)/sin(v)", "0", True),
        ("0", "1/sin(v)", True),
        ("u**2 - 3*v", "1/sin(v) - 2*u*v", None),
        ("-cos(v)*sin(2*u)", "sin(v)*cos(2*u)", True),
        ("2", "0", False),
        ("u - v", "u + v", False),
    ],
)
def test_07_8_takes_every_field_without_flux(ubar, vbar, right):
    task = find("07.8").task()
    design = task.start.with_(ubar=ubar, vbar=vbar)
    if right is None:  # mend any field by a multiple of another one: the pitch is linear
        first, second = design.surface().pitch(), task.start.surface().pitch()
        factor = first / second
        design = design.with_(
            ubar=f"{ubar} - {factor!r}*(u - v)", vbar=f"{vbar} - ({factor!r})*(u + v)"
        )
        right = True
    assert task.judge(design).right is right
    assert task.judge(made(design)).right is right


def test_07_8_notices_a_moved_loop():
    task = find("07.8").task()
    points = np.array(task.model.points)
    small = points[0] + 0.2 * (points - points[0])
    moved = task.model.with_(points=tuple(map(tuple, small.tolist())))
    assert "the loop on the sphere" in task.judge(moved).word


@pytest.mark.parametrize("seed", SEEDS)
def test_07_11_is_developable(seed):
    task = find("07.11").task(seed)
    rate = int(task.question.split("$u=")[1].split("t,")[0])
    vbar = task.answer.replace("t)", "v)")
    curve = Bezier([(0.5 * rate, 0.5), (2.0 * rate, 2.0)])
    surface = RuledSurface(curve, "0.7", vbar)
    found = surface.invariants(np.linspace(0, 1, 9))
    assert np.abs(found.kappa_bar).max() < 1e-9 * np.abs(surface.vbar(0.0, 0.5))
    assert float(surface.vbar(0.0, math.pi / 2)) == pytest.approx(
        float(task.question.split(r"\bar v=")[1].split("$")[0])
    )


@pytest.mark.parametrize("exercise", lesson("07"), ids=lambda exercise: exercise.key)
def test_no_two_slips_of_a_task_are_the_same_answer(exercise):
    """Each is recognised by its own name, whatever values a seed draws."""
    for seed in map(str, range(40)):
        task = exercise.task(seed)
        for slip in getattr(task, "slips", ()):
            assert task.judge(slip.example).slip == slip.name, seed
