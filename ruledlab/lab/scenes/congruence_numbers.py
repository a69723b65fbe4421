"""The numbers of one line of a congruence and of the loop that is drawn in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...geometry import GeometryError, RuledSurface, enclosed
from ...geometry.checks import Array
from ..markup import numbers_table
from .congruence import Place

__all__ = ["Enclosure", "enclosure", "numbers_html"]


@dataclass(frozen=True, slots=True)
class Enclosure:
    """What a loop encloses: NaN, with the reason, where it encloses nothing by itself.

    Attributes
    ----------
    area
        on the unit sphere, positive if the loop runs counter-clockwise as seen from outside.
    flux
        of the divergence through it, with the same sense.
    reason
        why they are NaN; empty if they are not.
    """

    area: float = math.nan
    flux: float = math.nan
    reason: str = ""


def enclosure(surface: RuledSurface) -> Enclosure:
    """Return area and flux of the loop of a surface."""
    try:
        region = enclosed(surface)
    except GeometryError:
        return Enclosure(reason="no closed loop" if not surface.closure().closed else "no value")
    if region.winding:
        return Enclosure(reason="the loop goes round a pole")
    return Enclosure(-region.area, -region.flux)


def numbers_html(at: Place, delta: float, pitch: float, loop: Enclosure) -> str:
    """Return what holds for one line and for the whole loop, as a table."""
    rows = (
        ("focal points", "w₁, w₂", _pair(at.w, at.kind), "length, from the foot point"),
        ("range of δ here", "", _pair(at.parameters, ""), "length, over all directions"),
        ("δ along this curve", "δ", _number(delta), "length"),
        ("divergence here", "", _number(at.divergence), "length"),
        ("area in the loop", "A", _number(loop.area), loop.reason or "on the unit sphere"),
        ("flux through the loop", "", _number(loop.flux), loop.reason or "length"),
        ("pitch of the loop", "l", _number(pitch), "length"),
    )
    return numbers_table(rows)


def _pair(values: Array, kind: str) -> str:
    if kind == "elliptic":
        return "none real"
    return ", ".join(_number(float(value)) for value in values)


def _number(value: float) -> str:
    if math.isnan(value):
        return "–"
    return f"{value if abs(value) > 5e-7 else 0.0:.6f}".replace("-", "−")
