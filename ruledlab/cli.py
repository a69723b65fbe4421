"""The ``ruledlab`` command: open the lessons, copy them out, check the set-up.

Errors are one line on standard error with exit code 2.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

FIRST_LESSON = "00_start_here.ipynb"
DEFAULT_DIRECTORY = Path("my-lessons")
FIRST_PORT = 8888
START_SECONDS = 60.0

EXIT_OK, EXIT_MISSING, EXIT_ERROR = 0, 1, 2


class CommandError(Exception):
    """Something the reader can put right; its text is the whole message."""


# ---------------------------------------------------------------------------------- the lessons


@dataclass(frozen=True, slots=True)
class CopyReport:
    """What `copy_lessons` did, as paths relative to the directory.

    Attributes
    ----------
    written : tuple of Path
        Lessons that were not there.
    same : tuple of Path
        Lessons that were there and say the same; left alone.
    kept : tuple of Path
        Lessons that were there and say something else; left alone.
    fresh : tuple of Path
        New copies written beside the kept ones, on request.
    """

    written: tuple[Path, ...] = ()
    same: tuple[Path, ...] = ()
    kept: tuple[Path, ...] = ()
    fresh: tuple[Path, ...] = ()


def find_lessons() -> Path:
    """Return the directory with the lessons as shipped.

    Returns
    -------
    Path
        ``ruledlab/_lessons`` in an installed package, ``lessons`` beside it in a checkout.

    Raises
    ------
    CommandError
        If neither is there.
    """
    package = Path(__file__).resolve().parent
    for place in (package / "_lessons", package.parent / "lessons"):
        if any(place.glob("*.ipynb")):
            return place
    raise CommandError(f"no lessons found beside {package}; install ruledlab again")


def copy_lessons(source: Path, target: Path, *, fresh: bool = False) -> CopyReport:
    """Copy the lessons to `target`; a file that is there is never overwritten.

    Parameters
    ----------
    source : Path
        Where the lessons are, see `find_lessons`.
    target : Path
        The reader's directory; made if missing.
    fresh : bool
        Also write a new copy, ``name (fresh copy).ipynb``, beside each lesson that differs.

    Returns
    -------
    CopyReport
        What was written, left alone and kept.

    Raises
    ------
    CommandError
        If `target` is not a directory, or is the directory of the lessons as shipped.
    """
    if target.exists() and not target.is_dir():
        raise CommandError(f"`DIR` must be a directory; {target} is a file, choose another name")
    if target.resolve() == source.resolve():
        raise CommandError(f"`DIR` must not be the lessons as shipped ({target}); choose another")
    report = CopyReport()
    for lesson in _files(source):
        report = _copy_one(source, target, lesson.relative_to(source), fresh, report)
    return report


def same_lesson(one: Path, other: Path) -> bool:
    """Say whether two files are the same lesson.

    Parameters
    ----------
    one, other : Path
        The files. Notebooks are compared by the text of their cells, because running and saving
        one changes its outputs and metadata; other files by their bytes.

    Returns
    -------
    bool
        True if nothing of the reader's own is in one of them.
    """
    if one.read_bytes() == other.read_bytes():
        return True
    if one.suffix != ".ipynb":
        return False
    try:
        return _cell_texts(one) == _cell_texts(other)
    except (ValueError, LookupError, TypeError, AttributeError):  # not a notebook any more
        return False


def _files(source: Path) -> Iterator[Path]:
    for path in sorted(source.rglob("*")):
        hidden = any(part.startswith((".", "__")) for part in path.relative_to(source).parts)
        if path.is_file() and not hidden:
            yield path


def _copy_one(
    source: Path, target: Path, name: Path, fresh: bool, report: CopyReport
) -> CopyReport:
    shipped, theirs = source / name, target / name
    if not theirs.exists():
        _write_copy(shipped, theirs)
        return replace(report, written=(*report.written, name))
    if theirs.is_file() and same_lesson(shipped, theirs):
        return replace(report, same=(*report.same, name))
    report = replace(report, kept=(*report.kept, name))
    beside = _fresh_name(shipped, theirs) if fresh else None
    if beside is None:
        return report
    _write_copy(shipped, beside)
    return replace(report, fresh=(*report.fresh, beside.relative_to(target)))


def _write_copy(shipped: Path, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    shutil.copyfile(shipped, part)
    part.replace(path)  # a full disk leaves no half lesson under the lesson's name


def _fresh_name(shipped: Path, theirs: Path) -> Path | None:
    """Return a free name beside `theirs`; None where an untouched fresh copy is there already."""
    number = 1
    while True:
        label = "fresh copy" if number == 1 else f"fresh copy {number}"
        path = theirs.with_name(f"{theirs.stem} ({label}){theirs.suffix}")
        if not path.exists():
            return path
        if same_lesson(shipped, path):
            return None
        number += 1


def _cell_texts(path: Path) -> list[tuple[str, str]]:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [(cell["cell_type"], "".join(cell["source"])) for cell in cells]


def describe(report: CopyReport, target: Path) -> str:
    """Return `report` in words, a line for each thing that happened.

    Parameters
    ----------
    report : CopyReport
        What `copy_lessons` returned.
    target : Path
        The directory it was called with.

    Returns
    -------
    str
        At least one line.
    """
    lines = []
    if report.written:
        lines.append(f"{target}: {_names(report.written)} copied")
    if report.same:
        lines.append(f"{target}: {_names(report.same)} already there")
    for name in report.kept:
        lines.append(f"kept yours: {target / name} differs from the lesson as shipped")
    for name in report.fresh:
        lines.append(f"written beside it: {target / name}")
    if report.kept and not report.fresh:
        lines.append(f'a new copy beside yours: ruledlab lessons --fresh "{target}"')
    return "\n".join(lines)


def _names(paths: Sequence[Path]) -> str:
    return str(paths[0]) if len(paths) == 1 else f"{len(paths)} files"


# -------------------------------------------------------------------------------------- the lab


def has_display(environment: Mapping[str, str] = os.environ, system: str = sys.platform) -> bool:
    """Say whether a browser window can be expected to open here.

    Parameters
    ----------
    environment : mapping
        The environment variables.
    system : str
        As `sys.platform`.

    Returns
    -------
    bool
        On macOS and Windows True; elsewhere whether there is an X or Wayland display.
    """
    if system in ("darwin", "win32", "cygwin"):
        return True
    return bool(environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))


def server_command(root: Path, ip: str, port: int, *, browser: bool) -> list[str]:
    """Return the command line that serves `root` by JupyterLab.

    The token is not part of it (other users of a machine can read command lines): it goes by the
    environment variable ``JUPYTER_TOKEN``.

    Parameters
    ----------
    root : Path
        The directory to serve.
    ip : str
        The address to listen on.
    port : int
        The port; another one is not tried, because the address is announced.
    browser : bool
        Whether JupyterLab shall open the reader's browser.

    Returns
    -------
    list of str
        To be run without a shell.
    """
    command = [sys.executable, "-m", "jupyterlab", f"--ServerApp.root_dir={root}"]
    command += [f"--ServerApp.ip={ip}", f"--ServerApp.port={port}", "--ServerApp.port_retries=0"]
    command += [f"--LabApp.default_url=/lab/tree/{FIRST_LESSON}", "--LabApp.log_level=WARN"]
    command += ["--ServerApp.log_level=WARN"]
    command += ["--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    command += [f"--ServerApp.open_browser={browser}", "--ServerApp.answer_yes=True"]
    if getattr(os, "geteuid", lambda: 1)() == 0:
        command.append("--allow-root")  # containers; it listens on this machine alone by default
    return command


def free_port(ip: str, first: int = FIRST_PORT, tries: int = 50) -> int:
    """Return the first free port from `first` on.

    Parameters
    ----------
    ip : str
        The address to listen on.
    first : int
        Where to begin.
    tries : int
        How many to try.

    Returns
    -------
    int
        A port nobody listened on a moment ago.

    Raises
    ------
    CommandError
        If there is none, or `ip` is not an address of this machine.
    """
    problem: OSError | OverflowError | None = None
    for port in range(first, first + tries):
        with socket.socket() as probe:
            try:
                probe.bind((ip, port))
            except (OSError, OverflowError) as error:
                problem = error
            else:
                return port

    ports = f"port {first}" if tries == 1 else f"none of the ports from {first} on"
    raise CommandError(f"{ports} can be used at {ip}: {problem}; choose another by `--port`")


def open_lab(directory: Path, ip: str, port: int | None, *, browser: bool) -> int:
    """Serve `directory` by JupyterLab until interrupted.

    Parameters
    ----------
    directory : Path
        The reader's working copy of the lessons.
    ip : str
        The address to listen on.
    port : int or None
        The port; None takes the first free one from 8888 on.
    browser : bool
        Whether to open the reader's browser. The full address is printed in either case.

    Returns
    -------
    int
        The exit code.

    Raises
    ------
    CommandError
        If JupyterLab is missing or does not start.
    """
    if importlib.util.find_spec("jupyterlab") is None:
        raise CommandError("JupyterLab is missing; `ruledlab check` says what to install")
    port = free_port(ip) if port is None else free_port(ip, port, tries=1)
    token = secrets.token_urlsafe(24)
    command = server_command(directory.resolve(), ip, port, browser=browser)
    host = "127.0.0.1" if ip in ("0.0.0.0", "") else ip
    with _environment(token) as environment, _running(command, environment) as server:
        _wait_until_up(server, f"http://{host}:{port}/api")
        print(
            f"JupyterLab is running; the address, token included:\n\n    "
            f"http://{host}:{port}/lab/tree/{FIRST_LESSON}?token={token}\n\n"
            "Ctrl-C here ends it.",
            flush=True,
        )
        return server.wait()
    return EXIT_OK


@contextmanager
def _environment(token: str) -> Iterator[dict[str, str]]:
    """Yield the server's environment: the token, and one default that the reader can change."""
    with tempfile.TemporaryDirectory(prefix="ruledlab-") as scratch:
        defaults = Path(scratch, "labconfig", "default_setting_overrides.json")
        defaults.parent.mkdir()
        # or JupyterLab's question about its news lies over the first lesson
        no_question = {"@jupyterlab/apputils-extension:notification": {"fetchNews": "false"}}
        defaults.write_text(json.dumps(no_question), encoding="utf-8")
        paths = [scratch, os.environ.get("JUPYTER_CONFIG_PATH", "")]
        config = os.pathsep.join(path for path in paths if path)
        yield {**os.environ, "JUPYTER_TOKEN": token, "JUPYTER_CONFIG_PATH": config}


@contextmanager
def _running(
    command: Sequence[str], environment: Mapping[str, str]
) -> Iterator[subprocess.Popen[bytes]]:
    """Run `command`; end it with this block, also on Ctrl-C and on a request to terminate."""
    before = signal.signal(signal.SIGTERM, lambda *_: sys.exit(EXIT_OK))
    server = subprocess.Popen(command, env=dict(environment), stdin=subprocess.DEVNULL)
    try:
        yield server
    except KeyboardInterrupt:
        print("\nJupyterLab is ended; your lessons are saved where you left them.")
    finally:
        server.terminate()
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            server.kill()
        signal.signal(signal.SIGTERM, before)


def _wait_until_up(server: subprocess.Popen[bytes], url: str) -> None:
    end = time.monotonic() + START_SECONDS
    while time.monotonic() < end:
        if server.poll() is not None:
            raise CommandError("JupyterLab ended at once; what it said is above")
        try:
            with urllib.request.urlopen(url, timeout=1):
                return
        except OSError:  # not listening yet (URLError is an OSError)
            time.sleep(0.1)
    raise CommandError(f"JupyterLab did not answer at {url} within {START_SECONDS:.0f} s")


# ---------------------------------------------------------------------------------- the command


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_ERROR, f"{self.prog}: {message}; see {self.prog} --help\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="ruledlab", description="Learn and design ruled surfaces in Jupyter.")
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    parser.set_defaults(run=lambda _: parser.print_help())
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")

    lab = commands.add_parser("lab", help="open JupyterLab on a working copy of the lessons")
    lab.description = (
        "Open JupyterLab on a working copy of the lessons. Lessons that are missing are copied; "
        "files that are there stay as they are. The full address is printed, too."
    )
    _add_directory(lab, nargs="?", default=DEFAULT_DIRECTORY)
    lab.add_argument("--no-browser", action="store_true", help="do not open a browser window")
    lab.add_argument("--port", type=int, help=f"the port (the first free one from {FIRST_PORT})")
    lab.add_argument("--ip", default="127.0.0.1", help="the address to listen on (%(default)s)")
    lab.set_defaults(run=_run_lab)

    lessons = commands.add_parser("lessons", help="copy the lessons to a directory")
    lessons.description = (
        "Copy the lesson notebooks. A file that is already there is never overwritten."
    )
    _add_directory(lessons)
    note = "also write '… (fresh copy).ipynb' beside each lesson that differs"
    lessons.add_argument("--fresh", action="store_true", help=note)
    lessons.set_defaults(run=_run_lessons)

    check = commands.add_parser("check", help="say for each part whether it is ready")
    check.description = "Say for each part whether it is ready; exit code 1 if one is not."
    check.set_defaults(run=_run_check)
    return parser


def _add_directory(parser: argparse.ArgumentParser, **how: object) -> None:
    text = "your copy of the lessons" + (" (./%(default)s)" if "default" in how else "")
    parser.add_argument("directory", metavar="DIR", type=Path, help=text, **how)  # type: ignore[arg-type]


def _run_lab(options: argparse.Namespace) -> int:
    report = copy_lessons(find_lessons(), options.directory)
    print(describe(report, options.directory), flush=True)
    browser = not options.no_browser and has_display()
    return open_lab(options.directory, options.ip, options.port, browser=browser)


def _run_lessons(options: argparse.Namespace) -> int:
    report = copy_lessons(find_lessons(), options.directory, fresh=options.fresh)
    print(describe(report, options.directory))
    return EXIT_OK


def _run_check(_: argparse.Namespace) -> int:
    from ruledlab.setup_check import check_setup

    report = check_setup()
    print(report)
    return EXIT_OK if report.ok else EXIT_MISSING


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the ``ruledlab`` command.

    Parameters
    ----------
    arguments : sequence of str, optional
        The command line after the name; by default that of this process.

    Returns
    -------
    int
        0 for done, 1 for a set-up in which something is missing, 2 for an error.
    """
    options = _parser().parse_args(arguments)
    if options.version:
        options.run = _run_version
    try:
        return options.run(options) or EXIT_OK
    except (CommandError, OSError) as error:
        print(f"ruledlab: {' '.join(str(error).split())}", file=sys.stderr)
        return EXIT_ERROR


def _run_version(_: argparse.Namespace) -> int:
    from ruledlab import __version__

    print(f"ruledlab {__version__}")
    return EXIT_OK


if __name__ == "__main__":
    sys.exit(main())
