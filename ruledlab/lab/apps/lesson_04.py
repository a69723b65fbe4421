"""Lesson 04: the invariants along the rulings, with frame, screw, special rulings and equations."""

from __future__ import annotations

import html
from typing import Any, Final

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry import gallery
from ...geometry.checks import GeometryError
from ...geometry.motion import StrictionLength, frame_equations, screw
from ...geometry.special import special_rulings
from ..arc_plots import ArcPlots, axis_note
from ..controls import (
    GalleryControl,
    Group,
    HistoryControl,
    PointControl,
    TimeControl,
    design_of,
    error_html,
    home_button,
    plain,
)
from ..overlay import Overlay
from ..pad import DomainPad
from ..plots import QUANTITIES
from ..scene import SYMBOLS
from ..scenes.along import (
    MOST,
    Place,
    compared_words,
    equations_html,
    found_words,
    numbers_html,
    places,
    screw_strokes,
    screw_words,
    special_strokes,
)
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp, connect

__all__ = ["AlongTheRulings", "along_the_rulings"]

LIFT: Final = 0.5


def along_the_rulings(design: Design | None = None, cursor: float = 0.05) -> AlongTheRulings:
    """Return the six invariants, the frame, its screw and its equations under one cursor.

    Parameters
    ----------
    design
        where to begin; None for the gallery's wave ring, which has six torsal rulings.
    cursor
        the t to begin with.
    """
    return AlongTheRulings(Lab(design or _wave_ring(), cursor))


def _wave_ring() -> Design:
    """Return the wave ring with rulings long enough to be seen as lines."""
    return design_of(gallery.example("wave_ring")).with_(length=2.4)


class PlotControl(Group):
    """Which invariants are plotted, and over what."""

    def __init__(self, lab: Lab, plots: ArcPlots) -> None:
        super().__init__()
        self._lab, self._plots = lab, plots
        self.axis = w.ToggleButtons(options=[("over t", "t"), ("over s", "s")])
        self.axis.style.button_width = "62px"
        self.axis.tooltips = ["the parameter t", "the arc length s of the striction curve"]
        self.note, self.error = w.HTML(), w.HTML()
        self.toggles = {name: self._toggle(name) for name in SYMBOLS}
        bar = w.HBox([self.axis, *self.toggles.values()]).add_class("ruledlab-bar")
        self.widget = w.VBox([bar, self.error, self.note])
        self.on(self.axis, "value", lambda _: self._redraw())

    def _toggle(self, name: str) -> Any:
        layout = w.Layout(width="36px")
        button = w.ToggleButton(name in self._plots.names, description=SYMBOLS[name], layout=layout)
        button.tooltip = f"plot {QUANTITIES[name].word}"
        self.on(button, "value", lambda _: self._choose())
        return button

    def _choose(self) -> None:
        names = [name for name, button in self.toggles.items() if button.value]
        if names:
            self._plots.choose(names)
        else:  # at least one stays
            for name in self._plots.names:
                self.put(self.toggles[name], value=True)

    def _redraw(self) -> None:
        self.measure()
        self._plots.draw(self._lab.result.scene, self._lab.mark)

    def measure(self) -> None:
        """Give the plots the arc length of the present surface, if they are drawn over s."""
        self.put(self.error, value="")
        self._plots.length = None
        try:
            if self.axis.value == "s":
                self._plots.length = _length_of(self._lab)
        except GeometryError as error:
            self.put(self.error, value=error_html(plain(str(error))))
            self.put(self.axis, value="t")
        self.put(self.note, value=axis_note(self._plots.length))


def _length_of(lab: Lab) -> StrictionLength:
    length = StrictionLength(lab.result.surface)
    if length.total < 1e-9 * lab.design.length:
        raise GeometryError("s must grow along the striction curve; this one is a point: use t")
    return length


class SpecialControl(Group):
    """The special rulings as buttons that bring the cursor there."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.single: tuple[Place, ...] = ()
        self.note, self.places = w.HTML(), w.HTML()
        self.buttons = [w.Button(layout=w.Layout(width="auto")) for _ in range(MOST)]
        for index, button in enumerate(self.buttons):
            self.click(button, lambda index=index: lab.move_cursor(self.single[index].t))
        bar = w.HBox(self.buttons).add_class("ruledlab-bar")
        self.widget = w.VBox([self.note, bar])

    def find(self) -> None:
        """Find the special rulings of the present surface."""
        found = special_rulings(self._lab.result.surface)
        self.single = places(found)
        self.put(self.note, value=f'<div class="ruledlab-note" role="status">'
                                  f"{found_words(found)}</div>")  # fmt: skip
        where = ", ".join(f"{place.kind} at t = {place.t:.4f}" for place in self.single)
        self.put(self.places, value=f'<div class="ruledlab-note">Special rulings: '
                                    f"{where or 'none'}.</div>")  # fmt: skip
        for index, button in enumerate(self.buttons):
            shown = index < len(self.single)
            self.put(button.layout, display="" if shown else "none")
            if shown:
                place = self.single[index]
                said = f"{index + 1}: {place.kind}, t = {place.t:.4f}"
                self.put(button, description=said, tooltip=place.word)


class NumbersControl(Group):
    """The numbers at the cursor; a reversal or a rigid motion says which of them it changed."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        layout = w.Layout(width="auto")
        self.reverse = w.Button(description="reverse", icon="exchange", layout=layout)
        self.reverse.tooltip = "run through the same rulings from the last to the first"
        self.lift = w.Button(description="lift", icon="arrow-up", layout=layout)
        self.lift.tooltip = f"move the whole surface up by {LIFT:g}: ū becomes ū + {LIFT:g}"
        self.said, self.error, self.table = w.HTML(), w.HTML(), w.HTML()
        bar = w.HBox([self.reverse, self.lift, self.said]).add_class("ruledlab-bar")
        self.widget = w.VBox([self.table, bar, self.error])
        self.click(self.reverse, lambda: self._change("Reversed", self._reversed))
        self.click(self.lift, lambda: self._change("Lifted", self._lifted))
        self.follow(lab, self.update)
        self.update(Change(mark=True))

    def _change(self, word: str, make: Any) -> None:
        before = _numbers(self._lab)
        if not self._lab.attempt("change", make):
            return
        if word == "Reversed":
            self._lab.move_cursor(sum(self._lab.result.surface.domain) - self._lab.cursor)
        after = _numbers(self._lab)
        self.put(self.table, value=numbers_html(after, before))
        self.put(self.said, value=compared_words(word, before, after))

    def _reversed(self) -> Design:
        return self._lab.design.with_(points=self._lab.design.points[::-1])

    def _lifted(self) -> Design:
        # e₃ × x = x_u: a translation by a along the z-axis adds a to ū and nothing else.
        return self._lab.design.with_(ubar=f"({self._lab.design.ubar}) + {LIFT:g}")

    def update(self, change: Change) -> None:
        """Follow the lab: a comparison holds until something else happens."""
        mine = change.source == "change"
        self.put(self.error, value=error_html(plain(change.error or "")) if mine else "")
        if (change.scene or change.mark) and not mine:
            self.put(self.table, value=numbers_html(_numbers(self._lab)))
            self.put(self.said, value="")


def _numbers(lab: Lab) -> dict[str, float]:
    now = screw(lab.result.surface, lab.cursor)
    away = float(np.linalg.norm(now.point - lab.mark.striction))
    more = {"pitch": float(now.pitch), "speed": float(now.angular_speed), "away": away}
    return dict(lab.mark.values) | more


class AlongTheRulings(LabApp):
    """Surface, plots, screw, special rulings and frame equations under one cursor."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.view, self.pad = SurfaceView(480, 470), DomainPad()
        self.plots = ArcPlots(("kappa_bar", "tau_bar", "sigma", "delta"))
        self.time, self.history = TimeControl(lab), HistoryControl(lab)
        self.gallery, self.points = GalleryControl(lab), PointControl(lab)
        self.axis, self.special = PlotControl(lab, self.plots), SpecialControl(lab)
        self.numbers = NumbersControl(lab)
        self.home = home_button()
        self.numbers.click(self.home, lambda: self.view.reset_view(lab.result.scene))
        self.equations, self.words = w.HTML(), w.HTML()
        self._fixed, self._largest = Overlay(), 0.0
        self._views = [self.plots, self.view, self.pad]
        self._groups = [self.time, self.history, self.gallery, self.points]
        self._groups += [self.axis, self.special, self.numbers]
        self._releases += [
            connect(self.pad, self.points),
            self.plots.on_pick(self._picked),
        ]
        self.assemble(*self._rows())

    def _rows(self) -> tuple[Any, ...]:
        head = w.Box([self.gallery.widget, self.history.widget, self.home])
        left = [self.view.widget, self.time.widget, self.numbers.widget]
        right = [self.axis.widget, self.plots.widget, self.special.widget]
        pair = w.HBox([w.VBox(left), w.VBox(right)])
        hand = w.VBox([self.points.widget, self.special.places])
        chart = w.HBox([self.pad, hand]).add_class("ruledlab-pair")
        folded = w.Accordion([chart, self.words, self.gallery.note])
        folded.titles = (
            "The chart: move the control points",
            "In words",
            "What is known of this surface",
        )
        return (
            head.add_class("ruledlab-head"),
            pair.add_class("ruledlab-pair"),
            self.equations,
            folded,
        )

    def _picked(self, place: float) -> None:
        self.time.guard(lambda: self.lab.move_cursor(self.plots.t_of(place)))

    def update(self, change: Change) -> None:
        """Draw what changed."""
        if change.scene:
            self.axis.measure()
        super().update(change)
        if change.scene:
            self._find()  # the search takes longest: the pictures are on their way by now
        if change.scene or change.mark:
            self._follow()

    def _find(self) -> None:
        """Find what depends on the surface alone."""
        self.special.find()
        result = self.lab.result
        self._fixed = special_strokes(result.design, result.surface, self.special.single)
        residual = frame_equations(result.surface, result.scene.t).residual
        known = residual[np.isfinite(residual)]
        self._largest = float(known.max()) if known.size else np.nan

    def _follow(self) -> None:
        """Show what depends on the cursor."""
        lab, surface = self.lab, self.lab.result.surface
        now = screw(surface, lab.cursor)
        moving = screw_strokes(now, lab.mark.striction, lab.design.length)
        self.view.overlay(
            Overlay(
                (*self._fixed.strokes, *moving.strokes),
                moving.dots,
                (),
                (*self._fixed.labels, *moving.labels),
            )
        )
        self.equations.value = equations_html(frame_equations(surface, lab.cursor), self._largest)
        said = (lab.result.scene.text, lab.mark.text, screw_words(now))
        self.view.describe(" ".join(said))
        self.words.value = "".join(f"<p>{html.escape(text)}</p>" for text in said)

    def restyle(self, dark: bool) -> None:
        """Change all views to the light or the dark theme."""
        super().restyle(dark)
        self._follow()
