"""Ruled surfaces: a curve on the dual unit sphere and everything that follows from it.

r(t, w) = m(t) + w x(t), with m the striction curve. The line X = x + ε x̄ at t comes from a curve
(u(t), v(t)) in the chart of the unit sphere and two functions ū(u, v), v̄(u, v) (paper, §3).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import closed
from .checks import CYLINDRICAL, Array, GeometryError, finite_array, frozen
from .dual import Dual
from .field import Field, field
from .jet import FLAGS, QUANTITIES, Jet, cross, dot, measure, striction
from .line import CommonPerpendicular, Line, common_perpendicular
from .series import plain
from .source import BaseSource, ChartSource, Curve, Formulas, LineSource, Source

__all__ = [
    "Curvature",
    "Curve",
    "FundamentalForms",
    "Invariants",
    "RuledSurface",
    "Sample",
    "Undefined",
]

BLOCK = 4096
"""Values of t that are worked on at once: few enough to stay in the processor's cache."""


@dataclass(frozen=True, eq=False, slots=True)
class Undefined:
    """Where some values are NaN, and why.

    Attributes
    ----------
    names
        the quantities concerned.
    where
        True at the entries concerned; it has the shape of those values.
    reason
        one sentence.
    """

    names: tuple[str, ...]
    where: npt.NDArray[np.bool_]
    reason: str


@dataclass(frozen=True, eq=False, slots=True)
class Invariants:
    """The invariants of a ruled surface over t (paper, (3), (6), (8)).

    Attributes
    ----------
    t
        the parameter values as given.
    kappa, kappa_bar
        κ̂ = κ + ε κ̄ = ‖X′‖: radians and lengths per unit of t.
    tau, tau_bar
        τ̂ = τ + ε τ̄ = [X, X′, X″]/‖X′‖²: radians and lengths per unit of t.
    sigma
        the angle in [0, 2π) from x₁ to the striction curve's tangent, atan2(κ̄, τ̄).
    delta
        the distribution parameter κ̄/κ, a length.
    kappa_prime, kappa_bar_prime
        κ′ and κ̄′, derivatives by t.

    All have the shape (*batch, *t.shape). What is undefined is NaN; see `undefined`.
    """

    t: Array
    kappa: Array
    kappa_bar: Array
    tau: Array
    tau_bar: Array
    sigma: Array
    delta: Array
    kappa_prime: Array
    kappa_bar_prime: Array
    _flags: npt.NDArray[np.bool_]
    _source: Source

    def __repr__(self) -> str:
        values = (f"{name}={plain(getattr(self, name))!r}" for name in ("t", *QUANTITIES))
        return f"Invariants({', '.join(values)})"

    @property
    def undefined(self) -> tuple[Undefined, ...]:
        """Which values are NaN, where and why; empty where all are defined."""
        cylindrical, still, pole = (self._flags[FLAGS.index(name)] for name in FLAGS)
        broken = np.isnan(self.tau_bar) | np.isnan(self.kappa_bar_prime)
        domain = broken & ~(cylindrical | pole)
        reports = (
            Undefined(
                QUANTITIES,
                pole,
                self._source.singular,
            ),
            Undefined(
                QUANTITIES[1:],
                cylindrical & ~pole,
                "κ = 0: the ruling keeps its direction there (a cylindrical ruling), so nothing "
                "that is measured against its turning is defined",
            ),
            Undefined(
                ("sigma",),
                still & ~pole,
                "κ̄ = τ̄ = 0: the striction point rests there, its curve has no tangent to measure "
                "σ by",
            ),
            Undefined(
                ("kappa_bar", "tau_bar", "sigma", "delta", "kappa_bar_prime"),
                domain,
                f"{self._source.origin}: outside the domain of the formula, or not finite",
            ),
        )
        return tuple(report for report in reports if report.where.any())


@dataclass(frozen=True, eq=False, slots=True)
class Curvature:
    """Gauss and mean curvature, each of shape (*batch, *t.shape, *w.shape).

    NaN at the striction point of a torsal ruling (κ̄ = w = 0), where there is no tangent plane, and
    along rulings whose κ̄ or τ̄ is undefined; `undefined` says which and why.
    """

    gauss: Array
    mean: Array
    _invariants: Invariants
    _tail: int

    @property
    def undefined(self) -> tuple[Undefined, ...]:
        """Where K and H are NaN, and why; empty where all are defined."""
        names, torsal = ("gauss", "mean"), np.isnan(self.mean)
        reports = []
        for report in self._invariants.undefined:
            if report.names != ("sigma",):
                where = report.where.reshape(report.where.shape + (1,) * self._tail)
                where = np.broadcast_to(where, torsal.shape)
                reports.append(Undefined(names, where, report.reason))
                torsal = torsal & ~where
        reason = (
            "κ̄ = 0 and w = 0: the striction point of a torsal ruling, where the surface has no "
            "tangent plane"
        )
        reports.append(Undefined(names, torsal, reason))
        return tuple(report for report in reports if report.where.any())


@dataclass(frozen=True, eq=False, slots=True)
class FundamentalForms:
    """First and second fundamental form on the patch m + w x, and its unit normal.

    ``g11 g12 g22`` and ``h11 h12 h22`` have the shape (*batch, *t.shape, *w.shape); ``normal`` has
    one more axis of 3.
    """

    g11: Array
    g12: Array
    g22: Array
    h11: Array
    h12: Array
    h22: Array
    normal: Array


@dataclass(frozen=True, eq=False, slots=True)
class Sample:
    """Rulings at some t and what follows from them, all read off one `Jet` of order 2.

    The jet is that of t flattened; the properties are named as the methods of `RuledSurface`.
    """

    jet: Jet
    invariants: Invariants

    @property
    def direction(self) -> Array:
        """(…, 3) the unit direction x."""
        return _last(self._known(self.jet.direction[0]))

    @property
    def direction_rate(self) -> Array:
        """(…, 3) its derivative x′ by t."""
        return _last(self._known(self.jet.direction[1]))

    @property
    def foot(self) -> Array:
        """(…, 3) the point c = x × x̄ nearest to the origin."""
        return _last(self._known(_foot(self.jet)))

    @property
    def foot_rate(self) -> Array:
        """(…, 3) its derivative c′ = x′ × x̄ + x × x̄′ by t."""
        (x, x1), (y, y1) = self.jet.direction[:2], self.jet.moment[:2]
        return _last(self._known(cross(x1, y) + cross(x, y1)))

    @property
    def striction(self) -> Array:
        """(…, 3) the striction point m; NaN where κ = 0."""
        return _last(self._known(striction(self.jet)))

    @property
    def frame(self) -> Array:
        """(…, 3, 3) the frame with rows x₁, x₂, x₃."""
        return np.moveaxis(self._known(_frame(self.jet)), (0, 1), (-2, -1))

    def _known(self, values: Array) -> Array:
        """Return values at flattened t in the shape of t, NaN where they are not finite."""
        known = np.where(np.isfinite(values), values, np.nan)
        return known.reshape(values.shape[:-1] + self.invariants.t.shape)


class RuledSurface:
    """The ruled surface of a curve in the sphere's chart and a choice of ū and v̄.

    X(t) = x(û, v̂) with û = u(t) + ε ū(u(t), v(t)), v̂ = v(t) + ε v̄(u(t), v(t)) and
    x(u, v) = (cos u sin v, sin u sin v, cos v) (paper, (16)).

    Parameters
    ----------
    curve
        u(t), v(t) in radians, such as `Bezier`; a batch of curves gives a batch of surfaces.
    ubar, vbar
        typed formulas in u and v such as ``"u - v"``, numbers, or callables of (u, v) made of
        numpy's functions. Their unit is the unit of length of the surface.

    Notes
    -----
    t may have any shape and any size; results have shape (*batch, *t.shape), vectors with a
    further last axis of 3. Undefined values are NaN, never a warning.

    Examples
    --------
    >>> from ruledlab import Bezier, RuledSurface
    >>> helicoid = RuledSurface(Bezier([[0, 1.5707963267948966], [1, 1.5707963267948966]]), "u", 0)
    >>> round(float(helicoid.invariants(0.25).delta), 12)
    1.0
    """

    __slots__ = ("_source",)

    _source: Source

    def __init__(self, curve: Curve, ubar: Any, vbar: Any) -> None:
        if not hasattr(curve, "series"):
            raise GeometryError(
                f"`curve` must be a curve such as Bezier(points); got {type(curve).__name__}; "
                "wrap control points as Bezier(points)"
            )
        self._source = ChartSource(curve, field(ubar, "ubar"), field(vbar, "vbar"))

    @classmethod
    def from_source(cls, source: Source) -> RuledSurface:
        """Return the surface of anything that yields a `Jet` over a domain."""
        surface = cls.__new__(cls)
        surface._source = source
        return surface

    @classmethod
    def from_base(
        cls, base: Formulas, direction: Formulas, domain: tuple[float, float] = (0.0, 1.0)
    ) -> RuledSurface:
        """Return the surface r(t, w) = c(t) + w d(t) of a base curve and a generator (paper, (1)).

        Parameters
        ----------
        base, direction
            functions of t that return three components made with numpy's functions, such as
            ``lambda t: (np.cos(t), np.sin(t), 0)``. t comes as a `Series`, which carries the
            derivatives. The direction may have any length but 0; it is normalised.
        domain
            first and last t.

        Raises
        ------
        GeometryError
            where a function cannot be evaluated on a `Series`, does not return three components,
            or gives no direction at all. Single places where the direction is 0 are NaN.

        Examples
        --------
        >>> import numpy as np
        >>> from ruledlab import RuledSurface
        >>> helicoid = RuledSurface.from_base(
        ...     lambda t: (0, 0, 2 * t), lambda t: (np.cos(t), np.sin(t), 0), domain=(0, 6)
        ... )
        >>> round(float(helicoid.invariants(0.25).delta), 12)
        2.0
        """
        return cls.from_source(BaseSource(base, direction, domain))

    @classmethod
    def from_lines(cls, lines: Formulas, domain: tuple[float, float] = (0.0, 1.0)) -> RuledSurface:
        """Return the surface of a curve X(t) on the dual unit sphere (paper, §2.1).

        Parameters
        ----------
        lines
            a function of t (a `Series`) that returns a dual vector: three components, each a
            `Dual`, a `Series` or a number, or one `Dual` whose parts have a last axis of 3. It is
            normalised to a dual unit vector, so any with a real part ≠ 0 will do.
        domain
            first and last t.

        Raises
        ------
        GeometryError
            as for `from_base`.

        Examples
        --------
        >>> import numpy as np
        >>> from ruledlab import Dual, RuledSurface
        >>> helicoid = RuledSurface.from_lines(
        ...     lambda t: (np.cos(Dual(t, 2 * t)), np.sin(Dual(t, 2 * t)), 0), domain=(0, 6)
        ... )
        >>> round(float(helicoid.invariants(0.25).delta), 12)
        2.0
        """
        return cls.from_source(LineSource(lines, domain))

    @property
    def source(self) -> Source:
        """Where the lines come from."""
        return self._source

    @property
    def curve(self) -> Curve:
        """The curve (u(t), v(t)) of a surface from the chart."""
        return self._chart("curve").curve

    @property
    def ubar(self) -> Field:
        """The choice of ū of a surface from the chart."""
        return self._chart("ubar").ubar

    @property
    def vbar(self) -> Field:
        """The choice of v̄ of a surface from the chart."""
        return self._chart("vbar").vbar

    def _chart(self, name: str) -> ChartSource:
        if isinstance(self._source, ChartSource):
            return self._source
        raise GeometryError(
            f"`{name}` must be asked of a surface from the chart; this one is made from "
            f"{self._source!r}; build it as RuledSurface(curve, ubar, vbar)"
        )

    @property
    def domain(self) -> tuple[float, float]:
        """First and last t."""
        return self._source.domain

    def __repr__(self) -> str:
        return f"RuledSurface({self._source!r})"

    def jet(self, t: Array, order: int = 2) -> Jet:
        """Return X and its derivatives by t, vectors along the third axis: see `Jet`."""
        return self._source.jet(t, order)

    # -- local quantities ------------------------------------------------------------------------

    def invariants(self, t: npt.ArrayLike) -> Invariants:
        """Return κ, κ̄, τ, τ̄, σ, δ, κ′ and κ̄′ at t."""
        t = finite_array(t, "t")
        return self._named(t, *self._measured(t))

    def _named(self, t: Array, values: Array, flags: npt.NDArray[np.bool_]) -> Invariants:
        """Give the rows of `measure` at flattened t their names and the shape of t."""
        shape = (*self._source.batch_shape, *t.shape)
        values = values.reshape(len(values), *shape)
        flags = flags.reshape(len(flags), *shape)
        values.flags.writeable = False
        named = dict(zip(QUANTITIES, values, strict=True))
        return Invariants(frozen(t), **named, _flags=flags, _source=self._source)

    def _measured(self, t: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
        flat, batch, block = t.reshape(-1), self._source.batch_shape, self._block
        with np.errstate(all="ignore"):
            if flat.size <= block:
                values, flags = measure(self.jet(flat))
            else:
                values = np.empty((len(QUANTITIES), *batch, flat.size))
                flags = np.empty((len(FLAGS), *batch, flat.size), dtype=bool)
                for start in range(0, flat.size, block):
                    part = slice(start, start + block)
                    values[..., part], flags[..., part] = measure(self.jet(flat[part]))
        return values, flags

    @property
    def _block(self) -> int:
        """How many values of t to work on at once, over the whole batch."""
        return max(1, BLOCK // max(1, math.prod(self._source.batch_shape)))

    def _mapped(self, t: npt.ArrayLike, order: int, function: Callable[[Jet], Array]) -> Array:
        """Return what the function makes of the jet at t, (…, *batch, *t.shape), block by block."""
        t = finite_array(t, "t")
        flat, block = t.reshape(-1), self._block
        with np.errstate(all="ignore"):
            values = function(self.jet(flat[:block], order))
            if flat.size > block:
                head, values = values, np.empty((*values.shape[:-1], flat.size))
                values[..., :block] = head
                for start in range(block, flat.size, block):
                    part = slice(start, start + block)
                    values[..., part] = function(self.jet(flat[part], order))
            if not np.isfinite(values.sum()):
                values[~np.isfinite(values)] = np.nan
        return values.reshape(values.shape[:-1] + t.shape)

    def sample(self, t: npt.ArrayLike) -> Sample:
        """Return rulings, striction points, frames and invariants at t, for a picture.

        It costs one jet where the methods of the same names cost one each, and holds all of it:
        for a picture's worth of t, not for 10⁶.
        """
        t = finite_array(t, "t")
        with np.errstate(all="ignore"):
            jet = self.jet(t.reshape(-1))
            values, flags = measure(jet)
        return Sample(jet, self._named(t, values, flags))

    def line(self, t: npt.ArrayLike) -> Line:
        """Return the rulings X(t) as oriented lines: ``.direction``, ``.moment`` (…, 3).

        Entries are NaN where ū or v̄ is undefined.
        """
        x, y = self._mapped(t, 0, lambda jet: jet.rows[0])
        return Line.unchecked(_last(x), _last(y))

    def foot(self, t: npt.ArrayLike) -> Array:
        """Return (…, 3) the point c = x × x̄ of each ruling nearest to the origin."""
        return _last(self._mapped(t, 0, _foot))

    def striction(self, t: npt.ArrayLike) -> Array:
        """Return (…, 3) the striction point m = c − (⟨x′, c′⟩/⟨x′, x′⟩) x; NaN where κ = 0."""
        return _last(self._mapped(t, 1, striction))

    def frame(self, t: npt.ArrayLike) -> Array:
        """Return (…, 3, 3) the frame with rows x₁ = x, x₂ = x′/κ, x₃ = x₁ × x₂ (paper, (4)).

        x₂ and x₃ are NaN where κ = 0. The three lines X₁, X₂, X₃ meet in the striction point.
        """
        return np.moveaxis(self._mapped(t, 1, _frame), (0, 1), (-2, -1))

    def neighbours(self, t: npt.ArrayLike, h: npt.ArrayLike) -> CommonPerpendicular:
        """Return the common perpendicular of the rulings X(t) and X(t + h).

        As h → 0 both feet tend to the striction point, the line to X₃ (to −X₃ for h < 0), and its
        angle and distance, divided by |h|, to κ and κ̄.

        Parameters
        ----------
        t, h
            numbers or arrays that broadcast; t + h may lie beyond the domain if the formulas or
            the curve go on there. Rounding adds about 1e-16/h to the distance, so h = 1e-3 is a
            good picture and h = 1e-12 is noise.
        """
        first, step = np.broadcast_arrays(finite_array(t, "t"), finite_array(h, "h"))
        return common_perpendicular(self.line(first), self.line(first + step))

    def neighbour_distance(self, t: npt.ArrayLike, h: npt.ArrayLike) -> Array:
        """Return the signed shortest distance of the rulings X(t) and X(t + h): see `neighbours`.

        It is positive where X(t + h) lies ahead along x(t) × x(t + h); for small h it is κ̄ |h|.
        """
        return self.neighbours(t, h).distance

    # -- the patch -------------------------------------------------------------------------------

    def points(self, t: npt.ArrayLike, w: npt.ArrayLike) -> Array:
        """Return (…, *t.shape, *w.shape, 3) the points m(t) + w x(t); NaN where κ = 0."""
        w = finite_array(w, "w")
        m, x = self._mapped(t, 1, lambda jet: np.stack([striction(jet), jet.direction[0]]))
        with np.errstate(all="ignore"):
            return _last(_spread(m, w) + w * _spread(x, w))

    def fundamental_forms(self, t: npt.ArrayLike, w: npt.ArrayLike) -> FundamentalForms:
        """Return both fundamental forms and the unit normal on m + w x (paper, §2.4, mended).

        With W² = κ̄² + w²κ²: n = (κ̄x₂ − wκx₃)/W, g₁₁ = τ̄² + W², g₁₂ = τ̄, g₂₂ = 1,
        h₁₁ = [κ̄(κτ̄ + wκ′ − κ̄τ) − wκ(wκτ + κ̄′)]/W, h₁₂ = κκ̄/W, h₂₂ = 0.
        NaN at W = 0: the striction point of a torsal ruling, where there is no tangent plane.
        """
        t, w = finite_array(t, "t"), finite_array(w, "w")
        found = self.invariants(t)
        frame = self._mapped(t, 1, _frame)
        k, kb, tau, tb, dk, dkb = (_spread(getattr(found, name), w) for name in BENDING)
        x2, x3 = _spread(frame[1], w), _spread(frame[2], w)
        with np.errstate(all="ignore"):
            size = _area(k, kb, w)
            normal = (kb * x2 - w * k * x3) / size
            h11 = (kb * (k * tb + w * dk - kb * tau) - w * k * (w * k * tau + dkb)) / size
            h12 = k * kb / size
        one = np.ones_like(size)
        return FundamentalForms(tb**2 + size**2, tb * one, one, h11, h12, 0.0 * one, _last(normal))

    def curvature(self, t: npt.ArrayLike, w: npt.ArrayLike) -> Curvature:
        """Return Gauss curvature K and mean curvature H on m + w x.

        K = −δ²/(δ² + w²)² and H = (h₁₁ − 2h₁₂τ̄)/(2W²); both NaN at W = 0. K ≤ 0 everywhere, and
        of all points of a ruling |K| is greatest at the striction point.
        """
        w, invariants = finite_array(w, "w"), self.invariants(t)
        return _curvature(invariants, w, w.ndim)

    # -- the whole surface -----------------------------------------------------------------------

    def closure(self) -> closed.Closure:
        """Say whether the surface closes, how smoothly, and what gap remains."""
        return closed.closure(self._one("closure"))

    def pitch(self) -> float:
        """Return l = −∮⟨c′, x⟩ dt = −∮τ̄ dt, a length (paper, (10)).

        It is how far along the ruling an orthogonal trajectory comes back after one turn.

        Raises
        ------
        GeometryError
            where the surface does not close, with the gap that remains.
        """
        return closed.pitch(self._one("pitch"))

    def angle_of_pitch(self) -> float:
        """Return λ = −∮τ dt in radians (paper, (25)).

        The unit vector ξ = cos φ x₂ + sin φ x₃ that spans a developable turns by it in one turn.
        A corner at the seam (C⁰ only) adds its own turn, which is not counted here.

        Raises
        ------
        GeometryError
            where the surface does not close, with the gap that remains.
        """
        return closed.angle_of_pitch(self._one("angle_of_pitch"))

    def dual_angle_of_pitch(self) -> Dual:
        """Return Λ = λ + ε l = −∮τ̂ dt."""
        return closed.dual_angle_of_pitch(self._one("dual_angle_of_pitch"))

    def arc_lengths(self) -> closed.ArcLengths:
        """Return ∫κ, ∫κ̄, ∫τ, ∫τ̄, the dual length of X₃ and the length of the striction curve."""
        return closed.arc_lengths(self._one("arc_lengths"))

    def _one(self, method: str) -> RuledSurface:
        if self._source.batch_shape:
            raise GeometryError(
                f"`{method}` must be asked of one surface; got a batch of shape "
                f"{self._source.batch_shape}; build each from its own curve"
            )
        return self


def curvature_along(invariants: Invariants, w: Array) -> Curvature:
    """Return K and H at places w of shape (…, W) chosen for each ruling."""
    return _curvature(invariants, w, 1)


BENDING = ("kappa", "kappa_bar", "tau", "tau_bar", "kappa_prime", "kappa_bar_prime")
"""The invariants that K and H depend on."""


def _curvature(invariants: Invariants, w: Array, tail: int) -> Curvature:
    """Append ``tail`` axes to the invariants, so that they broadcast against w."""
    rows = (getattr(invariants, name) for name in BENDING)
    k, kb, tau, tb, dk, dkb = (row.reshape(row.shape + (1,) * tail) for row in rows)
    with np.errstate(all="ignore"):
        size = _area(k, kb, w)
        bend = kb * (w * dk - kb * tau - k * tb) - w * k * (w * k * tau + dkb)
        gauss, mean = -((k * kb / size**2) ** 2), bend / (2.0 * size**3)
    return Curvature(gauss, mean, invariants, tail)


def _last(vectors: Array) -> Array:
    """Move the entries of vectors from the first axis to the last."""
    return np.moveaxis(vectors, 0, -1)


def _spread(values: Array, w: Array) -> Array:
    """Append axes for w."""
    return values.reshape(values.shape + (1,) * w.ndim)


def _foot(jet: Jet) -> Array:
    """Return (3, …) the point c = x × x̄."""
    return cross(jet.direction[0], jet.moment[0])


def _frame(jet: Jet) -> Array:
    """Return (3, 3, …) the vectors x₁, x₂, x₃."""
    x, x1 = jet.direction[:2]
    kappa = np.sqrt(dot(x1, x1))
    x2 = x1 / np.where(kappa <= CYLINDRICAL * np.asarray(jet.scale), np.nan, kappa)
    return np.stack([x, x2, cross(x, x2)])


def _area(kappa: Array, kappa_bar: Array, w: Array) -> Array:
    """Return W = √(κ̄² + w²κ²), the area element; NaN where it vanishes."""
    size = np.hypot(kappa_bar, w * kappa)
    return np.where(size == 0.0, np.nan, size)
