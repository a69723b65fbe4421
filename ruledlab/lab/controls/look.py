"""What is drawn, and how."""

from __future__ import annotations

from typing import Any

import ipywidgets as w

from ..scene import SYMBOLS
from ..slate import Change
from ..state import Lab
from .group import Group, Strokes, home_button, menu, plain
from .number import NumberControl

__all__ = ["LookControl"]

UNITS = {
    "kappa": "rad per t",
    "kappa_bar": "length per t",
    "tau": "rad per t",
    "tau_bar": "length per t",
    "sigma": "rad",
    "delta": "length",
}


class LookControl(Group):
    """What is drawn and how: ruling length, samples, colours, the sphere, the plots."""

    def __init__(self, lab: Lab, view: Any, plots: Any) -> None:
        super().__init__()
        self._lab, self._view, self._plots, self._strokes = lab, view, plots, Strokes()
        colourings = [("plain", "plain"), ("δ", "delta"), ("K", "gauss"), ("H", "mean")]
        self.colour = menu("colour", colourings, "plain")
        self.sphere = menu(
            "sphere", [("inset", "inset"), ("large", "large"), ("off", "off")], "inset"
        )
        self.home = home_button()
        self.legend = w.HTML(layout=w.Layout(min_height="0"))
        self.length = NumberControl(
            self, "length", "length of the drawn rulings", (0.1, 10.0), 0.05, self._set_length
        )
        self.samples = NumberControl(
            self,
            "samples",
            "number of rulings computed",
            (50, 800),
            10,
            self._set_samples,
            whole=True,
            fixed=True,
        )
        self.base = menu(
            "centred on", [("striction curve", "striction"), ("foot points", "foot")], "striction"
        )
        self.parts = [
            self._part(name, words)
            for name, words in (
                ("surface", "surface"),
                ("rulings", "rulings"),
                ("striction", "striction curve"),
                ("frame", "moving frame"),
            )
        ]
        self.quantities = {name: self._quantity(name) for name in SYMBOLS}
        self.bar = w.HBox([self.colour, self.sphere, self.home]).add_class("ruledlab-bar")
        self.plot_bar = w.HBox(list(self.quantities.values())).add_class("ruledlab-bar")
        self.more = w.VBox(
            [
                self.length.widget,
                self.samples.widget,
                w.HBox([self.base, *self.parts]).add_class("ruledlab-bar"),
            ]
        )
        self.on(self.colour, "value", lab.colour)
        self.on(self.sphere, "value", view.sphere)
        self.on(self.base, "value", lambda base: lab.edit("look", base=base))
        self.click(self.home, view.reset_view)
        self.follow(lab, self.update)
        self.update(Change(scene=True))

    def _part(self, name: str, words: str) -> Any:
        room = w.Layout(width="auto")
        box = w.Checkbox(value=True, description=words, indent=False, layout=room)
        self.on(box, "value", lambda shown: self._view.show(**{name: shown}))
        return box

    def _quantity(self, name: str) -> Any:
        shown = name in self._plots.names
        room = w.Layout(width="44px")
        toggle = w.ToggleButton(value=shown, description=SYMBOLS[name], layout=room)
        toggle.tooltip = f"plot {SYMBOLS[name]} over t ({UNITS[name]})"
        self.on(toggle, "value", lambda _: self._choose_plots())
        return toggle

    def _choose_plots(self) -> None:
        names = [name for name, toggle in self.quantities.items() if toggle.value]
        if names:
            self._plots.choose(names)
        else:  # at least one stays
            for name in self._plots.names:
                self.put(self.quantities[name], value=True)

    def _set_length(self, length: float) -> None:
        self._lab.edit("length", self._strokes.token("length"), length=length)

    def _set_samples(self, samples: float) -> None:
        self._lab.edit("samples", self._strokes.token("samples"), samples=int(samples))

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source in ("length", "samples"):
                getattr(self, change.source).say(plain(change.error))
            return
        if change.scene:
            design = self._lab.design
            self.length.show(design.length)
            self.samples.show(design.samples)
            self.put(self.base, value=design.base)
            self.put(self.colour, value=self._lab.colouring)
            self.put(self.legend, value=self._view.legend_html(self._lab.result.scene))
