"""Lesson 12: printed and mended side by side: the pictures, the app, and what the lesson claims."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab import Bezier, RuledSurface
from ruledlab.design import Design
from ruledlab.exercises import exercise
from ruledlab.exercises.core import Choose, FindSlip, Formula, Number, find
from ruledlab.exercises.lesson_12 import EVEN, UNEVEN
from ruledlab.exercises.store import Store
from ruledlab.geometry import GeometryError, gallery
from ruledlab.lab import printed_and_mended
from ruledlab.lab.axes import Limits
from ruledlab.lab.controls import design_of
from ruledlab.lab.scenes import comparison
from ruledlab.lab.scenes.comparison import NAMES, Comparison, at_poles, compare, picture
from ruledlab.printed import PRINTED, finding

T = np.linspace(0.0, 1.0, 5)
KEYS = [entry.key for entry in PRINTED]
EX2 = gallery.surface("example_2")


@pytest.fixture
def app() -> Iterator[object]:
    app = printed_and_mended()
    yield app
    defects = [group.defect.value for group in app._groups if group.defect.value]
    app.close()
    assert defects == []


def svg(html: str) -> ElementTree.Element:
    """The picture as XML; it must be well-formed."""
    return ElementTree.fromstring(html[html.index("<svg") :].replace("&emsp;", " "))


def design(key: str) -> Design:
    return design_of(gallery.example(key))


# -- what is compared ------------------------------------------------------------------------------


def test_every_finding_has_its_symbols_and_units() -> None:
    assert list(NAMES) == KEYS
    for entry in PRINTED:
        t = {"t": (T,), "t, w": (T, 0.5), "surface": ()}[entry.over]
        value = np.asarray(entry.printed(gallery.surface(entry.design), *t))
        over = 0 if entry.over == "surface" else 1
        assert len(NAMES[entry.key]) == (value.shape[over] if value.ndim > over else 1)


def test_titles_are_short_and_numbered() -> None:
    titles = [comparison.title(entry) for entry in PRINTED]
    assert [int(title.partition(".")[0]) for title in titles] == list(range(1, 22))
    assert max(map(len, titles)) < 90


def test_a_finding_about_one_example_looks_at_that_example() -> None:
    entry = finding("example_1_kappa_bar")
    assert compare(entry, EX2).difference[100] == pytest.approx(1 / np.sqrt(1 + np.sin(0.5) ** 2))


def test_the_largest_difference_is_found_where_it_is() -> None:
    made = compare(finding("tau"), EX2)
    t = np.linspace(0, 1, 4001)
    (_u, v), (du, dv), (_, ddv) = EX2.curve.series(t, 2).derivatives()
    off = 2 * np.sin(v) * du * ddv / (du**2 * np.sin(v) ** 2 + dv**2)
    np.testing.assert_allclose(made.difference, off[::20], atol=1e-9)
    assert abs(made.t[made.largest] - t[np.argmax(np.abs(off))]) <= 0.005


def test_no_value_is_told_with_the_reason() -> None:
    made = compare(finding("example_1_tau_bar"), EX2)
    assert np.isnan(made.mended[0])
    assert "t = 0: the curve meets a pole" in made.reasons[0]
    cot = compare(finding("cot_sigma_0"), EX2)
    assert cot.reasons == ("cot σ(0) as printed has no value here: a denominator is 0.",)
    assert cot.largest is None
    assert "no value of both" in comparison.in_words(finding("cot_sigma_0"), cot)


def test_what_is_constant_is_told_so() -> None:
    entry = finding("mean_curvature")
    made = compare(entry, gallery.surface("hyperboloid"), 0.0)
    assert made.largest == 0
    assert "as printed 0.7749 throughout, mended 0 throughout" in comparison.in_words(entry, made)


def test_the_cursor_is_taken_at_its_foot(app) -> None:
    (foot,) = app.foot.picture["handles"]
    tree = svg(app.picture.value)
    (line, *_) = (n.get("d") for n in tree.iter() if n.get("class") == "is-cursor")
    x, bottom = re.fullmatch(r"M([\d.]+),[\d.]+V([\d.]+)", line).groups()
    assert (foot["x"], foot["y"]) == pytest.approx((float(x), float(bottom)), abs=0.06)
    assert tree.get("viewBox") == "0 0 {:.0f} {:.0f}".format(*app.foot.picture["size"])
    per_t = comparison.WIDTH - comparison.LEFT - comparison.RIGHT
    app.foot.motion = ["view", 1, 0, foot["x"] + 0.3 * per_t, -70.0]
    assert app.lab.cursor == pytest.approx(0.55, abs=2e-4)
    assert len(app.time.t.field.value) <= 6
    app.foot.motion = ["view", 1, 0, 5000.0, 0.0]
    assert app.lab.cursor == 1.0
    app.chooser.menu.value = "pitch_24"  # one number for the whole surface
    assert app.foot.picture["handles"] == []
    app.chooser.menu.value = "tau"
    assert len(app.foot.picture["handles"]) == 1


def test_where_both_agree_no_place_is_farthest_apart(app) -> None:
    app.chooser.menu.value = "tau_bar"
    assert "farthest apart" in app.numbers.value
    app.lab.load(design("hyperboloid"), "test")
    assert app.comparison.agree
    assert "at t = 0.25" in app.numbers.value
    assert "farthest apart" not in app.numbers.value


def test_agreement_is_told() -> None:
    made = compare(finding("tau_bar"), gallery.surface("hyperboloid"))
    assert "agree on this design" in comparison.in_words(finding("tau_bar"), made)


# -- the picture -----------------------------------------------------------------------------------

LINES = Comparison(np.linspace(0, 1, 11), np.linspace(0, 10, 11), np.full(11, 4.0), (("y", "m"),))
BOXES = (Limits(0.0, 10.0), Limits(-5.0, 10.0))


def paths(root: ElementTree.Element, kind: str) -> list[str]:
    return [path.get("d") for path in root.iter("path") if path.get("class") == kind]


def test_the_curves_stand_where_the_ticks_say() -> None:
    root = svg(picture(LINES, BOXES, 0.35, "in words"))
    assert (root.get("role"), root.get("aria-label")) == ("img", "in words")
    grid = [float(re.search(r",([\d.]+)H", d)[1]) for d in paths(root, "is-grid")]
    ticks = [t for t in root.iter("text") if t.get("text-anchor") == "end" and t.text[-1].isdigit()]
    scale = {t.text: y for t, y in zip(ticks, grid, strict=True) if y < 230}  # the upper frame
    (frame, below) = root.findall("svg")
    top = float(frame.get("y"))
    (printed,) = (path.get("d") for path in frame.iter("path") if path.get("class") == "is-printed")
    points = np.array(re.findall(r"([\d.]+),([-\d.]+)", printed), dtype=float)
    assert points[0, 1] + top == pytest.approx(scale["0"], abs=0.1)
    assert points[-1, 1] + top == pytest.approx(scale["10"], abs=0.1)
    dots = {dot.get("class"): float(dot.get("cy")) for dot in frame.iter("circle")}
    assert dots["is-printed"] == pytest.approx(points[3:5, 1].mean(), abs=0.1)  # t = 0.35
    assert dots["is-mended"] + top == pytest.approx(0.6 * scale["0"] + 0.4 * scale["10"], abs=0.1)
    assert [dot.get("class") for dot in below.iter("circle")] == ["is-off"]


def test_a_range_without_value_is_a_gap_with_a_shade() -> None:
    holed = np.where(np.arange(11) == 5, np.nan, LINES.printed)
    made = Comparison(LINES.t, holed, LINES.mended, LINES.names)
    root = svg(picture(made, BOXES, 0.5, ""))
    (printed,) = paths(root, "is-printed")[1:]  # the first is the legend's
    assert printed.count("M") == 2
    assert "nan" not in ElementTree.tostring(root, encoding="unicode")
    assert [rect.get("class") for rect in root.iter("rect")] == ["is-none", "is-none"]


def test_a_pole_breaks_the_curve_and_is_told() -> None:
    t = np.linspace(0, 1, 11)
    made = Comparison(t, 1 / (t - 0.55), np.zeros(11), (("y", "m"),))
    limits = Limits(-15.0, 15.0)
    assert np.flatnonzero(at_poles(made.printed, limits)).tolist() == [5]
    (printed,) = paths(svg(picture(made, (limits, limits), 0.5, "")), "is-printed")[1:]
    assert printed.count("M") == 2
    (word,) = comparison.excursions(made, limits)
    assert "near t = 0.55" in word
    assert not list(comparison.excursions(made, Limits(-25.0, 25.0)))


def test_words_are_escaped() -> None:
    assert svg(picture(LINES, BOXES, 0.5, 'a "<b>" & c')).get("aria-label") == 'a "<b>" & c'


def test_the_colours_are_there_for_both_themes() -> None:
    style = picture(LINES, BOXES, 0.5, "").partition("</style>")[0]
    light, dark = style.split('body[data-jp-theme-light="false"]', 1)
    assert "#0072b2" in light
    assert "#56b4e9" in dark


# -- the app ---------------------------------------------------------------------------------------


def shown(app) -> tuple[str, ...]:
    return (app.picture.value, app.numbers.value, app.note.value)


@pytest.mark.parametrize("key", KEYS)
def test_every_finding_is_shown_in_picture_numbers_and_words(app, key: str) -> None:
    app.chooser.menu.value = key
    root = svg(app.picture.value)
    assert len(root.get("aria-label")) > 40
    assert app.numbers.value.count("<tr>") >= 2
    assert app.formulas.value.count("displaystyle") == 2
    entry = finding(key)
    assert (app.chooser.w.widget.layout.display is None) == (entry.over == "t, w")
    assert (app.time.widget.layout.display is None) == (entry.over != "surface")
    app.chooser.own.click()
    assert entry.only or app.lab.design == design(entry.design)


def test_the_numbers_are_those_of_the_cursor(app) -> None:
    app.time.t.field.value = "0.4"
    for value in (finding("tau").printed(EX2, 0.4), EX2.invariants(0.4).tau):
        assert comparison.said(float(value)) in app.numbers.value


def test_the_columns_are_printed_mended_and_their_difference(app) -> None:
    app.time.t.field.value = "0.4"
    printed, right = float(finding("tau").printed(EX2, 0.4)), float(EX2.invariants(0.4).tau)
    row = re.findall(r"<tr>(.*?)</tr>", app.numbers.value)[1]
    cells = re.findall(r"<td[^>]*>(.*?)</td>", row)
    numbers = [comparison.said(value) for value in (printed, right, printed - right)]
    assert cells[:4] == ["at t = 0.4", *numbers]


def test_each_frame_holds_what_it_shows(app) -> None:
    made = app.comparison
    above, below = app._axes
    for limits, curve in ((above, made.printed), (above, made.mended), (below, made.difference)):
        assert limits.low <= curve.min() < curve.max() <= limits.high + 1e-9
    assert below.low < above.low  # the difference reaches lower than both curves


def test_a_formula_and_the_meaning_of_its_letters_are_two_lines(app) -> None:
    app.chooser.menu.value = "cot_sigma_0"
    lines = re.findall(r"<p[^>]*>(.*?)</p>", app.formulas.value)
    assert "as printed" in lines[0]
    assert lines[1].startswith(r"with \((\Delta_u,")
    assert "mended" in lines[2]
    assert "qquad" not in app.formulas.value


def test_scalars_have_their_relative_error(app) -> None:
    app.chooser.menu.value = "tau_bar_0"
    right = EX2.invariants(0.0).tau_bar
    wrong = finding("tau_bar_0").printed(EX2)
    assert f"{100 * abs(wrong - right) / right:.3g} %" in app.numbers.value


def sliders(app):
    return {
        "u": app.points.u.slider,
        "v": app.points.v.slider,
        "t": app.time.t.slider,
        "w": app.chooser.w.slider,
    }


@pytest.mark.parametrize("name", ["u", "v", "t", "w"])
def test_a_slider_to_both_ends_and_back_gives_the_same(app, name: str) -> None:
    app.chooser.menu.value = "h11"
    app.chooser.menu.value = "mean_curvature"
    slider = sliders(app)[name]
    middle = slider.min + slider.step * round((slider.value - slider.min) / slider.step)
    slider.value = middle + slider.step
    slider.value = middle
    before, numbers = app.comparison, app.numbers.value
    for end in (slider.min, slider.max, middle):
        slider.value = end
        svg(app.picture.value)
    np.testing.assert_allclose(app.comparison.printed, before.printed, rtol=1e-11)
    np.testing.assert_allclose(app.comparison.mended, before.mended, rtol=1e-11)
    assert app.numbers.value == numbers


def test_w_and_the_coordinate_enter(app) -> None:
    app.chooser.menu.value = "h11"
    app.chooser.w.field.value = "0"
    expected = finding("h11").printed(EX2, app.comparison.t, 0.0)
    np.testing.assert_array_equal(app.comparison.printed, expected)
    app.chooser.menu.value = "x2bar_prime"
    app.chooser.axis.value = 2
    expected = finding("x2bar_prime").corrected(EX2, app.comparison.t)[:, 2]
    np.testing.assert_array_equal(app.comparison.mended, expected)
    app.chooser.menu.value = "tau"  # which has one coordinate only
    assert app.comparison.names == NAMES["tau"]


def test_what_cannot_be_read_is_told_beside_the_control(app) -> None:
    app.chooser.menu.value = "h11"
    before = shown(app)
    app.chooser.w.field.value = "1 +"
    assert "role" in app.chooser.w.error.value
    app.fields.rows["ubar"][0].value = "u +"
    assert app.fields.rows["ubar"][2].value
    assert shown(app) == before
    app.chooser.w.field.value = "0.5"
    assert app.chooser.w.error.value == ""


def test_an_integral_of_an_open_surface_says_why_not_and_comes_back(app) -> None:
    app.chooser.menu.value = "pitch_24"
    before = shown(app)
    app.gallery.menu.value = "example_1"
    assert (app.comparison, app.picture.value, app.numbers.value) == (None, "", "")
    assert "must close" in app.note.value
    app.history.undo.click()
    assert shown(app) == before
    app.history.redo.click()
    assert app.comparison is None
    app.history.reset.click()
    assert shown(app) == before


def test_the_chart_moves_the_curves(app) -> None:
    content = {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 3, "u": 1.5, "v": 1.1}
    before, picture = app.comparison.mended, app.picture.value
    app.pad._handle_custom_msg(content, [])
    assert app.lab.design.points[3] == (1.5, 1.1)
    assert app.picture.value != picture
    assert np.abs(app.comparison.mended - before).max() > 1.0
    app.history.undo.click()
    np.testing.assert_array_equal(app.comparison.mended, before)


def test_an_unknown_finding_is_refused() -> None:
    with pytest.raises(GeometryError, match="must be one of x2bar_prime"):
        printed_and_mended("nonsense")


def test_the_app_closes_without_a_trace() -> None:
    before = set(ipywidgets.widget._instances)
    app = printed_and_mended("h11", design("hyperboloid"))
    repr(app)  # a notebook asks for it
    app.close()
    assert set(ipywidgets.widget._instances) == before
    assert not app.lab._followers
    app.lab.load(design("hyperboloid"), "test")


# -- what the lesson claims ------------------------------------------------------------------------


def test_the_waist_of_the_hyperboloid() -> None:
    """Printed 1 − √2/c for u = ct, where the mean curvature is 0."""
    for c in (1.0, 2.0, 2 * np.pi):
        surface = RuledSurface(Bezier([[0, np.pi / 4], [c, np.pi / 4]]), 0, 1)
        h11, mean = finding("h11"), finding("mean_curvature")
        assert h11.corrected(surface, 0.3, 0.0) == pytest.approx(-(c**2))
        assert h11.printed(surface, 0.3, 0.0) == pytest.approx(-np.sqrt(2) * c)
        assert mean.corrected(surface, 0.3, 0.0) == pytest.approx(0.0, abs=1e-12)
        assert mean.printed(surface, 0.3, 0.0) == pytest.approx(1 - np.sqrt(2) / c)


def test_where_the_two_torsions_of_example_2_meet() -> None:
    made = compare(finding("tau"), EX2)
    assert np.flatnonzero(np.abs(made.difference) < 1e-9).tolist() == [0, 100, 200]


SEEDS = ("", "1", "2", "3", "Ada", "Σ")


@pytest.mark.parametrize("seed", SEEDS)
def test_the_waist_of_the_exercise(seed: str) -> None:
    task = find("12.4").task(seed)
    assert isinstance(task, Number)
    radius = int(re.search(r"r=(\d)", task.question)[1])
    over = int(re.search(r"\\tfrac\\pi(\d)", task.question)[1])
    surface = RuledSurface(Bezier([[0, np.pi / over], [1, np.pi / over]]), 0, radius)
    entry = finding("h11")
    pair = [float(f(surface, 0.3, 0.0)) for f in (entry.printed, entry.corrected)]
    np.testing.assert_allclose(task.answer, pair, rtol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_constant_of_the_exercise(seed: str) -> None:
    task = find("12.5").task(seed)
    assert isinstance(task, Formula)
    a, b = (int(x) for x in re.search(r"u=(\d)\(u-v\).*?v=(\d)\(u\+v\)", task.question).groups())
    surface = RuledSurface(Bezier([[0, 0], [1, 1]]), f"{a}*(u - v)", f"{b}*(u + v)")
    inv = surface.invariants(np.array([0.3, 0.7]))
    expected = [b * (t * np.sin(2 * t) + 2) for t in (0.3, 0.7)]
    np.testing.assert_allclose(inv.kappa * inv.kappa_bar, expected, rtol=1e-10)
    assert task.judge(f"{b}*(2*t*sin(t)*cos(t) + 2)").right


@pytest.mark.parametrize("seed", SEEDS)
def test_delta_at_the_start_of_the_exercise(seed: str) -> None:
    task = find("12.6").task(seed)
    assert isinstance(task, FindSlip)
    assert isinstance(task.then, Number)
    n, vbar = (int(re.search(p, task.question)[1]) for p in (r"n=(\d)", r"bar v=(\d)"))
    over = int(re.search(r"\\tfrac\\pi(\d)", task.question)[1])
    points = [[0, np.pi / over], [1, np.pi / over]] + [[i, 1.4] for i in range(2, n + 1)]
    surface, entry = RuledSurface(Bezier(points), 0, vbar), finding("delta_0")
    assert task.then.answer == pytest.approx(float(entry.corrected(surface)))
    slip = task.then.judge(float(entry.printed(surface)))
    assert slip.slip == "δ(0) as printed"


@pytest.mark.parametrize("seed", SEEDS)
def test_one_angle_of_pitch_is_within_reach(seed: str) -> None:
    """λ is ± the enclosed area modulo 2π, and the rectangle is all that can be enclosed."""
    task = find("12.11").task(seed)
    assert isinstance(task, Choose)
    across, *band = re.findall(r"\\tfrac(?:\\pi|\{(\d)\\pi\})(\d)", task.question)
    low, high = (int(top or 1) * np.pi / int(below) for top, below in band)
    area = np.pi / int(across[1]) * (np.cos(low) - np.cos(high))
    off = [(float(o.text.strip("$")) + np.pi) % (2 * np.pi) - np.pi for o in task.options]
    assert [abs(value) < area for value in off] == [o.right for o in task.options]
    assert sum(o.right for o in task.options) == 1
    assert min(abs(abs(value) - area) for value in off) > 0.05


TESTED = RuledSurface(Bezier([[0.2, 0.7], [1.0, 1.9], [1.9, 0.8], [2.4, 1.5]]), "u - v", "u + v")


def scaled(s: float) -> RuledSurface:
    return RuledSurface(TESTED.curve, f"{s}*(u - v)", f"{s}*(u + v)")


def test_only_one_test_catches_the_printed_delta() -> None:
    """Half of the curve and a new unit of length change both sides alike; the degree does not."""
    entry = finding("delta_0")

    def ratio(surface: RuledSurface) -> float:
        return float(entry.printed(surface) / entry.corrected(surface))

    half = RuledSurface(TESTED.curve.split(0.5)[0], "u - v", "u + v")
    raised = RuledSurface(TESTED.curve.raised(1), "u - v", "u + v")
    assert ratio(half) == pytest.approx(ratio(TESTED))
    assert ratio(scaled(3.0)) == pytest.approx(ratio(TESTED))
    assert ratio(raised) == pytest.approx(ratio(TESTED) * 4 / 3)


def test_only_one_test_catches_the_printed_torsion() -> None:
    entry = finding("tau")
    at = np.array([0.5])
    raised = RuledSurface(TESTED.curve.raised(2), "u - v", "u + v")
    np.testing.assert_allclose(entry.printed(raised, at), entry.printed(TESTED, at))
    np.testing.assert_allclose(entry.printed(scaled(3.0), at), entry.printed(TESTED, at))
    # the same straight path in the chart, evenly and unevenly: τ/κ belongs to the path alone
    places = np.linspace(0.0, 1.0, 3)[:, None] * [1.0, 1.0] + [0.2, 0.6]
    places[1] -= 0.2
    even, uneven = (
        RuledSurface(Bezier(p), 0, 0) for p in (np.array([places[0], places[2]]), places)
    )
    reached = float(uneven.curve.series(0.5, 0).value[0])
    pairs = []
    for surface, t in ((even, reached - 0.2), (uneven, 0.5)):
        kappa = surface.invariants(t).kappa
        pairs.append([float(f(surface, t) / kappa) for f in (entry.printed, entry.corrected)])
    assert pairs[0][1] == pytest.approx(pairs[1][1])
    assert abs(pairs[0][0] - pairs[1][0]) > 0.1


def test_the_printed_h11_has_no_weight_and_the_others_have() -> None:
    """With lengths times 3: h₁₁ and δ times 3; run through at half the speed: h₁₁ times 1/4."""
    entry, larger = finding("h11"), scaled(3.0)
    slower = RuledSurface(TESTED.curve.split(0.5)[0], "u - v", "u + v")
    for surface, t, w, factor in ((larger, 0.3, 1.5, 3.0), (slower, 0.6, 0.5, 0.25)):
        ratios = [
            float(f(surface, t, w) / f(TESTED, 0.3, 0.5)) for f in (entry.printed, entry.corrected)
        ]
        assert ratios[1] == pytest.approx(factor)
        assert abs(ratios[0] / factor - 1) > 0.01
    for where in (larger.curvature([0.3], [1.5]).gauss * 9, slower.curvature([0.6], [0.5]).gauss):
        np.testing.assert_allclose(where, TESTED.curvature([0.3], [0.5]).gauss, rtol=1e-9)


@pytest.mark.parametrize("number", range(1, 12))
def test_the_card_of_every_exercise_opens(number: int, tmp_path: Path) -> None:
    card = exercise(f"12.{number}", store=Store(tmp_path / "answers.json"))
    assert card.children
    card.close()


def test_even_steps_hide_the_slip_and_a_straight_path_does_not() -> None:
    entry = finding("tau")
    assert np.abs(entry.difference(EVEN.surface(), T)).max() < 1e-12
    assert np.abs(entry.difference(UNEVEN.surface(), T)).max() > 0.15
    assert find("12.9").task("").judge(UNEVEN).slip == "straight for evenly spaced"


def test_every_wrong_answer_of_the_choices_says_something_of_its_own() -> None:
    for key in ("12.2", "12.3", "12.7"):
        for seed in SEEDS:
            task = find(key).task(seed)
            assert isinstance(task, Choose)
            assert len({option.text for option in task.options}) == 4
    assert len({find("12.2").task(str(seed)).question for seed in range(12)}) == 3


@pytest.mark.parametrize("key", ["cone", "moebius", "tangent_developable", "example_1"])
def test_degenerate_surfaces_leave_gaps_and_no_warning(app, key: str) -> None:
    app.lab.load(design(key), "test")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for entry in PRINTED:
            app.chooser.menu.value = entry.key
            assert (app.comparison is None) == (app.picture.value == "")
            assert len(app.note.value) > 60
            if app.comparison is not None:
                assert svg(app.picture.value).get("aria-label")
