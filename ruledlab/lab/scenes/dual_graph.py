"""The picture of lesson 01: the graph of a function, its tangent, and x + ε x̄ on it. No widgets.

`dual_scene` gives what follows from a choice, `picture` its SVG, `words` and `readout` the same in
words and numbers.
"""

from __future__ import annotations

import functools
import html
import math
import pathlib
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...geometry import Function, GeometryError, Lifted, function
from ...geometry.checks import Array, frozen
from ..axes import Limits, number_ticks, sticky_limits
from ..flat import Flat
from ..palette import DARK, LIGHT, Theme

__all__ = [
    "STEP_SPAN",
    "STYLE",
    "X_SPAN",
    "DualPoint",
    "DualScene",
    "dual_scene",
    "flat",
    "height_limits",
    "picture",
    "readout",
    "words",
]

WINDOW: Final = Limits(-4.2, 4.2)
"""The x-axis of the picture: it holds every x + x̄ that can be chosen, so it never moves."""

X_SPAN: Final = (-3.0, 3.0)
STEP_SPAN: Final = (-1.0, 1.0)


# -- the state and what follows from it ------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class DualPoint:
    """What the reader chooses: f as text, and x + ε x̄."""

    formula: str
    x: float
    x_bar: float


@dataclass(frozen=True, eq=False, slots=True)
class DualScene:
    """What is drawn and read off.

    Attributes
    ----------
    point
        what was chosen.
    f
        the function.
    lifted
        f(X), the slope, or why there is none.
    beyond
        the ordinary number f(x + x̄), for comparison.
    heights
        the graph at `PLACES`, not finite where f is undefined.
    """

    point: DualPoint
    f: Function
    lifted: Lifted
    beyond: float
    heights: Array

    @property
    def tip(self) -> float:
        """Height of the tangent after the step x̄: f(x) + x̄ f′(x)."""
        return float(self.lifted.value.real) + float(self.lifted.value.dual)


PLACES: Final = frozen(np.linspace(WINDOW.low, WINDOW.high, 505))


def dual_scene(point: DualPoint) -> DualScene:
    """Return what follows from a choice; a GeometryError says what cannot be."""
    for name, value, (low, high) in (("x", point.x, X_SPAN), ("x_bar", point.x_bar, STEP_SPAN)):
        if not low <= value <= high:
            raise GeometryError(f"`{name}` must lie between {low:g} and {high:g}; got {value:g}")
    f = function(point.formula)
    beyond = float(f(point.x + point.x_bar))
    return DualScene(point, f, f.lifted(point.x, point.x_bar), beyond, _heights(point.formula))


@functools.lru_cache(maxsize=16)
def _heights(formula: str) -> Array:
    return frozen(function(formula)(PLACES))


# -- the picture -----------------------------------------------------------------------------------

WIDTH, HEIGHT, LEFT, TOP, BOTTOM = 600.0, 400.0, 46.0, 8.0, 28.0
"""Size of the plot and the room around it, in units of the drawing."""

SIZE: Final = (WIDTH + LEFT + 8, HEIGHT + BOTTOM + TOP + 4)
"""Width and height of the whole drawing."""

HOME: Final = 1.6
"""The graph over |x| up to here is in sight whatever x is chosen; all of it, if that needs no more
than `MOST` times the height."""

MOST: Final = 3.0

FARTHEST: Final = 1e6
"""Heights beyond are not followed by the axis."""


def height_limits(scene: DualScene, present: Limits | None) -> Limits:
    """Return the limits of the height axis, the present ones as long as they serve."""
    near, whole = (_bulk(h) for h in (scene.heights[np.abs(PLACES) <= HOME], scene.heights))
    bulk = whole if np.ptp(whole) <= MOST * np.ptp(near) else near
    marks = np.array([0.0, scene.lifted.value.real, scene.tip, scene.beyond])
    values = np.append(bulk, marks[np.abs(marks) < FARTHEST])  # NaN compares false
    low, high = -float(values.min()), float(values.max())
    # Rungs of a ladder: few changes while x moves, and white space across zero.
    return sticky_limits(np.array([-_rung(max(low, 0.2 * high)), _rung(max(high, 0.2 * low))]),
                         present)  # fmt: skip


def _bulk(heights: Array) -> Array:
    """Return the range of the middle eight tenths: poles do not count."""
    finite = heights[np.isfinite(heights)]
    return np.quantile(finite, (0.1, 0.9)) if finite.size else np.zeros(2)


def _rung(size: float) -> float:
    """Return the least of 1, 2, 5, 10, 20 … (and 0.5, 0.2 …) that is not below ``size``."""
    decade = 10.0 ** math.floor(math.log10(max(size, 0.1)))
    return next(step * decade for step in (1, 2, 5, 10) if step * decade >= size * (1 - 1e-9))


def flat(limits: Limits) -> Flat:
    """Return where the places of the plot are in the drawing."""
    return Flat(SIZE, (LEFT, TOP), (WIDTH, HEIGHT), WINDOW, limits)


def picture(scene: DualScene, limits: Limits) -> str:
    """Return the graph of f with point, tangent, step and rise as SVG, with its words."""
    pen = _Pen(limits)
    inside = [_grid(pen), f'<path class="graph" d="{_path(scene.heights, pen)}"/>']
    inside.append(_marks(scene, pen) if not scene.lifted.undefined else _gap(scene, pen))
    view = f"{-LEFT:g} {-TOP:g} {SIZE[0]:g} {SIZE[1]:g}"
    plot = f'width="{WIDTH:g}" height="{HEIGHT:g}" viewBox="0 0 {WIDTH:g} {HEIGHT:g}"'
    return (
        f'<svg class="ruledlab-dual" viewBox="{view}" role="img" '
        f'aria-label="{html.escape(words(scene), quote=True)}">'
        f'<svg {plot} overflow="hidden">{"".join(inside)}</svg>{_numbers(pen)}</svg>'
    )


@dataclass(frozen=True, slots=True)
class _Pen:
    """Places of the drawing."""

    limits: Limits

    def x(self, x: float) -> float:
        return (x - WINDOW.low) / WINDOW.span * WIDTH

    def y(self, y: float) -> float:
        off = (self.limits.high - y) / self.limits.span
        return min(max(off, -50.0), 50.0) * HEIGHT  # what lies far outside stays drawable

    def line(self, kind: str, x1: float, y1: float, x2: float, y2: float) -> str:
        ends = f'x1="{self.x(x1):.2f}" y1="{self.y(y1):.2f}" x2="{self.x(x2):.2f}"'
        return f'<line class="{kind}" {ends} y2="{self.y(y2):.2f}"/>'

    def dot(self, kind: str, x: float, y: float) -> str:
        return f'<circle class="{kind}" cx="{self.x(x):.2f}" cy="{self.y(y):.2f}" r="6"/>'

    def text(self, kind: str, at: tuple[float, float], text: str, anchor: str = "middle") -> str:
        x, y = at
        return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'


def _path(heights: Array, pen: _Pen) -> str:
    """Return the graph; it is lifted off where f is undefined and where it leaps over the plot."""
    y = (pen.limits.high - heights) / pen.limits.span * HEIGHT
    x = (PLACES - WINDOW.low) / WINDOW.span * WIDTH
    side = np.where(y < 0, -1, np.where(y > HEIGHT, 1, 0))
    drawn = np.isfinite(y)
    joined = drawn[1:] & drawn[:-1] & (side[1:] * side[:-1] >= 0)
    y = np.clip(np.nan_to_num(y), -HEIGHT, 2 * HEIGHT)
    pairs = zip(x, y, drawn, (False, *joined), strict=True)
    return "".join(f"{'L' if on else 'M'}{a:.1f} {b:.1f}" for a, b, shown, on in pairs if shown)


def _grid(pen: _Pen) -> str:
    low, high = pen.limits.low, pen.limits.high
    upright = [pen.line("grid", x, low, x, high) for x, _ in number_ticks(WINDOW, 10)]
    level = [
        pen.line("grid", WINDOW.low, y, WINDOW.high, y) for y, _ in number_ticks(pen.limits, 8)
    ]
    return (
        "".join(upright + level)
        + pen.line("axis", 0, low, 0, high)
        + pen.line("axis", WINDOW.low, 0, WINDOW.high, 0)
    )


def _numbers(pen: _Pen) -> str:
    foot = HEIGHT + BOTTOM - 8
    below = [pen.text("tick", (pen.x(x), foot), text) for x, text in number_ticks(WINDOW, 10)]
    ticks = number_ticks(pen.limits, 8)
    beside = [pen.text("tick", (-6, pen.y(y) + 5), text, "end") for y, text in ticks]
    return "".join(below + beside) + pen.text("tick", (WIDTH - 4, pen.y(0.0) - 7), "x", "end")


def _marks(scene: DualScene, pen: _Pen) -> str:
    """Draw tangent, step, rise and the ordinary value beyond."""
    x, step, slope = scene.point.x, scene.point.x_bar, scene.lifted.slope
    y, tip, end = float(scene.lifted.value.real), scene.tip, x + scene.point.x_bar
    far = min(2 * WINDOW.span, 5 * pen.limits.span / max(abs(slope), 1e-9))
    parts = [
        pen.line("tangent", x - far, y - slope * far, x + far, y + slope * far),
        pen.line("foot", x, 0, x, y),
        pen.line("step", x, y, end, y),
        pen.line("rise", end, y, end, tip),
        pen.line("along", x, y, end, tip),
    ]
    if math.isfinite(scene.beyond):
        parts.append(pen.dot("beyond", end, scene.beyond))
    parts += [pen.dot("tip", end, tip), pen.dot("point", x, y)]
    return "".join(parts) + (_labels(scene, pen) if step else "")


def _labels(scene: DualScene, pen: _Pen) -> str:
    """Write x̄ on the far side of the step from the tangent, x̄ f′(x) outside of the rise."""
    x, step, tip = scene.point.x, scene.point.x_bar, scene.tip
    y = float(scene.lifted.value.real)
    below = 24 if tip >= y else -13
    out, anchor = (13, "start") if step > 0 else (-13, "end")
    middle = (pen.y(y) + pen.y(tip)) / 2 + 5
    return pen.text("step-word", (pen.x(x + step / 2), pen.y(y) + below), "x̄") + pen.text(
        "rise-word", (pen.x(x + step) + out, middle), "x̄ f′(x)", anchor
    )


def _gap(scene: DualScene, pen: _Pen) -> str:
    x, y = scene.point.x, float(scene.lifted.value.real)
    dot = pen.dot("point", x, y) if math.isfinite(y) else ""
    line = pen.line("missing", x, pen.limits.low, x, pen.limits.high)
    return line + dot + pen.text("rise-word", (pen.x(x) + 10, 24), "no f(X) here", "start")


# -- numbers and words -----------------------------------------------------------------------------

ROUNDING: Final = 1e-15
"""Sizes up to this are shown as 0: the slope of sin at pi/2 is 6·10⁻¹⁷ in floating point."""


def shown(value: float) -> str:
    """Return a number with six digits, or a dash where there is none."""
    if not math.isfinite(value):
        return "–"
    return f"{value:.6g}".replace("-", "−") if abs(value) > ROUNDING else "0"


def shown_dual(real: float, dual: float) -> str:
    """Return a + ε ā."""
    if not (math.isfinite(real) and math.isfinite(dual)):
        return "undefined"
    return f"{shown(real)} {'−' if dual < -ROUNDING else '+'} ε {shown(abs(dual))}"


def words(scene: DualScene) -> str:
    """Return in words what the picture shows."""
    f, x, step = scene.f.text, scene.point.x, scene.point.x_bar
    begin = f"f(x) = {f} at X = {shown_dual(x, step)}. "
    if scene.lifted.undefined:
        return f"{begin}There is no f(X): {scene.lifted.undefined}."
    real, dual, slope = scene.lifted.value.real, scene.lifted.value.dual, scene.lifted.slope
    level = abs(dual) <= ROUNDING
    way = "stays level" if level else "rises" if dual > 0 else "falls"
    return (
        f"{begin}The point of the graph has the height f(x) = {shown(real)}, its tangent the slope "
        f"f′(x) = {shown(slope)}. Over the step x̄ = {shown(step)} the tangent {way}: "
        f"x̄ f′(x) = {shown(dual)}, and that is the dual part of "
        f"f(X) = {shown_dual(real, dual)}. {_beyond(scene)}"
    )


def _beyond(scene: DualScene) -> str:
    if not math.isfinite(scene.beyond):
        return "The graph itself has no point at x + x̄."
    off = scene.beyond - scene.tip
    if abs(off) < 1e-12 * max(1.0, abs(scene.tip)):
        return "The graph itself is at the same height there."
    side = "above" if off > 0 else "below"
    return f"The graph itself is {shown(abs(off))} {side} the tangent there."


def readout(scene: DualScene) -> str:
    """Return the numbers as a table, each with its name."""
    lifted, point = scene.lifted, scene.point
    rows = (
        ("argument", "X = x + ε <span class='step-word'>x̄</span>",
         shown_dual(point.x, point.x_bar)),
        ("value", "f(X) = f(x) + ε <span class='rise-word'>x̄ f′(x)</span>",
         shown_dual(lifted.value.real, lifted.value.dual)),
        ("slope", "f′(x)", shown(lifted.slope)),
        ("ordinary, not dual:", "f(x + x̄)", shown(scene.beyond)),
    )  # fmt: skip
    body = "".join(
        f"<tr><td>{name} <i>{symbol}</i></td><td>{value}</td></tr>" for name, symbol, value in rows
    )
    return f'<table class="ruledlab-numbers">{body}</table>'


# -- looks -----------------------------------------------------------------------------------------


def _colours(theme: Theme) -> str:
    named = {"step": theme.kappa, "rise": theme.tau, "tangent": theme.sigma, "point": theme.cursor}
    return "".join(f"--dual-{name}:{colour};" for name, colour in named.items())


_CSS: Final = pathlib.Path(__file__).parent.parent / "static" / "dual_graph.css"

STYLE: Final = (
    f"<style>.ruledlab {{{_colours(LIGHT)}}}"
    f'body[data-jp-theme-light="false"] .ruledlab {{{_colours(DARK)}}}'
    f"{_CSS.read_text(encoding='utf-8')}</style>"
)
"""The looks of picture and read-out; the page's theme chooses the colours."""
