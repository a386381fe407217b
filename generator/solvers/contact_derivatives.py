"""Derivatives of the force in a joint with play by position and velocity, by forward differentiation.

They are the derivatives of (F along n, F along t, M_i, M_j) by (e, δ̇, ė_t, ω_i, ω_j); for laws with internal states
also those of the states' rates and by the states. templates/c/play/tangent.c.jinja turns them into ground axes. With a
contour, n and t are along e and across it, and so are the rates. Its depth and slope are inputs too, from which
contour_tangent.c.jinja forms the derivatives by the angle.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Assignment
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.ir.differentiation import Tangent, Tangents
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.reciprocals import hoist_reciprocals
from gudgeon.generator.ir.signatures import BRANCHES, CONTACT, PARAMETERS, ZERO, Argument, make_output_argument
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol

INPUTS = (contact.e, contact.deltadot, contact.de_t, contact.omega_i, contact.omega_j)
CONTOUR_INPUTS = (
    contact.e,
    contact.de_n,
    contact.rate_across_e,
    contact.omega_i,
    contact.omega_j,
    contact.contour_depth,
    contact.contour_slope,
)
UNCLIPPED = sp.Symbol("unclipped", real=True)
_IS_PENETRATING = Test(contact.delta, ">", (0.0,))
DEPTH_STATEMENT = Statement(contact.depth.name, Conditional(_IS_PENETRATING, contact.delta, ZERO))
_IS_CLOSED = Test(StoredSymbol(CONTACT["closed"]))
_STORED_SPEED = StoredSymbol(CONTACT["deltadot_minus"])
_FORCE = StoredSymbol(CONTACT["force"])  # of surfaces that do not give


def find_input_variables(clearance: Clearance) -> tuple[sp.Symbol, ...]:
    """Return the variables by which the force of a joint is differentiated: (e, δ̇, ė_t, ω_i, ω_j).

    With a contour they are e, its rates along e and across it, ω_i, ω_j, and the contour's depth and slope.
    """
    return CONTOUR_INPUTS if clearance.contour else INPUTS


def _make_derivative_arguments(clearance: Clearance) -> tuple[Argument, ...]:
    """Return the arguments of the kernel that computes one part of a joint's force and its derivatives.

    They are the input variables, the contact state, the parameters, those of the branches, and the result `out`.
    """
    input_arguments = (Argument(symbol.name) for symbol in find_input_variables(clearance))
    output = make_output_argument("out", "ContourSlopes" if clearance.contour else "PinSlopes")
    return (*input_arguments, CONTACT, PARAMETERS, *BRANCHES, output)


class _DerivativeBuilder:
    """Builder of one kernel: steps and laws with their tangents by the inputs."""

    def __init__(self, model: Model, clearance: Clearance, part: str) -> None:
        """Begin the kernel of one `part` of a joint's force, "film" or "dry", and of its derivatives by the inputs.

        Internal states of laws (bristle states) are inputs too.
        """
        self.model, self.clearance, self.part = model, clearance, part
        rate_names = "de_n, across" if clearance.contour else "deltadot, de_t"
        contour_names = ", depth and slope of the contour" * bool(clearance.contour)
        self.builder = KernelBuilder(
            model.symbols,
            f"{part}_slopes_{clearance.label}_",
            [
                f"{part.capitalize()}: F along n and t, M_i, M_j, and their derivatives by e, {rate_names}, omega_i,",
                f"omega_j{contour_names} (forward differentiation of the same steps).",
                *["Then the rates of internal states, and derivatives by these states."] * bool(model.law_states),
            ],
        )
        self.states = tuple(sp.Symbol(f"state_{k}", real=True) for k in range(model.law_states))
        self.inputs = (*find_input_variables(clearance), *self.states)
        self.tangents = Tangents(model.symbols, self.builder, self.inputs, clearance.name, share_powers=True)

    def begin_section(self, title: str) -> None:
        """Begin a section of statements with a title."""
        self.builder.begin_section(title)

    def append_assignment(self, step: Assignment) -> None:
        """Append an equation symbol = value of contact_steps.py, and its derivatives by the inputs."""
        value = read_parameters_from_struct(self.model, step.value)
        value_on_branch = self.tangents.store_powers(self.tangents.freeze_branches(value))
        self.builder.append_instruction(Statement(step.symbol.name, value_on_branch))
        self.tangents.store_tangent(step.symbol, self.tangents.compute_gradient(value, step.symbol))

    def append_law(self, equations: LawEquations, arguments: Sequence[sp.Symbol]) -> dict[str, sp.Symbol]:
        """Append the equations of a law with derivatives by the inputs; return the symbols of its results by name.

        `arguments`: the symbols for the law's variables, in order. Their derivatives must be known; the chain rule
        uses them.
        """
        law_tangents = self.tangents.make_tangents_for_variables(dict(zip(equations.variables, arguments, strict=True)))
        results = {}
        for name, equation in equations.equations_by_name.items():
            symbol, value = (
                sp.Symbol(name, real=True),
                hoist_reciprocals(self.model.parameter_table, sp.sympify(equation)),
            )
            self.builder.append_instruction(
                Statement(name, law_tangents.store_powers(law_tangents.freeze_branches(value)))
            )
            law_tangents.store_tangent(symbol, law_tangents.compute_gradient(value, symbol))
            if name in equations.results:
                results[name] = symbol
                self.tangents.store_tangent(symbol, self.tangents.apply_chain_rule(law_tangents.get_tangent(symbol)))
        return results

    def finish_kernel(self, values: Sequence[sp.Expr]) -> Kernel:
        """Append the results and their derivatives by the inputs to the function, and return it.

        `values`: (F along n, F along t, M_i, M_j), then the rates of the laws' internal states (bristle states);
        missing ones are 0.
        """
        self.begin_section("results")
        for row, value in enumerate([*values, *[ZERO] * (4 + len(self.states) - len(values))]):
            self.builder.append_store(StorageLocation("out")["value"][row], value)
            slopes: Tangent = self.tangents.compute_gradient(value)
            for column, base in enumerate(self.inputs):
                self.builder.append_store(StorageLocation("out")["slope"][row][column], slopes.get(base, ZERO))
        return self.builder.build_kernel(_make_derivative_arguments(self.clearance), inline=True, prune=True)


def make_film_derivative_kernel(model: Model, clearance: Clearance, film: LawEquations) -> Kernel:
    """Return the kernel of the film's force and moments and of their derivatives by the inputs.

    The values are (F along n, F along t, M_i, M_j), followed by zeros for the rates of internal states of friction
    laws. The inputs are those of `find_input_variables`.
    """
    derivative_builder = _DerivativeBuilder(model, clearance, "film")
    derivative_builder.begin_section("eccentricity ratio and effective squeeze velocity")
    for step in contact.make_film_input_equations(clearance, film):
        derivative_builder.append_assignment(step)
    derivative_builder.begin_section("film")
    results = derivative_builder.append_law(film, (contact.epsilon, contact.w_n, contact.w_t))
    derivative_builder.begin_section("moments")
    derivative_builder.append_assignment(
        Assignment(contact.make_part_symbol(contact.F_along_t, "film"), results["F_t"])
    )
    moments = contact.make_film_moment_equations(film)
    for step in moments:
        derivative_builder.append_assignment(step)
    tangential = contact.make_part_symbol(contact.F_along_t, "film")
    return derivative_builder.finish_kernel([results["F_r"], tangential, *(step.symbol for step in moments)])


def make_dry_derivative_kernel(model: Model, clearance: Clearance, normal: LawEquations) -> Kernel:
    """Return the kernel of the dry contact's force and moments and of their derivatives by the inputs.

    The law gets max(δ, 0), so that the kernel is also defined at δ < 0. While the contact is open, the ratio δ̇/δ̇⁻ is
    1 with derivative 0. `normal`: the normal law. The rates of the friction law's internal states follow.
    """
    derivative_builder = _DerivativeBuilder(model, clearance, "dry")
    builder, tangents = derivative_builder.builder, derivative_builder.tangents
    derivative_builder.begin_section("penetration, ratio of velocities, slip")
    for step in (
        contact.make_contour_gap_equations(clearance)
        if clearance.contour
        else [contact.make_penetration_equation(clearance)]
    ):
        derivative_builder.append_assignment(step)
    builder.append_instruction(Statement(contact.depth.name, sp.Max(contact.delta, 0)))
    depth_slope = builder.append_local("depth_by_e", Conditional(_IS_PENETRATING, sp.Integer(1), ZERO))
    tangents.store_tangent(
        contact.depth,
        {base: derivative * depth_slope for base, derivative in tangents.get_tangent(contact.delta).items()},
    )
    ratio = UNCLIPPED if clearance.clip_ratio else contact.ratio
    builder.append_instruction(
        Statement(ratio.name, Conditional(_IS_CLOSED, contact.deltadot / _STORED_SPEED, sp.Integer(1)))
    )
    ratio_slope = builder.append_local("ratio_by_deltadot", Conditional(_IS_CLOSED, 1 / _STORED_SPEED, ZERO))
    tangents.store_tangent(
        ratio, {base: ratio_slope * rate for base, rate in tangents.get_tangent(contact.deltadot).items()}
    )
    for step in contact.make_lever_arm_equations(clearance):
        derivative_builder.append_assignment(replace_speed_ratio(step))
    derivative_builder.begin_section("contact")
    extra_variables = [
        _FORCE if clearance.rigid else sp.Symbol(name, real=True) for name in normal.optional_variables
    ]  # inputs as well
    F_n = derivative_builder.append_law(normal, (contact.depth, contact.ratio, *extra_variables))["F_n"]
    tangential = contact.make_part_symbol(contact.F_along_t, "dry")
    for step in contact.make_contour_normal_force(clearance):
        derivative_builder.append_assignment(step)
    normal_force = contact.F_N if clearance.contour else F_n
    friction_results: dict[str, sp.Symbol] = {}
    if clearance.friction is not None:
        states = [builder.append_local("bent", StoredSymbol(CONTACT["state"][k])) for k in range(len(clearance.states))]
        for state, base in zip(states, derivative_builder.states, strict=False):
            tangents.store_tangent(state, {base: sp.Integer(1)})
        friction_results = derivative_builder.append_law(clearance.friction, (normal_force, contact.v_t, *states))
    derivative_builder.append_assignment(Assignment(tangential, friction_results.pop("F_t", ZERO)))
    moments = contact.make_dry_moment_equations(clearance)
    for step in moments:
        derivative_builder.append_assignment(step)
    forces = (-F_n, tangential)
    if clearance.contour:
        forces = contact.resolve_contour_force(F_n, tangential)
    return derivative_builder.finish_kernel([*forces, *(step.symbol for step in moments), *friction_results.values()])


def replace_speed_ratio(step: Assignment) -> Assignment:
    """Return the equation of `ratio`, the clipped δ̇/δ̇⁻, with the local `unclipped` for the quotient.

    The local is 1 while the contact is open. Other equations are returned unchanged.
    """
    speed_ratio = contact.deltadot / contact.stored_approach_speed
    return Assignment(step.symbol, step.value.subs(speed_ratio, UNCLIPPED)) if step.symbol == contact.ratio else step


def read_parameters_from_struct(model: Model, value: sp.Expr) -> sp.Expr:
    """Return an expression with parameters, and reciprocals of parameters, as fields of the C struct Parameters."""
    return model.symbols.read_from_storage_locations(hoist_reciprocals(model.parameter_table, value))


def make_fraction_derivative_kernel(model: Model, clearance: Clearance) -> Kernel:
    """Return the kernel of the fraction of the dry contact in a transition to contact, and of its derivative by δ.

    Without a contour this is also the derivative by e. A law of mixed lubrication may define the fraction; it reads
    max(δ, 0).
    """
    builder = KernelBuilder(
        model.symbols,
        f"share_slope_{clearance.label}_",
        [
            "Fraction of the dry contact in the blend of film and contact, and its derivative by e.",
        ],
    )
    tangents = Tangents(model.symbols, builder, (contact.delta,), clearance.name)
    builder.begin_section("share")
    if clearance.mixed is not None:
        builder.append_instruction(DEPTH_STATEMENT)
        tangents.store_tangent(
            contact.depth,
            {contact.delta: builder.append_local("depth_by_delta", Conditional(_IS_PENETRATING, sp.Integer(1), ZERO))},
        )
    *abbreviations, fraction = contact.make_blend_equations(clearance, is_closed=True)
    for step in abbreviations:
        value = read_parameters_from_struct(model, step.value)
        builder.append_instruction(Statement(step.symbol.name, tangents.freeze_branches(value)))
        tangents.store_tangent(step.symbol, tangents.compute_gradient(value, step.symbol))
    value = read_parameters_from_struct(model, fraction.value)
    builder.append_store(StorageLocation("out")[0], tangents.freeze_branches(value))
    builder.append_store(StorageLocation("out")[1], tangents.compute_gradient(value).get(contact.delta, ZERO))
    arguments = (Argument(contact.delta.name), PARAMETERS, *BRANCHES, make_output_argument("out"))
    return builder.build_kernel(arguments, inline=True)
