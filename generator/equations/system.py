"""Equations of motion that are integrated: M q̈ + Φ_qᵀ λ = g, Φ(q, t) = 0, in absolute or tree coordinates.

A model's bodies move with the coordinates of a system: a body's (x, y, θ) have a Jacobian J in them, and
r̈ = J q̈ + bias. In absolute coordinates J is the identity and M is diagonal (`make_absolute_system`); in tree
coordinates most of Φ is eliminated (generator/reduction/reduction.py). All functions derived from a system
(right-hand side, projection, Jacobians) hold for both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.geometry import PointFrame
from gudgeon.generator.equations.loads import Friction, PointLoad
from gudgeon.generator.equations.model import Model

ZERO, ONE = sp.Integer(0), sp.Integer(1)


@dataclass(frozen=True)
class Motion:
    """Motion of a body with the coordinates: three rows of J for (x, y, θ), non-zeros by index, and three biases."""

    jacobian: tuple[Mapping[int, sp.Expr], ...]
    bias: tuple[sp.Expr, ...]


@dataclass(frozen=True)
class PrescribedCoordinate:
    """A coordinate z(t) that a drive prescribes; its equation gives the effort of the drive, not an acceleration."""

    name: str
    rate: sp.Expr
    mass: Mapping[int, sp.Expr]  # its entries of M with the unknown coordinates
    applied: sp.Expr  # as System.applied


@dataclass(frozen=True)
class DependentCoordinate:
    """A dependent coordinate of a loop that drives determine, a function of t, with its first three rates.

    `rate`, `second` and `third` are its first, second and third time derivatives.
    """

    q: sp.Symbol
    rate: sp.Symbol
    second: sp.Symbol
    third: sp.Symbol


@dataclass(frozen=True)
class System:
    """Equations of motion in coordinates q with velocities v; `mass` is the lower triangle (i ≥ j) of M by index."""

    model: Model
    q: tuple[sp.Symbol, ...]
    v: tuple[sp.Symbol, ...]
    motions: Mapping[str, Motion]  # by body
    mass: Mapping[tuple[int, int], sp.Expr]
    applied: tuple[sp.Expr, ...]  # weights minus velocity terms and terms of prescribed accelerations
    prescribed: tuple[PrescribedCoordinate, ...]
    rows: tuple[Row, ...]
    frictions: tuple[Friction, ...]
    dependent: tuple[DependentCoordinate, ...] = field(default=(), kw_only=True)  # of driven loops (driven_loops.py)
    in_tree: ClassVar[bool] = False  # whether the coordinates are those of a tree

    def compute_inertia_about_joints(self, k: int) -> sp.Expr:
        """Return the moment of inertia to which the pivot of coordinate k in M is compared; 0 for x and y.

        For the angle of a body it is J + Σ m s² over the points of its joints (parallel-axis theorem), as a derived
        parameter. s leads from the centre of mass to the point.
        """
        if k % 3 != 2:
            return ZERO
        name = self.model.bodies[k // 3].name
        return self.model.parameter_table.derive_parameter(
            f"{name}_turning", self.model.compute_inertia_about_joints(name), "J and m s^2 of its joints"
        )

    def compute_inertia_of_unit_mass(self, k: int) -> sp.Expr:
        """Return the inertia of coordinate k for a mass of 1 kg: Σ s² over the joint points for an angle, else 1.

        Projections scale it to the smallest mass that they use (`raise_small_masses`).
        """
        return sp.Add(*self.model.compute_squared_arms(self.model.bodies[k // 3].name)) if k % 3 == 2 else ONE

    def compute_generalized_forces(self, loads: Sequence[PointLoad]) -> tuple[list[sp.Expr], dict[str, sp.Expr]]:
        """Return the generalized forces (n) Jᵀ f of loads, and those on prescribed coordinates by their names.

        In absolute coordinates no coordinate is prescribed: the second result is empty. Loads on the ground are
        skipped.
        """
        forces = [ZERO] * len(self.q)
        for point, x, y, moment in loads:
            if point.body is not None:
                k = point.body.index
                forces[k] += x
                forces[k + 1] += y
                forces[k + 2] += point.arm[0] * y - point.arm[1] * x + moment
        return forces, {}

    def compute_acceleration(self, point: PointFrame, a: Mapping[int, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return r̈ of a point in ground axes, with the accelerations `a` of the coordinates by index.

        It is r̈ of the centre of mass + θ̈ ẑ × arm − ω² arm; (0, 0) for points of the ground.
        """
        if point.body is None:
            return ZERO, ZERO
        motion, (arm_x, arm_y), omega = self.motions[point.body.name], point.arm, point.body.omega
        x, y, theta = (
            sp.Add(*(entry * a[k] for k, entry in row.items()), bias)
            for row, bias in zip(motion.jacobian, motion.bias, strict=True)
        )
        return x - theta * arm_y - omega**2 * arm_x, y + theta * arm_x - omega**2 * arm_y

    def compute_angular_acceleration(self, point: PointFrame, a: Mapping[int, sp.Expr]) -> sp.Expr:
        """Return θ̈ of a point's body, with the accelerations `a` of the coordinates by index; 0 for the ground."""
        if point.body is None:
            return ZERO
        motion = self.motions[point.body.name]
        return sp.Add(*(entry * a[k] for k, entry in motion.jacobian[2].items()), motion.bias[2])


def make_absolute_system(model: Model) -> System:
    """Return the system in the model's own coordinates, three per body, with a diagonal mass matrix."""
    motions = {
        body.name: Motion(tuple({body.index + offset: ONE} for offset in range(3)), (ZERO, ZERO, ZERO))
        for body in model.bodies
    }
    mass = {(k, k): mass_entry for k, mass_entry in enumerate(model.masses)}
    return System(model, model.q, model.v, motions, mass, _derive_weights(model), (), model.rows, model.frictions)


def _derive_weights(model: Model) -> tuple[sp.Expr, ...]:
    """Return the weights of the bodies (n) in N as derived parameters; 0 for angles and for axes without gravity."""
    forces: list[sp.Expr] = []
    for body in model.bodies:
        for axis, component in zip("xy", model.gravity, strict=True):
            weight = body.mass * component
            weight_parameter = (
                ZERO
                if weight == 0
                else model.parameter_table.derive_parameter(f"weight_{body.name}_{axis}", weight, "weight")
            )
            forces.append(weight_parameter)
        forces.append(ZERO)
    return tuple(forces)
