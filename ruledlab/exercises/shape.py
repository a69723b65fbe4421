"""Is a sketched curve of the right shape? Sign, zeros, turns, rising and falling; never its height.

A hand is not exact: small wiggles, and places a little off, do not count.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..geometry.checks import Array

__all__ = ["Trait", "compare", "drawn", "turns", "zeros"]

BAND = 0.07
"""Heights below this fraction of the curve's size count as zero."""

FLAT = 0.3
"""A curve lower than this fraction of the axis is judged as if it were so high: hands tremble."""

WIGGLE = 0.14
"""A turn counts if the curve goes up or down again by this fraction of its range."""

NEAR = 0.09
"""Zeros and turns may be this fraction of the t-axis apart."""

EDGE = 0.06
"""Zeros and turns nearer to an end than this fraction of the t-axis do not count."""

AGREE = 0.8
"""The part of the t-axis over which signs, or rising and falling, have to agree."""


@dataclass(frozen=True, slots=True)
class Trait:
    """One point of comparison: its name, whether it agrees, and in words what there is."""

    name: str
    agrees: bool
    word: str


def drawn(sketch: Array) -> float:
    """Return which part of the t-axis is drawn, 0 to 1."""
    return float(np.isfinite(sketch).mean())


def compare(t: Array, sketch: Array, truth: Array, height: float) -> tuple[Trait, ...]:
    """Compare a sketch with the true curve, both over t; NaN where there is nothing.

    Parameters
    ----------
    t
        places, increasing.
    sketch, truth
        the heights there.
    height
        height of the axis, to tell a flat line from a steep one.
    """
    sketch = _smooth(sketch)
    there = np.isfinite(sketch) & np.isfinite(truth)
    t, sketch, truth = t[there], sketch[there], truth[there]
    return (
        _sign(t, sketch, truth, height),
        _same_places("zeros", "crosses zero", zeros(t, sketch, height), zeros(t, truth, height), t),
        _turning(t, sketch, truth, height),
        _monotony(t, sketch, truth, height),
    )


def zeros(t: Array, y: Array, height: float) -> Array:
    """Return where the curve crosses zero and really gets to the other side."""
    band = BAND * max(float(np.abs(y).max(initial=0.0)), FLAT * height)
    clear = np.flatnonzero(np.abs(y) > band)
    sides = np.sign(y[clear])
    places = []
    for i in np.flatnonzero(sides[1:] != sides[:-1]):
        part = slice(clear[i], clear[i + 1] + 1)
        order = np.argsort(y[part])
        places.append(float(np.interp(0.0, y[part][order], t[part][order])))
    return np.array([x for x in places if _inside(x, t)])


def _inside(x: float, t: Array) -> bool:
    edge = EDGE * float(t[-1] - t[0])
    return bool(t[0] + edge < x < t[-1] - edge)


def turns(t: Array, y: Array, height: float) -> list[tuple[Literal["max", "min"], float]]:
    """Return the extrema inside the domain, leaving out wiggles."""
    step = WIGGLE * max(float(np.ptp(y)) if len(y) else 0.0, 0.2 * height)
    found: list[tuple[Literal["max", "min"], float]] = []
    high = low = 0
    heading = 0
    for i in range(len(y)):
        high, low = (i if y[i] > y[high] else high), (i if y[i] < y[low] else low)
        if heading >= 0 and y[high] - y[i] > step:
            if heading > 0:  # at first there is only a direction, no turn
                found.append(("max", _middle(t, y, high)))
            heading, high, low = -1, i, i
        elif heading <= 0 and y[i] - y[low] > step:
            if heading < 0:
                found.append(("min", _middle(t, y, low)))
            heading, high, low = 1, i, i
    return [(kind, x) for kind, x in found if _inside(x, t)]


def _middle(t: Array, y: Array, at: int) -> float:
    """Return the middle of a flat top, which begins at ``at``."""
    end = at
    while end + 1 < len(y) and y[end + 1] == y[at]:
        end += 1
    return float((t[at] + t[end]) / 2)


def _smooth(y: Array) -> Array:
    """Return means over three neighbours, where all three are drawn."""
    means = y.copy()
    means[1:-1] = (y[:-2] + y[1:-1] + y[2:]) / 3
    return np.where(np.isfinite(means), means, y)


def _sign(t: Array, sketch: Array, truth: Array, height: float) -> Trait:
    size = max(float(np.abs(truth).max(initial=0.0)), 0.02 * height)
    clear = np.abs(truth) > 2 * BAND * size
    same = np.sign(sketch) == np.sign(truth)
    wrong = clear & ~same
    if not clear.any():
        flat = float(np.abs(sketch).mean()) < 0.12 * height
        return Trait("sign", flat, "the curve is zero all along" + ("" if flat else "; not yours"))
    if wrong.mean() <= (1 - AGREE) * clear.mean():
        return Trait("sign", True, "above and below zero where the curve is")
    if (clear & (np.sign(sketch) == -np.sign(truth))).mean() >= 0.9 * clear.mean():
        return Trait("sign", False, "yours has the opposite sign everywhere")
    if not sketch.any():
        return Trait("sign", False, "yours is zero all along; the curve is not")
    return Trait("sign", False, f"the other sign than the curve around {_span(t[wrong])}")


def _span(t: Array) -> str:
    return f"t = {t[len(t) // 2]:.2f}"


def _same_places(name: str, verb: str, mine: Array, true: Array, t: Array) -> Trait:
    near = NEAR * float(t[-1] - t[0]) if len(t) else 0.0
    if len(mine) == len(true) and np.all(np.abs(mine - true) <= near):
        said = f"where the curve {verb}" if len(true) else f"neither ever {verb}"
        return Trait(name, True, said)
    return Trait(name, False, f"yours {verb} {_places(mine)}, the curve {_places(true)}")


def _places(t: Array) -> str:
    if not len(t):
        return "nowhere"
    return "near t = " + ", ".join(f"{x:.2f}".replace("-", "−") for x in t)


def _turning(t: Array, sketch: Array, truth: Array, height: float) -> Trait:
    mine, true = turns(t, sketch, height), turns(t, truth, height)
    near = 1.2 * NEAR * float(t[-1] - t[0]) if len(t) else 0.0
    if [kind for kind, _ in mine] == [kind for kind, _ in true] and all(
        abs(a - b) <= near for (_, a), (_, b) in zip(mine, true, strict=True)
    ):
        return Trait("turns", True, "where the curve turns" if true else "neither turns")
    return Trait("turns", False, f"yours has {_extrema(mine)}, the curve {_extrema(true)}")


def _extrema(found: list[tuple[Literal["max", "min"], float]]) -> str:
    words = {"max": "a maximum", "min": "a minimum"}
    if not found:
        return "none"
    return ", ".join(f"{words[kind]} near t = {x:.2f}".replace("-", "−") for kind, x in found)


def _monotony(t: Array, sketch: Array, truth: Array, height: float) -> Trait:
    mine, true = np.diff(sketch), np.diff(truth)
    scale = max(float(np.ptp(truth)) if len(truth) else 0.0, 0.02 * height)
    clear = np.abs(true) > 0.5 * scale / max(len(true), 1)
    if not clear.any():
        flat = (float(np.ptp(sketch)) if len(sketch) else 0.0) < 0.2 * height
        said = "the curve stays level" + ("" if flat else "; yours does not")
        return Trait("rising and falling", flat, said)
    part = float((np.sign(mine) == np.sign(true))[clear].mean())
    said = f"the same way as the curve over {round(100 * part)} % of its slopes"
    return Trait("rising and falling", part >= AGREE - 0.05, said)
