"""Many motions."""

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
    """Gives motions another style, several at once, in their order.

    A motion that cannot be styled has its error in its place. `threads` is one a processor for 0; the results do not depend on
    it. Few motions are held at a time, so they may come from a generator that opens them.
    """
    return StyledMotions(motions, db, styles, parts=parts, threads=threads, **options)
