"""The second part of the document: coordinates, Φ and its rows' derivatives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.targets.latex.document import Block, Equation, Section, cells, paragraph, table
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import Notation, temporaries

WIDEST = 84  # characters of text that fit side by side in a joint's rows of Φ_q

LONGEST = 400  # operations in one equation that a reader can be asked to read

PHI, NU, GAMMA = Name(r"\Phi", "Φ"), Name(r"\nu", "ν"), Name(r"\gamma", "γ")


def indexed(of: Name, index: int) -> Name:
    """A component; they count from 1."""
    return Name(f"{of.latex}_{{{index}}}", f"{of.text}_{index}")


def equation(left: Name | sp.Expr, right: sp.Expr, notation: Notation) -> Equation:
    """left = right, broken between the terms of the right side."""
    return Equation(left if isinstance(left, Name) else notation.math(left), notation.terms(right))


def shown(left: Name, right: sp.Expr, notation: Notation) -> Block:
    """left = right; of what fills pages its length alone."""
    size = sp.count_ops(right)
    if size <= LONGEST:
        return equation(left, right, notation)
    return paragraph(left, f" follows by differentiation; written out it has {size} operations.")


def kinematics_sections(model: Model, notation: Notation) -> list[Section]:
    """Coordinates, constants, Φ, Φ_q, ν, γ."""
    sections = [Section("Coordinates", tuple(_coordinates(model, notation)))]
    if constants := list(_constants(model, notation)):
        sections.append(Section("Abbreviations", tuple(constants)))
    if not model.rows:
        return sections
    velocity = paragraph("Velocities obey ", Name(r"\Phi_{q} \dot{q} = \nu = -\Phi_{t}", "Φ_q·q̇ = ν = -Φ_t"), ".")
    acceleration = paragraph(
        "Accelerations obey ",
        Name(
            r"\Phi_{q} \ddot{q} = \gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}",
            "Φ_q·q̈ = γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt",
        ),
        ".",
    )
    nu, gamma = [row.nu for row in model.rows], [row.gamma for row in model.rows]
    return [
        *sections,
        Section("Constraints", tuple(_rows(model, notation))),
        Section("Jacobian", tuple(_jacobian(model, notation))),
        Section("Right-hand side of the velocities", (velocity, *_column(NU, nu, notation))),
        Section("Right-hand side of the accelerations", (acceleration, *_column(GAMMA, gamma, notation))),
    ]


def _coordinates(model: Model, notation: Notation) -> list[Block]:
    rows = [
        cells(body.name, f"{body.index + 1} to {body.index + 3}", *map(notation.math, (*body.q, *body.v)))
        for body in model.bodies
    ]
    lead = paragraph(
        "Each body has the two coordinates of its centre of mass and an angle, counted from the x axis of the ground "
        "and not wrapped: ",
        Name(f"n = {len(model.q)}", f"n = {len(model.q)}"),
        " coordinates.",
    )
    header = ("body", "number in q", "x", "y", "angle", "rates", "", "")
    return [lead, *table(cells(*header), rows)]


def _constants(model: Model, notation: Notation) -> Iterator[Block]:
    """Derived numbers and long drives that the rows show by a letter; those of forces stand with the forces."""
    laws = {value for clearance in model.clearances for value in clearance.constants.values()}
    apart = laws | set(temporaries(model))
    for symbol, definition in model.symbols.definitions.items():
        if symbol in notation.kept and symbol not in apart:
            yield equation(symbol, notation.expand(definition), notation)
    if any(notation.expand(value).has(sp.Heaviside) for row in model.rows for value in (row.nu, row.gamma)) or any(
        definition.has(sp.Heaviside) for definition in model.symbols.definitions.values()
    ):
        yield paragraph("H is the unit step.")


def _rows(model: Model, notation: Notation) -> list[Block]:
    blocks: list[Block] = [
        paragraph(
            "The mechanism is closed while ", Name(r"\Phi(q, t) = 0", "Φ(q, t) = 0"),
            f" in all of its {len(model.rows)} rows.",
        )
    ]  # fmt: skip
    for title, rows in _by_owner(model):
        blocks.append(paragraph(f"{title}; {_named(rows)}:"))
        blocks += [equation(indexed(PHI, k), notation.expand(row.phi), notation) for k, row in rows]
    return blocks


def _by_owner(model: Model) -> Iterator[tuple[str, list[tuple[int, Row]]]]:
    """The numbered rows of each joint and drive, with its name and type."""
    mechanism = model.scene.mechanism
    for (owner, kind), rows in groupby(enumerate(model.rows, 1), key=lambda pair: (pair[1].owner, pair[1].kind)):
        if kind == "joint":
            yield f"Joint {owner}, {joint_types()[mechanism.joints[owner].kind].title}", list(rows)
        else:
            yield f"Drive {owner}", list(rows)


def _named(rows: Sequence[tuple[int, Row]]) -> str:
    return ("row " if len(rows) == 1 else "rows ") + ", ".join(f"{row.name} ({row.unit})" for _, row in rows)


def _jacobian(model: Model, notation: Notation) -> list[Block]:
    """A block a joint: the columns that it has."""
    count = sum(len(row.phi_q) for row in model.rows)
    of = f"{len(model.rows)} × {len(model.q)}"
    blocks: list[Block] = [
        paragraph(
            "The derivative of ", PHI, f" by the coordinates has {of} entries, of which {count} are not zero. "
            "For each joint its rows and the columns in which they have entries:",
        )
    ]  # fmt: skip
    place = {q: k for k, q in enumerate(model.q)}
    for title, rows in _by_owner(model):
        columns = sorted({q for _, row in rows for q in row.phi_q}, key=place.__getitem__)
        entries = [
            [notation.math(notation.expand(row.phi_q.get(q, sp.Integer(0)))) for q in columns] for _, row in rows
        ]
        blocks.append(paragraph(f"{title}:"))
        if sum(3 + max(len(entry.text) for entry in column) for column in zip(*entries, strict=True)) <= WIDEST:
            named = [cells(indexed(PHI, k), *own) for (k, _), own in zip(rows, entries, strict=True)]
            blocks += table(cells("", *map(notation.math, columns)), named)
        else:
            blocks += [_partial(k, q, row.phi_q[q], notation) for k, row in rows for q in columns if q in row.phi_q]
    return blocks


def _partial(k: int, q: sp.Symbol, value: sp.Expr, notation: Notation) -> Block:
    by = notation.math(q)
    left = Name(rf"\partial \Phi_{{{k}}} / \partial {by.latex}", f"∂Φ_{k}/∂{by.text}")
    return shown(left, notation.expand(value), notation)


def _column(of: Name, values: Sequence[sp.Expr], notation: Notation) -> list[Block]:
    """The components that are not zero."""
    explicit = [notation.expand(value) for value in values]
    blocks: list[Block] = [shown(indexed(of, k), value, notation) for k, value in enumerate(explicit, 1) if value != 0]
    if not blocks:
        return [paragraph(of, " is zero in every row.")]
    return blocks if all(value != 0 for value in explicit) else [*blocks, paragraph("All other components are zero.")]
