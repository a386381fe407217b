"""Run SciPy's integrators step by step (P. Virtanen et al., Nature Methods 17 (2020) 261-272; scipy.integrate).

DOP853 (order 8) and RK45 (5) are explicit; Radau (5) and BDF (1 to 5) use the exact Jacobian; LSODA (A. Hindmarsh, L.
Petzold) switches between Adams and BDF.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gudgeon.errors import SolverError
from gudgeon.integrators.peers.stepper import Equations, Stepper
from gudgeon.model.compiled import Array

ONE_STEP = ("DOP853", "RK45", "Radau")
EXPLICIT = ("DOP853", "RK45")
# smallest rtol (times |y|) that SciPy accepts without a warning; gudgeon's tolerances are absolute
MIN_RTOL = 100.0 * np.finfo(float).eps


class ScipyStepper(Stepper):
    """Run a solver class of scipy.integrate, called `name`."""

    def __init__(self, equations: Equations, t_end: float, name: str) -> None:
        super().__init__(equations, t_end)
        from scipy import integrate

        self.name, self.solver_class = name, getattr(integrate, name)
        self.max_distance = 1e-3 if name in ONE_STEP else 10.0  # moving a multistep method restarts it
        self.solver: Any = None
        self.dense: Any = None

    def restart(self, t: float, y: Array, atol: Array) -> None:
        """Restart the solver at (t, y) with absolute tolerances `atol`.

        SciPy controls the root mean square over all components (LSODA the largest). The tolerances are divided
        accordingly, so that no component exceeds its own.
        """
        mean = 1.0 if self.name == "LSODA" else math.sqrt(len(y))
        options = {} if self.name in EXPLICIT else {"jac": self.equations.jacobian}
        tolerances = {"rtol": MIN_RTOL, "atol": atol / mean}
        self.solver = self.solver_class(self.equations.compute_rates, t, y.copy(), self.t_end, **tolerances, **options)

    def step(self) -> float:
        """Make one step and return its end (s). Raise SolverError, with SciPy's message, if no step is small enough.

        An error of the right-hand side is raised in place of it. The dense output of the step is stored as `dense`.
        """
        self.equations.failure = None
        with np.errstate(invalid="ignore", over="ignore"):  # a step far too long is tried, and rejected
            message = self.solver.step()
        if self.solver.status == "failed":
            t = float(self.solver.t)
            raise self.equations.failure or SolverError(f"{self.name} stopped at t = {t:.9g} s: {message}", t)
        self.dense = self.solver.dense_output()
        return float(self.solver.t)

    def interpolate(self, t: float) -> Array:
        """Return the state (2n + 3,) at t (s) inside the last step, by SciPy's interpolant; at its end the exact
        state.
        """
        return np.array(self.solver.y if t == self.solver.t else self.dense(t), dtype=np.float64)

    def set_state(self, t: float, y: Array, atol: Array) -> None:
        """Continue from the projected state y at t (s). A one-step method gets new state and rates; others restart."""
        if self.name not in ONE_STEP:
            self.restart(t, y, atol)
            return
        self.solver.y = y.copy()
        self.solver.f = self.equations.compute_rates(t, y)
