"""Integrals over t to a stated accuracy, by SciPy's adaptive Gauss–Kronrod rule."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import cubature
from scipy.optimize import brentq

from .checks import Array, GeometryError

__all__ = ["integrate", "sign_changes"]

ACCURACY = 1e-13
PANELS = 8
SUBDIVISIONS = 200


def integrate(function: Callable[[Array], Array], start: float, end: float, what: str) -> Array:
    """Integrate rows of smooth functions of t over [start, end].

    Parameters
    ----------
    function
        t of shape (N,) to values of shape (…, N).
    what
        names the integral in the error message.

    Returns
    -------
    Array
        (…) the integrals, to about 1e-12 of the largest of them and of 1.

    Raises
    ------
    GeometryError
        if the accuracy is not reached, as where an integrand is undefined or has a pole.
    """
    step = (end - start) / PANELS
    corners = start + step * np.arange(PANELS)

    def folded(places: Array) -> Array:
        # The panels are summed inside, so that each call of `function` gets a long array.
        t = corners + step * places
        values = function(t.ravel())
        panels = values.reshape(*values.shape[:-1], *t.shape).sum(axis=-1)
        return np.moveaxis(panels, -1, 0)

    result = cubature(
        folded,
        [0.0],
        [1.0],
        rtol=ACCURACY,
        atol=ACCURACY / abs(step),
        max_subdivisions=SUBDIVISIONS,
    )
    estimate: Array = step * np.asarray(result.estimate)
    if result.status != "converged" or not np.isfinite(estimate).all():
        raise GeometryError(
            f"{what} does not converge between t = {start:g} and t = {end:g}: the integrand is "
            "undefined or unbounded there, as where κ comes down to 0; move the curve away from "
            "such places"
        )
    return estimate


def sign_changes(
    function: Callable[[Array], Array], start: float, end: float, samples: int = 513
) -> list[float]:
    """Return where a scalar function of t changes sign, each bracketed and then found by Brent."""
    t = np.linspace(start, end, samples)
    values = function(t)
    brackets = np.flatnonzero(values[:-1] * values[1:] < 0.0)

    def at(place: float) -> float:
        return float(function(np.array([place]))[0])

    crossings = [float(brentq(at, t[i], t[i + 1], xtol=1e-15)) for i in brackets]
    touched = [float(place) for place in t[1:-1][values[1:-1] == 0.0]]
    return sorted(crossings + touched)
