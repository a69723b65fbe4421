"""What the reader moves: sliders, fields, menus and buttons, bound to a `Lab`.

Every control follows the lab and asks it for changes; none of them draws or computes. What a
control could not do is said beside it. All handlers run under the control's own guard, which shows
a programming error instead of losing it: an exception in a widget's handler appears nowhere else.
"""

from __future__ import annotations

from .course import GalleryControl, HistoryControl, TimeControl, design_of, is_design_of
from .fields import FieldControl
from .group import (
    PAUSE,
    Echoes,
    Group,
    Strokes,
    defect_html,
    error_html,
    home_button,
    plain,
    readable,
)
from .look import LookControl
from .number import STEPS, NumberControl, Player
from .points import PointControl
from .readouts import Readouts

__all__ = [
    "PAUSE",
    "STEPS",
    "Echoes",
    "FieldControl",
    "GalleryControl",
    "Group",
    "HistoryControl",
    "LookControl",
    "NumberControl",
    "Player",
    "PointControl",
    "Readouts",
    "Strokes",
    "TimeControl",
    "defect_html",
    "design_of",
    "error_html",
    "home_button",
    "is_design_of",
    "plain",
    "readable",
]
