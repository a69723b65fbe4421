"""Named surfaces with what is known of them: the classical ones, the paper's two, and free designs.

Each is a Bézier curve in the chart of the sphere and a choice of ū and v̄, so each can be opened,
pulled at and spoilt like any other design.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .checks import GeometryError
from .curve import Bezier
from .surface import RuledSurface

__all__ = ["GALLERY", "Example", "example", "names", "surface"]

Points = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Example:
    """A named surface.

    Attributes
    ----------
    key
        short name for files and code.
    title
        what a menu shows.
    points
        control points (u, v) in radians.
    ubar, vbar
        ū and v̄ as typed formulas.
    closing
        how the control polygon meets itself, u and u + 2π being the same: ``"open"``, ``"C0"``,
        ``"C1"`` or ``"C2"``. The surface closes too only if ū and v̄ return to their values.
    note
        what is known of it, in a sentence or two; lengths in the unit of ū and v̄.
    """

    key: str
    title: str
    points: Points
    ubar: str
    vbar: str
    closing: Literal["open", "C0", "C1", "C2"]
    note: str


def _pi(over: int, *points: tuple[int, int]) -> Points:
    """Return points (aπ/over, bπ/over): the doubles that a typed ``a*pi/over`` gives."""
    return tuple((math.pi * a / over, math.pi * b / over) for a, b in points)


LOOP = _pi(8, (1, 2), (1, 3), (3, 3), (3, 2), (3, 1), (1, 1), (1, 2))

GALLERY: tuple[Example, ...] = (
    Example(
        "cone",
        "Cone",
        LOOP,
        "1",
        "0",
        "C1",
        "Every ruling passes through the apex (0, 0, 1): κ̄ = τ̄ = 0, the striction curve is this "
        "one point and σ is undefined. The pitch is 0; the angle of pitch is that of Example 2, "
        "which has the same spherical image.",
    ),
    Example(
        "right_helicoid",
        "Right helicoid",
        _pi(2, (0, 1), (4, 1)),
        "0.5*u",
        "0",
        "C2",
        "One turn about the z-axis, climbing 0.5 for each radian: δ = 0.5, τ = τ̄ = 0 and σ = π/2, "
        "the axis is the striction curve and H = 0 everywhere. The directions close, the surface "
        "does not: it has climbed by π.",
    ),
    Example(
        "oblique_helicoid",
        "Oblique helicoid",
        _pi(3, (0, 1), (6, 1)),
        "0.5*u",
        "0",
        "C2",
        "Every ruling meets the z-axis at the angle π/3: δ = 0.5 and σ = π/3, the axis is the "
        "striction curve. The directions close, the surface climbs by π in its one turn.",
    ),
    Example(
        "hyperboloid",
        "Hyperboloid of one sheet",
        _pi(4, (0, 1), (8, 1)),
        "0",
        "1",
        "C2",
        "x² + y² − z² = 1, ruled by lines at π/4 to the z-axis: δ = 1, σ = 3π/4 and the waist "
        "circle is the striction curve. l = √2 π and λ = −√2 π.",
    ),
    Example(
        "plucker_conoid",
        "Plücker's conoid",
        _pi(2, (0, 1), (4, 1)),
        "sin(2*u)",
        "0",
        "C2",
        "z (x² + y²) = 2xy, each ruling passed twice in one turn: τ = τ̄ = 0 and δ = 2 cos 2u, so "
        "there are torsal rulings at u = π/4, 3π/4, 5π/4, 7π/4. l = λ = 0.",
    ),
    Example(
        "hyperbolic_paraboloid",
        "Hyperbolic paraboloid",
        _pi(6, (-2, 3), (2, 3)),
        "tan(u)",
        "0",
        "open",
        "x z = y, one of its two families of rulings, all horizontal: τ = τ̄ = 0, δ = 1/cos²u, and "
        "the striction curve is the z-axis, a ruling of the other family.",
    ),
    Example(
        "tangent_developable",
        "Tangents of a helix",
        _pi(4, (0, 1), (12, 1)),
        "0.6*u",
        "-0.6",
        "open",
        "The tangents of the helix (0.6 sin u, −0.6 cos u, 0.6 u): κ̄ = δ = 0 and K = 0, the "
        "surface is developable. σ = 0, as the helix is its own striction curve.",
    ),
    Example(
        "moebius",
        "Möbius band",
        _pi(12, (0, 3), (4, 3), (8, 9), (12, 9)),
        "0",
        "2*cos(u)",
        "open",
        "The point (0, 1, 0) + (−sin 2u, cos 2u, 0) of each ruling goes round a circle once while "
        "the ruling makes half a turn: X(1) = −X(0), closing with C². A surface that closes, but "
        "not as a moving oriented line, so one turn has neither l nor λ.",
    ),
    Example(
        "example_1",
        "Example 1: u = v = t",
        ((0.0, 0.0), (1.0, 1.0)),
        "u - v",
        "u + v",
        "open",
        "The paper's first example: ū = 0 and v̄ = 2t along it, κ² = 1 + sin²t and "
        "κκ̄ = t sin 2t + 2. It starts in a pole of the chart, where nothing is defined.",
    ),
    Example(
        "example_2",
        "Example 2: the paper's closed surface",
        LOOP,
        "u - v",
        "u + v",
        "C1",
        "The paper's second example: λ = −6.115937783178 and l = 0.580104765135. "
        "The seam is C¹ only: τ is 5√2 at t = 0 as at t = 1, but κ′ jumps.",
    ),
    Example(
        "crown",
        "Crown",
        _pi(4, (0, 1), (8, 1)),
        "0.2*sin(6*u)",
        "1.5",
        "C2",
        "A hyperboloid whose waist rises and falls six times: δ = 1.5 + 1.2 cos 6u. "
        "This changes neither l = 3π/√2 nor λ = −√2 π.",
    ),
    Example(
        "wave_ring",
        "Wave ring",
        _pi(4, (0, 1), (8, 1)),
        "0.4*sin(3*u)",
        "0.6",
        "C2",
        "A hyperboloid whose waist rises and falls three times, so steeply that the sense of its "
        "shear changes: δ = 0.6 + 1.2 cos 3u and κ = τ = √2 π, torsal at t = 1/9, 2/9, 4/9, 5/9, "
        "7/9 and 8/9. The frame screws about the z-axis with the pitch 1.2 cos 3u. l = 0.6 √2 π "
        "and λ = −√2 π.",
    ),
    Example(
        "tower",
        "Tower of five edges",
        _pi(6, (0, 1), (12, 1)),
        "0.2*sin(5*u)",
        "0.6",
        "C2",
        "A steep and slender crown: δ = 0.6 √3 + cos 5u comes down to 0.039 five times, where the "
        "surface is nearly folded. l = 0.6 π and λ = −√3 π.",
    ),
    Example(
        "twisted_ring",
        "Twisted ring",
        _pi(8, (0, 4), (2, 5), (4, 6), (6, 2), (8, 2), (10, 4), (12, 2), (14, 3), (16, 4)),
        "0.3*sin(2*u)",
        "1.2",
        "C2",
        "Every ruling touches the cylinder of radius 1.2 about the z-axis, leaning now to one "
        "side, now to the other; one turn closes with C².",
    ),
    Example(
        "orchid",
        "Orchid",
        _pi(8, (2, 4), (2, 5), (5, 6), (8, 5), (8, 4), (8, 3), (5, 2), (2, 3), (2, 4)),
        "cos(u)",
        "cos(v)",
        "C2",
        "A loop on the sphere that goes round no pole and closes with C². The ruling's distance "
        "from the z-axis is |cos v|: it meets the axis twice, where it is horizontal.",
    ),
    Example(
        "shell",
        "Shell",
        _pi(4, (0, 1), (20, 1)),
        "0.2*exp(0.13*u)",
        "0.25*exp(0.13*u)",
        "open",
        "Turned about the z-axis and enlarged by e^0.13 for each radian it falls on itself: "
        "δ = 0.276 exp(0.13 u), and σ is constant.",
    ),
    Example(
        "cusp",
        "Cusp",
        _pi(6, (0, 2), (4, 5), (0, 5), (4, 2)),
        "0.4*u",
        "0.5*v",
        "open",
        "The path of x on the sphere has a cusp at t = 1/2: the ruling stops turning, κ = 0, and "
        "turns back. This one ruling is cylindrical, with neither a frame nor δ nor a striction "
        "point of its own; from both sides δ tends to 0.5.",
    ),
    Example(
        "ramp",
        "Spiral ramp",
        _pi(8, (0, 3), (16, 7), (32, 3)),
        "0.3*u",
        "0.6",
        "C0",
        "Two turns up around the cylinder of radius 0.6, which every ruling touches. It banks to "
        "one side and back: the first and the last ruling are parallel, 1.2 π apart in height.",
    ),
)
"""The gallery, in the order of a menu."""

_BY_KEY = {entry.key: entry for entry in GALLERY}


def names() -> tuple[str, ...]:
    """Return the keys of all examples, in the order of the gallery."""
    return tuple(_BY_KEY)


def example(key: str) -> Example:
    """Return the example with this key.

    Raises
    ------
    GeometryError
        if there is none.
    """
    if key not in names():
        raise GeometryError(f"`key` must be one of {', '.join(names())}; got {key!r}")
    return _BY_KEY[key]


def surface(key: str) -> RuledSurface:
    """Return the surface of the example with this key.

    Raises
    ------
    GeometryError
        if there is none.
    """
    chosen = example(key)
    return RuledSurface(Bezier(np.array(chosen.points)), chosen.ubar, chosen.vbar)
