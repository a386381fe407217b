"""Define the plan of a study (design of experiments): its runs over the varied parameters, in blocks (batches)."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.results.batch import Array
from gudgeon.studies.ensemble.block import Job, RunSettings

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import StudyFile, StudySet
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.studies.ensemble.claims import ResolvedClaims

FOLDER_FORMAT = "gudgeon-study-folder/1"
MAX_RUNS, MAX_STRUCTURES = 100_000_000, 10_000


@dataclass(frozen=True, eq=False)
class Coordinate:
    """A coordinate of the dataset: values (SI or words) over the dimensions `over` of the study; () for a scalar."""

    name: str
    over: tuple[str, ...]
    values: Array
    unit: str = ""
    meaning: str = ""


@dataclass(frozen=True, eq=False)
class StudyDimension:
    """A dimension of a study, with the values (length,) of each parameter that varies along it, by name."""

    name: str
    length: int
    columns: Mapping[str, Array] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Deviations:
    """Deviations of perturbed starts by parameter: relative and absolute (SI), (n_ensembles, n_starts) each."""

    relative: dict[str, Array]
    absolute: dict[str, Array]


@dataclass(frozen=True, eq=False)
class Part:
    """Runs of one scene with one option of each choice of structure, which share one compiled library."""

    simulation: Simulation
    mechanism: str
    overrides: tuple[tuple[str, str], ...]
    block_runs: int = 1  # runs of a block
    mean_samples: float = 1.0  # of a run, estimated from some of the runs
    max_samples: float = 1.0  # of a run, estimated from the same runs

    @property
    def sha256(self) -> str:
        """Return the digest of all inputs from which the library of the part was generated."""
        return self.simulation.source.whole_sha256


class BlockRange(NamedTuple):
    """The runs of a block: a range of the runs of a part (library)."""

    number: int
    part: int  # index of the part
    first_run: int  # index in the part
    runs: int  # number of runs


@dataclass(frozen=True, eq=False)
class Plan:
    """A study with resolved names: its runs are all combinations of its dimensions, in C order.

    Dimensions of structure (scenes and choices) are first, then those of parameters and starts.
    """

    study: StudyFile
    structure_dimensions: tuple[StudyDimension, ...]
    parameter_dimensions: tuple[StudyDimension, ...]
    fixed: Mapping[str, float | str]
    deviations: Deviations | None
    coordinates: tuple[Coordinate, ...]
    parts: tuple[Part, ...]
    run_settings: RunSettings
    units: Mapping[str, str]  # of measures and series
    notes: tuple[str, ...] = ()

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the lengths of all dimensions, those of structure first."""
        return tuple(dimension.length for dimension in (*self.structure_dimensions, *self.parameter_dimensions))

    @property
    def dims(self) -> tuple[str, ...]:
        """Return the names of all dimensions, those of structure first."""
        return tuple(dimension.name for dimension in (*self.structure_dimensions, *self.parameter_dimensions))

    @property
    def runs_per_part(self) -> int:
        """Return the number of runs of each part."""
        return math.prod(coordinate.length for coordinate in self.parameter_dimensions)

    @property
    def runs(self) -> int:
        """Return the number of runs of all parts."""
        return self.runs_per_part * len(self.parts)

    @property
    def n_blocks(self) -> int:
        """Return the number of blocks of all parts."""
        return sum(-(-self.runs_per_part // part.block_runs) for part in self.parts)

    @cached_property
    def blocks(self) -> tuple[BlockRange, ...]:
        """Return all blocks, part by part, each with its range of runs."""
        n_runs = self.runs_per_part
        ranges = (
            (k, first, min(part.block_runs, n_runs - first))
            for k, part in enumerate(self.parts)
            for first in range(0, n_runs, part.block_runs)
        )
        return tuple(BlockRange(number, *range_) for number, range_ in enumerate(ranges))

    def make_block_job(self, block: BlockRange, threads: int | None) -> Job:
        """Return the job of a block, a picklable description of its runs for a worker; `threads` as in `study`."""
        runs = np.arange(block.first_run, block.first_run + block.runs)
        return self.make_job(block.number, block.part, runs, threads, self.runs_per_part - block.first_run - block.runs)

    def make_job(
        self, block_number: int, part_index: int, runs: Array, threads: int | None, n_later_runs: int = 0
    ) -> Job:
        """Return the job of arbitrary runs of a part, with their parameters and deviations, (n_runs,) each.

        runs: indices in the part, ascending. threads: None for the number of cores. n_later_runs: number of runs of the
        part in later blocks. It is called for blocks and for trial runs.
        """
        part, shape = self.parts[part_index], tuple(coordinate.length for coordinate in self.parameter_dimensions)
        index = np.unravel_index(runs, shape) if shape else ()
        columns: dict[str, Array] = {name: np.array([value] * len(runs)) for name, value in self.fixed.items()}
        for coordinate, indices in zip(self.parameter_dimensions, index, strict=True):
            columns |= {name: values[indices] for name, values in coordinate.columns.items()}
        by_name = {
            coordinate.name: indices for coordinate, indices in zip(self.parameter_dimensions, index, strict=True)
        }
        relative, absolute = self._select_deviations(by_name, len(runs))
        return Job(
            part.mechanism,
            part.simulation.source.scene,
            part.overrides,
            part.sha256,
            block_number,
            part_index * self.runs_per_part + int(runs[0]),
            len(runs),
            columns,
            relative,
            absolute,
            self.run_settings,
            threads,
            n_later_runs,
        )

    def _select_deviations(
        self, indices_by_dimension: Mapping[str, Array], n_runs: int
    ) -> tuple[dict[str, Array], dict[str, Array]]:
        """Return the relative and absolute deviations of runs by parameter, (n_runs,) each.

        indices_by_dimension: indices of the runs along each dimension, (n_runs,) each. Both are empty without perturbed
        starts.
        """
        if self.deviations is None:
            return {}, {}
        cell = indices_by_dimension.get("ensemble", np.zeros(n_runs, dtype=int)), indices_by_dimension["start"]
        both_deviations = self.deviations.relative, self.deviations.absolute
        relative, absolute = ({name: values[cell] for name, values in ensemble.items()} for ensemble in both_deviations)
        return relative, absolute

    @cached_property
    def input_description(self) -> dict[str, Any]:
        """Return all inputs of the results as JSON data: study file, version of gudgeon, digests of the libraries.

        A folder belongs to this plan if its manifest has an equal description.
        """
        import gudgeon

        parts = {
            ", ".join([part.simulation.source.scene, *(f"{k}={v}" for k, v in part.overrides)]): part.sha256
            for part in self.parts
        }
        return {
            "format": FOLDER_FORMAT,
            "gudgeon": gudgeon.__version__,
            "study": self.study.specified,
            "mechanism": parts,
        }

    @cached_property
    def identity(self) -> str:
        """Return the SHA-256 of `input_description`."""
        return _compute_sha256(self.input_description)

    @cached_property
    def digest(self) -> str:
        """Return the SHA-256 of `input_description` and of the block sizes, by which files of blocks are recognised."""
        return _compute_sha256([self.input_description, [part.block_runs for part in self.parts]])


@dataclass(frozen=True, eq=False)
class Plans:
    """The plans of a study file by part: one for each of its parts, or one with the name ""; and its claims."""

    file: StudySet
    by_part: Mapping[str, Plan]
    claims: ResolvedClaims | None = None

    @property
    def named(self) -> bool:
        """Return whether the study file has named parts."""
        return self.file.named

    @property
    def runs(self) -> int:
        """Return the number of runs of all parts."""
        return sum(plan.runs for plan in self.by_part.values())


def check_study_size(study: StudyFile) -> None:
    """Raise BadValueError at the longest dimension if a study has more than MAX_RUNS runs or MAX_STRUCTURES structures.

    A structure is a scene with one option of each choice. It is called first, since it needs no loaded mechanism.
    """
    structures = [(len(study.scenes), study.scenes[0].where)]
    structures += [(len(choice.options), choice.where) for choice in study.choices]
    run_dimensions = [(axis.length, axis.where) for axis in study.axes]
    run_dimensions += [(study.draw.count, next(iter(study.draw.distributions)).where)] if study.draw else []
    if study.starts:
        start_name = next(name for ensemble in study.starts.ensembles.values() for name in ensemble)
        run_dimensions.append((study.starts.count * len(study.starts.ensembles), start_name.where))
    n_structures, n_runs = math.prod(n for n, _ in structures), math.prod(n for n, _ in [*structures, *run_dimensions])
    for count, max_count, dimensions, description in (
        (n_structures, MAX_STRUCTURES, structures, "scenes with their choices, one library each"),
        (n_runs, MAX_RUNS, [*structures, *run_dimensions], "runs"),
    ):
        if count > max_count:
            where = max(dimensions, key=lambda length_and_location: length_and_location[0])[1]
            raise BadValueError(f"the study has {count} {description}", where, f"expected at most {max_count:.0e}")


def _compute_sha256(value: Any) -> str:
    """Return the SHA-256 (hexadecimal) of a value as JSON with sorted keys."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()
