"""What every app is made of: controls and views that live and close together."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from typing import Any, Final

import anywidget
import ipywidgets as w
import traitlets

from ..cells import closes_with_cell
from ..controls import Group, PointControl
from ..handles import Grasp, Handles
from ..pad import DomainPad, PadRequest
from ..palette import DARK, LIGHT, Theme
from ..plots import CurvePlots
from ..slate import Change, Slate
from ..state import Lab
from ..view3d import SurfaceView

__all__ = ["App", "LabApp", "Page", "close_all", "connect"]

_STATIC: Final = pathlib.Path(__file__).parent.parent / "static"
_STYLE: Final = (_STATIC / "studio.css").read_text(encoding="utf-8")


class Page(anywidget.AnyWidget):
    """What a ``ruledlab`` box needs of its page: names for its parts, its keys, the theme."""

    _esm = _STATIC / "names.js"

    dark = traitlets.Bool(False).tag(sync=True, echo_update=False)


class App(w.VBox):
    """Controls and views of one state that live and close together.

    A subclass makes its parts, lists them in ``_groups`` and ``_views``, puts what has to be ended
    into ``_releases``, and calls `assemble` last.

    Parameters
    ----------
    state
        a `Slate` or a `Lab`; several apps may show the same one.
    """

    def __init__(self, state: Slate[Any, Any]) -> None:
        self._groups: list[Group] = []
        self._views: list[Any] = []
        self._theme_listeners: list[Callable[[Theme], None]] = []
        # Before any control, so that the pictures are sent before the read-outs.
        self._releases: list[Callable[[], None]] = [state.follow(self.update)]
        super().__init__()
        self.add_class("ruledlab")

    def assemble(self, *parts: Any) -> None:
        """Show the parts, follow the state, and close when the notebook cell is run again."""
        defects = [group.defect for group in self._groups]
        self._page = Page()
        self.children = (w.HTML(f"<style>{_STYLE}</style>"), self._page, *parts, *defects)
        self._page.observe(self._follow_page, "dark")
        self._releases.append(self._page.unobserve_all)
        self.update(Change(scene=True, mark=True, chosen=True, loaded=True))
        closes_with_cell(self.close)

    def handles(
        self, group: Group, grasped: Callable[[Grasp], None], view: SurfaceView | None = None
    ) -> Handles:
        """Return handles that live as long as the app; what they ask for runs under a guard."""
        made = Handles(view)
        self._releases += [
            made.close,
            made.on_grasp(lambda grasp: group.guard(lambda: grasped(grasp))),
        ]
        return made

    def update(self, change: Change) -> None:
        """Draw what changed; a subclass says how."""
        raise NotImplementedError

    def on_theme(self, callback: Callable[[Theme], None]) -> Callable[[], None]:
        """Call back with the theme when the page's changes; return the function that ends it."""
        self._theme_listeners.append(callback)

        def disconnect() -> None:
            if callback in self._theme_listeners:
                self._theme_listeners.remove(callback)

        return disconnect

    def _follow_page(self, change: dict[str, Any]) -> None:
        """Follow the page; a defect is shown where the controls show theirs."""
        self._groups[0].guard(lambda: self.restyle(change["new"]))

    def restyle(self, dark: bool) -> None:
        """Change all views to the light or the dark theme."""
        theme = DARK if dark else LIGHT
        for restyle in (*(view.set_theme for view in self._views), *self._theme_listeners):
            restyle(theme)

    def close(self) -> None:
        """Close every widget and leave no observer behind; a second call does nothing."""
        self._theme_listeners.clear()
        while self._releases:
            self._releases.pop()()
        for group in self._groups:
            group.release()
        for view in self._views:
            view.close()
        close_all(self)

    def __del__(self) -> None:
        """Do nothing: the widget's own way is to close, which fails while Python shuts down."""


class LabApp(App):
    """An app of a `Lab`: its views draw the lab's scene and mark.

    Attributes
    ----------
    lab
        the state: design, cursor, result.
    """

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        super().__init__(lab)

    def update(self, change: Change) -> None:
        """Pass what changed in the lab to the views that there are."""
        for view in self._views:
            _draw(view, self.lab, change)


def _draw(view: Any, lab: Lab, change: Change) -> None:
    """Let one view draw what changed."""
    scene, mark = lab.result.scene, lab.mark
    match view:
        case CurvePlots() | SurfaceView() if change.scene:
            view.draw(scene, mark)
        case DomainPad() if change.scene or change.chosen:
            with view.hold_sync():
                view.draw(scene, chosen=lab.chosen, closing=lab.design.closing)
                view.draw_cursor(mark)
        case _ if change.mark:
            view.draw_cursor(mark)
    if isinstance(view, SurfaceView):
        if change.chosen:
            view.choose(lab.chosen)
        if change.loaded:
            view.reset_view(scene)


def connect(pad: DomainPad, points: PointControl) -> Callable[[], None]:
    """Let the pad's requests change the lab; return the function that ends it."""
    return pad.on_request(lambda request: points.guard(lambda: _ask(request, pad, points)))


def _ask(request: PadRequest, pad: DomainPad, points: PointControl) -> None:
    lab, to = points.lab, (request.u, request.v)
    match request.kind:
        case "choose":
            lab.choose(request.index)
            return
        case "add":
            done = points.insert_at(request.index, to)
        case "remove":
            done = points.remove_at(request.index)
        case _:
            done = points.place(request.index, to, ("pad", id(pad), request.drag))
    if request.kind == "end":
        lab.seal()
    if not done:
        pad.draw(lab.result.scene, chosen=lab.chosen, closing=lab.design.closing)


def close_all(widget: Any) -> None:
    """Close a widget and all that it is made of."""
    for child in getattr(widget, "children", ()):
        close_all(child)
    for owned in (getattr(widget, "layout", None), getattr(widget, "style", None)):
        if isinstance(owned, w.Widget):
            owned.close()
    w.Widget.close(widget)
