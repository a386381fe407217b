"""A study beside runs made one by one, scipy.stats.qmc, NumPy on full series and closed forms."""

from __future__ import annotations

import json
import math
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import trapezoid
from scipy.stats import norm, qmc

import gudgeon
from gudgeon.errors import BadValueError, InputError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble import final, resolve
from gudgeon.studies.ensemble.final import split_into_boxes
from gudgeon.studies.ensemble.notes import get_message_kind
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.pump import Gudgeon

pytestmark = needs_compiler
CRANK: dict[str, Any] = {
    "mechanism": "slider_crank",
    "scenes": ["ideal", "dry"],
    "parameters": {"c": ["0.1 mm", "0.3 mm"], "omega": {"from": "300 rpm", "to": "600 rpm", "count": 3}},
    "t_end": "pi/omega",
    "output": 50,
    "windows": {"late": {"from": "t_end/2", "to": "0.9*t_end"}},
    "measures": {
        "top": {"max": "slider.x", "window": "late"},
        "low": {"min": "slider.x", "window": "late"},
        "peak": {"peak": "slider.ax", "window": "late"},
        "range": {"range": "slider.x"},
        "mean": {"mean": "slider.vx", "window": "late"},
        "rms": {"rms": "slider.vx"},
        "end": {"final": "slider.x"},
        "steps": {"peak_of_steps": "slider.ax"},
        "least": {"min_of_steps": "slider.ax"},
        "hits": {"impacts": "wristpin"},
        "force": {"peak_force": "wristpin"},
    },
    "keep": ["slider.x", "slider.vx", "slider.ax"],
}


@cache
def loaded(mechanism: str, scene: str = "ideal") -> Simulation:
    return gudgeon.load(mechanism, scene)


@pytest.fixture(scope="module")
def crank() -> gudgeon.Study:
    return gudgeon.study(CRANK)


def test_a_grid_is_its_runs_made_one_by_one(crank: gudgeon.Study) -> None:
    """To the bit, series and peaks; the dimensions are the grid's axes, in the order of the file."""
    found = crank.dataset
    assert found["steps"].dims == ("scene", "c", "omega") and crank.runs == 12 and crank.failed == 0
    np.testing.assert_array_equal(found["omega"], np.linspace(10 * np.pi, 20 * np.pi, 3))
    assert found["c"].attrs["units"] == "m" and found["peak"].attrs == {
        "units": "m/s^2",
        "long_name": "peak of slider.ax in window late",
    }
    for scene, c, k in (("ideal", 1e-4, 0), ("dry", 1e-4, 2), ("dry", 3e-4, 1)):
        omega = float(found["omega"][k])
        run = loaded("slider_crank", scene).simulate(
            math.pi / omega, output=50, parameters={"c": c, "omega": omega}, peaks=["slider.ax"]
        )
        own = found.sel(scene=scene, c=c, omega=omega)
        for name in ("slider.x", "slider.vx", "slider.ax"):
            np.testing.assert_array_equal(own[name], run[name])
        np.testing.assert_array_equal(own["t"], run.t)
        assert own["steps"] == run.peak("slider.ax").abs and own["least"] == run.peak("slider.ax").min
        assert own["t_last"] == run.t[-1]
        if scene == "dry":
            assert own["hits"] == len(run.impacts) and own["force"] == run.diagnostics.peaks[0].F


def test_measures_are_those_of_numpy_on_the_series(crank: gudgeon.Study) -> None:
    found = crank.dataset.stack(run=("scene", "c", "omega"))
    for i in range(found.sizes["run"]):
        own = found.isel(run=i)
        t, x, v, a = (own[name].values for name in ("t", "slider.x", "slider.vx", "slider.ax"))
        late = (t >= 0.5 * t[-1]) & (t <= 0.9 * t[-1] * (1 + 1e-12))
        assert late.sum() == 21
        assert (own["top"], own["low"], own["end"]) == (x[late].max(), x[late].min(), x[-1])
        assert own["peak"] == np.abs(a[late]).max() and own["range"] == x.max() - x.min()
        mean = trapezoid(v[late], t[late]) / (t[late][-1] - t[late][0])
        assert float(own["mean"]) == pytest.approx(mean, rel=1e-13)
        assert float(own["rms"]) == pytest.approx(math.sqrt(trapezoid(v * v, t) / t[-1]), rel=1e-13)


def test_what_a_scene_lacks_is_told_once_and_is_nan(crank: gudgeon.Study) -> None:
    assert np.isnan(crank.dataset["hits"].sel(scene="ideal")).all()
    assert crank.dataset["hits"].sel(scene="dry").notnull().all()
    assert sum("hits" in note for note in crank.notes) == 1 and all("ideal" in note for note in crank.notes)


def test_what_runs_say_of_themselves_is_told_once_with_how_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """As their own Results say it; of several blocks, and through their files."""
    monkeypatch.setattr(resolve, "MAX_BLOCK_RUNS", 2)
    clearances, expected = [1e-6, 1.5e-6, 2e-6, 3e-4], {"t_end": "pi/omega", "output": 20}
    measures = {"measures": {"F": {"peak_force": "wristpin"}}}
    found = gudgeon.study(
        {"mechanism": "slider_crank", "scenes": "dry", "parameters": {"c": clearances}} | expected | measures
    )
    own = [
        loaded("slider_crank", "dry").simulate("pi/omega", output=20, parameters={"c": c}).diagnostics.notes
        for c in clearances
    ]
    assert [len(notes) for notes in own] == [1, 1, 1, 0]
    assert found.notes == (f"3 of 4 runs, such as run 0 (c=1e-06): {own[0][0]}",)


@pytest.mark.slow
def test_an_executors_processes_make_the_same_dataset(crank: gudgeon.Study) -> None:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        found = gudgeon.study(CRANK, executor=pool)
    xr.testing.assert_identical(found.dataset, crank.dataset)


def test_blocks_and_threads_change_nothing(crank: gudgeon.Study, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resolve, "MAX_BLOCK_RUNS", 5)
    monkeypatch.setattr(final, "JOINED_BYTES", 0)  # each written to the file by itself
    message: list[float] = []
    found = gudgeon.study(CRANK, threads=1, progress=lambda fraction, text: message.append(fraction))
    assert message == sorted(message) and message[-1] == 1.0
    assert "digest" not in found.dataset.attrs
    xr.testing.assert_identical(found.dataset, crank.dataset)


def test_tables_and_files(crank: gudgeon.Study, tmp_path: Path) -> None:
    table = crank.to_dataframe()
    assert len(table) == 12 and {"scene", "c", "omega", "failure", "top"} <= set(table.columns)
    row = table[(table["scene"] == "dry") & (table["c"] == 3e-4)].iloc[1]
    assert row["top"] == crank.dataset["top"].sel(scene="dry", c=3e-4)[1]
    assert len(crank.to_dataframe("slider.x")) == 12 * 51
    crank.save(tmp_path / "crank.nc")
    with xr.open_dataset(tmp_path / "crank.nc", engine="h5netcdf") as again:
        xr.testing.assert_identical(again.load(), crank.dataset)
    with pytest.raises(BadValueError, match="series"):
        crank.to_dataframe(3)  # type: ignore[arg-type]


def drawn(method: str, **more: Any) -> xr.Dataset:
    spreads = {"g": {"mean": "9.81 m/s^2", "std": "0.1 m/s^2"}, "length": {"from": "50 cm", "to": "2 m"}}
    spreads["length"] |= more
    draw = {"count": 6, "seed": 11, "method": method, "parameters": spreads}
    expected = {"t_end": "10 ms", "output": 1, "measures": {"y": {"final": "bob.y"}}}
    return gudgeon.study({"mechanism": "pendulum", "draw": draw} | expected).dataset


def test_draws_are_those_of_scipy() -> None:
    points = {
        "random": np.random.default_rng(11).random((6, 2)),
        "halton": qmc.Halton(2, seed=11).random(6),
        "latin_hypercube": qmc.LatinHypercube(2, seed=11).random(6),
        "sobol": qmc.Sobol(2, seed=11).random(8)[:6],
    }
    for method, share in points.items():
        found = drawn(method)
        assert found["y"].dims == ("draw",) and found["g"].dims == ("draw",)
        np.testing.assert_allclose(found["g"], norm.ppf(share[:, 0], 9.81, 0.1), rtol=1e-14)
        np.testing.assert_allclose(found["length"], 0.5 + 1.5 * share[:, 1], rtol=1e-15)
    logs = drawn("sobol", spacing="geometric")
    np.testing.assert_allclose(logs["length"], 0.5 * 4 ** points["sobol"][:, 1], rtol=1e-14)
    xr.testing.assert_identical(drawn("sobol", spacing="geometric"), logs)
    free = logs["y"] + 9.81 / 2 * 0.01**2  # of a rod that is let go level, the bob falls freely at first
    np.testing.assert_allclose(free, 0.0, atol=1e-4)


def test_arrays_of_numpy_and_more_than_an_attribute_holds() -> None:
    """Whole numbers of NumPy count as such; what HDF5 has no attribute for is in the folder's own file."""
    lengths = np.linspace(0.5, 2.0, 3)
    windows = {f"window_{k}": {"from": " + ".join(["0 s"] * 40)} for k in range(300)}
    study = {
        "mechanism": "pendulum",
        "parameters": {"length": lengths},
        "t_end": 1e-3,
        "output": np.int64(1),
        "starts": {"count": np.int64(2), "absolute": {"length": 1e-3}},
        "windows": windows,
        "measures": {"x": {"final": "bob.x", "window": "window_7"}},
    }
    found = gudgeon.study(study)
    assert found.measures == ("x",) and found.runs == 6 and len(json.dumps(windows)) > 1 << 16
    assert list(found.to_dataframe().columns)[:2] == ["length", "start"]
    np.testing.assert_array_equal(found.dataset["length"], lengths)
    off = found.dataset["x"] - found.dataset["length"] - found.dataset["length.absolute"]
    np.testing.assert_allclose(off, 0.0, atol=1e-8)


def test_a_zip_is_one_dimension_and_the_end_follows_the_numbers() -> None:
    """A quarter of the pendulum's period, 2.367841947576 s at 9.81 m/s² and 1 m, and ∝ √(l/g): there it hangs."""
    study = {
        "mechanism": "pendulum",
        "zip": {"run": {"g": [9.81, 1.62, 9.81], "length": ["1 m", "1 m", "25 cm"]}},
        "t_end": "2.367841947576 s / 4 * sqrt(9.81 m/s^2 * length / (1 m * (g)))",
        "output": "t_end / 1 ms",
        "windows": {"hanging": {"from": "t_end"}},
        "measures": {"swing": {"max": "swing", "window": "hanging"}, "fast": {"final": "bob.vx"}},
        "keep": ["bob.y"],
    }
    found = gudgeon.study(study).dataset
    assert found["swing"].dims == ("run",) and found["g"].dims == found["length"].dims == ("run",)
    np.testing.assert_allclose(found["swing"], 0.0, atol=1e-7)
    energy = 0.5 * found["fast"] ** 2 - found["g"] * found["length"]  # ½ v² = g l: from the level to below
    np.testing.assert_allclose(energy, 0.0, atol=1e-6)
    counts = found["bob.y"].notnull().sum("sample")
    np.testing.assert_array_equal(counts, np.rint(found["t_last"] / 1e-3) + 1)


def test_contacts_and_choices_of_a_ball() -> None:
    """It falls 1 m: first contact at √(2h/g) with √(2gh); thrown back by e it comes again 2e√(2h/g) later."""
    study = {
        "mechanism": "bouncing_ball",
        "scenes": "damped",
        "parameters": {"height": ["1 m", "0.25 m"]},
        "choices": {
            "law": {
                "hunt": {"contacts.damped.normal.dissipation": "hunt_crossley"},
                "none": {"contacts.damped.normal.dissipation": "none"},
            }
        },
        "t_end": "2.5 * sqrt(2*height/(9.81 m/s^2))",
        "output": 100,
        "windows": {"first": {"to": "1.5*sqrt(2*height/(9.81 m/s^2))"}, "after": {"from": "t_end"}},
        "measures": {"t": {"first_impact": "fall"}, "v": {"impact_speed": "fall"}, "n": {"impacts": "fall"}},
    }
    with pytest.raises(InputError, match="the name 't' is already used, by the dataset"):
        gudgeon.study(study)
    study["measures"] = {
        "when": {"first_impact": "fall"},
        "speed": {"impact_speed": "fall"},
        "hits": {"impacts": "fall", "window": "first"},
        "none": {"impacts": "fall", "window": "after"},
    }
    found = gudgeon.study(study).dataset
    assert found["when"].dims == ("law", "height") and list(found["law"].values) == ["hunt", "none"]
    height = found["height"].values * np.ones((2, 1))
    np.testing.assert_allclose(found["when"], np.sqrt(2 * height / 9.81), rtol=1e-7)
    np.testing.assert_allclose(found["speed"], np.sqrt(2 * height * 9.81), rtol=1e-7)
    assert (found["hits"] == 1).all() and (found["none"] == 0).all() and found["scene"] == "damped"


def test_perturbed_starts_are_off_by_their_size() -> None:
    study: dict[str, Any] = {
        "mechanism": "pendulum",
        "parameters": {"g": [9.81, 20]},
        "t_end": "1 ms",
        "output": 1,
        "starts": {
            "count": 5,
            "seed": 4,
            "ensembles": {
                "near": {"relative": {"g": "1e-6"}},
                "far": {"relative": {"g": 0.1}, "absolute": {"length": "1 mm"}},
                "away": {"absolute": {"parameters.g": "1 m/s^2"}},
            },
        },
        "measures": {"a": {"final": "bob.ay"}, "x": {"final": "bob.x"}},
    }
    found = gudgeon.study(study).dataset
    assert found["a"].dims == ("g", "ensemble", "start")
    off = np.stack([np.random.default_rng([4, k]).uniform(-1, 1, (5, 3)) for k in range(3)])
    np.testing.assert_allclose(found["g.relative"], np.array([[1e-6], [0.1], [0]]) * off[:, :, 0], rtol=1e-15)
    np.testing.assert_allclose(found["length.absolute"][1], 1e-3 * off[1, :, 1], rtol=1e-15)
    np.testing.assert_array_equal(found["length.absolute_size"], [0.0, 1e-3, 0.0])
    np.testing.assert_array_equal(found["g.relative_size"], [1e-6, 0.1, 0.0])
    g = found["g"].values[:, None, None] * (1 + found["g.relative"].values) + found["parameters.g.absolute"].values
    np.testing.assert_allclose(found["parameters.g.absolute"][2], off[2, :, 2], rtol=1e-15)
    np.testing.assert_allclose(found["a"], -g, rtol=1e-4)
    np.testing.assert_allclose(found["x"], 1.0 + found["length.absolute"].values + 0 * g, rtol=1e-7)
    study["starts"] = {"count": 5, "seed": 4, "relative": {"parameters.g": 0.1}, "distribution": "normal"}
    alone = gudgeon.study(study).dataset
    normal = np.random.default_rng([4, 0]).standard_normal((5, 1))[:, 0]
    np.testing.assert_allclose(alone["parameters.g.relative"], 0.1 * normal)
    assert alone["a"].dims == ("g", "start")
    off_by = 1 + alone["parameters.g.relative"].values
    np.testing.assert_allclose(alone["a"], -np.array([[9.81], [20.0]]) * off_by, rtol=1e-4)


def test_starts_alone_and_one_run_alone() -> None:
    """Nothing else varies: 200 runs, of which each is off by its own; and a study of the file's numbers."""
    expected = {"mechanism": "pendulum", "t_end": 1e-3, "output": 1, "measures": {"x": {"final": "bob.x"}}}
    found = gudgeon.study(expected | {"starts": {"count": 200, "absolute": {"length": "1 mm"}}}).dataset
    np.testing.assert_allclose(found["x"], 1.0 + found["length.absolute"], atol=1e-7)
    assert float(found["length.absolute_size"]) == 1e-3 and len(np.unique(found["x"])) == 200
    one = gudgeon.study(expected)
    assert one.runs == 1 and one.dataset["x"].dims == () and len(one.to_dataframe()) == 1
    assert one.dataset["x"] == loaded("pendulum").simulate(1e-3, output=1)["bob.x"][-1]


def test_failures_are_rows_with_their_reason(call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A clearance larger than its bearing, an end before the start: the others are as they are without them."""
    study: dict[str, Any] = {
        "mechanism": "slider_crank",
        "scenes": "dry",
        "parameters": {"c": ["0.1 mm", "20 mm", "0.3 mm"], "omega": ["300 rpm", "-300 rpm"]},
        "t_end": "2 ms * omega / (300 rpm)",
        "output": 4,
        "keep": ["slider.x"],
        "measures": {"x": {"final": "slider.x"}},
    }
    found = gudgeon.study(study)
    failed = found.dataset["failure"].values != ""
    assert failed.tolist() == [[False, True], [True, True], [False, True]] and found.failed == 4
    assert sorted(found.failures.values()) == [2, 2] and any("radius" in message for message in found.failures)
    np.testing.assert_array_equal(np.isnan(found.dataset["x"]), failed)
    np.testing.assert_array_equal(found.dataset["slider.x"].isnull().all("time"), failed)
    run = loaded("slider_crank", "dry").simulate(2e-3, output=4, parameters={"c": 3e-4, "omega": 10 * math.pi})
    assert found.dataset["x"][2, 0] == run["slider.x"][-1]
    (tmp_path / "s.yaml").write_text(json.dumps(study | {"format": "gudgeon-study/1"}))  # YAML holds JSON
    study["parameters"]["omega"].append("600 rpm")
    whole = gudgeon.study(study).dataset
    monkeypatch.setattr(resolve, "MAX_BLOCK_RUNS", 2)
    xr.testing.assert_identical(gudgeon.study(study).dataset, whole)
    np.testing.assert_array_equal(whole["t"].isnull().all("sample"), whole["failure"] != "")
    done = call("study", "s.yaml")
    assert done.exit_code == 0 and "4 of 6 runs failed" in done.output, done.output
    document = json.loads(call("study", "s.yaml", "--json", "--out", "s.study").output)
    assert document["failed"] == 4 and document["measures"]["x"]["nan"] == 4
    message = dict(zip(found.failures, found.first_failures.values(), strict=True))
    assert sorted(message.values()) == [1, 2] == [int(np.argmax(found.dataset["failure"].values.ravel() != "")), 2]
    late = "t_end is -0.002 with the parameters of this run: expected a positive time (s)"
    assert f"    the first: c = 0.1 mm, omega = −300 rpm: {late}" in done.output
    assert f"c = 0.1 mm, omega = −300 rpm: {late}" in document["first_failures"].values()


@pytest.mark.parametrize(
    ("message", "kind"),
    [
        ("a.R is -0.0001 m with omega = 15.7 1/s, c = -1e-4 m: it is positive", "a.R is … m: it is positive"),
        ("a.R is 2 m with c = 3 m: it is positive\n more", "a.R is … m: it is positive"),
        ("rod12.a = 3.5e+02 m/s^2, -2 1/s^-2 and 11/s", "rod12.a = … m/s^2, … 1/s^-2 and …/s"),
    ],
)
def test_runs_that_failed_of_the_same_are_one_kind(message: str, kind: str) -> None:
    """Without the numbers of each; digits of names and units stay."""
    assert get_message_kind(message) == kind


def test_a_run_that_leaves_its_laws_domain_is_a_row_up_to_there() -> None:
    """Driven at 10⁹ rad/s the journal is pushed through its bearing within a nanosecond."""
    found = gudgeon.study(
        {
            "mechanism": "slider_crank",
            "scenes": "dry",
            "parameters": {"omega": ["600 rpm", 1e9]},
            "t_end": "1 ms",
            "output": 20,
            "measures": {"x": {"final": "slider.x"}, "p": {"peak_force": "wristpin"}},
            "keep": ["slider.x"],
        }
    )
    own = found.dataset.isel(omega=1)
    assert found.failed == 1 and "deep in its bearing" in str(own["failure"].values)
    assert 0 < own["t_last"] < 1e-9 and own["x"].isnull() and own["p"].isnull()
    assert own["slider.x"][0] > 0 and own["slider.x"][1:].isnull().all()
    assert found.dataset["x"][0] == found.dataset["slider.x"][0, -1]


def test_the_command_plans_runs_and_takes_numbers(call: Gudgeon, tmp_path: Path) -> None:
    text = """
format: gudgeon-study/1
mechanism: pendulum
parameters: {g: [9.81, 20], length: 1 m}
t_end: 10 ms
measures: {x: {final: bob.x}}
"""
    (tmp_path / "s.yaml").write_text(text)
    plan = json.loads(call("study", "s.yaml", "--runs", "--json").output)
    assert plan["runs"] == 2 and plan["dimensions"] == {"g": 2} and plan["seconds"] > 0 and plan["blocks"] == 1
    assert not (tmp_path / "s.study").exists()
    done = call("study", "s.yaml", "--set", "length=50cm", "--out", "half")
    assert done.exit_code == 0 and "2 runs (g 2)" in done.output, done.output
    found = gudgeon.load_study(tmp_path / "half").dataset
    assert float(found["length"]) == 0.5
    np.testing.assert_allclose(found["x"], 0.5, rtol=1e-4)
    same = gudgeon.study(tmp_path / "s.yaml", settings={"length": 0.5}).dataset
    np.testing.assert_array_equal(same["x"], found["x"])
    empty = text.replace("measures", "windows: {late: {from: 5 ms * (g) / (9.81 m/s^2) * 1.5, to: t_end}}\nmeasures")
    (tmp_path / "late.yaml").write_text(empty)  # of the second run it begins after its end
    done = call("study", "late.yaml")
    assert "1 of 2 runs failed" in done.output and "window late is from" in done.output, done.output
    done = call("study", "s.yaml", "--set", "g=3", "--out", "moon")  # over the row
    assert done.exit_code == 0 and "1 run" in done.output.splitlines() and "note: g is set" in done.output, done.output
    assert call("study", "s.yaml", "--set", "lenght=3").exit_code == 2


def test_a_scene_that_cannot_move_follows_its_drives() -> None:
    """Whatever method, tolerance and step say: those are of the scenes that are integrated, and a note says so."""
    own: dict[str, Any] = {
        "parameters": {"omega": ["300 rpm", "600 rpm"]},
        "output": 5,
        "t_end": "1 ms",
        "measures": {"x": {"final": "slider.x"}},
        "method": "rk4",
        "step": "t_end / 1000",
    }
    found = gudgeon.study({"mechanism": "slider_crank", "scenes": ["ideal", "dry"]} | own)
    assert found.failed == 0 and sum("no degree of freedom" in note for note in found.notes) == 1
    for omega in (10 * math.pi, 20 * math.pi):
        given = {"omega": omega}
        run = loaded("slider_crank", "dry").simulate(1e-3, output=5, method="rk4", step=1e-6, parameters=given)
        assert found.dataset["x"].sel(scene="dry", omega=omega) == run["slider.x"][-1]
        run = loaded("slider_crank").simulate(1e-3, output=5, parameters=given)
        assert found.dataset["x"].sel(scene="ideal", omega=omega) == run["slider.x"][-1]
    del own["step"], own["method"]
    assert gudgeon.study({"mechanism": "slider_crank", "scenes": ["ideal", "dry"], "rtol": 1e-6} | own).failed == 0
    with pytest.raises(InputError, match="scene dry: .*rtol"):
        gudgeon.study({"mechanism": "slider_crank", "scenes": ["ideal", "dry"], "rtol": 2} | own)


def test_slabs_are_boxes_that_cover_a_range_once() -> None:
    for shape in ((), (7,), (2, 3), (3, 1, 4), (2, 3, 2, 2)):
        size = math.prod(shape)
        for first in range(size):
            for last in range(first + 1, size + 1):
                hit = np.full(shape, -1)
                for at, rows in split_into_boxes(shape, first, last):
                    assert (hit[at] == -1).all()
                    hit[at] = np.arange(rows.start, rows.stop).reshape(np.shape(hit[at]))
                expected = np.where((np.arange(size) >= first) & (np.arange(size) < last), np.arange(size), -1)
                np.testing.assert_array_equal(hit.ravel(), expected)


def test_a_block_holds_as_many_samples_as_fit(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many runs there are: memory is that of a block."""
    monkeypatch.setattr(resolve, "MAX_BLOCK_BYTES", 100_000)
    draw = {"count": 1000, "parameters": {"g": {"from": 5, "to": 10}}}
    plan = resolve_plans({"mechanism": "pendulum", "draw": draw, "output": 99, "keep": ["bob.x"]}).by_part[""]
    assert plan.runs == 1000 and plan.parts[0].block_runs == 100_000 // (8 * 3 * 100)
    assert sum(block.runs for block in plan.blocks) == 1000
