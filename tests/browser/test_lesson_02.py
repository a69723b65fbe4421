"""Lesson 02 in a real browser: two lines are moved, an exercise is answered."""

from __future__ import annotations

import pytest

from .session import THREE, LabSession, NotebookPage
from .test_lessons import LESSONS, answer_the_first, in_sight, run_whole

PAIR = ".ruledlab-edit .ruledlab-numbers"


def turn(page: NotebookPage) -> None:
    """Drag beside all handles: the picture is turned."""
    box = page.locator(THREE).bounding_box()
    assert box is not None
    x, y = box["x"] + 25, box["y"] + 25
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 60, y + 25, steps=8)
    page.page.mouse.up()


def test_two_lines_are_moved_and_an_exercise_is_answered(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "02_lines_as_points.ipynb") as page:
        in_sight(page, THREE)
        first = page.wait_still(THREE, timeout=60)
        assert first.drawn > 1000
        before = page.locator(PAIR).inner_text()
        page.press(page.page.get_by_role("slider", name="z of the given"), "ArrowRight", 10)
        page.wait_change(first, THREE)
        second = page.wait_still(THREE, quiet=1.0)  # all ten steps
        assert page.locator(PAIR).inner_text() != before

        at = page.handle("given point of line B")
        assert page.pull("given point of line B", (40, -30)) == pytest.approx((0, 0), abs=2)
        third = page.wait_change(second, THREE)
        undo = page.page.get_by_role("button", name="undo").first
        undo.click()  # the whole drag is one step
        page.wait_same(second, THREE)
        assert page.handle("given point of line B") == pytest.approx(at, abs=0.5)
        page.page.get_by_role("button", name="direction of line A").focus()
        page.page.keyboard.press("ArrowUp")
        outline = "() => getComputedStyle(document.activeElement).outlineStyle"
        assert page.page.evaluate(outline) == "none"  # its own ring says that it has the focus
        turned = page.wait_change(second, THREE)
        assert turned != third

        x, y = page.handle("direction of line A")
        turn(page)  # the handles are where the lines are now
        page.wait_change(turned, THREE)
        page.page.wait_for_timeout(600)
        assert page.handle("direction of line A") != pytest.approx((x, y), abs=3)

        page.page.get_by_role("combobox", name="positions of two lines").select_option("parallel")
        page.page.get_by_text("no single common perpendicular").first.wait_for()
        page.screenshot("lesson-02")
        answer_the_first(page, "02.1")
        assert page.faults() == []
