"""Axes: numbers as text, limits that stay while one drags, ticks, and where a curve leaves them.

Nothing here draws: plots, and the pictures of lessons, ask here what their axes are.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ..geometry.checks import Array

__all__ = [
    "CONSTANT",
    "HUGE",
    "SUPERSCRIPT",
    "ZERO",
    "Limits",
    "Ticks",
    "angle_limits",
    "angle_ticks",
    "brief",
    "bulk",
    "minus",
    "nice_limits",
    "number_ticks",
    "parameter_ticks",
    "peaks",
    "roomy_limits",
    "scientific",
    "sticky_limits",
    "undefined_ranges",
]

# ------------------------------------------------------------------------------ numbers as text

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def minus(text: str) -> str:
    """Return a text with the sign of subtraction for each hyphen."""
    return text.replace("-", "−")


def scientific(value: float, digits: int) -> str:
    """Return a value to ``digits`` significant figures and a power of ten."""
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{minus(mantissa)}·10{str(int(exponent)).translate(SUPERSCRIPT)}"


def brief(value: float, digits: int = 3) -> str:
    """Return a value to ``digits`` significant figures, in powers of ten where it is long."""
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if not -4 <= exponent < 5:
        return scientific(value, digits)
    text = f"{value:.{max(0, digits - 1 - exponent)}f}"
    return minus(text.rstrip("0").rstrip(".") if "." in text else text)


def _turn(multiple: Fraction) -> str:
    """Return a multiple of π as text: −π/2, 0, 3π/4, 2π."""
    if multiple == 0:
        return "0"
    sign = "−" if multiple < 0 else ""
    top = abs(multiple.numerator)
    bottom = "" if multiple.denominator == 1 else f"/{multiple.denominator}"
    return f"{sign}{'' if top == 1 else top}π{bottom}"


# -------------------------------------------------------------------------------------- limits

CONSTANT = 1e-9  # relative variation below which a curve is constant
ZERO = 1e-12  # size below which a curve is zero
HUGE = 1e100  # beyond it a value is not drawn
_SPIKE = 8.0  # full range over inner range from which on a curve has a spike
_USED = 0.4  # part of the present limits that fresh ones must need for the present to be kept
_FILLED = 0.8  # part of the present axis that a growing parameter must fill for it to be kept
_MARGIN = 0.06  # white space above and below, as part of the range


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of one axis, ``low < high``."""

    low: float
    high: float

    @property
    def span(self) -> float:
        """Length of the interval."""
        return self.high - self.low

    def hold(self, low: float, high: float) -> bool:
        """Whether the interval from ``low`` to ``high`` lies inside."""
        return self.low <= low and high <= self.high


def _finite(values: Array) -> Array:
    return values[np.abs(values) < HUGE]  # NaN compares false


def bulk(values: Array) -> tuple[float, float] | None:
    """Return the range worth showing: all of it, or without narrow spikes; None where all is NaN.

    A curve has a spike when its range exceeds that of its middle nine tenths by a factor of 8;
    it is then shown to one such inner range beyond them.
    """
    finite = _finite(np.asarray(values, dtype=float))
    if not finite.size:
        return None
    low, high = float(finite.min()), float(finite.max())
    inner_low, inner_high = (float(q) for q in np.quantile(finite, (0.05, 0.95)))
    room = inner_high - inner_low
    if room <= CONSTANT * max(abs(inner_low), abs(inner_high)):
        room = abs(inner_low)  # constant but for the spike: its own size is the scale
    if room <= ZERO or high - low <= _SPIKE * room:
        return low, high
    return max(low, inner_low - room), min(high, inner_high + room)


def nice_limits(low: float, high: float) -> Limits:
    """Return round limits around a range, with some white space; a constant is seen against zero.

    Quanta are powers of ten, hence nested: a larger range never gets narrower limits.
    """
    size = max(abs(low), abs(high))
    if size <= ZERO:
        return Limits(-1.0, 1.0)
    if high - low <= CONSTANT * size:
        return Limits(2 * low, 0.0) if low < 0 else Limits(0.0, 2 * high)
    margin = _MARGIN * (high - low)
    quantum = math.floor(math.log10(high - low)) - 1
    bottom = _rounded(low - margin, quantum, math.floor)
    top = _rounded(high + margin, quantum, math.ceil)
    # No white space across zero: what never changes sign stands on the zero line.
    return Limits(max(bottom, 0.0) if low >= 0 else bottom, min(top, 0.0) if high <= 0 else top)


def _rounded(value: float, exponent: int, rounding: Callable[[float], int]) -> float:
    """Return the multiple of 10**exponent next to a value, exact for negative exponents too."""
    unit = 10.0 ** abs(exponent)
    return rounding(value * unit) / unit if exponent < 0 else rounding(value / unit) * unit


def angle_limits(low: float, high: float) -> Limits:
    """Return limits at multiples of π/2 (of π, 2π, … for long ranges) around a range of angles."""
    span = high - low
    quantum = math.pi / 2 * 2.0 ** max(0, math.ceil(math.log2(max(span, 1.0) / (4 * math.pi))))
    margin = max(_MARGIN * span, 0.1)
    bottom, top = math.floor((low - margin) / quantum), math.ceil((high + margin) / quantum)
    return Limits(bottom * quantum, top * quantum)


def sticky_limits(values: Array, present: Limits | None = None, *, angle: bool = False) -> Limits:
    """Return the limits for a curve, the present ones as long as they serve.

    Parameters
    ----------
    values
        (T,) the curve, NaN where undefined.
    present
        the limits now on screen. They stay while the curve (without narrow spikes) is inside and
        fresh limits would need at least 40 % of them: an axis does not jump while one drags.
    angle
        whether limits are to be multiples of π/2.

    Returns
    -------
    Limits
        finite, ``low < high``. For a curve without any value: the present ones, or a default.
    """
    shown = bulk(values)
    if shown is None:
        return present or (Limits(0.0, math.pi) if angle else Limits(-1.0, 1.0))
    fresh = (angle_limits if angle else nice_limits)(*shown)
    if present and present.hold(*shown) and _USED * present.span <= fresh.span:
        return present
    return fresh


def roomy_limits(end: float, present: Limits | None = None) -> Limits:
    """Return limits from 0 to a little beyond a positive end, the present ones while they serve."""
    if present and present.low == 0.0 and _FILLED * present.high <= end <= present.high:
        return present
    return Limits(0.0, _rounded((1 + _MARGIN) * end, math.floor(math.log10(end)) - 1, math.ceil))


# --------------------------------------------------------------------------------------- ticks

Ticks = tuple[tuple[float, str], ...]


def _multiples(limits: Limits, step: float) -> range:
    slack = 1e-9
    first, last = limits.low / step - slack, limits.high / step + slack
    return range(math.ceil(first), math.floor(last) + 1)


def number_ticks(limits: Limits, most: int) -> Ticks:
    """Return at most ``most`` + 1 round ticks with their texts."""
    coarse = 10.0 ** math.floor(math.log10(limits.span / most))
    step = next(
        s
        for s in (coarse, 2 * coarse, 5 * coarse, 10 * coarse, 20 * coarse)
        if limits.span / s <= most * (1 + 1e-9)
    )
    return _label([k * step for k in _multiples(limits, step)], step)


def _label(ticks: list[float], step: float) -> Ticks:
    """Return ticks with texts: plain, by one power of ten, or as differences from one of them."""
    size = max(abs(tick) for tick in ticks)
    finest = math.floor(math.log10(step) + 1e-9)
    exponent = max(finest, math.floor(math.log10(size or step) + 1e-9))
    if size < 1e5 and max(0, -finest) + max(0, exponent) <= 4:
        return tuple((tick, minus(f"{tick:.{max(0, -finest)}f}")) for tick in ticks)
    if exponent - finest <= 2:
        return tuple((tick, _shared(tick, exponent, exponent - finest)) for tick in ticks)
    base = min(ticks, key=lambda tick: len(brief(tick, 9)))  # a narrow range far from zero
    return tuple((tick, brief(base, 9) if tick == base else _difference(tick - base, step))
                 for tick in ticks)  # fmt: skip


def _shared(value: float, exponent: int, decimals: int) -> str:
    """Return a value by a power of ten that others share; zero stays plain."""
    if value == 0:
        return "0"
    power = str(exponent).translate(SUPERSCRIPT)
    return f"{minus(f'{value / 10.0**exponent:.{decimals}f}')}·10{power}"


def _difference(value: float, step: float) -> str:
    return ("+" if value > 0 else "") + scientific(round(value / step) * step, 2)


def angle_ticks(limits: Limits, most: int) -> Ticks:
    """Return ticks at multiples of π/2, of π, 2π, … where that would be more than ``most`` + 1."""
    halves = 1
    while limits.span / (halves * math.pi / 2) > most * (1 + 1e-9):
        halves *= 2
    step = halves * math.pi / 2
    return tuple((k * step, _turn(Fraction(k * halves, 2))) for k in _multiples(limits, step))


def parameter_ticks(across: Limits, most: int) -> Ticks:
    """Return ticks of t: by π where t runs between multiples of π/2, else by round numbers."""
    ends = (across.low / (math.pi / 2), across.high / (math.pi / 2))
    by_angle = all(abs(end - round(end)) < 1e-9 for end in ends)
    return angle_ticks(across, min(most, 8)) if by_angle else number_ticks(across, most)


# ---------------------------------------------------------------------------------- stretches


def _runs(mask: npt.NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return (start, stop) of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    return [(int(start), int(stop)) for start, stop in edges.reshape(-1, 2)]


def undefined_ranges(t: Array, values: Array) -> list[tuple[float, float]]:
    """Return the ranges of t without a value, to half way to the neighbours that have one."""
    ends = np.concatenate((t[:1], (t[1:] + t[:-1]) / 2, t[-1:]))
    return [(float(ends[i]), float(ends[j])) for i, j in _runs(~(np.abs(values) < HUGE))]


def peaks(t: Array, values: Array, limits: Limits) -> list[tuple[float, float]]:
    """Return (t, value) at the farthest point of every excursion beyond the limits, farthest first.

    The distance is taken from the middle of the limits.
    """
    drawn = np.where(np.abs(values) < HUGE, values, np.nan)
    found = []
    for side in (1.0, -1.0):
        beyond = side * drawn > side * (limits.high if side > 0 else limits.low)
        for start, stop in _runs(beyond):
            at = start + int(np.argmax(side * drawn[start:stop]))
            found.append((float(t[at]), float(drawn[at])))
    middle = (limits.low + limits.high) / 2
    return sorted(found, key=lambda peak: -abs(peak[1] - middle))
