"""`Lab`: the `Slate` of a design, with a cursor t, a chosen control point and a colouring."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace

from ..design import Design
from ..geometry.checks import GeometryError
from ..geometry.closed import Closure
from ..geometry.dual import Dual
from ..geometry.surface import RuledSurface
from .scene import COLOURINGS, Mark, Scene, build_mark, build_scene
from .slate import Change, Slate

__all__ = ["Change", "Lab", "Result"]


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


class Lab(Slate[Design, Result]):
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
        self._colouring = "plain"
        self._chosen = 0
        super().__init__(design, lambda design: compute(design, self._colouring))
        self._cursor = self._inside(cursor)
        self._mark = build_mark(design, self._result.surface, self._cursor)

    # -- what there is ---------------------------------------------------------------------------

    @property
    def design(self) -> Design:
        """The present design."""
        return self.value

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

    # -- changes ---------------------------------------------------------------------------------

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

    # -- inside ----------------------------------------------------------------------------------

    def _inside(self, t: float) -> float:
        if math.isnan(t):
            raise GeometryError("`t` must be a number; got NaN; give a place along the curve")
        start, end = self._result.surface.domain
        return min(max(float(t), start), end)

    def _accept(self, design: Design, source: str, loaded: bool) -> Change:
        """Compute first: if that fails nothing has changed."""
        result = self._compute(design)
        mark = build_mark(design, result.surface, self._cursor)
        chosen = min(self._chosen, len(design.points) - 1)
        changed = chosen != self._chosen
        self._value, self._result, self._mark, self._chosen = design, result, mark, chosen
        return Change(scene=True, mark=True, chosen=changed, source=source, loaded=loaded)
