"""Division of a long function into parts that a compiler can handle.

Compilers allocate registers for a function as a whole, in more than linear time: the dynamics of 64 four-bars as one
function of ten thousand statements would take gcc a minute. So a kernel longer than LONG becomes several of PART
statements, called one after the other. A value that one part computes and another reads is passed through an array,
under the same name in both. Shorter kernels, that is all except long chains, stay as they are.
Runs of plain statements and of tests of pivots are divided. Lines that declare, call or jump stay in the function
itself, and so do lines that read names which only such lines know.
Before that, statements are moved near those that read them (`nearby`). As derived, a kernel first computes all
directions and arms, then all pivots, then all substitutions: in a long one each value has left the registers and the
nearest cache before it is read. Here a result or a test of a pivot is preceded by what it needs, and what can be
computed from the values at hand is computed then. Each statement stays as it is and follows what it reads: the numbers
are the same, bit for bit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import Access, Number, result, source
from gudgeon.generator.ir.statements import (
    AssignStatus,
    Call,
    Declare,
    Guard,
    Jump,
    Line,
    Return,
    ReturnIfFailed,
    Sines,
    Statement,
)
from gudgeon.generator.symbols.storage import Place


def nearby(reads: Sequence[frozenset[str]], defines: Sequence[str]) -> list[int]:
    """Return an order of statements in which each is near those that read it.

    Statement k reads the names `reads[k]` and defines `defines[k]` ("": a result or a test).
    """
    home = {name: k for k, name in enumerate(defines) if name}
    needs = [{home[name] for name in names if name in home} - {k} for k, names in enumerate(reads)]
    readers: list[list[int]] = [[] for _ in reads]
    for k, own in enumerate(needs):
        for j in own:
            readers[j].append(k)
    order: list[int] = []
    missing = [len(own) for own in needs]
    placed = [False] * len(reads)

    def place(first: int) -> None:
        """Append a statement and those that can be computed after it."""
        ready = [first]
        while ready:
            k = ready.pop()
            if placed[k]:
                continue
            placed[k] = True
            order.append(k)
            for reader in readers[k]:
                missing[reader] -= 1
            ready += [reader for reader in reversed(readers[k]) if not missing[reader] and not placed[reader]]

    expected = [k for k, following in enumerate(readers) if not following]
    for root in expected:
        waiting = [root]
        while waiting:
            k = waiting[-1]
            pulled = [j for j in sorted(needs[k], reverse=True) if not placed[j]]
            if pulled and not placed[k]:
                waiting += pulled
                continue
            waiting.pop()
            if not placed[k]:
                place(k)
    return order


LONG, PART, SHORTEST = 850, 250, 60


@dataclass(frozen=True)
class Item:
    """A line with its section's title; `movable`: it may stand in a part."""

    title: str
    what: Line
    reads: frozenset[str]  # the array that is written to included
    movable: bool

    @property
    def defines(self) -> str:
        """Return the local that the line declares, or ""."""
        return self.what.defines


def cut(kernel: Kernel) -> tuple[Kernel, ...]:
    """Return the parts of a long kernel and the function that calls them; a short kernel is its only part."""
    if sum(len(section.statements) for section in kernel.sections) <= LONG:
        return (kernel,)
    items, sources = _items(kernel)
    pieces = _pieces(items)
    if not any(map(_is_part, pieces)):
        return (kernel,)
    shared = tuple(source(name, kind) for name, kind in _arrays(kernel).items())
    passed = _unused_name("passed", items)
    slots = _slots(pieces)
    cut_up = _Cut(replace(kernel, arguments=(*kernel.arguments, *shared)), slots, passed, sources)
    title = "values that pass between the parts"
    main = [Item(title, Declare(Number.REAL, passed, (max(len(slots), 1),)), frozenset(), False)]
    parts: list[Kernel] = []
    stored: set[str] = set()
    for k, piece in enumerate(pieces):
        if not _is_part(piece):
            main += piece
            continue
        needs = {n for item in piece for n in item.reads if n in slots}
        own = {item.defines for item in piece}
        ready = {item.defines for item in main if item.defines}
        main += [cut_up.store(name) for name in sorted((needs - own) & ready - stored, key=slots.__getitem__)]
        stored |= needs & ready
        name = f"{kernel.name}_part_{len(parts) + 1}"
        parts.append(cut_up.part(name, piece))
        rest = {n for other in pieces[k + 1 :] if not _is_part(other) for item in other for n in item.reads}
        main += cut_up.call(name, piece, rest)
        stored |= own & set(slots)
    return (*parts, replace(kernel, sections=_sections(_with_sources(main, sources))))


def _items(kernel: Kernel) -> tuple[list[Item], dict[str, Item]]:
    """Return all lines in order except sources, and the sources by name.

    A source copies an argument to a local; each part reads the argument again where it needs it.
    """
    listed = [(section.title, what) for section in kernel.sections for what in section.statements]
    constant = {argument.name for argument in kernel.arguments if argument.access in (Access.CONSTANT, Access.READ)}
    constant |= set(_arrays(kernel))
    known = {what.defines for _, what in listed} | {argument.name for argument in kernel.arguments} | constant
    fixed = {name for _, what in listed if not _is_plain(what) for name in what.reads | what.writes} - known
    items: list[Item] = []
    sources: dict[str, Item] = {}
    jumped = False
    for title, what in listed:
        reads = what.reads | what.writes
        item = Item(title, what, reads, _is_plain(what) and not jumped and not reads & fixed)
        jumped = jumped or isinstance(what, Jump)
        if _source_of(what) in constant:
            sources[item.defines] = item
        else:
            items.append(item)
    return items, sources


def _is_plain(what: Line) -> bool:
    """Return whether a line is a statement or a test of a pivot, which may stand in a part."""
    return isinstance(what, (Statement, Guard))


def _source_of(what: Line) -> str:
    """Return the argument or array that a local is a copy of; "" if it is not one."""
    return what.value.base if isinstance(what, Statement) and what.defines and isinstance(what.value, Place) else ""


def _arrays(kernel: Kernel) -> dict[str, str]:
    """Return the arrays of cosines and sines that the function fills before its parts read them, with their type."""
    lines = [what for section in kernel.sections for what in section.statements]
    return {name: "Four" for what in lines if isinstance(what, Sines) and what.count for name in what.arrays}


def _pieces(items: Sequence[Item]) -> list[list[Item]]:
    """Return runs of movable lines, each divided into equal pieces of at most PART, and other lines as they stand."""
    pieces = []
    for movable, group in groupby(items, key=lambda item: item.movable):
        run = _near(list(group))
        if movable and len(run) >= SHORTEST:
            count = -(-len(run) // PART)
            size = -(-len(run) // count)
            pieces += [run[k : k + size] for k in range(0, len(run), size)]
        else:
            pieces.append([replace(item, movable=False) for item in run])
    return pieces


def _is_part(piece: Sequence[Item]) -> bool:
    """Return whether a piece becomes a function of its own."""
    return piece[0].movable


def _slots(pieces: Sequence[Sequence[Item]]) -> dict[str, int]:
    """Return an index for every local that one piece computes and another reads, in the order of computation."""
    home = {item.defines: k for k, piece in enumerate(pieces) for item in piece if item.defines}
    crossing = {
        name
        for k, piece in enumerate(pieces)
        for item in piece
        for name in item.reads
        if name in home and home[name] != k and (_is_part(piece) or _is_part(pieces[home[name]]))
    }
    return {name: slot for slot, name in enumerate(name for name in home if name in crossing)}


def _unused_name(name: str, items: Sequence[Item]) -> str:
    """Return the name with underscores appended until no line uses it."""
    used = {n for item in items for n in (*item.reads, item.defines)}
    while name in used:
        name += "_"
    return name


def _near(run: list[Item]) -> list[Item]:
    """Return lines in the order of `nearby`, unless one reads an array that another writes."""
    written = frozenset().union(*(item.what.writes for item in run))
    if any(written & item.what.reads for item in run):
        return run
    return [run[k] for k in nearby([item.reads for item in run], [item.defines for item in run])]


def _load(name: str, place: Place) -> Item:
    """Return the line that reads a local back from its place."""
    return Item("values from the part", Statement(name, place), place.names, False)


def _with_sources(main: Sequence[Item], sources: dict[str, Item]) -> list[Item]:
    """Return the lines of the calling function with the sources that it reads inserted.

    Arguments are read first of all, arrays after the line that fills them. The reading line itself may be in a block or
    after a label.
    """
    needed = [item for name, item in sources.items() if any(name in other.reads for other in main)]
    filled = {name for item in main for name in _filled(item.what)}
    found = [item for item in needed if not item.reads & filled]
    for item in main:
        found.append(item)
        found += [source for source in needed if source.reads & _filled(item.what)]
    return found


def _filled(what: Line) -> set[str]:
    """Return the arrays of cosines and sines that a line fills in a loop."""
    return set(what.arrays) if isinstance(what, Sines) and what.count else set()


@dataclass(frozen=True)
class _Cut:
    """A kernel with the arguments of its parts, the places of passed values, and the sources."""

    kernel: Kernel
    slots: dict[str, int]
    passed: str
    sources: dict[str, Item]

    def store(self, name: str) -> Item:
        """Return the line of a part that stores a local for others."""
        statement = Statement(Place(self.passed)[self.slots[name]], Place(name))
        return Item("values for later parts", statement, frozenset({name}), False)

    def load(self, name: str) -> Item:
        """Return the line that reads a local of an earlier part."""
        return _load(name, Place(self.passed)[self.slots[name]])

    def part(self, name: str, piece: list[Item]) -> Kernel:
        """Return one part as a function: values of other parts, its own lines, values for other parts."""
        own = {item.defines for item in piece}
        tested = any(isinstance(item.what, Guard) for item in piece)
        within: list[Item] = []
        known = set(own)
        for item in piece:
            for needed in sorted(item.reads - known):
                if needed in self.sources or needed in self.slots:
                    read = self.sources[needed] if needed in self.sources else self.load(needed)
                    within.append(replace(read, title=item.title))
                    known.add(needed)
            within.append(replace(item, what=replace(item.what, jumps=False)) if isinstance(item.what, Guard) else item)
            if item.defines in self.slots:
                within.append(replace(self.store(item.defines), title=item.title))
        end = [Item("", Return(), frozenset(), False)] if tested else []
        return Kernel(
            name,
            (f"A part of `{self.kernel.name}`, which calls it.",),
            (*self.kernel.arguments, result(self.passed)),
            _sections([*within, *end]),
            tested,
            attribute="noinline",
            names=self.kernel.names,
        )

    def call(self, name: str, piece: list[Item], rest: set[str]) -> list[Item]:
        """Return the lines that call a part, read its values and end the function if a test failed."""
        arguments = tuple(Place(argument.name) for argument in self.kernel.arguments)
        call = Call(name, arguments, (Place(self.passed),))
        tests = [item.what for item in piece if isinstance(item.what, Guard)]
        loads = [self.load(n) for n in self.slots if n in rest and n in {item.defines for item in piece}]
        lines: list[Line] = [call]
        after: list[Line] = []
        if tests:
            jumps = tests[0].jumps
            status = "pivot" if jumps else f"status_{name.rpartition('_')[2]}"
            lines, after = [AssignStatus(call, status)], [ReturnIfFailed(status, jumps)]
        title = piece[0].title
        return [
            *(Item(title, line, frozenset(), False) for line in lines),
            *loads,
            *(Item("values from the part", line, frozenset(), False) for line in after),
        ]


def _sections(items: Sequence[Item]) -> tuple[Section, ...]:
    """Return lines grouped into sections by their titles."""
    grouped = ((title, tuple(item.what for item in group)) for title, group in groupby(items, key=lambda i: i.title))
    return tuple(Section(title, statements) for title, statements in grouped)
