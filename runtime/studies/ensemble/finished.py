"""Define `Study`, the results of a finished study in its folder: datasets, tables and claims are read on request."""

from __future__ import annotations

import json
import os
import tempfile
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.errors import GudgeonError
from gudgeon.files.writing import open_atomic
from gudgeon.language.argument_checks import check_names, check_path
from gudgeon.language.names import make_missing_name_error
from gudgeon.studies.ensemble.claim_tables import JudgedClaims, read_judged_claims
from gudgeon.studies.ensemble.folder import DATASET, convert_read_errors, import_h5py
from gudgeon.studies.ensemble.names import Names, read_display_names

if TYPE_CHECKING:
    import pandas
    import xarray

    from gudgeon.studies.show.study_page import StudyReport
    from gudgeon.studies.show.study_plots import StudyPlot

_CHUNK = 1 << 20  # bytes that are copied at once


class Study:
    """The results of a finished study in its folder, from which datasets and tables are read on request."""

    def __init__(
        self,
        folder: Path,
        temporary_folder: tempfile.TemporaryDirectory[str] | None = None,
        parent_study: Study | None = None,
    ) -> None:
        """Refer to the study in a folder, without access to the disk.

        temporary_folder: kept until the study is deleted; None for a permanent folder. parent_study: the study of which
        this is a part.
        """
        self.folder, self._temporary_folder, self._whole = folder, temporary_folder, parent_study

    def __repr__(self) -> str:
        """Return mechanism, number of runs, dimensions and number of failures in one line."""
        n_runs_by_dim = self.dataset["t_last"].sizes
        sizes = " × ".join(f"{name} {size}" for name, size in n_runs_by_dim.items())
        failed = f", {self.failed} failed" if self.failed else ""
        return f"<Study of {self.dataset.attrs['mechanism']}: {self.runs} runs{f' ({sizes})' if sizes else ''}{failed}>"

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """Return measures, stored series and `failure` over the dimensions of the study, read from the file on access.

        Coordinates are the varied parameters, SI, with `units`. NaN: a failed run has no value. A study in a temporary
        folder is read whole. Raises InputError for a damaged file.
        """
        import xarray

        import_h5py()
        with convert_read_errors(path := self.folder / DATASET):
            opened = xarray.open_dataset(path, engine="h5netcdf", decode_times=False, decode_timedelta=False)
        return (
            opened if self._temporary_folder is None else opened.load()
        )  # a temporary folder may be deleted before the dataset is used

    @property
    def parts(self) -> Mapping[str, Study]:
        """Return the studies by the names of the file's parts; empty for a file without parts."""
        return {}

    @cached_property
    def claims(self) -> JudgedClaims:
        """Return the claims of the file, judged by the runs: the tables `claims.numbers` and `claims.trends`.

        A part of a study has the numbers that name the part, and all trends. Raises GudgeonError for a file without
        claims.
        """
        if self._whole is None:
            return read_judged_claims(self.folder)
        study_claims = self._whole.claims
        return study_claims._replace(numbers=study_claims.numbers[study_claims.numbers["part"] == self.folder.name])

    @cached_property
    def names(self) -> Names:
        """Return the display texts of names and values for reports; a part has those of the whole study."""
        return read_display_names(self.folder) if self._whole is None else self._whole.names

    @property
    def tree(self) -> xarray.DataTree:
        """Return the dataset as an xarray tree of one node."""
        import xarray

        return xarray.DataTree(self.dataset)

    @property
    def runs(self) -> int:
        """Return the number of runs."""
        return int(self.dataset.attrs["runs"])

    @property
    def failed(self) -> int:
        """Return the number of failed runs; `dataset["failure"]` has the reasons."""
        return int(self.dataset.attrs["failed"])

    @property
    def failures(self) -> dict[str, int]:
        """Return the number of runs by kind of failure (a reason without the values of single runs), the most frequent
        first.
        """
        return dict(json.loads(self.dataset.attrs["failure_kinds"]))

    @property
    def first_failures(self) -> dict[str, int]:
        """Return the number of the first failed run of each kind, in the order of `dataset["failure"].values.flat`.

        Empty for a file of an earlier version.
        """
        return dict(zip(self.failures, json.loads(self.dataset.attrs.get("failure_first", "[]")), strict=False))

    @property
    def notes(self) -> tuple[str, ...]:
        """Return the notes on the study and its runs, a text for each kind: of the plan, then of runs by frequency."""
        return tuple(filter(None, str(self.dataset.attrs["notes"]).split("\n")))

    @property
    def measures(self) -> tuple[str, ...]:
        """Return the names of the measures: variables over all dimensions of the runs, except `t_last` and
        `failure`.
        """
        dataset, others = self.dataset, ("t_last", "failure")
        names = (name for name, variable in dataset.data_vars.items() if variable.dims == dataset["t_last"].dims)
        return tuple(str(name) for name in names if name not in others)

    def to_dataframe(self, series: Iterable[str] | str = ()) -> pandas.DataFrame:
        """Return a table with a row for each run: varied parameters, all measures, `t_last`, `failure`; SI.

        With names of stored series it has a row for each sample instead. Raises UnknownNameError for a series that the
        study did not store.
        """
        requested = check_names(series, "series", "a list of names of stored series")
        for name in requested:
            if name not in self.dataset.data_vars or name in (*self.measures, "t_last", "failure", "t"):
                stored = tuple(str(variable) for variable in self.dataset.data_vars if "." in str(variable))
                raise make_missing_name_error(f"the study stored no series {name!r}", name, stored)
        times = ["t"] if requested and "t" in self.dataset else []
        variables = (
            self.dataset[[*times, *requested]] if requested else self.dataset[[*self.measures, "t_last", "failure"]]
        )
        if not variables.sizes:
            import pandas

            return pandas.DataFrame(
                {str(name): [variable.values.item()] for name, variable in variables.variables.items()}
            )
        return variables.to_dataframe().reset_index()

    @property
    def plot(self) -> StudyPlot:
        """Return the plotting methods of the study: `study.plot.measure("peak", "c")`, `study.plot.bands("S9.y")`."""
        from gudgeon.studies.show.study_plots import StudyPlot

        return StudyPlot(self)

    def report(self) -> StudyReport:
        """Return the report of the study: `.to_html()` returns a page, and a notebook displays the report itself."""
        from gudgeon.studies.show.study_page import StudyReport

        return StudyReport(self)

    def save(self, target: str | os.PathLike[str]) -> None:
        """Copy the NetCDF file of the dataset to the path `target`, replacing an existing file. Raises OutputError."""
        with open(self.folder / DATASET, "rb") as source, open_atomic(check_path(target, "path")) as file:
            while data := source.read(_CHUNK):
                file.write(data)


class StudyOfParts(Study):
    """A finished study whose file has parts: each part is a Study, all of them together one DataTree."""

    def __init__(
        self, folder: Path, parts: Sequence[str], temporary_folder: tempfile.TemporaryDirectory[str] | None = None
    ) -> None:
        """Refer to the studies of all parts in the subfolders of a folder, without access to the disk.

        parts: names of the parts and subfolders. temporary_folder: kept until the study is deleted.
        """
        super().__init__(folder, temporary_folder)
        self._parts = {name: Study(folder / name, temporary_folder, self) for name in parts}

    def __repr__(self) -> str:
        """Return the parts with their numbers of runs, and the number of failures, in one line."""
        message = ", ".join(f"{name} {part.runs}" for name, part in self._parts.items())
        return f"<Study of {len(self._parts)} parts: {message} runs{f', {self.failed} failed' if self.failed else ''}>"

    @property
    def parts(self) -> Mapping[str, Study]:
        """Return the studies by the names of the file's parts."""
        return dict(self._parts)

    @property
    def dataset(self) -> xarray.Dataset:
        """Raise GudgeonError: each part has its own dataset."""
        raise self._make_parts_only_error("dataset")

    @property
    def tree(self) -> xarray.DataTree:
        """Return an xarray tree with a node for each part, which holds its dataset."""
        import xarray

        return xarray.DataTree.from_dict({name: part.dataset for name, part in self._parts.items()})

    @property
    def runs(self) -> int:
        """Return the number of runs of all parts."""
        return sum(part.runs for part in self._parts.values())

    @property
    def failed(self) -> int:
        """Return the number of failed runs of all parts."""
        return sum(part.failed for part in self._parts.values())

    @property
    def failures(self) -> dict[str, int]:
        """Return the number of runs by kind of failure over all parts, the most frequent first."""
        counts_by_kind: Counter[str] = Counter()
        for part in self._parts.values():
            counts_by_kind.update(part.failures)
        return dict(counts_by_kind.most_common())

    @property
    def notes(self) -> tuple[str, ...]:
        """Return the notes on all parts, each after the name of its part."""
        return tuple(f"{name}: {note}" for name, part in self._parts.items() for note in part.notes)

    @property
    def measures(self) -> tuple[str, ...]:
        """Return the names of the measures of any part, without repetitions."""
        return tuple(dict.fromkeys(name for part in self._parts.values() for name in part.measures))

    @property
    def plot(self) -> StudyPlot:
        """Raise GudgeonError: each part has its own figures."""
        raise self._make_parts_only_error("plot")

    def to_dataframe(self, series: Iterable[str] | str = ()) -> pandas.DataFrame:
        """Raise GudgeonError: each part has its own table."""
        raise self._make_parts_only_error("to_dataframe()")

    def save(self, target: str | os.PathLike[str]) -> None:
        """Write the datasets of all parts as one NetCDF file with a group for each, for `xarray.open_datatree`.

        Raises OutputError.
        """
        with open_atomic(check_path(target, "path")) as file:
            file.write(bytes(self.tree.to_netcdf(engine="h5netcdf")))

    def _make_parts_only_error(self, request: str) -> GudgeonError:
        """Return the error for an attribute, such as "dataset", that only the parts have; it lists the parts."""
        name = next(iter(self._parts))
        return GudgeonError(
            f"this study has parts: {', '.join(self._parts)}\n  use one of them: study.parts[{name!r}].{request}"
        )
