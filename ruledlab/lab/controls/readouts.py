"""The numbers of the surface as a whole, and the pictures in words."""

from __future__ import annotations

import html
import math

import ipywidgets as w

from ..axes import minus
from ..markup import numbers_table
from ..slate import Change
from ..state import Lab
from .group import Group

__all__ = ["Readouts"]

TURN = 2 * math.pi


class Readouts(Group):
    """The numbers: Λ = λ + ε l when the surface closes, otherwise why not and how far."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.closed = w.HTML()
        self.words = w.HTML()
        self.widget = w.VBox([self.closed])
        self._listening = True
        self.follow(lab, self.update)
        self.update(Change(scene=True, mark=True))
        self.listen(False)

    def listen(self, listening: bool) -> None:
        """Keep the words up to date, or let them rest while nobody can see them."""
        self._listening = listening
        self.update(Change(mark=True))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.scene:
            self.put(self.closed, value=_closed_html(self._lab))
        if self._listening and (change.scene or change.mark):
            self.put(self.words, value=_words_html(self._lab))


def _closed_html(lab: Lab) -> str:
    result = lab.result
    turn = shift = both = modulo = "–"
    if result.pitch is not None:
        exact = float(result.pitch.real)
        # Adding 0 makes a zero of −0; nearly a whole turn is none.
        real, dual = round(exact, 6) + 0.0, round(float(result.pitch.dual), 6) + 0.0
        left = exact % TURN if TURN - exact % TURN > 5e-7 else 0.0
        turn, shift, modulo = f"{real:.6f}", f"{dual:.6f}", f"{left:.6f}"
        both = f"{real:.4f} {'+' if dual >= 0 else '-'} ε {abs(dual):.4f}"
    rows = (
        ("angle of pitch", "λ", turn, "rad"),
        ("", "λ mod 2π", modulo, "rad"),
        ("pitch", "l", shift, "length"),
        ("dual angle of pitch", "Λ = λ + ε l", both, ""),
    )
    table = numbers_table((name, symbol, minus(value), unit) for name, symbol, value, unit in rows)
    note = _as_clause(html.escape(result.pitch_note))
    return f'{table}<div class="ruledlab-note" role="status">The surface {note}.</div>'


def _as_clause(note: str) -> str:
    return note.replace("not closed:", "does not close:", 1)


def _words_html(lab: Lab) -> str:
    scene, mark = lab.result.scene.text, lab.mark.text
    return (
        f'<div class="ruledlab-words-panel"><p>{html.escape(scene)}</p>'
        f"<p>{html.escape(mark)}</p></div>"
    )
