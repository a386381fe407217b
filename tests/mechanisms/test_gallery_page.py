"""docs/gallery.md: its drawings are what their captions' commands write, its numbers are what runs give."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.cli import app  # noqa: E402
from gudgeon.loading.shipped import find_shipped_file, list_generated_scenes, list_shipped_mechanisms  # noqa: E402
from tests.programs import needs_compiler

pytestmark = needs_compiler
DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE = (DOCS / "gallery.md").read_text(encoding="utf-8")
DRAWN = re.findall(r"!\[[^\]`]*`(gudgeon draw (\w+)[^`]*)`[^\]]*\]\((gallery/\w+\.svg)\)", PAGE)
PARTS = r'viewBox="[^"]*"|id="(?:body|joint|drive|inset|force)-[^"]*"'


def test_all_of_the_gallery_is_there() -> None:
    names = [name for _, name, _ in DRAWN]
    assert len(names) == len(set(names)) == PAGE.count("\n## ") == PAGE.count("To learn: ") == 15
    assert set(list_shipped_mechanisms()) - set(list_generated_scenes()) <= set(names)
    assert sorted(path.name for path in (DOCS / "gallery").iterdir()) == sorted(f"{name}.svg" for name in names)


def test_its_pages_are_of_scenes_that_there_are() -> None:
    commands = re.findall(r"^gudgeon equations (\w+)(?: --scene (\w+))? -o (\w+)\.html$", PAGE, re.MULTILINE)
    assert [name for name, *_ in commands] == [file for *_, file in commands] == [name for _, name, _ in DRAWN]
    for name, scene, _ in commands:
        assert not scene or f"\n  {scene}:" in find_shipped_file(name).read_text("utf-8"), (name, scene)


@pytest.mark.parametrize(
    ("line", "file"),
    [
        pytest.param(line, file, marks=[pytest.mark.slow] * (place % 3 > 0))
        for place, (line, _, file) in enumerate(DRAWN)
    ],
)
def test_a_drawing_is_what_its_command_writes(line: str, file: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, [*shlex.split(line)[1:], "-o", str(tmp_path / "now.svg")])
    assert done.exit_code == 0, done.output
    now, shown = (path.read_text("utf-8") for path in (tmp_path / "now.svg", DOCS / file))
    assert re.findall(PARTS, shown) == re.findall(PARTS, now) != []


@pytest.mark.slow
def test_its_numbers() -> None:
    """Those that no other test of the gallery looks at."""
    crank = gudgeon.load("slider_crank").simulate(0.1, output=100)["slider.ax"]
    assert (-crank[0], crank[50]) == pytest.approx((280, 115), abs=0.5)
    rocker = np.degrees(gudgeon.load("four_bar").simulate(1.0, output=2000)["transmission_angle"])
    assert (rocker.min(), rocker.max()) == pytest.approx((26.4, 86.4), abs=0.05)
    leg = gudgeon.load("jansen_leg").simulate(1.0, output=2000)
    y, low = leg["foot_height"], leg["foot_height"] < leg["foot_height"].min() + 1.5e-3
    assert low.mean() == pytest.approx(0.48, abs=0.005) and np.ptp(y) == pytest.approx(22e-3, abs=0.5e-3)
    assert np.ptp(leg["lower.R.x"][low]) == pytest.approx(62e-3, abs=0.5e-3)
    lift = np.abs(gudgeon.load("scissor_lift").simulate(4.0)["cylinder.force"][[0, -1]]) / (70 * 9.81)
    assert lift == pytest.approx([6.1, 0.87], abs=0.02)
    boom = np.abs(gudgeon.load("cylinder_boom").simulate(6.0)["cylinder.force"][[0, -1]])
    assert boom == pytest.approx([16.6e3, 16.4e3], abs=50)
    assert np.abs(gudgeon.load("toggle_clamp").simulate(2.0)["hand.torque"][:-100]).max() == pytest.approx(41, abs=0.5)
    gear = gudgeon.load("landing_gear").simulate(2.0)
    assert np.degrees(np.ptp(gear["leg_angle"])) == pytest.approx(85, abs=0.5)
    assert (gear["screw.force"].max(), gear["A.F"].max()) == pytest.approx((2.7e3, 2.2e3), rel=0.02)
    line = gudgeon.load("double_rocker").simulate(1.0, output=4000)["off_line"]
    assert np.abs(np.r_[line[:1001], line[-1001:]]).max() == pytest.approx(0.39e-3, abs=5e-6)
    squeezer = gudgeon.load("andrews_squeezer", "short").simulate()["OF.theta"]
    assert np.ptp(squeezer) == pytest.approx(15.9, abs=0.05)
    hit, soft = (gudgeon.load("flores_slider_crank", scene).simulate(rtol=1e-8) for scene in ("internal", "external"))
    assert (hit.impacts[0]["F_peak"], soft.impacts[0]["F_peak"]) == pytest.approx((45.8e3, 24.1e3), abs=60)
    assert (hit["wristpin.state"] == 2).mean() == pytest.approx(0.75, abs=0.03)
    guided, free = gudgeon.load("guided_slider_crank", "elastic"), gudgeon.load("guided_slider_crank")
    run, ideal = guided.simulate(rtol=1e-9), free.simulate()
    assert (run.peak("guide.F").max, ideal["guide.F"].max()) == pytest.approx((7.3e3, 121), rel=5e-3)
    assert np.abs(run["slider.x"] - ideal["slider.x"]).max() == pytest.approx(0.60e-3, abs=5e-6)
