"""Lesson 07 in a real browser: the congruence follows its fields, an exercise is answered."""

from __future__ import annotations

from .session import HANDLE, THREE, LabSession, NotebookPage
from .test_lessons import LESSONS, answer_the_first, in_sight, run_whole


def look_around(page: NotebookPage) -> None:
    """Take the ring across the empty chart, and return to the curve."""
    stage = page.page.locator(".rl-stage").first
    stage.scroll_into_view_if_needed()
    box = stage.bounding_box()
    assert box is not None
    x, y = box["x"] + 0.75 * box["width"], box["y"] + 0.8 * box["height"]
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x - 40, y - 10, steps=5)
    page.page.mouse.up()
    page.page.locator(".rl-place[visibility='inherit']").first.wait_for(state="attached")
    field = page.page.get_by_role("textbox", name="u of the place").first
    u = float(field.input_value().replace("−", "-"))
    page.page.get_by_text(f"At u = {u:.4g}, v = ").first.wait_for()
    assert page.page.locator(".rl-pad").first.locator(HANDLE).count() == 7  # nothing was added
    page.press(page.page.get_by_role("slider", name="t, the place along").first, "ArrowRight", 1)
    page.press(page.page.get_by_role("slider", name="t, the place along").first, "ArrowLeft", 1)
    page.page.locator(".rl-place").first.and_(
        page.page.locator("[visibility='hidden']")
    ).first.wait_for(state="attached")


def test_lesson_07_lives(lab: LabSession) -> None:
    with run_whole(lab, LESSONS / "07_what_ubar_and_vbar_do.ipynb") as page:
        in_sight(page, THREE)
        space = page.wait_still(THREE, timeout=60)
        assert space.drawn > 2000
        page.page.get_by_text("the congruence is elliptic").first.wait_for()

        pair = page.page.get_by_role("combobox", name="ū, v̄").first
        pair.select_option("Touching a sphere anywhere")
        page.wait_change(space, THREE)
        page.page.get_by_text("the congruence is hyperbolic").first.wait_for()
        said = page.page.locator(".rl-said", has_text="49 hyperbolic").first
        said.wait_for(state="attached")
        assert page.page.locator(".rl-signs").first.evaluate("g => g.textContent.length") == 49
        look_around(page)
        page.page.get_by_label("focal surfaces").first.check()
        page.press(page.page.get_by_role("slider", name="u of the place").first, "ArrowRight", 10)
        page.page.get_by_text("At u = 0.49,").first.wait_for()
        page.wait_still(THREE)
        page.screenshot("lesson-07")

        answer_the_first(page, "07.1")

        page.dark()
        page.command("application:toggle-left-area")
        page.resize(650, 1000)
        page.page.wait_for_timeout(500)  # JupyterLab lays its cells out anew
        in_sight(page, THREE)
        page.wait_still(THREE)
        page.screenshot("lesson-07-narrow-dark")
        assert page.faults() == []
