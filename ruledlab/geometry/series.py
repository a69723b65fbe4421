"""Truncated Taylor series in t over arrays: derivatives without formulas.

A `Series` of order N holds the coefficients of f(t + h) = Σ c_k hᵏ, k = 0 … N, for a whole array
of places t at once. Arithmetic and numpy's functions act on all coefficients together, so the
derivatives f⁽ᵏ⁾(t) = k! c_k of anything that is computed come out to rounding accuracy.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from .checks import Array, GeometryError, finite_array

__all__ = ["Series"]


def plain(value: Any) -> Any:
    """Return a number as Python's own, to be shown; arrays and series stay what they are."""
    scalar = isinstance(value, np.generic | np.ndarray) and value.ndim == 0
    return value.item() if scalar else value


class Series:
    """A truncated Taylor series f(t + h) = c₀ + c₁h + … + c_N hᴺ over arrays.

    Parameters
    ----------
    coefficients
        array of shape (N+1, *shape); row k is f⁽ᵏ⁾(t)/k!. It is not copied.

    Notes
    -----
    ``+ - * / **`` and the ufuncs sqrt, exp, log, sin, cos, tan, arcsin, arccos, arctan, arctan2,
    sinh, cosh, tanh, absolute, sign, square and power accept Series, arrays and numbers in any
    mixture. Two series of different order give one of the lower order. Outside the real domain of
    a function the coefficients are NaN; nothing is raised or warned about.
    """

    __slots__ = ("coefficients",)

    def __init__(self, coefficients: npt.ArrayLike) -> None:
        array = np.asarray(coefficients)
        if array.dtype.kind != "f":
            array = finite_array(array, "coefficients")
        if array.ndim == 0 or len(array) == 0:
            raise GeometryError(
                "`coefficients` must have a first axis for the order, of length 1 or more; "
                f"got shape {array.shape}; write Series([value])"
            )
        self.coefficients: Array = array

    @classmethod
    def variable(cls, t: npt.ArrayLike, order: int) -> Series:
        """Return the identity t ↦ t, expanded at each given place: (t, 1, 0, …)."""
        places = np.asarray(t, dtype=np.float64)
        coefficients = np.zeros((order + 1, *places.shape))
        coefficients[0] = places
        if order > 0:
            coefficients[1] = 1.0
        return cls(coefficients)

    @property
    def order(self) -> int:
        """The highest power of h that is kept."""
        return len(self.coefficients) - 1

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the values, without the axis of the order."""
        return self.coefficients.shape[1:]

    @property
    def value(self) -> Array:
        """f(t): the coefficient of h⁰."""
        result: Array = self.coefficients[0]
        return result

    def derivative(self, k: int = 1) -> Series:
        """Return the series of f⁽ᵏ⁾; its order is lower by k."""
        if not 0 <= k <= self.order:
            raise GeometryError(
                f"`k` must lie between 0 and the order {self.order}; got {k}; "
                "start from a series of higher order"
            )
        if k == 0:
            return self
        factors = [math.perm(j, k) for j in range(k, self.order + 1)]
        return Series(self.coefficients[k:] * _column(factors, self.coefficients.ndim))

    def derivatives(self) -> Array:
        """Return the array of f, f′, f″, …, f⁽ᴺ⁾ along the first axis."""
        factors = [math.factorial(k) for k in range(self.order + 1)]
        result: Array = self.coefficients * _column(factors, self.coefficients.ndim)
        return result

    def truncated(self, order: int) -> Series:
        """Return the same series cut after hᵒʳᵈᵉʳ."""
        return Series(self.coefficients[: order + 1])

    def __getitem__(self, key: Any) -> Series:
        """Index the values, not the order: ``s[i]`` is the series of the i-th value."""
        key = key if isinstance(key, tuple) else (key,)
        return Series(self.coefficients[(slice(None), *key)])

    def __repr__(self) -> str:
        return f"Series(order={self.order}, shape={self.shape}, value={plain(self.value)!r})"

    # -- arithmetic ------------------------------------------------------------------------------

    def __neg__(self) -> Series:
        return Series(-self.coefficients)

    def __pos__(self) -> Series:
        return self

    def __add__(self, other: Any) -> Series:
        return _dispatch(_add, self, other)

    def __radd__(self, other: Any) -> Series:
        return _dispatch(_add, other, self)

    def __sub__(self, other: Any) -> Series:
        return _dispatch(_subtract, self, other)

    def __rsub__(self, other: Any) -> Series:
        return _dispatch(_subtract, other, self)

    def __mul__(self, other: Any) -> Series:
        return _dispatch(_multiply, self, other)

    def __rmul__(self, other: Any) -> Series:
        return _dispatch(_multiply, other, self)

    def __truediv__(self, other: Any) -> Series:
        return _dispatch(_divide, self, other)

    def __rtruediv__(self, other: Any) -> Series:
        return _dispatch(_divide, other, self)

    def __pow__(self, other: Any) -> Series:
        return _dispatch(_power, self, other)

    def __rpow__(self, other: Any) -> Series:
        return _dispatch(_power, other, self)

    def __abs__(self) -> Series:
        result: Series = np.absolute(self)
        return result

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        function = _UFUNCS.get(ufunc)
        if function is None or method != "__call__" or options:
            return NotImplemented
        if not all(_is_plain(value) for value in inputs):
            return NotImplemented
        with np.errstate(all="ignore"):
            return function(*inputs)


def _column(values: Iterable[float], ndim: int) -> Array:
    return np.array(list(values), dtype=np.float64).reshape(-1, *(1,) * (ndim - 1))


def _is_plain(value: Any) -> bool:
    if isinstance(value, (Series, float, int)):
        return True
    if isinstance(value, (np.ndarray, np.generic)):
        return value.dtype.kind in "fiub"
    return isinstance(value, (list, tuple))


def _dispatch(function: Callable[[Any, Any], Series], a: Any, b: Any) -> Series:
    with np.errstate(all="ignore"):
        return function(a, b) if _is_plain(a) and _is_plain(b) else NotImplemented


def _aligned(a: Series, b: Series) -> tuple[Array, Array]:
    """Cut to the common order and give both values the same number of axes."""
    rows = min(len(a.coefficients), len(b.coefficients))
    return _same_rank(a.coefficients[:rows], b.coefficients[:rows])


def _same_rank(a: Array, b: Array) -> tuple[Array, Array]:
    if a.ndim < b.ndim:
        a = a.reshape(a.shape[:1] + (1,) * (b.ndim - a.ndim) + a.shape[1:])
    elif b.ndim < a.ndim:
        b = b.reshape(b.shape[:1] + (1,) * (a.ndim - b.ndim) + b.shape[1:])
    return a, b


def _add(a: Any, b: Any) -> Series:
    return _linear(operator.add, a, b)


def _subtract(a: Any, b: Any) -> Series:
    return _linear(operator.sub, a, b)


def _linear(operation: Callable[[Any, Any], Any], a: Any, b: Any) -> Series:
    """Add or subtract: a plain number or array only enters the value."""
    if isinstance(a, Series) and isinstance(b, Series):
        return Series(operation(*_aligned(a, b)))
    if isinstance(a, Series):
        return Series(operation(*_aligned(a, _constant(b, a.order))))
    return Series(operation(*_aligned(_constant(a, b.order), b)))


def _constant(value: Any, order: int) -> Series:
    plain = np.asarray(value, dtype=np.float64)
    coefficients = np.zeros((order + 1, *plain.shape))
    coefficients[0] = plain
    return Series(coefficients)


def _multiply(a: Any, b: Any) -> Series:
    if isinstance(a, Series) and isinstance(b, Series):
        return Series(_product(*_aligned(a, b)))
    if not isinstance(a, Series):
        a, b = b, a
    return Series(_scaled(a.coefficients, b))


def _scaled(coefficients: Array, factor: Any) -> Array:
    plain: Array = np.asarray(factor, dtype=np.float64)
    if plain.ndim >= coefficients.ndim:
        coefficients, plain = _same_rank(coefficients, plain[np.newaxis])
    result: Array = coefficients * plain
    return result


def _product(a: Array, b: Array) -> Array:
    """Cauchy product: c_k = Σ a_j b_(k−j), one pass per row of ``a``."""
    result: Array = a[0] * b
    for j in range(1, len(a)):
        result[j:] += a[j] * b[:-j]
    return result


def _divide(a: Any, b: Any) -> Series:
    if not isinstance(b, Series):
        return Series(_scaled(a.coefficients, 1.0 / np.asarray(b, dtype=np.float64)))
    if not isinstance(a, Series):
        a = _constant(a, b.order)
    return Series(_quotient(*_aligned(a, b)))


def _quotient(a: Array, b: Array) -> Array:
    """Solve a = q b: q_k = (a_k − Σ_(j<k) q_j b_(k−j)) / b₀."""
    shape = np.broadcast_shapes(a.shape, b.shape)
    q = np.empty(shape)
    for k in range(len(q)):
        rest = a[k] - sum(q[j] * b[k - j] for j in range(k)) if k else a[0]
        q[k] = rest / b[0]
    return q


def _power(a: Any, b: Any) -> Series:
    if isinstance(b, Series):
        return _exp(_multiply(b, _log(a) if isinstance(a, Series) else _plain_log(a)))
    exponent = np.asarray(b, dtype=np.float64)
    if exponent.ndim == 0 and float(exponent).is_integer() and abs(exponent) <= 1024:
        return _integer_power(a, int(exponent))
    return _real_power(a, exponent)


def _plain_log(value: Any) -> Array:
    result: Array = np.log(np.asarray(value, dtype=np.float64))
    return result


def _integer_power(a: Series, n: int) -> Series:
    """Power by repeated squaring: it also holds where the base is zero or negative."""
    if n < 0:
        return _divide(1.0, _integer_power(a, -n))
    result = None
    while n:
        if n & 1:
            result = a if result is None else _multiply(result, a)
        n >>= 1
        if n:
            a = _multiply(a, a)
    return _constant(np.ones(a.shape), a.order) if result is None else result


def _real_power(a: Series, exponent: Array) -> Series:
    """Solve a p′ = r a′ p for p = aʳ: p_k = Σ_(j≥1) (r j − (k − j)) a_j p_(k−j) / (k a₀)."""
    c = a.coefficients
    p = np.empty(c.shape[:1] + np.broadcast_shapes(c.shape[1:], exponent.shape))
    p[0] = c[0] ** exponent
    for k in range(1, len(c)):
        total = sum((exponent * j - (k - j)) * c[j] * p[k - j] for j in range(1, k + 1))
        p[k] = total / (k * c[0])
    return Series(p)


# -- functions: each follows from the differential equation it solves -----------------------------


def _convolved(a: Array, b: Array, k: int) -> Array:
    """Coefficient k − 1 of a′b: Σ_(j≥1) j a_j b_(k−j)."""
    result: Array = a[1] * b[k - 1]
    for j in range(2, k + 1):
        result += j * a[j] * b[k - j]
    return result


def _square(a: Series) -> Series:
    return _multiply(a, a)


def _sqrt(a: Series) -> Series:
    """r² = a: r_k = (a_k − Σ_(0<j<k) r_j r_(k−j)) / (2 r₀)."""
    c = a.coefficients
    r = np.empty_like(c)
    r[0] = np.sqrt(c[0])
    half = 0.5 / r[0] if len(c) > 1 else None
    for k in range(1, len(c)):
        rest = c[k] - sum(r[j] * r[k - j] for j in range(1, k)) if k > 1 else c[k]
        r[k] = rest * half
    return Series(r)


def _exp(a: Series) -> Series:
    """E′ = a′E."""
    c = a.coefficients
    e = np.empty_like(c)
    e[0] = np.exp(c[0])
    for k in range(1, len(c)):
        e[k] = _convolved(c, e, k) / k
    return Series(e)


def _log(a: Series) -> Series:
    """L′ = a′/a, with log a₀ as its value: NaN for a₀ < 0."""
    value = np.log(a.value)
    slope = np.where(np.isnan(value), np.nan, 1.0) if a.order else None
    return _integrated(value, a, None if slope is None else _divide(slope, a))


def _sin(a: Series) -> Series:
    return _sine_cosine(a, np.sin, np.cos, -1.0)[0]


def _cos(a: Series) -> Series:
    return _sine_cosine(a, np.sin, np.cos, -1.0)[1]


def _sinh(a: Series) -> Series:
    return _sine_cosine(a, np.sinh, np.cosh, 1.0)[0]


def _cosh(a: Series) -> Series:
    return _sine_cosine(a, np.sinh, np.cosh, 1.0)[1]


def _sine_cosine(a: Series, sine: Any, cosine: Any, sign: float) -> tuple[Series, Series]:
    """S′ = a′C, C′ = ±a′S: circular for −1, hyperbolic for +1."""
    c = a.coefficients
    s, d = np.empty_like(c), np.empty_like(c)
    s[0] = sine(c[0])
    d[0] = cosine(c[0])
    for k in range(1, len(c)):
        s[k] = _convolved(c, d, k) / k
        d[k] = _convolved(c, s, k) * (sign / k)
    return Series(s), Series(d)


def sine_cosine(a: Series) -> tuple[Series, Series]:
    """Return sin a and cos a together: each needs the other."""
    with np.errstate(all="ignore"):
        return _sine_cosine(a, np.sin, np.cos, -1.0)


def _tan(a: Series) -> Series:
    return _divide(*sine_cosine(a))


def _tanh(a: Series) -> Series:
    """T′ = (1 − T²)a′: T_k needs only the coefficients of T below k."""
    c = a.coefficients
    tanh = np.empty_like(c)
    tanh[0] = np.tanh(c[0])
    for k in range(1, len(c)):
        slope = -_product(tanh[:k], tanh[:k])
        slope[0] += 1.0
        tanh[k] = _convolved(c, slope, k) / k
    return Series(tanh)


def _arctan(a: Series) -> Series:
    return _integrated(np.arctan(a.value), a, _divide(1.0, _add(_square(a), 1.0)))


def _arcsin(a: Series) -> Series:
    value = np.arcsin(a.value)
    return _integrated(value, a, _divide(1.0, _off_circle(a)))


def _arccos(a: Series) -> Series:
    value = np.arccos(a.value)
    return _integrated(value, a, _divide(-1.0, _off_circle(a)))


def _off_circle(a: Series) -> Series:
    """Return √(1 − a²) as √((1 − a)(1 + a)), which keeps its digits near a = ±1."""
    return _sqrt(_multiply(_subtract(1.0, a), _add(1.0, a)))


def _arctan2(y: Any, x: Any) -> Series:
    """Angle θ of (x, y): θ′ = (x y′ − y x′)/(x² + y²); undefined at the origin."""
    order = min(s.order for s in (y, x) if isinstance(s, Series))
    y, x = (s if isinstance(s, Series) else _constant(s, order) for s in (y, x))
    value = np.arctan2(y.value, x.value)
    if order == 0:
        return Series(value[np.newaxis])
    squared = _add(_square(x), _square(y))
    turning = _subtract(_multiply(x, y.derivative()), _multiply(y, x.derivative()))
    return _primitive(value, _divide(turning, squared))


def _integrated(value: Array, a: Series, slope: Series | None) -> Series:
    """Return F(a) from its value and F′(a) = slope: the chain rule, integrated termwise."""
    if a.order == 0 or slope is None:
        return Series(np.asarray(value)[np.newaxis])
    return _primitive(value, _multiply(slope.truncated(a.order - 1), a.derivative()))


def _primitive(value: Array, rate: Series) -> Series:
    """Return the series with the given value whose derivative is ``rate``."""
    steps = _column((1.0 / k for k in range(1, rate.order + 2)), rate.coefficients.ndim)
    return Series(np.concatenate([value[np.newaxis], rate.coefficients * steps]))


def _absolute(a: Series) -> Series:
    """Return sign(a₀) a; at a₀ = 0 only a constant has derivatives."""
    return Series(_sign_of(a) * a.coefficients)


def _sign(a: Series) -> Series:
    return Series(
        np.where(np.arange(a.order + 1).reshape(-1, *(1,) * len(a.shape)) == 0, 1.0, 0.0)
        * _sign_of(a)
    )


def _sign_of(a: Series) -> Array:
    """Sign of the value for every row; NaN in the derivatives where the sign changes."""
    sign = np.broadcast_to(np.sign(a.value), a.coefficients.shape).copy()
    corner = (a.value == 0) & (a.coefficients[1:] != 0).any(axis=0)
    sign[1:, corner] = np.nan
    return sign


_UFUNCS: dict[np.ufunc, Callable[..., Series]] = {
    np.add: _add,
    np.subtract: _subtract,
    np.multiply: _multiply,
    np.true_divide: _divide,
    np.power: _power,
    np.float_power: _power,
    np.negative: operator.neg,
    np.positive: operator.pos,
    np.square: _square,
    np.reciprocal: lambda a: _divide(1.0, a),
    np.absolute: _absolute,
    np.fabs: _absolute,
    np.sign: _sign,
    np.sqrt: _sqrt,
    np.exp: _exp,
    np.log: _log,
    np.sin: _sin,
    np.cos: _cos,
    np.tan: _tan,
    np.sinh: _sinh,
    np.cosh: _cosh,
    np.tanh: _tanh,
    np.arcsin: _arcsin,
    np.arccos: _arccos,
    np.arctan: _arctan,
    np.arctan2: _arctan2,
}
