"""One turn of a closed surface taken ruling by ruling: no derivative and no integral is used.

It is what one would do by hand with rods: drop perpendiculars from rod to rod, and add up the
angles between the steps of the spherical image. A check on pitch and angle of pitch that shares
nothing with their integrals but the rulings themselves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import closed
from .checks import Array, GeometryError
from .surface import RuledSurface

__all__ = ["Stepped", "stepped"]

RULINGS = 512
"""Rulings of the finer of the two turns."""

LEAST = 16


@dataclass(frozen=True, slots=True)
class Stepped:
    """One turn in steps.

    Attributes
    ----------
    count
        rulings of the finer turn.
    shift
        how far along the ruling the chain of perpendiculars comes back: the pitch l.
    bend
        the sum of the exterior angles of the spherical polygon, positive to the left seen from
        outside: ∮τ dt = −λ, and the corner at the seam where the surface closes with C⁰ only.
    """

    count: int
    shift: float
    bend: float


def stepped(surface: RuledSurface, count: int = RULINGS) -> Stepped:
    """Go once round a closed surface in ``count`` steps, and again in half as many.

    A step from P on the ruling x to P* on the ruling x* is at right angles to x + x*. Its error is
    of second order; the two turns together (Richardson) leave the fourth.

    Raises
    ------
    GeometryError
        if ``count`` is not an even number from 16 up, or the surface does not close as a moving
        oriented line.
    """
    if count != int(count) or count < LEAST or count % 2:
        raise GeometryError(f"`count` must be an even number ≥ {LEAST}; got {count!r}")
    state = closed.closure(surface)
    if not state.oriented:
        raise GeometryError(
            "`surface` must close as a moving oriented line; this one: "
            f"{state.reason}; close the curve and choose ū, v̄ that return to their values"
        )
    t = np.linspace(*surface.domain, int(count) + 1)
    x, c = surface.line(t).direction, surface.foot(t)
    fine, coarse = _turn(x, c), _turn(x[::2], c[::2])
    shift, bend = (4.0 * fine - coarse) / 3.0
    return Stepped(int(count), float(shift), float(bend))


def _turn(x: Array, c: Array) -> Array:
    """Return shift and bend of one turn, in steps from each of the rulings to the next."""
    both = x[1:] + x[:-1]
    # (1 + ⟨x, x*⟩) = ½ |x + x*|²: what w x of both rulings leave along x + x*.
    steps = -2.0 * (np.diff(c, axis=0) * both).sum(axis=1) / (both * both).sum(axis=1)
    return np.array([steps.sum(), _exterior(x[1:], np.diff(x, axis=0)).sum()])


def _exterior(x: Array, arrive: Array) -> Array:
    """Return the angles at the corners x between the great circles that arrive and that leave."""
    leave = np.roll(arrive, -1, axis=0)
    left = (x * np.cross(arrive, leave)).sum(axis=1)
    ahead = (arrive * leave).sum(axis=1) - (arrive * x).sum(axis=1) * (leave * x).sum(axis=1)
    return np.asarray(np.arctan2(left, ahead))
