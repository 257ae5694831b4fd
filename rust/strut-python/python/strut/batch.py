"""Many clips in many styles, exactly once each, by any number of processes.

One process makes a `Plan`, hands its pending jobs to workers, and records how they end. A plan can be pickled:

>>> plan = strut.batch.Plan("clips/", "out/", "styles.strutdb", {"old": "elderly", "half": {"elderly": 0.5}})
>>> with multiprocessing.Pool(initializer=start, initargs=(plan,)) as workers:
...     for record in workers.imap_unordered(perform, plan.pending()):
...         plan.record([record])

The files, their keys and the manifest are those of `strut stylize-batch`: each goes on where the other was stopped.
"""

from typing import Literal, TypedDict

from ._strut import Plan
from ._types import Note

__all__ = ["Job", "Plan", "Record"]


class Job(TypedDict):
    """An input in a variant."""

    job: str
    """Path of the output in the folder of the outputs, which names the job."""
    input: str
    """Path of the input."""
    variant: str
    """Name of the variant."""


class Record(TypedDict):
    """How a job ended: a line of the manifest."""

    job: str
    key: str | None
    """SHA-256 of all that the output depends on; None if the input could not be read."""
    input: str
    input_sha256: str | None
    variant: str
    output: str
    output_sha256: str | None
    bytes: int | None
    frames: int | None
    repaired: int | None
    """Unusable frames of the input that were replaced."""
    notes: list[Note]
    """What may be wrong with the output."""
    status: Literal["done", "skipped", "failed"]
    code: Literal["bad-file", "bad-input", "io", "fault"] | None
    message: str | None
    version: str
    time_ms: int
    """When it ended, milliseconds since 1970; the plan that records it sets it."""
