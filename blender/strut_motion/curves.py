"""Uniform access to F-curves of actions in Blender 4.2 (without slots), 4.4 (with slots) and 5.0 (F-curves in channel bags)."""

from collections.abc import Iterable, Sequence
from typing import Any

import bpy

from .keys import Channel, key_points


def has_slots() -> bool:
    """Returns whether actions of this Blender have slots: 4.4 and later."""
    return hasattr(bpy.types, "ActionSlot")


def curves_of(action: Any, slot: Any) -> Any:
    """Returns the object with the F-curves and groups of an action's slot, as the attributes `fcurves` and `groups`."""
    if not has_slots():
        return action
    layer = action.layers[0] if len(action.layers) else action.layers.new("Layer")
    strip = layer.strips[0] if len(layer.strips) else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True)


def new_action(name: str, target: Any) -> tuple[Any, Any]:
    """Creates an action without curves for an object. Returns it with its slot, None without slots."""
    action = bpy.data.actions.new(name)
    return action, action.slots.new(id_type="OBJECT", name=target.name) if has_slots() else None


def copied_action(source: Any, slot: Any) -> tuple[Any, Any]:
    """Copies an action. Returns the copy with its slot that corresponds to `slot`."""
    action = source.copy()
    return action, action.slots[slot.identifier] if has_slots() else None


def assign(target: Any, action: Any, slot: Any) -> None:
    """Makes an object or an NLA strip play a slot of an action."""
    target.action = action
    if has_slots():
        target.action_slot = slot


def animated_bones(curves: Any, bones: Iterable[str]) -> dict[str, set[str]]:
    """Returns the properties with curves of each bone, by the bone's name."""
    paths = {data_path(bone, ""): bone for bone in bones}
    found: dict[str, set[str]] = {}
    for curve in curves.fcurves:
        start, end, name = curve.data_path.rpartition("].")
        bone = paths.get(start + end)
        if bone is not None:
            found.setdefault(bone, set()).add(name)
    return found


def data_path(bone: str, name: str) -> str:
    """Returns the path of a property of a pose bone."""
    return f'pose.bones["{bpy.utils.escape_identifier(bone)}"].{name}'


def write_channels(curves: Any, first_frame: float, channels: Sequence[Channel]) -> None:
    """Writes curves with one linear key per frame, one group per bone, and replaces existing curves."""
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
