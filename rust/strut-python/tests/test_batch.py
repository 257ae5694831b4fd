"""Batches on several processes equal those of the command, even if processes are killed."""

import json
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import strut
from batch_driver import VARIANTS, drive, plan_of
from conftest import command

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals")


@pytest.fixture(scope="module")
def clips(files: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Creates a folder of short clips, one of which is invalid."""
    folder = tmp_path_factory.mktemp("batch") / "clips"
    (folder / "deep").mkdir(parents=True)
    for i, clip in enumerate(sorted((files / "clips").glob("jump_*.bvh"))[:6]):
        (folder / ("deep" if i % 2 else ".") / clip.name).write_bytes(clip.read_bytes())
    (folder / "none.bvh").write_text("no motion")
    return folder


@pytest.fixture(scope="module")
def undisturbed(files: Path, clips: Path) -> Path:
    """Runs the command on the clips, without interruption."""
    table = clips.parent / "variants.csv"
    table.write_text('variant,style\nold,old\nmixed,"proud=0.4,old=-0.2"\n')
    out = clips.parent / "command"
    command("stylize-batch", clips, "--db", files / "demo.strutdb", "--variants", table, "-k", "20", "-o", out)
    return out


def outputs(folder: Path) -> dict[Path, bytes]:
    """Returns all files except the manifest and its lock."""
    paths = [path for path in folder.rglob("*") if path.is_file() and not path.name.lstrip(".").startswith("manifest")]
    return {path.relative_to(folder): path.read_bytes() for path in paths}


def records(folder: Path) -> dict[str, dict]:
    """Returns the latest record of each job, without its time."""
    lines = [json.loads(line) for line in (folder / "manifest.jsonl").read_text().splitlines()]
    return {line["job"]: {name: value for name, value in line.items() if name != "time_ms"} for line in lines}


def assert_undisturbed(out: Path, undisturbed: Path) -> None:
    assert outputs(out) == outputs(undisturbed)
    assert records(out) == records(undisturbed)


def test_a_plan_is_the_commands_batch(files: Path, clips: Path, undisturbed: Path, tmp_path: Path):
    out = tmp_path / "out"
    plan = plan_of(clips, out, files / "demo.strutdb")
    assert drive(plan) and plan.pending() == []
    assert_undisturbed(out, undisturbed)
    assert len((out / "manifest.jsonl").read_text().splitlines()) == 14 == len(records(out))
    with pytest.raises(strut.StrutError, match="another process writes this manifest"):
        plan_of(clips, out, files / "demo.strutdb").pending()
    del plan

    # The command continues where a plan was stopped, and vice versa.
    first, *_ = outputs(out)
    (out / first).unlink()
    table = clips.parent / "variants.csv"
    report = tmp_path / "report.json"
    command("stylize-batch", clips, "--db", files / "demo.strutdb", "--variants", table, "-k", "20", "-o", out, "--json", report)
    assert json.loads(report.read_text())["styled"] == 1
    assert strut.batch.Plan(clips, out, files / "demo.strutdb", table, k=20).pending() == []
    again = strut.batch.Plan(clips, out, files / "demo.strutdb", table, k=20, retry="skipped")
    assert [job["job"] for job in again.pending()] == ["old/none.bvh", "mixed/none.bvh"]


def test_a_killed_worker_costs_no_job(files: Path, clips: Path, undisturbed: Path, tmp_path: Path):
    plan = plan_of(clips, tmp_path / "out", files / "demo.strutdb")
    recorded = 0

    def kill(pool) -> None:
        nonlocal recorded
        recorded += 1
        if recorded == 3:
            os.kill(next(iter(pool._processes)), signal.SIGKILL)

    assert not drive(plan, kill)
    assert 3 <= recorded < 14 and drive(plan)
    assert_undisturbed(tmp_path / "out", undisturbed)


def test_a_killed_driver_costs_no_job(files: Path, clips: Path, undisturbed: Path, tmp_path: Path):
    out = tmp_path / "out"
    arguments = [sys.executable, Path(__file__).parent / "batch_driver.py", clips, out, files / "demo.strutdb"]
    driver = subprocess.Popen(arguments, stdout=subprocess.PIPE, start_new_session=True)
    for _ in range(4):
        assert driver.stdout.readline()
    os.killpg(driver.pid, signal.SIGKILL)
    driver.wait()
    before = len(records(out))
    assert 4 <= before < 14
    (out / "old" / ".0.manifest.tmp").write_text("of a killed worker")
    rest = subprocess.run(arguments, check=True, stdout=subprocess.PIPE)
    assert rest.stdout.count(b"recorded") == 14 - before
    assert_undisturbed(out, undisturbed)


def test_a_copy_writes_the_same_or_nothing(files: Path, clips: Path, tmp_path: Path):
    database = tmp_path / "own.strutdb"
    database.write_bytes((files / "demo.strutdb").read_bytes())
    plan = plan_of(clips, tmp_path / "out", database)
    pickled = pickle.dumps(plan)
    assert len(pickled) < 1000 and pickle.loads(pickled).sha256 == plan.sha256
    other = strut.Database.build(sorted((files / "clips").glob("jump_*.bvh")), rate_hz=30)
    other.save(database)
    with pytest.raises(strut.StrutError, match="has changed since the batch was planned"):
        pickle.loads(pickled)
    in_memory = strut.batch.Plan(clips, tmp_path / "out", other, "old")
    assert pickle.loads(pickle.dumps(in_memory)).sha256 == in_memory.sha256


def test_an_archive_is_read_by_its_workers(files: Path, clips: Path, tmp_path: Path):
    import zipfile

    with zipfile.ZipFile(tmp_path / "clips.zip", "w") as archive:
        for clip in sorted(clips.glob("jump*.bvh"))[:1]:
            archive.write(clip, f"in/{clip.name}")
    plan = strut.batch.Plan(tmp_path / "clips.zip", tmp_path / "out", files / "demo.strutdb", "old=0.5,proud")
    (job,) = plan.pending()
    assert job["variant"] == "old=0.5+proud" and job["job"].startswith("old=0.5+proud/in/jump")
    assert pickle.loads(pickle.dumps(plan)).perform(job)["status"] == "done"


def test_what_cannot_be_planned_is_refused(files: Path, clips: Path, tmp_path: Path):
    of = lambda *args, **options: strut.batch.Plan(clips, tmp_path / "out", files / "demo.strutdb", *args, **options)  # noqa: E731
    for variants, options in [("odl", {}), ({}, {}), ({"../a": "old"}, {}), ({"a": "odl"}, {}), ("old", {"k": 0}), ("old", {"retry": "no"})]:
        with pytest.raises(strut.StrutError) as error:
            of(variants, **options)
        assert error.value.code == "bad-input"
    with pytest.raises(TypeError):
        of({1: "old"})
    with pytest.raises(FileNotFoundError):
        of(tmp_path / "none.csv")
    plan = of(VARIANTS)
    for job in [{"job": "old/a.bvh", "input": "a.bvh", "variant": "new"}, {"job": "../a.bvh", "input": "a.bvh", "variant": "old"}]:
        with pytest.raises(strut.StrutError) as error:
            plan.perform(job)
        assert error.value.code == "bad-input"
    with pytest.raises(TypeError):
        plan.perform({"job": "old/a.bvh"})
    record = plan.perform({"job": "old/a.bvh", "input": str(tmp_path / "a.bvh"), "variant": "old"})
    assert (record["status"], record["code"], record["key"]) == ("failed", "io", None)
    with pytest.raises(TypeError):
        plan.record([{**record, "bytes": "many"}])
    with pytest.raises(strut.StrutError):
        plan.record([{**record, "status": "perhaps"}])
    assert not (tmp_path / "out" / "manifest.jsonl").exists() or records(tmp_path / "out") == {}
