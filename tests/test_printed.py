"""What is printed and what is right, from three sides: SymPy, 30 digits, and the typeset formulas.

The algebra proves the corrected formulas from the definitions and shows that the printed ones
differ. The numbers come from `mpmath` and the definitions alone. The typeset formulas are read and
evaluated, so that what a reader sees is what is computed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from ruledlab.geometry import Bezier, BSpline, GeometryError, RuledSurface, gallery
from ruledlab.printed import CONFIRMED, PRINTED, REMARKS, TRIED, Finding, finding

KEYS = [entry.key for entry in PRINTED]
PI = np.pi


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
            sp.lambdify((u, v), sp.parse_expr(text), "mpmath") for text in (case.ubar, case.vbar)
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


def test_the_reader_reads() -> None:
    env = {"u'": mp.mpf(3), "v": mp.mpf(2), r"\Delta^2_v": mp.mpf(5), r"\bar\kappa": mp.mpf(7)}
    assert read(r"x=-2u'^2\frac{\Delta^2_v}{4}-1", env) == [-23.5]
    assert read(r"x=2\sin^2 v+2\cos^2 v\,(1)=(\bar\kappa)^{3/2}", env) == pytest.approx([2, 7**1.5])
    with pytest.raises(AssertionError):
        read(r"x=\tan v", env)


POINTWISE = ["base_curve", "h11", "mean_curvature", "tau", "tau_bar", "cot_sigma"]
AT_START = ["tau_0", "tau_bar_0", "delta_0", "cot_sigma_0"]


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("key", POINTWISE)
def test_the_functions_follow_the_typeset_formulas(key: str, name: str) -> None:
    """Printed and corrected, at 30 digits from the definitions, against the package."""
    entry, case = finding(key), CASES[name]
    for t in case.places:
        for w in W if entry.over == "t, w" else (0.0,):
            place = (t, w) if entry.over == "t, w" else (t,)
            for latex, function in (
                (entry.printed_latex, entry.printed),
                (entry.corrected_latex, entry.corrected),
            ):
                expected = read(latex, exact(name, t, w))
                found = function(case.surface, *place)
                assert expected == pytest.approx([float(found)] * len(expected), rel=1e-9, abs=1e-9)


def test_mu_as_typeset_is_the_place_of_the_striction_point() -> None:
    mu = finding("tau_bar").corrected_latex.split(r"\qquad")[1]
    for name, case in CASES.items():
        env = exact(name, case.places[1])
        assert read(mu, env) == pytest.approx([float(env[r"\mu"])], rel=1e-20)


@pytest.mark.parametrize("key", AT_START)
@pytest.mark.parametrize("name", ["example_2", "random", "loop"])
def test_the_formulas_at_the_first_control_point(key: str, name: str) -> None:
    entry, env = finding(key), exact(name, 0.0)
    surface = (LOOP if name == "loop" else CASES[name]).surface
    right = float(entry.corrected(surface))
    assert read(entry.corrected_latex, env) == pytest.approx([right], rel=1e-9)
    if key == "cot_sigma_0" and name == "example_2":
        assert np.isnan(entry.printed(surface))  # Δ_u = 0 stands in the denominator
    else:
        printed = float(entry.printed(surface))
        assert read(entry.printed_latex, env) == pytest.approx([printed], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("t", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("quantity", ["kappa_bar", "tau_bar", "cot_sigma"])
def test_example_1(quantity: str, t: float) -> None:
    entry = finding(f"example_1_{quantity}")
    env, surface = exact("example_1", t), gallery.surface("example_1")
    right = float(entry.corrected(surface, t))
    assert read(entry.corrected_latex, env) == pytest.approx(
        [right] * (quantity == "tau_bar") + [right]
    )
    printed = float(entry.printed(surface, t))
    assert read(entry.printed_latex, env) == pytest.approx([printed], rel=1e-14)
    assert abs(printed - right) > 0.01
    other = gallery.surface("orchid")
    assert entry.corrected(other, t) == right


def test_example_1_by_numbers_known_beforehand() -> None:
    surface = gallery.surface("example_1")
    entry = finding("example_1_tau_bar")
    assert entry.corrected(surface, 0.5) == pytest.approx(-0.8240378591516644, rel=1e-12)
    assert entry.printed(surface, 0.5) == pytest.approx(0.2397127693021015, rel=1e-12)
    gap = finding("example_1_kappa_bar").difference(surface, [0.25, 0.5])
    assert gap == pytest.approx(1.0 / surface.invariants([0.25, 0.5]).kappa, rel=1e-12)
    # κ, τ and δ of the example stand as printed.
    t = np.array([0.2, 0.9])
    inv, sine, cosine = surface.invariants(t), np.sin(t), np.cos(t)
    square = 1.0 + sine**2
    np.testing.assert_allclose(inv.kappa, np.sqrt(square), rtol=1e-13)
    np.testing.assert_allclose(inv.tau, cosine * (sine**2 + 2) / square, rtol=1e-13)
    delta = (sine * (2 * t * cosine + sine) + cosine**2 + 1) / square
    np.testing.assert_allclose(inv.delta, delta, rtol=1e-13)


# -- the algebra, from the definitions -------------------------------------------------------------

u, v, u1, v1, u2, v2 = sp.symbols("u v u1 v1 u2 v2")
U, U1, U2, V, V1, V2, Uu, Uv, Vu, Vv = sp.symbols("U U1 U2 V V1 V2 Uu Uv Vu Vv")
RATES = {u: u1, u1: u2, v: v1, v1: v2, U: U1, U1: U2, V: V1, V1: V2}
S, C = sp.symbols("S C")


def rate(expression: Any) -> Any:
    """The derivative by t."""
    return sum((sp.diff(expression, a) * b for a, b in RATES.items()), start=sp.zeros(3, 1)[0])


def vector_rate(vector: Any) -> Any:
    return vector.applyfunc(rate)


def reduced(expression: Any) -> Any:
    """At u = 0, which a turn about the axis brings about; a polynomial with C² = 1 − S²."""
    chain = {U1: Uu * u1 + Uv * v1, V1: Vu * u1 + Vv * v1}
    plain = expression.subs(u, 0).subs({sp.sin(v): S, sp.cos(v): C})
    return sp.rem(sp.expand(plain), C**2 + S**2 - 1, C).subs(chain).expand()


@dataclass(frozen=True)
class Algebra:
    x: tuple[Any, Any, Any]
    y: tuple[Any, Any, Any]

    def triple(self, i: Any, j: Any, k: Any) -> Any:
        return sp.Matrix.hstack(i, j, k).det()


@pytest.fixture(scope="module")
def algebra() -> Algebra:
    x = sp.Matrix([sp.cos(u) * sp.sin(v), sp.sin(u) * sp.sin(v), sp.cos(v)])
    y = U * x.diff(u) + V * x.diff(v)
    x1, y1 = vector_rate(x), vector_rate(y)
    rows = [(m, n, vector_rate(n)) for m, n in ((x, x1), (y, y1))]
    return Algebra(*(tuple(m.subs(u, 0) for m in row) for row in rows))


SINE, COSINE = sp.sin(v), sp.cos(v)
SQUARE = u1**2 * SINE**2 + v1**2
STRETCH = u1**2 * SINE * (V * COSINE + Uu * SINE) + u1 * v1 * (Vu + Uv * SINE**2) + v1**2 * Vv
ADVANCE = SINE * (U * v1 - V * u1)
COMMON = COSINE * (u1**3 * SINE**2 + 2 * u1 * v1**2)


def same(left: Any, right: Any) -> bool:
    return bool(reduced(left - right) == 0)


def test_kappa_and_kappa_bar_of_18_are_right(algebra: Algebra) -> None:
    assert same(algebra.x[1].dot(algebra.x[1]), SQUARE)
    assert same(algebra.x[1].dot(algebra.y[1]), STRETCH)


def test_tau_of_18(algebra: Algebra) -> None:
    determinant = algebra.triple(*algebra.x)
    assert same(determinant, COMMON + SINE * (u2 * v1 - u1 * v2))
    printed = COMMON + SINE * (u1 * v2 + u2 * v1)
    assert same(printed - determinant, 2 * SINE * u1 * v2)
    assert not same(printed, determinant)


def test_tau_bar_of_18(algebra: Algebra) -> None:
    """κ⁴τ̄ from (6) against κ⁴(⟨c′, x⟩ + μ′), with κ²μ a polynomial."""
    (x, x1, x2), (y, y1, y2) = algebra.x, algebra.y
    triple = algebra.triple
    twist = triple(y, x1, x2) + triple(x, y1, x2) + triple(x, x1, y2)
    tau_bar = SQUARE * twist - 2 * triple(x, x1, x2) * x1.dot(y1)
    above = SINE * (v1 * U1 - u1 * V1) + u1 * v1 * V * COSINE
    mu_rate = SQUARE**2 * rate(U * COSINE) + SQUARE * rate(above) - above * rate(SQUARE)
    assert same(tau_bar, SQUARE**2 * ADVANCE + mu_rate)
    assert not same(tau_bar, SQUARE**2 * ADVANCE)
    # the two parts are what they are said to be: ⟨c′, x⟩, and the place of m on the ruling
    foot_rate = x1.cross(y) + x.cross(y1)
    assert same(foot_rate.dot(x), ADVANCE)
    assert same(-x1.dot(foot_rate), SQUARE * U * COSINE + above)


def test_the_foot_point_of_20(algebra: Algebra) -> None:
    foot = sp.Matrix([-U * SINE * COSINE, V, U * SINE**2])  # at u = 0
    assert all(same(a, b) for a, b in zip(algebra.x[0].cross(algebra.y[0]), foot, strict=True))


FRAME = sp.symbols("k kb t tb w dk dkb dtb p q r")


def test_5_and_the_matrix_after_17() -> None:
    """With x̄ᵢ = m × xᵢ and m = (p, q, r) in the frame: differentiate, and compare."""
    k, kb, t, tb, *_, p, q, r = FRAME
    turn = sp.Matrix([[0, k, 0], [-k, 0, t], [0, -t, 0]])
    e, m = sp.eye(3), sp.Matrix([p, q, r])
    m_rate = sp.Matrix([tb, 0, kb])
    moments = [m.cross(e.col(i)) for i in range(3)]
    rates = [m_rate.cross(e.col(i)) + m.cross(turn.row(i).T) for i in range(3)]
    right = -kb * e.col(0) + tb * e.col(2) - k * moments[0] + t * moments[2]
    assert rates[1].expand() == right.expand()
    printed = -kb * e.col(0) + tb * e.col(2) - k * moments[0] + t * moments[1]
    assert (
        (printed - rates[1]).expand() == (t * (moments[1] - moments[2])).expand() != sp.zeros(3, 1)
    )
    matrix = sp.Matrix(
        [
            [-k * r, kb, k * p],
            [t * q - kb, -k * r - t * p, tb + k * q],
            [t * r, -tb, -t * p],
        ]
    )
    assert sp.Matrix.vstack(*(row.T for row in rates)).expand() == matrix.expand()


def test_h11_and_the_mean_curvature() -> None:
    k, kb, t, tb, w, dk, dkb, dtb, *_ = FRAME
    turn = sp.Matrix([[0, k, 0], [-k, 0, t], [0, -t, 0]])
    r_t, r_w = sp.Matrix([tb, w * k, kb]), sp.Matrix([1, 0, 0])
    r_tt = sp.Matrix([dtb, w * dk, dkb]) + turn.T * r_t
    normal, area = sp.Matrix([0, kb, -w * k]), kb**2 + w**2 * k**2
    assert r_t.cross(r_w) == normal
    rest = w * k * (w * k * t + dkb)
    h11 = r_tt.dot(normal)
    assert sp.expand(h11 - (kb * (k * tb + w * dk - kb * t) - rest)) == 0
    gap = sp.expand(kb * (tb + w * dk - t) - rest - h11)
    assert gap == sp.expand(kb * (tb * (1 - k) - t * (1 - kb)))
    above = h11 - 2 * k * kb * r_t[0]  # g₂₂ = 1, h₂₂ = 0, det g = W²
    assert sp.expand(above - (kb * (w * dk - k * tb - kb * t) - rest)) == 0
    assert sp.expand(r_t.dot(r_t) - tb**2 - area) == 0


def test_the_turning_of_a_developable_direction() -> None:
    """(11): ξ′ has no part across x₁ exactly for φ′ = −τ, and the lines along ξ then sweep one."""
    phi, phi1, w, w1 = sp.symbols("phi phi1 w w1")
    k, kb, t, tb, *_ = FRAME
    turn = sp.Matrix([[0, k, 0], [-k, 0, t], [0, -t, 0]])
    xi = sp.Matrix([0, sp.cos(phi), sp.sin(phi)])
    xi_rate = phi1 * xi.diff(phi) + turn.T * xi
    assert sp.simplify(xi_rate.subs(phi1, -t) + sp.Matrix([k * sp.cos(phi), 0, 0])) == sp.zeros(
        3, 1
    )
    # through the point m + w x of the ruling where ξ touches the surface
    point_rate = sp.Matrix([tb + w1, w * k, kb])
    flat = (
        sp.Matrix.hstack(point_rate, xi, xi_rate)
        .det()
        .subs(w, kb * sp.cos(phi) / (k * sp.sin(phi)))
    )
    assert sp.simplify(flat - (tb + w1) * (phi1 + t)) == 0


# -- integrals and what is not a function of t -----------------------------------------------------

CLOSED = {"example_2": CASES["example_2"], "loop": LOOP}


def around(integrand: Callable[[np.ndarray], np.ndarray]) -> float:
    """An integral over [0, 1] by another rule than the package's."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    return float(0.5 * weights @ integrand(0.5 * (nodes + 1.0)))


def chart(case: Case, t: np.ndarray) -> dict[str, np.ndarray]:
    curve = Bezier(np.array(case.points))
    rows = [
        np.moveaxis(row, -1, 0) for row in (curve(t), curve.derivative(t), curve.derivative(t, 2))
    ]
    return {name + "'" * k: rows[k][i] for k in range(3) for i, name in enumerate("uv")}


@pytest.mark.parametrize("name", CLOSED)
def test_the_printed_tau_bar_has_the_right_integral(name: str) -> None:
    entry, surface = finding("tau_bar"), CLOSED[name].surface
    printed, right = (
        around(lambda t, f=f: f(surface, t)) for f in (entry.printed, entry.corrected)
    )
    assert printed == pytest.approx(right, abs=1e-9)
    assert np.abs(entry.difference(surface, np.linspace(0, 1, 50))).max() > 1.0


@pytest.mark.parametrize("name", CLOSED)
def test_pitch(name: str) -> None:
    """(24): the gap of the orthogonal trajectory is −∮⟨c′, x⟩, and c = x × x̄ is sampled."""
    entry, surface = finding("pitch_24"), CLOSED[name].surface
    t = np.linspace(0.0, 1.0, 20001)
    foot, x = surface.foot(t), surface.line(t).direction
    gap = -np.einsum("ij,ij->", np.diff(foot, axis=0), 0.5 * (x[1:] + x[:-1]))
    assert float(entry.corrected(surface)) == pytest.approx(gap, abs=1e-6)
    assert float(entry.printed(surface)) == pytest.approx(-gap, abs=1e-6)


@pytest.mark.parametrize("name", CLOSED)
def test_angle_of_pitch(name: str) -> None:
    """Carry a vector across x₁ round the loop, changing along x₁ only, and watch φ."""
    surface = CLOSED[name].surface
    frames = surface.frame(np.linspace(0.0, 1.0, 8001))
    xi, phi = frames[0, 1], [0.0]
    for x1, x2, x3 in frames[1:]:
        xi = xi - (xi @ x1) * x1
        xi /= np.linalg.norm(xi)
        phi.append(float(np.arctan2(xi @ x3, xi @ x2)))
    gap = np.unwrap(phi)[-1]
    for key in ("angle_of_pitch_11", "angle_of_pitch_25"):
        assert float(finding(key).corrected(surface)) == pytest.approx(gap, abs=1e-4)
    assert float(finding("angle_of_pitch_11").printed(surface)) == pytest.approx(-gap, abs=1e-4)
    assert abs(float(finding("angle_of_pitch_25").printed(surface)) - gap) > 0.5


@pytest.mark.parametrize("name", CLOSED)
def test_25_with_the_printed_torsion(name: str) -> None:
    case, entry = CLOSED[name], finding("angle_of_pitch_25")

    def extra(t: np.ndarray) -> np.ndarray:
        f = chart(case, t)
        square = f["u'"] ** 2 * np.sin(f["v"]) ** 2 + f["v'"] ** 2
        return 2.0 * np.sin(f["v"]) * f["u'"] * f["v''"] / square

    assert float(entry.difference(case.surface)) == pytest.approx(-around(extra), abs=1e-9)

    def polar(t: np.ndarray) -> np.ndarray:
        f = chart(case, t)
        return np.cos(f["v"]) * f["u'"]

    turns = [
        (-float(f(case.surface)) - around(polar)) / (2 * PI)
        for f in (entry.corrected, entry.printed)
    ]
    assert turns[0] == pytest.approx(round(turns[0]), abs=1e-9)
    assert abs(turns[1] - round(turns[1])) > 0.01


def test_the_typeset_integrands_are_those_of_18() -> None:
    for key, whole in (("tau", "angle_of_pitch_25"), ("tau_bar", "pitch_24")):
        printed, right = finding(key), finding(whole)
        assert printed.printed_latex.split("=")[1] in right.printed_latex
    assert (
        finding("tau").corrected_latex.split("=")[1] in finding("angle_of_pitch_25").corrected_latex
    )


def test_lengths_of_x3() -> None:
    entry, surface = finding("x3_length"), gallery.surface("ramp")
    t = np.linspace(0.0, 1.0, 4001)
    x3 = surface.frame(t)[:, 2]
    length = np.linalg.norm(np.diff(x3, axis=0), axis=1).sum()
    assert entry.corrected(surface)[0] == pytest.approx(length, abs=1e-4)
    assert entry.printed(surface)[0] < 0.0 < entry.corrected(surface)[0]
    np.testing.assert_allclose(entry.difference(gallery.surface("example_2")), 0.0, atol=1e-10)


@pytest.mark.parametrize("name", CASES)
def test_5_on_designs(name: str) -> None:
    """x̄₂ = m × x₂, differentiated by central differences."""
    entry, surface = finding("x2bar_prime"), CASES[name].surface
    t, h = np.array([0.3, 0.6, 0.9]), 1e-5
    x2bar = [np.cross(surface.striction(s), surface.frame(s)[..., 1, :]) for s in (t - h, t + h)]
    right = entry.corrected(surface, t)
    np.testing.assert_allclose((x2bar[1] - x2bar[0]) / (2 * h), right, rtol=1e-6, atol=1e-5)
    assert np.abs(entry.difference(surface, t)).max() > 0.1


def test_the_domain() -> None:
    entry, t = finding("domain"), np.array([0.0, 0.25, 0.75])
    surface = gallery.surface("hyperboloid")  # u = 2π t
    assert entry.printed(surface, t).tolist() == [1.0, 1.0, 0.0]
    assert entry.corrected(surface, t).tolist() == [1.0, 1.0, 1.0]
    assert not entry.difference(gallery.surface("example_2"), np.linspace(0, 1, 20)).any()
    # ∬ sin v du dv over the two rectangles
    area = [
        sp.integrate(sp.sin(v), (v, 0, b), (u, 0, a))
        for a, b in ((sp.pi, 2 * sp.pi), (2 * sp.pi, sp.pi))
    ]
    assert area == [0, 4 * sp.pi]
    # beyond v = π the printed rectangle holds the missing half: (u, v) and (u + π, 2π − v) are one
    x = sp.Matrix([sp.cos(u) * sp.sin(v), sp.sin(u) * sp.sin(v), sp.cos(v)])
    other = x.subs({u: u + sp.pi, v: 2 * sp.pi - v}, simultaneous=True)
    assert sp.simplify(x - other) == sp.zeros(3, 1)


CORNER = np.array([(0.0, 1.0), (0.5, 1.2), (0.9, 2.0), (-0.6, 2.0), (-1.0, 0.6), (0.0, 1.0)])


@pytest.mark.parametrize(
    ("legs", "smooth", "jump"), [(1.0, True, 0.0), (2.0, True, 0.5), (-1.0, True, 2.0)]
)
def test_closing(legs: float, smooth: bool, jump: float) -> None:
    """pₙ₋₁ = p₀ − legs (p₁ − p₀): midpoint, G¹ only, and a cusp, all collinear."""
    points = CORNER.copy()
    points[-2] = points[0] - legs * (points[1] - points[0])
    surface, entry = RuledSurface(Bezier(points), "u - v", "u + v"), finding("closing")
    assert float(entry.printed(surface)) == pytest.approx(0.0, abs=1e-12)
    assert float(entry.corrected(surface)) == pytest.approx(jump, abs=1e-12)
    assert (surface.closure().order >= 1) == (jump == 0.0)
    if jump:
        kappa = surface.invariants([0.0, 1.0]).kappa
        assert kappa[1] / kappa[0] == pytest.approx(abs(legs))


def test_a_c1_seam_still_lets_the_torsion_jump() -> None:
    points = CORNER.copy()
    points[-2] = 2 * points[0] - points[1]
    inv = RuledSurface(Bezier(points), "u - v", "u + v").invariants([0.0, 1.0])
    assert inv.kappa[0] == pytest.approx(inv.kappa[1])
    assert abs(inv.tau[0] - inv.tau[1]) > 0.1
    assert abs(inv.sigma[0] - inv.sigma[1]) > 0.1


def test_example_2() -> None:
    entry = finding("example_2")
    anything = gallery.surface("cone")
    right = [-6.115937783177811, 0.580104765135371]
    np.testing.assert_allclose(entry.corrected(anything), right, rtol=1e-12)
    assert entry.printed(anything).tolist() == [1.419793061, 0.3381414433]
    typeset = [float(x) for x in re.findall(r"=(-?[\d.]+)", entry.corrected_latex)]
    np.testing.assert_allclose(typeset, right, rtol=1e-12)


def test_the_numbers_that_are_told_of_example_2() -> None:
    case, entry = CASES["example_2"], finding("example_2")
    f = chart(case, np.linspace(0.0, 1.0, 7))
    assert f["u"].min() > 0.0  # far from the poles: the enclosed area is |∮cos v du|

    def polar(t: np.ndarray) -> np.ndarray:
        g = chart(case, t)
        return np.cos(g["v"]) * g["u'"]

    area = abs(around(polar))
    assert f"{area:.8f}" in entry.how_to_see
    assert entry.corrected(case.surface)[0] == pytest.approx(area - 2 * PI, abs=1e-9)
    by_print = [finding(key).printed(case.surface) for key in ("angle_of_pitch_25", "pitch_24")]
    assert [f"{float(x):.4f}" for x in by_print] == ["1.1193", "-0.5801"]
    assert "λ = 1.1193 and l = −0.5801" in entry.agreement
    assert case.surface.arc_lengths().kappa == pytest.approx(1.4473, abs=5e-5)


def test_the_nearest_to_a_pattern() -> None:
    """Where the running integrals reach the printed numbers: near each other, not the same."""
    surface = CASES["example_2"].surface
    t = np.linspace(0.0, 0.2, 20001)
    rates = surface.invariants(t).tau, -finding("tau_bar").printed(surface, t)
    places = []
    for rate_, goal in zip(rates, finding("example_2").printed(surface), strict=True):
        steps = 0.5 * (rate_[1:] + rate_[:-1]) * np.diff(t)
        places.append(float(np.interp(goal, np.cumsum(steps), t[1:])))
    assert [f"{place:.4f}" for place in places] == ["0.1708", "0.1700"]
    assert all(f"t = {place:.4f}" in TRIED[-1].text for place in places)


# -- where the printed formulas agree, as claimed --------------------------------------------------


def agree(key: str, surface: RuledSurface, *places: Any) -> bool:
    return bool(np.allclose(finding(key).difference(surface, *places), 0.0, atol=1e-9))


T = np.linspace(0.05, 0.95, 9)


@pytest.mark.parametrize(
    ("key", "design", "places"),
    [
        ("x2bar_prime", "right_helicoid", (T,)),
        ("base_curve", "right_helicoid", (T, W)),
        ("base_curve", "hyperboloid", (T, W)),
        ("h11", "right_helicoid", (T, W)),
        ("mean_curvature", "right_helicoid", (T, W)),
        ("h11", "tangent_developable", (T, W[::2])),
        ("angle_of_pitch_11", "plucker_conoid", ()),
        ("pitch_24", "plucker_conoid", ()),
        ("closing", "example_2", ()),
        ("tau", "example_1", (T,)),
        ("tau", "hyperboloid", (T,)),
        ("tau_bar", "hyperboloid", (T,)),
        ("cot_sigma", "hyperboloid", (T,)),
        ("angle_of_pitch_25", "hyperboloid", ()),
        ("tau_0", "example_2", ()),
        ("tau_bar_0", "hyperboloid", ()),
        ("delta_0", "hyperboloid", ()),
        ("cot_sigma_0", "hyperboloid", ()),
    ],
)
def test_agreement(key: str, design: str, places: tuple[Any, ...]) -> None:
    assert agree(key, gallery.surface(design), *places)


@pytest.mark.parametrize("name", ["example_2", "random", "loop"])
def test_kappa_0_and_kappa_bar_0_stand_as_printed(name: str) -> None:
    env = exact(name, 0.0)
    latex = finding("delta_0").corrected_latex
    above, below = re.split(r"\}\{", latex.split("=")[1].removeprefix(r"\frac{")[:-1])
    kappa = rf"k=n\sqrt{{{below}}}"
    kappa_bar = rf"k=\frac{{n\,({above})}}{{\sqrt{{{below}}}}}"
    assert read(kappa, env) == pytest.approx([float(env[r"\kappa"])], rel=1e-20)
    assert read(kappa_bar, env) == pytest.approx([float(env[r"\bar\kappa"])], rel=1e-20)


@pytest.mark.parametrize("name", CASES)
def test_7_stands_as_printed(name: str) -> None:
    surface, t, h = CASES[name].surface, np.array([0.3, 0.6, 0.9]), 1e-5
    rate_ = (surface.striction(t + h) - surface.striction(t - h)) / (2 * h)
    inv, frame = surface.invariants(t), surface.frame(t)
    right = inv.tau_bar[:, None] * frame[:, 0] + inv.kappa_bar[:, None] * frame[:, 2]
    np.testing.assert_allclose(rate_, right, rtol=1e-6, atol=1e-5)


def test_delta_0_grows_with_the_degree() -> None:
    curve, entry = Bezier([[0.0, 0.7], [0.9, 0.7]]), finding("delta_0")
    for times in range(4):
        surface = RuledSurface(curve.raised(times), "sin(u) + v", "u*v")
        expected = (1 + times) * float(entry.corrected(surface))
        assert float(entry.printed(surface)) == pytest.approx(expected, rel=1e-12)


def test_the_printed_mean_curvature_knows_the_speed() -> None:
    """Half of the curve is run through at half the speed; the surface is the same."""
    curve = Bezier(np.array(CASES["random"].points))
    whole, half = (RuledSurface(c, "sin(u)*v", "u + v") for c in (curve, curve.split(0.5)[0]))
    entry = finding("mean_curvature")
    pairs = [(f(whole, 0.2, 0.3), f(half, 0.4, 0.3)) for f in (entry.printed, entry.corrected)]
    assert pairs[1][0] == pytest.approx(pairs[1][1], rel=1e-10)
    assert abs(pairs[0][0] - pairs[0][1]) > 0.01


def test_cot_sigma_0_of_example_2() -> None:
    entry, surface = finding("cot_sigma_0"), gallery.surface("example_2")
    assert float(entry.corrected(surface)) == pytest.approx(3 / np.sqrt(2), rel=1e-9)
    assert "2.1213" in entry.how_to_see


# -- the list itself -------------------------------------------------------------------------------


def arguments(entry: Finding) -> tuple[Any, ...]:
    return {"t": (T,), "t, w": (T, np.array(W)), "surface": ()}[entry.over]


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("design", ["example_2", "twisted_ring", "orchid"])
def test_every_finding_can_be_evaluated_on_a_closed_design(key: str, design: str) -> None:
    entry, surface = finding(key), gallery.surface(design)
    printed, right = (f(surface, *arguments(entry)) for f in (entry.printed, entry.corrected))
    shape = {"t": (9,), "t, w": (9, 3), "surface": ()}[entry.over]
    assert printed.shape == right.shape
    assert right.shape[: len(shape)] == shape
    assert np.isfinite(right).all()


@pytest.mark.parametrize("key", [key for key in KEYS if key != "closing"])
def test_the_chosen_design_shows_the_difference(key: str) -> None:
    entry = finding(key)
    gap = entry.difference(gallery.surface(entry.design), *arguments(entry))
    assert np.nanmax(np.abs(gap)) > 0.1


def test_places_may_have_any_shape() -> None:
    surface, t, w = gallery.surface("orchid"), np.array([[0.1, 0.2], [0.3, 0.4]]), np.array(W)
    for entry in PRINTED:
        if entry.over == "t":
            assert entry.difference(surface, t).shape[:2] == (2, 2)
            assert entry.difference(surface, 0.25).shape in ((), (3,))
        elif entry.over == "t, w":
            assert entry.difference(surface, t, w).shape == (2, 2, 3)
            assert entry.difference(surface, 0.25, 0.5).shape == ()


def test_undefined_values_are_nan() -> None:
    cone = gallery.surface("cone")  # κ̄ = τ̄ = 0
    for f in (finding("cot_sigma").printed, finding("cot_sigma").corrected):
        assert np.isnan(f(cone, T)).all()
    for key in ("h11", "mean_curvature"):  # no tangent plane in the apex
        for f in (finding(key).printed, finding(key).corrected):
            assert np.isnan(f(cone, T, 0.0)).all()
    meridian = RuledSurface(Bezier([[0.3, 1.0], [0.3, 1.0], [0.3, 1.5]]), 0, 1)  # κ(0) = 0
    assert np.isnan(finding("tau").printed(meridian, 0.0))


@pytest.mark.parametrize("key", ["pitch_24", "angle_of_pitch_11", "angle_of_pitch_25"])
def test_open_surfaces_are_refused(key: str) -> None:
    entry = finding(key)
    for f in (entry.printed, entry.corrected):
        with pytest.raises(GeometryError, match="not closed"):
            f(gallery.surface("example_1"))


def test_control_points_are_asked_for() -> None:
    spline = BSpline([[0, 1], [1, 1.2], [2, 0.9], [3, 1.5], [3.5, 1.0]], degree=2)
    surface = RuledSurface(spline, "u", "v")
    for key in AT_START:
        for f in (finding(key).printed, finding(key).corrected):
            with pytest.raises(GeometryError, match="Bézier"):
                f(surface)


def test_the_list_reads_well() -> None:
    assert len(set(KEYS)) == len(KEYS)
    for entry in PRINTED:
        texts = [entry.quantity, entry.how_to_see, entry.agreement]
        assert all(texts), entry.key
        assert entry.how_to_see.endswith("."), entry.key
        assert entry.agreement.endswith("."), entry.key
        for latex in (entry.printed_latex, entry.corrected_latex):
            assert latex.count("{") == latex.count("}"), entry.key
            assert "$" not in latex
            assert not re.search(r"\\q?quad[A-Za-z]", latex), entry.key
        assert entry.printed_latex != entry.corrected_latex
        assert entry.design in gallery.names()
    for note in REMARKS + CONFIRMED:
        assert note.place.startswith("§")
        assert note.text.strip()
    assert all(note.place and note.text.endswith(".") for note in TRIED)
    with pytest.raises(GeometryError, match="`key` must be one of x2bar_prime, "):
        finding("nonsense")
