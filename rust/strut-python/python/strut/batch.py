"""Styles many clips in many styles, exactly once each, with any number of processes.

One process creates a `Plan`, passes its pending jobs to workers, and records how they end. A plan can be pickled:

>>> plan = strut.batch.Plan("clips/", "out/", "styles.strutdb", {"old": "elderly", "half": {"elderly": 0.5}})
>>> with multiprocessing.Pool(initializer=start, initargs=(plan,)) as workers:
...     for record in workers.imap_unordered(perform, plan.pending()):
...         plan.record([record])

The files, their keys and the manifest are those of `strut stylize-batch`: a batch of either can be continued by the other.
"""

from typing import Literal, TypedDict

from ._strut import Plan
from ._types import Note

__all__ = ["Job", "Plan", "Record"]


class Job(TypedDict):
    """An input in a variant."""

    job: str
    """Path of the output, relative to the output folder. It names the job."""
    input: str
    """Path of the input."""
    variant: str
    """Name of the variant."""


class Record(TypedDict):
    """Record of how a job ended: a line of the manifest."""

    job: str
    key: str | None
    """SHA-256 of everything that the output depends on; None if the input could not be read."""
    input: str
    input_sha256: str | None
    variant: str
    output: str
    output_sha256: str | None
    bytes: int | None
    frames: int | None
    repaired: int | None
    """Number of unusable input frames that were replaced."""
    notes: list[Note]
    """Warnings about the output."""
    status: Literal["done", "skipped", "failed"]
    code: Literal["bad-file", "bad-input", "io", "fault"] | None
    message: str | None
    version: str
    time_ms: int
    """When the job ended, milliseconds since 1970; set by the plan that records it."""
