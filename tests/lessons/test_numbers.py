"""Every number that the lessons' prose states is recomputed here.

In the source of a lesson such a number is followed by a comment that readers do not see, with the
Python expression that gives it: ``0.383<!--= sin(pi/8) -->``. It must agree to the last digit.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest

import ruledlab
import ruledlab.geometry
from ruledlab.geometry import gallery
from ruledlab.printed import finding

LESSONS = sorted((Path(__file__).parents[2] / "lessons").glob("*.ipynb"))
MARKED = re.compile(
    r"(?P<shown>[-−+]?\d[\d.,]*(?:e[-−]?\d+)?)?\s*\$?\s*<!--=(?P<source>.*?)-->", re.S
)

NAMES: dict[str, Any] = {
    **{name: getattr(math, name) for name in ("pi", "sin", "cos", "tan", "sqrt", "exp", "log")},
    **{name: getattr(ruledlab, name) for name in ruledlab.__all__},
    "np": np,
    "finding": finding,
    "gallery": gallery,
    "ex1": gallery.surface("example_1"),
    "ex2": gallery.surface("example_2"),
}


def prose(path: Path) -> str:
    cells = nbformat.read(path, as_version=4).cells
    return "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


def marked(text: str) -> list[tuple[str, str]]:
    """The numbers shown with their expressions; a mark without a number before it shows ''."""
    return [((m["shown"] or ""), m["source"].strip()) for m in MARKED.finditer(text)]


def disagreement(shown: str, source: str) -> str | None:
    if not shown:
        return f"no number stands before the mark {source!r}"
    digits = Decimal(shown.replace("−", "-").rstrip(".,"))
    value = float(eval(source, dict(NAMES)))  # the lessons are ours
    half = float(Decimal(5).scaleb(int(digits.as_tuple().exponent) - 1))
    if abs(value - float(digits)) > half * (1 + 1e-9):
        return f"the prose says {shown}, but {source} = {value!r}"
    return None


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_numbers_in_the_prose(path: Path) -> None:
    found = [disagreement(shown, source) for shown, source in marked(prose(path))]
    assert [word for word in found if word] == []


def test_lesson_06_states_numbers() -> None:
    (lesson,) = (path for path in LESSONS if path.stem.startswith("06"))
    assert len(marked(prose(lesson))) >= 5


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("0.383<!--= sin(pi/8) -->", False),
        ("0.384<!--= sin(pi/8) -->", True),
        ("−6.1159<!--= ex2.angle_of_pitch() -->", False),
        ("about $0.38$<!--= sin(pi/8) -->", False),
        ("no number <!--= 1 -->", True),
    ],
)
def test_the_check_notices(text: str, wrong: bool) -> None:
    ((shown, source),) = marked(text)
    assert (disagreement(shown, source) is not None) == wrong
