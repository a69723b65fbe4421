"""Lesson 12: a printed formula beside the mended one, both over t, and their difference.

The findings are those of `ruledlab.printed`; this app shows both sides of one on any design.
"""

from __future__ import annotations

import html
import threading
from collections.abc import Callable
from typing import Any

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry import gallery
from ...geometry.checks import Array, GeometryError
from ...printed import PRINTED, Finding, finding
from ..axes import sticky_limits
from ..controls import (
    FieldControl,
    GalleryControl,
    Group,
    HistoryControl,
    NumberControl,
    PointControl,
    TimeControl,
    design_of,
    error_html,
    is_design_of,
    plain,
)
from ..flat import by_hand
from ..handles import Grasp, Grip
from ..pad import DomainPad
from ..scenes.comparison import (
    NAMES,
    ROUNDING,
    Comparison,
    compare,
    excursions,
    flat,
    in_words,
    number_lines,
    picture,
    said,
    table,
    title,
    values,
)
from ..slate import Change
from ..state import Lab
from .base import LabApp, connect

__all__ = ["PrintedAndMended", "printed_and_mended"]


def printed_and_mended(
    finding: str = "tau",  # the reader's word; the function of that name is not needed here
    design: Design | None = None,
) -> PrintedAndMended:
    """Return the app that shows printed formulas beside the mended ones.

    Parameters
    ----------
    finding
        the key of the finding to begin with, see `ruledlab.printed.PRINTED`.
    design
        where to begin; None for the paper's Example 2.

    Raises
    ------
    GeometryError
        if there is no such finding.
    """
    return PrintedAndMended(Lab(design or design_of(gallery.example("example_2")), 0.25), finding)


class FindingControl(Group):
    """Which finding is looked at; for some of them also at which w, and which coordinate."""

    def __init__(self, lab: Lab, key: str, changed: Callable[[bool], None]) -> None:
        super().__init__()
        self._lab, self._changed, self.height = lab, changed, 0.5
        self.menu = w.Dropdown(
            options=[(title(entry), entry.key) for entry in PRINTED],
            value=finding(key).key,
            layout=w.Layout(width="auto", flex="1 1 260px", max_width="560px"),
        )
        self.menu.tooltip = "the findings, in the order of the paper"
        self.axis = w.Dropdown(
            options=list(zip("xyz", range(3), strict=True)), value=0, layout=w.Layout(width="70px")
        )
        self.axis.tooltip = "coordinate"
        self.own = w.Button(icon="picture-o", layout=w.Layout(width="auto"))
        self.w = NumberControl(
            self, "w", "w, place on the ruling", (-2.0, 2.0), 0.05, self._set_height
        )
        self.bar = w.HBox([self.menu, self.axis, self.own]).add_class("ruledlab-bar")
        self.on(self.menu, "value", lambda _: self._show())
        self.on(self.axis, "value", lambda _: changed(True))
        self.click(self.own, self._load)
        self.follow(lab, lambda change: self._offer() if change.scene else None)
        self.w.show(self.height)
        self._arrange()

    @property
    def entry(self) -> Finding:
        """The chosen finding."""
        return finding(self.menu.value)

    def _load(self) -> None:
        self._lab.load(design_of(gallery.example(self.entry.design)), "gallery")

    def _set_height(self, height: float) -> None:
        self.height = height
        self.w.show(height)
        self._changed(False)

    def _show(self) -> None:
        self._arrange()
        self._changed(True)

    def _arrange(self) -> None:
        """Show the controls that this finding needs."""
        entry = self.entry
        several = entry.over == "t" and len(NAMES[entry.key]) > 1
        self.axis.layout.display = None if several else "none"
        self.w.widget.layout.display = None if entry.over == "t, w" else "none"
        self._offer()

    def _offer(self) -> None:
        """Offer the design that shows this finding well."""
        own = gallery.example(self.entry.design)
        here = self.entry.only or is_design_of(own, self._lab.design)
        self.put(self.own, description=f"show it on: {own.title.split(':')[0]}", disabled=here)


class PrintedAndMended(LabApp):
    """One finding on the design of a lab.

    Attributes
    ----------
    comparison
        what is shown, or None where this design has no such quantity.
    """

    def __init__(self, lab: Lab, key: str = "tau") -> None:
        super().__init__(lab)
        self._drawing, self._axes, self.comparison = threading.RLock(), None, None
        self.chooser = FindingControl(lab, key, self._evaluate)
        self.formulas, self.note, self.picture, self.numbers = w.HTMLMath(), *_htmls(3)
        self.pad, self.points, self.fields = DomainPad(), PointControl(lab), FieldControl(lab)
        self.time, self.history = TimeControl(lab), HistoryControl(lab)
        self.gallery = GalleryControl(lab)
        self._views = [self.pad]
        self._groups = [self.chooser, self.points, self.fields, self.time, self.history]
        self._groups.append(self.gallery)
        self._releases.append(connect(self.pad, self.points))
        self.foot = self.handles(self.time, self._grasp)
        design = w.HBox([self.gallery.widget, self.history.widget]).add_class("ruledlab-bar")
        edit = w.VBox([self.points.widget, self.fields.widget])
        self.assemble(
            w.VBox([self.chooser.bar, self.chooser.w.widget]),
            self.formulas,
            self.foot.over(self.picture),
            self.time.widget,
            self.numbers,
            self.note,
            design,
            w.HBox([self.pad, edit]).add_class("ruledlab-pair"),
            self.gallery.note,
        )

    def update(self, change: Change) -> None:
        """Follow the lab."""
        super().update(change)
        if change.scene:
            self._evaluate(anew=change.loaded)
        elif change.mark:
            self._redraw()

    def _evaluate(self, anew: bool) -> None:
        """Evaluate the chosen finding; with ``anew`` the axes are chosen afresh."""
        with self._drawing:
            chosen = self.chooser
            self.formulas.value = formulas_html(chosen.entry)
            try:
                self.comparison = compare(
                    chosen.entry, self.lab.result.surface, chosen.height, chosen.axis.value
                )
            except GeometryError as error:
                self.comparison = None
                self.note.value = error_html(plain(str(error)))
            self._axes = None if anew or self.comparison is None else self._axes
            self._redraw()

    def _redraw(self) -> None:
        with self._drawing:
            made = self.comparison
            over_t = made is not None and made.t.size > 0
            self.time.widget.layout.display = None if over_t else "none"
            if not over_t:
                self.foot.draw([])
            if made is None:
                self.picture.value = self.numbers.value = ""
            elif made.t.size:
                self._draw_curves(made)
            else:
                self._draw_numbers(made)

    def _draw_curves(self, made: Comparison) -> None:
        old = self._axes or (None, None)
        both = np.concatenate((made.printed, made.mended))
        limits = sticky_limits(both, old[0]), sticky_limits(_true(made.difference), old[1])
        self._axes = limits
        entry, cursor = self.chooser.entry, self.lab.cursor
        words = " ".join((in_words(entry, made), *excursions(made, limits[0])))
        self.picture.value = picture(made, limits, cursor, words)
        place = np.array([cursor, 0.0, 0.0])
        self.foot.draw([Grip(place, "point", "cursor", "t, along the curves")], flat(made))
        self.numbers.value = table(self._rows(made, cursor))
        self.note.value = _note(words)

    def _grasp(self, grasp: Grasp) -> None:
        low, high = self.lab.result.surface.domain
        self.lab.move_cursor(by_hand(min(max(float(grasp.place[0]), low), high), high - low))

    def _rows(self, made: Comparison, cursor: float) -> list[tuple[str, float, float]]:
        """Return the values at the cursor, and those that are farthest apart, if any are."""
        chosen = self.chooser
        surface, at = self.lab.result.surface, np.array([cursor])
        pair = values(chosen.entry, surface, at, chosen.height, chosen.axis.value)
        rows = [(f"at t = {said(cursor, 4)}", float(pair[0][0]), float(pair[1][0]))]
        if (worst := made.largest) is not None and not made.agree:
            label = f"farthest apart, at t = {said(made.t[worst], 3)}"
            rows.append((label, float(made.printed[worst]), float(made.mended[worst])))
        return rows

    def _draw_numbers(self, made: Comparison) -> None:
        words = in_words(self.chooser.entry, made)
        self.picture.value = number_lines(made, words)
        rows = zip(made.names, made.printed.tolist(), made.mended.tolist(), strict=True)
        self.numbers.value = table([(f"{name} ({unit})", p, m) for (name, unit), p, m in rows])
        self.note.value = _note(words)


def _true(difference: Array) -> Array:
    """Return a difference without its rounding errors: zero is to look like zero."""
    return np.where(np.abs(difference) < ROUNDING, 0.0, difference)


def _note(words: str) -> str:
    return f'<div class="ruledlab-note" role="status">{html.escape(words)}</div>'


def _htmls(count: int) -> list[Any]:
    return [w.HTML() for _ in range(count)]


ALIGNED = "display:inline-block;min-width:6.5em"
"""Of the words before both formulas, so that these stand one below the other."""


def formulas_html(entry: Finding) -> str:
    """Return both formulas, and how the slip can be seen, for an HTMLMath."""
    rows = _formula("as printed", entry.printed_latex) + _formula("mended", entry.corrected_latex)
    where = gallery.example(entry.design).title
    only = f"<p>This speaks of <i>{html.escape(where)}</i> alone.</p>" if entry.only else ""
    return (
        f"{rows}<details><summary>How one can see it</summary><p>{html.escape(entry.how_to_see)}"
        f"</p><p>Do the two ever agree? {html.escape(entry.agreement)}</p>{only}</details>"
    )


def _formula(word: str, latex: str) -> str:
    """Return one formula; what its letters stand for goes into a line of its own."""
    formula, _, where = html.escape(latex).partition(r"\qquad\text{with }")
    meaning = f'<p style="margin:2px 0 6px">with \\({where}\\)</p>' if where else ""
    return (
        f'<p role="group" aria-label="{word}" tabindex="0" style="margin:6px 0;overflow-x:auto">'
        f'<b style="{ALIGNED}">{word}</b> '
        f"\\(\\displaystyle {formula}\\)</p>{meaning}"
    )
