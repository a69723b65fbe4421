"""The meshes the shaders move: how corners are numbered, and which part of what each belongs to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from ruledlab.geometry.checks import Array
from ruledlab.lab import shaders

__all__ = [
    "Shape",
    "cells",
    "curve",
    "lattice",
    "marks",
    "needle",
    "ribbons",
    "sheet",
    "square",
    "squares",
]

LINES: Final = 24  # gaps between the rulings drawn as lines

CORNERS = np.array([(0, -1), (0, 1), (1, 1), (1, -1)], dtype=np.float32)
SQUARE = np.array([(-1, -1), (-1, 1), (1, 1), (1, -1)], dtype=np.float32)
CELL = np.array([(0, 0), (0, 1), (1, 1), (1, 0)], dtype=np.float32)


@dataclass(frozen=True, eq=False, slots=True)
class Shape:
    """Triangles: three corners each in ``index``, and float32 attributes of every corner."""

    index: Array
    attributes: dict[str, Array]


def _shape(index: Array, **attributes: Array) -> Shape:
    made = {name: np.asarray(values, dtype=np.float32) for name, values in attributes.items()}
    return Shape(index.astype(np.uint32).ravel(), made)


def _quads(count: int) -> Array:
    """Index of ``count`` separate quads."""
    return np.asarray(4 * np.arange(count)[:, None] + np.array([0, 1, 2, 0, 2, 3]))


def sheet(count: int, bands: int) -> Shape:
    """Return the surface: (fraction along t, fraction along the ruling) at every vertex."""
    t, w = np.meshgrid(np.linspace(0, 1, count), np.linspace(0, 1, bands + 1), indexing="ij")
    first = np.add.outer(np.arange(count - 1) * (bands + 1), np.arange(bands)).ravel()
    across = np.array([0, bands + 1, bands + 2, 0, bands + 2, 1])
    return _shape(first[:, None] + across, place=np.stack([t, w], axis=-1).reshape(-1, 2))


def _strips(start: Array, finish: Array) -> Shape:
    """One ribbon per segment from ``start`` to ``finish``, both (n, 2)."""
    count = len(start)
    return _shape(
        _quads(count),
        start=np.repeat(start, 4, axis=0),
        finish=np.repeat(finish, 4, axis=0),
        corner=np.tile(CORNERS, (count, 1)),
    )


def _along(count: int, w: float) -> tuple[Array, Array]:
    """Return the segments between neighbouring rulings at one fraction of them."""
    places = np.column_stack([np.linspace(0, 1, count), np.full(count, w)])
    return places[:-1], places[1:]


def curve(count: int) -> Shape:
    """Return a ribbon along a curve with a point on every ruling."""
    return _strips(*_along(count, 0.0))


def lattice(count: int) -> Shape:
    """Return some rulings and the two ends of all of them."""
    t = np.unique(np.linspace(0, count - 1, LINES + 1).round()) / (count - 1)
    rulings = (np.column_stack([t, 0 * t]), np.column_stack([t, 0 * t + 1]))
    parts = [rulings, _along(count, 0.0), _along(count, 1.0)]
    return _strips(*(np.concatenate(ends) for ends in zip(*parts, strict=True)))


def _parts(parts: Iterable[tuple[int, int]], boxes: Iterable[Array]) -> Shape:
    part = np.repeat(np.array(list(parts), dtype=float), 4, axis=0)
    return _shape(_quads(len(part) // 4), part=part, corner=np.concatenate(list(boxes)))


def marks() -> Shape:
    """Return the cursor: its ruling, the striction point, and the frame with heads and letters."""
    line, head = shaders.LINE_KIND, shaders.HEAD_KIND
    disc, label = shaders.DISC_KIND, shaders.LABEL_KIND
    parts = [(0, line), *((i, kind) for i in (1, 2, 3) for kind in (line, head)), (4, disc)]
    parts += [(i, label) for i in (1, 2, 3)]
    return _parts(parts, (SQUARE if kind >= disc else CORNERS for _, kind in parts))


def squares(count: int) -> Shape:
    """Return numbered squares about a middle, for control points and dots."""
    return _numbered(count, SQUARE)


def cells(count: int) -> Shape:
    """Return numbered squares from a corner, for the cells of sheets."""
    return _numbered(count, CELL)


def _numbered(count: int, box: Array) -> Shape:
    number = np.repeat(np.arange(float(count)), 4)
    return _shape(_quads(count), number=number, corner=np.tile(box, (count, 1)))


def ribbons(first: int, second: int) -> Shape:
    """Return numbered ribbons of kind 0, then of kind 1, which are drawn after them."""
    numbers = np.concatenate([np.arange(first), np.arange(second)])
    kinds = np.repeat([0, 1], [first, second])
    part = np.repeat(np.column_stack([numbers, kinds]), 4, axis=0)
    count = first + second
    return _shape(_quads(count), part=part, corner=np.tile(CORNERS, (count, 1)))


def needle() -> Shape:
    """Return the cursor's stub and point on the sphere."""
    return _parts([(shaders.STUB_KIND, 0), (shaders.DOT_KIND, 0)], [CORNERS, SQUARE])


def square() -> Shape:
    """Return one square."""
    return _shape(_quads(1), corner=SQUARE)
