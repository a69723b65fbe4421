"""All invariants at many t: `RuledSurface.invariants` against closed forms by SymPy."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from ruledlab import Bezier, RuledSurface

from .closed_forms import usual_invariants
from .table import Row

__all__ = ["rows"]

Q = np.pi / 8
EXAMPLE_2 = Q * np.array([[1, 2], [1, 3], [3, 3], [3, 2], [3, 1], [1, 1], [1, 2]])
FIELDS = {"u − v, u + v": ("u - v", "u + v"), "with functions": ("sin(u)*v", "exp(-v) + u**2/4")}
NAMES = ("kappa", "kappa_bar", "tau", "tau_bar", "sigma", "delta", "kappa_prime", "kappa_bar_prime")
MILLION = 10**6
ROOT = Path(__file__).resolve().parents[1]

Work = Callable[[], object]


def rows() -> Iterator[Row]:
    """Time 400 and 10⁶ values of t, a new formula, and the peak of memory."""
    for label, fields in FIELDS.items():
        _check(fields)
        yield _row(f"all invariants at 400 t, {label}", fields, 400, 800, 1.0)
        yield _row(f"all invariants at 10⁶ t, {label}", fields, MILLION, 6, 0.25)
    yield _new_formula()
    yield Row("peak memory of the process, 10⁶ t", _peak(), None, "MB", 400)


def ours(fields: tuple[str, str]) -> RuledSurface:
    return RuledSurface(Bezier(EXAMPLE_2), *fields)


def _check(fields: tuple[str, str]) -> None:
    """Refuse to time two things that do not give the same."""
    t = np.linspace(0, 1, 101)
    found, wanted = ours(fields).invariants(t), usual_invariants(EXAMPLE_2, *fields)(t)
    for name, values in zip(NAMES, wanted, strict=True):
        gap = np.asarray(getattr(found, name) - values)
        gap = np.angle(np.exp(1j * gap)) if name == "sigma" else gap / (1 + np.abs(values))
        if not np.abs(gap).max() < 1e-9:
            raise AssertionError(f"{name} differs by {np.abs(gap).max():g} for {fields}")


def _row(what: str, fields: tuple[str, str], count: int, repeats: int, target: float) -> Row:
    t = np.linspace(0, 1, count)
    surface, usual = ours(fields), usual_invariants(EXAMPLE_2, *fields)
    return _compared(what, lambda: surface.invariants(t), lambda: usual(t), repeats, target)


def _new_formula() -> Row:
    t, fields = np.linspace(0, 1, 400), FIELDS["with functions"]
    return _compared(
        "a formula just typed: 400 t from its text",
        lambda: ours(fields).invariants(t),
        lambda: usual_invariants(EXAMPLE_2, *fields)(t),
        5,
        None,
    )


def _compared(what: str, a: Work, b: Work, repeats: int, target: float | None) -> Row:
    """Let both take turns; minima are what the machine can do, medians what it did."""
    times = [(_seconds(a), _seconds(b)) for _ in range(repeats + 1)][1:]
    first, second = ([1e3 * pair[i] for pair in times] for i in (0, 1))
    typical = statistics.median(first) / statistics.median(second)
    return Row(what, min(first), min(second), "ms", target, typical)


def _seconds(work: Work) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _peak() -> float:
    """Return the most memory, in MB, of a fresh process that does nothing but the 10⁶."""
    command = [sys.executable, "-m", "benchmarks.million"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    return float(done.stdout)
