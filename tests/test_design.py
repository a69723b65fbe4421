"""`Design` as JSON and as a short text: exact both ways, and every bad file refused by name."""

from __future__ import annotations

import base64
import json
import struct
import time
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.design import CLOSINGS, PREFIX, Design
from ruledlab.geometry import gallery
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import Bezier, close, seam
from ruledlab.geometry.field import field
from tests.strategies import formulas, loops

SIMPLE = Design(((0.1, 0.7), (1.1780972450961724, 0.3), (2.0, 1 / 3)), "u - v", "0.1", name="a é ✓")


def exactly(design: Design) -> tuple[object, ...]:
    """Return the design with its floats as bits: −0.0 is not 0.0 here."""
    floats = [x for point in design.points for x in point] + [design.length]
    rest = (design.ubar, design.vbar, design.closing, design.samples, design.base, design.name)
    return (struct.pack(f"{len(floats)}d", *floats), len(design.points), *rest)


coordinates = st.floats(-1e100, 1e100, allow_subnormal=True)
open_points = st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=61)
titles = st.text(st.characters(codec="utf-8"), max_size=200)


@st.composite
def designs(draw: st.DrawFn) -> Design:
    closing = draw(st.sampled_from(list(CLOSINGS)))
    points = draw(open_points)
    if closing != "open":
        points = close(draw(loops(2)).points, CLOSINGS[closing])
    return Design(
        points,
        draw(formulas | st.floats(-1e9, 1e9)),
        draw(formulas),
        closing,
        length=draw(st.floats(1e-6, 1e6)),
        samples=draw(st.integers(8, 800)),
        base=draw(st.sampled_from(["striction", "foot"])),
        name=draw(titles),
    )


def refused(action, *words):
    """Expect a refusal in one line that contains the words; return it."""
    with pytest.raises(GeometryError) as caught:
        action()
    text = str(caught.value)
    assert "\n" not in text
    assert len(text) < 400
    for word in words:
        assert word in text, text
    return text


def altered(**entries):
    """Return the JSON of a good design with some entries replaced; None takes one away."""
    content = json.loads(SIMPLE.to_json()) | entries
    return json.dumps({k: v for k, v in content.items() if v is not None})


# ---- both ways ----------------------------------------------------------------------------------


@given(designs())
@settings(max_examples=50)
def test_json_and_text_give_the_same_design_bit_for_bit(design):
    assert exactly(Design.from_json(design.to_json())) == exactly(design)
    assert exactly(Design.from_text(design.to_text())) == exactly(design)


@pytest.mark.parametrize("key", gallery.names())
def test_the_gallery_goes_both_ways(key):
    example = gallery.example(key)
    design = Design(
        example.points, example.ubar, example.vbar, closing=example.closing, name=example.title
    )
    assert Design.from_json(design.to_json()) == design == Design.from_text(design.to_text())
    t = np.linspace(0, 1, 7)
    known, again = gallery.surface(key), Design.from_text(design.to_text()).surface()
    assert np.array_equal(known.invariants(t).delta, again.invariants(t).delta, equal_nan=True)


def test_extreme_floats_survive():
    values = [0.1, -0.0, 5e-324, 1.7976931348623157e-308, 1e100, np.nextafter(1.0, 2.0), np.pi]
    design = Design([(x, -x) for x in values])
    assert exactly(Design.from_json(design.to_json())) == exactly(design)
    assert exactly(Design.from_text(design.to_text())) == exactly(design)


def test_the_json_is_plain_and_says_what_it_is():
    content = json.loads(SIMPLE.to_json())
    assert (content.pop("format"), content.pop("version")) == ("ruledlab design", 1)
    assert set(content) == set(Design.__slots__)
    assert content["points"] == [list(point) for point in SIMPLE.points]


def test_entries_that_are_left_out_have_their_defaults():
    text = '{"format": "ruledlab design", "version": 1, "points": [[0, 1], [1, 1]]}'
    assert Design.from_json(text) == Design(((0, 1), (1, 1)))


def test_the_short_text_is_short_and_one_word():
    text = gallery_text = Design(gallery.example("example_2").points, "u - v", "u + v").to_text()
    assert text.startswith(PREFIX)
    assert len(text.split()) == 1
    assert len(gallery_text) < 250


# ---- bad files, by name -------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["", 'a "quoted" \\ \u00e9 title', "1e5", "[[["])
def test_a_file_cut_anywhere_is_said_to_be_cut_off(name):
    text = SIMPLE.with_(name=name, length=1.25e-05).to_json()
    for length in range(len(text)):
        refused(lambda n=length: Design.from_json(text[:n]), "`text` ends too early (cut off?)")


@pytest.mark.parametrize("extra", ["}", "]", "x", ", 1", "{}"])
def test_a_file_with_more_after_its_end_is_not_called_cut_off(extra):
    message = refused(lambda: Design.from_json(SIMPLE.to_json() + extra), "is not JSON")
    assert "cut off" not in message


def test_damage_in_the_middle_names_line_and_column():
    text = SIMPLE.to_json().replace('"ubar":', '"ubar"', 1)
    line = text[: text.index('"ubar"')].count("\n") + 1
    refused(lambda: Design.from_json(text), "is not JSON", f"line {line}, column")


@pytest.mark.parametrize("version", [0, 2, 17, "1", None, [1], 1.5])
def test_another_version(version):
    refused(lambda: Design.from_json(altered(version=version)), "version 1", repr(version))


@pytest.mark.parametrize(
    "text",
    ["{}", "[]", "[1, 2]", "3", "null", '"ruledlab design"', '{"format": "other", "version": 1}',
     '{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}',
     '{"type": "FeatureCollection", "features": []}', '{"format": ["ruledlab design"]}'],
)  # fmt: skip
def test_another_programs_json(text):
    refused(lambda: Design.from_json(text), "`text` must be a design saved by ruledlab")


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity"])
@pytest.mark.parametrize("entry", ['"points": [[%s, 1], [1, 1]]', '"length": %s', '"ubar": %s'])
def test_nan_and_infinity(word, entry):
    points = '"points": [[0, 1], [1, 1]], ' if "points" not in entry else ""
    text = '{"format": "ruledlab design", "version": 1, ' + points + entry % word + "}"
    refused(lambda: Design.from_json(text), "finite", f"got {word}")


@pytest.mark.parametrize("name", ["points", "length", "ubar", "samples"])
def test_a_number_too_large_for_a_float_is_no_infinity_in_disguise(name):
    value = "[[0, 1], [1e999, 1]]" if name == "points" else "1e999"
    content = {"format": "ruledlab design", "version": 1, "points": [[0, 1], [1, 1]], name: "HERE"}
    text = json.dumps(content).replace('"HERE"', value)
    refused(lambda: Design.from_json(text), f"`{name}`")


def test_a_whole_number_of_5000_digits():
    text = altered(length="HERE").replace('"HERE"', "7" * 5000)
    refused(lambda: Design.from_json(text), "digits")


def test_a_million_points_are_refused_at_once():
    points = "[" + "[0.5, 1.5], " * (10**6 - 1) + "[0.5, 1.5]]"
    text = '{"format": "ruledlab design", "version": 1, "points": ' + points + "}"
    word = PREFIX + base64.b64encode(zlib.compress(text.encode(), 1)).decode()
    started = time.process_time()
    refused(lambda: Design.from_json(text), "characters")
    refused(lambda: Design.from_text(word), PREFIX)
    refused(lambda: Design(np.zeros((10**6, 2))), "2 to 61 control points", "got 1000000")
    assert time.process_time() - started < 0.2


def test_too_many_points_in_a_small_file():
    refused(lambda: Design.from_json(altered(points=[[0, 1]] * 62)), "`points`", "got 62")
    assert len(Design.from_json(altered(points=[[0, 1]] * 61)).points) == 61


@pytest.mark.parametrize("depth", [100, *range(880, 1010, 25), 20_000])
@pytest.mark.parametrize("where", ["alone", "points", "point", "length", "ubar", "name", "closing"])
def test_deep_nesting(depth, where):
    deep = "[" * depth + "]" * depth
    text = deep
    if where != "alone":
        value = {"points": deep, "point": f"[[0, 1], [1, {deep}]]"}.get(where, deep)
        entry = "points" if where == "point" else where
        content = {"format": "ruledlab design", "version": 1, "points": [[0, 1], [1, 1]]}
        text = json.dumps(content | {entry: "HERE"}).replace('"HERE"', value)
    refused(lambda: Design.from_json(text))


@pytest.mark.parametrize(
    "value", [None, 3, b"{}", ["{}"], {}, object()], ids=lambda value: type(value).__name__
)
def test_not_text(value):
    refused(lambda: Design.from_json(value), "`text`")
    refused(lambda: Design.from_text(value), "`text`")


def test_a_picture_is_not_json():
    refused(lambda: Design.from_json("\x89PNG\r\n\x1a\n" + "\x00" * 100), "is not JSON")


def test_unknown_and_missing_entries():
    refused(lambda: Design.from_json(altered(colour="red")), "no design has", "'colour'")
    refused(lambda: Design.from_json(altered(points=None)), '"points"', "incomplete")


WRONG = {
    "points": [3, "uv", True, {}, {"0": [0, 1], "1": [1, 1]}, [[0, 1]], [], [0, 1],
               [[0, 1, 2], [1, 1, 1]], [[0, 1], [1]], [["0", "1"], [1, 1]], [[None, 1], [1, 1]],
               [[True, False], [1, 1]], [[[0], [1]], [[1], [1]]], [[0, 1], "uv"],
               [[0, 1], {"a": 1, "b": 2}], [[0, 10**400], [1, 1]], [[0, 1], [2e100, 1]]],
    "ubar": [[], {}, True, ["u"]],
    "vbar": [[], {}, False],
    "closing": [0, 1, [], {}, "C3", "c1", "", True],
    "length": ["2", [], True, {}, 0, -1, 1e-7, 1e7],
    "samples": ["200", [], True, 7, 801, 100.5, 1e9],
    "base": [0, [], "", "middle", {}],
    "name": [3, [], {}, True, "x" * 201],
}  # fmt: skip


@pytest.mark.parametrize(("name", "value"), [(k, v) for k, vs in WRONG.items() for v in vs])
def test_wrong_types_and_ranges_name_the_entry(name, value):
    refused(lambda: Design.from_json(altered(**{name: value})), f"`{name}`")
    values = [value if entry == name else getattr(SIMPLE, entry) for entry in Design.__slots__]
    packed = base64.b64encode(zlib.compress(json.dumps(values).encode())).decode()
    refused(lambda: Design.from_text(PREFIX + packed), f"`{name}`")


HOSTILE = ["__import__('os').system('ls')", "u.__class__", "10**10**10", "(" * 1000, "u" * 5000,
           "lambda: 0", "", "u +", "[u for u in v]", "open('/etc/passwd')", "u\x00v"]  # fmt: skip


@pytest.mark.parametrize("formula", HOSTILE)
def test_hostile_formulas(formula):
    started = time.process_time()
    refused(lambda: Design.from_json(altered(vbar=formula)), "`vbar`")
    assert time.process_time() - started < 0.05


@pytest.mark.parametrize(("closing", "order"), [("C0", -1), ("C1", 0), ("C2", 1)])
def test_points_that_do_not_close_as_the_file_says(closing, order):
    ring = [(1.0, 1.0), (2.0, 1.0), (2.2, 2.0), (1.5, 2.5), (0.8, 2.0), (0.9, 1.4), (1.0, 1.1)]
    points = ring if order < 0 else close(ring, order).tolist()
    assert seam(points).order == order
    message = refused(
        lambda: Design.from_json(altered(points=points, closing=closing)), "`points`", closing
    )
    assert "closed_with" in message
    mended = Design(points).closed_with(closing)
    assert mended.closing == closing
    assert seam(mended.points).order >= CLOSINGS[closing]


# ---- bad short texts ----------------------------------------------------------------------------


def test_a_word_that_is_cut_anywhere():
    text = SIMPLE.to_text()
    for kept in range(len(text)):
        refused(lambda n=kept: Design.from_text(text[:n]), "`text`", "copy the whole")


@pytest.mark.parametrize("width", [3, 10, 20, 76])
@pytest.mark.parametrize("gap", ["\n", "\r\n", " ", "\n> ", "\n>> ", "\u200b", "\u00ad\n", "\t"])
def test_a_word_broken_by_a_chat(width, gap):
    text = SIMPLE.to_text()
    broken = gap.join(text[len(PREFIX) :][i : i + width] for i in range(0, len(text), width))
    assert Design.from_text(PREFIX + broken) == SIMPLE
    assert Design.from_text(f"See{gap}{PREFIX}{gap}{broken}{gap}and tell me") == SIMPLE


@pytest.mark.parametrize(
    "around",
    ["{}", "Look: {} nice and closed, isn't it", "({})", "`{}`", '"{}".', "<{}>", "*{}*",
     "{}, then", "a b\n\n{}\n\nc d", "the word that starts ruledlab1: is {}",
     "ruledlab1:eNo old one, better: {}", "{} or ruledlab1:eNo", "https://x.org/?d={}&q=1"],
)  # fmt: skip
def test_a_word_in_prose(around):
    assert Design.from_text(around.format(SIMPLE.to_text())) == SIMPLE


def test_of_two_words_the_first_whole_one_counts():
    other = SIMPLE.with_(length=3.0)
    assert Design.from_text(f"{SIMPLE.to_text()} {other.to_text()}") == SIMPLE
    assert Design.from_text(f"{SIMPLE.to_text()[:-4]} {other.to_text()}") == other


@given(st.data())
@settings(max_examples=300)
def test_a_damaged_letter_never_gives_another_design(data):
    text = SIMPLE.to_text()
    place = data.draw(st.integers(len(PREFIX), len(text) - 1))
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/ .-_é"
    letter = data.draw(st.sampled_from(letters))
    damaged = text[:place] + letter + text[place + 1 :]
    try:
        assert Design.from_text(damaged) == SIMPLE  # a few bits of the packing mean nothing
    except GeometryError as error:
        assert "\n" not in str(error)


@pytest.mark.parametrize("text", ["", "hello", "RULEDLAB1:eNo", "ruledlab2:eNoDAAAAAAE", "{}"])
def test_no_word_at_all(text):
    refused(lambda: Design.from_text(text), PREFIX, "got none")


def test_a_word_that_inflates_without_end_is_refused_at_once():
    bomb = base64.b64encode(zlib.compress(b"[" * 20_000_000, 9)).decode()
    assert len(bomb) < 100_000
    started = time.process_time()
    refused(lambda: Design.from_text(PREFIX + bomb), "damaged")
    assert time.process_time() - started < 0.2


def test_a_word_that_holds_something_else():
    for content in (b"[1, 2, 3]", b"{}", b'"u"', b"[]", b"\xff\xfe"):
        packed = base64.b64encode(zlib.compress(content)).decode()
        refused(lambda word=packed: Design.from_text(PREFIX + word), "`text`")


# ---- the value itself ---------------------------------------------------------------------------


def test_a_design_is_frozen_hashable_and_takes_arrays():
    array = np.array(SIMPLE.points)
    design = SIMPLE.with_(points=array)
    array[0] = 9.0
    assert design == SIMPLE
    assert hash(design) == hash(SIMPLE)
    with pytest.raises(AttributeError):
        design.length = 3.0
    assert all(type(x) is float for point in design.points for x in point)


def test_what_has_no_text_cannot_be_saved():
    for formula in (lambda u, v: u, field(lambda u, v: u), np.sin):
        refused(lambda f=formula: Design(SIMPLE.points, f), "`ubar`", "RuledSurface")


def test_typed_fields_and_numbers_keep_their_text():
    assert Design(SIMPLE.points, field("sin( u )"), 0.5).ubar == "sin( u )"
    assert Design(SIMPLE.points, "0", 3 * np.pi / 8).vbar == "3*pi/8"


def test_the_surface_is_that_of_its_entries():
    t = np.linspace(0.0, 1.0, 5)
    surface = SIMPLE.surface()
    assert np.array_equal(surface.curve(t), Bezier(SIMPLE.points)(t))
    assert (surface.ubar.text, surface.vbar.text) == (SIMPLE.ubar, SIMPLE.vbar)


def test_a_closing_out_of_reach_is_refused_with_the_remedy():
    refused(lambda: SIMPLE.closed_with("C2"), "degree")
    refused(lambda: SIMPLE.closed_with("C9"), "`closing`", "C9")
    assert SIMPLE.closed_with("open").points == SIMPLE.points
