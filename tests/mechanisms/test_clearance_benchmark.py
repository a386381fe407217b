"""benchmarks/clearance: gudgeon beside the numbers of a code that shares nothing with it, to nine digits."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import gudgeon
import tests.benches  # noqa: F401
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
        assert abs(own - wanted.e.values[:, k])[there].max() < 3e-9 * case.clearance
        began = wanted.onset.values[k][wanted.onset.values[k] <= wanted.attrs["horizon"]]
        contacts = [impact["t_on"] for impact in run.impacts if impact["joint"] == k][: len(began)]
        assert contacts == pytest.approx(began, abs=1e-10)
    assert wanted.attrs["clearance"] == case.clearance and there.sum() > 30


def test_the_page_has_all_of_them() -> None:
    table = re.findall(r"^\| \[(\w+)\]\(data/(\w+)\.nc\)", PAGE, re.MULTILINE)
    assert [name for name, _ in table] == [file for _, file in table] == list(cases())
    assert sorted(path.stem for path in (FOLDER / "data").iterdir()) == sorted(cases())
