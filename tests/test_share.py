"""Save, open, paste, export: the messages of the browser's buttons and the answers to them."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("anywidget")

from ruledlab.design import PREFIX, Design
from ruledlab.lab.share import Share
from ruledlab.lab.state import Lab

OPEN = Design(((0.3, 0.8), (1.0, 1.4), (1.9, 1.1)), "u - v", "0.5", samples=8, name="My ring: é/2")
OTHER = OPEN.with_(ubar="0", length=1 / 3, name="")


@pytest.fixture
def lab():
    return Lab(OPEN)


@pytest.fixture
def share(lab):
    share = Share(lab, lambda kind: f"plots as {kind}".encode())
    yield share
    share.release()
    share.widget.close()
    assert not lab._followers


@pytest.fixture
def sent(share, monkeypatch):
    messages = []
    monkeypatch.setattr(share.widget, "send", lambda *message: messages.append(message))
    return messages


def ask(share, **content):
    """Send a message as the browser does, through JSON."""
    share.widget._handle_custom_msg(json.loads(json.dumps(content)), [])


def said(share):
    return (share.widget.error, share.widget.said)


# ---- out ----------------------------------------------------------------------------------------


def test_save_sends_the_json_of_the_design(share, sent):
    ask(share, ask="json")
    ((content, buffers),) = sent
    assert content == {"save": "my-ring-é-2.json", "mime": "application/json"}
    assert Design.from_json(buffers[0].decode()) == OPEN
    assert said(share) == ("", "saved my-ring-é-2.json")


@pytest.mark.parametrize(("kind", "mime"), [("png", "image/png"), ("svg", "image/svg+xml")])
def test_export_sends_the_plots(share, sent, kind, mime):
    ask(share, ask=kind)
    assert sent == [({"save": f"my-ring-é-2.{kind}", "mime": mime}, [f"plots as {kind}".encode()])]


@pytest.mark.parametrize("name", ["", "///", "..", "  ", "?*:"])
def test_a_name_that_is_no_file_name(share, sent, lab, name):
    lab.edit("test", name=name)
    ask(share, ask="json")
    assert sent[0][0]["save"] == "ruled-surface.json"


@pytest.mark.parametrize("name", ["../../etc/passwd", "a\nb", 'a"b', "C:\\x"])
def test_a_file_name_has_no_path(share, sent, lab, name):
    lab.edit("test", name=name)
    ask(share, ask="json")
    assert not set(sent[0][0]["save"].removesuffix(".json")) & set('/\\\n":.')


def test_the_short_text_is_that_of_the_design_while_it_is_shown(share, lab):
    assert share.widget.text == OPEN.to_text()
    lab.edit("test", length=3.0)
    assert share.widget.text == OPEN.to_text()  # folded away: it rests
    share.listen(True)
    assert Design.from_text(share.widget.text) == lab.design
    lab.undo()
    lab.edit("test", length=4.0)
    assert Design.from_text(share.widget.text) == lab.design
    lab.undo()
    assert share.widget.text == OPEN.to_text()
    lab.move_cursor(0.5)
    assert share.widget.text == OPEN.to_text()


def test_an_export_that_fails_is_shown_as_a_defect(lab):
    share = Share(lab, lambda kind: 1 / 0)
    ask(share, ask="png")
    assert "ZeroDivisionError" in share.defect.value
    share.release()


# ---- in -----------------------------------------------------------------------------------------


def test_open_and_paste_load_the_design_as_one_step(share, lab):
    told = []
    end = lab.follow(told.append)
    ask(share, open=OTHER.to_json(), name="mine.json")
    assert lab.design == OTHER
    assert said(share) == ("", "opened mine.json")
    lab.undo()
    assert lab.design == OPEN
    ask(share, paste=f"look at this: {OTHER.to_text()} :-)")
    assert lab.design == OTHER
    assert said(share) == ("", "loaded from the text")
    assert [change.loaded for change in told] == [True, True, True]
    end()


def test_a_saved_file_opens_again(share, sent, lab):
    ask(share, ask="json")
    data = sent[0][1][0].decode()
    ask(share, open=OTHER.to_json(), name="other.json")
    ask(share, open=data, name="first.json")
    assert lab.design == OPEN


def test_what_was_said_is_forgotten_with_the_next_change(share, lab):
    ask(share, open=OTHER.to_json(), name="mine.json")
    lab.edit("test", length=4.0)
    assert said(share) == ("", "")


BAD = {
    "cut off": (OPEN.to_json()[:-20], "ends too early"),
    "another version": (OPEN.to_json().replace('"version": 1', '"version": 2'), "version 1"),
    "another program": ('{"cells": [], "nbformat": 4}', "a design saved by ruledlab"),
    "nan": (OPEN.to_json().replace("0.3", "NaN"), "finite numbers only; got NaN"),
    "a million points": (
        '{"format": "ruledlab design", "version": 1, "points": [' + "[0,1]," * 10**6 + "[0,1]]}",
        "characters",
    ),
    "deep": ("[" * 50_000, "nested"),
    "picture": ("\x89PNG\r\n\x1a\n\x00", "is not JSON"),
    "hostile": (OPEN.to_json().replace("u - v", "__import__('os')"), "ubar"),
    "not closing": (OPEN.to_json().replace('"open"', '"C1"'), "must close with C1"),
    "unknown entry": (OPEN.to_json().replace('"ubar"', '"sigma"'), "sigma"),
    "empty": ("", "ends too early"),
}


@pytest.mark.parametrize(("text", "words"), BAD.values(), ids=BAD)
def test_a_bad_file_says_what_is_wrong_and_changes_nothing(share, lab, text, words):
    told = []
    end = lab.follow(told.append)
    result = lab.result
    ask(share, open=text, name="x.json")
    error, note = said(share)
    assert error.startswith("x.json: ")
    assert words in error
    assert "`" not in error
    assert "\n" not in error
    assert (note, told, share.defect.value) == ("", [], "")
    assert lab.result is result
    assert not lab.can_undo
    end()
    ask(share, open=OTHER.to_json(), name="good.json")
    assert said(share) == ("", "opened good.json")


@pytest.mark.parametrize(
    ("text", "words"),
    [("hello", "got none"), (OPEN.to_text()[:-3], "damaged or cut off"), (PREFIX, "copy"),
     (OPEN.to_text()[:40] + "x" + OPEN.to_text()[41:], "damaged")],
)  # fmt: skip
def test_a_bad_text_says_what_is_wrong_and_changes_nothing(share, lab, text, words):
    result = lab.result
    ask(share, paste=text)
    assert words in share.widget.error
    assert lab.result is result
    ask(share, paste=OTHER.to_text())
    assert said(share) == ("", "loaded from the text")


def test_the_design_that_is_there_already(share, lab):
    ask(share, paste="nothing")
    ask(share, paste=OPEN.to_text())
    assert said(share) == ("", "loaded from the text")
    assert not lab.can_undo


def test_what_the_browser_refuses_is_shown(share):
    ask(share, refused="big.json: too big")
    assert said(share) == ("big.json: too big", "")


@pytest.mark.parametrize(
    "content", [{}, {"ask": "exe"}, {"open": 3, "name": "x"}, {"open": "{}"}, {"paste": None}]
)
def test_other_messages_are_ignored(share, sent, lab, content):
    ask(share, **content)
    assert (said(share), sent, lab.design, share.defect.value) == (("", ""), [], OPEN, "")


def test_after_release_no_message_is_heard(lab):
    share = Share(lab, lambda kind: b"")
    share.release()
    ask(share, open=OTHER.to_json(), name="x")
    assert lab.design == OPEN
    lab.edit("test", length=4.0)
    assert share.widget.text == OPEN.to_text()
