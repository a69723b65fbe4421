"""The interactive half: `Lab`, the state of a laboratory, and `studio`, the whole of it."""

from __future__ import annotations

from .apps import studio
from .state import Lab

__all__ = ["Lab", "studio"]
