"""Run as a program: all invariants at 10⁶ values of t; prints the most memory it took, in MB."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ruledlab import Bezier, RuledSurface

STATUS = Path("/proc/self/status")


def peak() -> float:
    """Return this process's peak of resident memory in MB."""
    if STATUS.exists():  # rusage also remembers the process this one was forked from
        found = re.search(r"VmHWM:\s+(\d+) kB", STATUS.read_text())
        assert found is not None
        return int(found[1]) * 1024 / 1e6
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6


if __name__ == "__main__":
    loop = np.pi / 8 * np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]])
    surface = RuledSurface(Bezier(loop), "sin(u)*v", "exp(-v) + u**2/4")
    invariants = surface.invariants(np.linspace(0, 1, 10**6))
    assert np.isfinite(invariants.kappa_bar_prime).all()
    print(peak())
