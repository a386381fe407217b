"""What series look for in a function's lines: angles that are differences, and what of a sum is known early."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.statements import Line, Statement

Titled = tuple[str, Line]  # a line and its section's title


def late_last(lines: Iterable[Titled], unique: Callable[[str], str]) -> list[Titled]:
    """What is known last of a sum is added last, so that nothing waits for it that need not; `unique` gives names."""
    depth: dict[str, int] = {}

    def late(value: sp.Expr) -> int:
        return max((depth.get(s.name, 0) for s in value.free_symbols), default=0)

    ordered: list[Titled] = []
    for title, line in lines:
        if isinstance(line, Statement) and isinstance(line.value, sp.Expr):
            value: sp.Expr = line.value
            parts = sorted(sp.Add.make_args(value), key=late)
            known = parts[:1]
            for before, part in itertools.pairwise(parts if line.defines else []):
                if late(part) > late(before) and len(known) > 1:
                    name = unique(f"{line.defines}_known")
                    ordered.append((title, Statement(name, sp.Add(*known))))
                    depth[name] = late(before)
                    known = [sp.Symbol(name, real=True)]
                known.append(part)
            depth[line.defines] = 1 + late(value)
            line = replace(line, value=sp.Add(*known)) if line.defines else line
        ordered.append((title, line))
    return ordered


def differences(statements: Iterable[Statement]) -> dict[str, tuple[sp.Expr, str, int]]:
    """Cosines and sines of a - b that are made of those of a and b: a - b, the other of the two, by which sign."""
    values = {line.defines: line.value for line in statements if line.defines and isinstance(line.value, sp.Expr)}
    turned = {name: value for name, value in values.items() if isinstance(value, (sp.cos, sp.sin))}
    found: dict[sp.Expr, dict[type, str]] = {}
    for target, value in values.items():
        if value.is_Add and len(value.args) == 2 and all(s.name in turned for s in value.free_symbols):
            whole = value.xreplace({s: turned[s.name] for s in value.free_symbols})
            angles = sorted({x.args[0] for x in whole.atoms(sp.cos, sp.sin)}, key=str)
            for one, other in itertools.permutations(angles) if len(angles) == 2 else ():
                for function in (sp.cos, sp.sin):
                    if whole == sp.expand_trig(function(one - other)):
                        found.setdefault(one - other, {}).setdefault(function, target)
    pairs: dict[str, tuple[sp.Expr, str, int]] = {}
    for angle, both in found.items():
        if sp.cos in both and sp.sin in both:
            cosine, sine = both[sp.cos], both[sp.sin]
            pairs |= {cosine: (angle, sine, -1), sine: (angle, cosine, 1)}
    return pairs
