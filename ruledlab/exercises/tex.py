"""Numbers that vary with the seed, put into TeX: factors, sums, dual numbers, vectors, angles."""

from __future__ import annotations

from fractions import Fraction
from math import pi

import numpy as np
import numpy.typing as npt

__all__ = ["angle", "combination", "dual", "times", "vector"]


def times(factor: float) -> str:
    """Return a factor as it stands before a name: nothing for 1, a sign alone for −1."""
    if abs(factor) == 1:
        return "" if factor > 0 else "-"
    return _number(factor)


def combination(*terms: tuple[float, str]) -> str:
    """Return ``2u-z`` for (2, "u"), (-1, "z"); terms with 0 are left out.

    A term with an empty name is the number itself.
    """
    text = ""
    for factor, name in terms:
        if factor:
            sign = "+" if factor > 0 and text else ""
            text += sign + (times(factor) + name if name else _number(factor))
    return text or "0"


def dual(real: float, part: float) -> str:
    """Return the dual number a + ε ā."""
    return combination((real, ""), (part, r"\varepsilon"))


def vector(entries: npt.ArrayLike) -> str:
    r"""Return ``(0.6,\,0.8,\,0)``, to six digits behind the point."""
    rounded = np.round(np.asarray(entries, dtype=float), 6)
    return "(" + r",\,".join(map(_number, rounded)) + ")"


def angle(value: float) -> str:
    r"""Return a fraction of π such as ``\tfrac{2\pi}3``, with a denominator up to 24.

    Raises
    ------
    ValueError
        if it is none.
    """
    part = Fraction(value / pi).limit_denominator(24)
    if abs(float(part) * pi - value) > 1e-9:
        raise ValueError(f"`value` must be a fraction of π; got {value}")
    above, below = part.numerator, part.denominator
    if above == 0:
        return "0"
    sign, above = ("-" if above < 0 else ""), abs(above)
    top = r"\pi" if above == 1 else rf"{above}\pi"
    if below == 1:
        return sign + top
    top = top if above == 1 else f"{{{top}}}"
    return sign + rf"\tfrac{top}{below if below < 10 else f'{{{below}}}'}"


def _number(value: float) -> str:
    return f"{value + 0.0:g}"  # never −0
