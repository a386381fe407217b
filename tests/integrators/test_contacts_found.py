"""No contact is missed and none is invented: runs against a check by positions alone, and against an oracle."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from tests.random_contacts import CAM, HEAD, SLIDER_CRANK, Campaign, checked, text_of

# missed_contact: a journal that leaves the wall flies out again within the next step (case of an accepted step of 7 ms
# whose first half was never searched). The right values are those of Newton and Euler's equations with SciPy's DOP853.
NUMBERS = ", r: 50 mm, L: 150 mm, m1: 0.3 kg, J1: 1e-4 kg*m^2, m2: 0.2 kg, J2: 4e-4 kg*m^2, m3: 0.3 kg, J3: 1e-4 kg*m^2"
PLAY = "crankpin: {bearing: pin, contact: dry}"


def scene_of(folder: Path, body: str, numbers: str = NUMBERS, weight: bool = False) -> gudgeon.Simulation:
    """A machine of the campaign with these numbers, with its weight or without."""
    text = HEAD.format(name="machine", numbers=numbers, law="flores", play=PLAY)
    text = text if weight else text.replace("gravity: [0, -9.81]\n", "")
    path = folder / "machine.yaml"
    path.write_text(text + body)
    return gudgeon.load(path, "dry")


@pytest.fixture(scope="module")
def slider_crank(tmp_path_factory: pytest.TempPathFactory) -> gudgeon.Simulation:
    return scene_of(tmp_path_factory.mktemp("contacts"), SLIDER_CRANK)


@pytest.mark.parametrize(
    "how",
    [
        {"rtol": 1e-8},
        {"rtol": 1e-9},
        {"rtol": 1e-10},
        {"rtol": 1e-8, "method": "dop853"},
        {"rtol": 1e-8, "method": "rodas5p"},
        {"rtol": 1e-8, "method": "radau5"},
        {"step": 1e-6, "method": "rk4"},
    ],
)
def test_a_short_flight_within_a_step_is_found(slider_crank: gudgeon.Simulation, how: dict[str, object]) -> None:
    run = slider_crank.simulate(0.05, output=100, peaks=["crankpin.F"], **how)  # type: ignore[arg-type]
    assert len(run.impacts) == 9
    assert run["slider.x"][-1] == pytest.approx(0.099900487, abs=2e-8)
    assert run.impacts["F_peak"].max() == pytest.approx(3631.8, rel=1e-3 if "rtol" in how else 1e-2)
    assert run.peak("crankpin.F").max == pytest.approx(3631.8, rel=1e-3)
    assert run.check(), run.check()


def test_batches_find_what_single_runs_find(slider_crank: gudgeon.Simulation) -> None:
    batch = slider_crank.simulate_many({"c": np.linspace(0.9e-4, 1.1e-4, 12)}, 0.05, output=2000, threads=1)
    assert len(batch[6].impacts) > 0
    for k in range(12):
        assert checked(batch[k])[0], checked(batch[k])[0]


def test_a_journal_that_leaves_its_wall_begins_no_contact(tmp_path: Path) -> None:
    """At the end of a contact δ is rounded to 1e-17 m of either sign: that is no onset, for the journal moves away."""
    masses = {"m1": 1.135563091006832, "m2": 0.4728966892529033, "m3": 1.385937346495955}
    inertias = {"J1": 7.783051610346294e-4, "J2": 6.283048299900355e-4, "J3": 2.1112895000329528e-4}
    numbers = ", r: 20 mm, L: 0.10158570946666343 m" + "".join(f", {name}: {m} kg" for name, m in masses.items())
    numbers += "".join(f", {name}: {J} kg*m^2" for name, J in inertias.items())
    cam = scene_of(tmp_path, CAM, numbers, weight=True)
    found = [
        (63.04230356637408, 1.144093514851275e-4, 0.5, 1e-9, 0.06748355378976237),
        (53.929027525503656, 8.290744578572464e-4, 0.3, 1e-9, 0.13656634618701458),
        (74.00794940329101, 2.225012400357546e-4, 0.9, 1e-7, 0.10342589017236986),
    ]
    contacts = 0
    for omega, c, ce, rtol, t_end in found:
        run = cam.simulate(t_end, parameters={"omega": omega, "c": c, "ce": ce, "mu": 0.0}, rtol=rtol, output=20_000)
        check, phantoms = checked(run)
        contacts += len(run.impacts)
        assert check and not phantoms, check
    assert contacts > 20


def test_random_machines_have_no_penetration_outside_a_contact() -> None:
    campaign = Campaign(np.random.default_rng(3), show=0)
    campaign.run(14, "slider_crank crankpin flores", quiet=True)
    total = campaign.total
    assert total.runs == 14 and total.contacts > 100
    assert total.faulty == total.phantom == 0


# of the campaign: after a contact the steps of dop853 are tried so long that a stage of the interpolant cannot be
# computed, where the rod no longer reaches the slider's line
REACH = {
    "omega": 46.515639271412496,
    "c": 0.0001733702097200314,
    "ce": 0.9,
    "mu": 0.0,
    "r": 0.0225073401946568,
    "L": 0.10188064912078823,
    "m1": 0.07653529805733969,
    "J1": 3.672903710730944e-06,
    "m2": 1.1019251032937192,
    "J2": 0.0017811030586876173,
    "m3": 0.2676621582289156,
    "J3": 6.810353566637155e-05,
}


def test_no_event_is_sought_on_the_interpolant_of_another_step(tmp_path: Path) -> None:
    """An interpolant that could not be made was taken for made: that of the step before, which found a contact."""
    path = tmp_path / "cam.yaml"
    path.write_text(text_of("cam", "crankpin", "flores"), encoding="utf-8")
    simulation = gudgeon.load(path, "dry")
    right = simulation.simulate(0.035, method="radau9", rtol=1e-11, output=100, parameters=REACH).impacts["t_on"]
    for output in (100, 5000):
        run = simulation.simulate(0.2819817717906081, method="dop853", rtol=1e-6, output=output, parameters=REACH)
        found = run.impacts["t_on"][run.impacts["t_on"] < 0.035]
        np.testing.assert_allclose(found, right, rtol=0, atol=2e-6)
