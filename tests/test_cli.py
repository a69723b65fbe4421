from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import urllib.error
import urllib.request
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from ruledlab import cli, setup_check


def notebook(*cells: str, **metadata: object) -> str:
    made = [{"cell_type": "markdown", "metadata": {}, "source": [text]} for text in cells]
    return json.dumps({"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})


@pytest.fixture
def shipped(tmp_path: Path) -> Path:
    source = tmp_path / "shipped"
    (source / "pictures").mkdir(parents=True)
    (source / cli.FIRST_LESSON).write_text(notebook("Start"), encoding="utf-8")
    (source / "06_design.ipynb").write_text(notebook("Design"), encoding="utf-8")
    (source / "pictures" / "sphere.svg").write_text("<svg/>", encoding="utf-8")
    (source / ".ipynb_checkpoints").mkdir()
    (source / ".ipynb_checkpoints" / "06_design.ipynb").write_text("{}", encoding="utf-8")
    return source


# ---------------------------------------------------------------------------- copying the lessons


def test_everything_missing_is_copied_but_nothing_hidden(shipped: Path, tmp_path: Path) -> None:
    target = tmp_path / "new" / "mine"
    report = cli.copy_lessons(shipped, target)
    names = {path.relative_to(target).as_posix() for path in target.rglob("*") if path.is_file()}
    assert names == {cli.FIRST_LESSON, "06_design.ipynb", "pictures/sphere.svg"}
    assert {path.as_posix() for path in report.written} == names
    assert not (report.same or report.kept or report.fresh)


def test_a_second_copy_changes_nothing(shipped: Path, tmp_path: Path) -> None:
    target = tmp_path / "mine"
    cli.copy_lessons(shipped, target)
    before = {path: path.stat().st_mtime_ns for path in target.rglob("*")}
    report = cli.copy_lessons(shipped, target, fresh=True)
    assert {path: path.stat().st_mtime_ns for path in target.rglob("*")} == before
    assert len(report.same) == 3
    assert not (report.written or report.kept or report.fresh)


def test_a_changed_lesson_is_kept_and_named(shipped: Path, tmp_path: Path) -> None:
    target = tmp_path / "mine"
    cli.copy_lessons(shipped, target)
    mine = target / "06_design.ipynb"
    mine.write_text(notebook("Design", "my notes"), encoding="utf-8")
    report = cli.copy_lessons(shipped, target)
    assert "my notes" in mine.read_text(encoding="utf-8")
    assert report.kept == (Path("06_design.ipynb"),)
    text = cli.describe(report, target)
    assert f"kept yours: {mine}" in text
    assert "--fresh" in text
    assert (
        sorted(path.name for path in target.glob("*.ipynb")) == [mine.name, cli.FIRST_LESSON][::-1]
    )


def test_fresh_writes_beside_and_never_over(shipped: Path, tmp_path: Path) -> None:
    target = tmp_path / "mine"
    cli.copy_lessons(shipped, target)
    (target / "06_design.ipynb").write_text(notebook("mine"), encoding="utf-8")
    first = cli.copy_lessons(shipped, target, fresh=True)
    assert first.fresh == (Path("06_design (fresh copy).ipynb"),)
    beside = target / first.fresh[0]
    assert beside.read_bytes() == (shipped / "06_design.ipynb").read_bytes()

    assert cli.copy_lessons(shipped, target, fresh=True).fresh == ()  # one is enough
    beside.write_text(notebook("mine too"), encoding="utf-8")
    third = cli.copy_lessons(shipped, target, fresh=True)
    assert third.fresh == (Path("06_design (fresh copy 2).ipynb"),)
    assert "mine too" in beside.read_text(encoding="utf-8")


def test_running_a_lesson_does_not_count_as_a_change(shipped: Path, tmp_path: Path) -> None:
    target = tmp_path / "mine"
    cli.copy_lessons(shipped, target)
    lesson = target / cli.FIRST_LESSON
    saved = json.loads(lesson.read_text(encoding="utf-8"))
    saved["metadata"]["language_info"] = {"name": "python", "version": "3.13.0"}
    saved["cells"][0]["source"] = "".join(saved["cells"][0]["source"])
    lesson.write_text(json.dumps(saved, indent=1), encoding="utf-8")
    assert Path(cli.FIRST_LESSON) in cli.copy_lessons(shipped, target).same


@pytest.mark.parametrize("text", ["", "not a notebook", "[]", '{"cells": 3}', '{"cells": [{}]}'])
def test_a_broken_notebook_is_the_readers_and_kept(
    shipped: Path, tmp_path: Path, text: str
) -> None:
    target = tmp_path / "mine"
    cli.copy_lessons(shipped, target)
    (target / cli.FIRST_LESSON).write_text(text, encoding="utf-8")
    assert cli.copy_lessons(shipped, target).kept == (Path(cli.FIRST_LESSON),)
    assert (target / cli.FIRST_LESSON).read_text(encoding="utf-8") == text


def test_an_interrupted_copy_leaves_no_half_lesson(
    shipped: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def disk_full(source: Path, target: Path) -> None:
        Path(target).write_text("half", encoding="utf-8")
        raise OSError("No space left on device")

    monkeypatch.setattr(cli.shutil, "copyfile", disk_full)
    with pytest.raises(OSError, match="No space"):
        cli.copy_lessons(shipped, tmp_path / "mine")
    assert not list((tmp_path / "mine").glob("*.ipynb"))


def test_the_shipped_lessons_are_no_place_to_work(shipped: Path) -> None:
    with pytest.raises(cli.CommandError, match="as shipped"):
        cli.copy_lessons(shipped, shipped / "." / "pictures" / "..")


# ----------------------------------------------------------------------------------- the command


def run(*arguments: str) -> int:
    try:
        return cli.main(arguments)
    except SystemExit as end:  # argparse's own way out
        return int(end.code or 0)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["fly"], "invalid choice: 'fly'"),
        (["lessons"], "required: DIR"),
        (["lab", "--port", "high"], "invalid int value: 'high'"),
        (["check", "--loudly"], "unrecognized arguments: --loudly"),
    ],
)
def test_a_wrong_command_is_one_line_and_two(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert says in err
    assert err.count("\n") == 1


def test_a_file_in_the_way_is_one_line_and_two(
    shipped: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(cli, "find_lessons", lambda: shipped)
    (tmp_path / "taken").write_text("a file", encoding="utf-8")
    for arguments in (["lessons", str(tmp_path / "taken")], ["lab", str(tmp_path / "taken")]):
        assert run(*arguments) == 2
        err = capsys.readouterr().err
        assert "must be a directory" in err
        assert err.count("\n") == 1
    assert run("lessons", str(tmp_path / "taken" / "below")) == 2  # an OSError
    assert capsys.readouterr().err.count("\n") == 1


def test_lessons_says_what_it_did(
    shipped: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(cli, "find_lessons", lambda: shipped)
    target = str(tmp_path / "mine")
    assert run("lessons", target) == 0
    assert "3 files copied" in capsys.readouterr().out
    assert run("lessons", target) == 0
    assert "3 files already there" in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [[], ["--help"]])
def test_help_names_every_command(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*arguments) == 0
    out = capsys.readouterr().out
    for command in ("lab", "lessons", "check"):
        assert re.search(rf"^\s+{command}\s", out, re.MULTILINE)


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    import ruledlab

    assert run("--version") == 0
    assert capsys.readouterr().out == f"ruledlab {ruledlab.__version__}\n"


def test_the_command_loads_no_widget() -> None:
    heavy = "{'ipywidgets', 'anywidget', 'matplotlib', 'pythreejs', 'IPython', 'jupyterlab'}"
    code = f"import sys, ruledlab.cli; sys.exit(' '.join({heavy} & set(sys.modules)) or 0)"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


# --------------------------------------------------------------------------------------- the lab


@pytest.mark.parametrize(
    ("environment", "system", "expected"),
    [
        ({}, "linux", False),
        ({"DISPLAY": ""}, "linux", False),
        ({"DISPLAY": ":0"}, "linux", True),
        ({"WAYLAND_DISPLAY": "wayland-0"}, "linux", True),
        ({}, "darwin", True),
        ({}, "win32", True),
    ],
)
def test_where_a_browser_can_open(environment: dict[str, str], system: str, expected: bool) -> None:
    assert cli.has_display(environment, system) is expected


def test_a_taken_port_is_passed_over_or_refused() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert cli.free_port("127.0.0.1", port) > port
        with pytest.raises(cli.CommandError, match=f"port {port} .*--port"):
            cli.free_port("127.0.0.1", port, tries=1)


@pytest.mark.parametrize(("ip", "port"), [("127.0.0.1", 70000), ("192.0.2.1", 8888)])
def test_an_impossible_address_is_one_line(ip: str, port: int) -> None:
    with pytest.raises(cli.CommandError) as caught:
        cli.free_port(ip, port, tries=1)
    assert "\n" not in str(caught.value)


def test_the_token_is_not_on_the_command_line() -> None:
    command = cli.server_command(Path("lessons"), "127.0.0.1", 1, browser=False)
    assert "token" not in " ".join(command).lower()


NOTIFICATIONS = "@jupyterlab/apputils-extension:notification"


@pytest.mark.skipif(os.name == "nt", reason="ends the server by a POSIX signal")
@pytest.mark.parametrize("ending", ["SIGTERM", "SIGINT"])
def test_without_a_display_the_full_address_is_printed_and_works(
    shipped: Path, tmp_path: Path, ending: str
) -> None:
    pytest.importorskip("jupyterlab")
    target = tmp_path / "mine"
    code = (
        "import pathlib, sys, ruledlab.cli as cli; "
        f"cli.find_lessons = lambda: pathlib.Path({str(shipped)!r}); "
        f"sys.exit(cli.main(['lab', {str(target)!r}]))"
    )
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    environment |= {"JUPYTER_CONFIG_DIR": str(tmp_path), "JUPYTER_RUNTIME_DIR": str(tmp_path)}
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    watchdog = threading.Timer(90, process.kill)
    watchdog.start()
    try:
        assert process.stdout is not None
        url = next(line.strip() for line in process.stdout if line.strip().startswith("http"))
        assert url.partition("?")[0].endswith(f"/lab/tree/{cli.FIRST_LESSON}")
        contents = url.replace("/lab/tree/", "/api/contents/")
        with urllib.request.urlopen(contents, timeout=30) as answer:
            assert json.load(answer)["content"]["cells"][0]["source"] == "Start"
        settings = url.replace("lab/tree/" + cli.FIRST_LESSON, "lab/api/settings/" + NOTIFICATIONS)
        with urllib.request.urlopen(settings, timeout=30) as answer:
            assert json.load(answer)["schema"]["properties"]["fetchNews"]["default"] == "false"
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(contents.partition("?")[0], timeout=30)
        process.send_signal(getattr(signal, ending))
        assert process.wait(20) == 0
        with pytest.raises(OSError, match="refused"):
            urllib.request.urlopen(url, timeout=5)
    finally:
        watchdog.cancel()
        process.kill()
        _, said = process.communicate()
    assert "not recognized" not in said  # an option this JupyterLab does not know
    assert "Traceback" not in said


# ------------------------------------------------------------------------------- the set-up check


def test_everything_is_ready_here(capsys: pytest.CaptureFixture[str]) -> None:
    report = setup_check.check_setup()
    assert report.ok, report
    assert report.missing == ()
    names = " ".join(part.name for part in report.parts)
    for name in ("Python", *setup_check.PACKAGES, *setup_check.LAB_EXTENSIONS, "Example 2"):
        assert name in names
    assert run("check") == 0
    assert "Everything is ready." in capsys.readouterr().out


def test_a_missing_package_is_named_with_the_remedy(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(setup_check, "PACKAGES", {"no-such-package": ("nothing", "1.0")})
    monkeypatch.setattr(setup_check, "example_2_pitch", lambda: setup_check.EXAMPLE_2_PITCH)
    (part,) = setup_check.check_setup().missing
    assert "not installed" in part.found
    assert 'pip install --upgrade "no-such-package>=1.0"' in part.remedy
    assert run("check") == 1
    assert "→" in capsys.readouterr().out


def test_an_old_and_a_broken_package_are_told_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "brokenpart.py").write_text("raise RuntimeError('two\\nlines')", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(setup_check.metadata, "version", lambda name: "2.10.0rc1")
    broken = setup_check._check_package("brokenpart", "a part", "1.0")
    assert not broken.ok
    assert broken.found == "does not import: RuntimeError: two lines"
    assert not setup_check._check_package("json", "a part", "2.11").ok
    assert setup_check._check_package("json", "a part", "2.9.9").ok  # 10 > 9, as numbers


def test_extensions_missing_and_disabled() -> None:
    found = {"anywidget": "1.0"}
    assert setup_check._check_extension("anywidget", found, frozenset()).ok
    disabled = setup_check._check_extension("anywidget", found, frozenset({"anywidget"}))
    assert not disabled.ok
    assert "labextension enable anywidget" in disabled.remedy
    missing = setup_check._check_extension("jupyter-threejs", found, frozenset())
    assert not missing.ok
    assert "pythreejs" in missing.remedy


def test_extensions_are_looked_up_where_jupyterlab_looks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    extension = tmp_path / "labextensions" / "some-widget"
    extension.mkdir(parents=True)
    about = {"name": "some-widget", "version": "3.2.1", "jupyterlab": {"_build": {"load": "x"}}}
    (extension / "package.json").write_text(json.dumps(about), encoding="utf-8")
    (tmp_path / "labconfig").mkdir()
    page = {"disabledExtensions": {"some-widget": True, "other:plugin": True}}
    (tmp_path / "labconfig" / "page_config.json").write_text(json.dumps(page), encoding="utf-8")
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("JUPYTER_CONFIG_PATH", str(tmp_path))
    found, disabled = setup_check._extensions_as_jupyterlab_sees_them()
    assert found["some-widget"] == "3.2.1"
    assert {"some-widget", "other"} <= disabled


@pytest.mark.parametrize("value", [0.5801047651, -setup_check.EXAMPLE_2_PITCH, float("nan")])
def test_a_wrong_number_is_noticed(monkeypatch: pytest.MonkeyPatch, value: float) -> None:
    monkeypatch.setattr(setup_check, "example_2_pitch", lambda: value)
    monkeypatch.setattr(setup_check, "PITCH_TOLERANCE", 1e-12)
    part = setup_check._check_pitch()
    assert not part.ok
    assert repr(value) in part.found


def test_the_oldest_releases_are_those_of_pyproject(root: Path) -> None:
    import tomllib

    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = [*project["dependencies"], *project["optional-dependencies"]["lab"]]
    assert {f"{name}>={oldest}" for name, (_, oldest) in setup_check.PACKAGES.items()} == set(
        wanted
    )
    assert project["requires-python"] == ">=" + ".".join(map(str, setup_check.OLDEST_PYTHON))


def test_the_report_is_frozen_prints_and_displays() -> None:
    bad = setup_check.Part("a <b>", False, "gone", 'get "it"')
    report = setup_check.SetupReport((setup_check.Part("Python", True, "3.11"), bad))
    with pytest.raises(FrozenInstanceError):
        report.parts = ()  # type: ignore[misc]
    assert not report.ok
    assert report.missing == (bad,)
    assert str(report).splitlines()[-1] == repr(report).splitlines()[-1] == report.summary
    html = report._repr_html_()
    assert "a &lt;b&gt;" in html
    assert "<b>" not in html
    assert html.count("<tr>") == 3
