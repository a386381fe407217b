"""10,000 parameters in one file: read, derived, run, given anew to each run of a batch, saved and read back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.reader.read import read_scene
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from tests.programs import needs_compiler

COUNT, USED = 10_000, 50


def text(count: int) -> str:
    """Every third parameter is a force; USED of these push the bob, and one number places it."""
    lines = [f"  p{i}: {1 + i / count!r}{'' if i % 3 else ' N'}" for i in range(count)]
    total = " + ".join(f"p{3 * i}" for i in range(USED))
    return "\n".join(
        (
            "format: gudgeon/1",
            "name: many",
            "parameters:",
            *lines,
            "bodies: {bob: {mass: 2 kg, inertia: 1 kg*m^2}}",
            "freedoms: 3",
            "start: {set: {bob.x: p1 * 1 m}}",
            f"forces: {{push: {{force: bob.origin, value: [{total}, 0 N]}}}}",
            f"outputs: {{total: {total}}}",
        )
    )


def force(count: int) -> float:
    return sum(1 + 3 * i / count for i in range(USED))


def test_ten_thousand_are_read() -> None:
    scene = read_scene(text(COUNT).encode(), "many.yaml", "ideal")
    assert len(scene.mechanism.parameters) == COUNT


@needs_compiler
@pytest.mark.parametrize("count", [2_000, pytest.param(COUNT, marks=pytest.mark.slow)])
def test_many_parameters(count: int, tmp_path: Path) -> None:
    (tmp_path / "many.yaml").write_text(text(count), encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "many.yaml")
    run = simulation.simulate(0.1, output=2)
    x = 1 + 1 / count + 0.5 * force(count) / 2 * run.t**2
    np.testing.assert_allclose(run["bob.x"], x, rtol=1e-9)
    run.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc")
    assert dict(again.parameters) == dict(run.parameters) and again["total"].tobytes() == run["total"].tobytes()
    given = [{f"p{i}": float(k) if i % 3 else f"{k} N" for i in range(count)} for k in (1, 2)]
    batch = simulation.simulate_many(given, 0.1, output=2)
    assert batch["total"][:, -1].tolist() == [USED * 1.0, USED * 2.0]
    batch.save(tmp_path / "batch.nc")
    assert Batch.load(tmp_path / "batch.nc")["total"].tobytes() == batch["total"].tobytes()


@pytest.mark.parametrize("odd", [float("nan"), float("inf")])
def test_parameters_of_a_batch_are_those_given(odd: float) -> None:
    """Those that are not finite too, as columns and as mappings."""
    for given in ({"g": [1.0, odd, 2.0]}, [{"g": 1.0}, {"g": odd}, {"g": 2.0}]):
        batch = gudgeon.load("pendulum").simulate_many(given, 0.1, output=3)
        np.testing.assert_array_equal(batch.parameters["parameters.g"], [1.0, odd, 2.0])
        assert [failure.run for failure in batch.failures] == [1]
