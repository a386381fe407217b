"""`gudgeon.study` and `gudgeon.load_study`: a study as one Dataset."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.contract.limits import MAX_BYTES
from gudgeon.errors import InputError, in_a_line, shortened
from gudgeon.files.reading import read_named
from gudgeon.files.writing import written
from gudgeon.language.wanted import flag, function, mapping, names, path, whole
from gudgeon.studies.ensemble.folder import DATASET, MANIFEST, StudyFolder, h5py_module, manifest
from gudgeon.studies.ensemble.loop import finish
from gudgeon.studies.ensemble.workers import executor_of

if TYPE_CHECKING:
    import distributed
    import pandas
    import xarray

    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import Plan

MOST_THREADS = 4096
_CHUNK = 1 << 20


class Study:
    """A finished study in its folder; what is asked for is read from there."""

    def __init__(self, folder: Path, keeps: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self.folder, self._keeps = folder, keeps

    def __repr__(self) -> str:
        own = self.dataset["t_last"].sizes
        sizes = " × ".join(f"{name} {size}" for name, size in own.items())
        failed = f", {self.failed} failed" if self.failed else ""
        return f"<Study of {self.dataset.attrs['mechanism']}: {self.runs} runs{f' ({sizes})' if sizes else ''}{failed}>"

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """Measures, kept series and `failure` over the dimensions of the study; read from the file as it is asked.

        Coordinates are what was varied, SI, with `units`; NaN is what a failed run has no value for.
        """
        import xarray

        h5py_module()
        found = xarray.open_dataset(
            self.folder / DATASET, engine="h5netcdf", decode_times=False, decode_timedelta=False
        )
        return found if self._keeps is None else found.load()  # a temporary folder goes before what was asked of it

    @property
    def runs(self) -> int:
        """How many there are."""
        return int(self.dataset.attrs["runs"])

    @property
    def failed(self) -> int:
        """How many did not come to their end; `dataset["failure"]` says why."""
        return int(self.dataset.attrs["failed"])

    @property
    def failures(self) -> dict[str, int]:
        """What runs failed of, without their numbers, and how many of each; the most frequent first."""
        return dict(json.loads(self.dataset.attrs["failure_kinds"]))

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of it, each once."""
        return tuple(filter(None, str(self.dataset.attrs["notes"]).split("\n")))

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of what was measured."""
        found, others = self.dataset, ("t_last", "failure")
        own = (name for name, one in found.data_vars.items() if one.dims == found["t_last"].dims)
        return tuple(str(name) for name in own if name not in others)

    def to_dataframe(self, series: Iterable[str] | str = ()) -> pandas.DataFrame:
        """A row a run: what was varied, all measures, `failure`; SI. With names of kept series a row a sample."""
        asked = names(series, "series", "a list of names of kept series")
        times = ["t"] if asked and "t" in self.dataset else []
        found = self.dataset[[*times, *asked]] if asked else self.dataset[[*self.measures, "t_last", "failure"]]
        if not found.sizes:
            import pandas

            return pandas.DataFrame({str(name): [one.values.item()] for name, one in found.variables.items()})
        return found.to_dataframe().reset_index()

    def save(self, target: str | os.PathLike[str]) -> None:
        """Write the dataset as one NetCDF file, which any reader opens. Raises OutputError."""
        with open(self.folder / DATASET, "rb") as source, written(path(target, "path")) as file:
            while data := source.read(_CHUNK):
                file.write(data)


def plan_of(
    study: str | os.PathLike[str] | Mapping[str, Any], settings: Mapping[str, float | str] | None = None
) -> Plan:
    """The plan of a study file or of a mapping, its mechanism loaded. Raises InputError."""
    from gudgeon.generator.study.read import read_study
    from gudgeon.studies.ensemble.resolve import resolve

    h5py_module()
    given = {name: str(value) for name, value in mapping(settings, "settings").items()}
    if isinstance(study, Mapping):
        return resolve(read_study(study, "", given))
    file = os.fspath(path(study, "study"))
    data = read_named(file, MAX_BYTES, hint="name a YAML file that begins with format: gudgeon-study/1")
    return resolve(read_study(data, file, given))


def study(
    study: str | os.PathLike[str] | Mapping[str, Any], folder: str | os.PathLike[str] | None = None, *,
    threads: int | None = None, executor: Executor | distributed.Client | None = None,
    progress: Progress | None = None, restart: bool = False, settings: Mapping[str, float | str] | None = None,
) -> Study:  # fmt: skip
    """Make all runs of a study, and what it measures of them.

    study: a YAML file (docs/studies.md), or a mapping that says the same. folder: where finished blocks of runs go at
    once; the same call goes on from what is there, whatever ended it, to the same dataset. None: a temporary folder,
    which goes with the Study. threads: in each process, None for the cores there are (1 with an executor).
    executor: any of concurrent.futures, or a Client of dask.distributed; its workers are given blocks and load their
    own libraries. restart: begin anew. settings: {address: number or text} for all runs, over the study's own. A run
    that fails is a row with its reason and NaN, and stops no other.

    Raises InputError, with its place, for a mistake in the study or a folder of another study; OutputError for a
    disk that takes no more. Ctrl-C is passed on: what is in the folder stays.
    """
    threads = None if threads is None else whole(threads, "threads", 1, MOST_THREADS)
    pool, progress = executor_of(executor), function(progress, "progress")
    restart, plan = flag(restart, "restart"), plan_of(study, settings)
    if folder is None:
        kept = tempfile.TemporaryDirectory(prefix="gudgeon-study-")
        return run_plan(plan, Path(kept.name), threads, pool, progress, restart, kept)
    return run_plan(plan, Path(path(folder, "folder")), threads, pool, progress, restart)


def run_plan(
    plan: Plan, folder: Path, threads: int | None = None, executor: Executor | None = None,
    progress: Progress | None = None, restart: bool = False, keeps: tempfile.TemporaryDirectory[str] | None = None,
) -> Study:  # fmt: skip
    """The study of a plan in a folder."""
    with StudyFolder(folder, plan).opened(restart) as opened:
        finish(opened, threads, executor, progress)
    return Study(folder, keeps)


def load_study(folder: str | os.PathLike[str]) -> Study:
    """The finished study of a folder. Raises InputError for a folder that holds none, or one that is not finished."""
    place = Path(path(folder, "folder"))
    if (found := manifest(place)) is None:
        raise InputError(f"{shortened(place)} is no folder of a study: it has no {MANIFEST}")
    if not (place / DATASET).is_file():
        told = f"the study in {shortened(place)} is not finished"
        raise InputError(told, hint="gudgeon study FILE --out FOLDER goes on with it")
    study, h5py = Study(place), h5py_module()
    try:
        with h5py.File(place / DATASET, "r") as file:
            own = file.attrs["plan"] == found.get("plan") and len(file["failure"].shape) >= 0
    except (OSError, KeyError, ValueError, RuntimeError) as error:
        told = f"{shortened(place / DATASET)} cannot be read: {in_a_line(str(error))[:200]}"
        raise InputError(told, hint="remove it: gudgeon study FILE --out FOLDER writes it anew") from error
    if not own:
        raise InputError(f"{shortened(place / DATASET)} is of another study", hint="remove it: it is written anew")
    return study
