"""Run a study file (parameter study) and return its results: `gudgeon.study` and `gudgeon.load_study`."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.errors import InputError, InputErrors, combine_errors, shorten_path
from gudgeon.files.reading import MAX_BYTES, read_user_file
from gudgeon.language.argument_checks import check_callable, check_flag, check_integer, check_mapping, check_path
from gudgeon.loading.shipped import find_shipped_study
from gudgeon.studies.ensemble.claim_tables import write_claims
from gudgeon.studies.ensemble.estimate import check_disk_and_memory
from gudgeon.studies.ensemble.finished import Study, StudyOfParts
from gudgeon.studies.ensemble.folder import (
    DATASET,
    MANIFEST,
    StudyFolder,
    check_dataset,
    create_parts_folder,
    import_h5py,
    list_part_names,
    read_manifest,
)
from gudgeon.studies.ensemble.loop import finish_study
from gudgeon.studies.ensemble.names import write_display_names
from gudgeon.studies.ensemble.workers import convert_to_executor

if TYPE_CHECKING:
    import distributed

    from gudgeon.generator.study.spec import StudySet
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import Plan, Plans

MAX_THREADS = 4096


def resolve_plans(
    study: str | os.PathLike[str] | Mapping[str, Any],
    settings: Mapping[str, float | str] | None = None,
    starts: int | None = None,
    seed: int | None = None,
) -> Plans:
    """Read a study file, compile and load its scenes, and return its plans; nothing is run.

    study: a file, the name of a shipped study, or a mapping with the keys of a file. settings: values by address that
    override those of the study. starts, seed: as in `study`. Raises InputError at the location of a mistake,
    GudgeonError without xarray and h5py.
    """
    from gudgeon.generator.study.parts import MAX_COUNT, MAX_SEED
    from gudgeon.generator.study.read import read_studies

    import_h5py()
    overrides = {name: str(value) for name, value in check_mapping(settings, "settings").items()}
    starts = None if starts is None else check_integer(starts, "starts", 1, MAX_COUNT)
    seed = None if seed is None else check_integer(seed, "seed", 0, MAX_SEED)
    if isinstance(study, Mapping):
        return _resolve_parts(read_studies(study, "", overrides).replace_perturbed_starts(starts, seed))
    file = os.fspath(check_path(study, "study"))
    if not (os.path.splitext(file)[1] or os.path.dirname(file) or os.path.lexists(file)):
        file = str(find_shipped_study(file))
    data = read_user_file(file, MAX_BYTES, hint="name a YAML file that begins with format: gudgeon-study/1")
    return _resolve_parts(read_studies(data, file, overrides).replace_perturbed_starts(starts, seed))


def _resolve_parts(studies: StudySet) -> Plans:
    """Resolve all parts of a study file and its claims to plans; libraries are compiled by two processes.

    Raises one error that combines the errors of all parts, without repetitions.
    """
    from gudgeon.studies.ensemble.claims import resolve_claims
    from gudgeon.studies.ensemble.libraries import compile_libraries_in_second_process, list_libraries
    from gudgeon.studies.ensemble.plan import Plans
    from gudgeon.studies.ensemble.resolve import resolve_study

    plans: dict[str, Plan] = {}
    errors: list[InputError] = []
    with compile_libraries_in_second_process(list_libraries(studies.parts.values())):
        for name, part in studies.parts.items():
            try:
                plans[name] = resolve_study(part)
            except InputErrors as error:
                errors += error.errors
            except InputError as error:
                errors.append(error)
    unique_errors = list({str(error): error for error in errors}.values())
    if unique_errors:
        raise combine_errors(unique_errors)
    resolved_plans = Plans(studies, plans)
    return replace(resolved_plans, claims=resolve_claims(resolved_plans))


def study(
    study: str | os.PathLike[str] | Mapping[str, Any],
    folder: str | os.PathLike[str] | None = None,
    *,
    threads: int | None = None,
    executor: Executor | distributed.Client | None = None,
    progress: Progress | None = None,
    restart: bool = False,
    settings: Mapping[str, float | str] | None = None,
    starts: int | None = None,
    seed: int | None = None,
) -> Study:
    """Run all runs of a study and compute its measures.

    study: a YAML file (docs/studies.md), the name of a shipped study, or a mapping with the same contents. folder:
    finished blocks of runs are stored there at once; the same call resumes an interrupted study to the same dataset.
    None: a temporary folder, deleted with the Study. threads: in each process, None for the number of cores (1 with an
    executor). executor: any of concurrent.futures, or a Client of dask.distributed; its workers receive blocks and load
    their own libraries. restart: remove earlier results first. settings: {address: number or text} for all runs, which
    override the values, ranges and draws of the study. starts, seed: number and seed of perturbed starts instead of
    those of the study. A failed run has a reason and NaN, and does not stop others.

    Raises InputError with its location for a mistake in the study or a folder of another study; OutputError for a full
    disk. Ctrl-C raises KeyboardInterrupt, and finished blocks stay in the folder.
    """
    threads = None if threads is None else check_integer(threads, "threads", 1, MAX_THREADS)
    pool, progress = convert_to_executor(executor), check_callable(progress, "progress")
    restart, plans = check_flag(restart, "restart"), resolve_plans(study, settings, starts, seed)
    if folder is None:
        temporary = tempfile.TemporaryDirectory(prefix="gudgeon-study-")
        return run_plans(plans, Path(temporary.name), threads, pool, progress, restart, temporary)
    return run_plans(plans, Path(check_path(folder, "folder")), threads, pool, progress, restart)


def run_plans(
    plans: Plans,
    folder: Path,
    threads: int | None = None,
    executor: Executor | None = None,
    progress: Progress | None = None,
    restart: bool = False,
    temporary_folder: tempfile.TemporaryDirectory[str] | None = None,
) -> Study:
    """Run or resume the plans of a study file in a folder, judge its claims, and return the finished study.

    Each part of a file with parts has a subfolder. It also writes the display texts (names.json). Other arguments are
    those of `study`, but `executor` must be one of concurrent.futures. temporary_folder: deleted with the study. Raises
    OutputError or MemoryError before the first run if disk or memory do not suffice.
    """
    check_disk_and_memory(plans, folder, threads, executor is None)
    if plans.named:
        create_parts_folder(folder, list(plans.by_part), restart)
    n_done = 0
    for name, plan in plans.by_part.items():

        def report_part_progress(
            fraction: float, text: str, name: str = name, runs: int = plan.runs, before: int = n_done
        ) -> None:
            """Report the progress of a part as a fraction of the runs of all parts, with the name of the part."""
            if progress:
                progress((before + fraction * runs) / plans.runs, f"{name}: {text}" if name else text)

        with StudyFolder(folder / name, plan).open_locked(restart) as study_folder:
            finish_study(study_folder, threads, executor, report_part_progress if progress else None)
        n_done += plan.runs
    study = (
        StudyOfParts(folder, list(plans.by_part), temporary_folder) if plans.named else Study(folder, temporary_folder)
    )
    write_display_names(folder, plans)
    if plans.claims is not None:
        write_claims(folder, plans, plans.claims, study)
    return study


def load_study(folder: str | os.PathLike[str]) -> Study:
    """Open the finished study in a folder; its data are read on request.

    For a file that lists several studies (parts), a StudyOfParts is returned: one study per part, by name. All parts
    are checked, and not merged. Raises InputError for a folder without a study, or if any part is unfinished or
    damaged.
    """
    folder_path = Path(check_path(folder, "folder"))
    if (manifest := read_manifest(folder_path)) is None:
        raise InputError(f"{shorten_path(folder_path)} is not a study folder: it has no {MANIFEST}")
    if parts := list_part_names(manifest):
        for name in parts:
            load_study(folder_path / name)
        return StudyOfParts(folder_path, parts)
    if not (folder_path / DATASET).is_file():
        message = f"the study in {shorten_path(folder_path)} is not finished"
        raise InputError(message, hint="resume it by: gudgeon study FILE --out FOLDER")
    check_dataset(folder_path, manifest.get("plan"))
    return Study(folder_path)
