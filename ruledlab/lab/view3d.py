"""Draws a scene's surface with pythreejs, and is the only module that imports it.

What moves is sent as textures: one column per ruling (see `ruledlab.lab.shaders`), one byte per
scalar, one row for the cursor, and one texture for all that a lesson draws into space (see
`ruledlab.lab.overlay`). Meshes are built once for a number of rulings and never change.
No geometry is computed here; directions, striction points and scalars arrive in a `Scene`.
"""

from __future__ import annotations

import html
import math
import pathlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal, get_args

import anywidget
import ipywidgets
import numpy as np
import numpy.typing as npt
import pythreejs as three
import traitlets

from ruledlab.geometry.checks import GeometryError, finite_array
from ruledlab.lab import shaders
from ruledlab.lab.overlay import Overlay, Packed, ball, pack
from ruledlab.lab.palette import LIGHT, Theme
from ruledlab.lab.scene import Mark, Scene

Array = npt.NDArray[np.floating[Any]]
SphereMode = Literal["inset", "large", "only", "off"]

BANDS = 8  # strips between the two ends of a ruling; shading is computed at every pixel
FINE_BANDS = 32  # where a colour varies along the ruling: it is interpolated between vertices
STEP = 40  # textures are this many columns wide, or a multiple of it
LINES = 24  # gaps between the rulings drawn as lines
FAR = 100.0  # scene radii beyond which a ruling counts as undefined: no spike across the picture
FIELD_OF_VIEW = 34.0  # degrees
AZIMUTH, ELEVATION = math.radians(-58.0), math.radians(24.0)
ASIDE = math.radians(50.0)  # between the camera and the rulings' mean direction, seen from above
CLEARLY = 1.05
LEVEL = 0.2  # a mean direction with a smaller horizontal part says nothing about the azimuth
OUTLYING = 1.8  # radii of a scene within which all ends of rulings are brought into sight
MARGIN = 1.04
DASH = 0.055  # period of dashes, in radii of what is framed
FAINT = 0.3  # of lines behind the surface
FAR_BOXES = (2.0**20, 2.0**21)  # sides of boxes about everything, see `SurfaceView.on_pick`

SEQUENTIAL = ("#172a5a", "#1d4f83", "#26778f", "#449f92", "#86c285", "#d0dc7e", "#fdf3b0")
DIVERGING_LIGHT = ("#003f7d", "#2f86c8", "#a9d0ec", "#f4f2ee", "#f6bf85", "#d9711c", "#873a00")
DIVERGING_DARK = ("#8fd0ff", "#2f8fd6", "#16507f", "#2b2d31", "#7d420f", "#e07f28", "#ffc891")
MISSING = "#8b949e"

STYLE = """<style>
.ruledlab-view3d { max-width: 100%; overflow: hidden; }
.ruledlab-view3d .jupyter-threejs { max-width: 100%; }
.ruledlab-view3d canvas, .ruledlab-view3d .jupyter-threejs img {
  display: block; max-width: 100%; height: auto !important; touch-action: none; }
.ruledlab-view3d .ruledlab-words {
  position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.ruledlab-view3d > .widget-html { position: absolute; width: 0; height: 0; margin: 0; }
</style>"""
DRAWN = (
    *("surface", "lattice", "striction", "striction hidden", "strokes hidden", "dots hidden"),
    *("mark", "mark hidden", "strokes", "dots", "sheets", "labels"),
    *("globe", "image", "controls", "needle"),
)
WORDS = "3D view of the ruled surface. Drag to turn, wheel to zoom, right button to move."


# ---- arrays -------------------------------------------------------------------------------------


def _finite(*arrays: Array) -> npt.NDArray[np.bool_]:
    """Tell which rows are finite in all of the arrays."""
    return np.asarray(np.all([np.isfinite(a).all(axis=-1) for a in arrays], axis=0))


def _kept(array: Array, valid: npt.NDArray[np.bool_], limit: float = 1e12) -> Array:
    """Return the array with invalid rows set to 0 and the others within what float32 holds."""
    return np.clip(np.where(valid[:, None], array, 0.0), -limit, limit)


def _radius(scene: Scene) -> float:
    radius = float(scene.radius)
    return radius if math.isfinite(radius) and radius > 0 else 1.0


def _centre(scene: Scene) -> Array:
    centre = np.asarray(scene.centre, dtype=float)
    return centre if np.isfinite(centre).all() else np.zeros(3)


def _near(points: Array, scene: Scene) -> npt.NDArray[np.bool_]:
    """Tell which points are finite and not absurdly far away."""
    with np.errstate(invalid="ignore", over="ignore"):
        distance = np.linalg.norm(points - _centre(scene), axis=-1)
        return np.asarray(distance < FAR * _radius(scene))


def _ends(scene: Scene) -> tuple[float, float]:
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
    turning = _finite(scene.direction)
    placed = turning & _finite(scene.base_rate, scene.direction_rate) & _near(scene.base, scene)
    striction = _near(scene.striction, scene)
    chosen = _finite(scene.control_directions)
    low, high = _ends(scene)
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
    valid = _finite(points)
    data[0, :5, :3] = _kept(points, valid)
    data[0, 1:5, 3] = valid[1:]
    data[0, 1, 3] = valid[0] and valid[1]
    return data


@dataclass(frozen=True, slots=True)
class Scale:
    """What the ends of the colour bar mean.

    Attributes
    ----------
    low, high
        the ends; values beyond them have the end's colour.
    diverging
        whether the middle is 0 and the two signs have a hue each.
    clipped_low, clipped_high
        whether there are values beyond the end.
    missing
        whether there are undefined values.
    """

    low: float
    high: float
    diverging: bool
    clipped_low: bool
    clipped_high: bool
    missing: bool


def _rounded(value: float) -> float:
    """Round away from 0 to two digits, so that the scale does not tremble as values change."""
    if value == 0.0:
        return 0.0
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 1)
    return math.copysign(math.ceil(abs(value) / unit - 1e-9) * unit, value)


def _limits(low: float, high: float) -> tuple[float, float, bool]:
    if low < 0.0 < high:
        end = _rounded(max(-low, high))
        return -end, end, True
    if low == high == 0.0:
        return -1.0, 1.0, True
    if high - low > 0.5 * max(abs(low), abs(high)):
        return min(_rounded(low), 0.0), max(_rounded(high), 0.0), False
    # nearly constant: neither blow rounding errors up nor hide what little it varies
    spare = 0.1 * max(abs(low), abs(high)) + 0.25 * (high - low)
    step = 10.0 ** math.floor(math.log10(spare))
    return math.floor((low - spare) / step) * step, math.ceil((high + spare) / step) * step, False


def colour_scale(values: Array) -> Scale:
    """Choose the colour scale of an array of scalars; NaN and ±∞ count as undefined.

    A hundredth of the values at either end may lie beyond the scale, so that one steep place does
    not turn the rest of the surface grey.
    """
    finite = values[np.isfinite(values)]
    missing = finite.size < values.size
    if not finite.size:
        return Scale(-1.0, 1.0, True, False, False, missing)
    low, high, diverging = _limits(*(float(q) for q in np.quantile(finite, (0.01, 0.99))))
    slack = 1e-6 * (high - low)
    return Scale(
        low,
        high,
        diverging,
        bool(finite.min() < low - slack),
        bool(finite.max() > high + slack),
        missing,
    )


def colour_data(values: Array, scale: Scale) -> Array:
    """Return the scalars packed for the texture, (T, cells, 4) float32: three bytes a number."""
    count, width = values.shape
    codes = np.zeros((count, shaders.BYTES * -(-width // shaders.BYTES)))
    valid = np.isfinite(values)
    part = (np.where(valid, values, scale.low) - scale.low) / (scale.high - scale.low)
    codes[:, :width] = np.where(valid, np.floor(1.5 + 254.0 * np.clip(part, 0.0, 1.0)), 0.0)
    packed: Array = codes.reshape(count, -1, 4, 3) @ np.array([1.0, 256.0, 65536.0])
    return packed.astype(np.float32)


def _rgb(colour: str) -> tuple[int, ...]:
    return tuple(int(colour[i : i + 2], 16) for i in (1, 3, 5))


def _stops(diverging: bool, theme: Theme) -> tuple[str, ...]:
    if not diverging:
        return SEQUENTIAL
    return DIVERGING_DARK if theme.dark else DIVERGING_LIGHT


# ---- meshes -------------------------------------------------------------------------------------

CORNERS = np.array([(0, -1), (0, 1), (1, 1), (1, -1)], dtype=np.float32)
SQUARE = np.array([(-1, -1), (-1, 1), (1, 1), (1, -1)], dtype=np.float32)
CELL = np.array([(0, 0), (0, 1), (1, 1), (1, 0)], dtype=np.float32)


def _geometry(index: Array, **attributes: Array) -> three.BufferGeometry:
    made = {name: three.BufferAttribute(np.float32(a)) for name, a in attributes.items()}
    made["index"] = three.BufferAttribute(index.astype(np.uint32).ravel())
    return three.BufferGeometry(attributes=made)


def _quads(count: int) -> Array:
    """Index of ``count`` separate quads."""
    return np.asarray(4 * np.arange(count)[:, None] + np.array([0, 1, 2, 0, 2, 3]))


def _sheet(count: int, bands: int) -> three.BufferGeometry:
    """Return the surface: (fraction along t, fraction along the ruling) at every vertex."""
    t, w = np.meshgrid(np.linspace(0, 1, count), np.linspace(0, 1, bands + 1), indexing="ij")
    first = np.add.outer(np.arange(count - 1) * (bands + 1), np.arange(bands)).ravel()
    across = np.array([0, bands + 1, bands + 2, 0, bands + 2, 1])
    return _geometry(first[:, None] + across, place=np.stack([t, w], axis=-1).reshape(-1, 2))


def _strips(start: Array, finish: Array) -> three.BufferGeometry:
    """One ribbon per segment from ``start`` to ``finish``, both (n, 2)."""
    count = len(start)
    return _geometry(
        _quads(count),
        start=np.repeat(start, 4, axis=0),
        finish=np.repeat(finish, 4, axis=0),
        corner=np.tile(CORNERS, (count, 1)),
    )


def _along(count: int, w: float) -> tuple[Array, Array]:
    """Return the segments between neighbouring rulings at one fraction of them."""
    places = np.column_stack([np.linspace(0, 1, count), np.full(count, w)])
    return places[:-1], places[1:]


def _lattice(count: int) -> three.BufferGeometry:
    """Return some rulings and the two ends of all of them."""
    t = np.unique(np.linspace(0, count - 1, LINES + 1).round()) / (count - 1)
    rulings = (np.column_stack([t, 0 * t]), np.column_stack([t, 0 * t + 1]))
    parts = [rulings, _along(count, 0.0), _along(count, 1.0)]
    return _strips(*(np.concatenate(ends) for ends in zip(*parts, strict=True)))


def _parts(parts: Iterable[tuple[int, int]], boxes: Iterable[Array]) -> three.BufferGeometry:
    part = np.repeat(np.array(list(parts), dtype=float), 4, axis=0)
    return _geometry(_quads(len(part) // 4), part=part, corner=np.concatenate(list(boxes)))


def _marks() -> three.BufferGeometry:
    """Return the cursor: its ruling, the striction point, and the frame with heads and letters."""
    line, head, disc, label = 0, 1, 2, 3
    parts = [(0, line), *((i, kind) for i in (1, 2, 3) for kind in (line, head)), (4, disc)]
    parts += [(i, label) for i in (1, 2, 3)]
    return _parts(parts, (SQUARE if kind >= disc else CORNERS for _, kind in parts))


def _numbered(capacity: int, box: Array = SQUARE) -> three.BufferGeometry:
    """Return numbered squares, for control points, dots or the cells of sheets."""
    number = np.repeat(np.arange(float(capacity)), 4)
    return _geometry(_quads(capacity), number=number, corner=np.tile(box, (capacity, 1)))


def _two_kinds(first: int, second: int) -> three.BufferGeometry:
    """Return numbered ribbons of kind 0, then of kind 1, which are drawn after them."""
    numbers = np.concatenate([np.arange(first), np.arange(second)])
    kinds = np.repeat([0, 1], [first, second])
    part = np.repeat(np.column_stack([numbers, kinds]), 4, axis=0)
    count = first + second
    return _geometry(_quads(count), part=part, corner=np.tile(CORNERS, (count, 1)))


def _needle() -> three.BufferGeometry:
    """Return the cursor's stub and point on the sphere."""
    return _parts([(shaders.STUB_KIND, 0), (shaders.DOT_KIND, 0)], [CORNERS, SQUARE])


def _square() -> three.BufferGeometry:
    return _geometry(_quads(1), corner=SQUARE)


def _texture(data: Array) -> three.DataTexture:
    return three.DataTexture(data=data, type="FloatType")


class _Carrier(anywidget.AnyWidget):
    """Carries data into textures, all that belong together in one message; see ``textures.js``.

    Each trait holds the model of a texture (``into``) and all of its data as float32.
    """

    _esm = pathlib.Path(__file__).parent / "static" / "textures.js"

    renderer = traitlets.Unicode().tag(sync=True)
    rulings = traitlets.Dict().tag(sync=True)
    cursor = traitlets.Dict().tag(sync=True)
    overlay = traitlets.Dict().tag(sync=True)


def _freight(texture: three.DataTexture, data: Array) -> dict[str, Any]:
    return {"into": texture.model_id, "data": np.float32(data).tobytes()}


def _doubled(count: int) -> int:
    """Return the power of two that has room for so many."""
    return 1 << max(count - 1, 0).bit_length()


def _fitting(rows: int, now: int) -> int:
    """Return the size of a texture with room for so many rows: the present one, if it is good."""
    if rows <= now <= 2 * rows + 4:
        return now
    step = 1 << max(rows.bit_length() - 3, 0)  # at most a quarter too large, and few sizes in all
    return -(-rows // step) * step


def _uniforms(**values: Any) -> dict[str, dict[str, Any]]:
    return {name: {"value": list(v) if isinstance(v, tuple) else v} for name, v in values.items()}


def _assign(material: three.ShaderMaterial, values: dict[str, Any]) -> None:
    """Change those uniforms the material has; one message, or none if nothing differs.

    The order of the names stays: the texture has to be the last.
    """
    mine = {name: value for name, value in values.items() if name in material.uniforms}
    material.uniforms = {**material.uniforms, **_uniforms(**mine)}


def _mesh(geometry: three.BufferGeometry, material: Any, order: int, **options: Any) -> three.Mesh:
    return three.Mesh(
        geometry=geometry, material=material, frustumCulled=False, renderOrder=order, **options
    )


def _reachable(root: ipywidgets.Widget) -> list[ipywidgets.Widget]:
    """Return the widget and all that hang on it: what has to be closed with it."""
    found: dict[int, ipywidgets.Widget] = {}

    def visit(value: Any) -> None:
        if isinstance(value, ipywidgets.Widget):
            if id(value) not in found:
                found[id(value)] = value
                visit([getattr(value, name) for name in value.keys])
        elif isinstance(value, dict):
            visit(list(value.values()))
        elif isinstance(value, list | tuple):
            for item in value:
                visit(item)

    visit(root)
    return list(found.values())


def _close(root: ipywidgets.Widget) -> None:
    for widget in _reachable(root):
        widget.close()


# ---- camera -------------------------------------------------------------------------------------


def _looking(away: Array) -> tuple[float, ...]:
    """Quaternion of a camera that stands in the direction ``away`` and looks back, z upwards."""
    z = away / np.linalg.norm(away)
    x = np.cross((0.0, 0.0, 1.0), z)
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
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


def _away(azimuth: float = AZIMUTH) -> Array:
    flat = math.cos(ELEVATION)
    return np.array([flat * math.cos(azimuth), flat * math.sin(azimuth), math.sin(ELEVATION)])


def _azimuth(scene: Scene) -> float:
    """Choose the side to look from: the rulings across the picture, their image before the sphere.

    Two sides see the mean direction under the same angle: the one nearer the usual side is taken,
    unless the other sees clearly more of the surface. Without a mean direction, or with one near
    the axis, it is the usual side.
    """
    good = _finite(scene.direction, scene.base_rate)
    mean = scene.direction[good].sum(axis=0) / max(good.sum(), 1)
    if math.hypot(mean[0], mean[1]) < LEVEL:
        return AZIMUTH
    facing = math.atan2(mean[1], mean[0])
    with np.errstate(over="ignore", invalid="ignore"):
        normals = np.cross(scene.base_rate[good], scene.direction[good])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        sides = sorted((facing - ASIDE, facing + ASIDE), key=lambda a: -math.cos(a - AZIMUTH))
        seen = [float(np.abs(normals @ _away(side)).sum()) for side in sides]
    return sides[int(seen[1] > CLEARLY * seen[0])]


def _outline(scene: Scene) -> Array:
    """Return the ends of the drawn rulings but for those far off, which may be cut."""
    good = _finite(scene.base, scene.direction)
    ends = [scene.base[good] + end * scene.direction[good] for end in _ends(scene)]
    points = np.concatenate(ends)
    with np.errstate(over="ignore"):
        return points[np.linalg.norm(points - _centre(scene), axis=1) < OUTLYING * _radius(scene)]


def _distance(points: Array, to: Array, wide: float, high: float) -> float:
    """Return how far a camera in the direction ``to`` must stand back to see the points.

    ``wide`` and ``high`` are the tangents of half the angles of sight.
    """
    right = np.cross((0.0, 0.0, 1.0), to)
    right /= np.linalg.norm(right)
    beside = np.abs(points @ right) / wide
    above = np.abs(points @ np.cross(to, right)) / high
    return MARGIN * float(np.max(np.maximum(beside, above) + points @ to))


def _turned(quaternion: Array, vector: Array) -> Array:
    """Turn a vector by a unit quaternion (x, y, z, w)."""
    axis = quaternion[:3]
    twist: Array = np.cross(axis, vector) + quaternion[3] * vector
    return vector + 2.0 * np.cross(axis, twist)


# ---- picking ------------------------------------------------------------------------------------


def _sight(picked: list[dict[str, Any]]) -> tuple[Array, Array] | None:
    """Return the eye and the direction of a line of sight from the points it meets."""
    if len(picked) < 2:
        return None
    first, *_, last = sorted(picked, key=lambda hit: hit["distance"])
    way = np.subtract(last["point"], first["point"])
    way /= np.linalg.norm(way)
    return np.array(first["point"]) - first["distance"] * way, way


def _first_hit(scene: Scene, eye: Array, way: Array) -> tuple[float, float] | None:
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
    low, high = _ends(scene)
    good = np.flatnonzero((w >= low) & (w <= high) & (depth > 0))
    if not len(good):
        return None
    nearest = good[np.argmin(depth[good])]
    return float(t[nearest]), float(w[nearest])


# ---- the view -----------------------------------------------------------------------------------


class SurfaceView:
    """A ruled surface, its striction curve, the moving frame and the unit sphere, in one canvas.

    The sphere is turned as the surface is, so a ruling and its point on the sphere point the same
    way. Lines hidden by the surface shine through faintly.

    Parameters
    ----------
    width, height
        size in pixels; on a narrow page the picture shrinks and keeps its proportions.
    theme
        colours.
    antialias
        smooth outlines by multisampling. Lines are smooth without it, and where the browser has
        no graphics processor it doubles the time of a picture.

    Attributes
    ----------
    widget
        the ipywidgets Box to display.
    """

    def __init__(
        self, width: int = 600, height: int = 430, theme: Theme = LIGHT, antialias: bool = False
    ) -> None:
        self._theme = theme
        self._scene: Scene | None = None
        self._scale: Scale | None = None
        self._mark: Mark | None = None
        self._arrow, self._period = 0.3, 0.1
        self._overlay = Overlay()
        self._lying: three.DataTexture | None = None  # of the overlay, once there is one
        self._room = (64, 8, 16, 64, 64)
        self._framed: tuple[Array, float] | None = None
        self._unplaced = True  # whether the camera still waits for something to look at
        self._listeners: list[Callable[[float, float], object]] = []
        self._mode: SphereMode = "inset"
        self._shown = {"surface": True, "rulings": True, "striction": True, "frame": True}
        self._make_textures()
        self._make_materials()
        self._make_meshes()
        self._make_renderer(width, height, antialias)
        self._restyle()

    # ---- construction

    def _make_textures(self) -> None:
        self._pool: dict[tuple[Any, ...], Any] = {}
        self._rulings = _texture(np.zeros((shaders.ROWS, 5 * STEP, 4), dtype=np.float32))
        self._pool["rulings", *self._rulings.data.shape] = self._rulings
        self._cursor = _texture(mark_data(None, (0.0, 0.0), 0.0))

    def _kept(self, key: tuple[Any, ...], make: Callable[[], Any]) -> Any:
        """Return the model made for this size, now or before.

        Models of sizes no longer used are kept until `close`: the page resolves references to
        models late, and one that is closed too soon leaves the canvas empty for good.
        """
        if key not in self._pool:
            self._pool[key] = make()
        return self._pool[key]

    def _material(self, vertex: str, fragment: str, **uniforms: Any) -> three.ShaderMaterial:
        known = {"viewport": (600.0, 430.0), "lens": (0.0, 0.0, 1.0), "globe": (0.0, 0.0, 60.0)}
        known |= {"extent": (5.0 * STEP, float(shaders.ROWS))}
        known |= {"rulings": self._rulings, "mark": self._cursor, "overlay": self._lying}
        used = {name: value for name, value in known.items() if f" {name};" in vertex + fragment}
        return three.ShaderMaterial(
            vertexShader=vertex,
            fragmentShader=fragment,
            uniforms=_uniforms(**uniforms, **used),
            side="DoubleSide",
            lights=False,
            fog=False,
        )

    def _make_materials(self) -> None:
        self._materials: dict[str, three.ShaderMaterial] = {
            "surface": self._material(
                shaders.SURFACE_VERTEX,
                shaders.SURFACE_FRAGMENT,
                pull=0.0,
                scalars=0.0,
                **{f"stop{i}": colour for i, colour in enumerate(SEQUENTIAL)},
                gloss=0.12,
                frontColour="#ffffff",
                backColour="#ffffff",
                missingColour=MISSING,
            ),
            "lattice": self._line(shaders.LATTICE_VERTEX, 1.2, 1.2, 0.6, 0.0024, cap=0.0),
            "striction": self._line(shaders.STRICTION_VERTEX, 3.0, 2.0, 1.0, 0.004, cap=0.8),
            "striction hidden": self._line(shaders.STRICTION_VERTEX, 1.5, 1.5, 0.4, 0.004, cap=0.0),
            "mark": self._marker(1.0),
            "mark hidden": self._marker(0.3),
            "globe": self._globe_material(),
            "image": self._image_material(),
            "controls": self._controls_material(),
            "needle": self._needle_material(),
        }
        self._set_depths(self._materials)

    def _set_depths(self, materials: dict[str, three.ShaderMaterial]) -> None:
        solid = {"striction", "mark", "image", "controls", "needle", "strokes", "dots"}
        for name, material in materials.items():
            if name != "surface":
                material.transparent = True
                material.depthWrite = name in solid
            if name.endswith("hidden"):
                material.depthFunc = "GreaterDepth"
            if name in {"globe", "labels"}:
                material.depthTest = False

    def _line(
        self, vertex: str, half: float, core: float, strength: float, pull: float, cap: float
    ) -> three.ShaderMaterial:
        return self._material(
            vertex,
            shaders.LINE_FRAGMENT,
            width=(half, core),
            cap=cap,
            pull=pull,
            strength=strength,
            colour="#000000",
            casing="#ffffff",
        )

    def _marker(self, strength: float) -> three.ShaderMaterial:
        names = ("cursorColour", "secondColour", "thirdColour", "pointColour", "casing")
        return self._material(
            shaders.MARK_VERTEX,
            shaders.MARK_FRAGMENT,
            pull=0.006,
            strength=strength,
            **dict.fromkeys(names, "#000000"),
        )

    def _globe_material(self) -> three.ShaderMaterial:
        colours = dict.fromkeys(("fill", "gridColour", "ink"), "#000000")
        return self._material(shaders.GLOBE_VERTEX, shaders.GLOBE_FRAGMENT, **colours)

    def _image_material(self) -> three.ShaderMaterial:
        colours = dict.fromkeys(("colour", "fill"), "#000000")
        return self._material(
            shaders.IMAGE_VERTEX, shaders.IMAGE_FRAGMENT, width=(1.9, 1.9), **colours
        )

    def _controls_material(self) -> three.ShaderMaterial:
        colours = dict.fromkeys(("fill", "casing", "ink", "chosenColour"), "#000000")
        return self._material(
            shaders.CONTROLS_VERTEX, shaders.CONTROLS_FRAGMENT, chosen=-1.0, **colours
        )

    def _needle_material(self) -> three.ShaderMaterial:
        colours = dict.fromkeys(("fill", "casing", "cursorColour"), "#000000")
        return self._material(shaders.NEEDLE_VERTEX, shaders.NEEDLE_FRAGMENT, **colours)

    def _overlay_materials(self) -> dict[str, three.ShaderMaterial]:
        s, black = shaders, "#000000"
        strokes, dots = (s.STROKES_VERTEX, s.STROKES_FRAGMENT), (s.DOTS_VERTEX, s.DOTS_FRAGMENT)
        clear = {"casing": black, "strength": 1.0}
        faint = {"casing": black, "strength": FAINT}
        line = {"period": 0.1, "pull": 0.004}
        return {
            "strokes hidden": self._material(*strokes, rim=0.0, **line, **faint),
            "strokes": self._material(*strokes, rim=1.0, **line, **clear),
            "dots hidden": self._material(*dots, pull=0.007, **faint),
            "dots": self._material(*dots, pull=0.007, **clear),
            "sheets": self._material(s.SHEETS_VERTEX, s.SHEETS_FRAGMENT, pull=0.0025),
            "labels": self._material(s.LABELS_VERTEX, s.LABELS_FRAGMENT, pull=0.007, casing=black),
        }

    def _overlay_shapes(self) -> dict[str, three.BufferGeometry]:
        """Return the geometries of the overlay for the numbers there is room for."""
        points, strokes, dots, cells, letters = self._room
        line = self._kept(("strokes", points, strokes), lambda: _two_kinds(points, strokes))
        dot = self._kept(("controls", dots), lambda: _numbered(dots))
        return {
            "strokes hidden": line,
            "strokes": line,
            "dots hidden": dot,
            "dots": dot,
            "sheets": self._kept(("sheets", cells), lambda: _numbered(cells, CELL)),
            "labels": self._kept(("labels", letters), lambda: _two_kinds(letters, letters)),
        }

    def _shapes(
        self, count: int, controls: int, bands: int = BANDS
    ) -> dict[str, three.BufferGeometry]:
        """Return the geometries that depend on how much there is to draw."""
        rows = 100 << max(0, math.ceil(math.log2(max(count, 1) / 100)))
        places = 8 << max(0, math.ceil(math.log2(max(controls, 1) / 8)))
        curve = self._kept(("curve", rows), lambda: _strips(*_along(rows, 0.0)))
        return {
            "surface": self._kept(("surface", rows, bands), lambda: _sheet(rows, bands)),
            "lattice": self._kept(("lattice", rows), lambda: _lattice(rows)),
            "striction": curve,
            "striction hidden": curve,
            "image": curve,
            "controls": self._kept(("controls", places), lambda: _numbered(places)),
        }

    def _make_meshes(self) -> None:
        marks = _marks()
        shapes = self._shapes(5 * STEP, 8) | {"mark": marks, "mark hidden": marks}
        shapes |= {"globe": _square(), "needle": _needle()}
        self._meshes = {
            name: _mesh(shapes[name], material, DRAWN.index(name))
            for name, material in self._materials.items()
        }

    def _make_renderer(self, width: int, height: int, antialias: bool) -> None:
        self._camera = three.PerspectiveCamera(
            fov=FIELD_OF_VIEW, aspect=width / height, up=(0.0, 0.0, 1.0), position=(3.0, -5.0, 3.0)
        )
        self._controls = three.OrbitControls(controlling=self._camera)
        self._space = three.Scene(children=[*self._meshes.values()], background=None)
        self._renderer = three.Renderer(
            scene=self._space,
            camera=self._camera,
            controls=[self._controls],
            width=width,
            height=height,
            alpha=True,
            antialias=antialias,
            clearOpacity=0.0,
            background_opacity=0.0,
        )
        self._carrier = _Carrier(renderer=self._renderer.model_id)
        self._words = ipywidgets.HTML(STYLE)
        self.widget = ipywidgets.Box([self._renderer, self._words])
        self.widget.add_class("ruledlab-view3d")
        self.widget.layout.max_width = "100%"
        self.describe(WORDS)

    # ---- what is drawn

    def draw(self, scene: Scene, mark: Mark | None = None) -> None:
        """Show a scene, and the mark too if it moves; only the first scene moves the camera."""
        first, self._scene, self._mark = self._scene is None, scene, mark or self._mark
        self._scale = None if scene.colour is None else colour_scale(scene.colour)
        data = rulings_data(scene, self._scale)
        rulings = self._kept(("rulings", *data.shape), lambda: _texture(data))
        with self._carrier.hold_sync():
            self._carrier.rulings = _freight(rulings, data)
            self._send_mark()
        self._use(rulings)
        bands = BANDS if scene.colour is None or scene.colour.shape[1] == 1 else FINE_BANDS
        shapes = self._shapes(len(scene.t), len(scene.control_directions), bands)
        for name, shape in shapes.items():
            self._meshes[name].geometry = shape
        _assign(self._materials["surface"], self._colouring())
        if first:
            self.reset_view(scene)

    def draw_cursor(self, mark: Mark) -> None:
        """Show the moving ruling and its frame; what is undefined in it is hidden."""
        self._mark = mark
        self._send_mark()

    def choose(self, index: int | None) -> None:
        """Mark a control point on the sphere, or none."""
        _assign(self._materials["controls"], {"chosen": -1.0 if index is None else float(index)})

    def overlay(self, overlay: Overlay) -> None:
        """Draw strokes, dots, sheets and labels into space, in place of those drawn before.

        Lines and dots behind the surface shine through faintly; labels are always seen. Without a
        scene and before `frame` the first overlay that is not empty is brought into sight.

        Parameters
        ----------
        overlay
            what to draw; an empty `Overlay` removes all.

        Raises
        ------
        GeometryError
            if it is more than a texture holds; what was drawn before stays.
        """
        packed = pack(overlay, self._theme)
        self._overlay = overlay
        if self._lying is not None or any(packed.counts):
            self._lay(packed)
        if self._unplaced and any(packed.counts):
            self.reset_view()

    def _lay(self, packed: Packed) -> None:
        """Send an overlay; the first one brings its materials and meshes with it."""
        before = self._lying
        data = packed.texture(_fitting(packed.rows, 0 if before is None else len(before.data)))
        self._lying = self._kept(("overlay", len(data)), lambda: _texture(data))
        self._carrier.overlay = _freight(self._lying, data)
        rooms = zip(self._room, packed.counts, strict=True)
        self._room = tuple(max(room, _doubled(count)) for room, count in rooms)
        if before is None:
            self._bring_overlay()
        for name, shape in self._overlay_shapes().items():
            self._meshes[name].geometry = shape
        if self._lying is not before:
            self._everywhere(overlay=self._lying)

    def _bring_overlay(self) -> None:
        materials, shapes = self._overlay_materials(), self._overlay_shapes()
        self._set_depths(materials)
        self._materials |= materials
        self._restyle()
        self._everywhere(period=self._period)
        self._meshes |= {
            name: _mesh(shapes[name], material, DRAWN.index(name))
            for name, material in materials.items()
        }
        self._space.children = [*self._meshes.values()]

    def _send_mark(self) -> None:
        ends = (0.0, 0.0) if self._scene is None else _ends(self._scene)
        data = mark_data(self._mark, ends, self._arrow)
        self._carrier.cursor = _freight(self._cursor, data)

    def _use(self, rulings: three.DataTexture) -> None:
        """Draw from this texture; its data are there already, so no frame shows old ones."""
        if rulings is self._rulings:
            return
        self._rulings = rulings
        rows, columns, _ = rulings.data.shape
        self._everywhere(rulings=rulings, extent=(float(columns), float(rows)))

    def _colouring(self) -> dict[str, Any]:
        """Return the uniforms that colour the surface."""
        if self._scene is None or self._scene.colour is None or self._scale is None:
            return {"scalars": 0.0}
        stops = {f"stop{i}": c for i, c in enumerate(_stops(self._scale.diverging, self._theme))}
        return {"scalars": float(self._scene.colour.shape[1]), **stops}

    def _everywhere(self, **values: Any) -> None:
        for material in self._materials.values():
            _assign(material, values)

    # ---- how it is drawn

    def set_theme(self, theme: Theme) -> None:
        """Change all colours; the background stays transparent."""
        self._theme = theme
        self._restyle()
        if self._lying is not None:
            self._lay(pack(self._overlay, theme))

    def _restyle(self) -> None:
        theme = self._theme
        self._everywhere(
            cursorColour=theme.cursor,
            secondColour=theme.x2,
            thirdColour=theme.x3,
            pointColour=theme.sigma,
            casing=theme.paper,
            chosenColour=theme.chosen,
            ink=theme.ink,
            gridColour=theme.faint,
            fill=_mixed(theme.paper, theme.surface, 0.22),
            frontColour=theme.surface,
            backColour=_mixed(theme.surface, "#a9825f", 0.55),
            missingColour=MISSING,
        )
        _assign(self._materials["lattice"], {"colour": theme.ruling, "casing": theme.ruling})
        for name in ("striction", "striction hidden"):
            _assign(self._materials[name], {"colour": theme.sigma})
        _assign(self._materials["image"], {"colour": theme.ink})
        _assign(self._materials["surface"], self._colouring())
        self._place_sphere()

    def show(
        self,
        *,
        surface: bool | None = None,
        rulings: bool | None = None,
        striction: bool | None = None,
        frame: bool | None = None,
    ) -> None:
        """Show or hide parts of the picture; ``None`` leaves a part as it is."""
        wanted = {"surface": surface, "rulings": rulings, "striction": striction, "frame": frame}
        self._shown |= {name: bool(on) for name, on in wanted.items() if on is not None}
        meshes: dict[str, tuple[str, ...]] = {"surface": ("surface",), "rulings": ("lattice",)}
        meshes |= {"striction": ("striction", "striction hidden"), "frame": ("mark", "mark hidden")}
        for name, parts in meshes.items():
            for part in parts:
                self._meshes[part].visible = self._shown[name]

    def sphere(self, mode: SphereMode) -> None:
        """Show the unit sphere as an inset, in half of the canvas (``"large"``), or not at all.

        ``"only"`` shows it in the middle; hide the surface with `show`.
        """
        if mode not in get_args(SphereMode):
            raise ValueError(f"`mode` must be 'inset', 'large', 'only' or 'off'; got {mode!r}")
        self._mode = mode
        self._place_sphere()
        for part in ("globe", "image", "controls", "needle"):
            self._meshes[part].visible = mode != "off"

    def _place_sphere(self) -> None:
        width, height = float(self._renderer.width), float(self._renderer.height)
        lens, radius, margin = (0.0, 0.0, 1.0), 0.15 * height, 0.055 * height
        x = 1.0 - 2.0 * (radius + margin) / width
        y = -1.0 + 2.0 * (radius + margin) / height
        if self._mode == "large":
            half = min(0.5 * width, height)
            lens, radius, x, y = (-0.48, 0.0, half / min(width, height)), 0.41 * half, 0.5, 0.0
        if self._mode == "only":
            radius, x, y = 0.42 * min(width, height), 0.0, 0.0
        self._lens, self._globe = lens, (x, y, radius)
        self._everywhere(viewport=(width, height), lens=lens, globe=self._globe)

    def resize(self, width: int, height: int) -> None:
        """Change the size of the canvas in pixels."""
        self._renderer.width, self._renderer.height = int(width), int(height)
        self._camera.aspect = width / height
        self._place_sphere()

    def reset_view(self, scene: Scene | None = None) -> None:
        """Look at the scene (or the one drawn last) from its best side, all of it in sight.

        Without a scene, look at what `frame` was given last, or else at the overlay.
        """
        scene = scene or self._scene
        if scene is not None:
            self._look_at(_centre(scene), _radius(scene), _azimuth(scene), _outline(scene))
        elif self._framed is not None:
            self._look_at(*self._framed, AZIMUTH)
        else:
            self._look_at(*ball(self._overlay), AZIMUTH)

    def frame(self, centre: npt.ArrayLike, radius: float) -> None:
        """Look at a ball from the usual side; for pictures without a scene.

        Parameters
        ----------
        centre, radius
            of the ball; `reset_view` returns to it as long as no scene is drawn.

        Raises
        ------
        GeometryError
            if the centre is not a point or the radius not positive.
        """
        middle, size = finite_array(centre, "centre"), float(finite_array(radius, "radius"))
        if middle.shape != (3,):
            raise GeometryError(f"`centre` must have shape (3,); got {middle.shape}")
        if size <= 0:
            raise GeometryError(f"`radius` must be positive; got {size:g}")
        self._framed = middle, size
        self._look_at(middle, size, AZIMUTH)

    def _look_at(
        self, centre: Array, radius: float, azimuth: float, outline: Array | None = None
    ) -> None:
        """Bring a ball into sight, and the points of the outline about it."""
        high = math.tan(math.radians(FIELD_OF_VIEW / 2))
        half = high * min(1.0, self._camera.aspect)
        away, to = radius * math.hypot(1.0, 1.0 / half), _away(azimuth)
        if outline is not None and len(outline):
            away = max(away, _distance(outline - centre, to, high * self._camera.aspect, high))
        self._unplaced = False
        self._arrow, self._period = 0.26 * radius, DASH * radius
        with self._camera.hold_sync():
            self._camera.near, self._camera.far = 0.01 * away, 100.0 * away
            self._camera.quaternion = _looking(to)
            self._camera.position = tuple(float(p) for p in centre + away * to)
        self._controls.target = tuple(float(p) for p in centre)
        self._everywhere(period=self._period)
        self._send_mark()

    # ---- picking

    def on_pick(self, callback: Callable[[float, float], object]) -> Callable[[], None]:
        """Call back with (t, w) of the place of the surface that was clicked or tapped.

        w is measured from the scene's ``base``. A drag, a click beside the surface or on the
        sphere, and a hidden surface call nothing.

        Returns
        -------
        disconnect
            ends it; a second call does nothing.
        """
        if len(self._renderer.controls) == 1:
            self._bring_pickers()
        self._listeners.append(callback)

        def disconnect() -> None:
            if callback in self._listeners:
                self._listeners.remove(callback)

        return disconnect

    def _bring_pickers(self) -> None:
        # Rulings are placed by the shader, so the page cannot say where one is hit. Of two boxes
        # about everything it can: the two points tell the line of sight, whatever the camera did.
        boxes = [
            three.Mesh(
                three.BoxBufferGeometry(*3 * (side,)), three.MeshBasicMaterial(side="DoubleSide")
            )
            for side in FAR_BOXES
        ]
        around = three.Object3D(children=boxes)
        self._press, self._release = (
            three.Picker(controlling=around, event=event, all=True)
            for event in ("pointerdown", "pointerup")
        )
        self._release.observe(self._picked, "picked")
        self._renderer.controls = [self._controls, self._press, self._release]

    def _picked(self, change: dict[str, Any]) -> None:
        sight, pressed = _sight(change["new"]), _sight(self._press.picked)
        if sight is None or pressed is None:
            return
        self._release.picked = []  # else a second click at the same place would say nothing new
        if not np.allclose(sight, pressed, rtol=1e-6, atol=1e-9):
            return  # it was a drag
        place = self._hit(*sight)
        for listener in [*self._listeners] if place else []:
            listener(*place)

    def _hit(self, eye: Array, way: Array) -> tuple[float, float] | None:
        """Return (t, w) where a line of sight first meets the surface that is drawn."""
        aimed = self._aimed(way)
        if aimed is None or self._scene is None or not self._shown["surface"]:
            return None
        return _first_hit(self._scene, eye, aimed)

    def _aimed(self, way: Array) -> Array | None:
        """Return the direction of sight in the picture that is shifted; None upon the sphere."""
        turn = np.array(self._camera.quaternion)
        high = math.tan(math.radians(FIELD_OF_VIEW / 2))
        size = np.array([high * self._camera.aspect, high])
        seen = _turned(turn * (-1, -1, -1, 1), way)
        place = seen[:2] / (-seen[2] * size)
        x, y, radius = self._globe
        pixels = 0.5 * (place - (x, y)) * (self._renderer.width, self._renderer.height)
        if self._mode != "off" and np.hypot(*pixels) < radius:
            return None
        place = (place - self._lens[:2]) / self._lens[2]
        return _turned(turn, np.array([*place * size, -1.0]))

    # ---- words

    def describe(self, text: str) -> None:
        """Set the words that stand for the picture with those who cannot see it."""
        label = html.escape(text, quote=True)
        self._words.value = (
            f'{STYLE}<span class="ruledlab-words" role="img" aria-label="{label}"></span>'
        )

    def legend_html(self, scene: Scene) -> str:
        """Return a colour bar with its ends and name as HTML; empty if the surface is plain."""
        if scene.colour is None:
            return ""
        known = self._scale if scene is self._scene else None
        scale = known or colour_scale(scene.colour)
        stops = ", ".join(_stops(scale.diverging, self._theme))
        low, high = ("≤ " * scale.clipped_low, "≥ " * scale.clipped_high)
        middle = "<span>0</span>" if scale.diverging else ""
        return (
            f'<div style="max-width:260px;font-size:12px;line-height:1.4">'
            f"<div>{html.escape(scene.colour_label)}{_missing_note(scale)}</div>"
            f'<div style="height:10px;border-radius:3px;'
            f'background:linear-gradient(to right, {stops})"></div>'
            f'<div style="display:flex;justify-content:space-between">'
            f"<span>{low}{_number(scale.low)}</span>{middle}"
            f"<span>{high}{_number(scale.high)}</span></div></div>"
        )

    def close(self) -> None:
        """Close the widget and every model made for it; a second call does nothing."""
        # the canvas first: it must let go of its renderer while the scene still exists
        self.widget.children = ()
        self._renderer.close()
        for root in (self._carrier, self._renderer, self._words, self.widget, *self._pool.values()):
            _close(root)


def _mixed(first: str, second: str, part: float) -> str:
    both = zip(_rgb(first), _rgb(second), strict=True)
    return "#" + "".join(f"{round((1 - part) * a + part * b):02x}" for a, b in both)


def _number(value: float) -> str:
    return f"{value:.3g}".replace("-", "−")


def _missing_note(scale: Scale) -> str:
    if not scale.missing:
        return ""
    swatch = f'<span style="color:{MISSING}">■</span>'
    return f' <span style="white-space:nowrap">· {swatch} undefined</span>'
