"""Lesson 03 in a real browser: a ruling's neighbour comes nearer, an exercise is answered."""

from __future__ import annotations

from .session import THREE, LabSession
from .test_lessons import LESSONS, in_sight, run_whole

NUMBERS = ".ruledlab-edit .ruledlab-numbers"
H = "logarithm of h: the neighbour is the ruling at t + h"


def test_a_neighbour_comes_nearer_and_an_exercise_is_answered(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "03_a_line_that_moves.ipynb") as page:
        in_sight(page, THREE)
        first = page.wait_still(THREE, timeout=60)
        assert first.drawn > 2000
        assert "0.5012" in page.locator(NUMBERS).inner_text()
        page.press(page.page.get_by_role("slider", name=H).first, "ArrowLeft", 14)
        page.wait_change(first, THREE)
        page.page.get_by_text("0.1", exact=True).first.wait_for()
        graph = page.page.get_by_role("img", name="Over the step h").first
        assert "distance d like h" in str(graph.get_attribute("aria-label"))
        page.screenshot("lesson-03")
        page.dark()
        page.command("application:toggle-left-area")
        page.resize(650, 1000)
        page.page.wait_for_timeout(500)  # JupyterLab lays its cells out anew
        in_sight(page, THREE)
        page.wait_still(THREE)
        page.screenshot("lesson-03-dark")
        assert page.sticks_out() == []

        field = page.page.get_by_role("textbox", name="direction x(t)").first
        field.fill("a*sin(t), -a*cos(x), 1")
        field.press("Enter")
        page.page.get_by_text("unknown name 'x' at column 18").first.wait_for()

        card = page.page.locator(".ruledlab-exercise").first
        card.scroll_into_view_if_needed()
        card.get_by_text("the tangents of a helix").click()
        card.get_by_role("button", name="Check").click()
        card.get_by_text("✓ done").wait_for()
        assert page.faults() == []
