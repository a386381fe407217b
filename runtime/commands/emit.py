"""`gudgeon emit`: the generated C as files, a folder a scene."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

from gudgeon.commands.common import chosen_scenes
from gudgeon.errors import GudgeonError, InputError
from gudgeon.loading import find_mechanism, kernel_source, read_bytes
from gudgeon.shipped import REST
from gudgeon.writing import write_text

LIST = "emitted.sha256"  # what was written, as `sha256sum -c` reads it


def emit_c(mechanism: str, folder: Path, wanted: tuple[str, ...]) -> int:
    """Write `folder/<scene>/*.c, *.h, kernel.json`; nothing is written if any folder holds something else."""
    scenes = chosen_scenes(mechanism, wanted)
    for scene in scenes:
        refuse_foreign(folder / scene)
    file = find_mechanism(mechanism)
    data = read_bytes(file)
    for scene in scenes:
        source, _ = kernel_source(data, file, scene)
        texts = {**source.files, REST: replace(source, files={}).to_json() + "\n"}
        _write(folder / scene, texts)
        print(f"wrote {folder / scene}: {', '.join(texts)}")
    return 0


def _write(folder: Path, texts: dict[str, str]) -> None:
    """The texts and a list of them; what an earlier version wrote and this one does not is removed."""
    try:
        for name in _listed(folder).keys() - texts.keys():
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise GudgeonError(f"cannot write to {folder}: {error.strerror or error}") from error
    sums = {name: sha256(text.encode()).hexdigest() for name, text in texts.items()}
    for name, text in texts.items():
        write_text(folder / name, text)
    write_text(folder / LIST, "".join(f"{total}  {name}\n" for name, total in sums.items()))


def _listed(folder: Path) -> dict[str, str]:
    """Names and checksums of what an earlier `emit` wrote."""
    try:
        lines = (folder / LIST).read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return {}
    pairs = [line.split("  ", 1) for line in lines]
    return {pair[1]: pair[0] for pair in pairs if len(pair) == 2}


def refuse_foreign(folder: Path) -> None:
    """InputError if the folder holds anything but what an earlier `emit` has written there, unchanged."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise InputError(f"{folder} is a file", hint="name another folder")
    listed = _listed(folder)
    foreign = sorted(
        path.name
        for path in folder.iterdir()
        if path.name != LIST
        and not (path.is_file() and listed.get(path.name) == sha256(path.read_bytes()).hexdigest())
    )
    if foreign:
        hint = "move them away or name another folder"
        raise InputError(f"{folder} holds files that `emit` did not write so: {', '.join(foreign[:5])}", hint=hint)
