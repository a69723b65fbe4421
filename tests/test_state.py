"""`Lab`: one recompute and one notification per change, history as a model says, many threads."""

from __future__ import annotations

import contextlib
import math
import sys
import threading

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from ruledlab.design import Design
from ruledlab.geometry.checks import GeometryError
from ruledlab.geometry.curve import seam
from ruledlab.lab import slate, state
from ruledlab.lab.slate import Change
from ruledlab.lab.state import Lab

OPEN = Design(((0.3, 0.8), (1.0, 1.4), (1.9, 1.1)), "u - v", "u + v", samples=8)
LOOP = OPEN.with_(
    points=((0.4, 0.8), (0.4, 1.2), (1.2, 1.2), (1.2, 0.8), (1.2, 0.4), (0.4, 0.4), (0.4, 0.8)),
    closing="C1",
)
OTHERS = (OPEN, LOOP, OPEN.with_(ubar="0", vbar="1", name="other"), LOOP.with_(base="foot"))


@pytest.fixture
def heard():
    return []


@pytest.fixture
def lab(heard):
    lab = Lab(OPEN, cursor=0.25)
    lab.follow(heard.append)
    return lab


@pytest.fixture
def computed(monkeypatch):
    """Count how often everything that follows from a design is computed."""
    calls = []
    compute = state.compute
    monkeypatch.setattr(state, "compute", lambda *args: calls.append(args) or compute(*args))
    return calls


# ---- one change, one computation, one notification ----------------------------------------------


CHANGES = {
    "edit": lambda lab: lab.edit("x", length=3.0),
    "several entries": lambda lab: lab.edit("x", ubar="u", vbar="v", length=1.0, samples=9),
    "attempt": lambda lab: lab.attempt("x", lambda: LOOP),
    "load": lambda lab: lab.load(LOOP, "x"),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_change_is_computed_once_and_told_once(lab, heard, computed, change):
    change(lab)
    assert len(computed) == 1
    assert len(heard) == 1
    assert (heard[0].scene, heard[0].mark, heard[0].error, heard[0].source) == (
        True,
        True,
        None,
        "x",
    )
    heard.clear()
    for travel in (lab.undo, lab.redo, lab.reset):
        travel()
        assert len(heard) == 1
        heard.clear()
    assert len(computed) == 4


@pytest.mark.parametrize("change", [*list(CHANGES.values())[:2], lambda lab: lab.load(OPEN, "x")])
def test_a_follower_finds_everything_in_place(change):
    lab = Lab(OPEN)
    seen = []
    lab.follow(lambda _: seen.append((lab.result.design, lab.result.scene.control, lab.mark.t)))
    change(lab)
    design, control, t = seen[0]
    assert design == lab.design
    assert np.array_equal(control, np.array(lab.design.points))
    assert t == lab.cursor


def test_no_change_is_no_step_but_the_control_hears_of_it(lab, heard, computed):
    result = lab.result
    assert lab.edit("x", length=OPEN.length)
    assert heard == [Change(source="x")]
    assert (lab.result is result, computed, lab.can_undo) == (True, [], False)


def test_undo_and_redo_at_the_ends_do_nothing(lab, heard):
    lab.undo()
    lab.redo()
    assert (heard, lab.design) == ([], OPEN)


def test_only_loads_ask_for_another_point_of_view(lab, heard):
    lab.edit("x", length=3.0)
    lab.load(LOOP, "gallery")
    for travel in (lab.undo, lab.undo, lab.redo, lab.redo, lab.reset):
        travel()
    assert [change.loaded for change in heard] == [False, True, True, False, False, True, True]


# ---- errors -------------------------------------------------------------------------------------


BAD = {
    "formula": lambda lab: lab.edit("x", ubar="u +"),
    "closing": lambda lab: lab.edit("x", closing="C2"),
    "number": lambda lab: lab.edit("x", length=math.nan),
    "make": lambda lab: lab.attempt("x", lambda: OPEN.closed_with("C2")),
}


@pytest.mark.parametrize("bad", BAD.values(), ids=BAD)
def test_an_error_keeps_the_last_good_result_and_names_the_source(lab, heard, bad):
    lab.edit("y", length=3.0)
    lab.edit("y", length=4.0)
    lab.undo()
    before = (lab.design, lab.result, lab.mark, lab.can_undo, lab.can_redo)
    heard.clear()
    assert bad(lab) is False
    assert (lab.design, lab.result, lab.mark, lab.can_undo, lab.can_redo) == before
    (change,) = heard
    assert change.source == "x"
    assert "`" in change.error
    assert "\n" not in change.error
    assert not (change.scene or change.mark or change.chosen or change.loaded)
    assert lab.edit("x", length=2.5) is True
    assert heard[-1].error is None


def test_a_surface_that_cannot_be_is_refused_as_well(lab, heard, monkeypatch):
    def refuse(*_):
        raise GeometryError("`points` cannot be")

    monkeypatch.setattr(state, "compute", refuse)
    assert not lab.load(LOOP, "file")
    assert heard == [Change(error="`points` cannot be", source="file")]
    assert lab.design == OPEN


def test_a_defect_is_not_caught_and_changes_nothing(lab, heard, monkeypatch):
    lab.edit("x", length=3.0)

    def fail(*_):
        raise ZeroDivisionError

    monkeypatch.setattr(state, "compute", fail)
    for change in (lambda: lab.edit("x", length=4.0), lambda: lab.load(LOOP, "x"), lab.undo):
        with pytest.raises(ZeroDivisionError):
            change()
        assert (lab.design.length, lab.can_undo, lab.can_redo) == (3.0, True, False)
    monkeypatch.undo()
    lab.undo()
    assert lab.design == OPEN


@pytest.mark.parametrize("error", [GeometryError("of the view"), KeyError("defect")])
def test_what_a_follower_raises_is_not_taken_for_a_bad_design(lab, heard, error):
    def broken(change):
        raise error

    lab.follow(broken)
    with pytest.raises(type(error)):
        lab.edit("x", length=3.0)
    assert lab.design.length == 3.0
    assert all(change.error is None for change in heard)


# ---- history ------------------------------------------------------------------------------------


def test_a_group_is_one_step(lab):
    for length in (3.0, 4.0, 5.0):
        lab.edit("x", group=("drag", 1), length=length)
    lab.undo()
    assert lab.design == OPEN
    lab.redo()
    assert lab.design.length == 5.0


SEALS = {
    "seal": lambda lab: lab.seal(),
    "another group": lambda lab: lab.edit("x", group="other", samples=9),
    "no group": lambda lab: lab.edit("x", samples=9),
    "load": lambda lab: lab.load(LOOP, "x"),
    "undo and redo": lambda lab: (lab.undo(), lab.redo()),
}


@pytest.mark.parametrize("seal", SEALS.values(), ids=SEALS)
def test_a_group_ends(lab, seal):
    lab.edit("x", group="g", length=3.0)
    seal(lab)
    between = lab.design
    lab.edit("x", group="g", length=5.0)
    lab.undo()
    assert lab.design == between


def test_an_error_does_not_end_a_group(lab):
    lab.edit("x", group="g", length=3.0)
    lab.edit("x", group="g", length=-1.0)
    lab.edit("x", group="g", length=4.0)
    lab.undo()
    assert lab.design == OPEN


def test_a_new_edit_clears_redo_and_an_error_does_not(lab):
    lab.edit("x", length=3.0)
    lab.undo()
    lab.edit("x", length=-1.0)
    assert lab.can_redo
    lab.edit("x", length=4.0)
    assert not lab.can_redo


def test_history_is_bounded(lab, monkeypatch):
    monkeypatch.setattr(slate, "MOST_STEPS", 3)
    for length in (3.0, 4.0, 5.0, 6.0, 7.0):
        lab.edit("x", length=length)
    for _ in range(9):
        lab.undo()
    assert lab.design.length == 4.0


class LabMachine(RuleBasedStateMachine):
    """A lab beside a list of designs and a place in it."""

    @initialize(design=st.sampled_from(OTHERS), cursor=st.floats(-1.0, 2.0))
    def start(self, design, cursor):
        self.lab = Lab(design, cursor)
        self.heard = []
        self.lab.follow(self.heard.append)
        self.first = design
        self.line, self.at, self.group = [design], 0, None
        self.chosen, self.cursor, self.colouring = 0, min(max(cursor, 0.0), 1.0), "plain"

    def go(self, design, group=None):
        """Do in the model what an edit does."""
        if design == self.line[self.at]:
            return
        if group is None or group != self.group:
            self.at += 1
        self.line[self.at :] = [design]
        self.group = group
        self.arrive()

    def arrive(self):
        self.chosen = min(self.chosen, len(self.line[self.at].points) - 1)

    def one(self, **wanted):
        (change,) = self.heard
        assert {name: getattr(change, name) for name in wanted} == wanted
        self.heard.clear()

    @rule(
        length=st.integers(1, 3),
        ubar=st.sampled_from(["u", "0", "u - v"]),
        group=st.sampled_from([None, None, "a", "b"]),
    )
    def edit(self, length, ubar, group):
        new = self.line[self.at].with_(length=float(length), ubar=ubar)
        assert self.lab.edit("s", group, length=float(length), ubar=ubar)
        self.one(source="s", error=None, scene=new != self.line[self.at], loaded=False)
        self.go(new, group)

    @rule(bad=st.sampled_from(list(BAD.values())))
    def fail(self, bad):
        if bad is BAD["closing"] and seam(self.line[self.at].points).order == 2:
            return  # these points do close so
        assert not bad(self.lab)
        self.one(source="x", scene=False, loaded=False)

    @rule(closing=st.sampled_from(["open", "C0", "C1", "C2"]))
    def close(self, closing):
        try:
            new = self.line[self.at].closed_with(closing)
        except GeometryError:
            new = None
        done = self.lab.attempt("c", lambda: self.lab.design.closed_with(closing))
        assert done == (new is not None)
        self.heard.clear()
        if new is not None:
            self.go(new)

    @rule(design=st.sampled_from(OTHERS))
    def load(self, design):
        changed = design != self.line[self.at]
        assert self.lab.load(design, "l")
        self.one(source="l", loaded=changed)
        self.go(design)

    @rule()
    def undo(self):
        self.lab.undo()
        self.travelled(-1)

    @rule()
    def redo(self):
        self.lab.redo()
        self.travelled(1)

    def travelled(self, step):
        if 0 <= self.at + step < len(self.line):
            self.at += step
            self.group = None
            self.arrive()
            self.one(scene=True, error=None)

    @rule()
    def reset(self):
        self.lab.reset()
        self.heard.clear()
        self.go(self.first)

    @rule()
    def seal(self):
        self.lab.seal()
        self.group = None

    @rule(index=st.integers(-2, 9))
    def choose(self, index):
        self.lab.choose(index)
        index = min(max(index, 0), len(self.line[self.at].points) - 1)
        if index != self.chosen:
            self.one(chosen=True, scene=False)
        self.chosen = index

    @rule(t=st.floats(allow_nan=False))
    def move_cursor(self, t):
        self.lab.move_cursor(t)
        t = min(max(t, 0.0), 1.0)
        if t != self.cursor:
            self.one(mark=True, scene=False)
        self.cursor = t

    @rule(colouring=st.sampled_from(["plain", "delta", "gauss", "mean"]))
    def colour(self, colouring):
        self.lab.colour(colouring)
        self.colouring = colouring
        self.one(scene=True)

    @invariant()
    def agrees(self):
        lab, design = self.lab, self.line[self.at]
        assert self.heard == []
        assert lab.design == design
        assert (lab.can_undo, lab.can_redo) == (self.at > 0, self.at + 1 < len(self.line))
        assert (lab.chosen, lab.cursor, lab.mark.t) == (self.chosen, self.cursor, self.cursor)
        scene = lab.result.scene
        assert np.array_equal(scene.control, np.array(design.points))
        assert scene.w[1] - scene.w[0] == pytest.approx(design.length)
        assert lab.colouring == self.colouring
        assert (scene.colour is None) == (self.colouring == "plain")
        assert np.allclose(lab.mark.chart, lab.result.surface.curve(self.cursor), atol=1e-12)

    def teardown(self):
        """Undo leads back through every design, redo forth again."""
        if not hasattr(self, "lab"):
            return
        walk = self.lab
        back = [walk.design]
        while walk.can_undo:
            walk.undo()
            back.append(walk.design)
        assert back == self.line[self.at :: -1]
        while walk.can_redo:
            walk.redo()
        assert walk.design == self.line[-1]


TestLabMachine = LabMachine.TestCase
TestLabMachine.settings = settings(max_examples=10, stateful_step_count=20, deadline=None)


# ---- followers ----------------------------------------------------------------------------------


def test_a_follower_disconnects_and_only_that_one(lab):
    calls = []
    first, second = lab.follow(calls.append), lab.follow(calls.append)
    lab.edit("x", length=3.0)
    assert len(calls) == 2
    first()
    first()
    lab.edit("x", length=4.0)
    assert len(calls) == 3
    second()
    lab.edit("x", length=5.0)
    assert len(calls) == 3


def test_a_follower_that_is_ended_by_another_hears_no_more(lab):
    calls = []
    lab.follow(lambda _: end())
    end = lab.follow(calls.append)
    lab.edit("x", length=3.0)
    assert calls == []


def test_two_labs_are_independent(lab, heard):
    other, told = Lab(OPEN), []
    other.follow(told.append)
    lab.edit("x", length=3.0)
    lab.move_cursor(0.7)
    lab.choose(1)
    lab.colour("gauss")
    assert told == []
    assert (other.design, other.cursor, other.chosen, other.colouring) == (OPEN, 0.0, 0, "plain")
    assert not other.can_undo


# ---- cursor, colours, choice --------------------------------------------------------------------


@pytest.mark.parametrize(("t", "kept"), [(-1, 0.0), (2, 1.0), (math.inf, 1.0), (-math.inf, 0.0)])
def test_the_cursor_stays_in_the_domain(lab, t, kept):
    lab.move_cursor(t)
    assert (lab.cursor, lab.mark.t, Lab(OPEN, cursor=t).cursor) == (kept, kept, kept)


def test_a_cursor_that_is_no_number_is_refused_and_spoils_nothing(lab, heard):
    with pytest.raises(GeometryError, match="NaN"):
        lab.move_cursor(math.nan)
    with pytest.raises(GeometryError, match="NaN"):
        Lab(OPEN, cursor=math.nan)
    assert (lab.cursor, lab.mark.t, heard) == (0.25, 0.25, [])
    assert lab.edit("x", length=3.0)


def test_the_colouring_is_kept_over_edits(lab):
    lab.colour("gauss")
    lab.edit("x", length=3.0)
    assert lab.result.scene.colour.shape[0] == OPEN.samples
    assert "K" in lab.result.scene.colour_label
    lab.undo()
    assert (lab.colouring, "K" in lab.result.scene.colour_label) == ("gauss", True)
    assert lab.can_redo, "colouring is no step of undo"


def test_an_unknown_colouring_is_refused(lab, heard):
    with pytest.raises(GeometryError, match=r"`colouring`.*got 'red'"):
        lab.colour("red")
    assert (lab.colouring, heard) == ("plain", [])


def test_the_chosen_point_exists_after_any_change(lab, heard):
    lab.load(LOOP, "x")
    lab.choose(6)
    heard.clear()
    lab.undo()
    assert (lab.chosen, heard[0].chosen) == (2, True)


# ---- pitch --------------------------------------------------------------------------------------


def test_the_pitch_of_a_closed_surface():
    lab = Lab(Design(((0.0, np.pi / 4), (2 * np.pi, np.pi / 4)), "0", "1", "C2", samples=8))
    pitch = lab.result.pitch
    assert (float(pitch.real), float(pitch.dual)) == pytest.approx(
        (-np.sqrt(2) * np.pi, np.sqrt(2) * np.pi)
    )


NO_PITCH = {
    "does not close": (OPEN, "not closed"),
    "climbs": (Design(((0, 1), (2 * np.pi, 1)), "0.5*u", "0", "C2", samples=8), "line moves by"),
    "closes reversed": (
        Design(((0, np.pi / 2), (np.pi, np.pi / 2)), "0", "2*cos(u)", samples=8),
        "reversed (a Möbius closing)",
    ),
    "one point": (Design(((1, 1), (1, 1)), "0", "0", "C0", samples=8), "does not converge"),
    "outside the formula": (LOOP.with_(ubar="sqrt(u - 0.7)"), "undefined at t = 0"),
    "a pole within": (LOOP.with_(ubar="1/(u - 0.8)"), "does not converge"),
}


@pytest.mark.parametrize(("design", "words"), NO_PITCH.values(), ids=NO_PITCH)
def test_where_there_is_no_pitch_the_note_says_why(design, words):
    result = Lab(design).result
    assert result.pitch is None
    assert words in result.pitch_note
    assert "\n" not in result.pitch_note
    assert result.pitch_note.startswith(("not closed", "closes with")), "follows 'The surface'"


# ---- threads ------------------------------------------------------------------------------------


@contextlib.contextmanager
def impatient():
    """Let threads take turns as often as they can."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        yield
    finally:
        sys.setswitchinterval(interval)


def together(*actions):
    """Run the actions in threads of their own; return what was raised."""
    raised, gate = [], threading.Barrier(len(actions))

    def run(action):
        gate.wait()
        try:
            action()
        except BaseException as error:
            raised.append(error)

    threads = [threading.Thread(target=run, args=(action,)) for action in actions]
    with impatient():
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
    return raised


def steps(lab):
    """Return how often one can undo, to the very first design."""
    count = 0
    while lab.can_undo:
        lab.undo()
        count += 1
    return count


def test_no_edit_of_several_threads_is_lost():
    lab, torn = Lab(OPEN), []

    def watch(_):
        scene, design = lab.result.scene, lab.design
        if scene.w[1] * 2 != design.length or lab.mark.t != lab.cursor:
            torn.append(design)

    lab.follow(watch)

    def edit(number):
        for k in range(10):
            assert lab.edit(f"thread {number}", length=1.0 + number + k / 64)

    raised = together(*(lambda n=n: edit(n) for n in range(4)))
    assert (raised, torn) == ([], [])
    assert (steps(lab), lab.design) == (40, OPEN)


def test_history_cursor_and_edits_at_once():
    lab = Lab(OPEN)

    def edit():
        for k in range(25):
            lab.edit("edit", length=3.0 + k)

    def travel():
        for _ in range(25):
            lab.undo()
            lab.redo()

    def look():
        for k in range(25):
            lab.move_cursor(k / 25)
            lab.choose(k % 3)
            lab.colour(("plain", "gauss")[k % 2])

    assert together(edit, travel, look, travel) == []
    # Latest wins: the last edit is there, or was undone and can be redone.
    while lab.can_redo:
        lab.redo()
    assert lab.design.length == 27.0
    assert lab.result.scene.w[1] * 2 == lab.design.length
    assert lab.mark.t == lab.cursor == 24 / 25
    lengths = [lab.design.length]
    while lab.can_undo:
        lab.undo()
        lengths.append(lab.design.length)
    assert lengths[-1] == OPEN.length
    assert lengths == sorted(set(lengths), reverse=True), "each step once, in order"


def test_followers_come_and_go_while_others_edit():
    lab = Lab(OPEN)
    calls = []

    def join():
        for _ in range(200):
            lab.follow(calls.append)()

    assert together(join, join, lambda: [lab.edit("x", length=2.0 + k) for k in range(20)]) == []
    calls.clear()
    lab.edit("x", length=50.0)
    assert calls == []
