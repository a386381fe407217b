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
from benchmarks.clearance.cases import cases
from tests.programs import needs_compiler
from tests.slow import slow_but

FOLDER = Path(__file__).resolve().parents[2] / "benchmarks" / "clearance"
FAST = [name for name in cases() if name.partition("_")[0] not in ("four", "jansen", "drill", "engine")]
RARE = ("rotor_elastic", "rotor_rigid", "rotor_floating_ring", "slider_crank_external", "landing_gear")
FAST = [name for name in FAST if name not in RARE]
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")


@needs_compiler
@pytest.mark.parametrize("name", slow_but(FAST, cases()))
def test_nine_digits_to_the_horizon(name: str) -> None:
    """At the tolerance that they were made with; three times the last digit, in which two machines may part."""
    case, expected = cases()[name], xr.load_dataset(FOLDER / "data" / f"{name}.nc", engine="h5netcdf")
    method, samples = "radau9" if case.is_film else "dop853", expected.sizes["time"] - 1
    simulation = gudgeon.load(case.file, case.scene)
    run = simulation.simulate(case.t_end, output=samples, parameters=case.parameters, method=method, rtol=1e-13)
    there = expected.time.values <= expected.attrs["horizon"]
    for k, joint in enumerate(case.joints):
        own = np.stack([run[f"{joint}.ex"], run[f"{joint}.ey"]], -1)
        assert abs(own - expected.e.values[:, k])[there].max() < 3e-9 * case.clearances[k]
        began = expected.onset.values[k][expected.onset.values[k] <= expected.attrs["horizon"]]
        lasting = run.impacts[run.impacts["t_off"] != run.impacts["t_on"]]  # a blow of rigid surfaces takes no time
        contacts = list(lasting["t_on"][lasting["joint"] == k][: len(began)])
        assert contacts == pytest.approx(began, abs=1e-10)
    assert np.all(expected.attrs["clearance"] == case.clearances) and there.sum() > 30


@pytest.mark.slow
@needs_compiler
def test_beside_rows_that_another_code_printed() -> None:
    """Siconos' time stepping is of first order: its own three published versions of θ part by 2.5e-4 rad, of F by 20 %.

    The step, 1e-4 s, times the largest rates here (14 rad/s, a journal that comes to its wall with 1.2 m/s).
    """
    case = cases()["four_bar_tracking"]
    off = beside(case, gudgeon.load(case.file, case.scene))
    assert off["crank.theta"].max() < 1e-4 and off["crank.omega"].max() < 1e-2
    for k, joint in enumerate(case.joints):
        assert max(off[f"{joint}.{axis}"].max() for axis in ("ex", "ey")) < 0.05
        assert np.median(off[f"{joint}.Fn"]) < 6e-3 and off[f"{joint}.Fn"].max() < (0.04, 0.11, 0.1)[k]


def let_go(h: float, t: float = 2e-3) -> tuple[float, float]:
    """Angle and speed of the slider-crank let go, before it touches, by time steps with M of the end of each."""
    l1, l2, m, m3 = 0.153, 0.306, 0.038, 0.076
    both = (0.5 * m + m3) * l1 * l2
    own = np.array([7.4e-5 + (1.25 * m + m3) * l1**2, 5.9e-4 + (0.25 * m + m3) * l2**2])
    weight = 9.81 * np.array([(1.5 * m + m3) * l1, (0.5 * m + m3) * l2])

    def forces(q: np.ndarray, v: np.ndarray) -> np.ndarray:
        return -both * np.sin(q[0] - q[1]) * np.array([v[1] ** 2, -(v[0] ** 2)]) - weight * np.cos(q)

    q, v = np.zeros(2), np.array([150.0, -75.0])
    for _ in range(round(t / h)):
        after = v
        for _ in range(20):
            end = q + 0.5 * h * (v + after)
            M = np.array([[own[0], 0.0], [0.0, own[1]]]) + both * np.cos(end[1] - end[0]) * (1.0 - np.eye(2))
            after = v + np.linalg.solve(M, 0.5 * h * (forces(q, v) + forces(end, after)))
        q, v = q + 0.5 * h * (v + after), after
    return float(q[0]), float(v[0])


@needs_compiler
def test_a_slider_in_its_guide_beside_siconos() -> None:
    """Rows of first order in 1e-4 s: such steps, written out, have them, and come to ours as they get shorter."""
    case = cases()["slider_crank_guide"]
    off = beside(case, gudgeon.load(case.file, case.scene))
    assert off["crank.theta"][1] < 3e-4 and off["crank.theta"].max() < 0.06
    with open(FOLDER / case.rows, encoding="utf-8") as file:
        printed = [line.split(",") for line in file if line.startswith("0.002")][0]
    assert let_go(1e-4) == pytest.approx((float(printed[1]), float(printed[3])), rel=1e-4)
    run = gudgeon.load(case.file, case.scene).simulate(output=[0.0, 2e-3], rtol=1e-11)
    errors = [let_go(h)[1] - run["crank.omega"][1] for h in (1e-4, 5e-5, 2.5e-5)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(1.0, abs=0.1)


@pytest.mark.slow
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
