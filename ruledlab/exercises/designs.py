"""What exercises ask of a design that is dragged: its pitch, a least size, its invariants."""

from __future__ import annotations

import math

import numpy as np

from ..design import Design
from ..geometry.checks import Array
from ..geometry.gallery import LOOP
from .core import Condition, Made

__all__ = ["EXAMPLE_2", "at_least", "enlarged", "has_pitch", "values"]

EXAMPLE_2 = Design(LOOP, "u - v", "u + v", closing="C1", name="Example 2")
"""The paper's Example 2, as a design that can be dragged."""


def has_pitch(made: Made, target: float = 0.0, within: float = 0.02) -> Condition:
    """Return the condition that the pitch is l = target; it needs a closed surface."""
    text = f"pitch $l={target:g}$"
    if made.pitch is None:
        return Condition(text, math.nan, within, "length", "the surface does not close")
    now = float(made.pitch.dual)
    said = f"now $l={round(now, 3) + 0.0:.3f}$"  # never −0.000
    return Condition(text, abs(now - target), within, "length", said)


def at_least(text: str, now: float, least: float, unit: str = "", said: str = "") -> Condition:
    """Return the condition that a quantity is so large; NaN cannot be measured."""
    off = math.nan if math.isnan(now) else max(0.0, least - now)
    return Condition(text, off, 0.0, unit, said or f"now {now:.2f}")


def values(made: Made, name: str, count: int = 201) -> Array:
    """Return an invariant at places all over the design, where it is defined.

    Parameters
    ----------
    made
        a design and what follows from it.
    name
        the invariant's name in words, such as "delta" or "tau_bar".
    count
        how many places.
    """
    t = np.linspace(*made.surface.domain, count)
    found: Array = np.asarray(getattr(made.surface.invariants(t), name), dtype=float)
    defined: Array = found[np.isfinite(found)]
    return defined


def enlarged(
    design: Design, factor: float, middle: tuple[float, float] = (math.pi / 4, math.pi / 4)
) -> Design:
    """Return a design with its control points moved away from a middle, in the chart."""
    points = np.array(middle) + factor * (np.array(design.points) - middle)
    return design.with_(points=tuple((float(u), float(v)) for u, v in points))
