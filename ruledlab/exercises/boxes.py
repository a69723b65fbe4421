"""Where answers are given: one box for each kind of exercise."""

from __future__ import annotations

import html
import math
import pathlib
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import anywidget
import ipywidgets as w
import numpy as np
import traitlets

from ..lab.apps import chart
from ..lab.apps.base import close_all
from ..lab.apps.lesson_02 import LinesFigure
from ..lab.controls import FieldControl, Group, HistoryControl
from ..lab.palette import DARK, LIGHT
from ..lab.plots import CurvePlots
from ..lab.slate import Change, Slate
from ..lab.state import Lab
from ..pair import between
from .core import (
    UNREAD,
    Choose,
    Code,
    Condition,
    Drag,
    FindSlip,
    Formula,
    Goal,
    Number,
    Place,
    Sketch,
    Task,
)
from .record import STYLE
from .verdict import recognised

__all__ = [
    "LIVE",
    "Box",
    "ChooseBox",
    "DragBox",
    "GoalBox",
    "PlaceBox",
    "box_for",
    "close_all",
    "maths",
    "press",
    "show",
    "style",
]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_STYLE: Final = STYLE + (_STATIC / "exercises.css").read_text(encoding="utf-8")
PAUSE: Final = 0.7
"""Seconds after the last move of a design until it is saved."""

Submit = Callable[[Any], None]


# -- small parts -----------------------------------------------------------------------------------


class _Front(anywidget.AnyWidget):
    """The part of a box that needs the browser: rows to choose from, a field, a drawing."""

    _esm = _STATIC / "exercises.js"

    part = traitlets.Unicode("").tag(sync=True)
    label = traitlets.Unicode("").tag(sync=True)
    button = traitlets.Unicode("Check").tag(sync=True)
    unit = traitlets.Unicode("").tag(sync=True)
    example = traitlets.Unicode("").tag(sync=True)
    chosen = traitlets.Int(-1).tag(sync=True)
    text = traitlets.Unicode("").tag(sync=True)
    plot: traitlets.Dict[str, Any] = traitlets.Dict().tag(sync=True)
    sketch: traitlets.List[Any] = traitlets.List().tag(sync=True)
    truth: traitlets.List[Any] = traitlets.List().tag(sync=True)


def style() -> Any:
    """Return the style of all exercises, as a widget that shows nothing."""
    return w.HTML(f"<style>{_STYLE}</style>", layout=w.Layout(display="none"))


LIVE: Final = "ruledlab-live"
"""The class of what a screen reader speaks when it changes; ``names.js`` gives it its role."""


def maths(text: str, *classes: str) -> Any:
    """Return HTML with TeX between dollar signs, as a widget; it takes no room when empty."""
    made = w.HTMLMath()
    for name in classes:
        made.add_class(name)
    show(made, text)
    return made


def press(words: str, *classes: str, tooltip: str = "") -> Any:
    """Return a button."""
    made = w.Button(description=words, tooltip=tooltip, layout=w.Layout(width="auto"))
    for name in classes:
        made.add_class(name)
    return made


def show(widget: Any, text: str) -> None:
    """Put text into a widget; without any it takes no room."""
    if LIVE in widget._dom_classes:  # hidden, it would not be spoken when it comes
        (widget.remove_class if text else widget.add_class)("ruledlab-silent")
    else:
        display = "" if text else "none"
        if widget.layout.display != display:
            widget.layout.display = display
    if widget.value != text:
        widget.value = text


# -- one answer box for each kind ------------------------------------------------------------------


class Box:
    """Where an answer is given.

    Attributes
    ----------
    widget
        what is shown.
    """

    def __init__(self, group: Group, submit: Submit) -> None:
        self.group, self.submit = group, submit
        self.widget = w.VBox().add_class("ruledlab-box")

    def show(self, answer: Any) -> None:
        """Show an answer that was given earlier."""

    def reveal(self) -> None:
        """Show the solution in the box, where that is possible."""

    def close(self) -> None:
        """Let go of everything."""

    def listen(self, front: _Front, handler: Callable[[Mapping[str, Any]], None]) -> None:
        """Call ``handler(content)`` with what the browser says, under the group's guard."""

        def said(_widget: Any, content: Any, _buffers: Any) -> None:
            if isinstance(content, dict):
                self.group.guard(lambda: handler(content))

        front.on_msg(said)
        self.group._releases.append(lambda: front.on_msg(said, remove=True))


class ChooseBox(Box):
    """Rows to choose from; arrow keys move, Enter checks."""

    def __init__(
        self,
        group: Group,
        submit: Submit,
        texts: Sequence[str],
        order: Sequence[int],
        label: str,
        button: str = "Check",
    ) -> None:
        super().__init__(group, submit)
        self._order = tuple(order)
        rows = [maths(texts[i], "ruledlab-option") for i in self._order]
        self.front = _Front(part="choose", label=label, button=button)
        self.listen(self.front, self._said)
        self.widget.children = [*rows, self.front]
        self.widget.add_class("ruledlab-options")

    def _said(self, content: Mapping[str, Any]) -> None:
        match content:
            case {"chosen": int(row)} if 0 <= row < len(self._order):
                self.front.chosen = row
                self.submit(self._order[row])
            case {"chosen": _}:
                self.submit(None)

    def show(self, answer: Any) -> None:
        """Mark a row."""
        if isinstance(answer, int) and answer in self._order:
            self.front.chosen = self._order.index(answer)


class FieldBox(Box):
    """A field for a number, an array or a formula; Enter checks."""

    def __init__(
        self, group: Group, submit: Submit, label: str, unit: str = "", example: str = ""
    ) -> None:
        super().__init__(group, submit)
        self.front = _Front(part="field", label=label, unit=unit, example=example)
        self.listen(self.front, self._said)
        self.widget.children = [self.front]

    def _said(self, content: Mapping[str, Any]) -> None:
        match content:
            case {"text": str(text)}:
                self.front.text = text
                self.submit(text)

    def show(self, answer: Any) -> None:
        """Put a text into the field."""
        if isinstance(answer, str):
            self.front.text = answer


class SketchBox(Box):
    """A plane to draw in, with the pointer or with handles moved by keys."""

    def __init__(self, group: Group, submit: Submit, task: Sketch, say: Submit) -> None:
        super().__init__(group, submit)
        self._task, self._say = task, say
        self.front = _Front(part="sketch", label=task.label, button="Compare")
        self.front.plot = {
            "span": list(task.span),
            "heights": list(task.heights),
            "knots": task.KNOTS,
            "label": task.label,
            "colours": [_colour(LIGHT, task), _colour(DARK, task)],
        }
        self.listen(self.front, self._said)
        self.widget.children = [self.front]

    def _said(self, content: Mapping[str, Any]) -> None:
        match content:
            case {"sketch": list(heights)}:
                self.front.sketch = heights
                self.submit(heights)
            case {"again": _}:
                self.front.truth = []
                self.front.sketch = []
                self._say(None)

    def show(self, answer: Any) -> None:
        """Show a sketch, and the true curve over it."""
        if isinstance(answer, list) and len(answer) == self._task.KNOTS:
            self.front.sketch = answer
            self.reveal()

    def reveal(self) -> None:
        """Show the true curve."""
        self.front.truth = [
            None if not math.isfinite(y) else float(y) for y in self._task.curve(self._task.t)
        ]


def _colour(theme: Any, task: Sketch) -> str:
    return str(theme.quantity(task.quantity) if task.quantity else theme.tau)


class CodeBox(Box):
    """The lines to begin from, and the value that was checked last."""

    def __init__(self, group: Group, submit: Submit, task: Code, key: str) -> None:
        super().__init__(group, submit)
        lines = f'from ruledlab.exercises import check\n{task.starter}\ncheck("{key}", value)'
        self._last = w.HTML(layout=w.Layout(display="none"))
        self.widget.children = [
            w.HTML(
                '<div class="ruledlab-note">In a code cell of the notebook, replace the dots:</div>'
                f'<pre class="ruledlab-code">{html.escape(lines)}</pre>'
            ),
            self._last,
        ]

    def show(self, answer: Any) -> None:
        """Show the last value."""
        text = html.escape(str(answer)[:300])
        last = f'<div class="ruledlab-note">Your last value: <code>{text}</code></div>'
        show(self._last, last)


class SlipBox(Box):
    """The printed lines first, and once the wrong one is found, what should stand there."""

    def __init__(self, group: Group, submit: Submit, task: FindSlip, say: Submit) -> None:
        super().__init__(group, submit)
        self._task, self._say = task, say
        texts = [line.text for line in task.lines]
        self._lines = ChooseBox(
            group, self._line, texts, range(len(texts)), "the printed lines", "This line"
        )
        self._then = box_for(task.then, group, self._correct, "", self._say, None)
        self._second = w.VBox([maths(task.then.question, "ruledlab-question"), self._then.widget])
        self._second.layout.display = "none"
        self._lines.widget.add_class("ruledlab-printed")
        self.widget.children = [self._lines.widget, self._second]

    def _line(self, line: Any) -> None:
        verdict = self._task.judge_line(line)
        self._open(verdict.right)
        if verdict.right or verdict.state == UNREAD:
            self._say(verdict)
        else:
            self.submit({"line": line})

    def _open(self, shown: bool) -> None:
        self._second.layout.display = "flex" if shown else "none"

    def _correct(self, then: Any) -> None:
        self.submit({"line": self._task.wrong_line, "then": then})

    def show(self, answer: Any) -> None:
        """Show the line and the correction."""
        if isinstance(answer, dict):
            self._lines.show(answer.get("line"))
            self._open(answer.get("line") == self._task.wrong_line)
            self._then.show(answer.get("then"))


Part = tuple[Any, Callable[[], None]]
"""A widget, and what closes it."""


class GoalBox(Box):
    """What is moved, and its conditions with how far off each is, live.

    Attributes
    ----------
    slate
        the state of what is moved.
    draft
        called with the value when the hand rests.
    """

    def __init__(
        self,
        group: Group,
        submit: Submit,
        task: Goal[Any, Any],
        say: Submit,
        slate: Slate[Any, Any],
        parts: Sequence[Part],
    ) -> None:
        super().__init__(group, submit)
        self._task, self._say, self._met = task, say, False
        self.draft: Submit = lambda value: None
        self._timer: threading.Timer | None = None
        self.slate, self._parts = slate, parts
        self._conditions = maths("", "ruledlab-conditions", LIVE)
        self.widget.children = [self._conditions, *(part for part, _ in parts)]
        self._quiet = True  # opening it is no answer
        self._update(Change(scene=True))
        self._quiet = False
        group.follow(slate, self._update)

    def _update(self, change: Change) -> None:
        if not change.scene:
            return
        conditions = self._task.conditions(self.slate.result)
        show(self._conditions, conditions_html(conditions))
        if self._quiet:
            return
        was, self._met = self._met, all(condition.met for condition in conditions)
        if self._met and not was:
            self.submit(self.slate.value)
        elif not self._met:
            self._say(recognised(self._task.slips, self.slate.result))
        self._save_later()

    def _save_later(self) -> None:
        """Save when the hand rests: not at every move."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = threading.Timer(PAUSE, self._save)
        self._timer.daemon = True
        self._timer.start()

    def _save(self) -> None:
        self._timer = None
        self.group.guard(lambda: self.draft(self.slate.value))

    def show(self, answer: Any) -> None:
        """Put in place what was reached earlier."""
        self._load(self._task.value_of(answer))

    def _load(self, value: Any) -> None:
        """Put a value in place without taking it for the reader's answer."""
        self._quiet = True
        self.slate.load(value, "exercise")
        self._quiet = False
        self._met = all(c.met for c in self._task.conditions(self.slate.result))

    def reveal(self) -> None:
        """Show a value that fulfils the conditions; undo leads back."""
        self._load(self._task.model)

    def close(self) -> None:
        """Save what is not saved yet, let go of the state and of all parts."""
        if self._timer is not None:
            self._timer.cancel()
            self._save()
        for _, close in self._parts:
            close()


class DragBox(GoalBox):
    """The chart of a lab, with fields and plots where the task has them.

    Attributes
    ----------
    lab
        the lab, also if it was given and is shown elsewhere.
    """

    def __init__(
        self, group: Group, submit: Submit, task: Drag, say: Submit, lab: Lab | None
    ) -> None:
        self._given = lab is not None
        self.lab = Lab(task.start) if lab is None else lab
        parts = [] if self._given else _chart_parts(self.lab, task)
        super().__init__(group, submit, task, say, self.lab, parts)
        self.widget.add_class("ruledlab-drag")

    def show(self, answer: Any) -> None:
        """Open a design that was reached earlier; a lab that was given keeps its own."""
        if not self._given:
            super().show(answer)


def _chart_parts(lab: Lab, task: Drag) -> list[Part]:
    figure = chart(lab)
    parts = [_control(HistoryControl(lab)), (figure, figure.close)]
    if task.fields:
        parts.append(_control(FieldControl(lab)))
    if task.plots:
        parts.append(_plots(lab, task.plots, figure))
    return parts


def _plots(lab: Lab, names: Sequence[str], figure: Any) -> Part:
    plots = CurvePlots(names)
    releases = [
        plots.on_pick(lab.move_cursor),
        figure.on_theme(plots.set_theme),
        lab.follow(
            lambda change: (
                plots.draw(lab.result.scene, lab.mark)
                if change.scene
                else plots.draw_cursor(lab.mark)
            )
        ),
    ]
    plots.draw(lab.result.scene, lab.mark)

    def close() -> None:
        for release in releases:
            release()
        plots.close()

    return plots.widget, close


class PlaceBox(GoalBox):
    """Two lines in space to take in hand."""

    def __init__(self, group: Group, submit: Submit, task: Place, say: Submit) -> None:
        self.figure = LinesFigure(Slate(task.start, between))
        self.figure.lines.which.value = "b"  # the one that is asked for
        parts = [(self.figure, self.figure.close)]
        super().__init__(group, submit, task, say, self.figure.slate, parts)


def _control(group: Any) -> Part:
    """Return a control in a box of an app's looks, and what closes it."""
    box = w.VBox([group.widget, group.defect])
    box.add_class("ruledlab")
    return box, group.release


def conditions_html(conditions: Sequence[Condition]) -> str:
    """Return conditions with how far off each is."""
    rows = "".join(_condition_html(condition) for condition in conditions)
    return f'<ul class="ruledlab-marks">{rows}</ul>'


def _condition_html(condition: Condition) -> str:
    state = "is-met" if condition.met else "is-open"
    unit = "" if condition.unit in ("", "°", "%") else " "
    if condition.met:
        off = "holds"
    elif math.isnan(condition.off):
        off = "cannot be measured"
    else:
        off = f"off by {condition.off:.3g}{unit}{condition.unit}"
    share = 0.0 if math.isnan(condition.off) else _nearness(condition)
    now = f'<span class="ruledlab-now">{condition.now}</span>' if condition.now else ""
    return (
        f'<li class="{state}"><span>{condition.text}</span> <b>{off}</b> {now}'
        f'<i class="ruledlab-near" style="--near:{share:.3f}"></i></li>'
    )


def _nearness(condition: Condition) -> float:
    """Return 1 where the condition holds, falling to 0 far away; an exact one is never near."""
    if condition.within == 0.0:
        return 0.0
    return 1.0 / (1.0 + max(0.0, condition.off / condition.within - 1.0) / 8.0)


def _pattern(answer: Any) -> str:
    """Return what an answer looks like, for an empty field."""
    shape = np.shape(answer)
    if not shape:
        return "such as 2.5 or 3π/8"
    return "[" + ", ".join(["…"] * shape[0]) + "]" if len(shape) == 1 else ""


def box_for(
    task: Task, group: Group, submit: Submit, key: str, say: Submit, lab: Lab | None
) -> Box:
    """Return the box for a task."""
    match task:
        case Choose():
            texts = [option.text for option in task.options]
            return ChooseBox(group, submit, texts, task.shown, "the answers")
        case Code():
            return CodeBox(group, submit, task, key)
        case Number():
            label = task.label or "your answer"
            return FieldBox(group, submit, label, task.unit, _pattern(task.answer))
        case Formula():
            letters = " and ".join(task.variables)
            label = task.label or "your formula"
            return FieldBox(group, submit, label, example=f"a formula in {letters}")
        case Drag():
            return DragBox(group, submit, task, say, lab)
        case Place():
            return PlaceBox(group, submit, task, say)
        case Sketch():
            return SketchBox(group, submit, task, say)
        case FindSlip():
            return SlipBox(group, submit, task, say)
    raise AssertionError(task)
