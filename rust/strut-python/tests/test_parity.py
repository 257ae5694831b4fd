"""What the package writes is what the command writes, byte for byte."""

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


def test_the_options_are_those_of_the_command():
    shown = subprocess.run([os.environ["STRUT_COMMAND"], "stylize", "-h"], check=True, capture_output=True, text=True).stdout
    options = set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", shown, re.MULTILINE)) | set(re.findall(r"^ +-(k) ", shown, re.MULTILINE))
    # Files, and what is an argument of its own; the search is exact.
    others = {"db", "input", "style", "output", "part", "trace", "threads", "help", "search"}
    assert others < options
    named = {name.strip("_").replace("_", "-") for name in strut.Options.__annotations__}
    assert named == options - others
