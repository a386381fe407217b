"""Emits the C files of a scene, in absolute and in tree (reduced) coordinates, and describes their contents."""

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
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.kernels.driven_loops import DrivenLoopKernels
from gudgeon.generator.kernels.program import Program, TreeFunctions
from gudgeon.generator.kernels.reduction_log import build_reduction_log
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.symbols.storage import PARAMETERS, StorageLocation
from gudgeon.generator.targets.c import functions, ranges_printer, readme, taylor
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c.curves import NAME as CURVES
from gudgeon.generator.targets.c.curves import print_curve_tables
from gudgeon.generator.targets.c.describe import describe_scene
from gudgeon.generator.targets.c.equal_parts import PARAMETER_INDEX
from gudgeon.generator.targets.c.model_header import list_joint_parameters, make_bounds_kernel, make_header_values
from gudgeon.generator.targets.c.newton import print_newton_functions, print_tangent_functions
from gudgeon.generator.targets.c.play import print_clearances_file
from gudgeon.generator.targets.c.printer import wrap_file
from gudgeon.generator.targets.c.reduced_summary import describe_reduced_file

CLEARANCES = "clearance.c"
NOT_AT_START = ("acceleration_rhs", "outputs")  # functions of the closed linkage that a start does not call
MAX_INLINE_COMPARISONS = 500  # parameters that are compared in one expression; more are compared in a loop
WHOLE_STRUCT = ""  # in place of a member: the whole struct Parameters is read or passed
ABSOLUTE, REDUCED, METHODS = 1, 2, 3  # the parts of MAIN, as PART in C counts them
PartCallback = Callable[[int, Mapping[str, str]], None]
FilePrinters = dict[str, Callable[[], str]]  # file -> function that prints it, called when needed


def emit_scene(program: Program, on_part_printed: PartCallback | None = None) -> KernelSource:
    """Return the KernelSource of a scene: its C files by name, with their description for the runtime.

    With a Taylor series, the method `taylor` is included. `on_part_printed(number, files)`, if given, is called with
    the files printed so far: for ENGINE_PART after model.h, then after each part of MAIN, so that it is compiled
    meanwhile. For mechanisms with curves it is called for ENGINE_PART only, since curves.c is printed last.
    """
    model, series = program.model, program.series
    bounds = make_bounds_kernel(program)
    files = {HEADER: wrap_file(render_template("model.h.jinja", **make_header_values(program, bounds)))}
    if on_part_printed:
        on_part_printed(ENGINE_PART, files)
    parts, shared = _list_files_of_parts(program, bounds), _list_shared_files(program)
    if series:
        parts[REDUCED][taylor.FILE] = lambda: taylor.print_taylor_file(series)
    files |= {MAIN: _print_main_file(parts, shared), **_print_files(shared)}
    for number, texts in parts.items():
        files |= _print_files(texts)
        if on_part_printed and not model.scene.mechanism.curves:
            on_part_printed(number, files)
    if tables := print_curve_tables(model.scene.mechanism.curves, files.values()):
        files |= {MAIN: _print_main_file(parts, [CURVES, *shared]), CURVES: tables}
    if program.has_lanes:
        files |= {
            name: wrap_file(text) for name, text in lanes_code.print_lanes_files(program, render_template).items()
        }
    files[readme.NAME] = readme.print_readme(program, files)
    described = describe_program(program, files, () if CURVES in files else tuple(parts))
    return replace(described, taylor_file=taylor.FILE if series else "", max_taylor_tolerance=program.taylor_below)


def describe_program(
    program: Program, files: Mapping[str, str], compilation_units: tuple[int, ...] = ()
) -> KernelSource:
    """Return the KernelSource of a program: its C files, and what the runtime must know of the model and the C.

    It contains names of coordinates and results, parameters, pivots, operation counts and the log of the reduction.
    files: the text of each printed file by name; {} if the C is not needed. compilation_units: the parts of MAIN that
    are compiled separately; () for one unit.
    """
    model, tree, integrated, kinematics = program.model, program.tree, program.integrated, program.kinematics
    return describe_scene(
        model,
        files=files,
        main=MAIN,
        units=compilation_units,
        pivots=program.kkt.pivots,
        start_pivots=kinematics.pivots if kinematics else (),
        integrated_pivots=integrated.pivots,
        operations=_count_function_operations(program),
        tree_coordinates=tree.system.unknowns if tree else (),
        driven_loops=integrated.driven_loops,
        closures=tuple(row.name for row in tree.system.rows) if tree else (),
        formulation=program.formulation,
        reduction_log=build_reduction_log(
            model,
            program.kkt,
            kinematics.projection_kkt if kinematics else integrated.kkt,
            integrated.system,
            kinematics.groups if kinematics else (),
        ),
        lane_file=lanes_code.MAIN if program.has_lanes else "",
        has_complex_stages=program.has_complex_stages,
    )


def list_file_names(program: Program) -> list[str]:
    """Return the names of the C files that `emit_scene` writes, without printing them.

    curves.c, whose presence depends on the printed text, taylor.c and README.md are left out.
    """
    files_of_parts = _list_files_of_parts(program, make_bounds_kernel(program))
    names_in_parts = [name for texts in files_of_parts.values() for name in texts]
    return [
        HEADER,
        MAIN,
        *_list_shared_files(program),
        *names_in_parts,
        *([lanes_code.MAIN] if program.has_lanes else []),
    ]


def _list_shared_files(program: Program) -> FilePrinters:
    """Return {file: function that prints it} of the files that all parts except METHODS include.

    It is clearance.c, or {} without joints with play.
    """
    return {CLEARANCES: lambda: print_clearances_file(program, render_template)} if program.joints else {}


def _list_files_of_parts(program: Program, bounds: Kernel | None) -> dict[int, FilePrinters]:
    """Return {number of a part of scene.c: {file: function that prints it}}, files in the order of their inclusion.

    Parts are compiled in parallel. ABSOLUTE (parameters, constraints, dynamics) always exists, REDUCED with the reduced
    formulation only. METHODS exists if it has files: positions of a kinematic scene, Newton's method of implicit
    integrators, bounds of event functions. bounds: the kernel of these bounds, or None.
    """
    tree, kinematics = program.tree, program.kinematics
    parts: dict[int, FilePrinters] = {
        ABSOLUTE: {
            "parameters.c": lambda: _print_parameters_file(program),
            "constraints.c": lambda: _print_constraints_file(program),
            "dynamics.c": lambda: _print_kernels(*program.right_hand_side_kernels),
        }
    }
    if tree:
        parts[REDUCED] = {"reduced.c": lambda: print_reduced_file(program.model, tree, render_template, _print_kernels)}
    if kinematics:
        parts[METHODS] = {"positions.c": lambda: _print_kernels(*kinematics.kernels)}
    elif program.methods:
        parts[METHODS] = {"newton.c": lambda: _print_newton_file(program)}
    if program.methods and program.has_complex_stages:
        parts[METHODS]["newton_complex.c"] = partial(_print_kernels, *program.methods.complex_kernels)
    if _has_bounds(program, bounds):
        parts[METHODS]["watched.c"] = lambda: _print_bounds_file(program, bounds)
    return parts


def _print_files(printers: FilePrinters) -> dict[str, str]:
    """Return {file: text}: each file is printed by its function, and long lines are wrapped."""
    return {name: wrap_file(text()) for name, text in printers.items()}


def _print_main_file(files_of_parts: Mapping[int, Iterable[str]], shared_files: Iterable[str]) -> str:
    """Return the text of scene.c, which includes the files of all parts, each part within an #if on PART.

    shared_files: files that all parts except METHODS include.
    """
    headers = (HEADER, "engine/scene/kernels.h", "engine/scene/trigonometry.h")
    lines = ["/* All files together, or with -DPART=1, 2, 3 those of one part: parts are compiled in parallel. */"]
    lines += [*map(_print_include, headers), *_print_conditional_includes(f"PART != {METHODS}", shared_files)]
    for number, names in files_of_parts.items():
        lines += _print_conditional_includes(f"!PART || PART == {number}", names)
    return "\n".join([*lines, _print_include("engine/scene/scene.c"), ""])


def _print_conditional_includes(condition: str, names: Iterable[str]) -> list[str]:
    """Return the lines of an #if that includes files; [] without files."""
    lines = [_print_include(name) for name in names]
    return [f"#if {condition}", *lines, "#endif"] if lines else []


def _print_include(name: str) -> str:
    """Return an #include line."""
    return f'#include "{name}"'


def _print_parameters_file(program: Program) -> str:
    """Return the text of parameters.c: `prepare`, and with play the functions that return a parameter of joint i."""
    functions_of_joints = (
        render_template("of_joints.c.jinja", of_joints=list_joint_parameters(program.model)) if program.joints else ""
    )
    return _print_kernels(program.prepare) + functions_of_joints


def _print_constraints_file(program: Program) -> str:
    """Return the text of constraints.c: the functions of all constraint equations of the closed linkage.

    A scene that is integrated also has `has_equal_start_parameters`.
    """
    at_start = (kernel for kernel in program.closed_linkage if kernel.name not in NOT_AT_START)
    return _print_kernels(*program.closed_linkage) + (
        print_start_parameter_comparison(at_start) if program.integrates else ""
    )


def _print_newton_file(program: Program) -> str:
    """Return the text of newton.c: linearized equations, Newton's matrix and the projection onto the constraints.

    "" for a scene without implicit methods.
    """
    methods = program.methods
    if methods is None:
        return ""
    slopes = print_tangent_functions(program.joints, methods, render_template, program.model.law_states)
    return (
        slopes
        + print_newton_functions(methods.newton, render_template)
        + functions.print_kernel(methods.correction_kernel)
    )


def _has_bounds(program: Program, bounds: Kernel | None) -> bool:
    """Return whether bounds over a step are known for any event function or any term that depends on time only."""
    return bool(program.time_terms.kernel or bounds)


def _print_bounds_file(program: Program, bounds: Kernel | None) -> str:
    """Return the text of watched.c: bounds of time terms and event functions over ranges of time and state.

    Either kernel may be missing (None); its text is then left out.
    """
    return "\n".join(
        ranges_printer.print_interval_kernel(kernel) for kernel in (program.time_terms.kernel, bounds) if kernel
    )


def render_template(name: str, /, **values: Any) -> str:
    """Return the text of the template `name` with `values` substituted, and a final line break.

    Raises jinja2.UndefinedError if the template uses a name that is not in `values`.
    """
    return _get_template_environment().get_template(name).render(**values) + "\n"


@cache
def _get_template_environment() -> jinja2.Environment:
    """Return the Jinja environment of all C templates; it is created at the first call and cached.

    Without the cache, reading the templates takes half of the time of a small scene.
    """

    def load_template(name: str) -> str:
        """Return the text of a template from the package folder templates/c."""
        return resources.files("gudgeon.templates").joinpath("c", name).read_text(encoding="utf-8")

    return jinja2.Environment(
        loader=jinja2.FunctionLoader(load_template),
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        trim_blocks=True,
    )


def _print_kernels(*kernels: Kernel) -> str:
    """Return the C functions of several kernels, one after another."""
    return "\n".join(map(functions.print_kernel, kernels))


def _list_kernels(program: Program) -> list[Kernel]:
    """Return all kernels of a program: both formulations, the closed linkage, `prepare`, methods, then laws.

    The kernels of methods are those of Newton's method for implicit integrators, or of the kinematic analysis.
    """
    tree, method_kernels = program.tree, program.methods or program.kinematics
    kernels = [
        *program.right_hand_side_kernels,
        *program.closed_linkage,
        *(tree.all_kernels if tree else ()),
        program.prepare,
    ]
    return [*kernels, *(method_kernels.kernels if method_kernels else ()), *program.laws]


def _count_function_operations(program: Program) -> dict[str, int]:
    """Return {C function: number of arithmetic operations}, which `gudgeon check -v` prints.

    A law is listed once for each joint that calls it, as ROLE_JOINT_force, for example "normal_A_force".
    """
    calls = [(joint.clearance.name, *call) for joint in program.joints for call in joint.laws.items()]
    laws = {f"{role}_{joint_name}_force": call.kernel for joint_name, role, call in calls}
    counted = {kernel.name: kernel for kernel in _list_kernels(program) if kernel not in program.laws}
    return {name: kernel.n_operations for name, kernel in (counted | laws).items()}


def print_start_parameter_comparison(kernels: Iterable[Kernel]) -> str:
    """Return the C function `has_equal_start_parameters`: whether a run can reuse the start of another run.

    It compares the members of Parameters that the `kernels` read, above MAX_INLINE_COMPARISONS in a loop. It always
    returns 0 if the kernels read tables or pass on the whole struct, and always 1 if they read no parameter.
    """
    lines = [line for kernel in kernels for section in kernel.sections for line in section.statements]
    parameters_read = [name for line in lines for name in _list_parameters_read(line)]
    members = [*dict.fromkeys(parameters_read)]
    is_comparable = all(name.isidentifier() for name in members)
    if not (is_comparable and members):
        function_body = f"    (void)p, (void)other;\n    return {int(is_comparable)};\n"
    elif len(members) <= MAX_INLINE_COMPARISONS:
        tests = "\n        && ".join(f"is_same_number(p->{name}, other->{name})" for name in members)
        function_body = f"    return {tests};\n"
    else:
        indices = "\n".join(f"        {PARAMETER_INDEX}({name})," for name in members)
        function_body = (
            f"    static const int indices[] = {{\n{indices}\n    }};\n"
            "    for (size_t i = 0; i < sizeof indices / sizeof *indices; i++)\n"
            "        if (!is_same_number(((const double *)p)[indices[i]], ((const double *)other)[indices[i]]))\n"
            "            return 0;\n"
            "    return 1;\n"
        )
    return (
        "\n/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */\n"
        f"int has_equal_start_parameters(const Parameters *p, const Parameters *other)\n{{\n{function_body}}}\n"
    )


def _list_parameters_read(line: Instruction) -> list[str]:
    """Return the members of the struct Parameters that a line of a kernel copies to locals.

    [] is returned for a line that reads none, [WHOLE_STRUCT] for a line that reads or passes the struct otherwise. Used
    to compare only those members that the start of a run depends on; with WHOLE_STRUCT no comparison is possible.
    """
    if isinstance(line, Statement) and isinstance(line.value, StorageLocation) and line.value.is_parameter:
        return [line.value.member]
    return [WHOLE_STRUCT] if PARAMETERS in line.reads else []


Render = Callable[..., str]  # of a template by name and substitutions, or of kernels


def print_reduced_file(model: Model, tree: TreeFunctions, render: Render, print_kernels: Render) -> str:
    """Return the text of reduced.c, the equations of motion in coordinates of the spanning tree.

    The text contains the conversion from and to all coordinates and the kernels. Code for vanishing pivots and for
    driven loops follows if the tree has them. render, print_kernels: print a template and several kernels.
    """
    texts = [functions.print_comment(describe_reduced_file(tree.system))]
    texts += [print_kernels(*tree.conversions), print_kernels(*tree.kernels)]
    if tree.has_fallback:
        texts.append(render("multipliers.c.jinja", multipliers=_print_closure_multipliers(model, tree.system)))
    if loop_kernels := tree.driven_loop_kernels:
        texts.append(
            render(
                "driven_loops.c.jinja",
                kernels=print_kernels(*loop_kernels.kernels),
                step_scales=_print_step_scales(loop_kernels),
                rotations=_list_direction_rotations(loop_kernels),
            )
        )
    return "\n".join(texts)


def _print_step_scales(loop_kernels: DrivenLoopKernels) -> list[str]:
    """Return the C factors that make Newton's step of each dependent coordinate of the driven loops dimensionless.

    Driven loops are closed loops whose coordinates the drives determine. The factor is "1.0" for an angle and the
    inverse of the linkage's size for a sliding distance; "1.0" for all if the linkage has no size.
    """
    # without a size all points are one
    inverse_size = f"1.0 / (p->{loop_kernels.size} + DBL_MIN)" if loop_kernels.size.is_Symbol else "1.0"
    return ["1.0" if "." not in name else inverse_size for name in loop_kernels.loops.names]


def _list_direction_rotations(loop_kernels: DrivenLoopKernels) -> list[tuple[int, str]]:
    """Return (index in q, C expression of the angle) of each direction that a step of the driven loops turns.

    Each direction has two entries in q, cosine and sine; the index is that of the cosine.
    """

    def print_factor(coefficient: sp.Expr) -> str:
        """Return a coefficient as the factor in front of a step in C: "" for 1, a number, or ± a parameter."""
        if coefficient == 1:
            return ""
        return (
            f"{float(coefficient)!r} * "
            if coefficient.is_Number
            else f"-p->{-coefficient} * "
            if (-coefficient).is_Symbol
            else f"p->{coefficient} * "
        )

    first_direction = loop_kernels.first + len(loop_kernels.loops.names)
    return [
        (first_direction + 2 * k, " + ".join(f"{print_factor(c)}step[{j}]" for j, c in d.angle_coefficients.items()))
        for k, d in enumerate(loop_kernels.loops.directions)
        if d.angle_coefficients
    ]


def _print_closure_multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Return one C expression per loop closure, its multiplier: a signed sum of entries of `lambda`.

    `lambda` are the multipliers of the full formulation. The expressions, such as "+ lambda[3] - lambda[5]", have
    neither an assignment nor a semicolon.
    """
    row_index = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} lambda[{row_index[name]}]" for name, sign in sign_by_row.items())
        for sign_by_row in (system.tree.find_multiplier_terms(row.name) for row in system.rows)
    ]
