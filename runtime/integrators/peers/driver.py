"""Integrate a scene with reference solvers (SciPy, SUNDIALS) on the compiled right-hand side: slow, independent
checks.

- `scipy:DOP853`, `scipy:RK45`, `scipy:Radau`, `scipy:BDF`, `scipy:LSODA` (integrators/peers/scipy_steppers.py)
- `sundials:cvode` (BDF), `sundials:cvode_adams` (integrators/peers/sundials_steppers.py), of the extra `bench`

The loop is the same for all: a step of the solver, events on its dense output, projection onto Φ = 0 and Φ̇ = 0, and a
restart after a contact begins or ends. Tolerances mean the same as in integrators/adaptive.py. Unlike the C methods,
these do not freeze the branches of laws during a step; the error control finds switching points. dry_friction elements
are not supported.
"""

from __future__ import annotations

import math
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import compute_residuals
from gudgeon.contract.boundary import N_WORK
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, NonFiniteError, SolverError
from gudgeon.integrators.adaptive import compute_tolerances
from gudgeon.integrators.peers.contacts import AcceptedStep, Contacts
from gudgeon.integrators.peers.stepper import SCIPY, Equations, Stepper
from gudgeon.integrators.single_run import integrate_problem
from gudgeon.integrators.steps import StepCollector
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory
from gudgeon.model.compiled import Array

SUNDIALS = ("sundials:cvode", "sundials:cvode_adams")
NAMES = SCIPY + SUNDIALS
WORK_TOL = 1e20  # tolerance of the works, which do not act on the motion
MAX_EVENTS_AT_ONE_TIME = 200  # largest number of successive events at one time
MAX_SPEED_GROWTH = 2.0  # growth of the speed after which the solver restarts with new tolerances


def explain_unsupported_scene(source: KernelSource) -> str:
    """Return the reason why the reference solvers cannot integrate a scene; "" if they can."""
    if source.degrees_of_freedom == 0:
        return "the scene has no degrees of freedom to integrate"
    if source.frictions:
        elements = ", ".join(source.frictions)
        return f"dry_friction elements ({elements}) switch between stick and slip in the C methods only"
    if source.rate_jumps:
        jumps = f"a jump of the rate of {', '.join(source.rate_jumps)} needs an impulse"
        return f"{jumps}, which only the adaptive methods in C compute"
    return ""


def integrate_by_reference_solver(problem: Problem) -> Trajectory:
    """Integrate a run with the reference solver that problem.method names, and return its Trajectory.

    Raises BadValueError for a scene that does not fit, for events that would end the run, and for a fixed step.
    """
    if reason := explain_unsupported_scene(problem.compiled.source):
        raise BadValueError(
            f"method {problem.method!r}: {reason}",
            hint="use auto, dop853 or rodas5p, or a smooth_step in place of a ramp",
        )
    stopping = [event.name for event in problem.compiled.source.events if event.action == "stop"]
    if stopping and problem.stop:
        raise BadValueError(
            f"method {problem.method!r}: only the methods in C locate events ({', '.join(stopping)})",
            hint="use auto, dop853, rodas5p or rk4, or simulate(…, stop=False)",
        )
    if math.isfinite(problem.step):
        raise BadValueError(f"method {problem.method!r} controls its step", hint="give rtol, or leave out step")
    return _Driver(problem).integrate()


def _make_stepper(equations: Equations, problem: Problem) -> Stepper:
    """Return the solver that problem.method names: "scipy:…" or "sundials:…".

    Raise GudgeonError if it is not installed.
    """
    package, _, name = problem.method.partition(":")
    t_end = float(problem.t[-1])
    if package == "scipy":
        from gudgeon.integrators.peers.scipy_steppers import ScipyStepper

        return ScipyStepper(equations, t_end, name)
    from gudgeon.integrators.peers.sundials_steppers import CvodeStepper

    return CvodeStepper(equations, t_end, name)


class _Driver:
    """Hold one run by a reference solver: the current state and the samples so far."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.n = problem, problem.compiled.n
        self.contacts = Contacts(problem.compiled, problem.p, problem.memory, problem.state)
        self.equations = Equations(problem, self.contacts)
        self.stepper: Stepper
        self.began = math.nan  # s, time after the packages were imported
        duration = float(problem.t[-1] - problem.t[0])
        self.scale, least = compute_tolerances(problem.compiled, problem.p, problem.rtol)
        self.speed_floor = least / max(duration, 1e-300)
        self.angle = np.array([name.endswith(".theta") for name in problem.compiled.source.coordinates])
        self.t, self.y = float(problem.t[0]), np.concatenate([problem.q, problem.v, np.zeros(N_WORK)])
        self.speed, self.speed_of_tolerances = np.zeros(2), np.zeros(2)
        self.steps = self.n_events_at_one_time = 0
        self.step_collector = StepCollector(problem.compiled, problem.observer)
        self.is_after_change = True  # whether this is the first step, or something changed at the end of the last one
        self.max_residuals = np.zeros(2)  # largest |Φ|, |Φ̇|
        self.times: list[float] = []
        self.samples: list[tuple[NDArray[Any], ...]] = []  # y, a, memory, codes

    def integrate(self) -> Trajectory:
        """Integrate to the end and return the Trajectory; after Ctrl-C or a SolverError, that of the samples reached.

        The start is stored before packages are imported, so that Ctrl-C may interrupt the import. After Ctrl-C the last
        state is stored as a sample too.
        """
        interrupted, stopped = False, None
        self._store_start_sample()
        try:
            self.stepper = _make_stepper(self.equations, self.problem)
            self.began = perf_counter()
            self._restart_solver()
            while len(self.samples) < len(self.problem.t):
                self._advance_step()
                self.problem.poll_cancellation()
        except KeyboardInterrupt:
            interrupted = True
            self._store_last_sample()
        except SolverError as error:
            stopped = error
        return self._build_trajectory(interrupted, stopped)

    def _store_last_sample(self) -> None:
        """Store the current state as the last sample, after Ctrl-C; samples at its time or later are removed."""
        while self.times and self.times[-1] >= self.t:
            self.times.pop()
            self.samples.pop()
        self._store_sample(self.t, self.y)

    def _compute_approach_speeds(self) -> Array:
        """Return the approach speeds δ̇⁻ (n_discrete_states,) of contacts that are closed at the start.

        They come from a run in C to the start, and are not cross-checked.
        """
        start = replace(self.problem, method="rk4", t=self.problem.t[:1], step=1.0, progress=None)
        return np.asarray(integrate_problem(start).memory[0])

    def _store_start_sample(self) -> None:
        """Set the contacts of the start, and store it if it is a sample."""
        self.contacts.close_initial_contacts(self.t, self.y, self._compute_approach_speeds)
        self._update_state()
        self._store_sample_at_current_time()

    def _compute_absolute_tolerances(self) -> Array:
        """Return the absolute tolerances (2n + 3,) for the largest speeds so far.

        The speeds are stored as `speed_of_tolerances`. Works have no tolerance.
        """
        self.speed_of_tolerances = self.speed.copy()
        speed = (self.speed + self.speed_floor)[self.angle.astype(int)]
        return np.concatenate([self.scale[: self.n], self.scale[self.n :] * speed, np.full(N_WORK, WORK_TOL)])

    def _restart_solver(self) -> None:
        """Restart the solver at the current state with new tolerances."""
        self.atol = self._compute_absolute_tolerances()
        self.stepper.restart(self.t, self.y, self.atol)

    def _advance_step(self) -> None:
        """Advance by one step of the solver, or by its part up to the first contact event.

        Samples before its end are stored, steps passed to the observer, and contacts switched. The end is projected
        onto the constraints; after an event the solver is restarted there. Raises SolverError, also for contacts that
        change without end, and NonFiniteError.
        """
        t1 = self.stepper.step()
        step = AcceptedStep(
            self.t, t1, self.stepper.interpolate, lambda t: self.equations.project_state(t, self.stepper.interpolate(t))
        )
        end = self.stepper.interpolate(t1)
        if not np.isfinite(end).all():
            raise self.equations.failure or NonFiniteError(f"the motion is no longer finite at t = {t1:.9g} s", t1)
        event = self._locate_event_and_refine_peaks(step)
        t_new = t1 if event is None else event[0]
        self._store_samples_before(step, t_new)
        self._pass_step_to_observer(step, t_new)
        y = step.evaluate_projected(t_new)
        self.n_events_at_one_time = self.n_events_at_one_time + 1 if t_new - self.t < 1e-9 * (t1 - self.t) else 0
        self.t, self.y = t_new, y
        self.steps += 1
        self._update_state()
        if event is not None:
            if self.n_events_at_one_time > MAX_EVENTS_AT_ONE_TIME:
                raise SolverError(f"contacts change without end near t = {t_new:.9g} s", t_new)
            self.contacts.switch_contacts(t_new, y, event[1])
            self.is_after_change = True
        self._continue_solver(event is not None, end)
        self._store_sample_at_current_time()
        if self.problem.progress:
            t = self.problem.t
            self.problem.progress((t_new - t[0]) / max(t[-1] - t[0], 1e-300), "integrating")

    def _pass_step_to_observer(self, step: AcceptedStep, t_new: float) -> None:
        """Pass the sampled states of this step, up to t_new (s), to the observer, with the contacts that it began with.

        Do nothing without an observer. The first state is included only after a change.
        """
        if self.problem.observer:
            nodes = step.compute_sample_times()
            nodes = nodes if self.is_after_change else nodes[1:]
            times = np.append(nodes[nodes < t_new], t_new)
            states = [step.evaluate_projected(t) for t in times.tolist()]
            self.step_collector.add_states(
                times, np.array(states), self.contacts.discrete_states, self.contacts.codes, self.is_after_change
            )
        self.is_after_change = False

    def _locate_event_and_refine_peaks(self, step: AcceptedStep) -> tuple[float, int] | None:
        """Return time (s) and joint of the first contact event in the step, or None; refine force peaks before it.

        The contact quantities are sampled on the dense output of the step. Without joints with play, nothing is done.
        """
        if not self.contacts.count:
            return None
        t = step.compute_sample_times()
        quantities = self.contacts.evaluate_quantities(t, np.array([step.evaluate(x) for x in t.tolist()]))
        event = self.contacts.find_first_event(step, t, quantities)
        before = t < (math.inf if event is None else event[0])
        if before.any():
            part = type(quantities)(*(array[before] for array in vars(quantities).values()))
            self.contacts.refine_peaks(step, t[before], part)
        return event

    def _update_state(self) -> None:
        """Update the largest speeds and residuals, and the contacts, by an accepted state.

        Raises SolverError if a contact was lost: a joint that counts as open is inside its wall.
        """
        v = np.abs(self.y[self.n : 2 * self.n])
        kinds = [v[~self.angle].max(initial=0.0), v[self.angle].max(initial=0.0)]
        self.speed = np.maximum(self.speed, kinds)
        q, v = self.y[: self.n], self.y[self.n : 2 * self.n]
        self.max_residuals = np.maximum(
            self.max_residuals, compute_residuals(self.problem.compiled, self.t, q, v, self.equations.p)
        )
        lost_joint = self.contacts.update_contacts(self.t, self.y) if self.contacts.count else None
        if lost_joint is not None:
            name = self.problem.compiled.source.clearances[lost_joint].name
            raise SolverError(f"a contact was lost at t = {self.t:.9g} s: {name}, open, is inside its wall", self.t)

    def _continue_solver(self, is_event: bool, solver_state: Array) -> None:
        """Restart the solver after an event or a growth of speed, or move it onto the constraints.

        It is moved if its state at the end of the step, `solver_state`, is further from the projected state than its
        `max_distance`. At the end of the run nothing is done.
        """
        if self.t >= self.problem.t[-1]:
            return
        distance = float((np.abs(self.y - solver_state) / self.atol).max())
        if is_event or (self.speed > MAX_SPEED_GROWTH * (self.speed_of_tolerances + self.speed_floor)).any():
            self._restart_solver()
        elif distance > self.stepper.max_distance:
            self.stepper.set_state(self.t, self.y, self.atol)

    def _store_samples_before(self, step: AcceptedStep, t_new: float) -> None:
        """Store the samples at output times before t_new (s), projected, with the contacts that the step began with."""
        times = self.problem.t
        while len(self.samples) < len(times) and times[len(self.samples)] < t_new:
            self._store_sample(
                float(times[len(self.samples)]), step.evaluate_projected(float(times[len(self.samples)]))
            )

    def _store_sample_at_current_time(self) -> None:
        """Store the current state if the next output time has been reached."""
        if len(self.samples) < len(self.problem.t) and self.problem.t[len(self.samples)] <= self.t:
            self._store_sample(self.t, self.y)

    def _store_sample(self, t: float, y: Array) -> None:
        """Store a sample: state y, accelerations, discrete states and codes at t (s).

        Its right-hand side is evaluated for output and is not counted.
        """
        dy = self.problem.compiled.rhs(t, y, self.equations.p, self.contacts.discrete_states)
        self.times.append(t)
        self.samples.append((y, dy[self.n : 2 * self.n], self.contacts.discrete_states.copy(), self.contacts.codes))

    def _build_trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """Return the samples and counts as a Trajectory; contacts that are still closed are added to the list.

        Waiting steps are passed to the observer. Without samples, the current state becomes one.
        """
        from gudgeon.integrators.trajectory import IMPACT_DTYPE

        contacts, equations, n = self.contacts, self.equations, self.n
        self.step_collector.flush_states()
        if not self.samples:  # the start becomes the only sample
            self.times.append(self.t)
            self.samples.append((self.y, np.full(n, np.nan), contacts.discrete_states.copy(), contacts.codes))
        count = len(self.samples)
        closed_contacts = [
            (k, contacts.open[k][0], math.nan, float(contacts.discrete_states[k]), *contacts.open[k][1:])
            for k in np.flatnonzero(contacts.closed)
        ]
        impacts = np.array([*contacts.impacts, *closed_contacts], dtype=IMPACT_DTYPE)
        y, a, discrete_states, state = (np.array([row[i] for row in self.samples]).reshape(count, -1) for i in range(4))
        ratio = contacts.ratio if contacts.ratio[0] <= contacts.ratio[1] else (math.nan, math.nan)
        counts = Counts(
            self.steps,
            equations.calls,
            contacts.onsets,
            phi_max=self.max_residuals[0],
            phi_dot_max=self.max_residuals[1],
            ratio_min=ratio[0],
            ratio_max=ratio[1],
            ratio_outside=contacts.ratio_outside,
            jacobians=equations.jacobians,
        )
        return Trajectory(
            np.array(self.times),
            y[:, :n].copy(),
            y[:, n : 2 * n].copy(),
            a,
            discrete_states,
            state.astype(np.int8),
            y[:, 2 * n :].copy(),
            impacts[np.argsort(impacts["t_on"], kind="stable")],
            contacts.peaks,
            counts,
            interrupted,
            stopped,
            seconds=perf_counter() - self.began if self.began == self.began else 0.0,
        )
