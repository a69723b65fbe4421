"""A congruence around one design, as plain arrays to draw and in words: no widgets here."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import numpy.typing as npt

from ...geometry import Congruence
from ...geometry.checks import Array
from ..overlay import Dot, Label, Overlay, Sheet, Stroke
from ..scene import Mark, Scene

__all__ = [
    "LOOKS",
    "Lines",
    "Place",
    "counts_words",
    "focal_surfaces",
    "grid",
    "highlighted",
    "lines",
    "place",
    "place_words",
    "said",
    "sight",
    "window",
]

FINE: Final = 25
"""Places each way at which the focal surfaces are drawn."""

MESH: Final = 4
"""Of so many rows and columns of a focal surface one is drawn as a curve, too: where a surface has
shrunk to a curve, the curve is seen."""

REACH: Final = 4.0
"""Nothing is drawn farther from the middle than this many lengths of a line."""

NARROWEST: Final = 1.4
OFF_POLES: Final = 0.3
STEP: Final = math.pi / 16
"""The window changes in steps of this, so that it stays while the curve moves a little."""

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
    ends
        (2, 2) the window: where the grid begins and ends in u and in v.
    kinds, divergence
        (count, count) of the lines of the grid, u along the first axis.
    """

    strokes: tuple[Stroke, ...]
    counts: dict[str, int]
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
    begin, end = (middle - half) / STEP, (middle + half) / STEP
    # Halves, because control points often stand at round places: no sign is to be below one.
    ends = STEP * (np.stack([np.floor(begin + 0.5), np.ceil(end - 0.5)], axis=1) + [-0.5, 0.5])
    ends[0, 1] = min(ends[0, 1], ends[0, 0] + 2.0 * math.pi)
    low, high = known[:, 1].min(), known[:, 1].max()
    if low >= 0.0 and high <= math.pi:
        ends[1] = np.clip(ends[1], min(low, OFF_POLES), max(high, math.pi - OFF_POLES))
    return ends


def lines(congruence: Congruence, scene: Scene, count: int) -> Lines:
    """Return ``count`` × ``count`` lines about a scene, each drawn about its focal midpoint."""
    ends, length = window(scene.chart), float(np.ptp(scene.w))
    far = REACH * length
    u, v = grid(ends, count)
    x, focal = congruence.line(u, v), congruence.focal(u, v)
    along = focal.midpoint[:, None] + length * np.array([-0.5, 0.5])
    pieces = x.foot[:, None] + along[..., None] * x.direction[:, None]
    pieces[np.linalg.norm(pieces - scene.centre, axis=-1).max(axis=1) > far] = np.nan
    counts = {kind: int((focal.kind == kind).sum()) for kind in (*LOOKS, "undefined")}
    strokes = tuple(
        Stroke(_pieces(pieces[focal.kind == kind]), LOOKS[kind], 1.3, kind == "elliptic",
               name=kind)
        for kind in LOOKS if counts[kind]
    )  # fmt: skip
    square = (count, count)
    divergence = congruence.divergence(u, v).reshape(square)
    return Lines(strokes, counts, ends, focal.kind.reshape(square), divergence)


def focal_surfaces(congruence: Congruence, scene: Scene) -> Overlay:
    """Return the two focal surfaces over the window of a scene, as far as they are near."""
    net = congruence.focal(*grid(window(scene.chart), FINE)).points
    far = np.linalg.norm(net - scene.centre, axis=-1) > REACH * float(np.ptp(scene.w))
    net = np.where(far[..., None], np.nan, net).reshape(FINE, FINE, 2, 3)
    sheets, strokes = [], []
    for k, name in enumerate(("first focal surface", "second focal surface")):
        places = net[:, :, k]
        sheets.append(Sheet(places, "kappa", 0.3, name))
        for rows in (places[::MESH], places.swapaxes(0, 1)[::MESH]):
            strokes.append(Stroke(_pieces(rows), "kappa", 1.6, name=name))
    return Overlay(tuple(strokes), (), tuple(sheets))


def _pieces(rows: Array) -> Array:
    """Return the rows as one stroke, which is lifted off between them."""
    return np.concatenate([rows, np.full((len(rows), 1, 3), np.nan)], axis=1).reshape(-1, 3)


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


def grid(ends: Array, count: int) -> tuple[Array, Array]:
    """Return u and v of ``count`` × ``count`` places over a window, u first: flat arrays."""
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


def said(value: float) -> str:
    """Return a number for a sentence: four digits, what rounding leaves of 0 as 0."""
    value = 0.0 if abs(value) < 5e-12 else float(value)
    return f"{value:.4g}".replace("-", "−")
