"""The extension in Blender's own Python module, bpy: `npm run blender`."""

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

import strut  # noqa: E402
from blender_scene import (  # noqa: E402
    degrees_between,
    empty_scene,
    exported,
    import_bvh,
    import_rig,
    in_z_up,
    sampled,
    turns_from_rest,
    world_turns,
)
from conftest import FILES, RIGS  # noqa: E402
from strut_motion import bvh, curves, operators, skeleton, stylization  # noqa: E402
from strut_motion.styling import Problem  # noqa: E402

STYLES = {"proud": 0.7}
GREATEST_ANGLE = 0.01
"""Degrees."""


@pytest.fixture
def settings(database: Path) -> Any:
    settings = empty_scene(database)
    for style, weight in STYLES.items():
        settings.styles[style].weight = weight
    return settings


@pytest.fixture(scope="session")
def opened(database: Path) -> strut.Database:
    return strut.Database.open(database)


def message() -> str:
    return bpy.context.window_manager.strut_motion.message


def skate(db: strut.Database, rest: np.ndarray, tree: Any, world: np.ndarray, rate_hz: float) -> float:
    """Foot skate of what an armature does, on the database's body."""
    arrays = skeleton.motion_arrays(tree.parents, rest, world)
    a = [np.ascontiguousarray(x, np.float32) for x in arrays]
    motion = strut.Motion.from_arrays(tree.names, tree.parents, *a, rate_hz, up="z", metres_per_unit=1.0)
    return strut.metrics.foot_skate(db, motion.poses(db))


def test_a_bvh_comes_out_as_the_engine_styles_the_file(settings: Any, clip: Path, opened: strut.Database) -> None:
    armature = import_bvh(clip)
    source = armature.animation_data.action
    assert bpy.ops.strut_motion.stylize() == {"FINISHED"}
    action = armature.animation_data.action
    assert action != source and source.name in bpy.data.actions and source.use_fake_user
    assert "proud 0.7" in action.name and action.name in message()

    expected = bvh.read(strut.stylize(strut.Motion.open(clip), opened, STYLES).to_bvh())
    tree, rest, world = sampled(armature)
    order = [expected.names.index(name) for name in tree.names]
    turns = in_z_up(world_turns(expected.parents, expected.rotations))[:, order]
    assert len(world) == len(turns)
    angles = degrees_between(turns_from_rest(rest, world), turns)
    print(f"BVH: {angles.max():.5f} degrees")
    assert angles.max() < GREATEST_ANGLE


@pytest.mark.parametrize("about_it", RIGS, ids=[rig["name"] for rig in RIGS])
def test_a_rig_comes_out_as_the_engine_styles_its_export(
    settings: Any, clip: Path, opened: strut.Database, about_it: dict, tmp_path: Path
) -> None:
    armature = import_rig(FILES / "rigs", about_it, strut.Motion.open(clip), opened)
    tree, rest, before = sampled(armature)
    # The reference goes through Blender's own exporter.
    file = exported(armature, tmp_path)
    order = [file.names.index(name) for name in tree.names]
    offsets = skeleton.motion_arrays(tree.parents, rest, rest[None]).offsets
    local = [np.ascontiguousarray(a[:, order], np.float32) for a in (file.translations, file.rotations)]
    motion = strut.Motion.from_arrays(
        tree.names, tree.parents, np.ascontiguousarray(offsets, np.float32), *local, 60.0, up="z", metres_per_unit=1.0
    )
    expected = bvh.read(strut.stylize(motion, opened, STYLES).to_bvh())
    assert bpy.ops.strut_motion.stylize() == {"FINISHED"}, message()
    _, _, after = sampled(armature)
    roles = motion.roles
    print(f"{about_it['name']}: {len(roles)} roles")
    assert len(roles) == 21
    assert {role: roles[role] for role in roles} == about_it["joints"]
    order = [expected.names.index(name) for name in tree.names]
    _, rotations = skeleton.z_up(expected.translations, expected.rotations)
    turns = world_turns(expected.parents, rotations)[:, order]
    assert len(after) == len(turns)
    angles = degrees_between(turns_from_rest(rest, after), turns)
    skates = [skate(opened, rest, tree, world, 60.0) for world in (before, after)]
    print(f"{about_it['name']}: {angles.max():.5f} degrees, skate {skates[0]:.4f} before, {skates[1]:.4f} after")
    assert angles.max() < GREATEST_ANGLE
    assert skates[1] <= skates[0]
