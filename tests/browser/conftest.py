"""Fixtures for tests in a real browser; see `session`."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from .session import (
    ARTIFACTS,
    OPENING,
    PLOTS,
    REQUIRE,
    STUDIO,
    THREE,
    LabSession,
    Pictures,
    StudioPage,
    lab_session,
    why_not,
    write_notebook,
)

HERE = Path(__file__).resolve().parent
SESSION = pytest.StashKey[LabSession]()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents:
            item.add_marker(pytest.mark.browser)
            # one browser at a time, whatever the number of workers
            item.add_marker(pytest.mark.xdist_group("browser"))


@pytest.fixture(scope="session")
def lab(
    tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest
) -> Iterator[LabSession]:
    """JupyterLab in Chromium; skips with the reason, or fails if a browser is required."""
    if reason := why_not():
        if os.environ.get(REQUIRE) == "1":
            pytest.fail(f"{REQUIRE}=1, but {reason}", pytrace=False)
        pytest.skip(reason)
    scratch = tmp_path_factory.mktemp("jupyterlab")
    try:
        with lab_session(scratch) as session:
            request.config.stash[SESSION] = session
            yield session
    finally:
        ARTIFACTS.mkdir(exist_ok=True)
        with suppress(OSError):
            shutil.copyfile(scratch / "jupyterlab.log", ARTIFACTS / "jupyterlab.log")


@pytest.fixture(scope="session")
def opened_studio(lab: LabSession, tmp_path_factory: pytest.TempPathFactory) -> StudioPage:
    """One studio for all tests that need one: opening a page takes longer than all they do."""
    path = write_notebook(tmp_path_factory.mktemp("studio") / "studio.ipynb", STUDIO)
    notebook = lab.open_notebook(path, permissions=["clipboard-read", "clipboard-write"])
    assert notebook.run_all() == []
    space = notebook.wait_still(THREE, timeout=60)
    home = Pictures(space, notebook.wait_still(PLOTS))
    opening = json.loads(notebook.kernel_exec(f"import json; print(json.dumps({OPENING}))"))
    return StudioPage(notebook, opening, home)


@pytest.fixture
def studio(opened_studio: StudioPage) -> Iterator[StudioPage]:
    """The studio showing Example 2; at the end, no error in notebook or console."""
    opened_studio.reset()
    opened_studio.notebook.forget_console()  # what an earlier test met is its own finding
    yield opened_studio
    assert opened_studio.notebook.errors() == []
    assert opened_studio.notebook.console_errors == []


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[Any]) -> Any:
    """Keep a picture of every open notebook when a test fails."""
    report = yield
    session = item.config.stash.get(SESSION, None)
    if report.failed and session is not None:
        for number, page in enumerate(session.pages):
            name = re.sub(r"[^\w-]+", "-", f"failed-{item.name}-{number}")
            with suppress(Exception):  # the picture is a help, not the finding
                report.sections.append(("screenshot", str(page.screenshot(name))))
    return report
