"""Select the methods that `gudgeon bench` measures in a scene, with reasons for those left out.

It also measures the time of one right-hand side, and counts its operations.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from importlib.util import find_spec

import numpy as np

from gudgeon.contract.boundary import N_WORK
from gudgeon.contract.methods import INTEGRATORS, STAGED, STEP_CONTROLLED_METHODS
from gudgeon.errors import BadValueError, SolverError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.integrators.peers.sundials_steppers import INSTALL
from gudgeon.language.argument_checks import check_list
from gudgeon.model.compiled import Array
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import Setting, find_comparison_window, find_default_step

ADAPTIVE = (*STEP_CONTROLLED_METHODS, "auto")
CALLS_PER_BATCH, N_BATCHES = 20_000, 9  # of the right-hand side, to measure its time


def has_adaptive_method(simulation: Simulation) -> bool:
    """Return whether the scene supports any method with step-size control (adaptive steps)."""
    return bool(set(STEP_CONTROLLED_METHODS) & set(simulation.source.methods))


def select_methods(simulation: Simulation, requested: Sequence[str] | None, quick: bool) -> tuple[list[str], list[str]]:
    """Return the methods that are measured in a scene, and a sentence for each cross-check that cannot run here.

    requested: names, or patterns such as "scipy:*"; None means all that the scene supports, with `quick` without the
    cross-checks, which are slow. A requested method with step-size control that the scene does not support is left out
    without a sentence. Raises BadValueError for a name or pattern that no method has, or if no method is left.
    """
    own_methods = (*(name for name in INTEGRATORS if name not in STEP_CONTROLLED_METHODS), *ADAPTIVE)
    all_methods = (*own_methods, *python_driver.NAMES)
    default_methods = own_methods if quick else all_methods
    requested = (
        default_methods if requested is None else check_list(requested, "methods", str, "a list of names of methods")
    )
    selected = [m for m in all_methods if any(fnmatchcase(m, text) for text in requested)]
    for text in requested:
        if not any(fnmatchcase(method, text) for method in all_methods):
            raise BadValueError(
                f"method {text!r}: expected some of {', '.join(all_methods)}, or a pattern such as 'scipy:*'"
            )
    reason = python_driver.explain_unsupported_scene(simulation.source)
    fitting, left_out = [], []
    for method in selected:
        package = method.partition(":")[0]
        source, is_requested = simulation.source, method in STAGED and requested is not default_methods
        supported = (*source.methods, *(STAGED if is_requested and not source.reason_without_jacobian else ()))
        fits = method in supported if method in STEP_CONTROLLED_METHODS else has_adaptive_method(simulation)
        if method in ADAPTIVE and not fits:
            continue
        if method in python_driver.NAMES and reason:
            left_out.append(f"{package}:* left out: {reason}")
        elif method in python_driver.SUNDIALS and find_spec("sksundae") is None:
            left_out.append(f"sundials:* left out: scikit-sundae is not installed ({INSTALL})")
        else:
            fitting.append(method)
    if not fitting:
        reasons = list(dict.fromkeys(left_out)) or [f"scene {simulation.source.scene!r} allows a fixed step only: rk4"]
        raise BadValueError("none of the methods fits", hint="; ".join(reasons))
    return fitting, list(dict.fromkeys(left_out))


@dataclass(frozen=True)
class RhsTime:
    """Time of one call of ẏ = f(t, y), at one state."""

    state: str  # "start", or which joint is in contact
    seconds: float  # minimum over several batches
    operations: int  # additions, multiplications, divisions and function calls in the branches of this state
    t: float
    q: Array  # (n,)
    v: Array


def measure_rhs_time(
    simulation: Simulation, max_window: float, batch: int = CALLS_PER_BATCH, repeats: int = N_BATCHES
) -> list[RhsTime]:
    """Measure the time of one right-hand side at the start, and at the peak force of the first contact if there is one.

    Returns one or two RhsTime in this order; the second if a joint touches within `max_window` (s). Each time is the
    minimum of `repeats` batches of `batch` calls.
    """
    start = simulation.start()
    open_contacts = simulation.compiled.as_discrete_states(None)
    times = [_measure_rhs_at_state(simulation, "start", 0.0, start.q, start.v, open_contacts, batch, repeats)]
    if (run := _run_to_first_contact(simulation, max_window)) is not None:
        closed_joints = [j.name for j, code in zip(simulation.source.clearances, run.state[-1], strict=True) if code]
        state = f"{', '.join(closed_joints)} in contact"
        times.append(
            _measure_rhs_at_state(
                simulation, state, float(run.t[-1]), run.q[-1], run.v[-1], run.memory[-1], batch, repeats, closed_joints
            )
        )
    return times


def count_rhs_operations(simulation: Simulation, closed_joints: list[str] | None = None) -> int:
    """Return the number of operations of one right-hand side: equations of motion, all films, active contact forces.

    closed_joints: names of the joints in contact, whose dry contact forces count; None means none.
    """
    total = 0
    for kernel, count in simulation.source.operations.items():
        names = [j.name for j in simulation.source.clearances if kernel.endswith(f"_{j.name}_force")]
        if kernel == "dynamics" or (names and (kernel.startswith("film_") or names[0] in (closed_joints or []))):
            total += count
    return total


def _run_to_first_contact(simulation: Simulation, max_window: float) -> Result | None:
    """Return a run (rk4, default step) that ends at the peak force of the first contact within `max_window` (s).

    None for a scene without play, without a contact, if a run fails, or if no joint is in contact at its end.
    """
    if not simulation.source.clearances:
        return None
    step = find_default_step(simulation)
    try:
        window = find_comparison_window(simulation, max_window, Setting("rk4", step))
        impacts = simulation.simulate(window.t_end, output=1, method="rk4", step=step, stop=False, peaks=()).impacts
        if not len(impacts):
            return None
        run = simulation.simulate(float(impacts[0]["t_peak"]), output=1, method="rk4", step=step, stop=False, peaks=())
    except SolverError:
        return None
    return run if run.state[-1].any() else None


def _measure_rhs_at_state(
    simulation: Simulation,
    state: str,
    t: float,
    q: Array,
    v: Array,
    discrete_states: Array,
    batch: int,
    repeats: int,
    closed_joints: list[str] | None = None,
) -> RhsTime:
    """Measure the time of one right-hand side at (t, q, v), as the minimum of `repeats` batches of `batch` calls in C.

    state: text that describes the state. q, v: coordinates and velocities. discrete_states: contact states. The works
    are 0. closed_joints: names of the joints in contact, for the number of operations only; None means none.
    """
    model = simulation.compiled
    y, contact_states = np.concatenate([q, v, np.zeros(N_WORK)]), model.as_discrete_states(discrete_states)
    arguments = (batch, t, model.pointer(y), model.pointer(contact_states), model.pointer(simulation.p))
    shortest = np.inf
    for _ in range(repeats):
        before = time.perf_counter()
        model.lib.gudgeon_time_rhs(*arguments)
        shortest = min(shortest, (time.perf_counter() - before) / batch)
    return RhsTime(state, shortest, count_rhs_operations(simulation, closed_joints), t, q.copy(), v.copy())
