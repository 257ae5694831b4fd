"""Properties and behaviour of the package's objects."""

import multiprocessing
import pickle
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import strut


def test_a_database_says_what_it_holds(db: strut.Database, files: Path):
    assert (db.rate_hz, db.neutral, len(db.clips)) == (60.0, "neutral", 48)
    assert db.frames == 27626 and set(db.actions) >= {"walk", "jump"} and "old" in db.styles
    assert "walk/old" in db.classes and db.refused == {} and db.name == str(files / "demo.strutdb")
    assert db.to_bytes() == (files / "demo.strutdb").read_bytes()


def test_a_motion_is_arrays_on_the_databases_body(db: strut.Database, jump: strut.Motion):
    poses, contacts = jump.poses(db), jump.contacts(db)
    assert poses.dtype == np.float32 and poses.shape[1] == 87 and poses.flags.c_contiguous
    assert contacts.dtype == np.uint8 and contacts.shape == (len(poses), 2)
    assert abs(len(poses) / db.rate_hz - jump.duration_secs) < 2 / db.rate_hz
    np.testing.assert_allclose(np.linalg.norm(poses[:, 3:].reshape(-1, 21, 4), axis=2), 1, atol=1e-5)
    assert jump.roles["hips"] and jump.rate_hz == pytest.approx(jump.frames / jump.duration_secs, rel=0.05)


def test_a_styled_motion_is_arrays_too(db: strut.Database, jump: strut.Motion):
    styled = strut.stylize(jump, db, {"old": 1})
    assert styled.poses.shape == jump.poses(db).shape
    assert (np.diff(styled.time_out) > 0).all() and styled.planted.shape == (len(styled.poses), 2)
    assert max(styled.class_weights, key=styled.class_weights.__getitem__).startswith("jump/")
    assert sum(styled.class_weights.values()) == pytest.approx(1, abs=1e-3) and styled.repaired == 0
    even = styled.to_arrays(30)
    assert even.rate_hz == 30 and len(even.poses) == len(even.input_frame)
    assert len(even.poses) == pytest.approx(styled.duration_secs * 30, abs=2)


def test_poses_are_styled_one_by_one_or_many_at_a_time_alike(db: strut.Database, jump: strut.Motion):
    poses = jump.poses(db)
    whole = strut.Stylizer(db, "old").push(poses)
    stylizer = strut.Stylizer(db, "old")
    each = np.concatenate([stylizer.push(poses[i : i + 1]).poses for i in range(len(poses))])
    np.testing.assert_array_equal(whole.poses, each)
    stylizer.reset()
    np.testing.assert_array_equal(stylizer.push(poses).poses, each)

    stylizer = strut.Stylizer(db, "old", k=20)
    before = stylizer.push(poses[:30])
    stylizer.set_styles({"proud": 0.5}, {"legs": "old"})
    stylizer.configure(rho=0.2, footplant=False)
    after = stylizer.push(poses[30:])
    assert len(before.poses) + len(after.poses) == len(poses)
    assert (after.poses != whole.poses[30:]).any()


def test_many_motions_come_in_their_order_with_errors_in_their_places(db: strut.Database, files: Path, jump: strut.Motion):
    text = Path(jump.name).read_text()
    head, motion = text.split("MOTION")
    lines = motion.strip().split("\n")
    brief = strut.Motion.open((head + "MOTION\nFrames: 2\n" + "\n".join(lines[1:4]) + "\n").encode())
    kick = strut.Motion.open(files / "clips" / "kick_neutral_001.bvh")
    results = list(strut.stylize_many(iter([jump, brief, kick]), db, "old", threads=2))
    assert isinstance(results[1], strut.StrutError) and "at least" in results[1].message
    for motion, styled in [(jump, results[0]), (kick, results[2])]:
        assert isinstance(styled, strut.StyledMotion)
        assert styled.to_bvh() == strut.stylize(motion, db, "old").to_bvh()
    with pytest.raises(TypeError):
        list(strut.stylize_many([jump, "a path"], db, "old"))


def test_errors_are_sentences_with_a_code(db: strut.Database, jump: strut.Motion, tmp_path: Path):
    (tmp_path / "bad.bvh").write_text("HIERARCHY\nnothing")
    with pytest.raises(strut.StrutError) as error:
        strut.Motion.open(tmp_path / "bad.bvh")
    assert error.value.code == "bad-file" and str(error.value).startswith(f"{tmp_path}/bad.bvh: line 2")
    assert pickle.loads(pickle.dumps(error.value)).code == "bad-file"
    for styles, options in [("odl", {}), ({"old": 11}, {}), ({"old": float("nan")}, {}), ("old", {"k": 0}), ("old", {"rho": "x"})]:
        with pytest.raises(strut.StrutError) as error:
            strut.stylize(jump, db, styles, **options)
        assert error.value.code == "bad-input"
    with pytest.raises(FileNotFoundError):
        strut.Database.open(tmp_path / "none.strutdb")
    with pytest.raises(FileNotFoundError):
        strut.stylize(jump, db, "old").save(tmp_path / "none" / "out.bvh")
    for wrong in ({"q": 1}, {"part": "legs:old"}):
        with pytest.raises(TypeError):
            strut.stylize(jump, db, "old", **wrong)


def test_arrays_of_another_kind_are_refused(db: strut.Database, jump: strut.Motion):
    poses = jump.poses(db)
    stylizer = strut.Stylizer(db, "old")
    for wrong in (poses.astype(np.float64), poses[:, :86], poses[::2], np.asfortranarray(poses), poses[0], [[0.0] * 87]):
        with pytest.raises(strut.StrutError, match="C-contiguous float32 of 87 columns"):
            stylizer.push(wrong)
    assert len(stylizer.push(poses[:0]).poses) == 0


def test_pickled_objects_open_again_as_the_same(db: strut.Database, jump: strut.Motion, files: Path, tmp_path: Path):
    again, motion = pickle.loads(pickle.dumps((db, jump)))
    assert len(pickle.dumps(db)) < 1000, "a path, not the file"
    assert again.sha256 == db.sha256 and motion.frames == jump.frames
    in_memory = strut.Database.open((files / "demo.strutdb").read_bytes())
    assert pickle.loads(pickle.dumps(in_memory)).sha256 == db.sha256

    moved = tmp_path / "moved.strutdb"
    other = strut.Database.build(sorted((files / "clips").glob("jump_*.bvh"))[:3], rate_hz=30)
    other.save(moved)
    pickled = pickle.dumps(strut.Database.open(moved))
    moved.write_bytes(db.to_bytes())
    with pytest.raises(strut.StrutError, match="was expected"):
        pickle.loads(pickled)


def test_processes_may_fork(db: strut.Database, jump: strut.Motion):
    strut.stylize(jump, db, "old", threads=2)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply(bvh_of, (jump, db)) == strut.stylize(jump, db, "old").to_bvh()


def bvh_of(motion: strut.Motion, db: strut.Database) -> str:
    return strut.stylize(motion, db, "old", threads=2).to_bvh()


def test_other_threads_run_meanwhile(db: strut.Database, files: Path):
    walk = strut.Motion.open(files / "clips" / "walk_neutral_001.bvh")
    counted, is_over = 0, threading.Event()

    def work() -> None:
        strut.stylize(walk, db, "old", threads=1)
        is_over.set()

    worker = threading.Thread(target=work)
    worker.start()
    while not is_over.is_set():
        counted += 1
        time.sleep(0.001)
    worker.join()
    # If the interpreter lock were held, there would be hardly one iteration.
    assert counted >= 5, counted


def test_progress_and_its_exceptions_reach_the_caller(db: strut.Database, files: Path):
    walk = strut.Motion.open(files / "clips" / "walk_neutral_001.bvh")
    steps = []
    strut.stylize(walk, db, "old", threads=1, progress=lambda *step: steps.append(step))
    what, done, total = steps[-1]
    assert what == "styling" and done == total == len(walk.poses(db))

    def stop(*_: object) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        strut.stylize(walk, db, "old", progress=stop)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_interrupts(db: strut.Database, files: Path):
    walk = strut.Motion.open(files / "clips" / "walk_neutral_001.bvh")
    styled = 0

    def motions():
        while True:
            yield walk

    threading.Timer(0.3, signal.raise_signal, (signal.SIGINT,)).start()
    with pytest.raises(KeyboardInterrupt):
        for _ in strut.stylize_many(motions(), db, "old", threads=1):
            styled += 1


def test_metrics_are_those_of_the_positions(db: strut.Database, jump: strut.Motion):
    poses = jump.poses(db)
    points = strut.positions(db, poses)
    assert points.dtype == np.float32 and points.shape == (len(poses), 21, 3)
    np.testing.assert_allclose(points[:, 0], poses[:, :3])
    raised = poses.copy()
    raised[:, 1] += 0.25
    assert strut.metrics.pose_error(db, poses, raised) == pytest.approx(0.25, abs=1e-5)
    acceleration = np.diff(points.astype(np.float64), n=2, axis=0) * db.rate_hz**2
    expected = np.linalg.norm(acceleration, axis=2).mean()
    assert strut.metrics.mean_acceleration(db, poses) == pytest.approx(expected, rel=1e-3)
    jerk = np.linalg.norm(np.diff(points.astype(np.float64), n=3, axis=0) * db.rate_hz**3, axis=2).mean()
    assert strut.metrics.mean_jerk(db, poses) == pytest.approx(jerk, rel=1e-2)
    still = np.repeat(poses[:1], 10, axis=0)
    assert strut.metrics.foot_skate(db, still) == 0
    sliding = still.copy()
    sliding[:, 0] += np.arange(10) / db.rate_hz
    planted = np.ones((10, 2), np.uint8)
    assert strut.metrics.foot_skate(db, sliding, planted) == pytest.approx(1, rel=1e-3)
    with pytest.raises(strut.StrutError, match=r"\[10, 2\] was expected"):
        strut.metrics.foot_skate(db, sliding, planted[:5])
    with pytest.raises(strut.StrutError, match="equal numbers were expected"):
        strut.metrics.pose_error(db, poses, poses[:5])


def test_calls_keep_no_memory(db: strut.Database, jump: strut.Motion):
    resource = pytest.importorskip("resource")
    poses = jump.poses(db)
    stylizer = strut.Stylizer(db, "old")

    def call(times: int) -> None:
        for _ in range(times):
            stylizer.push(poses[:1])
            strut.positions(db, poses[:2])

    call(1000)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    call(10_000)
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert kilobytes <= 5000, kilobytes
