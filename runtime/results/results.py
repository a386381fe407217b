"""Define `Result`, the result of one run: the arrays that the integrator stored, and by name every series that follows
from them.

Stored are t, q, q̇, contact states, approach speeds and works, and q̈ in runs of at most 20,000 samples
(simulation/sample_checks.py). All other series are computed exactly from these on
first access, by one pass of the compiled model over the samples.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError, SolverError, UnknownNameError
from gudgeon.integrators.trajectory import IMPACT_DTYPE, make_empty_events
from gudgeon.language.argument_checks import check_text
from gudgeon.language.text_output import format_count
from gudgeon.model.baumgarte import select_motion_values
from gudgeon.model.choices import format_parameter
from gudgeon.model.deferred_fields import defer_fields, find_deferred_function, read_deferred_fields
from gudgeon.model.evaluation import FIELD_NAMES, Evaluation
from gudgeon.model.left_limit import find_evaluation_times_of_result
from gudgeon.results.diagnostics import Diagnostics, Extremes
from gudgeon.results.notebook_display import NotebookDisplay
from gudgeon.results.state import Array, State, make_state

if TYPE_CHECKING:
    import pandas
    import xarray

    from gudgeon.integrators.trajectory import Envelope, Progress
    from gudgeon.model.compiled import CompiledModel
    from gudgeon.results.contact_check import ContactCheck
    from gudgeon.results.figures.animation import Animation
    from gudgeon.results.figures.run_plots import Plot
    from gudgeon.results.reports.run_report import RunReport
    from gudgeon.results.samples import AtEvents
    from gudgeon.results.series import Series


@defer_fields(
    *("p", "t", "q", "v", "accelerations", "state", "memory", "work", "impacts", "diagnostics"),
    *("events", "event_states", "trace", "provenance"),
)
@dataclass(eq=False)
class Result(NotebookDisplay):
    """Result of one run with N samples: `run["S9.y"]` is the (N,) series of that name (see `gudgeon.series`).

    A Result can be pickled: stored and computed series go with it, the scene's library computes the others after
    loading.
    """

    compiled: CompiledModel | None  # None: read from a file, where every series is stored
    source: KernelSource
    p: Array  # (n_parameters + n_derived,)
    given: Array  # (n_parameters,) values of the parameters that were overridden
    is_given: Array  # (n_parameters,) bool, whether a parameter was overridden
    t: Array  # (N,) s
    q: Array  # (N, n)
    v: Array
    accelerations: Array | None  # (N, n), None: `a` computes them on first access
    state: Array  # (N, n_clearances) int8
    memory: Array  # (N, n_clearances)
    work: Array  # (N, 3) J: drives, applied forces, joints with play
    impacts: Array  # IMPACT_DTYPE, a record for each onset
    diagnostics: Diagnostics
    events: Array = field(
        default_factory=make_empty_events
    )  # EVENT_DTYPE, by time: zero crossings of the file's `events`
    event_states: Array | None = None  # event_dtype, the same with the states there; None: see samples.py
    trace: Envelope | None = None  # envelope of forces and paths over the steps; None: there are only samples
    stored: dict[str, Array] = field(default_factory=dict, repr=False)  # series computed or read so far
    provenance: dict[str, str] = field(default_factory=dict, repr=False)  # version, platform, compiler, date, mechanism
    start_row: Result | None = field(default=None, repr=False)  # the start (N = 1), where it was not requested
    given_start: State | None = field(default=None, repr=False)  # the exact state given as `start`; None: not known

    def __getitem__(self, name: str) -> Array:
        """Return the series of that name, (N,), in SI, read-only. Raises UnknownNameError with the nearest name."""
        if not isinstance(name, str):
            raise self.make_unknown_name_error(name)
        if name == "t":
            return self.t
        if name not in self.stored:
            values = self._get_series(name).compute(self)[:]
            values.flags.writeable = False
            self.stored[name] = values
        return self.stored[name]

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of all series, as a mapping does."""
        return iter(self.names)

    def __contains__(self, name: str) -> bool:
        """Return whether the result has a series of that name."""
        return isinstance(name, str) and (name == "t" or name in self._catalogue)

    def __repr__(self) -> str:
        """Return mechanism, scene, number of samples and time span in one line."""
        span = f"{self.t[0]:g} … {self.t[-1]:g} s" if len(self.t) else "empty"
        return f"<Result {self.source.mechanism}/{self.source.scene}: {format_count(len(self.t), 'sample')}, {span}>"

    @cached_property
    def names(self) -> Mapping[str, str]:
        """Units of all series by name, in the order in which a file stores them."""
        return MappingProxyType({name: series.unit for name, series in self._catalogue.items()})

    def unit(self, name: str) -> str:
        """Return the SI unit of a series, "" for a pure number, "s" for "t".

        Raises UnknownNameError with the nearest name.
        """
        return "s" if check_text(name, "the name of a series") == "t" else self._get_series(name).unit

    def meaning(self, name: str) -> str:
        """Return the meaning of a series in one line.

        Raises UnknownNameError with the nearest name.
        """
        return "time" if check_text(name, "the name of a series") == "t" else self._get_series(name).meaning

    @cached_property
    def parameters(self) -> Mapping[str, Any]:
        """Values of all run-time parameters and names of choices, by address, read-only.

        Entries of `parameters` of the file are also there by their short name.
        """
        values_by_address = {
            parameter.address: format_parameter(parameter, float(number))
            for parameter, number in zip(self.source.parameters, self.p, strict=False)
        }
        short_names = {
            key.removeprefix("parameters."): value
            for key, value in values_by_address.items()
            if key.startswith("parameters.")
        }
        return MappingProxyType(values_by_address | short_names)

    @cached_property
    def constants(self) -> Mapping[str, float]:
        """Main constants of each joint with play, SI, by name, read-only.

        They are the clearance "A.c" and the constants of its laws, "A.K", "A.S" and so on.
        """
        constants = {f"{joint.name}.c": float(self.p[joint.clearance]) for joint in self.source.clearances}
        for joint in self.source.clearances:
            constants |= {f"{joint.name}.{name}": float(self.p[i]) for name, i in joint.constants.items()}
        return MappingProxyType(constants)

    def events_of(self, name: str) -> Array:
        """Return the times at which an event of the file happened, (k,), in s.

        Raises UnknownNameError with the nearest event.
        """
        names = [event.name for event in self.source.events]
        if check_text(name, "the name of an event") not in names:
            from gudgeon.language.names import find_nearest_name

            nearest_name = find_nearest_name(name, names)
            hint = f"did you mean {nearest_name!r}?" if nearest_name else f"its events: {', '.join(names) or 'none'}"
            raise UnknownNameError(f"the scene {self.source.scene!r} has no event named {name!r}", hint=hint)
        times: Array = self.events["t"][self.events["event"] == names.index(name)]
        return times

    def at_events(self, name: str) -> AtEvents:
        """Return the states at the located times of an event: `run.at_events("top")["S9.ay"]` is (k,); see AtEvents."""
        from gudgeon.results.samples import select_event_states

        return select_event_states(self, name)

    def peak(self, name: str) -> Extremes:
        """Return the largest and smallest value of a series over all steps of this run, with their times (s); SI.

        The series must be requested by `simulate(peaks=["S9.ay"])` or `peaks:` of the scene. A run that restarts from
        another one has the peaks of its own part. Raises UnknownNameError, BadValueError.
        """
        from gudgeon.results.peaks import find_extremes_over_steps

        return find_extremes_over_steps(self, name, False)

    def peak_error(self, name: str) -> Extremes:
        """Return the extremes of a series less that of another scene at the same times: `simulate(peaks=…,
        against=ideal)`.
        """
        from gudgeon.results.peaks import find_extremes_over_steps

        return find_extremes_over_steps(self, name, True)

    @cached_property
    def states_at_events(self) -> Result:
        """The result whose samples are the start and then all events, by time."""
        from gudgeon.results.samples import make_result_at_events

        return make_result_at_events(self)

    @property
    def final(self) -> State:
        """The last sample as a state from which `simulate(start=…)` restarts.

        It contains the overridden parameters and the identity of the scene; arrays are copies.
        """
        arrays = (array[-1] for array in (self.q, self.v, self.state, self.memory))
        return make_state(self.source, self.given, self.is_given, float(self.t[-1]), *arrays)

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields for pickle, with the evaluation if it exists; other cached values are cheap to compute."""
        stored_names = {
            *(dataclass_field.name for dataclass_field in fields(self)),
            "evaluation",
            "a",
            "states_at_events",
        }
        return read_deferred_fields(self) | {
            name: value for name, value in self.__dict__.items() if name in stored_names
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore the fields from pickle, with read-only series."""
        self.__dict__.update(state)
        for values in self.stored.values():
            values.flags.writeable = False

    @cached_property
    def a(self) -> Array:
        """Accelerations q̈, (N, n); all NaN if one of the samples has no solution.

        They are stored, or else evaluated by the compiled model on first access.
        """
        try:
            return self.evaluation.a if self.accelerations is None else self.accelerations
        except SolverError:
            return np.full_like(self.q, np.nan)

    @cached_property
    def evaluation(self) -> Evaluation:
        """Accelerations, multipliers, reactions, torques, forces of joints with play and energies at all samples.

        The compiled model computes them on first access. Raises GudgeonError for a result that was read from a file.
        """
        if build := find_deferred_function(self, "evaluation"):
            return cast(Evaluation, build())
        if self.compiled is None:
            raise GudgeonError("this result was read from a file that lacks the series; run the scene again")
        return self.compiled.evaluate(
            find_evaluation_times_of_result(self, self.compiled),
            *(self.q, self.v, self.memory),
            select_motion_values(self.compiled, self.diagnostics.method, self.p),
        )

    @property
    def plot(self) -> Plot:
        """Figures of this run: `run.plot()`, `run.plot("S9.y")`, `run.plot.orbit("A")`, `.forces()`, `.series()`."""
        from gudgeon.results.figures.run_plots import Plot

        return Plot(self)

    def animate(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        seconds: float | None = None,
        rate: float = 25.0,
        points: Iterable[str] = (),
        velocities: bool = False,
        forces: bool = False,
        progress: Progress | None = None,
    ) -> Animation | None:
        """Write an animation of the run: x.gif, x.mp4 (needs ffmpeg) or x.html, a self-contained page that plays.

        `seconds`: duration of the animation; None for that of the run, or 6 s if the run is shorter than 2 s or longer
        than 20 s. `rate`: frames per second; the time of writing is proportional to the number of frames. `points`:
        points whose paths are drawn. `velocities`, `forces`: draw arrows, as in `plot.mechanism`. Joints with play are
        magnified next to the mechanism, in red if their surfaces have touched since the last frame.
        `progress(fraction, text)` is called for each frame.

        Return an object that a notebook displays, for a page or without a path; else None. Raises BadValueError,
        UnknownNameError, and GudgeonError for an mp4 file without ffmpeg.
        """
        from gudgeon.results.figures import animation

        options = animation.check_animation_options(self, seconds, rate, points, velocities, forces, progress)
        return animation.write_animation(self, path, options)

    def report(self) -> RunReport:
        """Return a report on forces in joints with play, energies and accuracy: `print`, `.to_html()`, `.to_dict()`."""
        from gudgeon.results.reports.run_report import RunReport

        return RunReport(self)

    def check(self, samples: int = 20_000) -> ContactCheck:
        """Check the contacts of this run independently of the code that located them.

        The run is repeated bit for bit with `samples` equal intervals. The penetration of every joint with play is
        computed from positions of the bodies. Returns the faults outside the contacts of `impacts`, by time, as a
        ContactCheck, which is true if there are none. `str` lists joint, time (s) and depth (m) of each fault;
        `raise_faults()` raises them as a SolverError. Raises BadValueError unless `samples` is a whole number, 2 or
        more.
        """
        from gudgeon.simulation.examine import check_contacts

        return check_contacts(self, samples)

    def value_of(self, name: str) -> Any:
        """Return the value of a name in an output's expression: a parameter's number, or t or a series (N,).

        A parameter takes precedence over an output of the same name. Raises UnknownNameError.
        """
        index = self.source.parameter_indices
        k = index.get(f"parameters.{check_text(name, 'a name of a result')}", index.get(name))
        if k is not None:
            return format_parameter(self.source.parameters[k], float(self.p[k]))
        if name in self:
            return self[name]
        raise self.make_unknown_name_error(name)

    def to_xarray(self, part: str = "series") -> xarray.Dataset:
        """Return all series as one Dataset over `time`, with units and long names; `.to_dataframe()` has a row for each
        sample.

        part: "impacts", "events" or "parameters" for these, with a row for each record.
        """
        from gudgeon.results.files import netcdf

        return netcdf.build_dataset(self, part)

    def to_dataframe(self, names: Iterable[str] | None = None) -> pandas.DataFrame:
        """Return series as columns of a pandas table over t (s): `names`, or all for None; SI, units in
        `attrs["units"]`.
        """
        from gudgeon.results.files import export

        return export.build_dataframe(self, names)

    def to_csv(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write t and the series `names`, or all, as CSV in SI: a line of names, then a line for each sample with all
        digits.
        """
        from gudgeon.results.files import export

        export.write_csv(self, path, names)

    def to_mat(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write t and the series `names`, or all, for MATLAB: "S9.y" as S9_y; cells `variables`, `names` and
        `units`.
        """
        from gudgeon.results.files import export

        export.write_mat(self, path, names)

    def save(self, path: str | os.PathLike[str], attributes: Mapping[str, str] = MappingProxyType({})) -> None:
        """Write everything to a NetCDF file, with more attributes {name: text}.

        The file is written under a temporary name, then moved into place. Raises OutputError if that fails,
        BadValueError for invalid attributes.
        """
        from gudgeon.results.files import netcdf

        netcdf.save(self, path, attributes)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Result:
        """Return the result that `save` wrote, bit for bit, without a compiled library."""
        return read(path)

    @cached_property
    def _catalogue(self) -> Mapping[str, Series]:
        """All series of the scene by name."""
        from gudgeon.results.series import get_catalogue

        return get_catalogue(self.source)

    def _get_series(self, name: str) -> Series:
        """Return the catalogue's entry of the series `name`.

        Raises UnknownNameError with the nearest name.
        """
        try:
            return self._catalogue[name]
        except KeyError:
            raise self.make_unknown_name_error(name) from None

    @property
    def sample_counts(self) -> tuple[int, ...]:
        """Number of samples of each run in `t`: one entry here, several in EvaluatedSamples."""
        return (len(self.t),)

    def make_unknown_name_error(self, name: str) -> UnknownNameError:
        """Return, without raising it, the error for a name that this result does not have, with the nearest name."""
        from gudgeon.results.series import list_parameter_names, make_unknown_series_error

        return make_unknown_series_error(self.source, self._catalogue, name, list_parameter_names(self.source))


def read(path: str | os.PathLike[str]) -> Result:
    """Read a file that `Result.save` wrote. Raises InputError for any other file."""
    from gudgeon.results.files import netcdf

    return netcdf.read(path)


@dataclass(eq=False)
class EvaluatedSamples(Result):
    """A Result whose series are computed from the fields `evaluation_fields` of an Evaluation only; it has no
    diagnostics.

    Samples of several runs may follow each other. `sample_counts_of_runs` then has the number of samples of each run,
    and p the parameter values (n_runs, n_p).
    """

    evaluation_fields: frozenset[str] = FIELD_NAMES
    sample_counts_of_runs: tuple[int, ...] = ()

    @property
    def sample_counts(self) -> tuple[int, ...]:
        """Number of samples of each run in `t`; one entry if `sample_counts_of_runs` is empty."""
        return self.sample_counts_of_runs or super().sample_counts

    @cached_property
    def evaluation(self) -> Evaluation:
        """An Evaluation of the fields `evaluation_fields`, computed on first access; the other fields have no row.

        Raises SingularError, and GudgeonError without a compiled library.
        """
        if self.compiled is None:
            raise GudgeonError("these samples cannot be evaluated: the scene has no compiled library")
        times = find_evaluation_times_of_result(self, self.compiled)
        return self.compiled.evaluate(times, self.q, self.v, self.memory, self.p, field_names=self.evaluation_fields)


def make_evaluated_samples(
    source: KernelSource,
    compiled: CompiledModel | None,
    p: Array,
    t: Array,
    q: Array,
    v: Array,
    work: Array,
    discrete_states: Array,
    state: Array,
    field_names: frozenset[str],
) -> EvaluatedSamples:
    """Return a result of samples as C stores them; of an Evaluation it can evaluate only the fields `field_names`.

    `work` (N, 3); `discrete_states` (N, n_discrete_states): approach speeds, friction modes, internal states; `state`
    (N, n_clearances): contact codes. It has no diagnostics, impacts or overridden parameters. Works are NaN in a scene
    without masses.
    """
    n_parameters = len(source.parameters)
    return EvaluatedSamples(
        compiled=compiled,
        source=source,
        p=p,
        given=np.zeros(n_parameters),
        is_given=np.zeros(n_parameters, bool),
        t=t,
        q=q,
        v=v,
        accelerations=None,
        state=state,
        memory=discrete_states,
        work=np.full_like(work, np.nan) if source.massless_bodies else work,
        impacts=np.zeros(0, IMPACT_DTYPE),
        diagnostics=cast(Diagnostics, None),
        evaluation_fields=field_names,
    )


def make_empty_result(source: KernelSource) -> EvaluatedSamples:
    """Return a result without samples, which has the names and units of a scene's series.

    Used to check names and units before there are results.
    """
    n, n_clearances = len(source.coordinates), len(source.clearances)
    p = np.full(len(source.parameters) + len(source.derived), np.nan)
    empty_arrays = np.zeros((0, n)), np.zeros((0, n)), np.zeros((0, 3)), np.zeros((0, source.n_discrete_states))
    return make_evaluated_samples(
        source, None, p, np.zeros(0), *empty_arrays, np.zeros((0, n_clearances), np.int8), FIELD_NAMES
    )
