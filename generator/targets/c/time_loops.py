"""The C of the time loops: which templates a formulation's integrators are made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.notes import has_jumps
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels.drive_jumps import Jumps
from gudgeon.generator.kernels.event_functions import ranges_kernel, reads_state
from gudgeon.generator.kernels.program import Integrated, Program
from gudgeon.generator.kernels.time_terms import count_terms
from gudgeon.generator.methods import dop853, rodas5p
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.targets.c import functions, printer, ranges_printer

Render = Callable[..., str]

_PROJECTED = (
    "Constraints are closed after every step.", "    project_state(run, run->t + h, trial->y, p);",
    "        project_state(run, t, now, p);",
)  # fmt: skip
_STABILISED = ("Constraints are stabilised by Baumgarte's terms.", "", "")
_FROM_DYNAMICS = """\
    for (int r = 0; r < N_ROWS; r++) {
        run->phi_max = max_of(fabs(aside->phi[r]), run->phi_max);
        run->phi_dot_max = max_of(fabs(aside->phi_dot[r]), run->phi_dot_max);
    }"""
_FROM_CLOSURES = """\
    double phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    closures(run->t, run->y, p, phi);
    closure_rates(run->t, run->y, run->y + N_X, p, phi_dot);
    for (int r = 0; r < N_LOOPS; r++) {
        run->phi_max = max_of(fabs(phi[r]), run->phi_max);
        run->phi_dot_max = max_of(fabs(phi_dot[r]), run->phi_dot_max);
    }"""


_FROM_TREE = """\
    TreeState at; /* from here on the driven chains are followed */
    int status = tree_state(run->t, run->y, &run->memory, p, &at);
    if (!status)
        status = keep_chains(run->t, &at, &run->memory, p);
    if (status)
        return status;
""" + _FROM_CLOSURES.replace("run->y, run->y + N_X", "at.q, at.v").replace("run->y", "at.q")
# what kernels of the motion read at the accepted state, at a state y, and with driven chains
_STATES = {"run": "run->y, run->y + N_X", "y": "y, y + N_X", "chain": "at.q, at.v"}


def state_of(integrated: Integrated, where: str) -> str:
    """The arguments q and v of the kernels of what is integrated."""
    return _STATES["chain" if integrated.system.known else where]


def kinematic_code(program: Program, counts: Mapping[str, int], render: Render) -> dict[str, str]:
    """Positions by Newton, and events on the way."""
    course, model, terms = program.course, program.model, program.terms
    assert course
    jumps = has_jumps(model)
    text = "\n".join(map(functions.kernel, course.kernels))
    if course.rows:
        text = render("scene/block.c.jinja", most=course.rows.largest) * (course.rows.largest > 2) + text
        angles = program.integrated.angles or (1,)
        closing = render("kinematic/kinematic_tree.c.jinja", kernels=text, angles=angles, jumps=jumps)
    else:
        closing = text + "\n" + render("kinematic/kinematic_full.c.jinja", **counts, jumps=jumps)
    watched = program.watched if model.events else None
    files = _range_code(terms, watched, render)
    files["kinematic.c"] = render(
        "kinematic/kinematic.c.jinja", closing=closing, tree=bool(course.rows), n_terms=count_terms(terms)
    )
    if model.events:
        corners = sorted(switch.index for switch in model.symbols.switches.of(""))
        text = ranges_printer.kernel(ranges_kernel(watched, corners, len(model.events))) if watched else ""
        files["kinematic_events.c"] = render("kinematic/kinematic_events.c.jinja", kernel=text, first=len(corners))
    return files


def integrator_loops(
    program: Program, motion: str, linearized: str, counts: Mapping[str, int], render: Render
) -> dict[str, str]:
    """All methods, in the order in which they call each other."""
    model, integrated, terms, lanes = program.model, program.integrated, program.terms, program.has_lanes
    assert program.methods
    pivots = _friction_pivots(integrated.kkt)
    kind = "friction" if pivots else "no_friction"
    modes, events = (render(f"run/{name}.c.jinja", pivots=pivots).strip() for name in (kind, f"{kind}_events"))
    common, jumps = _common(model, integrated, counts), integrated.jumps
    constraints, projection, inside = _PROJECTED if integrated.reduced else _STABILISED
    residuals = _FROM_CLOSURES if integrated.reduced else _FROM_DYNAMICS
    residuals = _FROM_TREE if integrated.system.known else residuals
    chain = {"n_chain": counts["n_chain"]}
    return {
        "motion.c": motion,
        **_range_code(terms, integrated.watched or jumps, render),
        "projection.c": functions.kernel(program.methods.closing),
        "newton.c": linearized,
        "run.c": render(
            "run/run.c.jinja", **common, friction_modes=modes, angles=integrated.angles or (0,), residuals=residuals
        ),
        "step.c": render("methods/step.c.jinja", state=state_of(integrated, "y"), **counts),
        **({"jumps.c": _jumps_code(jumps, render)} if jumps else {}),
        "rk4.c": render(
            "methods/rk4.c.jinja",
            **common,
            friction_events=events,
            constraints=constraints,
            projection=projection,
            inside=inside,
        ),
        "dop853.c": render("methods/dop853.c.jinja", **_dop853()),
        "rodas5p.c": render("methods/rodas5p.c.jinja", state=state_of(integrated, "run"), **chain, **_rodas5p()),
        "roots.c": render("watch/roots.c.jinja", **common),
        "pulses.c": render("watch/pulses.c.jinja", n_terms=count_terms(terms), **_places()),
        "watched.c": _watched_code(integrated, counts, render),
        "events.c": render("run/events.c.jinja", **common),
        "peaks.c": render("run/peaks.c.jinja", **counts),
        "changes.c": render("run/changes.c.jinja", **common),
        "adaptive.c": render("methods/adaptive.c.jinja", **common),
        "batch.h": render("batch/batch.h.jinja", **common, lanes=lanes),
        "many.c": render("batch/many.c.jinja", **common, lanes=lanes),
    }


def _common(model: Model, integrated: Integrated, counts: Mapping[str, int]) -> dict[str, Any]:
    """What most of their templates read."""
    return {
        **counts, "floors": _floors(model), "clearances": _lengths(model, [c.pair.c for c in model.clearances]),
        "deepest": _lengths(model, [deepest(c) for c in model.clearances]),
        "n_watched": len(integrated.corners) + counts["n_events"],
        "n_corners": integrated.jumps.count if integrated.jumps else 0,
        "meeting": _meeting(model, counts["n_switches"]),
    }  # fmt: skip


def _terms(row: Mapping[int, float]) -> str:
    """A row of coefficients as a sum over stages: so unrolled it is one vector loop."""
    return " + ".join(f"{value!r} * k[{j}][i]" for j, value in row.items())


def _dop853() -> dict[str, Any]:
    return {
        "nodes": dop853.C, "stages": [_terms(row) for row in dop853.A[1:]], "n_stages": dop853.STAGES,
        "error_3": _terms(dop853.E[0]), "error_5": _terms(dop853.E[1]), "dense": [_terms(row) for row in dop853.D],
    }  # fmt: skip


def _rodas5p() -> dict[str, Any]:
    def terms(row: Sequence[float]) -> str:
        return _terms({j: value for j, value in enumerate(row) if value})

    return {
        "nodes": rodas5p.NODES, "time": rodas5p.TIME, "gamma": rodas5p.GAMMA,
        "stages": [terms(row) for row in rodas5p.A[1:]], "rights": [terms(row) for row in rodas5p.C[1:]],
        "dense": [terms(row) for row in rodas5p.H],
    }  # fmt: skip


def _friction_pivots(kkt: KKT) -> list[int]:
    """Which friction each pivot behind those of the rows belongs to."""
    names = [friction.name for friction in kkt.frictions]
    return [names.index(pivot) for pivot in kkt.pivots[len(kkt.rows) :]]


def _floors(model: Model) -> list[str]:
    names = [
        f"p->{c.velocity_floor}" if isinstance(c.velocity_floor, sp.Symbol) else printer.expression(c.velocity_floor)
        for c in model.clearances
    ]
    return names or ["0.0"]


def _meeting(model: Model, count: int) -> list[int]:
    """1 for the corners of contact laws, which are continuous; a user's expression, or a law as printed, may jump."""
    printed = {c.name for c in model.clearances if c.film is not None and c.film.options.get("as_printed")}
    owners = {switch.index: switch.owner for switch in model.symbols.switches.found.values()}
    return [int(bool(owners.get(k)) and owners[k] not in printed) for k in range(max(count, 1))]


def _watched_code(integrated: Integrated, counts: Mapping[str, int], render: Render) -> str:
    """How corners and events are looked for along a step: by bounds where these are known."""
    margins = _watched(integrated, counts)
    if integrated.watched is None or not margins["watched"]:
        return render("watch/looks.c.jinja" if margins["watched"] else "watch/no_watched.c.jinja", **margins)
    kernel = ranges_kernel(integrated.watched, integrated.corners, counts["n_events"])
    text = ranges_printer.kernel(kernel)
    return render("watch/watched.c.jinja", kernel=text, reads_state=reads_state(kernel), **margins)


def _jumps_code(jumps: Jumps, render: Render) -> str:
    kernels = functions.kernel(jumps.values) + "\n" + ranges_printer.kernel(jumps.ranges)
    return render("watch/jumps.c.jinja", kernels=kernels, n_corners=jumps.count)


def _range_code(terms: Kernel | None, watched: Kernel | Jumps | None, render: Render) -> dict[str, str]:
    """Arithmetic of ranges, where anything needs it, and what is known of time alone."""
    files = {"ranges.c": render("watch/ranges.c.jinja")} if terms or watched else {}
    if terms:
        most = max(5, *map(len, _places().values()))  # 5: of a kinematic motion
        values = {"kernel": ranges_printer.kernel(terms), "n_terms": count_terms(terms), "n_places": most}
        files["time_terms.c"] = render("watch/time_terms.c.jinja", **values)
    return files


def _places() -> dict[str, list[float]]:
    """Shares of a step at which a method looks, in their order: where its estimate of the error hears of it."""
    heard = {dop853.C[stage] for row in dop853.E for stage in row}
    return {"dop853": sorted({*heard, 0.0, 1.0}), "rodas5p": sorted({*rodas5p.NODES, 1.0})}


def _watched(integrated: Integrated, counts: Mapping[str, int]) -> dict[str, list[int]]:
    """Margins of the scene's own corners and of user events, in C's order of margins."""
    first = counts["n_clearances"] + counts["n_switches"] + counts["n_frictions"]
    margins = [counts["n_clearances"] + k for k in integrated.corners]
    margins += range(first, first + counts["n_events"])
    place = {k: i for i, k in enumerate(margins)}
    return {"watched": margins, "watched_as": [place.get(k, -1) for k in range(max(counts["n_margins"], 1))]}


def deepest(clearance: Clearance) -> sp.Expr:
    """The penetration beyond which contact laws mean nothing: a tenth of the bearing's radius."""
    return sp.sympify(clearance.pair.R_i) / 10


def _lengths(model: Model, values: Sequence[sp.Expr]) -> list[str]:
    """A number of each joint with play, from the parameters' struct."""
    read = {s: sp.Symbol(info.home) for s, info in model.symbols.info.items() if info.home}
    return [printer.expression(sp.sympify(value).xreplace(read)) for value in values] or ["0.0"]
