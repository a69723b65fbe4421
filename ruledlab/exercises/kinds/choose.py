"""Choose one of several answers."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..verdict import RIGHT, UNREAD, WRONG, Verdict
from .task import Task

__all__ = ["Choose", "Option", "whole"]


def whole(answer: Any) -> int | None:
    """Return a whole number of any library as Python's; None for anything else."""
    if isinstance(answer, (bool, np.bool_)):
        return None
    try:
        return operator.index(answer)
    except TypeError:
        return None


@dataclass(frozen=True, slots=True)
class Option:
    """One of several answers to choose from.

    Attributes
    ----------
    text
        the answer: HTML with TeX.
    word
        what is said to who chooses it.
    right
        whether it is the right one; exactly one is.
    slip
        the name of the misconception that it shows.
    """

    text: str
    word: str
    right: bool = False
    slip: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Choose(Task):
    """Choose one of several. An answer is the option's index in the data, however it is shown.

    Attributes
    ----------
    options
        the answers.
    order
        the order in which they are shown; empty for that of the data.
    """

    kind: ClassVar[str] = "choose"

    options: tuple[Option, ...]
    order: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if sum(option.right for option in self.options) != 1:
            raise ValueError("exactly one option must be right")

    @property
    def shown(self) -> tuple[int, ...]:
        """The indices of the options in the order in which they are shown."""
        return self.order or tuple(range(len(self.options)))

    def judge(self, answer: Any) -> Verdict:
        """Judge the index of an option."""
        index = whole(answer)
        if index is None:
            return Verdict(UNREAD, "Choose one of the answers first.")
        if not 0 <= index < len(self.options):
            return Verdict(UNREAD, f"There are {len(self.options)} answers, counted from 0.")
        option = self.options[index]
        return Verdict(RIGHT if option.right else WRONG, option.word, option.slip)

    def right_answer(self) -> int:
        """Return the index of the right option."""
        return next(i for i, option in enumerate(self.options) if option.right)

    def wrong_answer(self) -> int:
        """Return the index of a wrong option."""
        return next(i for i, option in enumerate(self.options) if not option.right)
