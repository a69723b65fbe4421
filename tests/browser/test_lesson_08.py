"""Lesson 08 in a real browser: once round a closed surface, a Möbius band, an exercise."""

from __future__ import annotations

from .session import HANDLE, THREE, LabSession
from .test_lessons import LESSONS, in_sight, right_answer, run_whole

WAYS = ".ruledlab-ways"


def test_the_way_round_lives_and_an_exercise_is_answered(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "08_closed_surfaces.ipynb") as page:
        in_sight(page, THREE)
        first = page.wait_still(THREE, timeout=60)
        assert first.drawn > 1500
        assert "−6.115937783" in page.locator(WAYS).inner_text()
        size = page.page.get_by_role("slider", name="size of the loop")
        page.press(size, "ArrowLeft", 50)
        page.wait_kernel("app.size.value", "0.5")
        small = page.wait_change(first, THREE)
        page.page.get_by_role("cell", name="0.2554").wait_for()
        page.press(size, "End")
        page.page.get_by_role("alert").get_by_text("0 < v < π").wait_for()
        assert page.stays(small, THREE, over=0.3)
        page.screenshot("lesson-08-size")
        page.kernel_exec("app.size.resize(1.0)")
        page.wait_same(first, THREE)

        in_sight(page, HANDLE)
        page.press(f"{HANDLE}[tabindex='0']", "Shift+ArrowDown")
        moved = page.wait_change(first, THREE)
        page.wait_kernel("app.lab.can_undo", "True")
        page.page.wait_for_timeout(300)
        told = page.locator(WAYS).inner_text()
        assert "0.580104765" not in told
        assert page.page.get_by_role("img", name="The enclosed region").count() == 1

        page.press(page.page.get_by_role("slider", name="w₀").first, "ArrowRight", 20)
        page.wait_change(moved, THREE)
        assert page.locator(WAYS).inner_text() == told  # wherever the walk begins

        page.page.get_by_role("combobox", name="named surfaces").select_option("Möbius band")
        page.wait_kernel("app.lab.result.closure.oriented", "False")
        page.page.get_by_role("status").get_by_text("comes back reversed").first.wait_for()
        page.dark()
        page.command("application:toggle-left-area")
        page.resize(650, 1000)
        in_sight(page, THREE)
        page.wait_still(THREE)
        page.screenshot("lesson-08-moebius")
        assert page.sticks_out() == []

        right = right_answer(page, "08.1")
        field = page.page.get_by_label("λ =").first
        field.fill(right)
        page.page.get_by_role("button", name="Check").first.click()
        page.page.get_by_text("Gauss and Bonnet: ").first.wait_for()
        assert page.faults() == []
