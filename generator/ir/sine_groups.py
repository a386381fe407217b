"""Sines and cosines of several angles in SIMD vectors, four at a time (engine/scene/trigonometry.h).

Library calls for each pair cost more than half of a small right-hand side. Four angles in one vector take hardly
longer than one; an incomplete last group repeats its last angle. A single pair takes a twentieth of the time of a
small run longer than the library's, and is put into a vector all the same, so that lanes use the same function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section, change_expression
from gudgeon.generator.ir.statements import Instruction, Sines, Statement
from gudgeon.generator.symbols.derivatives import find_symbols
from gudgeon.generator.symbols.storage import StorageLocation, make_real_symbol

_MAX_VECTORS = 4  # groups, beyond which they are computed in a loop
# Angles, statements that turn them, how many a kernel has numbered before: lines, how many it has numbered then.
_MakeLines = Callable[[Sequence[sp.Symbol], Sequence[Statement], int], tuple[list[Instruction], int]]


def vectorize_sines(kernel: Kernel) -> Kernel:
    """Return the kernel with its cosines and sines computed four angles at a time, in SIMD vectors.

    Each vector is computed as soon as its angles are known. Sections with lines other than assignments of expressions
    stay unchanged. The function is for single runs; lanes use `call_sines_by_lane`.
    """
    return _group_sines(kernel, _make_vectors)


def call_sines_by_lane(kernel: Kernel) -> Kernel:
    """Return the kernel for lanes, with a call for the cosine and sine of each angle, a vector over several runs.

    The functions are those of single runs, so that the results have the same bits. They are in lanes.h.
    """
    return _group_sines(kernel, _make_lane_calls)


def _group_sines(kernel: Kernel, make_lines: _MakeLines) -> Kernel:
    """Return the kernel with the cosines and sines of each section computed together.

    A cosine or sine that an earlier section computes is not computed again (a common subexpression).
    `make_lines(angles, statements, n)` makes the lines; n counts the vectors or angles before.
    """
    symbol_of_function: dict[sp.Expr, sp.Symbol] = {}
    sections: list[Section] = []
    n_groups = 0  # groups, or angles, so far
    for section in kernel.sections:
        simplified = tuple(_replace_common_sines(statement, symbol_of_function) for statement in section.statements)
        new_section, n_groups = _group_sines_in_section(Section(section.title, simplified), make_lines, n_groups)
        sections.append(new_section)
        for statement in section.statements:
            if _find_angle(statement) is not None and isinstance(statement, Statement) and statement.declared_local:
                symbol_of_function.setdefault(sp.sympify(statement.value), make_real_symbol(statement.declared_local))
    return replace(kernel, sections=tuple(sections))


def _replace_common_sines(line: Instruction, known_symbols: Mapping[sp.Expr, sp.Symbol]) -> Instruction:
    """Return a line with its value replaced by a local if an earlier section computes that cosine or sine.

    This eliminates common subexpressions. `known_symbols` gives the symbol of the local by value. Other lines are
    returned unchanged.
    """
    return change_expression(line, lambda value: known_symbols.get(value, value))


def _find_angle(statement: Instruction) -> sp.Symbol | None:
    """Return the symbol whose cosine or sine a statement assigns; None for all other lines."""
    value = statement.value if isinstance(statement, Statement) else None
    return value.args[0] if isinstance(value, (sp.cos, sp.sin)) and value.args[0].is_Symbol else None


def _group_sines_in_section(section: Section, make_lines: _MakeLines, n_groups: int) -> tuple[Section, int]:
    """Return the section with its cosines and sines in groups, as early as possible, and the new number of groups.

    `make_lines` makes the lines of groups; `n_groups`: the number before. Statements that the angles depend on come
    first, then the groups, then the other statements. A cosine or sine whose angle itself depends on a cosine or sine
    of the section stays single. A section with lines that are not assignments of expressions, or without angles, is
    returned unchanged.
    """
    statements = [
        statement
        for statement in section.statements
        if isinstance(statement, Statement) and isinstance(statement.value, sp.Basic)
    ]
    if len(statements) < len(section.statements):
        return section, n_groups
    index_by_target = {statement.target: k for k, statement in enumerate(statements)}
    operands: list[list[int]] = []  # earlier statements that each one reads
    reads_sines: list[bool] = []  # whether each one reads a cosine or sine, directly or not
    for k, statement in enumerate(statements):
        names = (symbol.name for symbol in find_symbols(statement.value))
        operands.append([index for name in names if (index := index_by_target.get(name, k)) < k])
        reads_sines.append(any(reads_sines[j] or _find_angle(statements[j]) is not None for j in operands[k]))
    trigonometric = {
        k: angle for k, statement in enumerate(statements) if (angle := _find_angle(statement)) and not reads_sines[k]
    }
    angles = list(dict.fromkeys(trigonometric.values()))
    if not angles:
        return section, n_groups
    early_indices, pending = set[int](), [operand for k in trigonometric for operand in operands[k]]
    while pending:
        if (k := pending.pop()) not in early_indices:
            early_indices.add(k)
            pending += operands[k]
    early_statements = [statement for k, statement in enumerate(statements) if k in early_indices]
    late_statements = [
        statement for k, statement in enumerate(statements) if k not in early_indices and k not in trigonometric
    ]
    replaced = [statements[k] for k in trigonometric]
    lines, n_after = make_lines(angles, replaced, n_groups)
    return Section(section.title, (*early_statements, *lines, *late_statements)), n_after


def _make_vectors(
    angles: Sequence[sp.Symbol], statements: Sequence[Statement], n_vectors: int
) -> tuple[list[Instruction], int]:
    """Return the lines that compute sines and cosines in vectors of four angles, and the new number of vectors.

    The lines end with `statements`, which computed them one by one and now read the vectors. `n_vectors`: the number of
    vectors before. More than _MAX_VECTORS vectors are computed in a loop. The last one repeats its last angle.
    """
    padded = [*angles, *[angles[-1]] * (-len(angles) % 4)]
    count = len(padded) // 4
    in_loop, suffix = count > _MAX_VECTORS, f"of_{n_vectors}" if n_vectors else "of"
    if in_loop:
        lines: list[Instruction] = [Sines(tuple(padded), suffix, count)]
    else:
        lines = [Sines(tuple(padded[4 * n : 4 * n + 4]), str(n_vectors + n)) for n in range(count)]
    index_by_angle = {angle: k for k, angle in enumerate(angles)}
    for statement in statements:
        n, lane = divmod(index_by_angle[_find_angle(statement)], 4)
        array = "cosines" if isinstance(statement.value, sp.cos) else "sines"
        vector = StorageLocation(f"{array}_{suffix}")[n] if in_loop else StorageLocation(f"{array}_{n_vectors + n}")
        lines.append(replace(statement, value=vector[lane]))
    return lines, n_vectors + count


def _make_lane_calls(
    angles: Sequence[sp.Symbol], statements: Sequence[Statement], n_angles: int
) -> tuple[list[Instruction], int]:
    """Return a call for each angle with the statements that read its results, and the new number of angles.

    A call computes the cosine and sine of an angle in all lanes. `statements`: those that computed the cosines and
    sines one by one; `n_angles`: the number of angles before.
    """
    index_by_angle = {angle: k for k, angle in enumerate(angles, n_angles)}
    lines: list[Instruction] = [Sines((angle,), str(k), lanes=True) for angle, k in index_by_angle.items()]
    for statement in statements:
        array = "cosines" if isinstance(statement.value, sp.cos) else "sines"
        lines.append(replace(statement, value=StorageLocation(f"{array}_{index_by_angle[_find_angle(statement)]}")))
    return lines, n_angles + len(index_by_angle)
