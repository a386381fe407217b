"""Writes the description of a mechanism for a document of equations: bodies, joints, drives, parameters."""

from __future__ import annotations

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import ForceElement, Joint, PointRef
from gudgeon.generator.targets.latex.document import Block, Section, Sketch, Text, make_paragraph, make_row, make_tables
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.theory import read_sketch
from gudgeon.generator.targets.latex.values import (
    MAX_CELL_LENGTH,
    ValueFormatter,
    format_file_expression,
    get_si_unit,
)
from gudgeon.language.plot_units import format_unit


def make_mechanism_sections(model: Model, notation: Notation) -> list[Section]:
    """Return the sections on bodies, ground, joints, drives, expressions, curves and parameters of the file.

    Sections for parts that the file does not have are left out.
    """
    values = ValueFormatter(model, notation)
    return [
        Section("Bodies", tuple(_describe_bodies(model, values))),
        *([Section("Ground", tuple(_describe_ground(model, values)))] if model.scene.mechanism.ground else []),
        Section("Joints", tuple(_describe_joints(model, values))),
        *([Section("Drives", tuple(_describe_drives(model, notation)))] if model.scene.mechanism.drives else []),
        *([Section("Expressions", tuple(_describe_expressions(model)))] if model.scene.mechanism.expressions else []),
        *([Section("Curves", tuple(_describe_curves(model)))] if model.scene.mechanism.curves else []),
        *(
            [Section("Parameters", tuple(_describe_parameters(model, notation, values)))]
            if model.scene.parameters
            else []
        ),
    ]


def _describe_bodies(model: Model, values: ValueFormatter) -> list[Block]:
    """Return the tables of bodies, the lengths of their `sides`, shapes, densities of materials and points.

    Tables without rows are left out. Expressions that are too long for a cell follow as equations.
    """
    rows, points = [], []
    tokens = [[f"body-{name}"] for name in model.scene.mechanism.bodies]
    for body in model.scene.mechanism.bodies.values():
        rows.append(
            make_row(
                body.name,
                values.format_cell(body.mass),
                values.format_cell(body.inertia),
                values.format_cell(body.length),
            )
        )
        vectors = {"com": body.com, **body.points} if body.com is not None else body.points
        points += [make_row(f"{body.name}.{name}", values.format_vector(vector)) for name, vector in vectors.items()]
    lead = (
        "The x axis of a body with a length runs from its tail (the origin) to its head. The centre of mass (com) is "
        "at mid-length, or at the origin of a body without length, unless it is given below. Moments of inertia "
        "are about the centre of mass."
    )
    return [
        make_paragraph(lead),
        *make_tables(make_row("body", "mass", "inertia", "length"), rows, tokens=tokens),
        *make_tables(make_row("side", "length"), values.list_body_quantities("sides")),
        *make_tables(make_row("parameter of a shape", "value"), values.list_body_quantities("shape")),
        *make_tables(make_row("material", "density"), values.list_densities()),
        *make_tables(make_row("point", "in the frame of its body"), points),
        *values.pop_long_expressions(),
    ]


def _describe_ground(model: Model, values: ValueFormatter) -> list[Block]:
    """Return the table of the ground's points."""
    rows = [make_row(name, values.format_vector(vector)) for name, vector in model.scene.mechanism.ground.items()]
    return [*make_tables(make_row("point", "position"), rows), *values.pop_long_expressions()]


def _describe_joints(model: Model, values: ValueFormatter) -> list[Block]:
    """Return the tables of joints, of their fields and of angles at the start, then a sketch of each joint type used.

    The table of joints has the numbers of each joint's constraint equations, or the reason why it has none.
    """
    rows = []
    for joint in model.scene.mechanism.joints.values():
        row_numbers = [str(k + 1) for k, row in enumerate(model.rows) if row.owner == joint.name]
        row_range = f"{row_numbers[0]} to {row_numbers[-1]}" if len(row_numbers) > 1 else "".join(row_numbers)
        joint_type = find_joint_types()[joint.kind]
        point_names = [format_point(ref, joint_type.joins) for ref in (joint.first, joint.second)]
        reason = "none: the joint has play" if joint.name in model.scene.play else "none: redundant"
        rows.append(make_row(joint.name, joint_type.title, *point_names, row_range or reason))
    tokens = [[f"joint-{name}"] for name in model.scene.mechanism.joints]
    blocks: list[Block] = make_tables(make_row("joint", "type", "first", "second", "rows"), rows, tokens=tokens)
    fields = [row for joint in model.scene.mechanism.joints.values() for row in list_field_rows(joint, values)]
    blocks += make_tables(make_row("joint", "field", "value"), fields)
    used_symbols = {s for row in model.rows for s in model.symbols.expand_definitions(row.phi).free_symbols}
    start_angles = [
        e for e in model.parameter_table.entries.values() if e.symbol in used_symbols and e.address.startswith("start.")
    ]
    blocks += make_tables(
        make_row("angle at the start", "value"), [make_row(e.address, values.format_parameter(e)) for e in start_angles]
    )
    blocks += values.pop_long_expressions()
    for kind in dict.fromkeys(joint.kind for joint in model.scene.mechanism.joints.values()):
        summary, *lines = read_sketch(find_joint_types()[kind])
        blocks += [make_paragraph(summary), Sketch(tuple(lines))]
    return blocks


def list_field_rows(part: Joint | ForceElement, values: ValueFormatter) -> list[tuple[Text, ...]]:
    """Return table rows (part, key, value) of the vectors, quantities and options of a joint or force element."""
    fields = [
        *((name, values.format_vector(vector)) for name, vector in part.vectors.items()),
        *((name, values.format_cell(quantity)) for name, quantity in part.quantities.items()),
        *((name, (word,)) for name, word in part.options.items()),
    ]
    return [make_row(part.name, name, text) for name, text in fields]


def format_point(ref: PointRef, joins: str) -> str:
    """Return a point as "body.point"; only the body's name if `joins` is "bodies"."""
    return ref.body if joins == "bodies" else f"{ref.body}.{ref.point}"


def _describe_drives(model: Model, notation: Notation) -> list[Block]:
    """Return the table of drives: prescribed quantity, value, and number of the constraint equation or "redundant"."""
    rows = []
    for name, drive in model.scene.mechanism.drives.items():
        if drive.kind == "distance":
            prescribed = "distance of " + " and ".join(f"{p.body}.{p.point}" for p in drive.points)
        else:
            prescribed = "angle" if drive.kind == "angle" else drive.coordinate
            prescribed += f" of {drive.body}" + (f" relative to {drive.reference}" if drive.reference else "")
        row_numbers = [str(k + 1) for k, row in enumerate(model.rows) if row.owner == name]
        rows.append(
            make_row(name, prescribed, format_drive_value(model, notation, name), "".join(row_numbers) or "redundant")
        )
    tokens = [[f"drive-{name}"] for name in model.scene.mechanism.drives]
    return make_tables(make_row("drive", "prescribes", "value", "row"), rows, (2,), tokens)


def format_drive_value(model: Model, notation: Notation, drive: str) -> str | Formula:
    """Return the prescribed value of a drive: an angle as a formula, others in the syntax of the file.

    An angle whose formula has more than 2 · MAX_CELL_LENGTH characters is in the syntax of the file, too.
    """
    expressions = model.scene.mechanism.expressions
    expression, angle_symbols = (
        model.scene.mechanism.drives[drive].value.value,
        model.constraints.drive_functions.get(drive),
    )
    if angle_symbols is None:
        return format_file_expression(expression, 0, expressions)
    formula = notation.format_expression(
        notation.expand_symbols(model.symbols.expand_definitions(model.symbols.definitions[angle_symbols[0]]))
    )
    return formula if len(formula.text) <= 2 * MAX_CELL_LENGTH else format_file_expression(expression, 0, expressions)


def _describe_curves(model: Model) -> list[Block]:
    """Return the table of curves: name and description (interpolation, range) in SI."""
    rows = [make_row(name, f"{curve.describe()} (SI)") for name, curve in model.scene.mechanism.curves.items()]
    return make_tables(make_row("curve", "description"), rows, (1,))


def _describe_expressions(model: Model) -> list[Block]:
    """Return the table of named expressions, in the syntax of the file."""
    rows = [
        make_row(name, format_file_expression(quantity.source_tree or quantity.value))
        for name, quantity in model.scene.mechanism.expressions.items()
    ]
    return make_tables(make_row("expression", "stands for"), rows, (1,))


def _describe_parameters(model: Model, notation: Notation, values: ValueFormatter) -> list[Block]:
    """Return the table of the scene's parameters: name, symbol, value as in the file and in SI, unit.

    Expressions that are too long for a cell follow the table as equations.
    """
    rows = []
    for name in model.scene.parameters:
        entry = model.parameter_table.entries[f"parameters.{name}"]
        unit = get_si_unit(entry)
        rows.append(
            make_row(
                name,
                notation.format_expression(entry.symbol),
                values.format_in_si(entry),
                format_unit(unit) or Formula("-", "-"),
            )
        )
    return [
        *make_tables(make_row("parameter", "symbol", "value in the file", "unit"), rows),
        *values.pop_long_expressions(),
    ]
