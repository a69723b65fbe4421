"""Running a notebook cell again closes what its last run made, and nothing else."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip("IPython")

import IPython.core.getipython

from ruledlab.lab import cells
from ruledlab.lab.cells import closes_with_cell


@pytest.fixture
def run(monkeypatch):
    """Return a function that acts as if a cell were run."""
    kernel = SimpleNamespace(get_parent=lambda channel: kernel.parent, parent={})
    shell = SimpleNamespace(kernel=kernel)
    monkeypatch.setattr(IPython.core.getipython, "get_ipython", lambda: shell)
    monkeypatch.setattr(cells, "_open", {})

    def run(cell, message, *closers):
        kernel.parent = {"metadata": {"cellId": cell}, "header": {"msg_id": message}}
        for close in closers:
            closes_with_cell(close)

    run.kernel = kernel
    return run


def closer(log, name):
    return lambda: log.append(name)


def test_running_a_cell_again_closes_all_of_its_last_run(run):
    log = []
    run("cell 1", "run 1", closer(log, "a"), closer(log, "b"))
    assert log == []
    run("cell 1", "run 2", closer(log, "c"), closer(log, "d"))
    assert log == ["a", "b"]
    run("cell 1", "run 3", closer(log, "e"))
    assert log == ["a", "b", "c", "d"]


def test_another_cell_is_left_alone(run):
    log = []
    run("cell 1", "run 1", closer(log, "a"))
    run("cell 2", "run 2", closer(log, "b"))
    assert log == []
    run("cell 2", "run 3", closer(log, "c"))
    assert log == ["b"]


@pytest.mark.parametrize(
    "parent", [{}, {"metadata": {}}, {"metadata": {}, "header": {"msg_id": "1"}}]
)
def test_a_front_end_that_names_no_cell(run, parent):
    log = []
    for _ in range(2):
        run.kernel.parent = parent
        closes_with_cell(closer(log, "a"))
    assert (log, cells._open) == ([], {})


@pytest.mark.parametrize("shell", [None, SimpleNamespace()], ids=["plain Python", "terminal"])
def test_outside_notebooks_nothing_happens(monkeypatch, shell):
    monkeypatch.setattr(IPython.core.getipython, "get_ipython", lambda: shell)
    monkeypatch.setattr(cells, "_open", {})
    closes_with_cell(lambda: pytest.fail("closed"))
    closes_with_cell(lambda: pytest.fail("closed"))
    assert cells._open == {}
