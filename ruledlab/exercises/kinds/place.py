"""Bring two lines into a position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ...geometry.checks import GeometryError
from ...pair import Pair, TwoLines, between
from ..answers import is_open
from .goal import Goal

__all__ = ["Place"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Place(Goal[TwoLines, Pair]):
    """Bring two lines into a position; every pair of lines that fulfils the conditions counts."""

    kind: ClassVar[str] = "place"

    def value_of(self, answer: Any) -> TwoLines:
        """Return the two lines in an answer: `TwoLines`, or [[u, v, x, y, z], [u, v, x, y, z]].

        Raises
        ------
        GeometryError
            if there are none, or a number is beyond the reach of the sliders.
        """
        if is_open(answer):
            raise GeometryError("nothing is answered yet; give two lines, such as app.slate.value")
        return TwoLines.from_numbers(answer.numbers if isinstance(answer, TwoLines) else answer)

    def read(self, answer: Any) -> Pair:
        """Return what follows from the two lines in an answer."""
        return between(self.value_of(answer))
