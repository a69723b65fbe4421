"""Every lesson runs from the first cell to the last without a complaint."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbclient import NotebookClient

LESSONS = sorted((Path(__file__).resolve().parents[2] / "lessons").glob("*.ipynb"))


def complaints(notebook: Any) -> list[str]:
    """Errors and everything on stderr, after a run."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [
        output.get("evalue") or output.get("text", "")
        for output in outputs
        if output.output_type == "error" or output.get("name") == "stderr"
    ]


def run(notebook: Any, directory: Path) -> Any:
    """Run all cells, also those after an error, in `directory`."""
    client = NotebookClient(
        notebook,
        timeout=120,
        kernel_name="python3",
        allow_errors=True,
        resources={"metadata": {"path": str(directory)}},
    )
    return client.execute()


@pytest.fixture(autouse=True)
def quiet_and_tidy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))  # nobody's startup files
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    monkeypatch.setenv("PYTHONWARNINGS", "default")


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_lesson_runs_without_a_complaint(path: Path, tmp_path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)
    assert complaints(run(notebook, tmp_path)) == []


def test_complaints_are_noticed(tmp_path: Path) -> None:
    cells = ["import sys; print('aloud', file=sys.stderr)", "1 / 0", "print(sys.executable)"]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in cells])
    ran = run(notebook, tmp_path)
    assert [text.strip() for text in complaints(ran)] == ["aloud", "division by zero"]
    assert ran.cells[2].outputs[0].text.strip() == sys.executable  # this environment's kernel
