"""Derivation of large linkages: orders and trees that are abandoned early leave the results as they were."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels import program
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.reduction.tree import OperationEstimate, choose_tree
from gudgeon.generator.solvers.sparsity import Pattern, choose_elimination, find_elimination_below
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals

N_COORDINATES, N_ROWS = 14, 6


def make_pattern(rng: np.random.Generator) -> Pattern:
    """Return a random pattern of a KKT matrix: coupled coordinates, and equations in at least two of them."""
    neighbours: list[set[int]] = [set() for _ in range(N_COORDINATES + N_ROWS)]
    edges = [tuple(rng.choice(N_COORDINATES, 2, replace=False).tolist()) for _ in range(12)]
    edges += [
        (N_COORDINATES + r, k) for r in range(N_ROWS) for k in rng.choice(N_COORDINATES, 3, replace=False).tolist()
    ]
    for i, k in edges:
        neighbours[i].add(k)
        neighbours[k].add(i)
    return tuple(map(frozenset, neighbours))


def make_chain_text(n: int) -> str:
    """Return the mechanism file of a chain of n equal links that hangs from the ground."""
    bodies = "\n".join(f"  b{k}: {{length: 0.1 m, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}" for k in range(n))
    ends = ["ground.O", *(f"b{k}.head" for k in range(n - 1))]
    joints = "\n".join(f"  j{k}: {{revolute: [{end}, b{k}.tail]}}" for k, end in enumerate(ends))
    start = ", ".join(f"b{k}.theta: {0.1 * (k % 7):.1f} rad" for k in range(n))
    text = f"format: gudgeon/1\nname: chain\nbodies:\n{bodies}\nground: {{O: [0, 0]}}\njoints:\n{joints}\n"
    return f"{text}freedoms: {n}\nstart:\n  set: {{{start}}}\n"


def make_chain(n: int) -> Model:
    """Return the equations of a chain of n equal links that hangs from the ground."""
    return derive_scene(make_chain_text(n).encode(), "chain.yaml", "ideal")


@pytest.mark.parametrize("seed", range(8))
def test_a_limit_does_not_change_the_cheapest_elimination(seed: int) -> None:
    pattern = make_pattern(np.random.default_rng(seed))
    best = choose_elimination(pattern, N_COORDINATES)
    assert find_elimination_below(best.cost, pattern, N_COORDINATES) == best
    costlier = find_elimination_below(best.cost - 1, pattern, N_COORDINATES)
    assert costlier is None or costlier.cost >= best.cost


@pytest.mark.parametrize("n", [1, 2, 5, 9])
def test_a_dense_pattern_is_abandoned_below_its_products_only(n: int) -> None:
    """The lower bound of the products is exact where all nodes are coupled with each other."""
    pattern = tuple(frozenset(range(n)) - {k} for k in range(n))
    products = choose_elimination(pattern, n).products
    assert products == sum(k * (k + 3) // 2 for k in range(n))
    assert find_elimination_below(products, pattern, n) is not None
    assert find_elimination_below(products - 1, pattern, n) is None


@pytest.mark.parametrize("seed", range(8))
def test_products_and_structure_are_those_of_elimination(seed: int) -> None:
    """The structure is that of an elimination of the pattern in the order found, node by node."""
    pattern = make_pattern(np.random.default_rng(seed))
    found = choose_elimination(pattern, N_COORDINATES)
    graph = [set(neighbours) for neighbours in pattern]
    for node in found.order:
        column = graph[node]
        assert set(found.structure[node]) == column
        for k in column:
            graph[k] = (graph[k] | column) - {k, node}
    assert found.products == sum(len(c) * (len(c) + 3) // 2 for c in found.structure.values())


def test_the_tree_of_a_long_chain_is_the_cheapest_of_all_candidates() -> None:
    """With more than 24 angles costly trees get a lower bound: the tree found, and its cost, are exact."""
    model = make_chain(30)
    tree = choose_tree(model)
    estimate = OperationEstimate(model, tree.angles, frozenset(tree.solved), tree.multiple_joints)
    assert estimate(tree.edges) == min(tree.costs)
    assert len(tree.costs) == 5 and tree.costs[0] > min(tree.costs)


def test_find_variables_lists_every_variable_with_a_derivative() -> None:
    model = make_chain(4)
    for row in model.rows:
        variables = model.symbols.find_differentiation_variables(row.phi)
        for q in model.q:
            assert q in variables or model.symbols.differentiate(row.phi, q) == 0
        assert set(row.phi_q) <= variables


def test_a_large_linkage_has_no_vector_code(monkeypatch: pytest.MonkeyPatch) -> None:
    """Above the limit lanes.c is left out; all other files but model.h, which says so, stay as they are."""
    model = make_chain(2)
    with_lanes = generate_c(model)
    monkeypatch.setattr(program, "MAX_COORDINATES_FOR_LANES", len(model.q) - 1)
    without_lanes = generate_c(model)
    assert (with_lanes.lane_file, without_lanes.lane_file) == ("lanes.c", "")
    assert set(with_lanes.files) - set(without_lanes.files) == {"lanes.c"}
    changed = {name for name, text in without_lanes.files.items() if text != with_lanes.files[name]}
    assert changed == {"model.h", "README.md"}


@pytest.mark.slow
def test_two_thousand_links(tmp_path: Path) -> None:
    """They are assembled at the closed form of the start, and obey Newton's and Euler's equations, body by body."""
    n, file = 2048, tmp_path / "chain.yaml"
    file.write_text(make_chain_text(n) + "gravity: [0, -9.81 m/s^2]\n", encoding="utf-8")
    simulation = gudgeon.load(file)
    run = simulation.simulate(0.02, output=4, rtol=1e-6)
    angle = 0.1 * (np.arange(n) % 7)
    link = 0.1 * np.column_stack([np.cos(angle), np.sin(angle)])
    centres = np.cumsum(link, axis=0) - 0.5 * link
    np.testing.assert_allclose(run.q[0].reshape(n, 3)[:, :2], centres, atol=1e-9)
    assert run.compiled is not None
    assert compute_newton_euler_residuals(run.compiled, run.p, run.q, run.evaluation).max() < 1e-9
    assert abs(run.diagnostics.energy_residual) < 1e-6 * run.diagnostics.energy_turned_over
