"""How fast a ruling's neighbour comes nearer: angle, distance and foot over the step h.

On logarithmic axes a power hᵖ is a straight line of slope p, so that the order of each of them can
be seen. No widget is imported here.
"""

from __future__ import annotations

import html
import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...geometry.checks import Array
from ...geometry.surface import RuledSurface
from ..axes import Limits
from ..flat import Flat
from ..palette import Theme

__all__ = ["FLAT", "Shrinking", "ahead", "order", "orders_html", "shrinking", "shrinking_svg"]

STEPS: Final = 10.0 ** np.linspace(-3.0, -0.3, 28)
NAMES: Final = {
    "angle": ("angle θ", "tau", ""),
    "distance": ("distance d", "delta", "7 4"),
    "off": ("foot to m", "sigma", "2 3"),
}
"""What is drawn: its name, its colour, its dashes."""

FLOOR: Final = {"angle": 1e-9, "distance": 1e-11, "off": 1e-9}
"""Below these, rounding has eaten the first digits."""

WIDTH, HEIGHT = 330.0, 178.0
LEFT, RIGHT, TOP, BOTTOM = 44.0, 322.0, 8.0, 146.0
LOWEST, HIGHEST = -7.0, 1.0
EXPONENTS: Final = Limits(math.log10(STEPS[0]), math.log10(STEPS[-1]))

FLAT: Final = Flat(
    (WIDTH, HEIGHT), (LEFT, TOP), (RIGHT - LEFT, BOTTOM - TOP), EXPONENTS, Limits(0.0, 1.0)
)
"""Where log₁₀ h is in the picture, whose plot goes from 0 up to 1."""


@dataclass(frozen=True, eq=False, slots=True)
class Shrinking:
    """The neighbours at t + h of one ruling, for many steps h.

    Attributes
    ----------
    h
        (N,) the steps, rising.
    angle, distance, off
        (N,) angle, unsigned shortest distance, and ‖foot − m‖; NaN where there is none.
    """

    h: Array
    angle: Array
    distance: Array
    off: Array


def ahead(surface: RuledSurface, t: float, h: float | Array) -> Array:
    """Return t + h; beyond the end of a surface that closes, where that ruling is on it."""
    start, end = surface.domain
    place = np.asarray(t + h, dtype=float)
    if (place <= end).all() or not surface.closure().oriented:
        return place
    return np.where(place > end, place - (end - start), place)


@np.errstate(all="ignore")
def shrinking(surface: RuledSurface, t: float, h: Array = STEPS) -> Shrinking:
    """Compare the ruling at t with those at t + h, on a closed surface round the seam."""
    pair = surface.neighbours(t, ahead(surface, t, h) - t)
    parallel = ~(np.sin(pair.angle) > 1e-9)
    off = np.linalg.norm(pair.foot_a - surface.striction(t), axis=-1)
    return Shrinking(h, pair.angle, np.abs(pair.distance), np.where(parallel, np.nan, off))


def order(found: Shrinking, name: str) -> float:
    """Return the p of hᵖ as which a quantity shrinks, from the smallest steps that can tell.

    NaN where it is 0, or undefined.
    """
    value = getattr(found, name)
    firm = np.flatnonzero(value > FLOOR[name])
    if firm.size < 2:
        return math.nan
    i = firm[0]
    j = firm[firm <= i + 3][-1]
    if j == i:
        return math.nan
    return float(np.log(value[j] / value[i]) / np.log(found.h[j] / found.h[i]))


def _power(p: float) -> str:
    """Return hᵖ in words of HTML; whole numbers where it is one."""
    if abs(p - round(p)) < 0.12:
        return "h" if round(p) == 1 else f"h<sup>{round(p)}</sup>"
    return f"h<sup>{p:.1f}</sup>"


def _orders(found: Shrinking) -> dict[str, str]:
    said = {}
    for name in NAMES:
        p = order(found, name)
        known = getattr(found, name)[np.isfinite(getattr(found, name))]
        if math.isfinite(p):
            said[name] = "does not shrink" if abs(p) < 0.12 else f"like {_power(p)}"
        else:
            said[name] = "is 0" if known.size else "undefined"
    return said


def orders_html(found: Shrinking, theme: Theme) -> str:
    """Say as which power of h each of them shrinks, with the line's colour and dashes before it."""
    parts = "".join(
        f'<div><svg width="22" height="8" aria-hidden="true">'
        f'<path d="M0 4H22" stroke="{theme.quantity(NAMES[name][1])}" stroke-width="2.5" '
        f'stroke-dasharray="{NAMES[name][2]}"/></svg> {NAMES[name][0]} <b>{said}</b></div>'
        for name, said in _orders(found).items()
    )
    return f'<div class="ruledlab-note">For small h:{parts}</div>'


def shrinking_svg(found: Shrinking, h: float, theme: Theme) -> str:
    """Return angle, distance and foot over h on logarithmic axes, with the present h marked."""
    lines = "".join(_line(found, name, theme) for name in NAMES)
    words = "; ".join(
        f"{NAMES[name][0]} {said.replace('<sup>', ' to the power ').replace('</sup>', '')}"
        for name, said in _orders(found).items()
    )
    label = html.escape(f"Over the step h from 0.001 to 0.5, on logarithmic axes: {words}.")
    return (
        f'<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" aria-label="{label}" '
        f'style="width:100%;max-width:{1.2 * WIDTH:g}px;height:auto;display:block" '
        f'font-family="sans-serif" font-size="11">{_axes(theme)}{_cursor(found, h, theme)}'
        f"{lines}</svg>"
    )


def _across(h: float | Array) -> Array:
    return np.asarray(LEFT + (RIGHT - LEFT) * (np.log10(h) - EXPONENTS.low) / EXPONENTS.span)


def _up(value: float | Array) -> Array:
    return np.asarray(BOTTOM - (BOTTOM - TOP) * (np.log10(value) - LOWEST) / (HIGHEST - LOWEST))


@np.errstate(all="ignore")
def _line(found: Shrinking, name: str, theme: Theme) -> str:
    value = getattr(found, name)
    x, y = _across(found.h), _up(value)
    kept = (value > FLOOR[name]) & (y >= TOP) & (y <= BOTTOM)
    if not kept.any():
        return ""
    places = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x[kept], y[kept], strict=True))
    _, ink, dashes = NAMES[name]
    return (
        f'<polyline points="{places}" fill="none" stroke="{theme.quantity(ink)}" '
        f'stroke-width="2.5" stroke-dasharray="{dashes}"/>'
    )


@np.errstate(all="ignore")
def _cursor(found: Shrinking, h: float, theme: Theme) -> str:
    x = float(_across(h))
    drawn = f'<path d="M{x:.1f} {TOP:g}V{BOTTOM:g}" stroke="{theme.cursor}" stroke-width="1.5"/>'
    for name, (_, ink, _) in NAMES.items():
        value = float(np.exp(np.interp(math.log(h), np.log(found.h), np.log(getattr(found, name)))))
        if value > FLOOR[name] and TOP <= (y := float(_up(value))) <= BOTTOM:
            drawn += f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{theme.quantity(ink)}"/>'
    return drawn


def _axes(theme: Theme) -> str:
    drawn = ""
    for power in (0, -2, -4, -6):
        y = float(_up(10.0**power))
        text = "1" if power == 0 else f'10<tspan dy="-4" font-size="8">−{-power}</tspan>'
        drawn += (
            f'<path d="M{LEFT:g} {y:.1f}H{RIGHT:g}" stroke="{theme.grid}"/>'
            f'<text x="{LEFT - 6:g}" y="{y + 4:.1f}" text-anchor="end" fill="{theme.faint}">'
            f"{text}</text>"
        )
    for h in (0.001, 0.01, 0.1):
        x = float(_across(h))
        drawn += (
            f'<path d="M{x:.1f} {TOP:g}V{BOTTOM:g}" stroke="{theme.grid}"/>'
            f'<text x="{x:.1f}" y="{BOTTOM + 15:g}" text-anchor="middle" fill="{theme.faint}">'
            f"{h:g}</text>"
        )
    return drawn + (
        f'<text x="{RIGHT:g}" y="{BOTTOM + 15:g}" text-anchor="end" font-style="italic" '
        f'fill="{theme.ink}">h</text>'
    )
