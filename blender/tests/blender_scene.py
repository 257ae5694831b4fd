"""Scenes for tests: a BVH imported by Blender, rigs that perform a motion, and the motion of an armature as arrays."""

import json
import struct
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import strut
import strut_motion
from strut_motion import armature as rig
from strut_motion import bvh, curves, keys, skeleton
from strut_motion.rotations import about, inverse, matrices_of, multiplied

strut_motion.register()

Z_UP = about(0, np.array(np.pi / 2))
RATE_HZ, SECS = 30, 4
"""Frame rate and duration of the rigs' motions."""
HUMANOID_PARENTS = [-1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19]


def in_z_up(q: np.ndarray) -> np.ndarray:
    """Converts rotations from a world with +Y up to one with +Z up."""
    return multiplied(multiplied(np.broadcast_to(Z_UP, q.shape), q), np.broadcast_to(inverse(Z_UP), q.shape))


def empty_scene(database: Path) -> Any:
    """Creates an empty scene with an open database."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    settings = bpy.context.scene.strut_motion
    settings.source = "FILE"
    settings.path = str(database)
    assert len(settings.styles) > 0, bpy.context.window_manager.strut_motion.message
    return settings


def import_bvh(path: Path, scale: float = 0.01) -> Any:
    """Imports an armature with the motion of a file in centimetres."""
    bpy.ops.import_anim.bvh(filepath=str(path), global_scale=scale, update_scene_fps=True, update_scene_duration=True)
    return bpy.context.active_object


def world_turns(parents: list[int], rotations: np.ndarray) -> np.ndarray:
    """Converts local to world rotations."""
    world = rotations.copy()
    for joint, parent in enumerate(parents):
        if parent >= 0:
            world[:, joint] = multiplied(world[:, parent], rotations[:, joint])
    return world


def bind_rotations(glb: bytes) -> dict[str, np.ndarray]:
    """Returns the world rotations of the nodes of a GLB, +Y up."""
    (length,) = struct.unpack_from("<I", glb, 12)
    nodes = json.loads(glb[20 : 20 + length])["nodes"]
    parents = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}

    def world(i: int) -> np.ndarray:
        own = np.array(nodes[i].get("rotation", [0, 0, 0, 1]), float)
        return multiplied(world(parents[i]), own) if i in parents else own

    return {node["name"]: world(i) for i, node in enumerate(nodes)}


def import_rig(folder: Path, about_it: dict, motion: strut.Motion, database: strut.Database) -> Any:
    """Imports a rig that performs a motion: every joint rotates from the T-pose as the humanoid's does, and the hips move."""
    file = folder / about_it["file"]
    bpy.ops.import_scene.gltf(filepath=str(file))
    armature = next(o for o in bpy.context.scene.objects if o.type == "ARMATURE")
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = RATE_HZ, 1
    step = round(database.rate_hz) // RATE_HZ
    poses = motion.poses(database).astype(float)[: SECS * RATE_HZ * step : step]
    roles = list(about_it["joints"])
    local = poses[:, 3:].reshape(len(poses), len(roles), 4)
    turns = world_turns(HUMANOID_PARENTS, local)
    bind = bind_rotations(file.read_bytes())
    tree = rig.tree(armature, about_it["joints"]["hips"])
    rest = np.array(armature.matrix_world) @ tree.rest
    target: dict[int, np.ndarray] = {}
    for i, role in enumerate(roles):
        name = about_it["joints"][role]
        from_bind = multiplied(np.array(about_it["rest"][role]), inverse(bind[name]))
        turn = multiplied(turns[:, i], np.broadcast_to(from_bind, turns[:, i].shape))
        target[tree.names.index(name)] = in_z_up(turn)
    rotations = np.zeros((len(poses), len(tree.names), 4))
    rotations[..., 3] = 1
    world = rotations.copy()
    for joint, parent in enumerate(tree.parents):
        above = world[:, parent] if parent >= 0 else np.broadcast_to([0.0, 0, 0, 1], world[:, 0].shape)
        world[:, joint] = target.get(joint, above)
        rotations[:, joint] = multiplied(inverse(above), world[:, joint])
    arrays = skeleton.motion_arrays(tree.parents, rest, rest[None])
    translations = np.tile(arrays.offsets, (len(poses), 1, 1))
    hips = tree.names.index(about_it["joints"]["hips"])
    place = poses[:, :3] @ matrices_of(Z_UP).T * about_it["legRatio"]
    # Joints above the hips do not move and are not rotated at rest.
    translations[:, hips] = place - (rest[tree.parents[hips], :3, 3] if hips else 0)
    matrices = skeleton.world_matrices(tree.parents, rest, translations, rotations)
    objects = np.broadcast_to(np.array(armature.matrix_world), (len(poses), 4, 4))
    in_armature = skeleton.in_object(objects, matrices)
    channels = []
    for joint, (name, parent) in enumerate(zip(tree.names, tree.parents, strict=True)):
        if joint not in target:
            continue
        above = (tree.rest[parent], in_armature[:, parent]) if parent >= 0 else (None, None)
        basis = keys.basis_matrices(tree.rest[joint], above[0], in_armature[:, joint], above[1])
        if joint == hips:
            channels.extend(keys.location_channels(name, basis))
        channels.extend(keys.rotation_channels(name, armature.pose.bones[name].rotation_mode, basis))
    action, slot = curves.new_action("walk", armature)
    curves.write_channels(curves.curves_of(action, slot), 1, channels)
    curves.assign(armature.animation_data or armature.animation_data_create(), action, slot)
    bpy.context.view_layer.objects.active = armature
    return armature


def sampled(armature: Any) -> tuple[rig.Tree, np.ndarray, np.ndarray]:
    """Returns the tree of an armature, its world matrices at rest, and those in every frame of its action."""
    scene = bpy.context.scene
    tree = rig.tree(armature)
    first, last = rig.frame_range(scene, armature)
    before = scene.frame_current
    sampler = rig.Sampler(scene, armature, tree, range(first, last + 1))
    for number in range(last - first + 1):
        sampler.read(number)
    scene.frame_set(before)
    samples = sampler.samples
    return tree, samples.objects[0] @ tree.rest, samples.objects[:, None] @ samples.poses


def turns_from_rest(rest: np.ndarray, world: np.ndarray) -> np.ndarray:
    """Returns world rotations relative to rest."""
    return multiplied(skeleton.rotations_of(world), inverse(skeleton.rotations_of(rest)))


def degrees_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns the angles between rotations, degrees."""
    sine = np.linalg.norm(multiplied(inverse(a), b)[..., :3], axis=-1)
    return np.degrees(2 * np.arcsin(np.minimum(1, sine)))


def styled(
    tree: rig.Tree, arrays: list[np.ndarray], rate_hz: float, database: strut.Database, styles: dict[str, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Returns the engine's result for a motion with +Z up: world rotations and positions of the tree's joints."""
    a = [np.ascontiguousarray(x, np.float32) for x in arrays]
    motion = strut.Motion.from_arrays(tree.names, tree.parents, *a, rate_hz, up="z", metres_per_unit=1.0)
    clip = bvh.read(strut.stylize(motion, database, styles).to_bvh())
    translations, rotations = skeleton.z_up(clip.translations, clip.rotations)
    order = [clip.names.index(name) for name in tree.names]
    return world_of(clip.parents, translations, rotations, order)


def world_of(parents: list[int], translations: np.ndarray, rotations: np.ndarray, order: list[int]) -> tuple:
    """Returns world rotations and positions of these joints, from local transforms."""
    aligned = np.broadcast_to(np.eye(4), (len(parents), 4, 4))
    world = skeleton.world_matrices(parents, aligned, translations, rotations)
    return world_turns(parents, rotations)[:, order], world[:, order][..., :3, 3]


def exported(armature: Any, action: Any, folder: Path) -> bvh.Clip:
    """Returns the motion of an armature with an action, exported by Blender's own exporter."""
    curves.assign(armature.animation_data, action, action.slots[0] if curves.has_slots() else None)
    path = folder / "exported.bvh"
    first, last = rig.frame_range(bpy.context.scene, armature)
    bpy.ops.export_anim.bvh(
        filepath=str(path), frame_start=first, frame_end=last, rotate_mode="ZXY", root_transform_only=False
    )
    return bvh.read(path.read_text())
