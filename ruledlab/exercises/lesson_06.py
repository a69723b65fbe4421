"""Exercises of lesson 06: Example 2 and designing ruled surfaces by control points."""

from __future__ import annotations

import functools
import math

import numpy as np

from ..design import Design
from ..geometry.checks import Array
from ..geometry.gallery import LOOP
from ..geometry.surface import RuledSurface
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
from .tex import times

__all__ = ["EXERCISES"]

EIGHTH = math.pi / 8


def _example_2(scale: float = 1.0) -> RuledSurface:
    """Return Example 2 with its ū and v̄ multiplied by a number."""
    return EXAMPLE_2.with_(ubar=f"{scale:g}*(u - v)", vbar=f"{scale:g}*(u + v)").surface()


# -- choose ----------------------------------------------------------------------------------------


def seam(draw: Draw) -> Choose:
    """Ask what three points on one line give."""
    options = (
        Option(
            "C⁰ only: the curve has a corner there",
            "There is no corner: both legs point the same way, so the tangent does not jump.",
        ),
        Option(
            "a common tangent, but in general a jump of the speed",
            r"Both legs give the direction, $n(\mathbf p_1-\mathbf p_0)$ and "
            r"$n(\mathbf p_0-\mathbf p_{n-1})$ the velocities. On one line they are parallel, and "
            "only equal legs make them equal. Geometers call this G¹.",
            right=True,
        ),
        Option(
            "C¹: the velocity is the same on both sides",
            r"Only if the legs are equal: the velocities are $n(\mathbf p_1-\mathbf p_0)$ and "
            r"$n(\mathbf p_0-\mathbf p_{n-1})$. Collinear points make them parallel, not equal.",
            slip="collinear taken for C¹",
        ),
        Option(
            r"C²: $\tau$ passes the seam without a jump",
            r"$\tau$ needs second derivatives, and these depend on $\mathbf p_2$ and "
            r"$\mathbf p_{n-2}$ too.",
        ),
    )
    return Choose(
        question=r"A Bézier curve in the chart closes, $\mathbf p_n=\mathbf p_0$, and the points "
        r"$\mathbf p_{n-1},\ \mathbf p_0,\ \mathbf p_1$ lie on one line, in this order. What does "
        "that give at the seam?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "What is the velocity of a Bézier curve at its two ends?",
            r"$\mathbf b'(0)=n(\mathbf p_1-\mathbf p_0)$ and "
            r"$\mathbf b'(1)=n(\mathbf p_n-\mathbf p_{n-1})$.",
        ),
        solution=r"The velocities on both sides are $n(\mathbf p_1-\mathbf p_0)$ and "
        r"$n(\mathbf p_0-\mathbf p_{n-1})$. Collinear points make them parallel: a common tangent. "
        "They are equal, C¹, only if the two legs have the same length.",
    )


def dual_part(draw: Draw) -> Choose:
    """Ask what a change of ū and v̄ leaves as it is."""
    options = (
        Option(
            r"$\kappa,\ \tau$ and $\lambda$",
            r"They belong to the spherical image $\mathbf x(t)$, which does not contain "
            r"$\bar u,\bar v$.",
            right=True,
        ),
        Option(
            r"$\delta$ and $\sigma$",
            r"$\delta=\bar\kappa/\kappa$ and $\sigma$ both contain dual parts; they change.",
        ),
        Option(
            r"$l$ and $\lambda$",
            r"$\lambda=-\oint\tau\,dt$ stays, but the pitch "
            r"$l=-\oint\bar\tau\,dt$ is its dual part.",
        ),
        Option(
            r"$\kappa$ and $\bar\kappa$",
            r"$\kappa$ stays; $\bar\kappa$ is the dual part of $\hat\kappa$ and changes.",
        ),
    )
    return Choose(
        question=r"You keep all control points of Example 2 and choose other functions "
        r"$\bar u(u,v),\ \bar v(u,v)$. Which of these stay exactly as they are?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Which of them can be computed from $\mathbf x(t)$ alone?",
            r"$\bar u$ and $\bar v$ enter only $\bar{\mathbf x}=\bar u\,\mathbf x_u"
            r"+\bar v\,\mathbf x_v$.",
        ),
        solution=r"$\kappa=\|\mathbf x'\|$ and $\tau$ are computed from the spherical image alone, "
        r"and so is $\lambda=-\oint\tau\,dt$. Every quantity with a bar, and with it $\delta$, "
        r"$\sigma$ and $l$, contains $\bar u$ and $\bar v$.",
    )


# -- predict a number ------------------------------------------------------------------------------


def speed(draw: Draw) -> Number:
    """Ask for κ at the beginning of a Bézier curve."""
    degree = draw.integer(3, 6)
    across, down = draw.one_of(((1, 0), (2, 0), (1, 1), (2, 1)))
    height = draw.one_of((2, 3, 5, 6))
    sine, cosine = math.sin(height * EIGHTH), float(down)
    legs = EIGHTH * math.hypot(across * sine, cosine)
    value = degree * legs
    start = rf"\tfrac\pi8(1,{height})"
    following = rf"\tfrac\pi8({1 + across},{height + down})"
    return Number(
        question=rf"A Bézier curve of degree $n={degree}$ in the chart begins with "
        rf"$\mathbf p_0={start}$ and $\mathbf p_1={following}$. How large is $\kappa(0)$?",
        answer=value,
        label="κ(0) =",
        unit="rad per t",
        slips=(
            known.mistaken_for(
                "degree forgotten",
                legs,
                r"The velocity at the start is $n(\mathbf p_1-\mathbf p_0)$; the degree $n$ is "
                "missing.",
            ),
            known.mistaken_for(
                "sin v forgotten",
                degree * EIGHTH * math.hypot(across, down),
                r"This is the speed in the chart. On the sphere a step $du$ is worth only "
                r"$\sin v\,du$.",
            ),
            known.degrees(value),
        ),
        because=r"$\kappa(0)=n\sqrt{\Delta u^2\sin^2 v+\Delta v^2}$.",
        hints=(
            r"$\kappa^2=u'^2\sin^2 v+v'^2$, and $u',v'$ at $t=0$ come from the first leg.",
            r"$(u',v')=n(\mathbf p_1-\mathbf p_0)$.",
            rf"$u'={degree}\cdot{across}\cdot\tfrac\pi8$, $v'={degree}\cdot{down}\cdot\tfrac\pi8$, "
            rf"$v={height}\cdot\tfrac\pi8$.",
        ),
        solution=rf"$\kappa(0)={degree}\cdot\tfrac\pi8\sqrt{{{across}^2\sin^2\tfrac{{{height}\pi}}8"
        rf"+{down}^2}}={value:.6f}$.",
    )


def moment(draw: Draw) -> Number:
    """Ask for the moment of a horizontal line."""
    quarter, ubar, vbar = draw.integer(0, 3), draw.integer(1, 4), draw.integer(1, 4)
    cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
    value = np.array([-sine * ubar, cosine * ubar, -vbar], dtype=float)
    place = ("0", r"\tfrac\pi2", r"\pi", r"\tfrac{3\pi}2")[quarter]
    return Number(
        question=rf"At some $t$ the chart gives $u={place}$ and $v=\tfrac\pi2$, and there "
        rf"$\bar u={ubar}$, $\bar v={vbar}$. Which moment $\bar{{\mathbf x}}$ has the line?",
        answer=value,
        label="x̄ =",
        unit="length",
        slips=(
            known.moment_sign(value),
            known.mistaken_for(
                "v̄ upwards",
                value * np.array([1.0, 1.0, -1.0]),
                r"$\mathbf x_v=(\cos u\cos v,\sin u\cos v,-\sin v)$: growing $v$ leads down.",
            ),
        ),
        hints=(
            r"$\bar{\mathbf x}=\bar u\,\mathbf x_u+\bar v\,\mathbf x_v$.",
            r"At $v=\tfrac\pi2$: $\mathbf x_u=(-\sin u,\cos u,0)$, $\mathbf x_v=(0,0,-1)$.",
        ),
        solution=r"$\bar{\mathbf x}=\bar u\,\mathbf x_u+\bar v\,\mathbf x_v="
        rf"({value[0]:g},\,{value[1]:g},\,{value[2]:g})$.",
    )


def angle_of_pitch(draw: Draw) -> Number:
    """Ask for λ of Example 2, from the area or from the lab."""
    value = _example_2().angle_of_pitch()
    return Number(
        question=r"Example 2 encloses the area $A=0.1672475$ on the sphere and goes round no "
        r"pole. Its loop is simple, so $\oint\tau\,dt=2\pi-A$. How large is its angle of pitch "
        r"$\lambda$?",
        answer=value,
        label="λ =",
        unit="rad",
        tolerance=1e-4,
        slips=(known.torsion_sign(value), known.modulo_turn(value), known.degrees(value)),
        hints=(r"$\lambda=-\oint\tau\,dt$.", r"A formula will do: write 2*pi with the area."),
        solution=r"$\lambda=-\oint\tau\,dt=-(2\pi-A)=-6.115938$. Modulo $2\pi$ it is the area.",
    )


# -- a formula -------------------------------------------------------------------------------------


def bezier(draw: Draw) -> Formula:
    """Ask for a quadratic Bézier curve by its control points."""
    a, b = draw.integer(1, 4), draw.integer(5, 8)
    if draw.integer(0, 1):
        a, b = b, a
    if b == 2 * a:  # then the curve would be the straight line of a slip
        b += 1
    return Formula(
        question=f"A Bézier curve of degree 2 has the longitudes $0,\\ {a},\\ {b}$ at its three "
        "control points. Write $u(t)$.",
        answer=f"2*{a}*t*(1 - t) + {b}*t**2",
        variables=("t",),
        box=((0.0, 1.0),),
        label="u(t) =",
        slips=(
            known.formula(
                "binomial coefficient forgotten",
                f"{a}*t*(1 - t) + {b}*t**2",
                r"The middle point has the weight $2\,t(1-t)$; otherwise the three weights do not "
                "add up to one.",
                ("t",),
                ((0.0, 1.0),),
            ),
            known.formula(
                "polygon for curve",
                f"{b}*t",
                "This is the straight line from the first point to the last; the middle point "
                "pulls the curve.",
                ("t",),
                ((0.0, 1.0),),
            ),
        ),
        hints=(
            r"$\mathbf b(t)=\sum_i\binom ni(1-t)^{n-i}t^i\,\mathbf p_i$ with $n=2$.",
            r"The weights are $(1-t)^2$, $2t(1-t)$ and $t^2$.",
        ),
        solution=f"$u(t)=2\\cdot{a}\\,t(1-t)+{b}\\,t^2$.",
    )


def divergence(draw: Draw) -> Formula:
    """Ask for the divergence whose flux is the pitch."""
    a, b = draw.integer(1, 3), draw.integer(1, 3)
    return Formula(
        question=r"The pitch of a closed design is, up to sign, the flux of the divergence of "
        r"$(\bar u,\bar v)$ through the loop on the sphere. Write this divergence for "
        rf"$\bar u={times(a)}u-v$, $\bar v=u+{times(b)}v$.",
        answer=f"{a} + {b} + (u + {b}*v)*cos(v)/sin(v)",
        label="divergence =",
        slips=(
            known.formula(
                "flat divergence",
                f"{a} + {b}",
                r"This is the divergence in the plane chart. On the sphere the circles of latitude "
                r"have the length $2\pi\sin v$, which adds $\bar v\cot v$.",
            ),
            known.formula(
                "cot v with ū",
                f"{a} + {b} + ({a}*u - v)*cos(v)/sin(v)",
                r"$\cot v$ belongs to $\bar v$: who goes south meets circles of latitude of "
                r"another length; along one of them, with $\bar u$, nothing changes.",
            ),
        ),
        hints=(
            "On the sphere a term is added to the divergence in the plane chart.",
            r"$\bar u_u+\bar v_v+\bar v\cot v$.",
        ),
        solution=rf"$\bar u_u+\bar v_v+\bar v\cot v={a}+{b}+(u+{times(b)}v)\cot v$. "
        "Write cot v as cos(v)/sin(v).",
    )


# -- drag ------------------------------------------------------------------------------------------


def pitch(draw: Draw) -> Drag:
    """Ask for a closed design with a given pitch."""
    target = draw.one_of((0.3, 0.4, 0.8, 1.0))

    return Drag(
        question=f"Drag the points of this closed design until its pitch is $l={target:g}$. "
        r"$0.02$ more or less will do. $\bar u=u-v$ and $\bar v=u+v$ stay.",
        start=EXAMPLE_2,
        model=_with_pitch(target),
        conditions=lambda made: (has_pitch(made, target),),
        slips=(
            Misconception(
                "sign of (24)",
                lambda made: made.pitch is not None and abs(made.pitch.dual + target) <= 0.02,
                r"The size is right, but this is $+\oint\langle\mathbf c',\mathbf x\rangle\,dt$, "
                r"the sign printed in (24). Run through the loop the other way.",
                _reversed(_with_pitch(target)),
            ),
        ),
        because="A larger loop on the sphere has the greater flux, and so the greater pitch.",
        hints=(
            "The pitch is a flux through the loop: what makes it greater?",
            "Make the loop larger for a greater pitch, smaller for a smaller one.",
        ),
        solution=f"One of many such designs is shown in the chart now: the loop of Example 2, "
        f"{'enlarged' if target > 0.58 else 'made smaller'} about its middle.",
    )


@functools.cache
def _with_pitch(target: float) -> Design:
    """Return Example 2, grown about its middle until it has this pitch: nearly as the square."""
    factor = 1.0
    for _ in range(4):
        factor *= math.sqrt(target / enlarged(EXAMPLE_2, factor).surface().pitch())
    return enlarged(EXAMPLE_2, factor)


def _reversed(design: Design) -> Design:
    return design.with_(points=design.points[::-1])


def smooth(draw: Draw) -> Drag:
    """Ask to mend a seam that is only C⁰, and to pass it faster than a closing alone makes it."""
    up, least = draw.one_of((0.25, 0.4)), draw.one_of((1.8, 2.0, 2.2))
    points = [*LOOP]
    points[1] = (EIGHTH * 1.5, EIGHTH * (2 + up))
    start = Design(tuple(points), "u - v", "u + v", closing="C0", name="a corner")
    one_line = [*LOOP]
    one_line[1] = (EIGHTH, EIGHTH * (2 + up))
    return Drag(
        question="This closed design has a corner at the seam, $t=0$. Drag until the rulings pass "
        "the seam smoothly, C¹: direction <i>and</i> speed of the spherical image are the same on "
        rf"both sides. And fast: $\kappa\ge{least:g}$ there. The menu of closings is a fair help, "
        "but it will not do all of it.",
        start=start,
        model=EXAMPLE_2,
        conditions=lambda made: _smooth_seam(made, least),
        plots=("kappa",),
        slips=(
            known.collinear_for_c1(start.with_(points=tuple(one_line))),
            Misconception(
                "smooth taken for fast",
                lambda made: all(c.met for c in _smooth_seam(made, 0.0)),
                "The seam is smooth now. The speed is that of the leg you left there: "
                r"$\kappa(0)$ is $n$ times the length of the first leg on the sphere, so draw "
                "point 1 farther away from point 0, and keep the legs equal.",
                start.closed_with("C1"),
            ),
        ),
        because="Equal legs at the seam, and long ones: that is C¹ at a high speed.",
        hints=(
            "Look at the two legs of the polygon that meet in point 0.",
            r"C¹ means $\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}$: the same direction "
            "and the same length. Or choose a closing from the menu and see what it moves.",
            r"$\kappa(0)=n\sqrt{\Delta u^2\sin^2v+\Delta v^2}$ with the first leg "
            r"$(\Delta u,\Delta v)$, and $n=6$: due south, from point 0, it has to be at least "
            rf"${least / 6:.3f}$ long.",
        ),
        solution="The seam of Example 2 itself is shown in the chart now: its first and last legs "
        r"are equal, $\tfrac\pi8$ due south, so that $\kappa=6\cdot\tfrac\pi8\approx2.356$ on both "
        "sides.",
    )


def _smooth_seam(made: Made, least: float) -> tuple[Condition, ...]:
    ends = (
        "same direction on both sides",
        r"same speed $\kappa$ on both sides",
        rf"speed at least $\kappa={least:g}$ there",
    )
    if not made.closure.closed:
        why = "the curve does not close"
        return tuple(Condition(text, math.nan, 1.0, now=why) for text in ends)
    velocity = made.surface.jet(np.array(made.surface.domain), 1).direction[1]
    first, last = velocity[:, 0], velocity[:, 1]
    speeds = np.linalg.norm(first), np.linalg.norm(last)
    if min(speeds) == 0.0:
        return tuple(Condition(text, math.nan, 1.0, now="it rests at the seam") for text in ends)
    turn = float(np.degrees(np.arctan2(np.linalg.norm(np.cross(first, last)), first @ last)))
    jump = 100 * float(abs(speeds[0] - speeds[1]) / max(speeds))
    said = rf"now $\kappa={speeds[1]:.2f}$ before and {speeds[0]:.2f} after"
    return (
        Condition(ends[0], turn, 2.0, "°", f"now {turn:.1f}° apart"),
        Condition(ends[1], jump, 3.0, "%", said),
        at_least(ends[2], float(min(speeds)), least, "rad per t"),
    )


# -- sketch ----------------------------------------------------------------------------------------


def conoid(draw: Draw) -> Sketch:
    """Ask for δ of a conoid."""
    count, size = draw.integer(1, 2), draw.one_of((0.5, 1.0))

    def delta(t: Array) -> Array:
        return np.asarray(size * count * np.cos(2 * np.pi * count * t))

    wave = f"\\sin {times(count)}u" if size == 1.0 else f"{size:g}\\,\\sin {times(count)}u"
    return Sketch(
        question=r"The rulings go once round the equator, $u=2\pi t$, $v=\tfrac\pi2$, and their "
        rf"heights swing, $\bar u={wave}$, $\bar v=0$: a conoid. Sketch the distribution parameter "
        r"$\delta$ over $t$.",
        curve=delta,
        heights=(-1.5 * size * count, 1.5 * size * count),
        quantity="delta",
        label="δ",
        because=r"$\delta=d\bar u/du$: zero wherever the height stands still for a moment.",
        hints=(
            r"All rulings are horizontal and meet the $z$-axis at the height $\bar u$.",
            r"Where the height has a maximum or a minimum, the ruling is torsal: $\delta=0$.",
            r"$\delta=\bar\kappa/\kappa=d\bar u/du$.",
        ),
        solution=rf"$\delta=\dfrac{{d\bar u}}{{du}}={size * count:g}\cos {times(count)}u$: "
        "a maximum at both ends of the turn, zeros where the height is greatest and least.",
    )


def height(draw: Draw) -> Sketch:
    """Ask for v(t) of Example 2, by looking at its control points."""
    surface = _example_2()
    sign = draw.one_of((1, -1))

    def above(t: Array) -> Array:
        return np.asarray(sign * (surface.curve.series(t, 0).value[1] - 2 * EIGHTH))

    what = r"v(t)-\tfrac\pi4" if sign > 0 else r"\tfrac\pi4-v(t)"
    return Sketch(
        question=r"The control points of Example 2 have the colatitudes $\tfrac\pi8\cdot"
        rf"(2,3,3,2,1,1,2)$. Sketch ${what}$ over $t$, without computing.",
        curve=above,
        heights=(-0.5, 0.5),
        label="v − π/4" if sign > 0 else "π/4 − v",
        because="A Bézier curve crosses a line no more often than its control polygon does.",
        hints=(
            "Begin with the ends: the curve starts and ends in its first and last control point.",
            r"The points are symmetrical: exchanging $t$ and $1-t$ exchanges above and below.",
        ),
        solution="It starts at 0, swings to one side, crosses zero at $t=\\tfrac12$ and swings as "
        "far to the other side: one zero between the ends, one maximum, one minimum.",
    )


# -- Python ----------------------------------------------------------------------------------------


def dual_angle(draw: Draw) -> Code:
    """Ask for Λ of Example 2 with scaled fields."""
    scale = draw.one_of((2, 3, 4))
    surface = _example_2(scale)
    turn, shift = surface.angle_of_pitch(), surface.pitch()
    signed = known.mistaken_for(
        "sign of (24)",
        [turn, -shift],
        r"$\lambda$ is right; the pitch has the sign printed in (24). $l=-\oint\bar\tau\,dt$.",
    )
    return Code(
        question=rf"Compute $\Lambda=\lambda+\varepsilon l$ of Example 2 with "
        rf"$\bar u={scale}(u-v)$ and $\bar v={scale}(u+v)$. Give $[\lambda, l]$ or the dual "
        "number.",
        starter="from ruledlab import Bezier, RuledSurface\n"
        "from ruledlab.geometry import gallery\n\n"
        "value = ...  # gallery.LOOP holds the control points",
        answer=[turn, shift],
        label="Λ =",
        tolerance=1e-6,
        slips=(
            signed,
            known.mistaken_for(
                "λ modulo 2π",
                [turn % (2 * math.pi), shift],
                r"$l$ is right; $\lambda$ is right modulo $2\pi$ only. The integral counts turns.",
            ),
        ),
        hints=(
            "RuledSurface(Bezier(points), ubar, vbar) takes the formulas as texts.",
            "A surface has .angle_of_pitch(), .pitch() and .dual_angle_of_pitch().",
        ),
        solution=f'<pre>surface = RuledSurface(Bezier(gallery.LOOP), "{scale}*(u - v)", '
        f'"{scale}*(u + v)")\nvalue = surface.dual_angle_of_pitch()</pre>'
        rf"$\lambda={turn:.6f}$ as before, and $l={shift:.6f}$ is {scale} times that of Example 2.",
    )


def torsion(draw: Draw) -> Code:
    """Ask for τ̄ at three places."""
    t = np.array(draw.one_of(((0.1, 0.4, 0.7), (0.2, 0.5, 0.8), (0.15, 0.3, 0.6))))
    surface = _example_2()
    u, v = surface.curve.series(t, 1).derivatives()[0]
    du, dv = surface.curve.series(t, 1).derivatives()[1]
    advance = np.sin(v) * ((u - v) * dv - (u + v) * du)
    places = ", ".join(f"{x:g}" for x in t)
    return Code(
        question=rf"Compute the dual torsion $\bar\tau$ of Example 2 at $t={places}$, as an array.",
        starter=f"from ruledlab.geometry import gallery\n\nt = [{places}]\nvalue = ...",
        answer=surface.invariants(t).tau_bar,
        label="τ̄ =",
        unit="length per t",
        tolerance=1e-6,
        slips=(known.printed_tau_bar(advance),),
        hints=(
            'gallery.surface("example_2") is the surface.',
            "surface.invariants(t) has all invariants at all t, by their names in words.",
        ),
        solution='<pre>value = gallery.surface("example_2").invariants(t).tau_bar</pre>',
    )


# -- find the slip ---------------------------------------------------------------------------------


def printed_torsion(draw: Draw) -> FindSlip:
    """Ask for the slip in (18)."""
    common = r"$\kappa^2\tau=\cos v\,(u'^3\sin^2v+2u'v'^2)"
    options = (
        Option(
            common + r"+\sin v\,(u''v'-u'v'')$",
            r"It agrees with $[\mathbf x,\mathbf x',\mathbf x'']$, and it is not changed when "
            r"$(u'',v'')$ gets a multiple of $(u',v')$ added.",
            right=True,
        ),
        Option(
            common + r"+\sin v\,(u'v''-u''v')$",
            r"The bracket is right up to its sign: $[\mathbf x,\mathbf x_u,\mathbf x_v]=-\sin v$.",
        ),
        Option(
            common + r"-\sin v\,(u'v''+u''v')$",
            "A determinant changes its sign when two columns are exchanged; this bracket does not.",
        ),
    )
    return FindSlip(
        question=r"These lines lead to $\tau$ in the chart. One of them is printed with a slip in "
        "the paper. Which?",
        lines=(
            Line(
                r"$\mathbf x=(\cos u\sin v,\ \sin u\sin v,\ \cos v)$",
                "it is the chart of the sphere, (14).",
            ),
            Line(
                r"$\kappa^2=u'^2\sin^2v+v'^2$",
                r"$\mathbf x_u$ has the length $\sin v$, $\mathbf x_v$ the length 1, and they are "
                "perpendicular.",
            ),
            Line(
                r"$\kappa^2\tau=[\mathbf x,\mathbf x',\mathbf x'']$",
                "this is how the torsion of the spherical image is defined.",
            ),
            Line(
                r"$\kappa^2\tau=\cos v\,(u'^3\sin^2v+2u'v'^2)+\sin v\,(u'v''+u''v')$",
            ),
        ),
        then=Choose(
            question="What should stand there?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            "Look for a term that does not change its sign when two things are exchanged that a "
            "determinant distinguishes.",
            "Let the point run through the same path faster and slower. This adds to "
            r"$(u'',v'')$ a multiple of $(u',v')$, which changes no determinant.",
        ),
        solution=r"The determinant gives $\sin v\,(u''v'-u'v'')$ with a minus sign between the two "
        r"products: $[\mathbf x,\mathbf x_u,\mathbf x_v]=-\sin v$.",
    )


def closing(draw: Draw) -> FindSlip:
    """Ask for the slip in the closing condition."""
    return FindSlip(
        question="A curve of degree $n$ shall close with C¹. One step of this reasoning is wrong.",
        lines=(
            Line(
                r"It closes if $\mathbf p_n=\mathbf p_0$.",
                "a Bézier curve starts and ends in its first and last control point.",
            ),
            Line(
                r"Its velocities at the ends are $n(\mathbf p_1-\mathbf p_0)$ and "
                r"$n(\mathbf p_n-\mathbf p_{n-1})$.",
                "this is the derivative of the Bézier curve at 0 and at 1.",
            ),
            Line(
                r"They are equal if $\mathbf p_{n-1},\mathbf p_0,\mathbf p_1$ lie on one line.",
            ),
            Line(
                r"Then the direction of the tangent is the same on both sides.",
                "equal velocities have equal directions.",
            ),
        ),
        then=Formula(
            question=r"So where must $\mathbf p_{n-1}$ lie? Write it with $a$ for $\mathbf p_0$ "
            r"and $b$ for $\mathbf p_1$, as if they were numbers.",
            solution="",
            answer="2*a - b",
            variables=("a", "b"),
            box=((-2.0, 2.0), (-2.0, 2.0)),
            label="pₙ₋₁ =",
            slips=(
                known.formula(
                    "middle of the leg",
                    "(a + b)/2",
                    r"This lies on the first leg. $\mathbf p_{n-1}$ comes before $\mathbf p_0$: "
                    r"$\mathbf p_0$ is the middle between it and $\mathbf p_1$.",
                    ("a", "b"),
                    ((-2.0, 2.0), (-2.0, 2.0)),
                ),
            ),
            because=r"$\mathbf p_0$ is the middle between $\mathbf p_{n-1}$ and $\mathbf p_1$.",
        ),
        hints=(
            "Which line says more than the one before it allows?",
            r"Solve $\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}$.",
        ),
        solution=r"Points on one line make the velocities parallel, not equal. They are equal if "
        r"$\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}$, that is "
        r"$\mathbf p_{n-1}=2\mathbf p_0-\mathbf p_1$.",
    )


EXERCISES = (
    Exercise("06.1", "Three points on one line", seam),
    Exercise("06.2", "What the dual part leaves alone", dual_part),
    Exercise("06.3", "Speed at the start", speed),
    Exercise("06.4", "A moment", moment),
    Exercise("06.5", "From area to angle", angle_of_pitch),
    Exercise("06.6", "Between control points", bezier),
    Exercise("06.7", "What the pitch measures", divergence),
    Exercise("06.8", "A pitch to order", pitch),
    Exercise("06.9", "Mend the seam", smooth),
    Exercise("06.10", "A swinging ruling", conoid),
    Exercise("06.11", "Reading a polygon", height),
    Exercise("06.12", "Λ in three lines", dual_angle),
    Exercise("06.13", "The dual torsion", torsion),
    Exercise("06.14", "A slip in a torsion", printed_torsion),
    Exercise("06.15", "A slip at the seam", closing),
)
"""The exercises in their order."""
