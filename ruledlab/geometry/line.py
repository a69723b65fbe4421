"""Study's map: oriented lines as dual unit vectors, the dual angle and the common perpendicular.

The line through the point c with unit direction x is X = x + ε x̄ with the moment x̄ = c × x
(paper, §2.1 and eq. (2)). A point p lies on it exactly where p × x = x̄.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .checks import PARALLEL, UNIT, Array, GeometryError, finite_array, frozen
from .dual import Dual, cross, inner

__all__ = [
    "CommonPerpendicular",
    "Line",
    "common_perpendicular",
    "dual_angle",
    "on_sphere",
    "relation",
]

MEETING = 1e-9
"""Distance, as a fraction of max(1, distances from the origin), below which two lines meet."""


@dataclass(frozen=True, eq=False, slots=True)
class Line:
    """An oriented line of space as the dual unit vector X = x + ε x̄, or a batch of them.

    Parameters
    ----------
    direction
        x, shape (…, 3), of length 1 within the tolerance ``UNIT``.
    moment
        x̄ = c × x for any point c of the line, shape (…, 3), in the user's unit of length. It is
        normal to x: |⟨x, x̄⟩| ≤ ``UNIT`` · max(1, ‖x̄‖). Leading axes of both broadcast.

    Raises
    ------
    GeometryError
        where the parts are not finite, not of length 3, or break one of the two conditions.
        `Line.from_plucker` normalises instead of refusing.
    """

    direction: Array
    moment: Array

    def __post_init__(self) -> None:
        x, moment = _vectors(direction=self.direction, moment=self.moment)
        _require_unit(x)
        _require_normal(
            x,
            moment,
            "`moment` must be normal to `direction`",
            "give moment = point × direction, or use Line.from_point_direction",
        )
        _store(self, x, moment)

    @classmethod
    def unchecked(cls, direction: npt.ArrayLike, moment: npt.ArrayLike) -> Line:
        """Return a line from parts known to be right; NaN marks places without a line.

        For results of a computation, which need no second check and may be undefined in places.
        Both parts must have the same shape (…, 3).
        """
        line = object.__new__(cls)
        _store(line, direction, moment)
        return line

    @classmethod
    def from_point_direction(cls, point: npt.ArrayLike, direction: npt.ArrayLike) -> Line:
        """Return the line through ``point`` along ``direction``, which may have any length but 0.

        Both have shape (…, 3) and broadcast.
        """
        c, d = _vectors(point=point, direction=direction)
        x = _unit(d, "`direction` must not be the zero vector", "give the vector the line follows")
        return cls.unchecked(x, _moment(c, x))

    @classmethod
    def through(cls, p: npt.ArrayLike, q: npt.ArrayLike) -> Line:
        """Return the line through two distinct points, oriented from ``p`` to ``q``."""
        start, end = _vectors(p=p, q=q)
        x = _unit(end - start, "`p` and `q` must be distinct points", "move one of them")
        return cls.unchecked(x, _moment(start, x))

    @classmethod
    def from_plucker(cls, six: npt.ArrayLike) -> Line:
        """Return the line with Plücker coordinates (d, m), shape (…, 6), of any positive scale.

        The result is x = d/‖d‖ and x̄ = m/‖d‖ less its component along x. A negative factor
        gives the same line with the opposite orientation.

        Raises
        ------
        GeometryError
            where d = 0 (a line at infinity) or where the Plücker relation ⟨d, m⟩ = 0 is broken
            by more than the tolerance ``UNIT``.
        """
        array = finite_array(six, "six")
        if array.ndim == 0 or array.shape[-1] != 6:
            raise GeometryError(
                f"`six` must have shape (…, 6); got {array.shape}; "
                "give the direction and the moment, one after the other, along the last axis"
            )
        d, m = array[..., :3], array[..., 3:]
        x = _unit(d, "`six` must not be a line at infinity, d = 0", "leave these lines out")
        moment = m / _length(d)
        _require_normal(
            x,
            moment,
            "`six` must satisfy the Plücker relation ⟨d, m⟩ = 0",
            "give m = point × d, or Line.from_point_direction(point, d)",
        )
        return cls.unchecked(x, _less_along(moment, x))

    @classmethod
    def from_dual(cls, vector: Dual) -> Line:
        """Return the line of a dual unit vector, parts of shape (…, 3).

        `ruledlab.geometry.normalize` makes a dual unit vector of any dual vector whose real part
        is not zero.
        """
        if not isinstance(vector, Dual):
            raise GeometryError(
                f"`vector` must be a Dual; got {type(vector).__name__}; "
                "write Line(direction, moment) for two arrays"
            )
        return cls(vector.real, vector.dual)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch: () for a single line."""
        return self.direction.shape[:-1]

    @property
    def dual(self) -> Dual:
        """The dual unit vector x + ε x̄."""
        return Dual(self.direction, self.moment)

    @property
    def plucker(self) -> Array:
        """Plücker coordinates (x, x̄), shape (…, 6)."""
        return np.concatenate([self.direction, self.moment], axis=-1)

    @property
    def foot(self) -> Array:
        """The point x × x̄ of the line nearest the origin, shape (…, 3)."""
        point: Array = cross(self.direction, self.moment)
        return point

    def point(self, w: npt.ArrayLike) -> Array:
        """Return foot + w x, shape (…, 3); the length ``w`` broadcasts against `shape`."""
        steps = finite_array(w, "w")
        _require_broadcast({"w": steps.shape, "line": self.shape})
        return self.foot + steps[..., np.newaxis] * self.direction

    def reversed(self) -> Line:
        """Return the same lines with the opposite orientation, −X."""
        return Line.unchecked(-self.direction, -self.moment)

    def distance_to(self, point: npt.ArrayLike) -> Array:
        """Return the distance ‖p × x − x̄‖ of ``point``, shape (…, 3), from the line."""
        (p,) = _vectors(point=point)
        _require_broadcast({"point": p.shape[:-1], "line": self.shape})
        distance: Array = np.linalg.norm(cross(p, self.direction) - self.moment, axis=-1)
        return distance

    def transformed(
        self, rotation: npt.ArrayLike, translation: npt.ArrayLike = (0.0, 0.0, 0.0)
    ) -> Line:
        """Return the lines after the rigid motion p ↦ R p + t: x ↦ R x, x̄ ↦ R x̄ + t × R x.

        Parameters
        ----------
        rotation
            R, shape (…, 3, 3): orthogonal within ``UNIT``, with determinant +1.
        translation
            t, shape (…, 3), in the user's unit of length.
        """
        matrix = _rotation(rotation)
        (t,) = _vectors(translation=translation)
        _require_broadcast(
            {"rotation": matrix.shape[:-2], "translation": t.shape[:-1], "line": self.shape}
        )
        turned = _turned(matrix, self.direction)
        x = turned / _length(turned)
        moment = _less_along(_turned(matrix, self.moment) + cross(t, x), x)
        return Line.unchecked(np.broadcast_to(x, moment.shape), moment)

    def __getitem__(self, key: Any) -> Line:
        """Index the batch: ``line[i]`` is the i-th line."""
        key = key if isinstance(key, tuple) else (key,)
        if not any(k is Ellipsis for k in key):
            key = (*key, Ellipsis)
        return Line.unchecked(self.direction[*key, :], self.moment[*key, :])


def on_sphere(chart: Array) -> Array:
    """Return the directions (cos u sin v, sin u sin v, cos v), shape (…, 3).

    ``chart`` has shape (…, 2): longitudes u and colatitudes v in radians. At the poles, v = 0 and
    v = π, every u gives the same direction.
    """
    u, v = chart[..., 0], chart[..., 1]
    points: Array = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1)
    return points


@dataclass(frozen=True, eq=False, slots=True)
class CommonPerpendicular:
    """What `common_perpendicular` found; every part has the common batch shape of the two lines.

    Attributes
    ----------
    line
        the perpendicular; its parts are NaN for equal and opposite lines, which have none.
    foot_a, foot_b
        its points on a and on b, shape (…, 3).
    angle, distance
        θ in [0, π] and the signed distance d with foot_b = foot_a + d n, n the direction of `line`.
    relation
        the position of the two lines to each other, see `relation`.
    """

    line: Line
    foot_a: Array
    foot_b: Array
    angle: Array
    distance: Array
    relation: str | npt.NDArray[np.str_]


def dual_angle(a: Line, b: Line, *, parallel: float = PARALLEL) -> Dual:
    """Return the dual angle θ + ε d from ``a`` to ``b``, with ⟨X, Y⟩ = cos θ − ε d sin θ.

    θ in [0, π] (radians) is the angle of the directions x and y. The common perpendicular is
    oriented along n = x × y/‖x × y‖, and d (the user's unit) is the way from a to b along +n: for
    the feet p on a and q on b, d = ⟨q − p, n⟩. Hence dual_angle(b, a) has the same d, and
    reversing one line turns θ into π − θ and d into −d.

    Parameters
    ----------
    a, b
        lines; their batches broadcast.
    parallel
        sin θ up to which two lines count as parallel. There is no n then: θ is 0 or π exactly
        and d is the distance, never negative.

    Notes
    -----
    θ = atan2(‖x × y‖, ⟨x, y⟩) and x × y = x × (y ∓ x) keep full accuracy for nearly parallel
    lines, where arccos loses half of the digits. Equal lines have 0 + ε 0, meeting lines d = 0,
    both to rounding.
    """
    pair = _pair(a, b, parallel)
    return Dual(_angle(pair), _distance(pair))


def relation(
    a: Line, b: Line, *, parallel: float = PARALLEL, meeting: float = MEETING
) -> str | npt.NDArray[np.str_]:
    """Return how two lines lie: a str, or an array of them for a batch.

    ``"skew"``, ``"meeting"`` (one common point), ``"parallel"``, ``"antiparallel"`` (parallel,
    oppositely oriented), ``"equal"``, ``"opposite"`` (the same line reversed), and ``"undefined"``
    where a line is NaN.

    Parameters
    ----------
    a, b
        lines; their batches broadcast.
    parallel
        sin θ up to which the directions count as parallel.
    meeting
        distance of the lines, as a fraction of max(1, their distances from the origin), up to
        which they count as having a point in common.
    """
    pair = _pair(a, b, parallel)
    return _relation(pair, _distance(pair), meeting)


def common_perpendicular(
    a: Line, b: Line, *, parallel: float = PARALLEL, meeting: float = MEETING
) -> CommonPerpendicular:
    """Return the line that meets ``a`` and ``b`` at right angles, with both of its feet.

    It is the dual vector X × Y normalised, oriented along n = x × y, so that
    foot_b = foot_a + d n with the signed distance d of `dual_angle`.

    - meeting lines: it passes through the meeting point, both feet are that point;
    - parallel and antiparallel lines have many: the one through the point of ``a`` nearest the
      origin is chosen, oriented from a to b, so that d is positive;
    - equal and opposite lines: its parts are NaN, both feet are the point nearest the origin.

    Parameters and tolerances are those of `relation`.
    """
    pair = _pair(a, b, parallel)
    distance = _distance(pair)
    kind = _relation(pair, distance, meeting)
    n = _normal(pair, distance, np.isin(kind, ("equal", "opposite")))
    foot_a, foot_b = _feet(pair)
    line = Line.unchecked(n, cross(foot_a, n))
    return CommonPerpendicular(line, frozen(foot_a), frozen(foot_b), _angle(pair), distance, kind)


# -- checks ---------------------------------------------------------------------------------------


def _vectors(**named: npt.ArrayLike) -> tuple[Array, ...]:
    """Return finite arrays of one common shape (…, 3)."""
    arrays = [finite_array(value, name) for name, value in named.items()]
    for name, array in zip(named, arrays, strict=True):
        if array.ndim == 0 or array.shape[-1] != 3:
            raise GeometryError(
                f"`{name}` must have shape (…, 3); got {array.shape}; "
                "give x, y, z along the last axis"
            )
    _require_broadcast({name: array.shape for name, array in zip(named, arrays, strict=True)})
    return tuple(np.broadcast_arrays(*arrays))


def _require_broadcast(shapes: dict[str, tuple[int, ...]]) -> None:
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError:
        names = " and ".join(f"`{name}`" for name in shapes)
        got = " and ".join(str(shape) for shape in shapes.values())
        raise GeometryError(
            f"{names} must have leading axes that broadcast; got {got}; "
            "give equal shapes or insert axes of length 1"
        ) from None


def _store(line: Line, direction: npt.ArrayLike, moment: npt.ArrayLike) -> None:
    object.__setattr__(line, "direction", frozen(direction))
    object.__setattr__(line, "moment", frozen(moment))


def _length(vectors: Array) -> Array:
    """Return norms, kept as (…, 1); scaled first, so that squares neither overflow nor vanish."""
    largest = np.abs(vectors).max(axis=-1, keepdims=True, initial=0.0)
    scale = np.where(largest > 0, largest, 1.0)
    length: Array = scale * np.linalg.norm(vectors / scale, axis=-1, keepdims=True)
    return length


def _unit(vectors: Array, rule: str, remedy: str) -> Array:
    zeros = int((~vectors.any(axis=-1)).sum())
    if zeros:
        raise GeometryError(
            f"{rule}; got {zeros} of {vectors.size // 3} with zero length; {remedy}"
        )
    return vectors / _length(vectors)


def _moment(point: Array, x: Array) -> Array:
    """Return point × x, normal to x to rounding however far away along x the point is."""
    moment: Array = cross(_less_along(point, x), x)
    return moment


def _less_along(vectors: Array, x: Array) -> Array:
    """Return the part of the vectors normal to the unit vector x."""
    return vectors - np.asarray(inner(vectors, x))[..., np.newaxis] * x


def _require_unit(x: Array) -> None:
    lengths = np.asarray(np.linalg.norm(x, axis=-1))
    worst = _worst(np.abs(lengths - 1.0))
    if worst is not None:
        raise GeometryError(
            f"`direction` must have length 1 within {UNIT:g}; got {lengths[worst]:.6g}; "
            "use Line.from_plucker, which normalises"
        )


def _require_normal(x: Array, moment: Array, rule: str, remedy: str) -> None:
    products = np.asarray(inner(x, moment))
    worst = _worst(np.abs(products) / np.maximum(1.0, np.linalg.norm(moment, axis=-1)))
    if worst is not None:
        raise GeometryError(
            f"{rule} within {UNIT:g}; got ⟨x, x̄⟩ = {products[worst]:.6g} with x of length 1; "
            f"{remedy}"
        )


def _worst(violation: Array) -> tuple[int, ...] | None:
    """Return the place of the largest violation of the tolerance UNIT, if there is one."""
    violation = np.asarray(violation)
    if violation.size == 0 or violation.max() <= UNIT:
        return None
    return tuple(int(i) for i in np.unravel_index(violation.argmax(), violation.shape))


def _rotation(value: npt.ArrayLike) -> Array:
    matrix = finite_array(value, "rotation")
    if matrix.ndim < 2 or matrix.shape[-2:] != (3, 3):
        raise GeometryError(
            f"`rotation` must have shape (…, 3, 3); got {matrix.shape}; give a rotation matrix"
        )
    error = np.abs(np.swapaxes(matrix, -1, -2) @ matrix - np.eye(3)).max(initial=0.0)
    if error > UNIT:
        raise GeometryError(
            f"`rotation` must be orthogonal within {UNIT:g}; got RᵀR off the identity by "
            f"{error:.3g}; make its columns orthonormal"
        )
    if (np.linalg.det(matrix) < 0).any():
        raise GeometryError(
            "`rotation` must have determinant +1; got a reflection; "
            "it is no rigid motion and would turn the signs of distances"
        )
    return matrix


def _turned(matrix: Array, vectors: Array) -> Array:
    return (matrix @ vectors[..., np.newaxis])[..., 0]


# -- two lines ------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, slots=True)
class _Pair:
    """Two lines side by side: directions, feet p and q, w = x × y = n sin θ, and what follows."""

    x: Array
    y: Array
    p: Array
    q: Array
    w: Array
    sine: Array
    cosine: Array
    parallel: npt.NDArray[np.bool_]


def _pair(a: Line, b: Line, tolerance: float) -> _Pair:
    for name, line in (("a", a), ("b", b)):
        if not isinstance(line, Line):
            raise GeometryError(
                f"`{name}` must be a Line; got {type(line).__name__}; "
                "make one with Line.through(p, q)"
            )
    _require_broadcast({"a": a.shape, "b": b.shape})
    x, y, p, q = np.broadcast_arrays(a.direction, b.direction, a.foot, b.foot)
    cosine = np.asarray(inner(x, y))
    # The difference is exact for nearly equal directions, the product x × y itself is not.
    w = cross(x, y - np.where(cosine < 0, -1.0, 1.0)[..., np.newaxis] * x)
    sine = np.linalg.norm(w, axis=-1)
    return _Pair(x, y, p, q, w, sine, cosine, sine <= tolerance)


def _angle(pair: _Pair) -> Array:
    flat = np.where(pair.cosine < 0, np.pi, 0.0)
    angle: Array = np.where(pair.parallel, flat, np.arctan2(pair.sine, pair.cosine))[()]
    return angle


def _divisor(pair: _Pair) -> Array:
    """Return sin θ, and 1 where the lines are parallel and nothing is divided by it."""
    return np.where(pair.parallel, 1.0, pair.sine)


def _across(pair: _Pair) -> Array:
    """Return the part of q − p normal to x: the whole way from a to b if they are parallel."""
    return _less_along(pair.q - pair.p, pair.x)


def _distance(pair: _Pair) -> Array:
    along_normal = inner(pair.q - pair.p, pair.w) / _divisor(pair)
    apart = np.linalg.norm(_across(pair), axis=-1)
    distance: Array = np.where(pair.parallel, apart, along_normal)[()]
    return distance


def _relation(pair: _Pair, distance: Array, meeting: float) -> str | npt.NDArray[np.str_]:
    lengths = np.linalg.norm(pair.p, axis=-1), np.linalg.norm(pair.q, axis=-1)
    apart = np.abs(distance) > meeting * np.maximum(1.0, np.maximum(*lengths))
    parallel, against = pair.parallel, pair.cosine < 0
    kinds = np.select(
        [
            np.isnan(distance),
            parallel & apart & ~against,
            parallel & apart,
            parallel & ~against,
            parallel,
            apart,
        ],
        ["undefined", "parallel", "antiparallel", "equal", "opposite", "skew"],
        "meeting",
    )
    return kinds if kinds.ndim else str(kinds)


def _normal(pair: _Pair, distance: Array, undefined: npt.NDArray[np.bool_]) -> Array:
    """Return n: along x × y, for parallel lines from a to b, NaN for one and the same line."""
    length = np.where(pair.parallel, distance, pair.sine)
    length = np.where(undefined, np.nan, length)[..., np.newaxis]
    return np.where(pair.parallel[..., np.newaxis], _across(pair), pair.w) / length


def _feet(pair: _Pair) -> tuple[Array, Array]:
    """Return p + s x and q + r y with their difference along w; for parallel lines p and beside it.

    The product of q + r y − p − s x with y × w gives s, with x × w it gives r.
    """
    gap, square = pair.q - pair.p, _divisor(pair) ** 2
    s = np.asarray(inner(gap, cross(pair.y, pair.w)) / square)[..., np.newaxis]
    r = np.asarray(inner(gap, cross(pair.x, pair.w)) / square)[..., np.newaxis]
    parallel = pair.parallel[..., np.newaxis]
    foot_a = np.where(parallel, pair.p, pair.p + s * pair.x)
    foot_b = np.where(parallel, pair.p + _across(pair), pair.q + r * pair.y)
    return foot_a, foot_b
