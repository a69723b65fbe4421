"""What every exercise has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ..verdict import Verdict

__all__ = ["Task"]


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
