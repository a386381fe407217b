"""`gudgeon run` as a user types it: exit codes, what is told, what is written, what is imported."""

from __future__ import annotations

import io
import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.errors import AssemblyError
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.pump import TEXT, Gudgeon, written

# The pump with a rod whose length has a name, and scenes of other numbers.
MORE = (
    TEXT.replace("c: 0.2 mm", "c: 0.2 mm, l: 120 mm").replace("length: 120 mm", "length: l")
    + """\
  fast:
    play: {B: {bearing: pin, contact: dry}}
    parameters: {omega: 40 rad/s}
    peaks: [piston.ax, B.F]
    simulate: {t_end: 0.005 s, step: 2e-6 s, output: 20}
  short: {parameters: {l: 5 mm}}
"""
)


@needs_compiler
def test_run_writes_a_file_a_scene_and_a_picture_and_shows_a_table(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("run", pump)
    assert done.exit_code == 0, done.output
    assert written(tmp_path) == {"out/pump_ideal.nc", "out/pump_worn.nc", "out/pump.png"}
    for text in ("A pump with a worn wrist pin", "Peak error against ideal", "piston.ax", "B clearance c", "worn"):
        assert text in done.stdout
    run = gudgeon.Result.load(tmp_path / "out/pump_worn.nc")
    assert len(run.t) == 101 and run.t[-1] == 0.02


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
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
@pytest.mark.usefixtures("no_pictures")
def test_peaks_of_a_scene_and_their_errors_are_of_all_steps(call: Gudgeon, tmp_path: Path) -> None:
    """In the table, in JSON and in the file, whatever the output."""
    (tmp_path / "more.yaml").write_text(MORE)
    options = ("run", "more.yaml", "--scene", "fast", "--t-end", "5 ms", "--output", "3")
    done, as_json = call(*options), call(*options, "--json")
    assert done.exit_code == as_json.exit_code == 0, done.output
    for text in ("Peak error against ideal, all steps", "Peaks, all steps", "piston.ax max", "piston.ax min"):
        assert text in done.stdout
    fast, ideal = (gudgeon.load("more.yaml", scene) for scene in ("fast", "ideal"))
    run = fast.simulate(0.005, output=3, against=ideal)
    found = json.loads(as_json.stdout)["scenes"]["fast"]
    assert found["peaks"]["piston.ax"]["min"] == run.peak("piston.ax").min
    assert found["peak_errors"]["piston.ax"]["t_max"] == run.peak_error("piston.ax").t_max
    assert gudgeon.Result.load(tmp_path / "out/pump_fast.nc").peak("B.F") == run.peak("B.F")


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_the_reference_has_the_parameters_of_the_scene(call: Gudgeon, tmp_path: Path) -> None:
    """A scene that turns faster is compared with an ideal linkage that turns faster too."""
    (tmp_path / "more.yaml").write_text(MORE)
    done = call("run", "more.yaml", "--scene", "fast", "--json")
    assert done.exit_code == 0, done.output
    assert abs(json.loads(done.stdout)["scenes"]["fast"]["errors"]["piston.x"]["peak"]) < 3 * 0.2e-3


@needs_compiler
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--scene", "wron"), "worn"),
        (("--set", "cc=1mm"), "cc"),
        (("--set", "bodies.rod.mas=1"), "bodies.rod.mass"),
        (("--set", "c"), "ADDRESS=VALUE"),
        (("--set", "c=11mm"), "clearance"),
        (("--set", "c=1 kg"), "c"),
        (("--set", "bodies.rod.mass=-1"), "mass"),
        (("--watch", "piston.xx"), "piston.x"),
        (("--peaks", "piston.xx"), "--peaks: no scene has a series 'piston.xx'"),
        (("--t-end", "0"), "t_end"),
        (("--step", "-1us"), "step"),
        (("--method", "euler"), "rk4"),
        (("--scene", "worn", "--method", "kinematic"), "use auto"),
        (("--method", "rk4", "--rtol", "1e-6"), "no tolerance"),
        (("--step", "1us", "--rtol", "1e-6"), "leave out rtol"),
        (("--rtol", "1e-16"), "from 1e-14 to less than 1"),
        (("--set", "contacts.dry.normal.restitution=1.5"), "expected > 0 and <= 1"),
        (("--formulation", "tree"), "reduced, full"),
        (("--output", "0"), "output"),
    ],
)
def test_bad_arguments_end_with_2_and_nothing_written(
    arguments: tuple[str, ...], message: str, call: Gudgeon, pump: str, tmp_path: Path
) -> None:
    done = call("run", pump, *arguments)
    assert done.exit_code == 2, done.output
    assert message in done.stderr
    assert "Traceback" not in done.stderr and "adaptive" not in done.stderr
    assert written(tmp_path) == set()


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_the_full_formulation_is_what_is_integrated(call: Gudgeon, pump: str) -> None:
    """Baumgarte's gains act there and nowhere else."""

    def run(*arguments: str) -> Any:
        done = call("run", pump, "--scene", "worn", "--method", "rk4", "--t-end", "2ms", "--json", *arguments)
        assert done.exit_code == 0, done.output
        return json.loads(done.stdout)["scenes"]["worn"]["diagnostics"]["phi_dot_max"]

    gains = ("--set", "baumgarte.alpha=1", "--set", "baumgarte.beta=1")
    assert run() == run(*gains)
    assert run("--formulation", "full") != run("--formulation", "full", *gains)


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
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
    monkeypatch.setattr("gudgeon.waiting.cancellation.POLL_INTERVAL_S", 0.0)  # C asks at every right-hand side
    done = call("run", pump)
    assert done.exit_code == 130, done.output
    run = gudgeon.Result.load(tmp_path / "out/pump_worn.nc")
    assert run.diagnostics.interrupted
    assert 0.3 < run.t[-1] / 0.02 < 0.4


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_a_scene_that_cannot_be_assembled_leaves_the_others(call: Gudgeon, tmp_path: Path) -> None:
    """A rod of 5 mm does not reach the bore's axis."""
    (tmp_path / "more.yaml").write_text(MORE)
    done = call("run", "more.yaml", "--scene", "ideal", "--scene", "fast", "--scene", "short", "--t-end", "1e-4")
    assert done.exit_code == 1 and "error: scene short" in done.stderr, done.output
    assert {"out/pump_fast.nc", "out/pump_ideal.nc"} <= written(tmp_path)


@needs_compiler
def test_figures_are_shown_even_if_they_cannot_be_written(
    call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: gudgeon.Result, path: Path, attributes: object) -> None:
        raise gudgeon.GudgeonError(f"cannot write {path}: No space left on device")

    monkeypatch.setattr(gudgeon.Result, "save", full)
    done = call("run", pump, "--t-end", "0.001")
    assert done.exit_code == 1 and "No space left" in done.stderr
    assert "Peak error against ideal" in done.stdout
    assert "pump_worn.nc" in done.stderr and "pump_ideal.nc" in done.stderr, "each is tried, each is told"
    assert written(Path("out")) == {"pump.png"}


def test_a_folder_that_is_a_file_is_told_before_anything_is_run(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("run", pump, "--out", "pump.yaml/out")
    assert done.exit_code == 2 and "pump.yaml is a file" in done.stderr
    assert written(tmp_path) == set()


@needs_compiler
def test_tables_are_not_cut_where_the_screen_is_narrow(call: Gudgeon, pump: str) -> None:
    from rich.console import Console

    from gudgeon.results.reports.comparison import build_tables, compute_scene_report

    runs = [gudgeon.load(pump, scene=scene).simulate(0.002, output=20, step=2e-6) for scene in ("ideal", "worn")]
    reports = [compute_scene_report(run, runs[0] if run is runs[1] else None, ["piston.x"]) for run in runs] * 2
    shown = {}
    for width in (200, 70):
        console = Console(width=width, file=io.StringIO(), record=True)
        for table in build_tables("A pump", reports, width):
            console.print(table)
        shown[width] = console.export_text()
        assert max(map(len, shown[width].splitlines())) <= width
    for text in shown[200].replace("─", "").split():
        assert text in shown[70]
    assert "no constraints" in shown[200]
    assert runs[1].diagnostics.phi_max == 0.0 and not runs[1].source.closures


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
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
from gudgeon.simulation.simulation import Simulation
simulate, seen = Simulation.simulate, []
def watched(self, *args, **options):
    seen.append(sorted({name.partition(".")[0] for name in sys.modules}))
    seen.append([name for name in sys.modules if name.startswith("gudgeon.generator")])
    return simulate(self, *args, **options)
Simulation.simulate = watched
from gudgeon.cli import app
sys.argv = ["gudgeon", "run", sys.argv[1], "--t-end", "0.001"]
try:
    app()
except SystemExit as end:
    assert not end.code, end.code
generator = [name for name in sys.modules if name.startswith("gudgeon.generator")]
print(json.dumps([*seen[:2], sorted({name.partition(".")[0] for name in sys.modules}), generator]))
"""


@needs_compiler
def test_a_warm_run_imports_little_before_it_integrates_and_derives_nothing(call: Gudgeon, pump: str) -> None:
    """Of the generator the picture reads what joints and forces declare of their drawing, after the run."""
    assert call("run", pump, "--t-end", "0.001").exit_code == 0  # now it is warm
    done = subprocess.run([sys.executable, "-c", WARM, pump], capture_output=True, text=True, check=True)
    before, generator_before, after, generator = json.loads(done.stdout.splitlines()[-1])
    assert not {"sympy", "jinja2", "pydantic", "ruamel", "pint", "mpmath"} & set(after)
    assert not {"xarray", "pandas", "matplotlib", "h5py", "rich", "scipy", "cffi"} & set(before)
    declared = ("gudgeon.generator.kinds", "gudgeon.generator.field", "gudgeon.generator.dimension")
    assert generator_before == []
    assert [name for name in generator if name != "gudgeon.generator" and not name.startswith(declared)] == []


def test_a_rate_that_a_joint_with_play_forbids_at_the_start_is_told(tmp_path: Path) -> None:
    """It was called a dead centre against rows that the scene does not have."""
    file = tmp_path / "pump.yaml"
    file.write_text(TEXT.replace("piston.x: 0.14}", "piston.x: 0.14}\n  rates: {piston.vx: 3 m/s}"), encoding="utf-8")
    with pytest.raises(AssemblyError, match=r"start\.rates piston\.vx cannot be met: a start closes .* play \(.*B"):
        gudgeon.load(file, "worn").start()


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_the_table_has_the_drives_and_no_rows_that_need_a_legend(call: Gudgeon, pump: str) -> None:
    plain, verbose = call("run", pump), call("run", pump, "-v")
    assert plain.exit_code == verbose.exit_code == 0, verbose.output
    assert "during contact" not in plain.stdout and "during contact" in verbose.stdout
    assert "Peak of drives" in plain.stdout and "motor.torque" in plain.stdout
    found = json.loads(call("run", pump, "--json").stdout)["scenes"]["worn"]["drives"]["motor.torque"]
    torque = gudgeon.Result.load("out/pump_worn.nc")["motor.torque"]
    assert abs(found["peak"]) == abs(torque).max() and found["unit"] == "N*m"


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_peaks_of_series_that_are_asked_for(call: Gudgeon, pump: str) -> None:
    """Of scenes that have them, over all steps, beside the file's own; angles in degrees, in JSON SI."""
    joint = gudgeon.load(pump, "worn").source.clearances[0].name
    requested = ("--t-end", "5ms", "--peaks", "crank.theta", "--peaks", f"{joint}.e")
    done = call("run", pump, *requested)
    assert done.exit_code == 0, done.output
    found = json.loads(call("run", pump, *requested, "--json").stdout)["scenes"]
    largest = found["worn"]["peaks"]["crank.theta"]["max"]
    row = next(line for line in done.stdout.splitlines() if line.split()[:2] == ["crank.theta", "max"])
    assert row.count(f"{math.degrees(largest):.4g} °") == 2
    assert f"{joint}.e" in found["worn"]["peaks"] and [*found["ideal"]["peaks"]] == ["crank.theta"]


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_noise_is_shown_as_none(call: Gudgeon, pump: str) -> None:
    """The bore holds the piston at y = 0 but for rounding; JSON has the number as it is."""
    text = Path(pump).read_text(encoding="utf-8")
    Path(pump).write_text(
        text.replace("axis: [1, 0]}", "axis: [1, 0.75]}").replace("piston.x: 0.14", "piston.x: 0.11"), encoding="utf-8"
    )
    watched = ("--watch", "tilted", "--t-end", "5ms")
    with Path(pump).open("a", encoding="utf-8") as file:
        file.write("outputs: {tilted: 0.6 * piston.x - 0.8 * piston.y}\n")
    done = call("run", pump, *watched)
    assert done.exit_code == 0, done.output
    row = next(line for line in done.stdout.splitlines() if line.split()[:1] == ["tilted"])
    assert "≈ 0" in row and "e-" not in row
    found = json.loads(call("run", pump, *watched, "--json").stdout)["scenes"]["worn"]["motion"]["tilted"]
    assert 0.0 < abs(found["peak"]) < 1e-12


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
def test_results_of_another_file_of_the_name_are_not_written_over(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    """Edited or moved it is the same mechanism; with other bytes in another place it is another."""
    assert call("run", pump, "--scene", "ideal").exit_code == 0
    text, before = Path(pump).read_text(encoding="utf-8"), (tmp_path / "out/pump_ideal.nc").read_bytes()
    other = tmp_path / "other.yaml"
    other.write_text(text.replace("30 mm", "31 mm"), encoding="utf-8")
    done = call("run", str(other), "--scene", "ideal")
    assert done.exit_code == 2 and "another mechanism file" in done.stderr and "--out" in done.stderr
    assert (tmp_path / "out/pump_ideal.nc").read_bytes() == before
    assert call("run", str(other), "--scene", "ideal", "--out", "more").exit_code == 0
    other.write_text(text, encoding="utf-8")
    assert call("run", str(other), "--scene", "ideal").exit_code == 0  # moved
    other.write_text(text.replace("30 mm", "31 mm"), encoding="utf-8")
    assert call("run", str(other), "--scene", "ideal").exit_code == 0  # edited
