"""What the reader moves: sliders, fields, menus and buttons, bound to a `Lab`.

Every control follows the lab and asks it for changes; none of them draws or computes. What a
control could not do is said beside it. All handlers run under the control's own guard, which shows
a programming error instead of losing it: an exception in a widget's handler appears nowhere else.
"""

from __future__ import annotations

import functools
import html
import math
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from typing import Any

import ipywidgets as w
import numpy as np

from ..design import CLOSINGS, Design
from ..geometry.checks import GeometryError
from ..geometry.choices import CHOICES
from ..geometry.curve import Bezier, close, drag, insert, remove
from ..geometry.field import field, named_number, number
from ..geometry.formula import FormulaError
from ..geometry.gallery import GALLERY, Example
from ..geometry.written import tidied
from .scene import SYMBOLS
from .slate import Change, Slate
from .state import Lab

__all__ = [
    "FieldControl",
    "GalleryControl",
    "HistoryControl",
    "LookControl",
    "NumberControl",
    "Player",
    "PointControl",
    "Readouts",
    "TimeControl",
]

PAUSE = 0.8
"""Seconds without a move after which the next move of a slider is a new step of undo."""

TURN = 2 * math.pi

STEPS = 400
"""Steps of the cursor over the whole domain."""

CLOSING_WORDS = {
    "open": "open",
    "C0": "closed, C⁰ (meets)",
    "C1": "closed, C¹ (equal spacing)",
    "C2": "closed, C² (equal second differences)",
}

UNITS = {
    "kappa": "rad per t",
    "kappa_bar": "length per t",
    "tau": "rad per t",
    "tau_bar": "length per t",
    "sigma": "rad",
    "delta": "length",
}


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


class NumberControl:
    """A slider and a field for the same number; the field takes formulas such as ``3*pi/8``.

    Parameters
    ----------
    group
        the life it belongs to.
    label
        what stands before the slider; it may hold HTML.
    name
        the plain name, for error messages and screen readers.
    span
        the ends of the slider; a typed number beyond them moves them.
    step
        the slider's step.
    commit
        called with the new number.
    whole
        whether only whole numbers are meant.
    fixed
        whether numbers beyond the ends are refused rather than moving them.
    """

    def __init__(
        self,
        group: Group,
        label: str,
        name: str,
        span: tuple[float, float],
        step: float,
        commit: Callable[[float], Any],
        *,
        whole: bool = False,
        fixed: bool = False,
    ) -> None:
        self._group, self._name, self._commit = group, name, commit
        self._whole, self._fixed = whole, fixed
        self._value, self._refused = math.nan, False
        self.ends = span
        kind = w.IntSlider if whole else w.FloatSlider
        room = w.Layout(flex="1 1 80px", min_width="60px", width="auto")
        self.slider = kind(min=span[0], max=span[1], step=step, readout=False, layout=room)
        self.slider.tooltip = name
        self._echoes = Echoes(near=1e-6 * step)
        self.field = w.Text(
            continuous_update=False, layout=w.Layout(width="104px", flex="0 0 auto")
        )
        self.field.tooltip = f"{name}: a number or a formula such as 3*pi/8"
        self.error = w.HTML()
        self.label = w.HTML(f'<span class="ruledlab-label" title="{name}">{label}</span>')
        row = w.HBox([self.label, self.slider, self.field]).add_class("ruledlab-row")
        self.widget = w.VBox([row, self.error])
        group.on(self.slider, "value", self._slid)
        group.on(self.field, "value", self._typed)

    def show(self, value: float) -> None:
        """Show a number; the slider reaches as far as it needs to while it lies beyond ``ends``."""
        self._value, self._refused = value, False
        span = self._span(value)
        place = self._on_grid(value, **span)
        if abs(place - self.slider.value) < 1e-6 * self.slider.step:
            place = self.slider.value  # sent back, it would undo what the reader has moved since
        else:
            self._echoes.sent(place)
        self._group.put(self.slider, **span, value=place)
        text = str(int(value)) if self._whole else named_number(value)
        self._group.put(self.field, value=text)
        self.say(None)

    def _span(self, value: float) -> dict[str, float]:
        (low, high), step = self.ends, self.slider.step
        return {
            "min": low if value >= low else step * math.floor(value / step),
            "max": high if value <= high else step * math.ceil(value / step),
        }

    def _on_grid(self, value: float, min: float, max: float) -> float:
        """Return the nearest place the slider can stand at; elsewhere the browser moves it back."""
        if self._whole:
            return value
        step = self.slider.step
        place = min + step * round((value - min) / step)
        return place if place <= max else max

    def say(self, text: str | None, pointer: str = "") -> None:
        """Show what is wrong, or nothing."""
        self._group.put(self.error, value=error_html(text, pointer) if text else "")

    def refuse(self, text: str) -> None:
        """Say why the last number cannot be; the slider's way back to the one shown is a move."""
        self._refused = True
        self.say(text)

    def _slid(self, value: float) -> None:
        # The browser also reports the grid place of a value that was typed between two of them.
        if abs(value - self._value) <= 0.501 * self.slider.step and not self._refused:
            return
        if self._echoes.heard(value):
            self.show(self._value)  # what is here of the slider has gone back with the echo
        else:
            self._commit(round(value, 12))

    def _typed(self, text: str) -> None:
        try:
            strict = readable(text, (), lambda typed: number(typed, self._name))
            value = self._allowed(number(strict, self._name))
            if value == self._value:
                self.show(value)  # nothing will change, but an earlier message has to go
            self._commit(value)
        except FormulaError as error:
            self.say(plain(str(error)), error.pointer(28))
        except GeometryError as error:
            self.say(plain(str(error)))

    def _allowed(self, value: float) -> float:
        if self._whole and value != int(value):
            raise GeometryError(f"{self._name} must be a whole number; got {value:g}")
        low, high = self.ends
        if self._fixed and not low <= value <= high:
            raise GeometryError(
                f"{self._name} must lie between {low:g} and {high:g}; got {value:g}"
            )
        return int(value) if self._whole else value


class PointControl(Group):
    """The chosen control point, the number of points, and how the curve closes."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self.lab, self._strokes = lab, Strokes()
        self.u = NumberControl(
            self,
            "u",
            "u, longitude in radians",
            (-3.15, 6.3),
            0.01,
            functools.partial(self._move, 0),
        )
        self.v = NumberControl(
            self,
            "v",
            "v, colatitude in radians",
            (0.0, 3.15),
            0.01,
            functools.partial(self._move, 1),
        )
        self.count = NumberControl(
            self,
            "degree",
            "degree of the curve: one less than its control points",
            (1, 20),
            1,
            self._raise_to,
            whole=True,
        )
        self.chosen = w.Dropdown(layout=w.Layout(width="110px"))
        self.closing = w.Dropdown(
            options=[(words, key) for key, words in CLOSING_WORDS.items()],
            layout=w.Layout(width="auto", flex="1 1 120px"),
        )
        self.error = w.HTML(error_html(None))
        label = w.HTML('<span class="ruledlab-label">point</span>')
        seam = w.HTML('<span class="ruledlab-label">curve</span>')
        self.widget = w.VBox(
            [
                w.HBox([label, self.chosen]).add_class("ruledlab-row"),
                self.u.widget,
                self.v.widget,
                self.count.widget,
                w.HBox([seam, self.closing]).add_class("ruledlab-row"),
                self.error,
            ]
        )
        self.on(self.chosen, "value", lab.choose)
        self.on(self.closing, "value", self._close)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    # -- what is asked of the lab: also by the pad -----------------------------------------------

    def place(self, index: int, to: Sequence[float], group: object) -> bool:
        """Move one control point; the closing condition stays."""
        order = CLOSINGS[self.lab.design.closing]
        return self._edit(
            lambda points: drag(points, index, np.asarray(to, dtype=float), order), group
        )

    def insert_at(self, index: int, at: Sequence[float]) -> bool:
        """Put a new control point before the present one of that index, and choose it."""
        order = CLOSINGS[self.lab.design.closing]
        count = len(self.lab.design.points)
        index = max(1, min(index, count - 1)) if order >= 0 else max(0, min(index, count))
        if self._edit(lambda points: _inserted(points, index, at, order)):
            self.lab.choose(index)
            return True
        return False

    def remove_at(self, index: int) -> bool:
        """Take a control point away."""
        order = CLOSINGS[self.lab.design.closing]
        return self._edit(lambda points: remove(points, index, order))

    # -- inside ----------------------------------------------------------------------------------

    def _edit(self, change: Callable[[Any], Any], group: object = None) -> bool:
        def make() -> Design:
            design = self.lab.design
            return design.with_(points=change(np.array(design.points)))

        return self.lab.attempt("points", make, group)

    def _move(self, axis: int, value: float) -> None:
        index = self.lab.chosen
        to = list(self.lab.design.points[index])
        to[axis] = value
        self.place(index, to, self._strokes.token((index, axis)))

    def _raise_to(self, degree: float) -> None:
        order, steps = (
            CLOSINGS[self.lab.design.closing],
            int(degree) - len(self.lab.design.points) + 1,
        )

        def changed(points: Any) -> Any:
            curve = Bezier(points)
            if steps >= 0:
                return curve.raised(steps).points if steps else points
            return close(curve.lowered(-steps).points, order)

        if not self._edit(changed, self._strokes.token("degree")):
            self.count.show(len(self.lab.design.points) - 1)

    def _close(self, closing: str) -> None:
        self.lab.attempt("points", lambda: self.lab.design.closed_with(closing))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source == "points":
                self.put(self.error, value=error_html(plain(change.error)))
                self.put(self.closing, value=self.lab.design.closing)
            return
        if change.scene or change.chosen or change.source == "points":
            self.put(self.error, value=error_html(None))
            self._show()

    def _show(self) -> None:
        design, index = self.lab.design, self.lab.chosen
        last = len(design.points) - 1
        options = [(f"{i} of 0…{last}", i) for i in range(last + 1)]
        if len(self.chosen.options) != len(options):
            self.put(self.chosen, options=options)
        self.put(self.chosen, value=index)
        self.u.show(design.points[index][0])
        self.v.show(design.points[index][1])
        self.count.show(last)
        self.put(self.closing, value=design.closing)


def _inserted(points: Any, index: int, at: Sequence[float], order: int) -> Any:
    place = np.asarray(at, dtype=float)
    if 0 < index < len(points):
        return insert(points, index - 1, place, order)
    return np.insert(points, index, place, axis=0)


WHOLE = ("pair", "reset", "gallery", "share")
"""Sources that put both formulas in place: what was typed wrong before is gone."""


class FieldControl(Group):
    """The choices ū(u, v) and v̄(u, v): named pairs, and a menu and a typed formula for each."""

    MENU = ("0", "1", "u", "v", "u - v", "u + v", "0.5*u", "sin(2*u)", "cos(v)", "sin(u)*v")

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self._waiting: dict[str, str] = {}
        self.pair = w.Dropdown(
            options=[("named choices …", "")] + [(choice.title, choice.key) for choice in CHOICES],
            layout=w.Layout(width="auto", flex="1 1 120px"),
        )
        self.meaning = w.HTML()
        self.rows = {
            name: self._row(name, symbol) for name, symbol in (("ubar", "ū"), ("vbar", "v̄"))
        }
        self.typeset = w.HTMLMath()
        label = w.HTML('<span class="ruledlab-label">ū, v̄</span>')
        self.widget = w.VBox(
            [
                w.HBox([label, self.pair]).add_class("ruledlab-row"),
                *(box for _, _, _, box in self.rows.values()),
                self.typeset,
                self.meaning,
            ]
        )
        self.on(self.pair, "value", self._choose)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    def _row(self, name: str, symbol: str) -> tuple[Any, Any, Any, Any]:
        typed = w.Text(continuous_update=False, layout=w.Layout(width="auto", flex="1 1 90px"))
        typed.tooltip = f"{symbol}(u, v): a formula such as sin(2*u)*v"
        menu = w.Dropdown(
            options=[("…", ""), *((text, text) for text in self.MENU)],
            layout=w.Layout(width="72px", flex="0 0 auto"),
        )
        menu.tooltip = f"formulas for {symbol}"
        error = w.HTML()
        label = w.HTML(f'<span class="ruledlab-label">{symbol} =</span>')
        row = w.HBox([label, typed, menu]).add_class("ruledlab-row")
        self.on(typed, "value", lambda text: self._type(name, text))
        self.on(menu, "value", lambda text: text and self._type(name, text))
        return typed, menu, error, w.VBox([row, error])

    def _type(self, name: str, text: str) -> None:
        try:
            meant = readable(text, ("u", "v"), lambda typed: field(typed, name))
        except FormulaError as error:
            self._say(name, plain(error.message), error.pointer(40))
            return
        self._lab.edit(name, **{name: meant})

    def _choose(self, key: str) -> None:
        for choice in CHOICES:
            if choice.key == key:
                self._lab.edit("pair", ubar=choice.ubar, vbar=choice.vbar)

    def _say(self, name: str, text: str, pointer: str = "") -> None:
        """Show what is wrong with a formula, which stays in its field to be mended."""
        self._waiting[name] = getattr(self._lab.design, name)
        self.put(self.rows[name][2], value=error_html(text, pointer))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source in self.rows:
                self._say(change.source, plain(change.error))
            return
        if change.scene or change.source in (*self.rows, *WHOLE):
            self._show(change.source)

    def _show(self, source: str) -> None:
        design = self._lab.design
        for name, (typed, menu, error, _) in self.rows.items():
            formula = getattr(design, name)
            if self._waiting.get(name) != formula or source in (name, *WHOLE):
                self._waiting.pop(name, None)
                self.put(typed, value=formula)
                self.put(error, value="")
            self.put(menu, value="")
        ubar, vbar = (field(getattr(design, name)).latex for name in self.rows)
        self.put(self.typeset, value=rf"$\bar u = {ubar},\qquad \bar v = {vbar}$")
        named = next((c for c in CHOICES if (c.ubar, c.vbar) == (design.ubar, design.vbar)), None)
        self.put(self.pair, value=named.key if named else "")
        meaning = html.escape(named.meaning) if named else ""
        self.put(self.meaning, value=f'<div class="ruledlab-note">{meaning}</div>')


class Player:
    """Buttons that let a number run by itself, in equal steps between two ends.

    Who moves the number meanwhile takes it out of the run, which pauses.

    Parameters
    ----------
    group
        the life it belongs to.
    words
        what runs and where, for the names of the buttons.
    commit
        called with each number of the run.
    back
        whether a run leads to the end and back, so that it can be repeated without a jump.
    """

    PACE = 2  # of the steps at a time

    def __init__(
        self, group: Group, words: str, commit: Callable[[float], Any], *, back: bool = False
    ) -> None:
        self._group, self._commit, self._span = group, commit, (0.0, 1.0)
        self._asking, self._taken, self._shown = False, False, 0.0
        last = 2 * STEPS if back else STEPS
        self.widget = w.Play(max=last, step=self.PACE, interval=50, show_repeat=True)
        self.widget.tooltip = words
        group.on(self.widget, "value", self._played)
        group.on(self.widget, "playing", self._pressed)

    def show(self, value: float, span: tuple[float, float]) -> None:
        """Let the next run go on from this number, in the direction of the last one."""
        moved = abs(value - self._shown) > 1e-9 * (span[1] - span[0])
        self._shown, self._span = value, span
        if moved and self.widget.playing and not self._asking:
            self._taken = True
            self._group.put(self.widget, playing=False)
        start, end = span
        part = min(max((value - start) / (end - start), 0.0), 1.0)
        # Between two steps the button would stop before the end, and never start from there.
        step = self.PACE * round(part * STEPS / self.PACE)
        returning = self.widget.value > STEPS
        self._group.put(self.widget, value=2 * STEPS - step if returning else step)

    @property
    def running(self) -> bool:
        """Whether a run is on; its last number may come in one message with word of its end."""
        return self._asking or self.widget.playing

    def _pressed(self, playing: bool) -> None:
        self._taken = self._taken and not playing

    def _played(self, step: int) -> None:
        if self._taken:  # a step that was on its way when the run was paused
            self.show(self._shown, self._span)
            return
        start, end = self._span
        part = STEPS - abs(STEPS - step)
        self._asking = True
        try:
            self._commit(start + (end - start) * part / STEPS)
        finally:
            self._asking = False


class TimeControl(Group):
    """The cursor t: play, slide, type."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.player = Player(self, "t, along the curve", lab.move_cursor)
        self.play = self.player.widget
        self.t = NumberControl(
            self,
            "t",
            "t, the place along the curve",
            lab.result.surface.domain,
            1 / STEPS,
            lab.move_cursor,
            fixed=True,
        )
        self.widget = w.VBox([w.HBox([self.play, self.t.widget]).add_class("ruledlab-time")])
        self.t.widget.layout.flex = "1 1 200px"
        self.follow(lab, self.update)
        self.update(Change(mark=True))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.mark:
            self.t.show(self._lab.cursor)
            self.player.show(self._lab.cursor, self._lab.result.surface.domain)


class HistoryControl(Group):
    """Undo, redo, back to the beginning."""

    def __init__(self, state: Slate[Any, Any]) -> None:
        super().__init__()
        self._state = state
        self.undo = _button("undo", "undo", "take the last change back")
        self.redo = _button("redo", "repeat", "make the undone change again")
        self.reset = _button("reset", "refresh", "back to where this began")
        self.widget = w.HBox([self.undo, self.redo, self.reset])
        self.click(self.undo, state.undo)
        self.click(self.redo, state.redo)
        self.click(self.reset, state.reset)
        self.follow(state, self.update)
        self.update(Change())

    def update(self, _change: Change) -> None:
        """Follow the state."""
        self.put(self.undo, disabled=not self._state.can_undo)
        self.put(self.redo, disabled=not self._state.can_redo)


class GalleryControl(Group):
    """Named designs to begin from."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.menu = w.Dropdown(
            options=[("gallery …", "")] + [(example.title, example.key) for example in GALLERY],
            layout=w.Layout(width="auto", max_width="270px"),
        )
        self.menu.tooltip = "named surfaces"
        self.note = w.HTML()
        self.widget = self.menu
        self.on(self.menu, "value", self._choose)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    def _choose(self, key: str) -> None:
        for example in GALLERY:
            if example.key == key:
                self._lab.load(design_of(example), "gallery")

    def update(self, change: Change) -> None:
        """Follow the lab: the menu names the design only while it is that design."""
        if change.scene:
            design = self._lab.design
            found = next((e for e in GALLERY if is_design_of(e, design)), None)
            self.put(self.menu, value=found.key if found else "")
            note = f"<b>{html.escape(found.title)}.</b> {html.escape(found.note)}" if found else ""
            self.put(self.note, value=f'<div class="ruledlab-note">{note}</div>')


@functools.cache
def design_of(example: Example) -> Design:
    """Return a gallery surface as a design."""
    return Design(
        example.points, example.ubar, example.vbar, closing=example.closing, name=example.title
    )


def is_design_of(example: Example, design: Design) -> bool:
    """Whether a design is still the gallery's, whatever way it is drawn."""
    same = design_of(example)
    return (same.points, same.ubar, same.vbar) == (design.points, design.ubar, design.vbar)


class LookControl(Group):
    """What is drawn and how: ruling length, samples, colours, the sphere, the plots."""

    def __init__(self, lab: Lab, view: Any, plots: Any) -> None:
        super().__init__()
        self._lab, self._view, self._plots, self._strokes = lab, view, plots, Strokes()
        colourings = [("plain", "plain"), ("δ", "delta"), ("K", "gauss"), ("H", "mean")]
        self.colour = _menu("colour", colourings, "plain")
        self.sphere = _menu(
            "sphere", [("inset", "inset"), ("large", "large"), ("off", "off")], "inset"
        )
        self.home = _button("view", "home", "look from the usual side, all of it in sight")
        self.legend = w.HTML(layout=w.Layout(min_height="0"))
        self.length = NumberControl(
            self, "length", "length of the drawn rulings", (0.1, 10.0), 0.05, self._set_length
        )
        self.samples = NumberControl(
            self,
            "samples",
            "number of rulings computed",
            (50, 800),
            10,
            self._set_samples,
            whole=True,
            fixed=True,
        )
        self.base = _menu(
            "centred on", [("striction curve", "striction"), ("foot points", "foot")], "striction"
        )
        self.parts = [
            self._part(name, words)
            for name, words in (
                ("surface", "surface"),
                ("rulings", "rulings"),
                ("striction", "striction curve"),
                ("frame", "moving frame"),
            )
        ]
        self.quantities = {name: self._quantity(name) for name in SYMBOLS}
        self.bar = w.HBox([self.colour, self.sphere, self.home]).add_class("ruledlab-bar")
        self.plot_bar = w.HBox(list(self.quantities.values())).add_class("ruledlab-bar")
        self.more = w.VBox(
            [
                self.length.widget,
                self.samples.widget,
                w.HBox([self.base, *self.parts]).add_class("ruledlab-bar"),
            ]
        )
        self.on(self.colour, "value", lab.colour)
        self.on(self.sphere, "value", view.sphere)
        self.on(self.base, "value", lambda base: lab.edit("look", base=base))
        self.click(self.home, view.reset_view)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    def _part(self, name: str, words: str) -> Any:
        room = w.Layout(width="auto")
        box = w.Checkbox(value=True, description=words, indent=False, layout=room)
        self.on(box, "value", lambda shown: self._view.show(**{name: shown}))
        return box

    def _quantity(self, name: str) -> Any:
        shown = name in self._plots.names
        room = w.Layout(width="44px")
        button = w.ToggleButton(value=shown, description=SYMBOLS[name], layout=room)
        button.tooltip = f"plot {SYMBOLS[name]} over t ({UNITS[name]})"
        self.on(button, "value", lambda _: self._choose_plots())
        return button

    def _choose_plots(self) -> None:
        names = [name for name, button in self.quantities.items() if button.value]
        if names:
            self._plots.choose(names)
        else:  # at least one stays
            for name in self._plots.names:
                self.put(self.quantities[name], value=True)

    def _set_length(self, length: float) -> None:
        self._lab.edit("length", self._strokes.token("length"), length=length)

    def _set_samples(self, samples: float) -> None:
        self._lab.edit("samples", self._strokes.token("samples"), samples=int(samples))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source in ("length", "samples"):
                getattr(self, change.source).say(plain(change.error))
            return
        if change.scene:
            design = self._lab.design
            self.length.show(design.length)
            self.samples.show(design.samples)
            self.put(self.base, value=design.base)
            self.put(self.colour, value=self._lab.colouring)
            self.put(self.legend, value=self._view.legend_html(self._lab.result.scene))


class Readouts(Group):
    """The numbers: Λ = λ + ε l when the surface closes, otherwise why not and how far."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.closed = w.HTML()
        self.words = w.HTML()
        self.widget = w.VBox([self.closed])
        self._listening = True
        self.follow(lab, self.update)
        self.update(Change(scene=True, mark=True))
        self.listen(False)

    def listen(self, listening: bool) -> None:
        """Keep the words up to date, or let them rest while nobody can see them."""
        self._listening = listening
        self.update(Change(mark=True))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.scene:
            self.put(self.closed, value=_closed_html(self._lab))
        if self._listening and (change.scene or change.mark):
            self.put(self.words, value=_words_html(self._lab))


def _closed_html(lab: Lab) -> str:
    result = lab.result
    turn = shift = both = modulo = "–"
    if result.pitch is not None:
        exact = float(result.pitch.real)
        # Adding 0 makes a zero of −0; nearly a whole turn is none.
        real, dual = round(exact, 6) + 0.0, round(float(result.pitch.dual), 6) + 0.0
        left = exact % TURN if TURN - exact % TURN > 5e-7 else 0.0
        turn, shift, modulo = f"{real:.6f}", f"{dual:.6f}", f"{left:.6f}"
        both = f"{real:.4f} {'+' if dual >= 0 else '-'} ε {abs(dual):.4f}"
    rows = (
        ("angle of pitch", "λ", turn, "rad"),
        ("", "λ mod 2π", modulo, "rad"),
        ("pitch", "l", shift, "length"),
        ("dual angle of pitch", "Λ = λ + ε l", both, ""),
    )
    body = "".join(
        f"<tr><td>{name} <i>{symbol}</i></td><td>{value.replace('-', '−')}</td><td>{unit}</td></tr>"
        for name, symbol, value, unit in rows
    )
    note = _as_clause(html.escape(result.pitch_note))
    return (
        f'<table class="ruledlab-numbers">{body}</table>'
        f'<div class="ruledlab-note" role="status">The surface {note}.</div>'
    )


def _as_clause(note: str) -> str:
    return note.replace("not closed:", "does not close:", 1)


def _words_html(lab: Lab) -> str:
    scene, mark = lab.result.scene.text, lab.mark.text
    return (
        f'<div class="ruledlab-words-panel"><p>{html.escape(scene)}</p>'
        f"<p>{html.escape(mark)}</p></div>"
    )


def _button(words: str, icon: str, tooltip: str) -> Any:
    return w.Button(
        description=words,
        icon=icon,
        tooltip=tooltip,
        layout=w.Layout(width="auto", min_width="64px"),
    )


def _menu(words: str, options: list[tuple[str, str]], value: str) -> Any:
    return w.Dropdown(
        options=options,
        value=value,
        description=words,
        style={"description_width": "initial"},
        layout=w.Layout(width="auto", min_width="110px"),
    )
