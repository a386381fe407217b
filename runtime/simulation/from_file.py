"""From a mechanism's name or file to a simulation."""

from __future__ import annotations

import os
from pathlib import Path
from time import perf_counter

from gudgeon.language.wanted import flag, text
from gudgeon.loading.ahead import Ahead
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.find import Loading, Overrides, find_mechanism, kernel_source, override_values, read_bytes
from gudgeon.simulation.simulation import Simulation
from gudgeon.waiting.imports import RUNTIME, whole


def load(
    mechanism: str | os.PathLike[str],
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    portable: bool = False,
    regenerate: bool = False,
) -> Simulation:
    """A mechanism's scene, compiled and ready to simulate.

    mechanism: text with "/" or ending in ".yaml" is a path, other text the name of a shipped mechanism.
    scene: a scene of the file; None is "ideal", which has no play and exists in every file.
    overrides: values by address that may change the structure. portable: compile for any CPU of this
    kind. formulation: what is integrated, "reduced" (coordinates of a tree) or "full" (absolute ones, with the
    Jacobian of their state equation); results are the same. regenerate: derive and compile even if the
    cache has both.
    Raises InputError if the file is wrong, BuildError if its C cannot be compiled.
    """
    start = perf_counter()
    file, overrides = find_mechanism(mechanism), override_values(overrides)
    scene = None if scene is None else text(scene, "scene", "the name of a scene")
    formulation = text(formulation, "formulation")
    portable, regenerate = flag(portable, "portable"), flag(regenerate, "regenerate")
    return load_bytes(
        read_bytes(file), file, scene, overrides=overrides, formulation=formulation, portable=portable,
        regenerate=regenerate, start=start,
    )  # fmt: skip


def load_bytes(
    data: bytes,
    file: Path,
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    portable: bool = False,
    regenerate: bool = False,
    start: float | None = None,
) -> Simulation:
    """`load` of the bytes of a file; `start`: when reading them began (perf_counter)."""
    read = perf_counter()
    start = read if start is None else start
    with Ahead(portable) as ahead:
        source, origin = kernel_source(
            data, file, scene, overrides=overrides, formulation=formulation, regenerate=regenerate, ahead=ahead
        )
        have_source = perf_counter()
        library = compile_kernels(source, portable=portable, rebuild=regenerate, ahead=ahead)
    have_library = perf_counter()

    whole(*RUNTIME)
    from gudgeon.model.compiled import CompiledModel

    loading = Loading(origin, read - start, have_source - read, have_library - have_source, have_library - start)
    compiled = CompiledModel(source, library, portable)
    return Simulation(compiled, file=file, overrides=dict(overrides or {}), loading=loading)
