"""The notebooks that are timed: one cell with the studio, and three written the usual way."""

from __future__ import annotations

from pathlib import Path

import nbformat

__all__ = ["STUDIO", "USUAL", "write"]

STUDIO = ["from ruledlab.lab import studio", "studio()"]

_START = """\
import ipywidgets as widgets
import matplotlib.pyplot as plt
import numpy as np
import pythreejs as three
from IPython.display import display
from ruledlab import Bezier, RuledSurface

points = np.pi / 8 * np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]])

def surface(u, v):
    moved = points.copy()
    moved[2] = u, v
    return RuledSurface(Bezier(moved), "u - v", "u + v")
"""

_PLOTS = """\
t = np.linspace(0, 1, 400)

def draw_plots(u, v):
    found = surface(u, v).invariants(t)
    figure, axes = plt.subplots(3, 1, sharex=True, figsize=(6, 4.5))
    for axis, values, name in zip(axes, (found.kappa, found.tau, found.sigma), "κτσ"):
        axis.plot(t, values)
        axis.set_ylabel(name)
    plt.show()
"""

_SURFACE = """\
along, across = np.linspace(0, 1, 200), np.linspace(-2, 2, 64)
corner = (np.arange(199)[:, None] * 64 + np.arange(63)).ravel()
faces = np.stack([corner, corner + 64, corner + 1, corner + 1, corner + 64, corner + 65], axis=1)

def draw_surface(u, v):
    shape = surface(u, v)
    positions = shape.points(along, across).reshape(-1, 3)
    normals = shape.fundamental_forms(along, across).normal.reshape(-1, 3)
    geometry = three.BufferGeometry(attributes={
        "position": three.BufferAttribute(positions.astype(np.float32)),
        "normal": three.BufferAttribute(normals.astype(np.float32)),
        "index": three.BufferAttribute(faces.ravel().astype(np.uint32)),
    })
    material = three.MeshStandardMaterial(color="#5b8fc9", side="DoubleSide")
    lamp = three.DirectionalLight(position=[3, 5, 4], intensity=0.8)
    camera = three.PerspectiveCamera(
        position=[2.5, 2, 2.5], aspect=620 / 400, children=[lamp])
    mesh = three.Mesh(geometry, material, position=list(-positions.mean(axis=0)))
    scene = three.Scene(children=[mesh, camera, three.AmbientLight()])
    controls = three.OrbitControls(controlling=camera)
    display(three.Renderer(
        scene=scene, camera=camera, controls=[controls], width=620, height=400))
"""

_SHOW = """\
def draw(u, v):
    {}

middle = 3 * np.pi / 8
sliders = {{name: widgets.FloatSlider(value=middle, min=0, max=3, step=0.01, description=name)
           for name in "uv"}}
display(*sliders.values(), widgets.interactive_output(draw, sliders))
"""


def _usual(*parts: str) -> list[str]:
    calls = {_PLOTS: "draw_plots(u, v)", _SURFACE: "draw_surface(u, v)"}
    return [_START, *parts, _SHOW.format("\n    ".join(calls[part] for part in parts))]


USUAL = {
    "plots alone": _usual(_PLOTS),
    "3D alone": _usual(_SURFACE),
    "both": _usual(_PLOTS, _SURFACE),
}


def write(path: Path, cells: list[str]) -> Path:
    """Write a notebook of these cells; without a named kernel Lab would ask for one."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    made = nbformat.v4.new_notebook(metadata={"kernelspec": kernel})
    made.cells = [nbformat.v4.new_code_cell(source) for source in cells]
    nbformat.write(made, path)
    return path
