"""Exercises of lesson 07: what ū and v̄ choose, focal points, divergence and pitch."""

from __future__ import annotations

import math

import numpy as np

from ..geometry.checks import Array
from ..geometry.congruence import Congruence
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
    Sketch,
)
from .designs import EXAMPLE_2, at_least, has_pitch, values
from .tex import combination, times

__all__ = ["EXERCISES"]

OUTSIDE = (
    "counter-clockwise as seen from outside the sphere (and in the chart as it is drawn, with $v$ "
    "downwards)"
)
V = ("v",)
V_BOX = ((0.3, 2.8),)


# -- which lines are these? ------------------------------------------------------------------------


def apex(draw: Draw) -> Formula:
    """Ask for the ū of a bundle."""
    a, b, h = draw.integer(1, 3), draw.integer(1, 3), draw.integer(1, 4)
    answer = f"{h} - ({a}*cos(u) + {b}*sin(u))*cos(v)/sin(v)"
    return Formula(
        question=rf"Every line of the congruence shall pass through the point $({a},{b},{h})$. "
        rf"Then $\bar v={times(b)}\cos u-{times(a)}\sin u$. Write $\bar u$.",
        answer=answer,
        label="ū =",
        slips=(
            known.formula(
                "a point of the axis",
                f"{h}",
                r"With $\bar u$ constant and $\bar v=0$ the lines pass through a point of the "
                r"$z$-axis. A point beside it is reached at another height of the axis, which "
                r"depends on how steep the line is.",
            ),
            known.formula(
                "the height falls towards the axis",
                f"{h} + ({a}*cos(u) + {b}*sin(u))*cos(v)/sin(v)",
                r"Going from the point back to the axis, against $(\cos u,\sin u)$, the line loses "
                r"the height $\cot v$ for each unit of length.",
            ),
        ),
        because=r"The point is $\rho=a\cos u+b\sin u$ in front of the axis; there the line is "
        r"$\rho\cot v$ higher than where its common perpendicular meets the axis.",
        hints=(
            r"$\bar{\mathbf x}=\mathbf a\times\mathbf x=\bar u\,\mathbf x_u+\bar v\,\mathbf x_v$, "
            r"and $\mathbf x_u\perp\mathbf x_v$.",
            r"$\bar u\sin^2 v=\langle\mathbf a\times\mathbf x,\mathbf x_u\rangle$, because "
            r"$\|\mathbf x_u\|=\sin v$.",
            r"$\mathbf x\times\mathbf x_u=-\sin v\,\mathbf x_v$, and a triple product may be "
            r"turned round: $\langle\mathbf a\times\mathbf x,\mathbf x_u\rangle="
            r"\langle\mathbf a,\mathbf x\times\mathbf x_u\rangle$.",
        ),
        solution=rf"$\bar u={h}-({times(a)}\cos u+{times(b)}\sin u)\cot v$. "
        "Write cot v as cos(v)/sin(v).",
    )


def sphere(draw: Draw) -> Formula:
    """Ask for the ū of lines that touch a sphere."""
    radius, across, up = draw.one_of(((5, 3, 4), (5, 4, 3), (13, 5, 12), (13, 12, 5)))
    return Formula(
        question=rf"Every line shall touch the sphere of radius ${radius}$ about the origin, and "
        rf"$\bar v={across}$ everywhere. Write $\bar u(v)$, the positive one of the two.",
        answer=f"{up}/sin(v)",
        variables=V,
        box=V_BOX,
        label="ū =",
        slips=(
            known.formula(
                "sin v forgotten",
                f"{up}",
                r"$\|\mathbf x_u\|=\sin v$, not 1: the foot point has the distance "
                r"$\sqrt{\bar u^2\sin^2v+\bar v^2}$ from the origin.",
                V,
                V_BOX,
            ),
            known.formula(
                "difference of the lengths",
                f"{radius - across}/sin(v)",
                r"$\bar u\sin v$ and $\bar v$ are perpendicular: their squares add up.",
                V,
                V_BOX,
            ),
        ),
        because=r"$\|\bar{\mathbf x}\|$ is the distance of the line from the origin.",
        hints=(
            r"The distance of a line from the origin is the length of its moment.",
            r"$\|\bar{\mathbf x}\|^2=\bar u^2\sin^2v+\bar v^2$.",
        ),
        solution=rf"$\bar u^2\sin^2v+{across}^2={radius}^2$, so $\bar u=\dfrac{{{up}}}{{\sin v}}$.",
    )


# -- focal points ----------------------------------------------------------------------------------

TRIPLES = (
    ((1, 0, 0, 2), (1, 3, -1, 1), (2, 1, 1, -1)),
    ((1, 1, -1, 2), (2, 3, 1, 2), (1, 0, 3, 2)),
    ((2, 1, 1, 2), (4, 1, 3, 1), (1, 2, 2, 3)),
    ((1, 1, 0, 2), (1, -1, 3, 1), (2, 0, 1, -1)),
)
"""a, b, c, d of ū = a u + b z, v̄ = c u + d z with z = v − π/2: one congruence of each kind."""


def _focal_count(a: int, b: int, c: int, d: int) -> int:
    return int(np.sign((b + c) ** 2 - 4 * a * d)) + 1


def kinds(draw: Draw) -> Number:
    """Ask how many real focal points three lines have."""
    chosen = draw.one_of(TRIPLES)
    order = draw.shuffled(3)
    rows = [chosen[i] for i in order]
    names = ("(i)", "(ii)", "(iii)")
    said = ", ".join(
        rf"{name} $\bar u={combination((a, 'u'), (b, 'z'))},\ "
        rf"\bar v={combination((c, 'u'), (d, 'z'))}$"
        for name, (a, b, c, d) in zip(names, rows, strict=True)
    )
    worked = "; ".join(
        rf"{name} ${(b + c) ** 2}{-4 * a * d:+d}={(b + c) ** 2 - 4 * a * d}$"
        for name, (a, b, c, d) in zip(names, rows, strict=True)
    )
    answer = [_focal_count(*row) for row in rows]
    return Number(
        question=r"With $z=v-\tfrac\pi2$, how many different real focal points has the line at "
        rf"$u=0,\ v=\tfrac\pi2$ of each of these congruences? {said}. Give three numbers.",
        answer=answer,
        label="[i, ii, iii] =",
        slips=(
            known.mistaken_for(
                "counted twice",
                [2 if n == 1 else n for n in answer],
                "In one of them the two focal points coincide: that is one point, not two.",
            ),
            known.mistaken_for(
                "the same for all",
                [2, 2, 2],
                "Not every line has two real focal points: the equation for them is quadratic.",
            ),
        ),
        because=r"The sign of $(\bar u_v+\bar v_u)^2-4\,\bar u_u\bar v_v$ decides.",
        hints=(
            r"There is a neighbour that meets the line where $\kappa\bar\kappa$, the form of "
            r"$(u',v')$ in (18), is zero.",
            r"On the equator, where $\sin v=1$ and $\cos v=0$, that form is "
            r"$\bar u_u\,u'^2+(\bar v_u+\bar u_v)\,u'v'+\bar v_v\,v'^2$.",
            r"How many directions $u':v'$ make $a\,u'^2+(b+c)\,u'v'+d\,v'^2$ zero?",
        ),
        solution=r"The discriminant $(\bar u_v+\bar v_u)^2-4\,\bar u_u\bar v_v$ is "
        f"{worked}. Positive: two focal points, zero: one, negative: none.",
    )


def elliptic(draw: Draw) -> Choose:
    """Ask what an elliptic congruence does to every surface in it."""
    options = (
        Option(
            r"$\delta$ is nowhere zero: no ruling is torsal",
            "No neighbouring line meets a line, so none does in a surface of the congruence.",
            right=True,
        ),
        Option(
            "it is developable",
            r"On the contrary: $\bar\kappa=0$ would mean that neighbouring rulings meet, to first "
            "order, and here none do.",
            slip="elliptic taken for developable",
        ),
        Option(
            "its pitch is zero, if the curve closes",
            r"The pitch is zero for every loop where the divergence vanishes. In an elliptic "
            r"congruence the divergence cannot vanish: it is the sum of two $\delta$ of one sign.",
            slip="elliptic taken for normal",
        ),
        Option(
            "its lines are the normals of a surface",
            "Normals of a surface always have real focal points: the centres of curvature.",
            slip="elliptic taken for normal",
        ),
    )
    return Choose(
        question=r"The congruence $\bar u=u-v,\ \bar v=u+v$ is elliptic everywhere near the loop "
        "of Example 2. What is sure of the surface of <i>any</i> curve in this part of the chart?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "What does it mean for two lines that one is a focal neighbour of the other?",
            "A ruling is torsal if the next one meets it, to first order.",
        ),
        solution=r"In an elliptic congruence no line is met by a neighbour. A surface of the "
        r"congruence has neighbours only from it, so $\bar\kappa\ne0$ everywhere.",
    )


def directions(draw: Draw) -> Sketch:
    """Ask for δ over the direction of the curve."""
    first, second = draw.one_of(((1.0, -1.0), (-1.0, 1.0), (2.0, -1.0), (-1.0, 2.0)))
    size = max(abs(first), abs(second))
    form = combination((first, r"\cos^2t"), (second, r"\sin^2t"))

    def delta(t: Array) -> Array:
        return np.asarray(first * np.cos(t) ** 2 + second * np.sin(t) ** 2)

    ubar = f"{times(first)}u"
    height = r"v-\tfrac\pi2"
    vbar = height if second == 1 else f"{times(second)}({height})"
    return Sketch(
        question=rf"For $\bar u={ubar}$, $\bar v={vbar}$ take the line at $u=0$, $v=\tfrac\pi2$. "
        r"Curves leave this place in all directions: let $t$ be the angle of the curve to the "
        r"equator, $u'=\cos t,\ v'=\sin t$. Sketch the distribution parameter $\delta$ of their "
        r"surfaces there, over $t$ from $0$ to $\pi$.",
        curve=delta,
        heights=(-1.4 * size, 1.4 * size),
        span=(0.0, math.pi),
        quantity="delta",
        label="δ",
        because="Two zeros: two torsal directions, one for each focal point.",
        hints=(
            r"$\kappa^2\delta=\kappa\bar\kappa$ is a quadratic form of $(u',v')$, see (18).",
            r"Along the equator $\delta=\bar u_u$, along the meridian $\delta=\bar v_v$.",
            r"$\delta=\bar u_u\cos^2t+\bar v_v\sin^2t$.",
        ),
        solution=rf"$\delta={form}$: it begins and ends with "
        rf"${first:g}$, reaches ${second:g}$ in the middle and is zero twice.",
    )


# -- divergence and pitch --------------------------------------------------------------------------


def divergence(draw: Draw) -> Formula:
    """Ask for the divergence of a field."""
    a, b = draw.integer(1, 4), draw.integer(1, 4)
    return Formula(
        question=rf"Write the divergence of the field $\bar u={times(a)}\sin u\cos v$, "
        rf"$\bar v={times(b)}\sin v$ on the sphere.",
        answer=f"({a}*cos(u) + 2*{b})*cos(v)",
        label="divergence =",
        slips=(
            known.formula(
                "flat divergence",
                f"({a}*cos(u) + {b})*cos(v)",
                r"This is $\bar u_u+\bar v_v$, the divergence in the plane chart. On the sphere "
                r"$\bar v\cot v$ is added.",
            ),
            known.formula(
                "not divided by sin v",
                f"({a}*cos(u) + 2*{b})*cos(v)*sin(v)",
                r"This is $(\bar u\sin v)_u+(\bar v\sin v)_v$, what stands under $du\,dv$ in "
                r"Stokes' theorem. Divide it by the area $\sin v$ of a unit square of the chart.",
            ),
        ),
        because=r"$\bar v\cot v$ is as large as $\bar v_v$ here.",
        hints=(
            r"$\bar u_u+\bar v_v+\bar v\cot v$.",
            r"$\sin v\cot v=\cos v$.",
        ),
        solution=rf"$\bar u_u={times(a)}\cos u\cos v$, $\bar v_v={times(b)}\cos v$ and "
        rf"$\bar v\cot v={times(b)}\cos v$; their sum is "
        rf"$({times(a)}\cos u+{2 * b})\cos v$.",
    )


def complex_pitch(draw: Draw) -> Number:
    """Ask for the pitch of a loop of lines of a linear complex."""
    parameter, area = draw.one_of((2, 3, 4, 5)), draw.one_of((0.1, 0.2, 0.3, 0.4))
    value = -parameter * area
    return Number(
        question=rf"With $\bar u=0,\ \bar v={parameter}\cot v$ all lines belong to a linear "
        rf"complex. A loop runs once round a region of the sphere with the area ${area:g}$, "
        f"{OUTSIDE}, and round no pole. How large is the pitch $l$ of its surface?",
        answer=value,
        label="l =",
        unit="length",
        slips=(
            known.mistaken_for(
                "sense of the loop",
                -value,
                r"The size is right. Seen from outside and counter-clockwise, "
                r"$l=+\iint(\bar u_u+\bar v_v+\bar v\cot v)\,dA$; look at the sign of the "
                "divergence.",
            ),
            known.mistaken_for(
                "divergence counted twice",
                2 * value,
                r"Compute the divergence once more: $-p/\sin^2v+p\cot^2v=-p$.",
            ),
            known.mistaken_for(
                "divergence taken for pitch",
                -parameter,
                "This is the divergence in one point. The pitch is its sum over the region: "
                "multiply by the area.",
            ),
        ),
        because="The divergence is the same everywhere, so only the area counts, not the shape.",
        hints=(
            "The pitch is the flux of the divergence through the loop.",
            r"$\bar v_v+\bar v\cot v$ with $\bar v=p\cot v$: use "
            r"$(\cot v)'=-1/\sin^2v=-1-\cot^2v$.",
            r"Counter-clockwise as seen from outside: $l=+\iint(\ldots)\,dA$.",
        ),
        solution=rf"The divergence is $-p/\sin^2v+p\cot^2v=-p=-{parameter}$ everywhere, so "
        rf"$l=-{parameter}\cdot{area:g}={value:g}$.",
    )


def no_pitch(draw: Draw) -> Drag:
    """Ask for fields that give the loop of Example 2 no pitch."""
    least = draw.one_of((0.2, 0.25, 0.3))
    surface = EXAMPLE_2.surface()
    length, turn = float(surface.arc_lengths().kappa), surface.angle_of_pitch()

    def conditions(made: Made) -> tuple[Condition, ...]:
        pitch = has_pitch(made, within=0.005)
        texts = rf"$|\delta|$ reaches ${least:g}$", "the loop on the sphere is that of Example 2"
        if made.pitch is None:
            others = (Condition(t, math.nan, 1.0, now="it does not close") for t in texts)
            return (pitch, *others)
        moved = abs(float(made.surface.arc_lengths().kappa) - length)
        moved = max(moved, abs(abs(float(made.pitch.real)) - abs(turn)))
        return (
            pitch,
            at_least(texts[0], _greatest_delta(made), least, "length"),
            Condition(texts[1], moved, 0.02, "", r"judged by $\oint\kappa\,dt$ and $\lambda$"),
        )

    return Drag(
        question=r"Leave the curve as it is and change only $\bar u$ and $\bar v$, until the "
        rf"pitch of this closed surface is zero. It shall be no cone: $|\delta|\ge{least:g}$ "
        "somewhere. There are many ways.",
        start=EXAMPLE_2,
        model=EXAMPLE_2.with_(ubar="-2*cos(v)/sin(v)", vbar="0"),
        conditions=conditions,
        fields=True,
        plots=("delta", "tau_bar"),
        slips=(
            Misconception(
                "a cone has no pitch",
                lambda made: made.pitch is not None and _greatest_delta(made) < 1e-6,
                r"The pitch is zero indeed, but $\bar\kappa=0$ too: the surface is developable, "
                "here a cone. There are fields without divergence that are no bundles.",
                EXAMPLE_2.with_(ubar="1", vbar="0"),
            ),
        ),
        because="Whatever fields these are: their divergence has no flux through this loop.",
        hints=(
            r"Which field $\bar u,\bar v$ has no flux through <i>any</i> loop?",
            r"Take one with $\bar u_u+\bar v_v+\bar v\cot v=0$: the normals of a surface.",
            r"With $\bar v=0$ it is enough that $\bar u$ does not depend on $u$.",
        ),
        solution=r"One of many: $\bar u=-2\cot v,\ \bar v=0$, the normals of a torus with a "
        r"middle circle of radius 2. Any function of $v$ alone will do for $\bar u$ while "
        r"$\bar v=0$, or $\bar v=1/\sin v$ with any $\bar u(v)$, or factors chosen by trial.",
    )


def _greatest_delta(made: Made) -> float:
    return float(np.abs(values(made, "delta", 101)).max(initial=0.0))


def normals(draw: Draw) -> FindSlip:
    """Ask for the slip in the condition for normals."""
    size = draw.integer(2, 5)
    return FindSlip(
        question="When are the lines of a congruence the normals of a surface? One line of this "
        "reasoning is wrong.",
        lines=(
            Line(
                r"On each line a point $\mathbf c+w\,\mathbf x$ is wanted whose paths are all "
                r"perpendicular to it: $\langle d(\mathbf c+w\,\mathbf x),\mathbf x\rangle=0$.",
                "a surface has the line for its normal if all its tangents there are "
                "perpendicular to the line.",
            ),
            Line(
                r"So $dw=-\langle d\mathbf c,\mathbf x\rangle$.",
                r"$\langle\mathbf x,\mathbf x\rangle=1$ and $\langle d\mathbf x,\mathbf x\rangle"
                r"=0$.",
            ),
            Line(
                r"$\langle d\mathbf c,\mathbf x\rangle=\sin v\,(\bar u\,dv-\bar v\,du)$.",
                r"this is the right side of the paper's formula for $\bar\tau$ in (18), which "
                r"really is $\langle\mathbf c',\mathbf x\rangle\,dt$.",
            ),
            Line(
                r"Such a function $w(u,v)$ exists if and only if $\bar u_u+\bar v_v=0$.",
            ),
        ),
        then=Formula(
            question=rf"Let $\bar u=0$ and let $\bar v$ depend on $v$ alone, with "
            rf"$\bar v={size}$ at $v=\tfrac\pi2$. Which $\bar v(v)$ gives normals of a surface?",
            solution="",
            answer=f"{size}/sin(v)",
            variables=V,
            box=V_BOX,
            label="v̄ =",
            slips=(
                known.formula(
                    "flat divergence",
                    f"{size}",
                    r"This makes $\bar v_v=0$, as in the wrong line. Differentiate "
                    r"$\bar v\sin v$ instead.",
                    V,
                    V_BOX,
                ),
            ),
            because=r"$(\bar v\sin v)_v=0$.",
        ),
        hints=(
            r"$P\,du+Q\,dv$ is a differential if and only if $P_v=Q_u$. What are $P$ and $Q$?",
            r"$P=\bar v\sin v$ and $Q=-\bar u\sin v$. Do not lose the $\sin v$.",
        ),
        solution=r"$(\bar v\sin v)_v=-(\bar u\sin v)_u$, so "
        r"$\bar u_u+\bar v_v+\bar v\cot v=0$: the divergence on the sphere. With $\bar u=0$ this "
        rf"gives $\bar v\sin v$ constant, $\bar v=\dfrac{{{size}}}{{\sin v}}$.",
    )


# -- developable ----------------------------------------------------------------------------------


def developable(draw: Draw) -> Formula:
    """Ask for the v̄ that makes a surface developable."""
    rate, first = draw.integer(2, 4), draw.integer(1, 4)
    variables, box = ("t",), ((0.4, 2.4),)
    power = f"{rate**2 / 2:g}"
    slips = (
        known.formula(
            "sign of the exponent",
            f"{first}*exp(-{rate**2}*cos(t)**2/2)",
            r"Differentiate it: $\bar v'$ comes out with the other sign.",
            variables,
            box,
        ),
        known.formula(
            "begun at t = 0",
            f"{first}*exp(-{rate**2}*sin(t)**2/2)",
            rf"This solves the equation, with $\bar v(0)={first}$. The value is given at "
            r"$t=\tfrac\pi2$.",
            variables,
            box,
        ),
        known.formula(
            "as along a meridian",
            f"{first}",
            r"A constant $\bar v$ is right along a meridian, $u'=0$. Here the lines turn about the "
            "axis too.",
            variables,
            box,
        ),
        known.formula(
            "u′ not squared",
            f"{first}*exp({rate}*cos(t)**2/2)",
            r"The middle term of the equation has $u'^2$, not $u'$.",
            variables,
            box,
        ),
    )
    return Formula(
        question=rf"The curve is $u={times(rate)}t,\ v=t$, and $\bar u$ is constant. Which "
        rf"$\bar v(t)$ makes the surface developable and has $\bar v={first}$ at $t=\tfrac\pi2$?",
        answer=f"{first}*exp({rate**2}*cos(t)**2/2)",
        variables=variables,
        box=box,
        label="v̄ =",
        slips=slips,
        because=r"The directions are the same for every $\bar v$; only where the lines hang has "
        "changed.",
        hints=(
            r"$\kappa\bar\kappa=v'\bar v'+u'^2\sin v\cos v\;\bar v+u'\sin^2v\;\bar u'$ has to be "
            "0 for all $t$.",
            rf"Here $v'=1$, $u'={rate}$ and $\bar u'=0$. What is left gives $\bar v'/\bar v$.",
            rf"$\bar v'/\bar v={-(rate**2)}\sin t\cos t$ is the derivative of "
            rf"${power}\cos^2t$.",
        ),
        solution=rf"$\bar v'={-(rate**2)}\sin t\cos t\;\bar v$, so "
        rf"$\bar v=C\,e^{{{power}\cos^2t}}$, and at $t=\tfrac\pi2$ the exponent is 0: $C={first}$.",
    )


# -- Python ----------------------------------------------------------------------------------------


def flux(draw: Draw) -> Code:
    """Ask for the pitch of the loop round a rectangle."""
    u0, u1 = draw.one_of(((0.2, 1.0), (0.4, 1.2), (0.5, 1.5)))
    v0, v1 = draw.one_of(((0.4, 1.0), (0.6, 1.2), (0.5, 1.4)))
    congruence = Congruence("u - v", "u + v")
    value = congruence.flux((u0, u1), (v0, v1))
    nodes, weights = np.polynomial.legendre.leggauss(30)
    us = 0.5 * (u0 + u1) + 0.5 * (u1 - u0) * nodes
    vs = 0.5 * (v0 + v1) + 0.5 * (v1 - v0) * nodes
    flat = 0.25 * (u1 - u0) * (v1 - v0)
    flat *= float(weights @ congruence.divergence(us[:, None], vs) @ weights)
    return Code(
        question=r"A loop runs once round the rectangle "
        rf"${u0:g}\le u\le{u1:g},\ {v0:g}\le v\le{v1:g}$ of the chart, {OUTSIDE}, and "
        r"$\bar u=u-v,\ \bar v=u+v$. Compute the pitch of its surface with "
        "<code>Congruence</code>.",
        starter="from ruledlab.geometry import Congruence\n\n"
        'congruence = Congruence("u - v", "u + v")\nvalue = ...',
        answer=value,
        label="l =",
        unit="length",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "sense of the loop",
                -value,
                r"$l=-\oint\bar\tau\,dt$, and seen from outside, where $v$ points down, this loop "
                "runs round the region the other way than in Stokes' theorem: the signs cancel.",
                1e-6,
            ),
            known.mistaken_for(
                "area of the chart",
                flat,
                r"The area on the sphere is $\sin v\,du\,dv$: the divergence has to be weighed "
                r"with $\sin v$.",
                1e-6,
            ),
        ),
        hints=(
            r"By Stokes the pitch is the flux of the divergence, $l=\iint(\ldots)\,dA$.",
            "A congruence has .flux((u0, u1), (v0, v1)).",
        ),
        solution=f"<pre>value = congruence.flux(({u0:g}, {u1:g}), ({v0:g}, {v1:g}))</pre>"
        rf"$l={value:.6f}$.",
    )


EXERCISES = (
    Exercise("07.1", "Through one point", apex),
    Exercise("07.2", "Touching a sphere", sphere),
    Exercise("07.3", "How many focal points?", kinds),
    Exercise("07.4", "No neighbour meets it", elliptic),
    Exercise("07.5", "All directions at once", directions),
    Exercise("07.6", "The divergence of a field", divergence),
    Exercise("07.7", "A loop in a linear complex", complex_pitch),
    Exercise("07.8", "Take the pitch away", no_pitch),
    Exercise("07.9", "A slip about normals", normals),
    Exercise("07.10", "The pitch of a rectangle", flux),
    Exercise("07.11", "Make it developable", developable),
)
"""The exercises in their order."""
