"""Find a mechanism by name or file, and return the C of a scene from the cache, or generate it."""

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
from gudgeon.files.reading import MAX_BYTES, MAX_TABLE_BYTES, read_table_file, read_user_file
from gudgeon.language.argument_checks import check_mapping, check_number, check_path, check_text
from gudgeon.loading.cache import Cache, compute_digest, get_default_cache
from gudgeon.loading.engine import read_files
from gudgeon.loading.forecast import announce_long_derivation
from gudgeon.loading.shipped import (
    PACKAGE,
    find_shipped_file,
    list_shipped_mechanisms,
    read_committed_header,
    read_committed_source,
)
from gudgeon.waiting.cancellation import report_work
from gudgeon.waiting.imports import GENERATOR, READER, import_modules_in_thread, pause_garbage_collector

if TYPE_CHECKING:
    from gudgeon.loading.background_compilation import BackgroundCompilation

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


def check_overrides(overrides: Overrides | None) -> dict[str, str | float | bool]:
    """Check the argument `overrides` and return it as a dictionary by address; None gives {}.

    Values are texts, numbers and flags. Raises BadValueError for other types.
    """
    values_by_address = check_mapping(overrides, "overrides", "{address: a value as the file would have it}")
    return {
        check_text(name, "an address of overrides"): _check_override(name, value)
        for name, value in values_by_address.items()
    }


def _check_override(name: str, value: object) -> str | float | bool:
    """Check the value of the override `name`, a text, number or flag, and return it."""
    if isinstance(value, (str, bool)):
        return check_text(value, f"overrides: {name}") if isinstance(value, str) else value
    number = check_number(value, f"overrides: {name}")
    return int(value) if isinstance(value, Integral) else number


def find_mechanism(mechanism: str | os.PathLike[str]) -> Path:
    """Return the path of the YAML file of a mechanism, given by path or by the name of a shipped one.

    A text with "/" or ending in .yaml or .yml is a path, which need not exist. Raises UnknownNameError for an unknown
    name.
    """
    mechanism = check_path(mechanism, "mechanism")
    if isinstance(mechanism, os.PathLike) or "/" in mechanism or mechanism.endswith((".yaml", ".yml")):
        return Path(mechanism)
    return find_shipped_file(mechanism)


def read_bytes(file: Path) -> bytes:
    """Return the bytes of a mechanism file. Raise InputError if it cannot be read, LimitError if it is too large.

    If a shipped mechanism has the file's name, the message says so.
    """
    try:
        return read_user_file(file, MAX_BYTES, hint="name a YAML file")
    except LimitError:
        raise
    except InputError as error:
        if file.stem not in list_shipped_mechanisms():
            raise
        hint = f"the mechanism that comes with gudgeon is called {file.stem}"
        raise InputError(error.message, hint=hint) from error


def find_kernel_source(
    data: bytes,
    file: Path,
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    regenerate: bool = False,
    cache: Cache | None = None,
    background: BackgroundCompilation | None = None,
) -> tuple[KernelSource, str]:
    """Return the kernel source of a scene, and its origin: the cache, the committed files, or a new derivation.

    formulation: as in `load`, or STAGES or a method for smooth motion: the reduced formulation with the code of these
    methods. background: compiles parts in the background during a derivation. The source is stored in the cache.
    """
    if formulation not in (*FORMULATIONS, *SMOOTH, STAGES):
        raise BadValueError(f"unknown formulation {formulation!r}", hint=f"there are: {', '.join(FORMULATIONS)}")
    scene, overrides, cache = scene or DEFAULT_SCENE, overrides or {}, cache or get_default_cache()
    key = compute_model_key(data, scene, overrides, formulation)
    origin = "cache"

    def write_source(folder: Path) -> None:  # the derivation finds the tables and laws of the file
        """Write the kernel source (JSON) into a folder; set `origin` to "generated" (committed files) or "derived".

        The committed source is used without overrides, `regenerate` and another formulation, if the file is unchanged.
        Overrides that do not change the structure reuse the source without them and its origin. Any other source is
        derived.
        """
        nonlocal origin
        source = None
        if not (overrides or regenerate or formulation != FORMULATIONS[0]):
            source = read_committed_source(file.stem, scene, sha256(data).hexdigest())
        origin = "generated" if source else "derived"
        if source is None and overrides and not _has_structural_overrides(data, file, scene, overrides):
            source, origin = find_kernel_source(
                data, file, scene, formulation=formulation, regenerate=regenerate, cache=cache, background=background
            )
        if source is None:
            source = derive_kernel_source(data, file, scene, overrides, formulation, background=background)
        source = replace(source, overrides=tuple(sorted(overrides.items())))
        (folder / SOURCE).write_bytes(source.to_json().encode())

    def fetch_source(key: str, renew: bool) -> KernelSource:
        """Return the kernel source from the cache, made if it is absent."""
        entry = cache.fetch("models", key, write_source, renew=renew)
        return KernelSource.from_json((entry / SOURCE).read_bytes().decode())

    source = fetch_source(key, regenerate)
    current_files = hash_current_tables(source, file), list_current_law_keys(source)
    if current_files != (source.tables, source.laws):  # changed tables or laws get another cache entry
        key = compute_digest([key, json.dumps(current_files)])
        source = fetch_source(key, False)
        if (hash_current_tables(source, file), list_current_law_keys(source)) != (
            source.tables,
            source.laws,
        ):  # edited meanwhile
            source = fetch_source(key, True)
    return source, origin


def is_source_cached(mechanism: str, scene: str, overrides: Overrides) -> bool:
    """Return whether the cache has a scene's kernel source, or the file cannot be read; tables are not checked."""
    try:
        data = read_bytes(find_mechanism(mechanism))
    except InputError:
        return True
    return get_default_cache().has_entry("models", compute_model_key(data, scene, overrides, FORMULATIONS[0]))


def _has_structural_overrides(data: bytes, file: Path, scene: str, overrides: Overrides) -> bool:
    """Return whether overrides change the equations of the scene, not only parameter values."""
    import_modules_in_thread(*READER)
    from gudgeon.generator.reader.read import overrides_change_scene

    return overrides_change_scene(data, str(file), scene, overrides)


def hash_current_tables(source: KernelSource, file: Path) -> tuple[tuple[str, str], ...]:
    """Return the tables of a kernel source as pairs of name and SHA-256 of the current file next to `file`.

    They differ from `source.tables` if a table was edited. Raises InputError if one is missing.
    """
    return tuple((name, sha256(read_table_file(file, name, MAX_TABLE_BYTES)).hexdigest()) for name, _ in source.tables)


def list_current_law_keys(source: KernelSource) -> tuple[tuple[str, str], ...]:
    """Return the user-defined laws of a kernel source as pairs of name and key of the law that is registered now.

    The key is "" for laws that are not registered in this process. Keys differ from `source.laws` if a law was
    replaced.
    """
    if not source.laws:
        return ()
    from gudgeon.generator.kinds.laws.registered import find_law_key

    return tuple((name, find_law_key(name)) for name, _ in source.laws)


def derive_kernel_source(
    data: bytes,
    file: Path,
    scene: str,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    seconds: dict[str, float] | None = None,
    background: BackgroundCompilation | None = None,
) -> KernelSource:
    """Derive the kernel source of a scene from the bytes of its file; each stage adds its time (s) to `seconds`.

    `background` compiles finished parts during the derivation. Errors in the file are reported before SymPy is
    imported. None for `overrides`, `seconds` and `background`: the file's values, no times, no compilation.
    """
    with (
        report_work(f"deriving {file.stem}, scene {scene}"),
        pause_garbage_collector(),
    ):  # nearly all objects of SymPy stay in its caches
        import_modules_in_thread(*READER)
        from gudgeon.generator.reader.read import read_scene

        read = read_scene(data, str(file), scene, overrides, seconds)
        announce_long_derivation(file.stem, len(read.mechanism.bodies))
        if background and formulation == FORMULATIONS[0]:  # copies of shipped files usually have changed values only
            background.prefetch_engine(read_committed_header(read.mechanism.name, scene))
        start = perf_counter()
        import_modules_in_thread(*GENERATOR)
        from gudgeon.generator.pipeline import derive_equations, generate_c

        if seconds is not None and (took := perf_counter() - start) > 0.01:
            seconds["loading SymPy"] = took
        return generate_c(
            derive_equations(read, seconds),
            formulation,
            seconds,
            background.start_unit_compilation if background else None,
        )


def compute_model_key(data: bytes, scene: str, overrides: Overrides, formulation: str) -> str:
    """Return the cache key of a kernel source: a digest of the file's bytes, the request and the generator."""
    requested = json.dumps([scene, sorted(overrides.items()), formulation])
    return compute_digest(["model/1", data, requested, compute_generator_hash()])


def compute_generator_hash(package: Path = PACKAGE) -> str:
    """Return the hash of the files that decide the emitted C: contract, generator, language, templates."""
    parts: list[str | bytes] = []
    for folder in ("contract", "generator", "language", "templates"):
        for name, data in read_files(package / folder, ".py", ".jinja"):
            parts += [f"{folder}/{name}", data]
    return compute_digest(parts)


def read_unchanged_file(source: KernelSource, file: Path) -> bytes:
    """Return the bytes of the file of a loaded mechanism, from which variants of the scene are derived.

    Raises InputError if the file or one of its tables was edited after loading. The error is also raised if a
    registered law was replaced or is not registered in this process.
    """
    data = read_bytes(file)
    is_same_file = sha256(data).hexdigest() == source.sha256
    if not is_same_file or hash_current_tables(source, file) != source.tables:
        raise InputError(
            f"{'a table of ' * is_same_file}{file} was edited after it was loaded:"
            " equations derived from it now would not be those of this simulation",
            hint="load it again with gudgeon.load(…), or restore the file",
        )
    for (name, loaded_key), (_, current_key) in zip(source.laws, list_current_law_keys(source), strict=True):
        if current_key != loaded_key:
            difference = "has changed" if current_key else "is not registered in this process"
            hint = (
                "register the same law with gudgeon.register"
                if not current_key
                else "load the mechanism again with gudgeon.load(…)"
            )
            raise InputError(f"the law {name} of this simulation {difference}", hint=hint)
    return data
