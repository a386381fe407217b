"""The C of the linearized equations: derivatives of the joints with play, Newton's matrix, the Jacobian."""

from __future__ import annotations

import textwrap
from collections.abc import Callable

from gudgeon.generator.equations.model import Model, stick_gain
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.solvers.contact_slopes import dry_slopes, film_slopes, share_slope
from gudgeon.generator.solvers.newton import Newton
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.time_loops import Integrated

Render = Callable[..., str]  # template name, substitutions -> text

_CALL = "(e, deltadot, de_t, omega_i, omega_j, latch, p, side, g, {});"
_CLOSED = "side ? latch->closed : delta > 0.0"
_BLENDING = """
/* F = share F + (1 - share) film, slopes as well; `share` with its derivative by e. */
static inline void blend_slopes(PinSlopes *F, const PinSlopes *film, const double *share)
{
    for (int i = 0; i < 4; i++) {
        const double more = F->value[i] - film->value[i];
        F->value[i] = film->value[i] + share[0] * more;
        for (int k = 0; k < 5; k++)
            F->slope[i][k] = film->slope[i][k] + share[0] * (F->slope[i][k] - film->slope[i][k]);
        F->slope[i][0] += share[1] * more;
    }
}"""


def newton_code(system: System, render: Render, prefix: str = "") -> tuple[str, list[Kernel]]:
    """Struct, kernels and tables of one system."""
    newton = Newton(system, prefix)
    kernels = [newton.linearize, newton.factor, newton.substitute, newton.solve]
    counts = [(f"{prefix}n_{name}".upper(), len(entries)) for name, entries in newton.tables.items()]
    text = render(
        "scene/newton.c.jinja", struct=f"{prefix.title()}Linear", prefix=prefix, n_values=newton.values.size,
        n_factors=newton.factors.size, kernels="\n".join(map(printer.kernel, kernels)),
        tables=[(name, _table(entries)) for name, entries in newton.tables.items()],
        counts=[*counts, (f"{prefix}n_nodes".upper(), newton.nodes)],
    )  # fmt: skip
    return text, kernels


def jacobian_code(model: Model, integrated: Integrated, render: Render) -> str:
    """The functions that Python calls; the reduced formulation has no Baumgarte's terms."""
    stick = f"((const Parameters *)p)->{stick_gain(model)}" if model.frictions else "0.0"
    chain = {"n_chain": len(integrated.system.known), "state": integrated.state("y")}
    if integrated.reduced:
        none = {"two_alpha": "0.0", "beta_squared": "0.0"}
        return render("scene/jacobian.c.jinja", name="gudgeon_tree_jacobian", stick=stick, **chain, **none)
    derive, (alpha, beta) = model.slots.derive, model.baumgarte
    gains = {"two_alpha": derive("two_alpha", 2 * alpha), "beta_squared": derive("beta_squared", beta**2)}
    read = {name: f"((const Parameters *)p)->{gain}" for name, gain in gains.items()}
    return render("scene/jacobian.c.jinja", name="gudgeon_jacobian", stick=stick, **chain, **read)


def tangent_code(model: Model, render: Render) -> tuple[str, list[Kernel]]:
    """`tangent_<joint>` of every joint with play."""
    if not model.clearances:
        return "", []
    both = any(c.film is not None and c.normal is not None for c in model.clearances)
    parts, kernels = [render("play/pin_slopes.c.jinja", blending=_BLENDING if both else "")], []
    for clearance in model.clearances:
        own = []
        if clearance.film is not None:
            own.append(film_slopes(model, clearance, clearance.film))
        if clearance.normal is not None:
            own.append(dry_slopes(model, clearance, clearance.normal))
        if len(own) == 2:
            own.append(share_slope(model, clearance))
        c = f"p->{clearance.pair.c}"
        parts += map(printer.kernel, own)
        parts.append(render("play/tangent.c.jinja", joint=clearance.name, c=c, slopes=_slopes(clearance, c)))
        kernels += own
    return "\n".join(parts), kernels


def _slopes(clearance: Clearance, c: str) -> str:
    """Which part acts, as in the joint's own function (clearance_*.c.jinja)."""
    dry, film = (f"{part}_slopes_{clearance.name}{_CALL}" for part in ("dry", "film"))
    if clearance.normal is None:
        return f"    {film.format('out')}"
    lines = [f"const double delta = e - {c};"]
    if clearance.film is None:
        lines += ["*out = (PinSlopes){0};", f"if ({_CLOSED})", f"    {dry.format('out')}"]
    else:
        lines += [f"if (!({_CLOSED})) {{", f"    {film.format('out')}", "    return;", "}"]
        lines += [dry.format("out"), "double share[2];", f"share_slope_{clearance.name}(delta, p, side, g, share);"]
        lines += ["if (share[0] < 1.0) {", "    PinSlopes film;", f"    {film.format('&film')}"]
        lines += ["    blend_slopes(out, &film, share);", "}"]
    return textwrap.indent("\n".join(lines), "    ")


def _table(entries: list[tuple[int, int, int, int]]) -> str:
    """Rows of a table; an empty one holds a row that nobody reads."""
    rows = [f"{{{', '.join(map(str, entry))}}}" for entry in entries] or ["{0, 0, 0, 0}"]
    return textwrap.fill(", ".join(rows), 110, initial_indent="    ", subsequent_indent="    ")
