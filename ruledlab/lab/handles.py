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
import numpy as np
import traitlets

from ..geometry.checks import Array
from .palette import DARK, LIGHT, Theme
from .sight import FIELD_OF_VIEW, turned
from .view3d import SurfaceView

__all__ = ["Eye", "Grasp", "Grip", "Handles"]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_COLOURS: Final = ("kappa", "tau", "sigma", "delta")
NEAREST: Final = 1e-6


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


@dataclass(frozen=True, eq=False, slots=True)
class Eye:
    """A camera with a picture of ``size`` pixels.

    Attributes
    ----------
    position, quaternion
        where it stands, and the turn (x, y, z, w) that takes it there from looking along −z.
    size
        width and height of the picture.
    """

    position: Array
    quaternion: Array
    size: tuple[float, float]

    @property
    def _axes(self) -> Array:
        """Right, up and backwards, as rows."""
        return np.array([turned(self.quaternion, axis) for axis in np.eye(3)])

    @property
    def _scale(self) -> float:
        """Pixels for a unit of length at the depth 1."""
        return 0.5 * self.size[1] / math.tan(math.radians(FIELD_OF_VIEW / 2))

    def seen(self, point: Array) -> tuple[float, float, float]:
        """Return where a point is in the picture, from its upper left corner, and its depth."""
        right, up, back = self._axes @ (point - self.position)
        depth = max(-float(back), NEAREST)
        x, y = (self._scale * float(part) / depth for part in (right, up))
        return 0.5 * self.size[0] + x, 0.5 * self.size[1] - y, -float(back)

    def at(self, x: float, y: float, depth: float) -> Array:
        """Return the point of space at a place of the picture, in a given depth."""
        aside = (x - 0.5 * self.size[0], 0.5 * self.size[1] - y)
        place = np.array([*aside, -self._scale]) * depth / self._scale
        there: Array = self.position + place @ self._axes
        return there


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
        view._camera.observe(self._look, "position")
        self._follows = True

    @property
    def eye(self) -> Eye:
        """The view's camera, as the browser has reported it last."""
        camera, canvas = self._view._camera, self._view._renderer
        size = float(canvas.width), float(canvas.height)
        return Eye(np.array(camera.position), np.array(camera.quaternion), size)

    def draw(self, grips: Sequence[Grip]) -> None:
        """Show handles in place of those shown before."""
        self._grips = tuple(grips)
        eye = self.eye
        handles = [_handle(grip, eye) for grip in self._grips]
        self.picture = {"size": list(eye.size), "handles": handles}

    def on_grasp(self, callback: Callable[[Grasp], None]) -> Callable[[], None]:
        """Call back with each `Grasp`; return the function that ends this."""
        self._listeners.append(callback)
        return lambda: self._listeners.remove(callback) if callback in self._listeners else None

    def close(self) -> None:
        """Leave the camera alone and remove the handles from every page."""
        if self._follows:
            self._view._camera.unobserve(self._look, "position")
        self._follows = False
        self._listeners.clear()
        self.unobserve_all()
        self.layout.close()
        super().close()

    def _look(self, _change: Any) -> None:
        self.draw(self._grips)

    def _asked(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [str(view), int(drag), int(index), float() | int() as x, float() | int() as y] if (
                0 <= index < len(self._grips) and math.isfinite(x) and math.isfinite(y)
            ):
                eye = self.eye
                *_, depth = eye.seen(self._grips[index].place)
                place = eye.at(float(x), float(y), depth)
                for listener in tuple(self._listeners):
                    listener(Grasp(index, place, (view, drag)))


def _handle(grip: Grip, eye: Eye) -> dict[str, Any]:
    x, y, depth = eye.seen(grip.place)
    at = (round(x, 2), round(y, 2)) if depth > NEAREST else (None, None)
    return {"kind": grip.kind, "colour": grip.colour, "label": grip.label, "x": at[0], "y": at[1]}
