"""Lesson 08: once round a closed surface, what comes back with a gap and what is enclosed."""

from __future__ import annotations

import functools
import html
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry import (
    Dual,
    Enclosed,
    GeometryError,
    RuledSurface,
    Stepped,
    Trajectory,
    Turning,
    enclosed,
    gallery,
    steiner,
    stepped,
    trajectory,
    turning,
    winding_numbers,
)
from ...geometry.checks import Array
from ..controls import (
    FieldControl,
    GalleryControl,
    Group,
    HistoryControl,
    NumberControl,
    TimeControl,
    design_of,
)
from ..overlay import Dot, Label, Overlay, Sheet, Stroke
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp
from .studio import ChartFigure

__all__ = ["OnceRound", "Path", "Ways", "once_round"]

PLACES = 401
"""Places of t on the way round: the cursor's own, so that it stands on them."""


def once_round(design: Design | None = None) -> OnceRound:
    """Return the app of lesson 08: pitch and angle of pitch, shown and found in three ways.

    Parameters
    ----------
    design
        where to begin; None for the paper's Example 2.
    """
    return OnceRound(Lab(design or design_of(gallery.example("example_2"))))


# -- what there is to show, without widgets --------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Path:
    """The orthogonal trajectory and ξ on their way round; None, with the reason, where lost."""

    walk: Trajectory | None
    turn: Turning | None
    reasons: tuple[str, ...]


def path_of(surface: RuledSurface, w0: float) -> Path:
    """Return the way round from m + w0 x on the first ruling."""
    t, reasons = np.linspace(*surface.domain, PLACES), []
    walk = _or_reason(lambda: trajectory(surface, w0, t), reasons)
    turn = _or_reason(lambda: turning(surface, 0.0, t), reasons)
    return Path(walk, turn, tuple(reasons))


@dataclass(frozen=True, eq=False, slots=True)
class Ways:
    """λ and l of a closed surface in three ways; None, with the reason, where one fails."""

    total: Dual | None
    region: Enclosed | None
    steps: Stepped | None
    carried: Dual | None
    reasons: tuple[str, ...]


def ways_of(surface: RuledSurface) -> Ways:
    """Return λ and l by line integrals, by what is enclosed and ruling by ruling."""
    reasons: list[str] = []
    parts = [
        _or_reason(functools.partial(find, surface), reasons)
        for find in (RuledSurface.dual_angle_of_pitch, enclosed, stepped, steiner)
    ]
    return Ways(*parts, tuple(dict.fromkeys(reasons)))


def _or_reason(find: Callable[[], Any], reasons: list[str]) -> Any:
    try:
        return find()
    except GeometryError as error:
        reasons.append(str(error).replace("`", ""))
        return None


def overlay_of(lab: Lab, path: Path) -> Overlay:
    """Return the way round, the gap l on the first ruling, ξ at both ends and the angle λ."""
    scene, mark, state = lab.result.scene, lab.mark, lab.result.closure
    strokes: list[Stroke] = []
    dots: list[Dot] = []
    sheets: list[Sheet] = []
    labels: list[Label] = []
    if path.walk is not None:
        points = path.walk.points
        strokes.append(Stroke(points, "delta", 3.0, name="trajectory"))
        dots += [Dot(points[0], "delta", 11.0, name="start")]
        dots += [Dot(points[-1], "delta", 13.0, ring=True, name="end")]
        dots.append(Dot(_at(path.walk.t, points, mark.t), "cursor", 11.0, name="cursor"))
        if state.oriented:
            strokes.append(Stroke(points[[0, -1]], "tau", 6.0, name="gap"))
            labels.append(Label(0.5 * (points[0] + points[-1]), "l", "tau"))
    if path.turn is not None:
        m, size = scene.striction, 0.34 * scene.radius
        last = _at(path.turn.t, path.turn.xi, mark.t)
        strokes += [
            _arrow(m[0], path.turn.xi[0], size, "ink", "ξ at the start"),
            _arrow(m[-1], path.turn.xi[-1], size, "kappa", "ξ at the end"),
            _arrow(mark.striction, last, size, "cursor", "ξ at the cursor"),
        ]
        labels.append(Label(m[0] + 1.06 * size * path.turn.xi[0], "ξ", "ink"))
        if state.oriented:
            fan = _fan(lab.result.surface, path.turn.gap, m[0], 0.7 * size)
            sheets.append(Sheet(fan, "kappa", 0.4, name="λ"))
            labels.append(Label(fan[1, fan.shape[1] // 2], "λ", "kappa"))
    return Overlay(tuple(strokes), tuple(dots), tuple(sheets), tuple(labels))


def _at(t: Array, rows: Array, place: float) -> Array:
    """Return the row at a place between samples."""
    return np.array([np.interp(place, t, column) for column in rows.T])


def _arrow(start: Array, way: Array, size: float, colour: str, name: str) -> Stroke:
    return Stroke(np.stack([start, start + size * way]), colour, 4.0, arrow=True, name=name)


def _fan(surface: RuledSurface, angle: float, centre: Array, size: float) -> Array:
    """Return the angle λ in the normal plane of the first ruling, widening with each turn."""
    frame = surface.frame(surface.domain[0])
    phi = np.linspace(0.0, angle, 97)[:, np.newaxis]
    rim = np.cos(phi) * frame[1] + np.sin(phi) * frame[2]
    reach = size * (0.8 + 0.2 * np.abs(phi) / (2.0 * math.pi))
    return np.stack([centre + 0.0 * rim, centre + reach * rim])


# -- the region, as a picture ----------------------------------------------------------------------

WIDE, HIGH, EDGE = 380.0, 300.0, 30.0
CELLS = 56
HUES = {1: "#0072b2", -1: "#d55e00"}


def region_svg(region: Enclosed) -> str:
    """Return the enclosed region in the chart, shaded by how often it is encircled.

    As in the chart of the lab, v grows downwards: this is the sphere seen from outside, and
    anticlockwise is anticlockwise there.
    """
    outline = region.outline
    low, high = outline.min(axis=0), outline.max(axis=0)
    scale = float(((WIDE - 2 * EDGE, HIGH - 2 * EDGE) / np.maximum(high - low, 1e-9)).min())
    inset = 0.5 * (np.array([WIDE, HIGH]) - scale * (high - low))

    def place(points: Array) -> Array:
        return np.asarray(inset + scale * (points - low))

    cells = low + (high - low) * _grid()
    numbers = -winding_numbers(outline, cells)
    values = [int(n) for n in np.unique(numbers) if n]
    patches = "".join(_patch(place(cells[numbers == n]), n, scale * (high - low)) for n in values)
    signs = "".join(_sign(place(cells[numbers == n]), n) for n in values)
    said = region_words(region, values)
    return (
        f'<svg viewBox="0 0 {WIDE:g} {HIGH:g}" role="img" aria-label="{html.escape(said)}" '
        'style="width:100%;max-width:460px;color:var(--jp-ui-font-color1,#1f2328)" '
        'font-size="13" fill="currentColor">'
        f'<clipPath id="l08"><path d="{_way(place(outline))}"/></clipPath>'
        f'<g clip-path="url(#l08)">{patches}</g>'
        f'<path d="{_way(place(outline))}" fill="none" stroke="currentColor" stroke-width="1.8"/>'
        f"{_axes(low, high, place)}{signs}</svg>"
    )


def _grid() -> Array:
    middle = (np.arange(CELLS) + 0.5) / CELLS
    return np.stack(np.meshgrid(middle, middle), axis=-1).reshape(-1, 2)


def _way(points: Array) -> str:
    return "M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in points) + "Z"


def _patch(centres: Array, n: int, size: Array) -> str:
    """Return the cells of one winding number; they overlap a little, and the outline cuts them."""
    wide, high = size / CELLS + 0.6
    cells = "".join(
        f"M{x - wide / 2:.1f},{y - high / 2:.1f}h{wide:.1f}v{high:.1f}h{-wide:.1f}z"
        for x, y in centres
    )
    strength = min(0.3 + 0.25 * (abs(n) - 1), 0.9)
    edge = f'stroke="{HUES[1 if n > 0 else -1]}" stroke-width="6"' if False else ""
    return f'<path d="{cells}" fill="{HUES[1 if n > 0 else -1]}" opacity="{strength:g}" {edge}/>'


def _sign(centres: Array, n: int) -> str:
    x, y = centres[np.hypot(*(centres - centres.mean(axis=0)).T).argmin()]
    return f'<text x="{x:.0f}" y="{y + 5:.0f}" text-anchor="middle">{n:+d}</text>'.replace("-", "−")


