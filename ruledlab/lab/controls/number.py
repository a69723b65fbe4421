"""A number to slide, to type, and to let run."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import ipywidgets as w

from ...geometry.checks import GeometryError
from ...geometry.field import named_number, number
from ...geometry.formula import FormulaError
from .group import Echoes, Group, error_html, plain, readable

__all__ = ["STEPS", "NumberControl", "Player"]

STEPS = 400
"""Steps of the cursor over the whole domain."""


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
