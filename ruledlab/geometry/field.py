"""The choices ū(u, v) and v̄(u, v): typed formulas, numbers and Python functions.

What ū and v̄ mean. With x̄ = ū x_u + v̄ x_v the line in direction x(u, v) is

    { ū e_z + v̄ e_φ + s x : s real },   e_φ = (−sin u, cos u, 0),

for e_φ is perpendicular both to the axis e_z and to x. So the common perpendicular of the line and
the z-axis leaves the axis at the height **ū** and has the signed length **v̄**: û = u + ε ū and
v̂ = v + ε v̄ are the dual longitude and the dual angle between the line and the axis. The meanings
in `choices` all follow from this.

A typed formula, read by `formula`, becomes nested functions that call numpy only.
"""

from __future__ import annotations

import ast
import functools
import math
import operator
import re
import reprlib
from collections.abc import Callable
from dataclasses import dataclass
from dataclasses import field as _stored
from numbers import Real
from typing import Any, NoReturn

import numpy as np

from .checks import GeometryError
from .dual import Dual
from .formula import ASCII_PI, CONSTANTS, FUNCTIONS, OPERATORS, VARIABLES, Source, cut, parsed
from .typeset import latex

__all__ = ["Field", "field", "named_number", "number"]

_Function = Callable[[Any, Any], Any]
_Part = float | _Function


@dataclass(frozen=True, eq=False, slots=True)
class Field:
    """One of ū(u, v), v̄(u, v). Make it with `field`.

    Attributes
    ----------
    text
        the formula as typed, without white space at its ends; None for a Python function,
        which cannot be saved. ``field(f.text)`` gives an equal field.
    latex
        the formula typeset, without dollar signs.
    is_constant
        whether neither u nor v occurs. Such a field returns a plain float.
    name
        the argument it was given for; errors begin with it.
    """

    text: str | None
    latex: str
    is_constant: bool
    name: str
    _function: _Function = _stored(repr=False)

    def __call__(self, u: Any, v: Any) -> Any:
        """Return the value at (u, v): numbers, arrays, `Series` or `Dual`, in any mixture.

        Outside the domain of a function the value is NaN, at a pole it is infinite; nothing is
        raised or warned about.
        """
        with np.errstate(all="ignore"):
            return self._function(_prepared(u), _prepared(v))

    def partials(self, u: Any, v: Any) -> tuple[Any, Any]:
        """Return ∂f/∂u and ∂f/∂v at numbers or arrays u, v, from f(u + ε, v) and f(u, v + ε)."""
        u, v = np.broadcast_arrays(np.asarray(u, dtype=float), np.asarray(v, dtype=float))
        one, zero = np.ones(u.shape), np.zeros(u.shape)
        results = self(Dual(u, one), Dual(v, zero)), self(Dual(u, zero), Dual(v, one))
        slopes = [result.dual if isinstance(result, Dual) else zero for result in results]
        return slopes[0] + zero, slopes[1] + zero

    def __repr__(self) -> str:
        return f"field({'a Python function' if self.text is None else repr(self.text)})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Field):
            return NotImplemented
        return self is other or (self.text is not None and self.text == other.text)

    def __hash__(self) -> int:
        return hash(self.text) if self.text is not None else object.__hash__(self)


def field(value: Any, name: str = "field") -> Field:
    """Return ū or v̄ as a `Field`.

    Parameters
    ----------
    value
        a formula in u and v (``"u - v"``, ``"sin(2*u)"``), a real number, a Python function of
        (u, v) built from numpy's functions, or a `Field`, which is returned as it is.
    name
        the argument's name, with which errors begin.

    Raises
    ------
    FormulaError
        if a formula cannot be read; it knows the place.
    GeometryError
        if the value is none of these, or a number that is not finite.

    Notes
    -----
    Formulas have ``+ - * / ** ( )``, numbers, ``pi`` (or π), ``e``, ``u``, ``v`` and sqrt exp log
    sin cos tan arcsin arccos arctan arctan2 sinh cosh tanh abs (asin, acos, atan, atan2 too).
    Angles are in radians. A whole constant exponent (to 1024) is a product, so u**2 is smooth
    through u = 0; any other power is a real one, a**b = exp(b log a), and needs a > 0.
    """
    if isinstance(value, Field):
        return value
    if isinstance(value, str):
        return _typed(value, name)
    if _is_real(value):
        return _typed(named_number(value, name), name)
    if callable(value):
        typeset = r"\mathrm{Python\ function}"
        return Field(None, typeset, False, name, _guarded(value, name))
    raise GeometryError(
        f"`{name}` must be a formula in u and v, a number or a Python function of (u, v); "
        f"got {_brief(value)}; write for example 'u - v'"
    )


def number(text: str, name: str = "number") -> float:
    """Return the value of a typed constant such as ``3*pi/8``: a formula without u and v.

    Raises
    ------
    FormulaError
        if it cannot be read, is not finite, or contains u or v.
    """
    if not isinstance(text, str):
        raise GeometryError(
            f"`{name}` must be typed text; got {_brief(text)}; write for example '3*pi/8'"
        )
    source = Source(name, text)
    tree = parsed(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id in VARIABLES:
            raise source.error(
                node.col_offset,
                f"'{node.id}' is not a number",
                "write a constant such as 2.5 or 3*pi/8",
            )
    value = _build(tree, source)
    assert isinstance(value, float)
    return value


def named_number(value: Any, name: str = "number") -> str:
    """Return the shortest good text for a number: ``3*pi/8``, ``-pi``, ``2``, ``0.1``.

    Fractions of π with a denominator up to 24 are recognised, up to 6π. The text always gives
    back exactly the same float through `number`; a float that is one rounding step away from a
    fraction of π is written out.
    """
    if not _is_real(value):
        raise GeometryError(f"`{name}` must be a real number; got {_brief(value)}")
    try:
        plain = float(value)
    except OverflowError:
        plain = math.inf
    if not math.isfinite(plain):
        raise GeometryError(f"`{name}` must be a finite number; got {plain}; give another one")
    return _fraction_of_pi(plain) or _digits(plain)


def _digits(value: float) -> str:
    if value == 0.0:
        return "0"
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def _fraction_of_pi(value: float) -> str | None:
    turns = abs(value) / math.pi
    if not 1 / 48 < turns < 6.1:
        return None
    sign = "-" if value < 0 else ""
    for below in range(1, 25):
        above = round(turns * below)
        if above and abs(turns * below - above) < 1e-13:
            return _written_fraction(abs(value), above, below, sign)
    return None


def _written_fraction(size: float, above: int, below: int, sign: str) -> str | None:
    """Write a fraction of π in that order of operations which gives exactly this float."""
    if above * math.pi / below == size:
        many = f"{above}*" if above > 1 else ""
        return f"{sign}{many}pi" + (f"/{below}" if below > 1 else "")
    if above / below * math.pi == size:
        return f"{sign}{above}/{below}*pi"
    return None


def _is_real(value: Any) -> bool:
    if isinstance(value, np.ndarray):
        return value.ndim == 0 and value.dtype.kind in "fiu"
    return isinstance(value, Real) and not isinstance(value, (bool, np.bool_))


def _brief(value: object) -> str:
    text = " ".join(reprlib.repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


# -- Python functions ------------------------------------------------------------------------------


def _prepared(value: Any) -> Any:
    """Make plain numbers and lists numpy's, so that 1/0 is infinite and 2**-1 is not whole."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return value
    if hasattr(value, "__array_ufunc__") and not isinstance(value, (np.ndarray, np.generic)):
        return value
    return np.asarray(value, dtype=np.float64)[()]


def _guarded(function: Callable[[Any, Any], Any], name: str) -> _Function:
    """Call the reader's function; whatever goes wrong in it is said with the remedy."""

    def guarded(u: Any, v: Any) -> Any:
        try:
            result = function(u, v)
        except Exception as error:
            raise GeometryError(
                f"`{name}`: the Python function failed ({type(error).__name__}: "
                f"{_one_line(error)}); take two arguments u, v and use numpy's functions "
                "(np.sin, not math.sin) without if"
            ) from error
        return _checked_result(result, (u, v), name)

    return guarded


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text if len(text) <= 120 else text[:117] + "..."


def _checked_result(result: Any, arguments: tuple[Any, Any], name: str) -> Any:
    if _is_real(result):
        return float(result)
    if isinstance(result, np.ndarray):
        # An array computed from a Series has lost its derivatives; a constant is a plain number.
        lost = all(not isinstance(a, (np.ndarray, np.generic)) for a in arguments)
        if result.dtype.kind in "fiu" and not lost:
            return result
    elif hasattr(result, "__array_ufunc__") and not isinstance(result, np.generic):
        return result
    raise GeometryError(
        f"`{name}`: the Python function returned {_brief(result)}; return an expression in u and v "
        "made with numpy's functions, or a plain number"
    )


# -- typed formulas --------------------------------------------------------------------------------


@functools.lru_cache(maxsize=64)  # a design asks for the same two formulas at every move
def _typed(text: str, name: str) -> Field:
    source = Source(name, text)
    tree = parsed(source)
    part = _build(tree, source)
    constant = isinstance(part, float)
    clean = re.sub(r"\s", " ", text).strip()
    return Field(clean, latex(tree, text), constant, name, _as_function(part))


def _as_function(part: _Part) -> _Function:
    if not isinstance(part, float):
        return part
    value = part
    return lambda u, v: value


def _build(node: ast.expr, source: Source) -> _Part:
    """Return the value of a constant part, or a function of (u, v)."""
    match node:
        case ast.Constant():
            part: _Part = _literal(node, source.text)
        case ast.Name(id=name):
            part = _named(name)
        case ast.UnaryOp(op=op, operand=operand):
            inner = _build(operand, source)
            part = _applied(operator.neg, inner) if isinstance(op, ast.USub) else inner
        case ast.Call(func=ast.Name(id=name), args=args):
            part = _applied(FUNCTIONS[name], *(_build(argument, source) for argument in args))
        case ast.BinOp():
            part = _binary(node, source)
        case _:  # pragma: no cover - the white list was checked before
            raise AssertionError(node)
    if isinstance(part, float) and not math.isfinite(part):
        _undefined(node, source)
    return part


def _literal(node: ast.Constant, text: str) -> float:
    # Read from the text, not from Python's whole number, which may be too long for a float.
    return float(text[node.col_offset : node.end_col_offset])


def _named(name: str) -> _Part:
    if name == "u":
        return lambda u, v: u
    if name == "v":
        return lambda u, v: v
    return math.pi if name == ASCII_PI else CONSTANTS[name]


def _binary(node: ast.BinOp, source: Source) -> _Part:
    left, right = _build(node.left, source), _build(node.right, source)
    if isinstance(node.op, ast.Div) and right == 0.0:
        _undefined(node, source, "divides by zero")
    return _applied(OPERATORS[type(node.op)], left, right)


def _applied(function: Callable[..., Any], *parts: _Part) -> _Part:
    """Apply a numpy function to parts; to constants at once, in floats of fixed size."""
    constants = [np.float64(part) for part in parts if isinstance(part, float)]
    if len(constants) == len(parts):
        with np.errstate(all="ignore"):
            return float(function(*constants))
    if len(parts) == 1:
        return _of_one(function, _as_function(parts[0]))
    return _of_two(function, *parts)


def _of_one(function: Callable[[Any], Any], a: _Function) -> _Function:
    return lambda u, v: function(a(u, v))


def _of_two(function: Callable[[Any, Any], Any], a: _Part, b: _Part) -> _Function:
    if isinstance(a, float):
        left, right = a, _as_function(b)
        return lambda u, v: function(left, right(u, v))
    if isinstance(b, float):
        left_of, fixed = a, b
        return lambda u, v: function(left_of(u, v), fixed)
    first, second = a, b
    return lambda u, v: function(first(u, v), second(u, v))


def _undefined(node: ast.expr, source: Source, what: str = "is no finite real number") -> NoReturn:
    typed = " ".join(source.text[node.col_offset : node.end_col_offset].split())
    raise source.error(
        node.col_offset, f"'{cut(typed)}' {what}", "write something that stays finite and real"
    )
