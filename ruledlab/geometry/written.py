"""Mathematics as people write it, turned into the notation of typed formulas.

``6t(1 − t) + 8t²`` becomes ``6*t*(1-t)+8*t**2``: products without a sign, powers with ``^`` or a
raised digit, roots with √, the signs of a phone's keyboard. What could be read in two ways, such as
``1/2t``, is refused. Every character keeps its place in what was typed, so that an error points
there.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

from .checks import GeometryError
from .formula import CONSTANTS, FormulaError, Source

__all__ = ["Written", "in_formula_notation", "tidied", "without_label"]

_SIGNS = {
    **dict.fromkeys("−–—‐‑‒﹣", "-"),
    **dict.fromkeys("·⋅×∙•✕✖", "*"),
    **dict.fromkeys("÷⁄∕∶", "/"),
    **dict.fromkeys("𝜋𝛑ϖℼ", "π"),
    **dict.fromkeys("ϵℇ", "ε"),
    **dict.fromkeys("\u200b\u200c\u200d\u2060\ufeff", " "),
}
_RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-", strict=True))

_TOKEN = re.compile(
    r"""(?P<space>\s+)
    |(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
    |(?P<module>(?:np|numpy|math)\.(?=[A-Za-z]))
    |(?P<name>[A-Za-z_][A-Za-z_0-9]*|π|ε)
    |(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+)
    |(?P<power>\*\*|\^)
    |(?P<part>[½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞])
    |(?P<open>\()|(?P<close>\))|(?P<root>√)
    |(?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)
_LABEL = re.compile(
    r"""\s*(?:\[[^]=≈]{1,20}\]  # a list of names
    |[^\W\d][^=≈*/^]{0,12}ε[^=≈*/^]{0,12}  # the name of a dual number
    |(?:[^\W\d]|‖)[^=≈+*/^<>!:,\[\]()]{0,20}(?:\([^()=≈]{1,8}\))?)  # a name, perhaps of a variable
    \s*[=≈](?!=)\s*""",
    re.VERBOSE,
)
_TEX = re.compile(r"\\[A-Za-z]")
_AROUND = ("$$", "$", "`", '"', "'")


@dataclass(frozen=True, slots=True)
class Written:
    """A formula in the notation of typed formulas, and what was typed.

    Attributes
    ----------
    text
        the formula.
    typed
        what was typed.
    places
        for each character of ``text`` its place in ``typed``.
    """

    text: str
    typed: str
    places: tuple[int, ...]

    def located(self, error: FormulaError, message: str = "") -> FormulaError:
        """Return an error about ``text`` as one about ``typed``, with another message if given."""
        found = error.position
        place = self.places[found] if found < len(self.places) else len(self.typed.rstrip())
        said = re.sub(r"at column \d+", f"at column {place + 1}", message or error.message)
        return FormulaError(error.name, self.typed, place, said)


def without_label(text: str) -> tuple[int, int]:
    """Return from where to where the answer stands, without ``u(t) =``, quotation marks or ``$``.

    Raises
    ------
    GeometryError
        for TeX.
    """
    begin, end = len(text) - len(text.lstrip()), len(text.rstrip().rstrip(";").rstrip())
    for sign in _AROUND:
        if end - begin > 2 * len(sign) and text[begin:end].startswith(sign):
            if text[begin:end].endswith(sign):
                begin, end = begin + len(sign), end - len(sign)
            break
    if _TEX.search(text):
        raise GeometryError(r"this is TeX; write it as 3*pi/8, sqrt(2) or sin(t), without \ signs")
    label = _LABEL.match(text, begin, end)
    if label and text.count("=") + text.count("≈") == 1:
        return label.end(), end
    if text[begin:end].startswith(("=", "≈")) and text.count("=") <= 1:
        return begin + 1, end
    return begin, end


def in_formula_notation(
    text: str, variables: tuple[str, ...] = (), span: tuple[int, int] | None = None
) -> Written:
    """Return what was typed in the notation of typed formulas; its variables are called u and v.

    Parameters
    ----------
    text
        what was typed.
    variables
        the letters that stand for variables; none for a number.
    span
        the part of the text that is the formula; None for all of it.

    Raises
    ------
    FormulaError
        if it can be read in two ways, or has a letter that is a variable elsewhere.
    """
    return _Writer(text, variables, (0, len(text)) if span is None else span).written()


def tidied(text: str, variables: tuple[str, ...] = ()) -> str:
    """Return a formula in the notation of typed formulas, with its own letters.

    Parameters
    ----------
    text, variables
        as for `in_formula_notation`, at most two variables.

    Raises
    ------
    FormulaError
        as there.
    """
    own = dict(zip("uv", variables, strict=False))
    plain = in_formula_notation(text, variables).text
    return re.sub(r"\b[uv]\b", lambda found: own.get(found[0], found[0]), plain)


# -- tokens ----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    place: int
    spaced: bool
    """Whether a space stands before it."""


def _plain(sign: str) -> str:
    """Return the plain sign for one in another shape: exactly one character for one."""
    if sign in _SIGNS:
        return _SIGNS[sign]
    if sign.isdecimal():
        return str(unicodedata.decimal(sign))
    if unicodedata.decomposition(sign).startswith(("<font>", "<wide>", "<narrow>")):
        plain = unicodedata.normalize("NFKC", sign)
        return _SIGNS.get(plain, plain) if len(plain) == 1 else sign
    return sign


def _tokens(text: str, variables: tuple[str, ...], span: tuple[int, int]) -> Iterator[_Token]:
    plain = "".join(map(_plain, text))
    spaced = False
    for match in _TOKEN.finditer(plain, *span):
        kind, found, place = str(match.lastgroup), match.group(), match.start()
        if kind == "space":
            spaced = True
            continue
        if kind == "name" and _is_product(found, variables):
            for i, letter in enumerate(found):
                yield _Token(kind, letter, place + i, spaced and i == 0)
        elif kind == "name" and found in ("eps", "epsilon") and "ε" in variables:
            yield _Token(kind, "ε", place, spaced)
        elif kind != "module":
            yield _Token(kind, found, place, spaced)
        spaced = False


def _is_product(name: str, variables: tuple[str, ...]) -> bool:
    """Whether a name such as ``uv`` is variables side by side."""
    return 1 < len(name) <= 3 and set(name) <= set(variables)


# -- writing ---------------------------------------------------------------------------------------


class _Writer:
    """Goes through the tokens from left to right and writes them in the other notation."""

    def __init__(self, text: str, variables: tuple[str, ...], span: tuple[int, int]) -> None:
        self.text, self.variables = text, variables
        end = _Token("end", "", span[1], False)
        self.tokens = [*_tokens(text, variables, span), end, end, end]  # to look two ahead
        self.at = 0
        self.pieces: list[tuple[str, int]] = []
        self.ends = ""  # the kind of operand that has just ended; empty where one is awaited
        self.pending = ""  # a power that belongs behind the bracket which opens next
        self.powers: list[str] = []  # for each open bracket, what follows its end
        self.below: list[str] = [""]  # for each open bracket, "/" or "^" if it stands before here
        self.braces = any(
            a.kind == "power" and b.text == "{"
            for a, b in zip(self.tokens, self.tokens[1:], strict=False)
        )

    def written(self) -> Written:
        while self.tokens[self.at].kind != "end":
            token = self.tokens[self.at]
            self.at += 1
            getattr(self, f"_{token.kind}")(token)
        text = "".join(piece for piece, _ in self.pieces)
        return Written(text, self.text, tuple(_places(self.pieces)))

    def _put(self, piece: str, token: _Token) -> None:
        self.pieces.append((piece, token.place))

    def _fail(self, token: _Token, what: str, remedy: str) -> NoReturn:
        raise Source("answer", self.text).error(token.place, what, remedy)

    # -- operands ------------------------------------------------------------------------------

    def _operand(self, token: _Token) -> None:
        """Write a product sign where an operand follows another without one."""
        if self.ends and not self._stays(token):
            self._require_one_reading(token)
            self._put("*", token)
            self.below[-1] = "" if token.spaced else self.below[-1]
        elif self.ends and token.spaced:
            self._put(" ", token)

    def _stays(self, token: _Token) -> bool:
        """Whether two operands side by side are left to be refused: 1 2, π π, sin t, 1_000, 2j."""
        if token.kind == "number" or self.ends == "unknown":
            return True
        if token.text.startswith("_") or token.text in ("j", "J"):
            return True
        return self.ends == "constant" and token.text in CONSTANTS

    def _require_one_reading(self, token: _Token) -> None:
        """Refuse 1/2t and e^2t; 1/2 t and t^2(1 - t) can be read in one way only."""
        below = self.below[-1]
        if token.spaced or not below:
            return
        letter = token.text if token.kind == "name" else "t"
        if below == "/":
            ways = f"1/(2*{letter}) or (1/2)*{letter}"
            self._fail(token, "a fraction that can be read in two ways", f"write {ways}")
        if token.kind == "name" and self.ends == "number":
            base, power = self._raised_just_now()
            ways = f"{base}**({power}*{letter}) or {base}**{power}*{letter}"
            self._fail(token, "a power that can be read in two ways", f"write {ways}")

    def _raised_just_now(self) -> tuple[str, str]:
        """Return base and exponent of the power that ends here, as they were typed."""
        typed = [token.text for token in self.tokens[: self.at - 1]]
        base = typed[-3] if len(typed) > 2 and typed[-3].isalnum() else "(…)"
        return base, typed[-1]

    def _number(self, token: _Token) -> None:
        self._operand(token)
        self._put(token.text, token)
        self.ends = "number"

    def _part(self, token: _Token) -> None:
        above, _, below = unicodedata.normalize("NFKC", token.text).partition("⁄")
        self._operand(token)
        self._put(f"({above}/{below})", token)
        self.ends = "number"

    def _name(self, token: _Token) -> None:
        name = token.text
        if name in self.variables:
            self._variable(token)
        elif name in CONSTANTS:
            self._operand(token)
            self._put(name, token)
            self.ends = "constant"
        elif name[0] in self.variables and name[1:].isdigit():
            what = f"'{name}' could be a product or a power"
            self._fail(token, what, f"write {name[1:]}*{name[0]} or {name[0]}**{name[1:]}")
        elif self.variables and name in ("u", "v", "t"):
            meant = " and ".join(self.variables)
            self._fail(token, f"'{name}' is not meant here", f"write a formula in {meant}")
        else:
            self._function(token)

    def _variable(self, token: _Token) -> None:
        self._operand(token)
        self._put("uv"[self.variables.index(token.text)], token)
        self.ends = "variable"

    def _function(self, token: _Token) -> None:
        """Write a function's name, and remember the power in sin²(t) for after the bracket."""
        self._operand(token)
        self._put("log" if token.text == "ln" else token.text, token)
        ahead = 2 if self.tokens[self.at].kind == "power" else 1
        exponent, after = self.tokens[self.at + ahead - 1 : self.at + ahead + 1]
        digits = "".join(_RAISED.get(sign, sign) for sign in exponent.text)
        called = self.tokens[self.at].kind == "open"
        if digits.startswith("-") and (ahead == 2 or exponent.kind == "raised"):
            name = token.text
            what = f"'{name}' to a negative power can be read in two ways"
            self._fail(token, what, f"write arc{name}(…) or 1/{name}(…)")
        if digits.isdigit() and exponent.kind != "part" and after.kind == "open":
            self.at += ahead
            self.pending, called = f"**{digits}", True
        self.ends = "" if called else "unknown"

    def _root(self, token: _Token) -> None:
        following = self.tokens[self.at]
        self._operand(token)
        self.ends = ""
        if following.kind == "open":
            self._put("sqrt", token)
        elif following.kind in ("number", "name"):
            self.at += 1
            self._put("sqrt(", token)
            getattr(self, f"_{following.kind}")(following)
            self._put(")", following)
            self.ends = "close"
        else:
            self._put("√", token)

    # -- brackets and signs --------------------------------------------------------------------

    def _open(self, token: _Token) -> None:
        self._operand(token)
        self._put("(", token)
        self.powers.append(self.pending)
        self.below.append("")
        self.pending = self.ends = ""

    def _close(self, token: _Token) -> None:
        self._put(")", token)
        if self.powers:  # else there is one too many, and the formula's reader says so
            self.below.pop()
            self._put(self.powers.pop(), token)
        self.ends = "close"

    def _raised(self, token: _Token) -> None:
        digits = "".join(_RAISED[sign] for sign in token.text)
        self._put(f"**{digits}" if digits.isdigit() else f"**({digits})", token)
        self.ends = "close"

    def _power(self, token: _Token) -> None:
        self._put("**", token)
        self.ends, self.below[-1] = "", "^"

    def _other(self, token: _Token) -> None:
        if self.braces and token.text in "{}":
            (self._open if token.text == "{" else self._close)(token)
            return
        self._put(token.text, token)
        self.ends, self.below[-1] = "", "/" if token.text == "/" else ""


def _places(pieces: list[tuple[str, int]]) -> Iterator[int]:
    """Yield each character's place; those of a number or a name count on."""
    for piece, place in pieces:
        counts = piece[0].isalnum() if piece else False
        yield from (place + (i if counts and piece != "sqrt(" else 0) for i in range(len(piece)))
