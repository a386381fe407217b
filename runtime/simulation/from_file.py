"""Load a mechanism by name or file, and return its Simulation."""

from __future__ import annotations

import os
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from gudgeon.language.argument_checks import check_flag, check_text
from gudgeon.loading.background_compilation import BackgroundCompilation
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.cache import get_default_cache
from gudgeon.loading.kernel_sources import (
    Loading,
    Overrides,
    check_overrides,
    find_kernel_source,
    find_mechanism,
    read_bytes,
)
from gudgeon.loading.optimized_library import may_compile_in_background
from gudgeon.waiting.ctrl_c import EndingSignals
from gudgeon.waiting.imports import RUNTIME, import_modules_in_thread

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation


def load(
    mechanism: str | os.PathLike[str],
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    portable: bool = False,
    regenerate: bool = False,
    quick: bool = True,
) -> Simulation:
    """Load a mechanism's scene and return it compiled and ready to simulate.

    mechanism: text with "/" or ending in ".yaml" is a path, other text the name of a shipped mechanism.
    scene: a scene of the file; None is "ideal", which has no play and exists in every file.
    overrides: values by address that replace those of the file and may change the structure of the mechanism.
    formulation: coordinates that are integrated, "reduced" (relative coordinates of a tree) or "full" (absolute
    coordinates, with the Jacobian of their state equation); the results are the same.
    portable: compile for any CPU of this kind. regenerate: derive and compile even if the cache contains the library.
    quick: start with an unoptimized library, which compiles in a third of the time, if the cache contains no library.
    Runs take up to three times as long until a second process has compiled the optimized library; the results are the
    same. False, or GUDGEON_QUICK=0: wait for the optimized library.
    Raises InputError if the file is wrong, BuildError if its C cannot be compiled.
    """
    start = perf_counter()
    file, overrides = find_mechanism(mechanism), check_overrides(overrides)
    scene = None if scene is None else check_text(scene, "scene", "the name of a scene")
    formulation = check_text(formulation, "formulation")
    portable, regenerate = check_flag(portable, "portable"), check_flag(regenerate, "regenerate")
    quick = check_flag(quick, "quick") and not regenerate
    return load_bytes(
        read_bytes(file),
        file,
        scene,
        overrides=overrides,
        formulation=formulation,
        portable=portable,
        regenerate=regenerate,
        quick=quick,
        start=start,
    )


def load_bytes(
    data: bytes,
    file: Path,
    scene: str | None = None,
    *,
    overrides: Overrides | None = None,
    formulation: str = "reduced",
    portable: bool = False,
    regenerate: bool = False,
    quick: bool = False,
    start: float | None = None,
) -> Simulation:
    """Load a scene from the bytes of a mechanism file and return its Simulation; arguments as in `load`.

    `file` is for messages and tables next to it. `start`: time of perf_counter when reading began, or None. SIGTERM and
    SIGHUP stop running compilers before they end the process.
    """
    read = perf_counter()
    start = read if start is None else start
    with (
        EndingSignals(),
        BackgroundCompilation(portable, unoptimized=quick and may_compile_in_background(get_default_cache())) as ahead,
    ):
        source, origin = find_kernel_source(
            data, file, scene, overrides=overrides, formulation=formulation, regenerate=regenerate, background=ahead
        )
        have_source = perf_counter()
        if ahead.is_busy:
            import_modules_in_thread(*RUNTIME)  # while compilers are at work
        library = compile_kernels(source, portable=portable, rebuild=regenerate, background=ahead, quick=quick)
    have_library = perf_counter()

    import_modules_in_thread(*RUNTIME)
    from gudgeon.model.compiled import CompiledModel
    from gudgeon.model.reference import check_reference_values
    from gudgeon.simulation.simulation import Simulation

    loading = Loading(origin, read - start, have_source - read, have_library - have_source, have_library - start)
    compiled = CompiledModel(source, library, portable, data.decode())
    check_reference_values(compiled)
    return Simulation(compiled, file=file, overrides=dict(overrides or {}), loading=loading, quick=quick)
