"""The typeset formulas, read and evaluated, and what they speak of, to 30 digits by `mpmath`.

The numbers come from the definitions alone, so that what a reader sees is what is tested.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp

from ruledlab.geometry import Bezier, RuledSurface, gallery

# -- designs: as surfaces, and as functions for mpmath ---------------------------------------------


@dataclass(frozen=True)
class Case:
    """A design twice: for the package, and as formulas that both mpmath and numpy understand."""

    points: tuple[tuple[float, float], ...]
    ubar: str
    vbar: str
    places: tuple[float, ...]

    @property
    def surface(self) -> RuledSurface:
        return RuledSurface(Bezier(np.array(self.points)), self.ubar, self.vbar)


def known(key: str, *places: float) -> Case:
    entry = gallery.example(key)
    return Case(entry.points, entry.ubar, entry.vbar, places)


CASES = {
    "example_1": known("example_1", 0.25, 0.5, 0.875),
    "example_2": known("example_2", 0.0, 0.375, 0.8125),
    "random": Case(
        ((0.31, 0.92), (0.83, 1.37), (1.46, 0.58), (2.05, 1.83), (2.77, 1.14)),
        "sin(u)*v",
        "exp(-v) + u**2/4",
        (0.0, 0.4375, 1.0),
    ),
}
LOOP = Case(
    ((0.9, 1.1), (1.2, 1.9), (0.4, 2.2), (-0.6, 1.7), (-0.3, 0.7), (0.6, 0.3), (0.9, 1.1)),
    "u*v/2 + cos(v)",
    "sin(u) - v/3",
    (0.0, 0.3, 0.7),
)
W = (-0.75, 0.0, 0.625)


class Exact:
    """All that the formulas speak of, at one t, from the definitions, to 30 digits."""

    def __init__(self, case: Case) -> None:
        self.points = [tuple(mp.mpf(x) for x in p) for p in case.points]
        self.n = len(self.points) - 1
        self.ubar, self.vbar = (
            sp.lambdify(sp.symbols("u v"), sp.parse_expr(text), "mpmath")
            for text in (case.ubar, case.vbar)
        )

    def angle(self, t: Any, i: int) -> Any:
        n = self.n
        return mp.fsum(
            mp.binomial(n, k) * (1 - t) ** (n - k) * t**k * p[i] for k, p in enumerate(self.points)
        )

    def line(self, t: Any) -> tuple[list[Any], list[Any]]:
        u, v = self.angle(t, 0), self.angle(t, 1)
        ubar, vbar = self.ubar(u, v), self.vbar(u, v)
        x = [mp.cos(u) * mp.sin(v), mp.sin(u) * mp.sin(v), mp.cos(v)]
        x_u = [-mp.sin(u) * mp.sin(v), mp.cos(u) * mp.sin(v), 0]
        x_v = [mp.cos(u) * mp.cos(v), mp.sin(u) * mp.cos(v), -mp.sin(v)]
        return x, [ubar * a + vbar * b for a, b in zip(x_u, x_v, strict=True)]

    def jet(self, t: Any, order: int) -> tuple[list[Any], list[Any]]:
        """Derivatives of x and of x̄ as matrices 3 × 1, from one Taylor series per entry."""
        series = [
            [mp.taylor(lambda s, p=p, i=i: self.line(s)[p][i], t, order) for i in range(3)]
            for p in (0, 1)
        ]
        rows = [
            [mp.matrix([mp.factorial(k) * entry[k] for entry in part]) for k in range(order + 1)]
            for part in series
        ]
        return rows[0], rows[1]

    def mu(self, t: Any) -> Any:
        """⟨m − c, x⟩ = −⟨x′, c′⟩/⟨x′, x′⟩."""
        (x, x1), (y, y1) = self.jet(t, 1)
        return -dot(x1, cross(x1, y) + cross(x, y1)) / dot(x1, x1)

    def values(self, t: float) -> dict[str, Any]:
        t = mp.mpf(t)
        (x, x1, x2), (y, y1, y2) = self.jet(t, 2)
        kappa = mp.sqrt(dot(x1, x1))
        kb, dk = dot(x1, y1) / kappa, dot(x1, x2) / kappa
        tau = dot(cross(x, x1), x2) / kappa**2
        twist = (dot(cross(y, x1), x2) + dot(cross(x, y1), x2) + dot(cross(x, x1), y2)) / kappa**2
        env = {
            "t": t,
            "n": mp.mpf(self.n),
            r"\kappa": kappa,
            r"\bar\kappa": kb,
            r"\tau": tau,
            r"\bar\tau": twist - 2 * tau * kb / kappa,
            r"\kappa'": dk,
            r"\bar\kappa'": (dot(x2, y1) + dot(x1, y2) - kb * dk) / kappa,
            r"\mu": self.mu(t),
            r"\mu'": mp.diff(self.mu, t),
            "advance": dot(cross(x, x1), y),
        }
        return env | self._angles(t) | self._fields(t) | self._legs()

    def _angles(self, t: Any) -> dict[str, Any]:
        rows = {
            name: mp.taylor(lambda s, i=i: self.angle(s, i), t, 2) for i, name in enumerate("uv")
        }
        return {
            name + "'" * k: row[k] * (2 if k == 2 else 1)
            for name, row in rows.items()
            for k in range(3)
        }

    def _fields(self, t: Any) -> dict[str, Any]:
        u, v = self.angle(t, 0), self.angle(t, 1)
        env = {}
        for name, f in (("u", self.ubar), ("v", self.vbar)):
            env[rf"\bar{name}"] = f(u, v)
            env[rf"\bar{name}_u"] = mp.diff(f, (u, v), (1, 0))
            env[rf"\bar{name}_v"] = mp.diff(f, (u, v), (0, 1))
            env[rf"\bar{name}'"] = mp.diff(lambda s, f=f: f(self.angle(s, 0), self.angle(s, 1)), t)
        return env

    def _legs(self) -> dict[str, Any]:
        p = self.points
        env = {"v_0": p[0][1]}
        for i, name in enumerate("uv"):
            env[rf"\Delta_{name}"] = p[1][i] - p[0][i]
            bend = p[2][i] - 2 * p[1][i] + p[0][i] if self.n > 1 else mp.mpf(0)
            env[rf"\Delta^2_{name}"] = bend
        return env


def dot(a: Any, b: Any) -> Any:
    return mp.fsum(p * q for p, q in zip(a, b, strict=True))


def cross(a: Any, b: Any) -> Any:
    return mp.matrix(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


@lru_cache
def values(name: str, t: float) -> dict[str, Any]:
    with mp.workdps(40):
        return Exact(LOOP if name == "loop" else CASES[name]).values(t)


def exact(name: str, t: float, w: float = 0.0) -> dict[str, Any]:
    return values(name, t) | {"w": mp.mpf(w)}


# -- the typeset formulas, read and evaluated ------------------------------------------------------

TOKEN = re.compile(
    r"(?P<skip>\s+|\\,|\\bigl|\\bigr|\{\}|\\left|\\right)"
    r"|(?P<name>\\langle\\mathbf c',\\mathbf x\\rangle|\\mu'\(0\)|\\mu'?"
    r"|\\Delta(?:\^2)?_[uv]|v_0|\\bar ?(?:\\kappa|\\tau|[uv])(?:_[uv])?'*|\\kappa'?|\\tau"
    r"|[uv]'*|[twn])"
    r"|(?P<number>\d+)|(?P<word>\\frac|\\sqrt|\\sin|\\cos)|(?P<sign>[-+*/^(){}])"
)


class Reader:
    """A reader of the typeset formulas: sums, products without a sign, fractions, roots, powers."""

    def __init__(self, text: str, env: dict[str, Any]) -> None:
        self.env, self.at = env, 0
        self.tokens = list(self._tokens(text))

    def _tokens(self, text: str) -> Iterator[tuple[str, str]]:
        place = 0
        while place < len(text):
            match = TOKEN.match(text, place)
            assert match is not None, f"cannot read {text[place:]!r} in {text!r}"
            place = match.end()
            if match.lastgroup != "skip":
                yield str(match.lastgroup), match.group()
        yield "end", ""

    def value(self) -> Any:
        result = self.sum()
        assert self.tokens[self.at][0] == "end"
        return result

    def peek(self) -> str:
        return self.tokens[self.at][1]

    def take(self, expected: str | None = None) -> tuple[str, str]:
        token = self.tokens[self.at]
        assert expected is None or token[1] == expected, (expected, token)
        self.at += 1
        return token

    def sum(self) -> Any:
        total = self.product() if self.peek() != "-" else mp.mpf(0)
        while self.peek() in ("+", "-"):
            sign = 1 if self.take()[1] == "+" else -1
            total += sign * self.product()
        return total

    def product(self) -> Any:
        result = self.power()
        while self.peek() not in ("+", "-", ")", "}", ""):
            divide = self.peek() == "/"
            if divide:
                self.take()
            factor = self.power()
            result = result / factor if divide else result * factor
        return result

    def power(self) -> Any:
        base = self.atom()
        return base ** self.exponent() if self.peek() == "^" else base

    def exponent(self) -> Any:
        self.take("^")
        return self.group() if self.peek() == "{" else mp.mpf(self.take()[1])

    def group(self, left: str = "{", right: str = "}") -> Any:
        self.take(left)
        value = self.sum()
        self.take(right)
        return value

    def atom(self) -> Any:
        if self.peek() == "(":
            return self.group("(", ")")
        kind, text = self.take()
        if kind == "number":
            return mp.mpf(text)
        if kind == "name":
            return self.named(text)
        if text == r"\frac":
            return self.group() / self.group()
        if text == r"\sqrt":
            return mp.sqrt(self.group())
        return self.circular(getattr(mp, text[1:]))

    def named(self, text: str) -> Any:
        if text.startswith(r"\langle"):
            return self.env["advance"]
        return self.env[text.replace(" ", "").replace("(0)", "")]

    def circular(self, function: Callable[[Any], Any]) -> Any:
        exponent = self.exponent() if self.peek() == "^" else 1
        factor = mp.mpf(self.take()[1]) if self.tokens[self.at][0] == "number" else 1
        return function(factor * self.named(self.take()[1])) ** exponent


def sides(latex: str) -> list[str]:
    """The right-hand sides of the equation that matters."""
    body = latex[latex.index("g_{11}=") :] if "g_{11}" in latex else latex
    return re.split(r",?\\q?quad", body)[0].split("=")[1:]


def read(latex: str, env: dict[str, Any]) -> list[float]:
    with mp.workdps(40):
        return [float(Reader(side, env).value()) for side in sides(latex) if "operator" not in side]
