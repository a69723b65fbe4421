"""Lesson 08: once round a closed surface, what comes back with a gap and what is enclosed."""

from __future__ import annotations

import html
from typing import Any

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry import gallery
from ..controls import (
    FieldControl,
    GalleryControl,
    Group,
    HistoryControl,
    NumberControl,
    TimeControl,
    design_of,
)
from ..palette import DARK, LIGHT
from ..scenes.once_round import (
    legend_html,
    numbers_html,
    overlay_of,
    path_of,
    region_svg,
    seam_html,
    ways_of,
    words_of,
)
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp
from .studio import ChartFigure

__all__ = ["OnceRound", "once_round"]


def once_round(design: Design | None = None) -> OnceRound:
    """Return the app of lesson 08: pitch and angle of pitch, shown and found in three ways.

    Parameters
    ----------
    design
        where to begin; None for the paper's Example 2.
    """
    return OnceRound(Lab(design or design_of(gallery.example("example_2"))))


class OnceRound(LabApp):
    """A closed design with its orthogonal trajectory, ξ, enclosed region and the three counts."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.figure, self.view = ChartFigure(lab), SurfaceView(620, 400)
        self.view.show(frame=False)
        self.time, self.fields = TimeControl(lab), FieldControl(lab)
        self.history, self.gallery = HistoryControl(lab), GalleryControl(lab)
        self.own = Group()
        words = "w₀, how far from the striction point the trajectory starts"
        self.start = NumberControl(self.own, "w₀", words, (-1.5, 1.5), 0.01, self.begin)
        self.legend = w.HTML(legend_html(LIGHT))
        self.region, self.numbers, self.seam = w.HTML(), w.HTML(), w.HTML()
        self._w0, self._path = 0.3, path_of(lab.result.surface, 0.3)
        self.start.show(self._w0)
        self._views = [self.view]
        self._groups = [self.time, self.fields, self.history, self.gallery, self.own]
        self._releases.append(self.figure.close)
        self.assemble(self._layout())

    def _layout(self) -> Any:
        head = w.Box([self.gallery.widget, self.history.widget]).add_class("ruledlab-head")
        hand = w.VBox([self.figure]).add_class("ruledlab-hand")
        edit = w.VBox([self.region, self.fields.widget]).add_class("ruledlab-edit")
        move = [self.view.widget, self.legend, self.time.widget, self.start.widget]
        right = w.VBox([*move, self.numbers, self.seam]).add_class("ruledlab-right")
        foot = w.VBox([self.gallery.note]).add_class("ruledlab-foot")
        return w.Box([head, hand, edit, right, foot]).add_class("ruledlab-grid")

    def restyle(self, dark: bool) -> None:
        """Change the picture to the light or the dark theme, and the legend with it."""
        super().restyle(dark)
        self.legend.value = legend_html(DARK if dark else LIGHT)

    def begin(self, w0: float) -> None:
        """Start the orthogonal trajectory elsewhere on the first ruling."""
        self._w0 = w0
        self.start.show(w0)
        self._path = path_of(self.lab.result.surface, w0)
        self._show_path()

    def update(self, change: Change) -> None:
        """Draw first; count when the pictures are there."""
        if change.scene:
            self._path = path_of(self.lab.result.surface, self._w0)
        super().update(change)
        if change.scene or change.mark:
            self._show_path()
        if change.loaded:
            self._step_back()
        if change.scene:
            self._count()

    def _show_path(self) -> None:
        self.view.overlay(overlay_of(self.lab, self._path))
        self.view.describe(words_of(self.lab, self._path))
        self.start.say("; ".join(self._path.reasons) or None)

    def _step_back(self) -> None:
        """Bring the way round into sight where it leads far beyond the drawn rulings."""
        scene, walk = self.lab.result.scene, self._path.walk
        if walk is not None:
            away = float(np.linalg.norm(walk.points - scene.centre, axis=1).max())
            if scene.radius < away < 10 * scene.radius:
                self.view.frame(scene.centre, away)

    def _count(self) -> None:
        ways = ways_of(self.lab.result.surface)
        reasons = "".join(f"<li>{html.escape(reason)}</li>" for reason in ways.reasons)
        unsaid = f'<ul class="ruledlab-note">{reasons}</ul>' if ways.total and reasons else ""
        region = "" if ways.region is None else region_svg(ways.region)
        self.own.put(self.region, value=region)
        self.own.put(self.numbers, value=numbers_html(ways, self._path) + unsaid)
        self.own.put(self.seam, value=seam_html(self.lab))
