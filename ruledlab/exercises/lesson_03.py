"""Exercises of lesson 03: a line that moves, its base curves and its striction curve."""

from __future__ import annotations

import math

import numpy as np

from ..design import Design
from ..geometry.checks import Array
from ..geometry.surface import RuledSurface
from ..geometry.vector import vector
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
from .designs import at_least
from .tex import times

__all__ = ["EXERCISES"]

LOST = "base curve taken for the striction curve"
STRICTION = (
    r"$\mathbf m=\mathbf c-\dfrac{\langle\mathbf x',\mathbf c'\rangle}"
    r"{\langle\mathbf x',\mathbf x'\rangle}\,\mathbf x$"
)


# -- choose ----------------------------------------------------------------------------------------


def developable(draw: Draw) -> Choose:
    """Ask which surface is developable."""
    options = (
        Option(
            "the tangents of a helix",
            r"Here $\mathbf x$ is the tangent of $\mathbf c$, so that neighbouring rulings come "
            r"nearer to each other than any multiple of $h$: $\delta=0$, the surface is "
            "developable, and the helix is its striction curve.",
            right=True,
        ),
        Option(
            "the right helicoid",
            r"A ruling climbs by $p$ for each radian that it turns: $\delta=p\neq0$. Being ruled "
            "is not enough for being developable.",
            slip="ruled taken for developable",
        ),
        Option(
            "the hyperboloid of one sheet",
            "It has even two families of rulings, but neighbours of one family are skew: "
            r"$\delta=r\cot\alpha\neq0$, and $K<0$ everywhere.",
            slip="ruled taken for developable",
        ),
        Option(
            "Plücker's conoid",
            r"Only four of its rulings are torsal: $\delta=2\cos2u$ vanishes there and nowhere "
            r"else. Developable means $\delta=0$ at every ruling.",
            slip="a torsal ruling taken for all",
        ),
    )
    return Choose(
        question="Only one of these ruled surfaces can be unrolled into a plane. Which?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Developable means $\bar\kappa=0$, that is $\delta=0$, for every $t$.",
            "Where do neighbouring rulings (nearly) meet? Try each of them in the picture above.",
        ),
        solution=r"The tangents of a curve: $\mathbf x=\mathbf c'/\|\mathbf c'\|$ gives "
        r"$[\mathbf c',\mathbf x,\mathbf x']=0$, and this is $\kappa\bar\kappa$.",
    )


def another_base(draw: Draw) -> Choose:
    """Ask what another base curve changes."""
    options = (
        Option(
            r"nothing but $\mathbf c$ itself",
            r"$\bar{\mathbf x}=(\mathbf c+s\,\mathbf x)\times\mathbf x=\mathbf c\times\mathbf x$: "
            "the dual vector, and with it the frame, all of the invariants and the striction "
            "curve, stays as it is.",
            right=True,
        ),
        Option(
            r"$\bar{\mathbf x}$, and so $\bar\kappa$ and $\delta$; not $\kappa$",
            r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$ contains $\mathbf c$, but sliding it "
            r"along $\mathbf x$ adds $s\,\mathbf x\times\mathbf x=0$.",
            slip="the moment taken to depend on the point",
        ),
        Option(
            r"the striction curve: it slides by $s$ as well",
            r"In $\mathbf m=\mathbf c-\ldots$ both terms change, by $s\,\mathbf x$ and by "
            r"$-s\,\mathbf x$. The striction curve belongs to the surface, not to $\mathbf c$.",
            slip=LOST,
        ),
        Option(
            r"$\kappa$ and $\tau$",
            r"These belong to the directions $\mathbf x(t)$ alone, which have not changed.",
        ),
    )
    return Choose(
        question=r"You replace the base curve $\mathbf c(t)$ by "
        r"$\mathbf c(t)+s(t)\,\mathbf x(t)$ with any function $s$, and keep $\mathbf x(t)$. "
        "What changes?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            r"Compute $\bar{\mathbf x}=\mathbf c\times\mathbf x$ for the new base curve.",
            "Move the slider $s$ in the picture above and watch the numbers.",
        ),
        solution=r"$(\mathbf c+s\,\mathbf x)\times\mathbf x=\mathbf c\times\mathbf x$. The curve "
        r"$\mathbf X(t)$ on the dual unit sphere is the same, and so is all that is computed from "
        "it.",
    )


# -- predict a number ------------------------------------------------------------------------------


def striction_point(draw: Draw) -> Number:
    """Ask for a striction point of a hyperboloid with a circle off its waist."""
    r, n, a, q = draw.integer(2, 4), draw.integer(1, 3), draw.integer(1, 2), draw.integer(1, 2)
    way = np.array([a, 0.0, 1.0])  # of length √(1 + a²), along the ruling t = π/2
    value = np.array([0.0, r, q])
    base = value + n * way
    k, na, root = times(a), times(n * a), rf"\sqrt{{{1 + a * a}}}"
    return Number(
        question=rf"$\mathbf c=({r}\cos t+{na}\sin t,\ {r}\sin t-{na}\cos t,\ {n + q})$ and "
        rf"$\mathbf x=({k}\sin t,\ -{k}\cos t,\ 1)/{root}$. "
        r"Where is the striction point of the ruling $t=\tfrac\pi2$?",
        answer=value,
        label="m =",
        unit="length",
        slips=(
            known.mistaken_for(
                LOST,
                base,
                r"This is the base point $\mathbf c$. It is one point of the ruling like any "
                "other; the striction point is where the neighbour comes nearest.",
            ),
            known.mistaken_for(
                "sign of the way to m",
                base + n * way,
                r"You went the right way in the wrong sense: there is a minus sign in "
                r"$\mathbf m=\mathbf c-\ldots$",
            ),
            known.mistaken_for(
                "foot point taken for the striction point",
                base - (base @ way) / (way @ way) * way,
                r"This is the foot point $\mathbf x\times\bar{\mathbf x}$, nearest to the "
                "<i>origin</i>. The striction point is nearest to the neighbouring ruling.",
            ),
            known.mistaken_for(
                "quotient upside down",
                base - way / (n * (way @ way)),
                r"The quotient is upside down: $\langle\mathbf x',\mathbf c'\rangle$ stands above, "
                r"$\langle\mathbf x',\mathbf x'\rangle$ below.",
            ),
        ),
        because=r"It lies on the waist circle of this hyperboloid.",
        hints=(
            STRICTION + ".",
            rf"At $t=\tfrac\pi2$: $\mathbf x'=(0,{a},0)/{root}$ and "
            rf"$\mathbf c'=(-{r},{n * a},0)$.",
            rf"The quotient is ${times(n)}{root}$.",
        ),
        solution=rf"The quotient is ${times(n)}{root}$ and $\mathbf m=({n * a},{r},{n + q})-"
        rf"{times(n)}\,({a},0,1)=(0,{r},{q})$: a point of the waist circle of this hyperboloid.",
    )


def neighbour(draw: Draw) -> Number:
    """Ask for the distance of a neighbouring ruling."""
    kappa, delta = draw.one_of((2.0, 3.0, 4.0)), draw.one_of((0.3, 0.6, 0.7))
    value = delta * kappa * 0.01
    return Number(
        question=rf"At some $t$ a ruling has $\kappa={kappa:g}$ and $\delta={delta:g}$. About how "
        "far is the shortest way from it to the ruling at $t+0.01$?",
        answer=value,
        label="d ≈",
        unit="length",
        tolerance=2e-2,
        slips=(
            known.mistaken_for(
                "δ taken per t",
                delta * 0.01,
                r"$\delta$ is the distance for each <i>radian</i> of turning. In $h$ the ruling "
                r"turns by $\kappa h$.",
            ),
            known.mistaken_for(
                "angle for distance",
                kappa * 0.01,
                r"This is the angle $\kappa h$ between the two; the distance is $\delta$ times it.",
            ),
        ),
        because=r"The angle is about $\kappa h$, the distance $\bar\kappa h=\delta\kappa h$.",
        hints=(
            r"By what angle does the ruling turn while $t$ grows by 0.01? And how far does it move "
            "aside for each radian?",
            r"The dual angle of $\mathbf X(t)$ and $\mathbf X(t+h)$ is about $\hat\kappa\,h$.",
            r"Its dual part is $\bar\kappa h$, and $\bar\kappa=\delta\kappa$.",
        ),
        solution=rf"$d\approx\bar\kappa h=\delta\kappa h={delta:g}\cdot{kappa:g}\cdot0.01="
        rf"{value:g}$.",
    )


# -- a formula -------------------------------------------------------------------------------------


def helicoid(draw: Draw) -> Formula:
    """Ask for δ of an oblique helicoid."""
    k = draw.integer(2, 4)
    names, box = ("p", "v"), ((0.2, 2.0), (0.4, 1.4))
    return Formula(
        question=rf"An oblique helicoid: $\mathbf c=(0,0,{k}p\,t)$ and "
        r"$\mathbf x=(\cos t\sin v,\ \sin t\sin v,\ \cos v)$ with constants $p$ and $v$. "
        r"Write its distribution parameter $\delta$.",
        answer=f"{k}*p",
        variables=names,
        box=box,
        label="δ =",
        slips=(
            known.formula(
                "κ̄ for δ",
                f"{k}*p*sin(v)",
                r"This is $\bar\kappa$. Divide by $\kappa=\sin v$.",
                names,
                box,
            ),
            known.formula(
                "κκ̄ for δ",
                f"{k}*p*sin(v)**2",
                r"This is $\langle\mathbf x',\bar{\mathbf x}'\rangle=\kappa\bar\kappa$. Divide by "
                r"$\kappa^2=\sin^2v$.",
                names,
                box,
            ),
        ),
        because="The slant of the rulings does not matter: the climb for each radian does.",
        hints=(
            r"$\delta=\bar\kappa/\kappa=\langle\mathbf x',\bar{\mathbf x}'\rangle/"
            r"\langle\mathbf x',\mathbf x'\rangle$ with "
            r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$.",
            r"Or $\kappa\bar\kappa=[\mathbf c',\mathbf x,\mathbf x']$, a determinant.",
            r"$\kappa=\sin v$.",
        ),
        solution=rf"$[\mathbf c',\mathbf x,\mathbf x']={k}p\sin^2v$ and $\kappa^2=\sin^2v$, so "
        rf"$\delta={k}p$ for every slant $v$.",
    )


def paraboloid(draw: Draw) -> Formula:
    """Ask for δ of a hyperbolic paraboloid."""
    k = draw.integer(2, 4)
    box = ((-1.5, 1.5),)
    return Formula(
        question=rf"The paraboloid $z={k}xy$ is $\mathbf c=(t,0,0)$ with rulings along "
        rf"$(0,1,{k}t)$, a direction that is not yet of length 1. Write $\delta(t)$.",
        answer=f"(1 + {k * k}*t**2)/{k}",
        variables=("t",),
        box=box,
        label="δ(t) =",
        slips=(
            known.formula(
                "direction not normalised",
                f"1/{k}",
                r"This comes out if $(0,1,kt)$ is taken for $\mathbf x$. The definitions need "
                r"$\|\mathbf x\|=1$: divide by the length first, and then differentiate.",
                ("t",),
                box,
            ),
            known.formula(
                "δ inverted",
                f"{k}/(1 + {k * k}*t**2)",
                r"This is $\kappa/\bar\kappa$ (and $\kappa$ itself). $\delta=\bar\kappa/\kappa$.",
                ("t",),
                box,
            ),
        ),
        hints=(
            rf"$\mathbf x=(0,1,{k}t)/\sqrt{{1+{k * k}t^2}}$. What is $\|\mathbf x'\|$?",
            rf"The direction makes the angle $\arctan({k}t)$ with the $y$-axis, so "
            rf"$\kappa={k}/(1+{k * k}t^2)$.",
            r"$\mathbf c'=(1,0,0)$ is perpendicular to all rulings, so $\bar\kappa=1$.",
        ),
        solution=rf"$\kappa={k}/(1+{k * k}t^2)$ and $\bar\kappa=1$, so "
        rf"$\delta=(1+{k * k}t^2)/{k}$.",
    )


# -- sketch ----------------------------------------------------------------------------------------


def way_to_striction(draw: Draw) -> Sketch:
    """Ask how far the striction curve is from an ellipse that might be taken for it."""
    a, b = draw.one_of(((3, 1), (1, 3), (2, 1), (1, 2), (3, 2), (2, 3)))
    side = draw.one_of((1, -1))
    part = side * (a - b)  # ⟨x′, c′⟩ is this times sin t cos t / √2

    def way(t: Array) -> Array:
        return np.asarray(-part * np.sin(2 * t) / math.sqrt(2))

    minus, plus = ("-", "") if side > 0 else ("", "-")
    return Sketch(
        question=rf"The rulings start on an ellipse, $\mathbf c=({times(a)}\cos t,\ {times(b)}"
        rf"\sin t,\ 0)$, and rise evenly, $\mathbf x=({minus}\sin t,\ {plus}\cos t,\ 1)/\sqrt2$. "
        r"On each of them the striction point is $\mathbf m=\mathbf c+\mu\,\mathbf x$. Sketch "
        r"$\mu$ over one turn, $t$ from $0$ to $2\pi$.",
        curve=way,
        heights=(-1.1 * abs(part), 1.1 * abs(part)),
        span=(0.0, 2 * math.pi),
        label="μ",
        because="Only in its four vertices does the striction curve meet the ellipse, a base curve "
        "like any other. On a circle μ would be zero all along: the waist of a hyperboloid.",
        hints=(
            r"Where on the ellipse is its tangent $\mathbf c'$ perpendicular to $\mathbf x'$? "
            r"There $\mu=0$.",
            rf"$\mathbf x'=({minus}\cos t,\ {minus}\sin t,\ 0)/\sqrt2$. The tangent is at right "
            r"angles to it at $t=0,\tfrac\pi2,\pi,\tfrac{3\pi}2$, in the vertices of the ellipse, "
            "and nowhere else.",
            r"The sign between them: at $t=\tfrac\pi4$ you find "
            rf"$\langle\mathbf x',\mathbf c'\rangle={part}/\sqrt8$, and "
            r"$\mu=-\langle\mathbf x',\mathbf c'\rangle/\langle\mathbf x',\mathbf x'\rangle$.",
        ),
        solution=rf"$\langle\mathbf x',\mathbf c'\rangle={times(part)}\sin t\cos t/\sqrt2$ and "
        rf"$\langle\mathbf x',\mathbf x'\rangle=\tfrac12$, so $\mu={times(-part)}\sin2t/\sqrt2$: "
        "zero in the four vertices of the ellipse, and by turns positive and negative between "
        "them.",
    )


# -- a design --------------------------------------------------------------------------------------


def unrolled(draw: Draw) -> Drag:
    """Ask for a developable that is no cone."""
    p = draw.one_of((0.4, 0.6, 0.8))
    points = ((0.0, math.pi / 4), (2 * math.pi, math.pi / 4))
    start = Design(points, f"{p:g}*u", "0", name="oblique helicoid")
    model = start.with_(vbar=f"-{p:g}", name="tangents of a helix")
    return Drag(
        question=rf"This oblique helicoid, $\bar u={p:g}\,u$ and $\bar v=0$ at the colatitude "
        r"$v=\tfrac\pi4$, is not developable. Make it so: $\delta=0$ all along. The striction "
        r"curve shall still be a curve, not a point. (Change $\bar v$, or whatever you like.)",
        start=start,
        model=model,
        conditions=_unrolled,
        fields=True,
        plots=("delta", "tau_bar"),
        slips=(
            Misconception(
                "a cone",
                _is_cone,
                "A cone is developable, but its striction curve is one point, the apex. Let the "
                "rulings climb, and give them a distance from the axis that makes up for it.",
                start.with_(ubar="1"),
            ),
        ),
        because="The rulings are the tangents of their striction curve now: a helix.",
        hints=(
            r"With $v$ constant, $\kappa\bar\kappa=u'^2\sin v\,(\bar v\cos v+\bar u_u\sin v)$.",
            r"At $v=\tfrac\pi4$ sine and cosine are equal: which $\bar v$ cancels $\bar u_u$?",
            rf"$\bar u_u={p:g}$.",
        ),
        solution=rf"$\bar v=-\bar u_u\tan v=-{p:g}$ is shown in the chart now: the tangents of a "
        rf"helix on the cylinder of radius {p:g}.",
    )


def _sizes(made: Made) -> tuple[float, float]:
    """Return the largest |δ| and the length of the striction curve."""
    t = np.linspace(*made.surface.domain, 201)
    found = made.surface.invariants(t)
    delta = np.abs(found.delta[np.isfinite(found.delta)])
    largest = float(delta.max()) if delta.size else math.nan
    speed = np.nan_to_num(np.hypot(found.kappa_bar, found.tau_bar))
    return largest, float(np.trapezoid(speed, t))


def _is_cone(made: Made) -> bool:
    largest, length = _sizes(made)
    return largest <= 0.02 and length < 0.5


def _unrolled(made: Made) -> tuple[Condition, ...]:
    largest, length = _sizes(made)
    why = "nothing turns" if math.isnan(largest) else rf"now up to $|\delta|={largest:.3f}$"
    return (
        Condition(r"developable: $\delta=0$ everywhere", largest, 0.02, "length", why),
        at_least("a striction curve at least 0.5 long", length, 0.5, "length"),
    )


# -- Python ----------------------------------------------------------------------------------------


def from_base(draw: Draw) -> Code:
    """Ask for δ of a surface from a base curve."""
    k, place = draw.integer(2, 4), draw.one_of((0.5, 1.0, 1.5))
    base, across = "cos(t), sin(t), t", f"sin(t), 0, {k}"
    surface = RuledSurface.from_base(vector(base), vector(across), (0.0, 2.0))
    return Code(
        question=rf"A helix $\mathbf c=(\cos t,\sin t,t)$ with rulings along "
        rf"$(\sin t,0,{k})$, for $0\le t\le2$. Compute $\delta$ at $t={place:g}$.",
        starter="import numpy as np\nfrom ruledlab import RuledSurface\n\n"
        "surface = RuledSurface.from_base(..., ..., domain=(0, 2))\nvalue = ...",
        answer=surface.invariants(place).delta,
        label="δ =",
        unit="length",
        tolerance=1e-6,
        slips=(
            known.delta_inverted(float(surface.invariants(place).delta)),
            known.mistaken_for(
                "κ̄ for δ",
                surface.invariants(place).kappa_bar,
                r"This is $\bar\kappa$. Divide by $\kappa$, or ask for .delta.",
            ),
        ),
        hints=(
            "from_base takes two functions of t: the base curve, and the direction, which it "
            "makes a unit vector itself.",
            "lambda t: (np.cos(t), np.sin(t), t) is the base curve. The functions of numpy carry "
            "the derivatives along.",
            f"surface.invariants({place:g}).delta",
        ),
        solution="<pre>surface = RuledSurface.from_base(\n"
        "    lambda t: (np.cos(t), np.sin(t), t),\n"
        f"    lambda t: (np.sin(t), 0, {k}), domain=(0, 2))\n"
        f"value = surface.invariants({place:g}).delta</pre>",
    )


def from_lines(draw: Draw) -> Code:
    """Ask for δ of a conoid from a dual curve."""
    k, place = draw.integer(2, 4), draw.one_of((0.1, 0.2, 0.3))
    return Code(
        question=r"A curve on the dual unit sphere: $\mathbf X=(\cos\hat t,\sin\hat t,0)$ with "
        rf"$\hat t=t+\varepsilon\sin{k}t$, for $0\le t\le1$. Compute $\delta$ at $t={place:g}$.",
        starter="import numpy as np\nfrom ruledlab import Dual, RuledSurface\n\n"
        "surface = RuledSurface.from_lines(..., domain=(0, 1))\nvalue = ...",
        answer=k * math.cos(k * place),
        label="δ =",
        unit="length",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "height for δ",
                math.sin(k * place),
                r"This is $\bar t$, the height of the ruling. $\delta$ is how fast it changes.",
            ),
            known.mistaken_for(
                "inner factor forgotten",
                math.cos(k * place),
                rf"The derivative of $\sin {k}t$ is ${k}\cos {k}t$.",
            ),
        ),
        hints=(
            "from_lines takes one function of t that returns the three components of X.",
            f"Dual(t, np.sin({k}*t)) is t̂, and np.cos and np.sin take it.",
            rf"Or by hand: $\hat\kappa=\hat t'=1+\varepsilon\,{k}\cos{k}t$.",
        ),
        solution="<pre>surface = RuledSurface.from_lines(\n"
        f"    lambda t: (np.cos(Dual(t, np.sin({k}*t))), np.sin(Dual(t, np.sin({k}*t))), 0),\n"
        f"    domain=(0, 1))\nvalue = surface.invariants({place:g}).delta</pre>"
        rf"By hand: $\hat\kappa=\hat t'$, so $\delta=\bar t'={k}\cos{k}t$.",
    )


# -- find the slip ---------------------------------------------------------------------------------


def lost_curve(draw: Draw) -> FindSlip:
    """Ask where the base curve was taken for the striction curve."""
    r, p = draw.integer(2, 4), draw.integer(2, 3)
    return FindSlip(
        question="Where does a ruling come nearest to its neighbours? One step of this reasoning "
        "is wrong.",
        lines=(
            Line(
                rf"$\mathbf c=({r}\cos t,{r}\sin t,{p}t)$ and $\mathbf x=(\cos t,\sin t,0)$ make a "
                "right helicoid.",
                r"all rulings are horizontal, meet the $z$-axis and climb evenly.",
            ),
            Line(
                r"The rulings at $t$ and at $t+h$ enclose the angle $h$.",
                r"$\langle\mathbf x(t),\mathbf x(t+h)\rangle=\cos h$.",
            ),
            Line(
                r"They come nearest to each other on the base curve, at $\mathbf c(t)$ and "
                r"$\mathbf c(t+h)$.",
            ),
            Line(
                rf"Their shortest distance is ${p}h$, and so $\delta={p}$.",
                rf"both are horizontal, one ${p}h$ above the other; no other distance is shorter.",
            ),
        ),
        then=Number(
            question=r"At which $w$, measured from $\mathbf c$ along $\mathbf x$, is it really?",
            solution="",
            answer=-float(r),
            label="w =",
            unit="length",
            slips=(
                known.mistaken_for(
                    "sign of the way to m",
                    float(r),
                    r"The axis lies on the other side of $\mathbf c$: "
                    r"$w=-\langle\mathbf x',\mathbf c'\rangle/"
                    r"\langle\mathbf x',\mathbf x'\rangle$.",
                ),
                known.mistaken_for(
                    LOST,
                    0.0,
                    r"That is the base curve again: a helix on a cylinder around the axis.",
                ),
            ),
            because=r"There lies the striction curve: the axis.",
        ),
        hints=(
            rf"How far apart are $\mathbf c(t)$ and $\mathbf c(t+h)$? Compare with ${p}h$.",
            "The common perpendicular of two horizontal lines is vertical. Where do the two "
            "rulings lie one above the other?",
            STRICTION + ".",
        ),
        solution=r"The rulings come nearest on the <i>striction</i> curve, and $\mathbf c$ is "
        rf"another one: $\langle\mathbf x',\mathbf c'\rangle={r}$ and "
        rf"$\langle\mathbf x',\mathbf x'\rangle=1$, so it lies at $w=-{r}$, on the axis. The "
        rf"points $\mathbf c(t)$ and $\mathbf c(t+h)$ are farther apart than ${p}h$.",
    )


EXERCISES = (
    Exercise("03.1", "What can be unrolled", developable),
    Exercise("03.2", "Another base curve", another_base),
    Exercise("03.3", "A striction point", striction_point),
    Exercise("03.4", "How far is the neighbour?", neighbour),
    Exercise("03.5", "An oblique helicoid", helicoid),
    Exercise("03.6", "A paraboloid", paraboloid),
    Exercise("03.7", "Unroll it", unrolled),
    Exercise("03.8", "A base curve in three lines", from_base),
    Exercise("03.9", "A dual curve in three lines", from_lines),
    Exercise("03.10", "A slip on a helicoid", lost_curve),
    Exercise("03.11", "Rulings on an ellipse", way_to_striction),
)
"""The exercises in their order."""
