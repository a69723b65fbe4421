"""Handles over a picture of space: places of it that the reader takes and moves in its plane.

The handles lie over the canvas of a `SurfaceView` and follow its camera. A handle that is dragged
stays as far from the eye as it was. What the reader asks for arrives in Python as a `Grasp`; the
browser moves no handle before Python has answered with `Handles.draw`.
"""

from __future__ import annotations

import math
import pathlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import anywidget
import traitlets

from ..geometry.checks import Array
from .palette import DARK, LIGHT, Theme
from .sight import NEAREST, Eye
from .view3d import SurfaceView

__all__ = ["Grasp", "Grip", "Handles"]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_COLOURS: Final = ("kappa", "tau", "sigma", "delta")


def _style(theme: Theme) -> str:
    """Return the colours of handles, and of words about them, on a page of the theme's kind."""
    page = 'body[data-jp-theme-light="false"] ' if theme.dark else ""
    colours = {name: getattr(theme, name) for name in _COLOURS}
    return "".join(f"{page}.ruledlab-hue.is-{n}{{fill:{c};color:{c}}}" for n, c in colours.items())


@dataclass(frozen=True, eq=False, slots=True)
class Grip:
    """A place of space that can be taken.

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
    """Handles in the picture of a view; a box with the class ``ruledlab-space`` holds both.

    Parameters
    ----------
    view
        the picture under the handles; its camera is followed.
    """

    _esm = _STATIC / "handles.js"
    _css = (_STATIC / "handles.css").read_text(encoding="utf-8") + _style(LIGHT) + _style(DARK)

    picture = traitlets.Dict().tag(sync=True)
    motion: traitlets.List[Any] = traitlets.List().tag(sync=True, echo_update=False)

    def __init__(self, view: SurfaceView) -> None:
        self._view = view
        self._grips: tuple[Grip, ...] = ()
        self._listeners: list[Callable[[Grasp], None]] = []
        super().__init__()
        self.observe(self._asked, "motion")
        self._unfollow = view.on_turn(lambda: self.draw(self._grips))

    def draw(self, grips: Sequence[Grip]) -> None:
        """Show handles in place of those shown before."""
        self._grips = tuple(grips)
        eye = self._view.eye
        handles = [_handle(grip, eye) for grip in self._grips]
        self.picture = {"size": list(eye.size), "handles": handles}

    def on_grasp(self, callback: Callable[[Grasp], None]) -> Callable[[], None]:
        """Call back with each `Grasp`; return the function that ends this."""
        self._listeners.append(callback)
        return lambda: self._listeners.remove(callback) if callback in self._listeners else None

    def close(self) -> None:
        """Leave the camera alone and remove the handles from every page."""
        self._unfollow()
        self._listeners.clear()
        self.unobserve_all()
        self.layout.close()
        super().close()

    def _asked(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [str(view), int(drag), int(index), float() | int() as x, float() | int() as y] if (
                0 <= index < len(self._grips) and math.isfinite(x) and math.isfinite(y)
            ):
                eye = self._view.eye
                *_, depth = eye.seen(self._grips[index].place)
                place = eye.at(float(x), float(y), depth)
                for listener in tuple(self._listeners):
                    listener(Grasp(index, place, (view, drag)))


def _handle(grip: Grip, eye: Eye) -> dict[str, Any]:
    x, y, depth = eye.seen(grip.place)
    at = (round(x, 2), round(y, 2)) if depth > NEAREST else (None, None)
    return {"kind": grip.kind, "colour": grip.colour, "label": grip.label, "x": at[0], "y": at[1]}
