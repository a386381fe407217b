"""Writes the first part of the document: bodies, ground, joints, drives, parameters."""

from __future__ import annotations

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import ForceElement, Joint, PointRef
from gudgeon.generator.targets.latex.document import Block, Section, Sketch, Text, cells, paragraph, table
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.theory import sketch_of
from gudgeon.generator.targets.latex.values import LONGEST, Values, as_written, si_unit_of
from gudgeon.language.plot_units import pretty


def part_sections(model: Model, notation: Notation) -> list[Section]:
    """Return the sections on everything that the file names, with letters and values."""
    values = Values(model, notation)
    return [
        Section("Bodies", tuple(_bodies(model, values))),
        *([Section("Ground", tuple(_ground(model, values)))] if model.scene.mechanism.ground else []),
        Section("Joints", tuple(_joints(model, values))),
        *([Section("Drives", tuple(_drives(model, notation)))] if model.scene.mechanism.drives else []),
        *([Section("Expressions", tuple(_expressions(model)))] if model.scene.mechanism.expressions else []),
        *([Section("Curves", tuple(_curves(model)))] if model.scene.mechanism.curves else []),
        *([Section("Parameters", tuple(_parameters(model, notation, values)))] if model.scene.parameters else []),
    ]


def _bodies(model: Model, values: Values) -> list[Block]:
    """Return the tables of bodies and their points."""
    rows, points = [], []
    of = [[f"body-{name}"] for name in model.scene.mechanism.bodies]
    for body in model.scene.mechanism.bodies.values():
        rows.append(cells(body.name, values.cell(body.mass), values.cell(body.inertia), values.cell(body.length)))
        named = {"com": body.com, **body.points} if body.com is not None else body.points
        points += [cells(f"{body.name}.{name}", values.vector(at)) for name, at in named.items()]
    lead = (
        "The x axis of a body with a length runs from its tail (the origin) to its head. The centre of mass (com) is "
        "at mid-length, or at the origin of a body without length, unless it is given below; inertias are about it."
    )
    return [
        paragraph(lead),
        *table(cells("body", "mass", "inertia", "length"), rows, of=of),
        *table(cells("side", "length"), values.of_bodies("sides")),
        *table(cells("number of a shape", "value"), values.of_bodies("shape")),
        *table(cells("material", "density"), values.densities()),
        *table(cells("point", "in the frame of its body"), points),
        *values.below(),
    ]


def _ground(model: Model, values: Values) -> list[Block]:
    """Return the table of the ground's points."""
    rows = [cells(name, values.vector(at)) for name, at in model.scene.mechanism.ground.items()]
    return [*table(cells("point", "position"), rows), *values.below()]


def _joints(model: Model, values: Values) -> list[Block]:
    """Return the tables of joints and their fields."""
    rows = []
    for joint in model.scene.mechanism.joints.values():
        own = [str(k + 1) for k, row in enumerate(model.rows) if row.owner == joint.name]
        shown = f"{own[0]} to {own[-1]}" if len(own) > 1 else "".join(own)
        own_type = joint_types()[joint.kind]
        ends = [place(ref, own_type.joins) for ref in (joint.first, joint.second)]
        none = "none: it has play" if joint.name in model.scene.play else "none: they are redundant"
        rows.append(cells(joint.name, own_type.title, *ends, shown or none))
    of = [[f"joint-{name}"] for name in model.scene.mechanism.joints]
    blocks: list[Block] = table(cells("joint", "type", "first", "second", "rows"), rows, of=of)
    fields = [row for joint in model.scene.mechanism.joints.values() for row in field_rows(joint, values)]
    blocks += table(cells("joint", "field", "value"), fields)
    used = {s for row in model.rows for s in model.symbols.explicit(row.phi).free_symbols}
    guessed = [e for e in model.slots.entries.values() if e.symbol in used and e.address.startswith("start.")]
    blocks += table(cells("angle at the start", "value"), [cells(e.address, values.slot(e)) for e in guessed])
    blocks += values.below()
    for kind in dict.fromkeys(joint.kind for joint in model.scene.mechanism.joints.values()):
        summary, *lines = sketch_of(joint_types()[kind])
        blocks += [paragraph(summary), Sketch(tuple(lines))]
    return blocks


def field_rows(of: Joint | ForceElement, values: Values) -> list[tuple[Text, ...]]:
    """Yield the rows of a joint's or force element's fields: its name, the field's, the value."""
    fields = [
        *((name, values.vector(vector)) for name, vector in of.vectors.items()),
        *((name, values.cell(quantity)) for name, quantity in of.quantities.items()),
        *((name, (word,)) for name, word in of.options.items()),
    ]
    return [cells(of.name, name, text) for name, text in fields]


def place(ref: PointRef, joins: str) -> str:
    """Return a point by its name; only the body if bodies are joined."""
    return ref.body if joins == "bodies" else f"{ref.body}.{ref.point}"


def _drives(model: Model, notation: Notation) -> list[Block]:
    """Return the table of drives."""
    rows = []
    for name, drive in model.scene.mechanism.drives.items():
        if drive.kind == "distance":
            what = "distance of " + " and ".join(f"{p.body}.{p.point}" for p in drive.points)
        else:
            what = "angle" if drive.kind == "angle" else drive.coordinate
            what += f" of {drive.body}" + (f" against {drive.reference}" if drive.reference else "")
        own = [str(k + 1) for k, row in enumerate(model.rows) if row.owner == name]
        rows.append(cells(name, what, driven_value(model, notation, name), "".join(own) or "redundant"))
    of = [[f"drive-{name}"] for name in model.scene.mechanism.drives]
    return table(cells("drive", "prescribes", "value", "row"), rows, (2,), of)


def driven_value(model: Model, notation: Notation, drive: str) -> str | Name:
    """Return the prescribed value of a drive as a formula; as the file writes it if the formula is too long."""
    called = model.scene.mechanism.expressions
    written, angle = model.scene.mechanism.drives[drive].value.value, model.constraints.drive_angles.get(drive)
    if angle is None:
        return as_written(written, 0, called)
    formula = notation.math(notation.expand(model.symbols.explicit(model.symbols.definitions[angle[0]])))
    return formula if len(formula.text) <= 2 * LONGEST else as_written(written, 0, called)


def _curves(model: Model) -> list[Block]:
    """Return the definitions of curves; f' and f'' are their derivatives."""
    rows = [cells(name, f"{curve.message()} (SI)") for name, curve in model.scene.mechanism.curves.items()]
    return table(cells("curve", "what it is"), rows, (1,))


def _expressions(model: Model) -> list[Block]:
    """Return the table of named expressions."""
    rows = [cells(name, as_written(of.written or of.value)) for name, of in model.scene.mechanism.expressions.items()]
    return table(cells("expression", "stands for"), rows, (1,))


def _parameters(model: Model, notation: Notation, values: Values) -> list[Block]:
    """Return the table of parameters, as in the file and in SI units."""
    rows = []
    for name in model.scene.parameters:
        entry = model.slots.entries[f"parameters.{name}"]
        unit = si_unit_of(entry)
        rows.append(cells(name, notation.math(entry.symbol), values.in_si(entry), pretty(unit) or Name("-", "-")))
    return [*table(cells("parameter", "letter", "value in the file", "unit"), rows), *values.below()]
