"""The file of answers: whole or old after a crash, merged, set aside when damaged, restored."""

from __future__ import annotations

import json
import math
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
from ruledlab.geometry import GeometryError

GOOD = '{"format": "ruledlab progress", "version": 1, "seed": "", "seed_when": 0, "exercises": {}}'
DAMAGED = {
    "cut off": GOOD[:-5],
    "empty": "",
    "no JSON": "hello",
    "binary": "\x00\x01",
    "other JSON": '{"cells": []}',
    "a list": "[1, 2]",
    "older": GOOD.replace('"version": 1', '"version": 0'),
    "no version": GOOD.replace('"version": 1, ', ""),
    "hints in words": GOOD.replace("{}", '{"06.1": {"when": 1, "hints": "two"}}'),
    "no number of tries": GOOD.replace("{}", '{"06.1": {"when": 1, "tries": null}}'),
    "a number for a word": GOOD.replace("{}", '{"06.1": {"when": 1, "slip": 2}}'),
    "a word for yes": GOOD.replace("{}", '{"06.1": {"when": 1, "right": "yes"}}'),
    "a time that never comes": GOOD.replace("{}", '{"06.1": {"when": 1e300}}'),
    "a time that is none": GOOD.replace("{}", '{"06.1": {"when": NaN}}'),
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


def test_a_file_of_a_newer_version_is_set_aside_as_such(path: Path) -> None:
    newer = GOOD.replace('"version": 1', '"version": 2')
    path.write_text(newer, encoding="utf-8")
    store = Store(path)
    store.update("06.1", answer="1")
    assert path.with_name("ruledlab-progress.newer-1.json").read_text(encoding="utf-8") == newer
    assert "newer version of ruledlab" in store.note
    assert "damaged" not in store.note


def test_a_huge_file_is_set_aside_unread(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store_module, "LARGEST", 1000)
    path.write_text(GOOD + " " * 1000, encoding="utf-8")
    store = Store(path)
    store.update("06.1", answer="1")
    assert path.with_name("ruledlab-progress.damaged-1.json").stat().st_size > 1000
    assert content(path)["06.1"]["answer"] == "1"


def test_what_was_set_aside_is_said_even_if_nothing_can_be_written(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path.write_text("damage", encoding="utf-8")
    monkeypatch.setattr(store_module.os, "fsync", no_space)
    store = Store(path)
    assert "set aside" in store.note
    assert "no space left" in store.note
    monkeypatch.undo()
    store.update("06.1", answer="1")
    assert "set aside" in store.note
    assert "no space left" not in store.note


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


def test_a_clock_that_is_put_back_does_not_lose_the_later_answer(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, two = Store(path), Store(path)
    monkeypatch.setattr(store_module.time, "time", lambda: 2e9)
    one.update("06.1", answer="with the clock ahead")
    one.set_seed("ahead")
    monkeypatch.setattr(store_module.time, "time", lambda: 1e9)
    two.update("06.1", answer="later")  # it has not read the file since
    two.set_seed("later")
    again = Store(path)
    assert again.record("06.1")["answer"] == "later"
    assert again.seed == "later"
    one.refresh()
    assert one.record("06.1")["answer"] == "later"
    assert one.seed == "later"


def test_a_change_sees_what_other_notebooks_have_written(path: Path) -> None:
    one, two = Store(path), Store(path)
    for store in (one, two, one, two):
        store.change("06.1", lambda old: {"tries": old.get("tries", 0) + 1})
    assert content(path)["06.1"]["tries"] == 4


def test_what_json_cannot_hold_changes_nothing(path: Path) -> None:
    store = Store(path)
    store.update("06.1", answer="old")
    for answer in (object(), {1, 2}, math.nan, 10**5000):
        with pytest.raises((TypeError, ValueError)):
            store.update("06.1", answer=answer)
    store.update("06.2", answer="new")
    assert content(path)["06.1"]["answer"] == "old"
    assert set(content(path)) == {"06.1", "06.2"}


@pytest.mark.parametrize("seed", ["Ada", "Σ κ̄", "\ud800", "a\nb", 7, "x" * 200])
def test_any_seed_comes_back(path: Path, seed: object) -> None:
    Store(path).set_seed(seed)
    again = Store(path)
    assert again.seed == " ".join(str(seed).split())
    assert again.note == ""


def test_a_seed_that_is_too_long_is_refused(path: Path) -> None:
    store = Store(path)
    with pytest.raises(GeometryError, match="at most 200 characters; got 201"):
        store.set_seed("x" * 201)
    assert store.seed == ""


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


def no_space(*_: object) -> None:
    raise OSError(28, "No space left on device")


@pytest.mark.parametrize("step", ["fsync", "replace"])
def test_a_full_disk_leaves_the_old_file_and_no_rubbish(
    path: Path, step: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(path)
    store.update("06.1", answer="old")
    before = path.read_bytes()
    monkeypatch.setattr(store_module.os, step, no_space)
    store.update("06.1", answer="new")
    assert "no space left" in store.note
    assert store.record("06.1")["answer"] == "new"
    monkeypatch.undo()
    assert path.read_bytes() == before
    assert names(path) == [FILE]


def test_a_folder_that_is_read_only_is_read_and_left_alone(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Store(path).update("06.1", answer="old")
    before = path.read_bytes()
    opened = Path.open

    def refused(self: Path, mode: str = "r", *more: object, **named: object) -> object:
        if "a" in mode or "w" in mode:
            raise PermissionError(13, "Permission denied", str(self))
        return opened(self, mode, *more, **named)  # type: ignore[call-overload]

    monkeypatch.setattr(Path, "open", refused)
    store = Store(path)
    assert store.record("06.1")["answer"] == "old"
    assert store.note == ""
    store.update("06.1", answer="new")
    assert "permission denied" in store.note
    assert store.record("06.1")["answer"] == "new"
    assert path.read_bytes() == before


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
