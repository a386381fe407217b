"""Comment at the beginning of the emitted reduced.c: spanning tree, unknowns, loop closures, storage."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from gudgeon.generator.kernels.dynamics import format_coordinate_name
from gudgeon.generator.reduction.frames import CONSTANT
from gudgeon.generator.reduction.reduction import TreeSystem
from gudgeon.generator.reduction.tree import TreeEdge

_MAX_LISTED_ITEMS = 40  # bodies, unknowns or closures


def describe_reduced_file(system: TreeSystem) -> list[str]:
    """Return the lines of the comment at the beginning of reduced.c.

    They list the spanning tree, the unknowns with their indices, the loop closures with their multipliers, and the
    joints with play.
    """
    tree, unknowns = system.tree, list(map(format_coordinate_name, system.unknowns))
    tree_edges = [
        f"{tree_edge.body}: {_describe_position(tree_edge)}; {_describe_angle(system, tree_edge.body)}"
        for tree_edge in tree.edges
    ]
    stored_coordinates = [f"q[{k}] = {name} ({_get_coordinate_unit(name)})" for k, name in enumerate(unknowns)]
    if system.driven_loops:
        names = map(format_coordinate_name, system.driven_loops.names)
        stored_coordinates += [f"q[{k}] = {name}, dependent" for k, name in enumerate(names, len(unknowns))]
    closures = [f"rhs->lambda[{r}] of {row.name}" for r, row in enumerate(system.rows)]
    joints = [f"rhs->clearance[{i}] of {c.name}" for i, c in enumerate(system.model.clearances)]
    return [
        "The reduced formulation: equations of motion in the coordinates s of a spanning tree of the bodies,",
        "M a + Phi_q^T lambda = g and Phi_q a = gamma with q = s. Joints outside the tree are the loop closures Phi.",
        "",
        "Tree, parents first (body: how it is positioned; its angle):",
        *_format_comment_list(tree_edges, "\n"),
        "Unknowns, with rates in v and accelerations in a at the same index:",
        *_format_comment_list(stored_coordinates or ["none"]),
        "Loop closures, with the storage of their multipliers:",
        *_format_comment_list(closures or ["none"]),
        *(["Joints with play, whose forces are applied loads:", *_format_comment_list(joints)] if joints else []),
        "",
        "expand: state of the tree to all_q, all_v of the bodies (x, y, theta each, as in constraints.c).",
        "reduce_state: the opposite direction. closures, closure_rates: Phi and its rate.",
        "reduced_dynamics: the right-hand side. reduced_project: the smallest change that satisfies the closures.",
    ]


def _describe_position(tree_edge: TreeEdge) -> str:
    """Return in words how an edge of the spanning tree positions its body: freely, or on its parent by a joint."""
    if tree_edge.joint is None:
        return "moves freely, x and y are unknowns"
    displacement = f", displaced by {tree_edge.coordinates[0]}" if tree_edge.slides else ""
    return f"on {tree_edge.parent} by {tree_edge.joint.name}{displacement}"


def _describe_angle(system: TreeSystem, body: str) -> str:
    """Return in words what the angle of a body is: unknown, prescribed, constant or dependent."""
    terms = [name for name in system.tree.angles[body] if name != CONSTANT]
    if terms == [body]:
        dependent_names = system.driven_loops.names if system.driven_loops else ()
        return "its angle is dependent" if body in dependent_names else "its angle is an unknown"
    if not terms:
        return "its angle is constant"
    drives = system.model.scene.mechanism.drives
    kind = "prescribed by" if all(name in drives for name in terms) else "a function of"
    return f"its angle is {kind} {', '.join(terms)}"


def _get_coordinate_unit(name: str) -> str:
    """Return the unit of a tree coordinate: "rad" for an angle, "m" for others."""
    return "rad" if name.endswith(".theta") else "m"


def _format_comment_list(items: Sequence[str], separator: str = "; ") -> list[str]:
    """Return items as indented comment lines: one per line if `separator` is a line break, else joined and wrapped.

    Lines break between items only. Of more than _MAX_LISTED_ITEMS items, the first ones and "and N more" are printed.
    """
    shown_items = [
        *items[:_MAX_LISTED_ITEMS],
        *([f"and {len(items) - _MAX_LISTED_ITEMS} more"] if len(items) > _MAX_LISTED_ITEMS else []),
    ]
    joined = separator.join(item.replace(" ", "\0") for item in shown_items)
    lines = shown_items if separator == "\n" else textwrap.wrap(joined, 104)
    return ["    " + line.replace("\0", " ") for line in lines]
