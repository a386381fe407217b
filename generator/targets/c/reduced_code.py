"""The C of the reduced formulation, beside the absolute one in the same library."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from gudgeon.generator.kernels import Kernel, without_unused
from gudgeon.generator.model import Model
from gudgeon.generator.reduced_kernels import is_rescued, motion_kernels, reduced_kernels
from gudgeon.generator.reduction import TreeSystem, reduce
from gudgeon.generator.sine_pairs import side_by_side
from gudgeon.generator.targets.c.loops import Integrated
from gudgeon.generator.watched import NAME as WATCHED

CDEF = """\
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v);
void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v);
int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *memory, const double *p, double *a,
    double *lambda, double *power);
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot);
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x);
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *memory,
    const double *p);
"""
RESCUE_CDEF = """\
int gudgeon_reduced_rescue(double t, const double *q, const double *v, const double *memory, const double *p,
    double *a);
"""


@dataclass(frozen=True)
class ReducedCode:
    """`files` go behind system.c; `plain` are the kernels of the motion before sines are put side by side."""

    system: TreeSystem
    files: Mapping[str, str]
    cdef: str
    kernels: tuple[Kernel, ...]
    integrated: Integrated
    plain: tuple[Kernel, ...]


def reduced_code(model: Model, render: Callable[..., str], print_kernels: Callable[..., str]) -> ReducedCode:
    """Derives the reduced formulation. Everything absolute must have been derived before: names of parameters."""
    system = reduce(model)
    around = motion_kernels(model, system)
    plain, kkt = reduced_kernels(system)
    kernels = [side_by_side(kernel) for kernel in plain]
    rescued = is_rescued(system)
    parts = [print_kernels(*around)]
    if rescued:
        parts.append(render("rescue.c.jinja", multipliers=_multipliers(model, system)))
    parts += [print_kernels(*kernels), render("reduced_calls.c.jinja", rescued=rescued)]
    cdef = CDEF + (RESCUE_CDEF if rescued else "")
    angles = tuple(int("." not in name) for name in system.unknowns)
    integrated = Integrated(
        system, kkt, angles, True, lambda kernel: side_by_side(without_unused(kernel)),
        any(kernel.name == WATCHED for kernel in kernels),
    )
    return ReducedCode(system, {"reduced.c": "\n".join(parts)}, cdef, (*around, *kernels), integrated, tuple(plain))


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} whole.lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]
