"""Save, open and share a design; take the plots away as a picture."""

from __future__ import annotations

import pathlib
import re
from collections.abc import Callable, Mapping
from typing import Any, Final

import anywidget
import traitlets

from ..design import Design
from ..geometry.checks import GeometryError
from .controls import Group, plain
from .slate import Change
from .state import Lab

__all__ = ["Share"]

_STATIC: Final = pathlib.Path(__file__).parent / "static"
_MIME: Final = {"json": "application/json", "png": "image/png", "svg": "image/svg+xml"}


class _ShareWidget(anywidget.AnyWidget):
    """Buttons that need the browser: files and the clipboard."""

    _esm = _STATIC / "share.js"
    _css = _STATIC / "share.css"

    text = traitlets.Unicode("").tag(sync=True)
    error = traitlets.Unicode("").tag(sync=True)
    said = traitlets.Unicode("").tag(sync=True)


class Share(Group):
    """A design as a JSON file and as a short text, both ways; the plots as PNG and SVG.

    Parameters
    ----------
    lab
        the lab whose design it is.
    export
        returns the plots in the format "png" or "svg".
    """

    def __init__(self, lab: Lab, export: Callable[[str], bytes]) -> None:
        super().__init__()
        self._lab, self._export = lab, export
        self.widget = _ShareWidget()
        self.widget.on_msg(self._on_message)
        self._releases.append(lambda: self.widget.on_msg(self._on_message, remove=True))
        self._listening = True
        self.follow(lab, self.update)
        self.update(Change(scene=True))
        self.listen(False)

    def listen(self, listening: bool) -> None:
        """Keep the text up to date, or let it rest while nobody can see it."""
        self._listening = listening
        if listening:
            self.put(self.widget, text=self._lab.design.to_text())

    def update(self, change: Change) -> None:
        """Follow the lab."""
        if change.error is not None:
            if change.source == "share":
                self.put(self.widget, error=plain(change.error), said="")
        elif change.scene or change.source == "share":
            text = self._lab.design.to_text() if self._listening else self.widget.text
            self.put(self.widget, text=text, error="", said="")

    def _on_message(self, _widget: Any, content: Mapping[str, Any], _buffers: Any) -> None:
        self.guard(lambda: self._answer(content))

    def _answer(self, content: Mapping[str, Any]) -> None:
        match content:
            case {"ask": "json" | "png" | "svg" as kind}:
                self._send(str(kind))
            case {"open": str(text), "name": str(name)}:
                self._read(lambda: Design.from_json(text), f"{name}: ", f"opened {name}")
            case {"paste": str(text)}:
                self._read(lambda: Design.from_text(text), "", "loaded from the text")
            case {"refused": str(reason)}:
                self.put(self.widget, error=reason, said="")

    def _read(self, read: Callable[[], Design], lead: str, said: str) -> None:
        try:
            design = read()
        except GeometryError as error:
            self.put(self.widget, error=lead + plain(str(error)), said="")
            return
        if self._lab.load(design, "share"):
            self.put(self.widget, error="", said=said)

    def _send(self, kind: str) -> None:
        data = self._lab.design.to_json().encode() if kind == "json" else self._export(kind)
        name = re.sub(r"[^\w-]+", "-", self._lab.design.name).strip("-").lower() or "ruled-surface"
        self.widget.send({"save": f"{name}.{kind}", "mime": _MIME[kind]}, [data])
        self.put(self.widget, error="", said=f"saved {name}.{kind}")
