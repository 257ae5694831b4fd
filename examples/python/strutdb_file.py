"""Reads a database without Strut, docs/reference/files.md: runs after ../cli/first_steps.sh in the same folder."""

# anchor read
import json
import zlib

import numpy as np

TYPES = {"F32": "<f4", "U8": "u1", "U16": "<u2", "U32": "<u4", "I16": "<i2"}


def read(path):
    """The metadata and the tensors of a .strutdb file."""
    with open(path, "rb") as file:
        data = file.read()
    begin = 8 + int.from_bytes(data[:8], "little")
    header = json.loads(data[8:begin])
    info = json.loads(header.pop("__metadata__")["strut"])
    if zlib.crc32(data.replace(info["checksum"].encode(), b"00000000", 1)) != int(info["checksum"], 16):
        raise ValueError("the file is damaged")
    tensors = {}
    for name, tensor in header.items():
        first, end = tensor["data_offsets"]
        numbers = np.frombuffer(data[begin + first : begin + end], TYPES[tensor["dtype"]])
        tensors[name] = numbers.reshape(tensor["shape"])
    return info, tensors


def product(a, b):
    """The product of quaternions x y z w."""
    ax, ay, az, aw = np.moveaxis(a, -1, 0)
    bx, by, bz, bw = np.moveaxis(b, -1, 0)
    x = aw * bx + ax * bw + ay * bz - az * by
    y = aw * by - ax * bz + ay * bw + az * bx
    z = aw * bz + ax * by - ay * bx + az * bw
    return np.stack([x, y, z, aw * bw - ax * bx - ay * by - az * bz], -1)


def positions(info, tensors):
    """Where the joints are, n × 21 × 3, metres: what the tensor point_cloud has."""
    rows = tensors["pose"].astype(float)
    maps = rows[:, :63].reshape(-1, 21, 3)
    angles = np.linalg.norm(maps, axis=-1, keepdims=True)
    exp = np.concatenate([maps * np.sinc(angles / (2 * np.pi)) / 2, np.cos(angles / 2)], -1)
    local = product(np.broadcast_to(tensors["chart"], exp.shape), exp)
    offsets = np.array(info["skeleton"]["offsets_cm"]) / 100
    world, places = np.empty_like(local), np.zeros_like(maps)
    world[:, 0] = local[:, 0]
    places[:, 0, 1] = rows[:, 63]  # the height of the hips
    for joint, parent in list(enumerate(info["skeleton"]["parents"]))[1:]:
        world[:, joint] = product(world[:, parent], local[:, joint])
        axis, w = world[:, parent, :3], world[:, parent, 3:]
        turned = offsets[joint] + 2 * np.cross(axis, np.cross(axis, offsets[joint]) + w * offsets[joint])
        places[:, joint] = places[:, parent] + turned
    return places


info, tensors = read("demo.strutdb")
off = np.abs(positions(info, tensors) - tensors["point_cloud"]).max()
print(f"{len(tensors['pose'])} frames at {info['rate_hz']} Hz, joints within {1000 * off:.2f} mm")
# end read
