"""How pickled databases are opened again."""

import os

from ._strut import Database


def open_database(source: str | os.PathLike[str] | bytes, sha256: str) -> Database:
    """Opens the database that was pickled; another file at its path is refused."""
    return Database.open(source, sha256=sha256)
