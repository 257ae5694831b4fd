"""Styling of many motions."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Unpack

from ._errors import StrutError
from ._strut import Database, Motion, StyledMotion, StyledMotions
from ._types import Options, Styles


def stylize_many(
    motions: Iterable[Motion],
    db: Database,
    styles: Styles,
    *,
    parts: Mapping[str, Styles] | None = None,
    threads: int = 0,
    **options: Unpack[Options],
) -> Iterator[StyledMotion | StrutError]:
    """Changes the style of motions, several at once, in their order.

    A motion that cannot be styled is replaced by its error. With `threads` 0 there is one thread per processor; the results do
    not depend on the number. Few motions are held in memory at a time, so they may come from a generator that opens them.
    """
    return StyledMotions(motions, db, styles, parts=parts, threads=threads, **options)
