"""Lesson 08: once round a closed surface, what comes back with a gap and what is enclosed."""

from __future__ import annotations

import html
import math
from typing import Any

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry import Dual, Enclosed, GeometryError, gallery
from ...geometry.checks import Array
from ...geometry.curve import seam
from ..controls import (
    FieldControl,
    GalleryControl,
    Group,
    HistoryControl,
    NumberControl,
    Strokes,
    TimeControl,
    design_of,
    plain,
)
from ..markup import legend
from ..palette import DARK, LIGHT
from ..scenes.once_round import (
    LEGEND,
    Ways,
    numbers_html,
    overlay_of,
    path_of,
    region_svg,
    seam_html,
    size_html,
    total_of,
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


Points = tuple[tuple[float, float], ...]


class SizeControl(Group):
    """The size of the loop: all control points, moved to their middle or away from it.

    Size 1 is the loop as its points were last put. It is remembered for every loop made here, so
    that undo leads back to the size as well.
    """

    MOST = 2000
    """Loops that are remembered; more than there are steps of undo."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab, self._strokes = lab, Strokes()
        self._made: dict[Points, tuple[Points, float]] = {}
        words = "size of the loop: 1 is how its points were last put"
        self.size = NumberControl(self, "size", words, (0.1, 2.0), 0.01, self.resize)
        self.widget = self.size.widget
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    @property
    def whole(self) -> Points:
        """The control points at size 1."""
        return self._known()[0]

    @property
    def value(self) -> float:
        """The present size."""
        return self._known()[1]

    def _known(self) -> tuple[Points, float]:
        points = self._lab.design.points
        return self._made.get(points, (points, 1.0))

    def resize(self, size: float) -> None:
        """Give the loop another size; the middle of its control points stays."""
        self._lab.attempt("size", lambda: self._resized(size), self._strokes.token("size"))

    def _resized(self, size: float) -> Design:
        design, (whole, now) = self._lab.design, self._known()
        if size == now:
            return design
        _require_loop(design, size)
        made = design.with_(points=resized(whole, size))
        if size > now:
            _require_off_the_poles(made, size)
        if len(self._made) >= self.MOST:
            self._made.pop(next(iter(self._made)))
        self._made[made.points] = whole, size
        return made

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source == "size":
                self.size.refuse(plain(change.error))
        elif change.scene or change.source == "size":
            self.size.show(self.value)


def middle(points: Points) -> Array:
    """Return the middle of the rectangle round the points."""
    return 0.5 * (np.min(points, axis=0) + np.max(points, axis=0))


def resized(points: Points, size: float) -> Any:
    """Return the points at so many times their distance from their middle."""
    if size == 1.0:
        return points  # to the last digit
    centre = middle(points)
    return centre + size * (np.array(points) - centre)


def _require_loop(design: Design, size: float) -> None:
    """Refuse a size that would not leave a closed curve closed."""
    if not size > 0.0:
        raise GeometryError(f"`size` must be greater than 0; got {size:g}")
    if design.closing != "open" and seam(design.points).winding:
        raise GeometryError(
            "`size` must stay: this curve goes round the axis, and smaller or larger it would not "
            "close; choose one that does not go round, such as Example 2"
        )


def _require_off_the_poles(made: Design, size: float) -> None:
    """Refuse a loop that is too large for the chart; a smaller one always leads away from there."""
    v = np.array(made.points)[:, 1]
    if not (v.min() > 0.0 and v.max() < math.pi):
        raise GeometryError(
            f"`size` {size:g} would take control points to a pole or beyond: 0 < v < π must hold "
            "for all of them; make the loop smaller, or drag it away from the pole first"
        )


class OnceRound(LabApp):
    """A closed design with its orthogonal trajectory, ξ, enclosed region and the three counts."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.figure, self.view = ChartFigure(lab), SurfaceView(620, 400)
        self.view.show(frame=False)
        self.time, self.fields = TimeControl(lab), FieldControl(lab)
        self.history, self.gallery = HistoryControl(lab), GalleryControl(lab)
        self.size, self.own = SizeControl(lab), Group()
        words = "w₀, how far from the striction point the trajectory starts"
        self.start = NumberControl(self.own, "w₀", words, (-1.5, 1.5), 0.01, self.begin)
        self.legend = w.HTML(legend(LEGEND, LIGHT))
        self.region, self.numbers, self.seam, self.shrunk = (w.HTML() for _ in range(4))
        self._full: tuple[Design, Dual | None] | None = None
        self._w0, self._path = 0.3, path_of(lab.result.surface, 0.3)
        self.start.show(self._w0)
        self._views = [self.view]
        self._groups = [self.time, self.fields, self.history, self.gallery, self.size, self.own]
        self._releases.append(self.figure.close)
        self.assemble(self._layout())

    def _layout(self) -> Any:
        head = w.Box([self.gallery.widget, self.history.widget]).add_class("ruledlab-head")
        size = [self.size.widget, self.shrunk]
        hand = w.VBox([self.figure, *size]).add_class("ruledlab-hand")
        edit = w.VBox([self.region, self.fields.widget]).add_class("ruledlab-edit")
        move = [self.view.widget, self.legend, self.time.widget, self.start.widget]
        right = w.VBox([*move, self.numbers, self.seam]).add_class("ruledlab-right")
        foot = w.VBox([self.gallery.note]).add_class("ruledlab-foot")
        return w.Box([head, hand, edit, right, foot]).add_class("ruledlab-grid")

    def restyle(self, dark: bool) -> None:
        """Change the picture to the light or the dark theme, and the legend with it."""
        super().restyle(dark)
        self.legend.value = legend(LEGEND, DARK if dark else LIGHT)

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
        region = "" if ways.region is None else region_svg(ways.region, self._frame(ways.region))
        self.own.put(self.region, value=region)
        self.own.put(self.numbers, value=numbers_html(ways, self._path) + unsaid)
        self.own.put(self.seam, value=seam_html(self.lab))
        self.own.put(self.shrunk, value=size_html(ways.total, self._at_full_size(ways)))

    def _at_full_size(self, ways: Ways) -> Dual | None:
        """Return Λ of the loop at size 1 with the present fields; a move of the size finds it."""
        full = self.lab.design.with_(points=self.size.whole, length=1.0, samples=8, name="")
        if full.points == self.lab.design.points:
            self._full = full, ways.total
        elif self._full is None or self._full[0] != full:
            self._full = full, total_of(full.surface())
        return self._full[1]

    def _frame(self, region: Enclosed) -> Array | None:
        """Return the outline at size 1, where this is another: the picture compares the two."""
        if self.size.value == 1.0:
            return None
        centre = middle(self.size.whole)
        return centre + (region.outline - centre) / self.size.value
