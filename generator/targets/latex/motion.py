"""Writes the equations of motion for a document: masses, force elements, generalized forces."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.equations.loads import Friction
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.targets.latex.document import (
    Block,
    Equation,
    Section,
    Sketch,
    make_paragraph,
    make_row,
    make_tables,
)
from gudgeon.generator.targets.latex.kinematics import make_equation
from gudgeon.generator.targets.latex.letters import Formula, make_symbol_name
from gudgeon.generator.targets.latex.mechanism import format_point, list_field_rows
from gudgeon.generator.targets.latex.notation import Notation, list_intermediate_symbols
from gudgeon.generator.targets.latex.pictures import draw_assembled_matrix
from gudgeon.generator.targets.latex.theory import PHI_Q, name_component, read_sketch
from gudgeon.generator.targets.latex.values import ValueFormatter

EQUATION_OF_MOTION = Equation(
    Formula(
        r"\begin{bmatrix} M & \Phi_{q}^{\mathsf{T}} \\ \Phi_{q} & 0 \end{bmatrix}"
        r"\begin{bmatrix} \ddot{q} \\ \lambda \end{bmatrix}",
        "[M, Φ_qᵀ; Φ_q, 0]·[q̈; λ]",
    ),
    (
        Formula(
            r"\begin{bmatrix} g \\ \gamma - 2 \alpha \dot{\Phi} - \beta^{2} \Phi \end{bmatrix}",
            "[g; γ - 2·α·Φ̇ - β^2·Φ]",
        ),
    ),
)
UNCONSTRAINED_EQUATION = Equation(Formula(r"M \ddot{q}", "M·q̈"), (Formula("g", "g"),))
PHI_DOT = Formula(r"\dot{\Phi} = \Phi_{q} \dot{q} - \nu", "Φ̇ = Φ_q·q̇ - ν")


def make_motion_sections(model: Model, notation: Notation) -> list[Section]:
    """Return the sections on masses, force elements, generalized forces, the equation of motion and events.

    Force elements and events have sections only if the scene has any.
    """
    sections = [Section("Masses", tuple(_describe_masses(model, notation)))]
    if model.elements:
        sections.append(Section("Force elements", tuple(_describe_elements(model, notation))))
    sections += [
        Section("Generalized forces", tuple(_describe_generalized_forces(model, notation))),
        Section("Equation of motion", tuple(_describe_equation_of_motion(model, notation))),
    ]
    return [*sections, Section("Events", tuple(_describe_events(model, notation)))] if model.events else sections


def _describe_masses(model: Model, notation: Notation) -> list[Block]:
    """Return the table of the diagonal of the mass matrix, and a note on bodies without mass or inertia."""
    rows = [
        make_row(body.name, *map(notation.format_expression, model.masses[body.index : body.index + 3]))
        for body in model.bodies
    ]
    tokens = [[f"body-{body.name}"] for body in model.bodies]
    introduction = "M is diagonal, because the coordinates are those of the centres of mass. Entries of M by body:"
    massless = [body.name for body in model.scene.mechanism.bodies.values() if body.missing_keys]
    note = f"The file gives no mass or no inertia of {', '.join(massless)}: M only scales the steps of Newton's method."
    mass_table = make_tables(make_row("body", "x", "y", "angle"), rows, tokens=tokens)
    return [make_paragraph(introduction), *mass_table, *([make_paragraph(note)] if massless else [])]


def _describe_elements(model: Model, notation: Notation) -> list[Block]:
    """Return fields, intermediate quantities and potential energy of each force element, then sketches of the types.

    Friction elements also have slip velocity and force. The section on generalized forces has the contributions to g.
    """
    values, temporary_symbols = ValueFormatter(model, notation), list_intermediate_symbols(model)
    frictions = {friction.name: friction for friction in model.frictions}
    fields = [row for applied in model.elements.values() for row in list_field_rows(applied.element, values)]
    blocks: list[Block] = [*make_tables(make_row("element", "field", "value"), fields), *values.pop_long_expressions()]
    for name, applied in model.elements.items():
        element_type = find_element_types()[applied.element.kind]
        targets = " and ".join(format_point(target, element_type.targets) for target in applied.element.targets)
        blocks.append(make_paragraph(f"{name}: {element_type.title} ({targets})."))
        blocks += [
            make_equation(symbol, notation.expand_symbols(model.symbols.definitions[symbol]), notation)
            for symbol in temporary_symbols
            if model.symbols.info[symbol].meaning.endswith(f" of {name}")
        ]
        if name in frictions:
            blocks += _describe_friction(model, frictions[name], notation)
        if applied.loads.potential != 0:
            blocks.append(
                make_equation(make_symbol_name("V", name), notation.expand_symbols(applied.loads.potential), notation)
            )
    for kind in dict.fromkeys(applied.element.kind for applied in model.elements.values()):
        summary, *lines = read_sketch(find_element_types()[kind])
        blocks += [make_paragraph(summary), Sketch(tuple(lines))]
    return blocks


def _describe_friction(model: Model, friction: Friction, notation: Notation) -> list[Block]:
    """Return the equations of a friction element: slip velocity v, the constraint v = 0 at stick, the force at slip.

    The constraint has the equations of its Jacobian row J and of its right-hand side γ; the force adds Δg to g.
    """
    name, slip, v = friction.name, friction.slip, sp.Symbol("v", real=True)
    slip_notation = notation.rename_symbols({v: make_symbol_name("v", name)})
    coordinate_number = {q: k for k, q in enumerate(model.q, 1)}
    jacobian_row = [
        make_equation(make_symbol_name("J", name, str(coordinate_number[q])), notation.expand_symbols(entry), notation)
        for q, entry in friction.jacobian.items()
    ]
    force = [
        make_equation(
            Formula(rf"\Delta g_{{{coordinate_number[q]}}}", f"Δg_{coordinate_number[q]}"),
            notation.expand_symbols(-entry * slip.evaluate_kinetic_force(v) * sp.sign(v)),
            slip_notation,
        )
        for q, entry in friction.jacobian.items()
    ]
    limit = notation.format_expression(notation.expand_symbols(slip.static))
    return [
        make_equation(slip_notation.names[v], notation.expand_symbols(slip.v), notation),
        make_paragraph(
            "During stick, ", slip_notation.names[v], " = 0 is a row of the equation of motion, with the entries"
        ),
        *jacobian_row,
        make_equation(make_symbol_name("gamma", name), notation.expand_symbols(friction.gamma), notation),
        make_paragraph(
            "while the absolute value of its multiplier is at most ", limit, "; during slip the force adds to g"
        ),
        *force,
    ]


def _describe_generalized_forces(model: Model, notation: Notation) -> list[Block]:
    """Return the nonzero components of g from gravity and force elements, in symbols of the force elements.

    Notes mention that all other components are zero, and that joints with play add their forces in their own sections.
    """
    gx, gy = model.gravity
    forces = [f for body in model.bodies for f in (body.mass * gx, body.mass * gy, sp.Integer(0))]
    for element in model.elements.values():
        element.add_generalized_forces(forces)
    g = Formula("g", "g")
    blocks: list[Block] = [
        make_equation(name_component(g, k), notation.expand_symbols(force), notation)
        for k, force in enumerate(forces, 1)
        if force != 0
    ]
    introduction: list[Block] = []
    if model.scene.mechanism.gravity is not None:
        gravity = ValueFormatter(model, notation).format_vector(model.scene.mechanism.gravity)
        introduction += make_tables(make_row("gravity"), [make_row(gravity)])
    if blocks:
        introduction.append(make_paragraph("Gravity and force elements, by the numbers of the coordinates:"))
    note = "All other components are zero." if blocks else "No gravity and no force element acts: g is zero."
    blocks = [*introduction, *blocks, make_paragraph(note)]
    if model.clearances:
        blocks.append(make_paragraph("The joints with play add their forces to g; their sections contain these terms."))
    return blocks


def _describe_events(model: Model, notation: Notation) -> list[Block]:
    """Return for each event a sentence on direction and action ("record" or "stop"), and the equation of z."""
    directions = {"rising": "rises through zero", "falling": "falls through zero", "both": "crosses zero"}
    actions = {"record": "the time is recorded", "stop": "the run ends"}
    blocks: list[Block] = []
    for event in model.events:
        blocks.append(
            make_paragraph(
                f"{event.name}: when this expression {directions[event.direction]}, {actions[event.action]}:"
            )
        )
        blocks.append(
            make_equation(make_symbol_name("z", event.name), notation.expand_symbols(event.expression), notation)
        )
    return blocks


def _describe_equation_of_motion(model: Model, notation: Notation) -> list[Block]:
    """Return the equation of motion with multipliers, Baumgarte's gains, its matrix as a picture, degrees of freedom.

    Without constraint equations it is M q̈ = g. A kinematically driven scene has a note in addition.
    """
    n, m = len(model.q), len(model.rows)
    if not model.rows:
        return [UNCONSTRAINED_EQUATION, *_describe_degrees_of_freedom(model)]
    alpha, beta = model.baumgarte
    gains = [
        part
        for symbol in (alpha, beta)
        for part in (notation.format_expression(symbol), f" = {_format_default(model, symbol)} 1/s, ")
    ]
    blocks: list[Block] = [
        EQUATION_OF_MOTION,
        make_paragraph(
            "with ",
            PHI_DOT,
            ", ",
            *gains,
            "which return a drift of ",
            Formula(r"\Phi", "Φ"),
            " to zero (Baumgarte). ",
            Formula(r"-\Phi_{q}^{\mathsf{T}} \lambda", "-Φ_qᵀ·λ"),
            " contains the forces of joints and drives. ",
            f"M is {n} × {n}, ",
            PHI_Q,
            f" {m} × {n}; these are {n + m} equations for {n} accelerations and {m} multipliers.",
        ),
        *draw_assembled_matrix(model),
        *_describe_degrees_of_freedom(model),
    ]
    if n == m and not model.clearances:
        blocks.append(
            make_paragraph(
                "The drives alone determine the motion: ",
                Formula(r"\Phi = 0", "Φ = 0"),
                " gives the positions, ",
                Formula(r"\Phi_{q} \dot{q} = \nu", "Φ_q·q̇ = ν"),
                " the velocities, and nothing is integrated.",
            )
        )
    return blocks


def _describe_degrees_of_freedom(model: Model) -> list[Block]:
    """Return the paragraph on the degrees of freedom: Grübler's formula, and the rank of Φ_q if rows are redundant."""
    n, m, dropped = len(model.q), len(model.rows), model.redundancy.dropped
    counted = m + len(dropped)
    by_count, by_rank = (Formula(f"{n} - {k} = {n - k}", f"{n} - {k} = {n - k}") for k in (counted, m))
    introduction = "Degrees of freedom by Grübler's formula: "
    formula_note = f", three coordinates for each body minus {counted} constraint equation{'s' * (counted != 1)}"
    if dropped:
        redundancy_note = (
            f": {', '.join(dropped)} {'is' if len(dropped) == 1 else 'are'} redundant, and the rank is {m}."
        )
        return [
            make_paragraph(
                introduction, by_count, formula_note, ". By the rank of ", PHI_Q, " they are ", by_rank, redundancy_note
            )
        ]
    rank_note = f" The rank of the constraint equations is {m} as well: none is redundant." if m else ""
    return [make_paragraph(introduction, by_count, f"{formula_note}.{rank_note}")]


def _format_default(model: Model, symbol: sp.Symbol) -> str:
    """Return the default of the run-time parameter with this symbol as text, SI; there must be exactly one."""
    (entry,) = (e for e in model.parameter_table.entries.values() if e.symbol == symbol)
    return f"{entry.default:g}"
