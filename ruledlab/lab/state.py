"""`Lab`: one frozen design and one cursor in, one read-only result out.

A control replaces ``lab.design`` whole; the lab computes once and tells its followers, which update
what they have drawn. Observers may run in a thread beside other cells, so all of it happens under
one lock. Geometry raises `GeometryError` for a design that cannot be; the lab catches that, keeps
the last good result and says what is wrong. Any other exception is a defect and is not caught here.
"""

from __future__ import annotations

import functools
import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from ..design import Design
from ..geometry.checks import GeometryError
from ..geometry.closed import Closure
from ..geometry.dual import Dual
from ..geometry.surface import RuledSurface
from .scene import COLOURINGS, Mark, Scene, build_mark, build_scene

__all__ = ["Change", "Lab", "Result"]

Disconnect = Callable[[], None]
_Step = tuple[Design, bool]  # the design at the other end of a step; whether the step was a load

MOST_STEPS = 500
"""Designs that are remembered for undo."""


@dataclass(frozen=True, eq=False)
class Result:
    """Everything that follows from a design; the pitch is computed when it is first asked for.

    Attributes
    ----------
    design
        the design it belongs to.
    surface
        its surface.
    scene
        what there is to draw.
    closure
        whether and how it closes.
    """

    design: Design
    surface: RuledSurface
    scene: Scene
    closure: Closure

    @property
    def pitch(self) -> Dual | None:
        """Λ = λ + ε l, or None where the surface does not close as an oriented motion."""
        return self._pitch[0]

    @property
    def pitch_note(self) -> str:
        """Why there is no Λ, or a remark on it."""
        return self._pitch[1]

    @functools.cached_property
    def _pitch(self) -> tuple[Dual | None, str]:
        """Pictures need not wait for it: its integrals cost as much as a scene."""
        return _pitch(self.surface, self.closure)


@dataclass(frozen=True, slots=True)
class Change:
    """What a follower is told.

    Attributes
    ----------
    scene
        the design or its colouring changed: draw the scene and the mark.
    mark
        the cursor moved.
    chosen
        another control point was chosen.
    error
        what is wrong with the last attempt, for the control ``source``; None if nothing is.
    source
        the control that caused the change.
    loaded
        another design was put in place, by gallery, file, text or reset, or such a step was undone
        or redone. A move of a point that is undone is none: the reader's view stays.
    """

    scene: bool = False
    mark: bool = False
    chosen: bool = False
    error: str | None = None
    source: str = ""
    loaded: bool = False


def compute(design: Design, colouring: str) -> Result:
    """Return everything that follows from a design."""
    surface = design.surface()
    closure = surface.closure()
    scene = build_scene(design, surface, closure.closed, colouring)
    return Result(design, surface, scene, closure)


def _pitch(surface: RuledSurface, closure: Closure) -> tuple[Dual | None, str]:
    if not closure.oriented:
        return None, closure.reason
    try:
        return surface.dual_angle_of_pitch(), closure.reason
    except GeometryError as error:
        return None, f"{closure.reason}; {error}"


class Lab:
    """The state of one laboratory.

    Parameters
    ----------
    design
        where to begin.
    cursor
        the value of t that is looked at.

    Raises
    ------
    GeometryError
        if the design has no surface.
    """

    def __init__(self, design: Design, cursor: float = 0.0) -> None:
        self._lock = threading.RLock()
        self._followers: dict[object, Callable[[Change], None]] = {}
        self._first = design
        self._undo: list[_Step] = []
        self._redo: list[_Step] = []
        self._group: object = None
        self._colouring = "plain"
        self._chosen = 0
        self._result = compute(design, self._colouring)
        self._cursor = self._inside(cursor)
        self._mark = build_mark(design, self._result.surface, self._cursor)

    # -- what there is ---------------------------------------------------------------------------

    @property
    def design(self) -> Design:
        """The present design."""
        return self._result.design

    @property
    def result(self) -> Result:
        """Everything that follows from the design."""
        return self._result

    @property
    def mark(self) -> Mark:
        """Everything that follows from the cursor."""
        return self._mark

    @property
    def cursor(self) -> float:
        """The t that is looked at."""
        return self._cursor

    @property
    def chosen(self) -> int:
        """Index of the chosen control point."""
        return self._chosen

    @property
    def colouring(self) -> str:
        """What the surface is coloured by: a key of `scene.COLOURINGS`."""
        return self._colouring

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to take back."""
        return bool(self._undo)

    @property
    def can_redo(self) -> bool:
        """Whether a step was taken back."""
        return bool(self._redo)

    def follow(self, callback: Callable[[Change], None]) -> Disconnect:
        """Call ``callback`` with each `Change`; the returned function stops that."""
        key = object()  # the same callback may follow twice
        with self._lock:
            self._followers[key] = callback

        def disconnect() -> None:
            with self._lock:
                self._followers.pop(key, None)

        return disconnect

    # -- changes ---------------------------------------------------------------------------------

    def edit(self, source: str, group: object = None, **changes: Any) -> bool:
        """Replace entries of the design; return whether that gave a surface.

        Parameters
        ----------
        source
            the control that asks: an error is shown beside it.
        group
            changes in a row with an equal group that is not None are one step of undo.
        changes
            entries of `Design`.
        """
        return self.attempt(source, lambda: self.design.with_(**changes), group)

    def attempt(self, source: str, make: Callable[[], Design], group: object = None) -> bool:
        """Put the design that ``make`` returns in place, or keep the old one and say why."""
        return self._try(make, source, group, loaded=False)

    def load(self, design: Design, source: str) -> bool:
        """Put another design in place as one step of undo."""
        return self._try(lambda: design, source, None, loaded=True)

    def undo(self) -> None:
        """Take the last step back."""
        with self._lock:
            self._travel(self._undo, self._redo)

    def redo(self) -> None:
        """Take the last undone step again."""
        with self._lock:
            self._travel(self._redo, self._undo)

    def reset(self) -> None:
        """Return to the design the lab began with; undo leads back."""
        self.load(self._first, "reset")

    def move_cursor(self, t: float) -> None:
        """Look at another t, kept inside the domain; NaN is refused with a GeometryError."""
        with self._lock:
            t = self._inside(t)
            if t != self._cursor:
                self._mark = build_mark(self.design, self._result.surface, t)
                self._cursor = t
                self._tell(Change(mark=True))

    def choose(self, index: int) -> None:
        """Choose a control point."""
        with self._lock:
            index = max(0, min(int(index), len(self.design.points) - 1))
            if index != self._chosen:
                self._chosen = index
                self._tell(Change(chosen=True))

    def colour(self, colouring: str) -> None:
        """Colour the surface by δ, K, H or not at all."""
        if colouring not in COLOURINGS:
            raise GeometryError(
                f"`colouring` must be one of {', '.join(COLOURINGS)}; got {colouring!r}"
            )
        with self._lock:
            old = self._result
            scene = build_scene(old.design, old.surface, old.closure.closed, colouring)
            self._result, self._colouring = replace(old, scene=scene), colouring
            self._tell(Change(scene=True))

    def seal(self) -> None:
        """End a group: the next change is a new step of undo."""
        with self._lock:
            self._group = None

    # -- inside ----------------------------------------------------------------------------------

    def _inside(self, t: float) -> float:
        if math.isnan(t):
            raise GeometryError("`t` must be a number; got NaN; give a place along the curve")
        start, end = self._result.surface.domain
        return min(max(float(t), start), end)

    def _try(self, make: Callable[[], Design], source: str, group: object, *, loaded: bool) -> bool:
        with self._lock:
            try:
                change = self._put(make(), source, group, loaded)
            except GeometryError as error:
                change = Change(error=str(error), source=source)
            # Outside of the try: what a follower raises is no fault of the design.
            self._tell(change)
            return change.error is None

    def _put(self, design: Design, source: str, group: object, loaded: bool) -> Change:
        old = self.design
        if design == old:
            return Change(source=source)
        change = self._accept(design, source, loaded)
        if group is None or group != self._group:
            self._undo.append((old, loaded))
            del self._undo[:-MOST_STEPS]
        self._group = group
        self._redo.clear()
        return change

    def _travel(self, back: list[_Step], forth: list[_Step]) -> None:
        if back:
            old, (design, loaded) = self.design, back[-1]
            change = self._accept(design, "history", loaded)
            back.pop()
            forth.append((old, loaded))
            self._group = None
            self._tell(change)

    def _accept(self, design: Design, source: str, loaded: bool) -> Change:
        """Compute first: if that fails nothing has changed."""
        result = compute(design, self._colouring)
        mark = build_mark(design, result.surface, self._cursor)
        chosen = min(self._chosen, len(design.points) - 1)
        changed = chosen != self._chosen
        self._result, self._mark, self._chosen = result, mark, chosen
        return Change(scene=True, mark=True, chosen=changed, source=source, loaded=loaded)

    def _tell(self, change: Change) -> None:
        for key, callback in tuple(self._followers.items()):
            if key in self._followers:  # unless one told before it has ended it
                callback(change)
