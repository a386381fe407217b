"""Links equations, joints, bodies and laws in a page to their lines of C and YAML, for cross-highlighting.

Selecting an element of a page highlights all elements that share a token with it (highlighting.js). The lines of C that
compute a row are determined by data-flow analysis of the kernels (generator/ir/dependence.py), not from their text.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import partial

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.dependence import compute_backward_slices, find_symbol_names
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import make_readable
from gudgeon.generator.ir.signatures import RHS
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.driven_loops import STEP
from gudgeon.generator.kernels.program import Program, make_program
from gudgeon.generator.mechanism import iterate_quantities
from gudgeon.generator.symbols.storage import PARAMETERS, Key, StorageLocation
from gudgeon.generator.symbols.symbols import make_identifier
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.emit import describe_program, emit_scene, list_file_names, render_template
from gudgeon.generator.targets.c.lines import StoredLines, locate_function, locate_stores, locate_text
from gudgeon.generator.targets.c.play import make_printed_functions
from gudgeon.generator.targets.javascript.module import find_right_hand_side_locals, print_reduced_functions
from gudgeon.generator.targets.latex.document import (
    list_entry_tokens,
    list_joint_tokens,
    make_entry_token,
    make_row_token,
    make_sum_token,
)

# Functions of the closed linkage -> symbol of their result: `constraints` computes phi[r].
RESULT_SYMBOLS = {"constraints": "phi", "jacobian": "phi_q", "velocity_rhs": "nu", "acceleration_rhs": "gamma"}
Tokens = frozenset[str]
NO_TOKENS: Tokens = frozenset()
LineTokens = Mapping[int, Tokens]  # line of a file -> tokens


@dataclass(frozen=True)
class Functions:
    """Contain a scene's kernels (`program`) and the description of its C (`source`); `files` are its file names."""

    model: Model
    program: Program
    source: KernelSource
    files: Collection[str]


@dataclass(frozen=True)
class HighlightIndex(Functions):
    """Contain the highlighting tokens and values of the lines of a scene's C.

    `lines`: tokens by file and line. `values`: name of the value that a line stores, such as "phi.arm_x", "p.3" or
    "lambda.2", by file and line. `tokens_by_address`: tokens of everything that depends on a parameter.
    """

    lines: Mapping[str, LineTokens]
    values: Mapping[str, Mapping[int, str]]
    tokens_by_address: Mapping[str, Tokens]


def make_scene_functions(model: Model) -> Functions:
    """Return the functions of a scene for a document without C: kernels, description, names of the C files.

    The C is not printed.
    """
    program = make_program(model)
    return Functions(program.model, program, describe_program(program, {}), list_file_names(program))


def make_highlight_index(model: Model, source: KernelSource | None = None) -> HighlightIndex:
    """Return the scene's functions, its C, and the highlighting tokens of each line of C, for a page of `model`.

    source: the emitted C of the scene; None, or one of another formulation than the program: the C is emitted anew.
    """
    program = make_program(model)
    if source is None or source.formulation != program.formulation:
        source = emit_scene(program)
    collector = _TokenCollector(program, source)
    collector.collect_tokens()
    lines = {
        file: {k: frozenset(tokens) for k, tokens in sorted(tokens_by_line.items())}
        for file, tokens_by_line in collector.lines.items()
    }
    return HighlightIndex(
        program.model, program, source, source.files, lines, collector.values, collector.get_tokens_by_address()
    )


class _TokenCollector:
    """Collect the highlighting tokens and values of the lines of a scene's C functions.

    lines: tokens by file and line. values: the name of the stored value by file and line. tokens_by_parameter: tokens
    of what depends on a parameter, by its storage place.
    """

    def __init__(self, program: Program, source: KernelSource) -> None:
        self.program, self.model, self.files = program, program.model, source.files
        self.lines: defaultdict[str, defaultdict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
        self.values: defaultdict[str, dict[int, str]] = defaultdict(dict)
        self.tokens_by_parameter: defaultdict[Key, set[str]] = defaultdict(set)
        self.row_numbers = {row.name: k for k, row in enumerate(self.model.rows, 1)}
        self.all_rows = self.model.all_rows
        self.right_hand_side_locals = find_right_hand_side_locals(program.dynamics, self.model)
        self.tree_functions = print_reduced_functions(program, set())
        self.law_names = {kernel.name for kernel in program.laws}
        self.multiplier_locals = {make_identifier(f"lambda_{row.name}"): k for k, row in enumerate(self.model.rows, 1)}
        members = map(self.model.parameter_table.find_member_name, self.model.parameter_table.list_symbols())
        self.parameter_numbers = {f"{PARAMETERS}.{member}": k for k, member in enumerate(members, 1)}
        tree = program.tree
        loop_rows = tree.driven_loop_kernels.loops.rows if tree and tree.driven_loop_kernels else ()
        self.loop_row_by_local = {make_identifier(f"phi_{row.name}"): row.name for row in loop_rows}
        self.term_names = {name for row in self.model.rows for name in find_symbol_names(row.phi)}

    def collect_tokens(self) -> None:
        """Collect tokens and values of all kernels and of the functions of joints with play; called once.

        `prepare` comes last, since its lines get the tokens that the parameters have collected.
        """
        program = self.program
        tree_kernels = program.tree.all_kernels if program.tree else ()
        for kernel in (*program.closed_linkage, program.dynamics, *tree_kernels):
            self._collect_kernel_tokens(kernel)
        for joint in program.joints:
            contact = self.model.scene.play[joint.clearance.joint.name].contact.name
            joint_tokens = frozenset(list_joint_tokens(joint.clearance))
            for call in joint.laws.values():
                law_tokens = frozenset({f"law-{contact}", *joint_tokens})
                self._add_text_tokens(functions.print_kernel(call.kernel), law_tokens)
                self._add_stores(call.kernel, {})
                for parameter in call.parameters:
                    self.tokens_by_parameter[parameter] |= law_tokens
            for part in make_printed_functions(joint, render_template, self.model.law_states):
                self._add_text_tokens(part.text, joint_tokens)
                file, stored_lines = locate_stores(part.text, part.stores, self.files)
                for stored_line in stored_lines:
                    self._add_value_name(file, stored_line, f"law.{part.name}.{{}}".format)
        self._collect_parameter_tokens()

    def _collect_kernel_tokens(self, kernel: Kernel) -> None:
        """Collect the tokens of one kernel's lines, and add them to the parameters on which these lines depend.

        A line gets the tokens of all results that depend on it (data-flow analysis).
        """
        dependence = compute_backward_slices(
            make_readable(kernel), lambda line: self._find_line_tokens(kernel.name, line)
        )
        for parameter, tokens in dependence.by_parameter.items():
            self.tokens_by_parameter[parameter] |= tokens
        self._add_stores(kernel, dependence.by_target)

    def _add_stores(self, kernel: Kernel, tokens_by_target: Mapping[Key, Tokens]) -> None:
        """Add tokens and values of all stores of a kernel to `lines` and `values`.

        tokens_by_target: the tokens of each stored value.
        """
        for function_lines in locate_function(kernel, self.files):
            for stored_line in function_lines.lines:
                tokens = tokens_by_target.get(stored_line.target, NO_TOKENS) | self._get_single_line_tokens(
                    kernel.name, stored_line.target
                )
                for number in stored_line.lines:
                    self.lines[function_lines.file][number] |= tokens
                self._add_value_name(
                    function_lines.file,
                    stored_line,
                    partial(self._name_local, kernel.name, function_lines.readable_part.names),
                )

    def _add_value_name(self, file: str, stored_line: StoredLines, get_value_name: Callable[[Key], str]) -> None:
        """Add the name of the value that a line stores to `values`, on its last line; nothing if the value has no name.

        A store in a branch is added as "NAME<CONDITION" (below zero) or "NAME>CONDITION". If the condition has no name,
        only the store of the latter is added, as "NAME". get_value_name: function from a target to its value's name.
        """
        sign, condition_name = (
            stored_line.condition[:1],
            get_value_name(stored_line.condition[1:]) if stored_line.condition[1:] else "",
        )
        if (target_name := get_value_name(stored_line.target)) and (condition_name or sign != "<"):
            self.values[file][stored_line.lines[-1]] = (
                f"{target_name}{sign}{condition_name.rpartition('.')[2]}" if condition_name else target_name
            )

    def _name_local(self, function_name: str, local_names: Mapping[Key, Key], key: Key) -> str:
        """Return the name of the value (`_name_value`) of a local or array element in a part of a function.

        local_names: the names of locals in the part, which may differ from those of the kernel.
        """
        return self._name_value(function_name, local_names.get(key, key))

    def _name_value(self, function_name: str, key: Key) -> str:
        """Return the name of a value that a function stores, under which a page shows it; "" if it has none.

        Examples: "phi.arm_x" of `constraints`, "tree.expand.x", "law.hertz.K", "p.3" of `prepare`.
        """
        target_name = str(key)
        if function_name in RESULT_SYMBOLS:
            return f"{RESULT_SYMBOLS[function_name]}.{target_name}"
        if function_name == "dynamics":
            return self._name_dynamics_value(key)
        if function_name in self.tree_functions:
            return f"tree.{function_name}.{target_name}"
        if function_name in self.law_names:
            return f"law.{function_name}.{target_name}"
        if function_name == "prepare" and target_name in self.parameter_numbers:
            return f"p.{self.parameter_numbers[target_name]}"
        return ""

    def _name_dynamics_value(self, key: Key) -> str:
        """Return the name of a value that `dynamics` stores, under which a page shows it; "" if it has none.

        key: a local or an array element. Multipliers are "lambda.N" with the number N of the constraint equation from
        1. Right-hand sides are "rhs.NAME" with the name NAME of the local.
        """
        if key in self.right_hand_side_locals:
            return f"rhs.{key}"
        array, index = _split_element(key)
        row = self.model.rows[index].name if 0 <= index < len(self.model.rows) else ""
        name = make_identifier(f"{array}_{row}")
        if row and array == "lambda":
            return f"lambda.{index + 1}"
        if isinstance(key, str) and key in self.multiplier_locals:
            return f"lambda.{self.multiplier_locals[key]}"
        return f"rhs.{name}" if row and name in self.right_hand_side_locals else ""

    def _find_line_tokens(self, function_name: str, line: Statement | Branch) -> Tokens:
        """Return the highlighting tokens of the value that a line of a C function stores, before their propagation.

        A mass gets the token of its body, an entry of Φ, ν or γ that of its row, and an entry of Φ_q its own. Terms of
        Φ get their name's, results of dynamics, closures and driven loops that of their row. Others get none.
        """
        target, (array, index) = line.target, _split_element(line.target)
        if function_name == "mass_matrix" and index >= 0:
            return frozenset({f"body-{self.model.bodies[index // 3].name}"})
        if function_name in RESULT_SYMBOLS:
            term_tokens = self._get_term_tokens(target) if function_name == "constraints" else NO_TOKENS
            if index < 0:
                return term_tokens
            if function_name == "jacobian":
                row, column = divmod(index, len(self.model.q))
                number = self.row_numbers.get(self.all_rows[row].name)
                return term_tokens | ({make_entry_token(number, column + 1)} if number else NO_TOKENS)
            return term_tokens | self._get_row_tokens(self.all_rows[index].name)
        if function_name in ("dynamics", "closures", "closure_rates"):
            return self._find_constraint_tokens(function_name, line.declared_local, array, index)
        if function_name == STEP:
            return self._get_row_tokens(self.loop_row_by_local.get(line.declared_local, ""))
        return NO_TOKENS

    def _find_constraint_tokens(self, function_name: str, local_name: str, array: str, index: int) -> Tokens:
        """Return the token of the constraint equation of a value that `dynamics` or a function of loop closures stores.

        It follows from the index in the array phi, phi_dot or out (negative: none), or from the local's name rhs_<row>.
        The index counts the rows of the full formulation in `dynamics`, and the loop closures of the integrated system
        in `closures` and `closure_rates`. The result is a set, empty for other values.
        """
        rows = self.model.rows if function_name == "dynamics" else self.program.integrated.system.rows
        if index >= 0 and array in ("phi", "phi_dot", "out"):
            return self._get_row_tokens(rows[index].name)
        name = next((row.name for row in rows if local_name == make_identifier(f"rhs_{row.name}")), "")
        return self._get_row_tokens(name)

    def _get_row_tokens(self, name: str) -> Tokens:
        """Return the token of a constraint equation by its name as a set; empty if the motion does not contain it."""
        return frozenset({make_row_token(self.row_numbers[name])}) if name in self.row_numbers else NO_TOKENS

    def _get_term_tokens(self, target: Key) -> Tokens:
        """Return the token "name-LOCAL" of a local that is a term of Φ in the document, as a set; empty for others."""
        return frozenset({f"name-{target}"}) if target in self.term_names else NO_TOKENS

    def _get_single_line_tokens(self, function_name: str, target: Key) -> Tokens:
        """Return the token that is not propagated to other lines: of the sum of a component of Φ, or of a multiplier.

        The set is empty for other lines.
        """
        array, index = _split_element(target)
        if function_name == "constraints" and index >= 0:
            number = self.row_numbers.get(self.all_rows[index].name)
            return frozenset({make_sum_token(number)} if number else ())
        if function_name == "dynamics" and array == "lambda" and 0 <= index < len(self.model.rows):
            return self._get_row_tokens(self.model.rows[index].name)
        return NO_TOKENS

    def _add_text_tokens(self, text: str, tokens: Tokens) -> None:
        """Add tokens to all lines of a text, such as a function, in the C file that contains it.

        Nothing is added if no file contains the text.
        """
        file, line_numbers = locate_text(text, self.files)
        for line_number in line_numbers:
            self.lines[file][line_number] |= tokens

    def _collect_parameter_tokens(self) -> None:
        """Collect the tokens of the lines of `prepare`: those of all parameters that depend on them.

        A parameter that the user sets has the further token "number-NAME". Tokens of derived parameters are added to
        the parameters from which they are computed.
        """
        kernel = self.program.prepare
        places = {
            s.name: self.model.parameter_table.find_storage_location(s)
            for s in self.model.parameter_table.list_symbols()
        }
        entry_names = {entry.symbol.name for entry in self.model.parameter_table.entries.values()}
        tokens_by_name = {
            name: self.tokens_by_parameter[place] | ({f"number-{name}"} if name in entry_names else set())
            for name, place in places.items()
        }
        dependence = compute_backward_slices(
            make_readable(kernel), lambda line: frozenset(tokens_by_name.get(_find_stored_parameter(line, places), ()))
        )
        for target, tokens in dependence.by_target.items():
            self.tokens_by_parameter[target] |= tokens
        self._add_stores(kernel, dependence.by_target)

    def get_tokens_by_address(self) -> dict[str, Tokens]:
        """Return {address: highlighting tokens} of all run-time parameters; called after `collect_tokens`."""
        table = self.model.parameter_table
        return {
            entry.address: frozenset(self.tokens_by_parameter[table.find_storage_location(entry.symbol)])
            for entry in table.entries.values()
        }


def _split_element(target: Key) -> tuple[str, int]:
    """Return (array, index) of an element of an array or of an array in `rhs`; (text of the target, −1) for others."""
    match target:
        case StorageLocation(array, (int() as index,)) | StorageLocation(RHS.name, (str() as array, int() as index)):
            return array, index
    return str(target), -1


def _find_stored_parameter(line: Statement | Branch, places: Mapping[str, StorageLocation]) -> str:
    """Return the name of the parameter that a line of `prepare` stores; "" if it stores none."""
    return next((name for name, place in places.items() if line.target in (name, place)), "")


def list_yaml_tokens(model: Model, highlights: HighlightIndex) -> dict[int, Tokens]:
    """Return {line of the mechanism's file: highlighting tokens}: of its entries, and of what depends on its numbers.

    Constraint equations and their entries of Φ_q belong to the line of their joint or drive. Each line also has the
    token "yaml-LINE". Lines without another token are left out.
    """
    tokens: defaultdict[int, set[str]] = defaultdict(set)
    mechanism = model.scene.mechanism
    joints = {name: joint.where.line for name, joint in mechanism.joints.items()}
    drives = {name: drive.where.line for name, drive in mechanism.drives.items()}
    bodies = {name: body.where.line for name, body in mechanism.bodies.items()}
    line_of = {"joint": joints, "drive": drives, "body": bodies}
    for kind, lines in line_of.items():
        for name, line in lines.items():
            tokens[line].add(f"{kind}-{name}")
    for number, row in enumerate(model.rows, 1):
        tokens[line_of[row.kind][row.owner]] |= {make_row_token(number), *list_entry_tokens(model, number, row)}
    for play in model.scene.play.values():
        for quantity in iterate_quantities(play.contact):
            tokens[quantity.where.line].add(f"law-{play.contact.name}")
    for quantity in (*iterate_quantities(mechanism), *model.scene.parameters.values()):
        if quantity.address in highlights.tokens_by_address:
            tokens[quantity.where.line] |= highlights.tokens_by_address[quantity.address]
    return {line: frozenset({f"yaml-{line}", *line_tokens}) for line, line_tokens in tokens.items()}
