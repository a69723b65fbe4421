from __future__ import annotations

from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from .form import faults

LESSONS = sorted((Path(__file__).resolve().parents[2] / "lessons").glob("*.ipynb"))


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_lesson_is_thin_and_clean(path: Path) -> None:
    notebook = nbformat.read(path, as_version=nbformat.NO_CONVERT)
    assert (notebook.nbformat, notebook.nbformat_minor >= 5) == (4, True)
    assert faults(notebook) == []


@pytest.mark.parametrize("name", ["00_start_here", "06_design_on_the_sphere"])
def test_the_first_lesson_and_the_flagship_are_there(name: str) -> None:
    assert name in [path.stem for path in LESSONS]


def lesson(*cells: Any) -> Any:
    kernelspec = {"name": "python3", "display_name": "Python 3", "language": "python"}
    metadata = {"kernelspec": kernelspec}
    return new_notebook(cells=[new_markdown_cell("# A lesson"), *cells], metadata=metadata)


GOOD = "from ruledlab.lab import studio\n\nstudio()"


def test_a_good_lesson_has_no_fault() -> None:
    cell = new_code_cell(
        "import numpy as np\n[n for n in range(3)]", metadata={"tags": ["exercise"]}
    )
    assert faults(lesson(new_code_cell(GOOD), cell)) == []


@pytest.mark.parametrize(
    ("source", "says"),
    [
        ("def f():\n    pass", "holds a def"),
        ("class C:\n    pass", "holds a class"),
        ("f = lambda: 1", "holds a lambda"),
        ("for n in range(3):\n    pass", "holds a for"),
        ("[n for n in range(3)]", "holds a for"),
        ("while True:\n    break", "holds a while"),
        ("import numpy as np", "imports numpy"),
        ("from matplotlib import pyplot", "imports matplotlib"),
        ("import ruledlab, sys", "imports sys"),
        ("%matplotlib widget", "not plain Python"),
        ("1\n" * 16, "longer than 15"),
    ],
)
def test_a_fault_in_a_cell_is_noticed(source: str, says: str) -> None:
    assert [fault for fault in faults(lesson(new_code_cell(source))) if says in fault]


def test_an_exercise_may_use_numpy_and_nothing_else() -> None:
    cell = new_code_cell("import scipy", metadata={"tags": ["exercise"]})
    assert faults(lesson(cell)) == ["cell 1: imports scipy"]


def test_what_a_run_leaves_behind_is_noticed() -> None:
    output = nbformat.v4.new_output("stream", text="said")
    ran = lesson(new_code_cell(GOOD, outputs=[output], execution_count=3))
    assert faults(ran) == ["cell 1: has outputs", "cell 1: has an execution count"]


def test_faults_of_the_notebook_are_noticed() -> None:
    bare = new_notebook(cells=[new_code_cell(GOOD), new_markdown_cell("x")])
    bare.cells[0].id = bare.cells[1].id
    bare.metadata["widgets"] = {"state": {}}
    found = "\n".join(faults(bare))
    for says in ("no kernelspec", "saved widget state", "begin with prose", "cell ids repeat"):
        assert says in found
    nameless = lesson(new_code_cell(GOOD))
    del nameless.cells[1]["id"]
    assert any("no id" in fault for fault in faults(nameless))
