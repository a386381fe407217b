"""Drives whose rate jumps, however that is written, and drives and forces that are no numbers at some time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import AssemblyError, NonFiniteError, SolverError
from tests import pump
from tests.scenes import loader
from tests.slow import slow_but, slow_rows_but

PAIR = """format: gudgeon/1
name: n
gravity: [0, -9.81 m/s^2]
bodies: {a: {length: 0.1 m, mass: 0.3 kg, inertia: 1e-3 kg*m^2}, b: {length: 0.2 m, mass: 0.3 kg, inertia: 2e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}, A: {revolute: [a.head, b.tail]}}
"""
ONE = "\n".join(
    [
        "format: gudgeon/1",
        "name: n",
        "bodies: {a: {length: 1, mass: 1, inertia: 1}}",
        "ground: {O: [0, 0]}",
        "joints: {O: {revolute: [ground.O, a.tail]}}",
        "",
    ]
)


def driven(text: str, value: str, folder: Path) -> gudgeon.Simulation:
    file = folder / "driven.yaml"
    file.write_text(f'{text}drives: {{d: {{angle: a, value: "{value}"}}}}\n', encoding="utf-8")
    return gudgeon.load(file)


@pytest.mark.parametrize(
    "value",
    [
        "hypot(t - 0.5 s, 0)",
        "((t - 0.5 s)**2)**0.5",
        pytest.param("sqrt(t**2 - t * 1 s + 0.25 s^2)", marks=pytest.mark.slow),
    ],
)
def test_a_root_of_a_square_gives_the_impulse_of_abs(value: str, tmp_path: Path) -> None:
    ends = [
        driven(PAIR, f"5 rad/s * {of}", tmp_path).simulate(rtol=1e-11, output=[0.4999, 0.5001, 0.6])["b.omega"]
        for of in ("abs(t - 0.5 s)", value)
    ]
    assert abs(ends[0][2] - ends[0][1]) > 1.0
    np.testing.assert_allclose(ends[1], ends[0], rtol=1e-9)


def test_a_jump_that_no_form_shows_ends_the_run_with_a_word(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"drive d: its rate jumps by about 2 at t = 0\.5 s") as caught:
        driven(PAIR, "acos(cos(t / (1 s) - 0.5))", tmp_path).simulate(0.8, output=80)
    assert caught.value.partial.t[-1] == pytest.approx(0.49)


@pytest.mark.parametrize("value", ["min(2 rad/s * t, 0.8 + 0.3 rad/s * t)", "abs(t - 0.5137 s) * 9 rad/s"])
def test_the_work_of_a_jump_is_counted_where_nothing_is_free(value: str, tmp_path: Path) -> None:
    run = driven(ONE, value, tmp_path).simulate(1.0, output=100)
    assert run.diagnostics.method == "kinematic"
    assert run.diagnostics.energy_residual < 1e-9


@pytest.mark.parametrize("text", [PAIR, ONE], ids=["free pendulum", "nothing is free"])
def test_accelerations_at_an_end_on_a_jump_are_those_before_it_in_all_kinds_of_runs(text: str, tmp_path: Path) -> None:
    """The drive has the angle t² 1 rad/s² up to 0.5 s; its acceleration jumps there from 2 to 8 rad/s²."""
    value = "1 rad/s^2 * (t**2 + 3 * max(0 s, t - 0.5 s)**2)"
    simulation = driven(text + "parameters: {x: 1 m}\nforces: {}\n", value, tmp_path)
    values = {"x": np.array([1.0, 2.0])}
    batch = simulation.simulate_many(values, 0.5, output=10)
    kept = simulation.simulate_many(values, 0.5, output=10, keep=["a.alpha"])
    runs = [
        simulation.simulate(0.5, output=10)["a.alpha"],
        batch["a.alpha"][1],
        batch[1]["a.alpha"],
        kept["a.alpha"][1],
        simulation.prepare("x", "a.alpha", 0.5, output=10)(np.array([2.0])).ravel(),
    ]
    for run in runs:
        np.testing.assert_allclose(run, 2.0, atol=1e-9)


COMPLEX: list[tuple[str, Callable[[np.ndarray], np.ndarray]]] = [
    ("abs(acos(t / (1 s)))", lambda t: -1 / np.sqrt(1 - t**2)),
    ("abs((t / (1 s) + 1)**0.3)", lambda t: 0.3 * (t + 1) ** -0.7),
    ("abs(log(t / (1 s) + 0.5))", lambda t: np.sign(np.log(t + 0.5)) / (t + 0.5)),
    ("atan2(1, abs(asin(t / (1 s))))", lambda t: -1 / (1 + np.arcsin(t) ** 2) / np.sqrt(1 - t**2)),
]


@pytest.mark.parametrize(("value", "rate"), slow_rows_but(COMPLEX[:3], COMPLEX))
def test_abs_of_what_may_be_complex(value: str, rate: Callable[[np.ndarray], np.ndarray], tmp_path: Path) -> None:
    run = driven(ONE, value, tmp_path).simulate(0.9, output=np.array([0.0, 0.1, 0.3, 0.4, 0.6, 0.9]))
    np.testing.assert_allclose(run["a.omega"][1:], rate(run.t[1:]), rtol=1e-12)


@pytest.mark.parametrize(
    ("value", "why"),
    [
        ("(0.5 - t/(1 s))**(1/3)", "the power 0.333"),
        ("log(0.5 - t/(1 s))", "log of 0"),
        ("asin(2*t/(1 s))", "asin of 1"),
    ],
)
def test_a_drive_that_is_no_number_is_named_with_its_time(value: str, why: str, tmp_path: Path) -> None:
    with pytest.raises(NonFiniteError, match=rf"drives\.d\.value \(line 6, column \d+\) is .* t = 0\.5 s, .*: {why}"):
        driven(ONE, value, tmp_path).simulate(1.0, output=10)


def test_at_the_start_too(tmp_path: Path) -> None:
    message = r"drives\.d\.value .* is not finite at t = 0 s, nan: the power 0\.333\d* of -0\.5"
    with pytest.raises(AssemblyError, match=message):
        driven(ONE, "(t/(1 s)-0.5)**(1/3)", tmp_path).simulate(1.0, output=10)


PAIR_AT = PAIR + "parameters: {t0: 0.5 s}\n"


@pytest.mark.parametrize("method", ["auto", "rk4", pytest.param("rodas5p", marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "value",
    [
        "drives: {d: {angle: a, value: acos(cos((t - t0) / (1 s)))}}",
        "drives: {d: {angle: a, value: ((t0 - t)/(1 s))**(1/3)}}",
        "forces: {f: {torque: a, value: 1 N*m*sqrt((t0 - t)/(1 s))}}",
        "forces: {f: {torque: a, value: 1 N*m*sqrt((t - t0)/(1 s))}}",
    ],
)
def test_a_batch_tells_of_them_as_a_run_alone(value: str, method: str, tmp_path: Path) -> None:
    """Jumps that no form shows were not looked for in batches."""
    file = tmp_path / "driven.yaml"
    file.write_text(PAIR_AT + value, encoding="utf-8")
    scene, times, step = gudgeon.load(file), (0.2, 0.5, 5.0), 1e-3 if method == "rk4" else None
    batch = scene.simulate_many({"t0": times}, 0.8, output=40, method=method, step=step)
    for i, t0 in enumerate(times):
        message = {failure.run: failure.error for failure in batch.failures}.get(i)
        try:
            run = scene.simulate(0.8, output=40, method=method, step=step, parameters={"t0": t0})
            assert message is None
        except SolverError as error:
            assert str(message) == str(error)
            run = error.partial
        if batch.samples[i] > 0:  # a start that has no accelerations is a sample of a run alone only
            np.testing.assert_array_equal(batch.q[i, : len(run.t)], run.q)
            assert np.isnan(batch.q[i, len(run.t) :]).all()


ODD = (
    PAIR_AT
    + """events: {e: {zero: "sqrt(0.7 - t/(1 s)) - 0.1"}}
outputs:
  {root: sqrt(t0 - t), third: ((t - t0)/(1 s))**(1/3), pole: 1 s/(t - t0), fine: 2*t, force: log(A.F/(1 N) - 1e9),
  either: 'where(sqrt(t0 - t) < 0.1 s^0.5, 2, 3)'}
"""
)


@pytest.mark.parametrize("drives", ["", "drives: {d: {angle: a, value: 3 rad/s*t}, f: {angle: b, value: 1 rad/s*t}}"])
def test_outputs_and_events_that_are_no_number_are_told(drives: str, tmp_path: Path) -> None:
    """Outputs became NaN without a word."""
    file = tmp_path / "odd.yaml"
    file.write_text(ODD + drives, encoding="utf-8")
    for formulation in ("reduced", "full"):
        run = gudgeon.load(file, formulation=formulation).simulate(1.0, output=100)
        assert [note.split(":")[0] for note in run.diagnostics.notes] == [
            "event e is NaN at t = 0.7 s",
            "output root is not finite (nan) at t = 0.51 s",
            "output third is not finite (nan) at t = 0 s",
            "output pole is not finite (inf) at t = 0.5 s",
            "output force is not finite (nan) at t = 0 s",
            "output either is not finite (nan) at t = 0.51 s",
        ]
        assert run.diagnostics.notes[1].endswith(": sqrt of -0.01; it is not finite at 50 of 101 samples")
        assert run.diagnostics.notes[3].endswith(": 1 divided by 0")
    batch = gudgeon.load(file).simulate_many({"t0": [0.5, 2.0]}, 1.0, output=100)
    assert batch[0].diagnostics.notes == run.diagnostics.notes
    assert not any("root" in note for note in batch[1].diagnostics.notes)


def test_an_output_of_what_is_none_is_not_blamed(tmp_path: Path) -> None:
    """A pin's δ̇⁻ is NaN while it is free, a reaction where rows are redundant: that is said elsewhere."""
    file = tmp_path / "worn.yaml"
    file.write_text(pump.TEXT + "outputs: {latched: 2*B.deltadot_minus}\n", encoding="utf-8")
    run = gudgeon.load(file, "worn").simulate(1e-3, output=10)
    assert np.isnan(run["latched"]).any()
    assert not any("latched" in note for note in run.diagnostics.notes)


OUTRUN = "exp(exp(exp(t/(0.3 s))))*1 rad"
WAYS = [(formulation, method) for formulation in ("reduced", "full") for method in ("auto", "dop853", "rodas5p")]


@pytest.mark.parametrize(("formulation", "method"), WAYS)
@pytest.mark.slow
def test_a_drive_that_outruns_the_steps_ends_the_run(method: str, formulation: str, tmp_path: Path) -> None:
    """A driven crank with a pendulum on it; 10 million steps in 25 s had not ended such a run."""
    driven(PAIR, OUTRUN, tmp_path)
    scene = gudgeon.load(tmp_path / "driven.yaml", formulation=formulation)
    message = r"no longer advances at t = 0\.2\d+ s: .*; drive d is at \d+.* rad, its rate \d+.* rad/s\n.*cannot be"
    with pytest.raises(SolverError, match=message) as caught:
        scene.simulate(1.0, output=100, method=method)
    run = caught.value.partial
    assert run.diagnostics.steps < 2**18
    assert run.t[-1] == pytest.approx(caught.value.time)
    assert scene.simulate(0.2, output=2, method=method).t[-1] == 0.2


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_a_drive_that_is_too_fast_for_any_step_is_named(method: str, tmp_path: Path) -> None:
    """Beside a bar that hangs freely: the crank itself is not integrated. Nothing was said of the drive."""
    beside = PAIR.replace("A: {revolute: [a.head, b.tail]}", "A: {revolute: [ground.O, b.tail]}")
    step = 1e-4 if method == "rk4" else None
    with pytest.raises(NonFiniteError, match=r"drive d is at .*e\+149 rad, its rate .*\n  a drive that grows beyond"):
        driven(beside, OUTRUN, tmp_path).simulate(1.0, method=method, step=step)


@pytest.mark.slow
def test_a_chirp_is_followed(tmp_path: Path) -> None:
    """Its steps become ever shorter too, but twice as many of them gain more time each time: some 290 000 of them."""
    run = driven(PAIR, "1 rad * sin(40 * (t/(1 s))**3)", tmp_path).simulate(15.5, output=1, rtol=1e-6)
    assert run.diagnostics.steps > 2**18
    assert run.t[-1] == 15.5


JUMPS = [
    ("acos(cos(t/(1 s) - 0.5))", "its rate jumps by about 2", 0.5),
    ("hypot(sin(t/(1 s) - 0.5), 1 - cos(t/(1 s) - 0.5))", "its rate jumps by about 2", 0.5),
    ("asin(sin(t*3/(1 s) - 0.5))", "its rate jumps by about 6", 0.690265),
    ("atan2(sin(t*5/(1 s)), cos(t*5/(1 s)))", "it jumps by 6.283", 0.628319),
    ("sqrt(abs(t/(1 s) - 0.5))", "its rate is infinite", 0.5),
    ("((t/(1 s) - 0.5)**2)**(1/3)", "its rate is infinite", 0.5),
]
SAMPLED = [(*jump, output) for jump in JUMPS for output in (10, 77)]  # with a sample at 0.5 s, and with none


@pytest.mark.parametrize(
    ("value", "message", "time", "output"),
    slow_rows_but([(*JUMPS[0], 77), (*JUMPS[4], 10), (*JUMPS[4], 77)], SAMPLED),
)
def test_without_freedom_too_a_rate_that_is_none_ends_the_run(
    value: str, message: str, time: float, output: int, tmp_path: Path
) -> None:
    """Works were NaN, or 1e296 J, without a word, or the linkage was said to pass a dead centre."""
    with pytest.raises(SolverError, match=rf"drive d: {message} at t = {time} s") as caught:
        driven(ONE, value, tmp_path).simulate(1.0, output=output)
    run = caught.value.partial
    assert run.t[-1] >= time - 1.0 / output - 1e-9
    assert run.diagnostics.energy_residual < 1e-6 * max(1.0, run.diagnostics.energy_turned_over)


SQUARES = [
    (c, value)
    for c in (0.4, 0.2202)
    for value in ("sqrt((t/(1 s))**2 - 2*t/(1 s)*{c} + {c}**2)", "sqrt((t/(1 s) - {c})**2)")
]


@pytest.mark.parametrize(("c", "value"), slow_rows_but([SQUARES[0], SQUARES[3]], SQUARES))
def test_a_square_under_a_root_is_one_in_spite_of_rounding(c: float, value: str, tmp_path: Path) -> None:
    """It was said to jump by 2.7e-13, or its rate by 2."""
    run = driven(ONE, value.format(c=c), tmp_path).simulate(1.0, output=77)
    assert run["a.theta"] == pytest.approx(abs(run.t - c), abs=1e-12)
    assert run["a.omega"] == pytest.approx(np.where(run.t > c, 1.0, -1.0), abs=1e-12)


@pytest.mark.parametrize(
    ("square", "at", "force"),
    [
        ("X**2 - 20*X + 100.0000000000002", 10.0, 4.4604e-7),
        ("X**2 - 1.8e8*X + 8100000000000001", 9e7, 1.0),
        ("X**2 - 20*X + 100", 10.5, 0.5),
    ],
)
def test_a_force_is_a_root_where_binary64_has_no_square(square: str, at: float, force: float, tmp_path: Path) -> None:
    """The first two were 0."""
    block = f"""
    bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
    ground: {{o: [0, 0]}}
    joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
    parameters: {{X: {at!r}}}
    forces: {{f: {{force: a.origin, value: ["1 N*sqrt({square})", 0]}}}}
    """
    run = loader(tmp_path)(block).simulate(1e-9, output=1, method="dop853")
    assert run["f.Fx"] == pytest.approx(force, rel=1e-4)


@pytest.mark.parametrize("output", [10, 77])
def test_a_drive_that_is_no_number_at_one_time_is_named(output: int, tmp_path: Path) -> None:
    with pytest.raises(NonFiniteError, match=r"drives\.d\.value .* at t = 0\.5 s, nan: 0 divided by 0"):
        driven(ONE, "sin(t/(1 s) - 0.5)/(t/(1 s) - 0.5)", tmp_path).simulate(1.0, output=output)


@pytest.mark.parametrize("value", ["((t/(1 s) - 0.5)**2)**0.75", "max(0, 0.5 - t/(1 s))**1.5"])
def test_without_freedom_an_unbounded_second_rate_is_passed(value: str, tmp_path: Path) -> None:
    """With a node of the quadrature at 0.5 s the balance was 0.4 % off."""
    run = driven(ONE, value, tmp_path).simulate(1.0, output=77)
    assert run.diagnostics.energy_residual < 1e-9


UNBOUNDED = [
    (value, step)
    for step in (1e-3, 1.1e-3)
    for value in (
        "((t/(1 s) - 0.5)**2)**0.75",
        "max(0, t/(1 s) - 0.5)**1.5 * 1e-3",
        "max(0, 0.5 - t/(1 s))**1.5",
        "abs(t/(1 s) - 0.5)**0.5",
    )
]


@pytest.mark.parametrize(("value", "step"), slow_rows_but([UNBOUNDED[1], UNBOUNDED[7]], UNBOUNDED))
def test_rk4_steps_over_no_unbounded_second_rate(value: str, step: float, tmp_path: Path) -> None:
    """It was told to take smaller steps."""
    with pytest.raises(SolverError, match=r"second rate of drive d (grows beyond all bounds|is -inf at t = 0\.5 s)"):
        driven(PAIR, value, tmp_path).simulate(1.0, output=10, method="rk4", step=step)


BOUNDED = ["max(0, t/(1 s) - 0.5)**2.5", "max(0, t/(1 s) - 0.5)**2", "abs(sin(t * 50 rad/s))"]


@pytest.mark.parametrize("value", slow_but(BOUNDED[1:], BOUNDED))
def test_rk4_steps_over_a_bounded_one(value: str, tmp_path: Path) -> None:
    runs = [driven(PAIR, value, tmp_path).simulate(1.0, output=1, method="rk4", step=h) for h in (0.1, 1e-4)]
    assert [run.t[-1] for run in runs] == [1.0, 1.0]
    assert runs[1].diagnostics.energy_residual < 1e-7 * runs[1].diagnostics.energy_turned_over


def test_a_run_that_an_event_ends_comes_to_no_jump(tmp_path: Path) -> None:
    text = PAIR + 'events: {early: {zero: "t - 0.3 s", action: stop}}\n'
    assert driven(text, "acos(cos(t/(1 s) - 0.5))", tmp_path).simulate(0.8, output=80).t[-1] == pytest.approx(0.3)


PULSE = """
format: gudgeon/1
name: pulse
parameters: {w: 0.01 s, tc: 1 s, amp: 0.01 m}
bodies: {cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}, bar: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0], angle: 0}
  pin: {revolute: [cart.origin, bar.tail]}
drives: {shake: {coordinate: cart.x, value: "amp*exp(-((t - tc)/w)**2)"}}
start: {set: {bar.theta: -90 deg}, rates: {bar.omega: 0}}
"""


def test_a_narrow_pulse_is_no_jump(tmp_path: Path) -> None:
    """The tail of a pulse that is narrower than a search interval grows by many orders within it, and is smooth."""
    rng = np.random.default_rng(7)
    file = tmp_path / "pulse.yaml"
    file.write_text(PULSE, encoding="utf-8")
    scene = gudgeon.load(file)
    for width, time in zip(10.0 ** rng.uniform(-4.0, -2.0, 40), rng.uniform(5.0, 95.0, 40), strict=True):
        scene.simulate(100.0, output=2, parameters={"w": width, "tc": time, "amp": width})
    scene.simulate(100.0, output=2, parameters={"w": 3.489890490510235e-4, "tc": 19.033897807209538, "amp": 4.918e-4})
