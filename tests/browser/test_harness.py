"""Proof that the harness sees what happens: the rest of the browser tests rest on it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest

from . import session
from .session import (
    ARTIFACTS,
    THREE,
    KernelError,
    LabSession,
    NotebookPage,
    Pixels,
    write_notebook,
)

IMAGE = ".jupyter-widgets.widget-image"
TEXT = ".widget-text input"

SETUP = """\
import io, math
import ipywidgets as widgets
import numpy as np
import pythreejs as three
from matplotlib.figure import Figure
"""
SCENE = """\
camera = three.PerspectiveCamera(position=[2, 2, 2], aspect=4 / 3)
box = three.Mesh(three.BoxGeometry(1, 1, 1), three.MeshNormalMaterial())
view = three.Renderer(scene=three.Scene(children=[box], background="white"), camera=camera,
                      controls=[three.OrbitControls(controlling=camera)], width=400, height=300)
slider = widgets.IntSlider(value=0, max=50, description="turn")
word = widgets.Text(description="word", continuous_update=False)
picture = widgets.Image(format="png")
"""
LINKS = """\
def draw(change=None):
    box.quaternion = [0, 0, math.sin(slider.value / 20), math.cos(slider.value / 20)]
    figure, buffer = Figure((3, 2), dpi=60), io.BytesIO()
    figure.add_subplot().plot([0, 1], [0, slider.value])
    figure.savefig(buffer)
    picture.value = buffer.getvalue()

slider.observe(draw, "value")
draw()
"""
SVG = 'widgets.HTML(\'<svg id="dot" width="40" height="40"><circle r="9"/></svg>\')'


@pytest.fixture(scope="module")
def tiny(lab: LabSession, tmp_path_factory: pytest.TempPathFactory) -> Iterator[NotebookPage]:
    path = tmp_path_factory.mktemp("tiny") / "tiny.ipynb"
    show = "display(widgets.VBox([slider, word, view, picture]))"
    with lab.notebook(write_notebook(path, SETUP, SCENE, LINKS, show, SVG)) as page:
        assert page.run_all() == []
        yield page


def test_a_slider_changes_the_webgl_and_the_plot_pixels(tiny: NotebookPage) -> None:
    scene, plot = tiny.wait_still(THREE), tiny.wait_still(IMAGE)
    assert min(scene.drawn, plot.drawn) > 1000
    tiny.move_slider(3)
    assert tiny.wait_change(scene, THREE) != scene
    assert tiny.wait_change(plot, IMAGE) != plot
    tiny.wait_kernel("slider.value", "3")
    tiny.move_slider(-3)
    tiny.wait_same(plot, IMAGE)  # the same picture as before


def test_a_drag_orbits_the_camera_and_leaves_the_plot(tiny: NotebookPage) -> None:
    scene, plot = tiny.wait_still(THREE), tiny.wait_still(IMAGE)
    tiny.drag(THREE, (60, 25))
    assert tiny.wait_change(scene, THREE) != scene
    assert tiny.stays(plot, IMAGE, over=0.3)


def test_a_picture_that_does_not_change_is_noticed(tiny: NotebookPage) -> None:
    still = tiny.wait_still(THREE)
    with pytest.raises(AssertionError, match="did not change"):
        tiny.wait_change(still, THREE, timeout=0.5)
    assert tiny.stays(still, THREE, over=0.3)


def test_typing_reaches_the_kernel(tiny: NotebookPage) -> None:
    tiny.type_into(TEXT, "first")
    tiny.type_into(TEXT, "3*pi/8")
    tiny.wait_kernel("word.value", "'3*pi/8'")
    with pytest.raises(AssertionError, match="is '3\\*pi/8', not 'else'"):
        tiny.wait_kernel("word.value", "'else'", timeout=0.2)


def test_an_svg_is_seen(tiny: NotebookPage) -> None:
    before = tiny.pixels("#dot")
    assert (before.drawn, before.width, before.height) == (1, 40, 40)
    tiny.locator("#dot circle").evaluate("node => node.setAttribute('r', '12')")
    assert tiny.wait_change(before, "#dot") != before


def test_a_2d_canvas_is_seen(tiny: NotebookPage) -> None:
    tiny.page.evaluate("""() => { const made = document.createElement('canvas');
        made.id = 'flat'; made.width = 40; made.height = 30; document.body.append(made); }""")
    blank = tiny.pixels("#flat")
    assert (blank.drawn, blank.width, blank.height) == (0, 40, 30)
    tiny.locator("#flat").evaluate("node => node.getContext('2d').fillRect(5, 5, 9, 9)")
    assert tiny.pixels("#flat").drawn == 81


def test_the_kernel_answers_and_complains(tiny: NotebookPage) -> None:
    assert tiny.kernel_exec("print('one')\n1 + 1") == "one\n2"
    with pytest.raises(KernelError, match="ZeroDivisionError: division by zero"):
        tiny.kernel_exec("1 / 0")


def test_errors_in_cells_are_seen(lab: LabSession, tmp_path: Path) -> None:
    cells = ("import sys; print('on stderr', file=sys.stderr)", "1 / 0")
    with lab.notebook(write_notebook(tmp_path / "bad.ipynb", *cells)) as page:
        said = "\n".join(page.run_all())
    assert "on stderr" in said
    assert "ZeroDivisionError" in said


def test_the_console_is_listened_to(tiny: NotebookPage) -> None:
    assert tiny.console_errors == []
    tiny.page.evaluate("() => console.error('Error setting state: t.on is not a function')")
    tiny.page.evaluate("() => console.error('one of ours')")
    tiny.page.wait_for_timeout(100)
    assert tiny.console_errors == ["one of ours"]
    tiny.forget_console()
    assert tiny.console_errors == []


def test_the_notebook_itself_is_left_alone(lab: LabSession, tmp_path: Path) -> None:
    path = write_notebook(tmp_path / "mine.ipynb", "1 + 1")
    before = path.read_bytes()
    with lab.notebook(path) as page:
        page.run_all()
        page.page.evaluate("() => window.jupyterapp.commands.execute('docmanager:save')")
        saved = nbformat.read(lab.root / page.name, as_version=4)
    assert saved.cells[0].outputs
    assert path.read_bytes() == before
    assert page not in lab.pages


def test_a_screenshot_is_kept(tiny: NotebookPage) -> None:
    path = tiny.screenshot("harness")
    assert path == ARTIFACTS / "harness.png"
    assert path.read_bytes().startswith(b"\x89PNG")


def test_without_a_browser_there_is_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(session.CHROMIUM, "/nowhere/chromium")
    assert session.CHROMIUM in (session.why_not() or "")
    monkeypatch.setattr(session, "find_spec", lambda name: None)
    assert session.why_not() == "jupyterlab is not installed"


@pytest.mark.parametrize(("required", "outcome"), [("0", "skipped=1"), ("1", "errors=1")])
def test_without_a_browser_tests_skip_or_fail(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, required: str, outcome: str
) -> None:
    monkeypatch.setenv(session.CHROMIUM, "/nowhere/chromium")
    monkeypatch.setenv(session.REQUIRE, required)
    folder = Path(__file__).parent
    inside = pytester.mkpydir("inside")
    for name in ("conftest.py", "session.py"):
        (inside / name).write_bytes((folder / name).read_bytes())
    (inside / "test_any.py").write_text("def test_any(lab):\n    pass\n", encoding="utf-8")
    pytester.makeini("[pytest]\nmarkers =\n  browser: real browser\n  xdist_group: a worker")
    done = pytester.runpytest_inprocess("-p", "no:cacheprovider", "-rs")
    key, count = outcome.split("=")
    done.assert_outcomes(**{key: int(count)})
    assert "no Chromium found" in done.stdout.str()


def test_equal_pictures_have_equal_fingerprints() -> None:
    assert Pixels(1, 2, 3, 4) == Pixels(1, 2, 3, 4) != Pixels(1, 5, 3, 4)
