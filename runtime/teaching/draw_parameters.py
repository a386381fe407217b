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
from gudgeon.model.default_step import evaluate_scene_end_time
from gudgeon.model.parameters import compute_parameter_values, insert_space_before_unit

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

MAX_RELATIVE_CHANGES = (0.15, 0.15, 0.08, 0.03)  # of a parameter, in each attempt
MAX_CHANGED_PARAMETERS = 4
VARIED_FIELDS = ("length", "mass", "inertia")
N_DIGITS = 5  # printed digits of positions, relative to the size of the mechanism
ROUNDING_TOL = 1e-9  # values below this fraction of the largest of their kind are rounding errors


@dataclass(frozen=True)
class ExerciseData:
    """Parameter values and the state of a scene at the time t (s), rounded as an exercise sheet prints them."""

    parameters: dict[str, str]  # those that differ from the file's, by address, with their units
    t: float
    q: Array
    v: Array
    p: Array
    run: Result  # it ends at t, with every digit
    units: Array  # (2n,) value of the last printed digit of q and v

    def estimate_rounding_uncertainty(self, function: Callable[[Array, Array], Array]) -> Array:
        """Return a bound of the change of function(q, v) by the rounding of the printed state, by error propagation.

        Changes by half a unit of the last digit of each entry of q and v are added in magnitude. The result has the
        shape of the function's value.
        """
        state, total = np.concatenate([self.q, self.v]), np.asarray(0.0)
        value, n = function(self.q, self.v), len(self.q)
        for k, unit in enumerate(self.units):
            changed = state.copy()
            changed[k] += 0.5 * unit
            total = total + np.abs(function(changed[:n], changed[n:]) - value)
        return total


def draw_parameters(
    simulation: Simulation, seed: int, time_text: str | None, units: Mapping[str, tuple[str, float]] | None = None
) -> ExerciseData:
    """Draw random parameter values with which the scene assembles and runs, and return them with their run.

    If all attempts fail, the values of the file are used. units: unit of the file and its value in SI by address
    ("rpm", 0.105); other values have SI units. time_text: the time as text, or None for a random one, before an event
    that ends the motion. Raises BadValueError for the time, AssemblyError or SolverError if the values of the file
    fail.
    """
    rng = np.random.default_rng(seed)
    given_time = None if time_text is None else parse_quantity(insert_space_before_unit(time_text), "--at", (0, 0, 1))
    if given_time is not None and not 0.0 <= given_time < np.inf:
        raise BadValueError(f"--at is {given_time:g} s: expected 0 s or more", hint="choose a time of the motion")
    failure: Exception | None = None
    for values, time_fraction in _yield_parameter_changes(simulation.source, rng, units or {}):
        try:
            p = compute_parameter_values(simulation.compiled, values)[0]
            t = (
                given_time
                if given_time is not None
                else float(f"{time_fraction * evaluate_scene_end_time(simulation.source, p):.2g}")
            )
            run = _simulate_until(simulation, values, t)
            if run.t[-1] < t:
                t = _find_time_before_event(run, given_time, time_fraction)
                run = _simulate_until(simulation, values, t)
            return _make_rounded_data(values, t, p, run)
        except (AssemblyError, SolverError, BadValueError) as error:
            failure = error
    assert failure is not None
    raise failure


def _yield_parameter_changes(
    source: KernelSource, rng: np.random.Generator, units: Mapping[str, tuple[str, float]]
) -> Iterator[tuple[dict[str, str], float]]:
    """Yield for each attempt changed values as texts by address, and the sheet's time as a fraction of the duration.

    The changes decrease by MAX_RELATIVE_CHANGES. The last two attempts have the values of the file ({}).
    """
    candidates = [
        parameter
        for parameter in source.parameters
        if not (parameter.follows or parameter.words)
        and parameter.default != 0.0
        and _is_address_varied(parameter.address)
    ]
    for spread in MAX_RELATIVE_CHANGES:
        changed_indices = rng.permutation(len(candidates))[:MAX_CHANGED_PARAMETERS]
        factors = 1.0 + spread * rng.uniform(-1.0, 1.0, len(changed_indices))
        time_fraction = float(rng.uniform(0.15, 0.85))
        changed = [(candidates[k], x) for k, x in zip(changed_indices, factors, strict=True)]
        yield (
            {parameter.address: new for parameter, x in changed if (new := _scale_default_value(parameter, x, units))},
            time_fraction,
        )
    yield {}, float(rng.uniform(0.15, 0.85))
    yield {}, 0.05


def _is_address_varied(address: str) -> bool:
    """Return whether the value at an address may be varied: a parameter, or length, mass or inertia of a body."""
    match address.split("."):
        case ["parameters", _]:
            return True
        case ["bodies", _, field]:
            return field in VARIED_FIELDS
    return False


def _scale_default_value(parameter: RuntimeParameter, factor: float, units: Mapping[str, tuple[str, float]]) -> str:
    """Return the default value times a factor as text, with two digits and its unit; "" if it equals the file's value.

    units: unit and its value in SI by address; others have the unit of the parameter.
    """
    unit, unit_size = units.get(parameter.address, (parameter.unit, 1.0))
    new = float(f"{parameter.default * factor / unit_size:.2g}")
    return "" if math.isclose(new * unit_size, parameter.default, rel_tol=1e-12) else f"{new:g} {unit}".rstrip()


def _simulate_until(simulation: Simulation, values: dict[str, str], t: float) -> Result:
    """Return a run to the time t (s), or to an event that ends it sooner; t = 0 gives a run of 1e-9 s.

    Warnings are suppressed. KeyboardInterrupt is raised after Ctrl-C.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run = simulation.simulate(t or 1e-9, output=1, parameters=values, peaks=(), stop=t > 0.0)
    if run.diagnostics.interrupted:
        raise KeyboardInterrupt
    return run


def _find_time_before_event(run: Result, given_time: float | None, fraction: float) -> float:
    """Return a time (s) before the event that ended the run, at the given `fraction` of its duration.

    Raises BadValueError if the user gave a time (`given_time` is not None): it is after the event.
    """
    end_time, last_event = float(run.t[-1]), run.source.events[run.events["event"][-1]]
    if given_time is None:
        return float(f"{fraction * end_time:.2g}")
    message = f"--at is {given_time:g} s: event {last_event.name} (action: stop) ends the motion at {end_time:.6g} s"
    raise BadValueError(message, hint=f"choose an earlier time, such as {fraction * end_time:.2g} s")


def _make_rounded_data(values: dict[str, str], t: float, p: Array, run: Result) -> ExerciseData:
    """Round positions and velocities at the end of a run to the digits that a sheet prints, and return its data.

    Velocities of rounding size become 0. Raises SolverError if the state is not finite.
    """
    k = -1 if t > 0.0 else 0
    q, v = run.q[k].copy(), run.v[k].copy()
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        raise SolverError(f"no position at {t:g} s", t)
    size = max(float(np.ptp(q.reshape(-1, 3)[:, :2])), 1e-12)
    decimals = N_DIGITS - 1 - int(np.floor(np.log10(size)))
    units = np.zeros((2, len(q)))
    for k in range(len(q)):
        n_decimals = N_DIGITS if k % 3 == 2 else decimals
        q[k], units[0, k] = round(q[k], n_decimals), 10.0**-n_decimals  # with whole turns, which drives and gears count
        rates_of_kind = v[2::3] if k % 3 == 2 else np.delete(v, np.s_[2::3])
        v[k] = 0.0 if abs(v[k]) <= ROUNDING_TOL * np.abs(rates_of_kind).max() else float(f"{v[k]:.{N_DIGITS}g}")
        units[1, k] = 10.0 ** (math.floor(math.log10(abs(v[k]))) + 1 - N_DIGITS) if v[k] else 0.0
    return ExerciseData(values, t, q, v, p, run, units.ravel())
