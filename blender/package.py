"""
Packs the extension with the wheels of the engine: python package.py --wheels FOLDER --out FOLDER.

Writes one file for all systems for which there are wheels. The wheels are those of the package `strut-motion`, unmodified.
"""

import argparse
import tomllib
import zipfile
from pathlib import Path

SOURCE = Path(__file__).parent / "strut_motion"
PLATFORMS = {
    ("linux", "x86_64"): "linux-x64",
    ("macosx", "x86_64"): "macos-x64",
    ("macosx", "arm64"): "macos-arm64",
    ("macosx", "universal2"): "macos-x64 macos-arm64",
    ("win", "amd64"): "windows-x64",
}
"""Blender's names of systems, by prefix and suffix of a wheel's platform."""


def platforms_of(wheel: str) -> list[str]:
    """Returns Blender's names of the systems of a wheel; empty for systems on which Blender does not run."""
    tag = wheel.removesuffix(".whl").rpartition("-")[2]
    system = "linux" if "linux" in tag else tag
    found = [names for (start, end), names in PLATFORMS.items() if system.startswith(start) and tag.endswith(end)]
    return found[0].split() if found else []


def manifest(wheels: list[str]) -> str:
    """Returns the manifest with the wheels and their systems."""
    text = (SOURCE / "blender_manifest.toml").read_text()
    platforms = sorted({name for wheel in wheels for name in platforms_of(wheel)})
    lines = [line for line in text.splitlines() if not line.startswith("platforms = ")]
    place = next(i for i, line in enumerate(lines) if line.startswith("license = ")) + 1
    quoted = ", ".join(f'"./wheels/{wheel}"' for wheel in wheels)
    lines[place:place] = [f"platforms = {platforms}".replace("'", '"'), f"wheels = [{quoted}]"]
    return "\n".join(lines) + "\n"


def pack(wheels: Path, out: Path) -> Path:
    """Writes the file and returns its path."""
    chosen = sorted(wheel for wheel in wheels.glob("strut_motion-*.whl") if platforms_of(wheel.name))
    if not chosen:
        raise SystemExit(f"error: there is no wheel of strut-motion in {wheels} for a system that Blender runs on.")
    text = manifest([wheel.name for wheel in chosen])
    version = tomllib.loads(text)["version"]
    out.mkdir(parents=True, exist_ok=True)
    path = out / f"strut_motion-{version}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("blender_manifest.toml", text)
        archive.write(SOURCE.parent / "LICENSE", "LICENSE")
        for module in sorted(SOURCE.glob("*.py")):
            archive.write(module, module.name)
        for wheel in chosen:
            archive.write(wheel, f"wheels/{wheel.name}", zipfile.ZIP_STORED)
    return path


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Packs the Blender extension with the wheels of the engine.")
    parser.add_argument("--wheels", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    print(pack(arguments.wheels, arguments.out))
