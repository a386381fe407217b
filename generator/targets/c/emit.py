"""Writes a scene as C files, in the full and the reduced formulation, and describes their contents."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache, partial
from importlib import resources
from typing import Any

import jinja2
import sympy as sp

from gudgeon.contract.kernel_source import ENGINE_PART, HEADER, MAIN, KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.kernels.driven_chains import ChainKernels
from gudgeon.generator.kernels.program import Program, TreeFunctions
from gudgeon.generator.kernels.reduction_log import build_reduction_log
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.symbols.storage import PARAMETERS, Place
from gudgeon.generator.targets.c import functions, ranges_printer, readme, taylor
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c.curves import NAME as CURVES
from gudgeon.generator.targets.c.curves import curves_code
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.model_header import header_values, joint_parameters, known_bounds
from gudgeon.generator.targets.c.newton import newton_code, tangent_code
from gudgeon.generator.targets.c.play import clearances_code
from gudgeon.generator.targets.c.printer import within
from gudgeon.generator.targets.c.reduced_summary import reduced_summary

CLEARANCES = "clearance.c"
NOT_AT_START = ("acceleration_rhs", "outputs")  # functions of the closed linkage that a start does not call
ABSOLUTE, REDUCED, METHODS = 1, 2, 3  # the parts of MAIN, as PART in C counts them
Begun = Callable[[int, Mapping[str, str]], None]
Texts = dict[str, Callable[[], str]]  # file -> function that prints it, called when needed


def emit(program: Program, begun: Begun | None = None) -> KernelSource:
    """Return the C files of a scene with their description; with a series they contain Taylor's method.

    `begun` is called with the engine and with each part of MAIN as soon as all files that it includes are printed.
    """
    model, series = program.model, program.series
    bounds = known_bounds(program)
    files = {HEADER: within(render("model.h.jinja", **header_values(program, bounds)))}
    if begun:
        begun(ENGINE_PART, files)
    parts, shared = _files_of_parts(program, bounds), _shared_files(program)
    if series:
        parts[REDUCED][taylor.FILE] = lambda: taylor.taylor_code(series)
    files |= {MAIN: _main_code(parts, shared), **_print_files(shared)}
    for number, texts in parts.items():
        files |= _print_files(texts)
        if begun and not model.scene.mechanism.curves:
            begun(number, files)
    if tables := curves_code(model.scene.mechanism.curves, files.values()):
        files |= {MAIN: _main_code(parts, [CURVES, *shared]), CURVES: tables}
    if program.has_lanes:
        files |= {name: within(text) for name, text in lanes_code.lanes_code(program, render).items()}
    files[readme.NAME] = readme.readme(program, files)
    described = describe_program(program, files, () if CURVES in files else tuple(parts))
    return replace(described, taylor=taylor.FILE) if series else described


def describe_program(program: Program, files: Mapping[str, str], units: tuple[int, ...] = ()) -> KernelSource:
    """Return the description of a scene and its files for the runtime."""
    model, tree, integrated, course = program.model, program.tree, program.integrated, program.course
    return describe(
        model,
        files=files,
        main=MAIN,
        units=units,
        pivots=program.kkt.pivots,
        start_pivots=course.pivots if course else (),
        motion_pivots=integrated.pivots,
        operations=_count_operations(program),
        tree=tree.system.unknowns if tree else (),
        chain=integrated.chain,
        closures=tuple(row.name for row in tree.system.rows) if tree else (),
        formulation=program.formulation,
        story=build_reduction_log(
            model,
            program.kkt,
            course.solved if course else integrated.kkt,
            integrated.system,
            course.groups if course else (),
        ),
        lanes=lanes_code.MAIN if program.has_lanes else "",
        stages=program.staged,
    )


def file_names(program: Program) -> list[str]:
    """Return the names of the files that `emit` writes, except curves.c and README.md, without printing them."""
    parts = _files_of_parts(program, known_bounds(program))
    printed = [name for texts in parts.values() for name in texts]
    return [HEADER, MAIN, *_shared_files(program), *printed, *([lanes_code.MAIN] if program.has_lanes else [])]


def _shared_files(program: Program) -> Texts:
    """Return the files that every part except METHODS includes."""
    return {CLEARANCES: lambda: clearances_code(program, render)} if program.pins else {}


def _files_of_parts(program: Program, bounds: Kernel | None) -> dict[int, Texts]:
    """Return the files of each part of MAIN in the order in which they are included."""
    tree, course = program.tree, program.course
    parts: dict[int, Texts] = {
        ABSOLUTE: {
            "parameters.c": lambda: _parameters_code(program),
            "constraints.c": lambda: _constraints_code(program),
            "dynamics.c": lambda: _print_kernels(*program.right_hand_side),
        }
    }
    if tree:
        parts[REDUCED] = {"reduced.c": lambda: reduced_code(program.model, tree, render, _print_kernels)}
    if course:
        parts[METHODS] = {"positions.c": lambda: _print_kernels(*course.kernels)}
    elif program.methods:
        parts[METHODS] = {"newton.c": lambda: _newton_code(program)}
    if program.methods and program.staged:
        parts[METHODS]["newton_complex.c"] = partial(_print_kernels, *program.methods.at_complex)
    if _has_bounds(program, bounds):
        parts[METHODS]["watched.c"] = lambda: _bounds_code(program, bounds)
    return parts


def _print_files(texts: Texts) -> dict[str, str]:
    """Print files."""
    return {name: within(text()) for name, text in texts.items()}


def _main_code(parts: Mapping[int, Iterable[str]], shared: Iterable[str]) -> str:
    """Return MAIN, which includes all other files, or those of one part, and the engine's additions."""
    first = (HEADER, "engine/scene/kernels.h", "engine/scene/trigonometry.h")
    lines = ["/* All files together, or with -DPART=1, 2, 3 those of a part: these are compiled side by side. */"]
    lines += [*map(_include_line, first), *_include_if(f"PART != {METHODS}", shared)]
    for number, names in parts.items():
        lines += _include_if(f"!PART || PART == {number}", names)
    return "\n".join([*lines, _include_line("engine/scene/scene.c"), ""])


def _include_if(condition: str, names: Iterable[str]) -> list[str]:
    """Return the includes of files within an #if."""
    lines = [_include_line(name) for name in names]
    return [f"#if {condition}", *lines, "#endif"] if lines else []


def _include_line(name: str) -> str:
    """Return an #include line."""
    return f'#include "{name}"'


def _parameters_code(program: Program) -> str:
    """Return parameters.c: `prepare`, and the functions for parameters of joints with play."""
    functions_of_joints = render("of_joints.c.jinja", of_joints=joint_parameters(program.model)) if program.pins else ""
    return _print_kernels(program.prepare) + functions_of_joints


def _constraints_code(program: Program) -> str:
    """Return constraints.c: functions of the closed linkage, and `same_start` for scenes that are integrated."""
    at_start = (kernel for kernel in program.closed if kernel.name not in NOT_AT_START)
    return _print_kernels(*program.closed) + (same_start(at_start) if program.integrates else "")


def _newton_code(program: Program) -> str:
    """Return newton.c: the linearized equations, Newton's matrix, and the projection onto the constraints."""
    methods = program.methods
    if methods is None:
        return ""
    slopes = tangent_code(program.pins, methods, render, program.model.law_states)
    return slopes + newton_code(methods.newton, render) + functions.kernel(methods.closing)


def _has_bounds(program: Program, watched: Kernel | None) -> bool:
    """Return whether bounds over a step are known for any event function or term of time."""
    return bool(program.terms.kernel or watched)


def _bounds_code(program: Program, watched: Kernel | None) -> str:
    """Return watched.c: bounds of event functions and of terms of time over ranges of time and state."""
    return "\n".join(ranges_printer.kernel(kernel) for kernel in (program.terms.kernel, watched) if kernel)


def render(name: str, /, **values: Any) -> str:
    """Return a template with its substitutions. Raises an error for an undefined name."""
    return _environment().get_template(name).render(**values) + "\n"


@cache
def _environment() -> jinja2.Environment:
    """Return the environment of the templates, one for all scenes: reading them takes half of a small scene's time."""

    def load(name: str) -> str:
        """Return the text of a template."""
        return resources.files("gudgeon.templates").joinpath("c", name).read_text(encoding="utf-8")

    return jinja2.Environment(
        loader=jinja2.FunctionLoader(load), undefined=jinja2.StrictUndefined, autoescape=False, trim_blocks=True
    )


def _print_kernels(*kernels: Kernel) -> str:
    """Print several kernels."""
    return "\n".join(map(functions.kernel, kernels))


def _all_kernels(program: Program) -> list[Kernel]:
    """Return all kernels of a program."""
    tree, extra = program.tree, program.methods or program.course
    kernels = [*program.right_hand_side, *program.closed, *(tree.every if tree else ()), program.prepare]
    return [*kernels, *(extra.kernels if extra else ()), *program.laws]


def _count_operations(program: Program) -> dict[str, int]:
    """Return the number of operations of each function, for `check -v`; laws are listed for each joint."""
    calls = [(pin.clearance.name, *call) for pin in program.pins for call in pin.laws.items()]
    laws = {f"{role}_{joint}_force": call.kernel for joint, role, call in calls}
    own = {kernel.name: kernel for kernel in _all_kernels(program) if kernel not in program.laws}
    return {name: kernel.operations for name, kernel in (own | laws).items()}


def same_start(called: Iterable[Kernel]) -> str:
    """Return the C function that compares the parameters that the kernels `called` by a start read.

    It returns 0 if these kernels read tables, or pass on all parameters (engine/scene/start.c).
    """
    lines = [line for kernel in called for section in kernel.sections for line in section.statements]
    read = [name for line in lines for name in _parameters_read(line)]
    names = [*dict.fromkeys(read)]
    tests = "\n        && ".join(f"same_number(p->{name}, other->{name})" for name in names)
    known = all(name.isidentifier() for name in names)
    body = f"    return {tests};\n" if known and tests else f"    (void)p, (void)other;\n    return {int(known)};\n"
    return (
        "\n/* Whether a start with these numbers is that with the others: what closing the linkage reads. */\n"
        f"int same_start(const Parameters *p, const Parameters *other)\n{{\n{body}}}\n"
    )


def _parameters_read(line: Line) -> list[str]:
    """Return the members of Parameters that a line reads; [""] for all of them."""
    if isinstance(line, Statement) and isinstance(line.value, Place) and line.value.is_parameter:
        return [line.value.member]
    return [""] if PARAMETERS in line.reads else []


Render = Callable[..., str]


def reduced_code(model: Model, tree: TreeFunctions, render: Render, print_kernels: Render) -> str:
    """Return reduced.c: kernels in tree coordinates, the conversion from and to all coordinates, driven loops."""
    parts = [functions.comment(reduced_summary(tree.system))]
    parts += [print_kernels(*tree.around), print_kernels(*tree.kernels)]
    if tree.rescued:
        parts.append(render("multipliers.c.jinja", multipliers=_multipliers_of_closures(model, tree.system)))
    if chains := tree.chains:
        kernels = print_kernels(*chains.kernels)
        parts.append(
            render("driven_loops.c.jinja", kernels=kernels, shares=_step_factors(chains), turned=_turn_angles(chains))
        )
    return "\n".join(parts)


def _step_factors(chains: ChainKernels) -> list[str]:
    """Return the factor that makes a step of each coordinate dimensionless: 1 for angles, 1/size for slides."""
    size = f"1.0 / (p->{chains.size} + DBL_MIN)" if chains.size.is_Symbol else "1.0"  # without one all points are one
    return ["1.0" if "." not in name else size for name in chains.chain.names]


def _turn_angles(chains: ChainKernels) -> list[tuple[int, str]]:
    """Return the index in q of each direction that a step of the loops' coordinates turns, and its angle."""

    def factor(c: sp.Expr) -> str:
        """Return a coefficient as a factor in C."""
        if c == 1:
            return ""
        return f"{float(c)!r} * " if c.is_Number else f"-p->{-c} * " if (-c).is_Symbol else f"p->{c} * "

    first = chains.first + len(chains.chain.names)
    return [
        (first + 2 * k, " + ".join(f"{factor(c)}step[{j}]" for j, c in d.turns.items()))
        for k, d in enumerate(chains.chain.directions)
        if d.turns
    ]


def _multipliers_of_closures(model: Model, system: TreeSystem) -> list[str]:
    """Return each closure's multiplier in terms of the multipliers of the full formulation."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]
