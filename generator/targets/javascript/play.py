"""Emits the force functions of joints with play as JavaScript, like clearance.c; each returns its values in `stored`.

Branches are not frozen: a contact acts if δ > 0, as in the functions of C that evaluate a sample.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.readable import Readable, make_readable_statements
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.play import JointFunctions
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.targets.javascript.printer import JavaScriptPrinter, LinePrinter, list_results

MOTION = (contact.e_x, contact.e_y, contact.de_x, contact.de_y, contact.omega_i, contact.omega_j)
BLENDED = ("n", "t", "M_i", "M_j")  # members of a force that are blended from film and dry contact
_ZERO_FORCE = "{n: 0, t: 0, M_i: 0, M_j: 0}"
_DRY = ("delta", "deltadot", "de_t", "omega_i", "omega_j", "contact", "p", "stored")
_OF_CONTOUR = ("e", "steep", "worn_slope")
_FILM = ("e", "deltadot", "de_t", "omega_i", "omega_j", "p", "stored")


def print_joint_methods(joint: JointFunctions, members_read: set[str]) -> list[str]:
    """Return the JavaScript methods `dry_A_`, `film_A_` (if joint A has dry contact or film) and `clearance_A_`.

    The methods store their locals in the argument `stored` by the function's name, for example `stored.dry_A_.a_i`. The
    force in ground axes is `stored.force`. `members_read` is a set to which the members of p that are read are added.
    """
    label, methods = joint.clearance.label, []
    if joint.clearance.normal is not None:
        methods.append(
            _print_method(f"dry_{label}_", _list_dry_arguments(joint), _print_dry_contact_body(joint, members_read))
        )
    if joint.clearance.film is not None:
        methods.append(_print_method(f"film_{label}_", _FILM, _print_film_body(joint, members_read)))
    arguments = (*map(str, list_motion_symbols(joint.clearance)), "contact", "p", "stored")
    return [*methods, _print_method(f"clearance_{label}_", arguments, _print_joint_force_body(joint, members_read))]


def list_motion_symbols(clearance: Clearance) -> tuple[sp.Symbol, ...]:
    """Return the symbols of the relative motion that a joint's function gets as arguments.

    They are MOTION: eccentricity, its rate and both angular velocities. A corner at a wall also gets the components of
    the normal, a bearing with a contour the bearing's angle.
    """
    if clearance.wall:
        return (*MOTION, contact.n_x, contact.n_y)
    return (*MOTION, contact.theta_i) if clearance.contour else MOTION


def _list_dry_arguments(joint: JointFunctions) -> tuple[str, ...]:
    """Return the argument names of a joint's dry contact; those of a contour have three more."""
    return (*_DRY[:5], *_OF_CONTOUR, *_DRY[5:]) if joint.clearance.contour else _DRY


def _print_method(name: str, arguments: Iterable[str], body: Iterable[str]) -> str:
    """Return a JavaScript method with its arguments and the lines of its body."""
    return "\n".join([f"{name}({', '.join(arguments)}) {{", *(f"    {line}" for line in body), "}"])


def _print_dry_contact_body(joint: JointFunctions, members_read: set[str]) -> list[str]:
    """Return the body of `dry_<joint>_`: normal force, friction (0 without a law) and moments of the dry contact.

    The ratio δ̇/δ̇⁻ is 1 unless the contact is closed. `members_read` gets the members of p that are read.
    """
    ratio_name = "unclipped" if joint.clearance.clip_ratio else "ratio"
    before, after = (
        _PrintedStatements(joint.before_dry, members_read),
        _PrintedStatements(joint.after_dry, members_read),
    )
    body = [f"const {ratio_name} = contact.closed ? deltadot / contact.deltadot_minus : 1;", *before.text]
    body += _print_law_call(
        joint.laws["normal"],
        ("max_of(delta, 0)", "ratio", *map(str, joint.normal_law_argument_places)),
        ("F_n",),
        members_read,
    )
    contour_force = _PrintedStatements(joint.contour_normal_force, members_read)
    normal_force, body = "F_N" if joint.contour_normal_force else "F_n", [*body, *contour_force.text]
    if "friction" in joint.laws:
        states = (f"contact.state[{k}]" for k in range(len(joint.clearance.states)))
        body += _print_law_call(
            joint.laws["friction"], (normal_force, "v_t", *states), ("F_along_t_dry",), members_read
        )
    else:
        body.append("const F_along_t_dry = 0;")
    locals_ = [ratio_name, *before.locals, "F_n", *contour_force.locals, "F_along_t_dry", *after.locals]
    return [
        *body,
        *after.text,
        _print_store(f"dry_{joint.clearance.label}_", locals_),
        _print_force_return(f"-{normal_force}", "dry"),
    ]


def _print_film_body(joint: JointFunctions, members_read: set[str]) -> list[str]:
    """Return the body of `film_<joint>_`: the lubrication force by the film law, and its moments.

    `members_read` gets the members of p that are read.
    """
    before, after = (
        _PrintedStatements(joint.before_film, members_read),
        _PrintedStatements(joint.after_film, members_read),
    )
    forces = ("F_r", "F_along_t_film", "T0")
    body = [
        *before.text,
        *_print_law_call(joint.laws["film"], ("epsilon", "w_n", "w_t"), forces, members_read),
        *after.text,
    ]
    locals_ = [*before.locals, *forces, *after.locals]
    return [*body, _print_store(f"film_{joint.clearance.label}_", locals_), _print_force_return("F_r", "film")]


def _print_joint_force_body(joint: JointFunctions, members_read: set[str]) -> list[str]:
    """Return the body of `clearance_<joint>_`: the gap and its normal, then dry contact, film or their blend.

    Without a film, the force is dry if the contact is closed (rigid) or δ > 0, else 0. A joint with a film alone
    returns its force. With both, the film acts alone for δ ≤ 0, else the blend. `members_read` gets the members of p
    that are read.
    """
    label = joint.clearance.label
    gap, blend = _PrintedStatements(joint.gap, members_read), _PrintedStatements(joint.blend, members_read)
    parts = (("dry", _list_dry_arguments(joint)), ("film", _FILM))
    dry, film = (f"functions.{part}_{label}_({', '.join(call_arguments)})" for part, call_arguments in parts)
    body = [*gap.text, _print_store(f"clearance_{label}_", gap.locals)]
    if joint.clearance.film is None:
        condition = "contact.closed" if joint.clearance.rigid else "delta > 0"
        at_wall = "{...F, M_i: F.M_i + along * F.n}" if joint.clearance.wall else "F"
        return [*body, f"const F = {condition} ? {dry} : {_ZERO_FORCE};", _print_ground_force_return(at_wall)]
    if joint.clearance.normal is None:
        return [*body, _print_ground_force_return(film)]
    share_locals = ", ".join(blend.locals)
    blend_lines = (
        f'values["F.{component}"] = F.{component} += (1 - share) * (film.{component} - F.{component});'
        for component in BLENDED
    )
    return [
        *body,
        f"if (!(delta > 0)) {_print_ground_force_return(film)}",
        *blend.text,
        f"const F = {dry}, values = Object.assign(stored.clearance_{label}_, {{{share_locals}}});",
        "if (share < 1) {",
        f"    const film = {film};",
        *(f"    {line}" for line in blend_lines),
        "}",
        _print_ground_force_return("F"),
    ]


def _print_ground_force_return(force: str) -> str:
    """Return the JavaScript line that turns `force`, an expression in axes n and t, to ground axes and returns it."""
    return f"return in_ground_axes({force}, n_x, n_y, stored);"


class _PrintedStatements:
    """Contain the JavaScript lines of statements (`text`) and the names of the locals that they declare."""

    def __init__(self, statements: Sequence[Statement], members_read: set[str]) -> None:
        writer = LinePrinter(make_readable_statements(statements), members_read)
        self.text, self.locals = writer.print_lines(), writer.locals


def _print_law_call(
    call: SharedFunctionCall, arguments: Iterable[str], local_names: Sequence[str], members_read: set[str]
) -> list[str]:
    """Return the line that calls a law, stores its results in `stored` by its name, and assigns the first to locals.

    Example: "const {F_n_out: F_n} = stored.hertz = functions.hertz(...);". local_names: the locals for the first
    results. members_read: a set to which the members of p that are read are added.
    """
    function, parameters = (
        call.kernel.name,
        map(JavaScriptPrinter(Readable(()), members_read).get_name, call.parameters),
    )
    destructured = ", ".join(
        f"{result}: {name}" for result, name in zip(list_results(call.kernel), local_names, strict=False)
    )
    call_text = f"functions.{function}({', '.join([*arguments, *parameters])})"
    return [f"const {{{destructured}}} = stored.{function} = {call_text};"]


def _print_store(function: str, names: Iterable[str]) -> str:
    """Return the JavaScript line that stores locals in `stored` by a function's name, each name once."""
    return f"stored.{function} = {{{', '.join(dict.fromkeys(names))}}};"


def _print_force_return(normal_component: str, part: str) -> str:
    """Return the JavaScript line that returns a contact force and its moments on both bodies.

    The object has the normal and tangential components n and t, and the moments M_i and M_j. normal_component: the
    expression of n. part: "dry" or "film", the suffix of the variables that hold t and the moments.
    """
    return f"return {{n: {normal_component}, t: F_along_t_{part}, M_i: M_i_{part}, M_j: M_j_{part}}};"
