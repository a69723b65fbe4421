"""What lesson 04 shows beside a lab's scene, as plain values: special rulings, screw, equations.

Nothing is drawn here: strokes for the view in space, arrays for the plots, words and tables.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...design import Design
from ...geometry.checks import Array
from ...geometry.motion import FrameEquations, Screw
from ...geometry.special import SpecialRulings
from ...geometry.surface import RuledSurface
from ..overlay import Dot, Label, Overlay, Stroke

__all__ = [
    "MOST",
    "Place",
    "compared_words",
    "equations_html",
    "found_words",
    "numbers_html",
    "places",
    "screw_strokes",
    "screw_words",
    "signed",
    "special_strokes",
]

MOST: Final = 12
"""Special rulings that get a button each."""

BESIDE: Final = 1e-4
"""How far beside a ruling without a striction point one is looked for, in parts of the domain."""

EQUATIONS: Final = (
    ("x₁′ = κx₂", "x̄₁′ = κ̄x₂ + κx̄₂"),
    ("x₂′ = −κx₁ + τx₃", "x̄₂′ = −κ̄x₁ + τ̄x₃ − κx̄₁ + τx̄₃"),
    ("x₃′ = −τx₂", "x̄₃′ = −τ̄x₂ − τx̄₂"),
)


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


def ruling_ends(design: Design, surface: RuledSurface, t: Array) -> Array:
    """Return (N, 2, 3) both ends of the drawn rulings at t."""
    base = _middle(surface, t) if design.base == "striction" else surface.foot(t)
    half = 0.5 * design.length * surface.line(t).direction
    return np.stack([base - half, base + half], axis=1)


def _middle(surface: RuledSurface, t: Array) -> Array:
    """Return (N, 3) the striction points; on a cylindrical ruling, the mean of those beside it."""
    first, last = surface.domain
    step = BESIDE * (last - first)
    beside = surface.striction(np.clip(t + np.array([[-step], [step]]), first, last))
    foot, x = surface.foot(t), surface.line(t).direction
    along = ((beside.mean(axis=0) - foot) * x).sum(axis=-1, keepdims=True)
    there = foot + np.where(np.isfinite(along), along, 0.0) * x
    found = surface.striction(t)
    return np.where(np.isfinite(found), found, there)


def special_strokes(design: Design, surface: RuledSurface, single: tuple[Place, ...]) -> Overlay:
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
    axis = np.array([-0.42, 0.42])[:, None] * length * now.axis.direction + now.point
    return Overlay(
        strokes=(
            Stroke(axis, "ink", 2.5, dashed=True, arrow=True, name="screw axis"),
            Stroke(np.stack([striction, now.point]), "faint", 1.5, name="along x₂"),
        ),
        dots=(Dot(now.point, "ink", 7.0),),
        labels=(Label(axis[1], f"h = {signed(float(now.pitch), 3)}", "ink"),),
    )


def signed(value: float, digits: int = 4) -> str:
    """Return a number with a minus sign that is one; a zero has none."""
    if not np.isfinite(value):
        return "–"
    text = f"{value:.{digits}f}"
    return text.replace("-", "−" if float(text) else "")


def equations_html(both: FrameEquations, largest: float) -> str:
    """Return the frame equations at one t as a table: left side, right side, residual."""
    rows = [
        (EQUATIONS[i][j], _vector(both.left[i, j]), _vector(both.right[i, j]),
         _tiny(both.residual[i, j]))
        for i in range(3)
        for j in range(2)
    ]  # fmt: skip
    head = ("equation", "left: frame differentiated", "right: from κ, κ̄, τ, τ̄",
            "|left − right|")  # fmt: skip
    return _table(head, rows) + (
        f'<div class="ruledlab-note">Largest residual over all drawn rulings: {_tiny(largest)}. '
        "Both sides are taken by t, whatever the plots are drawn over.</div>"
    )


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; the first column names the rows."""
    top = "".join(f'<th scope="col">{text}</th>' for text in head)
    body = "".join(
        f'<tr><th scope="row">{first}</th>'
        + "".join(
            f'<td data-name="{name}">{x}</td>' for name, x in zip(head[1:], rest, strict=True)
        )
        + "</tr>"
        for first, *rest in rows
    )
    return f'<table class="ruledlab-sides"><tr>{top}</tr>{body}</table>'


def _vector(entries: Array) -> str:
    return f"({', '.join(signed(float(x)) for x in entries)})"


def _tiny(value: float) -> str:
    return f"{value:.1e}".replace("-", "−") if np.isfinite(value) else "–"


def screw_words(now: Screw) -> str:
    """Say what the frame's screw is."""
    if not np.isfinite(now.pitch):
        return "There is no frame and no screw: κ = 0."
    return f"The frame screws with pitch h = {signed(float(now.pitch))} about the dashed axis."


NUMBERS: Final = {
    "kappa": ("curvature", "κ", "rad/t"),
    "kappa_bar": ("its dual part", "κ̄", "length/t"),
    "tau": ("torsion", "τ", "rad/t"),
    "tau_bar": ("its dual part", "τ̄", "length/t"),
    "sigma": ("striction", "σ", "rad"),
    "delta": ("distribution parameter", "δ", "length"),
    "pitch": ("screw pitch", "h", "length/rad"),
    "speed": ("angular speed", "‖ω‖", "rad/t"),
    "away": ("screw axis from", "m", "length"),
}
"""The numbers at the cursor: name, symbol, unit."""


def numbers_html(now: Mapping[str, float], before: Mapping[str, float] | None = None) -> str:
    """Return the numbers at the cursor as a table; with what they were, where they differ."""
    before = now if before is None else before
    body = ""
    for name, (word, symbol, unit) in NUMBERS.items():
        value, old = signed(now[name]), signed(before[name])
        was = "" if old == value else f"was {old}"
        body += (
            f"<tr><td>{word} <i>{symbol}</i></td><td>{value}</td><td>{unit}</td><td>{was}</td></tr>"
        )
    return f'<table class="ruledlab-numbers ruledlab-now">{body}</table>'


def compared_words(word: str, before: Mapping[str, float], after: Mapping[str, float]) -> str:
    """Say which numbers of a ruling a change of the surface has changed."""
    changed = [
        "the place of the axis" if key == "away" else symbol
        for key, (_, symbol, _) in NUMBERS.items()
        if signed(before[key]) != signed(after[key])
    ]
    listed = f"{', '.join(changed)} changed, nothing else" if changed else "nothing changed"
    return f'<div class="ruledlab-note" role="status">{word}: {listed}.</div>'
