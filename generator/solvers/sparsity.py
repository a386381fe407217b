"""Symbolic sparse L D Lᵀ of the KKT matrix: elimination order (minimum degree, fill-in) and block triangular form.

The matrix is [M Φ_qᵀ; Φ_q 0]. A constraint equation is eliminated only after all the coordinates in it: its pivot is
then −Φ_q M⁻¹ Φ_qᵀ of what is left, never a structural zero, and negative as long as the equations are independent. The
order is chosen once, by counting products. For square systems, equations are matched with unknowns, from which the
block triangular form follows (A. Pothen, C.-J. Fan, 1990).
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType

from sympy.utilities.iterables import strongly_connected_components

_DIVISION_COST = 20  # products in the time of one division on the critical path (measured)
_MAX_DIVISION_CHAIN = 8  # divisions of the critical path that count
Pattern = tuple[frozenset[int], ...]  # neighbours of each node in the graph of the matrix
NO_PAIRS: Mapping[int, int] = MappingProxyType({})
_FIRST_KEY = (-1,)  # a key before all others


@dataclass(frozen=True)
class Elimination:
    """Order and structure of an L D Lᵀ: `order[k]` is the k-th pivot, `structure[k]` the later nodes in its column."""

    order: tuple[int, ...]
    structure: dict[int, tuple[int, ...]]
    products: int
    depth: int  # divisions on the critical path, of which each needs the result of the one before

    @property
    def cost(self) -> int:
        """Return the cost in products: the products, and `_DIVISION_COST` for each division of the critical path.

        At most `_MAX_DIVISION_CHAIN` divisions count: along longer paths the processor executes other operations
        meanwhile.
        """
        return self.products + _DIVISION_COST * min(self.depth, _MAX_DIVISION_CHAIN)


def choose_elimination(
    pattern: Pattern,
    n_coordinates: int,
    first_trailing_node: int | None = None,
    row_pairs: Mapping[int, int] = NO_PAIRS,
    leading_nodes: Sequence[int] = (),
    partner_by_node: Mapping[int, int] = NO_PAIRS,
) -> Elimination:
    """Return the cheapest of a few greedy elimination orders of the KKT matrix, whose graph is `pattern`.

    Nodes below `n_coordinates` are coordinates, the others equations; nodes from `first_trailing_node` on come after
    all others (None: no node). Equations in `row_pairs` (each with its partner, in the same coordinates) may be
    eliminated once two of their coordinates are. Their 2 × 2 pivot then vanishes where two bodies are in line, so that
    the caller must test it. The `leading_nodes` come before all others, in their order; a node in `partner_by_node` is
    eliminated together with its partner, an equation with a constant entry in it.
    """
    elimination = find_elimination_below(
        math.inf, pattern, n_coordinates, first_trailing_node, row_pairs, leading_nodes, partner_by_node
    )
    assert elimination is not None
    return elimination


def find_elimination_below(
    limit: float,
    pattern: Pattern,
    n_coordinates: int,
    first_trailing_node: int | None = None,
    row_pairs: Mapping[int, int] = NO_PAIRS,
    leading_nodes: Sequence[int] = (),
    partner_by_node: Mapping[int, int] = NO_PAIRS,
) -> Elimination | None:
    """Return the elimination of `choose_elimination`, or None if every order needs more than `limit` products.

    The cost of the result may exceed `limit`, since it includes divisions. An order is abandoned as soon as its
    products exceed the cost of the best order so far, so that dense candidates of large mechanisms cost little time.
    """
    if leading_nodes:
        in_order = partial(
            _eliminate_in_order, leading_nodes, pattern, n_coordinates, first_trailing_node, row_pairs, partner_by_node
        )
        eager = in_order(True, limit) if partner_by_node else None
        plain = in_order(False, min(limit, eager.cost) if eager else limit)
        return min((order for order in (plain, eager) if order), key=lambda order: order.cost, default=None)
    if _compute_min_products(pattern) > limit:
        return None
    end = len(pattern) if first_trailing_node is None else first_trailing_node

    def compute_degree_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the key of least degree; nodes from `end` on come last."""
        return (node >= end, len(graph[node]), node)

    def compute_fill_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the sort key of a node for elimination: least fill-in, then least degree, then number.

        Nodes from `end` on come after all others. `graph`: the neighbours of each node; `depth` is not used.
        """
        neighbours = graph[node]
        n_present = sum(map(len, map(neighbours.__and__, map(graph.__getitem__, neighbours))))  # each edge twice
        n_neighbours = len(neighbours)
        return (node >= end, (n_neighbours * (n_neighbours - 1) - n_present) // 2, n_neighbours, node)

    def compute_bodies_first_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the key of least fill-in with all coordinates before equations."""
        return (node >= end, node >= n_coordinates, *compute_fill_key(graph, node, depth))

    def compute_unchanged_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the key of least fill-in, with nodes first whose neighbours elimination has not changed."""
        return (node >= end, graph[node] != pattern[node], *compute_fill_key(graph, node, depth))

    def compute_critical_path_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the key of least fill-in, then of the shortest chain of divisions (critical path)."""
        _, missing, neighbours, _ = compute_fill_key(graph, node, depth)
        return (node >= end, missing, depth, neighbours, node)

    def compute_path_first_key(graph: Sequence[set[int]], node: int, depth: int) -> tuple[int, ...]:
        """Return the key of the shortest critical path (chain of divisions), then of least fill-in."""
        return (node >= end, depth, *compute_fill_key(graph, node, depth))

    keys = (
        compute_degree_key,
        compute_fill_key,
        compute_bodies_first_key,
        compute_unchanged_key,
        compute_critical_path_key,
        compute_path_first_key,
    )
    best: Elimination | None = None
    for equation_pairs in (NO_PAIRS, row_pairs)[: 1 + bool(row_pairs)]:
        for key in keys:
            candidate = _eliminate_greedily(pattern, n_coordinates, key, equation_pairs, best.cost if best else limit)
            if candidate and (best is None or candidate.cost < best.cost):
                best = candidate
    return best


def _compute_min_products(pattern: Pattern) -> int:
    """Return a lower bound of the products of any elimination of a pattern, from the least degree d of its nodes.

    It is Σ k (k + 3)/2 for k = 0 … d: the first pivot couples its d or more neighbours with each other, so that the
    elimination of these has at least d − 1, d − 2, …, 0 entries in its columns.
    """
    degree = min(map(len, pattern), default=0)
    return sum(k * (k + 3) // 2 for k in range(degree + 1))


def _eliminate_in_order(
    leading_nodes: Sequence[int],
    pattern: Pattern,
    n_coordinates: int,
    first_trailing_node: int | None,
    row_pairs: Mapping[int, int],
    partner_by_node: Mapping[int, int],
    eager: bool,
    limit: float,
) -> Elimination | None:
    """Return the elimination of `leading_nodes` with their partners, then of the others by the best greedy order.

    Return None if the products exceed `limit`. `eager`: a coordinate that occurs in no remaining equation of
    `leading_nodes` follows at once. Along a chain of bodies from its end, each is then coupled only with the one that
    carries it. The other arguments are those of `choose_elimination`.
    """
    graph = [set(neighbours) for neighbours in pattern]
    columns = dict[int, set[int]]()
    remaining_rows, products = (
        {*partner_by_node.values(), *(node for node in leading_nodes if n_coordinates <= node < len(pattern))},
        0,
    )
    for node in leading_nodes:
        products += _eliminate_node(node, partner_by_node.get(node), graph, columns)
        if products > limit:
            return None
        remaining_rows -= {node, partner_by_node.get(node)}
        ready_coordinates = (
            sorted(columns[node]) if eager and (node in partner_by_node or node >= n_coordinates) else ()
        )
        for candidate in ready_coordinates:
            if (
                candidate < n_coordinates
                and candidate not in partner_by_node
                and candidate not in columns
                and not graph[candidate] & remaining_rows
            ):
                products += _eliminate_node(candidate, None, graph, columns)
    remaining = [node for node in range(len(pattern)) if node not in columns]
    index_of = {node: candidate for candidate, node in enumerate(remaining)}
    remaining_elimination = find_elimination_below(
        limit - products,
        tuple(frozenset(index_of[candidate] for candidate in graph[node]) for node in remaining),
        sum(node < n_coordinates for node in remaining),
        None if first_trailing_node is None else sum(node < first_trailing_node for node in remaining),
        {
            index_of[r]: index_of[partner_row]
            for r, partner_row in row_pairs.items()
            if r in index_of and partner_row in index_of
        },
    )
    if remaining_elimination is None:
        return None
    order = (*columns, *(remaining[candidate] for candidate in remaining_elimination.order))
    position = {node: candidate for candidate, node in enumerate(order)}
    structure = {node: tuple(sorted(columns[node], key=position.__getitem__)) for node in columns}
    structure |= {
        remaining[candidate]: tuple(remaining[i] for i in column)
        for candidate, column in remaining_elimination.structure.items()
    }
    n_single = sum(node not in partner_by_node and node not in partner_by_node.values() for node in columns)
    return Elimination(
        order, structure, remaining_elimination.products + products, remaining_elimination.depth + n_single
    )


def _eliminate_node(node: int, partner: int | None, graph: Sequence[set[int]], columns: dict[int, set[int]]) -> int:
    """Eliminate a node, with its partner if it has one, from the graph in place; return the number of products.

    The columns of both are stored in `columns`. The neighbours of a node eliminated alone are coupled with each other;
    with a partner, its neighbours are coupled with those of both.
    """
    eliminated = {node} if partner is None else {node, partner}
    node_neighbours = graph[node] - eliminated
    partner_neighbours = node_neighbours if partner is None else graph[partner] - eliminated
    columns[node] = (node_neighbours | partner_neighbours | eliminated) - {node}
    if partner is not None:
        columns[partner] = node_neighbours | partner_neighbours
    for k in node_neighbours | partner_neighbours:
        graph[k] -= eliminated
        graph[k] |= (node_neighbours | partner_neighbours if k in partner_neighbours else partner_neighbours) - {k}
    return len(partner_neighbours) * (len(partner_neighbours) + 3) // 2 + (
        0 if partner is None else len(partner_neighbours) * len(node_neighbours - partner_neighbours)
    )


def _eliminate_greedily(
    pattern: Pattern,
    n_coordinates: int,
    key: Callable[[Sequence[set[int]], int, int], tuple[int, ...]],
    row_pairs: Mapping[int, int],
    limit: float,
) -> Elimination | None:
    """Return the greedy elimination that takes the node with the least `key` next; None above `limit` products.

    An equation is ready once all its coordinates are eliminated, one in `row_pairs` (of two equations) once two are.
    `key(graph, node, depth)`: graph has the neighbours of each node, depth is the number of divisions that must precede
    the node.
    """
    graph = [set(neighbours) for neighbours in pattern]
    n_missing = [
        sum(neighbours < n_coordinates for neighbours in pattern[equation]) if equation >= n_coordinates else 0
        for equation in range(len(pattern))
    ]
    for equation in row_pairs:
        n_missing[equation] = min(n_missing[equation], 2)
    remaining = set(range(len(pattern)))
    depths = [0] * len(pattern)  # consecutive divisions that must precede each node
    order, columns, products = list[int](), dict[int, set[int]](), 0
    keys = {node: key(graph, node, depths[node]) for node in remaining if n_missing[node] == 0}
    heap = sorted((value, node) for node, value in keys.items())
    while remaining:
        value, node = heapq.heappop(heap)
        if keys.get(node) != value:
            continue  # its key has changed since it was pushed
        if row_pairs.get(node) in remaining:  # its partner comes next, before everything else
            heapq.heappush(heap, (_FIRST_KEY, row_pairs[node]))
            keys[row_pairs[node]] = _FIRST_KEY
        neighbours = graph[node]
        order.append(node)
        columns[node] = neighbours
        products += len(neighbours) * (len(neighbours) + 3) // 2
        if products > limit:
            return None
        remaining.discard(node)
        del keys[node]
        changed_nodes = set(neighbours)
        for neighbour in neighbours:
            graph[neighbour].discard(node)
            adds_division = (
                node >= n_coordinates
                and row_pairs.get(node) not in remaining
                or node < n_coordinates
                and depths[node] > 0
            )
            depths[neighbour] = max(depths[neighbour], depths[node] + adds_division)
            graph[neighbour] |= neighbours
            graph[neighbour].discard(neighbour)
            changed_nodes |= graph[neighbour]
            if neighbour >= n_coordinates and node < n_coordinates and neighbour in pattern[node]:
                n_missing[neighbour] -= 1
        for neighbour in changed_nodes & remaining:
            if keys.get(neighbour) == _FIRST_KEY:
                continue
            if n_missing[neighbour] <= 0:
                keys[neighbour] = key(graph, neighbour, depths[neighbour])
                heapq.heappush(heap, (keys[neighbour], neighbour))
    position = {node: k for k, node in enumerate(order)}
    structure = {node: tuple(sorted(columns[node], key=position.__getitem__)) for node in order}
    return Elimination(tuple(order), structure, products, _compute_division_depth(order, structure, n_coordinates))


def _compute_division_depth(order: Sequence[int], structure: Mapping[int, tuple[int, ...]], n_coordinates: int) -> int:
    """Return the number of divisions on the critical path, of which each needs the result of the one before.

    Pivots that elimination does not change are computed beforehand; two that form a block count as one. `structure`:
    the later nodes in the column of each node.
    """
    changed_nodes = set[int]().union(*structure.values())
    depths = dict.fromkeys(order, 0)
    pair_node = -1
    for position, k in enumerate(order):
        adds_division = k != pair_node and (k >= n_coordinates or k in changed_nodes)
        next_node = order[position + 1] if position + 1 < len(order) else -1
        pair_node = next_node if adds_division and structure[k] == (next_node, *structure.get(next_node, ())) else -1
        depths[k] += adds_division
        for i in structure[k][:1]:
            depths[i] = max(depths[i], depths[k])
    return max(depths.values(), default=0)


@dataclass(frozen=True)
class Block:
    """A square block of a block triangular form: numbers of its equations and of as many unknowns."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def match_rows(pattern: Sequence[set[int]]) -> dict[int, int]:
    """Return a maximum matching of equations with unknowns (augmenting paths): {unknown: equation}.

    `pattern`: the unknowns of each equation.
    """
    row_of_unknown: dict[int, int] = {}

    def assign_unknown(row: int, visited_unknowns: set[int]) -> bool:
        """Return whether equation `row` gets an unknown, after other equations have been moved if necessary.

        This searches an augmenting path of a bipartite matching. `visited_unknowns` collects the unknowns that have
        been tried.
        """
        for column in sorted(pattern[row]):
            if column not in visited_unknowns:
                visited_unknowns.add(column)
                if column not in row_of_unknown or assign_unknown(row_of_unknown[column], visited_unknowns):
                    row_of_unknown[column] = row
                    return True
        return False

    for row in range(len(pattern)):
        assign_unknown(row, set())
    return row_of_unknown


def find_triangular_blocks(pattern: Sequence[set[int]], n: int) -> tuple[Block, ...] | None:
    """Return the diagonal blocks of a square pattern's block triangular form, in solving order.

    None if the pattern is not square or no matching gives every unknown an equation. `pattern`: the unknowns of each
    equation; `n`: the number of unknowns.
    """
    if len(pattern) != n:
        return None
    row_of_unknown = match_rows(pattern)
    if len(row_of_unknown) < n:
        return None
    matched = {row: column for column, row in row_of_unknown.items()}
    dependencies = [
        (row, row_of_unknown[column])
        for row in range(n)
        for column in sorted(pattern[row])
        if row_of_unknown[column] != row
    ]
    components = strongly_connected_components((list(range(n)), dependencies))  # those that others need come first
    return tuple(
        Block(rows := tuple(sorted(component)), tuple(matched[row] for row in rows)) for component in components
    )
