"""Record of how the generator reduced a scene's equations; fields in runtime/contract/reduction_log.py."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from gudgeon.contract import reduction_log as message
from gudgeon.contract.reduction_log import Group, ReductionLog, ReductionStep, Solve, TreeBody
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.system import System
from gudgeon.generator.reduction.frames import CONSTANT, Affine
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.reduction.tree import Tree, TreeEdge
from gudgeon.generator.solvers.kkt import KKT
from gudgeon.generator.solvers.sparsity import Block


def build_reduction_log(
    model: Model, absolute_kkt: KKT, solved_kkt: KKT | None, system: System, blocks: Sequence[Block]
) -> ReductionLog:
    """Return the record of the coordinates and constraint equations that the generator has eliminated, and how.

    `absolute_kkt`: the KKT matrix in absolute coordinates; `solved_kkt`: that of the right-hand side, or None;
    `system`: the system that is integrated. `blocks`: the groups of equations that are solved one after the other where
    no degree of freedom is left.
    """
    tree = system.tree if isinstance(system, TreeSystem) else None
    steps = [
        *_list_removal_steps(model),
        *(_make_reduction_steps(model, system) if isinstance(system, TreeSystem) else ()),
    ]
    unknown_names = _list_unknown_names(model, system)
    return ReductionLog(
        coordinates=tuple(model.symbols.info[q].meaning for q in model.q),
        rows=tuple(row.name for row in model.all_rows),
        jacobian=sum(len(row.phi_q) for row in model.rows),
        steps=tuple(step for step in steps if step.owners),
        tree=tuple(TreeBody(x.body, x.parent, x.joint.name if x.joint else "") for x in tree.edges) if tree else (),
        costs=tree.costs if tree else (),
        before=_measure_factorization(absolute_kkt),
        after=_measure_factorization(solved_kkt) if solved_kkt else None,
        groups=tuple(
            Group(tuple(system.rows[r].name for r in block.rows), tuple(unknown_names[k] for k in block.columns))
            for block in blocks
        ),
    )


def _list_unknown_names(model: Model, system: System) -> tuple[str, ...]:
    """Return the names of the unknowns of a system: tree coordinates, or else all absolute coordinates."""
    if isinstance(system, TreeSystem):
        return system.unknowns
    return tuple(model.symbols.info[q].meaning for q in model.q)


def _measure_factorization(kkt: KKT) -> Solve:
    """Return the size and cost of a sparse factorization, as counted by its symbolic elimination.

    These are: unknowns n, equations, non-zeros of the matrix and of L, products. Non-zeros of [M Φ_qᵀ; Φ_q 0] include
    both triangles and the diagonal of M.
    """
    elimination = kkt.elimination
    return Solve(
        kkt.n,
        len(elimination.order) - kkt.n,
        kkt.n + 2 * len(kkt.entries),
        sum(map(len, elimination.structure.values())),
        elimination.products,
    )


def _list_removal_steps(model: Model) -> Iterator[ReductionStep]:
    """Yield the steps from the closed linkage (all joints without play) to the equations of the scene.

    The first opens the joints with play, the second removes redundant equations; either may be empty.
    """
    dropped = model.redundancy.dropped
    open_rows = tuple(r.name for r in model.all_rows if r.owner in model.scene.play)
    yield ReductionStep(message.PLAY, tuple(model.scene.play), rows_gone=open_rows)
    owner = {row.name: row.owner for row in model.all_rows}
    yield ReductionStep(message.REDUNDANT, tuple(dict.fromkeys(owner[name] for name in dropped)), rows_gone=dropped)


def _make_reduction_steps(model: Model, system: TreeSystem) -> Iterator[ReductionStep]:
    """Yield the steps from the absolute constraint equations to the loop closures of the tree.

    They eliminate angles, exchange pairs of bodies at shared points, and eliminate joints of the tree, slides that
    others determine, and loops that drives determine. Some may be empty.
    """
    yield from _make_angle_steps(model, system.tree)
    yield from _make_shared_point_steps(system.tree)
    tree_edges = [tree_edge for tree_edge in system.tree.edges if tree_edge.joint]
    for step_kind in (message.HINGES, message.SLIDES):
        matching_edges = [tree_edge for tree_edge in tree_edges if tree_edge.slides == (step_kind == message.SLIDES)]
        yield ReductionStep(
            step_kind,
            _list_joint_names(matching_edges),
            tuple(f"{tree_edge.body}.{axis}" for tree_edge in matching_edges for axis in "xy"),
            tuple(name for tree_edge in matching_edges for name in tree_edge.coordinates),
            tuple(row for tree_edge in matching_edges for row in tree_edge.satisfied_rows),
        )
    if system.slides:
        names = dict.fromkeys(k for expression in system.slides.values() for k in expression if k != CONSTANT)
        yield ReductionStep(
            message.KNOWN, tuple(names) or tuple(system.slides), tuple(system.slides), rows_gone=system.slide_rows
        )
    if system.driven_loops:
        rows = tuple(row.name for row in system.driven_loops.rows)
        removed = tuple(name if "." in name else f"{name}.theta" for name in system.driven_loops.names)
        yield ReductionStep(
            message.CHAIN, tuple(dict.fromkeys(row.owner for row in system.driven_loops.rows)), removed, rows_gone=rows
        )


def _list_joint_names(tree_edges: Iterable[TreeEdge]) -> tuple[str, ...]:
    """Return the names of the joints of some edges of the spanning tree; an edge without joint is left out."""
    return tuple(tree_edge.joint.name for tree_edge in tree_edges if tree_edge.joint)


def _make_angle_steps(model: Model, tree: Tree) -> Iterator[ReductionStep]:
    """Yield three steps, the elimination of prescribed, of constant and of dependent angles; each may be empty.

    Each equation used has eliminated one angle. Its name is in the field `rows_gone` of the step. A prescribed angle
    follows from drives alone, a dependent one also from other angles.
    """
    drives = model.scene.mechanism.drives

    def classify_angle(coefficients: Affine) -> str:
        """Return the kind of an angle: prescribed by drives, constant, or dependent on other angles.

        `coefficients`: those of the affine expression of the angle, by drive, angle or CONSTANT.
        """
        keys = [k for k in coefficients if k != CONSTANT]
        if any(k not in drives for k in keys):
            return message.DEPENDENT
        return message.PRESCRIBED if keys else message.CONSTANT

    owner = {row.name: row.owner for row in model.all_rows}
    for angle_kind in (message.PRESCRIBED, message.CONSTANT, message.DEPENDENT):
        rows = {row: body for row, body in tree.solved.items() if classify_angle(tree.angles[body]) == angle_kind}
        names = dict.fromkeys(k for body in rows.values() for k in tree.angles[body] if k != CONSTANT)
        yield ReductionStep(
            angle_kind,
            tuple(names) or tuple(dict.fromkeys(owner[row] for row in rows)),
            tuple(f"{body}.theta" for body in rows.values()),
            rows_gone=tuple(rows),
        )


def _make_shared_point_steps(tree: Tree) -> Iterator[ReductionStep]:
    """Yield for each shared point (multiple joint) the exchange of the file's pairs of bodies for those in use.

    A shared point is one at which three or more bodies meet. Pairs in use are those of tree and closures. Points whose
    pairs all stay are left out.
    """
    for multiple_joint in tree.multiple_joints:
        joints_in_use = [tree_edge.joint for tree_edge in tree.edges if tree_edge.joint in multiple_joint.pairs]
        joints_in_use += [joint for joint in tree.closing_pairs if joint in multiple_joint.pairs]
        added_rows = tuple(
            row
            for joint in joints_in_use
            if joint and joint not in multiple_joint.joints
            for row in multiple_joint.list_pair_rows(joint)
        )
        removed_rows = tuple(
            row
            for joint in multiple_joint.joints
            if joint not in joints_in_use
            for row in multiple_joint.list_pair_rows(joint)
        )
        if removed_rows:
            yield ReductionStep(
                message.HUB,
                tuple(joint.name for joint in multiple_joint.joints),
                rows_gone=removed_rows,
                rows_come=added_rows,
            )
