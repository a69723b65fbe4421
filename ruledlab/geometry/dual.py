"""Dual numbers a + ε ā with ε² = 0, over numbers, arrays or series, and vectors of them.

One rule makes every function dual (paper, §2.1): f(a + ε ā) = f(a) + ε ā f′(a).
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from .checks import GeometryError
from .series import Series, plain

__all__ = ["Dual", "cross", "inner", "norm", "normalize"]


class Dual:
    """The dual number a + ε ā.

    Parameters
    ----------
    real, dual
        a and ā: numbers, arrays that broadcast, or `Series`.

    Notes
    -----
    ``+ - * / **`` and the ufuncs sqrt, exp, log, sin, cos, tan, arcsin, arccos, arctan, arctan2,
    sinh, cosh, tanh, absolute, square and power work with numbers, arrays and series mixed in.
    The ring has zero divisors, the pure duals ε ā; dividing by one raises `GeometryError`.
    Outside the real domain of a function both parts are NaN. Comparison is by identity: dual
    numbers have no order, and equality to rounding is a question for ``numpy.allclose``.
    """

    __slots__ = ("dual", "real")

    real: Any
    dual: Any

    def __init__(self, real: Any, dual: Any = 0.0) -> None:
        self.real = _part(real, "real")
        self.dual = _part(dual, "dual")

    def __repr__(self) -> str:
        return f"Dual({plain(self.real)!r}, {plain(self.dual)!r})"

    def __getitem__(self, key: Any) -> Dual:
        """Index both parts, which are broadcast against each other first."""
        real, dual = _broadcast_parts(self)
        return Dual(real[key], dual[key])

    def conjugate(self) -> Dual:
        """Return a − ε ā; the product with it is a²."""
        return Dual(self.real, -self.dual)

    # -- arithmetic ------------------------------------------------------------------------------

    def __neg__(self) -> Dual:
        return Dual(-self.real, -self.dual)

    def __pos__(self) -> Dual:
        return self

    def __abs__(self) -> Dual:
        result: Dual = np.absolute(self)
        return result

    def __add__(self, other: Any) -> Dual:
        return _dispatch(_add, self, other)

    def __radd__(self, other: Any) -> Dual:
        return _dispatch(_add, other, self)

    def __sub__(self, other: Any) -> Dual:
        return _dispatch(_subtract, self, other)

    def __rsub__(self, other: Any) -> Dual:
        return _dispatch(_subtract, other, self)

    def __mul__(self, other: Any) -> Dual:
        return _dispatch(_multiply, self, other)

    def __rmul__(self, other: Any) -> Dual:
        return _dispatch(_multiply, other, self)

    def __truediv__(self, other: Any) -> Dual:
        return _dispatch(_divide, self, other)

    def __rtruediv__(self, other: Any) -> Dual:
        return _dispatch(_divide, other, self)

    def __pow__(self, other: Any) -> Dual:
        return _dispatch(_power, self, other)

    def __rpow__(self, other: Any) -> Dual:
        return _dispatch(_power, other, self)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        function = _UFUNCS.get(ufunc)
        if function is None or method != "__call__" or options:
            return NotImplemented
        if not all(_is_dualisable(value) for value in inputs):
            return NotImplemented
        with np.errstate(all="ignore"):
            return function(*inputs)


def _part(value: Any, name: str) -> Any:
    if isinstance(value, (float, Series, np.floating)):
        return value
    if isinstance(value, (int, np.integer)):
        return float(value)
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError
        return array.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise GeometryError(
            f"`{name}` must be a real number, an array of them or a Series; "
            f"got {type(value).__name__}; give numbers"
        ) from None


def _broadcast_parts(value: Dual) -> tuple[Any, Any]:
    """Return both parts as arrays or series of one shape."""
    shapes = np.shape(_value(value.real)), np.shape(_value(value.dual))
    shape = np.broadcast_shapes(*shapes)
    return _widened(value.real, shape), _widened(value.dual, shape)


def _value(part: Any) -> Any:
    return part.value if isinstance(part, Series) else part


def _widened(part: Any, shape: tuple[int, ...]) -> Any:
    if not isinstance(part, Series):
        return part if np.shape(part) == shape and shape else np.broadcast_to(part, shape)
    if part.shape == shape:
        return part
    rows, missing = part.order + 1, len(shape) - len(part.shape)
    aligned = part.coefficients.reshape(rows, *(1,) * missing, *part.shape)
    return Series(np.broadcast_to(aligned, (rows, *shape)))


def _is_dualisable(value: Any) -> bool:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.dtype.kind in "fiub"
    return isinstance(value, (Dual, Series, float, int))


def _dispatch(function: Callable[[Any, Any], Dual], a: Any, b: Any) -> Dual:
    with np.errstate(all="ignore"):
        return function(a, b) if _is_dualisable(a) and _is_dualisable(b) else NotImplemented


def _parts(value: Any) -> tuple[Any, Any]:
    """Return (a, ā); anything that is not dual has ā = 0."""
    return (value.real, value.dual) if isinstance(value, Dual) else (value, 0.0)


def _add(a: Any, b: Any) -> Dual:
    (a, a_), (b, b_) = _parts(a), _parts(b)
    return Dual(a + b, a_ + b_)


def _subtract(a: Any, b: Any) -> Dual:
    (a, a_), (b, b_) = _parts(a), _parts(b)
    return Dual(a - b, a_ - b_)


def _multiply(a: Any, b: Any) -> Dual:
    if not isinstance(a, Dual):
        return Dual(a * b.real, a * b.dual)
    if not isinstance(b, Dual):
        return Dual(a.real * b, a.dual * b)
    return Dual(a.real * b.real, a.real * b.dual + a.dual * b.real)


def _divide(a: Any, b: Any) -> Dual:
    (a, a_), (b, b_) = _parts(a), _parts(b)
    _refuse_pure_dual(b)
    quotient = a / b
    return Dual(quotient, (a_ - quotient * b_) / b)


def _refuse_pure_dual(divisor: Any) -> None:
    value = _value(divisor)
    zeros = int(np.count_nonzero(np.equal(value, 0)))
    if zeros:
        raise GeometryError(
            "`divisor` must have a real part other than 0: a pure dual number ε b is a zero "
            f"divisor (ε b · ε = 0) and has no inverse; got {zeros} of {np.size(value)} with real "
            "part 0; leave these places out"
        )


# -- functions: f(a + ε ā) = f(a) + ε ā f′(a) -----------------------------------------------------


def _lifted(f: Callable[[Any], Any], slope: Callable[[Any], Any]) -> Callable[[Dual], Dual]:
    def function(a: Dual) -> Dual:
        return Dual(f(a.real), a.dual * slope(a.real))

    return function


def _power(a: Any, b: Any) -> Dual:
    (a, a_), (b, b_) = _parts(a), _parts(b)
    if np.ndim(b) == 0 and not isinstance(b, Series) and b < 0:
        _refuse_pure_dual(a)
    value = np.power(a, b)
    if isinstance(b_, float) and b_ == 0.0:
        return Dual(value, a_ * (b * np.power(a, _lowered(b))))
    return Dual(value, value * (b_ * np.log(a) + np.divide(b * a_, a)))


def _lowered(exponent: Any) -> Any:
    """Return b − 1, and 0 for b = 0, where b aᵇ⁻¹ is 0 even if a is."""
    if isinstance(exponent, Series):
        return exponent - 1.0
    return np.where(np.equal(exponent, 0), 0.0, np.subtract(exponent, 1.0))[()]


def _arctan2(y: Any, x: Any) -> Dual:
    (y, y_), (x, x_) = _parts(y), _parts(x)
    return Dual(np.arctan2(y, x), np.divide(x * y_ - y * x_, x * x + y * y))


def _log(a: Dual) -> Dual:
    """NaN in both parts for a < 0: the slope 1/a alone would not notice."""
    value = np.log(a.real)
    return Dual(value, np.divide(a.dual, a.real) + value * 0.0)


def _absolute(a: Dual) -> Dual:
    """Return |a| + ε sign(a) ā; at a = 0 only ā = 0 has a dual part, the others are NaN."""
    corner = np.equal(_value(a.real), 0) & _nonzero(a.dual)
    return Dual(np.absolute(a.real), a.dual * np.sign(a.real) + np.where(corner, np.nan, 0.0))


def _nonzero(part: Any) -> Any:
    return np.any(part.coefficients, axis=0) if isinstance(part, Series) else np.not_equal(part, 0)


_sqrt = _lifted(np.sqrt, lambda a: 0.5 / np.sqrt(a))

_UFUNCS: dict[np.ufunc, Callable[..., Dual]] = {
    np.add: _add,
    np.subtract: _subtract,
    np.multiply: _multiply,
    np.true_divide: _divide,
    np.power: _power,
    np.float_power: _power,
    np.arctan2: _arctan2,
    np.negative: operator.neg,
    np.positive: operator.pos,
    np.square: lambda a: _multiply(a, a),
    np.reciprocal: lambda a: _divide(1.0, a),
    np.absolute: _absolute,
    np.fabs: _absolute,
    np.sqrt: _sqrt,
    np.log: _log,
    np.exp: _lifted(np.exp, np.exp),
    np.sin: _lifted(np.sin, np.cos),
    np.cos: _lifted(np.cos, lambda a: -np.sin(a)),
    np.tan: _lifted(np.tan, lambda a: 1.0 / np.cos(a) ** 2),
    np.sinh: _lifted(np.sinh, np.cosh),
    np.cosh: _lifted(np.cosh, np.sinh),
    np.tanh: _lifted(np.tanh, lambda a: 1.0 - np.tanh(a) ** 2),
    np.arcsin: _lifted(np.arcsin, lambda a: 1.0 / np.sqrt((1.0 - a) * (1.0 + a))),
    np.arccos: _lifted(np.arccos, lambda a: -1.0 / np.sqrt((1.0 - a) * (1.0 + a))),
    np.arctan: _lifted(np.arctan, lambda a: 1.0 / (1.0 + a * a)),
}


# -- vectors --------------------------------------------------------------------------------------


def inner(a: Any, b: Any, axis: int = -1) -> Any:
    """Return the dual inner product ⟨a, b⟩ + ε(⟨a, b̄⟩ + ⟨ā, b⟩).

    Parameters
    ----------
    a, b
        vectors: `Dual`, array or `Series`, with 3 entries along ``axis``.
    axis
        the axis of the entries; for a Series, of its values.
    """
    if not (isinstance(a, Dual) or isinstance(b, Dual)):
        return _real_inner(a, b, axis)
    (a, a_), (b, b_) = _vector_parts(a), _vector_parts(b)
    mixed = _sum([_real_inner(p, q, axis) for p, q in ((a, b_), (a_, b)) if _present(p, q)])
    return Dual(_real_inner(a, b, axis), mixed)


def cross(a: Any, b: Any, axis: int = -1) -> Any:
    """Return the dual cross product a × b + ε(a × b̄ + ā × b); arguments as in `inner`."""
    if not (isinstance(a, Dual) or isinstance(b, Dual)):
        return _real_cross(a, b, axis)
    (a, a_), (b, b_) = _vector_parts(a), _vector_parts(b)
    mixed = _sum([_real_cross(p, q, axis) for p, q in ((a, b_), (a_, b)) if _present(p, q)])
    return Dual(_real_cross(a, b, axis), mixed)


def norm(a: Any, axis: int = -1) -> Any:
    """Return ‖a‖ = √⟨a, a⟩, a dual number whose dual part is ⟨a, ā⟩/‖a‖.

    Where the real part of ``a`` is the zero vector the dual part is NaN: such a vector is a pure
    dual and has no norm with a direction.
    """
    return np.sqrt(inner(a, a, axis))


def normalize(a: Any, axis: int = -1) -> Any:
    """Return the dual unit vector a/‖a‖: an oriented line (Study).

    Raises
    ------
    GeometryError
        where the real part of ``a`` is the zero vector.
    """
    length = norm(a, axis)
    real = length.real if isinstance(length, Dual) else length
    value = real.value if isinstance(real, Series) else real
    if np.any(np.equal(value, 0)):
        raise GeometryError(
            "`a` must have a real part other than the zero vector; got a pure dual vector, which "
            "has no direction; leave these places out"
        )
    return a / _expanded(length, axis)


def _vector_parts(value: Any) -> tuple[Any, Any]:
    return _broadcast_parts(value) if isinstance(value, Dual) else (value, None)


def _present(p: Any, q: Any) -> bool:
    return p is not None and q is not None


def _sum(terms: list[Any]) -> Any:
    return terms[0] if len(terms) == 1 else terms[0] + terms[1]


def _real_inner(a: Any, b: Any, axis: int) -> Any:
    products = a * b
    if isinstance(products, Series):
        axis = axis if axis < 0 else axis + 1
        return Series(products.coefficients.sum(axis=axis))
    return products.sum(axis=axis)


def _real_cross(a: Any, b: Any, axis: int) -> Any:
    if not (isinstance(a, Series) or isinstance(b, Series)):
        return np.cross(a, b, axis=axis)
    (ax, ay, az), (bx, by, bz) = _entries(a, axis), _entries(b, axis)
    rows = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
    axis = axis if axis < 0 else axis + 1
    return Series(np.stack([row.coefficients for row in rows], axis=axis))


def _entries(a: Any, axis: int) -> tuple[Any, Any, Any]:
    if isinstance(a, Series):
        axis = axis if axis < 0 else axis + 1
        x, y, z = (Series(np.take(a.coefficients, i, axis=axis)) for i in range(3))
        return x, y, z
    x, y, z = (np.take(a, i, axis=axis) for i in range(3))
    return x, y, z


def _expanded(a: Any, axis: int) -> Any:
    """Insert an axis of length 1 so that a scalar broadcasts against a vector."""
    if isinstance(a, Dual):
        return Dual(_expanded(a.real, axis), _expanded(a.dual, axis))
    if isinstance(a, Series):
        return Series(np.expand_dims(a.coefficients, axis if axis < 0 else axis + 1))
    return np.expand_dims(a, axis)
