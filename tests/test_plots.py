"""The plots over t: limits that stay, ticks, what the browser is sent, the exported figure."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import threading
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")

from ruledlab.lab.axes import (
    Limits,
    angle_limits,
    angle_ticks,
    bulk,
    nice_limits,
    number_ticks,
    parameter_ticks,
    peaks,
    roomy_limits,
    sticky_limits,
    undefined_ranges,
)
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.plots import QUANTITIES, CurvePlots

NAN = math.nan
T = np.linspace(0.0, 1.0, 401)


@dataclass
class Drawn:
    """The part of a scene that plots read."""

    curves: dict[str, Any]
    t: Any = field(default_factory=lambda: T)
    gaps: tuple[str, ...] = ()


def smooth(size: float = 1.0) -> Drawn:
    curves = {
        "kappa": 1 + 0.5 * np.sin(7 * T) ** 2,
        "kappa_bar": size * np.cos(6 * T),
        "tau": size * np.sin(5 * T) - 0.3,
        "tau_bar": size * T * (1 - T),
        "sigma": 9 * T - 1,
        "delta": size * np.cos(6 * T) / 2,
    }
    return Drawn(curves)


def mark(t: float, **values: float) -> Any:
    return SimpleNamespace(t=t, values=values)


def sent_curves(plots: CurvePlots) -> tuple[np.ndarray, np.ndarray]:
    across = np.frombuffer(plots.widget.across, np.float32)
    rows = len(plots.widget.frame["axes"])
    return across, np.frombuffer(plots.widget.curves, np.float32).reshape(rows, across.size)


def messages(plots: CurvePlots) -> list[dict[str, Any]]:
    """From now on, every state sent to the browser, in a list that grows."""
    sent: list[dict[str, Any]] = []
    send = plots.widget.send_state

    def spy(key: Any = None) -> None:
        names = {key} if isinstance(key, str) else set(key)
        if names:  # an empty state is not sent
            sent.append({name: getattr(plots.widget, name) for name in names})
        send(key)

    plots.widget.send_state = spy
    return sent


@pytest.fixture
def plots():
    made = CurvePlots()
    yield made
    made.close()


# ------------------------------------------------------------------------------------- limits

sizes = st.floats(-1e12, 1e12, allow_nan=False).map(lambda x: x if abs(x) > 1e-9 else 0.0)
ranges = st.tuples(sizes, sizes).map(sorted)
wide_ranges = ranges.filter(lambda r: r[1] - r[0] > 1e-6 * max(map(abs, r)))
angles = st.tuples(st.floats(-200, 200), st.floats(-200, 200)).map(sorted)
arrays = st.lists(st.one_of(sizes, st.just(NAN), st.sampled_from([math.inf, -math.inf])),
                  max_size=60).map(np.array)  # fmt: skip
curve_pairs = st.tuples(arrays, arrays, st.booleans())


@given(ranges)
def test_nice_limits_contain_the_range_and_are_finite(ends):
    limits = nice_limits(*ends)
    assert math.isfinite(limits.low) and math.isfinite(limits.high) and limits.low < limits.high
    assert limits.hold(*ends)


@given(wide_ranges)
def test_nice_limits_waste_little(ends):
    low, high = ends
    assert nice_limits(*ends).span <= 1.4 * (high - low)


@given(wide_ranges, st.floats(0, 3), st.floats(0, 3))
def test_nice_limits_are_monotone(ends, more_below, more_above):
    low, high = ends
    inner, outer = nice_limits(low, high), nice_limits(
        low - more_below * (high - low), high + more_above * (high - low)
    )  # fmt: skip
    slack = 1e-9 * outer.span + 1e-12 * max(abs(outer.low), abs(outer.high))
    assert outer.low <= inner.low + slack
    assert outer.high >= inner.high - slack


@given(angles)
def test_angle_limits_are_multiples_of_a_quarter_turn_around_the_range(ends):
    limits = angle_limits(*ends)
    assert limits.hold(*ends)
    for end in (limits.low, limits.high):
        assert end / (math.pi / 2) == pytest.approx(round(end / (math.pi / 2)), abs=1e-9)


@given(curve_pairs)
def test_sticky_limits_hold_the_bulk_and_settle_at_once(pair):
    before, after, angle = pair
    present = sticky_limits(before, angle=angle)
    limits = sticky_limits(after, present, angle=angle)
    shown = bulk(after)
    assert shown is None or limits.hold(*shown)
    assert math.isfinite(limits.low) and limits.low < limits.high < math.inf
    assert sticky_limits(after, limits, angle=angle) == limits


def test_limits_stay_while_the_curve_fits_and_change_when_it_does_not():
    wave = np.sin(6 * T)
    limits = sticky_limits(wave)
    assert sticky_limits(0.9 * wave, limits) is limits
    assert sticky_limits(0.5 * wave, limits) is limits
    assert sticky_limits(0.2 * wave, limits).span < 0.4 * limits.span
    assert sticky_limits(1.5 * wave, limits).hold(-1.49, 1.49)


@pytest.mark.parametrize("noise", [0.0, 2e-16, 1e-12])
def test_a_constant_is_seen_against_zero_whatever_its_rounding_noise(noise):
    wobble = noise * np.sin(300 * T)
    one = sticky_limits(1 + wobble)
    assert (one.low, one.high) == pytest.approx((0, 2))
    minus = sticky_limits(-3 + wobble)
    assert (minus.low, minus.high) == pytest.approx((-6, 0))
    assert sticky_limits(1e-17 * np.sin(300 * T)) == Limits(-1.0, 1.0)


def test_a_narrow_spike_does_not_flatten_the_rest():
    spike = np.sin(6 * T) + 1e5 / (1 + ((T - 0.43) / 1e-5) ** 2)
    limits = sticky_limits(spike)
    assert limits.hold(-1, 1) and limits.span < 10
    assert sticky_limits(-spike).hold(-1, 1) and sticky_limits(-spike).span < 10


def test_a_constant_with_a_spike_keeps_its_own_scale_and_a_zero_with_one_shows_it():
    peak = np.where(np.abs(T - 0.5) < 0.004, 1.0, 0.0)
    assert sticky_limits(2 + 1e5 * peak).span < 10
    assert sticky_limits(1e5 * peak).hold(0, 1e5)  # a zero line has no scale to keep


def test_an_ordinary_hump_is_shown_whole():
    hump = np.exp(-(((T - 0.5) / 0.1) ** 2))
    assert sticky_limits(hump).hold(0, 1)


@given(st.floats(1e-6, 1e6), st.floats(0.5, 1.5))
def test_a_length_that_changes_keeps_its_axis_while_it_fills_most_of_it(end, factor):
    first = roomy_limits(end)
    assert first.low == 0.0 < end < first.high < 1.2 * end
    again = roomy_limits(factor * end, first)
    assert factor * end <= again.high < 1.26 * factor * end
    if 0.8 * first.high <= factor * end <= first.high:
        assert again == first


def test_over_a_length_only_what_changed_is_typeset_again(plots):
    scene = smooth()
    plots.draw(replace(scene, t=4.0 * scene.t), mark(0.5), over="s")
    axes = plots.widget.strips
    plots.draw(replace(scene, t=4.1 * scene.t), mark(0.5), over="s")
    assert plots.widget.strips == axes
    assert plots.widget.summary.startswith("Plots over s from 0 to 4.1:")
    plots.draw(replace(scene, t=6.0 * scene.t), mark(0.5), over="s")
    assert plots.widget.strips != axes


def test_limits_of_a_curve_without_values():
    nothing = np.full(5, NAN)
    assert bulk(nothing) is None and bulk(np.array([])) is None
    kept = Limits(-3.0, 4.0)
    assert sticky_limits(nothing, kept) is kept
    assert sticky_limits(nothing).span > 0
    assert sticky_limits(nothing, angle=True).high == pytest.approx(math.pi)


# -------------------------------------------------------------------------------------- ticks


@given(ranges, st.integers(2, 12))
def test_number_ticks_are_few_and_inside(ends, most):
    limits = nice_limits(*ends)
    ticks = number_ticks(limits, most)
    assert 1 <= len(ticks) <= most + 1
    assert all(limits.low - 1e-6 * limits.span <= at <= limits.high + 1e-6 * limits.span
               for at, _ in ticks)  # fmt: skip
    assert len({text for _, text in ticks}) == len(ticks), "two ticks with the same text"


@given(wide_ranges)
def test_plain_tick_texts_say_where_the_tick_is(ends):
    limits = nice_limits(*ends)
    ticks = number_ticks(limits, 5)
    step = ticks[1][0] - ticks[0][0] if len(ticks) > 1 else limits.span
    for at, text in ticks:
        if re.fullmatch(r"−?[\d.]+", text):
            assert float(text.replace("−", "-")) == pytest.approx(at, abs=0.01 * step)


def test_tick_texts_by_hand():
    assert [text for _, text in number_ticks(Limits(-1, 1), 5)] == [
        "−1.0", "−0.5", "0.0", "0.5", "1.0"]  # fmt: skip
    assert [text for _, text in number_ticks(Limits(0, 3e5), 3)] == [
        "0", "1·10⁵", "2·10⁵", "3·10⁵"]  # fmt: skip
    assert [text for _, text in number_ticks(Limits(1 - 1e-6, 1 + 1e-6), 2)] == [
        "−1·10⁻⁶", "1", "+1·10⁻⁶"]  # fmt: skip


def test_angles_are_fractions_of_pi():
    assert [text for _, text in angle_ticks(Limits(-math.pi / 2, 1.5 * math.pi), 5)] == [
        "−π/2", "0", "π/2", "π", "3π/2"]  # fmt: skip
    long = angle_ticks(Limits(0, 20 * math.pi), 5)
    assert [text for _, text in long] == ["0", "4π", "8π", "12π", "16π", "20π"]


# ------------------------------------------------------------ gaps and what leaves the frame


def test_undefined_ranges_reach_half_way_to_the_neighbours():
    t = np.arange(6.0)
    values = np.array([NAN, 1, NAN, NAN, 2, math.inf])
    assert undefined_ranges(t, values) == [(0.0, 0.5), (1.5, 3.5), (4.5, 5.0)]
    assert undefined_ranges(t, np.ones(6)) == []


def test_peaks_are_found_on_both_sides_farthest_first():
    t = np.arange(8.0)
    values = np.array([0, 5, 9, NAN, 4, 0, -20, 0])
    assert peaks(t, values, Limits(-1.0, 3.0)) == [(6.0, -20.0), (2.0, 9.0), (4.0, 4.0)]
    assert peaks(t, np.full(8, NAN), Limits(0.0, 1.0)) == []


def test_a_peak_is_marked_with_its_size_and_place(plots):
    tau = np.sin(6 * T) + np.where(np.arange(T.size) == 172, 1.2e5, 0)
    plots.draw(Drawn({**smooth().curves, "tau": tau}))
    kappa, note, _ = plots.widget.notes
    assert "peaks" not in kappa
    assert note["texts"] == ["peak 1.2·10⁵ at t = 0.43", "1.2·10⁵"]
    across, _ = sent_curves(plots)
    assert note["peaks"] == [[pytest.approx(float(across[172]), abs=0.06), True]]


# --------------------------------------------------------------------------------- what is sent


def test_curves_are_placed_where_the_typeset_axes_say(plots):
    """A second route: the tick label and grid line positions inside the SVG itself."""
    t = np.linspace(0.0, 1.0, 6)  # 0.2 apart: a grid line at each
    plots.draw(Drawn({"kappa": np.array([-1.0, -0.5, 0, 0.5, 1.0, 1.0])}, t=t))
    plots.choose(["kappa"])
    across, (down,) = sent_curves(plots)
    paths = re.findall(r'd="M ([\d.]+) ([\d.]+) L ([\d.]+) ([\d.]+)', plots.widget.strips[0])
    segments = [tuple(map(float, path)) for path in paths]
    vertical = sorted({x for x, _, x2, _ in segments if x == x2})
    horizontal = sorted({y for x, y, x2, y2 in segments if y == y2 and x != x2})
    assert np.abs(np.subtract.outer(across, vertical)).min(axis=1).max() < 0.01
    assert np.abs(np.subtract.outer(down, horizontal)).min(axis=1).max() < 0.01


def test_undefined_values_are_gaps_in_y_only(plots):
    sigma = np.where((T > 0.4) & (T < 0.6), NAN, T)
    plots.draw(Drawn({**smooth().curves, "sigma": sigma, "kappa": sigma}))
    across, down = sent_curves(plots)
    assert np.isfinite(across).all()
    assert (np.isnan(down[2]) == np.isnan(sigma)).all()
    assert np.isfinite(down[1]).all()


def test_one_move_is_one_small_message(plots):
    plots.draw(smooth(), mark(0.3, kappa=1.0, tau=0.2, sigma=1.0))
    sent = messages(plots)
    plots.draw(smooth(0.99), mark(0.3, kappa=1.0, tau=0.21, sigma=1.0))
    assert len(sent) == 1
    assert not {"strips", "frame", "across"} & set(sent[0]), "the axes did not change"
    assert len(sent[0]["curves"]) == 3 * 401 * 4
    assert len(str({k: v for k, v in sent[0].items() if k != "curves"})) < 1500


def test_a_cursor_move_sends_the_cursor_only(plots):
    plots.draw(smooth())
    sent = messages(plots)
    plots.draw_cursor(mark(0.3, kappa=1.25, tau=NAN, sigma=math.pi / 2))
    assert [set(message) for message in sent] == [{"cursor"}]
    cursor = sent[0]["cursor"]
    assert cursor["label"] == "t = 0.300"
    assert cursor["values"] == ["1.2500", "undefined", "0.500π"]
    assert cursor["y"][1] is None and cursor["y"][0] is not None
    assert cursor["spoken"] == "t = 0.3, kappa 1.25, tau undefined, sigma 1.571"


def test_the_same_scene_again_sends_nothing(plots):
    plots.draw(smooth())
    sent = messages(plots)
    plots.draw(smooth())
    assert sent == []


def test_only_the_axis_whose_limits_changed_is_typeset_again(plots):
    plots.draw(smooth())
    before = list(plots.widget.strips)
    plots.draw(smooth(10.0))
    same = [a == b for a, b in zip(before, plots.widget.strips, strict=True)]
    assert same == [True, False, True]


def test_decimals_of_the_value_at_the_cursor_do_not_depend_on_it(plots):
    plots.draw(smooth())
    texts = []
    for value in np.linspace(-1.2, 0.7, 50):
        plots.draw_cursor(mark(0.5, tau=float(value)))
        texts.append(plots.widget.cursor["values"][1])
    assert {len(text.lstrip("−")) for text in texts} == {len("0.123")}
    plots.draw_cursor(mark(0.5, tau=-1e-9))
    assert plots.widget.cursor["values"][1] == "0.000"


def test_the_value_at_the_cursor_keeps_out_of_the_way_of_the_curve(plots):
    plots.draw(Drawn({"kappa": T, "tau": -T, "sigma": np.full_like(T, 1.0)}))
    assert [note["below"] for note in plots.widget.notes] == [True, False, False]


def test_everything_can_be_undefined(plots):
    plots.draw(Drawn({"kappa": np.full_like(T, NAN)}, gaps=("the curve stands still",)))
    assert plots.widget.notes[0]["empty"] == "undefined for every t"
    assert "kappa: undefined for every t" in plots.widget.summary
    assert plots.widget.reasons == "the curve stands still"
    plots.draw_cursor(mark(0.5))
    assert plots.widget.cursor["y"] == [None, None, None]


@pytest.mark.parametrize("t", [np.array([0.25]), np.array([])])
def test_a_scene_of_one_sample_or_none(plots, t):
    plots.draw(Drawn({"kappa": np.ones_like(t)}, t=t))
    across, down = sent_curves(plots)
    assert across.size == t.size and down.shape == (3, t.size)
    assert plots.export("svg")


def test_enormous_and_infinite_values_stay_drawable(plots):
    wild = np.where(T < 0.5, 1e300, np.where(T < 0.6, math.inf, np.sin(6 * T)))
    plots.draw(Drawn({"tau": wild}), mark(0.2, tau=1e300))
    _, down = sent_curves(plots)
    finite = down[np.isfinite(down)]
    assert np.abs(finite).max() < 1e4
    assert plots.widget.cursor["values"][1] == "1·10³⁰⁰"


def test_t_between_multiples_of_pi_is_ticked_in_pi():
    assert [text for _, text in parameter_ticks(Limits(0, 2 * math.pi), 4)] == [
        "0", "π/2", "π", "3π/2", "2π"]  # fmt: skip
    assert [text for _, text in parameter_ticks(Limits(0, 1), 5)] == [
        "0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]  # fmt: skip


def test_the_words_give_extremes_places_and_reasons(plots):
    kappa = 1 + 4 * T * (1 - T)
    scene = Drawn({"kappa": kappa, "tau": np.full_like(T, 0.5)}, gaps=("σ has no value at t = 0",))
    plots.draw(scene)
    words = plots.widget.summary
    assert words.startswith("Plots over t from 0 to 1:")
    assert "kappa from 1 at t = 0 to 2 at t = 0.5" in words
    assert "tau is constant, 0.5" in words
    assert words.endswith("σ has no value at t = 0")


# ------------------------------------------------------------------- choosing, themes, sizes


def test_another_parameter_has_its_letter_wherever_t_would_stand(plots):
    scene = smooth()
    plots.draw(scene, mark(0.5, kappa=1.0), over="t")
    over_t = plots.widget.strips, plots.widget.summary, plots.widget.cursor
    plots.draw(scene, mark(0.5, kappa=1.0), over="s")
    assert "s = " in plots.widget.summary
    assert "t = " not in plots.widget.summary
    assert plots.widget.cursor["label"].startswith("s = ")
    assert plots.widget.cursor["spoken"].startswith("s = ")
    assert [a != b for a, b in zip(plots.widget.strips, over_t[0], strict=True)] == [
        QUANTITIES[name].rate or name == plots.names[-1] for name in plots.names
    ]  # the unit of a rate, the letter below the last; the rest is not sent again
    plots.draw(scene, mark(0.5, kappa=1.0))
    assert (plots.widget.strips, plots.widget.summary, plots.widget.cursor) == over_t


def test_choose_all_in_any_order(plots):
    plots.draw(smooth())
    plots.choose(reversed(QUANTITIES))
    assert plots.names == tuple(reversed(QUANTITIES))
    assert len(plots.widget.strips) == len(plots.widget.frame["axes"]) == 6
    assert [axis["dashed"] for axis in plots.widget.frame["axes"]] == [
        name.endswith("_bar") for name in plots.names]  # fmt: skip
    heights = [float(ElementTree.fromstring(svg).get("height")) for svg in plots.widget.strips]
    assert sum(heights) == plots.widget.frame["height"]


@pytest.mark.parametrize("names", [[], ["kappa", "kappa"], ["curvature"]])
def test_choose_refuses_what_it_does_not_know(plots, names):
    with pytest.raises(ValueError, match="`names` must be"):
        plots.choose(names)
    assert plots.names == ("kappa", "tau", "sigma")


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_colours_come_from_the_theme(plots, theme):
    plots.draw(smooth())
    plots.set_theme(theme)
    assert [axis["colour"] for axis in plots.widget.frame["axes"]] == [
        theme.kappa, theme.tau, theme.sigma]  # fmt: skip
    assert plots.widget.frame["colours"]["paper"] == theme.paper
    assert theme.kappa in plots.widget.strips[0] and theme.grid in plots.widget.strips[0]


@pytest.mark.parametrize(("asked", "given"), [(1, 280), (320, 320), (1000, 1000), (5000, 1200)])
def test_width_follows_the_browser_within_reason(plots, asked, given):
    plots.draw(smooth())
    plots.widget.set_state({"width": asked})
    assert plots.widget.frame["width"] == given
    across, _ = sent_curves(plots)
    frame = plots.widget.frame
    assert across[[0, -1]] == pytest.approx([frame["left"], frame["right"]])


# ------------------------------------------------------------------------------------ picking


def test_picks_reach_every_callback_until_it_disconnects(plots):
    plots.draw(smooth())
    first, second = [], []
    end = plots.on_pick(first.append)
    plots.on_pick(second.append)
    plots.widget.set_state({"picked": [1, 0.25]})
    plots.widget.set_state({"picked": [2, 0.25]})  # the same t again is a pick again
    end()
    end()
    plots.widget.set_state({"picked": [3, 7.0]})
    assert first == [0.25, 0.25]
    assert second == [0.25, 0.25, 1.0], "beyond the end is the end"


@pytest.mark.parametrize("junk", [[], [1], [1, None], [1, "0.5"], [1, NAN], [1, math.inf]])
def test_junk_from_the_browser_is_no_pick(plots, junk):
    plots.draw(smooth())
    picked = []
    plots.on_pick(picked.append)
    plots.widget.set_state({"picked": junk})
    assert picked == []


def test_a_callback_may_draw(plots):
    plots.draw(smooth())
    plots.on_pick(lambda t: plots.draw_cursor(mark(t, kappa=1.0)))
    plots.widget.set_state({"picked": [1, 0.5]})
    assert plots.widget.cursor["t"] == 0.5


def test_close_leaves_nothing_connected():
    plots = CurvePlots()
    plots.draw(smooth())
    picked = []
    plots.on_pick(picked.append)
    plots.close()
    plots.widget.picked = [1, 0.5]
    plots.widget.width = 500
    assert picked == [] and plots.widget.comm is None


def test_two_plots_drawn_from_threads_at_once_do_not_mix():
    """The picture each ends with is the one it would have drawn alone."""
    together = [CurvePlots(), CurvePlots(theme=DARK)]
    failures = []

    def work(plots: CurvePlots, size: float) -> None:
        try:
            for k in range(6):
                plots.draw(smooth(size * 4**k))
        except Exception as error:
            failures.append(error)

    threads = [
        threading.Thread(target=work, args=(p, s)) for p, s in zip(together, (1, 3), strict=True)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    for plots, size in zip(together, (1, 3), strict=True):
        alone = CurvePlots(theme=plots._theme)
        for k in range(6):
            alone.draw(smooth(size * 4**k))
        assert plots.widget.curves == alone.widget.curves
        assert plots.widget.frame == alone.widget.frame
        alone.close()
        plots.close()


# ------------------------------------------------------------------------------------- export


def test_png_is_a_picture_twice_as_wide_as_asked(plots):
    plots.draw(smooth())
    png = plots.export("png", width=500)
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    assert int.from_bytes(png[16:20], "big") == 1000


def test_svg_is_complete_light_and_has_one_curve_per_quantity():
    plots = CurvePlots(QUANTITIES, theme=DARK)
    plots.draw(smooth())
    root = ElementTree.fromstring(plots.export("svg"))
    styles = [path.get("style", "") for path in root.iter("{http://www.w3.org/2000/svg}path")]
    thick = [style for style in styles if "stroke-width: 2" in style]
    assert len(thick) == 6
    for name in QUANTITIES:
        assert any(LIGHT.quantity(name) in style for style in thick)
    assert sum("stroke-dasharray" in style for style in thick) == 2
    plots.close()


def test_export_shows_gaps_peaks_and_any_reason_text(plots):
    tau = np.sin(6 * T) + np.where(np.arange(T.size) == 300, -1e6, 0)
    sigma = np.where(T > 0.8, NAN, T)
    plots.draw(Drawn({"kappa": np.full_like(T, NAN), "tau": tau, "sigma": sigma},
                     gaps=("a reason with $ and \\frac in it, $unfinished " * 4,)))  # fmt: skip
    plain = CurvePlots()
    plain.draw(smooth())
    assert len(plots.export("svg")) > 0 and len(plots.export("png")) > 0
    height = [float(ElementTree.fromstring(p.export("svg")).get("height").removesuffix("pt"))
              for p in (plots, plain)]  # fmt: skip
    assert height[0] > height[1], "room for the reasons"
    plain.close()


def test_export_refuses_other_formats(plots):
    with pytest.raises(ValueError, match="`format` must be 'png' or 'svg'; got 'gif'"):
        plots.export("gif")


def test_pyplot_is_not_imported_and_settings_of_the_reader_are_left_alone():
    code = (
        "import sys, matplotlib\n"
        "def settings():\n"  # asking for the backend would import pyplot
        "    return {k: matplotlib.rcParams[k] for k in matplotlib.rcParams if k != 'backend'}\n"
        "matplotlib.rcParams['text.usetex'] = True\n"
        "before = settings()\n"
        "from ruledlab.lab.plots import CurvePlots\n"
        "p = CurvePlots(); p.choose(['kappa', 'sigma']); p.export('svg'); p.export('png')\n"
        "assert settings() == before\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
