"""A real JupyterLab in a real Chromium, for tests.

`LabSession` starts one server and one browser; `LabSession.open_notebook` gives a `NotebookPage`
that runs cells, moves controls and looks at pixels. The notebook is copied first, so a lesson in
the tree is never written to.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # only here: without playwright these tests are skipped, not broken
    from playwright.sync_api import Browser, BrowserContext, Locator, Page

ARTIFACTS = Path(__file__).resolve().parents[2] / "artifacts"
REQUIRE = "RULEDLAB_REQUIRE_BROWSER"
CHROMIUM = "RULEDLAB_CHROMIUM"
CHROMIUM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")

# WebGL drawn by the processor: the same pixels on every machine, no graphics card needed
CHROMIUM_ARGUMENTS = (
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    # else a 2D canvas changes hands, and its pixels a little, once it has been read
    "--disable-accelerated-2d-canvas",
    # Pages are put together without WebGL, as Chromium does by itself where there is no graphics
    # processor; else every frame of a page costs as much as a picture of a surface.
    "--disable-gpu-compositing",
    "--no-sandbox",
    "--no-first-run",
    "--disable-quic",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
)

# Lines in the browser's console that are others' and do no harm
KNOWN_CONSOLE_LINES = (
    r"Error setting state: \w+\.on is not a function",  # pythreejs, while its models settle
    r"Unsatisfied version .* of shared (singleton )?module @lumino/coreutils",
    r"Cannot read properties of undefined \(reading 'schema'\)",  # Notebook 7
)

THREE = ".jupyter-threejs canvas"
PLOTS = "canvas.ruledlab-plots-curves"
HANDLE = ".rl-handle"
LABEL = ".ruledlab-label"
KERNEL = "window.jupyterapp.shell.currentWidget.sessionContext.session.kernel"

ERRORS = (
    '.jp-OutputArea-output[data-mime-type="application/vnd.jupyter.stderr"]',
    '.jp-OutputArea-output [data-mime-type="application/vnd.jupyter.error"]',
    '.jp-OutputArea-output[data-mime-type="application/vnd.jupyter.error"]',
)

RUN_CELL = """([number, wait]) => {
  const {content} = window.jupyterapp.shell.currentWidget;
  const code = content.widgets.flatMap((cell, i) => cell.model.type === 'code' ? [i] : []);
  content.activeCellIndex = code[number];
  content.deselectAll();
  const done = window.jupyterapp.commands.execute('notebook:run-cell');
  return wait ? done.then(() => null) : null;
}"""

EXECUTE = f"""async code => {{
  const future = {KERNEL}.requestExecute({{code, store_history: false}});
  const said = {{text: '', error: null}};
  future.onIOPub = ({{header, content}}) => {{
    if (header.msg_type === 'stream') said.text += content.text;
    if (header.msg_type === 'execute_result') said.text += content.data['text/plain'];
    if (header.msg_type === 'error') said.error = content.ename + ': ' + content.evalue;
  }};
  await future.done;
  return said;
}}"""

# A fingerprint of what an element shows: the pixels of a canvas or an image, the markup of an SVG.
# A canvas is copied, not asked for its context: asking would make one of the wrong kind. A WebGL
# canvas must keep its drawing buffer for that, as pythreejs' does.
# `drawn` counts what differs from the first pixel (elements, for an SVG): 0 is an empty picture.
FINGERPRINT = """node => {
  const kind = node.tagName.toLowerCase(), picture = kind === 'canvas' || kind === 'img';
  const box = node.getBoundingClientRect();
  const width = picture ? node.naturalWidth ?? node.width : Math.round(box.width);
  const height = picture ? node.naturalHeight ?? node.height : Math.round(box.height);
  const hash = values => values.reduce((h, x) => Math.imul(h ^ x, 0x01000193) >>> 0, 0x811c9dc5);
  if (!picture) {
    const markup = new TextEncoder().encode(node.outerHTML);
    return {drawn: node.querySelectorAll('*').length, hash: hash(markup), width, height};
  }
  if (!width || !height) return {drawn: 0, hash: 0, width, height};
  const copy = new OffscreenCanvas(width, height).getContext('2d', {willReadFrequently: true});
  copy.drawImage(node, 0, 0);
  const pixels = new Uint32Array(copy.getImageData(0, 0, width, height).data.buffer);
  const drawn = pixels.reduce((n, x) => n + (x !== pixels[0]), 0);
  return {drawn, hash: hash(pixels), width, height};
}"""


# What sticks out of its output to the right, as far as it can be seen; an empty list is a good page
STICKS_OUT = """() => [...document.querySelectorAll('.jp-OutputArea-output')].flatMap(output => {
  const right = output.getBoundingClientRect().right + 1;
  const tell = node => [...node.classList, node.tagName].join('.');
  const found = output.scrollWidth > output.clientWidth ? ['scrolls: ' + tell(output)] : [];
  for (const node of output.querySelectorAll('*')) {
    const box = node.getBoundingClientRect();
    if (!node.checkVisibility() || node.closest('svg svg, defs, .rl-hidden, .MathJax')) continue;
    if (box.width > 1 && box.right > right) found.push(tell(node) + ' by ' + (box.right - right));
  }
  return found;
})"""

# What axe-core finds wrong for people who see badly, or hear a page, or use its keys
BARRIERS = """async () => {
  const found = [];
  for (const app of document.querySelectorAll('.ruledlab')) {
    app.scrollIntoView();
    await new Promise(done => setTimeout(done, 300));
    const {violations} = await axe.run(app, {resultTypes: ['violations']});
    found.push(...violations.flatMap(({id, nodes}) => nodes.map(node =>
      `${id}: ${node.html.slice(0, 200)}: ${node.failureSummary}`)));
  }
  return found;
}"""

# The controls whose names a screen reader says
CONTROL_ROLES = ("button", "slider", "textbox", "combobox", "checkbox", "spinbutton")


def write_notebook(path: Path, *cells: str) -> Path:
    """Write a notebook of code cells."""
    import nbformat

    kernelspec = {"name": "python3", "display_name": "Python 3", "language": "python"}
    made = nbformat.v4.new_notebook(metadata={"kernelspec": kernelspec})
    made.cells = [nbformat.v4.new_code_cell(source) for source in cells]
    nbformat.write(made, path)
    return path


def find_chromium() -> str | None:
    """The browser: `RULEDLAB_CHROMIUM`, one on the path, or playwright's own."""
    if named := os.environ.get(CHROMIUM):
        return named if os.access(named, os.X_OK) else None
    for name in CHROMIUM_NAMES:
        if path := shutil.which(name):
            return path
    return _playwrights_own()


def _playwrights_own() -> str | None:
    if find_spec("playwright") is None:
        return None
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        path = playwright.chromium.executable_path
    return path if os.path.exists(path) else None


def why_not() -> str | None:
    """Why browser tests cannot run here, or None if they can."""
    for module in ("jupyterlab", "playwright", "axe_playwright_python"):
        if find_spec(module) is None:
            return f"{module} is not installed"
    if find_chromium() is None:
        return f"no Chromium found: install one, or name it by {CHROMIUM}"
    return None


# ------------------------------------------------------------------------------------ the server


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _server_command(root: Path, port: int) -> list[str]:
    return [
        *(sys.executable, "-m", "jupyterlab", "--allow-root", "--no-browser"),
        *(f"--port={port}", "--ServerApp.ip=127.0.0.1", "--ServerApp.port_retries=0"),
        *("--IdentityProvider.token=", "--ServerApp.password="),
        *("--ServerApp.disable_check_xsrf=True", f"--ServerApp.root_dir={root}"),
        *("--LabApp.expose_app_in_browser=True", "--LabApp.news_url=None"),
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]


def _server_environment(scratch: Path) -> dict[str, str]:
    """Nobody's settings but the defaults. Extensions are found beside the interpreter."""
    no_question = {"@jupyterlab/apputils-extension:notification": {"fetchNews": "false"}}
    defaults = scratch / "config" / "labconfig" / "default_setting_overrides.json"
    defaults.parent.mkdir(parents=True)
    defaults.write_text(json.dumps(no_question))  # else one about news covers part of the page
    own = {
        "JUPYTER_CONFIG_DIR": "config",
        "JUPYTER_RUNTIME_DIR": "runtime",
        "JUPYTERLAB_SETTINGS_DIR": "settings",
        "JUPYTERLAB_WORKSPACES_DIR": "workspaces",
        "IPYTHONDIR": "ipython",
    }
    return {**os.environ, **{name: str(scratch / folder) for name, folder in own.items()}}


@contextmanager
def jupyterlab_server(root: Path, scratch: Path) -> Iterator[str]:
    """Serve `root` without a token on this machine alone; yield the address, end the server."""
    port, log = _free_port(), scratch / "jupyterlab.log"
    with log.open("w") as output:
        server = subprocess.Popen(
            _server_command(root, port),
            env=_server_environment(scratch),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        url = f"http://127.0.0.1:{port}"
        _wait_for_server(server, url, log)
        yield url
    finally:
        server.terminate()  # it ends its kernels, too
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()


def _wait_for_server(server: subprocess.Popen[bytes], url: str, log: Path) -> None:
    end = time.monotonic() + 60
    while time.monotonic() < end:
        if server.poll() is not None:
            break
        try:
            with urllib.request.urlopen(f"{url}/api/status", timeout=1):
                return
        except OSError:
            time.sleep(0.1)
    raise RuntimeError(f"JupyterLab did not start:\n{log.read_text()[-3000:]}")


# -------------------------------------------------------------------------------------- the page


@dataclass(frozen=True, slots=True)
class Pixels:
    """A fingerprint of a picture; equal fingerprints mean equal pictures."""

    drawn: int
    hash: int
    width: int
    height: int


class KernelError(AssertionError):
    """Code run by `NotebookPage.kernel_exec` raised."""


@dataclass(eq=False)
class NotebookPage:
    """One open notebook."""

    page: Page
    name: str
    _console: list[str] = field(default_factory=list)

    # --- cells and the kernel

    def run_all(self, timeout: float = 120) -> list[str]:
        """Run every cell; return what went to stderr and every error shown."""
        self.wait_idle(timeout)
        self.page.set_default_timeout(timeout * 1e3)
        self.command("notebook:run-all-cells")  # over when the last cell has finished
        self.wait_idle(timeout)
        self.page.set_default_timeout(20_000)  # what a reader does is over sooner
        return self.errors()

    def command(self, name: str, **arguments: Any) -> None:
        """Execute one of JupyterLab's commands and wait for its end."""
        self.page.evaluate(
            "([name, args]) => window.jupyterapp.commands.execute(name, args).then(() => null)",
            [name, arguments],
        )

    def run_cell(self, number: int, *, wait: bool = True) -> None:
        """Run one code cell again, as Shift+Enter does; without `wait` it goes on meanwhile."""
        if wait:
            self.wait_idle()
        self.page.evaluate(RUN_CELL, [number, wait])

    def running(self, number: int) -> bool:
        """Whether a code cell is running; the kernel's status tells of widgets' messages, too."""
        prompt = self.page.locator(".jp-CodeCell .jp-InputPrompt").nth(number)
        return "*" in prompt.inner_text()

    def wait_cell(self, number: int, timeout: float = 60) -> None:
        """Wait until a code cell has run."""
        end = time.monotonic() + timeout
        while self.running(number):
            assert time.monotonic() < end, f"cell {number} still runs after {timeout} s"
            self.page.wait_for_timeout(50)

    def errors(self) -> list[str]:
        """Every error and every line of stderr the notebook shows now."""
        return self.page.locator(", ".join(ERRORS)).all_inner_texts()

    def wait_idle(self, timeout: float = 60) -> None:
        """Wait until the kernel has nothing to do."""
        idle = f"() => {{ try {{ return {KERNEL}.status === 'idle' }} catch {{ return false }} }}"
        self.page.wait_for_function(idle, timeout=timeout * 1e3)

    def kernel_exec(self, code: str) -> str:
        """Run `code` in the notebook's kernel; return what it printed and its last value."""
        said = self.page.evaluate(EXECUTE, code)
        if said["error"]:
            raise KernelError(said["error"])
        return str(said["text"])

    def wait_kernel(self, code: str, value: str, timeout: float = 10) -> None:
        """Wait until `code` says `value`: what a control sends arrives a moment later."""
        end, said = time.monotonic() + timeout, None
        while time.monotonic() < end:
            if (said := self.kernel_exec(code)) == value:
                return
            self.page.wait_for_timeout(50)
        raise AssertionError(f"{code} is {said}, not {value}, after {timeout} s")

    # --- pictures

    def locator(self, target: str | Locator, nth: int = 0) -> Locator:
        """The `nth` element for a CSS selector (or playwright's own kind); a locator as it is."""
        return self.page.locator(target).nth(nth) if isinstance(target, str) else target

    def pixels(self, target: str | Locator = THREE, nth: int = 0) -> Pixels:
        """A fingerprint of a WebGL or 2D canvas, an img, or an SVG (its markup)."""
        return Pixels(**self.locator(target, nth).evaluate(FINGERPRINT))

    def wait_still(
        self,
        target: str | Locator = THREE,
        nth: int = 0,
        *,
        timeout: float = 15,
        quiet: float = 0.3,
    ) -> Pixels:
        """Wait until something is drawn and has not changed for `quiet` seconds."""
        blank = Pixels(0, 0, 0, 0)
        return self.wait_change(blank, target, nth, timeout=timeout, quiet=quiet)

    def wait_change(
        self,
        old: Pixels,
        target: str | Locator = THREE,
        nth: int = 0,
        *,
        timeout: float = 10,
        quiet: float = 0.15,
    ) -> Pixels:
        """Wait until the picture differs from `old` and is still for `quiet` seconds."""
        element = self.locator(target, nth)
        element.wait_for(state="attached", timeout=timeout * 1e3)
        end, last, since = time.monotonic() + timeout, old, 0.0
        while (now := time.monotonic()) < end:
            seen = self.pixels(element)
            if seen != last:
                last, since = seen, now
            elif last != old and last.drawn and now - since >= quiet:
                return last
            self.page.wait_for_timeout(20)
        raise AssertionError(f"{target} did not change and settle within {timeout} s: {last}")

    def wait_same(
        self, old: Pixels, target: str | Locator = THREE, nth: int = 0, *, timeout: float = 30
    ) -> None:
        """Wait until the picture is `old`, to the pixel, and stays so for a moment."""
        element = self.locator(target, nth)
        element.wait_for(state="attached", timeout=timeout * 1e3)
        end, since, seen = time.monotonic() + timeout, None, old
        while (now := time.monotonic()) < end:
            seen = self.pixels(element)
            since = (since or now) if seen == old else None
            if since and now - since >= 0.15:
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"{target} is not as it was after {timeout} s: {seen}, not {old}")

    def stays(
        self, old: Pixels, target: str | Locator = THREE, nth: int = 0, *, over: float = 1.0
    ) -> bool:
        """Whether the picture is the same as `old` all through `over` seconds."""
        end = time.monotonic() + over
        while time.monotonic() < end:
            if self.pixels(target, nth) != old:
                return False
            self.page.wait_for_timeout(50)
        return True

    def screenshot(self, name: str, target: str | Locator | None = None) -> Path:
        """Write ``artifacts/<name>.png``: the page, or one element with all that belongs to it."""
        ARTIFACTS.mkdir(exist_ok=True)
        path = ARTIFACTS / f"{name}.png"
        (self.page if target is None else self.locator(target)).screenshot(path=str(path))
        return path

    # --- the page around

    def dark(self, dark: bool = True) -> None:
        """Change JupyterLab's theme."""
        theme = "JupyterLab Dark" if dark else "JupyterLab Light"
        self.command("apputils:change-theme", theme=theme)
        told = f"() => document.body.dataset.jpThemeLight === '{str(not dark).lower()}'"
        self.page.wait_for_function(told)

    def resize(self, width: int, height: int) -> None:
        """Change the size of the browser's window."""
        self.page.set_viewport_size({"width": width, "height": height})

    def sticks_out(self) -> list[str]:
        """What is wider than the output it stands in."""
        return list(self.page.evaluate(STICKS_OUT))

    def barriers(self) -> list[str]:
        """What axe-core finds in the apps, in the light and in the dark theme."""
        self.page.evaluate((files("axe_playwright_python") / "axe.min.js").read_text("utf-8"))
        found = []
        for dark in (True, False):
            self.dark(dark)
            self.page.wait_for_timeout(700)  # colours change by and by
            found += [f"dark={dark}: {line}" for line in self.page.evaluate(BARRIERS)]
        return found

    def faults(self) -> list[str]:
        """All that must not be on a page: errors, barriers, what sticks out."""
        return [*self.errors(), *self.console_errors, *self.sticks_out(), *self.barriers()]

    def control_names(self, root: str) -> list[tuple[str, str]]:
        """Role and name of every control in the first `root`, as the browser tells assistants."""
        browser = self.page.context.new_cdp_session(self.page)
        top = browser.send("DOM.getDocument")["root"]["nodeId"]
        found = browser.send("DOM.querySelector", {"nodeId": top, "selector": root})
        names = []
        for role in CONTROL_ROLES:
            query = {"nodeId": found["nodeId"], "role": role}
            for node in browser.send("Accessibility.queryAXTree", query)["nodes"]:
                if not node["ignored"]:
                    names.append((role, str(node.get("name", {}).get("value", "")).strip()))
        browser.detach()
        return names

    # --- hands

    def press(self, target: str | Locator, key: str, times: int = 1, nth: int = 0) -> None:
        """Focus an element and press a key."""
        element = self.locator(target, nth)
        element.scroll_into_view_if_needed()
        element.focus()
        for _ in range(times):
            self.page.keyboard.press(key)

    def move_slider(self, steps: int = 1, nth: int = 0) -> None:
        """Move the `nth` slider of ipywidgets by arrow keys."""
        key = "ArrowRight" if steps > 0 else "ArrowLeft"
        self.press(".widget-slider .noUi-handle", key, abs(steps), nth)

    def type_into(self, target: str | Locator, text: str, nth: int = 0, enter: bool = True) -> None:
        """Replace the text of a field, as a reader would, and press Enter."""
        element = self.locator(target, nth)
        element.scroll_into_view_if_needed()
        element.click()
        self.page.keyboard.press("ControlOrMeta+a")
        self.page.keyboard.type(text)
        if enter:
            self.page.keyboard.press("Enter")

    def drag(
        self, target: str | Locator, by: tuple[float, float], *, steps: int = 8, nth: int = 0
    ) -> None:
        """Drag an element from its middle by so many pixels (right, down)."""
        element = self.locator(target, nth)
        element.scroll_into_view_if_needed()
        box = element.bounding_box()
        assert box is not None, f"{target} is not visible"
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + by[0], y + by[1], steps=steps)
        self.page.mouse.up()

    def handle(self, name: str) -> tuple[float, float]:
        """Where the middle of a handle over a picture is on the page."""
        touch = self.page.get_by_role("button", name=name).first.locator(".rl-touch")
        touch.scroll_into_view_if_needed()
        box = touch.bounding_box()
        assert box is not None
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def pull(self, name: str, by: tuple[float, float]) -> tuple[float, float]:
        """Drag a handle; return how far it stays behind the pointer."""
        x, y = self.handle(name)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + by[0], y + by[1], steps=8)
        self.page.wait_for_timeout(400)
        now = self.handle(name)
        self.page.mouse.up()
        return now[0] - x - by[0], now[1] - y - by[1]

    def download(self, button: str | Locator) -> tuple[str, bytes]:
        """Press a button that saves a file; return the file's name and content."""
        with self.page.expect_download() as waiting:
            self.locator(button).click()
        return waiting.value.suggested_filename, Path(waiting.value.path()).read_bytes()

    # --- the console

    @property
    def console_errors(self) -> list[str]:
        """Errors in the browser's console that are not among the known ones."""
        known = re.compile("|".join(KNOWN_CONSOLE_LINES))
        return [line for line in self._console if not known.search(line)]

    def forget_console(self) -> None:
        """Count errors from here on."""
        self._console.clear()


# ----------------------------------------------------------------------------------- the session


@dataclass(eq=False)
class LabSession:
    """One JupyterLab and one browser; each notebook gets a page of its own."""

    url: str
    root: Path
    browser: Browser
    viewport: tuple[int, int] = (1400, 1000)
    _open: dict[str, tuple[NotebookPage, BrowserContext]] = field(default_factory=dict)

    @property
    def pages(self) -> list[NotebookPage]:
        """The notebooks that are open."""
        return [page for page, _ in self._open.values()]

    def open_notebook(self, path: Path, **context: Any) -> NotebookPage:
        """Open a copy of the notebook at `path`; `context` goes to playwright's new_context."""
        name = f"{len(list(self.root.iterdir())):02d}-{path.name}"
        shutil.copyfile(path, self.root / name)
        width, height = self.viewport
        options = {"viewport": {"width": width, "height": height}, **context}
        browser_context = self.browser.new_context(**options)
        page = browser_context.new_page()
        notebook = NotebookPage(page, name)
        self._open[name] = (notebook, browser_context)
        page.on("console", lambda said: _note(notebook, said.type, said.text))
        page.on("pageerror", lambda error: _note(notebook, "error", error.stack or str(error)))
        page.goto(f"{self.url}/lab/tree/{name}?reset", wait_until="domcontentloaded")
        ready = "() => window.jupyterapp && document.querySelector('.jp-Notebook .jp-Cell')"
        page.wait_for_function(ready, timeout=60_000)
        page.evaluate("() => window.jupyterapp.restored.then(() => null)")
        return notebook

    @contextmanager
    def notebook(self, path: Path, **context: Any) -> Iterator[NotebookPage]:
        """Open a notebook for the length of a block."""
        opened = self.open_notebook(path, **context)
        try:
            yield opened
        finally:
            self.close(opened)

    def close(self, notebook: NotebookPage) -> None:
        """Close a notebook's page and end its kernel."""
        _, context = self._open.pop(notebook.name)
        context.close()
        for session in self._api("GET", "sessions"):
            if session["path"] == notebook.name:
                self._api("DELETE", f"sessions/{session['id']}")

    def close_all(self) -> None:
        """Close every notebook that is still open."""
        for notebook in self.pages:
            self.close(notebook)

    def _api(self, method: str, path: str) -> list[Mapping[str, Any]]:
        request = urllib.request.Request(f"{self.url}/api/{path}", method=method)
        with urllib.request.urlopen(request, timeout=30) as answer:
            body = answer.read()
        return json.loads(body) if body else []


def _note(notebook: NotebookPage, kind: str, text: str) -> None:
    if kind == "error":
        notebook._console.append(text[:500])


@contextmanager
def lab_session(scratch: Path) -> Iterator[LabSession]:
    """Start a server and a browser; end both."""
    from playwright.sync_api import sync_playwright

    root = scratch / "notebooks"
    root.mkdir(parents=True)
    with jupyterlab_server(root, scratch) as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=find_chromium(), args=list(CHROMIUM_ARGUMENTS)
        )
        session = LabSession(url, root, browser)
        try:
            yield session
        finally:
            session.close_all()
            browser.close()


# ------------------------------------------------------------------------------------ the studio

STUDIO = """\
import math
from ruledlab.design import Design
from ruledlab.lab import example, studio

s = studio()
s
"""

OPENING = "[s.lab.design == example('example_2'), s.lab.can_undo, float(s.lab.result.pitch.dual)]"

# Back to the start, whatever a test has left; first another design, so that everything is drawn
RESET = """\
s.lab.load(example("cone"), "test")
s.lab.load(example("example_2"), "test")
s.lab.choose(0)
s.lab.move_cursor(0.0)
s.lab.colour("plain")
"""


@dataclass(frozen=True, slots=True)
class Pictures:
    """What the studio shows: the 3D canvas and the plots."""

    space: Pixels
    plots: Pixels


@dataclass(eq=False)
class StudioPage:
    """A studio in an open notebook, called ``s`` in its kernel, and a reader's hands on it."""

    notebook: NotebookPage
    opening: list[Any]  # what OPENING said when everything had been drawn for the first time
    home: Pictures  # Example 2 as it comes; the axes of the plots may keep wider limits

    @property
    def page(self) -> Page:
        return self.notebook.page

    def kernel(self, code: str) -> str:
        """What `code` says in the kernel."""
        return self.notebook.kernel_exec(code)

    def wait_kernel(self, code: str, value: str) -> None:
        """Wait until `code` says `value`."""
        self.notebook.wait_kernel(code, value, timeout=20)

    def design(self) -> dict[str, Any]:
        """The entries of the lab's design; JSON keeps every float as it is."""
        design: dict[str, Any] = json.loads(self.kernel("print(s.lab.design.to_json())"))
        return design

    def reset(self) -> None:
        """Return to Example 2 and wait until it is on the screen."""
        # A run of keys ends with a last message as the focus goes; it must not come after.
        self.page.evaluate("() => document.activeElement?.blur()")
        self.page.wait_for_timeout(100)
        self.kernel(RESET)
        self.notebook.wait_same(self.home.space, THREE)
        self.home = Pictures(self.home.space, self.notebook.wait_still(PLOTS))

    def control(self, role: Any, name: str) -> Locator:
        """A control by the name that a screen reader says; `name` need only be a part of it."""
        return self.page.locator(".ruledlab").get_by_role(role, name=name).first

    def button(self, words: str) -> Locator:
        """A button by its words."""
        return self.control("button", words)

    def unfold(self, words: str) -> None:
        """Open one of the folds at the foot."""
        head = self.button(words)
        if head.get_attribute("aria-expanded") != "true":
            head.click()

    def alerts(self) -> list[str]:
        """Every message on show that is an error."""
        shown = self.page.locator(".ruledlab").get_by_role("alert").all_inner_texts()
        return [text.strip() for text in shown if text.strip()]

    def look(self) -> Pictures:
        """Both pictures, once they stand still."""
        return Pictures(self.notebook.wait_still(THREE), self.notebook.wait_still(PLOTS))

    def wait_new(self, old: Pictures) -> Pictures:
        """Wait until both pictures have changed and stand still."""
        space = self.notebook.wait_change(old.space, THREE, timeout=30)
        return Pictures(space, self.notebook.wait_change(old.plots, PLOTS, timeout=30))

    def wait_back(self, old: Pictures) -> None:
        """Wait until both pictures are, to the pixel, what they were."""
        self.notebook.wait_same(old.space, THREE)
        self.notebook.wait_same(old.plots, PLOTS)

    def stays(self, old: Pictures, over: float = 0.4) -> bool:
        """Whether both pictures are the same as `old` all through `over` seconds."""
        return self.notebook.stays(old.space, THREE, over=over) and self.notebook.stays(
            old.plots, PLOTS, over=0.1
        )
