"""A long function cut into parts that a compiler gets through.

Compilers allocate registers for a function as a whole, in more than linear time: the dynamics of 64 four-bars as one
function of ten thousand statements would take gcc a minute. So a kernel longer than LONG becomes several of PART
statements, called one after the other; what one computes and another reads passes through an array, each number by
its name at both ends. Shorter kernels, that is all but long chains, stay as they are.

Cut are runs of plain statements and of tests of pivots. What declares, calls or jumps stays in the function itself, and
so does what reads names that only such lines know.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import sympy as sp

from gudgeon.generator.ir.kernels import Argument, Kernel, Section, Statement
from gudgeon.generator.ir.order import nearby
from gudgeon.generator.symbols.corners import SideOf

LONG, PART, SHORTEST = 850, 250, 60
_NAME = re.compile(r"(?<![\w.>])[A-Za-z_]\w*")
# A test that fails with its number: `return 3;`, or `{ pivot = 3; goto dependent; };`
_TEST = re.compile(
    r"if \((?P<test>.*)\)\s+"
    r"(?:return (?P<number>\d+);|\{ (?P<set>\w+) = (?P<told>\d+); (?P<jump>goto \w+); \};)"
)
_JUMP = re.compile(r"goto \w+;")
_SOURCE = re.compile(r"(\w+)(?:->\w+)?(?:\[\d+\]){0,2}")  # `q[3]`, `p->mass`, `sines[2][1]`
_ARRAYS = re.compile(r"(?P<type>Four) (?P<names>\w+\[\d+\](?:, \w+\[\d+\])*);")


@dataclass(frozen=True)
class Item:
    """A statement with its section's title; `movable`: it may stand in a part."""

    title: str
    what: Statement | str
    reads: frozenset[str]
    movable: bool

    @property
    def defines(self) -> str:
        """The local that it declares, or ""."""
        return self.what.target if isinstance(self.what, Statement) and self.what.local else ""


def cut(kernel: Kernel) -> tuple[Kernel, ...]:
    """The parts in front of the function that calls them; a short kernel is its only part."""
    if sum(len(section.statements) for section in kernel.sections) <= LONG or kernel.returns not in ("void", "int"):
        return (kernel,)
    items, sources = _items(kernel)
    pieces = _pieces(items)
    if not any(map(_is_part, pieces)):
        return (kernel,)
    shared = tuple(Argument(f"const {kind} *", name) for name, kind in _arrays(kernel).items())
    passed = _unused_name("passed", items)
    slots = _slots(pieces)
    cut_up = _Cut(replace(kernel, arguments=(*kernel.arguments, *shared)), slots, passed, sources)
    title = "values that pass between the parts"
    main = [Item(title, f"double {passed}[{max(len(slots), 1)}];", frozenset(), False)]
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
    listed = [(section.title, what) for section in kernel.sections for what in _joined(section.statements)]
    locals_ = {what.target for _, what in listed if isinstance(what, Statement) and what.local}
    constant = {argument.name for argument in kernel.arguments if argument.type.startswith("const")}
    constant |= set(_arrays(kernel))
    known = locals_ | {argument.name for argument in kernel.arguments} | set(_arrays(kernel))
    plain = [what for _, what in listed if isinstance(what, str) and not _TEST.fullmatch(what)]
    fixed = {name for line in plain for name in _NAME.findall(line)} - known
    items: list[Item] = []
    sources: dict[str, Item] = {}
    jumped = False
    for title, what in listed:
        reads = _reads(what)
        is_plain = isinstance(what, Statement) or _TEST.fullmatch(what) is not None
        item = Item(title, what, reads, is_plain and not jumped and not reads & fixed)
        jumped = jumped or (isinstance(what, str) and _JUMP.fullmatch(what) is not None)
        if _source_of(what) in constant:
            sources[item.defines] = item
        else:
            items.append(item)
    return items, sources


def _source_of(what: Statement | str) -> str:
    """The argument or array that a local is a copy from; "" where it is none."""
    if isinstance(what, str) or not what.local or not isinstance(what.value, str):
        return ""
    copied = _SOURCE.fullmatch(what.value)
    return copied[1] if copied else ""


def _arrays(kernel: Kernel) -> dict[str, str]:
    """Arrays of results that the function fills before its parts read them, with their type."""
    lines = [what for section in kernel.sections for what in section.statements if isinstance(what, str)]
    declared = [found for line in lines if (found := _ARRAYS.fullmatch(line))]
    return {name: found["type"] for found in declared for name in _NAME.findall(re.sub(r"\[.*?\]", "", found["names"]))}


def _joined(statements: Sequence[Statement | str]) -> list[Statement | str]:
    """With a test and its `return` on the line below as one."""
    found: list[Statement | str] = []
    for what in statements:
        if isinstance(what, str) and what.startswith("    return ") and found and isinstance(found[-1], str):
            what = f"{found.pop()}\n    {what}"
        found.append(what)
    return found


def _reads(what: Statement | str) -> frozenset[str]:
    """Every name in it, the array that is written to included."""
    if isinstance(what, str):
        test = _TEST.fullmatch(what)
        return frozenset(_NAME.findall(test["test"] if test else what))
    found = {} if what.local else set(_NAME.findall(what.target))
    if isinstance(what.value, sp.Expr):
        sides = {"side", "g"} if what.value.has(SideOf) else set()  # as it is printed
        return frozenset(found).union(sides, *(_NAME.findall(s.name) for s in what.value.free_symbols))
    return frozenset(found).union(_NAME.findall(what.value))


def _values(what: Statement | str) -> frozenset[str]:
    """What a statement reads, not where it writes."""
    return _reads(replace(what, local=True) if isinstance(what, Statement) else what)


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
    results = [item.what.target for item in run if isinstance(item.what, Statement) and not item.what.local]
    written = {_NAME.findall(target)[0] for target in results}
    if any(written & _values(item.what) for item in run):
        return run
    return [run[k] for k in nearby([item.reads for item in run], [item.defines for item in run])]


def _load(name: str, value: str) -> Item:
    return Item("what comes back", Statement(name, value), frozenset(_NAME.findall(value)), False)


def _failing(line: str) -> str:
    """A test, answered by its number."""
    found = _TEST.fullmatch(line)
    assert found is not None  # nothing else moves
    return f"if ({found['test']}) return {found['number'] or found['told']};"


def _with_sources(main: Sequence[Item], sources: dict[str, Item]) -> list[Item]:
    """The function itself with the sources that it reads: arguments first of all, arrays behind what fills them.

    Not where they are read: that may be in a block, or behind a label.
    """
    needed = [item for name, item in sources.items() if any(name in other.reads for other in main)]
    filled = {name for item in main if isinstance(item.what, str) for name in _filled(item.what)}
    found = [item for item in needed if not item.reads & filled]
    for item in main:
        found.append(item)
        if isinstance(item.what, str) and (names := _filled(item.what)):
            found += [source for source in needed if source.reads & names]
    return found


def _filled(line: str) -> set[str]:
    """The arrays that a line has a function fill."""
    return set(_NAME.findall(line)) if line.startswith("many_") else set()


@dataclass(frozen=True)
class _Cut:
    """A kernel with the arguments of its parts, and what passes between them: places in `passed`, sources."""

    kernel: Kernel
    slots: dict[str, int]
    passed: str
    sources: dict[str, Item]

    def store(self, name: str) -> Item:
        """For a part."""
        statement = Statement(f"{self.passed}[{self.slots[name]}]", name, False)
        return Item("what the next part reads", statement, frozenset({name}), False)

    def load(self, name: str) -> Item:
        """Of a part before."""
        return _load(name, f"{self.passed}[{self.slots[name]}]")

    def part(self, name: str, piece: list[Item]) -> Kernel:
        """One part: what it reads of others, its own statements, what others read of it."""
        own = {item.defines for item in piece}
        tested = any(isinstance(item.what, str) for item in piece)
        within: list[Item] = []
        known = set(own)
        for item in piece:
            for needed in sorted(item.reads - known):
                if needed in self.sources or needed in self.slots:
                    read = self.sources[needed] if needed in self.sources else self.load(needed)
                    within.append(replace(read, title=item.title))
                    known.add(needed)
            within.append(replace(item, what=_failing(item.what)) if isinstance(item.what, str) else item)
            if item.defines in self.slots:
                within.append(replace(self.store(item.defines), title=item.title))
        end = [Item("", "return 0;", frozenset(), False)] if tested else []
        return Kernel(
            name, (f"A part of `{self.kernel.name}`, which calls it.",),
            (*self.kernel.arguments, Argument("double *", self.passed)), _sections([*within, *end]),
            "int" if tested else "void", attribute="noinline",
        )  # fmt: skip

    def call(self, name: str, piece: list[Item], rest: set[str]) -> list[Item]:
        """The call, what the function itself reads of the part, and what is done where a test failed."""
        call = f"{name}({', '.join(argument.name for argument in self.kernel.arguments)}, {self.passed});"
        tests = [found for item in piece if isinstance(item.what, str) and (found := _TEST.fullmatch(item.what))]
        loads = [self.load(n) for n in self.slots if n in rest and n in {item.defines for item in piece}]
        if not tests:
            lines, after = [call], []
        elif tests[0]["jump"]:
            lines, after = [f"{tests[0]['set']} = {call}"], [f"if ({tests[0]['set']}) {tests[0]['jump']};"]
        else:
            status = f"status_{name.rpartition('_')[2]}"
            lines, after = [f"const int {status} = {call}"], [f"if ({status}) return {status};"]
        title = piece[0].title
        return [
            *(Item(title, line, frozenset(), False) for line in lines), *loads,
            *(Item("what comes back", line, frozenset(), False) for line in after),
        ]  # fmt: skip


def _sections(items: Sequence[Item]) -> tuple[Section, ...]:
    grouped = ((title, tuple(item.what for item in group)) for title, group in groupby(items, key=lambda i: i.title))
    return tuple(Section(title, statements) for title, statements in grouped)
