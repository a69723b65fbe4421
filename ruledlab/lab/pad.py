"""The domain pad: the (u, v) chart of the unit sphere with control points one can drag.

The browser moves the handles and draws what it is sent; it computes no curve. What it asks for
arrives in Python as a `PadRequest`; what is to be seen goes back with `DomainPad.draw`.

A handle follows the pointer at once. Python's answer comes later and shows where the point was
some moments ago, so every picture says which request it answers, and the browser lets go of a
handle it holds only when the answer to its last request has come.

A pad may show more of the chart than its curve: signs of a field below the curve
(`DomainPad.draw_signs`), and a ring about a place that is looked at (`DomainPad.draw_place`), which
the reader may take elsewhere if somebody listens (`DomainPad.on_look`).
"""

from __future__ import annotations

import math
import pathlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from threading import RLock
from typing import Any, Final, Literal, get_args

import anywidget
import numpy as np
import traitlets

from ruledlab.lab.palette import LIGHT, Theme
from ruledlab.lab.scene import Mark, Scene
from ruledlab.lab.signs import Signs

__all__ = ["Closing", "DomainPad", "PadRequest"]

Closing = Literal["open", "C0", "C1", "C2"]
Kind = Literal["move", "end", "choose", "add", "remove"]
Disconnect = Callable[[], None]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_VIEWS_REMEMBERED: Final = 16


@dataclass(frozen=True, slots=True)
class PadRequest:
    """What the reader asked the pad for.

    Attributes
    ----------
    kind
        ``"move"``: put the point there, more may follow; ``"end"``: put it there, the drag is over;
        ``"choose"``: the reader turned to this point; ``"add"``: a new point; ``"remove"``: away
        with this one.
    index
        The control point meant. For ``"add"`` the index the new point shall have: it goes in before
        the present point of that index, and the number of points means at the end.
    u, v
        Longitude and colatitude in radians: where the point is to be (``move``, ``end``, ``add``)
        or is (``choose``, ``remove``).
    drag
        The same positive integer in all requests of one drag (or of one run of arrow keys), never
        used again by this pad; 0 outside drags. Requests of one drag are one step to undo.
    """

    kind: Kind
    index: int
    u: float
    v: float
    drag: int


class DomainPad(anywidget.AnyWidget):
    """Show the chart of the unit sphere and take the reader's hand.

    The pad changes no design: it reports requests (`on_request`) and shows what it is given
    (`draw`). A handle stays where the reader holds it until a drag ends; then it goes where the
    scene drawn last has it, so a move that was refused or corrected is seen to be so.

    Attributes
    ----------
    chosen : int
        Index of the chosen control point. A ``"choose"`` request sets it before it is reported.
    closing : {"open", "C0", "C1", "C2"}
        Which condition ties the points at the seam; only marks it, ties nothing.
    aspect, min_height : float
        Width over height, and the least height in pixels. The width is the container's.
    """

    _esm = _STATIC / "pad.js"
    _css = _STATIC / "pad.css"

    # Python → browser. One trait for all that must agree in one frame.
    picture = traitlets.Dict().tag(sync=True)
    cursor = traitlets.List(traitlets.Float()).tag(sync=True)
    ring = traitlets.List(traitlets.Float()).tag(sync=True)
    signs = traitlets.Dict().tag(sync=True)
    looks = traitlets.Bool(False).tag(sync=True)
    colours = traitlets.Dict().tag(sync=True)
    aspect = traitlets.Float(1.15, min=0.5, max=4.0).tag(sync=True)
    min_height = traitlets.Float(240.0, min=120.0).tag(sync=True)

    # Browser → Python. These are traits because widgets send only the latest value of a trait
    # while the kernel is busy; sending it back to the browser would double the traffic.
    motion: traitlets.List[Any] = traitlets.List().tag(sync=True, echo_update=False)
    glance: traitlets.List[Any] = traitlets.List().tag(sync=True, echo_update=False)

    # Python only: they travel inside `picture`.
    chosen = traitlets.Int(0)
    closing = traitlets.Enum(list(get_args(Closing)), "open")

    def __init__(self, theme: Theme = LIGHT, **traits: Any) -> None:
        self._lock = RLock()
        self._points = b""
        self._curve = b""
        self._seen: dict[str, int] = {}
        self._drag: tuple[str, int] | None = None
        self._drags = 0
        self._listeners: list[Callable[[PadRequest], None]] = []
        self._lookers: list[Callable[[float, float], None]] = []
        super().__init__(**traits)
        self.set_theme(theme)
        self.on_msg(self._on_message)
        self.observe(self._on_motion, "motion")
        self.observe(self._on_glance, "glance")
        self.observe(self._on_mark, ["chosen", "closing"])

    def draw(
        self, scene: Scene, *, chosen: int | None = None, closing: Closing | None = None
    ) -> None:
        """Show a scene's control points and curve, in one update.

        Parameters
        ----------
        scene
            What to show; only ``control`` and ``chart`` are read.
        chosen, closing
            New values of the traits of the same name; None leaves them.
        """
        with self._lock, self.hold_sync():
            self._points = np.ascontiguousarray(scene.control, dtype="<f8").tobytes()
            self._curve = np.ascontiguousarray(scene.chart, dtype="<f4").tobytes()
            if chosen is not None:
                self.chosen = chosen
            if closing is not None:
                self.closing = closing
            self._send_picture()

    def draw_cursor(self, mark: Mark | None) -> None:
        """Show the cursor at (u(t), v(t)); hide it for None or where that is undefined."""
        with self._lock:
            self.cursor = _shown(None if mark is None else mark.chart)

    def draw_place(self, place: Iterable[float] | None) -> None:
        """Show a ring about a place (u, v) off the curve; hide it for None or NaN.

        While there is a ring the cursor is faint: the place is looked at, and not the curve.
        """
        with self._lock:
            self.ring = _shown(place)

    def draw_signs(self, signs: Signs | None) -> None:
        """Show signs under the curve and the handles, or none; what is shown is not sent again."""
        with self._lock:
            self.signs = {} if signs is None else signs.packed()

    def set_theme(self, theme: Theme) -> None:
        """Draw in a theme's colours from now on."""
        with self._lock:
            self.colours = asdict(theme)

    def on_request(self, callback: Callable[[PadRequest], None]) -> Disconnect:
        """Call back with each `PadRequest`; return the function that ends this."""
        return _attach(self._listeners, callback)

    def on_look(self, callback: Callable[[float, float], None]) -> Disconnect:
        """Call back with each place (u, v) the reader looks at; return the function that ends this.

        Only while somebody listens does the pad take a drag that begins on empty chart (with a
        finger: at the ring, or else the page could not be scrolled) for a look. A click there still
        adds a point. The place is the listener's: it is shown by `draw_place`.
        """
        detach = _attach(self._lookers, callback)
        self.looks = True

        def disconnect() -> None:
            detach()
            self.looks = bool(self._lookers)

        return disconnect

    def close(self) -> None:
        """Remove the pad from every page and forget all callbacks."""
        self._listeners.clear()
        self._lookers.clear()
        self.unobserve_all()
        self.on_msg(self._on_message, remove=True)
        super().close()

    # ---- from here on private ------------------------------------------------------------------

    def _send_picture(self) -> None:
        self.picture = {
            "points": self._points,
            "curve": self._curve,
            "chosen": self.chosen,
            "closing": self.closing,
            "seen": dict(self._seen),
        }

    def _on_mark(self, _change: Any) -> None:
        with self._lock:
            self._send_picture()

    def _on_motion(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [view, seq, drag, index, u, v]:
                self._take("move", view, seq, drag, index, u, v)

    def _on_glance(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [view, seq, u, v]:
                self._look(view, seq, u, v)

    def _on_message(self, _widget: Any, content: Any, _buffers: Any) -> None:
        match content:
            case {
                "kind": "end" | "choose" | "add" | "remove" as kind,
                "view": view,
                "seq": seq,
                "drag": drag,
                "index": index,
                "u": u,
                "v": v,
            }:
                self._take(kind, view, seq, drag, index, u, v)
            case {"kind": "look", "view": view, "seq": seq, "u": u, "v": v}:
                self._look(view, seq, u, v)
                with self._lock:
                    self._send_picture()  # the browser holds the ring until its answer comes

    def _take(self, kind: Kind, view: Any, seq: Any, drag: Any, index: Any, u: Any, v: Any) -> None:
        """Report a well-formed request that is news; leave anything else alone."""
        if not (_whole(seq, drag, index) and _finite(u, v) and isinstance(view, str)):
            return
        if not self._is_news(view, seq):
            return
        request = PadRequest(kind, index, float(u), float(v), self._number(view, drag))
        if kind == "choose":
            self._choose(index)
        for listener in tuple(self._listeners):
            listener(request)
        if kind == "end":
            with self._lock:
                self._send_picture()  # sends nothing if a listener has drawn

    def _look(self, view: Any, seq: Any, u: Any, v: Any) -> None:
        """Report a well-formed look that is news; leave anything else alone."""
        if not (_whole(seq) and _finite(u, v) and isinstance(view, str)):
            return
        if not self._is_news(view, seq):
            return
        for listener in tuple(self._lookers):
            listener(float(u), float(v))

    def _is_news(self, view: str, seq: int) -> bool:
        # The widget layer holds a move back while the kernel is busy, an "end" not: the last move
        # may come after the end of its drag, and must not count any more.
        with self._lock:
            if seq <= self._seen.get(view, -1):
                return False
            self._seen.pop(view, None)
            self._seen[view] = seq
            if len(self._seen) > _VIEWS_REMEMBERED:
                del self._seen[next(iter(self._seen))]
            return True

    def _number(self, view: str, drag: int) -> int:
        """Give a view's drag a number of its own among the drags of all views."""
        if drag <= 0:
            return 0
        if (view, drag) != self._drag:
            self._drag = (view, drag)
            self._drags += 1
        return self._drags

    def _choose(self, index: int) -> None:
        with self._lock, self.hold_sync():
            self.chosen = index
            self._send_picture()  # the same index needs its answer too


def _attach(listeners: list[Any], callback: Callable[[Any], None]) -> Disconnect:
    listeners.append(callback)

    def disconnect() -> None:
        if callback in listeners:
            listeners.remove(callback)

    return disconnect


def _shown(place: Iterable[float] | None) -> list[float]:
    """Return a place as it is sent; empty where there is none, for JSON knows no NaN."""
    known = [] if place is None else [float(x) for x in place]
    return known if all(map(math.isfinite, known)) else []


def _whole(*numbers: Any) -> bool:
    return all(type(n) is int and n >= 0 for n in numbers)


def _finite(*numbers: Any) -> bool:
    return all(type(x) in (int, float) and math.isfinite(x) for x in numbers)
