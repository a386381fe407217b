"""Structure of the parts of a long function: all that determines their code except names and operands.

Parts of equal structure, such as those of equal bars, have the same text but for the names of locals, the indices and
parameters that they read, and the statuses that they return. A target may print one of them for all.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.ir.expression_structure import find_expression_structure
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Guard, Instruction, Return, Statement
from gudgeon.generator.ir.values import ContinuedSum, Test
from gudgeon.generator.symbols.storage import Key, StorageLocation

_FIRST_PLACEHOLDER, _PLACEHOLDERS_OF_OPERAND = 10**9, 100  # above all indices; above all lengths of paths


@dataclass(frozen=True)
class _ReturnedStatus:
    """The status that a test of a pivot returns."""

    number: int


Operand = Key | _ReturnedStatus


class _NotComparableError(Exception):
    """Raised for a line whose text may depend on more than its structure."""


@dataclass(frozen=True)
class PartStructure:
    """The structure of a part, and its locals, storage locations and statuses, each once, by number in `key`."""

    key: Hashable
    operands: tuple[Operand, ...]

    def list_placeholders(self) -> list[int]:
        """Return the placeholders of all operands; parts of equal `key` have the same ones."""
        sizes = (len(operand.path) if isinstance(operand, StorageLocation) else 1 for operand in self.operands)
        return [_compute_placeholder(k, step) for k, size in enumerate(sizes) for step in range(size)]

    def get_replaced_value(self, placeholder: int) -> int | str:
        """Return what `insert_placeholders` replaces by a placeholder: an index, a status, or a parameter's name."""
        k, step = divmod(placeholder - _FIRST_PLACEHOLDER, _PLACEHOLDERS_OF_OPERAND)
        operand = self.operands[k]
        if isinstance(operand, _ReturnedStatus):
            return operand.number
        assert isinstance(operand, StorageLocation)
        return operand.path[step]

    def insert_placeholders(self, readable: Readable) -> Readable:
        """Return the readable form of the part with a placeholder for each index, parameter and status.

        A placeholder is a number that no index has. Parts of equal structure then have equal texts.
        """
        number_by_operand = {operand: k for k, operand in enumerate(self.operands)}
        location_with_placeholders: dict[Key, StorageLocation] = {
            place: _insert_index_placeholders(place, k)
            for place, k in number_by_operand.items()
            if isinstance(place, StorageLocation)
        }
        names = {
            x: location_with_placeholders.get(y, y) if isinstance(y, StorageLocation) else y
            for x, y in readable.names.items()
        }

        def insert_status_placeholder(line: Instruction) -> Instruction:
            """Return a line with a placeholder for its status, if it is a test of a pivot; others unchanged."""
            if not isinstance(line, Guard):
                return line
            k = number_by_operand[_ReturnedStatus(line.number)]
            return replace(line, number=_compute_placeholder(k))

        sections = tuple(
            replace(section, statements=tuple(map(insert_status_placeholder, section.statements)))
            for section in readable.sections
        )
        return replace(readable, sections=sections, names={**location_with_placeholders, **names})


def _compute_placeholder(k: int, step: int = 0) -> int:
    """Return the placeholder of a step in the path of operand k, a number that no index has."""
    return _FIRST_PLACEHOLDER + _PLACEHOLDERS_OF_OPERAND * k + step


def format_parameter_placeholder(placeholder: int) -> str:
    """Return the name that `insert_placeholders` gives to a parameter with this placeholder."""
    return f"mark_{placeholder}"


def find_part_structure(part: Kernel) -> PartStructure | None:
    """Return the structure of a part of a long function.

    Return None if the text of a line may depend on more: on the order of printed arguments, on a table, on branches.
    """
    lines = [line for section in part.sections for line in section.statements]
    copies = {
        line.declared_local: line.value
        for line in lines
        if isinstance(line, Statement) and line.declared_local and isinstance(line.value, StorageLocation)
    }
    finder = _StructureFinder(part, copies, {line.declared_local for line in lines})
    try:
        keys = tuple(finder.describe_line(line) for line in lines)
    except _NotComparableError:
        return None
    key = (part.status, part.arguments, part.first_switch, keys)
    return PartStructure(key, tuple(finder.number_by_operand))


def _is_parameter_member(place: StorageLocation) -> bool:
    """Return whether a place is a parameter of the run that is not an array."""
    return place.is_parameter and len(place.path) == 1


def _insert_index_placeholders(place: StorageLocation, k: int) -> StorageLocation:
    """Return operand k, a storage location, with placeholders for its indices, or for its parameter."""
    if _is_parameter_member(place):
        return replace(place, path=(format_parameter_placeholder(_compute_placeholder(k)),))
    steps = (_compute_placeholder(k, j) if isinstance(step, int) else step for j, step in enumerate(place.path))
    return replace(place, path=tuple(steps))


class _StructureFinder:
    """Describe the lines of a part; `number_by_operand` numbers its locals, places and statuses in their order."""

    def __init__(self, part: Kernel, copies: Mapping[str, StorageLocation], declared_locals: set[str]) -> None:
        self._names, self._copies, self._declared_locals = part.names, copies, declared_locals
        self.number_by_operand: dict[Operand, int] = {}

    def describe_line(self, line: Instruction) -> Hashable:
        """Return the structure of a line; that of a copy is part of the lines that read it."""
        match line:
            case Statement() if line.declared_local in self._copies:
                return None
            case Statement():
                return Statement, self._describe_key(line.target), self._describe_value(line.value)
            case Guard(test=Test(), jumps=False):
                tests = [self._describe_test(test) for test in (line.test, line.condition) if isinstance(test, Test)]
                return Guard, self._number(_ReturnedStatus(line.number)), *tests
            case Return():
                return line
        raise _NotComparableError

    def _number(self, operand: Operand) -> int:
        """Return the number of an operand, a new one at its first use."""
        return self.number_by_operand.setdefault(operand, len(self.number_by_operand))

    def _describe_key(self, key: Key) -> Hashable:
        """Return the structure of a local, argument or storage location that a line reads or writes.

        A local that copies a storage location has that of the location too.
        """
        if isinstance(key, StorageLocation):
            return self._describe_place(key)
        if key in self._copies:
            return self._number(key), self._describe_place(self._copies[key])
        return self._number(key) if key in self._declared_locals else self._names.get(key, key)

    def _describe_place(self, place: StorageLocation) -> Hashable:
        """Return the structure of a storage location: its path without indices, and without a parameter's name."""
        if not place.path:
            return type(place), self._describe_key(place.base)
        steps = () if _is_parameter_member(place) else tuple(x if isinstance(x, str) else None for x in place.path)
        return self._number(place), type(place), place.base, steps

    def _describe_value(self, value: object) -> Hashable:
        """Return the structure of a value. Raise _NotComparableError for a class that is not described."""
        match value:
            case StorageLocation():
                return self._describe_place(value)
            case ContinuedSum():
                return ContinuedSum, self._describe_value(value.first), self._describe_value(value.more)
            case sp.Basic():
                found = find_expression_structure(value)
                if found is None:
                    raise _NotComparableError
                return found[0], *map(self._describe_key, found[1])
        raise _NotComparableError

    def _describe_test(self, test: Test) -> Hashable:
        """Return the structure of a comparison; a threshold is compared with its name and storage location."""
        bound = [
            self._describe_value(x)
            if isinstance(x, sp.Basic)
            else (x, getattr(x, "name", ""), getattr(x, "place", None))
            for x in test.bound
        ]
        return test.relation, test.compares_magnitude, self._describe_value(test.value), *bound
