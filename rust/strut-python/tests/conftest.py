"""Files of the built-in motions, written by the command, and an open database."""

import os
import subprocess
from pathlib import Path

import pytest
import strut


def command(*args: object) -> None:
    """Runs `strut`, whose path is in STRUT_COMMAND."""
    subprocess.run([os.environ["STRUT_COMMAND"], *map(str, args)], check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="session")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Creates a folder with `demo.strutdb` and its clips in `clips/`."""
    folder = tmp_path_factory.mktemp("files")
    command("demo-db", "--page", "-o", folder / "demo.strutdb", "--bvh", folder / "clips")
    return folder


@pytest.fixture(scope="session")
def db(files: Path) -> strut.Database:
    return strut.Database.open(files / "demo.strutdb")


@pytest.fixture(scope="session")
def jump(files: Path) -> strut.Motion:
    """A short clip."""
    return strut.Motion.open(files / "clips" / "jump_neutral_001.bvh")


@pytest.fixture(scope="session")
def walks(files: Path) -> strut.WalkModel:
    """A walk model of several styles."""
    return strut.WalkModel.train(sorted((files / "clips").glob("walk_*_001.bvh")))


@pytest.fixture(scope="session")
def keys(files: Path) -> strut.KeyStyleModel:
    """A key-style model of two style variables."""
    return strut.KeyStyleModel.train(sorted((files / "clips").glob("jump_*.bvh"))[:2], "hips_height,speed", components=4)
