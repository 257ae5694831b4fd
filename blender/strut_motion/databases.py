"""Databases of styles, each opened once while its file stays the same."""

import os
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from .styling import engine

BUILT_IN = ""
"""The path that means the engine's own motions."""


class Stamp(NamedTuple):
    """What tells whether a file is still the one that was opened."""

    path: str
    size: int
    changed_ns: int


kept_in: Path | None = None
"""The folder where the built-in database is kept as a file, as it takes seconds to make; None keeps it in memory alone."""

_opened: tuple[Stamp, Any] | None = None


def _stamp(path: str) -> Stamp:
    if path == BUILT_IN:
        return Stamp(path, 0, 0)
    status = os.stat(path)
    return Stamp(path, status.st_size, status.st_mtime_ns)


def open_database(path: str) -> Any:
    """
    The database in a file, the built-in one for `BUILT_IN`. The latest is kept: only one is in memory, and any thread may ask.

    Raises `OSError` or `strut.StrutError`.
    """
    global _opened
    stamp = _stamp(path)
    kept = _opened
    if kept is not None and kept[0] == stamp:
        return kept[1]
    database = _built_in() if path == BUILT_IN else engine().Database.open(path)
    _opened = (stamp, database)
    return database


def _built_in() -> Any:
    """The built-in database, from its file where there is one of this version. Without a place to write it is made anew."""
    database = engine().Database
    if kept_in is None:
        return database.demo()
    file = kept_in / f"built-in-{version('strut-motion')}.strutdb"
    try:
        return database.open(file)
    except (OSError, engine().StrutError):
        made = database.demo()
    try:
        for older in kept_in.glob("built-in-*.strutdb"):
            older.unlink()
        made.save(file)
    except OSError:
        pass
    return made


def forget() -> None:
    """Frees the memory of the database that is kept."""
    global _opened
    _opened = None
