"""A sine or cosine alone in an event: once declared twice, in the reduced formulation and in lanes."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import pytest

from gudgeon.generator.pipeline import generate_kernel_source
from tests.fuzz.through_c import check_syntax
from tests.slow import slow_but

MECHANISMS = resources.files("gudgeon.mechanisms")


ZEROS = "sin(crank.theta)", "cos(crank.theta)", "sin(t*1 rad/s)"


@pytest.mark.parametrize("zero", slow_but(ZEROS[::2], ZEROS))
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_an_event_of_one_sine_compiles(zero: str, formulation: str, tmp_path: Path) -> None:
    text = MECHANISMS.joinpath("four_bar.yaml").read_text(encoding="utf-8")
    text += f"\nevents: {{rev: {{zero: {zero}, direction: rising}}}}\n"
    check_syntax(generate_kernel_source(text.encode(), "f", "ideal", None, formulation), tmp_path)


def test_of_runs_side_by_side_too(tmp_path: Path) -> None:
    text = MECHANISMS.joinpath("nine_bar_press.yaml").read_text(encoding="utf-8")
    text += "\nevents: {rev: {zero: sin(L1.theta)}, other: {zero: cos(t*1 rad/s)}}\n"
    source = generate_kernel_source(text.encode(), "f", "dry")
    assert source.lane_file
    check_syntax(source, tmp_path)
