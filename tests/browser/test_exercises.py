"""One exercise of each kind, played in a real browser from the first look to the mark."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Locator, expect

from .session import LabSession, NotebookPage, write_notebook

KINDS = {
    "choose": "06.1",
    "number": "06.3",
    "formula": "06.6",
    "drag": "06.9",
    "sketch": "06.11",
    "code": "06.13",
    "slip": "06.14",
    "place": "02.12",
}
SHOW = """\
from ruledlab.exercises import check, exercise, find, seed
cards = {{key: exercise(key) for key in {keys}}}
tasks = {{key: find(key).task(seed()) for key in cards}}
from dataclasses import asdict
from ipywidgets import VBox
VBox(list(cards.values()))
"""


@pytest.fixture(scope="module")
def cards(lab: LabSession, tmp_path_factory: pytest.TempPathFactory) -> Iterator[NotebookPage]:
    code = SHOW.format(keys=list(KINDS.values()))
    path = write_notebook(tmp_path_factory.mktemp("exercises") / "exercises.ipynb", code)
    with lab.notebook(path) as page:
        assert page.run_all() == []
        page.page.locator(".ruledlab-field input").first.wait_for()
        yield page
        assert page.errors() == []
        assert page.console_errors == []


def card(page: NotebookPage, key: str) -> Locator:
    found = page.page.locator(".ruledlab-exercise").filter(
        has=page.page.locator(".ruledlab-number", has_text=key).get_by_text(key, exact=True)
    )
    found.first.scroll_into_view_if_needed()
    return found.first


def asked(page: NotebookPage, code: str) -> Any:
    """What an expression about `tasks` is, by JSON."""
    return json.loads(page.kernel_exec(f"import json; print(json.dumps({code}))"))


def done(page: NotebookPage, key: str) -> None:
    card(page, key).get_by_text("✓ done").wait_for(timeout=20_000)
    page.screenshot(f"exercise-{key}")


def pick(place: Locator, row: int, button: str) -> None:
    place.get_by_role("radio").nth(row).click()
    place.get_by_role("button", name=button).first.click()


def test_choose(cards: NotebookPage) -> None:
    key = KINDS["choose"]
    shown, right = (asked(cards, f"tasks['{key}'].{what}") for what in ("shown", "right_answer()"))
    place = card(cards, key)
    wrong = next(row for row, option in enumerate(shown) if option != right)
    pick(place, wrong, "Check")
    place.get_by_text("begun").wait_for()
    pick(place, shown.index(right), "Check")
    done(cards, key)


def test_answers_are_named_with_their_formulas(cards: NotebookPage) -> None:
    """A screen reader says a radio button's name: formulas must be in it, and tell them apart."""
    place = card(cards, KINDS["choose"])
    place.get_by_role("radio", name="C²: τ passes the seam without a jump", exact=True).wait_for()
    lines = card(cards, KINDS["slip"]).get_by_role("radio")
    names = [row.get_attribute("aria-label") or "" for row in lines.all()]
    assert len(set(names)) == len(names)
    assert "κ to the 2 = u′ to the 2 sin to the 2 v + v′ to the 2" in names


def test_number_with_a_hint(cards: NotebookPage) -> None:
    key = KINDS["number"]
    place = card(cards, key)
    place.get_by_role("button", name="Hint").click()
    place.locator(".ruledlab-hint").first.wait_for()
    field = place.locator(".ruledlab-field input")
    field.fill("banana")
    field.press("Enter")
    place.get_by_text("banana").first.wait_for()  # a word about what cannot be read
    field.fill(asked(cards, f"tasks['{key}'].right_answer()"))
    field.press("Enter")
    place.get_by_text("✓ done with 1 hint").wait_for()
    cards.screenshot(f"exercise-{key}")


def test_keys_pressed_in_a_card_are_no_commands_of_the_page(cards: NotebookPage) -> None:
    place = card(cards, KINDS["number"])
    count = "window.jupyterapp.shell.currentWidget.content.widgets.length"
    before = cards.page.evaluate(count)
    for part in ("Check", "hint", "solution"):
        cards.press(place.get_by_role("button", name=part).first, "b")
        cards.press(place.get_by_role("button", name=part).first, "x")
    assert cards.page.evaluate(count) == before
    field = place.locator(".ruledlab-field input")
    field.fill("pear")
    field.press("Shift+Enter")  # an answer, and not the cell run again
    place.get_by_text("pear").first.wait_for()
    assert field.input_value() == "pear"


def test_what_is_said_to_an_answer_has_a_place_that_is_there_before(cards: NotebookPage) -> None:
    for key in (KINDS["choose"], KINDS["formula"]):
        roles = card(cards, key).get_by_role("status")
        assert roles.count() >= 1


def test_formula(cards: NotebookPage) -> None:
    key = KINDS["formula"]
    field = card(cards, key).locator(".ruledlab-field input")
    assert field.get_attribute("placeholder") == "a formula in t"
    answer = asked(cards, f"tasks['{key}'].right_answer()")
    field.fill(f"({answer}) + 1")
    field.press("Enter")
    card(cards, key).get_by_text("begun").wait_for()
    field.fill(f"0 + ({answer})*1")
    field.press("Enter")
    done(cards, key)


def test_drag(cards: NotebookPage) -> None:
    """The sliders of the exercise's own chart move points until its conditions hold."""
    key = KINDS["drag"]
    place = card(cards, key)
    open_conditions = place.locator(".ruledlab-marks .is-open")
    assert open_conditions.count() > 0
    model = f"cards['{key}'].task.model"
    for index, (u, v) in enumerate(asked(cards, f"{model}.points")):
        cards.kernel_exec(f"cards['{key}'].box.lab.choose({index})")
        for name, value in (("u, longitude", u), ("v, colatitude", v)):
            field = place.get_by_role("textbox", name=name)
            field.fill(repr(value))
            field.press("Enter")
        if place.get_by_text("✓ done").count():
            break
    done(cards, key)


def test_place(cards: NotebookPage) -> None:
    """Line B is moved by pointer and by keys, and brought home by exact numbers."""
    key = KINDS["place"]
    place = card(cards, key)
    cards.wait_still(place.locator("canvas"), timeout=60)
    lines = f"cards['{key}'].box.slate.value"
    marks = place.locator(".ruledlab-marks")
    first = marks.inner_text()
    cards.pull("given point of line B", (30, -25))
    expect(marks).not_to_have_text(first, use_inner_text=True)
    place.get_by_role("button", name="direction of line B").focus()
    before = asked(cards, f"{lines}.numbers")
    for _ in range(2):
        cards.page.keyboard.press("ArrowLeft")
    cards.wait_kernel(f"{lines}.numbers != {before}", "True")
    cards.wait_idle()
    reached = asked(cards, f"{lines}.numbers")
    place.get_by_role("button", name="Show the solution").click()
    expect(marks.locator(".is-met")).to_have_count(2)
    assert place.get_by_text("✓ done").count() == 0
    place.get_by_role("button", name="undo").click()
    expect(marks.locator(".is-open")).to_have_count(2)
    assert asked(cards, f"{lines}.numbers") == reached
    place.get_by_role("button", name="Hide the solution").click()
    for name, value in asked(cards, f"asdict(tasks['{key}'].model.b)").items():
        field = place.get_by_role("textbox", name=f"{name}, " if name in "uv" else f"{name} of")
        field.fill(repr(value))
        field.press("Enter")
    done(cards, key)


def draw(page: NotebookPage, place: Locator, parts: list[float]) -> None:
    """Draw a curve with the pointer; its heights as parts of the frame from below."""
    box = place.locator(".ruledlab-frame").bounding_box()
    assert box is not None
    last = len(parts) - 1
    spots = [
        (box["x"] + box["width"] * k / last, box["y"] + box["height"] * (1 - part))
        for k, part in enumerate(parts)
    ]
    page.page.mouse.move(*spots[0])
    page.page.mouse.down()
    for spot in spots[1:]:
        page.page.mouse.move(*spot)
    page.page.mouse.up()


def test_sketch(cards: NotebookPage) -> None:
    key = KINDS["sketch"]
    place = card(cards, key)
    place.get_by_role("button", name="Show the solution").click()
    place.locator(".ruledlab-key.is-true").wait_for()
    place.get_by_role("button", name="Draw again").click()  # who has seen it may draw all the same
    place.locator(".ruledlab-key.is-true").wait_for(state="hidden")
    place.get_by_role("button", name="Hide the solution").click()
    heights = asked(cards, f"[float(y) for y in tasks['{key}'].right_answer()]")
    low, high = asked(cards, f"list(tasks['{key}'].heights)")
    draw(cards, place, [0.9] * 20)
    place.get_by_role("button", name="Compare").click()
    place.get_by_text("Not yet.").wait_for()
    place.locator(".ruledlab-key.is-true").wait_for()  # the true curve is shown over it
    place.get_by_role("button", name="Draw again").click()
    place.locator(".ruledlab-sketch.is-empty").wait_for()
    draw(cards, place, [(y - low) / (high - low) for y in heights])
    place.get_by_role("button", name="Compare").click()
    done(cards, key)


def test_code(cards: NotebookPage) -> None:
    """A value that is checked in a cell marks the card."""
    key = KINDS["code"]
    cards.kernel_exec(f"check('{key}', tasks['{key}'].right_answer())")
    done(cards, key)


def test_slip(cards: NotebookPage) -> None:
    key = KINDS["slip"]
    place = card(cards, key)
    wrong = asked(cards, f"tasks['{key}'].wrong_line")
    lines = place.locator(".ruledlab-printed")
    pick(lines, wrong, "This line")
    then = asked(cards, f"tasks['{key}'].right_answer()['then']")
    kind = asked(cards, f"tasks['{key}'].then.kind")
    if kind == "choose":
        shown = asked(cards, f"tasks['{key}'].then.shown")
        second = place.locator(".ruledlab-options").nth(1)
        pick(second, shown.index(then), "Check")
    else:
        field = place.locator(".ruledlab-field input")
        field.fill(then)
        field.press("Enter")
    done(cards, key)


def test_no_card_sticks_out_of_a_narrow_notebook(cards: NotebookPage) -> None:
    """In a window of 650 pixels without the file browser, every kind of exercise has its room."""
    cards.command("application:toggle-left-area")
    cards.resize(650, 900)
    try:
        cards.page.wait_for_timeout(500)
        assert cards.sticks_out() == []
    finally:
        cards.resize(1400, 1000)
        cards.command("application:toggle-left-area")


def test_no_card_has_barriers(cards: NotebookPage) -> None:
    assert cards.barriers() == []
