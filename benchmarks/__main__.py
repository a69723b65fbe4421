"""Print the table: `python -m benchmarks [computing] [starting] [moving]`."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Callable, Iterator

from . import computing, moving, starting
from .table import HEAD, WIDTHS, Row, line

PARTS: dict[str, Callable[[], Iterator[Row]]] = {
    "computing": computing.rows,
    "starting": starting.rows,
    "moving": moving.rows,
}


def main(names: list[str]) -> int:
    if unknown := [name for name in names if name not in PARTS]:
        print(f"`{unknown[0]}` is none of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    print(
        f"Python {platform.python_version()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"
    )
    print("Times at 400 and 10⁶ t and of imports: the least of many, both taking turns; in")
    print("brackets the ratio of the medians. Moves: medians.\n")
    print(line(HEAD), line(tuple("-" * width for width in WIDTHS)), sep="\n")
    missed = 0
    for name in names or list(PARTS):
        for row in PARTS[name]():
            print(line(row.cells()), flush=True)
            missed += row.met == "MISSED"
    print(f"\n{missed or 'No'} target{'s' * (missed != 1)} missed.")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
