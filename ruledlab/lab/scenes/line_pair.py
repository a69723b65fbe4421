"""Two oriented lines: some positions by name, the picture and the words.

No widgets: the app of lesson 02 shows what is made here.
"""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from typing import Any, Final

import numpy as np

from ...geometry import CommonPerpendicular, Line
from ...geometry.checks import Array
from ...geometry.line import on_sphere
from ...pair import OneLine, Pair, TwoLines
from ..overlay import Dot, Label, Overlay, Sheet, Stroke

__all__ = [
    "PRESETS",
    "lines_html",
    "pair_html",
    "picture",
    "relation_words",
    "sight",
    "words",
]

REACH: Final = 2.2  # half of the length of a line that is drawn, beyond what lies on it
FAR: Final = 12.0  # from the origin, where feet of nearly parallel lines are no longer drawn
ROOM: Final = 1.24  # about what is drawn, for labels and for what is nearer to the eye
ORIGIN: Final = np.zeros(3)
COLOURS: Final = {"a": "kappa", "b": "tau"}
BREADTH: Final = {"a": 1.7, "b": 1.0}  # A is broader, so that both are seen where they coincide
PARTNER: Final = {"B": "A", "y": "x", "ȳ": "x̄"}
SAME: Final = 0.02  # labels nearer to each other than this are written as one


# -- positions by name -----------------------------------------------------------------------------

# The given points are not the feet, where their handles would hide them.
_A = OneLine(math.pi / 2, math.pi / 4, 1.5, -0.5, -0.5)
_LEVEL = OneLine(0.0, math.pi / 2, -0.5, 0.0, 1.0)
PRESETS: Final = {
    "skew": TwoLines(
        OneLine(-math.pi / 4, math.pi / 6, 1.0, 0.0, -1.5),
        OneLine(0.0, math.pi / 2, -1.0, 0.5, 1.0),
    ),
    "meeting": TwoLines(_LEVEL, OneLine(math.pi / 3, 3 * math.pi / 4, 0.5, 0.0, 1.0)),
    "perpendicular and meeting": TwoLines(
        _LEVEL, OneLine(math.pi / 2, math.pi / 4, 0.5, -0.5, 0.5)
    ),
    "parallel": TwoLines(_A, replace(_A, x=-0.5, y=0.0, z=-1.0)),
    "antiparallel": TwoLines(_A, replace(_A.reversed(), x=-0.5, y=1.0, z=0.0)),
    "equal": TwoLines(_A, replace(_A, y=0.0, z=0.0)),
}
"""Positions of two lines by name."""


# -- the picture -----------------------------------------------------------------------------------


def picture(pair: Pair, *, moments: bool = True, sphere: bool = True) -> Overlay:
    """Return what is drawn: lines, feet, common perpendicular, and if wanted moments and sphere."""
    near = _farthest(pair) < FAR
    one = pair.across.relation in ("equal", "opposite")
    parts = [_line(pair.a, "a", pair.across.foot_a if near else pair.a.foot, striped=one)]
    parts += [_line(pair.b, "b", pair.across.foot_b if near else pair.b.foot, striped=one)]
    parts += [_perpendicular(pair.across)] * near
    if moments:
        parts += [_moment(pair.a, "a"), _moment(pair.b, "b")]
    if sphere:
        parts += [_sphere(pair)]
    parts += [Overlay(dots=(Dot(ORIGIN, "faint", 8, name="origin"),))]
    return _joined(parts)


def sight(overlay: Overlay, axes: Array, aspect: float) -> tuple[Array, float]:
    """Return centre and radius of the ball to look at, so that the picture is filled.

    Parameters
    ----------
    overlay
        what is drawn.
    axes
        right, up and towards the eye, as rows.
    aspect
        width over height of the picture.
    """
    points = [stroke.points for stroke in overlay.strokes]
    points += [sheet.points.reshape(-1, 3) for sheet in overlay.sheets]
    points += [dot.point[None] for dot in overlay.dots]
    box = np.concatenate(points) @ axes.T
    low, high = np.nanmin(box, axis=0), np.nanmax(box, axis=0)
    half = 0.5 * (high - low)
    centre: Array = 0.5 * (low + high) @ axes
    return centre, ROOM * float(max(half[1], half[0] / aspect))


def _farthest(pair: Pair) -> float:
    """Return how far from the origin a foot of the common perpendicular is."""
    feet = pair.across.foot_a, pair.across.foot_b
    return max(float(np.linalg.norm(foot)) for foot in feet)


def _joined(parts: list[Overlay]) -> Overlay:
    kinds = ("strokes", "dots", "sheets")
    joined = {kind: tuple(item for part in parts for item in getattr(part, kind)) for kind in kinds}
    labels: list[Label] = []
    for label in (label for part in parts for label in part.labels):
        _write(labels, label)
    return Overlay(**joined, labels=tuple(labels))


def _write(labels: list[Label], label: Label) -> None:
    """Add a label; if it is that of line B and A's is at the same place, make them one: "A = B"."""
    for place, other in enumerate(labels):
        near = np.linalg.norm(other.point - label.point) < SAME
        if near and other.text == PARTNER.get(label.text):
            labels[place] = Label(other.point, f"{other.text} = {label.text}", other.colour)
            return
    labels.append(label)


def _line(line: Line, name: str, through: Array, *, striped: bool) -> Overlay:
    """Return a line with its foot point; it is drawn as far as the point ``through``."""
    place = float((through - line.foot) @ line.direction)
    ends = line.point([min(-REACH, place - 0.6), max(REACH, place + 0.6)])
    points = _stripes(line, name) if striped else ends
    colour, breadth = COLOURS[name], BREADTH[name]
    strokes = (
        Stroke(points, colour, 3.2 * breadth, arrow=True, name=f"line {name}"),
        Stroke(
            np.stack([ORIGIN, line.foot]), "faint", 1.3, dashed=True, name=f"way to foot {name}"
        ),
    )
    dots = (Dot(line.foot, colour, 9 * breadth, ring=True, name=f"foot point {name}"),)
    return Overlay(strokes, dots, labels=(Label(ends[1], name.upper(), colour),))


def _stripes(line: Line, name: str) -> Array:
    """Return every other piece of a line: the other line of the pair has those between."""
    places = np.linspace(-REACH, REACH, 12)  # an odd number of pieces: reversed, they are the same
    starts = np.arange(0 if name == "a" else 1, 11, 2)
    pieces = np.stack([places[starts], places[starts + 1]], axis=1)
    return np.pad(line.point(pieces), ((0, 0), (0, 1), (0, 0)), constant_values=np.nan).reshape(
        -1, 3
    )


def _moment(line: Line, name: str) -> Overlay:
    ends, width = np.stack([ORIGIN, line.moment]), 1.9 * BREADTH[name]
    arrow = Stroke(ends, COLOURS[name], width, arrow=True, name=f"moment {name}")
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
    dots = tuple(Dot(x, COLOURS[k], 8 * BREADTH[k], name=f"direction {k}") for k, x in ends.items())
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
    "along it: {sense}.",
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
    sense = "forwards, d is positive" if pair.across.distance > 0 else "backwards, d is negative"
    far = _farthest(pair)
    away = (
        f" Its feet are {far:.4g} away from the origin, too far to be drawn." if far >= FAR else ""
    )
    name = f"{'perpendicular and ' if square else ''}{kind}"
    return f"{name}. {NOTES[kind].format(sense=sense)}{away}"


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
    return " ".join(["Two oriented lines.", *said, f"They are {relation_words(pair)}"])


def lines_html(pair: Pair) -> str:
    """Return directions, moments and foot points of both lines as a table."""
    head = "".join(
        f'<th scope="col"><span class="ruledlab-hue is-{colour}">■</span> line {name.upper()}</th>'
        for name, colour in COLOURS.items()
    )
    cell = '<td style="font-weight:400;text-align:right">'
    rows = "".join(
        f"<tr><td>{name}</td>{cell}{_vector(getattr(pair.a, part))}</td>"
        f"{cell}{_vector(getattr(pair.b, part))}</td></tr>"
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
        ("⟨x, ȳ⟩ + ⟨x̄, y⟩<br>= −d sin θ", pair.product.dual, "length"),
        ("angle <i>θ</i>", angle, "rad"),
        ("angle <i>θ</i>", math.degrees(angle), "°"),
        ("distance <i>d</i>", pair.across.distance, "length"),
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
