"""Rotations as arrays: matrices, quaternions (x y z w), Euler angles. All functions accept any number of leading axes."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EULER_ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")


def multiplied(a: Array, b: Array) -> Array:
    """Returns the quaternion of rotation b followed by rotation a."""
    vector = a[..., 3:] * b[..., :3] + b[..., 3:] * a[..., :3] + np.cross(a[..., :3], b[..., :3])
    scalar = a[..., 3:] * b[..., 3:] - (a[..., :3] * b[..., :3]).sum(-1, keepdims=True)
    product: Array = np.concatenate([vector, scalar], -1)
    return product


def inverse(q: Array) -> Array:
    """Returns the inverse of a unit quaternion."""
    return q * np.array([-1.0, -1.0, -1.0, 1.0])


def matrices_of(q: Array) -> Array:
    """Converts unit quaternions to 3 × 3 matrices."""
    x, y, z, w = np.moveaxis(q, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def quaternions_of(matrices: Array) -> Array:
    """Converts 3 × 3 rotation matrices to unit quaternions with w ≥ 0."""
    m = matrices
    diagonal = np.moveaxis(np.diagonal(m, axis1=-2, axis2=-1), -1, 0)
    trace = diagonal.sum(0)
    # Four times the products of the largest component with all four (Shepperd's method); the largest avoids cancellation.
    products = np.empty((*m.shape[:-2], 4, 4))
    for i in range(3):
        products[..., i, i] = 1 + 2 * diagonal[i] - trace
    products[..., 3, 3] = 1 + trace
    for i, j in ((0, 1), (0, 2), (1, 2)):
        products[..., i, j] = products[..., j, i] = m[..., i, j] + m[..., j, i]
        k = 3 - i - j
        sign = 1 if (i, j) != (0, 2) else -1
        products[..., k, 3] = products[..., 3, k] = sign * (m[..., j, i] - m[..., i, j])
    largest = np.diagonal(products, axis1=-2, axis2=-1).argmax(-1)
    rows = np.take_along_axis(products, largest[..., None, None], -2)[..., 0, :]
    q: Array = rows / np.linalg.norm(rows, axis=-1, keepdims=True)
    return np.where(q[..., 3:] < 0, -q, q)


def about(axis: int, angles: Array) -> Array:
    """Returns the quaternions of rotations about a coordinate axis, radians."""
    q = np.zeros((*np.shape(angles), 4))
    q[..., axis], q[..., 3] = np.sin(np.asarray(angles) / 2), np.cos(np.asarray(angles) / 2)
    return q


def euler_of(matrices: Array, order: str) -> Array:
    """
    Returns Euler angles about x, y and z, radians, of rotation matrices; the middle angle is within a quarter turn.

    Blender's order "XYZ" turns about X first, then Y, then Z.
    """
    i, j, k = ("XYZ".index(axis) for axis in order)
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    m = matrices
    angles = np.empty(m.shape[:-1])
    middle = np.hypot(m[..., i, i], m[..., j, i])
    angles[..., j] = np.arctan2(-sign * m[..., k, i], middle)
    # The first angle is 0 at the poles, where only the sum of the other two is determined.
    pole = middle < 1e-9
    angles[..., i] = np.where(pole, 0.0, np.arctan2(sign * m[..., k, j], m[..., k, k]))
    last = np.arctan2(sign * m[..., j, i], m[..., i, i])
    angles[..., k] = np.where(pole, np.arctan2(-sign * m[..., i, j], m[..., j, j]), last)
    return angles


def continuous_euler(angles: Array, order: str, before: Array | None = None) -> Array:
    """
    Returns the same rotations with angles that are continuous along the first axis: of the two equivalent triples, and of all
    turns by 360°, those nearest to the previous angles, which start with `before`.
    """
    j = "XYZ".index(order[1])
    others = [axis for axis in range(3) if axis != j]
    out = angles.copy()
    for n in range(len(out)):
        if n == 0 and before is None:
            continue
        last = out[n - 1] if n > 0 else before
        assert last is not None
        twin = out[n].copy()
        twin[..., j] = np.pi - twin[..., j]
        twin[..., others] += np.pi
        candidates = np.stack([out[n], twin])
        candidates -= 2 * np.pi * np.round((candidates - last) / (2 * np.pi))
        nearer = np.abs(candidates - last).sum(-1).argmin(0)
        out[n] = np.take_along_axis(candidates, nearer[None, ..., None], 0)[0]
    return out


def continuous_quaternions(q: Array) -> Array:
    """Returns the same rotations with signs that make each quaternion nearer to the previous one, along the first axis."""
    dots = (q[1:] * q[:-1]).sum(-1)
    signs = np.cumprod(np.concatenate([np.ones_like(dots[:1]), np.where(dots < 0, -1.0, 1.0)]), 0)
    return q * signs[..., None] if len(q) > 1 else q


def axis_angles_of(q: Array) -> Array:
    """Converts quaternions to angle, then axis, in Blender's order; the identity has the axis +Y."""
    length = np.linalg.norm(q[..., :3], axis=-1, keepdims=True)
    axis = np.where(length > 1e-12, q[..., :3] / np.maximum(length, 1e-12), np.array([0.0, 1.0, 0.0]))
    return np.concatenate([2 * np.arctan2(length, q[..., 3:]), axis], -1)
