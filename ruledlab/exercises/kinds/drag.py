"""Drag a design until conditions hold."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

from ...design import Design
from ...geometry.checks import GeometryError
from ...geometry.closed import Closure
from ...geometry.dual import Dual
from ...geometry.surface import RuledSurface
from ..answers import is_open
from ..verdict import RIGHT, WRONG, Misconception, Verdict, recognised, unread
from .task import Task

__all__ = ["Condition", "Drag", "Made", "design_of", "made", "off_words"]


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


@dataclass(frozen=True, slots=True)
class Condition:
    """One thing a design has to fulfil, and how far off it is.

    Attributes
    ----------
    text
        the condition: HTML with TeX.
    off
        how far off, ≥ 0; NaN where it cannot be measured.
    within
        how far off it may be.
    unit
        the unit of ``off``.
    now
        the present value, in words, or why there is none.
    """

    text: str
    off: float
    within: float
    unit: str = ""
    now: str = ""

    @property
    def met(self) -> bool:
        """Whether the condition holds."""
        return self.off <= self.within


@dataclass(frozen=True, eq=False, kw_only=True)
class Drag(Task):
    """Drag a design until conditions hold; judged by what follows from it, so every way counts.

    Attributes
    ----------
    start
        where it begins. It does not fulfil the conditions.
    model
        a design that does; shown as the solution.
    conditions
        given a `Made`, the conditions with how far off each is.
    fields
        whether ū and v̄ may be changed too.
    plots
        invariants that are plotted beside the chart, by their names.
    slips
        wrong designs that have a name; they are given a `Made`.
    """

    kind: ClassVar[str] = "drag"

    start: Design
    model: Design
    conditions: Callable[[Made], tuple[Condition, ...]]
    fields: bool = False
    plots: tuple[str, ...] = ()
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a `Design`, its JSON or short text, or what follows from one."""
        try:
            result = _read_design(answer)
        except GeometryError as error:
            return unread(error)
        conditions = self.conditions(result)
        if all(condition.met for condition in conditions):
            return Verdict(RIGHT, self.because)
        found = recognised(self.slips, result)
        return found or Verdict(WRONG, " ".join(map(off_words, conditions)).strip())

    def right_answer(self) -> Design:
        """Return a design that fulfils the conditions."""
        return self.model

    def wrong_answer(self) -> Design:
        """Return the design one begins with."""
        return self.start


def off_words(condition: Condition) -> str:
    """Say how far off a condition is; nothing where it holds."""
    if condition.met:
        return ""
    if math.isnan(condition.off):
        return f"{condition.text}: {condition.now or 'cannot be measured now'}."
    unit = f" {condition.unit}" if condition.unit else ""
    return f"{condition.text}: still off by {condition.off:.3g}{unit}."


def _read_design(answer: Any) -> Made:
    if all(hasattr(answer, name) for name in ("design", "surface", "closure", "pitch")):
        result: Made = answer
        return result
    return made(design_of(answer))


def design_of(answer: Any) -> Design:
    """Return the design in an answer: a `Design`, its JSON or short text, or what has a design.

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
    raise GeometryError(f"this is an object of the type {kind}; give a design, such as lab.design")
