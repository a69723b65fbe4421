"""Whole apps: built from one lab, drawn once per change, closed without a trace."""

from __future__ import annotations

import gc
import json
import weakref
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("anywidget")
pytest.importorskip("matplotlib")
pytest.importorskip("pythreejs")

import IPython.core.getipython
import ipywidgets

from ruledlab.design import Design
from ruledlab.geometry import gallery
from ruledlab.lab import Lab, apps, cells, studio
from ruledlab.lab.apps import App, chart, example, sphere, surface
from ruledlab.lab.palette import DARK, LIGHT

BUILDERS = {
    "studio": lambda: apps.Studio(Lab(example("example_2"))),
    "chart": lambda: chart(Lab(example("example_2"))),
    "sphere": lambda: sphere(Lab(example("example_2"))),
    "surface": lambda: surface(Lab(example("example_2"))),
}


def widgets():
    """Return the ids of all widgets that are open."""
    return set(ipywidgets.widget._instances)


@pytest.fixture
def app():
    app = studio()
    yield app
    app.close()
    assert [group.defect.value for group in app._groups if group.defect.value] == []


@pytest.fixture
def drawn(app, monkeypatch):
    """Count what the views of a studio are asked to draw."""
    calls = []
    for view in app._views:
        for name in ("draw", "draw_cursor", "reset_view"):
            if hasattr(view, name):
                method, label = getattr(view, name), f"{type(view).__name__}.{name}"
                monkeypatch.setattr(
                    type(view),
                    name,
                    lambda self, *a, method=method, label=label, **k: (
                        calls.append(label),
                        method(*a, **k),
                    ),
                )
    return calls


# ---- building and closing -----------------------------------------------------------------------


@pytest.mark.parametrize("build", BUILDERS.values(), ids=BUILDERS)
def test_an_app_closes_without_a_trace(build):
    before = widgets()
    app = build()
    lab = app.lab
    assert isinstance(app, App)
    assert len(widgets() - before) > 10
    lab.load(example("hyperboloid"), "test")
    lab.move_cursor(0.5)
    app.close()
    assert widgets() == before
    assert not lab._followers
    app.close()
    assert widgets() == before
    lab.load(example("cone"), "test")  # no one listens, nothing breaks


def test_a_closed_app_can_be_forgotten():
    app = chart(Lab(example("cone")))
    app.close()
    reference = weakref.ref(app)
    del app
    gc.collect()
    assert reference() is None


def test_the_studio_begins_with_example_2(app):
    assert app.lab.design == example("example_2")
    assert float(app.lab.result.pitch.real) == pytest.approx(-6.115937783177811, abs=1e-10)
    assert float(app.lab.result.pitch.dual) == pytest.approx(0.580104765135371, abs=1e-10)


@pytest.mark.parametrize("key", gallery.names())
def test_every_example_as_a_design(key):
    design, known = example(key), gallery.example(key)
    assert (design.points, design.ubar, design.vbar) == (known.points, known.ubar, known.vbar)
    assert (design.closing, design.name) == (known.closing, known.title)


def test_a_studio_begins_where_it_is_told():
    design = Design(((0, 1), (1, 1)), "u", "1", samples=20)
    app = studio(design)
    assert app.lab.design == design
    app.close()


# ---- one change, one drawing --------------------------------------------------------------------


def test_a_design_is_drawn_once_by_each_view(app, drawn):
    app.lab.edit("test", length=3.0)
    for view in ("CurvePlots", "DomainPad", "SurfaceView"):
        assert drawn.count(f"{view}.draw") == 1
    assert "SurfaceView.reset_view" not in drawn
    drawn.clear()
    app.lab.move_cursor(0.3)
    assert sorted(drawn) == [f"{v}.draw_cursor" for v in ("CurvePlots", "DomainPad", "SurfaceView")]


def test_a_refused_change_draws_nothing(app, drawn):
    app.lab.edit("ubar", ubar="u +")
    assert drawn == []


def test_another_surface_is_seen_from_the_usual_side(app, drawn):
    app.lab.load(example("orchid"), "gallery")
    assert drawn.count("SurfaceView.reset_view") == 1


def test_control_view_and_number_follow_the_pad(app):
    lab, points = app.lab, app.lab.design.points
    content = {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 3, "u": 1.5, "v": 1.1}
    app.pad._handle_custom_msg(json.loads(json.dumps(content)), [])
    assert lab.design.points[3] == (1.5, 1.1)
    shown = np.frombuffer(app.pad.picture["points"], "<f8").reshape(-1, 2)
    assert np.array_equal(shown, np.array(lab.design.points))
    app.points.chosen.value = 3
    assert app.points.u.field.value == "1.5"
    lab.undo()
    assert lab.design.points == points


def test_the_pad_adds_removes_and_chooses(app):
    lab, count = app.lab, len(app.lab.design.points)

    def send(seq, kind, index, u, v):
        content = {"kind": kind, "view": "a", "seq": seq, "drag": 0, "index": index}
        app.pad._handle_custom_msg(content | {"u": u, "v": v}, [])

    send(1, "add", 2, 0.9, 1.9)
    assert lab.design.points[2] == (0.9, 1.9)
    assert (lab.chosen, app.pad.chosen, app.points.chosen.value) == (2, 2, 2)
    send(2, "remove", 2, 0.9, 1.9)
    assert len(lab.design.points) == count
    send(3, "choose", 4, 0, 0)
    assert (lab.chosen, app.points.chosen.value) == (4, 4)
    for seq in range(4, 12):
        send(seq, "remove", 1, 0, 0)
    assert "raise the degree" in app.points.error.value
    shown = np.frombuffer(app.pad.picture["points"], "<f8").reshape(-1, 2)
    assert np.array_equal(shown, np.array(lab.design.points))


def test_drags_of_two_charts_are_two_steps():
    """The pads number their drags each for itself."""
    lab = Lab(example("twisted_ring"))
    first, second = chart(lab), chart(lab)
    start = lab.design.points
    for seq, (app, u) in enumerate(((first, 2.0), (second, 2.5)), 1):
        app.pad.set_state({"motion": ["a", seq, 1, 4, u, 1.5]})
    assert lab.design.points[4] == (2.5, 1.5)
    lab.undo()
    assert lab.design.points[4] == (2.0, 1.5)
    lab.undo()
    assert lab.design.points == start
    first.close()
    second.close()


def test_the_theme_reaches_every_view_and_who_asked_for_it(app):
    told = []
    disconnect = app.on_theme(told.append)
    app._page.set_state({"dark": True})
    app._page.set_state({"dark": True})
    assert app.pad.colours["dark"] is True
    app._page.set_state({"dark": False})
    assert app.pad.colours["dark"] is False
    disconnect()
    disconnect()
    app._page.set_state({"dark": True})
    assert told == [DARK, LIGHT]


# ---- a defect anywhere is shown -----------------------------------------------------------------


WAYS = {
    "pad": lambda a: a.pad._handle_custom_msg(
        {"kind": "end", "view": "a", "seq": 1, "drag": 1, "index": 1, "u": 1.0, "v": 1.0}, []
    ),
    "plots": lambda a: a.plots.widget.set_state({"picked": [1, 0.77]}),
    "slider": lambda a: setattr(a.points.u.slider, "value", 2.2),
    "theme": lambda a: a._page.set_state({"dark": True}),
}


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_a_defect_of_a_view_is_shown_whatever_led_to_it(way, monkeypatch):
    app = studio()

    def broken(*_args, **_kwargs):
        raise RuntimeError("broken view")

    for name in ("draw", "draw_cursor", "set_theme"):
        monkeypatch.setattr(type(app.view), name, broken)
    way(app)
    shown = [group.defect for group in app._groups if group.defect.value]
    assert len(shown) == 1
    assert "broken view" in shown[0].value
    assert shown[0] in app.children
    app.close()


# ---- several apps -------------------------------------------------------------------------------


def test_two_studios_do_not_disturb_each_other(app):
    other = studio()
    before = widgets()
    app.points.u.slider.value = 2.0
    app.fields.rows["ubar"][0].value = "u +"
    app.lab.move_cursor(0.5)
    assert other.lab.design == example("example_2")
    assert other.lab.cursor == 0.0
    assert other.fields.rows["ubar"][2].value == ""
    other.close()
    assert widgets() < before
    app.points.u.slider.value = 1.0
    assert app.lab.design.points[0][0] == 1.0


def test_figures_that_share_a_lab_follow_each_other():
    lab = Lab(example("twisted_ring"))
    figure, space = chart(lab), surface(lab)
    figure.points.u.field.value = "0.5"
    space.time.t.field.value = "0.25"
    assert lab.design.points[0][0] == 0.5
    assert len(figure.pad.cursor) == 2
    figure.close()
    lab.edit("test", length=3.0)
    assert lab._followers
    space.close()
    assert not lab._followers


@pytest.fixture
def kernel(monkeypatch):
    kernel = SimpleNamespace(get_parent=lambda channel: kernel.parent)
    shell = SimpleNamespace(kernel=kernel)
    monkeypatch.setattr(IPython.core.getipython, "get_ipython", lambda: shell)
    monkeypatch.setattr(cells, "_open", {})

    def run(cell, message):
        kernel.parent = {"metadata": {"cellId": cell}, "header": {"msg_id": message}}

    return run


def test_running_the_cell_again_closes_the_first(kernel):
    before = widgets()
    kernel("cell 1", "run 1")
    first, beside = chart(Lab(example("cone"))), chart(Lab(example("crown")))
    kernel("cell 2", "run 2")
    other = chart(Lab(example("cone")))
    counted = len(widgets())
    kernel("cell 1", "run 3")
    again, anew = chart(Lab(example("cone"))), chart(Lab(example("crown")))
    assert len(widgets()) == counted
    assert not first.lab._followers
    assert not beside.lab._followers
    assert other.lab._followers
    for app in (again, anew, other):
        app.close()
    assert widgets() == before
