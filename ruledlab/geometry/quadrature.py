"""Integrals over t to a stated accuracy, by SciPy's adaptive Gauss–Kronrod rule."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import cubature

from .checks import Array, GeometryError

__all__ = ["integrate", "sign_changes"]

ACCURACY = 1e-13
PANELS = 16
SUBDIVISIONS = 60
HALVINGS = 52


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
) -> Array:
    """Return where a scalar function of t changes sign between two of the samples, by bisection.

    Stretches on which it is 0 or NaN are no change by themselves: what counts is the sign before
    and after.
    """
    t = np.linspace(start, end, samples)
    signs = np.sign(function(t))
    firm = np.flatnonzero(np.abs(signs) > 0.0)
    turns = np.flatnonzero(signs[firm[:-1]] != signs[firm[1:]])
    left, right, sign = t[firm[turns]], t[firm[turns + 1]], signs[firm[turns]]
    for _ in range(HALVINGS if turns.size else 0):
        middle = 0.5 * (left + right)
        same = np.sign(function(middle)) == sign
        left, right = np.where(same, middle, left), np.where(same, right, middle)
    return 0.5 * (left + right)
