"""Writes the second part of the document: coordinates, Φ and the derivatives of its rows.

γ is written as in textbooks, by products of angular velocities. That of a translational joint is then θ̇_i² (…) +
2 θ̇_i u · (ṙ_j − ṙ_i) + …, as in P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems, Prentice Hall 1988,
where the angular velocities of both bodies are one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.dependence import free_names
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.targets.latex.document import (
    Block,
    Equation,
    Section,
    cells,
    entry_token,
    owner_token,
    paragraph,
    row_token,
    table,
)
from gudgeon.generator.targets.latex.letters import Name
from gudgeon.generator.targets.latex.notation import Notation, temporaries
from gudgeon.generator.targets.latex.pictures import pattern
from gudgeon.generator.targets.latex.theory import GAMMA, LAMBDA, NU, PHI, PHI_Q, indexed

WIDEST = 84  # characters of text that fit side by side in a joint's rows of Φ_q

LONGEST = 400  # operations in one equation that a reader can be asked to read


def equation(
    left: Name | sp.Expr, right: sp.Expr, notation: Notation, of: Sequence[str] = (), pick: str = "", value: str = ""
) -> Equation:
    """Return an equation that may break between the terms of the right side; tokens and value as in document.py."""
    named = left if isinstance(left, Name) else notation.math(left)
    return Equation(named, notation.terms(right), of, pick, value)


def shown(
    left: Name, right: sp.Expr, notation: Notation, of: Sequence[str] = (), pick: str = "", value: str = ""
) -> Block:
    """Return an equation, or for one that would fill pages only its length."""
    size = sp.count_ops(right)
    if size <= LONGEST:
        return equation(left, right, notation, of, pick, value)
    return paragraph(left, f" follows by differentiation; written out it has {size} operations.", of=of)


def kinematics_sections(model: Model, notation: Notation) -> list[Section]:
    """Return the sections on coordinates, constants, and Φ row by row with Φ_q, ν, γ."""
    sections = [Section("Coordinates", tuple(_coordinates(model, notation)))]
    if constants := list(_constants(model, notation)):
        sections.append(Section("Abbreviations", tuple(constants)))
    if not model.rows:
        return sections
    return [
        *sections,
        Section("Constraints", tuple(_rows(model, notation))),
        Section("Jacobian", tuple(_jacobian(model))),
    ]


def _coordinates(model: Model, notation: Notation) -> list[Block]:
    """Return the table of coordinates and velocities of the bodies."""
    rows, tokens = [], []
    for body in model.bodies:
        first = body.index + 1
        q = [replace(notation.math(s), value=f"q.{first + k}") for k, s in enumerate(body.q)]
        v = [replace(notation.math(s), value=f"v.{first + k}") for k, s in enumerate(body.v)]
        rows.append(cells(body.name, f"{first} to {first + 2}", *q, *v))
        tokens.append([f"body-{body.name}"])
    lead = paragraph(
        "Each body has the two coordinates of its centre of mass and an angle, counted from the x axis of the ground "
        "and not wrapped: ",
        Name(f"n = {len(model.q)}", f"n = {len(model.q)}"),
        " coordinates.",
    )
    header = ("body", "number in q", "x", "y", "angle", "rates", "", "")
    return [lead, *table(cells(*header), rows, of=tokens)]


def _constants(model: Model, notation: Notation) -> Iterator[Block]:
    """Return derived parameters and long drives that the rows show by a letter, except those of forces."""
    laws = {value for clearance in model.clearances for value in clearance.constants.values()}
    apart = laws | set(temporaries(model))
    shown = [
        equation(symbol, notation.expand(definition), notation)
        for symbol, definition in model.symbols.definitions.items()
        if symbol in notation.kept and symbol not in apart
    ]
    yield from shown
    if any("where(" in term.text for one in shown for term in one.terms):
        yield paragraph("where(…) is its second part while the comparison in front holds, else its third.")
    if any(notation.expand(value).has(sp.Heaviside) for row in model.rows for value in (row.nu, row.gamma)) or any(
        definition.has(sp.Heaviside) for definition in model.symbols.definitions.values()
    ):
        yield paragraph("H is the unit step.")


def _rows(model: Model, notation: Notation) -> list[Block]:
    """Return the rows of Φ of each joint with their entries of Φ_q, ν and γ."""
    blocks: list[Block] = [
        paragraph(
            "The mechanism is closed while ",
            Name(r"\Phi(q, t) = 0", "Φ(q, t) = 0"),
            f" in all of its {len(model.rows)} rows. Velocities obey ",
            Name(r"\Phi_{q} \dot{q} = \nu = -\Phi_{t}", "Φ_q·q̇ = ν = -Φ_t"),
            ", accelerations ",
            Name(
                r"\Phi_{q} \ddot{q} = \gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}",
                "Φ_q·q̈ = γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt",
            ),
            ". For each joint its rows, the columns of ",
            PHI_Q,
            " in which they have entries, and what of ",
            NU,
            " and ",
            GAMMA,
            " is not zero:",
        )
    ]
    for title, rows in _by_owner(model):
        own = rows[0][1]
        of = [owner_token(own), *(row_token(k) for k, _ in rows)]
        blocks.append(paragraph(f"{title}, ", *_multipliers(rows), f"; {_named(rows)}:", of=of))
        blocks += [_phi(k, row, model, notation) for k, row in rows]
        blocks += _entries(rows, model, notation)
        nu = [notation.expand(row.nu) for _, row in rows]
        gamma = [gamma_of(row, model, notation) for _, row in rows]
        for letter, values in ((NU, nu), (GAMMA, gamma)):
            blocks += _column(letter, [k for k, _ in rows], values, own, notation)
    return blocks


def _phi(k: int, row: Row, model: Model, notation: Notation) -> Equation:
    """Return a row of Φ; each term is highlighted with its own entries and temporaries."""
    place = {q: i for i, q in enumerate(model.q, 1)}
    tokens: dict[sp.Expr, list[str]] = {}
    for part in sp.Add.make_args(row.phi):
        named = [f"name-{name}" for name in sorted(free_names(part))]
        for term in sp.Add.make_args(notation.expand(part)):
            tokens[term] = tokens[-term] = named

    def of(term: sp.Expr) -> list[str]:
        """Return the tokens of a term."""
        explicit = sorted(place[s] for s in model.symbols.explicit(term).free_symbols if s in row.phi_q)
        return [*(entry_token(k, i) for i in explicit), *tokens.get(term, ())]

    left = indexed(PHI, k)
    terms = notation.terms(notation.expand(row.phi), of)
    return Equation(left, terms, [row_token(k), owner_token(row)], row_token(k), f"phi.{k}")


def _by_owner(model: Model) -> Iterator[tuple[str, list[tuple[int, Row]]]]:
    """Yield each joint and drive with its numbered rows, its type and its line of the file."""
    mechanism = model.scene.mechanism
    for (owner, kind), rows in groupby(enumerate(model.rows, 1), key=lambda pair: (pair[1].owner, pair[1].kind)):
        if kind == "joint":
            joint = mechanism.joints[owner]
            yield f"Joint {owner}, {joint_types()[joint.kind].title}, line {joint.where.line} of the file", list(rows)
        else:
            yield f"Drive {owner}, line {mechanism.drives[owner].where.line} of the file", list(rows)


def _named(rows: Sequence[tuple[int, Row]]) -> str:
    """Return the names and units of rows as text."""
    return ("row " if len(rows) == 1 else "rows ") + ", ".join(f"{row.name} ({row.unit})" for _, row in rows)


def _multipliers(rows: Sequence[tuple[int, Row]]) -> list[str | Name]:
    """Return the names of the multipliers, each with its value."""
    names = [replace(indexed(LAMBDA, k), value=f"lambda.{k}") for k, _ in rows]
    between = [part for name in names for part in (", ", name)][1:]
    return [f"multiplier{'s' * (len(rows) > 1)} ", *between]


def _jacobian(model: Model) -> list[Block]:
    """Return the pattern of Φ_q and the number of its nonzero entries."""
    count = sum(len(row.phi_q) for row in model.rows)
    of = f"{len(model.rows)} × {len(model.q)}"
    return [
        paragraph(
            "The derivative of ",
            PHI,
            f" by the coordinates has {of} entries, of which {count} are not zero; "
            "they stand with their rows above. All in their places:",
        ),
        *pattern(model),
    ]


def _entries(rows: Sequence[tuple[int, Row]], model: Model, notation: Notation) -> list[Block]:
    """Return a joint's block of Φ_q: the columns with nonzero entries."""
    place = {q: k for k, q in enumerate(model.q)}
    columns = sorted({q for _, row in rows for q in row.phi_q}, key=place.__getitem__)

    def entry(k: int, row: Row, q: sp.Symbol) -> Name:
        """Return one entry of Φ_q as a formula."""
        name = notation.math(notation.expand(row.phi_q.get(q, sp.Integer(0))))
        if q not in row.phi_q:
            return name
        constant = row.phi_q[q].is_number
        return replace(name, of=[entry_token(k, place[q] + 1)], value="" if constant else f"phi_q.{k}.{place[q] + 1}")

    entries = [[entry(k, row, q) for q in columns] for k, row in rows]
    if sum(3 + max(len(one.text) for one in column) for column in zip(*entries, strict=True)) > WIDEST:
        return [_partial(k, q, row, place[q], notation) for k, row in rows for q in columns if q in row.phi_q]
    named = [cells(indexed(PHI, k), *own) for (k, _), own in zip(rows, entries, strict=True)]
    tokens = [[row_token(k), owner_token(row)] for k, row in rows]
    return table(cells("", *map(notation.math, columns)), named, of=tokens, upright=True)


def _partial(k: int, q: sp.Symbol, row: Row, column: int, notation: Notation) -> Block:
    """Return the equation of one entry of Φ_q."""
    by = notation.math(q)
    left = Name(rf"\partial \Phi_{{{k}}} / \partial {by.latex}", f"∂Φ_{k}/∂{by.text}")
    of = [entry_token(k, column + 1)]
    return shown(left, notation.expand(row.phi_q[q]), notation, of, value=f"phi_q.{k}.{column + 1}")


def _column(of: Name, numbers: Sequence[int], values: Sequence[sp.Expr], own: Row, notation: Notation) -> list[Block]:
    """Return the nonzero components of a vector by their numbers."""
    name = "nu" if of is NU else "gamma"
    return [
        shown(indexed(of, k), value, notation, [row_token(k), owner_token(own)], row_token(k), f"{name}.{k}")
        for k, value in zip(numbers, values, strict=True)
        if value != 0
    ]


MOST = 1000  # operations of what is sorted


def gamma_of(row: Row, model: Model, notation: Notation) -> sp.Expr:
    """Return γ of a row as documents write it; that of a drive as derived."""
    value = notation.expand(row.gamma)
    return by_rates(value, model) if row.kind == "joint" else value


def by_rates(value: sp.Expr, model: Model) -> sp.Expr:
    """Return the same value sorted by rates; unchanged if it is no polynomial in the rates or would become longer."""
    turning = [body.v[2] for body in model.bodies]
    if not value.has(*turning) or sp.count_ops(value) > MOST or not value.is_polynomial(*model.v):
        return value
    parts: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(sp.expand(value)):
        rest, product = term.as_independent(*turning, as_Add=False)
        parts[product] = parts.get(product, sp.Integer(0)) + rest
    found = sp.Add(*(product * min(_forms(rest, model), key=sp.count_ops) for product, rest in parts.items()))
    return min(found, value, key=sp.count_ops)


def _forms(rest: sp.Expr, model: Model) -> Iterator[sp.Expr]:
    """Return equivalent forms without common factors, by axes of a rotating direction or by sine and cosine."""
    if not rest.is_Add:
        yield rest
        return
    yield sp.factor_terms(rest)
    turned = sorted((s for s in rest.free_symbols if s in model.geometry.turned), key=lambda s: s.name)
    axes = [s for s in turned if not model.geometry.turned[s].point]
    pairs = [[sp.cos(body.theta), sp.sin(body.theta)] for body in model.bodies if rest.has(sp.cos(body.theta))]
    for by in (axes, turned, *pairs):
        if by:
            yield sp.factor_terms(sp.collect(rest, by))
