"""Two lines as lesson 02 shows them: what follows from their position, the picture, the words."""

from __future__ import annotations

import itertools
import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.geometry import GeometryError
from ruledlab.lab.scenes.line_pair import (
    FAR,
    PRESETS,
    lines_html,
    pair_html,
    picture,
    relation_words,
    sight,
    words,
)
from ruledlab.pair import OneLine, TwoLines, between

longitude = st.floats(-6.3, 6.3)
colatitude = st.floats(0.0, math.pi)
coordinate = st.floats(-4, 4)
one_line = st.builds(OneLine, longitude, colatitude, coordinate, coordinate, coordinate)
two = st.builds(TwoLines, one_line, one_line)
few = settings(max_examples=60)


def strokes(pair, **shown):
    return {stroke.name: stroke.points for stroke in picture(pair, **shown).strokes}


def dots(pair, **shown):
    return {dot.name: dot.point for dot in picture(pair, **shown).dots}


# -- what follows ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PRESETS)
def test_every_position_is_what_it_is_called(name):
    pair = between(PRESETS[name])
    assert relation_words(pair).startswith(f"{name}.")
    assert pair.across.relation == name.split()[-1]
    if name.startswith("perpendicular"):
        assert abs(pair.a.direction @ pair.b.direction) < 1e-15


@few
@given(two)
def test_the_product_is_the_cosine_of_the_dual_angle(lines):
    pair = between(lines)
    angle, d = pair.across.angle, pair.across.distance
    assert pair.product.real == pytest.approx(math.cos(angle), abs=1e-12)
    assert pair.product.dual == pytest.approx(-d * math.sin(angle), abs=1e-10)


@few
@given(one_line)
def test_the_direction_has_its_angles_and_the_line_its_point(line):
    x = line.line.direction
    assert x[2] == pytest.approx(math.cos(line.v), abs=1e-12)
    assert complex(x[0], x[1]) == pytest.approx(
        math.sin(line.v) * complex(math.cos(line.u), math.sin(line.u)), abs=1e-12
    )
    point = np.array([line.x, line.y, line.z])
    np.testing.assert_allclose(line.line.moment, np.cross(point, x), atol=1e-12)


@few
@given(two)
def test_two_lines_are_kept_as_numbers_and_come_back(lines):
    kept = json.loads(json.dumps(lines.numbers, allow_nan=False))
    assert TwoLines.from_numbers(kept) == lines


@pytest.mark.parametrize(
    ("numbers", "says"),
    [
        ("ten numbers", "two lists .* of the type str"),
        ([[0, 0, 0, 0, 0]], "two lists"),
        ([[0, 0, 0, 0, 0], [0, 0, 0, 0]], "two lists"),
        ([[0, 0, 0, 0, 0], [0, 0, 0, 0, "1"]], "`z` of a line must be a number"),
        ([[True, 0, 0, 0, 0], [0, 0, 0, 0, 0]], "`u` of a line must be a number"),
        ([[0, 0, 0, 0, 0], [0, -0.1, 0, 0, 0]], "`v` of a line must lie between 0 and 3.142"),
        ([[0, 0, math.nan, 0, 0], [0, 0, 0, 0, 0]], "`x` of a line must lie between -4 and 4"),
        ([[0, 0, 0, 10**5000, 0], [0, 0, 0, 0, 0]], "`y` of a line must lie"),
    ],
)
def test_numbers_that_are_no_two_lines_are_refused(numbers, says):
    with pytest.raises(GeometryError, match=says):
        TwoLines.from_numbers(numbers)


@few
@given(one_line)
def test_a_reversed_line_has_both_parts_negative_and_stays_within_the_sliders(line):
    back = line.reversed()
    np.testing.assert_allclose(back.line.direction, -line.line.direction, atol=1e-12)
    np.testing.assert_allclose(back.line.moment, -line.line.moment, atol=1e-11)
    np.testing.assert_allclose(back.line.foot, line.line.foot, atol=1e-11)
    assert abs(back.u) <= 6.3
    assert 0.0 <= back.v <= math.pi


@few
@given(two)
def test_reversing_one_line_turns_the_angle_and_the_sign_of_d(lines):
    first, second = between(lines), between(replace(lines, b=lines.b.reversed()))
    if math.sin(first.across.angle) < 1e-3:
        return
    assert second.across.angle == pytest.approx(math.pi - first.across.angle, abs=1e-9)
    assert second.across.distance == pytest.approx(-first.across.distance, abs=1e-8)


@few
@given(one_line, st.tuples(coordinate, coordinate, coordinate))
def test_a_line_is_aimed_at_a_point_and_keeps_its_own(line, at):
    way = np.array(at) - line.point
    aimed = line.aimed(np.array(at))
    assert (aimed.x, aimed.y, aimed.z) == (line.x, line.y, line.z)
    if np.linalg.norm(way) > 0.1:  # u and v are rounded to 0.01
        cosine = aimed.line.direction @ way / np.linalg.norm(way)
        assert cosine > math.cos(0.0072)
    assert abs(aimed.u) <= 6.3
    assert 0.0 <= aimed.v <= math.pi


def test_the_longitude_goes_on_when_a_line_is_turned_round():
    line = OneLine(0.0, math.pi / 2, 0.0, 0.0, 0.0)
    for turn in np.linspace(0, 6.2, 63):
        line = line.aimed(np.array([math.cos(turn), math.sin(turn), 0.0]))
        assert line.u == pytest.approx(turn, abs=0.006)
    assert line.aimed(np.array([0.0, 0.0, 2.0])) == replace(line, v=0.0)
    assert line.aimed(line.point) == line


def test_what_is_drawn_fills_the_sight():
    axes = np.eye(3)
    for lines in PRESETS.values():
        overlay = picture(between(lines))
        centre, radius = sight(overlay, axes, 2.0)
        points = np.concatenate([s.points for s in overlay.strokes]) - centre
        across, up = np.nanmax(np.abs(points[:, :2]), axis=0)
        assert max(across / 2, up) <= radius
        assert radius < 1.6 * max(across / 2, up)


def test_the_given_points_stand_apart_from_the_feet():
    for name, lines in PRESETS.items():
        across = between(lines).across
        if name in ("skew", "parallel", "antiparallel"):
            for line, foot in ((lines.a, across.foot_a), (lines.b, across.foot_b)):
                assert np.linalg.norm(line.point - foot) > 0.3, name


def test_one_line_and_its_reverse_are_called_opposite():
    line = PRESETS["equal"].a
    pair = between(TwoLines(line, line.reversed()))
    assert relation_words(pair).startswith("opposite.")
    assert pair.across.distance == pytest.approx(0.0, abs=1e-15)


# -- the picture -----------------------------------------------------------------------------------


@few
@given(two)
def test_the_drawn_distance_is_the_shortest_way_between_the_drawn_lines(lines):
    pair = between(lines)
    drawn = strokes(pair)
    if "distance" not in drawn:
        return
    p, q = drawn["distance"]
    (a0, a1), (b0, b1) = drawn["line a"], drawn["line b"]
    if math.sin(pair.across.angle) > 0.02:  # by least squares, without any formula for feet
        system = np.stack([a1 - a0, -(b1 - b0)], axis=1)
        best = np.linalg.lstsq(system, b0 - a0, rcond=None)[0]
        assert np.all((best > 0) & (best < 1)), "both feet lie on what is drawn of the lines"
        least = np.linalg.norm(system @ best - (b0 - a0))
        assert np.linalg.norm(q - p) == pytest.approx(least, abs=1e-7)
    np.testing.assert_allclose(pair.a.distance_to(p), 0, atol=1e-7)
    np.testing.assert_allclose(pair.b.distance_to(q), 0, atol=1e-7)


@few
@given(two)
def test_nothing_is_drawn_far_outside_and_nothing_undefined(lines):
    overlay = picture(between(lines))
    points = [s.points for s in overlay.strokes] + [d.point[None] for d in overlay.dots]
    if between(lines).across.relation in ("equal", "opposite"):  # stripes have gaps
        points = [rows[np.isfinite(rows).all(axis=1)] for rows in points]
    assert np.isfinite(np.concatenate(points)).all()
    assert np.abs(np.concatenate(points)).max() < 4 * FAR
    assert "nan" not in words(between(lines))


@few
@given(two)
def test_the_angle_is_an_arc_of_the_unit_sphere_from_x_to_y(lines):
    pair = between(lines)
    arc = strokes(pair).get("angle")
    if arc is None:
        assert math.sin(pair.across.angle) < 1e-9
        return
    np.testing.assert_allclose(np.linalg.norm(arc, axis=1), 1, atol=1e-9)
    np.testing.assert_allclose(arc[[0, -1]], [pair.a.direction, pair.b.direction], atol=1e-9)
    length = np.linalg.norm(np.diff(arc, axis=0), axis=1).sum()
    assert length == pytest.approx(pair.across.angle, rel=1e-3)


def test_the_perpendicular_points_along_the_cross_product_also_where_d_is_negative():
    for lines in (PRESETS["skew"], replace(PRESETS["skew"], b=PRESETS["skew"].b.reversed())):
        pair = between(lines)
        start, end = strokes(pair)["perpendicular"]
        assert (end - start) @ np.cross(pair.a.direction, pair.b.direction) > 0
        p, q = strokes(pair)["distance"]
        along = (q - p) @ (end - start) / np.linalg.norm(end - start)
        assert along == pytest.approx(pair.across.distance, abs=1e-12)


def test_moments_and_sphere_are_drawn_when_wanted():
    pair = between(PRESETS["skew"])
    assert {"moment a", "moment b"} <= set(strokes(pair, moments=True))
    assert not {"moment a", "moment b"} & set(strokes(pair, moments=False))
    np.testing.assert_array_equal(strokes(pair)["moment b"][1], pair.b.moment)
    assert "direction a" in dots(pair, sphere=True)
    assert "direction a" not in dots(pair, sphere=False)
    assert not picture(pair, sphere=False).sheets


@pytest.mark.parametrize("name", ["equal", "parallel", "antiparallel"])
def test_special_positions_have_no_arc(name):
    assert "angle" not in strokes(between(PRESETS[name]))


@pytest.mark.parametrize("back", [False, True])
def test_one_line_twice_is_drawn_in_stripes_of_both_colours(back):
    line = PRESETS["equal"].a
    pair = between(TwoLines(line, line.reversed() if back else line))
    drawn, covered = strokes(pair), []
    for name in ("line a", "line b"):
        ends = drawn[name].reshape(-1, 3, 3)[:, :2]
        np.testing.assert_allclose(pair.a.distance_to(ends), 0, atol=1e-12)
        covered += np.sort((ends - pair.a.foot) @ pair.a.direction, axis=1).tolist()
    covered.sort()
    gaps = [later[0] - earlier[1] for earlier, later in itertools.pairwise(covered)]
    np.testing.assert_allclose(gaps, 0, atol=1e-12)  # no gap between stripes, none twice


def test_labels_at_one_place_are_written_as_one():
    labels = {label.text for label in picture(between(PRESETS["equal"])).labels}
    assert labels == {"A = B", "x = y", "x̄ = ȳ"}
    labels = {label.text for label in picture(between(PRESETS["parallel"])).labels}
    assert {"A", "B", "x = y", "x̄", "ȳ"} < labels
    assert len(labels) == 6  # and d


def test_line_a_is_seen_on_both_sides_of_line_b_where_they_coincide():
    widths = {stroke.name: stroke.width for stroke in picture(between(PRESETS["equal"])).strokes}
    assert widths["line a"] > widths["line b"] + 2
    assert widths["moment a"] > widths["moment b"] + 1


def test_one_line_twice_has_no_common_perpendicular_to_draw():
    drawn = strokes(between(PRESETS["equal"]))
    assert "perpendicular" not in drawn
    assert "distance" not in drawn


@pytest.mark.parametrize("name", ["parallel", "antiparallel"])
def test_of_the_many_perpendiculars_that_through_the_foot_point_of_a_is_drawn(name):
    pair = between(PRESETS[name])
    p, q = strokes(pair)["distance"]
    np.testing.assert_allclose(p, pair.a.foot, atol=1e-12)
    # by the moments: ‖ȳ ∓ x̄‖
    sign = 1 if name == "parallel" else -1
    apart = np.linalg.norm(pair.b.moment - sign * pair.a.moment)
    assert np.linalg.norm(q - p) == pytest.approx(apart, abs=1e-12)
    assert "no single common perpendicular" in words(pair)
    assert "has no sign" in words(pair)


def test_feet_that_are_too_far_away_are_not_drawn_and_it_is_said():
    lines = PRESETS["parallel"]
    pair = between(replace(lines, b=replace(lines.b, u=lines.b.u + 0.01)))
    assert pair.across.relation == "skew"
    assert "distance" not in strokes(pair)
    assert "too far to be drawn" in relation_words(pair)
    assert "too far" not in relation_words(between(lines))


# -- numbers and words -----------------------------------------------------------------------------


def test_the_words_hold_the_numbers():
    across = between(PRESETS["meeting"])
    said = words(across)
    for part in ("direction (1.000, 0.000, 0.000)", "moment (0.000, 1.000, 0.000)", "meeting"):
        assert part in said
    assert "(0.500, 0.000, 1.000) on A" in said


def test_no_number_is_minus_zero():
    for lines in PRESETS.values():
        pair = between(lines)
        for text in (words(pair), lines_html(pair), pair_html(pair)):
            assert not re.search(r"−0\.0+(?!\d)", text)


def test_the_sign_of_d_is_said_in_words():
    skew = PRESETS["skew"]
    assert "d is positive" in words(between(skew))
    assert "d is negative" in words(between(replace(skew, a=skew.a.reversed())))


def test_the_tables_have_names_and_units():
    pair = between(PRESETS["skew"])
    for part in ("direction", "moment", "foot point", "line A", "line B", "length"):
        assert part in lines_html(pair)
    for part in ("cos θ", "−d sin θ", "rad", "°", "<b>skew</b>", 'role="status"'):
        assert part in pair_html(pair)
