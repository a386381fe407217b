"""A model as C: the texts, their cffi declarations, and the names of everything in them."""

from __future__ import annotations

from importlib import resources
from typing import Any

import jinja2
import sympy as sp

from gudgeon.generator import interface
from gudgeon.generator.dynamics import dynamics_kernel, projection_kernel
from gudgeon.generator.kernels import Kernel
from gudgeon.generator.kkt import KKT, NEARLY_SINGULAR, SINGULAR
from gudgeon.generator.law_kernels import law_kernels
from gudgeon.generator.model import Model
from gudgeon.generator.system import absolute
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.clearance_code import clearance_code
from gudgeon.generator.targets.c.describe import describe
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
void gudgeon_run_report(const void *memory, double *t, long *counts, double *numbers, double *peaks);
""",
}


def emit(model: Model) -> KernelSource:
    """The whole scene as C text with its description."""
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
    reduced = reduced_code(model, render, _kernels)
    prepare = interface.prepare_kernel(model, printer.expression)
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
        f"{method}.c": _method(model, kkt, method),
    }
    files["scene.c"] = "".join(f'#include "{name}"\n' for name in files)
    return describe(
        model, files=files, main="scene.c", cdef=COMMON_CDEF + reduced.cdef + METHOD_CDEF[method], methods=(method,),
        pivots=kkt.pivots, start_pivots=start_pivots,
        operations=_operations(model, [dynamics, *around, *reduced.kernels, prepare]),
        tree=reduced.system.unknowns, closures=tuple(row.name for row in reduced.system.rows),
    )  # fmt: skip


def _method(model: Model, kkt: KKT, method: str) -> str:
    """The time loop."""
    pivots = _friction_pivots(kkt)
    friction = (render("friction.c.jinja", pivots=pivots) if pivots else render("no_friction.c.jinja")).strip()
    return render(f"{method}.c.jinja", **_counts(model), floors=_floors(model), friction_events=friction)


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


def _operations(model: Model, kernels: list[Kernel]) -> dict[str, int]:
    laws = [kernel for clearance in model.clearances for kernel in law_kernels(model.symbols, clearance)]
    return {kernel.name: kernel.operations for kernel in [*kernels, *laws]}
