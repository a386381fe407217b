"""Functions of a joint with play: force laws, kinematics of the contact, and derivatives of the force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Assignment
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations, make_law_identifier
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder, Section, freeze_branches
from gudgeon.generator.ir.reciprocals import hoist_reciprocals, share_reciprocals
from gudgeon.generator.ir.signatures import BRANCHES, CONTACT, PARAMETERS, Argument, make_output_argument
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.kernels.formulas import format_formulas
from gudgeon.generator.kernels.shared import SharedFunctionCall, SharedFunctions, name_joint_parameters
from gudgeon.generator.kinds.laws.law import USER_LAWS
from gudgeon.generator.solvers.contact_derivatives import (
    DEPTH_STATEMENT,
    make_dry_derivative_kernel,
    make_film_derivative_kernel,
    make_fraction_derivative_kernel,
    read_parameters_from_struct,
    replace_speed_ratio,
)
from gudgeon.generator.symbols.storage import Result, StorageLocation


def make_law_calls(
    model: Model, clearance: Clearance, shared_functions: SharedFunctions
) -> dict[str, SharedFunctionCall]:
    """Return the calls of the laws of a joint with play by role (normal, friction, film), for those that it has.

    The functions of the laws are added to `shared_functions`.
    """
    calls = {}
    for law in (clearance.normal, clearance.friction, clearance.film):
        if law is not None:
            kernel = _make_law_kernel(model, clearance, law)
            names_of_parameters = name_joint_parameters(model, clearance)
            calls[law.law.role] = shared_functions.add_call(
                kernel, names_of_parameters, clearance.label, _find_parameter_meanings(model, law)
            )
    return calls


def _find_parameter_meanings(model: Model, equations: LawEquations) -> dict[str, str]:
    """Return the meaning of each parameter of a law, for comments, by its name in the law's function.

    Derived parameters are included. `equations`: the law with its symbols.
    """
    info = model.symbols.info
    law = equations.law
    derived = {
        make_law_identifier(law, name): info[symbol].meaning
        for name, symbol in equations.derived.items()
        if symbol in info
    }
    return derived | {make_law_identifier(law, parameter.name): parameter.meaning for parameter in law.parameters}


def make_law_name(equations: LawEquations) -> str:
    """Return the C name of a law: its name, then its options with other values than the defaults, joined by "_".

    An option that is True adds its own name, others their value. A user-defined law gets "own_" before its name and
    "__" after it, so that no other function has the name.
    """
    default_options = {option_name.name: option_name.default for option_name in equations.law.options}
    chosen_options = {name: value for name, value in equations.options.items() if value != default_options[name]}
    name = equations.law.name
    name = "_".join(
        [name, *(option_name if value is True else str(value) for option_name, value in chosen_options.items())]
    )
    return f"own_{name}__" if equations.law.name in USER_LAWS else name  # whatever the user calls it, no other function


def _make_law_kernel(model: Model, clearance: Clearance, equations: LawEquations) -> Kernel:
    """Return the kernel of a force law for one joint with play.

    Abbreviations of the law become locals, and its results are written to the arguments "<result>_out". Reciprocals
    are shared, and min, max and similar functions use the frozen branches of the joint's switches.
    """
    results = equations.results
    fields = name_joint_parameters(model, clearance)
    names = {
        symbol: fields[info.storage_location]
        for symbol, info in model.symbols.info.items()
        if info.storage_location in fields
    }
    builder = KernelBuilder(model.symbols, make_law_name(equations), describe_law(equations, names))
    builder.begin_section("")
    for name, equation in equations.equations_by_name.items():
        value = hoist_reciprocals(model.parameter_table, sp.sympify(equation))
        if name in results:
            builder.append_store(Result(f"{name}_out"), value)
        else:
            builder.append_instruction(Statement(name, value))
    variables = (Argument(symbol.name) for symbol in equations.variables)
    result_arguments = (make_output_argument(f"{name}_out") for name in results)
    kernel = builder.build_kernel(
        (*variables, PARAMETERS, *BRANCHES, *result_arguments), inline=True, owner=clearance.name
    )
    return share_reciprocals(kernel)


def describe_law(equations: LawEquations, names: Mapping[sp.Symbol, str] | None = None) -> list[str]:
    """Return the lines of a law's C comment: title, formulas, source, validity, properties, options and their sources.

    `names`: names of parameters in the formulas, by symbol; None: as in the law's file. Sources are those of options
    that differ from the default.
    """
    law = equations.law
    if names is None:
        parameters = {**equations.parameters, **equations.derived}
        names = {symbol: name for name, symbol in parameters.items() if symbol.is_Symbol}
    options_text = [f"{name}: {value}" for name, value in equations.options.items()]
    default_options = {option.name: option.default for option in law.options}
    option_sources = [
        f"Of {value}: {source}."
        for option in law.options
        for value, source in (option.sources or {}).items()
        if value == equations.options.get(option.name) != default_options[option.name]
    ]
    return [
        f"{law.title}.",
        *format_formulas(equations, names),
        f"Source: {law.source}.",
        f"Valid: {law.validity}.",
        *([f"Properties: {law.properties}."] if law.properties else []),
        *([f"Options: {', '.join(options_text)}."] if options_text else []),
        *option_sources,
    ]


Statements = tuple[Statement, ...]
# At e = 0 any direction will do for the normal: the force is isotropic there.
_NORMAL_AT_CENTRE = {contact.n_x: sp.Integer(1), contact.n_y: sp.Integer(0)}
_IS_OFF_CENTRE, _INVERSE_E = Test(contact.e, ">", (0.0,)), sp.Symbol("inverse_e", real=True)
_CONDITIONAL_NORMAL = {
    contact.n_x: Conditional(_IS_OFF_CENTRE, contact.e_x * _INVERSE_E, sp.Integer(1)),
    contact.n_y: Conditional(_IS_OFF_CENTRE, contact.e_y * _INVERSE_E, sp.Integer(0)),
}
_HAS_GRADIENT = Test(contact.scaled_gradient_length, ">", (0.0,))
_CONDITIONAL_CONTOUR = {
    contact.u_x: _CONDITIONAL_NORMAL[contact.n_x],
    contact.u_y: _CONDITIONAL_NORMAL[contact.n_y],
    contact.gradient_length: Conditional(_IS_OFF_CENTRE, contact.scaled_gradient_length * _INVERSE_E, sp.Integer(1)),
}


@dataclass(frozen=True)
class JointFunctions:
    """One joint with play: statements before and after the calls of its laws, in the order of contact_steps.py."""

    clearance: Clearance
    laws: Mapping[str, SharedFunctionCall]  # by role, as far as it has them
    gap: Statements
    before_dry: Statements = ()
    contour_normal_force: Statements = ()  # between the normal law and friction
    after_dry: Statements = ()
    before_film: Statements = ()
    after_film: Statements = ()
    blend: Statements = ()  # the fraction of the dry contact in the transition from film to contact
    switch_indices: range = range(0)  # numbers of its switches

    @property
    def normal_law_extra_variables(self) -> tuple[str, ...]:
        """Return the names of the variables that the normal law reads in addition to δ and δ̇/δ̇⁻."""
        return self.clearance.normal.optional_variables if self.clearance.normal else ()

    @property
    def normal_law_argument_places(self) -> tuple[StorageLocation, ...]:
        """Return the storage locations from which the normal law's arguments other than δ and δ̇/δ̇⁻ are read.

        They are locals of the same names; for rigid surfaces the contact force in the contact state is the only one.
        """
        return (
            (CONTACT["force"],)
            if self.clearance.rigid
            else tuple(map(StorageLocation, self.normal_law_extra_variables))
        )

    @property
    def has_transition(self) -> bool:
        """Return whether the joint blends a film with a dry contact."""
        return self.clearance.film is not None and self.clearance.normal is not None


def make_joint_functions(model: Model, clearance: Clearance, shared_functions: SharedFunctions) -> JointFunctions:
    """Return a joint with play as calls of its laws and the statements before, between and after them.

    The parts are those of JointFunctions: lever arms before the dry contact, its normal force with a contour, its
    moment, the inputs of the film, its moment, the gap, and the blend of film and dry contact. A joint without dry
    contact or film has no statements for it. The functions of its laws are added to `shared_functions`. The numbers of
    its switches are included.
    """
    name, film = clearance.name, clearance.film

    def make_contact_statements(equations: Sequence[Assignment]) -> Statements:
        """Return the statements of equations, with conditional values at the centre and with frozen branches."""
        return _make_joint_statements(model, equations, name, _make_conditional_values(clearance, equations))

    laws, statements_by_part = make_law_calls(model, clearance, shared_functions), {}
    if clearance.normal is not None:
        statements_by_part["before_dry"] = make_contact_statements(
            [replace_speed_ratio(step) for step in contact.make_lever_arm_equations(clearance)]
        )
        statements_by_part["contour_normal_force"] = make_contact_statements(
            contact.make_contour_normal_force(clearance)
        )
        statements_by_part["after_dry"] = make_contact_statements(contact.make_dry_moment_equations(clearance))
    if film is not None:
        statements_by_part["before_film"] = make_contact_statements(contact.make_film_input_equations(clearance, film))
        statements_by_part["after_film"] = make_contact_statements(contact.make_film_moment_equations(film))
    gap = make_contact_statements(contact.make_gap_equations(clearance))
    if film is not None and clearance.normal is not None:
        statements_by_part["blend"] = (
            *((DEPTH_STATEMENT,) if clearance.mixed else ()),
            *make_contact_statements(contact.make_blend_equations(clearance, is_closed=True)),
        )
    indices = [switch.index for switch in model.symbols.switches.list_switches(name)]
    switch_range = range(min(indices, default=0), max(indices, default=-1) + 1)
    return JointFunctions(clearance, laws, gap, switch_indices=switch_range, **statements_by_part)


def _make_conditional_values(clearance: Clearance, equations: Sequence[Assignment]) -> Mapping[sp.Symbol, Conditional]:
    """Return conditional values, by symbol, that replace those `equations` that divide by the eccentricity e.

    A conditional value is a condition, the value if it holds, and the value otherwise. There are three cases:

    - Bearing without a contour: the normal has the condition e > 0, and is (1, 0) otherwise.
    - Flat wall: no equation divides by e, the result is empty.
    - Contour: the direction to the centre and the rate of the contour's angle have the condition e > 0. The normal has
      the condition that the gradient of the contour is not 0.
    """
    if not clearance.contour:
        return {} if clearance.wall else _CONDITIONAL_NORMAL
    value = {equation.symbol: equation.value for equation in equations}
    conditional_values = {
        symbol: Conditional(_HAS_GRADIENT, value[symbol], centre_value)
        for symbol, centre_value in _NORMAL_AT_CENTRE.items()
        if symbol in value
    }
    contour_rate = value.get(contact.beta_rate)
    if contour_rate is not None:
        relative_motion = (contour_rate + contact.omega_i) * contact.e
        conditional_values[contact.beta_rate] = Conditional(
            _IS_OFF_CENTRE, relative_motion * _INVERSE_E - contact.omega_i, -contact.omega_i
        )
    return _CONDITIONAL_CONTOUR | conditional_values


def _make_joint_statements(
    model: Model, equations: Sequence[Assignment], joint_name: str, conditional_values: Mapping[sp.Symbol, Conditional]
) -> Statements:
    """Return equations of a contact as statements that read parameters from their struct and use frozen branches.

    `conditional_values`, by symbol, replace the values of equations that divide by the eccentricity e; with any of
    them, a statement "inverse_e" = 1/e follows that of e. `joint_name`: the name of the joint.
    """
    statements = []
    for equation in equations:
        statements.append(
            Statement(
                equation.symbol.name,
                conditional_values.get(equation.symbol) or read_parameters_from_struct(model, equation.value),
            )
        )
        if equation.symbol == contact.e and conditional_values:  # the contour has a centre
            statements.append(Statement("inverse_e", 1 / contact.e))
    (section,) = freeze_branches(model.symbols.switches, joint_name, [Section("", tuple(statements))])
    return tuple(line for line in section.statements if isinstance(line, Statement))


def make_derivative_calls(
    model: Model, clearance: Clearance, shared_functions: SharedFunctions
) -> dict[str, SharedFunctionCall]:
    """Return the calls of the derivatives of a joint's force by part: "film", "dry", and "share" if it has both.

    "share" is the fraction of the dry contact. The functions are added to `shared_functions`.
    """
    kernels = {}
    if clearance.film is not None:
        kernels["film"] = make_film_derivative_kernel(model, clearance, clearance.film)
    if clearance.normal is not None:
        kernels["dry"] = make_dry_derivative_kernel(model, clearance, clearance.normal)
    if len(kernels) == 2:
        kernels["share"] = make_fraction_derivative_kernel(model, clearance)
    names_of_parameters = name_joint_parameters(model, clearance)
    return {
        part: shared_functions.add_call(
            replace(kernel, name=_make_derivative_name(clearance, part)), names_of_parameters, clearance.label
        )
        for part, kernel in kernels.items()
    }


def _make_derivative_name(clearance: Clearance, part: str) -> str:
    """Return the C name of the derivatives of one part of a joint's force, made from the names of its laws.

    part: "film", "dry" or "share", the fraction of the dry contact.
    """
    laws = {"film": [clearance.film], "dry": [clearance.normal, clearance.friction], "share": [clearance.mixed]}[part]
    return "_".join([f"{part}_slopes", *(make_law_name(law) for law in laws if law)])
