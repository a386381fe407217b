"""Writes the C force functions of joints with play: dry contact, lubrication film and their blend, from templates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.kernels.play import JointFunctions, describe_law
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.printer import break_code, print_expression

Render = Callable[..., str]  # template name, substitutions -> text

_ARGUMENTS = (
    "double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,%s\n"
    "    const ContactState *contact, const Parameters *p, const double *branch, double *g, Clearance *out"
)
_CONTOUR_ARGUMENTS = ("e", "steep", "worn_slope")  # further arguments of the dry contact of a contour
CONTOURS = '#include "engine/scene/contour.h"\n\n'
_STORE = """\
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = %s, .ey = %s, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i%s, .moment_second = F.M_j, .delta = delta, .power = 0.0%s};"""
_JOURNAL = ("e_x", "e_y", "")
_AT_WALL = ("e * n_x", "e * n_y", " + along * F.n")  # of a slider's corner: along its wall's normal
_RATIO = "contact->closed ? deltadot / contact->deltadot_minus : 1.0"  # δ̇/δ̇⁻
_PRESCRIBED_FRICTION = (
    "if (contact->is_frictionless)\n"
    "        F_along_t_dry = contact->tangential_force; /* impacts prescribe the friction */"
)
CLOSED = "branch ? contact->closed : delta > 0.0"
_BLENDED = "        F.{0} += (1.0 - share) * (film.{0} - F.{0});"  # in play/clearance_transition.c.jinja


Stores = list[tuple[str, Instruction | str]]  # (C text, line of the kernel or name of the local that the text sets)


@dataclass(frozen=True)
class PrintedFunction:
    """Represent a C function of a joint with play: its name, its text, and its assignments in order (`stores`).

    The page of equations finds the lines of each assignment by `stores` (lines.py).
    """

    name: str
    text: str
    stores: Stores


def print_clearances_file(program: Program, render: Render) -> str:
    """Return the text of clearance.c: all force laws, then the functions of each joint with play."""
    n_states = program.model.law_states
    joint_functions = (print_functions_of_joint(joint, render, n_states) for joint in program.joints)
    include = CONTOURS * any(joint.clearance.contour is not None for joint in program.joints)
    return include + "\n".join([*map(functions.print_kernel, program.laws), *joint_functions])


def print_functions_of_joint(joint: JointFunctions, render: Render, n_states: int) -> str:
    """Return the C functions of one joint with play as one text: dry contact and film, if present, then total force.

    n_states: the number of internal states of laws that each joint of the scene has.
    """
    return "\n".join(part.text for part in make_printed_functions(joint, render, n_states))


def get_function_name(part: str, joint: str) -> str:
    """Return the C name of a joint's function, such as "dry_A_"; part: "clearance", "dry" or "film"."""
    return f"{part}_{joint}_"


def make_printed_functions(joint: JointFunctions, render: Render, n_states: int) -> Iterator[PrintedFunction]:
    """Yield the C functions of a joint: dry contact and film, if it has them, then the total force.

    render: prints a template of templates/c. n_states: the number of internal states of laws that each joint of the
    scene has.
    """
    label, clearance = joint.clearance.label, joint.clearance
    if clearance.normal is not None:
        yield _make_dry_function(joint, render, n_states)
    if clearance.film is not None:
        yield _make_film_function(joint, render, n_states)
    text = render(
        _select_template(joint),
        joint=label,
        kind=clearance.kind,
        arguments=_ARGUMENTS % _declare_surface_arguments(clearance),
        contour_arguments="".join(f", {name}" for name in _list_contour_arguments(joint)),
        gap=_print_statements(joint.gap),
        share=_print_statements(joint.blend),
        rigid=clearance.rigid,
        closed="contact->closed" if clearance.rigid else CLOSED,
        store=_print_result_store(clearance, n_states),
        message=_print_transition_comment(clearance),
        law=_print_mixed_law_comment(clearance),
        first=joint.switch_indices.start,
        last=joint.switch_indices.stop,
    )
    stores: Stores = [*functions.print_each_statement(joint.gap), *functions.print_each_statement(joint.blend)]
    stores += [
        (_BLENDED.format(component), f"F.{component}") for component in ("n", "t", "M_i", "M_j") if joint.has_transition
    ]
    yield PrintedFunction(get_function_name("clearance", label), text, stores)


def _declare_surface_arguments(clearance: Clearance) -> str:
    """Return the C declarations of the arguments that only some joints have: n_x, n_y at a wall, theta_i for a contour.

    "" is returned for other joints.
    """
    if clearance.wall:
        return " double n_x, double n_y,"
    return " double theta_i," * bool(clearance.contour)


def _print_transition_comment(clearance: Clearance) -> str:
    """Return the text of the C comment on the transition from film to dry contact: linear blend or mixed lubrication.

    Only the template of joints with film and dry contact uses it.
    """
    if clearance.mixed is None:
        return (
            "film for e < c, dry contact for e > c + e_0, a linear blend between them\n"
            " * (the paper's Eq. 17); frozen over a step."
        )
    return "film for e < c; beyond c, the dry contact has the fraction of the law above;\n * frozen over a step."


def _print_mixed_law_comment(clearance: Clearance) -> str:
    """Return the C comment on a joint's law of mixed lubrication; "" without one.

    This law is part of the joint's function, and has no function of its own that would carry the comment.
    """
    return functions.print_comment(describe_law(clearance.mixed)) if clearance.mixed else ""


def _make_dry_function(joint: JointFunctions, render: Render, n_states: int) -> PrintedFunction:
    """Return the C function `dry_<joint>_`, which computes normal force, friction and moments of the dry contact.

    It also returns the rates of the `n_states` internal states of laws. The joint must have a normal law. `render`
    prints a template.
    """
    label, clearance = joint.clearance.label, joint.clearance
    ratio_name = "unclipped" if clearance.clip_ratio else "ratio"
    calls = _list_dry_calls(joint, "max_of(delta, 0.0)", "double")
    substitutions: dict[str, Any] = {
        "before": _print_statements(joint.before_dry),
        "after": _print_statements(joint.after_dry),
    }
    substitutions["force_along_n"] = "-F_N" if clearance.contour else "-F_n"
    substitutions["contour_arguments"] = "".join(f", double {name}" for name in _list_contour_arguments(joint))
    laws = [joint.laws[role] for role in ("normal", "friction") if role in joint.laws]
    substitutions["unused_arguments"] = functions.find_unused_branch_arguments(
        laws, (*joint.before_dry, *joint.after_dry)
    )
    substitutions |= {"law": _join_calls(calls), "rates": print_state_rates("rate", clearance, n_states)}
    text = render(
        "play/dry.c.jinja", joint=label, kind=clearance.kind, ratio=_RATIO, ratio_name=ratio_name, **substitutions
    )
    stores: Stores = [
        (f"    const double {ratio_name} = {_RATIO};", ratio_name),
        *functions.print_each_statement(joint.before_dry),
    ]
    stores += [*((code, local) for code, local in calls if local), *functions.print_each_statement(joint.after_dry)]
    return PrintedFunction(get_function_name("dry", label), text, stores)


def _list_contour_arguments(joint: JointFunctions) -> tuple[str, ...]:
    """Return the names of the further arguments of the dry contact of a contour; () for other joints."""
    return _CONTOUR_ARGUMENTS if joint.clearance.contour else ()


def _make_film_function(joint: JointFunctions, render: Render, n_states: int) -> PrintedFunction:
    """Return the C function `film_<joint>_`, which computes the lubrication force of a joint and its moments.

    The function computes the inputs of the film law (eccentricity ratio, squeeze velocity) and calls it. It returns
    force along n and t, moments, zero slip, and zero rates of the `n_states` internal states. The joint must have a
    film. `render` prints a template.
    """
    calls, label = _list_film_calls(joint, "double"), joint.clearance.label
    substitutions: dict[str, Any] = {
        "before": _print_statements(joint.before_film),
        "after": _print_statements(joint.after_film),
        "law": _join_calls(calls),
    }
    substitutions["unused_arguments"] = functions.find_unused_branch_arguments(
        [joint.laws["film"]], (*joint.before_film, *joint.after_film)
    )
    text = render(
        "play/film.c.jinja", joint=label, rates=print_state_rates("", joint.clearance, n_states), **substitutions
    )
    stores: Stores = [
        *functions.print_each_statement(joint.before_film),
        *((code, local) for code, local in calls if local),
    ]
    return PrintedFunction(
        get_function_name("film", label), text, [*stores, *functions.print_each_statement(joint.after_film)]
    )


def _print_result_store(clearance: Clearance, n_states: int) -> str:
    """Return the C statement that stores a joint's force in ground axes, its motion and its moments in *out.

    Rates of internal states and the position at a guide's wall are added if the joint has them. The power is 0.
    """
    rates = print_state_rates("F.state_rate", clearance, n_states)
    position = _AT_WALL if clearance.wall else _JOURNAL
    other_members = f", .state_rate = {rates}" if rates else ""
    other_members += ",\n        .from_x = e_x, .from_y = e_y" * bool(clearance.wall)
    return _STORE % (*position, other_members + ", .at_wall = 1" * bool(clearance.wall and clearance.rigid))


def print_state_rates(array_name: str, clearance: Clearance, n_states: int, fill_value: str = "0.0") -> str:
    """Return the initializer in C of the `n_states` rates of a joint's internal states; "" if no law has states.

    Example: "{rate[0], 0.0}". array_name: the array with the joint's rates, "" for none. fill_value: the rate of states
    that the joint does not have.
    """
    count = len(clearance.states) if array_name else 0
    rates = [f"{array_name}[{k}]" if k < count else fill_value for k in range(n_states)]
    return f"{{{', '.join(rates)}}}" if rates else ""


def print_dry_calls(joint: JointFunctions, penetration: str, number_type: str) -> str:
    """Return the C lines that call the laws of normal force and friction of a dry contact, for lanes.

    penetration: the C expression of the penetration that the normal law gets. number_type: the C type of a number,
    "double" or "Lanes". Without a friction law, the friction force is 0.
    """
    return _join_calls(_list_dry_calls(joint, penetration, number_type))


def _list_dry_calls(joint: JointFunctions, penetration: str, number_type: str) -> list[tuple[str, str]]:
    """Return (C code, local that it sets or "") for each line that computes normal force and friction.

    Without a friction law, the friction force is 0. For rigid surfaces, a further line prescribes it while an impact is
    solved. The arguments are those of `print_dry_calls`.
    """
    arguments: Sequence[str] = [penetration, "ratio", *map(print_expression, joint.normal_law_argument_places)]
    normal = functions.print_shared_call(joint.laws["normal"], arguments, ("&F_n",))
    calls = [(f"{number_type} F_n;", ""), (normal, "F_n")]
    normal_force = "F_N" if joint.contour_normal_force else "F_n"
    normal_steps = zip(
        functions.print_each_statement(joint.contour_normal_force), joint.contour_normal_force, strict=True
    )
    calls += [(code.strip(), step.declared_local) for (code, _), step in normal_steps]
    if "friction" in joint.laws:
        states = range(len(joint.clearance.states))
        arguments, rates = [f"contact->state[{k}]" for k in states], [f"&rate[{k}]" for k in states]
        results = ("&F_along_t_dry", *rates)
        friction = functions.print_shared_call(joint.laws["friction"], (normal_force, "v_t", *arguments), results)
        calls.append((f"{number_type} F_along_t_dry{f', rate[{len(states)}]' if states else ''};", ""))
        calls.append((friction, "F_along_t_dry"))
        if joint.clearance.rigid:
            calls.append((_PRESCRIBED_FRICTION, ""))
    else:
        zero = "0.0" if number_type == "double" else "broadcast(0.0)"
        calls.append((f"const {number_type} F_along_t_dry = {zero}; /* no friction */", "F_along_t_dry"))
    return [(_break_line(code), local) for code, local in calls]


def print_film_calls(joint: JointFunctions, number_type: str) -> str:
    """Return the C lines that call the film law for radial force, tangential force and shear torque, for lanes.

    number_type: the C type of a number, "double" or "Lanes".
    """
    return _join_calls(_list_film_calls(joint, number_type))


def _list_film_calls(joint: JointFunctions, number_type: str) -> list[tuple[str, str]]:
    """Return (C code, local that it sets or "") for each line that calls the film law, as of `print_film_calls`."""
    results = ("&F_r", "&F_along_t_film", "&T0")
    call = functions.print_shared_call(joint.laws["film"], ("epsilon", "w_n", "w_t"), results)
    void_cast = "(void)T0; /* read only with shear */"
    calls = [(f"{number_type} F_r, F_along_t_film, T0;", ""), (call, "F_r"), (void_cast, "")]
    return [(_break_line(code), local) for code, local in calls]


def _join_calls(calls: Sequence[tuple[str, str]]) -> str:
    """Return the code of several calls, one per line."""
    return "\n".join(code for code, _ in calls)


def _break_line(code: str) -> str:
    """Return an indented line of C, broken into several lines if it is too long."""
    return "\n".join(break_code(f"    {code}"))


def _print_statements(statements: Sequence[Statement]) -> str:
    """Return statements as C."""
    return functions.print_statements(statements)


def _select_template(joint: JointFunctions) -> str:
    """Return the file name of the template for a joint's total force: dry contact, film, or their transition."""
    if joint.clearance.film is None:
        return "play/clearance_dry.c.jinja"
    return "play/clearance_transition.c.jinja" if joint.has_transition else "play/clearance_film.c.jinja"
