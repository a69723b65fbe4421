"""Drag a design until conditions hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

from ...design import Design
from ...geometry.checks import GeometryError
from ...geometry.closed import Closure
from ...geometry.dual import Dual
from ...geometry.surface import RuledSurface
from ..answers import is_open
from .goal import Goal

__all__ = ["Drag", "Made", "made"]


class Made(Protocol):
    """A design and what follows from it; a `Lab`'s result is one."""

    @property
    def design(self) -> Design:
        """The design."""

    @property
    def surface(self) -> RuledSurface:
        """Its surface."""

    @property
    def closure(self) -> Closure:
        """Whether and how it closes."""

    @property
    def pitch(self) -> Dual | None:
        """Λ = λ + ε l, or None where the surface does not close as an oriented motion."""


@dataclass(frozen=True, slots=True, eq=False)
class _Made:
    design: Design
    surface: RuledSurface
    closure: Closure
    pitch: Dual | None


def made(design: Design) -> Made:
    """Return what follows from a design, without anything to draw."""
    surface = design.surface()
    closure = surface.closure()
    try:
        pitch = surface.dual_angle_of_pitch() if closure.oriented else None
    except GeometryError:
        pitch = None
    return _Made(design, surface, closure, pitch)


@dataclass(frozen=True, eq=False, kw_only=True)
class Drag(Goal[Design, Made]):
    """Drag a design until conditions hold.

    Attributes
    ----------
    fields
        whether ū and v̄ may be changed too.
    plots
        invariants that are plotted beside the chart, by their names.
    """

    kind: ClassVar[str] = "drag"

    fields: bool = False
    plots: tuple[str, ...] = ()

    def value_of(self, answer: Any) -> Design:
        """Return the design in an answer: a `Design`, its JSON or short text, or what has one.

        Raises
        ------
        GeometryError
            if there is none.
        """
        if is_open(answer):
            raise GeometryError("nothing is answered yet; give a design, such as lab.design")
        if isinstance(answer, str):
            as_json = answer.lstrip().startswith("{")
            return Design.from_json(answer) if as_json else Design.from_text(answer)
        design = getattr(answer, "design", answer)
        if isinstance(design, Design):
            return design
        kind = type(answer).__name__
        raise GeometryError(
            f"this is an object of the type {kind}; give a design, such as lab.design"
        )

    def read(self, answer: Any) -> Made:
        """Return what follows from the design in an answer, which may be a `Made` itself."""
        if all(hasattr(answer, name) for name in ("design", "surface", "closure", "pitch")):
            result: Made = answer
            return result
        return made(self.value_of(answer))
