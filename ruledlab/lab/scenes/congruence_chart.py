"""The grid of a congruence on the chart: a sign for each line, a legend, and what they say."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from ...geometry.checks import Array
from ..palette import Theme
from ..signs import Signs
from .congruence import LOOKS, Lines, counts_words, grid, said

__all__ = ["NOTE", "chart_signs", "legend_html"]

DARKEST, SHADES = 0.21, 6
"""How dark a tile gets, and in how many steps."""

NOTE: Final = (
    '<div class="ruledlab-note">Each sign is a line of the grid. Its colour is the kind; the sign '
    "is that of the divergence, and the shade below it says how large that is. Drag across the "
    "empty chart to look at another line.</div>"
)


def chart_signs(found: Lines) -> Signs:
    """Return one sign for each line of a grid that is defined.

    Its colour says the kind of the line, the sign that of the divergence there, and the shade of
    the tile below it how large the divergence is, compared with the others.
    """
    count = len(found.kinds)
    there = np.isin(found.kinds, list(LOOKS)) & np.isfinite(found.divergence)
    tile = np.ptp(found.ends, axis=1) / (count - 1)
    return Signs(
        np.stack(grid(found.ends, count), axis=1)[there.ravel()],
        "".join(_sign_of(found.divergence)[there]),
        tuple(LOOKS[kind] for kind in found.kinds[there]),
        _shades(found.divergence)[there],
        (float(tile[0]), float(tile[1])),
        _words(found),
    )


def _shades(divergence: Array) -> Array:
    """Return the opacity of the tiles; the greatest few values do not make the others pale."""
    size = np.abs(divergence)
    known = size[np.isfinite(size)]
    most = float(np.quantile(known, 0.95)) if known.size else 0.0
    if most < 1e-9:
        return np.zeros_like(size)
    steps = np.ceil(SHADES * np.clip(np.nan_to_num(size) / most, 0.0, 1.0) - 1e-9)
    return steps * (DARKEST / SHADES)


def _sign_of(divergence: Array) -> npt.NDArray[np.str_]:
    """Return the signs; what rounding leaves of 0 has none."""
    most = max(float(np.abs(np.nan_to_num(divergence)).max(initial=0.0)), 1.0)
    found = np.where(np.abs(divergence) <= 1e-9 * most, 0.0, np.sign(np.nan_to_num(divergence)))
    signs: npt.NDArray[np.str_] = np.array(["−", "0", "+"])[found.astype(int) + 1]
    return signs


def _words(found: Lines) -> str:
    known = found.divergence[np.isfinite(found.divergence)]
    if not known.size:
        return f"The chart around the curve: {counts_words(found.counts)}. No divergence here."
    low, high = said(known.min()), said(known.max())
    return (
        f"The chart around the curve, with one sign for each line of the grid: "
        f"{counts_words(found.counts)}. The divergence lies between {low} and {high}."
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
