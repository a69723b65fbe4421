"""Where the lines of a ruled surface come from: the chart, a base curve, or lines given outright.

A surface asks its source for nothing but X and its derivatives, as a `Jet`; frame, invariants and
shape follow from these alone. So every source gives the whole interface of `RuledSurface`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from .checks import POLE, Array, GeometryError, finite_array
from .dual import Dual
from .field import Field
from .jet import Jet, study
from .series import Series

__all__ = ["BaseSource", "ChartSource", "Curve", "LineSource", "Source"]

SAMPLES = 65
"""Places at which the turning of a given direction is read, to know its ordinary size."""

RESTING = 1e-4
"""Least scale of the turning, in radians over the whole domain: less is rounding, a cylinder."""

NO_LINE = (
    "the direction is zero or not finite there, so that there is no line; change the formulas or "
    "the domain"
)


class Curve(Protocol):
    """A curve in the chart, such as `Bezier`."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t."""

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of a batch of curves, () for one."""

    @property
    def scale(self) -> Any:
        """An ordinary size of the curve's speed, of the batch's shape."""

    def series(self, t: Array, order: int) -> Series:
        """Return u and v at t, with values of shape (2, *batch, *t.shape)."""


class Source(Protocol):
    """Anything that yields a moving line and says in words what may go wrong with it."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t."""

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of a batch of surfaces, () for one."""

    @property
    def singular(self) -> str:
        """Why there is no line where the jet's ``pole`` is True."""

    @property
    def origin(self) -> str:
        """What κ̄ and τ̄ come from, for the report that they are not finite."""

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Return X and its derivatives at t, with axes (*batch, *t.shape)."""


@dataclass(frozen=True, eq=False, slots=True)
class ChartSource:
    """A curve in the chart of the unit sphere with ū(u, v) and v̄(u, v) (paper, §3)."""

    curve: Curve
    ubar: Field
    vbar: Field

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t of the curve."""
        return self.curve.domain

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of the batch of curves."""
        return self.curve.batch_shape

    @property
    def singular(self) -> str:
        """Why nothing is defined at a pole."""
        return (
            "the curve meets a pole of the chart (sin v = 0), where u names no direction and "
            "ū, v̄ belong to no one line; move the curve off the pole"
        )

    @property
    def origin(self) -> str:
        """Name ū and v̄."""
        ubar, vbar = (chosen.text or "a Python function" for chosen in (self.ubar, self.vbar))
        return f"ū = {ubar}, v̄ = {vbar}"

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Put u + ε ū and v + ε v̄ into the chart."""
        t = np.asarray(t, dtype=np.float64)
        with np.errstate(all="ignore"):
            angles = self.curve.series(t, order)
            u, v = angles[0], angles[1]
            rows = study(angles, self.ubar(u, v), self.vbar(u, v))
            pole = np.abs(np.sin(v.value)) <= POLE
        scale = np.reshape(self.curve.scale, self.curve.batch_shape + (1,) * t.ndim)
        return Jet(rows, scale, pole)

    def __repr__(self) -> str:
        return f"{self.curve!r}, ubar={self.ubar!r}, vbar={self.vbar!r}"


Formulas = Callable[[Series], Any]
"""A function of t that returns three components made with numpy's functions."""


class _Given:
    """What sources made from functions of t have in common."""

    __slots__ = ()

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """One surface."""
        return ()

    @property
    def singular(self) -> str:
        """Why there is no line."""
        return NO_LINE


@dataclass(frozen=True, eq=False, slots=True)
class BaseSource(_Given):
    """The lines c(t) + w d(t), d ≠ 0 of any length: X = (d + ε c × d)/‖d‖ (paper, (1) and (2))."""

    base: Formulas
    direction: Formulas
    domain: tuple[float, float]
    scale: float = field(init=False)

    def __post_init__(self) -> None:
        _store_checked(self, _called(base=self.base, direction=self.direction))

    @property
    def origin(self) -> str:
        """Name the curve."""
        return "the base curve or the direction"

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Normalise d and take the moment c × x."""
        places = np.asarray(t, dtype=np.float64)
        with np.errstate(all="ignore"):
            x = _unit(_components(self.direction, places, order, "direction")[0])
            c, _ = _components(self.base, places, order, "base")
            return _jet(x, _crossed(c, x), self.scale)

    def __repr__(self) -> str:
        return f"base={_name(self.base)}, direction={_name(self.direction)}, domain={self.domain}"


@dataclass(frozen=True, eq=False, slots=True)
class LineSource(_Given):
    """A curve on the dual unit sphere: any dual vector over t with real part ≠ 0, normalised."""

    lines: Formulas
    domain: tuple[float, float]
    scale: float = field(init=False)

    def __post_init__(self) -> None:
        _store_checked(self, _called(lines=self.lines))

    @property
    def origin(self) -> str:
        """Name the function."""
        return "the dual part of the lines"

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Normalise: (a + ε ā)/‖a + ε ā‖ = x + ε (ā − ⟨ā, x⟩x)/‖a‖."""
        places = np.asarray(t, dtype=np.float64)
        with np.errstate(all="ignore"):
            a, a_bar = _components(self.lines, places, order, "lines", dual=True)
            x, size = _unit(a), np.sqrt(_inner(a, a))
            along = _inner(a_bar, x)
            moment = [(entry - along * part) / size for entry, part in zip(a_bar, x, strict=True)]
            return _jet(x, moment, self.scale)

    def __repr__(self) -> str:
        return f"lines={_name(self.lines)}, domain={self.domain}"


# -- reading what a function of t returns ----------------------------------------------------------


def _store_checked(source: BaseSource | LineSource, functions: dict[str, Formulas]) -> None:
    """Check the domain, evaluate once, so that errors come early, and store the scale."""
    ends = finite_array(source.domain, "domain")
    if ends.shape != (2,) or not ends[0] < ends[1]:
        raise GeometryError(
            f"`domain` must be two numbers, the first t and a larger last t; got {source.domain}; "
            "write domain=(0, 1)"
        )
    domain = (float(ends[0]), float(ends[1]))
    object.__setattr__(source, "domain", domain)
    least = RESTING / (domain[1] - domain[0])
    object.__setattr__(source, "scale", least)
    with np.errstate(all="ignore"):
        jet = source.jet(np.linspace(*domain, SAMPLES), 1)
    if not np.isfinite(jet.direction[0]).all(axis=0).any():
        names = " or ".join(f"`{name}`" for name in functions)
        raise GeometryError(
            f"{names} must give a direction that is not zero; got none on the whole domain; "
            "change the formulas or the domain"
        )
    turning = np.linalg.norm(jet.direction[1], axis=0)
    fastest = np.where(np.isfinite(turning), turning, 0.0).max(initial=0.0)
    object.__setattr__(source, "scale", max(float(fastest), least))


def _called(**functions: Formulas) -> dict[str, Formulas]:
    for name, function in functions.items():
        if not callable(function):
            raise GeometryError(
                f"`{name}` must be a function of t that returns three components; got "
                f"{type(function).__name__}; write lambda t: (np.cos(t), np.sin(t), t)"
            )
    return functions


def _components(
    function: Formulas, t: Array, order: int, name: str, *, dual: bool = False
) -> tuple[list[Series], list[Series]]:
    """Return the real and the dual parts of the three components as series of t's shape."""
    variable = Series.variable(t, order)
    try:
        value = function(variable)
    except GeometryError:
        raise
    except Exception as error:
        what = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        raise GeometryError(
            f"`{name}` must be made of numpy's functions of t; got {what}; write for example "
            "lambda t: (np.cos(t), np.sin(t), t)"
        ) from error
    entries = [_entry(entry, variable, name, dual) for entry in _three(value, name)]
    return [real for real, _ in entries], [part for _, part in entries]


def _three(value: Any, name: str) -> Sequence[Any]:
    """Return the three components; a dual vector has them along the last axis of its parts."""
    if isinstance(value, Dual):
        shapes = {np.shape(getattr(p, "coefficients", p))[-1:] for p in (value.real, value.dual)}
        if (3,) in shapes:
            return [value[..., k] for k in range(3)]
    elif isinstance(value, (tuple, list, np.ndarray)) and len(value) == 3:
        return list(value)
    raise GeometryError(
        f"`{name}` must return three components; got {type(value).__name__}; write for example "
        "lambda t: (np.cos(t), np.sin(t), t)"
    )


def _entry(value: Any, t: Series, name: str, dual: bool) -> tuple[Series, Series]:
    if isinstance(value, Dual) and dual:
        return _series(value.real, t, name), _series(value.dual, t, name)
    return _series(value, t, name), 0.0 * t


def _series(value: Any, t: Series, name: str) -> Series:
    if isinstance(value, Series):
        return value + 0.0 * t
    plain = np.asarray(value)
    if plain.ndim or plain.dtype.kind not in "fiub":
        raise GeometryError(
            f"`{name}` must return components that are numbers or made of t by numpy's functions; "
            f"got {type(value).__name__}; keep t whole, as its derivatives are needed"
        )
    return 0.0 * t + float(plain)


# -- vectors of series -----------------------------------------------------------------------------


def _inner(a: Sequence[Series], b: Sequence[Series]) -> Series:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _unit(a: Sequence[Series]) -> list[Series]:
    size = np.sqrt(_inner(a, a))
    return [entry / size for entry in a]


def _crossed(a: Sequence[Series], b: Sequence[Series]) -> list[Series]:
    return [a[j] * b[k] - a[k] * b[j] for j, k in ((1, 2), (2, 0), (0, 1))]


def _jet(x: Sequence[Series], moment: Sequence[Series], scale: float) -> Jet:
    rows = np.stack(
        [np.stack([entry.derivatives() for entry in part], axis=1) for part in (x, moment)], axis=1
    )
    return Jet(rows, scale, ~np.isfinite(rows[0, 0]).all(axis=0))


def _name(function: Formulas) -> str:
    return str(getattr(function, "__name__", type(function).__name__))
