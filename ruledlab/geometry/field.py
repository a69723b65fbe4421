"""The choices ū(u, v) and v̄(u, v): typed formulas, numbers, Python functions, and a menu.

What ū and v̄ mean. With x̄ = ū x_u + v̄ x_v the line in direction x(u, v) is

    { ū e_z + v̄ e_φ + s x : s real },   e_φ = (−sin u, cos u, 0),

for e_φ is perpendicular both to the axis e_z and to x. So the common perpendicular of the line and
the z-axis leaves the axis at the height **ū** and has the signed length **v̄**: û = u + ε ū and
v̂ = v + ε v̄ are the dual longitude and the dual angle between the line and the axis. The meanings
in `CHOICES` all follow from this.

A typed formula is read once, against a list of what is allowed, and becomes nested functions that
call numpy only. It is never handed to Python as code.
"""

from __future__ import annotations

import ast
import difflib
import functools
import keyword
import math
import operator
import re
import reprlib
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from dataclasses import field as _stored
from numbers import Real
from typing import Any, NoReturn

import numpy as np

from .checks import GeometryError
from .dual import Dual

__all__ = ["CHOICES", "Choice", "Field", "FormulaError", "field", "named_number", "number"]

LONGEST = 500
"""Characters a formula may have; this also bounds the number of its parts."""

MOST_BRACKETS = 50
"""Brackets that may be open at once."""

DEEPEST = 100
"""Operations that may stand inside one another, a sum of n terms counting n − 1."""

_Function = Callable[[Any, Any], Any]
_Part = float | _Function

_CONSTANTS = {"pi": math.pi, "π": math.pi, "e": math.e}
_VARIABLES = ("u", "v")
_FUNCTIONS: dict[str, np.ufunc] = {
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "arcsin": np.arcsin,
    "arccos": np.arccos,
    "arctan": np.arctan,
    "arctan2": np.arctan2,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "abs": np.absolute,
}
_ALIASES = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2"}
_CALLABLE = {**_FUNCTIONS, **{alias: _FUNCTIONS[name] for alias, name in _ALIASES.items()}}
_KNOWN = f"known are u, v, pi, e and {', '.join(_FUNCTIONS)}"


class FormulaError(GeometryError):
    """A typed formula that cannot be read.

    Attributes
    ----------
    name
        the argument, for example ``ubar``.
    text
        the formula exactly as typed.
    position
        where the trouble is, in characters of ``text``, counted from 0. The message names the
        column as editors do, counted from 1.
    message
        what is wrong and what to write instead, in one line, without the argument's name.
    """

    def __init__(self, name: str, text: str, position: int, message: str) -> None:
        super().__init__(name, text, position, message)
        self.name = name
        self.text = text
        self.position = position
        self.message = message

    def __str__(self) -> str:
        return f"`{self.name}`: {self.message}"

    def pointer(self, width: int = 72) -> str:
        """Return two lines for a monospace display: the formula, and a caret under the place."""
        first = max(0, self.position - width // 2)
        shown = "".join(map(_displayed, self.text[first : first + width]))
        before, after = shown[: self.position - first], shown[self.position - first :]
        left = "…" if first else ""
        right = "…" if first + width < len(self.text) else ""
        return f"{left}{before}{after}{right}\n{' ' * (len(left) + _columns(before))}^"


def _displayed(character: str) -> str:
    """Return the character itself, a space for white space, a box for what has no shape."""
    if character.isspace():
        return " "
    return character if character.isprintable() else "\N{REPLACEMENT CHARACTER}"


def _columns(text: str) -> int:
    """Width of the text on a monospace display: wide letters take two columns, accents none."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)


# -- the public values -----------------------------------------------------------------------------


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
        latex = r"\mathrm{Python\ function}"
        return Field(None, latex, False, name, _guarded(value, name))
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
    source = _Source(name, text)
    tree = _parsed(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id in _VARIABLES:
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


# -- typed formulas: from text to tokens -----------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Source:
    """What was typed, and for which argument."""

    name: str
    text: str

    def error(self, position: int, what: str, remedy: str) -> FormulaError:
        message = f"{what} at column {position + 1}; {remedy}"
        return FormulaError(self.name, self.text, position, message)


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    position: int

    @property
    def is_function(self) -> bool:
        return self.text in _CALLABLE


_TOKEN = re.compile(
    r"""(?P<space>\s+)
    |(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
    |(?P<name>[A-Za-z_][A-Za-z_0-9]*|π)
    |(?P<foreign>//|<=|>=|==|!=|:=|->|<<|>>)
    |(?P<operator>\*\*|[-+*/])
    |(?P<open>\()|(?P<close>\))|(?P<comma>,)
    |(?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)

_SLIPS = {
    "^": "write ** for a power",
    "//": "write / for division",
    "\\": "write / for division",
    "÷": "write / for division",
    "·": "write * for a product",
    "×": "write * for a product",
    "−": "write the minus sign of the keyboard, -",
    "–": "write the minus sign of the keyboard, -",
    "—": "write the minus sign of the keyboard, -",
    "√": "write sqrt(…)",
    "∞": "use finite numbers only",
    "°": "angles are in radians, write 30*pi/180 for 30 degrees",
    ".": "a point belongs only inside a number such as 2.5",
    "|": "write abs(…) for the absolute value",
    "'": "write the formula without quotation marks",
    '"': "write the formula without quotation marks",
    "²": "write **2",
    "³": "write **3",
    **dict.fromkeys("[]{}", "use round brackets ( )"),
    **dict.fromkeys(("=", ":=", "->"), "write only the right-hand side, such as u - v"),
    **dict.fromkeys(("<", ">", "<=", ">=", "==", "!="), "a formula cannot compare"),
}


_ALLOWED = "a formula has only numbers, names, + - * / ** and round brackets"


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text):
        if match.lastgroup != "space":
            yield _Token(str(match.lastgroup), match.group(), match.start())
    yield _Token("end", "", len(text))


def _foreign(token: _Token, source: _Source) -> NoReturn:
    """Refuse a character that no formula has, with the likeliest remedy."""
    character = token.text
    plain = unicodedata.normalize("NFKC", character)
    remedy = _SLIPS.get(character)
    if remedy is None and plain != character and plain.isascii() and plain.isprintable():
        remedy = f"write it with the plain letter or sign {plain}"
    if character.isalpha():
        raise source.error(token.position, f"unknown name {_quoted(character)}", remedy or _KNOWN)
    if remedy is None:
        remedy = _ALLOWED if character.isprintable() else "delete it"
    raise source.error(token.position, f"{_quoted(character)} cannot be used", remedy)


def _quoted(text: str) -> str:
    """Quote what was typed, on one line: what cannot be seen by its code point."""
    if not text.isprintable():
        return f"the invisible character U+{ord(text[0]):04X}"
    return f"'{text}'" if len(text) <= 24 else f"'{text[:21]}…'"


# -- typed formulas: does one token fit after the other? -------------------------------------------


@dataclass(slots=True)
class _Bracket:
    position: int
    function: _Token | None
    arguments: int = 1


class _Order:
    """Follows the tokens from left to right and refuses the first that cannot stand there."""

    def __init__(self, source: _Source) -> None:
        self.source = source
        self.tokens = list(_tokens(source.text))
        self.brackets: list[_Bracket] = []
        self.wants_operand = True
        self.previous = _Token("start", "", 0)

    def check(self) -> list[_Token]:
        for index, token in enumerate(self.tokens):
            self.following = self.tokens[min(index + 1, len(self.tokens) - 1)]
            getattr(self, f"_{token.kind}")(token)
            self.previous = token
        return self.tokens[:-1]

    def _other(self, token: _Token) -> None:
        _foreign(token, self.source)

    _foreign = _other

    def _number(self, token: _Token) -> None:
        self._operand(token)

    def _name(self, token: _Token) -> None:
        known = token.is_function or token.text in _CONSTANTS or token.text in _VARIABLES
        if not known:
            _unknown(token, self.previous, self.following, self.source)
        self._operand(token)
        if token.is_function and self.following.kind != "open":
            self._bare_function(token)

    def _bare_function(self, token: _Token) -> NoReturn:
        next_one = self.following
        argument = next_one.text if next_one.kind in ("number", "name") else "…"
        power = "**2" if next_one.text in ("**", "^") else ""
        what = f"'{token.text}' has no argument in brackets"
        raise self.source.error(token.position, what, f"write {token.text}({argument}){power}")

    def _operand(self, token: _Token) -> None:
        if not self.wants_operand:
            self._two_operands(token)
        self.wants_operand = False

    def _two_operands(self, token: _Token) -> NoReturn:
        left, right = _cut(self.previous.text), _cut(token.text)
        if token.is_function:
            right += "(…)"
        remedy = f"write {left}*{right}"
        if left.isdigit() and right.isdigit():
            remedy += f", or {left}.{right} for a decimal number"
        elif self.previous.text in _VARIABLES and token.kind == "number":
            remedy += f", or {left}**{right} for a power"
        raise self.source.error(
            token.position, f"no operator between '{left}' and '{_cut(token.text)}'", remedy
        )

    def _operator(self, token: _Token) -> None:
        if self.wants_operand and token.text not in ("+", "-"):
            raise self.source.error(
                token.position,
                f"'{token.text}' has nothing on its left",
                f"write a number, u or v before it{_double_star(self.previous, token)}",
            )
        self.wants_operand = True

    def _open(self, token: _Token) -> None:
        function = self.previous if self.previous.is_function else None
        if function is None and not self.wants_operand:
            left = _cut(self.previous.text)
            what = f"no operator between '{left}' and '('"
            if self.previous.kind == "name":
                what = f"'{left}' is not a function, yet a bracket follows"
            raise self.source.error(token.position, what, f"write {left}*(")
        if len(self.brackets) == MOST_BRACKETS:
            raise self.source.error(
                token.position,
                f"more than {MOST_BRACKETS} brackets inside one another",
                "write a simpler formula",
            )
        self.brackets.append(_Bracket(token.position, function))
        self.wants_operand = True

    def _close(self, token: _Token) -> None:
        if not self.brackets:
            raise self.source.error(
                token.position, "')' closes no bracket", "remove it, or write a ( before it"
            )
        bracket = self.brackets.pop()
        if self.wants_operand:
            self._nothing_before_close(bracket)
        if bracket.function is not None:
            self._check_arguments(bracket, bracket.function)

    def _nothing_before_close(self, bracket: _Bracket) -> NoReturn:
        if self.previous.kind != "open":
            self._unfinished()
        if bracket.function is None:
            raise self.source.error(
                bracket.position, "empty brackets", "write something between them"
            )
        self._wrong_count(bracket.function, bracket.function.position, "has none")

    def _check_arguments(self, bracket: _Bracket, function: _Token) -> None:
        if bracket.arguments < _CALLABLE[function.text].nin:
            self._wrong_count(function, function.position, "has one")

    def _wrong_count(self, function: _Token, position: int, has: str) -> NoReturn:
        name = function.text
        two = _CALLABLE[name].nin == 2
        pattern = f"{name}(y, x), the angle of the point (x, y)" if two else f"{name}(…)"
        needs = "two arguments" if two else "one argument"
        raise self.source.error(position, f"'{name}' needs {needs} but {has}", f"write {pattern}")

    def _comma(self, token: _Token) -> None:
        function = self.brackets[-1].function if self.brackets else None
        if self.previous.kind == self.following.kind == "number" and (
            function is None or _CALLABLE[function.text].nin == 1
        ):
            decimal = f"{_cut(self.previous.text)}.{_cut(self.following.text)}"
            raise self.source.error(
                token.position, "a decimal comma", f"write {decimal} with a decimal point"
            )
        if function is None:
            raise self.source.error(
                token.position,
                "',' separates nothing here",
                "write a decimal point in a number, and commas only as in arctan2(y, x)",
            )
        if self.wants_operand:
            raise self.source.error(
                token.position, "nothing stands before ','", "write an argument"
            )
        self.brackets[-1].arguments += 1
        if self.brackets[-1].arguments > _CALLABLE[function.text].nin:
            self._wrong_count(function, token.position, "has more")
        self.wants_operand = True

    def _end(self, token: _Token) -> None:
        if self.previous.kind == "start":
            raise FormulaError(
                self.source.name,
                self.source.text,
                0,
                "the formula is empty; write a number or a formula such as u - v",
            )
        if self.wants_operand and self.previous.kind != "open":
            self._unfinished()
        if self.brackets:
            raise self.source.error(
                self.brackets[-1].position, "'(' is never closed", "write the missing )"
            )

    def _unfinished(self) -> NoReturn:
        raise self.source.error(
            self.previous.position,
            f"nothing follows '{self.previous.text}'",
            "write a number, u or v after it, or remove it",
        )


def _cut(text: str) -> str:
    return text if len(text) <= 24 else text[:21] + "…"


def _double_star(previous: _Token, token: _Token) -> str:
    stars = previous.kind == "operator" and previous.text[0] == token.text[0] == "*"
    return "; a power is ** without a gap" if stars else ""


# -- typed formulas: names that are not known ------------------------------------------------------

_INSTEAD = {
    "ln": "write log(…), the natural logarithm",
    "lg": "write log(…)/log(10)",
    "log10": "write log(…)/log(10)",
    "log2": "write log(…)/log(2)",
    "cot": "write cos(…)/sin(…)",
    "sec": "write 1/cos(…)",
    "csc": "write 1/sin(…)",
    "pow": "write a**b for a power",
    "power": "write a**b for a power",
    "np": "write sin(u) without np.",
    "numpy": "write sin(u) without numpy.",
    "math": "write sin(u) without math.",
    "t": "ū and v̄ are functions of the place (u, v), not of t; write u or v",
    "theta": "write v, the angle from the z-axis",
    "phi": "write u, the longitude",
    "inf": "use finite numbers only",
    "nan": "use finite numbers only",
}
_INSTEAD_AFTER_NUMBER = {
    "_": "write the number without _",
    **dict.fromkeys("ijJ", "only real numbers are used"),
}
_PIECES = re.compile(r"(?:pi|[uve]|[0-9]+)+")
_PIECE = re.compile(r"pi|[uve]|[0-9]+")


def _unknown(token: _Token, previous: _Token, following: _Token, source: _Source) -> NoReturn:
    if keyword.iskeyword(token.text):
        what = f"'{token.text}' is a word of Python, not of a formula,"
        raise source.error(token.position, what, _ALLOWED)
    kind = "function" if following.kind == "open" else "name"
    what = f"unknown {kind} {_quoted(token.text)}"
    remedy = _INSTEAD_AFTER_NUMBER.get(token.text[0]) if previous.kind == "number" else None
    raise source.error(token.position, what, remedy or _suggestion(token.text, kind))


def _suggestion(name: str, kind: str) -> str:
    lower = name.lower()
    if name in _INSTEAD:
        return _INSTEAD[name]
    if lower in _CALLABLE or lower in _CONSTANTS or lower in _VARIABLES:
        return f"write {lower}"
    if _PIECES.fullmatch(name):
        return f"write {_cut('*'.join(_PIECE.findall(name)))}"
    if kind == "name" and name[:-1] in _CALLABLE and name[-1] in "uve0123456789":
        return f"write {name[:-1]}({name[-1]})"
    return _nearest(lower[:40])


def _nearest(name: str) -> str:
    known = [word for word in (*_CALLABLE, *_INSTEAD) if len(word) > 2]
    for near in difflib.get_close_matches(name, known, 1):
        return _INSTEAD.get(near, f"did you mean {near}?")
    return _KNOWN


# -- typed formulas: the syntax tree ---------------------------------------------------------------


def _parsed(source: _Source) -> ast.expr:
    """Return the syntax tree of a formula; its columns are those of the typed text."""
    if len(source.text) > LONGEST:
        message = (
            f"the formula has {len(source.text)} characters; at most {LONGEST} can be read; "
            "shorten it or give a Python function"
        )
        raise FormulaError(source.name, source.text, LONGEST, message)
    tokens = _Order(source).check()
    try:
        body = ast.parse(_plain(tokens), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise source.error(0, "this cannot be read", "write a simpler formula") from None
    for node in ast.walk(body):
        if isinstance(node, ast.expr):
            node.col_offset -= 1
            node.end_col_offset = (node.end_col_offset or 0) - 1
    _check_tree(body, source)
    return body


def _plain(tokens: list[_Token]) -> str:
    """Write the tokens as ASCII in brackets, every one in its own column plus one.

    Only tokens that passed the check reach Python's parser: no word of the language, no string,
    no comment, no line break, no number it would complain about.
    """
    characters = [" "] * (tokens[-1].position + len(tokens[-1].text))
    for token in tokens:
        zeros = len(token.text) - len(token.text.lstrip("0"))
        # Python refuses 007; the spare zeros become spaces.
        spare = zeros if token.kind == "number" and token.text[zeros : zeros + 1].isdigit() else 0
        text = " " * spare + token.text[spare:]
        characters[token.position : token.position + len(text)] = text.replace("π", _ASCII_PI)
    return f"({''.join(characters)})"


_ASCII_PI = "P"  # cannot be typed: it is not among the known names


def _check_tree(body: ast.expr, source: _Source) -> None:
    """Go through the tree level by level, refusing what is too deep or not allowed."""
    level: list[ast.expr] = [body]
    for _ in range(DEEPEST + 1):
        level = [part for node in level for part in _operands(node, source)]
    if level:
        raise source.error(
            level[0].col_offset,
            f"more than {DEEPEST} operations inside one another",
            "write a simpler formula or give a Python function",
        )


def _operands(node: ast.expr, source: _Source) -> list[ast.expr]:
    """Return the operands of an allowed node. This is the white list."""
    match node:
        case ast.Constant() | ast.Name():
            return []
        case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
            return [operand]
        case ast.BinOp(op=op, left=left, right=right) if type(op) in _BINARY:
            return [left, right]
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in _CALLABLE:
            return args
    raise source.error(node.col_offset, "this is not part of a formula", _KNOWN)


# A constant exponent stays a plain number: arrays, Series and Dual all take whole ones as products.
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


# -- typed formulas: from the tree to functions ----------------------------------------------------


@functools.lru_cache(maxsize=64)  # a design asks for the same two formulas at every move
def _typed(text: str, name: str) -> Field:
    source = _Source(name, text)
    tree = _parsed(source)
    part = _build(tree, source)
    constant = isinstance(part, float)
    clean = re.sub(r"\s", " ", text).strip()
    return Field(clean, _latex(tree, text).text, constant, name, _as_function(part))


def _as_function(part: _Part) -> _Function:
    if not isinstance(part, float):
        return part
    value = part
    return lambda u, v: value


def _build(node: ast.expr, source: _Source) -> _Part:
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
            part = _applied(_CALLABLE[name], *(_build(argument, source) for argument in args))
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
    return math.pi if name == _ASCII_PI else _CONSTANTS[name]


def _binary(node: ast.BinOp, source: _Source) -> _Part:
    left, right = _build(node.left, source), _build(node.right, source)
    if isinstance(node.op, ast.Div) and right == 0.0:
        _undefined(node, source, "divides by zero")
    return _applied(_BINARY[type(node.op)], left, right)


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


def _undefined(node: ast.expr, source: _Source, what: str = "is no finite real number") -> NoReturn:
    typed = " ".join(source.text[node.col_offset : node.end_col_offset].split())
    raise source.error(
        node.col_offset, f"'{_cut(typed)}' {what}", "write something that stays finite and real"
    )


# -- typesetting -----------------------------------------------------------------------------------

_SUM, _SIGNED, _PRODUCT, _POWER, _ATOM = range(5)
_OPERATOR_NAMES = {"arctan2": r"\operatorname{arctan2}", "log": r"\ln"}
_RAISED = ("sin", "cos", "tan", "sinh", "cosh", "tanh")


@dataclass(frozen=True, slots=True)
class _Typeset:
    """Typeset text and how tightly it holds together: _SUM loosest, _ATOM tightest."""

    text: str
    level: int

    def within(self, level: int) -> str:
        """Return the text, in brackets if it holds less tightly than asked."""
        return self.text if self.level >= level else _bracketed(self.text)


def _bracketed(text: str) -> str:
    tall = any(sign in text for sign in (r"\frac", r"\sqrt", "^"))
    return rf"\left({text}\right)" if tall else f"({text})"


def _latex(node: ast.expr, text: str) -> _Typeset:
    match node:
        case ast.Constant():
            return _latex_number(text[node.col_offset : node.end_col_offset])
        case ast.Name(id=name):
            greek = {"pi": r"\pi", _ASCII_PI: r"\pi", "e": r"\mathrm{e}"}
            return _Typeset(greek.get(name, name), _ATOM)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return _Typeset("-" + _latex(operand, text).within(_PRODUCT), _SIGNED)
        case ast.UnaryOp(operand=operand):
            return _latex(operand, text)
        case ast.Call(func=ast.Name(id=name), args=args):
            return _latex_call(_ALIASES.get(name, name), [_latex(a, text).text for a in args])
        case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
            return _latex_power(base, exponent, text)
        case ast.BinOp(op=op, left=left, right=right):
            return _LATEX_BINARY[type(op)](_latex(left, text), _latex(right, text))
    raise AssertionError(node)  # pragma: no cover - the white list was checked before


def _latex_number(typed: str) -> _Typeset:
    digits, _, exponent = typed.lower().partition("e")
    whole, point, rest = digits.partition(".")
    mantissa = (whole.lstrip("0") or "0") + (point + rest if rest else "")
    if not exponent:
        return _Typeset(mantissa, _ATOM)
    power = f"10^{{{int(exponent)}}}"
    if mantissa == "1":
        return _Typeset(power, _POWER)
    return _Typeset(rf"{mantissa} \times {power}", _PRODUCT)


def _latex_call(name: str, arguments: list[str]) -> _Typeset:
    inner = ", ".join(arguments)
    if name == "sqrt":
        return _Typeset(rf"\sqrt{{{inner}}}", _ATOM)
    if name == "abs":
        return _Typeset(rf"\left|{inner}\right|", _ATOM)
    if name == "exp":
        return _Typeset(rf"\mathrm{{e}}^{{{inner}}}", _POWER)
    return _Typeset(_OPERATOR_NAMES.get(name, f"\\{name}") + _bracketed(inner), _POWER)


def _latex_power(base: ast.expr, exponent: ast.expr, text: str) -> _Typeset:
    raised = f"^{{{_latex(exponent, text).text}}}"
    match base, exponent:
        case ast.Call(func=ast.Name(id=name), args=[argument]), ast.Constant(value=int()) if (
            name in _RAISED
        ):
            inner = _bracketed(_latex(argument, text).text)
            return _Typeset(f"\\{name}{raised}{inner}", _POWER)
    return _Typeset(_latex(base, text).within(_ATOM) + raised, _POWER)


def _latex_sum(left: _Typeset, right: _Typeset) -> _Typeset:
    signed = right.text.startswith("-")
    return _Typeset(f"{left.text} + {right.within(_ATOM if signed else _SUM)}", _SUM)


def _latex_difference(left: _Typeset, right: _Typeset) -> _Typeset:
    return _Typeset(f"{left.text} - {right.within(_PRODUCT)}", _SUM)


def _latex_product(left: _Typeset, right: _Typeset) -> _Typeset:
    a, b = left.within(_SIGNED), right.within(_PRODUCT)
    sign = r" \cdot " if _needs_dot(a, b) else " "
    return _Typeset(a + sign + b, min(left.level, _PRODUCT) if left.level == _SIGNED else _PRODUCT)


def _needs_dot(left: str, right: str) -> bool:
    """Avoid 2 3 for 2·3, 2⅓ for 2·⅓ and u(v) for u·(v)."""
    if right[0].isdigit():
        return True
    if left[-1].isdigit():
        return right.startswith(r"\frac")
    return left[-1].isalpha() and right.startswith(("(", r"\left("))


def _latex_quotient(left: _Typeset, right: _Typeset) -> _Typeset:
    if left.level == _SIGNED:
        return _Typeset(rf"-\frac{{{left.text[1:]}}}{{{right.text}}}", _SIGNED)
    return _Typeset(rf"\frac{{{left.text}}}{{{right.text}}}", _PRODUCT)


_LATEX_BINARY: dict[type[ast.operator], Callable[[_Typeset, _Typeset], _Typeset]] = {
    ast.Add: _latex_sum,
    ast.Sub: _latex_difference,
    ast.Mult: _latex_product,
    ast.Div: _latex_quotient,
}


# -- the menu --------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Choice:
    """A named pair of formulas ū, v̄ with its geometric meaning.

    Attributes
    ----------
    key
        short name for files.
    title
        what a menu shows.
    ubar, vbar
        the formulas, with plain numbers where the meaning speaks of a length: edit them.
    meaning
        one or two sentences: which lines these are.
    """

    key: str
    title: str
    ubar: str
    vbar: str
    meaning: str


CHOICES: tuple[Choice, ...] = (
    Choice(
        "origin",
        "Lines through the origin",
        "0",
        "0",
        "Every line passes through the origin: the surface is a cone with its apex there.",
    ),
    Choice(
        "cone",
        "Cone with its apex on the axis",
        "1",
        "0",
        "ū = h: every line passes through the point (0, 0, h) of the z-axis, here h = 1.",
    ),
    Choice(
        "bundle",
        "Cone with any apex",
        "0.5 - (cos(u) + 0.8*sin(u))*cos(v)/sin(v)",
        "0.8*cos(u) - sin(u)",
        "x̄ = a × x: every line passes through one point a, here (1, 0.8, 0.5).",
    ),
    Choice(
        "hyperboloid",
        "Touching a sphere along its equator",
        "0",
        "1",
        "v̄ = r: every line touches the sphere of radius r = 1 about the origin at a point of its "
        "equator, and there the cylinder of radius r about the z-axis too; "
        "for constant v they form a hyperboloid of one sheet.",
    ),
    Choice(
        "sphere",
        "Touching a sphere anywhere",
        "cos(pi/3)/sin(v)",
        "sin(pi/3)",
        "ū = r cos α / sin v, v̄ = r sin α: every line touches the sphere of radius r = 1 about "
        "the origin, at a point turned by the angle α = π/3 from the meridian through the line's "
        "direction; not defined at the poles.",
    ),
    Choice(
        "helicoid",
        "Helicoidal, meeting the axis",
        "0.5*u",
        "0",
        "ū = p u: every line meets the z-axis, at a height that grows by p = 0.5 for each radian "
        "of longitude; for v = π/2 a right helicoid, for other constant v an oblique one.",
    ),
    Choice(
        "helix",
        "Helicoidal around a cylinder",
        "0.5*u",
        "-1",
        "ū = p u, v̄ = −r: every line touches the cylinder of radius r = 1 about the z-axis, at a "
        "point of a helix that climbs p = 0.5 for each radian; "
        "for v = arctan(r/p) they are the helix's own tangents.",
    ),
    Choice(
        "linear_complex",
        "Lines of a linear complex",
        "0",
        "0.5*cos(v)/sin(v)",
        "v̄ = p cos v / sin v, with any ū: every line is perpendicular, in each of its points, to "
        "the path of that point in the screw motion about the z-axis with pitch p = 0.5 for each "
        "radian; not defined at the poles.",
    ),
    Choice(
        "twist",
        "Twisted bundle",
        "0",
        "0.5*sin(v)/cos(v)",
        "v̄ = k tan v: a line at the distance d from the z-axis is turned against it by "
        "arctan(d/k), here k = 0.5, so that through every point of space passes exactly one "
        "(an elliptic linear congruence); not defined for v = π/2.",
    ),
    Choice(
        "torus_normals",
        "Normals of a torus",
        "-cos(v)/sin(v)",
        "0",
        "ū = −R cos v / sin v: every line meets the z-axis and the circle of radius R = 1 about it "
        "in the plane z = 0, so it is normal to all tori around that circle; "
        "not defined at the poles.",
    ),
    Choice(
        "ellipsoid_normals",
        "Normals of an ellipsoid",
        "3*cos(v)/sqrt(sin(v)**2 + 4*cos(v)**2)",
        "0",
        "Every line is normal to the ellipsoid of revolution x² + y² + z²/4 = 1 in the point where "
        "its outward normal has the line's direction.",
    ),
    Choice(
        "saddle_normals",
        "Normals, from a support function",
        "-cos(v)*sin(2*u)",
        "sin(v)*cos(2*u)",
        "Every line is normal to the surface whose tangent plane with normal (x, y, z) has the "
        "distance x y from the origin, and to all its parallel surfaces.",
    ),
    Choice(
        "conoid",
        "Conoid",
        "sin(2*u)",
        "0",
        "Every line meets the z-axis, at a height that swings up and down twice in one turn; "
        "for v = π/2 this is Plücker's conoid z = 2xy/(x² + y²).",
    ),
    Choice(
        "coil",
        "Coil on a torus",
        "0.3*sin(5*u)",
        "1 + 0.3*cos(5*u)",
        "The point of each line nearest the z-axis lies on the torus with the radii 1 and 0.3 and "
        "winds five times round its tube while u makes one turn.",
    ),
    Choice(
        "waves",
        "Waves",
        "0.2*sin(6*u)*sin(v)",
        "1 + 0.2*cos(6*v)",
        "A hyperboloid disturbed: the lines' nearest points to the z-axis rise and fall by at most "
        "0.2 with u, and keep a distance from it between 0.8 and 1.2 that depends on v alone.",
    ),
    Choice(
        "paper",
        "The paper's examples: u − v, u + v",
        "u - v",
        "u + v",
        "The common perpendicular of each line and the z-axis leaves the axis at the height u − v "
        "and has the length u + v: the choice of the paper's two examples.",
    ),
)
"""The menu. In every entry ū is the height at which the common perpendicular of the line and the
z-axis leaves the axis, v̄ its signed length along (−sin u, cos u, 0)."""
