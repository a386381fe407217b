"""docs/describing.md: its YAML pieces are one file that runs as described, its commands and messages are as shown."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

import gudgeon
from gudgeon.cli import app
from gudgeon.generator.format.sections import SECTIONS
from tests.programs import needs_compiler
from tests.scenes import patched

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE = (DOCS / "describing.md").read_text(encoding="utf-8")
NAME, NAME_OF_FIGURE = "valve_engine.yaml", "valve_engine.svg"
Gudgeon = Callable[[str], Result]


def blocks(language: str) -> list[str]:
    """Return the fenced blocks of the page in that language, in their order."""
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


TEXT = "".join(blocks("yaml"))


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gudgeon:
    """Run a command line in a folder that contains the page's mechanism."""
    (tmp_path / NAME).write_text(TEXT, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return lambda line: CliRunner().invoke(app, shlex.split(line)[1:])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Return the path of the page's mechanism."""
    (tmp_path / NAME).write_text(TEXT, encoding="utf-8")
    return tmp_path / NAME


def test_every_block_of_a_file_has_its_piece() -> None:
    """Each key of the format occurs once in the pieces, and every fenced block is of a language that is tested."""
    keys = re.findall(r"^(\w+):", TEXT, re.MULTILINE)
    assert sorted(keys) == sorted(SECTIONS)
    assert PAGE.count("```") == 2 * sum(len(blocks(kind)) for kind in ("yaml", "sh", "python", "text", "diff"))
    assert len(blocks("python")) == len(blocks("diff")) == 1


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize("line", [line for block in blocks("sh") for line in block.splitlines()])
def test_commands(line: str, call: Gudgeon) -> None:
    done = call(line + (" --t-end 0.001 --output 20" if " run " in line else ""))
    assert done.exit_code == 0, done.output


@needs_compiler
def test_the_figure_is_what_its_command_draws(call: Gudgeon, tmp_path: Path) -> None:
    """docs/valve_engine.svg has the same parts in the same order, on a page of the same size."""
    (line,) = re.findall(r"!\[[^\]`]*`([^`]+)`[^\]]*\]\(valve_engine\.svg\)", PAGE)
    assert call(f"{line} -o now.svg").exit_code == 0
    now, shown = (
        (folder / name).read_text("utf-8") for folder, name in ((tmp_path, "now.svg"), (DOCS, NAME_OF_FIGURE))
    )
    parts = r'viewBox="[^"]*"|id="(?:body|joint|drive|inset|force)-[^"]*"'
    assert re.findall(parts, shown) == re.findall(parts, now) and 'id="body-valve"' in shown


def test_check_prints_what_is_shown(call: Gudgeon) -> None:
    assert call(f"gudgeon check {NAME}").stdout in blocks("text")


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize("setting", dict.fromkeys(re.findall(r"--set ([\w.]+=[\w.]+|[\w.]+='[^']+')", PAGE)))
def test_settings_that_it_shows_are_accepted(setting: str, call: Gudgeon) -> None:
    scene = "worn" if setting.startswith("start.play") else "ideal"
    done = call(f"gudgeon run {NAME} --scene {scene} --t-end 0.001 --output 2 --set {setting}")
    assert done.exit_code == 0, done.output


@needs_compiler
def test_points_are_measured_in_the_frames_of_their_bodies(file: Path) -> None:
    """The rod is at asin(50 mm sin 30°/120 mm) below the axis; the valve, whose com is not its origin, at 25 mm."""
    run = gudgeon.load(file).simulate(1e-3, output=1)
    head, turned = (0.05 * math.cos(math.pi / 6), 0.025), -math.asin(0.025 / 0.12)
    cos, sin = math.cos(turned), math.sin(turned)
    expected = {"rod": (0.04, 0.0), "rod.sensor": (0.06, 0.01), "rod.head": (0.12, 0.0), "rod.tail": (0.0, 0.0)}
    expected = {name: (head[0] + x * cos - y * sin, head[1] + x * sin + y * cos) for name, (x, y) in expected.items()}
    expected |= {"valve": (0.0, 0.125), "valve.origin": (0.0, 0.115), "valve.top": (0.0, 0.145)}
    for name, (x, y) in expected.items():
        assert (run[f"{name}.x"][0], run[f"{name}.y"][0]) == pytest.approx((x, y), abs=1e-12)
    assert run["rod.theta"][0] == pytest.approx(turned, abs=1e-12)


@needs_compiler
def test_the_phase_of_the_motor_is_a_parameter(file: Path) -> None:
    run = gudgeon.load(file).simulate(1e-3, output=1, parameters={"phase": "1 rad"})
    assert run["crank.theta"][0] == pytest.approx(1.0, abs=1e-12)


@needs_compiler
def test_the_event_and_the_cam(file: Path) -> None:
    """The piston is at its top after 330°; the valve stays on its cam, for its force is positive all along."""
    run = gudgeon.load(file).simulate(0.1, output=200)
    assert run.events_of("top") == pytest.approx([330.0 / 3600.0], abs=1e-9)
    assert run["rise.Fy"].min() > 0.0 and max(run["valve.origin.y"]) > 0.12
    assert run["gas_power"] == pytest.approx(run["gas.Fx"] * run["piston.vx"], rel=1e-12)


@needs_compiler
def test_materials_and_journals_as_it_describes_them(file: Path) -> None:
    """In the scene soft the disc of the camshaft is of bronze, and the journal begins where `start` says."""
    soft, worn = (gudgeon.load(file, scene).simulate(1e-6, output=1) for scene in ("soft", "worn"))
    assert (soft["wristpin.ex"][0], soft["wristpin.ey"][0]) == pytest.approx((1e-4, -1e-4), abs=1e-15)
    assert soft.parameters["bodies.camshaft.shape.material"] == "bronze"
    assert soft.parameters["bodies.camshaft.mass"] == pytest.approx(8800 * math.pi * 0.03**2 * 0.01, rel=1e-12)
    assert worn.parameters["bodies.camshaft.mass"] == pytest.approx(7850 * math.pi * 0.03**2 * 0.01, rel=1e-12)


@needs_compiler
def test_a_slider_has_play_as_it_describes_it(file: Path) -> None:
    """The piston begins off its axis as `start` says, comes to the wall, and is carried by it."""
    run = gudgeon.load(file, "slap").simulate(10e-3, output=10)
    assert run["piston.y"][0] == pytest.approx(0.05e-3, abs=1e-12)
    assert run["piston.theta"][0] == pytest.approx(1e-3, abs=1e-12)
    assert len(run.impacts) and abs(run["piston.y"]).max() < 0.13e-3 and "cylinder.front_upper.Fn" in run
    assert run["cylinder.Fy"] == pytest.approx(
        sum(run[f"cylinder.{end}_{wall}.Fy"] for end in ("front", "rear") for wall in ("upper", "lower")), abs=1e-12
    )


def test_a_mistake_looks_as_shown(call: Gudgeon, tmp_path: Path) -> None:
    text = patched(TEXT, *re.findall(r"^-(.*)\n\+(.*)$", blocks("diff")[0], re.MULTILINE))
    (tmp_path / NAME).write_text(text, encoding="utf-8")
    done = call(f"gudgeon check {NAME}")
    assert done.exit_code == 2
    assert done.stderr in blocks("text")
