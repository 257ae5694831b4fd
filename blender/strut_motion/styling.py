"""Styling on a thread: calls of the engine, progress, cancellation, and errors as sentences."""

import threading
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from .skeleton import MotionArrays


class Problem(Exception):
    """An error with a sentence for the panel."""


class Cancelled(Exception):
    """Styling was cancelled."""


class Request(NamedTuple):
    """All inputs of the styling, without Blender objects, so that it can be used on any thread."""

    names: list[str]
    parents: list[int]
    arrays: MotionArrays
    rate_hz: float
    metres_per_unit: float | None
    roles: Mapping[str, str | None] | None
    open_database: Callable[[], Any]
    styles: Mapping[str, float]
    parts: Mapping[str, Mapping[str, float]] | None
    options: Mapping[str, Any]


class Result(NamedTuple):
    """A styled motion, and how the skeleton was read."""

    bvh: str
    roles: dict[str, str]
    note: str


def engine() -> Any:
    """Returns the package `strut`, which is part of the extension."""
    try:
        import strut
    except ImportError as error:
        raise Problem("The engine is missing. Install the extension again from its file for this system.") from error
    return strut


def sentence(error: BaseException) -> str:
    """Returns an error as a sentence for users."""
    strut = engine()
    if isinstance(error, strut.StrutError):
        parts = [error.message, error.hint]
    elif isinstance(error, OSError) and error.filename:
        parts = [f"{error.strerror}: {error.filename}"]
    else:
        parts = [str(error) or type(error).__name__]
    sentences = (part.strip() for part in parts if part)
    return " ".join(f"{text[:1].upper()}{text[1:]}{'' if text.endswith(('.', '!', '?')) else '.'}" for text in sentences)


def motion_of(request: Request) -> Any:
    """Returns the motion of a request. Raises the engine's exceptions."""
    offsets, translations, rotations = (np.ascontiguousarray(a, np.float32) for a in request.arrays)
    return engine().Motion.from_arrays(
        request.names,
        request.parents,
        offsets,
        translations,
        rotations,
        request.rate_hz,
        up="z",
        metres_per_unit=request.metres_per_unit,
        roles=request.roles,
    )


def style(request: Request, progress: Callable[[str, int, int], object] | None = None) -> Result:
    """Styles the motion of a request. Raises exceptions of the engine and of `progress`."""
    database = request.open_database()
    motion = motion_of(request)
    styled = engine().stylize(
        motion, database, dict(request.styles), parts=request.parts, progress=progress, **request.options
    )
    return Result(styled.to_bvh(), motion.roles, motion.note)


class Job:
    """Styling on a separate thread."""

    def __init__(self, request: Request) -> None:
        self._request = request
        self._cancelled = threading.Event()
        self._result: Result | None = None
        self._error: BaseException | None = None
        self._share = 0.0
        self._thread = threading.Thread(target=self._run, name="strut", daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._result = style(self._request, self._progress)
        except BaseException as error:  # The thread that asks for the result has it.
            self._error = error

    def _progress(self, _what: str, done: int, total: int) -> None:
        self._share = done / max(total, 1)
        if self._cancelled.is_set():
            raise Cancelled

    @property
    def share(self) -> float:
        """Returns the progress, 0 to 1."""
        return self._share

    @property
    def is_done(self) -> bool:
        """Returns whether the thread has ended."""
        return not self._thread.is_alive()

    def cancel(self) -> None:
        """Requests that the thread ends soon."""
        self._cancelled.set()

    def result(self) -> Result:
        """Waits for the end and returns the result. Raises `Cancelled`, or `Problem` with a sentence."""
        self._thread.join()
        if isinstance(self._error, Cancelled):
            raise self._error
        if self._error is not None:
            raise self._error if isinstance(self._error, Problem) else Problem(sentence(self._error)) from self._error
        if self._cancelled.is_set():
            raise Cancelled
        assert self._result is not None
        return self._result
