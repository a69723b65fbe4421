"""A printed formula beside the mended one, on any design: as arrays, in words, and as a picture.

What the findings are and how they are evaluated is in `ruledlab.printed`. Nothing here is a widget:
the picture is a text of SVG, coloured for the light and the dark theme by its own style sheet.
"""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...geometry import RuledSurface, gallery
from ...geometry.checks import Array
from ...printed import PRINTED, Finding
from ..axes import Limits, number_ticks, peaks, sticky_limits, undefined_ranges
from ..flat import Flat
from ..palette import DARK, LIGHT, Theme

__all__ = [
    "NAMES",
    "ROUNDING",
    "Comparison",
    "compare",
    "excursions",
    "flat",
    "in_words",
    "number_lines",
    "picture",
    "said",
    "table",
    "title",
    "values",
]

# -- what is compared ------------------------------------------------------------------------------

PLACES = 201
"""Values of t at which the two curves are computed."""

ROUNDING = 1e-9
"""A difference below this is one of rounding."""

NAMES: dict[str, tuple[tuple[str, str], ...]] = {
    "x2bar_prime": tuple((f"x̄₂′, {axis} coordinate", "length per t") for axis in "xyz"),
    "x3_length": (("real part", "rad"), ("dual part", "length")),
    "base_curve": (("g₁₁", "length² per t²"),),
    "h11": (("h₁₁", "length per t²"),),
    "mean_curvature": (("H", "1/length"),),
    "angle_of_pitch_11": (("λ", "rad"),),
    "domain": (("inside the domain", "1 = yes, 0 = no"),),
    "closing": (("what has to be 0", "pure number"),),
    "tau": (("τ", "rad per t"),),
    "tau_bar": (("τ̄", "length per t"),),
    "cot_sigma": (("cot σ", "pure number"),),
    "example_1_kappa_bar": (("κ̄", "length per t"),),
    "example_1_tau_bar": (("τ̄", "length per t"),),
    "example_1_cot_sigma": (("cot σ", "pure number"),),
    "pitch_24": (("l", "length"),),
    "angle_of_pitch_25": (("λ", "rad"),),
    "tau_0": (("τ(0)", "rad per t"),),
    "tau_bar_0": (("τ̄(0)", "length per t"),),
    "delta_0": (("δ(0)", "length"),),
    "cot_sigma_0": (("cot σ(0)", "pure number"),),
    "example_2": (("λ", "rad"), ("l", "length")),
}
"""For each finding its values' symbols and units: one for each coordinate."""


def title(entry: Finding) -> str:
    """Return a finding's number, place and short name, as the menu has it."""
    number = PRINTED.index(entry) + 1
    quantity = entry.quantity.split(", as")[0].split(": ")[0]
    return f"{number}. {entry.place}: {quantity}"


@dataclass(frozen=True, eq=False, slots=True)
class Comparison:
    """Printed and mended values of one quantity: over t, or of the surface as a whole.

    Attributes
    ----------
    t
        (T,) places; empty for a quantity of the whole surface.
    printed, mended
        (T,) over t; otherwise (N,), one for each entry of ``names``. NaN where undefined.
    names
        pairs of symbol and unit.
    reasons
        sentences: where there is no value, and why.
    """

    t: Array
    printed: Array
    mended: Array
    names: tuple[tuple[str, str], ...]
    reasons: tuple[str, ...] = ()

    @property
    def difference(self) -> Array:
        """Printed − mended."""
        return self.printed - self.mended

    @property
    def largest(self) -> int | None:
        """The first index of the largest difference, but for rounding; None where there is none."""
        size = np.abs(self.difference)
        if not np.isfinite(size).any():
            return None
        return int(np.argmax(size >= np.nanmax(size) * (1.0 - 1e-9)))

    @property
    def agree(self) -> bool:
        """Whether there are values of both, and nowhere a difference but for rounding."""
        worst = self.largest
        return worst is not None and bool(abs(self.difference[worst]) < ROUNDING)


def _subject(entry: Finding, surface: RuledSurface) -> RuledSurface:
    """Return the surface that a finding speaks of."""
    return gallery.surface(entry.design) if entry.only else surface


def values(
    entry: Finding, surface: RuledSurface, t: Array, height: float, axis: int
) -> tuple[Array, Array]:
    """Return printed and mended values at t (and w = ``height``), as arrays of one axis."""
    surface = _subject(entry, surface)
    places = {"t": (t,), "t, w": (t, height), "surface": ()}[entry.over]
    pair = [np.asarray(f(surface, *places), dtype=float) for f in (entry.printed, entry.corrected)]
    if entry.over == "surface":
        return pair[0].reshape(-1), pair[1].reshape(-1)
    return tuple(each[..., axis] if each.ndim > 1 else each for each in pair)  # type: ignore[return-value]


def compare(
    entry: Finding, surface: RuledSurface, height: float = 0.5, axis: int = 0
) -> Comparison:
    """Evaluate both sides of a finding.

    Raises
    ------
    GeometryError
        where the quantity makes no sense for this surface, with the reason.
    """
    surface = _subject(entry, surface)
    t = np.linspace(*surface.domain, PLACES)
    printed, mended = values(entry, surface, t, height, axis)
    names = NAMES[entry.key]
    if entry.over == "surface":
        return Comparison(t[:0], printed, mended, names, tuple(_missing(names, printed, mended)))
    reasons = tuple(_gaps(surface, t, printed, mended))
    return Comparison(t, printed, mended, (names[axis if len(names) > 1 else 0],), reasons)


def _missing(names: Any, printed: Array, mended: Array) -> Iterator[str]:
    for which, each in (("as printed", printed), ("mended", mended)):
        for (name, _), value in zip(names, each, strict=True):
            if np.isnan(value):
                yield f"{name} {which} has no value here: a denominator is 0."


def _gaps(surface: RuledSurface, t: Array, printed: Array, mended: Array) -> Iterator[str]:
    reports = surface.invariants(t).undefined
    for which, each in (("as printed", printed), ("mended", mended)):
        bad = np.isnan(each)
        if bad.any():
            why = [report.reason for report in reports if np.any(report.where & bad)]
            stretches = ", ".join(_stretch(t, *ends) for ends in undefined_ranges(t, each)[:3])
            because = "; ".join(dict.fromkeys(why)) or "a denominator is 0 there"
            yield f"Undefined {which} at t = {stretches}: {because}."


def _stretch(t: Array, low: float, high: float) -> str:
    inside = t[(t >= low) & (t <= high)]
    first, last = said(inside[0], 3), said(inside[-1], 3)
    return first if first == last else f"{first} … {last}"


# -- in words and numbers --------------------------------------------------------------------------


def said(value: float, digits: int = 6) -> str:
    """Return a number as text; "undefined" for NaN."""
    if not np.isfinite(value):
        return "undefined"
    rounded = 0.0 if abs(value) < 1e-12 else value
    return f"{rounded:.{digits}g}".replace("-", "−")


def relative(printed: float, mended: float) -> str:
    """Return the relative error of the printed value in per cent."""
    if not np.isfinite(printed - mended) or abs(mended) < 1e-12:
        return "–"
    return said(100 * abs(printed - mended) / abs(mended), 3) + " %"


def in_words(entry: Finding, made: Comparison) -> str:
    """Say what the picture shows."""
    worst = made.largest
    what = f"{entry.quantity[0].upper()}{entry.quantity[1:]}, {entry.place}."
    if worst is None:
        said_of = "There is no value of both to compare."
    elif made.agree:
        said_of = "Printed and mended formula agree on this design."
    elif not made.t.size:
        said_of = " ".join(
            f"{name}: {said(p)} as printed, {said(m)} mended, difference {said(p - m)} ({unit})."
            for (name, unit), p, m in zip(made.names, made.printed, made.mended, strict=True)
        )
    else:
        ((_, unit),) = made.names
        said_of = (
            f"Over t, as printed {_range(made.printed)}, mended {_range(made.mended)} ({unit}). "
            f"The largest difference is {said(made.difference[worst])} at "
            f"t = {said(made.t[worst], 3)}."
        )
    return " ".join((what, said_of, *made.reasons))


def _range(curve: Array) -> str:
    low, high = (said(end, 4) for end in (np.nanmin(curve), np.nanmax(curve)))
    return f"{low} throughout" if low == high else f"from {low} to {high}"


def table(rows: Sequence[tuple[str, float, float]]) -> str:
    """Return rows (label, printed, mended) as a table with difference and relative error."""
    heads = ("", "as printed", "mended", "printed − mended", "relative error")
    lines = [_row(heads)]
    lines += [_row((label, said(p), said(m), said(p - m), relative(p, m))) for label, p, m in rows]
    return f'<table class="ruledlab-numbers">{"".join(lines)}</table>'


def _row(cells: Sequence[str]) -> str:
    number = 'style="text-align:right;font-weight:400;min-width:6.5em"'
    first, *others = cells
    return f"<tr><td>{first}</td>{''.join(f'<td {number}>{cell}</td>' for cell in others)}</tr>"


# -- the picture -----------------------------------------------------------------------------------

WIDTH, LEFT, RIGHT = 760.0, 70.0, 14.0
PANELS = ((30.0, 190.0), (252.0, 96.0))
"""Top and height of the two frames: both curves, and their difference."""

FOOT = PANELS[1][0] + PANELS[1][1]
"""Where the axis of t is in the picture of two curves."""

TALL = FOOT + 40
"""The height of that picture."""


def _rules(theme: Theme) -> str:
    where = 'body[data-jp-theme-light="false"] ' if theme.dark else ""
    kinds = {
        "text": f"fill:{theme.ink};stroke:none;font-size:15px",
        ".is-grid": f"stroke:{theme.grid}",
        ".is-none": f"fill:{theme.faint};opacity:.2;stroke:none",
        ".is-printed": f"stroke:{theme.ink};stroke-width:2;stroke-dasharray:7 4",
        ".is-mended": f"stroke:{theme.kappa};stroke-width:2.4",
        "circle": f"fill:{theme.kappa};stroke:none",
        "circle.is-printed": f"fill:{theme.ink}",
        "circle.is-off": f"fill:{theme.tau}",
        ".is-off": f"stroke:{theme.tau};stroke-width:2",
        ".is-cursor": f"stroke:{theme.cursor};stroke-width:1.5",
    }
    return "".join(f"{where}.ruledlab-pm {kind}{{{rule}}}" for kind, rule in kinds.items())


STYLE = f"<style>.ruledlab-pm{{fill:none;width:100%;max-width:{WIDTH:.0f}px}}" + "".join(
    map(_rules, (LIGHT, DARK))
)
STYLE += "</style>"


def picture(made: Comparison, limits: Sequence[Limits], cursor: float, words: str) -> str:
    """Return both curves over t and their difference below, as SVG.

    Parameters
    ----------
    made
        the two curves.
    limits
        of the two frames.
    cursor
        the t that is marked.
    words
        the text alternative.
    """
    ((name, unit),) = made.names
    across = _across(made)
    curves = (
        (("is-mended", made.mended), ("is-printed", made.printed)),
        (("is-off", made.difference),),
    )
    frames = "".join(
        _frame(panel, limit, across, made.t, drawn, cursor)
        for panel, limit, drawn in zip(PANELS, limits, curves, strict=True)
    )
    legend = _legend(((LEFT, "is-printed", "as printed"), (LEFT + 150, "is-mended", "mended")))
    heads = _text(WIDTH - RIGHT, 20, f"{name} ({unit})", "end")
    heads += _text(LEFT, PANELS[1][0] - 8, f"printed − mended ({unit})")
    ticks = "".join(
        _text(_place(t, across, LEFT, WIDTH - RIGHT), FOOT + 17, text, "middle")
        for t, text in number_ticks(across, 6)
    )
    ticks += _text((LEFT + WIDTH - RIGHT) / 2, FOOT + 34, "t", "middle")
    return _svg(TALL, legend + heads + frames + ticks, words)


def flat(made: Comparison) -> Flat:
    """Return where a t is in the picture; its upper frame goes from 0 up to 1."""
    (top, height), area = PANELS[0], WIDTH - LEFT - RIGHT
    return Flat((WIDTH, TALL), (LEFT, top), (area, height), _across(made), Limits(0.0, 1.0))


def _across(made: Comparison) -> Limits:
    return Limits(float(made.t[0]), float(made.t[-1]))


def number_lines(made: Comparison, words: str) -> str:
    """Return each value as two marks on a line of numbers, as SVG."""
    parts = [_text(LEFT, 20, "□ as printed"), _text(LEFT + 150, 20, "● mended")]
    pairs = zip(made.names, made.printed, made.mended, strict=True)
    for row, ((name, unit), printed, mended) in enumerate(pairs):
        y = 66.0 + 74 * row
        limits = sticky_limits(np.array([0.0, printed, mended]))
        ends = LEFT, WIDTH - RIGHT
        x, x_mended = (float(_place(value, limits, *ends)) for value in (printed, mended))
        parts.append(f'<path class="is-grid" d="M{LEFT},{y}H{WIDTH - RIGHT}"/>')
        parts += [
            _text(_place(value, limits, *ends), y + 22, text, "middle")
            for value, text in number_ticks(limits, 6)
        ]
        parts.append(_text(WIDTH - RIGHT, y - 16, f"{name} ({unit})", "end"))
        if np.isfinite(x - x_mended):
            parts.append(f'<path class="is-off" d="M{x:.1f},{y}H{x_mended:.1f}"/>')
        if np.isfinite(x_mended):
            parts.append(f'<circle class="is-mended" cx="{x_mended:.1f}" cy="{y}" r="5"/>')
        if np.isfinite(x):
            parts.append(
                f'<rect class="is-printed" style="stroke-dasharray:none" x="{x - 8:.1f}" '
                f'y="{y - 8}" width="16" height="16"/>'
            )
    return _svg(40.0 + 74 * len(made.names), "".join(parts), words)


def _svg(height: float, inside: str, words: str) -> str:
    label = html.escape(words, quote=True)
    return (
        f'{STYLE}<svg class="ruledlab-pm" viewBox="0 0 {WIDTH:.0f} {height:.0f}" role="img" '
        f'aria-label="{label}">{inside}</svg>'
    )


def _frame(
    panel: tuple[float, float],
    limits: Limits,
    across: Limits,
    t: Array,
    drawn: Sequence[tuple[str, Array]],
    cursor: float,
) -> str:
    """Return one frame: grid, ranges without value, the curves, the cursor."""
    top, height = panel
    x = _place(t, across, LEFT, WIDTH - RIGHT)
    parts = [
        f'<path class="is-grid" d="M{LEFT},{y:.1f}H{WIDTH - RIGHT}"/>'
        + _text(LEFT - 8, y + 4.5, text, "end")
        for y, text in (
            (_place(value, limits, top + height, top), text)
            for value, text in number_ticks(limits, 5 if height > 150 else 3)
        )
    ]
    for low, high in {gap for _, curve in drawn for gap in undefined_ranges(t, curve)}:
        start, end = (_place(at, across, LEFT, WIDTH - RIGHT) for at in (low, high))
        parts.append(
            f'<rect class="is-none" x="{start:.1f}" y="{top}" width="{max(end - start, 3):.1f}" '
            f'height="{height}"/>'
        )
    inner = "".join(
        f'<path class="{kind}" d="{_path(x, curve, limits, height)}"/>' for kind, curve in drawn
    )
    view = f'x="0" y="{top}" width="{WIDTH}" height="{height}"'  # what goes beyond is cut off
    at = _place(cursor, across, LEFT, WIDTH - RIGHT)
    for kind, curve in drawn:
        y = _place(np.interp(cursor, t, curve), limits, height, 0.0)
        if 0.0 <= y <= height:  # not NaN, and in the frame
            inner += f'<circle class="{kind}" cx="{at:.1f}" cy="{y:.1f}" r="4"/>'
    parts.append(f'<path class="is-cursor" d="M{at:.1f},{top}V{top + height}"/>')
    parts.append(f'<svg {view} overflow="hidden">{inner}</svg>')
    return "".join(parts)


def _place(value: Any, limits: Limits, start: float, end: float) -> Any:
    return start + (value - limits.low) / limits.span * (end - start)


def _path(x: Array, curve: Array, limits: Limits, height: float) -> str:
    """Return a curve as a path, broken where it has no value and where it passes a pole."""
    y = np.clip(_place(curve, limits, height, 0.0), -4 * height, 5 * height)
    start = np.isnan(y)
    start[1:] |= np.isnan(y[:-1]) | at_poles(curve, limits)
    start[0] = True
    return "".join(
        f"{'M' if new else 'L'}{a:.1f},{b:.1f}"
        for new, a, b in zip(start.tolist(), x.tolist(), y.tolist(), strict=True)
        if b == b  # not NaN
    )


def at_poles(curve: Array, limits: Limits) -> Array:
    """Tell between which neighbours a curve leaves the frame above and comes back from below."""
    side = np.where(curve > limits.high, 1, np.where(curve < limits.low, -1, 0))
    return np.asarray(side[1:] * side[:-1] < 0)


def excursions(made: Comparison, limits: Limits) -> Iterator[str]:
    """Say where the curves leave their frame, and where they pass a pole."""
    for which, curve in (("as printed", made.printed), ("mended", made.mended)):
        poles = np.flatnonzero(at_poles(curve, limits))
        if poles.size:
            where = ", ".join(said(made.t[i : i + 2].mean(), 3) for i in poles[:4])
            yield f"The curve {which} passes a pole (a denominator changes sign) near t = {where}."
        elif found := peaks(made.t, curve, limits):
            (at, value), *_ = found
            far = f"at t = {said(at, 3)} it is {said(value, 4)}"
            yield f"The curve {which} leaves the frame; {far}."


def _text(x: float, y: float, text: str, anchor: str = "start") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{html.escape(text)}</text>'


def _legend(entries: Sequence[tuple[float, str, str]]) -> str:
    return "".join(
        f'<path class="{kind}" d="M{x:.0f},16h34"/>' + _text(x + 42, 20, words)
        for x, kind, words in entries
    )
