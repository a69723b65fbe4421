"""Exercises of lesson 00: reading the notation, the chart, and the first lines of Python."""

from __future__ import annotations

import math

import numpy as np

from ..design import Design
from ..geometry import gallery
from ..geometry.checks import Array
from . import misconceptions as known
from .core import (
    Choose,
    Code,
    Condition,
    Drag,
    Draw,
    Exercise,
    FindSlip,
    Formula,
    Line,
    Made,
    Misconception,
    Number,
    Option,
)
from .tex import angle

__all__ = ["EXERCISES"]


def units(draw: Draw) -> Choose:
    """Ask what a doubling of all lengths changes."""
    options = (
        Option(
            r"$\bar\kappa,\ \bar\tau$ and $\delta$ double; $\kappa,\ \tau$ and $\sigma$ stay",
            r"A bar carries one length. $\delta=\bar\kappa/\kappa$ is a length too, and $\sigma$ "
            "is an angle between two directions.",
            right=True,
        ),
        Option(
            "all of them double",
            r"$\kappa$ and $\tau$ are measured in radians per $t$: they see directions only, and "
            "directions do not know how far apart the lines are.",
        ),
        Option(
            r"$\bar\kappa,\ \bar\tau$ double, all others stay",
            r"Look at the unit of $\delta=\bar\kappa/\kappa$: it is a length.",
        ),
        Option(
            r"$\kappa,\ \tau$ halve, as curvatures do",
            r"The curvature of a curve is measured per length. $\kappa$ and $\tau$ here are "
            r"measured per $t$; no length comes in.",
        ),
    )
    return Choose(
        question="A surface is enlarged: every length in it doubles, every direction stays. What "
        "happens to the invariants?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Read the column of units in the table of the notation.",
            r"Enlarging leaves $\mathbf x(t)$ as it is and doubles $\bar{\mathbf x}(t)$.",
        ),
        solution=r"Directions stay, moments double. So everything computed from $\mathbf x$ alone "
        r"stays, $\kappa,\ \tau$, and what has one bar doubles: $\bar\kappa,\ \bar\tau$ and "
        r"$\delta$. The angle $\sigma$ with $\tan\sigma=\bar\kappa/\bar\tau$ stays.",
    )


def colatitude(draw: Draw) -> Number:
    """Ask for a place on the globe in the chart."""
    degrees = draw.one_of((15, 30, 60, 75))
    value = math.pi / 2 + math.radians(degrees)
    return Number(
        question=f"A point of the globe lies at {degrees}° south. Which colatitude $v$ has it in "
        "our chart? A formula with pi is welcome.",
        answer=value,
        label="v =",
        unit="rad",
        slips=(
            known.mistaken_for(
                "latitude for colatitude",
                math.radians(degrees),
                "This is the latitude, counted from the equator. The colatitude $v$ is counted "
                "from the north pole.",
            ),
            known.mistaken_for(
                "north for south",
                math.pi / 2 - math.radians(degrees),
                r"This place lies in the north: at the equator $v=\tfrac\pi2$, and southwards $v$ "
                "grows.",
            ),
            known.degrees(value),
        ),
        because="The colatitude is 0 at the north pole and π at the south pole.",
        hints=(
            r"At the north pole $v=0$, at the equator $v=\tfrac\pi2$.",
            f"Southwards $v$ grows: add {degrees}° to a right angle, in radians.",
        ),
        solution=rf"$v=\tfrac\pi2+\tfrac{{{degrees}}}{{180}}\,\pi={value:.6f}$.",
    )


def direction(draw: Draw) -> Number:
    """Ask for a point of the unit sphere."""
    quarter, third = draw.integer(0, 3), draw.one_of((1, 2, 4, 5))
    u, v = quarter * math.pi / 2, third * math.pi / 6
    value = np.array([math.cos(u) * math.sin(v), math.sin(u) * math.sin(v), math.cos(v)])
    place = ("0", r"\tfrac\pi2", r"\pi", r"\tfrac{3\pi}2")[quarter]
    words = ", ".join(f"{entry:.4f}" for entry in value + 0.0)
    swapped = [math.cos(v) * math.sin(u), math.sin(v) * math.sin(u), math.cos(u)]
    return Number(
        question=rf"Which direction $\mathbf x$ belongs to the longitude $u={place}$ and the "
        rf"colatitude $v=\tfrac{{{third}\pi}}6$? Three numbers.",
        answer=value,
        label="x =",
        slips=(
            known.mistaken_for("u and v exchanged", swapped, "Here $u$ and $v$ are exchanged."),
            known.mistaken_for(
                "latitude for colatitude",
                [math.cos(u) * math.cos(v), math.sin(u) * math.cos(v), math.sin(v)],
                "So it would be if $v$ were the latitude, counted from the equator. Our $v$ is "
                r"counted from the north pole: for $v=0$ the direction is $(0,0,1)$.",
            ),
        ),
        because="Its length is 1, as it must be.",
        hints=(
            r"$\mathbf x=(\cos u\sin v,\ \sin u\sin v,\ \cos v)$.",
            r"The height above the equator is $\cos v$; what is left, $\sin v$, goes into the "
            "first two entries.",
        ),
        solution=rf"$\mathbf x=({words})$.",
    )


def moment(draw: Draw) -> Number:
    """Ask for the moment of a vertical line."""
    x, y = draw.integer(1, 4), draw.integer(-4, -1)
    value = np.array([y, -x, 0.0])
    return Number(
        question=rf"A line points straight up, $\mathbf x=(0,0,1)$, and passes through "
        rf"$\mathbf c=({x},{y},7)$. Which moment $\bar{{\mathbf x}}$ has it?",
        answer=value,
        label="x̄ =",
        unit="length",
        slips=(
            known.moment_sign(value),
            known.mistaken_for(
                "foot point for moment",
                [x, y, 0.0],
                "This is the foot point, the point of the line that is nearest to the origin. The "
                "moment stands at a right angle to it.",
            ),
        ),
        because="The height 7 does not matter: every point of the line gives the same moment.",
        hints=(
            r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$, in this order.",
            r"$(a,b,c)\times(0,0,1)=(b,-a,0)$.",
        ),
        solution=rf"$\bar{{\mathbf x}}=\mathbf c\times\mathbf x=({y},{-x},0)$.",
    )


def height(draw: Draw) -> Formula:
    """Ask for a coordinate in terms of the chart."""
    axis = draw.integer(0, 2)
    answer = ("cos(u)*sin(v)", "sin(u)*sin(v)", "cos(v)")[axis]
    name = ("first", "second", "third")[axis]
    wrong = ("cos(u)*cos(v)", "sin(u)*cos(v)", "sin(v)")[axis]
    return Formula(
        question=f"Write the {name} entry of the direction with longitude $u$ and colatitude $v$.",
        answer=answer,
        label=f"x{'₁₂₃'[axis]} =",
        slips=(
            known.formula(
                "latitude for colatitude",
                wrong,
                "So it would be with the latitude, counted from the equator. Our $v$ is the "
                "colatitude, counted from the north pole: sine and cosine of $v$ change places.",
            ),
        ),
        because="Every equivalent way of writing it is as good.",
        hints=(
            "At the north pole $v=0$, and the direction there is $(0,0,1)$ whatever $u$ is.",
            r"$\mathbf x=(\cos u\sin v,\ \sin u\sin v,\ \cos v)$.",
        ),
        solution=f"<code>{answer}</code>",
    )


def first_lines(draw: Draw) -> Code:
    """Ask for an invariant of a surface of the gallery."""
    t = draw.one_of((0.25, 0.4, 0.6, 0.75))
    found = gallery.surface("example_2").invariants(t)
    value = float(found.delta)
    return Code(
        question=rf"What is the distribution parameter $\delta$ of Example 2 at "
        rf"$t={t:g}$?",
        starter="from ruledlab.geometry import gallery\n\n"
        'surface = gallery.surface("example_2")\nvalue = ...',
        answer=value,
        label="δ =",
        unit="length",
        slips=(
            known.mistaken_for(
                "κ̄ for δ",
                float(found.kappa_bar),
                r"This is $\bar\kappa$, a length per $t$. Divide by $\kappa$, or ask for "
                "<code>.delta</code>.",
            ),
            known.delta_inverted(value),
        ),
        hints=(
            "A surface has <code>.invariants(t)</code>.",
            "What it returns has the invariants by their names in words: kappa, tau, …, delta.",
        ),
        solution=f"<pre>value = surface.invariants({t:g}).delta</pre>"
        rf"$\delta={value:.6f}$; at another $t$ it is another one.",
    )


def slip(draw: Draw) -> FindSlip:
    """Show the way from angles to a line, with one line wrong."""
    lines = (
        Line(
            r"The direction is $\mathbf x=(\cos u\sin v,\ \sin u\sin v,\ \cos v)$.",
            "This is the chart of the sphere as it is used everywhere here.",
        ),
        Line(
            r"Its length is 1, because $\sin^2 v\,(\cos^2 u+\sin^2 u)+\cos^2 v=1$.",
            "Pythagoras, twice.",
        ),
        Line(
            r"The line through the point $\mathbf c$ has the moment "
            r"$\bar{\mathbf x}=\mathbf x\times\mathbf c$."
        ),
        Line(
            r"So $\langle\mathbf x,\bar{\mathbf x}\rangle=0$: the moment stands at a right angle "
            "to the direction.",
            r"A cross product does, in whichever order it is taken.",
        ),
    )
    then = Choose(
        question="How does it have to be?",
        options=(
            Option(
                r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$",
                "The point first, then the direction, as the moment of a force.",
                right=True,
            ),
            Option(
                r"$\bar{\mathbf x}=\mathbf c-\langle\mathbf c,\mathbf x\rangle\mathbf x$",
                "That is the foot point: the point of the line nearest to the origin.",
            ),
            Option(
                r"$\bar{\mathbf x}=\mathbf c+\mathbf x$",
                "That is another point of the line.",
            ),
        ),
        order=draw.shuffled(3),
        solution=r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$.",
    )
    return FindSlip(
        question="One of these lines contradicts the conventions above. Which one?",
        lines=lines,
        then=then,
        hints=(
            "Two of the lines are about the direction alone, and both are right.",
            "Read the last sentence under the table of the notation.",
        ),
        solution=r"The moment is $\bar{\mathbf x}=\mathbf c\times\mathbf x$, not "
        r"$\mathbf x\times\mathbf c$. The last line is true for both signs and so does not help to "
        "tell them apart.",
    )


# -- the ends of a curve ---------------------------------------------------------------------------

AXES = (("x", 0.0), ("y", math.pi / 2), ("-x", math.pi))
"""Directions on the equator: the name of the half axis, and its longitude."""

WITHIN = 3.0  # degrees


def ends(draw: Draw) -> Drag:
    """Ask for a surface with a given first and a given last direction."""
    at = draw.integer(0, 1)
    (first, u), (last, end) = AXES[at], AXES[at + 1]
    start = Design(
        tuple((u + step, v) for step, v in ((0.5, 0.8), (0.6, 0.4), (1.1, 0.4), (1.2, 0.9))),
        name="somewhere in the north",
    )
    inner = start.points[1:-1]
    model = start.with_(points=((u, math.pi / 2), *inner, (end, math.pi / 2)))

    def conditions(made: Made) -> tuple[Condition, ...]:
        return (
            _points_along(made, 0, first, _equator(u)),
            _points_along(made, 1, last, _equator(end)),
        )

    return Drag(
        question=f"The moving line shall begin, at $t=0$, in the direction of the ${first}$-axis, "
        f"and end, at $t=1$, in that of the ${last}$-axis. What it does between the two is free. "
        "Drag the control points.",
        start=start,
        model=model,
        conditions=conditions,
        slips=(
            Misconception(
                "latitude for colatitude",
                lambda made: _leans(made, 0) < WITHIN or _leans(made, 1) < WITHIN,
                "At one end the line stands upright: that is the north pole, $v=0$. The colatitude "
                r"is counted from there; a horizontal direction lies on the equator, "
                r"$v=\tfrac\pi2$.",
                start.with_(points=((u, 0.01), *start.points[1:])),
            ),
            Misconception(
                "the other way round",
                lambda made: all(
                    _off(made, t, _equator(to)) < WITHIN for t, to in ((0, end), (1, u))
                ),
                "These are the two directions, but the line runs from the second to the first. The "
                r"curve begins at $\mathbf p_0$.",
                model.with_(points=model.points[::-1]),
            ),
        ),
        because="Only the two end points matter for this; the points between them may be anywhere.",
        hints=(
            "At its two ends a Bézier curve runs through its first and its last control point.",
            r"A horizontal direction lies on the equator, $v=\tfrac\pi2$; $u$ is the angle from "
            "the $x$-axis.",
            rf"$\mathbf p_0$ belongs to $u={angle(u)},\ v=\tfrac\pi2$, and the last point to "
            rf"$u={angle(end)},\ v=\tfrac\pi2$.",
        ),
        solution=rf"The first point at $(u,v)=({angle(u)},\tfrac\pi2)$, the last at "
        rf"$({angle(end)},\tfrac\pi2)$. The chart shows one such curve now.",
    )


def _equator(u: float) -> Array:
    return np.array([math.cos(u), math.sin(u), 0.0])


def _off(made: Made, t: float, to: Array) -> float:
    """Return how many degrees the line at t is off a direction."""
    x = made.surface.line(t).direction
    return math.degrees(math.atan2(float(np.linalg.norm(np.cross(x, to))), float(x @ to)))


def _leans(made: Made, t: float) -> float:
    return _off(made, t, np.array([0.0, 0.0, 1.0]))


def _points_along(made: Made, t: int, name: str, to: Array) -> Condition:
    return Condition(
        rf"the line at $t={t}$ points along the ${name}$-axis", _off(made, t, to), WITHIN, "°"
    )


EXERCISES = (
    Exercise("00.1", "Units", units),
    Exercise("00.2", "South of the equator", colatitude),
    Exercise("00.3", "A direction", direction),
    Exercise("00.4", "The moment of a vertical line", moment),
    Exercise("00.5", "One entry as a formula", height),
    Exercise("00.6", "The first lines of Python", first_lines),
    Exercise("00.7", "A slip in the conventions", slip),
    Exercise("00.8", "From here to there", ends),
)
"""The exercises in their order."""
