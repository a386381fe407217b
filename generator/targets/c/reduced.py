"""The C of the reduced formulation, beside the absolute one in the same library."""

from __future__ import annotations

from collections.abc import Callable

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.program import Program, TreeFunctions
from gudgeon.generator.reduction.reduction import TreeSystem

Render = Callable[..., str]

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


def reduced_cdef(tree: TreeFunctions) -> str:
    """What Python calls, as cffi reads it."""
    return CDEF + RESCUE_CDEF * tree.rescued + CHAIN_CDEF * bool(tree.chains)


def reduced_code(model: Model, tree: TreeFunctions, render: Render, print_kernels: Render) -> str:
    """The kernels in tree coordinates, the way there and back, and the calls from outside."""
    parts = [print_kernels(*tree.around)]
    if tree.rescued:
        parts.append(render("motion/rescue.c.jinja", multipliers=_multipliers(model, tree.system)))
    parts.append(print_kernels(*tree.kernels))
    if tree.chains is None:
        parts.append(render("motion/reduced_calls.c.jinja", rescued=tree.rescued))
    return "\n".join(parts)


def motion_code(program: Program, render: Render, print_kernels: Render) -> str:
    """The motion that is integrated, and what evaluates driven chains with it.

    These are followed from state to state, so that a status of theirs counts on behind the pivots.
    """
    tree = program.tree
    if tree is None:
        return render("motion/motion_full.c.jinja")
    if (chains := tree.chains) is None:
        return render("motion/motion_reduced.c.jinja")
    kernels = print_kernels(*chains.kernels)
    if chains.square.largest > 2:
        kernels = render("scene/block.c.jinja", most=chains.square.largest) + kernels
    smooth, pivots = not chains.corners, len(program.integrated.pivots) - len(chains.chain.rows)
    return "\n".join([
        render("motion/chain.c.jinja", kernels=kernels, shares=chains.shares(), smooth=smooth, pivots=pivots,
               turned=chains.turned()),
        render("motion/motion_chain.c.jinja", smooth=smooth),
        render("motion/chain_calls.c.jinja", rescued=tree.rescued),
    ])  # fmt: skip


def _multipliers(model: Model, system: TreeSystem) -> list[str]:
    """Each closure's multiplier in those of the absolute rows."""
    place = {row.name: r for r, row in enumerate(model.rows)}
    return [
        " ".join(f"{'+' if sign > 0 else '-'} whole.lambda[{place[name]}]" for name, sign in shares.items())
        for shares in (system.tree.multiplier(row.name) for row in system.rows)
    ]
