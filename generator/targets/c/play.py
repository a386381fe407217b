"""The C of one joint with play: which templates it needs and what is substituted in them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.targets.c import functions

Render = Callable[..., str]  # template name, substitutions -> text

_ARGUMENTS = (
    "double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,\n"
    "    const Latch *latch, const Parameters *p, const double *side, double *g, Clearance *out"
)
_STORE = """\
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};"""
_RATIO = "latch->closed ? deltadot / latch->deltadot_minus : 1.0"


def clearance_code(pin: Pin, render: Render) -> str:
    """Law functions, then the joint's own function."""
    joint, clearance = pin.clearance.name, pin.clearance
    parts = [functions.kernel(kernel) for kernel in pin.laws]
    if clearance.normal is not None:
        ratio = {"ratio": _RATIO, "ratio_name": "unclipped" if clearance.clip_ratio else "ratio"}
        steps = {"before": _lines(pin.before_dry), "after": _lines(pin.after_dry)}
        parts.append(render("play/dry.c.jinja", joint=joint, **ratio, **steps))
    if clearance.film is not None:
        steps = {"before": _lines(pin.before_film), "after": _lines(pin.after_film)}
        parts.append(render("play/film.c.jinja", joint=joint, **steps))
    parts.append(
        render(
            _template(pin), joint=joint, arguments=_ARGUMENTS, gap=_lines(pin.gap), share=_lines(pin.share),
            store=_STORE, first=pin.corners.start, last=pin.corners.stop,
        )
    )  # fmt: skip
    return "\n".join(parts)


def _lines(statements: Sequence[Statement]) -> str:
    return functions.statements(statements)


def _template(pin: Pin) -> str:
    if pin.clearance.film is None:
        return "play/clearance_dry.c.jinja"
    return "play/clearance_transition.c.jinja" if pin.has_transition else "play/clearance_film.c.jinja"
