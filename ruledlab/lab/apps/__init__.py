"""The interactive apps: a state, its controls and its views, laid out. One function for each."""

from __future__ import annotations

from .base import App, LabApp
from .studio import ChartFigure, SpaceFigure, Studio, chart, example, sphere, studio, surface

__all__ = [
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
