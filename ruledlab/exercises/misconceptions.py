"""The wrong answers this subject invites, each with a name and a word.

Each function returns a `Misconception` for the right value it is given.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ..design import Design
from ..geometry.checks import Array
from .answers import read_formula
from .core import Formula, Made, Misconception

__all__ = [
    "collinear_for_c1",
    "degrees",
    "delta_inverted",
    "formula",
    "mistaken_for",
    "modulo_turn",
    "moment_sign",
    "pitch_sign",
    "printed_tau_bar",
    "torsion_sign",
]

CLOSE = 1e-3


def mistaken_for(
    name: str, value: npt.ArrayLike, word: str, tolerance: float = CLOSE
) -> Misconception:
    """Return the misconception that gives this value instead of the right one."""
    wrong = np.asarray(value, dtype=float)
    slack = tolerance * (float(np.abs(wrong).max(initial=0.0)) or 1.0)

    def test(given: Array) -> bool:
        return given.shape == wrong.shape and bool(np.all(np.abs(given - wrong) <= slack))

    return Misconception(name, test, word, wrong.tolist())


def moment_sign(moment: npt.ArrayLike) -> Misconception:
    """x̄ = x × c where x̄ = c × x is meant."""
    return mistaken_for(
        "sign of the moment",
        -np.asarray(moment, dtype=float),
        r"This is $\mathbf x\times\mathbf c$. The moment is "
        r"$\bar{\mathbf x}=\mathbf c\times\mathbf x$: the point first, then the direction.",
    )


def modulo_turn(value: float) -> Misconception:
    """λ modulo 2π where λ itself is meant."""
    turn = 2 * math.pi

    def test(given: Array) -> bool:
        turns = (given - value) / turn
        whole = np.round(turns)
        return given.shape == () and bool(whole != 0 and abs(turns - whole) <= CLOSE / turn)

    return Misconception(
        "λ modulo 2π",
        test,
        r"You are right modulo $2\pi$, and as a gap between two directions that is all one sees. "
        r"The integral $\lambda=-\oint\tau\,dt$ counts the turns too.",
        value % turn if not 0 <= value < turn else value + turn,
    )


def torsion_sign(value: float) -> Misconception:
    """λ = +∮τ, the sign of (11)."""
    return mistaken_for(
        "sign of (11)",
        -value,
        r"This is $+\oint\tau\,dt$, the sign printed in (11). The vector $\xi$ turns the other "
        r"way, $\varphi'=-\tau$, so that $\lambda=-\oint\tau\,dt$ as in (25).",
    )


def pitch_sign(value: float) -> Misconception:
    """Recognise l = +∮⟨c′, x⟩, the sign of (24)."""
    return mistaken_for(
        "sign of (24)",
        -value,
        r"This is $+\oint\langle\mathbf c',\mathbf x\rangle\,dt$, the sign printed in (24). The "
        r"orthogonal trajectory goes back by as much: $l=-\oint\langle\mathbf c',\mathbf x\rangle"
        r"\,dt$, as in (10).",
    )


def printed_tau_bar(advance: npt.ArrayLike) -> Misconception:
    """⟨c′, x⟩, which (18) prints for τ̄."""
    return mistaken_for(
        "τ̄ as printed in (18)",
        advance,
        r"This is $\langle\mathbf c',\mathbf x\rangle=\sin v\,(\bar u v'-\bar v u')$, which (18) "
        r"prints for $\bar\tau$. The dual torsion has $\mu'$ besides, because the striction point "
        r"$\mathbf m=\mathbf c+\mu\mathbf x$ moves along the ruling. Over a closed surface both "
        r"give the same integral, at a single $t$ they differ.",
    )


def degrees(value: npt.ArrayLike) -> Misconception:
    """Degrees where radians are meant."""
    return mistaken_for(
        "degrees for radians",
        np.degrees(np.asarray(value, dtype=float)),
        r"This is in degrees. Angles are in radians here: multiply by $\pi/180$.",
    )


def delta_inverted(value: float) -> Misconception:
    """κ/κ̄ for δ = κ̄/κ."""
    return mistaken_for(
        "δ inverted",
        1.0 / value,
        r"This is $\kappa/\bar\kappa$. The distribution parameter is a length, "
        r"$\delta=\bar\kappa/\kappa$: how far the ruling moves for each radian that it turns.",
    )


def formula(
    name: str,
    text: str,
    word: str,
    variables: tuple[str, ...] = ("u", "v"),
    box: tuple[tuple[float, float], ...] = ((0.2, 2.9), (0.3, 2.8)),
) -> Misconception:
    """Return the misconception that gives this formula, or an equivalent one."""
    probe = Formula(question="", solution="", answer=text, variables=variables, box=box)
    places = probe.places()
    wrong = np.array(read_formula(text, variables)(*places))
    slack = 1e-8 * max(float(np.abs(wrong).max()), 1e-6)

    def test(given: Any) -> bool:
        return bool(np.all(np.abs(given(*places) - wrong) <= slack))

    return Misconception(name, test, word, text)


def collinear_for_c1(example: Design) -> Misconception:
    """Three points on one line at the seam, but the two legs of different length."""

    def test(made: Made) -> bool:
        points = np.array(made.design.points)
        first, last = points[1] - points[0], points[-1] - points[-2]
        lengths = np.hypot(*first), np.hypot(*last)
        if min(lengths) == 0.0:
            return False
        sine = (first[0] * last[1] - first[1] * last[0]) / (lengths[0] * lengths[1])
        same_way = float(first @ last) > 0
        return bool(
            same_way and abs(sine) < 0.05 and abs(lengths[0] - lengths[1]) > 0.02 * max(lengths)
        )

    return Misconception(
        "collinear taken for C¹",
        test,
        r"$\mathbf p_{n-1},\mathbf p_0,\mathbf p_1$ lie on one line: the tangent has the same "
        r"direction on both sides of the seam, but the speed jumps. C¹ needs equal legs, "
        r"$\mathbf p_1-\mathbf p_0=\mathbf p_0-\mathbf p_{n-1}$.",
        example,
    )
