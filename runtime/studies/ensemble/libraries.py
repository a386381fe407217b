"""Compile the libraries of a study's scenes by two processes, and load and cache them in worker processes."""

from __future__ import annotations

import itertools
import json
import os
import signal
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gudgeon.errors import GudgeonError, InputError
from gudgeon.files.reading import MAX_BYTES, read_table_file
from gudgeon.integrators.threads import count_available_threads
from gudgeon.loading.kernel_sources import find_mechanism, is_source_cached
from gudgeon.simulation.from_file import load
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.workers import initialize_worker, list_registered_law_files
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.generator.study.spec import StudyFile
    from gudgeon.generator.yaml import Text

MIN_LIBRARIES_FOR_PROCESS = 3  # with fewer missing libraries, no second process is started: it must import SymPy first
MAX_LIBRARIES_FOR_PROCESS = 64  # libraries of the second process, limited by the length of its command line
COMPILE_CODE = f"from {__name__} import compile_listed_libraries as run; run()"


class Structure(NamedTuple):
    """Identity of a library: mechanism, scene, and overrides."""

    mechanism: str
    scene: str
    overrides: tuple[tuple[str, str], ...]


def find_study_mechanism(study: StudyFile) -> str:
    """Return the mechanism of a study: the name of a shipped one, or the absolute path of a file.

    The file must lie in the folder of the study file or below; a study without a file, from a mapping, may name any
    path. Raises an InputError at the location of `mechanism` in the study file.
    """
    name = str(study.mechanism)
    is_file = "/" in name or name.endswith((".yaml", ".yml"))
    try:
        if not is_file:
            find_mechanism(name)
            return name
        if not study.file:
            return str(Path(name).absolute())
        read_table_file(study.file, name, MAX_BYTES)
        return str((Path(study.file).parent / name).absolute())
    except InputError as error:
        message = error.message.replace("the table ", "").replace("path to a table", "path to a mechanism")
        hint = "expected a YAML file in the study's folder or below, or the name of a shipped mechanism"
        raise type(error)(message, study.mechanism.where, error.hint if not is_file else hint) from None


def iterate_variants(study: StudyFile) -> Iterator[tuple[Text, dict[str, Text], tuple[tuple[str, str], ...]]]:
    """Yield every variant of a study: each scene with each combination of options of its choices.

    The items are the scene, its overrides {address: text with location}, and the overrides as sorted pairs of strings.
    """
    choices = [list(choice.options.values()) for choice in study.choices]
    for scene, selected in itertools.product(study.scenes, itertools.product(*choices)):
        texts = {address: text for overrides in selected for address, text in overrides.items()}
        yield scene, texts, tuple(sorted((address, str(text)) for address, text in texts.items()))


def list_reference_scene_names(study: StudyFile) -> list[Text]:
    """Return the scenes whose series the measures of a study subtract (key `from`), without repetitions."""
    return list(
        dict.fromkeys(measure.reference_scene for measure in study.measures if measure.reference_scene is not None)
    )


def list_libraries(studies: Iterable[StudyFile]) -> list[Structure]:
    """Return the libraries that `resolve_study` loads for these studies, in that order, without repetitions.

    A study with an unknown mechanism has none; its error is reported by `resolve_study`.
    """
    libraries: dict[Structure, None] = {}
    for study in studies:
        try:
            mechanism = find_study_mechanism(study)
        except InputError:  # reported by resolve_study
            continue
        for scene, _, overrides in iterate_variants(study):
            for name in (*list_reference_scene_names(study), scene):
                libraries[Structure(mechanism, str(name), overrides)] = None
    return list(libraries)


@contextmanager
def compile_libraries_in_second_process(structures: Sequence[Structure]) -> Iterator[None]:
    """Compile libraries in a second process from the last one on, while the code in the context loads from the first
    on.

    The processes share the cache of libraries; one waits for a library that the other compiles. No process is started
    for fewer than MIN_LIBRARIES_FOR_PROCESS missing libraries, or with one core. The process is terminated at the end
    of the context.
    """
    missing = [
        structure
        for structure in structures
        if not is_source_cached(structure.mechanism, structure.scene, dict(structure.overrides))
    ]
    with Programs() as programs:
        process = None
        if len(missing) >= MIN_LIBRARIES_FOR_PROCESS and count_available_threads() > 1:
            arguments = json.dumps([list_registered_law_files(), missing[: -MAX_LIBRARIES_FOR_PROCESS - 1 : -1]])
            try:
                process = programs.start([sys.executable, "-c", COMPILE_CODE, arguments], None, dict(os.environ))
            except OSError:
                process = None
        try:
            yield
        finally:
            if process is not None:
                process.terminate()
                programs.wait(process)


def compile_listed_libraries() -> None:
    """Compile the libraries in sys.argv[1] (JSON): main function of the second process of a study.

    Errors are ignored, since the first process reports them. SIGTERM ends the process and its compiler.
    """
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())  # sys.exit ends compilers and removes temporary folders
    laws, structures = json.loads(sys.argv[1])
    initialize_worker(laws)
    try:
        for mechanism, scene, overrides in structures:
            with suppress(GudgeonError):
                load(mechanism, scene, overrides=dict(overrides), quick=False)
    except SystemExit:
        os._exit(1)  # a regular exit takes 0.3 s to free the objects of SymPy


@lru_cache(maxsize=16)
def load_library(mechanism: str, scene: str, overrides: tuple[tuple[str, str], ...], sha256: str) -> Simulation:
    """Load the library of a scene in a worker process and return its simulation; the last 16 are cached.

    sha256: digest of all inputs when the study began. Raises InputError if the mechanism's file was edited since then.
    """
    simulation = load(mechanism, scene, overrides=dict(overrides), quick=False)
    if simulation.source.whole_sha256 != sha256:
        message = f"{mechanism} was edited after the study began"
        raise InputError(message, hint="restore the file, or start the study again with --restart")
    return simulation


def get_method_for_scene(source: KernelSource, method: str) -> str:
    """Return the method for a scene: "auto" for a kinematically driven one (dof = 0), else the method of the study."""
    return method if source.degrees_of_freedom else "auto"
