"""Too little memory: told in a sentence, and what was computed before is kept."""

from __future__ import annotations

import gc
import tracemalloc
import weakref
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.files.writing import read_regular_file
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.pump import Gudgeon


def none_left(*_: Any, **__: Any) -> Any:
    raise MemoryError("Unable to allocate 9 GiB")


@needs_compiler
def test_a_scene_without_memory_loses_no_other(
    call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate = Simulation.simulate

    def short(self: Simulation, *args: Any, **options: Any) -> Any:
        return none_left() if self.source.scene == "ideal" else simulate(self, *args, **options)

    monkeypatch.setattr(Simulation, "simulate", short)
    done = call("run", pump)
    assert done.exit_code == 1
    assert "error: scene ideal: not enough memory: Unable to allocate 9 GiB\n  request fewer samples" in done.stderr
    assert gudgeon.Result.load(tmp_path / "out/pump_worn.nc").t[-1] == 0.02


@needs_compiler
def test_a_command_without_memory_says_so(call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gudgeon.commands.check.check_mechanism", none_left)
    done = call("check", pump)
    assert done.exit_code == 1 and done.stderr.startswith("error: not enough memory: Unable")


@needs_compiler
def test_a_run_is_kept_where_its_energy_cannot_be_balanced(monkeypatch: pytest.MonkeyPatch) -> None:
    pendulum = gudgeon.load("pendulum")
    with monkeypatch.context() as short:
        short.setattr(CompiledModel, "evaluate", none_left)
        run = pendulum.simulate(0.1, output=3)
    assert (run.q == pendulum.simulate(0.1, output=3).q).all() and run["swing"][-1] > 0.0


def test_a_small_file_takes_little_memory(tmp_path: Path) -> None:
    (tmp_path / "x").write_bytes(b"12345")
    tracemalloc.start()
    try:
        assert read_regular_file(tmp_path / "x") == b"12345"
        assert tracemalloc.get_traced_memory()[1] < 1 << 20
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(("mechanism", "scene"), [("nine_bar_press", "dry"), ("slider_crank", "ideal")])
def test_the_memory_of_a_run_is_freed_with_its_result(mechanism: str, scene: str) -> None:
    """Nothing of a run is part of a cycle of references, which Python frees much later."""
    simulation = gudgeon.load(mechanism, scene)
    simulation.simulate(0.001, output=10)
    gc.collect()
    gc.disable()
    try:
        run = simulation.simulate(0.001, output=10)
        samples = weakref.ref(run.q if run.q.base is None else run.q.base)
        assert samples() is not None
        del run
        assert samples() is None
    finally:
        gc.enable()


@pytest.mark.parametrize(("mechanism", "scene"), [("slider_crank", "ideal"), ("slider_crank", "dry")])
def test_a_long_run_takes_the_memory_of_its_samples(mechanism: str, scene: str) -> None:
    """No second array as large as the samples exists at any time of the run, its audit and its notes.

    Samples are evaluated in blocks, which have up to 25 MB.
    """
    simulation = gudgeon.load(mechanism, scene)
    simulation.simulate(0.001, output=2)
    tracemalloc.start()
    try:
        run = simulation.simulate(0.01, output=400_000)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    arrays = [run.t, run.q, run.v, run.work, run.memory, run.state]
    if run.accelerations is not None and simulation.source.degrees_of_freedom == 0:
        arrays.append(run.accelerations)  # stored with the samples
    assert peak < sum(array.nbytes for array in arrays) + 40e6
