"""Integrate Andrews' squeezer, a test problem with seven angles, by jitcode and SciPy to t = 0.03 s.

M q̈ + Gᵀ λ = f, G q̈ = −Ġ q̇ (index 1), y = (q, q̇), 14 numbers. Source: E. Hairer, G. Wanner, Solving Ordinary
Differential Equations II, section VI.9; data by W. Schiehlen (ed.), Multibody Systems Handbook, 1990.
M consists of blocks (β, Θ), γ, (Φ, δ), (Ω, ε); λ is eliminated by S = G M⁻¹ Gᵀ (6 × 6) and its Cholesky factors,
all symbolic, so that jitcode compiles straight-line C. Error: the largest relative error of an angle at t = .03.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from benchmarks.peers.timing import CallTimer, Measured

T_END = 0.03
ANSWERS = Path(__file__).resolve().parents[2] / "tests" / "data" / "reference_problems.json"
START = (
    -0.0617138900142764496358948458001,
    0.0,
    0.455279819163070380255912382449,
    0.222668390165885884674473185609,
    0.487364979543842550225598953530,
    -0.222668390165885884674473185609,
    1.23054744454982119249735015568,
)
M1, M2, M3, M4, M5, M6, M7 = 0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498
I1, I2, I3, I4, I5, I6, I7 = 2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
XA, YA, XB, YB, XC, YC = -0.06934, -0.00227, -0.03635, 0.03273, 0.014, 0.072
D, DA, E, EA, RR, RA = 0.028, 0.0115, 0.02, 0.01421, 0.007, 0.00092
SS, SA, SB, SC, SD = 0.035, 0.01874, 0.01043, 0.018, 0.02
ZT, TA, TB, U, UA, UB, ZF, FA = 0.04, 0.02308, 0.00916, 0.04, 0.01228, 0.00449, 0.02, 0.01421
C0, L0, TORQUE = 4530.0, 0.07785, 0.033

ATOL = 1e-2  # of rtol


def start() -> np.ndarray:
    """Return y (14,) at rest."""
    return np.array([*START, *[0.0] * 7])


def error(y: ArrayLike) -> float:
    """Return the largest relative error of an angle at T_END, against 25 digits."""
    exact = np.array(json.loads(ANSWERS.read_text())["andrews_squeezer"]["angles"])
    return float(np.abs(np.asarray(y)[:7] / exact - 1.0).max())


class Steps:
    """Named intermediate results in order, in the form of jitcode's `helpers`."""

    def __init__(self) -> None:
        """Create an empty list."""
        self.all: list[tuple[Any, Any]] = []

    def __call__(self, expression: Any) -> Any:
        """Return a name for an expression, or the expression if it is a number or symbol."""
        symengine = import_module("symengine")
        expression = symengine.sympify(expression)
        if expression.is_Number or expression.is_Symbol:
            return expression
        name = symengine.Symbol(f"h{len(self.all)}")
        self.all.append((name, expression))
        return name


@dataclass(frozen=True)
class Parts:
    """Terms of M q̈ + Gᵀ λ = f, G q̈ = −curve: 2 × 2 blocks of M as ((i, j), (a, b, d)), M[2][2], G (6 × 7), f, Ġ q̇."""

    blocks: list[tuple[tuple[int, int], tuple[Any, Any, Any]]]
    m33: float
    G: list[list[Any]]
    f: list[Any]
    curve: list[Any]


def parts(algebra: Any, step: Callable[[Any], Any], q: list[Any], v: list[Any], torque: float = TORQUE) -> Parts:
    """Return the terms of the equations, with functions of `algebra` (SymEngine, SymPy, NumPy ...); `step` may name
    intermediate results.
    """
    cos, sin, sqrt = algebra.cos, algebra.sin, algebra.sqrt
    be, th, ga, ph, de, om, ep = q
    vb, vt, vg, vp, vd, vo, ve = v
    angle = {"b": be, "bt": be + th, "g": ga, "d": de, "pd": ph + de, "e": ep, "oe": om + ep}
    c, s = ({k: step(f(a)) for k, a in angle.items()} for f in (cos, sin))
    cth, sth, cph, sph, com, som = (step(f(a)) for a in (th, ph, om) for f in (cos, sin))
    e1, z1 = E - EA, ZF - FA
    m11 = step(M1 * RA**2 + M2 * (RR**2 + DA**2) + I1 + I2 - 2 * M2 * DA * RR * cth)
    m12 = step(M2 * DA**2 + I2 - M2 * DA * RR * cth)
    m45 = step(M4 * e1**2 + I4 + M4 * ZT * e1 * sph)
    m55 = step(M4 * (ZT**2 + e1**2) + M5 * (TA**2 + TB**2) + I4 + I5 + 2 * M4 * ZT * e1 * sph)
    m67 = step(M6 * z1**2 + I6 - M6 * U * z1 * som)
    m77 = step(M6 * (z1**2 + U**2) + M7 * (UA**2 + UB**2) + I6 + I7 - 2 * M6 * U * z1 * som)
    blocks = [
        ((0, 1), (m11, m12, M2 * DA**2 + I2)),
        ((3, 4), (M4 * e1**2 + I4, m45, m55)),
        ((5, 6), (M6 * z1**2 + I6, m67, m77)),
    ]
    xd, yd = step(SD * c["g"] + SC * s["g"] + XB), step(SD * s["g"] - SC * c["g"] + YB)
    length = step(sqrt((xd - XC) ** 2 + (yd - YC) ** 2))
    pull = step(-C0 * (length - L0) / length)
    f = [
        torque - M2 * DA * RR * vt * (vt + 2 * vb) * sth,
        M2 * DA * RR * vb**2 * sth,
        pull * ((xd - XC) * (SC * c["g"] - SD * s["g"]) + (yd - YC) * (SD * c["g"] + SC * s["g"])),
        M4 * ZT * e1 * vd**2 * cph,
        -M4 * ZT * e1 * vp * (vp + 2 * vd) * cph,
        -M6 * U * z1 * ve**2 * com,
        M6 * U * z1 * vo * (vo + 2 * ve) * com,
    ]
    crank = [-RR * s["b"] + D * s["bt"], RR * c["b"] - D * c["bt"]]  # d(F − d …)/dβ
    rod = [D * s["bt"], -D * c["bt"]]
    w, wp, wo = step((vb + vt) ** 2), step((vp + vd) ** 2), step((vo + ve) ** 2)
    bias = [step(-RR * c["b"] * vb**2 + D * c["bt"] * w), step(-RR * s["b"] * vb**2 + D * s["bt"] * w)]
    G = [[0] * 7 for _ in range(6)]
    for row in range(6):
        G[row][0], G[row][1] = step(crank[row % 2]), step(rod[row % 2])
    G[0][2], G[1][2] = step(-SS * c["g"]), step(-SS * s["g"])
    G[2][3], G[3][3] = step(-E * c["pd"]), step(-E * s["pd"])
    G[2][4], G[3][4] = step(ZT * s["d"] - E * c["pd"]), step(-ZT * c["d"] - E * s["pd"])
    G[4][5], G[5][5] = step(ZF * s["oe"]), step(-ZF * c["oe"])
    G[4][6], G[5][6] = step(-U * c["e"] + ZF * s["oe"]), step(-U * s["e"] - ZF * c["oe"])
    curve = [  # Ġ q̇
        bias[0] + SS * s["g"] * vg**2,
        bias[1] - SS * c["g"] * vg**2,
        bias[0] + ZT * c["d"] * vd**2 + E * s["pd"] * wp,
        bias[1] + ZT * s["d"] * vd**2 - E * c["pd"] * wp,
        bias[0] + U * s["e"] * ve**2 + ZF * c["oe"] * wo,
        bias[1] - U * c["e"] * ve**2 + ZF * s["oe"] * wo,
    ]
    return Parts(blocks, M3 * (SA**2 + SB**2) + I3, G, [step(x) for x in f], curve)


@cache
def equations() -> tuple[list[Any], list[tuple[Any, Any]]]:
    """Return (ẏ, helpers) for jitcode."""
    y, step = import_module("jitcode").y, Steps()
    q, v = [y(i) for i in range(7)], [y(i) for i in range(7, 14)]
    found = parts(import_module("symengine"), step, q, v)
    return [*v, *eliminate(step, found)], step.all


def eliminate(step: Callable[[Any], Any], found: Parts) -> list[Any]:
    """Return q̈ after elimination of λ: S λ = G M⁻¹ f + Ġ q̇ with S = G M⁻¹ Gᵀ = L D Lᵀ."""
    G, inverse = found.G, []
    for (i, j), (a, b, d) in found.blocks:
        r = step(1 / (a * d - b * b))
        inverse.append((i, j, step(d * r), step(-b * r), step(a * r)))

    def solve_mass(x: list[Any]) -> list[Any]:
        """Return M⁻¹ x."""
        out = [x[2] / found.m33 if k == 2 else 0 for k in range(7)]
        for i, j, a, b, d in inverse:
            out[i], out[j] = a * x[i] + b * x[j], b * x[i] + d * x[j]
        return [step(o) for o in out]

    W, free, n = [solve_mass(row) for row in G], solve_mass(found.f), range(6)
    x = [step(sum(G[i][k] * free[k] for k in range(7)) + found.curve[i]) for i in n]
    S = [[step(sum(G[i][k] * W[j][k] for k in range(7))) if j <= i else 0 for j in n] for i in n]
    for k in n:
        r = step(1 / S[k][k])
        for i in range(k + 1, 6):
            factor = step(S[i][k] * r)
            for j in range(k + 1, i + 1):
                S[i][j] = step(S[i][j] - factor * S[j][k])
            x[i] = step(x[i] - factor * x[k])
            S[k][i] = factor  # Lᵀ in the upper triangle
        S[k][k] = r
    for k in reversed(n):
        x[k] = step(x[k] * S[k][k] - sum(S[k][i] * x[i] for i in range(k + 1, 6)))
    return [free[k] - sum(W[i][k] * x[i] for i in n) for k in range(7)]


@cache
def compiled() -> Any:
    """Return jitcode's object with compiled C; the extras are imported by name, so that type checks do not need
    them."""
    expressions, helpers = equations()
    ode = import_module("jitcode").jitcode(expressions, helpers=helpers, verbose=False)
    ode.compile_C(extra_compile_args=["-O3", "-march=native", "-w"])
    return ode


def seconds_per_rhs(batch: int = 5000, repeats: int = 7) -> float:
    """Return the smallest time of a call from Python (s): jitcode's C with its array handling."""
    f, state = compiled().f, start()
    best = float("inf")
    for _ in range(repeats):
        begin = perf_counter()
        for _ in range(batch):
            f(0.0, state)
        best = min(best, (perf_counter() - begin) / batch)
    return best


def by_jitcode(rtol: float) -> Measured:
    """Integrate by jitcode's "dop853", SciPy's compiled code, which does not report its right-hand sides."""
    ode = compiled()
    timer = CallTimer()
    ode.set_integrator("dop853", rtol=rtol, atol=ATOL * rtol, nsteps=10**6)
    ode.set_initial_value(start(), 0.0)
    with timer.engine:
        y = ode.integrate(T_END)
    return timer.measured(lambda: error(y))


def by_scipy(rtol: float, method: str = "DOP853") -> Measured:
    """Integrate by solve_ivp on jitcode's compiled right-hand side."""
    from scipy.integrate import solve_ivp

    f = compiled().f
    timer = CallTimer()
    with timer.engine:
        s = solve_ivp(f, (0.0, T_END), start(), method=method, rtol=rtol, atol=ATOL * rtol, t_eval=[T_END])
    return timer.measured(lambda: error(s.y[:, -1]), int(s.nfev))


def by_lsoda(rtol: float) -> Measured:
    """Integrate by LSODA on jitcode's compiled right-hand side."""
    return by_scipy(rtol, "LSODA")
