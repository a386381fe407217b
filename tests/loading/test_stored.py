"""The stored form of a scene says nothing twice, and is the same scene again."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

import gudgeon
from gudgeon.contract.kernel_source import KernelSource
from tests.slow import slow_rows_but

VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"


NAMES = (("nine_bar_press", "dry"), ("four_bar", "ideal"), ("belt_block", "ideal"), ("n_four_bar", "ideal"))
SCENES = [(name, scene, formulation) for formulation in ("reduced", "full") for name, scene in NAMES]


@pytest.mark.parametrize(("name", "scene", "formulation"), slow_rows_but([*SCENES[:3], SCENES[5]], SCENES))
def test_what_follows_is_left_out_and_comes_back(name: str, scene: str, formulation: str) -> None:
    source = gudgeon.load(name, scene, formulation=formulation).source
    text = source.to_json()
    assert KernelSource.from_json(text) == source and KernelSource.from_json(text).to_json() == text
    data = json.loads(text)
    assert not data.keys() & {"coordinates", "main", "cdef", "overrides"} and not data["story"].keys() & {"rows"}
    assert all(isinstance(row, int) for row in data["rows"]) and "unit" not in data["slots"][0]
    assert all(value not in ([], {}, "") for value in data.values())


def test_what_does_not_follow_stays() -> None:
    """Other units, an order of rows or coordinates of its own."""
    source = gudgeon.load("four_bar").source
    odd = replace(
        source,
        coordinates=source.coordinates[::-1],
        equations=(replace(source.equations[0], unit="rad"), *source.equations[:0:-1]),
        parameters=(replace(source.parameters[0], unit="furlong"), *source.parameters[1:]),
        integrated_pivots=(),
        main="other.c",
        bodies=tuple(replace(body, index=body.index + 1) for body in source.bodies),
    )
    assert KernelSource.from_json(odd.to_json()) == odd
