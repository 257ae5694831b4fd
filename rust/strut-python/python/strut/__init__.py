"""Motion style transfer on BVH files and numpy arrays.

>>> import strut
>>> db = strut.Database.open("styles.strutdb")
>>> walk = strut.Motion.open("walk.bvh")
>>> strut.stylize(walk, db, {"elderly": 0.7}).save("walk-elderly.bvh")
"""

from . import batch, metrics
from ._arrays import Arrays, Styled
from ._errors import StrutError
from ._many import stylize_many
from ._strut import Database, KeyStyleModel, Motion, StyledMotion, Stylizer, Walker, WalkModel, evaluate, stylize
from ._types import EvaluateOptions, Note, Options, TraceLine
from .metrics import positions

__all__ = [
    "Arrays",
    "Database",
    "EvaluateOptions",
    "KeyStyleModel",
    "Motion",
    "Note",
    "Options",
    "StrutError",
    "Styled",
    "StyledMotion",
    "Stylizer",
    "TraceLine",
    "WalkModel",
    "Walker",
    "batch",
    "evaluate",
    "metrics",
    "positions",
    "stylize",
    "stylize_many",
]
