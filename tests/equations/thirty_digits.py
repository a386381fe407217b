"""The model's equations evaluated by mpmath in 30 digits: what the emitted C must give to its last few bits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from tests.equations.models import defaults

DIGITS = 30
EPSILON_MAX = mp.mpf("0.9999")  # eccentricity ratio at which a film is capped


class Reference:
    """Values at one state (t, q, v); `memory` holds δ̇⁻ of each joint with play, NaN where it is open."""

    def __init__(self, model: Model, t: float, q: np.ndarray, v: np.ndarray, memory: Sequence[float] = ()) -> None:
        self.model, self.memory = model, memory
        state = zip((model.t, *model.q, *model.v), (t, *q, *v), strict=True)
        self._numbers = defaults(model) | {s: sp.Rational(*float(x).as_integer_ratio()) for s, x in state}

    def values(self, expressions: Iterable[sp.Expr]) -> list[Any]:
        """Numbers for expressions in the model's symbols, derived ones included."""
        with mp.workdps(DIGITS):
            explicit = [self.model.symbols.expand_definitions(sp.sympify(e)) for e in expressions]
            return [mp.mpmathify(sp.N(e.xreplace(self._numbers), DIGITS + 5)) for e in explicit]

    def vector(self, matrix: sp.Matrix) -> np.ndarray:
        """A matrix of the model, rounded to binary64."""
        return np.array([float(x) for x in self.values(matrix)]).reshape(matrix.shape)

    def accelerations(self) -> tuple[np.ndarray, np.ndarray]:
        """q̈ (n,) and λ (m,) by LU of the dense KKT system."""
        model, n, m = self.model, len(self.model.q), len(self.model.rows)
        with mp.workdps(DIGITS):
            alpha, beta = self.values(model.baumgarte)
            phi_q = mp.matrix(m, n)
            for k, x in enumerate(self.values(model.Phi_q)):
                phi_q[k // n, k % n] = x
            phi, nu, gamma = (self.values(x) for x in (model.Phi, model.nu, model.gamma))
            speed = phi_q * mp.matrix([mp.mpf(x) for x in self.values(model.v)])
            kkt, b = mp.matrix(n + m, n + m), mp.matrix(n + m, 1)
            for k, (mass, force) in enumerate(zip(self.values(model.masses), self._forces(), strict=True)):
                kkt[k, k], b[k] = mass, force
            for r in range(m):
                for k in range(n):
                    kkt[n + r, k] = kkt[k, n + r] = phi_q[r, k]
                b[n + r] = gamma[r] - 2 * alpha * (speed[r] - nu[r]) - beta**2 * phi[r]
            x = mp.lu_solve(kkt, b)
            solution = np.array([float(value) for value in x])
        return solution[:n], solution[n:]

    def _forces(self) -> list[Any]:
        """Weights, and each joint with play on both of its bodies."""
        g = self.values(self.model.g)
        for clearance, stored in zip(self.model.clearances, self.memory, strict=True):
            force, moments = self.wrench(clearance, stored)
            ends = ((clearance.first, -1, moments[0]), (clearance.second, 1, moments[1]))
            for point, sign, moment in ends:
                if point.body is not None:
                    arm, k = self.values(point.arm), point.body.index
                    g[k] += sign * force[0]
                    g[k + 1] += sign * force[1]
                    g[k + 2] += sign * (arm[0] * force[1] - arm[1] * force[0]) + moment
        return g

    def wrench(self, clearance: Clearance, stored: float) -> tuple[list[Any], tuple[Any, Any]]:
        """Force on the journal (ground axes) and moments about bearing centre and journal centre."""
        ex, ey, ux, uy, w_i, w_j, c = self.values(
            (
                *clearance.eccentricity,
                *clearance.eccentricity_rate,
                clearance.first.omega,
                clearance.second.omega,
                clearance.pair.c,
            )
        )
        with mp.workdps(DIGITS):
            e = mp.hypot(ex, ey)
            n = (ex / e, ey / e)
            v_n, v_t = ux * n[0] + uy * n[1], uy * n[0] - ux * n[1]
            share = mp.mpf(1)
            if clearance.film is not None:
                (e_0,) = self.values((clearance.transition,))
                share = max(mp.mpf(0), min(mp.mpf(1), (e - c) / e_0))
            total = [mp.mpf(0)] * 4  # along n, along t, moments on bearing's and journal's body
            for weight, law in ((share, self._dry), (1 - share, self._film)):
                if weight > 0:
                    parts = law(clearance, e, v_n, v_t, w_i, w_j, stored)
                    total = [a + weight * b for a, b in zip(total, parts, strict=True)]
            radial, tangential, first, second = total
            force = [radial * n[0] - tangential * n[1], radial * n[1] + tangential * n[0]]
            return force, (first, second)

    def _dry(self, joint: Clearance, e: Any, v_n: Any, v_t: Any, w_i: Any, w_j: Any, stored: float) -> list[Any]:
        R_i, R_j, c = self.values((joint.pair.R_i, joint.pair.R_j, joint.pair.c))
        delta = e - c
        if delta <= 0:
            return [mp.mpf(0)] * 4
        assert joint.normal is not None
        ratio = mp.mpf(1) if np.isnan(stored) else v_n / mp.mpf(stored)
        a_i, a_j = R_i + delta / 2, R_j - delta / 2
        (normal,) = self._law(joint.normal, (delta, ratio))
        tangential = mp.mpf(0)
        if joint.friction is not None:
            (tangential,) = self._law(joint.friction, (normal, v_t + w_j * a_j - w_i * a_i))
        return [-normal, tangential, -a_i * tangential, a_j * tangential]

    def _film(self, joint: Clearance, e: Any, v_n: Any, v_t: Any, w_i: Any, w_j: Any, stored: float) -> list[Any]:
        (c,) = self.values((joint.constants["film_clearance"],))
        assert joint.film is not None
        state = (min(e / c, EPSILON_MAX), v_n / c, (v_t - (w_i + w_j) * e / 2) / c)
        radial, tangential, _ = self._law(joint.film, state)
        return [radial, tangential, -e * tangential, mp.mpf(0)]

    def _law(self, equations: LawEquations, state: Sequence[Any]) -> list[Any]:
        """The law's results at a state of its own variables."""
        known = dict(zip(equations.variables, (sp.Float(x, DIGITS + 5) for x in state), strict=True))
        for name, step in equations.equations_by_name.items():
            value = self.model.symbols.expand_definitions(sp.sympify(step)).xreplace(known | self._numbers)
            known[sp.Symbol(name, real=True)] = sp.N(value, DIGITS + 5)
        results: tuple[str, ...] = ("F_n",) if equations.law.role == "normal" else ("F_t",)
        results = ("F_r", "F_t", "T0") if equations.law.role == "film" else results
        return [mp.mpmathify(known[sp.Symbol(name, real=True)]) for name in results]
