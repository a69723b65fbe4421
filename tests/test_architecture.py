"""Imports run one way, and each outside library has one door."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parent.parent / "ruledlab"

# A module may import modules of lower layers only; its own layer's are its peers. A new module
# must be given its place here.
LAYERS: tuple[frozenset[str], ...] = tuple(
    frozenset(names.split())
    for names in (
        "geometry.checks",
        "geometry.series geometry.quadrature geometry.formula",
        "geometry.dual geometry.typeset geometry.choices geometry.written",
        "geometry.jet geometry.line",
        "geometry.curve geometry.bspline geometry.field",
        "geometry.vector geometry.closed geometry.source geometry.congruence geometry.function",
        "geometry.special",
        "geometry.surface",
        "geometry.rebuild geometry.motion geometry.tangent geometry.developable",
        "geometry.turn geometry.steps",
        "geometry.gallery",
        "geometry",
        "printed.entry printed.parts",
        "printed.as_printed printed.as_defined printed.notes",
        "printed.findings",
        "lab.shaders.common",
        "lab.shaders.globe lab.shaders.mark lab.shaders.overlay lab.shaders.surface",
        "__init__ printed design pair lab.palette lab.shaders lab.glyphs lab.axes",
        "export lab.scene lab.overlay lab.signs lab.colouring lab.meshes lab.markup lab.flat",
        "lab.textures",
        "lab.sight",
        "lab.scenes lab.scenes.along lab.scenes.bend lab.scenes.line_pair lab.scenes.congruence "
        "lab.scenes.shrinking",
        "lab.scenes.dual_graph lab.scenes.comparison",
        "lab.scenes.congruence_chart lab.scenes.congruence_numbers lab.scenes.straightened",
        "lab.slate",
        "lab.state lab.scenes.moving",
        "lab.scenes.once_round",
        "lab.controls.group",
        "lab.controls.number",
        "lab.controls.course lab.controls.fields lab.controls.look lab.controls.points "
        "lab.controls.readouts",
        "lab.controls lab.plots lab.view3d lab.pad lab.cells",
        "lab.share lab.arc_plots lab.handles",
        "lab.apps.base",
        "lab.apps.studio",
        " ".join(f"lab.apps.lesson_{n:02d}" for n in range(13)),
        "lab.apps",
        "lab",
        "exercises.shape exercises.store exercises.draw exercises.verdict exercises.tex",
        "exercises.answers exercises.kinds.task",
        "exercises.kinds.choose exercises.kinds.number exercises.kinds.formula "
        "exercises.kinds.goal exercises.kinds.sketch",
        "exercises.kinds.drag exercises.kinds.place",
        "exercises.kinds.slip",
        "exercises.kinds",
        "exercises.registry",
        "exercises.core",
        "exercises.misconceptions exercises.record exercises.designs",
        "exercises.boxes",
        "exercises.widgets " + " ".join(f"exercises.lesson_{n:02d}" for n in range(13)),
        "exercises",
        "setup_check",
        "cli",
        "__main__",
    )
)
LAYER = {name: height for height, names in enumerate(LAYERS) for name in names}

GEOMETRY_MAY_USE = {"numpy", "scipy", "ruledlab"} | set(sys.stdlib_module_names)
ONE_DOOR = {"pythreejs": "lab.view3d", "matplotlib": "lab.plots"}
WIDGETS = {"ipywidgets", "anywidget", "pythreejs", "matplotlib", "IPython", "traitlets"}
WIDGETS_FROM = LAYER["lab.controls.group"]
FORBIDDEN_CALLS = {"eval", "exec", "__import__"}


def name_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 1 else parts)


def imports(tree: ast.AST, module: str, is_package: bool) -> Iterator[tuple[int, str]]:
    """Every imported module with its line; `from a import b` counts as a.b, too."""
    package = ["ruledlab", *module.split(".")] if module != "__init__" else ["ruledlab"]
    if not is_package:
        package = package[:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            origin = ".".join([*base, *(node.module or "").split(".")]).strip(".")
            yield node.lineno, origin
            yield from ((node.lineno, f"{origin}.{alias.name}") for alias in node.names)


def own_module(imported: str) -> str | None:
    """The module of the package that `imported` names, or None if it is a name inside one."""
    if imported == "ruledlab":
        return "__init__"
    name = imported.removeprefix("ruledlab.")
    return name if name in LAYER or (PACKAGE / f"{name.replace('.', '/')}.py").exists() else None


def faults(source: str, module: str, *, is_package: bool = False) -> list[str]:
    tree = ast.parse(source)
    found = []
    for line, imported in imports(tree, module, is_package):
        top = imported.partition(".")[0]
        if top == "ruledlab":
            found += [f"{line}: {text}" for text in direction_faults(module, imported)]
        else:
            found += [f"{line}: {text}" for text in outside_faults(module, imported, top)]
    for node in ast.walk(tree):
        called = node.func if isinstance(node, ast.Call) else None
        if isinstance(called, ast.Name) and called.id in FORBIDDEN_CALLS:
            found.append(f"{called.lineno}: calls {called.id}")
    return sorted(set(found))


def direction_faults(module: str, imported: str) -> Iterator[str]:
    other = own_module(imported)
    if other is None or other == module:
        return
    if other not in LAYER:
        yield f"imports {other}, which has no place in LAYERS"
    elif LAYER[other] >= LAYER[module] and not bare_package(module, imported):
        yield f"imports {other}, which is not below it"


def bare_package(module: str, imported: str) -> bool:
    """`from ruledlab.geometry import dual` in a part of geometry: only the part counts."""
    return module.startswith(imported.removeprefix("ruledlab.") + ".") or imported == "ruledlab"


def outside_faults(module: str, imported: str, top: str) -> Iterator[str]:
    if module.startswith("geometry") and top not in GEOMETRY_MAY_USE:
        yield f"geometry uses {top}"
    if top in ONE_DOOR and module != ONE_DOOR[top]:
        yield f"{top} belongs to {ONE_DOOR[top]} alone"
    if top in WIDGETS and LAYER[module] < WIDGETS_FROM:
        yield f"{top} below the views"
    if imported.startswith(("matplotlib.pyplot", "matplotlib.pylab", "pylab")):
        yield "pyplot keeps global state"


MODULES = sorted(PACKAGE.rglob("*.py"))


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_every_module_keeps_the_architecture(path: Path) -> None:
    module = name_of(path)
    assert module in LAYER, f"give {module} its place in LAYERS"
    source = path.read_text(encoding="utf-8")
    assert faults(source, module, is_package=path.name == "__init__.py") == []


@pytest.mark.parametrize(
    ("module", "source", "says"),
    [
        ("geometry.dual", "from ruledlab.geometry.surface import RuledSurface", "not below it"),
        ("geometry.dual", "from ruledlab.geometry import surface", "not below it"),
        ("geometry.dual", "from . import surface", "not below it"),
        ("geometry.dual", "from .surface import RuledSurface", "not below it"),
        ("geometry.dual", "import ruledlab.lab.scene", "not below it"),
        ("geometry.curve", "from .field import Field", "not below it"),
        ("geometry.dual", "def f():\n    from ..lab import state", "not below it"),
        ("lab.scene", "from ruledlab.lab.state import Lab", "not below it"),
        ("lab.plots", "from .view3d import View3D", "not below it"),
        ("lab.state", "from ruledlab import cli", "not below it"),
        ("__init__", "from ruledlab.lab import Lab", "not below it"),
        ("geometry.series", "import sympy", "geometry uses sympy"),
        ("geometry", "import pandas.core", "geometry uses pandas"),
        ("lab.controls", "import pythreejs as three", "belongs to lab.view3d"),
        ("lab.apps", "from matplotlib.figure import Figure", "belongs to lab.plots"),
        ("lab.plots", "from matplotlib import pyplot", "global state"),
        ("lab.plots", "import matplotlib.pyplot as plt", "global state"),
        ("lab.state", "import ipywidgets", "below the views"),
        ("design", "import anywidget", "below the views"),
        ("design", "x = eval('1')", "calls eval"),
        ("lab.apps", "def f():\n    exec('1')", "calls exec"),
    ],
)
def test_the_rules_notice(module: str, source: str, says: str) -> None:
    is_package = module in ("__init__", "geometry", "lab")
    assert any(says in fault for fault in faults(source, module, is_package=is_package))


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("geometry.dual", "import numpy as np\nfrom .series import Series\nfrom math import pi"),
        ("geometry.surface", "from ruledlab.geometry import checks, dual"),
        ("geometry.checks", "import numpy as np\nimport scipy.special"),
        ("geometry", "from .surface import RuledSurface\nfrom . import gallery"),
        ("__init__", "from ruledlab.geometry import Bezier"),
        ("lab.scene", "from ruledlab import RuledSurface\nfrom ruledlab.geometry import Dual"),
        ("lab.view3d", "import pythreejs\nfrom ruledlab.lab.state import Lab"),
        ("lab.view3d", "from ruledlab.lab import palette"),
        ("lab.plots", "from matplotlib.figure import Figure"),
        ("lab", "from .apps import studio\nfrom ruledlab.lab.state import Lab"),
        ("design", "import ast\nvalue = ast.literal_eval('1')"),
    ],
)
def test_the_rules_let_pass(module: str, source: str) -> None:
    is_package = module in ("__init__", "geometry", "lab")
    assert faults(source, module, is_package=is_package) == []


def test_importing_the_package_loads_no_widget() -> None:
    heavy = sorted((WIDGETS - {"traitlets"}) | {"sympy", "jupyterlab", "pandas"})
    code = f"import sys, ruledlab; sys.exit(' '.join(set({heavy}) & set(sys.modules)) or 0)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
