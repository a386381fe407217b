"""Define `Stepper`: a run in steps of a controller, with parameters that are held over each step.

Each step is the run that `simulate(start=run.final, parameters={…})` makes from the end of the last one. The state
stays in the arrays of a ReusableRun. Scenes that need Python within a run or after it are run by `simulate`.
"""

from __future__ import annotations

import math
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.assembly.journals import check_journal_positions
from gudgeon.assembly.start import assemble_start
from gudgeon.contract.boundary import (
    CHECK_POSITION,
    ENDED,
    INTEGRATE,
    NOT_CONFIRMED,
    NOT_FITTING,
    NOT_VALID,
    RUN_FAILED,
    SERIES_READ,
    SET_PARAMETERS,
)
from gudgeon.errors import BadValueError
from gudgeon.integrators.reusable_run import N_ROWS
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_columns import read_values_in_order
from gudgeon.model.parameters import compute_parameter_values, read_given_parameters
from gudgeon.results.state import State, make_state
from gudgeon.simulation.arguments import MIN_DURATION_S, MIN_ROUNDINGS, compute_output_times, parse_seconds
from gudgeon.simulation.prepared_run import RunSetup
from gudgeon.simulation.restart import (
    MAX_VIOLATION,
    check_resumed_state,
    copy_checked_state,
    merge_parameters,
)
from gudgeon.simulation.sample_reader import SampleReader

if TYPE_CHECKING:
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

FIRST_DURATION = 1e-6  # s: duration of a run of which only the first sample is used


class Stepper:
    """Integrate a scene step by step with inputs that are held over each step; `Simulation.stepper` returns it.

    `reset(inputs)` assembles the start, `step(dt, inputs)` integrates over dt (s); both return the series (n_series,)
    at the time reached, `t`. Inputs are parameter values (n_inputs,) in SI, in the order of `inputs`. An object makes
    one call at a time, and C integrates without the global lock.
    """

    def __init__(self, simulation: Simulation, arguments: dict[str, Any]) -> None:
        self._simulation, self._lock = simulation, Lock()
        names = ("method", "rtol", "step", "stop", "audit")
        setup = self._setup = RunSetup.from_arguments(
            simulation,
            "inputs",
            arguments["inputs"],
            arguments["series"],
            arguments["fixed"],
            {name: arguments[name] for name in names},
        )
        checked = {"inputs": setup.names, "series": setup.series, "fixed": setup.fixed}
        self._compiled, self._arguments = setup.scene.compiled, arguments | checked
        self._step_varies = setup.method == "rk4" and setup.step is None
        self._is_set_in_python = setup.columns.needs_python or self._step_varies
        # for scenes that `simulate` runs: the current state, and the state from which the next run begins
        self._state: State | None = None
        self._start: State | None = None
        self._x, self._t, self.ended, self._is_reset = np.zeros(len(setup.names)), 0.0, False, False
        self._x_key: bytes | None = None  # of the inputs whose parameter values are set; None: none
        self._run = None
        if setup.needs_simulate:
            return
        self._run = setup.make_run(np.array([0.0, 1.0]), np.full(N_ROWS, setup.evaluate_step(0, 1.0)))
        self._run.arrays["started"][0] = 1  # C reads each start from the array
        self._reader = SampleReader(self._run, setup.series, 1)
        self._run.repeated.is_resumed, self._run.repeated.max_violation = True, MAX_VIOLATION
        self._arrays = {name: self._run.arrays[name][0] for name in ("start", "initial_discrete_states", "codes")}
        self._q = self._arrays["start"][: self._compiled.n]

    def __repr__(self) -> str:
        """Return mechanism, scene, number of inputs and series, and the time in one line."""
        source, sizes = self._setup.scene.source, f"{len(self.inputs)} inputs, {len(self.series)} series"
        return f"<Stepper {source.mechanism}/{source.scene}: {sizes}, t = {self._t:g} s>"

    @property
    def inputs(self) -> tuple[str, ...]:
        """Return the names of the inputs in the order of their values."""
        return self._setup.names

    @property
    def series(self) -> tuple[str, ...]:
        """Return the names of the series in the order in which calls return them."""
        return self._setup.series

    @property
    def t(self) -> float:
        """Return the time (s) that was reached."""
        return self._t

    @property
    def final(self) -> State:
        """Return the state that was reached, as the `final` of a run; `reset(start=…)` and `simulate` resume from it.

        Raises BadValueError before the first reset.
        """
        self._check_reset()
        if self._run is None:
            assert self._state
            return self._state
        source, n, x = self._setup.scene.source, self._compiled.n, self._arrays
        given = read_given_parameters(source, self._setup.get_parameters(self._x))
        motion = (
            self._q,
            x["start"][n:],
            x["codes"][: len(source.clearances)],
            x["initial_discrete_states"][: source.n_discrete_states],
        )
        return make_state(source, *given, self._t, *motion)

    def reset(self, inputs: ArrayLike | None = None, *, start: State | None = None) -> Array:
        """Begin at the scene's start with these inputs, or at the state `start`; return the series there, (n_series,).

        `inputs`: as in `step`; may be left out if there are none. A `start` is the `final` of a run or of a stepper of
        this scene; its other parameters must be those of this stepper. Raises InputError for values, AssemblyError for
        a start that does not close.
        """
        x = self._check_inputs(inputs)
        with self._lock:
            self._is_reset, self.ended = False, False
            if self._run is None:
                return self._reset_by_simulate(x, start)
            self._set_inputs(x)
            n, arrays, compiled, p = self._compiled.n, self._arrays, self._compiled, self._setup.columns.p[0]
            if start is None:
                if self._setup.has_journal_positions:
                    check_journal_positions(compiled, p)
                assembled = assemble_start(compiled, p)
                self._q[:], arrays["start"][n:], self._t = assembled.q, assembled.v, 0.0
                arrays["initial_discrete_states"][:], arrays["codes"][:] = np.nan, 0
            else:
                self._set_state(start, x)
            values = self._integrate(self._t, x, INTEGRATE, is_step=False)
            self._x, self._is_reset = x.copy(), True
            return values

    def step(self, dt: float | str, inputs: ArrayLike | None = None) -> Array:
        """Integrate over dt with these inputs and return the series (n_series,) at the end.

        `dt`: s, or a text such as "1 ms". `inputs` (n_inputs,): parameter values in SI that are held over the step;
        None: those of the step before. If an event of the file ends the run, `ended` is true and `t` is the time of the
        event; a further step continues from there. After an error the state is that before the step. Raises
        BadValueError for dt and before the first reset, InputError for values, AssemblyError for inputs that do not fit
        the state, SolverError and AuditError.
        """
        dt = dt if type(dt) is float else parse_seconds("dt", dt)
        if not dt > 0.0:
            raise BadValueError(f"dt is {dt:g} s: expected a positive time")
        with self._lock:
            self._check_reset()
            x, t = self._x if inputs is None else self._check_inputs(inputs), self._t + dt
            if not max(MIN_ROUNDINGS * math.ulp(t), MIN_DURATION_S) < dt < math.inf:  # the next call raises the error
                compute_output_times(self._setup.scene.source, self._setup.columns.p[0], self._t, t, 1)
            if self._run is None:
                return self._step_by_simulate(t, x)
            stage = INTEGRATE
            if x.tobytes() != self._x_key:
                stage, self._x_key = SET_PARAMETERS, None
                if self._is_set_in_python:
                    self._set_inputs(x)
                    stage = CHECK_POSITION
            if self._step_varies:
                self._run.arrays["step"][0] = self._setup.evaluate_step(0, t - self._t)
            values = self._integrate(t, x, stage)
            if x is not self._x:
                self._x = x.copy()
            return values

    def __getstate__(self) -> dict[str, Any]:
        """Return the arguments for pickling, and the state that was reached."""
        state = self.final if self._is_reset else None
        reached = {"x": self._x, "state": state, "start": self._start, "ended": self.ended}
        return {"simulation": self._simulation, "arguments": self._arguments} | reached

    def __setstate__(self, pickled: dict[str, Any]) -> None:
        """Restore the stepper after unpickling: check its arguments again, and set the state that was reached."""
        self.__init__(pickled["simulation"], pickled["arguments"])  # type: ignore[misc]
        state = pickled["state"]
        if state is None:
            return
        self._x, self._t = pickled["x"], state.t
        if self._run is not None:
            self._set_inputs(self._x)
            self._set_state(state, self._x)
        self._state, self._start, self.ended, self._is_reset = state, pickled["start"], pickled["ended"], True

    def _check_inputs(self, inputs: ArrayLike | None) -> Array:
        """Return the inputs as an array (n_inputs,); for None, an empty array. Raises ArrayError."""
        x = read_values_in_order(() if inputs is None else inputs, self._setup.names, "inputs")
        return as_c_array(x, "inputs", (len(self._setup.names),))

    def _check_reset(self) -> None:
        """Raise BadValueError if the stepper has not been reset, or its last reset failed."""
        if not self._is_reset:
            raise BadValueError("the stepper has no state yet", hint="call reset(inputs) first")

    def _set_inputs(self, x: Array) -> None:
        """Compute parameter values and error tolerances for inputs x (n_inputs,) in row 0. Raises InputError."""
        assert self._run
        self._x_key = None
        if not self._run.set_row(x, 0):
            compute_parameter_values(self._compiled, self._setup.get_parameters(x))  # raises the error

    def _set_state(self, start: State, x: Array) -> None:
        """Copy a state into the arrays of the run, as the start of the next step, with inputs x (n_inputs,).

        Raises InputError for an invalid state or other parameter values, AssemblyError if it violates the constraints.
        """
        state, arrays, n = copy_checked_state(self._setup.scene.source, start), self._arrays, self._compiled.n
        p = self._setup.columns.p[0]
        values, is_given, _ = merge_parameters(self._compiled, state, self._setup.get_parameters(x))
        if self._compiled.prepare(values, is_given).tobytes() != p.tobytes():
            others = ", ".join(state.parameters)
            raise BadValueError(
                f"start: its run had other parameter values than this stepper: {others}",
                hint="pass them in fixed or as inputs when the stepper is created",
            )
        check_resumed_state(self._compiled, state, p)
        self._q[:], arrays["start"][n:], self._t = state.q, state.v, state.t
        arrays["initial_discrete_states"][: len(state.memory)], arrays["codes"][: len(state.state)] = (
            state.memory,
            state.state,
        )

    def _integrate(self, t: float, x: Array, stage: int, is_step: bool = True) -> Array:
        """Integrate to t (s) with inputs x, make the end the new state, and return the series there.

        `stage` (RepeatStage): what was done before for these inputs. An event that ends the run sets `ended`. If it is
        not a step, only the series of the start are returned. Raises the error of the run, InputError for inputs that
        are not valid, AssemblyError for those that do not fit the state; the state is then unchanged.
        """
        run = self._run
        assert run
        self._setup.columns.x[...] = x
        run.times.t[0], run.times.t[1], run.arrays["n_requested"][0] = self._t, t, 1 + is_step
        result = run.repeat(0, stage)
        if result == NOT_VALID:
            compute_parameter_values(self._compiled, self._setup.get_parameters(x))  # raises the error
        if result == NOT_FITTING:
            check_resumed_state(self._compiled, self.final, self._setup.columns.p[0])  # raises the error
        self._x_key = x.tobytes()
        if result == RUN_FAILED:
            raise run.build_error(0)
        if not is_step:
            return self._reader.read_row(0, False)[:, 0]
        if result == NOT_CONFIRMED:
            self._simulate(t, x, self.final)  # raises the error
        values = self._reader.read_row(0, result == SERIES_READ)[:, 0]
        self._is_reset = False  # an interrupt in the next lines would leave an inconsistent state
        self._compiled.lib.gudgeon_resume_from_end(run.repeated)
        self.ended = run.arrays["status"].item(0) == ENDED
        self._t = float(run.arrays["t_last"][0]) if self.ended else t
        self._is_reset = True
        return values

    def _simulate(self, t: float, x: Array, start: State | None) -> Result:
        """Return the run to t (s) from a state, or from the scene's start, with inputs x (n_inputs,).

        `start` None: the scene's start. Raises KeyboardInterrupt after Ctrl-C.
        """
        parameters = self._setup.get_parameters(x)
        result = self._setup.scene.simulate(
            t, output=1, parameters=parameters, start=start, peaks=(), **self._setup.settings
        )
        if result.diagnostics.interrupted:
            raise KeyboardInterrupt
        return result

    def _reset_by_simulate(self, x: Array, start: State | None) -> Array:
        """Reset the stepper by a short run of `simulate`; return the series (n_series,) of its first sample.

        `start` None: the scene's start.
        """
        t = 0.0 if start is None else start.t
        result = self._simulate(t + max(FIRST_DURATION, FIRST_DURATION * abs(t)), x, start)
        motion = (array[0] for array in (result.q, result.v, result.state, result.memory))
        self._state = make_state(result.source, result.given, result.is_given, t, *motion)
        # the first step resumes from here: its inputs do not change the start that was assembled
        self._start = self._state if start is None else start
        self._x, self._t, self._is_reset = x.copy(), t, True
        return np.array([result[name][0] for name in self.series])

    def _step_by_simulate(self, t: float, x: Array) -> Array:
        """Make a step to t (s) by `simulate`; return the series (n_series,) of its last sample.

        The end of that run becomes the new state; `ended` is set if an event ended it.
        """
        result = self._simulate(t, x, self._start)
        self._start = self._state = result.final
        self._x, self._t = x.copy(), float(result.t[-1])
        self.ended = self._t < t or self._setup.settings.get("stop", True) and _ends_at_event(result)
        return np.array([result[name][-1] for name in self.series])


def _ends_at_event(result: Result) -> bool:
    """Return whether the last event of the run is at its end and has the action "stop"."""
    if not len(result.events):
        return False
    last = result.events[-1]
    return bool(result.source.events[int(last["event"])].action == "stop" and last["t"] == result.t[-1])
