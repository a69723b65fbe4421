"""A developable surface over the curve of another one: how it was found, as strip and in words."""

from __future__ import annotations

import math

import numpy as np

from ...geometry import GeometryError, RuledSurface, developable_from_ubar, tangent_developable
from ...geometry.checks import Array
from .congruence import said

__all__ = ["straightened", "straightened_words", "strip"]


def straightened(surface: RuledSurface, ubar: str) -> tuple[RuledSurface, str]:
    """Return a developable surface with the same directions, and how it was found."""
    first = surface.curve.series(np.array(surface.domain[0]), 0).value
    try:
        with np.errstate(all="ignore"):
            start = float(surface.vbar(*first))
        made = developable_from_ubar(surface.curve, ubar, start)
        now = made.vbar(np.linspace(*surface.domain, 201))
    except GeometryError as error:
        why = (*str(error).replace("`", "").split("; "), "")[1].removeprefix("got ")
        return tangent_developable(surface.curve), (
            f"Keeping ū does not work here ({why}), so these are the tangents of a curve m with "
            "m′ = x, which have the same directions."
        )
    return made.surface, f"ū stays, and v̄ along the curve follows from κ̄ = 0: {_course(now, start)}"


def _course(vbar: Array, start: float) -> str:
    """Say where the new v̄ begins, whether that is the old first value, and how far it goes."""
    low, high, begins, was = (said(x) for x in (vbar.min(), vbar.max(), vbar[0], start))
    kept = math.isclose(vbar[0], start, rel_tol=1e-6, abs_tol=1e-9)
    ends = f"it is {low} throughout" if low == high else f"it runs from {low} to {high}"
    if kept:
        return f"it begins with {begins} as before, and {ends}."
    return (
        f"on a parallel its first value is not free: it begins with {begins} and not {was}; {ends}."
    )


def straightened_words(before: RuledSurface, after: RuledSurface, how: str) -> str:
    """State κ̄ before and after, and whether the new surface closes."""
    was, now = _greatest(before), _greatest(after)
    size = max(was, 1.0)
    left = "0 to rounding" if now < 1e-7 * size else f"{now:.3g}"
    closes = "closes" if after.closure().closed else "does not close"
    was_closed = "closed" if before.closure().closed else "open"
    return (
        f"The greatest |κ̄| was {was:.4g}; now it is {left}: the green strip is developable. {how} "
        f"The surface was {was_closed}; the developable one {closes}."
    )


def _greatest(surface: RuledSurface) -> float:
    found = np.abs(surface.invariants(np.linspace(*surface.domain, 201)).kappa_bar)
    return float(found[np.isfinite(found)].max(initial=0.0))


def strip(surface: RuledSurface, length: float) -> Array:
    """Return (2, 80, 3) the ends of rulings about the striction points, not far from the feet."""
    sample = surface.sample(np.linspace(*surface.domain, 80))
    foot, x = sample.foot, sample.direction
    shift = np.clip(np.einsum("ti,ti->t", sample.striction - foot, x), -length, length)
    middle = foot + np.nan_to_num(shift)[:, None] * x
    return np.stack([middle - 0.5 * length * x, middle + 0.5 * length * x])
