"""The file of answers: whole or old after a crash, merged, set aside when damaged, restored."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ruledlab.exercises import store as store_module
from ruledlab.exercises.store import FILE, Store

GOOD = '{"format": "ruledlab progress", "version": 1, "seed": "", "seed_when": 0, "exercises": {}}'
DAMAGED = {
    "cut off": GOOD[:-5],
    "empty": "",
    "no JSON": "hello",
    "binary": "\x00\x01",
    "other JSON": '{"cells": []}',
    "a list": "[1, 2]",
    "newer": GOOD.replace('"version": 1', '"version": 2'),
    "bad record": GOOD.replace("{}", '{"06.1": 3}'),
    "record without time": GOOD.replace("{}", '{"06.1": {"answer": 1}}'),
    "deep": "[" * 100_000,
    "seed of a wrong type": GOOD.replace('"seed": ""', '"seed": 3'),
}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / FILE


def content(path: Path) -> dict[str, dict[str, object]]:
    return dict(json.loads(path.read_text(encoding="utf-8"))["exercises"])


def names(path: Path) -> list[str]:
    return sorted(p.name for p in path.parent.iterdir() if not p.name.endswith(".lock"))


def test_nothing_is_written_before_there_is_something_to_keep(path: Path) -> None:
    Store(path)
    assert names(path) == []


def test_answers_come_back_after_a_restart(path: Path) -> None:
    first = Store(path)
    first.set_seed("Ada")
    first.update("06.1", answer={"line": 2, "then": "κ̄"}, right=True, hints=2)
    again = Store(path)
    record = again.record("06.1")
    assert record.pop("when") > 0
    assert record == {"answer": {"line": 2, "then": "κ̄"}, "right": True, "hints": 2}
    assert again.seed == "Ada"
    assert names(path) == [FILE]


def test_a_record_that_is_handed_out_changes_nothing(path: Path) -> None:
    store = Store(path)
    store.update("06.1", answer="1")
    store.record("06.1")["answer"] = "2"
    assert store.record("06.1")["answer"] == "1"


# -- crashes ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("step", ["fsync", "replace", "chmod"])
def test_a_crash_leaves_the_old_file_and_no_rubbish(
    path: Path, step: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(path)
    store.update("06.1", answer="old")
    before = path.read_bytes()

    def crash(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(store_module.os, step, crash)
    with pytest.raises(KeyboardInterrupt):
        store.update("06.1", answer="new")
    monkeypatch.undo()
    assert path.read_bytes() == before
    assert names(path) == [FILE]


def test_a_killed_writer_leaves_a_whole_file(path: Path) -> None:
    code = (
        "import sys; from ruledlab.exercises.store import Store\n"
        f"store = Store({str(path)!r})\nprint('ready', flush=True)\n"
        "for n in range(10**6): store.update('06.1', answer='x' * 20000, n=n)"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) as writer:
        assert writer.stdout is not None
        writer.stdout.readline()
        while not path.exists() or content(path)["06.1"]["n"] < 20:
            pass
        writer.kill()
    store = Store(path)
    assert store.note == ""
    assert store.record("06.1")["answer"] == "x" * 20000
    store.update("06.2", answer="after")  # the dead one's lock is gone
    assert set(content(path)) == {"06.1", "06.2"}


# -- damage ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_file_is_set_aside_and_the_reader_told(path: Path, name: str) -> None:
    path.write_text(DAMAGED[name], encoding="utf-8")
    store = Store(path)
    aside = path.with_name("ruledlab-progress.damaged-1.json")
    assert aside.read_text(encoding="utf-8") == DAMAGED[name]
    assert "set aside as ruledlab-progress.damaged-1.json" in store.note
    store.update("06.1", answer="1")
    assert content(path)["06.1"]["answer"] == "1"
    assert aside.read_text(encoding="utf-8") == DAMAGED[name]


def test_damaged_files_never_overwrite_each_other(path: Path) -> None:
    for n in (1, 2, 3):
        path.write_text(f"damage {n}", encoding="utf-8")
        Store(path)
    for n in (1, 2, 3):
        aside = path.with_name(f"ruledlab-progress.damaged-{n}.json")
        assert aside.read_text(encoding="utf-8") == f"damage {n}"


def test_damage_that_comes_later_loses_no_answer(path: Path) -> None:
    store = Store(path)
    store.update("06.1", answer="1")
    path.write_text("{", encoding="utf-8")
    store.update("06.2", answer="2")
    assert set(content(path)) == {"06.1", "06.2"}
    assert "damaged-1" in store.note


@settings(max_examples=60)
@given(st.binary(max_size=200))
def test_any_bytes_are_kept_somewhere(
    tmp_path_factory: pytest.TempPathFactory, data: bytes
) -> None:
    path = tmp_path_factory.mktemp("any") / FILE
    path.write_bytes(data)
    store = Store(path)
    store.update("06.1", answer="1")
    assert path.with_name("ruledlab-progress.damaged-1.json").read_bytes() == data
    assert content(path)["06.1"]["answer"] == "1"


# -- two at once -----------------------------------------------------------------------------------


def test_two_notebooks_do_not_lose_each_others_answers(path: Path) -> None:
    one, two = Store(path), Store(path)
    one.update("06.1", answer="one")
    two.update("06.2", answer="two")
    one.update("06.3", answer="three")
    assert set(content(path)) == {"06.1", "06.2", "06.3"}
    assert one.record("06.2")["answer"] == "two"
    two.refresh()
    assert two.record("06.3")["answer"] == "three"


def test_the_newer_answer_wins(path: Path) -> None:
    one, two = Store(path), Store(path)
    one.update("06.1", answer="early")
    two.update("06.1", answer="late")
    one.update("06.2", answer="other")
    assert content(path)["06.1"]["answer"] == "late"
    assert one.record("06.1")["answer"] == "late"


def test_a_clock_that_stands_still_does_not_lose_the_second_answer(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(store_module.time, "time", lambda: 1000.0)
    store = Store(path)
    for answer in ("a", "b", "c"):
        store.update("06.1", answer=answer)
    assert Store(path).record("06.1")["answer"] == "c"


def test_writers_in_many_processes_and_threads(path: Path) -> None:
    code = (
        "import sys; from ruledlab.exercises.store import Store\n"
        f"store = Store({str(path)!r})\n"
        "for n in range(15): store.update(f'{sys.argv[1]}.{n}', answer=n)"
    )
    writers = [subprocess.Popen([sys.executable, "-c", code, f"1{k}"]) for k in range(2)]
    store = Store(path)

    def work(k: int) -> None:
        for n in range(15):
            store.update(f"2{k}.{n}", answer=n)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [writer.wait(60) for writer in writers] == [0, 0]
    assert set(content(path)) == {f"{k}.{n}" for k in (10, 11, 20, 21) for n in range(15)}
    assert names(path) == [FILE]


# -- where one cannot write ------------------------------------------------------------------------


@pytest.fixture
def unwritable(tmp_path: Path) -> Iterator[Path]:
    folder = tmp_path / "file, not a folder"
    folder.write_text("")
    yield folder / FILE


def test_without_a_place_to_write_it_works_and_says_so(unwritable: Path) -> None:
    store = Store(unwritable)
    store.update("06.1", answer="1")
    assert store.record("06.1")["answer"] == "1"
    assert "not saved" in store.note
    assert "\n" not in store.note


def test_answers_are_saved_once_it_is_possible_again(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(path)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(store_module.os, "replace", full)
    store.update("06.1", answer="1")
    assert "no space left" in store.note
    monkeypatch.undo()
    store.update("06.2", answer="2")
    assert store.note == ""
    assert set(content(path)) == {"06.1", "06.2"}


def test_a_file_that_cannot_be_read_is_not_replaced(path: Path) -> None:
    path.mkdir()  # reading a folder fails for every user, root too
    store = Store(path)
    store.update("06.1", answer="1")
    assert "cannot be" in store.note
    assert path.is_dir()
    assert store.record("06.1")["answer"] == "1"


def test_a_lock_that_is_held_too_long_is_said(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store_module, "PATIENCE", 0.05)
    store = Store(path)
    with store_module._lock(path.with_name(f".{FILE}.lock")):
        store.update("06.1", answer="1")
    assert "too long" in store.note
    store.update("06.2", answer="2")
    assert set(content(path)) == {"06.1", "06.2"}


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_a_link_stays_a_link(path: Path, tmp_path: Path) -> None:
    real = tmp_path / "elsewhere.json"
    real.write_text(GOOD)
    path.symlink_to(real)
    Store(path).update("06.1", answer="1")
    assert path.is_symlink()
    assert set(content(real)) == {"06.1"}


def test_followers_hear_of_changes_until_they_leave(path: Path) -> None:
    store, heard = Store(path), []
    leave = store.follow(heard.append)
    store.update("06.1", answer="1")
    store.set_seed("7")
    leave()
    leave()
    store.update("06.2", answer="1")
    assert heard == ["06.1", ""]
