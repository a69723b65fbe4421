"""The interactive apps: a `Lab`, its controls and its views, laid out. One function for each.

The studio is laid out as an instrument: the chart, where the hand works, stands first; the surface
beside it; under each of them the numbers that belong to it. What changes with every move keeps its
place, and what is used once in a while is folded away at the foot.
"""

from __future__ import annotations

import pathlib
from typing import Any, Final

import ipywidgets as w

from ..design import Design
from ..geometry import gallery
from .cells import closes_with_cell
from .controls import (
    FieldControl,
    GalleryControl,
    HistoryControl,
    LookControl,
    PointControl,
    Readouts,
    TimeControl,
    design_of,
)
from .pad import DomainPad, PadRequest
from .palette import DARK, LIGHT
from .plots import CurvePlots
from .share import Share
from .state import Change, Lab
from .view3d import SurfaceView

__all__ = ["Studio", "studio"]

_STYLE: Final = (pathlib.Path(__file__).parent / "static" / "studio.css").read_text()


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
    return Studio(Lab(design or design_of(gallery.example("example_2"))))


class Studio(w.VBox):
    """Chart, surface, plots and numbers of one lab.

    Attributes
    ----------
    lab
        the state: design, cursor, result.
    """

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        self.pad = DomainPad()
        self.plots = CurvePlots()
        self.view = SurfaceView(620, 400)
        self.points = PointControl(lab)
        self.fields = FieldControl(lab)
        self.time = TimeControl(lab)
        self.history = HistoryControl(lab)
        self.gallery = GalleryControl(lab)
        self.look = LookControl(lab, self.view, self.plots)
        self.readouts = Readouts(lab)
        self.share = Share(lab, self.plots.export)
        self._groups = (
            self.points,
            self.fields,
            self.time,
            self.history,
            self.gallery,
            self.look,
            self.readouts,
            self.share,
        )
        super().__init__([w.HTML(f"<style>{_STYLE}</style>"), self._grid()])
        self.add_class("ruledlab")
        self._releases = [
            lab.follow(self._update),
            self.pad.on_request(lambda request: self.points.guard(lambda: self._ask(request))),
            self.pad.on_theme(self._restyle),
            self.plots.on_pick(lab.move_cursor),
        ]
        self._update(Change(scene=True, mark=True, chosen=True, loaded=True))
        closes_with_cell(self.close)

    def _grid(self) -> Any:
        head = w.Box(
            [self.gallery.widget, self.history.widget, self.look.bar, self.look.legend]
        ).add_class("ruledlab-head")
        left = w.VBox(
            [self.pad, self.points.widget, self.fields.widget, self.readouts.widget]
        ).add_class("ruledlab-left")
        right = w.VBox(
            [self.view.widget, self.time.widget, self.look.plot_bar, self.plots.widget]
        ).add_class("ruledlab-right")
        foot = w.VBox([self.gallery.note, self._folded()]).add_class("ruledlab-foot")
        return w.Box([head, left, right, foot]).add_class("ruledlab-grid")

    def _folded(self) -> Any:
        folded = w.Accordion([self.look.more, self.share.widget, self.readouts.words])
        folded.titles = ("Drawing", "Save, open, share", "In words")
        return folded

    # -- from the lab to the views ---------------------------------------------------------------

    def _update(self, change: Change) -> None:
        result, mark, lab = self.lab.result, self.lab.mark, self.lab
        if change.scene:
            self.plots.draw(result.scene, mark)
            with self.pad.hold_sync():
                self.pad.draw(result.scene, chosen=lab.chosen, closing=lab.design.closing)
                self.pad.draw_cursor(mark)
            self.view.draw(result.scene)
            self.view.draw_cursor(mark)
        elif change.mark:
            self.plots.draw_cursor(mark)
            self.pad.draw_cursor(mark)
            self.view.draw_cursor(mark)
        if change.chosen:
            self.pad.chosen = lab.chosen
            self.view.choose(lab.chosen)
        if change.loaded:
            self.view.reset_view(result.scene)

    # -- from the pad to the lab -----------------------------------------------------------------

    def _ask(self, request: PadRequest) -> None:
        to = (request.u, request.v)
        if request.kind == "choose":
            self.lab.choose(request.index)
            return
        if request.kind == "add":
            done = self.points.insert_at(request.index, to)
        elif request.kind == "remove":
            done = self.points.remove_at(request.index)
        else:
            done = self.points.place(request.index, to, ("pad", request.drag))
        if request.kind == "end":
            self.lab.seal()
        if not done:
            lab = self.lab
            self.pad.draw(lab.result.scene, chosen=lab.chosen, closing=lab.design.closing)

    def _restyle(self, dark: bool) -> None:
        theme = DARK if dark else LIGHT
        for view in (self.pad, self.plots, self.view):
            view.set_theme(theme)
        self.look.update(Change(scene=True))

    def close(self) -> None:
        """Close every widget and leave no observer behind; a second call does nothing."""
        while self._releases:
            self._releases.pop()()
        for group in self._groups:
            group.release()
        for part in (self.pad, self.plots, self.view):
            part.close()
        _close_all(self)


def _close_all(widget: Any) -> None:
    for child in getattr(widget, "children", ()):
        _close_all(child)
    for owned in (getattr(widget, "layout", None), getattr(widget, "style", None)):
        if isinstance(owned, w.Widget):
            owned.close()
    w.Widget.close(widget)
