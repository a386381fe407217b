"""Describe in sentences how the equations of motion were reduced (reduction_log.py), for `gudgeon check -v`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from gudgeon.contract import reduction_log
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import KINEMATIC
from gudgeon.contract.reduction_log import ReductionLog, ReductionStep, Solve

MAX_NAMES = 16  # largest number of names that are listed in full


def describe_reduction_steps(source: KernelSource) -> Iterator[tuple[int, int, str]]:
    """Yield for each reduction step the numbers of coordinates and equations that remain, and its description.

    The first item describes the system of all bodies before the reduction.
    """
    log = source.reduction_log
    yield len(log.coordinates), len(log.rows), "x, y and angle of every body; no joint has play"
    for step, n, m in log.iterate_steps():
        yield n, m, _DESCRIPTIONS[step.kind](step)


def describe_reduced_system(source: KernelSource) -> Iterator[tuple[str, str]]:
    """Yield titles and texts on the tree, the unknowns, the linear systems and the operations of a scene.

    The tree is left out if there is none. The closures (constraint equations that remain) are left out for the full
    formulation.
    """
    log, is_reduced = source.reduction_log, source.formulation == "reduced"
    if log.tree:
        yield "tree", f"{_format_tree(log)}; {_explain_choice_of_tree(log.costs)}"
    yield (
        "unknowns",
        "; ".join(_describe_coordinates(source.tree_coordinates)) or "none"
        if is_reduced
        else "all of them: the full formulation",
    )
    if is_reduced:
        noun_phrase = "rows that stay" if len(source.closures) > 1 else "the row that stays"
        yield (
            "closures",
            f"{abbreviate_names(source.closures)}: {noun_phrase}" if source.closures else "none: no row stays",
        )
    yield "solved", _format_linear_systems(log, is_reduced)
    yield "operations", _format_operations(source)


def abbreviate_names(names: Sequence[str]) -> str:
    """Return names as "a, b, c"; more than MAX_NAMES names are abbreviated: "a, b, …, l, … (20 in all)"."""
    if len(names) <= MAX_NAMES:
        return ", ".join(names)
    return f"{', '.join(names[: MAX_NAMES - 4])}, … ({len(names)} in all)"


def _get_plural_ending(names: Sequence[str]) -> str:
    """Return the plural ending of a noun for names: "s" unless there is exactly one."""
    return "s" * (len(names) != 1)


def _get_verb_ending(names: Sequence[str]) -> str:
    """Return the ending of a verb in the present tense, for names as its subject: "s" for exactly one."""
    return "s" * (len(names) == 1)


def _list_bodies(names: Iterable[str]) -> str:
    """Return the bodies of coordinates as text, each once: "L1, L4" for "L1.theta", "L4.theta"."""
    return abbreviate_names(tuple(dict.fromkeys(name.rpartition(".")[0] for name in names)))


def _describe_joints_with_play(step: ReductionStep) -> str:
    """Describe the step that opens joints with play."""
    verb = "has" if len(step.owners) == 1 else "have"
    return f"{abbreviate_names(step.owners)} {verb} play: a force law, no rows, and no joint of the tree"


def _describe_redundant_equations(step: ReductionStep) -> str:
    """Describe the step that leaves out redundant equations."""
    return f"{abbreviate_names(step.rows_gone)} {'is' if len(step.rows_gone) == 1 else 'are'} redundant: left out"


def _format_removed_coordinates(step: ReductionStep, coordinate_kind: str) -> str:
    """Return a phrase for the coordinates that a step removes; `coordinate_kind` is their kind, "angle" or "slide"."""
    return f"the {coordinate_kind}{_get_plural_ending(step.gone)} of {_list_bodies(step.gone)}"


def _describe_dependent_coordinates(step: ReductionStep, coordinate_kind: str) -> str:
    """Describe a step in which coordinates of one kind, "angle" or "slide", follow from those of its owners."""
    subject = _format_removed_coordinates(step, coordinate_kind)
    return f"{subject} follow{_get_verb_ending(step.gone)} {abbreviate_names(step.owners)}"


def _describe_prescribed_angles(step: ReductionStep) -> str:
    """Describe the step in which drives prescribe angles."""
    subject = f"{abbreviate_names(step.owners)} prescribe{_get_verb_ending(step.owners)}"
    return f"{subject} {_format_removed_coordinates(step, 'angle')}: known at any time, not integrated"


def _describe_constant_angles(step: ReductionStep) -> str:
    """Describe the step in which joints keep angles constant."""
    subject = f"{abbreviate_names(step.owners)} keep{_get_verb_ending(step.owners)}"
    return f"{subject} {_format_removed_coordinates(step, 'angle')} constant"


def _describe_dependent_angles(step: ReductionStep) -> str:
    """Describe the step in which angles follow other angles."""
    return _describe_dependent_coordinates(step, "angle")


def _describe_shared_point(step: ReductionStep) -> str:
    """Describe the step that replaces equations of a multiple joint: several joints at one point."""
    added_bodies, removed_bodies = _list_bodies(step.rows_come), _list_bodies(step.rows_gone)
    verb = f"replace{_get_verb_ending(step.rows_come[::2])}"
    return f"{abbreviate_names(step.owners)} are a multiple joint: {added_bodies} {verb} {removed_bodies}"


def _describe_hinges(step: ReductionStep) -> str:
    """Describe the step in which hinges of the tree determine positions of bodies."""
    return f"{abbreviate_names(step.owners)}: each determines x and y of a body from angles"


def _describe_slides(step: ReductionStep) -> str:
    """Describe the step in which slides replace x and y of bodies."""
    return f"{abbreviate_names(step.owners)}: each replaces x and y of a body by one slide along its axis"


def _describe_known_slides(step: ReductionStep) -> str:
    """Describe the step in which slides become known."""
    return _describe_dependent_coordinates(step, "slide")


def _describe_driven_loops(step: ReductionStep) -> str:
    """Describe the step that evaluates loops determined by drives."""
    clause = f"{abbreviate_names(step.owners)} close{_get_verb_ending(step.owners)} loops that drives determine"
    return f"{clause}: coordinates of {_list_bodies(step.gone)} are evaluated, not integrated"


# descriptions by kind of step
_DESCRIPTIONS: Mapping[str, Callable[[ReductionStep], str]] = {
    reduction_log.PLAY: _describe_joints_with_play,
    reduction_log.REDUNDANT: _describe_redundant_equations,
    reduction_log.PRESCRIBED: _describe_prescribed_angles,
    reduction_log.CONSTANT: _describe_constant_angles,
    reduction_log.DEPENDENT: _describe_dependent_angles,
    reduction_log.HUB: _describe_shared_point,
    reduction_log.HINGES: _describe_hinges,
    reduction_log.SLIDES: _describe_slides,
    reduction_log.KNOWN: _describe_known_slides,
    reduction_log.CHAIN: _describe_driven_loops,
}


def _format_tree(log: ReductionLog) -> str:
    """Return the tree as "L1, L6 (L7, L8 (S9))": each body with its children; in [..]: bodies with their own x and y.

    A tree of more than 2 MAX_NAMES bodies is summarized by its number of bodies and its depth.
    """
    children: dict[str, list[str]] = {}
    bodies_without_joint = {placed.body for placed in log.tree if not placed.joint}
    for placed in log.tree:
        children.setdefault(placed.parent, []).append(placed.body)
    if len(log.tree) > 2 * MAX_NAMES:
        remark = f", {len(bodies_without_joint)} of them with x and y of their own" * bool(bodies_without_joint)
        return f"{len(log.tree)} bodies, at most {_measure_tree_depth(children, 'ground')} in a chain{remark}"

    def format_body(body: str) -> str:
        """Return a body with its children, in brackets, as text."""
        name = f"[{body}]" if body in bodies_without_joint else body
        return f"{name} ({', '.join(map(format_body, children[body]))})" if body in children else name

    remark = "; [has x and y: no joint determines them, or it is cheaper]" * bool(bodies_without_joint)
    return ", ".join(map(format_body, children["ground"])) + remark


def _measure_tree_depth(children: Mapping[str, Sequence[str]], body: str) -> int:
    """Return the number of bodies in the longest chain of descendants of a body; `children`: children by body."""
    level, depth = [body], 0
    while level := [child for parent in level for child in children.get(parent, ())]:
        depth += 1
    return depth


def _explain_choice_of_tree(costs: Sequence[int]) -> str:
    """Return a text on why this spanning tree was selected.

    `costs`: estimated operations of each tree; the first tree is breadth-first.
    """
    if len(costs) == 1:
        return "no other was tested"
    comparison = "" if min(costs) == costs[0] else f" where the one breadth-first has at least {costs[0]:,}"
    return f"of {len(costs)} the one of the fewest operations for M and closures, estimated {min(costs):,}{comparison}"


def _describe_coordinates(tree: Sequence[str]) -> Iterator[str]:
    """Yield the coordinates of a tree by kind: "angles of L2, L3"; kinds without any are left out."""
    angles = [name for name in tree if "." not in name]
    slides = [name.removesuffix(".slide") for name in tree if name.endswith(".slide")]
    positions = [name for name in tree if "." in name and not name.endswith(".slide")]
    for kind, names, preposition in (("angle", angles, "of "), ("slide", slides, "of "), ("position", positions, "")):
        if names:
            yield f"{kind}{_get_plural_ending(names)} {preposition}{abbreviate_names(names)}"


def _format_matrix(solve: Solve) -> str:
    """Return the size and nonzeros of a linear system as text."""
    return f"{solve.size:,} × {solve.size:,} with {solve.entries:,} non-zeros and {solve.factor:,} in its factor"


def _format_linear_systems(log: ReductionLog, is_reduced: bool) -> str:
    """Return a text on the linear systems before and after the reduction; of a kinematic linkage, on its groups."""
    before = _format_matrix(log.before) if log.before else ""
    if log.after:
        return f"{before} → {_format_matrix(log.after)}" if is_reduced else _format_matrix(log.after)
    sizes = sorted((len(group.rows) for group in log.groups), reverse=True)
    sizes_text = ", ".join(f"{sizes.count(n)} of {n}×{n}" for n in dict.fromkeys(sizes))
    order = abbreviate_names([" + ".join(group.coordinates) for group in log.groups])
    return f"{before} → without masses, {sizes_text} one after the other: {order}" if sizes else "nothing"


def _format_operations(source: KernelSource) -> str:
    """Return a text on the operations of a right-hand side, or of a sample of a kinematic linkage.

    Numbers before and after the reduction are compared with their ratio, where there are both. Those of a reduced
    right-hand side include the rates of kinematically determined loops (`chain`). Operations of force laws follow.
    """
    counts = source.operations
    n_full = counts["dynamics"]
    if "compute_body_motion" in counts:
        step, n_sample = counts["close_step"], counts["compute_body_motion"]
        return (
            f"accelerations {n_full:,} → {n_sample:,} with all positions and velocities"
            + f", {_format_ratio(n_full, n_sample)}"
            + f"; each of Newton's steps {step:,}" * bool(step)
        )
    if KINEMATIC in source.methods:  # a coordinate that no equation gives: all equations are used
        return f"accelerations {n_full:,}; each of Newton's steps, in absolute coordinates, {counts['project']:,}"
    if source.formulation == "full" or "reduced_dynamics" not in counts:
        return f"accelerations {n_full:,}{_format_law_operations(source)}"
    n_reduced, chains = counts["reduced_dynamics"], ""
    if source.driven_loop_coordinates:
        n_steps, n_rates = counts["compute_loop_step"], counts["compute_loop_rates"]
        n_reduced += n_steps + n_rates
        chains = f" with {n_rates:,} for the rates of driven chains and {n_steps:,} for each step that closes them"
    ratio = _format_ratio(n_full, n_reduced)
    return f"accelerations {n_full:,} → {n_reduced:,}{chains}, {ratio}{_format_law_operations(source)}"


def _format_ratio(before: int, after: int) -> str:
    """Return the ratio of two operation counts as text: "3.2 times fewer"."""
    if before == after:
        return "as many"
    return f"{before / after:.1f} times fewer" if after else "none are left"


def _format_law_operations(source: KernelSource) -> str:
    """Return a text on the operations of force laws, "" without play; joints with equal numbers are listed together.

    The numbers are of the film and of the dry contact of a joint, from source.operations.
    """
    joints_by_text: dict[str, list[str]] = {}
    for joint in source.clearances:
        operations = {
            function: n for function, n in source.operations.items() if function.endswith(f"_{joint.name}_force")
        }
        film = sum(n for function, n in operations.items() if function.startswith("film_"))
        dry = sum(operations.values()) - film
        phrases = [f"{film:,} for the film"] * bool(film) + [f"{dry:,} in contact"] * bool(dry)
        joints_by_text.setdefault(" and ".join(phrases), []).append(joint.name)
    return "".join(
        f"; {abbreviate_names(names)}{' each' * (len(names) > 1)} add{_get_verb_ending(names)} {text}"
        for text, names in joints_by_text.items()
    )
