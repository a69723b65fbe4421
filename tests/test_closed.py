"""Closing, pitch, angle of pitch and arc lengths: against Gauss–Bonnet, Stokes, transference and
differential equations, none of which know the formulas that are integrated.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.closed import ArcLengths, Closure
from ruledlab.geometry.curve import Bezier, close
from ruledlab.geometry.dual import Dual
from ruledlab.geometry.quadrature import integrate, sign_changes
from ruledlab.geometry.surface import RuledSurface

from .strategies import formulas, grid, loops, surfaces

few = settings(max_examples=20)
PI = math.pi
EXAMPLE_2 = np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]]) * PI / 8
MOEBIUS = np.array([[0, 3], [4, 3], [8, 9], [12, 9]]) * PI / 12
closed_surfaces = st.builds(RuledSurface, loops(), formulas, formulas)

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def gauss(panels: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights of a composite Gauss rule on [0, 1]."""
    start = np.arange(panels)[:, None] / panels
    t = start + (NODES + 1) / (2 * panels)
    return t.ravel(), np.tile(WEIGHTS / (2 * panels), panels)


def example_2(ubar: Any = "u - v", vbar: Any = "u + v") -> RuledSurface:
    return RuledSurface(Bezier(EXAMPLE_2), ubar, vbar)


def ring(v: float, turns: float = 1.0) -> Bezier:
    return Bezier(np.array([[0.0, v], [2 * PI * turns, v]]))


def rotation_index(curve: Bezier) -> int:
    """How often the tangent turns against the chart's meridians and parallels."""
    t = np.linspace(0, 1, 2001)
    (u1, v1), v = np.moveaxis(curve.derivative(t), -1, 0), curve(t)[:, 1]
    turned = np.unwrap(np.arctan2(u1 * np.sin(v), v1))
    return round(float(turned[-1] - turned[0]) / (2 * PI))


def over_region(curve: Bezier, density: Any) -> float:
    """∬ density du dv over what the loop encloses, each part as often as it is gone round.

    The region is swept by the segments from a fixed point to the loop.
    """
    (s, sw), (t, tw) = gauss(1), gauss(4)
    centre = curve.points[:-1].mean(axis=0)
    ray, rate = curve(t) - centre, curve.derivative(t)
    u, v = (centre[i] + s[:, None] * ray[:, i] for i in (0, 1))
    jacobian = s[:, None] * (ray[:, 0] * rate[:, 1] - ray[:, 1] * rate[:, 0])
    return float(sw @ (density(u, v) * jacobian) @ tw)


# -- three theorems --------------------------------------------------------------------------------


def test_gauss_bonnet_for_example_2() -> None:
    """The image is simple and encloses no pole: ∮τ = 2π − area, so −λ is 2π less the area."""
    surface = example_2()
    area = abs(over_region(surface.curve, lambda u, v: np.sin(v)))
    assert area == pytest.approx(0.1672475240, abs=1e-10)
    assert rotation_index(surface.curve) == 1
    assert -surface.angle_of_pitch() == pytest.approx(2 * PI - area, abs=1e-12)


@few
@given(closed_surfaces)
def test_gauss_bonnet(surface: RuledSurface) -> None:
    """−λ = ∮τ = 2π · index + ∮cos v du, and by Green's theorem the last is the signed area."""
    area = over_region(surface.curve, lambda u, v: np.sin(v))
    expected = 2 * PI * rotation_index(surface.curve) + area
    assert -surface.angle_of_pitch() == pytest.approx(expected, abs=1e-9)


@few
@given(closed_surfaces)
def test_stokes(surface: RuledSurface) -> None:
    """−l = ∮sin v (ū dv − v̄ du) = ∬ (ū_u sin v + v̄_v sin v + v̄ cos v) du dv."""

    def divergence(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        ubar_u, vbar_v = surface.ubar.partials(u, v)[0], surface.vbar.partials(u, v)[1]
        return (ubar_u + vbar_v) * np.sin(v) + surface.vbar(u, v) * np.cos(v)

    expected = -over_region(surface.curve, divergence)
    assert surface.pitch() == pytest.approx(expected, abs=1e-10)


@few
@given(closed_surfaces)
def test_transference(surface: RuledSurface) -> None:
    """−Λ = ∮τ̂ = ±2π + ∮cos v̂ dû with dual angles û, v̂: its dual part is the pitch."""
    t, weights = gauss(4)
    angles = surface.curve.series(t, 1)
    u, v = angles[0], angles[1]
    zero = 0.0 * u
    u_hat, v_hat = Dual(u, surface.ubar(u, v) + zero), Dual(v, surface.vbar(u, v) + zero)
    rate = Dual(u_hat.real.derivative().value, u_hat.dual.derivative().value)
    integrand = np.cos(Dual(v_hat.real.value, v_hat.dual.value)) * rate
    both = surface.dual_angle_of_pitch()
    turns = 2 * PI * rotation_index(surface.curve)
    assert -both.real == pytest.approx(turns + weights @ integrand.real, abs=1e-10)
    assert -both.dual == pytest.approx(weights @ integrand.dual, abs=1e-10)


# -- what l and λ mean -----------------------------------------------------------------------------

MEANING = {
    "example 2": example_2(),
    "hyperboloid": RuledSurface(ring(PI / 4), "0", "1"),
    "crown": RuledSurface(ring(1.1), "0.2*sin(3*u)", "1.5 + 0.3*cos(u)"),
}


@pytest.mark.parametrize("name", MEANING)
def test_an_orthogonal_trajectory_comes_back_displaced_by_the_pitch(name: str) -> None:
    surface = MEANING[name]

    def velocity(t: float, point: np.ndarray) -> np.ndarray:
        """Stay on the ruling, p × x = x̄, and at right angles to it: p′ = x × (p × x′ − x̄′)."""
        jet = surface.jet(np.array([t]), 1)
        (x, x1), y1 = jet.direction[:, :, 0], jet.moment[1, :, 0]
        return np.cross(x, y1 - np.cross(point, x1))

    start = surface.foot(0.0)
    path = solve_ivp(velocity, (0, 1), start, rtol=1e-10, atol=1e-11, method="DOP853")
    end, line = path.y[:, -1], surface.line(0.0)
    assert float(line.distance_to(end)) < 1e-7
    assert (end - start) @ line.direction == pytest.approx(surface.pitch(), abs=1e-7)


@pytest.mark.parametrize("name", MEANING)
def test_the_normal_that_spans_a_developable_turns_by_the_angle_of_pitch(name: str) -> None:
    surface = MEANING[name]

    def velocity(t: float, xi: np.ndarray) -> np.ndarray:
        """ξ ⊥ x with ξ′ ∥ x."""
        x, x1 = surface.jet(np.array([t]), 1).direction[:, :, 0]
        return -(xi @ x1) * x

    _, x2, x3 = surface.frame(0.0)
    path = solve_ivp(velocity, (0, 1), x2, rtol=1e-10, atol=1e-11, method="DOP853")
    end = path.y[:, -1]
    turned, expected = math.atan2(end @ x3, end @ x2), surface.angle_of_pitch()
    assert math.remainder(turned - expected, 2 * PI) == pytest.approx(0.0, abs=1e-7)


@few
@given(closed_surfaces, grid(0.1, 0.9))
def test_pitch_and_angle_are_the_integrals_of_tau(surface: RuledSurface, cut: float) -> None:
    """The pitch is integrated from ⟨c′, x⟩, which differs from τ̄ at every place; ∮ agrees."""
    lengths = surface.arc_lengths()
    assert surface.pitch() == pytest.approx(-lengths.tau_bar, abs=1e-10)
    assert surface.angle_of_pitch() == pytest.approx(-lengths.tau, abs=1e-10)
    both = surface.dual_angle_of_pitch()
    assert isinstance(both, Dual)
    assert (both.real, both.dual) == pytest.approx((-lengths.tau, -lengths.tau_bar), abs=1e-10)


@few
@given(closed_surfaces, st.integers(1, 4))
def test_pitch_does_not_depend_on_degree_and_changes_sign_with_the_sense(
    surface: RuledSurface, times: int
) -> None:
    raised = RuledSurface(surface.curve.raised(times), surface.ubar, surface.vbar)
    back = RuledSurface(surface.curve.reversed(), surface.ubar, surface.vbar)
    assert raised.pitch() == pytest.approx(surface.pitch(), abs=1e-11)
    assert back.pitch() == pytest.approx(-surface.pitch(), abs=1e-11)
    assert back.angle_of_pitch() == pytest.approx(-surface.angle_of_pitch(), abs=1e-9)


# -- arc lengths -----------------------------------------------------------------------------------


def lengths_by_gauss(surface: RuledSurface, panels: int) -> dict[str, float]:
    t, weights = gauss(panels)
    inv = surface.invariants(t)
    speed = np.hypot(inv.kappa_bar, inv.tau_bar)
    rows = {"kappa": inv.kappa, "kappa_bar": inv.kappa_bar, "tau": inv.tau, "tau_bar": inv.tau_bar}
    return {name: float(weights @ row) for name, row in {**rows, "striction": speed}.items()}


@pytest.mark.parametrize("name", MEANING)
def test_arc_lengths_to_1e_12(name: str) -> None:
    surface = MEANING[name]
    lengths, expected = surface.arc_lengths(), lengths_by_gauss(surface, 40)
    assert isinstance(lengths, ArcLengths)
    found = {key: getattr(lengths, key) for key in expected}
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_arc_lengths_against_quad() -> None:
    surface = example_2()
    lengths = surface.arc_lengths()
    for name in ("kappa", "kappa_bar", "tau", "tau_bar"):

        def at(t: float, name: str = name) -> float:
            return float(getattr(surface.invariants(t), name))

        value, error = quad(at, 0, 1, epsabs=1e-13, epsrel=1e-13, limit=200)
        assert error < 1e-12
        assert getattr(lengths, name) == pytest.approx(value, rel=1e-12)


@few
@given(surfaces, grid(0.1, 0.9))
def test_arc_lengths_add_up(surface: RuledSurface, cut: float) -> None:
    first, second = (
        RuledSurface(part, surface.ubar, surface.vbar).arc_lengths()
        for part in surface.curve.split(cut)
    )
    whole = surface.arc_lengths()
    for name in ("kappa", "kappa_bar", "tau", "tau_bar", "striction"):
        total = getattr(first, name) + getattr(second, name)
        assert getattr(whole, name) == pytest.approx(total, rel=1e-9, abs=1e-9)
    assert whole.x3.real == pytest.approx(first.x3.real + second.x3.real, rel=1e-9, abs=1e-9)
    assert whole.x3.dual == pytest.approx(first.x3.dual + second.x3.dual, rel=1e-8, abs=1e-8)


def test_the_dual_length_of_x3_needs_the_modulus_where_tau_changes_its_sign() -> None:
    """v − π/2 odd about t = ½ makes τ odd: ∮τ is 0, ∫|τ| is twice the half."""
    points = np.array([[0.0, PI / 2 - 0.8], [1.0, PI / 2], [2.0, PI / 2 + 0.8]])
    surface = RuledSurface(Bezier(points), "u*v", "cos(u)")
    half = RuledSurface(Bezier(points).split(0.5)[0], "u*v", "cos(u)").arc_lengths()
    lengths = surface.arc_lengths()
    assert lengths.tau == pytest.approx(0.0, abs=1e-13)
    assert half.tau > 0.5
    assert lengths.x3.real == pytest.approx(2 * half.tau, rel=1e-12)
    assert lengths.x3.dual == pytest.approx(2 * half.tau_bar - lengths.tau_bar, rel=1e-11)
    assert abs(lengths.x3.dual - lengths.tau_bar) > 0.1


@pytest.mark.parametrize(
    "points",
    [[[0.3, 0.4], [0.3, 1.0], [0.3, 2.0]], np.array([[0, 2], [1, 2], [0.5, 2], [3, 2]]) * PI / 4],
    ids=["meridian", "equator"],
)
def test_great_circles_have_no_torsion_to_change_sign(points: Any) -> None:
    """τ is rounding of either sign all along: not hundreds of pieces, and no failure."""
    lengths = RuledSurface(Bezier(np.array(points)), "sin(2*u) + v", "0.3*v").arc_lengths()
    assert lengths.tau == pytest.approx(0.0, abs=1e-12)
    assert (lengths.x3.real, lengths.x3.dual) == (0.0, 0.0)


def test_arc_lengths_of_a_cone() -> None:
    lengths = example_2(1.0, 0.0).arc_lengths()
    assert lengths.kappa_bar == 0.0
    assert lengths.tau_bar == pytest.approx(0.0, abs=1e-13)
    assert lengths.striction == pytest.approx(0.0, abs=1e-13)


def test_striction_curve_with_cusps() -> None:
    """Plücker's conoid: the striction point goes up and down the axis, κ̄ = 2 cos 2u, four times."""
    lengths = RuledSurface(ring(PI / 2), "sin(2*u)", 0).arc_lengths()
    assert lengths.striction == pytest.approx(8.0, rel=1e-11)
    assert lengths.kappa_bar == pytest.approx(0.0, abs=1e-12)


def test_arc_lengths_refuse_a_part_without_values() -> None:
    for ubar, curve in (("sqrt(u - 1)", Bezier(EXAMPLE_2)), ("u", Bezier(np.ones((3, 2))))):
        with pytest.raises(GeometryError, match=r"does not converge between t = .* undefined"):
            RuledSurface(curve, ubar, "v").arc_lengths()


# -- does it close? --------------------------------------------------------------------------------


def test_an_open_surface_says_how_far_it_gapes() -> None:
    surface = RuledSurface(Bezier(np.array([[0, PI / 2], [PI / 3, PI / 2]])), "2*u", "0")
    state = surface.closure()
    assert isinstance(state, Closure)
    assert (state.closed, state.oriented, state.order) == (False, False, -1)
    assert state.gaps.shape == (3, 2)
    assert state.gaps[0, 0] == pytest.approx(1.0)  # the chord of 60°
    assert "the direction turns by 1.047 rad and the line moves by 2.094" in state.reason


@pytest.mark.parametrize("order", [0, 1, 2])
def test_the_order_of_the_seam(order: int) -> None:
    open_ = np.array([[1, 4], [1, 6], [4, 7], [6, 6], [6, 3], [4, 2], [2, 2], [1, 3]]) * PI / 8
    state = RuledSurface(Bezier(close(open_, order)), "u - v", "u + v").closure()
    assert (state.closed, state.oriented, state.order) == (True, True, order)
    assert (state.gaps[: order + 1] < 1e-9).all()
    if order < 2:
        assert (state.gaps[order + 1] > 1e-3).all()
        jumps = ("X′", "X″")[order]
        assert f"closes with C{'⁰¹'[order]}; at the seam {jumps} jumps by" in state.reason
    else:
        assert state.reason == "closes with C²"


@few
@given(closed_surfaces)
def test_surfaces_over_closed_curves_close(surface: RuledSurface) -> None:
    state = surface.closure()
    assert state.oriented
    assert state.order >= 1


def test_one_turn_in_u_closes_where_the_fields_return() -> None:
    hyperboloid = RuledSurface(ring(PI / 4), "0", "1").closure()
    assert (hyperboloid.oriented, hyperboloid.order) == (True, 2)
    wave = RuledSurface(ring(PI / 4), "sin(3*u)", "cos(2*u)").closure()
    assert (wave.oriented, wave.order) == (True, 2)


def test_a_helicoid_does_not_close_although_its_directions_do() -> None:
    helicoid = RuledSurface(ring(PI / 2), "0.5*u", 0)
    state = helicoid.closure()
    assert not state.closed
    assert state.gaps[0, 0] < 1e-12
    assert state.gaps[0, 1] == pytest.approx(PI)
    assert "the direction turns by 0 rad and the line moves by 3.142" in state.reason


def test_a_moebius_closing_is_recognised_and_explained() -> None:
    surface = RuledSurface(Bezier(MOEBIUS), "0", "2*cos(u)")
    first, last = surface.line(0.0), surface.line(1.0)
    np.testing.assert_allclose(last.direction, -first.direction, atol=1e-15)
    np.testing.assert_allclose(last.moment, -first.moment, atol=1e-15)
    state = surface.closure()
    assert (state.closed, state.oriented, state.order) == (True, False, 2)
    assert "Möbius" in state.reason
    assert "two turns" in state.reason
    for ask in (surface.pitch, surface.angle_of_pitch, surface.dual_angle_of_pitch):
        with pytest.raises(GeometryError, match="Möbius"):
            ask()


def test_the_second_turn_of_a_moebius_band_undoes_the_first() -> None:
    first = RuledSurface(Bezier(MOEBIUS), "0.3*sin(u)**2", "2*cos(u)")
    again = Bezier(MOEBIUS * (1, -1) + (PI, PI))
    second = RuledSurface(again, "0.3*sin(u)**2", "2*cos(u)")
    one, two = first.arc_lengths(), second.arc_lengths()
    assert abs(one.tau_bar) > 0.1
    assert two.tau == pytest.approx(-one.tau, abs=1e-12)
    assert two.tau_bar == pytest.approx(-one.tau_bar, abs=1e-12)
    assert two.kappa_bar == pytest.approx(one.kappa_bar, abs=1e-12)


def test_a_reversed_direction_alone_is_no_moebius_closing() -> None:
    state = RuledSurface(Bezier(MOEBIUS), "u", "2*cos(u)").closure()
    assert not state.closed
    assert "not closed" in state.reason


@pytest.mark.parametrize(("ubar", "place"), [("sqrt(u - 0.9)", "0"), ("log(0.8 - u)", "0.375")])
def test_a_line_that_is_undefined_on_the_way(ubar: str, place: str) -> None:
    surface = example_2(ubar, "v")
    state = surface.closure()
    assert (state.closed, state.order) == (False, -1)
    assert np.isnan(state.gaps).all()
    assert state.reason == f"not closed: the line is undefined at t = {place}"
    with pytest.raises(GeometryError, match="the line is undefined at t"):
        surface.pitch()


def test_a_kink_on_the_way_leaves_the_surface_closed() -> None:
    middle = float(Bezier(EXAMPLE_2)(0.25)[0])  # one of the places where the closing is judged
    state = example_2(f"abs(u - {middle!r})", "v").closure()
    assert (state.oriented, state.order) == (True, 1)


def test_a_seam_without_derivatives_is_continuous_only() -> None:
    start = float(EXAMPLE_2[0, 1])
    state = example_2("u", f"abs(v - {start!r})").closure()
    assert (state.oriented, state.order) == (True, 0)
    assert state.reason == "closes with C⁰; at the seam X′ is undefined"


def test_enormous_surfaces_close_without_a_warning() -> None:
    assert example_2("1e200*u", "v").closure().oriented


@pytest.mark.parametrize(
    ("method", "what"),
    [
        ("pitch", "the pitch"),
        ("angle_of_pitch", "the angle of pitch"),
        ("dual_angle_of_pitch", "the dual angle of pitch"),
    ],
)
def test_the_refusal_names_what_was_asked_the_gap_and_the_remedy(method: str, what: str) -> None:
    surface = RuledSurface(ring(PI / 2), "0.5*u", 0)
    with pytest.raises(GeometryError) as error:
        getattr(surface, method)()
    text = str(error.value)
    assert text.startswith(f"{what} needs a surface that closes")
    assert "the line moves by 3.142" in text
    assert "close the curve" in text
    assert "\n" not in text


@pytest.mark.parametrize(
    "method", ["closure", "pitch", "angle_of_pitch", "dual_angle_of_pitch", "arc_lengths"]
)
def test_a_batch_is_asked_one_by_one(method: str) -> None:
    batch = RuledSurface(Bezier(np.stack([EXAMPLE_2, EXAMPLE_2])), "u - v", "u + v")
    with pytest.raises(GeometryError, match=rf"`{method}` must be asked of one surface.*\(2,\)"):
        getattr(batch, method)()


def test_results_are_frozen() -> None:
    state = example_2().closure()
    with pytest.raises(ValueError, match="read-only"):
        state.gaps[0, 0] = 1.0


# -- quadrature ------------------------------------------------------------------------------------

INTEGRALS = {
    "exponential": (np.exp, 0.0, 1.0, math.e - 1),
    "waves": (lambda t: np.sin(40 * t), 0.0, 1.0, (1 - math.cos(40)) / 40),
    "Runge": (lambda t: 1 / (1 + 25 * t * t), -1.0, 1.0, 2 * math.atan(5) / 5),
    "narrow": (lambda t: 0.01 / (1e-4 + t * t), -0.3, 0.7, math.atan(70) + math.atan(30)),
    "corner": (lambda t: np.abs(t - 1 / 3), 0.0, 1.0, 5 / 18),
    "short": (np.cos, 0.5, 0.5 + 1e-6, math.sin(0.5 + 1e-6) - math.sin(0.5)),
}  # fmt: skip


@pytest.mark.parametrize("name", INTEGRALS)
def test_integrate_to_1e_12(name: str) -> None:
    function, start, end, exact = INTEGRALS[name]
    value = integrate(lambda t: function(t), start, end, name)
    assert float(value) == pytest.approx(exact, rel=1e-12, abs=1e-13)


def test_integrate_takes_rows() -> None:
    value = integrate(lambda t: np.stack([t, t**2, 0 * t]), 0.0, 2.0, "rows")
    assert value == pytest.approx([2.0, 8 / 3, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    "function", [lambda t: 1 / (t - 0.3) ** 2, lambda t: np.sqrt(t - 0.5), lambda t: 1 / t]
)
def test_integrate_says_where_it_fails(function: Any) -> None:
    with (
        np.errstate(all="ignore"),
        pytest.raises(GeometryError, match="a test does not converge between t = 0 and t = 1"),
    ):
        integrate(function, 0.0, 1.0, "a test")


def test_sign_changes() -> None:
    found = sign_changes(lambda t: np.cos(7 * t), 0.0, 1.0)
    np.testing.assert_allclose(found, [PI / 14, 3 * PI / 14], rtol=1e-14)
    assert sign_changes(lambda t: (t - 0.5) ** 2, 0.0, 1.0).size == 0
    assert sign_changes(lambda t: 0.0 * t, 0.0, 1.0).size == 0
    np.testing.assert_allclose(sign_changes(lambda t: t - 0.5, 0.0, 1.0), [0.5])


def test_sign_changes_across_a_gap() -> None:
    def gaping(t: np.ndarray) -> np.ndarray:
        return np.where(np.abs(t - 0.4) < 0.01, np.nan, t - 0.4)

    (found,) = sign_changes(gaping, 0.0, 1.0)
    assert 0.39 <= found <= 0.41
