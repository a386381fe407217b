"""What a scene says of its runs (`simulate:`) follows the run's own numbers: t_end, output and step as expressions."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.model.default_step import evaluate_file_end_time, evaluate_scene_end_time, evaluate_scene_step
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.bench import measure_scene
from gudgeon.studies.runs import Setting, find_comparison_window
from tests.programs import needs_compiler
from tests.pump import TEXT as PUMP

pytestmark = needs_compiler
OWN = "simulate: {t_end: 2*pi/omega/turns, step: 1e-4/omega, output: 4*turns}"
TEXT = PUMP.replace("parameters: {", "parameters: {turns: 10, ")
TEXT = TEXT.replace("simulate: {t_end: 0.02 s, step: 2e-6 s, output: 100}", OWN)
TEXT += "  plain: {simulate: {t_end: 2*pi/omega/turns}}\n"
LINE = next(k for k, line in enumerate(TEXT.splitlines(), 1) if OWN in line)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scene") / "pump.yaml"
    path.write_text(TEXT)
    return path


@pytest.fixture(scope="module")
def worn(file: Path) -> Simulation:
    return gudgeon.load(file, "worn")


@pytest.fixture(scope="module")
def plain(file: Path) -> Simulation:
    return gudgeon.load(file, "plain")


def end(omega: float, turns: float = 10.0) -> float:
    return 2.0 * math.pi / omega / turns


def test_a_run_ends_by_its_own_numbers(worn: Simulation) -> None:
    for omega, turns in ((20.0, 10.0), (30.0, 12.0)):
        run = worn.simulate(method="rk4", parameters={"omega": omega, "turns": turns})
        assert len(run.t) == 4 * turns + 1 and run.t[-1] == pytest.approx(end(omega, turns), rel=1e-15)
        assert run.diagnostics.step == pytest.approx(1e-4 / omega, rel=1e-15)
    again = worn.simulate(method="rk4", output=run.t, step=1e-4 / 30.0, parameters={"omega": 30.0, "turns": 12.0})
    assert again.q.tobytes() == run.q.tobytes()
    assert worn.simulate(0.01, output=2).t.tolist() == [0.0, 0.005, 0.01]  # what a call says goes first


@pytest.mark.parametrize("scene", ["worn", "plain"])
def test_so_does_each_run_of_a_batch(scene: str, worn: Simulation, plain: Simulation) -> None:
    """The one goes from start to end in C, the other one without a freedom in Python."""
    simulation = worn if scene == "worn" else plain
    columns = {"omega": [20.0, 30.0, 40.0], "turns": [10.0, 12.0, 10.0]}
    batch = simulation.simulate_many(columns)
    assert batch.t.shape == (3, 49 if scene == "worn" else 1001) and not batch.failures
    for i in range(3):
        run = simulation.simulate(parameters={name: values[i] for name, values in columns.items()})
        assert batch.q[i, : len(run.t)].tobytes() == run.q.tobytes()
        np.testing.assert_array_equal(batch.times[i, : len(run.t)], run.t)
    assert worn.simulate_many({"omega": [20.0, 20.0]}).t.shape == (41,)


def test_a_value_that_does_not_fit_is_told_where_it_was_written(worn: Simulation) -> None:
    for parameters, words in (
        ({"turns": -1.0}, f"t_end .line {LINE}, column .* is -0.3.* with this run's numbers: expected a positive time"),
        ({"turns": 10.1}, f"output .line {LINE}, column .* is 40.4 .*expected a whole number"),
        ({"turns": 0.0}, f"t_end .line {LINE}.* is inf"),
    ):
        with pytest.raises(BadValueError, match=rf"scenes\.worn\.simulate\.{words}"):
            worn.simulate(parameters=parameters)
    batch = worn.simulate_many({"turns": [10.0, 0.0, 10.1]})
    assert [failure.run for failure in batch.failures] == [1, 2] and batch.samples[0] == 41
    with pytest.raises(GudgeonError, match=f"line {LINE}"):
        batch[2]


def test_studies_take_the_numbers_that_they_are_given(worn: Simulation, plain: Simulation) -> None:
    assert evaluate_file_end_time(worn.compiled, {"omega": 40.0}) == pytest.approx(end(40.0), rel=1e-15)
    assert evaluate_scene_end_time(worn.source, worn.p) == pytest.approx(end(20.0), rel=1e-15)
    assert evaluate_scene_step(worn.compiled, worn.p, 1.0) == pytest.approx(5e-6, rel=1e-15)
    assert find_comparison_window(worn, 1.0, Setting("dop853", 1e-8), {"omega": 200.0}).t_end <= end(200.0)
    assert measure_scene(plain, parameters={"omega": 40.0}, quick=True).t_end == pytest.approx(end(40.0), rel=1e-15)


def test_a_source_is_stored_with_it(worn: Simulation, tmp_path: Path) -> None:
    assert KernelSource.from_json(worn.source.to_json()) == worn.source
    assert [one.address for one in worn.source.simulate_expressions] == [
        f"scenes.worn.simulate.{name}" for name in ("t_end", "output", "step")
    ]
    pytest.importorskip("h5py")
    worn.simulate().save(tmp_path / "run.nc")
    assert gudgeon.Result.load(tmp_path / "run.nc").source == worn.source


def test_the_command_line_follows_what_is_set(file: Path, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    words = ["run", str(file), "--set", "omega=40", "--scene", "plain", "--scene", "ideal", "--out", str(tmp_path)]
    found = CliRunner().invoke(app, [*words, "--json"])
    assert found.exit_code == 0, found.output
    assert set(json.loads(found.stdout)["scenes"]) == {"plain", "ideal"}
    for scene in ("plain", "ideal"):  # that which says nothing lasts as long as the longest
        run = gudgeon.Result.load(tmp_path / f"pump_{scene}.nc")
        assert run.t[-1] == pytest.approx(end(40.0), rel=1e-15)
    found = CliRunner().invoke(app, [*words, "--set", "turns=0"])
    assert found.exit_code == 2 and f"line {LINE + 1}" in found.output
