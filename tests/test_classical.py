"""The classical surfaces: everything that is known of them, and their equations in space."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.surface import RuledSurface

PI = math.pi
T = np.linspace(0.0, 1.0, 41)
W = np.array([-2.0, -0.5, 0.0, 0.7, 1.5])


def over(start: float, end: float, v: float, ubar: Any, vbar: Any) -> RuledSurface:
    """A surface with u running evenly from start to end at constant v; its u′ is end − start."""
    return RuledSurface(Bezier(np.array([[start, v], [end, v]])), ubar, vbar)


def known(surface: RuledSurface, rate: float, **expected: Any) -> None:
    """Check invariants that are stated per radian of u; δ and σ know no parameter."""
    invariants = surface.invariants(T)
    for name, value in expected.items():
        factor = 1.0 if name in ("delta", "sigma") else rate
        found = getattr(invariants, name)
        np.testing.assert_allclose(found, np.broadcast_to(factor * value, T.shape), atol=1e-12)


def on_axis(surface: RuledSurface, height: np.ndarray) -> None:
    zero = np.zeros_like(height)
    axis = np.stack([zero, zero, height], axis=-1)
    np.testing.assert_allclose(surface.striction(T), axis, atol=1e-13)


def satisfies(surface: RuledSurface, equation: Callable[..., np.ndarray]) -> None:
    x, y, z = np.moveaxis(surface.points(T, W), -1, 0)
    np.testing.assert_allclose(equation(x, y, z), 0.0, atol=1e-12)


@pytest.mark.parametrize("pitch", [0.5, -1.25])
def test_right_helicoid(pitch: float) -> None:
    surface = over(0.0, 4.0, PI / 2, f"{pitch}*u", 0)
    sense = PI / 2 if pitch > 0 else 3 * PI / 2
    known(surface, 4.0, kappa=1, kappa_bar=pitch, tau=0, tau_bar=0, delta=pitch, sigma=sense)
    on_axis(surface, pitch * 4.0 * T)
    satisfies(surface, lambda x, y, z: x * np.sin(z / pitch) - y * np.cos(z / pitch))
    curvature = surface.curvature(T, W)
    np.testing.assert_allclose(curvature.mean, 0.0, atol=1e-14)  # a minimal surface
    gauss = -((pitch / (pitch**2 + W**2)) ** 2)
    np.testing.assert_allclose(curvature.gauss, np.broadcast_to(gauss, (41, 5)), rtol=1e-12)


@pytest.mark.parametrize("angle", [0.4, 1.9])
def test_oblique_helicoid(angle: float) -> None:
    surface = over(-1.0, 2.0, angle, "0.7*u", 0)
    sine, cosine = math.sin(angle), math.cos(angle)
    known(surface, 3.0, kappa=sine, tau=cosine, delta=0.7, sigma=angle)
    known(surface, 3.0, kappa_bar=0.7 * sine, tau_bar=0.7 * cosine)
    on_axis(surface, 0.7 * (-1.0 + 3.0 * T))


@pytest.mark.parametrize("angle", [PI / 4, 1.2, 2.5])
@pytest.mark.parametrize("waist", [1.0, -0.3])
def test_hyperboloid_of_one_sheet(angle: float, waist: float) -> None:
    surface = over(0.0, 2 * PI, angle, 0, waist)
    sine, cosine = math.sin(angle), math.cos(angle)
    known(surface, 2 * PI, kappa=sine, kappa_bar=waist * cosine, tau=cosine, tau_bar=-waist * sine)
    known(surface, 1.0, delta=waist / math.tan(angle))
    slope = (cosine / sine) ** 2
    satisfies(surface, lambda x, y, z: slope * (x * x + y * y - waist**2) - z * z)
    assert surface.closure().oriented
    assert surface.pitch() == pytest.approx(2 * PI * waist * sine, rel=1e-12)
    assert surface.angle_of_pitch() == pytest.approx(-2 * PI * cosine, rel=1e-12)
    lengths = surface.arc_lengths()
    assert lengths.striction == pytest.approx(2 * PI * abs(waist), rel=1e-12)  # the waist circle
    z = surface.striction(T)[:, 2]
    np.testing.assert_allclose(z, 0.0, atol=1e-14)


def test_plucker_conoid() -> None:
    surface = over(0.0, 2 * PI, PI / 2, "sin(2*u)", 0)
    u = 2 * PI * T
    known(surface, 2 * PI, kappa=1, tau=0, tau_bar=0)
    known(surface, 2 * PI, kappa_bar=2 * np.cos(2 * u))
    known(surface, 1.0, delta=2 * np.cos(2 * u))
    on_axis(surface, np.sin(2 * u))
    satisfies(surface, lambda x, y, z: z * (x * x + y * y) - 2 * x * y)
    torsal = surface.invariants(np.array([1, 3, 5, 7]) / 8)
    np.testing.assert_array_equal(torsal.kappa_bar, 0.0)
    assert [report.names for report in torsal.undefined] == [("sigma",)]
    sigma = surface.invariants([0.0, 0.25, 0.5, 0.75]).sigma
    np.testing.assert_allclose(sigma, np.array([1, 3, 1, 3]) * PI / 2)


def test_hyperbolic_paraboloid() -> None:
    surface = over(-PI / 3, PI / 3, PI / 2, "0.8*tan(u)", 0)
    u, rate = 2 * PI / 3 * (T - 0.5), 2 * PI / 3
    known(surface, rate, kappa=1, tau=0, tau_bar=0, sigma=PI / 2, delta=0.8 / np.cos(u) ** 2)
    on_axis(surface, 0.8 * np.tan(u))
    satisfies(surface, lambda x, y, z: x * z - 0.8 * y)
    # K of the graph y = xz/0.8
    x, _, z = np.moveaxis(surface.points(T, W), -1, 0)
    gauss = -(0.8**-2) / (1 + (x**2 + z**2) / 0.64) ** 2
    np.testing.assert_allclose(surface.curvature(T, W).gauss, gauss, rtol=1e-11)


@pytest.mark.parametrize("apex", [0.0, 1.5, -2.0])
def test_circular_cone(apex: float) -> None:
    surface = over(0.0, 2 * PI, 0.6, apex, 0)
    known(surface, 2 * PI, kappa=math.sin(0.6), kappa_bar=0, tau=math.cos(0.6), tau_bar=0, delta=0)
    assert np.isnan(surface.invariants(T).sigma).all()
    on_axis(surface, np.full_like(T, apex))
    slope = math.tan(0.6) ** 2
    satisfies(surface, lambda x, y, z: x * x + y * y - slope * (z - apex) ** 2)
    # Principal curvatures of a cone: 0 and cot(half angle)/distance from the apex. The normal
    # changes sides at the apex, so the sign is the same on both.
    mean = surface.curvature(T, W[W != 0]).mean
    expected = -0.5 / math.tan(0.6) / np.abs(W[W != 0])
    np.testing.assert_allclose(mean, np.broadcast_to(expected, (41, 4)), rtol=1e-12)


@pytest.mark.parametrize("slope", [PI / 4, PI / 3, 2.0])
def test_tangents_of_a_helix(slope: float) -> None:
    """v = α, v̄ = −r, ū = p u with tan α = r/p: the tangents of (r sin u, −r cos u, p u)."""
    radius = 0.6
    climb = radius / math.tan(slope)
    surface = over(0.0, 5.0, slope, f"{climb!r}*u", -radius)
    length = math.hypot(radius, climb)
    known(surface, 5.0, kappa=math.sin(slope), kappa_bar=0, tau=math.cos(slope), tau_bar=length)
    known(surface, 1.0, delta=0.0)
    np.testing.assert_array_equal(surface.invariants(T).sigma, 0.0)  # no flicker to 2π
    u = 5.0 * T
    helix = np.stack([radius * np.sin(u), -radius * np.cos(u), climb * u], axis=-1)
    np.testing.assert_allclose(surface.striction(T), helix, atol=1e-13)
    assert surface.arc_lengths().striction == pytest.approx(5.0 * length, rel=1e-12)
    curvature = surface.curvature(T, W)
    np.testing.assert_array_equal(curvature.gauss[:, W != 0], 0.0)
    assert np.isnan(curvature.gauss[:, W == 0]).all()
    # H = −τ/(2|w|κ) on a tangent developable: τ/κ is the helix's torsion over its curvature.
    expected = -0.5 / math.tan(slope) / np.abs(W[W != 0])
    np.testing.assert_allclose(
        curvature.mean[:, W != 0], np.broadcast_to(expected, (41, 4)), rtol=1e-11
    )


def test_example_1_of_the_paper() -> None:
    """u = v = t, ū = 0, v̄ = 2t: with 2 where the paper prints 3 in κ̄."""
    surface, t = RuledSurface(Bezier(np.array([[0, 0], [1, 1]])), "u - v", "u + v"), T[1:]
    invariants, size = surface.invariants(t), np.sqrt(1 + np.sin(t) ** 2)
    np.testing.assert_allclose(invariants.kappa, size, rtol=1e-13)
    np.testing.assert_allclose(invariants.kappa_bar, (t * np.sin(2 * t) + 2) / size, rtol=1e-12)
    tau = np.cos(t) * (np.sin(t) ** 2 + 2) / size**2
    np.testing.assert_allclose(invariants.tau, tau, rtol=1e-11)
    delta = (np.sin(t) * (2 * t * np.cos(t) + np.sin(t)) + np.cos(t) ** 2 + 1) / size**2
    np.testing.assert_allclose(invariants.delta, delta, rtol=1e-12)
    start = surface.invariants(0.0)
    assert np.isnan(start.kappa)
    assert "pole" in start.undefined[0].reason


def test_all_lines_tangent_to_a_sphere_are_at_its_radius() -> None:
    points = Bezier(np.array([[0.1, 0.6], [1.0, 2.2], [2.4, 1.1]]))
    surface = RuledSurface(points, "1.3*cos(0.7)/sin(v)", "1.3*sin(0.7)")
    np.testing.assert_allclose(surface.line(T).distance_to([0, 0, 0]), 1.3, rtol=1e-13)
    np.testing.assert_allclose(np.linalg.norm(surface.foot(T), axis=-1), 1.3, rtol=1e-13)
