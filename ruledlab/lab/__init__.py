"""The interactive half: `Lab`, the state of a laboratory, and the apps that show one."""

from __future__ import annotations

from typing import Any

from . import apps
from .apps import chart, example, sphere, studio, surface
from .state import Lab

__all__ = ["Lab", "chart", "example", "sphere", "studio", "surface"]
__all__ += apps.LESSON_APPS  # imported when asked for, see below


def __getattr__(name: str) -> Any:
    """Return a lesson's app, such as ``two_lines``; see `apps.LESSON_APPS`."""
    if name in apps.LESSON_APPS:
        return getattr(apps, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
