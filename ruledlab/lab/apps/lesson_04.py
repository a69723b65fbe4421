"""Lesson 04: the invariants along the rulings, with frame, screw, special rulings and equations."""

from __future__ import annotations

import html
import re
from dataclasses import dataclass, replace
from typing import Any, Final

import ipywidgets as w
import numpy as np

from ...design import Design
from ...geometry.checks import Array, GeometryError
from ...geometry.motion import FrameEquations, Screw, StrictionLength, frame_equations, screw
from ...geometry.special import SpecialRulings, special_rulings
from ..controls import (
    GalleryControl,
    Group,
    HistoryControl,
    PointControl,
    Readouts,
    TimeControl,
    error_html,
    plain,
)
from ..overlay import Dot, Label, Overlay, Stroke
from ..pad import DomainPad
from ..plots import QUANTITIES, CurvePlots
from ..scene import SYMBOLS, Mark, Scene
from ..slate import Change
from ..state import Lab
from ..view3d import SurfaceView
from .base import LabApp
from .studio import _connect, _follow_theme

__all__ = ["AlongTheRulings", "Place", "along_the_rulings", "places"]

START: Final = Design(
    ((0.0, np.pi / 4), (2 * np.pi, np.pi / 4)),
    "0.4*sin(3*u)",
    "0.6",
    closing="C2",
    length=2.4,
    name="Ring with six torsal rulings",
)
"""δ = 0.6 + 1.2 cos 3u, κ = τ = √2 π: torsal where cos 3u = −1/2, that is t = 1/9, 2/9, 4/9 …"""

RATES: Final = ("kappa", "kappa_bar", "tau", "tau_bar")
LIFT: Final = 0.5
MOST: Final = 12
"""Special rulings that get a button each."""

EQUATIONS: Final = (
    ("x₁′ = κx₂", "x̄₁′ = κ̄x₂ + κx̄₂"),
    ("x₂′ = −κx₁ + τx₃", "x̄₂′ = −κ̄x₁ + τ̄x₃ − κx̄₁ + τx̄₃"),
    ("x₃′ = −τx₂", "x̄₃′ = −τ̄x₂ − τx̄₂"),
)


def along_the_rulings(design: Design | None = None, cursor: float = 0.05) -> AlongTheRulings:
    """Return the six invariants, the frame, its screw and its equations under one cursor.

    Parameters
    ----------
    design
        where to begin; None for a ring with six torsal rulings, on which κ̄ changes its sign.
    cursor
        the t to begin with.
    """
    return AlongTheRulings(Lab(design or START, cursor))


# ---- what there is to show: no widgets ----------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Place:
    """One special ruling: its t, its kind, and what is special in a few words."""

    t: float
    kind: str
    word: str


def places(found: SpecialRulings) -> tuple[Place, ...]:
    """Return the single special rulings in their order."""
    crossing = "κ̄ = δ = 0, and κ̄ changes its sign"
    touching = "κ̄ = δ = 0, and κ̄ keeps its sign"
    single = [
        Place(float(t), "torsal", touching if touches else crossing)
        for t, touches in zip(found.torsal, found.touching, strict=True)
    ]
    single += [Place(float(t), "cylindrical", "κ = 0") for t in found.cylindrical]
    return tuple(sorted(single, key=lambda place: place.t))


def found_words(found: SpecialRulings) -> str:
    """Say in words which special rulings there are."""
    single = places(found)
    said = [
        f"{word} from t = {a:.4g} to {b:.4g}."
        for word, stretches in (
            ("Torsal throughout (κ̄ = 0, developable)", found.developable),
            ("Cylindrical throughout (κ = 0)", found.cylinders),
        )
        for a, b in stretches
    ]
    if single:
        count = f"{len(single)} special ruling" + ("s" if len(single) > 1 else "")
        many = f", of which the first {MOST} have a button" if len(single) > MOST else ""
        said.append(f"{count}{many}. Press one to go there.")
    return " ".join(said) or "No torsal and no cylindrical ruling: κ and κ̄ have no zero."


def ruling_ends(design: Design, surface: Any, t: Array) -> Array:
    """Return (N, 2, 3) both ends of the drawn rulings at t."""
    base = surface.striction(t) if design.base == "striction" else surface.foot(t)
    half = 0.5 * design.length * surface.line(t).direction
    return np.stack([base - half, base + half], axis=1)


def special_strokes(design: Design, surface: Any, single: tuple[Place, ...]) -> Overlay:
    """Return the special rulings as strokes, numbered at their ends as the buttons are."""
    t = np.array([place.t for place in single])
    ends = ruling_ends(design, surface, t)
    inks = ["delta" if place.kind == "torsal" else "kappa" for place in single]
    numbered = list(enumerate(zip(ends, inks, strict=True), 1))
    return Overlay(
        strokes=tuple(Stroke(pair, ink, 4.0, name=f"special {i}") for i, (pair, ink) in numbered),
        labels=tuple(Label(pair[1], str(i), ink) for i, (pair, ink) in numbered),
    )


def screw_strokes(now: Screw, striction: Array, length: float) -> Overlay:
    """Return the screw axis with its pitch, and the way to it from the striction point."""
    axis = np.array([-0.6, 0.6])[:, None] * length * now.axis.direction + now.point
    return Overlay(
        strokes=(
            Stroke(axis, "ink", 2.5, dashed=True, arrow=True, name="screw axis"),
            Stroke(np.stack([striction, now.point]), "faint", 1.5, name="along x₂"),
        ),
        dots=(Dot(now.point, "ink", 7.0),),
        labels=(Label(axis[1], f"h = {signed(float(now.pitch), 3)}", "ink"),),
    )


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


def signed(value: float, digits: int = 4) -> str:
    """Return a number with a minus sign that is one; a zero has none."""
    if not np.isfinite(value):
        return "–"
    text = f"{value:.{digits}f}"
    return text.replace("-", "−" if float(text) else "")


def equations_html(both: FrameEquations, largest: float) -> str:
    """Return the frame equations at one t as a table: left side, right side, residual."""
    rows = "".join(
        f"<tr><td>{EQUATIONS[i][j]}</td><td>{_vector(both.left[i, j])}</td>"
        f"<td>{_vector(both.right[i, j])}</td><td>{_tiny(both.residual[i, j])}</td></tr>"
        for i in range(3)
        for j in range(2)
    )
    return (
        '<div style="overflow-x:auto"><table class="ruledlab-numbers" style="font-size:13px">'
        "<tr><th>equation</th><th>left: the frame differentiated</th>"
        "<th>right: frame and invariants</th>"
        f'<th style="white-space:nowrap">|left − right|</th></tr>{rows}</table></div>'
        f'<div class="ruledlab-note">Largest residual over all drawn rulings: {_tiny(largest)}. '
        "Both sides are taken by t, whatever the plots are drawn over.</div>"
    )


def _vector(entries: Array) -> str:
    return f"({', '.join(signed(float(x)) for x in entries)})"


def _tiny(value: float) -> str:
    return f"{value:.1e}".replace("-", "−") if np.isfinite(value) else "–"


# ---- views and controls -------------------------------------------------------------------------


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


class PlotControl(Group):
    """Which invariants are plotted, and over what."""

    def __init__(self, lab: Lab, plots: ArcPlots) -> None:
        super().__init__()
        self._lab, self._plots = lab, plots
        self.axis = w.ToggleButtons(options=[("over t", "t"), ("over s", "s")])
        self.axis.style.button_width = "72px"
        self.axis.tooltips = ["the parameter t", "the arc length s of the striction curve"]
        self.note, self.error = w.HTML(), w.HTML()
        self.toggles = {name: self._toggle(name) for name in SYMBOLS}
        bar = w.HBox([self.axis, *self.toggles.values()]).add_class("ruledlab-bar")
        self.widget = w.VBox([bar, self.error, self.note])
        self.on(self.axis, "value", lambda _: self._redraw())

    def _toggle(self, name: str) -> Any:
        layout = w.Layout(width="40px")
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
        self.put(self.note, value=_axis_note(self._plots.length))


def _length_of(lab: Lab) -> StrictionLength:
    length = StrictionLength(lab.result.surface)
    if length.total < 1e-9 * lab.design.length:
        raise GeometryError("s must grow along the striction curve; this one is a point: use t")
    return length


def _axis_note(length: StrictionLength | None) -> str:
    said = (
        "Over the parameter t: κ, κ̄, τ, τ̄ for each unit of t."
        if length is None
        else f"Over the arc length s of the striction curve, 0 … {length.total:.4g}: κ/s′, κ̄/s′ = "
        "sin σ, τ/s′, τ̄/s′ = cos σ with s′ = √(κ̄² + τ̄²), and σ, δ as they are. No change of "
        "parameter alters these curves."
    )
    return f'<div class="ruledlab-note">{said}</div>'


class SpecialControl(Group):
    """The special rulings as buttons that bring the cursor there."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        self.single: tuple[Place, ...] = ()
        self.note = w.HTML()
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
        for index, button in enumerate(self.buttons):
            shown = index < len(self.single)
            self.put(button.layout, display="" if shown else "none")
            if shown:
                place = self.single[index]
                said = f"{index + 1}: {place.kind}, t = {place.t:.4f}"
                self.put(button, description=said, tooltip=place.word)


class ChangeControl(Group):
    """Reversal and a rigid motion, each with a table of what it changed on the same ruling."""

    def __init__(self, lab: Lab) -> None:
        super().__init__()
        self._lab = lab
        layout = w.Layout(width="auto")
        self.reverse = w.Button(description="reverse", icon="exchange", layout=layout)
        self.reverse.tooltip = "run through the same rulings from the last to the first"
        self.lift = w.Button(description="lift", icon="arrow-up", layout=layout)
        self.lift.tooltip = f"move the whole surface up by {LIFT:g}: ū becomes ū + {LIFT:g}"
        self.error, self.table = w.HTML(), w.HTML()
        self.bar = w.HBox([self.reverse, self.lift]).add_class("ruledlab-bar")
        self.widget = w.VBox([self.error, self.table])
        self.click(self.reverse, lambda: self._change("reversed", self._reversed))
        self.click(self.lift, lambda: self._change("lifted", self._lifted))
        self.follow(lab, self.update)

    def _change(self, word: str, make: Any) -> None:
        before = _numbers(self._lab)
        if not self._lab.attempt("change", make):
            return
        if word == "reversed":
            self._lab.move_cursor(sum(self._lab.result.surface.domain) - self._lab.cursor)
        self.put(self.table, value=_compared(word, before, _numbers(self._lab)))

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
            self.put(self.table, value="")


def _numbers(lab: Lab) -> dict[str, float]:
    values = {SYMBOLS[name]: value for name, value in lab.mark.values.items()}
    return values | {"h": float(screw(lab.result.surface, lab.cursor).pitch)}


def _compared(word: str, before: dict[str, float], after: dict[str, float]) -> str:
    pairs = [(name, signed(before[name]), signed(after[name])) for name in before]
    head = "".join(f"<th>{name}</th>" for name, _, _ in pairs)
    rows = "".join(
        f"<tr><th>{label}</th>"
        + "".join(
            f"<td>{'<b>' + pair[i] + '</b>' if pair[1] != pair[2] else pair[i]}</td>"
            for pair in pairs
        )
        + "</tr>"
        for i, label in ((1, "before"), (2, word))
    )
    style = "overflow-x:auto"
    return (
        f'<div style="{style}" role="status"><table style="font-size:13px">'
        f"<tr><th>this ruling</th>{head}</tr>{rows}</table></div>"
    )


class AlongTheRulings(LabApp):
    """Surface, plots, screw, special rulings and frame equations under one cursor."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.view, self.pad = SurfaceView(480, 400), DomainPad()
        self.plots = ArcPlots(("kappa_bar", "tau_bar", "sigma", "delta"))
        self.time, self.history, self.gallery = TimeControl(lab), HistoryControl(lab), None
        self.gallery, self.points, self.words = (
            GalleryControl(lab),
            PointControl(lab),
            Readouts(lab),
        )
        self.axis, self.special = PlotControl(lab, self.plots), SpecialControl(lab)
        self.changes = ChangeControl(lab)
        self.screw, self.equations = w.HTML(), w.HTML()
        self._fixed, self._largest = Overlay(), 0.0
        self._views = [self.plots, self.view, self.pad]
        self._groups = [self.time, self.history, self.gallery, self.points, self.words]
        self._groups += [self.axis, self.special, self.changes]
        self._releases += [
            _connect(self.pad, self.points),
            _follow_theme(self.pad, self.points, self.restyle),
            self.plots.on_pick(self._picked),
        ]
        self.assemble(*self._rows())

    def _rows(self) -> tuple[Any, ...]:
        head = w.Box([self.gallery.widget, self.history.widget, self.changes.bar])
        left = [self.view.widget, self.time.widget, self.screw, self.special.widget]
        pair = w.HBox([w.VBox(left), w.VBox([self.axis.widget, self.plots.widget])])
        chart = w.HBox([self.pad, self.points.widget]).add_class("ruledlab-pair")
        folded = w.Accordion([chart, self.words.words])
        folded.titles = ("The chart: move the control points", "In words")
        folded.observe(lambda change: self.words.listen(change["new"] == 1), "selected_index")
        return (
            head.add_class("ruledlab-head"),
            self.changes.widget,
            pair.add_class("ruledlab-pair"),
            self.equations,
            self.gallery.note,
            folded,
        )

    def _picked(self, place: float) -> None:
        self.time.guard(lambda: self.lab.move_cursor(self.plots.t_of(place)))

    def update(self, change: Change) -> None:
        """Draw what changed."""
        if change.scene:
            self._find()
        super().update(change)
        if change.scene or change.mark:
            self._follow()

    def _find(self) -> None:
        """Find what depends on the surface alone."""
        self.axis.measure()
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
        self.screw.value = _screw_html(now, lab.mark.striction)
        self.equations.value = equations_html(frame_equations(surface, lab.cursor), self._largest)
        self.view.describe(f"{lab.result.scene.text} {lab.mark.text} {_screw_words(now)}")

    def restyle(self, dark: bool) -> None:
        """Change all views to the light or the dark theme."""
        super().restyle(dark)
        self._follow()


def _screw_words(now: Screw) -> str:
    if not np.isfinite(now.pitch):
        return "There is no frame and no screw: κ = 0."
    return f"The frame screws with pitch h = {signed(float(now.pitch))} about the dashed axis."


def _screw_html(now: Screw, striction: Array) -> str:
    away = float(np.linalg.norm(now.point - striction))
    rows = (
        ("screw pitch", "h", float(now.pitch), "length per rad"),
        ("angular speed", "√(κ² + τ²)", float(now.angular_speed), "rad per t"),
        ("axis from striction point", "along x₂", away, "length"),
    )
    body = "".join(
        f"<tr><td>{name} <i>{html.escape(symbol)}</i></td><td>{signed(value)}</td>"
        f"<td>{unit}</td></tr>"
        for name, symbol, value, unit in rows
    )
    return f'<table class="ruledlab-numbers">{body}</table>'
