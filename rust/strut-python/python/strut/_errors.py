"""The exception of this package."""

from typing import Literal


class StrutError(Exception):
    """An error of a file or an argument, with a message of one sentence.

    For I/O errors an `OSError` is raised instead.
    """

    code: Literal["bad-file", "bad-input", "cancelled", "fault"]
    """Code of the error."""
    message: str
    """The message, one sentence."""
    hint: str | None
    """How to solve the problem."""

    def __init__(self, message: str, code: Literal["bad-file", "bad-input", "cancelled", "fault"] = "fault", hint: str | None = None) -> None:
        super().__init__(message, code, hint)
        self.message = message
        self.code = code
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message}; {self.hint}" if self.hint else self.message
