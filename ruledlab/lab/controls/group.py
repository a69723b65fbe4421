"""What all controls share: their life and guard, errors in words, strokes of undo, small parts."""

from __future__ import annotations

import functools
import html
import threading
import time
import traceback
from collections.abc import Callable
from typing import Any

import ipywidgets as w

from ...geometry.checks import GeometryError
from ...geometry.formula import FormulaError
from ...geometry.written import tidied
from ..slate import Change, Slate

__all__ = [
    "PAUSE",
    "Echoes",
    "Group",
    "Strokes",
    "button",
    "defect_html",
    "error_html",
    "home_button",
    "menu",
    "plain",
    "readable",
]

PAUSE = 0.8
"""Seconds without a move after which the next move of a slider is a new step of undo."""


class Group:
    """Controls that share one life, one guard and one place for programming errors."""

    def __init__(self) -> None:
        self._quiet = threading.local()
        self._releases: list[Callable[[], None]] = []
        self.defect = w.HTML()

    def on(self, widget: Any, trait: str, handler: Callable[[Any], None]) -> None:
        """Call ``handler(value)`` when the reader changes a trait; not when `put` does."""

        def observer(change: dict[str, Any]) -> None:
            if not getattr(self._quiet, "depth", 0):
                self.guard(functools.partial(handler, change["new"]))

        widget.observe(observer, trait)
        self._releases.append(lambda: widget.unobserve(observer, trait))

    def click(self, button: Any, handler: Callable[[], Any]) -> None:
        """Call ``handler()`` when a button is pressed."""

        def pressed(_button: Any) -> None:
            self.guard(handler)

        button.on_click(pressed)
        self._releases.append(lambda: button.on_click(pressed, remove=True))

    def follow(self, state: Slate[Any, Any], update: Callable[[Change], None]) -> None:
        """Call ``update(change)`` for what happens in the state."""
        self._releases.append(state.follow(update))

    def guard(self, action: Callable[[], Any]) -> None:
        """Run an action; show what went wrong inside the program."""
        try:
            action()
        except Exception:  # shown: nothing else would
            self.defect.value = defect_html(traceback.format_exc())

    def put(self, widget: Any, **traits: Any) -> None:
        """Set traits without calling the handlers, and only those that differ.

        The handlers are deaf in this thread only: what the reader does meanwhile is heard.
        """
        self._quiet.depth = getattr(self._quiet, "depth", 0) + 1
        try:
            with widget.hold_trait_notifications():
                for name, value in traits.items():
                    if getattr(widget, name) != value:
                        setattr(widget, name, value)
        finally:
            self._quiet.depth -= 1

    def release(self) -> None:
        """Leave no observer behind."""
        while self._releases:
            self._releases.pop()()


def defect_html(text: str) -> str:
    """Return a programming error in red, folded away."""
    return (
        '<div role="alert"><details class="ruledlab-error"><summary>A defect of ruledlab: please '
        f"report what is in here.</summary><pre>{html.escape(text)}</pre></details></div>"
    )


def error_html(text: str | None, pointer: str = "") -> str:
    """Return a message as it stands beside a control; a line of its own height when empty."""
    if not text:
        return '<div class="ruledlab-error"></div>'
    caret = f"<pre>{html.escape(pointer)}</pre>" if pointer else ""
    return f'<div class="ruledlab-error" role="alert">{html.escape(text)}{caret}</div>'


def plain(text: str) -> str:
    """Return an error's words without the marks of code around argument names."""
    return text.replace("`", "")


def readable(text: str, letters: tuple[str, ...], read: Callable[[str], object]) -> str:
    """Return the text if it can be read, else what is meant by it: ``2*u`` for ``2u``.

    Parameters
    ----------
    text
        what was typed.
    letters
        the variables it may have.
    read
        reads a formula in strict notation or raises `FormulaError`.

    Raises
    ------
    FormulaError
        if neither can be read: the error of the text as it was typed.
    """
    try:
        read(text)
    except FormulaError as error:
        try:
            meant = tidied(text, letters)
            read(meant)
        except GeometryError:
            raise error from None
        return meant
    return text


class Strokes:
    """Which moves belong together: those of one control without a pause."""

    def __init__(self) -> None:
        self._last: tuple[object, float] = (None, 0.0)
        self._count = 0

    def token(self, key: object) -> tuple[int, object, int]:
        """Return a token that is equal for moves of one stroke, and for no others."""
        now = time.monotonic()
        if key != self._last[0] or now - self._last[1] > PAUSE:
            self._count += 1
        self._last = (key, now)
        return (id(self), key, self._count)


class Echoes:
    """Values that were sent to the browser and may come back as if the reader had chosen them.

    A slider reports a value it is given when its own rounding of it differs in the last digit. By
    then the value may be an old one: taken for a move, it would undo what has happened since.
    """

    LATEST = 0.8  # seconds after the last value sent; by then all of them have come back

    def __init__(self, near: float) -> None:
        self._near = near
        self._sent: list[float] = []
        self._end = 0.0

    def sent(self, value: float) -> None:
        """Expect a value back, once."""
        if time.monotonic() > self._end:
            self._sent.clear()
        self._sent.append(value)
        self._end = time.monotonic() + self.LATEST

    def heard(self, value: float) -> bool:
        """Whether this is a value that was sent; the same one a second time is not.

        Messages keep their order: after a move of the reader no earlier value will come back.
        """
        near = [sent for sent in self._sent if abs(sent - value) < self._near]
        if not near or time.monotonic() > self._end:
            self._sent.clear()
            return False
        self._sent.remove(near[0])
        return True


def button(words: str, icon: str, tooltip: str) -> Any:
    """Return a button with words and an icon."""
    return w.Button(
        description=words,
        icon=icon,
        tooltip=tooltip,
        layout=w.Layout(width="auto", min_width="64px"),
    )


def home_button() -> Any:
    """Return the button that brings a picture of space back into sight."""
    return button("view", "home", "look from the usual side, all of it in sight")


def menu(words: str, options: list[tuple[str, str]], value: str) -> Any:
    """Return a menu with words before it."""
    return w.Dropdown(
        options=options,
        value=value,
        description=words,
        style={"description_width": "initial"},
        layout=w.Layout(width="auto", min_width="110px"),
    )
