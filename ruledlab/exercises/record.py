"""Answering from a code cell: ``check("06.12", value)``. No widgets."""

from __future__ import annotations

import html
import json
import math
import pathlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ..geometry.checks import GeometryError
from .answers import read_numbers
from .core import UNREAD, Choose, Drag, FindSlip, Formula, Place, Sketch, Task, Verdict, find
from .kinds.choose import whole
from .store import Store, the_store

__all__ = [
    "HEADS",
    "STYLE",
    "Checked",
    "begin_or_go_on",
    "check",
    "keep",
    "kept",
    "seed",
    "verdict_html",
]

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
        said = verdict_html(self.verdict, self.key)
        return f'<style>{STYLE}</style><div role="status">{said}</div>'


def check(key: str, value: Any, store: Store | None = None) -> Checked:
    """Say whether a value answers an exercise, and keep the answer.

    Parameters
    ----------
    key
        the exercise, such as "06.12".
    value
        the answer: a number, a list, an array, a dual number, a formula or a function, a design,
        two lines.
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
    answer = kept(task, answer)

    def entries(old: Mapping[str, Any]) -> dict[str, Any]:
        begun = begin_or_go_on(old, store.seed)
        return {
            **begun,
            "answer": answer,
            "right": verdict.right or begun["right"],
            "tries": begun["tries"] + 1,
            "slip": verdict.slip,
        }

    store.change(key, entries)


def begin_or_go_on(record: Mapping[str, Any], seed: str) -> dict[str, Any]:
    """Return what is known of an exercise; nothing yet if it had other values."""
    blank = {"answer": None, "right": False, "tries": 0, "hints": 0, "solution": False}
    return {**blank, **(record if record.get("seed") == seed else {}), "seed": seed}


def kept(task: Task, answer: Any) -> Any:
    """Return an answer as JSON can hold it and the task can judge it again."""
    match task:
        case Drag():
            return task.value_of(answer).to_text()
        case Place():
            return task.value_of(answer).numbers
        case FindSlip():
            return _kept_parts(task, answer)
        case Choose():
            return whole(answer)
        case Sketch():
            heights = np.array(answer, dtype=float)
            return [round(float(y), 6) if abs(y) < math.inf else None for y in heights]
        case Formula():
            return _kept_formula(answer)
    return _kept_value(answer)


def _kept_parts(task: FindSlip, answer: Any) -> dict[str, Any]:
    parts = answer if isinstance(answer, dict) else {"line": answer}
    then = {"then": kept(task.then, parts["then"])} if "then" in parts else {}
    return {"line": whole(parts.get("line")), **then}


def _kept_formula(answer: Any) -> str:
    """Return a formula's text; a Python function has none."""
    if isinstance(answer, str):
        return answer
    text = getattr(answer, "text", None) if callable(answer) else str(answer)
    return text if isinstance(text, str) else ""


def _kept_value(answer: Any) -> str:
    if isinstance(answer, str):
        return answer
    try:
        return json.dumps(read_numbers(answer, (0,)).tolist())
    except GeometryError:  # a value that only its exercise can read
        return repr(answer)[:200]


def verdict_html(verdict: Verdict, lead: str = "") -> str:
    """Return a verdict as HTML; one of an answer that could not be read is an alert.

    The others are spoken where they stand in something with the role of a status.
    """
    role = ' role="alert"' if verdict.state == UNREAD else ""
    head = f"<b>{HEADS[verdict.state]}</b> " if HEADS[verdict.state] else ""
    number = f'<span class="ruledlab-number">{html.escape(lead)}</span> ' if lead else ""
    slip = (
        f'<span class="ruledlab-slip">{html.escape(verdict.slip)}</span> ' if verdict.slip else ""
    )
    pointer = f"<pre>{html.escape(verdict.pointer)}</pre>" if verdict.pointer else ""
    return (
        f'<div class="ruledlab-verdict is-{verdict.state}"{role}>{number}'
        f"{head}{slip}{verdict.word}{pointer}</div>"
    )
