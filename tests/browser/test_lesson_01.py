"""Lesson 01 in a real browser: its picture follows a slider, an exercise is answered."""

from __future__ import annotations

from .session import LabSession
from .test_lessons import LESSONS, in_sight, right_answer, run_whole

PICTURE = ".ruledlab-dual"


def test_lesson_01_lives(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "01_dual_numbers.ipynb") as page:
        in_sight(page, PICTURE)
        before = page.wait_still(PICTURE)
        picture = page.page.get_by_role("img", name="f(x) = x**2 at X = 1.5 + ε 0.5")
        assert picture.count() == 1
        page.screenshot("lesson-01")
        page.press(page.page.get_by_role("slider", name="x, the real part").first, "ArrowRight")
        page.wait_change(before, PICTURE)
        assert page.page.get_by_role("img", name="at X = 1.55 + ε 0.5").count() == 1
        assert "2.4025 + ε 1.55" in page.page.locator(".ruledlab-numbers").first.inner_text()

        picture = page.wait_still(PICTURE)
        behind, _ = page.pull("x, the point of the graph", (-80, 0))
        assert abs(behind) < 3  # it goes in steps of 0.05
        page.wait_change(picture, PICTURE)
        undo = page.page.get_by_role("button", name="undo").first
        undo.click()
        page.wait_same(picture, PICTURE)
        behind, _ = page.pull("x̄, the tip", (-60, 0))
        assert abs(behind) < 3
        undo.click()
        page.wait_same(picture, PICTURE)

        field = page.page.get_by_role("textbox", name="f(x), a formula in x").first
        field.fill("1/2x")
        field.press("Enter")
        error = page.page.locator(".ruledlab-error[role=alert]").first
        error.wait_for()
        assert "write 2*x" in error.inner_text()

        card = page.page.locator(".ruledlab-exercise").first
        answer = card.locator(".ruledlab-field input")
        answer.scroll_into_view_if_needed()
        answer.fill("[0, 0]")
        answer.press("Enter")
        card.get_by_text("begun").wait_for()
        answer.fill(right_answer(page, "01.1"))
        answer.press("Enter")
        card.get_by_text("✓ done").wait_for()
        page.screenshot("lesson-01-exercise")
        assert page.faults() == []
