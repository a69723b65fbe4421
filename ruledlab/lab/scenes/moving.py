"""A line that moves: surfaces from a base curve or from dual lines, and a ruling's neighbour.

The state of lesson 3 and what it shows, as plain arrays and words. No widget is imported here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from ...design import Design
from ...geometry import gallery
from ...geometry.checks import Array, GeometryError
from ...geometry.dual import Dual
from ...geometry.series import Series
from ...geometry.surface import RuledSurface
from ...geometry.vector import vector
from ..axes import SUPERSCRIPT
from ..overlay import Dot, Label, Overlay, Stroke
from ..scene import Scene, build_scene, plain_scene
from ..slate import Change, Slate
from .shrinking import ahead

__all__ = ["STARTS", "Motion", "Moved", "Moving", "Near", "near", "picture", "start", "words"]

Kind = Literal["base", "lines", "gallery"]
SAMPLES = 240
LENGTH = 3.0
TURN = (0.0, 2.0 * math.pi)


@dataclass(frozen=True, slots=True)
class Moving:
    """What the reader has chosen.

    Attributes
    ----------
    kind
        ``"base"``: r = c(t) + w x(t), with ``first`` and ``second`` the typed c and x;
        ``"lines"``: X(t) = x(t) + ε x̄(t), with the typed x and x̄;
        ``"gallery"``: the gallery's surface with the key ``first``.
    first, second
        see there.
    a
        the constant a of the formulas.
    domain
        first and last t of typed formulas.
    slide
        s: the base curve is c + s x.
    exponent
        the neighbour is the ruling at t + h with h = 10 to this power.
    """

    kind: Kind
    first: str
    second: str = ""
    a: float = 0.5
    domain: tuple[float, float] = TURN
    slide: float = 0.0
    exponent: float = -0.3

    @property
    def h(self) -> float:
        """The step to the neighbour."""
        return float(10.0**self.exponent)

    @property
    def shape(self) -> tuple[object, ...]:
        """What the surface depends on."""
        return self.kind, self.first, self.second, self.a, self.domain


@dataclass(frozen=True, slots=True)
class Start:
    """A surface of the menu: its key, its title, where to begin, and what is known of it."""

    key: str
    title: str
    moving: Moving
    note: str


def _started() -> tuple[Start, ...]:
    circle, round_about = "cos(t), sin(t), 0", "a*sin(t), -a*cos(t), 1"
    typed = (
        Start(
            "helicoid",
            "c, x: right helicoid over a helix",
            Moving("base", "cos(t), sin(t), a*t", circle),
            "The rulings are the principal normals of the helix c. All of them meet the z-axis at "
            "right angles, and the axis is the striction curve: δ = a.",
        ),
        Start(
            "oblique",
            "c, x: oblique helicoid",
            Moving("base", "0, 0, a*t", "cos(t), sin(t), 1"),
            "The rulings climb by a for each radian and meet the z-axis at the angle π/4: δ = a, "
            "whatever that angle is, and the axis is the striction curve.",
        ),
        Start(
            "tangents",
            "c, x: tangents of a helix",
            Moving("base", "cos(t), sin(t), a*t", "-sin(t), cos(t), a"),
            "The tangents of a curve: δ = 0, and the curve is its own striction curve. "
            "Neighbours come much nearer to each other than h.",
        ),
        Start(
            "waist",
            "c, x: hyperboloid, a = 0 is a cylinder",
            Moving("base", circle, round_about, a=1.0),
            "x² + y² − a² z² = 1 with the waist c as its striction curve and δ = 1/a. "
            "With a → 0 the rulings become parallel and δ grows beyond all bounds; at a = 0, on "
            "the cylinder, neither δ nor the striction curve is defined.",
        ),
        Start(
            "circle",
            "c, x: the same hyperboloid, another circle",
            Moving("base", "cos(t) + a/2*sin(t), sin(t) - a/2*cos(t), 1/2", round_about, a=1.0),
            "The same lines through the points of another circle, at the height ½. The surface, "
            "its striction curve and all of its invariants are those of the hyperboloid.",
        ),
        Start(
            "paraboloid",
            "c, x: hyperbolic paraboloid z = a x y",
            Moving("base", "t, 0, 0", "0, 1, a*t", a=1.0, domain=(-1.5, 1.5)),
            "c is one ruling of the other family, and it is the striction curve: "
            "δ = (1 + a² t²)/a.",
        ),
        Start(
            "band",
            "c, x: Möbius band",
            Moving("base", circle, "cos(t/2)*cos(t), cos(t/2)*sin(t), sin(t/2)"),
            "The middle circle c of the band is not its striction curve. After one turn the "
            "ruling is back with the opposite direction.",
        ),
        Start(
            "lines",
            "X: right helicoid as a dual curve",
            Moving("lines", circle, "-a*t*sin(t), a*t*cos(t), 0"),
            "X = (cos t̂, sin t̂, 0) with t̂ = t + ε a t: a great circle, run through with the dual "
            "speed 1 + ε a, so that δ = a. The base curve is c = x × x̄, here the axis.",
        ),
        Start(
            "conoid",
            "X: Plücker's conoid as a dual curve",
            Moving("lines", circle, "-a*sin(2*t)*sin(t), a*sin(2*t)*cos(t), 0", a=1.0),
            "X = (cos t̂, sin t̂, 0) with t̂ = t + ε a sin 2t: the same great circle with a changing "
            "dual speed. δ = 2a cos 2t is zero at four rulings.",
        ),
    )
    ready = (
        Start(entry.key, entry.title, Moving("gallery", entry.key, exponent=-1.3), entry.note)
        for entry in gallery.GALLERY
    )
    return (*typed, *ready)


STARTS = _started()
"""The menu: surfaces with formulas to change, then those of the gallery."""


def start(moving: Moving) -> Start | None:
    """Return the entry of the menu with these formulas, whatever a, s and h are."""
    same = (s for s in STARTS if replace(s.moving, a=moving.a).shape == moving.shape)
    return next(same, None)


# -- the surface -----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Moved:
    """What follows from a `Moving`: the surface, the base curve for s = 0, and the picture."""

    moving: Moving
    surface: RuledSurface
    base: Callable[[Array], Array]
    scene: Scene
    length: float


@np.errstate(all="ignore")
def moved(moving: Moving) -> Moved:
    """Return what follows from a choice.

    Raises
    ------
    GeometryError
        where a formula cannot be read, or gives no line.
    """
    if moving.kind == "gallery":
        return _from_gallery(moving)
    first = vector(moving.first, FIRST[moving.kind][1], moving.a)
    second = vector(moving.second, SECOND[moving.kind][1], moving.a)
    if moving.kind == "base":
        surface = RuledSurface.from_base(first, second, moving.domain)
        places = np.linspace(*moving.domain, SAMPLES)
        rows = _derivatives(first, places)
        scene = _scene(surface, places, rows[0], rows[1])
        return Moved(moving, surface, lambda t: _derivatives(first, t)[0], scene, LENGTH)
    surface = RuledSurface.from_lines(_dual(first, second), moving.domain)
    places = np.linspace(*moving.domain, SAMPLES)
    sample = surface.sample(places)
    scene = _scene(surface, places, sample.foot, sample.foot_rate)
    return Moved(moving, surface, surface.foot, scene, LENGTH)


FIRST = {"base": ("c(t)", "base curve"), "lines": ("x(t)", "direction")}
SECOND = {"base": ("x(t)", "direction"), "lines": ("x̄(t)", "moment")}
"""How the two typed vectors are called: the symbol, and the name in messages."""


def _from_gallery(moving: Moving) -> Moved:
    entry = gallery.example(moving.first)
    design = Design(entry.points, entry.ubar, entry.vbar, closing=entry.closing, samples=SAMPLES)
    surface = design.surface()
    scene = build_scene(design, surface, closed=False)
    return Moved(moving, surface, surface.foot, scene, design.length)


def _derivatives(function: Callable[[Any], tuple[Any, ...]], t: Array) -> Array:
    """Return (2, …, 3) the values and the derivatives of a typed vector at t."""
    places = np.asarray(t, dtype=float)
    parts = function(Series.variable(places, 1))
    zero = np.zeros((2, *places.shape))
    rows = [
        part.derivatives() if isinstance(part, Series) else np.stack([zero[0] + part, zero[1]])
        for part in parts
    ]
    return np.stack(rows, axis=-1)


def _dual(x: Callable[[Any], Any], moment: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return t ↦ x(t) + ε x̄(t)."""
    return lambda t: tuple(Dual(a, b) for a, b in zip(x(t), moment(t), strict=True))


def _scene(surface: RuledSurface, t: Array, base: Array, rate: Array) -> Scene:
    if not np.isfinite(base).all(axis=1).any():
        raise GeometryError("the base curve must be defined somewhere; change its formulas")
    return plain_scene(surface.sample(t), base, rate, LENGTH)


# -- one ruling and its neighbour ------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Near:
    """The ruling X(t), its neighbour X(t + h), and how they lie to each other.

    Attributes
    ----------
    t, h
        the place and the step.
    base, striction
        (3,) the points c + s x and m of the ruling.
    direction, beyond
        (3,) the unit directions of X(t) and X(t + h).
    foot, far_foot
        (3,) the feet of the common perpendicular, on X(t) and on X(t + h).
    distance, angle
        signed shortest distance and angle of the two rulings.
    ratio
        distance/angle; NaN for parallel rulings.
    delta
        δ at t.
    off
        ‖foot − m‖.
    along
        ⟨m − c − s x, x⟩: where the striction point is, seen from the base curve.
    reasons
        why something is undefined.
    """

    t: float
    h: float
    base: Array
    striction: Array
    direction: Array
    beyond: Array
    foot: Array
    far_foot: Array
    distance: float
    angle: float
    ratio: float
    delta: float
    off: float
    along: float
    reasons: tuple[str, ...]


@np.errstate(all="ignore")
def near(result: Moved, t: float) -> Near:
    """Compare the ruling at t with the one at t + h, on a closed surface round the seam."""
    surface, h = result.surface, result.moving.h
    place = float(ahead(surface, t, h))
    sample, both = surface.sample(t), surface.line(np.array([t, place]))
    common = surface.neighbours(t, place - t)
    angle, distance = float(common.angle), float(common.distance)
    parallel = not np.sin(angle) > 1e-9  # no foot is nearer to m than another
    foot, far = (np.full(3, np.nan) if parallel else f for f in (common.foot_a, common.foot_b))
    x, m = sample.direction, sample.striction
    base = result.base(np.asarray(t)) + result.moving.slide * x
    return Near(
        t=t,
        h=h,
        base=base,
        striction=m,
        direction=x,
        beyond=both.direction[1],
        foot=foot,
        far_foot=far,
        distance=distance,
        angle=angle,
        ratio=distance / angle if angle and not parallel else math.nan,
        delta=float(sample.invariants.delta),
        off=float(np.linalg.norm(foot - m)),
        along=float((m - base) @ x),
        # Of the invariants this lesson shows δ alone.
        reasons=tuple(r.reason for r in sample.invariants.undefined if "delta" in r.names),
    )


@np.errstate(all="ignore")
def picture(result: Moved, pair: Near) -> Overlay:
    """Return the base curve, both rulings and their common perpendicular, to be drawn."""
    scene, s = result.scene, result.moving.slide
    base = result.base(scene.t) + s * scene.direction
    half = 0.6 * result.length
    middle = pair.base - s * pair.direction if result.moving.kind != "gallery" else pair.striction
    middle = np.where(np.isfinite(middle), middle, pair.base)
    first = _piece(middle, pair.direction, half, (pair.base, pair.striction, pair.foot))
    beside = np.where(np.isfinite(pair.far_foot), pair.far_foot, middle)
    centre = beside + ((middle - beside) @ pair.beyond) * pair.beyond
    second = _piece(centre, pair.beyond, half, (pair.far_foot,))
    if not np.isfinite(pair.far_foot).all():  # parallel: no foot to begin from
        other = result.surface.line(float(ahead(result.surface, pair.t, pair.h)))
        second = _piece(other.point((middle - other.foot) @ other.direction), pair.beyond, half, ())
    between = np.stack([pair.foot, pair.far_foot])
    return Overlay(
        strokes=(
            Stroke(base, "kappa", 3.0, dashed=True, name="base curve"),
            Stroke(second, "tau", 3.0, name="neighbour"),
            Stroke(first, "cursor", 3.0, name="ruling"),
            Stroke(between, "delta", 4.0, name="perpendicular"),
        ),
        dots=(
            Dot(pair.base, "kappa", 10.0, name="base point"),
            Dot(pair.striction, "sigma", 12.0, name="striction point"),
            Dot(pair.foot, "delta", 15.0, ring=True, name="foot"),
            Dot(pair.far_foot, "delta", 9.0, ring=True, name="far foot"),
        ),
        labels=(
            Label(first[-1], "X(t)", "cursor"),
            Label(second[0], "X(t+h)", "tau"),
            Label(pair.base, "c", "kappa"),
            Label(pair.striction, "m", "sigma"),
        ),
    )


def _piece(middle: Array, x: Array, half: float, points: tuple[Array, ...]) -> Array:
    """Return (2, 3) the ends of a piece of a line about a point that also holds other points."""
    places = [float((point - middle) @ x) for point in points]
    kept = [w for w in places if abs(w) < 4 * half]  # nor NaN
    ends = min([-half, *kept]), max([half, *kept])
    return np.stack([middle + w * x for w in ends])


def words(result: Moved, pair: Near) -> str:
    """Say in words what the picture shows."""
    found = start(result.moving)
    title = found.title.removeprefix("c, x: ").removeprefix("X: ") if found else "typed formulas"
    how = f"Ruled surface ({title}), with its base curve dashed and its striction curve."
    lying = (
        f"At t = {pair.t:.3f} the ruling and its neighbour at t + {pair.h:.4g} enclose the angle "
        f"{said(pair.angle)} and are {said(pair.distance, 1e-12)} apart: distance by angle is "
        f"{said(pair.ratio)}, δ is {said(pair.delta)}. The foot of their common perpendicular is "
        f"{said(pair.off)} from the striction point, which lies at {said(pair.along)} along the "
        "ruling from the base curve."
    )
    return " ".join([how, lying, *(f"{reason}." for reason in pair.reasons)])


def said(value: float, zero: float = 1e-9) -> str:
    """Return a number for a reader; undefined is a dash.

    Six digits after the point; small numbers as a multiple of a power of 10, so that their order
    can be read; below ``zero`` it is rounding.
    """
    if not math.isfinite(value):
        return "–"
    if zero <= abs(value) < 1e-3:
        digits, power = f"{value:.3e}".split("e")
        text = f"{digits}·10{str(int(power)).translate(SUPERSCRIPT)}"
    else:
        text = f"{value:.6f}" if abs(value) < 1e5 else f"{value:.4g}"
    return text.replace("-0.000000", "0.000000").replace("-", "−")


# -- the state -------------------------------------------------------------------------------------


class Motion(Slate[Moving, Moved]):
    """The state of lesson 3: a `Moving`, what follows from it, and a cursor t.

    Attributes
    ----------
    near
        the ruling at the cursor and its neighbour.
    """

    def __init__(self, moving: Moving, cursor: float = 1.0) -> None:
        super().__init__(moving, moved)
        self._part = self._part_at(cursor)
        self.near = near(self._result, self.cursor)

    @property
    def cursor(self) -> float:
        """The t that is looked at."""
        first, last = self._result.surface.domain
        return first + self._part * (last - first)

    def move_cursor(self, t: float) -> None:
        """Look at another t, kept inside the domain; it keeps its part of another domain."""
        with self._lock:
            part = self._part_at(t)
            if part != self._part:
                self._part = part
                self.near = near(self._result, self.cursor)
                self._tell(Change(mark=True))

    def _part_at(self, t: float) -> float:
        first, last = self._result.surface.domain
        return (min(max(float(t), first), last) - first) / (last - first)

    def _accept(self, value: Moving, source: str, loaded: bool) -> Change:
        """Keep the surface and its picture where only s or h changed."""
        old = self._result
        result = replace(old, moving=value) if old.moving.shape == value.shape else moved(value)
        first, last = result.surface.domain
        pair = near(result, first + self._part * (last - first))
        self._value, self._result, self.near = value, result, pair
        return Change(scene=True, mark=True, source=source, loaded=loaded)
