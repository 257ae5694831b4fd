"""The package's output equals the command's, byte for byte."""

import inspect
import os
import re
import subprocess
from pathlib import Path

import pytest
import strut
from conftest import command


@pytest.mark.parametrize(
    ("styles", "keywords", "arguments"),
    [
        ("old", {}, ["--style", "old"]),
        ({"proud": 0.4, "old": -0.2}, {"k": 20, "timing": False}, ["--style", "proud=0.4,old=-0.2", "-k", "20", "--timing", "off"]),
        ("old", {"lambda_": 0.3, "parts": {"left_arm": "proud"}}, ["--style", "old", "--lambda", "0.3", "--part", "left-arm:proud"]),
        ("old", {"action": "jump", "input_style": "neutral"}, ["--style", "old", "--action", "jump", "--input-style", "neutral"]),
    ],
)
def test_a_styled_clip(files: Path, db: strut.Database, jump: strut.Motion, tmp_path: Path, styles, keywords, arguments):
    command("stylize", "--db", files / "demo.strutdb", "--input", jump.name, "-o", tmp_path / "command.bvh", *arguments)
    for threads in (1, 2):
        strut.stylize(jump, db, styles, threads=threads, **keywords).save(tmp_path / "python.bvh")
        assert (tmp_path / "python.bvh").read_bytes() == (tmp_path / "command.bvh").read_bytes()


def test_a_built_database(files: Path, tmp_path: Path):
    clips = sorted((files / "clips").glob("jump_*.bvh"))[:4]
    (tmp_path / "bad_one_1.bvh").write_text("no motion")
    inputs = [*clips, tmp_path / "bad_one_1.bvh"]
    command("build-db", *inputs, "-o", tmp_path / "command.strutdb", "--rate", "30")
    steps = []
    built = strut.Database.build(inputs, rate_hz=30, progress=lambda *step: steps.append(step))
    assert built.to_bytes() == (tmp_path / "command.strutdb").read_bytes()
    assert list(built.refused) == [str(tmp_path / "bad_one_1.bvh")]
    assert steps and all(done <= total for _, done, total in steps)
    built.save(tmp_path / "python.strutdb")
    assert (tmp_path / "python.strutdb").read_bytes() == built.to_bytes()


def test_the_built_in_database(tmp_path: Path):
    command("demo-db", "-o", tmp_path / "command.strutdb")
    assert strut.Database.demo().to_bytes() == (tmp_path / "command.strutdb").read_bytes()


def options_of(*command: str) -> set[str]:
    """Returns the long options of a command, and -k."""
    shown = subprocess.run([os.environ["STRUT_COMMAND"], *command, "-h"], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", shown, re.MULTILINE)) | set(re.findall(r"^ +-(k) ", shown, re.MULTILINE))


def keywords_of(function: object) -> set[str]:
    """Returns the names of a function's arguments, and of its keyword options, in the command's form."""
    of = inspect.signature(function).parameters
    return {name.strip("_").replace("_", "-") for name in of if name not in ("self", "options")}


def names_of(options: type) -> set[str]:
    return {name.strip("_").replace("_", "-") for name in options.__annotations__}


READING = {"joints", "up", "floor", "swap-sides"}
"""Reading options, which are arguments of a motion."""

FILES = {"help", "json", "output"}
"""Output files, which are arguments of `save`."""


@pytest.mark.parametrize(
    ("function", "options", "command", "renamed", "only_here", "only_there"),
    [
        (strut.stylize, strut.Options, "stylize", {"styles": "style", "parts": "part"}, {"motion", "progress", "track"}, {"input"} | READING),
        (strut.stylize_many, strut.Options, "stylize", {"styles": "style", "parts": "part"}, {"motions"}, {"input", "trace"} | READING),
        (strut.Stylizer, strut.Options, "stylize", {"styles": "style", "parts": "part"}, set(), {"input", "trace", "threads"} | READING),
        (strut.batch.Plan, strut.Options, "stylize-batch", {"out": "output", "parts": "part", "roles": "joints"}, {"inputs"}, {"style", "shard", "strict", "threads"}),
        (strut.Motion.open, None, "inspect", {"roles": "joints"}, {"source"}, set()),
        (strut.Database.build, None, "build-db", {"rate-hz": "rate", "roles": "joints"}, {"clips", "progress", "threads"}, {"report", "registration"}),
        (strut.Database.add_style, None, "add-style", {"motion": "input", "name": "style"}, {"threads"}, {"db"}),
        (strut.WalkModel.train, None, "train-walk", {}, {"clips", "threads", "progress"}, set()),
        (strut.WalkModel.walk, None, "walk", {"styles": "style", "transitions": "transition"}, {"progress"}, {"model"}),
        (strut.KeyStyleModel.train, None, "train-key-style", {}, {"source", "threads", "progress"}, set()),
        (strut.KeyStyleModel.motion, None, "key-style", {}, set(), {"model"}),
        (strut.evaluate, strut.EvaluateOptions, "evaluate", {}, {"threads", "progress"}, {"curves", "progress"}),
    ],
)
def test_the_arguments_are_the_options_of_the_command(function, options, command, renamed, only_here, only_there):
    here = {renamed.get(name, name) for name in keywords_of(function)} | (names_of(options) if options else set())
    assert here - only_here - FILES == options_of(command) - only_there - FILES
