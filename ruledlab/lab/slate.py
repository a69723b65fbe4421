"""`Slate`: one frozen value in, one read-only result out, with followers and undo.

A control replaces the value whole; the slate computes once and tells its followers, which update
what they have drawn. Observers may run in a thread beside other cells, so all of it happens under
one lock. Geometry raises `GeometryError` for a value that cannot be; the slate catches that, keeps
the last good result and says what is wrong. Any other exception is a defect and is not caught here.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from ..geometry.checks import GeometryError

__all__ = ["Change", "Disconnect", "Slate"]

Value = TypeVar("Value")
Result = TypeVar("Result")
Disconnect = Callable[[], None]

MOST_STEPS = 500
"""Values that are remembered for undo."""


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


class Slate(Generic[Value, Result]):
    """A frozen value, what follows from it, and the steps that led there.

    Parameters
    ----------
    value
        where to begin: a frozen dataclass with ``==``.
    compute
        returns what follows from a value, or raises a GeometryError.
    beside
        another slate that this one follows, or that follows this one: both then share a lock, for
        with one each a cell and a slider could wait for one another for ever.
    """

    def __init__(
        self,
        value: Value,
        compute: Callable[[Value], Result],
        beside: Slate[Any, Any] | None = None,
    ) -> None:
        self._lock = threading.RLock() if beside is None else beside._lock
        self._followers: dict[object, Callable[[Change], None]] = {}
        self._compute = compute
        self._first = value
        self._undo: list[tuple[Value, bool]] = []  # where a step leads; whether it was a load
        self._redo: list[tuple[Value, bool]] = []
        self._group: object = None
        self._value = value
        self._result = compute(value)

    # -- what there is ---------------------------------------------------------------------------

    @property
    def value(self) -> Value:
        """The present value."""
        return self._value

    @property
    def result(self) -> Result:
        """Everything that follows from the value."""
        return self._result

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
        """Replace entries of the value; return whether that could be.

        Parameters
        ----------
        source
            the control that asks: an error is shown beside it.
        group
            changes in a row with an equal group that is not None are one step of undo.
        changes
            entries of the value.
        """
        return self.attempt(source, lambda: _replaced(self.value, changes), group)

    def attempt(self, source: str, make: Callable[[], Value], group: object = None) -> bool:
        """Put the value that ``make`` returns in place, or keep the old one and say why."""
        return self._try(make, source, group, loaded=False)

    def load(self, value: Value, source: str) -> bool:
        """Put another value in place as one step of undo."""
        return self._try(lambda: value, source, None, loaded=True)

    def undo(self) -> None:
        """Take the last step back."""
        with self._lock:
            self._travel(self._undo, self._redo)

    def redo(self) -> None:
        """Take the last undone step again."""
        with self._lock:
            self._travel(self._redo, self._undo)

    def reset(self) -> None:
        """Return to the value of the beginning; undo leads back."""
        self.load(self._first, "reset")

    def seal(self) -> None:
        """End a group: the next change is a new step of undo."""
        with self._lock:
            self._group = None

    # -- inside ----------------------------------------------------------------------------------

    def _try(self, make: Callable[[], Value], source: str, group: object, *, loaded: bool) -> bool:
        with self._lock:
            try:
                change = self._put(make(), source, group, loaded)
            except GeometryError as error:
                change = Change(error=str(error), source=source)
            # Outside of the try: what a follower raises is no fault of the design.
            self._tell(change)
            return change.error is None

    def _put(self, value: Value, source: str, group: object, loaded: bool) -> Change:
        old = self.value
        if value == old:
            return Change(source=source)
        change = self._accept(value, source, loaded)
        if group is None or group != self._group:
            self._undo.append((old, loaded))
            del self._undo[:-MOST_STEPS]
        self._group = group
        self._redo.clear()
        return change

    def _travel(self, back: list[tuple[Value, bool]], forth: list[tuple[Value, bool]]) -> None:
        if back:
            old, (value, loaded) = self.value, back[-1]
            change = self._accept(value, "history", loaded)
            back.pop()
            forth.append((old, loaded))
            self._group = None
            self._tell(change)

    def _accept(self, value: Value, source: str, loaded: bool) -> Change:
        """Compute first: if that fails nothing has changed."""
        result = self._compute(value)
        self._value, self._result = value, result
        return Change(scene=True, mark=True, source=source, loaded=loaded)

    def _tell(self, change: Change) -> None:
        for key, callback in tuple(self._followers.items()):
            if key in self._followers:  # unless one told before it has ended it
                callback(change)


def _replaced(value: Any, changes: dict[str, Any]) -> Any:
    return replace(value, **changes)
