"""The studio in a real browser: every control changes what it should, and nothing else."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from .session import (
    PLOTS,
    THREE,
    LabSession,
    NotebookPage,
    Pictures,
    StudioPage,
    write_notebook,
)

if TYPE_CHECKING:
    from playwright.sync_api import Locator

EXAMPLE_2 = "s.lab.design == example('example_2')"


def test_opening_leaves_every_number_as_it_was(opened_studio: StudioPage) -> None:
    """No slider sends its rounded value back."""
    design_is_same, can_undo, pitch = opened_studio.opening
    assert design_is_same is True
    assert can_undo is False
    assert pitch == pytest.approx(0.580104765135371, abs=1e-14)
    assert min(opened_studio.home.space.drawn, opened_studio.home.plots.drawn) > 2000


# ------------------------------------------------------------------------------------- numbers


def test_a_slider_moves_by_keyboard(studio: StudioPage) -> None:
    old = studio.design()
    studio.notebook.press(studio.control("slider", "u, longitude"), "ArrowRight", 2)
    studio.wait_new(studio.home)
    studio.wait_kernel("round(s.lab.design.points[0][0], 12)", "0.41")
    points = studio.design()["points"]
    assert points[0][1] == math.pi / 4
    assert points[0] == points[-1]  # closed still
    assert points[2:5] == old["points"][2:5]


def test_a_typed_number_is_exact(studio: StudioPage) -> None:
    studio.control("combobox", "point").select_option("3 of 0…6")
    studio.wait_kernel("s.lab.chosen", "3")
    field = studio.control("textbox", "v, colatitude")
    studio.notebook.type_into(field, "3*pi/8")
    studio.wait_kernel("s.lab.design.points[3][1] == 3*math.pi/8", "True")
    studio.wait_new(studio.home)
    assert field.input_value() == "3*pi/8"
    studio.notebook.type_into(studio.control("textbox", "t, the place"), "1/3")
    studio.wait_kernel("s.lab.cursor == 1/3", "True")
    assert studio.kernel("s.lab.design.points[3][1] == 3*math.pi/8") == "True"


def test_a_bad_number_is_refused_beside_its_field(studio: StudioPage) -> None:
    field = studio.control("textbox", "v, colatitude")
    studio.notebook.type_into(field, "3*pi/")
    message = beside(studio, field)
    assert studio.alerts() == [message]
    assert studio.kernel(EXAMPLE_2) == "True"
    assert studio.stays(studio.home)
    studio.notebook.type_into(field, "pi/3")
    studio.wait_kernel("s.lab.design.points[0][1] == math.pi/3", "True")
    assert_silent(studio)


def test_a_slider_of_the_drawing(studio: StudioPage) -> None:
    studio.unfold("Drawing")
    studio.notebook.press(studio.control("slider", "length of the drawn"), "ArrowRight", 3)
    studio.wait_kernel("round(s.lab.design.length, 12)", "2.15")
    studio.notebook.wait_change(studio.home.space)
    assert studio.notebook.stays(studio.home.plots, PLOTS, over=0.2)  # κ, τ, σ do not depend on it


# ------------------------------------------------------------------------------------ formulas


def beside(studio: StudioPage, field: Locator) -> str:
    """Wait for the message in the block a field stands in; return it."""
    block = field.locator("xpath=ancestor::*[contains(@class, 'widget-vbox')][1]")
    message = block.get_by_role("alert")
    message.wait_for()
    return str(message.inner_text()).strip()


def assert_silent(studio: StudioPage) -> None:
    gone = "() => ![...document.querySelectorAll('.ruledlab [role=alert]')].some(e => e.innerText)"
    studio.page.wait_for_function(gone)


def test_a_typed_formula(studio: StudioPage) -> None:
    studio.notebook.type_into(studio.control("textbox", "ū(u, v)"), "sin(2*u)*v")
    studio.wait_kernel("s.lab.design.ubar", "'sin(2*u)*v'")
    studio.wait_new(studio.home)
    assert studio.design()["vbar"] == "u + v"
    typeset = studio.page.locator(".ruledlab .widget-htmlmath mjx-container, .ruledlab math")
    assert "sin" in typeset.first.inner_text()
    pitch = float(studio.kernel("s.lab.result.pitch.dual"))
    assert f"{pitch:.6f}".replace("-", "−") in studio.page.locator(".ruledlab-numbers").inner_text()


@pytest.mark.parametrize("text", ["sin(u", "u.real + 1", "w - v", "1/(u - u"])
def test_a_bad_formula_changes_nothing(studio: StudioPage, text: str) -> None:
    field = studio.control("textbox", "v̄(u, v)")
    studio.notebook.type_into(field, text)
    message = beside(studio, field)
    assert studio.alerts() == [message]
    assert studio.kernel(EXAMPLE_2) == "True"
    assert studio.stays(studio.home)
    studio.notebook.type_into(field, "v")
    studio.wait_kernel("s.lab.design.vbar", "'v'")
    studio.wait_new(studio.home)
    assert_silent(studio)


def test_the_menus_of_formulas(studio: StudioPage) -> None:
    studio.control("combobox", "ū, v̄").select_option("Lines through the origin")
    studio.wait_kernel("s.lab.design.ubar, s.lab.design.vbar", "('0', '0')")
    cone = studio.wait_new(studio.home)  # σ is undefined now, and says so
    assert "undefined" in studio.page.locator(".ruledlab-plots-reasons").inner_text()
    studio.control("combobox", "formulas for ū").select_option("cos(v)")
    studio.wait_kernel("s.lab.design.ubar", "'cos(v)'")
    studio.wait_new(cone)


# ------------------------------------------------------------------------------------- history


def test_undo_and_redo_restore_every_pixel(studio: StudioPage) -> None:
    seen = [studio.home]
    studio.notebook.press(studio.control("slider", "v, colatitude"), "ArrowRight")
    seen.append(studio.wait_new(seen[-1]))
    studio.notebook.type_into(studio.control("textbox", "ū(u, v)"), "u - 1.1*v")
    seen.append(studio.wait_new(seen[-1]))
    for words, pictures in (("undo", seen[1]), ("undo", seen[0]), ("redo", seen[1])):
        studio.button(words).click()
        studio.wait_back(pictures)
    studio.button("redo").click()
    studio.wait_back(seen[2])
    assert studio.button("redo").is_disabled()
    studio.button("undo").click()
    studio.button("undo").click()
    studio.wait_kernel(EXAMPLE_2, "True")
    studio.wait_back(studio.home)


def test_undo_leaves_the_reader_where_he_stands(studio: StudioPage) -> None:
    studio.notebook.drag(THREE, (60, 20))
    aside = Pictures(studio.notebook.wait_change(studio.home.space), studio.home.plots)
    studio.notebook.press(studio.control("slider", "v, colatitude"), "ArrowRight")
    studio.wait_new(aside)
    studio.button("undo").click()
    studio.wait_back(aside)
    studio.button("view").click()
    studio.wait_back(studio.home)


def test_reset_returns_to_the_beginning(studio: StudioPage) -> None:
    studio.control("combobox", "named surfaces").select_option("Cone")
    studio.wait_new(studio.home)
    studio.button("reset").click()
    studio.wait_kernel(EXAMPLE_2, "True")
    studio.notebook.wait_same(studio.home.space)


# -------------------------------------------------------------------------------------- cursor


def test_play_moves_the_cursor_and_pauses(studio: StudioPage) -> None:
    play = studio.button("play or pause")
    play.click()
    studio.page.wait_for_function(
        "() => Number(document.querySelector('.ruledlab-plots-cursor').ariaValueNow) > 0.03"
    )
    assert studio.notebook.pixels(THREE) != studio.home.space
    assert studio.notebook.pixels(PLOTS) != studio.home.plots
    play.click()
    paused, cursor = studio.look(), float(studio.kernel("s.lab.cursor"))
    while (again := studio.look()) != paused:  # what is under way arrives
        paused, cursor = again, float(studio.kernel("s.lab.cursor"))
    assert 0.03 < cursor < 1
    assert studio.stays(paused)
    assert float(studio.kernel("s.lab.cursor")) == cursor
    assert studio.kernel(EXAMPLE_2) == "True"


def test_the_cursor_is_dragged_in_the_plots(studio: StudioPage) -> None:
    handle = studio.control("slider", "cursor t")
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    studio.page.mouse.move(box["x"] + 4, y)
    studio.page.mouse.down()
    studio.page.mouse.move(box["x"] + box["width"] / 2, y, steps=6)
    studio.page.mouse.up()
    studio.wait_new(studio.home)
    assert float(studio.kernel("s.lab.cursor")) == pytest.approx(0.5, abs=0.01)
    handle.press("End")
    studio.wait_kernel("s.lab.cursor", "1.0")
    handle.press("ArrowLeft")
    studio.wait_kernel("round(s.lab.cursor, 9)", "0.99")
    studio.wait_kernel("s.lab.result.surface.domain", "(0.0, 1.0)")
    handle.press("Home")
    studio.wait_back(studio.home)


# --------------------------------------------------------------------------- gallery and drawing


def test_the_gallery(studio: StudioPage) -> None:
    menu = studio.control("combobox", "named surfaces")
    menu.select_option("Hyperboloid of one sheet")
    studio.wait_kernel("s.lab.design == example('hyperboloid')", "True")
    studio.wait_new(studio.home)
    numbers = studio.page.locator(".ruledlab-numbers")
    assert f"{math.sqrt(2) * math.pi:.6f}" in numbers.inner_text()  # l = √2 π
    menu.select_option("Möbius band")
    studio.wait_kernel("s.lab.design == example('moebius')", "True")
    studio.wait_kernel("s.lab.result.pitch is None", "True")
    values = numbers.locator("td:nth-child(2)")
    values.get_by_text("–").first.wait_for()
    assert not any(map(str.isdigit, "".join(values.all_inner_texts())))


def test_colour_by_curvature(studio: StudioPage) -> None:
    colour = studio.control("combobox", "colour")
    legend = studio.page.locator(".ruledlab-head").get_by_text("Gauss curvature")
    colour.select_option("K")
    by_gauss = studio.notebook.wait_change(studio.home.space)
    legend.wait_for()
    colour.select_option("H")
    studio.notebook.wait_change(by_gauss)
    colour.select_option("plain")
    studio.wait_back(studio.home)  # the plots too: no curve changed
    legend.wait_for(state="detached")


def test_the_sphere_large_and_off(studio: StudioPage) -> None:
    menu = studio.control("combobox", "sphere")
    menu.select_option("large")
    large = studio.notebook.wait_change(studio.home.space)
    menu.select_option("off")
    assert studio.notebook.wait_change(large) != studio.home.space
    menu.select_option("inset")
    studio.wait_back(studio.home)


@pytest.mark.parametrize("part", ["surface", "rulings", "striction curve", "moving frame"])
def test_parts_of_the_drawing_come_and_go(studio: StudioPage, part: str) -> None:
    studio.unfold("Drawing")
    box = studio.page.locator(".ruledlab").get_by_role("checkbox", name=part, exact=True)
    box.click()
    studio.notebook.wait_change(studio.home.space)
    box.click()
    studio.notebook.wait_same(studio.home.space)


def test_more_and_fewer_plots(studio: StudioPage) -> None:
    button, height = studio.button("δ"), studio.home.plots.height
    assert button.get_attribute("aria-pressed") == "false"
    button.click()
    more = studio.notebook.wait_change(studio.home.plots, PLOTS)
    assert more.height > height
    assert button.get_attribute("aria-pressed") == "true"
    assert "delta" in str(
        studio.page.locator(".ruledlab-plots-picture").get_attribute("aria-label")
    )
    button.click()
    studio.wait_back(studio.home)


def test_the_closing_menu(studio: StudioPage) -> None:
    menu = studio.control("combobox", "curve")
    menu.select_option("closed, C² (equal second differences)")
    studio.wait_kernel("s.lab.design.closing, s.lab.result.closure.order", "('C2', 2)")
    studio.wait_new(studio.home)
    status = studio.page.locator(".ruledlab-edit").get_by_role("status")
    assert "C²" in status.last.inner_text()
    menu.select_option("open")
    studio.wait_kernel("s.lab.design.closing", "'open'")


def test_raising_the_degree_keeps_the_curve(studio: StudioPage) -> None:
    studio.notebook.press(studio.control("slider", "degree"), "ArrowRight")
    studio.wait_kernel("len(s.lab.design.points)", "8")
    pitch = float(studio.kernel("s.lab.result.pitch.dual"))
    assert pitch == pytest.approx(0.580104765135371, abs=1e-11)
    assert studio.design()["closing"] == "C1"


# ------------------------------------------------------------------------- files and clipboard


@pytest.fixture
def share(studio: StudioPage) -> StudioPage:
    studio.unfold("Save, open, share")
    studio.button("Save design").wait_for()
    return studio


def open_file(studio: StudioPage, name: str, content: bytes) -> None:
    file = {"name": name, "mimeType": "application/json", "buffer": content}
    studio.page.locator(".ruledlab-share-file").set_input_files(file)


def test_saving_and_opening(share: StudioPage) -> None:
    name, content = share.notebook.download(share.button("Save design"))
    assert name.endswith(".json")
    assert content.decode() == share.kernel("print(s.lab.design.to_json(), end='')")
    share.control("combobox", "named surfaces").select_option("Orchid")
    share.wait_kernel(EXAMPLE_2, "False")
    share.wait_new(share.home)
    open_file(share, name, content)
    share.wait_kernel(EXAMPLE_2, "True")
    share.notebook.wait_same(share.home.space)
    assert_silent(share)


def bad_files() -> dict[str, tuple[bytes, str]]:
    """Content and what the message has to speak of."""
    good = {"format": "ruledlab design", "version": 1, "points": [[0.1, 0.2], [1, 1]]}
    many = [[0.1, 0.2]] * 9000
    return {
        "truncated": (json.dumps(good).encode()[:-9], "cut off"),
        "version": (json.dumps(good | {"version": 7}).encode(), "version 7"),
        "nan": (json.dumps(good | {"points": [[math.nan, 0], [1, 1]]}).encode(), "NaN"),
        "many": (json.dumps(good | {"points": many}, separators=(",", ":")).encode(), "9000"),
        "million": (json.dumps(good | {"points": many * 111}).encode(), "MB"),
        "other": (b'{"nbformat": 4, "cells": []}', "ruledlab"),
        "binary": (bytes(range(256)), "not JSON"),
    }


@pytest.mark.parametrize("kind", bad_files())
def test_a_bad_file_changes_nothing(share: StudioPage, kind: str) -> None:
    content, speaks_of = bad_files()[kind]
    open_file(share, f"{kind}.json", content)
    share.page.locator(".ruledlab-share [role=alert]:not(:empty)").wait_for()
    (message,) = share.alerts()
    assert message.startswith(f"{kind}.json: ")
    assert speaks_of in message
    assert len(message) < 250
    assert share.kernel(EXAMPLE_2) == "True"
    assert share.stays(share.home)


def test_the_short_text_there_and_back(share: StudioPage) -> None:
    share.notebook.type_into(share.control("textbox", "v̄(u, v)"), "cos(v)/7")
    share.wait_kernel("s.lab.design.vbar", "'cos(v)/7'")
    share.button("Copy").click()
    share.page.get_by_text("copied").wait_for()
    text = share.page.evaluate("() => navigator.clipboard.readText()")
    assert text == share.kernel("print(s.lab.design.to_text(), end='')")
    share.reset()
    share.notebook.type_into(share.control("textbox", "paste a design"), f"look: {text} nice?")
    share.wait_kernel("s.lab.design.vbar", "'cos(v)/7'")
    share.wait_new(share.home)
    assert share.design()["points"][3] == [3 * math.pi / 8, math.pi / 4]
    share.notebook.type_into(share.control("textbox", "paste a design"), text[:40], enter=False)
    share.button("Load").click()
    share.page.locator(".ruledlab-share [role=alert]:not(:empty)").wait_for()
    assert share.design()["vbar"] == "cos(v)/7"


def test_the_plots_as_pictures(share: StudioPage) -> None:
    name, content = share.notebook.download(share.button("Plots as PNG"))
    assert name.endswith(".png")
    assert content.startswith(b"\x89PNG\r\n")
    assert len(content) > 10_000
    name, content = share.notebook.download(share.button("Plots as SVG"))
    assert name.endswith(".svg")
    drawing = ElementTree.fromstring(content)
    assert drawing.tag.endswith("}svg")
    assert len(drawing.findall(".//{*}path")) > 10


# ------------------------------------------------------------------------------- accessibility


def test_every_control_has_a_name(studio: StudioPage) -> None:
    names = []
    for fold in ("Drawing", "Save, open, share", "In words"):
        studio.unfold(fold)
        names += studio.notebook.control_names(".ruledlab")
    assert len(set(names)) > 35
    assert [role for role, name in names if not any(map(str.isalnum, name))] == []


def test_the_pad_is_reached_by_tab(studio: StudioPage) -> None:
    studio.control("combobox", "named surfaces").focus()
    at_handle = "() => Boolean(document.activeElement.closest('.rl-handle'))"
    for _ in range(15):
        studio.page.keyboard.press("Tab")
        if studio.page.evaluate(at_handle):
            break
    assert studio.page.evaluate(at_handle)
    studio.page.keyboard.press("ArrowRight")
    studio.wait_new(studio.home)
    studio.page.keyboard.press("Tab")  # one stop for all points: the next is beyond the pad
    assert not studio.page.evaluate(at_handle)


def test_letters_on_a_control_are_no_commands_of_the_notebook(studio: StudioPage) -> None:
    """In JupyterLab A and B add a cell, M makes the cell one of prose and takes the app away."""
    cells = studio.page.locator(".jp-Cell")
    before = cells.count()
    for control in (studio.control("slider", "u, longitude"), studio.button("In words")):
        for key in ("a", "b", "m"):
            control.press(key)
    studio.page.wait_for_timeout(300)
    assert cells.count() == before
    assert studio.page.locator(".jp-MarkdownCell").count() == 0
    studio.page.keyboard.press("Control+s")  # shortcuts are the page's still
    studio.page.wait_for_function(
        "() => !window.jupyterapp.shell.currentWidget.context.model.dirty"
    )


def test_folds_open_by_keyboard(studio: StudioPage) -> None:
    words = studio.page.locator(".ruledlab-words-panel")
    studio.unfold("Drawing")
    words.wait_for(state="hidden")
    studio.button("In words").press("Enter")
    words.wait_for(state="visible")
    assert studio.button("In words").get_attribute("aria-expanded") == "true"
    assert studio.button("Drawing").get_attribute("aria-expanded") == "false"


def test_the_words_follow(studio: StudioPage) -> None:
    studio.unfold("In words")
    words = studio.page.locator(".ruledlab-words-panel")
    assert "t = 0.000" in words.inner_text()
    studio.kernel("s.lab.move_cursor(0.25)")
    words.get_by_text("t = 0.250").wait_for()
    studio.notebook.type_into(studio.control("textbox", "ū(u, v)"), "v/3")
    words.get_by_text("ū = v/3").wait_for()
    curvature = float(studio.kernel("s.lab.mark.values['kappa']"))
    assert f"κ = {curvature:.4f}" in words.inner_text()


# -------------------------------------------------------------------------------- layout, themes


@pytest.fixture
def window(studio: StudioPage, lab: LabSession) -> Iterator[StudioPage]:
    yield studio
    studio.notebook.dark(False)
    studio.notebook.resize(*lab.viewport)
    studio.page.wait_for_timeout(300)  # the plots are drawn anew for the width
    studio.home = studio.look()


@pytest.mark.parametrize("width", [700, 1500])
def test_nothing_sticks_out(window: StudioPage, width: int) -> None:
    studio = window
    studio.notebook.resize(width, 2400)
    wide = str(width > 1000).lower()
    room = f"() => (document.querySelector('.ruledlab').clientWidth > 600) === {wide}"
    studio.page.wait_for_function(room)
    studio.notebook.wait_still(PLOTS)
    for fold in ("Drawing", "Save, open, share", "In words"):
        studio.unfold(fold)
        assert studio.notebook.sticks_out() == []
    studio.notebook.screenshot(f"studio-{width}", ".jp-Notebook")


def test_the_dark_theme_and_back(window: StudioPage) -> None:
    studio = window
    studio.notebook.resize(1500, 1300)
    studio.notebook.wait_still(PLOTS)
    studio.notebook.screenshot("studio-light")
    light = studio.look()
    studio.notebook.dark()
    studio.wait_new(light)
    paper = "() => getComputedStyle(document.querySelector('.rl-pad')).backgroundColor"
    assert studio.page.evaluate(paper) == "rgb(17, 17, 17)"
    studio.notebook.screenshot("studio-dark")
    studio.notebook.dark(False)
    studio.wait_back(light)


# -------------------------------------------------------------------------- several in a notebook

INSTANCES = "import ipywidgets; print(len(ipywidgets.widget._instances), end='')"


@pytest.fixture(scope="module")
def two(lab: LabSession, tmp_path_factory: pytest.TempPathFactory) -> Iterator[NotebookPage]:
    path = tmp_path_factory.mktemp("two") / "two.ipynb"
    cells = (
        "import time\nfrom ruledlab.lab import example, studio",
        "first = studio()\nfirst",
        "second = studio(example('hyperboloid'))\nsecond",
        "end = time.monotonic() + 60",
        "while first.lab.cursor < 1 and time.monotonic() < end: time.sleep(0.02)",
    )
    with lab.notebook(write_notebook(path, *cells)) as page:
        page.wait_idle()
        for number in range(4):
            page.run_cell(number)
        assert page.errors() == []
        for nth in range(2):
            page.locator(THREE, nth).scroll_into_view_if_needed()
            page.wait_still(THREE, nth, timeout=60)
        yield page
        assert page.errors() == []
        assert page.console_errors == []


def slider(page: NotebookPage, nth: int) -> Locator:
    return page.page.get_by_role("slider", name="u, longitude").nth(nth)


def test_two_labs_do_not_disturb_each_other(two: NotebookPage) -> None:
    two.locator(PLOTS).scroll_into_view_if_needed()
    pictures = [two.wait_still(kind, nth) for nth in range(2) for kind in (THREE, PLOTS)]
    two.press(slider(two, 0), "ArrowRight")
    two.wait_change(pictures[0], THREE, 0)
    two.wait_change(pictures[1], PLOTS, 0)
    assert two.stays(pictures[2], THREE, 1, over=0.2)
    assert two.stays(pictures[3], PLOTS, 1, over=0.2)
    assert two.kernel_exec("second.lab.design == example('hyperboloid')") == "True"
    changed = two.pixels(THREE, 0)
    two.press(slider(two, 1), "ArrowRight")
    two.wait_change(pictures[2], THREE, 1)
    assert two.stays(changed, THREE, 0, over=0.2)


def test_sliders_move_while_a_cell_runs(two: NotebookPage) -> None:
    two.locator(PLOTS).scroll_into_view_if_needed()
    old = two.wait_still(THREE)
    # ipykernel 7.4 sends a widget's first message to the main thread, where it would wait for the
    # cell; only from the second on it goes where the widget was last answered
    two.press(slider(two, 0), "ArrowRight")
    pictures = [two.wait_change(old, THREE), two.wait_still(PLOTS)]
    before = float(two.kernel_exec("first.lab.design.points[0][0]"))
    two.run_cell(4, wait=False)
    two.press(slider(two, 0), "ArrowRight", 7)
    two.wait_change(pictures[0], THREE, timeout=30)
    two.wait_change(pictures[1], PLOTS, timeout=30)
    assert two.running(4)  # the cell still runs, and the pictures have moved on
    two.page.get_by_role("slider", name="cursor t").first.press("End")  # what the cell waits for
    two.wait_cell(4)
    assert two.kernel_exec("time.monotonic() < end") == "True"
    goal = f"{before + 0.07:.6f}"
    two.wait_kernel("f'{first.lab.design.points[0][0]:.6f}'", repr(goal))  # no step was lost


def test_a_first_move_while_a_cell_runs_is_not_lost(two: NotebookPage) -> None:
    two.kernel_exec("first.lab.move_cursor(0); end = time.monotonic() + 2")
    before = float(two.kernel_exec("first.lab.design.points[0][1]"))
    two.run_cell(4, wait=False)
    two.press(two.page.get_by_role("slider", name="v, colatitude").nth(0), "ArrowRight", 5)
    two.wait_cell(4)
    grid = round(before, 2) + 0.05  # it started between two places of the slider
    two.wait_kernel("f'{first.lab.design.points[0][1]:.6f}'", repr(f"{grid:.6f}"))


def test_running_the_cell_again_leaves_nothing_behind(two: NotebookPage) -> None:
    def again() -> tuple[str, int, int]:
        two.kernel_exec("old = first")
        two.run_cell(1)
        two.wait_kernel("first is old", "False")
        two.page.wait_for_function("() => document.querySelectorAll('.ruledlab').length === 2")
        two.wait_still(THREE, 0, timeout=60)
        two.wait_still(PLOTS, 0)
        counts = (two.page.locator(kind).count() for kind in (THREE, PLOTS))
        return (two.kernel_exec(INSTANCES), *counts)

    first, second = again(), again()
    assert second == first
    assert first[1:] == (2, 2)
    assert two.kernel_exec("print(old.comm is None, end='')") == "True"
    picture = two.wait_still(THREE, 0)
    two.press(slider(two, 0), "ArrowRight")
    two.wait_change(picture, THREE, 0)
