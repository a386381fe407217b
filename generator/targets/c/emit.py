"""A model as C: the texts, their cffi declarations, and the names of everything in them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any

import jinja2

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.events import SIGNS
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.system import absolute
from gudgeon.generator.ir.kernels import Kernel, without_unused
from gudgeon.generator.kernels import closed_linkage, outputs
from gudgeon.generator.kernels.drive_jumps import jumps_of
from gudgeon.generator.kernels.dynamics import dynamics_kernel
from gudgeon.generator.kernels.event_functions import watched_kernel
from gudgeon.generator.kernels.laws import law_kernels
from gudgeon.generator.kernels.ledger import tell
from gudgeon.generator.kernels.projection import closing_kernel
from gudgeon.generator.kernels.time_terms import time_terms_kernel
from gudgeon.generator.solvers.kkt import KKT, NEARLY_SINGULAR, SINGULAR
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c import printer
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.newton import jacobian_code, newton_code, tangent_code
from gudgeon.generator.targets.c.play import clearance_code
from gudgeon.generator.targets.c.reduced import ReducedCode, reduced_code
from gudgeon.generator.targets.c.time_loops import Integrated, LoopCode, integrator_loops, kinematic_code

COMMON_CDEF = """\
void gudgeon_prepare(const double *given, const unsigned char *is_given, double *p);
void gudgeon_mass(const double *p, double *m);
void gudgeon_phi(double t, const double *q, const double *p, double *phi);
void gudgeon_phi_q(double t, const double *q, const double *p, double *phi_q);
void gudgeon_nu(double t, const double *q, const double *p, double *nu);
void gudgeon_gamma(double t, const double *q, const double *v, const double *p, double *gamma_rows);
void gudgeon_start_values(const double *p, double *guess, double *set, double *rates);
int gudgeon_start(double t, const double *parameters, double size, double *q, double *v, double *residual);
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
TREE_NEWTON_CDEF = NEWTON_CDEF.replace("gudgeon_jacobian", "gudgeon_tree_jacobian")
EVENTS_CDEF = """\
int gudgeon_kinematic_events(void *memory, long n, const double *t, const double *parameters, const double *q,
    const double *v, double start, int stop, signed char *side, long capacity, double *at, int *event, long *found,
    long *done);
"""
KINEMATIC_CDEF = """\
size_t gudgeon_course_size(void);
void gudgeon_course_begin(void *memory, double reach, double extent, double t_end, int (*ask)(void *), void *whom,
    double every);
void gudgeon_course_again(void *memory);
void gudgeon_course_pace(const void *memory, double *t, double *gained, long *steps);
int gudgeon_kinematic(void *memory, long n, const double *t, const double *p, double *q, double *v, double *a,
    double *phi_max, double *phi_dot_max, long *steps, long *done);
int gudgeon_kinematic_works(void *memory, long n, const double *t, const double *p, const double *q, const double *v,
    double *work, long *done);
"""
METHOD_CDEF = """\
size_t gudgeon_run_size(void);
void gudgeon_run_start(void *memory, const double *p, double t, const double *y, const double *latched);
void gudgeon_run_trace(void *memory, double *trace, long rows);
long gudgeon_run_traced(const void *memory);
void gudgeon_run_codes(void *memory, const signed char *state);
int gudgeon_rk4_run(void *memory, const double *parameters, double step, long n, const double *t, long limit,
    double *y, double *latched, signed char *state, long *done);
void gudgeon_run_sample(const void *memory, const double *p, double *y, double *latched, signed char *state);
void gudgeon_run_stop(void *memory, int stop);
void gudgeon_run_asks(void *memory, int (*ask)(void *), void *whom, double every);
void gudgeon_run_pace(const void *memory, double *gained, long *steps, long *ended);
int gudgeon_run_events(void *memory, double *t, int *event);
int gudgeon_run_impacts(void *memory, int last, double *numbers, int *joints);
void gudgeon_adaptive_setup(void *memory, int choice, const double *scale, const double *least, double fixed);
int gudgeon_adaptive_run(void *memory, const double *parameters, long n, const double *t, long limit,
    double *y, double *latched, signed char *state, long *done);
void gudgeon_run_report(const void *memory, double *t, long *counts, double *numbers, double *peaks);
typedef struct {
    long samples, numbers, limit;
    int choice, stop;
    double fixed, *t, *p, *p_motion, *size, *step, *scale, *least, *start;
    unsigned char *started, *phase;
    double *y, *latched;
    signed char *state;
    long *done;
    int *status;
    double *t_last, *last, *seconds;
    long *counts;
    double *residuals, *peaks;
    const int *ending;
} Batch;
int gudgeon_many(const void *batch, void *memory, long *current, long end);
"""
SINGLE_CDEF = "const void *gudgeon_single(void);\n"
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}  # of which each rate is the derivative


def emit(model: Model, formulation: str = "reduced") -> KernelSource:
    """The whole scene as C text with its description.

    What is integrated, or followed where no freedom is left, is the reduced formulation, or with "full" the
    absolute one. Outputs and starts are absolute in both.
    """
    integrates = bool(model.degrees_of_freedom or model.clearances or model.frictions)
    system = absolute(model)
    kkt = KKT(system)
    dynamics = dynamics_kernel(system, kkt)
    around = [
        closed_linkage.mass_kernel(model), *closed_linkage.row_kernels(model), closed_linkage.start_kernel(model),
        outputs.outputs_kernel(model),
    ]  # fmt: skip
    # rendered before `prepare`, which lists what the others derived
    clearances = [clearance_code(model, clearance, render) for clearance in model.clearances]
    reduced = reduced_code(model, kkt.pivots, render, _kernels) if formulation == "reduced" else None
    watched = watched_kernel(dynamics, model)
    right_hand_side = [dynamics, *([watched] if watched and formulation == "full" and integrates else [])]
    plain = Integrated(system, kkt, _angles(model), False, lambda kernel: kernel, watched, jumps_of(dynamics, model),
                       render("motion/motion_full.c.jinja"), kkt.pivots)  # fmt: skip
    integrated = reduced.integrated if reduced else plain
    counts, terms = _counts(model, integrated), time_terms_kernel(dynamics)
    if integrates:
        loops, beside = _loops(model, integrated, reduced, terms, counts)
    else:
        loops, beside = kinematic_code(model, kkt, integrated, terms, watched, counts, render), {}
    prepare = closed_linkage.prepare_kernel(model, printer.expression)
    kernels = [*right_hand_side, *around, *(reduced.kernels if reduced else ()), prepare, *loops.kernels]
    files = _files(model, counts, prepare, around, right_hand_side, clearances)
    files |= {**(reduced.files if reduced else {}), **loops.files}
    overflows = any("finite_slope(" in text for text in (*files.values(), *beside.values()))
    files["model.h"] = render("scene/model.h.jinja", **_header(model), **counts, overflows=overflows)
    files["scene.c"] = "".join(f'#include "{name}"\n' for name in files)
    return describe(
        model, files=files | beside, main="scene.c", cdef=_cdef(reduced, integrates, files, beside),
        methods=("rk4", "dop853", "rodas5p") if integrates else ("kinematic",),
        pivots=kkt.pivots, start_pivots=loops.pivots, motion_pivots=integrated.pivots,
        operations=_operations(model, kernels),
        tree=reduced.system.unknowns if reduced else (), chain=integrated.chain,
        closures=tuple(row.name for row in reduced.system.rows) if reduced else (), formulation=formulation,
        story=tell(model, kkt, loops.solved, integrated.system, loops.groups),
        lanes=lanes_code.MAIN if beside else "",
    )  # fmt: skip


def _cdef(reduced: ReducedCode | None, integrates: bool, files: Collection[str], beside: Collection[str]) -> str:
    """What Python calls, as cffi reads it."""
    cdef = COMMON_CDEF + (reduced.cdef if reduced else "") + (METHOD_CDEF if integrates else KINEMATIC_CDEF)
    cdef += SINGLE_CDEF * bool(beside)
    cdef += (TREE_NEWTON_CDEF if reduced else NEWTON_CDEF) * integrates
    return cdef + EVENTS_CDEF * ("kinematic_events.c" in files)


def _files(
    model: Model, counts: Mapping[str, int], prepare: Kernel, around: Iterable[Kernel],
    right_hand_side: Iterable[Kernel], clearances: Sequence[str],
) -> dict[str, str]:  # fmt: skip
    """What every scene has, in the order in which it is read."""
    return {
        "model.h": "",  # when the others are known
        "asked.c": render("scene/asked.c.jinja"),
        "trigonometry.c": render("scene/trigonometry.c.jinja", vector="Four", bits="FourBits", given="*angle"),
        "parameters.c": _kernels(prepare),
        "constraints.c": _kernels(*around),
        "clearance.c": "\n".join(clearances) or "/* No joint has play. */\n",
        **({"singular.c": _singular(model, counts)} if model.rows and not model.frictions else {}),
        "dynamics.c": _kernels(*right_hand_side),
        "system.c": render("scene/calls.c.jinja", **counts),
        "start.c": _start(model),
    }


def _angles(model: Model) -> tuple[int, ...]:
    return tuple(int(model.symbols.info[q].meaning.endswith(".theta")) for q in model.q)


def _loops(
    model: Model, integrated: Integrated, reduced: ReducedCode | None, terms: Kernel | None, counts: Mapping[str, int]
) -> tuple[LoopCode, dict[str, str]]:
    """The methods, and the files of a library beside: runs side by side."""
    linearized, kernels = _newton(model, integrated)
    closing = closing_kernel(integrated.system)
    lanes = reduced is not None and reduced.system.chain is None and lanes_code.has_lanes(model)
    files = integrator_loops(model, integrated, linearized, closing, terms, counts, render, lanes)
    beside = {}
    if reduced is not None and lanes:
        beside = lanes_code.lanes_code(
            model, (*reduced.plain, without_unused(closing)),
            {**counts, "n_corners": integrated.jumps.count if integrated.jumps else 0}, render,
        )  # fmt: skip
    return LoopCode(files, tuple(kernels), integrated.kkt), beside


def _newton(model: Model, integrated: Integrated) -> tuple[str, list[Kernel]]:
    """The linearized equations: Newton's matrix, Jacobian."""
    tangents, slopes = tangent_code(model, render)
    text, kernels = newton_code(integrated.system, render)
    return tangents + text + jacobian_code(model, integrated, render), [*kernels, *slopes]


def render(name: str, /, **values: Any) -> str:
    """A template with its substitutions; an undefined one is an error."""
    return _environment().get_template(name).render(**values) + "\n"


@cache
def _environment() -> jinja2.Environment:
    """One for all scenes: reading the templates takes half of the time that a small scene takes."""

    def load(name: str) -> str:
        return resources.files("gudgeon.templates").joinpath("c", name).read_text(encoding="utf-8")

    return jinja2.Environment(
        loader=jinja2.FunctionLoader(load), undefined=jinja2.StrictUndefined, autoescape=False, trim_blocks=True
    )


def _kernels(*kernels: Kernel) -> str:
    return render("scene/kernels.c.jinja", kernels=[printer.kernel(kernel) for kernel in kernels])


def _counts(model: Model, integrated: Integrated) -> dict[str, int]:
    system = integrated.system
    switches = max(model.symbols.switches.count, system.model.symbols.switches.count)
    return {
        "n_q": len(model.q),
        "n_rows": len(model.rows),
        "n_all_rows": len(model.all_rows),
        "n_joints": len(outputs.kept_joints(model)),
        "n_drives": len(model.scene.mechanism.drives),
        "n_clearances": len(model.clearances),
        "n_frictions": len(model.frictions),
        "n_switches": switches,
        "n_x": len(system.q),
        "n_loops": len(system.rows),
        "n_chain": len(system.known),
        "n_led": len(system.known) + 2 * len(chain.directions) if (chain := integrated.chain) else 0,
        "n_memory": len(model.clearances) + len(model.frictions),
        "n_margins": len(model.clearances) + switches + len(model.frictions) + len(model.events),
        "n_events": len(model.events),
        "n_series": len(outputs.element_series(model)),
    }


def _header(model: Model) -> dict[str, Any]:
    mechanism, info = model.scene.mechanism, model.symbols.info
    slots = [(entry.symbol.name, printer.comment_text(entry.address)) for entry in model.slots.entries.values()]
    derived = [(symbol.name, printer.comment_text(info[symbol].meaning)) for symbol in model.slots.derived]
    return {
        "title": printer.comment_text(mechanism.title or mechanism.name), "mechanism": mechanism.name,
        "scene": model.scene.name, "sha256": mechanism.sha256, "parameters": slots + derived,
        "event_directions": [SIGNS[event.direction] for event in model.events] or [0],
        "event_stops": [int(event.action == "stop") for event in model.events] or [0],
    }  # fmt: skip


def _singular(model: Model, counts: Mapping[str, int]) -> str:
    place = {row.name: r for r, row in enumerate(model.all_rows)}
    return render("scene/singular.c.jinja", kept=[place[row.name] for row in model.rows], singular=SINGULAR,
        nearly=NEARLY_SINGULAR, **counts)


def _start(model: Model) -> str:
    place = {model.symbols.info[q].meaning: k for k, q in enumerate(model.q)}
    start = model.scene.mechanism.start
    return render(
        "scene/start.c.jinja", guess=[place[name] for name in start.guess], fixed=[place[name] for name in start.set],
        rates=[place[f"{name.partition('.')[0]}.{_POSITION[name.partition('.')[2]]}"] for name in start.rates],
        lengths=[int(row.unit == "m") for row in model.all_rows],
    )  # fmt: skip


def _operations(model: Model, kernels: list[Kernel]) -> dict[str, int]:
    laws = [kernel for clearance in model.clearances for kernel in law_kernels(model, clearance)]
    return {kernel.name: kernel.operations for kernel in [*kernels, *laws]}
