"""Lesson 3: a line that moves. Base curve, striction curve, and the neighbour that comes nearer."""

from __future__ import annotations

import functools
import html
import math
from typing import Any

import ipywidgets as w
import numpy as np

from ...geometry.checks import GeometryError
from ...geometry.formula import FormulaError
from ...geometry.vector import vector
from ..controls import (
    Group,
    HistoryControl,
    NumberControl,
    Strokes,
    TimeControl,
    error_html,
    home_button,
    plain,
    readable,
)
from ..handles import Grasp, Grip
from ..markup import legend, numbers_table
from ..palette import DARK, LIGHT
from ..scene import Scene
from ..scenes.moving import FIRST, SECOND, STARTS, Motion, Moving, Near, picture, said, start, words
from ..scenes.shrinking import FLAT, orders_html, shrinking, shrinking_svg
from ..slate import Change
from ..view3d import SurfaceView
from .base import App

__all__ = ["MovingLine", "moving_line"]

BY_KEY = {entry.key: entry for entry in STARTS}
LEGEND = (
    ("kappa", "base curve c (dashed)"),
    ("sigma", "striction curve m"),
    ("cursor", "ruling X(t)"),
    ("tau", "neighbour X(t + h)"),
    ("delta", "common perpendicular, its feet"),
)


def moving_line(key: str = "circle", cursor: float = 5.0) -> MovingLine:
    """Return a ruled surface with its base curve, its striction curve and a neighbouring ruling.

    Parameters
    ----------
    key
        where to begin: an entry of the menu, such as ``"tangents"``, ``"hyperboloid"``, or a name
        of the gallery.
    cursor
        the value of t that is looked at, between 0 and 2π for typed formulas, 0 and 1 in the
        gallery.

    Raises
    ------
    GeometryError
        if there is no such entry.
    """
    if key not in BY_KEY:
        raise GeometryError(f"`key` must be one of {', '.join(BY_KEY)}; got {key!r}")
    return MovingLine(Motion(BY_KEY[key].moving, cursor))


class _Time(TimeControl):
    """The cursor t over a domain that changes with the surface."""

    def update(self, change: Change) -> None:
        """Follow the state."""
        if change.scene:
            self.t.ends = self._lab.result.surface.domain
            self.t.show(self._lab.cursor)
        super().update(change)


class ShapeControl(Group):
    """The surface: the menu, two typed vectors, and the constant a in them."""

    def __init__(self, motion: Motion) -> None:
        super().__init__()
        self._motion, self._strokes = motion, Strokes()
        self.menu = w.Dropdown(
            options=[("typed formulas", ""), *((entry.title, entry.key) for entry in STARTS)],
            layout=w.Layout(width="auto", max_width="330px"),
        )
        self.menu.tooltip = "surfaces: from a base curve c, from dual lines X, from the gallery"
        self.rows = {name: self._row(name) for name in ("first", "second")}
        self.a = NumberControl(
            self, "a", "a, the constant in the formulas", (-2.0, 2.0), 0.05, self._set_a
        )
        self.typed = w.VBox([*(row[-1] for row in self.rows.values()), self.a.widget])
        self.note = w.HTML()
        self.error = w.HTML()
        self.widget = w.VBox([self.typed, self.error])
        self.on(self.menu, "value", self._choose)
        self.follow(motion, self.update)
        self.update(Change(scene=True))

    def _row(self, name: str) -> tuple[Any, Any, Any, Any]:
        label, error = w.HTML(), w.HTML()
        field = w.Text(continuous_update=False, layout=w.Layout(width="auto", flex="1 1 90px"))
        self.on(field, "value", functools.partial(self._type, name))
        return (
            label,
            field,
            error,
            w.VBox([w.HBox([label, field]).add_class("ruledlab-row"), error]),
        )

    def _choose(self, key: str) -> None:
        if key:
            self._motion.load(BY_KEY[key].moving, "menu")
        else:
            self.update(Change(scene=True))

    def _set_a(self, a: float) -> None:
        self._motion.edit("a", self._strokes.token("a"), a=a)

    def _type(self, name: str, text: str) -> None:
        word = (FIRST, SECOND)[name == "second"][self._motion.value.kind][1]
        try:
            meant = readable(text, ("t", "a"), lambda typed: vector(typed, word))
        except FormulaError as error:
            self._say(name, plain(str(error)), error.pointer(36))
        except GeometryError as error:
            self._say(name, plain(str(error)))
        else:
            self._motion.edit(name, **{name: meant})

    def _say(self, name: str, text: str, pointer: str = "") -> None:
        """Show what is wrong beside a formula, which stays in its field to be mended."""
        self.put(self.rows[name][2], value=error_html(text, pointer))

    def update(self, change: Change) -> None:
        """Follow the state."""
        if change.error is not None:
            if change.source in self.rows:
                self._say(change.source, plain(change.error))
            elif change.source == "a":
                self.a.say(plain(change.error))
            return
        if change.scene or change.source in self.rows:
            self._show(self._motion.value)

    def _show(self, moving: Moving) -> None:
        found = start(moving)
        self.put(self.menu, value=found.key if found else "")
        self.put(self.note, value=_note(f"<b>{html.escape(found.title)}.</b> {found.note}")
                 if found else _note("Your own formulas."))  # fmt: skip
        self.typed.layout.display = "none" if moving.kind == "gallery" else "flex"
        if moving.kind != "gallery":
            for name, names in (("first", FIRST), ("second", SECOND)):
                self._show_row(name, *names[moving.kind], getattr(moving, name))
            self.a.show(moving.a)

    def _show_row(self, name: str, symbol: str, words: str, text: str) -> None:
        label, field, error, _ = self.rows[name]
        shown = f'<span class="ruledlab-label" title="{words} {symbol}">{symbol} =</span>'
        self.put(label, value=shown)
        self.put(field, value=text)
        self.put(error, value="")


class StepControl(Group):
    """s, which slides the base curve along the rulings, and h, the step to the neighbour."""

    def __init__(self, motion: Motion) -> None:
        super().__init__()
        self._motion, self._strokes = motion, Strokes()
        self.slide = NumberControl(
            self,
            "s",
            "s, how far the base curve slides along the rulings",
            (-2.0, 2.0),
            0.05,
            functools.partial(self._set, "slide"),
        )
        self.exponent = NumberControl(
            self,
            "log₁₀ h",
            "logarithm of h: the neighbour is the ruling at t + h",
            (-3.0, -0.3),
            0.05,
            functools.partial(self._set, "exponent"),
            fixed=True,
        )
        self.widget = w.VBox([self.slide.widget, self.exponent.widget])
        self.follow(motion, self.update)
        self.update(Change(scene=True))

    def grasp(self, grasp: Grasp) -> None:
        """Move h to where the foot of its line is wanted."""
        low, high = self.exponent.ends
        to = min(max(round(float(grasp.place[0]), 2), low), high)
        self._motion.edit("exponent", ("handle", *grasp.drag), exponent=to)

    def _set(self, name: str, value: float) -> None:
        self._motion.edit(name, self._strokes.token(name), **{name: value})

    def update(self, change: Change) -> None:
        """Follow the state."""
        if change.scene:
            self.slide.show(self._motion.value.slide)
            self.exponent.show(self._motion.value.exponent)


class MovingLine(App):
    """A ruled surface, one ruling and its neighbour.

    Attributes
    ----------
    motion
        the state.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        super().__init__(motion)
        self.view = SurfaceView(620, 540)
        self._drawn: Scene | None = None
        self.view.sphere("off")
        self.view.show(frame=False)
        self.shape, self.steps = ShapeControl(motion), StepControl(motion)
        self.time, self.history = _Time(motion), HistoryControl(motion)  # type: ignore[arg-type]
        self.home = home_button()
        self.shape.click(self.home, lambda: self.view.reset_view())
        self.numbers, self.graph, self.legend = w.HTML(), w.HTML(), w.HTML(legend(LEGEND, LIGHT))
        self.foot = self.handles(self.steps, self.steps.grasp)
        self._theme = LIGHT
        self._views = [self.view]
        self._groups = [self.shape, self.steps, self.time, self.history]
        self.assemble(self._grid())

    def _grid(self) -> Any:
        parts = {
            "head": w.Box([self.shape.menu, self.history.widget, self.home]),
            "hand": w.VBox([self.shape.widget, self.steps.widget]),
            "edit": w.VBox([self.numbers, self.foot.over(self.graph)]),
            "right": w.VBox([self.view.widget, self.time.widget, self.legend]),
            "foot": w.VBox([self.shape.note]),
        }
        for name, part in parts.items():
            part.add_class(f"ruledlab-{name}")
        return w.Box([*parts.values()]).add_class("ruledlab-grid")

    def restyle(self, dark: bool) -> None:
        """Change the picture to the light or the dark theme, and the legend with it."""
        super().restyle(dark)
        self._theme = DARK if dark else LIGHT
        self.legend.value = legend(LEGEND, self._theme)
        self._draw_graph()

    def update(self, change: Change) -> None:
        """Draw what changed; the surface itself only where it is another one."""
        if change.error is not None or not (change.scene or change.mark):
            return
        result, pair = self.motion.result, self.motion.near
        if result.scene is not self._drawn:
            self.view.draw(result.scene)
            self._drawn = result.scene
        self.view.overlay(picture(result, pair))
        if change.loaded:
            self.view.reset_view(result.scene)
        self.view.describe(words(result, pair))
        self.numbers.value = numbers_html(pair)
        self._draw_graph()

    def _draw_graph(self) -> None:
        """Draw how the neighbour comes nearer as h goes to 0."""
        pair, surface = self.motion.near, self.motion.result.surface
        found = shrinking(surface, pair.t)
        picture = shrinking_svg(found, pair.h, self._theme)
        self.graph.value = picture + orders_html(found, self._theme)
        place = np.array([math.log10(pair.h), 0.0, 0.0])
        self.foot.draw([Grip(place, "point", "cursor", "h, the step to the neighbour")], FLAT)


def numbers_html(pair: Near) -> str:
    """Return the numbers of a ruling and its neighbour as a table."""
    rows = (
        ("step", "h", f"{pair.h:.4g}", "of t"),
        ("signed distance", "d", said(pair.distance, 1e-12), "length"),
        ("angle", "θ", said(pair.angle), "rad"),
        ("distance/angle", "d/θ", said(pair.ratio), "length"),
        ("distribution parameter", "δ", said(pair.delta), "length"),
        ("difference", "d/θ − δ", said(pair.ratio - pair.delta), "length"),
        ("foot p to m", "‖p − m‖", said(pair.off), "length"),
        ("way from c to m", "μ", said(pair.along), "length"),
    )
    why = "".join(_note(html.escape(f"{reason}.")) for reason in pair.reasons)
    return numbers_table(rows) + why


def _note(text: str) -> str:
    return f'<div class="ruledlab-note">{text}</div>'
