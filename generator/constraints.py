"""Φ, Φ_q, ν and γ, row by row (physics.md, section 1): every joint type is derived the same way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.geometry import BodySymbols, Geometry, PointFrame
from gudgeon.generator.joints.joint_type import joint_types
from gudgeon.generator.mechanism import Drive, Joint
from gudgeon.generator.symbolic import to_sympy


@dataclass(frozen=True)
class Row:
    """One row of Φ with what follows from it; all in the derived symbols of the geometry."""

    name: str  # "A.x"
    owner: str  # joint or drive
    kind: str  # "joint" or "drive"
    unit: str  # "m" or "rad"
    phi: sp.Expr
    phi_q: Mapping[sp.Symbol, sp.Expr]  # the non-zeros, by coordinate
    phi_q_v: sp.Expr  # Φ_q q̇
    nu: sp.Expr  # −Φ_t
    gamma: sp.Expr  # −(Φ_q q̇)_q q̇ − 2Φ_qt q̇ − Φ_tt


class JointFields:
    """A joint's own fields as a joint file asks for them."""

    def __init__(self, joint: Joint, geometry: Geometry) -> None:
        self._joint, self._slots = joint, geometry.slots

    def direction(self, name: str) -> tuple[sp.Expr, sp.Expr]:
        """A vector field as a unit vector; along an axis it is exactly (±1, 0) or (0, ±1)."""
        vector = self._joint.vectors[name]
        x, y = (self._slots.use(component) for component in vector)
        length = sp.sqrt(x**2 + y**2)
        wanted = f"{self._joint.name}_{name}"
        return self._component(f"{wanted}_x", x, y, length), self._component(f"{wanted}_y", y, x, length)

    def _component(self, wanted: str, own: sp.Expr, other: sp.Expr, length: sp.Expr) -> sp.Expr:
        if own == 0:
            return sp.Integer(0)
        if other == 0:
            entry = next((e for e in self._slots.entries.values() if e.symbol == own), None)
            if entry is not None and not entry.follows:  # only its sign matters, and the sign is structural
                return sp.Integer(1 if entry.default > 0 else -1)
        return self._slots.derive(wanted, own / length, "unit vector")

    def angle_of(self, name: str) -> sp.Expr:
        """The angle of a vector field in its body's frame (rad)."""
        x, y = self.direction(name)
        return self._slots.derive(f"{self._joint.name}_{name}_angle", sp.atan2(y, x), "direction of the axis")

    def quantity(self, name: str, default: sp.Expr) -> sp.Expr:
        """A number field, or `default` where the user gave none."""
        quantity = self._joint.quantities.get(name)
        return default if quantity is None else self._slots.use(quantity)


class Constraints:
    """Derives rows; `t` is time, `drive_angles` holds what each drive prescribes."""

    def __init__(self, geometry: Geometry) -> None:
        self.geometry, self.symbols = geometry, geometry.symbols
        self.t = self.symbols.new("time", "t", "time", "s")
        self.drive_angles: dict[str, tuple[sp.Symbol, sp.Symbol, sp.Symbol]] = {}

    def joint_rows(self, joint: Joint) -> list[Row]:
        """The rows of a joint, named "<joint>.<row>"."""
        kind = joint_types()[joint.kind]
        first, second = self.geometry.point(joint.first), self.geometry.point(joint.second)
        expressions = kind.rows(first, second, JointFields(joint, self.geometry))
        named = zip(kind.row_names, kind.row_units, expressions, strict=True)
        return [
            self._row(f"{joint.name}.{name}", joint.name, "joint", unit, sp.expand(phi), self._bodies(first, second))
            for name, unit, phi in named
        ]

    def drive_rows(self, drive: Drive) -> list[Row]:
        """θ_body − θ_reference − f(t): one row, named as the drive."""
        bodies = [self.geometry.bodies[name] for name in (drive.body, drive.reference) if name]
        phi = bodies[0].theta - self._drive_angle(drive)
        if len(bodies) > 1:
            phi -= bodies[1].theta
        return [self._row(drive.name, drive.name, "drive", "rad", phi, bodies)]

    def _drive_angle(self, drive: Drive) -> sp.Symbol:
        """f(t), f′ and f″ as symbols that know that they are each other's derivatives."""
        slots, define = self.geometry.slots, self.symbols.define

        def symbol_of(path: str) -> sp.Symbol:
            return self.t if path == "t" else slots.entries[f"parameters.{path}"].symbol

        value = to_sympy(drive.value.value, symbol_of)
        f = define(f"{drive.name}_angle", value, "", f"drive {drive.name}", "rad")
        rate = define(f"{drive.name}_rate", sp.diff(value, self.t), "", "its rate", "rad/s")
        second = define(f"{drive.name}_acceleration", sp.diff(value, self.t, 2), "", "its second rate", "rad/s^2")
        self.symbols.rules[f], self.symbols.rules[rate] = {self.t: rate}, {self.t: second}
        self.drive_angles[drive.name] = f, rate, second
        return f

    @staticmethod
    def _bodies(*points: PointFrame) -> list[BodySymbols]:
        return [point.body for point in points if point.body is not None]

    def _row(self, name: str, owner: str, kind: str, unit: str, phi: sp.Expr, bodies: list[BodySymbols]) -> Row:
        diff, t = self.symbols.diff, self.t
        pairs = [(q, v) for body in bodies for q, v in zip(body.q, body.v, strict=True)]
        phi_q = {q: entry for q, _ in pairs if (entry := sp.expand(diff(phi, q))) != 0}
        phi_q_v = sum((phi_q[q] * v for q, v in pairs if q in phi_q), sp.Integer(0))
        phi_t = diff(phi, t)
        gamma = -sum((diff(phi_q_v, q) * v for q, v in pairs), sp.Integer(0)) - 2 * diff(phi_q_v, t) - diff(phi_t, t)
        return Row(name, owner, kind, unit, phi, phi_q, phi_q_v, -phi_t, sp.expand(gamma))
