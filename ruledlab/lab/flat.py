"""A drawing with two axes, as a place for handles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..geometry.checks import Array
from .axes import Limits

__all__ = ["Flat", "by_hand"]

EDGE: Final = 1e-6
"""What lies beside the plot by no more than this part of its size is still on its edge."""


@dataclass(frozen=True, slots=True)
class Flat:
    """A drawing with axes; its points are (x, y, 0).

    Attributes
    ----------
    size
        width and height of the drawing, in its own units.
    corner, area
        upper left corner of the plot within it, and the plot's width and height.
    x, y
        the limits of the axes.
    """

    size: tuple[float, float]
    corner: tuple[float, float]
    area: tuple[float, float]
    x: Limits
    y: Limits

    def seen(self, point: Array) -> tuple[float, float, float]:
        """Return where a point is in the drawing, and 1 in sight, 0 outside of the plot."""
        across = (float(point[0]) - self.x.low) / self.x.span
        down = (self.y.high - float(point[1])) / self.y.span
        inside = all(abs(part - 0.5) <= 0.5 + EDGE for part in (across, down))
        (left, top), (width, height) = self.corner, self.area
        return left + across * width, top + down * height, float(inside)

    def at(self, x: float, y: float, depth: float) -> Array:
        """Return the point at a place of the drawing."""
        (left, top), (width, height) = self.corner, self.area
        across, down = (x - left) / width, (y - top) / height
        return np.array([self.x.low + across * self.x.span, self.y.high - down * self.y.span, 0.0])


def by_hand(value: float, span: float) -> float:
    """Return a number of an axis as exact as a hand is: short to read, and within a pixel."""
    return round(value, max(0, 4 - math.floor(math.log10(span))))
