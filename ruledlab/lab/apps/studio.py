"""The whole laboratory, and its single views as linked figures.

The studio is laid out as an instrument: the chart, where the hand works, stands first; the surface
beside it; under each of them the numbers that belong to it. What changes with every move keeps its
place, and what is used once in a while is folded away at the foot.
"""

from __future__ import annotations

from typing import Any

import ipywidgets as w

from ...design import Design
from ...geometry import gallery
from ..controls import (
    FieldControl,
    GalleryControl,
    HistoryControl,
    LookControl,
    PointControl,
    Readouts,
    TimeControl,
    design_of,
)
from ..pad import DomainPad
from ..plots import CurvePlots
from ..share import Share
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp, connect

__all__ = [
    "ChartFigure",
    "SpaceFigure",
    "Studio",
    "chart",
    "example",
    "sphere",
    "studio",
    "surface",
]


def studio(design: Design | None = None) -> Studio:
    """Return the full interactive laboratory as a widget.

    Parameters
    ----------
    design
        where to begin; None for the paper's Example 2.

    Returns
    -------
    Studio
        a widget with the state as ``.lab``. Running the cell again closes it.

    Examples
    --------
    >>> from ruledlab.lab import studio  # doctest: +SKIP
    >>> studio()  # doctest: +SKIP
    """
    return Studio(Lab(design or example("example_2")))


def example(key: str) -> Design:
    """Return a surface of the gallery as a design: ``example("hyperboloid")``."""
    return design_of(gallery.example(key))


def chart(lab: Lab) -> ChartFigure:
    """Return the chart of a lab: its control points, to be moved."""
    return ChartFigure(lab)


def sphere(lab: Lab) -> SpaceFigure:
    """Return the unit sphere of a lab with the spherical image."""
    return SpaceFigure(lab, sphere=True)


def surface(lab: Lab) -> SpaceFigure:
    """Return the surface of a lab with its striction curve and moving frame."""
    return SpaceFigure(lab, sphere=False)


class Studio(LabApp):
    """Chart, surface, plots and numbers of one lab."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.pad, self.plots, self.view = DomainPad(), CurvePlots(), SurfaceView(620, 400)
        self.points, self.fields, self.time = PointControl(lab), FieldControl(lab), TimeControl(lab)
        self.history, self.gallery = HistoryControl(lab), GalleryControl(lab)
        self.look = LookControl(lab, self.view, self.plots)
        self.readouts, self.share = Readouts(lab), Share(lab, self.plots.export)
        self._views = [self.plots, self.view, self.pad]  # in the order they are sent
        self._groups = [self.points, self.fields, self.time, self.history, self.gallery]
        self._groups += [self.look, self.readouts, self.share]
        self._releases += [
            connect(self.pad, self.points),
            self.plots.on_pick(lambda t: self.time.guard(lambda: lab.move_cursor(t))),
        ]
        self.assemble(self._grid())

    def _grid(self) -> Any:
        head = w.Box(
            [self.gallery.widget, self.history.widget, self.look.bar, self.look.legend]
        ).add_class("ruledlab-head")
        hand = w.VBox([self.pad]).add_class("ruledlab-hand")
        edit = w.VBox([self.points.widget, self.fields.widget, self.readouts.widget]).add_class(
            "ruledlab-edit"
        )
        right = w.VBox(
            [self.view.widget, self.time.widget, self.look.plot_bar, self.plots.widget]
        ).add_class("ruledlab-right")
        folded = w.Accordion([self.look.more, self.share.widget, self.readouts.words])
        folded.titles = ("Drawing", "Save, open, share", "In words")
        folded.observe(self._unfolded, "selected_index")
        foot = w.VBox([self.gallery.note, folded]).add_class("ruledlab-foot")
        return w.Box([head, hand, edit, right, foot]).add_class("ruledlab-grid")

    def _unfolded(self, change: dict[str, Any]) -> None:
        """Keep up to date only what is open: a move should cost no more than it shows."""
        self.share.listen(change["new"] == 1)
        self.readouts.listen(change["new"] == 2)

    def restyle(self, dark: bool) -> None:
        """Change all views to the light or the dark theme, and the legend with them."""
        super().restyle(dark)
        self.look.update(Change(scene=True))


class ChartFigure(LabApp):
    """The chart alone: control polygon, curve and closing (the paper's Figure 2)."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.pad, self.points = DomainPad(), PointControl(lab)
        self._views, self._groups = [self.pad], [self.points]
        self._releases += [
            connect(self.pad, self.points),
        ]
        self.assemble(w.HBox([self.pad, self.points.widget]).add_class("ruledlab-pair"))


class SpaceFigure(LabApp):
    """One view in space with the cursor t below it: sphere (Figure 3) or surface (Figure 4)."""

    def __init__(self, lab: Lab, *, sphere: bool) -> None:
        super().__init__(lab)
        self.view, self.time = SurfaceView(620, 380), TimeControl(lab)
        self._views, self._groups = [self.view], [self.time]
        if sphere:
            self.view.sphere("only")
            self.view.show(surface=False, rulings=False, striction=False, frame=False)
        self.assemble(self.view.widget, self.time.widget)
