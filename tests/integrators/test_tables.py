"""Coefficients of Rodas5P and DOP853 as C has them, against the conditions of their orders: one a rooted tree.

E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993), theorem II.2.13; of Rosenbrock
methods E. Hairer, G. Wanner, II (1996), section IV.7: a vertex with one branch takes α + Γ, one with more takes α.
"""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest

from gudgeon.loading.engine import ENGINE

Tree = tuple["Tree", ...]  # the branches of its root


@cache
def trees(order: int) -> list[Tree]:
    """Rooted trees with so many vertices."""
    found = set()
    for count in range(1, order) if order > 1 else ():
        for first in trees(count):
            for rest in trees(order - count):
                found.add(tuple(sorted((first, *rest))))
    return sorted(found) if order > 1 else [()]


def size(tree: Tree) -> int:
    return 1 + sum(map(size, tree))


def density(tree: Tree) -> int:
    return size(tree) * int(np.prod([density(branch) for branch in tree], initial=1))


def weight(tree: Tree, a: np.ndarray, single: np.ndarray) -> np.ndarray:
    """Φ of each stage: products over the branches of sums over the stages."""
    matrix = single if len(tree) == 1 else a
    return np.prod([matrix @ weight(branch, a, single) for branch in tree], axis=0) * np.ones(len(a))


def unmet(order: int, a: np.ndarray, single: np.ndarray, b: np.ndarray) -> float:
    """By how much the conditions up to an order fail, at most."""
    every = [tree for k in range(1, order + 1) for tree in trees(k)]
    return max(abs(float(b @ weight(tree, a, single)) - 1.0 / density(tree)) for tree in every)


def test_there_are_as_many_trees_as_there_should_be() -> None:
    assert [len(trees(k)) for k in range(1, 9)] == [1, 1, 2, 4, 9, 20, 48, 115]


def read(file: str) -> str:
    return (ENGINE / "scalar_simd" / file).read_text(encoding="utf-8")


def row(text: str, stages: int) -> np.ndarray:
    """Coefficients of k[0], k[1] ... in a sum."""
    out = np.zeros(stages)
    for sign, number, stage in re.findall(r"([-+]?)\s*(\d+\.\d+(?:e-?\d+)?) \* k\[(\d+)\]", text):
        out[int(stage)] = float(f"{sign}{number}")
    return out


def test_rodas5p_is_of_order_5() -> None:
    """(I/(hγ) − J) u_i = f(y0 + Σ a_ij u_j) + Σ c_ij u_j/h; with Γ = (I/γ − C)⁻¹ α = A Γ, b = m Γ; embedded 4."""
    text, stages = read("rodas5p.h"), 8
    gamma = float(re.search(r"RODAS5P_GAMMA ([\d.]+)", text)[1])  # type: ignore[index]
    node, time = (np.array(eval(f"[{found}]")) for found in re.findall(r"double \w+\[\] = \{(.*?)\}", text, re.DOTALL))  # noqa: S307
    parts = re.split(r"\nstatic void \w+\(|\nstatic int ", text)[1:3]
    A, C = np.zeros((stages, stages)), np.zeros((stages, stages))
    for matrix, part in zip((A, C), parts, strict=True):
        for case, body in re.findall(r"case (\d):(.*?)break;", part, re.DOTALL):
            matrix[int(case)] = row(body, stages)
    Gamma = np.linalg.inv(np.eye(stages) / gamma - C)
    alpha, last = A @ Gamma, np.eye(stages)[-1]
    assert alpha.sum(axis=1) == pytest.approx(node, abs=1e-13)
    assert Gamma.sum(axis=1) == pytest.approx(time, abs=1e-13)
    assert unmet(5, alpha, alpha + Gamma, (A[-1] + last) @ Gamma) < 1e-13
    assert unmet(4, alpha, alpha + Gamma, A[-1] @ Gamma) < 1e-13  # what the last stage is the error of


def test_dop853_is_of_order_8() -> None:
    """And its error estimates are b less formulas of orders 5 and 3; the interpolant's stages lie where they should."""
    text, stages = read("dop853.h"), 12
    node = np.array(eval(f"[{re.search(r'_node.. = {(.*?)}', text, re.DOTALL)[1]}]"))  # type: ignore[index]  # noqa: S307
    rows = {int(case): row(body, 16) for case, body in re.findall(r"case (\d+):(.*?)break;", text, re.DOTALL)}
    assert sorted(rows) == list(range(1, 16))
    for s, own in rows.items():
        assert own.sum() == pytest.approx(node[s], abs=1e-14)
    a, b = np.array([np.zeros(16), *(rows[s] for s in range(1, stages))])[:, :stages], rows[stages][:stages]
    assert unmet(8, a, a, b) < 1e-14
    for order in (5, 3):
        found = re.search(rf"sum_{order} = (.*?);", text, re.DOTALL)
        assert found and unmet(order, a, a, b - row(found[1], stages)) < 1e-14
