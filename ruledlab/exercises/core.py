"""All that a lesson's exercises are made of, and how they are found. No widgets.

A lesson's exercises are data: a module ``lesson_06`` with a tuple ``EXERCISES`` of `Exercise`, each
a number, a title and a small function that makes the `Task` from a `Draw`. A task judges answers,
typed or computed, and every judgement is a `Verdict` that says what is off. The kinds of tasks are
in `kinds`, what is said in `verdict`, and what varies with a student's seed in `draw`.
"""

from __future__ import annotations

from .draw import Draw
from .kinds import (
    Choose,
    Code,
    Condition,
    Drag,
    FindSlip,
    Formula,
    Goal,
    Line,
    Made,
    Number,
    Option,
    Place,
    Sketch,
    Task,
    made,
)
from .registry import Exercise, find, lesson, lessons
from .verdict import RIGHT, UNREAD, WRONG, Misconception, Verdict

__all__ = [
    "RIGHT",
    "UNREAD",
    "WRONG",
    "Choose",
    "Code",
    "Condition",
    "Drag",
    "Draw",
    "Exercise",
    "FindSlip",
    "Formula",
    "Goal",
    "Line",
    "Made",
    "Misconception",
    "Number",
    "Option",
    "Place",
    "Sketch",
    "Task",
    "Verdict",
    "find",
    "lesson",
    "lessons",
    "made",
]
