"""The kinds of exercises, what is said to an answer, and where exercises are found. No widgets.

A lesson's exercises are data: a module ``lesson_06`` with a tuple ``EXERCISES`` of `Exercise`, each
a number, a title and a small function that makes the `Task` from a `Draw`. A task judges answers,
typed or computed, and every judgement is a `Verdict` that says what is off.
"""

from __future__ import annotations

import hashlib
import html
import importlib
import math
import pkgutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np

from ..design import Design
from ..geometry.checks import Array, GeometryError
from ..geometry.closed import Closure
from ..geometry.dual import Dual
from ..geometry.field import FormulaError, named_number
from ..geometry.surface import RuledSurface
from .answers import is_open, read_formula, read_numbers
from .shape import Trait, compare, drawn

__all__ = [
    "Choose",
    "Code",
    "Condition",
    "Drag",
    "Draw",
    "Exercise",
    "FindSlip",
    "Formula",
    "Made",
    "Misconception",
    "Number",
    "Option",
    "Sketch",
    "Task",
    "Verdict",
    "find",
    "lesson",
    "lessons",
    "made",
]

RIGHT, WRONG, UNREAD = "right", "wrong", "unread"

T = TypeVar("T")


# -- what is said ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is said to an answer.

    Attributes
    ----------
    state
        ``"right"``, ``"wrong"``, or ``"unread"``: it could not be read and does not count.
    word
        what is off, or why it is right: HTML with TeX between dollar signs.
    slip
        the name of the misconception that was recognised, else empty.
    pointer
        lines for a monospace display that point to the place of the trouble.
    """

    state: str
    word: str = ""
    slip: str = ""
    pointer: str = ""

    @property
    def right(self) -> bool:
        """Whether the answer was right."""
        return self.state == RIGHT


def _unread(error: GeometryError) -> Verdict:
    if not isinstance(error, FormulaError):
        return Verdict(UNREAD, html.escape(_sentence(str(error).replace("`", ""))))
    text = f"this cannot be read: {error.message}"
    return Verdict(UNREAD, html.escape(_sentence(text)), pointer=error.pointer(48))


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "?", "!")) else ".")


@dataclass(frozen=True, slots=True)
class Misconception:
    """A wrong answer that has a name.

    Attributes
    ----------
    name
        a few words: "λ modulo 2π".
    test
        whether an answer, already read, shows it. What it is given depends on the kind: an array
        for numbers and code, a function of the variables for formulas, a `Made` for designs.
    word
        what to say to it.
    example
        an answer that shows it, for the tests.
    """

    name: str
    test: Callable[[Any], bool]
    word: str
    example: Any


def _recognised(slips: Sequence[Misconception], answer: Any) -> Verdict | None:
    for slip in slips:
        if slip.test(answer):
            return Verdict(WRONG, slip.word, slip.name)
    return None


# -- values that vary ------------------------------------------------------------------------------


class Draw:
    """Choices that depend on a student's seed and the exercise alone, on every machine the same.

    Parameters
    ----------
    seed
        the student's seed.
    key
        the exercise.
    """

    def __init__(self, seed: str, key: str) -> None:
        self._source, self._count = f"{seed}\n{key}", 0

    def integer(self, low: int, high: int) -> int:
        """Return a whole number from low to high, both included."""
        self._count += 1
        digest = hashlib.sha256(f"{self._source}\n{self._count}".encode()).digest()
        return low + int.from_bytes(digest[:8], "big") % (high - low + 1)

    def one_of(self, values: Sequence[T]) -> T:
        """Return one of the values."""
        return values[self.integer(0, len(values) - 1)]

    def shuffled(self, count: int) -> tuple[int, ...]:
        """Return 0 … count − 1 in some order."""
        left = list(range(count))
        return tuple(left.pop(self.integer(0, len(left) - 1)) for _ in range(count))

    def between(self, low: float, high: float) -> float:
        """Return a number between low and high."""
        return low + (high - low) * self.integer(0, 10**6) / 10**6


# -- the kinds -------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, kw_only=True)
class Task:
    """What every exercise has.

    Attributes
    ----------
    question, solution
        HTML with TeX between dollar signs.
    hints
        up to three, each saying more than the one before.
    """

    kind: ClassVar[str] = ""

    question: str
    solution: str
    hints: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len(self.hints) > 3:
            raise ValueError(f"at most three hints; got {len(self.hints)}")

    def judge(self, answer: Any) -> Verdict:
        """Say whether an answer is right, and if not, what is off."""
        raise NotImplementedError

    def right_answer(self) -> Any:
        """Return an answer that is right."""
        raise NotImplementedError

    def wrong_answer(self) -> Any:
        """Return an answer that can be read and is wrong."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Option:
    """One of several answers to choose from.

    Attributes
    ----------
    text
        the answer: HTML with TeX.
    word
        what is said to who chooses it.
    right
        whether it is the right one; exactly one is.
    slip
        the name of the misconception that it shows.
    """

    text: str
    word: str
    right: bool = False
    slip: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Choose(Task):
    """Choose one of several. An answer is the option's index in the data, however it is shown.

    Attributes
    ----------
    options
        the answers.
    order
        the order in which they are shown; empty for that of the data.
    """

    kind: ClassVar[str] = "choose"

    options: tuple[Option, ...]
    order: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if sum(option.right for option in self.options) != 1:
            raise ValueError("exactly one option must be right")

    @property
    def shown(self) -> tuple[int, ...]:
        """The indices of the options in the order in which they are shown."""
        return self.order or tuple(range(len(self.options)))

    def judge(self, answer: Any) -> Verdict:
        """Judge the index of an option."""
        if not isinstance(answer, int) or isinstance(answer, bool):
            return Verdict(UNREAD, "Choose one of the answers first.")
        if not 0 <= answer < len(self.options):
            return Verdict(UNREAD, f"There are {len(self.options)} answers, counted from 0.")
        option = self.options[answer]
        return Verdict(RIGHT if option.right else WRONG, option.word, option.slip)

    def right_answer(self) -> int:
        """Return the index of the right option."""
        return next(i for i, option in enumerate(self.options) if option.right)

    def wrong_answer(self) -> int:
        """Return the index of a wrong option."""
        return next(i for i, option in enumerate(self.options) if not option.right)


@dataclass(frozen=True, eq=False, kw_only=True)
class Number(Task):
    """Predict a number or an array of numbers.

    Attributes
    ----------
    answer
        the number, or the array.
    label
        what stands before the field, such as "κ(0) =".
    unit
        what stands behind it.
    tolerance
        how far off an entry may be, as a fraction of the largest entry.
    modulo
        answers that differ by whole multiples of this are the same; 0 for none.
    slips
        wrong answers that have a name; they are given the answer as an array.
    because
        said when the answer is right.
    """

    kind: ClassVar[str] = "number"

    answer: Any
    label: str = ""
    unit: str = ""
    tolerance: float = 1e-3
    modulo: float = 0.0
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a text, a number, a list, an array or a dual number."""
        expected = np.asarray(self.answer, dtype=float)
        try:
            given = read_numbers(answer, expected.shape, self.unit)
        except GeometryError as error:
            return _unread(error)
        if given.shape != expected.shape:
            return _wrong_shape(given.shape, expected.shape)
        off = _differences(given, expected, self.modulo)
        allowed = self.tolerance * _size(expected)
        if np.all(np.abs(off) <= allowed):
            return Verdict(RIGHT, self.because)
        found = _recognised(self.slips, given)
        return found or Verdict(WRONG, what_is_off(given, expected, allowed))

    def right_answer(self) -> str:
        """Return the answer as text."""
        return _written(np.asarray(self.answer, dtype=float))

    def wrong_answer(self) -> str:
        """Return the answer enlarged, as text."""
        expected = np.asarray(self.answer, dtype=float)
        return _written(1.3 * expected + 0.31 * _size(expected))


def _written(array: Array) -> str:
    if array.ndim:
        return "[" + ", ".join(_written(part) for part in array) + "]"
    return named_number(float(array))


def _size(expected: Array) -> float:
    return float(np.abs(expected).max(initial=0.0)) or 1.0


def _differences(given: Array, expected: Array, modulo: float) -> Array:
    off = given - expected
    return off - modulo * np.round(off / modulo) if modulo else off


def _wrong_shape(given: tuple[int, ...], expected: tuple[int, ...]) -> Verdict:
    wanted, got = _shape_words(expected), _shape_words(given)
    example = "[1, 2, pi/3]" if expected else "2.5 or 3*pi/8"
    return Verdict(UNREAD, f"{wanted[:1].upper()}{wanted[1:]} is asked for, such as {example}; "
                           f"this is {got}.")  # fmt: skip


def _shape_words(shape: tuple[int, ...]) -> str:
    if not shape:
        return "one number"
    if len(shape) == 1:
        return f"an array of {shape[0]} number" + ("" if shape[0] == 1 else "s")
    return "an array of " + " × ".join(map(str, shape)) + " numbers"


FACTORS = (
    (2.0, "2"),
    (3.0, "3"),
    (4.0, "4"),
    (6.0, "6"),
    (math.pi, "π"),
    (2 * math.pi, "2π"),
    (math.pi / 2, "π/2"),
    (180 / math.pi, "180/π: are these degrees?"),
)


def what_is_off(given: Array, expected: Array, allowed: float) -> str:
    """Say what is off in an array or a number that is not right, without telling the answer."""
    if expected.ndim == 0:
        return _off_number(float(given), float(expected), allowed)
    if np.all(np.abs(given + expected) <= allowed):
        return "All entries have the right size and the wrong sign."
    if np.all(np.abs(np.sort(given, None) - np.sort(expected, None)) <= allowed):
        return "These are the right numbers in another order."
    wrong = np.argwhere(np.abs(given - expected) > allowed)
    first = tuple(wrong[0])
    place = ", ".join(str(i) for i in first)
    said = _off_number(float(given[first]), float(expected[first]), allowed)
    return f"{len(wrong)} of {expected.size} entries are off. The one at index {place}: {said}"


def _off_number(given: float, expected: float, allowed: float) -> str:
    if abs(given + expected) <= allowed:
        return "The size is right, the sign is not."
    if abs(given - expected) <= 30 * allowed:
        return "Close, but not close enough: give more digits, or look for a small slip."
    if factor := _factor(given, expected, allowed):
        return factor
    sign = " The sign is off too." if given * expected < 0 else ""
    larger, smaller = max(abs(given), abs(expected)), min(abs(given), abs(expected))
    direction = "large" if abs(given) > abs(expected) else "small"
    size = "more" if larger > 2 * smaller else "less"
    return f"Too {direction} in size, by {size} than a factor of 2.{sign}"


def _factor(given: float, expected: float, allowed: float) -> str:
    if given == 0.0 or expected == 0.0:
        return ""
    sign = ", and the sign is off" if given * expected < 0 else ""
    for factor, name in FACTORS:
        slack = allowed / abs(expected)
        if abs(abs(given / expected) / factor - 1) <= slack:
            return f"Too large by a factor of {name}{sign}."
        if abs(abs(expected / given) / factor - 1) <= slack:
            return f"Too small by a factor of {name}{sign}."
    return ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Formula(Task):
    """A formula in one or two variables; judged by its values, so every equivalent one passes.

    Attributes
    ----------
    answer
        the formula as text.
    variables
        one or two letters.
    box
        for each variable, from where to where values are compared.
    slips
        wrong formulas that have a name; see `misconceptions.formula`.
    """

    kind: ClassVar[str] = "formula"

    answer: str
    variables: tuple[str, ...] = ("u", "v")
    box: tuple[tuple[float, float], ...] = ((0.2, 2.9), (0.3, 2.8))
    label: str = ""
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a text, a number or a Python function."""
        places = self.places()
        try:
            function = read_formula(answer, self.variables)
            given = np.array(function(*places))
        except GeometryError as error:
            return _unread(error)
        expected = np.array(read_formula(self.answer, self.variables)(*places))
        scale = max(float(np.abs(expected).max()), 1e-6)
        if np.all(np.abs(given - expected) <= 1e-8 * scale):  # NaN is not close to anything
            return Verdict(RIGHT, self.because)
        found = _recognised(self.slips, function)
        return found or Verdict(WRONG, self._what_is_off(places, given, expected))

    def places(self) -> tuple[Array, ...]:
        """Return the places at which values are compared."""
        draw = Draw("places", "".join(self.variables))
        return tuple(
            np.array([draw.between(low, high) for _ in range(12)])
            for low, high in self.box[: len(self.variables)]
        )

    def _what_is_off(self, places: tuple[Array, ...], given: Array, expected: Array) -> str:
        bad = ~np.isfinite(given)
        if bad.any():
            return f"It has no value at {self._place(places, int(np.argmax(bad)))}."
        scale = float(np.abs(expected).max())
        if np.allclose(given, -expected, rtol=1e-8, atol=1e-8 * scale):
            return "The sign is off everywhere."
        with np.errstate(all="ignore"):
            ratio = given / expected
        if np.isfinite(ratio).all() and np.ptp(ratio) <= 1e-8 * abs(ratio[0]) and ratio[0] != 0:
            return f"Off by the constant factor {ratio[0]:.6g}."
        if np.ptp(given - expected) <= 1e-8 * scale:
            return f"Off by the constant {(given - expected)[0]:+.6g}."
        at = int(np.argmax(np.abs(given - expected)))
        return (
            f"At {self._place(places, at)} yours is {given[at]:.4g}, the right one "
            f"{expected[at]:.4g}."
        ).replace("-", "−")

    def _place(self, places: tuple[Array, ...], at: int) -> str:
        pairs = zip(self.variables, places, strict=True)
        return ", ".join(f"{name} = {values[at]:.3g}" for name, values in pairs)

    def right_answer(self) -> str:
        """Return the formula."""
        return self.answer

    def wrong_answer(self) -> str:
        """Return another formula."""
        return f"({self.answer})*1.5 + 0.37*{self.variables[0]} + 0.1"


# -- a design to drag ------------------------------------------------------------------------------


class Made(Protocol):
    """A design and what follows from it; a `Lab`'s result is one."""

    @property
    def design(self) -> Design:
        """The design."""

    @property
    def surface(self) -> RuledSurface:
        """Its surface."""

    @property
    def closure(self) -> Closure:
        """Whether and how it closes."""

    @property
    def pitch(self) -> Dual | None:
        """Λ = λ + ε l, or None where the surface does not close as an oriented motion."""


@dataclass(frozen=True, slots=True, eq=False)
class _Made:
    design: Design
    surface: RuledSurface
    closure: Closure
    pitch: Dual | None


def made(design: Design) -> Made:
    """Return what follows from a design, without anything to draw."""
    surface = design.surface()
    closure = surface.closure()
    try:
        pitch = surface.dual_angle_of_pitch() if closure.oriented else None
    except GeometryError:
        pitch = None
    return _Made(design, surface, closure, pitch)


@dataclass(frozen=True, slots=True)
class Condition:
    """One thing a design has to fulfil, and how far off it is.

    Attributes
    ----------
    text
        the condition: HTML with TeX.
    off
        how far off, ≥ 0; NaN where it cannot be measured.
    within
        how far off it may be.
    unit
        the unit of ``off``.
    now
        the present value, in words, or why there is none.
    """

    text: str
    off: float
    within: float
    unit: str = ""
    now: str = ""

    @property
    def met(self) -> bool:
        """Whether the condition holds."""
        return self.off <= self.within


@dataclass(frozen=True, eq=False, kw_only=True)
class Drag(Task):
    """Drag a design until conditions hold; judged by what follows from it, so every way counts.

    Attributes
    ----------
    start
        where it begins. It does not fulfil the conditions.
    model
        a design that does; shown as the solution.
    conditions
        given a `Made`, the conditions with how far off each is.
    fields
        whether ū and v̄ may be changed too.
    plots
        invariants that are plotted beside the chart, by their names.
    slips
        wrong designs that have a name; they are given a `Made`.
    """

    kind: ClassVar[str] = "drag"

    start: Design
    model: Design
    conditions: Callable[[Made], tuple[Condition, ...]]
    fields: bool = False
    plots: tuple[str, ...] = ()
    slips: tuple[Misconception, ...] = ()
    because: str = ""

    def judge(self, answer: Any) -> Verdict:
        """Judge a `Design`, its JSON or short text, or what follows from one."""
        try:
            result = _read_design(answer)
        except GeometryError as error:
            return _unread(error)
        conditions = self.conditions(result)
        if all(condition.met for condition in conditions):
            return Verdict(RIGHT, self.because)
        found = _recognised(self.slips, result)
        return found or Verdict(WRONG, " ".join(map(off_words, conditions)).strip())

    def right_answer(self) -> Design:
        """Return a design that fulfils the conditions."""
        return self.model

    def wrong_answer(self) -> Design:
        """Return the design one begins with."""
        return self.start


def off_words(condition: Condition) -> str:
    """Say how far off a condition is; nothing where it holds."""
    if condition.met:
        return ""
    if math.isnan(condition.off):
        return f"{condition.text}: {condition.now or 'cannot be measured now'}."
    unit = f" {condition.unit}" if condition.unit else ""
    return f"{condition.text}: still off by {condition.off:.3g}{unit}."


def _read_design(answer: Any) -> Made:
    if is_open(answer):
        raise GeometryError("nothing is answered yet; give a design, such as lab.design")
    if isinstance(answer, str):
        as_json = answer.lstrip().startswith("{")
        return made(Design.from_json(answer) if as_json else Design.from_text(answer))
    if isinstance(answer, Design):
        return made(answer)
    if all(hasattr(answer, name) for name in ("design", "surface", "closure", "pitch")):
        result: Made = answer
        return result
    if isinstance(getattr(answer, "design", None), Design):
        return made(answer.design)
    kind = type(answer).__name__
    raise GeometryError(f"this is an object of the type {kind}; give a design, such as lab.design")


# -- a curve to sketch -----------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, kw_only=True)
class Sketch(Task):
    """Sketch the expected curve over t, then see the true one over it.

    Attributes
    ----------
    curve
        given places t, the true heights; NaN where undefined.
    span
        the ends of the t-axis.
    heights
        the ends of the height axis.
    quantity
        the name of an invariant, for its colour; or empty.
    label
        what stands at the height axis.
    """

    kind: ClassVar[str] = "sketch"
    KNOTS: ClassVar[int] = 65

    curve: Callable[[Array], Array]
    heights: tuple[float, float]
    span: tuple[float, float] = (0.0, 1.0)
    quantity: str = ""
    label: str = "y"
    because: str = ""

    @property
    def t(self) -> Array:
        """The places at which a sketch has heights."""
        return np.linspace(*self.span, self.KNOTS)

    def judge(self, answer: Any) -> Verdict:
        """Judge a list of heights at `t`, None or NaN where nothing is drawn."""
        try:
            sketch = np.array([] if is_open(answer) else answer, dtype=float)
        except (TypeError, ValueError):
            return Verdict(UNREAD, "A sketch is a list of heights over t; draw one.")
        if sketch.shape != (self.KNOTS,):
            return Verdict(UNREAD, f"Draw a curve, or give its heights at {self.KNOTS} places t.")
        if (part := drawn(sketch)) < 0.85:
            share = round(100 * part)
            return Verdict(UNREAD, f"Draw over the whole of t: {share} % of it has a curve.")
        traits = self.traits(sketch)
        state = RIGHT if all(trait.agrees for trait in traits) else WRONG
        return Verdict(state, traits_html(traits) + (self.because if state == RIGHT else ""))

    def traits(self, sketch: Array) -> tuple[Trait, ...]:
        """Compare a sketch with the true curve."""
        height = self.heights[1] - self.heights[0]
        return compare(self.t, sketch, np.asarray(self.curve(self.t), dtype=float), height)

    def right_answer(self) -> list[float]:
        """Return the true heights."""
        values = np.asarray(self.curve(self.t), dtype=float)
        return [float(y) for y in np.nan_to_num(values)]

    def wrong_answer(self) -> list[float]:
        """Return a zigzag that no exercise asks for."""
        low, high = self.heights
        wave = np.sin(11 * np.pi * np.linspace(0, 1, self.KNOTS))
        return [float(y) for y in (low + high) / 2 + (high - low) / 2 * wave]


def traits_html(traits: Sequence[Trait]) -> str:
    """Return the comparison of a sketch as a list."""
    rows = "".join(
        f'<li class="{"is-met" if trait.agrees else "is-open"}"><b>{trait.name.capitalize()}</b> '
        f"{html.escape(trait.word)}</li>"
        for trait in traits
    )
    score = sum(trait.agrees for trait in traits)
    return f'Shape: {score} of {len(traits)} agree.<ul class="ruledlab-marks">{rows}</ul>'


# -- Python to write -------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, kw_only=True)
class Code(Number):
    """Write a few lines of Python; the value is handed to ``check("06.1", value)``.

    Attributes
    ----------
    starter
        the lines to begin from.
    test
        judges the value, where it is no number; None compares it with ``answer``.
    model
        with ``test``: a value that is right.
    """

    kind: ClassVar[str] = "code"

    starter: str = ""
    answer: Any = 0.0
    test: Callable[[Any], Verdict] | None = None
    model: Any = None

    def judge(self, answer: Any) -> Verdict:
        """Judge the value that the lines gave."""
        if is_open(answer):
            return Verdict(UNREAD, "Nothing is assigned yet: replace the dots by your lines.")
        return super().judge(answer) if self.test is None else self.test(answer)

    def right_answer(self) -> Any:
        """Return a value that is right."""
        return super().right_answer() if self.test is None else self.model

    def wrong_answer(self) -> Any:
        """Return a number that is wrong."""
        return super().wrong_answer()


# -- a slip to find --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Line:
    """A printed line. Without ``word`` it is the one with the slip.

    Attributes
    ----------
    text
        the line: HTML with TeX.
    word
        why this line is right.
    """

    text: str
    word: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class FindSlip(Task):
    """Find the wrong line among printed ones, then state the right one.

    An answer is a dict: ``{"line": index, "then": answer to the second question}``.

    Attributes
    ----------
    lines
        the printed lines; one of them has the slip.
    then
        the second question: `Choose`, `Number` or `Formula`.
    """

    kind: ClassVar[str] = "slip"

    lines: tuple[Line, ...]
    then: Choose | Number | Formula

    def __post_init__(self) -> None:
        super().__post_init__()
        if sum(not line.word for line in self.lines) != 1:
            raise ValueError("exactly one line must have no word: the one with the slip")

    @property
    def wrong_line(self) -> int:
        """The index of the line with the slip."""
        return next(i for i, line in enumerate(self.lines) if not line.word)

    def judge(self, answer: Any) -> Verdict:
        """Judge the line, and if it is the one, what should stand there."""
        parts = answer if isinstance(answer, dict) else {"line": answer}
        first = self.judge_line(parts.get("line"))
        if not first.right or "then" not in parts:
            state = UNREAD if first.right else first.state
            return Verdict(state, first.word, first.slip)
        return self.then.judge(parts["then"])

    def judge_line(self, line: Any) -> Verdict:
        """Judge the choice of the line alone."""
        if not isinstance(line, int) or isinstance(line, bool) or not 0 <= line < len(self.lines):
            return Verdict(UNREAD, "Choose one of the lines first.")
        if line == self.wrong_line:
            return Verdict(RIGHT, "This is the line. What should stand there?")
        return Verdict(WRONG, f"This line is right: {self.lines[line].word}")

    def right_answer(self) -> dict[str, Any]:
        """Return the line and its correction."""
        return {"line": self.wrong_line, "then": self.then.right_answer()}

    def wrong_answer(self) -> dict[str, Any]:
        """Return another line."""
        return {"line": next(i for i in range(len(self.lines)) if i != self.wrong_line)}


# -- where they are --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Exercise:
    """An exercise: its number, its title and how its task is made for a student.

    Attributes
    ----------
    key
        lesson and number: "06.1".
    title
        a few words.
    make
        makes the task.
    """

    key: str
    title: str
    make: Callable[[Draw], Task]

    def task(self, seed: str = "") -> Task:
        """Return the task for a student's seed."""
        return self.make(Draw(seed, self.key))


def lessons() -> tuple[str, ...]:
    """Return the lessons that have exercises: ("00", "01", …)."""
    path = importlib.import_module(__package__ or "").__path__
    names = (module.name for module in pkgutil.iter_modules(path))
    return tuple(sorted(n.removeprefix("lesson_") for n in names if n.startswith("lesson_")))


def lesson(number: str) -> tuple[Exercise, ...]:
    """Return the exercises of a lesson.

    Raises
    ------
    GeometryError
        if there are none.
    """
    name = str(number).zfill(2)
    if name not in lessons():
        raise GeometryError(
            f"`number` must be a lesson with exercises, one of {', '.join(lessons())}; "
            f"got {number!r}"
        )
    found: tuple[Exercise, ...] = importlib.import_module(f".lesson_{name}", __package__).EXERCISES
    return found


def find(key: str) -> Exercise:
    """Return an exercise by its number, such as "06.1".

    Raises
    ------
    GeometryError
        if there is none.
    """
    found = lesson(str(key).partition(".")[0])
    for exercise in found:
        if exercise.key == key:
            return exercise
    known = f"{found[0].key} … {found[-1].key}"
    raise GeometryError(f"`key` must be the number of an exercise, {known}; got {key!r}")
