"""Sketch the expected curve over t."""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...geometry.checks import Array
from ..answers import is_open
from ..shape import Trait, compare, drawn
from ..verdict import RIGHT, UNREAD, WRONG, Verdict
from .task import Task

__all__ = ["Sketch", "traits_html"]

HIGHEST = 1e9
"""Heights beyond this are no part of a drawing."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sketch(Task):
    """Sketch the expected curve over t, then see the true one over it.

    Attributes
    ----------
    curve
        given places t, the true heights; NaN where undefined.
    span
        the ends of the t-axis.
    heights
        the ends of the height axis.
    quantity
        the name of an invariant, for its colour; or empty.
    label
        what stands at the height axis.
    """

    kind: ClassVar[str] = "sketch"
    KNOTS: ClassVar[int] = 65

    curve: Callable[[Array], Array]
    heights: tuple[float, float]
    span: tuple[float, float] = (0.0, 1.0)
    quantity: str = ""
    label: str = "y"
    because: str = ""

    @property
    def t(self) -> Array:
        """The places at which a sketch has heights."""
        return np.linspace(*self.span, self.KNOTS)

    def judge(self, answer: Any) -> Verdict:
        """Judge a list of heights at `t`, None or NaN where nothing is drawn."""
        try:
            sketch = np.array([] if is_open(answer) else answer, dtype=float)
        except Exception:  # whatever an object of the student's own does
            return Verdict(UNREAD, "A sketch is a list of heights over t; draw one.")
        with np.errstate(invalid="ignore"):
            sketch = np.where(np.abs(sketch) < HIGHEST, sketch, np.nan)
        if sketch.shape != (self.KNOTS,):
            return Verdict(UNREAD, f"Draw a curve, or give its heights at {self.KNOTS} places t.")
        if (part := drawn(sketch)) < 0.85:
            share = round(100 * part)
            return Verdict(UNREAD, f"Draw over the whole of t: {share} % of it has a curve.")
        traits = self.traits(sketch)
        state = RIGHT if all(trait.agrees for trait in traits) else WRONG
        return Verdict(state, traits_html(traits) + (self.because if state == RIGHT else ""))

    def traits(self, sketch: Array) -> tuple[Trait, ...]:
        """Compare a sketch with the true curve."""
        height = self.heights[1] - self.heights[0]
        return compare(self.t, sketch, np.asarray(self.curve(self.t), dtype=float), height)

    def right_answer(self) -> list[float]:
        """Return the true heights."""
        values = np.asarray(self.curve(self.t), dtype=float)
        return [float(y) for y in np.nan_to_num(values)]

    def wrong_answer(self) -> list[float]:
        """Return a zigzag that no exercise asks for."""
        low, high = self.heights
        wave = np.sin(11 * np.pi * np.linspace(0, 1, self.KNOTS))
        return [float(y) for y in (low + high) / 2 + (high - low) / 2 * wave]


def traits_html(traits: Sequence[Trait]) -> str:
    """Return the comparison of a sketch as a list."""
    rows = "".join(
        f'<li class="{"is-met" if trait.agrees else "is-open"}"><b>{trait.name.capitalize()}</b> '
        f"{html.escape(trait.word)}</li>"
        for trait in traits
    )
    score = sum(trait.agrees for trait in traits)
    return f'Shape: {score} of {len(traits)} agree.<ul class="ruledlab-marks">{rows}</ul>'
