"""What is said to an answer, and wrong answers that have a name."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..geometry.checks import GeometryError
from ..geometry.formula import FormulaError

__all__ = ["RIGHT", "UNREAD", "WRONG", "Misconception", "Verdict", "recognised", "unread"]

RIGHT, WRONG, UNREAD = "right", "wrong", "unread"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is said to an answer.

    Attributes
    ----------
    state
        ``"right"``, ``"wrong"``, or ``"unread"``: it could not be read and does not count.
    word
        what is off, or why it is right: HTML with TeX between dollar signs.
    slip
        the name of the misconception that was recognised, else empty.
    pointer
        lines for a monospace display that point to the place of the trouble.
    """

    state: str
    word: str = ""
    slip: str = ""
    pointer: str = ""

    @property
    def right(self) -> bool:
        """Whether the answer was right."""
        return self.state == RIGHT


def unread(error: GeometryError) -> Verdict:
    """Return what is said to an answer that cannot be read: what to write instead."""
    if not isinstance(error, FormulaError):
        return Verdict(UNREAD, html.escape(_sentence(str(error).replace("`", ""))))
    text = f"this cannot be read: {error.message}"
    return Verdict(UNREAD, html.escape(_sentence(text)), pointer=error.pointer(48))


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "?", "!")) else ".")


@dataclass(frozen=True, slots=True)
class Misconception:
    """A wrong answer that has a name.

    Attributes
    ----------
    name
        a few words: "λ modulo 2π".
    test
        whether an answer, already read, shows it. What it is given depends on the kind: an array
        for numbers and code, a function of the variables for formulas, a `Made` for designs, a
        `Pair` for two lines.
    word
        what to say to it.
    example
        an answer that shows it, for the tests.
    """

    name: str
    test: Callable[[Any], bool]
    word: str
    example: Any


def recognised(slips: Sequence[Misconception], answer: Any, right: Any = None) -> Verdict | None:
    """Return what is said to a misconception, or None where the answer shows none.

    One that the right answer would show too, as the opposite sign of zero, says nothing.
    """
    for slip in slips:
        if slip.test(answer) and (right is None or not slip.test(right)):
            return Verdict(WRONG, slip.word, slip.name)
    return None
