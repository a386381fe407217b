"""Derivatives of the force of a joint with play: the steps of contact_steps.py and the laws, differentiated forward.

They are the derivatives of (F along n, F along t, M_i, M_j) by (e, δ̇, ė_t, ω_i, ω_j); for laws with inner states also
those of the states' rates and by the states. templates/c/play/tangent.c.jinja turns them into ground axes. With a
contour, n and t are along e and across it, and so are the rates. Its depth and slope are inputs too, from which
contour_tangent.c.jinja forms the derivatives by the angle.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Step
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.ir.differentiation import Tangent, Tangents
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.reciprocals import hoisted
from gudgeon.generator.ir.signatures import BRANCHES, CONTACT, PARAMETERS, ZERO, Argument, result
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.ir.values import Conditional, Test
from gudgeon.generator.symbols.storage import Place, PlaceSymbol

INPUTS = (contact.e, contact.deltadot, contact.de_t, contact.omega_i, contact.omega_j)
OF_CONTOUR = (
    contact.e,
    contact.de_n,
    contact.across,
    contact.omega_i,
    contact.omega_j,
    contact.worn,
    contact.worn_slope,
)
UNCLIPPED = sp.Symbol("unclipped", real=True)
_IS_PENETRATING = Test(contact.delta, ">", (0.0,))
DEEP = Statement(contact.depth.name, Conditional(_IS_PENETRATING, contact.delta, ZERO))
_IS_CLOSED = Test(PlaceSymbol(CONTACT["closed"]))
_STORED_SPEED = PlaceSymbol(CONTACT["deltadot_minus"])
_FORCE = PlaceSymbol(CONTACT["force"])  # of surfaces that do not give


def inputs(clearance: Clearance) -> tuple[sp.Symbol, ...]:
    """Return the variables by which the force of a joint is differentiated; with a contour also its depth and slope."""
    return OF_CONTOUR if clearance.contour else INPUTS


def _make_arguments(clearance: Clearance) -> tuple[Argument, ...]:
    """Return the arguments of the C function of the derivatives of one part of a joint's force."""
    input_arguments = (Argument(symbol.name) for symbol in inputs(clearance))
    output = result("out", "ContourSlopes" if clearance.contour else "PinSlopes")
    return (*input_arguments, CONTACT, PARAMETERS, *BRANCHES, output)


class _DerivativeBuilder:
    """Builder of one C function: steps and laws with their tangents by the inputs."""

    def __init__(self, model: Model, clearance: Clearance, part: str) -> None:
        """Begin the C function of one `part` of a joint's force, "film" or "dry", with the inputs as base symbols.

        Inner states of laws are inputs too.
        """
        self.model, self.clearance, self.part = model, clearance, part
        rate_names = "de_n, across" if clearance.contour else "deltadot, de_t"
        further_names = ", depth and slope of the contour" * bool(clearance.contour)
        self.build = KernelBuilder(
            model.symbols,
            f"{part}_slopes_{clearance.label}_",
            [
                f"{part.capitalize()}: F along n and t, M_i, M_j, and their derivatives by e, {rate_names}, omega_i,",
                f"omega_j{further_names} (forward differentiation of the same steps).",
                *["Then the rates of inner states, and derivatives by these states."] * bool(model.law_states),
            ],
        )
        self.states = tuple(sp.Symbol(f"state_{k}", real=True) for k in range(model.law_states))
        self.inputs = (*inputs(clearance), *self.states)
        self.tangents = Tangents(model.symbols, self.build, self.inputs, clearance.name, share_powers=True)

    def section(self, title: str) -> None:
        """Begin a section of statements with a title."""
        self.build.section(title)

    def step(self, step: Step) -> None:
        """Append an equation symbol = value of contact_steps.py, and its tangent."""
        value = in_place(self.model, step.value)
        value_on_branch = self.tangents.shared(self.tangents.held(value))
        self.build.line(Statement(step.symbol.name, value_on_branch))
        self.tangents.know(step.symbol, self.tangents.gradient(value, step.symbol))

    def law(self, equations: LawEquations, arguments: Sequence[sp.Symbol]) -> dict[str, sp.Symbol]:
        """Append a law; return its results by name, whose tangents are known from then on.

        `arguments`: the symbols that are the variables of the law, whose tangents must be known.
        """
        law_tangents = self.tangents.inside(dict(zip(equations.variables, arguments, strict=True)))
        results = {}
        for name, equation in equations.steps.items():
            symbol, value = sp.Symbol(name, real=True), hoisted(self.model.slots, sp.sympify(equation))
            self.build.line(Statement(name, law_tangents.shared(law_tangents.held(value))))
            law_tangents.know(symbol, law_tangents.gradient(value, symbol))
            if name in equations.results:
                results[name] = symbol
                self.tangents.know(symbol, self.tangents.through(law_tangents.of(symbol)))
        return results

    def finish(self, values: Sequence[sp.Expr]) -> Kernel:
        """Append the results and their derivatives by the inputs, and return the function.

        The results are (F along n, F along t, M_i, M_j), then the rates of inner states; missing ones are 0.
        """
        self.section("results")
        for row, value in enumerate([*values, *[ZERO] * (4 + len(self.states) - len(values))]):
            self.build.out(Place("out")["value"][row], value)
            slopes: Tangent = self.tangents.gradient(value)
            for column, base in enumerate(self.inputs):
                self.build.out(Place("out")["slope"][row][column], slopes.get(base, ZERO))
        return self.build.build(_make_arguments(self.clearance), inline=True, prune=True)


def film_derivative_kernel(model: Model, clearance: Clearance, film: LawEquations) -> Kernel:
    """Return the C function of the film's force and moments and of their derivatives by the inputs."""
    slopes = _DerivativeBuilder(model, clearance, "film")
    slopes.section("eccentricity ratio and effective squeeze velocity")
    for step in contact.before_film(clearance, film):
        slopes.step(step)
    slopes.section("film")
    results = slopes.law(film, (contact.epsilon, contact.w_n, contact.w_t))
    slopes.section("moments")
    slopes.step(Step(contact.of_part(contact.F_along_t, "film"), results["F_t"]))
    moments = contact.after_film(film)
    for step in moments:
        slopes.step(step)
    tangential = contact.of_part(contact.F_along_t, "film")
    return slopes.finish([results["F_r"], tangential, *(step.symbol for step in moments)])


def dry_derivative_kernel(model: Model, clearance: Clearance, normal: LawEquations) -> Kernel:
    """Return the C function of the dry contact's force and moments and of their derivatives.

    It is defined at δ < 0 too, with zero force, since samples before a separation lie there. While the contact is open,
    the ratio of velocities is 1 with derivative 0.
    """
    slopes = _DerivativeBuilder(model, clearance, "dry")
    build, tangents = slopes.build, slopes.tangents
    slopes.section("penetration, ratio of velocities, slip")
    for step in contact.gap_by_angle(clearance) if clearance.contour else [contact.penetration(clearance)]:
        slopes.step(step)
    build.line(Statement(contact.depth.name, sp.Max(contact.delta, 0)))
    depth_slope = build.local("depth_by_e", Conditional(_IS_PENETRATING, sp.Integer(1), ZERO))
    tangents.know(
        contact.depth, {base: derivative * depth_slope for base, derivative in tangents.of(contact.delta).items()}
    )
    ratio = UNCLIPPED if clearance.clip_ratio else contact.ratio
    build.line(Statement(ratio.name, Conditional(_IS_CLOSED, contact.deltadot / _STORED_SPEED, sp.Integer(1))))
    ratio_slope = build.local("ratio_by_deltadot", Conditional(_IS_CLOSED, 1 / _STORED_SPEED, ZERO))
    tangents.know(ratio, {base: ratio_slope * rate for base, rate in tangents.of(contact.deltadot).items()})
    for step in contact.before_dry(clearance):
        slopes.step(without_stored_speed(step))
    slopes.section("contact")
    further_variables = [
        _FORCE if clearance.rigid else sp.Symbol(name, real=True) for name in normal.further
    ]  # inputs as well
    F_n = slopes.law(normal, (contact.depth, contact.ratio, *further_variables))["F_n"]
    tangential = contact.of_part(contact.F_along_t, "dry")
    for step in contact.pressing(clearance):
        slopes.step(step)
    normal_force = contact.F_N if clearance.contour else F_n
    friction_results: dict[str, sp.Symbol] = {}
    if clearance.friction is not None:
        states = [build.local("bent", PlaceSymbol(CONTACT["state"][k])) for k in range(len(clearance.states))]
        for state, base in zip(states, slopes.states, strict=False):
            tangents.know(state, {base: sp.Integer(1)})
        friction_results = slopes.law(clearance.friction, (normal_force, contact.v_t, *states))
    slopes.step(Step(tangential, friction_results.pop("F_t", ZERO)))
    moments = contact.after_dry(clearance)
    for step in moments:
        slopes.step(step)
    forces = (-F_n, tangential)
    if clearance.contour:
        forces = contact.along_eccentricity(F_n, tangential)
    return slopes.finish([*forces, *(step.symbol for step in moments), *friction_results.values()])


def without_stored_speed(step: Step) -> Step:
    """Return the equation without the choice between stored and present approach speed, which C makes.

    The ratio of velocities keeps only its clipping; other equations are returned unchanged.
    """
    stored = contact.deltadot / contact.stored
    return Step(step.symbol, step.value.subs(stored, UNCLIPPED)) if step.symbol == contact.ratio else step


def in_place(model: Model, value: sp.Expr) -> sp.Expr:
    """Return a step's value with parameters, and the reciprocals of parameters, read from their struct."""
    return model.symbols.in_place(hoisted(model.slots, value))


def fraction_derivative_kernel(model: Model, clearance: Clearance) -> Kernel:
    """Return the C function of the fraction of the dry contact in a transition, and of its derivative by e.

    A law of mixed lubrication may define the fraction; it is read at depth max(δ, 0) then.
    """
    build = KernelBuilder(
        model.symbols,
        f"share_slope_{clearance.label}_",
        [
            "Fraction of the dry contact in the blend of film and contact, and its derivative by e.",
        ],
    )
    tangents = Tangents(model.symbols, build, (contact.delta,), clearance.name)
    build.section("share")
    if clearance.mixed is not None:
        build.line(DEEP)
        tangents.know(
            contact.depth,
            {contact.delta: build.local("depth_by_delta", Conditional(_IS_PENETRATING, sp.Integer(1), ZERO))},
        )
    *abbreviations, fraction = contact.blend(clearance, closed=True)
    for step in abbreviations:
        value = in_place(model, step.value)
        build.line(Statement(step.symbol.name, tangents.held(value)))
        tangents.know(step.symbol, tangents.gradient(value, step.symbol))
    value = in_place(model, fraction.value)
    build.out(Place("out")[0], tangents.held(value))
    build.out(Place("out")[1], tangents.gradient(value).get(contact.delta, ZERO))
    arguments = (Argument(contact.delta.name), PARAMETERS, *BRANCHES, result("out"))
    return build.build(arguments, inline=True)
