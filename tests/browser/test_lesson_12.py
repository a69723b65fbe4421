"""Lesson 12 in a real browser: a finding is chosen, a point moves, an exercise is answered."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from .session import LabSession, NotebookPage
from .test_lessons import LESSONS, run_whole

PICTURE = "svg.ruledlab-pm"


@pytest.fixture(scope="module")
def lesson(lab: LabSession) -> Iterator[NotebookPage]:
    path: Path = LESSONS / "12_reading_a_paper.ipynb"
    with run_whole(lab, path) as page:
        yield page


def test_printed_and_mended_are_shown_and_follow_the_hand(lesson: NotebookPage) -> None:
    page = lesson.page
    picture = page.locator(PICTURE).first
    picture.scroll_into_view_if_needed()
    first = picture.get_attribute("aria-label") or ""
    assert first.startswith("Torsion τ, §4, (18).")
    slider = page.get_by_role("slider", name="v, colatitude in radians").first
    lesson.press(slider, "ArrowRight", 5)
    page.wait_for_function(
        "([target, old]) => document.querySelector(target)?.getAttribute('aria-label') !== old",
        arg=[PICTURE, first],
    )
    menu = page.get_by_role("combobox", name="the findings, in the order of the paper").first
    menu.select_option(index=20)
    page.wait_for_function(
        "target => document.querySelector(target)?.getAttribute('aria-label').includes('pair')",
        arg=PICTURE,
    )
    assert page.locator(f"{PICTURE} circle.is-mended").first.is_visible()
    assert lesson.sticks_out() == []


def test_an_exercise_of_lesson_12_is_answered(lesson: NotebookPage) -> None:
    card = lesson.page.locator(".ruledlab-lesson").first
    card.scroll_into_view_if_needed()
    for row, word in ((0, "This line is right"), (1, "This is the line")):
        card.get_by_role("radio").nth(row).click()
        card.get_by_role("button", name="This line").first.click()
        card.get_by_text(word).first.wait_for()
    lesson.screenshot("lesson-12-exercise")
    assert lesson.faults() == []
