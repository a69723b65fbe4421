"""Exercises of lesson 01: the ring of dual numbers, and functions of them."""

from __future__ import annotations

import math

import numpy as np

from ..geometry import Dual, function
from ..geometry.checks import Array
from . import misconceptions as known
from .core import Choose, Code, Draw, Exercise, FindSlip, Formula, Line, Number, Option, Sketch
from .tex import dual

__all__ = ["EXERCISES"]

PAIR = "Give real and dual part, such as [2, -5], or write 2 - 5 eps."
BOX = ((-2.0, 2.0), (-2.0, 2.0))


# -- numbers ---------------------------------------------------------------------------------------


def product(draw: Draw) -> Number:
    """Ask for a product."""
    a, a_ = draw.integer(2, 4), draw.one_of((5, 7))
    b, b_ = draw.integer(2, 4), -draw.one_of((1, 3))  # the dual part is never 0
    real, part = a * b, a * b_ + a_ * b
    return Number(
        question=rf"Multiply out: $({dual(a, a_)})({dual(b, b_)})$. {PAIR}",
        answer=[real, part],
        label="[a, ā] =",
        slips=(
            known.mistaken_for(
                "dual parts multiplied",
                [real, a_ * b_],
                rf"The product of the dual parts carries $\varepsilon^2$ and is gone. The dual "
                rf"part is $a\bar b+\bar a b$: here ${a}\cdot({b_})$ and ${a_}\cdot{b}$.",
            ),
            *(
                known.mistaken_for(
                    f"only {kept} multiplied",
                    [real, half],
                    r"Two terms carry $\varepsilon$, and one of them is missing: the dual part is "
                    rf"$a\bar b+\bar a b$, here ${a}\cdot({b_})$ and ${a_}\cdot{b}$.",
                )
                for kept, half in (("a b̄", a * b_), ("ā b", a_ * b))
            ),
            known.mistaken_for(
                "ε² = 1",
                [real + a_ * b_, part],
                r"The term $\varepsilon^2\,\bar a\bar b$ has gone into the real part, as if "
                r"$\varepsilon^2$ were 1. It is 0.",
            ),
            known.mistaken_for(
                "ε² = −1",
                [real - a_ * b_, part],
                r"This is how complex numbers multiply, with $i^2=-1$. Here $\varepsilon^2=0$.",
            ),
        ),
        because=r"$AB=ab+\varepsilon(a\bar b+\bar a b)$.",
        hints=(
            "Multiply out as usual: four terms.",
            r"The term with $\varepsilon^2$ is zero. Two terms carry $\varepsilon$.",
            rf"The dual part is ${a}\cdot({b_})+{a_}\cdot{b}$.",
        ),
        solution=rf"$({dual(a, a_)})({dual(b, b_)})={real}+\varepsilon\,({a}\cdot({b_})"
        rf"+{a_}\cdot{b})={dual(real, part)}$.",
    )


def inverse(draw: Draw) -> Number:
    """Ask for an inverse."""
    a, a_ = draw.one_of((2, 4, 5)), draw.one_of((3, -3, 7))
    real, part = 1 / a, -a_ / a**2
    return Number(
        question=rf"Find the inverse of ${dual(a, a_)}$: the dual number whose product with it is "
        f"1. {PAIR}",
        answer=[real, part],
        label="[a, ā] =",
        slips=(
            known.mistaken_for(
                "inverted part by part",
                [real, 1 / a_],
                r"Each part was inverted for itself. Multiply it with the given number: the "
                r"product is not 1.",
            ),
            known.mistaken_for(
                "sign of the inverse",
                [real, -part],
                rf"Multiply: the dual part of the product is ${2 * a_ / a:g}$, it should be 0. The "
                "dual part of the inverse has the other sign.",
            ),
            known.mistaken_for(
                "conjugate for inverse",
                [a, -a_],
                rf"The product with it is $a^2={a**2}$, not 1: divide both parts by that.",
            ),
            known.mistaken_for(
                "divided once",
                [real, -a_ / a],
                r"$(a+\varepsilon\bar a)(a-\varepsilon\bar a)=a^2$, so both parts of "
                r"$a-\varepsilon\bar a$ have to be divided by $a^2$.",
            ),
        ),
        because=r"$\dfrac1{a+\varepsilon\bar a}=\dfrac1a-\varepsilon\dfrac{\bar a}{a^2}$.",
        hints=(
            r"Write the inverse as $b+\varepsilon\bar b$, multiply out, compare both parts.",
            r"$ab=1$ and $a\bar b+\bar a b=0$.",
            r"$b=\frac1a$ and $\bar b=-\frac{\bar a}{a^2}$. A formula such as 1/4 will do.",
        ),
        solution=rf"$\dfrac1{{{dual(a, a_)}}}=\dfrac{{{dual(a, -a_)}}}{{{a**2}}}$, that is "
        rf"$[{real:g},\ {part:g}]$.",
    )


def dual_sine(draw: Draw) -> Number:
    """Ask for the sine of a dual angle."""
    below, distance = draw.one_of((3, 6)), draw.one_of((2, 3, 5))
    angle, tex = math.pi / below, rf"\tfrac\pi{below}"
    sine, part = math.sin(angle), distance * math.cos(angle)
    return Number(
        question=rf"Two lines form the angle $\theta={tex}$ and have the distance $d={distance}$. "
        rf"What is $\sin(\theta+\varepsilon d)$? {PAIR}",
        answer=[sine, part],
        label="[real, dual] =",
        slips=(
            known.mistaken_for(
                "d forgotten",
                [sine, math.cos(angle)],
                r"This is $\sin(\theta+\varepsilon)$. The dual part of the argument is a factor: "
                r"$\varepsilon\,d\cos\theta$.",
            ),
            known.mistaken_for(
                "part by part",
                [sine, math.sin(distance)],
                r"This is $\sin\theta+\varepsilon\sin d$. A function is not applied to each part: "
                r"$d$ is a length, and a length has no sine. The tangent of the sine carries it.",
            ),
            known.mistaken_for(
                "function for derivative",
                [sine, distance * sine],
                r"The dual part needs the <i>slope</i> of the sine, $\cos\theta$.",
            ),
        ),
        because=r"$\sin(\theta+\varepsilon d)=\sin\theta+\varepsilon\,d\cos\theta$.",
        hints=(
            r"$f(x+\varepsilon\bar x)=f(x)+\varepsilon\,\bar x\,f'(x)$ with $f=\sin$.",
            rf"The slope of the sine at ${tex}$ is $\cos{tex}$.",
            f"A formula will do: write [sin(pi/{below}), {distance}*cos(pi/{below})].",
        ),
        solution=rf"$\sin{tex}+\varepsilon\,{distance}\cos{tex}$, that is "
        rf"$[{sine:.6f},\ {part:.6f}]$.",
    )


def from_one_value(draw: Draw) -> Number:
    """Ask for another value of a function that is known at one dual number."""
    x, step, slope = draw.integer(2, 5), draw.integer(2, 4), draw.one_of((4, -5, 6))
    value, other = draw.integer(5, 9), draw.one_of((-3, 5))
    return Number(
        question=rf"Of a function $f$ nothing is known but $f({dual(x, step)})="
        rf"{dual(value, step * slope)}$. What is $f({dual(x, other)})$? {PAIR}",
        answer=[value, other * slope],
        label="[real, dual] =",
        slips=(
            known.mistaken_for(
                "dual part taken for the slope",
                [value, other * step * slope],
                rf"You took ${step * slope}$ for $f'({x})$. It is "
                rf"$\bar x\,f'({x})={step}\,f'({x})$.",
            ),
            known.mistaken_for(
                "slope for dual part",
                [value, slope],
                rf"This is $f({x}+\varepsilon)$: the dual part is the slope times the new "
                rf"$\bar x={other}$.",
            ),
        ),
        because="One value at one dual number tells them all over the same real number: "
        "they lie on one tangent.",
        hints=(
            rf"Which two numbers does $f({dual(x, step)})$ tell?",
            rf"$f({x})={value}$ and ${step}\,f'({x})={step * slope}$.",
            rf"$f'({x})={slope}$; multiply by the new dual part.",
        ),
        solution=rf"$f({x})={value}$, $f'({x})={slope}$, so $f({dual(x, other)})="
        rf"{dual(value, other * slope)}$.",
    )


# -- choose ----------------------------------------------------------------------------------------


def no_inverse(draw: Draw) -> Choose:
    """Ask which dual number has no inverse."""
    k = draw.integer(2, 5)
    options = (
        Option(
            rf"$(1+\varepsilon)-(1-{k}\varepsilon)$",
            rf"It is ${k + 1}\,\varepsilon$, a pure dual number: its product with any $X$ has the "
            "real part 0 and is never 1.",
            right=True,
        ),
        Option(
            rf"$(2+{k}\varepsilon)(2-{k}\varepsilon)$",
            r"It is 4, with the inverse $\tfrac14$: the two factors are each other's conjugates.",
        ),
        Option(
            rf"$({dual(1, -k)})^2$",
            rf"It is $1-{2 * k}\varepsilon$ and has the inverse $1+{2 * k}\varepsilon$. A product "
            "of numbers with inverses has one, too.",
        ),
        Option(
            r"$-1+\varepsilon$",
            r"Its inverse is $-1-\varepsilon$. That the parts add up to 0 means nothing.",
            slip="parts added",
        ),
        Option(
            rf"$1+{10**k}\,\varepsilon$",
            r"However large the dual part is, the inverse is $1-\varepsilon\bar a$. Only the real "
            "part decides.",
            slip="ε taken for a number",
        ),
    )
    return Choose(
        question="Which of these has no inverse?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Compute the real part of each.",
            r"$(a+\varepsilon\bar a)(a-\varepsilon\bar a)=a^2$: what must $a$ not be?",
            "A pure dual number has no inverse. In which one do the real parts cancel?",
        ),
        solution=rf"$(1+\varepsilon)-(1-{k}\varepsilon)={k + 1}\varepsilon$ is a pure dual number, "
        "a zero divisor. All the others have a real part other than 0.",
    )


def cancelled(draw: Draw) -> Choose:
    """Ask what follows when ε times two numbers agree."""
    options = (
        Option(
            "$x=y$",
            r"$\varepsilon X=\varepsilon x$ does not know the dual part of $X$.",
            right=True,
        ),
        Option(
            "$X=Y$",
            r"That would be dividing by $\varepsilon$, a zero divisor. Try $X=1$ and "
            r"$Y=1+\varepsilon$: $\varepsilon X=\varepsilon Y$, yet $X\neq Y$.",
            slip="cancelled a zero divisor",
        ),
        Option(
            r"$\bar x=\bar y$",
            r"Multiply out: $\varepsilon(x+\varepsilon\bar x)=\varepsilon x$. The dual part is "
            "what has disappeared.",
        ),
        Option(
            "nothing: both sides are 0",
            r"$\varepsilon$ is not zero. $\varepsilon X=\varepsilon x$ is zero only if $x$ is.",
            slip="ε taken for zero",
        ),
    )
    return Choose(
        question=r"Of $X=x+\varepsilon\bar x$ and $Y=y+\varepsilon\bar y$ you know that "
        r"$\varepsilon X=\varepsilon Y$. What follows?",
        options=options,
        order=draw.shuffled(len(options)),
        hints=(
            "Multiply out both sides.",
            r"$\varepsilon X=\varepsilon x+\varepsilon^2\bar x=\varepsilon x$.",
            r"So $\varepsilon x=\varepsilon y$. Compare both parts of these two dual numbers.",
        ),
        solution=r"$\varepsilon X=\varepsilon x$ and $\varepsilon Y=\varepsilon y$, so the real "
        "parts agree, and nothing more follows. One must not cancel a zero divisor.",
    )


# -- a formula, a sketch ---------------------------------------------------------------------------


def derivative(draw: Draw) -> Formula:
    """Ask for a dual part, which is a derivative."""
    power, k = draw.integer(2, 3), draw.integer(2, 4)
    inner, lowered = f"sin({k}*x)", f"{power}*x**{power - 1}"
    domain = ((0.2, 2.9),)
    return Formula(
        question=rf"For $f(x)=x^{power}\sin {k}x$, write the dual part of $f(x+\varepsilon)$.",
        answer=f"{lowered}*{inner} + {k}*x**{power}*cos({k}*x)",
        variables=("x",),
        box=domain,
        label="dual part =",
        slips=(
            known.formula(
                "inner slope forgotten",
                f"{lowered}*{inner} + x**{power}*cos({k}*x)",
                rf"$\sin({k}x+{k}\varepsilon)$ has the dual part ${k}\cos {k}x$: the dual part of "
                "the argument is a factor.",
                ("x",),
                domain,
            ),
            known.formula(
                "dual parts multiplied",
                f"{lowered}*{k}*cos({k}*x)",
                r"This is the product of the two dual parts. It carries $\varepsilon^2$: what is "
                r"left is $a\bar b+\bar a b$, the product rule.",
                ("x",),
                domain,
            ),
        ),
        because="The product and the chain rule have come out of the multiplication of dual "
        "numbers.",
        hints=(
            rf"Write $(x+\varepsilon)^{power}$ and $\sin({k}x+{k}\varepsilon)$ as dual numbers.",
            rf"They are $x^{power}+\varepsilon\,{power}x^{power - 1}$ and "
            rf"$\sin {k}x+\varepsilon\,{k}\cos {k}x$. Multiply.",
            r"The dual part of a product is $a\bar b+\bar a b$.",
        ),
        solution=rf"$\big(x^{power}+\varepsilon\,{power}x^{power - 1}\big)"
        rf"\big(\sin {k}x+\varepsilon\,{k}\cos {k}x\big)$ has the dual part "
        rf"${power}x^{power - 1}\sin {k}x+{k}x^{power}\cos {k}x$.".replace("x^1", "x"),
    )


def bump(draw: Draw) -> Sketch:
    """Ask for the dual part over a bump or a dent."""
    sign = draw.one_of((1, -1))
    f = function(f"{sign}*16*x**2*(1 - x)**2")

    def part(t: Array) -> Array:
        return np.asarray(f(Dual(t, 1.0)).dual)

    shape = "rises from 0 to 1 at $t=\\tfrac12$ and falls" if sign > 0 else (
        "falls from 0 to −1 at $t=\\tfrac12$ and rises"
    )  # fmt: skip
    return Sketch(
        question=rf"The function $f(t)={'' if sign > 0 else '-'}16\,t^2(1-t)^2$ {shape} back, with "
        r"level tangents at both ends. Sketch the dual part of $f(t+\varepsilon)$ over $t$, "
        "without computing.",
        curve=part,
        heights=(-4.0, 4.0),
        label="dual part",
        because="The dual part is the slope: zero where the tangent is level, and of one sign as "
        "long as $f$ goes one way.",
        hints=(
            "The dual part is the slope of the tangent.",
            "At three places the tangent is level. Which?",
            f"It is {'positive' if sign > 0 else 'negative'} in the first half and "
            f"{'negative' if sign > 0 else 'positive'} in the second.",
        ),
        solution=rf"It is $f'(t)={'' if sign > 0 else '-'}32\,t(1-t)(1-2t)$: zero at "
        r"$t=0,\tfrac12,1$, with one hill and one valley between them.",
    )


# -- find the slip ---------------------------------------------------------------------------------


def kept_square(draw: Draw) -> FindSlip:
    """Ask for the slip of one who takes ε for a small real number."""
    n = draw.integer(3, 4)
    many = math.comb(n, 2)
    rest = r"(\varepsilon b)^3" if n == 3 else r"4a(\varepsilon b)^3+(\varepsilon b)^4"
    square = "" if n == 3 else "^2"
    return FindSlip(
        question=rf"Somebody computes $(a+\varepsilon b)^{n}$. Which step is wrong?",
        lines=(
            Line(
                rf"$(a+\varepsilon b)^{n}=a^{n}+{n}a^{n - 1}\varepsilon b"
                rf"+{many}a{square}(\varepsilon b)^2+{rest}$",
                "it is the binomial theorem, which needs only that the ring is commutative.",
            ),
            Line(
                r"$\varepsilon^3=\varepsilon\cdot\varepsilon^2=0$, and so are all higher powers.",
                r"a product with the factor $\varepsilon^2=0$ is zero.",
            ),
            Line(
                r"$(\varepsilon b)^2$ may be neglected while $b$ is small. For a large $b$ it has "
                rf"to be kept, so the dual part is ${n}a^{n - 1}b+{many}a{square}b^2$.",
            ),
            Line(
                rf"The real part is $a^{n}$, whatever $b$ is.",
                r"every other term carries a factor $\varepsilon$.",
            ),
        ),
        then=Formula(
            question=rf"So what is the dual part of $(a+\varepsilon b)^{n}$?",
            solution="",
            answer=f"{n}*a**{n - 1}*b",
            variables=("a", "b"),
            box=BOX,
            label="dual part =",
            slips=(
                known.formula(
                    "ε² kept",
                    f"{n}*a**{n - 1}*b + {many}*a**{n - 2}*b**2",
                    r"Here $\varepsilon$ is still a small number with a tiny square. It is "
                    r"not: $(\varepsilon b)^2=\varepsilon^2b^2=0$ exactly, for every $b$.",
                    ("a", "b"),
                    BOX,
                ),
            ),
            because="Linear in b, for every size of b.",
        ),
        hints=(
            r"Is $\varepsilon$ a small number?",
            r"$\varepsilon^2=0$ is no approximation. What is $(\varepsilon b)^2$ for $b=1000$?",
            "Three of the lines hold for every b. One speaks of small and large.",
        ),
        solution=r"$(\varepsilon b)^2=\varepsilon^2b^2=0$, exactly and for every $b$: "
        rf"$(a+\varepsilon b)^{n}=a^{n}+\varepsilon\,{n}a^{n - 1}b$. Nothing is neglected, "
        "because nothing is approximated.",
    )


# -- Python ----------------------------------------------------------------------------------------


def by_machine(draw: Draw) -> Code:
    """Ask for a value and a slope in a few lines."""
    x = draw.one_of((0.5, 1.5, 2.0))
    found = function("exp(x)/(1 + x**2)").lifted(x, 1.0)
    value, slope = float(found.value.real), found.slope
    return Code(
        question=rf"Compute $f({x:g})$ and $f'({x:g})$ of $f(x)=\dfrac{{e^x}}{{1+x^2}}$ by one "
        r"dual number. Give the dual number, or $[f, f']$.",
        starter="from ruledlab import Dual, function\n\n"
        'f = function("exp(x)/(1 + x**2)")\nvalue = ...',
        answer=[value, slope],
        label="f + ε f′ =",
        tolerance=1e-6,
        slips=(
            known.mistaken_for(
                "no dual part",
                [value, 0.0],
                r"The dual part of the argument is 0, so the tangent is not followed at all. Take "
                rf"$X={x:g}+\varepsilon$.",
                1e-6,
            ),
            known.mistaken_for(
                "x̄ = x",
                [value, x * slope],
                r"The argument has the dual part $x$ here: what comes out is $x\,f'(x)$. For the "
                r"slope itself take $\bar x=1$.",
                1e-6,
            ),
            known.mistaken_for(
                "parts exchanged",
                [slope, value],
                "These are the right numbers in the wrong order: the real part is the value.",
                1e-6,
            ),
        ),
        hints=(
            r"Dual(a, b) is $a+\varepsilon b$, and f takes dual numbers.",
            r"$f(x+\varepsilon)=f(x)+\varepsilon f'(x)$: which dual part has the argument?",
            rf"The argument is ${x:g}+1\,\varepsilon$.",
        ),
        solution=f"<pre>value = f(Dual({x:g}, 1))</pre>"
        rf"$f={value:.6f}$ and $f'={slope:.6f}$.",
    )


EXERCISES = (
    Exercise("01.1", "A product", product),
    Exercise("01.2", "An inverse", inverse),
    Exercise("01.3", "Without inverse", no_inverse),
    Exercise("01.4", "Cancelling", cancelled),
    Exercise("01.5", "One value tells them all", from_one_value),
    Exercise("01.6", "A derivative without differentiating", derivative),
    Exercise("01.7", "The sine of a dual angle", dual_sine),
    Exercise("01.8", "Slope of a bump", bump),
    Exercise("01.9", "Too much kept", kept_square),
    Exercise("01.10", "Value and slope in one", by_machine),
)
"""The exercises in their order."""
