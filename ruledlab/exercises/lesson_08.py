"""Exercises of lesson 08: closed ruled surfaces, pitch and angle of pitch."""

from __future__ import annotations

import functools
import math

import numpy as np

from ..design import Design
from ..geometry import Line as SpaceLine
from ..geometry import gallery, steiner_angle
from ..geometry.checks import Array
from ..geometry.gallery import LOOP
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
from .designs import EXAMPLE_2, at_least, enlarged, has_pitch
from .tex import combination

__all__ = ["EXERCISES"]

TURN = 2 * math.pi


# -- λ and the area --------------------------------------------------------------------------------


def small_loop(draw: Draw) -> Number:
    """Ask for λ of a small simple loop from its area."""
    area = draw.one_of((0.02, 0.05, 0.08, 0.12))
    value = area - TURN
    return Number(
        question=rf"A small simple loop on the sphere closes with C² and encloses the area "
        rf"$A={area:g}$. It is run through anticlockwise, as seen from outside. How large is the "
        r"angle of pitch $\lambda$ of the ruled surfaces with this spherical image?",
        answer=value,
        label="λ =",
        unit="rad",
        tolerance=1e-4,
        slips=(
            known.torsion_sign(value),
            known.modulo_turn(value),
            known.mistaken_for(
                "2π of Gauss and Bonnet forgotten",
                -area,
                r"This is what one gets with $\oint\tau\,dt=A$. For a small loop the tangent turns "
                r"once round nearly as in the plane, so $\oint\tau\,dt$ is near $2\pi$: it is "
                r"$2\pi-A$.",
            ),
            known.degrees(value),
        ),
        because=r"Gauss and Bonnet: $\oint\tau\,dt=2\pi-A$.",
        hints=(
            r"$\tau\,dt$ is the geodesic curvature of the spherical image times its arc: Gauss and "
            "Bonnet know its integral.",
            r"$\oint\tau\,dt+A=2\pi$ for a simple loop that is run through anticlockwise.",
            r"$\lambda=-\oint\tau\,dt$.",
        ),
        solution=rf"$\oint\tau\,dt=2\pi-A$, so $\lambda=A-2\pi={value:.6f}$. "
        r"However small the loop, $\lambda$ is near $-2\pi$, not near $0$.",
    )


def backwards(draw: Draw) -> Choose:
    """Ask what running backwards does to l and λ."""
    options = (
        Option(
            r"both change their sign: $\lambda\to-\lambda$, $l\to-l$",
            r"$\mathbf x'$ changes its sign and $\mathbf x''$ does not: $\kappa$ stays, $\tau$ and "
            r"$\bar\tau$ change their sign, and the integrals with them.",
            right=True,
        ),
        Option(
            r"both stay: they are lengths and angles of the same surface",
            "The surface is the same, the way round is not: who walks the trajectory the other way "
            "comes back on the other side.",
            slip="pitch taken for a size without sign",
        ),
        Option(
            r"$l\to-l$, but $\lambda$ stays",
            r"Both are parts of one dual number, $\Lambda=-\oint\hat\tau\,dt$; what is done to "
            "the way round is done to both.",
        ),
        Option(
            r"$\lambda\to2\pi-\lambda$, $l\to-l$",
            r"Modulo $2\pi$ this is $-\lambda$, but the integral has no reason to gain a turn.",
            slip="λ modulo 2π",
        ),
    )
    return Choose(
        question=r"The same closed surface is run through backwards, "
        r"$\mathbf Y(t)=\mathbf X(1-t)$: the same oriented rulings in the other order. What "
        r"happens to $\lambda$ and $l$?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Think of the orthogonal trajectory: where does it end when it is walked backwards?",
            r"$l=-\oint\langle\mathbf c',\mathbf x\rangle\,dt$, and $\mathbf c'$ changes its sign.",
        ),
        solution=r"$\langle\mathbf c',\mathbf x\rangle$ changes its sign, so $l$ does. "
        r"The angle $\varphi$ runs back by as much as it ran forward, so $\lambda$ does. Both at "
        r"once: $\Lambda\to-\Lambda$.",
    )


# -- the seam --------------------------------------------------------------------------------------


def seam(draw: Draw) -> Choose:
    """Ask how three given points close a curve."""
    short, long = draw.one_of(((1, 2), (1, 3), (2, 3)))
    up = draw.one_of((1, -1))
    points = (
        rf"$\mathbf p_{{n-1}}=\tfrac\pi{{16}}(6,{8 - up * long})$, "
        rf"$\mathbf p_0=\mathbf p_n=\tfrac\pi{{16}}(6,8)$, "
        rf"$\mathbf p_1=\tfrac\pi{{16}}(6,{8 + up * short})$"
    )
    options = (
        Option(
            r"$\mathbf X$ passes without a jump, and so does its direction of motion; "
            r"$\mathbf X'$ jumps in size: C⁰, with a common tangent",
            rf"The legs have the lengths {long} and {short}: the velocities are parallel and of "
            rf"different size.",
            right=True,
        ),
        Option(
            r"$\mathbf X'$ passes without a jump, as the three points are collinear: C¹",
            r"Collinear points make the velocities $n(\mathbf p_1-\mathbf p_0)$ and "
            r"$n(\mathbf p_n-\mathbf p_{n-1})$ parallel. Equal they are only if the legs are.",
            slip="collinear taken for C¹",
        ),
        Option(
            r"there is a corner: the tangent jumps in direction",
            "All three points lie on one line and in this order: the tangent keeps its direction.",
        ),
        Option(
            r"$\mathbf X$ itself jumps: the surface does not close",
            r"$\mathbf p_n=\mathbf p_0$, and $\bar u,\bar v$ are functions of $u,v$ here: the last "
            "ruling is the first.",
        ),
    )
    return Choose(
        question=f"A design, with $\\bar u=u-v$ and $\\bar v=u+v$, has the points {points}. What "
        "happens at its seam?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Which two legs meet at the seam, and how long are they?",
            r"$\mathbf b'(0)=n(\mathbf p_1-\mathbf p_0)$, "
            r"$\mathbf b'(1)=n(\mathbf p_n-\mathbf p_{n-1})$.",
        ),
        solution=rf"The velocities are $n\tfrac\pi{{16}}(0,{up * short})$ after and "
        rf"$n\tfrac\pi{{16}}(0,{up * long})$ before the seam: parallel, not equal. That is G¹ for "
        "the curve, and C⁰ for the moving line.",
    )


def moebius(draw: Draw) -> Choose:
    """Ask why a Möbius band has no λ."""
    options = (
        Option(
            "after one turn the line is the same, but its orientation and its frame are not; "
            r"there is nothing that $\xi$ and the trajectory could be compared with",
            r"$\mathbf X(1)=-\mathbf X(0)$. After a second turn it is the same oriented line, and "
            "then everything gained in the first is undone.",
            right=True,
        ),
        Option(
            r"it has one, but $\tau$ is undefined at the seam",
            r"$\tau$ is defined everywhere; this seam even closes with C².",
        ),
        Option(
            r"the surface does not close",
            "It does, as a surface: the last ruling covers the first.",
            slip="closed taken for closed with orientation",
        ),
        Option(
            r"it is zero, because the band is one-sided",
            r"Over one turn $-\int\tau\,dt$ is zero for this band, because it is symmetric; with "
            "another curve from a line to the same line reversed it is not. It is a number that "
            "belongs to the way. Over two turns the sum is always zero.",
            slip="a zero taken for an angle of pitch",
        ),
    )
    return Choose(
        question="In the gallery stands a Möbius band whose rulings go once round a circle while "
        r"making half a turn. Why does it have no angle of pitch $\lambda$?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Choose it in the app above. What is written under the picture?",
            r"What is $\mathbf X(1)$, compared with $\mathbf X(0)$?",
        ),
        solution=r"$\mathbf X(1)=-\mathbf X(0)$: the line comes back reversed. $\lambda$ and $l$ "
        "belong to motions that bring an oriented line back to itself; this one does so after two "
        "turns, and the second undoes the first.",
    )


# -- the pitch -------------------------------------------------------------------------------------


def hyperboloid(draw: Draw) -> Number:
    """Ask for the pitch of a hyperboloid of one sheet."""
    waist, part = draw.one_of((1, 2, 3)), draw.one_of((3, 6))
    value = TURN * waist * math.sin(math.pi / part)
    return Number(
        question=rf"A hyperboloid of one sheet: $u=t$, $v=\tfrac\pi{{{part}}}$, $\bar u=0$, "
        rf"$\bar v={waist}$, with $t$ once from $0$ to $2\pi$. How large is its pitch $l$?",
        answer=value,
        label="l =",
        unit="length",
        slips=(
            known.pitch_sign(value),
            known.mistaken_for(
                "length of the waist",
                TURN * waist,
                r"This is the length of the waist circle, the way of the foot point. Only its part "
                r"along the ruling counts: $\langle\mathbf c',\mathbf x\rangle$.",
            ),
            known.mistaken_for(
                "cosine for sine",
                TURN * waist * math.cos(math.pi / part),
                r"This is the part of the waist circle at right angles to the ruling. $v$ is "
                r"counted from the axis: a ruling makes the angle $\tfrac\pi2-v$ with the circle.",
            ),
        ),
        because="The waist circle and the rulings make the same angle everywhere.",
        hints=(
            r"$l=-\oint\langle\mathbf c',\mathbf x\rangle\,dt$ and "
            r"$\langle\mathbf c',\mathbf x\rangle=\sin v\,(\bar u v'-\bar v u')$.",
            r"Here $u'=1$ and $v'=0$, so the integrand is a constant.",
        ),
        solution=rf"$\langle\mathbf c',\mathbf x\rangle=-{waist}\sin\tfrac\pi{{{part}}}$, so "
        rf"$l=2\pi\cdot{waist}\cdot\sin\tfrac\pi{{{part}}}={value:.6f}$.",
    )


def walk(draw: Draw) -> Formula:
    """Ask for the orthogonal trajectory of horizontal rulings."""
    a, b, n = draw.integer(1, 3), draw.integer(1, 3), draw.integer(1, 3)
    turn = "t" if n == 1 else f"{n}t"
    part = f"{b}" if n == 1 else rf"\tfrac{{{b}}}{{{n}}}"
    inner = known.formula(
        "inner derivative forgotten",
        f"{a}*t + {b}*sin({n}*t)",
        rf"Nearly. Differentiate it: $\sin {turn}$ brings a factor ${n}$, which the integral "
        "has to take away.",
        ("t",),
        ((0.1, 6.0),),
    )
    return Formula(
        question=r"All rulings are horizontal: $u=t$, $v=\tfrac\pi2$, $\bar u=0$ and "
        rf"$\bar v={a}+{b}\cos {turn}$ along the curve. An orthogonal trajectory starts in the "
        r"foot point $\mathbf c(0)$. How far from the foot point, along $\mathbf x$, is it at $t$?",
        answer=f"{a}*t + {b}*sin({n}*t)/{n}",
        variables=("t",),
        box=((0.1, 6.0),),
        label="w(t) =",
        slips=(
            known.formula(
                "sign of (24)",
                f"-({a}*t + {b}*sin({n}*t)/{n})",
                r"This is $+\int\langle\mathbf c',\mathbf x\rangle\,dt$: the foot point runs "
                r"back, against $\mathbf x$, and who stays at right angles moves forward by as "
                "much.",
                ("t",),
                ((0.1, 6.0),),
            ),
            *([inner] if n > 1 else []),
            known.formula(
                "rate taken for the distance",
                f"{a} + {b}*cos({n}*t)",
                r"This is $w'=\bar v$, how fast the trajectory moves along the rulings; the "
                "distance is its integral from 0.",
                ("t",),
                ((0.1, 6.0),),
            ),
        ),
        because=rf"After one turn $l=2\pi\cdot{a}$: the wave adds nothing.",
        hints=(
            r"Let $\mathbf p=\mathbf c+w\,\mathbf x$ and demand "
            r"$\langle\mathbf p',\mathbf x\rangle=0$.",
            r"$w'=-\langle\mathbf c',\mathbf x\rangle=-\sin v\,(\bar u v'-\bar v u')$.",
        ),
        solution=rf"$w'=\bar v$, so $w={a}t+{part}\sin {turn}$, and "
        rf"$l=2\pi\cdot{a}$.",
    )


def no_pitch(draw: Draw) -> Drag:
    """Ask for a loop without pitch that is not a small one."""
    length = draw.one_of((1.0, 1.1, 1.2))

    def conditions(made: Made) -> tuple[Condition, ...]:
        text = rf"the loop on the sphere is at least ${length:g}$ long"
        return has_pitch(made), at_least(text, _length(made), length)

    return Drag(
        question=r"Drag this closed design until its pitch is zero, $|l|\le0.02$, without making "
        rf"it small: the loop on the sphere, $\oint\kappa\,dt$, shall stay at least ${length:g}$ "
        r"long. $\bar u=u-v$ and $\bar v=u+v$ stay as they are.",
        start=EXAMPLE_2,
        model=_without_pitch(),
        conditions=conditions,
        slips=(
            Misconception(
                "pitch made small with the loop",
                lambda made: has_pitch(made).met and _length(made) < length,
                "The pitch is zero nearly, because the loop encloses nearly nothing. Find a place "
                "where the flux through one part makes up for that through another.",
                enlarged(EXAMPLE_2, 0.12),
            ),
        ),
        because="Two parts of the region send the same flux in opposite directions.",
        hints=(
            r"$l=\iint(\bar u_u+\bar v_v+\bar v\cot v)\,dA$. Where is this divergence negative?",
            r"$2+(u+v)\cot v<0$ needs $v>\tfrac\pi2$: the southern half of the sphere. Or let the "
            "curve cross itself, so that one part is encircled the other way.",
            r"Move all points down together, to $v$ near $2.2$.",
        ),
        solution="One of many such designs is shown in the chart now: Example 2, moved to the "
        r"south until the flux is zero. A figure of eight does it too.",
    )


def _length(made: Made) -> float:
    return float(made.surface.arc_lengths().kappa)


@functools.cache
def _without_pitch() -> Design:
    """Return Example 2 moved to the south until l = 0, by the secant rule."""
    a, b = 1.3, 1.5
    for _ in range(5):
        low, high = (_moved(shift).surface().pitch() for shift in (a, b))
        a, b = b, b - high * (b - a) / (high - low)
        if abs(b - a) < 1e-12:
            break
    return _moved(b)


def _moved(shift: float) -> Design:
    return EXAMPLE_2.with_(points=tuple((u, v + shift) for u, v in LOOP))


def trajectory_slip(draw: Draw) -> FindSlip:
    """Ask for the slip on the way to (24)."""
    options = (
        Option(
            r"$l_{\mathbf X_1}=-\oint\sin v\,(\bar u v'-\bar v u')\,dt$",
            "The gap is the integral of $w'$, with its minus sign, as in (10).",
            right=True,
        ),
        Option(
            r"$l_{\mathbf X_1}=\oint\sin v\,(\bar u u'-\bar v v')\,dt$",
            r"$\langle\mathbf c',\mathbf x\rangle$ in the third line is right as it stands.",
        ),
        Option(
            r"$l_{\mathbf X_1}=\oint|\sin v\,(\bar u v'-\bar v u')|\,dt$",
            "A pitch has a sign: it says on which side the trajectory comes back.",
            slip="pitch taken for a size without sign",
        ),
    )
    return FindSlip(
        question="These lines lead from the orthogonal trajectory to the pitch in the chart. One "
        "of them is printed with a slip in the paper. Which?",
        lines=(
            Line(
                r"$\mathbf p=\mathbf c+w\,\mathbf x$ with "
                r"$\langle\mathbf p',\mathbf x\rangle=0$",
                "this is what an orthogonal trajectory is.",
            ),
            Line(
                r"$w'=-\langle\mathbf c',\mathbf x\rangle$",
                r"$\langle\mathbf p',\mathbf x\rangle=\langle\mathbf c',\mathbf x\rangle+w'$, as "
                r"$\mathbf x$ has length 1 and $\langle\mathbf x',\mathbf x\rangle=0$.",
            ),
            Line(
                r"$\langle\mathbf c',\mathbf x\rangle=\sin v\,(\bar u v'-\bar v u')$",
                r"with $\mathbf c=\mathbf x\times\bar{\mathbf x}$ it is the determinant "
                r"$[\mathbf x,\mathbf x',\bar{\mathbf x}]$, and "
                r"$[\mathbf x,\mathbf x_u,\mathbf x_v]=-\sin v$.",
            ),
            Line(r"$l_{\mathbf X_1}=\oint\sin v\,(\bar u v'-\bar v u')\,dt$"),
        ),
        then=Choose(
            question="What should stand there?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            "Each line follows from the one before it, except one.",
            "Compare the signs of the second and the last line.",
        ),
        solution=r"(24) has lost the minus sign of (10): "
        r"$l=\oint w'\,dt=-\oint\sin v\,(\bar u v'-\bar v u')\,dt$.",
    )


def walk_drawn(draw: Draw) -> Sketch:
    """Ask for the walk over one turn, which does not come back to where it began."""
    swing, steady = draw.one_of(((2, 0.5), (3, 0.5), (4, 1.0)))
    side = draw.one_of((1, -1))

    def walked(t: Array) -> Array:
        return np.asarray(side * (swing * (1 - np.cos(TURN * t)) - steady * TURN * t))

    wave, constant = side * swing, -side * steady
    vbar, pitch = (
        combination((wave, r"\sin u"), (constant, "")),
        combination((2 * constant, r"\pi")),
    )
    halfway = f"{2 * wave + constant * math.pi:.1f}"
    total = combination((wave, r"(1-\cos2\pi t)"), (2 * constant, r"\pi t"))
    return Sketch(
        question=r"All rulings are horizontal, $u=2\pi t$ and $v=\tfrac\pi2$. Their heights "
        rf"swing, $\bar u=\sin2u$, and $\bar v={vbar}$. A walker starts in the foot point "
        r"$\mathbf c(0)$ and crosses every ruling at a right angle, "
        r"$\mathbf p=\mathbf c+w\,\mathbf x$. Sketch $w$ over one turn.",
        curve=walked,
        heights=(-2.2 * swing, 2.2 * swing),
        label="w",
        because=rf"The surface closes, the walk does not: $w(1)=l={pitch}$.",
        hints=(
            r"$w'=-\langle\mathbf c',\mathbf x\rangle=-\sin v\,(\bar u v'-\bar v u')$. What is "
            "left of it here?",
            r"$w'=2\pi\bar v$: the heights do not count, as they are at right angles to the "
            r"rulings. So $w$ rises where $\bar v>0$ and falls where $\bar v<0$.",
            r"In a whole turn the wave adds nothing, and the constant adds $2\pi$ times itself: "
            rf"$w(1)={pitch}$. Halfway it is $w(\tfrac12)\approx{halfway}$.",
        ),
        solution=rf"$w'=2\pi\bar v$, so $w={total}$. It turns where $\bar v=0$, just after the "
        r"start and shortly before $t=\tfrac12$, and ends on the other side of its start, at "
        rf"$l={pitch}$.",
    )


# -- lines that are carried along ------------------------------------------------------------------


def carried_pitch(draw: Draw) -> Number:
    """Ask for the pitch of a line through the striction point, from Steiner's vector."""
    tau_bar, kappa_bar = draw.one_of(((0.5, 2.0), (1.0, 2.5), (3.0, 1.0), (1.5, 2.5)))
    cosine, sine, name = draw.one_of(((0.6, 0.8, "0.6, 0, 0.8"), (0.8, 0.6, "0.8, 0, 0.6")))
    value = -(tau_bar * cosine + kappa_bar * sine)
    return Number(
        question=rf"For some closed surface $\oint\bar\tau\,dt={tau_bar:g}$ and "
        rf"$\oint\bar\kappa\,dt={kappa_bar:g}$. The frame carries a line along that passes through "
        rf"the striction point and has the fixed components $({name})$ along "
        r"$\mathbf x_1,\mathbf x_2,\mathbf x_3$. How large is the pitch of the surface that it "
        "sweeps?",
        answer=value,
        label="l =",
        unit="length",
        slips=(
            known.pitch_sign(value),
            known.mistaken_for(
                "only the part along x₁",
                -tau_bar * cosine,
                r"$\mathbf x_3$ has a pitch of its own, $-\oint\bar\kappa\,dt$, and this line has "
                "a part along it.",
            ),
            known.mistaken_for(
                "τ̄ and κ̄ exchanged",
                -(kappa_bar * cosine + tau_bar * sine),
                r"$\oint\bar\tau\,dt$ stands with $\mathbf X_1$ and $\oint\bar\kappa\,dt$ with "
                r"$\mathbf X_3$: $\hat{\mathbf D}=\oint(\hat\tau\mathbf X_1+\hat\kappa"
                r"\mathbf X_3)\,dt$.",
            ),
        ),
        hints=(
            r"$\Lambda_{\mathbf Y}=-\langle\hat{\mathbf D},\mathbf Y\rangle$ with Steiner's vector "
            r"$\hat{\mathbf D}=\oint(\hat\tau\mathbf X_1+\hat\kappa\mathbf X_3)\,dt$.",
            r"Through the striction point the moment is zero, so the dual part is only "
            r"$-\langle\bar{\mathbf d},\mathbf y\rangle$.",
        ),
        solution=rf"$l=-({tau_bar:g}\cdot{cosine:g}+{kappa_bar:g}\cdot{sine:g})={value:g}$.",
    )


def lambda_of_gallery(draw: Draw) -> Code:
    """Ask for Λ of a surface of the gallery."""
    key = draw.one_of(("orchid", "crown", "tower", "twisted_ring"))
    total = gallery.surface(key).dual_angle_of_pitch()
    turn, shift = float(total.real), float(total.dual)
    return Code(
        question=rf"Compute the dual angle of pitch $\Lambda=\lambda+\varepsilon l$ of the gallery "
        rf"surface <code>{key}</code>. Give the dual number itself, or $[\lambda,l]$.",
        starter=f'from ruledlab.geometry import gallery\n\nsurface = gallery.surface("{key}")\n'
        "value = ...",
        answer=[turn, shift],
        label="Λ =",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "sign of (24)",
                [turn, -shift],
                r"$\lambda$ is right; the pitch has the sign printed in (24).",
            ),
            known.mistaken_for(
                "λ modulo 2π",
                [turn % TURN, shift],
                r"$l$ is right; $\lambda$ is right modulo $2\pi$ only. The integral counts turns.",
            ),
        ),
        hints=(
            "A surface has .pitch(), .angle_of_pitch() and .dual_angle_of_pitch().",
            "The last one gives both at once.",
        ),
        solution="<pre>value = surface.dual_angle_of_pitch()</pre>"
        rf"$\lambda={turn:.6f}$, $l={shift:.6f}$.",
    )


def carried_line(draw: Draw) -> Code:
    """Ask for the pitch of a line that the frame of Example 2 carries, off the striction point."""
    off = draw.one_of((1, 2, 3))
    surface = gallery.surface("example_2")
    line = SpaceLine.from_point_direction((0.0, float(off), 0.0), (0.0, 0.0, 1.0))
    value = float(steiner_angle(surface, line).dual)
    through = -surface.arc_lengths().kappa_bar
    return Code(
        question=r"The frame of Example 2 carries a line along that is parallel to $\mathbf x_3$ "
        rf"and passes through the point $\mathbf m+{off}\,\mathbf x_2$. Compute the pitch of the "
        "surface that it sweeps.",
        starter="from ruledlab import Line\n"
        "from ruledlab.geometry import carried, gallery, steiner_angle\n\n"
        f"line = Line.from_point_direction((0, {off}, 0), (0, 0, 1))\n"
        "value = ...",
        answer=value,
        label="l =",
        unit="length",
        tolerance=1e-6,
        slips=(
            known.pitch_sign(value),
            known.mistaken_for(
                "line through the striction point",
                through,
                r"This is the pitch of $\mathbf X_3$ itself. A line beside it has a moment, and "
                r"with it a part of $\oint\tau\,dt$.",
            ),
        ),
        hints=(
            "There are two ways: let the line sweep its surface and ask for the pitch, or ask "
            "Steiner's vector.",
            "carried(surface, line).pitch(), or steiner_angle(surface, line).dual.",
        ),
        solution='<pre>value = steiner_angle(gallery.surface("example_2"), line).dual</pre>'
        rf"$l={value:.6f}$; carried(…).pitch() gives the same.",
    )


EXERCISES = (
    Exercise("08.1", "A small loop", small_loop),
    Exercise("08.2", "The other way round", backwards),
    Exercise("08.3", "What jumps at the seam", seam),
    Exercise("08.4", "No pitch, and not small", no_pitch),
    Exercise("08.5", "The pitch of a hyperboloid", hyperboloid),
    Exercise("08.6", "Walking at right angles", walk),
    Exercise("08.7", "A sign on the way", trajectory_slip),
    Exercise("08.8", "Why no λ?", moebius),
    Exercise("08.9", "A line in the frame", carried_pitch),
    Exercise("08.10", "Λ in a line of Python", lambda_of_gallery),
    Exercise("08.11", "A line beside the frame", carried_line),
    Exercise("08.12", "The walk, drawn", walk_drawn),
)
"""The exercises in their order."""
