"""Lesson 04 in a real browser: one cursor through picture, plots, buttons and table."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .session import PLOTS, THREE, LabSession, NotebookPage
from .test_lessons import LESSONS, in_sight, run_whole

RIGHT = """\
from ruledlab.exercises import find, seed
task = find("04.1").task(seed())
print(task.shown.index(task.right_answer()))
"""


@pytest.fixture(scope="module")
def lesson(lab: LabSession) -> Iterator[NotebookPage]:
    with run_whole(lab, LESSONS / "04_the_invariants.ipynb") as page:
        yield page


def test_one_cursor_goes_through_all_of_lesson_04(lesson: NotebookPage) -> None:
    page = lesson.page
    in_sight(lesson, THREE)
    space = lesson.wait_still(THREE, timeout=60)
    in_sight(lesson, PLOTS)
    plots = lesson.wait_still(PLOTS)
    assert min(space.drawn, plots.drawn) > 2000
    page.get_by_role("button", name="4: torsal, t = 0.5556").first.click()
    assert lesson.wait_change(space, THREE) != space
    plots = lesson.wait_change(plots, PLOTS)
    # The pitch of the screw is 1.2 cos 3u, and cos 3u = −1/2 on a torsal ruling.
    assert "−0.6000" in page.locator(".ruledlab-numbers").first.inner_text()
    page.get_by_role("button", name="reverse").first.click()
    page.get_by_text("Reversed: τ, τ̄, σ changed, nothing else.").first.wait_for()
    assert "was 4.4429" in page.locator(".ruledlab-numbers").first.inner_text()
    plots = lesson.wait_change(plots, PLOTS)
    page.get_by_role("button", name="over s").first.click()
    assert lesson.wait_change(plots, PLOTS) != plots
    page.get_by_text("For each unit of s").first.wait_for()
    lesson.screenshot("lesson-04")
    assert lesson.errors() == []
    assert lesson.console_errors == []


def test_nothing_of_lesson_04_sticks_out_of_a_narrow_page(lesson: NotebookPage) -> None:
    lesson.resize(700, 1000)
    in_sight(lesson, PLOTS)
    lesson.page.wait_for_timeout(1000)
    assert lesson.sticks_out() == []
    lesson.screenshot("lesson-04-700")
    in_sight(lesson, ".ruledlab-sides")
    lesson.screenshot("lesson-04-table")
    lesson.resize(1500, 1000)


def test_an_exercise_of_lesson_04_is_answered(lesson: NotebookPage) -> None:
    card = lesson.page.locator(".ruledlab-exercise").first
    card.scroll_into_view_if_needed()
    card.get_by_role("radio").nth(int(lesson.kernel_exec(RIGHT))).click()
    card.get_by_role("button", name="Check").first.click()
    card.get_by_text("✓ done").wait_for()
    lesson.screenshot("lesson-04-exercise")
    assert lesson.faults() == []
