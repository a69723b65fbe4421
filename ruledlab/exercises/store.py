"""What a student has answered, kept in one JSON file beside the lessons.

Every write reads the file first and merges: of each exercise the newer entry wins, so two notebooks
that are open at once do not lose each other's answers. The file is replaced whole, by a rename
inside its directory, so a crash leaves the old one or the new one. A file that cannot be read is
set aside under another name, never overwritten.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import IO, Any

__all__ = ["FILE", "Store", "the_store"]

FILE = "ruledlab-progress.json"
FORMAT = "ruledlab progress"
VERSION = 1
LARGEST = 20_000_000
PATIENCE = 5.0
"""Seconds to wait while another notebook writes."""

Record = dict[str, Any]
Disconnect = Callable[[], None]


class _Damaged(Exception):
    """The file is there, but it is not a progress file."""


class Store:
    """Answers, hints used and designs of one student.

    Parameters
    ----------
    path
        the file; it is made with the first answer.

    Attributes
    ----------
    note
        what the reader should know about the file: set aside, not writable; usually empty.
    """

    def __init__(self, path: str | os.PathLike[str] = FILE) -> None:
        self.path = Path(path).absolute()
        self.note = ""
        self._mutex = threading.RLock()
        self._records: dict[str, Record] = {}
        self._seed: tuple[str, float] = ("", 0.0)
        self._followers: list[Callable[[str], None]] = []
        self.refresh()

    # -- reading ---------------------------------------------------------------------------------

    @property
    def seed(self) -> str:
        """The student's seed, which the values of the exercises depend on; empty by default."""
        return self._seed[0]

    def record(self, key: str) -> Record:
        """Return a copy of what is known of an exercise; empty if nothing is."""
        with self._mutex:
            return dict(self._records.get(key, {}))

    def keys(self) -> tuple[str, ...]:
        """Return the exercises something is known of."""
        with self._mutex:
            return tuple(sorted(self._records))

    def follow(self, callback: Callable[[str], None]) -> Disconnect:
        """Call ``callback(key)`` after each change of an exercise; the returned function stops it.

        The key is empty when the seed, the note or any number of exercises changed.
        """
        with self._mutex:
            self._followers.append(callback)

        def disconnect() -> None:
            with self._mutex:
                if callback in self._followers:
                    self._followers.remove(callback)

        return disconnect

    def refresh(self) -> None:
        """Read what other notebooks have written meanwhile; a damaged file is set aside."""
        with self._mutex:
            try:
                self._merge(self._read())
            except _Damaged:
                self._write()  # it sets the file aside, under the lock
            except OSError as error:
                self._say(f"The file {self.path.name} cannot be read ({_reason(error)}).")

    # -- writing ---------------------------------------------------------------------------------

    def update(self, key: str, **entries: Any) -> Record:
        """Change entries of an exercise's record, save, and return the record."""
        with self._mutex:
            old = self._records.get(key, {})
            when = max(time.time(), _when(old) + 1e-6)
            self._records[key] = {**old, **entries, "when": when}
            self._write()
        self._tell(key)
        return self.record(key)

    def set_seed(self, seed: object) -> None:
        """Set the student's seed: a name or a number."""
        with self._mutex:
            self._seed = (str(seed).strip(), max(time.time(), self._seed[1] + 1e-6))
            self._write()
        self._tell("")

    # -- inside ----------------------------------------------------------------------------------

    def _tell(self, key: str) -> None:
        for callback in tuple(self._followers):
            callback(key)

    def _say(self, note: str) -> None:
        self.note = note

    def _merge(self, content: Mapping[str, Any]) -> None:
        """Take over what is newer in the file."""
        for key, record in content.get("exercises", {}).items():
            if key not in self._records or _when(record) > _when(self._records[key]):
                self._records[key] = dict(record)
        seed, when = content.get("seed", ""), content.get("seed_when", 0.0)
        if when > self._seed[1]:
            self._seed = (seed, when)

    def _read(self) -> dict[str, Any]:
        """Return the file's content, empty if there is none."""
        try:
            with self.path.open("rb") as file:
                data = file.read(LARGEST + 1)
        except FileNotFoundError:
            return {}
        content: dict[str, Any] = _parsed(data)
        if not _is_ours(content):
            raise _Damaged
        return content

    def _write(self) -> None:
        """Merge with the file and replace it; on failure say so and keep everything in memory."""
        try:
            with _lock(self.path.with_name(f".{self.path.name}.lock")):
                aside = self._merge_or_set_aside()
                self._replace(self._content())
        except OSError as error:
            self._say(
                f"Your answers are not saved: {self.path} cannot be written ({_reason(error)}). "
                "They last as long as this kernel."
            )
            return
        if aside:
            self._say(
                f"The file {self.path.name} was damaged or not ruledlab's. It was set aside as "
                f"{aside} and a new one was begun."
            )
        elif "not saved" in self.note or "cannot be read" in self.note:
            self._say("")

    def _merge_or_set_aside(self) -> str:
        try:
            self._merge(self._read())
        except _Damaged:
            return _set_aside(self.path)
        return ""

    def _content(self) -> str:
        seed, when = self._seed
        content = {"format": FORMAT, "version": VERSION, "seed": seed, "seed_when": when}
        exercises = dict(sorted(self._records.items()))
        return json.dumps({**content, "exercises": exercises}, indent=1, ensure_ascii=False)

    def _replace(self, text: str) -> None:
        """Write a file beside the old one, then put it in its place in one step."""
        target = self.path.resolve()  # a link stays a link
        handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text + "\n")
                file.flush()
                os.fsync(file.fileno())
            os.chmod(name, target.stat().st_mode & 0o777 if target.exists() else 0o644)
            os.replace(name, target)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(name)
            raise


def _when(record: Mapping[str, Any]) -> float:
    return float(record.get("when", 0.0))


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _parsed(data: bytes) -> Any:
    if len(data) > LARGEST:
        raise _Damaged
    try:
        return json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError):
        raise _Damaged from None


def _is_ours(content: Any) -> bool:
    """Whether every entry has the type it must have; a file that is half right is damaged."""
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        return False
    exercises = content.get("exercises")
    return (
        content.get("version") == VERSION
        and isinstance(content.get("seed"), str)
        and _is_time(content.get("seed_when"))
        and isinstance(exercises, dict)
        and all(isinstance(r, dict) and _is_time(r.get("when")) for r in exercises.values())
    )


def _is_time(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _set_aside(path: Path) -> str:
    """Rename the file to the first free ``….damaged-n.json`` and return that name."""
    count = 1
    while (free := path.with_name(f"{path.stem}.damaged-{count}{path.suffix}")).exists():
        count += 1
    path.rename(free)
    return free.name


# -- one writer at a time --------------------------------------------------------------------------


@contextlib.contextmanager
def _lock(path: Path) -> Iterator[None]:
    """Hold a lock that the system lets go of by itself when a process ends."""
    with path.open("a+b") as file:
        end = time.monotonic() + PATIENCE
        while not _try_lock(file):
            if time.monotonic() > end:
                raise TimeoutError(0, "another notebook has been writing for too long")
            time.sleep(0.01)
        try:
            yield
        finally:
            _unlock(file)


try:
    import fcntl

    def _try_lock(file: IO[bytes]) -> bool:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        except OSError:  # no locks on this file system; the rename alone keeps the file whole
            return True
        return True

    def _unlock(file: IO[bytes]) -> None:
        with contextlib.suppress(OSError):
            fcntl.flock(file, fcntl.LOCK_UN)

except ImportError:  # pragma: no cover - Windows
    import msvcrt

    def _try_lock(file: IO[bytes]) -> bool:
        file.seek(0)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        except OSError:
            return False
        return True

    def _unlock(file: IO[bytes]) -> None:
        file.seek(0)
        msvcrt.locking(file.fileno(), msvcrt.LK_UNLCK, 1)  # type: ignore[attr-defined]


# -- the store of this process ---------------------------------------------------------------------

_stores: list[Store] = []


def the_store() -> Store:
    """Return the store of this process, made when it is first asked for."""
    if not _stores:
        _stores.append(Store())
    return _stores[0]
