"""Exercises as widgets: answered, restored, re-made for another seed, closed without a trace."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import ipywidgets as w
import pytest
from ipywidgets.widgets.widget import _instances

from ruledlab.exercises import exercise, exercises, predict, progress
from ruledlab.exercises import widgets as widgets_module
from ruledlab.exercises.core import Exercise, lesson
from ruledlab.exercises.record import check
from ruledlab.exercises.store import Store
from ruledlab.exercises.widgets import Card
from ruledlab.lab import Lab

PLACES = tuple(e for e in lesson("02") if e.task().kind == "place")
ALL = pytest.mark.parametrize("made", (*lesson("06"), *PLACES), ids=lambda e: e.key)
MOVED = ("drag", "place")


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "p.json")


@pytest.fixture(autouse=True)
def nothing_stays_open() -> Iterator[None]:
    before = set(_instances)
    yield
    left = [_instances[key] for key in set(_instances) - before]
    assert left == []


def shown(widget: Any) -> str:
    """All text that a reader can see."""
    if getattr(widget.layout, "display", None) == "none":
        return ""
    own = str(getattr(widget, "value", ""))
    return own + "".join(shown(child) for child in getattr(widget, "children", ()))


def fronts(card: Any) -> list[Any]:
    found = [card] if hasattr(card, "part") else []
    return found + [f for child in getattr(card, "children", ()) for f in fronts(child)]


def say(front: Any, **content: Any) -> None:
    """Send what the browser sends."""
    front._handle_custom_msg(content, [])


def play(card: Card, answer: Any) -> None:
    """Give an answer as a reader does."""
    kind, store = card.task.kind, card._store
    if kind == "choose":
        say(fronts(card)[0], chosen=card.task.shown.index(answer))
    elif kind in ("number", "formula"):
        say(fronts(card)[0], text=answer)
    elif kind == "sketch":
        say(fronts(card)[0], sketch=answer)
    elif kind in MOVED:
        card.box.slate.load(answer, "test")
    elif kind == "code":
        check(card.exercise.key, answer, store)
    else:
        first, second = fronts(card)
        say(first, chosen=answer["line"])
        if "then" in answer:
            then = answer["then"]
            if isinstance(then, int):
                say(second, chosen=card.task.then.shown.index(then))
            else:
                say(second, text=then)


@ALL
def test_it_is_answered_wrongly_then_rightly_and_restored(made: Exercise, store: Store) -> None:
    card = exercise(made.key, store=store)
    if made.task().kind not in MOVED:  # they begin with a wrong value
        play(card, card.task.wrong_answer())
        assert "Not yet." in shown(card)
        assert store.record(made.key)["right"] is False
    play(card, card.task.right_answer())
    assert "Right." in shown(card)
    assert "✓ done" in shown(card)
    card.close()
    again = exercise(made.key, store=Store(store.path))
    assert "Right." in shown(again)
    assert "✓ done" in shown(again)
    assert again._group.defect.value == ""
    again.close()


@ALL
def test_hints_are_graded_and_the_solution_is_marked(made: Exercise, store: Store) -> None:
    card = exercise(made.key, store=store)
    hints = card.task.hints
    for count in range(len(hints) + 1):
        text = shown(card)
        assert [hint in text for hint in hints] == [i < count for i in range(len(hints))]
        card._more.click()
    assert card._more.disabled
    assert card.task.solution not in shown(card)
    card._solve.click()
    assert card.task.solution in shown(card)
    assert "solution seen" in shown(card)
    card._solve.click()
    assert card.task.solution not in shown(card)
    record = store.record(made.key)
    assert (record["hints"], record["solution"], record["right"]) == (len(hints), True, False)
    card.close()


@ALL
def test_a_wrong_answer_after_a_right_one_keeps_the_mark(made: Exercise, store: Store) -> None:
    card = exercise(made.key, store=store)
    play(card, card.task.right_answer())
    play(card, card.task.wrong_answer())
    assert store.record(made.key)["right"] is True
    assert "✓ done" in shown(card)
    card.close()


def test_nonsense_is_said_at_once_and_not_kept(store: Store) -> None:
    card = exercise("06.3", store=store)
    say(fronts(card)[0], text="3*sqrt(2")
    assert 'role="alert"' in shown(card)
    assert "never closed" in shown(card)
    assert store.keys() == ()
    say(fronts(card)[0], junk=1)
    say(fronts(card)[0], text=7)
    assert card._group.defect.value == ""
    card.close()


@ALL
def test_opening_an_exercise_is_no_answer(made: Exercise, store: Store) -> None:
    card = exercise(made.key, store=store)
    assert "Not yet." not in shown(card)
    card.close()
    assert store.keys() == ()
    assert not store.path.exists()


def test_nothing_chosen_is_said(store: Store) -> None:
    card = exercise("06.1", store=store)
    say(fronts(card)[0], chosen=None)
    assert "Choose one of the answers first" in shown(card)
    say(fronts(card)[0], chosen=99)
    assert store.keys() == ()
    card.close()


def test_a_drag_is_live_and_names_the_misconception(store: Store) -> None:
    card = exercise("06.9", store=store)
    assert "off by" in shown(card)
    card.box.lab.load(card.task.slips[0].example, "test")
    assert "collinear taken for C¹" in shown(card)
    card.box.lab.undo()
    assert "collinear taken for C¹" not in shown(card)
    card.box.lab.load(card.task.model, "test")
    assert "Right." in shown(card)
    assert "off by" not in shown(card)
    card.close()


def test_a_design_that_is_being_worked_on_is_kept(store: Store) -> None:
    card = exercise("06.8", store=store)
    moved = card.box.lab.design.with_(length=3.0)
    card.box.lab.load(moved, "test")
    card.close()  # before the pause is over
    again = exercise("06.8", store=Store(store.path))
    assert again.box.lab.design == moved
    assert "off by" in shown(again)
    assert "Not yet." not in shown(again)
    assert store.record("06.8")["right"] is False
    again.close()


# -- two lines in hand -----------------------------------------------------------------------------


def pull(card: Card, index: int, by: tuple[float, float], drag: int = 1) -> None:
    """Move a handle in the picture by pixels, as the browser reports it."""
    handles = card.box.figure.grips
    handle = handles.picture["handles"][index]
    handles.motion = ["view", drag, index, handle["x"] + by[0], handle["y"] + by[1]]


@pytest.fixture
def placing(store: Store) -> Iterator[Card]:
    card = exercise("02.12", store=store)
    yield card
    assert not any(g.defect.value for g in (card._group, *card.box.figure._groups))
    card.close()


def test_two_lines_are_moved_by_hand_and_every_condition_follows(placing: Card) -> None:
    before = shown(placing.box._conditions)
    pull(placing, 2, (30, 10))
    assert shown(placing.box._conditions) != before
    pull(placing, 3, (15, -10), drag=2)
    moved = placing.box.slate.value
    placing.box.figure.history.undo.click()
    assert placing.box.slate.value != moved
    placing.box.figure.history.undo.click()
    assert placing.box.slate.value == placing.task.start
    assert shown(placing.box._conditions) == before
    assert placing.box.figure.lines.which.value == "b"


def test_two_lines_are_placed_by_typing_exact_numbers(placing: Card) -> None:
    fields = placing.box.figure.lines.numbers
    for name in ("u", "v", "x", "y", "z"):
        assert "Right." not in shown(placing._verdict)
        fields[name].field.value = repr(getattr(placing.task.model.b, name))
    assert "Right." in shown(placing._verdict)
    assert shown(placing.box._conditions).count("holds") == 2


@pytest.mark.parametrize("made", PLACES, ids=lambda e: e.key)
def test_a_wrong_position_hears_its_name_while_it_is_there(made: Exercise, store: Store) -> None:
    card = exercise(made.key, store=store)
    for slip in card.task.slips:
        card.box.slate.load(slip.example, "test")
        assert slip.name in shown(card._verdict)
        card.box.figure.history.undo.click()
        assert shown(card._verdict) == ""
    assert store.record(made.key).get("right") is None  # seen on the way, not given as an answer
    card.close()


def test_two_lines_that_are_being_worked_on_are_kept(store: Store) -> None:
    card = exercise("02.12", store=store)
    pull(card, 2, (40, 25))
    reached = card.box.slate.value
    assert reached != card.task.start
    card.close()  # before the pause is over
    again = exercise("02.12", store=Store(store.path))
    assert again.box.slate.value == reached
    assert "off by" in shown(again)
    assert "Not yet." not in shown(again)
    assert store.record("02.12")["right"] is False
    again.close()


def test_undo_leads_back_from_two_lines_shown_as_the_solution(placing: Card, store: Store) -> None:
    pull(placing, 2, (40, 25))
    reached = placing.box.slate.value
    placing._solve.click()
    assert placing.box.slate.value == placing.task.model
    assert store.record("02.12")["right"] is False
    placing.box.figure.history.undo.click()
    assert placing.box.slate.value == reached


DAMAGED: dict[str, Any] = {
    "a design": "ruledlab1:abc",
    "names": {"a": [0, 0, 0, 0, 0]},
    "one line": [[0, 0, 0, 0, 0]],
    "a number short": [[0, 0, 0, 0], [0, 0, 0, 0, 0]],
    "no number": [[0, 0, 0, 0, 0], [0, 0, 0, 0, None]],
    "true": [[0, 0, 0, 0, 0], [0, 0, 0, 0, True]],
    "huge": [[0, 0, 0, 0, 0], [0, 0, 0, 0, 10**400]],
    "no colatitude": [[0, 0, 0, 0, 0], [0, 4, 0, 0, 0]],
}


@pytest.mark.parametrize("kept", DAMAGED.values(), ids=DAMAGED)
def test_damaged_numbers_of_two_lines_are_passed_over(kept: Any, store: Store) -> None:
    path = store.path
    store.update("02.12", answer=1.5, right=False, seed="")
    path.write_text(path.read_text().replace("1.5", json.dumps(kept)))
    card = exercise("02.12", store=Store(path))
    assert card.box.slate.value == card.task.start
    assert shown(card._verdict) == ""
    assert card.task.judge(kept).state == "unread"
    card.close()


def test_a_lesson_makes_a_picture_of_space_only_for_the_card_that_is_opened(store: Store) -> None:
    def spaces() -> int:
        return sum(type(widget).__name__ == "Renderer" for widget in _instances.values())

    before = spaces()
    whole = exercises("02", store)
    assert spaces() == before
    whole._buttons["02.12"].click()
    assert spaces() == before + 1
    whole.close()
    assert spaces() == before


# -- the other kinds -------------------------------------------------------------------------------


def test_a_solution_shown_in_the_chart_is_no_answer(store: Store) -> None:
    card = exercise("06.8", store=store)
    card._solve.click()
    assert card.box.lab.design == card.task.model
    assert store.record("06.8")["right"] is False
    card.close()
    assert store.record("06.8")["right"] is False


def test_a_lab_of_the_lesson_can_be_used(store: Store) -> None:
    task = lesson("06")[7].task()
    lab = Lab(task.start)
    card = exercise("06.8", lab=lab, store=store)
    assert lab.load(task.model, "somewhere else")
    assert "Right." in shown(card)
    card.close()
    assert not lab._followers


def test_a_sketch_is_compared_revealed_and_drawn_again(store: Store) -> None:
    card = exercise("06.10", store=store)
    front = fronts(card)[0]
    assert front.truth == []
    say(front, sketch=[None] * 65)
    assert front.truth == []  # nothing is given away for nothing
    say(front, sketch=card.task.wrong_answer())
    assert len(front.truth) == 65
    assert "Shape: " in shown(card)
    say(front, again=True)
    assert front.truth == []
    assert "Shape: " not in shown(card)
    card.close()


def test_the_second_question_of_a_slip_waits_for_the_first(store: Store) -> None:
    card = exercise("06.15", store=store)
    question = card.task.then.question
    assert question not in shown(card)
    say(fronts(card)[0], chosen=0)
    assert question not in shown(card)
    say(fronts(card)[0], chosen=2)
    assert question in shown(card)
    assert store.record("06.15")["right"] is False
    card.close()


def test_code_is_answered_in_a_cell_and_the_card_follows(store: Store) -> None:
    card = exercise("06.12", store=store)
    assert "replace the dots" in shown(card)
    check("06.12", [1.0, 2.0], store)
    assert "Not yet." in shown(card)
    assert "[1.0, 2.0]" in shown(card)
    check("06.12", card.task.answer, store)
    assert "✓ done" in shown(card)
    card.close()


def test_another_seed_gives_other_values_and_begins_anew(store: Store) -> None:
    card = exercise("06.3", store=store)
    play(card, card.task.right_answer())
    questions = {card.task.question}
    for seed in range(6):
        store.set_seed(seed)
        questions.add(card.task.question)
        assert card.task.question in shown(card)
        assert "done" not in shown(card)
    assert len(questions) > 1
    store.set_seed("")
    assert "✓ done" in shown(card)
    assert len([c for c in card.children if "<style>" in str(getattr(c, "value", ""))]) == 1
    card.close()


UNFIT = {
    "choose": 99,
    "number": "banana",
    "formula": {"a": 1},
    "drag": "banana",
    "place": [["banana"] * 5, [0, 0, 0, 0, 1e9]],
    "sketch": ["a"] * 65,
    "code": [[1, 2], [3]],
    "slip": {"line": [], "then": 5},
}


@ALL
def test_an_answer_that_does_not_fit_is_passed_over(made: Exercise, store: Store) -> None:
    store.update(made.key, answer=UNFIT[made.task().kind], right=True, seed="", hints=99)
    card = exercise(made.key, store=store)
    text = shown(card)
    assert "✓ done" in text
    assert "banana" not in text
    assert "alert" not in text
    assert card._more.description == "No more hints"
    assert all(getattr(front, "sketch", []) == [] for front in fronts(card))
    assert card._group.defect.value == ""
    card.close()


def test_two_open_notebooks_do_not_undo_each_other(store: Store) -> None:
    other = Store(store.path)
    here, there = exercise("06.3", store=store), exercise("06.3", store=other)
    here._more.click()
    here._more.click()
    play(here, here.task.right_answer())
    there._more.click()  # it has not read the file since
    there._solve.click()
    record = Store(store.path).record("06.3")
    assert (record["hints"], record["right"], record["solution"]) == (3, True, False)
    assert "✓ done with 3 hints" in shown(there)
    here.close()
    there.close()


def test_a_field_shows_what_an_answer_looks_like(store: Store) -> None:
    for key, example in (
        ("06.3", "such as 2.5 or 3π/8"),
        ("06.4", "[…, …, …]"),
        ("06.6", "a formula in t"),
        ("06.7", "a formula in u and v"),
    ):
        card = exercise(key, store=store)
        assert fronts(card)[0].example == example
        card.close()


def test_a_note_of_the_store_is_shown(tmp_path: Path) -> None:
    (tmp_path / "p.json").write_text("damaged")
    card = exercise("06.1", store=Store(tmp_path / "p.json"))
    assert "set aside as p.damaged-1.json" in shown(card)
    card.close()


def test_a_lesson_opens_at_the_first_that_is_not_done(store: Store) -> None:
    check("06.1", 1, store)
    whole = exercises("06", store)
    assert whole.card.exercise.key == "06.2"
    assert "1 of 15 done" in shown(whole)
    whole._buttons["06.9"].click()
    assert whole.card.exercise.key == "06.9"
    check("06.2", 0, store)
    assert "2 of 15 done" in shown(whole)
    assert whole._buttons["06.2"].description == "✓ 2"
    whole.close()
    whole.close()
    assert store._followers == []


def test_progress_follows_what_is_answered(store: Store) -> None:
    table = progress(store)
    assert "0 of 15" in shown(table)
    check("06.1", 1, store)
    assert "1 of 15" in shown(table)
    table.close()


@pytest.mark.parametrize("answer", ["no", 1])
def test_predict_reveals_the_reason_whatever_is_chosen(answer: Any) -> None:
    asked = predict("Will it?", ["yes", "no"], answer, "because")
    assert "because" not in shown(asked)
    say(fronts(asked)[0], chosen=0)
    assert "because" in shown(asked)
    assert "A surprise" in shown(asked)
    say(fronts(asked)[0], chosen=1)
    assert "As you said." in shown(asked)
    asked.close()


def test_predict_refuses_an_answer_that_is_no_option() -> None:
    with pytest.raises(ValueError, match="must be one of"):
        predict("?", ["a", "b"], "c", "d")
    with pytest.raises(ValueError, match="must be one of"):
        predict("?", ["a", "b"], 2, "d")


def test_running_a_cell_again_closes_the_old_widget(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    closers: list[Any] = []
    monkeypatch.setattr(widgets_module, "closes_with_cell", closers.append)
    made = [exercise("06.1", store=store), exercises("06", store), progress(store)]
    made.append(predict("?", ["a", "b"], 0, "c"))
    assert len(closers) == len(made)
    for close in closers:
        close()
    assert store._followers == []


def test_a_defect_is_shown_and_not_lost(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    card = exercise("06.1", store=store)
    monkeypatch.setattr(type(card.task), "judge", lambda *_: 1 / 0)
    say(fronts(card)[0], chosen=0)
    assert "ZeroDivisionError" in shown(card)
    card.close()


def test_every_card_carries_its_style_once(store: Store) -> None:
    for made in (exercise("06.1", store=store), exercises("06", store)):
        styles = [c for c in made.children if isinstance(c, w.HTML) and "<style>" in c.value]
        assert len(styles) == 1
        made.close()
