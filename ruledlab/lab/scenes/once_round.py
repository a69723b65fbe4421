"""Lesson 08: once round a closed surface, in arrays, in drawings and in words."""

from __future__ import annotations

import functools
import html
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...geometry import (
    Closure,
    Dual,
    Enclosed,
    GeometryError,
    RuledSurface,
    Stepped,
    Trajectory,
    Turning,
    enclosed,
    named_number,
    steiner,
    stepped,
    trajectory,
    turning,
    winding_numbers,
)
from ...geometry.checks import Array
from ..axes import scientific
from ..overlay import Dot, Label, Overlay, Sheet, Stroke
from ..state import Lab

__all__ = [
    "LEGEND",
    "Path",
    "Ways",
    "numbers_html",
    "overlay_of",
    "path_of",
    "region_svg",
    "seam_html",
    "size_html",
    "total_of",
    "ways_of",
    "words_of",
]

EXACT = 5e-10
"""A flux that is off by less is right in every digit shown."""

JUMPING = 1e-6
"""Stokes' theorem fails by more than this only where ū or v̄ jumps."""

LEGEND = (
    ("delta", "the walk"),
    ("tau", "the gap l"),
    ("ink", "ξ at the start"),
    ("kappa", "ξ at the end, and the angle λ"),
    ("cursor", "ξ at t"),
    ("sigma", "striction curve"),
)
"""The colours of the picture, by the names of the palette."""

PLACES = 401
"""Places of t on the way round: the cursor's own, so that it stands on them."""


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


def total_of(surface: RuledSurface) -> Dual | None:
    """Return Λ by line integrals, or None where there is none."""
    return _or_reason(surface.dual_angle_of_pitch, [])


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
        m, size = scene.striction, 0.45 * scene.radius
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

WIDE, HIGH = 380.0, 280.0
MARGIN = np.array([[56.0, 14.0], [14.0, 30.0]])  # left, above; right, below
ROW = 2.0
HUES = {1: "#0072b2", -1: "#d55e00"}


def region_svg(region: Enclosed, frame: Array | None = None) -> str:
    """Return the enclosed region in the chart, shaded by how often it is encircled.

    As in the chart of the lab, v grows downwards: this is the sphere seen from outside, and
    anticlockwise is anticlockwise there. The loop ``frame`` is drawn with a dashed line, in the
    same scale: the picture shows how much smaller or larger this one is.
    """
    shown = region.outline if frame is None else np.concatenate([region.outline, frame])
    low, high = shown.min(axis=0), shown.max(axis=0)
    room = np.array([WIDE, HIGH]) - MARGIN.sum(axis=0)
    scale = float((room / np.maximum(high - low, 1e-9)).min())
    slack = np.array([0.5 * (room[0] - scale * (high - low)[0]), 0.0])
    start = MARGIN[0] + slack - scale * low
    tall = float((scale * (high - low) + MARGIN.sum(axis=0))[1])
    border = start + scale * region.outline
    spans, rounds = _spans(border)
    numbers = [int(n) for n in np.unique(rounds) if n]
    beside = "" if frame is None else " The dashed line is the loop at size 1."
    parts = [_patch(spans[rounds == n], n) for n in numbers]
    parts.append(f'<path d="{_way(border)}" fill="none" stroke="currentColor" stroke-width="1.8"/>')
    parts += [] if frame is None else [_dashed(start + scale * frame)]
    parts += [_sign(spans[rounds == n], n) for n in numbers]
    parts += [_tick(0, k, start, scale, tall) for k in _eighths(low[0], high[0])]
    parts += [_tick(1, k, start, scale, tall) for k in _eighths(low[1], high[1])]
    return (
        f'<svg viewBox="0 0 {WIDE:g} {tall:.0f}" role="img" fill="currentColor" font-size="13" '
        f'aria-label="{html.escape(region_words(region, numbers) + beside)}" '
        'style="width:100%;max-width:440px;color:var(--jp-ui-font-color1,#1f2328)">'
        f"{''.join(parts)}</svg>"
    )


def _spans(border: Array) -> tuple[Array, Array]:
    """Return rows (x from, x to, y) between crossings of the border, and how often it rounds each.

    With y downwards the numbers count anticlockwise as drawn with the other sign.
    """
    y = np.arange(0.5 * ROW, HIGH, ROW)[:, np.newaxis]
    following = np.roll(border, -1, axis=0)
    row, edge = np.nonzero((border[:, 1] <= y) != (following[:, 1] <= y))
    a, b = border[edge], following[edge]
    x = a[:, 0] + (b[:, 0] - a[:, 0]) * (y[row, 0] - a[:, 1]) / (b[:, 1] - a[:, 1])
    order = np.lexsort((x, row))
    x, row = x[order], row[order]
    same = row[1:] == row[:-1]
    spans = np.stack([x[:-1], x[1:], y[row[:-1], 0]], axis=1)[same]
    middles = np.stack([spans[:, :2].mean(axis=1), spans[:, 2]], axis=1)
    return spans, -winding_numbers(border, middles)


def _way(points: Array) -> str:
    return "M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in points) + "Z"


def _dashed(points: Array) -> str:
    line = 'fill="none" stroke="currentColor" stroke-dasharray="3 4" opacity="0.7"'
    return f'<path d="{_way(points)}" {line}/>'


def _patch(spans: Array, n: int) -> str:
    rows = "".join(f"M{a:.1f},{y - 0.5 * ROW:g}H{b:.1f}v{ROW:g}H{a:.1f}z" for a, b, y in spans)
    strength = min(0.28 + 0.25 * (abs(n) - 1), 0.9)
    hue = HUES[1 if n > 0 else -1]
    return f'<path d="{rows}" fill="{hue}" opacity="{strength:g}" shape-rendering="crispEdges"/>'


def _sign(spans: Array, n: int) -> str:
    """Return the number, written where the region is widest."""
    a, b, y = spans[(spans[:, 1] - spans[:, 0]).argmax()]
    text = f"{n:+d}".replace("-", "−")
    return f'<text x="{0.5 * (a + b):.0f}" y="{y + 5:.0f}" text-anchor="middle">{text}</text>'


def _eighths(low: float, high: float) -> range:
    """Return the multiples of π/8 (or π/2 on a long way) between two angles."""
    step = 1 if high - low < math.pi else 4
    unit = step * math.pi / 8
    first, last = math.ceil(low / unit - 1e-6), math.floor(high / unit + 1e-6)
    return range(step * first, step * last + 1, step)


def _tick(axis: int, k: int, start: Array, scale: float, tall: float) -> str:
    place = float(start[axis] + scale * k * math.pi / 8)
    text = f"{'uv'[axis]} = {named_number(k * math.pi / 8)}".replace("*", "").replace("pi", "π")
    at = f'x="{place:.0f}" y="{tall - 6:.0f}"' if axis == 0 else f'x="4" y="{place + 4:.0f}"'
    anchor = "middle" if axis == 0 else "start"
    return f'<text {at} text-anchor="{anchor}" font-size="11" opacity="0.75">{text}</text>'


def region_words(region: Enclosed, numbers: list[int]) -> str:
    """Return the region in words."""
    said = ", ".join(f"{n:+d}".replace("-", "−") for n in numbers) or "none"
    base = " Between the curve and the equator, as the curve goes round the axis."
    return (
        f"The enclosed region of the chart, encircled {said} times, anticlockwise from outside "
        f"counted positive.{base if region.winding else ''} Area A = {_shown(-region.area, 6)}, "
        f"flux of the divergence {_shown(-region.flux, 6)}."
    )


# -- the numbers -----------------------------------------------------------------------------------


def numbers_html(ways: Ways, path: Path) -> str:
    """Return λ and l side by side, with what the other ways differ by."""
    if ways.total is None:
        return _without(path)
    real, dual = float(ways.total.real), float(ways.total.dual)
    rows = [("line integral, −∮τ̂ dt", _shown(real, 9), _shown(dual, 9))]
    if (region := ways.region) is not None:
        pair = -region.tau_from_area, -region.tau_bar_from_flux
        about = _beside(pair[1], dual, region.off)
        rows.append(("area and flux", _beside(pair[0], real), about))
    if (steps := ways.steps) is not None:
        angle = "–" if region is None else _beside(region.corner - steps.bend, real)
        rows.append((f"in {steps.count} steps", angle, _beside(steps.shift, dual)))
    rows.append(("λ mod 2π", _shown(_modulo(real), 6), ""))
    if (d := ways.carried) is not None:
        rows.append(("X₂, carried along", "0", "0"))
        rows.append(("X₃, carried along", _shown(-d.real[2], 6), _shown(-d.dual[2], 6)))
    body = "".join(_row(*row) for row in rows)
    sign = "+" if dual >= 0 else "−"
    return (
        f"{_TABLE}<tr><td></td>{_heads('λ in rad', 'l, a length')}</tr>{body}</table>"
        f"<div>Λ = λ + ε l = {_shown(real, 6)} {sign} ε {abs(dual):.6f}</div>"
        f"{_region_note(ways.region)}{_doubts(ways)}"
    )


def _heads(*texts: str) -> str:
    return "".join(f'<th scope="col">{text}</th>' for text in texts)


def _row(name: str, *texts: str) -> str:
    cells = "".join(f"<td>{text}</td>" for text in texts)
    return f'<tr><th scope="row">{name}</th>{cells}</tr>'


def size_html(now: Dual | None, full: Dual | None) -> str:
    """Return l and λ modulo 2π of a loop beside those of the same loop at size 1."""
    rows = [("<i>l</i>", _parts(now)[1], _parts(full)[1], _figures)]
    rows.append(("<i>λ</i> mod 2π", _parts(now)[0], _parts(full)[0], _turned))
    body = "".join(
        f"<tr><td>{name}</td>{_cells('td', said(a), said(b), _ratio(a, b))}</tr>"
        for name, a, b, said in rows
    )
    widths = "".join(f'<col style="width:{part}%">' for part in (24, 30, 24, 22))
    return (
        '<table class="ruledlab-numbers" style="table-layout:fixed;width:100%;'
        'max-width:344px">'
        f"{widths}<tr><td></td>{_cells('th', 'now', 'at size 1', 'ratio')}</tr>{body}</table>"
    )


def _cells(kind: str, *texts: str) -> str:
    """Return cells of columns that keep their places, whatever the numbers."""
    weight = 400 if kind == "th" else 600
    style = f"text-align:right;padding:1px 0;white-space:nowrap;font-weight:{weight}"
    return "".join(f'<{kind} style="{style}">{text}</{kind}>' for text in texts)


def _parts(total: Dual | None) -> tuple[float, float]:
    """Return λ without its whole turns, from −π to π, and l; NaN where there is no Λ."""
    if total is None:
        return math.nan, math.nan
    return math.remainder(float(total.real), 2 * math.pi), float(total.dual)


def _ratio(a: float, b: float) -> str:
    """Return a/b where it says something: not of rounding errors, nor across a whole turn."""
    return _figures(a / b) if abs(b) > 1e-9 and a * b > 0.0 else "–"


def _figures(value: float) -> str:
    """Return a number with four significant figures; what is rounding only is 0."""
    if not math.isfinite(value):
        return "–"
    return f"{0.0 if abs(value) < 1e-9 else value:.4g}".replace("-", "−")


def _turned(angle: float) -> str:
    """Return an angle of −π to π as one of 0 to 2π."""
    return f"2π − {_figures(-angle)}" if angle < -1e-9 else _figures(angle)


def _doubts(ways: Ways) -> str:
    """Return which of the numbers are not what they should be, and why."""
    region, said = ways.region, ""
    if ways.total is None or region is None:
        return said
    if region.off > EXACT:
        said += (
            f" The flux is certain to {scientific(region.off, 1)} only: the divergence is very "
            "rough inside the region."
        )
    if abs(region.tau_bar_from_flux + float(ways.total.dual)) > region.off + JUMPING:
        said += (
            " The flux does not give l here: ū or v̄ jumps inside the region, and Stokes' theorem "
            "needs fields that do not."
        )
    return f'<div class="ruledlab-note" role="status">{said.strip()}</div>' if said else ""


def _modulo(angle: float) -> float:
    """Return an angle from 0 to 2π; rounding below 0 is 0."""
    return (angle + 1e-9) % (2 * math.pi) - 1e-9


def _without(path: Path) -> str:
    """Return what can be said of a way that does not lead back to the same oriented line."""
    along = "–" if path.walk is None else _shown(path.walk.gap, 6)
    about = "–" if path.turn is None else _shown(path.turn.gap, 6)
    return (
        f"{_TABLE}{_row('−∫⟨c′, x⟩ dt, first to last ruling', along)}"
        f"{_row('−∫τ dt, first to last ruling', about)}</table>"
        '<div class="ruledlab-note">These are no pitch and no angle of pitch: the way does not '
        "lead back to the same oriented line.</div>"
    )


_TABLE = '<table class="ruledlab-numbers ruledlab-ways">'


def _region_note(region: Enclosed | None) -> str:
    if region is None:
        return ""
    corner = f" {_signed(region.corner)}" if region.corner else ""
    border = f" {_signed(-region.border)}" if region.winding else ""
    turns = f"{-region.turns:d}" if region.turns <= 0 else f"(−{region.turns:d})"
    return (
        f'<div class="ruledlab-note">λ = A − 2π·{turns}{corner}, A = {_shown(-region.area, 6)}'
        f"{', with the corner at the seam' if corner else ''}; l = flux{border}, flux = "
        f"{_shown(-region.flux, 6)}{', with the border' if border else ''}.</div>"
    )


def _signed(value: float) -> str:
    return f"{'+' if value >= 0 else '−'} {_shown(abs(value), 4)}"


def seam_html(lab: Lab) -> str:
    """Return what jumps at the seam, or why there is none."""
    state = lab.result.closure
    said = html.escape(state.reason.replace("not closed:", "does not close:", 1))
    if state.order < 0:
        return f'<div class="ruledlab-note" role="status">The surface {said}.</div>'
    rows = "".join(
        _row(name, _jump(k, 0, state), _jump(k, 1, state))
        for k, name in enumerate(("X", "X′", "X″"))
    )
    return (
        f"{_TABLE}<tr>{_heads('jump at the seam', 'direction', 'moment')}</tr>{rows}"
        f'</table><div class="ruledlab-note" role="status">The surface {said}.</div>'
    )


def _jump(k: int, part: int, state: Closure) -> str:
    if k <= state.order:
        return "none"
    size = float(state.gaps[k, part])
    return f"{size:.4g}" if math.isfinite(size) else "undefined"


def _shown(value: float, digits: int) -> str:
    """Return a number with so many decimals, and no sign before a zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}".replace("-", "−")


def _beside(value: float, first: float, off: float = 0.0) -> str:
    """Return a number with its difference from the first way's; no digit that is not certain."""
    digits = 9 if off <= EXACT else max(0, math.ceil(-math.log10(off)))
    apart = f"differs by {scientific(value - first, 1)}" if value != first else "no difference"
    about = "" if off <= EXACT else f" ± {scientific(off, 1)}"
    return f"{_shown(value, digits)}{about}<br><small>{apart}</small>"


def words_of(lab: Lab, path: Path) -> str:
    """Return the picture in words."""
    said = [lab.result.scene.text]
    if path.walk is not None:
        back = "comes back to its ruling" if lab.result.closure.oriented else "has gone"
        said.append(f"The orthogonal trajectory {back} {path.walk.gap:+.4f} along the ruling.")
    if path.turn is not None:
        said.append(f"The vector ξ has turned by {path.turn.gap:+.4f} rad against the frame.")
    return " ".join(said)
