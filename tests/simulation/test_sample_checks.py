"""Test that the samples of long runs, which are checked in blocks, give what they give as a whole."""

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.simulation import sample_checks

SCENES = [("nine_bar_press", "dry"), ("belt_block", "ideal"), ("bouncing_ball", None), ("pendulum", "ideal")]


def check_equal_in_blocks(
    simulation: gudgeon.Simulation, monkeypatch: pytest.MonkeyPatch, **arguments: object
) -> gudgeon.Result:
    """Simulate with one block and with blocks of seven samples, compare the diagnostics, and return the first run."""
    whole = simulation.simulate(audit="full", **arguments)  # type: ignore[arg-type]
    with monkeypatch.context() as patch:
        patch.setattr(sample_checks, "MAX_STORED", 7)
        parts = simulation.simulate(audit="full", **arguments)  # type: ignore[arg-type]
    for name in ("audit", "notes", "energy_residual", "energy_turned_over"):
        assert repr(getattr(parts.diagnostics, name)) == repr(getattr(whole.diagnostics, name))
    assert "evaluation" in vars(whole)
    assert "evaluation" not in vars(parts)
    np.testing.assert_array_equal(parts.a, whole.a)
    return whole


@pytest.mark.parametrize(("mechanism", "scene"), SCENES)
def test_blocks_of_samples(mechanism: str, scene: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    run = check_equal_in_blocks(gudgeon.load(mechanism, scene), monkeypatch, t_end=0.3, output=60)
    assert len(run.diagnostics.audit) > 5


def test_blocks_without_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    check_equal_in_blocks(gudgeon.load("nine_bar_press", "dry"), monkeypatch, output=np.linspace(0.01, 0.1, 30))


def test_outputs_that_are_no_numbers_in_blocks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first sample that is no number lies in a later block; all of them are counted."""
    file = tmp_path / "pendulum.yaml"
    text = find_shipped_file("pendulum").read_text(encoding="utf-8")
    more = "outputs:\n  root: sqrt(0.2 - t/(1 s))\n  residual: log(1 + energy.residual/(1 J))\n"
    file.write_text(text.replace("outputs:\n", more), encoding="utf-8")
    run = check_equal_in_blocks(gudgeon.load(file, "ideal"), monkeypatch, t_end=0.3, output=30)
    (note,) = [note for note in run.diagnostics.notes if "not finite" in note]
    assert note.startswith("output root is not finite (nan) at t = 0.21 s")
    assert note.endswith("it is not finite at 10 of 31 samples")
