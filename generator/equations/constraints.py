"""Constraint equations Φ = 0 of joints and drives, with Jacobian Φ_q and the right-hand sides ν, γ of their rates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import sympy as sp

from gudgeon.generator.equations.fields import JointFields
from gudgeon.generator.equations.geometry import BodySymbols, Geometry, PointFrame
from gudgeon.generator.ir.differentiation import compute_partial_derivative
from gudgeon.generator.ir.finite_slopes import FrozenSign
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import GROUND, Drive, Joint, PointRef
from gudgeon.generator.symbols.from_expressions import convert_quantity_to_sympy, convert_to_sympy
from gudgeon.generator.symbols.storage import Freezable, StorageLocation
from gudgeon.generator.symbols.switches import BranchSign, DifferentiableMax, DifferentiableMin, Select
from gudgeon.language.functions import WITH_SWITCHING_POINTS
from gudgeon.language.tree import list_functions


@dataclass(frozen=True)
class Row:
    """One constraint equation of Φ with its derivatives, in the derived symbols of the geometry."""

    name: str  # "A.x"
    owner: str  # joint or drive
    kind: str  # "joint" or "drive"
    unit: str  # "m" or "rad"
    phi: sp.Expr
    phi_q: Mapping[sp.Symbol, sp.Expr]  # the non-zeros, by coordinate
    phi_q_v: sp.Expr  # Φ_q q̇
    nu: sp.Expr  # −Φ_t
    gamma: sp.Expr  # −(Φ_q q̇)_q q̇ − 2Φ_qt q̇ − Φ_tt


class Constraints(Freezable):
    """Derivation of constraint equations; `t` is the symbol of time, `drive_functions` the prescribed values by drive.

    `drive_functions` maps each drive to the symbols of its value and two derivatives by t.
    """

    def __init__(self, geometry: Geometry) -> None:
        """Begin without drives.

        `geometry` supplies the symbols and points; the symbol of time is made here.
        """
        self.geometry, self.symbols = geometry, geometry.symbols
        self.t = self.symbols.add_symbol("time", StorageLocation("t"), "time", "s")
        self.drive_functions: dict[str, tuple[sp.Symbol, sp.Symbol, sp.Symbol]] = {}

    def derive_joint_rows(self, joint: Joint) -> list[Row]:
        """Return the constraint equations of a joint, named "<joint>.<row>", in the order of its type's `row_names`.

        Φ_q contains both bodies and further bodies of the type, such as the carrier of a gear; the ground has no
        coordinates.
        """
        kind = find_joint_types()[joint.kind]
        first, second = self._find_point_frame(joint.first), self._find_point_frame(joint.second)
        expressions = kind.rows(first, second, JointFields(joint, self.geometry))
        named_expressions = zip(kind.row_names, kind.row_units, expressions, strict=True)
        other_bodies = [joint.options[name] for name in kind.third_body_fields]  # a gear's carrier
        bodies = self._list_bodies(first, second) + [
            self.geometry.bodies[name] for name in other_bodies if name != GROUND
        ]
        return [
            self._derive_row(f"{joint.name}.{name}", joint.name, "joint", unit, sp.expand(phi), bodies)
            for name, unit, phi in named_expressions
        ]

    def derive_drive_rows(self, drive: Drive) -> list[Row]:
        """Return the constraint equation of a drive in a list of one: Φ = driven quantity − f(t), in m or rad."""
        quantity, bodies, unit = self._find_driven_quantity(drive)
        phi = quantity - self.define_drive_value(drive)
        return [self._derive_row(drive.name, drive.name, "drive", unit, phi, bodies)]

    def _find_point_frame(self, ref: PointRef) -> PointFrame:
        """Return the frame of a named point."""
        return self.geometry.find_point(ref)

    def _find_coordinate_pairs(self, bodies: list[BodySymbols]) -> list[tuple[sp.Symbol, sp.Symbol]]:
        """Return the pairs (coordinate, velocity) by which an equation between the `bodies` is differentiated.

        In absolute coordinates these are x, y and θ of each body; the subclass TreeConstraints returns tree
        coordinates.
        """
        return [(q, v) for body in bodies for q, v in zip(body.q, body.v, strict=True)]

    def _find_driven_quantity(self, drive: Drive) -> tuple[sp.Expr, list[BodySymbols], str]:
        """Return (quantity, bodies, unit): what a drive prescribes, the bodies on which it depends, and "m" or "rad".

        It is a distance of two points, a coordinate of a body, or the angle of a body, less that of its reference body
        if any.
        """
        if drive.kind == "distance":
            first, second = (self._find_point_frame(ref) for ref in drive.points)
            return self._define_distance(drive.name, first, second), self._list_bodies(first, second), "m"
        bodies = [self.geometry.bodies[name] for name in (drive.body, drive.reference) if name]
        if drive.kind == "coordinate" and drive.coordinate != "theta":
            return getattr(bodies[0], drive.coordinate), bodies, "m"
        quantity = bodies[0].theta - bodies[1].theta if len(bodies) > 1 else bodies[0].theta
        return quantity, bodies, "rad"

    def _define_distance(self, drive_name: str, first_point: PointFrame, second_point: PointFrame) -> sp.Symbol:
        """Return the distance ‖r_Q − r_P‖ of two points as a new symbol, with the rules of its derivatives.

        `drive_name` is the base of the symbols' names; P and Q are `first_point` and `second_point`. With the
        direction u: d length = u · dr and du = (ẑ × u)(ẑ × u · dr)/length. Expanded, the second derivatives of the
        root would be thousands of terms.
        """
        define, rules = self.symbols.add_definition, self.symbols.derivative_rules
        difference = (second_point.x - first_point.x, second_point.y - first_point.y)
        x, y = (
            define(f"{drive_name}_span_{axis}", value, None, "span")
            for axis, value in zip("xy", difference, strict=True)
        )
        length = define(f"{drive_name}_length", sp.sqrt(x**2 + y**2), None, "its length")
        direction_x, direction_y = (
            define(f"{drive_name}_along_{axis}", value / length, None, "its direction")
            for axis, value in zip("xy", (x, y), strict=True)
        )
        rules[length], rules[direction_x], rules[direction_y] = {}, {}, {}
        for q in [*(q for q, _ in self._find_coordinate_pairs(self._list_bodies(first_point, second_point))), self.t]:
            dx, dy = (self.symbols.differentiate(value, q) for value in difference)
            if dx == dy == 0:
                continue
            rules[length][q] = direction_x * dx + direction_y * dy
            turning_rate = (direction_x * dy - direction_y * dx) / length
            rules[direction_x][q], rules[direction_y][q] = -direction_y * turning_rate, direction_x * turning_rate
        return length

    def define_drive_value(self, drive: Drive) -> sp.Symbol:
        """Return the symbol of the prescribed function f(t) of a drive.

        At the first call f, f′ and f″ are defined as symbols with rules for the derivatives by t, and stored in
        `drive_functions`.
        """
        if drive.name in self.drive_functions:
            return self.drive_functions[drive.name][0]
        parameter_table, define = self.geometry.parameter_table, self.symbols.add_definition

        def find_symbol(path: str) -> sp.Symbol:
            """Return the symbol of time or of a parameter by its name in the file."""
            return self.t if path == "t" else parameter_table.entries[f"parameters.{path}"].symbol

        expression = convert_quantity_to_sympy(drive.value, find_symbol)
        f = define(f"{drive.name}_value", expression, None, f"drive {drive.name}")
        first_derivative = _differentiate_by_time(expression, self.t)
        rate = define(f"{drive.name}_rate", first_derivative, None, "its rate")
        second_derivative = define(
            f"{drive.name}_acceleration", _differentiate_by_time(first_derivative, self.t), None, "its second rate"
        )
        self.symbols.derivative_rules[f], self.symbols.derivative_rules[rate] = (
            {self.t: rate},
            {self.t: second_derivative},
        )
        self.drive_functions[drive.name] = f, rate, second_derivative
        return f

    @staticmethod
    def _list_bodies(*points: PointFrame) -> list[BodySymbols]:
        """Return the bodies of some points, without the ground, in the order of the points."""
        return [point.body for point in points if point.body is not None]

    def _derive_row(self, name: str, owner: str, kind: str, unit: str, phi: sp.Expr, bodies: list[BodySymbols]) -> Row:
        """Return the constraint equation `phi` = 0 with Φ_q, Φ_q q̇, ν and γ by differentiation.

        `name`, `owner` (joint or drive), `kind` and `unit` are stored in the row. `bodies`: those on which phi depends.
        γ is expanded unless that needs more operations.
        """
        diff, t = self.symbols.differentiate, self.t
        coordinate_pairs = self._find_coordinate_pairs(bodies)
        phi_q = {q: entry for q, _ in coordinate_pairs if (entry := sp.expand(diff(phi, q))) != 0}
        phi_q_v = sum((phi_q[q] * v for q, v in coordinate_pairs if q in phi_q), sp.Integer(0))
        phi_t = diff(phi, t)
        gamma = (
            -sum((diff(phi_q_v, q) * v for q, v in coordinate_pairs), sp.Integer(0))
            - 2 * diff(phi_q_v, t)
            - diff(phi_t, t)
        )
        gamma = min(sp.expand(gamma), gamma, key=sp.count_ops)
        return Row(name, owner, kind, unit, phi, phi_q, phi_q_v, -phi_t, gamma)


@lru_cache(maxsize=256)
def has_jumping_rate(drive: Drive) -> bool:
    """Return whether the rate of a drive may jump: its expression has switching points or the root of a square.

    At such a jump the velocities of the linkage jump too, by an impulse. Results are cached.
    """
    if not WITH_SWITCHING_POINTS.isdisjoint(list_functions(drive.value.value)):
        return True
    return bool(convert_to_sympy(drive.value.value, lambda path: sp.Symbol(path, real=True)).has(sp.Abs))


_SWITCHING_CLASSES = (
    Select,
    FrozenSign,
    BranchSign,
    DifferentiableMax,
    DifferentiableMin,
    sp.Abs,
    sp.Max,
    sp.Min,
    sp.sign,
    sp.Heaviside,
    sp.DiracDelta,
)


def _differentiate_by_time(value: sp.Expr, t: sp.Symbol) -> sp.Expr:
    """Return d/dt of the expression of a drive, without Dirac deltas: a jump of the value contributes no rate.

    Only the active branch of min, max, abs and `where` is differentiated. Where several arguments of max or min are
    equal, the rate is that of one of them.
    """
    if value.has(*_SWITCHING_CLASSES):
        value = value.replace(Select, lambda branch, a, b: Select(branch.replace(sp.sign, BranchSign), a, b))
        value = (
            value.replace(sp.Abs, _make_differentiable_abs)
            .replace(sp.Max, DifferentiableMax)
            .replace(sp.Min, DifferentiableMin)
        )
    rate = compute_partial_derivative(value, t)
    if not rate.has(*_SWITCHING_CLASSES):
        return rate
    rate = rate.replace(sp.DiracDelta, lambda *_: sp.Integer(0))
    rate = rate.replace(FrozenSign, sp.sign).replace(sp.sign, lambda x: 2 * sp.Heaviside(x) - 1)
    return rate.replace(BranchSign, sp.sign).replace(DifferentiableMax, sp.Max).replace(DifferentiableMin, sp.Min)


def _make_differentiable_abs(x: sp.Expr) -> sp.Expr:
    """Return |x|: Abs(x) if x is known to be real, else x times its sign as a factor with derivative 0.

    SymPy differentiates the second form without real and imaginary parts. An example is x = acos(t) beyond t = 1.
    """
    return sp.Abs(x) if x.is_real else x * FrozenSign(x)
