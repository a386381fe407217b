"""Define the interface of reference solvers: their right-hand side with Jacobian, and single steps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

import numpy as np

from gudgeon.assembly.linkage import project_state
from gudgeon.contract.boundary import N_WORK
from gudgeon.errors import SolverError
from gudgeon.integrators.peers.contacts import Contacts
from gudgeon.integrators.trajectory import Problem
from gudgeon.model.compiled import Array

SCIPY = ("scipy:DOP853", "scipy:RK45", "scipy:Radau", "scipy:BDF", "scipy:LSODA")


class Equations:
    """Evaluate ẏ = f(t, y) with y = (q, q̇, works), (2n + 3,), for the current contacts, and count the calls."""

    def __init__(self, problem: Problem, contacts: Contacts) -> None:
        self.compiled, self.contacts = problem.compiled, contacts
        self.p = problem.values_of_motion
        self.size = 2 * self.compiled.n + N_WORK
        self.calls = self.jacobians = 0
        self.failure: SolverError | None = None  # error of a call inside the solver, which may swallow it
        self.poll_cancellation = (
            problem.poll_cancellation if problem.method in SCIPY else None
        )  # SUNDIALS is C code, through which no exception passes
        exact = hasattr(self.compiled.lib, "gudgeon_jacobian")
        self.jacobian: Callable[[float, Array], Array] | None = self._jacobian if exact else None  # None: differences

    def compute_rates(self, t: float, y: Array) -> Array:
        """Return ẏ (2n + 3,); NaN where the equations cannot be solved, so that a smaller step is tried.

        Their error is stored in `failure`. The call is counted, and cancellation polled before it. KeyboardInterrupt is
        raised where the solver passes exceptions on.
        """
        self.calls += 1
        if self.poll_cancellation:
            self.poll_cancellation()
        try:
            return self.compiled.rhs(t, y, self.p, self.contacts.discrete_states)
        except SolverError as error:
            self.failure = error
            return np.full(self.size, np.nan)

    def _jacobian(self, t: float, y: Array) -> Array:
        """Return the exact Jacobian ∂ẏ/∂y, and count the call."""
        self.jacobians += 1
        return self.compiled.jacobian(t, y, self.p, self.contacts.discrete_states)[0]

    def project_state(self, t: float, y: Array) -> Array:
        """Return the state projected onto the constraints; the works stay."""
        n = self.compiled.n
        q, v = project_state(self.compiled, t, y[:n], y[n : 2 * n], self.p)
        return np.concatenate([q, v, y[2 * n :]])


class Stepper(ABC):
    """Define one solver. `max_distance`: distance from the constraints, in tolerances, above which it is moved."""

    max_distance = 0.0

    def __init__(self, equations: Equations, t_end: float) -> None:
        self.equations, self.t_end = equations, t_end

    @abstractmethod
    def restart(self, t: float, y: Array, atol: Array) -> None:
        """Begin at (t, y) with absolute tolerances (2n + 3,), which the errors of a step must not exceed."""

    @abstractmethod
    def step(self) -> float:
        """Make one accepted step towards t_end and return the time of its end. Raise SolverError."""

    @abstractmethod
    def interpolate(self, t: float) -> Array:
        """Return the state at t inside the last step, from the method's own interpolant."""

    @abstractmethod
    def set_state(self, t: float, y: Array, atol: Array) -> None:
        """Continue from y, the projected end of the last step."""
