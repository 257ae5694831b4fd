"""Styling of an armature's motion, in steps that report the progress: sampling, the engine on a thread, a new action."""

from collections.abc import Generator, Mapping
from typing import Any, NamedTuple

import numpy as np

from . import armature as rig
from . import bvh, curves, keys, skeleton
from .roles import bones_on_the_way
from .rotations import Array
from .styling import Job, Problem, Request, Result

SHARE_OF_SAMPLING = 0.2


class Order(NamedTuple):
    """Settings of the styling, apart from the motion."""

    open_database: Any
    """Function that returns the database, on any thread."""
    styles: Mapping[str, float]
    parts: Mapping[str, Mapping[str, float]] | None
    roles: Mapping[str, str | None] | None
    options: Mapping[str, Any]
    as_strip: bool
    """Whether the result becomes an NLA strip, and the source another one below it."""


class Step(NamedTuple):
    """Progress of the styling."""

    share: float
    """Progress, 0 to 1."""
    waits: bool
    """Whether the work must wait for a thread."""


class Outcome(NamedTuple):
    """Result of the styling."""

    action: Any
    first_frame: int
    frames: int
    roles: dict[str, str]
    note: str


def stylize(scene: Any, armature: Any, order: Order) -> Generator[Step, None, Outcome]:
    """
    Styles the motion of an armature. Only the last step changes anything; if the generator is closed earlier, nothing is
    changed.

    Raises `Problem`.
    """
    hips = (order.roles or {}).get("hips")
    tree = rig.tree(armature, hips)
    first, last = rig.frame_range(scene, armature)
    frames = range(first, last + 1)
    before = (scene.frame_current, scene.frame_subframe)
    job: Job | None = None
    try:
        sampler = rig.Sampler(scene, armature, tree, frames)
        for number in range(len(frames)):
            sampler.read(number)
            yield Step(SHARE_OF_SAMPLING * (number + 1) / len(frames), False)
        samples = sampler.samples
        job = Job(request_of(scene, tree, samples, order))
        while not job.is_done:
            yield Step(SHARE_OF_SAMPLING + (1 - SHARE_OF_SAMPLING) * job.share, True)
        result = job.result()
    finally:
        if job:
            job.cancel()
        scene.frame_set(before[0], subframe=before[1])
    outcome = write(armature, tree, samples, result, order, first)
    scene.frame_set(before[0], subframe=before[1])
    return outcome


def request_of(scene: Any, tree: rig.Tree, samples: rig.Samples, order: Order) -> Request:
    """Returns the request for the engine. Raises `Problem` for motions that cannot be written back."""
    if not skeleton.is_even(samples.objects):
        raise Problem("The armature is scaled differently along its axes, or mirrored. Apply its scale (Ctrl+A), then try again.")
    rest = samples.objects[0] @ tree.rest
    world = samples.objects[:, None] @ samples.poses
    scaled = skeleton.scaled_joints(rest, world)
    if scaled:
        raise Problem(f"Bone '{tree.names[scaled[0]]}' is scaled by its pose. Only motions that keep the size of bones can be styled.")
    return Request(
        names=tree.names,
        parents=tree.parents,
        arrays=skeleton.motion_arrays(tree.parents, rest, world),
        rate_hz=rig.rate_of(scene),
        metres_per_unit=skeleton.likely_unit(rest, scene.unit_settings.scale_length),
        roles=order.roles,
        open_database=order.open_database,
        styles=order.styles,
        parts=order.parts,
        options=order.options,
    )


def write(armature: Any, tree: rig.Tree, samples: rig.Samples, result: Result, order: Order, first: int) -> Outcome:
    """Creates the action of a result and makes the armature play it. Raises `Problem` before anything is changed."""
    moved = bones_on_the_way(result.roles, tree.parent_names)
    held = rig.moved_by_constraint(armature, moved)
    if held:
        bone, constraint = held
        raise Problem(f"Bone '{bone}' is moved by its constraint '{constraint}'. Bake the motion and mute the constraint first.")
    poses, shifted = styled_poses(tree, samples, result)
    data = armature.animation_data or armature.animation_data_create()
    source, slot = data.action, getattr(data, "action_slot", None)
    name = f"{source.name if source else armature.name} {name_of(order.styles)}"
    is_copied = source is not None and (slot is not None or not curves.has_slots())
    action, new_slot = curves.copied_action(source, slot) if is_copied else curves.new_action(name, armature)
    action.name = name
    bag = curves.curves_of(action, new_slot)
    animated = curves.animated_bones(bag, tree.names)
    channels = channels_of(armature, tree, poses, moved, shifted, animated)
    curves.write_channels(bag, first, channels)
    if order.as_strip:
        add_strips(data, source, slot, (action, new_slot), first)
    else:
        curves.assign(data, action, new_slot)
    if source and source.users == 0:
        # Blender does not save unused data.
        source.use_fake_user = True
    return Outcome(action, first, len(poses), result.roles, result.note)


def styled_poses(tree: rig.Tree, samples: rig.Samples, result: Result) -> tuple[Array, set[str]]:
    """
    Returns the bones' matrices in armature space, n × j × 4 × 4, and the bones that are translated relative to their parent.
    """
    clip = bvh.read(result.bvh)
    order = [clip.names.index(name) for name in tree.names]
    translations, rotations = skeleton.z_up(clip.translations, clip.rotations)
    translations, rotations = translations[:, order], rotations[:, order]
    rest = samples.objects[0] @ tree.rest
    world = skeleton.world_matrices(tree.parents, rest, translations, rotations)
    offsets = skeleton.motion_arrays(tree.parents, rest, rest[None]).offsets
    strays = (np.abs(translations - offsets) > skeleton.SAME_PLACE * skeleton.height_of(rest)).any((0, 2))
    shifted = {name for name, stray in zip(tree.names, strays, strict=True) if stray}
    later = np.minimum(np.arange(len(world)), len(samples.objects) - 1)
    return skeleton.in_object(samples.objects[later], world), shifted


def channels_of(
    armature: Any,
    tree: rig.Tree,
    poses: Array,
    moved: set[str],
    shifted: set[str],
    animated: Mapping[str, set[str]],
) -> list[keys.Channel]:
    """Returns the channels of all moving bones, in the rotation mode of each."""
    channels: list[keys.Channel] = []
    for joint, (name, parent) in enumerate(zip(tree.names, tree.parents, strict=True)):
        if not (name in moved or name in shifted or name in animated):
            continue
        bone, pose_bone = armature.data.bones[name], armature.pose.bones[name]
        if name not in moved and rig.moved_by_constraint(armature, {name}):
            continue
        above = (tree.rest[parent], poses[:, parent]) if parent >= 0 else (None, None)
        if rig.has_default_inheritance(bone):
            basis = keys.basis_matrices(tree.rest[joint], above[0], poses[:, joint], above[1])
        else:
            basis = rig.converted(bone, poses[:, joint], above[1])
        if (name in shifted or "location" in animated.get(name, ())) and not bone.use_connect:
            channels.extend(keys.location_channels(name, basis))
        channels.extend(keys.rotation_channels(name, pose_bone.rotation_mode, basis))
    return channels


def add_strips(data: Any, source: Any, slot: Any, styled: tuple[Any, Any], first: int) -> None:
    """Pushes the source down into a separate track, and the styled action into one above it, which is visible."""
    pairs = [("Source", source, slot)] if source else []
    for track_name, action, action_slot in [*pairs, ("Styled", *styled)]:
        track = data.nla_tracks.new()
        track.name = track_name
        start = int(action.frame_range[0]) if action == source else first
        strip = track.strips.new(action.name, start, action)
        if curves.has_slots():
            strip.action_slot = action_slot
    data.action = None


def name_of(styles: Mapping[str, float]) -> str:
    """
    Returns styles and weights as a name of actions: "proud 70%, old 30%". There is no decimal point: Blender would number "0.7"
    as "0.001" if the name is in use.
    """
    return ", ".join(style if weight == 1 else f"{style} {100 * weight:.0f}%" for style, weight in styles.items())
