"""Lesson 02: two oriented lines, their dual vectors, dual angle and common perpendicular."""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import Any, Final

import ipywidgets as w

from ...pair import SPANS, OneLine, Pair, TwoLines, between
from ..controls import Group, HistoryControl, NumberControl, Strokes, home_button
from ..handles import Grasp, Grip
from ..overlay import Overlay
from ..scenes.line_pair import (
    COLOURS,
    PRESETS,
    lines_html,
    pair_html,
    picture,
    sight,
    words,
)
from ..sight import away, upright
from ..slate import Change, Slate
from ..view3d import SurfaceView
from .base import App

__all__ = ["LinesFigure", "TwoLinesApp", "two_lines"]

WIDTH, HEIGHT = 620, 430

# -- what the reader moves -------------------------------------------------------------------------

NUMBERS: Final = {
    "u": ("u, longitude of the direction in radians", SPANS["u"], 0.01),
    "v": ("v, colatitude of the direction in radians", SPANS["v"], 0.01),
    "x": ("x of the given point of the line", SPANS["x"], 0.05),
    "y": ("y of the given point of the line", SPANS["y"], 0.05),
    "z": ("z of the given point of the line", SPANS["z"], 0.05),
}

GRIPS: Final = (("a", "point"), ("a", "direction"), ("b", "point"), ("b", "direction"))
"""The handles: of which line, and what of it they move."""


def grips(lines: TwoLines) -> tuple[Grip, ...]:
    """Return the handles of both lines, in the order of `GRIPS`."""
    made = []
    for name, part in GRIPS:
        line: OneLine = getattr(lines, name)
        what = "given point" if part == "point" else "direction"
        place = line.point if part == "point" else line.ahead
        made.append(Grip(place, part, COLOURS[name], f"{what} of line {name.upper()}"))
    return tuple(made)


class PresetControl(Group):
    """Positions of both lines from a menu."""

    def __init__(self, slate: Slate[TwoLines, Pair]) -> None:
        super().__init__()
        self._slate = slate
        self.menu = w.Dropdown(
            options=[("positions …", ""), *((name, name) for name in PRESETS)],
            layout=w.Layout(width="auto"),
        )
        self.menu.tooltip = "positions of two lines"
        self.on(self.menu, "value", self._load)
        self.follow(slate, self.update)
        self.update(Change(scene=True))

    def _load(self, name: str) -> None:
        if name:
            self._slate.load(PRESETS[name], "preset")

    def update(self, change: Change) -> None:
        """Follow the state: the menu names a position only while the lines are there."""
        if change.scene:
            named = (name for name, lines in PRESETS.items() if lines == self._slate.value)
            self.put(self.menu, value=next(named, ""))


class LineControl(Group):
    """The five numbers of the chosen line."""

    def __init__(self, slate: Slate[TwoLines, Pair]) -> None:
        super().__init__()
        self._slate, self._strokes = slate, Strokes()
        self.which = w.ToggleButtons(options=[("line A", "a"), ("line B", "b")])
        self.which.style.button_width = "72px"
        self.reverse = w.Button(description="reverse", layout=w.Layout(width="auto"))
        self.reverse.tooltip = "run through the chosen line the other way"
        self.numbers = {
            key: NumberControl(self, key, *about, functools.partial(self._move, key), fixed=True)
            for key, about in NUMBERS.items()
        }
        bar = w.HBox([self.which, self.reverse]).add_class("ruledlab-bar")
        self.widget = w.VBox([bar, *(number.widget for number in self.numbers.values())])
        self.on(self.which, "value", lambda _: self.update(Change(scene=True)))
        self.click(self.reverse, self._reverse)
        self.follow(slate, self.update)
        self.update(Change(scene=True))

    @property
    def _chosen(self) -> OneLine:
        return self._slate.value.a if self.which.value == "a" else self._slate.value.b

    def _move(self, key: str, value: float) -> None:
        name, line = self.which.value, replace(self._chosen, **{key: value})
        self._slate.edit(key, self._strokes.token((name, key)), **{name: line})

    def grasp(self, grasp: Grasp) -> None:
        """Move the line whose handle the reader has in hand, and choose it."""
        name, part = GRIPS[grasp.index]
        line = getattr(self._slate.value, name)
        line = line.moved(grasp.place) if part == "point" else line.aimed(grasp.place)
        self.which.value = name
        self._slate.edit("handle", ("handle", *grasp.drag), **{name: line})

    def _reverse(self) -> None:
        self._slate.edit("reverse", **{self.which.value: self._chosen.reversed()})

    def update(self, change: Change) -> None:
        """Follow the state."""
        if change.scene:
            for key, number in self.numbers.items():
                number.show(getattr(self._chosen, key))


class LookControl(Group):
    """What is drawn besides the lines, and from where it is seen."""

    def __init__(self) -> None:
        super().__init__()
        room = w.Layout(width="auto")
        self.moments = w.Checkbox(value=True, description="moments", indent=False, layout=room)
        self.sphere = w.Checkbox(value=True, description="unit sphere", indent=False, layout=room)
        self.home = home_button()


class LinesFigure(App):
    """Two lines in space to take in hand, by handles and by their numbers.

    Attributes
    ----------
    slate
        the state: a `TwoLines`; its result is a `Pair`.
    """

    def __init__(self, slate: Slate[TwoLines, Pair]) -> None:
        self.slate = slate
        super().__init__(slate)
        self.view, self.lines, self.look = (
            SurfaceView(WIDTH, HEIGHT),
            LineControl(slate),
            LookControl(),
        )
        self.history = HistoryControl(slate)
        self.grips = self.handles(self.lines, self.lines.grasp, self.view)
        self.view.sphere("off")
        self._views, self._groups = [self.view], [self.lines, self.look, self.history]
        for box in (self.look.moments, self.look.sphere):
            self.look.on(box, "value", lambda _: self.update(Change(scene=True)))
        self.look.click(self.look.home, self._home)
        self.assemble(self._grid())

    def _grid(self) -> Any:
        grid = w.Box([self._part(name, widgets) for name, widgets in self._places().items()])
        return grid.add_class("ruledlab-grid")

    def _places(self) -> dict[str, list[Any]]:
        """Return the places of the grid and what stands in each."""
        look = self.look
        return {
            "head": [self.history.widget, look.moments, look.sphere, look.home],
            "hand": [self.lines.widget],
            "right": [self.grips.over(self.view.widget)],
        }

    def _part(self, name: str, widgets: list[Any]) -> Any:
        kind = w.Box if name == "head" else w.VBox
        return kind(widgets).add_class(f"ruledlab-{name}")

    def _home(self) -> None:
        self.view.frame(*sight(self._picture(), upright(away()), WIDTH / HEIGHT))

    def _picture(self) -> Overlay:
        return picture(
            self.slate.result, moments=self.look.moments.value, sphere=self.look.sphere.value
        )

    def update(self, change: Change) -> None:
        """Draw both lines."""
        if change.scene:
            self.view.overlay(self._picture())
            self.grips.draw(grips(self.slate.value))
            self.view.describe(words(self.slate.result))
        if change.loaded:
            self._home()


class TwoLinesApp(LinesFigure):
    """Two lines in space with positions to begin from, and what follows in numbers."""

    def _places(self) -> dict[str, list[Any]]:
        """Add the menu of positions and the tables to what the figure has."""
        self.preset = PresetControl(self.slate)
        self._groups.append(self.preset)
        self.of_pair, self.of_lines = w.HTML(), w.HTML()
        places = super()._places()
        places["head"].insert(0, self.preset.menu)
        places["right"].append(self.of_lines)
        return {**places, "edit": [self.of_pair]}

    def update(self, change: Change) -> None:
        """Draw both lines and write their numbers."""
        super().update(change)
        if change.scene:
            self.of_pair.value = pair_html(self.slate.result)
            self.of_lines.value = lines_html(self.slate.result)


def two_lines(lines: TwoLines | None = None) -> TwoLinesApp:
    """Return two oriented lines to move, with dual angle and common perpendicular.

    Parameters
    ----------
    lines
        where to begin; None for two skew lines.
    """
    return TwoLinesApp(Slate(lines or PRESETS["skew"], between))
