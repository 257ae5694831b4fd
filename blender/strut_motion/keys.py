"""Poses of an armature as values of F-curves: transforms of bones relative to rest pose and parent, per channel."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .rotations import (
    Array,
    EULER_ORDERS,
    axis_angles_of,
    continuous_euler,
    continuous_quaternions,
    euler_of,
    quaternions_of,
)


class Channel(NamedTuple):
    """The keys of one F-curve, one per frame."""

    bone: str
    property: str
    """Name of the property of the pose bone: location, rotation_quaternion, rotation_euler or rotation_axis_angle."""
    axis: int
    """Index of the component of that property."""
    values: Array


def basis_matrices(rest: Array, parent_rest: Array | None, pose: Array, parent_pose: Array | None) -> Array:
    """
    Returns the transform of a pose bone by its own channels, from its rest matrix in armature space, 4 × 4, and its pose
    matrices, n × 4 × 4, and those of its parent. Requires bones that inherit location, rotation and scale, which is Blender's
    default.
    """
    offset = rest if parent_rest is None else np.linalg.inv(parent_rest) @ rest
    local = pose if parent_pose is None else np.linalg.inv(parent_pose) @ pose
    basis: Array = np.linalg.inv(offset) @ local
    return basis


def rotation_channels(bone: str, mode: str, basis: Array) -> Iterator[Channel]:
    """Yields the rotation of a bone in its rotation mode, continuous from frame to frame."""
    axes = basis[:, :3, :3]
    if mode in EULER_ORDERS:
        name, values = "rotation_euler", continuous_euler(euler_of(axes, mode), mode)
    else:
        q = continuous_quaternions(quaternions_of(axes))
        # Blender's order is w first.
        name, values = "rotation_quaternion", q[:, [3, 0, 1, 2]]
        if mode == "AXIS_ANGLE":
            name, values = "rotation_axis_angle", axis_angles_of(q)
    for index in range(values.shape[1]):
        yield Channel(bone, name, index, values[:, index])


def location_channels(bone: str, basis: Array) -> Iterator[Channel]:
    """Yields the location of a bone."""
    for index in range(3):
        yield Channel(bone, "location", index, basis[:, index, 3])


def key_points(first_frame: float, values: Array) -> NDArray[np.float32]:
    """Returns the values for `foreach_set("co", …)`: frame and value of each key in turn, one key per frame."""
    frames = first_frame + np.arange(len(values))
    return np.stack([frames, values], -1).astype(np.float32).ravel()
