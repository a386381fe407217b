"""Find a mechanism by name or file, and return its kernel source from the cache, or derive it."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from numbers import Integral
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import SMOOTH, STAGES
from gudgeon.errors import BadValueError, InputError, LimitError
from gudgeon.files.reading import MAX_BYTES, MAX_TABLE_BYTES, read_beside, read_named
from gudgeon.language.argument_checks import mapping, number_of, path, text
from gudgeon.loading.cache import Cache, default_cache, digest
from gudgeon.loading.engine import contents
from gudgeon.loading.shipped import PACKAGE, committed, committed_header, shipped, shipped_file
from gudgeon.waiting.asking import report_work
from gudgeon.waiting.imports import GENERATOR, READER, pause_garbage_collector, whole

if TYPE_CHECKING:
    from gudgeon.loading.ahead import BackgroundCompilation

Overrides = Mapping[str, str | float | bool]
DEFAULT_SCENE = "ideal"  # exists in every file
FORMULATIONS = ("reduced", "full")
SOURCE = "source.json"


@dataclass(frozen=True)
class Loading:
    """Report where a simulation's kernels came from, and how long each stage took (s)."""

    origin: str  # "cache", "generated" (committed, shipped) or "derived"
    read: float
    source: float  # from the file's bytes to C text
    compile: float  # from C text to a loaded library
    total: float


def override_values(overrides: Overrides | None) -> dict[str, str | float | bool]:
    """Check the argument `overrides` and return it as a dictionary by address; None gives {}.

    Values are texts, numbers and flags. Raises BadValueError for other types.
    """
    found = mapping(overrides, "overrides", "{address: a value as the file would have it}")
    return {text(name, "an address of overrides"): _check_override(name, value) for name, value in found.items()}


def _check_override(name: str, value: object) -> str | float | bool:
    """Return one checked override."""
    if isinstance(value, (str, bool)):
        return text(value, f"overrides: {name}") if isinstance(value, str) else value
    number = number_of(value, f"overrides: {name}")
    return int(value) if isinstance(value, Integral) else number


def find_mechanism(mechanism: str | os.PathLike[str]) -> Path:
    """Return the path of the YAML file of a mechanism, given by path or by the name of a shipped one.

    A text with "/" or ending in .yaml or .yml is a path, which need not exist. Raises UnknownNameError for an unknown
    name.
    """
    mechanism = path(mechanism, "mechanism")
    if isinstance(mechanism, os.PathLike) or "/" in mechanism or mechanism.endswith((".yaml", ".yml")):
        return Path(mechanism)
    return shipped_file(mechanism)


def read_bytes(file: Path) -> bytes:
    """Return the bytes of a mechanism file. Raise InputError if it cannot be read, LimitError if it is too large.

    If a shipped mechanism has the file's name, the message says so.
    """
    try:
        return read_named(file, MAX_BYTES, hint="name a YAML file")
    except LimitError:
        raise
    except InputError as error:
        if file.stem not in shipped():
            raise
        hint = f"the mechanism that comes with gudgeon is called {file.stem}"
        raise InputError(error.message, hint=hint) from error


def kernel_source(
    data: bytes,
    file: Path,
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    regenerate: bool = False,
    cache: Cache | None = None,
    ahead: BackgroundCompilation | None = None,
) -> tuple[KernelSource, str]:
    """Return the kernel source of a scene, and its origin: the cache, the committed files, or a new derivation.

    formulation: as in `load`, or a method for smooth motion: the reduced one with that method. ahead: compiles parts in
    the background during a derivation.
    """
    if formulation not in (*FORMULATIONS, *SMOOTH, STAGES):
        raise BadValueError(f"unknown formulation {formulation!r}", hint=f"there are: {', '.join(FORMULATIONS)}")
    scene, overrides, cache = scene or DEFAULT_SCENE, overrides or {}, cache or default_cache()
    key = model_key(data, scene, overrides, formulation)
    origin = "cache"

    def make(folder: Path) -> None:  # what tables and laws the file has is found out here
        """Write the kernel source into a folder: the committed one, or a new derivation."""
        nonlocal origin
        source = None
        if not (overrides or regenerate or formulation != FORMULATIONS[0]):
            source = committed(file.stem, scene, sha256(data).hexdigest())
        origin = "generated" if source else "derived"
        if source is None and overrides and not _changes_scene(data, file, scene, overrides):
            source, origin = kernel_source(
                data, file, scene, formulation=formulation, regenerate=regenerate, cache=cache, ahead=ahead
            )
        if source is None:
            source = derived(data, file, scene, overrides, formulation, ahead=ahead)
        source = replace(source, overrides=tuple(sorted(overrides.items())))
        (folder / SOURCE).write_bytes(source.to_json().encode())

    def fetch(key: str, renew: bool) -> KernelSource:
        """Return the kernel source from the cache, made if it is absent."""
        entry = cache.fetch("models", key, make, renew=renew)
        return KernelSource.from_json((entry / SOURCE).read_bytes().decode())

    source = fetch(key, regenerate)
    now = tables_now(source, file), laws_now(source)
    if now != (source.tables, source.laws):  # of other bytes: an entry of its own
        key = digest([key, json.dumps(now)])
        source = fetch(key, False)
        if (tables_now(source, file), laws_now(source)) != (source.tables, source.laws):  # edited meanwhile
            source = fetch(key, True)
    return source, origin


def is_known(mechanism: str, scene: str, overrides: Overrides) -> bool:
    """Return whether the cache has a scene's kernel source, or the file cannot be read; tables are not checked."""
    try:
        data = read_bytes(find_mechanism(mechanism))
    except InputError:
        return True
    return default_cache().has("models", model_key(data, scene, overrides, FORMULATIONS[0]))


def _changes_scene(data: bytes, file: Path, scene: str, overrides: Overrides) -> bool:
    """Return whether overrides change what the scene is derived from."""
    whole(*READER)
    from gudgeon.generator.reader.read import overrides_change_scene

    return overrides_change_scene(data, str(file), scene, overrides)


def tables_now(source: KernelSource, file: Path) -> tuple[tuple[str, str], ...]:
    """Return the names of the tables of a kernel source, each with the SHA-256 of its present file next to `file`.

    Raises InputError if one is missing.
    """
    return tuple((name, sha256(read_beside(file, name, MAX_TABLE_BYTES)).hexdigest()) for name, _ in source.tables)


def laws_now(source: KernelSource) -> tuple[tuple[str, str], ...]:
    """Return the names of the user-defined laws of a kernel source, each with its present key; "" if not registered."""
    if not source.laws:
        return ()
    from gudgeon.generator.kinds.laws.registered import key_of

    return tuple((name, key_of(name)) for name, _ in source.laws)


def derived(
    data: bytes,
    file: Path,
    scene: str,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    seconds: dict[str, float] | None = None,
    ahead: BackgroundCompilation | None = None,
) -> KernelSource:
    """Derive the kernel source of a scene from the bytes of its file; each stage adds its time (s) to `seconds`.

    `ahead` compiles finished parts in the background meanwhile. Errors in the file are reported before SymPy is
    imported.
    """
    with (
        report_work(f"deriving {file.stem}, scene {scene}"),
        pause_garbage_collector(),
    ):  # nearly all that SymPy makes stays in its caches
        whole(*READER)
        from gudgeon.generator.reader.read import read_scene

        read = read_scene(data, str(file), scene, overrides, seconds)
        if ahead and formulation == FORMULATIONS[0]:  # a copy of a shipped file mostly has its numbers alone changed
            ahead.foresee(committed_header(read.mechanism.name, scene))
        start = perf_counter()
        whole(*GENERATOR)
        from gudgeon.generator.pipeline import equations, in_c

        if seconds is not None and (took := perf_counter() - start) > 0.01:
            seconds["loading SymPy"] = took
        return in_c(equations(read, seconds), formulation, seconds, ahead.begin if ahead else None)


def model_key(data: bytes, scene: str, overrides: Overrides, formulation: str) -> str:
    """Return the cache key of a kernel source: a digest of the file's bytes, the request and the generator."""
    requested = json.dumps([scene, sorted(overrides.items()), formulation])
    return digest(["model/1", data, requested, generator_hash()])


def generator_hash(package: Path = PACKAGE) -> str:
    """Return the hash of the files that decide the emitted C: contract, generator, language, templates."""
    parts: list[str | bytes] = []
    for folder in ("contract", "generator", "language", "templates"):
        for name, data in contents(package / folder, ".py", ".jinja"):
            parts += [f"{folder}/{name}", data]
    return digest(parts)
