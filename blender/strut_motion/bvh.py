"""The BVH text of `strut.StyledMotion.to_bvh` as arrays."""

from typing import NamedTuple

import numpy as np

from .rotations import Array, about, multiplied

AXES = "XYZ"


class Clip(NamedTuple):
    """Local transforms of every joint in every frame."""

    names: list[str]
    parents: list[int]
    """−1 for the root."""
    translations: Array
    """n × j × 3, in the parent's frame."""
    rotations: Array
    """n × j × 4, relative to the parent, x y z w."""
    rate_hz: float


def read(text: str) -> Clip:
    """Parses a clip. It accepts only the engine's own output, without further checks."""
    head, motion = text.split("MOTION\n", 1)
    names: list[str] = []
    parents: list[int] = []
    offsets: list[list[float]] = []
    channels: list[tuple[int, str]] = []
    open_joints: list[int] = []
    for line in map(str.strip, head.splitlines()):
        word, _, rest = line.partition(" ")
        if word in ("ROOT", "JOINT"):
            parents.append(open_joints[-1] if open_joints else -1)
            names.append(rest)
            open_joints.append(len(names) - 1)
        elif word == "End":
            open_joints.append(-1)
        elif word == "OFFSET" and open_joints[-1] >= 0:
            offsets.append([float(value) for value in rest.split()])
        elif word == "CHANNELS":
            channels.extend((len(names) - 1, channel) for channel in rest.split()[1:])
        elif word == "}":
            open_joints.pop()
    frames_line, time_line, values = motion.split("\n", 2)
    frames = int(frames_line.partition(":")[2])
    rows = np.array(values.split(), np.float64).reshape(frames, len(channels))
    translations = np.tile(np.array(offsets), (frames, 1, 1))
    rotations = np.zeros((frames, len(names), 4))
    rotations[..., 3] = 1
    for column, (joint, channel) in enumerate(channels):
        axis = AXES.index(channel[0])
        if channel.endswith("position"):
            translations[:, joint, axis] = rows[:, column]
        else:
            turn = about(axis, np.radians(rows[:, column]))
            rotations[:, joint] = multiplied(rotations[:, joint], turn)
    return Clip(names, parents, translations, rotations, 1 / float(time_line.partition(":")[2]))
