"""The checker of contacts: what it computes from positions, and what it finds in runs that were tampered with."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, SolverError
from gudgeon.results.contact_check import check_contact_samples, compute_penetrations
from tests.integrators.test_forces_within_steps import JOURNAL, MASS, G
from tests.random_contacts import text_of


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> gudgeon.Result:
    path = tmp_path_factory.mktemp("check") / "machine.yaml"
    path.write_text(text_of("slider_crank", "crankpin cylinder", "flores"))
    return gudgeon.load(path, "dry").simulate(0.05, output=4000, peaks=["crankpin.F"])


def test_penetrations_of_journals_and_corners_are_those_of_the_engine(run: gudgeon.Result) -> None:
    found = compute_penetrations(run)
    assert found.shape == (4001, 5)
    for k, joint in enumerate(run.source.clearances):
        np.testing.assert_allclose(found[:, k], run[f"{joint.name}.delta"], rtol=0.0, atol=1e-15)


def test_a_sound_run_has_no_faults(run: gudgeon.Result) -> None:
    found = run.check(5000)
    assert found and found.samples >= 5001 and not found.notes
    found.raise_faults()


def test_a_contact_that_is_not_listed_is_reported(run: gudgeon.Result) -> None:
    joint = [one.name for one in run.source.clearances].index("crankpin")
    own = np.flatnonzero(run.impacts["joint"] == joint)
    largest = own[np.argmax(run.impacts["F_peak"][own])]
    gone = run.impacts[largest]
    broken = replace(run, impacts=np.delete(run.impacts, largest))
    found = check_contact_samples(broken)
    assert not found and {"penetration", "peak"} <= {one.kind for one in found.faults}
    first = next(one for one in found.faults if one.kind == "penetration")
    assert first.joint == "crankpin" and gone["t_on"] <= first.t <= gone["t_off"]
    inside = (run.t >= gone["t_on"]) & (run.t <= gone["t_off"])
    assert first.depth == pytest.approx(run["crankpin.delta"][inside].max(), rel=1e-9)
    assert first.force == run["crankpin.F"][inside].max()
    with pytest.raises(SolverError, match="crankpin penetrates"):
        found.raise_faults()


def test_a_run_that_was_loaded_is_checked_at_its_samples(run: gudgeon.Result, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    run.save(tmp_path / "run.nc")
    found = gudgeon.Result.load(tmp_path / "run.nc").check()
    assert found and found.samples == 4001 and found.notes


@pytest.mark.parametrize("samples", [1, 0, 2.5, "many"])
def test_another_number_of_samples_is_refused(run: gudgeon.Result, samples: object) -> None:
    with pytest.raises(BadValueError, match="samples"):
        run.check(samples)  # type: ignore[arg-type]


def test_a_rigid_contact_that_pulls_and_a_peak_that_is_not_listed_are_reported(tmp_path: Path) -> None:
    path = tmp_path / "journal.yaml"
    path.write_text(JOURNAL)
    given = {"A": 0.9 * MASS * G, "w": 20.0, "y0": -2e-4}
    run = gudgeon.load(path, "rigid").simulate(0.4, parameters=given, output=400, peaks=["pin.F"])
    assert check_contact_samples(run)
    impacts = run.impacts.copy()
    impacts["F_peak"] /= 2.0
    assert {one.kind for one in check_contact_samples(replace(run, impacts=impacts)).faults} == {"peak"}
    pulled = replace(run, stored={"pin.Fy": -run["pin.Fy"]})
    assert {one.kind for one in check_contact_samples(pulled).faults} == {"pull"}


def test_a_force_of_rounding_outside_a_contact_is_none(run: gudgeon.Result) -> None:
    force = run["crankpin.F"].copy()
    free = int(np.flatnonzero(force == 0.0)[0])
    for size, kinds in ((1e-15, set()), (1e-9, {"force"})):
        force[free] = size * force.max()
        found = check_contact_samples(replace(run, stored={**run.stored, "crankpin.F": force}))
        assert {one.kind for one in found.faults} == kinds
