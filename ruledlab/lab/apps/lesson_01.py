"""Lesson 01: a function at a dual number, as a picture. The tangent carries the dual part."""

from __future__ import annotations

import html
import math
from typing import Final

import ipywidgets as w
import numpy as np

from ...geometry import FormulaError, function
from ..axes import Limits
from ..controls import (
    Group,
    HistoryControl,
    NumberControl,
    Strokes,
    error_html,
    plain,
    readable,
)
from ..handles import Grasp, Grip
from ..scenes.dual_graph import (
    STEP_SPAN,
    STYLE,
    X_SPAN,
    DualPoint,
    DualScene,
    dual_scene,
    flat,
    height_limits,
    picture,
    readout,
    words,
)
from ..slate import Change, Slate
from .base import App

__all__ = ["DualNumbers", "dual_numbers"]

MENU: Final = (
    ("x²", "x**2"),
    ("x³ − x", "x**3 - x"),
    ("sin x", "sin(x)"),
    ("cos x", "cos(x)"),
    ("exp x", "exp(x)"),
    ("√x", "sqrt(x)"),
    ("1/x", "1/x"),
    ("|x|", "abs(x)"),
    ("log x", "log(x)"),
)


SNAP: Final = 0.05
"""A handle moves in the sliders' steps: so 0, where many functions have no slope, can be met."""


FORMULA_SET: Final = ("formula", "reset")
"""Sources that put a formula in place: what was typed wrong before is gone."""


def dual_numbers(formula: str = "x**2", x: float = 1.5, x_bar: float = 0.5) -> DualNumbers:
    """Return the app of lesson 01: f(x + ε x̄) = f(x) + ε x̄ f′(x) on the graph of f.

    Parameters
    ----------
    formula
        f, typed in x.
    x, x_bar
        real and dual part of the argument, |x| ≤ 3 and |x̄| ≤ 1.
    """
    return DualNumbers(Slate(DualPoint(formula, x, x_bar), dual_scene))


# -- the app ---------------------------------------------------------------------------------------


KEY: Final = (
    '<div class="ruledlab-note">Drag either dot: the golden one moves x, the orange one x̄. '
    'Heavy lines: the <span class="step-word">step x̄</span> and the '
    '<span class="rise-word">rise x̄ f′(x)</span> along the tangent. Hollow ring: the ordinary '
    "value f(x + x̄), which a dual number never asks for.</div>"
)


def grips(scene: DualScene) -> tuple[Grip, ...]:
    """Return the handles: the point of the graph moves x, the tip of the tangent moves x̄.

    A point that is not there is taken where it would stand on the axis.
    """
    x, step, lifted = scene.point.x, scene.point.x_bar, scene.lifted
    real = float(lifted.value.real)
    height = real if math.isfinite(real) else 0.0
    made = [Grip(np.array([x, height, 0.0]), "point", "cursor", "x, the point of the graph")]
    if not lifted.undefined:
        tip = np.array([x + step, scene.tip, 0.0])
        made.append(Grip(tip, "point", "tau", "x̄, the tip of the step along the tangent"))
    return tuple(made)


class DualControl(Group):
    """The formula, x and x̄."""

    def __init__(self, slate: Slate[DualPoint, DualScene]) -> None:
        super().__init__()
        self._slate, self._strokes = slate, Strokes()
        self._refused: str | None = None  # the formula that stayed when another was refused
        self.typed = w.Text(continuous_update=False, layout=w.Layout(width="auto", flex="1 1 90px"))
        self.typed.tooltip = "f(x), a formula such as x**3 - x"
        room = w.Layout(width="92px", flex="0 0 auto")
        self.menu = w.Dropdown(options=[("typed", ""), *MENU], layout=room)
        self.menu.tooltip = "functions to choose from"
        self.error = w.HTML()
        label = w.HTML('<span class="ruledlab-label" title="f(x), a formula in x">f(x) =</span>')
        self.x = self._number("x", "x, the real part", X_SPAN)
        self.x_bar = self._number("x̄", "x̄, the dual part", STEP_SPAN)
        self.widget = w.VBox(
            [
                w.HBox([label, self.typed, self.menu]).add_class("ruledlab-row"),
                self.error,
                self.x.widget,
                self.x_bar.widget,
            ]
        )
        self.on(self.typed, "value", self._type)
        self.on(self.menu, "value", lambda text: text and self._type(text))
        self.follow(slate, self.update)
        self.update(Change(scene=True))

    def _number(self, label: str, name: str, span: tuple[float, float]) -> NumberControl:
        entry = "x_bar" if label == "x̄" else "x"

        def commit(value: float) -> None:
            self._slate.edit(entry, self._strokes.token(entry), **{entry: value})

        return NumberControl(self, label, name, span, SNAP, commit, fixed=True)

    def grasp(self, grasp: Grasp) -> None:
        """Move x or x̄ to where its handle is wanted."""
        entry, (low, high), start = (
            ("x", X_SPAN, 0.0),
            ("x_bar", STEP_SPAN, self._slate.value.x),
        )[grasp.index]
        to = round(round((float(grasp.place[0]) - start) / SNAP) * SNAP, 10)
        self._slate.edit(entry, ("handle", *grasp.drag), **{entry: min(max(to, low), high)})

    def _type(self, text: str) -> None:
        try:
            meant = readable(text, ("x",), function)
        except FormulaError as error:
            self._refused = self._slate.value.formula
            self.put(self.error, value=error_html(plain(error.message), error.pointer(36)))
            self.put(self.menu, value="")
        else:
            self._slate.edit("formula", formula=meant)

    def update(self, change: Change) -> None:
        """Follow the slate; a formula that was refused stays to be mended until f changes."""
        value = self._slate.value
        if change.error is not None or not (change.scene or change.source in FORMULA_SET):
            return
        if self._refused != value.formula or change.source in FORMULA_SET:
            self._refused = None
            self.put(self.typed, value=value.formula)
            self.put(self.error, value="")
            known = [text for _, text in MENU]
            self.put(self.menu, value=value.formula if value.formula in known else "")
        self.x.show(value.x)
        self.x_bar.show(value.x_bar)


class DualNumbers(App):
    """The graph of f with x + ε x̄ on its tangent.

    Attributes
    ----------
    slate
        the state: what was chosen, and what follows.
    """

    def __init__(self, slate: Slate[DualPoint, DualScene]) -> None:
        self.slate = slate
        self._limits: Limits | None = None
        self._drawn = ""
        self.picture, self.numbers, self.words = w.HTML(), w.HTML(), w.HTML()
        self.formula = w.HTMLMath()
        super().__init__(slate)
        self.control, self.history = DualControl(slate), HistoryControl(slate)
        self.grips = self.handles(self.control, self.control.grasp)
        self._groups = [self.control, self.history]
        side = [self.history.widget, self.control.widget, self.formula, self.numbers, self.words]
        left = w.VBox(
            [self.grips.over(self.picture), w.HTML(KEY)], layout=w.Layout(flex="3 1 340px")
        )
        pair = w.HBox([left, w.VBox(side, layout=w.Layout(flex="2 1 320px"))]).add_class(
            "ruledlab-pair"
        )
        self.assemble(w.HTML(STYLE), pair)

    def update(self, change: Change) -> None:
        """Draw what changed; the axis of heights begins anew with another function."""
        if not change.scene:
            return
        scene = self.slate.result
        present = self._limits if self._drawn == scene.f.text else None
        self._limits, self._drawn = height_limits(scene, present), scene.f.text
        self.picture.value = picture(scene, self._limits)
        self.grips.draw(grips(scene), flat(self._limits))
        self.numbers.value = readout(scene)
        self.formula.value = f"$f(x) = {scene.f.latex}$"
        text = html.escape(words(scene))
        self.words.value = f'<div class="ruledlab-note" role="status">{text}</div>'
