"""Write a formula."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...geometry.checks import Array, GeometryError
from ..answers import read_formula
from ..draw import Draw
from ..verdict import RIGHT, WRONG, Misconception, Verdict, recognised, unread
from .task import Task

__all__ = ["Formula"]

EXACT = 1e-8
"""How far off values may be, as a fraction of the largest."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Formula(Task):
    """A formula in one or two variables; judged by its values, so every equivalent one passes.

    Attributes
    ----------
    answer
        the formula as text.
    variables
        one or two letters.
    box
        for each variable, from where to where values are compared.
    slips
        wrong formulas that have a name; see `misconceptions.formula`.
    """

    kind: ClassVar[str] = "formula"

    answer: str
    variables: tuple[str, ...] = ("u", "v")
    box: tuple[tuple[float, float], ...] = ((0.2, 2.9), (0.3, 2.8))
    label: str = ""
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a text, a number or a Python function."""
        places, right = self.places(), read_formula(self.answer, self.variables)
        try:
            function = read_formula(answer, self.variables)
            given = np.array(function(*places))
        except GeometryError as error:
            return unread(error)
        with np.errstate(all="ignore"):  # values may be as large as floats can be
            expected = np.array(right(*places))
            if _largest(given - expected) <= EXACT * _largest(expected):
                return Verdict(RIGHT, self.because)
            found = recognised(self.slips, function, right)
            return found or Verdict(WRONG, self._what_is_off(places, given, expected))

    def places(self) -> tuple[Array, ...]:
        """Return the places at which values are compared."""
        draw = Draw("places", "".join(self.variables))
        return tuple(
            np.array([draw.between(low, high) for _ in range(12)])
            for low, high in self.box[: len(self.variables)]
        )

    def _what_is_off(self, places: tuple[Array, ...], given: Array, expected: Array) -> str:
        bad = ~np.isfinite(given)
        if bad.any():
            return f"It has no value at {self._place(places, int(np.argmax(bad)))}."
        scale = _largest(expected)
        if _largest(given - expected) <= 1e-3 * scale:
            return "Nearly: write exact numbers, such as pi/3 or sqrt(2), not rounded ones."
        if _largest(given + expected) <= EXACT * scale:
            return "The sign is off everywhere."
        ratio, difference = given / expected, given - expected
        if np.isfinite(ratio).all() and np.ptp(ratio) <= EXACT * abs(ratio[0]) and ratio[0] != 0:
            return f"Off by the constant factor {ratio[0]:.6g}.".replace("-", "−")
        if np.ptp(difference) <= EXACT * scale:
            return f"Off by the constant {difference[0]:+.6g}.".replace("-", "−")
        at = int(np.argmax(np.abs(given - expected)))
        return (
            f"At {self._place(places, at)} yours is {given[at]:.4g}, the right one "
            f"{expected[at]:.4g}."
        ).replace("-", "−")

    def _place(self, places: tuple[Array, ...], at: int) -> str:
        pairs = zip(self.variables, places, strict=True)
        return ", ".join(f"{name} = {values[at]:.3g}" for name, values in pairs)

    def right_answer(self) -> str:
        """Return the formula."""
        return self.answer

    def wrong_answer(self) -> str:
        """Return another formula."""
        return f"({self.answer})*1.5 + 0.37*{self.variables[0]} + 0.1"


def _largest(values: Array) -> float:
    """Return the largest size; NaN, which is not below anything, where a value is missing."""
    return max(float(np.abs(values).max()), 1e-6 * EXACT)
