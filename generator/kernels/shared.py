"""Functions that joints share: the same equations are one function of their numbers, called with those of each joint.

Numbers are called as in the law's file (`K`, `mu`), corners are counted from the joint's first. What is shared keeps
the order in which the terms of the first joint stand.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations, letter_of
from gudgeon.generator.ir.kernels import Argument, Kernel, Section
from gudgeon.generator.ir.readable import NUMBERS
from gudgeon.generator.ir.signatures import PARAMETERS, SIDES
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import Chosen, Place
from gudgeon.generator.symbols.corners import SideOf

CORNER = Argument("int", "corner")
NOTHING: Mapping[str, str] = {}
_SIDE = "side_"


@dataclass(frozen=True)
class SharedCall:
    """A joint's call: the function, the fields of Parameters that it is given (`p->pin_radius`), its first corner."""

    kernel: Kernel
    numbers: tuple[str, ...]
    corner: int | None  # None: it has no corners


class SharedFunctions:
    """The functions of a scene, each once, in the order in which they were first called."""

    def __init__(self) -> None:
        self.kernels: list[Kernel] = []
        self._known: dict[object, Kernel] = {}

    def call(
        self, kernel: Kernel, numbers: Mapping[str, str], joint: str, meanings: Mapping[str, str] = NOTHING
    ) -> SharedCall:  # fmt: skip
        """The call of a joint's own function: `numbers` are what fields (`p->pin_radius`) are called in it (`R_i`).

        `meanings` of numbers by these names go to its doc comment.
        """
        called, given = _called(kernel, numbers)
        first = min(_corners(kernel), default=None)
        if first is not None:
            called |= {f"{_SIDE}{k}": f"{_SIDE}{k - first + 1}" for k in _corners(kernel)}
        told = [f"{name}: {meanings[name]}" for name in map(called.__getitem__, given) if name in meanings]
        doc = (*kernel.doc, *textwrap.wrap("; ".join(told) + ".", 110)) if told else kernel.doc
        shared = replace(
            kernel, doc=doc, arguments=_arguments(kernel, [called[field] for field in given], first is not None),
            sections=_without_numbers(kernel), names={**kernel.names, **called}, first_corner=first,
        )  # fmt: skip
        key = (kernel.name, shared.arguments, *_contents(shared))
        if key not in self._known:
            taken = any(other.name == kernel.name for other in self.kernels)
            self._known[key] = replace(shared, name=f"{kernel.name}_of_{joint}_") if taken else shared
            self.kernels.append(self._known[key])
        return SharedCall(self._known[key], tuple(given), first)


def joint_numbers(model: Model, clearance: Clearance) -> dict[str, str]:
    """What fields of Parameters are called in the equations of a joint with play, those of its laws first."""
    laws = clearance.laws
    named = [(letter_of(law.law, name), value) for law in laws for name, value in law.numbers.items()]
    pair = clearance.pair
    named += [(name, getattr(pair, name)) for name in ("R_i", "R_j", "c", "L", "E_i", "nu_i", "E_j", "nu_j")]
    named += [(letter_of(law.law, name), value) for law in laws for name, value in law.derived.items()]
    named += [("transition", clearance.transition)]
    info = model.symbols.info
    taken = {*(name for name, _ in named), *(name for law in laws for name in (*law.law.variables, *law.steps))}
    for name, symbol in _of_file(model, laws):
        named.append((f"{name}_of_file" if name in taken else name, symbol))
    fields: dict[str, str] = {}
    for name, symbol in named:
        if symbol in info and name not in fields.values():
            fields.setdefault(info[symbol].home, name)
    for symbol, value in model.slots.derived.items():  # reciprocals
        if value.is_Pow and value.exp == -1 and value.base in info and info[value.base].home in fields:
            fields.setdefault(info[symbol].home, f"inverse_{fields[info[value.base].home]}")
    return fields


def _of_file(model: Model, laws: Iterable[LawEquations]) -> Iterator[tuple[str, sp.Symbol]]:
    """Parameters that stand in a law's own expression, by their names in the file's order."""
    varying = [law.numbers[own.name] for law in laws for own in law.law.expressions]
    used = set().union(*(value.free_symbols for value in varying))
    for entry in model.slots.entries.values():
        if entry.symbol in used:
            yield model.slots.field(entry.symbol), entry.symbol


def _called(kernel: Kernel, numbers: Mapping[str, str]) -> tuple[dict[str, str], list[str]]:
    """What symbols and fields are called in the shared function; the fields in the order of its arguments."""
    fields = {line.defines: text for line in _lines(kernel) if (text := _number(line))}
    for line in _lines(kernel):
        for expression in line.expressions:
            fields |= {s.name: s.name for s in expression.free_symbols if s.name.startswith(NUMBERS)}
    known = {field: numbers.get(field, field.removeprefix(NUMBERS)) for field in fields.values()}
    order = [*(field for field in numbers if field in known), *(field for field in known if field not in numbers)]
    return {symbol: known[field] for symbol, field in fields.items()} | known, order


def _lines(kernel: Kernel) -> Iterator[Line]:
    return (line for section in kernel.sections for line in section.statements)


def _number(line: Line) -> str:
    """The field of Parameters that a local is; "" where it is none."""
    place = line.value if isinstance(line, Statement) and isinstance(line.value, Place) else None
    return place.text if place and place.text.startswith(NUMBERS) else ""


def _without_numbers(kernel: Kernel) -> tuple[Section, ...]:
    left = (Section(s.title, tuple(x for x in s.statements if not _number(x))) for s in kernel.sections)
    return tuple(section for section in left if section.statements)


def _arguments(kernel: Kernel, numbers: list[str], corners: bool) -> tuple[Argument, ...]:
    """Numbers in the place of all Parameters; sides only where there are corners."""
    found: list[Argument] = []
    for argument in kernel.arguments:
        if argument == PARAMETERS:
            found += [Argument("double", name) for name in numbers]
        elif argument not in SIDES or corners:
            found.append(argument)
        if argument == SIDES[-1] and corners:
            found.append(CORNER)
    return tuple(found)


def _corners(kernel: Kernel) -> set[int]:
    return {int(part.args[0]) for line in _lines(kernel) for x in line.expressions for part in x.atoms(SideOf)}


def _contents(kernel: Kernel) -> Iterator[object]:
    """What tells two functions apart: their lines, in the names of their text."""
    first = kernel.first_corner or 0

    def named(value: sp.Basic) -> sp.Basic:
        symbols = {s: sp.Symbol(kernel.names.get(s.name, s.name), real=True) for s in value.free_symbols}
        sides = {part: SideOf(part.args[0] - first, part.args[1]) for part in value.atoms(SideOf)}
        return value.xreplace(sides).xreplace(symbols)

    for line in _lines(kernel):
        value = line.value if isinstance(line, Statement) else None
        what = line.target if isinstance(line, Statement) else type(line).__name__
        how = value.test.relation if isinstance(value, Chosen) else value.text if isinstance(value, Place) else ""
        yield kernel.names.get(what, what), how, tuple(map(named, line.expressions))
