"""Answering from a code cell: ``check("06.12", value)``. No widgets."""

from __future__ import annotations

import html
import json
import pathlib
import re
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..design import Design
from .answers import read_numbers
from .core import UNREAD, Task, Verdict, find
from .store import Store, the_store

__all__ = ["HEADS", "STYLE", "Checked", "check", "keep", "kept", "seed", "verdict_html"]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
STYLE: Final = (_STATIC / "verdict.css").read_text(encoding="utf-8")

HEADS = {"right": "Right.", "wrong": "Not yet.", "unread": ""}
"""What a verdict begins with."""


@dataclass(frozen=True, slots=True)
class Checked:
    """What was said to an answer; a notebook shows it typeset.

    Attributes
    ----------
    key
        the exercise.
    verdict
        the judgement.
    """

    key: str
    verdict: Verdict

    @property
    def right(self) -> bool:
        """Whether the answer was right."""
        return self.verdict.right

    def __bool__(self) -> bool:
        return self.right

    def __repr__(self) -> str:
        text = html.unescape(re.sub(r"<[^>]+>", " ", self.verdict.word))
        return " ".join(f"{self.key}: {HEADS[self.verdict.state]} {text}".split())

    def _repr_html_(self) -> str:
        return f"<style>{STYLE}</style>{verdict_html(self.verdict, self.key)}"


def check(key: str, value: Any, store: Store | None = None) -> Checked:
    """Say whether a value answers an exercise, and keep the answer.

    Parameters
    ----------
    key
        the exercise, such as "06.12".
    value
        the answer: a number, a list, an array, a dual number, a formula or a function, a design.
    store
        where answers are kept; None for the file beside the lessons.

    Raises
    ------
    GeometryError
        if there is no such exercise.
    """
    store = the_store() if store is None else store
    task = find(key).task(store.seed)
    verdict = task.judge(value)
    keep(store, key, task, value, verdict)
    return Checked(key, verdict)


def seed(value: object = None) -> str:
    """Return the student's seed, or set it: a name or a number, on which the values depend."""
    store = the_store()
    if value is not None:
        store.set_seed(value)
    return store.seed


def keep(store: Store, key: str, task: Task, answer: Any, verdict: Verdict) -> None:
    """Keep an answer that could be read; who was right once stays right."""
    if verdict.state == UNREAD:
        return
    old = store.record(key)
    if old.get("seed") != store.seed:  # other values: begin anew
        old = {}
    store.update(
        key,
        answer=kept(task, answer),
        right=verdict.right or bool(old.get("right")),
        tries=int(old.get("tries", 0)) + 1,
        hints=int(old.get("hints", 0)),
        solution=bool(old.get("solution")),
        slip=verdict.slip,
        seed=store.seed,
    )


def kept(task: Task, answer: Any) -> Any:
    """Return an answer as JSON can hold it and the task can judge it again."""
    if task.kind == "drag":
        design = getattr(answer, "design", answer)
        return design.to_text() if isinstance(design, Design) else str(answer)
    if isinstance(answer, (str, int)) or task.kind in ("choose", "slip"):
        return answer
    if task.kind == "sketch":
        return [None if not np.isfinite(y) else round(float(y), 6) for y in _floats(answer)]
    try:
        return json.dumps(read_numbers(answer, (0,)).tolist())
    except ValueError:
        return getattr(answer, "text", None) or repr(answer)[:200]


def _floats(answer: Any) -> Any:
    return np.array(answer, dtype=float)


def verdict_html(verdict: Verdict, lead: str = "") -> str:
    """Return a verdict as HTML, spoken by screen readers when it appears."""
    role = "alert" if verdict.state == UNREAD else "status"
    head = f"<b>{HEADS[verdict.state]}</b> " if HEADS[verdict.state] else ""
    number = f'<span class="ruledlab-number">{html.escape(lead)}</span> ' if lead else ""
    slip = (
        f'<span class="ruledlab-slip">{html.escape(verdict.slip)}</span> ' if verdict.slip else ""
    )
    pointer = f"<pre>{html.escape(verdict.pointer)}</pre>" if verdict.pointer else ""
    return (
        f'<div class="ruledlab-verdict is-{verdict.state}" role="{role}">{number}'
        f"{head}{slip}{verdict.word}{pointer}</div>"
    )
