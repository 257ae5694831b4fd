"""Armatures as arrays: the bone tree, rest poses and sampled poses."""

from typing import Any, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix

from .rotations import Array
from .skeleton import tree_of
from .styling import Problem

class Tree(NamedTuple):
    """Bones with a common root, parents first."""

    names: list[str]
    parents: list[int]
    """−1 for the root."""
    rest: Array
    """Rest matrices in armature space, j × 4 × 4."""
    places: list[int]
    """Index of each bone among the armature's bones."""

    @property
    def parent_names(self) -> dict[str, str | None]:
        """Returns the name of each bone's parent."""
        return {name: self.names[p] if p >= 0 else None for name, p in zip(self.names, self.parents, strict=True)}


class Samples(NamedTuple):
    """Matrices of the armature and its bones in every frame."""

    objects: Array
    """World matrices of the armature, n × 4 × 4."""
    poses: Array
    """Matrices of the tree's bones in armature space, n × j × 4 × 4."""


def tree(armature: Any, hips: str | None = None) -> Tree:
    """Returns the bone tree that contains the bone `hips`, or the largest one."""
    bones = list(armature.data.bones)
    index = {bone.name: i for i, bone in enumerate(bones)}
    parents = [index[bone.parent.name] if bone.parent else -1 for bone in bones]
    places = tree_of(parents, index.get(hips) if hips else None)
    if not places:
        raise Problem("This armature has no bones.")
    place_in_tree = {place: i for i, place in enumerate(places)}
    return Tree(
        [bones[place].name for place in places],
        [place_in_tree[parents[place]] if parents[place] >= 0 else -1 for place in places],
        np.array([bones[place].matrix_local for place in places]),
        places,
    )


def frame_range(scene: Any, armature: Any) -> tuple[int, int]:
    """Returns the first and the last frame to style: the preview range if it is in use, else the action's, else the scene's."""
    if scene.use_preview_range:
        return scene.frame_preview_start, scene.frame_preview_end
    data = armature.animation_data
    if data and data.action:
        first, last = data.action.frame_range
        return int(np.floor(first)), int(np.ceil(last))
    return scene.frame_start, scene.frame_end


def rate_of(scene: Any) -> float:
    """Returns the frame rate, frames per second."""
    return float(scene.render.fps / scene.render.fps_base)


class Sampler:
    """Reads an armature's poses, one frame at a time. It changes the scene's current frame, which the caller must restore."""

    def __init__(self, scene: Any, armature: Any, bones: Tree, frames: range) -> None:
        self._scene, self._armature, self._frames = scene, armature, frames
        count = len(armature.pose.bones)
        self._places = bones.places
        self._buffer = np.empty((count, 4, 4), np.float32)
        self._objects = np.empty((len(frames), 4, 4))
        self._poses = np.empty((len(frames), len(bones.places), 4, 4))

    def read(self, number: int) -> None:
        """Reads the frame with this index, from 0."""
        self._scene.frame_set(self._frames[number])
        evaluated = self._armature.evaluated_get(bpy.context.evaluated_depsgraph_get())
        evaluated.pose.bones.foreach_get("matrix", self._buffer.reshape(-1))
        # Blender stores matrices column by column.
        self._poses[number] = self._buffer[self._places].swapaxes(-1, -2)
        self._objects[number] = evaluated.matrix_world

    @property
    def samples(self) -> Samples:
        """Returns all frames that were read."""
        return Samples(self._objects, self._poses)


def moved_by_constraint(armature: Any, bones: set[str]) -> tuple[str, str] | None:
    """Returns the first of these bones that a constraint moves, and the constraint's name."""
    for bone in armature.pose.bones:
        if bone.name in bones:
            for constraint in bone.constraints:
                if not constraint.mute and constraint.influence > 0:
                    return bone.name, constraint.name
    return None


def has_default_inheritance(bone: Any) -> bool:
    """Returns whether a bone's channels are relative to its parent and its own rest pose."""
    return bool(bone.use_inherit_rotation and bone.use_local_location)


def converted(bone: Any, poses: Array, parent_poses: Array | None) -> Array:
    """Returns the result of `keys.basis_matrices` for bones with other inheritance settings, by Blender's own rules."""
    out = np.empty_like(poses)
    for number, pose in enumerate(poses):
        above = {}
        if parent_poses is not None:
            above = {"parent_matrix": Matrix(parent_poses[number]), "parent_matrix_local": bone.parent.matrix_local}
        out[number] = bone.convert_local_to_pose(Matrix(pose), bone.matrix_local, invert=True, **above)
    return out
