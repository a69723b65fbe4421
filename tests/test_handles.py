"""Handles in a picture: where they are seen, and what is asked for by moving them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

pytest.importorskip("anywidget")
pytest.importorskip("pythreejs")

import ipywidgets

from ruledlab.lab.axes import Limits
from ruledlab.lab.flat import Flat, by_hand
from ruledlab.lab.handles import Grip, Handles
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.sight import FIELD_OF_VIEW, Eye
from ruledlab.lab.view3d import SurfaceView

coordinate = st.floats(-3, 3)
vector = st.tuples(coordinate, coordinate, coordinate).map(np.array)


def eye_at(position, target):
    """An eye upright, as the view makes it: by way of the view itself."""
    view = SurfaceView(600, 400)
    view.frame(target, 2.0)
    handles = Handles(view)
    found = handles._view.eye
    handles.close()
    view.close()
    return Eye(np.array(position, dtype=float), found.quaternion, found.size)


@pytest.fixture
def handles():
    view = SurfaceView(600, 400)
    view.frame((0.5, -1.0, 0.25), 2.0)
    made = Handles(view)
    yield made
    made.close()
    view.close()


def test_what_the_view_looks_at_is_in_the_middle(handles):
    x, y, depth = handles._view.eye.seen(np.array([0.5, -1.0, 0.25]))
    assert (x, y) == pytest.approx((300, 200))
    assert depth == pytest.approx(np.linalg.norm(handles._view.eye.position - (0.5, -1.0, 0.25)))


def test_the_upper_edge_is_half_the_field_of_view_away(handles):
    eye = handles._view.eye
    edge, middle = eye.at(300, 0, 5.0) - eye.position, eye.at(300, 200, 5.0) - eye.position
    cosine = edge @ middle / np.linalg.norm(edge) / np.linalg.norm(middle)
    assert math.degrees(math.acos(cosine)) == pytest.approx(FIELD_OF_VIEW / 2)
    assert edge[2] > middle[2], "up in the picture is up in space"


def test_a_turned_camera_is_that_of_its_quaternion():
    # looking along −y from y = 4, z up: the turn by 90° about x, then by 180° about z
    half = math.sqrt(0.5)
    eye = Eye(np.array([0.0, 4.0, 0.0]), np.array([0.0, half, half, 0.0]), (600.0, 400.0))
    x, y, depth = eye.seen(np.array([1.0, 0.0, 0.0]))
    assert (x < 300, y, depth) == (True, pytest.approx(200), pytest.approx(4))
    assert eye.seen(np.array([0.0, 0.0, 1.0]))[1] < 200


@settings(max_examples=60)
@given(vector)
def test_there_and_back(point):
    eye = Eye(np.array([4.0, -8.0, 4.0]), EYE.quaternion, EYE.size)
    x, y, depth = eye.seen(point)
    assume(depth > 0.1)
    np.testing.assert_allclose(eye.at(x, y, depth), point, atol=1e-9)


EYE = eye_at((4, -8, 4), (0, 0, 0))


def test_a_place_behind_the_eye_is_not_shown(handles):
    back = handles._view.eye.at(300, 200, -1.0)
    handles.draw([Grip(back, "point", "kappa", "behind"), Grip(np.zeros(3), "point", "tau", "on")])
    behind, shown = handles.picture["handles"]
    assert behind["x"] is None
    assert 0 < shown["x"] < 600


def test_what_is_asked_for_is_under_the_pointer_at_the_same_depth(handles):
    asked = []
    handles.on_grasp(asked.append)
    places = np.array([[0.0, 0.0, 0.0], [1.0, -1.0, 0.5]])
    handles.draw([Grip(place, "point", "kappa", "it") for place in places])
    handles.motion = ["view", 3, 1, 120, 310.5]
    (grasp,) = asked
    assert (grasp.index, grasp.drag) == (1, ("view", 3))
    x, y, depth = handles._view.eye.seen(grasp.place)
    assert (x, y) == pytest.approx((120, 310.5))
    assert depth == pytest.approx(handles._view.eye.seen(places[1])[2])


@pytest.mark.parametrize(
    "motion",
    [[], ["view", 1, 2, 0, 0], ["view", 1, -1, 0, 0], [1, 1, 0, 0, 0], ["v", 1, 0, math.nan, 0]],
)
def test_nonsense_from_the_page_is_not_heard(handles, motion):
    asked = []
    handles.on_grasp(asked.append)
    handles.draw([Grip(np.zeros(3), "point", "kappa", "it")] * 2)
    handles.motion = motion
    assert asked == []


def test_the_handles_follow_the_camera(handles):
    handles.draw([Grip(np.ones(3), "point", "kappa", "it")])
    before = handles.picture["handles"][0]
    handles._view.frame((1.0, 1.0, 1.0), 2.0)
    (after,) = handles.picture["handles"]
    assert after != before
    assert (after["x"], after["y"]) == pytest.approx((300, 200), abs=0.01)


# -- over a drawing ----------------------------------------------------------------------------

DRAWING = Flat((500.0, 300.0), (40.0, 10.0), (450.0, 260.0), Limits(-2.0, 4.0), Limits(-1.0, 0.5))


@given(st.floats(-2, 4), st.floats(-1, 0.5))
def test_a_place_of_a_drawing_there_and_back(x, y):
    across, down, depth = DRAWING.seen(np.array([x, y, 0.0]))
    assert 40 - 1e-9 <= across <= 490 + 1e-9
    assert 10 - 1e-9 <= down <= 270 + 1e-9
    assert depth == 1.0
    np.testing.assert_allclose(DRAWING.at(across, down, depth), [x, y, 0.0], atol=1e-12)


def test_up_in_a_drawing_is_up_on_the_page():
    corner, foot = DRAWING.seen(np.array([-2.0, 0.5, 0.0])), DRAWING.seen(np.array([4.0, -1.0, 0]))
    assert corner[:2] == (40, 10)
    assert foot[:2] == (490, 270)


@pytest.mark.parametrize(
    "place", [(4.1, 0), (-2.1, 0), (0, 0.6), (0, -1.1), (0, np.nan), (np.nan, 0)]
)
def test_what_is_not_in_the_plot_has_no_handle(place):
    made = Handles()
    made.draw([Grip(np.array([*place, 0.0]), "point", "tau", "it")], DRAWING)
    assert (made.picture["handles"][0]["x"], made.picture["handles"][0]["y"]) == (None, None)
    made.close()


def test_a_handle_of_a_drawing_asks_for_a_place_on_its_axes():
    made, asked = Handles(), []
    made.on_grasp(asked.append)
    made.motion = ["view", 1, 0, 40, 270]  # before anything is drawn
    assert asked == []
    made.draw([Grip(np.zeros(3), "point", "cursor", "it")], DRAWING)
    assert made.picture["size"] == [500, 300]
    made.motion = ["view", 2, 0, 40, 270]
    np.testing.assert_allclose(asked[0].place, [-2.0, -1.0, 0.0])
    made.close()


@pytest.mark.parametrize(
    ("value", "span", "shown"), [(0.123456, 1.0, 0.1235), (3.14159265, 6.28, 3.1416),
                                 (12.3456, 30.0, 12.346), (0.000123456, 0.01, 0.000123),
                                 (123456.7, 1e7, 123457.0)]
)  # fmt: skip
def test_a_number_by_hand_is_short(value, span, shown):
    assert by_hand(value, span) == shown
    assert abs(by_hand(value, span) - value) <= 0.5e-3 * span


def test_a_drawing_has_to_be_told():
    made = Handles()
    with pytest.raises(ValueError, match="`sight`"):
        made.draw([Grip(np.zeros(3), "point", "cursor", "it")])
    made.draw([])  # none can be drawn anywhere
    assert made.picture["handles"] == []
    made.close()


def test_it_has_the_colours_of_both_themes():
    for theme in (LIGHT, DARK):
        assert f"is-kappa{{fill:{theme.kappa}" in Handles._css


def test_closing_leaves_the_camera_alone_and_no_widget_open():
    before = set(ipywidgets.widget._instances)
    view = SurfaceView(600, 400)
    made = Handles(view)
    made.draw([Grip(np.zeros(3), "point", "kappa", "it")])
    picture = made.picture
    made.close()
    made.close()
    view.frame((9.0, 9.0, 9.0), 1.0)
    assert made.picture == picture
    view.close()
    assert set(ipywidgets.widget._instances) == before
