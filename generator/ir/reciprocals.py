"""Divisions as products with reciprocals (strength reduction); those of parameters are computed once per run.

A division occupies the processor's divider for as long as several products take. Force laws divide by the same
few lengths repeatedly.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.storage import StoredSymbol


def is_division(expression: sp.Basic) -> bool:
    """Return whether an expression is x^-n with a positive integer n and an x that contains a symbol."""
    return bool(expression.is_Pow and expression.exp.is_Integer and expression.exp < 0 and expression.free_symbols)


def find_base_name(power: sp.Basic) -> str:
    """Return the name of the base x of a power: its symbol or struct member, or "sum" for other expressions."""
    if isinstance(power.base, StoredSymbol):
        return power.base.storage_location.member
    return power.base.name if power.base.is_Symbol else "sum"


def hoist_reciprocals(parameter_table: ParameterTable, value: sp.Expr) -> sp.Expr:
    """Return the value with divisions by constants as products with derived parameters 1/x, computed once a run.

    Constants are expressions of parameters alone. The derived parameters are added to `parameter_table`.
    """

    def is_constant_division(expression: sp.Basic) -> bool:
        """Return whether an expression is a division by parameters alone."""
        return is_division(expression) and parameter_table.is_constant(expression.base)

    def derive_reciprocal(division: sp.Pow) -> sp.Expr:
        """Return the division as a power of a derived parameter 1/x, which is added to the table."""
        name = find_base_name(division)
        return parameter_table.derive_parameter(f"inverse_{name}", 1 / division.base, f"1/{name}") ** -division.exp

    return value.replace(is_constant_division, derive_reciprocal) if value.has(sp.Pow) else value


def share_reciprocals(kernel: Kernel) -> Kernel:
    """Return the kernel with each denominator that occurs more than once computed once, as a local `inverse_…`."""
    return replace(kernel, sections=tuple(_share_denominators(kernel.sections)))


def _share_denominators(sections: tuple[Section, ...]) -> list[Section]:
    """Return the sections with 1/x as a local for each denominator x that occurs more than once.

    The local is assigned before the first statement that reads it, and divisions become products with it: common
    subexpression elimination.
    """
    statements = [s for section in sections for s in section.statements if isinstance(s, Statement)]
    values = [s.value for s in statements if isinstance(s.value, sp.Expr)]
    count_by_denominator = Counter(
        part.base for value in values for part in sp.preorder_traversal(value) if is_division(part)
    )
    used_names = {s.declared_local for s in statements}
    reciprocals: dict[sp.Expr, sp.Symbol] = {}

    def is_repeated_division(expression: sp.Basic) -> bool:
        """Return whether an expression is a division by a denominator that occurs more than once."""
        return is_division(expression) and count_by_denominator[expression.base] > 1

    result = []
    for section in sections:
        lines: list[Instruction] = []
        for line in section.statements:
            if isinstance(line, Statement) and isinstance(line.value, sp.Expr) and line.value.has(sp.Pow):
                for part in sp.postorder_traversal(line.value):
                    if is_repeated_division(part) and part.base not in reciprocals:
                        reciprocals[part.base] = _make_reciprocal_symbol(part, used_names)
                        lines.append(Statement(reciprocals[part.base].name, 1 / part.base))
                line = replace(
                    line,
                    value=line.value.replace(is_repeated_division, lambda part: reciprocals[part.base] ** -part.exp),
                )
            lines.append(line)
        result.append(Section(section.title, tuple(lines)))
    return result


def _make_reciprocal_symbol(power: sp.Basic, used_names: set[str]) -> sp.Symbol:
    """Return a symbol `inverse_<base>` for the reciprocal of a denominator.

    If that name is used, a suffix _2, _3, … is appended. The name is added to `used_names`.
    """
    base = name = f"inverse_{find_base_name(power)}"
    for k in range(2, len(used_names) + 3):
        if name not in used_names:
            break
        name = f"{base}_{k}"
    used_names.add(name)
    return sp.Symbol(name, real=True)
