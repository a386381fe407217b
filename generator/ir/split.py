"""A long function cut into parts that a compiler gets through.

Compilers allocate registers for a function as a whole, in more than linear time: the dynamics of 64 four-bars as one
function of ten thousand statements would take gcc a minute. So a kernel longer than LONG becomes several of PART
statements, called one after the other; what one computes and another reads passes through an array, each number by
its name at both ends. Shorter kernels, that is all but long chains, stay as they are.

Cut are runs of plain statements and of tests of pivots. What declares, calls or jumps stays in the function itself, and
so does what reads names that only such lines know.

Before that, statements are put near what reads them (`nearby`). As derived, a kernel first computes all directions and
arms, then all pivots, then all substitutions: in a long one each value is out of the registers and of the nearest cache
before it is read. Here what is asked for (tests of pivots, results) pulls what it needs just before itself, and what
can be computed from the values at hand is computed then. Each statement stays as it is and comes behind what it reads:
the numbers are the same, bit for bit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import Access, Number, result, source
from gudgeon.generator.ir.statements import Call, Declare, Ended, Guard, Jump, Line, Passed, Return, Sines, Statement
from gudgeon.generator.symbols.storage import Place


def nearby(reads: Sequence[frozenset[str]], defines: Sequence[str]) -> list[int]:
    """The order of statements: the k-th reads the names `reads[k]` and defines `defines[k]` ("": a result, a test)."""
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

    wanted = [k for k, following in enumerate(readers) if not following]
    for root in wanted:
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
        """The local that it declares, or ""."""
        return self.what.defines


def cut(kernel: Kernel) -> tuple[Kernel, ...]:
    """The parts in front of the function that calls them; a short kernel is its only part."""
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
    """Everything in its order but for the sources, by name: what reads an argument is read again where it is needed."""
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
    """A statement, or a test that fails with its number: both may stand in a part."""
    return isinstance(what, (Statement, Guard))


def _source_of(what: Line) -> str:
    """The argument or array that a local is a copy from; "" where it is none."""
    return what.value.base if isinstance(what, Statement) and what.defines and isinstance(what.value, Place) else ""


def _arrays(kernel: Kernel) -> dict[str, str]:
    """Arrays of results that the function fills before its parts read them, with their type."""
    lines = [what for section in kernel.sections for what in section.statements]
    return {name: "Four" for what in lines if isinstance(what, Sines) and what.count for name in what.arrays}


def _pieces(items: Sequence[Item]) -> list[list[Item]]:
    """Runs of what may move, each cut into equal shares of at most PART; what stays, as it stands."""
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
    return piece[0].movable


def _slots(pieces: Sequence[Sequence[Item]]) -> dict[str, int]:
    """A place for every local that one piece computes and another reads, in the order in which they are computed."""
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
    taken = {n for item in items for n in (*item.reads, item.defines)}
    while name in taken:
        name += "_"
    return name


def _near(run: list[Item]) -> list[Item]:
    """In the order of locality.py, unless something reads what is no local."""
    written = frozenset().union(*(item.what.writes for item in run))
    if any(written & item.what.reads for item in run):
        return run
    return [run[k] for k in nearby([item.reads for item in run], [item.defines for item in run])]


def _load(name: str, place: Place) -> Item:
    return Item("what comes back", Statement(name, place), place.names, False)


def _with_sources(main: Sequence[Item], sources: dict[str, Item]) -> list[Item]:
    """The function itself with the sources that it reads: arguments first of all, arrays behind what fills them.

    Not where they are read: that may be in a block, or behind a label.
    """
    needed = [item for name, item in sources.items() if any(name in other.reads for other in main)]
    filled = {name for item in main for name in _filled(item.what)}
    found = [item for item in needed if not item.reads & filled]
    for item in main:
        found.append(item)
        found += [source for source in needed if source.reads & _filled(item.what)]
    return found


def _filled(what: Line) -> set[str]:
    """The arrays of sines that a line fills in a loop."""
    return set(what.arrays) if isinstance(what, Sines) and what.count else set()


@dataclass(frozen=True)
class _Cut:
    """A kernel with the arguments of its parts, and what passes between them: places in `passed`, sources."""

    kernel: Kernel
    slots: dict[str, int]
    passed: str
    sources: dict[str, Item]

    def store(self, name: str) -> Item:
        """For a part."""
        statement = Statement(Place(self.passed)[self.slots[name]], Place(name))
        return Item("what the next part reads", statement, frozenset({name}), False)

    def load(self, name: str) -> Item:
        """Of a part before."""
        return _load(name, Place(self.passed)[self.slots[name]])

    def part(self, name: str, piece: list[Item]) -> Kernel:
        """One part: what it reads of others, its own statements, what others read of it."""
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
        """The call, what the function itself reads of the part, and what is done where a test failed."""
        arguments = tuple(Place(argument.name) for argument in self.kernel.arguments)
        call = Call(name, arguments, (Place(self.passed),))
        tests = [item.what for item in piece if isinstance(item.what, Guard)]
        loads = [self.load(n) for n in self.slots if n in rest and n in {item.defines for item in piece}]
        lines: list[Line] = [call]
        after: list[Line] = []
        if tests:
            jumps = tests[0].jumps
            status = "pivot" if jumps else f"status_{name.rpartition('_')[2]}"
            lines, after = [Passed(call, status)], [Ended(status, jumps)]
        title = piece[0].title
        return [
            *(Item(title, line, frozenset(), False) for line in lines),
            *loads,
            *(Item("what comes back", line, frozenset(), False) for line in after),
        ]


def _sections(items: Sequence[Item]) -> tuple[Section, ...]:
    grouped = ((title, tuple(item.what for item in group)) for title, group in groupby(items, key=lambda i: i.title))
    return tuple(Section(title, statements) for title, statements in grouped)
