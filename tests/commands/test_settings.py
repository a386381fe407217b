"""What --set can set, what it says of what it cannot; what check remarks of sizes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.model.parameters import explain_address
from tests.programs import needs_compiler
from tests.pump import TEXT, Gudgeon

pytestmark = [needs_compiler, pytest.mark.usefixtures("no_pictures")]


@pytest.mark.parametrize("command", ["run", "bench", "map"])
def test_an_expression_of_time_is_told_with_its_place(command: str, call: Gudgeon, pump: str) -> None:
    done = call(command, pump, "--set", "drives.motor.value=3")
    line = next(k for k, text in enumerate(TEXT.splitlines(), 1) if "motor" in text)
    column = TEXT.splitlines()[line - 1].index("20 deg") + 1
    assert done.exit_code == 2
    assert f"{pump}:{line}:{column}: --set: drives.motor.value is a compiled expression of t or motion" in done.stderr
    assert "as a parameter, parameters: {phase: … deg}, value: phase + …" in done.stderr


def test_a_number_in_a_drive_is_set_as_a_parameter(pump: str) -> None:
    """What the message says works: the same motion, and another phase without compiling again."""
    named = Path(pump).with_name("named.yaml")
    named.write_text(TEXT.replace("20 deg + omega", "phase + omega").replace("{omega", "{phase: 20 deg, omega"))
    first = gudgeon.load(pump).simulate(0.01, output=1)
    again = gudgeon.load(named)
    assert again.simulate(0.01, output=1)["piston.x"].tolist() == first["piston.x"].tolist()
    turned = again.simulate(0.01, output=1, parameters={"phase": "30deg"})
    assert turned["crank.theta"][0] - first["crank.theta"][0] == pytest.approx(0.17453292519943295)
    with pytest.raises(
        UnknownNameError, match=r"drives.motor.value is a compiled expression of t or motion.*\n.*a parameter"
    ):
        gudgeon.load(pump).simulate(0.01, parameters={"drives.motor.value": 3.0})


@pytest.mark.parametrize("address", ["ground.O.x", "ground.C.y", "joints.bore.axis.y"])
def test_a_number_that_is_written_as_zero_is_told(address: str, call: Gudgeon, pump: str) -> None:
    done = call("run", pump, "--set", f"{address}=1")
    assert done.exit_code == 2 and f"{address} is 0 in the file or left out, and in no equation" in done.stderr
    assert "write a parameter there" in done.stderr


def test_a_zero_that_is_no_component_and_one_that_is_left_out(tmp_path: Path) -> None:
    """A key of a force or of a law, with what to do: as a parameter it can be set."""
    text = (
        find_shipped_file("slider_crank_spring").read_text(encoding="utf-8").replace("damping: 1 N*s/m", "damping: 0")
    )
    plain, named = tmp_path / "plain.yaml", tmp_path / "named.yaml"
    plain.write_text(text, encoding="utf-8")
    source = gudgeon.load(plain).source
    for address in ("forces.coil.damping", "coil.damping"):
        message, hint = explain_address(source, address)
        assert message.startswith("forces.coil.damping is 0 in the file") and "damping: own) and set that" in hint
    oiled = gudgeon.load("nine_bar_press", "lubricated").source
    message, _ = explain_address(oiled, "contacts.oil.film.extra_clearance")
    assert message.startswith("contacts.oil.film.extra_clearance is 0 in the file or left out,")
    own = text.replace("damping: 0", "damping: own").replace("\nforces:", "\nparameters: {own: 0 N*s/m}\n\nforces:")
    named.write_text(own, encoding="utf-8")
    assert own.count("own: 0") == own.count(": own") == 1
    assert explain_address(gudgeon.load(named).source, "own") == ("", "")


def test_a_result_of_the_motion_is_told_what_says_it(call: Gudgeon, pump: str) -> None:
    """A start that has its section, and what is driven: itself, or by the linkage; an address without its section."""
    for address, message in (
        ("crank.omega", "motor drives crank: its motion is in drives.motor.value, here by "),
        ("rod.omega", "motor drives the linkage, which has no degree of freedom: its motion is in "),
        ("piston.x", "its start is start.guess.piston.x"),
    ):
        for command in ("check", "run"):
            done = call(command, pump, "--set", f"{address}=1")
            words = " ".join(done.stderr.split())
            assert done.exit_code == 2 and f"{address} is a result of the motion, not a parameter of the file" in words
            assert message in words and "start: {rates" not in words
    done = call("check", pump, "--set", "motor.value=1")
    assert done.exit_code == 2 and "drives.motor.value is a compiled expression of t or motion" in " ".join(
        done.stderr.split()
    )
    with pytest.raises(UnknownNameError, match=r"bob.omega is a result .*\n.*start.rates.bob.omega"):
        gudgeon.load("pendulum").simulate(0.1, parameters={"bob.omega": 1.0})


def test_where_a_journal_begins_is_said_by_the_file_first(call: Gudgeon, pump: str) -> None:
    joint = gudgeon.load(pump, "worn").source.clearances[0].name
    done = call("run", pump, "--scene", "worn", "--set", f"start.play.{joint}.e.x=1um")
    assert done.exit_code == 2 and f"the file's start gives no position of {joint}" in done.stderr
    assert f"start: {{play: {{{joint}: {{e: [0 mm, 0 mm]}}}}}}" in done.stderr
    with pytest.raises(UnknownNameError, match=f"start gives no position of {joint}"):
        gudgeon.load(pump, "worn").simulate_many({f"start.play.{joint}.rate.y": [0.1]}, t_end=1e-3)


def test_a_parameter_that_is_zero_can_be_set(pump: str) -> None:
    named = Path(pump).with_name("named.yaml")
    named.write_text(TEXT.replace("C: [0, 0]", "C: [0, shift]").replace("{omega", "{shift: 0 m, omega"))
    run = gudgeon.load(named).simulate(0.01, output=1, parameters={"shift": "5mm"})
    assert run["piston.y"] == pytest.approx(0.005)


def test_gains_are_both_gains(call: Gudgeon, pump: str) -> None:
    def run(*arguments: str) -> Any:
        how = ("--scene", "worn", "--method", "rk4", "--formulation", "full", "--t-end", "2ms")
        done = call("run", pump, *how, "--json", *arguments)
        assert done.exit_code == 0, done.output
        return json.loads(done.stdout)["scenes"]["worn"]["diagnostics"]["phi_dot_max"]

    both = run("--set", "baumgarte.alpha=0", "--set", "baumgarte.beta=0")
    assert run("--set", "gains=0") == both != run()
    twice = call("run", pump, "--set", "gains=0", "--set", "baumgarte.beta=1")
    assert twice.exit_code == 2 and "baumgarte.beta is given twice" in twice.stderr


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("gains=-1", "baumgarte.alpha is -1 1/s: a negative gain increases drift; expected >= 0 and <= 1e+150"),
        ("baumgarte.beta=1e300", "baumgarte.beta is 1e+300 1/s: its square overflows"),
        ("contacts.dry.velocity_floor=0", "contacts.dry.velocity_floor is 0 m/s: the least impact velocity is"),
        ("gains=1e-320", "'1e-320' is out of range"),
        ("c=1e-306 mm", "'1e-306 mm' is out of range"),
        ("omega=1e-320rpm", "'1e-320 rpm' is out of range"),
        ("c=1e-18m", "the clearance of B is 1e-18 m, below the rounding of doubles at the mechanism's size (0.06 m)"),
        ("bearings.pin.radius=1e300", "bearings.pin.radius is 1e+300 m, too far from 1 for doubles: B.K, which"),
    ],
)
def test_numbers_that_mean_nothing(command: str, setting: str, message: str, call: Gudgeon, pump: str) -> None:
    """Check says so as a run does; below 2.2e-308 a number has lost digits before anything is made of it."""
    done = call(command, pump, "--set", setting)
    assert done.exit_code == 2 and message in " ".join(done.stderr.split())


def test_clearances_down_to_what_doubles_tell_apart(pump: str) -> None:
    """One contact, whose force no longer depends on the clearance; below the bound it would be seen several times."""
    worn = gudgeon.load(pump, "worn")
    batch = worn.simulate_many({"c": [1e-12, 1e-14, 1e-16, 1e-18]}, t_end=1e-4)
    assert [failure.run for failure in batch.failures] == [2, 3]
    assert all("expected 8.5e-16 m at least" in str(failure.error) for failure in batch.failures)
    assert [len(contacts) for contacts in batch.impacts[:2]] == [1, 1]
    slow = worn.simulate(1e-4, parameters={"c": 1e-15}).diagnostics
    # places are rounded by some 1e-17 m, a hundredth of this clearance: the speed of the onset, and forces, by 1e-3
    assert slow.onsets == 1 and pytest.approx(batch.peaks["F"][1, 0], rel=2e-3) == slow.peaks[0].F


@pytest.mark.parametrize("scene", ["ideal", "worn"])
def test_a_drive_too_fast_for_doubles_is_no_dead_centre(scene: str, call: Gudgeon, pump: str) -> None:
    done = call("run", pump, "--scene", scene, "--set", "omega=1e200")
    assert done.exit_code == 1
    message = f"scene {scene}: velocities and accelerations are too large for doubles at t = 0 s; drive motor"
    assert message in done.stderr and "its rate 1e+200 rad/s\n  use a slower drive" in done.stderr


@pytest.mark.parametrize(("key", "option"), [("step", "--step"), ("t_end", "--t-end"), ("output", "--output")])
def test_how_a_run_goes_is_told_to_the_run(key: str, option: str, call: Gudgeon, pump: str) -> None:
    for command in ("check", "run"):
        done = call(command, pump, "--set", f"scenes.worn.simulate.{key}=1")
        message = " ".join(done.stderr.split())
        assert done.exit_code == 2 and f"set it for the run: {option} of the command, {key}= of simulate" in message
    with pytest.raises(UnknownNameError, match=option):
        gudgeon.load(pump).simulate(1e-3, parameters={f"scenes.worn.simulate.{key}": 1.0})


def test_what_overflows_is_told_by_the_key_that_was_written(call: Gudgeon, pump: str) -> None:
    done = call("run", pump, "--set", "bodies.rod.length=1e200m")
    assert done.exit_code == 2 and "error: bodies.rod.length is 1e+200 m, too far from 1 for doubles:" in done.stderr


def test_gains_in_python_and_in_batches(pump: str) -> None:
    simulation = gudgeon.load(pump, formulation="full")
    run = simulation.simulate(1e-3, parameters={"gains": "3 1/s"})
    assert (run.parameters["baumgarte.alpha"], run.parameters["baumgarte.beta"]) == (3.0, 3.0)
    batch = simulation.simulate_many({"gains": [0.0, 5.0]}, t_end=1e-3)
    assert batch[1].parameters["baumgarte.beta"] == 5.0
    with pytest.raises(BadValueError, match="given twice"):
        simulation.simulate(1e-3, parameters={"gains": 1.0, "baumgarte.alpha": 2.0})


def test_a_parameter_of_that_name_comes_first(pump: str) -> None:
    named = Path(pump).with_name("named.yaml")
    named.write_text(TEXT.replace("{omega", "{gains: 2, omega"))
    run = gudgeon.load(named).simulate(1e-3, parameters={"gains": 7.0})
    assert run.parameters["parameters.gains"] == 7.0 and run.parameters["baumgarte.alpha"] != 7.0


def test_a_mechanism_in_millimetres_by_mistake_is_remarked(call: Gudgeon, tmp_path: Path) -> None:
    bare = TEXT.partition("scenes:")[0].replace("30 mm,", "30,").replace("120 mm,", "120,").replace("0.14}", "140}")
    (tmp_path / "bare.yaml").write_text(bare)
    done = call("check", "bare.yaml")
    message = " ".join(done.stdout.split())
    assert done.exit_code == 0, done.output
    assert (
        "size: bodies.rod.length is 120 m: numbers without a unit are metres; if millimetres are meant, write 120 mm"
        in message
    )
    (tmp_path / "crane.yaml").write_text(bare.replace("30,", "12,").replace("120,", "48,").replace("140}", "58}"))
    for name in ("crane.yaml", "nine_bar_press", "car_axis"):
        assert "size:" not in call("check", name).stdout


def test_check_at_other_numbers(call: Gudgeon, pump: str) -> None:
    """A rod shorter than the crank does not close; one that is not there, or negative, is told as run tells it."""
    assert call("check", pump, "--set", "bodies.rod.length=90mm").exit_code == 0
    short = call("check", pump, "--set", "bodies.rod.length=5mm", "--set", "ground.C.y=0")
    assert short.exit_code == 2 and "ground.C.y is 0 in the file" in short.stderr
    short = call("check", pump, "--set", "bodies.rod.length=5mm")
    assert short.exit_code == gudgeon.errors.AssemblyError.exit_code, short.output
    assert "rod" in short.stderr and "length" in short.stderr
    assert short.stdout.startswith("valid, but scenes ideal, worn cannot be run: 3 bodies")
    wear = call("check", pump, "--set", "bearings.pin.clearance=-1mm")
    assert wear.exit_code == 2 and "clearance" in wear.stderr
    assert call("check", pump, "--set", "bodies.rood.length=1").exit_code == 2
    wide = call("check", pump, "--set", "bearings.pin.radius=0.2mm")  # and K divides by R_i - R_j, which is 0
    assert wide.exit_code == 2 and "a clearance is smaller than the bearing's radius" in wide.stderr
    assert call("check", pump, "--set", "gains=0", "--set", "start.guess.piston.x=0.13").exit_code == 0
    only = call("check", pump, "--set", "bearings.pin.journal_material=steel")
    assert only.exit_code == 2 and "the file has only one material" in only.stderr
    other = call("check", pump, "--json", "--set", "bodies.rod.length=500")
    assert other.exit_code == 0 and json.loads(other.stdout)["valid"], other.output


@pytest.mark.parametrize("key", ["law", "geometry"])
def test_a_law_is_swapped_elsewhere(key: str, call: Gudgeon) -> None:
    """`--set` has numbers; where a choice that C is made of can be changed is told, and Python has it there."""
    address = f"contacts.dry.normal.{key}"
    done = call("run", "slider_crank", "--scene", "dry", "--set", f"{address}=hertz")
    message = " ".join(done.stderr.split())
    assert done.exit_code == 2 and f"--set: {address} selects compiled equations" in message
    assert f"other: {{extends: dry, normal: {{{key}: …}}}}" in message and f'overrides={{"{address}": "…"}}' in message
    with pytest.raises(UnknownNameError, match="selects compiled equations"):
        gudgeon.load("slider_crank", "dry").simulate(1e-4, parameters={address: 1.0})
