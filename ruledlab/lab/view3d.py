"""Draws a scene's surface with pythreejs, and is the only module that imports it.

What moves is sent as textures: one column per ruling (see `ruledlab.lab.shaders`), one byte per
scalar, one row for the cursor. Meshes are built once for a number of rulings and never change.
No geometry is computed here; directions, striction points and scalars arrive in a `Scene`.
"""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal, get_args

import ipywidgets
import numpy as np
import numpy.typing as npt
import pythreejs as three

from ruledlab.lab import shaders
from ruledlab.lab.palette import LIGHT, Theme
from ruledlab.lab.scene import Mark, Scene

Array = npt.NDArray[np.floating[Any]]
SphereMode = Literal["inset", "large", "only", "off"]

BANDS = 32  # strips between the two ends of a ruling
STEP = 40  # textures are this many columns wide, or a multiple of it
LINES = 24  # gaps between the rulings drawn as lines
FAR = 100.0  # scene radii beyond which a ruling counts as undefined: no spike across the picture
FIELD_OF_VIEW = 34.0  # degrees
AZIMUTH, ELEVATION = math.radians(-58.0), math.radians(24.0)

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


def _geometry(index: Array, **attributes: Array) -> three.BufferGeometry:
    made = {name: three.BufferAttribute(np.float32(a)) for name, a in attributes.items()}
    made["index"] = three.BufferAttribute(index.astype(np.uint32).ravel())
    return three.BufferGeometry(attributes=made)


def _quads(count: int) -> Array:
    """Index of ``count`` separate quads."""
    return np.asarray(4 * np.arange(count)[:, None] + np.array([0, 1, 2, 0, 2, 3]))


def _sheet(count: int) -> three.BufferGeometry:
    """Return the surface: (fraction along t, fraction along the ruling) at every vertex."""
    t, w = np.meshgrid(np.linspace(0, 1, count), np.linspace(0, 1, BANDS + 1), indexing="ij")
    first = np.add.outer(np.arange(count - 1) * (BANDS + 1), np.arange(BANDS)).ravel()
    across = np.array([0, BANDS + 1, BANDS + 2, 0, BANDS + 2, 1])
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


def _controls(capacity: int) -> three.BufferGeometry:
    """Return squares for the control points on the sphere."""
    number = np.repeat(np.arange(float(capacity)), 4)
    return _geometry(_quads(capacity), number=number, corner=np.tile(SQUARE, (capacity, 1)))


def _needle() -> three.BufferGeometry:
    """Return the cursor's stub and point on the sphere."""
    return _parts([(shaders.STUB_KIND, 0), (shaders.DOT_KIND, 0)], [CORNERS, SQUARE])


def _square() -> three.BufferGeometry:
    return _geometry(_quads(1), corner=SQUARE)


def _texture(data: Array) -> three.DataTexture:
    return three.DataTexture(data=data, type="FloatType")


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


def _away() -> Array:
    flat = math.cos(ELEVATION)
    return np.array([flat * math.cos(AZIMUTH), flat * math.sin(AZIMUTH), math.sin(ELEVATION)])


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
        smooth edges by multisampling.

    Attributes
    ----------
    widget
        the ipywidgets Box to display.
    """

    def __init__(
        self, width: int = 600, height: int = 430, theme: Theme = LIGHT, antialias: bool = True
    ) -> None:
        self._theme = theme
        self._scene: Scene | None = None
        self._scale: Scale | None = None
        self._mark: Mark | None = None
        self._arrow = 0.3
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
        self._rulings = self._blank(shaders.ROWS, 5 * STEP)
        self._cursor = _texture(mark_data(None, (0.0, 0.0), 0.0))

    def _kept(self, key: tuple[Any, ...], make: Callable[[], Any]) -> Any:
        """Return the model made for this size, now or before.

        Models of sizes no longer used are kept until `close`: the page resolves references to
        models late, and one that is closed too soon leaves the canvas empty for good.
        """
        if key not in self._pool:
            self._pool[key] = make()
        return self._pool[key]

    def _blank(self, rows: int, columns: int) -> three.DataTexture:
        data = np.zeros((rows, columns, 4), dtype=np.float32)
        return self._kept(("rulings", rows, columns), lambda: _texture(data))

    def _material(self, vertex: str, fragment: str, **uniforms: Any) -> three.ShaderMaterial:
        known = {"viewport": (600.0, 430.0), "lens": (0.0, 0.0, 1.0), "globe": (0.0, 0.0, 60.0)}
        known |= {"extent": (5.0 * STEP, float(shaders.ROWS))}
        known |= {"rulings": self._rulings, "mark": self._cursor}
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
        for name, material in self._materials.items():
            if name != "surface":
                material.transparent = True
                material.depthWrite = name in {"striction", "mark", "image", "controls", "needle"}
            if name.endswith("hidden"):
                material.depthFunc = "GreaterDepth"
        self._materials["globe"].depthTest = False

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

    def _shapes(self, count: int, controls: int) -> dict[str, three.BufferGeometry]:
        """Return the geometries that depend on the numbers of rulings and control points."""
        rows = 100 << max(0, math.ceil(math.log2(max(count, 1) / 100)))
        places = 8 << max(0, math.ceil(math.log2(max(controls, 1) / 8)))
        curve = self._kept(("curve", rows), lambda: _strips(*_along(rows, 0.0)))
        return {
            "surface": self._kept(("surface", rows), lambda: _sheet(rows)),
            "lattice": self._kept(("lattice", rows), lambda: _lattice(rows)),
            "striction": curve,
            "striction hidden": curve,
            "image": curve,
            "controls": self._kept(("controls", places), lambda: _controls(places)),
        }

    def _make_meshes(self) -> None:
        marks = _marks()
        shapes = self._shapes(5 * STEP, 8) | {"mark": marks, "mark hidden": marks}
        shapes |= {"globe": _square(), "needle": _needle()}
        order = {name: place for place, name in enumerate(self._materials)}
        self._meshes = {
            name: _mesh(shapes[name], material, order[name])
            for name, material in self._materials.items()
        }
        # A texture used by a ShaderMaterial does not ask for a redraw when its data change; one
        # used as a map does. This mesh is never drawn: it only passes the request on.
        self._wire = three.MeshBasicMaterial(map=self._rulings, alphaMap=self._cursor)
        self._bell = _mesh(self._meshes["globe"].geometry, self._wire, 0, visible=False)

    def _make_renderer(self, width: int, height: int, antialias: bool) -> None:
        self._camera = three.PerspectiveCamera(
            fov=FIELD_OF_VIEW, aspect=width / height, up=(0.0, 0.0, 1.0), position=(3.0, -5.0, 3.0)
        )
        self._controls = three.OrbitControls(controlling=self._camera)
        self._space = three.Scene(children=[*self._meshes.values(), self._bell], background=None)
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
        self._words = ipywidgets.HTML(STYLE)
        self.widget = ipywidgets.Box([self._renderer, self._words])
        self.widget.add_class("ruledlab-view3d")
        self.widget.layout.max_width = "100%"
        self.describe(WORDS)

    # ---- what is drawn

    def draw(self, scene: Scene) -> None:
        """Show a scene; the camera stays where it is, except for the first scene."""
        first, self._scene = self._scene is None, scene
        rulings = self._blank(*texture_size(scene))
        self._scale = None if scene.colour is None else colour_scale(scene.colour)
        rulings.data = rulings_data(scene, self._scale)
        self._use(rulings)
        for name, shape in self._shapes(len(scene.t), len(scene.control_directions)).items():
            self._meshes[name].geometry = shape
        _assign(self._materials["surface"], self._colouring())
        if first:
            self.reset_view(scene)
        self._send_mark()

    def draw_cursor(self, mark: Mark) -> None:
        """Show the moving ruling and its frame; what is undefined in it is hidden."""
        self._mark = mark
        self._send_mark()

    def choose(self, index: int | None) -> None:
        """Mark a control point on the sphere, or none."""
        _assign(self._materials["controls"], {"chosen": -1.0 if index is None else float(index)})

    def _send_mark(self) -> None:
        ends = (0.0, 0.0) if self._scene is None else _ends(self._scene)
        self._cursor.data = mark_data(self._mark, ends, self._arrow)

    def _use(self, rulings: three.DataTexture) -> None:
        """Draw from this texture; its data are there already, so no frame shows old ones."""
        if rulings is self._rulings:
            return
        self._rulings = rulings
        rows, columns, _ = rulings.data.shape
        self._everywhere(rulings=rulings, extent=(float(columns), float(rows)))
        self._wire.map = rulings

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
        self._everywhere(viewport=(width, height), lens=lens, globe=(x, y, radius))

    def resize(self, width: int, height: int) -> None:
        """Change the size of the canvas in pixels."""
        self._renderer.width, self._renderer.height = int(width), int(height)
        self._camera.aspect = width / height
        self._place_sphere()

    def reset_view(self, scene: Scene | None = None) -> None:
        """Look at the scene (or the one drawn last) from the usual side, all of it in sight."""
        scene = scene or self._scene
        if scene is None:
            return
        radius, centre = _radius(scene), _centre(scene)
        half = math.tan(math.radians(FIELD_OF_VIEW / 2)) * min(1.0, self._camera.aspect)
        away = radius * math.hypot(1.0, 1.0 / half)
        self._arrow = 0.26 * radius
        with self._camera.hold_sync():
            self._camera.near, self._camera.far = 0.01 * away, 100.0 * away
            self._camera.quaternion = _looking(_away())
            self._camera.position = tuple(float(p) for p in centre + away * _away())
        self._controls.target = tuple(float(p) for p in centre)
        self._send_mark()

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
        for root in (self._renderer, self._words, self.widget, *self._pool.values()):
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
