"""Exercises that check themselves: `exercise`, `exercises`, `check`, `predict`, `progress`, `seed`.

How an answer goes: it is read by `answers` (what people write is put into the notation of typed
formulas by `written`), judged by its kind in `kinds`, which gives a `verdict`, and kept by `record`
in a `store`; all that without widgets. What is seen of it is in `boxes` and `widgets`. A lesson's
exercises are data in a module of its own, such as `lesson_06`, made of what `core` brings together;
`misconceptions`, `designs` and `tex` have the parts that several lessons share.
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
