"""`Scene` and `Mark`: what the views are given is what the surface is, and is said in words."""

from __future__ import annotations

import re
import warnings
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.design import Design
from ruledlab.geometry import gallery
from ruledlab.lab.scene import (
    ACROSS,
    COLOURINGS,
    DRAWN,
    SYMBOLS,
    build_mark,
    build_scene,
    on_sphere,
    unwrapped,
)
from tests.strategies import curves, formulas

PI = np.pi
PAPER = Design(gallery.example("example_2").points, "u - v", "u + v", "C1", samples=41)
CONE = PAPER.with_(ubar="1", vbar="0")
HYPERBOLOID = Design(((0, PI / 4), (2 * PI, PI / 4)), "0", "1", "C2", samples=33)
TURNING = Design(((0, PI / 2), (2 * PI, PI / 2)), "-1.5*cos(2*u)", "cos(2*u)", "C2", samples=65)
CONOID = Design(((0, PI / 2), (2 * PI, PI / 2)), "sin(2*u)", "0", "C2", samples=17)
POLE = Design(((0, -1), (0, 1)), "u", "v", samples=9)
TO_AND_FRO = Design(((0, 1), (1, 1), (0, 1)), "u", "1", samples=9)
DOMAIN = Design(((0, 1), (1, 1)), "sqrt(u - 0.5)", "0", samples=9)
POINT = Design(((1, 1), (1, 1)), "u", "1", samples=9)


def scene_of(design, colouring="plain"):
    surface = design.surface()
    return build_scene(design, surface, surface.closure().closed, colouring), surface


@st.composite
def designs(draw):
    return Design(
        draw(curves(2)).points,
        draw(formulas),
        draw(formulas),
        length=draw(st.sampled_from([0.5, 2.0, 7.0])),
        samples=draw(st.integers(8, 40)),
        base=draw(st.sampled_from(["striction", "foot"])),
    )


# ---- arrays -------------------------------------------------------------------------------------


@given(designs(), st.sampled_from(list(COLOURINGS)))
@settings(max_examples=25)
def test_shapes_and_read_only_arrays(design, colouring):
    scene, surface = scene_of(design, colouring)
    count, controls = design.samples, len(design.points)
    assert scene.t.tolist() == np.linspace(0, 1, count).tolist()
    for name in ("direction", "direction_rate", "base", "base_rate", "striction"):
        assert getattr(scene, name).shape == (count, 3)
    assert (scene.chart.shape, scene.control.shape) == ((count, 2), (controls, 2))
    assert scene.control_directions.shape == (controls, 3)
    assert scene.w.tolist() == [-design.length / 2, design.length / 2]
    assert list(scene.curves) == list(DRAWN)
    assert {values.shape for values in scene.curves.values()} == {(count,)}
    width = {"plain": None, "delta": (count, 1)}.get(colouring, (count, ACROSS))
    assert (None if scene.colour is None else scene.colour.shape) == width
    mark = build_mark(design, surface, 0.5)
    drawn = [*(getattr(scene, f.name) for f in fields(scene)), *scene.curves.values()]
    drawn += [getattr(mark, f.name) for f in fields(mark)]
    arrays = [value for value in drawn if isinstance(value, np.ndarray)]
    assert len(arrays) >= 20
    assert not any(array.flags.writeable for array in arrays)


@given(designs())
@settings(max_examples=25)
def test_the_arrays_are_the_surface(design):
    scene, surface = scene_of(design)
    line = surface.line(scene.t)
    assert np.allclose(scene.direction, line.direction, atol=1e-14)
    assert np.allclose(scene.chart, surface.curve(scene.t), atol=1e-13)
    assert np.allclose(on_sphere(scene.chart), line.direction, atol=1e-13)
    assert np.allclose(scene.control_directions[[0, -1]], line.direction[[0, -1]], atol=1e-13)
    # Base and striction point lie on the ruling: p × x = x̄.
    size = 1.0 + np.abs(line.moment).max()
    for points in (scene.base, scene.striction):
        assert np.allclose(np.cross(points, line.direction), line.moment, atol=1e-9 * size)
    invariants = surface.invariants(scene.t)
    for name in set(DRAWN) - {"sigma"}:
        assert np.array_equal(scene.curves[name], getattr(invariants, name), equal_nan=True)


@given(designs())
@settings(max_examples=30)
def test_the_base_moves_as_its_rate_says(design):
    """The drawn surface has its normals from base_rate: here against central differences."""
    scene, surface = scene_of(design)
    base = surface.striction if design.base == "striction" else surface.foot
    t, h = scene.t[1:-1], 1e-4
    near = [base(t + k * h) for k in (-2, -1, 1, 2)]
    difference = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * h)
    size = 1.0 + np.abs(scene.base_rate).max() + np.abs(scene.base).max()
    assert np.allclose(scene.base[1:-1], base(t), atol=1e-12 * size)
    assert np.allclose(scene.base_rate[1:-1], difference, atol=1e-4 * size)
    turn = (surface.line(t + h).direction - surface.line(t - h).direction) / (2 * h)
    assert np.allclose(scene.direction_rate[1:-1], turn, atol=1e-4 * size)


@given(designs(), st.sampled_from(["gauss", "mean"]))
@settings(max_examples=25)
def test_curvature_colours_the_point_that_is_drawn(design, colouring):
    """K and H are known over m + w x, the drawing is base + w x: compare point by point."""
    scene, surface = scene_of(design, colouring)
    places = np.linspace(*scene.w, ACROSS)
    for i in range(0, design.samples, 7):
        drawn = scene.base[i] + places[:, None] * scene.direction[i]
        from_striction = (drawn - scene.striction[i]) @ scene.direction[i]
        known = getattr(surface.curvature(scene.t[i], from_striction), colouring)
        scale = np.nanmax(np.abs(known), initial=1.0)
        assert np.allclose(scene.colour[i], known, atol=1e-6 * scale, equal_nan=True)


def test_curvature_of_the_hyperboloid_in_closed_form():
    """x² + y² − z² = 1: K = −1/(1 + 2z²)², whichever point the rulings are centred on."""
    for base in ("striction", "foot"):
        scene, _ = scene_of(HYPERBOLOID.with_(base=base, length=5.0), "gauss")
        z = scene.base[:, None, 2] + np.linspace(*scene.w, ACROSS) * scene.direction[:, None, 2]
        assert np.allclose(scene.colour, -1 / (1 + 2 * z**2) ** 2, atol=1e-12)


def test_the_colour_of_delta_is_delta():
    scene, _ = scene_of(CONOID, "delta")
    assert np.allclose(scene.colour[:, 0], 2 * np.cos(4 * PI * scene.t), atol=1e-12)
    assert scene.colour_label == COLOURINGS["delta"]


# ---- sigma --------------------------------------------------------------------------------------


def test_sigma_that_turns_is_drawn_without_jumps():
    """Here σ = 2u: twice round, which as an angle in [0, 2π) would jump."""
    scene, surface = scene_of(TURNING)
    raw = surface.invariants(scene.t).sigma
    assert np.abs(np.diff(raw)).max() > 6
    expected = 4 * PI * scene.t
    assert np.allclose(scene.curves["sigma"] - scene.curves["sigma"][0], expected, atol=1e-9)


@given(designs())
@settings(max_examples=25)
def test_sigma_stays_the_same_angle(design):
    scene, surface = scene_of(design)
    raw, drawn = surface.invariants(scene.t).sigma, scene.curves["sigma"]
    assert np.allclose(np.exp(1j * raw), np.exp(1j * drawn), atol=1e-12, equal_nan=True)
    known = drawn[np.isfinite(drawn)]
    assert (np.abs(np.diff(known)) <= PI + 1e-9).all()


def test_unwrapping_leaves_gaps_and_its_argument_alone():
    angle = np.array([np.nan, 6.2, 0.1, np.nan, np.nan, 6.1, 0.2, np.nan])
    kept = angle.copy()
    result = unwrapped(angle)
    assert np.array_equal(angle, kept, equal_nan=True)
    expected = np.array([np.nan, 6.2, 0.1 + 2 * PI, np.nan, np.nan, 6.1, 0.2 + 2 * PI, np.nan])
    assert np.allclose(result, expected, equal_nan=True)
    nothing = np.full(3, np.nan)
    assert np.isnan(unwrapped(nothing)).all()


# ---- gaps ---------------------------------------------------------------------------------------


GAPS = {
    "pole": (POLE, set(DRAWN), [4], "pole", "t = 0.5"),
    "cylindrical": (TO_AND_FRO, set(DRAWN) - {"kappa"}, [4], "κ = 0", "t = 0.5"),
    "torsal and still": (CONOID, {"sigma"}, [2, 6, 10, 14], "κ̄ = τ̄ = 0",
                         "t = 0.125, 0.375, 0.625, 0.875"),
    "cone": (CONE, {"sigma"}, range(41), "rests there", "t = 0 … 1"),
    "domain": (DOMAIN, {"kappa_bar", "tau_bar", "sigma", "delta"}, range(5), "sqrt(u - 0.5)",
               "t = 0 … 0.5"),
    "one point": (POINT, set(DRAWN) - {"kappa"}, range(9), "κ = 0", "t = 0 … 1"),
}  # fmt: skip


@pytest.mark.parametrize(("design", "names", "where", "reason", "place"), GAPS.values(), ids=GAPS)
def test_gaps_are_nan_and_say_where_and_why(design, names, where, reason, place):
    scene, surface = scene_of(design)
    expected = np.isin(np.arange(design.samples), list(where))
    for name in DRAWN:
        missing = np.isnan(scene.curves[name])
        assert np.array_equal(missing, expected & (name in names)), name
    (sentence,) = [gap for gap in scene.gaps if reason in gap]
    assert re.match(f"{', '.join(SYMBOLS[n] for n in DRAWN if n in names)} undefined", sentence)
    assert f" at {place}. " in sentence
    assert sentence.endswith(".")
    assert sentence in scene.text
    at = float(scene.t[next(iter(where))])
    mark = build_mark(design, surface, at)
    assert {name for name, value in mark.values.items() if np.isnan(value)} == names
    assert reason in mark.text
    assert "undefined" in mark.text


def test_two_ends_are_not_the_whole():
    """Undefined at t = 0 and at t = 1 is something else than undefined from 0 to 1."""
    scene, _ = scene_of(Design(((0, 0), (0.5, 1), (1, PI)), "0", "1", samples=11))
    (gap,) = scene.gaps
    assert "t = 0, 1." in gap


def test_many_gaps_are_counted():
    scene, _ = scene_of(CONOID.with_(ubar="sin(8*u)", samples=33))
    (gap,) = scene.gaps
    assert gap.startswith("σ undefined at t = 0.03125, 0.09375, 0.1562, 0.2188 and 12 more places.")


@pytest.mark.parametrize("design", [POLE, TO_AND_FRO, CONOID, DOMAIN, CONE])
def test_symbols_keep_their_case(design):
    """A sentence that begins with κ must not begin with Κ, nor ū with Ū."""
    scene, surface = scene_of(design)
    words = scene.text + " ".join(build_mark(design, surface, t).text for t in (0, 0.125, 0.5))
    assert not set(words) & set("ΚΤΣŪ")


# ---- words --------------------------------------------------------------------------------------


def test_the_text_says_what_is_seen():
    scene, _ = scene_of(HYPERBOLOID.with_(length=3.5), "gauss")
    for words in (
        "Bézier curve of degree 1",
        "ū = 0 and v̄ = 1",
        "its last ruling is the first again",
        "κ is 4.443 throughout",
        "δ is 1 throughout",
        "rulings of length 3.5 centred on the striction curve",
        "K, Gauss curvature (1/length²)",
    ):
        assert words in scene.text
    numbers = re.search(r"\(1/length²\): from (\S+) to (\S+)\.", scene.text).groups()
    assert [float(x) for x in numbers] == pytest.approx(
        [scene.colour.min(), scene.colour.max()], rel=1e-3
    )


def test_the_text_follows_the_design():
    scene, _ = scene_of(PAPER.with_(points=PAPER.points[:-2], closing="open", base="foot"))
    assert "degree 4" in scene.text
    assert "its last ruling is not the first" in scene.text
    assert "centred on the foot points" in scene.text
    assert "colour" not in scene.text
    for name in DRAWN:
        low, high = np.nanmin(scene.curves[name]), np.nanmax(scene.curves[name])
        assert f"{SYMBOLS[name]} from {low:.4g} to {high:.4g}" in scene.text


def test_the_text_of_a_surface_that_has_nothing_says_so():
    scene, _ = scene_of(POINT)
    assert "τ is undefined" in scene.text
    assert "κ is 0 throughout" in scene.text


# ---- the cursor ---------------------------------------------------------------------------------


@given(designs(), st.integers(0, 100))
@settings(max_examples=25)
def test_the_mark_is_the_surface_at_t(design, step):
    surface, t = design.surface(), step / 100
    mark = build_mark(design, surface, t)
    invariants = surface.invariants(t)
    assert mark.t == t
    assert np.allclose(mark.chart, surface.curve(t), atol=1e-13)
    assert np.allclose(mark.frame, surface.frame(t), atol=1e-13)
    assert np.allclose(mark.striction, surface.striction(t), rtol=1e-12)
    base = surface.striction(t) if design.base == "striction" else surface.foot(t)
    assert np.allclose(mark.base, base, rtol=1e-12)
    for name in DRAWN:
        value = getattr(invariants, name)
        assert mark.values[name] == pytest.approx(float(value), nan_ok=True)
        if np.isfinite(value):
            assert f"{SYMBOLS[name]} = {value:.4f}" in mark.text
    assert f"t = {t:.3f}" in mark.text


def test_the_frame_is_missing_where_the_ruling_does_not_turn():
    mark = build_mark(POINT, POINT.surface(), 0.5)
    assert np.isfinite(mark.frame[0]).all()
    assert np.isnan(mark.frame[1:]).all()
    assert np.isnan(mark.striction).all()


# ---- wild designs -------------------------------------------------------------------------------


POINTS = {
    "open": ((0, 1), (1, 2), (2, 1)),
    "one point": ((1, 1), (1, 1)),
    "in a pole": ((0, 0), (0, 0)),
    "through a pole": ((0, -1), (0, 1)),
    "to and fro": ((0, 1), (1, 1), (0, 1)),
    "nearly a point": ((0, 1), (1e-9, 1 + 1e-9)),
    "many turns": ((0, 1), (1e6, 1)),
}
WILD = ("0", "1/(u - 0.5)", "sqrt(u - 0.5)", "tan(3*u)", "exp(exp(u*v))", "1e120", "sin(900*u)")


@pytest.mark.parametrize("base", ["striction", "foot"])
@pytest.mark.parametrize("points", POINTS.values(), ids=POINTS)
def test_a_wild_design_has_a_finite_ball_and_warns_of_nothing(points, base):
    for ubar in WILD:
        for vbar in ("1", "log(v - 1)", "1e120"):
            design = Design(points, ubar, vbar, base=base, samples=21)
            surface = design.surface()
            for colouring in ("gauss", "mean"):
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    scene = build_scene(design, surface, False, colouring)
            assert np.isfinite(scene.centre).all()
            assert 0 < scene.radius < np.inf


@pytest.mark.parametrize("design", [PAPER, HYPERBOLOID, CONOID, CONE, TURNING])
@pytest.mark.parametrize("base", ["striction", "foot"])
def test_the_ball_holds_most_of_the_drawing(design, base):
    scene, _ = scene_of(design.with_(base=base))
    w = np.linspace(*scene.w, 9)[:, None, None]
    drawn = (scene.base + w * scene.direction).reshape(-1, 3)
    distance = np.linalg.norm(drawn - scene.centre, axis=1)
    assert np.mean(distance <= 1.01 * scene.radius) > 0.9
    assert scene.radius < 1.5 * distance.max()


def test_a_few_far_rulings_do_not_shrink_the_picture():
    """Near u = π/2 the rulings run off to infinity; the rest is still seen."""
    design = Design(((0, 1), (PI, 1)), "tan(u)", "1", samples=200)
    scene, _ = scene_of(design)
    far = np.nanmax(np.linalg.norm(scene.striction, axis=1))
    assert far > 20
    assert scene.radius < far / 4
