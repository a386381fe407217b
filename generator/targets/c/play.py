"""Writes the C of joints with play: selects the templates and their substitutions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.kernels.play import Pin, law_doc
from gudgeon.generator.kernels.program import Program
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.printer import broken, expression

Render = Callable[..., str]  # template name, substitutions -> text

_ARGUMENTS = (
    "double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,%s\n"
    "    const ContactState *contact, const Parameters *p, const double *branch, double *g, Clearance *out"
)
_OF_CONTOUR = ("e", "steep", "worn_slope")  # further arguments of the dry contact of a contour
CONTOURS = '#include "engine/scene/contour.h"\n\n'
_STORE = """\
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = %s, .ey = %s, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i%s, .moment_second = F.M_j, .delta = delta, .power = 0.0%s};"""
_JOURNAL = ("e_x", "e_y", "")
_AT_WALL = ("e * n_x", "e * n_y", " + along * F.n")  # of a slider's corner: along its wall's normal
_RATIO = "contact->closed ? deltadot / contact->deltadot_minus : 1.0"
_IN_BLOW = "if (contact->smooth)\n        F_along_t_dry = contact->along; /* a blow asks what it does */"
CLOSED = "branch ? contact->closed : delta > 0.0"
_BLENDED = "        F.{0} += (1.0 - share) * (film.{0} - F.{0});"  # in play/clearance_transition.c.jinja


Stores = list[tuple[str, Line | str]]


@dataclass(frozen=True)
class PinFunction:
    """Represent a function of a joint with play and its stores in order: text with the line, or a local's name."""

    name: str
    text: str
    stores: Stores


def clearances_code(program: Program, render: Render) -> str:
    """Return the force laws, then the functions of each joint with play."""
    states = program.model.law_states
    pins = (clearance_code(pin, render, states) for pin in program.pins)
    head = CONTOURS * any(pin.clearance.contour is not None for pin in program.pins)
    return head + "\n".join([*map(functions.kernel, program.laws), *pins])


def clearance_code(pin: Pin, render: Render, states: int) -> str:
    """Return the functions of one joint with play; each joint has `states` inner states of laws."""
    return "\n".join(part.text for part in pin_functions(pin, render, states))


def function_name(part: str, joint: str) -> str:
    """Return the C name of a joint's function, as the templates in play/ write it; part: clearance, dry or film."""
    return f"{part}_{joint}_"


def pin_functions(pin: Pin, render: Render, states: int) -> Iterator[PinFunction]:
    """Yield the functions of a joint: dry contact and film, if it has them, then the choice between them."""
    joint, clearance = pin.clearance.label, pin.clearance
    if clearance.normal is not None:
        yield _dry_function(pin, render, states)
    if clearance.film is not None:
        yield _film_function(pin, render, states)
    text = render(
        _template(pin),
        joint=joint,
        kind=clearance.kind,
        arguments=_ARGUMENTS % _further_parameters(clearance),
        further="".join(f", {name}" for name in _further_arguments(pin)),
        gap=_statements_code(pin.gap),
        share=_statements_code(pin.share),
        rigid=clearance.rigid,
        closed="contact->closed" if clearance.rigid else CLOSED,
        store=_store_code(clearance, states),
        message=_transition_comment(clearance),
        law=_mixed_law_comment(clearance),
        first=pin.corners.start,
        last=pin.corners.stop,
    )
    stores: Stores = [*functions.one_by_one(pin.gap), *functions.one_by_one(pin.share)]
    stores += [(_BLENDED.format(one), f"F.{one}") for one in ("n", "t", "M_i", "M_j") if pin.has_transition]
    yield PinFunction(function_name("clearance", joint), text, stores)


def _further_parameters(clearance: Clearance) -> str:
    """Return the declarations of a joint's further arguments (Clearance.also)."""
    if clearance.wall:
        return " double n_x, double n_y,"
    return " double theta_i," * bool(clearance.contour)


def _transition_comment(clearance: Clearance) -> str:
    """Return the comment about film and dry contact acting together."""
    if clearance.mixed is None:
        return (
            "film for e < c, dry contact for e > c + e_0, a linear blend between them\n"
            " * (the paper's Eq. 17); a step holds what it began with."
        )
    return (
        "film for e < c; beyond, the dry contact has the share that the law above says;\n"
        " * a step holds what it began with."
    )


def _mixed_law_comment(clearance: Clearance) -> str:
    """Return the comment on a law of mixed lubrication, which has no function of its own; "" if there is none."""
    return functions.comment(law_doc(clearance.mixed)) if clearance.mixed else ""


def _dry_function(pin: Pin, render: Render, states: int) -> PinFunction:
    """Return the function of a joint's dry contact."""
    joint, clearance = pin.clearance.label, pin.clearance
    ratio = "unclipped" if clearance.clip_ratio else "ratio"
    calls = _calls_of_dry(pin, "max_of(delta, 0.0)", "double")
    steps: dict[str, Any] = {"before": _statements_code(pin.before_dry), "after": _statements_code(pin.after_dry)}
    steps["along"] = "-F_N" if clearance.contour else "-F_n"
    steps["further"] = "".join(f", double {name}" for name in _further_arguments(pin))
    laws = [pin.laws[role] for role in ("normal", "friction") if role in pin.laws]
    steps["unread"] = functions.unread_branches(laws, (*pin.before_dry, *pin.after_dry))
    steps |= {"law": _join_code(calls), "rates": braced("rate", clearance, states)}
    text = render("play/dry.c.jinja", joint=joint, kind=clearance.kind, ratio=_RATIO, ratio_name=ratio, **steps)
    own: Stores = [(f"    const double {ratio} = {_RATIO};", ratio), *functions.one_by_one(pin.before_dry)]
    own += [*((code, local) for code, local in calls if local), *functions.one_by_one(pin.after_dry)]
    return PinFunction(function_name("dry", joint), text, own)


def _further_arguments(pin: Pin) -> tuple[str, ...]:
    """Return the names of further arguments of the dry contact."""
    return _OF_CONTOUR if pin.clearance.contour else ()


def _film_function(pin: Pin, render: Render, states: int) -> PinFunction:
    """Return the function of a joint's film."""
    calls, joint = _calls_of_film(pin, "double"), pin.clearance.label
    steps: dict[str, Any] = {
        "before": _statements_code(pin.before_film),
        "after": _statements_code(pin.after_film),
        "law": _join_code(calls),
    }
    steps["unread"] = functions.unread_branches([pin.laws["film"]], (*pin.before_film, *pin.after_film))
    text = render("play/film.c.jinja", joint=joint, rates=braced("", pin.clearance, states), **steps)
    own: Stores = [*functions.one_by_one(pin.before_film), *((code, local) for code, local in calls if local)]
    return PinFunction(function_name("film", joint), text, [*own, *functions.one_by_one(pin.after_film)])


def _store_code(clearance: Clearance, states: int) -> str:
    """Return the code that stores a joint's force, motion and torques."""
    rates = braced("F.state_rate", clearance, states)
    own = _AT_WALL if clearance.wall else _JOURNAL
    more = f", .state_rate = {rates}" if rates else ""
    more += ",\n        .from_x = e_x, .from_y = e_y" * bool(clearance.wall)
    return _STORE % (*own, more + ", .at_wall = 1" * bool(clearance.wall and clearance.rigid))


def braced(array: str, clearance: Clearance, states: int, none: str = "0.0") -> str:
    """Return the rates of a joint's inner states as an initializer; "" if no law has states.

    `none` stands for the states that this joint does not have."""
    own = len(clearance.states) if array else 0
    rates = [f"{array}[{k}]" if k < own else none for k in range(states)]
    return f"{{{', '.join(rates)}}}" if rates else ""


def calls_of_dry(pin: Pin, delta: str, number: str) -> str:
    """Return the code for normal force and friction; `delta` is the penetration that the normal law gets."""
    return _join_code(_calls_of_dry(pin, delta, number))


def _calls_of_dry(pin: Pin, delta: str, number: str) -> list[tuple[str, str]]:
    """Return (code, local that it sets or "") of normal force and friction."""
    given: Sequence[str] = [delta, "ratio", *map(expression, pin.given)]
    normal = functions.shared_call(pin.laws["normal"], given, ("&F_n",))
    found = [(f"{number} F_n;", ""), (normal, "F_n")]
    pressed = "F_N" if pin.pressing else "F_n"
    pressing = zip(functions.one_by_one(pin.pressing), pin.pressing, strict=True)
    found += [(code.strip(), step.defines) for (code, _), step in pressing]
    if "friction" in pin.laws:
        states = range(len(pin.clearance.states))
        given, message = [f"contact->state[{k}]" for k in states], [f"&rate[{k}]" for k in states]
        results = ("&F_along_t_dry", *message)
        friction = functions.shared_call(pin.laws["friction"], (pressed, "v_t", *given), results)
        found.append((f"{number} F_along_t_dry{f', rate[{len(states)}]' if states else ''};", ""))
        found.append((friction, "F_along_t_dry"))
        if pin.clearance.rigid:
            found.append((_IN_BLOW, ""))
    else:
        zero = "0.0" if number == "double" else "all_of(0.0)"
        found.append((f"const {number} F_along_t_dry = {zero}; /* no friction */", "F_along_t_dry"))
    return [(_break_code(code), local) for code, local in found]


def call_of_film(pin: Pin, number: str) -> str:
    """Return the code for the film's forces and shear torque."""
    return _join_code(_calls_of_film(pin, number))


def _calls_of_film(pin: Pin, number: str) -> list[tuple[str, str]]:
    """Return (code, local that it sets or "") of the film's forces."""
    results = ("&F_r", "&F_along_t_film", "&T0")
    call = functions.shared_call(pin.laws["film"], ("epsilon", "w_n", "w_t"), results)
    unread = "(void)T0; /* read only with shear */"
    found = [(f"{number} F_r, F_along_t_film, T0;", ""), (call, "F_r"), (unread, "")]
    return [(_break_code(code), local) for code, local in found]


def _join_code(found: Sequence[tuple[str, str]]) -> str:
    """Return the code of calls, one a line."""
    return "\n".join(code for code, _ in found)


def _break_code(code: str) -> str:
    """Return a line of code, broken if it is too long."""
    return "\n".join(broken(f"    {code}"))


def _statements_code(statements: Sequence[Statement]) -> str:
    """Return statements as C."""
    return functions.statements(statements)


def _template(pin: Pin) -> str:
    """Return the template for a joint's laws: dry, film, or both."""
    if pin.clearance.film is None:
        return "play/clearance_dry.c.jinja"
    return "play/clearance_transition.c.jinja" if pin.has_transition else "play/clearance_film.c.jinja"
