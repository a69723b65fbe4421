"""Values that vary with a student's seed."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TypeVar

__all__ = ["Draw"]

T = TypeVar("T")


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
