"""Find the slip among printed lines, and mend it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ..verdict import RIGHT, UNREAD, WRONG, Verdict
from .choose import Choose, whole
from .formula import Formula
from .number import Number
from .task import Task

__all__ = ["FindSlip", "Line"]


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
        index = whole(line)
        if index is None or not 0 <= index < len(self.lines):
            return Verdict(UNREAD, "Choose one of the lines first.")
        if index == self.wrong_line:
            return Verdict(RIGHT, "This is the line. What should stand there?")
        return Verdict(WRONG, f"This line is right: {self.lines[index].word}")

    def right_answer(self) -> dict[str, Any]:
        """Return the line and its correction."""
        return {"line": self.wrong_line, "then": self.then.right_answer()}

    def wrong_answer(self) -> dict[str, Any]:
        """Return another line."""
        return {"line": next(i for i in range(len(self.lines)) if i != self.wrong_line)}
