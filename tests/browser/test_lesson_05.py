"""Lesson 05 in a real browser: the tangent plane moves with w, an exercise is answered."""

from __future__ import annotations

import pytest

from .session import THREE, LabSession
from .test_lessons import LESSONS, answer_the_first, in_sight, run_whole

GRAPH = "svg.ruledlab-bend"
W = "w, the place along the ruling from the striction point"
W_SHOWN = (
    f"Number(document.querySelector('{GRAPH}').ariaLabel"
    ".match(/At w = ([^,]*),/)[1].replace('−', '-'))"
)
PLACES = """() => [...document.querySelectorAll('.ruledlab :is(svg, table, input, button)')]
  .map(part => { const {x, y, width, height} = part.getBoundingClientRect();
                 return [x, y - document.querySelector('.ruledlab').getBoundingClientRect().y,
                         width, height].map(Math.round).join() })"""


def test_the_plane_moves_and_an_exercise_is_answered(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "05_how_the_surface_bends.ipynb") as page:
        in_sight(page, THREE)
        space = page.wait_still(THREE, timeout=60)
        assert space.drawn > 2000
        assert "At w = −0.6," in (page.locator(GRAPH).get_attribute("aria-label") or "")
        page.press(page.page.get_by_role("slider", name=W), "ArrowRight", 10)
        page.page.locator(f"{GRAPH}[aria-label*='At w = −0.5,']").wait_for()
        assert page.wait_change(space, THREE) != space
        page.page.get_by_label("tangent planes along the ruling").check()

        places = page.page.evaluate(PLACES)
        play = page.page.get_by_role("button", name="play or pause: w")
        page.press(play, "Enter")
        page.page.wait_for_function(f"() => {W_SHOWN} > -0.4")
        page.press(play, "Space")
        still = page.wait_still(THREE)
        assert page.stays(still, THREE)
        assert page.page.evaluate(W_SHOWN) > -0.4  # where it was paused
        assert page.page.evaluate(PLACES) == places  # nothing has moved out of its place
        page.page.get_by_role("button", name="undo").click()
        page.page.locator(f"{GRAPH}[aria-label*='At w = −0.5,']").wait_for()
        page.screenshot("lesson-05")
        still = page.wait_still(THREE)
        assert page.pull("the point looked at", (-30, 12)) == pytest.approx((0, 0), abs=2)
        moved = page.wait_change(still, THREE)
        behind, _ = page.pull("w, on the curve of K", (40, 0))
        assert behind == pytest.approx(0, abs=2)
        page.wait_change(moved, THREE)
        answer_the_first(page, "05.1")
        assert page.faults() == []
