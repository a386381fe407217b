"""Define Simulation, a loaded scene: evaluate its equations and integrate its motion."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from gudgeon.assembly.guess_warnings import warn_guess_deviations
from gudgeon.assembly.journals import describe_contacts_with_assumed_approach_speed
from gudgeon.assembly.rank import check_redundant_equations
from gudgeon.assembly.start import Start, assemble_start
from gudgeon.errors import BadValueError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.integrators.trajectory import Problem, Progress
from gudgeon.language.argument_checks import check_callable
from gudgeon.loading.kernel_sources import Loading, read_unchanged_file
from gudgeon.model.baumgarte import has_baumgarte_terms
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import read_contours
from gudgeon.model.evaluation import check_sample_memory
from gudgeon.model.parameters import compute_cached_run_values, compute_parameter_values
from gudgeon.results.notebook_display import NotebookDisplay
from gudgeon.simulation.arguments import (
    MAX_STEPS,
    check_run_settings,
    compute_output_times,
    evaluate_end_time,
    evaluate_step,
    find_required_variant,
    integrate_run,
    select_method,
)
from gudgeon.simulation.file_start import assemble_file_start
from gudgeon.simulation.hidden_jumps import build_jump_error, compute_end_before_jump, find_first_jumps
from gudgeon.simulation.repeated_runs import RepeatedRuns
from gudgeon.simulation.restart import (
    build_violation_notes,
    check_resumed_state,
    copy_checked_state,
    merge_parameters,
    read_file_parameters,
)
from gudgeon.simulation.result_builder import build_result, check_result, mark_result_if_interrupted
from gudgeon.simulation.step_observers import StepObserver, check_compared_scene, check_requested_peaks, make_observer
from gudgeon.waiting.ctrl_c import DelayedCtrlC
from gudgeon.waiting.imports import GENERATOR, import_modules_in_thread

if TYPE_CHECKING:
    from gudgeon.generator.equations.model import Model
    from gudgeon.model.parameter_sets import ParameterSets
    from gudgeon.results.batch import Batch
    from gudgeon.results.lyapunov import Lyapunov
    from gudgeon.results.results import Result, State
    from gudgeon.results.wear import SlidingRequest


class Simulation(NotebookDisplay, RepeatedRuns):
    """Evaluate and simulate a loaded scene; `gudgeon.load` returns it.

    It holds no state, so that several threads may run it at once. It can be pickled: another process loads its library
    from the cache.
    """

    def __init__(
        self,
        compiled: CompiledModel,
        file: Path | str,
        *,
        overrides: Mapping[str, Any] | None = None,
        loading: Loading | None = None,
        quick: bool = False,
    ) -> None:
        self.compiled, self.source, self.file = compiled, compiled.source, Path(file)
        self._quick = quick  # whether variants may start with an unoptimized library
        self.loading = loading  # where the kernels came from, and how long it took
        self._overrides = dict(overrides or {})
        self._model: Model | None = None
        self._variants: dict[str, Simulation] = {}

    def __repr__(self) -> str:
        """Return a short description: mechanism, scene, number of bodies, and the joints with play if there are any."""
        joints, scene_name = (
            ", ".join(x.name for x in self.source.clearances),
            f"{self.source.mechanism}/{self.source.scene}",
        )
        return f"<Simulation {scene_name}: {self.compiled.n // 3} bodies{f', play in {joints}' if joints else ''}>"

    @property
    def model(self) -> Model:
        """Return the scene's equations in SymPy, derived from the file at the first use and cached.

        Raises InputError if the file, a table or a law changed after loading.
        """
        if self._model is None:
            import_modules_in_thread(*GENERATOR)
            from gudgeon.generator.pipeline import derive_scene

            data = read_unchanged_file(self.source, self.file)
            self._model = derive_scene(data, str(self.file), self.source.scene, self._overrides)
        return self._model

    @property
    def full(self) -> Simulation:
        """Return the same scene in the full formulation (absolute coordinates), with the Jacobian of its state
        equation.

        Return the simulation itself if it is loaded so. Otherwise the variant is derived from the file at the first use
        and cached. Raises InputError if the file was edited after loading.
        """
        return self if self.source.formulation == "full" else self._load_variant("full")

    def of_method(
        self,
        method: str,
        progress: Progress | None = None,
        rtol: float | str | None = None,
        has_step: bool = False,
    ) -> Simulation:
        """Return the variant of the scene that an integration method needs; the simulation itself if it fits.

        Cross-checks ("scipy:…", "sundials:…") need the full formulation, `taylor` the series, `radau5` and `radau9` the
        stages. `auto` needs the series at some tolerances `rtol`, unless a step is given (`has_step`). A variant is
        derived at its first use and cached: for `auto` from the text that was loaded, else from the file. Before the
        full one, `progress` is called once. Raises BadValueError where the motion is not smooth, InputError as `full`.
        `progress` None: nothing is reported.
        """
        if method in python_driver.NAMES:
            if progress and "full" not in {*self._variants, self.source.formulation}:
                progress(0.0, "deriving the full formulation")
            return self.full
        formulation = find_required_variant(self.source, method, rtol, has_step)
        text = self.compiled.text if method == "auto" else ""
        return self._load_variant(formulation, text) if formulation else self

    def _load_variant(self, formulation: str, text: str = "") -> Simulation:
        """Return the scene loaded in another formulation or variant, with the same overrides; each is loaded once and
        cached.

        `text`: of the mechanism's file; "" reads the file, and raises InputError if it, a table or a law changed after
        loading.
        """
        from gudgeon.simulation.from_file import load_bytes

        if formulation not in self._variants:
            self._variants[formulation] = load_bytes(
                text.encode() if text else read_unchanged_file(self.source, self.file),
                self.file,
                self.source.scene,
                formulation=formulation,
                overrides=self._overrides,
                portable=self.compiled.portable,
                quick=self._quick,
            )
        return self._variants[formulation]

    def to_html(self) -> str:
        """Return the text of the scene's HTML page: the running mechanism, and below it the equations."""
        from gudgeon.web.page import build_page

        return build_page(self)

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes for pickling, without the derived model and the variants."""
        return self.__dict__ | {"_model": None, "_variants": {}}

    @property
    def p(self) -> Array:
        """Return all parameter values with the file's defaults: run-time parameters, then derived ones; a copy."""
        return self._defaults.copy()

    @cached_property
    def _defaults(self) -> Array:
        """Return the parameter values with the file's defaults, run-time ones and derived ones; computed once and
        cached.
        """
        return compute_parameter_values(self.compiled, {})[0]

    def rhs(self, t: float, y: ArrayLike, memory: ArrayLike | None = None) -> Array:
        """Return ẏ = (q̇, q̈), (2n,), at y = (q, q̇), with the file's defaults; see CompiledModel.rhs."""
        return self.compiled.rhs(t, y, self._defaults, memory)[: 2 * self.compiled.n]

    def jacobian(self, t: float, y: ArrayLike, memory: ArrayLike | None = None) -> Array:
        """Return the exact Jacobian ∂ẏ/∂y, (2n, 2n), of `rhs` at y = (q, q̇), with the file's defaults; SI.

        Rows and columns are (q, q̇), positions in m, angles in rad, time in s. Contacts, branches of min, max, abs and
        sign, and modes of friction are those at y. `memory`: discrete states as in CompiledModel.rhs; None: all
        contacts are open. Raises SingularError where constraint equations depend on each other, ValueError for
        kinematic scenes. In the reduced formulation, the full one is loaded at the first call.
        """
        full = self.full
        return full.compiled.jacobian(t, y, full._defaults, memory)[0][: 2 * full.compiled.n, : 2 * full.compiled.n]

    def phi(self, t: float, q: ArrayLike) -> Array:
        """Return the residuals Φ(q, t) of the constraint equations, (m,)."""
        return self.compiled.phi(t, q, self._defaults)

    def phi_q(self, t: float, q: ArrayLike) -> Array:
        """Return the constraint Jacobian Φ_q, (m, n)."""
        return self.compiled.phi_q(t, q, self._defaults)

    def nu(self, t: float, q: ArrayLike) -> Array:
        """Return the right-hand side ν = −Φ_t of the velocity constraints, (m,)."""
        return self.compiled.nu(t, q, self._defaults)

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike) -> Array:
        """Return the right-hand side γ of the acceleration constraints, (m,)."""
        return self.compiled.gamma(t, q, v, self._defaults)

    def mass(self) -> Array:
        """Return the diagonal of the mass matrix M, (n,)."""
        return self.compiled.mass(self._defaults)

    def start(self, parameters: Mapping[str, float | str] | None = None) -> Start:
        """Return the assembled start at t = 0 with the given parameters, else the file's.

        Raise AssemblyError if it does not close. None: no parameters are given.
        """
        return assemble_start(self.compiled, compute_parameter_values(self.compiled, parameters)[0])

    def simulate(
        self,
        t_end: float | str | None = None,
        *,
        output: int | ArrayLike | None = None,
        method: str = "auto",
        rtol: float | str | None = None,
        step: float | str | None = None,
        parameters: Mapping[str, float | str] | None = None,
        start: State | None = None,
        progress: Progress | None = None,
        horizon: bool = False,
        stop: bool = True,
        peaks: Iterable[str | SlidingRequest] | None = None,
        against: Simulation | None = None,
        contour: Mapping[str, ArrayLike] | None = None,
        audit: bool | str = True,
    ) -> Result:
        """Integrate the scene from t = 0, or from the state `start`, to `t_end` (s), and return the Result.

        `output`: number of equal intervals between samples, or times (s) of all samples, the last of which is t_end:
        an array of any layout and real type, a list or a column. Texts are expressions with units: '5 ms'.
        `method`:
        - "auto": "kinematic" for zero degrees of freedom; "rk4" if a `step` is given; else "adaptive": "dop853" while
          accuracy limits the steps, a stiff method while stability does (integrators/adaptive.py);
        - "rk4": fixed `step` (s), except for a shorter last one; samples are interpolated;
        - "dop853", "dopri5": explicit, of order 8 and 5; "rodas5p", "radau5", "radau9": stiff, of order 5, 5 and 9.
          `rtol` (1e-8) is the error of a step relative to the size of the mechanism or, with play, to the clearance.
          With `step`, the steps are fixed and their errors are not controlled;
        - "taylor": Taylor series for smooth motion, of an order that follows from `rtol`; efficient at small `rtol`;
        - "scipy:DOP853", "sundials:cvode" and others: reference solvers for comparison (integrators/peers).
        `parameters`: {address or name of a parameter: SI value or text with a unit, '0.5 mm'}. With `start`, its
        parameters are the defaults, and the notes of the run report values that differ. A state of another mechanism,
        scene, file or set of overrides is an error.
        `progress`: called with the completed fraction and a text. `stop`: False only records events that end runs.
        `horizon`: compute the predictability horizon with three further runs (predictability_horizon.py).
        `peaks`: series whose extremes over all steps are computed for `run.peak("S9.ay")`; None: those of the file's
        scene. `against`: another scene; `run.peak_error("S9.y")` is the largest difference to it with equal values.
        `contour`: {joint: depths (m) beyond the circle of its bearing}, for joints with a `contour` in the file; as
        many equal angles as there, from the x axis of the bearing's body.
        `audit`: True checks the result on a sample of the steps, "full" on every step, False not at all
        (docs/audit.md).

        Ctrl-C ends the run; the Result contains the samples up to then. Raises InputError for arguments (ArrayError for
        arrays), AssemblyError if the start does not close, SolverError if the equations cannot be solved (`partial` is
        the Result up to there), AuditError if a check fails, MemoryError if the samples do not fit in memory.
        """
        progress = check_callable(progress, "progress")
        settings = check_run_settings(self.source, method, rtol, step is not None, horizon, stop, audit)
        if settings.needs_variant:
            return self.of_method(method, progress, rtol, step is not None).simulate(
                t_end,
                output=output,
                method=method,
                rtol=rtol,
                step=step,
                parameters=parameters,
                start=start,
                progress=progress,
                horizon=horizon,
                stop=stop,
                peaks=peaks,
                against=against,
                contour=contour,
                audit=audit,
            )
        names, compared_scene = check_requested_peaks(self.source, peaks), check_compared_scene(self.source, against)
        initial_state = None if start is None else copy_checked_state(self.source, start)
        if initial_state is None and contour is None:
            given, is_given, p, remarks = read_file_parameters(self.compiled, parameters)
            given, is_given, (p, p_motion) = given.copy(), is_given.copy(), p.copy()
        else:
            given, is_given, remarks = merge_parameters(
                self.compiled, initial_state, parameters, read_contours(self.source, contour)
            )
            p, p_motion = compute_cached_run_values(self.compiled, given, is_given)
        t0 = 0.0 if initial_state is None else initial_state.t
        times, from_start = compute_output_times(self.source, p, t0, evaluate_end_time(self.source, t_end, p), output)
        check_sample_memory(self.compiled, len(times))
        if self.source.degrees_of_freedom < 0:
            assemble_start(self.compiled, p)  # its error names the joints that contradict each other
            select_method(self.source, method, step is not None)  # raises an error
        h = evaluate_step(self.compiled, step, settings.method, p, float(times[-1] - t0))
        if h < math.inf and (times[-1] - t0) / h > MAX_STEPS:
            raise BadValueError(f"step {h:.3g} s means more than {MAX_STEPS:.0e} steps")
        if initial_state is not None and remarks:
            check_resumed_state(self.compiled, initial_state, p)
        if initial_state is None:
            file_start = assemble_file_start(self.compiled, p)
            warn_guess_deviations(self.source, file_start.guess_deviations)
            q, v, memory = file_start.q.copy(), file_start.v.copy(), file_start.memory.copy()
            remarks += file_start.notes
        else:
            q, v, memory = initial_state.q, initial_state.v, initial_state.memory
            check_redundant_equations(self.compiled, p, t0, q)
            remarks += build_violation_notes(self.compiled, p, t0, q, v)
            remarks += describe_contacts_with_assumed_approach_speed(self.compiled, p, t0, q, v, memory)
        observer = make_observer(
            self.compiled,
            (p if has_baumgarte_terms(self.source, settings.method) else p_motion, given, is_given),
            settings.rtol,
            names,
            compared_scene,
        )
        ctrl_c = DelayedCtrlC()
        problem = Problem(
            self.compiled,
            p,
            times,
            q,
            v,
            memory,
            h,
            progress,
            None if initial_state is None else initial_state.state,
            settings.method,
            settings.rtol,
            None if has_baumgarte_terms(self.source, settings.method) else p_motion,
            settings.stop,
            remarks,
            from_start,
            settings.audit,
            initial_state,
            observer,
            ctrl_c.raise_delayed,
        )
        result = self._integrate_problem(problem, given, is_given, observer, ctrl_c)
        if settings.horizon and not result.diagnostics.interrupted:
            from gudgeon.simulation.predictability_horizon import add_horizon

            result = add_horizon(self, result, progress)
        return result

    def simulate_many(
        self,
        parameters: ParameterSets,
        t_end: float | str | Sequence[float | str] | ArrayLike | None = None,
        *,
        output: int | ArrayLike | Sequence[ArrayLike] | None = None,
        method: str = "auto",
        rtol: float | str | None = None,
        step: float | str | Sequence[float | str] | ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
        stop: bool = True,
        side_by_side: bool = True,
        start: State | Sequence[State] | None = None,
        keep: str | Iterable[str] = "states",
        peaks: Iterable[str | SlidingRequest] | None = None,
        against: Simulation | None = None,
        contour: Mapping[str, ArrayLike] | None = None,
        audit: bool | str = True,
    ) -> Batch:
        """Integrate the scene for many sets of parameters in threads, and return the Batch.

        Arguments without an entry here are those of `simulate`. Each run equals `simulate` with its parameters bit for
        bit. A run that fails, or whose parameters violate a condition of the file, is listed in `failures`; the other
        runs continue. Ctrl-C ends all runs; the Batch contains the samples up to then.
        `parameters`: one mapping for all runs, or columns {address: one value, or (n,) values in an array or a list}; a
        table or a structured array also counts as columns. `threads`: None for the number of cores; results do not
        depend on it.
        `start`: one state for all runs, or one for each run, all at the same time.
        `t_end`, `step`: also sequences with a value for each run; an expression such as "2*pi/omega" is evaluated with
        the parameters of each run. `output`: also an array (n, N), or a sequence with the times of each run. The `t` of
        the batch then has a row for each run. NaN fails only its own run; other values that are not numbers are errors.
        `keep`: "states", or names of series, ["S9.y", "A.F"], which are evaluated at the end of each run. The states
        are then discarded, so that memory is that of the series; an empty list stores none. Impacts, events and peaks
        are always stored. A run fails if one of its series cannot be evaluated.
        `side_by_side`: integrate several runs of a thread in one SIMD vector. The results are the same without; the
        vector code is compiled for batches that gain from it.
        `contour`: as in `simulate`, the same for all runs, or depths (n, angles) with a row for each run.

        Raises InputError for arguments, MemoryError if the samples do not fit in memory.
        """
        from gudgeon.simulation.simulate_many import simulate_many

        return simulate_many(
            self,
            parameters,
            t_end,
            output,
            method,
            rtol,
            step,
            threads,
            progress,
            stop,
            side_by_side,
            start,
            keep,
            peaks,
            against,
            contour,
            audit,
        )

    def lyapunov(
        self,
        t_end: float | str | Result,
        *,
        section: str | float | None = None,
        by: str = "auto",
        skip: float | str = 0.0,
        method: str = "auto",
        rtol: float | str | None = None,
        step: float | str | None = None,
        parameters: Mapping[str, float | str] | None = None,
        start: State | None = None,
        progress: Progress | None = None,
    ) -> Lyapunov:
        """Return the largest Lyapunov exponent (1/s) of the motion up to t_end (s), with its uncertainty; see Lyapunov.

        `t_end`: also a Result of this simulation; the exponent is then that of its motion from the first to the last
        sample, with its parameters.
        `by`: "tangent" integrates the variational equation with the exact Jacobian and a jump at each contact;
        "two_trajectory" a second trajectory whose distance is rescaled at intervals; "auto": "tangent" if it holds for
        all neighbours.
        `section`: an event of the file, or a period (s, '2*pi/omega'), for the exponent per return and the kind of
        motion, `motion` of the result. If no drive and no force depends on t, perturbations along the trajectory are
        then removed. `skip`: duration (s) of the transient that is not evaluated. A tenth of the rest is not evaluated
        either, in which the perturbation turns to the most unstable direction. `method`, `rtol` (1e-12), `step`,
        `parameters`, `start`: as in `simulate`.
        Raises BadValueError for zero degrees of freedom and for arguments; SolverError, AssemblyError as `simulate`.
        """
        from gudgeon.simulation.lyapunov import compute_lyapunov_exponent

        settings = {"method": method, "rtol": rtol, "step": step}
        return compute_lyapunov_exponent(self, t_end, section, by, skip, settings, parameters, start, progress)

    def _integrate_problem(
        self,
        problem: Problem,
        given: Array,
        is_given: Array,
        observer: StepObserver | None,
        ctrl_c: DelayedCtrlC,
    ) -> Result:
        """Integrate a prepared run, build and check its Result, and return it.

        `given`, `is_given`: values and mask of the run-time parameters. `observer`: step observer whose findings are
        stored in the diagnostics, or None. `ctrl_c`: the delayed Ctrl-C that the problem polls. A drive that jumps ends
        the run before the jump, with an error. Ctrl-C ends the run, which is marked as interrupted. Raises SolverError
        with the Result up to there as `partial`.
        """
        t0 = float(problem.t[0])
        jump = find_first_jumps(self.source, problem.p[None], t0, [float(problem.t[-1])]).get(0)
        if jump:
            problem = replace(problem, t=problem.t[problem.t < compute_end_before_jump(jump, t0)])
        with ctrl_c:
            trajectory = integrate_run(problem)
            result = build_result(problem, trajectory, given, is_given)
            if observer:
                observer.build_observation().store_in(result)
            result, stopped = check_result(problem, trajectory, result)
            if jump and not trajectory.interrupted and not trajectory.t[-1] < problem.t[-1]:  # it reached the jump
                stopped = stopped or build_jump_error(self.source, jump)
        result = mark_result_if_interrupted(ctrl_c, result)
        if stopped is not None:
            stopped.partial = result
            raise stopped
        return result
