"""The result of one run: what the integrator stored, and by name everything that follows from it.

Stored are t, q, q̇, q̈, contact state, latched rates and work; all other series are computed on
first access, exactly, from these (one pass of the compiled model over the samples).
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
from gudgeon.integrators.trajectory import IMPACT_DTYPE, no_events
from gudgeon.language.shown import counted
from gudgeon.language.wanted import text
from gudgeon.model.choices import said
from gudgeon.model.evaluation import PARTS, Evaluation
from gudgeon.model.left_limit import evaluation_times_of
from gudgeon.results.diagnostics import Diagnostics, Extremes
from gudgeon.results.shown import Shown
from gudgeon.results.state import Array, State

if TYPE_CHECKING:
    import pandas
    import xarray

    from gudgeon.integrators.trajectory import Progress, Trace
    from gudgeon.model.compiled import CompiledModel
    from gudgeon.results.contact_check import ContactCheck
    from gudgeon.results.figures.animation import Animation
    from gudgeon.results.figures.run_plots import Plot
    from gudgeon.results.reports.run_report import RunReport
    from gudgeon.results.samples import AtEvents
    from gudgeon.results.series import Series


@dataclass(eq=False)
class Result(Shown):
    """One run of N samples. `run["S9.y"]` is the (N,) series of that name (see `gudgeon.series`).

    It may be pickled: what is stored and computed goes with it, other series are computed there by the scene's library.
    """

    compiled: CompiledModel | None  # None: read from a file, where every series is stored
    source: KernelSource
    p: Array  # (n_slots + n_derived,)
    given: Array  # (n_slots,) values of the slots that were overridden
    is_given: Array  # (n_slots,) bool
    t: Array  # (N,) s
    q: Array  # (N, n)
    v: Array
    accelerations: Array | None  # (N, n), None: `a` computes them when they are first asked for
    state: Array  # (N, n_clearances) int8
    memory: Array  # (N, n_clearances)
    work: Array  # (N, 3) J: drives, applied forces, joints with play
    impacts: Array  # IMPACT_DTYPE, one an onset
    diagnostics: Diagnostics
    events: Array = field(default_factory=no_events)  # EVENT_DTYPE, by time: what the file's `events` watch
    event_states: Array | None = None  # event_dtype, the same with the states there; None: see samples.py
    trace: Trace | None = None  # forces and paths from the steps; None: samples are all there is
    stored: dict[str, Array] = field(default_factory=dict, repr=False)  # series computed or read so far
    provenance: dict[str, str] = field(default_factory=dict, repr=False)  # version, platform, compiler, date, mechanism
    start_row: Result | None = field(default=None, repr=False)  # the start (N = 1), where it was not requested
    begun: State | None = field(default=None, repr=False)  # given as `start`, which samples round; None: not known

    def __getitem__(self, name: str) -> Array:
        """The series of that name, (N,), in SI, read-only. UnknownNameError names the nearest."""
        if not isinstance(name, str):
            raise self.unknown(name)
        if name == "t":
            return self.t
        if name not in self.stored:
            values = self._series(name).compute(self)[:]
            values.flags.writeable = False
            self.stored[name] = values
        return self.stored[name]

    def __iter__(self) -> Iterator[str]:
        """The names of all series, as of a mapping."""
        return iter(self.names)

    def __contains__(self, name: str) -> bool:
        return isinstance(name, str) and (name == "t" or name in self._catalogue)

    def __repr__(self) -> str:
        span = f"{self.t[0]:g} … {self.t[-1]:g} s" if len(self.t) else "empty"
        return f"<Result {self.source.mechanism}/{self.source.scene}: {counted(len(self.t), 'sample')}, {span}>"

    @cached_property
    def names(self) -> Mapping[str, str]:
        """Every name with its unit, in the order in which a file stores them."""
        return MappingProxyType({name: series.unit for name, series in self._catalogue.items()})

    def unit(self, name: str) -> str:
        """SI unit of a series, "" for a pure number."""
        return "s" if text(name, "the name of a series") == "t" else self._series(name).unit

    def meaning(self, name: str) -> str:
        """One line on what a series is."""
        return "time" if text(name, "the name of a series") == "t" else self._series(name).meaning

    @cached_property
    def parameters(self) -> Mapping[str, Any]:
        """Values of all run-time numbers, and names that are chosen, by address; parameters by their short name too."""
        values = {slot.address: said(slot, float(x)) for slot, x in zip(self.source.slots, self.p, strict=False)}
        short = {key.removeprefix("parameters."): v for key, v in values.items() if key.startswith("parameters.")}
        return MappingProxyType(values | short)

    @cached_property
    def constants(self) -> Mapping[str, float]:
        """What is worth printing of each joint with play: "A.c", and as the laws have them "A.K", "A.S" …"""
        found = {f"{joint.name}.c": float(self.p[joint.clearance]) for joint in self.source.clearances}
        for joint in self.source.clearances:
            found |= {f"{joint.name}.{name}": float(self.p[i]) for name, i in joint.constants.items()}
        return MappingProxyType(found)

    def events_of(self, name: str) -> Array:
        """Times at which an event of the file happened, (k,), s. UnknownNameError names the nearest event."""
        names = [event.name for event in self.source.events]
        if text(name, "the name of an event") not in names:
            from gudgeon.language.names import nearest

            guess = nearest(name, names)
            hint = f"did you mean {guess!r}?" if guess else f"its events: {', '.join(names) or 'none'}"
            raise UnknownNameError(f"the scene {self.source.scene!r} has no event named {name!r}", hint=hint)
        times: Array = self.events["t"][self.events["event"] == names.index(name)]
        return times

    def at_events(self, name: str) -> AtEvents:
        """The states at the located times of an event: `run.at_events("top")["S9.ay"]` is (k,); see AtEvents."""
        from gudgeon.results.samples import at_events

        return at_events(self, name)

    def peak(self, name: str) -> Extremes:
        """Largest and smallest value of a series over all steps of this run, with their times (s); SI.

        Of a series that was asked for by `simulate(peaks=["S9.ay"])` or `peaks:` of the scene, and of this run's part
        where it goes on from another one. Raises UnknownNameError, BadValueError.
        """
        from gudgeon.results.peaks import over_all_steps

        return over_all_steps(self, name, False)

    def peak_error(self, name: str) -> Extremes:
        """The same of the series less that of another scene at the same times: `simulate(peaks=…, against=ideal)`."""
        from gudgeon.results.peaks import over_all_steps

        return over_all_steps(self, name, True)

    @cached_property
    def states_at_events(self) -> Result:
        """A result whose samples are the start and then all events, by time."""
        from gudgeon.results.samples import everything

        return everything(self)

    @property
    def final(self) -> State:
        """The last sample as a state to restart from."""
        source, slots = self.source, zip(self.source.slots, self.given, self.is_given, strict=True)
        overridden = {slot.address: said(slot, float(x)) for slot, x, is_given in slots if is_given}
        q, v, state, memory = (array[-1].copy() for array in (self.q, self.v, self.state, self.memory))
        return State(
            source.mechanism,
            source.scene,
            float(self.t[-1]),
            q,
            v,
            state,
            memory,
            MappingProxyType(overridden),
            source.whole_sha256,
            source.overrides,
            source.formulation,
            source.beside,
        )

    def __getstate__(self) -> dict[str, Any]:
        """The fields, and the evaluation if it is at hand; what else is cached is made again in no time."""
        kept = {*(each.name for each in fields(self)), "evaluation", "a", "states_at_events"}
        return {name: value for name, value in self.__dict__.items() if name in kept}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for values in self.stored.values():
            values.flags.writeable = False

    @cached_property
    def a(self) -> Array:
        """q̈, (N, n); NaN where a sample has none."""
        try:
            return self.evaluation.a if self.accelerations is None else self.accelerations
        except SolverError:
            return np.full_like(self.q, np.nan)

    @cached_property
    def evaluation(self) -> Evaluation:
        """Accelerations, multipliers, reactions, torques, forces of joints with play and energies at all samples."""
        if self.compiled is None:
            raise GudgeonError("this result was read from a file that lacks the series; run the scene again")
        return self.compiled.evaluate(evaluation_times_of(self, self.compiled), self.q, self.v, self.memory, self.p)

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
        """The run as a moving picture: x.gif, x.mp4 (where ffmpeg is) or x.html, a page of its own that plays.

        `seconds` it lasts (None: as long as the run, but 6 where that is under 2 or over 20), with `rate` pictures a
        second (each is painted, so a GIF or film of fewer `seconds` or at a lower `rate` is written sooner); `points`
        whose paths are drawn, `velocities` and `forces` as in `plot.mechanism`. Joints with play are magnified beside
        it, red in pictures before which their surfaces met. Of a page, or without a path, what a notebook shows.
        `progress(share, text)` hears of each picture. BadValueError, UnknownNameError; without ffmpeg GudgeonError.
        """
        from gudgeon.results.figures import animation

        wanted = animation.wanted_of(self, seconds, rate, points, velocities, forces, progress)
        return animation.animate(self, path, wanted)

    def report(self) -> RunReport:
        """What joints with play did, where energy went, how far to believe it: `print`, `.to_html()`, `.to_dict()`."""
        from gudgeon.results.reports.run_report import RunReport

        return RunReport(self)

    def check(self, samples: int = 20_000) -> ContactCheck:
        """Check the contacts of this run independently of the code that located them.

        The run is repeated bit for bit with `samples` equal intervals. The penetration of every joint with play is
        computed from positions of the bodies. Returns what is found outside the contacts of `impacts`, by time: a
        ContactCheck, true where nothing is; `str` tells joint, time (s) and depth (m) of each fault, `raise_faults()`
        raises them as a SolverError. Raises BadValueError unless `samples` is a whole number, 2 or more.
        """
        from gudgeon.simulation.examine import check_contacts

        return check_contacts(self, samples)

    def value_of(self, name: str) -> Any:
        """What a name in an output's expression stands for: a parameter (an output may share its name), t, a series."""
        if text(name, "a name of a result") in self.parameters:
            return self.parameters[name]
        if name in self:
            return self[name]
        raise self.unknown(name)

    def to_xarray(self, part: str = "series") -> xarray.Dataset:
        """All series as one Dataset over `time`, with units and long names; `.to_dataframe()` has a row a sample.

        part: "impacts", "events" or "parameters" for these, a row each.
        """
        from gudgeon.results.files import netcdf

        return netcdf.dataset(self, part)

    def to_dataframe(self, names: Iterable[str] | None = None) -> pandas.DataFrame:
        """Series as columns of a table of pandas over t (s): these, or all for None; SI, units in `attrs["units"]`."""
        from gudgeon.results.files import export

        return export.dataframe(self, names)

    def to_csv(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write t and these series, or all, as CSV in SI: a line of names, then every bit of a sample a line."""
        from gudgeon.results.files import export

        export.csv(self, path, names)

    def to_mat(self, path: str | os.PathLike[str], names: Iterable[str] | None = None) -> None:
        """Write t and these series, or all, for MATLAB: "S9.y" as S9_y; cells `variables`, `names` and `units`."""
        from gudgeon.results.files import export

        export.mat(self, path, names)

    def save(self, path: str | os.PathLike[str], attributes: Mapping[str, str] = MappingProxyType({})) -> None:
        """Write everything to a NetCDF file, with more attributes {name: text}, aside first and then moved into place;
        OutputError where that fails, BadValueError for attributes that are none."""
        from gudgeon.results.files import netcdf

        netcdf.save(self, path, attributes)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Result:
        """The result that `save` wrote, bit for bit; it needs no compiled library."""
        return read(path)

    @cached_property
    def _catalogue(self) -> Mapping[str, Series]:
        from gudgeon.results.series import catalogue

        return catalogue(self.source)

    def _series(self, name: str) -> Series:
        try:
            return self._catalogue[name]
        except KeyError:
            raise self.unknown(name) from None

    def unknown(self, name: str) -> UnknownNameError:
        """The error for a name that this result does not have; it names the nearest."""
        from gudgeon.results.series import parameter_names, unknown_series

        return unknown_series(self.source, self._catalogue, name, parameter_names(self.source))


def read(path: str | os.PathLike[str]) -> Result:
    """Read a file that `Result.save` wrote. InputError if it is none."""
    from gudgeon.results.files import netcdf

    return netcdf.read(path)


@dataclass(eq=False)
class Bare(Result):
    """A Result whose series are computed from `parts` of an Evaluation, and no more; it has no diagnostics."""

    parts: frozenset[str] = PARTS

    @cached_property
    def evaluation(self) -> Evaluation:
        """These parts, the others without a row. Raises SingularError."""
        if self.compiled is None:
            raise GudgeonError("there is no library to evaluate samples with")
        times = evaluation_times_of(self, self.compiled)
        return self.compiled.evaluate(times, self.q, self.v, self.memory, self.p, parts=self.parts)


def bare(
    source: KernelSource,
    compiled: CompiledModel | None,
    p: Array,
    t: Array,
    q: Array,
    v: Array,
    work: Array,
    memory: Array,
    state: Array,
    parts: frozenset[str],
) -> Bare:
    """From samples as C stores them; works that no masses tell are NaN."""
    slots = len(source.slots)
    return Bare(
        compiled=compiled,
        source=source,
        p=p,
        given=np.zeros(slots),
        is_given=np.zeros(slots, bool),
        t=t,
        q=q,
        v=v,
        accelerations=None,
        state=state,
        memory=memory,
        work=np.full_like(work, np.nan) if source.massless else work,
        impacts=np.zeros(0, IMPACT_DTYPE),
        diagnostics=cast(Diagnostics, None),
        parts=parts,
    )


def blank(source: KernelSource) -> Bare:
    """No samples at all: it knows names and units."""
    n, joints = len(source.coordinates), len(source.clearances)
    p = np.full(len(source.slots) + len(source.derived), np.nan)
    empty = np.zeros((0, n)), np.zeros((0, n)), np.zeros((0, 3)), np.zeros((0, source.n_memory))
    return bare(source, None, p, np.zeros(0), *empty, np.zeros((0, joints), np.int8), PARTS)
