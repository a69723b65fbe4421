"""One ruling and how the surface bends along it: numbers, pictures and words, without widgets."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...geometry import RuledSurface, TangentPlanes, tangent_planes
from ...geometry.checks import Array
from ..axes import Limits
from ..flat import Flat
from ..markup import numbers_table
from ..overlay import Dot, Label, Overlay, Sheet, Stroke
from ..palette import DARK, LIGHT, Theme

__all__ = [
    "STYLE",
    "Bend",
    "bend",
    "curvatures",
    "flat",
    "forms",
    "graph",
    "in_space",
    "lacking",
    "spots",
    "words",
]

FAN: Final = 7
"""Tangent planes along the ruling, when they are shown."""

FINE: Final = 61
"""Places at which the graph is computed."""


@dataclass(frozen=True, eq=False, slots=True)
class Bend:
    """A ruling, its tangent planes, and which of them is looked at.

    Attributes
    ----------
    w
        (1 + FAN + FINE,) the place looked at, those of the fan, those of the graph.
    planes
        the tangent planes at ``w``.
    ruling, striction
        direction and striction point.
    delta
        the distribution parameter.
    half
        how far the ruling is drawn to either side.
    """

    w: Array
    planes: TangentPlanes
    ruling: Array
    striction: Array
    delta: float
    half: float

    @property
    def reason(self) -> str:
        """Why there is no tangent plane in the place looked at; empty if there is one."""
        return next((r.reason for r in self.planes.undefined if r.where[0]), "")

    @property
    def graph(self) -> slice:
        """The places of the graph."""
        return slice(1 + FAN, None)


def bend(surface: RuledSurface, t: float, w: float, length: float) -> Bend:
    """Ask geometry for all that is drawn and said of the point (t, w)."""
    half = max(0.5 * length, abs(w))
    delta = float(surface.invariants(t).delta)
    # K has a peak as wide as δ: places that are even in θ show it, however narrow it is
    steep = abs(delta) if abs(delta) > 1e-9 else half
    end = math.atan(half / steep) if math.isfinite(delta) else 1.0
    fine = np.tan(np.linspace(-end, end, FINE)) * (steep if math.isfinite(delta) else half)
    places = np.concatenate([[w], np.linspace(-0.5, 0.5, FAN) * length, fine])
    planes = tangent_planes(surface, t, places)
    return Bend(places, planes, surface.line(t).direction, surface.striction(t), delta, half)


# ---- pictures -----------------------------------------------------------------------------------


def in_space(good: Bend, now: Bend, size: float, fan: bool) -> Overlay:
    """Return what is drawn into space; ``good`` is the last point that had a tangent plane."""
    planes, x = good.planes, good.ruling
    p, n, second = planes.point[0], planes.normal[0], planes.asymptotic[0]
    ends = [now.striction - now.half * now.ruling, now.striction + now.half * now.ruling]
    strokes = [
        Stroke(np.array(ends), "cursor", 3.5, name="ruling, the first asymptotic direction"),
        Stroke(np.array([p - size * second, p + size * second]), "tau", 3.5, name="asymptotic"),
        Stroke(np.array([p, p + size * n]), "delta", 3.0, arrow=True, name="normal"),
    ]
    sheets = [_plane(p, x, n, size, "delta", "tangent plane")]
    if fan:
        chosen = slice(1, 1 + FAN)
        for point, normal in zip(planes.point[chosen], planes.normal[chosen], strict=True):
            sheets.append(_plane(point, x, normal, 0.4 * size, "kappa", "fan"))
            ends = [point, point + 0.5 * size * normal]
            strokes.append(Stroke(np.array(ends), "kappa", 1.8, arrow=True, name="fan"))
    here = Dot(now.planes.point[0], "cursor", 12, ring=bool(now.reason), name="point")
    dots = (Dot(now.striction, "sigma", 10, name="striction point"), here)
    labels = (Label(p + size * n, "n", "delta"), Label(now.striction, "m", "sigma"))
    return Overlay(tuple(strokes), dots, tuple(sheets), labels)


def _plane(p: Array, x: Array, n: Array, size: float, colour: str, name: str) -> Sheet:
    """Return a square of the plane through p with the normal n; one side is along x."""
    across = np.cross(n, x)
    corners = [[p + size * (i * x + j * across) for j in (-1, 1)] for i in (-1, 1)]
    return Sheet(np.array(corners), colour, 0.5, name)


WIDE, HIGH, LEFT, END, GAP, HEAD = 440, 112, 58, 14, 30, 18
"""Width, height of a panel with its heading, room left and right, between panels, of a heading."""

_COLOURS: Final = {"turn": "delta", "gauss": "kappa", "mean": "tau", "now": "cursor"}

DARK_PAGE: Final = 'body[data-jp-theme-light="false"] '


def _rules(theme: Theme, before: str = "") -> str:
    return "".join(
        f"{before}.ruledlab-bend .{part}{{color:{theme.quantity(name)}}}"
        for part, name in _COLOURS.items()
    )


STYLE: Final = (
    "<style>.ruledlab-bend{display:block;width:100%;max-width:520px;font-size:12px;"
    "color:var(--jp-ui-font-color1,#1f2328)}.ruledlab-bend text{fill:currentColor}"
    f"{_rules(LIGHT)}{_rules(DARK, DARK_PAGE)}"
    ".ruledlab .ruledlab-bends{display:grid;gap:0 14px;align-items:start;"
    "grid-template:'look graph' auto 'forms graph' 1fr/minmax(0,6fr) minmax(0,5fr)}"
    ".ruledlab-bends>:nth-child(1){grid-area:look}.ruledlab-bends>:nth-child(2){grid-area:graph}"
    ".ruledlab-bends>:nth-child(3){grid-area:forms}"
    "@container (max-width:760px){.ruledlab .ruledlab-bends{"
    "grid-template:'look' auto 'graph' auto 'forms' auto/minmax(0,1fr)}}"
    ".ruledlab .ruledlab-bends .ruledlab-numbers td:first-child{width:13.5em}</style>"
)
"""Where the parts stand, and the colours of `graph` on a light and on a dark page."""


@dataclass(frozen=True, eq=False, slots=True)
class _Panel:
    """One curve over w: where it begins, its name in the style, heading, heights, marks, ends."""

    top: float
    kind: str
    title: str
    y: Array
    marks: tuple[str, str, str]
    low: float
    high: float


def _panels(found: Bend) -> tuple[_Panel, ...]:
    planes, part = found.planes, found.graph
    deep, wide = _size(planes.gauss[part]), _size(planes.mean[part])
    return (
        _Panel(0, "turn", "θ, turn of the tangent plane", np.degrees(planes.turn),
               ("90°", "0", "−90°"), -90.0, 90.0),
        _Panel(HIGH + GAP, "gauss", "K, Gauss curvature", planes.gauss,
               ("0", "", _said(-deep)), -deep, 0.0),
        _Panel(2 * (HIGH + GAP), "mean", "H, mean curvature", planes.mean,
               (_said(wide), "0", _said(-wide)), -wide, wide),
    )  # fmt: skip


FOOT: Final = 3 * HIGH + 2 * GAP
"""Where the axis of w is in the picture."""

TALL: Final = FOOT + 34
"""The height of the picture."""


def flat(found: Bend) -> Flat:
    """Return where a w is in the picture; heights there are those of the drawing, downwards."""
    area, across = (WIDE - LEFT - END, TALL), Limits(-found.half, found.half)
    return Flat((WIDE, TALL), (LEFT, 0.0), area, across, Limits(-TALL, 0.0))


def spots(found: Bend) -> tuple[tuple[str, Array], ...]:
    """Return the points of the present w as `flat` has them, each with its curve's symbol."""
    heights = ((panel.title[0], _height(panel, found)) for panel in _panels(found))
    return tuple(
        (symbol, np.array([found.w[0], -height, 0.0]))
        for symbol, height in heights
        if height is not None
    )


def graph(found: Bend) -> str:
    """Return θ, K and H along the ruling as an SVG picture, with the present w marked."""
    drawn = "".join(_drawn(panel, found) for panel in _panels(found))
    x = _across(found.w[0] / found.half)
    line = (
        f'<path class="now" d="M{x:.1f} {HEAD}V{FOOT}" stroke="currentColor" '
        'stroke-dasharray="3 3"/>'
    )
    label = html.escape(_graph_words(found), quote=True)
    return (
        f'<svg class="ruledlab-bend" viewBox="0 0 {WIDE} {TALL}" role="img" '
        f'aria-label="{label}">{line}{drawn}{_ticks(found)}{_empty(found)}</svg>'
    )


def _empty(found: Bend) -> str:
    """Return what stands in the middle of a picture without curves."""
    if math.isfinite(found.delta):
        return ""
    x, y = 0.5 * (LEFT + WIDE - END), 0.5 * FOOT
    return f'<text x="{x}" y="{y}" text-anchor="middle">no tangent planes on this ruling</text>'


def _size(values: Array) -> float:
    """Return how far an axis goes; rounding errors are not blown up."""
    largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
    return largest if largest > 1e-9 else 1.0


def _across(w: float) -> float:
    """Return where a w from −1 to 1 stands in the picture."""
    return LEFT + 0.5 * (w + 1.0) * (WIDE - LEFT - END)


def _down(panel: _Panel, y: float) -> float:
    """Return where a height stands in its panel."""
    return panel.top + HEAD + (panel.high - y) / (panel.high - panel.low) * (HIGH - HEAD)


def _drawn(panel: _Panel, found: Bend) -> str:
    top = panel.top
    heights = [top + HEAD, top + 0.5 * (HEAD + HIGH), top + HIGH]
    rules = "".join(
        f'<path d="M{LEFT} {height}H{WIDE - END}" stroke="currentColor" opacity="0.3"/>'
        f'<text x="{LEFT - 6}" y="{height + 4}" text-anchor="end">{mark}</text>'
        for height, mark in zip(heights, panel.marks, strict=True)
        if mark
    )
    return (
        f'{rules}<text class="{panel.kind}" x="{LEFT}" y="{top + 11}" font-weight="600">'
        f'{panel.title}</text><path class="{panel.kind}" d="{_path(panel, found)}" '
        'fill="none" stroke="currentColor" stroke-width="2.5" stroke-linejoin="round"/>'
        f"{_spot(panel, found)}"
    )


def _path(panel: _Panel, found: Bend) -> str:
    """Return a curve as the data of a path, with a gap where a height is undefined."""
    pen, parts = "M", []
    for w, y in zip(found.w[found.graph] / found.half, panel.y[found.graph], strict=True):
        if not math.isfinite(y):
            pen = "M"
            continue
        parts.append(f"{pen}{_across(w):.1f} {_down(panel, y):.1f}")
        pen = "L"
    return "".join(parts)


def _height(panel: _Panel, found: Bend) -> float | None:
    """Return where the value at the present w stands, if there is one."""
    y = float(panel.y[0])
    if found.reason or not math.isfinite(y):
        return None
    # between two places of the graph a curve may be a little higher than what is drawn of it
    return _down(panel, min(max(y, panel.low), panel.high))


def _spot(panel: _Panel, found: Bend) -> str:
    """Return the point of the present w, where there is one."""
    height = _height(panel, found)
    if height is None:
        return ""
    x = _across(found.w[0] / found.half)
    return f'<circle class="now" cx="{x:.1f}" cy="{height:.1f}" r="5" fill="currentColor"/>'


def _ticks(found: Bend) -> str:
    half, delta = found.half, abs(found.delta)
    said = [(-half, _said(-half)), (0.0, "0"), (half, _said(half))]
    if 0.12 * half < delta < 0.88 * half:
        said += [(-delta, "−|δ|"), (delta, "|δ|")]
    marks = "".join(
        f'<path d="M{_across(w / half):.1f} {HEAD}V{FOOT}" stroke="currentColor" opacity="0.18"/>'
        f'<text x="{_across(w / half):.1f}" y="{FOOT + 16}" text-anchor="middle">{text}</text>'
        for w, text in said
    )
    return f'{marks}<text x="{WIDE}" y="{FOOT + 30}" text-anchor="end">w, length</text>'


def _graph_words(found: Bend) -> str:
    if not math.isfinite(found.delta):
        return f"Along this ruling there are no tangent planes: {found.reason}."
    if abs(found.delta) < 1e-9:
        return (
            "Along this torsal ruling, δ = 0, the tangent plane does not turn and K is 0; at w = 0 "
            f"there is no tangent plane. At w = {_said(found.w[0])} H is "
            f"{_said(found.planes.mean[0])}."
        )
    end = math.degrees(float(found.planes.turn[-1]))
    return (
        f"Along the ruling θ goes from {_said(-end)} to {_said(end)} degrees and is 0 at w = 0; "
        f"K is {_said(-1 / found.delta**2)} at w = 0 and comes nearer to 0 on both sides. "
        f"At w = {_said(found.w[0])}, θ is "
        f"{_said(math.degrees(found.planes.turn[0]))} degrees, K is "
        f"{_said(found.planes.gauss[0])} and H is {_said(found.planes.mean[0])}."
    )


# ---- numbers to read ----------------------------------------------------------------------------


def _said(value: float) -> str:
    if not math.isfinite(value):
        return "–"
    value = 0.0 if abs(value) < 5e-13 else float(value)
    return f"{value:.4g}".replace("-", "−")


def _table(rows: Sequence[tuple[str, str, float, str]]) -> str:
    return numbers_table((name, symbol, _said(value), unit) for name, symbol, value, unit in rows)


def curvatures(found: Bend) -> str:
    """Return what bends and turns at the point, as a table."""
    p = found.planes
    return _table(
        [
            ("distribution parameter", "δ", found.delta, "length"),
            ("turn of the plane", "θ", float(p.turn[0]), "rad"),
            ("Gauss curvature", "K", float(p.gauss[0]), "1/length²"),
            ("mean curvature", "H", float(p.mean[0]), "1/length"),
            ("principal curvature", "k₁", float(p.principal[0, 0]), "1/length"),
            ("principal curvature", "k₂", float(p.principal[0, 1]), "1/length"),
            ("asymptotic angle", "α", float(p.angle[0]), "rad"),
        ]
    )


def forms(found: Bend) -> str:
    """Return both fundamental forms at the point, as a table."""
    units = {"g11": "length² per t²", "g12": "length per t", "g22": "(a number)"}
    units |= {"h11": "length per t²", "h12": "1 per t", "h22": "1/length"}
    digits = str.maketrans("12", "₁₂")
    return _table(
        [
            (
                "first form" if name[0] == "g" else "second form",
                name.translate(digits),
                float(getattr(found.planes.forms, name)[0]),
                unit,
            )
            for name, unit in units.items()
        ]
    )


def lacking(found: Bend) -> str | None:
    """Return why there is no tangent plane in the place looked at, in one line; None if there is.

    The line is short on a torsal ruling, where it comes and goes as w runs.
    """
    if not found.reason:
        return None
    torsal = math.isfinite(found.delta)
    why = "the striction point of a torsal ruling" if torsal else found.reason
    return f"There is no tangent plane here: {why}."


def words(t: float, found: Bend) -> str:
    """Return the picture in space in words."""
    place = f"The ruling at t = {_said(t)} is golden, its striction point m green."
    if found.reason:
        return f"{place} At w = {_said(found.w[0])} there is no tangent plane: {found.reason}."
    p = found.planes
    return (
        f"{place} At w = {_said(found.w[0])} the tangent plane, purple, has turned by "
        f"{_said(math.degrees(p.turn[0]))} degrees from that at m. The second asymptotic "
        f"direction, orange, makes {_said(math.degrees(p.angle[0]))} degrees with the ruling. "
        f"K = {_said(p.gauss[0])}, H = {_said(p.mean[0])}."
    )
