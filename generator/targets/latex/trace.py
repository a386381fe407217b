"""Traces rows, entries, terms, joints, bodies and laws to the lines of C and YAML that belong to them, by tokens.

Selecting anything on a page highlights whatever shares a token with it (light.js). The lines of C that compute a row
are determined from the functions themselves (generator/ir/dependence.py), not from their text.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import partial

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.dependence import NO_MARKS, Marks, free_names, slices
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import readable
from gudgeon.generator.ir.signatures import RHS
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.driven_chains import STEP
from gudgeon.generator.kernels.program import Program, make_program
from gudgeon.generator.mechanism import quantities
from gudgeon.generator.symbols.storage import PARAMETERS, Key, Place
from gudgeon.generator.symbols.symbols import made_name
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.emit import describe_program, emit, file_names, render
from gudgeon.generator.targets.c.lines import Stored, find_function, find_stores_in_text, locate_text
from gudgeon.generator.targets.c.play import pin_functions
from gudgeon.generator.targets.javascript.module import right_hand_sides, tree_functions
from gudgeon.generator.targets.latex.document import entries_of, entry_token, joint_tokens, row_token, sum_token

# Functions of the closed linkage by the letter of what they give: `constraints` gives phi[r].
GIVES = {"constraints": "phi", "jacobian": "phi_q", "velocity_rhs": "nu", "acceleration_rhs": "gamma"}
Tokens = Mapping[int, Marks]  # by line


@dataclass(frozen=True)
class Functions:
    """Contain a scene's functions, derived anew with the names of the emitted C; `files` are its file names."""

    model: Model
    program: Program
    source: KernelSource
    files: Collection[str]


@dataclass(frozen=True)
class Trace(Functions):
    """Contain `lines`, tokens by file and line of C, and `values`, what a line stores: "phi.arm_x", "p.3", "lambda.2".

    `numbers`: tokens by address of everything that depends on a number of the file.
    """

    lines: Mapping[str, Tokens]
    values: Mapping[str, Mapping[int, str]]
    numbers: Mapping[str, Marks]


def functions_of(model: Model) -> Functions:
    """Return the scene's functions without their C."""
    program = make_program(model)
    return Functions(program.model, program, describe_program(program, {}), file_names(program))


def trace(model: Model, source: KernelSource | None = None) -> Trace:
    """Return the scene's functions, their C, and the tokens of its lines in the document of `model`.

    source: the emitted C of the scene, if it is known; it is then not printed again.
    """
    program = make_program(model)
    if source is None or source.formulation != program.formulation:
        source = emit(program)
    found = _Finder(program, source)
    found.all()
    lines = {file: {k: frozenset(v) for k, v in sorted(own.items())} for file, own in found.lines.items()}
    return Trace(program.model, program, source, source.files, lines, found.values, found.by_address())


class _Finder:
    """Collect the tokens and values of the lines of a scene's functions."""

    def __init__(self, program: Program, source: KernelSource) -> None:
        self.program, self.model, self.files = program, program.model, source.files
        self.lines: defaultdict[str, defaultdict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
        self.values: defaultdict[str, dict[int, str]] = defaultdict(dict)
        self.numbers: defaultdict[Key, set[str]] = defaultdict(set)
        self.number_of = {row.name: k for k, row in enumerate(self.model.rows, 1)}
        self.every = self.model.all_rows
        self.computed = right_hand_sides(program.dynamics, self.model)
        self.in_tree = tree_functions(program, set())
        self.laws = {kernel.name for kernel in program.laws}
        self.multipliers = {made_name(f"lambda_{row.name}"): k for k, row in enumerate(self.model.rows, 1)}
        members = map(self.model.slots.field, self.model.slots.members())
        self.place_in_p = {f"{PARAMETERS}.{member}": k for k, member in enumerate(members, 1)}
        tree = program.tree
        in_chains = tree.chains.chain.rows if tree and tree.chains else ()
        self.in_chains = {made_name(f"phi_{row.name}"): row.name for row in in_chains}
        self.shown = {name for row in self.model.rows for name in free_names(row.phi)}

    def all(self) -> None:
        """Visit every function that concerns rows, bodies or laws; `prepare` comes last."""
        program = self.program
        in_tree = program.tree.every if program.tree else ()
        for kernel in (*program.closed, program.dynamics, *in_tree):
            self._function(kernel)
        for pin in program.pins:
            contact = self.model.scene.play[pin.clearance.joint.name].contact.name
            lit = frozenset(joint_tokens(pin.clearance))
            for call in pin.laws.values():
                own = frozenset({f"law-{contact}", *lit})
                self._whole(functions.kernel(call.kernel), own)
                self._note(call.kernel, {})
                for number in call.numbers:
                    self.numbers[number] |= own
            for part in pin_functions(pin, render, self.model.law_states):
                self._whole(part.text, lit)
                file, stored = find_stores_in_text(part.text, part.stores, self.files)
                for one in stored:
                    self._keep(file, one, f"law.{part.name}.{{}}".format)
        self._prepare()

    def _function(self, kernel: Kernel) -> None:
        """Collect the tokens of one function's lines."""
        marked = slices(readable(kernel), lambda line: self._marks(kernel.name, line))
        for number, marks in marked.numbers.items():
            self.numbers[number] |= marks
        self._note(kernel, marked.stored)

    def _note(self, kernel: Kernel, stored: Mapping[Key, Marks]) -> None:
        """Note tokens and values of the stores of a kernel."""
        for found in find_function(kernel, self.files):
            for one in found.lines:
                own = stored.get(one.target, NO_MARKS) | self._result(kernel.name, one.target)
                for number in one.lines:
                    self.lines[found.file][number] |= own
                self._keep(found.file, one, partial(self._called, kernel.name, found.own.names))

    def _keep(self, file: str, one: Stored, value: Callable[[Key], str]) -> None:
        """Note the value that a line stores; for a branch, on the line that stores it."""
        where, side = one.where[:1], value(one.where[1:]) if one.where[1:] else ""
        if (called := value(one.target)) and (side or where != "<"):
            self.values[file][one.lines[-1]] = f"{called}{where}{side.rpartition('.')[2]}" if side else called

    def _called(self, function: str, names: Mapping[Key, Key], key: Key) -> str:
        """Return the value's name of a local in a part of a function."""
        return self._value(function, names.get(key, key))

    def _value(self, function: str, key: Key) -> str:
        """Return the page's name of the value that a line stores; "" if it has none."""
        called = str(key)
        if function in GIVES:
            return f"{GIVES[function]}.{called}"
        if function == "dynamics":
            return self._of_rows(key)
        if function in self.in_tree:
            return f"tree.{function}.{called}"
        if function in self.laws:
            return f"law.{function}.{called}"
        if function == "prepare" and called in self.place_in_p:
            return f"p.{self.place_in_p[called]}"
        return ""

    def _of_rows(self, key: Key) -> str:
        """Return the values in `dynamics`: what right-hand sides depend on, Φ and Φ̇ of a row, multipliers."""
        if key in self.computed:
            return f"rhs.{key}"
        array, index = _element(key)
        row = self.model.rows[index].name if 0 <= index < len(self.model.rows) else ""
        name = made_name(f"{array}_{row}")
        if row and array == "lambda":
            return f"lambda.{index + 1}"
        if isinstance(key, str) and key in self.multipliers:
            return f"lambda.{self.multipliers[key]}"
        return f"rhs.{name}" if row and name in self.computed else ""

    def _marks(self, function: str, line: Statement | Branch) -> Marks:
        """Return the tokens of what a line stores: rows for Φ, Φ_q, ν, γ, and named terms."""
        target, (array, index) = line.target, _element(line.target)
        if function == "mass_matrix" and index >= 0:
            return frozenset({f"body-{self.model.bodies[index // 3].name}"})
        if function in GIVES:
            own = self._terms(target) if function == "constraints" else NO_MARKS
            if index < 0:
                return own
            if function == "jacobian":
                row, column = divmod(index, len(self.model.q))
                number = self.number_of.get(self.every[row].name)
                return own | ({entry_token(number, column + 1)} if number else NO_MARKS)
            return own | self._row(self.every[index].name)
        if function in ("dynamics", "closures", "closure_rates"):
            return self._of_dynamics(function, line.defines, array, index)
        if function == STEP:
            return self._row(self.in_chains.get(line.defines, ""))
        return NO_MARKS

    def _of_dynamics(self, function: str, local: str, array: str, index: int) -> Marks:
        """Return the tokens of a store in the equations of motion."""
        rows = self.model.rows if function == "dynamics" else self.program.integrated.system.rows
        if index >= 0 and array in ("phi", "phi_dot", "out"):
            return self._row(rows[index].name)
        name = next((row.name for row in rows if local == made_name(f"rhs_{row.name}")), "")
        return self._row(name)

    def _row(self, name: str) -> Marks:
        """Return the token of a row."""
        return frozenset({row_token(self.number_of[name])}) if name in self.number_of else NO_MARKS

    def _terms(self, target: Key) -> Marks:
        """Return the token of a term that the document shows by name."""
        return frozenset({f"name-{target}"}) if target in self.shown else NO_MARKS

    def _result(self, function: str, target: Key) -> Marks:
        """Return the tokens of a line alone: of the sum of a row of Φ, or of a multiplier."""
        array, index = _element(target)
        if function == "constraints" and index >= 0:
            number = self.number_of.get(self.every[index].name)
            return frozenset({sum_token(number)} if number else ())
        if function == "dynamics" and array == "lambda" and 0 <= index < len(self.model.rows):
            return self._row(self.model.rows[index].name)
        return NO_MARKS

    def _whole(self, text: str, own: Marks) -> None:
        """Give tokens to all lines of a text that was printed whole."""
        file, lines = locate_text(text, self.files)
        for number in lines:
            self.lines[file][number] |= own

    def _prepare(self) -> None:
        """Collect the tokens of the lines of `prepare` from those of the parameters that they compute."""
        kernel = self.program.prepare
        own = {s.name: self.model.slots.place(s) for s in self.model.slots.members()}
        slots = {entry.symbol.name for entry in self.model.slots.entries.values()}
        fields = {
            name: self.numbers[home] | ({f"number-{name}"} if name in slots else set()) for name, home in own.items()
        }
        marked = slices(readable(kernel), lambda line: frozenset(fields.get(_field(line, own), ())))
        for target, marks in marked.stored.items():
            self.numbers[target] |= marks
        self._note(kernel, marked.stored)

    def by_address(self) -> dict[str, Marks]:
        """Return the tokens of each number of the file."""
        slots = self.model.slots
        return {own.address: frozenset(self.numbers[slots.place(own.symbol)]) for own in slots.entries.values()}


def _element(target: Key) -> tuple[str, int]:
    """Return (array, index) of a store to an array of a function or of its `rhs`; index −1 for other stores."""
    match target:
        case Place(array, (int() as index,)) | Place(RHS.name, (str() as array, int() as index)):
            return array, index
    return str(target), -1


def _field(line: Statement | Branch, homes: Mapping[str, Place]) -> str:
    """Return the symbol of the parameter that a line of `prepare` stores."""
    return next((name for name, home in homes.items() if line.target in (name, home)), "")


def yaml_tokens(model: Model, found: Trace) -> dict[int, Marks]:
    """Return the tokens of each line of the mechanism's file: of its entries, and of what depends on its numbers."""
    tokens: defaultdict[int, set[str]] = defaultdict(set)
    mechanism = model.scene.mechanism
    joints = {name: joint.where.line for name, joint in mechanism.joints.items()}
    drives = {name: drive.where.line for name, drive in mechanism.drives.items()}
    bodies = {name: body.where.line for name, body in mechanism.bodies.items()}
    where = {"joint": joints, "drive": drives, "body": bodies}
    for kind, lines in where.items():
        for name, line in lines.items():
            tokens[line].add(f"{kind}-{name}")
    for number, row in enumerate(model.rows, 1):
        tokens[where[row.kind][row.owner]] |= {row_token(number), *entries_of(model, number, row)}
    for play in model.scene.play.values():
        for quantity in quantities(play.contact):
            tokens[quantity.where.line].add(f"law-{play.contact.name}")
    for quantity in (*quantities(mechanism), *model.scene.parameters.values()):
        if quantity.address in found.numbers:
            tokens[quantity.where.line] |= found.numbers[quantity.address]
    return {line: frozenset({f"yaml-{line}", *own}) for line, own in tokens.items()}
