"""Division of a long generated function into parts that a C compiler can handle (code outlining), and scheduling.

Compilers allocate registers for a function as a whole, in more than linear time: the dynamics of 64 four-bars as one
function of ten thousand statements would take gcc a minute. So a kernel of more than _MAX_LINES lines becomes several
of at most _MAX_PART_LINES statements, called one after the other. A value that one part computes and another reads is
passed through an array, under the same name in both. Shorter kernels, that is all except long chains, stay as they
are. Runs of plain statements and of tests of pivots are divided. Lines that declare, call or jump stay in the function
itself, and so do lines that read names which only such lines know. Before that, statements are moved near those that
read them (`order_statements_near_readers`). As derived, a kernel first computes all directions and arms, then all
pivots, then all substitutions: in a long one each value has left the registers and the nearest cache before it is
read. Here a result or a test of a pivot is preceded by its operands, and a statement whose operands are all known
follows at once. Each statement is unchanged and follows its operands: the numbers are the same, bit for bit. Where
statements repeat, as those of equal bars of a chain do, parts are cut so that they repeat as well (repeats.py). A
target may then print equal parts once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.repeats import divide_into_repeats, make_line_structure_key
from gudgeon.generator.ir.signatures import (
    PARAMETERS,
    Access,
    Argument,
    Number,
    make_input_argument,
    make_output_argument,
)
from gudgeon.generator.ir.statements import (
    AssignStatus,
    Call,
    Declare,
    DeclareParameters,
    Guard,
    Instruction,
    Jump,
    Return,
    ReturnIfFailed,
    Sines,
    SolveDependentRows,
    Statement,
)
from gudgeon.generator.symbols.storage import StorageLocation


def order_statements_near_readers(read_names: Sequence[frozenset[str]], defined_names: Sequence[str]) -> list[int]:
    """Return a schedule of statements, as a list of indices, in which each is near those that read its result.

    This shortens the live ranges of values. Statement k reads the names `read_names[k]` and defines `defined_names[k]`
    ("": a result or a test). Each follows the statements whose results it reads.
    """
    index_by_name = {name: k for k, name in enumerate(defined_names) if name}
    dependencies = [
        {index_by_name[name] for name in names if name in index_by_name} - {k} for k, names in enumerate(read_names)
    ]
    readers: list[list[int]] = [[] for _ in read_names]
    for k, needed in enumerate(dependencies):
        for operand in needed:
            readers[operand].append(k)
    order: list[int] = []
    n_missing = [len(needed) for needed in dependencies]
    is_scheduled = [False] * len(read_names)

    def append_with_ready_readers(first_index: int) -> None:
        """Append statement `first_index` to the order, then all statements whose last missing operand it defines."""
        ready_indices = [first_index]
        while ready_indices:
            k = ready_indices.pop()
            if is_scheduled[k]:
                continue
            is_scheduled[k] = True
            order.append(k)
            for reader in readers[k]:
                n_missing[reader] -= 1
            ready_indices += [
                reader for reader in reversed(readers[k]) if not n_missing[reader] and not is_scheduled[reader]
            ]

    roots = [k for k, following in enumerate(readers) if not following]
    for root in roots:
        pending = [root]
        while pending:
            k = pending[-1]
            operands = [operand for operand in sorted(dependencies[k], reverse=True) if not is_scheduled[operand]]
            if operands and not is_scheduled[k]:
                pending += operands
                continue
            pending.pop()
            if not is_scheduled[k]:
                append_with_ready_readers(k)
    return order


_MAX_LINES, _MAX_PART_LINES, _MIN_PART_LINES = 850, 250, 60
_MAX_REPEATED_LINES, _MIN_REPEATED_LINES = 60, 12  # of a part that is cut because it repeats


@dataclass(frozen=True)
class LineInSection:
    """A line with its section's title and the names that it reads; `is_movable`: it may stand in a part."""

    title: str
    line: Instruction
    reads: frozenset[str]  # the array that is written to included
    is_movable: bool

    @property
    def defines(self) -> str:
        """Return the local that the line declares, or ""."""
        return self.line.declared_local


def split_kernel(kernel: Kernel) -> tuple[Kernel, ...]:
    """Return the parts of a long kernel as functions and, last, the function that calls them.

    A kernel of at most _MAX_LINES lines, or one without enough movable lines (statements and tests of pivots), is
    returned unchanged as the only element.
    """
    if sum(len(section.statements) for section in kernel.sections) <= _MAX_LINES:
        return (kernel,)
    section_lines, copies = _list_section_lines(kernel)
    segments = _divide_lines(section_lines, {name: section_line.line for name, section_line in copies.items()})
    if not any(map(_is_outlined, segments)):
        return (kernel,)
    added_arguments = (*_list_constant_locals(kernel), *_list_local_arrays(kernel))
    array_name = _find_unused_name("passed", section_lines)
    index_of_passed = _number_passed_locals(segments)
    splitter = _Splitter(kernel, index_of_passed, array_name, copies, added_arguments)
    segments, functions = _outline_dependent_row_terms(segments, splitter)
    title = "values that pass between the parts"
    main_lines = [
        LineInSection(title, Declare(Number.REAL, array_name, (max(len(index_of_passed), 1),)), frozenset(), False)
    ]
    parts: list[Kernel] = []
    stored_names: set[str] = set()
    available: set[str] = set()  # locals of the calling function
    for segment, later_read_names in zip(segments, _find_names_read_later(segments), strict=True):
        if not _is_outlined(segment):
            main_lines += segment
            available |= {section_line.defines for section_line in segment}
            continue
        passed_reads = {name_ for section_line in segment for name_ in section_line.reads if name_ in index_of_passed}
        defined = {section_line.defines for section_line in segment}
        main_lines += [
            splitter.make_store_line(name)
            for name in sorted((passed_reads - defined) & available - stored_names, key=index_of_passed.__getitem__)
        ]
        stored_names |= passed_reads & available
        name = f"{kernel.name}_part_{len(parts) + 1}"
        parts.append(splitter.make_part(name, segment))
        main_lines += splitter.make_call_lines(name, segment, later_read_names)
        available |= defined & later_read_names & index_of_passed.keys()
        stored_names |= defined & index_of_passed.keys()
    return (*parts, *functions, replace(kernel, sections=_group_sections(_insert_argument_copies(main_lines, copies))))


def _find_names_read_later(segments: Sequence[Sequence[LineInSection]]) -> list[frozenset[str]]:
    """Return for each segment (a part, or lines between parts) the names that later lines of the calling function read.

    Lines of later parts do not count: they read values of other parts from the array of passed values.
    """
    later_read_names = [frozenset[str]()]
    for segment in reversed(segments[1:]):
        names = later_read_names[-1]
        later_read_names.append(
            names if _is_outlined(segment) else names.union(*(section_line.reads for section_line in segment))
        )
    return later_read_names[::-1]


def _list_section_lines(kernel: Kernel) -> tuple[list[LineInSection], dict[str, LineInSection]]:
    """Return all lines of a kernel in order, except copies of arguments, and these copies by the name of their local.

    Each part makes its own copy where it reads one. A line is movable if it is a statement or a test of a pivot, stands
    before any jump, and reads no name that only unmovable lines know.
    """
    titles_and_lines = [(section.title, line) for section in kernel.sections for line in section.statements]
    constant = {argument.name for argument in kernel.arguments if argument.access in (Access.CONSTANT, Access.READ)}
    constant |= {argument.name for argument in _list_constant_locals(kernel)}
    known_names = {line.declared_local for _, line in titles_and_lines} | constant
    known_names |= {argument.name for argument in (*kernel.arguments, *_list_local_arrays(kernel))}
    unmovable_names = {
        name for _, line in titles_and_lines if not _is_movable_line(line) for name in line.reads | line.writes
    } - known_names
    section_lines: list[LineInSection] = []
    copies: dict[str, LineInSection] = {}
    is_after_jump = False
    for title, line in titles_and_lines:
        reads = line.reads | line.writes
        section_line = LineInSection(
            title, line, reads, _is_movable_line(line) and not is_after_jump and not reads & unmovable_names
        )
        is_after_jump = is_after_jump or isinstance(line, Jump)
        if _find_copied_argument(line) in constant:
            copies[section_line.defines] = section_line
        else:
            section_lines.append(section_line)
    return section_lines, copies


def _is_movable_line(line: Instruction) -> bool:
    """Return whether a line is a statement or a test of a pivot, which may be moved to a part."""
    return isinstance(line, (Statement, Guard))


def _find_copied_argument(line: Instruction) -> str:
    """Return the name of the argument or array from which a statement copies to a local; "" for other lines."""
    return (
        line.value.base
        if isinstance(line, Statement) and line.declared_local and isinstance(line.value, StorageLocation)
        else ""
    )


def _list_constant_locals(kernel: Kernel) -> list[Argument]:
    """Return the locals that a function declares once and its parts get as arguments.

    These are the arrays of sines and cosines that a loop fills, and the parameters if the function reads their
    address.
    """
    lines = [line for section in kernel.sections for line in section.statements]
    loops = [line for line in lines if isinstance(line, Sines) and line.count]
    parameters = [PARAMETERS for line in lines if isinstance(line, DeclareParameters)]
    return [*(make_input_argument(name, "Four") for line in loops for name in line.arrays), *parameters]


def _list_local_arrays(kernel: Kernel) -> list[Argument]:
    """Return the local arrays of real numbers with one index, which parts get as arguments."""
    lines = (line for section in kernel.sections for line in section.statements if isinstance(line, Declare))
    return [make_output_argument(line.name) for line in lines if line.type is Number.REAL and len(line.sizes) == 1]


def _divide_lines(
    section_lines: Sequence[LineInSection], copies: Mapping[str, Instruction]
) -> list[list[LineInSection]]:
    """Return the lines in segments: each sequence of movable lines divided into parts, other lines between them.

    A part has at most _MAX_PART_LINES lines. A run shorter than _MIN_PART_LINES becomes unmovable and stays in the
    calling function. Within a run, lines are reordered (`_order_lines`). `copies`: the lines that copy arguments, by
    the name of their local.
    """
    segments = []
    for is_movable, group in groupby(section_lines, key=lambda section_line: section_line.is_movable):
        lines = _order_lines(list(group))
        if is_movable and len(lines) >= _MIN_PART_LINES:
            segments += _divide_movable_lines(lines, copies)
        else:
            segments.append([replace(section_line, is_movable=False) for section_line in lines])
    return segments


def _divide_movable_lines(
    lines: Sequence[LineInSection], copies: Mapping[str, Instruction]
) -> list[list[LineInSection]]:
    """Return movable lines in parts: groups of lines that repeat, and the lines between them in parts of equal length.

    The latter have at most _MAX_PART_LINES lines.
    """
    segments = []
    first = 0
    shapes = [make_line_structure_key(section_line.line, copies) for section_line in lines]
    for length, repeats in divide_into_repeats(shapes, _MAX_REPEATED_LINES, _MIN_REPEATED_LINES):
        n_pieces = 1 if repeats else -(-length // _MAX_PART_LINES)
        size = -(-length // n_pieces)
        segments += [list(lines[k : min(k + size, first + length)]) for k in range(first, first + length, size)]
        first += length
    return segments


def _is_outlined(segment: Sequence[LineInSection]) -> bool:
    """Return whether a segment of lines becomes a function of its own: its lines are movable."""
    return segment[0].is_movable


def _number_passed_locals(segments: Sequence[Sequence[LineInSection]]) -> dict[str, int]:
    """Return an index in the array of passed values for every local that one segment computes and another reads.

    Indices follow the order of computation. Two segments that both stay in the calling function pass nothing.
    """
    piece_of_local = {
        section_line.defines: k
        for k, segment in enumerate(segments)
        for section_line in segment
        if section_line.defines
    }
    passed_names = {
        name
        for k, segment in enumerate(segments)
        for section_line in segment
        for name in section_line.reads
        if name in piece_of_local
        and piece_of_local[name] != k
        and (_is_outlined(segment) or _is_outlined(segments[piece_of_local[name]]))
    }
    return {name: index for index, name in enumerate(name for name in piece_of_local if name in passed_names)}


def _outline_dependent_row_terms(
    segments: Sequence[Sequence[LineInSection]], splitter: _Splitter
) -> tuple[list[list[LineInSection]], list[Kernel]]:
    """Return (segments, new functions); a new function computes the forces and right-hand sides for a vanished pivot.

    In the calling function each of them would be a local that is alive over the calls of all parts, from any of which
    the code may be reached. Nothing is moved if one reads more than arguments and results of parts.
    """
    available = {
        name
        for segment in segments
        if _is_outlined(segment)
        for name in (section_line.defines for section_line in segment)
    }
    available &= splitter.index_of_passed.keys()
    available |= splitter.argument_copies.keys() | {argument.name for argument in splitter.kernel.arguments}
    functions: list[Kernel] = []

    def replace_by_call(section_line: LineInSection) -> LineInSection:
        """Return a line of redundant equations with a call in place of the expressions that the new function computes.

        Other lines are returned unchanged. The new function is appended to `functions`.
        """
        line = section_line.line
        if not (isinstance(line, SolveDependentRows) and line.force):
            return section_line
        arrays = {name: make_output_argument(name) for name in ("force", "gamma_stab")}
        values = zip(arrays.values(), (line.force, line.rhs), strict=True)
        stores = [Statement(array[k], value) for array, expressions in values for k, value in enumerate(expressions)]
        if not all(store.reads <= available for store in stores):
            return section_line
        name = f"{splitter.kernel.name}_dependent"
        kernel = replace(splitter.kernel, arguments=(*splitter.kernel.arguments, *arrays.values()))
        lines = [LineInSection("", store, store.reads | store.writes, True) for store in stores]
        new = replace(splitter, kernel=kernel)
        functions.append(new.make_part(name, lines))
        call = Call(
            name,
            tuple(StorageLocation(a.name) for a in new.list_arguments(lines)),
            (StorageLocation(splitter.array_name),),
        )
        new_line = replace(line, force=(), rhs=(), call=call)
        return replace(section_line, line=new_line, reads=new_line.reads)

    return [[replace_by_call(section_line) for section_line in segment] for segment in segments], functions


def _find_unused_name(name: str, section_lines: Sequence[LineInSection]) -> str:
    """Return the name with underscores appended until no line of `section_lines` reads or defines it."""
    used_names = {
        read_name for section_line in section_lines for read_name in (*section_line.reads, section_line.defines)
    }
    while name in used_names:
        name += "_"
    return name


def _order_lines(section_lines: list[LineInSection]) -> list[LineInSection]:
    """Return the lines in an order in which each is near those that read its result.

    They are returned unchanged if a line reads an array that one of them writes.
    """
    written_arrays = frozenset().union(*(section_line.line.writes for section_line in section_lines))
    if any(written_arrays & section_line.line.reads for section_line in section_lines):
        return section_lines
    return [
        section_lines[k]
        for k in order_statements_near_readers(
            [section_line.reads for section_line in section_lines],
            [section_line.defines for section_line in section_lines],
        )
    ]


def _insert_argument_copies(
    section_lines: Sequence[LineInSection], copies: dict[str, LineInSection]
) -> list[LineInSection]:
    """Return the lines of the calling function with the copies of arguments inserted that it reads.

    Arguments are copied first of all, elements of arrays of sines and cosines after the line that fills the array. The
    reading line cannot copy them, because it may be in a block or after a label.
    """
    read_names = frozenset[str]().union(*(section_line.reads for section_line in section_lines))
    needed_copies = [section_line for name, section_line in copies.items() if name in read_names]
    filled_arrays = {name for section_line in section_lines for name in _find_filled_arrays(section_line.line)}
    result = [section_line for section_line in needed_copies if not section_line.reads & filled_arrays]
    for section_line in section_lines:
        result.append(section_line)
        if filled := _find_filled_arrays(section_line.line):
            result += [copy_ for copy_ in needed_copies if copy_.reads & filled]
    return result


def _find_filled_arrays(line: Instruction) -> set[str]:
    """Return the names of the arrays of sines and cosines that a line fills in a loop; empty for other lines."""
    return set(line.arrays) if isinstance(line, Sines) and line.count else set()


@dataclass(frozen=True)
class _Splitter:
    """A kernel with the array of passed values, the copies of arguments, and further arguments of its parts."""

    kernel: Kernel
    index_of_passed: dict[str, int]
    array_name: str
    argument_copies: dict[str, LineInSection]
    added_arguments: tuple[Argument, ...]

    def list_arguments(self, segment: Sequence[LineInSection]) -> tuple[Argument, ...]:
        """Return the arguments of a part without the array of passed values: of the added ones those that it reads."""
        names = frozenset[str]().union(*(section_line.reads for section_line in segment))
        names = names.union(*(self.argument_copies[name].reads for name in names & self.argument_copies.keys()))
        return (*self.kernel.arguments, *(argument for argument in self.added_arguments if argument.name in names))

    def make_store_line(self, name: str, title: str = "values for later parts") -> LineInSection:
        """Return the line that stores the local `name` in its element of the array of passed values."""
        statement = Statement(StorageLocation(self.array_name, (self.index_of_passed[name],)), StorageLocation(name))
        return LineInSection(title, statement, frozenset((name,)), False)

    def make_load_line(self, name: str, title: str = "values from the part") -> LineInSection:
        """Return the line that reads the local `name` of another part from the array of passed values."""
        place = StorageLocation(self.array_name, (self.index_of_passed[name],))
        return LineInSection(title, Statement(name, place), place.names, False)

    def make_reading_line(self, name: str, title: str) -> LineInSection:
        """Return the line that reads the local `name`: a copy of an argument, or a value of another part."""
        if copy_ := self.argument_copies.get(name):
            return LineInSection(title, copy_.line, copy_.reads, copy_.is_movable)
        return self.make_load_line(name, title)

    def make_part(self, name: str, segment: list[LineInSection]) -> Kernel:
        """Return the segment of lines as a function `name`.

        It reads values of other parts from the array of passed values, executes its lines, and stores values that
        others read. It returns a status if it tests a pivot.
        """
        defined = {section_line.defines for section_line in segment}
        has_test = any(isinstance(section_line.line, Guard) for section_line in segment)
        lines: list[LineInSection] = []
        known_names = set(defined)
        for section_line in segment:
            for name_ in sorted(section_line.reads - known_names):
                if name_ in self.argument_copies or name_ in self.index_of_passed:
                    lines.append(self.make_reading_line(name_, section_line.title))
                    known_names.add(name_)
            lines.append(
                replace(section_line, line=replace(section_line.line, jumps=False))
                if isinstance(section_line.line, Guard)
                else section_line
            )
            if section_line.defines in self.index_of_passed:
                lines.append(self.make_store_line(section_line.defines, section_line.title))
        end_lines = [LineInSection("", Return(), frozenset(), False)] if has_test else []
        return Kernel(
            name,
            (f"A part of `{self.kernel.name}`, which calls it.",),
            (*self.list_arguments(segment), make_output_argument(self.array_name)),
            _group_sections([*lines, *end_lines]),
            has_test,
            attribute="noinline",
            names=self.kernel.names,
        )

    def make_call_lines(
        self, name: str, segment: list[LineInSection], later_read_names: frozenset[str]
    ) -> list[LineInSection]:
        """Return the lines of the calling function that call part `name` and read values that it has stored.

        Read are those in `later_read_names`, the names that later lines of the calling function read. If the part tests
        pivots, a status other than 0 ends the function or jumps to the code for a vanishing pivot.
        """
        arguments = tuple(StorageLocation(argument.name) for argument in self.list_arguments(segment))
        call = Call(name, arguments, (StorageLocation(self.array_name),))
        tests = [section_line.line for section_line in segment if isinstance(section_line.line, Guard)]
        loaded = {section_line.defines for section_line in segment} & later_read_names & self.index_of_passed.keys()
        loads = [self.make_load_line(local) for local in sorted(loaded, key=self.index_of_passed.__getitem__)]
        lines: list[Instruction] = [call]
        status_lines: list[Instruction] = []
        if tests:
            jumps = tests[0].jumps
            status = "pivot" if jumps else f"status_{name.rpartition('_')[2]}"
            lines, status_lines = [AssignStatus(call, status)], [ReturnIfFailed(status, jumps)]
        title = segment[0].title
        return [
            *(LineInSection(title, line, frozenset(), False) for line in lines),
            *loads,
            *(LineInSection("values from the part", line, frozenset(), False) for line in status_lines),
        ]


def _group_sections(section_lines: Sequence[LineInSection]) -> tuple[Section, ...]:
    """Return the lines as sections; successive lines with the same title form one section."""
    grouped = (
        (title, tuple(section_line.line for section_line in group))
        for title, group in groupby(section_lines, key=lambda i: i.title)
    )
    return tuple(Section(title, statements) for title, statements in grouped)
