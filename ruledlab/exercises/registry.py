"""Where exercises are found: a module for each lesson, such as `lesson_06`."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass

from ..geometry.checks import GeometryError
from .draw import Draw
from .kinds import Task

__all__ = ["Exercise", "find", "lesson", "lessons"]


@dataclass(frozen=True, slots=True)
class Exercise:
    """An exercise: its number, its title and how its task is made for a student.

    Attributes
    ----------
    key
        lesson and number: "06.1".
    title
        a few words.
    make
        makes the task.
    """

    key: str
    title: str
    make: Callable[[Draw], Task]

    def task(self, seed: str = "") -> Task:
        """Return the task for a student's seed."""
        return self.make(Draw(seed, self.key))


def lessons() -> tuple[str, ...]:
    """Return the lessons that have exercises: ("00", "01", …)."""
    path = importlib.import_module(__package__ or "").__path__
    names = (module.name for module in pkgutil.iter_modules(path))
    return tuple(sorted(n.removeprefix("lesson_") for n in names if n.startswith("lesson_")))


def lesson(number: str) -> tuple[Exercise, ...]:
    """Return the exercises of a lesson.

    Raises
    ------
    GeometryError
        if there are none.
    """
    name = str(number).zfill(2)
    if name not in lessons():
        raise GeometryError(
            f"`number` must be a lesson with exercises, one of {', '.join(lessons())}; "
            f"got {number!r}"
        )
    found: tuple[Exercise, ...] = importlib.import_module(f".lesson_{name}", __package__).EXERCISES
    return found


def find(key: str) -> Exercise:
    """Return an exercise by its number, such as "06.1".

    Raises
    ------
    GeometryError
        if there is none.
    """
    found = lesson(str(key).partition(".")[0])
    for exercise in found:
        if exercise.key == key:
            return exercise
    known = f"{found[0].key} … {found[-1].key}"
    raise GeometryError(f"`key` must be the number of an exercise, {known}; got {key!r}")
