"""Handles over a picture: places of it that the reader takes and moves in its plane.

The handles lie over the canvas of a `SurfaceView` and follow its camera, or over a drawing, whose
axes are told by a `Flat`. A handle that is dragged stays as far from the eye as it was. What the
reader asks for arrives in Python as a `Grasp`; the browser moves no handle before Python has
answered with `Handles.draw`.
"""

from __future__ import annotations

import math
import pathlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol

import anywidget
import ipywidgets as w
import traitlets

from ..geometry.checks import Array
from .palette import DARK, LIGHT, Theme
from .sight import NEAREST
from .view3d import SurfaceView

__all__ = ["Grasp", "Grip", "Handles", "Sight"]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_COLOURS: Final = ("kappa", "tau", "sigma", "delta", "cursor")


def _style(theme: Theme) -> str:
    """Return the colours of handles, and of words about them, on a page of the theme's kind."""
    page = 'body[data-jp-theme-light="false"] ' if theme.dark else ""
    colours = {name: getattr(theme, name) for name in _COLOURS}
    return "".join(f"{page}.ruledlab-hue.is-{n}{{fill:{c};color:{c}}}" for n, c in colours.items())


class Sight(Protocol):
    """How the places of a picture are seen in it: an `Eye` or a `Flat`."""

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the picture, in the unit of `seen`."""

    def seen(self, point: Array) -> tuple[float, float, float]:
        """Return where a point is, from the upper left corner, and its depth; 0 is out of sight."""

    def at(self, x: float, y: float, depth: float) -> Array:
        """Return the point at a place of the picture, in a given depth."""


@dataclass(frozen=True, eq=False, slots=True)
class Grip:
    """A place of a picture that can be taken.

    Attributes
    ----------
    place
        (3,), the point.
    kind
        ``"point"``, drawn as a disc, or ``"direction"``, drawn as a diamond.
    colour
        the name of a colour of the theme.
    label
        what it is, in words.
    """

    place: Array
    kind: str
    colour: str
    label: str


@dataclass(frozen=True, eq=False, slots=True)
class Grasp:
    """Where the reader wants a handle.

    Attributes
    ----------
    index
        which of the handles drawn last.
    place
        (3,), the place under the pointer, as far from the eye as the handle is.
    drag
        equal in all requests of one drag or one run of keys: they are one step to undo.
    """

    index: int
    place: Array
    drag: tuple[str, int]


class Handles(anywidget.AnyWidget):
    """Handles in a picture; `over` gives the box that holds both.

    Parameters
    ----------
    view
        the picture under the handles, whose camera is followed; None over a drawing, which is an
        SVG with the role ``img``.
    """

    _esm = _STATIC / "handles.js"
    _css = (_STATIC / "handles.css").read_text(encoding="utf-8") + _style(LIGHT) + _style(DARK)

    picture = traitlets.Dict().tag(sync=True)
    motion: traitlets.List[Any] = traitlets.List().tag(sync=True, echo_update=False)

    def __init__(self, view: SurfaceView | None = None) -> None:
        self._view = view
        self._grips: tuple[Grip, ...] = ()
        self._sight: Sight | None = None
        self._listeners: list[Callable[[Grasp], None]] = []
        super().__init__()
        self.observe(self._asked, "motion")
        self._unfollow = None if view is None else view.on_turn(lambda: self.draw(self._grips))

    def draw(self, grips: Sequence[Grip], sight: Sight | None = None) -> None:
        """Show handles in place of those shown before; over a drawing ``sight`` is needed."""
        sight = sight if self._view is None else self._view.eye
        if grips and sight is None:
            raise ValueError("handles over a drawing need its `sight`: pass a Flat")
        self._grips, self._sight = tuple(grips), sight
        handles = [_handle(grip, sight) for grip in self._grips]
        self.picture = {"size": list(sight.size) if sight else [1, 1], "handles": handles}

    def over(self, picture: Any) -> Any:
        """Return a box with a picture and, over it, these handles."""
        return w.Box([picture, self]).add_class("ruledlab-space")

    def on_grasp(self, callback: Callable[[Grasp], None]) -> Callable[[], None]:
        """Call back with each `Grasp`; return the function that ends this."""
        self._listeners.append(callback)
        return lambda: self._listeners.remove(callback) if callback in self._listeners else None

    def close(self) -> None:
        """Leave the camera alone and remove the handles from every page."""
        if self._unfollow is not None:
            self._unfollow()
        self._listeners.clear()
        self.unobserve_all()
        self.layout.close()
        super().close()

    def _asked(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [str(view), int(drag), int(index), float() | int() as x, float() | int() as y] if (
                self._sight and 0 <= index < len(self._grips) and math.isfinite(x + y)
            ):
                *_, depth = self._sight.seen(self._grips[index].place)
                place = self._sight.at(float(x), float(y), depth)
                for listener in tuple(self._listeners):
                    listener(Grasp(index, place, (view, drag)))


def _handle(grip: Grip, sight: Sight) -> dict[str, Any]:
    x, y, depth = sight.seen(grip.place)
    at = (round(x, 2), round(y, 2)) if depth > NEAREST else (None, None)
    return {"kind": grip.kind, "colour": grip.colour, "label": grip.label, "x": at[0], "y": at[1]}
