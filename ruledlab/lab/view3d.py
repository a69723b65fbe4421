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
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any, Literal, get_args

import anywidget
import ipywidgets
import numpy as np
import numpy.typing as npt
import pythreejs as three
import traitlets

from ruledlab.geometry.checks import Array, GeometryError, finite_array
from ruledlab.lab import colouring, meshes, shaders, sight, textures
from ruledlab.lab.overlay import Overlay, Packed, ball, pack
from ruledlab.lab.palette import LIGHT, Theme
from ruledlab.lab.scene import Mark, Scene

SphereMode = Literal["inset", "large", "only", "off"]

BANDS = 8  # strips between the two ends of a ruling; shading is computed at every pixel
FINE_BANDS = 32  # where a colour varies along the ruling: it is interpolated between vertices
DASH = 0.055  # period of dashes, in radii of what is framed
FAINT = 0.3  # of lines behind the surface
FAR_BOXES = (2.0**20, 2.0**21)  # sides of boxes about everything, see `SurfaceView.on_pick`

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


# ---- models of pythreejs -------------------------------------------------------------------------


def _geometry(shape: meshes.Shape) -> three.BufferGeometry:
    made = {name: three.BufferAttribute(values) for name, values in shape.attributes.items()}
    return three.BufferGeometry(attributes=made | {"index": three.BufferAttribute(shape.index)})


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
        self._scale: colouring.Scale | None = None
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
        self._rulings = _texture(np.zeros((shaders.ROWS, 5 * textures.STEP, 4), dtype=np.float32))
        self._pool["rulings", *self._rulings.data.shape] = self._rulings
        self._cursor = _texture(textures.mark_data(None, (0.0, 0.0), 0.0))

    def _kept(self, key: tuple[Any, ...], make: Callable[[], Any]) -> Any:
        """Return the model made for this size, now or before.

        Models of sizes no longer used are kept until `close`: the page resolves references to
        models late, and one that is closed too soon leaves the canvas empty for good.
        """
        if key not in self._pool:
            self._pool[key] = make()
        return self._pool[key]

    def _shape(self, make: Callable[..., meshes.Shape], *numbers: int) -> three.BufferGeometry:
        """Return the geometry of a mesh for these numbers of parts."""
        return self._kept((make.__name__, *numbers), lambda: _geometry(make(*numbers)))

    def _material(self, vertex: str, fragment: str, **uniforms: Any) -> three.ShaderMaterial:
        known = {"viewport": (600.0, 430.0), "lens": (0.0, 0.0, 1.0), "globe": (0.0, 0.0, 60.0)}
        known |= {"extent": (5.0 * textures.STEP, float(shaders.ROWS))}
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
                **{f"stop{i}": colour for i, colour in enumerate(colouring.SEQUENTIAL)},
                gloss=0.12,
                frontColour="#ffffff",
                backColour="#ffffff",
                missingColour=colouring.MISSING,
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
        line, dot = self._shape(meshes.ribbons, points, strokes), self._shape(meshes.squares, dots)
        return {
            "strokes hidden": line,
            "strokes": line,
            "dots hidden": dot,
            "dots": dot,
            "sheets": self._shape(meshes.cells, cells),
            "labels": self._shape(meshes.ribbons, letters, letters),
        }

    def _shapes(
        self, count: int, controls: int, bands: int = BANDS
    ) -> dict[str, three.BufferGeometry]:
        """Return the geometries that depend on how much there is to draw."""
        rows = 100 << max(0, math.ceil(math.log2(max(count, 1) / 100)))
        places = 8 << max(0, math.ceil(math.log2(max(controls, 1) / 8)))
        curve = self._shape(meshes.curve, rows)
        return {
            "surface": self._shape(meshes.sheet, rows, bands),
            "lattice": self._shape(meshes.lattice, rows),
            "striction": curve,
            "striction hidden": curve,
            "image": curve,
            "controls": self._shape(meshes.squares, places),
        }

    def _make_meshes(self) -> None:
        marks = _geometry(meshes.marks())
        shapes = self._shapes(5 * textures.STEP, 8) | {"mark": marks, "mark hidden": marks}
        shapes |= {"globe": _geometry(meshes.square()), "needle": _geometry(meshes.needle())}
        self._meshes = {
            name: _mesh(shapes[name], material, DRAWN.index(name))
            for name, material in self._materials.items()
        }

    def _make_renderer(self, width: int, height: int, antialias: bool) -> None:
        self._camera = three.PerspectiveCamera(
            fov=sight.FIELD_OF_VIEW,
            aspect=width / height,
            up=(0.0, 0.0, 1.0),
            position=(3.0, -5.0, 3.0),
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
        self._scale = None if scene.colour is None else colouring.colour_scale(scene.colour)
        data = textures.rulings_data(scene, self._scale)
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
        ends = (0.0, 0.0) if self._scene is None else textures.ends_of(self._scene)
        data = textures.mark_data(self._mark, ends, self._arrow)
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
        stops = enumerate(colouring.stops(self._scale.diverging, self._theme))
        colours = {f"stop{i}": colour for i, colour in stops}
        return {"scalars": float(self._scene.colour.shape[1]), **colours}

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
            fill=colouring.mixed(theme.paper, theme.surface, 0.22),
            frontColour=theme.surface,
            backColour=colouring.mixed(theme.surface, "#a9825f", 0.55),
            missingColour=colouring.MISSING,
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
            ball_of_scene = textures.centre_of(scene), textures.radius_of(scene)
            self._look_at(*ball_of_scene, sight.azimuth_for(scene), sight.outline(scene))
        elif self._framed is not None:
            self._look_at(*self._framed, sight.AZIMUTH)
        else:
            self._look_at(*ball(self._overlay), sight.AZIMUTH)

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
        self._look_at(middle, size, sight.AZIMUTH)

    def _look_at(
        self, centre: Array, radius: float, azimuth: float, outline: Array | None = None
    ) -> None:
        """Bring a ball into sight, and the points of the outline about it."""
        high = math.tan(math.radians(sight.FIELD_OF_VIEW / 2))
        half = high * min(1.0, self._camera.aspect)
        away, to = radius * math.hypot(1.0, 1.0 / half), sight.away(azimuth)
        if outline is not None and len(outline):
            angles = high * self._camera.aspect, high
            away = max(away, sight.distance_to_see(outline - centre, to, *angles))
        self._unplaced = False
        self._arrow, self._period = 0.26 * radius, DASH * radius
        with self._camera.hold_sync():
            self._camera.near, self._camera.far = 0.01 * away, 100.0 * away
            self._camera.quaternion = sight.looking(to)
            self._camera.position = tuple(float(p) for p in centre + away * to)
        self._controls.target = tuple(float(p) for p in centre)
        self._everywhere(period=self._period)
        self._send_mark()

    @property
    def eye(self) -> sight.Eye:
        """The camera, as the browser has reported it last."""
        size = float(self._renderer.width), float(self._renderer.height)
        return sight.Eye(np.array(self._camera.position), np.array(self._camera.quaternion), size)

    def on_turn(self, callback: Callable[[], object]) -> Callable[[], None]:
        """Call back when the camera has moved; return the function that ends this."""

        def turned(_change: dict[str, Any]) -> None:
            callback()

        self._camera.observe(turned, "position")
        ends = ExitStack()  # closing it a second time does nothing
        ends.callback(self._camera.unobserve, turned, "position")
        return ends.close

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
        pressed, released = map(sight.line_of_sight, (self._press.picked, change["new"]))
        if pressed is None or released is None:
            return
        self._release.picked = []  # else a second click at the same place would say nothing new
        if not np.allclose(released, pressed, rtol=1e-6, atol=1e-9):
            return  # it was a drag
        place = self._hit(*released)
        for listener in [*self._listeners] if place else []:
            listener(*place)

    def _hit(self, eye: Array, way: Array) -> tuple[float, float] | None:
        """Return (t, w) where a line of sight first meets the surface that is drawn."""
        aimed = self._aimed(way)
        if aimed is None or self._scene is None or not self._shown["surface"]:
            return None
        return sight.first_hit(self._scene, eye, aimed)

    def _aimed(self, way: Array) -> Array | None:
        """Return the direction of sight in the picture that is shifted; None upon the sphere."""
        turn = np.array(self._camera.quaternion)
        high = math.tan(math.radians(sight.FIELD_OF_VIEW / 2))
        size = np.array([high * self._camera.aspect, high])
        seen = sight.turned(turn * (-1, -1, -1, 1), way)
        place = seen[:2] / (-seen[2] * size)
        x, y, radius = self._globe
        pixels = 0.5 * (place - (x, y)) * (self._renderer.width, self._renderer.height)
        if self._mode != "off" and np.hypot(*pixels) < radius:
            return None
        place = (place - self._lens[:2]) / self._lens[2]
        return sight.turned(turn, np.array([*place * size, -1.0]))

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
        scale = known or colouring.colour_scale(scene.colour)
        return colouring.legend_html(scene.colour_label, scale, self._theme)

    def close(self) -> None:
        """Close the widget and every model made for it; a second call does nothing."""
        # the canvas first: it must let go of its renderer while the scene still exists
        self.widget.children = ()
        self._renderer.close()
        for root in (self._carrier, self._renderer, self._words, self.widget, *self._pool.values()):
            _close(root)
