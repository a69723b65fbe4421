"""Lesson 02 in a real browser: two lines are moved, an exercise is answered."""

from __future__ import annotations

from .session import THREE, LabSession
from .test_lessons import LESSONS, in_sight, run_whole

PAIR = ".ruledlab-edit .ruledlab-numbers"
ANSWER = (
    "from ruledlab.exercises import find, seed; print(find('02.1').task(seed()).right_answer())"
)


def test_two_lines_are_moved_and_an_exercise_is_answered(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "02_lines_as_points.ipynb") as page:
        in_sight(page, THREE)
        first = page.wait_still(THREE, timeout=60)
        assert first.drawn > 1000
        before = page.locator(PAIR).inner_text()
        page.press(page.page.get_by_role("slider", name="z of a point"), "ArrowRight", 10)
        page.wait_change(first, THREE)
        assert page.locator(PAIR).inner_text() != before
        page.page.get_by_role("combobox", name="positions of two lines").select_option("parallel")
        page.page.get_by_text("no single common perpendicular").first.wait_for()
        page.screenshot("lesson-02")
        card = page.page.locator(".ruledlab-exercise").first
        card.scroll_into_view_if_needed()
        field = card.locator(".ruledlab-field input")
        field.fill(page.kernel_exec(ANSWER).strip())
        field.press("Enter")
        card.get_by_text("✓ done").wait_for()
        assert page.sticks_out() == []
        assert page.errors() == []
        assert page.console_errors == []
