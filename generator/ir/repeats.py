"""Division of statements into groups that repeat (loop rerolling), such as those of equal bars of a chain.

Statements are compared by their shapes: what they compute, without the names of their operands. Adjacent symbols that
occur together most often are replaced by a new symbol, again and again (grammar-based compression: N. J. Larsson, A.
Moffat, Off-line dictionary-based compression, Proceedings of the IEEE 88 (2000), 1722-1732). What is left is a
sequence of groups, and equal symbols stand for groups of equal shapes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from functools import lru_cache

import sympy as sp

from gudgeon.generator.ir.expression_structure import find_expression_structure
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.symbols.derivatives import find_symbols
from gudgeon.generator.symbols.storage import Key, StorageLocation, find_value_key

MIN_REPETITIONS = 3  # of a group for which a function with index tables is shorter

Pair = tuple[int, int]
_STRUCTURE_KEYS: dict[Hashable, Hashable] = {}  # (structure of an expression, kinds of its operands) -> structure key


def divide_into_repeats(shapes: Sequence[Hashable], max_length: int, min_length: int) -> list[tuple[int, bool]]:
    """Return (length, whether it repeats) of successive groups of a sequence of shapes.

    A group repeats if MIN_REPETITIONS or more groups of the sequence have the same shapes and `min_length` to
    `max_length` statements; equal groups need not be adjacent. The groups are the symbols of the repeated replacement
    of pairs. Statements between two such groups form one group that does not repeat.
    """
    symbols, lengths = _replace_pairs(shapes, max_length)
    counts = Counter(symbols)
    groups: list[tuple[int, bool]] = []
    for symbol in symbols:
        repeats = counts[symbol] >= MIN_REPETITIONS and lengths[symbol] >= min_length
        if groups and not repeats and not groups[-1][1]:
            groups[-1] = groups[-1][0] + lengths[symbol], False
        else:
            groups.append((lengths[symbol], repeats))
    return groups


def _replace_pairs(shapes: Sequence[Hashable], max_length: int) -> tuple[list[int], list[int]]:
    """Return the sequence of symbols that replaces a sequence of shapes, and the length of each symbol in statements.

    In each round, each symbol takes part in the most frequent of its pairs only, so that equal stretches are
    replaced alike. A symbol stands for at most `max_length` statements.
    """
    number_by_shape: dict[Hashable, int] = {}
    symbols = [number_by_shape.setdefault(shape, len(number_by_shape)) for shape in shapes]
    lengths = [1] * len(number_by_shape)
    while True:
        counts = Counter(zip(symbols, symbols[1:], strict=False))
        for pair in counts:
            if pair[0] == pair[1]:  # of three equal symbols one pair is replaced
                counts[pair] //= 2
        new_symbols = _choose_pairs(counts, lengths, max_length)
        if not new_symbols:
            return symbols, lengths
        symbols = _replace_symbol_pairs(symbols, new_symbols)


def _choose_pairs(counts: Mapping[Pair, int], lengths: list[int], max_length: int) -> dict[Pair, int]:
    """Return the new symbol of each pair that is replaced in a round, the most frequent ones first.

    No symbol is in two of these pairs. `lengths` is extended by those of the new symbols.
    """
    used: set[int] = set()
    new_symbols: dict[Pair, int] = {}
    for pair, count in sorted(counts.items(), key=lambda item: -item[1]):
        if count < MIN_REPETITIONS:
            break
        length = lengths[pair[0]] + lengths[pair[1]]
        if length <= max_length and used.isdisjoint(pair):
            used.update(pair)
            new_symbols[pair] = len(lengths)
            lengths.append(length)
    return new_symbols


def _replace_symbol_pairs(symbols: Sequence[int], new_symbols: Mapping[Pair, int]) -> list[int]:
    """Return a sequence with the pairs in `new_symbols` replaced from left to right."""
    result: list[int] = []
    last = len(symbols) - 1
    k = 0
    while k <= last:
        new_symbol = new_symbols.get((symbols[k], symbols[k + 1])) if k < last else None
        result.append(symbols[k] if new_symbol is None else new_symbol)
        k += 1 if new_symbol is None else 2
    return result


def make_line_structure_key(line: Instruction, copies: Mapping[str, Instruction]) -> Hashable:
    """Return the structure of a statement or of a test of a pivot, without the names of its operands.

    `copies`: the statements that copy arguments, by the name of their local. Lines of one shape usually differ in
    names, numbers of elements and statuses only; a target that merges their code compares the texts.
    """
    shapes = [_make_cached_structure_key(expression, copies) for expression in line.expressions]
    if isinstance(line, Statement):
        return (_find_place_kind(line.target), type(line.value).__name__, _find_place_kind(line.value), *shapes)
    return (type(line).__name__, *shapes)


def _find_place_kind(value: object) -> Hashable:
    """Return a storage location without numbers of elements and names of parameters: ("rhs", "clearance", "Fx").

    A parameter gives the name of its struct, a value that is no location "".
    """
    if isinstance(value, StorageLocation) and value.is_parameter:
        return value.base
    return (
        (value.base, *(step for step in value.path if isinstance(step, str)))
        if isinstance(value, StorageLocation)
        else ""
    )


def _make_cached_structure_key(expression: sp.Basic, copies: Mapping[str, Instruction]) -> Hashable:
    """Return `_make_structure_key`, which is derived once for expressions of equal structure and kinds of operands."""
    if (found := find_expression_structure(expression)) is None:
        return _make_structure_key(expression, copies)
    structure, keys = found
    kinds = tuple([_find_operand_kind(key, copies) for key in keys])
    if (key := _STRUCTURE_KEYS.get((structure, kinds))) is None:
        key = _STRUCTURE_KEYS[structure, kinds] = _make_structure_key(expression, copies)
    return key


def _find_operand_kind(key: Key, copies: Mapping[str, Instruction]) -> Hashable:
    """Return the kind of storage location that an operand is or copies; "" for a local that copies none."""
    copy = key if isinstance(key, StorageLocation) else copies.get(key)
    return _find_place_kind(copy.value if isinstance(copy, Statement) else copy)


def _make_structure_key(expression: sp.Basic, copies: Mapping[str, Instruction]) -> Hashable:
    """Return the structure of an expression as nested tuples, with the kind of storage location for each symbol.

    Expressions with equal keys differ in names only. A local that copies no argument gives "". Terms of a sum and
    factors of a product are in the order of the names of their symbols, as in the text.
    """
    if expression.is_Symbol:
        return _find_operand_kind(find_value_key(expression), copies)
    operands = expression.args
    if not operands:
        return str(expression)
    if expression.is_Add or expression.is_Mul:
        operands = sorted(operands, key=_find_order)
    return (type(expression).__name__, *[_make_structure_key(operand, copies) for operand in operands])


@lru_cache(200_000)
def _find_order(operand: sp.Basic) -> tuple[str, ...]:
    """Return the sort key of a term or factor: the names of its symbols in order, () for a number."""
    return (operand.name,) if operand.is_Symbol else tuple(sorted([symbol.name for symbol in find_symbols(operand)]))
