"""Functions of the state whose zeros end a step: a scene's own corners and its user events, apart from the rest.

A step may be long where the motion is smooth, and an expression may change its sign many times meanwhile. So each is
looked at along a step (engine/watch/watched.c), by bounds over its parts. This is the part of the
right-hand side that they need: mostly no more than the positions in them.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.kernels import Kernel, Section, with_sides
from gudgeon.generator.ir.signatures import ASIDE
from gudgeon.generator.ir.statements import Line, Sides, Statement
from gudgeon.generator.symbols.corners import SideOf
from gudgeon.generator.symbols.storage import Place

NAME, RANGES = "watched_functions", "watched_ranges"
_DOC = (
    "Switching functions of the scene's own corners, in aside->g, and what the user watches, in aside->event.",
)  # fmt: skip
_RANGES_DOC = ("Ranges of the scene's own corners and of what the user watches over ranges of t, q and v.",)
_KNOWN_LATE = ASIDE.name  # what reads this is known only once forces or accelerations are


def watched_kernel(dynamics: Kernel, model: Model, chain_corners: Kernel | None = None) -> Kernel | None:
    """What a right-hand side's kernel computes of the scene's corners and events; None where that hangs on forces.

    `chain_corners`: the function that evaluates the switches of driven chains, which `dynamics` does not evaluate.
    """
    corners = {switch.index for switch in model.symbols.switches.of("")}
    if not corners and not model.events:
        return None
    every = _merge_sections(chain_corners, dynamics)
    outs = {s: out for section in every for s in section.statements
            if isinstance(s, Statement) and (out := _out(s, corners))}  # fmt: skip
    by_target = {s.defines: s for section in every for s in section.statements
                 if isinstance(s, Statement) and s.defines}  # fmt: skip
    read: set[Statement] = set()
    waiting = list(outs.values())
    while waiting:
        found = {by_target[name] for name in waiting.pop().reads if name in by_target} - read
        read |= found
        waiting += found
    if any(_KNOWN_LATE in s.reads for s in read):
        return None
    sections = []
    for section in every:
        lines: list[Line] = []
        for s in section.statements:
            if isinstance(s, Statement):
                lines += [line for line in (s if s in read else None, outs.get(s)) if line]
        if lines:
            sections.append(Section(section.title, tuple(lines)))
    arguments = tuple(a for a in dynamics.arguments if a.name != "a")
    watched = replace(dynamics, name=NAME, doc=_DOC, arguments=arguments, sections=tuple(sections), status=False)
    return with_sides(watched, "aside")


def _merge_sections(*kernels: Kernel | None) -> list[Section]:
    """The sections of several functions of one scene one after the other, each local once."""
    known: set[str] = set()
    merged = []
    for kernel in kernels:
        for section in kernel.sections if kernel else ():
            new = tuple(line for line in section.statements if line.defines not in known)
            merged.append(Section(section.title, new))
        known |= {line.defines for section in merged for line in section.statements if line.defines}
    return merged


def ranges_kernel(watched: Kernel, corners: Sequence[int], events: int) -> Kernel:
    """The same for ranges of t, q and v: what is watched goes to `out`, corners first, in this order."""
    place: dict[Place, int] = {ASIDE["g"][k]: i for i, k in enumerate(corners)}
    place |= {ASIDE["event"][k]: i for k, i in enumerate(range(len(corners), len(corners) + events))}
    sections = []
    for section in watched.sections:
        kept: list[Line] = []
        for s in section.statements:
            if isinstance(s, Statement) and isinstance(s.target, Place):
                s = replace(s, target=Place("out")[place[s.target]])
            kept.append(Sides("") if isinstance(s, Sides) else s)
        sections.append(Section(section.title, tuple(kept)))
    return replace(watched, name=RANGES, doc=_RANGES_DOC, sections=tuple(s for s in sections if s.statements))


def reads_state(kernel: Kernel) -> bool:
    """Whether it hangs on more than time."""
    return reads_beyond(kernel, 0)


def reads_beyond(kernel: Kernel, count: int) -> bool:
    """Whether it reads a coordinate, or the rate of one, behind the first `count`."""
    values = [s.value for section in kernel.sections for s in section.statements if isinstance(s, Statement)]
    places = [value for value in values if isinstance(value, Place) and value.base in ("q", "v")]
    return any(place.path >= (count,) for place in places)


def _out(statement: Statement, corners: Collection[int]) -> Statement | None:
    """What is written of a statement that tells a corner or an event."""
    value = statement.value
    if isinstance(value, SideOf) and int(value.args[0]) in corners:
        return Statement(ASIDE["g"][int(value.args[0])], value.args[1])
    target = statement.target
    return statement if isinstance(target, Place) and target.path[:1] == ("event",) else None
