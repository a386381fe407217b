"""The commands as a user types them: exit codes, what is told, what is written, what is imported."""

from __future__ import annotations

import io
import json
import math
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

import gudgeon
from gudgeon.cli import app
from gudgeon.simulation import Simulation

needs_compiler = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")

# A crank-slider whose wrist pin has play: small enough to be derived and compiled in seconds.
TEXT = """\
format: gudgeon/1
name: pump
title: A pump with a worn wrist pin
parameters: {omega: 20 rad/s, c: 0.2 mm}
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies:
  crank: {length: 30 mm, mass: 0.2 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.3 kg, inertia: 4e-4 kg*m^2}
  piston: {mass: 0.25 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0], C: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  A: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, piston.origin]}
  bore: {translational: [ground.C, piston.origin], axis: [1, 0]}
drives:
  motor: {angle: crank, value: 20 deg + omega * t}
start:
  guess: {piston.x: 0.14}
bearings:
  pin: {radius: 10 mm, clearance: c, length: 20 mm, bearing_material: steel, journal_material: steel}
contacts:
  dry:
    normal: {law: lankarani_nikravesh, restitution: 0.9, geometry: external}
    friction: {law: modified_coulomb, mu: 0.1, v0: 1e-4 m/s, v1: 1e-3 m/s}
scenes:
  worn: {play: {B: {bearing: pin, contact: dry}}, simulate: {t_end: 0.02 s, step: 2e-6 s, output: 100}}
"""
Gudgeon = Callable[..., Result]


@pytest.fixture
def pump(tmp_path: Path) -> str:
    path = tmp_path / "pump.yaml"
    path.write_text(TEXT)
    return str(path)


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gudgeon:
    """Runs `gudgeon …` in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: CliRunner().invoke(app, list(arguments))


def written(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()} - {"pump.yaml"}


@needs_compiler
def test_run_writes_a_file_a_scene_and_a_picture_and_shows_a_table(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("run", pump)
    assert done.exit_code == 0, done.output
    assert written(tmp_path) == {"out/pump_ideal.nc", "out/pump_worn.nc", "out/pump.png"}
    for text in ("A pump with a worn wrist pin", "Peak error against ideal", "piston.x", "piston.ax", "B K", "worn"):
        assert text in done.stdout
    run = gudgeon.Result.load(tmp_path / "out/pump_worn.nc")
    assert len(run.t) == 101 and run.t[-1] == 0.02


@needs_compiler
def test_json_holds_the_errors_against_the_ideal_scene(call: Gudgeon, pump: str) -> None:
    done = call("run", pump, "--scene", "worn", "--json", "--t-end", "10 ms", "--output", "50", "--set", "c=0.3mm")
    assert done.exit_code == 0, done.output
    found = json.loads(done.stdout)["scenes"]
    worn = gudgeon.load(pump, scene="worn").simulate(0.01, output=50, parameters={"c": 0.3e-3})
    ideal = gudgeon.load(pump).simulate(0.01, output=50)
    error = worn["piston.ax"] - ideal["piston.ax"]
    at = int(abs(error).argmax())
    assert found["worn"]["errors"]["piston.ax"]["peak"] == error[at]
    assert found["worn"]["errors"]["piston.ax"]["t"] == worn.t[at]
    assert found["worn"]["peak_forces"]["B"]["F"] == worn.diagnostics.peaks[0].F
    assert math.isclose(found["worn"]["constants"]["B.c"], 0.3e-3)
    assert found["worn"]["diagnostics"]["onsets"] == worn.diagnostics.onsets > 0


@needs_compiler
def test_the_reference_has_the_parameters_of_the_scene(call: Gudgeon, tmp_path: Path) -> None:
    """A scene that turns faster is compared with an ideal linkage that turns faster too."""
    fast = TEXT + (
        "  fast: {play: {B: {bearing: pin, contact: dry}}, parameters: {omega: 40 rad/s},\n"
        "         simulate: {t_end: 0.005 s, step: 2e-6 s, output: 20}}\n"
    )
    (tmp_path / "fast.yaml").write_text(fast)
    done = call("run", "fast.yaml", "--scene", "fast", "--json")
    assert done.exit_code == 0, done.output
    assert abs(json.loads(done.stdout)["scenes"]["fast"]["errors"]["piston.x"]["peak"]) < 3 * 0.2e-3


@needs_compiler
@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--scene", "wron"), "worn"),
        (("--set", "cc=1mm"), "cc"),
        (("--set", "bodies.rod.mas=1"), "bodies.rod.mass"),
        (("--set", "c"), "ADDRESS=VALUE"),
        (("--set", "c=11mm"), "clearance"),
        (("--set", "c=1 kg"), "c"),
        (("--set", "bodies.rod.mass=-1"), "mass"),
        (("--watch", "piston.xx"), "piston.x"),
        (("--t-end", "0"), "t_end"),
        (("--step", "-1us"), "step"),
        (("--method", "euler"), "rk4"),
        (("--output", "0"), "output"),
    ],
)
def test_bad_arguments_end_with_2_and_nothing_written(
    arguments: tuple[str, ...], told: str, call: Gudgeon, pump: str, tmp_path: Path
) -> None:
    done = call("run", pump, *arguments)
    assert done.exit_code == 2, done.output
    assert told in done.stderr
    assert "Traceback" not in done.stderr
    assert written(tmp_path) == set()


@needs_compiler
def test_an_interrupt_keeps_what_was_computed(
    call: Gudgeon, pump: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate = Simulation.simulate

    def interrupted(self: Simulation, *args: Any, **options: Any) -> Any:
        def progress(fraction: float, text: str) -> None:
            if fraction > 0.3:
                raise KeyboardInterrupt

        if self.source.scene == "worn":
            options |= {"progress": progress, "method": "rk4"}  # others are done before the first look
        return simulate(self, *args, **options)

    monkeypatch.setattr(Simulation, "simulate", interrupted)
    done = call("run", pump)
    assert done.exit_code == 130, done.output
    run = gudgeon.Result.load(tmp_path / "out/pump_worn.nc")
    assert run.diagnostics.interrupted
    assert 0.3 < run.t[-1] / 0.02 < 0.4


@needs_compiler
def test_a_scene_that_cannot_be_assembled_leaves_the_others(call: Gudgeon, tmp_path: Path) -> None:
    """A rod of 5 mm does not reach the bore's axis."""
    text = TEXT.replace("c: 0.2 mm", "c: 0.2 mm, l: 120 mm").replace("length: 120 mm", "length: l")
    (tmp_path / "short.yaml").write_text(text + "  short: {parameters: {l: 5 mm}}\n")
    done = call("run", "short.yaml", "--t-end", "1e-4")
    assert done.exit_code == 1 and "error: scene short" in done.stderr, done.output
    assert {"out/pump_worn.nc", "out/pump_ideal.nc"} <= written(tmp_path)


@needs_compiler
def test_figures_are_shown_even_if_they_cannot_be_written(
    call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: gudgeon.Result, path: Path) -> None:
        raise gudgeon.GudgeonError(f"cannot write {path}: No space left on device")

    monkeypatch.setattr(gudgeon.Result, "save", full)
    done = call("run", pump, "--t-end", "0.001")
    assert done.exit_code == 1 and "No space left" in done.stderr
    assert "Peak error against ideal" in done.stdout


def test_a_folder_that_is_a_file_is_told_before_anything_is_run(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("run", pump, "--out", "pump.yaml/out")
    assert done.exit_code == 2 and "pump.yaml is a file" in done.stderr
    assert written(tmp_path) == set()


@needs_compiler
def test_tables_are_not_cut_where_the_screen_is_narrow(call: Gudgeon, pump: str) -> None:
    from rich.console import Console

    from gudgeon.report import compare, tables

    runs = [gudgeon.load(pump, scene=scene).simulate(0.002, output=20, step=2e-6) for scene in ("ideal", "worn")]
    reports = [compare(run, runs[0] if run is runs[1] else None, ["piston.x"]) for run in runs] * 2
    shown = {}
    for width in (200, 70):
        console = Console(width=width, file=io.StringIO(), record=True)
        for table in tables("A pump", reports, width):
            console.print(table)
        shown[width] = console.export_text()
        assert max(map(len, shown[width].splitlines())) <= width
    for text in shown[200].replace("─", "").split():
        assert text in shown[70]


@needs_compiler
def test_a_run_that_fails_ends_with_1_and_keeps_what_it_had(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    """With a step of 1 ms the contact is far from resolved, and a stiff one throws the state out of range."""
    done = call("run", pump, "--step", "1 ms", "--t-end", "1 s", "--set", "materials.steel.E=1e18")
    if done.exit_code == 0:
        pytest.skip("it survived")
    assert done.exit_code == 1, done.output
    assert "error: scene worn" in done.stderr and "Traceback" not in done.stderr
    assert "out/pump_ideal.nc" in written(tmp_path)


WARM = """
import json, sys
from gudgeon.simulation import Simulation
simulate, seen = Simulation.simulate, []
def watched(self, *args, **options):
    seen.append(sorted({name.partition(".")[0] for name in sys.modules}))
    return simulate(self, *args, **options)
Simulation.simulate = watched
from gudgeon.cli import app
sys.argv = ["gudgeon", "run", sys.argv[1], "--t-end", "0.001"]
try:
    app()
except SystemExit as end:
    assert not end.code, end.code
generator = [name for name in sys.modules if name.startswith("gudgeon.generator")]
print(json.dumps([seen[0], sorted({name.partition(".")[0] for name in sys.modules}), generator]))
"""


@needs_compiler
def test_a_warm_run_imports_little_before_it_integrates_and_the_generator_never(call: Gudgeon, pump: str) -> None:
    assert call("run", pump, "--t-end", "0.001").exit_code == 0  # now it is warm
    done = subprocess.run([sys.executable, "-c", WARM, pump], capture_output=True, text=True, check=True)
    before, after, generator = json.loads(done.stdout.splitlines()[-1])
    assert not {"sympy", "jinja2", "pydantic", "ruamel", "pint", "mpmath"} & set(after)
    assert not {"xarray", "pandas", "matplotlib", "h5py", "rich", "scipy", "cffi"} & set(before)
    assert generator == []


@needs_compiler
def test_check_counts_and_verbose_tells_of_each_scene(call: Gudgeon, pump: str) -> None:
    done = call("check", pump)
    assert (done.exit_code, done.stdout) == (0, "valid: 3 bodies, 4 joints, 1 drive; scenes ideal, worn\n")
    found = json.loads(call("check", pump, "-v", "--json").stdout)["scenes"]
    assert (found["ideal"]["unknowns"], found["ideal"]["rows"], found["ideal"]["degrees of freedom"]) == (9, 9, 0)
    assert (found["worn"]["rows"], found["worn"]["degrees of freedom"]) == (7, 2)
    # O: x, θ and y, θ; A: x, θ, x, θ and y, θ, y, θ; B: x, θ, x and y, θ, y (the piston's pin is its origin);
    # bore: y of the piston and its angle; motor: one angle
    assert (found["ideal"]["non-zeros of Φ_q"], found["worn"]["non-zeros of Φ_q"]) == (4 + 8 + 6 + 2 + 1, 4 + 8 + 2 + 1)
    shown = call("check", pump, "-v").stdout
    assert "degrees of freedom" in shown and "operations" in shown


@needs_compiler
def test_check_tells_the_story_of_the_reduction(call: Gudgeon) -> None:
    """The press turns round two driven cranks: five angles and one row of the guide are left of 24 and 20."""
    document = call("check", "nine_bar_press", "-v", "--json").stdout
    found = json.loads(document)["scenes"]
    dry, film, ideal = found["dry"], found["lubricated"], found["ideal"]
    assert dry["formulation"] == "reduced" and sorted(dry["tree"]) == ["L2", "L3", "L6", "L7", "L8"]
    assert (dry["closures"], dry["driven"]) == (["guide.offset"], ["crank1", "crank4"])
    operations = dry["operations of the accelerations"]
    assert operations == {"full": dry["operations in dynamics"], "reduced": dry["operations in reduced_dynamics"]}
    assert dry["methods"] == film["methods"] == ["rk4", "dop853", "rodas5p", "scipy:*", "sundials:*"]
    assert [scene["auto begins with"] for scene in (ideal, dry, film)] == ["kinematic", "dop853", "rodas5p"]
    shown = call("check", "nine_bar_press", "-v").stdout
    assert max(map(len, shown.splitlines())) <= 100
    ideal_told, dry_told = " ".join(shown.split()).split("scene dry ")
    assert "24 24 every body by x, y and its angle; every joint closed 22 22 crank1, crank4 prescribe" in ideal_told
    assert "without masses, 2 of 2×2, 1 of 1×1 one after the other: L3 + L2, L7 + L6, L8" in ideal_told
    assert "24 20 A, B have play" in dry_told and "closures guide.offset: the row that stays" in dry_told
    assert "44 × 44 with 132 non-zeros" in dry_told and "→ 6 × 6 with 21" in dry_told
    assert f"accelerations {operations['full']:,} → {operations['reduced']:,}, 4.4 times fewer" in dry_told
    assert "scene lubricated: as dry, but" in dry_told
    assert dry["story"]["steps"][-1]["coordinates left"] == 5 and dry["story"]["steps"][-1]["rows left"] == 1


@needs_compiler
def test_check_begins_a_new_table_where_a_line_is_full(call: Gudgeon, tmp_path: Path) -> None:
    """Twelve scenes do not fit beside each other; none is cut off."""
    scenes = [f"scene_number_{k}" for k in range(12)]
    listed = "".join(f"  {name}: {{parameters: {{omega: {k + 1} rad/s}}}}\n" for k, name in enumerate(scenes))
    head, _, tail = TEXT.partition("scenes:\n")
    (tmp_path / "many.yaml").write_text(f"{head}scenes:\n{listed}{tail}")
    shown = call("check", "many.yaml", "-v").stdout
    assert max(map(len, shown.splitlines())) <= 100
    heads = [line.split() for line in shown.splitlines()[1:] if line.startswith("   ") and "scene_" in line]
    heads = [line for line in heads if set(line) <= {"ideal", *scenes, "worn"}]
    assert sum(heads, []) == ["ideal", *scenes, "worn"] and len(heads) > 1


def test_check_tells_the_place_of_every_mistake(call: Gudgeon, pump: str) -> None:
    broken = TEXT.replace("mass: 0.25 kg", "mass: -0.25 kg").replace("omega * t", "omegaa * t")
    Path(pump).write_text(broken)
    done = call("check", pump)
    assert done.exit_code == 2
    for text in ("mass: -0.25", "omegaa"):
        line = next(k for k, line in enumerate(broken.splitlines(), 1) if text in line)
        assert f"pump.yaml:{line}:" in done.stderr
    found = json.loads(call("check", pump, "--json").stdout)
    assert found["valid"] is False and len(found["errors"]) == 2
    assert all(error["line"] and error["column"] for error in found["errors"])


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_file_that_is_not_there(command: str, call: Gudgeon) -> None:
    for name in ("no/such.yaml", "nine_bar_pres"):
        done = call(command, name)
        assert done.exit_code == 2 and done.stderr.startswith("error: ")
    assert "nine_bar_press" in done.stderr
    assert "comes with gudgeon is called nine_bar_press" in call(command, "nine_bar_press.yaml").stderr


@needs_compiler
def test_emit_writes_c_again_and_again_but_never_over_other_files(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    assert call("emit", pump, "-o", "c", "--scene", "worn").exit_code == 0
    first = {path.name: path.read_bytes() for path in (tmp_path / "c/worn").iterdir()}
    assert any(name.endswith(".c") for name in first)
    assert call("emit", pump, "-o", "c").exit_code == 0
    assert {path.name: path.read_bytes() for path in (tmp_path / "c/worn").iterdir()} == first
    (tmp_path / "c/worn/notes.txt").write_text("mine")
    done = call("emit", pump, "-o", "c")
    assert done.exit_code == 2 and "notes.txt" in done.stderr
    (tmp_path / "c/worn/notes.txt").unlink()
    (tmp_path / "c/worn/scene.c").write_text("/* changed by hand */\n")
    done = call("emit", pump, "-o", "c")
    assert done.exit_code == 2 and "scene.c" in done.stderr
    (tmp_path / "d/ideal").mkdir(parents=True)
    (tmp_path / "d/ideal/scene.c").write_text("int main(void) { return 0; }\n")
    done = call("emit", pump, "-o", "d")
    assert done.exit_code == 2 and "scene.c" in done.stderr
    assert written(tmp_path / "d") == {"ideal/scene.c"}


def test_equations_wants_a_known_suffix(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("equations", pump, "-o", "x.pdf")
    assert done.exit_code == 2 and ".tex" in done.stderr
    assert written(tmp_path) == set()


def test_version_and_help(call: Gudgeon) -> None:
    assert call("--version").stdout == f"gudgeon {gudgeon.__version__}\n"
    for command in ("run", "check", "emit", "equations", "bench", "stress"):
        assert "Example: gudgeon" in call(command, "--help").stdout


def test_schema_is_json_schema(call: Gudgeon) -> None:
    done = call("schema")
    assert done.exit_code == 0
    document = json.loads(done.stdout)
    assert document["$schema"].endswith("2020-12/schema")
    assert {"bodies", "joints", "forces", "scenes"} <= set(document["properties"])
