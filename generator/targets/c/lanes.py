"""Writes lanes.c: the functions of a scene, vectorized over runs (SIMD lanes), in tree (reduced) coordinates."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.kernels.play import JointFunctions
from gudgeon.generator.kernels.program import IntegratorFunctions, Program
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.solvers.contact_derivatives import read_parameters_from_struct
from gudgeon.generator.targets.c import functions, lanes_printer, taylor
from gudgeon.generator.targets.c.curves import print_curve_tables
from gudgeon.generator.targets.c.newton import STATE, print_shared_force_derivatives
from gudgeon.generator.targets.c.play import print_dry_calls, print_film_calls, print_state_rates

MAIN = "lanes.c"
_KERNELS = ("closures", "closure_rates", "reduced_dynamics", "compute_closure_step")
_SELECT_SLOPES = """
/* Replace the forces and derivatives in `a` by those in `b` in the lanes of a mask. */
static inline void select_slopes(LaneSlopes *a, LaneBits mask, const LaneSlopes *b)
{
    for (int i = 0; i < 4; i++) {
        a->value[i] = select_value(mask, b->value[i], a->value[i]);
        for (int k = 0; k < 5; k++)
            a->slope[i][k] = select_value(mask, b->slope[i][k], a->slope[i][k]);
    }
}
"""

Render = Callable[..., str]  # template name, substitutions -> text


def print_lanes_files(program: Program, render: Render) -> dict[str, str]:
    """Return {"lanes.c": text}: the kernels of single runs in the reduced formulation, printed for vectors of runs.

    The file has the linearized equations and Newton's matrix. With a Taylor series, a library compiled with LANE_SERIES
    has the series instead. The file includes curves.c if it calls a curve. The program must have a tree.
    """
    assert program.tree
    model = program.model
    parameters = [model.parameter_table.find_member_name(symbol) for symbol in model.parameter_table.list_symbols()]
    if program.kinematics:
        return {MAIN: _print_kinematic_file(program, render, parameters)}
    assert program.methods
    joint_functions = [
        *map(lanes_printer.print_lanes_kernel, program.laws),
        *(_print_joint_in_lanes(joint, render, model.law_states) for joint in program.joints),
    ]
    kernels = (*program.tree.unvectorized_kernels, program.methods.unvectorized_correction_kernel)
    kernels_in_lanes = [kernel for kernel in kernels if kernel.name in _KERNELS]
    text = "\n".join([*joint_functions, *map(lanes_printer.print_motion_kernel, kernels_in_lanes)])
    methods = _print_linearized_equations(program.joints, program.methods, render, model.law_states)
    series = taylor.print_taylor_lanes(program.series) if program.series else ""
    curves = bool(print_curve_tables(model.scene.mechanism.curves, (text, methods, series)))
    return {
        MAIN: render(
            "lanes.c.jinja",
            parameters=parameters,
            kernels=text,
            methods=methods,
            series=series,
            curves=curves,
            integrates=True,
            engine_includes=_print_engine_includes("batch/lane_tries.c", "batch/lane_flow.c"),
        )
    }


def _print_engine_includes(*files: str) -> str:
    """Return #include lines of files of the engine, given by their paths below engine/."""
    return "\n".join(f'#include "engine/{file}"' for file in files)


def _print_kinematic_file(program: Program, render: Render, parameters: Sequence[str]) -> str:
    """Return the text of lanes.c of a kinematically driven scene: Newton's step, motion of bodies, right-hand side.

    `parameters`: names of the fields of Parameters, of which LaneParameters has one vector each.
    """
    assert program.tree and program.kinematics
    motion = [kernel for kernel in program.tree.unvectorized_kernels if kernel.name == "reduced_dynamics"]
    kernels = [*motion, *program.kinematics.unvectorized_kernels]
    text = "\n".join(map(lanes_printer.print_motion_kernel, kernels))
    return render(
        "lanes.c.jinja",
        parameters=parameters,
        kernels=text,
        methods="",
        series="",
        curves=bool(print_curve_tables(program.model.scene.mechanism.curves, (text,))),
        integrates=False,
        engine_includes=_print_engine_includes("kinematic/lane_runs.c"),
    )


def _print_joint_in_lanes(joint: JointFunctions, render: Render, n_states: int) -> str:
    """Return the C functions of a joint with play for lanes: dry contact and film, if present, and the total force.

    They come from the template lane_pin.c.jinja. n_states: internal states of laws that each joint of the scene has.
    """
    clearance = joint.clearance
    step_names = ("gap", "before_dry", "after_dry", "before_film", "after_film", "blend")
    substitutions = {name: lanes_printer.print_statements(getattr(joint, name)) for name in step_names}
    if clearance.normal is not None:
        substitutions["dry_law"] = print_dry_calls(joint, "lanes_max_of(delta, broadcast(0.0))", "Lanes")
    if clearance.film is not None:
        substitutions["film_law"] = print_film_calls(joint, "Lanes")
    return render(
        "play/lane_pin.c.jinja",
        joint=clearance.label,
        kind=clearance.kind,
        dry=clearance.normal is not None,
        film=clearance.film is not None,
        ratio_name="unclipped" if clearance.clip_ratio else "ratio",
        rates=print_state_rates("rate", clearance, n_states, "broadcast(0.0)"),
        zero_rates=print_state_rates("", clearance, n_states, "broadcast(0.0)"),
        first=joint.switch_indices.start,
        last=joint.switch_indices.stop,
        states=n_states,
        wall=bool(clearance.wall),
        **substitutions,
    )


def _print_linearized_equations(
    joints: Sequence[JointFunctions], methods: IntegratorFunctions, render: Render, n_states: int
) -> str:
    """Return the linearized equations of motion and Newton's matrix for lanes, without the index tables of newton.c.

    Derivatives of the joints' forces come first, then the kernels for real and complex steps of implicit methods.
    n_states: internal states of laws that each joint has.
    """
    newton = methods.newton
    select_slopes = _SELECT_SLOPES.replace("i < 4", f"i < {4 + n_states}").replace("k < 5", f"k < {5 + n_states}")
    slopes = (
        [print_shared_force_derivatives(joints, render, "Lanes", "LaneSlopes", n_states) + select_slopes]
        if joints
        else []
    )
    slopes += map(lanes_printer.print_lanes_kernel, methods.derivative_kernels)
    for clearance in (joint.clearance for joint in joints):
        slopes.append(
            _print_force_derivatives_in_lanes(
                newton.system.model, clearance, methods.derivative_calls[clearance.name], render, n_states
            )
        )
    state_kernels = map(lanes_printer.print_kernel_with_fallback, (newton.linearize_kernel, newton.factor_kernel))
    factor, solve_kernels = methods.complex_kernels[:1], methods.complex_kernels[1:]
    complex_step_texts = [
        *map(lanes_printer.print_kernel_with_fallback, factor),
        *map(lanes_printer.print_lanes_kernel, solve_kernels),
    ]
    return "\n".join(
        [
            *slopes,
            *state_kernels,
            *map(lanes_printer.print_lanes_kernel, (newton.substitute_kernel, newton.solve_kernel)),
            *complex_step_texts,
        ]
    )


def _print_force_derivatives_in_lanes(
    model: Model,
    clearance: Clearance,
    derivative_calls: Mapping[str, SharedFunctionCall],
    render: Render,
    n_states: int,
) -> str:
    """Return the C function `tangent_<joint>_` for lanes: the derivatives of the force of a joint with play.

    The matrix has 4 + n_states rows (force, moments, state rates) and 5 + n_states columns (e, δ̇, ė_t, ω_i, ω_j,
    states).
    derivative_calls: the calls of the derivatives by part, "film", "dry" and "share" (the fraction of the dry
    contact). Parts that the joint does not have are missing. n_states: internal states of laws that each joint has.
    """
    arguments_and_result = {"film": (STATE, "out"), "dry": (STATE, "&dry"), "share": (("delta",), "share")}
    calls = {
        part: functions.print_shared_call(derivative_calls[part], arguments, (result,))
        if part in derivative_calls
        else ""
        for part, (arguments, result) in arguments_and_result.items()
    }
    calls |= {"joint": clearance.label, "kind": clearance.kind.capitalize(), "c": f"p->{clearance.pair.c}"}
    calls["rise"] = (
        lanes_printer.print_expression(read_parameters_from_struct(model, clearance.wall.rise))
        if clearance.wall
        else ""
    )
    return render(
        "play/lane_tangent.c.jinja", rows=4 + n_states, columns=5 + n_states, wall=bool(clearance.wall), **calls
    )
