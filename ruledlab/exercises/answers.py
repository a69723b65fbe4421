"""Reading what a student answers: numbers, fractions of π, arrays and formulas, typed or computed.

Whatever cannot be read is refused with one line that says what to write instead; nothing typed is
ever handed to Python as code.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from numbers import Real
from typing import Any

import numpy as np

from ..geometry.checks import Array, GeometryError
from ..geometry.dual import Dual
from ..geometry.field import Field, field, number
from ..geometry.formula import FormulaError
from ..geometry.written import Written, in_formula_notation, without_label

__all__ = ["is_open", "read_formula", "read_numbers"]

LONGEST = 2000
"""Characters an answer may have."""

DEEPEST = 4
"""Lists that may stand inside one another."""


def is_open(answer: Any) -> bool:
    """Return whether nothing was answered yet: None, ``...`` or an empty text."""
    return answer is None or answer is Ellipsis or (isinstance(answer, str) and not answer.strip())


def _require_short(text: str) -> None:
    if len(text) > LONGEST:
        raise GeometryError(f"the answer has {len(text)} characters; at most {LONGEST} can be read")


# -- numbers and arrays ----------------------------------------------------------------------------


def read_numbers(answer: Any, shape: tuple[int, ...] = (), unit: str = "") -> Array:
    """Return a typed or computed answer as an array of finite numbers.

    Parameters
    ----------
    answer
        text such as ``3*pi/8``, ``3π/8``, ``[1, pi/2]``, ``1, 2, 3``, ``[1. 2. 3.]`` or, where two
        numbers are expected, ``2 + 3ε``; a number; a list or array of numbers or of such texts; a
        dual number, read as (real part, dual part).
    shape
        the shape that is expected. A row or a column of as many numbers gets this shape, and a
        list of one number is a number; for a single number a comma is taken for a decimal comma.
    unit
        the unit, which may stand at the end of the text.

    Raises
    ------
    GeometryError
        saying what cannot be read and what to write instead.
    """
    if is_open(answer):
        raise GeometryError("nothing is answered yet; write a number such as 2.5 or 3*pi/8")
    return _fitted(_as_array(_read(answer, shape, unit)), shape)


def _read(answer: Any, shape: tuple[int, ...], unit: str) -> Any:
    if isinstance(answer, str):
        return _read_text(answer, shape, unit)
    if isinstance(answer, Dual):
        return np.stack(np.broadcast_arrays(answer.real, answer.dual), axis=-1)
    if callable(answer) and not hasattr(answer, "__float__"):
        raise GeometryError("this is a function, not its value; call it with its arguments")
    if isinstance(answer, (bool, np.bool_, dict, set, bytes, bytearray)):
        kind = type(answer).__name__
        raise GeometryError(f"this is a {kind}, not a number; give a number or an array")
    return _members(answer)


def _members(answer: Any, depth: int = 0) -> Any:
    """Return lists with their texts read; anything else as it is."""
    if depth > DEEPEST:
        raise GeometryError("lists stand too deep inside one another; give [1, 2, 3]")
    if isinstance(answer, (list, tuple)):
        return [_members(part, depth + 1) for part in answer]
    return _number(answer) if isinstance(answer, str) else answer


def _as_array(value: Any) -> Array:
    try:
        array = np.array(value)
        real = array.dtype.kind != "c"
        array = array.astype(np.float64) if real else array
    except Exception:  # whatever an object of the student's own does when it is asked for numbers
        raise GeometryError(_why_no_array(value)) from None
    if not real:
        raise GeometryError("this is a complex number; only real numbers are asked for")
    if not np.isfinite(array).all():
        raise GeometryError("this holds NaN, infinity or nothing; only finite numbers can be right")
    return array


def _why_no_array(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return "these are not the numbers of an array; give rows of equal length, numbers only"
    if isinstance(value, int):
        return "this number is too large"
    name = type(value).__name__
    return f"this is an object of the type {name}; give a number or an array of numbers"


def _fitted(array: Array, shape: tuple[int, ...]) -> Array:
    """Return rows, columns and lists of one number in the shape that is expected."""
    without_ones = [tuple(n for n in given if n != 1) for given in (array.shape, shape)]
    return array.reshape(shape) if without_ones[0] == without_ones[1] else array


# -- typed numbers ---------------------------------------------------------------------------------

_BRACKETS = {"{": "}", "[": "]", "(": ")", "⟨": "⟩"}
_WRAPPED = re.compile(
    r"^(?:(?:np|numpy|sympy|sp)\.)?(?:array|asarray|list|tuple|Matrix|matrix|vector)"
    r"\((?P<inside>.*?)(?:,\s*dtype\s*=\s*[\w.]+\s*)?\)$",
    re.DOTALL,
)
_TRANSPOSED = re.compile(r"(?<=[])}⟩])\s*(?:\.T|\^T|ᵀ)$")
_EPSILON = re.compile(r"ε|ϵ|(?<![A-Za-z_])eps(?:ilon)?(?![A-Za-z_])")
_DEGREES = re.compile(r"(?<=[0-9.\s)πi])\s*(?:deg|degree|degrees)$")
_UNITS = {
    "rad": ("radians", "radian", "rad"),
    "length": ("length units", "units of length", "lengths", "length", "units", "unit"),
}


def _read_text(text: str, shape: tuple[int, ...], unit: str) -> Any:
    _require_short(text)
    begin, end = without_label(text)
    plain = _TRANSPOSED.sub("", _without_unit(text[begin:end], unit))
    if shape == (2,) and _EPSILON.search(plain) and not _inside(plain):
        return _dual(plain)
    return _typed(plain, shape, listed=shape != ())


def _without_unit(text: str, unit: str) -> str:
    """Return the text without a unit at its end; refuse another one's."""
    kind = unit.partition(" ")[0]
    raised = unit.replace("²", "^2"), unit.replace("²", "**2")
    own = (unit, *raised, kind, *_UNITS.get(kind or "rad", ()))
    for word in sorted(filter(None, own), key=len, reverse=True):
        if found := _ending(text, word):
            return found
    for words in _UNITS.values():
        for word in words:
            if unit and _ending(text, word):
                asked = f"the answer is asked for in the unit “{unit}”"
                raise GeometryError(f"{asked}, and this is in “{word}”; convert it")
    return _DEGREES.sub("°", text)


def _ending(text: str, word: str) -> str:
    """Return what stands before a word at the end of the text, if a number ends there."""
    if not text.endswith(word):
        return ""
    before = text.removesuffix(word)
    number_ends = before[-1:].isspace() or before[-1:].isdigit() or before[-1:] in ("π", ")", "]")
    return before.rstrip() if number_ends else ""


def _dual(text: str) -> Any:
    """Return the two parts of a dual number such as ``2 + 3ε``."""
    written = in_formula_notation(text, ("ε",))
    try:
        value = field(written.text, "answer")(Dual(0.0, 1.0), 0.0)
    except FormulaError as error:
        raise written.located(error, _renamed(error.message, ("ε",))) from None
    return [value.real, value.dual] if isinstance(value, Dual) else [value, 0.0]


def _typed(text: str, shape: tuple[int, ...], listed: bool, depth: int = 0) -> Any:
    """Return a number, or nested lists of numbers where brackets and separators say so.

    Without brackets it is a list only if ``listed`` says that one is expected.
    """
    wrapped = _WRAPPED.match(text)
    text = wrapped["inside"].strip() if wrapped else text
    inside = _inside(text)
    parts = _parts(text if inside is None else inside, shape, inside is not None)
    bracketed = inside is not None and (text[0] != "(" or len(parts) > 1)
    if not bracketed and not (listed and len(parts) > 1):
        return _number(text)
    if depth >= DEEPEST:
        raise GeometryError("brackets stand too deep inside one another; write [1, 2, 3]")
    return [_typed(part.strip(), shape[1:], ";" in text, depth + 1) for part in parts]


def _inside(text: str) -> str | None:
    """Return what stands between brackets that enclose the whole text."""
    if text[:1] == "<" and text[-1:] == ">" and len(text) > 1:
        return text[1:-1]
    if not text or text[0] not in _BRACKETS:
        return None
    depth = 0
    for place, sign in enumerate(text):
        depth += (sign in "[({⟨") - (sign in "])}⟩")
        if depth == 0:
            whole = place == len(text) - 1 and sign == _BRACKETS[text[0]]
            return text[1:-1] if whole else None
    return None


def _parts(text: str, shape: tuple[int, ...], bracketed: bool) -> list[str]:
    """Return the entries: between semicolons, commas, bars or spaces, the first there are."""
    if not text.strip():
        return []
    rows, columns = [row.strip().rstrip(",") for row in _split(text, ";")], _split(text, ",")
    for found in (rows, columns):
        if len(found) > 1:
            if not found[-1].strip():
                found.pop()  # a comma at the end
            if any(not part.strip() for part in found):
                raise GeometryError("nothing stands between two commas; write [1, 2, 3]")
            return found
    for found in (_split(text, "|"), _by_spaces(text)):
        if len(found) > 1 and (bracketed or (shape and len(found) == shape[0])):
            return found
    return [text]


def _split(text: str, separator: str) -> list[str]:
    """Return the pieces between separators that stand in no bracket."""
    pieces, depth, start = [], 0, 0
    for place, sign in enumerate(text):
        depth += (sign in "[({⟨") - (sign in "])}⟩")
        if sign == separator and depth == 0:
            pieces.append(text[start:place])
            start = place + 1
    return [*pieces, text[start:]]


_THOUSANDS = re.compile(r"[0-9][.']?[0-9]{3},[0-9]|[0-9],[0-9]{3}\.|[0-9]'[0-9]{3}")
_GAP = re.compile(r"(?<=[\w.)\]}π½²³])\s+(?=[-+−]?[\w.(\[{√½])")


def _by_spaces(text: str) -> list[str]:
    """Return the entries of ``1. -2. 3.``, as numpy prints them; ``1 - 2`` is one entry."""
    pieces, start = [], 0
    for gap in _GAP.finditer(text):
        before = text[: gap.start()]
        depth = sum(before.count(sign) for sign in "[({") - sum(map(before.count, "])}"))
        if depth == 0:
            pieces.append(text[start : gap.start()])
            start = gap.end()
    return [*pieces, text[start:]]


def _number(text: str) -> float:
    """Return a number; ``3π`` for ``3*π`` is accepted too."""
    _require_short(text)
    if text[:1] in ("[", "{"):
        raise GeometryError(f"'{text[0]}' is not closed, or more follows it; write [1, 2, 3]")
    if "[" in text or "]" in text:
        raise GeometryError("write the entries of an array one by one, such as [1, 2, 3]")
    if _THOUSANDS.search(text):
        raise GeometryError("write no mark between thousands, and a decimal point: 1234.5")
    written = in_formula_notation(text)
    try:
        return number(written.text, "answer")
    except FormulaError as error:
        said = error.message.replace("known are u, v, pi", "known are pi").replace(", u or v", "")
        said = said.replace(" or a formula such as u - v", " such as 2.5 or 3*pi/8")
        said = said.replace(", such as u - v", "").replace("write sin(u)", "write sin(2)")
        raise written.located(error, said) from None


# -- formulas --------------------------------------------------------------------------------------


def read_formula(answer: Any, variables: tuple[str, ...]) -> Callable[..., Any]:
    """Return a typed formula in one or two variables as a function of arrays.

    Parameters
    ----------
    answer
        text such as ``sin(2*t) + 1`` or ``sin²(2t) + 1``, a number, a Python function of the
        variables, an expression of SymPy, or a `Field`.
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
    if hasattr(answer, "free_symbols"):
        answer = str(answer)
    if isinstance(answer, str):
        return _values_of(_typed_formula(answer, variables))
    if isinstance(answer, Field):
        return _values_of(answer)
    if isinstance(answer, Real) and not isinstance(answer, (bool, np.bool_)):
        return _values_of(field(answer, "answer"))
    if callable(answer):
        return _calling(answer, variables)
    kind, letters = type(answer).__name__, ", ".join(variables)
    example = "*".join(variables)
    raise GeometryError(
        f"this is an object of the type {kind}; give a formula as text, such as '2*{example}', or "
        f"a Python function of {letters}"
    )


def _values_of(made: Field) -> Callable[..., Array]:
    """Return a formula as a function of one or two arrays."""

    def function(*values: Any) -> Array:
        u, v = (*values, 0.0)[:2]
        shape = np.broadcast_shapes(*(np.shape(x) for x in values))
        return np.broadcast_to(np.asarray(made(u, v), dtype=float), shape)

    return function


def _calling(answer: Callable[..., Any], variables: tuple[str, ...]) -> Callable[..., Array]:
    """Return a student's own function as one of arrays; it may be made for single numbers."""

    def function(*values: Any) -> Array:
        arrays = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in values))
        shape = arrays[0].shape
        try:
            with np.errstate(all="ignore"):
                together = np.asarray(answer(*arrays))
            if together.shape in ((), shape) and together.dtype.kind in "fiu":
                return np.broadcast_to(together.astype(float), shape)
        except Exception:  # its own error is said below, if it has one with single numbers too
            pass
        singles = [
            _called(answer, one, variables) for one in zip(*map(np.ravel, arrays), strict=True)
        ]
        return np.reshape(singles, shape)

    return function


def _called(answer: Callable[..., Any], values: Any, variables: tuple[str, ...]) -> float:
    letters = ", ".join(variables)
    try:
        value = answer(*(float(x) for x in values))
    except Exception as error:
        said = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        raise GeometryError(f"the function of {letters} failed ({said}); mend it") from error
    if np.shape(value) != () or isinstance(value, (str, bool)) or not isinstance(value, Real):
        said = " ".join(repr(value).split())[:60]
        raise GeometryError(
            f"the function gives {said}, no number; let it return an expression in {letters}"
        )
    return float(value)


def _typed_formula(text: str, variables: tuple[str, ...]) -> Field:
    """Read a formula in other letters than u and v: they are renamed."""
    _require_short(text)
    written: Written = in_formula_notation(text, variables, without_label(text))
    try:
        return field(written.text, "answer")
    except FormulaError as error:
        raise written.located(error, _renamed(error.message, variables)) from None


def _renamed(message: str, variables: tuple[str, ...]) -> str:
    """Put the variables' names into a message that speaks of u and v."""
    if variables == ("u", "v"):
        return message
    first, last, many = variables[0], variables[-1], ", ".join(variables)
    meant = f"write it with {' and '.join(variables)}"
    message = re.sub("write [uv], the (angle from the z-axis|longitude)", meant, message)
    message = message.replace("u, v, pi", f"{many}, pi").replace("u or v", " or ".join(variables))
    message = message.replace(", such as u - v", "").replace(
        " such as u - v", f" such as 2*{first}"
    )
    message = re.sub(r"(?<![A-Za-z])u(?![A-Za-z])", first, message)
    return re.sub(r"(?<![A-Za-z])v(?![A-Za-z])", last, message)
