"""Coordinates, angles and points of the bodies, in which all constraint equations and forces are written.

q_i = (x_i, y_i, θ_i) with the origin at the centre of mass (physics.md, section 1). A point is
r = (x, y) + A(θ) s; its arm A(θ) s is a symbol pair that turns: d arm/dθ = ẑ × arm.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import sympy as sp

from gudgeon.generator.mechanism import GROUND, Body, PointRef, Scene, Vector, is_massless
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.storage import Freezable, StorageLocation
from gudgeon.generator.symbols.symbols import Symbols

ZERO, ONE = sp.Integer(0), sp.Integer(1)
_MIN_SQUARED_RADIUS = 1e-12  # m^2: where every point is a centre of mass


@dataclass(frozen=True)
class BodySymbols:
    """Symbols of one body's coordinates and velocities; mass and inertia are parameters (1 if `is_massless`)."""

    name: str
    index: int  # of x in q
    x: sp.Symbol
    y: sp.Symbol
    theta: sp.Symbol
    vx: sp.Symbol
    vy: sp.Symbol
    omega: sp.Symbol
    mass: sp.Expr
    inertia: sp.Expr

    @property
    def q(self) -> tuple[sp.Symbol, sp.Symbol, sp.Symbol]:
        """Return the coordinates (x, y, θ)."""
        return self.x, self.y, self.theta

    @property
    def v(self) -> tuple[sp.Symbol, sp.Symbol, sp.Symbol]:
        """Return the velocities (ẋ, ẏ, ω)."""
        return self.vx, self.vy, self.omega


@dataclass(frozen=True)
class PointFrame:
    """A point of a body (or of the ground: `body` None), with its position, velocity and directions."""

    geometry: Geometry
    body: BodySymbols | None
    arm: tuple[sp.Expr, sp.Expr]  # from the centre of mass, ground axes; the point itself on the ground

    @property
    def x(self) -> sp.Expr:
        """Return the x coordinate in the ground frame."""
        return self.arm[0] + (self.body.x if self.body else ZERO)

    @property
    def y(self) -> sp.Expr:
        """Return the y coordinate in the ground frame."""
        return self.arm[1] + (self.body.y if self.body else ZERO)

    @property
    def theta(self) -> sp.Expr:
        """Return the angle of the point's body; 0 on the ground."""
        return self.body.theta if self.body else ZERO

    @property
    def omega(self) -> sp.Expr:
        """Return the angular velocity of the point's body; 0 on the ground."""
        return self.body.omega if self.body else ZERO

    @property
    def velocity(self) -> tuple[sp.Expr, sp.Expr]:
        """Return the velocity ṙ = (ẋ, ẏ) + ω ẑ × arm; (0, 0) for a point of the ground."""
        if self.body is None:
            return ZERO, ZERO
        return self.body.vx - self.arm[1] * self.body.omega, self.body.vy + self.arm[0] * self.body.omega

    def direction(self, local: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return a direction that is fixed in the body, with `local` its components there, in ground axes."""
        return local if self.body is None else self.geometry.rotate_vector(self.body, local, f"axis_{self.body.name}")


class RotatedComponent(NamedTuple):
    """One component of a vector that turns with a body: of a point's arm or, without a point, of a direction.

    `number` counts the directions of a body.
    """

    body: str
    point: str
    axis: str
    number: int


class Geometry(Freezable):
    """Makes the symbols of bodies and points, each once."""

    def __init__(self, scene: Scene, symbols: Symbols, parameter_table: ParameterTable) -> None:
        """Make the symbols of all bodies of a scene and the vectors from the centres of mass to all points.

        Bodies of a massless mechanism get mass 1 and one moment of inertia, which define a metric.
        """
        self.symbols, self.parameter_table, self.mechanism = symbols, parameter_table, scene.mechanism
        self.bodies = {
            name: self._make_body_symbols(i, body) for i, (name, body) in enumerate(self.mechanism.bodies.items())
        }
        self.local_vectors = {
            (body.name, point): self._derive_local_vector(body, point)
            for body in self.mechanism.bodies.values()
            for point in self.list_point_names(body)
        }
        if is_massless(self.mechanism):
            unit = self._derive_unit_inertia()
            self.bodies = {name: replace(body, mass=ONE, inertia=unit) for name, body in self.bodies.items()}
        self.rotated_components: dict[sp.Symbol, RotatedComponent] = {}
        self._rotated_vectors: dict[tuple[str, sp.Expr, sp.Expr], tuple[sp.Expr, sp.Expr]] = {}
        self._angles: dict[str, tuple[sp.Symbol, sp.Symbol]] = {}

    def _make_body_symbols(self, index: int, body: Body) -> BodySymbols:
        """Return the symbols of the body with an index: three coordinates, three velocities, mass and inertia.

        The symbols are added to the model, mass and inertia to its parameters. If any body of the mechanism lacks a
        mass or an inertia, all bodies get 1 for both; otherwise the body's values are used.
        """
        new, first_index, name = self.symbols.add_symbol, 3 * index, body.name
        (x, y, theta), (vx, vy, omega) = (
            [
                new(f"{name}_{coordinate}", StorageLocation(array)[first_index + k], f"{name}.{coordinate}")
                for k, coordinate in enumerate(coordinates)
            ]
            for array, coordinates in (("q", ("x", "y", "theta")), ("v", ("vx", "vy", "omega")))
        )
        mass, inertia = ONE, ONE
        if not is_massless(self.mechanism) and body.mass and body.inertia:
            mass, inertia = (
                self.parameter_table.get_or_add_parameter(body.mass),
                self.parameter_table.get_or_add_parameter(body.inertia, adds_zero=True),
            )
        return BodySymbols(name, first_index, x, y, theta, vx, vy, omega, mass, inertia)

    def _derive_unit_inertia(self) -> sp.Expr:
        """Return the moment of inertia of every body of a mechanism without masses, as a derived parameter.

        Its value is 1 kg times the mean square of all nonzero components of the points' local vectors, plus
        _MIN_SQUARED_RADIUS. It defines only the metric in which the closed linkage (all joints without play) is
        solved.
        """
        components = [component for vector in self.local_vectors.values() for component in vector if component != 0]
        mean_square = sp.Add(*(component**2 for component in components)) / max(len(components), 1)
        return self.parameter_table.derive_parameter(
            "unit_inertia", mean_square + sp.Float(_MIN_SQUARED_RADIUS, 17), "in place of moments of inertia"
        )

    @staticmethod
    def list_point_names(body: Body) -> list[str]:
        """Return the names of all points of a body: head and tail, origin and com, then the user's.

        Only a body with a length has a head and a tail.
        """
        # the head first: a bar's other points are then written with its positive length
        implied = (["head", "tail"] if body.length else []) + ["origin", "com"]
        return implied + [name for name in body.points if name not in implied]

    def _find_body_vector(self, body: Body, point: str, com: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return a point in the body's own frame, whose origin the user chose, as parameters.

        A point of the file has its coordinates, `com` the centre of mass, and `head` of a bar is (length, 0). Any other
        name, such as `tail` or `origin`, is (0, 0). `com`: the centre of mass in that frame.
        """
        if point in body.points:
            x, y = body.points[point]
            return self.parameter_table.get_or_add_parameter(x), self.parameter_table.get_or_add_parameter(y)
        if point == "com":
            return com
        return (
            (self.parameter_table.get_or_add_parameter(body.length), ZERO)
            if point == "head" and body.length
            else (ZERO, ZERO)
        )

    def _derive_local_vector(self, body: Body, point: str) -> tuple[sp.Expr, sp.Expr]:
        """Return the vector from a body's centre of mass to a point in its frame, as derived parameters.

        Without a specified centre of mass the middle of the length is used, or else the origin.
        """
        if body.com is not None:
            com = (
                self.parameter_table.get_or_add_parameter(body.com[0]),
                self.parameter_table.get_or_add_parameter(body.com[1]),
            )
        else:
            com = (self.parameter_table.get_or_add_parameter(body.length) / 2, ZERO) if body.length else (ZERO, ZERO)
        point_vector = self._find_body_vector(body, point, com)
        x, y = (
            self.parameter_table.derive_signed_parameter(
                f"{body.name}_{point}_{axis}",
                value - origin,
                "point from the centre of mass",
                f"{body.name}_{point}_s_{axis}",
            )
            for axis, value, origin in zip("xy", point_vector, com, strict=True)
        )
        return x, y

    def ground_vector(self, vector: Vector) -> tuple[sp.Expr, sp.Expr]:
        """Return both components of a vector of the ground as parameters; a number 0 in the file gives 0."""
        return self.parameter_table.get_or_add_parameter(vector[0]), self.parameter_table.get_or_add_parameter(
            vector[1]
        )

    def find_cos_and_sin(self, body: BodySymbols) -> tuple[sp.Symbol, sp.Symbol]:
        """Return cos θ and sin θ of a body as symbols with rules for their derivatives, defined at the first call."""
        if body.name not in self._angles:
            define, name = self.symbols.add_definition, body.name
            cos = define(f"cos_theta_{name}", sp.cos(body.theta), None, f"cos of {name}.theta")
            sin = define(f"sin_theta_{name}", sp.sin(body.theta), None, f"sin of {name}.theta")
            self.symbols.derivative_rules[cos], self.symbols.derivative_rules[sin] = (
                {body.theta: -sin},
                {body.theta: cos},
            )
            self._angles[name] = cos, sin
        return self._angles[body.name]

    def rotate_vector(
        self, body: BodySymbols, s: tuple[sp.Expr, sp.Expr], base_name: str, point: str = ""
    ) -> tuple[sp.Expr, sp.Expr]:
        """Return A(θ) s in ground axes (A: rotation matrix), for the components s of a vector in a body's frame.

        A zero vector gives zeros. Components that are all −1, 0 or 1 give expressions in cos θ and sin θ. Any other
        vector gets a pair of symbols with derivative rules, defined once and recorded in `rotated_components`; if −s
        has symbols, their negatives are returned. `base_name`: base of the symbols' names. `point`: the point to which
        the vector leads, or "" for a direction.
        """
        if s == (ZERO, ZERO):
            return ZERO, ZERO
        if (body.name, -s[0], -s[1]) in self._rotated_vectors:
            x, y = self._rotated_vectors[body.name, -s[0], -s[1]]
            return -x, -y
        if (body.name, *s) not in self._rotated_vectors:
            cos, sin = self.find_cos_and_sin(body)
            if all(component in (-1, 0, 1) for component in s):  # along an axis of the body: cos and sin themselves
                return cos * s[0] - sin * s[1], sin * s[0] + cos * s[1]
            x = self.symbols.add_definition(f"{base_name}_x", cos * s[0] - sin * s[1], None, "A(theta) s, x")
            y = self.symbols.add_definition(f"{base_name}_y", sin * s[0] + cos * s[1], None, "A(theta) s, y")
            self.symbols.derivative_rules[x], self.symbols.derivative_rules[y] = {body.theta: -y}, {body.theta: x}
            self._rotated_vectors[body.name, *s] = x, y
            first_components = (
                component
                for component in self.rotated_components.values()
                if (component.body, component.point, component.axis) == (body.name, "", "x")
            )
            direction_number = 1 if point else 1 + sum(1 for _ in first_components)
            self.rotated_components[x], self.rotated_components[y] = (
                RotatedComponent(body.name, point, axis, direction_number) for axis in ("x", "y")
            )
        return self._rotated_vectors[body.name, *s]

    def find_point_at_offset(self, ref: PointRef, offset: tuple[sp.Expr, sp.Expr], base_name: str) -> PointFrame:
        """Return the frame of the point at an offset from a named point; the offset is in the body's frame.

        `base_name` is the base of the names of its symbols.
        """
        s = self._find_offset_vector(ref, offset, base_name)
        if ref.body == GROUND:
            return PointFrame(self, None, s)
        body = self.bodies[ref.body]
        return PointFrame(self, body, self.rotate_vector(body, s, f"arm_{base_name}"))

    def _find_offset_vector(
        self, ref: PointRef, offset: tuple[sp.Expr, sp.Expr], base_name: str
    ) -> tuple[sp.Expr, sp.Expr]:
        """Return the vector from the centre of mass to a point at an offset from a named point, in the body's frame.

        On the ground it is the position; an empty point name there means the origin. The offset is in the same frame. A
        component that is 0 at the named point gives the offset alone, any other a derived parameter (base_name, axis).
        The opposite of a known parameter is its negative.
        """
        if ref.body == GROUND:
            base_vector = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
        else:
            base_vector = self.local_vectors[ref.body, ref.point]
        x, y = (
            increment
            if value == 0
            else self.parameter_table.derive_signed_parameter(
                f"{base_name}_{axis}", value + increment, "corner of a slider"
            )
            for axis, value, increment in zip("xy", base_vector, offset, strict=True)
        )
        return x, y

    def find_point(self, ref: PointRef) -> PointFrame:
        """Return the frame of a named point of a body or of the ground.

        If another point of the body has the opposite vector, its symbols are used with a negative sign. An empty name
        at the ground is its origin. Raise KeyError for an unknown point.
        """
        if ref.body == GROUND:
            position = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
            return PointFrame(self, None, position)
        body, local_vector = self.bodies[ref.body], self.local_vectors[ref.body, ref.point]
        opposite = (-local_vector[0], -local_vector[1])
        names = self.list_point_names(self.mechanism.bodies[ref.body])
        opposite_name = next((name for name in names if self.local_vectors[ref.body, name] == opposite), None)
        if (
            opposite_name is not None and local_vector[0].could_extract_minus_sign()
        ):  # a bar's tail is its head turned over
            x, y = self.rotate_vector(body, opposite, f"arm_{ref.body}_{opposite_name}", opposite_name)
            return PointFrame(self, body, (-x, -y))
        return PointFrame(self, body, self.rotate_vector(body, local_vector, f"arm_{ref.body}_{ref.point}", ref.point))
