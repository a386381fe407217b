"""Writes newton.c: Jacobian of the equations of motion for implicit methods, with the tangents of contact forces."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence

from gudgeon.generator.equations.contact_steps import beta_i
from gudgeon.generator.equations.play import Clearance, Contour
from gudgeon.generator.kernels.play import JointFunctions
from gudgeon.generator.kernels.program import IntegratorFunctions
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.solvers.contact_derivatives import CONTOUR_INPUTS, read_parameters_from_struct
from gudgeon.generator.solvers.newton import Newton
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.play import CLOSED, CONTOURS
from gudgeon.generator.targets.c.printer import print_expression

Render = Callable[..., str]  # template name, substitutions -> text

STATE = ("e", "deltadot", "de_t", "omega_i", "omega_j", "contact")
_BLENDING = """
/* Replace force and derivatives in F by the blend share F + (1 - share) film. share: fraction, its derivative by e. */
static inline void blend_slopes({type} *F, const {type} *film, const {number} *share)
{
    for (int i = 0; i < 4; i++) {
        const {number} more = F->value[i] - film->value[i];
        F->value[i] = film->value[i] + share[0] * more;
        for (int k = 0; k < 5; k++)
            F->slope[i][k] = film->slope[i][k] + share[0] * (F->slope[i][k] - film->slope[i][k]);
        F->slope[i][0] += share[1] * more;
    }
}"""


def print_newton_functions(newton: Newton, render: Render) -> str:
    """Return the C of the linearized system: kernels that linearize, factorize, substitute and solve; index tables.

    A table lists row, column, index in the stored values and sign of each entry of the linearization.
    """
    kernels = [newton.linearize_kernel, newton.factor_kernel, newton.substitute_kernel, newton.solve_kernel]
    counts = [(f"n_{name}".upper(), len(entries)) for name, entries in newton.tables.items()]
    return render(
        "newton.c.jinja",
        kernels="\n".join(map(functions.print_kernel, kernels)),
        tables=[(name, _print_table_rows(entries)) for name, entries in newton.tables.items()],
        counts=[*counts, ("N_LINEAR_UNKNOWNS", newton.nodes)],
    )


def print_tangent_functions(
    joints: Sequence[JointFunctions], methods: IntegratorFunctions, render: Render, n_states: int
) -> str:
    """Return the C function `tangent_<joint>_` of every joint with play, after the shared derivatives of laws.

    It computes the derivatives of a joint's force by position and velocity. Contours and walls of guides have their own
    templates. n_states: internal states of laws of each joint. "" is returned without play.
    """
    if not joints:
        return ""
    contours = any(joint.clearance.contour for joint in joints)
    dimensions = {"rows": 4 + n_states, "columns": 5 + n_states}
    texts = [CONTOURS * contours + print_shared_force_derivatives(joints, render, "double", "PinSlopes", n_states)]
    texts += [render("play/contour_derivatives.c.jinja")] * contours
    texts += map(functions.print_kernel, methods.derivative_kernels)
    for clearance in (joint.clearance for joint in joints):
        if clearance.contour:
            texts.append(
                _print_contour_tangent(
                    clearance, clearance.contour, methods.derivative_calls[clearance.name]["dry"], render
                )
            )
            continue
        clearance_parameter = f"p->{clearance.pair.c}"
        code = _print_derivative_selection(clearance, clearance_parameter, methods.derivative_calls[clearance.name])
        if clearance.wall:
            rise = print_expression(read_parameters_from_struct(methods.newton.system.model, clearance.wall.rise))
            texts.append(
                render(
                    "play/wall_tangent.c.jinja",
                    joint=clearance.label,
                    c=clearance_parameter,
                    rise=rise,
                    slopes=code,
                    **dimensions,
                )
            )
            continue
        texts.append(
            render("play/tangent.c.jinja", joint=clearance.label, c=clearance_parameter, slopes=code, **dimensions)
        )
    return "\n".join(texts)


def _print_contour_tangent(
    clearance: Clearance, contour: Contour, dry_derivatives_call: SharedFunctionCall, render: Render
) -> str:
    """Return the C function with the derivatives of the force of a bearing with a contour, which has dry contact only.

    dry_derivatives_call: the call of the derivatives of the dry contact. render: prints a template.
    """
    arguments = [symbol.name for symbol in CONTOUR_INPUTS]
    return render(
        "play/contour_tangent.c.jinja",
        joint=clearance.label,
        c=f"p->{clearance.pair.c}",
        depth_derivatives=[print_expression(contour.compute_depth(beta_i, order)) for order in range(3)],
        is_g_unused="g" in functions.find_unused_branch_arguments([dry_derivatives_call]),
        call=functions.print_shared_call(dry_derivatives_call, (*arguments, "contact"), ("&F",)),
    )


def print_shared_force_derivatives(
    joints: Sequence[JointFunctions], render: Render, number_type: str, derivatives_type: str, n_states: int
) -> str:
    """Return the C functions that turn derivatives of contact forces to ground axes and blend film with dry contact.

    Blending and walls of guides are included if a joint needs them.

    number_type, derivatives_type: the C types of a value and of a set of derivatives, for single runs or lanes.
    n_states: internal states of laws of each joint.
    """
    blend_function = (
        _BLENDING.replace("{number}", number_type)
        .replace("{type}", derivatives_type)
        .replace("k < 5", f"k < {5 + n_states}")
    )
    blending = blend_function if any(joint.has_transition for joint in joints) else ""
    substitutions = {"number": number_type, "type": derivatives_type, "rows": 4 + n_states, "columns": 5 + n_states}
    wall_derivatives = (
        render("play/wall_derivatives.c.jinja", **substitutions)
        if any(joint.clearance.wall for joint in joints)
        else ""
    )
    return render("play/pin_derivatives.c.jinja", blending=blending, **substitutions) + wall_derivatives


def _print_derivative_selection(
    clearance: Clearance, clearance_parameter: str, calls: Mapping[str, SharedFunctionCall]
) -> str:
    """Return the C code that selects the derivatives of dry contact, film or their blend, as in the joint's force.

    A film alone is always evaluated. Without a film, an open contact gives zeros; with both, an open contact has those
    of the film, a closed one the blend. `clearance_parameter`: the C expression of the clearance. `calls`: the
    functions of the derivatives by part, "dry", "film" and "share" (the fraction of the dry contact).
    """

    def print_call(part_name: str, result: str, *arguments: str) -> str:
        """Return the C call of the derivatives of one part; without `arguments`, it passes the motion (STATE)."""
        return functions.print_shared_call(calls[part_name], arguments or STATE, (result,))

    unused_arguments = functions.find_unused_branch_arguments(calls.values())
    if clearance.normal is None:
        lines = [*(f"(void){name};" for name in unused_arguments), print_call("film", "out")]
        return "\n".join(f"    {line}" for line in lines)
    lines = [*["(void)g;"] * ("g" in unused_arguments), f"const double delta = e - {clearance_parameter};"]
    if clearance.film is None:
        lines += ["*out = (PinSlopes){0};", f"if ({CLOSED})", f"    {print_call('dry', 'out')}"]
    else:
        lines += [f"if (!({CLOSED})) {{", f"    {print_call('film', 'out')}", "    return;", "}"]
        lines += [print_call("dry", "out"), "double share[2];", print_call("share", "share", "delta")]
        lines += ["if (share[0] < 1.0) {", "    PinSlopes film;", f"    {print_call('film', '&film')}"]
        lines += ["    blend_slopes(out, &film, share);", "}"]
    return textwrap.indent("\n".join(lines), "    ")


def _print_table_rows(entries: list[tuple[int, int, int, int]]) -> str:
    """Return the rows of an index table as wrapped lines of C; an empty table gets one unused row of zeros.

    entries: (row, column, index in the stored values, sign) of each entry.
    """
    row_texts = [f"{{{', '.join(map(str, entry))}}}" for entry in entries] or ["{0, 0, 0, 0}"]
    joined = " ".join(f"{row},".replace(" ", "\0") for row in row_texts).removesuffix(",")  # no break within a row
    return textwrap.fill(joined, 110, initial_indent="    ", subsequent_indent="    ").replace("\0", " ")
