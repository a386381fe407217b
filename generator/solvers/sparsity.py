"""Sparse L D Lᵀ of the KKT matrix, symbolically: elimination order and structure; block triangular form.

The matrix is [M Φ_qᵀ; Φ_q 0]. A constraint equation is eliminated only after all the coordinates in it: its pivot is
then −Φ_q M⁻¹ Φ_qᵀ of what is left, never a structural zero, and negative as long as the equations are independent.
The order is chosen once, by counting products.
For square systems, equations are matched with unknowns, from which the block triangular form follows (A. Pothen,
C.-J. Fan, 1990).
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from sympy.utilities.iterables import strongly_connected_components

DIVISION = 20  # products in the time of one division and what waits for it (measured)
LONG = 8  # divisions in a chain that is long
Pattern = tuple[frozenset[int], ...]  # neighbours of each node in the graph of the matrix
NO_PAIRS: Mapping[int, int] = MappingProxyType({})
FIRST = (-1,)  # a key before all others


@dataclass(frozen=True)
class Elimination:
    """Order and structure of an L D Lᵀ: `order[k]` is the k-th pivot, `structure[k]` the later nodes in its column."""

    order: tuple[int, ...]
    structure: dict[int, tuple[int, ...]]
    products: int
    depth: int  # divisions in the longest chain of pivots that wait for each other

    @property
    def cost(self) -> int:
        """Return the cost in products, with at most LONG divisions that wait for each other.

        In longer chains other work fills the time.
        """
        return self.products + DIVISION * min(self.depth, LONG)


def choose_elimination(
    pattern: Pattern,
    coordinates: int,
    last: int | None = None,
    pairs: Mapping[int, int] = NO_PAIRS,
    first: Sequence[int] = (),
    partner: Mapping[int, int] = NO_PAIRS,
) -> Elimination:
    """Return the cheapest of a few greedy elimination orders.

    Nodes below `coordinates` are coordinates, the others equations; nodes from `last` on come after all others.
    Equations in `pairs` (each with its partner, in the same coordinates) may be eliminated once two of their
    coordinates
    are: their 2 × 2 pivot then vanishes where two links are in line, so that the caller must test it. Nodes in `first`
    come before all others, in their order; one with a `partner`, an equation with a constant entry in it, is eliminated
    together with that equation.
    """
    if first:
        orders = (
            _eliminate_in_order(first, pattern, coordinates, last, pairs, partner, eager) for eager in (False, True)
        )
        return min(orders if partner else [next(orders)], key=lambda e: e.cost)
    end = len(pattern) if last is None else last

    def degree(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of least degree."""
        return (node >= end, len(graph[node]), node)

    def fill(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of least fill-in."""
        near = sorted(graph[node])
        missing = sum(b not in graph[a] for i, a in enumerate(near) for b in near[i + 1 :])
        return (node >= end, missing, len(near), node)

    def bodies_first(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of least fill-in with all coordinates before equations."""
        return (node >= end, node >= coordinates, *fill(graph, node, wait))

    def untouched(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of least fill-in with nodes that no elimination has changed first."""
        return (node >= end, graph[node] != pattern[node], *fill(graph, node, wait))

    def shallow(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of least fill-in, then of the shortest chain of divisions."""
        _, missing, near, _ = fill(graph, node, wait)
        return (node >= end, missing, wait, near, node)

    def early(graph: Sequence[set[int]], node: int, wait: int) -> tuple[int, ...]:
        """Return the key of the shortest chain of divisions, then of least fill-in."""
        return (node >= end, wait, *fill(graph, node, wait))

    keys = (degree, fill, bodies_first, untouched, shallow, early)
    candidates = [
        _eliminate(pattern, coordinates, key, which) for which in (NO_PAIRS, pairs)[: 1 + bool(pairs)] for key in keys
    ]
    return min(candidates, key=lambda e: e.cost)


def _eliminate_in_order(
    first: Sequence[int],
    pattern: Pattern,
    coordinates: int,
    last: int | None,
    pairs: Mapping[int, int],
    partner: Mapping[int, int],
    eager: bool,
) -> Elimination:
    """Return the elimination of the nodes in `first` with their partners, then of the others by the best order.

    `eager`: a coordinate that is in none of the partners any more follows at once. Along a chain of bodies from its
    end,
    each is then coupled only with the one that carries it.
    """
    graph = [set(near) for near in pattern]
    columns = dict[int, set[int]]()
    rows, products = {*partner.values(), *(node for node in first if coordinates <= node < len(pattern))}, 0
    for node in first:
        products += _eliminate_node(node, partner.get(node), graph, columns)
        rows -= {node, partner.get(node)}
        ready = sorted(columns[node]) if eager and (node in partner or node >= coordinates) else ()
        for k in ready:
            if k < coordinates and k not in partner and k not in columns and not graph[k] & rows:
                products += _eliminate_node(k, None, graph, columns)
    left = [node for node in range(len(pattern)) if node not in columns]
    number = {node: k for k, node in enumerate(left)}
    rest = choose_elimination(
        tuple(frozenset(number[k] for k in graph[node]) for node in left),
        sum(node < coordinates for node in left),
        None if last is None else sum(node < last for node in left),
        {number[r]: number[other] for r, other in pairs.items() if r in number and other in number},
    )
    order = (*columns, *(left[k] for k in rest.order))
    place = {node: k for k, node in enumerate(order)}
    structure = {node: tuple(sorted(columns[node], key=place.__getitem__)) for node in columns}
    structure |= {left[k]: tuple(left[i] for i in column) for k, column in rest.structure.items()}
    alone = sum(node not in partner and node not in partner.values() for node in columns)
    return Elimination(order, structure, rest.products + products, rest.depth + alone)


def _eliminate_node(node: int, partner: int | None, graph: Sequence[set[int]], columns: dict[int, set[int]]) -> int:
    """Eliminate a node with its partner from the graph and return the number of products.

    The partner's neighbours are coupled with those of both.
    """
    gone = {node} if partner is None else {node, partner}
    own = graph[node] - gone
    through = own if partner is None else graph[partner] - gone
    columns[node] = (own | through | gone) - {node}
    if partner is not None:
        columns[partner] = own | through
    for k in own | through:
        graph[k] -= gone
        graph[k] |= (own | through if k in through else through) - {k}
    return len(through) * (len(through) + 3) // 2 + (0 if partner is None else len(through) * len(own - through))


def _eliminate(
    pattern: Pattern,
    coordinates: int,
    key: Callable[[Sequence[set[int]], int, int], tuple[int, ...]],
    pairs: Mapping[int, int],
) -> Elimination:
    """Return the greedy elimination that takes the node with the least `key` next."""
    graph = [set(near) for near in pattern]
    waiting = [sum(near < coordinates for near in pattern[n]) if n >= coordinates else 0 for n in range(len(pattern))]
    for n in pairs:
        waiting[n] = min(waiting[n], 2)
    left = set(range(len(pattern)))
    waits = [0] * len(pattern)  # how many pivots each node has to wait for, one after the other
    order, columns = list[int](), dict[int, set[int]]()
    keys = {node: key(graph, node, waits[node]) for node in left if waiting[node] == 0}
    heap = sorted((value, node) for node, value in keys.items())
    while left:
        value, node = heapq.heappop(heap)
        if keys.get(node) != value:
            continue  # its key has changed since it was pushed
        if pairs.get(node) in left:  # its partner comes next, before everything else
            heapq.heappush(heap, (FIRST, pairs[node]))
            keys[pairs[node]] = FIRST
        near = graph[node]
        order.append(node)
        columns[node] = set(near)
        left.discard(node)
        del keys[node]
        touched = set(near)
        for a in near:
            graph[a].discard(node)
            own = node >= coordinates and pairs.get(node) not in left or node < coordinates and waits[node] > 0
            waits[a] = max(waits[a], waits[node] + own)
            graph[a] |= near - {a}
            touched |= graph[a]
            if a >= coordinates and node < coordinates and a in pattern[node]:
                waiting[a] -= 1
        for a in touched & left:
            if keys.get(a) == FIRST:
                continue
            if waiting[a] <= 0:
                keys[a] = key(graph, a, waits[a])
                heapq.heappush(heap, (keys[a], a))
    place = {node: k for k, node in enumerate(order)}
    structure = {node: tuple(sorted(columns[node], key=place.__getitem__)) for node in order}
    products = sum(len(c) * (len(c) + 3) // 2 for c in columns.values())
    return Elimination(tuple(order), structure, products, _division_depth(order, structure, coordinates))


def _division_depth(order: Sequence[int], structure: Mapping[int, tuple[int, ...]], coordinates: int) -> int:
    """Return the length of the longest chain of divisions that wait for each other.

    Pivots that elimination does not change are computed beforehand; two that form a block count as one.
    """
    changed = set[int]().union(*structure.values())
    waits = dict.fromkeys(order, 0)
    paired = -1
    for place, k in enumerate(order):
        own = k != paired and (k >= coordinates or k in changed)
        following = order[place + 1] if place + 1 < len(order) else -1
        paired = following if own and structure[k] == (following, *structure.get(following, ())) else -1
        waits[k] += own
        for i in structure[k][:1]:
            waits[i] = max(waits[i], waits[k])
    return max(waits.values(), default=0)


@dataclass(frozen=True)
class Block:
    """A square block of a block triangular form: numbers of its equations and of as many unknowns."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def match_rows(pattern: Sequence[set[int]]) -> dict[int, int]:
    """Return a maximum matching of equations with unknowns, as the equation by unknown (augmenting paths)."""
    owner: dict[int, int] = {}

    def find(row: int, tried: set[int]) -> bool:
        """Return whether the equation gets an unknown, after moving other equations if necessary."""
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
    """Return the blocks of a square pattern in solving order; None if some unknown has no equation.

    `pattern`: the unknowns of each equation.
    """
    if len(pattern) != n:
        return None
    owner = match_rows(pattern)
    if len(owner) < n:
        return None
    matched = {row: column for column, row in owner.items()}
    needs = [(row, owner[column]) for row in range(n) for column in sorted(pattern[row]) if owner[column] != row]
    parts = strongly_connected_components((list(range(n)), needs))  # those that others need come first
    return tuple(Block(rows := tuple(sorted(part)), tuple(matched[row] for row in rows)) for part in parts)
