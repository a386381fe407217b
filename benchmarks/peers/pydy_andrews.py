"""Integrate Andrews' squeezer by SciPy's DOP853 with a right-hand side that PyDy generates.

PyDy takes M(x) u̇ = F(x, u), writes both as C with common subexpressions, and solves with LAPACK at every call from
Python. The multipliers are additional speeds: [M Gᵀ; G 0] [v̇; μ̇] = [f; −Ġ q̇], so μ̇ = λ. PyDy's own KanesMethod
derives a similar, longer system for a closed linkage.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.peers import andrews
from benchmarks.peers.timing import CallTimer, Measured

ATOL = 1e-2  # of rtol
FREE = 1e30  # absolute tolerance of μ, which is not needed


@cache
def compiled() -> Any:
    """Return ẏ = f(y, t) of 7 coordinates and 13 speeds, as PyDy generates it with Cython."""
    sp = import_module("sympy")
    generator = import_module("pydy.codegen.ode_function_generators").CythonODEFunctionGenerator
    q, v, m = (list(sp.symbols(f"{name}0:{n}", real=True)) for name, n in (("q", 7), ("v", 7), ("m", 6)))
    found = andrews.parts(sp, lambda x: x, q, v)
    mass = sp.zeros(13, 13)
    mass[2, 2] = found.m33
    for (i, j), (a, b, d) in found.blocks:
        mass[i, i], mass[i, j], mass[j, i], mass[j, j] = a, b, b, d
    G = sp.Matrix(found.G)
    mass[7:, :7], mass[:7, 7:] = G, G.T
    torque = sp.Symbol("torque", real=True)  # one constant has to be there
    force = sp.Matrix([found.f[0] - andrews.TORQUE + torque, *found.f[1:], *(-x for x in found.curve)])
    speeds = [*v, *m]
    built = generator(
        force,
        [*q, *_dummy_coordinates()],
        speeds,
        [torque],
        mass_matrix=mass,
        coordinate_derivatives=sp.Matrix([*v, *[0] * 6]),
        constants_arg_type="array",
    )
    return built.generate()


def _dummy_coordinates() -> list[Any]:
    """Return six dummy coordinates, since PyDy needs as many coordinates as speeds."""
    return list(import_module("sympy").symbols("z0:6", real=True))


def start() -> np.ndarray:
    """Return y: q, six dummy coordinates, v, μ."""
    y = andrews.start()
    return np.array([*y[:7], *[0.0] * 6, *y[7:], *[0.0] * 6])


def run(rtol: float) -> Measured:
    """Integrate; return error and cost."""
    from scipy.integrate import solve_ivp

    f, y0 = compiled(), start()
    free = np.ones(26, dtype=bool)
    free[:7] = free[13:20] = False
    atol = np.where(free, FREE, ATOL * rtol)
    torque = np.array([andrews.TORQUE])
    timer = CallTimer()
    with timer.engine:
        s = solve_ivp(  # PyDy returns the same array each time, and solve_ivp stores it: hence the copy
            lambda t, y: f(y, t, torque).copy(),
            (0.0, andrews.T_END),
            y0,
            t_eval=[andrews.T_END],
            method="DOP853",
            rtol=rtol,
            atol=atol,
        )
    return timer.measured(lambda: andrews.error(s.y[:7, -1]), int(s.nfev))


def seconds_per_rhs(batch: int = 500, repeats: int = 7) -> float:
    """Return the smallest time of a call from Python (s), with LAPACK's solve."""
    f, y, torque, best = compiled(), start(), np.array([andrews.TORQUE]), float("inf")
    for _ in range(repeats):
        begin = perf_counter()
        for _ in range(batch):
            f(y, 0.0, torque)
        best = min(best, (perf_counter() - begin) / batch)
    return best
