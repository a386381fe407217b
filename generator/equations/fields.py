"""Values of a joint's or a force element's keys as SymPy expressions, for the files that define these types."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise

import sympy as sp

from gudgeon.errors import Location
from gudgeon.generator.equations.geometry import Geometry, PointFrame
from gudgeon.generator.mechanism import GROUND, ForceElement, Joint, PointRef, Quantity, Vector
from gudgeon.generator.symbols.derivatives import differentiate
from gudgeon.generator.symbols.from_expressions import convert_quantity_to_sympy
from gudgeon.generator.symbols.parameter_table import ParameterRole, ParameterTable
from gudgeon.language.tree import Name, iterate_names

ZERO = sp.Integer(0)


class JointFields:
    """The fields that the file of a joint type may read; values are parameters or derived parameters."""

    def __init__(self, joint: Joint, geometry: Geometry) -> None:
        """Begin with one joint, whose fields become parameters of the geometry's table when they are read."""
        self._joint, self._parameter_table, self._geometry = joint, geometry.parameter_table, geometry

    def direction(self, name: str) -> tuple[sp.Expr, sp.Expr]:
        """Return a vector field as a unit vector in its body's frame: exactly ±1 and 0 along an axis."""
        return derive_unit_vector(self._joint.vectors[name], self._joint.name, name, self._parameter_table)

    def derive_vector_angle(self, name: str) -> sp.Expr:
        """Return the angle of a vector field in its body's frame, in rad, as a derived parameter."""
        x, y = self.direction(name)
        return self._parameter_table.derive_parameter(
            f"{self._joint.name}_{name}_angle",
            sp.atan2(y, x),
            "direction of the axis",
            role=ParameterRole(self._joint.name, f"{name}_angle"),
        )

    def quantity(self, name: str, default: sp.Expr) -> sp.Expr:
        """Return a number field as a parameter, or `default` if the file does not give it."""
        quantity = self._joint.quantities.get(name)
        return sp.sympify(default) if quantity is None else self._parameter_table.get_or_add_parameter(quantity)

    def vector(self, name: str) -> tuple[sp.Expr, sp.Expr]:
        """Return both components of a vector field as parameters."""
        x, y = self._joint.vectors[name]
        return self._parameter_table.get_or_add_parameter(x), self._parameter_table.get_or_add_parameter(y)

    def option(self, name: str) -> str:
        """Return the value of a field with fixed choices."""
        return self._joint.options[name]

    def body_angle(self, name: str) -> sp.Expr:
        """Return θ of the body that a body field names; 0 for the ground."""
        body = self._joint.options[name]
        return ZERO if body == GROUND else self._geometry.bodies[body].theta

    def rotate_direction(self, name: str, body: str) -> tuple[sp.Expr, sp.Expr]:
        """Return a unit vector field in ground axes; it is fixed in the body that the field `body` names.

        A direction of the ground is returned unchanged.
        """
        local, owner = self.direction(name), self._joint.options[body]
        if owner == GROUND:
            return local
        return self._geometry.rotate_vector(self._geometry.bodies[owner], local, f"axis_{owner}")

    def define_profile(self, name: str, cam: sp.Expr, carrier: sp.Expr) -> sp.Expr:
        """Return the profile of a cam as a symbol with rules for its derivatives.

        It is a function of phi = `cam` − `carrier`, both angles in rad. `name`: the field that holds the expression.
        The value and its first three derivatives by phi become symbols.
        """
        symbols, phi, parameter_table = (
            self._geometry.symbols,
            sp.Dummy("phi", real=True),
            self._parameter_table.entries,
        )
        value = convert_quantity_to_sympy(
            self._joint.quantities[name],
            lambda path: phi if path == "phi" else parameter_table[f"parameters.{path}"].symbol,
        )
        derivatives, angle = [], cam - carrier
        for suffix in ("", "_slope", "_bend", "_third"):
            meaning = f"{suffix[1:] or 'value'} of {self._joint.name}'s {name}"
            derivatives.append(
                symbols.add_definition(
                    f"{self._joint.name}_{name}{suffix}", value.xreplace({phi: angle}), None, meaning
                )
            )
            value = differentiate(value, phi)
        bases = sorted({base for s in angle.free_symbols for base in symbols.derivative_rules.get(s, (s,))}, key=str)
        rates = {base: rate for base in bases if (rate := symbols.differentiate(angle, base)) != 0}
        for function, next_derivative in pairwise(derivatives):
            symbols.derivative_rules[function] = {base: rate * next_derivative for base, rate in rates.items()}
        return derivatives[0]

    def derive_parameter(self, name: str, expression: sp.Expr) -> sp.Expr:
        """Return `expression`, of parameters alone, as a derived parameter "<joint>_<name>", computed once a run."""
        return self._parameter_table.derive_parameter(
            f"{self._joint.name}_{name}",
            expression,
            f"of joint {self._joint.name}",
            role=ParameterRole(self._joint.name, name),
        )

    def evaluate_at_guess(self, name: str, expression: sp.Expr) -> sp.Expr:
        """Return `expression` as a derived parameter `name`, with each body's angle at its value in the file's `start`.

        An example is the meshing of gears. A value in `set` has precedence over one in `guess`; an angle with neither
        is 0.
        """
        start = self._geometry.mechanism.start
        values = {}
        for body in self._geometry.bodies.values():
            key = f"{body.name}.theta"
            quantity = start.set.get(key) or start.guess.get(key)
            values[body.theta] = ZERO if quantity is None else self._parameter_table.get_or_add_parameter(quantity)
        return self.derive_parameter(name, expression.xreplace(values))


def derive_unit_vector(
    vector: Vector, owner: str, name: str, parameter_table: ParameterTable
) -> tuple[sp.Expr, sp.Expr]:
    """Return a vector of the file as a unit vector; along an axis it is exactly (±1, 0) or (0, ±1).

    `owner` and `name`: the joint or element and its field, for the names of derived parameters. The sign of a
    component along an axis is recorded in `parameter_table.signs`: a run must not change it.
    """
    x, y = parameter_table.get_or_add_parameter(vector[0]), parameter_table.get_or_add_parameter(vector[1])
    length = sp.sqrt(x**2 + y**2)

    def derive_component(axis: str, value: sp.Expr, other_value: sp.Expr) -> sp.Expr:
        """Return the component of the unit vector along `axis` ("x" or "y"): 0, ±1, or a derived parameter.

        `value` is the vector's component along the axis, `other_value` the other component. If the other one is 0 and
        `value` is a parameter that does not depend on others, the result is ±1, and the sign is recorded.
        """
        if value == 0:
            return ZERO
        if other_value == 0:
            entry = next((e for e in parameter_table.entries.values() if e.symbol == value), None)
            if entry is not None and not entry.depends_on_parameters:  # the equations depend only on its sign
                if entry.address not in parameter_table.signs:
                    parameter_table.signs[entry.address] = ">" if entry.default > 0 else "<"
                return sp.Integer(1 if entry.default > 0 else -1)
        return parameter_table.derive_parameter(
            f"{owner}_{name}_{axis}", value / length, "unit vector", role=ParameterRole(owner, name, axis)
        )

    return derive_component("x", x, y), derive_component("y", y, x)


class ElementFields:
    """The fields that the file of a force element type may read."""

    def __init__(self, element: ForceElement, geometry: Geometry, t: sp.Symbol) -> None:
        """Read the fields of one force element; `t` is the symbol of time."""
        self._element, self._geometry, self._t = element, geometry, t

    def direction(self, name: str) -> tuple[sp.Expr, sp.Expr]:
        """Return a vector field as a unit vector; along an axis it is exactly (±1, 0) or (0, ±1)."""
        return derive_unit_vector(self._element.vectors[name], self._element.name, name, self._geometry.parameter_table)

    def quantity(self, name: str) -> sp.Expr:
        """Return a number field as a parameter or expression; 0 if the user specified none."""
        quantity = self._element.quantities.get(name)
        return ZERO if quantity is None else self._convert_quantity(quantity)

    def vector(self, name: str) -> tuple[sp.Expr, sp.Expr]:
        """Return both components of a vector field."""
        x, y = self._element.vectors[name]
        return self._convert_quantity(x), self._convert_quantity(y)

    def option(self, name: str) -> str:
        """Return the value of a field with fixed choices."""
        return self._element.options[name]

    def define_local(self, name: str, value: sp.Expr) -> sp.Expr:
        """Return the symbol of a new local of the emitted code with a value; a number or symbol is itself returned."""
        if value.is_number or value.is_Symbol:
            return value
        return self._geometry.symbols.add_definition(
            f"{self._element.name}_{name}", value, None, f"{name} of {self._element.name}"
        )

    def define_local_vector(self, name: str, value: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        """Return both components as locals of the emitted code, named `name` with _x and _y; see `define_local`."""
        return self.define_local(f"{name}_x", value[0]), self.define_local(f"{name}_y", value[1])

    def _convert_quantity(self, quantity: Quantity) -> sp.Expr:
        """Return a quantity as its parameter, or as its expression if it contains t, coordinates or velocities."""
        variable = MotionNameResolver(self._geometry, self._t)
        if not any(variable.is_variable(name) for name in iterate_names(quantity.value)):
            return self._geometry.parameter_table.get_or_add_parameter(quantity)
        return convert_quantity_to_sympy(quantity, variable)


class MotionNameResolver:
    """Resolver of names in a force's expression: t, parameters, coordinates and velocities of bodies and points."""

    def __init__(self, geometry: Geometry, t: sp.Symbol) -> None:
        """Resolve names on a geometry; `t` is the symbol of time."""
        self._geometry, self._t = geometry, t

    def is_variable(self, name: Name) -> bool:
        """Return whether a name is time or part of the motion, not a parameter."""
        return name.path == "t" or "." in name.path

    def __call__(self, path: str) -> sp.Expr:
        """Return the SymPy expression of a name in a force's expression: "t", "k", "rod.theta" or "rod.head.vx".

        They are time, a parameter, a coordinate or velocity of a body, and a coordinate or velocity of a point.
        """
        if path == "t":
            return self._t
        if "." not in path:
            return self._geometry.parameter_table.entries[f"parameters.{path}"].symbol
        owner, _, component = path.rpartition(".")
        if owner in self._geometry.bodies:
            return getattr(self._geometry.bodies[owner], component)
        body, _, point = owner.partition(".")
        return _POINT_COMPONENTS[component](self._geometry.find_point(PointRef(body, point, _NO_LOCATION)))


_POINT_COMPONENTS: Mapping[str, Callable[[PointFrame], sp.Expr]] = {
    "x": lambda point: point.x,
    "y": lambda point: point.y,
    "vx": lambda point: point.velocity[0],
    "vy": lambda point: point.velocity[1],
}


_NO_LOCATION = Location("", 0, 0)
