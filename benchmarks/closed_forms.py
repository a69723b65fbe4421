"""What one would write without this package: SciPy's curve, SymPy's formulas, made into numpy.

u(t), v(t) and their derivatives come from `scipy.interpolate.BPoly`. The closed forms in u, v, ū, v̄
are derived once with SymPy and lambdified with common subexpressions taken out (cse=True), so that
numpy evaluates nothing twice: the best one gets without writing the code by hand.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BPoly

__all__ = ["usual_invariants"]

T = sp.Symbol("t")
U, V = sp.Function("u")(T), sp.Function("v")(T)
u, v = sp.symbols("u v")


def usual_invariants(points: ArrayLike, ubar: str, vbar: str) -> Callable[[NDArray], list[NDArray]]:
    """Return a function of t that gives κ, κ̄, τ, τ̄, σ, δ, κ′, κ̄′."""
    formulas = _lambdified(_closed_forms(sp.sympify(ubar), sp.sympify(vbar)))
    curve = BPoly(np.asarray(points, float)[:, None, :], [0, 1])
    speed = curve.derivative()
    bend = speed.derivative()

    def invariants(t: NDArray) -> list[NDArray]:
        rows = (row for values in (bend(t), speed(t), curve(t)) for row in values.T)
        return formulas(*rows)

    return invariants


def _closed_forms(ubar: sp.Expr, vbar: sp.Expr) -> list[sp.Expr]:
    along = {u: U, v: V}
    a, b = (part.subs(along, simultaneous=True) for part in (ubar, vbar))
    a_u, a_v, b_u, b_v = (
        part.diff(by).subs(along, simultaneous=True) for part in (ubar, vbar) for by in (u, v)
    )
    du, dv, ddu, ddv = U.diff(T), V.diff(T), U.diff(T, 2), V.diff(T, 2)
    sin, cos = sp.sin(V), sp.cos(V)
    square = du**2 * sin**2 + dv**2
    kappa = sp.sqrt(square)
    mixed = du**2 * sin * (b * cos + a_u * sin) + du * dv * (b_u + a_v * sin**2) + dv**2 * b_v
    kappa_bar = mixed / kappa
    turn = cos * (du**3 * sin**2 + 2 * du * dv**2) + sin * (ddu * dv - du * ddv)
    shift = a * cos + (sin * (dv * a.diff(T) - du * b.diff(T)) + du * dv * b * cos) / square
    tau_bar = sin * (a * dv - b * du) + shift.diff(T)
    return [
        kappa,
        kappa_bar,
        turn / square,
        tau_bar,
        sp.atan2(kappa_bar, tau_bar),
        kappa_bar / kappa,
        kappa.diff(T),
        kappa_bar.diff(T),
    ]


def _lambdified(forms: list[sp.Expr]) -> Callable[..., list[NDArray]]:
    names = sp.symbols("u2 v2 u1 v1 u0 v0")
    # The highest derivatives go first: replacing u(t) would reach into u′(t) otherwise.
    symbols = [U.diff(T, 2), V.diff(T, 2), U.diff(T), V.diff(T), U, V]
    replaced = [form.doit().subs(list(zip(symbols, names, strict=True))) for form in forms]
    return sp.lambdify(names, replaced, "numpy", cse=True)
