"""Linearization of the equations of motion at a state, for Newton's method and Jacobians.

With accelerations a and multipliers λ that satisfy, at (t, q, v),
    R1 = M a + Φ_qᵀ λ − g = 0,    R2 = Φ_q a − γ + 2α Φ̇ + β² Φ = 0
and are held constant, this collects the structural non-zeros of R1_q, R1_v, R1_t, R2_t and of V and Q in
    R2_v = 2α Φ_q + V,    R2_q = β² Φ_q + Q
where Φ_q itself is taken out. Friction that may stick is an equation as well, v = J q̇ − speed = 0 with β = 0; its
multiplier is zero while it slips. Powers P are those of the works that are integrated with the motion. An internal
state z of a law is R3 = ż − Z = 0; forces, powers and Z have derivatives by it (R1_z, P_z, R3_z).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from gudgeon.contract.boundary import N_WORK
from gudgeon.generator.equations.loads import Friction, PointLoad
from gudgeon.generator.equations.model import derive_stick_baumgarte_gain
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.differentiation import Tangent, Tangents
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.signatures import DISCRETE, RHS, Number, make_contact_arguments
from gudgeon.generator.ir.statements import Call, Declare
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.solvers.pivots import append_friction_mode
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol
from gudgeon.generator.symbols.symbols import Symbols

ZERO = sp.Integer(0)
Pair = tuple[int, int]  # node (coordinates, equations, frictions, internal states), column (coordinate or state)


@dataclass
class JacobianEntries:
    """Non-zeros of the linearization by (node, column), of the powers' derivatives by (power, column or node).

    A node is the number of a coordinate, then of an equation, a friction element, an internal state. Columns are
    coordinates, in `by_z` and `power_z` internal states. `by_t` and `power_t` have nodes or powers alone.
    """

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
    """Builder of the derivatives of the equations of motion: appends statements, returns non-zero entries."""

    def __init__(self, system: System, builder: KernelBuilder) -> None:
        """Begin with new symbols for accelerations, multipliers and internal states of laws, held constant.

        `builder`: the function to which statements are appended.
        """
        self.system, self.model, self.builder = system, system.model, builder
        self.symbols: Symbols = system.model.symbols
        self.n, self.m = len(system.q), len(system.rows)
        self.t = system.model.t
        self.q, self.v = ({s: k for k, s in enumerate(group)} for group in (system.q, system.v))
        self.states = self.model.law_states  # of each joint with play, as in C
        self.z = {
            self._make_constant_symbol(f"{c.label}_{state.name}", DISCRETE["contact"][i]["state"][k]): i * self.states
            + k
            for i, c in enumerate(self.model.clearances)
            for k, state in enumerate(c.states)
        }
        self.tangents = Tangents(self.symbols, builder, (*system.q, *system.v, *self.z, self.t))
        for dependent in system.dependent:  # functions of t
            for symbol, rate in (
                (dependent.q, dependent.rate),
                (dependent.rate, dependent.second),
                (dependent.second, dependent.third),
            ):
                self.tangents.store_tangent(symbol, {self.t: rate})
        self.jacobians = JacobianEntries()
        self.a = [self._make_constant_symbol(f"a_{q.name}", StorageLocation("a")[k]) for k, q in enumerate(system.q)]
        self.multiplier = [
            self._make_constant_symbol(f"held_lambda_{row.name}", RHS["lambda"][r]) for r, row in enumerate(system.rows)
        ]
        self.stick_flags: list[sp.Symbol] = []  # 1 in stick, 0 in slip
        self.rates: list[sp.Expr] = []  # of the internal states
        self.powers: list[sp.Expr] = [ZERO] * N_WORK

    def derive_jacobian_entries(self) -> JacobianEntries:
        """Append all statements of the linearization to the function and return its non-zero entries by part.

        Parts are M, Φ_q and the derivatives of equations and powers by q, v, internal states and t. Called once.
        """
        loads = [load for element in self.model.elements.values() for load in element.list_point_loads()]
        self.powers[0] = sp.Add(*(-x * row.nu for x, row in zip(self.multiplier, self.system.rows, strict=True)))
        self.powers[1] = sp.Add(*(element.loads.power for element in self.model.elements.values()))
        for index, clearance in enumerate(self.model.clearances):
            loads += self._append_clearance(index, clearance)
        generalized_loads, prescribed_forces = self.system.compute_generalized_forces(loads)
        residual = [
            -applied_force - load for applied_force, load in zip(self.system.applied, generalized_loads, strict=True)
        ]
        for prescribed in self.system.prescribed:
            drive_force = sp.Add(*(m * self.a[k] for k, m in prescribed.mass.items())) - prescribed.applied
            self.powers[0] += prescribed.rate * (drive_force - prescribed_forces.get(prescribed.name, ZERO))
        self._add_constraint_equations()
        self._add_friction_equations(residual)
        self._add_motion_equations(residual)
        for state_index, rate in zip(self.z.values(), self.rates, strict=True):
            self._add_derivatives(self.n + self.m + len(self.system.frictions) + state_index, -rate, 1)
        self._add_powers()
        return self.jacobians

    def _make_constant_symbol(self, base_name: str, place: StorageLocation) -> sp.Symbol:
        """Return a new symbol that is read at the storage location `place` and held constant in derivatives."""
        return self.symbols.add_symbol(base_name.replace(".", "_"), place)

    def _append_clearance(self, index: int, clearance: Clearance) -> list[PointLoad]:
        """Append the call of the derivatives of a joint's force; return its loads as symbols with known derivatives.

        The rates of its internal states (bristle states) and its power are recorded. `index`: number of the joint with
        play.
        """
        name, builder, out = clearance.label, self.builder, RHS["clearance"][index]
        builder.begin_section(f"clearance {clearance.kind} {clearance.name}")
        eccentricity = [
            builder.append_local(f"e_{name}_{axis}", component)
            for axis, component in zip("xy", clearance.eccentricity, strict=True)
        ]
        eccentricity_rate = [
            builder.append_local(f"edot_{name}_{axis}", component)
            for axis, component in zip("xy", clearance.eccentricity_rate, strict=True)
        ]
        inputs = (*clearance.eccentricity, *clearance.eccentricity_rate, clearance.first.omega, clearance.second.omega)
        inputs += clearance.surface_arguments
        slopes = self.symbols.make_unique_name(f"change_{name}")
        builder.append_instruction(Declare(Number.REAL, slopes, (4 + self.states, len(inputs) + self.states)))
        builder.append_instruction(
            Call(
                f"tangent_{name}_",
                (*eccentricity, *eccentricity_rate, *inputs[4:], *make_contact_arguments(index)),
                (StorageLocation(slopes),),
            )
        )
        states = (
            [state for state, derivative_place in self.z.items() if derivative_place // self.states == index]
            if self.states
            else []
        )
        input_tangents = [self.tangents.compute_gradient(component) for component in (*inputs, *states)]
        surface_names = ("n_x", "n_y") if clearance.wall else ("theta_i",)
        derivative_names = (
            *_INPUT_NAMES,
            *surface_names[: len(clearance.surface_arguments)],
            *(state.name for state in states),
        )
        values = []
        results: dict[str, StorageLocation] = {
            result_name: out[result_name] for result_name in ("Fx", "Fy", "moment_first", "moment_second")
        }
        results |= {f"state_rate_{k}": out["state_rate"][k] for k in range(len(states))}
        for i, (result_name, place) in enumerate(results.items()):
            symbol = self._make_constant_symbol(f"{name}_{result_name}", place)
            places = {k: StorageLocation(slopes)[i][j] for j, k in enumerate(derivative_names) if input_tangents[j]}
            derivatives = [
                builder.append_local(f"{symbol.name}_by_{k}", derivative_place)
                for k, derivative_place in places.items()
            ]
            derivative_iterator = iter(derivatives)
            tangent_by_derivative = {next(derivative_iterator): tangent for tangent in input_tangents if tangent}
            self.tangents.store_tangent(symbol, self.tangents.sum_tangents(tangent_by_derivative.items()))
            values.append(symbol)
        self.rates += values[4:]
        moments = [
            component if end.body is not None else ZERO
            for component, end in zip(values[2:4], (clearance.first, clearance.second), strict=True)
        ]
        self.powers[2] += clearance.compute_power(values[:2], clearance.eccentricity_rate, moments)
        return clearance.list_point_loads(values[:2], moments)

    def _add_constraint_equations(self) -> None:
        """Add the derivatives of the constraint equations to `jacobians`: Φ_q, V, Q and R2_t.

        R2 = Φ_q a − γ + 2α Φ̇ + β² Φ at constant accelerations a; V = R2_v − 2α Φ_q and Q = R2_q − β² Φ_q.
        """
        if self.system.rows:
            self.builder.begin_section("constraints")
        two_alpha, beta_squared = self._derive_baumgarte_gains()
        for index, row in enumerate(self.system.rows):
            node = self.n + index
            self._add_jacobian(node, row.phi_q)
            self._add_derivatives(node, row.gamma, -1, velocities_only=True)
            residual = sum((entry * self.a[self.q[q]] for q, entry in row.phi_q.items()), -row.gamma)
            phi_dot = row.phi_q_v - row.nu
            derivative_by_q = self._select_entries(self.tangents.compute_gradient(residual), self.q)
            for k, value in self._select_entries(self.tangents.compute_gradient(phi_dot), self.q).items():
                derivative_by_q[k] = derivative_by_q.get(k, ZERO) + two_alpha * value
            self.jacobians.by_q |= {(node, k): value for k, value in derivative_by_q.items() if value != 0}
            derivatives_by_t = [
                self.tangents.compute_gradient(x).get(self.t, ZERO) for x in (residual, phi_dot, row.phi)
            ]
            if (
                value := derivatives_by_t[0] + two_alpha * derivatives_by_t[1] + beta_squared * derivatives_by_t[2]
            ) != 0:
                self.jacobians.by_t[node] = value

    def _derive_baumgarte_gains(self) -> tuple[sp.Expr, sp.Expr]:
        """Return (2α, β²) of Baumgarte's terms 2α Φ̇ + β² Φ as derived parameters, in 1/s and 1/s²."""
        alpha, beta = self.model.baumgarte
        derive = self.model.parameter_table.derive_parameter
        return derive("two_alpha", 2 * alpha, "2 alpha"), derive("beta_squared", beta**2, "beta^2")

    def _add_jacobian(self, node: int, jacobian: Mapping[sp.Symbol, sp.Expr]) -> None:
        """Add the entries of an equation's Jacobian, by coordinate, to `jacobians.phi_q`.

        `node`: number of the equation.
        """
        self.jacobians.phi_q |= {(node, self.q[q]): entry for q, entry in jacobian.items()}

    def _add_derivatives(self, node: int, value: sp.Expr, sign: int, velocities_only: bool = False) -> None:
        """Add `sign` times the derivatives of `value`, a term of a residual, by v, q, z and t to `jacobians`.

        z are the internal states of laws. With `velocities_only` only those by v are added. `node`: number of the
        equation.
        """
        tangent = self.tangents.compute_gradient(value)
        for part, index_of in (
            (self.jacobians.by_v, self.v),
            (self.jacobians.by_q, self.q),
            (self.jacobians.by_z, self.z),
        ):
            if index_of is self.v or not velocities_only:
                part |= {(node, k): sign * entry for k, entry in self._select_entries(tangent, index_of).items()}
        if not velocities_only and self.t in tangent:
            self.jacobians.by_t[node] = sign * tangent[self.t]

    @staticmethod
    def _select_entries(tangent: Tangent, index_of: Mapping[sp.Symbol, int]) -> dict[int, sp.Expr]:
        """Return the entries of a tangent, the derivatives by symbol, by the numbers of these in `index_of`.

        Symbols that `index_of` does not contain are left out.
        """
        return {index_of[symbol]: value for symbol, value in tangent.items() if symbol in index_of}

    def _add_friction_equations(self, residual: list[sp.Expr]) -> None:
        """Add the equations of stick, the forces of slip and their power to `jacobians`; stick or slip is constant.

        `residual`, by coordinate, gets −Jᵀ f in place. f is the friction force: at stick the current one, held
        constant, at slip −sign(v) · kinetic force. A symbol for each element, 1 at stick and 0 at slip, is appended to
        `stick_flags`.
        """
        if self.system.frictions:
            self.builder.begin_section("friction: slip, or stick as a constraint equation")
        two_alpha = derive_stick_baumgarte_gain(self.model) if self.system.frictions else ZERO
        for index, friction in enumerate(self.system.frictions):
            node, name, builder = self.n + self.m + index, friction.name, self.builder
            stick, sign = append_friction_mode(builder, name, index)
            held_force_value = Conditional(
                Test(stick, "!=", (0.0,)), StoredSymbol(RHS["friction"][index]["force"]), ZERO
            )
            force = builder.append_local(f"held_force_{name}", held_force_value)
            self.stick_flags.append(stick)
            self._add_jacobian(node, friction.jacobian)
            kinetic = friction.slip.evaluate_kinetic_force(friction.slip.v)
            stick_residual = sum((entry * self.a[self.q[q]] for q, entry in friction.jacobian.items()), -friction.gamma)
            self._add_derivatives(node, stick_residual + two_alpha * friction.slip.v, 1)
            for q, entry in friction.jacobian.items():
                k = self.q[q]
                remainder = self.jacobians.by_v.pop((node, k), ZERO) - two_alpha * entry  # V has no 2α Φ_q
                if remainder := sp.expand(remainder):
                    self.jacobians.by_v[node, k] = remainder
                residual[k] += entry * (sign * kinetic - force)
            self._add_friction_power(node, friction, force - sign * kinetic, stick)

    def _add_friction_power(self, node: int, friction: Friction, force: sp.Expr, stick: sp.Symbol) -> None:
        """Add the power of a friction force at the velocity on which it acts, and its derivative by the multiplier λ.

        At stick the force is −λ. `node`: number of the equation of stick; `force`: the friction force, at stick held
        constant; `stick`: 1 at stick, else 0. At prescribed coordinates the drive supplies the power.
        """
        velocity = friction.slip.v + friction.slip.speed
        self.powers[1] += force * velocity
        self.jacobians.power_row[1, node] = -stick * velocity
        for prescribed in self.system.prescribed:  # power of friction that a drive supplies
            prescribed_velocity = prescribed.rate * self.symbols.differentiate_definitions(
                friction.slip.v, prescribed.rate
            )
            if prescribed_velocity != 0:
                self.powers[0] -= prescribed_velocity * force
                self.jacobians.power_row[0, node] = (
                    self.jacobians.power_row.get((0, node), ZERO) + stick * prescribed_velocity
                )

    def _add_motion_equations(self, residual: list[sp.Expr]) -> None:
        """Add M and the derivatives by q, v, z, t of R1 = M a + Φ_qᵀ λ − g (equations of motion) to `jacobians`.

        z are the internal states of laws. `residual`, by coordinate, holds −g and is completed in place.
        """
        self.builder.begin_section("coordinates")
        for (i, j), value in self.system.mass.items():
            for k, column in sorted({(i, j), (j, i)}):
                self.jacobians.mass[k, column] = value
                residual[k] += value * self.a[column]
        for multiplier, row in zip(self.multiplier, self.system.rows, strict=True):
            for q, entry in row.phi_q.items():
                residual[self.q[q]] += entry * multiplier
        for k, value in enumerate(residual):
            self._add_derivatives(k, value, 1)

    def _add_powers(self) -> None:
        """Add the derivatives of the powers by q, v, internal states and t to `jacobians`, and append their statements.

        The power of the drives also gets those by multipliers and accelerations. Nothing is added if all powers are 0.
        """
        if not any(self.powers):
            return
        self.builder.begin_section("powers")
        for index, power in enumerate(self.powers):
            tangent = self.tangents.compute_gradient(power)
            self.jacobians.power_q |= {(index, k): value for k, value in self._select_entries(tangent, self.q).items()}
            self.jacobians.power_v |= {(index, k): value for k, value in self._select_entries(tangent, self.v).items()}
            self.jacobians.power_z |= {(index, k): value for k, value in self._select_entries(tangent, self.z).items()}
            if self.t in tangent:
                self.jacobians.power_t[index] = tangent[self.t]
        for row_index, row in enumerate(self.system.rows):
            if row.nu != 0:
                self.jacobians.power_row[0, self.n + row_index] = -row.nu
        for prescribed in self.system.prescribed:  # a drive also moves the inertia coupled with the accelerations
            for k, mass in prescribed.mass.items():
                self.jacobians.power_row[0, k] = self.jacobians.power_row.get((0, k), ZERO) + prescribed.rate * mass


_INPUT_NAMES = ("e_x", "e_y", "de_x", "de_y", "omega_i", "omega_j")
