"""Types of arguments."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal, TypedDict

Styles = str | Mapping[str, float]
"""Weights by style, or a text such as `proud=0.7,old=0.2`. What the weights lack to a sum of 1 is neutral."""

Track = Iterable[tuple[float, Styles]]
"""Styles over time: pairs of a time in the input, seconds, and styles. They are interpolated between these times."""

PathLike = str | os.PathLike[str]

Progress = Callable[[str, int, int], object]
"""Called about twenty times a second with the current work, the finished and the total number of steps. An exception cancels."""


class Options(TypedDict, total=False):
    """The long options of `strut stylize` with `_` for `-`; switches are `True` and `False`, `None` leaves an option."""

    action: str | None
    input_style: str | None
    k: int | None
    lambda_: float | None
    rho: float | None
    tempo: float | None
    kappa: float | None
    delta: float | None
    coherence: bool | None
    timing: bool | None
    footplant: bool | None
    method: Literal["mar", "lar", "nn", "knn", "gar", "lti", "lti-dof", "gp"] | None
    search: str | None


class Note(TypedDict):
    """A warning about how a file was read or styled."""

    code: str
    """Code of the note; docs/reading.md lists the codes."""
    text: str
    """Message of the note."""


class TraceLine(TypedDict):
    """How a frame was computed."""

    frame: int
    """Number of the input frame at the database's rate."""
    time_in: float
    """Seconds since the first frame of the input."""
    time_out: float
    """Output time of the frame, seconds."""
    dt: float
    """Output time since the previous frame, seconds."""
    class_weights: dict[str, float]
    """Weight of every class that was used, by "action/style"."""
    neighbours: list[tuple[str, int, float]]
    """Clip, frame in the clip and distance (metres) of the neighbours in the class with the greatest weight, nearest first."""
    bias: float
    """Largest bias of a degree of freedom, standard deviations."""
    contact: tuple[float, float]
    """Probability of contact of the left and the right foot."""
    cost_us: dict[str, float]
    """Microseconds by stage."""


class EvaluateOptions(TypedDict, total=False):
    """The long options of `strut evaluate` with `_` for `-`. All combinations of the values in lists are measured."""

    pattern: str | None
    actions: Sequence[str] | str | None
    database_actions: Sequence[str] | str | None
    targets: Sequence[str] | str | None
    methods: Sequence[str] | str | None
    labels: Sequence[str] | Literal["both", "action", "style", "none"] | None
    protocol: Literal["loo", "off-database"] | None
    inputs: Sequence[PathLike] | PathLike | None
    mode: Sequence[str] | Literal["offline", "online"] | None
    registration: Sequence[str] | Literal["dtw", "imw", "linear"] | None
    takes: Sequence[int] | int | None
    window: Sequence[int] | int | None
    search: Sequence[str] | str | None
    k: Sequence[int] | int | None
    lambda_: Sequence[float] | float | None
    rho: Sequence[float] | float | None
    tempo: Sequence[float] | float | None
    kappa: Sequence[float] | float | None
    delta: Sequence[float] | float | None
    coherence: Sequence[bool] | bool | None
    intensity: Sequence[float] | float | None
    part: Sequence[str] | Literal["whole", "head", "torso", "arms", "legs"] | None
    folds: int | None
