"""Angles and displacements of bodies as affine functions of tree coordinates, with rates and derivatives.

A frame turns with an angle that is affine in the coordinates, θ = const + Σ c_k z_k; the z are the unknown
coordinates s and those that drives prescribe. Bodies that keep their angle to each other share a frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.symbols import Symbols

Affine = Mapping[str, sp.Expr]  # coefficients by coordinate; the constant is under ""
CONSTANT = ""


def substitute_coordinate(affine: Affine, name: str, value: Affine) -> Affine:
    """Return the affine expression `affine` with the coordinate `name` replaced by `value`, also affine.

    Affine expressions are coefficients by coordinate, the constant under "". Zero coefficients are left out. `affine`
    is returned unchanged if it does not contain the coordinate.
    """
    if name not in affine:
        return affine
    result = {k: coefficient for k, coefficient in affine.items() if k != name}
    for k, coefficient in value.items():
        result[k] = sp.expand(result.get(k, sp.Integer(0)) + affine[name] * coefficient)
    return {k: coefficient for k, coefficient in result.items() if coefficient != 0}


ZERO, ONE = sp.Integer(0), sp.Integer(1)
Pair = tuple[sp.Expr, sp.Expr]


@dataclass(frozen=True)
class Coordinate:
    """A coordinate with its rate; `acceleration` is set if a drive prescribes it, else None."""

    name: str
    q: sp.Symbol
    v: sp.Symbol
    acceleration: sp.Expr | None = None


@dataclass(frozen=True)
class Frame:
    """Directions that turn together; `angle_coefficients` are the c_k by coordinate, empty for the ground's."""

    name: str
    theta: sp.Expr
    omega: sp.Expr
    cos: sp.Expr
    sin: sp.Expr
    angle_coefficients: Mapping[str, sp.Expr]


class Motions:
    """Values and rates of affine quantities, with the rules by which their symbols are differentiated.

    An affine quantity is an angle or a slide: a linear combination of coordinates plus a constant.
    """

    def __init__(self, symbols: Symbols, parameter_table: ParameterTable, t: sp.Symbol) -> None:
        """Begin without coordinates and arms; the caller adds to `coordinates`.

        `t`: the symbol of time.
        """
        self.symbols, self.parameter_table, self.t = symbols, parameter_table, t
        self.coordinates: dict[str, Coordinate] = {}
        self._arms: dict[tuple[str, sp.Expr, sp.Expr], Pair] = {}

    def derive_coefficients(self, name: str, affine: Affine) -> Affine:
        """Return an affine expression (coefficients by coordinate) with its coefficients as derived parameters.

        `name`: base of their names, which end in "_by_<coordinate>" or "_by_constant".
        """
        return {k: self.parameter_table.derive_parameter(f"{name}_by_{k or 'constant'}", c) for k, c in affine.items()}

    def compute_value(self, affine: Affine) -> sp.Expr:
        """Return the value of an affine expression: the constant plus Σ coefficient · coordinate."""
        terms = (c if k == CONSTANT else c * self.coordinates[k].q for k, c in affine.items())
        return sp.Add(*terms)

    def compute_rate(self, affine: Affine) -> sp.Expr:
        """Return the rate of an affine expression: Σ coefficient · rate of the coordinate."""
        return sp.Add(*(c * self.coordinates[k].v for k, c in affine.items() if k != CONSTANT))

    def find_derivative_rules(self, partials: Mapping[str, sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
        """Return the derivatives of a quantity by unknown coordinates and by t, as a mapping {variable: derivative}.

        `partials`: its derivatives ∂/∂z by all coordinates z. The prescribed ones give the derivative by t, Σ ∂/∂z ż;
        it is absent if it is 0.
        """
        rules: dict[sp.Symbol, sp.Expr] = {}
        time_derivative = ZERO
        for k, column in partials.items():
            coordinate = self.coordinates[k]
            if coordinate.acceleration is None:
                rules[coordinate.q] = column
            else:
                time_derivative += column * coordinate.v
        return rules | ({self.t: time_derivative} if time_derivative != 0 else {})

    def find_rate_derivative_rules(self, partials: Mapping[str, sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
        """Return the derivatives of a rate Σ ∂/∂z ż by unknown coordinates, their rates and t, as a mapping by symbol.

        `partials`: the derivatives ∂/∂z of the quantity by all coordinates z, which depend on the motion themselves.
        """
        variables = [self.coordinates[k].q for k in partials if self.coordinates[k].acceleration is None] + [self.t]
        rate = sp.Add(*(entry * self.coordinates[k].v for k, entry in partials.items()))
        rules = {q: value for q in variables if (value := self.symbols.differentiate(rate, q)) != 0}
        for k, entry in partials.items():
            if self.coordinates[k].acceleration is None:
                rules[self.coordinates[k].v] = entry
        return rules

    def define_value(self, base_name: str, value: sp.Expr, partials: Mapping[str, sp.Expr]) -> sp.Symbol:
        """Return a new symbol for `value`, a quantity whose derivatives by coordinate are `partials`.

        `base_name`: base of its name. The symbol is entered in `symbols` with definition and derivative rules.
        """
        symbol = self.symbols.add_definition(base_name, value)
        self.symbols.derivative_rules[symbol] = self.find_derivative_rules(partials)
        return symbol

    def define_rate(self, base_name: str, value: sp.Expr, partials: Mapping[str, sp.Expr]) -> sp.Symbol:
        """Return a new symbol for `value`, the velocity of a quantity whose derivatives by coordinate are `partials`.

        `base_name`: base of its name. The symbol is entered in `symbols` with definition and derivative rules.
        """
        symbol = self.symbols.add_definition(base_name, value)
        self.symbols.derivative_rules[symbol] = self.find_rate_derivative_rules(partials)
        return symbol

    def make_frame(self, name: str, affine: Affine) -> Frame:
        """Return the frame that turns with the angle θ = `affine`; cosine and sine are symbols with derivative rules.

        The angle and its rate become symbols of their own, unless they are symbols already or the rate is 0. `name`:
        base of their names.
        """
        angle_coefficients = {k: c for k, c in affine.items() if k != CONSTANT}
        theta, omega = self.compute_value(affine), self.compute_rate(affine)
        if not theta.is_Symbol:
            theta = self.define_value(f"{name}_angle", theta, angle_coefficients)
        if not omega.is_Symbol and omega != 0:
            omega = self.define_rate(f"{name}_rate", omega, angle_coefficients)
        cos = self.symbols.add_definition(f"cos_theta_{name}", sp.cos(theta), None, f"cos of {name}.theta")
        sin = self.symbols.add_definition(f"sin_theta_{name}", sp.sin(theta), None, f"sin of {name}.theta")
        frame = Frame(name, theta, omega, cos, sin, angle_coefficients)
        self.symbols.derivative_rules[cos] = self.find_derivative_rules(
            {k: -c * sin for k, c in angle_coefficients.items()}
        )
        self.symbols.derivative_rules[sin] = self.find_derivative_rules(
            {k: c * cos for k, c in angle_coefficients.items()}
        )
        return frame

    def rotate_vector(self, frame: Frame, w: Pair, base_name: str) -> Pair:
        """Return A(θ) w (rotation matrix times vector), the vector with components w in a frame, in ground axes.

        It is w itself for the ground or for w = (0, 0). Components that are both −1, 0 or 1 give expressions in the
        frame's cos θ and sin θ. Any other w gets a pair of symbols, made once. If −w has symbols, their negatives are
        returned. `base_name`: base of the symbols' names.
        """
        x, y = w
        if not frame.angle_coefficients or w == (ZERO, ZERO):
            return w
        if all(part in (-1, 0, 1) for part in w):
            return frame.cos * x - frame.sin * y, frame.sin * x + frame.cos * y
        if (frame.name, -x, -y) in self._arms:
            a_x, a_y = self._arms[frame.name, -x, -y]
            return -a_x, -a_y
        if (frame.name, x, y) not in self._arms:
            a_x = self.symbols.add_definition(f"{base_name}_x", frame.cos * x - frame.sin * y, None, "A(theta) s, x")
            a_y = self.symbols.add_definition(f"{base_name}_y", frame.sin * x + frame.cos * y, None, "A(theta) s, y")
            self.symbols.derivative_rules[a_x] = self.find_derivative_rules(
                {k: -c * a_y for k, c in frame.angle_coefficients.items()}
            )
            self.symbols.derivative_rules[a_y] = self.find_derivative_rules(
                {k: c * a_x for k, c in frame.angle_coefficients.items()}
            )
            self._arms[frame.name, x, y] = a_x, a_y
        return self._arms[frame.name, x, y]

    def add_derived_vector(self, base_name: str, vector: Pair, member_base_name: str = "") -> Pair:
        """Return the components of a constant vector as derived parameters, which C computes once a run.

        A component whose value or opposite value is a parameter already gives ± that parameter. `base_name`: base of
        the names; `member_base_name`: base of the names of the members of Parameters in C, "" if it is the same.
        """
        x, y = (
            self.parameter_table.derive_signed_parameter(
                f"{base_name}_{axis}",
                sp.expand(part),
                "vector in its frame",
                f"{member_base_name}_{axis}" if member_base_name else "",
            )
            for axis, part in zip("xy", vector, strict=True)
        )
        return x, y
