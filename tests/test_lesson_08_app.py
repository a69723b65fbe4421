"""The app of lesson 08: what it shows, that every control leads back, and that nothing is left."""

from __future__ import annotations

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("pythreejs")

import ipywidgets
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab import Bezier, RuledSurface
from ruledlab.exercises import find
from ruledlab.geometry import carried, enclosed, gallery
from ruledlab.geometry.curve import close
from ruledlab.geometry.line import Line
from ruledlab.lab import example, once_round
from ruledlab.lab.apps import lesson_08
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.scenes import once_round as once_round_scene
from ruledlab.lab.scenes.once_round import (
    LEGEND,
    numbers_html,
    overlay_of,
    path_of,
    region_svg,
    seam_html,
    ways_of,
)

from .strategies import loops

CLOSED = ["cone", "hyperboloid", "example_2", "crown", "tower", "twisted_ring", "orchid"]
OPEN = ["moebius", "right_helicoid", "shell", "ramp", "hyperbolic_paraboloid"]


@pytest.fixture
def app():
    app = once_round()
    yield app
    app.close()
    defects = [group.defect.value for group in (*app._groups, *app.figure._groups)]
    assert [text for text in defects if text] == []


def shown(app):
    return app.region.value, app.numbers.value, app.seam.value


def named(overlay, kind, name):
    return next(item for item in getattr(overlay, kind) if item.name == name)


# ---- what is drawn ------------------------------------------------------------------------------


@pytest.mark.parametrize("key", CLOSED)
def test_the_gap_that_is_drawn_is_the_pitch(app, key):
    app.lab.load(example(key), "test")
    surface = app.lab.result.surface
    overlay = overlay_of(app.lab, app._path)
    start, end = named(overlay, "strokes", "gap").points
    along = surface.line(0.0).direction
    assert (end - start) @ along == pytest.approx(surface.pitch(), abs=1e-8)
    assert np.linalg.norm(end - start) == pytest.approx(abs(surface.pitch()), abs=1e-8)


def test_the_walk_crosses_every_ruling_at_a_right_angle():
    surface = gallery.surface("example_2")
    walk = path_of(surface, 0.7).walk
    chords = np.diff(walk.points, axis=0)
    middle = surface.line(0.5 * (walk.t[1:] + walk.t[:-1])).direction
    slope = (chords * middle).sum(axis=1) / np.linalg.norm(chords, axis=1)
    assert np.abs(slope).max() < 1e-4
    first = surface.striction(0.0) + 0.7 * surface.line(0.0).direction
    assert np.allclose(walk.points[0], first)


def test_the_gap_does_not_depend_on_where_the_walk_begins(app):
    gaps = []
    for w0 in (-1.0, 0.0, 1.4):
        app.start.field.value = str(w0)
        gaps.append(named(overlay_of(app.lab, app._path), "strokes", "gap").points)
    sizes = [np.linalg.norm(gap[1] - gap[0]) for gap in gaps]
    assert sizes == pytest.approx([0.580104765135371] * 3, abs=1e-9)
    assert not np.allclose(gaps[0], gaps[1])


def test_the_fan_opens_by_the_angle_of_pitch(app):
    app.lab.load(example("hyperboloid"), "test")
    surface = app.lab.result.surface
    fan = named(overlay_of(app.lab, app._path), "sheets", "λ").points
    rim = fan[1] - fan[0]
    unit = rim / np.linalg.norm(rim, axis=1)[:, None]
    x = surface.line(0.0).direction
    turns = np.arctan2(np.cross(unit[:-1], unit[1:]) @ x, (unit[:-1] * unit[1:]).sum(axis=1))
    assert turns.sum() == pytest.approx(surface.angle_of_pitch(), abs=1e-8)


def test_the_fan_lies_between_the_arm_at_the_start_and_at_the_end(app):
    overlay = overlay_of(app.lab, app._path)
    fan = named(overlay, "sheets", "λ").points
    rays = fan[1, [0, -1]] - fan[0, [0, -1]]
    arms = [named(overlay, "strokes", f"ξ at the {end}").points for end in ("start", "end")]
    for ray, arm in zip(rays, arms, strict=True):
        sine = np.linalg.norm(np.cross(ray, arm[1] - arm[0]))
        assert sine == pytest.approx(0.0, abs=1e-9) and ray @ (arm[1] - arm[0]) > 0


def test_a_walk_from_elsewhere_is_drawn(app, monkeypatch):
    drawn = []
    monkeypatch.setattr(app.view, "overlay", drawn.append)
    app.start.field.value = "1.25"
    surface = app.lab.result.surface
    start = surface.striction(0.0) + 1.25 * surface.line(0.0).direction
    assert np.allclose(named(drawn[-1], "dots", "start").point, start)


def test_the_cursor_walks_along(app):
    app.lab.move_cursor(0.25)
    overlay = overlay_of(app.lab, app._path)
    mark, walk = named(overlay, "dots", "cursor").point, app._path.walk
    assert np.allclose(mark, walk.points[100])


@pytest.mark.parametrize("key", OPEN)
def test_what_does_not_come_back_shows_no_gap_and_says_why(app, key):
    app.lab.load(example(key), "test")
    overlay = overlay_of(app.lab, app._path)
    assert not [s for s in overlay.strokes if s.name == "gap"] and not overlay.sheets
    assert named(overlay, "strokes", "trajectory").points.shape == (401, 3)
    assert "no pitch and no angle of pitch" in app.numbers.value
    said = "comes back reversed" if key == "moebius" else "does not close"
    assert said in app.seam.value
    assert "svg" not in app.region.value


# ---- numbers ------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", CLOSED)
def test_the_three_ways_agree(key):
    surface = gallery.surface(key)
    ways = ways_of(surface)
    real, dual = float(ways.total.real), float(ways.total.dual)
    assert -ways.region.tau_from_area == pytest.approx(real, abs=1e-8)
    assert -ways.region.tau_bar_from_flux == pytest.approx(dual, abs=1e-8)
    assert ways.region.corner - ways.steps.bend == pytest.approx(real, abs=1e-7)
    assert ways.steps.shift == pytest.approx(dual, abs=1e-7)
    assert ways.reasons == ()


def test_the_numbers_of_example_2(app):
    text = app.numbers.value
    rows = dict(re.findall(r"<tr><th scope=.row.>([^<]+)</th><td>([^<]+)", text))
    assert {rows[way] for way in ("line integral, −∮τ̂ dt", "area and flux", "in 512 steps")} == {
        "−6.115937783"
    }
    assert "−6.115937783" in text and "0.580104765" in text and "0.167248" in text
    assert "λ = A − 2π·1, A = 0.167248; l = flux, flux = 0.580105." in text
    assert "+ ε 0.580105" in text


def test_the_note_is_an_equation_that_holds(app):
    """λ = A − 2πT ± corner and l = flux ± border, read from the page."""
    corner = Bezier([[1, 1.2], [1.5, 1.0], [2, 1.9], [1.0, 2.2], [1, 1.2]])
    surfaces = [gallery.surface(key) for key in CLOSED] + [RuledSurface(corner, "u", "v")]
    for surface in surfaces:
        ways = ways_of(surface)
        note = numbers_html(ways, path_of(surface, 0.0)).split("ruledlab-note")[1]
        note = note.replace("−", "-").replace(" ", "")
        turns, bend, area = re.search(
            r"λ=A-2π·\(?(-?\d+)\)?([+-][\d.]+)?,A=(-?\d+\.\d+)", note
        ).groups("0")
        border, flux = re.search(r"l=flux([+-][\d.]+)?,flux=(-?\d+\.\d+)", note).groups("0")
        angle = float(area) - 2 * math.pi * int(turns) + float(bend)
        assert angle == pytest.approx(float(ways.total.real), abs=1e-4)
        assert float(flux) + float(border) == pytest.approx(float(ways.total.dual), abs=1e-4)


def test_a_field_with_an_edge_keeps_all_three_ways():
    """|v − 0.8| has no divergence on the circle v = 0.8: flux to rounding, but no Steiner vector.

    For there the striction point jumps along the ruling, and the frame with it.
    """
    surface = RuledSurface(gallery.surface("example_2").curve, "u - v", "abs(v - 0.8)")
    ways = ways_of(surface)
    table = numbers_html(ways, path_of(surface, 0.0))
    dual = float(ways.total.dual)
    assert -ways.region.tau_bar_from_flux == pytest.approx(dual, abs=1e-10)
    assert ways.steps.shift == pytest.approx(dual, abs=1e-5)
    assert ways.carried is None and "jumps along the ruling" in ways.reasons[0]
    assert "carried along" not in table and "±" not in table and "certain" not in table


def flux_cell(vbar):
    """The flux's l as shown, what it is said to be off by, and the true l."""
    surface = RuledSurface(gallery.surface("example_2").curve, "u", vbar)
    table = numbers_html(ways_of(surface), path_of(surface, 0.0))
    row = table.split("area and flux")[1].split("</tr>")[0].split("<td>")[2].replace("−", "-")
    value, figure, power = re.match(r"(-?[\d.]+)(?: ± (\d)·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", row).groups()
    digits = (power or "⁻⁹").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
    return value, float(figure or 1) * 10.0 ** int(digits), surface.pitch(), table


@pytest.mark.parametrize(
    "vbar", ["1/((u - 0.8)**2 + (v - 0.8)**2)", "sin(200*u*v)", "sqrt(abs(u - 0.8)) + v"]
)
def test_a_number_that_is_not_exact_says_how_far_off_it_may_be(vbar):
    value, off, pitch, table = flux_cell(vbar)
    assert f"{value} ± ".replace("-", "−") in table
    assert abs(float(value) - pitch) <= 2 * off
    assert 10.0 ** -len(value.split(".")[1]) >= off / 20  # no digit that is not certain
    assert "The flux is certain to" in table and "Stokes" not in table


def test_a_flux_without_a_value_is_not_shown():
    surface = RuledSurface(
        gallery.surface("example_2").curve, "u", "1/((u - 0.8)**2 + (v - 0.8)**2 - 0.01)"
    )
    ways = ways_of(surface)
    assert ways.region is None and "flux does not converge" in ways.reasons[0]
    table = numbers_html(ways, path_of(surface, 0.0))
    assert "area and flux" not in table and "in 512 steps" in table


def test_a_field_that_jumps_is_told_from_one_that_is_rough():
    """arctan2 jumps by 2π across a ray that the curve crosses: no flux makes up for that."""
    *_, table = flux_cell("arctan2(v - 0.8, u - 0.8)")
    assert "ū or v̄ jumps inside the region" in table
    *_, smooth = flux_cell("u + v")
    assert "jumps" not in smooth and "certain" not in smooth


def test_the_seam_says_what_jumps(app):
    rows = re.findall(r"<th scope=.row.>(X[′″]?)</th><td>(.*?)</td><td>(.*?)</td>", app.seam.value)
    assert rows == [("X", "none", "none"), ("X′", "none", "none"), ("X″", "23.56", "43.18")]
    app.figure.points.closing.value = "C2"
    assert app.seam.value.count("none") == 6
    app.figure.points.closing.value = "C0"
    app.figure.points.place(1, (0.7, 1.4), None)
    (first, second, _) = re.findall(r"<td>(.*?)</td>", app.seam.value)[::2]
    assert first == "none" and float(second) > 0.1
    assert "corner at the seam" in app.numbers.value
    app.figure.points.closing.value = "open"
    app.figure.points.place(0, (0.7, 1.4), None)
    assert "does not close" in app.seam.value


# ---- the region ---------------------------------------------------------------------------------


def spans(svg):
    """The area in pixels of each shade, from the rows of its path."""
    found = {}
    for path, hue in re.findall(r'<path d="([^"]*)" fill="(#\w+)"', svg):
        rows = re.findall(r"M([-\d.]+),[-\d.]+H([-\d.]+)v2", path)
        found[hue] = sum(2 * (float(b) - float(a)) for a, b in rows)
    return found


def test_the_shaded_region_has_the_loops_shape():
    region = enclosed(gallery.surface("example_2"))
    svg = region_svg(region)
    (area,) = spans(svg).values()
    u, v = region.outline.T
    flat = abs(np.trapezoid(v, u))
    wide = 380 - 70
    tall = 280 - 44
    scale = min(wide / np.ptp(u), tall / np.ptp(v))
    assert area == pytest.approx(flat * scale**2, rel=0.01)
    assert 'role="img"' in svg and "A = 0.167248" in svg and ">+1</text>" in svg


def test_the_way_round_decides_the_colour_and_the_sign():
    surface = gallery.surface("example_2")
    back = RuledSurface(Bezier(surface.curve.points[::-1]), surface.ubar, surface.vbar)
    there, again = region_svg(enclosed(surface)), region_svg(enclosed(back))
    assert set(spans(there)) != set(spans(again))
    assert ">−1</text>" in again and "A = −0.167248" in again


def test_a_figure_of_eight_has_both_signs():
    t = np.pi / 8
    eight = [[1, 2], [1, 3], [3, 1], [3, 2], [3, 3], [1, 1], [1, 2]]
    svg = region_svg(enclosed(RuledSurface(Bezier(t * np.array(eight)), "u - v", "u + v")))
    assert len(spans(svg)) == 2
    assert ">+1</text>" in svg and ">−1</text>" in svg


@settings(max_examples=8, deadline=None)
@given(loops(order=0), st.sampled_from(["u", "1", "v"]))
def test_any_loop_has_a_picture(curve, ubar):
    svg = region_svg(enclosed(RuledSurface(curve, ubar, "0")))
    assert svg.startswith("<svg") and "nan" not in svg and "inf" not in svg


# ---- controls -----------------------------------------------------------------------------------


def test_every_control_to_both_ends_and_back(app):
    before = shown(app), app.lab.design
    slider = app.start.slider
    for slider in (app.start.slider, app.time.t.slider):
        value = slider.value
        for end in (slider.min, slider.max, value):
            slider.value = end
    for key in gallery.names():
        app.gallery.menu.value = key
    app.gallery.menu.value = "example_2"
    assert (shown(app), app.lab.design) == before
    assert app._w0 == pytest.approx(0.3)


def test_undo_redo_and_reset_lead_back(app):
    before = shown(app)
    app.figure.points.place(3, (1.3, 0.9), None)
    moved = shown(app)
    assert moved != before
    app.history.undo.click()
    assert shown(app) == before
    app.history.redo.click()
    assert shown(app) == moved
    app.history.reset.click()
    assert shown(app) == before


def test_errors_stand_beside_the_control_and_the_picture_stays(app):
    before = shown(app)
    app.start.field.value = "0.3 +"
    assert "alert" in app.start.error.value
    app.start.field.value = "0.5"
    assert app.start.error.value == ""
    app.lab.edit("ubar", ubar="u +")
    assert shown(app) == before


def test_a_first_ruling_without_striction_point_is_said(app):
    """κ = 0 at t = 0: there is nothing to count w₀ from."""
    points = ((0.4, 0.8), (0.4, 0.8), (1.2, 1.2), (1.2, 0.4), (0.4, 0.8))
    app.lab.edit("test", points=points, closing="C0")
    assert "no" in app.start.error.value and "striction point" in app.start.error.value
    overlay_of(app.lab, app._path)


def test_the_words_say_what_the_picture_shows(app):
    assert "+0.5801 along the ruling" in app.view._words.value
    assert "turned by -6.1159 rad" in app.view._words.value
    app.lab.load(example("moebius"), "test")
    assert "comes back to its ruling" not in app.view._words.value


def test_the_dark_theme_reaches_the_view(app, monkeypatch):
    themes = []
    monkeypatch.setattr(app.view, "set_theme", themes.append)
    app._page.set_state({"dark": True})
    assert [theme.dark for theme in themes] == [True]


def test_the_legend_names_every_colour_of_the_way_round(app):
    overlay = overlay_of(app.lab, app._path)
    drawn = {item.colour for item in (*overlay.strokes, *overlay.dots, *overlay.sheets)}
    assert drawn <= {name for name, _ in LEGEND}
    light = app.legend.value
    assert all(LIGHT.quantity(name) in light and text in light for name, text in LEGEND)
    app._page.set_state({"dark": True})
    assert all(DARK.quantity(name) in app.legend.value for name, _ in LEGEND)


def test_a_move_evaluates_what_it_shows_once(app, monkeypatch):
    """Every count is made once a move; one of w₀ or t makes none."""
    asked = []
    for name in ("enclosed", "steiner", "stepped"):
        found = getattr(once_round_scene, name)

        def counted(surface, found=found, name=name):
            asked.append(name)
            return found(surface)

        counted.__name__ = name
        monkeypatch.setattr(once_round_scene, name, counted)
    app.figure.points.place(3, (1.3, 0.9), None)
    assert sorted(asked) == ["enclosed", "steiner", "stepped"]
    app.start.field.value = "0.5"
    app.lab.move_cursor(0.4)
    assert len(asked) == 3


# ---- the size of the loop ------------------------------------------------------------------------


def sized(app, text):
    app.size.size.field.value = text
    return np.array(app.lab.design.points)


def ratios(app):
    """The last column of the rows under the slider: l, λ mod 2π."""
    return [
        float(cell) if cell != "–" else None
        for cell in re.findall(r"<td [^>]*>([^<]*)</td></tr>", app.shrunk.value)
    ]


@pytest.mark.parametrize("text", ["1/2", "0.1", "1.9"])
def test_the_size_scales_the_loop_about_its_middle(app, text):
    before = np.array(app.lab.design.points)
    after = sized(app, text)
    factor = float(eval(text))
    assert np.allclose(np.ptp(after, axis=0), factor * np.ptp(before, axis=0))
    assert np.allclose(after.min(axis=0) + after.max(axis=0), math.pi / 2)
    assert np.allclose(after - after[0], factor * (before - before[0]))
    assert app.lab.result.closure.order == 1
    loop = math.pi / 4 + factor * (before - math.pi / 4)
    surface = RuledSurface(Bezier(loop), "u - v", "u + v")
    assert app.lab.result.pitch.dual == pytest.approx(surface.pitch(), abs=1e-12)
    assert app.size.size.error.value == ""


def test_the_smaller_the_loop_the_more_exactly_half_the_size_leaves_a_quarter(app):
    assert ratios(app) == [1.0, 1.0]
    found = [(sized(app, size), ratios(app))[1] for size in ("0.8", "0.4", "0.2", "0.1")]
    off = np.abs(np.divide(found[1:], found[:-1]) - 0.25)
    assert (np.diff(off, axis=0) < 0).all()
    assert off[-1].max() < 1e-3


def test_the_ratios_belong_to_the_shape_and_the_fields_of_now(app):
    sized(app, "1/2")
    app.lab.edit("ubar", ubar="u*v")
    whole = RuledSurface(Bezier(app.size.whole), "u*v", "u + v")
    expected = app.lab.result.pitch.dual / whole.pitch()
    assert ratios(app)[0] == pytest.approx(expected, abs=6e-5)
    app.figure.points.place(3, (1.0, 0.8), None)
    assert ratios(app) == [1.0, 1.0]  # a new shape, of size 1


def test_a_cone_and_an_open_surface_have_no_ratio_of_pitches(app):
    app.lab.load(example("cone"), "test")
    sized(app, "1/2")
    assert ratios(app)[0] is None
    assert ratios(app)[1] == pytest.approx(0.2514, abs=1e-4)
    app.lab.load(example("shell"), "test")
    assert ratios(app) == [None, None]


def test_a_loop_run_through_backwards_shrinks_alike(app):
    points = app.lab.design.points[::-1]
    app.lab.edit("test", points=points)
    assert "2π − 0.1672" in app.shrunk.value
    sized(app, "1/2")
    assert "2π − 0.04205" in app.shrunk.value
    assert ratios(app) == pytest.approx([0.2554, 0.2514])


def test_a_stroke_of_the_size_is_one_step_of_undo_and_undo_knows_the_size(app):
    before = shown(app), app.lab.design, app.shrunk.value
    for value in (0.9, 0.7, 0.5):
        app.size.size.slider.value = value
    half = shown(app), app.lab.design, app.shrunk.value
    app.figure.points.place(3, (0.9, 0.8), None)
    assert app.size.value == 1.0
    app.history.undo.click()
    assert (shown(app), app.lab.design, app.shrunk.value) == half
    assert (app.size.value, app.size.size.field.value) == (0.5, "0.5")
    app.history.undo.click()
    assert (shown(app), app.lab.design, app.shrunk.value) == before
    assert (app.size.value, app.lab.can_undo) == (1.0, False)
    app.history.redo.click()
    assert app.size.value == 0.5


def test_back_at_size_1_every_digit_is_there(app):
    design = app.lab.design
    for value in (0.13, 1.7, 0.1, 1.0):
        app.size.size.slider.value = value
    assert app.lab.design == design
    assert app.gallery.menu.value == "example_2"


def test_a_size_that_meets_a_pole_is_refused_beside_the_slider(app):
    app.size.size.slider.value = 1.99
    good = shown(app), app.lab.design
    app.size.size.slider.value = 2.0  # v from 0 to π/2
    assert "0 &lt; v &lt; π" in app.size.size.error.value
    assert (shown(app), app.lab.design) == good
    app.size.size.slider.value = 1.99  # by one key: the number that is shown
    assert app.size.size.error.value == ""
    assert (shown(app), app.lab.design) == good


@pytest.mark.parametrize(
    ("text", "says"), [("0", "greater than 0"), ("-1", "greater than 0"), ("1 +", "alert")]
)
def test_a_size_that_is_none_is_refused(app, text, says):
    before = app.lab.design
    app.size.size.field.value = text
    assert says in app.size.size.error.value
    assert app.lab.design == before


@pytest.mark.parametrize("key", ["hyperboloid", "crown"])
def test_a_curve_round_the_axis_has_no_other_size(app, key):
    app.lab.load(example(key), "test")
    before = app.lab.design
    app.size.size.slider.value = 0.5
    assert "goes round the axis" in app.size.size.error.value
    assert app.lab.design == before
    app.history.reset.click()
    assert app.size.size.error.value == ""


def test_a_loop_beyond_a_pole_may_shrink(app):
    """Only a larger size is refused: the smaller one leads back."""
    points = np.array(app.lab.design.points) - [0.0, 0.5]
    app.lab.edit("test", points=tuple(map(tuple, points)))
    app.size.size.slider.value = 0.9
    assert app.size.value == 0.9 and app.size.size.error.value == ""


def test_the_region_keeps_its_scale_while_the_loop_shrinks(app):
    (full,) = spans(app.region.value).values()
    outline = re.search(r'<path d="([^"]*Z)" fill="none"', app.region.value)[1]
    assert "dash" not in app.region.value
    sized(app, "1/2")
    (small,) = spans(app.region.value).values()
    assert small == pytest.approx(0.25 * full, rel=0.04)
    dashed = re.search(r'<path d="([^"]*)" fill="none"[^>]*stroke-dasharray', app.region.value)[1]
    places = [np.array(re.findall(r"[\d.]+", d), dtype=float) for d in (dashed, outline)]
    assert np.allclose(*places, atol=0.15)  # where the whole loop was
    assert "The dashed line is the loop at size 1." in app.region.value
    sized(app, "1")
    assert "dash" not in app.region.value


def test_the_size_asks_for_the_full_loop_once(app, monkeypatch):
    asked = []
    found = lesson_08.total_of
    monkeypatch.setattr(lesson_08, "total_of", lambda s: asked.append(s) or found(s))
    app.lab.edit("ubar", ubar="u")
    for value in (0.9, 0.8, 0.7):
        app.size.size.slider.value = value
    assert asked == []  # it was known from size 1
    app.lab.edit("ubar", ubar="v")
    app.size.size.slider.value = 0.6
    assert len(asked) == 1


def test_closing_leaves_nothing():
    before = set(ipywidgets.widget._instances)
    app = once_round(example("orchid"))
    app.lab.move_cursor(0.5)
    app.size.size.slider.value = 0.5
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not app.lab._followers
    app.close()


# ---- exercises ----------------------------------------------------------------------------------

SEEDS = ["", "a", "b", "c"]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_hyperboloids_pitch_is_that_of_its_surface(seed):
    task = find("08.5").task(seed)
    part = int(re.search(r"v=\\tfrac\\pi\{(\d)\}", task.question)[1])
    waist = re.search(r"\\bar v=(\d)", task.question)[1]
    height = math.pi / part
    surface = RuledSurface(Bezier([[0, height], [2 * math.pi, height]]), "0", waist)
    assert task.judge(surface.pitch()).right


@pytest.mark.parametrize("seed", SEEDS)
def test_the_walk_is_that_of_its_surface(seed):
    task = find("08.6").task(seed)
    a, b, n = re.search(r"\\bar v=(\d)\+(\d)\\cos (\d?)t", task.question).groups()
    vbar = f"{a} + {b}*cos({n or 1}*u)"
    line = Bezier([[0, math.pi / 2], [2 * math.pi, math.pi / 2]])
    surface = RuledSurface(line, "0", vbar)
    walk = path_of(surface, 0.0).walk
    x, c = surface.line(walk.t).direction, surface.foot(walk.t)
    along = ((walk.points - c) * x).sum(axis=1)
    t = 2 * math.pi * walk.t
    expected = eval(task.answer, {"t": t, "sin": np.sin})
    assert along - along[0] == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_line_beside_the_frame_by_its_own_surface(seed):
    task = find("08.11").task(seed)
    off = int(re.search(r"\(0, (\d), 0\)", task.starter)[1])
    line = Line.from_point_direction((0, off, 0), (0, 0, 1))
    assert task.judge(carried(gallery.surface("example_2"), line).pitch()).right


def test_no_pitch_is_not_to_be_had_by_a_small_loop():
    task = find("08.4").task("a")
    (slip,) = task.slips
    assert task.judge(slip.example).slip == "pitch made small with the loop"
    eight = [[1, 2], [1, 3], [3, 1], [3, 2], [3, 3], [1, 1], [1, 2]]
    points = tuple((math.pi / 8 * u, math.pi / 8 * v) for u, v in eight)
    said = task.judge(task.start.with_(points=points))
    assert not said.right and "still off by" in said.word


def test_the_small_loop_of_the_first_question_may_be_drawn():
    """λ = A − 2π, from a real loop: a small circle closed with C² away from the poles."""
    angle = 2 * np.pi * np.arange(9) / 9
    ring = np.column_stack([1 + 0.2 * np.cos(angle), 1.5 - 0.2 * np.sin(angle)])
    surface = RuledSurface(Bezier(close(np.vstack([ring, ring[:1]]), 2)), "0", "0")
    area = -enclosed(surface).area
    assert area > 0  # v grows downwards: this runs anticlockwise, seen from outside
    assert surface.angle_of_pitch() == pytest.approx(area - 2 * math.pi, abs=1e-8)


def test_backwards_changes_both_signs():
    surface = gallery.surface("orchid")
    back = RuledSurface(Bezier(surface.curve.points[::-1]), surface.ubar, surface.vbar)
    there, again = surface.dual_angle_of_pitch(), back.dual_angle_of_pitch()
    assert (again.real, again.dual) == pytest.approx((-there.real, -there.dual), abs=1e-9)


def test_seam_html_needs_no_widget():
    lab = SimpleNamespace(result=SimpleNamespace(closure=gallery.surface("crown").closure()))
    assert "closes with C²" in seam_html(lab)
