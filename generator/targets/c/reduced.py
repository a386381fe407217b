"""The C of the reduced formulation, beside the absolute one in the same library."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel, without_unused
from gudgeon.generator.ir.sine_pairs import side_by_side
from gudgeon.generator.kernels.drive_jumps import jumps_of
from gudgeon.generator.kernels.driven_chains import ChainKernels
from gudgeon.generator.kernels.event_functions import NAME as WATCHED
from gudgeon.generator.kernels.reduced import DYNAMICS, is_rescued, motion_kernels, reduced_kernels
from gudgeon.generator.reduction.reduction import TreeSystem, reduce
from gudgeon.generator.targets.c.time_loops import Integrated

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
CHAIN_CDEF = """\
int gudgeon_chains(double t, double *q, const double *p, double *v);
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


def reduced_code(
    model: Model, pivots: tuple[str, ...], render: Callable[..., str], print_kernels: Callable[..., str]
) -> ReducedCode:
    """Derives the reduced formulation. Everything absolute must have been derived before: names of parameters.

    `pivots`: rows through which a status of the absolute formulation counts.
    """
    system = reduce(model)
    around = [side_by_side(without_unused(kernel)) for kernel in motion_kernels(model, system)]
    plain, kkt = reduced_kernels(system)
    kernels = [side_by_side(kernel) for kernel in plain]
    rescued = is_rescued(system)
    parts = [print_kernels(*around)]
    if rescued:
        parts.append(render("motion/rescue.c.jinja", multipliers=_multipliers(model, system)))
    parts.append(print_kernels(*kernels))
    cdef = CDEF + (RESCUE_CDEF if rescued else "") + (CHAIN_CDEF if system.chain else "")
    angles = tuple(int("." not in name) for name in system.unknowns)
    if not rescued:
        pivots = kkt.pivots
    if system.chain is None:
        parts.append(render("motion/reduced_calls.c.jinja", rescued=rescued))
        motion, own = render("motion/motion_reduced.c.jinja"), []
    else:
        chains = ChainKernels(system, system.chain)
        motion, own = _chain_code(chains, len(pivots), rescued, render, print_kernels), chains.kernels
        pivots = (*pivots, *(row.name for row in system.chain.rows))
    integrated = Integrated(
        system, kkt, angles, True, lambda kernel: side_by_side(without_unused(kernel)),
        next((kernel for kernel in plain if kernel.name == WATCHED), None),
        next((jumps_of(kernel, model) for kernel in plain if kernel.name == DYNAMICS), None), motion, pivots,
        system.chain,
    )  # fmt: skip
    every = (*around, *kernels, *own)
    return ReducedCode(system, {"reduced.c": "\n".join(parts)}, cdef, every, integrated, tuple(plain))


def _chain_code(
    chains: ChainKernels, pivots: int, rescued: bool, render: Callable[..., str], print_kernels: Callable[..., str]
) -> str:
    """What evaluates driven chains, the motion with them, and its calls from outside; they are followed from state to

    state, so that a status of theirs counts on behind the `pivots`.
    """
    kernels = print_kernels(*chains.kernels)
    if chains.square.largest > 2:
        kernels = render("scene/block.c.jinja", most=chains.square.largest) + kernels
    smooth = not chains.corners
    return "\n".join([
        render("motion/chain.c.jinja", kernels=kernels, shares=chains.shares(), smooth=smooth, pivots=pivots,
               turned=chains.turned()),
        render("motion/motion_chain.c.jinja", smooth=smooth), render("motion/chain_calls.c.jinja", rescued=rescued),
    ])  # fmt: skip


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} whole.lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]
