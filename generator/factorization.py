"""Sparse L D Lᵀ of the KKT matrix, symbolically: which entries exist, and the sums that give them.

The matrix is [M Φ_qᵀ; Φ_q 0] with a diagonal M. A row of Φ is eliminated only after all the
coordinates in it: its pivot is then −Φ_q M⁻¹ Φ_qᵀ of what is left, never a structural zero, and
negative as long as the rows are independent. The order is chosen here, once, by counting products.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Sequence
from dataclasses import dataclass

DIVISION = 8  # products in the time of one division

Pattern = tuple[frozenset[int], ...]  # neighbours of each node in the graph of the matrix


@dataclass(frozen=True)
class Elimination:
    """`order[k]` is the k-th pivot; `structure[k]` the later nodes in column k of L, in their order."""

    order: tuple[int, ...]
    structure: dict[int, tuple[int, ...]]
    products: int
    divisions: int  # pivots of coordinates that elimination changes: those of the others are known beforehand

    @property
    def cost(self) -> int:
        """In products; each division waits for the one before."""
        return self.products + DIVISION * self.divisions


def choose_elimination(pattern: Pattern, coordinates: int, last: int | None = None) -> Elimination:
    """The cheapest of a few greedy orders; nodes below `coordinates` are coordinates, the others rows.

    Nodes from `last` on come after all the others.
    """
    end = len(pattern) if last is None else last

    def degree(graph: Sequence[set[int]], node: int) -> tuple[int, ...]:
        return (node >= end, len(graph[node]), node)

    def fill(graph: Sequence[set[int]], node: int) -> tuple[int, ...]:
        near = sorted(graph[node])
        missing = sum(b not in graph[a] for i, a in enumerate(near) for b in near[i + 1 :])
        return (node >= end, missing, len(near), node)

    def bodies_first(graph: Sequence[set[int]], node: int) -> tuple[int, ...]:
        return (node >= end, node >= coordinates, *fill(graph, node))

    def untouched(graph: Sequence[set[int]], node: int) -> tuple[int, ...]:
        return (node >= end, graph[node] != pattern[node], *fill(graph, node))

    candidates = [_eliminate(pattern, coordinates, key) for key in (degree, fill, bodies_first, untouched)]
    return min(candidates, key=lambda e: e.cost)


def _eliminate(
    pattern: Pattern, coordinates: int, key: Callable[[Sequence[set[int]], int], tuple[int, ...]]
) -> Elimination:
    graph = [set(near) for near in pattern]
    waiting = [sum(near < coordinates for near in pattern[n]) if n >= coordinates else 0 for n in range(len(pattern))]
    left = set(range(len(pattern)))
    order: list[int] = []
    columns: dict[int, set[int]] = {}
    keys = {node: key(graph, node) for node in left if waiting[node] == 0}
    heap = sorted((value, node) for node, value in keys.items())
    while left:
        value, node = heapq.heappop(heap)
        if keys.get(node) != value:
            continue  # its key has changed since it was pushed
        near = graph[node]
        order.append(node)
        columns[node] = set(near)
        left.discard(node)
        del keys[node]
        touched = set(near)
        for a in near:
            graph[a].discard(node)
            graph[a] |= near - {a}
            touched |= graph[a]
            if a >= coordinates and node < coordinates and a in pattern[node]:
                waiting[a] -= 1
        for a in touched & left:
            if waiting[a] == 0:
                keys[a] = key(graph, a)
                heapq.heappush(heap, (keys[a], a))
    place = {node: k for k, node in enumerate(order)}
    structure = {node: tuple(sorted(columns[node], key=place.__getitem__)) for node in order}
    products = sum(len(c) * (len(c) + 3) // 2 for c in columns.values())
    changed = set[int]().union(*columns.values())
    return Elimination(tuple(order), structure, products, sum(node < coordinates for node in changed))
