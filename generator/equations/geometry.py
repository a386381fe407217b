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
from gudgeon.generator.symbols.storage import Freezable, Place
from gudgeon.generator.symbols.symbols import Symbols

ZERO, ONE = sp.Integer(0), sp.Integer(1)
_SMALL = 1e-12  # m^2: where every point is a centre of mass


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
        """Return the velocity ṙ = (ẋ, ẏ) + ω ẑ × arm."""
        if self.body is None:
            return ZERO, ZERO
        return self.body.vx - self.arm[1] * self.body.omega, self.body.vy + self.arm[0] * self.body.omega

    def direction(self, local: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return a direction that is fixed in the body, in ground axes."""
        return local if self.body is None else self.geometry.turn(self.body, local, f"axis_{self.body.name}")


class Turned(NamedTuple):
    """One component of a vector that turns with a body: of a point's arm or, without a point, of a direction.

    `number` counts the directions of a body.
    """

    body: str
    point: str
    axis: str
    number: int


class Geometry(Freezable):
    """Makes the symbols of bodies and points, each once."""

    def __init__(self, scene: Scene, symbols: Symbols, slots: ParameterTable) -> None:
        """Make the bodies of a scene and the local vectors of all their points."""
        self.symbols, self.slots, self.mechanism = symbols, slots, scene.mechanism
        self.bodies = {name: self._body(i, body) for i, (name, body) in enumerate(self.mechanism.bodies.items())}
        self.local = {
            (body.name, point): self._local(body, point)
            for body in self.mechanism.bodies.values()
            for point in self.point_names(body)
        }
        if is_massless(self.mechanism):
            unit = self._unit_inertia()
            self.bodies = {name: replace(body, mass=ONE, inertia=unit) for name, body in self.bodies.items()}
        self.turned: dict[sp.Symbol, Turned] = {}
        self._turned: dict[tuple[str, sp.Expr, sp.Expr], tuple[sp.Expr, sp.Expr]] = {}
        self._angles: dict[str, tuple[sp.Symbol, sp.Symbol]] = {}

    def _body(self, number: int, body: Body) -> BodySymbols:
        """Return the symbols of the body with a number: three coordinates, three velocities, mass and inertia."""
        new, index, name = self.symbols.new, 3 * number, body.name
        (x, y, theta), (vx, vy, omega) = (
            [new(f"{name}_{c}", Place(array)[index + k], f"{name}.{c}") for k, c in enumerate(coordinates)]
            for array, coordinates in (("q", ("x", "y", "theta")), ("v", ("vx", "vy", "omega")))
        )
        mass, inertia = ONE, ONE
        if not is_massless(self.mechanism) and body.mass and body.inertia:
            mass, inertia = self.slots.use(body.mass), self.slots.use(body.inertia, zero=True)
        return BodySymbols(name, index, x, y, theta, vx, vy, omega, mass, inertia)

    def _unit_inertia(self) -> sp.Expr:
        """Return the inertia that replaces missing ones: of 1 kg at the mean squared distance of all points.

        It defines only the metric in which a closed linkage is solved.
        """
        lengths = [x for pair in self.local.values() for x in pair if x != 0]
        size = sp.Add(*(x**2 for x in lengths)) / max(len(lengths), 1)
        return self.slots.derive("unit_inertia", size + sp.Float(_SMALL, 17), "in place of moments of inertia")

    @staticmethod
    def point_names(body: Body) -> list[str]:
        """Return the names of all points of a body: head, tail, origin and com, then the user's."""
        # the head first: a bar's other points are then written with its positive length
        implied = (["head", "tail"] if body.length else []) + ["origin", "com"]
        return implied + [name for name in body.points if name not in implied]

    def _in_body(self, body: Body, point: str, com: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return a point in the body's own frame, whose origin the user chose."""
        if point in body.points:
            x, y = body.points[point]
            return self.slots.use(x), self.slots.use(y)
        if point == "com":
            return com
        return (self.slots.use(body.length), ZERO) if point == "head" and body.length else (ZERO, ZERO)

    def _local(self, body: Body, point: str) -> tuple[sp.Expr, sp.Expr]:
        """Return a point in the centre-of-mass frame, as derived parameters."""
        if body.com is not None:
            com = (self.slots.use(body.com[0]), self.slots.use(body.com[1]))
        else:
            com = (self.slots.use(body.length) / 2, ZERO) if body.length else (ZERO, ZERO)
        s = self._in_body(body, point, com)
        x, y = (
            self.slots.derive_signed(
                f"{body.name}_{point}_{axis}",
                value - origin,
                "point from the centre of mass",
                f"{body.name}_{point}_s_{axis}",
            )
            for axis, value, origin in zip("xy", s, com, strict=True)
        )
        return x, y

    def ground_vector(self, vector: Vector) -> tuple[sp.Expr, sp.Expr]:
        """Return both components of a vector of the ground as parameters."""
        return self.slots.use(vector[0]), self.slots.use(vector[1])

    def angle(self, body: BodySymbols) -> tuple[sp.Symbol, sp.Symbol]:
        """Return cos θ and sin θ of a body as symbols."""
        if body.name not in self._angles:
            define, name = self.symbols.define, body.name
            cos = define(f"cos_theta_{name}", sp.cos(body.theta), None, f"cos of {name}.theta")
            sin = define(f"sin_theta_{name}", sp.sin(body.theta), None, f"sin of {name}.theta")
            self.symbols.rules[cos], self.symbols.rules[sin] = {body.theta: -sin}, {body.theta: cos}
            self._angles[name] = cos, sin
        return self._angles[body.name]

    def turn(
        self, body: BodySymbols, s: tuple[sp.Expr, sp.Expr], expected: str, point: str = ""
    ) -> tuple[sp.Expr, sp.Expr]:
        """Return A(θ) s as a pair of symbols; the opposite of a known arm is its negative.

        `expected`: base of the symbols' names. `point`: the point whose arm it is.
        """
        if s == (ZERO, ZERO):
            return ZERO, ZERO
        if (body.name, -s[0], -s[1]) in self._turned:
            x, y = self._turned[body.name, -s[0], -s[1]]
            return -x, -y
        if (body.name, *s) not in self._turned:
            cos, sin = self.angle(body)
            if all(component in (-1, 0, 1) for component in s):  # along an axis of the body: cos and sin themselves
                return cos * s[0] - sin * s[1], sin * s[0] + cos * s[1]
            x = self.symbols.define(f"{expected}_x", cos * s[0] - sin * s[1], None, "A(theta) s, x")
            y = self.symbols.define(f"{expected}_y", sin * s[0] + cos * s[1], None, "A(theta) s, y")
            self.symbols.rules[x], self.symbols.rules[y] = {body.theta: -y}, {body.theta: x}
            self._turned[body.name, *s] = x, y
            before = (of for of in self.turned.values() if (of.body, of.point, of.axis) == (body.name, "", "x"))
            number = 1 if point else 1 + sum(1 for _ in before)
            self.turned[x], self.turned[y] = (Turned(body.name, point, axis, number) for axis in ("x", "y"))
        return self._turned[body.name, *s]

    def beside(self, ref: PointRef, offset: tuple[sp.Expr, sp.Expr], expected: str) -> PointFrame:
        """Return the frame of a point at an offset from a named point, given in its body's frame.

        `expected` is the base of its symbols' names.
        """
        s = self._offset_vector(ref, offset, expected)
        if ref.body == GROUND:
            return PointFrame(self, None, s)
        body = self.bodies[ref.body]
        return PointFrame(self, body, self.turn(body, s, f"arm_{expected}"))

    def _offset_vector(self, ref: PointRef, offset: tuple[sp.Expr, sp.Expr], expected: str) -> tuple[sp.Expr, sp.Expr]:
        """Return the vector to such a point from the centre of mass, or its position on the ground.

        The opposite of a known vector is its negative.
        """
        if ref.body == GROUND:
            of = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
        else:
            of = self.local[ref.body, ref.point]
        x, y = (
            more if own == 0 else self.slots.derive_signed(f"{expected}_{axis}", own + more, "corner of a slider")
            for axis, own, more in zip("xy", of, offset, strict=True)
        )
        return x, y

    def point(self, ref: PointRef) -> PointFrame:
        """Return the frame of a named point."""
        if ref.body == GROUND:
            at = self.ground_vector(self.mechanism.ground[ref.point]) if ref.point else (ZERO, ZERO)
            return PointFrame(self, None, at)
        body, s = self.bodies[ref.body], self.local[ref.body, ref.point]
        opposite = (-s[0], -s[1])
        names = self.point_names(self.mechanism.bodies[ref.body])
        twin = next((name for name in names if self.local[ref.body, name] == opposite), None)
        if twin is not None and s[0].could_extract_minus_sign():  # a bar's tail is its head turned over
            x, y = self.turn(body, opposite, f"arm_{ref.body}_{twin}", twin)
            return PointFrame(self, body, (-x, -y))
        return PointFrame(self, body, self.turn(body, s, f"arm_{ref.body}_{ref.point}", ref.point))
