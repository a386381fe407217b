"""A function as it is read: branches as lines, nothing copied under another name.

Only what is written changes: values stay as they are, with the order of their terms, so that every target computes the
same bits. What a symbol is called in the text is in `Kernel.names`, branches are in `Readable.branches`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import sympy as sp

from gudgeon.generator.ir.branches import Branches
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import Place

NUMBERS = "p->"  # the numbers of a run: read where they are used


@dataclass(frozen=True)
class Readable:
    """Sections, what symbols and locals are called, what branches are called, where corners are counted from."""

    sections: tuple[Section, ...]
    names: Mapping[str, str] = field(default_factory=dict)
    branches: Mapping[sp.Expr, str] = field(default_factory=dict)
    first_corner: int | None = None


def readable(kernel: Kernel, branching: bool = True) -> Readable:
    """Without copies of arguments and numbers; with lines for branches."""
    arguments = {argument.name for argument in kernel.arguments}
    names = dict(kernel.names)
    taken = {name for section in kernel.sections for line in section.statements for name in (*line.reads, line.defines)}
    branches = Branches(taken | arguments | set(names.values()))
    sections = []
    for section in kernel.sections:
        lines = _without_copies(section.statements, arguments, names)
        sections.append(Section(section.title, tuple(branches.lines(lines) if branching else lines)))
    kept = tuple(section for section in sections if section.statements)
    return Readable(kept, names, branches.names, kernel.first_corner)


def lines(statements: Sequence[Statement]) -> Readable:
    """Statements that stand in a function of a template."""
    return readable(Kernel("", (), (), (Section("", tuple(statements)),)))


def _without_copies(lines: Sequence[Line], arguments: Collection[str], names: dict[str, str]) -> list[Line]:
    """Locals that are no more than an argument or a number of the run are read there, under the name that it has."""
    kept: list[Line] = []
    for line in lines:
        if isinstance(line, Statement) and line.local and isinstance(line.value, Place):
            text = line.value.text
            if text in arguments or text.startswith(NUMBERS):
                names[line.target] = text
                continue
        if kept and (stored := _stored(kept[-1], line)):
            names[kept[-1].defines] = stored.target
            kept[-1] = stored
            continue
        kept.append(line)
    return kept


def _stored(before: Line, line: Line) -> Statement | None:
    """`p->x = value` for `y = value` and then `p->x = y`."""
    if not (isinstance(before, Statement) and isinstance(line, Statement) and before.local and not line.local):
        return None
    same = line.target.startswith(NUMBERS) and line.value == sp.Symbol(before.target, real=True)
    return replace(before, target=line.target, local=False) if same else None
