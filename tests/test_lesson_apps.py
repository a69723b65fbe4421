"""Every app: each control to both ends and back leaves no error and the result of before."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import ipywidgets as w
import pytest
from ipywidgets.widgets.widget import _instances

from ruledlab import lab
from ruledlab.lab import apps
from ruledlab.lab.handles import Handles

APPS: dict[str, Callable[[], Any]] = {
    "studio": lab.studio,
    **{name: (lambda name=name: getattr(lab, name)()) for name in apps.LESSON_APPS},
}
NUMBER = re.compile(r"[−-]?\d+\.\d{3,}(e[+-]?\d+)?")
TINY = 1e-9


def parts(widget: Any) -> Iterator[Any]:
    """The widget and all below it."""
    yield widget
    for child in getattr(widget, "children", ()):
        yield from parts(child)


def ends(control: Any) -> tuple[Any, ...]:
    """The values to move a control to."""
    match control:
        case w.FloatSlider() | w.IntSlider() | w.FloatLogSlider():
            low, high = control.min, control.max
            is_log = isinstance(control, w.FloatLogSlider)
            return (control.base**low, control.base**high) if is_log else (low, high)
        case w.Checkbox() | w.ToggleButton():
            return (not control.value,)
        case w.Dropdown() | w.ToggleButtons() | w.RadioButtons() | w.Select():
            options = control._options_values
            return (options[0], options[-1]) if options else ()
    return ()


def rounded(text: str) -> str:
    """The text with its numbers rounded, and what is rounding only set to zero."""

    def short(match: re.Match[str]) -> str:
        value = float(match.group().replace("−", "-"))
        return "0" if abs(value) < TINY else f"{value:.5g}"

    return NUMBER.sub(short, text)


def said(app: Any) -> list[str]:
    """Everything the app says in words and numbers; limits of axes may stay wide."""
    texts = [part.value for part in parts(app) if isinstance(part, w.HTML)]
    return [rounded(text) for text in texts if "<svg" not in text]


def defects(app: Any) -> list[str]:
    return [group.defect.value for group in app._groups if group.defect.value]


@pytest.fixture(params=APPS, scope="module")
def app(request: pytest.FixtureRequest) -> Iterator[Any]:
    made = APPS[request.param]()
    yield made
    made.close()


def test_every_control_to_both_ends_and_back(app: Any) -> None:
    controls = [part for part in parts(app) if ends(part) and not part.disabled]
    assert controls
    for control in controls:
        before, value = said(app), control.value
        words = control.description or control.tooltip or type(control).__name__
        for end in ends(control):
            control.value = end
            assert defects(app) == [], words
        control.value = value
        assert defects(app) == [], words
        if said(app) != before and hasattr(app, "history"):
            app.history.reset.click()  # a menu that loads something has no way back of its own
        assert said(app) == before, words


def test_every_handle_to_far_corners_and_back(app: Any) -> None:
    """One drag far out of the picture; undo, or the way back, ends where it began."""
    for drag, handles in enumerate(part for part in parts(app) if isinstance(part, Handles)):
        for index, handle in enumerate(handles.picture["handles"]):
            if handle["x"] is None:
                continue
            before = said(app)
            for x, y in ((-3e3, -3e3), (3e3, 3e3), (handle["x"] + 30, handle["y"] - 20)):
                handles.motion = ["view", 100 * drag + index, index, x, y]
                assert defects(app) == [], handle["label"]
            handles.motion = ["view", 100 * drag + index, index, handle["x"], handle["y"]]
            if said(app) != before:
                app.history.undo.click()
            assert said(app) == before, handle["label"]


def test_a_star_brings_every_app_along() -> None:
    assert set(apps.LESSON_APPS) <= set(lab.__all__)
    assert all(callable(getattr(lab, name)) for name in apps.LESSON_APPS)


def test_undo_and_redo_lead_there_and_back(app: Any) -> None:
    if not hasattr(app, "history"):
        pytest.skip("nothing to undo")
    app.history.reset.click()
    state = app.history._state
    for slider in [part for part in parts(app) if isinstance(part, w.FloatSlider)]:
        start, value, at = said(app), state.value, slider.value
        slider.value = 0.5 * (slider.min + slider.max) + 3 * slider.step
        if state.value == value:  # what is looked at, not what is made
            slider.value = at
            continue
        moved = said(app)
        app.history.undo.click()
        assert said(app) == start
        app.history.redo.click()
        assert said(app) == moved
        app.history.undo.click()
    assert defects(app) == []


def test_pictures_are_said_in_words(app: Any) -> None:
    """Each drawing has a text for those who cannot see it, or is none for them."""
    texts = [part.value for part in parts(app) if isinstance(part, w.HTML)]
    outermost = [tag for text in texts if (tag := re.search(r"<svg[^>]*>", text))]
    unsaid = [tag[0] for tag in outermost if not re.search('role="img"|aria-hidden', tag[0])]
    assert unsaid == []
    assert re.search(r'role="img"[^>]*aria-label="[^"]{20,}', "".join(texts))


@pytest.mark.parametrize("name", APPS)
def test_closing_leaves_no_widget_open(name: str) -> None:
    before = set(_instances)
    made = APPS[name]()
    made.close()
    assert set(_instances) == before
    made.close()
