"""Lesson 05 in a real browser: the tangent plane moves with w, an exercise is answered."""

from __future__ import annotations

from .session import THREE, LabSession
from .test_lessons import LESSONS, in_sight, run_whole

GRAPH = "svg.ruledlab-bend"
W = "w, the place along the ruling from the striction point"
ANSWER = (
    "from ruledlab.exercises import find, seed; print(find('05.1').task(seed()).right_answer())"
)


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
        page.screenshot("lesson-05")
        card = page.page.locator(".ruledlab-exercise").first
        card.scroll_into_view_if_needed()
        field = card.locator(".ruledlab-field input")
        field.fill(page.kernel_exec(ANSWER).strip())
        field.press("Enter")
        card.get_by_text("✓ done").wait_for()
        assert page.sticks_out() == []
        assert page.errors() == []
        assert page.console_errors == []
