"""Restoring of pickled objects."""

import os
from typing import Any

from ._errors import StrutError
from ._strut import Database, Plan


def open_database(source: str | os.PathLike[str] | bytes, sha256: str) -> Database:
    """Opens a pickled database; another file at its path is refused."""
    return Database.open(source, sha256=sha256)


def open_plan(arguments: tuple[Any, ...], keywords: dict[str, Any], sha256: str) -> Plan:
    """Restores a pickled plan; one that would write other outputs is refused."""
    plan = Plan(*arguments, **keywords)
    if plan.sha256 != sha256:
        message = "the database, the table of variants or the version of Strut has changed since the batch was planned"
        raise StrutError(message, "bad-input")
    return plan
