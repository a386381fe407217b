"""The Jacobian in tree coordinates against differences of the reduced right-hand side, and Newton's solve with it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.integrators.single_run import integrate_problem
from gudgeon.integrators.trajectory import Problem
from gudgeon.model.parameters import compute_values_without_baumgarte
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
# a scene, and a time by which it is somewhere: springs stretched, journals off centre, contacts closed
CASES = (
    ("andrews_squeezer", "ideal", 0.01),
    ("car_axis", "ideal", 0.3),
    ("slider_crank_spring", "ideal", 1.0),
    ("n_four_bar", "ideal", 0.4),
    ("nine_bar_press", "lubricated", 0.05),
    ("nine_bar_press", "dry", 0.0068),
    ("slider_crank", "dry", 0.011),
    ("pendulum", "ideal", 0.5),
    ("shaker", "ideal", 0.017),
)


class Tree:
    """Calls of one library in tree coordinates at the state of a run."""

    def __init__(self, simulation: Simulation, t: float) -> None:
        self.simulation, self.compiled, self.t = simulation, simulation.compiled, t
        self.lib, self.pointer = self.compiled.lib, self.compiled.pointer
        run = simulation.simulate(t, output=1, rtol=1e-9)
        zeros = np.zeros(len(simulation.source.parameters))
        self.p = compute_values_without_baumgarte(self.compiled, zeros, zeros.astype(bool))
        self.memory = self.compiled.as_discrete_states(run.memory[-1] if self.compiled.n_discrete_states else None)
        self.n = len(simulation.source.tree_coordinates)
        chained = len(simulation.source.driven_loop_coordinates)
        q, v = np.zeros(self.n + chained), np.zeros(self.n + chained)
        final = [np.ascontiguousarray(x) for x in (run.q[-1], run.v[-1])]
        self.lib.gudgeon_reduce(t, *map(self.pointer, (*final, self.p, q, v)))
        self.y = np.concatenate([q[: self.n], v[: self.n], np.zeros(3)])
        self.chain = q[self.n :]

    def rates(self, t: float, y: np.ndarray) -> np.ndarray:
        """ẏ, (2n + 3,)."""
        q, v = np.concatenate([y[: self.n], self.chain]), y[self.n : 2 * self.n].copy()
        a, power = np.zeros(self.n), np.zeros(3)
        multipliers = np.zeros(len(self.simulation.source.closures) + 1)
        arrays = (q, v, self.memory, self.p, a, multipliers, power)
        assert self.lib.gudgeon_reduced_rhs(t, *map(self.pointer, arrays)) == 0
        return np.concatenate([v, a, power])

    def jacobian(self) -> tuple[np.ndarray, np.ndarray]:
        size = 2 * self.n + 3
        J, f_t = np.zeros((size, size)), np.zeros(size)
        arrays = (np.concatenate([self.y, self.chain]), self.memory, self.p, J, f_t)
        assert self.lib.gudgeon_jacobian(self.t, *map(self.pointer, arrays)) == 0
        return J, f_t

    def solve(self, eta: float, s: float, r: np.ndarray) -> np.ndarray:
        u = np.zeros_like(r)
        y = np.concatenate([self.y, self.chain])
        arrays = map(self.pointer, (y, self.memory, self.p))
        assert self.lib.gudgeon_newton(self.t, *arrays, eta, s, self.pointer(r), self.pointer(u)) == 0
        return u


def slope(f: Any, h: float) -> np.ndarray:
    """f′(0) by four central differences, O(h⁸)."""
    weights = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
    return sum(w * (f(k * h) - f(-k * h)) for k, w in enumerate(weights, 1)) / h


@pytest.mark.parametrize(("name", "scene", "t"), CASES)
def test_every_column_is_the_slope(name: str, scene: str, t: float) -> None:
    tree = Tree(gudgeon.load(name, scene=scene), t)
    J, f_t = tree.jacobian()
    scale = abs(J).max(axis=1) + abs(f_t) + 1e-300
    for k in range(2 * tree.n):
        h = 2e-8 if scene != "ideal" and k < tree.n else 1e-4 * max(1.0, abs(tree.y[k]))
        unit = np.eye(len(tree.y))[k]
        found = slope(lambda x, unit=unit: tree.rates(t, tree.y + x * unit), h)
        assert abs(J[:, k] - found) / scale == pytest.approx(0.0, abs=1e-5 if scene != "ideal" else 1e-7)
    found = slope(lambda x: tree.rates(t + x, tree.y), 1e-6 if scene == "ideal" else 1e-9)
    assert abs(f_t - found) / scale == pytest.approx(0.0, abs=1e-4 if scene != "ideal" else 1e-6)


@pytest.mark.parametrize(("name", "scene", "t"), CASES)
def test_newton_solves_with_it(name: str, scene: str, t: float) -> None:
    tree = Tree(gudgeon.load(name, scene=scene), t)
    J, f_t = tree.jacobian()
    rng = np.random.default_rng(5)
    for eta in (1e-7, 1e-5, 1e-3, 1e-2):
        r = rng.normal(size=len(tree.y)) * (abs(J).max(axis=1) + 1.0)
        found = tree.solve(eta, 0.3, r)
        exact = np.linalg.solve(np.eye(len(tree.y)) / eta - J, r + 0.3 * f_t)
        assert abs(found - exact).max() < 1e-8 * abs(exact).max()


def test_a_run_starts_where_it_is_told() -> None:
    """Absolute to tree coordinates and back, with drives that prescribe what the tree leaves out."""
    press = gudgeon.load("nine_bar_press", scene="lubricated")
    start = press.start()
    problem = Problem(press.compiled, press.p, np.zeros(1), start.q, start.v, np.full(2, np.nan), 1.0, p_motion=press.p)
    run = integrate_problem(problem)
    assert run.q[0] == pytest.approx(start.q, abs=1e-15)
    assert run.v[0] == pytest.approx(start.v, abs=1e-14)
