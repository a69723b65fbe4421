"""Typed vector functions of t, such as ``"cos(t), sin(t), a*t"``: base curves and generators.

They are what `RuledSurface.from_base` takes for c(t) and x(t) (paper, (1)), without a Python
function: three typed formulas with commas between them, read as those of ū and v̄ are.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from .checks import GeometryError, finite_array
from .field import Field
from .field import field as formula
from .formula import FormulaError, Source

__all__ = ["Vector", "vector"]

_LETTER = "(?<![A-Za-z_]){}(?![A-Za-z0-9_])"
_OWN = {"t": "u", "a": "v"}


@dataclass(frozen=True, slots=True)
class Vector:
    """Three formulas in t with a constant a; call it with a number, an array or a `Series`.

    Attributes
    ----------
    text
        what was typed.
    a
        the value of the letter a in it.
    """

    text: str
    a: float = 0.0
    _parts: tuple[Field, ...] = field(default=(), repr=False)

    def __call__(self, t: Any) -> tuple[Any, Any, Any]:
        """Return the three components at t; a constant one is a plain number."""
        x, y, z = (part(t, self.a) for part in self._parts)
        return x, y, z


def vector(text: str, name: str = "vector", a: float = 0.0) -> Vector:
    """Return a typed vector function of t.

    Parameters
    ----------
    text
        three formulas in t with commas between them, in round brackets or without; the letter a
        stands for one constant.
    name
        the argument's name in messages.
    a
        the value of a.

    Raises
    ------
    FormulaError
        where a formula cannot be read; it knows the place in the whole text.
    GeometryError
        where the text is none, or there are not three formulas.

    Examples
    --------
    >>> from ruledlab.geometry import RuledSurface, vector
    >>> helix, tangent = vector("cos(t), sin(t), a*t", a=2), vector("-sin(t), cos(t), a", a=2)
    >>> tangents = RuledSurface.from_base(helix, tangent, domain=(0, 6))
    >>> abs(float(tangents.invariants(0.25).delta)) < 1e-12
    True
    """
    if not isinstance(text, str):
        raise GeometryError(
            f"`{name}` must be a text of three formulas in t; got {type(text).__name__}; "
            'write "cos(t), sin(t), t"'
        )
    constant = finite_array(a, "a")
    if constant.ndim:
        raise GeometryError(f"`a` must be one number; got an array of shape {constant.shape}")
    pieces = _pieces(text)
    if len(pieces) != 3:
        raise GeometryError(
            f"`{name}` must be three formulas with commas between them; got {len(pieces)}; "
            "write for example cos(t), sin(t), t"
        )
    parts = tuple(_component(text, start, end, name) for start, end in pieces)
    return Vector(text, float(constant), parts)


def _pieces(text: str) -> list[tuple[int, int]]:
    """Return where the formulas begin and end, inside a pair of brackets about them all."""
    start, end = len(text) - len(text.lstrip()), len(text.rstrip())
    whole = _between_commas(text, 0, len(text))
    if len(whole) > 1 or text[start : start + 1] != "(" or text[end - 1 : end] != ")":
        return whole
    inside = _between_commas(text, start + 1, end - 1)
    return inside if len(inside) > 1 else whole


def _between_commas(text: str, start: int, end: int) -> list[tuple[int, int]]:
    """Cut a part of the text at the commas that stand in no bracket."""
    commas, depth = [start - 1], 0
    for place in range(start, end):
        depth += (text[place] == "(") - (text[place] == ")")
        if text[place] == "," and depth <= 0:
            commas.append(place)
    return [(a + 1, b) for a, b in pairwise([*commas, end])]


def _component(text: str, start: int, end: int, name: str) -> Field:
    """Read one formula; blanks before it keep its columns those of the whole text."""
    part = text[start:end].replace("−", "-")
    if not part.strip():
        raise _error(name, text, start, "a formula is missing")
    for letter in _OWN.values():
        if found := re.search(_LETTER.format(letter), part):
            raise _error(name, text, start + found.start(), f"unknown name '{letter}'")
    for letter, own in _OWN.items():
        part = re.sub(_LETTER.format(letter), own, part)
    try:
        return formula(" " * start + part, name)
    except FormulaError as error:
        message = _renamed(error.message)
        raise FormulaError(name, text, error.position, message) from None


def _error(name: str, text: str, place: int, what: str) -> FormulaError:
    return Source(name, text).error(place, what, "write a formula in t")


def _renamed(message: str) -> str:
    """Put t and a into a message that speaks of u and v."""
    message = message.replace(" such as u - v", " such as 2*t")
    message = message.replace(", u or v", " or t").replace("u or v", "t")
    for letter, own in _OWN.items():
        message = re.sub(_LETTER.format(own), letter, message)
    return message
