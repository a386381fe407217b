"""A scene as an FMU, in the hands of FMPy: valid, and the same motion as the native run."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.contract.boundary import VR_OUTPUTS as OUTPUTS
from gudgeon.contract.boundary import VR_PARAMETERS as PARAMETERS
from gudgeon.errors import BadValueError, InputError
from gudgeon.exchange.fmu import build_fmu
from gudgeon.exchange.fmu_description import iterate_outputs
from gudgeon.loading import compiler
from tests.programs import needs_compiler

fmpy = pytest.importorskip("fmpy")
pytestmark = [needs_compiler, pytest.mark.plain]
RTOL = 1e-10
# Largest differences of a kind, over the largest of that kind in the run.
KINDS = {
    "m": 1e-9,
    "rad": 1e-9,
    "m/s": 1e-9,
    "rad/s": 1e-9,
    "m/s^2": 1e-7,
    "rad/s^2": 1e-7,
    "N": 1e-7,
    "N*m": 1e-7,
    "J": 1e-8,
    "": 1e-8,
}
STOPPING = """
format: gudgeon/1
name: falling
gravity: [0, -10 m/s^2]
parameters: {low: 1.25 m}
bodies: {weight: {mass: 2 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, weight.origin], axis: [0, 1]}}
events: {down: {zero: weight.y + low, direction: falling, action: stop}}
"""


@cache
def scene(name: str, which: str) -> gudgeon.Simulation:
    return gudgeon.load(name, scene=which)


@cache
def archive(simulation: gudgeon.Simulation) -> bytes:
    """Compiled once: `scene` gives the same simulation each time."""
    return build_fmu(simulation)


def written(simulation: gudgeon.Simulation, folder: Path) -> str:
    (folder / "scene.fmu").write_bytes(archive(simulation))
    return str(folder / "scene.fmu")


@contextmanager
def instance(fmu: str, t_end: float = 1.0, tolerance: float | None = None, **numbers: float) -> Iterator[Any]:
    """One, past its initialization; FMPy prints what it says of errors."""
    description, unpacked = fmpy.read_model_description(fmu), fmpy.extract(fmu)
    place = {variable.name: variable.valueReference for variable in description.modelVariables}
    slave = fmpy.fmi3.FMU3Slave(
        guid=description.guid,
        unzipDirectory=unpacked,
        instanceName="one",
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate()
    if "relative_tolerance" in numbers:
        slave.setFloat64([place["relative_tolerance"]], [numbers.pop("relative_tolerance")])
    slave.enterInitializationMode(startTime=0.0, stopTime=t_end, tolerance=tolerance)
    for name, value in numbers.items():
        slave.setFloat64([place[name]], [value])
    slave.exitInitializationMode()
    slave.place = place
    yield slave
    slave.terminate()
    slave.freeInstance()


LARGE = (("nine_bar_press", "dry"), ("andrews_squeezer", "ideal"))
CASES: tuple[tuple[str, str, float, dict[str, float]], ...] = (
    ("nine_bar_press", "lubricated", 0.1, {"parameters.c": 5e-4}),
    ("four_bar", "ideal", 0.5, {}),
    ("four_bar", "ideal", 0.5, {"parameters.omega": 9.0}),
    ("pendulum", "ideal", 1.0, {"parameters.g": 3.7}),
    ("nine_bar_press", "dry", 0.004, {}),
    ("shaker", "ideal", 0.3, {}),
    ("andrews_squeezer", "ideal", 0.03, {}),
    ("belt_block", "ideal", 0.5, {}),  # friction, whose mode is known from the start on
)


@pytest.mark.parametrize(
    ("name", "which", "t_end", "numbers"),
    [case if case[:2] not in LARGE else pytest.param(*case, marks=pytest.mark.slow) for case in CASES],
)
def test_it_is_valid_and_moves_as_the_native_run(
    name: str, which: str, t_end: float, numbers: dict[str, float], tmp_path: Path
) -> None:
    """All outputs at fifty communication points, with numbers of the run that differ from the file's."""
    from fmpy.validation import validate_fmu

    simulation = scene(name, which)
    numbers = {k: v for k, v in numbers.items() if k in simulation.source.parameter_indices}
    fmu = written(simulation, tmp_path)
    assert validate_fmu(fmu) == []
    names = [one for one, *_ in iterate_outputs(simulation.source)]
    found = fmpy.simulate_fmu(
        fmu,
        stop_time=t_end,
        step_size=t_end / 50,
        output_interval=t_end / 50,
        relative_tolerance=RTOL,
        start_values=numbers,
        output=names,
        fmi_type="CoSimulation",
    )
    run = simulation.simulate(output=found["time"], rtol=RTOL, parameters=numbers)
    units = {one: unit for one, unit, *_ in iterate_outputs(simulation.source)}
    largest: dict[str, float] = {}
    for one in names:
        largest[units[one]] = max(largest.get(units[one], 0.0), np.nanmax(np.abs(run[one]), initial=0.0))
    compared = 0
    for one in (one for one in names if not one.startswith(("Phi", "work"))):
        known = np.isfinite(run[one])
        assert (np.isfinite(found[one]) == known).all(), one
        bound = KINDS.get(units[one], 1e-7) * max(largest[units[one]], 1e-6)
        assert abs(found[one] - run[one])[known].max(initial=0.0) <= bound, one
        compared += int(known.any())
    assert compared >= 10


def test_a_state_that_is_put_back_leads_on_to_the_same_bits(tmp_path: Path) -> None:
    press = scene("nine_bar_press", "dry")
    with instance(written(press, tmp_path), 0.02) as slave:
        expected = [slave.place[name] for name in ("S9.y", "A.ex", "B.F_n" if "B.F_n" in slave.place else "B.ey")]
        for k in range(5):
            slave.doStep(k * 1e-3, 1e-3)
        kept = slave.getFMUState()
        ways = []
        for _ in range(2):
            for k in range(5, 10):
                slave.doStep(k * 1e-3, 1e-3)
            ways.append(slave.getFloat64(expected))
            slave.setFMUState(kept)
        slave.freeFMUState(kept)
    assert ways[0] == ways[1]


def test_what_is_set_after_initialization_is_refused_and_changes_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from fmpy.fmi1 import FMICallException

    ways = []
    for disturbed in (False, True):
        with instance(written(scene("nine_bar_press", "dry"), tmp_path), 0.02) as slave:
            for k in range(8):
                slave.doStep(k * 1e-3, 1e-3)
                for name in ("parameters.c", "relative_tolerance") if disturbed and k == 6 else ():
                    kept = slave.getFloat64([slave.place[name]])
                    with pytest.raises(FMICallException):
                        slave.setFloat64([slave.place[name]], [6e-4])
                    assert f"{name} is fixed" in capsys.readouterr().out
                    assert slave.getFloat64([slave.place[name]]) == kept
            ways.append(
                slave.getFloat64(
                    [slave.place[name] for name in ("S9.y", "A.ex", "B.ey", "A.F_n") if name in slave.place]
                )
            )
    assert ways[0] == ways[1]


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("parameters.c", -1e-4),
        ("parameters.c", 0.5),
        ("parameters.c", 1e-17),
        ("bodies.L1.mass", -1.0),
        ("contacts.dry.normal.restitution", 1.5),
        ("contacts.dry.normal.restitution", 0.0),
        ("contacts.dry.friction.v0", 1.0),
        ("bodies.L1.length", 1e200),
    ],
)
def test_numbers_that_the_native_run_refuses_end_initialization(
    name: str, value: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In the same words, as far as units and names of parameters go."""
    from fmpy.fmi1 import FMICallException

    press = scene("nine_bar_press", "dry")
    with pytest.raises(BadValueError) as native:
        press.simulate(1e-3, parameters={name: value})
    with (
        pytest.raises(FMICallException, match="ExitInitializationMode"),
        instance(written(press, tmp_path), **{name: value}),
    ):
        pass
    specified = capsys.readouterr().out
    if value < 1e100:  # of a number that overflows native runs say more
        assert str(native.value).replace(" with c =", " with parameters.c =").split(" (")[0] in specified
    else:
        assert "which follows from" in str(native.value) and "that follows from these parameters is inf" in specified


def test_bounds_are_in_the_description(tmp_path: Path) -> None:
    described = fmpy.read_model_description(written(scene("nine_bar_press", "dry"), tmp_path))
    named = {variable.name: variable for variable in described.modelVariables}
    restitution, mu = named["contacts.dry.normal.restitution"], named["contacts.dry.friction.mu"]
    assert (restitution.min, float(restitution.max)) == (None, 1.0)  # 0 itself is none
    assert restitution.description == "expected > 0 and <= 1"
    assert (float(mu.min), mu.max) == (0.0, None)


def test_a_tolerance_that_is_set_wins(tmp_path: Path) -> None:
    """Over the importer's, which is that of the description where nobody gave another."""
    press = scene("nine_bar_press", "dry")
    ends = []
    for given in ({}, {"relative_tolerance": 1e-4}, {"relative_tolerance": 1e-11}):
        with instance(written(press, tmp_path), 0.01, 1e-8, **given) as slave:
            assert slave.getFloat64([slave.place["relative_tolerance"]]) == [given.get("relative_tolerance", 1e-8)]
            slave.doStep(0.0, 0.01)
            ends.append(slave.getFloat64([slave.place["A.ex"]])[0])
    exact = press.simulate(0.01, output=2, rtol=1e-12)["A.ex"][-1]
    errors = [abs(end - exact) for end in ends]
    assert errors[2] < errors[0] < errors[1]


def test_an_event_that_stops_asks_to_terminate(tmp_path: Path) -> None:
    file = tmp_path / "falling.yaml"
    file.write_text(STOPPING, encoding="utf-8")
    with instance(written(gudgeon.load(file), tmp_path)) as slave:
        message = [slave.doStep(k * 0.1, 0.1)[1] for k in range(6)]
        height = slave.getFloat64([slave.place["weight.y"]])[0]
    assert message == [False] * 4 + [True] * 2  # after half a second
    assert height == pytest.approx(-1.25, abs=1e-10)


def test_what_cannot_be_is_refused(tmp_path: Path) -> None:
    from fmpy.fmi1 import FMICallException
    from fmpy.fmi3 import FMU3Slave

    fmu = written(scene("pendulum", "ideal"), tmp_path)
    description, unpacked = fmpy.read_model_description(fmu), fmpy.extract(fmu)
    slave = FMU3Slave(
        guid="{another}",
        unzipDirectory=unpacked,
        instanceName="one",
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    with pytest.raises(Exception, match="instantiate"):
        slave.instantiate(logMessage=lambda *_: None)
    with instance(fmu) as slave:
        for wrong in ((0.5, 0.1), (0.0, 0.0), (0.0, -0.1)):
            with pytest.raises(FMICallException):
                slave.doStep(*wrong)
        with pytest.raises(FMICallException):
            slave.setFloat64([OUTPUTS], [1.0])
        with pytest.raises(FMICallException):
            slave.setFloat64([PARAMETERS], [float("nan")])
        with pytest.raises(FMICallException):
            slave.getFloat64([OUTPUTS - 1])


def test_sources_are_whole_and_the_archive_is_the_same_each_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no compiler the sources go alone; all that is to be compiled is among them."""
    pendulum = scene("pendulum", "ideal")
    with zipfile.ZipFile(io.BytesIO(archive(pendulum))) as file:
        whole = {*file.namelist()}
    monkeypatch.setattr(compiler, "has_compiler", lambda: False)
    first, again = build_fmu(pendulum), build_fmu(pendulum)
    assert first == again
    with zipfile.ZipFile(io.BytesIO(first)) as file:
        names = set(file.namelist())
        build, page = (file.read(f"sources/{name}").decode() for name in ("buildDescription.xml", "README.md"))
    assert names == {name for name in whole if not name.startswith("binaries/")} and len(whole) == len(names) + 1
    units = re.findall(r'SourceFile name="(.*?)"', build)
    assert units and {f"sources/{unit}" for unit in units} <= names
    message = re.findall(r"^- `(.*?)`", page, re.MULTILINE)
    assert {f"sources/{name}" for name in (*message, "buildDescription.xml")} <= names
    assert {"model.h", "reduced.c", "fmu.h"} <= {*message} and " ".join(units) in page and "ROOT" not in page


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it says of the archive, without the library that other tests compile."""
    monkeypatch.setattr(compiler, "has_compiler", lambda: False)
    target = tmp_path / "press.FMU"

    def emitted(*arguments: str) -> Any:
        return CliRunner().invoke(app, ["emit", *arguments, "-o", str(target)])

    done = emitted("nine_bar_press", "--scene", "dry")
    assert done.exit_code == 0 and fmpy.read_model_description(str(target)).modelName == "nine_bar_press_dry"
    assert "Co-Simulation and Model Exchange, scene dry" in done.output and "other scenes" not in done.output
    assert "only sources" in done.output
    done = emitted("nine_bar_press")
    assert "scene ideal\n" in done.output and "other scenes, by --scene: dry, lubricated" in done.output
    assert "Co-Simulation only (no degrees of freedom" in emitted("four_bar").output
    assert emitted("nine_bar_press", "--scene", "dry", "--scene", "ideal").exit_code == InputError.exit_code


def test_python_writes_the_same_archive(tmp_path: Path) -> None:
    pendulum = scene("pendulum", "ideal")
    gudgeon.write_fmu(pendulum, tmp_path / "pendulum.fmu")
    assert (tmp_path / "pendulum.fmu").read_bytes() == archive(pendulum)
