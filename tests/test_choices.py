"""The menu of ū, v̄: every choice does what its meaning says."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from ruledlab.geometry.choices import CHOICES, Choice
from ruledlab.geometry.field import Field, field

PI = math.pi

MENU = {choice.key: choice for choice in CHOICES}
RNG = np.random.default_rng(7)
LONGITUDE = RNG.uniform(0, 2 * PI, 40)
COLATITUDE = RNG.uniform(0.2, 1.4, 40)
AXIS = np.array([0.0, 0.0, 1.0])


def _vector(*entries: object) -> np.ndarray:
    return np.stack(np.broadcast_arrays(*entries), axis=-1).astype(float)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.sum(a * b, axis=-1)


def _direction(u: object, v: object) -> np.ndarray:
    return _vector(np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v))


def _line(
    choice: Choice | tuple[str, str], u: object = LONGITUDE, v: object = COLATITUDE
) -> tuple[np.ndarray, np.ndarray]:
    """Return x and x̄ = ū x_u + v̄ x_v."""
    texts = (choice.ubar, choice.vbar) if isinstance(choice, Choice) else choice
    ubar, vbar = (np.asarray(field(text)(u, v))[..., None] for text in texts)
    x_u = _vector(-np.sin(u) * np.sin(v), np.cos(u) * np.sin(v), 0 * np.asarray(v))
    x_v = _vector(np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), -np.sin(v))
    return _direction(u, v), ubar * x_u + vbar * x_v


def _assert_through(line: tuple[np.ndarray, np.ndarray], point: object) -> None:
    """Check that x̄ = p × x."""
    assert_allclose(np.cross(point, line[0]), line[1], atol=1e-12)


def _foot(line: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    return np.cross(*line)


@pytest.mark.parametrize("choice", CHOICES, ids=lambda c: c.key)
def test_menu_entry_is_complete(choice: Choice) -> None:
    assert choice.meaning.endswith(".")
    assert choice.title
    assert np.isfinite(_line(choice)[1]).all()


def test_menu_keys_and_titles_are_distinct() -> None:
    assert len(MENU) == len({choice.title for choice in CHOICES}) == len(CHOICES)


@pytest.mark.parametrize("choice", CHOICES, ids=lambda c: c.key)
def test_ubar_is_the_height_and_vbar_the_length_of_the_common_perpendicular(choice: Choice) -> None:
    x, moment = _line(choice)
    foot = np.cross(x, moment)
    for k in range(len(x)):
        # nearest points z e_z and c + s x of the axis and the line, by least squares
        (z, s), *_ = np.linalg.lstsq(np.stack([AXIS, -x[k]], axis=1), foot[k], rcond=None)
        u, v = LONGITUDE[k], COLATITUDE[k]
        across = foot[k] + s * x[k] - z * AXIS
        assert z == pytest.approx(field(choice.ubar)(u, v), abs=1e-9)
        expected = field(choice.vbar)(u, v) * np.array([-np.sin(u), np.cos(u), 0])
        assert_allclose(across, expected, atol=1e-9)


@pytest.mark.parametrize(
    ("key", "apex"), [("origin", (0, 0, 0)), ("cone", (0, 0, 1)), ("bundle", (1, 0.8, 0.5))]
)
def test_cones_pass_through_their_apex(key: str, apex: tuple[float, ...]) -> None:
    _assert_through(_line(MENU[key]), apex)


def test_hyperboloid_lines_touch_the_sphere_at_its_equator_and_the_cylinder() -> None:
    foot = _foot(_line(MENU["hyperboloid"]))
    assert_allclose(np.linalg.norm(foot, axis=-1), 1)
    assert_allclose(foot[:, 2], 0, atol=1e-15)


def test_hyperboloid_for_constant_v() -> None:
    line = _line(MENU["hyperboloid"], LONGITUDE, 0.7)
    x, y, z = (_foot(line) + RNG.normal(size=(40, 1)) * line[0]).T
    assert_allclose(x**2 + y**2 - (z * np.tan(0.7)) ** 2, 1)


def test_sphere_lines_touch_it_turned_from_the_meridian() -> None:
    line = _line(MENU["sphere"])
    foot = _foot(line)
    assert_allclose(np.linalg.norm(foot, axis=-1), 1)
    meridian = _direction(LONGITUDE, COLATITUDE - PI / 2)
    assert_allclose(_dot(foot, meridian), np.cos(PI / 3))


def _screwed(points: np.ndarray, angle: float, pitch: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return points @ turn.T + pitch * angle * AXIS


@pytest.mark.parametrize("key", ["helicoid", "helix"])
def test_helicoidal_choices_are_carried_along_by_the_screw_motion(key: str) -> None:
    here, there = _line(MENU[key]), _line(MENU[key], LONGITUDE + 0.9)
    for s in (-1.0, 2.0):
        _assert_through(there, _screwed(_foot(here) + s * here[0], 0.9, 0.5))


def test_helicoid_lines_meet_the_axis() -> None:
    _assert_through(_line(MENU["helicoid"]), 0.5 * LONGITUDE[:, None] * AXIS)


def test_helix_lines_for_the_special_angle_are_its_tangents() -> None:
    u = np.linspace(-3, 3, 7)
    helix = _vector(np.sin(u), -np.cos(u), 0.5 * u)
    tangent = _vector(np.cos(u), np.sin(u), 0.5)  # its derivative
    line = _line(MENU["helix"], u, np.arctan(1 / 0.5))
    _assert_through(line, helix)
    assert_allclose(np.cross(line[0], tangent), 0, atol=1e-14)
    assert (_dot(line[0], tangent) > 0).all()


def test_helix_lines_touch_the_cylinder() -> None:
    point = _vector(np.sin(LONGITUDE), -np.cos(LONGITUDE), 0.5 * LONGITUDE)
    line = _line(MENU["helix"])
    _assert_through(line, point)
    assert_allclose(_dot(line[0], point * [1, 1, 0]), 0, atol=1e-14)


@pytest.mark.parametrize("ubar", ["0", "u - v", "sin(3*u)"])
def test_linear_complex_lines_are_normal_to_the_paths_of_the_screw_motion(ubar: str) -> None:
    line = _line((ubar, MENU["linear_complex"].vbar))
    for s in (-1.0, 0.0, 2.5):
        velocity = np.cross(AXIS, _foot(line) + s * line[0]) + 0.5 * AXIS
        assert_allclose(_dot(velocity, line[0]), 0, atol=1e-12)


def test_twist_has_exactly_one_line_through_every_point() -> None:
    k = 0.5
    for x, y, z in RNG.normal(size=(10, 3)):
        # A line through (a, b, 0) has the slope (b, −a)/k: one linear system, never singular.
        a, b = np.linalg.solve([[1, z / k], [-z / k, 1]], [x, y])
        u, v = np.arctan2(-a, b), np.arctan(np.hypot(a, b) / k)
        line = _line(MENU["twist"], u, v)
        _assert_through(line, [x, y, z])
        _assert_through(line, [a, b, 0])


def test_torus_normals_meet_the_axis_and_the_circle() -> None:
    line = _line(MENU["torus_normals"])
    _assert_through(line, _vector(np.cos(LONGITUDE), np.sin(LONGITUDE), 0))
    assert_allclose(_dot(line[1], AXIS), 0, atol=1e-15)


def test_ellipsoid_normals() -> None:
    line = _line(MENU["ellipsoid_normals"])
    squared = np.array([1.0, 1.0, 4.0])
    point = squared * line[0] / np.sqrt(_dot(squared, line[0] ** 2))[:, None]
    assert_allclose(_dot(point**2, 1 / squared), 1)
    _assert_through(line, point)


def test_saddle_normals_belong_to_the_support_function_xy() -> None:
    line = _line(MENU["saddle_normals"])
    x = line[0]
    support = x[:, 0] * x[:, 1]
    # The point of contact is the gradient of xy/r, which is homogeneous of degree one.
    point = x[:, [1, 0, 2]] * [1, 1, 0] - support[:, None] * x
    assert_allclose(_dot(point, x), support, atol=1e-15)
    _assert_through(line, point)


def test_conoid_is_that_of_pluecker() -> None:
    line = _line(MENU["conoid"], LONGITUDE, PI / 2)
    x, y, z = (_foot(line) + 1.7 * line[0]).T
    assert_allclose(z, 2 * x * y / (x**2 + y**2), atol=1e-12)


def _nearest_to_axis(choice: Choice) -> np.ndarray:
    line = _line(choice)
    foot = _foot(line)
    flat = np.array([1, 1, 0])
    s = -_dot(foot * flat, line[0]) / _dot(line[0] * flat, line[0])
    return foot + s[:, None] * line[0]


def test_coil_winds_five_times_round_the_torus() -> None:
    x, y, z = _nearest_to_axis(MENU["coil"]).T
    tube = (np.hypot(x, y) - 1) + 1j * z
    assert_allclose(np.abs(tube), 0.3)
    assert_allclose(tube, 0.3 * np.exp(5j * LONGITUDE), atol=1e-12)


def test_waves_stay_within_their_bounds() -> None:
    x, y, z = _nearest_to_axis(MENU["waves"]).T
    assert (np.abs(z) <= 0.2).all()
    assert_allclose(np.hypot(x, y), 1 + 0.2 * np.cos(6 * COLATITUDE))


def test_paper_choice() -> None:
    assert (MENU["paper"].ubar, MENU["paper"].vbar) == ("u - v", "u + v")


def test_choices_are_frozen() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        CHOICES[0].ubar = "1"  # type: ignore[misc]
    assert isinstance(field(CHOICES[0].ubar), Field)
