"""Two oriented lines: their position as a value, what follows from it, the picture and the words.

No widgets: the app of lesson 02 shows what is made here.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from ..geometry import CommonPerpendicular, Dual, Line, common_perpendicular, inner
from ..geometry.checks import Array
from .overlay import Dot, Label, Overlay, Sheet, Stroke
from .palette import LIGHT
from .scene import on_sphere

__all__ = [
    "PRESETS",
    "OneLine",
    "Pair",
    "TwoLines",
    "between",
    "lines_html",
    "pair_html",
    "picture",
    "relation_words",
    "words",
]

REACH: Final = 2.2  # half of the length of a line that is drawn, beyond what lies on it
FAR: Final = 12.0  # from the origin, where feet of nearly parallel lines are no longer drawn
ORIGIN: Final = np.zeros(3)
COLOURS: Final = {"a": "kappa", "b": "tau"}


# -- the state and what follows from it ------------------------------------------------------------


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

    def reversed(self) -> OneLine:
        """Return the line through the same point, run through the other way."""
        turned = self.u + math.pi if self.u <= 0 else self.u - math.pi
        return replace(self, u=turned, v=math.pi - self.v)


@dataclass(frozen=True, slots=True)
class TwoLines:
    """The state of the app: line A and line B."""

    a: OneLine
    b: OneLine


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


_A = OneLine(math.pi / 2, math.pi / 4, 1.5, 0.0, 0.0)
_LEVEL = OneLine(0.0, math.pi / 2, 0.0, 0.0, 1.0)
PRESETS: Final = {
    "skew": TwoLines(_A, OneLine(math.pi / 6, 2 * math.pi / 3, 0.0, 1.5, 1.0)),
    "meeting": TwoLines(_LEVEL, OneLine(math.pi / 3, math.pi / 4, 0.5, 0.0, 1.0)),
    "perpendicular and meeting": TwoLines(_LEVEL, OneLine(math.pi / 2, math.pi / 3, 0.5, 0.0, 1.0)),
    "parallel": TwoLines(_A, replace(_A, x=-0.5, y=1.0)),
    "antiparallel": TwoLines(_A, replace(_A.reversed(), x=-0.5, y=1.0)),
    "equal": TwoLines(_A, _A),
}
"""Positions of two lines by name."""


# -- the picture -----------------------------------------------------------------------------------


def picture(pair: Pair, *, moments: bool = True, sphere: bool = True) -> Overlay:
    """Return what is drawn: lines, feet, common perpendicular, and if wanted moments and sphere."""
    near = all(np.linalg.norm(foot) < FAR for foot in (pair.across.foot_a, pair.across.foot_b))
    parts = [_line(pair.a, "a", pair.across.foot_a if near else pair.a.foot)]
    parts += [_line(pair.b, "b", pair.across.foot_b if near else pair.b.foot)]
    parts += [_perpendicular(pair.across)] * near
    if moments:
        parts += [_moment(pair.a, "a"), _moment(pair.b, "b")]
    if sphere:
        parts += [_sphere(pair)]
    parts += [Overlay(dots=(Dot(ORIGIN, "faint", 8, name="origin"),))]
    return _joined(parts)


def _joined(parts: list[Overlay]) -> Overlay:
    kinds = ("strokes", "dots", "sheets", "labels")
    return Overlay(**{k: tuple(item for p in parts for item in getattr(p, k)) for k in kinds})


def _line(line: Line, name: str, through: Array) -> Overlay:
    """Return a line with its foot point; it is drawn as far as the point ``through``."""
    place = float((through - line.foot) @ line.direction)
    ends = line.point([min(-REACH, place - 0.6), max(REACH, place + 0.6)])
    colour = COLOURS[name]
    strokes = (
        Stroke(ends, colour, 3.5, arrow=True, name=f"line {name}"),
        Stroke(
            np.stack([ORIGIN, line.foot]), "faint", 1.3, dashed=True, name=f"way to foot {name}"
        ),
    )
    dots = (Dot(line.foot, colour, 10, ring=True, name=f"foot point {name}"),)
    return Overlay(strokes, dots, labels=(Label(ends[1], name.upper(), colour),))


def _moment(line: Line, name: str) -> Overlay:
    arrow = Stroke(
        np.stack([ORIGIN, line.moment]), COLOURS[name], 2.2, arrow=True, name=f"moment {name}"
    )
    text = {"a": "x̄", "b": "ȳ"}[name]
    return Overlay((arrow,), labels=(Label(line.moment, text, COLOURS[name]),))


def _perpendicular(across: CommonPerpendicular) -> Overlay:
    """Return the segment between the feet, its line with the sense of x × y, and its length."""
    p, q, n, d = across.foot_a, across.foot_b, across.line.direction, float(across.distance)
    if np.isnan(n).any():
        return Overlay()
    ends = p + np.array([[min(0.0, d) - 0.5], [max(0.0, d) + 0.7]]) * n
    strokes = (
        Stroke(ends, "sigma", 1.5, dashed=True, arrow=True, name="perpendicular"),
        Stroke(np.stack([p, q]), "sigma", 4, name="distance"),
    )
    dots = tuple(Dot(foot, "sigma", 10, name=f"end {k}") for k, foot in (("a", p), ("b", q)))
    return Overlay(strokes, dots, labels=(Label((p + q) / 2, f"d = {_number(d, 2)}", "sigma"),))


@functools.cache
def _globe() -> tuple[Sheet, Stroke]:
    """Return the unit sphere and its equator."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 33), np.linspace(0, np.pi, 17))
    points = on_sphere(np.stack([u, v], axis=-1))
    return Sheet(points, "surface", 0.16, "unit sphere"), Stroke(points[8], "faint", 1.0)


def _sphere(pair: Pair) -> Overlay:
    """Return the unit sphere with both directions and the angle θ between them."""
    sheet, equator = _globe()
    ends = {"a": pair.a.direction, "b": pair.b.direction}
    radii = [Stroke(np.stack([ORIGIN, x]), COLOURS[k], 1.2, dashed=True) for k, x in ends.items()]
    dots = tuple(Dot(x, COLOURS[k], 11, name=f"direction {k}") for k, x in ends.items())
    labels = [Label(ends["a"], "x", COLOURS["a"]), Label(ends["b"], "y", COLOURS["b"])]
    if pair.across.relation in ("skew", "meeting"):
        arc = _arc(pair)
        radii.append(Stroke(arc, "delta", 3, name="angle"))
        labels.append(Label(arc[len(arc) // 2], "θ", "delta"))
    return Overlay((equator, *radii), dots, (sheet,), tuple(labels))


def _arc(pair: Pair) -> Array:
    """Return the great circle from x to y: x turned about x × y, as far as θ."""
    x, n = pair.a.direction, pair.across.line.direction
    turn = np.linspace(0.0, pair.across.angle, 25)[:, None]
    points: Array = np.cos(turn) * x + np.sin(turn) * np.cross(n, x)
    return points


# -- numbers and words -----------------------------------------------------------------------------

MANY = (
    "x × y = 0, so there is no single common perpendicular: one passes through every point of A. "
    "Shown is the one through the foot point of A. With no x × y to measure along, d is the plain "
    "distance and has no sign; the dual part of ⟨X, Y⟩ is 0 and says nothing about it."
)
NOTES: Final = {
    "skew": "The common perpendicular is unique; it runs along x × y, and d is the way from A to B "
    "along it, {sense}.",
    "meeting": "The lines have one point in common, both feet are that point, and d = 0.",
    "parallel": MANY,
    "antiparallel": "The directions are opposite, θ = π. " + MANY,
    "equal": "This is one line, X = Y. Every line that meets it at a right angle is a common "
    "perpendicular, so none is shown.",
    "opposite": "This is one line with both its orientations, Y = −X. Every line that meets it at "
    "a right angle is a common perpendicular, so none is shown.",
}


def _number(value: Any, digits: int = 3) -> str:
    text = f"{round(float(value), digits) + 0.0:.{digits}f}"
    return text.replace("-", "−")


def _vector(vector: Array) -> str:
    return "(" + ", ".join(_number(entry) for entry in vector) + ")"


def relation_words(pair: Pair) -> str:
    """Return how the lines lie, in a word or two, and what that means for d."""
    kind = str(pair.across.relation)
    square = kind in ("skew", "meeting") and abs(pair.product.real) < 1e-9
    sense = "forwards, so d is positive" if pair.across.distance > 0 else "backwards: d is negative"
    return f"{'perpendicular and ' if square else ''}{kind}. {NOTES[kind].format(sense=sense)}"


def words(pair: Pair) -> str:
    """Return the picture in words."""
    said = [
        f"Line {name}: direction {_vector(line.direction)}, moment {_vector(line.moment)}, "
        f"foot point {_vector(line.foot)}."
        for name, line in (("A", pair.a), ("B", pair.b))
    ]
    across = pair.across
    said += [f"Angle θ = {_number(across.angle)} rad, d = {_number(across.distance)}."]
    if np.isfinite(across.line.direction).all():
        said += [f"Feet {_vector(across.foot_a)} on A and {_vector(across.foot_b)} on B."]
        far = max(np.linalg.norm(across.foot_a), np.linalg.norm(across.foot_b)) >= FAR
        said += ["They are too far away to be drawn."] * bool(far)
    return " ".join(["Two oriented lines.", *said, f"They are {relation_words(pair)}"])


def lines_html(pair: Pair) -> str:
    """Return directions, moments and foot points of both lines as a table."""
    colours = (getattr(LIGHT, COLOURS[name]) for name in "ab")
    head = "".join(
        f'<th scope="col"><span style="color:{colour}">■</span> line {name}</th>'
        for colour, name in zip(colours, "AB", strict=True)
    )
    rows = "".join(
        f"<tr><td>{name}</td><td>{_vector(getattr(pair.a, part))}</td>"
        f"<td>{_vector(getattr(pair.b, part))}</td></tr>"
        for name, part in (
            ("direction <i>x</i>, <i>y</i>", "direction"),
            ("moment <i>x̄</i>, <i>ȳ</i> (length)", "moment"),
            ("foot point (length)", "foot"),
        )
    )
    return f'<table class="ruledlab-numbers"><tr><td></td>{head}</tr>{rows}</table>'


def pair_html(pair: Pair) -> str:
    """Return ⟨X, Y⟩, θ and d as a table, and how the lines lie."""
    angle = float(pair.across.angle)
    rows = (
        ("⟨x, y⟩ = cos θ", pair.product.real, ""),
        ("⟨x, ȳ⟩ + ⟨x̄, y⟩ = −d sin θ", pair.product.dual, "length"),
        ("angle <i>θ</i>", angle, "rad"),
        ("angle <i>θ</i>", math.degrees(angle), "°"),
        ("distance from A to B <i>d</i>", pair.across.distance, "length"),
    )
    body = "".join(
        f"<tr><td>{name}</td><td>{_number(value)}</td><td>{unit}</td></tr>"
        for name, value, unit in rows
    )
    kind, _, note = relation_words(pair).partition(". ")
    return (
        f'<table class="ruledlab-numbers">{body}</table>'
        f'<div class="ruledlab-note" role="status">The lines are <b>{kind}</b>. {note}</div>'
    )
