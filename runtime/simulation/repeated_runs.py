"""Define the calls of a Simulation for loops: `prepare` for optimizers and samplers, `stepper` for controllers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, cast

from numpy.typing import ArrayLike

if TYPE_CHECKING:
    from gudgeon.simulation.prepared_run import PreparedRun
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.simulation.stepper import Stepper


class RepeatedRuns:
    """Base class of Simulation with its calls for loops."""

    def prepare(
        self,
        parameters: str | Iterable[str] = (),
        series: str | Iterable[str] = (),
        t_end: float | str | None = None,
        *,
        output: int | ArrayLike | None = None,
        method: str = "auto",
        rtol: float | str | None = None,
        step: float | str | None = None,
        peaks: Iterable[str] | None = None,
        stop: bool = True,
        fixed: Mapping[str, float | str] | None = None,
        audit: bool | str = True,
        threads: int | None = None,
    ) -> PreparedRun:
        """Return a prepared run: a function from an array of parameter values to an array of series, without names.

        `prepared(x)`: x (n_parameters,) in SI, in the order of `parameters` (addresses or parameter names), returns
        (n_series, n_samples) in the order of `series`; x (n_runs, n_parameters) returns (n_runs, n_series, n_samples).
        The values are bit for bit those of `simulate` and `simulate_many`; see PreparedRun for errors and threads.

        `fixed`: further parameters {address or name: value} of all runs, choices too. `threads`: of calls with several
        runs, None for the cores. `peaks`: series whose extremes over all steps each call stores as
        `prepared.extremes`, (n_peaks, 2) or (n_runs, n_peaks, 2), smallest and largest; such runs take as long as
        `simulate`. Other arguments are those of `simulate`; `t_end` may be an expression of the parameters. The steps
        of a run are audited, as in `simulate_many`; notes, warnings and checks of samples are those of `simulate`.
        Raises InputError for the arguments.
        """
        from gudgeon.simulation.prepared_run import PreparedRun

        arguments = {
            "parameters": parameters,
            "series": series,
            "t_end": t_end,
            "output": output,
            "method": method,
            "rtol": rtol,
            "step": step,
            "peaks": peaks,
            "stop": stop,
            "fixed": fixed,
            "audit": audit,
            "threads": threads,
        }
        return PreparedRun(cast("Simulation", self), arguments)

    def stepper(
        self,
        inputs: str | Iterable[str] = (),
        series: str | Iterable[str] = (),
        *,
        method: str = "auto",
        rtol: float | str | None = None,
        step: float | str | None = None,
        stop: bool = True,
        fixed: Mapping[str, float | str] | None = None,
        audit: bool | str = True,
    ) -> Stepper:
        """Return a stepper: a run in steps of a controller, with inputs that are held over each step.

        `stepper.reset(x)` begins at the scene's start and `stepper.step(dt, x)` integrates over dt (s); both return
        the series (n_series,) in the order of `series`. x (n_inputs,) are the values in SI of the parameters `inputs`
        (addresses or parameter names). The motion is bit for bit that of `simulate(start=run.final, parameters={…})`
        from step to step. `fixed`: further parameters {address or name: value}. Other arguments are those of
        `simulate`. Raises InputError for the arguments.
        """
        from gudgeon.simulation.stepper import Stepper

        arguments = {
            "inputs": inputs,
            "series": series,
            "method": method,
            "rtol": rtol,
            "step": step,
            "stop": stop,
            "fixed": fixed,
            "audit": audit,
        }
        return Stepper(cast("Simulation", self), arguments)
