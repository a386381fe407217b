"""Linearization of the equations of motion at a state, for Newton's method and Jacobians.

With accelerations a and multipliers λ that satisfy, at (t, q, v),
    R1 = M a + Φ_qᵀ λ − g = 0,    R2 = Φ_q a − γ + 2α Φ̇ + β² Φ = 0
and are held constant, this collects the structural non-zeros of R1_q, R1_v, R1_t, R2_t and of V and Q in
    R2_v = 2α Φ_q + V,    R2_q = β² Φ_q + Q
where Φ_q itself is taken out. Friction that may stick is an equation as well, v = J q̇ − speed = 0 with β = 0; its
multiplier is zero while it slips. Powers P are those of the works that are integrated with the motion. An inner
state z of a law is R3 = ż − Z = 0; forces, powers and Z have derivatives by it (R1_z, P_z, R3_z).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from gudgeon.contract.boundary import N_WORK
from gudgeon.generator.equations.loads import Friction, PointLoad
from gudgeon.generator.equations.model import stick_gain
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.differentiation import Tangent, Tangents
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.signatures import DISCRETE, RHS, Number, acting_on
from gudgeon.generator.ir.statements import Call, Declare
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.solvers.pivots import friction_mode
from gudgeon.generator.symbols.storage import Place, PlaceSymbol
from gudgeon.generator.symbols.symbols import Symbols

ZERO = sp.Integer(0)
Pair = tuple[int, int]  # node (coordinates, equations, frictions, inner states), column (coordinate or state)


@dataclass
class Parts:
    """Non-zeros of the linearization by (node, coordinate), of powers by (power, coordinate or node)."""

    mass: dict[Pair, sp.Expr] = field(default_factory=dict)
    phi_q: dict[Pair, sp.Expr] = field(default_factory=dict)
    by_q: dict[Pair, sp.Expr] = field(default_factory=dict)  # R1_q, Q
    by_v: dict[Pair, sp.Expr] = field(default_factory=dict)  # R1_v, V
    by_z: dict[Pair, sp.Expr] = field(default_factory=dict)  # R1_z, R3_z
    by_t: dict[int, sp.Expr] = field(default_factory=dict)
    power_q: dict[Pair, sp.Expr] = field(default_factory=dict)
    power_v: dict[Pair, sp.Expr] = field(default_factory=dict)
    power_z: dict[Pair, sp.Expr] = field(default_factory=dict)
    power_row: dict[Pair, sp.Expr] = field(default_factory=dict)
    power_t: dict[int, sp.Expr] = field(default_factory=dict)


class Linearization:
    """Prints common statements (contacts, tangents) into a function and returns the parts in its symbols."""

    def __init__(self, system: System, build: KernelBuilder) -> None:
        """Make symbols for the accelerations, multipliers and inner states, which are held constant."""
        self.system, self.model, self.build = system, system.model, build
        self.symbols: Symbols = system.model.symbols
        self.n, self.m = len(system.q), len(system.rows)
        self.t = system.model.t
        self.q, self.v = ({s: k for k, s in enumerate(group)} for group in (system.q, system.v))
        self.states = self.model.law_states  # of each joint with play, as in C
        self.z = {
            self._held(f"{c.label}_{state.name}", DISCRETE["contact"][i]["state"][k]): i * self.states + k
            for i, c in enumerate(self.model.clearances)
            for k, state in enumerate(c.states)
        }
        self.tangents = Tangents(self.symbols, build, (*system.q, *system.v, *self.z, self.t))
        for known in system.known:  # functions of t
            for symbol, rate in ((known.q, known.rate), (known.rate, known.second), (known.second, known.third)):
                self.tangents.know(symbol, {self.t: rate})
        self.parts = Parts()
        self.a = [self._held(f"a_{q.name}", Place("a")[k]) for k, q in enumerate(system.q)]
        self.multiplier = [self._held(f"held_lambda_{row.name}", RHS["lambda"][r]) for r, row in enumerate(system.rows)]
        self.sticks: list[sp.Symbol] = []  # 1 in stick, 0 in slip
        self.rates: list[sp.Expr] = []  # of the inner states
        self.powers: list[sp.Expr] = [ZERO] * N_WORK

    def derive(self) -> Parts:
        """Return all parts of the linearization."""
        loads = [load for element in self.model.elements.values() for load in element.on_points()]
        self.powers[0] = sp.Add(*(-x * row.nu for x, row in zip(self.multiplier, self.system.rows, strict=True)))
        self.powers[1] = sp.Add(*(element.loads.power for element in self.model.elements.values()))
        for index, clearance in enumerate(self.model.clearances):
            loads += self._clearance(index, clearance)
        acting, on_given = self.system.generalized(loads)
        residual = [-own - load for own, load in zip(self.system.applied, acting, strict=True)]
        for given in self.system.given:
            needed = sp.Add(*(m * self.a[k] for k, m in given.mass.items())) - given.applied
            self.powers[0] += given.rate * (needed - on_given.get(given.name, ZERO))
        self._rows()
        self._frictions(residual)
        self._coordinates(residual)
        for place, rate in zip(self.z.values(), self.rates, strict=True):
            self._split(self.n + self.m + len(self.system.frictions) + place, -rate, 1)
        self._power_parts()
        return self.parts

    def _held(self, expected: str, home: Place) -> sp.Symbol:
        """Return a new symbol that is read at a place and held constant."""
        return self.symbols.new(expected.replace(".", "_"), home)

    def _clearance(self, index: int, clearance: Clearance) -> list[PointLoad]:
        """Return the loads of a joint with play as symbols, whose tangents its own function computes."""
        name, build, out = clearance.label, self.build, RHS["clearance"][index]
        build.section(f"clearance {clearance.kind} {clearance.name}")
        e = [build.local(f"e_{name}_{c}", x) for c, x in zip("xy", clearance.eccentricity, strict=True)]
        edot = [build.local(f"edot_{name}_{c}", x) for c, x in zip("xy", clearance.eccentricity_rate, strict=True)]
        given = (*clearance.eccentricity, *clearance.eccentricity_rate, clearance.first.omega, clearance.second.omega)
        given += clearance.also
        slopes = self.symbols.unique(f"change_{name}")
        build.line(Declare(Number.REAL, slopes, (4 + self.states, len(given) + self.states)))
        build.line(Call(f"tangent_{name}_", (*e, *edot, *given[4:], *acting_on(index)), (Place(slopes),)))
        own = [state for state, place in self.z.items() if place // self.states == index] if self.states else []
        inner = [self.tangents.gradient(x) for x in (*given, *own)]
        also = ("n_x", "n_y") if clearance.wall else ("theta_i",)
        by_what = (*_BY, *also[: len(clearance.also)], *(state.name for state in own))
        values = []
        results: dict[str, Place] = {what: out[what] for what in ("Fx", "Fy", "moment_first", "moment_second")}
        results |= {f"state_rate_{k}": out["state_rate"][k] for k in range(len(own))}
        for i, (what, home) in enumerate(results.items()):
            symbol = self._held(f"{name}_{what}", home)
            places = {k: Place(slopes)[i][j] for j, k in enumerate(by_what) if inner[j]}
            by = [build.local(f"{symbol.name}_by_{k}", place) for k, place in places.items()]
            known = iter(by)
            pairs = {next(known): tangent for tangent in inner if tangent}
            self.tangents.know(symbol, self.tangents.sum(pairs.items()))
            values.append(symbol)
        self.rates += values[4:]
        moments = [
            x if end.body is not None else ZERO
            for x, end in zip(values[2:4], (clearance.first, clearance.second), strict=True)
        ]
        self.powers[2] += clearance.power(values[:2], clearance.eccentricity_rate, moments)
        return clearance.on_points(values[:2], moments)

    def _rows(self) -> None:
        """Add Φ_q, V = R2_v − 2α Φ_q, Q = R2_q − β² Φ_q and R2_t of the constraint equations."""
        if self.system.rows:
            self.build.section("constraints")
        two_alpha, beta_squared = self._gains()
        for r, row in enumerate(self.system.rows):
            node = self.n + r
            self._phi_q(node, row.phi_q)
            self._split(node, row.gamma, -1, v_only=True)
            bent = sum((entry * self.a[self.q[q]] for q, entry in row.phi_q.items()), -row.gamma)
            phi_dot = row.phi_q_v - row.nu
            at_q = self._of(self.tangents.gradient(bent), self.q)
            for k, value in self._of(self.tangents.gradient(phi_dot), self.q).items():
                at_q[k] = at_q.get(k, ZERO) + two_alpha * value
            self.parts.by_q |= {(node, k): value for k, value in at_q.items() if value != 0}
            at_t = [self.tangents.gradient(x).get(self.t, ZERO) for x in (bent, phi_dot, row.phi)]
            if (value := at_t[0] + two_alpha * at_t[1] + beta_squared * at_t[2]) != 0:
                self.parts.by_t[node] = value

    def _gains(self) -> tuple[sp.Expr, sp.Expr]:
        """Return 2α and β² as derived parameters."""
        alpha, beta = self.model.baumgarte
        derive = self.model.slots.derive
        return derive("two_alpha", 2 * alpha, "2 alpha"), derive("beta_squared", beta**2, "beta^2")

    def _phi_q(self, node: int, jacobian: Mapping[sp.Symbol, sp.Expr]) -> None:
        """Add the entries of an equation's Jacobian."""
        self.parts.phi_q |= {(node, self.q[q]): entry for q, entry in jacobian.items()}

    def _split(self, node: int, value: sp.Expr, sign: int, v_only: bool = False) -> None:
        """Add `sign` times the derivatives of one residual to the parts; with `v_only` only those by v."""
        tangent = self.tangents.gradient(value)
        for part, place in ((self.parts.by_v, self.v), (self.parts.by_q, self.q), (self.parts.by_z, self.z)):
            if place is self.v or not v_only:
                part |= {(node, k): sign * x for k, x in self._of(tangent, place).items()}
        if not v_only and self.t in tangent:
            self.parts.by_t[node] = sign * tangent[self.t]

    @staticmethod
    def _of(tangent: Tangent, place: Mapping[sp.Symbol, int]) -> dict[int, sp.Expr]:
        """Return the entries of a tangent by the numbers of the symbols in `place`."""
        return {place[s]: value for s, value in tangent.items() if s in place}

    def _frictions(self, residual: list[sp.Expr]) -> None:
        """Add the equations of stick, the forces of slip and their power; the mode is held constant."""
        if self.system.frictions:
            self.build.section("friction: slip, or stick as a constraint equation")
        two_alpha = stick_gain(self.model) if self.system.frictions else ZERO
        for r, friction in enumerate(self.system.frictions):
            node, name, build = self.n + self.m + r, friction.name, self.build
            stick, sign = friction_mode(build, name, r)
            held = Conditional(Test(stick, "!=", (0.0,)), PlaceSymbol(RHS["friction"][r]["force"]), ZERO)
            force = build.local(f"held_force_{name}", held)
            self.sticks.append(stick)
            self._phi_q(node, friction.jacobian)
            kinetic = friction.slip.kinetic_at(friction.slip.v)
            row = sum((entry * self.a[self.q[q]] for q, entry in friction.jacobian.items()), -friction.gamma)
            self._split(node, row + two_alpha * friction.slip.v, 1)
            for q, entry in friction.jacobian.items():
                k = self.q[q]
                left = self.parts.by_v.pop((node, k), ZERO) - two_alpha * entry  # V has no 2α Φ_q
                if left := sp.expand(left):
                    self.parts.by_v[node, k] = left
                residual[k] += entry * (sign * kinetic - force)
            self._friction_power(node, friction, force - sign * kinetic, stick)

    def _friction_power(self, node: int, friction: Friction, force: sp.Expr, stick: sp.Symbol) -> None:
        """Add the power of a friction force at the velocity on which it acts; at stick it is −λ."""
        moving = friction.slip.v + friction.slip.speed
        self.powers[1] += force * moving
        self.parts.power_row[1, node] = -stick * moving
        for given in self.system.given:  # what friction asks of a drive
            along = given.rate * self.symbols.written_out(friction.slip.v, given.rate)
            if along != 0:
                self.powers[0] -= along * force
                self.parts.power_row[0, node] = self.parts.power_row.get((0, node), ZERO) + stick * along

    def _coordinates(self, residual: list[sp.Expr]) -> None:
        """Add M, R1_q, R1_v and R1_t of the equations of motion."""
        self.build.section("coordinates")
        for (i, j), value in self.system.mass.items():
            for k, other in sorted({(i, j), (j, i)}):
                self.parts.mass[k, other] = value
                residual[k] += value * self.a[other]
        for multiplier, row in zip(self.multiplier, self.system.rows, strict=True):
            for q, entry in row.phi_q.items():
                residual[self.q[q]] += entry * multiplier
        for k, value in enumerate(residual):
            self._split(k, value, 1)

    def _power_parts(self) -> None:
        """Add the derivatives of the powers."""
        if not any(self.powers):
            return
        self.build.section("powers")
        for w, power in enumerate(self.powers):
            tangent = self.tangents.gradient(power)
            self.parts.power_q |= {(w, k): value for k, value in self._of(tangent, self.q).items()}
            self.parts.power_v |= {(w, k): value for k, value in self._of(tangent, self.v).items()}
            self.parts.power_z |= {(w, k): value for k, value in self._of(tangent, self.z).items()}
            if self.t in tangent:
                self.parts.power_t[w] = tangent[self.t]
        for r, row in enumerate(self.system.rows):
            if row.nu != 0:
                self.parts.power_row[0, self.n + r] = -row.nu
        for given in self.system.given:  # a drive also moves what inertia the accelerations meet it with
            for k, mass in given.mass.items():
                self.parts.power_row[0, k] = self.parts.power_row.get((0, k), ZERO) + given.rate * mass


_BY = ("e_x", "e_y", "de_x", "de_y", "omega_i", "omega_j")
