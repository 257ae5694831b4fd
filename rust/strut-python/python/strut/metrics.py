"""Measures of motions, on a database's body and at its rate.

Poses are C-contiguous float32 with 87 columns, in the layout of `Motion.poses`.
"""

from ._strut import foot_skate, mean_acceleration, mean_jerk, pose_error, positions

__all__ = ["foot_skate", "mean_acceleration", "mean_jerk", "pose_error", "positions"]
