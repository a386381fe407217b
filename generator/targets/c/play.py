"""The C of one joint with play: which templates it needs and what is substituted in them."""

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
_OF_CONTOUR = ("e", "steep", "worn_slope")  # what its dry contact is given besides
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
    """A function of a joint with play, and what it stores to in its order: text with a line, or a local's name."""

    name: str
    text: str
    stores: Stores


def clearances_code(program: Program, render: Render) -> str:
    """The laws, then each joint's own functions; nothing where no joint has play."""
    states = program.model.law_states
    pins = (clearance_code(pin, render, states) for pin in program.pins)
    head = CONTOURS * any(pin.clearance.contour is not None for pin in program.pins)
    return head + "\n".join([*map(functions.kernel, program.laws), *pins])


def clearance_code(pin: Pin, render: Render, states: int) -> str:
    """What happens round the laws of a joint; `states` of laws are as many for each, as the engine has them."""
    return "\n".join(part.text for part in pin_functions(pin, render, states))


def function_name(part: str, joint: str) -> str:
    """Return the name of a joint's function in C, as the templates in play/ write it; part: clearance, dry or film."""
    return f"{part}_{joint}_"


def pin_functions(pin: Pin, render: Render, states: int) -> Iterator[PinFunction]:
    """Function by function: dry contact and film, as far as the joint has them, and what chooses between them."""
    joint, clearance = pin.clearance.label, pin.clearance
    if clearance.normal is not None:
        yield _dry(pin, render, states)
    if clearance.film is not None:
        yield _film(pin, render, states)
    text = render(
        _template(pin),
        joint=joint,
        kind=clearance.kind,
        arguments=_ARGUMENTS % _also(clearance),
        further="".join(f", {name}" for name in _further(pin)),
        gap=_lines(pin.gap),
        share=_lines(pin.share),
        rigid=clearance.rigid,
        closed="contact->closed" if clearance.rigid else CLOSED,
        store=_store(clearance, states),
        told=_shared_by(clearance),
        law=_law_of_share(clearance),
        first=pin.corners.start,
        last=pin.corners.stop,
    )
    stores: Stores = [*functions.one_by_one(pin.gap), *functions.one_by_one(pin.share)]
    stores += [(_BLENDED.format(one), f"F.{one}") for one in ("n", "t", "M_i", "M_j") if pin.has_transition]
    yield PinFunction(function_name("clearance", joint), text, stores)


def _also(clearance: Clearance) -> str:
    """Arguments of a joint's function for what it is given of the motion besides (Clearance.also)."""
    if clearance.wall:
        return " double n_x, double n_y,"
    return " double theta_i," * bool(clearance.contour)


def _shared_by(clearance: Clearance) -> str:
    """What a comment says of film and dry contact together."""
    if clearance.mixed is None:
        return (
            "film for e < c, dry contact for e > c + e_0, a linear blend between them\n"
            " * (the paper's Eq. 17); a step holds what it began with."
        )
    return (
        "film for e < c; beyond, the dry contact has the share that the law above says;\n"
        " * a step holds what it began with."
    )


def _law_of_share(clearance: Clearance) -> str:
    """The comment on a law of mixed lubrication, which is no function of its own; "" where there is none."""
    return functions.comment(law_doc(clearance.mixed)) if clearance.mixed else ""


def _dry(pin: Pin, render: Render, states: int) -> PinFunction:
    joint, clearance = pin.clearance.label, pin.clearance
    ratio = "unclipped" if clearance.clip_ratio else "ratio"
    calls = _calls_of_dry(pin, "max_of(delta, 0.0)", "double")
    steps: dict[str, Any] = {"before": _lines(pin.before_dry), "after": _lines(pin.after_dry)}
    steps["along"] = "-F_N" if clearance.contour else "-F_n"
    steps["further"] = "".join(f", double {name}" for name in _further(pin))
    laws = [pin.laws[role] for role in ("normal", "friction") if role in pin.laws]
    steps["unread"] = functions.unread_branches(laws, (*pin.before_dry, *pin.after_dry))
    steps |= {"law": _texts(calls), "rates": braced("rate", clearance, states)}
    text = render("play/dry.c.jinja", joint=joint, kind=clearance.kind, ratio=_RATIO, ratio_name=ratio, **steps)
    own: Stores = [(f"    const double {ratio} = {_RATIO};", ratio), *functions.one_by_one(pin.before_dry)]
    own += [*((code, local) for code, local in calls if local), *functions.one_by_one(pin.after_dry)]
    return PinFunction(function_name("dry", joint), text, own)


def _further(pin: Pin) -> tuple[str, ...]:
    return _OF_CONTOUR if pin.clearance.contour else ()


def _film(pin: Pin, render: Render, states: int) -> PinFunction:
    calls, joint = _calls_of_film(pin, "double"), pin.clearance.label
    steps: dict[str, Any] = {"before": _lines(pin.before_film), "after": _lines(pin.after_film), "law": _texts(calls)}
    steps["unread"] = functions.unread_branches([pin.laws["film"]], (*pin.before_film, *pin.after_film))
    text = render("play/film.c.jinja", joint=joint, rates=braced("", pin.clearance, states), **steps)
    own: Stores = [*functions.one_by_one(pin.before_film), *((code, local) for code, local in calls if local)]
    return PinFunction(function_name("film", joint), text, [*own, *functions.one_by_one(pin.after_film)])


def _store(clearance: Clearance, states: int) -> str:
    rates = braced("F.state_rate", clearance, states)
    own = _AT_WALL if clearance.wall else _JOURNAL
    more = f", .state_rate = {rates}" if rates else ""
    more += ",\n        .from_x = e_x, .from_y = e_y" * bool(clearance.wall)
    return _STORE % (*own, more + ", .at_wall = 1" * bool(clearance.wall and clearance.rigid))


def braced(array: str, clearance: Clearance, states: int, none: str = "0.0") -> str:
    """Rates of the inner states of its laws as an initializer, `none` where it has none; "" where no law has any."""
    own = len(clearance.states) if array else 0
    rates = [f"{array}[{k}]" if k < own else none for k in range(states)]
    return f"{{{', '.join(rates)}}}" if rates else ""


def calls_of_dry(pin: Pin, delta: str, number: str) -> str:
    """Normal force, of `delta`, then friction, if there is any."""
    return _texts(_calls_of_dry(pin, delta, number))


def _calls_of_dry(pin: Pin, delta: str, number: str) -> list[tuple[str, str]]:
    """Text, and the local that it fills, or ""."""
    given: Sequence[str] = [delta, "ratio", *map(expression, pin.given)]
    normal = functions.shared_call(pin.laws["normal"], given, ("&F_n",))
    found = [(f"{number} F_n;", ""), (normal, "F_n")]
    pressed = "F_N" if pin.pressing else "F_n"
    pressing = zip(functions.one_by_one(pin.pressing), pin.pressing, strict=True)
    found += [(code.strip(), step.defines) for (code, _), step in pressing]
    if "friction" in pin.laws:
        states = range(len(pin.clearance.states))
        given, told = [f"contact->state[{k}]" for k in states], [f"&rate[{k}]" for k in states]
        results = ("&F_along_t_dry", *told)
        friction = functions.shared_call(pin.laws["friction"], (pressed, "v_t", *given), results)
        found.append((f"{number} F_along_t_dry{f', rate[{len(states)}]' if states else ''};", ""))
        found.append((friction, "F_along_t_dry"))
        if pin.clearance.rigid:
            found.append((_IN_BLOW, ""))
    else:
        zero = "0.0" if number == "double" else "all_of(0.0)"
        found.append((f"const {number} F_along_t_dry = {zero}; /* no friction */", "F_along_t_dry"))
    return [(_wrapped(code), local) for code, local in found]


def call_of_film(pin: Pin, number: str) -> str:
    """Its forces, and the torque of shear where that is read."""
    return _texts(_calls_of_film(pin, number))


def _calls_of_film(pin: Pin, number: str) -> list[tuple[str, str]]:
    results = ("&F_r", "&F_along_t_film", "&T0")
    call = functions.shared_call(pin.laws["film"], ("epsilon", "w_n", "w_t"), results)
    unread = "(void)T0; /* read only with shear */"
    found = [(f"{number} F_r, F_along_t_film, T0;", ""), (call, "F_r"), (unread, "")]
    return [(_wrapped(code), local) for code, local in found]


def _texts(found: Sequence[tuple[str, str]]) -> str:
    return "\n".join(code for code, _ in found)


def _wrapped(code: str) -> str:
    return "\n".join(broken(f"    {code}"))


def _lines(statements: Sequence[Statement]) -> str:
    return functions.statements(statements)


def _template(pin: Pin) -> str:
    if pin.clearance.film is None:
        return "play/clearance_dry.c.jinja"
    return "play/clearance_transition.c.jinja" if pin.has_transition else "play/clearance_film.c.jinja"
