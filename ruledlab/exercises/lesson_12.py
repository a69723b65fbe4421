"""Exercises of lesson 12: reading printed formulas, and telling which cannot be right."""

from __future__ import annotations

import math

import numpy as np

from ..design import Design
from ..geometry import gallery
from ..printed import finding
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
from .designs import at_least

__all__ = ["EXERCISES"]

OVER = np.linspace(0.0, 1.0, 101)


# -- find the slip ---------------------------------------------------------------------------------


def second_form(draw: Draw) -> FindSlip:
    """Ask for the slip in h₁₁."""
    options = (
        Option(
            r"$+\,(\kappa\bar\tau+w\kappa'-\bar\kappa\tau)\,\mathbf x_2$",
            r"$\bar\tau\mathbf x_1'=\kappa\bar\tau\,\mathbf x_2$, "
            r"$(w\kappa\,\mathbf x_2)'$ gives $w\kappa'\mathbf x_2$, and "
            r"$\bar\kappa\,\mathbf x_3'=-\bar\kappa\tau\,\mathbf x_2$.",
            right=True,
        ),
        Option(
            r"$+\,(\kappa\bar\tau+w\kappa'-\tau)\,\mathbf x_2$",
            r"One factor is back. The last term comes from $\bar\kappa\,\mathbf x_3'$: there is "
            "one more.",
        ),
        Option(
            r"$+\,(\bar\kappa\bar\tau+w\kappa'-\kappa\tau)\,\mathbf x_2$",
            r"The factors have changed places: $\bar\tau$ stands before $\mathbf x_1$, whose "
            r"derivative is $\kappa\mathbf x_2$.",
        ),
        Option(
            r"$+\,(\kappa\bar\tau+w\kappa'+\bar\kappa\tau)\,\mathbf x_2$",
            r"The factors are right. Look at the sign of $\mathbf x_3'=-\tau\mathbf x_2$.",
        ),
    )
    return FindSlip(
        question=r"The way from $\mathbf r_t$ to $h_{11}$, with "
        r"$W=\sqrt{\bar\kappa^2+w^2\kappa^2}$. In one line something was lost. Which?",
        lines=(
            Line(
                r"$\mathbf r_t=\bar\tau\,\mathbf x_1+w\kappa\,\mathbf x_2+\bar\kappa\,\mathbf x_3$",
                r"it is $\mathbf m'+w\,\mathbf x_1'$, with (7) and (4).",
            ),
            Line(
                r"$\mathbf r_{tt}=(\bar\tau'-w\kappa^2)\,\mathbf x_1"
                r"+(\bar\tau+w\kappa'-\tau)\,\mathbf x_2+(\bar\kappa'+w\kappa\tau)\,\mathbf x_3$",
            ),
            Line(
                r"$\mathbf n=(\bar\kappa\,\mathbf x_2-w\kappa\,\mathbf x_3)/W$",
                r"it is $\mathbf r_t\times\mathbf x_1$ divided by its length.",
            ),
            Line(
                r"$h_{11}=\langle\mathbf r_{tt},\mathbf n\rangle$: $\bar\kappa$ times the "
                r"$\mathbf x_2$ part minus $w\kappa$ times the $\mathbf x_3$ part, divided by $W$",
                "this is the definition, with the normal of the line before.",
            ),
        ),
        then=Choose(
            question=r"What should the $\mathbf x_2$ part be?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            "Count, in each line, how often an angle per unit of t and how often a length stands "
            "in each term.",
            r"Use (4): $\mathbf x_1'=\kappa\mathbf x_2$, "
            r"$\mathbf x_2'=-\kappa\mathbf x_1+\tau\mathbf x_3$, $\mathbf x_3'=-\tau\mathbf x_2$.",
            r"Which three terms of $\mathbf r_{tt}$ point along $\mathbf x_2$?",
        ),
        solution=r"The $\mathbf x_2$ part of $\mathbf r_{tt}$ is "
        r"$\kappa\bar\tau+w\kappa'-\bar\kappa\tau$; its factors $\kappa$ and $\bar\kappa$ were "
        r"lost. The other lines stand.",
    )


def at_the_start(draw: Draw) -> FindSlip:
    """Ask for the slip in δ(0), and for its value."""
    degree, height, vbar = draw.integer(2, 5), draw.one_of((3, 6)), draw.integer(2, 4)
    place = {3: r"\tfrac\pi3", 6: r"\tfrac\pi6"}[height]
    value = vbar / math.tan(math.pi / height)
    return FindSlip(
        question=rf"A Bézier curve of degree $n={degree}$ starts along a circle of latitude: "
        rf"$\mathbf p_1-\mathbf p_0=(\Delta_u,0)$, $\Delta_u>0$, at $v_0={place}$. There "
        rf"$\bar u=0$ and $\bar u_u=0$, $\bar v={vbar}$. One of these lines, taken from §4.2, "
        "is not right.",
        lines=(
            Line(
                r"$\kappa(0)=n\,\Delta_u\sin v_0$",
                r"it is the speed $u'\sin v$ with $u'(0)=n\Delta_u$.",
            ),
            Line(
                r"$\bar\kappa(0)=n\,\Delta_u\,\bar v\cos v_0$",
                r"(18) with $v'=0$: $u'^2\sin v\,\bar v\cos v$, divided by $\kappa=u'\sin v$.",
            ),
            Line(r"$\delta(0)=n\,\bar v\cos v_0/\sin v_0$"),
        ),
        then=Number(
            question=r"How large is $\delta(0)$?",
            solution="",
            answer=value,
            label="δ(0) =",
            unit="length",
            slips=(
                known.mistaken_for(
                    "δ(0) as printed",
                    degree * value,
                    r"This still has the factor $n$. It stands in $\kappa(0)$ and in "
                    r"$\bar\kappa(0)$; in their quotient it cancels.",
                ),
                known.mistaken_for(
                    "δ inverted",
                    1.0 / value,
                    r"This is $\kappa/\bar\kappa$. The distribution parameter is "
                    r"$\delta=\bar\kappa/\kappa$, a length.",
                ),
            ),
            because=r"$\delta=\bar\kappa/\kappa=\bar v\cot v_0$, whatever the degree.",
        ),
        hints=(
            r"$\delta=\bar\kappa/\kappa$. Compare the three lines.",
            "Raise the degree: the curve stays as it is, and so must the surface.",
            r"$\delta(0)=\bar v\cot v_0$.",
        ),
        solution=rf"The factor $n$ cancels: $\delta(0)=\bar v\cot v_0={value:.6f}$. With the "
        f"printed $n$ it would be {degree} times as large, and would grow whenever the degree of "
        "the same curve is raised.",
    )


# -- choose ----------------------------------------------------------------------------------------


def catching(draw: Draw) -> Choose:
    """Ask which test catches a slip."""
    case = draw.integer(0, 2)
    formula, first, words, right = _CASES[case]
    tests = (first, *_TESTS)
    options = tuple(
        Option(text, word, right=place == right)
        for place, (text, word) in enumerate(zip(tests, words, strict=True))
    )
    return Choose(
        question=f"Printed is {formula}. Which of these tests would have shown that it cannot be "
        "right?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "A test catches a slip only if the two sides of the equation answer to it differently.",
            "Go through the tests one by one: what does the left side do, what the right side?",
        ),
        solution=f"{tests[right]}. {words[right]}",
    )


_UNEVENLY = "Run through the same path with a speed that changes on the way"

_TESTS = (
    "Raise the degree of the same Bézier curve",
    r"Make $\bar u$ and $\bar v$ three times as large",
    "Follow an orthogonal trajectory once round a hyperboloid and measure the gap",
)

_CASES: tuple[tuple[str, str, tuple[str, str, str, str], int], ...] = (
    (
        r"$\kappa^2\tau=\cos v\,(u'^3\sin^2v+2u'v'^2)+\sin v\,(u'v''+u''v')$",
        _UNEVENLY,
        (
            r"The change of speed adds a multiple of $(u',v')$ to $(u'',v'')$. $u''v'-u'v''$ does "
            r"not notice; $u'v''+u''v'$ does, so the printed $\tau$ would depend on more than the "
            "path and the speed at this place.",
            "The curve is the same function of t, with the same derivatives: nothing changes.",
            r"$\tau$ belongs to the directions; neither side contains $\bar u,\bar v$.",
            r"This measures the pitch, an integral of $\bar\tau$.",
        ),
        0,
    ),
    (
        r"$\delta(0)=\dfrac{n\,\Delta_u^2\sin v_0\,(\bar v\cos v_0+\bar u_u\sin v_0)}"
        r"{\Delta_u^2\sin^2v_0+\Delta_v^2}$",
        "Keep the first half of the curve only, run through at half the speed",
        (
            r"The degree stays, and $\Delta_u,\Delta_v$ are halved: the right side does not "
            "change, as it should not.",
            r"The surface is the same, and the leg becomes shorter by $n/(n+1)$, which cancels. "
            r"The $n$ in front does not: the right side grows.",
            "Both sides become three times as large.",
            r"This measures the pitch; $\delta$ does not enter.",
        ),
        1,
    ),
    (
        r"$l=+\oint\sin v\,(\bar u\,v'-\bar v\,u')\,dt$",
        _UNEVENLY,
        (
            "Neither side changes: the integral is one along the path.",
            "The curve is the same function of t: nothing changes.",
            "Both sides become three times as large.",
            r"The trajectory obeys $w'=-\langle\mathbf c',\mathbf x\rangle$; the gap it leaves has "
            "the sign of (10), and the opposite of this.",
        ),
        3,
    ),
)
"""Formula as printed, the first test, what each test does to it, and which one catches it."""


def weights(draw: Draw) -> Choose:
    """Ask which formula cannot be right because its sides scale differently."""
    lengths = draw.integer(0, 1) == 0
    change = (
        "Measure lengths in another unit, so that all lengths are multiplied by $s$"
        if lengths
        else "Run through everything $s$ times as fast, at constant speed"
    )
    law = (
        r"$\bar\kappa,\bar\tau,w$ get the factor $s$; $\kappa$ and $\tau$, angles per $t$, stay"
        if lengths
        else r"$\kappa,\tau,\bar\kappa,\bar\tau$ get the factor $s$, $\kappa'$ and $\bar\kappa'$ "
        r"the factor $s^2$; $w$ stays"
    )
    if lengths:
        good = (
            "Both sides get $s^{-2}$, as an inverse area should.",
            "Both sides get $s$.",
            "Both sides get $s^2$.",
        )
        bad = (
            r"$\bar\tau$ and $w\kappa'$ get the factor $s$, $\tau$ gets none: the terms of one sum "
            "scale differently, so the sum scales in no way at all."
        )
    else:
        good = (
            "Numerator and denominator get $s^4$: nothing changes, as the surface does not.",
            "Neither side changes: the factors $s$ of $\\bar\\kappa$ and $\\kappa$ cancel.",
            "Both sides get $s^2$.",
        )
        bad = (
            r"$w\kappa'$ gets $s^2$, but $\bar\tau$ and $\tau$ get only $s$: the terms of one sum "
            "scale differently, and a property of the surface would depend on the speed."
        )
    options = (
        Option(r"$K=-\kappa^2\bar\kappa^2/(w^2\kappa^2+\bar\kappa^2)^2$", good[0]),
        Option(r"$\delta=\bar\kappa/\kappa$", good[1]),
        Option(r"$g_{11}=\bar\tau^2+w^2\kappa^2+\bar\kappa^2$", good[2]),
        Option(
            r"$h_{11}=\dfrac{\bar\kappa(\bar\tau+w\kappa'-\tau)-w\kappa(w\kappa\tau+\bar\kappa')}"
            r"{\sqrt{w^2\kappa^2+\bar\kappa^2}}$",
            bad,
            right=True,
        ),
    )
    return Choose(
        question=f"{change}: {law}. Which of these formulas cannot be right?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Give each term its weight: the power of $s$ that it gets.",
            "Terms that are added must have the same weight.",
        ),
        solution=rf"The printed $h_{{11}}$. {bad} With $\kappa\bar\tau+w\kappa'-\bar\kappa\tau$ "
        "all terms have one weight.",
    )


def borrowed(draw: Draw) -> Choose:
    """Ask what the printed τ̄ may be used for."""
    places = r"$\sin v\,(\bar u\,v'-\bar v\,u')$"
    slip = "τ̄ as printed in (18)"
    point = (
        r"The point that moves here is the striction point, by (7): $\bar\tau$ itself is needed, "
        r"with $\mu'$. What is printed is $\langle\mathbf c',\mathbf x\rangle$, of the foot point."
    )
    options = (
        Option(
            r"the pitch of a closed surface, $l=-\oint\bar\tau\,dt$",
            r"What is missing is $\mu'$, and $\oint\mu'\,dt=0$ because $\mu$ returns to its value.",
            right=True,
        ),
        Option(r"the striction $\sigma$ at one $t$, from $\cot\sigma=\bar\tau/\bar\kappa$",
               point, slip=slip),
        Option(r"the speed $\sqrt{\bar\tau^2+\bar\kappa^2}$ of the striction point",
               point, slip=slip),
        Option(
            r"$g_{12}=\langle\mathbf r_t,\mathbf r_w\rangle=\bar\tau$ on the patch "
            r"$\mathbf r=\mathbf m+w\mathbf x$",
            point + r" On the patch $\mathbf c+w\mathbf x$ the printed value would be $g_{12}$.",
            slip=slip,
        ),
    )  # fmt: skip
    return Choose(
        question=f"(18) prints {places} where $\\bar\\tau$ should stand. For which of these may "
        "one use it all the same?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"The right $\bar\tau$ is the printed one plus $\mu'$, with $\mathbf m=\mathbf c+"
            r"\mu\mathbf x$.",
            r"For which of the four does $\mu'$ make no difference?",
        ),
        solution=r"For the pitch: $\oint\bar\tau\,dt=\oint\langle\mathbf c',\mathbf x\rangle\,dt$, "
        r"as $\oint\mu'\,dt=0$. Everything at a single $t$ needs $\mu'$.",
    )


def within_reach(draw: Draw) -> Choose:
    """Ask which λ a loop in a rectangle of the chart can have at all."""
    width, across = draw.one_of(((4, math.pi / 4), (3, math.pi / 3), (2, math.pi / 2)))
    low, high, band = draw.one_of(
        (
            (r"\tfrac\pi4", r"\tfrac\pi2", math.sqrt(0.5)),
            (r"\tfrac\pi3", r"\tfrac\pi2", 0.5),
            (r"\tfrac\pi3", r"\tfrac{2\pi}3", 1.0),
        )
    )
    area = across * band
    turn = 2 * math.pi
    options = (
        Option(
            f"${0.7 * area - turn:.3f}$",
            rf"It is ${0.7 * area:.3f}-2\pi$: a loop of the area ${0.7 * area:.3f}$, less than "
            rf"${area:.3f}$, has $\oint\tau\,dt=2\pi-\text{{area}}$.",
            right=True,
        ),
        Option(
            f"${1.5 * area:.3f}$",
            rf"It is nearest to 0, but farther from it than ${area:.3f}$, the area of the whole "
            "rectangle.",
        ),
        Option(
            f"${turn - 1.4 * area:.3f}$",
            rf"Modulo $2\pi$ this is $-{1.4 * area:.3f}$: no loop in the rectangle encloses so "
            "much.",
        ),
        Option(
            f"${-math.pi:.3f}$",
            rf"Half a turn would need a loop of the area $\pi$; the rectangle has ${area:.3f}$.",
        ),
    )
    return Choose(
        question="All control points of a Bézier curve that closes with C¹ have "
        rf"$0\le u\le\tfrac\pi{width}$ and ${low}\le v\le{high}$. The curve has no double point. "
        r"Its $\bar u,\bar v$ and its degree are unknown. Which of these angles of pitch "
        r"$\lambda$ is possible?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"How large an area can the curve enclose on the sphere? $\lambda$ is that area or its "
            r"negative, up to whole turns.",
            r"The rectangle has the area $\Delta u\,(\cos v_1-\cos v_2)$.",
            rf"Which of them is within ${area:.3f}$ of a multiple of $2\pi$?",
        ),
        solution=rf"The curve stays in the rectangle, whose area is ${area:.4f}$, and "
        r"$\lambda\equiv\pm$ area modulo $2\pi$. "
        rf"Only ${0.7 * area - turn:.3f}={0.7 * area:.3f}-2\pi$ is near enough to a multiple of "
        r"$2\pi$.",
    )


# -- numbers and formulas --------------------------------------------------------------------------


def waist(draw: Draw) -> Number:
    """Ask for the printed and the mended h₁₁ on the waist of a hyperboloid."""
    radius, over = draw.integer(2, 5), draw.one_of((3, 6))
    alpha = math.pi / over
    sine, cosine = math.sin(alpha), math.cos(alpha)
    printed, mended = -radius * sine - cosine, -float(radius)
    return Number(
        question=rf"A hyperboloid of one sheet: $u=t$, $v=\alpha=\tfrac\pi{over}$, $\bar u=0$, "
        rf"$\bar v=r={radius}$. It has $\kappa=\sin\alpha$, $\bar\kappa=r\cos\alpha$, "
        r"$\tau=\cos\alpha$, $\bar\tau=-r\sin\alpha$. Compute $h_{11}$ at its waist, $w=0$, where "
        r"$W=\bar\kappa$: first as printed, $\bar\tau+w\kappa'-\tau$, then mended, "
        r"$\kappa\bar\tau+w\kappa'-\bar\kappa\tau$. Give both, [printed, mended].",
        answer=[printed, mended],
        label="h₁₁ =",
        slips=(
            known.mistaken_for(
                "mended before printed",
                [mended, printed],
                "These are the two numbers, in the other order: [printed, mended].",
            ),
            known.mistaken_for(
                "sign of the normal",
                [-printed, -mended],
                r"The size is right. With $\mathbf n=\mathbf x_2$ at the waist both are negative: "
                r"$\bar\tau<0<\tau$.",
            ),
        ),
        because="The waist is a circle of radius r, run through once in $2\\pi$: the acceleration "
        "is $r$, towards the axis, against the normal. The mended value is $-r$.",
        hints=(
            r"At the waist $w=0$, and $h_{11}$ is the bracket alone, as $\bar\kappa/W=1$.",
            r"Printed: $-r\sin\alpha-\cos\alpha$. Mended: $-r\sin^2\alpha-r\cos^2\alpha$.",
        ),
        solution=rf"Printed ${printed:.6f}$, mended $-r={mended:g}$: the acceleration of a point "
        "that runs round the waist circle with speed $r$.",
    )


def constant(draw: Draw) -> Formula:
    """Ask for κκ̄ of Example 1 with other factors."""
    a, b = draw.integer(2, 5), draw.integer(2, 5)
    box = ((0.2, 2.8),)
    return Formula(
        question=r"Example 1 with other factors: $u=v=t$, "
        rf"$\bar u={a}(u-v)$, $\bar v={b}(u+v)$. Along the curve $\bar u=0$, $\bar v={2 * b}t$. "
        r"Use (18), $\kappa\bar\kappa=u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)"
        r"+u'v'(\bar v_u+\bar u_v\sin^2v)+v'^2\bar v_v$, which is right, and write "
        r"$\kappa\bar\kappa$ as a formula in $t$.",
        answer=f"{b}*(t*sin(2*t) + 2)",
        variables=("t",),
        box=box,
        label="κκ̄ =",
        slips=(
            known.formula(
                "the constant of Example 1",
                f"{b}*(t*sin(2*t) + 3)",
                r"This has the constant 3 that is printed in Example 1. Add $\bar u_u\sin^2t+\bar "
                r"u_v\sin^2t+\bar v_u+\bar v_v$ once more: the first two cancel.",
                ("t",),
                box,
            ),
            known.formula(
                "derivatives along the curve",
                f"{b}*t*sin(2*t)",
                r"The partial derivatives are missing: $\bar u=0$ <i>along</i> the curve does not "
                r"make $\bar u_u$ zero.",
                ("t",),
                box,
            ),
            known.formula(
                "sign of ū_v",
                f"{b}*(t*sin(2*t) + 2) + 2*{a}*sin(t)^2",
                rf"Here $\bar u_v$ is taken as $+{a}$. It is $-{a}$, and the two terms with "
                r"$\sin^2t$ cancel.",
                ("t",),
                box,
            ),
            known.formula(
                "κ̄ for κκ̄",
                f"{b}*(t*sin(2*t) + 2)/sqrt(1 + sin(t)^2)",
                r"This is $\bar\kappa$. Asked for is $\kappa\bar\kappa$, without the root below.",
                ("t",),
                box,
            ),
        ),
        because=r"$\sin^2t\,(\bar u_u+\bar u_v)=0$ and $\bar v_u+\bar v_v=2\cdot$ the factor of "
        r"$\bar v$.",
        hints=(
            r"$u'=v'=1$. What are $\bar u_u,\bar u_v,\bar v_u,\bar v_v$?",
            rf"$\bar u_u={a}$, $\bar u_v=-{a}$, $\bar v_u=\bar v_v={b}$.",
        ),
        solution=rf"${2 * b}t\sin t\cos t+{a}\sin^2t-{a}\sin^2t+{b}+{b}={b}\,(t\sin2t+2)$. With "
        r"factors 1 this is the numerator of Example 1, where 3 is printed in place of 2.",
    )


def striction_speed(draw: Draw) -> Number:
    """Ask for the speed of the striction point from the parts of τ̄."""
    advance, slope = draw.one_of(((1.0, 2.0), (2.0, 1.0), (-1.0, 4.0), (1.0, -4.0)))
    kappa_bar = draw.one_of((4.0, 2.0, 1.0))
    value = math.hypot(advance + slope, kappa_bar)
    return Number(
        question=rf"At some $t$ a surface has $\sin v\,(\bar uv'-\bar vu')={advance:g}$, "
        rf"$\mu'={slope:g}$ and $\bar\kappa={kappa_bar:g}$. How fast does its striction point "
        r"move, $\|\mathbf m'\|$?",
        answer=value,
        label="‖m′‖ =",
        unit="length per t",
        slips=(
            known.mistaken_for(
                "τ̄ as printed in (18)",
                math.hypot(advance, kappa_bar),
                r"Here $\sin v\,(\bar uv'-\bar vu')$ was taken for $\bar\tau$, as (18) prints it. "
                r"That is $\langle\mathbf c',\mathbf x\rangle$; the striction point has $\mu'$ "
                "besides.",
            ),
            known.mistaken_for(
                "square of the length",
                value**2,
                r"This is $\bar\tau^2+\bar\kappa^2$, the square of the speed.",
            ),
            known.mistaken_for(
                "sum for length",
                abs(advance + slope) + kappa_bar,
                r"$\mathbf x_1$ and $\mathbf x_3$ are perpendicular: "
                r"$\|\mathbf m'\|^2=\bar\tau^2+\bar\kappa^2$.",
            ),
        ),
        because=r"$\bar\tau=\langle\mathbf c',\mathbf x\rangle+\mu'$ and "
        r"$\mathbf m'=\bar\tau\,\mathbf x_1+\bar\kappa\,\mathbf x_3$.",
        hints=(
            r"$\mathbf m'=\bar\tau\,\mathbf x_1+\bar\kappa\,\mathbf x_3$, (7).",
            r"The mended (18): $\bar\tau=\sin v\,(\bar uv'-\bar vu')+\mu'$.",
        ),
        solution=rf"$\bar\tau={advance:g}{slope:+g}={advance + slope:g}$, so "
        rf"$\|\mathbf m'\|=\sqrt{{\bar\tau^2+\bar\kappa^2}}={value:.6f}$.",
    )


# -- a design --------------------------------------------------------------------------------------


def _open(points: tuple[tuple[float, float], ...], name: str) -> Design:
    return Design(points, "u - v", "u + v", name=name)


BENT = _open(((0.4, 0.8), (1.0, 2.2), (1.7, 0.7), (2.3, 1.6)), "a bent path")
EVEN = _open(((0.4, 0.8), (1.0, 1.1), (1.7, 1.4), (2.3, 1.7)), "colatitudes in equal steps")
UNEVEN = _open(((0.4, 0.8), (0.5, 0.9), (1.4, 1.8), (2.3, 2.7)), "straight, at uneven speed")


def agreement(draw: Draw) -> Drag:
    """Ask for a design on which the printed τ is right."""
    within = draw.one_of((0.1, 0.15))
    entry = finding("tau")

    def conditions(made: Made) -> tuple[Condition, ...]:
        off = float(np.abs(entry.difference(made.surface, OVER)).max())  # NaN where undefined
        velocity = made.surface.jet(OVER, 1).direction[1]
        speed = float(np.linalg.norm(velocity, axis=0).min())
        return (
            Condition(
                r"printed and mended $\tau$ differ by at most " + f"{within:g}",
                off,
                within,
                "rad per t",
                f"now by {off:.2f}" if off == off else "somewhere one of them is undefined",
            ),
            at_least(
                r"the path does not stand still: $\kappa\ge0.5$",
                speed,
                0.5,
                "rad per t",
                rf"least $\kappa={speed:.2f}$",
            ),
        )

    return Drag(
        question=r"(18) prints $u'v''+u''v'$ in $\tau$ where $u''v'-u'v''$ belongs. Drag the "
        r"points until this makes no difference: $\tau$ as printed and $\tau$ mended are to differ "
        f"by at most ${within:g}$ everywhere.",
        start=BENT,
        model=EVEN,
        conditions=conditions,
        plots=("tau",),
        slips=(
            Misconception(
                "straight for evenly spaced",
                _straight,
                "The path in the chart is straight now, but its points are not evenly spaced: the "
                "speed changes along it. The right bracket does not notice that; the printed one "
                "does.",
                UNEVEN,
            ),
        ),
        because=r"The two differ by $2\sin v\,u'v''/\kappa^2$. An example with $v''=0$, such as "
        "the paper's Example 1, cannot show the slip.",
        hints=(
            r"How large is the difference of the two brackets?",
            r"It is $2\,u'v''$. What makes $v''=0$ everywhere?",
            "Put the colatitudes $v$ of the four points at equal steps, or all at one height.",
        ),
        solution="The colatitudes of the four points grow in equal steps now: $v$ is linear in "
        "$t$.",
    )


def _straight(made: Made) -> bool:
    points = np.array(made.design.points)
    legs = np.diff(points, axis=0)
    chord = points[-1] - points[0]
    aside = np.abs(legs[:, 0] * chord[1] - legs[:, 1] * chord[0]) / max(np.hypot(*chord), 1e-9)
    steps = np.hypot(*legs.T)
    return bool(aside.max() < 0.05 and np.ptp(steps) > 0.2 * steps.max())


# -- Python ----------------------------------------------------------------------------------------


def in_python(draw: Draw) -> Code:
    """Ask for the difference of printed and mended τ̄ on a design of the gallery."""
    key = draw.one_of(("twisted_ring", "orchid", "example_2"))
    t = draw.one_of(((0.1, 0.35, 0.6), (0.15, 0.4, 0.8), (0.2, 0.3, 0.7)))
    places = ", ".join(f"{x:g}" for x in t)
    surface, entry = gallery.surface(key), finding("tau_bar")
    off = entry.difference(surface, t)
    return Code(
        question=rf"How far is the printed $\bar\tau$ of (18) from the mended one on the gallery's "
        rf"<code>{key}</code> at $t={places}$? Give printed − mended, as an array. The finding has "
        "the key <code>tau_bar</code>.",
        starter="from ruledlab.geometry import gallery\nfrom ruledlab.printed import finding\n\n"
        f"t = [{places}]\nvalue = ...",
        answer=off,
        label="printed − mended =",
        unit="length per t",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "mended − printed",
                -off,
                "This is mended − printed, which is $\\mu'$; the other way round is asked for.",
                1e-6,
            ),
            known.mistaken_for(
                "τ̄ as printed in (18)",
                entry.printed(surface, t),
                r"This is the printed value itself, $\langle\mathbf c',\mathbf x\rangle$, taken "
                r"for the difference.",
                1e-6,
            ),
        ),
        hints=(
            'finding("tau_bar") has the functions .printed and .corrected of (surface, t).',
            ".difference(surface, t) is the one minus the other.",
        ),
        solution=f'<pre>surface = gallery.surface("{key}")\n'
        'value = finding("tau_bar").difference(surface, t)</pre>'
        r"It is $-\mu'$: the striction point's own motion along the ruling.",
    )


EXERCISES = (
    Exercise("12.1", "A lost factor", second_form),
    Exercise("12.2", "Which test catches it?", catching),
    Exercise("12.3", "Weighing terms", weights),
    Exercise("12.4", "On the waist", waist),
    Exercise("12.5", "The constant of Example 1", constant),
    Exercise("12.6", "At the first control point", at_the_start),
    Exercise("12.7", "What the printed τ̄ is good for", borrowed),
    Exercise("12.8", "How fast the striction point moves", striction_speed),
    Exercise("12.9", "Where a slip hides", agreement),
    Exercise("12.10", "The difference in three lines", in_python),
    Exercise("12.11", "Within reach", within_reach),
)
"""The exercises in their order."""
