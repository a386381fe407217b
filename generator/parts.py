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

from gudgeon.generator.kernels import Argument, Kernel, Section, Statement
from gudgeon.generator.switches import SideOf

LONG, PART, SHORTEST = 1200, 250, 60
_NAME = re.compile(r"(?<![\w.>])[A-Za-z_]\w*")
# A test that fails with its number: `return 3;`, or `{ pivot = 3; goto dependent; };`
_TEST = re.compile(
    r"if \((?P<test>.*)\)\s+"
    r"(?:return (?P<number>\d+);|\{ (?P<set>\w+) = (?P<told>\d+); (?P<jump>goto \w+); \};)"
)
_JUMP = re.compile(r"goto \w+;")


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
    items = _items(kernel)
    pieces = _pieces(items)
    if not any(map(_is_part, pieces)):
        return (kernel,)
    passed = _unused_name("passed", items)
    slots = _slots(pieces)
    parts: list[Kernel] = []
    main = [Item("values that pass between the parts", f"double {passed}[{max(len(slots), 1)}];", frozenset(), False)]
    stored: set[str] = set()
    for k, piece in enumerate(pieces):
        if not _is_part(piece):
            main += piece
            continue
        needs = {n for item in piece for n in item.reads if n in slots}
        own = {item.defines for item in piece}
        ready = {item.defines for item in main if item.defines}
        main += [_store(name, slots, passed) for name in sorted((needs - own) & ready - stored, key=slots.__getitem__)]
        stored |= needs & ready
        name = f"{kernel.name}_part_{len(parts) + 1}"
        parts.append(_part(kernel, name, piece, slots, passed))
        rest = {n for other in pieces[k + 1 :] if not _is_part(other) for item in other for n in item.reads}
        main += _call(kernel, name, piece, slots, passed, rest)
        stored |= own & set(slots)
    return (*parts, replace(kernel, sections=_sections(main)))


def _items(kernel: Kernel) -> list[Item]:
    listed = [(section.title, what) for section in kernel.sections for what in _joined(section.statements)]
    locals_ = {what.target for _, what in listed if isinstance(what, Statement) and what.local}
    known = locals_ | {argument.name for argument in kernel.arguments}
    plain = [what for _, what in listed if isinstance(what, str) and not _TEST.fullmatch(what)]
    fixed = {name for line in plain for name in _NAME.findall(line)} - known
    items, jumped = [], False
    for title, what in listed:
        reads = _reads(what)
        is_plain = isinstance(what, Statement) or _TEST.fullmatch(what) is not None
        items.append(Item(title, what, reads, is_plain and not jumped and not reads & fixed))
        jumped = jumped or (isinstance(what, str) and _JUMP.fullmatch(what) is not None)
    return items


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


def _pieces(items: Sequence[Item]) -> list[list[Item]]:
    """Runs of what may move, each cut into equal shares of at most PART; what stays, as it stands."""
    pieces = []
    for movable, group in groupby(items, key=lambda item: item.movable):
        run = list(group)
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


def _store(name: str, slots: dict[str, int], passed: str) -> Item:
    statement = Statement(f"{passed}[{slots[name]}]", name, False)
    return Item("what the next part reads", statement, frozenset({name}), False)


def _load(name: str, slots: dict[str, int], passed: str) -> Item:
    return Item("what comes back", Statement(name, f"{passed}[{slots[name]}]"), frozenset({passed}), False)


def _part(kernel: Kernel, name: str, piece: Sequence[Item], slots: dict[str, int], passed: str) -> Kernel:
    """One part: what it reads of others, its own statements, what others read of it."""
    own = {item.defines for item in piece}
    needs = sorted({n for item in piece for n in item.reads if n in slots and n not in own}, key=slots.__getitem__)
    tested = any(isinstance(item.what, str) for item in piece)
    before = [replace(_load(n, slots, passed), title="from the parts before") for n in needs]
    within = [replace(item, what=_failing(item.what)) if isinstance(item.what, str) else item for item in piece]
    after = [replace(_store(n, slots, passed), title="for the parts that follow") for n in slots if n in own]
    end = [Item("for the parts that follow", "return 0;", frozenset(), False)] if tested else []
    return Kernel(
        name, (f"A part of `{kernel.name}`, which calls it.",), (*kernel.arguments, Argument("double *", passed)),
        _sections([*before, *within, *after, *end]), "int" if tested else "void", attribute="noinline",
    )  # fmt: skip


def _failing(line: str) -> str:
    """A test, answered by its number."""
    found = _TEST.fullmatch(line)
    assert found is not None  # nothing else moves
    return f"if ({found['test']}) return {found['number'] or found['told']};"


def _call(
    kernel: Kernel, name: str, piece: Sequence[Item], slots: dict[str, int], passed: str, rest: set[str]
) -> list[Item]:
    """The call, what the function itself reads of the part, and what is done where a test failed."""
    call = f"{name}({', '.join(argument.name for argument in kernel.arguments)}, {passed});"
    tests = [found for item in piece if isinstance(item.what, str) and (found := _TEST.fullmatch(item.what))]
    loads = [_load(n, slots, passed) for n in slots if n in rest and n in {item.defines for item in piece}]
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
