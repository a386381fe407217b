"""The C of one joint with play: which templates it needs and what is substituted in them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from gudgeon.generator import contact
from gudgeon.generator.clearance import Clearance
from gudgeon.generator.contact import Step
from gudgeon.generator.kernels import Statement
from gudgeon.generator.law_kernels import law_kernels
from gudgeon.generator.model import Model
from gudgeon.generator.targets.c import printer

Render = Callable[..., str]  # template name, substitutions -> text

_ARGUMENTS = (
    "double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,\n"
    "    const Latch *latch, const Parameters *p, Clearance *out"
)
# At e = 0 any direction will do for the normal: the force is isotropic there.
_GUARDED = {contact.n_x: "e > 0.0 ? e_x / e : 1.0", contact.n_y: "e > 0.0 ? e_y / e : 0.0"}
_STORE = """\
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};"""
_RATIO = "latch->closed ? deltadot / latch->deltadot_minus : 1.0"
_CLIPPED = f"max_of(min_of({_RATIO}, 1.0), -1.0)"


def clearance_code(model: Model, clearance: Clearance, render: Render) -> str:
    """Law functions, then the joint's own function."""
    joint, film = clearance.name, clearance.film
    parts = [printer.kernel(kernel) for kernel in law_kernels(model.symbols, clearance)]
    if clearance.normal is not None:
        before = [step for step in contact.before_dry(clearance) if step.symbol != contact.ratio]
        parts.append(
            render(
                "dry.c.jinja", joint=joint, ratio=_CLIPPED if clearance.clip_ratio else _RATIO,
                before=_lines(model, before), after=_lines(model, contact.after_dry()),
            )
        )  # fmt: skip
    if film is not None:
        before, after = contact.before_film(clearance, film), contact.after_film(film)
        parts.append(render("film.c.jinja", joint=joint, before=_lines(model, before), after=_lines(model, after)))
    share = [contact.blend(clearance)] if _template(clearance) == "clearance_transition.c.jinja" else []
    parts.append(
        render(
            _template(clearance), joint=joint, arguments=_ARGUMENTS, gap=_lines(model, contact.gap(clearance)),
            share=_lines(model, share), store=_STORE,
        )
    )  # fmt: skip
    return "\n".join(parts)


def _lines(model: Model, steps: Sequence[Step]) -> str:
    """Steps as C statements, parameters read in place."""
    lines = []
    for step in steps:
        slots = {s: sp.Symbol(f"p->{s.name}") for s in step.value.free_symbols if s in model.symbols.info}
        value = _GUARDED.get(step.symbol) or step.value.xreplace(slots)
        lines.append(printer.statement(Statement(step.symbol.name, value)))
    return "\n".join(lines)


def _template(clearance: Clearance) -> str:
    if clearance.film is None:
        return "clearance_dry.c.jinja"
    return "clearance_film.c.jinja" if clearance.normal is None else "clearance_transition.c.jinja"
