"""Move something until conditions hold: what dragging a design and placing two lines share."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ...geometry.checks import GeometryError
from ..verdict import RIGHT, WRONG, Misconception, Verdict, recognised, unread
from .task import Task

__all__ = ["Condition", "Goal", "off_words"]

Value = TypeVar("Value")
Result = TypeVar("Result")


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
class Goal(Task, Generic[Value, Result]):
    """Move a value until conditions hold; judged by what follows from it, so every way counts.

    Attributes
    ----------
    start
        where it begins. It does not fulfil the conditions.
    model
        a value that does; shown as the solution.
    conditions
        given what follows from a value, the conditions with how far off each is.
    slips
        wrong values that have a name; they are given what follows from a value.
    because
        said when the conditions hold.
    """

    start: Value
    model: Value
    conditions: Callable[[Result], tuple[Condition, ...]]
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def value_of(self, answer: Any) -> Value:
        """Return the value in an answer.

        Raises
        ------
        GeometryError
            if there is none.
        """
        raise NotImplementedError

    def read(self, answer: Any) -> Result:
        """Return what follows from the value in an answer; a GeometryError if there is none."""
        raise NotImplementedError

    def judge(self, answer: Any) -> Verdict:
        """Judge a value, in whatever form it is given."""
        try:
            result = self.read(answer)
        except GeometryError as error:
            return unread(error)
        conditions = self.conditions(result)
        if all(condition.met for condition in conditions):
            return Verdict(RIGHT, self.because)
        found = recognised(self.slips, result)
        return found or Verdict(WRONG, " ".join(map(off_words, conditions)).strip())

    def right_answer(self) -> Value:
        """Return a value that fulfils the conditions."""
        return self.model

    def wrong_answer(self) -> Value:
        """Return the value one begins with."""
        return self.start


def off_words(condition: Condition) -> str:
    """Say how far off a condition is; nothing where it holds."""
    if condition.met:
        return ""
    if math.isnan(condition.off):
        return f"{condition.text}: {condition.now or 'cannot be measured now'}."
    unit = f" {condition.unit}" if condition.unit else ""
    return f"{condition.text}: still off by {condition.off:.3g}{unit}."
