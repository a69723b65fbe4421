"""What is printed and what is right: every finding evaluated, typeset and told.

The numbers come from `mpmath` and the definitions alone (`latex_reader`), the derivations are in
`test_printed_algebra`, the comparison with the list known beforehand in `test_printed_list`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from ruledlab.geometry import Bezier, BSpline, GeometryError, RuledSurface, gallery
from ruledlab.printed import CONFIRMED, PRINTED, REMARKS, TRIED, Finding, finding

from .latex_reader import CASES, LOOP, Case, W, exact, read

KEYS = [entry.key for entry in PRINTED]
PI = np.pi
u, v = sp.symbols("u v")

# -- the typeset formulas --------------------------------------------------------------------------


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
                if latex == finding("cot_sigma").printed_latex:
                    del expected[0]  # τ̄/κ̄, which is right
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


def seam(aside: float) -> RuledSurface:
    """A C¹ seam whose second differences differ by a multiple of the leg, and by `aside` of it."""
    points = CORNER.copy()
    points = np.insert(points, -2, points[-3], axis=0)
    leg = points[1] - points[0]
    points[-2] = points[0] - leg
    points[-3] = points[2] - 4 * leg + 0.7 * leg + aside * np.array([-leg[1], leg[0]])
    return RuledSurface(Bezier(points), "u - v", "u + v")


@pytest.mark.parametrize("aside", [0.0, 1.0])
def test_torsion_and_striction_jump_at_a_c1_seam_unless_the_curvature_agrees(aside: float) -> None:
    """u″ and v″ need not agree: only u″v′ − u′v″ must."""
    surface = seam(aside)
    (_, d, dd), inv = (
        surface.curve.series(np.array([0.0, 1.0]), 2).derivatives(),
        surface.invariants([0.0, 1.0]),
    )
    np.testing.assert_allclose(d[:, 0], d[:, 1])
    assert np.abs(dd[:, 0] - dd[:, 1]).max() > 1.0
    jumps = [abs(float(np.subtract(*value))) for value in (inv.tau, inv.sigma)]
    assert inv.kappa[0] == pytest.approx(inv.kappa[1])
    assert [jump > 0.05 for jump in jumps] == [bool(aside)] * 2
    assert aside or max(jumps) < 1e-9


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
    assert str(TRIED[0]).startswith("A bound instead of a search: A simple loop")
    with pytest.raises(GeometryError, match="`key` must be one of x2bar_prime, "):
        finding("nonsense")
