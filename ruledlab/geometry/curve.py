"""Control points in the (u, v) chart: Bézier curves, how they close, and how they are edited.

A curve here lives in the plane of the chart: u is the longitude, v the colatitude, in radians. What
it becomes on the sphere, and which surface belongs to it, is decided elsewhere. Closing, too, is
asked of the plane curve, except that u and u + 2π are the same longitude: a curve that ends k full
turns east of its beginning is closed, with winding k.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np
import numpy.typing as npt

from .checks import CLOSING, Array, GeometryError, finite_array, frozen
from .series import Series

__all__ = [
    "MAX_DEGREE",
    "Bezier",
    "Seam",
    "close",
    "drag",
    "insert",
    "least_degree",
    "remove",
    "seam",
]

MAX_DEGREE = 60
"""Highest degree of a Bézier curve: up to here the evaluation keeps twelve digits with ease."""

ROUNDING = 8 * float(np.finfo(np.float64).eps)
"""Differences below this fraction of the coordinates themselves are rounding, whatever the size."""

LARGEST = 1e100
"""Coordinates beyond this are refused: their differences and products might overflow."""

BLOCK = 8192
"""Values of t evaluated together: the basis of one block stays in the processor's cache."""

TURN = 2 * math.pi
_NAMES = {0: "C⁰", 1: "C¹", 2: "C²"}


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Bezier:
    """A Bézier curve b(t) = Σ Bᵢⁿ(t) pᵢ in the (u, v) chart (equation 14), or a batch of them.

    Parameters
    ----------
    points
        control points (u, v) in radians, shape (n+1, 2) with 1 ≤ n ≤ 60. Leading axes are a batch
        of curves of the same degree. A read-only copy is kept.

    Raises
    ------
    GeometryError
        if the points are not finite real numbers, or their shape or degree is not as above.

    Notes
    -----
    The parameter runs over [0, 1], but any real t is accepted. On [0, 1] values are accurate to
    rounding, relative to the size of the control polygon, and derivatives relative to the size of
    theirs: no term of the sums is larger than its control point. The ends are met to the last bit.
    Outside [0, 1] the Bernstein polynomials grow like tⁿ and accuracy is lost accordingly; where
    they overflow the result is infinite or NaN. NaN in t gives NaN. Nothing is warned about.
    """

    points: Array
    _taylor: Array = field(init=False)
    _scale: float | Array = field(init=False)

    def __post_init__(self) -> None:
        points = frozen(_checked(self.points))
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "_taylor", _taylor_matrix(points, 2))
        object.__setattr__(self, "_scale", _speed_scale(points))

    def __reduce__(self) -> tuple[Any, ...]:
        # Copies and unpickled curves are built anew: their arrays, too, are read-only.
        return type(self), (self.points,)

    def __repr__(self) -> str:
        batch = f", batch_shape={self.batch_shape}" if self.batch_shape else ""
        return f"Bezier(degree={self.degree}{batch})"

    @property
    def degree(self) -> int:
        """The degree n: one less than the number of control points."""
        return int(self.points.shape[-2]) - 1

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Shape of the batch of curves; () for a single curve."""
        return self.points.shape[:-2]

    @property
    def domain(self) -> tuple[float, float]:
        """The interval of t that the control points speak of."""
        return (0.0, 1.0)

    @property
    def scale(self) -> float | Array:
        """Degree times the longest leg, a bound of ‖b′‖ on [0, 1]; an array for a batch."""
        return self._scale

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return the points b(t).

        Parameters
        ----------
        t
            real numbers in any shape.

        Returns
        -------
        array of shape (*batch_shape, *t.shape, 2)
        """
        return np.moveaxis(_evaluate(self._taylor[0], _places(t)), 0, -1)

    def derivative(self, t: npt.ArrayLike, k: int = 1) -> Array:
        """Return b⁽ᵏ⁾(t) for any k ≥ 0; zero for k above the degree.

        Parameters
        ----------
        t
            real numbers in any shape.
        k
            how often to differentiate.

        Returns
        -------
        array of shape (*batch_shape, *t.shape, 2)
        """
        k = _whole(k, "k", 0)
        row = self._taylor[k] if k <= 2 else _taylor_row(self.points, k)
        # k! stays out of reach of overflow: above the degree the row is zero.
        factor = float(math.factorial(min(k, self.degree)))
        return np.moveaxis(_evaluate(factor * row, _places(t)), 0, -1)

    def series(self, t: npt.ArrayLike, order: int) -> Series:
        """Return the Taylor series of (u, v) at each t, as far as the given order.

        Parameters
        ----------
        t
            real numbers in any shape.
        order
            highest derivative wanted, ≥ 0.

        Returns
        -------
        Series whose values have shape (2, *batch_shape, *t.shape): row k holds b⁽ᵏ⁾(t)/k!
        """
        order = _whole(order, "order", 0)
        taylor = self._taylor[: order + 1] if order <= 2 else _taylor_matrix(self.points, order)
        return Series(_evaluate(taylor, _places(t)))

    def raised(self, times: int = 1) -> Bezier:
        """Return the same curve with its degree raised by ``times`` ≥ 0.

        Raises
        ------
        GeometryError
            if the degree would exceed 60.
        """
        n, times = self.degree, _whole(times, "times", 0)
        if n + times > MAX_DEGREE:
            raise GeometryError(
                f"`times` must leave the degree at {MAX_DEGREE} or below; "
                f"got {n} + {times}; raise it less"
            )
        new = _weights(n + times, times) / _binomials(n + times)[:, np.newaxis]
        return Bezier(new @ self.points)

    def lowered(self, times: int = 1) -> Bezier:
        """Return the curve of degree lower by ``times`` ≥ 0 with the nearest control polygon.

        The end points stay; of the others, raised again, the distance to the present control
        points is least (root of the sum of squares). It undoes `raised`.

        Raises
        ------
        GeometryError
            if the degree would fall below 1.
        """
        n, times = self.degree, _whole(times, "times", 0)
        if n - times < 1:
            raise GeometryError(
                f"`times` must leave the degree at 1 or above; got {n} − {times}; lower it less"
            )
        if times == 0:
            return self
        raising = _weights(n, times) / _binomials(n)[:, np.newaxis]
        points = np.concatenate([self.points[..., :1, :], self.points[..., -1:, :]], axis=-2)
        rest = self.points - raising[:, [0, -1]] @ points
        inner = np.linalg.pinv(raising[1:-1, 1:-1]) @ rest[..., 1:-1, :]
        return Bezier(np.concatenate([points[..., :1, :], inner, points[..., 1:, :]], axis=-2))

    def split(self, t: float) -> tuple[Bezier, Bezier]:
        """Cut the curve at 0 < t < 1 by de Casteljau's algorithm.

        Returns
        -------
        two Bezier of the same degree
            s ↦ b(ts) and s ↦ b(t + (1−t)s); they share the point b(t) to the last bit.

        Raises
        ------
        GeometryError
            if t is not a single number strictly between 0 and 1.
        """
        place = float(_inner_place(t))
        left, right = np.empty_like(self.points), np.empty_like(self.points)
        level: Array = self.points
        for k in range(self.degree + 1):
            left[..., k, :] = level[..., 0, :]
            right[..., -1 - k, :] = level[..., -1, :]
            level = (1.0 - place) * level[..., :-1, :] + place * level[..., 1:, :]
        return Bezier(left), Bezier(right)

    def reversed(self) -> Bezier:
        """Return t ↦ b(1 − t), the same curve run backwards."""
        return Bezier(self.points[..., ::-1, :])


# -- evaluation ------------------------------------------------------------------------------------


def _speed_scale(points: Array) -> float | Array:
    legs = np.linalg.norm(np.diff(points, axis=-2), axis=-1)
    scale = (points.shape[-2] - 1) * legs.max(axis=-1)
    return frozen(scale) if scale.ndim else float(scale)


def _evaluate(matrix: Array, t: Array) -> Array:
    """Multiply rows of scaled control values (…, n+1) by the powers tʲ(1−t)ⁿ⁻ʲ: (…, *t.shape)."""
    count = matrix.shape[-1]
    rows, flat = matrix.reshape(-1, count), t.reshape(-1)
    with np.errstate(all="ignore"):
        if flat.size <= BLOCK:
            values = rows @ _powers(flat, count - 1)
        else:
            values = np.empty((len(rows), flat.size))
            for start in range(0, flat.size, BLOCK):
                block = slice(start, start + BLOCK)
                np.matmul(rows, _powers(flat[block], count - 1), out=values[:, block])
    return values.reshape(matrix.shape[:-1] + t.shape)


def _powers(t: Array, degree: int) -> Array:
    """Return tʲ(1−t)ⁿ⁻ʲ for j = 0 … n, shape (n+1, len(t)).

    Each is a product of positive numbers on [0, 1], hence accurate relative to itself. The powers
    are doubled, x^(m+i) = x^m x^i, so that few calls fill the table.
    """
    table = np.empty((degree + 1, 2, t.size))
    table[0] = 1.0
    table[1, 0] = t
    np.subtract(1.0, t, out=table[1, 1])
    known = 1
    while known < degree:
        step = min(known, degree - known)
        np.multiply(table[1 : step + 1], table[known], out=table[known + 1 : known + step + 1])
        known += step
    result: Array = table[:, 0] * table[::-1, 1]
    return result


def _taylor_matrix(points: Array, order: int) -> Array:
    """Stack the rows k = 0 … order: shape (order+1, 2, *batch, n+1)."""
    rows = range(min(order, points.shape[-2] - 1) + 1)
    matrix = np.zeros((order + 1, 2, *points.shape[:-1]))
    for k in rows:
        matrix[k] = _taylor_row(points, k)
    return matrix


def _taylor_row(points: Array, k: int) -> Array:
    """Return the factors of tʲ(1−t)ⁿ⁻ʲ in b⁽ᵏ⁾(t)/k!, shape (2, *batch, n+1).

    b⁽ᵏ⁾/k! is the Bézier curve of degree n−k with control points C(n,k) Δᵏpᵢ. Raised to degree n,
    which only averages them, it shares its powers with the curve itself.
    """
    n = points.shape[-2] - 1
    if k > n:
        return np.zeros((2, *points.shape[:-1]))
    control = math.comb(n, k) * np.diff(points, n=k, axis=-2)
    return np.moveaxis(_weights(n, k) @ control, -1, 0)


@lru_cache(maxsize=256)
def _weights(degree: int, k: int) -> Array:
    """Return C(n−k, i) C(k, j−i), shape (n+1, n−k+1): degree raising by k, times C(n, j).

    The corner entries are 1 and alone in their rows: the end points pass through unrounded.
    """
    weights = np.zeros((degree + 1, degree - k + 1))
    for i in range(degree - k + 1):
        for j in range(i, i + k + 1):
            weights[j, i] = math.comb(degree - k, i) * math.comb(k, j - i)
    return frozen(weights)


def _binomials(degree: int) -> Array:
    return np.array([math.comb(degree, j) for j in range(degree + 1)], dtype=np.float64)


# -- closing ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class Seam:
    """How the end of a curve meets its beginning.

    Attributes
    ----------
    order
        −1 open; 0 (C⁰) the ends meet; 1 (C¹) also p₁ − p₀ = pₙ − pₙ₋₁, equal spacing; 2 (C²) also
        equal second differences there.
    g1
        True where the two tangents have the same direction and sense but not the same length: the
        seam is G¹ and not C¹. This is all that pₙ₋₁, p₀, p₁ lying on a line (in this order) gives.
    gaps
        array (3, 2): pₙ − p₀ less the turns, b′(1) − b′(0), b″(1) − b″(0).
    winding
        whole turns in u from beginning to end: the whole number nearest to (uₙ − u₀)/2π.
    reason
        the same in one sentence.
    """

    order: int
    g1: bool
    gaps: Array
    winding: int
    reason: str


def seam(curve: Bezier | npt.ArrayLike) -> Seam:
    """Report how smoothly one curve closes in the chart, u and u + 2π being the same.

    Parameters
    ----------
    curve
        a Bezier, or its control points (n+1, 2).

    Notes
    -----
    Differences of control points count as equal within ``CLOSING`` (1e-9) of the diagonal of the
    polygon's bounding box. Points that all coincide close with every order. Where p₁ = p₀ the
    curve stops at its seam: the order still speaks of b(t), but G¹ is not claimed, because a leg
    of length zero has no direction.

    Raises
    ------
    GeometryError
        if the points are not those of one Bézier curve.
    """
    points = _polygon(curve)
    n, turns = len(points) - 1, _turns(points)
    jumps = _jumps(points, turns)
    order = _order_of(jumps, _tolerance(points))
    meeting = _meeting(points)
    gaps = jumps * np.array([[1.0], [n], [n * (n - 1)]])
    reason = _reason(points, order, meeting, gaps, turns)
    return Seam(order, order == 0 and meeting == "smooth", frozen(gaps), turns, reason)


def _turns(points: Array) -> int:
    return round(float(points[-1, 0] - points[0, 0]) / TURN)


def _jumps(points: Array, turns: int) -> Array:
    """Return end less beginning for points, first and second differences: shape (3, 2)."""
    jumps = np.zeros((3, 2))
    jumps[0] = points[-1] - points[0] - (TURN * turns, 0.0)
    for k in range(1, min(3, len(points))):
        differences = np.diff(points, n=k, axis=0)
        jumps[k] = differences[-1] - differences[0]
    return jumps


def _tolerance(points: Array) -> float:
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    return CLOSING * diagonal + ROUNDING * float(np.abs(points).max())


def _order_of(jumps: Array, tolerance: float) -> int:
    """Return how many of the conditions hold, one after the other, less one."""
    holds = np.linalg.norm(jumps, axis=1) <= tolerance
    return int(np.cumprod(holds).sum()) - 1


def _meeting(points: Array) -> str:
    """Return how the directions of the first and the last leg compare: a key of `_MEETINGS`."""
    first, last = points[1] - points[0], points[-1] - points[-2]
    a, b = float(np.linalg.norm(first)), float(np.linalg.norm(last))
    rounding = ROUNDING * float(np.abs(points).max())
    if min(a, b) <= rounding:
        return "stop"
    if abs(float(first[0] * last[1] - first[1] * last[0])) > CLOSING * a * b + rounding * (a + b):
        return "corner"
    return "smooth" if float(first @ last) > 0 else "cusp"


def _reason(points: Array, order: int, meeting: str, gaps: Array, turns: int) -> str:
    if not np.ptp(points, axis=0).any():
        return "All control points coincide: the curve is a single point."
    if order == -1:
        du, dv = gaps[0]
        return f"The curve is open: its ends differ by {du:.4g} rad in u and {dv:.4g} rad in v."
    after = {0: "", 1: " after one turn in u", -1: " after one turn back in u"}
    meet = "The ends meet" + after.get(turns, f" after {turns} turns in u")
    if order == 0:
        return f"{meet} {_MEETINGS[meeting]}"
    if order == 1:
        return f"{meet} with equal first derivatives (C¹), but the second derivatives jump."
    return f"{meet} with equal first and second derivatives (C²)."


_MEETINGS = {
    "smooth": "with one tangent direction but different speed: G¹, not C¹, because "
    "p₁ − p₀ and pₙ − pₙ₋₁ have different lengths.",
    "corner": "only as points (C⁰): there is a corner, p₁ − p₀ and pₙ − pₙ₋₁ differ in direction.",
    "cusp": "only as points (C⁰): the curve turns back on itself, "
    "p₁ − p₀ and pₙ − pₙ₋₁ are opposite.",
    "stop": "only as points (C⁰): the curve stops there on one side, "
    "p₁ − p₀ or pₙ − pₙ₋₁ is zero and the other is not.",
}


def least_degree(order: int, winding: int = 0) -> int:
    """Return the lowest degree at which a proper curve closes with the given order.

    A coordinate polynomial of degree n whose derivatives 0 … r agree at 0 and 1 is a constant plus
    a combination of the Bernoulli polynomials of degrees r+2 … n. A curve that encloses anything
    needs two independent ones, so n ≥ r + 3. For n = r + 2 it runs to and fro on a segment, below
    that it is a point. With winding, u = u₀ + 2πkt at constant v always closes: 1.
    """
    _closing_order(order)
    return order + 3 if winding == 0 and order >= 0 else 1


def close(points: npt.ArrayLike, order: int, keep: Iterable[int] = ()) -> Array:
    """Close a curve by moving as few of its control points as possible.

    Parameters
    ----------
    points
        control points (n+1, 2), in radians.
    order
        0, 1 or 2 for C⁰, C¹ or C²; −1 leaves the curve open.
    keep
        indices of points that must not move, for instance the one being dragged.

    Returns
    -------
    array (n+1, 2)
        a new polygon whose `seam` has at least this order. Of the smallest sets of points that can
        meet the conditions it is the one that moves least in all (root of the sum of squares), and
        among equals the one nearest the end. The whole turns in u stay. Points that close already
        come back unchanged.

    Raises
    ------
    GeometryError
        if the degree is too low for a proper curve (`least_degree`), or ``keep`` forbids it.
    """
    old = _polygon(points)
    n, order = len(old) - 1, _closing_order(order)
    kept = {_index(i, n, "keep") for i in keep}
    return _closed(old, order, kept, _turns(old))


def _closed(points: Array, order: int, kept: set[int], turns: int) -> Array:
    jumps, tolerance = _jumps(points, turns), _tolerance(points)
    if _order_of(jumps, tolerance) >= order:
        return points.copy()
    _check_degree(len(points) - 1, order, turns)
    conditions = _conditions(len(points))[: order + 1]
    moves = _least_moves(conditions, -jumps[: order + 1], kept, tolerance)
    if moves is None:
        raise GeometryError(
            f"`keep` must leave free what {_NAMES[order]} has to move; "
            f"got {sorted(kept)}; release one of {_seam_points(conditions, kept)}"
        )
    return _joined(points, points + moves, turns)


def _conditions(count: int) -> Array:
    """Return the jumps as linear functions of the control points: shape (3, n+1)."""
    identity = np.eye(count)
    rows = np.zeros((3, count))
    for k in range(min(3, count)):
        differences = np.diff(identity, n=k, axis=0)
        rows[k] = differences[-1] - differences[0]
    return rows


def _least_moves(
    conditions: Array, wanted: Array, kept: set[int], tolerance: float
) -> Array | None:
    """Return displacements (n+1, 2) of the fewest points, with conditions @ moves = wanted."""
    free = [int(i) for i in np.flatnonzero(conditions.any(axis=0))[::-1] if i not in kept]
    for size in range(1, len(free) + 1):
        # Later points come first: an equally short move has to be shorter by more than rounding.
        best: Array | None = None
        for moves in _solutions(conditions, wanted, combinations(free, size), tolerance):
            if best is None or np.linalg.norm(moves) < (1 - CLOSING) * np.linalg.norm(best):
                best = moves
        if best is not None:
            return best
    return None


def _solutions(
    conditions: Array, wanted: Array, subsets: Iterable[tuple[int, ...]], tolerance: float
) -> Iterator[Array]:
    """Yield the shortest displacements for each subset that can meet the conditions."""
    for subset in subsets:
        columns = list(subset)
        moves = np.zeros((conditions.shape[1], 2))
        moves[columns] = np.linalg.lstsq(conditions[:, columns], wanted, rcond=None)[0]
        if np.linalg.norm(conditions @ moves - wanted, axis=1).max() <= 0.5 * tolerance:
            yield moves


def _joined(old: Array, new: Array, turns: int) -> Array:
    """Let the moved end repeat the other to the last bit, so that b(0) = b(1) exactly."""
    turn = np.array([TURN * turns, 0.0])
    if (new[-1] != old[-1]).any():
        new[-1] = new[0] + turn
    elif (new[0] != old[0]).any():
        new[0] = new[-1] - turn
    return new


def _check_degree(degree: int, order: int, turns: int) -> None:
    least = least_degree(order, turns)
    if degree < least:
        shape = "a single point" if degree <= order + 1 else "a segment run to and fro"
        raise GeometryError(
            f"`points` must have degree ≥ {least} to close with {_NAMES[order]}; got degree "
            f"{degree}, where only {shape} closes like that; raise the degree first"
        )


def _seam_points(conditions: Array, kept: set[int]) -> list[int]:
    return [int(i) for i in np.flatnonzero(conditions.any(axis=0)) if i in kept]


# -- editing ---------------------------------------------------------------------------------------


def drag(points: npt.ArrayLike, index: int, to: npt.ArrayLike, order: int | None = None) -> Array:
    """Move one control point and keep the curve closed the way it is meant to be.

    Parameters
    ----------
    points
        control points (n+1, 2), in radians.
    index
        which point moves, 0 … n.
    to
        where it goes: (u, v). It ends exactly there.
    order
        closing order to keep: 0, 1 or 2; None or −1 for an open curve, where nothing else moves.

    Returns
    -------
    array (n+1, 2)
        the new polygon. The joint p₀ = pₙ takes its neighbours along as a rigid group: p₁, pₙ₋₁
        for C¹, also p₂, pₙ₋₂ for C². For any other point the fewest others follow, see `close`.

    Raises
    ------
    GeometryError
        if the index or the place makes no sense, or `close` refuses.
    """
    old = _polygon(points)
    n, order = len(old) - 1, _closing_order(order)
    index, place = _index(index, n, "index"), _place(to, "to")
    new = old.copy()
    if order >= 0 and index in (0, n):
        new[_joint(n, order)] += place - old[index]
        # Ends that were equal to the last bit stay so.
        new[n - index] = place + (old[n - index] - old[index])
    new[index] = place
    return _closed(new, order, {index}, _turns(old))


def _joint(degree: int, order: int) -> list[int]:
    """Return the joint and the points tied to it: 0 … order and their mirror images."""
    near = range(min(order, degree) + 1)
    return sorted({*near, *(degree - i for i in near)})


def insert(points: npt.ArrayLike, leg: int, at: npt.ArrayLike, order: int | None = None) -> Array:
    """Put a new control point on a leg of the polygon: the degree rises by one, the curve changes.

    Parameters
    ----------
    points
        control points (n+1, 2), in radians.
    leg
        the point comes between p_leg and p_(leg+1): 0 … n−1.
    at
        where: (u, v).
    order
        closing order to restore afterwards by `close`, which leaves the new point alone.

    Raises
    ------
    GeometryError
        if the leg or the place makes no sense, the degree would exceed 60, or `close` refuses.

    See Also
    --------
    Bezier.raised : one more control point without changing the curve.
    """
    old = _polygon(points)
    n, order = len(old) - 1, _closing_order(order)
    leg = _index(leg, n - 1, "leg")
    if n == MAX_DEGREE:
        raise GeometryError(
            f"`points` must have degree ≤ {MAX_DEGREE}; got one more; remove a point first"
        )
    new = np.insert(old, leg + 1, _place(at, "at"), axis=0)
    return _closed(new, order, {leg + 1}, _turns(old))


def remove(points: npt.ArrayLike, index: int, order: int | None = None) -> Array:
    """Take one control point out of the polygon: the degree falls by one, the curve changes.

    Parameters
    ----------
    points
        control points (n+1, 2), in radians.
    index
        which point goes. Of a closed curve the joint goes as a whole, p₀ with pₙ, and p₁ is the
        new joint.
    order
        closing order to restore afterwards by `close`.

    Raises
    ------
    GeometryError
        if the index makes no sense, fewer than two points would remain, or `close` refuses.
    """
    old = _polygon(points)
    n, order = len(old) - 1, _closing_order(order)
    index = _index(index, n, "index")
    if n == 1:
        raise GeometryError("`points` must keep at least 2 points; got 2; insert another first")
    turns = _turns(old)
    if order < 0 or index not in (0, n):
        return _closed(np.delete(old, index, axis=0), order, set(), turns)
    new = old[1:].copy()
    new[-1] = new[0] + np.array([TURN * turns, 0.0])
    return _closed(new, order, set(), turns)


# -- what may come in ------------------------------------------------------------------------------


def _checked(points: npt.ArrayLike) -> Array:
    array = finite_array(points, "points")
    if array.ndim < 2 or array.shape[-1] != 2 or array.shape[-2] < 2:
        raise GeometryError(
            f"`points` must have shape (n+1, 2) with n ≥ 1; got {array.shape}; "
            "give a row (u, v) for every control point"
        )
    if array.shape[-2] > MAX_DEGREE + 1:
        raise GeometryError(
            f"`points` must have degree ≤ {MAX_DEGREE}; got {array.shape[-2]} points, "
            f"degree {array.shape[-2] - 1}; use fewer"
        )
    if array.size and np.abs(array).max() > LARGEST:
        raise GeometryError(
            f"`points` must be at most {LARGEST:g} in size; got {np.abs(array).max():g}; "
            "take whole turns off the angles"
        )
    return array


def _polygon(curve: Bezier | npt.ArrayLike) -> Array:
    points = curve.points if isinstance(curve, Bezier) else _checked(curve)
    if points.ndim != 2:
        raise GeometryError(
            f"`points` must be those of one curve, shape (n+1, 2); got {points.shape}; "
            "take the curves of a batch one by one"
        )
    return points


def _places(t: npt.ArrayLike) -> Array:
    """Return t as float64; NaN and infinity pass, they give NaN."""
    if isinstance(t, np.ndarray) and t.dtype == np.float64:
        return t
    try:
        array = np.asarray(t)
    except ValueError:
        array = np.array(None)
    if array.dtype.kind not in "fiub" and array.size:
        raise GeometryError(
            f"`t` must be made of real numbers; got {type(t).__name__}; "
            "give a number or an array of numbers"
        )
    return array.astype(np.float64)


def _inner_place(t: float) -> Array:
    place = finite_array(t, "t")
    if place.ndim != 0 or not 0.0 < place < 1.0:
        raise GeometryError(
            f"`t` must be one number with 0 < t < 1; got {t}; a curve is cut in its interior"
        )
    return place


def _place(value: npt.ArrayLike, name: str) -> Array:
    place = finite_array(value, name)
    if place.shape != (2,):
        raise GeometryError(
            f"`{name}` must be one point (u, v); got shape {place.shape}; give two numbers"
        )
    return place


def _whole(value: Any, name: str, least: int) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise GeometryError(f"`{name}` must be a whole number; got {value!r}; give an int")
    if value < least:
        raise GeometryError(f"`{name}` must be at least {least}; got {value}; give a larger one")
    return int(value)


def _index(value: Any, last: int, name: str) -> int:
    index = _whole(value, name, 0)
    if index > last:
        raise GeometryError(
            f"`{name}` must lie between 0 and {last}; got {index}; counting starts at 0"
        )
    return index


def _closing_order(order: int | None) -> int:
    value = -1 if order is None else _whole(order, "order", -1)
    if value > 2:
        raise GeometryError(
            f"`order` must be 0, 1 or 2 (C⁰, C¹, C²), or −1 for open; got {value}; choose one"
        )
    return value
