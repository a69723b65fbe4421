"""Lesson 3: neighbours against invariants, the app's state, its errors, its exercises."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

pytest.importorskip("anywidget")
pytest.importorskip("pythreejs")

from ruledlab.design import Design
from ruledlab.exercises import core, lesson_03
from ruledlab.geometry import GeometryError, RuledSurface, common_perpendicular, gallery, vector
from ruledlab.lab.apps.lesson_03 import MovingLine, moving_line
from ruledlab.lab.overlay import pack
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.scenes import moving
from ruledlab.lab.scenes.moving import STARTS, Motion, Moving, near, picture, said, start, words
from ruledlab.lab.scenes.shrinking import ahead, order, shrinking, shrinking_svg

BY_KEY = {entry.key: entry for entry in STARTS}
TYPED = [entry for entry in STARTS if entry.moving.kind != "gallery"]
titled = pytest.mark.parametrize("entry", STARTS, ids=lambda entry: entry.key)


def agree(found: object, expected: object, within: float = 1e-9) -> None:
    np.testing.assert_allclose(found, np.broadcast_to(expected, np.shape(found)), atol=within)


# -- neighbours: distance by angle is δ, the feet are m --------------------------------------------


@pytest.mark.parametrize("key", gallery.names())
def test_of_each_gallery_surface_the_limit_of_neighbours_is_known(key: str) -> None:
    """Lines alone, without any derivative, against δ and m; the difference falls with h."""
    surface, t = gallery.surface(key), np.array([0.13, 0.37, 0.71])
    delta, m = surface.invariants(t).delta, surface.striction(t)
    size = 1.0 + np.abs(m).max() + np.abs(delta).max()
    off = []
    for h in (1e-3, 1e-4, 1e-5):
        pair = surface.neighbours(t, h)
        quotient = np.abs(pair.distance / pair.angle - delta).max()
        off.append((quotient / size, np.linalg.norm(pair.foot_a - m, axis=1).max() / size))
    for first, second, third in zip(*off, strict=True):
        assert third < 2e-3
        assert second < 0.2 * first or first < 1e-7
    # and both tend to m from both rulings
    agree(surface.neighbours(t, 1e-5).foot_b / size, m / size, 3e-3)


@pytest.mark.parametrize("key", gallery.names())
@given(slide=st.floats(-3, 3))
@settings(max_examples=5, deadline=None)
def test_another_base_curve_is_the_same_surface(key: str, slide: float) -> None:
    """m from c + s x by its own formula, with differences for derivatives."""
    surface, t, h = gallery.surface(key), np.array([0.21, 0.64]), 1e-5

    def along(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        line = surface.line(t)
        return line.direction, line.foot + slide * line.direction

    (x0, c0), (x, c), (x1, c1) = (along(place) for place in (t - h, t, t + h))
    dx, dc = (x1 - x0) / (2 * h), (c1 - c0) / (2 * h)
    way = (dx * dc).sum(axis=1) / (dx * dx).sum(axis=1)
    agree(c - way[:, None] * x, surface.striction(t), 1e-4)
    agree(np.cross(c, x), surface.line(t).moment, 1e-9)


# -- the surfaces with formulas, against what their notes say --------------------------------------


def of(key: str, a: float) -> tuple[RuledSurface, np.ndarray]:
    value = BY_KEY[key].moving
    surface = moving.moved(Moving(value.kind, value.first, value.second, a, value.domain)).surface
    return surface, np.linspace(*value.domain, 23)


@pytest.mark.parametrize("a", [0.3, 1.0, 2.0])
def test_the_notes_of_the_typed_surfaces_are_true(a: float) -> None:
    for key in ("helicoid", "oblique", "lines"):
        surface, t = of(key, a)
        agree(surface.invariants(t).delta, a)
        axis = np.stack([0 * t, 0 * t, a * t], axis=1)
        agree(surface.striction(t), axis)
    surface, t = of("oblique", a)
    agree(np.arccos(surface.line(t).direction[:, 2]), math.pi / 4)
    surface, t = of("tangents", a)
    agree(surface.invariants(t).delta, 0.0)
    agree(surface.striction(t), np.stack([np.cos(t), np.sin(t), a * t], axis=1))
    surface, t = of("conoid", a)
    agree(surface.invariants(t).delta, 2 * a * np.cos(2 * t))
    surface, t = of("paraboloid", a)
    x, y, z = np.moveaxis(surface.points(t, [-1.0, 0.5]), -1, 0)
    agree(z, a * x * y)
    agree(surface.invariants(t).delta, (1 + a * a * t * t) / a)


@pytest.mark.parametrize("a", [0.2, 1.0, -0.7])
def test_both_circles_give_the_same_hyperboloid(a: float) -> None:
    (first, t), (second, _) = of("waist", a), of("circle", a)
    x, y, z = np.moveaxis(first.points(t, [-2.0, 0.0, 1.0]), -1, 0)
    agree(x * x + y * y - a * a * z * z, 1.0)
    agree(first.invariants(t).delta, 1 / a)
    agree(first.striction(t), np.stack([np.cos(t), np.sin(t), 0 * t], axis=1))
    agree(second.striction(t), first.striction(t))
    agree(second.line(t).plucker, first.line(t).plucker)


def test_the_cylinder_has_neither_delta_nor_striction_curve_and_says_why() -> None:
    motion = Motion(BY_KEY["waist"].moving)
    assert motion.edit("a", a=0.0)
    pair = motion.near
    assert math.isnan(pair.delta) and math.isnan(pair.ratio) and math.isnan(pair.off)
    assert pair.distance == pytest.approx(2 * math.sin(pair.h / 2), abs=1e-12)
    assert "cylindrical" in pair.reasons[0]
    assert "cylindrical" in words(motion.result, pair)
    drawn = picture(motion.result, pair)
    ruling, beside = (
        next(s for s in drawn.strokes if s.name == n) for n in ("ruling", "neighbour")
    )
    assert np.isfinite([ruling.points, beside.points]).all()
    agree(beside.points[:, :2], [math.cos(1 + pair.h), math.sin(1 + pair.h)])


def test_the_band_leaves_its_middle_circle() -> None:
    surface, t = of("band", 0.0)
    middle = np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)
    away = np.linalg.norm(surface.striction(t) - middle, axis=1)
    assert t[away < 1e-6] == pytest.approx([math.pi])
    assert away.max() == pytest.approx(1.0, abs=0.01)
    assert not surface.closure().oriented


# -- one ruling and its neighbour ------------------------------------------------------------------


@titled
def test_what_is_drawn_lies_where_it_should(entry: moving.Start) -> None:
    motion = Motion(entry.moving)
    motion.edit("slide", slide=0.4)
    pair, surface = motion.near, motion.result.surface
    assert start(motion.value) == entry
    here, beyond = surface.line(pair.t), surface.line(float(ahead(surface, pair.t, pair.h)))
    for point, line in ((pair.base, here), (pair.foot, here), (pair.far_foot, beyond)):
        agree(line.distance_to(point), 0.0, 1e-6)
    drawn = picture(motion.result, pair)
    for stroke in drawn.strokes:
        if stroke.name in ("ruling", "neighbour"):
            line = here if stroke.name == "ruling" else beyond
            agree(line.distance_to(stroke.points), 0.0, 1e-6)
    curve = next(s for s in drawn.strokes if s.name == "base curve").points
    known = np.isfinite(curve).all(axis=1)
    agree(surface.line(motion.result.scene.t).distance_to(curve)[known], 0.0, 1e-6)
    for theme in (LIGHT, DARK):
        pack(drawn, theme)


@titled
def test_s_moves_the_base_curve_and_nothing_else(entry: moving.Start) -> None:
    result = moving.moved(entry.moving)
    t = 0.3 * result.surface.domain[1]
    before = near(result, t)
    moved = near(moving.moved(Moving(**{**_fields(entry.moving), "slide": 0.7})), t)
    agree(moved.base - before.base, 0.7 * before.direction)
    assert moved.along == pytest.approx(before.along - 0.7, abs=1e-9)
    for name in ("striction", "foot", "far_foot", "distance", "angle", "delta", "off"):
        agree(getattr(moved, name), getattr(before, name))


def _fields(value: Moving) -> dict[str, object]:
    return {name: getattr(value, name) for name in Moving.__slots__}


def test_the_base_curve_of_a_picture_moves_as_its_rate_says() -> None:
    for entry in TYPED:
        scene = moving.moved(entry.moving).scene
        h = scene.t[1] - scene.t[0]
        slope = (scene.base[2:] - scene.base[:-2]) / (2 * h)
        agree(scene.base_rate[1:-1], slope, 5e-3 * (1 + np.abs(slope).max()))


# -- how fast the neighbour comes nearer -----------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "place", "orders"),
    [
        ("circle", 1.0, (1, 1, 1)),
        ("tangents", 1.0, (1, 3, 1)),  # of a developable the distance is of the third order
        ("tangent_developable", 0.4, (1, 3, 1)),
        ("conoid", math.pi / 4, (1, 2, None)),  # torsal; the feet lie on the axis, as m does
        ("helicoid", 1.0, (1, 1, None)),
        ("cone", 0.3, (1, None, None)),
        ("cusp", 0.5, (2, 2, None)),  # κ = 0, and no striction point
    ],
)
def test_the_orders_are_those_of_geometry(
    key: str, place: float, orders: tuple[int | None, ...]
) -> None:
    found = shrinking(moving.moved(BY_KEY[key].moving).surface, place)
    for name, expected in zip(("angle", "distance", "off"), orders, strict=True):
        p = order(found, name)
        assert (p == pytest.approx(expected, abs=0.1)) if expected else math.isnan(p), name


def test_round_the_seam_of_a_closed_surface_the_neighbour_is_on_it() -> None:
    surface = gallery.surface("example_2")
    step = 0.08
    assert ahead(surface, 0.5, step) == 0.58
    assert ahead(surface, 0.97, step) == pytest.approx(0.05)
    chosen = Moving("gallery", "example_2", exponent=math.log10(step))
    pair = near(moving.moved(chosen), 0.97)
    expected = common_perpendicular(surface.line(0.97), surface.line(0.05))
    assert pair.angle == pytest.approx(float(expected.angle), rel=1e-12)
    assert pair.distance == pytest.approx(float(expected.distance), rel=1e-12)
    np.testing.assert_allclose(pair.beyond, surface.line(0.05).direction)


@pytest.mark.parametrize("key", ["right_helicoid", "moebius"])
def test_where_the_line_does_not_come_back_the_formulas_go_on(key: str) -> None:
    assert ahead(gallery.surface(key), 0.97, 0.08) == pytest.approx(1.05)


def test_the_orders_are_said_and_drawn_in_both_themes(app: MovingLine) -> None:
    app.shape.menu.value = "tangents"
    for dark, theme in ((True, DARK), (False, LIGHT)):
        app.restyle(dark)
        shown = app.graph.value
        assert "angle θ <b>like h</b>" in shown and "distance d <b>like h<sup>3</sup></b>" in shown
        assert all(theme.quantity(name) in shown for name in ("tau", "delta", "sigma"))
        assert (
            'aria-label="Over the step h' in shown and "distance d like h to the power 3" in shown
        )
    app.shape.menu.value = "waist"
    app.shape.a.slider.value = 0.0
    assert "angle θ <b>is 0</b>" in app.graph.value
    assert "foot to m <b>undefined</b>" in app.graph.value


@pytest.mark.parametrize("h", [0.001, 0.03, 0.5])
def test_the_marks_in_the_graph_lie_where_the_numbers_say(h: float) -> None:
    surface = moving.moved(BY_KEY["circle"].moving).surface
    pair = surface.neighbours(1.0, h)
    off = float(np.linalg.norm(pair.foot_a - surface.striction(1.0)))
    shown = shrinking_svg(shrinking(surface, 1.0), h, LIGHT)
    marks = re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)"', shown)
    lines = [float(y) for y in re.findall(r'<path d="M44 ([\d.]+)H', shown)]  # 1, 10⁻², 10⁻⁴ …
    for (_, y), value in zip(marks, (pair.angle, pair.distance, off), strict=True):
        at = lines[0] - (lines[1] - lines[0]) / 2 * math.log10(value)
        assert float(y) == pytest.approx(at, abs=0.3)


def test_small_numbers_show_their_order_and_rounding_is_zero() -> None:
    assert said(-3.73e-5) == "−3.730·10⁻⁵"
    assert said(4e-11) == "0.000000"
    assert said(4e-11, 1e-12) == "4.000·10⁻¹¹"
    assert said(-1e-14) == "0.000000"
    assert said(0.25) == "0.250000"
    assert said(math.inf) == "–"


# -- the state -------------------------------------------------------------------------------------


def test_only_another_surface_makes_another_picture() -> None:
    motion = Motion(BY_KEY["oblique"].moving)
    scene = motion.result.scene
    motion.edit("slide", slide=1.0)
    motion.edit("exponent", exponent=-2.0)
    motion.move_cursor(2.0)
    assert motion.result.scene is scene
    motion.edit("a", a=0.7)
    assert motion.result.scene is not scene


def test_the_cursor_keeps_its_part_of_another_domain() -> None:
    motion = Motion(BY_KEY["oblique"].moving, cursor=math.pi)
    motion.load(BY_KEY["crown"].moving, "menu")
    assert motion.cursor == pytest.approx(0.5)
    motion.undo()
    assert motion.cursor == pytest.approx(math.pi)
    motion.move_cursor(99.0)
    assert motion.cursor == pytest.approx(2 * math.pi)
    assert motion.near.t == motion.cursor


@pytest.mark.parametrize(
    ("first", "second", "says"),
    [
        ("cos(t), sin(t)", "1, t, 0", "base curve"),
        ("cos(t), sin(t), 0", "0, 0, 0", "direction that is not zero"),
        ("log(-1-t**2), 0, 0", "1, t, 0", "base curve"),
        ("t, t, u", "1, t, 0", "unknown name 'u'"),
    ],
)
def test_what_gives_no_surface_is_refused(first: str, second: str, says: str) -> None:
    with pytest.raises(GeometryError, match=says):
        moving.moved(Moving("base", first, second))


# -- the app ---------------------------------------------------------------------------------------


@pytest.fixture
def app() -> Iterator[MovingLine]:
    app = moving_line("oblique")
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


def test_a_formula_with_a_mistake_keeps_the_picture_and_is_pointed_at(app: MovingLine) -> None:
    before = app.motion.result
    _, field, error, _ = app.shape.rows["second"]
    field.value = "cos(t), sin(x), 1"
    assert "unknown name &#x27;x&#x27; at column 13" in error.value and "^" in error.value
    assert app.motion.result is before
    field.value = "0, 0, 0"
    assert "not zero" in error.value
    assert app.motion.result is before
    field.value = "cos(t), sin(t), 3"
    assert error.value == ""
    assert app.motion.near.delta == pytest.approx(0.5)
    assert app.shape.menu.value == ""  # none of the menu's
    app.history.undo.click()
    assert app.shape.menu.value == "oblique" and field.value == "cos(t), sin(t), 1"


def test_the_fields_follow_the_kind_of_surface(app: MovingLine) -> None:
    label, field, _, _ = app.shape.rows["first"]
    assert "c(t)" in label.value and field.value == "0, 0, a*t"
    app.shape.menu.value = "conoid"
    assert "x(t)" in label.value and "x̄(t)" in app.shape.rows["second"][0].value
    app.shape.menu.value = "crown"
    assert app.shape.typed.layout.display == "none"
    assert (app.time.t.slider.min, app.time.t.slider.max) == (0.0, 1.0)
    app.history.undo.click()
    assert app.shape.typed.layout.display == "flex"
    assert app.time.t.slider.max == pytest.approx(2 * math.pi)


def test_the_numbers_say_what_the_surface_says(app: MovingLine) -> None:
    app.steps.exponent.slider.value = -2.0
    pair = app.motion.near
    assert pair.h == pytest.approx(0.01)
    assert f"{pair.ratio:.6f}" in app.numbers.value and f"{pair.delta:.6f}" in app.numbers.value
    assert "rad" in app.numbers.value
    assert f"{pair.delta:.6f}" in app.view._words.value  # and in words
    app.steps.exponent.field.value = "-5"
    assert "between" in app.steps.exponent.error.value
    assert pair is app.motion.near


def test_the_legend_has_the_colours_of_the_picture(app: MovingLine) -> None:
    for dark, theme in ((True, DARK), (False, LIGHT)):
        app.restyle(dark)
        assert all(theme.quantity(name) in app.legend.value for name in ("kappa", "tau", "delta"))


def test_an_unknown_name_is_refused() -> None:
    assert len(BY_KEY) == len(STARTS)
    with pytest.raises(GeometryError, match="`key` must be one of helicoid, oblique"):
        moving_line("torus")


# -- the exercises, by another route ---------------------------------------------------------------

SEEDS = ("", "Ada", "7", "Σ")


def task(key: str, seed: str) -> core.Task:
    return core.find(key).task(seed)


@pytest.mark.parametrize("seed", SEEDS)
def test_delta_in_code_is_that_of_the_determinant(seed: str) -> None:
    asked = task("03.8", seed)
    t = sp.symbols("t")
    place = float(asked.question.split("t=")[-1].rstrip("$."))
    k = int(asked.question.split(r"(\sin t,0,")[1][0])
    x = sp.Matrix([sp.sin(t), 0, k])
    x = x / sp.sqrt(x.dot(x))
    c = sp.Matrix([sp.cos(t), sp.sin(t), t])
    determinant = sp.Matrix.hstack(c.diff(t), x, x.diff(t)).det()
    delta = float((determinant / x.diff(t).dot(x.diff(t))).subs(t, place))
    assert float(np.asarray(asked.answer)) == pytest.approx(delta, abs=1e-10)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_dual_conoid_answers_its_closed_form(seed: str) -> None:
    asked = task("03.9", seed)
    k = int(asked.question.split(r"\sin")[-1][0])
    place = float(asked.question.split("t=")[-1].rstrip("$."))
    height = f"sin({k}*t)"
    x, moment = vector("cos(t), sin(t), 0"), vector(f"-{height}*sin(t), {height}*cos(t), 0")
    surface = RuledSurface.from_lines(moving._dual(x, moment))
    assert asked.answer == pytest.approx(float(surface.invariants(place).delta), abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_striction_point_is_where_the_neighbour_is_nearest(seed: str) -> None:
    asked = task("03.3", seed)
    base = np.array(asked.slips[0].example)
    n, r = base[2] - asked.answer[2], base[1]
    a = base[0] / n
    circle = vector(f"{r}*cos(t) + {n}*a*sin(t), {r}*sin(t) - {n}*a*cos(t), {base[2]}", a=a)
    surface = RuledSurface.from_base(circle, vector("a*sin(t), -a*cos(t), 1", a=a), (0, 3))
    agree(circle(math.pi / 2), base, 1e-12)
    agree(surface.neighbours(math.pi / 2, 1e-6).foot_a, asked.answer, 1e-4)
    foot = next(slip for slip in asked.slips if slip.name.startswith("foot point"))
    agree(surface.foot(math.pi / 2), foot.example, 1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_on_the_helicoid_only_the_third_line_is_wrong(seed: str) -> None:
    asked = task("03.10", seed)
    r, p, h = -float(asked.then.answer), float(asked.lines[3].text.split("$")[1][0]), 0.2
    helix = vector(f"{r}*cos(t), {r}*sin(t), {p}*t")
    surface = RuledSurface.from_base(helix, vector("cos(t), sin(t), 0"), (0, 3))
    pair, x = surface.neighbours(1.0, h), surface.line(1.0).direction
    assert (float(pair.angle), float(pair.distance)) == pytest.approx((h, p * h))
    assert asked.wrong_line == 2
    agree(pair.foot_a, np.array(helix(1.0)) - r * x)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_formulas_are_those_of_the_surfaces(seed: str) -> None:
    k = int(task("03.5", seed).answer[0])
    p, v = 0.7, 1.1
    slanted = vector(f"cos(t)*{math.sin(v)}, sin(t)*{math.sin(v)}, {math.cos(v)}")
    found = RuledSurface.from_base(vector(f"0, 0, {k * p}*t"), slanted).invariants(0.4)
    assert float(found.delta) == pytest.approx(k * p)
    assert float(found.kappa_bar) == pytest.approx(k * p * math.sin(v))  # the first slip
    k = int(task("03.6", seed).answer[-1])
    rulings = RuledSurface.from_base(vector("t, 0, 0"), vector(f"0, 1, {k}*t"), (-1, 1))
    assert float(rulings.invariants(0.6).delta) == pytest.approx((1 + k * k * 0.36) / k)


def test_a_developable_of_another_make_is_right_too() -> None:
    asked = task("03.7", "")
    known = gallery.example("tangent_developable")
    assert asked.judge(Design(known.points, known.ubar, known.vbar)).right
    mirrored = asked.model.with_(ubar=f"-({asked.model.ubar})", vbar=asked.model.vbar[1:])
    assert asked.judge(mirrored).right
    point = asked.start.with_(points=((1.0, 1.0), (1.0, 1.0)))
    assert "cannot" in asked.judge(point).word or "turns" in asked.judge(point).word


def test_values_vary_with_the_seed_and_kinds_differ() -> None:
    every = lesson_03.EXERCISES
    assert {e.task().kind for e in every} >= {"choose", "number", "formula", "drag", "code", "slip"}
    for exercise in every[2:]:
        assert len({exercise.task(str(seed)).question + str(
            getattr(exercise.task(str(seed)), "lines", "")) for seed in range(9)}) > 1  # fmt: skip


def test_the_foot_of_the_line_moves_h(app):
    (foot,) = app.foot.picture["handles"]
    drawn = re.search(
        r'd="M([\d.]+) [\d.]+V([\d.]+)" stroke="[^"]+" stroke-width="1.5"', app.graph.value
    )
    assert (foot["x"], foot["y"]) == pytest.approx(tuple(map(float, drawn.groups())), abs=0.06)
    size = app.foot.picture["size"]
    assert f'viewBox="0 0 {size[0]:g} {size[1]:g}"' in app.graph.value
    before = app.motion.value.exponent
    app.foot.motion = ["view", 1, 0, foot["x"] - 100.0, foot["y"] - 50.0]
    per_power = (322.0 - 44.0) / 2.7
    assert app.motion.value.exponent == pytest.approx(before - 100.0 / per_power, abs=6e-3)
    app.foot.motion = ["view", 1, 0, -500.0, 0.0]
    assert app.motion.value.exponent == -3.0
    app.history.undo.click()
    assert app.motion.value.exponent == before
