"""What lessons draw into space: the values, their packing, and the view that shows them."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from ipywidgets.widgets import widget as registry

from ruledlab.geometry import GeometryError
from ruledlab.geometry.gallery import GALLERY
from ruledlab.lab import Lab, example, shaders, sight
from ruledlab.lab import view3d as v3
from ruledlab.lab.glyphs import KNOWN, lettering
from ruledlab.lab.overlay import COLUMNS, Dot, Label, Overlay, Packed, Sheet, Stroke, ball, pack
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.scene import Scene

CORNER = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.0)])
LINE = CORNER[:2]
PATCH = np.stack(np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0, 2.0, 3.0], [0.0]), axis=-1)[:, :, 0]


def everything(shift: float = 0.0) -> Overlay:
    return Overlay(
        [Stroke(CORNER + shift, "kappa"), Stroke(LINE - shift, "tau", dashed=True, arrow=True)],
        [Dot(LINE[1] + shift, "delta"), Dot(LINE[0], "#102030", 14.0, ring=True)],
        [Sheet(PATCH + shift, "sigma")],
        [Label(LINE[1] + shift, "X₁", "ink")],
    )


# ---- values


def test_values_are_frozen_and_take_plain_lists():
    points = [[0, 0, 0], [1, 2, 3]]
    stroke = Stroke(points, "ink")
    points[0][0] = 7
    assert stroke.points[0, 0] == 0
    assert not stroke.points.flags.writeable
    assert Overlay(strokes=[stroke]).strokes == (stroke,)
    with pytest.raises(dataclasses.FrozenInstanceError):
        stroke.width = 3.0


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (
            lambda: Stroke(np.zeros((4, 2)), "ink"),
            r"^`points` must have shape \(N, 3\); got \(4, 2",
        ),
        (lambda: Stroke("abc", "ink"), "^`points` must be an array of numbers"),
        (lambda: Dot(LINE, "ink"), r"^`point` must have shape \(3,\); got \(2, 3\)"),
        (lambda: Sheet(LINE, "ink"), r"^`points` must have shape \(M, N, 3\)"),
        (lambda: Sheet(PATCH[:1], "ink"), r"M, N ≥ 2; got \(1, 3, 3\)"),
        (lambda: Label(LINE, "A", "ink"), r"^`point` must have shape"),
        (lambda: Label(LINE[0], 3, "ink"), "^`text` must be a string; got 3"),
        (
            lambda: Stroke(LINE, "red"),
            "^`colour` must be '#rrggbb' or one of chosen, .*; got 'red'",
        ),
        (lambda: Stroke(LINE, "#12345"), "got '#12345'"),
        (lambda: Stroke(LINE, "dark"), "got 'dark'"),
        (lambda: Dot(LINE[0], None), "got None"),
        (lambda: Stroke(LINE, "ink", width=0), "^`width` must be a positive number of pixels"),
        (lambda: Dot(LINE[0], "ink", size=math.nan), "^`size` must be finite"),
        (lambda: Sheet(PATCH, "ink", 1.5), "^`opacity` must lie between 0 and 1; got 1.5"),
        (lambda: Overlay(dots=[Stroke(LINE, "ink")]), "^`dots` must hold Dot values; got Stroke"),
    ],
)
def test_what_makes_no_sense_is_refused(make, says):
    with pytest.raises(GeometryError, match=says):
        make()


# ---- packing: read back from the layout that the module describes, as the programs do


class Reader:
    """Reads a texture as the programs do: from its numbers alone."""

    def __init__(self, packed: Packed, rows: int | None = None):
        self.texels = packed.texture(rows or packed.rows).reshape(-1, 4)
        self.head = self.texels[:4]

    def segments(self) -> list[tuple[int, np.ndarray, np.ndarray]]:
        """(stroke, from, to) of every segment that is drawn."""
        first, count = (int(n) for n in self.head[0, 1:3])
        points = self.texels[first : first + count]
        return [
            (int(a[3]), a[:3], b[:3])
            for a, b in itertools.pairwise(points)
            if a[3] > 0 and a[3] == b[3]
        ]

    def style(self, stroke: int) -> np.ndarray:
        return self.texels[int(self.head[0, 3]) + stroke - 1]

    def length(self, point: int) -> float:
        return float(self.texels[int(self.head[1, 0]) + point // 4, point % 4])

    def cells(self) -> list[int]:
        first, count = (int(n) for n in self.head[2, :2])
        return [k for k in range(count) if self.texels[first + k, 3] > 0]

    def ink(self) -> list[tuple[int, np.ndarray]]:
        _, first, count, _ = (int(n) for n in self.head[3])
        codes = self.texels[first : first + count]
        places = [[[n // 4096, n % 4096] for n in code[:2].astype(int)] for code in codes]
        ends = shaders.INK_START + shaders.INK_STEP * np.array(places).reshape(-1, 2, 2)
        return [(int(code[2]), end) for code, end in zip(codes, ends, strict=True)]


def rows_of(limit: int):
    number = st.one_of(st.floats(-1e3, 1e3, width=32), st.just(math.nan))
    shape = st.tuples(st.integers(0, limit), st.just(3))
    return arrays(np.float64, shape, elements=number, fill=st.just(1.5))


@settings(max_examples=60)
@given(st.lists(st.tuples(rows_of(7), st.booleans()), max_size=4))
def test_strokes_come_back_and_gaps_stay_gaps(lines):
    strokes = [Stroke(points, "ink", dashed=dashed) for points, dashed in lines]
    read = Reader(pack(Overlay(strokes), LIGHT))
    wanted = [
        (number, a, b)
        for number, (points, _) in enumerate(lines, 1)
        for a, b in itertools.pairwise(points)
        if np.isfinite([a, b]).all()
    ]
    assert len(read.segments()) == len(wanted)
    for (number, a, b), (i, c, d) in zip(wanted, read.segments(), strict=True):
        assert number == i
        np.testing.assert_array_equal([a, b], [c, d])
    assert [read.style(i)[2] for i in range(1, len(lines) + 1)] == [d for _, d in lines]


def test_lengths_run_on_over_gaps_and_begin_anew_with_each_stroke():
    gap = [math.nan] * 3
    path = np.array([(0, 0, 0), (3, 4, 0), gap, (9, 9, 9), (9, 9, 11)])
    read = Reader(pack(Overlay([Stroke(path, "ink"), Stroke(LINE, "ink")]), LIGHT))
    assert [read.length(k) for k in range(7)] == [0, 5, 5, 5, 7, 0, 1]


@pytest.mark.parametrize("tail", [[], [LINE[1]], [LINE[1], LINE[1]], [[math.nan] * 3]])
def test_the_last_two_points_of_an_arrow_give_a_direction(tail):
    points = np.vstack([CORNER[2], *LINE, *tail])
    read = Reader(pack(Overlay([Stroke(LINE, "tau"), Stroke(points, "ink", arrow=True)]), LIGHT))
    last = int(read.style(2)[3])
    texels = read.texels[4 + last - 1 : 4 + last + 1]
    np.testing.assert_array_equal(texels, np.column_stack([LINE, [2, 2]]))
    assert read.style(2)[2] == 2


@pytest.mark.parametrize("points", [np.zeros((0, 3)), LINE[:1], LINE[[0, 0]], [[math.nan] * 3]])
def test_a_stroke_of_no_length_has_no_head(points):
    overlay = Overlay([Stroke(LINE, "tau"), Stroke(points, "ink", arrow=True)])
    read = Reader(pack(overlay, LIGHT))
    last = int(read.style(2)[3])
    tail, tip = read.texels[4 + last - 1 : 4 + last + 1]
    # the program draws a head only where both points belong to the stroke
    assert not tip[3] == tail[3] == 2
    assert len(read.segments()) == 1


def test_cells_of_sheets_are_those_with_four_good_corners():
    holed = PATCH.copy()
    holed[1, 1] = np.nan  # touches four of the six cells
    read = Reader(pack(Overlay(sheets=[Sheet(PATCH, "ink"), Sheet(holed, "tau", 0.5)]), LIGHT))
    whole, rest = [k for k in read.cells() if k < 12], [k for k in read.cells() if k >= 12]
    assert whole == [0, 1, 3, 4, 6, 7]  # three columns: no cell begins in the last one
    assert rest == [12 + 6, 12 + 7]
    look, size = read.texels[int(read.head[2, 2]) + 2 :][:2]
    assert look[1:3].tolist() == [0.5, 12]
    assert size[:2].tolist() == [3, 4]


def test_labels_are_written_beside_their_points():
    labels = [Label(LINE[0], "κ̄", "kappa"), Label(LINE[1], "A₁", "#0a0b0c")]
    read = Reader(pack(Overlay(labels=labels), LIGHT))
    for number, label in enumerate(labels):
        ends = np.array([end for owner, end in read.ink() if owner == number])
        wanted = lettering(label.text).reshape(-1, 2, 2)
        shift = ends - wanted
        assert np.ptp(shift, axis=(0, 1)).max() <= shaders.INK_STEP
        assert (shift > 5).all()  # right of the point and above it
        place, look = read.texels[int(read.head[3, 0]) + 2 * number :][:2]
        np.testing.assert_array_equal(place, [*label.point, 1])
    assert look[0] == 0x0A0B0C


def test_colours_are_the_themes():
    overlay = Overlay([Stroke(LINE, "kappa")], [Dot(LINE[0], "x3")])
    for theme in (LIGHT, DARK):
        read = Reader(pack(overlay, theme))
        assert f"#{int(read.style(1)[0]):06x}" == theme.kappa
        assert f"#{int(read.texels[int(read.head[1, 1]) + 1, 0]):06x}" == theme.x3


@settings(max_examples=40)
@given(arrays(np.float64, (4, 3, 3), elements=st.floats(width=64)), st.booleans())
def test_only_finite_numbers_are_sent(points, arrow):
    overlay = Overlay(
        [Stroke(points.reshape(-1, 3), "ink", arrow=arrow)],
        [Dot(points[0, 0], "ink")],
        [Sheet(points, "ink")],
        [Label(points[1, 1], "A", "ink")],
    )
    packed = pack(overlay, LIGHT)
    assert packed.texels.dtype == np.float32
    assert np.isfinite(packed.texels).all()
    centre, radius = ball(overlay)
    assert np.isfinite([*centre, radius]).all()
    assert radius > 0


def test_a_texture_may_be_larger_than_needed_and_says_its_size():
    packed = pack(everything(), LIGHT)
    data = packed.texture(packed.rows + 3)
    assert data.shape == (packed.rows + 3, COLUMNS, 4)
    assert data[0, 0, 0] == packed.rows + 3
    np.testing.assert_array_equal(data.reshape(-1, 4)[1 : len(packed.texels)], packed.texels[1:])


def test_too_much_is_refused():
    stroke = Stroke(np.zeros((170_000, 3)), "ink")
    with pytest.raises(
        GeometryError, match=r"^`overlay` must need at most 163840 texels; it needs"
    ):
        pack(Overlay([stroke]), LIGHT)


def test_a_ball_holds_what_is_drawn():
    centre, radius = ball(everything(0.5))
    points = np.vstack([CORNER + 0.5, LINE - 0.5, (PATCH + 0.5).reshape(-1, 3), LINE[:1]])
    distance = np.linalg.norm(points - centre, axis=1)
    assert distance.max() == pytest.approx(radius)
    assert ball(Overlay()) == (pytest.approx(np.zeros(3)), 1.0)


# ---- letters


def test_every_letter_that_is_wanted_has_a_shape():
    wanted = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789κτσδλξΛαβγεθμπφω+−=()"
    assert set(wanted) <= set(KNOWN)
    shapes = {character: lettering(character).tobytes() for character in KNOWN}
    alike = {"Λ", "ν"}  # as V upside down and v are in print
    assert len({s for c, s in shapes.items() if c not in alike}) == len(KNOWN) - len(alike)
    box = lettering("中")
    assert all(s != box.tobytes() for s in shapes.values())


def test_indices_are_small_and_low_and_bars_stand_above():
    plain, low, high = (lettering(text)[:, 1::2] for text in ("2", "₂", "²"))
    assert np.ptp(low) == pytest.approx(np.ptp(high))
    assert np.ptp(low) < 0.8 * np.ptp(plain)
    assert low.min() < plain.min() < high.min()
    letter, barred = lettering("κ"), lettering("κ̄")
    np.testing.assert_array_equal(barred[: len(letter)], letter)
    assert barred[len(letter) :, 1::2].min() > letter[:, 1::2].max() + 1
    np.testing.assert_array_equal(lettering("ū"), lettering("u\u0304"))


@given(st.text(max_size=12))
def test_any_text_can_be_written(text):
    strokes = lettering(text)
    assert strokes.shape[1:] == (4,)
    assert np.isfinite(strokes).all()


@given(st.sampled_from(KNOWN), st.sampled_from(KNOWN))
def test_letters_follow_one_another_without_touching(first, second):
    both, alone = lettering(first + second), lettering(first)
    np.testing.assert_array_equal(both[: len(alone)], alone)
    assert both[len(alone) :, ::2].min() >= alone[:, ::2].max() + 1.5


# ---- the view


@pytest.fixture
def view():
    made = v3.SurfaceView()
    yield made
    made.close()


def synced(view: v3.SurfaceView) -> list[tuple[str, str]]:
    """Record (model, trait) of every change that would be sent."""
    sent: list[tuple[str, str]] = []

    def note(change):
        if change["name"] in change["owner"].keys:
            sent.append((type(change["owner"]).__name__, change["name"]))

    for model in (view._carrier, *v3._reachable(view.widget)):
        model.observe(note)
    return sent


def test_a_view_without_an_overlay_carries_nothing_of_it(view):
    before = set(registry._instances)
    view.overlay(Overlay())
    assert set(registry._instances) == before
    assert "strokes" not in view._materials


def test_a_move_is_one_texture_of_little_size(view):
    view.overlay(everything())
    sent = synced(view)
    view.overlay(everything(0.1))
    assert sent == [("_Carrier", "overlay")]
    assert len(view._carrier.overlay["data"]) < 3_000
    assert view._carrier.overlay["into"] == view._lying.model_id
    view.overlay(everything(0.1))
    assert len(sent) == 1


def test_counts_may_change_at_any_time(view):
    view.overlay(everything())
    for count in (3, 900, 40, 2, 4000, 0, 900):
        points = np.random.default_rng(count).normal(size=(count, 3))
        dots = [Dot(p, "ink") for p in points[: count // 50]]
        view.overlay(Overlay([Stroke(points, "kappa", arrow=True)], dots))
        for name in ("strokes", "strokes hidden", "dots", "sheets", "labels"):
            assert view._materials[name].uniforms["overlay"]["value"] is view._lying
        assert view._carrier.overlay["into"] == view._lying.model_id
        assert len(view._carrier.overlay["data"]) == view._lying.data.nbytes
        parts = view._meshes["strokes"].geometry.attributes["part"].array
        assert parts[parts[:, 1] == 0].max() >= count - 2
        assert view._meshes["dots"].geometry.attributes["number"].array.max() >= len(dots) - 1


def test_a_growing_overlay_leaves_few_models(view):
    view.overlay(everything())
    before = len(registry._instances)
    for count in (*range(2, 2000, 37), *range(2000, 2, -37)):
        view.overlay(Overlay([Stroke(np.zeros((count, 3)), "ink")]))
    assert len(registry._instances) - before < 60


def test_a_texture_that_fits_is_kept_and_none_is_much_too_large():
    for rows in (1, 5, 9, 100, 1000, 4096):
        made = v3._fitting(rows, 0)
        assert rows <= made <= max(1.25 * rows, rows + 1)
        assert v3._fitting(rows, made) == made
        assert v3._fitting(made + 1, made) > made
    assert v3._fitting(10, 4000) < 20


def test_programs_and_what_they_are_given_agree(view):
    view.overlay(everything())
    for name, material in view._materials.items():
        source = material.vertexShader + material.fragmentShader
        lines = [line.split(";")[0].split() for line in source.splitlines()]
        for kind, has in (
            ("uniform", set(material.uniforms)),
            ("attribute", set(view._meshes[name].geometry.attributes) - {"index"}),
        ):
            assert has == {words[-1] for words in lines if words[:1] == [kind]}, name
        textures = [
            isinstance(u["value"], v3.three.DataTexture) for u in material.uniforms.values()
        ]
        assert sum(textures) <= 1, name  # pythreejs confuses two, and one that is not the last
        assert textures[-1] or not any(textures), name


def test_everything_is_drawn_in_its_order_and_the_sphere_last(view):
    view.overlay(everything())
    order = {name: mesh.renderOrder for name, mesh in view._meshes.items()}
    assert order["strokes hidden"] < order["strokes"] < order["sheets"] < order["labels"]
    assert order["labels"] < min(order[name] for name in ("globe", "image", "controls", "needle"))
    assert view._materials["strokes hidden"].depthFunc == "GreaterDepth"
    assert set(view._meshes.values()) <= set(view._space.children)


def test_a_theme_changes_the_colours_of_an_overlay(view):
    view.overlay(Overlay([Stroke(LINE, "kappa"), Stroke(LINE, "#123456")]))
    view.set_theme(DARK)
    texels = np.frombuffer(view._carrier.overlay["data"], dtype=np.float32).reshape(-1, 4)
    first = int(texels[0, 3])
    assert [f"#{int(texels[first + k, 0]):06x}" for k in (0, 1)] == [DARK.kappa, "#123456"]
    assert view._materials["labels"].uniforms["casing"]["value"] == DARK.paper


def test_too_much_leaves_the_last_overlay(view):
    view.overlay(everything())
    before = view._carrier.overlay
    with pytest.raises(GeometryError):
        view.overlay(Overlay([Stroke(np.zeros((170_000, 3)), "ink")]))
    assert view._carrier.overlay is before
    view.set_theme(DARK)


def test_close_closes_all_of_it():
    before = set(registry._instances)
    made = v3.SurfaceView()
    made.overlay(everything())
    made.overlay(Overlay([Stroke(np.zeros((900, 3)), "ink")]))
    made.on_pick(lambda t, w: None)
    made.close()
    assert set(registry._instances) == before


# ---- the camera


def shown_at(view: v3.SurfaceView, points: np.ndarray) -> np.ndarray:
    """Where points are seen, both coordinates from −1 to 1 in the picture: a plain matrix way."""
    camera = view._camera
    x, y, z, w = camera.quaternion
    axes = np.array(
        [
            (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
            (2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
            (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)),
        ]
    )
    seen = (points - np.array(camera.position)) @ axes.T
    half = math.tan(math.radians(camera.fov / 2))
    return seen[:, :2] / (-seen[:, 2:] * half * np.array([camera.aspect, 1.0]))


def aims_at(view: v3.SurfaceView) -> np.ndarray:
    return np.array(view._controls.target)


def test_a_frame_is_looked_at_until_a_scene_is_drawn(view):
    view.frame((1.0, 2.0, 3.0), 0.5)
    where = view._camera.position
    view.overlay(everything())
    assert view._camera.position == where
    view._camera.position = (9.0, 9.0, 9.0)
    view.reset_view()
    assert view._camera.position == where
    np.testing.assert_array_equal(aims_at(view), (1.0, 2.0, 3.0))
    scene = Lab(example("hyperboloid")).result.scene
    view.draw(scene)
    np.testing.assert_allclose(aims_at(view), scene.centre)


def test_without_a_frame_the_first_overlay_is_brought_into_sight(view):
    view.overlay(everything(20.0))
    points = np.vstack([CORNER + 20.0, CORNER[:2] - 20.0])
    assert np.abs(shown_at(view, points)).max() < 1
    where = view._camera.position
    view.overlay(everything(30.0))
    assert view._camera.position == where
    view.reset_view()
    assert view._camera.position != where


@pytest.mark.parametrize(
    ("centre", "radius", "says"),
    [
        ((0, 0), 1.0, r"^`centre` must have shape \(3,\); got \(2,\)"),
        ((0, 0, math.nan), 1.0, "^`centre` must be finite"),
        ((0, 0, 0), 0.0, "^`radius` must be positive; got 0"),
        ((0, 0, 0), "wide", "^`radius` must be made of real numbers"),
    ],
)
def test_a_frame_that_is_no_ball_is_refused(view, centre, radius, says):
    before = view._camera.position
    with pytest.raises(GeometryError, match=says):
        view.frame(centre, radius)
    assert view._camera.position == before


def hyperboloid(count: int = 400, **changes: object) -> Scene:
    """Return x² + y² − z² = 1 with the waist as base."""
    t = np.linspace(0.0, 2 * np.pi, count)
    zero, one, root = 0 * t, 0 * t + 1, np.sqrt(0.5)
    waist = np.column_stack([np.cos(t), np.sin(t), zero])
    along = np.column_stack([-np.sin(t), np.cos(t), zero])
    scene = Scene(
        t=t,
        chart=np.zeros((count, 2)),
        control=np.zeros((0, 2)),
        control_directions=np.zeros((0, 3)),
        direction=root * (along + np.column_stack([zero, zero, one])),
        direction_rate=-root * waist,
        base=waist,
        base_rate=along,
        striction=waist,
        w=np.array([-1.5, 1.5]),
        curves={},
        gaps=(),
        colour=None,
        colour_label="",
        centre=np.zeros(3),
        radius=2.0,
        closed=True,
        text="",
    )
    return dataclasses.replace(scene, **changes)


@given(st.floats(-3.1, 3.1), st.floats(-0.3, 1.2), st.floats(0.01, 0.4))
def test_the_mean_ruling_neither_points_at_the_eye_nor_away(longitude, latitude, spread):
    turn = np.linspace(0, 2 * np.pi, 50, endpoint=False)
    axis = np.array([math.cos(longitude), math.sin(longitude), 0.0]) * math.cos(latitude)
    axis[2] = math.sin(latitude)
    first = np.array([-math.sin(longitude), math.cos(longitude), 0.0])
    second = np.cross(axis, first)
    around = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * second
    directions = axis + spread * around
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    azimuth = sight.azimuth_for(hyperboloid(50, direction=directions))
    assert math.cos(azimuth - longitude) == pytest.approx(math.cos(sight.ASIDE))
    assert sight.away(azimuth) @ axis > 0.15  # its image lies before the sphere


def test_without_a_mean_direction_the_usual_side_is_kept():
    assert sight.azimuth_for(hyperboloid()) == sight.AZIMUTH
    assert sight.azimuth_for(hyperboloid(direction=np.full((400, 3), np.nan))) == sight.AZIMUTH
    assert (
        sight.azimuth_for(hyperboloid(direction=np.tile([0.0, 0.0, 1.0], (400, 1))))
        == sight.AZIMUTH
    )


@pytest.mark.parametrize("item", GALLERY, ids=lambda item: item.key)
def test_every_surface_of_the_gallery_is_seen_whole_and_not_small(view, item):
    scene = Lab(example(item.key)).result.scene
    view.draw(scene)
    ends = np.concatenate([scene.base + w * scene.direction for w in scene.w])
    seen = np.abs(shown_at(view, ends[np.isfinite(ends).all(axis=1)]))
    assert np.quantile(seen, 0.99) < 1.0
    assert np.quantile(seen.max(axis=1), 0.98) > 0.5
    image = scene.direction[np.isfinite(scene.direction).all(axis=1)]
    eye = np.array(view._camera.position) - aims_at(view)
    assert (image @ eye > 0).mean() > 0.45


# ---- picking


@settings(max_examples=60)
@given(st.floats(-3.1, 3.1), st.floats(-1.2, 1.2), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_a_line_of_sight_meets_the_quadric_where_its_equation_says(azimuth, height, aside, up):
    scene, metric = hyperboloid(1500), np.diag([1.0, 1.0, -1.0])
    azimuth += 0.37  # not exactly upon the seam, where rounding decides
    eye = 6.0 * np.array([math.cos(azimuth), math.sin(azimuth), height])
    goal = np.array([-aside * math.sin(azimuth), aside * math.cos(azimuth), up])
    way = (goal - eye) / np.linalg.norm(goal - eye)
    roots = np.roots([way @ metric @ way, 2 * eye @ metric @ way, eye @ metric @ eye - 1])
    reach = 1.5 * math.sqrt(0.5)
    depths = sorted(r.real for r in roots if abs(r.imag) < 1e-9 and r.real > 0)
    heights = [eye[2] + depth * way[2] for depth in depths]
    if any(abs(abs(h) - reach) < 0.02 for h in heights) or np.ptp(roots) < 0.3:
        return  # at the rim, or grazing: rounding decides
    met = [depth for depth, h in zip(depths, heights, strict=True) if abs(h) < reach]
    place = sight.first_hit(scene, eye, way)
    assert (place is None) == (not met)
    if place is not None:
        t, w = place
        waist, along = (math.cos(t), math.sin(t), 0.0), (-math.sin(t), math.cos(t), 1.0)
        point = np.array(waist) + w * math.sqrt(0.5) * np.array(along)
        np.testing.assert_allclose(point, eye + met[0] * way, atol=2e-3)


def test_rulings_that_are_undefined_are_not_hit():
    scene = hyperboloid()
    base = scene.base.copy()
    base[:] = np.nan
    assert (
        sight.first_hit(dataclasses.replace(scene, base=base), np.array([6.0, 0, 0]), -CORNER[1])
        is None
    )


def test_what_lies_behind_the_eye_is_not_hit():
    eye, way = np.array([6.0, 0.5, 0.2]), np.array([1.0, 0.0, 0.0])
    assert sight.first_hit(hyperboloid(), eye, -way) is not None
    assert sight.first_hit(hyperboloid(), eye, way) is None


# ---- a hand on the surface


def held(key: str) -> tuple[Scene, sight.Eye]:
    """A surface of the gallery, w measured from the striction point, and who looks at it."""
    lab, view = Lab(example(key).with_(base="striction")), v3.SurfaceView(600, 400)
    view.draw(lab.result.scene, lab.mark)
    view.reset_view(lab.result.scene)
    eye = view.eye
    view.close()
    return lab.result.scene, eye


def pixel(scene: Scene, eye: sight.Eye, row: int, w: float) -> tuple[float, float]:
    return eye.seen(scene.base[row] + w * scene.direction[row])[:2]


@pytest.mark.parametrize("key", ["right_helicoid", "hyperboloid", "example_1", "example_2", "cone"])
@pytest.mark.parametrize("part", [0.15, 0.4, 0.85])
def test_a_hand_takes_the_place_under_the_pointer_on_its_own_sheet(key, part):
    scene, eye = held(key)
    row, w = int(part * (len(scene.t) - 1)), 0.4 * scene.w[1]
    x, y = pixel(scene, eye, row, w)
    start = (scene.t[row] - 0.01 * np.ptp(scene.t), w + 0.05)
    t, found = sight.follow(scene, eye, start, x, y)
    assert (t, found) == pytest.approx((scene.t[row], w), abs=2e-3 * np.ptp(scene.t))


@pytest.mark.parametrize(("key", "turn"), [("example_2", 1.0), ("moebius", -1.0)])
def test_a_hand_goes_over_the_seam(key, turn):
    scene, eye = held(key)
    w = 0.5 * scene.w[1]
    x, y = pixel(scene, eye, 3, turn * w)
    t, found = sight.follow(scene, eye, (float(scene.t[-3]), w), x, y)
    assert (t, found) == pytest.approx((scene.t[3], turn * w), abs=1e-3 * np.ptp(scene.t))
    x, y = pixel(scene, eye, -4, turn * w)
    t, found = sight.follow(scene, eye, (float(scene.t[2]), w), x, y)
    assert (t, found) == pytest.approx((scene.t[-4], turn * w), abs=1e-3 * np.ptp(scene.t))


def test_a_hand_stays_on_an_open_surface():
    scene, eye = held("right_helicoid")
    x, y = pixel(scene, eye, -1, float(scene.w[1]))
    t, w = sight.follow(scene, eye, (float(scene.t[-2]), float(scene.w[1])), x + 400, y + 5)
    assert scene.t[0] <= t <= scene.t[-1]
    assert scene.w[0] <= w <= scene.w[1]


def test_a_hand_passes_rulings_that_are_undefined():
    scene, eye = held("hyperboloid")
    base = scene.base.copy()
    base[50:52] = np.nan
    x, y = pixel(scene, eye, 54, 0.3)
    holed = dataclasses.replace(scene, base=base)
    t, w = sight.follow(holed, eye, (float(scene.t[48]), 0.3), x, y)
    assert (t, w) == pytest.approx((scene.t[54], 0.3), abs=2e-3 * np.ptp(scene.t))
    base[:] = np.nan
    assert sight.follow(dataclasses.replace(scene, base=base), eye, (0.0, 0.3), x, y) is None


def hits(eye, goal) -> list[dict[str, object]]:
    """Return what the page reports: where a line of sight meets the two far boxes."""
    eye, way = np.array(eye), (np.array(goal) - eye) / np.linalg.norm(np.array(goal) - eye)
    return [{"point": [*(eye + d * way)], "distance": d} for d in (5e5, 1e6)]


def click(view: v3.SurfaceView, pressed, released) -> None:
    view._press.picked = pressed
    view._release.picked = released


def test_a_click_tells_the_place_and_a_drag_nothing(view):
    view.draw(hyperboloid())
    places: list[tuple[float, float]] = []
    disconnect = view.on_pick(lambda t, w: places.append((t, w)))
    eye = np.array(view._camera.position)
    ray, other = hits(eye, (0.0, 0.0, 0.2)), hits(eye, (0.3, 0.0, 0.2))
    click(view, ray, ray)
    click(view, ray, ray)  # the same place again counts again
    assert len(places) == 2
    assert places[0] == places[1]
    click(view, other, ray)
    click(view, ray, [])
    click(view, hits(eye, (50.0, 0.0, 0.0)), hits(eye, (50.0, 0.0, 0.0)))
    assert len(places) == 2
    view.show(surface=False)
    click(view, ray, ray)
    view.show(surface=True)
    disconnect()
    disconnect()
    click(view, ray, ray)
    assert len(places) == 2


def test_the_inset_sphere_hides_what_lies_behind(view):
    view.draw(hyperboloid())
    eye, forward = np.array(view._camera.position), -np.array(view._camera.position)
    x, y, radius = view._globe
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward) / np.linalg.norm(forward)
    size = np.linalg.norm(forward) * math.tan(math.radians(view._camera.fov / 2))

    def way_to(place):
        return forward + size * (place[0] * view._camera.aspect * right + place[1] * up)

    assert view._aimed(way_to((x, y))) is None
    beside = way_to((x - 2.5 * radius / view._renderer.width, y))
    aimed = view._aimed(beside)
    np.testing.assert_allclose(np.cross(aimed, beside), 0.0, atol=1e-9)
    view.sphere("off")
    assert view._aimed(way_to((x, y))) is not None
    view.sphere("large")
    goal = np.array([0.4, 0.3, 0.5])
    shift, scale = view._lens[:2], view._lens[2]
    drawn = scale * shown_at(view, goal[None])[0] + shift  # where the shifted picture shows it
    aimed = view._aimed(way_to(drawn))
    np.testing.assert_allclose(np.cross(aimed, goal - eye), 0.0, atol=1e-9)
