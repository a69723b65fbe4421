"""The formulas ū and v̄, typed or chosen by name."""

from __future__ import annotations

import html
from typing import Any

import ipywidgets as w

from ...geometry.choices import CHOICES
from ...geometry.field import field
from ...geometry.formula import FormulaError
from ..slate import Change
from ..state import Lab
from .group import Group, error_html, plain, readable

__all__ = ["FieldControl"]

WHOLE = ("pair", "reset", "gallery", "share")
"""Sources that put both formulas in place: what was typed wrong before is gone."""


class FieldControl(Group):
    """The choices ū(u, v) and v̄(u, v): named pairs, and a menu and a typed formula for each."""

    MENU = ("0", "1", "u", "v", "u - v", "u + v", "0.5*u", "sin(2*u)", "cos(v)", "sin(u)*v")

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self._waiting: dict[str, str] = {}
        self.pair = w.Dropdown(
            options=[("named choices …", "")] + [(choice.title, choice.key) for choice in CHOICES],
            layout=w.Layout(width="auto", flex="1 1 120px"),
        )
        self.meaning = w.HTML()
        self.rows = {
            name: self._row(name, symbol) for name, symbol in (("ubar", "ū"), ("vbar", "v̄"))
        }
        self.typeset = w.HTMLMath()
        label = w.HTML('<span class="ruledlab-label">ū, v̄</span>')
        self.widget = w.VBox(
            [
                w.HBox([label, self.pair]).add_class("ruledlab-row"),
                *(box for _, _, _, box in self.rows.values()),
                self.typeset,
                self.meaning,
            ]
        )
        self.on(self.pair, "value", self._choose)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    def _row(self, name: str, symbol: str) -> tuple[Any, Any, Any, Any]:
        typed = w.Text(continuous_update=False, layout=w.Layout(width="auto", flex="1 1 90px"))
        typed.tooltip = f"{symbol}(u, v): a formula such as sin(2*u)*v"
        menu = w.Dropdown(
            options=[("…", ""), *((text, text) for text in self.MENU)],
            layout=w.Layout(width="72px", flex="0 0 auto"),
        )
        menu.tooltip = f"formulas for {symbol}"
        error = w.HTML()
        label = w.HTML(f'<span class="ruledlab-label">{symbol} =</span>')
        row = w.HBox([label, typed, menu]).add_class("ruledlab-row")
        self.on(typed, "value", lambda text: self._type(name, text))
        self.on(menu, "value", lambda text: text and self._type(name, text))
        return typed, menu, error, w.VBox([row, error])

    def _type(self, name: str, text: str) -> None:
        try:
            meant = readable(text, ("u", "v"), lambda typed: field(typed, name))
        except FormulaError as error:
            self._say(name, plain(error.message), error.pointer(40))
            return
        self._lab.edit(name, **{name: meant})

    def _choose(self, key: str) -> None:
        for choice in CHOICES:
            if choice.key == key:
                self._lab.edit("pair", ubar=choice.ubar, vbar=choice.vbar)

    def _say(self, name: str, text: str, pointer: str = "") -> None:
        """Show what is wrong with a formula, which stays in its field to be mended."""
        self._waiting[name] = getattr(self._lab.design, name)
        self.put(self.rows[name][2], value=error_html(text, pointer))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source in self.rows:
                self._say(change.source, plain(change.error))
            return
        if change.scene or change.source in (*self.rows, *WHOLE):
            self._show(change.source)

    def _show(self, source: str) -> None:
        design = self._lab.design
        for name, (typed, menu, error, _) in self.rows.items():
            formula = getattr(design, name)
            if self._waiting.get(name) != formula or source in (name, *WHOLE):
                self._waiting.pop(name, None)
                self.put(typed, value=formula)
                self.put(error, value="")
            self.put(menu, value="")
        ubar, vbar = (field(getattr(design, name)).latex for name in self.rows)
        self.put(self.typeset, value=rf"$\bar u = {ubar},\qquad \bar v = {vbar}$")
        named = next((c for c in CHOICES if (c.ubar, c.vbar) == (design.ubar, design.vbar)), None)
        self.put(self.pair, value=named.key if named else "")
        meaning = html.escape(named.meaning) if named else ""
        self.put(self.meaning, value=f'<div class="ruledlab-note">{meaning}</div>')
