"""The domain pad in a real browser: mouse, keyboard, and a kernel that is slow to answer."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

from .session import HANDLE, PLOTS, THREE, Pictures, StudioPage

STEPS = {0.01 * part for part in (1, 0.5, 0.2, 0.1, 0.05)}  # of an arrow key, by how near one looks


def centre(studio: StudioPage, index: int) -> tuple[float, float]:
    """Where a handle's disc is, in pixels."""
    box = studio.page.locator(HANDLE).nth(index).locator(".rl-disc").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def beside(studio: StudioPage, index: int, other: int) -> tuple[float, float]:
    """How far a handle is from another, in pixels: the page itself may move a little."""
    (x, y), (x0, y0) = centre(studio, index), centre(studio, other)
    return x - x0, y - y0


def settled(studio: StudioPage) -> tuple[float, float]:
    """Where the handle in the middle is when the chart has come to rest."""
    places = [centre(studio, 3)]
    while len(places) < 5 or math.dist(places[-5], places[-1]) > 0:
        studio.page.wait_for_timeout(60)
        places.append(centre(studio, 3))
    return places[-1]


def said(studio: StudioPage, index: int) -> tuple[float, float]:
    """Where a handle says it is, in radians."""
    label = studio.page.locator(HANDLE).nth(index).get_attribute("aria-label")
    u, v = re.findall(r"[uv] = (−?\d+\.\d+)", str(label))
    return float(u.replace("−", "-")), float(v.replace("−", "-"))


def kept(before: Any, after: Any, *moved: int) -> bool:
    """Whether all points but these are exactly where they were."""
    pairs = enumerate(zip(before["points"], after["points"], strict=True))
    return all(old == new for i, (old, new) in pairs if i not in moved)


@pytest.fixture
def in_sight(studio: StudioPage) -> StudioPage:
    studio.page.locator(".rl-stage").scroll_into_view_if_needed()
    settled(studio)
    return studio


def choose(studio: StudioPage, index: int) -> Pictures:
    """Choose a control point; return the pictures, where the sphere marks it now."""
    studio.kernel(f"s.lab.choose({index})")
    space = studio.notebook.wait_change(studio.home.space, THREE)
    return Pictures(space, studio.notebook.wait_still(PLOTS))


def drag(studio: StudioPage, index: int, by: tuple[float, float], steps: int = 8) -> None:
    """Drag a handle by so many pixels, and hold it there."""
    x, y = centre(studio, index)
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + by[0], y + by[1], steps=steps)


def test_a_dragged_point_takes_curve_surface_and_plots_along(in_sight: StudioPage) -> None:
    studio, before, old = in_sight, in_sight.design(), choose(in_sight, 3)
    x, y = beside(studio, 3, 4)
    drag(studio, 3, (-40, 25))
    studio.page.mouse.up()
    studio.wait_new(old)
    after = studio.design()
    assert kept(before, after, 3)
    assert beside(studio, 3, 4) == pytest.approx((x - 40, y + 25), abs=1.5)
    assert tuple(after["points"][3]) == pytest.approx(said(studio, 3), abs=6e-4)
    (u, v), (new_u, new_v) = before["points"][3], after["points"][3]
    assert new_u < u - 0.05
    assert new_v > v + 0.03
    studio.button("undo").click()  # the whole drag is one step
    studio.wait_kernel("s.lab.design == example('example_2')", "True")
    studio.notebook.wait_same(old.space)


def test_a_drag_at_the_seam_keeps_the_closing(in_sight: StudioPage) -> None:
    studio, old = in_sight, choose(in_sight, 1)
    drag(studio, 1, (0, 18))
    studio.page.mouse.up()
    studio.wait_new(old)
    points = studio.design()["points"]
    first, last = ([b - a for a, b in zip(*leg, strict=True)] for leg in (points[:2], points[-2:]))
    assert points[0] == points[-1]
    assert first == pytest.approx(last, abs=1e-12)
    assert studio.design()["closing"] == "C1"
    studio.wait_kernel("s.lab.result.closure.closed", "True")


def test_the_handle_follows_while_the_kernel_is_slow(in_sight: StudioPage) -> None:
    studio, old = in_sight, choose(in_sight, 3)
    studio.kernel("import time; slow = s.lab.follow(lambda change: time.sleep(1.5))")
    try:
        x, y = centre(studio, 3)
        drag(studio, 3, (-36, 20), steps=12)  # 18 s of work, were each of them done
        assert centre(studio, 3) == pytest.approx((x - 36, y + 20), abs=1.5)
        behind = studio.notebook.pixels(THREE)
        studio.page.mouse.up()
        goal = centre(studio, 3)
        assert goal == pytest.approx((x - 36, y + 20), abs=1.5)
    finally:
        studio.kernel("slow()")
    studio.wait_new(old)
    assert studio.notebook.wait_still(THREE) != behind  # the handle was ahead of the picture
    assert centre(studio, 3) == pytest.approx(goal, abs=0.1)  # and nothing was lost
    assert tuple(studio.design()["points"][3]) == pytest.approx(said(studio, 3), abs=6e-4)


RING = ".rl-place"
SIGNS = ".rl-signs"
LISTEN = (
    "seen = []; end = s.pad.on_look(lambda u, v: (seen.append((u, v)), s.pad.draw_place((u, v))))"
)
WRITE = """
from ruledlab.lab.signs import Signs
places = [(0.6, 0.5), (0.6, 1.0), (0.9, 0.5), (0.9, 1.0)]
s.pad.draw_signs(Signs(places, "+−0+", ("kappa", "tau", "delta", "tau"), [0, 0.1, 0.2, 0.2],
                       (0.3, 0.5), "four places"))
"""


def empty(studio: StudioPage) -> tuple[float, float]:
    """A place of the chart with nothing near."""
    (x2, y2), (x3, y3) = centre(studio, 2), centre(studio, 3)
    return (x2 + x3) / 2 - 40, (y2 + y3) / 2


def sweep(studio: StudioPage, by: tuple[float, float], steps: int = 6) -> None:
    """Press on empty chart, move by so many pixels, and hold."""
    x, y = empty(studio)
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + by[0], y + by[1], steps=steps)


def ring_at(studio: StudioPage) -> tuple[float, float]:
    """Where the ring about the place looked at is, in pixels."""
    box = studio.page.locator(RING).bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def ring_shown(studio: StudioPage) -> bool:
    return studio.page.locator(RING).get_attribute("visibility") == "inherit"


def test_a_drag_across_the_empty_chart_is_nothing_here(in_sight: StudioPage) -> None:
    studio = in_sight
    sweep(studio, (30, -12))
    assert not ring_shown(studio)
    studio.page.mouse.up()
    assert studio.stays(studio.home)
    assert studio.kernel("s.lab.design == example('example_2')") == "True"


def test_where_somebody_listens_it_takes_the_ring_along(in_sight: StudioPage) -> None:
    studio = in_sight
    studio.kernel(LISTEN + "; import time; slow = s.pad.on_look(lambda u, v: time.sleep(0.5))")
    try:
        x, y = empty(studio)
        sweep(studio, (30, -12), steps=12)
        assert ring_at(studio) == pytest.approx((x + 30, y - 12), abs=1.5)  # ahead of the kernel
        studio.page.mouse.up()
        studio.kernel("slow()")
        studio.page.wait_for_timeout(300)
        assert ring_at(studio) == pytest.approx((x + 30, y - 12), abs=1.5)
        assert studio.kernel("s.pad.ring == list(seen[-1])") == "True"
        assert int(studio.kernel("len(seen)")) < 12  # only the latest place while it was busy
        assert studio.kernel("s.lab.design == example('example_2')") == "True"
        studio.page.mouse.click(x, y)  # a click adds a point as ever
        studio.wait_kernel("len(s.lab.design.points)", "8")
    finally:
        studio.kernel("slow(); end(); s.pad.draw_place(None)")
    studio.page.wait_for_function(
        f"() => document.querySelector('{RING}').getAttribute('visibility') === 'hidden'"
    )


def test_a_finger_takes_the_ring_and_elsewhere_scrolls(in_sight: StudioPage) -> None:
    studio = in_sight
    studio.kernel(LISTEN + "; s.pad.draw_place((0.7, 1.0))")
    touch = studio.page.context.new_cdp_session(studio.page)
    touch.send("Emulation.setTouchEmulationEnabled", {"enabled": True})

    def swipe(at: tuple[float, float], by: tuple[float, float]) -> None:
        for k in range(9):
            finger = {"x": at[0] + by[0] * k / 8, "y": at[1] + by[1] * k / 8}
            kind = "touchMove" if k else "touchStart"
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [finger]})
            studio.page.wait_for_timeout(20)
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    try:
        studio.wait_kernel("s.pad.looks", "True")
        studio.page.wait_for_timeout(300)
        x, y = ring_at(studio)
        swipe((x, y), (-20, 24))
        studio.wait_kernel("s.pad.ring == list(seen[-1])", "True")
        assert ring_at(studio) == pytest.approx((x - 20, y + 24), abs=1.5)
        place = studio.kernel("s.pad.ring")
        swipe((x + 60, y + 20), (0, -30))  # no handle and no ring is near
        studio.page.wait_for_timeout(300)
        assert studio.kernel("s.pad.ring") == place
        assert studio.kernel("s.lab.design == example('example_2')") == "True"
    finally:
        touch.send("Emulation.setTouchEmulationEnabled", {"enabled": False})
        studio.kernel("end(); s.pad.draw_place(None)")


def test_signs_lie_under_everything_and_in_nobodys_way(in_sight: StudioPage) -> None:
    studio, page = in_sight, in_sight.page
    studio.kernel(WRITE)
    try:
        page.wait_for_function(f"() => document.querySelectorAll('{SIGNS} text').length === 3")
        signs = page.locator(f"{SIGNS} text")
        assert signs.all_text_contents() == ["+", "−+", "0"]  # one text for each colour
        assert page.locator(f"{SIGNS} path").count() == 2  # one path for each shade but none
        said = page.locator(".rl-stage").get_attribute("aria-describedby")
        assert page.locator(f"[id='{str(said).split()[0]}']").text_content() == "four places"
        colours = [signs.nth(k).evaluate("node => getComputedStyle(node).fill") for k in range(3)]
        assert len(set(colours)) == 3
        box = signs.nth(1).bounding_box()
        assert box is not None
        at = [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]
        met = page.evaluate("at => document.elementFromPoint(...at).closest('.rl-signs')", at)
        assert met is None
        settled(studio)
        drag(studio, 3, (-40, 25))
        page.mouse.up()
        studio.wait_kernel("s.lab.design == example('example_2')", "False")
    finally:
        studio.kernel("s.pad.draw_signs(None)")
    page.wait_for_function(f"() => !document.querySelector('{SIGNS}').children.length")


def test_escape_takes_a_drag_back(in_sight: StudioPage) -> None:
    studio, old = in_sight, choose(in_sight, 3)
    drag(studio, 3, (-40, 25))
    studio.wait_new(old)
    studio.page.keyboard.press("Escape")
    studio.page.mouse.up()
    studio.notebook.wait_same(old.space, THREE)
    studio.wait_kernel("s.lab.design == example('example_2')", "True")


def test_arrow_keys_move_the_chosen_point(in_sight: StudioPage) -> None:
    studio, before = in_sight, in_sight.design()
    studio.page.locator(HANDLE).nth(3).focus()
    studio.wait_kernel("s.lab.chosen", "3")
    studio.notebook.wait_change(studio.home.space, THREE)
    old = studio.look()
    for _ in range(3):
        studio.page.keyboard.press("ArrowRight")
    studio.page.keyboard.press("Shift+ArrowUp")
    studio.wait_new(old)
    after = studio.design()
    assert kept(before, after, 3)
    (u, v), (new_u, new_v) = before["points"][3], after["points"][3]
    step = (new_u - u) / 3
    assert min(abs(step - known) for known in STEPS) < 1e-9
    assert v - new_v == pytest.approx(10 * step, abs=1e-9)
    assert studio.page.locator(HANDLE).nth(3).evaluate("node => node === document.activeElement")


def test_keys_walk_from_point_to_point(in_sight: StudioPage) -> None:
    studio = in_sight
    studio.page.locator(HANDLE).nth(0).focus()
    for key, index in (("PageDown", 1), ("]", 2), ("End", 0), ("PageUp", 5), ("Home", 0)):
        studio.page.keyboard.press(key)
        studio.wait_kernel("s.lab.chosen", str(index))
        focused = studio.page.evaluate("() => document.activeElement.dataset.index")
        assert focused == str(index)
    assert studio.kernel("s.lab.design == example('example_2')") == "True"


def test_a_click_adds_a_point_and_delete_takes_it_away(in_sight: StudioPage) -> None:
    studio, before = in_sight, in_sight.design()
    (x2, y2), (x3, y3) = centre(studio, 2), centre(studio, 3)
    at = ((x2 + x3) / 2 - 30, (y2 + y3) / 2)  # beside the leg from 2 to 3, far from other handles
    studio.page.mouse.click(*at)
    studio.wait_kernel("len(s.lab.design.points)", "8")
    studio.wait_new(studio.home)
    added = studio.design()["points"]
    assert added[:3] + added[4:] == before["points"]
    assert centre(studio, 3) == pytest.approx(at, abs=1.5)
    studio.wait_kernel("s.lab.chosen", "3")  # and it is at hand
    studio.page.wait_for_function("() => document.activeElement.dataset.index === '3'")
    studio.page.keyboard.press("Delete")
    studio.wait_kernel("s.lab.design == example('example_2')", "True")
    studio.page.wait_for_function(f"() => document.querySelectorAll('{HANDLE}').length === 7")


def test_the_bar_adds_and_removes_too(in_sight: StudioPage) -> None:
    studio = in_sight
    studio.button("Add a point").click()
    studio.wait_kernel("len(s.lab.design.points)", "8")
    middle = [3 * math.pi / 16, 5 * math.pi / 16]
    assert math.dist(studio.design()["points"][1], (math.pi / 8, middle[1])) < 1e-12
    studio.button("Remove the chosen point").click()
    studio.wait_kernel("len(s.lab.design.points)", "7")


def test_the_whole_chart_and_back(in_sight: StudioPage) -> None:
    studio = in_sight
    studio.button("Fit the view").click()
    near = settled(studio)
    studio.button("Show the whole chart").click()
    studio.page.wait_for_function(
        "() => document.querySelectorAll('.rl-pad .rl-pole').length === 2"
    )
    assert math.dist(near, settled(studio)) > 20
    studio.button("Fit the view").click()
    studio.page.wait_for_function(
        "() => document.querySelectorAll('.rl-pad .rl-pole').length === 1"
    )
    assert settled(studio) == pytest.approx(near, abs=0.5)
    assert studio.stays(studio.home)
