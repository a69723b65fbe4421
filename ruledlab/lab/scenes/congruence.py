"""A congruence around one design, as plain arrays to draw and in words: no widgets here."""

from __future__ import annotations

import html
import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from ...geometry import (
    Congruence,
    GeometryError,
    RuledSurface,
    developable_from_ubar,
    enclosed,
    tangent_developable,
)
from ...geometry.checks import Array
from ..overlay import Dot, Label, Overlay, Stroke
from ..palette import DARK, LIGHT, Theme
from ..scene import Mark, Scene

__all__ = [
    "LOOKS",
    "MAP_NOTE",
    "STYLE",
    "Enclosure",
    "Lines",
    "Place",
    "chart_map",
    "counts_words",
    "enclosure",
    "highlighted",
    "legend_html",
    "lines",
    "numbers_html",
    "place",
    "place_words",
    "sight",
    "straightened",
    "straightened_words",
    "strip",
    "window",
]

FINE: Final = 25
"""Places each way at which the focal surfaces are drawn."""

REACH: Final = 4.0
"""Nothing is drawn farther from the middle than this many lengths of a line."""

NARROWEST: Final = 1.4
OFF_POLES: Final = 0.3
LOOKS: Final = {"hyperbolic": "kappa", "parabolic": "delta", "elliptic": "tau"}
MEETS: Final = {
    "hyperbolic": "neighbouring lines meet it in two focal points",
    "parabolic": "its two focal points coincide",
    "elliptic": "no neighbouring line meets it, so it has no real focal point",
    "undefined": "there is no line: a pole of the chart, or the formulas have no value",
}


@dataclass(frozen=True, eq=False, slots=True)
class Lines:
    """The grid of lines over a window of the chart.

    Attributes
    ----------
    strokes
        one for each kind that occurs.
    counts
        kind to how many lines of the grid are of it.
    focal
        the two focal surfaces, each (N, N, 3) with NaN where there is none near.
    ends
        (2, 2) the window: where the grid begins and ends in u and in v.
    kinds, divergence
        (count, count) of the lines of the grid, u along the first axis.
    """

    strokes: tuple[Stroke, ...]
    counts: dict[str, int]
    focal: tuple[Array, Array]
    ends: Array
    kinds: npt.NDArray[np.str_]
    divergence: Array


def window(chart: Array) -> Array:
    """Return (2, 2) where the grid begins and ends in u and in v: somewhat more than the curve.

    It keeps off the poles as far as the curve does: near them lines may be anywhere.
    """
    known = chart[np.isfinite(chart).all(axis=1)]
    middle, size = 0.5 * (known.min(axis=0) + known.max(axis=0)), np.ptp(known, axis=0)
    half = 0.5 * np.maximum(1.3 * size, NARROWEST)
    half[0] = min(half[0], math.pi)
    ends = np.stack([middle - half, middle + half], axis=1)
    low, high = known[:, 1].min(), known[:, 1].max()
    if low >= 0.0 and high <= math.pi:
        ends[1] = np.clip(ends[1], min(low, OFF_POLES), max(high, math.pi - OFF_POLES))
    return ends


def lines(congruence: Congruence, scene: Scene, count: int) -> Lines:
    """Return ``count`` × ``count`` lines about a scene, each drawn about its focal midpoint."""
    ends, length = window(scene.chart), float(np.ptp(scene.w))
    far = REACH * length
    u, v = _grid(ends, count)
    x, focal = congruence.line(u, v), congruence.focal(u, v)
    along = focal.midpoint[:, None] + length * np.array([-0.5, 0.5])
    pieces = x.foot[:, None] + along[..., None] * x.direction[:, None]
    pieces[np.linalg.norm(pieces - scene.centre, axis=-1).max(axis=1) > far] = np.nan
    pieces = np.concatenate([pieces, np.full((len(pieces), 1, 3), np.nan)], axis=1)
    counts = {kind: int((focal.kind == kind).sum()) for kind in (*LOOKS, "undefined")}
    strokes = tuple(
        Stroke(pieces[focal.kind == kind].reshape(-1, 3), LOOKS[kind], 1.3, kind == "elliptic",
               name=kind)
        for kind in LOOKS if counts[kind]
    )  # fmt: skip
    net = congruence.focal(*_grid(ends, FINE)).points
    net = np.where(np.linalg.norm(net - scene.centre, axis=-1)[..., None] > far, np.nan, net)
    first, second = (net[:, k].reshape(FINE, FINE, 3) for k in range(2))
    square = (count, count)
    divergence = congruence.divergence(u, v).reshape(square)
    return Lines(strokes, counts, (first, second), ends, focal.kind.reshape(square), divergence)


# -- the grid in the chart -------------------------------------------------------------------------

WIDE, LEFT, FOOT, EDGE = 360.0, 36.0, 22.0, 10.0
"""Width of the map, room for numbers at its left and foot, and about the window; in pixels."""

CELLS, SHADES = 16, 6
"""Cells of the shading each way, and how many shades there are."""

DARK_PAGE: Final = 'body[data-jp-theme-light="false"] '


def _hues(theme: Theme, before: str = "") -> str:
    return "".join(
        f"{before}.ruledlab-map .{kind}{{color:{getattr(theme, look)}}}"
        for kind, look in LOOKS.items()
    )


STYLE: Final = (
    "<style>.ruledlab-map{display:block;width:100%;max-width:420px;font-size:11px;"
    "color:var(--jp-ui-font-color1,#1f2328)}.ruledlab-map text{fill:currentColor}"
    f"{_hues(LIGHT)}{_hues(DARK, DARK_PAGE)}</style>"
)
"""The colours of `chart_map` on a light and on a dark page."""


def chart_map(congruence: Congruence, found: Lines, chart: Array) -> str:
    """Return the grid over the chart, the divergence and the curve, as an SVG picture.

    Each sign stands for one line of the grid. Its colour says the kind of the line, the sign that
    of the divergence there, and the shade below it how large the divergence is.
    """
    size = np.ptp(found.ends, axis=1)
    wide = WIDE - LEFT - 2.0 * EDGE
    high = float(np.clip(wide * size[1] / size[0], 150.0, 280.0))
    scale = np.array([wide, high]) / size
    shift = np.array([LEFT + EDGE, EDGE]) - scale * found.ends[:, 0]
    way = _way(shift + scale * chart)
    parts = [
        _shading(congruence, found.ends, scale, shift),
        _frame(found.ends, wide, high),
        f'<path d="{way}" fill="none" stroke="currentColor" stroke-width="2"/>',
        _signs(found, scale, shift),
    ]
    return (
        f'<svg class="ruledlab-map" viewBox="0 0 {WIDE:g} {high + 2 * EDGE + FOOT:.0f}" role="img" '
        f'aria-label="{html.escape(_map_words(found), quote=True)}">{"".join(parts)}</svg>'
    )


def _way(points: Array) -> str:
    """Return points as the data of a path, with a gap where one is undefined."""
    pen, parts = "M", []
    for x, y in points:
        if not (math.isfinite(x) and math.isfinite(y)):
            pen = "M"
            continue
        parts.append(f"{pen}{x:.1f} {y:.1f}")
        pen = "L"
    return "".join(parts)


def _shading(congruence: Congruence, ends: Array, scale: Array, shift: Array) -> str:
    """Return layers of shade, more of them where the divergence is larger in size."""
    step = np.ptp(ends, axis=1) / CELLS
    u, v = (ends[i, 0] + step[i] * (np.arange(CELLS) + 0.5) for i in range(2))
    value = np.abs(congruence.divergence(u[:, None], v))
    known = value[np.isfinite(value)]
    most = float(np.quantile(known, 0.95)) if known.size else 0.0
    if most < 1e-9:
        return ""
    shade = np.nan_to_num(np.ceil(SHADES * np.clip(value / most, 0.0, 1.0) - 1e-9)).astype(int)
    wide, high = scale * step + 0.4  # a little over the neighbour, or a seam would be seen
    layers = []
    for number in range(1, SHADES + 1):
        i, j = np.nonzero(shade >= number)
        corners = shift + scale * (ends[:, 0] + step * np.column_stack([i, j]))
        cells = "".join(f"M{x:.1f} {y:.1f}h{wide:.1f}v{high:.1f}h-{wide:.1f}z" for x, y in corners)
        layers.append(f'<path d="{cells}" fill="currentColor" opacity="0.055"/>')
    return "".join(layers)


def _frame(ends: Array, wide: float, high: float) -> str:
    """Return the border about the window, with the window's ends as numbers."""
    left, right, foot = LEFT + EDGE, LEFT + EDGE + wide, EDGE + high
    below, beside = foot + EDGE + 15.0, LEFT - 4.0
    first, last, top, bottom = (_short(value) for value in ends.ravel())
    middle = 'text-anchor="middle"'
    return (
        f'<path d="M{LEFT:g} 0.5H{right + EDGE - 0.5:g}V{foot + EDGE:.1f}H{LEFT:g}z" fill="none" '
        'stroke="currentColor" opacity="0.35"/>'
        f'<text x="{LEFT:g}" y="{below:.1f}">{first}</text>'
        f'<text x="{0.5 * (left + right):g}" y="{below:.1f}" {middle}>longitude '
        '<tspan font-style="italic">u</tspan></text>'
        f'<text x="{right + EDGE:g}" y="{below:.1f}" text-anchor="end">{last}</text>'
        f'<text x="{beside:g}" y="{EDGE + 4:g}" text-anchor="end">{top}</text>'
        f'<text x="{beside:g}" y="{EDGE + 0.5 * high + 4:.1f}" text-anchor="end" '
        'font-style="italic">v</text>'
        f'<text x="{beside:g}" y="{foot + 4:.1f}" text-anchor="end">{bottom}</text>'
    )


def _short(value: float) -> str:
    return f"{value:.2f}".replace("-0.00", "0.00").replace("-", "−")


def _signs(found: Lines, scale: Array, shift: Array) -> str:
    """Return one sign for each line of the grid: +, − or 0 in the colour of its kind."""
    u, v = (x.reshape(found.kinds.shape) for x in _grid(found.ends, len(found.kinds)))
    x, y = shift[0] + scale[0] * u, shift[1] + scale[1] * v
    size = min(18.0, 0.8 * min(float(x[1, 0] - x[0, 0]), float(y[0, 1] - y[0, 0])))
    signs = _sign_of(found.divergence)
    parts = []
    for kind in LOOKS:
        there = np.nonzero(found.kinds == kind)
        places = zip(x[there], y[there] + 0.36 * size, signs[there], strict=True)
        marks = "".join(f'<text x="{a:.1f}" y="{b:.1f}">{sign}</text>' for a, b, sign in places)
        look = f'font-size="{size:.1f}" font-weight="700" text-anchor="middle"'
        parts.append(f'<g class="{kind}" {look}>{marks}</g>' if marks else "")
    return "".join(parts)


def _sign_of(divergence: Array) -> npt.NDArray[np.str_]:
    """Return the signs; what rounding leaves of 0 has none."""
    most = max(float(np.abs(np.nan_to_num(divergence)).max(initial=0.0)), 1.0)
    found = np.where(np.abs(divergence) <= 1e-9 * most, 0.0, np.sign(np.nan_to_num(divergence)))
    signs: npt.NDArray[np.str_] = np.array(["−", "0", "+"])[found.astype(int) + 1]
    return signs


def _map_words(found: Lines) -> str:
    known = found.divergence[np.isfinite(found.divergence)]
    if not known.size:
        return f"The chart around the curve: {counts_words(found.counts)}. No divergence here."
    low, high = _said(known.min()), _said(known.max())
    return (
        f"The chart around the curve, with one sign for each line of the grid: "
        f"{counts_words(found.counts)}. The divergence lies between {low} and {high}."
    )


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


# -- the view --------------------------------------------------------------------------------------


def sight(found: Lines, scene: Scene) -> tuple[Array, float]:
    """Return centre and radius of a ball about most of the lines and of the surface."""
    rulings = scene.base[:, None] + scene.w[:, None] * scene.direction[:, None]
    points = [stroke.points for stroke in found.strokes] + [rulings.reshape(-1, 3)]
    ends = np.concatenate([part[np.isfinite(part).all(axis=1)] for part in points])
    if not len(ends):
        return np.asarray(scene.centre), float(scene.radius)
    centre = 0.5 * np.percentile(ends, [3.0, 97.0], axis=0).sum(axis=0)
    return centre, float(np.percentile(np.linalg.norm(ends - centre, axis=1), 95.0))


def _grid(ends: Array, count: int) -> tuple[Array, Array]:
    u, v = np.meshgrid(*(np.linspace(*pair, count) for pair in ends), indexing="ij")
    return u.ravel(), v.ravel()


@dataclass(frozen=True, eq=False, slots=True)
class Place:
    """One line of the congruence and what its neighbours do.

    Attributes
    ----------
    u, v
        the place in the chart.
    kind
        as `Focal.kind`.
    foot, direction
        (3,) of the line; NaN where there is none.
    w, points
        (2,) and (2, 3) the focal points, w from the foot; NaN where they are not real.
    parameters
        (2,) the least and greatest δ of all surfaces of the congruence here.
    divergence
        ū_u + v̄_v + v̄ cot v.
    """

    u: float
    v: float
    kind: str
    foot: Array
    direction: Array
    w: Array
    points: Array
    midpoint: float
    parameters: Array
    divergence: float

    def mark(self, mark: Mark) -> Mark:
        """Return the cursor moved here, for the views."""
        frame = np.full((3, 3), np.nan)
        frame[0] = self.direction
        at = {"base": self.foot, "striction": self.foot, "frame": frame}
        return replace(mark, chart=np.array([self.u, self.v]), **at)


def place(congruence: Congruence, u: float, v: float) -> Place:
    """Return the line of one place of the chart."""
    line, focal = congruence.line(u, v), congruence.focal(u, v)
    return Place(
        u, v, str(focal.kind), line.foot, line.direction, focal.w, focal.points,
        float(focal.midpoint), congruence.parameters(u, v), float(congruence.divergence(u, v)),
    )  # fmt: skip


def highlighted(at: Place, scene: Scene) -> Overlay:
    """Return the line of a place as far as its focal points, with these."""
    length = float(np.ptp(scene.w))
    near = np.linalg.norm(at.points - scene.centre, axis=-1) <= REACH * length
    ends = [at.midpoint - 0.5 * length, at.midpoint + 0.5 * length, *at.w[near]]
    along = np.array([min(ends), max(ends)]) + 0.15 * length * np.array([-1.0, 1.0])
    names = ("F₁", "F₂") if at.kind == "hyperbolic" else ("F₁ = F₂",)
    seen = [(p, name) for p, name, ok in zip(at.points, names, near, strict=False) if ok]
    return Overlay(
        strokes=(Stroke(at.foot + along[:, None] * at.direction, "cursor", 4.0, name="line"),),
        dots=tuple(Dot(point, "chosen", 12.0, name=name) for point, name in seen),
        labels=tuple(Label(point, name, "ink") for point, name in seen),
    )


def place_words(at: Place) -> str:
    """Say what kind of line this is."""
    where = f"At u = {at.u:.4g}, v = {at.v:.4g}"
    if at.kind == "undefined":
        return f"{where} {MEETS[at.kind]}."
    return f"{where} the congruence is {at.kind}: {MEETS[at.kind]}."


def counts_words(counts: dict[str, int]) -> str:
    """Say how many lines of the grid are of which kind."""
    found = [f"{count} {kind}" for kind, count in counts.items() if count]
    return f"{sum(counts.values())} lines over the chart around the curve: {', '.join(found)}"


def straightened(surface: RuledSurface, ubar: str) -> tuple[RuledSurface, str]:
    """Return a developable surface with the same directions, and how it was found."""
    first = surface.curve.series(np.array(surface.domain[0]), 0).value
    try:
        with np.errstate(all="ignore"):
            start = float(surface.vbar(*first))
        made = developable_from_ubar(surface.curve, ubar, start)
        now = made.vbar(np.linspace(*surface.domain, 201))
    except GeometryError as error:
        why = (*str(error).replace("`", "").split("; "), "")[1].removeprefix("got ")
        return tangent_developable(surface.curve), (
            f"Keeping ū does not work here ({why}), so these are the tangents of a curve m with "
            "m′ = x, which have the same directions."
        )
    return made.surface, f"ū stays, and v̄ along the curve follows from κ̄ = 0: {_course(now, start)}"


def _course(vbar: Array, start: float) -> str:
    """Say where the new v̄ begins, whether that is the old first value, and how far it goes."""
    low, high, begins, was = (_said(x) for x in (vbar.min(), vbar.max(), vbar[0], start))
    kept = math.isclose(vbar[0], start, rel_tol=1e-6, abs_tol=1e-9)
    ends = f"it is {low} throughout" if low == high else f"it runs from {low} to {high}"
    if kept:
        return f"it begins with {begins} as before, and {ends}."
    return (
        f"on a parallel its first value is not free: it begins with {begins} and not {was}; {ends}."
    )


def _said(value: float) -> str:
    value = 0.0 if abs(value) < 5e-12 else float(value)
    return f"{value:.4g}".replace("-", "−")


def straightened_words(before: RuledSurface, after: RuledSurface, how: str) -> str:
    """State κ̄ before and after, and whether the new surface closes."""
    was, now = _greatest(before), _greatest(after)
    size = max(was, 1.0)
    said = "0 to rounding" if now < 1e-7 * size else f"{now:.3g}"
    closes = "closes" if after.closure().closed else "does not close"
    was_closed = "closed" if before.closure().closed else "open"
    return (
        f"The greatest |κ̄| was {was:.4g}; now it is {said}: the green strip is developable. {how} "
        f"The surface was {was_closed}; the developable one {closes}."
    )


def _greatest(surface: RuledSurface) -> float:
    found = np.abs(surface.invariants(np.linspace(*surface.domain, 201)).kappa_bar)
    return float(found[np.isfinite(found)].max(initial=0.0))


def strip(surface: RuledSurface, length: float) -> Array:
    """Return (2, 80, 3) the ends of rulings about the striction points, not far from the feet."""
    sample = surface.sample(np.linspace(*surface.domain, 80))
    foot, x = sample.foot, sample.direction
    shift = np.clip(np.einsum("ti,ti->t", sample.striction - foot, x), -length, length)
    middle = foot + np.nan_to_num(shift)[:, None] * x
    return np.stack([middle - 0.5 * length * x, middle + 0.5 * length * x])


# -- numbers to read -------------------------------------------------------------------------------

MAP_NOTE = (
    '<div class="ruledlab-note">The grid over the chart: one sign for each line, in the colour of '
    "its kind. The sign is that of the divergence, the shade says how large it is.</div>"
)


def legend_html(kinds: dict[str, int], theme: Theme) -> str:
    """Return how many lines of the grid are of which kind, in their colours."""
    styles = {"elliptic": "dashed"}
    swatches = " ".join(
        f'<span style="white-space:nowrap"><span style="border-top:3px '
        f"{styles.get(kind, 'solid')} {getattr(theme, look)};display:inline-block;width:22px;"
        f'margin:0 4px 3px 8px"></span>{kinds[kind]} {kind}</span>'
        for kind, look in LOOKS.items()
        if kinds[kind]
    )
    missing = f" {kinds['undefined']} undefined" if kinds["undefined"] else ""
    count = sum(kinds.values())
    return f'<div class="ruledlab-note">{count} lines of the grid: {swatches}{missing}</div>'


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
    body = "".join(
        f"<tr><td>{name} <i>{symbol}</i></td><td>{value}</td><td>{unit}</td></tr>"
        for name, symbol, value, unit in rows
    )
    return f'<table class="ruledlab-numbers">{body}</table>'


def _pair(values: Array, kind: str) -> str:
    if kind == "elliptic":
        return "none real"
    return ", ".join(_number(float(value)) for value in values)


def _number(value: float) -> str:
    if math.isnan(value):
        return "–"
    return f"{value if abs(value) > 5e-7 else 0.0:.6f}".replace("-", "−")
