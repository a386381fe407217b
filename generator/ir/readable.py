"""Readable form of a function: branches as lines, and no copies of values under other names.

Only the text changes: values stay as they are, with the order of their terms, so that every target computes the
same bits. The names of symbols in the text are in `Kernel.names`, those of branches in `Readable.branches`.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

import sympy as sp

from gudgeon.generator.ir.branches import Branches
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.symbols.storage import Key, Place

_DENOMINATORS = tuple(k for k in range(1, 361) if 360 % k == 0)  # whole and half degrees, turns in a minute
_MOST = 1000  # times PI


@dataclass(frozen=True)
class Readable:
    """Sections of a function with the names of symbols, locals and branches in the text, and its first switch."""

    sections: tuple[Section, ...]
    names: Mapping[Key, Key] = field(default_factory=dict)
    branches: Mapping[sp.Expr, str] = field(default_factory=dict)
    first_corner: int | None = None


@dataclass(frozen=True)
class ShareOfPi:
    """A number count π/of, computed from left to right: the same bits as the number that it replaces."""

    count: int
    of: int

    @property
    def value(self) -> float:
        """Return the number as a target computes it."""
        return self.count * math.pi / self.of

    @property
    def is_one(self) -> bool:
        """Return whether the number is π itself."""
        return self.count == self.of == 1

    def text(self, pi: str, whole: str = "") -> str:
        """Return the text of the number; `pi` and the suffix `whole` of integers are those of the language."""
        above = {1: pi, -1: f"-{pi}"}.get(self.count, f"{self.count}{whole}*{pi}")
        return above if self.of == 1 else f"{above}/{self.of}{whole}"


def share_of_pi(number: sp.Expr) -> ShareOfPi | None:
    """Return a number as a simple fraction of π, if that is exact to the last bit; None otherwise.

    number: a float, or a ratio times π.
    """
    if number.is_Float:
        return _share_of_pi(float(sp.Float(number, 17)))
    ratio, rest = number.as_coeff_Mul()
    if rest is not sp.pi or not ratio.is_Rational or ratio.q == 1:
        return None
    found = ShareOfPi(int(ratio.p), int(ratio.q))
    return found if found.value == float(ratio) * math.pi else None


@lru_cache(10_000)
def _share_of_pi(value: float) -> ShareOfPi | None:
    """Return a float as a simple fraction of π with the same bits; None if there is none."""
    if not 0 < abs(value) <= _MOST * math.pi:
        return None
    tried = (ShareOfPi(round(value * of / math.pi), of) for of in _DENOMINATORS)
    return next((share for share in tried if 0 < abs(share.count) <= _MOST and share.value == value), None)


def readable(kernel: Kernel, branching: bool = True) -> Readable:
    """Return the readable form of a kernel: without copies of arguments and parameters, with lines for branches."""
    arguments = {argument.name for argument in kernel.arguments}
    names = dict(kernel.names)
    used = {name for section in kernel.sections for line in section.statements for name in (*line.reads, line.defines)}
    branches = Branches(used | arguments | {str(called) for called in names.values()})
    sections = []
    for section in kernel.sections:
        lines = _without_copies(section.statements, arguments, names)
        sections.append(Section(section.title, tuple(branches.lines(lines) if branching else lines)))
    kept = tuple(section for section in sections if section.statements)
    return Readable(kept, names, branches.names, kernel.first_corner)


def lines(statements: Sequence[Statement]) -> Readable:
    """Return the readable form of statements that stand in a function of a template."""
    return readable(Kernel("", (), (), (Section("", tuple(statements)),)))


def _without_copies(lines: Sequence[Line], arguments: Collection[str], names: dict[Key, Key]) -> list[Line]:
    """Return the lines without locals that are copies of arguments or parameters; these are read directly."""
    kept: list[Line] = []
    for line in lines:
        place = line.value if isinstance(line, Statement) and line.defines else None
        if isinstance(place, Place) and (place.is_parameter or (not place.path and place.base in arguments)):
            names[line.defines] = place
            continue
        if kept and (stored := _stored(kept[-1], line)):
            names[kept[-1].defines] = stored.target
            kept[-1] = stored
            continue
        kept.append(line)
    return kept


def _stored(before: Line, line: Line) -> Statement | None:
    """Return `p.x = value` for `y = value` followed by `p.x = y`, where p.x is a parameter; None otherwise."""
    if not (isinstance(before, Statement) and isinstance(line, Statement) and before.defines):
        return None
    same = line.value == sp.Symbol(before.defines, real=True)
    stored = same and isinstance(line.target, Place) and line.target.is_parameter
    return replace(before, target=line.target) if stored else None
