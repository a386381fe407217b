"""Build wheels for platforms with compiled kernels of the shipped mechanisms, which then run without a compiler.

    python tools/wheels.py dist                       # x86-64 and ARM Linux, and the one for all other machines
    python tools/wheels.py dist --machine aarch64     # one of them

zig (`gudgeon[cc]`) cross-compiles for every machine. The bundled kernels run on every processor of the architecture,
with glibc 2.17 or later. If a compiler is found, gudgeon compiles for the present processor in addition.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading import compiler
from gudgeon.loading.build import build_portable_library
from gudgeon.loading.cache import Cache
from gudgeon.loading.generated_scenes import read_scenes
from gudgeon.loading.library import BUNDLED_FOLDER, compute_library_file_name, format_platform

ROOT = Path(__file__).resolve().parent.parent
GLIBC = (2, 17)
MACHINES = ("x86_64", "aarch64")
PACKAGE_FILES = ("pyproject.toml", "LICENSE", "README.md")  # files next to the packages


def read_all_scenes(generated: Path, mechanism: str = "*") -> list[KernelSource]:
    """Return every scene in `generated`, of one mechanism or of all."""
    return [source for folder in sorted(generated.glob(f"{mechanism}/")) for source in read_scenes(folder)]


def compile_libraries(machine: str, scenes: list[KernelSource], folder: Path) -> None:
    """Compile the libraries of scenes into a folder, for Linux on a machine."""
    target = f"{machine}-linux-gnu.{GLIBC[0]}.{GLIBC[1]}"
    os.environ["CC"] = " ".join([str(compiler.find_zig()), "cc", *compiler.ZIG_FLAGS, "-s", "-target", target])
    folder.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as scratch:
        cache = Cache(Path(scratch) / "cache")
        for scene in scenes:
            directory = Path(scratch) / scene.mechanism / scene.scene
            directory.mkdir(parents=True)
            shutil.copyfile(build_portable_library(directory, scene, cache), folder / compute_library_file_name(scene))


def make_wheel(out: Path, machine: str = "", scenes: list[KernelSource] | None = None) -> None:
    """Build one wheel: for a machine's Linux with the kernels of these scenes, or for all machines without kernels."""
    with tempfile.TemporaryDirectory() as scratch:
        copy = Path(scratch) / "package"
        shutil.copytree(ROOT / "src", copy / "src")  # follows links
        for name in PACKAGE_FILES:
            shutil.copy(ROOT / name, copy / name)
        settings = {}
        if machine:
            compile_libraries(
                machine, scenes or [], copy / "src/gudgeon" / BUNDLED_FOLDER.name / format_platform("linux", machine)
            )
            settings["--build-option"] = f"--plat-name=manylinux_{GLIBC[0]}_{GLIBC[1]}_{machine}"
        code = f"import setuptools.build_meta as b; b.build_wheel({str(out.resolve())!r}, {settings!r})"
        made = subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=copy, capture_output=True, text=True)
        if made.returncode:
            raise SystemExit(made.stderr)


def main() -> None:
    """Build the wheels and print their sizes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path, help="the folder for the wheels")
    parser.add_argument("--machine", choices=MACHINES, help="only the wheel of this machine")
    parser.add_argument("--mechanism", default="*", help="bundle the scenes of this mechanism only")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    scenes = read_all_scenes(ROOT / "generated", arguments.mechanism)
    for machine in [arguments.machine] if arguments.machine else ["", *MACHINES]:
        make_wheel(arguments.out, machine, scenes)
    for path in sorted(arguments.out.glob("*.whl")):
        print(f"{path.stat().st_size / 1e6:6.2f} MB  {path.name}")


if __name__ == "__main__":
    main()
