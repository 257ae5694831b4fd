"""Results that consist of several arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Arrays(NamedTuple):
    """A motion at a constant rate."""

    poses: NDArray[np.float32]
    """n × 87, in the layout of `Motion.poses`."""
    input_frame: NDArray[np.float64]
    """Fractional frame of the input for each pose."""
    rate_hz: float
    """Frames per second."""


class Styled(NamedTuple):
    """Result of `Stylizer.push` for its poses."""

    poses: NDArray[np.float32]
    """n × 87, in the layout of `Motion.poses`."""
    time_out: NDArray[np.float64]
    """Output time of each pose since the reset, seconds."""
    planted: NDArray[np.uint8]
    """n × 2: whether the left and the right foot is held in place."""
