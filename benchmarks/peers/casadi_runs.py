"""Integrate pendulums of several links and Andrews' squeezer by CasADi: expressions and its interface to CVODES.

The expressions are those that heyoka and jitcode get: multipliers eliminated (index 1). CasADi writes C, compiles it
with -O3 and calls CVODES with Adams' methods and functional iteration, which suits the smooth problems. For 64 links,
CasADi's virtual machine evaluates the expressions: a compilation with -O1 takes 23 s for each tolerance, and the run is
then twice as fast. The control is the relative tolerance. A whole call passes the state to the integrator and reads the
angles.
"""

from __future__ import annotations

from contextlib import chdir
from functools import cache
from importlib import import_module
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from benchmarks.peers import andrews
from benchmarks.peers import chain_equations as chain
from benchmarks.peers.timing import CallTimer, Measured

NAME = "casadi"
ATOL = 1e-2  # of rtol
OPTIONS = {"linear_multistep_method": "adams", "nonlinear_solver_iteration": "functional", "max_num_steps": 10**6}
COMPILED = {
    "jit": True,
    "jit_cleanup": False,
    "compiler": "shell",
    "jit_options": {"flags": ["-O3", "-march=native", "-w"], "compiler": "cc", "cleanup": False, "verbose": False},
}


def integrator(state: Any, rates: list[Any], t_end: float, rtol: float, compiled: bool) -> Any:
    """Return the integrator, compiled or evaluated by CasADi's virtual machine."""
    casadi = import_module(NAME)
    problem = {"x": state, "ode": casadi.vertcat(*rates)}
    options = {**OPTIONS, **(COMPILED if compiled else {}), "reltol": rtol, "abstol": ATOL * rtol}
    with TemporaryDirectory() as folder, chdir(folder):  # CasADi leaves its C and the library where it runs
        return casadi.integrator("F", "cvodes", problem, 0.0, t_end, options)


def timed(function: Any, start: np.ndarray, timer: CallTimer) -> np.ndarray:
    """Return the state at the end."""
    with timer.engine:
        found = function(x0=start)
    return np.array(found["xf"]).ravel()


@cache
def chain_integrator(n: int, rtol: float) -> Any:
    """Return the integrator of a pendulum of n links."""
    casadi = import_module(NAME)
    y = casadi.SX.sym("y", 2 * n)
    theta, omega = [y[k] for k in range(n)], [y[n + k] for k in range(n)]
    rates = [*omega, *chain.equations(theta, omega, casadi.sin, casadi.cos)]
    return integrator(y, rates, chain.T_END[n], rtol, n < chain.RECURSIVE)


def run_chain(n: int, rtol: float) -> Measured:
    """Integrate a pendulum of n links."""
    function, start = chain_integrator(n, rtol), chain.starts(n)[:, 0]
    timer = CallTimer()
    angles = timed(function, start, timer)[:n]
    return timer.measured(lambda: chain.error(n, angles))


@cache
def andrews_integrator(rtol: float) -> Any:
    """Return the integrator of Andrews' squeezer."""
    casadi = import_module(NAME)
    y = casadi.SX.sym("y", 14)
    q, v = [y[k] for k in range(7)], [y[7 + k] for k in range(7)]
    found = andrews.parts(casadi, _keep, q, v)
    return integrator(y, [*v, *andrews.eliminate(_keep, found)], andrews.T_END, rtol, True)


def _keep(value: Any) -> Any:
    """Return the value: expressions are graphs with common subexpressions."""
    return value


def run_andrews(rtol: float) -> Measured:
    """Integrate Andrews' squeezer."""
    function, start = andrews_integrator(rtol), andrews.start()
    timer = CallTimer()
    y = timed(function, start, timer)
    return timer.measured(lambda: andrews.error(y))
