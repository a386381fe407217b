"""How a scene's equations became what is integrated: ledger.py in words, for `check -v` and the written equations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from gudgeon.contract import ledger as told
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.ledger import Solve, Step, Story
from gudgeon.contract.methods import KINEMATIC

MOST = 16  # names that are listed; of more the first are, and how many there are


def ledger_lines(source: KernelSource) -> Iterator[tuple[int, int, str]]:
    """Coordinates and rows that are left, and what took the others."""
    story = source.story
    yield len(story.coordinates), len(story.rows), "every body by x, y and its angle; every joint closed"
    for step, n, m in story.ledger():
        yield n, m, _WORDS[step.kind](step)


def outcome(source: KernelSource) -> Iterator[tuple[str, str]]:
    """The tree and why, the unknowns, what is solved, operations before and after."""
    story, reduced = source.story, source.formulation == "reduced"
    if story.tree:
        yield "tree", f"{_nested(story)}; {_why(story.costs)}"
    yield "unknowns", "; ".join(_kinds(source.tree)) or "none" if reduced else "all of them: the full formulation"
    if reduced:
        stay = "rows that stay" if len(source.closures) > 1 else "the row that stays"
        yield "closures", f"{listed(source.closures)}: {stay}" if source.closures else "none: no row stays"
    yield "solved", _solved(story, reduced)
    yield "operations", _operations(source)


def listed(names: Sequence[str]) -> str:
    """ "a, b, c"; of a long list the beginning."""
    if len(names) <= MOST:
        return ", ".join(names)
    return f"{', '.join(names[: MOST - 4])}, … ({len(names)} in all)"


def _s(names: Sequence[str]) -> str:
    return "s" * (len(names) != 1)


def _verb(names: Sequence[str]) -> str:
    """The ending of a verb in the present."""
    return "s" * (len(names) == 1)


def _of(names: Iterable[str]) -> str:
    """Bodies of coordinates: "L1, L4" of "L1.theta", "L4.theta"."""
    return listed(tuple(dict.fromkeys(name.rpartition(".")[0] for name in names)))


def _play(step: Step) -> str:
    has = "has" if len(step.owners) == 1 else "have"
    return f"{listed(step.owners)} {has} play: a force law instead of rows, and no joint of the tree"


def _redundant(step: Step) -> str:
    return f"{listed(step.rows_gone)} say{_verb(step.rows_gone)} nothing new: left out"


def _prescribed(step: Step) -> str:
    angles = f"the angle{_s(step.gone)} of {_of(step.gone)}"
    return f"{listed(step.owners)} prescribe{_verb(step.owners)} {angles}: known at any time, not integrated"


def _constant(step: Step) -> str:
    return f"{listed(step.owners)} keep{_verb(step.owners)} the angle{_s(step.gone)} of {_of(step.gone)} as it is"


def _following(step: Step) -> str:
    return f"the angle{_s(step.gone)} of {_of(step.gone)} follow{_verb(step.gone)} {listed(step.owners)}"


def _hub(step: Step) -> str:
    came, went = _of(step.rows_come), _of(step.rows_gone)
    return f"{listed(step.owners)} meet in one point: {came} stand{_verb(step.rows_come[::2])} in for {went}"


def _hinges(step: Step) -> str:
    return f"{listed(step.owners)}: each places a body, whose x and y follow from angles"


def _slides(step: Step) -> str:
    return f"{listed(step.owners)}: each carries a body, one slide along its axis in place of x and y"


def _known(step: Step) -> str:
    return f"the slide{_s(step.gone)} of {_of(step.gone)} follow{_verb(step.gone)} {listed(step.owners)}"


def _chain(step: Step) -> str:
    closes = f"{listed(step.owners)} close{_verb(step.owners)} loops that drives alone move"
    return f"{closes}: what they make of {_of(step.gone)} is evaluated, not integrated"


_WORDS: Mapping[str, Callable[[Step], str]] = {
    told.PLAY: _play,
    told.REDUNDANT: _redundant,
    told.PRESCRIBED: _prescribed,
    told.CONSTANT: _constant,
    told.FOLLOWING: _following,
    told.HUB: _hub,
    told.HINGES: _hinges,
    told.SLIDES: _slides,
    told.KNOWN: _known,
    told.CHAIN: _chain,
}


def _nested(story: Story) -> str:
    """ "L1, L6 (L7, L8 (S9))": each body with those that it carries; in brackets those that nothing places."""
    carried: dict[str, list[str]] = {}
    loose = {placed.body for placed in story.tree if not placed.joint}
    for placed in story.tree:
        carried.setdefault(placed.parent, []).append(placed.body)
    if len(story.tree) > 2 * MOST:
        own = f", {len(loose)} of them with x and y of their own" * bool(loose)
        return f"{len(story.tree)} bodies, at most {_depth(carried, 'ground')} behind each other{own}"

    def told_of(body: str) -> str:
        name = f"[{body}]" if body in loose else body
        return f"{name} ({', '.join(map(told_of, carried[body]))})" if body in carried else name

    own = "; [keeps its x and y: no joint places it, or that is cheaper]" * bool(loose)
    return ", ".join(map(told_of, carried["ground"])) + own


def _depth(carried: Mapping[str, Sequence[str]], body: str) -> int:
    """Bodies in the longest chain that hangs on this one."""
    level, depth = [body], 0
    while level := [other for one in level for other in carried.get(one, ())]:
        depth += 1
    return depth


def _why(costs: Sequence[int]) -> str:
    if len(costs) == 1:
        return "no other was looked at"
    others = "" if min(costs) == costs[0] else f" where the one breadth first has {costs[0]:,}"
    return f"of {len(costs)} the one of the fewest operations for M and closures, estimated {min(costs):,}{others}"


def _kinds(tree: Sequence[str]) -> Iterator[str]:
    """The coordinates of a tree, kind by kind: "angles of L2, L3"."""
    angles = [name for name in tree if "." not in name]
    slides = [name.removesuffix(".slide") for name in tree if name.endswith(".slide")]
    positions = [name for name in tree if "." in name and not name.endswith(".slide")]
    for kind, names, of in (("angle", angles, "of "), ("slide", slides, "of "), ("position", positions, "")):
        if names:
            yield f"{kind}{_s(names)} {of}{listed(names)}"


def _matrix(solve: Solve) -> str:
    return f"{solve.size:,} × {solve.size:,} with {solve.entries:,} non-zeros and {solve.factor:,} in its factor"


def _solved(story: Story, reduced: bool) -> str:
    before = _matrix(story.before) if story.before else ""
    if story.after:
        return f"{before} → {_matrix(story.after)}" if reduced else _matrix(story.after)
    sizes = sorted((len(group.rows) for group in story.groups), reverse=True)
    many = ", ".join(f"{sizes.count(n)} of {n}×{n}" for n in dict.fromkeys(sizes))
    order = listed([" + ".join(group.coordinates) for group in story.groups])
    return f"{before} → without masses, {many} one after the other: {order}" if sizes else "nothing: all is known"


def _operations(source: KernelSource) -> str:
    """Of a right-hand side, or of a sample where nothing is integrated."""
    counts = source.operations
    full = counts["dynamics"]
    if "arrive" in counts:
        step, arrive = counts["close_step"], counts["arrive"]
        return (
            f"accelerations {full:,} → {arrive:,} with all positions and velocities, {_factor(full, arrive)}"
            + f"; each of Newton's steps {step:,}" * bool(step)
        )
    if KINEMATIC in source.methods:  # a coordinate of the tree that no row says: all rows are asked
        return f"accelerations {full:,}; each of Newton's steps, in absolute coordinates, {counts['project']:,}"
    if source.formulation == "full" or "reduced_dynamics" not in counts:
        return f"accelerations {full:,}{_laws(source)}"
    reduced, chains = counts["reduced_dynamics"], ""
    if source.chain:
        steps, rates = counts["chain_step"], counts["chain_rates"]
        reduced += steps + rates
        chains = f" with {rates:,} for the rates of driven chains and {steps:,} for each step that closes them"
    return f"accelerations {full:,} → {reduced:,}{chains}, {_factor(full, reduced)}{_laws(source)}"


def _factor(before: int, after: int) -> str:
    if before == after:
        return "as many"
    return f"{before / after:.1f} times fewer" if after else "none are left"


def _laws(source: KernelSource) -> str:
    """What force laws add to it, joint by joint."""
    words: dict[str, list[str]] = {}
    for joint in source.clearances:
        found = {k: n for k, n in source.operations.items() if k.endswith(f"_{joint.name}_force")}
        film = sum(n for k, n in found.items() if k.startswith("film_"))
        dry = sum(found.values()) - film
        parts = [f"{film:,} for the film"] * bool(film) + [f"{dry:,} in contact"] * bool(dry)
        words.setdefault(" and ".join(parts), []).append(joint.name)
    return "".join(
        f"; {listed(names)}{' each' * (len(names) > 1)} add{_verb(names)} {text}" for text, names in words.items()
    )
