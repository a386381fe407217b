"""Check arguments that several commands have: names of scenes, values of --set, output files and folders."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, Location, OutputError, UnknownNameError, shorten_path
from gudgeon.files.writing import check_output_path
from gudgeon.language.names import make_missing_name_error
from gudgeon.loading.kernel_sources import compute_generator_hash, find_mechanism, read_bytes
from gudgeon.model.parameters import (
    PARAMETER_GROUPS,
    check_parameter_values,
    explain_address,
    list_addresses,
    parse_typed_number,
    read_given_parameters,
)

if TYPE_CHECKING:
    from gudgeon.generator.mechanism import Mechanism
    from gudgeon.generator.targets.numpy.linkage import NumPyLinkage

SCENES = "scenes.json"  # file of a cache entry


def read_scene_names(mechanism: str) -> tuple[str, ...]:
    """Return the names of all scenes of a mechanism file, in its order; they are cached by the file's bytes."""
    from gudgeon.loading.cache import compute_digest, get_default_cache

    file = find_mechanism(mechanism)
    data = read_bytes(file)

    def write_names(folder: Path) -> None:
        """Write the names of the scenes into the new cache entry `folder`."""
        from gudgeon.generator.reader.read import read_mechanism

        names = list(read_mechanism(data, str(file)).scenes)
        (folder / SCENES).write_text(json.dumps(names), encoding="utf-8")

    entry = get_default_cache().fetch(
        "scenes", compute_digest(["scenes/1", data, compute_generator_hash()]), write_names
    )
    return tuple(json.loads((entry / SCENES).read_text(encoding="utf-8")))


def select_scenes(mechanism: str, requested: tuple[str, ...]) -> tuple[str, ...]:
    """Return the requested scenes, each once, or all scenes if none is requested.

    Raises UnknownNameError, with the nearest name, for a scene that the file does not have.
    """
    names = read_scene_names(mechanism)
    for scene in requested:
        if scene not in names:
            raise make_missing_name_error(f"no scene {scene!r} in {mechanism}", scene, names)
    return tuple(dict.fromkeys(requested)) or names


def parse_settings(texts: Iterable[str]) -> dict[str, float | str]:
    """Parse the texts `ADDRESS=VALUE` of `--set` and return the values by address.

    Raises BadValueError for other forms, and for a parameter that is set twice.
    """
    settings: dict[str, float | str] = {}
    written: dict[str, str] = {}  # a parameter may be called with its section or without
    for text in texts:
        address, equals, value_text = (part.strip() for part in text.partition("="))
        if not (equals and address and value_text):
            raise BadValueError(f"--set {text}: expected ADDRESS=VALUE", hint="for example --set c=0.5mm")
        key = address.removeprefix("parameters.")
        if key in written:
            message = f"--set {text}: this parameter is set already, by --set {written[key]}"
            raise BadValueError(message, hint="set it once")
        written[key], settings[address] = text, parse_typed_number(value_text)
    return settings


def check_addresses(addresses: Iterable[str], file: str, sources: Sequence[KernelSource]) -> None:
    """Raise UnknownNameError for the first address of `--set` that no scene has.

    The error says what the file has at the address, else it names the nearest one. `file`: name for the message.
    """
    known_addresses = tuple(dict.fromkeys(address for source in sources for address in list_addresses(source)))
    for name in addresses:
        if name in known_addresses:
            continue
        for source in sources:
            message, hint = explain_address(source, name)
            if message:
                entries = (*source.file_expressions, *source.named_expressions)
                addresses_in_file = (name, f"expressions.{name}")
                location = next(
                    (Location(file, w.line, w.column) for w in entries if w.address in addresses_in_file), None
                )
                raise UnknownNameError(f"--set: {message}", location, hint)
        raise make_missing_name_error(f"--set: no scene has a parameter {name!r}", name, known_addresses)


def select_known_settings(source: KernelSource, settings: Mapping[str, float | str]) -> dict[str, float | str]:
    """Return the values of `--set` whose addresses the scene has; an ideal scene has no viscosity, for example."""
    known_addresses = set(list_addresses(source))
    return {address: number for address, number in settings.items() if address in known_addresses}


def apply_settings(mechanism: Mechanism, linkage: NumPyLinkage, settings: Mapping[str, float | str]) -> NumPyLinkage:
    """Return the linkage without play rebuilt with the `settings` of --set; the same object if they do not change it.

    Addresses of other scenes and Baumgarte gains are ignored. Raises BadValueError for values out of range.
    """
    from gudgeon.generator.pipeline import build_closed_linkage

    source, count = linkage.source, len(linkage.source.parameters) + len(linkage.source.derived)
    known_settings, p = select_known_settings(source, settings), linkage.p[:count].copy()
    values, is_given = read_given_parameters(source, known_settings)
    p[: len(values)][is_given] = values[is_given]
    check_parameter_values(source, p, is_given)  # before derived values are computed
    gains = {*PARAMETER_GROUPS, *(name for names in PARAMETER_GROUPS.values() for name in names)}
    linkage_settings = {
        name: x for name, x in known_settings.items() if name not in gains
    }  # gains do not change the start
    if not linkage_settings:
        return linkage
    try:
        closed_linkage, _ = build_closed_linkage(mechanism, source.scene, linkage_settings)
    except ArithmeticError as error:
        message = f"--set: values derived from these parameters cannot be computed ({error})"
        raise BadValueError(message, hint="look for a value that is 0 or far too large") from error
    check_parameter_values(source, closed_linkage.p[:count], is_given)
    return closed_linkage


def check_output_folder(option: str, out: Path) -> None:
    """Raise InputError if the folder `out` cannot be created or written; called before a run.

    A temporary file is written to the nearest existing folder. option: the command-line option for the message.
    """
    import tempfile

    try:
        existing_folder = next(path for path in (out.absolute(), *out.absolute().parents) if path.exists())
        for name in out.absolute().relative_to(existing_folder).parts:
            with suppress(FileNotFoundError, NotADirectoryError):
                (existing_folder / name).lstat()  # OSError if a name is too long
    except OSError as error:  # a name too long, a folder that may not be entered
        message = f"{option} {shorten_path(out)}: {error.strerror or error}"
        raise InputError(message, hint="name another folder") from error
    if not existing_folder.is_dir():
        raise InputError(
            f"{option} {shorten_path(out)}: {shorten_path(existing_folder)} is a file", hint="name a folder"
        )
    try:
        # permissions are not sufficient: the file system may be read-only
        with tempfile.TemporaryFile(dir=existing_folder):
            pass
    except OSError as error:
        folder, reason = shorten_path(existing_folder), error.strerror or error
        message = f"{option} {shorten_path(out)}: nothing can be written to {folder} ({reason})"
        raise InputError(message, hint="name another folder") from error


def check_output_file(option: str, path: Path) -> None:
    """Raise InputError if the file `path` cannot be written or replaced; called before a run.

    option: the command-line option for the message.
    """
    check_output_folder(option, path.parent)
    check_output_name(option, path)


def check_output_name(option: str, path: Path) -> None:
    """Raise InputError if `path` is a folder or a link, or cannot be a file; its parent folder is not checked."""
    try:
        check_output_path(path)
    except OutputError as error:
        raise InputError(f"{option}: {error}") from error


def require_suffix(path: Path, suffixes: tuple[str, ...]) -> None:
    """Raise InputError if the suffix of `path` is not one of `suffixes`."""
    if path.suffix.lower() not in suffixes:
        ends = f"{', '.join(suffixes[:-1])} or {suffixes[-1]}"
        raise InputError(f"{shorten_path(path)}: expected a name that ends in {ends}")


def has_packages(output_kind: str, *packages: str) -> bool:
    """Return whether the packages that write this kind of output are installed; if not, print a note to stderr."""
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        print(f"note: no {output_kind}: {' and '.join(missing)} not installed", file=sys.stderr)
    return not missing
