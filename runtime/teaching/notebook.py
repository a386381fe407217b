"""Write a scene's equations as a notebook: derived by plain SymPy, run in NumPy, then run by the compiled simulator.

The format is nbformat 4.5. The content does not depend on the time or place of writing. `format_block` and
`escape_markdown` also write parts of exercise sheets as Markdown, with formulas between dollar signs.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import groupby
from typing import Any

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.symbols.parameter_table import ParameterEntry
from gudgeon.generator.targets.latex.document import Block, Document, EmbeddedHtml, Equation, Paragraph, Table, Text
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.notation import Notation, make_notation
from gudgeon.generator.targets.latex.printers import find_fraction_of_pi
from gudgeon.generator.targets.latex.write import make_primed_symbols_table
from gudgeon.language.text_output import format_one_line
from gudgeon.teaching.sympy_text import assign_python_names, format_expression, format_number

Cell = tuple[str, str]  # "markdown" or "code", text
MAX_LINE_WIDTH = 100
DERIVATION_CODE = """\
Phi_q = Phi.jacobian(q)
nu = -Phi.diff(t)
gamma = -(Phi_q * v).jacobian(q) * v - 2 * Phi_q.diff(t) * v - Phi.diff(t, 2)
Phi_q"""
_MARKDOWN_CHARACTERS = re.compile(r"([\\`*_{}\[\]<>#|$~])")


def write_notebook(model: Model, mechanism: str) -> str:
    """Return the text (JSON) of a Jupyter notebook that derives a scene's equations with SymPy alone and runs the
    scene.

    mechanism: name or file from which its last cells load the scene. Raises GudgeonError for curves and functions that
    SymPy does not have.
    """
    cells: list[dict[str, Any]] = [
        {"cell_type": kind, "id": f"cell-{k:02d}", "metadata": {}, "source": text.splitlines(keepends=True)}
        | ({"execution_count": None, "outputs": []} if kind == "code" else {})
        for k, (kind, text) in enumerate(_yield_cells(model, mechanism), 1)
    ]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    document = {
        "cells": cells,
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _yield_cells(model: Model, mechanism: str) -> Iterator[Cell]:
    """Yield kind ("markdown" or "code") and text of each cell of the notebook, in order."""
    scene, notation, names = model.scene, make_notation(model), assign_python_names(model)
    title = escape_markdown(format_one_line(scene.mechanism.title or scene.mechanism.name))
    yield (
        "markdown",
        (
            f"# {title}\n\nMechanism {escape_markdown(scene.mechanism.name)}, scene "
            f"{escape_markdown(scene.name)}. The equations of "
            "motion, derived by SymPy alone from the file's numbers; then the same functions in NumPy, then the "
            "compiled simulator."
        ),
    )
    yield "code", "import numpy as np\nimport sympy as sp\n\nsp.init_printing()"
    yield (
        "markdown",
        (
            "## Coordinates\n\nEach body has the two coordinates of its centre of mass and an angle, counted from the "
            "x axis of the ground. Lengths are in m, masses in kg, angles in rad."
        ),
    )
    yield "code", _write_coordinates_code(model, notation, names)
    used = _find_used_parameters(model)
    shown = (notation.format_expression(symbol) for symbol in (*model.q, *model.v, *(entry.symbol for entry in used)))
    paragraphs = ["## Numbers", "Every parameter of the file in an equation has a symbol."]
    yield "markdown", "\n\n".join((*paragraphs, *map(format_block, make_primed_symbols_table(notation, shown))))
    yield "code", _write_parameters_code(used, notation, names)
    yield from _yield_constraint_cells(model, names)
    if not scene.mechanism.bodies or not model.rows:
        yield "markdown", "The bodies have no constraints: Φ has no row."
    else:
        yield (
            "markdown",
            (
                "## Derivatives of Φ\n\n$$ \\Phi_q \\dot q = \\nu = -\\Phi_t, \\qquad \\Phi_q \\ddot q = \\gamma = "
                "-(\\Phi_q \\dot q)_q \\dot q - 2\\Phi_{qt} \\dot q - \\Phi_{tt} $$"
            ),
        )
        yield "code", DERIVATION_CODE
    if not any(body.missing_keys for body in scene.mechanism.bodies.values()):
        yield from _yield_equation_of_motion_cells(model, names)
    yield from _yield_run_cells(model, mechanism)


def _define_symbol(symbol: sp.Symbol, notation: Notation, names: dict[sp.Symbol, str]) -> str:
    """Return the Python statement that creates a SymPy symbol with its LaTeX name."""
    return f"{names[symbol]} = sp.Symbol({notation.format_expression(symbol).latex!r}, real=True)"


def _write_coordinates_code(model: Model, notation: Notation, names: dict[sp.Symbol, str]) -> str:
    """Return the Python text of the cell that defines the symbols t, q and v."""
    lines = [_define_symbol(symbol, notation, names) for symbol in (model.t, *model.q, *model.v)]
    q, v = (_write_column([names[s] for s in symbols]) for symbols in (model.q, model.v))
    return "\n".join((*lines, "", f"q = {q}", f"v = {v}  # the rates of q"))


def _write_column(entries: list[str]) -> str:
    """Return the Python text of a column vector of SymPy, with as many entries in a line as fit."""
    if sum(len(entry) + 2 for entry in entries) < MAX_LINE_WIDTH:
        return f"sp.Matrix([{', '.join(entries)}])"
    lines, line = list[str](), ""
    for entry in entries:
        if line and len(line) + len(entry) + 2 > MAX_LINE_WIDTH:
            lines.append(line)
            line = ""
        line += f"{entry}, "
    return "\n    ".join(("sp.Matrix([", *(x.rstrip() for x in (*lines, line)))) + "\n])"


def _find_used_parameters(model: Model) -> list[ParameterEntry]:
    """Return the parameters that occur in Φ, M or g."""
    expressions = [*(row.phi for row in model.rows), *model.masses, *model.g]
    used = set().union(*(model.symbols.expand_definitions(sp.sympify(e)).free_symbols for e in expressions))
    return [entry for entry in model.parameter_table.entries.values() if entry.symbol in used]


def _write_parameters_code(entries: list[ParameterEntry], notation: Notation, names: dict[sp.Symbol, str]) -> str:
    """Return the Python text of the cell that defines the symbols of parameters and the dictionary of their
    defaults.
    """
    lines = [_define_symbol(entry.symbol, notation, names) for entry in entries]
    values = [f"    {names[e.symbol]}: {_write_default(e.default)},  # {e.address}" for e in entries]
    return "\n".join((*lines, "", "numbers = {", *values, "}"))


def _write_default(value: float) -> str:
    """Return a default value as Python text; simple fractions of π as such, other values with all digits."""
    return format_number(value) if find_fraction_of_pi(value) else repr(value)


def _yield_constraint_cells(model: Model, names: dict[sp.Symbol, str]) -> Iterator[Cell]:
    """Yield the cells of constraint equations: two for each joint or drive, then the column Phi of all; none without
    rows.
    """
    mechanism, entries = model.scene.mechanism, list[str]()
    if not model.rows:
        return
    yield "markdown", "## Constraints\n\nThe mechanism is closed while Φ(q, t) = 0, joint by joint, drive by drive."
    for (owner, kind), group in groupby(model.rows, key=lambda row: (row.owner, row.kind)):
        rows, name = list(group), f"Phi_{owner}"
        entries.append(f"*{name}")
        if kind == "drive":
            title, code = f"Drive {owner}", None
        else:
            joint = mechanism.joints[owner]
            joint_type = find_joint_types()[joint.kind]
            ends = (
                f"{ref.body}.{ref.point}" if joint_type.joins == "points" else ref.body
                for ref in (joint.first, joint.second)
            )
            title, code = (
                f"Joint {owner}, {joint_type.title}: {' and '.join(ends)}",
                _write_revolute_code(model, owner, name, rows, names),
            )
        yield (
            "markdown",
            f"{escape_markdown(title)}; {', '.join(f'{escape_markdown(row.name)} in {row.unit}' for row in rows)}.",
        )
        explicit = [format_expression(row.phi, model, names) for row in rows]
        yield "code", code or f"{name} = {_write_column_by_lines(explicit)}"
    yield "code", f"Phi = {_write_column(entries)}\nPhi"


def _write_revolute_code(
    model: Model, joint_name: str, variable: str, rows: list[Row], names: dict[sp.Symbol, str]
) -> str | None:
    """Return Python code that assigns the equations of a revolute joint: the difference of two points in ground axes.

    variable: Python variable of the difference. rows: the joint's constraint equations. names: Python names of symbols.
    Returns None for other joint types, and for a revolute joint with a dropped redundant equation.
    """
    joint = model.scene.mechanism.joints[joint_name]
    if not find_joint_types()[joint.kind].is_pivot or len(rows) != 2:
        return None
    lines = []
    for prefix, ref in (("first", joint.first), ("second", joint.second)):
        frame = model.geometry.find_point(ref)
        coordinates = [format_expression(component, model, names) for component in (frame.x, frame.y)]
        lines.append(f"{prefix}_{joint_name} = {_write_column_by_lines(coordinates)}  # {ref.body}.{ref.point}")
    return "\n".join((*lines, f"{variable} = first_{joint_name} - second_{joint_name}"))


def _write_column_by_lines(entries: list[str]) -> str:
    """Return a column vector of SymPy with one item in each line."""
    inside = ",\n    ".join(entries)
    return f"sp.Matrix([\n    {inside},\n])"


def _yield_equation_of_motion_cells(model: Model, names: dict[sp.Symbol, str]) -> Iterator[Cell]:
    """Yield a text cell with M q̈ + Φ_qᵀ λ = g, and a code cell that assigns M and g as expressions of the model.

    They are not derived in the notebook. The cell of `_write_run_comparison` solves the system numerically.
    """
    note = "The forces of joints with play and of set-valued friction are added to g by the simulator."
    added_forces_text = note if model.clearances or model.frictions else ""
    yield (
        "markdown",
        (
            "## The equation of motion\n\n$$ M \\ddot q + \\Phi_q^{\\mathsf T} \\lambda = g, \\qquad "
            "\\Phi_q \\ddot q = \\gamma $$\n\nM is diagonal, as the coordinates are those of the centres of mass; g "
            f"contains gravity and the force elements. {added_forces_text}".rstrip()
        ),
    )
    masses = [format_expression(mass, model, names) for mass in model.masses]
    forces = [format_expression(force, model, names) for force in model.g]
    yield "code", f"M = sp.diag(*{_write_column(masses)})\ng = {_write_column(forces)}"


def format_document(document: Document) -> str:
    """Return a whole document as Markdown: title, facts, and its sections with headings by level."""
    blocks = [f"# {escape_markdown(document.title)}", *map(format_text, document.facts)]
    for section in document.sections:
        blocks.append(f"{'#' * (section.level + 1)} {escape_markdown(section.title)}")
        blocks += map(format_block, section.blocks)
    return "\n\n".join(blocks) + "\n"


def format_block(block: Block) -> str:
    """Return a paragraph, equation, table or sketch as Markdown; "" for embedded HTML."""
    if isinstance(block, Paragraph):
        return format_text(block.text)
    if isinstance(block, Equation):
        return f"$$ {block.left.latex} = {' '.join(term.latex for term in block.terms)} $$"
    if isinstance(block, Table):
        return _format_table(block)
    if isinstance(block, EmbeddedHtml):
        return ""
    return "\n".join(("```text", *block.lines, "```"))


def format_text(text: Text) -> str:
    """Return words and formulas as Markdown: formulas in $…$, other characters escaped."""
    return "".join(f"${part.latex.strip()}$" if isinstance(part, Formula) else escape_markdown(part) for part in text)


def escape_markdown(text: str) -> str:
    """Return text with all Markdown characters escaped."""
    return _MARKDOWN_CHARACTERS.sub(r"\\\1", text)


def _format_table(table: Table) -> str:
    """Return a table as Markdown: its header, a rule, and a line for each row."""

    def format_row(cells: tuple[Text, ...]) -> str:
        """Return a row of the table."""
        return (
            "| "
            + " | ".join(format_text(cell).replace(r"\|", "&#124;").replace("|", r"\vert ") for cell in cells)
            + " |"
        )

    return "\n".join((format_row(table.header), "|" + " --- |" * len(table.header), *map(format_row, table.rows)))


def _yield_run_cells(model: Model, mechanism: str) -> Iterator[Cell]:
    """Yield the cells that load and run the scene, and compare NumPy and the simulator with the derivation.

    Each comparison is an assertion; without constraint equations there is none.
    """
    massless = any(body.missing_keys for body in model.scene.mechanism.bodies.values())
    compares_accelerations = not (model.clearances or model.frictions)
    yield (
        "markdown",
        (
            "## The same functions in NumPy\n\n`model.numpy()` has the functions of the emitted C in NumPy; "
            "`model.numpy().source` is their text. At the start both must agree."
        ),
    )
    if model.rows:
        yield "code", _write_functions_code(model, massless)
        yield "code", _write_numpy_comparison(model, mechanism)
    else:
        yield "code", _write_load_and_print_code(model, mechanism)
    yield "markdown", "## The compiled simulator\n\nThe same equations as C, integrated or solved at each sample."
    yield "code", "run = simulation.simulate()\nrun"
    if model.rows:
        yield "code", _write_run_comparison(model, massless, compares_accelerations)


def _write_functions_code(model: Model, massless: bool) -> str:
    """Return the Python text of the cell that compiles the derived matrices to NumPy functions.

    massless: without M and g.
    """
    matrix_names = ["Phi", "Phi_q", "nu", "gamma"] if massless else ["Phi", "Phi_q", "nu", "gamma", "M", "g"]
    assignments = ", ".join(f"{name}={name}" for name in matrix_names)
    return (
        "def function(matrix):\n"
        '    """Return a NumPy function of t, q and q̇ for a matrix."""\n'
        '    instants = {"DiracDelta": lambda *_: 0.0}  # impulses at jumps of a rate are left out\n'
        '    compiled = sp.lambdify((t, [*q], [*v]), matrix.subs(numbers), [instants, "numpy"])\n'
        "    return lambda t, q, v: np.array(compiled(t, q, v), float)\n\n\n"
        f"derived = {{name: function(matrix) for name, matrix in dict({assignments}).items()}}"
    )


def _write_load_and_print_code(model: Model, mechanism: str) -> str:
    """Return the Python text of the cell that loads the scene and prints its NumPy functions, without a comparison."""
    return (
        "import gudgeon\n\n"
        f"simulation = gudgeon.load({mechanism!r}, {model.scene.name!r})\n"
        "in_numpy = simulation.model.numpy()\n"
        "print(in_numpy.source[:2000])"
    )


def _write_numpy_comparison(model: Model, mechanism: str) -> str:
    """Return the Python text of the cell that loads the scene and compares the derivation with `model.numpy()`.

    The constraint equations of NumPy are those of the closed linkage, which include joints with play and redundant
    equations; the cell selects those of the scene.
    """
    names_of_rows = {row.name for row in model.rows}
    rows = [k for k, row in enumerate(model.all_rows) if row.name in names_of_rows]
    return (
        "import gudgeon\n\n"
        f"simulation = gudgeon.load({mechanism!r}, {model.scene.name!r})\n"
        "in_numpy = simulation.model.numpy()\n"
        "p, start = in_numpy.prepare(), simulation.start()\n"
        f"rows = {rows}  # of the linkage with all joints closed\n\n"
        "for name, theirs in (\n"
        '    ("Phi", in_numpy.phi(0.0, start.q, p)),\n'
        '    ("Phi_q", in_numpy.phi_q(0.0, start.q, p)),\n'
        '    ("nu", in_numpy.nu(0.0, start.q, p)),\n'
        '    ("gamma", in_numpy.gamma(0.0, start.q, start.v, p)),\n'
        "):\n"
        "    ours = derived[name](0.0, start.q, start.v)\n"
        "    theirs = np.asarray(theirs)[rows].reshape(ours.shape)\n"
        '    print(f"{name}: largest difference {np.abs(ours - theirs).max():.1e}")\n'
        "    assert np.allclose(ours, theirs, rtol=1e-9, atol=1e-9 * (1 + np.abs(theirs).max()))"
    )


def _write_run_comparison(model: Model, massless: bool, compares_accelerations: bool) -> str:
    """Return the Python text of the cell that compares the derivation with the end of a run of the compiled simulator.

    It compares the accelerations, or without `compares_accelerations` (play or friction) only the Jacobian. massless:
    accelerations are computed from the drives only.
    """
    head = (
        "end = float(run.t[-1])\n"
        'entries, right = derived["Phi_q"](end, run.q[-1], run.v[-1]), derived["gamma"](end, run.q[-1], run.v[-1])\n'
    )
    if massless:
        return head + (
            "a = np.linalg.lstsq(entries, right[:, 0], rcond=None)[0]  # no masses: drives determine the motion\n"
            'print(f"q̈ at {end:g} s: largest difference {np.abs(a - run.a[-1]).max():.1e}")\n'
            "assert np.allclose(a, run.a[-1], rtol=1e-6, atol=1e-6 * (1 + np.abs(a).max()))"
        )
    if not compares_accelerations:
        return head + (
            "theirs = simulation.phi_q(end, run.q[-1])\n"
            'print(f"Φ_q at {end:g} s: largest difference {np.abs(entries - theirs).max():.1e}")\n'
            "assert np.allclose(entries, theirs, rtol=1e-9, atol=1e-9 * (1 + np.abs(theirs).max()))"
        )
    return head + (
        'mass, forces = derived["M"](end, run.q[-1], run.v[-1]), derived["g"](end, run.q[-1], run.v[-1])\n'
        "system = np.block([[mass, entries.T], [entries, np.zeros((len(entries), len(entries)))]])\n"
        "solved = np.linalg.solve(system, np.concatenate([forces[:, 0], right[:, 0]]))\n"
        "a = solved[: len(mass)]  # the other entries are the multipliers λ\n"
        'print(f"q̈ at {end:g} s: largest difference {np.abs(a - run.a[-1]).max():.1e}, of {np.abs(a).max():.3g}")\n'
        "assert np.allclose(a, run.a[-1], rtol=1e-6, atol=1e-6 * (1 + np.abs(a).max()))"
    )
