"""Exercises of lesson 04: the invariants, the frame and its screw, special rulings."""

from __future__ import annotations

import math

import numpy as np

from ..design import Design
from ..geometry import gallery
from ..geometry.checks import Array
from ..geometry.curve import Bezier
from ..geometry.special import special_rulings
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
from .designs import values
from .tex import angle, combination, times

__all__ = ["EXERCISES"]

TURN = 2 * math.pi
CLEAR = 0.02
"""How far τ has to get to either side of 0, in radians per t."""


def _ring(height: float, wave: str, radius: str) -> RuledSurface:
    """Return rulings at a constant colatitude, once round, with ū = wave(u) and v̄ = radius."""
    return RuledSurface(Bezier(np.array([[0.0, height], [TURN, height]])), wave, radius)


# -- choose ----------------------------------------------------------------------------------------


def torsal(draw: Draw) -> Choose:
    """Ask what vanishes on a torsal ruling."""
    options = (
        Option(
            r"$\bar\kappa$, so that the neighbour does not pass at a distance of first order",
            r"And with it $\delta=\bar\kappa/\kappa$, as $\kappa\neq0$. The tangent plane is the "
            "same all along the ruling.",
            right=True,
        ),
        Option(
            r"$\kappa$, so that the ruling keeps its direction for a moment",
            r"Where $\kappa=0$ the ruling is cylindrical. On a torsal one $\kappa\neq0$, so that "
            r"$\delta=\bar\kappa/\kappa$ is defined.",
            slip="torsal taken for cylindrical",
        ),
        Option(
            r"$\bar\tau$, so that the striction curve crosses the ruling at right angles",
            r"That is what $\bar\tau=0$ does, by $\mathbf m'=\bar\tau\mathbf x_1+\bar\kappa"
            r"\mathbf x_3$. On a torsal ruling the other term is zero.",
            slip="κ̄ and τ̄ exchanged",
        ),
        Option(
            r"$\tau$, so that the frame does not turn about the ruling",
            r"$\tau$ belongs to the directions alone. No choice of $\bar u,\bar v$ can change it, "
            "but it can make a ruling torsal.",
        ),
    )
    return Choose(
        question="What is zero on a torsal ruling?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Go to one in the laboratory by its button and read the numbers.",
            r"The tangent plane turns along the ruling by $\arctan(w/\delta)$.",
        ),
        solution=r"$\bar\kappa=0$ and with it $\delta=\bar\kappa/\kappa$, while $\kappa\neq0$. The "
        "striction curve touches the ruling there, and the tangent plane does not turn along it.",
    )


def reversal(draw: Draw) -> Choose:
    """Ask what changes when every ruling gets the opposite direction."""
    options = (
        Option(
            r"$\tau$ and $\bar\tau$ change their signs, $\sigma$ becomes $\pi-\sigma$; the others "
            "stay",
            r"$\hat\kappa=\|\mathbf X'\|$ does not see the sense, and in "
            r"$[\mathbf X,\mathbf X',\mathbf X'']$ three factors change their signs.",
            right=True,
        ),
        Option(
            r"all of $\kappa,\bar\kappa,\tau,\bar\tau$ change their signs; $\sigma,\delta$ stay",
            r"$\kappa=\|\mathbf x'\|$ is a length and cannot become negative.",
        ),
        Option(
            r"$\bar\kappa$ and $\delta$ change their signs; the others stay",
            r"$\kappa\bar\kappa=\langle\mathbf x',\bar{\mathbf x}'\rangle$ has two factors that "
            "change their signs together. The sign of δ tells left from right, and a surface does "
            "not become its mirror image by turning its lines round.",
            slip="reversal taken for reflection",
        ),
        Option(
            "none: they are invariants",
            "They are invariants of rigid motions. Which of the two directions of a line is called "
            r"$\mathbf x$ is a choice of ours, and some of them see it.",
            slip="invariant under everything",
        ),
    )
    return Choose(
        question=r"Every ruling of a surface gets the opposite direction, "
        r"$\mathbf X\to-\mathbf X$, and $t$ stays as it is. What happens to "
        r"$\kappa,\bar\kappa,\tau,\bar\tau,\sigma,\delta$?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Not quite what <i>reverse</i> does in the laboratory: there only "
            r"$\mathbf X'$ changes its sign. Count the signs.",
            r"$\hat\kappa=\|\mathbf X'\|$ and $\hat\tau=[\mathbf X,\mathbf X',\mathbf X'']/"
            r"\|\mathbf X'\|^2$.",
        ),
        solution=r"$\hat\kappa\to\hat\kappa$ and $\hat\tau\to-\hat\tau$, three factors having "
        r"changed their sign; so $\delta$ stays, and $\sigma$, the direction of "
        r"$(\bar\tau,\bar\kappa)$, becomes $\pi-\sigma$. Running backwards does "
        "the same with one factor. Who does both changes nothing.",
    )


# -- numbers ---------------------------------------------------------------------------------------


def curvature_and_delta(draw: Draw) -> Number:
    """Ask for κ and δ on a ring whose invariants are elementary."""
    part, size, radius = draw.one_of((3, 4, 6)), draw.one_of((1, 2)), draw.one_of((6, 7))
    height, t = math.pi / part, draw.one_of((1 / 6, 1 / 3, 1 / 4))
    waves = 2
    rate = waves * size * math.cos(waves * TURN * t)
    kappa, delta = TURN * math.sin(height), radius / math.tan(height) + rate
    place = {1 / 6: r"\tfrac16", 1 / 3: r"\tfrac13", 1 / 4: r"\tfrac14"}[t]
    slips = [
        known.mistaken_for(
            "κ̄ for δ",
            [kappa, kappa * delta],
            r"$\kappa$ is right. The second is $\bar\kappa$, measured by $t$; divide by $\kappa$.",
        ),
        known.mistaken_for(
            "δ inverted",
            [kappa, 1 / delta],
            r"$\kappa$ is right. The second is inverted: $\delta=\bar\kappa/\kappa$ is a length.",
        ),
        known.mistaken_for(
            "sin v forgotten",
            [TURN, delta],
            r"$u'=2\pi$ is the speed in the chart. On the sphere a step $du$ is worth only "
            r"$\sin v\,du$. $\delta$ is right.",
        ),
        known.mistaken_for(
            "height for its rate",
            [kappa, delta - rate + size * math.sin(waves * TURN * t)],
            r"$\kappa$ is right. In $\delta$ stands not $\bar u$ itself but its rate $\bar u_u$: a "
            "ruling that is lifted moves no faster past its neighbour.",
        ),
        known.mistaken_for(
            "rate by t for rate by u",
            [kappa, delta - rate + TURN * rate],
            r"$\kappa$ is right. You differentiated $\bar u$ by $t$. In $\delta$ stands "
            r"$\bar u_u=d\bar u/du$; the factor $u'$ cancels.",
        ),
    ]
    return Number(
        question=rf"A ring: $u=2\pi t$, $v=\tfrac\pi{part}$, $\bar u={times(size)}\sin 2u$, "
        rf"$\bar v={radius}$. How large are $\kappa$ and $\delta$ at $t={place}$? "
        r"Write $[\kappa,\ \delta]$.",
        answer=[kappa, delta],
        label="[κ, δ] =",
        slips=tuple(slips),
        because=r"Here $\kappa=u'\sin v$ and $\delta=\bar v\cot v+\dfrac{d\bar u}{du}$.",
        hints=(
            r"$\kappa^2=u'^2\sin^2v+v'^2$, and $v'=0$.",
            r"$\kappa\bar\kappa=u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)$ when $v'=0$.",
            r"So $\delta=\bar\kappa/\kappa=\bar v\cot v+\bar u_u$ with $\bar u_u="
            rf"{times(2 * size)}\cos 2u$.",
        ),
        solution=rf"$\kappa=2\pi\sin\tfrac\pi{part}={kappa:.6f}$ and $\delta={radius}\cot"
        rf"\tfrac\pi{part}+{times(2 * size)}\cos 2u={delta:.6f}$.",
    )


def screw_pitch(draw: Draw) -> Number:
    """Ask for the pitch of the instantaneous screw."""
    kappa, tau = draw.one_of(((3, 4), (4, 3), (1, 2), (2, 1)))
    # such that no two of the values below are one number, and none is 0
    kappa_bar, tau_bar = draw.one_of(((4, -1), (5, -1), (1, 3), (-2, 3)))
    value = (kappa * kappa_bar + tau * tau_bar) / (kappa**2 + tau**2)
    delta = kappa_bar / kappa
    return Number(
        question=rf"On a ruling $\hat\kappa={_dual(kappa, kappa_bar)}$ and "
        rf"$\hat\tau={_dual(tau, tau_bar)}$. How far does the frame move along its screw axis for "
        "each radian that it turns?",
        answer=value,
        label="h =",
        unit="length",
        slips=(
            known.mistaken_for(
                "δ for the pitch of the screw",
                delta,
                r"This is $\delta=\bar\kappa/\kappa$, how the <i>ruling</i> moves for each radian. "
                "The frame turns about the ruling as well, by τ, and slides along it, by τ̄.",
            ),
            known.mistaken_for(
                "dual parts over real parts",
                math.hypot(kappa_bar, tau_bar) / math.hypot(kappa, tau),
                r"This is $\|\mathbf m'\|/\omega$. Only the part of $\mathbf m'$ <i>along</i> the "
                "axis counts.",
            ),
            known.mistaken_for(
                "per t, not per radian",
                value * math.hypot(kappa, tau),
                r"This is the speed along the axis, for each unit of $t$. Divide once more by "
                r"$\|\omega\|$, the radians in a unit of $t$.",
            ),
        ),
        because=r"$h=\langle\omega,\mathbf m'\rangle/\|\omega\|^2$.",
        hints=(
            r"The frame turns with $\omega=\tau\mathbf x_1+\kappa\mathbf x_3$ while its origin "
            r"moves with $\mathbf m'=\bar\tau\mathbf x_1+\bar\kappa\mathbf x_3$.",
            r"The part of $\mathbf m'$ along $\omega$ is $\langle\omega,\mathbf m'\rangle/"
            r"\|\omega\|$; in one unit of $t$ the frame turns by $\|\omega\|$.",
        ),
        solution=rf"$h=\dfrac{{\kappa\bar\kappa+\tau\bar\tau}}{{\kappa^2+\tau^2}}="
        rf"\dfrac{{{kappa * kappa_bar + tau * tau_bar}}}{{{kappa**2 + tau**2}}}={value:.6g}$.",
    )


def dual_torsion(draw: Draw) -> Number:
    """Ask for τ̄ on a ring, where (18) as printed gives something else."""
    # b > a, for else τ̄ could be 0 and κ̄ the printed value
    a, b, t = draw.one_of((1, 2)), draw.one_of((3, 4, 5)), draw.one_of((0, 1 / 6, 1 / 3, 1 / 2))
    place = {0: "0", 1 / 6: r"\tfrac16", 1 / 3: r"\tfrac13", 1 / 2: r"\tfrac12"}[t]
    surface = _ring(math.pi / 4, f"{a}*sin(u)", f"{b}")
    value = TURN * math.sqrt(0.5) * (a * math.cos(TURN * t) - b)
    printed = -TURN * math.sqrt(0.5) * b
    return Number(
        question=rf"A ring: $u=2\pi t$, $v=\tfrac\pi4$, $\bar u={times(a)}\sin u$, $\bar v={b}$. "
        rf"How large is the dual torsion $\bar\tau$ at $t={place}$?",
        answer=value,
        label="τ̄ =",
        unit="length per t",
        slips=(
            known.printed_tau_bar(printed),
            known.mistaken_for(
                "κ̄ for τ̄",
                surface.invariants(t).kappa_bar,
                r"This is $\bar\kappa$, the part of $\mathbf m'$ along $\mathbf x_3$. The part "
                r"along the ruling is $\bar\tau$.",
            ),
        ),
        because=r"$\bar\tau=\langle\mathbf c',\mathbf x\rangle+\mu'$: the striction point moves "
        "along the ruling as well.",
        hints=(
            r"$\bar\tau=\langle\mathbf m',\mathbf x_1\rangle$, where $\mathbf m=\mathbf c"
            r"+\mu\mathbf x$ is the striction curve, not the curve of foot points $\mathbf c$.",
            r"So $\bar\tau=\sin v\,(\bar u v'-\bar v u')+\mu'$, and $\mu=\bar u\cos v$ when $v'=0$ "
            r"and $\bar v$ is constant.",
        ),
        solution=r"$\langle\mathbf c',\mathbf x\rangle=-u'\bar v\sin v$ and $\mu'=u'\bar u_u"
        rf"\cos v$, so $\bar\tau=\sqrt2\,\pi\,({times(a)}\cos 2\pi t-{b})={value:.6f}$.",
    )


# -- a formula -------------------------------------------------------------------------------------


def distribution(draw: Draw) -> Formula:
    """Ask for δ along a ring, as a function of u."""
    a, b, n = draw.one_of((2, 3)), draw.one_of((2, 5)), draw.one_of((2, 3))
    box = ((0.0, TURN),)
    return Formula(
        question=rf"A ring with $v=\tfrac\pi4$, $\bar u={a}\sin {n}u$ and $\bar v={b}$. Write its "
        r"distribution parameter $\delta$ as a formula in $u$.",
        answer=f"{b} + {n * a}*cos({n}*u)",
        variables=("u",),
        box=box,
        label="δ =",
        slips=(
            known.formula(
                "height for its rate",
                f"{b} + {a}*sin({n}*u)",
                r"This has $\bar u$ itself. A ruling that is lifted moves no faster past its "
                r"neighbour: what counts is the rate $\bar u_u$.",
                ("u",),
                box,
            ),
            known.formula(
                "inner factor forgotten",
                f"{b} + {a}*cos({n}*u)",
                rf"The derivative of $\sin {n}u$ is ${n}\cos {n}u$.",
                ("u",),
                box,
            ),
        ),
        because=r"$\delta=\bar v\cot v+\bar u_u$ with $\cot\tfrac\pi4=1$.",
        hints=(
            r"Divide $\kappa\bar\kappa=u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)$ by $\kappa^2$.",
            r"$\kappa^2=u'^2\sin^2v$, so $\delta=\bar v\cot v+\bar u_u$.",
        ),
        solution=rf"$\delta={b}\cot\tfrac\pi4+{n * a}\cos {n}u={b}+{n * a}\cos {n}u$. Torsal where "
        rf"$\cos {n}u=-\tfrac{{{b}}}{{{n * a}}}$.",
    )


# -- sketch ----------------------------------------------------------------------------------------


def spiral(draw: Draw) -> Sketch:
    """Ask for τ on a spiral across the equator."""
    down = draw.one_of((True, False))
    north, south = math.pi / 6, draw.one_of((4, 5)) * math.pi / 6
    first, last = (north, south) if down else (south, north)
    surface = RuledSurface(Bezier(np.array([[0.0, first], [TURN, last]])), "0", "1")

    def tau(t: Array) -> Array:
        return np.asarray(surface.invariants(t).tau)

    way = "south" if down else "north"
    return Sketch(
        question=rf"The direction of a ruling winds once round the sphere, $u=2\pi t$, while it "
        rf"moves steadily {way}, from $v={angle(first)}$ to $v={angle(last)}$. Sketch $\tau$ "
        r"over $t$.",
        curve=tau,
        heights=(-10.0, 10.0),
        quantity="tau",
        label="τ",
        because=r"With $u''=v''=0$ the sign of $\tau$ is that of $u'\cos v$: zero on the equator.",
        hints=(
            r"$\tau/\kappa$ is the geodesic curvature of the path on the sphere: to which side "
            "does it bend, seen from outside?",
            r"On a circle of latitude $\tau=u'\cos v$: positive in the north, zero on the equator.",
            r"$\kappa^2\tau=\cos v\,(u'^3\sin^2v+2u'v'^2)$ here.",
        ),
        solution=r"$\tau=u'\cos v\,\dfrac{u'^2\sin^2v+2v'^2}{u'^2\sin^2v+v'^2}$: positive north of "
        "the equator, zero on it, negative south of it.",
    )


# -- drag ------------------------------------------------------------------------------------------


def make_torsal(draw: Draw) -> Drag:
    """Ask for a design with a torsal ruling."""
    waves = draw.one_of((3, 4, 5))
    start = Design(
        ((0.0, 0.6), (TURN / 3, 0.6), (2 * TURN / 3, 0.6), (TURN, 0.6)),
        f"{0.9 / waves:g}*sin({waves}*u)",
        "0.8",
        closing="C1",
        name="no torsal ruling",
    )
    deeper = tuple((u, 1.2) for u, _ in start.points)
    return Drag(
        question=r"The rulings lean by $v$ against the $z$-axis, and $\bar u,\bar v$ stay as they "
        r"are. Now $\delta$ is positive everywhere. Drag the points until the surface has a torsal "
        "ruling.",
        start=start,
        model=start.with_(points=deeper),
        conditions=_has_torsal,
        plots=("delta",),
        because="κ̄ has a zero, found by root finding and not by looking at samples.",
        hints=(
            r"On a circle of latitude $\delta=\bar v\cot v+\bar u_u$.",
            r"$\bar u_u$ comes down to $-0.9$. Make $\bar v\cot v=0.8\cot v$ smaller than that.",
            r"Drag the points down, towards the equator $v=\tfrac\pi2$: there $\cot v=0$.",
        ),
        solution=r"With $v=1.2$ everywhere, $0.8\cot v=0.31$ and $\delta=0.31+0.9\cos "
        rf"{waves}u$ changes its sign {2 * waves} times in one turn.",
    )


def _has_torsal(made: Made) -> tuple[Condition, ...]:
    found = special_rulings(made.surface)
    text = r"a torsal ruling: $\bar\kappa=0$, $\kappa\neq0$"
    count = len(found.torsal)
    if count or len(found.developable):
        return (Condition(text, 0.0, 0.0, "length", f"now {count or 'whole stretches'}"),)
    delta = np.abs(values(made, "delta", 400))
    if not delta.size:
        return (Condition(text, math.nan, 0.0, now="δ is undefined everywhere"),)
    least = float(delta.min())
    return (Condition(text, least, 0.0, "length", rf"least $|\delta|={least:.3f}$"),)


def touch(draw: Draw) -> Drag:
    """Ask for a wave ring whose torsal rulings have met two by two."""
    ring = gallery.example("wave_ring")
    start = Design(ring.points, ring.ubar, ring.vbar, closing=ring.closing, name=ring.title)
    return Drag(
        question=r"The wave ring has six torsal rulings. Make them meet two by two, so that there "
        r"are just three on which $\bar\kappa$ touches zero and keeps its sign. (Change "
        r"$\bar u$ or $\bar v$ by their formulas.)",
        start=start,
        model=start.with_(vbar="1.2"),
        conditions=_three_touching,
        fields=True,
        plots=("delta",),
        slips=(
            Misconception(
                "nearly touching",
                _nearly_touching,
                r"The least $|\delta|$ is small, but $\bar\kappa$ has no zero any more: you have "
                "gone a little too far. Nearly touching is not touching.",
                start.with_(vbar="1.21"),
            ),
        ),
        because=r"The lowest points of $\delta$ lie on zero: three double zeros. A search for "
        "changes of sign would have found none of them.",
        hints=(
            "Look at the plot of δ: at which height does its wave swing, and how far?",
            r"$\delta=\bar v\cot v+\bar u_u$ with $\cot v=1$ here, so "
            r"$\delta=\bar v+1.2\cos 3u$.",
            r"The wave has to be lifted until its lowest points lie on zero.",
        ),
        solution=r"$\bar v=1.2$ gives $\delta=1.2\,(1+\cos 3u)$, zero where $\cos3u=-1$: at "
        r"$t=\tfrac16,\tfrac12,\tfrac56$. So do $\bar v=-1.2$ and $\bar u=0.2\sin3u$.",
    )


def _three_touching(made: Made) -> tuple[Condition, ...]:
    crossing, touching = _crossing_and_touching(made.surface)
    return (
        Condition(r"no torsal ruling on which $\bar\kappa$ changes its sign", crossing, 0.0,
                  now=f"now {crossing}"),
        Condition(r"three on which it keeps its sign", abs(touching - 3), 0.0,
                  now=f"now {touching}"),
    )  # fmt: skip


def _crossing_and_touching(surface: RuledSurface) -> tuple[int, int]:
    """Count the torsal rulings on which κ̄ changes its sign, and those on which it does not.

    On a closed surface the first and the last ruling are one.
    """
    found, (first, last) = special_rulings(surface), surface.domain
    step = 1e-6 * (last - first)
    inner = (found.torsal > first + step) & (found.torsal < last - step)
    ends = int((~inner).sum())
    touching = found.touching[inner]
    if ends == 2 and surface.closure().closed:
        before, after = surface.invariants([last - step, first + step]).delta
        touching = np.append(touching, before * after > 0)
    elif ends:
        touching = np.append(touching, np.zeros(ends, dtype=bool))
    return int((~touching).sum()), int(touching.sum())


def _nearly_touching(made: Made) -> bool:
    delta = np.abs(values(made, "delta", 400))
    near = bool(delta.size and delta.min() < 0.1)
    return near and not len(special_rulings(made.surface).torsal)


def straighten(draw: Draw) -> Drag:
    """Ask for a path on the sphere that bends to both sides."""
    low = draw.one_of((0.7, 0.8, 0.9))
    start = Design(
        ((0.3, low), (1.1, low), (1.9, low), (2.7, low)),
        "0.3*u",
        "0.5",
        name="bends to one side",
    )
    turned = ((0.3, 1.0), (1.1, 0.4), (1.9, 2.2), (2.7, 1.6))
    return Drag(
        question=r"The path of $\mathbf x$ on the sphere bends to the left all along: $\tau>0$. "
        r"Drag the points until $\tau=0$ somewhere <i>and</i> $\tau$ has both signs.",
        start=start,
        model=start.with_(points=turned),
        conditions=_both_signs,
        plots=("tau",),
        slips=(
            Misconception(
                "left taken for right",
                _to_the_right,
                r"Now $\tau$ is negative everywhere: the path bends to the right all along. It has "
                "to change the side on its way.",
                start.with_(points=start.points[::-1]),
            ),
        ),
        because="Where τ = 0 the path on the sphere has an inflection: it touches a great circle "
        "to second order.",
        hints=(
            r"$\tau/\kappa$ is the geodesic curvature of the path on the sphere. An S has an "
            "inflection.",
            "Lead the path from the north across the equator in a curve like an S.",
        ),
        solution="One of many such paths is shown in the chart now: it bends first to one side and "
        "then to the other.",
    )


def _to_the_right(made: Made) -> bool:
    tau = values(made, "tau", 400)
    return bool(tau.size and tau.max() < 0)


def _both_signs(made: Made) -> tuple[Condition, ...]:
    tau, text = values(made, "tau", 400), r"$\tau$ has both signs"
    if not tau.size:
        return (Condition(text, math.nan, 0.0, now="τ is undefined everywhere"),)
    low, high = float(tau.min()), float(tau.max())
    now = rf"now from ${low:.3g}$ to ${high:.3g}$"
    off = max(low + CLEAR, CLEAR - high, 0.0)  # along a great circle both signs are rounding
    return (Condition(text, off, 0.0, "rad per t", now),)


# -- Python ----------------------------------------------------------------------------------------


def print_special(draw: Draw) -> Code:
    """Ask for the torsal rulings of a gallery surface."""
    key = draw.one_of(("plucker_conoid", "twisted_ring", "moebius"))
    surface = gallery.surface(key)
    answer = special_rulings(surface).torsal
    title = gallery.example(key).title
    return Code(
        question=rf"Find all torsal rulings of <i>{title}</i> in the gallery and give their $t$ as "
        "an array, in increasing order.",
        starter=f"from ruledlab.geometry import gallery, special_rulings\n\n"
        f'surface = gallery.surface("{key}")\nvalue = ...',
        answer=answer,
        label="t =",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "δ for its zeros",
                surface.invariants(answer + 0.05).delta,
                r"These are values of $\delta$ at some places, not the places where it is zero.",
            ),
        ),
        hints=(
            "special_rulings(surface) returns all kinds of special rulings at once.",
            "Its torsal, cylindrical, developable and cylinders say where each kind is.",
        ),
        solution=f'<pre>value = special_rulings(gallery.surface("{key}")).torsal</pre>'
        f"There are {len(answer)}: {', '.join(f'{t:.6f}' for t in answer)}.",
    )


# -- find the slip ---------------------------------------------------------------------------------

EQUATIONS = (
    (r"$\mathbf X_1'=\hat\kappa\mathbf X_2$", r"$\mathbf X_2$ is defined by it, (3)."),
    (
        r"$\mathbf X_2'=-\hat\kappa\mathbf X_1+\hat\tau\mathbf X_3$",
        r"$\langle\mathbf X_2',\mathbf X_1\rangle=-\langle\mathbf X_2,\mathbf X_1'\rangle="
        r"-\hat\kappa$, and $\langle\mathbf X_2',\mathbf X_3\rangle=\hat\tau$.",
    ),
    (
        r"$\mathbf X_3'=-\hat\tau\mathbf X_2$",
        r"$\langle\mathbf X_3',\mathbf X_2\rangle=-\langle\mathbf X_3,\mathbf X_2'\rangle="
        r"-\hat\tau$.",
    ),
    (
        r"$\mathbf m'=\bar\tau\mathbf x_1+\bar\kappa\mathbf x_3$",
        r"this is (7): the striction curve never moves along $\mathbf x_2$.",
    ),
)
SPOILT = {
    1: r"$\mathbf X_2'=\hat\kappa\mathbf X_1+\hat\tau\mathbf X_3$",
    2: r"$\mathbf X_3'=\hat\tau\mathbf X_2$",
    3: r"$\mathbf m'=\bar\kappa\mathbf x_1+\bar\tau\mathbf x_3$",
}
WHY = {
    1: r"The matrix of a turning orthonormal frame is skew: $+\hat\kappa$ above the diagonal means "
    r"$-\hat\kappa$ below it. With $+\hat\kappa$ the lengths would not stay 1.",
    2: r"The matrix of a turning orthonormal frame is skew: $+\hat\tau$ above the diagonal means "
    r"$-\hat\tau$ below it.",
    3: r"The frame turns about $\mathbf x_1$ with $\tau$ and slides along it with its dual part "
    r"$\bar\tau$; about and along $\mathbf x_3$ it is $\kappa$ and $\bar\kappa$.",
}


def frame_slip(draw: Draw) -> FindSlip:
    """Ask for the slip in the frame equations."""
    wrong = draw.one_of((1, 2, 3))
    right, other = EQUATIONS[wrong][0], _negated(wrong)
    options = (
        Option(right, WHY[wrong], right=True),
        Option(other, r"Now too much has changed its sign: " + WHY[wrong]),
        Option(SPOILT[wrong], "This is the line with the slip itself."),
    )
    return FindSlip(
        question="One of these equations has a slip. Which?",
        lines=tuple(
            Line(SPOILT[wrong]) if i == wrong else Line(text, word)
            for i, (text, word) in enumerate(EQUATIONS)
        ),
        then=Choose(
            question="What should stand there?",
            solution="",
            options=options,
            order=draw.shuffled(len(options)),
        ),
        hints=(
            r"$\langle\mathbf X_i,\mathbf X_j\rangle$ is constant. Differentiate.",
            "So the matrix of the frame equations is skew. Compare each entry with its mirror "
            "image.",
            r"And $\mathbf m'$ is the dual part of the same motion: $\bar\tau$ goes with "
            r"$\mathbf x_1$ as $\tau$ does.",
        ),
        solution=f"{right}. {WHY[wrong]}",
    )


def _dual(real: int, part: int) -> str:
    return combination((real, ""), (part, r"\,\varepsilon"))


def _negated(wrong: int) -> str:
    return {
        1: r"$\mathbf X_2'=-\hat\kappa\mathbf X_1-\hat\tau\mathbf X_3$",
        2: r"$\mathbf X_3'=-\hat\kappa\mathbf X_1-\hat\tau\mathbf X_2$",
        3: r"$\mathbf m'=-\bar\tau\mathbf x_1-\bar\kappa\mathbf x_3$",
    }[wrong]


EXERCISES = (
    Exercise("04.1", "What is zero on a torsal ruling", torsal),
    Exercise("04.2", "κ and δ on a ring", curvature_and_delta),
    Exercise("04.3", "Every line turned round", reversal),
    Exercise("04.4", "δ as a formula", distribution),
    Exercise("04.5", "A spiral across the equator", spiral),
    Exercise("04.6", "The pitch of the screw", screw_pitch),
    Exercise("04.7", "The dual torsion of a ring", dual_torsion),
    Exercise("04.8", "Make a ruling torsal", make_torsal),
    Exercise("04.9", "Six become three", touch),
    Exercise("04.10", "Bend to both sides", straighten),
    Exercise("04.11", "Special rulings in three lines", print_special),
    Exercise("04.12", "A slip in the frame equations", frame_slip),
)
"""The exercises in their order."""
