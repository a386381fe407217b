"""What is run again and again, with which steps, and how two runs are compared."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from gudgeon.compiled import Array
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators.trajectory import Progress
from gudgeon.parameters import prepare
from gudgeon.results import Result
from gudgeon.simulation import Simulation
from gudgeon.start import mechanism_size
from gudgeon.step import scene_end, scene_step

NAN = math.nan
Parameters: TypeAlias = Mapping[str, float | str]  # as in `simulate`
ONSETS = 4  # contacts that a window holds: after more of them dry motion is chaotic
PILOTS = 6  # the first pilot run is 2^-6 of the longest window
SAMPLES = 100  # at least so many in a window
REPEATS, ENOUGH = 7, 0.6  # a timed run is repeated until it took so many seconds


@dataclass(frozen=True)
class Error:
    """Largest difference of two runs over their common samples; NaN: the scene has no such thing."""

    motion: float = NAN  # of a coordinate: lengths by the mechanism's size, angles by 1 rad
    path: float = NAN  # of a journal's centre, by the clearance
    force: float = NAN  # of a joint's force, or of its peak over all steps, by the peak force


@dataclass(frozen=True)
class Attempt:
    """One run: its result, as far as it came, and what stopped it ("" if nothing did)."""

    step: float  # s, that was asked for
    run: Result | None
    failure: str = ""
    failed_at: float = NAN  # s


@dataclass(frozen=True, eq=False)
class Work:
    """A scene with numbers and a window in time. A run with step h is sampled every max(h, spacing)."""

    simulation: Simulation
    t_end: float
    parameters: Parameters = field(default_factory=dict)
    why: str = ""  # this window

    @property
    def spacing(self) -> float:
        """A power of ten, so that steps 1, 2, 5 · 10^k fit into it, or are multiples of it."""
        return 10.0 ** math.floor(math.log10(self.t_end / SAMPLES) + 1e-9)

    def run(self, step: float, progress: Progress | None = None) -> Attempt:
        """Sampled for comparison."""
        stride = max(1, math.floor(step / self.spacing * (1 + 1e-9)))
        count = max(1, math.floor(self.t_end / (stride * self.spacing) * (1 + 1e-9)))
        return self.sampled(step, np.arange(count + 1, dtype=np.float64) * (stride * self.spacing), progress)

    def seconds(self, step: float, output: int = 1, progress: Progress | None = None) -> float:
        """Wall time of the integration (s), the least of several runs that store as little as possible."""
        best, spent = math.inf, 0.0
        for _ in range(REPEATS):
            attempt = self.sampled(step, np.linspace(0.0, self.t_end, output + 1), progress)
            if attempt.run is None or attempt.failure:
                return NAN
            best = min(best, attempt.run.diagnostics.seconds)
            spent += attempt.run.diagnostics.seconds
            if spent > ENOUGH:
                break
        return best

    def sampled(self, step: float, times: Array, progress: Progress | None = None) -> Attempt:
        """Sampled at these times (s)."""
        return attempt(self.simulation, times, step, self.parameters, progress)


def attempt(
    simulation: Simulation, times: Array, step: float, parameters: Parameters, progress: Progress | None = None
) -> Attempt:
    """A run that may fail. Ctrl-C is passed on, unlike in `simulate`: half a comparison is none."""
    try:
        run = simulation.simulate(output=times, step=step, parameters=parameters, progress=progress, stop=False)
    except SolverError as error:
        return Attempt(step, error.partial, str(error).partition("\n")[0], error.time)
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return Attempt(step, run)


def round_numbers(low: float, high: float) -> tuple[float, ...]:
    """1, 2, 5 · 10^k from low to high, both included, ascending."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    every = (float(f"{mantissa}e{k}") for k in range(first, last + 1) for mantissa in (1, 2, 5))
    return tuple(x for x in every if low * (1 - 1e-9) <= x <= high * (1 + 1e-9))


def natural_step(simulation: Simulation, parameters: Parameters | None = None) -> float:
    """The step (s) that a plain run would take: the scene's, or the default."""
    p = prepare(simulation.compiled, parameters or {})[0]
    return scene_step(simulation.compiled, p, scene_end(simulation.source))


def window(simulation: Simulation, longest: float, step: float, parameters: Parameters | None = None) -> Work:
    """The work over the first few contacts, or over `longest` (s) where there are not so many.

    Two runs of a scene with dry contacts differ by any amount once an error has gone through many
    contacts, however small the step: errors mean something only over the first few. The window ends
    half-way between the fourth onset and the next.
    """
    parameters = dict(parameters or {})
    longest = min(longest, scene_end(simulation.source))
    for halvings in range(PILOTS, -1, -1) if simulation.source.clearances else ():
        span = longest / 2**halvings
        pilot = attempt(simulation, np.linspace(0.0, span, 3), step, parameters)
        onsets = np.zeros(0) if pilot.run is None else np.sort(pilot.run.impacts["t_on"])
        if len(onsets) > ONSETS:
            end = float(onsets[ONSETS - 1] + onsets[ONSETS]) / 2
            return Work(simulation, float(f"{end:.2g}"), parameters, f"the first {ONSETS} contacts")
        if pilot.failure:
            break
    return Work(simulation, longest, parameters, "no contact" if simulation.source.clearances else "")


def difference(run: Result, reference: Result) -> Error:
    """`reference` is sampled as often as `run`, or a whole number of times as often."""
    if len(run.t) < 2 or len(reference.t) < 2:
        return Error()
    stride = round((run.t[1] - run.t[0]) / (reference.t[1] - reference.t[0]))
    count = min(len(run.t), (len(reference.t) - 1) // stride + 1)
    ours, theirs = slice(0, count), slice(0, (count - 1) * stride + 1, stride)
    source = run.source
    scale = np.array([1.0 if name.endswith(".theta") else size(reference) for name in source.coordinates])
    joints = [joint.name for joint in source.clearances or source.joints]
    vector = {
        name: _distance([run[f"{name}.F{axis}"][ours] - reference[f"{name}.F{axis}"][theirs] for axis in "xy"])
        for name in joints
    }
    peak = max((float(np.abs(reference[f"{name}.F"]).max()) for name in joints), default=0.0)
    for a, b in zip(run.diagnostics.peaks, reference.diagnostics.peaks, strict=True):
        peak = max(peak, b.F)
        if count == len(run.t) and count * stride == len(reference.t) + stride - 1:  # the same window
            vector[a.joint] = max(vector[a.joint], abs(a.F - b.F))
    paths = [
        _distance([run[f"{j.name}.e{axis}"][ours] - reference[f"{j.name}.e{axis}"][theirs] for axis in "xy"])
        / float(reference.p[j.clearance])
        for j in source.clearances
    ]
    return Error(
        float(np.abs((run.q[ours] - reference.q[theirs]) / scale).max()),
        max(paths, default=NAN),
        max(vector.values()) / peak if vector and peak > 0 else NAN,
    )


def _distance(parts: Iterable[Any]) -> float:
    return float(np.hypot(*parts).max())


def size(run: Result) -> float:
    """The mechanism's size, m: what lengths and residuals are compared with."""
    if run.compiled is None:
        raise GudgeonError("a result that was read from a file cannot be compared: run the scene again")
    return mechanism_size(run.compiled, run.p)
