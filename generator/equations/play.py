"""A joint with play: eccentricity, its rate, and the force laws that act in it (physics.md, sections 2 to 4)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import sympy as sp

from gudgeon.generator.equations.contact_points import ContactPoint, Wall, iterate_contact_points
from gudgeon.generator.equations.geometry import Geometry, PointFrame
from gudgeon.generator.equations.loads import PointLoad
from gudgeon.generator.equations.user_defined_laws import (
    check_sampled_values,
    find_default_value,
    read_force_expression,
)
from gudgeon.generator.kinds.laws.built import build_law
from gudgeon.generator.kinds.laws.law import (
    MAX_PENETRATION,
    MEAN_CLEARANCE,
    RESULTS,
    USER_LAWS,
    VARIABLES,
    Law,
    LawInputs,
    PairSymbols,
    State,
    find_all_laws,
)
from gudgeon.generator.mechanism import Joint, LawUse, Play
from gudgeon.generator.symbols.curves import make_contour_expression
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.unevaluated import Unevaluated
from gudgeon.language.units import VELOCITY

Derive: TypeAlias = Callable[[str, sp.Expr, str], sp.Expr]  # name, value, meaning: the symbol of a derived parameter
VELOCITY_FLOOR = 1e-6  # m/s, lower bound of the approach speed that an onset stores


@dataclass(frozen=True)
class LawEquations:
    """A law with its symbols filled in; `equations_by_name` are abbreviations, then the results of its role.

    `variables` are the arguments of its function: those of its role, and others that it reads. `numbers` are
    parameters by their names in the file, `derived` those that the law computes from them and from the pair.
    """

    law: Law
    options: Mapping[str, str | bool]
    variables: tuple[sp.Symbol, ...]
    equations_by_name: Mapping[str, sp.Expr]
    parameters: Mapping[str, sp.Expr]
    derived: Mapping[str, sp.Expr]

    @property
    def results(self) -> tuple[str, ...]:
        """Return the names in `equations_by_name` of results, such as "F_n", and of the rates of internal states."""
        return tuple(make_law_identifier(self.law, name) for name in self.law.results)

    @property
    def optional_variables(self) -> tuple[str, ...]:
        """Return the names of the variables outside its role that the law reads.

        The role is normal, friction, film or mixed.
        """
        return tuple(symbol.name for symbol in self.variables if symbol.name in self.law.optional_variables)


@dataclass(frozen=True)
class Contour:
    """The depth of a bearing beyond its circle at `count` equal angles in its frame, as an array of Parameters."""

    table: str
    count: int

    def compute_depth(self, angle: sp.Expr, order: int) -> sp.Expr:
        """Return the depth w in m beyond the bearing's circle at an angle, or its derivative of an `order` by it."""
        return make_contour_expression(self.table, self.count, order, angle)


@dataclass(frozen=True)
class Clearance:
    """Contact point of a joint with play: bearing i on the first body, journal j on the second, e = r_j − r_i.

    All vectors are in ground axes. Each corner of a slider in a guide is one, "guide.front_upper"; `label` is its name
    in code.
    """

    name: str
    label: str
    joint: Joint
    first: PointFrame
    second: PointFrame
    pair: PairSymbols
    normal: LawEquations | None
    friction: LawEquations | None
    film: LawEquations | None
    transition: sp.Expr | None
    mixed: LawEquations | None  # of mixed lubrication, in place of a transition
    velocity_floor: sp.Expr
    clip_ratio: bool
    constants: Mapping[str, sp.Expr]  # constants in a report: K, S, …
    contour: Contour | None = None
    wall: Wall | None = None

    @property
    def kind(self) -> str:
        """Return the word for the contact point in comments: "joint" for a journal, "corner" for a slider's corner."""
        return "corner" if self.wall else "joint"

    @property
    def laws(self) -> tuple[LawEquations, ...]:
        """Return the laws that act here, as far as present, in the order normal, friction, film, mixed."""
        return tuple(law for law in (self.normal, self.friction, self.film, self.mixed) if law is not None)

    @property
    def rigid(self) -> bool:
        """Return whether the surfaces are rigid: velocities jump, and a lasting contact is a constraint."""
        return self.normal is not None and self.normal.law.rigid

    @property
    def states(self) -> tuple[State, ...]:
        """Return the internal states of the laws (bristle states); only friction laws have any."""
        return self.friction.law.states if self.friction else ()

    @property
    def surface_arguments(self) -> tuple[sp.Expr, ...]:
        """Return the arguments by the surface of the joint's functions, in addition to e, ė and angular velocities.

        They are the normal of a wall, or the angle of a bearing with a contour; () for a circular bearing.
        """
        if self.wall is not None:
            return self.wall.normal
        return (self.first.theta,) if self.contour else ()

    @property
    def eccentricity(self) -> tuple[sp.Expr, sp.Expr]:
        """Return the eccentricity e = r_j − r_i in m."""
        return self.second.x - self.first.x, self.second.y - self.first.y

    @property
    def eccentricity_rate(self) -> tuple[sp.Expr, sp.Expr]:
        """Return the rate ė of the eccentricity in m/s."""
        (vx_i, vy_i), (vx_j, vy_j) = self.first.velocity, self.second.velocity
        return vx_j - vx_i, vy_j - vy_i

    def list_point_loads(self, F: Sequence[sp.Expr], moments: Sequence[sp.Expr]) -> list[PointLoad]:
        """Return the loads on both bodies: −F and moments[0] on the bearing, F and moments[1] on the journal."""
        return [PointLoad(self.first, -F[0], -F[1], moments[0]), PointLoad(self.second, F[0], F[1], moments[1])]

    def compute_power(self, F: Sequence[sp.Expr], edot: Sequence[sp.Expr], moments: Sequence[sp.Expr]) -> sp.Expr:
        """Return the power F · ė + M_i ω_i + M_j ω_j in W; F acts on the journal, `moments` are (M_i, M_j)."""
        turning = moments[0] * self.first.omega + moments[1] * self.second.omega
        return F[0] * edot[0] + F[1] * edot[1] + turning


def make_clearances(joint: Joint, play: Play, geometry: Geometry, parameter_table: ParameterTable) -> list[Clearance]:
    """Return the equations of one joint with play, one Clearance for each of its one or four contact points."""
    clearances = [
        _derive_clearance(joint, play, parameter_table, point)
        for point in iterate_contact_points(joint, play.bearing, geometry, parameter_table)
    ]
    return [replace(clearance, contour=_make_contour(joint, play, parameter_table)) for clearance in clearances]


def _derive_clearance(
    joint: Joint, play: Play, parameter_table: ParameterTable, contact_point: ContactPoint
) -> Clearance:
    """Return the equations at one contact point: laws with parameters, transition, and bound of the approach speed.

    The constants that a report prints are collected in `constants`.
    """
    constants: dict[str, sp.Expr] = {}
    bearing_symbols = contact_point.pair

    def derive_constant(name: str, expression: sp.Expr, meaning: str) -> sp.Expr:
        """Return a derived parameter named after contact and bearing, and record it among the constants.

        Joints with the same contact and bearing share it.
        """
        parameter_name = f"{play.contact.name}_{play.bearing.name}_{name}"
        constants[name] = parameter_table.derive_parameter(parameter_name, expression, meaning)
        return constants[name]

    def derive_contact_law(
        law_use: LawUse | None, symbols: PairSymbols = contact_point.law_symbols
    ) -> LawEquations | None:
        """Return a law of the contact with its symbols, or None if `law_use` is None.

        `symbols`: radii, clearance and elastic constants.
        """
        return None if law_use is None else _make_law_equations(law_use, symbols, parameter_table, derive_constant)

    contact = play.contact
    normal, friction, mixed = (
        derive_contact_law(contact.normal),
        derive_contact_law(contact.friction),
        derive_contact_law(contact.mixed),
    )
    film_symbols = replace(bearing_symbols, c=constants.get(MEAN_CLEARANCE, bearing_symbols.c))
    film = derive_contact_law(contact.film, film_symbols)
    floor: sp.Expr = sp.Integer(0)  # only of compliant surfaces
    if contact.velocity_floor:
        floor = parameter_table.get_or_add_parameter(contact.velocity_floor)
    elif not (normal and normal.law.rigid):
        floor = parameter_table.get_or_add_constant(
            f"contacts.{contact.name}.velocity_floor", "velocity_floor", VELOCITY_FLOOR, VELOCITY
        )
    transition = parameter_table.get_or_add_parameter(contact.transition) if contact.transition is not None else None
    constants["c"], constants["R_i"], constants["R_j"] = bearing_symbols.c, bearing_symbols.R_i, bearing_symbols.R_j
    return Clearance(
        contact_point.name,
        contact_point.label,
        joint,
        contact_point.first,
        contact_point.second,
        bearing_symbols,
        normal,
        friction,
        film,
        transition,
        mixed,
        floor,
        contact.clip_ratio,
        constants,
        wall=contact_point.wall,
    )


def _make_contour(joint: Joint, play: Play, parameter_table: ParameterTable) -> Contour | None:
    """Return the contour of a bearing, whose depths become an array of parameters; None if it is a circle."""
    if not play.contour:
        return None
    return Contour(parameter_table.get_or_add_array(f"contour_{joint.name}", play.contour), len(play.contour))


def _make_law_equations(
    law_use: LawUse, bearing_symbols: PairSymbols, parameter_table: ParameterTable, derive_constant: Derive
) -> LawEquations:
    """Return the equations of a law, with the symbols of its parameters and variables inserted.

    `law_use`: the law as the file uses it; `derive_constant` makes a derived parameter from name, value and meaning.
    Optional variables that the law does not read are left out. A user-defined law is evaluated at sampled states, which
    raises LawError for invalid values, and its own names get the ending `__`.
    """
    law = find_all_laws()[law_use.law]
    variables = {name: sp.Symbol(name, real=True) for name in law.variables}
    force_names = {force.name for force in law.expressions}
    parameters = {
        name: parameter_table.get_or_add_parameter(quantity)
        for name, quantity in law_use.quantities.items()
        if name not in force_names
    }
    for name in force_names:
        max_penetration = find_default_value(parameter_table, parameters.get(MAX_PENETRATION, bearing_symbols.c))
        parameters[name] = read_force_expression(
            law_use.quantities[name], variables["delta"], max_penetration, parameter_table
        )
    derived: dict[str, sp.Expr] = {}

    def derive_and_record(name: str, expression: sp.Expr, meaning: str) -> sp.Expr:
        """Return a derived parameter and record it under its name in the law."""
        derived[name] = derive_constant(name, expression, meaning)
        return derived[name]

    equations_by_name = build_law(
        law, LawInputs(parameters, law_use.options, bearing_symbols, variables, derive_and_record, Unevaluated)
    )
    read_names = {symbol.name for step in equations_by_name.values() for symbol in step.free_symbols}
    unused_names = {name for name in law.optional_variables if name not in read_names}
    law_variables = tuple(symbol for name, symbol in variables.items() if name not in unused_names)
    if law.name in USER_LAWS:
        check_sampled_values(law, law_variables, equations_by_name, parameter_table)
    equations = LawEquations(law, law_use.options, law_variables, equations_by_name, parameters, derived)
    return _rename_user_law(equations) if law.name in USER_LAWS else equations


def make_law_identifier(law: Law, name: str) -> str:
    """Return the name that `name`, a parameter, abbreviation, state or result of a law, has in emitted code.

    It is unchanged, except in a user-defined law: there the ending `__` is appended, unless the role of the law defines
    the name (`delta`, `F_n`). No fixed name contains `__`, and neither does a result of `make_identifier`.
    """
    fixed = {*VARIABLES[law.role], *law.optional_variables, *RESULTS[law.role]}
    return f"{name}__" if law.name in USER_LAWS and name not in fixed else name


def _rename_user_law(equations: LawEquations) -> LawEquations:
    """Return the equations of a user-defined law with the ending `__` on its abbreviations and internal states.

    Names that the role of the law defines stay (`make_law_identifier`).
    """
    law = equations.law
    symbols = {
        sp.Symbol(name, real=True): sp.Symbol(make_law_identifier(law, name), real=True)
        for name in (*equations.equations_by_name, *(state.name for state in law.states))
    }
    equations_by_name = {
        make_law_identifier(law, name): value.xreplace(symbols) for name, value in equations.equations_by_name.items()
    }
    return replace(
        equations, variables=tuple(symbols.get(s, s) for s in equations.variables), equations_by_name=equations_by_name
    )
