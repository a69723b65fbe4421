"""The colours a surface may have: from scalars to a scale, to bytes for a texture, to a legend."""

from __future__ import annotations

import html
import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from ruledlab.geometry.checks import Array
from ruledlab.lab import shaders
from ruledlab.lab.palette import Theme

__all__ = ["Scale", "colour_data", "colour_scale", "legend_html", "mixed", "stops"]

SEQUENTIAL: Final = ("#172a5a", "#1d4f83", "#26778f", "#449f92", "#86c285", "#d0dc7e", "#fdf3b0")
DIVERGING_LIGHT: Final = (
    *("#003f7d", "#2f86c8", "#a9d0ec", "#f4f2ee", "#f6bf85", "#d9711c", "#873a00"),
)
DIVERGING_DARK: Final = (
    *("#8fd0ff", "#2f8fd6", "#16507f", "#2b2d31", "#7d420f", "#e07f28", "#ffc891"),
)
MISSING: Final = "#8b949e"


@dataclass(frozen=True, slots=True)
class Scale:
    """What the ends of the colour bar mean.

    Attributes
    ----------
    low, high
        the ends; values beyond them have the end's colour.
    diverging
        whether the middle is 0 and the two signs have a hue each.
    clipped_low, clipped_high
        whether there are values beyond the end.
    missing
        whether there are undefined values.
    """

    low: float
    high: float
    diverging: bool
    clipped_low: bool
    clipped_high: bool
    missing: bool


def _rounded(value: float) -> float:
    """Round away from 0 to two digits, so that the scale does not tremble as values change."""
    if value == 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 1)
    return math.copysign(math.ceil(abs(value) / unit - 1e-9) * unit, value)


def _limits(low: float, high: float) -> tuple[float, float, bool]:
    if low < 0.0 < high:
        end = _rounded(max(-low, high))
        return -end, end, True
    if low == high == 0.0:
        return -1.0, 1.0, True
    if high - low > 0.5 * max(abs(low), abs(high)):
        return min(_rounded(low), 0.0), max(_rounded(high), 0.0), False
    # nearly constant: neither blow rounding errors up nor hide what little it varies
    spare = 0.1 * max(abs(low), abs(high)) + 0.25 * (high - low)
    step = 10.0 ** math.floor(math.log10(spare))
    return math.floor((low - spare) / step) * step, math.ceil((high + spare) / step) * step, False


def colour_scale(values: Array) -> Scale:
    """Choose the colour scale of an array of scalars; NaN and ±∞ count as undefined.

    A hundredth of the values at either end may lie beyond the scale, so that one steep place does
    not turn the rest of the surface grey.
    """
    finite = values[np.isfinite(values)]
    missing = finite.size < values.size
    if not finite.size:
        return Scale(-1.0, 1.0, True, False, False, missing)
    low, high, diverging = _limits(*(float(q) for q in np.quantile(finite, (0.01, 0.99))))
    slack = 1e-6 * (high - low)
    return Scale(
        low,
        high,
        diverging,
        bool(finite.min() < low - slack),
        bool(finite.max() > high + slack),
        missing,
    )


def colour_data(values: Array, scale: Scale) -> Array:
    """Return the scalars packed for the texture, (T, cells, 4) float32: three bytes a number."""
    count, width = values.shape
    codes = np.zeros((count, shaders.BYTES * -(-width // shaders.BYTES)))
    valid = np.isfinite(values)
    part = (np.where(valid, values, scale.low) - scale.low) / (scale.high - scale.low)
    codes[:, :width] = np.where(valid, np.floor(1.5 + 254.0 * np.clip(part, 0.0, 1.0)), 0.0)
    packed: Array = codes.reshape(count, -1, 4, 3) @ np.array([1.0, 256.0, 65536.0])
    return packed.astype(np.float32)


def _rgb(colour: str) -> tuple[int, ...]:
    return tuple(int(colour[i : i + 2], 16) for i in (1, 3, 5))


def stops(diverging: bool, theme: Theme) -> tuple[str, ...]:
    """Return the colours from one end of the scale to the other."""
    if not diverging:
        return SEQUENTIAL
    return DIVERGING_DARK if theme.dark else DIVERGING_LIGHT


def legend_html(label: str, scale: Scale, theme: Theme) -> str:
    """Return a colour bar with its ends and its name as HTML."""
    colours = ", ".join(stops(scale.diverging, theme))
    low, high = ("≤ " * scale.clipped_low, "≥ " * scale.clipped_high)
    middle = "<span>0</span>" if scale.diverging else ""
    return (
        f'<div style="max-width:260px;font-size:12px;line-height:1.4">'
        f"<div>{html.escape(label)}{_missing_note(scale)}</div>"
        f'<div style="height:10px;border-radius:3px;'
        f'background:linear-gradient(to right, {colours})"></div>'
        f'<div style="display:flex;justify-content:space-between">'
        f"<span>{low}{_number(scale.low)}</span>{middle}"
        f"<span>{high}{_number(scale.high)}</span></div></div>"
    )


def mixed(first: str, second: str, part: float) -> str:
    """Return a colour between two, ``part`` of the way."""
    both = zip(_rgb(first), _rgb(second), strict=True)
    return "#" + "".join(f"{round((1 - part) * a + part * b):02x}" for a, b in both)


def _number(value: float) -> str:
    return f"{value:.3g}".replace("-", "−")


def _missing_note(scale: Scale) -> str:
    if not scale.missing:
        return ""
    swatch = f'<span style="color:{MISSING}">■</span>'
    return f' <span style="white-space:nowrap">· {swatch} undefined</span>'
