"""Motion style transfer on BVH files and numpy arrays.

>>> import strut
>>> db = strut.Database.open("styles.strutdb")
>>> walk = strut.Motion.open("walk.bvh")
>>> strut.stylize(walk, db, {"elderly": 0.7}).save("walk-elderly.bvh")
"""

from . import metrics
from ._arrays import Arrays, Styled
from ._errors import StrutError
from ._many import stylize_many
from ._strut import Database, Motion, StyledMotion, Stylizer, stylize
from ._types import Options
from .metrics import positions

__all__ = [
    "Arrays",
    "Database",
    "Motion",
    "Options",
    "StrutError",
    "Styled",
    "StyledMotion",
    "Stylizer",
    "metrics",
    "positions",
    "stylize",
    "stylize_many",
]
