"""Random designs for the laws of the geometry: curves, choices of ū and v̄, loops, motions."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ruledlab.geometry.curve import Bezier, close
from ruledlab.geometry.surface import RuledSurface

# Numbers on a coarse grid: Hypothesis shrinks them to something one can read.


def grid(low: float, high: float, steps: int = 200) -> st.SearchStrategy[float]:
    return st.integers(0, steps).map(lambda i: low + (high - low) * i / steps)


colatitudes = grid(0.5, 2.6)
"""Well away from the poles: sin v > 0.47 on the whole hull of the control points."""

places = st.lists(grid(0.0, 1.0, 1000), min_size=1, max_size=6).map(np.array)
"""A few values of t, the ends among them now and then."""


@st.composite
def curves(draw: st.DrawFn, least: int = 1, most: int = 6) -> Bezier:
    """Curves along which u grows steadily: κ stays away from 0."""
    degree = draw(st.integers(least, most))
    steps = draw(st.lists(grid(0.2, 1.0), min_size=degree, max_size=degree))
    v = draw(st.lists(colatitudes, min_size=degree + 1, max_size=degree + 1))
    u = draw(grid(-3.0, 3.0)) + np.cumsum([0.0, *steps])
    return Bezier(np.column_stack([u, v]))


@st.composite
def loops(draw: st.DrawFn, order: int = 1) -> Bezier:
    """Closed curves round (u₀, π/2) that enclose no pole; either orientation."""
    count = draw(st.integers(order + 5, 9))
    radii = draw(st.lists(grid(0.6, 0.95), min_size=count, max_size=count))
    angles = 2.0 * np.pi * np.arange(count) / count
    ring = np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])
    points = np.vstack([ring, ring[:1]]) + np.array([draw(grid(-2.0, 2.0)), np.pi / 2])
    closed = Bezier(close(points, order))
    return closed.reversed() if draw(st.booleans()) else closed


_leaves = st.sampled_from(["u", "v"]) | grid(0.2, 2.0, 18).map(lambda x: f"{x:.1f}")


def _larger(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    sums = st.tuples(inner, st.sampled_from("+-"), inner).map(lambda p: f"({p[0]} {p[1]} {p[2]})")
    products = st.tuples(inner, inner).map(lambda p: f"{p[0]}*{p[1]}")
    functions = st.tuples(st.sampled_from(["sin", "cos", "arctan"]), inner)
    return sums | products | functions.map(lambda p: f"{p[0]}({p[1]})")


formulas = st.recursive(_leaves, _larger, max_leaves=4)
"""ū or v̄: smooth everywhere, of moderate size."""

surfaces = st.builds(RuledSurface, curves(), formulas, formulas)

rotations = st.integers(0, 10**6).map(lambda seed: Rotation.random(rng=seed).as_matrix())
translations = st.tuples(*[grid(-2.0, 2.0)] * 3).map(np.array)
