"""Functions that joints share: equal equations become one C function, called with the parameters of each joint.

Parameters are named as in the law's file (`K`, `mu`), switches are counted from the joint's first. A shared function
keeps the order of terms of the first joint.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations, letter_of
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import BRANCHES, PARAMETERS, Argument, Number
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import Conditional
from gudgeon.generator.symbols.storage import Key, Place, PlaceSymbol, key_of
from gudgeon.generator.symbols.switches import BranchOf

CORNER = Argument("corner", Number.INTEGER)
NOTHING: Mapping[str, str] = {}
_SIDE = "side_"


@dataclass(frozen=True)
class SharedFunctionCall:
    """A joint's call of a shared function: the function, the parameters passed to it, its first switch."""

    kernel: Kernel
    numbers: tuple[Place, ...]
    corner: int | None  # None: it has no switches


class SharedFunctions:
    """The shared functions of a scene, each once, in the order in which they were first called."""

    def __init__(self) -> None:
        """Begin without functions."""
        self.kernels: list[Kernel] = []
        self._known: dict[object, Kernel] = {}

    def call(
        self, kernel: Kernel, numbers: Mapping[Place, str], joint: str, meanings: Mapping[str, str] = NOTHING
    ) -> SharedFunctionCall:
        """Return the call that replaces a joint's own function, and keep the function if it is new.

        `numbers`: names in the function of the parameters that a joint has (`p.pin_radius` -> `R_i`).
        `meanings` by these names are added to the function's comment.
        """
        called, given = _name_parameters(kernel, numbers)
        names = [called[place] for place in given]
        first = min(_corners(kernel), default=None)
        if first is not None:
            called |= {f"{_SIDE}{k}": f"{_SIDE}{k - first + 1}" for k in _corners(kernel)}
        meant = [f"{name}: {meanings[name]}" for name in names if name in meanings]
        doc = (*kernel.doc, *textwrap.wrap("; ".join(meant) + ".", 110)) if meant else kernel.doc
        shared = replace(
            kernel,
            doc=doc,
            arguments=_arguments(kernel, names, first is not None),
            sections=_without_parameter_copies(kernel),
            names={**kernel.names, **called},
            first_corner=first,
        )
        key = (kernel.name, shared.arguments, *_distinguishing_parts(shared))
        if key not in self._known:
            used = any(other.name == kernel.name for other in self.kernels)
            self._known[key] = replace(shared, name=f"{kernel.name}_of_{joint}_") if used else shared
            self.kernels.append(self._known[key])
        return SharedFunctionCall(self._known[key], tuple(given), first)


def joint_numbers(model: Model, clearance: Clearance) -> dict[Place, str]:
    """Return the names of parameters in the equations of a joint with play, those of its laws first."""
    laws = clearance.laws
    named = [(letter_of(law.law, name), value) for law in laws for name, value in law.numbers.items()]
    pair = clearance.pair
    named += [(name, getattr(pair, name)) for name in ("R_i", "R_j", "c", "L", "E_i", "nu_i", "E_j", "nu_j")]
    named += [(letter_of(law.law, name), value) for law in laws for name, value in law.derived.items()]
    named += [("transition", clearance.transition)]
    info = model.symbols.info
    used = {*(name for name, _ in named), *(name for law in laws for name in (*law.law.variables, *law.steps))}
    for name, symbol in _file_parameters(model, laws):
        named.append((f"{name}_file_parameters" if name in used else name, symbol))
    homes = {symbol: own.home for symbol, own in info.items() if own.home}
    fields: dict[Place, str] = {}
    for name, symbol in named:
        if symbol in homes and name not in fields.values():
            fields.setdefault(homes[symbol], name)
    for symbol, value in model.slots.derived.items():  # reciprocals
        if value.is_Pow and value.exp == -1 and homes.get(value.base) in fields:
            fields.setdefault(homes[symbol], f"inverse_{fields[homes[value.base]]}")
    return fields


def _file_parameters(model: Model, laws: Iterable[LawEquations]) -> Iterator[tuple[str, sp.Symbol]]:
    """Yield the parameters in a law's user expression with their names, in the file's order."""
    varying = [law.numbers[own.name] for law in laws for own in law.law.expressions]
    used = set().union(*(value.free_symbols for value in varying))
    for entry in model.slots.entries.values():
        if entry.symbol in used:
            yield model.slots.field(entry.symbol), entry.symbol


def _name_parameters(kernel: Kernel, numbers: Mapping[Place, str]) -> tuple[dict[Key, str], list[Place]]:
    """Return the names of symbols and parameters in the shared function, and its parameters in argument order."""
    fields: dict[Key, Place] = {line.defines: place for line in _lines(kernel) if (place := _parameter_of(line))}
    for line in _lines(kernel):
        for expression in line.expressions:
            read = (s.place for s in expression.free_symbols if isinstance(s, PlaceSymbol))
            fields |= {place: place for place in read if place.is_parameter}
    known = {field: numbers.get(field, field.member) for field in fields.values()}
    order = [*(field for field in numbers if field in known), *(field for field in known if field not in numbers)]
    return {symbol: known[field] for symbol, field in fields.items()} | known, order


def _lines(kernel: Kernel) -> Iterator[Line]:
    """Yield the statements of a function."""
    return (line for section in kernel.sections for line in section.statements)


def _parameter_of(line: Line) -> Place | None:
    """Return the parameter that a local is a copy of; None if it is not one."""
    place = line.value if isinstance(line, Statement) and isinstance(line.value, Place) else None
    return place if place and place.is_parameter else None


def _without_parameter_copies(kernel: Kernel) -> tuple[Section, ...]:
    """Return the sections of a function without the statements that copy parameters to locals."""
    left = (Section(s.title, tuple(x for x in s.statements if not _parameter_of(x))) for s in kernel.sections)
    return tuple(section for section in left if section.statements)


def _arguments(kernel: Kernel, numbers: list[str], corners: bool) -> tuple[Argument, ...]:
    """Return the arguments with named parameters instead of the struct; branches only if the function has switches."""
    found: list[Argument] = []
    for argument in kernel.arguments:
        if argument == PARAMETERS:
            found += [Argument(name) for name in numbers]
        elif argument not in BRANCHES or corners:
            found.append(argument)
        if argument == BRANCHES[-1] and corners:
            found.append(CORNER)
    return tuple(found)


def _corners(kernel: Kernel) -> set[int]:
    """Return the numbers of the switches whose branch a function reads."""
    return {int(part.args[0]) for line in _lines(kernel) for x in line.expressions for part in x.atoms(BranchOf)}


def _distinguishing_parts(kernel: Kernel) -> Iterator[object]:
    """Yield what distinguishes two functions: their statements, in the names of the printed text."""
    first = kernel.first_corner or 0

    def named(value: sp.Basic) -> sp.Basic:
        """Return an expression with its symbols named, and its switches counted, as in the printed text."""
        known = {s: kernel.names[key] for s in value.free_symbols if (key := key_of(s)) in kernel.names}
        symbols = {s: sp.Symbol(str(name), real=True) for s, name in known.items()}
        sides = {part: BranchOf(part.args[0] - first, part.args[1]) for part in value.atoms(BranchOf)}
        return value.xreplace(sides).xreplace(symbols)

    for line in _lines(kernel):
        value = line.value if isinstance(line, Statement) else None
        what: Key = line.target if isinstance(line, Statement) else type(line).__name__
        how = value.test.relation if isinstance(value, Conditional) else value if isinstance(value, Place) else ""
        yield kernel.names.get(what, what), how, tuple(map(named, line.expressions))
