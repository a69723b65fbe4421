"""The kinds of exercises. Each judges answers, typed or computed, and says what is off."""

from __future__ import annotations

from .choose import Choose, Option
from .drag import Condition, Drag, Made, made
from .formula import Formula
from .number import Code, Number
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
    "Line",
    "Made",
    "Number",
    "Option",
    "Sketch",
    "Task",
    "made",
]
