"""HTML that several rooms write: tables of numbers, legends."""

from __future__ import annotations

from collections.abc import Iterable

from .palette import Theme

__all__ = ["legend", "numbers_table"]


def numbers_table(rows: Iterable[tuple[str, str, str, str]]) -> str:
    """Return rows (name, symbol, value, unit) as a table; all of them are HTML."""
    body = "".join(
        f"<tr><td>{name} <i>{symbol}</i></td><td>{value}</td><td>{unit}</td></tr>"
        for name, symbol, value, unit in rows
    )
    return f'<table class="ruledlab-numbers">{body}</table>'


def legend(entries: Iterable[tuple[str, str]], theme: Theme) -> str:
    """Return what is drawn in which colour (its name, words); the words stand in the page's own."""
    parts = "&emsp;".join(
        f'<span style="white-space:nowrap"><span aria-hidden="true" '
        f'style="color:{theme.quantity(name)}">■</span> {text}</span>'
        for name, text in entries
    )
    return f'<div class="ruledlab-note">{parts}</div>'
