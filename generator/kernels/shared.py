"""Functions that joints share: equal functions become one C function (procedural abstraction), called for each joint.

The parameters of the joint are arguments, named as in the law's file (`K`, `mu`). Switches are counted from the
joint's first. A shared function keeps the order of terms of the first joint.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance, LawEquations, make_law_identifier
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import BRANCHES, PARAMETERS, Argument, Number
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.ir.values import Conditional
from gudgeon.generator.symbols.storage import Key, StorageLocation, StoredSymbol, find_value_key
from gudgeon.generator.symbols.switches import BranchOf

FIRST_SWITCH = Argument("corner", Number.INTEGER)
NO_MEANINGS: Mapping[str, str] = {}
_BRANCH_PREFIX = "side_"


@dataclass(frozen=True)
class SharedFunctionCall:
    """A joint's call of a shared function: the function, the parameters passed to it, its first switch."""

    kernel: Kernel
    parameters: tuple[StorageLocation, ...]
    first_switch: int | None  # None: it has no switches


class SharedFunctions:
    """The shared functions of a scene, each once, in the order in which they were first called."""

    def __init__(self) -> None:
        """Begin without functions."""
        self.kernels: list[Kernel] = []
        self._kernel_by_key: dict[object, Kernel] = {}

    def add_call(
        self,
        kernel: Kernel,
        parameter_names: Mapping[StorageLocation, str],
        joint: str,
        meanings: Mapping[str, str] = NO_MEANINGS,
    ) -> SharedFunctionCall:
        """Return the call that replaces a joint's own function, and store the shared function if no equal one exists.

        `parameter_names`: names of the joint's parameters in the function, by storage location (`p.pin_radius` ->
        `R_i`). `joint`: its label, appended to the name if an unequal function has that name. `meanings`, by name of
        the parameter, are added to the function's comment.
        """
        text_names, parameters = _name_parameters(kernel, parameter_names)
        names = [text_names[place] for place in parameters]
        first_switch = min(_find_switch_indices(kernel), default=None)
        if first_switch is not None:
            text_names |= {
                f"{_BRANCH_PREFIX}{k}": f"{_BRANCH_PREFIX}{k - first_switch + 1}" for k in _find_switch_indices(kernel)
            }
        meaning_texts = [f"{name}: {meanings[name]}" for name in names if name in meanings]
        doc = (*kernel.doc, *textwrap.wrap("; ".join(meaning_texts) + ".", 110)) if meaning_texts else kernel.doc
        shared_kernel = replace(
            kernel,
            doc=doc,
            arguments=_make_arguments(kernel, names, first_switch is not None),
            sections=_remove_parameter_copies(kernel),
            names={**kernel.names, **text_names},
            first_switch=first_switch,
        )
        key = (kernel.name, shared_kernel.arguments, *_list_distinguishing_parts(shared_kernel))
        if key not in self._kernel_by_key:
            is_name_used = any(kernel_.name == kernel.name for kernel_ in self.kernels)
            self._kernel_by_key[key] = (
                replace(shared_kernel, name=f"{kernel.name}_of_{joint}_") if is_name_used else shared_kernel
            )
            self.kernels.append(self._kernel_by_key[key])
        return SharedFunctionCall(self._kernel_by_key[key], tuple(parameters), first_switch)


def name_joint_parameters(model: Model, clearance: Clearance) -> dict[StorageLocation, str]:
    """Return the names of a joint's parameters in its equations, by storage location, such as `p.pin_radius`: "R_i".

    First come the parameters of its laws, then dimensions, derived parameters, the transition, parameters of user
    expressions and reciprocals. A parameter or name that occurs twice counts once. A parameter of the file with the
    name of another one gets the ending "_file_parameters".
    """
    laws = clearance.laws
    named_symbols = [
        (make_law_identifier(law.law, name), value) for law in laws for name, value in law.parameters.items()
    ]
    dimensions = clearance.pair
    named_symbols += [
        (name, getattr(dimensions, name)) for name in ("R_i", "R_j", "c", "L", "E_i", "nu_i", "E_j", "nu_j")
    ]
    named_symbols += [
        (make_law_identifier(law.law, name), value) for law in laws for name, value in law.derived.items()
    ]
    named_symbols += [("transition", clearance.transition)]
    info = model.symbols.info
    used_names = {
        *(name for name, _ in named_symbols),
        *(name for law in laws for name in (*law.law.variables, *law.equations_by_name)),
    }
    for name, symbol in _list_file_parameters(model, laws):
        named_symbols.append((f"{name}_file_parameters" if name in used_names else name, symbol))
    place_of_symbol = {
        symbol: symbol_info.storage_location for symbol, symbol_info in info.items() if symbol_info.storage_location
    }
    name_of_place: dict[StorageLocation, str] = {}
    for name, symbol in named_symbols:
        if symbol in place_of_symbol and name not in name_of_place.values():
            name_of_place.setdefault(place_of_symbol[symbol], name)
    for symbol, value in model.parameter_table.derived.items():  # reciprocals
        if value.is_Pow and value.exp == -1 and place_of_symbol.get(value.base) in name_of_place:
            name_of_place.setdefault(place_of_symbol[symbol], f"inverse_{name_of_place[place_of_symbol[value.base]]}")
    return name_of_place


def _list_file_parameters(model: Model, laws: Iterable[LawEquations]) -> Iterator[tuple[str, sp.Symbol]]:
    """Yield (name, symbol) of each parameter that force expressions of the laws read, in the file's order."""
    user_expressions = [law.parameters[expression.name] for law in laws for expression in law.law.expressions]
    used_symbols = set().union(*(value.free_symbols for value in user_expressions))
    for entry in model.parameter_table.entries.values():
        if entry.symbol in used_symbols:
            yield model.parameter_table.find_member_name(entry.symbol), entry.symbol


def _name_parameters(
    kernel: Kernel, parameter_names: Mapping[StorageLocation, str]
) -> tuple[dict[Key, str], list[StorageLocation]]:
    """Return the names of the parameters that a kernel reads, and their storage locations in argument order.

    Example: ({StorageLocation("p")["A_K"]: "K", "A_K_copy": "K"}, [StorageLocation("p")["A_K"]]). Names are by storage
    location and by each local that is a copy of it. `parameter_names` has names by location, in argument order; other
    parameters follow and keep the name of their field.
    """
    place_of_key: dict[Key, StorageLocation] = {
        line.declared_local: place for line in _iterate_lines(kernel) if (place := _find_copied_parameter(line))
    }
    for line in _iterate_lines(kernel):
        for expression in line.expressions:
            read_places = (s.storage_location for s in expression.free_symbols if isinstance(s, StoredSymbol))
            place_of_key |= {place: place for place in read_places if place.is_parameter}
    name_of_place = {field: parameter_names.get(field, field.member) for field in place_of_key.values()}
    order = [
        *(field for field in parameter_names if field in name_of_place),
        *(field for field in name_of_place if field not in parameter_names),
    ]
    return {symbol: name_of_place[field] for symbol, field in place_of_key.items()} | name_of_place, order


def _iterate_lines(kernel: Kernel) -> Iterator[Instruction]:
    """Yield the lines of all sections of a function."""
    return (line for section in kernel.sections for line in section.statements)


def _find_copied_parameter(line: Instruction) -> StorageLocation | None:
    """Return the storage location of the parameter that a statement copies to a local; None for any other line."""
    place = line.value if isinstance(line, Statement) and isinstance(line.value, StorageLocation) else None
    return place if place and place.is_parameter else None


def _remove_parameter_copies(kernel: Kernel) -> tuple[Section, ...]:
    """Return the sections of a function without the statements that copy parameters to locals.

    Empty sections are left out.
    """
    sections = (
        Section(section.title, tuple(line for line in section.statements if not _find_copied_parameter(line)))
        for section in kernel.sections
    )
    return tuple(section for section in sections if section.statements)


def _make_arguments(kernel: Kernel, parameter_names: list[str], has_switches: bool) -> tuple[Argument, ...]:
    """Return the arguments of a shared function, with one argument for each named parameter instead of the struct.

    The arguments for branches stay only if the function has switches; the number of the first switch then follows them.
    """
    result: list[Argument] = []
    for argument in kernel.arguments:
        if argument == PARAMETERS:
            result += [Argument(name) for name in parameter_names]
        elif argument not in BRANCHES or has_switches:
            result.append(argument)
        if argument == BRANCHES[-1] and has_switches:
            result.append(FIRST_SWITCH)
    return tuple(result)


def _find_switch_indices(kernel: Kernel) -> set[int]:
    """Return the indices of the switches whose branch a function reads; empty if it reads none."""
    return {
        int(branch.args[0])
        for line in _iterate_lines(kernel)
        for expression in line.expressions
        for branch in expression.atoms(BranchOf)
    }


def _list_distinguishing_parts(kernel: Kernel) -> Iterator[object]:
    """Yield the parts by which two shared functions are compared; names and switches are those of the printed text.

    For each line these are its target, its kind (the relation of a condition, or a storage location) and its
    expressions.
    """
    first_switch = kernel.first_switch or 0

    def rename_symbols(expression: sp.Basic) -> sp.Basic:
        """Return an expression as in the printed text: symbols named after locals, switches counted from the first.

        That is the kernel's first switch.
        """
        known_names = {
            s: kernel.names[key] for s in expression.free_symbols if (key := find_value_key(s)) in kernel.names
        }
        symbols = {s: sp.Symbol(str(name), real=True) for s, name in known_names.items()}
        branches = {part: BranchOf(part.args[0] - first_switch, part.args[1]) for part in expression.atoms(BranchOf)}
        return expression.xreplace(branches).xreplace(symbols)

    for line in _iterate_lines(kernel):
        value = line.value if isinstance(line, Statement) else None
        target: Key = line.target if isinstance(line, Statement) else type(line).__name__
        kind = (
            value.test.relation
            if isinstance(value, Conditional)
            else value
            if isinstance(value, StorageLocation)
            else ""
        )
        yield kernel.names.get(target, target), kind, tuple(map(rename_symbols, line.expressions))
