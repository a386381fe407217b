"""tests/digest.py: what it reports of two outcomes that differ."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gudgeon.integrators.trajectory import EVENT_DTYPE, IMPACT_DTYPE
from tests.digest import Arrays, differences, digest


def run() -> Arrays:
    t = np.linspace(0.0, 1.0, 5)
    impacts = np.array([(0, 0.3, 0.31, -1.0, 50.0, 0.3), (1, 0.6, 0.62, -2.0, 70.0, 0.6)], IMPACT_DTYPE)
    events = np.array([(0, 0.5)], EVENT_DTYPE)
    counts = {"steps": np.array(40), "rejected": np.array(3), "right_hand_sides": np.array(500)}
    state = {"state": np.zeros((5, 1), np.int8), "memory": np.full((5, 1), np.nan)}
    trace = {"trace.t": np.array([0.0, 0.4, 0.8]), "trace": np.zeros((3, 2, 9))}
    return {"t": t, "q": np.stack([t, 4.0 * t], axis=1), "impacts": impacts, "events": events} | counts | state | trace


def batch() -> Arrays:
    return {"t": np.linspace(0.0, 1.0, 5), "q": np.ones((3, 5, 2)), "steps": np.array([4, 5, 6])}


def changed(arrays: Arrays, name: str, place: Any, value: Any) -> Arrays:
    copy = {key: values.copy() for key, values in arrays.items()}
    copy[name][place] = value
    assert differences(arrays, {key: values.copy() for key, values in arrays.items()}) == []
    return copy


def test_the_first_time_and_the_largest_share_of_the_scale() -> None:
    new = changed(run(), "q", (slice(2, 4), 0), [0.5 + 1e-9, 0.75 + 4e-9])
    assert differences(new, run()) == ["q: by 1.0e-09 of scale from 0.5 s on"]
    late = changed(batch(), "q", (0, slice(3, 5)), 1.5)
    late["q"][2, 1] = 0.9
    assert differences(late, batch()) == ["q: by 5.0e-01 of scale from 0.25 s on"]
    traced = changed(run(), "trace", (1, 1, 3), 2.0)
    assert differences(run(), traced) == ["trace: by 1.0e+00 of scale from 0.4 s on"]


def test_counts_come_first_and_are_in_no_digest() -> None:
    new = changed(run(), "steps", (), 42)
    assert digest(new) == digest(run()) != digest(changed(run(), "t", 4, 1.5))
    new["impacts"] = new["impacts"][:1]
    assert differences(new, run()) == ["steps: 42 instead of 40", "impacts: 1 instead of 2"]
    assert differences(changed(batch(), "steps", 1, 7), batch()) == ["steps: [4 7 6] instead of [4 5 6]"]
    more = run() | {"trace.t": np.array([0.0, 0.3, 0.6, 0.8])}
    assert differences(more, run()) == ["trace.t: 4 instead of 3, other from 0.3 s on"]
    earlier = {name: values for name, values in run().items() if name != "steps"}
    assert differences(run(), earlier) == []


@pytest.mark.parametrize(
    ("name", "place", "value", "message"),
    [
        ("state", (1, 0), 1, "1 instead of 0 from 0.25 s on"),
        ("memory", (3, 0), 2.0, "2.0 instead of nan from 0.75 s on"),
        (
            "impacts",
            1,
            (0, 0.6, 0.62, -2.0, 77.0, 0.6),
            "joint 0 instead of 1 from 0.6 s on, F_peak by 1.0e-01 of scale from 0.6 s on",
        ),
        ("events", 0, (0, 0.55), "t by 1.0e-01 of scale from 0.55 s on"),
        ("trace.t", 2, 0.88, "by 1.0e-01 of scale from 0.88 s on"),
        ("q", (0, 0), -0.0, "signs of zeros or bits of NaN"),
    ],
)
def test_each_array_is_told_by_its_kind(name: str, place: Any, value: Any, message: str) -> None:
    assert differences(changed(run(), name, place, value), run()) == [f"{name}: {message}"]


def test_forms_and_refusals() -> None:
    wide = run() | {"q": np.zeros((5, 3)), "works": np.zeros(5)}
    assert differences(wide, run()) == ["q: float64 (5, 3) instead of float64 (5, 2)", "works is new"]
    refused = {"error": np.frombuffer(b"too stiff", np.uint8)}
    assert differences(refused, run()) == ["is refused: too stiff"]
    assert differences(run(), refused) == ["was refused: too stiff"]
