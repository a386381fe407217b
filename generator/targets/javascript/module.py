"""Emits constraints, their derivatives and forces of joints with play as JavaScript, for the values on a page."""

from __future__ import annotations

import json
from collections import defaultdict
from contextlib import suppress

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.dependence import compute_backward_slices
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.readable import make_readable
from gudgeon.generator.ir.signatures import PARAMETERS, STATE
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.driven_loops import DIRECTIONS, RATES, STEP, THIRD
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kernels.reduced import DYNAMICS
from gudgeon.generator.symbols.symbols import make_identifier
from gudgeon.generator.targets.javascript.play import list_motion_symbols, print_joint_methods
from gudgeon.generator.targets.javascript.printer import CONTOUR, PRELUDE, list_arguments, print_method

_STATE_FUNCTIONS = (
    "reduce_state",
    "reduce_accelerations",
    "expand",
    "closures",
    "closure_rates",
    DYNAMICS,
    "reduced_project",
    DIRECTIONS,
    STEP,
    RATES,
    THIRD,
)


def print_equations_script(program: Program) -> str:
    """Return the JavaScript that declares `gudgeonEquations`: the functions and the description that a page needs.

    The functions of clearance.c are included, of `dynamics` the lines up to the right-hand side of each row. Members:

    - functions: return their locals and arrays by name; argumentNames: their arguments by function
    - parameterIndices: indices in a run's p by the name of the member of p; tableRanges: first and end index of tables
    - rowIndices: indices of the scene's rows among those of the closed linkage; rowNames: their names
    - motionLocals: the locals of `play` with the motion of each joint; jointsByFunction: joints that call a function
    - nLawStates: number of internal states of laws per joint; bodies: names in the order of q
    - closureIndices: indices of the results of `closures` in the argument of `reduced_project`

    Raises ValueError for curves.
    """
    model, dynamics = program.model, program.dynamics
    kernels = [*closed_linkage.make_constraint_kernels(model), *([make_play_kernel(model)] if model.clearances else [])]
    members_read: set[str] = set()
    methods = [print_method(dynamics, members_read, find_right_hand_side_locals(dynamics, model))]
    methods += [print_method(kernel, members_read) for kernel in (*kernels, *program.laws)]
    methods += [method_text for joint in program.joints for method_text in print_joint_methods(joint, members_read)]
    tree_methods = print_reduced_functions(program, members_read)
    methods = [*tree_methods.values(), *methods]  # the order of the similar C, with which the page is compressed
    kernels += [dynamics, *(kernel for kernel in _list_state_kernels(program) if kernel.name in tree_methods)]
    method_text = ",\n".join(methods)
    members = map(model.parameter_table.find_member_name, model.parameter_table.list_symbols())
    row_index = {row.name: k for k, row in enumerate(model.all_rows)}
    description = {
        "parameterIndices": {member: k for k, member in enumerate(members) if member in members_read},
        "rowIndices": [row_index[row.name] for row in model.rows],
        "rowNames": [row.name for row in model.rows],
        "argumentNames": {kernel.name: list_arguments(kernel) for kernel in kernels},
        "motionLocals": {joint.label: _name_motion_locals(model, i) for i, joint in enumerate(model.clearances)},
        "jointsByFunction": _map_functions_to_joints(program),
        "nLawStates": model.law_states,
        "bodies": [body.name for body in model.bodies],
        "closureIndices": _find_closure_indices(program),
    }
    if model.parameter_table.tables:
        member_index = {symbol: k for k, symbol in enumerate(model.parameter_table.list_symbols())}
        first_index = {name: member_index[symbols[0]] for name, symbols in model.parameter_table.tables.items()}
        description["tableRanges"] = {
            name: [first_index[name], first_index[name] + len(symbols)]
            for name, symbols in model.parameter_table.tables.items()
        }
    prelude = PRELUDE + CONTOUR * bool(model.parameter_table.tables)
    description_text = ", ".join(
        f"{key}: {json.dumps(value, separators=(',', ':'))}" for key, value in description.items()
    )
    return (
        f"const gudgeonEquations = (() => {{\n{prelude}const functions = {{\n{method_text},\n}};\n"
        f"return {{{description_text}, functions}};\n}})();\n"
    )


def print_reduced_functions(program: Program, members_read: set[str]) -> dict[str, str]:
    """Return {name: JavaScript method} of the functions of reduced.c that can be evaluated from a sample of a run.

    A function with a line that JavaScript does not have is left out, such as one that needs friction modes or curves.
    {} is returned in the full formulation. members_read: a set to which the members of p that are read are added.
    """
    functions = dict[str, str]()
    for kernel in _list_state_kernels(program):
        with suppress(ValueError):
            functions[kernel.name] = print_method(kernel, members_read)
    return functions


def _list_state_kernels(program: Program) -> list[Kernel]:
    """Return the kernels in tree coordinates that depend on the state only (_STATE_FUNCTIONS); [] without a tree."""
    tree = program.tree
    return [kernel for kernel in tree.all_kernels if kernel.name in _STATE_FUNCTIONS] if tree else []


def _find_closure_indices(program: Program) -> list[int]:
    """Return the index of each loop closure among the constraint equations of the tree; [] in the full formulation."""
    if program.tree is None:
        return []
    system = program.tree.system
    row_index = {row.name: k for k, row in enumerate(system.model.all_rows)}
    return [row_index[row.name] for row in system.rows]


def find_right_hand_side_locals(dynamics: Kernel, model: Model) -> set[str]:
    """Return the names of the locals of `dynamics` that the right-hand sides of its constraint equations depend on.

    The right-hand sides `rhs_<row>` themselves are included.
    """
    names = {make_identifier(f"rhs_{row.name}") for row in model.rows}
    dependence = compute_backward_slices(
        make_readable(dynamics), lambda line: frozenset({"rhs"} if line.target in names else ())
    )
    return {name for name in dependence.by_target if isinstance(name, str)}


def _map_functions_to_joints(program: Program) -> dict[str, list[str]]:
    """Return {C function: labels of the joints with play that it belongs to}, for functions of joints and of laws.

    A law that several joints share has several labels. Names of parts that a joint does not have are included.
    """
    labels: defaultdict[str, list[str]] = defaultdict(list)
    for joint in program.joints:
        parts = (f"{part}_{joint.clearance.label}_" for part in ("clearance", "dry", "film"))
        for name in (*parts, *(call.kernel.name for call in joint.laws.values())):
            labels[name].append(joint.clearance.label)
    return labels


def _name_motion_locals(model: Model, index: int) -> list[str]:
    """Return the names of the locals of `play` that contain the relative motion in the joint with play `index`, from 0.

    Example: "play_1_e_x". The prefix is the first of "play", "joint" and "with_play" that no symbol of the scene begins
    with.
    """
    symbol_names = {symbol.name for symbol in model.symbols.info}
    prefix = next(
        word
        for word in ("play", "joint", "with_play")
        if not any(symbol_name.startswith(word) for symbol_name in symbol_names)
    )
    return [f"{prefix}_{index + 1}_{symbol.name}" for symbol in list_motion_symbols(model.clearances[index])]


def make_play_kernel(model: Model) -> Kernel:
    """Return the kernel `play`, which stores the motion in each joint with play as locals.

    The locals contain eccentricity and its rate in ground axes, and both angular velocities. A corner at a wall also
    has the normal, a bearing with a contour its angle.
    """
    builder = KernelBuilder(model.symbols, "play", ["Joints with play: eccentricity, its rate, angular velocities."])
    for i, clearance in enumerate(model.clearances):
        builder.begin_section(f"{clearance.kind} {clearance.name}")
        angular_velocities = clearance.first.omega, clearance.second.omega
        values = (*clearance.eccentricity, *clearance.eccentricity_rate, *angular_velocities)
        values += clearance.surface_arguments
        for name, value in zip(_name_motion_locals(model, i), values, strict=True):
            builder.append_instruction(Statement(name, sp.sympify(value)))
    return builder.build_kernel((*STATE, PARAMETERS))
