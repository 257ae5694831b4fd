"""
Common fixtures of the tests. `STRUT_BLENDER_FILES` is a folder that `npm run blender` fills: `demo.strutdb` and `clips/` of
`strut demo-db`, `rigs/` of scripts/blender/rigs.mjs.
"""

import json
import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent.parent))

FILES = Path(os.environ.get("STRUT_BLENDER_FILES", "files"))
status = 0
RIGS = json.loads((FILES / "rigs" / "rigs.json").read_text()) if (FILES / "rigs").exists() else []


@pytest.fixture(scope="session")
def clip() -> Path:
    """Path of a neutral walk."""
    return min((FILES / "clips").glob("walk*neutral*.bvh"))


@pytest.fixture(scope="session")
def database() -> Path:
    """Path of the built-in database."""
    return FILES / "demo.strutdb"


def pytest_sessionfinish(exitstatus: int) -> None:
    global status
    status = int(exitstatus)


def pytest_unconfigure() -> None:
    """Ends the process immediately: after failed tests, bpy may hang while it frees its data."""
    sys.stdout.flush()
    os._exit(status)
