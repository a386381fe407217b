"""Describe the reduction of a scene's equations (ledger.py) in words, for `check -v` and the written equations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from gudgeon.contract import reduction_log as message
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import KINEMATIC
from gudgeon.contract.reduction_log import ReductionLog, Solve, Step

MOST = 16  # largest number of names that are listed in full


def reduction_lines(source: KernelSource) -> Iterator[tuple[int, int, str]]:
    """Yield for each reduction step the numbers of coordinates and equations that remain, and its description."""
    story = source.story
    yield len(story.coordinates), len(story.rows), "every body by x, y and its angle; every joint closed"
    for step, n, m in story.ledger():
        yield n, m, _WORDS[step.kind](step)


def outcome(source: KernelSource) -> Iterator[tuple[str, str]]:
    """Yield titles and texts on the tree, the unknowns, the linear systems and the operations."""
    story, reduced = source.story, source.formulation == "reduced"
    if story.tree:
        yield "tree", f"{_tree_text(story)}; {_reason_for_tree(story.costs)}"
    yield (
        "unknowns",
        "; ".join(_coordinates_by_kind(source.tree)) or "none" if reduced else "all of them: the full formulation",
    )
    if reduced:
        stay = "rows that stay" if len(source.closures) > 1 else "the row that stays"
        yield "closures", f"{listed(source.closures)}: {stay}" if source.closures else "none: no row stays"
    yield "solved", _systems_text(story, reduced)
    yield "operations", _operations_text(source)


def listed(names: Sequence[str]) -> str:
    """Return names as "a, b, c"; a long list is shortened."""
    if len(names) <= MOST:
        return ", ".join(names)
    return f"{', '.join(names[: MOST - 4])}, … ({len(names)} in all)"


def _plural(names: Sequence[str]) -> str:
    """Return the plural ending of a noun for names."""
    return "s" * (len(names) != 1)


def _verb_s(names: Sequence[str]) -> str:
    """Return the ending of a verb in the present tense, for names as its subject."""
    return "s" * (len(names) == 1)


def _bodies(names: Iterable[str]) -> str:
    """Return the bodies of coordinates: "L1, L4" for "L1.theta", "L4.theta"."""
    return listed(tuple(dict.fromkeys(name.rpartition(".")[0] for name in names)))


def _play(step: Step) -> str:
    """Describe the step that opens joints with play."""
    has = "has" if len(step.owners) == 1 else "have"
    return f"{listed(step.owners)} {has} play: a force law instead of rows, and no joint of the tree"


def _redundant(step: Step) -> str:
    """Describe the step that leaves out redundant equations."""
    return f"{listed(step.rows_gone)} say{_verb_s(step.rows_gone)} nothing new: left out"


def _prescribed(step: Step) -> str:
    """Describe the step in which drives prescribe angles."""
    angles = f"the angle{_plural(step.gone)} of {_bodies(step.gone)}"
    return f"{listed(step.owners)} prescribe{_verb_s(step.owners)} {angles}: known at any time, not integrated"


def _constant(step: Step) -> str:
    """Describe the step in which joints keep angles constant."""
    angles = f"the angle{_plural(step.gone)} of {_bodies(step.gone)}"
    return f"{listed(step.owners)} keep{_verb_s(step.owners)} {angles} as it is"


def _following(step: Step) -> str:
    """Describe the step in which angles follow other angles."""
    return f"the angle{_plural(step.gone)} of {_bodies(step.gone)} follow{_verb_s(step.gone)} {listed(step.owners)}"


def _hub(step: Step) -> str:
    """Describe the step that replaces equations of joints in one point."""
    came, went = _bodies(step.rows_come), _bodies(step.rows_gone)
    return f"{listed(step.owners)} meet in one point: {came} stand{_verb_s(step.rows_come[::2])} in for {went}"


def _hinges(step: Step) -> str:
    """Describe the step in which hinges place bodies."""
    return f"{listed(step.owners)}: each places a body, whose x and y follow from angles"


def _slides(step: Step) -> str:
    """Describe the step in which slides replace x and y of bodies."""
    return f"{listed(step.owners)}: each carries a body, one slide along its axis in place of x and y"


def _known(step: Step) -> str:
    """Describe the step in which slides become known."""
    return f"the slide{_plural(step.gone)} of {_bodies(step.gone)} follow{_verb_s(step.gone)} {listed(step.owners)}"


def _chain(step: Step) -> str:
    """Describe the step that evaluates loops determined by drives."""
    closes = f"{listed(step.owners)} close{_verb_s(step.owners)} loops that drives alone move"
    return f"{closes}: what they make of {_bodies(step.gone)} is evaluated, not integrated"


# descriptions by kind of step
_WORDS: Mapping[str, Callable[[Step], str]] = {
    message.PLAY: _play,
    message.REDUNDANT: _redundant,
    message.PRESCRIBED: _prescribed,
    message.CONSTANT: _constant,
    message.FOLLOWING: _following,
    message.HUB: _hub,
    message.HINGES: _hinges,
    message.SLIDES: _slides,
    message.KNOWN: _known,
    message.CHAIN: _chain,
}


def _tree_text(story: ReductionLog) -> str:
    """Return the tree as "L1, L6 (L7, L8 (S9))": each body with those it carries; [..]: bodies with own x and y."""
    carried: dict[str, list[str]] = {}
    loose = {placed.body for placed in story.tree if not placed.joint}
    for placed in story.tree:
        carried.setdefault(placed.parent, []).append(placed.body)
    if len(story.tree) > 2 * MOST:
        own = f", {len(loose)} of them with x and y of their own" * bool(loose)
        return f"{len(story.tree)} bodies, at most {_depth(carried, 'ground')} behind each other{own}"

    def message_of(body: str) -> str:
        """Return a body with those that it carries, in brackets."""
        name = f"[{body}]" if body in loose else body
        return f"{name} ({', '.join(map(message_of, carried[body]))})" if body in carried else name

    own = "; [keeps its x and y: no joint places it, or that is cheaper]" * bool(loose)
    return ", ".join(map(message_of, carried["ground"])) + own


def _depth(carried: Mapping[str, Sequence[str]], body: str) -> int:
    """Return the number of bodies in the longest chain carried by a body."""
    level, depth = [body], 0
    while level := [other for one in level for other in carried.get(one, ())]:
        depth += 1
    return depth


def _reason_for_tree(costs: Sequence[int]) -> str:
    """Return a text on why this tree was chosen."""
    if len(costs) == 1:
        return "no other was looked at"
    others = "" if min(costs) == costs[0] else f" where the one breadth first has {costs[0]:,}"
    return f"of {len(costs)} the one of the fewest operations for M and closures, estimated {min(costs):,}{others}"


def _coordinates_by_kind(tree: Sequence[str]) -> Iterator[str]:
    """Yield the coordinates of a tree by kind: "angles of L2, L3"."""
    angles = [name for name in tree if "." not in name]
    slides = [name.removesuffix(".slide") for name in tree if name.endswith(".slide")]
    positions = [name for name in tree if "." in name and not name.endswith(".slide")]
    for kind, names, of in (("angle", angles, "of "), ("slide", slides, "of "), ("position", positions, "")):
        if names:
            yield f"{kind}{_plural(names)} {of}{listed(names)}"


def _matrix_text(solve: Solve) -> str:
    """Return the size and nonzeros of a linear system as text."""
    return f"{solve.size:,} × {solve.size:,} with {solve.entries:,} non-zeros and {solve.factor:,} in its factor"


def _systems_text(story: ReductionLog, reduced: bool) -> str:
    """Return a text on the linear systems before and after the reduction."""
    before = _matrix_text(story.before) if story.before else ""
    if story.after:
        return f"{before} → {_matrix_text(story.after)}" if reduced else _matrix_text(story.after)
    sizes = sorted((len(group.rows) for group in story.groups), reverse=True)
    many = ", ".join(f"{sizes.count(n)} of {n}×{n}" for n in dict.fromkeys(sizes))
    order = listed([" + ".join(group.coordinates) for group in story.groups])
    return f"{before} → without masses, {many} one after the other: {order}" if sizes else "nothing: all is known"


def _operations_text(source: KernelSource) -> str:
    """Return a text on the operations of a right-hand side, or of a sample of a kinematic linkage."""
    counts = source.operations
    full = counts["dynamics"]
    if "arrive" in counts:
        step, arrive = counts["close_step"], counts["arrive"]
        return (
            f"accelerations {full:,} → {arrive:,} with all positions and velocities, {_ratio_text(full, arrive)}"
            + f"; each of Newton's steps {step:,}" * bool(step)
        )
    if KINEMATIC in source.methods:  # a coordinate that no equation gives: all equations are used
        return f"accelerations {full:,}; each of Newton's steps, in absolute coordinates, {counts['project']:,}"
    if source.formulation == "full" or "reduced_dynamics" not in counts:
        return f"accelerations {full:,}{_law_operations_text(source)}"
    reduced, chains = counts["reduced_dynamics"], ""
    if source.chain:
        steps, rates = counts["chain_step"], counts["chain_rates"]
        reduced += steps + rates
        chains = f" with {rates:,} for the rates of driven chains and {steps:,} for each step that closes them"
    return f"accelerations {full:,} → {reduced:,}{chains}, {_ratio_text(full, reduced)}{_law_operations_text(source)}"


def _ratio_text(before: int, after: int) -> str:
    """Return the ratio of two operation counts as text."""
    if before == after:
        return "as many"
    return f"{before / after:.1f} times fewer" if after else "none are left"


def _law_operations_text(source: KernelSource) -> str:
    """Return a text on the operations of force laws, joint by joint."""
    words: dict[str, list[str]] = {}
    for joint in source.clearances:
        found = {k: n for k, n in source.operations.items() if k.endswith(f"_{joint.name}_force")}
        film = sum(n for k, n in found.items() if k.startswith("film_"))
        dry = sum(found.values()) - film
        parts = [f"{film:,} for the film"] * bool(film) + [f"{dry:,} in contact"] * bool(dry)
        words.setdefault(" and ".join(parts), []).append(joint.name)
    return "".join(
        f"; {listed(names)}{' each' * (len(names) > 1)} add{_verb_s(names)} {text}" for text, names in words.items()
    )
