"""Where the camera stands, and what a line of sight meets first."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy import optimize

from ruledlab.geometry.checks import Array
from ruledlab.lab.scene import Scene
from ruledlab.lab.textures import centre_of, ends_of, finite, radius_of

__all__ = [
    "Eye",
    "away",
    "azimuth_for",
    "distance_to_see",
    "first_hit",
    "follow",
    "line_of_sight",
    "looking",
    "outline",
    "turned",
    "upright",
]

FIELD_OF_VIEW: Final = 34.0  # degrees
AZIMUTH: Final = math.radians(-58.0)
ELEVATION: Final = math.radians(24.0)
ASIDE: Final = math.radians(50.0)  # between the camera and the rulings' mean direction, from above
CLEARLY: Final = 1.05
LEVEL: Final = 0.2  # a mean direction with a smaller horizontal part says nothing about the azimuth
OUTLYING: Final = 1.8  # radii of a scene within which all ends of rulings are brought into sight
MARGIN: Final = 1.04
NEAREST: Final = 1e-6  # the least depth of what is seen


def upright(towards: Array) -> Array:
    """Return right, up and a unit vector towards the eye of who stands there upright, as rows."""
    right = np.cross((0.0, 0.0, 1.0), towards)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(towards, right), towards])


def looking(away: Array) -> tuple[float, ...]:
    """Quaternion of a camera that stands in the direction ``away`` and looks back, z upwards."""
    x, y, z = upright(away / np.linalg.norm(away))
    # four times the squares of the components; the largest is the safe one to divide by
    squares = np.array(
        [
            1 + x[0] - y[1] - z[2],
            1 - x[0] + y[1] - z[2],
            1 - x[0] - y[1] + z[2],
            1 + x[0] + y[1] + z[2],
        ]
    )
    products = np.array(
        [
            [squares[0], x[1] + y[0], z[0] + x[2], y[2] - z[1]],
            [x[1] + y[0], squares[1], y[2] + z[1], z[0] - x[2]],
            [z[0] + x[2], y[2] + z[1], squares[2], x[1] - y[0]],
            [y[2] - z[1], z[0] - x[2], x[1] - y[0], squares[3]],
        ]
    )
    row = products[int(np.argmax(squares))]
    return tuple(float(q) for q in row / np.linalg.norm(row))


def away(azimuth: float = AZIMUTH) -> Array:
    """Return the direction from what is looked at to the camera."""
    flat = math.cos(ELEVATION)
    return np.array([flat * math.cos(azimuth), flat * math.sin(azimuth), math.sin(ELEVATION)])


def azimuth_for(scene: Scene) -> float:
    """Choose the side to look from: the rulings across the picture, their image before the sphere.

    Two sides see the mean direction under the same angle: the one nearer the usual side is taken,
    unless the other sees clearly more of the surface. Without a mean direction, or with one near
    the axis, it is the usual side.
    """
    good = finite(scene.direction, scene.base_rate)
    mean = scene.direction[good].sum(axis=0) / max(good.sum(), 1)
    if math.hypot(mean[0], mean[1]) < LEVEL:
        return AZIMUTH
    facing = math.atan2(mean[1], mean[0])
    with np.errstate(over="ignore", invalid="ignore"):
        normals = np.cross(scene.base_rate[good], scene.direction[good])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        sides = sorted((facing - ASIDE, facing + ASIDE), key=lambda a: -math.cos(a - AZIMUTH))
        seen = [float(np.abs(normals @ away(side)).sum()) for side in sides]
    return sides[int(seen[1] > CLEARLY * seen[0])]


def outline(scene: Scene) -> Array:
    """Return the ends of the drawn rulings but for those far off, which may be cut."""
    good = finite(scene.base, scene.direction)
    ends = [scene.base[good] + end * scene.direction[good] for end in ends_of(scene)]
    points = np.concatenate(ends)
    with np.errstate(over="ignore"):
        distance = np.linalg.norm(points - centre_of(scene), axis=1)
        return points[distance < OUTLYING * radius_of(scene)]


def distance_to_see(points: Array, to: Array, wide: float, high: float) -> float:
    """Return how far a camera in the direction ``to`` must stand back to see the points.

    ``wide`` and ``high`` are the tangents of half the angles of sight.
    """
    right, up, _ = upright(to)
    beside = np.abs(points @ right) / wide
    above = np.abs(points @ up) / high
    return MARGIN * float(np.max(np.maximum(beside, above) + points @ to))


def turned(quaternion: Array, vector: Array) -> Array:
    """Turn a vector by a unit quaternion (x, y, z, w)."""
    axis = quaternion[:3]
    twist: Array = np.cross(axis, vector) + quaternion[3] * vector
    return vector + 2.0 * np.cross(axis, twist)


def line_of_sight(picked: list[dict[str, Any]]) -> tuple[Array, Array] | None:
    """Return the eye and the direction of a line of sight from the points it meets."""
    if len(picked) < 2:
        return None
    first, *_, last = sorted(picked, key=lambda hit: hit["distance"])
    way = np.subtract(last["point"], first["point"])
    way /= np.linalg.norm(way)
    return np.array(first["point"]) - first["distance"] * way, way


def first_hit(scene: Scene, eye: Array, way: Array) -> tuple[float, float] | None:
    """Return (t, w) of the place of the surface that is first met, or None.

    The sign of [b − eye, x, way] tells on which side of the line of sight a ruling passes; where
    it changes from one ruling to the next, the line goes through the surface.
    """
    way = way / np.linalg.norm(way)
    offset = scene.base - eye
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        side = np.einsum("ki,i->k", np.cross(offset, scene.direction), way)
        k = np.flatnonzero((side[:-1] < 0) != (side[1:] < 0))
        part = (side[k] / (side[k] - side[k + 1]))[:, None]
        q = offset[k] + part * (offset[k + 1] - offset[k])
        x = scene.direction[k] + part * (scene.direction[k + 1] - scene.direction[k])
        across = x - (x @ way)[:, None] * way
        w = -np.einsum("ki,ki->k", q, across) / np.einsum("ki,ki->k", across, across)
        depth = (q + w[:, None] * x) @ way
        t = scene.t[k] + part[:, 0] * (scene.t[k + 1] - scene.t[k])
    low, high = ends_of(scene)
    good = np.flatnonzero((w >= low) & (w <= high) & (depth > 0))
    if not len(good):
        return None
    nearest = good[np.argmin(depth[good])]
    return float(t[nearest]), float(w[nearest])


@dataclass(frozen=True, eq=False, slots=True)
class Eye:
    """A camera with a picture of ``size`` pixels.

    Attributes
    ----------
    position, quaternion
        where it stands, and the turn (x, y, z, w) that takes it there from looking along −z.
    size
        width and height of the picture.
    """

    position: Array
    quaternion: Array
    size: tuple[float, float]

    @property
    def _axes(self) -> Array:
        """Right, up and backwards, as rows."""
        return np.array([turned(self.quaternion, axis) for axis in np.eye(3)])

    @property
    def _scale(self) -> float:
        """Pixels for a unit of length at the depth 1."""
        return 0.5 * self.size[1] / math.tan(math.radians(FIELD_OF_VIEW / 2))

    def seen(self, point: Array) -> tuple[float, float, float]:
        """Return where a point is in the picture, from its upper left corner, and its depth."""
        right, up, back = self._axes @ (point - self.position)
        depth = max(-float(back), NEAREST)
        x, y = (self._scale * float(part) / depth for part in (right, up))
        return 0.5 * self.size[0] + x, 0.5 * self.size[1] - y, -float(back)

    def at(self, x: float, y: float, depth: float) -> Array:
        """Return the point of space at a place of the picture, in a given depth."""
        aside = (x - 0.5 * self.size[0], 0.5 * self.size[1] - y)
        place = np.array([*aside, -self._scale]) * depth / self._scale
        there: Array = self.position + place @ self._axes
        return there


# -- a hand on the surface -------------------------------------------------------------------------


def follow(
    scene: Scene, eye: Eye, start: tuple[float, float], x: float, y: float
) -> tuple[float, float] | None:
    """Return the (t, w) on the same sheet as ``start`` that is seen nearest to (x, y).

    Where several sheets lie behind each other, a hand stays on the one it holds. A closed surface
    is followed over its seam.

    Returns
    -------
    (t, w), or None where no two rulings are defined.
    """
    t, base, direction, turn = _wound(scene)
    if len(t) < 2:
        return None
    low, high = ends_of(scene)

    def off(place: Array) -> Array:
        b, d = (_between(place[0], t, rows) for rows in (base, direction))
        seen = eye.seen(b + place[1] * d)
        return np.array([seen[0] - x, seen[1] - y])

    begin = np.clip(start, (t[0], low), (t[-1], high))
    found = optimize.least_squares(
        off, begin, bounds=((t[0], low), (t[-1], high)), x_scale=(np.ptp(scene.t), high - low)
    )
    rounds = math.floor((found.x[0] - scene.t[0]) / np.ptp(scene.t)) if scene.closed else 0
    back = turn if rounds % 2 else 1.0
    return float(found.x[0] - rounds * np.ptp(scene.t)), float(back * found.x[1])


def _between(t: float, places: Array, rows: Array) -> Array:
    return np.array([np.interp(t, places, column) for column in rows.T])


def _wound(scene: Scene) -> tuple[Array, Array, Array, float]:
    """Return t, points and directions of the rulings, those of a closed surface three times round.

    The last value is −1 where the rulings come back reversed, else 1.
    """
    t, base, direction, turn = scene.t, scene.base, scene.direction, 1.0
    if scene.closed:
        turn = math.copysign(1.0, float(direction[0] @ direction[-1]))
        once, again = t[:-1], np.ptp(t)
        t = np.concatenate([once - again, once, t + again])
        base = np.concatenate([base[:-1], base[:-1], base])
        direction = np.concatenate([turn * direction[:-1], direction[:-1], turn * direction])
    good = finite(base, direction)
    return t[good], base[good], direction[good], turn
