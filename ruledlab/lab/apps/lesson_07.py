"""Lesson 7: ū and v̄ hang one line on every point of the chart, and the curve cuts a surface out."""

from __future__ import annotations

import functools
import html
import math
from collections.abc import Callable
from typing import Any

import ipywidgets as w

from ...design import Design
from ...geometry import Congruence, GeometryError
from ...geometry.field import named_number
from ..controls import (
    FieldControl,
    Group,
    HistoryControl,
    NumberControl,
    PointControl,
    Strokes,
    TimeControl,
    error_html,
    home_button,
    plain,
)
from ..overlay import Overlay, Sheet
from ..pad import DomainPad
from ..palette import DARK, LIGHT
from ..scenes.congruence import (
    Lines,
    Place,
    counts_words,
    focal_surfaces,
    highlighted,
    lines,
    place,
    place_words,
    sight,
)
from ..scenes.congruence_chart import NOTE, chart_signs, legend_html
from ..scenes.congruence_numbers import Enclosure, enclosure, numbers_html
from ..scenes.straightened import straightened, straightened_words, strip
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp, connect
from .studio import example

__all__ = ["CongruenceApp", "dual_part"]


def dual_part(design: Design | None = None) -> CongruenceApp:
    """Return the app of lesson 7: the congruence of ū and v̄ around the surface of a curve.

    Parameters
    ----------
    design
        where to begin; None for the paper's Example 2.
    """
    return CongruenceApp(Lab(design or example("example_2")))


# -- controls --------------------------------------------------------------------------------------


class CongruenceControl(Group):
    """What is shown of the congruence, and the place that is looked at: on the curve or off it."""

    def __init__(self, lab: Lab, changed: Callable[[], None]) -> None:
        super().__init__()
        self._lab, self._changed, self._strokes = lab, changed, Strokes()
        self.free: tuple[float, float] | None = None
        self.count = 7
        number = functools.partial(NumberControl, self)
        self.u = number("u", "u of the place, in radians", (-3.15, 6.3), 0.01,
                        lambda value: self._put_place(0, value))  # fmt: skip
        self.v = number("v", "v of the place, in radians", (0.0, 3.15), 0.01,
                        lambda value: self._put_place(1, value))  # fmt: skip
        self.lines = number("lines", "lines of the grid each way", (5, 15), 1, self._put_count,
                            whole=True, fixed=True)  # fmt: skip
        self.length = number("length", "length of the drawn lines", (0.2, 12.0), 0.1,
                             self._put_length)  # fmt: skip
        room = w.Layout(width="auto")
        self.focal = w.Checkbox(
            value=False, description="focal surfaces", indent=False, layout=room
        )
        self.grid = w.Checkbox(value=True, description="lines", indent=False, layout=room)
        self.home = home_button()
        self.develop = w.Button(
            description="make it developable",
            tooltip="another v̄ along this curve, so that κ̄ = 0 everywhere",
            layout=w.Layout(width="auto", align_self="flex-start"),
        )
        self.on(self.focal, "value", lambda _: changed())
        self.on(self.grid, "value", lambda _: changed())
        self.lines.show(self.count)
        self.length.show(lab.design.length)
        self.follow(lab, self._follow)

    @property
    def at(self) -> tuple[float, float]:
        """The place (u, v) that is looked at."""
        u, v = self._lab.mark.chart if self.free is None else self.free
        return float(u), float(v)

    def show(self) -> None:
        """Show the place in the sliders; on the curve it has more digits than anyone reads."""
        for number, value in zip((self.u, self.v), self.at, strict=True):
            number.show(value if "pi" in named_number(value) else round(value, 6))

    def look(self, u: float, v: float) -> None:
        """Leave the curve for a place the reader took hold of in the chart."""
        self.free = (u, v)
        self._changed()

    def _put_place(self, axis: int, value: float) -> None:
        to = list(self.at)
        to[axis] = value
        self.look(to[0], to[1])

    def _put_count(self, count: float) -> None:
        self.count = int(count)
        self.lines.show(self.count)
        self._changed()

    def _put_length(self, length: float) -> None:
        self._lab.edit("length", self._strokes.token("length"), length=length)

    def _follow(self, change: Change) -> None:
        """Return to the curve when t is moved; say what is wrong with a length."""
        if change.error is not None and change.source == "length":
            self.length.say(change.error.replace("`", ""))
        elif change.scene:
            self.length.show(self._lab.design.length)
        if change.loaded or (change.mark and not change.scene):
            self.free = None


# -- the app ---------------------------------------------------------------------------------------


class CongruenceApp(LabApp):
    """The chart with its curve, the two fields, the congruence in space, and one line of it."""

    def __init__(self, lab: Lab) -> None:
        self._lines: Lines | None = None
        self._focal: Overlay | None = None
        self._loop, self._enclosed, self._written = Enclosure(), (), ()
        self._strip: tuple[Sheet, ...] = ()
        self._theme = LIGHT
        self.control = CongruenceControl(lab, self._redraw)
        super().__init__(lab)  # after the control: it must hear of a move before the views draw
        self.pad, self.view = DomainPad(), SurfaceView(620, 430)
        self.points, self.fields, self.time = PointControl(lab), FieldControl(lab), TimeControl(lab)
        self.history = HistoryControl(lab)
        self.legend, self.words, self.numbers, self.said = (w.HTML() for _ in range(4))
        self._views = [self.view, self.pad]
        self._groups = [self.control, self.points, self.fields, self.time, self.history]
        self._releases += [
            connect(self.pad, self.points),
            self.pad.on_look(self._look),
        ]
        self.control.click(self.control.develop, self._develop)
        self.control.click(self.control.home, self._home)
        self.view.show(frame=False)
        self.assemble(self._layout())

    def _layout(self) -> Any:
        control = self.control
        folded = w.Accordion([self.points.widget])
        folded.titles = ("The curve, by numbers",)
        head = w.Box([self.history.widget, control.home, control.grid, control.focal]).add_class(
            "ruledlab-head"
        )
        hand = w.VBox([self.pad, w.HTML(NOTE)]).add_class("ruledlab-hand")
        develop = w.VBox([control.develop, self.said])
        edit = w.VBox([self.fields.widget, develop, folded]).add_class("ruledlab-edit")
        sliders = (self.time, control.u, control.v, control.lines, control.length)
        shown = [self.view.widget, self.legend, *(slider.widget for slider in sliders)]
        right = w.VBox([*shown, self.words, self.numbers]).add_class("ruledlab-right")
        return w.Box([head, hand, edit, right]).add_class("ruledlab-grid")

    def update(self, change: Change) -> None:
        """Draw what changed in the lab, then the congruence."""
        super().update(change)
        if change.scene:
            self._lines, self._focal, self._strip = None, None, ()
            self.said.value = ""
        if change.scene or change.mark:
            self._redraw()
        if change.loaded or (change.scene and change.source == "pair"):
            self._home()

    def _home(self) -> None:
        """Bring all lines into sight: a named choice may hang them somewhere else."""
        if self._lines is not None:
            self.view.frame(*sight(self._lines, self.lab.result.scene))

    def _look(self, u: float, v: float) -> None:
        self.control.guard(lambda: self.control.look(u, v))

    def restyle(self, dark: bool) -> None:
        """Change the views and the legend to another theme."""
        super().restyle(dark)
        self._theme = DARK if dark else LIGHT
        self._redraw()

    def _redraw(self) -> None:
        """Draw the congruence, the line of the place, and its numbers."""
        control, scene, design = self.control, self.lab.result.scene, self.lab.design
        congruence = Congruence(design.ubar, design.vbar)
        if self._lines is None or sum(self._lines.counts.values()) != control.count**2:
            self._lines = lines(congruence, scene, control.count)
            self._draw_signs(self._lines)
            self._find_loop()
        at = place(congruence, *control.at)
        over, found = highlighted(at, scene), self._lines
        grid = found.strokes if control.grid.value else ()
        if control.focal.value and self._focal is None:
            self._focal = focal_surfaces(congruence, scene)
        focal = self._focal if control.focal.value and self._focal else Overlay()
        strokes, sheets = (*grid, *focal.strokes, *over.strokes), (*focal.sheets, *self._strip)
        self.view.overlay(Overlay(strokes, over.dots, sheets, over.labels))
        mark = self.lab.mark if control.free is None else at.mark(self.lab.mark)
        self.view.draw_cursor(mark)
        self.pad.draw_place(control.free)
        control.show()
        self._say(at)

    def _draw_signs(self, found: Lines) -> None:
        """Write the grid into the chart, unless it is there: most moves of the curve leave it."""
        design = self.lab.design
        shown = (design.ubar, design.vbar, len(found.kinds), found.ends.tobytes())
        if shown != self._written:
            self._written = shown
            self.pad.draw_signs(chart_signs(found))

    def _find_loop(self) -> None:
        """Find what the loop encloses, if it or the congruence has changed."""
        design = self.lab.design
        inside = (design.points, design.ubar, design.vbar)
        if inside != self._enclosed:
            self._enclosed, self._loop = inside, enclosure(self.lab.result.surface)

    def _say(self, at: Place) -> None:
        lab, kinds, sentence = self.lab, self._lines.counts, place_words(at)
        self.view.describe(f"{lab.result.scene.text} {counts_words(kinds)}. {sentence}")
        self.legend.value = legend_html(kinds, self._theme)
        self.words.value = f"<div>{html.escape(sentence)}</div>"
        delta = lab.mark.values["delta"] if self.control.free is None else math.nan
        pitch = lab.result.pitch
        length = math.nan if pitch is None else float(pitch.dual)
        self.numbers.value = numbers_html(at, delta, length, self._loop)

    def _develop(self) -> None:
        """Show a developable surface over the same curve until something changes."""
        surface, design = self.lab.result.surface, self.lab.design
        try:
            made, how = straightened(surface, design.ubar)
        except GeometryError as error:
            self.said.value = error_html(plain(str(error)))
            return
        self._strip = (Sheet(strip(made, design.length), "sigma", 0.5, "developable"),)
        self._redraw()
        text = html.escape(straightened_words(surface, made, how))
        self.said.value = f'<div class="ruledlab-note" role="status">{text}</div>'
