"""The invariants over t: axes typeset by matplotlib, curves drawn over them in the browser.

What changes rarely (axes, grid, ticks, labels) is one small SVG per quantity, made by matplotlib
and sent only when limits, width, theme or the choice of quantities change. What changes at every
move (the curves, the cursor) is sent as pixel positions that matplotlib's own transforms computed;
the browser only joins them. A move of a slider is then a few kilobytes and no redrawn figure.

Nothing here uses ``pyplot`` or changes ``rcParams``: views are drawn from any thread, beside
whatever else the reader plots in the same kernel.
"""

from __future__ import annotations

import io
import math
import re
import textwrap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from threading import RLock
from typing import Any

import anywidget
import numpy as np
import traitlets
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import ScaledTranslation, Transform, blended_transform_factory

from ..geometry.checks import Array
from .axes import (
    CONSTANT,
    HUGE,
    ZERO,
    Limits,
    Ticks,
    angle_ticks,
    brief,
    minus,
    number_ticks,
    parameter_ticks,
    peaks,
    roomy_limits,
    scientific,
    sticky_limits,
    undefined_ranges,
)
from .palette import LIGHT, Theme
from .scene import Mark, Scene

__all__ = ["QUANTITIES", "CurvePlots", "Quantity"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """How one invariant is named: symbol (mathtext), unit, spoken word.

    A rate is measured for each unit of the parameter; an angle has its ticks at multiples of π/2.
    """

    name: str
    symbol: str
    unit: str
    word: str
    rate: bool = False
    angle: bool = False

    @property
    def barred(self) -> bool:
        """Whether it is a dual part, drawn dashed."""
        return self.name.endswith("_bar")

    def unit_over(self, letter: str) -> str:
        """Return the unit where the parameter has this letter."""
        return f"{self.unit} / {letter}" if self.rate else self.unit


QUANTITIES: Mapping[str, Quantity] = {
    quantity.name: quantity
    for quantity in (
        Quantity("kappa", r"$\kappa$", "rad", "kappa", rate=True),
        Quantity("kappa_bar", r"$\bar\kappa$", "length", "kappa bar", rate=True),
        Quantity("tau", r"$\tau$", "rad", "tau", rate=True),
        Quantity("tau_bar", r"$\bar\tau$", "length", "tau bar", rate=True),
        Quantity("sigma", r"$\sigma$", "rad", "sigma", angle=True),
        Quantity("delta", r"$\delta$", "length", "delta"),
    )
}
DEFAULT_NAMES = ("kappa", "tau", "sigma")

# -------------------------------------------------------------- one axis, typeset by matplotlib

# All lengths are CSS pixels: figures have 72 dots per inch, so that a point is a pixel.
_FONT: dict[str, Any] = {"family": "DejaVu Sans", "usetex": False, "parse_math": False}
_MATH: dict[str, Any] = {"parse_math": True, "math_fontfamily": "dejavusans"}
_LEFT, _RIGHT, _TOP, _FRAME, _BOTTOM, _AXIS = 86, 14, 9, 92, 9, 34
_VALUE = (76, 22)  # room of the value at the cursor, in a right corner of the frame
_MIN_WIDTH, _MAX_WIDTH = 280, 1200


@dataclass(frozen=True, slots=True)
class _Strip:
    """All that one typeset axis depends on."""

    quantity: Quantity
    limits: Limits
    across: Limits
    over: str
    width: int
    theme: Theme
    last: bool

    @property
    def height(self) -> int:
        return _TOP + _FRAME + _BOTTOM + (_AXIS if self.last else 0)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """The frame in parts of the strip: left, bottom, width, height."""
        bottom = self.height - _TOP - _FRAME
        width = self.width - _LEFT - _RIGHT
        return (
            _LEFT / self.width,
            bottom / self.height,
            width / self.width,
            _FRAME / self.height,
        )

    @property
    def colour(self) -> str:
        return self.theme.quantity(self.quantity.name)


@dataclass(frozen=True, eq=False, slots=True)
class _Painted:
    """A typeset axis, and where data lie on it (pixels from the strip's lower left corner)."""

    svg: str
    transform: Transform


def _furnish(axes: Axes, strip: _Strip) -> None:
    """Put grid, tick labels, symbol and unit on empty axes that already have their place."""
    axes.set_axis_off()
    axes.set_xlim(strip.across.low, strip.across.high)
    axes.set_ylim(strip.limits.low, strip.limits.high)
    most = max(2, (strip.width - _LEFT - _RIGHT) // 72)
    columns = parameter_ticks(strip.across, most)
    rows = (angle_ticks if strip.quantity.angle else number_ticks)(strip.limits, 5)
    _rule(axes, [x for x, _ in columns], [y for y, _ in rows], strip.theme)
    _write_rows(axes, rows, strip)
    if strip.last:
        _write_columns(axes, columns, strip)


def _rule(axes: Axes, columns: list[float], rows: list[float], theme: Theme) -> None:
    """Draw the grid, a stronger zero line, and the two lines at left and below."""
    down, along = axes.get_xaxis_transform(), axes.get_yaxis_transform()
    grid: dict[str, Any] = {"colors": theme.grid, "linewidths": 0.8, "clip_on": False}
    ink: dict[str, Any] = {"colors": theme.faint, "linewidths": 0.9, "clip_on": False}
    zero = axes.get_ylim()[0] <= 0 <= axes.get_ylim()[1]
    for lines, transform, style in (
        ([((x, 0), (x, 1)) for x in columns], down, grid),
        ([((0, y), (1, y)) for y in rows], along, grid),
        ([((0, 0), (1, 0))] if zero else [], along, ink),
        ([((0, 1), (0, 0)), ((0, 0), (1, 0))], axes.transAxes, ink),
    ):
        # autolim=False: the limits are given
        axes.add_collection(LineCollection(lines, transform=transform, **style), autolim=False)


def _write(axes: Axes, x: float, y: float, text: str, transform: Transform, **style: Any) -> Text:
    """Write a text in the one font used; only ``$…$`` known here is typeset as mathematics."""
    return axes.text(x, y, text, transform=transform, **{**_FONT, **style})


def _write_rows(axes: Axes, rows: Ticks, strip: _Strip) -> None:
    """Write the tick labels, the symbol and the unit at the left."""
    inches = _figure_of(axes).dpi_scale_trans  # from the left edge of the figure
    beside = blended_transform_factory(inches, axes.transData)
    middle = blended_transform_factory(inches, axes.transAxes)
    tick = {"ha": "right", "va": "center_baseline", "fontsize": 11.5, "color": strip.theme.faint}
    for y, text in rows:
        _write(axes, (_LEFT - 7) / 72, y, text, beside, **tick)
    label = {"ha": "center", "va": "center", "color": strip.colour}
    quantity = strip.quantity
    _write(axes, 15 / 72, 0.8, quantity.symbol, middle, fontsize=19, **_MATH, **label)
    unit = quantity.unit_over(strip.over)
    _write(axes, 15 / 72, 0.3, unit, middle, fontsize=11, rotation=90, **label)


def _write_columns(axes: Axes, columns: Ticks, strip: _Strip) -> None:
    """Write the tick labels of the parameter and its letter below the axes."""
    theme = strip.theme
    inches = _figure_of(axes).dpi_scale_trans
    below = axes.get_xaxis_transform() + ScaledTranslation(0, -6 / 72, inches)
    for x, text in columns:
        _write(axes, x, 0, text, below, ha="center", va="top", fontsize=11.5, color=theme.faint)
    lower = axes.transAxes + ScaledTranslation(0, -22 / 72, inches)
    letter = f"${strip.over}$"
    _write(axes, 1, 0, letter, lower, ha="right", va="top", fontsize=14, color=theme.ink, **_MATH)


def _figure_of(axes: Axes) -> Figure:
    figure = axes.get_figure(root=True)
    assert isinstance(figure, Figure)
    return figure


class _Painter:
    """One figure with one axes, used again for every strip; the last strips are kept.

    A value that goes to and fro changes the limits to and fro.
    """

    KEPT = 64

    def __init__(self) -> None:
        self._figure = Figure(dpi=72)
        self._figure.patch.set_visible(False)
        self._canvas: Any = FigureCanvasSVG(self._figure)
        self._axes = self._figure.add_axes((0, 0, 1, 1))
        self._done: dict[_Strip, _Painted] = {}

    def paint(self, strip: _Strip) -> _Painted:
        self._done[strip] = self._done.pop(strip, None) or self._painted(strip)
        if len(self._done) > self.KEPT:
            del self._done[next(iter(self._done))]
        return self._done[strip]

    def _painted(self, strip: _Strip) -> _Painted:
        for artist in (*self._axes.texts, *self._axes.collections):
            artist.remove()
        self._figure.set_size_inches(strip.width / 72, strip.height / 72)
        self._axes.set_position(strip.box)
        _furnish(self._axes, strip)
        file = io.StringIO()
        self._canvas.print_svg(file, metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
        transform: Any = self._axes.transData.frozen()
        return _Painted(_trimmed(file.getvalue()), transform)

    def close(self) -> None:
        self._figure.clear()
        self._done.clear()


def _trimmed(svg: str) -> str:
    """Return the bare element, in pixels, without the line breaks and comments."""
    svg = re.sub(r"<!--.*?-->", "", svg[svg.index("<svg") :], flags=re.DOTALL)
    svg = re.sub(r'(width|height)="([\d.]+)pt"', r'\1="\2"', svg, count=2)
    return re.sub(r">\s+<", "><", re.sub(r"\s*\n\s*", " ", svg)).strip()


# ------------------------------------------------------- what is drawn over it, in pixels, and said


def _readout(value: float, limits: Limits, quantity: Quantity) -> str:
    """Return the value at the cursor; the axis gives the number of decimals, so it stands still."""
    if not math.isfinite(value):
        return "undefined"
    unit = math.pi if quantity.angle else 1.0
    decimals = min(max(3 - math.floor(math.log10(limits.span / unit)), 0), 6)
    text = f"{value / unit:.{decimals}f}"
    if float(text) == 0:
        text = text.removeprefix("-")
    text = scientific(value / unit, 4) if len(text) > 8 else minus(text)
    return text + ("π" if quantity.angle else "")


def _peak_text(found: list[tuple[float, float]], over: str) -> str:
    (t, value), *others = found
    more = f" (+{len(others)} more)" if others else ""
    return f"peak {brief(value)} at {over} = {brief(t)}{more}"


def _in_words(t: Array, values: Array, quantity: Quantity, over: str) -> str:
    """Return a sentence on a curve: smallest and largest value, where, and where there is none."""
    finite = np.abs(values) < HUGE
    if not finite.any():
        return f"{quantity.word}: undefined for every {over}."
    low = int(np.argmin(np.where(finite, values, np.inf)))
    high = int(np.argmax(np.where(finite, values, -np.inf)))
    size = max(abs(float(values[low])), abs(float(values[high])))
    if values[high] - values[low] <= max(CONSTANT * size, ZERO):
        said = f"{quantity.word} is constant, {brief(float(values[low]) if size > ZERO else 0.0)}"
    else:
        ends = (
            f"{brief(float(values[k]), 4)} at {over} = {brief(float(t[k]))}" for k in (low, high)
        )
        said = f"{quantity.word} from " + " to ".join(ends)
    gaps = (f"{brief(a)} to {brief(b)}" for a, b in undefined_ranges(t, values)[:3])
    return said + "".join(f"; undefined for {over} from {gap}" for gap in gaps) + "."


# -------------------------------------------------------------------------------- the widget

_STATIC = Path(__file__).parent / "static"


class _PlotsWidget(anywidget.AnyWidget):
    """The browser's half; `CurvePlots` is the face to use."""

    _esm = _STATIC / "plots.js"
    _css = _STATIC / "plots.css"

    strips = traitlets.List(traitlets.Unicode()).tag(sync=True)
    frame = traitlets.Dict().tag(sync=True)
    across = traitlets.Bytes().tag(sync=True)  # (T,) float32, pixels
    curves = traitlets.Bytes().tag(sync=True)  # (K, T) float32, pixels from above
    notes: traitlets.List[Any] = traitlets.List().tag(sync=True)
    reasons = traitlets.Unicode().tag(sync=True)
    summary = traitlets.Unicode().tag(sync=True)
    cursor = traitlets.Dict().tag(sync=True)
    # From the browser. No echo: the browser is the only one that sets them.
    width = traitlets.Int(640).tag(sync=True, echo_update=False)
    picked: traitlets.List[Any] = traitlets.List().tag(sync=True, echo_update=False)


class CurvePlots:
    """Invariants over t, stacked over one shared t axis, with a cursor one can drag.

    Parameters
    ----------
    names
        which invariants, from above to below; any of `QUANTITIES`.
    theme
        the colours.

    Attributes
    ----------
    widget
        the Jupyter widget to display.

    Notes
    -----
    All methods may be called from any thread. Callbacks of `on_pick` run in the thread that
    received the browser's message, with no lock held.
    """

    def __init__(self, names: Iterable[str] = DEFAULT_NAMES, theme: Theme = LIGHT) -> None:
        self.widget = _PlotsWidget(layout={"width": "100%", "min_width": f"{_MIN_WIDTH}px"})
        self._lock = RLock()
        self._painter = _Painter()
        self._painted: dict[_Strip, _Painted] = {}
        self._limits: dict[str, Limits] = {}
        self._below: set[str] = set()  # whose value at the cursor stands in the lower corner
        self._callbacks: list[Callable[[float], object]] = []
        self._names = _checked(names)
        self._theme = theme
        self._over = "t"
        self._t = np.array([0.0, 1.0])
        self._across = Limits(0.0, 1.0)
        self._curves: Mapping[str, Array] = {}
        self._gaps: tuple[str, ...] = ()
        self._mark: Mark | None = None
        self.widget.observe(self._resized, "width")
        self.widget.observe(self._picked, "picked")

    # -- what a lab calls

    @property
    def names(self) -> tuple[str, ...]:
        """The invariants on show, from above to below."""
        return self._names

    def draw(self, scene: Scene, mark: Mark | None = None, *, over: str = "t") -> None:
        """Show a scene's curves; with a mark, move the cursor in the same message.

        Parameters
        ----------
        scene
            what to show.
        mark
            the cursor, measured as the scene is; None to leave it where it is.
        over
            the letter of the parameter that ``scene.t`` and ``mark.t`` hold.
        """
        with self._lock:
            self._over = over
            self._across = self._limits_across(np.asarray(scene.t, dtype=float))
            self._t = np.asarray(scene.t, dtype=float)
            self._curves, self._gaps = scene.curves, tuple(scene.gaps)
            self._mark = mark or self._mark
            self._show()

    def draw_cursor(self, mark: Mark) -> None:
        """Move the cursor and print the values there."""
        with self._lock:
            self._mark = mark
            if self._painted:
                self.widget.cursor = self._cursor()

    def choose(self, names: Iterable[str]) -> None:
        """Show these invariants, in this order.

        Raises
        ------
        ValueError
            for an unknown or repeated name, or none at all.
        """
        checked = _checked(names)
        with self._lock:
            self._names = checked
            self._show()

    def set_theme(self, theme: Theme) -> None:
        """Change all colours."""
        with self._lock:
            self._theme = theme
            self._show()

    def on_pick(self, callback: Callable[[float], object]) -> Callable[[], None]:
        """Call ``callback(t)`` when the reader picks a t; return the function that ends it."""
        self._callbacks.append(callback)

        def disconnect() -> None:
            if callback in self._callbacks:
                self._callbacks.remove(callback)

        return disconnect

    def export(self, format: str = "png", *, width: int = 720) -> bytes:
        """Return the plots as a complete figure on white, ``"png"`` (double size) or ``"svg"``.

        Raises
        ------
        ValueError
            for another format.
        """
        if format not in ("png", "svg"):
            raise ValueError(f"`format` must be 'png' or 'svg'; got {format!r}")
        with self._lock:
            t, curves, gaps = self._t, dict(self._curves), self._gaps
            strips = self._strips(LIGHT, width)
        figure = _complete_figure(strips, t, curves, gaps)
        file = io.BytesIO()
        canvas = FigureCanvasAgg(figure) if format == "png" else FigureCanvasSVG(figure)
        canvas.print_figure(
            file, format=format, dpi=144 if format == "png" else 72, facecolor=LIGHT.paper
        )
        return file.getvalue()

    def close(self) -> None:
        """Close the widget and let go of everything."""
        with self._lock:
            self._callbacks.clear()
            self.widget.unobserve_all()
            self.widget.close()
            self._painted.clear()
            self._painter.close()

    # -- what the browser sends

    def _resized(self, _change: object) -> None:
        with self._lock:
            self._show()

    def _picked(self, change: Mapping[str, Any]) -> None:
        match change["new"]:
            case [_, int() | float() as t] if math.isfinite(t):
                across = self._across
                for callback in tuple(self._callbacks):
                    callback(min(max(float(t), across.low), across.high))

    # -- how it is drawn

    def _limits_across(self, t: Array) -> Limits:
        """Return the ends of the parameter; of a length, which any move changes, a rounder end."""
        low, high = (float(t[0]), float(t[-1])) if t.size else (0.0, 1.0)
        if self._over != "t" and low == 0.0 < high:
            return roomy_limits(high, self._across)
        return Limits(low, high if high > low else low + 1.0)

    def _values(self, name: str) -> Array:
        return _values(self._curves, name, self._t)

    def _strips(self, theme: Theme, width: int) -> tuple[_Strip, ...]:
        """Return what the axes depend on now; the limits stay where they can."""
        for name in self._names:
            self._limits[name] = sticky_limits(
                self._values(name), self._limits.get(name), angle=QUANTITIES[name].angle
            )
        return tuple(
            _Strip(
                QUANTITIES[name],
                self._limits[name],
                self._across,
                self._over,
                width,
                theme,
                last=name == self._names[-1],
            )
            for name in self._names
        )

    def _show(self) -> None:
        """Bring the browser up to date in one message; what has not changed is not sent."""
        width = min(max(self.widget.width, _MIN_WIDTH), _MAX_WIDTH)
        strips = self._strips(self._theme, width)
        self._painted = {strip: self._painter.paint(strip) for strip in strips}
        placed = [self._place(strip, self._t, self._values(strip.quantity.name))
                  for strip in strips]  # fmt: skip
        for strip, (x, y) in zip(strips, placed, strict=True):
            self._set_aside(strip, x, y)
        with self.widget.hold_sync():
            self.widget.strips = [painted.svg for painted in self._painted.values()]
            self.widget.frame = self._frame()
            self.widget.across = placed[0][0].astype(np.float32).tobytes()
            self.widget.curves = np.array([y for _, y in placed], dtype=np.float32).tobytes()
            self.widget.notes = [self._note(strip) for strip in strips]
            self.widget.reasons = "\n".join(self._gaps)
            self.widget.summary = self._in_words()
            self.widget.cursor = self._cursor()

    def _place(self, strip: _Strip, t: Array, values: Array) -> tuple[Array, Array]:
        """Return pixels from the left and from above; far beyond the frame, just outside it."""
        low, high, reach = strip.limits.low, strip.limits.high, 4 * strip.limits.span
        transform = self._painted[strip].transform
        # A NaN would spoil its t as well (0 · NaN), so the two are transformed apart.
        x = transform.transform(np.column_stack((t, np.full(t.shape, low))))[:, 0]
        kept = np.clip(values, low - reach, high + reach)
        y = transform.transform(np.column_stack((np.zeros(t.shape), kept)))[:, 1]
        return x, self._above(strip) + strip.height - y

    def _set_aside(self, strip: _Strip, x: Array, y: Array) -> None:
        """Move the value at the cursor to the other right corner if only there it is free."""
        name = strip.quantity.name
        end = y[x > strip.width - _RIGHT - _VALUE[0]] - self._above(strip) - _TOP
        blocked = {False: bool(np.any(end < _VALUE[1])),
                   True: bool(np.any(end > _FRAME - _VALUE[1]))}  # fmt: skip
        below = name in self._below
        if blocked[below] and not blocked[not below]:
            (self._below.discard if below else self._below.add)(name)

    def _above(self, strip: _Strip) -> int:
        """Return the height of the strips above this one."""
        return (_TOP + _FRAME + _BOTTOM) * self._names.index(strip.quantity.name)

    def _frame(self) -> dict[str, Any]:
        strips, across, theme = tuple(self._painted), self._across, self._theme
        return {
            "width": strips[0].width,
            "height": sum(strip.height for strip in strips),
            "left": _LEFT,
            "right": strips[0].width - _RIGHT,
            "t": [across.low, across.high],
            "axes": [
                {
                    "top": self._above(strip) + _TOP,
                    "bottom": self._above(strip) + _TOP + _FRAME,
                    "colour": strip.colour,
                    "dashed": strip.quantity.barred,
                }
                for strip in strips
            ],
            "colours": {
                name: getattr(theme, name) for name in ("ink", "faint", "grid", "paper", "cursor")
            },
        }

    def _note(self, strip: _Strip) -> dict[str, Any]:
        """Return what is to be marked on one axis: ranges without value, peaks that leave it."""
        values = self._values(strip.quantity.name)
        note: dict[str, Any] = {"below": strip.quantity.name in self._below}
        if gaps := undefined_ranges(self._t, values):
            ends = np.array(gaps).ravel()
            x, _ = self._place(strip, ends, np.full(ends.size, strip.limits.low))
            note["gaps"] = np.round(x, 1).tolist()
        if not (np.abs(values) < HUGE).any():
            known = self._t.size and self._curves
            note["empty"] = f"undefined for every {self._over}" if known else "no curve"
        elif found := peaks(self._t, values, strip.limits):
            x, _ = self._place(strip, *np.array(found[:6]).T)
            note["peaks"] = [
                [round(float(at), 1), value > strip.limits.high]
                for at, (_, value) in zip(x, found, strict=False)
            ]
            note["texts"] = [
                _peak_text(found, self._over),
                brief(found[0][1]),
            ]  # where there is little room
        return note

    def _in_words(self) -> str:
        over, (first, *_, last) = self._over, self._t if self._t.size > 1 else (0.0, 1.0)
        curves = (_in_words(self._t, self._values(n), QUANTITIES[n], over) for n in self._names)
        start = f"Plots over {over} from {brief(first)} to {brief(last)}:"
        return " ".join((start, *curves, *self._gaps))

    def _cursor(self) -> dict[str, Any]:
        mark = self._mark
        if mark is None or not math.isfinite(mark.t):
            return {}
        places, texts, spoken = [], [], [f"{self._over} = {brief(mark.t)}"]
        for strip in self._painted:
            value = float(mark.values.get(strip.quantity.name, math.nan))
            x, y = self._place(strip, np.array([mark.t]), np.array([value]))
            places.append(round(float(y[0]), 2) if math.isfinite(value) else None)
            texts.append(_readout(value, strip.limits, strip.quantity))
            said = brief(value, 4) if math.isfinite(value) else "undefined"
            spoken.append(f"{strip.quantity.word} {said}")
        return {
            "t": float(mark.t),
            "x": round(float(x[0]), 2),
            "y": places,
            "values": texts,
            "label": f"{self._over} = {self._t_text(mark.t)}",
            "spoken": ", ".join(spoken),
        }

    def _t_text(self, t: float) -> str:
        decimals = max(0, 3 - math.floor(math.log10(self._across.span)))
        return minus(f"{t:.{min(decimals, 9)}f}")


def _values(curves: Mapping[str, Array], name: str, t: Array) -> Array:
    """Return a curve as floats; NaN where the scene has none of that name."""
    found = curves.get(name)
    return np.full(t.shape, np.nan) if found is None else np.asarray(found, dtype=float)


def _checked(names: Iterable[str]) -> tuple[str, ...]:
    chosen = tuple(names)
    if not chosen or len(set(chosen)) < len(chosen) or not set(chosen) <= set(QUANTITIES):
        known = ", ".join(QUANTITIES)
        raise ValueError(f"`names` must be one or more of {known}, each once; got {chosen!r}")
    return chosen


# ------------------------------------------------------------------------------ the figure to keep


def _complete_figure(
    strips: tuple[_Strip, ...], t: Array, curves: Mapping[str, Array], gaps: tuple[str, ...]
) -> Figure:
    """Return the same axes with the curves drawn by matplotlib, reasons below."""
    width = strips[0].width
    lines = [line for gap in gaps for line in textwrap.wrap(gap, (width - _LEFT) // 6)]
    foot = 16 * len(lines) + (8 if lines else 0)
    height = sum(strip.height for strip in strips) + foot
    figure = Figure(figsize=(width / 72, height / 72), dpi=72)
    above = height
    for strip in strips:
        above -= strip.height
        left, bottom, across, up = strip.box
        axes = figure.add_axes(
            (left, (above + bottom * strip.height) / height, across, up * strip.height / height)
        )
        _furnish(axes, strip)
        _draw_curve(axes, strip, t, _values(curves, strip.quantity.name, t))
    figure.text(_LEFT / width, foot / height, "\n".join(lines), va="top", fontsize=11,
                color=LIGHT.faint, **_FONT)  # fmt: skip
    return figure


def _draw_curve(axes: Axes, strip: _Strip, t: Array, values: Array) -> None:
    """Draw one curve with its ranges without value and its peaks; the limits stay."""
    drawn = np.where(np.abs(values) < HUGE, values, np.nan)
    style = (0, (4, 2.5)) if strip.quantity.barred else "solid"
    axes.set_autoscale_on(False)
    axes.plot(t, drawn, color=strip.colour, linewidth=2, linestyle=style)
    for low, high in undefined_ranges(t, values):
        axes.axvspan(low, high, color=strip.theme.faint, alpha=0.18)
    if not np.isfinite(drawn).any():
        _write(axes, 0.5, 0.5, f"undefined for every {strip.over}", axes.transAxes, ha="center",
               va="center", color=strip.theme.ink, backgroundcolor=strip.theme.paper)  # fmt: skip
    elif found := peaks(t, drawn, strip.limits):
        _draw_peaks(axes, strip, found)


def _draw_peaks(axes: Axes, strip: _Strip, found: list[tuple[float, float]]) -> None:
    """Draw an arrow at each place where the curve leaves the frame, and write how far it goes."""
    down = axes.get_xaxis_transform()
    for at, value in found:
        marker, end = ("^", 1.0) if value > strip.limits.high else ("v", 0.0)
        axes.plot(at, end, marker=marker, markersize=6, color=strip.colour, transform=down,
                  clip_on=False)  # fmt: skip
    at, value = found[0]
    up, right = value > strip.limits.high, at > (strip.across.low + strip.across.high) / 2
    inches = _figure_of(axes).dpi_scale_trans
    aside = ScaledTranslation((-8 if right else 8) / 72, (-3 if up else 3) / 72, inches)
    _write(axes, at, 1.0 if up else 0.0, _peak_text(found, strip.over), down + aside, fontsize=11,
           ha="right" if right else "left", va="top" if up else "bottom",
           color=strip.colour)  # fmt: skip
