"""One app for each run of a notebook cell: running it again closes what the last run made.

A widget that is no longer displayed lives on in the kernel, with its observers, and its canvas in
the browser's limited number of them. The cell's identity comes with every request to execute.
"""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["closes_with_cell"]

_open: dict[str, tuple[str, list[Callable[[], None]]]] = {}


def closes_with_cell(close: Callable[[], None]) -> None:
    """Call ``close`` when the present notebook cell is run again; elsewhere do nothing."""
    cell, run = _present_cell()
    if not cell:
        return
    last_run, closers = _open.get(cell, ("", []))
    if last_run != run:
        for old in closers:
            old()
        closers = []
    _open[cell] = (run, [*closers, close])


def _present_cell() -> tuple[str, str]:
    """Return the id of the cell that is running and of this run of it; empty outside notebooks."""
    try:
        from IPython.core.getipython import get_ipython

        parent = get_ipython().kernel.get_parent("shell")
        return parent["metadata"].get("cellId", ""), parent["header"]["msg_id"]
    except (ImportError, AttributeError, KeyError):
        return "", ""
