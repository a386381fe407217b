"""Writes the kinematics for a document of equations: coordinates, constraints Φ and their derivatives.

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
from gudgeon.generator.ir.dependence import find_symbol_names
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.targets.latex.document import (
    Block,
    Equation,
    Section,
    make_entry_token,
    make_owner_token,
    make_paragraph,
    make_row,
    make_row_token,
    make_tables,
)
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.notation import Notation, list_intermediate_symbols
from gudgeon.generator.targets.latex.pictures import draw_jacobian_pattern
from gudgeon.generator.targets.latex.theory import GAMMA, LAMBDA, NU, PHI, PHI_Q, name_component

MAX_ENTRY_TABLE_WIDTH = 84  # characters of a table with a joint's entries of Φ_q

MAX_OPERATIONS = 400  # operations of an equation that is printed in full


def make_equation(
    left: Formula | sp.Expr,
    right: sp.Expr,
    notation: Notation,
    tokens: Sequence[str] = (),
    selection_token: str = "",
    value_name: str = "",
) -> Equation:
    """Return the equation left = right, which may break between the terms of the right side.

    An expression on the left is formatted by `notation`. tokens: highlighting tokens. selection_token: the one that
    selecting the equation highlights, "" for all. value_name: name of the value that a page shows, "" for none.
    """
    left_name = left if isinstance(left, Formula) else notation.format_expression(left)
    return Equation(left_name, notation.format_terms(right), tokens, selection_token, value_name)


def make_equation_block(
    left: Formula,
    right: sp.Expr,
    notation: Notation,
    tokens: Sequence[str] = (),
    selection_token: str = "",
    value_name: str = "",
) -> Block:
    """Return the equation left = right as a block, or a sentence about its length above MAX_OPERATIONS operations.

    The arguments are those of `make_equation`. The sentence has neither selection token nor value.
    """
    n_operations = sp.count_ops(right)
    if n_operations <= MAX_OPERATIONS:
        return make_equation(left, right, notation, tokens, selection_token, value_name)
    return make_paragraph(
        left, f" follows by differentiation; its expression has {n_operations} operations.", tokens=tokens
    )


def make_kinematics_sections(model: Model, notation: Notation) -> list[Section]:
    """Return the sections on coordinates, abbreviations, constraint equations and the Jacobian.

    Sections without content are left out.
    """
    sections = [Section("Coordinates", tuple(_describe_coordinates(model, notation)))]
    if constants := list(_describe_abbreviations(model, notation)):
        sections.append(Section("Abbreviations", tuple(constants)))
    if not model.rows:
        return sections
    return [
        *sections,
        Section("Constraints", tuple(_describe_constraints(model, notation))),
        Section("Jacobian", tuple(_describe_jacobian(model))),
    ]


def _describe_coordinates(model: Model, notation: Notation) -> list[Block]:
    """Return the blocks on coordinates: an introduction, and the table of coordinates and velocities of the bodies.

    A page shows the current value next to each coordinate and velocity.
    """
    rows, tokens = [], []
    for body in model.bodies:
        first = body.index + 1
        q = [replace(notation.format_expression(s), value=f"q.{first + k}") for k, s in enumerate(body.q)]
        v = [replace(notation.format_expression(s), value=f"v.{first + k}") for k, s in enumerate(body.v)]
        rows.append(make_row(body.name, f"{first} to {first + 2}", *q, *v))
        tokens.append([f"body-{body.name}"])
    introduction = make_paragraph(
        "Each body has the two coordinates of its centre of mass and an angle, measured from the x axis of the ground "
        "and not wrapped: ",
        Formula(f"n = {len(model.q)}", f"n = {len(model.q)}"),
        " coordinates.",
    )
    header = ("body", "number in q", "x", "y", "angle", "rates", "", "")
    return [introduction, *make_tables(make_row(*header), rows, tokens=tokens)]


def _describe_abbreviations(model: Model, notation: Notation) -> Iterator[Block]:
    """Yield the definitions of derived parameters and long drives that other equations show by a symbol.

    Constants of laws and temporaries of force elements are left out, since their own sections define them. Sentences
    explain where(…) and the unit step H if they occur.
    """
    laws = {value for clearance in model.clearances for value in clearance.constants.values()}
    others = laws | set(list_intermediate_symbols(model))
    equations = [
        make_equation(symbol, notation.expand_symbols(definition), notation)
        for symbol, definition in model.symbols.definitions.items()
        if symbol in notation.shown_symbols and symbol not in others
    ]
    yield from equations
    if any("where(" in term.text for equation in equations for term in equation.terms):
        yield make_paragraph("where(…) is its second argument if the comparison is true, else the third.")
    if any(
        notation.expand_symbols(value).has(sp.Heaviside) for row in model.rows for value in (row.nu, row.gamma)
    ) or any(definition.has(sp.Heaviside) for definition in model.symbols.definitions.values()):
        yield make_paragraph("H is the unit step.")


def _describe_constraints(model: Model, notation: Notation) -> list[Block]:
    """Return an introduction, then for each joint and drive Φ and the nonzero entries of Φ_q, ν and γ."""
    blocks: list[Block] = [
        make_paragraph(
            "The mechanism is assembled if ",
            Formula(r"\Phi(q, t) = 0", "Φ(q, t) = 0"),
            f" in all {len(model.rows)} constraint equations. Velocities satisfy ",
            Formula(r"\Phi_{q} \dot{q} = \nu = -\Phi_{t}", "Φ_q·q̇ = ν = -Φ_t"),
            ", accelerations ",
            Formula(
                r"\Phi_{q} \ddot{q} = \gamma = -(\Phi_{q} \dot{q})_{q} \dot{q} - 2 \Phi_{qt} \dot{q} - \Phi_{tt}",
                "Φ_q·q̈ = γ = -(Φ_q·q̇)_q·q̇ - 2·Φ_qt·q̇ - Φ_tt",
            ),
            ". The following lists contain, for each joint, its constraint equations, the columns of ",
            PHI_Q,
            " with nonzero entries, and the nonzero components of ",
            NU,
            " and ",
            GAMMA,
            ":",
        )
    ]
    for title, rows in _group_rows_by_owner(model):
        first_row = rows[0][1]
        tokens = [make_owner_token(first_row), *(make_row_token(k) for k, _ in rows)]
        blocks.append(
            make_paragraph(f"{title}, ", *_list_multipliers(rows), f"; {_format_row_names(rows)}:", tokens=tokens)
        )
        blocks += [_make_row_equation(k, row, model, notation) for k, row in rows]
        blocks += _describe_jacobian_entries(rows, model, notation)
        nu = [notation.expand_symbols(row.nu) for _, row in rows]
        gamma = [format_gamma(row, model, notation) for _, row in rows]
        for vector, values in ((NU, nu), (GAMMA, gamma)):
            blocks += _make_component_equations(vector, [k for k, _ in rows], values, first_row, notation)
    return blocks


def _make_row_equation(row_number: int, row: Row, model: Model, notation: Notation) -> Equation:
    """Return the equation of Φ's component `row_number`, from 1, with highlighting tokens for each term.

    A term has the tokens of the entries of Φ_q to which it contributes, and of the locals of C that contain it.
    """
    column_of = {q: i for i, q in enumerate(model.q, 1)}
    term_tokens: dict[sp.Expr, list[str]] = {}
    for part in sp.Add.make_args(row.phi):
        name_tokens = [f"name-{name}" for name in sorted(find_symbol_names(part))]
        for term in sp.Add.make_args(notation.expand_symbols(part)):
            term_tokens[term] = term_tokens[-term] = name_tokens

    def list_tokens(term: sp.Expr) -> list[str]:
        """Return the highlighting tokens of a term of Φ: of its entries of Φ_q, then of the locals of C."""
        columns = sorted(column_of[s] for s in model.symbols.expand_definitions(term).free_symbols if s in row.phi_q)
        return [*(make_entry_token(row_number, i) for i in columns), *term_tokens.get(term, ())]

    left = name_component(PHI, row_number)
    terms = notation.format_terms(notation.expand_symbols(row.phi), list_tokens)
    return Equation(
        left,
        terms,
        [make_row_token(row_number), make_owner_token(row)],
        make_row_token(row_number),
        f"phi.{row_number}",
    )


def _group_rows_by_owner(model: Model) -> Iterator[tuple[str, list[tuple[int, Row]]]]:
    """Yield (title, [(number, constraint equation)]) of each joint and drive; numbers count from 1.

    Example of a title: "Joint A, revolute joint, line 12 of the file".
    """
    mechanism = model.scene.mechanism
    for (owner, kind), rows in groupby(enumerate(model.rows, 1), key=lambda pair: (pair[1].owner, pair[1].kind)):
        if kind == "joint":
            joint = mechanism.joints[owner]
            yield (
                f"Joint {owner}, {find_joint_types()[joint.kind].title}, line {joint.where.line} of the file",
                list(rows),
            )
        else:
            yield f"Drive {owner}, line {mechanism.drives[owner].where.line} of the file", list(rows)


def _format_row_names(rows: Sequence[tuple[int, Row]]) -> str:
    """Return the names and units of constraint equations as text."""
    return ("row " if len(rows) == 1 else "rows ") + ", ".join(f"{row.name} ({row.unit})" for _, row in rows)


def _list_multipliers(rows: Sequence[tuple[int, Row]]) -> list[str | Formula]:
    """Return the parts of a text "multipliers λ_1, λ_2" of constraint equations; a page shows the values."""
    names = [replace(name_component(LAMBDA, k), value=f"lambda.{k}") for k, _ in rows]
    separated = [part for name in names for part in (", ", name)][1:]
    return [f"multiplier{'s' * (len(rows) > 1)} ", *separated]


def _describe_jacobian(model: Model) -> list[Block]:
    """Return a paragraph with the number of nonzero entries of Φ_q, and the picture of its sparsity pattern.

    The picture is missing if it would be too large (`draw_jacobian_pattern`).
    """
    count = sum(len(row.phi_q) for row in model.rows)
    shape = f"{len(model.rows)} × {len(model.q)}"
    return [
        make_paragraph(
            "The derivative of ",
            PHI,
            f" by the coordinates has {shape} entries, of which {count} are not zero. "
            "Their values are given above; the picture shows their positions:",
        ),
        *draw_jacobian_pattern(model),
    ]


def _describe_jacobian_entries(rows: Sequence[tuple[int, Row]], model: Model, notation: Notation) -> list[Block]:
    """Return the Jacobian entries of one joint or drive: a table of the columns of Φ_q with nonzero ones.

    If the table would be wider than MAX_ENTRY_TABLE_WIDTH characters, each entry gets its own equation.
    """
    column_of = {q: k for k, q in enumerate(model.q)}
    columns = sorted({q for _, row in rows for q in row.phi_q}, key=column_of.__getitem__)

    def make_jacobian_entry(row_number: int, row: Row, q: sp.Symbol) -> Formula:
        """Return the entry of Φ_q for coordinate q as a formula, "0" for a zero; row_number counts from 1.

        A nonzero entry has its highlighting token. If it is not constant, it also has the name of the value that a page
        shows, phi_q.ROW.COLUMN.
        """
        name = notation.format_expression(notation.expand_symbols(row.phi_q.get(q, sp.Integer(0))))
        if q not in row.phi_q:
            return name
        constant = row.phi_q[q].is_number
        return replace(
            name,
            tokens=[make_entry_token(row_number, column_of[q] + 1)],
            value="" if constant else f"phi_q.{row_number}.{column_of[q] + 1}",
        )

    entries = [[make_jacobian_entry(k, row, q) for q in columns] for k, row in rows]
    if (
        sum(3 + max(len(entry.text) for entry in column) for column in zip(*entries, strict=True))
        > MAX_ENTRY_TABLE_WIDTH
    ):
        return [
            _make_entry_equation(k, q, row, column_of[q], notation)
            for k, row in rows
            for q in columns
            if q in row.phi_q
        ]
    table_rows = [
        make_row(name_component(PHI, k), *row_entries) for (k, _), row_entries in zip(rows, entries, strict=True)
    ]
    tokens = [[make_row_token(k), make_owner_token(row)] for k, row in rows]
    return make_tables(
        make_row("", *map(notation.format_expression, columns)), table_rows, tokens=tokens, transposes_on_phone=True
    )


def _make_entry_equation(row_number: int, q: sp.Symbol, row: Row, column: int, notation: Notation) -> Block:
    """Return the equation of one entry of Φ_q as a block; row `row_number` counts from 1, `column` from 0."""
    coordinate = notation.format_expression(q)
    left = Formula(
        rf"\partial \Phi_{{{row_number}}} / \partial {coordinate.latex}", f"∂Φ_{row_number}/∂{coordinate.text}"
    )
    tokens = [make_entry_token(row_number, column + 1)]
    return make_equation_block(
        left, notation.expand_symbols(row.phi_q[q]), notation, tokens, value_name=f"phi_q.{row_number}.{column + 1}"
    )


def _make_component_equations(
    vector: Formula, row_numbers: Sequence[int], values: Sequence[sp.Expr], first_row: Row, notation: Notation
) -> list[Block]:
    """Return the equations of the nonzero components of ν or γ of one joint or drive.

    vector: NU or GAMMA. row_numbers, values: row number from 1 and value of each component. first_row: a row of the
    same joint or drive, for the highlighting token.
    """
    name = "nu" if vector is NU else "gamma"
    return [
        make_equation_block(
            name_component(vector, k),
            value,
            notation,
            [make_row_token(k), make_owner_token(first_row)],
            make_row_token(k),
            f"{name}.{k}",
        )
        for k, value in zip(row_numbers, values, strict=True)
        if value != 0
    ]


MAX_COLLECTED_OPERATIONS = 1000  # of an expression whose terms are collected


def format_gamma(row: Row, model: Model, notation: Notation) -> sp.Expr:
    """Return γ of a row in the form of a document, an expression in displayed symbols.

    γ of a joint is collected by products of angular velocities; that of a drive stays as derived.
    """
    value = notation.expand_symbols(row.gamma)
    return collect_velocity_products(value, model) if row.kind == "joint" else value


def collect_velocity_products(value: sp.Expr, model: Model) -> sp.Expr:
    """Return an equal expression, a polynomial in products of angular velocities with collected coefficients.

    The expression is returned unchanged if it contains no angular velocity, has more than MAX_COLLECTED_OPERATIONS
    operations, is not a polynomial in the velocities, or would have more operations.
    """
    angular_velocities = [body.v[2] for body in model.bodies]
    if (
        not value.has(*angular_velocities)
        or sp.count_ops(value) > MAX_COLLECTED_OPERATIONS
        or not value.is_polynomial(*model.v)
    ):
        return value
    coefficients: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(sp.expand(value)):
        coefficient, product = term.as_independent(*angular_velocities, as_Add=False)
        coefficients[product] = coefficients.get(product, sp.Integer(0)) + coefficient
    collected = sp.Add(
        *(
            product * min(_find_equivalent_forms(coefficient, model), key=sp.count_ops)
            for product, coefficient in coefficients.items()
        )
    )
    return min(collected, value, key=sp.count_ops)


def _find_equivalent_forms(coefficient: sp.Expr, model: Model) -> Iterator[sp.Expr]:
    """Yield equivalent forms of a coefficient: common factors extracted, then also collected by groups of symbols.

    Groups are the components of rotating unit vectors, those of all rotating vectors, and sine and cosine of each
    body's angle. A coefficient that is not a sum is its only form.
    """
    if not coefficient.is_Add:
        yield coefficient
        return
    yield sp.factor_terms(coefficient)
    rotating = sorted(
        (s for s in coefficient.free_symbols if s in model.geometry.rotated_components), key=lambda s: s.name
    )
    axes = [s for s in rotating if not model.geometry.rotated_components[s].point]
    pairs = [[sp.cos(body.theta), sp.sin(body.theta)] for body in model.bodies if coefficient.has(sp.cos(body.theta))]
    for symbols in (axes, rotating, *pairs):
        if symbols:
            yield sp.factor_terms(sp.collect(coefficient, symbols))
