"""The paper's formulas derived once more, by algebra: what has to be mended, and what stands.

Everything is derived from the definitions (3) to (8). A field ū(u, v) enters as a symbol with its
derivatives, so what is shown holds for every curve and every ū, v̄. Each test of something that
stands as printed says in its name which formula it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest
import sympy as sp

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


def moments_and_rates() -> tuple[list[Any], list[Any]]:
    """x̄ᵢ = m × xᵢ with m = (p, q, r) in the frame, and their derivatives by t."""
    k, kb, t, tb, *_, p, q, r = FRAME
    turn = sp.Matrix([[0, k, 0], [-k, 0, t], [0, -t, 0]])
    e, m = sp.eye(3), sp.Matrix([p, q, r])
    m_rate = sp.Matrix([tb, 0, kb])
    moments = [m.cross(e.col(i)) for i in range(3)]
    rates = [m_rate.cross(e.col(i)) + m.cross(turn.row(i).T) for i in range(3)]
    return moments, rates


def test_5_and_the_matrix_after_17() -> None:
    """Differentiate x̄₂, and compare."""
    k, kb, t, tb, *_, p, q, r = FRAME
    e = sp.eye(3)
    moments, rates = moments_and_rates()
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
    # the other coefficients and K_G stand as printed: r_tw = κx₂, r_ww = 0
    r_tw = turn.T * r_w
    g11, g12, g22 = r_t.dot(r_t), r_t.dot(r_w), r_w.dot(r_w)
    h12 = r_tw.dot(normal)
    assert (r_tw, h12, g12, g22) == (sp.Matrix([0, k, 0]), k * kb, tb, 1)
    assert sp.expand(g11 - (tb**2 + (w * k) ** 2 + kb**2)) == 0
    assert sp.expand(g11 * g22 - g12**2 - area) == 0
    assert sp.simplify(-(h12**2) / area / (g11 * g22 - g12**2) + (k * kb / area) ** 2) == 0
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


# -- Example 1, as a special case of what was derived ----------------------------------------------

t = sp.symbols("t")
EXAMPLE_1 = {v: t, u1: 1, v1: 1, u2: 0, v2: 0, U: 0, V: 2 * t, Uu: 1, Uv: -1, Vu: 1, Vv: 1}
SIN, COS = sp.sin(t), sp.cos(t)


def in_example_1(expression: Any) -> Any:
    return expression.subs(EXAMPLE_1, simultaneous=True)


def test_the_fields_of_example_1() -> None:
    """ū = u − v and v̄ = u + v give ū = 0 and v̄ = 2t, and so the sums that matter."""
    for ubar, vbar in ((u - v, u + v), (sp.sin(u - v) * u, u**2 / v + v)):
        along = {u: t, v: t}
        assert ubar.subs(along) == 0
        assert vbar.subs(along) == 2 * t
        assert sp.simplify((ubar.diff(u) + ubar.diff(v)).subs(along)) == 0
        assert sp.simplify((vbar.diff(u) + vbar.diff(v)).subs(along)) == 2


def test_kappa_tau_and_delta_of_example_1_stand() -> None:
    square = in_example_1(SQUARE)
    assert square == SIN**2 + 1
    tau = in_example_1(COMMON + SINE * (u2 * v1 - u1 * v2)) / square
    assert sp.simplify(tau - COS * (SIN**2 + 2) / (SIN**2 + 1)) == 0
    delta = (SIN * (2 * t * COS + SIN) + COS**2 + 1) / (SIN**2 + 1)
    assert sp.simplify(in_example_1(STRETCH) / square - delta) == 0


def test_kappa_bar_tau_bar_and_cot_sigma_of_example_1() -> None:
    stretch = in_example_1(STRETCH)
    assert sp.simplify(stretch - (t * sp.sin(2 * t) + 2)) == 0
    assert sp.simplify(stretch - (t * sp.sin(2 * t) + 3)) == -1
    advance = in_example_1(ADVANCE)
    assert advance == -2 * t * SIN
    # μ along the example: ū′ = 0, v̄′ = 2
    mu = (SIN * (0 - 2) + 2 * t * COS) / (1 + SIN**2)
    typeset = (
        -2 * t * SIN
        - (2 * t * SIN * (1 + SIN**2) + 2 * (t * COS - SIN) * sp.sin(2 * t)) / (1 + SIN**2) ** 2
    )
    assert sp.simplify(advance + mu.diff(t) - typeset) == 0
    # the printed cot σ: −t √κ² / (t cos t + 2 sin t) has 4 sin² t where κκ̄ has 2
    printed = -t / (t * COS + 2 * SIN)
    assert sp.simplify(printed - advance / (stretch - 2 + 4 * SIN**2)) == 0


# -- what stands as printed ------------------------------------------------------------------------

E = sp.symbols("epsilon")


def dual_part(expression: Any) -> Any:
    return sp.diff(expression, E).subs(E, 0)


def generic(name: str) -> Any:
    return sp.Matrix(sp.symbols(f"{name}1:4"))


@pytest.mark.parametrize("f", [sp.sin, sp.cos, sp.exp])
def test_the_dual_functions_of_2_1_stand(f: Any) -> None:
    """By a ring with ε² = 0 that knows no derivative: the matrices ((x, y), (0, x))."""
    x, y = sp.Rational(3, 7), sp.Rational(5, 3)
    terms = {
        sp.exp: lambda k: 1,
        sp.sin: lambda k: (0, 1, 0, -1)[k % 4],
        sp.cos: lambda k: (1, 0, -1, 0)[k % 4],
    }[f]
    matrix, power, total = sp.Matrix([[x, y], [0, x]]), sp.eye(2), sp.zeros(2)
    for k in range(24):
        total += terms(k) * power / sp.factorial(k)
        power = power * matrix
    slope = {sp.sin: sp.cos(x), sp.cos: -sp.sin(x), sp.exp: sp.exp(x)}[f]
    for entry, value in ((total[0, 0], f(x)), (total[0, 1], y * slope), (total[1, 0], 0)):
        assert abs(sp.N(entry - value, 20)) < 1e-15


def test_the_scalar_product_of_2_1() -> None:
    """Two lines at the angle θ and the distance d: cos θ − ε d sin θ."""
    theta, d = sp.symbols("theta d", real=True)
    first, foot = sp.Matrix([0, 0, 1]), sp.Matrix([d, 0, 0])
    other = sp.Matrix([0, -sp.sin(theta), sp.cos(theta)])  # turned by θ about the x-axis
    moments = sp.zeros(3, 1), foot.cross(other)
    assert first.dot(other) == sp.cos(theta)
    assert sp.simplify(first.dot(moments[1]) + other.dot(moments[0]) + d * sp.sin(theta)) == 0
    assert other.dot(moments[1]) == 0


def test_the_foot_point_of_2_1_stands() -> None:
    point, x = generic("p"), generic("x")
    foot = x.cross(point.cross(x))  # x × x̄
    assert (foot - (x.dot(x) * point - x.dot(point) * x)).expand() == sp.zeros(3, 1)


def test_the_four_invariants_of_6_stand() -> None:
    """As dual parts of ‖X′‖ and of [X, X′, X″]/‖X′‖²."""
    (x, x1, x2), (y, y1, y2) = ([generic(a + b) for b in "abc"] for a in "xy")
    dual = [a + E * b for a, b in ((x, y), (x1, y1), (x2, y2))]
    det = sp.Matrix.hstack(*dual).det()
    square = dual[1].dot(dual[1])
    kappa2, kappa_kappa_bar, tri = square.subs(E, 0), x1.dot(y1), det.subs(E, 0)
    assert sp.expand(dual_part(square) - 2 * kappa_kappa_bar) == 0  # (κ̂²)‾ = 2κκ̄
    triples = (
        sp.Matrix.hstack(y, x1, x2).det()
        + sp.Matrix.hstack(x, y1, x2).det()
        + sp.Matrix.hstack(x, x1, y2).det()
    )
    assert sp.expand(dual_part(det) - triples) == 0
    # τ̂ = det/κ̂²: its dual part times κ⁴, against triples/κ² − 2τκ̄/κ times κ⁴
    left = dual_part(det) * kappa2 - tri * dual_part(square)
    assert sp.expand(left - (triples * kappa2 - 2 * tri * kappa_kappa_bar)) == 0


def test_4_stands(algebra: Algebra) -> None:
    """x₂′ = −κx₁ + τx₃ with x₂ = x′/κ, x₃ = x × x₂, multiplied by κ, κ² or κ³."""
    x, x1, x2 = algebra.x
    assert same(x.dot(x), 1)
    assert same(x.dot(x1), 0)
    assert same(x2.dot(x), -SQUARE)  # ⟨x₂′, x₁⟩ = ⟨x″, x⟩/κ = −κ
    assert same(x2.dot(x.cross(x1)), algebra.triple(x, x1, x2))  # ⟨x₂′, x₃⟩ = [x, x′, x″]/κ²


def test_5_for_the_first_and_third_line_stands() -> None:
    moments, rates = moments_and_rates()
    k, kb, t_, tb, *_ = FRAME
    e = sp.eye(3)
    assert rates[0].expand() == (kb * e.col(1) + k * moments[1]).expand()
    assert rates[2].expand() == (-tb * e.col(1) - t_ * moments[1]).expand()
    p, q, r = FRAME[-3:]
    assert moments[0] == r * e.col(1) - q * e.col(2)
    assert moments[1] == p * e.col(2) - r * e.col(0)
    assert moments[2] == q * e.col(0) - p * e.col(1)  # α = (p, q, r), after (17)


def test_7_and_the_striction_curve_stand(algebra: Algebra) -> None:
    """m = c + μx lies on X₁, X₂ and X₃, and m′ has the parts τ̄, 0, κ̄."""
    (x, x1, _), (y, y1, _) = algebra.x, algebra.y
    foot, foot_rate = x.cross(y), x1.cross(y) + x.cross(y1)
    mu = -x1.dot(foot_rate)  # times κ²
    m = SQUARE * foot + mu * x  # times κ²
    assert all(same(a, b) for a, b in zip(m.cross(x), SQUARE * y, strict=True))
    # X₂ = X′/κ̂: κ x̄₂ = x̄′ − (κκ̄/κ²) x′, so κ² · κ · (m × x₂ − x̄₂) = 0
    x2bar = SQUARE * y1 - x1.dot(y1) * x1
    assert all(same(a, b) for a, b in zip(m.cross(x1), x2bar, strict=True))
    # ⟨m′, x₂⟩ = 0 and ⟨m′, x₃⟩ = κ̄; μ′x is along x₁
    m_rate = SQUARE * foot_rate + mu * x1
    assert same(m_rate.dot(x1), 0)
    assert same(m_rate.dot(x.cross(x1)), SQUARE * x1.dot(y1))


def test_the_chart_12_13_stands() -> None:
    chart = sp.Matrix([sp.cos(u) * sp.sin(v), sp.sin(u) * sp.sin(v), sp.cos(v)])
    dual = chart.subs({u: u + E * U, v: v + E * V}, simultaneous=True)
    printed = U * sp.Matrix([-sp.sin(u) * sp.sin(v), sp.cos(u) * sp.sin(v), 0]) + V * sp.Matrix(
        [sp.cos(u) * sp.cos(v), sp.sin(u) * sp.cos(v), -sp.sin(v)]
    )
    assert (dual_part(dual) - printed).expand() == sp.zeros(3, 1)
    assert sp.simplify(chart.dot(printed)) == 0


@pytest.mark.parametrize("n", [2, 3, 6])
def test_the_derivatives_of_4_2_stand(n: int) -> None:
    p = sp.symbols(f"p0:{n + 1}")

    def bernstein(degree: int, i: int) -> Any:
        return sp.binomial(degree, i) * (1 - t) ** (degree - i) * t**i

    curve = sum(bernstein(n, i) * p[i] for i in range(n + 1))
    once = n * sum(bernstein(n - 1, i) * (p[i + 1] - p[i]) for i in range(n))
    bends = [p[i + 2] - 2 * p[i + 1] + p[i] for i in range(n - 1)]
    twice = n * (n - 1) * sum(bernstein(n - 2, i) * bends[i] for i in range(n - 1))
    assert sp.expand(curve.diff(t) - once) == 0
    assert sp.expand(curve.diff(t, 2) - twice) == 0
    assert (curve.subs(t, 0), curve.subs(t, 1)) == (p[0], p[n])


def test_the_formulas_of_4_2_at_the_start() -> None:
    """κ(0) and κ̄(0) stand; δ(0) and cot σ(0) are the quotients without the terms with Δ_v."""
    n, a, b, A, B = sp.symbols("n a b A B", positive=True)  # Δ_u, Δ_v, Δ²_u, Δ²_v
    start = {u1: n * a, v1: n * b, u2: n * (n - 1) * A, v2: n * (n - 1) * B}
    square, stretch = SQUARE.subs(start), STRETCH.subs(start)
    legs, kept = a**2 * SINE**2 + b**2, a**2 * SINE * (V * COSINE + Uu * SINE)
    rest = a * b * (Vu + Uv * SINE**2) + b**2 * Vv
    assert sp.expand(square - n**2 * legs) == 0
    assert sp.expand(stretch - n**2 * (kept + rest)) == 0  # κκ̄: one n for κ, one for κ̄
    assert sp.simplify(stretch / square - (kept + rest) / legs) == 0  # δ(0): no n is left
    # as printed: cot σ(0) is ⟨c′, x⟩ κ/κκ̄ with the rest dropped; sin v₀ cancels, and so does n
    advance = ADVANCE.subs(start)
    shortened = advance * n * sp.sqrt(legs) / (n**2 * kept)
    printed = (U * b - V * a) * sp.sqrt(legs) / (a**2 * (V * COSINE + Uu * SINE))
    assert sp.simplify(shortened - printed) == 0
    tau = (COMMON + SINE * (u2 * v1 - u1 * v2)).subs(start) / square
    common = n * COSINE * a * (a**2 * SINE**2 + 2 * b**2)
    assert sp.simplify(tau - (common + (n - 1) * SINE * (b * A - a * B)) / legs) == 0
