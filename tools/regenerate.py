"""Derive every scene of every shipped mechanism anew and write generated/ (run by `make generated`)."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.generator.targets.c.readme import READABLE
from gudgeon.loading.generated_scenes import ARCHIVE, read_archive, read_scenes, write_scenes

README = f"""# The C of the shipped mechanisms

`make generated` writes this folder; nothing in it is edited by hand. Each scene of a mechanism has a folder with the
files that a person reads. Read `model.h` first, for the names, then `dynamics.c`, which solves the equations of motion
as they are taught, and `reduced.c` or `positions.c`, which a run evaluates. `gudgeon emit NAME` writes all files of a
mechanism's scenes and a `README.md` that describes each file.

`{ARCHIVE}` holds what only the compiler and the runtime read: derivatives for stiff methods (`newton.c`), the
vector code of batches (`lanes.c`), and the names of coordinates, parameters and results.

A file that several scenes of a mechanism have in common is stored once. These scenes use files of another scene:

"""


def regenerate(mechanisms: Path, generated: Path) -> None:
    """Write `generated/<mechanism>/` for each file, remove other folders, and print each changed text."""
    shared = ""
    for file in sorted(mechanisms.glob("*.yaml")):
        data, folder = file.read_bytes(), generated / file.stem
        scenes = read_mechanism(data, file.name, None).scenes
        before = {source.scene: source for source in read_scenes(folder)}
        sources = [generate_kernel_source(data, file.name, scene, None) for scene in scenes]
        write_scenes(folder, sources, READABLE)
        for source in sources:
            print(f"generated/{file.stem}/{source.scene}{_list_changes(before.get(source.scene), source)}")
        shared += _list_shared(folder)
    for folder in generated.glob("*/"):
        if not (mechanisms / f"{folder.name}.yaml").exists() and folder.name != "__pycache__":
            shutil.rmtree(folder)
    (generated / "README.md").write_bytes((README + shared).encode())


def _list_changes(before: KernelSource | None, now: KernelSource) -> str:
    """Return the names of changed texts of a scene, for a message; "" if none differs.

    `git diff` does not show differences within the archive.
    """
    if before is None or before == now:
        return "" if before else ": new"
    names = sorted({*before.files, *now.files})
    changed = [name for name in names if before.files.get(name) != now.files.get(name)]
    return f": changed {', '.join(changed) or 'names and numbers'}"


def _list_shared(folder: Path) -> str:
    """Return a line for each scene of a mechanism that uses files of another scene."""
    lines = ""
    for scene, stored in read_archive(folder)["scenes"].items():
        paths = [path for path in stored["files"].values() if not path.startswith(f"{scene}/")]
        links = [f"[{path}]({folder.name}/{path})" for path in paths if (folder / path).exists()]
        lines += f"- `{folder.name}/{scene}`: {', '.join(links)}\n" if links else ""
    return lines


if __name__ == "__main__":
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("generated", type=Path, nargs="?", default=root / "generated", help="another folder for it")
    regenerate(root / "mechanisms", parser.parse_args().generated)
