"""The C of one joint with play: which templates it needs and what is substituted in them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from gudgeon.generator.equations import contact_steps as contact
from gudgeon.generator.equations.contact_steps import Step
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.kernels import Section, Statement, hold_sides
from gudgeon.generator.kernels.laws import law_kernels
from gudgeon.generator.solvers.contact_slopes import in_place, unlatched
from gudgeon.generator.targets.c import printer

Render = Callable[..., str]  # template name, substitutions -> text

_ARGUMENTS = (
    "double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,\n"
    "    const Latch *latch, const Parameters *p, const double *side, double *g, Clearance *out"
)
# At e = 0 any direction will do for the normal: the force is isotropic there.
_GUARDED = {contact.n_x: "e > 0.0 ? e_x * inverse_e : 1.0", contact.n_y: "e > 0.0 ? e_y * inverse_e : 0.0"}
_STORE = """\
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};"""
_RATIO = "latch->closed ? deltadot / latch->deltadot_minus : 1.0"


def clearance_code(model: Model, clearance: Clearance, render: Render) -> str:
    """Law functions, then the joint's own function."""
    joint, film = clearance.name, clearance.film
    parts = [printer.kernel(kernel) for kernel in law_kernels(model, clearance)]
    owner = clearance.name
    if clearance.normal is not None:
        before = [unlatched(step) for step in contact.before_dry(clearance)]
        parts.append(
            render(
                "play/dry.c.jinja", joint=joint, ratio=_RATIO,
                ratio_name="unclipped" if clearance.clip_ratio else "ratio",
                before=_lines(model, before, owner), after=_lines(model, contact.after_dry(), owner),
            )
        )  # fmt: skip
    if film is not None:
        before, after = contact.before_film(clearance, film), contact.after_film(film)
        parts.append(
            render(
                "play/film.c.jinja",
                joint=joint,
                before=_lines(model, before, owner),
                after=_lines(model, after, owner),
            )
        )
    share = [contact.blend(clearance, closed=True)] if has_transition(clearance) else []
    gap, blend = _lines(model, contact.gap(clearance), owner), _lines(model, share, owner)
    switches = [switch.index for switch in model.symbols.switches.of(owner)]
    parts.append(
        render(
            _template(clearance), joint=joint, arguments=_ARGUMENTS, gap=gap, share=blend, store=_STORE,
            first=min(switches, default=0), last=max(switches, default=-1) + 1,
        )
    )  # fmt: skip
    return "\n".join(parts)


def _lines(model: Model, steps: Sequence[Step], owner: str) -> str:
    return lines(model, steps, owner, _GUARDED, printer.statement)


def lines(
    model: Model, steps: Sequence[Step], owner: str, guarded: Mapping[sp.Symbol, str],
    written: Callable[[Statement], str],
) -> str:  # fmt: skip
    """Steps as statements, parameters read in place, corners as sides of switches."""
    statements = []
    for step in steps:
        value = guarded.get(step.symbol) or in_place(model, step.value)
        statements.append(Statement(step.symbol.name, value))
        if step.symbol == contact.e:
            statements.append(Statement("inverse_e", 1 / contact.e))
    (section,) = hold_sides(model.symbols.switches, owner, [Section("", tuple(statements))])
    return "\n".join(written(item) for item in section.statements if isinstance(item, Statement))


def has_transition(clearance: Clearance) -> bool:
    """Film and dry contact, blended."""
    return clearance.film is not None and clearance.normal is not None


def _template(clearance: Clearance) -> str:
    if clearance.film is None:
        return "play/clearance_dry.c.jinja"
    return "play/clearance_film.c.jinja" if clearance.normal is None else "play/clearance_transition.c.jinja"
