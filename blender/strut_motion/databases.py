"""Databases of styles. Each is opened once while its file is unchanged."""

import os
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from .styling import engine

BUILT_IN = ""
"""The path that stands for the built-in database."""


class Stamp(NamedTuple):
    """Identity of a file: shows whether it is still the one that was opened."""

    path: str
    size: int
    changed_ns: int


kept_in: Path | None = None
"""Folder in which the built-in database is cached as a file, since it takes seconds to make; None keeps it only in memory."""

_opened: tuple[Stamp, Any] | None = None


def _stamp(path: str) -> Stamp:
    if path == BUILT_IN:
        return Stamp(path, 0, 0)
    status = os.stat(path)
    return Stamp(path, status.st_size, status.st_mtime_ns)


def open_database(path: str) -> Any:
    """
    Returns the database in a file, or the built-in one for `BUILT_IN`. Only the latest is kept in memory. Thread-safe.

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
    """Returns the built-in database, from its cache file if that is of this version. Without a cache folder it is made again."""
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
    """Frees the memory of the open database."""
    global _opened
    _opened = None
