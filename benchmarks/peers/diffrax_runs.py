"""Integrate pendulums of several links and Andrews' squeezer by diffrax: JAX on the CPU, 64 bits, Dopri8.

The expressions are those that heyoka and jitcode get: multipliers eliminated (index 1). XLA compiles the whole
integration once for each problem; the tolerance is an argument of the compiled function. The control is the relative
tolerance. A whole call passes the state to the function, waits for its result and converts the result to NumPy.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import andrews
from benchmarks.peers import chain_equations as chain
from benchmarks.peers.timing import CallTimer, Measured

NAME = "diffrax"
ATOL = 1e-2  # of rtol
MAX_STEPS = 10**5


def solver(rate: Callable[[Any, Any], Any], t_end: float) -> Any:
    """Return the compiled function (state, rtol) → state at the end, number of steps; `rate`: (jnp, y) → y'."""
    jax, diffrax = import_module("jax"), import_module(NAME)
    jax.config.update("jax_enable_x64", True)
    jnp = import_module("jax.numpy")
    term = diffrax.ODETerm(lambda _t, y, _args: rate(jnp, y))

    def solve(y0: Any, rtol: Any) -> Any:
        """Return state and number of steps."""
        found = diffrax.diffeqsolve(
            term,
            diffrax.Dopri8(scan_kind="lax"),
            0.0,
            t_end,
            None,
            y0,
            saveat=diffrax.SaveAt(t1=True),
            stepsize_controller=diffrax.PIDController(rtol=rtol, atol=ATOL * rtol),
            max_steps=MAX_STEPS,
            adjoint=diffrax.ForwardMode(),
        )
        return found.ys[-1], found.stats["num_steps"]

    return jax.jit(solve)


def timed(function: Any, start: np.ndarray, rtol: float, timer: CallTimer) -> np.ndarray:
    """Return the state at the end."""
    with timer.engine:
        y, _ = function(start, rtol)
        y.block_until_ready()
    return np.asarray(y)


@cache
def chain_solver(n: int) -> Any:
    """Return the compiled solver of a pendulum of n links."""

    def rate(jnp: Any, y: Any) -> Any:
        """Return y'."""
        return jnp.stack([*y[n:], *chain.equations(y[:n], y[n:], jnp.sin, jnp.cos)])

    def scanned(jnp: Any, y: Any) -> Any:
        """Return y' by loops over the links: XLA did not compile 64 links as one expression within 250 s."""
        scan = import_module("jax").lax.scan
        zeros, links = (jnp.zeros(()),) * 5, (y[:n], y[n:])
        _, links = scan(
            lambda carried, x: chain.go_inward(carried, x[0], x[1], jnp.sin, jnp.cos), zeros, links, reverse=True
        )
        _, found = scan(chain.go_outward, zeros[:2], links)
        return jnp.concatenate([y[n:], found])

    return solver(scanned if n >= chain.RECURSIVE else rate, chain.T_END[n])


def run_chain(n: int, rtol: float) -> Measured:
    """Integrate a pendulum of n links."""
    function, start = chain_solver(n), chain.starts(n)[:, 0]
    timer = CallTimer()
    angles = timed(function, start, rtol, timer)[:n]
    return timer.measured(lambda: chain.error(n, angles))


@cache
def andrews_solver() -> Any:
    """Return the compiled solver of Andrews' squeezer."""

    def rate(jnp: Any, y: Any) -> Any:
        """Return y'."""
        found = andrews.parts(jnp, lambda value: value, [*y[:7]], [*y[7:]])
        return jnp.stack([*y[7:], *andrews.eliminate(lambda value: value, found)])

    return solver(rate, andrews.T_END)


def run_andrews(rtol: float) -> Measured:
    """Integrate Andrews' squeezer."""
    function, start = andrews_solver(), andrews.start()
    timer = CallTimer()
    y = timed(function, start, rtol, timer)
    return timer.measured(lambda: andrews.error(y))
