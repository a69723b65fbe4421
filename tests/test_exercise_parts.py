"""Parts that several lessons' exercises share: numbers in TeX, what is asked of a design."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ruledlab.exercises import tex
from ruledlab.exercises.core import made
from ruledlab.exercises.designs import EXAMPLE_2, at_least, enlarged, has_pitch, values
from ruledlab.geometry import gallery
from ruledlab.geometry.gallery import LOOP


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (tex.times(1), ""),
        (tex.times(-1), "-"),
        (tex.times(-2.5), "-2.5"),
        (tex.times(0), "0"),
        (tex.combination((2, "u"), (-1, "z")), "2u-z"),
        (tex.combination((0, "u"), (1, "z")), "z"),
        (tex.combination((1, "u"), (1, "v"), (-3, "")), "u+v-3"),
        (tex.combination((-1, ""), (1, "u")), "-1+u"),
        (tex.combination((0, "u")), "0"),
        (tex.dual(2, -1), r"2-\varepsilon"),
        (tex.dual(0, 3), r"3\varepsilon"),
        (tex.dual(-1, 0), "-1"),
        (tex.vector([0.6, -0.0, -1e-9]), r"(0.6,\,0,\,0)"),
        (tex.vector(np.array([1, 2, 3])), r"(1,\,2,\,3)"),
        (tex.angle(0.0), "0"),
        (tex.angle(math.pi), r"\pi"),
        (tex.angle(-2 * math.pi), r"-2\pi"),
        (tex.angle(math.pi / 2), r"\tfrac\pi2"),
        (tex.angle(3 * math.pi / 8), r"\tfrac{3\pi}8"),
        (tex.angle(-math.pi / 12), r"-\tfrac\pi{12}"),
        (tex.angle(5 * math.pi / 16), r"\tfrac{5\pi}{16}"),
    ],
)
def test_tex_is_written_as_by_hand(text: str, expected: str) -> None:
    assert text == expected


def test_an_angle_that_is_no_fraction_of_pi_is_refused() -> None:
    with pytest.raises(ValueError, match="fraction of π"):
        tex.angle(1.0)


@given(st.lists(st.integers(-3, 3), min_size=1, max_size=4))
def test_a_combination_has_the_value_of_its_terms(factors: list[int]) -> None:
    names = "abcd"[: len(factors)]
    text = tex.combination(*zip(factors, names, strict=True))
    for sign in "+-":
        text = text.replace(sign, f" {sign}")
    worth = dict.fromkeys(names, 0)
    for term in text.split():
        size = term.strip("+-" + names)
        worth[term[-1]] = int(size or 1) * (-1 if term.startswith("-") else 1) if size != "0" else 0
    assert [worth[name] for name in names] == factors or not any(factors)


def test_example_2_is_that_of_the_gallery() -> None:
    shown = gallery.example("example_2")
    for name in ("points", "ubar", "vbar", "closing"):
        assert getattr(EXAMPLE_2, name) == getattr(shown, name)


def test_a_pitch_of_nearly_nothing_has_no_sign() -> None:
    loop = EXAMPLE_2.with_(ubar="0", vbar="0.0001")
    for design in (loop, loop.with_(points=LOOP[::-1])):
        assert has_pitch(made(design)).now == "now $l=0.000$"


def test_the_pitch_of_a_design_is_measured_against_its_own() -> None:
    result = made(EXAMPLE_2)
    pitch = EXAMPLE_2.surface().pitch()
    assert has_pitch(result, pitch).met
    assert not has_pitch(result, pitch + 0.03).met
    assert has_pitch(result, pitch + 0.03, within=0.04).met
    assert has_pitch(result).off == pytest.approx(abs(pitch))


def test_an_open_design_has_no_pitch() -> None:
    condition = has_pitch(made(EXAMPLE_2.with_(closing="open", points=LOOP[:-1])))
    assert math.isnan(condition.off)
    assert not condition.met
    assert condition.now == "the surface does not close"


@pytest.mark.parametrize(("now", "off"), [(0.5, 0.5), (1.0, 0.0), (2.0, 0.0)])
def test_at_least_is_met_from_there_on(now: float, off: float) -> None:
    condition = at_least("long", now, 1.0)
    assert condition.off == off
    assert condition.met == (now >= 1.0)


def test_what_cannot_be_measured_is_not_met() -> None:
    assert not at_least("long", math.nan, 1.0).met


def test_values_are_the_invariants_where_they_are_defined() -> None:
    t = np.linspace(0.0, 1.0, 201)
    expected = EXAMPLE_2.surface().invariants(t).delta
    np.testing.assert_array_equal(values(made(EXAMPLE_2), "delta"), expected)
    straight = EXAMPLE_2.with_(points=((0.0, 1.0), (0.0, 1.0)), closing="open")
    assert values(made(straight), "delta").size == 0  # nothing turns: δ is undefined


@given(st.floats(0.1, 3.0))
def test_enlarging_keeps_the_middle_and_can_be_undone(factor: float) -> None:
    grown = enlarged(EXAMPLE_2, factor)
    back = enlarged(grown, 1 / factor)
    np.testing.assert_allclose(back.points, EXAMPLE_2.points, atol=1e-12)
    off = np.array(grown.points) - math.pi / 4
    np.testing.assert_allclose(off, factor * (np.array(LOOP) - math.pi / 4), atol=1e-12)
