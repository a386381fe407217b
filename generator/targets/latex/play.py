"""Writes the fourth part of the document: each joint with play, its geometry, its force laws and their numbers."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Step
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
    cells,
    joint_tokens,
    paragraph,
    sentence,
    table,
)
from gudgeon.generator.targets.latex.kinematics import equation
from gudgeon.generator.targets.latex.letters import Name, letter, of_latex
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.plots import law_plot
from gudgeon.generator.targets.latex.trace import Functions, Trace
from gudgeon.generator.targets.latex.values import LONGEST, Values, as_written
from gudgeon.language.plot_units import pretty
from gudgeon.language.plot_units import quantity as in_unit
from gudgeon.language.units import si_unit


def contour(joint: JointWithPlay) -> Iterator[Block]:
    """Return the paragraph on the bearing's angle and the contour W."""
    clearance = joint.clearance
    assert clearance.contour
    yield equation(contact.theta_i, joint.notation.expand(clearance.first.theta), joint.notation, joint.of)
    yield paragraph(
        f"The bearing is no circle: w is how much deeper it is, {clearance.contour.count} depths at equal angles from "
        f"the x axis of {clearance.joint.first.body} on, between them polynomials of degree five with two continuous "
        "derivatives. F acts along the gradient of ",
        Name(r"\delta", "δ"),
        ", whose length is ",
        joint.notation.math(contact.steep),
        ": an elastic force keeps the energy.",
    )


def corner(name: str, guide: str, slider: str) -> Block:
    """Return the paragraph on a corner of a slider and its letters."""
    which = name.rpartition(".")[2]
    front, upper = "front" in which, "upper" in which
    return paragraph(
        f"The guide i goes through {guide}, the slider j is in its middle at {slider}. This corner is"
        f" {'in front, along' if front else 'at the rear, against'} the axis, at the wall to the"
        f" {'left' if upper else 'right'} of it, whose outward normal is n; (e_x, e_y) leads from the guide's point to"
        " the centre of the corner's radius, e is what that lies nearer to the wall than in the middle."
    )


def rigid(joint: JointWithPlay, stored: Name) -> Block:
    """Return the paragraph on impacts and closed contacts of rigid surfaces."""
    assert joint.clearance.normal is not None
    e, v_0 = (joint.notation.math(sp.sympify(joint.clearance.normal.numbers[n])) for n in ("restitution", "threshold"))
    rubs = joint.clearance.friction is not None
    along = (
        "; friction then brings the slip behind it to rest, as far as its coefficient there times the impulse lets it"
        " and energy is not gained, and no parting changes by that"
    ) * rubs
    return paragraph(
        "Its surfaces do not give. Where they meet at the rate ",
        stored,
        ", a blow along n parts them with ",
        e,
        " times that, or leaves them together where that is less than ",
        v_0,
        f"; all rows and contacts that are closed bear it{along}. A contact that is closed has the force ",
        Name(r"\lambda \geq 0,\ \ddot{\delta} \leq 0,\ \lambda \ddot{\delta} = 0", "λ ≥ 0, δ̈ ≤ 0, λ δ̈ = 0"),
        ".",
    )


def onset(joint: JointWithPlay, stored: Name) -> Block:
    """Return the paragraph on when a contact acts, and what is stored at its onset."""
    floor = joint.model.slots.entries[f"contacts.{joint.play.contact.name}.velocity_floor"].default
    return paragraph(
        "It acts while ",
        Name(r"\delta > 0", "δ > 0"),
        ". ",
        stored,
        " is the speed of approach at the onset, "
        f"at least {in_unit(floor, 'm/s')}, kept until separation; before an onset is accepted ",
        Name(r"\dot{\delta} / ", "δ̇ / "),
        stored,
        " counts as 1.",
    )


def describe_states(law: Law) -> Iterator[Block]:
    """Yield the paragraphs on inner states of laws."""
    for state in law.states:
        message = f" is the {state.meaning}, 0 at each onset, and integrated with the motion while in contact."
        yield paragraph(letter(state.name), message)


def as_word(value: str | bool) -> str:
    """Return a value as a file writes it."""
    return str(value).lower() if isinstance(value, bool) else value


PAIR = (
    ("radius", "R_i", "bearing radius"),
    ("clearance", "c", "radial clearance"),
    ("length", "L", "length of the bearing"),
)


class JointWithPlay:
    """Write one joint's equations in its own letters: c, R_i, K, c_e stand for this joint only."""

    def __init__(self, model: Model, clearance: Clearance, notation: Notation, found: Functions) -> None:
        self.model, self.clearance, self.found = model, clearance, found
        self.play = model.scene.play[clearance.joint.name]
        self.of = joint_tokens(clearance)
        self.of_law = [f"law-{self.play.contact.name}", *self.of]
        self.alike = [c.label for c in model.clearances if _alike(model.scene.play[c.joint.name], self.play)]
        self.notation = notation.called(contact_names.joint_letters(model, clearance))
        self.numbers = list(self._numbers())

    def _numbers(self) -> Iterator[tuple[Quantity, str, str]]:
        """Yield every parameter of the joint: quantity, letter if it is not a run-time parameter, meaning."""
        bearing = self.play.bearing
        for field, sign, meaning in contact_names.GUIDE if isinstance(bearing, Guide) else PAIR:
            if (quantity := getattr(bearing, field)) is not None:
                yield quantity, sign, meaning
        i, j = bearing.bearing_material, bearing.journal_material
        section, *both = (
            ("guides", "guide", "slider") if isinstance(bearing, Guide) else ("bearings", "bearing", "journal")
        )
        pieces = [(i, "", "both")] if i == j else [(i, "_i", both[0]), (j, "_j", both[1])]
        for material, index, what in pieces if self.clearance.normal is not None else []:
            name = self.model.scene.materials.get(f"{section}.{bearing.name}.{what}_material", material.name)
            yield material.numbers["E"], f"E{index}", f"modulus of elasticity of {name} ({what})"
            yield material.numbers["nu"], rf"\nu{index}", f"Poisson's ratio of {name} ({what})"
        for equations, use in contact_names.laws_of(self.model, self.clearance):
            for parameter, quantity in contact_names.given(equations, use):
                yield quantity, contact_names.sign_of(parameter), parameter.meaning
        if self.play.contact.transition is not None:
            yield self.play.contact.transition, "e_0", "width of the transition from film to dry contact"

    def steps(self, equations: LawEquations) -> list[Step]:
        """Return the law's own equations, without results that are zero."""
        own = {sp.Symbol(name, real=True): contact_names.result(equations, name) for name in equations.steps}
        if self.clearance.contour and equations.law.role == "friction":
            own[sp.Symbol("F_n", real=True)] = contact.F_N
        return [
            Step(contact_names.result(equations, name), sp.sympify(value).xreplace(own))
            for name, value in equations.steps.items()
            if value != 0
        ]

    def shown(self, steps: list[Step]) -> list[Block]:
        """Return steps as equations."""
        return [
            equation(step.symbol, self.notation.expand(step.value), self.notation, self.of_law, self.of_law[0])
            for step in steps
        ]


def play_sections(model: Model, notation: Notation, found: Functions) -> list[Section]:
    """Return for each joint with play its geometry, its laws, and its forces on both bodies."""
    sections: list[Section] = []
    done: dict[str, Play] = {}
    for clearance in model.clearances:
        joint = JointWithPlay(model, clearance, notation, found)
        twin = next((name for name, play in done.items() if _alike(play, joint.play)), None)
        what = clearance.kind.capitalize()
        title = f"{what} {clearance.name} with play"
        sections.append(Section(title, tuple(_geometry(joint, twin is None)), 1, joint.of))
        if twin is None:
            done[clearance.name] = joint.play
            sections += _contact_sections(joint)
        else:
            whose = (
                f"Guide and contact are those of corner {twin}"
                if clearance.wall
                else (f"Bearing and contact are those of joint {twin}")
            )
            text = f"{whose}; so are letters, laws and numbers."
            sections.append(Section(f"{what} {clearance.name}: force", (paragraph(text),), 2))
        sections.append(Section(f"{what} {clearance.name}: share in g", tuple(_share_in_g(joint)), 2))
    return sections


def _alike(a: Play, b: Play) -> bool:
    """Return whether two joints have the same play."""
    return a is b or (a.bearing == b.bearing and a.contact == b.contact and not a.contour and not b.contour)


def _geometry(joint: JointWithPlay, first: bool) -> list[Block]:
    """Return eccentricity and its rate in coordinates, and what follows from them for the first joint of its kind."""
    clearance, expand, notation = joint.clearance, joint.notation.expand, joint.notation
    ref = clearance.joint
    steps = [
        *zip((contact.e_x, contact.e_y), clearance.eccentricity, strict=True),
        *zip((contact.de_x, contact.de_y), clearance.eccentricity_rate, strict=True),
        (contact.omega_i, clearance.first.omega),
        (contact.omega_j, clearance.second.omega),
    ]
    ends = f"{ref.first.body}.{ref.first.point}", f"{ref.second.body}.{ref.second.point}"
    lead: Block = paragraph(
        f"Bearing i is {ends[0]}, journal j is {ends[1]}; "
        "the eccentricity goes from the bearing's centre to the journal's."
    )
    if clearance.wall:
        lead = corner(clearance.name, *ends)
        steps += zip((contact.n_x, contact.n_y), clearance.wall.normal, strict=True)
    own: list[Block] = [equation(symbol, expand(value), notation, joint.of) for symbol, value in steps]
    if clearance.contour:
        own += contour(joint)
    return [lead, *own, *(joint.shown(contact.gap(clearance)) if first else [])]


def _contact_sections(joint: JointWithPlay) -> list[Section]:
    """Return the sections on a joint's numbers, dry contact, film and mixed lubrication."""
    clearance, name = joint.clearance, joint.clearance.name
    what = clearance.kind.capitalize()
    sections = [Section(f"{what} {name}: numbers", tuple(numbers(joint)), 2)]
    if clearance.normal is not None:
        sections.append(Section(f"{what} {name}: dry contact", tuple(_dry(joint)), 2))
    if clearance.film is not None:
        blocks = [
            *joint.shown(contact.before_film(clearance, clearance.film)),
            *_law(joint, "film"),
            *joint.shown(contact.after_film(clearance.film)),
        ]
        sections.append(Section(f"{what} {name}: film", tuple(blocks), 2))
    if clearance.mixed is not None:
        sections.append(Section(f"{what} {name}: mixed lubrication", tuple(_mixed(joint)), 2))
    lead = (
        "Force on the slider, in ground axes, and the moment about the guide's point"
        if clearance.wall
        else ("At the centre any direction serves as n. Force on the journal, in ground axes")
    )
    if clearance.normal is not None and clearance.film is not None:
        over = "is the share above" if clearance.mixed else "goes from 0 to 1 over the transition"
        lead += f"; d marks the dry part, f the film, b {over}"
    blocks = [paragraph(lead + ":"), *joint.shown(contact.resultant(clearance))]
    return [*sections, Section(f"{what} {name}: force", tuple(blocks), 2)]


def _dry(joint: JointWithPlay) -> list[Block]:
    """Return the blocks on dry contact: onset or impact, normal force, friction."""
    clearance, stored = joint.clearance, joint.notation.math(contact.stored)
    impact = rigid(joint, stored) if clearance.rigid else onset(joint, stored)
    friction = (
        _law(joint, "friction")
        if clearance.friction
        else [
            paragraph("There is no friction:"),
            equation(contact.of_part(contact.F_along_t, "dry"), sp.Integer(0), joint.notation),
        ]
    )
    friction = [*joint.shown(contact.pressing(clearance)), *friction]
    return [
        impact,
        *joint.shown(contact.before_dry(clearance)),
        *_law(joint, "normal"),
        *friction,
        *joint.shown(contact.after_dry(clearance)),
    ]


def _mixed(joint: JointWithPlay) -> list[Block]:
    """Return the blocks on mixed lubrication."""
    when = paragraph("While ", Name(r"\delta > 0", "δ > 0"), "; otherwise the share of the dry contact is 0.")
    return [when, *_law(joint, "mixed")]


def _law(joint: JointWithPlay, role: str) -> list[Block]:
    """Return a law's equations with its source, validity and options."""
    equations = next(own for own in joint.clearance.laws if own.law.role == role)
    law = equations.law
    source = law.reference or law.source
    blocks: list[Block] = [
        paragraph(f"{sentence(law.title)} Source: {source}. Valid: {law.validity}.", of=joint.of_law)
    ]
    blocks += [
        paragraph(f"Option {option.name}: {as_word(value)} ({option.meaning}).{_credit(option, value)}")
        for option in law.options
        if (value := equations.options.get(option.name)) is not None  # one may say nothing beside a number
        and not (joint.clearance.wall and option is GEOMETRY)  # R_i → ∞
    ]
    blocks += describe_states(law)
    plot = law_plot(joint.found, joint.alike, role, law) if isinstance(joint.found, Trace) else []
    return [*blocks, *joint.shown(joint.steps(equations)), *plot]


def _credit(option: Field, value: str | bool) -> str:
    """Return the source of an option, if it has one."""
    source = (option.sources or {}).get(str(value))
    return f" Source: {source}." if source else ""


def _share_in_g(joint: JointWithPlay) -> list[Block]:
    """Return force and moment on both bodies as contributions to g."""
    clearance, notation = joint.clearance, joint.notation
    blocks: list[Block] = [paragraph(f"The {clearance.kind} adds to g, by the numbers of the coordinates:")]
    # which letter holds the moment depends on the parts that the joint has
    moments = contact.moments(clearance)
    for point, sign, moment in ((clearance.first, -1, moments[0]), (clearance.second, 1, moments[1])):
        if point.body is None:
            continue
        x, y = point.arm
        shares = (sign * contact.F_x, sign * contact.F_y, sign * (x * contact.F_y - y * contact.F_x) + moment)
        for k, share in enumerate(shares, point.body.index + 1):
            left = Name(rf"\Delta g_{{{k}}}", f"Δg_{k}")
            blocks.append(equation(left, sp.expand(notation.expand(share)), notation, joint.of))
    return blocks


def numbers(joint: JointWithPlay) -> list[Block]:
    """Yield the letters of the joint and its derived constants."""
    slots, values, rows = joint.model.slots, Values(joint.model, joint.notation), []
    for quantity, sign, meaning in joint.numbers:
        entry = slots.entries.get(quantity.address)
        value: Text = (_apart(quantity),) if entry is None else values.in_si(entry)
        if entry is not None and entry.follows:
            value = (*values.followed(entry), joint.notation.math(sp.Float(entry.default, 17)))
        called = of_latex(sign) if entry is None else joint.notation.math(entry.symbol)
        rows.append(cells(called, meaning, quantity.address, value, pretty(si_unit(quantity.dimension)) or "-"))
    definitions = joint.model.symbols.definitions
    constants = dict.fromkeys([joint.clearance.pair.R_j, *joint.clearance.constants.values()])
    follow = [equation(s, joint.notation.expand(definitions[s]), joint.notation) for s in constants if s in definitions]
    header = cells("letter", "meaning", "address", "value in the file", "unit")
    return [*table(header, rows, (1,)), *values.below(), paragraph("From these follow once a run:"), *follow]


def _apart(quantity: Quantity) -> str:
    """Return a value that is not a run-time parameter: 0, or an expression of the penetration."""
    written = "0" if quantity.is_zero else as_written(quantity.value)
    return written if len(written) <= LONGEST else "below"
