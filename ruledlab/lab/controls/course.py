"""Where one is: the place t, undo and redo, the designs of the gallery."""

from __future__ import annotations

import functools
import html
from typing import Any

import ipywidgets as w

from ...design import Design
from ...geometry.gallery import GALLERY, Example
from ..slate import Change, Slate
from ..state import Lab
from .group import Group, button
from .number import STEPS, NumberControl, Player

__all__ = ["GalleryControl", "HistoryControl", "TimeControl", "design_of", "is_design_of"]


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
        self.undo = button("undo", "undo", "take the last change back")
        self.redo = button("redo", "repeat", "make the undone change again")
        self.reset = button("reset", "refresh", "back to where this began")
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
