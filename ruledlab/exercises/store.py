"""What a student has answered, kept in one JSON file beside the lessons.

Every write reads the file first and merges: of each exercise the newer entry wins, and a change is
made to what the merge gave, so two notebooks that are open at once do not lose each other's answers
and a clock that is put back loses none. The file is replaced whole, by a rename inside its
directory, so a crash leaves the old one or the new one. A file that cannot be read is set aside
under another name, never overwritten.
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

from ..geometry.checks import GeometryError

__all__ = ["FILE", "Store", "the_store"]

FILE = "ruledlab-progress.json"
FORMAT = "ruledlab progress"
VERSION = 1
LARGEST = 20_000_000
PATIENCE = 5.0
"""Seconds to wait while another notebook writes."""

LONGEST_SEED = 200
LAST_TIME = 1e11
"""Seconds since 1970 that no clock shows; a later time in a file is no time."""

Record = dict[str, Any]
Disconnect = Callable[[], None]


class _Damaged(Exception):
    """The file is there, but it is not a progress file."""

    mark = "damaged"
    what = "was damaged or not ruledlab's"


class _Newer(_Damaged):
    """The file is a progress file of a version that is not known here."""

    mark = "newer"
    what = "was written by a newer version of ruledlab"


class Store:
    """Answers, hints used and designs of one student.

    Parameters
    ----------
    path
        the file; it is made with the first answer.
    """

    def __init__(self, path: str | os.PathLike[str] = FILE) -> None:
        self.path = Path(path).absolute()
        self._aside = self._trouble = ""
        self._mutex = threading.RLock()
        self._records: dict[str, Record] = {}
        self._seed: tuple[str, float] = ("", 0.0)
        self._followers: list[Callable[[str], None]] = []
        self.refresh()

    @property
    def note(self) -> str:
        """What the reader should know about the file: set aside, not writable; usually empty."""
        return " ".join(filter(None, (self._aside, self._trouble)))

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
                self._write(lambda: None)  # it sets the file aside, under the lock
            except OSError as error:
                self._trouble = f"The file {self.path.name} cannot be read ({_reason(error)})."

    # -- writing ---------------------------------------------------------------------------------

    def update(self, key: str, **entries: Any) -> Record:
        """Change entries of an exercise's record, save, and return the record."""
        return self.change(key, lambda old: entries)

    def change(self, key: str, entries: Callable[[Record], Mapping[str, Any]]) -> Record:
        """Change entries that depend on those there are, save, and return the record.

        Parameters
        ----------
        key
            the exercise.
        entries
            given a copy of the record, other notebooks' changes included, the new entries.

        Raises
        ------
        TypeError, ValueError
            if JSON cannot hold them; then nothing is changed.
        """

        def put() -> None:
            old = self._records.get(key, {})
            new = {**old, **entries(dict(old)), "when": _after(_when(old))}
            self._records[key] = json.loads(json.dumps(new, allow_nan=False))

        with self._mutex:
            self._write(put)
        self._tell(key)
        return self.record(key)

    def set_seed(self, seed: object) -> None:
        """Set the student's seed: a name or a number.

        Raises
        ------
        GeometryError
            if it is too long to be one.
        """
        text = " ".join(str(seed).split())
        if len(text) > LONGEST_SEED:
            raise GeometryError(
                f"`seed` must be a name or a number of at most {LONGEST_SEED} characters; "
                f"got {len(text)}"
            )

        def put() -> None:
            self._seed = (text, _after(self._seed[1]))

        with self._mutex:
            self._write(put)
        self._tell("")

    # -- inside ----------------------------------------------------------------------------------

    def _tell(self, key: str) -> None:
        for callback in tuple(self._followers):
            callback(key)

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
        if _is_newer(content):
            raise _Newer
        if not _is_ours(content):
            raise _Damaged
        return content

    def _write(self, change: Callable[[], None]) -> None:
        """Merge with the file, change what is known and replace the file.

        On failure it is said, and everything is kept in memory.
        """
        changed = False
        try:
            with _lock(self.path.with_name(f".{self.path.name}.lock")):
                self._merge_or_set_aside()
                change()
                changed = True
                self._replace(self._content())
        except OSError as error:
            if not changed:
                change()
            self._trouble = (
                f"Your answers are not saved: {self.path} cannot be written ({_reason(error)}). "
                "They last as long as this kernel."
            )
        else:
            self._trouble = ""

    def _merge_or_set_aside(self) -> None:
        try:
            self._merge(self._read())
        except _Damaged as found:
            aside = _set_aside(self.path, found.mark)
            self._aside = (
                f"The file {self.path.name} {found.what}. It was set aside as {aside} and a new "
                "one was begun."
            )

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
            # half a surrogate pair, which UTF-8 cannot hold, becomes JSON's escape
            with os.fdopen(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
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


def _after(when: float) -> float:
    """Return the time; or if the clock was put back, just after what was written last."""
    return max(time.time(), math.nextafter(when, math.inf))


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _parsed(data: bytes) -> Any:
    if len(data) > LARGEST:
        raise _Damaged
    try:
        return json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError):
        raise _Damaged from None


def _is_newer(content: Any) -> bool:
    version = content.get("version") if isinstance(content, dict) else None
    return isinstance(version, int) and version > VERSION and content.get("format") == FORMAT


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
        and all(map(_is_record, exercises.values()))
    )


def _is_record(record: Any) -> bool:
    """Whether the entries that are counted and compared have their types; answers may be any."""
    return (
        isinstance(record, dict)
        and _is_time(record.get("when"))
        and all(type(record.get(name, 0)) is int for name in ("hints", "tries"))
        and all(type(record.get(name, True)) is bool for name in ("right", "solution"))
        and all(type(record.get(name, "")) is str for name in ("seed", "slip"))
    )


def _is_time(value: Any) -> bool:
    return type(value) in (int, float) and 0 <= value < LAST_TIME


def _set_aside(path: Path, mark: str) -> str:
    """Rename the file to the first free ``….damaged-n.json`` and return that name."""
    count = 1
    while os.path.lexists(free := path.with_name(f"{path.stem}.{mark}-{count}{path.suffix}")):
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
