"""The 3D view without a browser: what it sends, that it is finite, and that it cleans up."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ipywidgets.widgets import widget as registry

from ruledlab.lab import colouring, shaders, sight, textures
from ruledlab.lab import view3d as v3
from ruledlab.lab.palette import DARK, LIGHT
from ruledlab.lab.scene import Mark, Scene


def helicoid(count: int = 200, pitch: float = 0.5, **changes: object) -> Scene:
    t = np.linspace(0.0, 2.0 * np.pi, count)
    zero = np.zeros_like(t)
    direction = np.column_stack([np.cos(t), np.sin(t), zero])
    axis = np.column_stack([zero, zero, pitch * t])
    scene = Scene(
        t=t,
        chart=np.column_stack([t, zero + np.pi / 2]),
        control=np.array([[0.0, 1.5], [3.0, 1.5], [6.0, 1.5]]),
        control_directions=np.eye(3),
        direction=direction,
        direction_rate=np.column_stack([-np.sin(t), np.cos(t), zero]),
        base=axis,
        base_rate=np.column_stack([zero, zero, zero + pitch]),
        striction=axis,
        w=np.array([-1.0, 2.0]),
        curves={},
        gaps=(),
        colour=None,
        colour_label="",
        centre=np.array([0.0, 0.0, np.pi * pitch]),
        radius=2.5,
        closed=False,
        text="a helicoid",
    )
    return dataclasses.replace(scene, **changes)


def mark_at(scene: Scene, row: int) -> Mark:
    first, second = scene.direction[row], scene.direction_rate[row]
    frame = np.stack([first, second, np.cross(first, second)])
    return Mark(
        scene.t[row], scene.chart[row], scene.base[row], scene.striction[row], frame, {}, ""
    )


@pytest.fixture
def view():
    made = v3.SurfaceView()
    yield made
    made.close()


def synced(view: v3.SurfaceView) -> list[tuple[str, str]]:
    """Record (model, trait) of every change that would be sent."""
    sent: list[tuple[str, str]] = []
    for model in (view._carrier, *v3._reachable(view.widget)):
        model.observe(
            lambda change: (
                sent.append((type(change["owner"]).__name__, change["name"]))
                if change["name"] in change["owner"].keys
                else None
            )
        )
    return sent


def carried(view: v3.SurfaceView, name: str) -> np.ndarray:
    """Read what was sent last into one of the textures."""
    data = getattr(view._carrier, name)["data"]
    return np.frombuffer(data, dtype=np.float32).reshape(-1, 4)


# ---- the texture of the rulings


def decoded(data: np.ndarray, width: int) -> np.ndarray:
    """Read the bytes back by integer arithmetic: (T, W) codes."""
    numbers = data[shaders.ROWS :].swapaxes(0, 1).astype(np.int64)
    parts = np.stack([numbers & 255, (numbers >> 8) & 255, numbers >> 16], axis=-1)
    return parts.reshape(len(parts), -1)[:, :width]


def test_columns_hold_the_rulings_and_tell_their_number():
    scene = helicoid(130)
    data = textures.rulings_data(scene)
    assert data.dtype == np.float32
    assert data.shape == (shaders.ROWS, 160, 4)
    np.testing.assert_allclose(data[0, :130, :3], scene.base, atol=1e-6)
    np.testing.assert_allclose(data[4, :130, :3], scene.striction, atol=1e-6)
    # the shader's own placing, b + w x at the two ends that stand in the alpha channels
    for row, end in ((1, -1.0), (2, 2.0)):
        placed = data[0, :130, :3] + data[row, :130, 3:] * data[1, :130, :3]
        np.testing.assert_allclose(placed, scene.base + end * scene.direction, atol=1e-6)
    assert (data[3, :130, 3] == 130).all()
    assert (data[[0, 4], :130, 3] == 1).all()
    assert (data[:, 130:, :] == 0)[:5].all()


def test_control_points_are_told_from_empty_columns():
    data = textures.rulings_data(helicoid())
    np.testing.assert_array_equal(data[5, :3, :3], np.eye(3))
    assert data[5, :, 3].sum() == 3


def test_more_control_points_than_rulings_find_room():
    many = np.tile([1.0, 0.0, 0.0], (61, 1))
    data = textures.rulings_data(helicoid(50, control_directions=many))
    assert data.shape[1] >= 61
    assert data[5, :, 3].sum() == 61


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e300, 1e30, 1e9])
@pytest.mark.parametrize("where", ["base", "striction", "direction", "base_rate"])
def test_a_bad_row_is_a_hole_and_no_spike(where, bad):
    scene = helicoid()
    broken = getattr(scene, where).copy()
    broken[60:63, 1] = bad
    data = textures.rulings_data(dataclasses.replace(scene, **{where: broken}))
    assert np.isfinite(data).all()
    flag = 4 if where == "striction" else 0
    if where in ("base", "striction") or not np.isfinite(bad):
        assert (data[flag, 60:63, 3] == 0).all()
        assert (data[flag, 60:63, :3] == 0).all()
        assert data[flag, :200, 3].sum() == 197


def test_an_undefined_direction_leaves_the_spherical_image_open():
    scene = helicoid()
    direction = scene.direction.copy()
    direction[10] = np.nan
    data = textures.rulings_data(dataclasses.replace(scene, direction=direction))
    lengths = np.linalg.norm(data[1, :200, :3], axis=1)
    assert lengths[10] == 0
    np.testing.assert_allclose(np.delete(lengths, 10), 1.0, rtol=1e-6)


@pytest.mark.parametrize("radius", [0.0, -1.0, np.nan, np.inf])
def test_a_useless_radius_or_centre_is_survived(view, radius):
    view.draw(helicoid(radius=radius, centre=np.array([np.nan, 0.0, 0.0])))
    camera = view._camera
    assert np.isfinite([*camera.position, *camera.quaternion, camera.near, camera.far]).all()
    assert camera.far > camera.near > 0


# ---- the cursor


def test_the_cursor_carries_its_own_vectors():
    scene = helicoid()
    mark = mark_at(scene, 37)
    data = textures.mark_data(mark, (-1.0, 2.0), 0.7)
    np.testing.assert_allclose(data[0, 1:4, :3], mark.frame, atol=1e-6)
    np.testing.assert_allclose(data[0, 4, :3], mark.striction, atol=1e-6)
    assert (data[0, 1:5, 3] == 1).all()
    assert (data[0, 0, 3], data[0, 5, 0], data[0, 5, 1]) == (-1.0, np.float32(0.7), 2.0)


def test_undefined_arrows_are_hidden_and_the_ruling_stays():
    mark = mark_at(helicoid(), 5)
    frame = mark.frame.copy()
    frame[1:] = np.nan
    data = textures.mark_data(dataclasses.replace(mark, frame=frame), (0.0, 1.0), 1.0)
    assert np.isfinite(data).all()
    assert data[0, 1:5, 3].tolist() == [1, 0, 0, 1]


def test_without_a_base_there_is_no_moving_ruling():
    mark = dataclasses.replace(mark_at(helicoid(), 5), base=np.full(3, np.nan))
    assert textures.mark_data(mark, (0.0, 1.0), 1.0)[0, 1, 3] == 0


# ---- colour


def test_bytes_come_back_and_nan_is_zero():
    values = np.linspace(-1.0, 1.0, 50 * 13).reshape(50, 13)
    values[7, 4] = np.nan
    values[8, 12] = np.inf
    scene = helicoid(50, colour=values)
    scale = colouring.colour_scale(values)
    codes = decoded(textures.rulings_data(scene)[:, :50], 13)
    assert codes[7, 4] == codes[8, 12] == 0
    fine = codes > 0
    assert fine.sum() == values.size - 2
    back = scale.low + (codes[fine] - 1) / 254 * (scale.high - scale.low)
    assert np.abs(back - np.clip(values[fine], scale.low, scale.high)).max() < 0.004 * 2


def test_scale_is_diverging_only_when_both_signs_occur():
    both = colouring.colour_scale(np.linspace(-1.0, 3.0, 101))
    assert both.diverging
    assert both.low == -both.high
    for values in (np.linspace(0.0, 3.0, 101), -np.linspace(0.0, 3.0, 101)):
        scale = colouring.colour_scale(values)
        assert not scale.diverging
        assert scale.low == 0 or scale.high == 0


def test_one_steep_place_does_not_flatten_the_scale():
    values = np.linspace(0.0, 1.0, 1000)
    values[-3:] = 1e9
    scale = colouring.colour_scale(values)
    assert scale.high < 1.2
    assert scale.clipped_high
    assert not scale.clipped_low


numbers = st.floats(-1e6, 1e6, allow_subnormal=False)


@given(st.lists(st.one_of(numbers, st.just(math.nan)), min_size=1, max_size=40))
def test_scale_is_an_interval_that_holds_almost_all_values(values):
    array = np.array(values)
    scale = colouring.colour_scale(array)
    assert np.isfinite([scale.low, scale.high]).all()
    assert scale.low < scale.high
    finite = array[np.isfinite(array)]
    slack = 1e-5 * (scale.high - scale.low)
    inside = (finite >= scale.low - slack) & (finite <= scale.high + slack)
    assert (~inside).sum() <= 2
    assert scale.missing == (finite.size < array.size)
    if scale.diverging:
        assert scale.low == -scale.high


def luminance(colour: str) -> float:
    linear = (np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255) ** 2.2
    return float(linear @ (0.2126, 0.7152, 0.0722))


def test_colour_maps_read_without_hue():
    maps = colouring.SEQUENTIAL, colouring.DIVERGING_LIGHT, colouring.DIVERGING_DARK
    assert [len(colours) for colours in maps] == [7, 7, 7]
    light = [luminance(c) for c in colouring.SEQUENTIAL]
    assert (np.diff(light) > 0.01).all()
    for stops, sign in ((colouring.DIVERGING_LIGHT, 1), (colouring.DIVERGING_DARK, -1)):
        arms = sign * np.diff([luminance(c) for c in stops])
        assert (arms[:3] > 0).all()
        assert (arms[3:] < 0).all()


def test_legend_names_ends_and_undefined_values(view):
    values = np.linspace(-2.0, 1.0, 50 * 5).reshape(50, 5)
    values[0, 0] = np.nan
    scene = helicoid(50, colour=values, colour_label="H <1/m>")
    legend = view.legend_html(scene)
    assert "H &lt;1/m&gt;" in legend
    assert "−2" in legend
    assert "undefined" in legend
    assert "<span>0</span>" in legend
    assert view.legend_html(helicoid()) == ""


# ---- what a move costs


def test_a_move_changes_one_texture(view):
    view.draw(helicoid())
    sent = synced(view)
    view.draw(helicoid(pitch=0.6))
    assert sent == [("_Carrier", "rulings")]
    assert carried(view, "rulings").nbytes <= 20_000
    assert view._carrier.rulings["into"] == view._rulings.model_id


def test_rulings_and_cursor_travel_in_one_message(view):
    view.draw(helicoid())  # the first scene places the camera, and with it the cursor's arrows
    messages = []
    view._carrier.send_state = lambda key=None: messages.append(
        {*([key] if isinstance(key, str) else key)}
    )
    view.draw(helicoid(pitch=0.6), mark_at(helicoid(pitch=0.6), 60))
    assert messages == [{"rulings", "cursor"}]


def test_a_cursor_move_sends_less_than_a_hundred_bytes(view):
    scene = helicoid()
    view.draw(scene)
    sent = synced(view)
    view.draw_cursor(mark_at(scene, 60))
    assert sent == [("_Carrier", "cursor")]
    assert carried(view, "cursor").nbytes < 100


def test_drawing_the_same_scene_again_sends_nothing(view):
    view.draw(helicoid())
    sent = synced(view)
    view.draw(helicoid())
    assert sent == []


def test_a_coloured_move_is_still_one_texture(view):
    values = np.outer(np.sin(helicoid().t), np.linspace(-1, 1, 33))
    view.draw(helicoid(colour=values))
    sent = synced(view)
    view.draw(helicoid(pitch=0.6, colour=values[:, ::-1]))
    assert sent == [("_Carrier", "rulings")]


# ---- the camera


def test_values_never_move_the_camera(view):
    view.draw(helicoid())
    where = (view._camera.position, view._camera.quaternion, view._controls.target)
    view.draw(helicoid(pitch=5.0, radius=20.0, centre=np.ones(3)))
    assert (view._camera.position, view._camera.quaternion, view._controls.target) == where
    view.reset_view()
    assert view._controls.target == (1.0, 1.0, 1.0)
    assert view._camera.position != where[0]


def turned(quaternion: tuple[float, ...], vector: np.ndarray) -> np.ndarray:
    axis, angle = np.array(quaternion[:3]), quaternion[3]
    return vector + 2 * np.cross(axis, np.cross(axis, vector) + angle * vector)


@given(st.floats(-3.1, 3.1), st.floats(-1.4, 1.4))
def test_quaternion_looks_back_along_its_direction_with_z_upright(azimuth, elevation):
    flat = np.cos(elevation)
    away = np.array([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)])
    quaternion = sight.looking(3.0 * away)
    assert np.linalg.norm(quaternion) == pytest.approx(1)
    # a camera looks along its own −z; its x must lie level
    np.testing.assert_allclose(turned(quaternion, np.array([0, 0, -1.0])), -away, atol=1e-9)
    assert turned(quaternion, np.array([1.0, 0, 0]))[2] == pytest.approx(0, abs=1e-9)
    assert turned(quaternion, np.array([0, 1.0, 0]))[2] >= 0


@pytest.mark.parametrize("size", [(600, 430), (300, 600), (900, 300)])
def test_framing_keeps_the_whole_ball_in_sight(view, size):
    view.resize(*size)
    scene = helicoid(radius=3.0, centre=np.array([1.0, -2.0, 0.5]))
    view.draw(scene)
    distance = np.linalg.norm(np.array(view._camera.position) - scene.centre)
    half = np.tan(np.radians(view._camera.fov / 2)) * min(1.0, size[0] / size[1])
    assert np.arcsin(3.0 / distance) <= np.arctan(half) + 1e-9
    assert view._camera.aspect == pytest.approx(size[0] / size[1])
    assert (view._renderer.width, view._renderer.height) == size


# ---- sizes, themes, parts


def test_every_number_of_rulings_and_points_is_drawn(view):
    for count, controls in ((50, 2), (200, 7), (800, 61), (51, 3), (200, 7)):
        directions = np.tile([0.0, 0.0, 1.0], (controls, 1))
        view.draw(helicoid(count, control_directions=directions))
        places = view._meshes["surface"].geometry.attributes["place"].array
        # the shader takes the nearest ruling: every one must be met, in order
        met = np.unique(np.floor(places[:, 0] * np.float32(count - 1) + 0.5))
        np.testing.assert_array_equal(met, np.arange(count))
        numbers = view._meshes["controls"].geometry.attributes["number"].array
        assert numbers.max() + 1 >= controls
        for material in view._materials.values():
            if "rulings" in material.uniforms:
                assert material.uniforms["rulings"]["value"] is view._rulings
                rows, columns, _ = view._rulings.data.shape
                assert material.uniforms["extent"]["value"] == [columns, rows]
        assert view._carrier.rulings["into"] == view._rulings.model_id


def test_sweeping_the_number_of_rulings_keeps_few_models(view):
    view.draw(helicoid())
    before = len(registry._instances)
    for count in (*range(50, 801, 25), *range(800, 49, -25)):
        view.draw(helicoid(count))
    assert len(registry._instances) - before < 60


def test_one_texture_per_material_and_it_comes_last(view):
    view.draw(helicoid(300, colour=np.ones((300, 33))))
    view.set_theme(DARK)
    for name, material in view._materials.items():
        kinds = [isinstance(u["value"], v3.three.DataTexture) for u in material.uniforms.values()]
        assert sum(kinds) <= 1, name
        assert kinds[-1] or not any(kinds), name


def test_uniforms_are_those_the_programs_declare(view):
    for name, material in view._materials.items():
        source = material.vertexShader + material.fragmentShader
        declared = {
            line.split(";")[0].split()[-1]
            for line in source.splitlines()
            if line.startswith("uniform ")
        }
        assert set(material.uniforms) == declared, name


def test_attributes_are_those_the_programs_declare(view):
    for name, mesh in view._meshes.items():
        declared = {
            line.split(";")[0].split()[-1]
            for line in mesh.material.vertexShader.splitlines()
            if line.startswith("attribute ")
        }
        attributes = mesh.geometry.attributes
        assert set(attributes) - {"index"} == declared, name
        lengths = {len(attributes[key].array) for key in declared}
        assert len(lengths) == 1, name
        assert attributes["index"].array.max() < lengths.pop(), name
        assert mesh.frustumCulled is False, name


def test_theme_reaches_every_colour(view):
    view.set_theme(DARK)
    marks = view._materials["mark"].uniforms
    assert marks["cursorColour"]["value"] == DARK.cursor
    assert marks["secondColour"]["value"] == DARK.x2
    assert marks["thirdColour"]["value"] == DARK.x3
    assert view._materials["striction"].uniforms["colour"]["value"] == DARK.sigma
    left = {
        (name, key)
        for name, material in view._materials.items()
        for key, uniform in material.uniforms.items()
        if uniform["value"] in ("#000000", LIGHT.ink, LIGHT.cursor, LIGHT.surface, LIGHT.ruling)
    }
    assert left == set()
    assert view._renderer.clearOpacity == 0


def test_parts_can_be_hidden_one_by_one(view):
    view.show(rulings=False, frame=False)
    shown = {name: mesh.visible for name, mesh in view._meshes.items()}
    assert not shown["lattice"]
    assert not shown["mark"]
    assert not shown["mark hidden"]
    assert shown["surface"]
    assert shown["striction"]
    view.show(rulings=True)
    assert view._meshes["lattice"].visible
    assert not view._meshes["mark"].visible


def test_sphere_modes(view):
    view.sphere("off")
    assert not view._meshes["globe"].visible
    view.sphere("large")
    assert view._meshes["globe"].visible
    x, _, radius = view._materials["image"].uniforms["globe"]["value"]
    # the whole sphere lies in the right half, the surface is moved into the left one
    assert (x + 1) / 2 * 600 - radius >= 300
    assert (x + 1) / 2 * 600 + radius <= 600
    assert view._materials["surface"].uniforms["lens"]["value"][0] < 0
    view.sphere("inset")
    assert 2 * view._materials["image"].uniforms["globe"]["value"][2] == pytest.approx(0.3 * 430)
    assert view._materials["surface"].uniforms["lens"]["value"] == [0, 0, 1]
    view.sphere("only")
    x, y, radius = view._materials["image"].uniforms["globe"]["value"]
    assert (x, y) == (0, 0)
    assert radius < 430 / 2
    assert view._meshes["image"].visible
    with pytest.raises(ValueError, match=r"^`mode` must be 'inset'.* got 'tiny'$"):
        view.sphere("tiny")


def test_choosing_a_control_point_and_none(view):
    view.choose(2)
    assert view._materials["controls"].uniforms["chosen"]["value"] == 2
    view.choose(None)
    assert view._materials["controls"].uniforms["chosen"]["value"] == -1


def test_words_for_the_picture_are_escaped(view):
    view.describe('a "helicoid" <b>')
    assert 'aria-label="a &quot;helicoid&quot; &lt;b&gt;"' in view._words.value


# ---- leaving nothing behind


def test_close_closes_every_model():
    before = set(registry._instances)
    view = v3.SurfaceView()
    view.draw(helicoid())
    view.draw(helicoid(500, colour=np.ones((500, 33))))
    view.draw_cursor(mark_at(helicoid(), 3))
    assert len(set(registry._instances) - before) > 40
    view.close()
    assert set(registry._instances) == before
    view.close()


def test_two_views_share_nothing():
    first, second = v3.SurfaceView(), v3.SurfaceView()
    mine, others = ({id(w) for w in v3._reachable(v.widget)} for v in (first, second))
    assert not mine & others
    first.close()
    second.draw(helicoid())
    second.close()


@settings(max_examples=30)
@given(st.lists(st.floats(width=64), min_size=24, max_size=24), st.integers(0, 3))
def test_nothing_that_is_not_finite_is_ever_sent(values, where):
    noise = np.resize(np.array(values), (50, 3))
    name = ("base", "direction", "striction", "direction_rate")[where]
    data = textures.rulings_data(helicoid(50, **{name: noise}))
    assert np.isfinite(data).all()
