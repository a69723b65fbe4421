"""The control points of the chosen curve, by numbers."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import ipywidgets as w
import numpy as np

from ...design import CLOSINGS, Design
from ...geometry.curve import Bezier, close, drag, insert, remove
from ..slate import Change
from ..state import Lab
from .group import Group, Strokes, error_html, plain
from .number import NumberControl

__all__ = ["PointControl"]

CLOSING_WORDS = {
    "open": "open",
    "C0": "closed, C⁰ (meets)",
    "C1": "closed, C¹ (equal spacing)",
    "C2": "closed, C² (equal second differences)",
}


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
