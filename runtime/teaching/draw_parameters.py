"""Draw parameter values for an exercise from a seed: a few of the file's values, slightly changed, and a time."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import AssemblyError, BadValueError, SolverError
from gudgeon.language.quantities import parse_quantity
from gudgeon.model.compiled import Array
from gudgeon.model.default_step import evaluate_scene_end
from gudgeon.model.parameters import insert_space_before_unit, prepare_values

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

SPREADS = (0.15, 0.15, 0.08, 0.03)  # largest relative change of parameters in each attempt
MAX_CHANGED = 4  # number of changed parameters
MEASURES = ("length", "mass", "inertia")
DIGITS = 5  # digits of positions, relative to the size of the mechanism
NOISE = 1e-9  # values below this fraction of the largest of their kind are rounding errors


@dataclass(frozen=True)
class ExerciseData:
    """Hold a scene with changed parameter values at the time t (s), with the data that an exercise sheet prints."""

    parameters: dict[str, str]  # those that differ from the file's, by address, with their units
    t: float
    q: Array
    v: Array
    p: Array
    run: Result  # it ends at t, with every digit
    units: Array  # (2n,) value of the last printed digit of q and v

    def estimate_uncertainty(self, function: Callable[[Array, Array], Array]) -> Array:
        """Return how much function(q, v) may change by the rounding of the printed data, half a unit of each last
        digit.

        The result has the shape of the function's value.
        """
        both, total = np.concatenate([self.q, self.v]), np.asarray(0.0)
        value, n = function(self.q, self.v), len(self.q)
        for k, unit in enumerate(self.units):
            changed = both.copy()
            changed[k] += 0.5 * unit
            total = total + np.abs(function(changed[:n], changed[n:]) - value)
        return total


def draw_parameters(
    simulation: Simulation, seed: int, at: str | None, units: Mapping[str, tuple[str, float]] | None = None
) -> ExerciseData:
    """Draw parameter values from a seed with which the scene assembles and moves, and return them with their run.

    The file's own values are used if no others work. units: unit of the file and its value in SI by address ("rpm",
    0.105); other values have SI units. at: text of the time, or None for a drawn one. The time is before an event that
    ends the motion. Raises BadValueError for `at`, AssemblyError or SolverError if the file's own values fail.
    """
    rng = np.random.default_rng(seed)
    moment = None if at is None else parse_quantity(insert_space_before_unit(at), "--at", (0, 0, 1))
    if moment is not None and not 0.0 <= moment < np.inf:
        raise BadValueError(f"--at is {moment:g} s: the motion starts at 0 s", hint="take a time of the motion")
    failure: Exception | None = None
    for numbers, time_fraction in _yield_attempts(simulation.source, rng, units or {}):
        try:
            p = prepare_values(simulation.compiled, numbers)[0]
            t = (
                moment
                if moment is not None
                else float(f"{time_fraction * evaluate_scene_end(simulation.source, p):.2g}")
            )
            run = _run_until(simulation, numbers, t)
            if run.t[-1] < t:
                t = _find_time_before_event(run, moment, time_fraction)
                run = _run_until(simulation, numbers, t)
            return _round_data(numbers, t, p, run)
        except (AssemblyError, SolverError, BadValueError) as error:
            failure = error
    assert failure is not None
    raise failure


def _yield_attempts(
    source: KernelSource, rng: np.random.Generator, units: Mapping[str, tuple[str, float]]
) -> Iterator[tuple[dict[str, str], float]]:
    """Yield changed values as texts by address, and the fraction of the scene's duration at which the sheet's time is.

    The changes decrease from attempt to attempt. The last two attempts have the file's values ({}).
    """
    candidates = [
        slot
        for slot in source.slots
        if not (slot.follows or slot.words) and slot.default != 0.0 and _is_measure(slot.address)
    ]
    for spread in SPREADS:
        some = rng.permutation(len(candidates))[:MAX_CHANGED]
        factors = 1.0 + spread * rng.uniform(-1.0, 1.0, len(some))
        time_fraction = float(rng.uniform(0.15, 0.85))
        changed = [(candidates[k], x) for k, x in zip(some, factors, strict=True)]
        yield {slot.address: new for slot, x in changed if (new := _change_value(slot, x, units))}, time_fraction
    yield {}, float(rng.uniform(0.15, 0.85))
    yield {}, 0.05


def _is_measure(address: str) -> bool:
    """Return whether an address is that of a parameter, or of a length, mass or inertia of a body, which may be
    varied.
    """
    match address.split("."):
        case ["parameters", _]:
            return True
        case ["bodies", _, field]:
            return field in MEASURES
    return False


def _change_value(slot: RuntimeParameter, factor: float, units: Mapping[str, tuple[str, float]]) -> str:
    """Return the default value times a factor as text, with two digits and its unit; "" if it equals the file's value.

    units: unit and its value in SI by address; others have the unit of the slot.
    """
    unit, unit_size = units.get(slot.address, (slot.unit, 1.0))
    new = float(f"{slot.default * factor / unit_size:.2g}")
    return "" if math.isclose(new * unit_size, slot.default, rel_tol=1e-12) else f"{new:g} {unit}".rstrip()


def _run_until(simulation: Simulation, numbers: dict[str, str], t: float) -> Result:
    """Return a run to the time t (s), or to an event that ends it sooner; t = 0 gives a run of 1e-9 s.

    Warnings are suppressed. KeyboardInterrupt is raised after Ctrl-C.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run = simulation.simulate(t or 1e-9, output=1, parameters=numbers, peaks=(), stop=t > 0.0)
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return run


def _find_time_before_event(run: Result, moment: float | None, fraction: float) -> float:
    """Return a time (s) before the event that ended the run, at the given `fraction` of its duration.

    Raises BadValueError if the user gave the time (`moment`), which is after the event.
    """
    end, last = float(run.t[-1]), run.source.events[run.events["event"][-1]]
    if moment is None:
        return float(f"{fraction * end:.2g}")
    message = f"--at is {moment:g} s: event {last.name} (action: stop) ends the motion at {end:.6g} s"
    raise BadValueError(message, hint=f"take a time before that, such as {fraction * end:.2g} s")


def _round_data(numbers: dict[str, str], t: float, p: Array, run: Result) -> ExerciseData:
    """Round positions and velocities at the end of a run to the digits that a sheet prints, and return its data.

    Velocities of rounding size become 0. Raises SolverError if the state is not finite.
    """
    k = -1 if t > 0.0 else 0
    q, v = run.q[k].copy(), run.v[k].copy()
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        raise SolverError(f"no position at {t:g} s", t)
    size = max(float(np.ptp(q.reshape(-1, 3)[:, :2])), 1e-12)
    decimals = DIGITS - 1 - int(np.floor(np.log10(size)))
    units = np.zeros((2, len(q)))
    for k in range(len(q)):
        places = DIGITS if k % 3 == 2 else decimals
        q[k], units[0, k] = round(q[k], places), 10.0**-places  # with whole turns, which drives and gears count
        alike = v[2::3] if k % 3 == 2 else np.delete(v, np.s_[2::3])
        v[k] = 0.0 if abs(v[k]) <= NOISE * np.abs(alike).max() else float(f"{v[k]:.{DIGITS}g}")
        units[1, k] = 10.0 ** (math.floor(math.log10(abs(v[k]))) + 1 - DIGITS) if v[k] else 0.0
    return ExerciseData(numbers, t, q, v, p, run, units.ravel())
