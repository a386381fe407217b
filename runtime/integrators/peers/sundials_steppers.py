"""Run CVODE of SUNDIALS step by step through scikit-sundae (A. C. Hindmarsh et al., ACM TOMS 31 (2005) 363-396).

`cvode`: BDF, orders 1 to 5, Newton with the exact Jacobian; `cvode_adams`: Adams–Moulton, orders 1 to 12.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators.peers.stepper import Equations, Stepper
from gudgeon.model.compiled import Array

METHODS = {"cvode": "BDF", "cvode_adams": "Adams"}
INSTALL = "make peers in a clone, else pip install scikit-sundae"
MIN_RTOL = 1e-15  # rtol (times |y|); gudgeon's tolerances are absolute


class CvodeStepper(Stepper):
    """Run the method `name` of CVODE: cvode or cvode_adams."""

    max_distance = 10.0  # tolerances; moving a multistep method restarts it

    def __init__(self, equations: Equations, t_end: float, name: str) -> None:
        super().__init__(equations, t_end)
        self.kind = METHODS[name]
        self.cvode = _import_cvode()
        self.solver: Any = None
        self.t, self.y = math.nan, np.zeros(0)

    def restart(self, t: float, y: Array, atol: Array) -> None:
        """Restart the solver at (t, y) with absolute tolerances `atol`.

        CVODE controls the root mean square over all components. The tolerances are divided accordingly, so that no
        component exceeds its own.
        """
        options: dict[str, Any] = {"method": self.kind, "rtol": MIN_RTOL, "atol": atol / math.sqrt(len(y))}
        if self.equations.jacobian is not None:
            options["jacfn"] = self._jacobian
        self.solver = self.cvode(self._compute_rates, max_num_steps=10**6, **options)
        self.solver.init_step(t, y.copy())
        self.t, self.y = t, y.copy()

    def _compute_rates(self, t: float, y: Array, out: Array) -> None:
        """Write ẏ into `out`, as CVODE calls it."""
        out[:] = self.equations.compute_rates(t, y)

    def _jacobian(self, t: float, y: Array, rates: Array, out: Array) -> None:
        """Write the Jacobian into `out`, as CVODE calls it."""
        assert self.equations.jacobian is not None
        out[:] = self.equations.jacobian(t, y)

    def step(self) -> float:
        """Make one internal step of CVODE and return its end (s). Raise SolverError if time does not advance.

        After an interpolation, CVODE first returns the old end; then it is called again.
        """
        self.equations.failure = None
        before = self.t
        for _ in range(2):
            solution = self._call_solver(self.t_end, "onestep")
            if self.t > before:
                return self.t
        raise SolverError(f"CVODE made no step at t = {before:.9g} s: {solution.message}", before)

    def interpolate(self, t: float) -> Array:
        """Return the state (2n + 3,) at t (s) inside the last step, from CVODE's polynomial; at its end a copy of
        the state.
        """
        if t == self.t:
            return self.y.copy()
        end, y = self.t, self.y
        solution = self._call_solver(t, "normal")
        self.t, self.y = end, y
        return np.array(solution.y, dtype=np.float64).reshape(-1)

    def set_state(self, t: float, y: Array, atol: Array) -> None:
        """Restart at the projected end of the last step."""
        self.restart(t, y, atol)

    def _call_solver(self, t: float, mode: str) -> Any:
        """Call CVODE once towards t (s) in the mode `mode` ("onestep" or "normal"), store time and state, and return
        its result.

        Raises SolverError, or the error of the right-hand side, if it fails.
        """
        solution = self.solver.step(t, method=mode, tstop=self.t_end)
        if not solution.success:
            raise self.equations.failure or SolverError(
                f"CVODE stopped at t = {self.t:.9g} s: {solution.message}", self.t
            )
        self.t, self.y = float(np.ravel(solution.t)[-1]), np.array(solution.y, dtype=np.float64).reshape(-1)
        return solution


def _import_cvode() -> Any:
    """Return the class CVODE of scikit-sundae. Raise GudgeonError if it is not installed."""
    try:
        from sksundae.cvode import CVODE
    except ModuleNotFoundError as error:
        raise GudgeonError(f"methods sundials:… need scikit-sundae\n  {INSTALL}") from error
    return CVODE
