"""Is this Python ready for the lessons? A plain answer per part, with the remedy.

`check_setup` is what ``ruledlab check`` prints and what lesson 00 shows. Nothing is imported and
nothing is computed until it is called.
"""

from __future__ import annotations

import importlib
import json
import math
import platform
import re
import subprocess
import sys
import warnings
from collections.abc import Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from html import escape
from importlib import metadata

OLDEST_PYTHON = (3, 11)
LONGEST_LOOK = 60.0  # seconds

# name -> what it does for the lessons, and the oldest release that will do (as pyproject has it)
PACKAGES: Mapping[str, tuple[str, str]] = {
    "numpy": ("arrays", "1.26"),
    "scipy": ("quadrature and splines", "1.15"),
    "matplotlib": ("the plots", "3.8"),
    "ipywidgets": ("sliders and buttons", "8.1"),
    "pythreejs": ("the 3D view", "2.4.2"),
    "anywidget": ("the domain pad", "0.9.13"),
    "ipykernel": ("runs the lessons' cells", "6.29"),
    "jupyterlab": ("opens the lessons", "4.2"),
}

IMPORTED_BESIDE = {"jupyterlab"}
"""What the lessons' own kernel does not import: see `_LOOK`."""

# The browser halves of the widgets, by the names under which JupyterLab knows them.
LAB_EXTENSIONS: Mapping[str, str] = {
    "@jupyter-widgets/jupyterlab-manager": "ipywidgets",
    "jupyter-threejs": "pythreejs",
    "jupyterlab-datawidgets": "pythreejs",
    "anywidget": "anywidget",
}

# The paper's Example 2: these points, ū = u - v, v̄ = u + v. The pitch was found by three
# independent ways (quadrature, Stokes' theorem, the gap of an orthogonal trajectory).
_EIGHTHS_OF_PI = ((1, 2), (1, 3), (3, 3), (3, 2), (3, 1), (1, 1), (1, 2))
EXAMPLE_2_PITCH = 0.5801047651353705
PITCH_TOLERANCE = 1e-10

INSTALL_AGAIN = "install ruledlab again, as its README says; report it if that does not help"


@dataclass(frozen=True, slots=True)
class Part:
    """One part of the set-up.

    Attributes
    ----------
    name : str
        What was looked at.
    ok : bool
        Whether it will do.
    found : str
        What is there: a version, a value, or what is wrong.
    remedy : str
        What to do about it; empty when `ok`.
    """

    name: str
    ok: bool
    found: str
    remedy: str = ""

    def __str__(self) -> str:
        """Return the answer on one line, or two with the remedy."""
        line = f"{'ok     ' if self.ok else 'MISSING'}  {self.name}: {self.found}"
        return f"{line}\n         → {self.remedy}" if self.remedy else line


@dataclass(frozen=True, slots=True, repr=False)
class SetupReport:
    """What `check_setup` found; prints as text and shows as a table in a notebook.

    Attributes
    ----------
    parts : tuple of Part
        The answers, in the order in which a missing one matters.
    """

    parts: tuple[Part, ...]

    @property
    def ok(self) -> bool:
        """Whether every part will do."""
        return all(part.ok for part in self.parts)

    @property
    def missing(self) -> tuple[Part, ...]:
        """The parts that will not do."""
        return tuple(part for part in self.parts if not part.ok)

    @property
    def summary(self) -> str:
        """The whole answer in one sentence."""
        if self.ok:
            return "Everything is ready."
        return f"{len(self.missing)} of {len(self.parts)} parts need attention."

    def __str__(self) -> str:
        """Return one line per part and the summary."""
        return "\n".join([*map(str, self.parts), self.summary])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = "".join(_row(part) for part in self.parts)
        return (
            f"<table><caption>{escape(self.summary)}</caption><thead><tr>"
            '<th scope="col">part</th><th scope="col">answer</th><th scope="col">found</th>'
            f'<th scope="col">remedy</th></tr></thead><tbody>{rows}</tbody></table>'
        )


def check_setup() -> SetupReport:
    """Look at every part the lessons need.

    Imports the packages, looks up JupyterLab's widget extensions where JupyterLab itself looks,
    and computes one number with a known answer. Takes about a second the first time.

    Returns
    -------
    SetupReport
        Frozen; `SetupReport.ok` says whether everything is ready. A part that fails is reported,
        never raised.
    """
    with warnings.catch_warnings(), ThreadPoolExecutor(1) as beside:
        looking = beside.submit(_extensions_as_jupyterlab_sees_them)
        warnings.simplefilter("ignore")  # other packages' deprecations are not the reader's concern
        packages = [_check_package(name, *what) for name, what in PACKAGES.items()]
        pitch, extensions = _check_pitch(), _check_extensions(looking)
        return SetupReport((_check_python(), *packages, *extensions, pitch))


def _row(part: Part) -> str:
    cells = (part.name, "ok" if part.ok else "MISSING", part.found, part.remedy)
    first, *rest = (escape(cell) for cell in cells)
    return f'<tr><th scope="row">{first}</th>' + "".join(f"<td>{c}</td>" for c in rest) + "</tr>"


def _check_python() -> Part:
    wanted = ".".join(map(str, OLDEST_PYTHON))
    ok = sys.version_info >= OLDEST_PYTHON
    remedy = "" if ok else f"install Python {wanted} or newer and make the environment again"
    return Part("Python", ok, platform.python_version(), remedy)


def _install(package: str) -> str:
    return f'"{sys.executable}" -m pip install --upgrade "{package}"'


def _check_package(name: str, purpose: str, oldest: str) -> Part:
    label = f"{name} ({purpose})"
    remedy = _install(f"{name}>={oldest}")
    try:
        version = metadata.version(name)
        if name not in IMPORTED_BESIDE:
            importlib.import_module(name)
    except metadata.PackageNotFoundError:
        return Part(label, False, "not installed", remedy)
    except Exception as error:  # a broken package may raise anything; the answer is the same
        return Part(label, False, f"does not import: {_one_line(error)}", remedy)
    if _release(version) < _release(oldest):
        return Part(label, False, f"{version} is too old", remedy)
    return Part(label, True, version)


def _release(version: str) -> tuple[int, ...]:
    found = re.match(r"\d+(\.\d+)*", version)
    return tuple(int(number) for number in found.group().split(".")) if found else ()


def _one_line(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())


# JupyterLab's own functions, in a Python of its own: importing its server takes longer than all the
# rest, goes on beside it so, and stays out of the kernel that the lessons run in.
_LOOK = """
import json
import jupyterlab
from jupyter_core.paths import jupyter_path
from jupyterlab_server.config import get_federated_extensions, get_page_config
paths = jupyter_path("labextensions")
found = {name: str(about.get("version", "?"))
         for name, about in get_federated_extensions(paths).items()}
# "name" turns a whole extension off, "name:plugin" a part of it
disabled = [entry.split(":")[0] for entry in get_page_config(paths).get("disabledExtensions", ())]
print(json.dumps([found, disabled]))
"""


def _check_extensions(
    looking: Future[tuple[dict[str, str], frozenset[str]]],
) -> Iterable[Part]:
    try:
        found, disabled = looking.result()
    except Exception as error:  # no JupyterLab, or one that keeps its extensions elsewhere
        label = "JupyterLab's widget extensions"
        return [Part(label, False, _one_line(error), _install("jupyterlab"))]
    return [_check_extension(name, found, disabled) for name in LAB_EXTENSIONS]


def _extensions_as_jupyterlab_sees_them() -> tuple[dict[str, str], frozenset[str]]:
    """Return the installed extensions with their versions, and the names of the disabled ones."""
    command = [sys.executable, "-c", _LOOK]
    told = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=LONGEST_LOOK
    )
    if told.returncode != 0:
        raise RuntimeError((told.stderr.strip().splitlines() or ["no answer"])[-1])
    found, disabled = json.loads(told.stdout)
    return found, frozenset(disabled)


def _check_extension(name: str, found: Mapping[str, str], disabled: frozenset[str]) -> Part:
    label = f"JupyterLab extension {name}"
    if name not in found:
        again = _install(LAB_EXTENSIONS[name]).replace("--upgrade", "--force-reinstall")
        return Part(label, False, "not found", again)
    if name in disabled:
        remedy = f'"{sys.executable}" -m jupyter labextension enable {name}'
        return Part(label, False, f"{found[name]}, but disabled", remedy)
    return Part(label, True, f"{found[name]}, enabled")


def _check_pitch() -> Part:
    label = "computation (the pitch of Example 2)"
    try:
        pitch = example_2_pitch()
    except Exception as error:  # whatever it is, the reader needs to hear it
        return Part(label, False, _one_line(error), INSTALL_AGAIN)
    if not math.isclose(pitch, EXAMPLE_2_PITCH, rel_tol=0, abs_tol=PITCH_TOLERANCE):
        found = f"{pitch!r} instead of {EXAMPLE_2_PITCH!r}"
        return Part(label, False, found, INSTALL_AGAIN)
    return Part(label, True, f"{pitch:.13f}")


def example_2_pitch() -> float:
    """Return the pitch of the paper's Example 2, computed from its printed control points.

    Returns
    -------
    float
        l = -∮ τ̄ dt, which is 0.580104765135…
    """
    ruledlab = importlib.import_module("ruledlab")
    points = [(u * math.pi / 8, v * math.pi / 8) for u, v in _EIGHTHS_OF_PI]
    surface = ruledlab.RuledSurface(ruledlab.Bezier(points), ubar="u - v", vbar="u + v")
    return float(surface.pitch())
