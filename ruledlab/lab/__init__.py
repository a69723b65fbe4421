"""The interactive half: `Lab`, the state of a laboratory, and the apps that show one."""

from __future__ import annotations

from .apps import chart, example, sphere, studio, surface
from .state import Lab

__all__ = ["Lab", "chart", "example", "sphere", "studio", "surface"]
