"""What functions return as several arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Arrays(NamedTuple):
    """A motion at an even rate."""

    poses: NDArray[np.float32]
    """n × 87, in the layout of `Motion.poses`."""
    input_frame: NDArray[np.float64]
    """For each pose the fractional frame of the input it comes from."""
    rate_hz: float
    """Frames per second."""


class Styled(NamedTuple):
    """What `Stylizer.push` made of its poses."""

    poses: NDArray[np.float32]
    """n × 87, in the layout of `Motion.poses`."""
    time_out: NDArray[np.float64]
    """When each is due since the reset, seconds."""
    planted: NDArray[np.uint8]
    """n × 2: whether the left and the right foot is held in place."""
