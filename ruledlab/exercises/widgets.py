"""Exercises as widgets: a card for each, answer boxes for each kind, and what is done so far."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import ipywidgets as w

from ..lab.apps.base import Page
from ..lab.cells import closes_with_cell
from ..lab.controls import Group
from ..lab.state import Lab
from .answers import is_open
from .boxes import LIVE, ChooseBox, GoalBox, box_for, close_all, maths, press, show, style
from .core import UNREAD, Exercise, Sketch, Verdict, find, lesson, lessons
from .record import begin_or_go_on, keep, kept, verdict_html
from .store import Store, the_store

__all__ = ["Card", "Lesson", "Predict", "exercise", "exercises", "predict", "progress"]

# -- the public functions --------------------------------------------------------------------------


def exercise(key: str, lab: Lab | None = None, store: Store | None = None) -> Card:
    """Return an exercise as a widget; running the cell again closes it.

    Parameters
    ----------
    key
        lesson and number, such as "06.1".
    lab
        for exercises in which a design is dragged: a lab to use instead of one of its own.
    store
        where answers are kept; None for the file beside the lessons.
    """
    card = Card(find(key), the_store() if store is None else store, lab)
    card.add_style()
    closes_with_cell(card.close)
    return card


def exercises(number: str, store: Store | None = None) -> Lesson:
    """Return all exercises of a lesson as one widget, opened at the first that is not done."""
    shown = Lesson(number, the_store() if store is None else store)
    closes_with_cell(shown.close)
    return shown


def progress(store: Store | None = None) -> Progress:
    """Return a small table of what is done; it follows what is answered."""
    shown = Progress(the_store() if store is None else store)
    closes_with_cell(shown.close)
    return shown


def predict(question: str, options: Sequence[str], answer: int | str, because: str) -> Predict:
    """Return a question to answer before looking; nothing is kept, nothing is blocked.

    Parameters
    ----------
    question, options, because
        HTML with TeX; ``because`` is shown once an answer is chosen.
    answer
        the right option, or its index.

    Raises
    ------
    ValueError
        if the answer is none of the options.
    """
    texts = tuple(options)
    right = answer if isinstance(answer, int) else (*texts, answer).index(answer)
    if not 0 <= right < len(texts):
        raise ValueError(f"`answer` must be one of the {len(texts)} options; got {answer!r}")
    shown = Predict(question, texts, right, because)
    closes_with_cell(shown.close)
    return shown


# -- one exercise ----------------------------------------------------------------------------------


class Card(w.VBox):  # type: ignore[misc]
    """One exercise: question, answer, what is said to it, hints and solution.

    Attributes
    ----------
    task
        the task, with its values.
    box
        where the answer is given.
    """

    _follow: Callable[[], None] | None = None

    def __init__(self, exercise: Exercise, store: Store, lab: Lab | None = None) -> None:
        self.exercise, self._store, self._lab = exercise, store, lab
        self._group = Group()
        super().__init__()
        self.add_class("ruledlab").add_class("ruledlab-exercise")
        store.refresh()
        self._build()
        self._follow = store.follow(self._heard)

    def add_style(self) -> None:
        """Bring the style along: for a card that stands alone."""
        self.children: tuple[Any, ...]
        self.children = (style(), *self.children)

    # -- building --------------------------------------------------------------------------------

    def _build(self) -> None:
        self._seed = self._store.seed
        self.task = self.exercise.task(self._seed)
        self._head, self._note = w.HTML(), maths("", LIVE)
        self._verdict = maths("", LIVE)
        self._hints = maths("")
        self._more = press("Hint", "ruledlab-quiet")
        self._solve = press("Solution", "ruledlab-quiet")
        self.box = box_for(
            self.task, self._group, self._answer, self.exercise.key, self._say, self._lab
        )
        if isinstance(self.box, GoalBox):
            self.box.draft = self._draft
        self._group.click(self._more, self._hint)
        self._group.click(self._solve, self._solution)
        self.children = (
            self._head,
            maths(self.task.question, "ruledlab-question"),
            self.box.widget,
            self._verdict,
            self._hints,
            w.HBox([self._more, self._solve]).add_class("ruledlab-help"),
            self._note,
            self._group.defect,
            Page(),
        )
        self._open = bool(self._record().get("solution"))
        self._restore()
        self._refresh()

    def _record(self) -> dict[str, Any]:
        """Return what is known of this exercise with these values."""
        record = self._store.record(self.exercise.key)
        return record if record.get("seed", self._seed) == self._seed else {}

    def _restore(self) -> None:
        answer = self._record().get("answer")
        if is_open(answer):
            return
        verdict = self.task.judge(answer)
        if verdict.state == UNREAD:  # of another version of the exercise, or the file was edited
            return
        self.box.show(answer)
        working = isinstance(self.box, GoalBox) and not verdict.right and not verdict.slip
        self._say(None if working else verdict)  # the conditions say how far off it is

    # -- what the reader does --------------------------------------------------------------------

    def _answer(self, answer: Any) -> None:
        verdict = self.task.judge(answer)
        self._say(verdict)
        keep(self._store, self.exercise.key, self.task, answer, verdict)
        if isinstance(self.task, Sketch) and verdict.state != UNREAD:
            self.box.reveal()
        self._refresh()

    def _hint(self) -> None:
        most = len(self.task.hints)
        self._put(lambda known: {"hints": min(known["hints"] + 1, most)})

    def _solution(self) -> None:
        self._open = not self._open
        if self._open:
            self.box.reveal()
        record = self._record()
        if not record.get("right") and not record.get("solution"):
            self._put(lambda known: {"solution": not known["right"] or known["solution"]})
        self._refresh()

    def _put(self, entries: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
        """Change the record, given what is known; one with other values is begun anew."""

        def change(old: dict[str, Any]) -> dict[str, Any]:
            known = begin_or_go_on(old, self._seed)
            return {**known, **entries(known)}

        self._store.change(self.exercise.key, change)
        self._refresh()

    def _draft(self, value: Any) -> None:
        """Keep what is being moved."""
        answer = kept(self.task, value)
        self._put(lambda known: {} if known["right"] else {"answer": answer})

    # -- what is shown ---------------------------------------------------------------------------

    def _say(self, verdict: Verdict | None) -> None:
        show(self._verdict, verdict_html(verdict) if verdict else "")

    def _heard(self, key: str) -> None:
        """Follow the store: an answer from a code cell, another seed."""
        if not key and self._store.seed != self._seed:
            self._group.guard(self._rebuild)
        elif key == self.exercise.key:
            if self.task.kind == "code":
                self._group.guard(self._restore)
            self._refresh()

    def _rebuild(self) -> None:
        old = self.children
        lead = [child for child in old[:1] if child is not self._head]
        self.box.close()
        self._group.release()
        self._group = Group()
        self._build()
        self.children = (*lead, *self.children)
        for child in old[len(lead) :]:
            close_all(child)

    def _refresh(self) -> None:
        record, task = self._record(), self.task
        used = min(int(record.get("hints", 0)), len(task.hints))
        number, title = self.exercise.key, html.escape(self.exercise.title)
        state, words = state_of(record)
        self._head.value = (
            f'<div class="ruledlab-head-row"><span class="ruledlab-number">{number}</span> '
            f'<span class="ruledlab-title">{title}</span>'
            f'<span class="ruledlab-state is-{state}">{words}</span></div>'
        )
        hints = "".join(
            f'<div class="ruledlab-hint"><b>Hint {i + 1}</b> {hint}</div>'
            for i, hint in enumerate(task.hints[:used])
        )
        solution = f'<div class="ruledlab-solution"><b>Solution</b> {task.solution}</div>'
        show(self._hints, hints + (solution if self._open else ""))
        left = len(task.hints) - used
        self._more.description = f"Hint ({left} left)" if left else "No more hints"
        self._more.disabled = left == 0
        self._more.layout.display = "" if task.hints else "none"
        self._solve.description = "Hide the solution" if self._open else "Show the solution"
        note = html.escape(self._store.note)
        show(self._note, f'<div class="ruledlab-note">{note}</div>' if note else "")

    def close(self) -> None:
        """Close every widget and leave no observer behind; a second call does nothing."""
        if self._follow is None:
            return
        self._follow()
        self._follow = None
        self.box.close()
        self._group.release()
        close_all(self)


def state_of(record: Mapping[str, Any]) -> tuple[str, str]:
    """Return the state of an exercise, as a class and in words."""
    if record.get("right"):
        hints = int(record.get("hints", 0))
        if record.get("solution"):
            return "right", "✓ done, solution seen"
        if hints:
            return "right", f"✓ done with {hints} hint{'s' if hints > 1 else ''}"
        return "right", "✓ done"
    if record.get("solution"):
        return "seen", "solution seen"
    if record.get("tries"):
        return "tried", "begun"
    return "new", ""


def _known(store: Store, key: str) -> dict[str, Any]:
    """Return what is known of an exercise with the present values."""
    record = store.record(key)
    return record if record.get("seed") == store.seed else {}


# -- a whole lesson --------------------------------------------------------------------------------


class Lesson(w.VBox):  # type: ignore[misc]
    """All exercises of a lesson: a row of numbers, and the card of the one that is open.

    Attributes
    ----------
    card
        the open exercise.
    """

    _follow: Callable[[], None] | None = None

    def __init__(self, number: str, store: Store) -> None:
        self._exercises, self._store = lesson(number), store
        self._group = Group()
        self._cards: dict[str, Card] = {}
        self._buttons = {e.key: self._number(e) for e in self._exercises}
        self._sum = w.HTML()
        self._place = w.VBox()
        row = w.HBox([*self._buttons.values(), self._sum]).add_class("ruledlab-steps")
        super().__init__([style(), row, self._place, self._group.defect, Page()])
        self.add_class("ruledlab").add_class("ruledlab-lesson")
        store.refresh()
        self._follow = store.follow(lambda key: self._mark())
        done = [e.key for e in self._exercises if self._state(e.key) == "right"]
        waiting = [e.key for e in self._exercises if e.key not in done]
        self.turn_to((waiting or done)[0])

    def _number(self, exercise: Exercise) -> Any:
        button = press(exercise.key.partition(".")[2], "ruledlab-step")
        self._group.click(button, lambda: self.turn_to(exercise.key))
        return button

    def _state(self, key: str) -> str:
        return state_of(_known(self._store, key))[0]

    def turn_to(self, key: str) -> None:
        """Open an exercise; what was begun in others stays."""
        if key not in self._cards:
            chosen = next(e for e in self._exercises if e.key == key)
            self._cards[key] = Card(chosen, self._store)
        self.card = self._cards[key]
        self._place.children = (self.card,)
        self._mark()

    def _mark(self) -> None:
        states = {e.key: self._state(e.key) for e in self._exercises}
        for exercise in self._exercises:
            button, state = self._buttons[exercise.key], states[exercise.key]
            here = exercise.key == self.card.exercise.key
            mark = "✓ " if state == "right" else ""
            words = {"right": "done", "seen": "solution seen", "tried": "begun", "new": "new"}
            button.description = mark + exercise.key.partition(".")[2]
            button.tooltip = f"{exercise.key} {exercise.title}: {words[state]}"
            for name, on in (("is-here", here), *((f"is-{s}", s == state) for s in words)):
                (button.add_class if on else button.remove_class)(name)
        done = sum(state == "right" for state in states.values())
        self._sum.value = f'<span class="ruledlab-sum">{done} of {len(states)} done</span>'

    def close(self) -> None:
        """Close every widget and leave no observer behind; a second call does nothing."""
        if self._follow is None:
            return
        self._follow()
        self._follow = None
        self._group.release()
        for card in self._cards.values():
            card.close()
        close_all(self)


# -- predict, then look ----------------------------------------------------------------------------


class Predict(w.VBox):  # type: ignore[misc]
    """A question before a picture: choose, and the reason is shown."""

    def __init__(self, question: str, options: tuple[str, ...], answer: int, because: str) -> None:
        self._right = answer
        self._because, self._group = because, Group()
        self.box = ChooseBox(
            self._group, self._chosen, options, range(len(options)), "your prediction", "Predict"
        )
        self._word = maths("", LIVE)
        lead = '<span class="ruledlab-number">Predict</span> '
        asked = maths(lead + question, "ruledlab-question")
        super().__init__([style(), asked, self.box.widget, self._word, self._group.defect, Page()])
        self.add_class("ruledlab").add_class("ruledlab-exercise").add_class("ruledlab-predict")

    def _chosen(self, answer: Any) -> None:
        if answer is None:
            show(self._word, verdict_html(Verdict(UNREAD, "Choose one of the answers first.")))
            return
        head = "As you said." if answer == self._right else "A surprise, perhaps."
        state = "right" if answer == self._right else "wrong"
        show(
            self._word,
            f'<div class="ruledlab-verdict is-{state}"><b>{head}</b> {self._because}</div>',
        )

    def close(self) -> None:
        """Close every widget and leave no observer behind."""
        self._group.release()
        close_all(self)


# -- what is done ----------------------------------------------------------------------------------


class Progress(w.VBox):  # type: ignore[misc]
    """A small table of what is done, lesson by lesson."""

    _follow: Callable[[], None] | None = None

    def __init__(self, store: Store) -> None:
        self._store = store
        self._table = w.HTML()
        super().__init__([style(), self._table])
        self.add_class("ruledlab").add_class("ruledlab-progress")
        store.refresh()
        self._follow = store.follow(lambda key: self._show())
        self._show()

    def _show(self) -> None:
        self._table.value = progress_html(self._store)

    def close(self) -> None:
        """Close every widget and leave no observer behind; a second call does nothing."""
        if self._follow is not None:
            self._follow()
            self._follow = None
            close_all(self)


def progress_html(store: Store) -> str:
    """Return the table of what is done as HTML."""
    rows = "".join(_lesson_row(number, store) for number in lessons())
    note = f"<p>{html.escape(store.note)}</p>" if store.note else ""
    who = f"seed “{html.escape(store.seed)}”" if store.seed else "no seed set"
    return (
        '<table class="ruledlab-table"><thead><tr><th scope="col">lesson</th>'
        '<th scope="col">done</th><th scope="col">hints</th><th scope="col">solutions seen</th>'
        f'<th scope="col">exercises</th></tr></thead><tbody>{rows}</tbody></table>'
        f'<div class="ruledlab-note">{note}{html.escape(store.path.name)}, {who}</div>'
    )


def _lesson_row(number: str, store: Store) -> str:
    found = lesson(number)
    records = [_known(store, exercise.key) for exercise in found]
    states = [state_of(record) for record in records]
    marks = {"right": "✓", "seen": "–", "tried": "…", "new": "·"}
    dots = "".join(
        f'<span class="is-{state}" title="{e.key} {html.escape(e.title)}: {words or "new"}">'
        f"{marks[state]}</span>"
        for e, (state, words) in zip(found, states, strict=True)
    )
    done = sum(state == "right" for state, _ in states)
    hints = sum(int(record.get("hints", 0)) for record in records)
    seen = sum(bool(record.get("solution")) for record in records)
    return (
        f'<tr><th scope="row">{number}</th><td>{done} of {len(found)}</td><td>{hints}</td>'
        f'<td>{seen}</td><td class="ruledlab-dots">{dots}</td></tr>'
    )
