"""Typed formulas in u and v, from text to a syntax tree in which everything is allowed.

A formula is read once, token by token, against a list of what is allowed; the first that cannot
stand where it stands is refused with its place and a remedy. It is never handed to Python as code.
"""

from __future__ import annotations

import ast
import difflib
import keyword
import math
import operator
import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from .checks import GeometryError

__all__ = ["FormulaError", "Source", "parsed"]

LONGEST = 500
"""Characters a formula may have; this also bounds the number of its parts."""

LIKE = 0.7
"""How much a name must be like a known one to be taken for it: 0 not at all, 1 the same."""

MOST_BRACKETS = 50
"""Brackets that may be open at once."""

DEEPEST = 100
"""Operations that may stand inside one another, a sum of n terms counting n − 1."""

CONSTANTS = {"pi": math.pi, "π": math.pi, "e": math.e}
VARIABLES = ("u", "v")
_BY_NAME: dict[str, np.ufunc] = {
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
ALIASES = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2"}
FUNCTIONS = {**_BY_NAME, **{alias: _BY_NAME[name] for alias, name in ALIASES.items()}}
_KNOWN = f"known are u, v, pi, e and {', '.join(_BY_NAME)}"


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


# -- from text to tokens ---------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Source:
    """What was typed, and for which argument."""

    name: str
    text: str

    def error(self, position: int, what: str, remedy: str) -> FormulaError:
        """Return the error for a place in the text."""
        message = f"{what} at column {position + 1}; {remedy}"
        return FormulaError(self.name, self.text, position, message)


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    position: int

    @property
    def is_function(self) -> bool:
        return self.text in FUNCTIONS


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


def _foreign(token: _Token, source: Source) -> NoReturn:
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


# -- does one token fit after the other? -----------------------------------------------------------


@dataclass(slots=True)
class _Bracket:
    position: int
    function: _Token | None
    arguments: int = 1


class _Order:
    """Follows the tokens from left to right and refuses the first that cannot stand there."""

    def __init__(self, source: Source) -> None:
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
        known = token.is_function or token.text in CONSTANTS or token.text in VARIABLES
        if not known:
            _unknown(token, self.previous, self.following, self.source)
        self._operand(token)
        if token.is_function and self.following.kind != "open":
            self._bare_function(token)

    def _bare_function(self, token: _Token) -> NoReturn:
        next_one = self.following
        argument = self._argument_ahead()
        power = "**2" if next_one.text in ("**", "^") else ""
        what = f"'{token.text}' has no argument in brackets"
        raise self.source.error(token.position, what, f"write {token.text}({argument}){power}")

    def _argument_ahead(self) -> str:
        """Return what seems to be meant: u of sin u, 2*u of sin 2u."""
        at = self.tokens.index(self.following)
        number = self.tokens[at : at + 1 + (self.following.kind == "number")]
        parts = [token.text for token in number if token.kind in ("number", "name")]
        return "*".join(parts) or "…"

    def _operand(self, token: _Token) -> None:
        if not self.wants_operand:
            self._two_operands(token)
        self.wants_operand = False

    def _two_operands(self, token: _Token) -> NoReturn:
        left, right = cut(self.previous.text), cut(token.text)
        if token.is_function:
            right += "(…)"
        remedy = f"write {left}*{right}"
        if left.isdigit() and right.isdigit():
            remedy += f", or {left}.{right} for a decimal number"
        elif self.previous.text in VARIABLES and token.kind == "number":
            remedy += f", or {left}**{right} for a power"
        raise self.source.error(
            token.position, f"no operator between '{left}' and '{cut(token.text)}'", remedy
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
            left = cut(self.previous.text)
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
        if bracket.arguments < FUNCTIONS[function.text].nin:
            self._wrong_count(function, function.position, "has one")

    def _wrong_count(self, function: _Token, position: int, has: str) -> NoReturn:
        name = function.text
        two = FUNCTIONS[name].nin == 2
        pattern = f"{name}(y, x), the angle of the point (x, y)" if two else f"{name}(…)"
        needs = "two arguments" if two else "one argument"
        raise self.source.error(position, f"'{name}' needs {needs} but {has}", f"write {pattern}")

    def _comma(self, token: _Token) -> None:
        function = self.brackets[-1].function if self.brackets else None
        if self.previous.kind == self.following.kind == "number" and (
            function is None or FUNCTIONS[function.text].nin == 1
        ):
            decimal = f"{cut(self.previous.text)}.{cut(self.following.text)}"
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
        if self.brackets[-1].arguments > FUNCTIONS[function.text].nin:
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


def cut(text: str) -> str:
    return text if len(text) <= 24 else text[:21] + "…"


def _double_star(previous: _Token, token: _Token) -> str:
    stars = previous.kind == "operator" and previous.text[0] == token.text[0] == "*"
    return "; a power is ** without a gap" if stars else ""


# -- names that are not known ----------------------------------------------------------------------

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


def _unknown(token: _Token, previous: _Token, following: _Token, source: Source) -> NoReturn:
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
    if lower in FUNCTIONS or lower in CONSTANTS or lower in VARIABLES:
        return f"write {lower}"
    if _PIECES.fullmatch(name):
        return f"write {cut('*'.join(_PIECE.findall(name)))}"
    if kind == "name" and name[:-1] in FUNCTIONS and name[-1] in "uve0123456789":
        return f"write {name[:-1]}({name[-1]})"
    return _nearest(lower[:40])


def _nearest(name: str) -> str:
    known = [word for word in (*FUNCTIONS, *_INSTEAD) if len(word) > 2]
    for near in difflib.get_close_matches(name, known, 1, LIKE):
        return _INSTEAD.get(near, f"did you mean {near}?")
    return _KNOWN


# -- the syntax tree -------------------------------------------------------------------------------


def parsed(source: Source) -> ast.expr:
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
        characters[token.position : token.position + len(text)] = text.replace("π", ASCII_PI)
    return f"({''.join(characters)})"


ASCII_PI = "P"  # cannot be typed: it is not among the known names


def _check_tree(body: ast.expr, source: Source) -> None:
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


def _operands(node: ast.expr, source: Source) -> list[ast.expr]:
    """Return the operands of an allowed node. This is the white list."""
    match node:
        case ast.Constant() | ast.Name():
            return []
        case ast.UnaryOp(op=ast.UAdd() | ast.USub(), operand=operand):
            return [operand]
        case ast.BinOp(op=op, left=left, right=right) if type(op) in OPERATORS:
            return [left, right]
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS:
            return args
    raise source.error(node.col_offset, "this is not part of a formula", _KNOWN)


# A constant exponent stays a plain number: arrays, Series and Dual all take whole ones as products.
OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
