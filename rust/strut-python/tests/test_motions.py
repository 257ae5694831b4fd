"""Motions of arrays, corrected skeletons, styles over time, contents of files."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest
import strut
from conftest import command


def arrays_of(path: Path) -> dict:
    """Returns the skeleton and the motion of a BVH file with ZXY rotations on all joints and positions on the root."""
    head, motion = path.read_text().split("MOTION")
    names, parents, offsets, stack = [], [], [], []
    for line in map(str.split, head.splitlines()):
        match line:
            case [("ROOT" | "JOINT"), name]:
                names.append(name)
                parents.append(stack[-1] if stack else -1)
                stack.append(len(names) - 1)
            case ["End", "Site"]:
                stack.append(None)
            case ["OFFSET", *offset] if stack[-1] is not None:
                offsets.append([float(x) for x in offset])
            case ["CHANNELS", _, *channels]:
                assert channels[-3:] == ["Zrotation", "Xrotation", "Yrotation"]
            case ["}"]:
                stack.pop()
    lines = motion.strip().splitlines()
    rows = np.array([[float(x) for x in line.split()] for line in lines[2:]])
    half = np.radians(rows[:, 3:].reshape(len(rows), -1, 3)) / 2
    rotations = np.zeros((len(rows), len(names), 4))
    rotations[..., 3] = 1
    for k, axis in enumerate([2, 0, 1]):
        turn = np.zeros_like(rotations)
        turn[..., 3], turn[..., axis] = np.cos(half[..., k]), np.sin(half[..., k])
        rotations = product(rotations, turn)
    translations = np.tile(np.array(offsets), (len(rows), 1, 1))
    translations[:, 0] = rows[:, :3]
    return {
        "names": names,
        "parents": parents,
        "offsets": np.array(offsets, np.float32),
        "translations": translations.astype(np.float32),
        "rotations_xyzw": rotations.astype(np.float32),
        "rate_hz": 1 / float(lines[1].split(":")[1]),
    }


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    vector = a[..., 3:] * b[..., :3] + b[..., 3:] * a[..., :3] + np.cross(a[..., :3], b[..., :3])
    return np.concatenate([vector, a[..., 3:] * b[..., 3:] - (a[..., :3] * b[..., :3]).sum(-1, keepdims=True)], -1)


@pytest.fixture(scope="module")
def arrays(jump: strut.Motion) -> dict:
    return arrays_of(Path(jump.name))


def test_a_motion_of_arrays_is_that_of_its_file(db: strut.Database, jump: strut.Motion, arrays: dict):
    motion = strut.Motion.from_arrays(**arrays)
    assert motion.frames == jump.frames and motion.roles == jump.roles and motion.rate_hz == pytest.approx(jump.rate_hz)
    np.testing.assert_allclose(motion.poses(db), jump.poses(db), atol=2e-4)
    again = pickle.loads(pickle.dumps(motion))
    assert strut.stylize(again, db, "old").to_bvh() == strut.stylize(motion, db, "old").to_bvh()

    # Any order of joints is allowed if parents come first.
    last = len(arrays["names"]) - 1
    order = sorted(range(last + 1), key=lambda j: depth(arrays["parents"], j))
    shuffled = arrays | {
        "names": [arrays["names"][j] for j in order],
        "parents": [order.index(p) if (p := arrays["parents"][j]) >= 0 else -1 for j in order],
        "offsets": arrays["offsets"][order].copy(),
        "translations": arrays["translations"][:, order].copy(),
        "rotations_xyzw": arrays["rotations_xyzw"][:, order].copy(),
    }
    np.testing.assert_allclose(strut.Motion.from_arrays(**shuffled).poses(db), motion.poses(db), atol=1e-5)


def depth(parents: list[int], joint: int) -> int:
    return 0 if parents[joint] < 0 else 1 + depth(parents, parents[joint])


def test_the_axis_up_and_the_unit_may_be_given(db: strut.Database, arrays: dict):
    upright = strut.Motion.from_arrays(**arrays)
    translations, rotations = arrays["translations"].copy(), arrays["rotations_xyzw"].copy()
    x, y, z = translations[:, 0].T
    translations[:, 0] = np.stack([x, -z, y], -1)
    quarter = np.array([np.sqrt(0.5), 0, 0, np.sqrt(0.5)])
    rotations[:, 0] = product(np.broadcast_to(quarter, rotations[:, 0].shape), rotations[:, 0])
    lying = arrays | {"translations": translations, "rotations_xyzw": rotations}
    np.testing.assert_allclose(strut.Motion.from_arrays(**lying, up="z").poses(db), upright.poses(db), atol=2e-4)
    # The file is in centimetres; the unit of a giant of ten times the size cannot be detected.
    same = strut.Motion.from_arrays(**arrays, metres_per_unit=0.01)
    np.testing.assert_allclose(same.poses(db), upright.poses(db), atol=1e-5)
    giant = strut.Motion.from_arrays(**arrays, metres_per_unit=0.1)
    assert "10 cm" not in upright.note and giant.note != upright.note
    assert pickle.loads(pickle.dumps(giant)).note == giant.note


def test_arrays_that_are_no_motion_are_refused(arrays: dict):
    nothing = np.zeros_like(arrays["rotations_xyzw"])
    for wrong in (
        {"parents": arrays["parents"][1:]},
        {"parents": [-1] * len(arrays["names"])},
        {"offsets": arrays["offsets"].astype(np.float64)},
        {"translations": arrays["translations"][1:]},
        {"translations": arrays["translations"] * np.float32("nan")},
        {"rotations_xyzw": nothing},
        {"rotations_xyzw": arrays["rotations_xyzw"][:, :, :3]},
        {"names": ["a\nb", *arrays["names"][1:]]},
        {"rate_hz": 0.0},
        {"up": "x"},
        {"metres_per_unit": -1.0},
        {"roles": {"wing": "a"}},
    ):
        with pytest.raises(strut.StrutError) as error:
            strut.Motion.from_arrays(**(arrays | wrong))
        assert error.value.code in ("bad-input", "bad-file"), wrong
    with pytest.raises(TypeError):
        strut.Motion.from_arrays(**arrays, roles={"hips": 1})


def test_roles_are_corrected(db: strut.Database, jump: strut.Motion):
    own = jump.roles
    same = strut.Motion.open(jump.name, roles=own)
    np.testing.assert_array_equal(same.poses(db), jump.poses(db))
    without = strut.Motion.open(jump.name, roles={"left_toes": None})
    assert "left_toes" not in without.roles and "left_toes" in own
    again = pickle.loads(pickle.dumps(without))
    assert again.roles == without.roles and again.name == jump.name
    assert isinstance(jump.note, str)
    for wrong in ({"left_hand": "nobody"}, {"wing": own["hips"]}, {"hips": None}, {"left_hand": own["right_foot"]}):
        with pytest.raises(strut.StrutError):
            strut.Motion.open(jump.name, roles=wrong)


def test_a_motion_is_read_as_it_is_said(db: strut.Database, jump: strut.Motion):
    higher = strut.Motion.open(jump.name, floor=-0.1)
    raised = higher.poses(db)[:, 1] - jump.poses(db)[:, 1]
    assert raised.min() == pytest.approx(raised.max(), abs=1e-5) and raised.min() > 0.05
    lying = strut.Motion.open(jump.name, up="z")
    mirrored = strut.Motion.open(jump.name, swap_sides=True)
    assert jump.notes == []
    for motion in (higher, lying, mirrored):
        assert not np.array_equal(motion.poses(db), jump.poses(db))
        again = pickle.loads(pickle.dumps(motion))
        np.testing.assert_array_equal(again.poses(db), motion.poses(db))
        assert again.notes == motion.notes
    for wrong in ({"up": "w"}, {"floor": float("nan")}):
        with pytest.raises(strut.StrutError):
            strut.Motion.open(jump.name, **wrong)


def test_styles_change_over_time(db: strut.Database, jump: strut.Motion):
    old, proud = (strut.stylize(jump, db, style) for style in ("old", "proud"))
    constant = strut.stylize(jump, db, "old", track=[(0, "old"), (1.0, {"old": 1})])
    assert constant.to_bvh() == old.to_bvh() == strut.stylize(jump, db, "old", track=[]).to_bvh()
    turning = strut.stylize(jump, db, "old", track=[(0.5, "old"), (0.6, "proud")])
    # Above the legs, whose footplant uses later frames.
    above = slice(3, 3 + 4 * 13)
    np.testing.assert_array_equal(turning.poses[:20, above], old.poses[:20, above])
    assert (turning.poses[-1] != old.poses[-1]).any() and (turning.poses[-1] != proud.poses[-1]).any()
    for wrong in ([(1, "old"), (0.5, "proud")], [(float("nan"), "old")], [(0, "odl")]):
        with pytest.raises(strut.StrutError):
            strut.stylize(jump, db, "old", track=wrong)
    with pytest.raises(TypeError):
        strut.stylize(jump, db, "old", track=["old"])


def test_a_trace_says_what_the_commands_does(files: Path, db: strut.Database, jump: strut.Motion, tmp_path: Path):
    arguments = ["--db", files / "demo.strutdb", "--input", jump.name, "--style", "old"]
    command("stylize", *arguments, "-o", tmp_path / "command.bvh", "--trace", tmp_path / "trace.jsonl")
    expected = [json.loads(line) for line in (tmp_path / "trace.jsonl").read_text().splitlines()]
    styled = strut.stylize(jump, db, "old", trace=True)
    assert styled.to_bvh() == (tmp_path / "command.bvh").read_text()
    for line, other in zip(styled.trace, expected, strict=True):
        assert line.pop("cost_us").keys() == other.pop("cost_us").keys()
        assert line == other
    assert strut.stylize(jump, db, "old").trace is None


def test_an_approximate_search_is_the_commands(files: Path, db: strut.Database, jump: strut.Motion, tmp_path: Path):
    arguments = ["--db", files / "demo.strutdb", "--input", jump.name, "--style", "old", "--search", "kdtree:40"]
    command("stylize", *arguments, "-o", tmp_path / "command.bvh")
    expected = (tmp_path / "command.bvh").read_text()
    assert strut.stylize(jump, db, "old", search="kdtree:40").to_bvh() == expected
    (many,) = strut.stylize_many([jump], db, "old", search="kdtree:40")
    assert many.to_bvh() == expected != strut.stylize(jump, db, "old", search="exact").to_bvh()
    stylizer = strut.Stylizer(db, "old", search="kdtree:40")
    stylizer.configure(k=20)
    with pytest.raises(strut.StrutError, match="cannot be changed"):
        stylizer.configure(search="exact")
    with pytest.raises(strut.StrutError, match="kdtree:CANDIDATES was expected"):
        strut.stylize(jump, db, "old", search="tree")


def test_a_style_is_added_as_by_the_command(files: Path, db: strut.Database, tmp_path: Path):
    small = strut.Database.build(sorted((files / "clips").glob("walk_[nop]*_001.bvh")), rate_hz=30)
    small.save(tmp_path / "small.strutdb")
    tired = files / "clips" / "walk_childlike_001.bvh"
    arguments = ["--db", tmp_path / "small.strutdb", "--input", tired, "--style", "tired", "-o", tmp_path / "command.strutdb"]
    command("add-style", *arguments)
    motion = strut.Motion.open(tired)
    added = small.add_style(motion, "tired")
    assert added.to_bytes() == (tmp_path / "command.strutdb").read_bytes()
    assert added.styles == [*small.styles, "tired"] and "tired" not in small.styles
    assert small.add_style(motion, "tired", action="walk").to_bytes() == added.to_bytes()
    for name, action in (("old", None), ("tired", "swim")):
        with pytest.raises(strut.StrutError):
            small.add_style(motion, name, action=action)


def test_a_database_gives_its_body_and_its_tensors(files: Path, db: strut.Database):
    body = db.proportions
    assert body.shape == (21, 3) and body.dtype == np.float32 and 0.5 < body[0, 1] < 1.5
    standing = np.zeros((1, 87), np.float32)
    standing[0, 1] = body[0, 1]
    standing[0, 6::4] = 1
    np.testing.assert_allclose(strut.positions(db, standing)[0, 1] - strut.positions(db, standing)[0, 0], body[1], atol=1e-6)
    data = (files / "demo.strutdb").read_bytes()
    header = json.loads(data[8 : 8 + int.from_bytes(data[:8], "little")])
    for name, entry in header.items():
        if name != "__metadata__":
            tensor = db.tensor(name)
            assert list(tensor.shape) == entry["shape"] and tensor.flags.writeable
            begin, end = entry["data_offsets"]
            assert tensor.tobytes() == data[8 + int.from_bytes(data[:8], "little") :][begin:end]
    with pytest.raises(strut.StrutError, match="there is no tensor 'poses2'"):
        db.tensor("poses2")
