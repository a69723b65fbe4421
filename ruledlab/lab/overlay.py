"""What a lesson draws into space beside the surface: strokes, dots, sheets and labels.

The values here are frozen and say what is to be seen; `pack` turns all of them into one array, the
texture that the programs of `ruledlab.lab.shaders` read. Nothing is drawn here.

The texture is a row of texels of four numbers, folded into lines of `COLUMNS`. Its first texels
say where its parts begin, so that everything in it changes at once and any count may change:

=======  ==============================================================================
texel    numbers
=======  ==============================================================================
0        lines of the texture; points of strokes: first, count; styles of strokes: first
1        lengths along strokes: first; dots: first, count; unused
2        points of sheets: first, count; styles of sheets: first; unused
3        places of labels: first; their strokes: first, count; unused
=======  ==============================================================================

* point of a stroke: x, y, z, number of its stroke from 1 (0: a gap). Four lengths to a texel.
* style of a stroke: colour, half width, 1 if dashed + 2 if arrow, its last point
* dot: x, y, z, 1 if seen; colour, radius, 1 if ring, 0
* point of a sheet: x, y, z, ± number of its sheet from 1 (0: a hole), + where a cell begins
* style of a sheet: colour, opacity, first point, 0; columns, rows, 0, 0
* place of a label: x, y, z, 1 if seen; colour, 0, 0, 0
* stroke of a label: both ends, number of its label from 0, 0

A colour is 65536 r + 256 g + b; an end of a label's stroke is two numbers of twelve bits.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ..geometry.checks import Array, GeometryError, finite_array, frozen
from .glyphs import lettering
from .palette import Theme
from .shaders import INK_PLACES, INK_START, INK_STEP
from .shaders import OVERLAY_COLUMNS as COLUMNS

__all__ = ["Dot", "Label", "Overlay", "Packed", "Sheet", "Stroke", "ball", "pack"]

ROWS = 4096
"""Most lines of a texture that every browser accepts."""

HEADER = 4
FARTHEST = 1e12
LABEL_AT = (9.0, 7.0)
"""Where the writing of a label begins, in pixels right of and above its point."""

NAMES = frozenset(field.name for field in fields(Theme)) - {"dark"}
_HEX = re.compile(r"#[0-9a-fA-F]{6}")


# ---- values -------------------------------------------------------------------------------------


def _array(value: Any, name: str, shape: tuple[int, ...], said: str) -> Array:
    """Return a read-only array; −1 in ``shape`` stands for any number. NaN may come in."""
    try:
        array = frozen(value)
    except (TypeError, ValueError):
        raise GeometryError(f"`{name}` must be an array of numbers of shape {said}") from None
    fits = array.ndim == len(shape) and all(
        want in (-1, got) for want, got in zip(shape, array.shape, strict=True)
    )
    if not fits:
        raise GeometryError(f"`{name}` must have shape {said}; got {array.shape}")
    return array


def _checked_colour(colour: Any) -> None:
    if not isinstance(colour, str) or not (colour in NAMES or _HEX.fullmatch(colour)):
        raise GeometryError(
            f"`colour` must be '#rrggbb' or one of {', '.join(sorted(NAMES))}; got {colour!r}"
        )


def _checked_size(value: float, name: str) -> None:
    if finite_array(value, name) <= 0:
        raise GeometryError(f"`{name}` must be a positive number of pixels; got {value!r}")


@dataclass(frozen=True, eq=False, slots=True)
class Stroke:
    """A line through points of space.

    Attributes
    ----------
    points
        (N, 3); a row with NaN is a gap, fewer than two points draw nothing.
    colour
        ``"#rrggbb"`` or the name of a colour of the theme, such as ``"kappa"``.
    width
        in pixels.
    dashed, arrow
        whether it is dashed; whether it has an arrow's head at its last point.
    name
        what it is, for who writes or tests a picture; not drawn.
    """

    points: Array
    colour: str
    width: float = 2.0
    dashed: bool = False
    arrow: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _array(self.points, "points", (-1, 3), "(N, 3)"))
        _checked_colour(self.colour)
        _checked_size(self.width, "width")


@dataclass(frozen=True, eq=False, slots=True)
class Dot:
    """A point of space, drawn as a disc or a ring of ``size`` pixels; with NaN it is not drawn."""

    point: Array
    colour: str
    size: float = 10.0
    ring: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", _array(self.point, "point", (3,), "(3,)"))
        _checked_colour(self.colour)
        _checked_size(self.size, "size")


@dataclass(frozen=True, eq=False, slots=True)
class Sheet:
    """A translucent patch through a grid of points, (M, N, 3) with M, N ≥ 2; NaN is a hole."""

    points: Array
    colour: str
    opacity: float = 0.35
    name: str = ""

    def __post_init__(self) -> None:
        said = "(M, N, 3) with M, N ≥ 2"
        points = _array(self.points, "points", (-1, -1, 3), said)
        if min(points.shape) < 2:
            raise GeometryError(f"`points` must have shape {said}; got {points.shape}")
        object.__setattr__(self, "points", points)
        _checked_colour(self.colour)
        if not 0.0 <= finite_array(self.opacity, "opacity") <= 1.0:
            raise GeometryError(f"`opacity` must lie between 0 and 1; got {self.opacity!r}")


@dataclass(frozen=True, eq=False, slots=True)
class Label:
    """A few characters beside a point of space, always upright and of the same size.

    See `ruledlab.lab.glyphs.lettering` for what can be written: ``"X₁"``, ``"δ"``, ``"κ̄"``.
    """

    point: Array
    text: str
    colour: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", _array(self.point, "point", (3,), "(3,)"))
        if not isinstance(self.text, str):
            raise GeometryError(f"`text` must be a string; got {self.text!r}")
        _checked_colour(self.colour)


@dataclass(frozen=True, eq=False, slots=True)
class Overlay:
    """Everything that is drawn over or beside a surface; what comes later lies on top."""

    strokes: tuple[Stroke, ...] = ()
    dots: tuple[Dot, ...] = ()
    sheets: tuple[Sheet, ...] = ()
    labels: tuple[Label, ...] = ()

    def __post_init__(self) -> None:
        kinds = {"strokes": Stroke, "dots": Dot, "sheets": Sheet, "labels": Label}
        for name, kind in kinds.items():
            given = tuple(getattr(self, name))
            if wrong := [item for item in given if not isinstance(item, kind)]:
                raise GeometryError(
                    f"`{name}` must hold {kind.__name__} values; got {type(wrong[0]).__name__}"
                )
            object.__setattr__(self, name, given)


# ---- packing ------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Packed:
    """An overlay as the programs read it.

    Attributes
    ----------
    texels
        (n, 4) float32, all finite; the first number, the lines of the texture, is still 0.
    counts
        how many of each part: points of strokes, strokes, dots, points of sheets, strokes of
        labels.
    """

    texels: Array
    counts: tuple[int, int, int, int, int]

    @property
    def rows(self) -> int:
        """How many lines of a texture it needs."""
        return -(-len(self.texels) // COLUMNS)

    def texture(self, rows: int) -> Array:
        """Return it as (rows, `COLUMNS`, 4), filled up with zeros."""
        data = np.zeros((rows * COLUMNS, 4), dtype=np.float32)
        data[: len(self.texels)] = self.texels
        data[0, 0] = rows
        return data.reshape(rows, COLUMNS, 4)


def _ink(colour: str, theme: Theme) -> int:
    """Return a colour, '#rrggbb' or a name of the theme, as one number."""
    return int((colour if colour.startswith("#") else str(getattr(theme, colour)))[1:], 16)


def _seen(points: Array) -> Array:
    """Tell which points can be drawn."""
    return np.asarray((np.abs(points) < FARTHEST).all(axis=-1))  # NaN and ∞ are not less


def _placed(points: Array, alpha: Any) -> Array:
    """Return texels x, y, z and ``alpha``, both 0 where a point cannot be drawn."""
    seen = _seen(points)
    texels = np.zeros((*points.shape[:-1], 4))
    texels[..., :3] = np.where(seen[..., None], points, 0.0)
    texels[..., 3] = np.where(seen, alpha, 0.0)
    return texels.reshape(-1, 4)


def _joined(parts: Iterable[Array], width: int = 4) -> Array:
    return np.concatenate([np.zeros((0, width)), *parts])


def _tipped(stroke: Stroke) -> Array:
    """Return the points of a stroke, ended so that its last two give an arrow its direction."""
    points = stroke.points
    if not stroke.arrow:
        return points
    points = points[: 1 + max(np.flatnonzero(_seen(points)), default=-1)]
    ahead = points[:-1] != points[-1:]
    different = np.flatnonzero(ahead.any(axis=1))
    keep = different[-1] + 1 if len(different) else 0
    return np.concatenate([points[:keep], points[-1:]])


def _lengths(points: Array) -> Array:
    """Return the length along a stroke at each of its points; a gap has none."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    steps = np.where(_seen(points)[1:] & _seen(points)[:-1], steps, 0.0)
    return np.concatenate([np.zeros(min(len(points), 1)), np.cumsum(steps)])


def _strokes(strokes: tuple[Stroke, ...], theme: Theme) -> tuple[Array, Array, Array]:
    """Return the points, the styles and the lengths of strokes."""
    lines = [_tipped(stroke) for stroke in strokes]
    points = _joined(_placed(line, number) for number, line in enumerate(lines, 1))
    lengths = np.concatenate([np.zeros(0), *map(_lengths, lines)])
    lengths = np.pad(lengths, (0, -len(lengths) % 4)).reshape(-1, 4)
    last = np.cumsum([len(line) for line in lines]) - 1
    styles = [
        (_ink(stroke.colour, theme), stroke.width / 2, stroke.dashed + 2 * stroke.arrow, end)
        for stroke, end in zip(strokes, last, strict=True)
    ]
    return points, np.array(styles).reshape(-1, 4), lengths


def _dots(dots: tuple[Dot, ...], theme: Theme) -> Array:
    looks = [np.array([(_ink(dot.colour, theme), dot.size / 2, dot.ring, 0)]) for dot in dots]
    pairs = zip(dots, looks, strict=True)
    return _joined(part for dot, look in pairs for part in (_placed(dot.point, 1.0), look))


def _cells(points: Array) -> Array:
    """Return +1 where a cell with four good corners begins, −1 at other points."""
    seen = _seen(points)
    whole = seen[:-1, :-1] & seen[1:, :-1] & seen[:-1, 1:] & seen[1:, 1:]
    return np.where(np.pad(whole, ((0, 1), (0, 1))), 1.0, -1.0)


def _sheets(sheets: tuple[Sheet, ...], theme: Theme) -> tuple[Array, Array]:
    """Return the points and the styles of sheets."""
    points = _joined(
        _placed(sheet.points, number * _cells(sheet.points))
        for number, sheet in enumerate(sheets, 1)
    )
    styles, start = [np.zeros((0, 4))], 0
    for sheet in sheets:
        rows, columns, _ = sheet.points.shape
        look = (_ink(sheet.colour, theme), sheet.opacity, start, 0)
        styles.append(np.array([look, (columns, rows, 0, 0)]))
        start += rows * columns
    return points, np.concatenate(styles)


def _labels(labels: tuple[Label, ...], theme: Theme) -> tuple[Array, Array]:
    """Return the places and the strokes of labels."""
    looks = [np.array([(_ink(label.colour, theme), 0, 0, 0)]) for label in labels]
    pairs = zip(labels, looks, strict=True)
    places = _joined(part for label, look in pairs for part in (_placed(label.point, 1.0), look))
    strokes = _joined(_written(label.text, number) for number, label in enumerate(labels))
    return places, strokes


def _written(text: str, number: int) -> Array:
    ends = lettering(text).reshape(-1, 2, 2) + LABEL_AT
    steps = np.clip(np.round((ends - INK_START) / INK_STEP), 0, INK_PLACES - 1)
    strokes = np.zeros((len(ends), 4))
    strokes[:, :2] = steps @ (INK_PLACES, 1)
    strokes[:, 2] = number
    return strokes


def pack(overlay: Overlay, theme: Theme) -> Packed:
    """Turn an overlay into the array that the programs read, its colours taken from a theme.

    Raises
    ------
    GeometryError
        if there is more than a texture holds, about 160,000 points in all.
    """
    points, styles, lengths = _strokes(overlay.strokes, theme)
    dots = _dots(overlay.dots, theme)
    grid, looks = _sheets(overlay.sheets, theme)
    places, written = _labels(overlay.labels, theme)
    parts = (points, styles, lengths, dots, grid, looks, places, written)
    first = HEADER + np.concatenate([[0], np.cumsum([len(part) for part in parts])])
    header = (
        (0, first[0], len(points), first[1]),
        (first[2], first[3], len(overlay.dots), 0),
        (first[4], len(grid), first[5], 0),
        (first[6], first[7], len(written), 0),
    )
    if first[-1] > ROWS * COLUMNS:
        raise GeometryError(
            f"`overlay` must need at most {ROWS * COLUMNS} texels; it needs {first[-1]}: "
            "draw fewer points"
        )
    texels = np.concatenate([np.array(header), *parts]).astype(np.float32)
    counts = (len(points), len(styles), len(overlay.dots), len(grid), len(written))
    return Packed(texels, counts)


def ball(overlay: Overlay) -> tuple[Array, float]:
    """Return centre and radius of a ball about all that is drawn, or the unit ball."""
    parts = [item.points.reshape(-1, 3) for item in (*overlay.strokes, *overlay.sheets)]
    parts += [item.point[None] for item in (*overlay.dots, *overlay.labels)]
    points = _joined(parts, 3)
    points = points[_seen(points)]
    if not len(points):
        return np.zeros(3), 1.0
    centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
    radius = float(np.linalg.norm(points - centre, axis=1).max())
    return centre, radius or 1.0
