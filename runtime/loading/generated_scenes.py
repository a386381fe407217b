"""Read and write `generated/<mechanism>/`, the generated C of a mechanism's scenes; equal texts are stored once.

Texts for readers are files, `<scene>/<name>`. All other texts, and the rest of each KernelSource, are in one compressed
archive. Scenes with the same text refer to the file of the first one.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from gudgeon.contract.kernel_source import KernelSource

ARCHIVE = "compiled.json.xz"


def write_scenes(folder: Path, sources: Iterable[KernelSource], readable_names: Collection[str]) -> None:
    """Write the scenes of a mechanism and remove every other file in the folder.

    readable_names: names of files that are stored as files; all others go to the archive.
    An archive with the same contents is not rewritten, since its bytes depend on the version of liblzma.
    """
    scenes: dict[str, Any] = {}
    paths: dict[str, str] = {}  # by text
    for source in sources:
        files = {name: paths.setdefault(text, f"{source.scene}/{name}") for name, text in sorted(source.files.items())}
        scenes[source.scene] = {"files": files, "rest": replace(source, files={}).to_json()}
    plain = {path: text for text, path in paths.items() if path.rpartition("/")[2] in readable_names}
    packed = {path: text for text, path in paths.items() if path not in plain}
    _remove_other_files(folder, {ARCHIVE, *plain})
    for path, text in plain.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(text.encode())
    archive = {"scenes": scenes, "texts": packed}
    if read_archive(folder) != archive:
        import lzma

        folder.mkdir(parents=True, exist_ok=True)
        (folder / ARCHIVE).write_bytes(lzma.compress(json.dumps(archive, ensure_ascii=False).encode()))


def _remove_other_files(folder: Path, kept_paths: Collection[str]) -> None:
    """Remove all files below the folder whose relative paths are not in `kept_paths`, and empty folders."""
    for path in sorted(folder.rglob("*"), reverse=True):  # the contents of a folder precede the folder
        if path.is_dir():
            if not any(path.iterdir()):
                path.rmdir()
        elif path.relative_to(folder).as_posix() not in kept_paths:
            path.unlink()


def read_scene(folder: Path, scene: str) -> KernelSource | None:
    """Return the kernel source of a scene that `write_scenes` wrote; None if it is absent or cannot be read.

    Texts come from the archive of the folder or from files in it. A source that another version wrote cannot be read.
    """
    archive = read_archive(folder)
    try:
        stored, packed = archive["scenes"][scene], archive["texts"]
        files = {
            name: packed[path] if path in packed else (folder / path).read_bytes().decode()
            for name, path in stored["files"].items()
        }
        return replace(KernelSource.from_json(stored["rest"]), files=files)
    except (OSError, ValueError, TypeError, KeyError):  # absent, truncated, or written by another version
        return None


def read_scenes(folder: Path) -> list[KernelSource]:
    """Return all readable scenes of a mechanism."""
    scenes = (read_scene(folder, scene) for scene in read_archive(folder).get("scenes", ()))
    return [source for source in scenes if source is not None]


def read_archive(folder: Path) -> dict[str, Any]:
    """Return the contents of the archive: "scenes" with the path of each text, and "texts" by path; {} if damaged."""
    try:
        import lzma  # some builds of Python lack it: scenes are then derived

        data: dict[str, Any] = json.loads(lzma.decompress((folder / ARCHIVE).read_bytes()))
        return data
    except (ImportError, OSError, EOFError, ValueError):
        return {}
    except lzma.LZMAError:
        return {}
