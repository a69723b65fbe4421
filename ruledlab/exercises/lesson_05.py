"""Exercises of lesson 05: the turning tangent plane, the fundamental forms, K and H."""

from __future__ import annotations

import functools
import math

import numpy as np

from ..design import Design
from ..geometry.checks import Array
from ..geometry.gallery import surface
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

__all__ = ["EXERCISES"]

HALF = math.sqrt(math.sqrt(2) - 1)
"""w/δ where |K| is half as large as at the striction point."""

BOX = ((-2.0, 2.0), (0.4, 2.0))


# -- numbers ---------------------------------------------------------------------------------------


def deepest(draw: Draw) -> Number:
    """Ask for K at the striction point."""
    delta = draw.one_of((0.4, 0.5, 0.8, 1.25, 2.0, 2.5)) * draw.one_of((1, -1))
    value = -1 / delta**2
    return Number(
        question=rf"A ruling has the distribution parameter $\delta={delta:g}$. How large is the "
        "Gauss curvature $K$ in its striction point?",
        answer=value,
        label="K =",
        unit="1/length²",
        slips=(
            known.mistaken_for(
                "sign of K",
                -value,
                r"The size is right. No ruled surface has $K>0$ anywhere: "
                r"$h_{22}=0$ makes $K=-h_{12}^2/\det g$.",
            ),
            *(
                known.mistaken_for(
                    "δ not squared",
                    sign / delta,
                    r"$1/\delta$ has the unit of the curvature of a curve, 1/length. $K$ is a "
                    r"product of two of those: $-1/\delta^2$.",
                )
                for sign in (1, -1)
            ),
            known.mistaken_for(
                "δ inverted",
                -(delta**2),
                r"This is $-\delta^2$, a length squared. The smaller $\delta$, the sharper the "
                r"surface is folded along its striction curve.",
            ),
        ),
        because=r"$K=-1/\delta^2$ at $w=0$. The sign of $\delta$ cannot be seen in $K$.",
        hints=(
            r"Where on the ruling is the striction point? What is $w$ there?",
            r"$K=-\delta^2/(\delta^2+w^2)^2$.",
            rf"$K=-({delta:g})^2/({delta:g})^4$.",
        ),
        solution=rf"With $w=0$: $K=-\delta^2/\delta^4=-1/\delta^2=-1/{delta**2:g}={value:.4g}$.",
    )


def half_as_much(draw: Draw) -> Number:
    """Ask where |K| is half of its maximum."""
    delta = draw.one_of((0.5, 1.0, 1.5, 2.0, 3.0))
    return Number(
        question=rf"Along a ruling with $\delta={delta:g}$, at which $w>0$ has $|K|$ come down to "
        "half of its greatest value?",
        answer=HALF * delta,
        label="w =",
        unit="length",
        slips=(
            known.mistaken_for(
                "a quarter for a half",
                delta,
                r"At $w=\delta$ the plane has turned by 45° and $|K|=\cos^4 45°/\delta^2$: that "
                "is a quarter of the maximum.",
            ),
            known.mistaken_for(
                "square of δ² + w² forgotten",
                math.sqrt(math.sqrt(2)) * delta,
                r"$\delta^2+w^2=\sqrt2\,\delta^2$ is right; the $w^2$ in it is only $\sqrt2-1$ "
                "of these.",
            ),
            known.mistaken_for(
                "last root forgotten",
                HALF**2 * delta,
                r"$\sqrt2-1$ is $w^2/\delta^2$; take the root once more.",
            ),
        ),
        because=r"$\delta^2+w^2=\sqrt2\,\delta^2$.",
        hints=(
            r"The greatest value is $1/\delta^2$, at $w=0$.",
            r"Solve $\delta^2/(\delta^2+w^2)^2=1/(2\delta^2)$.",
            r"$(\delta^2+w^2)^2=2\delta^4$; take the root.",
        ),
        solution=r"$(\delta^2+w^2)^2=2\delta^4$, so $w^2=(\sqrt2-1)\,\delta^2$ and "
        rf"$w={HALF:.4f}\,\delta={HALF * delta:.4f}$.",
    )


def between_planes(draw: Draw) -> Number:
    """Ask how far the tangent plane turns between two points of a ruling."""
    # not 2: arctan 1 + arctan ½ = arctan 3, and two slips would be one
    delta, factor = draw.one_of((0.5, 1.0, 2.0)), draw.one_of((1, 3, 4))
    first, second = -delta, factor * delta
    value = math.pi / 4 + math.atan(factor)
    return Number(
        question=rf"A ruling has $\delta={delta:g}$. Through which angle does the tangent plane "
        rf"turn from $w={first:g}$ to $w={second:g}$?",
        answer=value,
        label="angle =",
        unit="rad",
        slips=(
            known.mistaken_for(
                "one tangent of the distance",
                math.atan(factor + 1),
                rf"$\arctan\frac{{{second - first:g}}}{{{delta:g}}}$ would be right if you began "
                r"at the striction point. The plane turns fast there and slowly farther out: "
                r"take the difference of two values of $\theta$.",
            ),
            known.mistaken_for(
                "tan θ = δ/w",
                math.pi / 4 + math.atan(1 / factor),
                r"Here one $\theta$ was taken from $\tan\theta=\delta/w$. At the striction point "
                r"$\theta=0$, so $w$ is above: $\tan\theta=w/\delta$.",
            )
            if factor > 1
            else known.mistaken_for(
                "one side only",
                math.pi / 4,
                r"That is how far it turns from the striction point. It turns as far on the "
                "other side.",
            ),
            known.mistaken_for(
                "sign of θ lost",
                math.atan(factor) - math.pi / 4,
                r"The two ends lie on different sides of the striction point: there $\theta$ has "
                "different signs, and the two turns add up.",
            ),
            known.degrees(value),
        ),
        hints=(
            r"$\tan\theta=w/\delta$ at both ends.",
            r"At $w=-\delta$ the angle is $-45°=-\pi/4$.",
            rf"$\arctan({factor})-\arctan(-1)$.",
        ),
        solution=rf"$\theta$ goes from $\arctan(-1)=-\tfrac\pi4$ to $\arctan{factor}$, which makes "
        rf"${value:.4f}$.",
    )


def mean_by_hand(draw: Draw) -> Number:
    """Ask for H from the invariants."""
    kappa, w, kappa_bar = draw.one_of(((2, 2, 3), (1, 4, 3), (3, 1, 4), (1, 3, 4)))
    # of opposite signs, for else some of the slips below lead to the same number
    tau, tau_bar = draw.one_of(((1, -1), (1, -2), (2, -1), (-1, 1), (-1, 2)))
    side, size = w * kappa, 5
    rest = side**2 * tau
    h11 = (kappa_bar * (kappa * tau_bar - kappa_bar * tau) - rest) / size
    printed = (kappa_bar * (tau_bar - tau) - rest) / size
    twice = 2 * kappa * kappa_bar / size * tau_bar
    value = (h11 - twice) / (2 * size**2)
    return Number(
        question=rf"At a certain ruling $\kappa={kappa},\ \bar\kappa={kappa_bar},\ \tau={tau},\ "
        rf"\bar\tau={tau_bar}$ and $\kappa'=\bar\kappa'=0$. Compute the mean curvature $H$ at "
        rf"$w={w}$ with pencil and paper.",
        answer=value,
        label="H =",
        unit="1/length",
        slips=(
            known.mistaken_for(
                "h₁₁ as printed",
                (printed - twice) / (2 * size**2),
                r"This follows from $h_{11}$ as the paper prints it. Its first bracket should be "
                r"$\kappa\bar\tau+w\kappa'-\bar\kappa\tau$.",
            ),
            known.mistaken_for(
                "g₁₂ forgotten",
                h11 / (2 * size**2),
                r"This is $h_{11}/(2W^2)$. The lines of the parameters are not perpendicular, "
                r"$g_{12}=\bar\tau$: subtract $2h_{12}\bar\tau$.",
            ),
            known.mistaken_for(
                "sign of 2h₁₂τ̄",
                (h11 + twice) / (2 * size**2),
                r"$2h_{12}\bar\tau$ was added. It is subtracted.",
            ),
            known.mistaken_for(
                "sum for mean",
                2 * value,
                r"This is $k_1+k_2$. $H$ is the mean of the two: half of it.",
            ),
            known.mistaken_for(
                "W for W²",
                size * value,
                r"Divide by $2W^2$, twice the determinant of the first form, not by $2W$.",
            ),
        ),
        because=r"With $\kappa'=\bar\kappa'=0$ all of it is $H=-(\kappa\bar\kappa\bar\tau+\tau W^2)"
        r"/(2W^3)$.",
        hints=(
            r"First $W=\sqrt{\bar\kappa^2+w^2\kappa^2}$: it is a whole number.",
            r"Then $h_{12}=\kappa\bar\kappa/W$ and $h_{11}=\big(\bar\kappa(\kappa\bar\tau-"
            r"\bar\kappa\tau)-w\kappa\cdot w\kappa\tau\big)/W$.",
            rf"$W={size}$ and $h_{{11}}={h11:g}$; $H=(h_{{11}}-2h_{{12}}\bar\tau)/(2W^2)$.",
        ),
        solution=rf"$W={size}$, $h_{{12}}={kappa * kappa_bar / size:g}$, $h_{{11}}={h11:g}$, so "
        rf"$H=({h11:g}-({twice:g}))/{2 * size**2}={value:.5g}$.",
    )


# -- a formula -------------------------------------------------------------------------------------


def by_the_turn(draw: Draw) -> Formula:
    """Ask for K by the angle θ."""
    return Formula(
        question=r"Write the Gauss curvature by $a$, the angle $\theta$ that the tangent plane has "
        r"turned since the striction point, and $d$, the distribution parameter $\delta$. No $w$.",
        answer="-cos(a)**4/d**2",
        variables=("a", "d"),
        box=((-1.4, 1.4), (0.4, 2.0)),
        label="K =",
        slips=(
            known.formula(
                "cos² for cos⁴",
                "-cos(a)**2/d**2",
                r"$\delta^2+w^2=\delta^2/\cos^2\theta$ is squared in the denominator.",
                ("a", "d"),
                ((-1.4, 1.4), (0.4, 2.0)),
            ),
            known.formula(
                "sign of K",
                "cos(a)**4/d**2",
                "The size is right, and $K$ is never positive on a ruled surface.",
                ("a", "d"),
                ((-1.4, 1.4), (0.4, 2.0)),
            ),
            known.formula(
                "sin for cos",
                "-sin(a)**4/d**2",
                r"At the striction point $a=0$, and there $|K|$ is greatest; this would be 0.",
                ("a", "d"),
                ((-1.4, 1.4), (0.4, 2.0)),
            ),
        ),
        because="The two graphs of this lesson are one: the steeper the turn, the greater $|K|$.",
        hints=(
            r"Replace $w$ by $\delta\tan\theta$.",
            r"$1+\tan^2\theta=1/\cos^2\theta$.",
            r"So $\delta^2+w^2=\delta^2/\cos^2\theta$; put that into $K$.",
        ),
        solution=r"$\delta^2+w^2=\delta^2(1+\tan^2\theta)=\delta^2/\cos^2\theta$, so "
        r"$K=-\delta^2\cos^4\theta/\delta^4=-\cos^4\theta/\delta^2$.",
    )


# -- choose ----------------------------------------------------------------------------------------


def second_direction(draw: Draw) -> Choose:
    """Ask what the second asymptotic direction of a right helicoid is."""
    options = (
        Option(
            r"They are perpendicular, because there $H=0$",
            r"$\cot\alpha=-H/\sqrt{-K}$ for $\delta>0$: a right angle means $H=0$, and the other "
            "way round.",
            right=True,
        ),
        Option(
            "They are perpendicular on every ruled surface",
            "Try the hyperboloid: its asymptotic directions are its two families of rulings, and "
            "far out these cross at a small angle.",
            slip="asymptotic taken for principal",
        ),
        Option(
            "They coincide, because a helicoid is ruled",
            r"They coincide only where $K=0$. Here $K=-\delta^2/(\delta^2+w^2)^2$ is never 0.",
        ),
        Option(
            "There is only one, the ruling",
            r"$h_{11}\,dt^2+2h_{12}\,dt\,dw=0$ has two factors: $dt=0$ is the ruling, the other "
            r"is $h_{11}\,dt+2h_{12}\,dw=0$.",
        ),
    )
    return Choose(
        question="What can be said of the two asymptotic directions in a point of a right "
        "helicoid?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Look at the read-out of α while you move the point over the helicoid.",
            "And at H.",
            r"$\cot\alpha=-H/\sqrt{-K}$ for $\delta>0$.",
        ),
        solution="The ruling is one of them, the tangent of the helix through the point the other. "
        r"They are perpendicular everywhere because $H=0$ everywhere.",
    )


def torsal(draw: Draw) -> Choose:
    """Ask what happens along a torsal ruling."""
    options = (
        Option(
            r"$K=0$, and the tangent plane is one and the same, but for one point without any",
            r"$h_{12}=0$, so $K=0$; and in the striction point $\mathbf r_t\times\mathbf r_w=0$.",
            right=True,
        ),
        Option(
            r"$K\to-\infty$, because $K=-1/\delta^2$: the surface is infinitely sharp there",
            r"$-1/\delta^2$ is $K$ in the striction point only. For any other $w$ the numerator "
            r"of $-\delta^2/(\delta^2+w^2)^2$ wins.",
            slip="K = −1/δ² everywhere",
        ),
        Option(
            "the two ends of the ruling have different tangent planes, 180° apart",
            r"$\theta$ jumps from $-90°$ to $90°$, but that is one and the same plane.",
            slip="θ taken for the plane",
        ),
        Option(
            r"$K=0$ and $H=0$: along it the surface is flat like a plane",
            r"$K=0$, but $h_{11}$ need not vanish: a cone has torsal rulings only and is no plane.",
            slip="K = 0 taken for flat",
        ),
    )
    return Choose(
        question=r"What is true along a torsal ruling, $\delta=0$, of a surface?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Put $\bar\kappa=0$ into $\mathbf r_t=\bar\tau\mathbf x_1+w\kappa\mathbf x_2"
            r"+\bar\kappa\mathbf x_3$.",
            r"Plücker's conoid has one at $t=\frac18$.",
            "Move w along that ruling and look at K, at H and at the graph of θ.",
        ),
        solution=r"With $\bar\kappa=0$ the plane of $\mathbf r_t$ and $\mathbf r_w$ is that of "
        r"$\mathbf x_1,\mathbf x_2$ for every $w\neq0$, and $K=0$. At $w=0$ the two vectors are "
        "parallel and span nothing.",
    )


# -- sketch ----------------------------------------------------------------------------------------


def along(draw: Draw) -> Sketch:
    """Ask for K along a ruling."""
    delta, at = draw.one_of((0.1, 0.15, 0.2)), draw.one_of((0.4, 0.5, 0.6))

    def gauss(t: Array) -> Array:
        return np.asarray(-(delta**4) / (delta**2 + (t - at) ** 2) ** 2)

    return Sketch(
        question=r"You walk along a ruling, one unit of length in one unit of time $t$, and pass "
        rf"the striction point at $t={at:g}$. There $\delta={delta:g}$. Sketch $\delta^2K$ as you "
        "walk: the Gauss curvature in units of its greatest size.",
        curve=gauss,
        heights=(-1.2, 0.4),
        label="δ²K",
        because=r"A bell hanging down, about as wide as $\delta$.",
        hints=(
            r"What sign has $K$? Where is $|K|$ greatest?",
            rf"At $t={at:g}$ the curve is at $-1$, and at a distance $\delta={delta:g}$ from "
            r"there at $-\frac14$.",
            "It is alike on both sides, and never touches 0.",
        ),
        solution=r"$\delta^2K=-\delta^4/(\delta^2+w^2)^2$ with "
        rf"$w=t-{at:g}$: never positive, $-1$ at the striction point, alike on both sides, and "
        "soon near 0.",
    )


# -- Python ----------------------------------------------------------------------------------------


def in_python(draw: Draw) -> Code:
    """Ask for K at three places of a ruling."""
    t = draw.one_of((0.2, 0.3, 0.6, 0.7))
    places = np.array(draw.one_of(((-1.0, 0.0, 1.0), (-0.5, 0.0, 2.0), (0.0, 0.5, 1.0))))
    answer = surface("example_2").curvature(t, places)
    listed = ", ".join(f"{w:g}" for w in places)
    return Code(
        question=rf"Compute the Gauss curvature of Example 2 on the ruling $t={t:g}$ at "
        rf"$w={listed}$, as an array.",
        starter=f"from ruledlab.geometry import gallery\n\nw = [{listed}]\nvalue = ...",
        answer=answer.gauss,
        label="K =",
        unit="1/length²",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "H for K",
                answer.mean,
                "This is the mean curvature, <code>.mean</code>. The Gauss curvature is "
                "<code>.gauss</code>.",
            ),
            known.mistaken_for(
                "K = −1/δ² everywhere",
                np.full(3, -1 / float(surface("example_2").invariants(t).delta) ** 2),
                r"$-1/\delta^2$ is $K$ at $w=0$ only.",
            ),
        ),
        hints=(
            'gallery.surface("example_2") is the surface.',
            "surface.curvature(t, w) has .gauss and .mean.",
            f'gallery.surface("example_2").curvature({t:g}, w) is nearly all of it.',
        ),
        solution=f'<pre>value = gallery.surface("example_2").curvature({t:g}, w).gauss</pre>',
    )


# -- find the slip ---------------------------------------------------------------------------------


def turning(draw: Draw) -> FindSlip:
    """Ask for the slip in tan θ = δ/w."""
    return FindSlip(
        question="One of these lines on the tangent plane along a ruling is wrong.",
        lines=(
            Line(
                r"$\mathbf r_t=\bar\tau\,\mathbf x_1+w\kappa\,\mathbf x_2"
                r"+\bar\kappa\,\mathbf x_3$ and $\mathbf r_w=\mathbf x_1$",
                r"it is (9): $\mathbf m'+w\mathbf x'$ with "
                r"$\mathbf m'=\bar\tau\mathbf x_1+\bar\kappa\mathbf x_3$.",
            ),
            Line(
                r"So the tangent plane is spanned by $\mathbf x_1$ and "
                r"$w\kappa\,\mathbf x_2+\bar\kappa\,\mathbf x_3$.",
                r"the part of $\mathbf r_t$ along $\mathbf x_1$ spans nothing new.",
            ),
            Line(
                r"At $w=0$ it is the plane of $\mathbf x_1,\mathbf x_3$.",
                r"$w\kappa\,\mathbf x_2$ is gone, $\bar\kappa\,\mathbf x_3$ is left.",
            ),
            Line(r"It has turned from there by $\theta$ with $\tan\theta=\delta/w$."),
            Line(
                r"From $w\to-\infty$ to $w\to\infty$ it turns by 180°.",
                r"$\theta$ goes from $-90°$ to $90°$.",
            ),
        ),
        then=Formula(
            question=r"What is $\tan\theta$? Write $d$ for $\delta$.",
            solution="",
            answer="w/d",
            variables=("w", "d"),
            box=BOX,
            label="tan θ =",
            slips=(
                known.formula(
                    "tan θ = δ/w",
                    "d/w",
                    r"This is the line as it is printed. It has $\theta=90°$ at $w=0$, where "
                    r"$\theta$ begins with 0.",
                    ("w", "d"),
                    BOX,
                ),
                known.formula(
                    "product for quotient",
                    "w*d",
                    r"This is an area, and a tangent has no unit.",
                    ("w", "d"),
                    BOX,
                ),
            ),
            because=r"$w\kappa/\bar\kappa=w/\delta$.",
        ),
        hints=(
            r"How large should $\theta$ be at $w=0$?",
            r"$\tan\theta$ is the part along $\mathbf x_2$ over the part along $\mathbf x_3$.",
            r"These parts are $w\kappa$ and $\bar\kappa$.",
        ),
        solution=r"$\tan\theta=w\kappa/\bar\kappa=w/\delta$: 0 in the striction point. "
        r"$\delta/w$ would begin with 90° there.",
    )


def printed_form(draw: Draw) -> FindSlip:
    """Ask for the slip in h₁₁."""
    options = (
        Option(
            r"$W h_{11}=\bar\kappa(\kappa\bar\tau+w\kappa'-\bar\kappa\tau)"
            r"-w\kappa(w\kappa\tau+\bar\kappa')$",
            r"Now each term in the brackets has one length in it, and finite differences of "
            r"$\mathbf r$ give the same value.",
            right=True,
        ),
        Option(
            r"$W h_{11}=\bar\kappa(\bar\tau+w\kappa'-\tau)+w\kappa(w\kappa\tau+\bar\kappa')$",
            r"The signs were right, and the first bracket still adds $\bar\tau$, a length per "
            r"$t$, to $\tau$, an angle per $t$.",
        ),
        Option(
            r"$W h_{11}=\bar\kappa(\bar\kappa\bar\tau+w\kappa'-\kappa\tau)"
            r"-w\kappa(w\kappa\tau+\bar\kappa')$",
            r"Count lengths: $\bar\kappa\bar\tau$ has two, $w\kappa'$ one, $\kappa\tau$ none.",
            slip="κ and κ̄ exchanged",
        ),
    )
    return FindSlip(
        question=r"These lines are printed in §2.4 of the paper, with $W^2=(w\kappa)^2+"
        r"\bar\kappa^2$. One of them cannot be: count the units of length.",
        lines=(
            Line(r"$g_{11}=\bar\tau^2+(w\kappa)^2+\bar\kappa^2$", "all three are lengths squared."),
            Line(r"$W h_{12}=\bar\kappa\,\kappa$", r"$\langle\kappa\mathbf x_2,\mathbf n\rangle$."),
            Line(r"$W h_{11}=\bar\kappa(\bar\tau+w\kappa'-\tau)-w\kappa(w\kappa\tau+\bar\kappa')$"),
            Line(
                r"$K_G=-\bar\kappa^2\kappa^2/((w\kappa)^2+\bar\kappa^2)^2$",
                r"$-h_{12}^2/\det g$ with $\det g=W^2$.",
            ),
        ),
        then=Choose(
            question="What should stand there?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            r"$w,\ \bar\kappa,\ \bar\tau$ each contain one length, $\kappa$ and $\tau$ none.",
            "Terms that are added must have the same unit.",
            r"Compare $\bar\tau$ and $\tau$: they stand in one bracket.",
        ),
        solution=r"The first bracket has to be $\kappa\bar\tau+w\kappa'-\bar\kappa\tau$: one "
        r"length in each term. It follows from $\mathbf r_{tt}=\mathbf m''+w\mathbf x''$ and (4).",
    )


# -- design ----------------------------------------------------------------------------------------

START = Design(
    ((-0.9, 1.2), (-0.2, 1.9), (0.6, 1.2), (1.2, 1.8)), "0.5*u", "0.8", name="to be bent"
)


def to_order(draw: Draw) -> Drag:
    """Ask for a design with a given K in a striction point."""
    target = -draw.one_of((0.5, 1.0, 2.0, 3.0))

    def conditions(made: Made) -> tuple[Condition, ...]:
        text = f"$K={target:g}$ in the striction point of $t=0.5$"
        now = float(made.surface.curvature(0.5, 0.0).gauss)
        if not math.isfinite(now):
            return (Condition(text, math.nan, 0.05, now="there is no tangent plane"),)
        off = abs(now - target)
        return (Condition(text, off, 0.05 * abs(target), "1/length²", f"now $K={now:.3f}$"),)

    return Drag(
        question=rf"Change this design until $K={target:g}$ in the striction point of the ruling "
        r"$t=\frac12$, to within 5 %. Drag points, or change $\bar u$ and $\bar v$.",
        start=START,
        model=_scaled(1 / math.sqrt(-target)),
        conditions=conditions,
        fields=True,
        plots=("delta",),
        slips=_inverted(target),
        because=r"$K=-1/\delta^2$: you have made $|\delta|$ right.",
        hints=(
            r"In the striction point, $K=-1/\delta^2$. So which $\delta$ is wanted?",
            r"The plot shows $\delta$. If $\bar u$ and $\bar v$ are multiplied by a number, so is "
            r"$\delta$.",
            rf"You want $\delta(\tfrac12)=\pm{1 / math.sqrt(-target):.4g}$: that is its value now "
            r"times how much?",
        ),
        solution=rf"$\delta(\frac12)$ has to be $\pm{1 / math.sqrt(-target):.4g}$. The design "
        r"shown now is the one you began with, $\bar u$ and $\bar v$ multiplied by the right "
        r"number: all lengths grow alike, and $K$ goes with $1/\text{length}^2$.",
    )


def _inverted(target: float) -> tuple[Misconception, ...]:
    """Return the misconception δ = √|K|; where it is the same as the right one, there is none."""
    if target == -1.0:
        return ()
    wanted = math.sqrt(-target)
    return (
        Misconception(
            "δ inverted",
            lambda made: (
                abs(abs(float(made.surface.invariants(0.5).delta)) - wanted) < 0.02 * wanted
            ),
            r"Now $\delta^2=|K|$ is what was asked for. It is the other way round: "
            r"$|K|=1/\delta^2$, and a small $\delta$ makes a sharp fold.",
            _scaled(wanted),
        ),
    )


@functools.cache
def _scaled(delta: float) -> Design:
    """Return the start, its ū and v̄ multiplied until |δ(½)| is this."""
    factor = delta / abs(float(START.surface().invariants(0.5).delta))
    return START.with_(ubar=f"{0.5 * factor:.8g}*u", vbar=f"{0.8 * factor:.8g}")


EXERCISES = (
    Exercise("05.1", "In the striction point", deepest),
    Exercise("05.2", "Half as much", half_as_much),
    Exercise("05.3", "From plane to plane", between_planes),
    Exercise("05.4", "Curvature by the turn", by_the_turn),
    Exercise("05.5", "Two directions", second_direction),
    Exercise("05.6", "A torsal ruling", torsal),
    Exercise("05.7", "A walk along a ruling", along),
    Exercise("05.8", "Three lines of Python", in_python),
    Exercise("05.9", "Above or below", turning),
    Exercise("05.10", "Count the lengths", printed_form),
    Exercise("05.11", "Curvature to order", to_order),
    Exercise("05.12", "Mean curvature by hand", mean_by_hand),
)
"""The exercises in their order."""
