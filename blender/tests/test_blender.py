"""Tests of the extension in Blender's own Python module, bpy: `npm run blender`."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

import strut  # noqa: E402
from blender_scene import (  # noqa: E402
    RATE_HZ,
    degrees_between,
    empty_scene,
    exported,
    import_bvh,
    import_rig,
    in_z_up,
    sampled,
    styled,
    turns_from_rest,
    world_of,
)
from conftest import FILES, RIGS  # noqa: E402
from strut_motion import bvh, curves, operators, skeleton, stylization  # noqa: E402
from strut_motion.styling import Problem  # noqa: E402

STYLES = {"proud": 0.7}
GREATEST_ANGLE = 0.01
"""Greatest angle, degrees."""
GREATEST_ANGLE_OF_LEGS = 0.1
GREATEST_DISTANCE = 1e-4
"""Greatest distance, metres."""


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


def skates(db: strut.Database, rest: np.ndarray, tree: Any, worlds: Sequence[np.ndarray], folder: Path) -> list[float]:
    """
    Returns the foot skate of an armature's motion from key to key, on its own body, metres per second. Joints are interpolated
    between keys, so on legs of other lengths every foot slides slightly, also in the input.
    """
    arrays = [skeleton.motion_arrays(tree.parents, rest, world) for world in worlds]
    motions = [
        strut.Motion.from_arrays(
            tree.names, tree.parents, *(np.ascontiguousarray(x, np.float32) for x in a), RATE_HZ, up="z", metres_per_unit=1.0
        )
        for a in arrays
    ]
    # A database of only this armature has its body.
    file = folder / "walk_neutral_001.bvh"
    file.write_text(strut.stylize(motions[0], db, {}).to_bvh())
    body = strut.Database.build([file])
    step = round(body.rate_hz) // RATE_HZ
    # The metric requires poses at the frames of the database.
    return [
        strut.metrics.foot_skate(body, *(np.ascontiguousarray(x[::step]) for x in (m.poses(body), m.contacts(body)))) / step
        for m in motions
    ]


def compare(
    expected: tuple[np.ndarray, np.ndarray], tree: Any, rest: np.ndarray, world: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """
    Returns angles between actual and expected joint rotations, degrees, and distances of their positions, metres, n × j each.
    """
    turns, places = expected
    assert len(world) == len(turns)
    return degrees_between(turns_from_rest(rest, world), turns), np.linalg.norm(world[..., :3, 3] - places, axis=-1)


def check(compared: tuple[np.ndarray, np.ndarray], tree: Any, roles: dict[str, str], what: str) -> None:
    """
    Checks that all joints are within 0.01° and 0.1 mm except thighs, shins and knees. These show the engine's own rounding,
    since it received the same motion from another file: the angle of an almost straight knee depends on the square root of the
    rounding error of lengths.
    """
    angles, distances = compared
    legs = {roles[f"{side}_{part}_leg"] for side in ("left", "right") for part in ("upper", "lower")}
    is_leg = np.array([name in legs for name in tree.names])
    print(
        f"{what}: {angles[:, ~is_leg].max():.5f} degrees, {1000 * distances[:, ~is_leg].max():.3f} mm; "
        f"thighs and shins {angles[:, is_leg].max():.4f} degrees, {1000 * distances[:, is_leg].max():.3f} mm"
    )
    assert angles[:, ~is_leg].max() < GREATEST_ANGLE and distances[:, ~is_leg].max() < GREATEST_DISTANCE
    assert angles[:, is_leg].max() < GREATEST_ANGLE_OF_LEGS
    assert np.median(angles[:, is_leg]) < GREATEST_ANGLE and np.median(distances[:, is_leg]) < GREATEST_DISTANCE


def test_a_bvh_comes_out_as_the_engine_styles_the_file(settings: Any, clip: Path, opened: strut.Database) -> None:
    armature = import_bvh(clip)
    source = armature.animation_data.action
    tree, rest, before = sampled(armature)
    assert bpy.ops.strut_motion.stylize() == {"FINISHED"}
    action = armature.animation_data.action
    assert action != source and source.name in bpy.data.actions and source.use_fake_user
    assert "proud 70%" in action.name and action.name in message()
    _, _, after = sampled(armature)

    # The file itself, in centimetres and with +Y up.
    motion = strut.Motion.open(clip)
    expected = bvh.read(strut.stylize(motion, opened, STYLES).to_bvh())
    order = [expected.names.index(name) for name in tree.names]
    turns, places = world_of(expected.parents, expected.translations, expected.rotations, order)
    y_up = (in_z_up(turns), 0.01 * places[..., [0, 2, 1]] * [1, -1, 1])
    check(compare(y_up, tree, rest, after), tree, motion.roles, "BVH")

    # Exactly the motion that Blender plays.
    same = styled(tree, list(skeleton.motion_arrays(tree.parents, rest, before)), motion.rate_hz, opened, STYLES)
    angles, distances = compare(same, tree, rest, after)
    print(f"BVH as sampled: {angles.max():.5f} degrees, {1000 * distances.max():.3f} mm")
    assert angles.max() < GREATEST_ANGLE and distances.max() < GREATEST_DISTANCE


@pytest.mark.parametrize("about_it", RIGS, ids=[rig["name"] for rig in RIGS])
def test_a_rig_comes_out_as_the_engine_styles_it(
    settings: Any, clip: Path, opened: strut.Database, about_it: dict, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    name = about_it["name"]
    armature = import_rig(FILES / "rigs", about_it, strut.Motion.open(clip), opened)
    tree, rest, before = sampled(armature)
    bpy.ops.strut_motion.find_roles()
    assert {row.name: row.bone for row in armature.strut_motion_roles} == about_it["joints"]
    armature.strut_motion_roles.clear()
    assert bpy.ops.strut_motion.stylize() == {"FINISHED"}, message()
    _, _, after = sampled(armature)

    arrays = skeleton.motion_arrays(tree.parents, rest, before)
    angles, distances = compare(styled(tree, list(arrays), RATE_HZ, opened, STYLES), tree, rest, after)
    slides = skates(opened, rest, tree, (before, after), tmp_path)
    print(f"{name} as sampled: {angles.max():.5f} degrees, skate {slides[0]:.4f} m/s before, {slides[1]:.4f} after")
    assert angles.max() < GREATEST_ANGLE and distances.max() < GREATEST_DISTANCE
    assert slides[1] <= slides[0]

    # With Blender's own exporter, which writes lengths in armature space, not in world space.
    if np.array_equal(np.array(armature.matrix_world), np.eye(4)):
        file = exported(armature, bpy.data.actions["walk"], tmp_path)
        order = [file.names.index(bone) for bone in tree.names]
        local = [arrays.offsets, file.translations[:, order], file.rotations[:, order]]
        by_file = styled(tree, local, RATE_HZ, opened, STYLES)
        if name == "Biped":
            # In four frames a rounding difference of the exported file changes the result: 0.040° at the feet, 0.0103° at the
            # head.
            request.applymarker(pytest.mark.xfail(reason="an export of Biped misses 0.01 degrees, see docs/blender.md"))
        check(compare(by_file, tree, rest, after), tree, about_it["joints"], f"{name} as exported")


def state_of(armature: Any) -> tuple:
    """Returns the state that undo must restore: actions, their keys, the assigned action, tracks, frame."""
    actions = {}
    for action in bpy.data.actions:
        slots = list(action.slots) if curves.has_slots() else [None]
        actions[action.name] = [
            (curve.data_path, curve.array_index, tuple(tuple(point.co) for point in curve.keyframe_points))
            for slot in slots
            for curve in curves.curves_of(action, slot).fcurves
        ]
    data = armature.animation_data
    played = data.action and data.action.name
    return actions, played, [track.name for track in data.nla_tracks], bpy.context.scene.frame_current


def test_one_undo_brings_everything_back(settings: Any, clip: Path) -> None:
    armature = import_bvh(clip)
    name = armature.name
    bpy.context.scene.frame_set(17)
    bpy.ops.ed.undo_push(message="before")
    before = state_of(armature)
    bpy.ops.strut_motion.stylize()
    assert state_of(armature) != before
    # Blender does this after an operator that a user starts.
    bpy.ops.ed.undo_push(message="Stylize")
    bpy.ops.ed.undo()
    assert state_of(bpy.data.objects[name]) == before
    bpy.ops.ed.redo()
    assert "proud" in bpy.data.objects[name].animation_data.action.name


def test_a_strip_stands_above_one_of_the_source(settings: Any, clip: Path) -> None:
    armature = import_bvh(clip)
    source = armature.animation_data.action
    settings.output = "STRIP"
    bpy.ops.strut_motion.stylize()
    below, above = armature.animation_data.nla_tracks
    assert armature.animation_data.action is None
    assert below.strips[0].action == source and "proud" in above.strips[0].action.name
    scene, bone = bpy.context.scene, armature.pose.bones[0]
    scene.frame_set(40)
    styled = bone.matrix.copy()
    above.mute = True
    scene.frame_set(40)
    assert (np.array(styled) != np.array(bone.matrix)).any()


def work_of(settings: Any, armature: Any) -> Any:
    return stylization.stylize(bpy.context.scene, armature, operators.order_of(settings, armature))


@pytest.mark.parametrize("share", [0.1, 0.25, 0.6])
def test_esc_ends_it_at_once_and_changes_nothing(settings: Any, clip: Path, share: float) -> None:
    armature = import_bvh(clip)
    before = state_of(armature)
    work = work_of(settings, armature)
    ticks, used = [], []
    while True:
        began, before_tick = time.perf_counter(), time.thread_time()
        done = operators.advance(work, operators.TICK_SECS)
        ticks.append(time.perf_counter() - began)
        used.append(time.thread_time() - before_tick)
        if done >= share:
            break
        time.sleep(0.01)
    began = time.perf_counter()
    work.close()
    cancelled = time.perf_counter() - began
    print(f"longest tick {1000 * max(ticks):.0f} ms ({1000 * max(used):.0f} ms of this thread), cancelled in {1000 * cancelled:.0f} ms")
    # Esc is handled after a tick.
    assert max(ticks) + cancelled < 0.2
    assert state_of(armature) == before


def test_how_long_ten_seconds_take(settings: Any, clip: Path) -> None:
    armature = import_bvh(clip)
    bpy.ops.strut_motion.stylize()  # Opens the database and makes its tables.
    armature.animation_data.action = bpy.data.actions[0]
    secs = (armature.animation_data.action.frame_range[1] - 1) / 30
    began, used = time.perf_counter(), time.process_time()
    bpy.ops.strut_motion.stylize()
    took, used = time.perf_counter() - began, time.process_time() - used
    print(f"{secs:.1f} s of motion in {took:.2f} s, {used:.2f} s of processors")


def refused(settings: Any) -> str:
    """Returns the message of a refusal, which the panel shows, too."""
    count = len(bpy.data.actions)
    with pytest.raises(RuntimeError) as error:
        bpy.ops.strut_motion.stylize()
    assert message() in str(error.value) and len(bpy.data.actions) == count
    assert bpy.context.window_manager.strut_motion.is_error
    assert message() in " ".join(drawn())
    return message()


def test_errors_are_sentences_in_the_panel(settings: Any, clip: Path, tmp_path: Path) -> None:
    armature = import_bvh(clip)
    for style in settings.styles:
        style.weight = 0
    assert refused(settings) == "Give at least one style a weight above 0."
    settings.styles["proud"].weight = 1
    bone = armature.pose.bones["LeftHand" if "LeftHand" in armature.pose.bones else armature.pose.bones[-1].name]
    constraint = bone.constraints.new("LIMIT_ROTATION")
    assert "constraint" in refused(settings) and bone.name in message()
    bone.constraints.remove(constraint)
    armature.scale = (1, 2, 1)
    assert "Apply its scale" in refused(settings)
    armature.scale = (1, 1, 1)
    bpy.context.scene.use_preview_range = True
    bpy.context.scene.frame_preview_start, bpy.context.scene.frame_preview_end = 1, 2
    assert "2 frames" in refused(settings)
    broken = tmp_path / "broken.strutdb"
    broken.write_bytes(b"no database")
    settings.path = str(broken)
    assert len(settings.styles) == 0 and message().startswith("broken.strutdb: this is not a Strut database")
    assert message() in " ".join(drawn())
    settings.path = str(tmp_path / "missing.strutdb")
    assert "missing.strutdb" in message()


def test_roles_are_found_and_corrected(settings: Any, clip: Path) -> None:
    armature = import_bvh(clip)
    assert bpy.ops.strut_motion.find_roles() == {"FINISHED"}
    rows = {row.name: row for row in armature.strut_motion_roles}
    assert len(rows) == 21 and all(row.bone in armature.data.bones for row in rows.values() if row.bone)
    rows["left_toes"].bone = ""
    bpy.ops.strut_motion.stylize()
    rows["left_hand"].bone = rows["right_foot"].bone
    assert "cannot be the" in refused(settings)


class Layout:
    """Fake of Blender's layout, which needs a window: records what is drawn, and fails for missing properties."""

    def __init__(self, texts: list[str]) -> None:
        self.texts = texts

    def prop(self, data: Any, name: str, text: str | None = None, **_: Any) -> None:
        self.texts.append(data.bl_rna.properties[name].name if text is None else text)

    def prop_search(self, data: Any, name: str, where: Any, collection: str, text: str = "") -> None:
        assert name in data.bl_rna.properties and collection in where.bl_rna.properties
        self.texts.append(text)

    def operator(self, name: str, **_: Any) -> None:
        module, operator = name.split(".")
        self.texts.append(getattr(getattr(bpy.ops, module), operator).get_rna_type().name)

    def label(self, text: str, icon: str = "NONE") -> None:
        self.texts.append(text)

    def progress(self, factor: float, text: str) -> None:
        self.texts.append(f"{text} {factor:.2f}")

    def template_list(self, kind: str, *_: Any, **__: Any) -> None:
        assert hasattr(bpy.types, kind)

    def _inner(self, *_: Any, **__: Any) -> "Layout":
        return self

    row = column = split = _inner


def drawn() -> list[str]:
    """Returns the texts of all panels."""
    from types import SimpleNamespace

    from strut_motion import panel

    texts: list[str] = []
    for cls in (panel.STRUT_PT_panel, panel.STRUT_PT_parts, panel.STRUT_PT_roles, panel.STRUT_PT_options):
        cls.draw(SimpleNamespace(layout=Layout(texts)), bpy.context)
    return texts


def test_the_panel_shows_what_there_is_to_set(settings: Any, clip: Path) -> None:
    import_bvh(clip)
    bpy.ops.strut_motion.find_roles()
    texts = drawn()
    for text in ("Proud", "Old", "Stylize", "Find Roles", "Left Arm", "Timing", "Plant Feet"):
        assert text in texts, texts
    state = bpy.context.window_manager.strut_motion
    state.is_running, state.share = True, 0.5
    assert "Styling. Esc cancels 0.50" in drawn()
    assert not bpy.ops.strut_motion.stylize.poll()
    state.is_running = False
