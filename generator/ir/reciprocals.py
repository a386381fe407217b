"""Divisions as products: one reciprocal for each denominator, those of parameters alone computed once a run.

A division occupies the processor's divider for as long as several products take. Force laws divide by the same
few lengths repeatedly.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.symbols.storage import PlaceSymbol


def is_division(part: sp.Basic) -> bool:
    """Return whether an expression is x^-n, n an integer, of an x that is not a number."""
    return bool(part.is_Pow and part.exp.is_Integer and part.exp < 0 and part.free_symbols)


def base_name(power: sp.Basic) -> str:
    """Return the name for a local 1/x: that of x if it is a symbol."""
    if isinstance(power.base, PlaceSymbol):
        return power.base.place.member
    return power.base.name if power.base.is_Symbol else "sum"


def hoisted(slots: ParameterTable, value: sp.Expr) -> sp.Expr:
    """Return the value with reciprocals of constant denominators as derived parameters."""

    def constant(part: sp.Basic) -> bool:
        """Return whether a part divides by parameters alone."""
        return is_division(part) and slots.is_constant(part.base)

    def derived(part: sp.Pow) -> sp.Expr:
        """Return the division as a power of a derived parameter."""
        name = base_name(part)
        return slots.derive(f"inverse_{name}", 1 / part.base, f"1/{name}") ** -part.exp

    return value.replace(constant, derived) if value.has(sp.Pow) else value


def with_reciprocals(kernel: Kernel) -> Kernel:
    """Return the kernel with each denominator that occurs more than once as a local `inverse_…`."""
    return replace(kernel, sections=tuple(_divided(kernel.sections)))


def _divided(sections: tuple[Section, ...]) -> list[Section]:
    """Return the sections with a local for each denominator that occurs more than once."""
    statements = [s for section in sections for s in section.statements if isinstance(s, Statement)]
    values = [s.value for s in statements if isinstance(s.value, sp.Expr)]
    often = Counter(part.base for value in values for part in sp.preorder_traversal(value) if is_division(part))
    used = {s.defines for s in statements}
    names: dict[sp.Expr, sp.Symbol] = {}

    def shared(part: sp.Basic) -> bool:
        """Return whether a part is a division by a denominator that occurs more than once."""
        return is_division(part) and often[part.base] > 1

    found = []
    for section in sections:
        kept: list[Line] = []
        for item in section.statements:
            if isinstance(item, Statement) and isinstance(item.value, sp.Expr) and item.value.has(sp.Pow):
                for part in sp.postorder_traversal(item.value):
                    if shared(part) and part.base not in names:
                        names[part.base] = _new(part, used)
                        kept.append(Statement(names[part.base].name, 1 / part.base))
                item = replace(item, value=item.value.replace(shared, lambda part: names[part.base] ** -part.exp))
            kept.append(item)
        found.append(Section(section.title, tuple(kept)))
    return found


def _new(power: sp.Basic, used: set[str]) -> sp.Symbol:
    """Return a new symbol for a reciprocal and add its name to `used`."""
    expected = name = f"inverse_{base_name(power)}"
    for k in range(2, len(used) + 3):
        if name not in used:
            break
        name = f"{expected}_{k}"
    used.add(name)
    return sp.Symbol(name, real=True)
