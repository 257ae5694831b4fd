"""The exception of this package."""

from typing import Literal


class StrutError(Exception):
    """What is wrong with a file or an argument, in a sentence.

    Where the system cannot read or write, an `OSError` is raised instead.
    """

    code: Literal["bad-file", "bad-input", "cancelled", "fault"]
    """Kind of the error."""
    message: str
    """The sentence."""
    hint: str | None
    """What to do about it."""

    def __init__(self, message: str, code: Literal["bad-file", "bad-input", "cancelled", "fault"] = "fault", hint: str | None = None) -> None:
        super().__init__(message, code, hint)
        self.message = message
        self.code = code
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message}; {self.hint}" if self.hint else self.message
