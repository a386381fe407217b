"""The model's explicit equations in complex NumPy: derivatives by the complex step, exact to rounding.

f is evaluated at y + i h e_k; Im f / h is its derivative, without cancellation for any h. Corners go by the real
parts, as a side that is held. J. N. Lyness, C. B. Moler, SIAM J. Numer. Anal. 4 (1967) 202-210.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp

from gudgeon.generator.equations.contact_steps import EPSILON_MAX
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from tests.equations.models import defaults

STICK = 50.0  # 1/s, the default gain of a stick (baumgarte.stick)

Complex = np.ndarray
STEP = 1e-40


def _greatest(*values: complex) -> complex:
    return max(values, key=lambda z: z.real)


def _least(*values: complex) -> complex:
    return min(values, key=lambda z: z.real)


def _angle(y: complex, x: complex) -> complex:
    turn = (x.real * y.imag - y.real * x.imag) / (x.real**2 + y.real**2)
    return complex(np.arctan2(y.real, x.real), turn)


def _hermite(depths: Sequence[complex], angle: complex) -> list[complex]:
    """A contour and its slope: the polynomial of degree five with central differences at both of its ends."""
    count = len(depths)
    x = angle * count / (2.0 * np.pi)
    k = int(np.floor(x.real))
    a, b, c, d = (depths[(k + shift) % count] for shift in (-1, 0, 1, 2))
    ends = [[(y - x) / 2, x - 2 * m + y] for x, m, y in ((a, b, c), (b, c, d))]
    rows = [
        [np.prod(range(n - order + 1, n + 1)) * s ** max(n - order, 0) * (n >= order) for n in range(6)]
        for s in (0.0, 1.0)
        for order in range(3)
    ]
    power = np.linalg.solve(np.array(rows, float), np.array([b, *ends[0], c, *ends[1]]))
    s = x - k
    slope = sum(n * power[n] * s ** (n - 1) for n in range(1, 6)) * count / (2.0 * np.pi)
    return [complex(sum(power[n] * s**n for n in range(6))), complex(slope)]


_CORNERS: Mapping[type, tuple[str, Callable[..., Any]]] = {
    sp.Max: ("corner_max", _greatest),
    sp.Min: ("corner_min", _least),
    sp.Abs: ("corner_abs", lambda z: z if z.real >= 0 else -z),
    sp.sign: ("corner_sign", lambda z: np.sign(z.real)),
    sp.Heaviside: ("corner_step", lambda z, *_: float(z.real >= 0.0)),
    sp.atan2: ("corner_atan2", _angle),
}


class ComplexStep:
    """f of y' = f(t, y), y = (q, v), of one scene; `values` are slots by address that differ from their defaults.

    `memory` holds δ̇⁻ of each joint with play (NaN: none yet), then the mode of each friction, then internal states of
    laws, as many of each joint.
    """

    def __init__(self, model: Model, values: Mapping[str, float] | None = None) -> None:
        self.model, self.n = model, len(model.q)
        given = {
            model.parameter_table.entries[address].symbol: sp.Float(x, 17) for address, x in (values or {}).items()
        }
        self._numbers = {s: sp.Float(x, 17) for s, x in defaults(model).items()} | given
        rows = (*model.Phi, *model.Phi_q, *model.nu, *model.gamma)
        elements = [element.loads.power for element in model.elements.values()]
        self._rows = self.function(rows)
        self._forces = self.function([*model.masses, *model.g, sp.Add(*elements), *model.baumgarte])
        self._joints = [self.function(self._geometry(c)) for c in model.clearances]
        self._laws: dict[int, Callable[..., Any]] = {}
        self._slips = [
            self.function(
                [
                    *(friction.jacobian.get(q, sp.Integer(0)) for q in model.q),
                    friction.gamma,
                    friction.slip.v,
                    friction.slip.speed,
                    friction.slip.evaluate_kinetic_force(friction.slip.v),
                ]
            )
            for friction in model.frictions
        ]

    def function(self, expressions: Iterable[sp.Expr]) -> Callable[..., Complex]:
        """Expressions in the model's symbols as a function of (t, q, v)."""
        state = [self.model.t, list(self.model.q), list(self.model.v)]
        return self._lambda(state, [self.model.symbols.expand_definitions(sp.sympify(e)) for e in expressions])

    def _lambda(self, arguments: Sequence[Any], expressions: Sequence[sp.Expr]) -> Callable[..., Complex]:
        numbers = [e.xreplace(self._numbers) for e in expressions]
        for corner, (name, _) in _CORNERS.items():
            numbers = [e.replace(corner, sp.Function(name)) for e in numbers]
        modules = [dict(_CORNERS.values()), "numpy"]
        function = sp.lambdify(arguments, numbers, modules, cse=True)
        return lambda *values: np.array(function(*values), dtype=complex)

    @staticmethod
    def _geometry(joint: Clearance) -> tuple[sp.Expr, ...]:
        film = joint.constants.get("film_clearance", joint.pair.c)
        transition = sp.Integer(0) if joint.transition is None else joint.transition
        return (
            *joint.eccentricity,
            *joint.eccentricity_rate,
            joint.first.omega,
            joint.second.omega,
            joint.pair.c,
            joint.pair.R_i,
            joint.pair.R_j,
            film,
            transition,
            joint.first.theta,
            *joint.first.arm,
            *joint.second.arm,
            *(joint.wall.normal if joint.wall else ()),
        )

    def bent(self, memory: Sequence[float] | np.ndarray) -> np.ndarray:
        """Internal states of laws, (joints, states)."""
        joints, each = len(self._joints), self.model.law_states
        return np.asarray(memory[len(memory) - each * joints :], dtype=float).reshape(joints, each)

    def __call__(
        self, t: complex, y: Complex, memory: Sequence[float] | np.ndarray, z: np.ndarray | None = None
    ) -> Complex:
        """(q̇, q̈, powers, rates of internal states z), (2n + 3 + states,); z is that of `memory` unless given."""
        model, n, m = self.model, self.n, len(self.model.rows)
        z = self.bent(memory) if z is None else z
        bending = np.zeros(z.shape, dtype=complex)
        q, v = np.asarray(y[:n], dtype=complex), np.asarray(y[n : 2 * n], dtype=complex)
        rows = self._rows(complex(t), q, v)
        phi, phi_q, rest = rows[:m], rows[m : m + m * n].reshape(m, n), rows[m + m * n :]
        nu, gamma = rest[:m], rest[m:]
        values = self._forces(complex(t), q, v)
        masses, g, power, (alpha, beta) = values[:n], values[n : 2 * n].copy(), values[2 * n], values[2 * n + 1 :]
        powers = np.array([0.0, power, 0.0], dtype=complex)
        for k, (joint, function) in enumerate(zip(model.clearances, self._joints, strict=True)):
            powers[2] += self._pin(joint, function(complex(t), q, v), memory[k], v, g, z[k], bending[k])
        sticks, right = [], [gamma - 2 * alpha * (phi_q @ v - nu) - beta**2 * phi]
        for function, mode in zip(self._slips, memory[len(model.clearances) :], strict=False):  # then internal states
            *row, rate, slip, speed, kinetic = function(complex(t), q, v)
            if mode == 0.0:
                sticks.append((np.array(row), slip + speed))
                right.append(np.array([rate - 2 * STICK * slip]))
            elif abs(mode) == 1.0:
                g -= mode * kinetic * np.array(row)
                powers[1] -= mode * kinetic * (slip + speed)
        all_rows = np.vstack([phi_q, *(row[None] for row, _ in sticks)])
        count = len(all_rows)
        kkt = np.block([[np.diag(masses), all_rows.T], [all_rows, np.zeros((count, count))]])
        x = np.linalg.solve(kkt, np.concatenate([g, *right]))
        powers[0] = -x[n : n + m] @ nu
        powers[1] -= sum(force * speed for force, (_, speed) in zip(x[n + m :], sticks, strict=True))
        return np.concatenate([v, x[:n], powers, bending.ravel()])

    def jacobian(self, t: float, y: np.ndarray, memory: Sequence[float] | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """∂f/∂y by (q, v) and internal states, (2n + 3 + states, 2n + states), and ∂f/∂t."""
        columns, z = [], self.bent(memory)
        for k in range(2 * self.n):
            moved = y.astype(complex)
            moved[k] += 1j * STEP
            columns.append(self(t, moved, memory).imag / STEP)
        for place in np.ndindex(z.shape):
            bent = z.astype(complex)
            bent[place] += 1j * STEP
            columns.append(self(t, y, memory, bent).imag / STEP)
        return np.array(columns).T, self(t + 1j * STEP, y, memory).imag / STEP

    def _pin(
        self, joint: Clearance, geometry: Complex, stored: float, v: Complex, g: Complex, z: Complex, bending: Complex
    ) -> complex:
        """Adds the joint's force to g and fills in the rates of its internal states z; its power."""
        ex, ey, ux, uy, w_i, w_j, c, R_i, R_j, film, e_0, theta, *arms = geometry
        ends = ((joint.first, -1, arms[:2]), (joint.second, 1, arms[2:4]))
        if joint.wall:
            span, speed, normal = (np.array(pair) for pair in ((ex, ey), (ux, uy), arms[4:]))
            total = self._at_wall(joint, span, speed, normal, (w_i, w_j), (R_i, R_j), stored, z, bending)
            return self._acts(ends, total[:2], total[2:], speed, v, g)
        e = np.sqrt(ex**2 + ey**2)
        e = -e if e.real == 0.0 and e.imag < 0.0 else e
        n_x, n_y = (ex / e, ey / e) if e != 0.0 else (1.0, 0.0)
        speeds = (ux * n_x + uy * n_y, uy * n_x - ux * n_y, w_i, w_j)
        worn = [0.0 + 0j, 0.0 + 0j]
        if joint.contour:
            table = [complex(self._numbers[s]) for s in self.model.parameter_table.tables[joint.contour.table]]
            worn = _hermite(table, _angle(ey, ex) - theta)
        delta, total = e - c - worn[0], np.zeros(4, dtype=complex)
        share = 1.0 if joint.film is None else self._share(joint, delta, e_0) if delta.real > 0.0 else 0.0
        if joint.normal is None:
            share = 0.0
        elif delta.real > 0.0:
            dry = self._dry(joint, delta, (R_i, R_j), speeds, stored, z, bending)
            total += share * (self._on_contour(joint, delta, R_j, e, worn[1], speeds, stored) if joint.contour else dry)
        if joint.film is not None and complex(share).real < 1.0:
            total += (1.0 - share) * self._film(joint, joint.film, e, film, speeds)
        force = (total[0] * n_x - total[1] * n_y, total[0] * n_y + total[1] * n_x)
        return self._acts(ends, force, total[2:], (ux, uy), v, g)

    @staticmethod
    def _acts(ends: Any, force: Any, moments: Any, speed: Any, v: Complex, g: Complex) -> complex:
        """Adds force and moments to g; their power."""
        power = force[0] * speed[0] + force[1] * speed[1]
        for (point, sign, arm), moment in zip(ends, moments, strict=True):
            if point.body is not None:
                k = point.body.index
                g[k] += sign * force[0]
                g[k + 1] += sign * force[1]
                g[k + 2] += sign * (arm[0] * force[1] - arm[1] * force[0]) + moment
                power += moment * v[k + 2]
        return complex(power)

    def _share(self, joint: Clearance, delta: complex, e_0: complex) -> complex:
        """Of the dry contact beside a film."""
        if joint.mixed is None:
            return complex(_least(1.0 + 0j, delta / e_0))
        return complex(self._law(joint.mixed, delta)[0])

    def _dry(
        self, joint: Clearance, delta: complex, radii: Any, speeds: Any, stored: float, z: Complex, bending: Complex
    ) -> Complex:
        (R_i, R_j), (v_n, v_t, w_i, w_j) = radii, speeds
        assert joint.normal is not None
        ratio = 1.0 + 0j if np.isnan(stored) else v_n / stored
        if joint.clip_ratio:
            ratio = _greatest(-1.0 + 0j, _least(1.0 + 0j, ratio))
        a_i, a_j = R_i + delta / 2, R_j - delta / 2
        (normal,) = self._law(joint.normal, delta, ratio, *[v_n] * len(joint.normal.optional_variables))
        tangential = 0.0
        if joint.friction is not None:
            own = len(joint.states)
            rubbed = self._law(joint.friction, normal, v_t + w_j * a_j - w_i * a_i, *z[:own])
            tangential, bending[:own] = rubbed[0], rubbed[1:]
        return np.array([-normal, tangential, -a_i * tangential, a_j * tangential])

    def _on_contour(
        self, joint: Clearance, delta: complex, R_j: complex, e: complex, slope: complex, speeds: Any, stored: float
    ) -> Complex:
        """Along e and across it: −F_n by δ's gradient, friction across that at the middle of the penetration."""
        v_n, v_t, w_i, w_j = speeds
        assert joint.normal is not None
        gradient = np.array([1.0, -slope / e])
        steep = np.sqrt(gradient @ gradient)
        rate = gradient @ np.array([v_n, v_t]) + slope * w_i
        normal, tangent = gradient / steep, np.array([slope / e, 1.0]) / steep
        ratio = 1.0 + 0j if np.isnan(stored) else rate / stored
        (force,) = self._law(joint.normal, delta, ratio, *[rate] * len(joint.normal.optional_variables))
        arm_j = (R_j - delta / steep / 2) * normal  # from the journal's centre to where both touch
        arm_i = arm_j + np.array([e, 0.0])
        spin_i, spin_j = (w * np.array([-arm[1], arm[0]]) for w, arm in ((w_i, arm_i), (w_j, arm_j)))
        along = 0.0
        if joint.friction is not None:
            (along,) = self._law(joint.friction, steep * force, (np.array([v_n, v_t]) + spin_j - spin_i) @ tangent)
        total = along * tangent - force * gradient
        moments = (sign * (arm[0] * total[1] - arm[1] * total[0]) for sign, arm in ((-1, arm_i), (1, arm_j)))
        return np.array([*total, *moments])

    def _at_wall(
        self,
        joint: Clearance,
        span: Complex,
        speed: Complex,
        normal: Complex,
        turning: Any,
        radii: Any,
        stored: float,
        z: Complex,
        bending: Complex,
    ) -> Complex:
        """Of a disc on a straight wall: force in ground axes and moments, by the place where both touch."""
        (R_i, R_j), (w_i, w_j), tangent = radii, turning, np.array([-normal[1], normal[0]])
        delta = span @ normal - (R_i - R_j)
        if delta.real <= 0.0:
            return np.zeros(4, dtype=complex)
        arm_j = (R_j - delta / 2) * normal
        arm_i = span + arm_j
        spin_i, spin_j = (w * np.array([-arm[1], arm[0]]) for w, arm in ((w_i, arm_i), (w_j, arm_j)))
        meeting = speed + spin_j - spin_i
        rate = meeting @ normal
        ratio, along = 1.0 + 0j if np.isnan(stored) else rate / stored, 0.0
        assert joint.normal is not None
        (force,) = self._law(joint.normal, delta, ratio, *[rate] * len(joint.normal.optional_variables))
        if joint.friction is not None:
            own = len(joint.states)
            along, *bending[:own] = self._law(joint.friction, force, meeting @ tangent, *z[:own])
        total = along * tangent - force * normal
        moments = (sign * (arm[0] * total[1] - arm[1] * total[0]) for sign, arm in ((-1, arm_i), (1, arm_j)))
        return np.array([*total, *moments])

    def _film(self, joint: Clearance, film: LawEquations, e: complex, c: complex, speeds: Any) -> Complex:
        v_n, v_t, w_i, w_j = speeds
        turning = w_j - w_i if film.options["angular_velocity"] == "relative" else w_i + w_j
        radial, tangential, shear = self._law(
            film, _least(e / c, EPSILON_MAX + 0j), v_n / c, (v_t - turning * e / 2) / c
        )
        if not film.options["shear"]:
            return np.array([radial, tangential, -e * tangential, 0.0])
        drag = shear * (w_j - w_i)
        return np.array([radial, tangential, drag - e * tangential / 2, -drag - e * tangential / 2])

    def _law(self, equations: LawEquations, *state: complex) -> Complex:
        """The law's results at a state of its own variables."""
        if id(equations) not in self._laws:
            known: dict[sp.Symbol, sp.Expr] = {}
            for name, step in equations.equations_by_name.items():
                value = self.model.symbols.expand_definitions(sp.sympify(step)).xreplace(known)
                known[sp.Symbol(name, real=True)] = value
            results = [known[sp.Symbol(name, real=True)] for name in equations.law.results]
            self._laws[id(equations)] = self._lambda(list(equations.variables), results)
        return self._laws[id(equations)](*(complex(x) for x in state))
