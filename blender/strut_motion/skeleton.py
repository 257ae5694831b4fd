"""
Conversion between world matrices of bones and motions of a skeleton.

The frames of a motion's joints are aligned with the world at rest, so that its zero pose is the armature's rest pose, for any
bone roll.
"""

from typing import NamedTuple

import numpy as np

from .rotations import Array, about, inverse, matrices_of, multiplied, quaternions_of

SAME_PLACE = 1e-5
"""A translation that differs from the offset by less than this share of the body's height counts as the offset."""
SAME_SCALE = 0.01
"""Greatest relative difference between a bone's scale and that at rest."""
LIKELY_HEIGHTS = (0.3, 6.0)
"""Heights of bodies at rest, metres, for which the scene's unit is accepted."""


class MotionArrays(NamedTuple):
    """The array arguments of `strut.Motion.from_arrays`; +Z is up."""

    offsets: Array
    translations: Array
    rotations_xyzw: Array


def tree_of(parents: list[int], joint: int | None = None) -> list[int]:
    """
    Returns the joints of one tree in depth-first order: the tree that contains `joint`, else the largest one.

    `parents` has −1 for roots, and may be in any order.
    """
    below: list[list[int]] = [[] for _ in parents]
    roots = []
    for index, parent in enumerate(parents):
        (below[parent] if parent >= 0 else roots).append(index)

    def descend(root: int) -> list[int]:
        order, rest = [], [root]
        while rest:
            order.append(rest.pop())
            rest.extend(reversed(below[order[-1]]))
        return order

    trees = [descend(root) for root in roots]
    if joint is not None:
        return next(tree for tree in trees if joint in tree)
    return max(trees, key=len, default=[])


def rotations_of(matrices: Array) -> Array:
    """Returns the rotations of 4 × 4 matrices with uniform scale, as quaternions."""
    axes = matrices[..., :3, :3]
    return quaternions_of(axes / np.linalg.norm(axes, axis=-2, keepdims=True))


def scales_of(matrices: Array) -> Array:
    """Returns the lengths of the three axes of 4 × 4 matrices; negative for mirrored ones."""
    axes = matrices[..., :3, :3]
    sign = np.where(np.linalg.det(axes) < 0, -1.0, 1.0)
    lengths: Array = np.linalg.norm(axes, axis=-2) * sign[..., None]
    return lengths


def scaled_joints(rest: Array, world: Array) -> list[int]:
    """Returns joints that are scaled, mirrored or sheared in any frame, or mirrored at rest."""
    ratio = scales_of(world) / np.abs(scales_of(rest))
    return [int(joint) for joint in np.flatnonzero((np.abs(ratio - 1) > SAME_SCALE).any((0, 2)))]


def is_even(objects: Array) -> bool:
    """Returns whether an object's matrices, n × 4 × 4, have uniform scale and no mirroring."""
    scales = scales_of(objects)
    return bool((scales > 0).all() and (np.ptp(scales, -1) <= SAME_SCALE * scales.max(-1)).all())


def height_of(rest: Array) -> float:
    """Returns the height of the joints at rest."""
    heights = rest[:, 2, 3]
    return float(heights.max() - heights.min())


def likely_unit(rest: Array, metres_per_unit: float) -> float | None:
    """Returns the scene's metres per unit if they give the body at rest a plausible height."""
    low, high = LIKELY_HEIGHTS
    return metres_per_unit if low <= height_of(rest) * metres_per_unit <= high else None


def motion_arrays(parents: list[int], rest: Array, world: Array) -> MotionArrays:
    """
    Converts world matrices of joints at rest, j × 4 × 4, and in each frame, n × j × 4 × 4, to a motion.

    The first joint is the root, parents come first.
    """
    above = np.array([max(parent, 0) for parent in parents])
    turns = multiplied(rotations_of(world), inverse(rotations_of(rest)))
    places, rest_places = world[..., :3, 3], rest[:, :3, 3]
    offsets = rest_places - rest_places[above]
    steps = places - places[:, above]
    back = inverse(turns[:, above])
    translations = np.einsum("njab,njb->nja", matrices_of(back), steps)
    rotations = multiplied(back, turns)
    offsets[0], translations[:, 0], rotations[:, 0] = rest_places[0], places[:, 0], turns[:, 0]
    stays = (np.abs(translations - offsets) < SAME_PLACE * height_of(rest)).all((0, 2))
    translations[:, stays] = offsets[stays]
    return MotionArrays(offsets, translations, rotations)


def z_up(translations: Array, rotations: Array) -> tuple[Array, Array]:
    """Converts local transforms of a motion from +Y up to +Z up: only the root is rotated."""
    turn = about(0, np.array(np.pi / 2))
    translations, rotations = translations.copy(), rotations.copy()
    translations[:, 0] = translations[:, 0] @ matrices_of(turn).T
    rotations[:, 0] = multiplied(np.broadcast_to(turn, rotations[:, 0].shape), rotations[:, 0])
    return translations, rotations


def world_matrices(parents: list[int], rest: Array, translations: Array, rotations: Array) -> Array:
    """
    Returns world matrices, n × j × 4 × 4, without scale, of local transforms of a skeleton with this rest pose: the inverse of
    `motion_arrays`.
    """
    turns, places = rotations.copy(), translations.copy()
    for joint, parent in enumerate(parents):
        if parent >= 0:
            turns[:, joint] = multiplied(turns[:, parent], rotations[:, joint])
            places[:, joint] = places[:, parent] + np.einsum(
                "nab,nb->na", matrices_of(turns[:, parent]), translations[:, joint]
            )
    world = np.zeros((*turns.shape[:2], 4, 4))
    world[..., :3, :3] = matrices_of(multiplied(turns, rotations_of(rest)[None]))
    world[..., :3, 3] = places
    world[..., 3, 3] = 1
    return world


def in_object(objects: Array, world: Array) -> Array:
    """Converts unscaled world matrices to the space of an armature with these uniformly scaled matrices, one per frame."""
    turn = matrices_of(inverse(rotations_of(objects)))[:, None]
    scale = np.abs(scales_of(objects)[:, None, :1])
    out = world.copy()
    out[..., :3, :3] = turn @ world[..., :3, :3]
    out[..., :3, 3] = (turn @ (world[..., :3, 3] - objects[:, None, :3, 3])[..., None])[..., 0] / scale
    return out
