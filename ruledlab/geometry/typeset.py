"""Formulas typeset: from a syntax tree to LaTeX, with no more brackets than are needed."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass

from .formula import ALIASES, ASCII_PI

__all__ = ["latex"]

_SUM, _SIGNED, _PRODUCT, _POWER, _ATOM = range(5)
_OPERATOR_NAMES = {"arctan2": r"\operatorname{arctan2}"}
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


def latex(tree: ast.expr, text: str) -> str:
    """Return a formula typeset, without dollar signs: its tree, and the text it was read from."""
    return _latex(tree, text).text


def _latex(node: ast.expr, text: str) -> _Typeset:
    match node:
        case ast.Constant():
            return _latex_number(text[node.col_offset : node.end_col_offset])
        case ast.Name(id=name):
            greek = {"pi": r"\pi", ASCII_PI: r"\pi", "e": r"\mathrm{e}"}
            return _Typeset(greek.get(name, name), _ATOM)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return _Typeset("-" + _latex(operand, text).within(_PRODUCT), _SIGNED)
        case ast.UnaryOp(operand=operand):
            return _latex(operand, text)
        case ast.Call(func=ast.Name(id=name), args=args):
            return _latex_call(ALIASES.get(name, name), [_latex(a, text).text for a in args])
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
