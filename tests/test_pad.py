"""The domain pad's Python half: what goes to the browser, and what may come from it."""

from __future__ import annotations

import json
import math
import re
import shutil
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("anywidget")

from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry import GeometryError
from ruledlab.lab.pad import DomainPad, PadRequest
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.signs import Signs

POINTS = np.array([[0.1, 0.2], [1.178, 0.785], [1 / 3, 2.0]])
CHART = np.stack([np.linspace(0.1, 1 / 3, 50), np.linspace(0.2, 2.0, 50)], axis=1)


def scene(points=POINTS, chart=CHART):
    return SimpleNamespace(control=points, chart=chart)


@pytest.fixture
def pad():
    pad = DomainPad()
    pad.draw(scene())
    yield pad
    pad.close()


@pytest.fixture
def heard(pad):
    requests = []
    pad.on_request(requests.append)
    return requests


@pytest.fixture
def sent(pad, monkeypatch):
    """Collect the states that go to the browser, one entry per message."""
    states = []
    monkeypatch.setattr(pad, "_send", lambda msg, buffers=None: states.append((msg, buffers)))
    return states


def message(pad, kind, seq, index=1, u=0.5, v=0.6, drag=0, view="a"):
    content = {"kind": kind, "view": view, "seq": seq, "drag": drag, "index": index, "u": u, "v": v}
    # Through JSON, as over the wire.
    pad._handle_custom_msg(json.loads(json.dumps(content)), [])


def motion(pad, seq, index=1, u=0.5, v=0.6, drag=1, view="a"):
    pad.set_state({"motion": json.loads(json.dumps([view, seq, drag, index, u, v]))})


# ---- Python → browser ----------------------------------------------------------------------------


def test_control_points_arrive_exactly_and_the_curve_as_float32(pad):
    points = np.frombuffer(pad.picture["points"], "<f8").reshape(-1, 2)
    curve = np.frombuffer(pad.picture["curve"], "<f4").reshape(-1, 2)
    assert np.array_equal(points, POINTS)
    assert np.array_equal(curve, CHART.astype(np.float32))


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("kind", [np.float32, np.float64, np.int64])
def test_any_memory_layout_and_number_type(pad, order, kind):
    points = np.asarray([[1, 2], [3, 4], [5, 6]], dtype=kind, order=order)
    pad.draw(scene(points, points[::-1]))
    assert np.frombuffer(pad.picture["points"], "<f8").tolist() == [1, 2, 3, 4, 5, 6]
    assert np.frombuffer(pad.picture["curve"], "<f4").tolist() == [5, 6, 3, 4, 1, 2]


def test_drawing_is_one_message_even_with_new_marks(pad, sent):
    pad.draw(scene(POINTS + 1), chosen=2, closing="C1")
    assert len(sent) == 1
    state = sent[0][0]["state"]
    assert set(state) == {"picture"}
    assert (state["picture"]["chosen"], state["picture"]["closing"]) == (2, "C1")


def test_a_picture_of_400_samples_takes_little_more_than_its_floats(pad, sent):
    chart = np.zeros((400, 2))
    pad.draw(scene(POINTS, chart))
    msg, buffers = sent[0]
    assert sum(len(b) for b in buffers) == 400 * 2 * 4 + 3 * 2 * 8
    assert len(json.dumps(msg)) < 400


def test_the_same_picture_is_not_sent_twice(pad, sent):
    pad.draw(scene())
    pad.draw(scene(POINTS.copy(), CHART.copy()))
    assert sent == []


def test_marks_can_be_set_without_drawing(pad, sent):
    pad.closing = "C2"
    pad.chosen = 1
    assert [s[0]["state"]["picture"]["closing"] for s in sent] == ["C2", "C2"]
    assert sent[-1][0]["state"]["picture"]["chosen"] == 1


def test_an_unknown_closing_is_refused(pad):
    with pytest.raises(Exception, match="closing"):
        pad.closing = "C3"


def test_cursor_is_shown_and_hidden(pad):
    pad.draw_cursor(SimpleNamespace(chart=np.array([1.0, 2.0])))
    assert pad.cursor == [1.0, 2.0]
    pad.draw_cursor(SimpleNamespace(chart=np.array([math.nan, 2.0])))
    assert pad.cursor == []  # JSON knows no NaN
    pad.draw_cursor(SimpleNamespace(chart=np.array([1.0, 2.0])))
    pad.draw_cursor(None)
    assert pad.cursor == []


def test_picture_and_cursor_can_share_a_message(pad, sent):
    with pad.hold_sync():
        pad.draw(scene(POINTS + 1))
        pad.draw_cursor(SimpleNamespace(chart=np.array([1.0, 2.0])))
    assert [set(msg["state"]) for msg, _ in sent] == [{"picture", "cursor"}]


PLACES = np.array([[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]])


def signs(**more):
    values = {
        "places": PLACES,
        "signs": "+−+",
        "colours": ("kappa", "tau", "kappa"),
        "shades": [0.0, 0.5, 1.0],
        "tile": (0.2, 0.1),
        "words": "three places",
    }
    return Signs(**(values | more))


def test_signs_arrive_as_they_were_given(pad):
    pad.draw_signs(signs())
    sent = pad.signs
    assert np.frombuffer(sent["places"], "<f4").tolist() == PLACES.astype("f4").ravel().tolist()
    assert [sent["colours"][k] for k in sent["which"]] == ["kappa", "tau", "kappa"]
    assert list(sent["shades"]) == [0, 128, 255]
    assert (sent["signs"], sent["tile"], sent["words"]) == ("+−+", [0.2, 0.1], "three places")
    pad.draw_signs(None)
    assert pad.signs == {}


def test_signs_are_one_small_message_and_sent_only_when_they_change(pad, sent):
    places = np.random.default_rng(1).random((225, 2))
    many = {"places": places, "signs": "+" * 225, "colours": ("tau",) * 225}
    pad.draw_signs(signs(shades=np.ones(225), **many))
    pad.draw_signs(signs(shades=np.ones(225), **many))
    pad.draw(scene(POINTS + 1))  # the curve moves: the signs do not travel along
    pad.set_theme(DARK)
    assert [set(msg["state"]) for msg, _ in sent] == [{"signs"}, {"picture"}, {"colours"}]
    msg, buffers = sent[0]
    assert sum(len(b) for b in buffers) == 225 * (8 + 1 + 1)
    assert len(json.dumps(msg)) < 900


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"places": PLACES[:2]}, r"`places` must have shape \(3, 2\)"),
        ({"places": PLACES * math.nan}, "`places` must be finite"),
        ({"shades": [0.0, 1.0]}, "`shades` must have shape"),
        ({"shades": [0.0, 1.0, 1.1]}, "between 0 and 1"),
        ({"tile": (0.0, 1.0)}, "`tile` must be positive"),
        ({"colours": ("kappa",)}, "`colours` must have shape"),
        ({"colours": ("kappa", "dark", "tau")}, "`colours` must be names"),
        ({"signs": "+ +"}, "blanks"),
    ],
)
def test_signs_that_do_not_fit_together_are_refused(wrong, says):
    with pytest.raises(GeometryError, match=says):
        signs(**wrong)


def test_every_colour_of_a_sign_is_known_to_the_browser(pad):
    names = sorted(set(pad.colours) - {"dark"})
    pad.draw_signs(signs(places=np.zeros((len(names), 2)), signs="0" * len(names),
                         colours=tuple(names), shades=np.zeros(len(names))))  # fmt: skip
    assert pad.signs["colours"] == names


def test_a_ring_about_a_place_is_shown_and_hidden_beside_the_cursor(pad):
    pad.draw_cursor(SimpleNamespace(chart=np.array([1.0, 2.0])))
    pad.draw_place((0.5, 0.6))
    assert (pad.ring, pad.cursor) == ([0.5, 0.6], [1.0, 2.0])
    pad.draw_place((math.nan, 0.6))
    assert pad.ring == []
    pad.draw_place((0.5, 0.6))
    pad.draw_place(None)
    assert (pad.ring, pad.cursor) == ([], [1.0, 2.0])


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_theme_colours(pad, theme):
    pad.set_theme(theme)
    assert pad.colours["ink"] == theme.ink
    assert pad.colours["dark"] is theme.dark
    assert all(isinstance(c, str) for k, c in pad.colours.items() if k != "dark")


# ---- browser → Python ----------------------------------------------------------------------------


def test_each_kind_is_reported(pad, heard):
    message(pad, "choose", 1, drag=1)
    motion(pad, 2)
    message(pad, "end", 3, u=0.7, drag=1)
    message(pad, "add", 4, index=3)
    message(pad, "remove", 5, index=0)
    assert heard == [
        PadRequest("choose", 1, 0.5, 0.6, 1),
        PadRequest("move", 1, 0.5, 0.6, 1),
        PadRequest("end", 1, 0.7, 0.6, 1),
        PadRequest("add", 3, 0.5, 0.6, 0),
        PadRequest("remove", 0, 0.5, 0.6, 0),
    ]


def test_choose_sets_chosen_before_it_is_reported(pad):
    seen = []
    pad.on_request(lambda request: seen.append(pad.chosen))
    message(pad, "choose", 1, index=2)
    assert seen == [2]


def test_a_move_held_back_behind_the_end_of_its_drag_is_dropped(pad, heard):
    motion(pad, 1)
    message(pad, "end", 3, u=0.9, drag=1)
    motion(pad, 2, u=0.8)
    assert [(r.kind, r.u) for r in heard] == [("move", 0.5), ("end", 0.9)]


def test_a_message_delivered_twice_counts_once(pad, heard):
    message(pad, "add", 1)
    message(pad, "add", 1)
    assert len(heard) == 1


def test_drags_of_different_views_get_different_numbers(pad, heard):
    motion(pad, 1, drag=1, view="a")
    motion(pad, 2, drag=1, view="a")
    motion(pad, 1, drag=1, view="b")
    motion(pad, 3, drag=2, view="a")
    numbers = [r.drag for r in heard]
    assert numbers[0] == numbers[1]
    assert len(set(numbers)) == 3
    assert all(n > 0 for n in numbers)


def test_the_answer_names_the_request_it_saw(pad):
    pad.on_request(lambda request: pad.draw(scene(POINTS + request.u)))
    motion(pad, 7, u=0.25)
    assert pad.picture["seen"] == {"a": 7}
    assert np.frombuffer(pad.picture["points"], "<f8")[0] == POINTS[0, 0] + 0.25


def test_a_refused_request_drawn_again_is_still_an_answer(pad, sent):
    pad.on_request(lambda request: pad.draw(scene()))
    motion(pad, 4)
    assert [s[0]["state"]["picture"]["seen"] for s in sent] == [{"a": 4}]


def test_a_drag_nobody_answers_ends_where_the_last_scene_has_the_point(pad, sent):
    motion(pad, 1)
    assert sent == []
    message(pad, "end", 2, drag=1)
    picture = sent[-1][0]["state"]["picture"]
    assert (len(sent), picture["seen"]) == (1, {"a": 2})
    assert bytes(sent[-1][1][0]) == POINTS.tobytes()


def test_an_answered_end_is_answered_once(pad, sent):
    pad.on_request(lambda request: pad.draw(scene(POINTS + 1)))
    message(pad, "end", 1, drag=1)
    assert len(sent) == 1


def test_choosing_the_chosen_point_again_is_answered(pad, sent):
    message(pad, "choose", 9, index=pad.chosen)
    assert sent[-1][0]["state"]["picture"]["seen"] == {"a": 9}


def test_moves_are_not_echoed(pad, sent):
    motion(pad, 1)
    pad.set_state({"dark": True})
    assert sent == []


def test_views_long_gone_are_forgotten(pad, heard):
    for k in range(100):
        message(pad, "choose", 1, view=f"view{k}")
    pad.draw(scene(POINTS + 1))
    assert len(heard) == 100
    assert len(pad.picture["seen"]) <= 16
    assert "view99" in pad.picture["seen"]


@pytest.mark.parametrize(
    "content",
    [
        None,
        [],
        "end",
        {},
        {"kind": "end"},
        {"kind": "explode", "view": "a", "seq": 1, "drag": 1, "index": 0, "u": 0, "v": 0},
        {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": -1, "u": 0, "v": 0},
        {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 0.5, "u": 0, "v": 0},
        {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 0, "u": None, "v": 0},
        {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 0, "u": math.inf, "v": 0},
        {"kind": "end", "view": "a", "seq": True, "drag": 1, "index": 0, "u": 0, "v": 0},
        {"kind": "end", "view": 3, "seq": 1, "drag": 1, "index": 0, "u": 0, "v": 0},
    ],
)
def test_malformed_messages_are_left_alone(pad, heard, content):
    pad._handle_custom_msg(content, [])
    assert heard == []


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=6),
    max_leaves=8,
)


@settings(max_examples=60, deadline=None)
@given(st.lists(json_values, max_size=7))
def test_no_motion_whatever_raises_or_reports_nonsense(value):
    pad = DomainPad()
    heard = []
    pad.on_request(heard.append)
    pad.set_state({"motion": value})
    pad.close()
    assert all(r.index >= 0 and math.isfinite(r.u) and math.isfinite(r.v) for r in heard)


# ---- looks ---------------------------------------------------------------------------------------


def look(pad, seq, u=0.5, v=0.6, view="a"):
    pad._handle_custom_msg({"kind": "look", "view": view, "seq": seq, "u": u, "v": v}, [])


def glance(pad, seq, u=0.5, v=0.6, view="a"):
    pad.set_state({"glance": json.loads(json.dumps([view, seq, u, v]))})


@pytest.fixture
def looked(pad):
    places = []
    pad.on_look(lambda u, v: places.append((u, v)))
    return places


def test_looks_are_reported_in_order_and_are_no_requests(pad, heard, looked):
    glance(pad, 1, 0.1)
    look(pad, 3, 0.3)
    glance(pad, 2, 0.2)  # held back behind the end: it does not count any more
    look(pad, 3, 0.4)  # delivered twice
    assert looked == [(0.1, 0.6), (0.3, 0.6)]
    assert heard == []


def test_a_pad_offers_looks_while_somebody_listens(pad):
    assert pad.looks is False
    first, second = pad.on_look(print), pad.on_look(repr)
    first()
    assert pad.looks is True
    second()
    second()
    assert pad.looks is False


def test_only_the_last_look_is_answered_by_a_picture(pad, looked, sent):
    glance(pad, 1)
    assert sent == []
    look(pad, 2)
    assert [msg["state"]["picture"]["seen"] for msg, _ in sent] == [{"a": 2}]


@pytest.mark.parametrize("wrong", [{"u": math.nan}, {"v": "0.5"}, {"seq": -1}, {"view": 3}])
def test_malformed_looks_are_left_alone(pad, looked, wrong):
    look(pad, **({"seq": 1} | wrong))
    glance(pad, **({"seq": 1} | wrong))
    assert looked == []


@settings(max_examples=60, deadline=None)
@given(st.lists(json_values, max_size=5))
def test_no_glance_whatever_raises_or_reports_nonsense(value):
    pad = DomainPad()
    places = []
    pad.on_look(lambda u, v: places.append((u, v)))
    pad.set_state({"glance": value})
    pad.close()
    assert all(math.isfinite(u) and math.isfinite(v) for u, v in places)


# ---- attaching and detaching ---------------------------------------------------------------------


def test_disconnect_ends_only_its_own_callback(pad):
    first, second = [], []
    disconnect = pad.on_request(first.append)
    pad.on_request(second.append)
    message(pad, "add", 1)
    disconnect()
    disconnect()
    message(pad, "add", 2)
    assert (len(first), len(second)) == (1, 2)


def test_a_callback_may_disconnect_itself(pad):
    calls = []

    def once(request):
        calls.append(request)
        disconnect()

    disconnect = pad.on_request(once)
    after = []
    pad.on_request(after.append)
    message(pad, "add", 1)
    message(pad, "add", 2)
    assert (len(calls), len(after)) == (1, 2)


def test_closed_pad_is_silent_and_harmless(pad, heard, looked):
    pad.close()
    pad.close()
    message(pad, "add", 1)
    motion(pad, 2)
    pad.draw(scene(POINTS + 1))
    pad.draw_cursor(None)
    pad.set_theme(DARK)
    glance(pad, 3)
    assert heard == looked == []
    assert pad.comm is None


def test_two_pads_do_not_hear_each_other(pad, heard):
    other = DomainPad()
    message(other, "choose", 1, index=2)
    assert heard == []
    assert (pad.chosen, other.chosen) == (0, 2)
    other.close()


# ---- the JavaScript ------------------------------------------------------------------------------


def test_script_and_style_travel_with_the_widget(pad):
    state = pad.get_state()
    assert "export default" in state["_esm"]
    assert ".rl-pad" in state["_css"]
    assert "import " not in state["_esm"].replace("!important", "")


# Synced names the browser looks up must be traits here; a typing slip would show nothing, silently.
def test_every_trait_the_script_asks_for_exists(pad):
    script = pad.get_state()["_esm"]
    asked = set(re.findall(r'model\.[gs]et\("(\w+)"', script))
    asked |= set(re.findall(r'"change:(\w+)"', script))
    drawn = {"picture", "cursor", "ring", "signs", "colours"}
    assert asked == drawn | {"looks", "aspect", "min_height", "motion", "glance"}
    assert asked <= set(pad.keys)


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_script_is_valid_javascript(pad, tmp_path):
    script = tmp_path / "pad.mjs"
    script.write_text(pad.get_state()["_esm"], encoding="utf-8")
    subprocess.run(["node", "--check", str(script)], check=True, timeout=60)
