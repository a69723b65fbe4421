"""What a finding is: a formula of the paper as printed, and as it follows from the definitions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy.typing as npt

from ..geometry import RuledSurface
from ..geometry.checks import Array

__all__ = ["Evaluation", "Finding", "Note", "Over"]

Evaluation = Callable[..., Array]
"""(surface, t), (surface, t, w) or (surface): see `Finding.over`."""

Over = Literal["t", "t, w", "surface"]


@dataclass(frozen=True, slots=True)
class Finding:
    """A printed formula and the one that the definitions give.

    Attributes
    ----------
    key
        short name.
    place
        where it stands in the paper.
    quantity
        what it is a formula for, in words and symbols.
    printed_latex, corrected_latex
        both formulas, without dollar signs. What is printed is written as it stands there; only
        in §4.2 the differences of control points are abbreviated, as the formula itself says.
    printed, corrected
        both as functions. What they take is told by ``over``; the shapes are (*t.shape) or
        (*t.shape, *w.shape), with a last axis where the quantity is a vector or a pair.
    how_to_see
        how a reader can notice it, and check it.
    agreement
        when the printed formula nevertheless gives the right value.
    over
        ``"t"``: functions of (surface, t). ``"t, w"``: of (surface, t, w). ``"surface"``: of the
        surface alone.
    design
        the gallery's key of a design that shows it well.
    only
        True where the statement is about ``design`` alone: both functions then look at that
        design, whatever surface they are given.
    """

    key: str
    place: str
    quantity: str
    printed_latex: str
    corrected_latex: str
    printed: Evaluation
    corrected: Evaluation
    how_to_see: str
    agreement: str
    over: Over = "t"
    design: str = "example_2"
    only: bool = False

    def difference(self, surface: RuledSurface, *places: npt.ArrayLike) -> Array:
        """Return printed − corrected; the arguments are those of the two functions."""
        result: Array = self.printed(surface, *places) - self.corrected(surface, *places)
        return result


@dataclass(frozen=True, slots=True)
class Note:
    """A place in the paper, or what was varied in `TRIED`, and a sentence about it."""

    place: str
    text: str

    def __str__(self) -> str:
        """Return place and text as one line."""
        return f"{self.place}: {self.text}"
