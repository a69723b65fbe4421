"""How long `import ruledlab` takes, against what it cannot do without."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
from collections.abc import Iterator

from .table import Row

__all__ = ["rows"]

TIMED = "import time; start = time.perf_counter(); {}; print(time.perf_counter() - start)"
OURS, USUAL = "import ruledlab", "import numpy, scipy.interpolate"
REPEATS = 9
# The first import compiles and is not counted; where compiled files are not kept, all would.
KEEPING = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}


def rows() -> Iterator[Row]:
    """Import in fresh interpreters, taking turns."""
    times = [(_import(OURS), _import(USUAL)) for _ in range(REPEATS + 1)][1:]
    ours, usual = zip(*times, strict=True)
    typical = statistics.median(ours) / statistics.median(usual)
    what = "import ruledlab, against numpy + scipy.interpolate"
    yield Row(what, 1e3 * min(ours), 1e3 * min(usual), "ms", 1.3, typical)


def _import(statement: str) -> float:
    command = [sys.executable, "-c", TIMED.format(statement)]
    return float(
        subprocess.run(command, capture_output=True, text=True, check=True, env=KEEPING).stdout
    )
