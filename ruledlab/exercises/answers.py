"""Reading what a student answers: numbers, fractions of π, arrays and formulas, typed or computed.

Whatever cannot be read is refused with one line that says what to write instead; nothing typed is
ever handed to Python as code.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ..geometry.checks import Array, GeometryError
from ..geometry.dual import Dual
from ..geometry.field import Field, FormulaError, field, number

__all__ = ["is_open", "read_formula", "read_numbers"]

LONGEST = 2000
"""Characters an answer may have."""

OPEN = {"{": "}", "[": "]", "(": ")"}
_WRAPPED = re.compile(r"^(?:np\.|numpy\.)?(?:array|asarray)\((?P<inside>.*)\)$", re.DOTALL)
_TIMES_PI = re.compile(r"(?<=[0-9)])\s*(?=(?:pi|π)(?![A-Za-z0-9_]))")


def is_open(answer: Any) -> bool:
    """Return whether nothing was answered yet: None, ``...`` or an empty text."""
    return answer is None or answer is Ellipsis or (isinstance(answer, str) and not answer.strip())


# -- numbers and arrays ----------------------------------------------------------------------------


def read_numbers(answer: Any, shape: tuple[int, ...] = (), unit: str = "") -> Array:
    """Return a typed or computed answer as an array of finite numbers.

    Parameters
    ----------
    answer
        text such as ``3*pi/8``, ``3π/8``, ``[1, pi/2]`` or ``1, 2, 3``; a number; a list or array
        of numbers or of such texts; a dual number, read as (real part, dual part).
    shape
        the shape that is expected: for a single number a comma is taken for a decimal comma.
    unit
        a unit that may stand at the end of the text.

    Raises
    ------
    GeometryError
        saying what cannot be read and what to write instead.
    """
    if is_open(answer):
        raise GeometryError("nothing is answered yet; write a number such as 2.5 or 3*pi/8")
    if isinstance(answer, str):
        return _as_array(_typed(_plain(answer, unit), shape))
    if isinstance(answer, Dual):
        return read_numbers(np.stack(np.broadcast_arrays(answer.real, answer.dual), axis=-1))
    if callable(answer) and not hasattr(answer, "__float__"):
        raise GeometryError("this is a function, not its value; call it with its arguments")
    if isinstance(answer, (bool, np.bool_, dict, set)):
        kind = type(answer).__name__
        raise GeometryError(f"this is a {kind}, not a number; give a number or an array")
    return _as_array(_members(answer))


def _plain(text: str, unit: str) -> str:
    """Return the text with the keyboard's minus sign and without a unit at its end."""
    if len(text) > LONGEST:
        raise GeometryError(f"the answer has {len(text)} characters; at most {LONGEST} can be read")
    text = text.strip().replace("−", "-")
    for word in dict.fromkeys((unit, *unit.split()[:1], "rad")):
        if word and unit and text.endswith(f" {word}"):
            return text.removesuffix(word).rstrip()
    return text


def _members(answer: Any) -> Any:
    """Return lists with their texts read; anything else as it is."""
    if isinstance(answer, (list, tuple)):
        return [_members(part) for part in answer]
    return float(number(answer, "answer")) if isinstance(answer, str) else answer


def _as_array(value: Any) -> Array:
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise GeometryError(_why_no_array(value)) from None
    if not np.isfinite(array).all():
        raise GeometryError("this holds NaN, infinity or nothing; only finite numbers can be right")
    return array


def _why_no_array(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return "these are not the numbers of an array; give rows of equal length, numbers only"
    if isinstance(value, complex) or np.iscomplexobj(value):
        return "this is a complex number; only real numbers are asked for"
    name = type(value).__name__
    return f"this is an object of the type {name}; give a number or an array of numbers"


def _typed(text: str, shape: tuple[int, ...], depth: int = 0) -> Any:
    """Return a number, or nested lists of numbers where brackets and commas say so."""
    wrapped = _WRAPPED.match(text)
    text = wrapped["inside"].strip() if wrapped else text
    inside = _inside(text)
    parts = list(_split(text if inside is None else inside))
    bracketed = inside is not None and (text[0] != "(" or len(parts) > 1)
    listed = inside is None and shape != () and len(parts) > 1
    if not bracketed and not listed:
        return _number(text)
    if depth > 3:
        raise GeometryError("brackets stand too deep inside one another; write [1, 2, 3]")
    if parts[-1].strip() == "":
        parts.pop()
    return [_typed(part.strip(), (), depth + 1) for part in parts]


def _inside(text: str) -> str | None:
    """Return what stands between brackets that enclose the whole text."""
    if not text or text[0] not in "[({":
        return None
    depth = 0
    for place, sign in enumerate(text):
        depth += (sign in "[({") - (sign in "])}")
        if depth == 0:
            whole = place == len(text) - 1 and sign == OPEN[text[0]]
            return text[1:-1] if whole else None
    return None


def _split(text: str) -> Iterator[str]:
    """Yield the pieces between commas (or semicolons) that stand in no bracket."""
    depth = start = 0
    for place, sign in enumerate(text):
        depth += (sign in "[({") - (sign in "])}")
        if sign in ",;" and depth == 0:
            yield text[start:place]
            start = place + 1
    yield text[start:]


def _number(text: str) -> float:
    """Return a number; ``3π`` for ``3*π`` is accepted too."""
    if text[:1] in ("[", "{"):
        raise GeometryError(f"'{text[0]}' is not closed, or more follows it; write [1, 2, 3]")
    try:
        return number(_TIMES_PI.sub("*", text), "answer")
    except FormulaError:
        pass
    try:
        return number(text, "answer")  # for the place in the text as it was typed
    except FormulaError as error:
        said = error.message.replace("known are u, v, pi", "known are pi").replace(", u or v", "")
        said = said.replace(" or a formula such as u - v", " such as 2.5 or 3*pi/8")
        raise FormulaError("answer", text, error.position, said) from None


# -- formulas --------------------------------------------------------------------------------------


def read_formula(answer: Any, variables: tuple[str, ...]) -> Callable[..., Any]:
    """Return a typed formula in one or two variables as a function of arrays.

    Parameters
    ----------
    answer
        text such as ``sin(2*t) + 1``, a number, a Python function of the variables made with
        numpy's functions, or a `Field`.
    variables
        one or two single letters, such as ``("u", "v")`` or ``("t",)``.

    Raises
    ------
    GeometryError
        saying what cannot be read; a `FormulaError` knows the place.
    """
    if is_open(answer):
        example = " + ".join(f"sin({name})" for name in variables)
        raise GeometryError(f"nothing is answered yet; write a formula such as {example}")
    made = _formula(answer, variables)

    def function(*values: Any) -> Any:
        u, v = (*values, 0.0)[:2]
        shape = np.broadcast_shapes(*(np.shape(x) for x in values))
        try:
            return np.broadcast_to(np.asarray(made(u, v), dtype=float), shape)
        except (TypeError, ValueError) as error:
            raise GeometryError(f"the function gives no number at each place: {error}") from error

    return function


def _formula(answer: Any, variables: tuple[str, ...]) -> Field:
    if isinstance(answer, str):
        return _typed_formula(answer, variables)
    if callable(answer) and not isinstance(answer, Field) and len(variables) == 1:
        return field(lambda u, v: answer(u), "answer")
    return field(answer, "answer")


def _typed_formula(text: str, variables: tuple[str, ...]) -> Field:
    """Read a formula in other letters than u and v: they are renamed, column for column."""
    plain = _TIMES_PI.sub(lambda gap: "*" if gap[0] == "" else gap[0], text.replace("−", "-"))
    _refuse_others(plain, variables)
    for name, own in zip(variables, ("\0", "\1"), strict=False):
        plain = re.sub(rf"(?<![A-Za-z_]){name}(?![A-Za-z0-9_])", own, plain)
    try:
        return field(plain.replace("\0", "u").replace("\1", "v"), "answer")
    except FormulaError as error:
        said = _renamed(error.message, variables)
        raise FormulaError("answer", plain_names(plain, variables), error.position, said) from None


def plain_names(text: str, variables: tuple[str, ...]) -> str:
    """Return the text with the reader's own letters again."""
    return text.replace("\0", variables[0]).replace("\1", variables[-1])


def _refuse_others(text: str, variables: tuple[str, ...]) -> None:
    for name in {"u", "v", "t"} - set(variables):
        found = re.search(rf"(?<![A-Za-z_0-9]){name}(?![A-Za-z0-9_])", text)
        if found:
            place, known = found.start(), " and ".join(variables)
            said = f"'{name}' is not meant here at column {place + 1}; write a formula in {known}"
            raise FormulaError("answer", text, place, said)


def _renamed(message: str, variables: tuple[str, ...]) -> str:
    """Put the variables' names into a message that speaks of u and v."""
    if variables == ("u", "v"):
        return message
    first, last, many = variables[0], variables[-1], ", ".join(variables)
    message = message.replace("u, v, pi", f"{many}, pi").replace("u or v", " or ".join(variables))
    message = message.replace(", such as u - v", "").replace(
        " such as u - v", f" such as 2*{first}"
    )
    message = re.sub(r"(?<![A-Za-z])u(?![A-Za-z])", first, message)
    return re.sub(r"(?<![A-Za-z])v(?![A-Za-z])", last, message)
