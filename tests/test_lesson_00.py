"""The exercises of lesson 00, by another route: the chart, the moment, a curve that is dragged."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from ruledlab.design import Design
from ruledlab.exercises.core import Drag, Number, find
from ruledlab.geometry import Line

SEEDS = ("", "1", "2", "Ada", "Σ", "q")
AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "-x": (-1.0, 0.0, 0.0)}


def angles(design: Design, wanted: tuple[str, str]) -> list[float]:
    """How far off the two ends of a design are, in degrees, without its surface."""
    found = []
    for (u, v), name in zip((design.points[0], design.points[-1]), wanted, strict=True):
        x = np.array([math.cos(u) * math.sin(v), math.sin(u) * math.sin(v), math.cos(v)])
        found.append(math.degrees(math.acos(np.clip(x @ AXES[name], -1, 1))))
    return found


@pytest.mark.parametrize("seed", SEEDS)
def test_the_moment_asked_for_is_that_of_the_line(seed: str) -> None:
    task = find("00.4").task(seed)
    assert isinstance(task, Number)
    point = [float(x) for x in re.findall(r"c=\((-?\d+),(-?\d+),7\)", task.question)[0]]
    line = Line.from_point_direction([*point, 7.0], [0.0, 0.0, 1.0])
    assert task.judge(line.moment).right
    assert task.judge(-line.moment).slip == "sign of the moment"
    assert task.judge(line.foot).slip == "foot point for moment"


@pytest.mark.parametrize("seed", SEEDS)
def test_the_direction_asked_for_is_that_of_the_place(seed: str) -> None:
    task = find("00.3").task(seed)
    assert isinstance(task, Number)
    x = np.array(task.answer)
    assert np.linalg.norm(x) == pytest.approx(1.0)
    third = int(re.findall(r"(\d)\\pi}6", task.question)[0])
    assert math.acos(x[2]) == pytest.approx(third * math.pi / 6)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_curve_with_the_right_ends_passes_whatever_lies_between(seed: str) -> None:
    task = find("00.8").task(seed)
    assert isinstance(task, Drag)
    wanted = tuple(
        re.findall(r"direction of the \$(-?x|y)\$|that of the \$(-?x|y)\$", task.question)
    )
    first, last = wanted[0][0], wanted[1][1]
    assert max(angles(task.start, (first, last))) > 30, "it needs the student's hand"
    assert max(angles(task.model, (first, last))) < 1e-6
    p0, pn = task.model.points[0], task.model.points[-1]
    for inner in ((), ((1.0, 0.3),), ((2.0, 2.5), (0.1, 1.0), (3.0, 0.4))):
        design = task.start.with_(points=(p0, *inner, pn))
        assert task.judge(design).right
        whole_turn = tuple((u + 2 * math.pi, v) for u, v in design.points)
        assert task.judge(design.with_(points=whole_turn)).right
        assert task.judge(design.with_(points=design.points[::-1])).slip == "the other way round"
    one_end = task.start.with_(points=(p0, *task.start.points[1:]))
    verdict = task.judge(one_end)
    assert (verdict.state, verdict.slip) == ("wrong", "")
    assert "$t=1$" in verdict.word
    assert "$t=0$" not in verdict.word
