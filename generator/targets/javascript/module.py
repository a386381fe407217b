"""Writes Φ, Φ_q, ν, γ and the forces of joints with play as JavaScript, for the values that a page shows."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from contextlib import suppress

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.dependence import slices
from gudgeon.generator.ir.kernels import Kernel, KernelBuilder
from gudgeon.generator.ir.readable import readable
from gudgeon.generator.ir.signatures import PARAMETERS, STATE
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels import closed_linkage
from gudgeon.generator.kernels.driven_chains import DIRECTIONS, RATES, STEP, THIRD
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.kernels.reduced import DYNAMICS
from gudgeon.generator.symbols.symbols import made_name
from gudgeon.generator.targets.javascript.play import joint_functions, motion
from gudgeon.generator.targets.javascript.printer import CONTOUR, PRELUDE, arguments, function

_OF_STATES = (
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
# as we write them: alone on their lines, or behind code with a space on either side
_COMMENT = re.compile(r"^ *(?:/\*.*?\*/|//[^\n]*)\n|(?<=\S) // [^\n]*$", re.DOTALL | re.MULTILINE)


def equations_script(program: Program) -> str:
    """Return the JavaScript that declares `gudgeonEquations`: the functions and the description that a page needs.

    The functions of clearance.c are included, of `dynamics` the lines up to the right-hand side of each row. `joints`
    contains the locals of `play` with the motion of each joint, `called` the joints of each function.

    `functions` of t, q, v, p, as far as `given` names them, return their locals and arrays by name; `numbers` are
    indices in a run's p by the name of the member of p; `bodies` stand in the order of q, `closing` are the indices of
    the results of `closures` in the argument of `reduced_project`; `rows` are the indices of the scene's rows in the
    closed linkage's, `names` their names. Raises ValueError for curves.
    """
    model, dynamics = program.model, program.dynamics
    kernels = [*closed_linkage.row_kernels(model), *([play_kernel(model)] if model.clearances else [])]
    read: set[str] = set()
    texts = [function(dynamics, read, right_hand_sides(dynamics, model))]
    texts += [function(kernel, read) for kernel in (*kernels, *program.laws)]
    texts += [text for pin in program.pins for text in joint_functions(pin, read)]
    in_tree = tree_functions(program, read)
    texts = [*in_tree.values(), *texts]  # nearest to what they are like in C: packed, that takes the least room
    kernels += [dynamics, *(kernel for kernel in _tree_kernels(program) if kernel.name in in_tree)]
    text = ",\n".join(texts)
    members = map(model.slots.field, model.slots.members())
    place = {row.name: k for k, row in enumerate(model.all_rows)}
    message = {
        "numbers": {one: k for k, one in enumerate(members) if one in read},
        "rows": [place[row.name] for row in model.rows],
        "names": [row.name for row in model.rows],
        "given": {kernel.name: arguments(kernel) for kernel in kernels},
        "joints": {clearance.label: _motion_locals(model, i) for i, clearance in enumerate(model.clearances)},
        "called": _joints_of_functions(program),
        "states": model.law_states,
        "bodies": [body.name for body in model.bodies],
        "closing": _closure_indices(program),
    }
    if model.slots.tables:
        place_of = {symbol: k for k, symbol in enumerate(model.slots.members())}
        first = {name: place_of[own[0]] for name, own in model.slots.tables.items()}
        message["tables"] = {name: [first[name], first[name] + len(own)] for name, own in model.slots.tables.items()}
    prelude = PRELUDE + CONTOUR * bool(model.slots.tables)
    parts = ", ".join(f"{key}: {json.dumps(value, separators=(',', ':'))}" for key, value in message.items())
    return (
        f"const gudgeonEquations = (() => {{\n{prelude}const functions = {{\n{text},\n}};\n"
        f"return {{{parts}, functions}};\n}})();\n"
    )


def tree_functions(program: Program, read: set[str]) -> dict[str, str]:
    """Return the functions of reduced.c that a sample suffices to evaluate, by name; `read` gets the members of p.

    Driven loops are closed in a sample, and their rates follow from their coordinates. Friction modes are not known.
    """
    found = dict[str, str]()
    for kernel in _tree_kernels(program):
        with suppress(ValueError):
            found[kernel.name] = function(kernel, read)
    return found


def _tree_kernels(program: Program) -> list[Kernel]:
    """Return the kernels in tree coordinates that can be evaluated from a sample."""
    tree = program.tree
    return [kernel for kernel in tree.every if kernel.name in _OF_STATES] if tree else []


def _closure_indices(program: Program) -> list[int]:
    """Return the index of each loop closure among all rows of the tree's linkage."""
    if program.tree is None:
        return []
    system = program.tree.system
    place = {row.name: k for k, row in enumerate(system.model.all_rows)}
    return [place[row.name] for row in system.rows]


def right_hand_sides(dynamics: Kernel, model: Model) -> set[str]:
    """Return the locals of `dynamics` on which the right-hand sides of its linear system depend."""
    names = {made_name(f"rhs_{row.name}") for row in model.rows}
    found = slices(readable(dynamics), lambda line: frozenset({"rhs"} if line.target in names else ()))
    return {name for name in found.stored if isinstance(name, str)}


def _joints_of_functions(program: Program) -> dict[str, list[str]]:
    """Return the joints in which each function of clearance.c acts."""
    found: defaultdict[str, list[str]] = defaultdict(list)
    for pin in program.pins:
        parts = (f"{part}_{pin.clearance.label}_" for part in ("clearance", "dry", "film"))
        for name in (*parts, *(call.kernel.name for call in pin.laws.values())):
            found[name].append(pin.clearance.label)
    return found


def _motion_locals(model: Model, index: int) -> list[str]:
    """Return the locals of `play` that contain the motion in a joint."""
    used = {symbol.name for symbol in model.symbols.info}
    first = next(word for word in ("play", "joint", "with_play") if not any(one.startswith(word) for one in used))
    return [f"{first}_{index + 1}_{symbol.name}" for symbol in motion(model.clearances[index])]


def play_kernel(model: Model) -> Kernel:
    """Return the kernel of eccentricity, its rate and angular velocities of each joint with play."""
    build = KernelBuilder(model.symbols, "play", ["Joints with play: eccentricity, its rate, angular velocities."])
    for i, clearance in enumerate(model.clearances):
        build.section(f"{clearance.kind} {clearance.name}")
        turning = clearance.first.omega, clearance.second.omega
        values = (*clearance.eccentricity, *clearance.eccentricity_rate, *turning)
        values += clearance.also
        for name, value in zip(_motion_locals(model, i), values, strict=True):
            build.line(Statement(name, sp.sympify(value)))
    return build.build((*STATE, PARAMETERS))


_TEXT = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')""")  # strings within a line of JavaScript
_SPACED = re.compile(r" ?(=>|[!=]==|\?\?=?|&&|\|\||[=,?:;(){}]) ?")


def embedded_script(text: str) -> str:
    """Return a JavaScript file without comments, indents and spaces around punctuation, for embedding in a page.

    Lines are kept, since they end statements. Lines with or within template strings keep their spaces.
    """
    lines, inside = [], False
    for line in re.sub(r"(?m)^ +|^\n", "", _COMMENT.sub("", text)).split("\n"):
        parts = _TEXT.split(line)
        if not inside and "`" not in line:
            parts[::2] = (_SPACED.sub(r"\1", part) for part in parts[::2])
        lines.append("".join(parts))
        inside ^= line.count("`") % 2 == 1
    return "\n".join(lines)
