"""The interactive apps: a state, its controls and its views, laid out. One function for each."""

from __future__ import annotations

from importlib import import_module
from typing import Any, Final

from .base import App, LabApp
from .studio import ChartFigure, SpaceFigure, Studio, chart, example, sphere, studio, surface

__all__ = [
    "LESSON_APPS",
    "App",
    "ChartFigure",
    "LabApp",
    "SpaceFigure",
    "Studio",
    "chart",
    "example",
    "sphere",
    "studio",
    "surface",
]

LESSON_APPS: Final = {
    "dual_numbers": "lesson_01",
    "two_lines": "lesson_02",
    "moving_line": "lesson_03",
    "along_the_rulings": "lesson_04",
    "bending": "lesson_05",
    "dual_part": "lesson_07",
    "once_round": "lesson_08",
    "printed_and_mended": "lesson_12",
}
"""The function that returns a lesson's app, and the module it is imported from when asked for."""


def __getattr__(name: str) -> Any:
    if name in LESSON_APPS:
        return getattr(import_module(f".{LESSON_APPS[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
