"""`gudgeon bench` and `gudgeon map` as a user types them: what is refused, and what is told of what is left out."""

from __future__ import annotations

import csv
import errno
import os
import shlex
import sys
from pathlib import Path

import pytest

import gudgeon
from gudgeon.contract.methods import STAGED
from gudgeon.errors import BadValueError
from gudgeon.integrators.peers import driver as python_driver
from gudgeon.studies.axes import make_axis
from gudgeon.studies.bench import measure_scene
from gudgeon.studies.map import compute_verdict_map
from gudgeon.studies.methods import ADAPTIVE, select_methods
from gudgeon.studies.show.bench import describe_bench
from tests.programs import needs_compiler
from tests.pump import Gudgeon, written

pytestmark = needs_compiler
PENDULUM = str(Path(__file__).parents[1] / "mechanisms" / "valid" / "double_pendulum.yaml")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--range", "c=1mm..2mm"), "--range needs --box"),
        (("--box", "2"), "give its edges"),
        (("--box", "2", "--range", "c=1mm"), "expected NAME=LOW..HIGH"),
        (("--box", "2", "--range", "c=1mm..2mm:4"), "expected NAME=LOW..HIGH"),
        (("--box", "2", "--range", "rtol=1e-8..1e-6"), "--at gives it"),
        (("--box", "2", "--axis", "c=1mm..2mm"), "--range"),
        (("--box", "2", "--range", "c=1mm..2mm", "--mark-step", "1us"), "no row is a step"),
        (("--axis", "rtol=1e-8,1e-6", "--at", "1e-7"), "rtol is an axis"),
        (("--at", "1e-7"), "rtol is an axis"),
        (("--method", "rk4", "--at", "1us"), "step is an axis"),
        (("--axis", "c=.1mm,.2mm", "--axis", "omega=10,20", "--at", "1e-16"), "1e-14"),
        (("--mark-step", "1us"), "--method rk4"),
        (("--axis", "gains=1,10"), "projects and has no gains"),
        (("--axis", "omegaa=1,10"), "nearest: omega"),
        (("--axis", "foo=1,10"), "there are: step, rtol, clearance"),
        (("--method", "scipy:Radau"), "rodas5p"),
        (("--axis", "c=1mm,2mm", "--axis", "parameters.c=3mm,4mm"), "varied already, by --axis c=1mm,2mm"),
        (("--box", "0", "--range", "c=1mm..2mm", "--range", "c=3mm..4mm"), "varied already"),
    ],
)
def test_options_that_say_nothing_are_refused(
    arguments: tuple[str, ...], message: str, call: Gudgeon, pump: str, tmp_path: Path
) -> None:
    done = call("map", pump, *arguments)
    assert done.exit_code == 2, done.output
    assert message in done.stderr and "load(" not in done.stderr
    assert written(tmp_path) == set()


def test_what_a_map_prints_runs_as_it_stands(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    """For a file of one's own, whatever it is called, with its settings; as a shell reads the line."""
    (tmp_path / "my dir").mkdir()
    Path(pump).rename(tmp_path / "my dir/the pump's.yaml")
    how = ("--box", "0", "--range", "c=.2mm..0.25mm", "--at", "1e-3", "--set", "omega=18 rad/s", "--t-end", "2ms")
    done = call("map", "my dir/the pump's.yaml", "--quick", *how)
    assert done.exit_code == 0, done.output
    lines = [line for line in done.stdout.splitlines() if line.strip().startswith("gudgeon run ")]
    assert lines
    words = shlex.split(lines[-1])
    assert words[2] == "my dir/the pump's.yaml" and "omega=18 rad/s" in words
    again = call(*words[1:])
    assert again.exit_code == 0 and "pump_worn.nc" in again.stdout, again.output
    assert gudgeon.Result.load(tmp_path / "out/pump_worn.nc").t[-1] == 2e-3


@pytest.mark.parametrize("command", ["bench", "map"])
def test_what_was_measured_is_shown_though_the_disk_is_full(
    command: str, call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    call("check", pump, "-v")  # into the cache, for which there is room
    gudgeon.load(pump, "worn")
    methods = ("--methods", "rk4") if command == "bench" else ("--axis", "rtol=1e-3,1e-4", "--axis", "c=.2mm,.25mm")
    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        done = call(command, pump, "--scene", "worn", "--quick", "--t-end", "1ms", *methods)
    assert done.exit_code == 1 and "No space left" in done.stderr, done.output
    assert "worn" in done.stdout and "stable" in done.stdout + "stable" * (command == "bench")
    assert written(tmp_path) == set()


@pytest.mark.parametrize("command", ["bench", "map"])
def test_where_nothing_can_be_written_nothing_is_run(
    command: str, call: Gudgeon, pump: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ran(*_: object, **__: object) -> None:
        raise AssertionError("it was run")

    monkeypatch.setattr(gudgeon.Simulation, "simulate", ran)
    for place in (("--out", "pump.yaml"), ("--csv", "pump.yaml/x.csv")):
        done = call(command, pump, *place)
        assert done.exit_code == 2 and "pump.yaml is a file" in done.stderr
    Path("x.csv").mkdir()
    done = call(command, pump, "--csv", "x.csv")
    assert done.exit_code == 2 and "is a folder" in done.stderr


def test_gains_act_in_the_full_formulation() -> None:
    """With a long step the constraints drift, and stronger terms pull back more of it."""
    dry = gudgeon.load("nine_bar_press", scene="dry")
    axes = [make_axis(dry, "gains", [0.1, 100.0]), make_axis(dry, "step", [2e-5])]
    found = compute_verdict_map(dry, axes, method="rk4", t_long=5e-3, t_short=2e-3)
    weak, strong = (found.get_cell(2e-5, gain) for gain in (0.1, 100.0))
    assert found.full and weak.energy != strong.energy
    assert not compute_verdict_map(dry, axes[1:], method="rk4", t_long=5e-3, t_short=2e-3, quick=True).full
    with pytest.raises(BadValueError, match="dop853"):
        compute_verdict_map(dry, axes[:1], method="dop853")


def test_marked_step_is_a_row(call: Gudgeon, pump: str, tmp_path: Path) -> None:
    done = call("map", pump, "--method", "rk4", "--quick", "--mark-step", "3us", "--t-end", "2ms")
    assert done.exit_code == 0, done.output
    with open(tmp_path / "out/pump_map.csv", encoding="utf-8") as file:
        assert 3e-6 in {float(row["step_or_tolerance"]) for row in csv.DictReader(file)}
    assert "step 3 µs" in done.stdout
    done = call("bench", PENDULUM, "--scene", "ideal", "--quick", "--methods", "rk4", "--mark-step", "3ms")
    assert done.exit_code == 0 and "rk4 at 3 ms" in done.stdout and "not tested" not in done.stdout, done.output


def test_bench_takes_what_fits_a_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    dry = gudgeon.load("nine_bar_press", scene="dry")
    usual = [method for method in ADAPTIVE if method not in STAGED]
    assert select_methods(dry, None, quick=True) == (["rk4", *usual], [])
    assert select_methods(dry, ["radau*"], quick=True) == ([*STAGED], [])  # derived for it where somebody asks
    assert select_methods(gudgeon.load("nine_bar_press", "lubricated"), None, quick=True) == (["rk4", *ADAPTIVE], [])
    assert select_methods(dry, ["scipy:*", "auto"], quick=True)[0] == ["auto", *python_driver.SCIPY]
    monkeypatch.setitem(sys.modules, "sksundae", None)
    monkeypatch.setattr("gudgeon.studies.methods.find_spec", lambda name: None)
    found, left_out = select_methods(dry, None, quick=False)
    assert found == ["rk4", *usual, *python_driver.SCIPY]
    assert len(left_out) == 1 and "not installed" in left_out[0]
    found, left_out = select_methods(gudgeon.load("belt_block"), None, quick=False)
    assert found == ["rk4", *usual] and all("dry_friction" in line for line in left_out)
    with pytest.raises(BadValueError, match="euler"):
        select_methods(dry, ["euler"], quick=False)
    with pytest.raises(BadValueError, match="none of the methods"):
        select_methods(dry, ["sundials:*"], quick=False)


def test_cross_checks_are_compared_with_another_method() -> None:
    pendulum = gudgeon.load(PENDULUM, scene="ideal")
    expected = ["scipy:DOP853", "scipy:RK45"]
    found = measure_scene(pendulum, [1e-3], [1e-5, 1e-6, 1e-7], t_end=0.5, quick=True, methods=expected)
    assert found.methods == tuple(expected) and [len(found.list_rows(name)) for name in expected] == [2, 2]
    first, second = (found.list_rows(name)[0] for name in expected)
    assert first.reference is not None and first.reference.method == "rodas5p"  # not by the same formulas
    assert second.reference is not None and second.reference.method == "dop853"
    for name in expected:
        assert found.list_rows(name)[1].error.motion < found.list_rows(name)[0].error.motion / 5 < 1e-5


def test_a_slow_cross_check_is_run_at_fewer_tolerances(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every run counts as long: the loosest tolerance alone; with no time at all not even that. Both are told."""
    pendulum = gudgeon.load(PENDULUM, scene="ideal")
    options = {"t_end": 0.05, "quick": True, "methods": ["rk4", "scipy:RK45"]}
    monkeypatch.setattr("gudgeon.studies.bench.MAX_CROSS_CHECK_S", 0.0)
    found = measure_scene(pendulum, [1e-3], [1e-4, 1e-5, 1e-6], **options)  # type: ignore[arg-type]
    assert [row.setting.value for row in found.list_rows("scipy:RK45")] == [1e-4] and len(found.list_rows("rk4")) == 1
    assert any(line.startswith("scipy:RK45: 1e-6 and tighter left out") for line in describe_bench(found, None))
    monkeypatch.setattr("gudgeon.studies.bench.CROSS_CHECK_LIMIT_S", 0.0)
    found = measure_scene(pendulum, [1e-3], [1e-4, 1e-5, 1e-6], **options)  # type: ignore[arg-type]
    assert not found.list_rows("scipy:RK45") and any("1e-4 and tighter left out" in line for line in found.left_out)
    assert not found.interrupted
