"""Writes the C of the linearized equations: derivatives of the forces of joints with play, and Newton's matrix."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence

from gudgeon.generator.equations.contact_steps import beta_i
from gudgeon.generator.equations.play import Clearance, Contour
from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.kernels.program import Methods
from gudgeon.generator.kernels.shared import SharedFunctionCall
from gudgeon.generator.solvers.contact_slopes import OF_CONTOUR, in_place
from gudgeon.generator.solvers.newton import Newton
from gudgeon.generator.targets.c import functions
from gudgeon.generator.targets.c.play import CLOSED, CONTOURS
from gudgeon.generator.targets.c.printer import expression

Render = Callable[..., str]  # template name, substitutions -> text

STATE = ("e", "deltadot", "de_t", "omega_i", "omega_j", "contact")
_BLENDING = """
/* F = share F + (1 - share) film, slopes as well; `share` with its derivative by e. */
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


def newton_code(newton: Newton, render: Render) -> str:
    """Return kernels and tables of the linearized equations of one system."""
    kernels = [newton.linearize, newton.factor, newton.substitute, newton.solve]
    counts = [(f"n_{name}".upper(), len(entries)) for name, entries in newton.tables.items()]
    return render(
        "newton.c.jinja",
        kernels="\n".join(map(functions.kernel, kernels)),
        tables=[(name, _table_rows(entries)) for name, entries in newton.tables.items()],
        counts=[*counts, ("N_NODES", newton.nodes)],
    )


def tangent_code(pins: Sequence[Pin], methods: Methods, render: Render, states: int) -> str:
    """Return `tangent_<joint>` of every joint with play, after the derivatives of laws that the joints share.

    Each joint has `states` inner states of laws.
    """
    if not pins:
        return ""
    contours = any(pin.clearance.contour for pin in pins)
    sizes = {"rows": 4 + states, "columns": 5 + states}
    parts = [CONTOURS * contours + shared_slopes_code(pins, render, "double", "PinSlopes", states)]
    parts += [render("play/contour_slopes.c.jinja")] * contours
    parts += map(functions.kernel, methods.sloping)
    for clearance in (pin.clearance for pin in pins):
        if clearance.contour:
            parts.append(_contour_tangent(clearance, clearance.contour, methods.slopes[clearance.name]["dry"], render))
            continue
        c = f"p->{clearance.pair.c}"
        slopes = _select_slopes(clearance, c, methods.slopes[clearance.name])
        if clearance.wall:
            rise = expression(in_place(methods.newton.system.model, clearance.wall.rise))
            parts.append(
                render("play/wall_tangent.c.jinja", joint=clearance.label, c=c, rise=rise, slopes=slopes, **sizes)
            )
            continue
        parts.append(render("play/tangent.c.jinja", joint=clearance.label, c=c, slopes=slopes, **sizes))
    return "\n".join(parts)


def _contour_tangent(clearance: Clearance, contour: Contour, dry: SharedFunctionCall, render: Render) -> str:
    """Return the tangent function of a bearing with a contour."""
    given = [symbol.name for symbol in OF_CONTOUR]
    return render(
        "play/contour_tangent.c.jinja",
        joint=clearance.label,
        c=f"p->{clearance.pair.c}",
        worn=[expression(contour.at(beta_i, order)) for order in range(3)],
        unread="g" in functions.unread_branches([dry]),
        call=functions.shared_call(dry, (*given, "contact"), ("&F",)),
    )


def shared_slopes_code(pins: Sequence[Pin], render: Render, number: str, type_: str, states: int) -> str:
    """Return the functions that combine derivatives of all joints with play, for numbers or for vectors."""
    blending = _BLENDING.replace("{number}", number).replace("{type}", type_).replace("k < 5", f"k < {5 + states}")
    shown = blending if any(pin.has_transition for pin in pins) else ""
    given = {"number": number, "type": type_, "rows": 4 + states, "columns": 5 + states}
    of_walls = render("play/wall_slopes.c.jinja", **given) if any(pin.clearance.wall for pin in pins) else ""
    return render("play/pin_slopes.c.jinja", blending=shown, **given) + of_walls


def _select_slopes(clearance: Clearance, c: str, calls: Mapping[str, SharedFunctionCall]) -> str:
    """Return the code that selects dry contact, film or both, as in the joint's force (clearance_*.c.jinja)."""

    def call(part: str, result: str, *given: str) -> str:
        """Return the call of the derivatives of one part."""
        return functions.shared_call(calls[part], given or STATE, (result,))

    unread = functions.unread_branches(calls.values())
    if clearance.normal is None:
        return "\n".join(f"    {line}" for line in (*(f"(void){name};" for name in unread), call("film", "out")))
    lines = [*["(void)g;"] * ("g" in unread), f"const double delta = e - {c};"]
    if clearance.film is None:
        lines += ["*out = (PinSlopes){0};", f"if ({CLOSED})", f"    {call('dry', 'out')}"]
    else:
        lines += [f"if (!({CLOSED})) {{", f"    {call('film', 'out')}", "    return;", "}"]
        lines += [call("dry", "out"), "double share[2];", call("share", "share", "delta")]
        lines += ["if (share[0] < 1.0) {", "    PinSlopes film;", f"    {call('film', '&film')}"]
        lines += ["    blend_slopes(out, &film, share);", "}"]
    return textwrap.indent("\n".join(lines), "    ")


def _table_rows(entries: list[tuple[int, int, int, int]]) -> str:
    """Return the rows of a table as C; an empty one contains one unused row."""
    rows = [f"{{{', '.join(map(str, entry))}}}" for entry in entries] or ["{0, 0, 0, 0}"]
    together = " ".join(f"{row},".replace(" ", "\0") for row in rows).removesuffix(",")  # a row is never parted
    return textwrap.fill(together, 110, initial_indent="    ", subsequent_indent="    ").replace("\0", " ")
