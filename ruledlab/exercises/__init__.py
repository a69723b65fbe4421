"""Exercises that check themselves: `exercise`, `exercises`, `check`, `predict`, `progress`, `seed`.

The kinds of exercises and their judgement are in `core`, what is kept of them in `store`, both
without widgets; a lesson's exercises are data in a module of its own, such as `lesson_06`.
"""

from __future__ import annotations

from .core import find, lesson, lessons
from .record import Checked, check, seed
from .widgets import exercise, exercises, predict, progress

__all__ = [
    "Checked",
    "check",
    "exercise",
    "exercises",
    "find",
    "lesson",
    "lessons",
    "predict",
    "progress",
    "seed",
]
