"""Writes the functions of a joint with play as JavaScript, like clearance.c; each returns what it stores.

Branches are not frozen: a contact is closed if δ > 0, as where C evaluates a sample.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.readable import Readable, lines
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.targets.javascript.printer import JavaScriptPrinter, Lines, results

MOTION = (contact.e_x, contact.e_y, contact.de_x, contact.de_y, contact.omega_i, contact.omega_j)
BLENDED = ("n", "t", "M_i", "M_j")  # members of a force that film and dry contact share
_NOTHING = "{n: 0, t: 0, M_i: 0, M_j: 0}"
_DRY = ("delta", "deltadot", "de_t", "omega_i", "omega_j", "contact", "p", "of")
_OF_CONTOUR = ("e", "steep", "worn_slope")
_FILM = ("e", "deltadot", "de_t", "omega_i", "omega_j", "p", "of")


def joint_functions(own: Pin, read: set[str]) -> list[str]:
    """Return `dry_A`, `film_A` and `clearance_A` of joint A, if it has them; `read` gets the members of p.

    Values that a function and the laws that it calls store go to `of` by the function's name: `of.dry_A.a_i`; the force
    in ground axes goes to `of.force`.
    """
    joint, found = own.clearance.label, []
    if own.clearance.normal is not None:
        found.append(_method_code(f"dry_{joint}_", _dry_arguments(own), _dry(own, read)))
    if own.clearance.film is not None:
        found.append(_method_code(f"film_{joint}_", _FILM, _film(own, read)))
    given = (*map(str, motion(own.clearance)), "contact", "p", "of")
    return [*found, _method_code(f"clearance_{joint}_", given, _clearance(own, read))]


def motion(clearance: Clearance) -> tuple[sp.Symbol, ...]:
    """Return the symbols of the motion that a joint's function gets."""
    if clearance.wall:
        return (*MOTION, contact.n_x, contact.n_y)
    return (*MOTION, contact.theta_i) if clearance.contour else MOTION


def _dry_arguments(own: Pin) -> tuple[str, ...]:
    """Return the arguments of a joint's dry contact."""
    return (*_DRY[:5], *_OF_CONTOUR, *_DRY[5:]) if own.clearance.contour else _DRY


def _method_code(name: str, given: Iterable[str], body: Iterable[str]) -> str:
    """Return a method of an object."""
    return "\n".join([f"{name}({', '.join(given)}) {{", *(f"    {line}" for line in body), "}"])


def _dry(own: Pin, read: set[str]) -> list[str]:
    """Return the lines of dry contact."""
    ratio = "unclipped" if own.clearance.clip_ratio else "ratio"
    before, after = _Part(own.before_dry, read), _Part(own.after_dry, read)
    body = [f"const {ratio} = contact.closed ? deltadot / contact.deltadot_minus : 1;", *before.text]
    body += _call(own.laws["normal"], ("max_of(delta, 0)", "ratio", *map(str, own.given)), ("F_n",), read)
    pressing = _Part(own.pressing, read)
    pressed, body = "F_N" if own.pressing else "F_n", [*body, *pressing.text]
    if "friction" in own.laws:
        states = (f"contact.state[{k}]" for k in range(len(own.clearance.states)))
        body += _call(own.laws["friction"], (pressed, "v_t", *states), ("F_along_t_dry",), read)
    else:
        body.append("const F_along_t_dry = 0;")
    stored = [ratio, *before.locals, "F_n", *pressing.locals, "F_along_t_dry", *after.locals]
    return [*body, *after.text, _store(f"dry_{own.clearance.label}_", stored), _return_force(f"-{pressed}", "dry")]


def _film(own: Pin, read: set[str]) -> list[str]:
    """Return the lines of a film."""
    before, after = _Part(own.before_film, read), _Part(own.after_film, read)
    forces = ("F_r", "F_along_t_film", "T0")
    body = [*before.text, *_call(own.laws["film"], ("epsilon", "w_n", "w_t"), forces, read), *after.text]
    stored = [*before.locals, *forces, *after.locals]
    return [*body, _store(f"film_{own.clearance.label}_", stored), _return_force("F_r", "film")]


def _clearance(own: Pin, read: set[str]) -> list[str]:
    """Return the lines of a joint's force: the normal direction, then dry contact, film or their blend."""
    joint = own.clearance.label
    gap, share = _Part(own.gap, read), _Part(own.share, read)
    parts = (("dry", _dry_arguments(own)), ("film", _FILM))
    dry, film = (f"functions.{part}_{joint}_({', '.join(given)})" for part, given in parts)
    body = [*gap.text, _store(f"clearance_{joint}_", gap.locals)]
    if own.clearance.film is None:
        acts = "contact.closed" if own.clearance.rigid else "delta > 0"
        at_wall = "{...F, M_i: F.M_i + along * F.n}" if own.clearance.wall else "F"
        return [*body, f"const F = {acts} ? {dry} : {_NOTHING};", _return_in_ground_axes(at_wall)]
    if own.clearance.normal is None:
        return [*body, _return_in_ground_axes(film)]
    kept = ", ".join(share.locals)
    blended = (f'own["F.{one}"] = F.{one} += (1 - share) * (film.{one} - F.{one});' for one in BLENDED)
    return [
        *body,
        f"if (!(delta > 0)) {_return_in_ground_axes(film)}",
        *share.text,
        f"const F = {dry}, own = Object.assign(of.clearance_{joint}_, {{{kept}}});",
        "if (share < 1) {",
        f"    const film = {film};",
        *(f"    {line}" for line in blended),
        "}",
        _return_in_ground_axes("F"),
    ]


def _return_in_ground_axes(force: str) -> str:
    """Return the line that returns a force in ground axes."""
    return f"return turned({force}, n_x, n_y, of);"


class _Part:
    """Contain the lines of statements and the locals that they store."""

    def __init__(self, statements: Sequence[Statement], read: set[str]) -> None:
        writer = Lines(lines(statements), read)
        self.text, self.locals = writer.all(), writer.locals


def _call(call: SharedFunctionCall, given: Iterable[str], stored: Sequence[str], read: set[str]) -> list[str]:
    """Return the call of a law, with its first results as locals."""
    function, numbers = call.kernel.name, map(JavaScriptPrinter(Readable(()), read).called, call.numbers)
    message = ", ".join(f"{of}: {name}" for of, name in zip(results(call.kernel), stored, strict=False))
    called = f"functions.{function}({', '.join([*given, *numbers])})"
    return [f"const {{{message}}} = of.{function} = {called};"]


def _store(function: str, names: Iterable[str]) -> str:
    """Return the line that stores locals by a function's name."""
    return f"of.{function} = {{{', '.join(dict.fromkeys(names))}}};"


def _return_force(along: str, part: str) -> str:
    """Return the line that returns a force in the axes of the contact."""
    return f"return {{n: {along}, t: F_along_t_{part}, M_i: M_i_{part}, M_j: M_j_{part}}};"
