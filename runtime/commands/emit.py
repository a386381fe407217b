"""`gudgeon emit`: the generated C as files, a folder a scene."""

from __future__ import annotations

from pathlib import Path

from gudgeon.commands.common import chosen_scenes
from gudgeon.errors import GudgeonError, InputError
from gudgeon.loading import find_mechanism, kernel_source, read_bytes
from gudgeon.shipped import REST, read_generated, write_generated


def emit_c(mechanism: str, folder: Path, wanted: tuple[str, ...]) -> int:
    """Write `folder/<scene>/*.c, *.h, kernel.json`; nothing is written if any folder holds something else."""
    scenes = chosen_scenes(mechanism, wanted)
    for scene in scenes:
        refuse_foreign(folder / scene)
    file = find_mechanism(mechanism)
    data = read_bytes(file)
    for scene in scenes:
        source, _ = kernel_source(data, file, scene)
        try:
            write_generated(source, folder / scene)
        except OSError as error:
            raise GudgeonError(f"cannot write to {folder / scene}: {error.strerror or error}") from error
        print(f"wrote {folder / scene}: {', '.join([*source.files, REST])}")
    return 0


def refuse_foreign(folder: Path) -> None:
    """InputError if the folder holds anything but what an earlier `emit` has written there."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise InputError(f"{folder} is a file", hint="name another folder")
    found = {path.name for path in folder.iterdir()}
    ours = read_generated(folder)
    foreign = sorted(found - {*ours.files, REST} if ours else found)
    # read_generated takes every C text in the folder for its own: the headers tell whose it is
    if ours:
        foreign += sorted(name for name, text in ours.files.items() if not is_ours(text))
    if foreign:
        hint = "move them away or name another folder"
        raise InputError(f"{folder} holds files that gudgeon did not write: {', '.join(foreign[:5])}", hint=hint)


def is_ours(text: str) -> bool:
    """Whether a C text is one of ours, by its first lines."""
    return "gudgeon" in text[:600]
