"""CombinedObserver scenes in one Dataset, and the lists of a batch as long tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.pump import TEXT as PUMP

pytest.importorskip("xarray")


def test_scenes_stand_side_by_side(run: Result, ideal: Result) -> None:
    data = gudgeon.join([ideal, run])
    assert data["scene"].to_numpy().tolist() == ["ideal", "dry"]
    assert dict(data.sizes) == {"scene": 2, "time": len(run.t)}
    for result in (run, ideal):
        own = data.sel(scene=result.source.scene)
        for name in result.names:
            np.testing.assert_array_equal(own[name].to_numpy(), result[name])
            assert own[name].attrs["units"] == (result.unit(name) or "1")
    assert np.isnan(data.sel(scene="ideal")["A.Fn"]).all()  # what a scene does not have


def test_other_times_are_not_numbers(make: Callable[..., Result]) -> None:
    short, long = make("ideal", 101, 0.5), make("dry", 201, 1.0)
    data = gudgeon.join([short, long])
    assert np.isnan(data["S9.y"].sel(scene="ideal", time=slice(0.51, 1.0))).all()
    np.testing.assert_array_equal(data["S9.y"].sel(scene="ideal", time=short.t), short["S9.y"])


def test_what_cannot_be_joined_is_told(run: Result, ideal: Result) -> None:
    other = replace(ideal, source=replace(ideal.source, mechanism="other"))
    for wrong, words in (([run, run], "'dry'"), ([run, other], "two mechanisms"), ([], "one scene"), ([1], "runs")):
        with pytest.raises(BadValueError, match=words):
            gudgeon.join(wrong)  # type: ignore[arg-type]


@needs_compiler
def test_batches_have_their_lists_as_long_tables(tmp_path: Path) -> None:
    file = tmp_path / "pump.yaml"
    file.write_text(PUMP + "events: {turn: {zero: piston.vx}}\n")
    batches = [
        gudgeon.load(file, s).simulate_many({"omega": [200.0, 400.0]}, 0.04, output=11) for s in ("worn", "ideal")
    ]
    impacts = batches[0].to_xarray(part="impacts")
    events = batches[0].to_xarray(part="events")
    for i in range(2):
        own = impacts["run"] == i
        np.testing.assert_array_equal(impacts["t_on"][own], batches[0].impacts[i]["t_on"])
        np.testing.assert_array_equal(events["t"][events["run"] == i], batches[0].events[i]["t"])
        assert len(batches[0].events[i]) > 0 and len(batches[0].impacts[i]) > 0
    assert {*impacts["joint"].to_numpy()} == {"B"} and {*events["event"].to_numpy()} == {"turn"}
    with pytest.raises(UnknownNameError, match="impacts"):
        batches[0].to_xarray(part="impact")
    joined = gudgeon.join(batches)
    assert dict(joined.sizes) == {"scene": 2, "run": 2, "time": 12}
    np.testing.assert_array_equal(joined["piston.x"].sel(scene="worn"), batches[0]["piston.x"])
