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
_MAX_NUMERATOR = 1000  # times PI


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
        """Return the float `count` · π / `of`, rounded as a target rounds it."""
        return self.count * math.pi / self.of

    @property
    def is_one(self) -> bool:
        """Return whether the number is π itself."""
        return self.count == self.of == 1

    def text(self, pi: str, integer_suffix: str = "") -> str:
        """Return the source text of the number, such as "3*PI/2".

        `pi` is the name of π in the language, `integer_suffix` the suffix of its integer literals.
        """
        numerator = {1: pi, -1: f"-{pi}"}.get(self.count, f"{self.count}{integer_suffix}*{pi}")
        return numerator if self.of == 1 else f"{numerator}/{self.of}{integer_suffix}"


def share_of_pi(number: sp.Expr) -> ShareOfPi | None:
    """Return a number as a simple fraction of π that has the same bits as a float; None if there is none.

    `number`: a SymPy float, or a rational number times π.
    """
    if number.is_Float:
        return _find_fraction_of_pi(float(sp.Float(number, 17)))
    ratio, remainder = number.as_coeff_Mul()
    if remainder is not sp.pi or not ratio.is_Rational or ratio.q == 1:
        return None
    fraction = ShareOfPi(int(ratio.p), int(ratio.q))
    return fraction if fraction.value == float(ratio) * math.pi else None


@lru_cache(10_000)
def _find_fraction_of_pi(value: float) -> ShareOfPi | None:
    """Return a float as a fraction count·π/of with the same bits, of a divisor of 360, or None.

    Results are cached. |count| is at most 1000.
    """
    if not 0 < abs(value) <= _MAX_NUMERATOR * math.pi:
        return None
    candidates = (ShareOfPi(round(value * divisor / math.pi), divisor) for divisor in _DENOMINATORS)
    return next(
        (fraction for fraction in candidates if 0 < abs(fraction.count) <= _MAX_NUMERATOR and fraction.value == value),
        None,
    )


def readable(kernel: Kernel, branching: bool = True) -> Readable:
    """Return the readable form of a kernel: without copies of arguments and parameters, with a line for each branch.

    `branching`: False leaves the branches inside the expressions. Empty sections are removed; values and the order of
    their terms stay.
    """
    arguments = {argument.name for argument in kernel.arguments}
    names = dict(kernel.names)
    used_names = {
        name for section in kernel.sections for line in section.statements for name in (*line.reads, line.defines)
    }
    branches = Branches(used_names | arguments | {str(name_) for name_ in names.values()})
    sections = []
    for section in kernel.sections:
        lines = _remove_copies(section.statements, arguments, names)
        sections.append(Section(section.title, tuple(branches.lines(lines) if branching else lines)))
    nonempty = tuple(section for section in sections if section.statements)
    return Readable(nonempty, names, branches.names, kernel.first_corner)


def lines(statements: Sequence[Statement]) -> Readable:
    """Return the readable form of statements that are printed in a function of a template.

    They form one section without a title.
    """
    return readable(Kernel("", (), (), (Section("", tuple(statements)),)))


def _remove_copies(lines: Sequence[Line], arguments: Collection[str], names: dict[Key, Key]) -> list[Line]:
    """Return the lines without locals that are copies of arguments or parameters.

    `names` is changed in place: it maps each removed local to the place that is read instead. A local that is stored to
    a parameter in the next line is merged with that line.
    """
    result: list[Line] = []
    for line in lines:
        place = line.value if isinstance(line, Statement) and line.defines else None
        if isinstance(place, Place) and (place.is_parameter or (not place.path and place.base in arguments)):
            names[line.defines] = place
            continue
        if result and (merged := _merge_copy_to_parameter(result[-1], line)):
            names[result[-1].defines] = merged.target
            result[-1] = merged
            continue
        result.append(line)
    return result


def _merge_copy_to_parameter(first: Line, second: Line) -> Statement | None:
    """Return `p.x = value` for the lines `y = value` and `p.x = y`, where p.x is a parameter; None for other lines."""
    if not (isinstance(first, Statement) and isinstance(second, Statement) and first.defines):
        return None
    is_copy = second.value == sp.Symbol(first.defines, real=True)
    is_stored = is_copy and isinstance(second.target, Place) and second.target.is_parameter
    return replace(first, target=second.target) if is_stored else None
