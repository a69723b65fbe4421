"""The table: one row for each comparison, printed as soon as it is known."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["HEAD", "Row", "line"]

HEAD = ("what", "ruledlab", "the usual way", "ratio", "target", "")
WIDTHS = (58, 12, 14, 18, 12, 6)


@dataclass(frozen=True, slots=True)
class Row:
    """One comparison.

    Attributes
    ----------
    what
        what was measured.
    ours, usual
        the two measurements, in ``unit``; ``usual`` is None where there is nothing to compare with.
    unit
        the unit both are printed in.
    at_most
        the target: a bound of ours/usual, or of ours alone where there is no ``usual``.
    typical
        the ratio of the medians, where ``ours`` and ``usual`` are minima: shows the spread.
    """

    what: str
    ours: float
    usual: float | None
    unit: str
    at_most: float | None = None
    typical: float | None = None

    @property
    def ratio(self) -> float | None:
        """Ours/usual."""
        return None if self.usual is None else self.ours / self.usual

    @property
    def met(self) -> str:
        """Whether the target is reached."""
        if self.at_most is None:
            return ""
        reached = self.ours if self.ratio is None else self.ratio
        return "met" if reached <= self.at_most else "MISSED"

    def cells(self) -> tuple[str, ...]:
        """Return the texts of the row."""
        return (
            self.what,
            f"{self.ours:.3g} {self.unit}",
            "" if self.usual is None else f"{self.usual:.3g} {self.unit}",
            self._ratio_text(),
            self._target_text(),
            self.met,
        )

    def _ratio_text(self) -> str:
        if self.ratio is None:
            return ""
        typical = "" if self.typical is None else f" ({_times(self.typical)})"
        return _times(self.ratio) + typical

    def _target_text(self) -> str:
        if self.at_most is None:
            return ""
        if self.usual is None:
            return f"≤ {self.at_most:g} {self.unit}"
        return f"≤ {_times(self.at_most)}"


def _times(ratio: float) -> str:
    """Say 0.2 as 1/5: it is how targets for something small are spoken of."""
    return f"{ratio:.2f}×" if ratio > 0.5 else f"1/{1 / ratio:.3g}"


def line(cells: tuple[str, ...]) -> str:
    """Return the cells as one line of a Markdown table, columns aligned."""
    padded = (text.ljust(width) for text, width in zip(cells, WIDTHS, strict=True))
    return f"| {' | '.join(padded)} |"
