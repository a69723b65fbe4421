"""The kinds of exercises. Each judges answers, typed or computed, and says what is off."""

from __future__ import annotations

from .choose import Choose, Option
from .drag import Drag, Made, made
from .formula import Formula
from .goal import Condition, Goal
from .number import Code, Number
from .place import Place
from .sketch import Sketch
from .slip import FindSlip, Line
from .task import Task

__all__ = [
    "Choose",
    "Code",
    "Condition",
    "Drag",
    "FindSlip",
    "Formula",
    "Goal",
    "Line",
    "Made",
    "Number",
    "Option",
    "Place",
    "Sketch",
    "Task",
    "made",
]
