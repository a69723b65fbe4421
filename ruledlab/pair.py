"""`TwoLines`: the frozen description of two oriented lines as they are moved, and what follows."""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass, replace
from typing import Any, Final

import numpy as np

from .geometry.checks import Array, GeometryError
from .geometry.dual import Dual, inner
from .geometry.line import CommonPerpendicular, Line, common_perpendicular, on_sphere

__all__ = ["SPANS", "OneLine", "Pair", "TwoLines", "between"]

AHEAD: Final = 1.4  # from the given point to the handle of the direction
PLACES: Final = (-4.0, 4.0)  # where x, y and z of a given point may be
MOST_U: Final = 6.3
SPANS: Final = {
    "u": (-MOST_U, MOST_U),
    "v": (0.0, math.pi),
    "x": PLACES,
    "y": PLACES,
    "z": PLACES,
}
"""The five numbers of a line, in their order, and how far they reach."""

SHORTEST: Final = 1e-6


@dataclass(frozen=True, slots=True)
class OneLine:
    """A line by longitude ``u`` and colatitude ``v`` of its direction and a point of it."""

    u: float
    v: float
    x: float
    y: float
    z: float

    @property
    def line(self) -> Line:
        """The oriented line."""
        direction = on_sphere(np.array([self.u, self.v]))
        return Line.from_point_direction([self.x, self.y, self.z], direction)

    @property
    def point(self) -> Array:
        """The given point."""
        return np.array([self.x, self.y, self.z])

    @property
    def ahead(self) -> Array:
        """The point `AHEAD` of the given one along the line: where its direction is taken."""
        there: Array = self.point + AHEAD * on_sphere(np.array([self.u, self.v]))
        return there

    def moved(self, to: Array) -> OneLine:
        """Return the parallel line through a point, as near to it as the sliders reach."""
        x, y, z = (round(float(entry), 2) for entry in np.clip(to, *PLACES))
        return replace(self, x=x, y=y, z=z)

    def aimed(self, at: Array) -> OneLine:
        """Return the line through the given point that is directed to another."""
        way = at - self.point
        size = float(np.linalg.norm(way))
        if size < SHORTEST:
            return self
        v = math.acos(max(-1.0, min(1.0, float(way[2]) / size)))
        level = math.hypot(way[0], way[1]) / size
        u = self.u if level < SHORTEST else _beside(math.atan2(way[1], way[0]), self.u)
        return replace(self, u=round(u, 2), v=min(round(v, 2), math.pi))

    def reversed(self) -> OneLine:
        """Return the line through the same point, run through the other way."""
        turned = self.u + math.pi if self.u <= 0 else self.u - math.pi
        return replace(self, u=turned, v=math.pi - self.v)


def _beside(u: float, old: float) -> float:
    """Return the longitude that is nearest to the old one, within the reach of the slider."""
    u += 2 * math.pi * round((old - u) / (2 * math.pi))
    return u - math.copysign(2 * math.pi, u) if abs(u) > MOST_U else u


@dataclass(frozen=True, slots=True)
class TwoLines:
    """A position of line A and line B."""

    a: OneLine
    b: OneLine

    @property
    def numbers(self) -> list[list[float]]:
        """Both lines as a file can keep them: [[u, v, x, y, z], [u, v, x, y, z]]."""
        return [[float(entry) for entry in astuple(line)] for line in (self.a, self.b)]

    @classmethod
    def from_numbers(cls, numbers: Any) -> TwoLines:
        """Return the position that `numbers` describes.

        Raises
        ------
        GeometryError
            if it is none: not two lists of five numbers, or one of these out of its span.
        """
        match numbers:
            case [[_, _, _, _, _], [_, _, _, _, _]]:
                return cls(*(_one_line(five) for five in numbers))
        raise GeometryError(
            "`numbers` must be two lists [u, v, x, y, z], one for each line; "
            f"got an object of the type {type(numbers).__name__}"
        )


def _one_line(five: Any) -> OneLine:
    for (name, (low, high)), entry in zip(SPANS.items(), five, strict=True):
        if isinstance(entry, bool) or not isinstance(entry, (int, float)):
            kind = type(entry).__name__
            raise GeometryError(f"`{name}` of a line must be a number; got one of the type {kind}")
        if not low <= entry <= high:
            raise GeometryError(
                f"`{name}` of a line must lie between {low:.4g} and {high:.4g}; give one in there"
            )
    return OneLine(*map(float, five))


@dataclass(frozen=True, eq=False, slots=True)
class Pair:
    """What follows from two lines: both, ⟨X, Y⟩, and the common perpendicular."""

    a: Line
    b: Line
    product: Dual
    across: CommonPerpendicular


def between(lines: TwoLines) -> Pair:
    """Return what follows from the state."""
    a, b = lines.a.line, lines.b.line
    return Pair(a, b, inner(a.dual, b.dual), common_perpendicular(a, b))
