"""A start that another run of a batch had is taken from that: only where nothing differs that closing reads."""

from __future__ import annotations

from pathlib import Path

import pytest

import gudgeon
from gudgeon.errors import GudgeonError
from gudgeon.integrators import lanes
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.integrators.test_side_by_side import EVERY_KIND, without_chain
from tests.programs import needs_compiler

pytestmark = needs_compiler
T_END = 1e-6
SCENES = [("nine_bar_press", "dry"), ("slider_crank", "dry"), ("pendulum", "ideal"), (EVERY_KIND, "ideal")]


def alone(simulation: Simulation, number: dict[str, float]) -> Result | None:
    try:
        return simulation.simulate(T_END, output=2, parameters=number)
    except GudgeonError:
        return None  # the scene does not allow that


@pytest.mark.parametrize(("mechanism", "scene"), SCENES)
def test_every_number_that_a_start_hangs_on_is_heeded(
    mechanism: str | Path, scene: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Each number another one, between runs without: starts are, to the bit, those of single runs."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    simulation = gudgeon.load(without_chain(tmp_path) if mechanism == EVERY_KIND else mechanism, scene)
    source = simulation.source
    numbers: list[dict[str, float]] = []
    for slot in source.parameters:
        value = 1.001 * slot.default if slot.default else 1e-3
        if not slot.words and alone(simulation, {slot.address: value}):
            numbers += [{slot.address: value}, {}]
    assert len(numbers) > lanes.MIN_RUNS
    singly = [alone(simulation, number) for number in numbers]
    starts = {run.q[0].tobytes() + run.v[0].tobytes() for run in singly if run}
    assert 1 < len(starts) < len(numbers) / 2
    for beside in (False, True):
        batch = simulation.simulate_many(numbers, T_END, output=2, threads=1, side_by_side=beside)
        for i, run in enumerate(singly):
            assert run and batch.q[i].tobytes() == run.q.tobytes(), numbers[i]
            assert batch.v[i].tobytes() == run.v.tobytes(), numbers[i]
