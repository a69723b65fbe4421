"""Formulas typeset: by hand, and what matplotlib can draw."""

from __future__ import annotations

import pytest

from ruledlab.geometry.choices import CHOICES
from ruledlab.geometry.field import field

TYPESET = {
    "u - v": "u - v",
    "-u**2": "-u^{2}",
    "(-u)**2": "(-u)^{2}",
    "2*u*v": "2 u v",
    "2*3*u*2": r"2 \cdot 3 u \cdot 2",
    "2*(1/3)": r"2 \cdot \frac{1}{3}",
    "3*pi/8": r"\frac{3 \pi}{8}",
    "π*u": r"\pi u",
    "-pi*u/2 + v": r"-\frac{\pi u}{2} + v",
    "u - (v - 1)": "u - (v - 1)",
    "u + (v - 1)": "u + v - 1",
    "u + -v": "u + (-v)",
    "u - -v": "u - (-v)",
    "--u": "-(-u)",
    "-(u + v)": "-(u + v)",
    "(u + v)*(u - v)": "(u + v) (u - v)",
    "u*(v + 1)": r"u \cdot (v + 1)",
    "((u))": "u",
    "(u + 1)/(v**2)": r"\frac{u + 1}{v^{2}}",
    "sin(2*u)**2": r"\sin^{2}(2 u)",
    "1/sin(v)": r"\frac{1}{\sin(v)}",
    "cos(u)**-1": r"(\cos(u))^{-1}",
    "sin(u/2)": r"\sin\left(\frac{u}{2}\right)",
    "sqrt(1 + u**2)": r"\sqrt{1 + u^{2}}",
    "sqrt(u)**3": r"\sqrt{u}^{3}",
    "exp(-u)": r"\mathrm{e}^{-u}",
    "exp(u)**2": r"\left(\mathrm{e}^{u}\right)^{2}",
    "e**u": r"\mathrm{e}^{u}",
    "abs(u - v)": r"\left|u - v\right|",
    "log(u)": r"\log(u)",
    "atan2(v, u)": r"\operatorname{arctan2}(v, u)",
    "acos(u)": r"\arccos(u)",
    "u**v**2": "u^{v^{2}}",
    "(u**v)**2": r"\left(u^{v}\right)^{2}",
    "1e-3*u": "10^{-3} u",
    "2.5E+4": r"2.5 \times 10^{4}",
    ".5*u": "0.5 u",
}


@pytest.mark.parametrize("text", TYPESET)
def test_typeset_formula(text: str) -> None:
    assert field(text).latex == TYPESET[text]


def test_typeset_formulas_can_be_drawn() -> None:
    mathtext = pytest.importorskip("matplotlib.mathtext")
    parser = mathtext.MathTextParser("path")
    fields = [field(text) for text in TYPESET]
    fields += [field(text) for choice in CHOICES for text in (choice.ubar, choice.vbar)]
    for f in [*fields, field(lambda u, v: u)]:
        parser.parse(f"${f.latex}$")
