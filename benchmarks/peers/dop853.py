"""Andrews' squeezer by DOP853 on the same compiled right-hand side: jitcode's (SciPy's compiled one) and solve_ivp's.

Each takes rtol and returns (error, seconds of integration only, right-hand sides; −1 where it does not tell).
"""

from __future__ import annotations

from time import perf_counter

from benchmarks.peers import andrews

ATOL = 1e-2  # of rtol


def jitcode(rtol: float) -> andrews.Measured:
    """jitcode's integrator "dop853"."""
    ode = andrews.compiled()
    ode.set_integrator("dop853", rtol=rtol, atol=ATOL * rtol, nsteps=10**6)
    ode.set_initial_value(andrews.start(), 0.0)
    begin = perf_counter()
    y = ode.integrate(andrews.T_END)
    return andrews.error(y), perf_counter() - begin, -1


def scipy(rtol: float, method: str = "DOP853") -> andrews.Measured:
    """solve_ivp on jitcode's compiled right-hand side."""
    from scipy.integrate import solve_ivp

    f = andrews.compiled().f
    begin = perf_counter()
    s = solve_ivp(
        f, (0.0, andrews.T_END), andrews.start(), method=method, rtol=rtol, atol=ATOL * rtol, t_eval=[andrews.T_END]
    )
    return andrews.error(s.y[:, -1]), perf_counter() - begin, int(s.nfev)


def scipy_lsoda(rtol: float) -> andrews.Measured:
    """The same with LSODA."""
    return scipy(rtol, "LSODA")
