"""benchmarks/clearance: gudgeon beside the numbers of a code that shares nothing with it, to nine digits."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import gudgeon
import tests.benches  # noqa: F401
from benchmarks.clearance.__main__ import beside
from benchmarks.clearance.cases import Case, cases
from tests.programs import needs_compiler

FOLDER = Path(__file__).resolve().parents[2] / "benchmarks" / "clearance"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")


@needs_compiler
@pytest.mark.parametrize(("name", "case"), cases().items())
def test_nine_digits_to_the_horizon(name: str, case: Case) -> None:
    """1e-12 where the numbers were made with 1e-13, so that the last digit has room."""
    wanted = xr.load_dataset(FOLDER / "data" / f"{name}.nc", engine="h5netcdf")
    method, samples = "radau9" if case.is_film else "dop853", wanted.sizes["time"] - 1
    simulation = gudgeon.load(case.file, case.scene)
    run = simulation.simulate(case.t_end, output=samples, parameters=case.parameters, method=method, rtol=1e-12)
    there = wanted.time.values <= wanted.attrs["horizon"]
    for k, joint in enumerate(case.joints):
        own = np.stack([run[f"{joint}.ex"], run[f"{joint}.ey"]], -1)
        assert abs(own - wanted.e.values[:, k])[there].max() < 3e-9 * case.clearances[k]
        began = wanted.onset.values[k][wanted.onset.values[k] <= wanted.attrs["horizon"]]
        lasting = run.impacts[run.impacts["t_off"] != run.impacts["t_on"]]  # a blow of rigid surfaces takes no time
        contacts = list(lasting["t_on"][lasting["joint"] == k][: len(began)])
        assert contacts == pytest.approx(began, abs=1e-10)
    assert np.all(wanted.attrs["clearance"] == case.clearances) and there.sum() > 30


@needs_compiler
@pytest.mark.parametrize(("name", "case"), [(name, case) for name, case in cases().items() if case.rows])
def test_beside_rows_that_another_code_printed(name: str, case: Case) -> None:
    """Siconos' time stepping is of first order: its own three published versions of θ part by 2.5e-4 rad, of F by 20 %.

    The step, 1e-4 s, times the largest rates here (14 rad/s, a journal that comes to its wall with 1.2 m/s).
    """
    off = beside(case, gudgeon.load(case.file, case.scene))
    assert off["crank.theta"].max() < 1e-4 and off["crank.omega"].max() < 1e-2
    for k, joint in enumerate(case.joints):
        assert max(off[f"{joint}.{axis}"].max() for axis in ("ex", "ey")) < 0.05
        assert np.median(off[f"{joint}.Fn"]) < 6e-3 and off[f"{joint}.Fn"].max() < (0.04, 0.11, 0.1)[k]


@needs_compiler
def test_a_threshold_below_all_roundings_changes_nothing() -> None:
    """1e-12 m/s where bodies go 20 m/s: a closed contact has a part in blows whatever its rate is rounded to."""
    case = cases()["four_bar_tracking"]
    simulation, address = gudgeon.load(case.file, case.scene), "contacts.rigid.normal.threshold"
    run, low = (simulation.simulate(0.6, output=6, parameters={address: x}, rtol=1e-9) for x in (1e-4, 1e-12))
    assert {*run.impacts["joint"]} == {0, 1, 2} and len(run.impacts) == 16
    np.testing.assert_array_equal(low.q, run.q)
    assert low.impacts.tobytes() == run.impacts.tobytes()


def test_the_page_has_all_of_them() -> None:
    table = re.findall(r"^\| \[(\w+)\]\(data/(\w+)\.nc\)", PAGE, re.MULTILINE)
    assert [name for name, _ in table] == [file for _, file in table] == list(cases())
    assert sorted(path.stem for path in (FOLDER / "data").iterdir()) == sorted(cases())
