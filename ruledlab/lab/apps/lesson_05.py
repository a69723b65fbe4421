"""Lesson 05: the tangent plane turns along a ruling, and the surface bends on both its sides.

The point that is looked at is (t, w). Its t is the lab's cursor; a `Slate` of design, t and w is
the memory of all three, so that one undo serves them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ipywidgets as w

from ...design import Design
from ...geometry.checks import Array
from ..controls import (
    GalleryControl,
    Group,
    HistoryControl,
    NumberControl,
    Player,
    Strokes,
    TimeControl,
    home_button,
)
from ..handles import Grasp, Grip
from ..scenes.bend import (
    STYLE,
    Bend,
    bend,
    curvatures,
    flat,
    forms,
    graph,
    in_space,
    lacking,
    spots,
    words,
)
from ..sight import follow
from ..slate import Change, Slate
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp
from .studio import example

__all__ = ["Bending", "bending"]


def bending(design: Design | None = None, w: float = -0.6) -> Bending:
    """Return the app of lesson 05: tangent plane, asymptotic directions and curvature at a point.

    Parameters
    ----------
    design
        where to begin; None for the right helicoid.
    w
        the place along the ruling, from the striction point.
    """
    start = (design or example("right_helicoid")).with_(base="striction")
    return Bending(Lab(start, 0.68), w)  # where the plane is seen from its side and not on edge


@dataclass(frozen=True, slots=True)
class Spot:
    """What is looked at: a design, the place t of a ruling and w along it."""

    design: Design
    t: float
    w: float


class Place(Group):
    """The place w along the ruling: play, slide, type; colour and planes along the ruling."""

    COLOURINGS = (("K", "gauss"), ("H", "mean"), ("δ", "delta"), ("plain", "plain"))

    def __init__(self, app: Bending, half: float) -> None:
        super().__init__()
        self._app = app
        self.w = NumberControl(
            self,
            "w",
            "w, the place along the ruling from the striction point",
            (-half, half),
            0.01,
            self._move,
        )
        self.player = Player(self, "w, along the ruling and back", self._run, back=True)
        self.play = self.player.widget
        row, error = self.w.widget.children
        row.layout.flex = "1 1 200px"
        error.layout.min_height = "20px"  # a run may pass where there is no plane
        run = w.HBox([self.play, row]).add_class("ruledlab-time")
        self.w.widget.children = [run, error]
        self.colour = w.Dropdown(
            options=self.COLOURINGS,
            description="colour",
            style={"description_width": "initial"},
            layout=w.Layout(width="auto", min_width="110px"),
        )
        self.fan = w.Checkbox(
            description="tangent planes along the ruling",
            indent=False,
            layout=w.Layout(width="auto"),
        )
        self.home = home_button()
        self.on(self.colour, "value", app.lab.colour)
        self.on(self.fan, "value", lambda _: app.show())
        self.click(self.home, app.view.reset_view)

    def _move(self, value: float) -> None:
        self._app.spot.edit("w", self._app.stroke("w"), w=value)

    def _run(self, value: float) -> None:
        self._move(round(value, 12))

    def show(self, spot: Spot, lack: str | None) -> None:
        """Show w, and why there is no tangent plane."""
        half = 0.5 * spot.design.length
        self.w.show(spot.w)
        self.w.say(lack)
        self.player.show(spot.w, (-half, half))


class Bending(LabApp):
    """A surface, its tangent plane in one point, and what happens along the ruling.

    Attributes
    ----------
    spot
        the `Slate` of what is looked at: design, t and w.
    """

    def __init__(self, lab: Lab, w: float) -> None:
        lab.colour("gauss")
        super().__init__(lab)
        self.spot = Slate(Spot(lab.design, lab.cursor, w), lambda spot: None, beside=lab)
        self.view, self.time = SurfaceView(560, 430), TimeControl(lab)
        self.gallery, self.history = GalleryControl(lab), HistoryControl(self.spot)
        self.place, self._strokes = Place(self, 0.5 * lab.design.length), Strokes()
        self.point = self.handles(self.place, self.drag, self.view)
        self.dots = self.handles(self.place, self.slide)
        self._good: tuple[Design, Bend] | None = None
        self._views = [self.view]
        self._groups = [self.place, self.time, self.gallery, self.history]
        self._releases += [
            self.spot.follow(self._moved),
            self.view.on_pick(lambda t, w: self.place.guard(lambda: self.pick(t, w))),
        ]
        self.view.sphere("off")
        self.view.show(frame=False)
        self.assemble(*self._laid_out())

    def _laid_out(self) -> tuple[Any, ...]:
        self.legend, self.picture, self.curved, self.forms = (w.HTML() for _ in range(4))
        head = [self.gallery.widget, self.history.widget, self.place.colour, self.legend]
        under = w.HBox([self.place.fan, self.place.home]).add_class("ruledlab-bar")
        moved = [self.time.widget, self.place.w.widget, under]
        parts = [
            w.VBox([self.point.over(self.view.widget), *moved]),
            w.VBox([self.dots.over(self.picture), self.curved]),
            self.forms,
        ]
        return (
            w.HTML(STYLE),
            w.Box(head).add_class("ruledlab-bar"),
            w.Box(parts).add_class("ruledlab-bends"),
            self.gallery.note,
        )

    def stroke(self, moved: str) -> object:
        """Return what is equal for moves that are one step of undo: a run is one, or two at once.

        Whatever else the reader moves meanwhile belongs to the run.
        """
        running = self.time.player.running or self.place.player.running
        return self._strokes.token("run" if running else moved)

    def pick(self, t: float, w: float, stroke: object = None) -> None:
        """Look at a point of the surface."""
        self.spot.edit("pick", stroke, t=round(t, 4), w=round(w, 4))  # a hand is no more exact

    def drag(self, grasp: Grasp) -> None:
        """Move the point along the sheet it is on, under the pointer."""
        spot, eye = self.spot.value, self.view.eye
        x, y, _ = eye.seen(grasp.place)
        to = follow(self.lab.result.scene, eye, (spot.t, spot.w), x, y)
        if to is not None:
            self.pick(*to, ("handle", *grasp.drag))

    def slide(self, grasp: Grasp) -> None:
        """Move the point along its ruling."""
        half = 0.5 * self.lab.design.length
        w = min(max(float(grasp.place[0]), -half), half)
        self.spot.edit("w", ("handle", *grasp.drag), w=round(w, 4))

    def update(self, change: Change) -> None:
        """Follow the lab: draw, and remember where it is."""
        super().update(change)
        if change.scene:
            self.spot.edit("lab", design=self.lab.design)
            self.legend.value = self.view.legend_html(self.lab.result.scene)
        elif change.mark:
            self.spot.edit("lab", self.stroke("t"), t=self.lab.cursor)
        if change.scene or change.mark:
            self.show()

    def _moved(self, change: Change) -> None:
        """Follow the memory: a step back may lead to another design or another ruling."""
        spot = self.spot.value
        if not change.mark or change.source == "lab":
            return
        if spot.design != self.lab.design:
            self.lab.load(spot.design, "history")
        if spot.t != self.lab.cursor:
            self.lab.move_cursor(spot.t)
        else:
            self.show()

    def show(self) -> None:
        """Draw and say what holds at the point."""
        spot, result = self.spot.value, self.lab.result
        now = bend(result.surface, spot.t, spot.w, spot.design.length)
        if not now.reason or self._good is None or self._good[0] != spot.design:
            self._good = (spot.design, now)
        size = 0.3 * result.scene.radius
        self.view.overlay(in_space(self._good[1], now, size, self.place.fan.value))
        self.view.describe(words(spot.t, now))
        self.point.draw([Grip(now.planes.point[0], "point", "cursor", "the point looked at")])
        self.picture.value = graph(now)
        self.dots.draw([_grip(*spot) for spot in spots(now)], flat(now))
        self.curved.value, self.forms.value = curvatures(now), forms(now)
        self.place.show(spot, lacking(now))


def _grip(symbol: str, place: Array) -> Grip:
    return Grip(place, "point", "cursor", f"w, on the curve of {symbol}")
