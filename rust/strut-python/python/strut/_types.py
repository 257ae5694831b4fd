"""Types of arguments."""

import os
from collections.abc import Callable, Mapping
from typing import Literal, TypedDict

Styles = str | Mapping[str, float]
"""Weights by style, or a text such as `proud=0.7,old=0.2`. What lacks to a sum of 1 is neutral."""

PathLike = str | os.PathLike[str]

Progress = Callable[[str, int, int], object]
"""Called about twenty times a second with what is done, and how many steps of how many. An exception cancels."""


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
