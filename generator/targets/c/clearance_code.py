"""The C of one joint with play: which templates it needs and what is substituted in them."""

from __future__ import annotations

from collections.abc import Callable

from gudgeon.generator.clearance import Clearance
from gudgeon.generator.law_kernels import law_kernels
from gudgeon.generator.model import Model
from gudgeon.generator.targets.c import printer

Render = Callable[..., str]  # template name, substitutions -> text

EPSILON_MAX = 0.9999  # the film is evaluated with its eccentricity ratio capped here (physics.md, 4)

_ARGUMENTS = (
    "double ex, double ey, double edot_x, double edot_y, double omega_i, double omega_j,\n"
    "    const Latch *latch, const Parameters *p, Clearance *out"
)
_GAP = """\
    const double e = sqrt(ex * ex + ey * ey);
    const double nx = e > 0.0 ? ex / e : 1.0; /* at e = 0 any direction will do: the force is isotropic there */
    const double ny = e > 0.0 ? ey / e : 0.0;
    const double deltadot = edot_x * nx + edot_y * ny;
    const double edot_t = edot_y * nx - edot_x * ny;
    const double delta = e - p->{c};"""
_STORE = """\
    *out = (Clearance){.Fx = F_n * nx - F_t * ny, .Fy = F_n * ny + F_t * nx, .F_n = F_n, .F_t = F_t,
        .ex = ex, .ey = ey, .e = e, .deltadot = deltadot, .v_t = v_t,
        .moment_first = M_i, .moment_second = M_j, .delta = delta, .power = 0.0};"""
_RATIO = "latch->closed ? deltadot / latch->deltadot_minus : 1.0"
_CLIPPED = f"max_of(min_of({_RATIO}, 1.0), -1.0)"
# Without shear the resultant acts at the journal's centre on both bodies; with shear at each pin centre.
_MOMENTS = {
    False: "*M_j = T0 * 0.0;\n    *M_i = -e * *F_t;",
    True: "const double drag = T0 * (omega_j - omega_i);\n"
    "    *M_j = -drag - 0.5 * e * *F_t;\n    *M_i = drag - 0.5 * e * *F_t;",
}
_OMEGA = {"absolute": "omega_i + omega_j", "relative": "omega_j - omega_i"}


def clearance_code(model: Model, clearance: Clearance, render: Render) -> str:
    """Law functions, then the joint's own function."""
    pair, constants = clearance.pair, clearance.constants
    parts = [printer.kernel(kernel) for kernel in law_kernels(model.symbols, clearance)]
    if clearance.normal is not None:
        ratio = _CLIPPED if clearance.clip_ratio else _RATIO
        parts.append(render("dry.c.jinja", name=clearance.name, c=pair.c, R_i=pair.R_i, R_j=pair.R_j, ratio=ratio))
    if clearance.film is not None:
        options = clearance.film.options
        parts.append(
            render(
                "film.c.jinja",
                name=clearance.name,
                c_film=constants["film_clearance"],
                epsilon_max=EPSILON_MAX,
                omega_sum=_OMEGA[str(options.get("angular_velocity", "absolute"))],
                moments=_MOMENTS[bool(options.get("shear", False))],
            )
        )
    parts.append(
        render(
            _template(clearance),
            name=clearance.name,
            arguments=_ARGUMENTS,
            gap=_GAP.format(c=pair.c),
            store=_STORE,
            e_0=clearance.transition,
        )
    )
    return "\n".join(parts)


def _template(clearance: Clearance) -> str:
    if clearance.film is None:
        return "clearance_dry.c.jinja"
    return "clearance_film.c.jinja" if clearance.normal is None else "clearance_transition.c.jinja"
