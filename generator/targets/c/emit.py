"""A model as C: the texts, their cffi declarations, and the names of everything in them."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import resources
from typing import Any

import jinja2
import sympy as sp

from gudgeon.generator import interface
from gudgeon.generator.dynamics import dynamics_kernel
from gudgeon.generator.events import SIGNS
from gudgeon.generator.kernels import Kernel
from gudgeon.generator.kkt import KKT, NEARLY_SINGULAR, SINGULAR
from gudgeon.generator.law_kernels import law_kernels
from gudgeon.generator.methods import dop853, rodas5p
from gudgeon.generator.model import Model
from gudgeon.generator.projection import closing_kernel, projection_kernel
from gudgeon.generator.system import System, absolute
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.clearance_code import clearance_code
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.newton_code import jacobian_code, newton_code, tangent_code
from gudgeon.generator.targets.c.reduced_code import ReducedCode, reduced_code
from gudgeon.kernel_source import KernelSource

COMMON_CDEF = """\
void gudgeon_prepare(const double *given, const unsigned char *is_given, double *p);
void gudgeon_mass(const double *p, double *m);
void gudgeon_phi(double t, const double *q, const double *p, double *phi);
void gudgeon_phi_q(double t, const double *q, const double *p, double *phi_q);
void gudgeon_nu(double t, const double *q, const double *p, double *nu);
void gudgeon_gamma(double t, const double *q, const double *v, const double *p, double *gamma_rows);
void gudgeon_start_values(const double *p, double *guess, double *set, double *rates);
int gudgeon_rhs(double t, const double *y, const double *memory, const double *p, double *dy);
double gudgeon_time_rhs(long count, double t, const double *y, const double *memory, const double *p);
int gudgeon_evaluate(long n, const double *t, const double *q, const double *v, const double *memory,
    const double *parameters, double *a, double *lambda, double *reactions, double *torques, double *clearance,
    double *series, double *friction, double *energy, double *power, long *failed);
"""
NEWTON_CDEF = """\
int gudgeon_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t);
int gudgeon_newton(double t, const double *y, const double *memory, const double *p, double eta, double s,
    const double *r, double *u);
"""
EVENTS_CDEF = """\
int gudgeon_kinematic_events(long n, const double *t, const double *parameters, double reach, double extent,
    const double *q, const double *v, double start, int stop, signed char *side, long capacity, double *at,
    int *event, long *found, long *done);
"""
METHOD_CDEF = {
    "kinematic": """\
int gudgeon_kinematic(long n, const double *t, const double *p, double reach, double extent, double *q, double *v,
    double *phi_max, double *phi_dot_max, long *steps, long *done);
""",
    "rk4": """\
size_t gudgeon_run_size(void);
void gudgeon_run_start(void *memory, double t, const double *y, const double *latched);
void gudgeon_run_codes(void *memory, const signed char *state);
int gudgeon_run_steps(void *memory, const double *parameters, double t0, double t1, long total, long first, long count,
    long *taken);
void gudgeon_run_sample(const void *memory, double *y, double *a, double *latched, signed char *state);
int gudgeon_run_impacts(void *memory, int last, double *numbers, int *joints);
void gudgeon_adaptive_setup(void *memory, int choice, const double *scale, const double *floor, double h, double fixed);
int gudgeon_adaptive_run(void *memory, const double *parameters, long n, const double *t, long limit,
    double *y, double *a, double *latched, signed char *state, long *done);
void gudgeon_run_report(const void *memory, double *t, long *counts, double *numbers, double *peaks);
""",
}


def emit(model: Model, *, newton: bool = True) -> KernelSource:
    """The whole scene as C text with its description; `newton`: with the Jacobian, where there is integration."""
    method = "rk4" if model.degrees_of_freedom or model.clearances or model.frictions else "kinematic"
    system = absolute(model)
    kkt = KKT(system)
    dynamics = dynamics_kernel(system, kkt)
    around = [
        interface.mass_kernel(model), *interface.row_kernels(model), interface.start_kernel(model),
        interface.outputs_kernel(model),
    ]  # fmt: skip
    start_pivots: tuple[str, ...] = ()
    if method == "kinematic":
        projection, projection_kkt = projection_kernel(system, model.rows, "project")
        around.append(projection)
        start_pivots = projection_kkt.pivots
    # rendered before `prepare`, which lists what the others derived
    clearances = [clearance_code(model, clearance, render) for clearance in model.clearances]
    newton = newton and method != "kinematic"
    linearized, linear_kernels = _newton(model, system) if newton else ("", [])
    reduced = reduced_code(model, render, _kernels)
    prepare = interface.prepare_kernel(model, printer.expression)
    loops = _kinematic(model) if method == "kinematic" else _integrators(model, system, kkt, linearized)
    files = {
        "model.h": render("model.h.jinja", **_header(model, reduced)),
        "trigonometry.c": render("trigonometry.c.jinja"),
        "parameters.c": _kernels(prepare),
        "constraints.c": _kernels(*around),
        "clearance.c": "\n".join(clearances) or "/* No joint has play. */\n",
        **({"singular.c": _singular(model)} if model.rows and not model.frictions else {}),
        "dynamics.c": _kernels(dynamics),
        "system.c": render("system.c.jinja", **_counts(model)),
        **reduced.files,
        **loops,
    }
    files["scene.c"] = "".join(f'#include "{name}"\n' for name in files)
    kernels = [dynamics, *around, *reduced.kernels, prepare, *linear_kernels]
    methods = ("kinematic",) if method == "kinematic" else ("rk4", "dop853", "rodas5p")
    cdef = COMMON_CDEF + reduced.cdef + METHOD_CDEF[method] + NEWTON_CDEF * newton
    cdef += EVENTS_CDEF * ("kinematic_events.c" in files)
    return describe(
        model, files=files, main="scene.c", cdef=cdef, methods=methods, pivots=kkt.pivots,
        start_pivots=start_pivots, operations=_operations(model, kernels),
        tree=reduced.system.unknowns, closures=tuple(row.name for row in reduced.system.rows),
    )  # fmt: skip


def _kinematic(model: Model) -> dict[str, str]:
    loops = {"kinematic.c": render("kinematic.c.jinja", **_counts(model))}
    if model.events:
        loops["kinematic_events.c"] = render("kinematic_events.c.jinja")
    return loops


def _integrators(model: Model, system: System, kkt: KKT, linearized: str) -> dict[str, str]:
    """The time loops, in the order in which they call each other."""
    pivots, counts = _friction_pivots(kkt), _counts(model)
    kind = "friction" if pivots else "no_friction"
    modes, events = (render(f"{name}.c.jinja", pivots=pivots).strip() for name in (kind, f"{kind}_events"))
    common = {**counts, "floors": _floors(model), "clearances": _own_clearances(model)}
    return {
        "projection.c": _kernels(closing_kernel(system)),
        "newton.c": linearized,
        "run.c": render("run.c.jinja", **common, friction_modes=modes, angles=_angles(system)),
        "rk4.c": render("rk4.c.jinja", **common, friction_events=events),
        "step.c": render("step.c.jinja", **counts),
        "dop853.c": render("dop853.c.jinja", **_dop853()),
        "rodas5p.c": render("rodas5p.c.jinja", **_rodas5p()),
        "events.c": render("events.c.jinja", **counts),
        "adaptive.c": render("adaptive.c.jinja", **common),
    }


def _angles(system: System) -> list[int]:
    """1 for an angle, 0 for a length, by coordinate."""
    return [int(system.model.symbols.info[q].meaning.endswith(".theta")) for q in system.q]


def _dop853() -> dict[str, Any]:
    def terms(row: Mapping[int, float], of: str) -> str:
        return " + ".join(f"{value!r} * {of}[{j}][i]" for j, value in row.items())

    return {
        "nodes": dop853.C, "stages": [terms(row, "k") for row in dop853.A[1:]], "n_stages": dop853.STAGES,
        "error_3": terms(dop853.E[0], "k"), "error_5": terms(dop853.E[1], "k"),
        "dense": [terms(row, "k") for row in dop853.D],
    }  # fmt: skip


def _rodas5p() -> dict[str, Any]:
    return {
        "nodes": rodas5p.NODES, "time": rodas5p.TIME, "gamma": rodas5p.GAMMA, "a": rodas5p.A, "c": rodas5p.C,
        "dense": rodas5p.H,
    }  # fmt: skip


def _newton(model: Model, system: System) -> tuple[str, list[Kernel]]:
    """The linearized equations: Newton's matrix, Jacobian."""
    tangents, slopes = tangent_code(model, render)
    text, kernels = newton_code(system, render)
    return tangents + text + jacobian_code(model, render), [*kernels, *slopes]


def render(name: str, /, **values: Any) -> str:
    """A template with its substitutions; an undefined one is an error."""
    return _environment().get_template(name).render(**values) + "\n"


def _environment() -> jinja2.Environment:
    def load(name: str) -> str:
        return resources.files("gudgeon.templates").joinpath("c", name).read_text(encoding="utf-8")

    return jinja2.Environment(
        loader=jinja2.FunctionLoader(load), undefined=jinja2.StrictUndefined, autoescape=False, trim_blocks=True
    )


def _kernels(*kernels: Kernel) -> str:
    return render("kernels.c.jinja", kernels=[printer.kernel(kernel) for kernel in kernels])


def _counts(model: Model) -> dict[str, int]:
    return {
        "n_q": len(model.q),
        "n_rows": len(model.rows),
        "n_all_rows": len(model.all_rows),
        "n_joints": len(interface.kept_joints(model)),
        "n_drives": len(model.scene.mechanism.drives),
        "n_clearances": len(model.clearances),
        "n_frictions": len(model.frictions),
        "n_switches": len(model.symbols.switches.found),
        "n_memory": len(model.clearances) + len(model.frictions),
        "n_margins": len(model.clearances) + len(model.symbols.switches.found) + len(model.frictions),
        "n_events": len(model.events),
        "n_series": len(interface.element_series(model)),
    }


def _header(model: Model, reduced: ReducedCode) -> dict[str, Any]:
    mechanism, info = model.scene.mechanism, model.symbols.info
    slots = [(entry.symbol.name, printer.comment_text(entry.address)) for entry in model.slots.entries.values()]
    derived = [(symbol.name, printer.comment_text(info[symbol].meaning)) for symbol in model.slots.derived]
    return {
        "title": printer.comment_text(mechanism.title or mechanism.name), "mechanism": mechanism.name,
        "scene": model.scene.name, "sha256": mechanism.sha256, "parameters": slots + derived, **_counts(model),
        "n_tree": len(reduced.system.q), "n_closures": len(reduced.system.rows),
        "n_switches": max(model.symbols.switches.count, reduced.system.model.symbols.switches.count),
        "event_directions": [SIGNS[event.direction] for event in model.events] or [0],
        "event_stops": [int(event.action == "stop") for event in model.events] or [0],
    }  # fmt: skip


def _singular(model: Model) -> str:
    place = {row.name: r for r, row in enumerate(model.all_rows)}
    return render("singular.c.jinja", kept=[place[row.name] for row in model.rows], singular=SINGULAR,
        nearly=NEARLY_SINGULAR, **_counts(model))


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


def _own_clearances(model: Model) -> list[str]:
    """c of each joint with play."""
    read = {s: sp.Symbol(f"p->{s.name}") for s in model.symbols.info}
    return [printer.expression(sp.sympify(c.pair.c).xreplace(read)) for c in model.clearances] or ["0.0"]


def _operations(model: Model, kernels: list[Kernel]) -> dict[str, int]:
    laws = [kernel for clearance in model.clearances for kernel in law_kernels(model.symbols, clearance)]
    return {kernel.name: kernel.operations for kernel in [*kernels, *laws]}
