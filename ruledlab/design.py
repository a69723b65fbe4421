"""`Design`: the frozen description of one ruled surface, as JSON and as a short text."""

from __future__ import annotations

import base64
import binascii
import json
import re
import reprlib
import zlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

import numpy as np

from .geometry.checks import GeometryError
from .geometry.curve import LARGEST, MAX_DEGREE, Bezier, close, seam
from .geometry.field import field
from .geometry.surface import RuledSurface

__all__ = ["CLOSINGS", "Design"]

FORMAT = "ruledlab design"
VERSION = 1
PREFIX = "ruledlab1:"

CLOSINGS = {"open": -1, "C0": 0, "C1": 1, "C2": 2}
"""The names of the closing conditions and how many derivatives they join."""

BASES = ("striction", "foot")
MOST_SAMPLES = 800
LONGEST_JSON = 100_000
"""More characters than any design can need: a longer file is some other file."""

LONGEST_TOKEN = 5
"""Characters after the place of an error up to which a file seems cut off: half a ``false``."""

MOST_PIECES = 100
"""Pieces that a chat may break the short text into."""


@dataclass(frozen=True, slots=True)
class Design:
    """One ruled surface as it is designed: everything that is saved, undone and shared.

    Parameters
    ----------
    points
        control points (u, v) in radians, 2 to 61 of them.
    ubar, vbar
        typed formulas in u and v, or numbers.
    closing
        the condition that is kept while points move: ``"open"``, ``"C0"``, ``"C1"``, ``"C2"``.
    length
        length of the drawn rulings.
    samples
        how many rulings are computed for drawing.
    base
        the point of a ruling that its drawn piece is centred on: ``"striction"`` or ``"foot"``,
        the foot point nearest to the origin.
    name
        a title.

    Raises
    ------
    GeometryError
        naming the argument that is wrong.
    """

    points: tuple[tuple[float, float], ...]
    ubar: str = "0"
    vbar: str = "0"
    closing: str = "open"
    length: float = 2.0
    samples: int = 200
    base: str = "striction"
    name: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _points(self.points))
        object.__setattr__(self, "ubar", _formula(self.ubar, "ubar"))
        object.__setattr__(self, "vbar", _formula(self.vbar, "vbar"))
        object.__setattr__(self, "length", _number(self.length, "length", 1e-6, 1e6))
        object.__setattr__(self, "samples", _whole(self.samples, "samples", 8, MOST_SAMPLES))
        _one_of(self.closing, "closing", tuple(CLOSINGS))
        _one_of(self.base, "base", BASES)
        _title(self.name)
        _require_seam(self.points, self.closing)

    # -- use -------------------------------------------------------------------------------------

    def surface(self) -> RuledSurface:
        """Return the surface of this design."""
        return RuledSurface(Bezier(np.array(self.points)), self.ubar, self.vbar)

    def with_(self, **changes: Any) -> Design:
        """Return this design with some entries replaced."""
        return replace(self, **changes)

    def closed_with(self, closing: str) -> Design:
        """Return this design with another closing condition, moving as few points as it takes."""
        _one_of(closing, "closing", tuple(CLOSINGS))
        points = close(self.points, CLOSINGS[closing])
        return self.with_(points=_tuples(points), closing=closing)

    # -- JSON and short text ---------------------------------------------------------------------

    def to_json(self) -> str:
        """Return the design as JSON; every number comes back exactly."""
        return json.dumps({"format": FORMAT, "version": VERSION, **asdict(self)}, indent=1)

    @classmethod
    def from_json(cls, text: str) -> Design:
        """Read a design from JSON.

        Raises
        ------
        GeometryError
            saying what is wrong with the file: not JSON, cut off, another program's, another
            version, an entry that is missing, unknown, or out of its range.
        """
        content = _parsed(text)
        if not isinstance(content, dict) or content.get("format") != FORMAT:
            raise GeometryError(
                f'`text` must be a design saved by ruledlab ("format": "{FORMAT}"); got some other '
                "JSON; choose a file that the Save button made"
            )
        if content.get("version") != VERSION:
            raise GeometryError(
                f"`text` must be version {VERSION} of the format; got version "
                f"{_short(content.get('version'))}; open it with the release that saved it"
            )
        return cls._from_entries({k: content[k] for k in content if k not in ("format", "version")})

    @classmethod
    def _from_entries(cls, entries: Mapping[str, Any]) -> Design:
        names = {entry.name for entry in fields(cls)}
        unknown = sorted(set(entries) - names)
        if unknown:
            raise GeometryError(f"`text` has an entry that no design has: {_short(unknown[0])}")
        if "points" not in entries:
            raise GeometryError('`text` has no entry "points"; the file is incomplete')
        return cls(**entries)

    def to_text(self) -> str:
        """Return the design as one short word to paste into a chat."""
        entries = asdict(self)
        values = [entries[entry.name] for entry in fields(self)]
        packed = zlib.compress(json.dumps(values, separators=(",", ":")).encode(), 9)
        return PREFIX + base64.b64encode(packed).decode().rstrip("=")

    @classmethod
    def from_text(cls, text: str) -> Design:
        """Read a design from the word of `to_text`, found anywhere in ``text``.

        Raises
        ------
        GeometryError
            if there is no such word, or it is damaged or cut off.
        """
        if not isinstance(text, str) or len(text) > LONGEST_JSON:
            raise GeometryError(f"`text` must be a text that holds a word starting {PREFIX}")
        parts = text.split(PREFIX)[1:]
        if not parts:
            raise GeometryError(
                f"`text` must hold a word starting {PREFIX}; got none; copy the whole of it"
            )
        values = _parsed(_unpacked(parts))
        names = [entry.name for entry in fields(cls)]
        if not isinstance(values, list) or len(values) != len(names):
            raise GeometryError("`text` is not a design of this version; copy the whole of it")
        return cls(**dict(zip(names, values, strict=True)))


def _tuples(points: Any) -> tuple[tuple[float, float], ...]:
    return tuple((float(u), float(v)) for u, v in points)


def _points(points: Any) -> tuple[tuple[float, float], ...]:
    if not hasattr(points, "__len__") or isinstance(points, str):
        raise GeometryError(f"`points` must be a list of pairs (u, v); got {_short(points)}")
    most = MAX_DEGREE + 1
    if not 2 <= len(points) <= most:
        raise GeometryError(f"`points` must be 2 to {most} control points; got {len(points)}")
    return tuple(_pair(point) for point in points)


def _pair(point: Any) -> tuple[float, float]:
    if not hasattr(point, "__len__") or isinstance(point, (str, Mapping)) or len(point) != 2:
        raise GeometryError(f"`points` must be pairs (u, v); got {_short(point)} among them")
    u, v = point
    return _coordinate(u), _coordinate(v)


def _coordinate(value: Any) -> float:
    if isinstance(value, np.generic):
        value = value.item()
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not abs(value) <= LARGEST:
        raise GeometryError(
            f"`points` must be made of finite numbers of at most {LARGEST:g}; got {_short(value)} "
            "among them"
        )
    return float(value)


def _formula(value: Any, name: str) -> str:
    """Return the formula as typed; a callable has no text and cannot be saved."""
    parsed = field(value, name)
    if parsed.text is None:
        raise GeometryError(
            f"`{name}` must be a typed formula or a number here; got a callable, which cannot be "
            "saved; use RuledSurface for it"
        )
    return parsed.text


def _number(value: Any, name: str, least: float, most: float) -> float:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not least <= value <= most:
        raise GeometryError(
            f"`{name}` must be a number between {least:g} and {most:g}; got {_short(value)}"
        )
    return float(value)


def _whole(value: Any, name: str, least: int, most: int) -> int:
    number = _number(value, name, least, most)
    if number != int(number):
        raise GeometryError(f"`{name}` must be a whole number; got {_short(value)}")
    return int(number)


def _one_of(value: Any, name: str, allowed: tuple[str, ...]) -> None:
    if not isinstance(value, str) or value not in allowed:
        raise GeometryError(f"`{name}` must be one of {', '.join(allowed)}; got {_short(value)}")


def _title(name: Any) -> None:
    if not isinstance(name, str) or len(name) > 200:
        raise GeometryError(f"`name` must be a text of at most 200 characters; got {_short(name)}")


def _require_seam(points: tuple[tuple[float, float], ...], closing: str) -> None:
    wanted = CLOSINGS[closing]
    if wanted >= 0 and (state := seam(points)).order < wanted:
        raise GeometryError(
            f"`points` must close with {closing}, as `closing` says; but {state.reason}; use "
            "Design(points, …).closed_with(…) to move them"
        )


def _parsed(text: Any) -> Any:
    if not isinstance(text, str) or len(text) > LONGEST_JSON:
        size = len(text) if isinstance(text, str) else 0
        raise GeometryError(
            f"`text` must be the JSON of one design, a few thousand characters; got "
            f"{f'{size} characters' if size else type(text).__name__}"
        )
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        what = "ends too early (cut off?)" if _cut(error) else f"is not JSON: {error.msg}"
        raise GeometryError(
            f"`text` {what} at line {error.lineno}, column {error.colno}; save the design again"
        ) from None
    except RecursionError:
        raise GeometryError("`text` is nested too deeply to be a design") from None
    except GeometryError:
        raise
    except ValueError:  # Python's limit on the digits of a whole number
        raise GeometryError("`text` has a number with too many digits to be a design") from None


def _cut(error: json.JSONDecodeError) -> bool:
    """Whether the text stops in the middle: in a string, a number, or where more must come."""
    rest = error.doc[error.pos :].rstrip()
    broken = error.msg.startswith("Unterminated") or len(rest) <= LONGEST_TOKEN
    return broken and not error.msg.startswith("Extra data")


def _refuse_constant(name: str) -> None:
    raise GeometryError(f"`text` must hold finite numbers only; got {name}; remove or replace it")


def _unpacked(parts: list[str]) -> str:
    """Return what the first whole word holds with which one of the parts begins."""
    for part in parts:
        # A chat may have broken the word; what follows it may look like one more piece of it.
        pieces = re.findall("[A-Za-z0-9+/]+", part)[:MOST_PIECES]
        for count in range(1, len(pieces) + 1):
            content = _inflated("".join(pieces[:count]))
            if content is not None:
                return content
    raise GeometryError(f"`text` is damaged or cut off after {PREFIX}; copy the whole word again")


def _inflated(word: str) -> str | None:
    """Return what was packed into the word; None if that is not whole."""
    unpacker = zlib.decompressobj()
    try:
        packed = base64.b64decode(word + "=" * (-len(word) % 4), validate=True)
        content = unpacker.decompress(packed, LONGEST_JSON)
        return content.decode() if unpacker.eof else None
    except (binascii.Error, zlib.error, UnicodeDecodeError):
        return None


def _short(value: object) -> str:
    text = " ".join(reprlib.repr(value).split())
    return text if len(text) <= 40 else text[:37] + "..."
