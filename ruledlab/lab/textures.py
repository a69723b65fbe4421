"""A scene and its cursor as textures: a column per ruling, a byte per scalar (see `shaders`)."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from ruledlab.geometry.checks import Array
from ruledlab.lab import shaders
from ruledlab.lab.colouring import Scale, colour_data, colour_scale
from ruledlab.lab.scene import Mark, Scene

__all__ = ["centre_of", "ends_of", "finite", "mark_data", "radius_of", "rulings_data"]

STEP: Final = 40  # textures are this many columns wide, or a multiple of it
FAR: Final = 100.0  # scene radii beyond which a ruling counts as undefined: it would be a spike


def finite(*arrays: Array) -> npt.NDArray[np.bool_]:
    """Tell which rows are finite in all of the arrays."""
    return np.asarray(np.all([np.isfinite(a).all(axis=-1) for a in arrays], axis=0))


def _kept(array: Array, valid: npt.NDArray[np.bool_], limit: float = 1e12) -> Array:
    """Return the array with invalid rows set to 0 and the others within what float32 holds."""
    return np.clip(np.where(valid[:, None], array, 0.0), -limit, limit)


def radius_of(scene: Scene) -> float:
    """Return the radius of the ball the picture is about; 1 where the scene has none."""
    radius = float(scene.radius)
    return radius if math.isfinite(radius) and radius > 0 else 1.0


def centre_of(scene: Scene) -> Array:
    """Return the middle of that ball; the origin where the scene has none."""
    centre = np.asarray(scene.centre, dtype=float)
    return centre if np.isfinite(centre).all() else np.zeros(3)


def near(points: Array, scene: Scene) -> npt.NDArray[np.bool_]:
    """Tell which points are finite and not absurdly far away."""
    with np.errstate(invalid="ignore", over="ignore"):
        distance = np.linalg.norm(points - centre_of(scene), axis=-1)
        return np.asarray(distance < FAR * radius_of(scene))


def ends_of(scene: Scene) -> tuple[float, float]:
    """Return the ends of the drawn rulings."""
    low, high = (float(end) if math.isfinite(end) else 0.0 for end in scene.w)
    return low, high


def texture_size(scene: Scene) -> tuple[int, int]:
    """Return rows and columns of a scene's texture: room for rulings, control points, scalars."""
    width = 0 if scene.colour is None else scene.colour.shape[1]
    count = max(len(scene.t), len(scene.control_directions))
    return shaders.ROWS - (-width // shaders.BYTES), STEP * -(-count // STEP)


def rulings_data(scene: Scene, scale: Scale | None = None) -> Array:
    """Return the texture of the rulings, (rows, columns, 4) float32, always finite."""
    count, controls = len(scene.t), len(scene.control_directions)
    data = np.zeros((*texture_size(scene), 4), dtype=np.float32)
    turning = finite(scene.direction)
    placed = turning & finite(scene.base_rate, scene.direction_rate) & near(scene.base, scene)
    striction = near(scene.striction, scene)
    chosen = finite(scene.control_directions)
    low, high = ends_of(scene)
    rows: tuple[tuple[Array, npt.NDArray[np.bool_], Any], ...] = (
        (scene.base, placed, placed),
        (scene.direction, turning, low),
        (scene.base_rate, placed, high),
        (scene.direction_rate, placed, count),
        (scene.striction, striction, striction),
    )
    for row, (vectors, valid, alpha) in enumerate(rows):
        data[row, :count, :3] = _kept(vectors, valid)
        data[row, :count, 3] = alpha
    data[5, :controls, :3] = _kept(scene.control_directions, chosen)
    data[5, :controls, 3] = chosen
    if scene.colour is not None:
        packed = colour_data(scene.colour, scale or colour_scale(scene.colour))
        data[shaders.ROWS :, :count] = packed.swapaxes(0, 1)
    return data


def mark_data(mark: Mark | None, ends: tuple[float, float], arrow: float) -> Array:
    """Return the texture of the cursor, (1, marks, 4) float32, always finite."""
    data = np.zeros((1, shaders.MARKS, 4), dtype=np.float32)
    data[0, 5, :2] = (arrow, ends[1])
    data[0, 0, 3] = ends[0]
    if mark is None:
        return data
    points = np.vstack([mark.base, mark.frame, mark.striction])
    valid = finite(points)
    data[0, :5, :3] = _kept(points, valid)
    data[0, 1:5, 3] = valid[1:]
    data[0, 1, 3] = valid[0] and valid[1]
    return data
