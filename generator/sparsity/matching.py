"""Rows matched with columns, and the block triangular form that follows (A. Pothen, C.-J. Fan, 1990)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from sympy.utilities.iterables import strongly_connected_components


@dataclass(frozen=True)
class Block:
    """As many rows as coordinates, by number."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def match_rows(pattern: Sequence[set[int]]) -> dict[int, int]:
    """Rows by columns of their own, for as many rows as there is one for (augmenting paths)."""
    owner: dict[int, int] = {}

    def find(row: int, tried: set[int]) -> bool:
        for column in sorted(pattern[row]):
            if column not in tried:
                tried.add(column)
                if column not in owner or find(owner[column], tried):
                    owner[column] = row
                    return True
        return False

    for row in range(len(pattern)):
        find(row, set())
    return owner


def triangular_blocks(pattern: Sequence[set[int]], n: int) -> tuple[Block, ...] | None:
    """Blocks in solving order of a square pattern, columns by row; None where no row is left for some column."""
    if len(pattern) != n:
        return None
    owner = match_rows(pattern)
    if len(owner) < n:
        return None
    matched = {row: column for column, row in owner.items()}
    needs = [(row, owner[column]) for row in range(n) for column in sorted(pattern[row]) if owner[column] != row]
    parts = strongly_connected_components((list(range(n)), needs))  # those that others need come first
    return tuple(Block(rows := tuple(sorted(part)), tuple(matched[row] for row in rows)) for part in parts)
