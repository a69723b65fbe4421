"""The plots of the invariants over t or over the striction arc length s, with one cursor."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from ..geometry.checks import Array
from ..geometry.motion import StrictionLength
from .plots import CurvePlots
from .scene import Mark, Scene

__all__ = ["ArcPlots", "axis_note", "mark_over_arc", "over_arc"]

RATES: Final = ("kappa", "kappa_bar", "tau", "tau_bar")


def over_arc(scene: Scene, s: Array) -> Scene:
    """Return the scene with s for t, and κ, κ̄, τ, τ̄ for each unit of s instead of t."""
    speed = np.hypot(scene.curves["kappa_bar"], scene.curves["tau_bar"])
    per = np.divide(1.0, speed, out=np.full(speed.shape, np.nan), where=speed > 0)
    curves = {n: y * per if n in RATES else y for n, y in scene.curves.items()}
    return replace(scene, t=s, curves=curves)


def mark_over_arc(mark: Mark, s: float) -> Mark:
    """Return the mark with s for t, as `over_arc` does for a scene."""
    speed = np.hypot(mark.values["kappa_bar"], mark.values["tau_bar"])
    per = 1.0 / speed if speed > 0 else np.nan
    values = {n: y * per if n in RATES else y for n, y in mark.values.items()}
    return replace(mark, t=s, values=values)


class ArcPlots(CurvePlots):
    """The plots over t, or over the striction arc length s while `length` is set."""

    length: StrictionLength | None = None

    def draw(self, scene: Scene, mark: Mark | None = None, *, over: str = "t") -> None:
        """Show a scene's curves over t or s."""
        if self.length is not None:
            scene, over = over_arc(scene, self.length.s(scene.t)), "s"
        super().draw(scene, mark and self._moved(mark), over=over)

    def draw_cursor(self, mark: Mark) -> None:
        """Move the cursor."""
        super().draw_cursor(self._moved(mark))

    def t_of(self, place: float) -> float:
        """Return the t of a place on the axis."""
        if self.length is None:
            return place
        return float(self.length.t(min(place, self.length.total)))

    def _moved(self, mark: Mark) -> Mark:
        return mark if self.length is None else mark_over_arc(mark, float(self.length.s(mark.t)))


def axis_note(length: StrictionLength | None) -> str:
    """Say what the plots are drawn over, and what that makes of the invariants."""
    said = (
        "For each unit of t: κ, κ̄, τ, τ̄."
        if length is None
        else f"For each unit of s (0 … {length.total:.4g}): κ/s′, κ̄/s′ = sin σ, τ/s′, τ̄/s′ = cos σ."
    )
    return f'<div class="ruledlab-note">{said}</div>'
