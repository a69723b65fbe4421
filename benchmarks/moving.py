"""One slider move in a real JupyterLab, key pressed to pixels changed; memory and opening time.

The same geometry, the same browser, one page at a time: the studio with everything it has on
screen, and notebooks that make a new figure and a new Renderer at every move.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from tests.browser.session import LabSession, NotebookPage, lab_session, why_not

from .notebooks import STUDIO, USUAL, write
from .table import Row

__all__ = ["rows"]

HERE = Path(__file__).resolve().parent
LESSONS = HERE.parent / "lessons"
WATCH, HOLD = ((HERE / name).read_text(encoding="utf-8") for name in ("watch.js", "hold.js"))
PICTURES = {"plots": ".ruledlab-plots-curves", "image": ".jp-RenderedImage img"}
FORGET = "() => Object.assign(watch, {drawn: [], keys: [], received: 0, sent: 0})"
QUIET = """([kinds, pause]) => {
  const last = kinds.map(kind => watch.drawn.findLast(([, of]) => of === kind)?.[0]);
  return last.every(at => at !== undefined && performance.now() - at > pause);
}"""
SHOWN = "() => watch.drawn.length || document.querySelector('.ruledlab svg[role=img]')"
HANDLE = ".widget-slider .noUi-handle"

VIEWPORT = (1400, 1500)  # everything on screen, the usual notebook's two pictures as well
ROUNDS, MOVES, WARM = 3, 8, 4
LONGEST, PAUSE = 8.0, 0.4  # seconds: until a move is given up; quiet after its last picture
RATE, SECONDS, LATER, HOLDS = 60, 5, 2.0, 3
KINDS = ("plots", "surface")


@dataclass(frozen=True, slots=True)
class Moves:
    """What single moves cost: seconds until each kind of picture was drawn, and bytes."""

    seconds: dict[str, list[float]] = field(default_factory=lambda: {kind: [] for kind in KINDS})
    bytes: list[int] = field(default_factory=list)

    def milliseconds(self, kind: str) -> float:
        # A picture that never came is no fast picture.
        return 1e3 * median(self.seconds[kind] or [float("inf")])

    def kilobytes(self) -> float:
        return median(self.bytes) / 1e3


def rows() -> Iterator[Row]:
    """Open everything in one browser and let the contenders take turns."""
    if reason := why_not():
        print(f"Slider moves in JupyterLab were not measured: {reason}", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as scratch, lab_session(Path(scratch) / "lab") as lab:
        lab.viewport = VIEWPORT
        yield from _opening(lab)
        studio = _opened(lab, write(Path(scratch) / "studio.ipynb", STUDIO))
        yield Row("first picture, from running the studio's cells", studio.first, None, "s")
        yield Row(
            "memory of the kernel with the studio open", _memory(studio.page), None, "MB", 170
        )
        yield from _moves(lab, studio, Path(scratch))
        yield from _held(studio.page)


# ------------------------------------------------------------------------------- opening a notebook


@dataclass(frozen=True, slots=True)
class Opened:
    """A notebook that has run: seconds to its first picture since running."""

    page: NotebookPage
    first: float
    kinds: list[str]


def _opened(lab: LabSession, path: Path) -> Opened:
    page = lab.open_notebook(path)
    page.wait_idle()
    page.page.evaluate(WATCH, PICTURES)
    start = page.page.evaluate("() => performance.now()")
    if errors := page.run_all():
        raise RuntimeError(f"{path.name}: {errors[0]}")
    page.page.wait_for_function("() => watch.drawn.length", timeout=60_000)
    page.page.wait_for_timeout(1500)
    drawn = page.page.evaluate("() => watch.drawn")
    kinds = sorted({kind for _, kind in drawn})
    first = max(min(at for at, of in drawn if of == kind) for kind in kinds)
    return Opened(page, (first - start) / 1e3, kinds)


def _opening(lab: LabSession) -> Iterator[Row]:
    """Run every lesson whole; the first one also pays for JupyterLab's own start."""
    for path in sorted(LESSONS.glob("*.ipynb")):
        opened = _first_picture(lab, path)
        yield Row(f"first picture, from running all of {path.stem}", opened, None, "s", 5)


def _first_picture(lab: LabSession, path: Path) -> float:
    page = lab.open_notebook(path)
    page.wait_idle()
    page.page.evaluate(WATCH, PICTURES)
    start = page.page.evaluate("() => performance.now()")
    page.page.evaluate("() => void window.jupyterapp.commands.execute('notebook:run-all-cells')")
    page.page.wait_for_function(SHOWN, timeout=60_000, polling=20)
    end = page.page.evaluate("() => performance.now()")
    lab.close(page)
    return float(end - start) / 1e3


def _memory(page: NotebookPage) -> float:
    import psutil

    process = psutil.Process(int(page.kernel_exec("import os; os.getpid()")))
    return float(process.memory_info().rss) / 1e6


# ------------------------------------------------------------------------------------ single moves


def _moves(lab: LabSession, studio: Opened, scratch: Path) -> Iterator[Row]:
    found = {name: _against(lab, studio, cells, scratch) for name, cells in USUAL.items()}
    for name, kind, what, target in (
        ("both", "plots", "one move: plots drawn", 0.2),
        ("plots alone", "plots", "one move: plots drawn, against a notebook of plots alone", None),
        ("both", "surface", "one move: 3D drawn", 0.2),
        ("3D alone", "surface", "one move: 3D drawn, against a notebook of 3D alone", None),
    ):
        ours, usual = found[name]
        yield Row(what, ours.milliseconds(kind), usual.milliseconds(kind), "ms", target)
    ours, usual = found["both"]
    yield Row(
        "one move: bytes to and from the kernel", ours.kilobytes(), usual.kilobytes(), "kB", 0.1
    )


def _against(
    lab: LabSession, studio: Opened, cells: list[str], scratch: Path
) -> tuple[Moves, Moves]:
    usual = _opened(lab, write(scratch / "usual.ipynb", cells))
    # The pictures below the slider, not the code above it
    usual.page.locator(HANDLE).evaluate("node => node.scrollIntoView({block: 'start'})")
    ours_found, usual_found = Moves(), Moves()
    for page, found in ((studio, Moves()), (usual, Moves())):
        _move(page, found, "ArrowRight", WARM)
    for number in range(ROUNDS):
        key = "ArrowLeft" if number % 2 else "ArrowRight"
        _move(studio, ours_found, key, MOVES)
        _move(usual, usual_found, key, MOVES)
    lab.close(usual.page)
    return ours_found, usual_found


def _move(opened: Opened, found: Moves, key: str, times: int) -> None:
    page, kinds = opened.page, opened.kinds
    page.page.bring_to_front()
    handle = page.locator(HANDLE)
    handle.evaluate("node => node.scrollIntoView({block: 'nearest'})")
    handle.focus()
    page.page.wait_for_timeout(300)
    for _ in range(times):
        page.page.evaluate(FORGET)
        page.page.keyboard.press(key)
        page.page.wait_for_function(QUIET, arg=[kinds, 1e3 * PAUSE], timeout=1e3 * LONGEST)
        _note(found, page.page.evaluate("() => watch"))


def _note(found: Moves, seen: dict[str, Any]) -> None:
    pressed = seen["keys"][0]
    for kind in KINDS:
        times = [at for at, of in seen["drawn"] if of == kind and at > pressed]
        if times:
            found.seconds[kind].append((times[-1] - pressed) / 1e3)
    found.bytes.append(seen["received"] + seen["sent"])


# ------------------------------------------------------------------------------------ a held slider


def _held(page: NotebookPage) -> Iterator[Row]:
    page.page.bring_to_front()
    found = [_hold(page) for _ in range(HOLDS)]
    held = f"{RATE} moves/s for {SECONDS} s"
    for kind, what in (("plots", "plots"), ("surface", "3D")):
        behind = median(late[kind] for late, _ in found)
        yield Row(f"{held}: last {what} after the last move", behind, None, "ms", 150)
    rate = median(rate for _, rate in found)
    yield Row(f"{held}: pictures of the surface in a second", rate, None, "/s")


def _hold(page: NotebookPage) -> tuple[dict[str, float], float]:
    """Return how late the last pictures were, in ms, and how many of the surface came a second."""
    page.page.evaluate(FORGET)
    run = page.page.evaluate(HOLD, [HANDLE, RATE, SECONDS])
    page.page.wait_for_timeout(1e3 * LATER)
    drawn = page.page.evaluate("() => watch.drawn")
    late = {kind: max(at for at, of in drawn if of == kind) - run["end"] for kind in KINDS}
    return late, sum(of == "surface" and at < run["end"] for at, of in drawn) / SECONDS
