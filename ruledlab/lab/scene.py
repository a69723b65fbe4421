"""What there is to draw, as plain arrays: the only thing a view ever sees.

A `Scene` is everything that depends on the design, a `Mark` everything that depends on the cursor.
No plotting library is imported here, and no view computes geometry of its own.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from itertools import groupby

import numpy as np

from ..design import Design
from ..geometry.checks import Array
from ..geometry.line import on_sphere
from ..geometry.surface import Invariants, RuledSurface, Sample, Undefined, curvature_along


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """One design, sampled.

    Attributes
    ----------
    t
        (T,) parameter values.
    chart
        (T, 2) the curve (u, v) in radians.
    control
        (n+1, 2) control points in the chart.
    control_directions
        (n+1, 3) the same points on the unit sphere.
    direction, direction_rate
        (T, 3) unit direction x of each ruling and x′.
    base, base_rate
        (T, 3) the point of each ruling from which w is drawn, and its derivative.
    striction
        (T, 3) the striction point m.
    w
        (2,) the ends of the drawn rulings, measured from ``base``.
    curves
        name of an invariant (``kappa``, ``kappa_bar``, ``tau``, ``tau_bar``, ``sigma``, ``delta``)
        to its (T,) values; NaN where undefined. ``sigma`` is unwrapped.
    gaps
        sentences that say where and why values are undefined.
    colour
        (T, W) scalar the surface is coloured by, NaN where undefined, or None for plain.
    colour_label
        name of that scalar with its unit, as text.
    centre, radius
        a ball that holds most of the drawing, for framing.
    closed
        whether the last ruling is the first again (as a line).
    text
        the whole scene in words, for who cannot see the picture.

    All arrays are read-only: several views hold the same ones.
    """

    t: Array
    chart: Array
    control: Array
    control_directions: Array
    direction: Array
    direction_rate: Array
    base: Array
    base_rate: Array
    striction: Array
    w: Array
    curves: dict[str, Array]
    gaps: tuple[str, ...]
    colour: Array | None
    colour_label: str
    centre: Array
    radius: float
    closed: bool
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class Mark:
    """The cursor: one ruling and its frame.

    Attributes
    ----------
    t
        the parameter.
    chart
        (2,) the point (u, v).
    base, striction
        (3,) as in `Scene`, at t.
    frame
        (3, 3) rows x₁, x₂, x₃; NaN rows where undefined.
    values
        invariant name to value at t.
    text
        the same in words.

    All arrays are read-only.
    """

    t: float
    chart: Array
    base: Array
    striction: Array
    frame: Array
    values: dict[str, float]
    text: str


COLOURINGS = {
    "plain": "",
    "delta": "δ, distribution parameter (length)",
    "gauss": "K, Gauss curvature (1/length²)",
    "mean": "H, mean curvature (1/length)",
}
"""What the surface may be coloured by, and the words under its colour bar."""

ACROSS = 25
"""Places along a ruling at which K and H are coloured."""

DRAWN = ("kappa", "kappa_bar", "tau", "tau_bar", "sigma", "delta")
FARTHEST = 1e100
"""Points farther out are not part of the picture: no canvas has room, and their squares overflow.
"""

MOST_PLACES = 4
"""How many stretches of undefined values are named one by one."""

SYMBOLS = dict(zip(DRAWN, ("κ", "κ̄", "τ", "τ̄", "σ", "δ"), strict=True))


@np.errstate(all="ignore")
def build_scene(
    design: Design, surface: RuledSurface, closed: bool, colouring: str = "plain"
) -> Scene:
    """Sample a design for drawing."""
    t = np.linspace(*surface.domain, design.samples)
    sample = surface.sample(t)
    base, base_rate = _base(design, sample, sample.striction)
    plain = plain_scene(sample, base, base_rate, design.length)
    control = np.array(design.points)
    colour = _colour(colouring, sample.invariants, base, plain.striction, plain.direction, plain.w)
    scene = replace(
        plain,
        chart=surface.curve.series(t, 0).value.T,
        control=control,
        control_directions=on_sphere(control),
        colour=colour,
        colour_label=COLOURINGS[colouring],
        closed=closed,
        text=" ".join(
            [
                _surface_text(design, plain.curves, closed),
                _drawing_text(design, COLOURINGS[colouring], colour),
                *plain.gaps,
            ]
        ),
    )
    _lock(scene)
    return scene


@np.errstate(all="ignore")
def plain_scene(sample: Sample, base: Array, base_rate: Array, length: float) -> Scene:
    """Return the picture of any sampled surface: no chart, no control points, no colour.

    Parameters
    ----------
    sample
        rulings at increasing t.
    base, base_rate
        (T, 3) the points that the drawn rulings are centred on, and their derivative by t.
    length
        the length of the drawn rulings.
    """
    invariants, x, t = sample.invariants, sample.direction, sample.invariants.t
    w = np.array([-0.5, 0.5]) * length
    curves = {name: getattr(invariants, name) for name in DRAWN}
    curves["sigma"] = unwrapped(curves["sigma"])
    centre, radius = _ball(base, x, w)
    scene = Scene(
        t=t,
        chart=np.zeros((0, 2)),
        control=np.zeros((0, 2)),
        control_directions=np.zeros((0, 3)),
        direction=x,
        direction_rate=sample.direction_rate,
        base=base,
        base_rate=base_rate,
        striction=sample.striction,
        w=w,
        curves=curves,
        gaps=tuple(_gap(report, t) for report in invariants.undefined),
        colour=None,
        colour_label="",
        centre=centre,
        radius=radius,
        closed=False,
        text=f"Ruled surface over t: {in_ranges(curves)}.",
    )
    _lock(scene)
    return scene


@np.errstate(all="ignore")
def build_mark(design: Design, surface: RuledSurface, t: float) -> Mark:
    """Sample a design at the cursor."""
    sample = surface.sample(t)
    invariants, m = sample.invariants, sample.striction
    values = {name: float(getattr(invariants, name)) for name in DRAWN}
    chart = surface.curve.series(np.asarray(t), 0).value
    mark = Mark(
        t=t,
        chart=chart,
        base=m if design.base == "striction" else sample.foot,
        striction=m,
        frame=sample.frame,
        values=values,
        text=_mark_text(t, chart, values, [report.reason for report in invariants.undefined]),
    )
    _lock(mark)
    return mark


def _lock(drawing: Scene | Mark) -> None:
    """Make the arrays read-only: what one view did to them the others would draw."""
    values = [getattr(drawing, entry.name) for entry in fields(drawing)]
    for value in [*values, *getattr(drawing, "curves", {}).values()]:
        if isinstance(value, np.ndarray):
            value.flags.writeable = False


def unwrapped(angle: Array) -> Array:
    """Return the angle without its jumps of 2π; gaps stay gaps."""
    known = np.isfinite(angle)
    result = angle.copy()
    result[known] = np.unwrap(angle[known])
    return result


def _base(design: Design, sample: Sample, m: Array) -> tuple[Array, Array]:
    """Return the points that w is drawn from, and their derivative by t."""
    if design.base == "foot":
        return sample.foot, sample.foot_rate
    frame, found = sample.frame, sample.invariants
    return m, found.tau_bar[:, None] * frame[:, 0] + found.kappa_bar[:, None] * frame[:, 2]


def _colour(
    colouring: str,
    invariants: Invariants,
    base: Array,
    m: Array,
    x: Array,
    w: Array,
) -> Array | None:
    if colouring == "plain":
        return None
    if colouring == "delta":
        return invariants.delta[:, None]
    # K and H are known over m + w x; the drawing may be centred elsewhere on the ruling.
    shift = np.einsum("ti,ti->t", base - m, x)[:, None]
    places = np.linspace(w[0], w[1], ACROSS) + np.nan_to_num(shift)
    forms = curvature_along(invariants, places)
    return forms.gauss if colouring == "gauss" else forms.mean


def _ball(base: Array, x: Array, w: Array) -> tuple[Array, float]:
    """Return a ball about the bulk of the drawing; a few far-off rulings do not count."""
    ends = np.concatenate([base + end * x for end in w])
    ends = ends[(np.abs(ends) <= FARTHEST).all(axis=1)]  # nor NaN
    if not len(ends):
        return np.zeros(3), 1.0
    low, high = np.percentile(ends, [4.0, 96.0], axis=0)
    centre = 0.5 * (low + high)
    radius = float(np.percentile(np.linalg.norm(ends - centre, axis=1), 92.0))
    return centre, max(radius, 0.05 * float(w[1] - w[0]), 1e-6)


def _gap(report: Undefined, t: Array) -> str:
    """Say where and why some curves have a gap."""
    names = ", ".join(SYMBOLS[name] for name in DRAWN if name in report.names)
    return f"{names} undefined at {_places(t, report.where)}. {_sentence(report.reason)}"


def _places(t: Array, where: Array) -> str:
    """Name the stretches of t where something holds: ``t = 0, 0.2 … 0.3``."""
    runs = [list(run) for holds, run in groupby(range(len(t)), where.__getitem__) if holds]
    named = [
        f"{t[run[0]]:.4g}" + (f" … {t[run[-1]]:.4g}" if len(run) > 1 else "")
        for run in runs[:MOST_PLACES]
    ]
    more = len(runs) - MOST_PLACES
    return f"t = {', '.join(named)}" + (f" and {more} more places" if more > 0 else "")


def _sentence(reason: str) -> str:
    """Return a reason as a sentence; a symbol at its beginning keeps its case: κ is not Κ."""
    first = reason[0].upper() if reason[0].isascii() else reason[0]
    return f"{first}{reason[1:]}."


def _surface_text(design: Design, curves: dict[str, Array], closed: bool) -> str:
    degree = len(design.points) - 1
    return (
        f"Ruled surface of a Bézier curve of degree {degree} in the chart of the unit sphere, with "
        f"ū = {design.ubar} and v̄ = {design.vbar}; its last ruling is "
        f"{'the first again' if closed else 'not the first'}. Over t: {in_ranges(curves)}."
    )


def in_ranges(curves: dict[str, Array]) -> str:
    """Say from where to where each invariant goes."""
    return "; ".join(f"{SYMBOLS[name]} {_range(values)}" for name, values in curves.items())


def _drawing_text(design: Design, label: str, colour: Array | None) -> str:
    base = "the striction curve" if design.base == "striction" else "the foot points"
    rulings = f"Drawn with rulings of length {design.length:g} centred on {base}."
    return rulings if colour is None else f"{rulings} The colour is {label}: {_range(colour)}."


def _range(values: Array) -> str:
    known = values[np.isfinite(values)]
    if not len(known):
        return "is undefined"
    low, high = f"{known.min():.4g}", f"{known.max():.4g}"
    return f"is {low} throughout" if low == high else f"from {low} to {high}"


def _mark_text(t: float, chart: Array, values: dict[str, float], reasons: list[str]) -> str:
    numbers = [
        f"{SYMBOLS[name]} = {value:.4f}" if np.isfinite(value) else f"{SYMBOLS[name]} undefined"
        for name, value in values.items()
    ]
    place = f"At t = {t:.3f}, (u, v) = ({chart[0]:.4f}, {chart[1]:.4f}): "
    return " ".join([place + ", ".join(numbers) + ".", *map(_sentence, reasons)])
