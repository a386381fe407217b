"""Wear as a loop: a journal that rubs under its weight by Archard's closed form, one that swings, sums that stay."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.simulation.wear_loop import average_depths_over_arcs, smooth_depths
from gudgeon.studies.ensemble.block import run_block
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.simulation.test_wear import PENDULUM, TURNING, C, G, L, M, R

SLOTS, OMEGA, T_END = 64, 4.0, 0.5
KEPT = {"restitution: 1, dissipation: none": "restitution: 0.3"}  # what falls into its own hollow comes to rest


def written(text: str, path: Path) -> gudgeon.Simulation:
    for before, after in (*KEPT.items(), ("contact: dry}", f"contact: dry, contour: {SLOTS}}}")):
        assert before in text
        text = text.replace(before, after)
    path.write_text(text, encoding="utf-8")
    return gudgeon.load(path, "loose")


@needs_compiler
def test_a_pin_sinks_into_its_bearing_as_archard_says(tmp_path: Path) -> None:
    """V = k m g ω R_j t/H in each round, by the momentum whatever the pin does; all of it in the slots below.

    Two runs, the second of twice k by `scale`: the contour's deepest slot goes down by V/2 over a slot's area.
    """
    simulation, k, hardness = written(TURNING, tmp_path / "rig.yaml"), 1e-4, 2e9
    numbers: dict[str, Any] = {"of_ring": 0.0, "of_pin": [OMEGA, OMEGA / 2]}
    requested: dict[str, Any] = {"k": k, "hardness": hardness, "parameters": numbers, "scale": 4000.0}
    found = gudgeon.wear_loop(simulation, "J", T_END, rounds=3, **requested)
    joint, turns = found.joints["J"], np.array([1.0, 0.5])
    volume = 4000.0 * k / hardness * M * G * OMEGA * turns * (R - C) * T_END
    np.testing.assert_allclose(joint.volume, np.tile(volume, (3, 1)), rtol=2e-3)
    np.testing.assert_allclose(joint.volume, found.rate * found.scale * joint.work, rtol=1e-12)
    np.testing.assert_allclose(np.diff(joint.contour_volume, axis=0), joint.volume, rtol=1e-9)
    np.testing.assert_allclose(joint.journal_volume, joint.volume, rtol=1e-12)  # of the same load and slip
    worn = (joint.journal > 0.01 * joint.journal.max(axis=2, keepdims=True)).mean(axis=2) * 2.0 * math.pi
    np.testing.assert_allclose(worn, np.tile(OMEGA * turns * T_END, (3, 1)), atol=0.05)  # it turns on through its load
    below, area = 3 * SLOTS // 4, L * R * 2.0 * math.pi / SLOTS
    assert (joint.contour.argmax(axis=2)[1:] == below).all()
    np.testing.assert_allclose(joint.contour[:, :, below], np.arange(4)[:, None] * volume / area / 2.0, rtol=2e-3)
    assert (np.delete(joint.contour, [below - 1, below, below + 1], axis=2) == 0.0).all()
    own, last = numbers | {"of_pin": OMEGA}, {"J": joint.contour[-1, 0]}
    sunk = simulation.simulate(T_END, output=50, parameters=own, contour=last)
    assert sunk["J.e"][-1] == pytest.approx(C + joint.contour[-1, 0, below] + (M * G / 1e9) ** (2 / 3), rel=1e-6)


@needs_compiler
def test_what_swings_wears_where_it_swings(tmp_path: Path) -> None:
    """Over the arc that the load goes through, 80°, not beyond it but for a slot; each round as much as before."""
    found = gudgeon.wear_loop(
        written(PENDULUM, tmp_path / "rig.yaml"),
        "J",
        0.6,
        rounds=2,
        k="1e-6 mm^3/N/m",
        law="archard",
        scale=2e4,
        points=720,
        rtol=1e-6,
    )
    joint = found.joints["J"]
    worn = joint.contour[-1, 0] > 0.05 * joint.contour[-1, 0].max()
    assert 78.0 <= worn.sum() * 360.0 / SLOTS <= 80.0 + 3.5 * 360.0 / SLOTS
    angle = (np.flatnonzero(worn) * 360.0 / SLOTS + 90.0) % 360.0
    assert np.abs((angle + 180.0) % 360.0 - 180.0).max() < 40.0 + 2.5 * 360.0 / SLOTS
    np.testing.assert_allclose(joint.volume[:, 0], joint.volume[0, 0], rtol=0.05)
    np.testing.assert_allclose(np.diff(joint.contour_volume[:, 0]), joint.volume[:, 0], rtol=1e-9)
    found.save(tmp_path / "worn.nc")
    xarray = pytest.importorskip("xarray")
    with xarray.open_dataset(tmp_path / "worn.nc") as kept:
        assert np.array_equal(kept["contour"].sel(joint="J"), joint.contour) and kept.attrs["law"] == "archard"


def test_cells_are_laid_on_slots_with_their_sum() -> None:
    rng = np.random.default_rng(8)
    for points, slots in ((3600, 64), (3600, 120), (50, 64), (8, 512)):
        depth = rng.uniform(0.0, 1.0, points)
        found = average_depths_over_arcs(depth, slots)
        assert found.mean() == pytest.approx(depth.mean(), rel=1e-12)
        assert smooth_depths(found, 3).mean() == pytest.approx(depth.mean(), rel=1e-12)
    even = np.zeros(3600)
    even[:15], even[-15:] = 1.0, 1.0
    assert average_depths_over_arcs(even, 120).tolist() == pytest.approx([1.0, *[0.0] * 119], abs=1e-9)


@needs_compiler
def test_what_cannot_wear_is_refused(tmp_path: Path) -> None:
    simulation = written(TURNING, tmp_path / "rig.yaml")
    for wrong in ({"k": 0.0}, {"rounds": 0}, {"law": "holm"}, {"scale": -1.0}, {"contact": "line"}, {"passes": -1}):
        with pytest.raises(gudgeon.InputError):
            gudgeon.wear_loop(simulation, "J", 0.01, **({"k": 1e-9, "rounds": 1} | wrong))
    oddities: list[dict[str, Any]] = [
        {"parameters": np.zeros(0)},
        {"progress": 3},
        {"joints": np.array(3)},
        {"joints": []},
    ]
    for odd in oddities:
        with pytest.raises(gudgeon.InputError, match=next(iter(odd))):
            gudgeon.wear_loop(
                simulation, **(dict[str, Any]({"joints": "J", "t_end": 0.01, "k": 1e-9, "rounds": 1}) | odd)
            )
    with pytest.raises(BadValueError, match="expected a Simulation"):
        gudgeon.wear_loop("rig", "J", 0.01, k=1e-9, rounds=1)  # type: ignore[arg-type]
    with pytest.raises(UnknownNameError, match="joint with play"):
        gudgeon.wear_loop(simulation, "O", 0.01, k=1e-9, rounds=1)
    with pytest.raises(BadValueError, match="is given twice"):
        gudgeon.wear_loop(simulation, ["J", "J"], 0.01, k=1e-9, rounds=1)
    with pytest.raises(UnknownNameError, match="no contour"):
        gudgeon.wear_loop(gudgeon.load("slider_crank", "dry"), "wristpin", 0.01, k=1e-9, rounds=1)


@needs_compiler
@pytest.mark.parametrize("method", ["auto", "dop853", "rodas5p", "radau5"])
def test_a_contact_at_rest_wears_with_every_method(method: str, tmp_path: Path) -> None:
    """V = k m g ω R_j t/H; with explicit methods, small speeds remain in directions that should rest."""
    simulation = written(TURNING, tmp_path / "rig.yaml")
    run = simulation.simulate(0.1, output=5, method=method, parameters={"of_ring": 0.0, "of_pin": 2.0})
    worn = gudgeon.wear(simulation, run, "J", k=1e-4, hardness=2e9).bearing.volume
    assert worn == pytest.approx(1e-4 / 2e9 * M * G * 2.0 * (R - C) * 0.1, rel=2e-3)


@needs_compiler
def test_a_study_measures_runs_on_what_was_worn(tmp_path: Path) -> None:
    """Scenes with a contour wear before the run that is measured, as the loop makes them; another one does not."""
    simulation = written(TURNING, tmp_path / "rig.yaml")
    speeds, wear = ["2 rad/s", "4 rad/s"], {"joints": "J", "rounds": 2, "k": 1e-4, "hardness": "2 GPa", "scale": 4000}
    study: dict[str, Any] = {
        "mechanism": str(tmp_path / "rig.yaml"),
        "scenes": ["loose"],
        "t_end": "0.1 s",
        "output": 5,
        "wear": wear,
        "parameters": {"of_ring": 0.0, "of_pin": speeds},
        "measures": {"e": {"final": "J.e"}},
    }
    found = gudgeon.study(study).dataset["e"].sel(scene="loose").values
    numbers: dict[str, Any] = {"of_ring": 0.0, "of_pin": [2.0, 4.0]}
    worn = gudgeon.wear_loop(simulation, "J", 0.1, rounds=2, k=1e-4, hardness=2e9, scale=4000.0, parameters=numbers)
    for k, own in enumerate(worn.joints["J"].contour[-1]):
        one = {"of_ring": 0.0, "of_pin": 2.0 * (k + 1)}
        run = simulation.simulate(0.1, output=5, parameters=one, contour={"J": own})
        assert found[k] == run["J.e"][-1]
    assert found[1] > found[0] > C
    plan, message = resolve_plans(study).by_part[""], list[float]()
    run_block(plan.make_block_job(plan.blocks[0], 1), lambda fraction, _: message.append(fraction), simulation)
    assert message == sorted(message) and {1 / 3, 2 / 3, 1.0} <= {*message}  # a round of wear is told as the runs are
    for name, wrong, words in (("joints", "O", "no scene has"), ("k", "1 mm", "wear.k"), ("rounds", 0, "rounds")):
        with pytest.raises(gudgeon.InputError, match=words):
            gudgeon.study(study | {"wear": wear | {name: wrong}})
