"""Models for the tests of the derivation: the shipped press, random linkages; numbers for their symbols."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib import resources

import numpy as np
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_linkage import Case, random_case

Function = Callable[[complex, np.ndarray, np.ndarray], np.ndarray]


@cache
def press(scene: str) -> Model:
    """The shipped press."""
    data = resources.files("gudgeon.mechanisms").joinpath("nine_bar_press.yaml").read_bytes()
    return derive_scene(data, "nine_bar_press.yaml", scene)


@cache
def random_model(seed: int) -> tuple[Case, Model]:
    """A random linkage as the oracle has it and as the product derives it from its file."""
    case = random_case(seed, bodies=2 + seed % 4, loops=seed % 3, drives=seed % 3)
    return case, derive_scene(to_yaml(case).encode(), f"random_{seed}.yaml", "ideal")


def defaults(model: Model) -> dict[sp.Symbol, sp.Expr]:
    """Every slot's default, as the exact value of its binary64 number."""
    return {
        entry.symbol: sp.Rational(*entry.default.as_integer_ratio()) for entry in model.parameter_table.entries.values()
    }


def numeric(model: Model, matrix: sp.Matrix) -> Function:
    """A matrix of the model as a function of (t, q, v), real or complex."""
    numbers = {symbol: sp.Float(value, 17) for symbol, value in defaults(model).items()}
    entries = [entry.xreplace(numbers) for entry in matrix]
    function = sp.lambdify([model.t, model.q, model.v], entries, "numpy", cse=True)

    def call(t: complex, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return np.array(function(t, tuple(q), tuple(v))).reshape(matrix.shape)

    return call


def random_state(model: Model, seed: int) -> tuple[float, np.ndarray, np.ndarray]:
    """t, q, v of ordinary size; q need not satisfy the constraints."""
    rng = np.random.default_rng(seed)
    n = len(model.q)
    return float(rng.uniform(0.0, 1.0)), rng.uniform(-1.0, 1.0, n), rng.uniform(-3.0, 3.0, n)
