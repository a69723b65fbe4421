"""Real functions of one variable, typed in x, and their values at dual numbers.

The paper's §2.1: f(x + ε x̄) = f(x) + ε x̄ f′(x). So a formula evaluated at x + ε 1 by the rules of
dual arithmetic alone has the derivative in its dual part, and nobody has to differentiate.
"""

from __future__ import annotations

import functools
import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from .checks import GeometryError
from .dual import Dual
from .field import Field, field
from .formula import FormulaError, Source

__all__ = ["Function", "Lifted", "function"]


@dataclass(frozen=True, eq=False, slots=True)
class Lifted:
    """A function at one dual number X = x + ε x̄.

    Attributes
    ----------
    argument
        X.
    value
        f(X) = f(x) + ε x̄ f′(x); a part that is undefined is NaN or infinite.
    slope
        f′(x), the dual part of f(x + ε).
    undefined
        why f(X) is not a dual number; empty where it is.
    """

    argument: Dual
    value: Dual
    slope: float
    undefined: str


@dataclass(frozen=True, eq=False, slots=True)
class Function:
    """A typed function of x. Make it with `function`.

    Attributes
    ----------
    text
        the formula as typed, without white space at its ends.
    latex
        the formula typeset, without dollar signs.
    """

    text: str
    latex: str
    _field: Field

    def __call__(self, x: Any) -> Any:
        """Return f(x) for a number, an array, a `Series` or a `Dual`.

        Outside the domain the value is NaN, at a pole infinite; nothing is warned about.

        Raises
        ------
        GeometryError
            if dual arithmetic would have to divide by a pure dual number, as 1/x at ε x̄.
        """
        result = self._field(x, 0.0)
        if not isinstance(result, float):
            return result
        if isinstance(x, Dual):
            return Dual(result + 0.0 * x.real, 0.0 * x.dual)
        return np.full(np.shape(x), result)[()]  # a constant

    def lifted(self, x: float, x_bar: float) -> Lifted:
        """Return f at x + ε x̄, with the reason where there is no value.

        Degenerate cases: outside the domain, at a pole, where the tangent is vertical and where
        there is none (`undefined` says which).
        """
        real = float(self(x))
        try:
            value, slope = self(Dual(x, x_bar)), float(self(Dual(x, 1.0)).dual)
        except GeometryError:
            return Lifted(Dual(x, x_bar), Dual(real, math.nan), math.nan, _no_inverse(x))
        return Lifted(Dual(x, x_bar), value, slope, _why_undefined(x, real, slope))


def _no_inverse(x: float) -> str:
    return (
        f"f has no value at x = {_shown(x)}: a denominator is a pure dual number ε b there, "
        "a zero divisor, which has no inverse"
    )


def _why_undefined(x: float, value: float, slope: float) -> str:
    if math.isnan(value):
        return f"f(x) is no real number at x = {_shown(x)}, which is outside the domain of f"
    if math.isinf(value):
        return f"f(x) is not finite at x = {_shown(x)}"
    if math.isinf(slope):
        return f"f has no finite derivative at x = {_shown(x)}: the tangent is vertical"
    if math.isnan(slope):
        return f"f has no derivative at x = {_shown(x)}: no single tangent there can carry x̄"
    return ""


def _shown(x: float) -> str:
    return f"{x:.6g}".replace("-", "−")


# -- reading ---------------------------------------------------------------------------------------

_X = re.compile(r"(?<![A-Za-z_])x(?![A-Za-z_])")
_U = re.compile(r"(?<![A-Za-z])u(?![A-Za-z])")
_OTHER = re.compile(r"(?<![A-Za-z_])(?:[uvtyzX]|theta|phi|θ|φ)(?![A-Za-z_])")


@functools.lru_cache(maxsize=64)  # an app asks for the same formula at every move
def function(text: str, name: str = "formula") -> Function:
    """Return a typed formula in x as a `Function`.

    Parameters
    ----------
    text
        such as ``"x**3 - x"``; the signs and functions are those of `field`.
    name
        the argument's name, with which errors begin.

    Raises
    ------
    FormulaError
        if it cannot be read; it knows the place in the text as it was typed.
    """
    if not isinstance(text, str):
        raise GeometryError(
            f"`{name}` must be a typed formula in x; got {type(text).__name__}; "
            "write for example 'x**2'"
        )
    if other := _OTHER.search(text):
        raise Source(name, text).error(
            other.start(), f"'{other[0]}' is not the variable,", "write x"
        )
    try:
        # One letter for another: every column stays where it is.
        read = field(_X.sub("u", text), name)
    except FormulaError as error:
        raise FormulaError(name, text, error.position, _in_x(error.message)) from None
    return Function(text.strip(), _U.sub("x", read.latex), read)


def _in_x(message: str) -> str:
    """Put x into a message that speaks of u and v."""
    if "z-axis" in message or "longitude" in message:
        return message.partition(";")[0] + "; the only variable is x"
    message = message.replace("u, v, pi", "x, pi").replace("number, u or v", "number or x")
    return _U.sub("x", message.replace("such as u - v", "such as x**2 - 1"))
