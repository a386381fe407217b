"""`gudgeon.study` and `gudgeon.load_study`: a study as one Dataset."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.errors import InputError, InputErrors, shortened, together
from gudgeon.files.reading import MAX_BYTES, read_named
from gudgeon.language.wanted import flag, function, mapping, path, whole
from gudgeon.loading.shipped import shipped_study
from gudgeon.studies.ensemble.claimed import write_claims
from gudgeon.studies.ensemble.estimate import check_needs
from gudgeon.studies.ensemble.finished import Study, StudyOfParts
from gudgeon.studies.ensemble.folder import (
    DATASET,
    MANIFEST,
    StudyFolder,
    check_dataset,
    h5py_module,
    manifest,
    open_parts,
    parts_of,
)
from gudgeon.studies.ensemble.loop import finish
from gudgeon.studies.ensemble.names import write_names
from gudgeon.studies.ensemble.workers import executor_of

if TYPE_CHECKING:
    import distributed

    from gudgeon.generator.study.spec import StudySet
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import Plan, Plans

MOST_THREADS = 4096


def plans_of(
    study: str | os.PathLike[str] | Mapping[str, Any],
    settings: Mapping[str, float | str] | None = None,
    starts: int | None = None,
    seed: int | None = None,
) -> Plans:
    """The plans of a study, as `study` takes it, mechanisms loaded. Raises InputError."""
    from gudgeon.generator.study.parts import MOST_COUNT, MOST_SEED
    from gudgeon.generator.study.read import read_studies

    h5py_module()
    given = {name: str(value) for name, value in mapping(settings, "settings").items()}
    starts = None if starts is None else whole(starts, "starts", 1, MOST_COUNT)
    seed = None if seed is None else whole(seed, "seed", 0, MOST_SEED)
    if isinstance(study, Mapping):
        return _resolved(read_studies(study, "", given).begun(starts, seed))
    file = os.fspath(path(study, "study"))
    if not (os.path.splitext(file)[1] or os.path.dirname(file) or os.path.lexists(file)):
        file = str(shipped_study(file))
    data = read_named(file, MAX_BYTES, hint="name a YAML file that begins with format: gudgeon-study/1")
    return _resolved(read_studies(data, file, given).begun(starts, seed))


def _resolved(studies: StudySet) -> Plans:
    """Mistakes of all parts at once, each once where parts share what the file says."""
    from gudgeon.studies.ensemble.claims import known_claims
    from gudgeon.studies.ensemble.libraries import made_beside, structures_of
    from gudgeon.studies.ensemble.plan import Plans
    from gudgeon.studies.ensemble.resolve import resolve

    plans: dict[str, Plan] = {}
    errors: list[InputError] = []
    with made_beside(structures_of(studies.parts.values())):
        for name, part in studies.parts.items():
            try:
                plans[name] = resolve(part)
            except InputErrors as error:
                errors += error.errors
            except InputError as error:
                errors.append(error)
    different = list({str(error): error for error in errors}.values())
    if different:
        raise together(different)
    found = Plans(studies, plans)
    return replace(found, claims=known_claims(found))


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
    """Make all runs of a study, and what it measures of them.

    study: a YAML file (docs/studies.md), the name of one that comes with gudgeon, or a mapping that says the same.
    folder: where finished blocks of runs go at once; the same call goes on from what is there, whatever ended it, to
    the same dataset. None: a temporary folder, which goes with the Study. threads: in each process, None for the cores
    there are (1 with an executor). executor: any of concurrent.futures, or a Client of dask.distributed; its workers
    are given blocks and load their own libraries. restart: begin anew. settings: {address: number or text} for all
    runs, over the study's own, rows and draws too. starts, seed: another number of perturbed starts, or another seed
    of them, than the study says. A run that fails is a row with its reason and NaN, and stops no other.

    Raises InputError, with its place, for a mistake in the study or a folder of another study; OutputError for a
    disk that takes no more. Ctrl-C is passed on: what is in the folder stays.
    """
    threads = None if threads is None else whole(threads, "threads", 1, MOST_THREADS)
    pool, progress = executor_of(executor), function(progress, "progress")
    restart, plans = flag(restart, "restart"), plans_of(study, settings, starts, seed)
    if folder is None:
        kept = tempfile.TemporaryDirectory(prefix="gudgeon-study-")
        return run_plans(plans, Path(kept.name), threads, pool, progress, restart, kept)
    return run_plans(plans, Path(path(folder, "folder")), threads, pool, progress, restart)


def run_plans(
    plans: Plans,
    folder: Path,
    threads: int | None = None,
    executor: Executor | None = None,
    progress: Progress | None = None,
    restart: bool = False,
    keeps: tempfile.TemporaryDirectory[str] | None = None,
) -> Study:
    """The study of a file in a folder, each part in one of its own."""
    check_needs(plans, folder, threads, executor is None)
    if plans.named:
        open_parts(folder, list(plans.each), restart)
    done = 0
    for name, plan in plans.each.items():

        def report(fraction: float, text: str, name: str = name, runs: int = plan.runs, before: int = done) -> None:
            if progress:
                progress((before + fraction * runs) / plans.runs, f"{name}: {text}" if name else text)

        with StudyFolder(folder / name, plan).opened(restart) as opened:
            finish(opened, threads, executor, report if progress else None)
        done += plan.runs
    study = StudyOfParts(folder, list(plans.each), keeps) if plans.named else Study(folder, keeps)
    write_names(folder, plans)
    if plans.claims is not None:
        write_claims(folder, plans, plans.claims, study)
    return study


def load_study(folder: str | os.PathLike[str]) -> Study:
    """The finished study of a folder. Raises InputError for a folder that holds none, or one that is not finished."""
    place = Path(path(folder, "folder"))
    if (found := manifest(place)) is None:
        raise InputError(f"{shortened(place)} is no folder of a study: it has no {MANIFEST}")
    if parts := parts_of(found):
        for name in parts:
            load_study(place / name)
        return StudyOfParts(place, parts)
    if not (place / DATASET).is_file():
        told = f"the study in {shortened(place)} is not finished"
        raise InputError(told, hint="gudgeon study FILE --out FOLDER goes on with it")
    check_dataset(place, found.get("plan"))
    return Study(place)
