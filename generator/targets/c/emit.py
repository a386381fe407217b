"""A model as C: the texts, their cffi declarations, and the names of everything in them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cache
from importlib import resources
from typing import Any

import jinja2

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.events import SIGNS
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.notes import has_jumps
from gudgeon.generator.ir.finite_slopes import Slope
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.kernels import closed_linkage, outputs
from gudgeon.generator.kernels.ledger import tell
from gudgeon.generator.kernels.program import Integrated, Program
from gudgeon.generator.solvers.kkt import NEARLY_SINGULAR, SINGULAR
from gudgeon.generator.targets.c import functions, printer, readme
from gudgeon.generator.targets.c import lanes as lanes_code
from gudgeon.generator.targets.c.describe import describe
from gudgeon.generator.targets.c.fields import parameter_fields
from gudgeon.generator.targets.c.layout import within
from gudgeon.generator.targets.c.newton import jacobian_code, newton_code, tangent_code
from gudgeon.generator.targets.c.play import clearances_code
from gudgeon.generator.targets.c.reduced import motion_code, reduced_cdef, reduced_code
from gudgeon.generator.targets.c.time_loops import integrator_loops, kinematic_code

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


def emit(program: Program) -> KernelSource:
    """The whole scene as C text with its description."""
    model, tree, integrated = program.model, program.tree, program.integrated
    counts = _counts(model, integrated)
    prepare = closed_linkage.prepare_kernel(model)
    files = _files(program, counts, prepare)
    if tree:
        files["reduced.c"] = reduced_code(model, tree, render, _kernels)
    files |= _loops(program, counts) if program.methods else kinematic_code(program, counts, render)
    beside = lanes_code.lanes_code(program, counts | _jumps(integrated), render) if program.has_lanes else {}
    files = {name: within(text) for name, text in files.items()}
    files["scene.c"] = "".join(f'#include "{name}"\n' for name in files)
    beside = {name: within(text) for name, text in beside.items()}
    files[readme.NAME] = readme.readme(program, files | beside)
    course = program.course
    return describe(
        model, files=files | beside, main="scene.c", cdef=_cdef(program, files),
        methods=("rk4", "dop853", "rodas5p") if program.methods else ("kinematic",),
        pivots=program.kkt.pivots, start_pivots=course.pivots if course else (), motion_pivots=integrated.pivots,
        operations=_operations(program, prepare),
        tree=tree.system.unknowns if tree else (), chain=integrated.chain,
        closures=tuple(row.name for row in tree.system.rows) if tree else (), formulation=program.formulation,
        story=tell(
            model, program.kkt, course.solved if course else integrated.kkt, integrated.system,
            course.groups if course else (),
        ),
        lanes=lanes_code.MAIN if beside else "",
    )  # fmt: skip


def _cdef(program: Program, files: Collection[str]) -> str:
    """What Python calls, as cffi reads it."""
    cdef = COMMON_CDEF + (reduced_cdef(program.tree) if program.tree else "")
    cdef += (METHOD_CDEF if program.integrates else KINEMATIC_CDEF) + SINGLE_CDEF * program.has_lanes
    cdef += (TREE_NEWTON_CDEF if program.tree else NEWTON_CDEF) * program.integrates
    return cdef + EVENTS_CDEF * ("kinematic_events.c" in files)


def _files(program: Program, counts: Mapping[str, int], prepare: Kernel) -> dict[str, str]:
    """What every scene has, in the order in which it is read."""
    model = program.model
    return {
        "model.h": render("scene/model.h.jinja", **_header(model), **counts, overflows=_overflows(program)),
        "asked.c": render("scene/asked.c.jinja"),
        "trigonometry.c": render("scene/trigonometry.c.jinja", vector="Four", bits="FourBits", given="*angle"),
        "parameters.c": _kernels(prepare),
        "constraints.c": _kernels(*program.closed),
        "clearance.c": clearances_code(program, render),
        **({"singular.c": _singular(model, counts)} if model.rows and not model.frictions else {}),
        "dynamics.c": _kernels(*program.right_hand_side),
        "system.c": render("scene/calls.c.jinja", **counts),
        "start.c": _start(model),
    }


def _loops(program: Program, counts: Mapping[str, int]) -> dict[str, str]:
    """The methods, with the linearized equations (Newton's matrix, Jacobian)."""
    methods = program.methods
    assert methods
    linearized = tangent_code(program.pins, methods, render) + newton_code(methods.newton, render)
    linearized += jacobian_code(program.integrated, methods.gains, render)
    return integrator_loops(program, motion_code(program, render, _kernels), linearized, counts, render)


def _jumps(integrated: Integrated) -> dict[str, int]:
    return {"n_corners": integrated.jumps.count if integrated.jumps else 0}


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
    return render("scene/kernels.c.jinja", kernels=[functions.kernel(kernel) for kernel in kernels])


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
    mechanism = model.scene.mechanism
    return {
        "title": printer.comment_text(mechanism.title or mechanism.name), "mechanism": mechanism.name,
        "scene": model.scene.name, "sha256": mechanism.sha256, "parameters": parameter_fields(model.slots),
        "event_directions": [SIGNS[event.direction] for event in model.events] or [0],
        "event_stops": [int(event.action == "stop") for event in model.events] or [0],
        "jumps": has_jumps(model),
    }  # fmt: skip


def _singular(model: Model, counts: Mapping[str, int]) -> str:
    place = {row.name: r for r, row in enumerate(model.all_rows)}
    return render(
        "scene/singular.c.jinja",
        kept=[place[row.name] for row in model.rows],
        singular=SINGULAR,
        nearly=NEARLY_SINGULAR,
        **counts,
    )


def _start(model: Model) -> str:
    place = {model.symbols.info[q].meaning: k for k, q in enumerate(model.q)}
    start = model.scene.mechanism.start
    return render(
        "scene/start.c.jinja", guess=[place[name] for name in start.guess], fixed=[place[name] for name in start.set],
        rates=[place[f"{name.partition('.')[0]}.{_POSITION[name.partition('.')[2]]}"] for name in start.rates],
        lengths=[int(row.unit == "m") for row in model.all_rows], jumps=has_jumps(model),
    )  # fmt: skip


def _overflows(program: Program) -> bool:
    """Whether any slope is finite where what it is made of is not."""
    closing = [program.methods.closing] if program.methods else []
    return any(kernel.has(Slope) for kernel in (*_all(program), *closing))


def _all(program: Program, *prepare: Kernel) -> list[Kernel]:
    tree, extra = program.tree, program.methods or program.course
    kernels = [*program.right_hand_side, *program.closed, *(tree.every if tree else ()), *prepare]
    return [*kernels, *(extra.kernels if extra else ()), *program.laws]


def _operations(program: Program, prepare: Kernel) -> dict[str, int]:
    """Of each function, as `check -v` tells them; of laws those of each joint."""
    calls = [(pin.clearance.name, *call) for pin in program.pins for call in pin.laws.items()]
    laws = {f"{role}_{joint}_force": call.kernel for joint, role, call in calls}
    own = {kernel.name: kernel for kernel in _all(program, prepare) if kernel not in program.laws}
    return {name: kernel.operations for name, kernel in (own | laws).items()}
