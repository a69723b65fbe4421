"""The plots of the invariants over t or over the striction arc length s, with one cursor."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any, Final

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

    def draw(self, scene: Scene, mark: Mark | None = None) -> None:
        """Show a scene's curves over t or s."""
        if self.length is not None:
            scene = over_arc(scene, self.length.s(scene.t))
        super().draw(scene, mark and self._moved(mark))

    def draw_cursor(self, mark: Mark) -> None:
        """Move the cursor."""
        super().draw_cursor(self._moved(mark))

    def t_of(self, place: float) -> float:
        """Return the t of a place on the axis."""
        return place if self.length is None else float(self.length.t(place))

    def _moved(self, mark: Mark) -> Mark:
        return mark if self.length is None else mark_over_arc(mark, float(self.length.s(mark.t)))

    def _strips(self, theme: Any, width: int) -> tuple[Any, ...]:
        strips = super()._strips(theme, width)
        if self.length is None:
            return strips
        named = [(s, replace(s.quantity, unit=_by_arc(s.quantity.unit))) for s in strips]
        return tuple(replace(strip, quantity=quantity) for strip, quantity in named)

    def _show(self) -> None:
        with self.widget.hold_sync():
            super()._show()
            if self.length is not None:
                *others, last = self.widget.strips
                self.widget.strips = [*others, _axis_named_s(last, self._theme.ink)]

    def _note(self, strip: Any) -> dict[str, Any]:
        note = super()._note(strip)
        return note | {"texts": [_by_arc(text) for text in note.get("texts", [])]}

    def _in_words(self) -> str:
        return _by_arc(super()._in_words()) if self.length is not None else super()._in_words()

    def _cursor(self) -> dict[str, Any]:
        cursor = super()._cursor()
        spoken = {n: _by_arc(cursor[n]) for n in ("label", "spoken") if n in cursor}
        return cursor | spoken if self.length is not None else cursor


def _by_arc(text: str) -> str:
    """Say s where t is said."""
    return re.sub(r"\bt\b", "s", text)


def _axis_named_s(svg: str, ink: str) -> str:
    """Write s at the end of the axis below the last strip, where t is the text written last."""
    start = svg.rindex('<g id="text_')
    place = re.search(r"translate\(([\d.]+) ([\d.]+)\)", svg[start:])
    x, y = place.groups() if place else ("0", "0")
    style = f"fill:{ink};font:italic 15px 'DejaVu Sans',sans-serif"
    return f'{svg[:start]}<text x="{x}" y="{y}" style="{style}">s</text></g></g></svg>'


def axis_note(length: StrictionLength | None) -> str:
    """Say what the plots are drawn over, and what that makes of the invariants."""
    said = (
        "Over the parameter t: κ, κ̄, τ, τ̄ for each unit of t."
        if length is None
        else f"Over the arc length s of the striction curve, 0 … {length.total:.4g}: κ/s′, κ̄/s′ = "
        "sin σ, τ/s′, τ̄/s′ = cos σ with s′ = √(κ̄² + τ̄²), and σ, δ as they are. The same "
        "rulings run through more slowly or faster give the same curves."
    )
    return f'<div class="ruledlab-note">{said}</div>'
