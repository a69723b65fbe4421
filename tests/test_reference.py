"""The geometry against numbers that an independent program computed to 25 digits."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ruledlab.geometry.curve import Bezier
from ruledlab.geometry.surface import RuledSurface

DATA = Path(__file__).parent / "data"
REFERENCES = {
    path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(DATA.glob("*.json"))
}
FIELDS = {
    "kappa": "kappa",
    "kappabar": "kappa_bar",
    "tau": "tau",
    "taubar": "tau_bar",
    "delta": "delta",
    "dkappa": "kappa_prime",
    "dkappabar": "kappa_bar_prime",
}
TOLERANCE = {"rtol": 1e-10, "atol": 1e-10}


def surface_of(reference: dict[str, Any]) -> RuledSurface:
    # Example 1 is u = v = t, which is the straight line through (0, 0) and (1, 1).
    points = reference["control_points"] or [[0.0, 0.0], [1.0, 1.0]]
    return RuledSurface(Bezier(np.array(points)), reference["ubar"], reference["vbar"])


def column(reference: dict[str, Any], name: str) -> np.ndarray:
    return np.array([sample[name] for sample in reference["samples"]])


@pytest.fixture(params=sorted(REFERENCES))
def reference(request: pytest.FixtureRequest) -> dict[str, Any]:
    return REFERENCES[request.param]


def test_there_are_references() -> None:
    assert set(REFERENCES) == {"example_1", "example_2", "open_quartic"}


@pytest.mark.parametrize(("theirs", "ours"), FIELDS.items())
def test_invariants(reference: dict[str, Any], theirs: str, ours: str) -> None:
    invariants = surface_of(reference).invariants(column(reference, "t"))
    np.testing.assert_allclose(
        getattr(invariants, ours), column(reference, theirs), **TOLERANCE, strict=True
    )


def test_striction_angle(reference: dict[str, Any]) -> None:
    """The reference has σ in (−π, π], we have it in [0, 2π)."""
    sigma = surface_of(reference).invariants(column(reference, "t")).sigma
    expected = np.mod(column(reference, "sigma"), 2 * np.pi)
    np.testing.assert_allclose(sigma, expected, **TOLERANCE)


def test_line_foot_and_striction_point(reference: dict[str, Any]) -> None:
    surface, t = surface_of(reference), column(reference, "t")
    line = surface.line(t)
    for ours, theirs in (
        (line.direction, "x"),
        (line.moment, "xbar"),
        (surface.foot(t), "c"),
        (surface.striction(t), "m"),
    ):
        np.testing.assert_allclose(ours, column(reference, theirs), **TOLERANCE, strict=True)


def test_curvature(reference: dict[str, Any]) -> None:
    samples = reference["samples"]
    w = np.array([place["w"] for place in samples[0]["curvature"]])
    found = surface_of(reference).curvature(column(reference, "t"), w)
    for name in ("gauss", "mean"):
        expected = np.array([[place[name] for place in s["curvature"]] for s in samples])
        assert all([p["w"] for p in s["curvature"]] == w.tolist() for s in samples)
        np.testing.assert_allclose(getattr(found, name), expected, **TOLERANCE, strict=True)


def test_closed_values() -> None:
    reference = REFERENCES["example_2"]
    surface, closed = surface_of(reference), reference["closed"]
    lengths = surface.arc_lengths()
    found = {
        "integral_tau": lengths.tau,
        "integral_taubar": lengths.tau_bar,
        "integral_taubar_striction": lengths.tau_bar,
        "pitch": surface.pitch(),
        "angle_of_pitch": surface.angle_of_pitch(),
    }
    assert found == pytest.approx(closed, rel=1e-12)
    both = surface.dual_angle_of_pitch()
    assert both.real == pytest.approx(closed["angle_of_pitch"], rel=1e-12)
    assert both.dual == pytest.approx(closed["pitch"], rel=1e-12)
