"""F-curves of actions, the same way in Blender 4.2, which has no slots, in 4.4, which has them, and in 5.0, where curves have left
the action."""

from collections.abc import Iterable, Sequence
from typing import Any

import bpy

from .keys import Channel, key_points


def has_slots() -> bool:
    """Whether actions of this Blender have slots: 4.4 and later."""
    return hasattr(bpy.types, "ActionSlot")


def curves_of(action: Any, slot: Any) -> Any:
    """What holds the F-curves and their groups that a slot of an action has: both are its attributes, `fcurves` and `groups`."""
    if not has_slots():
        return action
    layer = action.layers[0] if len(action.layers) else action.layers.new("Layer")
    strip = layer.strips[0] if len(layer.strips) else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True)


def new_action(name: str, target: Any) -> tuple[Any, Any]:
    """An action without curves for an object, and its slot, None where there are none."""
    action = bpy.data.actions.new(name)
    return action, action.slots.new(id_type="OBJECT", name=target.name) if has_slots() else None


def copied_action(source: Any, slot: Any) -> tuple[Any, Any]:
    """A copy of an action, and in it the slot that `slot` is in the source."""
    action = source.copy()
    return action, action.slots[slot.identifier] if has_slots() else None


def assign(target: Any, action: Any, slot: Any) -> None:
    """Has an object or an NLA strip play a slot of an action."""
    target.action = action
    if has_slots():
        target.action_slot = slot


def animated_bones(curves: Any, bones: Iterable[str]) -> dict[str, set[str]]:
    """The properties of bones that have curves, by the bone's name."""
    paths = {data_path(bone, ""): bone for bone in bones}
    found: dict[str, set[str]] = {}
    for curve in curves.fcurves:
        start, end, name = curve.data_path.rpartition("].")
        bone = paths.get(start + end)
        if bone is not None:
            found.setdefault(bone, set()).add(name)
    return found


def data_path(bone: str, name: str) -> str:
    """The path of a property of a pose bone."""
    return f'pose.bones["{bpy.utils.escape_identifier(bone)}"].{name}'


def write_channels(curves: Any, first_frame: float, channels: Sequence[Channel]) -> None:
    """Writes curves with one linear key a frame, in a group a bone, in place of those that are there."""
    written = {(data_path(channel.bone, channel.property), channel.axis) for channel in channels}
    for curve in list(curves.fcurves):
        if (curve.data_path, curve.array_index) in written:
            curves.fcurves.remove(curve)
    linear = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items["LINEAR"].value
    for channel in channels:
        curve = curves.fcurves.new(data_path(channel.bone, channel.property), index=channel.axis)
        curve.group = curves.groups.get(channel.bone) or curves.groups.new(channel.bone)
        curve.keyframe_points.add(len(channel.values))
        curve.keyframe_points.foreach_set("co", key_points(first_frame, channel.values))
        curve.keyframe_points.foreach_set("interpolation", [linear] * len(channel.values))
        curve.update()
