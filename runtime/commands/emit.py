"""Run `gudgeon emit`: write the generated C, one folder for each scene and one for the engine."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

from gudgeon.commands.common import check_output_folder, select_scenes
from gudgeon.commands.outcome import report_note, report_written_file
from gudgeon.commands.progress import show_status_line
from gudgeon.errors import InputError, shorten_path
from gudgeon.files.writing import PART, AtomicFiles, check_output_path, read_regular_file
from gudgeon.loading import compiler
from gudgeon.loading.engine import read_engine_files, read_engine_readme
from gudgeon.loading.kernel_sources import find_kernel_source, find_mechanism, read_bytes

ENGINE_FOLDER = "engine"  # folder of the files that all scenes use
DESCRIPTION = "kernel.json"  # description of a scene, without its source texts
CHECKSUM_LIST = "emitted.sha256"  # list of the written files in the format of `sha256sum -c`
_CHECKSUM_LINE = re.compile(r"([0-9a-f]{64})  ([A-Za-z0-9_][A-Za-z0-9_.]*)")  # a plain name, without a path


def emit_c(mechanism: str, folder: Path, scene_names: tuple[str, ...]) -> int:
    """Run `gudgeon emit`: write `folder/<scene>/*` and `folder/engine/*`, and return the exit code.

    The engine is written only if a scene needs it. If `folder` ends in .fmu, an FMU of one scene is written instead.
    Raises InputError, before anything is written, if a folder contains other files.
    """
    if folder.suffix.lower() == ".fmu":
        return _emit_fmu(mechanism, folder, scene_names)
    check_output_folder("--out", folder)
    scenes, engine_folders = select_scenes(mechanism, scene_names), _group_engine_files()
    _check_distinct_folders(scenes)
    for scene in scenes:
        refuse_foreign_files(folder / scene)
    for engine_folder in engine_folders:
        refuse_foreign_files(
            folder / engine_folder,
            {inner.rpartition("/")[2] for inner in engine_folders if inner.startswith(f"{engine_folder}/")},
        )
    file = find_mechanism(mechanism)
    data = read_bytes(file)
    needs_engine = False
    for scene in scenes:
        with show_status_line():
            source, _ = find_kernel_source(data, file, scene)
        texts = {**source.files, DESCRIPTION: replace(source, files={}).to_json() + "\n"}
        _write_folder(folder / scene, {name: text.encode() for name, text in texts.items()})
        report_written_file(scene, folder / scene, f": {', '.join(texts)}")
        needs_engine |= not source.cdef
    if needs_engine:
        for engine_folder, texts in engine_folders.items():
            _write_folder(folder / engine_folder, {name: text.encode() for name, text in texts.items()})
        report_written_file(ENGINE_FOLDER, folder / ENGINE_FOLDER, ": files that all scenes use")
    return 0


def _emit_fmu(mechanism: str, target: Path, scene_names: tuple[str, ...]) -> int:
    """Write an FMU of one scene ("ideal" if `scene_names` is empty), report its kinds, and return the exit code 0.

    Raises InputError for several scenes.
    """
    scenes = select_scenes(mechanism, scene_names or ("ideal",))
    if len(scenes) != 1:
        raise InputError(f"an FMU contains one scene, not {len(scenes)}", hint="select one with --scene")
    check_output_path(target)
    from gudgeon.exchange.fmu import write_fmu
    from gudgeon.exchange.fmu_description import explain_exchange_obstacle
    from gudgeon.simulation.from_file import load

    with show_status_line():
        simulation = load(mechanism, scene=scenes[0])
        write_fmu(simulation, target)
    obstacle = explain_exchange_obstacle(simulation.source)
    kinds = f"Co-Simulation only ({obstacle})" if obstacle else "Co-Simulation and Model Exchange"
    report_written_file("fmu", target, f": FMI 3.0, {kinds}, scene {scenes[0]}")
    if other_scenes := [scene for scene in select_scenes(mechanism, ()) if scene not in scenes and not scene_names]:
        report_note(f"other scenes, by --scene: {', '.join(other_scenes)}")
    if not compiler.has_compiler():
        report_note("no C compiler was found: the FMU contains only sources, which the importer compiles")
    return 0


def _check_distinct_folders(scenes: tuple[str, ...]) -> None:
    """Raise InputError if two scenes, or a scene and the engine, would share a folder.

    Names are compared without case, because some file systems ignore it.
    """
    owners = {ENGINE_FOLDER: ""}
    for scene in scenes:
        other = owners.setdefault(scene.casefold(), scene)
        if other != scene:
            message = f"it needs the folder of scene {other!r}" if other else "its folder is that of the engine"
            hint = "rename the scene, or select other scenes with --scene"
            raise InputError(f"scene {scene!r} cannot be emitted: {message}", hint=hint)


def _group_engine_files() -> dict[str, dict[str, str]]:
    """Return the engine's source texts and README by folder and file name: {"engine/run": {"run.c": text}}.

    Outer folders come first.
    """
    engine_folders: dict[str, dict[str, str]] = {}
    for path, text in sorted((*read_engine_files().items(), read_engine_readme())):
        engine_folder, _, name = path.rpartition("/")
        engine_folders.setdefault(engine_folder, {})[name] = text
    return dict(sorted(engine_folders.items()))


def _write_folder(folder: Path, texts: dict[str, bytes]) -> None:
    """Write all texts and their list of checksums into a folder, or none of them.

    Unchanged files of an earlier `emit` without a text are removed, and temporary files of a killed process. A
    list of old and new files is written first, so that every file is listed even if the process is killed.
    """
    old, new = _read_checksums(folder), {name: {sha256(text).hexdigest()} for name, text in texts.items()}
    old_and_new = {name: old.get(name, set()) | new.get(name, set()) for name in (*new, *(old.keys() - new.keys()))}
    with AtomicFiles(folder, follow=False) as atomic_files:
        atomic_files.write(CHECKSUM_LIST, _format_checksums(old_and_new))
        for name, text in texts.items():
            atomic_files.write(name, text)
        atomic_files.write(CHECKSUM_LIST, _format_checksums(new))
        atomic_files.move_files(1 + len(texts))
        for name in old.keys() - new.keys():
            atomic_files.remove_file(name, lambda data, sums=old[name]: sha256(data).hexdigest() in sums)  # type: ignore[misc]
        for path in folder.iterdir():
            if PART.fullmatch(path.name):  # a temporary file of a killed process
                atomic_files.remove_file(path.name, lambda data: any(text.startswith(data) for text in texts.values()))
        atomic_files.move_files()


def _format_checksums(sums: Mapping[str, set[str]]) -> bytes:
    """Return the list of checksums in the format of `sha256sum -c`."""
    return "".join(f"{total}  {name}\n" for name, totals in sums.items() for total in sorted(totals)).encode()


def _read_checksums(folder: Path) -> dict[str, set[str]]:
    """Return the SHA-256 sums of files that an earlier `emit` wrote into the folder, by file name.

    A file has several sums if a process was killed. {} without a valid list.
    """
    sums_by_name: dict[str, set[str]] = {}
    for line in (read_regular_file(folder / CHECKSUM_LIST) or b"").decode(errors="replace").splitlines():
        parts = _CHECKSUM_LINE.fullmatch(line)
        if not parts:
            return {}
        sums_by_name.setdefault(parts[2], set()).add(parts[1])
    return sums_by_name


def refuse_foreign_files(folder: Path, subfolders: Collection[str] = ()) -> None:
    """Raise InputError if the folder contains anything but unchanged files of an earlier `emit`.

    An absent folder is accepted; a symbolic link, a file and an invalid list of checksums are refused. subfolders:
    names of subfolders that are checked separately.
    """
    shown = shorten_path(folder)
    try:
        if folder.is_symlink():
            raise InputError(f"{shown} is a link: nothing is written through it", hint="name another folder")
        if not folder.exists():
            return
        if not folder.is_dir():
            raise InputError(f"{shown} is a file", hint="name another folder")
        sums_by_name = _read_checksums(folder)
        if not sums_by_name and read_regular_file(folder / CHECKSUM_LIST):
            message = f"{folder / CHECKSUM_LIST} is not a list of checksums that `emit` wrote"
            raise InputError(message, hint="restore the list, remove the folder, or name another one")
        known_names = (
            path.name
            for path in folder.iterdir()
            if _is_unchanged_output(path, sums_by_name) or _is_named_folder(path, subfolders)
        )
        foreign = sorted({path.name for path in folder.iterdir()} - set(known_names))
    except OSError as error:
        raise InputError(f"{shown} cannot be read: {error.strerror or error}", hint="name another folder") from error
    listed_names = [name for name in foreign if name in sums_by_name]
    if foreign and listed_names == foreign:
        differing = ", ".join(listed_names[:5])
        message = f"{shown}: {differing} and the checksums in {CHECKSUM_LIST} differ: files or list were changed"
        raise InputError(message, hint="restore the changed files, move them away or name another folder")
    if foreign:
        foreign, hint = [name for name in foreign if name not in sums_by_name], "move them away or name another folder"
        raise InputError(f"{shown} contains files that `emit` did not write: {', '.join(foreign[:5])}", hint=hint)


def _is_named_folder(path: Path, names: Collection[str]) -> bool:
    """Return whether `path` is a folder, not a link, with one of the names."""
    return path.name in names and path.is_dir() and not path.is_symlink()


def _is_unchanged_output(path: Path, sums_by_name: Mapping[str, set[str]]) -> bool:
    """Return whether a file is as `emit` wrote it, is the list of checksums, or is a temporary file of `emit`.

    `sums_by_name`: the checksums in the list.
    """
    if path.is_symlink() or not path.is_file():
        return False
    if path.name == CHECKSUM_LIST:
        return bool(sums_by_name) or path.stat().st_size == 0
    if PART.fullmatch(path.name):
        return True
    data = read_regular_file(path) if path.name in sums_by_name else None
    return data is not None and sha256(data).hexdigest() in sums_by_name[path.name]
