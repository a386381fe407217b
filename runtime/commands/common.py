"""Check and read what several commands share: names of scenes, values of --set, targets of output."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, Location, OutputError, UnknownNameError, shortened
from gudgeon.files.writing import check_target
from gudgeon.language.names import unknown
from gudgeon.loading.find import find_mechanism, generator_hash, read_bytes
from gudgeon.model.parameters import TOGETHER, addresses, as_parameter, check, given_slots, value

if TYPE_CHECKING:
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage

SCENES = "scenes.json"


def scene_names(mechanism: str) -> tuple[str, ...]:
    """Return the names of all scenes of a mechanism file, in its order; they are cached by the file's bytes."""
    from gudgeon.loading.cache import default_cache, digest

    file = find_mechanism(mechanism)
    data = read_bytes(file)

    def make(folder: Path) -> None:
        """Write the names of the scenes into the new cache entry `folder`."""
        from gudgeon.generator.reader.read import read_mechanism

        names = list(read_mechanism(data, str(file)).scenes)
        (folder / SCENES).write_text(json.dumps(names), encoding="utf-8")

    entry = default_cache().fetch("scenes", digest(["scenes/1", data, generator_hash()]), make)
    return tuple(json.loads((entry / SCENES).read_text(encoding="utf-8")))


def select_scenes(mechanism: str, expected: tuple[str, ...]) -> tuple[str, ...]:
    """Return the requested scenes, each once, or all scenes if none is requested.

    Raises UnknownNameError, with the nearest name, for a scene that the file does not have.
    """
    names = scene_names(mechanism)
    for scene in expected:
        if scene not in names:
            raise unknown(f"no scene {scene!r} in {mechanism}", scene, names)
    return tuple(dict.fromkeys(expected)) or names


def settings(texts: Iterable[str]) -> dict[str, float | str]:
    """Parse the texts `ADDRESS=VALUE` of `--set` and return the values by address.

    Raises BadValueError for other forms, and for a parameter that is set twice.
    """
    found: dict[str, float | str] = {}
    written: dict[str, str] = {}  # a parameter may be called with its section or without
    for text in texts:
        address, equals, given = (part.strip() for part in text.partition("="))
        if not (equals and address and given):
            raise BadValueError(f"--set {text}: expected ADDRESS=VALUE", hint="for example --set c=0.5mm")
        key = address.removeprefix("parameters.")
        if key in written:
            message = f"--set {text}: this number is set already, by --set {written[key]}"
            raise BadValueError(message, hint="set it once")
        written[key], found[address] = text, value(given)
    return found


def check_addresses(names: Iterable[str], file: str, sources: Sequence[KernelSource]) -> None:
    """Raise UnknownNameError for the first address of `--set` that no scene has.

    The error says what stands there if it is no parameter, else it names the nearest address.
    """
    known = tuple(dict.fromkeys(address for source in sources for address in addresses(source)))
    for name in names:
        if name in known:
            continue
        for source in sources:
            message, hint = as_parameter(source, name)
            if message:
                every = (*source.written, *source.expressions)
                meant = (name, f"expressions.{name}")
                place = next((Location(file, w.line, w.column) for w in every if w.address in meant), None)
                raise UnknownNameError(f"--set: {message}", place, hint)
        raise unknown(f"--set: no scene has a number {name!r}", name, known)


def known_settings(source: KernelSource, given: Mapping[str, float | str]) -> dict[str, float | str]:
    """Return those values of `--set` whose addresses the scene has; an ideal scene has no viscosity, for example."""
    known = set(addresses(source))
    return {address: number for address, number in given.items() if address in known}


def linkage_at_values(mechanism: Mechanism, linkage: NumPyLinkage, given: Mapping[str, float | str]) -> NumPyLinkage:
    """Return the closed linkage of a scene at other parameter values; the same object if nothing that matters is given.

    Addresses of other scenes are ignored. Raises BadValueError for values out of range.
    """
    from gudgeon.generator.pipeline import closed_linkage

    source, count = linkage.source, len(linkage.source.slots) + len(linkage.source.derived)
    known, p = known_settings(source, given), linkage.p[:count].copy()
    values, is_given = given_slots(source, known)
    p[: len(values)][is_given] = values[is_given]
    check(source, p, is_given)  # before derived values are computed
    gains = {*TOGETHER, *(name for names in TOGETHER.values() for name in names)}
    own = {name: x for name, x in known.items() if name not in gains}  # gains do not change the start
    if not own:
        return linkage
    try:
        found, _ = closed_linkage(mechanism, source.scene, own)
    except ArithmeticError as error:
        message = f"--set: what follows from these numbers is none ({error})"
        raise BadValueError(message, hint="look for one that is 0, or far too large") from error
    check(source, found.p[:count], is_given)
    return found


def check_folder(option: str, out: Path) -> None:
    """Raise InputError before a run if the folder `out` cannot be created or written.

    option: the command-line option for the message.
    """
    import tempfile

    try:
        there = next(path for path in (out.absolute(), *out.absolute().parents) if path.exists())
        for name in out.absolute().relative_to(there).parts:
            with suppress(FileNotFoundError, NotADirectoryError):
                (there / name).lstat()  # a name too long
    except OSError as error:  # a name too long, a folder that may not be entered
        message = f"{option} {shortened(out)}: {error.strerror or error}"
        raise InputError(message, hint="name another folder") from error
    if not there.is_dir():
        raise InputError(f"{option} {shortened(out)}: {shortened(there)} is a file", hint="name a folder")
    try:
        with tempfile.TemporaryFile(dir=there):  # permissions are not sufficient: the file system may be read-only
            pass
    except OSError as error:
        message = f"{option} {shortened(out)}: nothing can be written to {shortened(there)} ({error.strerror or error})"
        raise InputError(message, hint="name another folder") from error


def check_file(option: str, path: Path) -> None:
    """Raise InputError before a run if the file `path` cannot be written or replaced; `option`: name for the
    message.
    """
    check_folder(option, path.parent)
    check_name(option, path)


def check_name(option: str, path: Path) -> None:
    """Raise InputError if no file `path` can be written, as for a folder or a link; its parent has been checked
    before.
    """
    try:
        check_target(path)
    except OutputError as error:
        raise InputError(f"{option}: {error}") from error


def require_suffix(path: Path, suffixes: tuple[str, ...]) -> None:
    """Raise InputError if the suffix of `path` is not one of `suffixes`."""
    if path.suffix.lower() not in suffixes:
        ends = f"{', '.join(suffixes[:-1])} or {suffixes[-1]}"
        raise InputError(f"{shortened(path)}: expected a name that ends in {ends}")


def have(what: str, *packages: str) -> bool:
    """Return whether the packages that write `what` are installed; print a note to stderr if one is missing."""
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        print(f"note: no {what}: {' and '.join(missing)} not installed", file=sys.stderr)
    return not missing
