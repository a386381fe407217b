"""Cosines and sines in vectors: the pairs of a kernel are computed four at a time (trigonometry.c).

Library calls for each pair cost more than half of a small right-hand side. Four angles in one vector take hardly
longer than one; an incomplete last group repeats its last angle. A single pair takes a twentieth of the time of a
small run longer than the library's, and is put into a vector all the same, so that lanes use the same function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section, changed
from gudgeon.generator.ir.statements import Line, Sines, Statement
from gudgeon.generator.symbols.storage import Place

MANY = 4  # groups, beyond which they are computed in a loop
# Angles, statements that turn them, how many a kernel has numbered before: lines, how many it has numbered then.
Written = Callable[[Sequence[sp.Symbol], Sequence[Statement], int], tuple[list[Line], int]]


def pair_sines(kernel: Kernel) -> Kernel:
    """Return the kernel with cosines and sines computed in vectors, as soon as their angles are known."""
    return _paired(kernel, _vectors)


def call_sines_by_lane(kernel: Kernel) -> Kernel:
    """Return the kernel with cosines and sines of angles that are vectors of several runs (lanes.h).

    The same functions are used, so that the bits are the same.
    """
    return _paired(kernel, _lanes)


def _paired(kernel: Kernel, written: Written) -> Kernel:
    """Return the kernel with grouped cosines and sines, section by section; known ones are not computed again."""
    known: dict[sp.Expr, sp.Symbol] = {}
    sections: list[Section] = []
    first = 0  # groups, or angles, so far
    for section in kernel.sections:
        again = tuple(_known(statement, known) for statement in section.statements)
        grouped, first = _grouped(Section(section.title, again), written, first)
        sections.append(grouped)
        for statement in section.statements:
            if _angle(statement) is not None and isinstance(statement, Statement) and statement.defines:
                known.setdefault(sp.sympify(statement.value), sp.Symbol(statement.defines, real=True))
    return replace(kernel, sections=tuple(sections))


def _known(line: Line, known: Mapping[sp.Expr, sp.Symbol]) -> Line:
    """Return a line that reads a cosine or sine of an earlier section instead of computing it."""
    return changed(line, lambda value: known.get(value, value))


def _angle(statement: Line) -> sp.Symbol | None:
    """Return the symbol whose cosine or sine a statement computes; None for other statements."""
    value = statement.value if isinstance(statement, Statement) else None
    return value.args[0] if isinstance(value, (sp.cos, sp.sin)) and value.args[0].is_Symbol else None


def _grouped(section: Section, written: Written, before: int) -> tuple[Section, int]:
    """Return a section with what the angles need first, then the grouped functions, then the rest.

    The number of groups so far is `before`, and is returned increased.
    """
    statements = [s for s in section.statements if isinstance(s, Statement) and isinstance(s.value, sp.Basic)]
    if len(statements) < len(section.statements):
        return section, before
    places = {s.target: k for k, s in enumerate(statements)}
    needs: list[frozenset[int]] = []  # earlier statements that each one reads, directly or not
    for k, s in enumerate(statements):
        reads = s.value.free_symbols if isinstance(s.value, sp.Basic) else set()
        direct = [places[x.name] for x in reads if places.get(x.name, k) < k]
        needs.append(frozenset(direct).union(*(needs[j] for j in direct)))
    turned = [k for k, s in enumerate(statements) if _angle(s) is not None]
    turned = [k for k in turned if not needs[k] & set(turned)]
    angles = list(dict.fromkeys(a for k in turned if (a := _angle(statements[k])) is not None))
    if not angles:
        return section, before
    early = frozenset[int]().union(*(needs[k] for k in turned))
    first = [s for k, s in enumerate(statements) if k in early]
    rest = [s for k, s in enumerate(statements) if k not in early and k not in turned]
    used = [statements[k] for k in turned]
    lines, after = written(angles, used, before)
    return Section(section.title, (*first, *lines, *rest)), after


def _vectors(angles: Sequence[sp.Symbol], used: Sequence[Statement], before: int) -> tuple[list[Line], int]:
    """Return the lines for groups of four angles, and the statements that read the results.

    More than MANY groups are computed in a loop, which is shorter.
    """
    named = [*angles, *[angles[-1]] * (-len(angles) % 4)]
    count = len(named) // 4
    many, of = count > MANY, f"of_{before}" if before else "of"
    if many:
        lines: list[Line] = [Sines(tuple(named), of, count)]
    else:
        lines = [Sines(tuple(named[4 * n : 4 * n + 4]), str(before + n)) for n in range(count)]
    places = {angle: k for k, angle in enumerate(angles)}
    for s in used:
        n, lane = divmod(places[_angle(s)], 4)
        which = "cosines" if isinstance(s.value, sp.cos) else "sines"
        vector = Place(f"{which}_{of}")[n] if many else Place(f"{which}_{before + n}")
        lines.append(replace(s, value=vector[lane]))
    return lines, before + count


def _lanes(angles: Sequence[sp.Symbol], used: Sequence[Statement], before: int) -> tuple[list[Line], int]:
    """Return one call for each angle, and the statements that read the results."""
    place = {angle: k for k, angle in enumerate(angles, before)}
    lines: list[Line] = [Sines((angle,), str(k), lanes=True) for angle, k in place.items()]
    for s in used:
        which = "cosines" if isinstance(s.value, sp.cos) else "sines"
        lines.append(replace(s, value=Place(f"{which}_{place[_angle(s)]}")))
    return lines, before + len(place)
