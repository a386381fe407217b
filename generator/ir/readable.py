"""Readable form of a generated function: branches as separate lines, copies of values removed (copy propagation).

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
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.symbols.storage import Key, StorageLocation, make_real_symbol

_DENOMINATORS = tuple(k for k in range(1, 361) if 360 % k == 0)  # whole and half degrees, turns in a minute
_MAX_NUMERATOR = 1000  # times PI


@dataclass(frozen=True)
class Readable:
    """Sections of a function with the names of symbols, locals and branches in the text, and its first switch."""

    sections: tuple[Section, ...]
    names: Mapping[Key, Key] = field(default_factory=dict)
    branches: Mapping[sp.Expr, str] = field(default_factory=dict)
    first_switch: int | None = None


@dataclass(frozen=True)
class FractionOfPi:
    """A number `numerator` · π / `denominator`, computed from left to right."""

    numerator: int
    denominator: int

    @property
    def value(self) -> float:
        """Return the float `numerator` · π / `denominator`, rounded as a target rounds it."""
        return self.numerator * math.pi / self.denominator

    @property
    def is_pi(self) -> bool:
        """Return whether the number is π itself."""
        return self.numerator == self.denominator == 1

    def format(self, pi: str, integer_suffix: str = "") -> str:
        """Return the source text of the number, such as "3*PI/2".

        `pi` is the name of π in the language, `integer_suffix` the suffix of its integer literals.
        """
        numerator = {1: pi, -1: f"-{pi}"}.get(self.numerator, f"{self.numerator}{integer_suffix}*{pi}")
        return numerator if self.denominator == 1 else f"{numerator}/{self.denominator}{integer_suffix}"


def convert_to_fraction_of_pi(number: sp.Expr) -> FractionOfPi | None:
    """Return a number as a fraction of π that has the same bits as a float, such as 3 π/2; None if there is none.

    `number`: a SymPy float, or a rational number times π. A float must be k π/d with d a divisor of 360 and |k| ≤
    1000. An exact integer multiple of π gives None.
    """
    if number.is_Float:
        return _find_fraction_of_pi(float(sp.Float(number, 17)))
    ratio, remainder = number.as_coeff_Mul()
    if remainder is not sp.pi or not ratio.is_Rational or ratio.q == 1:
        return None
    fraction = FractionOfPi(int(ratio.p), int(ratio.q))
    return fraction if fraction.value == float(ratio) * math.pi else None


@lru_cache(10_000)
def _find_fraction_of_pi(value: float) -> FractionOfPi | None:
    """Return a float as a fraction numerator · π / denominator with the same bits, or None if there is none.

    The denominator is the smallest possible divisor of 360; |numerator| is from 1 to 1000. Results are cached.
    """
    if not 0 < abs(value) <= _MAX_NUMERATOR * math.pi:
        return None
    candidates = (FractionOfPi(round(value * divisor / math.pi), divisor) for divisor in _DENOMINATORS)
    return next(
        (
            fraction
            for fraction in candidates
            if 0 < abs(fraction.numerator) <= _MAX_NUMERATOR and fraction.value == value
        ),
        None,
    )


def make_readable(kernel: Kernel, name_branches: bool = True) -> Readable:
    """Return the readable form of a kernel: without copies of arguments and parameters, with a line for each branch.

    A branch is a conditional value, of min or `where` for example; `name_branches` False leaves it inside the
    expressions. The lines `y = value` and `p.x = y` are merged. Empty sections are removed; values and the order of
    their terms stay.
    """
    arguments = {argument.name for argument in kernel.arguments}
    names = dict(kernel.names)
    used_names = set[str]()
    for section in kernel.sections:
        for line in section.statements:
            used_names.update(line.reads, (line.declared_local,))
    branches = Branches(used_names | arguments | {str(name_) for name_ in names.values()})
    sections = []
    for section in kernel.sections:
        lines = _remove_copies(section.statements, arguments, names)
        sections.append(Section(section.title, tuple(branches.insert_branches(lines) if name_branches else lines)))
    nonempty = tuple(section for section in sections if section.statements)
    return Readable(nonempty, names, branches.names, kernel.first_switch)


def make_readable_statements(statements: Sequence[Statement]) -> Readable:
    """Return the readable form of statements that are printed in a function of a template.

    They form one section without a title.
    """
    return make_readable(Kernel("", (), (), (Section("", tuple(statements)),)))


def _remove_copies(
    lines: Sequence[Instruction], arguments: Collection[str], names: dict[Key, Key]
) -> list[Instruction]:
    """Return the lines without locals that are copies of arguments or parameters.

    `names` is changed in place: it maps each removed local to the storage location that is read instead. The
    assignment of a local that the next line stores to a parameter is merged with that line.
    """
    result: list[Instruction] = []
    for line in lines:
        place = line.value if isinstance(line, Statement) and line.declared_local else None
        if isinstance(place, StorageLocation) and (place.is_parameter or (not place.path and place.base in arguments)):
            names[line.declared_local] = place
            continue
        if result and (merged := _merge_copy_to_parameter(result[-1], line)):
            names[result[-1].declared_local] = merged.target
            result[-1] = merged
            continue
        result.append(line)
    return result


def _merge_copy_to_parameter(assignment: Instruction, copy_line: Instruction) -> Statement | None:
    """Return `p.x = value` for the successive lines `y = value` and `p.x = y`, where p.x is a parameter of the run.

    Return None for all other pairs of lines.
    """
    if not (isinstance(assignment, Statement) and isinstance(copy_line, Statement) and assignment.declared_local):
        return None
    if not (isinstance(copy_line.target, StorageLocation) and copy_line.target.is_parameter):
        return None
    is_copy = copy_line.value == make_real_symbol(assignment.declared_local)
    return replace(assignment, target=copy_line.target) if is_copy else None
