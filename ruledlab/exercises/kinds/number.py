"""Predict a number or an array; compute one in a few lines of Python."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...geometry.checks import Array, GeometryError
from ...geometry.field import named_number
from ..answers import is_open, read_numbers
from ..verdict import RIGHT, UNREAD, WRONG, Misconception, Verdict, recognised, unread
from .task import Task

__all__ = ["Code", "Number", "what_is_off"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Number(Task):
    """Predict a number or an array of numbers.

    Attributes
    ----------
    answer
        the number, or the array.
    label
        what stands before the field, such as "κ(0) =".
    unit
        what stands behind it.
    tolerance
        how far off an entry may be, as a fraction of the largest entry.
    modulo
        answers that differ by whole multiples of this are the same; 0 for none.
    slips
        wrong answers that have a name; they are given the answer as an array.
    because
        said when the answer is right.
    """

    kind: ClassVar[str] = "number"

    answer: Any
    label: str = ""
    unit: str = ""
    tolerance: float = 1e-3
    modulo: float = 0.0
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a text, a number, a list, an array or a dual number."""
        expected = np.asarray(self.answer, dtype=float)
        try:
            given = read_numbers(answer, expected.shape, self.unit)
        except GeometryError as error:
            return unread(error)
        if given.shape != expected.shape:
            return _wrong_shape(given.shape, expected.shape, answer)
        with np.errstate(over="ignore"):  # numbers may be as large as floats can be
            return self._judged(given, expected)

    def _judged(self, given: Array, expected: Array) -> Verdict:
        off = _differences(given, expected, self.modulo)
        allowed = self.tolerance * _size(expected)
        if np.all(np.abs(off) <= allowed):
            return Verdict(RIGHT, self.because)
        found = recognised(self.slips, given, expected)
        return found or Verdict(WRONG, what_is_off(expected + off, expected, allowed))

    def right_answer(self) -> str:
        """Return the answer as text."""
        return _written(np.asarray(self.answer, dtype=float))

    def wrong_answer(self) -> str:
        """Return the answer enlarged, as text."""
        expected = np.asarray(self.answer, dtype=float)
        return _written(1.3 * expected + 0.31 * _size(expected))


def _written(array: Array) -> str:
    if array.ndim:
        return "[" + ", ".join(_written(part) for part in array) + "]"
    return named_number(float(array))


def _size(expected: Array) -> float:
    return float(np.abs(expected).max(initial=0.0)) or 1.0


def _differences(given: Array, expected: Array, modulo: float) -> Array:
    off = given - expected
    return off - modulo * np.round(off / modulo) if modulo else off


def _wrong_shape(given: tuple[int, ...], expected: tuple[int, ...], answer: Any) -> Verdict:
    wanted, got = _shape_words(expected), _shape_words(given)
    example = "[1, 2, pi/3]" if expected else "2.5 or 3*pi/8"
    said = f"{wanted[:1].upper()}{wanted[1:]} is asked for, such as {example}; this is {got}."
    if given == expected[::-1]:
        said += " Exchange rows and columns."
    if isinstance(answer, str) and DECIMAL_COMMA.search(answer) and given != ():
        said += " If a comma is meant for a decimal point, write a point."
    return Verdict(UNREAD, said)


DECIMAL_COMMA = re.compile(r"[0-9],[0-9]")


def _shape_words(shape: tuple[int, ...]) -> str:
    if not shape:
        return "one number"
    if len(shape) == 1:
        return f"an array of {shape[0]} number" + ("" if shape[0] == 1 else "s")
    return "an array of " + " × ".join(map(str, shape)) + " numbers"


FACTORS = (
    (2.0, "2"),
    (3.0, "3"),
    (4.0, "4"),
    (6.0, "6"),
    (math.pi, "π"),
    (2 * math.pi, "2π"),
    (math.pi / 2, "π/2"),
    (180 / math.pi, "180/π"),
)
"""Factors that are easily forgotten or put in twice."""

ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")


def what_is_off(given: Array, expected: Array, allowed: float) -> str:
    """Say what is off in an array or a number that is not right, without telling the answer."""
    if expected.ndim == 0:
        return _off_number(float(given), float(expected), allowed)
    if np.all(np.abs(given + expected) <= allowed):
        return "All entries have the right size and the wrong sign."
    if np.all(np.abs(np.sort(given, None) - np.sort(expected, None)) <= allowed):
        return "These are the right numbers in another order."
    wrong = np.argwhere(np.abs(given - expected) > allowed)
    first = tuple(wrong[0])
    said = _off_number(float(given[first]), float(expected[first]), allowed)
    some = f"{len(wrong)} of {expected.size} entries {'is' if len(wrong) == 1 else 'are'} off."
    return f"{some} The {_place(first)}: {said}"


def _place(index: tuple[int, ...]) -> str:
    """Say which entry this is."""
    if len(index) == 1:
        return f"{ORDINALS[index[0]] if index[0] < len(ORDINALS) else f'{index[0] + 1}th'} entry"
    return "entry in row " + ", column ".join(str(i + 1) for i in index)


def _off_number(given: float, expected: float, allowed: float) -> str:
    if abs(given + expected) <= allowed and expected != 0.0:
        return "The size is right, the sign is not."
    if abs(given - expected) <= _near(expected, allowed):
        return "Close, but not close enough: give more digits, or look for a small slip."
    if expected == 0.0:
        return "Too large in size."
    if given == 0.0:
        return "Too small in size: it is not zero."
    return _factor(given, expected, allowed / abs(expected)) or _rough(given, expected)


def _near(expected: float, allowed: float) -> float:
    """Return how near is close: some times what is allowed, but nothing that is plainly off."""
    return min(30 * allowed, max(3 * allowed, 0.05 * abs(expected)))


def _rough(given: float, expected: float) -> str:
    sign = " The sign is off too." if (given < 0) != (expected < 0) else ""
    larger, smaller = max(abs(given), abs(expected)), min(abs(given), abs(expected))
    direction = "large" if abs(given) > abs(expected) else "small"
    size = "more" if larger > 2 * smaller else "less"
    return f"Too {direction} in size, by {size} than a factor of 2.{sign}"


def _factor(given: float, expected: float, slack: float) -> str:
    """Name the factor that comes nearest, if one does."""
    ratio = abs(given / expected)
    off, factor, name = min(
        (abs(max(ratio, 1 / ratio) / factor - 1), factor, name) for factor, name in FACTORS
    )
    if off > slack:
        return ""
    direction = "large" if ratio > 1 else "small"
    sign = ", and the sign is off" if (given < 0) != (expected < 0) else ""
    degrees = ": are these degrees?" if factor > 50 and ratio > 1 else "."
    return f"Too {direction} by a factor of {name}{sign}{degrees}"


# -- Python to write -------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, kw_only=True)
class Code(Number):
    """Write a few lines of Python; the value is handed to ``check("06.1", value)``.

    Attributes
    ----------
    starter
        the lines to begin from.
    test
        judges the value, where it is no number; None compares it with ``answer``.
    model
        with ``test``: a value that is right.
    """

    kind: ClassVar[str] = "code"

    starter: str = ""
    answer: Any = 0.0
    test: Callable[[Any], Verdict] | None = None
    model: Any = None

    def judge(self, answer: Any) -> Verdict:
        """Judge the value that the lines gave."""
        if is_open(answer):
            return Verdict(UNREAD, "Nothing is assigned yet: replace the dots by your lines.")
        return super().judge(answer) if self.test is None else self.test(answer)

    def right_answer(self) -> Any:
        """Return a value that is right."""
        return super().right_answer() if self.test is None else self.model
