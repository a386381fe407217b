"""The log of a reduction against independent counts: ranks and null spaces of Φ_q, graphs, numeric patterns."""

from __future__ import annotations

import numpy as np
import pytest

from gudgeon.assembly.rank import compute_rank
from gudgeon.contract import reduction_log as message
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.reduction_description import describe_reduced_system
from gudgeon.contract.reduction_log import ReductionLog
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.reduction.tree import OperationEstimate, choose_tree
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.simulation.simulation import Simulation
from tests.oracles import numpy_linkage
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_mechanism import random_mechanism
from tests.reduction.reduced import Reduced
from tests.reduction.test_reduction import but, not_optimised, pytestmark, shipped

__all__ = ["not_optimised", "pytestmark"]  # they hold for this file too
SCENES = but(("nine_bar_press", "lubricated"))
PLACED_BY_PAIRS = [
    "nine_bar_press", "four_bar", "slider_crank",
    *(pytest.param(name, marks=pytest.mark.slow) for name in ("andrews_squeezer", "n_four_bar")),
]  # fmt: skip  # no loose body


SEEDS = [seed if seed in (0, 3, 4, 5) else pytest.param(seed, marks=pytest.mark.slow) for seed in range(16)]


def absolute_name(source: KernelSource, name: str) -> str:
    """Angles of the tree are named by their bodies."""
    return f"{name}.theta" if f"{name}.theta" in source.coordinates else name


def replay(source: KernelSource) -> tuple[set[str], set[str]]:
    """Coordinates and rows after the last step; each step takes only what is there and brings only what is not."""
    story = source.reduction_log
    coordinates, rows = set(story.coordinates), set(story.rows)
    for step, n, m in story.iterate_steps():
        assert set(step.gone) <= coordinates and set(step.rows_gone) <= rows
        coordinates, rows = coordinates - set(step.gone), rows - set(step.rows_gone)
        assert not set(step.come) & coordinates and not set(step.rows_come) & rows
        coordinates, rows = coordinates | set(step.come), rows | set(step.rows_come)
        assert (n, m) == (len(coordinates), len(rows))
        takes = len(step.gone) - len(step.come) == len(step.rows_gone) - len(step.rows_come)
        assert takes != (step.kind in (message.PLAY, message.REDUNDANT))
    return coordinates, rows


def check_ledger(source: KernelSource) -> None:
    coordinates, rows = replay(source)
    assert coordinates == {absolute_name(source, name) for name in source.tree_coordinates}
    assert rows == set(source.closures)


def specified(story: ReductionLog, kind: str) -> list[str]:
    return [name for step in story.steps if step.kind == kind for name in step.gone]


def check_known_angles(source: KernelSource, phi_q: np.ndarray) -> None:
    """No motion that the rows allow turns an angle that is prescribed or constant."""
    _, sizes, vt = np.linalg.svd(phi_q)
    independent = int((sizes > 1e-9 * sizes[0]).sum())
    names = specified(source.reduction_log, message.PRESCRIBED) + specified(source.reduction_log, message.CONSTANT)
    known = [source.coordinates.index(name) for name in names]
    assert abs(vt[independent:, known]).max(initial=0.0) < 1e-9


def near(simulation: Simulation, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A state off the start's symmetry: q need not close the loops where only a pattern is asked for."""
    start, rng = simulation.start(), np.random.default_rng(seed)
    return start.q, start.q + 0.1 * rng.standard_normal(len(start.q))


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_freedom_of_shipped_scenes(name: str, scene: str) -> None:
    _, simulation = shipped(name, scene)
    source = simulation.source
    check_ledger(source)
    closed, _ = near(simulation, 0)
    phi_q = simulation.compiled.phi_q(0.0, closed, simulation.p)
    assert len(source.tree_coordinates) - len(source.closures) == len(closed) - (
        compute_rank(phi_q) if len(phi_q) else 0
    )
    if len(phi_q):
        check_known_angles(source, phi_q)


@pytest.mark.parametrize("seed", SEEDS)
def test_freedom_of_random_mechanisms(seed: int) -> None:
    """Every joint and drive; Φ_q is that of the NumPy linkage."""
    case = random_mechanism(seed)
    source = generate_c(derive_scene(to_yaml(case).encode(), f"random_{seed}.yaml", "ideal"))
    check_ledger(source)
    phi_q = numpy_linkage.rows(case.linkage, 0.0, case.q, case.v).phi_q
    assert len(source.tree_coordinates) - len(source.closures) == len(case.q) - compute_rank(phi_q)
    check_known_angles(source, phi_q)


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_non_zeros(name: str, scene: str) -> None:
    """Of Φ_q and of the absolute matrix [M Φ_qᵀ; Φ_q 0], whose M is diagonal, at states in general position."""
    _, simulation = shipped(name, scene)
    source = simulation.source
    found = sum(abs(simulation.compiled.phi_q(0.3, near(simulation, seed)[1], simulation.p)) for seed in range(3))
    pattern = np.asarray(found) != 0.0
    assert source.reduction_log.jacobian == pattern.sum()
    solve = source.reduction_log.before
    assert solve is not None and solve.coordinates == len(source.coordinates)
    if not source.frictions:  # each is a row more
        assert solve.rows == len(source.equations)
        assert solve.entries == len(source.coordinates) + 2 * pattern.sum()
        check_factor(solve)


def check_factor(solve: message.Solve) -> None:
    """L holds at least the matrix's lower half, at most a full one."""
    half = (solve.entries - solve.coordinates) // 2
    assert half <= solve.factor <= solve.size * (solve.size - 1) // 2


def check_products(solve: message.Solve) -> None:
    """Each column of c entries takes c (c + 3)/2 products, where no row goes together with a coordinate."""
    even = solve.factor / solve.size  # the sum of squares is least where all columns are alike
    assert solve.products >= solve.size * even * (even + 3.0) / 2.0 - 1e-9


@pytest.mark.parametrize(("name", "scene"), [case for case in SCENES if case != ("belt_block", "ideal")])
def test_non_zeros_in_tree_coordinates(name: str, scene: str) -> None:
    """M_s = Jᵀ M J and Φ_s with J from differences of all positions: no entry is missed, and none counted in vain."""
    _, simulation = shipped(name, scene)
    source, library = simulation.source, simulation.compiled
    solve = source.reduction_log.after
    if solve is None:
        assert source.reduction_log.groups
        return
    reduced = Reduced(library, simulation.p)
    M = library.mass(simulation.p)
    mass, rows = np.zeros((reduced.n, reduced.n)), np.zeros((reduced.rows, reduced.n))
    for seed in range(3):
        J, Phi_s = slopes(reduced, near(simulation, seed)[1])
        mass, rows = mass + abs(J.T * M @ J), rows + abs(Phi_s)
    scale = np.sqrt(np.outer(mass.diagonal(), mass.diagonal()))
    assert solve.entries == (mass > 1e-7 * scale).sum() + 2 * (rows > 1e-7).sum()
    assert (solve.coordinates, solve.rows) == (reduced.n, reduced.rows)
    check_factor(solve)
    check_products(solve)


def slopes(reduced: Reduced, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """∂(all positions)/∂s and Φ_s by central differences."""
    s, rate = reduced.reduce(0.3, q, np.zeros_like(q))
    h, columns, rows = 1e-5, [], []
    for k in range(reduced.n):
        up, down = (s + sign * h * np.eye(len(s))[k] for sign in (1.0, -1.0))
        columns.append((reduced.expand(0.3, up, rate)[0] - reduced.expand(0.3, down, rate)[0]) / (2.0 * h))
        rows.append((reduced.closures(0.3, up, rate)[0] - reduced.closures(0.3, down, rate)[0]) / (2.0 * h))
    return np.array(columns).T, np.array(rows).T.reshape(reduced.rows, reduced.n)


@pytest.mark.parametrize("name", PLACED_BY_PAIRS)
def test_as_many_loops_as_the_graph_has(name: str) -> None:
    """Joints less moving bodies, the ground being one part with all of them: each such joint is a loop's."""
    model, simulation = shipped(name, "ideal")
    joints, bodies = model.scene.mechanism.joints.values(), list(model.geometry.bodies)
    incidence = np.zeros((len(joints), len(bodies)))
    for row, joint in zip(incidence, joints, strict=True):
        for end, sign in ((joint.first.body, 1.0), (joint.second.body, -1.0)):
            if end in bodies:
                row[bodies.index(end)] += sign
    loops = len(joints) - np.linalg.matrix_rank(incidence)
    assert loops == len(joints) - len(bodies)
    story = simulation.source.reduction_log
    assert all(placed.joint for placed in story.tree)
    assert len({name.rpartition(".")[0] for name in simulation.source.closures}) == loops


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_tree_places_every_body_once_behind_its_parent(name: str, scene: str) -> None:
    _, simulation = shipped(name, scene)
    placed = {"ground"}
    for body in simulation.source.reduction_log.tree:
        assert body.parent in placed and body.body not in placed
        placed.add(body.body)
    assert placed == {"ground"} | {body.name for body in simulation.source.bodies}


def test_the_tree_taken_is_the_cheapest() -> None:
    """The estimate, made anew of the tree that was taken, is the least of the story's."""
    model, simulation = shipped("nine_bar_press", "ideal")
    tree = choose_tree(model)
    estimate = OperationEstimate(model, tree.angles, frozenset(tree.solved), tree.multiple_joints)
    costs = simulation.source.reduction_log.costs
    assert estimate(tree.edges) == min(costs) < costs[0]


@pytest.mark.parametrize("name", ["nine_bar_press", "slider_crank"])
def test_groups_are_solved_one_after_the_other(name: str) -> None:
    """Φ_s in the order of the groups is block triangular with regular blocks."""
    _, simulation = shipped(name, "ideal")
    source, groups = simulation.source, simulation.source.reduction_log.groups
    assert source.reduction_log.after is None
    assert sorted(row for group in groups for row in group.rows) == sorted(source.closures)
    assert sorted(x for group in groups for x in group.coordinates) == sorted(source.tree_coordinates)
    _, Phi_s = slopes(Reduced(simulation.compiled, simulation.p), near(simulation, 1)[1])
    solved: list[int] = []
    for group in groups:
        rows = [source.closures.index(row) for row in group.rows]
        columns = [source.tree_coordinates.index(name) for name in group.coordinates]
        solved += columns
        assert abs(np.linalg.det(Phi_s[np.ix_(rows, columns)])) > 1e-6
        later = [k for k in range(len(source.tree_coordinates)) if k not in solved]
        assert abs(Phi_s[np.ix_(rows, later)]).max(initial=0.0) < 1e-9


def test_full_formulation_opens_what_has_play_and_takes_nothing_else() -> None:
    model = derive_scene(find_shipped_file("slider_crank").read_bytes(), "slider_crank.yaml", "dry")
    source = generate_c(model, "full")
    assert [step.kind for step in source.reduction_log.steps] == [message.PLAY]
    coordinates, rows = replay(source)
    assert coordinates == set(source.coordinates) and rows == {row.name for row in source.equations}
    assert source.reduction_log.after == source.reduction_log.before and not source.reduction_log.tree


def test_redundant_rows_are_told() -> None:
    """A second drive of the same angle says nothing new."""
    text = (
        "format: gudgeon/1\nname: twice\nbodies: {a: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}\n"
        "ground: {O: [0, 0], P: [0, 0]}\n"
        "joints: {one: {revolute: [ground.O, a.tail]}, two: {revolute: [ground.P, a.tail]}}\n"
    )
    source = generate_c(derive_scene(text.encode(), "twice.yaml", "ideal"))
    check_ledger(source)
    (step,) = (step for step in source.reduction_log.steps if step.kind == message.REDUNDANT)
    assert step.rows_gone == ("two.x", "two.y") and step.owners == ("two",)
    assert len(source.tree_coordinates) - len(source.closures) == 1


def test_contradictory_drives_are_followed_in_absolute_coordinates() -> None:
    """They do not assemble, so nothing is redundant: no freedom is counted, and yet no row says b's angle."""
    text = (
        "format: gudgeon/1\nname: contrary\nbodies:\n"
        "  a: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}\n  b: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}\n"
        "ground: {O: [0, 0], P: [1 m, 0]}\n"
        "joints: {one: {revolute: [ground.O, a.tail]}, two: {revolute: [ground.P, b.head]}}\n"
        "drives: {m: {angle: a, value: 60 deg}, n: {coordinate: a.x, value: 0.1 m}}\n"
    )
    source = generate_c(derive_scene(text.encode(), "contrary.yaml", "ideal"))
    story = source.reduction_log
    assert not story.groups and story.after is not None and story.after.coordinates == len(source.coordinates)
    lines = dict(describe_reduced_system(source))
    assert lines["operations"].endswith(f"in absolute coordinates, {source.operations['project']}")


def test_story_survives_json() -> None:
    _, simulation = shipped("nine_bar_press", "ideal")
    assert simulation.source.reduction_log.groups and simulation.source.reduction_log.before
    assert KernelSource.from_json(simulation.source.to_json()).reduction_log == simulation.source.reduction_log
