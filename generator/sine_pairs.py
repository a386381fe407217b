"""Sines and cosines side by side: the pairs of a kernel are computed four at a time (trigonometry.c).

Library calls for each pair cost more than half of a small right-hand side. Four angles in one vector take hardly
longer than one; a last incomplete group repeats its last angle. A single pair takes a twentieth of the time of a
small run longer than the library's, and is put into a vector all the same: runs side by side then have it too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.kernels import Kernel, Section, Statement


def side_by_side(kernel: Kernel) -> Kernel:
    """The kernel with the cosines and sines of symbols taken from vectors, as soon as their angles are known."""
    return replace(kernel, sections=tuple(_grouped(section, _vectors) for section in kernel.sections))


def lane_by_lane(kernel: Kernel) -> Kernel:
    """The same angles, each already a vector of as many runs (lanes.h): the same functions, so the same bits."""
    return replace(kernel, sections=tuple(_grouped(section, _lanes) for section in kernel.sections))


def _angle(statement: Statement | str) -> sp.Symbol | None:
    """The symbol whose cosine or sine a statement is."""
    value = statement.value if isinstance(statement, Statement) else None
    return value.args[0] if isinstance(value, (sp.cos, sp.sin)) and value.args[0].is_Symbol else None


def _grouped(
    section: Section, written: Callable[[Sequence[sp.Symbol | None], Sequence[Statement]], list[Statement | str]]
) -> Section:
    """First what the angles need, then these as they are `written`, then the rest."""
    statements = [s for s in section.statements if isinstance(s, Statement) and isinstance(s.value, sp.Expr)]
    if len(statements) < len(section.statements):
        return section
    places = {s.target: k for k, s in enumerate(statements)}
    needs: list[frozenset[int]] = []  # earlier statements that each one reads, directly or not
    for k, s in enumerate(statements):
        reads = s.value.free_symbols if isinstance(s.value, sp.Expr) else set()
        direct = [places[x.name] for x in reads if places.get(x.name, k) < k]
        needs.append(frozenset(direct).union(*(needs[j] for j in direct)))
    turned = [k for k, s in enumerate(statements) if _angle(s) is not None]
    turned = [k for k in turned if not needs[k] & set(turned)]
    angles = list(dict.fromkeys(_angle(statements[k]) for k in turned))
    if not angles:
        return section
    early = frozenset[int]().union(*(needs[k] for k in turned))
    first = [s for k, s in enumerate(statements) if k in early]
    rest = [s for k, s in enumerate(statements) if k not in early and k not in turned]
    taken = [statements[k] for k in turned]
    return Section(section.title, (*first, *written(angles, taken), *rest))


def _vectors(angles: Sequence[sp.Symbol | None], taken: Sequence[Statement]) -> list[Statement | str]:
    """Groups of four angles, and the statements that read the results."""
    lines: list[Statement | str] = []
    for g in range(0, len(angles), 4):
        names = [str(a) for a in angles[g : g + 4]]
        names += [names[-1]] * (4 - len(names))
        n = g // 4
        lines.append(f"const Four angles_{n} = {{{', '.join(names)}}};")
        lines.append(f"Four sines_{n}, cosines_{n};")
        lines.append(f"sines_and_cosines(&angles_{n}, &sines_{n}, &cosines_{n});")
    for s in taken:
        k = angles.index(_angle(s))
        which = "cosines" if isinstance(s.value, sp.cos) else "sines"
        lines.append(Statement(s.target, f"{which}_{k // 4}[{k % 4}]", s.local, s.comment))
    return lines


def _lanes(angles: Sequence[sp.Symbol | None], taken: Sequence[Statement]) -> list[Statement | str]:
    """One call an angle, and the statements that read the results."""
    lines: list[Statement | str] = []
    for k, angle in enumerate(angles):
        lines.append(f"Lanes sine_{k}, cosine_{k};")
        lines.append(f"sines_and_cosines({angle}, &sine_{k}, &cosine_{k}, rare);")
    for s in taken:
        which = "cosine" if isinstance(s.value, sp.cos) else "sine"
        lines.append(Statement(s.target, f"{which}_{angles.index(_angle(s))}", s.local, s.comment))
    return lines
