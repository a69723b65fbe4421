"""Exercises of lesson 02: lines as points of the dual unit sphere, and the dual angle of two."""

from __future__ import annotations

import math

import numpy as np

from ..geometry.checks import Array
from ..geometry.line import Line, dual_angle, on_sphere
from ..pair import OneLine, Pair, TwoLines
from . import misconceptions as known
from . import tex
from .core import (
    Choose,
    Code,
    Condition,
    Draw,
    Exercise,
    FindSlip,
    Formula,
    Misconception,
    Number,
    Option,
    Place,
    Sketch,
)
from .core import Line as Printed
from .designs import at_least

__all__ = ["EXERCISES"]

UNSIGNED = "distance unsigned"
PARALLEL = "d from sin θ = 0"


def _turned(vector: tuple[float, float, float], steps: int) -> Array:
    """Return the vector with its entries moved round: another axis, the same orientation."""
    return np.roll(np.array(vector, dtype=float), steps)


# -- one line --------------------------------------------------------------------------------------


def through(draw: Draw) -> Number:
    """Ask for the moment of the line through two points."""
    x = _turned((0.6, 0.8, 0.0), draw.integer(0, 2))
    p = np.array([draw.integer(1, 3) for _ in range(3)], dtype=float)
    q = p + 5 * x
    value = np.array(Line.through(p, q).moment)
    return Number(
        question=rf"A line runs from $\mathbf p={tex.vector(p)}$ to $\mathbf q={tex.vector(q)}$. "
        r"Which moment $\bar{\mathbf x}$ has it? Three numbers.",
        answer=value,
        label="x̄ =",
        unit="length",
        slips=(
            known.moment_sign(value),
            known.mistaken_for(
                "direction not of length 1",
                5 * value,
                r"This is $\mathbf p\times\mathbf q=\mathbf p\times(\mathbf q-\mathbf p)$. "
                "The direction must have length 1 first: divide by the distance of the points.",
            ),
            known.mistaken_for(
                "direction for moment",
                x,
                r"This is the direction $\mathbf x$. It does not know where the line is; the "
                r"moment $\mathbf c\times\mathbf x$ does.",
            ),
            known.mistaken_for(
                "foot point for moment",
                Line.through(p, q).foot,
                r"This is the foot point $\mathbf x\times\bar{\mathbf x}$, the point nearest the "
                "origin.",
            ),
        ),
        because="The moment is the same whichever of the two points you take.",
        hints=(
            r"First the direction: $\mathbf x=(\mathbf q-\mathbf p)/\|\mathbf q-\mathbf p\|$.",
            r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$ with any point $\mathbf c$ of the line.",
            rf"$\mathbf x={tex.vector(x)}$, and $\mathbf c=\mathbf p$ will do.",
        ),
        solution=rf"$\mathbf x={tex.vector(x)}$ and $\bar{{\mathbf x}}=\mathbf p\times\mathbf x="
        rf"{tex.vector(value)}$.",
    )


def side(draw: Draw) -> Choose:
    """Ask for the sense of a moment."""
    distance = draw.integer(2, 5)
    options = (
        Option(
            rf"$(0,0,{distance})$",
            r"East times north is up, $\mathbf c\times\mathbf x$ with the point first: seen "
            " from above, the line goes round you anticlockwise.",
            right=True,
        ),
        Option(
            rf"$(0,0,-{distance})$",
            r"This is $\mathbf x\times\mathbf c$. The moment is $\bar{\mathbf x}=\mathbf c\times"
            r"\mathbf x$: the point first, then the direction.",
            slip="sign of the moment",
        ),
        Option(
            rf"$({distance},0,0)$",
            "This is the foot point, the point of the line nearest to you. The moment is normal "
            "to it.",
            slip="foot point for moment",
        ),
        Option(
            rf"$(0,{distance},0)$",
            "This is parallel to the line itself; a moment is always normal to it.",
        ),
    )
    return Choose(
        question=r"You stand in the origin and look north, along the $y$-axis; $x$ is to the east, "
        rf"$z$ is up. At {distance} m to the east a straight road runs north. Which moment has it?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Which point $\mathbf c$ of the road do you know, and which direction $\mathbf x$?",
            rf"$\mathbf c=({distance},0,0)$, $\mathbf x=(0,1,0)$, and $\bar{{\mathbf x}}="
            r"\mathbf c\times\mathbf x$.",
        ),
        solution=rf"$({distance},0,0)\times(0,1,0)=(0,0,{distance})$.",
    )


def is_line(draw: Draw) -> Choose:
    """Ask which pair of vectors is a line."""
    turn, size = draw.integer(0, 2), draw.integer(1, 4)
    x, across, up = (_turned(v, turn) for v in ((0.6, 0.8, 0), (-4, 3, 0), (0, 0, 1)))
    good = size * across + 5 * up
    wrong_moment = size * _turned((4, 3, 0), turn) + 5 * up

    def pair(direction: Array, moment: Array) -> str:
        return rf"$\mathbf x={tex.vector(direction)},\ \ \bar{{\mathbf x}}={tex.vector(moment)}$"

    options = (
        Option(
            pair(x, good),
            r"$\|\mathbf x\|=1$ and $\langle\mathbf x,\bar{\mathbf x}\rangle=0$: a line.",
            right=True,
        ),
        Option(
            pair(x, wrong_moment),
            rf"$\langle\mathbf x,\bar{{\mathbf x}}\rangle={x @ wrong_moment:g}$, not 0: no point "
            r"$\mathbf c$ has $\mathbf c\times\mathbf x$ equal to this.",
            slip="moment not normal",
        ),
        Option(
            pair(5 * x, good),
            r"Here $\|\mathbf x\|=5$. Divide <i>both</i> parts by 5 and it is a line.",
            slip="direction not of length 1",
        ),
        Option(
            pair(0 * x, good),
            "Without a direction there is no line: in projective geometry this is a line at "
            "infinity.",
        ),
    )
    return Choose(
        question=r"One of these pairs $\mathbf x+\varepsilon\,\bar{\mathbf x}$ is an oriented line "
        "as it stands. Which?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Two conditions: they are the two parts of $\langle\mathbf X,\mathbf X\rangle=1$.",
            r"$\|\mathbf x\|=1$ and $\langle\mathbf x,\bar{\mathbf x}\rangle=0$.",
        ),
        solution=rf"{pair(x, good)}: only here both $\|\mathbf x\|=1$ and "
        r"$\langle\mathbf x,\bar{\mathbf x}\rangle=0$ hold.",
    )


# -- two lines -------------------------------------------------------------------------------------


def reverse(draw: Draw) -> Choose:
    """Ask what reversing one of two lines does to the dual angle."""
    name, vector = draw.one_of((("A", "X"), ("B", "Y")))
    options = (
        Option(
            r"$(\pi-\theta)-\varepsilon d$",
            r"$\cos(\pi-\theta-\varepsilon d)=-\cos(\theta+\varepsilon d)$, as it must be when one "
            "of the two vectors changes its sign.",
            right=True,
        ),
        Option(
            r"$(\pi-\theta)+\varepsilon d$",
            r"The angle is right, and the length of the way too. But $\mathbf x\times\mathbf y$ "
            "has turned round, and $d$ is measured along it.",
            slip=UNSIGNED,
        ),
        Option(
            r"$\theta-\varepsilon d$",
            r"The directions now enclose $\pi-\theta$: $\langle\mathbf x,\mathbf y\rangle$ has "
            "changed its sign.",
        ),
        Option(
            r"$-\theta-\varepsilon d$",
            r"The cosine of this is the old one; but $\langle\mathbf X,\mathbf Y\rangle$ changes "
            r"its sign. And $\theta$ lies between 0 and $\pi$.",
        ),
    )
    return Choose(
        question=r"Two skew lines have the dual angle $\theta+\varepsilon d$. Line "
        rf"{name} is reversed, $\mathbf {vector}$ becomes $-\mathbf {vector}$. What is the dual "
        "angle now?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"What happens to $\langle\mathbf X,\mathbf Y\rangle=\cos(\theta+\varepsilon d)$?",
            r"Its real part $\cos\theta$ and its dual part $-d\sin\theta$ both change their sign, "
            r"and $\sin\theta$ stays positive.",
        ),
        solution=r"$-\cos\theta=\cos(\pi-\theta)$, and $+d\sin\theta=-(-d)\sin(\pi-\theta)$: "
        r"$\theta$ becomes $\pi-\theta$ and $d$ becomes $-d$. Reverse the other line as well and "
        "both are back.",
    )


def angle(draw: Draw) -> Code:
    """Ask for the dual angle of two lines; its d is negative, its θ obtuse."""
    turn, height = draw.integer(0, 2), draw.integer(1, 3)
    c, e = _turned((1, 0, height), turn), _turned((0, 2, -1), turn)
    x, y = _turned((1, 0, 0), turn), _turned((-3, 4, 0), turn)
    found = dual_angle(Line.from_point_direction(c, x), Line.from_point_direction(e, y))
    theta, d = float(found.real), float(found.dual)
    return Code(
        question=rf"Line A passes through ${tex.vector(c)}$ along ${tex.vector(x)}$, line B "
        rf"through ${tex.vector(e)}$ along ${tex.vector(y)}$. Compute their dual angle. "
        r"Give $[\theta, d]$ or the dual number.",
        starter="from ruledlab import Line\nfrom ruledlab.geometry import dual_angle\n\n"
        "value = ...",
        answer=[theta, d],
        label="θ + ε d =",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                UNSIGNED,
                [theta, -d],
                r"The length is right, the sign is not: from A to B the way leads <i>against</i> "
                r"$\mathbf x\times\mathbf y$. (With $\mathbf x\times\mathbf c$ for the moment the "
                "sign comes out wrong as well.)",
            ),
            known.mistaken_for(
                "orientation ignored",
                [math.pi - theta, -d],
                "This is the angle of the lines without their orientations: you have reversed one "
                "of them.",
            ),
            known.mistaken_for(
                "degrees for radians",
                [math.degrees(theta), d],
                r"$d$ is right; $\theta$ is in degrees. Angles are in radians here.",
            ),
        ),
        hints=(
            "Line.from_point_direction(point, direction) takes a direction of any length.",
            "dual_angle(a, b) goes from a to b.",
        ),
        solution=f"<pre>a = Line.from_point_direction({c.astype(int).tolist()}, "
        f"{x.astype(int).tolist()})\nb = Line.from_point_direction({e.astype(int).tolist()}, "
        f"{y.astype(int).tolist()})\nvalue = dual_angle(a, b)</pre>"
        rf"$\theta={theta:.6f}$, $d={d:g}$.",
    )


def meet(draw: Draw) -> Number:
    """Ask for the height at which two lines meet: by the app's sliders or by computing."""
    height, beside = draw.one_of((0.5, 1.0, -0.5)), draw.one_of((-1.0, 0.75, 1.25))
    value = height + beside
    return Number(
        question=rf"Line A passes through $(0,0,{height:g})$ along $(1,0,0)$: in the app, $u=0$, "
        rf"$v=\tfrac\pi2$. Line B has $u=\tfrac\pi2$, $v=\tfrac\pi4$ and passes through "
        rf"$(1,{beside:g},z)$. Move $z$ until they meet. Which $z$ is it?",
        answer=value,
        label="z =",
        unit="length",
        slips=(
            known.mistaken_for(
                "same height",
                height,
                "Now the given point of B is as high as A, but A does not pass there: B has still "
                "some way to go, and rises on it.",
            ),
            known.mistaken_for(
                "wrong way along the line",
                height - beside,
                r"B rises with $y$: where it passes over $y=0$ it is lower than at a positive $y$.",
            ),
        ),
        because=r"Both parts say so: $\theta\neq0$ and $\langle\mathbf x,\bar{\mathbf y}\rangle+"
        r"\langle\bar{\mathbf x},\mathbf y\rangle=-d\sin\theta=0$.",
        hints=(
            r"Lines that are not parallel meet exactly if the dual part of $\langle\mathbf X,"
            r"\mathbf Y\rangle$ is 0. Watch it while you move $z$.",
            r"All points of A have $y=0$. How high is B there?",
            r"B climbs by as much as it advances in $y$: its direction is "
            r"$(0,1,1)/\sqrt2$.",
        ),
        solution=rf"B is at $y=0$ when it has gone ${-beside:g}$ in $y$ and therefore "
        rf"${-beside:g}$ in height: $z{-beside:+g}={height:g}$, so $z={value:g}$.",
    )


def dual_part(draw: Draw) -> Formula:
    """Ask for the dual part of ⟨X, Y⟩ as a formula."""
    times = draw.integer(2, 5)
    box = ((0.2, 2.9), (-2.0, 2.0))
    return Formula(
        question=r"Line A is the $x$-axis. Line B passes through the point "
        rf"$(0,0,{times}h)$ of the $z$-axis, with the direction $(\cos a,\sin a,0)$. Write the "
        r"dual part $\langle\mathbf x,\bar{\mathbf y}\rangle+\langle\bar{\mathbf x},\mathbf y"
        r"\rangle$ of $\langle\mathbf X,\mathbf Y\rangle$.",
        answer=f"-{times}*h*sin(a)",
        variables=("a", "h"),
        box=box,
        label="dual part =",
        slips=(
            known.formula(
                "sign of the moment",
                f"{times}*h*sin(a)",
                r"The sign is off everywhere: so it is with $\mathbf x\times\mathbf c$ for the "
                r"moment. With $\bar{\mathbf y}=\mathbf c\times\mathbf y$ the dual part is "
                r"$-d\sin\theta$.",
                ("a", "h"),
                box,
            ),
            known.formula(
                "d for the dual part",
                f"{times}*h",
                r"This is $d$ itself. The dual part is that of $\cos(\theta+\varepsilon d)$, which "
                r"is $-d\sin\theta$.",
                ("a", "h"),
                box,
            ),
        ),
        because=rf"$\theta=a$ and $d={times}h$: the dual part of $\cos(\theta+\varepsilon d)$.",
        hints=(
            r"$\bar{\mathbf x}=0$: line A passes through the origin.",
            rf"$\bar{{\mathbf y}}=(0,0,{times}h)\times(\cos a,\sin a,0)$, and of it only the first "
            "entry is wanted.",
        ),
        solution=rf"$\bar{{\mathbf y}}={times}h\,(-\sin a,\cos a,0)$ and $\mathbf x=(1,0,0)$: the "
        rf"dual part is $-{times}h\sin a$.",
    )


def turning(draw: Draw) -> Sketch:
    """Ask for the dual part while one of two lines turns about the common perpendicular."""
    side = draw.one_of((1, -1))
    height = "1 above" if side > 0 else "1 below"

    def part(t: Array) -> Array:
        return np.asarray(-side * np.sin(np.pi * t))

    return Sketch(
        question=rf"Line A is the $x$-axis. Line B crosses the $z$-axis at the height {height} the "
        r"origin and turns about that axis, with the direction $(\cos\pi t,\sin\pi t,0)$: that of "
        r"A at $t=0$, the opposite at $t=1$. Sketch the dual part of "
        r"$\langle\mathbf X,\mathbf Y\rangle$ over $t$.",
        curve=part,
        heights=(-1.5, 1.5),
        label="dual part",
        because="The distance is 1 all the time, and yet the dual part is 0 at both ends: for "
        "parallel and antiparallel lines it says nothing about the distance.",
        hints=(
            r"The dual part is $-d\sin\theta$. What are $\theta$ and $d$ here?",
            r"$\theta=\pi t$, and $\mathbf x\times\mathbf y$ points up.",
            f"So $d={side}$ all the time: zero at both ends, and largest in size at "
            r"$t=\tfrac12$, where the lines are perpendicular.",
        ),
        solution=rf"$\theta=\pi t$ and $d={side}$, so the dual part is "
        rf"${'-' if side > 0 else ''}\sin\pi t$.",
    )


def which_meet(draw: Draw) -> Choose:
    """Ask which of four lines meets the z-axis."""
    size, high = draw.integer(2, 4), draw.integer(1, 3)
    options = (
        Option(
            rf"through $({size},{size},{high})$ along $(1,1,2)$",
            r"It reaches the axis at the height "
            rf"${high - 2 * size}$: $\theta\neq0$ and the dual part is 0.",
            right=True,
        ),
        Option(
            rf"through $({size},{size},{high})$ along $(0,0,1)$",
            r"Here too the dual part of $\langle\mathbf X,\mathbf Y\rangle$ is 0, but because "
            r"$\sin\theta=0$: the line is parallel to the axis, at the distance "
            rf"${size}\sqrt2$.",
            slip="dual part 0 taken for meeting",
        ),
        Option(
            rf"through $({size},{size},{high})$ along $(1,-1,0)$",
            "It crosses the axis at a right angle, but passes beside it.",
            slip="perpendicular taken for meeting",
        ),
        Option(
            rf"through $({size},0,{high})$ along $(1,1,2)$",
            rf"Seen from above it misses the origin: where $y=0$, it is at $x={size}$.",
        ),
    )
    return Choose(
        question=r"Line A is the $z$-axis. Which of these lines meets it, in exactly one point?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Look along the axis, from above: which of them passes through the origin?",
            r"$\mathbf x=(0,0,1)$ and $\bar{\mathbf x}=0$, so the dual part is the third entry of "
            r"the moment $\bar{\mathbf y}$. But do not forget $\sin\theta$.",
        ),
        solution=rf"From above, the line through $({size},{size})$ along $(1,1)$ passes "
        r"through the origin. The line along $(0,0,1)$ has dual part 0 too, but it is parallel.",
    )


# -- find the slip ---------------------------------------------------------------------------------


def parallel(draw: Draw) -> FindSlip:
    """Ask for the slip in the distance of parallel lines."""
    scale, along = draw.integer(1, 3), draw.integer(2, 6)
    point = (3 * scale, 4 * scale, along)
    apart, between = 5.0 * scale, math.sqrt(25 * scale**2 + along**2)
    return FindSlip(
        question=r"Line A is the $z$-axis, line B passes through "
        rf"$({point[0]},{point[1]},{point[2]})$, also along $(0,0,1)$. How far apart are they? One "
        "step is wrong.",
        lines=(
            Printed(
                r"Both have the direction $(0,0,1)$, so $\cos\theta=1$ and $\theta=0$.",
                r"$\langle\mathbf x,\mathbf y\rangle=1$.",
            ),
            Printed(
                r"$\bar{\mathbf x}=0$ and "
                rf"$\bar{{\mathbf y}}=({point[1]},{-point[0]},0)$.",
                r"these are the moments $\mathbf c\times\mathbf x$.",
            ),
            Printed(
                r"$\langle\mathbf x,\bar{\mathbf y}\rangle+\langle\bar{\mathbf x},\mathbf y\rangle"
                "=0$.",
                "the first product is 0 because the moment is horizontal, the second because "
                r"$\bar{\mathbf x}=0$.",
            ),
            Printed(r"This dual part is $-d\sin\theta$; since it is 0, $d=0$."),
        ),
        then=Number(
            question="So how far apart are they?",
            solution="",
            answer=apart,
            label="d =",
            unit="length",
            slips=(
                known.mistaken_for(
                    PARALLEL,
                    0.0,
                    r"With $\sin\theta=0$ the dual part is 0 whatever $d$ is: it says nothing "
                    "about the distance of parallel lines.",
                ),
                known.mistaken_for(
                    "distance of the given points",
                    between,
                    "This is how far the given point of B is from the origin; B has points that "
                    "are nearer to A.",
                ),
            ),
            because=r"For parallel lines, $d=\|\bar{\mathbf y}-\bar{\mathbf x}\|$.",
        ),
        hints=(
            r"Which line divides by something that is 0?",
            r"The moments know it: $\bar{\mathbf y}-\bar{\mathbf x}=(\mathbf e-\mathbf c)\times"
            r"\mathbf x$ for points $\mathbf c$ of A and $\mathbf e$ of B.",
        ),
        solution=r"From $d\sin\theta=0$ follows $d=0$ only if $\sin\theta\neq0$. Parallel lines "
        r"have the distance $\|\bar{\mathbf y}-\bar{\mathbf x}\|"
        rf"=\sqrt{{{point[1]}^2+{point[0]}^2}}={apart:g}$.",
    )


def foot(draw: Draw) -> FindSlip:
    """Ask for the slip in a derivation of the foot point."""
    options = (
        Option(
            r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$",
            r"The point first: then $\mathbf x\times\bar{\mathbf x}=\mathbf c-\langle\mathbf c,"
            r"\mathbf x\rangle\mathbf x$ is a point of the line.",
            right=True,
        ),
        Option(
            r"$\bar{\mathbf x}=\mathbf x\times\bar{\mathbf x}$",
            "This would make the moment the foot point.",
            slip="foot point for moment",
        ),
        Option(
            r"$\bar{\mathbf x}=\langle\mathbf c,\mathbf x\rangle\,\mathbf x$",
            "This is parallel to the line; a moment is normal to it.",
        ),
    )
    return FindSlip(
        question=r"A line passes through $\mathbf c$ with unit direction $\mathbf x$. One of these "
        "statements is wrong here, and would put the foot point on the other side of the origin.",
        lines=(
            Printed(r"Its moment is $\bar{\mathbf x}=\mathbf x\times\mathbf c$."),
            Printed(
                r"The moment is normal to the line, $\langle\mathbf x,\bar{\mathbf x}\rangle=0$.",
                "a cross product is normal to both of its factors.",
            ),
            Printed(
                r"The point $\mathbf c+w\,\mathbf x$ gives the same moment, for any $w$.",
                r"$w\,\mathbf x$ adds nothing to the product with $\mathbf x$.",
            ),
            Printed(
                r"Its point nearest the origin is $\mathbf x\times\bar{\mathbf x}$.",
                r"with the right moment this is $\mathbf c-\langle\mathbf c,\mathbf x\rangle"
                r"\mathbf x$, normal to $\mathbf x$ and on the line.",
            ),
        ),
        then=Choose(
            question="What should stand there?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            r"Try $\mathbf c=(1,0,0)$, $\mathbf x=(0,1,0)$: the foot point has to be $\mathbf c$.",
            "Equation (2) of the paper has the product that is meant.",
        ),
        solution=r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$. With the factors exchanged, "
        r"$\mathbf x\times\bar{\mathbf x}$ would be $-\mathbf c$ for $\mathbf c$ normal to "
        r"$\mathbf x$.",
    )


# -- two lines in hand -----------------------------------------------------------------------------

WITHIN = 0.02  # a hand is not exact: rad, and units of length
SAME = 0.03  # the same for moments: they carry the slips of angle and place


def to_order(draw: Draw) -> Place:
    """Ask for two lines with a given dual angle; the sign of d counts."""
    theta = math.pi * draw.one_of((1 / 4, 1 / 3, 2 / 3, 3 / 4))
    name = tex.angle(theta)
    d, height = draw.one_of((1.0, -1.0, 1.5, -1.5)), draw.one_of((0.0, 0.5, -0.5))
    level = OneLine(0.0, math.pi / 2, -0.5, 0.0, height)

    def with_b_at(z: float) -> TwoLines:
        x, y = 0.5 + 0.8 * math.cos(theta), 0.8 * math.sin(theta)
        return TwoLines(level, OneLine(theta, math.pi / 2, round(x, 2), round(y, 2), z))

    model = with_b_at(height + d)
    above = "above" if d > 0 else "below"
    return Place(
        question=rf"Take line B in hand and bring it where $\theta={name}$ and $d={d:g}$; the sign "
        r"of $d$ counts. $0.02$ more or less will do. The fields take exact numbers, such as pi/3.",
        start=TwoLines(level, OneLine(-1.9, 1.0, 0.5, 0.8, height + 0.4)),
        model=model,
        conditions=lambda pair: (
            _angle_is(pair, rf"angle $\theta={name}$", theta),
            _distance_is(pair, d),
        ),
        slips=(
            Misconception(
                UNSIGNED,
                lambda pair: _has(pair, theta, -d),
                rf"The angle is right, and the lines are ${abs(d):g}$ apart, but $d={-d:g}$: from "
                r"A to B the way leads "
                rf"{'against' if d > 0 else 'along'} $\mathbf x\times\mathbf y$, the dashed arrow. "
                "Take B to the other side of A.",
                with_b_at(height - d),
            ),
            Misconception(
                "orientation ignored",
                lambda pair: _has(pair, math.pi - theta, -d),
                r"As lines without arrows these are right. With their arrows they enclose "
                r"$\pi-\theta$, and $\mathbf x\times\mathbf y$ has turned round too: one of them "
                "runs the wrong way.",
                TwoLines(level, model.b.reversed()),
            ),
        ),
        because=r"So $\langle\mathbf X,\mathbf Y\rangle=\cos(\theta+\varepsilon d)$ is about "
        rf"${tex.dual(round(math.cos(theta), 3), round(-d * math.sin(theta), 3))}$ now.",
        hints=(
            r"One after the other: $\theta$ depends on the directions alone, so turn B by its "
            "diamond first; the disc then leaves the angle as it is.",
            r"$d$ is the way from A to B along $\mathbf x\times\mathbf y$. If its sign is wrong, B "
            "is on the wrong side of A.",
            rf"A is level, $\mathbf x=(1,0,0)$, at the height ${height:g}$. Make B level as well, "
            rf"$u={name}$ and $v=\tfrac\pi2$: then $\mathbf x\times\mathbf y$ points up.",
        ),
        solution=rf"One such pair is shown now: B is level, $u={name}$, $v=\tfrac\pi2$, at the "
        rf"height $z={height + d:g}$, which is ${abs(d):g}$ {above} A.",
    )


def _angle_is(pair: Pair, text: str, theta: float) -> Condition:
    now = float(pair.across.angle)
    return Condition(text, abs(now - theta), WITHIN, "rad", rf"now $\theta={now:.3f}$")


def _distance_is(pair: Pair, d: float) -> Condition:
    now = float(pair.across.distance)
    said = f"now $d={round(now, 3) + 0.0:.3f}$"  # never −0.000
    return Condition(f"distance $d={d:g}$", abs(now - d), WITHIN, "length", said)


def _has(pair: Pair, theta: float, d: float) -> bool:
    """Return whether two lines have a dual angle, as far as a hand can tell."""
    return _angle_is(pair, "", theta).met and _distance_is(pair, d).met


PLANES = (
    ("z=0", (0.0, 0.5), (0.75, 0.5), (0, 0, 1)),
    ("x=0", (0.5, 0.5), (0.5, 0.25), (-1, 0, 0)),
    ("y=0", (0.0, 0.5), (0.0, 0.75), (0, 1, 0)),
)
"""Planes through the origin, u/π and v/π of two directions in each, and the sense of a moment."""


def one_moment(draw: Draw) -> Place:
    """Ask for two lines with the same moment."""
    plane, one, other, moment = draw.one_of(PLANES)
    value = draw.one_of((0.75, 1.0, 1.25)) * np.array(moment, dtype=float)
    a, b = _with_moment(one, value, -0.5), _with_moment(other, value, 0.5)
    size = np.linalg.norm(value)
    return Place(
        question=r"The moment of line A is the blue arrow $\bar{\mathbf x}$. Bring line B where it "
        r"has the same moment, $\bar{\mathbf y}=\bar{\mathbf x}$, but another direction: at least "
        r"half a radian away. $0.03$ more or less will do.",
        start=TwoLines(a, OneLine(-0.7, 1.0, 0.8, 0.9, 0.6)),
        model=TwoLines(a, b),
        conditions=lambda pair: (
            _same_moment(pair),
            _two_directions(pair),
        ),
        slips=(
            Misconception(
                "one line twice",
                lambda pair: _moment_off(pair) <= SAME and pair.across.angle < 0.1,
                r"With the direction the same as well, $\mathbf Y=\mathbf X$ is one line. Turn B "
                "in the plane through A and the origin, and keep its distance from the origin.",
                TwoLines(a, a),
            ),
            Misconception(
                "the other way round the origin",
                lambda pair: _moment_off(pair, -1) <= SAME < _moment_off(pair),
                r"Plane and distance are right, but B goes round the origin the other way: "
                r"$\bar{\mathbf y}=-\bar{\mathbf x}$. Reverse one of the two.",
                TwoLines(a, b.reversed()),
            ),
        ),
        because=r"Both lines lie in the plane through the origin that is normal to "
        r"$\bar{\mathbf x}$, touch the same circle about the origin and go round it the same way. "
        "A moment alone is not yet a line: the direction has to be given too.",
        hints=(
            r"A moment is normal to its line and to the way from the origin to it. In which plane "
            r"through the origin do lines with the moment $\bar{\mathbf x}$ lie?",
            r"$\|\bar{\mathbf x}\|$ is the distance from the origin: in that plane both lines "
            "touch the same circle about it, and they go round it the same way.",
            rf"The plane is ${plane}$, the radius ${size:g}$. Choose a direction $\mathbf y$ in "
            r"the plane; the foot point of B has to be $\mathbf y\times\bar{\mathbf x}$.",
        ),
        solution=rf"One such pair is shown now: B lies in the plane ${plane}$ too, with "
        rf"$u={tex.angle(b.u)}$, $v={tex.angle(b.v)}$, and its foot point is "
        rf"$\mathbf y\times\bar{{\mathbf x}}={tex.vector(b.line.foot.round(3))}$.",
    )


def _with_moment(turns: tuple[float, float], moment: Array, along: float) -> OneLine:
    """Return the line with this direction and moment, its given point beside the foot point."""
    u, v = (math.pi * part for part in turns)
    direction = on_sphere(np.array([u, v]))
    point = np.cross(direction, moment) + along * direction
    return OneLine(u, v, *(round(float(entry), 4) for entry in point))


def _moment_off(pair: Pair, sign: int = 1) -> float:
    """Return how far the moment of B is from that of A, or from its opposite."""
    return float(np.linalg.norm(pair.b.moment - sign * pair.a.moment))


def _same_moment(pair: Pair) -> Condition:
    mine, wanted = (tex.vector(line.moment.round(2)) for line in (pair.b, pair.a))
    said = rf"now $\bar{{\mathbf y}}={mine}$, $\bar{{\mathbf x}}={wanted}$"
    text = r"moments $\bar{\mathbf y}=\bar{\mathbf x}$"
    return Condition(text, _moment_off(pair), SAME, "length", said)


def _two_directions(pair: Pair) -> Condition:
    now = float(pair.across.angle)
    return at_least(r"directions $\theta\ge0.5$", now, 0.5, "rad", rf"now $\theta={now:.2f}$")


EXERCISES = (
    Exercise("02.1", "A line through two points", through),
    Exercise("02.2", "A road to the east", side),
    Exercise("02.3", "Is it a line?", is_line),
    Exercise("02.4", "Which moment, which foot?", foot),
    Exercise("02.5", "One of them reversed", reverse),
    Exercise("02.6", "A dual angle in three lines", angle),
    Exercise("02.7", "Move it until they meet", meet),
    Exercise("02.8", "The dual part", dual_part),
    Exercise("02.9", "Which one meets the axis?", which_meet),
    Exercise("02.10", "How far apart?", parallel),
    Exercise("02.11", "B turns", turning),
    Exercise("02.12", "A dual angle to order", to_order),
    Exercise("02.13", "One moment, two lines", one_moment),
)
"""The exercises in their order."""
