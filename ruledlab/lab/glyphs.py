"""A small alphabet of strokes, for the labels in space.

A character is drawn as a few straight strokes of constant weight, so that a label is a short list
of segments, sharp at every size, and needs no font, no picture and no second texture. Letters are
written down as paths in a grid where the base line is 0, small letters are 7 high and capitals 10.
"""

from __future__ import annotations

import itertools
import math
import unicodedata
from functools import cache

import numpy as np

from ..geometry.checks import Array, frozen

__all__ = ["KNOWN", "lettering"]

# A path is a row of points "x,y" and arcs "@x,y,rx,ry,from,to" (degrees, anticlockwise if to is
# the greater), joined one to the next; "|" lifts the pen.
_BOWL = "@3,3.5,3,3.5,90,450"
_PATHS = {
    "A": "0,0 4,10 8,0 | 1.3,3.3 6.7,3.3",
    "B": "0,5.3 3.7,5.3 @3.7,7.65,2.5,2.35,-90,90 0,10 0,0 4,0 @4,2.65,2.8,2.65,-90,90",
    "C": "@4.6,5,4.6,5,48,312",
    "D": "0,0 0,10 3,10 @3,5,4.8,5,90,-90 0,0",
    "E": "6,0 0,0 0,10 6,10 | 0,5.2 5.2,5.2",
    "F": "0,0 0,10 6,10 | 0,5.2 5,5.2",
    "G": "@4.7,5,4.7,5,48,325 8.6,4.6 5.4,4.6",
    "H": "0,0 0,10 | 7.4,0 7.4,10 | 0,5.2 7.4,5.2",
    "I": "0,0 0,10",
    "J": "4.2,10 4.2,2.6 @2.1,2.6,2.1,2.6,0,-160",
    "K": "0,0 0,10 | 6.6,10 0,3.6 | 2.4,5.9 7,0",
    "L": "0,10 0,0 5.6,0",
    "M": "0,0 0,10 4.5,3 9,10 9,0",
    "N": "0,0 0,10 7.4,0 7.4,10",
    "O": "@4.8,5,4.8,5,90,450",
    "P": "0,0 0,10 3.6,10 @3.6,7.2,2.9,2.8,90,-90 0,4.4",
    "Q": "@4.8,5,4.8,5,90,450 | 5.8,2.4 9,-0.8",
    "R": "0,0 0,10 3.6,10 @3.6,7.2,2.9,2.8,90,-90 0,4.4 | 3.6,4.4 6.8,0",
    "S": "@3.1,7.55,2.9,2.45,30,270 @3.1,2.55,3.1,2.55,90,-150",
    "T": "0,10 7.4,10 | 3.7,10 3.7,0",
    "U": "0,10 0,3.6 @3.6,3.6,3.6,3.6,180,360 7.2,10",
    "V": "0,10 4,0 8,10",
    "W": "0,10 2.6,0 5.4,9 8.2,0 10.8,10",
    "X": "0,0 7.4,10 | 0,10 7.4,0",
    "Y": "0,10 3.8,4.8 7.6,10 | 3.8,4.8 3.8,0",
    "Z": "0,10 7,10 0,0 7,0",
    "a": f"{_BOWL} | 6,7 6,0",
    "b": f"0,10.4 0,0 | {_BOWL}",
    "c": "@3,3.5,3,3.5,50,310",
    "d": f"6,10.4 6,0 | {_BOWL}",
    "e": "0,3.5 6,3.5 @3,3.5,3,3.5,0,312",
    "f": "4,10.2 @3.4,8.4,1.8,1.8,80,180 1.6,0 | 0,7 3.8,7",
    "g": f"6,7 6,-0.6 @3,-0.6,3,2.6,0,-150 | {_BOWL}",
    "h": "0,10.4 0,0 | 0,4 @2.8,4.2,2.8,2.8,180,0 5.6,0",
    "i": "0,7 0,0 | 0,9.8 0,9.8",
    "j": "1.8,7 1.8,-1.2 @0,-1.2,1.8,1.8,0,-80 | 1.8,9.8 1.8,9.8",
    "k": "0,10.4 0,0 | 5,7 0,2.6 | 1.8,4.2 5.4,0",
    "l": "0,10.4 0,0",
    "m": "0,7 0,0 | 0,4.6 @2.3,4.7,2.3,2.3,180,0 4.6,0 | 4.6,4.7 @6.9,4.7,2.3,2.3,180,0 9.2,0",
    "n": "0,7 0,0 | 0,4 @2.8,4.2,2.8,2.8,180,0 5.6,0",
    "o": "@3.1,3.5,3.1,3.5,90,450",
    "p": f"0,7 0,-3 | {_BOWL}",
    "q": f"6,7 6,-3 | {_BOWL}",
    "r": "0,7 0,0 | 0,3.8 @3,3.9,3,3.1,180,75",
    "s": "@2.4,5.25,2.2,1.75,30,270 @2.4,1.75,2.4,1.75,90,-150",
    "t": "1.6,9.6 1.6,1.8 @3.4,1.8,1.8,1.8,180,285 | 0,7 3.8,7",
    "u": "0,7 0,2.8 @2.8,2.8,2.8,2.8,180,360 5.6,7 5.6,0",
    "v": "0,7 2.9,0 5.8,7",
    "w": "0,7 2,0 4.2,6.4 6.4,0 8.4,7",
    "x": "0,0 5.6,7 | 0,7 5.6,0",
    "y": "0,7 2.9,0.2 | 5.8,7 2.3,-2.2 0.8,-3",
    "z": "0,7 5.2,7 0,0 5.2,0",
    "0": "@3.2,5,3.2,5,90,450",
    "1": "0.2,7.9 2.6,10 2.6,0",
    "2": "@3.1,7.1,2.9,2.9,165,-35 0,0 6.4,0",
    "3": "@2.9,7.55,2.6,2.45,150,-90 @2.9,2.55,3,2.55,90,-150",
    "4": "4.8,0 4.8,10 0,3 6.6,3",
    "5": "5.6,10 1,10 0.5,5.6 @2.9,3.2,3.1,3.2,130,-145",
    "6": "@6.4,3.1,6.4,6.9,104,180 | @3.1,3.1,3.1,3.1,90,450",
    "7": "0,10 6,10 2.2,0",
    "8": "@3.1,7.6,2.5,2.4,-90,270 | @3.1,2.6,3.1,2.6,90,450",
    "9": "@-0.2,6.9,6.4,6.9,-76,0 | @3.1,6.9,3.1,3.1,90,450",
    "α": "6.6,0 @2.7,3.5,2.7,3.5,40,320 6.3,7",
    "β": "0,-3 0,7.7 @2.3,7.7,2.3,2.5,180,-90 @2.3,2.6,3.1,2.6,90,-150",
    "γ": "0,7 3,0.4 5.8,7 | 3,0.4 3,-3",
    "δ": "@2.9,2.9,2.9,2.9,90,450 | @2.9,8.6,2,1.6,45,205 4.9,5",
    "ε": "@2.7,5.25,2.4,1.75,40,270 @2.7,1.75,2.7,1.75,90,320",
    "θ": "@2.8,5,2.8,5.2,90,450 | 0,5 5.6,5",
    "κ": "0,7 0,0 | 5.2,7 0,2.8 | 1.8,4.2 5.4,0",
    "λ": "0,10.2 1.4,10.2 5.8,0 | 3.3,5.8 0,0",
    "μ": "0,7 0,-3 | 0,2.6 @2.6,2.6,2.6,2.6,180,360 5.2,7 5.2,0",
    "ν": "0,7 2.9,0 5.8,7",
    "ξ": "5,10.2 2.8,10.2 @2.8,8.5,2.2,1.7,90,270 4.4,6.8 | "
    "2.8,6.8 @2.8,4.4,2.8,2.4,90,270 3.8,2 @3.8,0.6,1.4,1.4,90,-110",
    "π": "0,7 6.6,7 | 1.7,7 1.5,0 | 4.9,7 5.1,0",
    "ρ": "0,-3 0,3.5 @3,3.5,3,3.5,180,-180",
    "σ": f"7,7 3,7 {_BOWL}",
    "τ": "0,7 6,7 | 3,7 3,1.5 @4.5,1.5,1.5,1.5,180,290",
    "φ": "@3.4,3.5,3.4,3.5,90,450 | 3.4,10 3.4,-3",
    "ψ": "0,7 0,3.4 @3.4,3.4,3.4,3.4,180,360 6.8,7 | 3.4,9.4 3.4,-3",
    "ω": "1.2,7 @2.1,3.1,2.1,3.1,150,360 4.2,5 @6.3,3.1,2.1,3.1,180,390 7.2,7",
    "Γ": "0,0 0,10 6,10",
    "Δ": "0,0 4,10 8,0 0,0",
    "Θ": "@4.8,5,4.8,5,90,450 | 2.4,5 7.2,5",
    "Λ": "0,0 4,10 8,0",
    "Ξ": "0,10 6.6,10 | 1,5 5.6,5 | 0,0 6.6,0",
    "Π": "0,0 0,10 7.2,10 7.2,0",
    "Σ": "6.6,10 0,10 4,5 0,0 6.6,0",
    "Φ": "@4.2,5,4.2,3.2,90,450 | 4.2,10 4.2,0",
    "Ω": "0,0 2.5,0 @4.4,5.6,4.2,4.4,243,-63 6.3,0 8.8,0",
    "∂": "1,9 @1.8,4.6,4,5.2,95,0 | @2.9,3.1,2.9,3.1,90,450",
    "+": "0,4.5 6,4.5 | 3,7.5 3,1.5",
    "−": "0,4.5 5.6,4.5",
    "=": "0,6 6,6 | 0,3 6,3",
    "<": "5.6,7.5 0,4.5 5.6,1.5",
    ">": "0,7.5 5.6,4.5 0,1.5",
    "×": "0.4,2 5.2,7 | 0.4,7 5.2,2",
    ".": "0,0.2 0.9,0.2 | 0,0.8 0.9,0.8",
    "·": "0,4 0,4",
    ",": "0.5,0 0,-1.8",
    ":": "0,0.4 0,0.4 | 0,6.4 0,6.4",
    "′": "1,10.4 0,7.4",
    "°": "@1.6,8.6,1.6,1.6,90,450",
    "(": "@4,3.7,4,7.4,125,235",
    ")": "@-1.6,3.7,4,7.4,55,-55",
    "/": "0,-1 4,10.6",
    "|": "0,-2 0,10.6",
    "?": "@2.6,7.4,2.6,2.6,160,-60 2.6,4.2 2.6,3 | 2.6,0 2.6,0",
}
_SAME = {"-": "−", "'": "′", "–": "−", "ε": "ε", "µ": "μ", "ϕ": "φ", "∆": "Δ"}
_MISSING = "0,0 0,10 6,10 6,0 0,0"
_BARS, _HAT = "\u0304\u0305", "\u0302"

KNOWN = "".join(_PATHS)
"""Characters with a shape of their own; others are drawn as an empty box."""

_GAP, _SPACE = 2.7, 4.5
_RAISED = {"<sub>": (0.64, -2.4), "<super>": (0.64, 5.2)}  # scale, shift upwards


def _arc(text: str) -> list[tuple[float, float]]:
    x, y, rx, ry, start, end = (float(part) for part in text.split(","))
    count = max(2, math.ceil(abs(end - start) / 32.0))
    angles = np.radians(np.linspace(start, end, count + 1))
    return [(x + rx * math.cos(a), y + ry * math.sin(a)) for a in angles]


def _points(token: str) -> list[tuple[float, float]]:
    if token.startswith("@"):
        return _arc(token[1:])
    x, y = token.split(",")
    return [(float(x), float(y))]


@cache
def _shape(character: str) -> Array:
    """Return the strokes of one character, (n, 4): x and y of both ends; it begins at x = 0."""
    strokes: list[tuple[float, ...]] = []
    for path in _PATHS.get(_SAME.get(character, character), _MISSING).split("|"):
        points = [point for token in path.split() for point in _points(token)]
        strokes += [a + b for a, b in itertools.pairwise(points)]
    array = np.array(strokes)
    array[:, ::2] -= array[:, ::2].min()
    return frozen(array)


def _accent(mark: str, below: Array) -> Array:
    """Return the bar or the hat over the strokes of a character."""
    left, right = below[:, ::2].min(), below[:, ::2].max()
    middle, height = 0.5 * (left + right), below[:, 1::2].max() + 2.4
    half = max(0.5 * (right - left), 2.2)
    if mark in _BARS:
        return np.array([(middle - half, height, middle + half, height)])
    hat = (middle, height + 1.6)
    return np.array([(middle - 2.2, height, *hat), (*hat, middle + 2.2, height)])


def _written(character: str) -> tuple[str, float, float]:
    """Return the character to draw, its scale and its shift: '₁' is a small, low '1'."""
    kind, _, code = unicodedata.decomposition(character).partition(" ")
    if kind not in _RAISED:
        return character, 1.0, 0.0
    return chr(int(code, 16)), *_RAISED[kind]


def _parts(text: str) -> list[str]:
    """Split accents from their letters, leaving indices as they are."""
    parts: list[str] = []
    for character in text:
        parts += unicodedata.normalize("NFD", character)
    return parts


@cache
def lettering(text: str) -> Array:
    """Return the strokes that write a text.

    Parameters
    ----------
    text
        a few characters: Latin and Greek letters, digits, indices such as ₁ and ², a bar
        (``"κ̄"``, ``"ū"``) or a hat over a letter. What is not known is drawn as a box.

    Returns
    -------
    array
        (n, 4): x and y of both ends of every stroke, in pixels, y upwards; the text begins at the
        origin and stands on the base line.
    """
    strokes, last, x = np.zeros((0, 4)), np.zeros((0, 4)), 0.0
    for part in _parts(text):
        if part in _BARS + _HAT:
            last = _accent(part, last) if len(last) else last
        elif part.isspace():
            x, last = x + _SPACE, last[:0]
        elif not unicodedata.combining(part):
            character, scale, shift = _written(part)
            begin = x - (0.8 if scale < 1.0 and x else 0.0)
            last = scale * _shape(character) + np.array([begin, shift, begin, shift])
            x = last[:, ::2].max() + _GAP
        else:
            continue
        strokes = np.concatenate([strokes, last])
    return frozen(strokes)
