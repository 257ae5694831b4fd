"""Tests of the extension without Blender."""

import numpy as np
import pytest
from strut_motion import bvh, keys, roles, rotations, skeleton, styling

random = np.random.default_rng(7)


def turns(*shape: int) -> np.ndarray:
    q = random.normal(size=(*shape, 4))
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def matrices(q: np.ndarray, places: np.ndarray) -> np.ndarray:
    m = np.zeros((*q.shape[:-1], 4, 4))
    m[..., :3, :3], m[..., :3, 3], m[..., 3, 3] = rotations.matrices_of(q), places, 1
    return m


def same(a: np.ndarray, b: np.ndarray) -> bool:
    return bool((np.abs(np.abs((a * b).sum(-1)) - 1) < 1e-9).all())


def test_quaternions_are_their_matrices() -> None:
    q = np.concatenate([turns(200), np.eye(4), -np.eye(4)])
    assert same(rotations.quaternions_of(rotations.matrices_of(q)), q)
    a, b = turns(50), turns(50)
    product = rotations.matrices_of(a) @ rotations.matrices_of(b)
    np.testing.assert_allclose(rotations.matrices_of(rotations.multiplied(a, b)), product, atol=1e-12)
    assert same(rotations.multiplied(a, rotations.inverse(a)), np.eye(4)[3])


@pytest.mark.parametrize("order", rotations.EULER_ORDERS)
def test_euler_angles_are_their_matrices_and_continuous(order: str) -> None:
    def back(angles: np.ndarray) -> np.ndarray:
        q = np.broadcast_to(np.eye(4)[3], (*angles.shape[:-1], 4))
        for axis in map("XYZ".index, order):
            q = rotations.multiplied(rotations.about(axis, angles[..., axis]), q)
        return rotations.matrices_of(q)

    # A path through the pole, where the middle angle is a quarter turn.
    t = np.linspace(0, 3, 200)[:, None]
    path = np.stack([0.4 + t * 0.2, t, 0.1 - t * 0.3], -1)[:, 0][:, None].repeat(2, 1)
    m = back(path)
    angles = rotations.euler_of(m, order)
    np.testing.assert_allclose(back(angles), m, atol=1e-9)
    smooth = rotations.continuous_euler(angles, order)
    np.testing.assert_allclose(back(smooth), m, atol=1e-9)
    assert np.abs(np.diff(smooth, axis=0)).max() < 0.5


def test_quaternions_keep_their_sign_from_frame_to_frame() -> None:
    q = turns(1).repeat(20, 0) * np.where(random.random(20) < 0.5, -1, 1)[:, None]
    assert np.ptp(rotations.continuous_quaternions(q), 0).max() == 0
    angle_axis = rotations.axis_angles_of(np.array([[0, 0, 0, 1.0], [np.sin(0.2), 0, 0, np.cos(0.2)]]))
    np.testing.assert_allclose(angle_axis, [[0, 0, 1, 0], [0.4, 1, 0, 0]], atol=1e-12)


PARENTS = [-1, 0, 1, 1, 3]


def test_motions_of_matrices_are_these_matrices() -> None:
    rest = matrices(turns(5), random.normal(size=(5, 3)))
    world = matrices(turns(7, 5), random.normal(size=(7, 5, 3)))
    arrays = skeleton.motion_arrays(PARENTS, rest, world)
    again = skeleton.world_matrices(PARENTS, rest, arrays.translations, arrays.rotations_xyzw)
    np.testing.assert_allclose(again, world, atol=1e-9)
    # At rest all rotations are the identity, and all positions are bit-identical.
    zero = skeleton.motion_arrays(PARENTS, rest, rest[None])
    assert same(zero.rotations_xyzw, np.eye(4)[3]) and (zero.translations[0] == zero.offsets).all()


def test_armatures_may_be_turned_moved_and_scaled_evenly() -> None:
    world = matrices(turns(7, 5), random.normal(size=(7, 5, 3)))
    objects = matrices(turns(7), random.normal(size=(7, 3)))
    objects[:, :3, :3] *= 0.01
    inside = skeleton.in_object(objects, world)
    outside = objects[:, None] @ inside
    np.testing.assert_allclose(outside[..., :3, 3], world[..., :3, 3], atol=1e-9)
    assert same(skeleton.rotations_of(outside), skeleton.rotations_of(world))
    assert skeleton.is_even(objects)
    objects[3, :3, 1] *= 1.1
    assert not skeleton.is_even(objects)
    assert not skeleton.is_even(np.diag([1.0, 1, -1, 1])[None])
    assert skeleton.scaled_joints(world[0], world) == []
    world[2, 4, :3, :3] *= 1.2
    assert skeleton.scaled_joints(world[0], world) == [4]


def test_the_tree_of_the_body_is_chosen() -> None:
    parents = [-1, 3, -1, 0, 1, 2]
    assert skeleton.tree_of(parents) == [0, 3, 1, 4]
    assert skeleton.tree_of(parents, 5) == [2, 5]
    assert skeleton.tree_of([]) == []


def test_the_scenes_unit_is_believed_for_bodies() -> None:
    rest = matrices(turns(2), np.array([[0, 0, 0], [0, 0, 1.7]]))
    assert skeleton.likely_unit(rest, 1.0) == 1.0
    assert skeleton.likely_unit(rest, 0.01) is None


def test_channels_give_the_pose_back() -> None:
    rest, parent_rest = matrices(turns(2), random.normal(size=(2, 3)))
    pose, parent_pose = matrices(turns(2, 9), random.normal(size=(2, 9, 3)))
    basis = keys.basis_matrices(rest, parent_rest, pose, parent_pose)
    np.testing.assert_allclose(parent_pose @ np.linalg.inv(parent_rest) @ rest @ basis, pose, atol=1e-9)
    for mode, count in (("QUATERNION", 4), ("XYZ", 3), ("AXIS_ANGLE", 4)):
        channels = list(keys.rotation_channels("hand", mode, basis))
        assert [channel.axis for channel in channels] == list(range(count))
    points = keys.key_points(5, np.array([1.0, 2.0]))
    assert points.tolist() == [5, 1, 6, 2] and points.dtype == np.float32


def test_a_bvh_is_read() -> None:
    clip = bvh.read(
        "HIERARCHY\nROOT hips\n{\n\tOFFSET 0 1 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
        "\tJOINT upper leg\n\t{\n\t\tOFFSET 0 0 2\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\t\tEnd Site\n\t\t{\n"
        "\t\t\tOFFSET 0 0 9\n\t\t}\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: 0.05\n"
        "1 2 3 90 0 0 0 0 0\n4 5 6 0 0 0 0 0 90\n"
    )
    assert (clip.names, clip.parents, clip.rate_hz) == (["hips", "upper leg"], [-1, 0], 20)
    assert clip.translations.tolist() == [[[1, 2, 3], [0, 0, 2]], [[4, 5, 6], [0, 0, 2]]]
    half = np.sqrt(0.5)
    np.testing.assert_allclose(clip.rotations[:, :, 2], [[half, 0], [0, 0]], atol=1e-12)
    np.testing.assert_allclose(clip.rotations[1, 1], [0, half, 0, half], atol=1e-12)


def test_rows_of_the_panel_become_arguments() -> None:
    assert roles.given_roles([]) is None
    assert roles.given_roles([("hips", "Pelvis"), ("neck", "")]) == {"hips": "Pelvis", "neck": None}
    assert roles.style_weights([("old", 0.0), ("proud", 0.5)]) == {"proud": 0.5}
    assert roles.part_styles([("legs", "", 1), ("head", "old", 0.5)]) == {"head": {"old": 0.5}}
    assert roles.part_styles([("legs", "", 1)]) is None
    parents = {"root": None, "hips": "root", "spine": "hips", "twist": "spine", "hand": "twist", "finger": "hand"}
    moved = roles.bones_on_the_way({"hips": "hips", "left_hand": "hand"}, parents)
    assert moved == {"hips", "spine", "twist", "hand"}


def test_errors_become_sentences() -> None:
    strut = pytest.importorskip("strut")
    assert styling.sentence(strut.StrutError("there is no style 'x'", "bad-input")) == "There is no style 'x'."
    assert styling.sentence(FileNotFoundError(2, "No such file", "a.strutdb")) == "No such file: a.strutdb."
