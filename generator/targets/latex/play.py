"""Writes the sections on joints with play (clearance) for a document: geometry, force laws, parameter values."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Assignment
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations
from gudgeon.generator.field import Field
from gudgeon.generator.kinds.laws.elastic_pair import GEOMETRY
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.mechanism import Guide, Play, Quantity
from gudgeon.generator.targets.latex import play_letters as contact_names
from gudgeon.generator.targets.latex.document import (
    Block,
    Section,
    Text,
    list_joint_tokens,
    make_paragraph,
    make_row,
    make_sentence,
    make_tables,
)
from gudgeon.generator.targets.latex.kinematics import make_equation
from gudgeon.generator.targets.latex.letters import Formula, make_name_from_latex, make_symbol_name
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.plots import plot_law_of_joints
from gudgeon.generator.targets.latex.trace import Functions, HighlightIndex
from gudgeon.generator.targets.latex.values import MAX_CELL_LENGTH, ValueFormatter, format_file_expression
from gudgeon.language.plot_units import format_quantity, format_unit
from gudgeon.language.units import find_si_unit


def describe_contour(joint: JointWithPlay) -> Iterator[Block]:
    """Yield the equation of the angle of a non-circular bearing, and the paragraph on its contour.

    The joint must have a contour. The paragraph states the number of depths d, their interpolation, and the direction
    of the normal force.
    """
    clearance = joint.clearance
    assert clearance.contour
    yield make_equation(
        contact.theta_i, joint.notation.expand_symbols(clearance.first.theta), joint.notation, joint.tokens
    )
    yield make_paragraph(
        f"The bearing is not circular: d is its depth beyond the circle, given by {clearance.contour.count} "
        "depths at equal angles "
        f"from the x axis of {clearance.joint.first.body} on. Polynomials of degree five interpolate them with two "
        "continuous derivatives. The normal law gives ",
        joint.notation.format_expression(sp.Symbol("F_n", real=True)),
        ", which acts along the gradient of ",
        Formula(r"\delta", "δ"),
        ", whose length is ",
        joint.notation.format_expression(contact.gradient_length),
        ", so that an elastic force is conservative.",
    )


def describe_corner(name: str, guide: str, slider: str) -> Block:
    """Return the paragraph on the position of a slider's corner, its wall, and the symbols n and e.

    name: the name of the corner, "JOINT.front_upper" for example: "front" or at the rear, "upper" (left) or right.
    guide, slider: points as "body.point".
    """
    corner_name = name.rpartition(".")[2]
    is_front, is_upper = "front" in corner_name, "upper" in corner_name
    return make_paragraph(
        f"The guide i goes through {guide}; the middle of the slider j is {slider}. This corner is"
        f" {'in front, along' if is_front else 'at the rear, against'} the axis, at the wall on the"
        f" {'left' if is_upper else 'right'}, whose outward normal is n; (e_x, e_y) leads from the guide's point"
        " to the centre of the corner's radius, and e is the component of its displacement towards the wall."
    )


def describe_rigid_contact(joint: JointWithPlay, approach_speed: Formula) -> Block:
    """Return the paragraph on impacts and closed contacts of rigid surfaces: restitution, threshold, complementarity.

    It mentions friction in impacts if the joint has a friction law. The joint must have a normal law.
    """
    assert joint.clearance.normal is not None
    restitution, threshold = (
        joint.notation.format_expression(sp.sympify(joint.clearance.normal.parameters[n]))
        for n in ("restitution", "threshold")
    )
    has_friction = joint.clearance.friction is not None
    friction_note = (
        "; friction then reduces the slip after the impact, at most to zero, by an impulse of at most the coefficient"
        " of friction times the normal impulse, without a gain of energy and without a change of separation speeds"
    ) * has_friction
    return make_paragraph(
        "The surfaces are rigid. If they meet at the rate ",
        approach_speed,
        ", an impact along n separates them with ",
        restitution,
        " times this rate, or closes the contact if the result is less than ",
        threshold,
        f"; all constraint equations and closed contacts react to the impact{friction_note}. A closed contact "
        "has the force ",
        Formula(r"\lambda_n \geq 0,\ \ddot{\delta} \leq 0,\ \lambda_n \ddot{\delta} = 0", "λ_n ≥ 0, δ̈ ≤ 0, λ_n δ̈ = 0"),
        ".",
    )


def describe_onset(joint: JointWithPlay, approach_speed: Formula) -> Block:
    """Return the paragraph on the condition δ > 0 of a compliant contact and on the stored approach speed.

    It contains the default of the key `velocity_floor` of the contact. approach_speed: the symbol δ̇⁻.
    """
    min_approach_speed = joint.model.parameter_table.entries[
        f"contacts.{joint.play.contact.name}.velocity_floor"
    ].default
    return make_paragraph(
        "The contact acts while ",
        Formula(r"\delta > 0", "δ > 0"),
        ". ",
        approach_speed,
        " is the approach speed at the onset, "
        f"at least {format_quantity(min_approach_speed, 'm/s')}, stored until separation; before an onset is "
        "accepted, ",
        Formula(r"\dot{\delta} / ", "δ̇ / "),
        approach_speed,
        " is 1.",
    )


def describe_internal_states(law: Law) -> Iterator[Block]:
    """Yield a paragraph for each internal state of a law: its symbol, its meaning, and when it is integrated."""
    for state in law.states:
        message = f" is the {state.meaning}, 0 at each onset, and integrated with the motion while in contact."
        yield make_paragraph(make_symbol_name(state.name), message)


def format_option(value: str | bool) -> str:
    """Return the value of an option in the syntax of the file: "true", or a word unchanged."""
    return str(value).lower() if isinstance(value, bool) else value


BEARING_DIMENSIONS = (
    ("radius", "R_i", "bearing radius"),
    ("clearance", "c", "radial clearance"),
    ("length", "L", "length of the bearing"),
)


class JointWithPlay:
    """Write one joint's equations in its own symbols: c, R_i, K, c_e stand for this joint only.

    tokens: highlighting tokens of the joint. law_tokens: tokens of its laws. labels_of_equal_play: labels of all joints
    that `has_equal_play` with it, itself included. quantities: its parameters (`_list_joint_quantities`).
    """

    def __init__(self, model: Model, clearance: Clearance, notation: Notation, functions: Functions) -> None:
        self.model, self.clearance, self.functions = model, clearance, functions
        self.play = model.scene.play[clearance.joint.name]
        self.tokens = list_joint_tokens(clearance)
        self.law_tokens = [f"law-{self.play.contact.name}", *self.tokens]
        self.labels_of_equal_play = [
            c.label for c in model.clearances if has_equal_play(model.scene.play[c.joint.name], self.play)
        ]
        self.notation = notation.rename_symbols(contact_names.name_joint_symbols(model, clearance))
        self.quantities = list(self._list_joint_quantities())

    def _list_joint_quantities(self) -> Iterator[tuple[Quantity, str, str]]:
        """Yield (quantity, symbol in LaTeX, meaning) of the joint's parameters, for the table of their values.

        They are dimensions, elastic constants if there is dry contact, parameters of laws and the width of the
        transition from film to dry contact.
        """
        bearing = self.play.bearing
        for field, latex_symbol, meaning in contact_names.GUIDE if isinstance(bearing, Guide) else BEARING_DIMENSIONS:
            if (quantity := getattr(bearing, field)) is not None:
                yield quantity, latex_symbol, meaning
        i, j = bearing.bearing_material, bearing.journal_material
        section_name, *parts = (
            ("guides", "guide", "slider") if isinstance(bearing, Guide) else ("bearings", "bearing", "journal")
        )
        materials = [(i, "_i", "both")] if i == j else [(i, "_i", parts[0]), (j, "_j", parts[1])]
        for material, index, part in materials if self.clearance.normal is not None else []:
            name = self.model.scene.materials.get(f"{section_name}.{bearing.name}.{part}_material", material.name)
            yield material.numbers["E"], f"E{index}", f"modulus of elasticity of {name} ({part})"
            yield material.numbers["nu"], rf"\nu{index}", f"Poisson's ratio of {name} ({part})"
        for equations, use in contact_names.list_joint_laws(self.model, self.clearance):
            for parameter, quantity in contact_names.list_specified_parameters(equations, use):
                yield quantity, contact_names.get_latex_symbol(parameter), parameter.meaning
        if self.play.contact.transition is not None:
            yield self.play.contact.transition, "e_0", "width of the transition from film to dry contact"

    def list_law_assignments(self, equations: LawEquations) -> list[Assignment]:
        """Return the equations of a law as assignments to this joint's symbols, without those of value zero.

        Symbols of the law are replaced by those of the joint. Friction of a contour reads the normal force F_N.
        """
        joint_symbols = {
            sp.Symbol(name, real=True): contact_names.get_result_symbol(equations, name)
            for name in equations.equations_by_name
        }
        if self.clearance.contour and equations.law.role == "friction":
            joint_symbols[sp.Symbol("F_n", real=True)] = contact.F_N
        return [
            Assignment(contact_names.get_result_symbol(equations, name), sp.sympify(value).xreplace(joint_symbols))
            for name, value in equations.equations_by_name.items()
            if value != 0
        ]

    def make_equations(self, assignments: list[Assignment]) -> list[Block]:
        """Return an equation symbol = value for each assignment, in this joint's notation and with its law tokens."""
        return [
            make_equation(
                assignment.symbol,
                self.notation.expand_symbols(assignment.value),
                self.notation,
                self.law_tokens,
                self.law_tokens[0],
            )
            for assignment in assignments
        ]


def make_play_sections(model: Model, notation: Notation, functions: Functions) -> list[Section]:
    """Return for each joint with play the sections on geometry, laws, and contribution to the generalized forces g.

    A joint that `has_equal_play` with an earlier one refers to that one instead of repeating the laws.
    """
    sections: list[Section] = []
    described: dict[str, Play] = {}
    for clearance in model.clearances:
        joint = JointWithPlay(model, clearance, notation, functions)
        described_joint = next((name for name, play in described.items() if has_equal_play(play, joint.play)), None)
        kind = clearance.kind.capitalize()
        title = f"{kind} {clearance.name} with play"
        sections.append(Section(title, tuple(_describe_geometry(joint, described_joint is None)), 1, joint.tokens))
        if described_joint is None:
            described[clearance.name] = joint.play
            sections += _describe_contact(joint)
        else:
            reference = (
                f"Guide and contact are those of corner {described_joint}"
                if clearance.wall
                else (f"Bearing and contact are those of joint {described_joint}")
            )
            text = f"{reference}, with the same symbols, laws and parameters."
            sections.append(Section(f"{kind} {clearance.name}: force", (make_paragraph(text),), 2))
        sections.append(
            Section(f"{kind} {clearance.name}: contribution to g", tuple(_describe_generalized_force(joint)), 2)
        )
    return sections


def has_equal_play(first: Play, second: Play) -> bool:
    """Return whether the play of two joints is one object, or has equal bearing and contact without a contour."""
    return first is second or (
        first.bearing == second.bearing and first.contact == second.contact and not first.contour and not second.contour
    )


def _describe_geometry(joint: JointWithPlay, is_first: bool) -> list[Block]:
    """Return the geometry of a joint with play: a paragraph, and its equations in coordinates of the mechanism.

    They define eccentricity, its rate and both angular velocities. A corner at a wall also has the normal, a bearing
    with a contour its angle. All this is returned for each joint. Only with `is_first` the equations of gap,
    penetration and their rates follow, which joints with an equal play (`has_equal_play`) have in common: the joint is
    the first one of them.
    """
    clearance, expand, notation = joint.clearance, joint.notation.expand_symbols, joint.notation
    joint_ref = clearance.joint
    assignments = [
        *zip((contact.e_x, contact.e_y), clearance.eccentricity, strict=True),
        *zip((contact.de_x, contact.de_y), clearance.eccentricity_rate, strict=True),
        (contact.omega_i, clearance.first.omega),
        (contact.omega_j, clearance.second.omega),
    ]
    point_names = f"{joint_ref.first.body}.{joint_ref.first.point}", f"{joint_ref.second.body}.{joint_ref.second.point}"
    introduction: Block = make_paragraph(
        f"Bearing i is {point_names[0]}, journal j is {point_names[1]}; "
        "the eccentricity goes from the bearing's centre to the journal's."
    )
    if clearance.wall:
        introduction = describe_corner(clearance.name, *point_names)
        assignments += zip((contact.n_x, contact.n_y), clearance.wall.normal, strict=True)
    blocks: list[Block] = [
        make_equation(symbol, expand(value), notation, joint.tokens) for symbol, value in assignments
    ]
    if clearance.contour:
        blocks += describe_contour(joint)
    return [introduction, *blocks, *(joint.make_equations(contact.make_gap_equations(clearance)) if is_first else [])]


def _describe_contact(joint: JointWithPlay) -> list[Section]:
    """Return the sections on a joint's parameters, dry contact, film, mixed lubrication and total force.

    Sections for parts that the joint does not have are left out.
    """
    clearance, name = joint.clearance, joint.clearance.name
    kind = clearance.kind.capitalize()
    sections = [Section(f"{kind} {name}: parameters", tuple(describe_parameter_values(joint)), 2)]
    if clearance.normal is not None:
        sections.append(Section(f"{kind} {name}: dry contact", tuple(_describe_dry_contact(joint)), 2))
    if clearance.film is not None:
        blocks = [
            *joint.make_equations(contact.make_film_input_equations(clearance, clearance.film)),
            *_describe_law(joint, "film"),
            *joint.make_equations(contact.make_film_moment_equations(clearance.film)),
        ]
        sections.append(Section(f"{kind} {name}: film", tuple(blocks), 2))
    if clearance.mixed is not None:
        sections.append(Section(f"{kind} {name}: mixed lubrication", tuple(_describe_mixed_lubrication(joint)), 2))
    introduction = (
        "Force on the slider, in ground axes, and the moment about the guide's point"
        if clearance.wall
        else ("At the centre, n has an arbitrary direction. Force on the journal, in ground axes")
    )
    if clearance.normal is not None and clearance.film is not None:
        share_text = "is the fraction above" if clearance.mixed else "goes from 0 to 1 over the transition"
        introduction += f"; the index d marks the dry part, f the film; b {share_text}"
    blocks = [make_paragraph(introduction + ":"), *joint.make_equations(contact.make_resultant_equations(clearance))]
    return [*sections, Section(f"{kind} {name}: force", tuple(blocks), 2)]


def _describe_dry_contact(joint: JointWithPlay) -> list[Block]:
    """Return the blocks on dry contact in the order of evaluation; the joint must have a normal law.

    They are: onset (or impact, if the surfaces are rigid), lever arms and slip, normal law, normal force of a contour,
    friction law (or a note and the equation F_t = 0), and moments.
    """
    clearance, approach_speed = joint.clearance, joint.notation.format_expression(contact.stored_approach_speed)
    onset = describe_rigid_contact(joint, approach_speed) if clearance.rigid else describe_onset(joint, approach_speed)
    friction = (
        _describe_law(joint, "friction")
        if clearance.friction
        else [
            make_paragraph("There is no friction:"),
            make_equation(contact.make_part_symbol(contact.F_along_t, "dry"), sp.Integer(0), joint.notation),
        ]
    )
    return [
        onset,
        *joint.make_equations(contact.make_lever_arm_equations(clearance)),
        *_describe_law(joint, "normal"),
        *joint.make_equations(contact.make_contour_normal_force(clearance)),
        *friction,
        *joint.make_equations(contact.make_dry_moment_equations(clearance)),
    ]


def _describe_mixed_lubrication(joint: JointWithPlay) -> list[Block]:
    """Return the blocks on mixed lubrication: its condition δ > 0, and the law of the fraction of the dry contact."""
    condition = make_paragraph(
        "While ", Formula(r"\delta > 0", "δ > 0"), "; otherwise the fraction of the dry contact is 0."
    )
    return [condition, *_describe_law(joint, "mixed")]


def _describe_law(joint: JointWithPlay, role: str) -> list[Block]:
    """Return a law's source, validity, options and internal states, then its equations and, in a page, its plot.

    role: "normal", "friction", "film" or "mixed"; the joint must have a law of it.
    """
    equations = next(law_equations for law_equations in joint.clearance.laws if law_equations.law.role == role)
    law = equations.law
    source = law.reference or law.source
    blocks: list[Block] = [
        make_paragraph(f"{make_sentence(law.title)} Source: {source}. Valid: {law.validity}.", tokens=joint.law_tokens)
    ]
    blocks += [make_paragraph(f"Properties: {law.properties}.")] if law.properties else []
    blocks += [
        make_paragraph(
            f"Option {option.name}: {format_option(value)} ({option.meaning}).{_format_source(option, value)}"
        )
        for option in law.options
        if (value := equations.options.get(option.name)) is not None  # an option may have no effect next to a number
        and not (joint.clearance.wall and option is GEOMETRY)  # a wall is plane
    ]
    blocks += describe_internal_states(law)
    plot: list[Block] = []
    if isinstance(joint.functions, HighlightIndex):
        plot = plot_law_of_joints(joint.functions, joint.labels_of_equal_play, role, law)
    return [*blocks, *joint.make_equations(joint.list_law_assignments(equations)), *plot]


def _format_source(field: Field, value: str | bool) -> str:
    """Return the sentence with the source of an option's value; "" if it has none."""
    source = (field.sources or {}).get(str(value))
    return f" Source: {source}." if source else ""


def _describe_generalized_force(joint: JointWithPlay) -> list[Block]:
    """Return an introduction, and the equations of the contributions Δg of a joint's force and moments to g.

    Each body except the ground has three components: force along x and y, moment about its centre of mass.
    """
    clearance, notation = joint.clearance, joint.notation
    blocks: list[Block] = [make_paragraph(f"The {clearance.kind} adds to g, by the numbers of the coordinates:")]
    # which symbol holds the moment depends on the parts that the joint has
    moments = contact.find_moment_symbols(clearance)
    for point, sign, moment in ((clearance.first, -1, moments[0]), (clearance.second, 1, moments[1])):
        if point.body is None:
            continue
        arm_x, arm_y = point.arm
        components = (
            sign * contact.F_x,
            sign * contact.F_y,
            sign * (arm_x * contact.F_y - arm_y * contact.F_x) + moment,
        )
        for k, component in enumerate(components, point.body.index + 1):
            left = Formula(rf"\Delta g_{{{k}}}", f"Δg_{k}")
            blocks.append(make_equation(left, sp.expand(notation.expand_symbols(component)), notation, joint.tokens))
    return blocks


def describe_parameter_values(joint: JointWithPlay) -> list[Block]:
    """Return the table of a joint's parameters: symbol, meaning, address, value, unit; then its derived constants.

    Expressions that are too long for a cell follow the table. A quantity that is not a run-time parameter has the value
    in the file.
    """
    table, values, rows = joint.model.parameter_table, ValueFormatter(joint.model, joint.notation), []
    for quantity, latex_symbol, meaning in joint.quantities:
        entry = table.entries.get(quantity.address)
        value: Text = (_format_fixed_value(quantity),) if entry is None else values.format_in_si(entry)
        if entry is not None and entry.depends_on_parameters:
            value = (*values.format_dependency(entry), joint.notation.format_expression(sp.Float(entry.default, 17)))
        name = make_name_from_latex(latex_symbol) if entry is None else joint.notation.format_expression(entry.symbol)
        rows.append(
            make_row(name, meaning, quantity.address, value, format_unit(find_si_unit(quantity.dimension)) or "-")
        )
    definitions = joint.model.symbols.definitions
    constants = dict.fromkeys([joint.clearance.pair.R_j, *joint.clearance.constants.values()])
    constant_equations = [
        make_equation(s, joint.notation.expand_symbols(definitions[s]), joint.notation)
        for s in constants
        if s in definitions
    ]
    header = make_row("symbol", "meaning", "address", "value in the file", "unit")
    return [
        *make_tables(header, rows, (1,)),
        *values.pop_long_expressions(),
        make_paragraph("Derived from these, once per run:"),
        *constant_equations,
    ]


def _format_fixed_value(quantity: Quantity) -> str:
    """Return a value that is not a run-time parameter as text: "0", its expression in the file, or "below".

    "below" stands for an expression of more than MAX_CELL_LENGTH characters.
    """
    text = "0" if quantity.is_zero else format_file_expression(quantity.value)
    return text if len(text) <= MAX_CELL_LENGTH else "below"
