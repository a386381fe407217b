"""The audit is quiet where forces balance: what is left of accelerations, slips and positions is rounding."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from tests.audit_mutants import mutant
from tests.integrators.test_drives import PULSE as DRIVEN_PIVOT
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.simulation.test_audit import reported

pytestmark = needs_compiler

STACK = """
parameters: {A: 0.61 N, w: 2.5 rad/s, B: 0.65 N, w2: 6.27 rad/s, k1: 256 N/m, k2: 32.1 N/m, S: 0.98 N, vb: -0.1 m/s}
bodies: {b1: {mass: 0.5 kg, inertia: 1e-4 kg*m^2}, b2: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints:
  g: {translational: [ground.O, b1.origin], axis: [1, 0]}
  h: {translational: [b1.origin, b2.origin], axis: [1, 0]}
forces:
  f: {force: b1.origin, value: ["A*sin(w*t) - k1*b1.x", 0]}
  f2: {force: b2.origin, value: ["B*sin(w2*t) - k2*b2.x", 0]}
  d1: {dry_friction: [ground.O, b1.origin], direction: [1, 0], static: S, kinetic: S}
  d2: {dry_friction: [b1.origin, b2.origin], direction: [1, 0], static: 1.78 N, kinetic: 1.78 N}
  d3: {dry_friction: [ground.O, b2.origin], direction: [1, 0], static: 0.287 N, kinetic: 0.287 N, speed: vb}
start: {set: {b1.x: 0, b2.x: 0.01}, rates: {b1.vx: 0, b2.vx: 0}}
"""
BLOCK = """
parameters: {A: 3 N, w: 7 rad/s, S: 2 N, K: 1.5 N, k: 40 N/m, v0: 0.2 m/s}
bodies: {b: {mass: 0.5 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {g: {translational: [ground.O, b.origin], axis: [1, 0]}}
forces:
  f: {force: b.origin, value: ["A*sin(w*t) - k*b.x", 0]}
  d: {dry_friction: [ground.O, b.origin], direction: [1, 0], static: S, kinetic: K}
start: {set: {b.x: 0}, rates: {b.vx: v0}}
events: {passes: {zero: b.x}}
"""


def audit_notes(run: object) -> list[str]:
    return [note for note in run.diagnostics.notes if note.startswith("audit:")]  # type: ignore[attr-defined]


@pytest.mark.parametrize("method", ["auto", "rodas5p", "radau5", "radau9"])
@pytest.mark.parametrize("rtol", [5e-10, 1e-7])
def test_two_blocks_that_rest_on_each_other(method: str, rtol: float, tmp_path: Path) -> None:
    """Forces of some newtons balance; the accelerations that two formulations leave are rounding, and differ."""
    run = loader(tmp_path)(STACK).simulate(0.05, output=5, method=method, rtol=rtol, audit="full")
    assert not audit_notes(run)
    assert {"acceleration", "power", "torque", "body"} <= {one.check for one in run.diagnostics.audit}
    assert abs(run["b2.x"] - 0.01).max() < 1e-9


def test_a_run_that_goes_on_from_an_event(tmp_path: Path) -> None:
    """It begins a rounding error before the zero, which the run before has recorded."""
    block = loader(tmp_path)(BLOCK)
    given = {
        "A": 4.066959514006033,
        "w": 34.772620605026425,
        "S": 2.458748109031319,
        "K": 1.067881669804872,
        "k": 17.793277739755798,
        "v0": -0.285344534272443,
    }
    run, found = None, []
    for cut in (
        0.002747010733579974,
        0.11967622939821876,
        0.12179146032797047,
        0.21413472864528876,
        0.28491558693146074,
        0.3054154259808228,
    ):
        start: dict[str, Any] = {"parameters": given} if run is None else {"start": run.final}
        run = block.simulate(cut, method="radau5", rtol=1.4375336929052935e-08, output=1, **start)
        found += run.events_of("passes").tolist()
        assert not audit_notes(run)
    assert found[-1] == pytest.approx(0.28491558693, abs=1e-9)


def test_what_is_left_of_a_slip(tmp_path: Path) -> None:
    """A friction that sticks holds slips below 1e-9 m/s; the rates of what is left of them are no motion."""
    block = loader(tmp_path)(BLOCK)
    given = {
        "A": 1.6252533506605826,
        "w": 5.585678105688332,
        "S": 0.38729704267642945,
        "K": 0.12456608259321347,
        "k": 816.1890924308686,
        "v0": 0.0,
    }
    run = None
    for cut in (0.6087375078117262, 1.1172433331308822, 1.1248742208725269):
        start: dict[str, Any] = {"parameters": given} if run is None else {"start": run.final}
        run = block.simulate(cut, method="radau5", rtol=1.2e-8, output=1, audit="full", **start)
        assert not audit_notes(run)


@pytest.mark.parametrize("inertia", ["auto", "0 kg*m^2"])
def test_a_rod_that_bears_nothing(inertia: str, tmp_path: Path) -> None:
    """Forces of a rod of 1e-9 kg are known to rounding of those of its neighbours, and so are its moments."""
    run = loader(tmp_path)(f"""
        bodies:
          crank: {{length: 150 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}}
          rod: {{length: 150 mm, mass: 1e-9 kg, inertia: {inertia}}}
          slider: {{mass: 0.3 kg, inertia: 1e-4 kg*m^2}}
        ground: {{O: [0, 0]}}
        joints:
          A: {{revolute: [ground.O, crank.tail]}}
          B: {{revolute: [crank.head, rod.tail]}}
          C: {{revolute: [rod.head, slider.origin]}}
          D: {{translational: [ground.O, slider.origin], axis: [1, 0]}}
        drives: {{m: {{angle: crank, value: 30 rad/s*t}}}}
        start: {{guess: {{rod.theta: -0.1}}}}
        """).simulate(1.0, output=100, audit="full")
    assert not audit_notes(run)


def test_the_power_of_friction_that_is_wrong(tmp_path: Path) -> None:
    """The balance at samples holds where friction sticks and where it slips."""
    right = gudgeon.load("belt_block")
    for start in (0.0, 0.1):
        run = right.simulate(3.0, output=100, parameters={"start.set.block.x": start}, audit="full")
        assert not audit_notes(run)
        assert "power" in {one.check for one in run.diagnostics.audit}
    line = next(x for x in right.source.files["dynamics.c"].splitlines() if "rhs->power[1] = " in x)
    broken = mutant(right, tmp_path, ("dynamics.c", line, line.replace("power[1] = ", "power[1] = 1e-3 + ")))
    assert "check power" in reported(broken, 3.0)


BAR = """
gravity: [0, -9.81]
bodies: {a: {length: 0.5 m, mass: 1 kg, inertia: 0.02 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, a.tail]}}
freedoms: 1
"""
HELD = """
forces: {f1: {dry_friction: [ground.O, a.head], direction: [0, 1], static: 12 N, kinetic: 12 N}}
start: {set: {a.theta: -30 deg}, rates: {a.omega: 0.6}}
"""
PERIODS = """
events: {e: {zero: "abs(mod(a.theta, 1 rad)) - 0.5 rad"}}
start: {set: {a.theta: -0.1 rad}}
"""


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_bar_that_friction_holds(formulation: str, tmp_path: Path) -> None:
    """Speeds of 1e-15 rad/s are no scale of what rows miss, nor powers at them."""
    held = loader(tmp_path, formulation)(BAR + HELD)
    for k in range(0, 31, 3):
        for rtol in (1e-6, 1e-8, 1e-10):
            given = {"start.rates.a.omega": 0.2 * k - 3.0}
            run = held.simulate(3.0, method="dop853", rtol=rtol, parameters=given, output=1000)
            assert not audit_notes(run), given


@pytest.mark.parametrize("method", ["dop853", "rodas5p", "radau5"])
def test_functions_of_one_mod_change_one_after_the_other(method: str, tmp_path: Path) -> None:
    """abs(mod(theta, 1)) reads a sign that is rounding where the period ends, in a step without a length."""
    swings = loader(tmp_path)(BAR + PERIODS)
    for rtol in (1e-6, 1e-8, 1e-10):
        assert not audit_notes(swings.simulate(2.0, method=method, rtol=rtol))


PULSE = """
parameters: {J: 1.026 N*s, w: 0.3 s, c: -8 s}
bodies: {b: {mass: 2.7727 kg, inertia: 0.01 kg*m^2}}
ground: {O: [0, 0]}
joints: {g: {translational: [ground.O, b.origin], axis: [1, 0]}}
forces: {f: {force: b.origin, value: ["J/w*exp(-((t - c)/w)**2)/sqrt(pi)", 0]}}
start: {set: {b.x: 0}, rates: {b.vx: 1.4294}}
"""
STRUCTURE = """
bodies:
  a: {mass: 1.8 kg, inertia: 0.0045 kg*m^2, com: [-0.01, 0.05], points: {in: [0.28, 0.1], out: [0.25, 0.02]}}
  b:
    {mass: 1.2 kg, inertia: 0.018 kg*m^2, com: [0.03, 0.06],
     points: {in: [-0.02, 0.02], out: [-0.05, -0.12], end: [-0.04, -0.19]}}
  free: {length: 0.5 m, mass: 0.4 kg, inertia: 0.01 kg*m^2}
ground: {A: [0.25, 0.16], B: [0.065, 0.058]}
joints:
  j0: {translational: [ground.A, a.in], axis: [0.52, -0.72], angle: -0.2}
  j1: {revolute: [b.in, ground.B]}
  j2: {revolute: [a.out, b.out]}
  j3: {revolute: [b.end, free.tail]}
forces: {f: {torque: [b, a], value: "0.5 N*m*cos(3 rad/s*t)"}}
start:
  guess: {a.x: -0.11, a.y: 0.26, a.theta: -0.2, b.x: 0, b.y: 0.04, b.theta: 2.83,
          free.x: 0.08, free.y: 0.01, free.theta: -1.8}
"""


def test_a_force_that_underflows(tmp_path: Path) -> None:
    """Powers of 1e-320 W have no digits: their balance cannot be checked to 1e-6."""
    block = loader(tmp_path)(PULSE)
    for impulse in (0.7, 1.026, 1.4, 1.9):
        run = block.simulate(0.22, output=7, audit="full", parameters={"J": impulse})  # from 1e-310 N to 1e-323 N
        assert not audit_notes(run)
        assert abs(run["b.vx"] - 1.4294).max() < 1e-14


@pytest.mark.parametrize("method", ["dop853", "rodas5p", "radau5"])
def test_a_structure_that_forces_load(method: str, tmp_path: Path) -> None:
    """Speeds in absolute coordinates are rounding, off the constraints: forces of constraints have a power there."""
    structure = loader(tmp_path, "full")(STRUCTURE)
    for t_end in (0.3, 1.0, 3.0):
        run = structure.simulate(t_end, output=100, method=method, audit="full")
        assert not audit_notes(run)
        assert abs(run.v).max() < 1e-12


STIFF_REST = """
format: gudgeon/1
name: block
bodies: {block: {mass: 0.9 kg, inertia: 0.01 kg*m^2}}
gravity: [0, -9.81]
expressions:
  far: hypot(block.x, block.y)
  rate: (block.vx*block.x + block.vy*block.y)/far
  push: max(0 N, 2.8e8 N/m*(1.1 m - far) - 2.9e4 kg/s*rate)
forces: {surface: {force: block.origin, value: [push*block.x/far, push*block.y/far]}}
start: {set: {block.x: 0.1 m, block.y: 1.0954451150103321 m, block.theta: 0}}
"""


@pytest.mark.parametrize("rtol", [1e-4, 1e-5, 1e-6])
def test_steps_bounded_by_stability(rtol: float, tmp_path: Path) -> None:
    """A block creeps down a stiff surface: each step of dop853 errs by tolerances, and nothing moves as fast."""
    (tmp_path / "m.yaml").write_text(STIFF_REST)
    simulation = gudgeon.load(tmp_path / "m.yaml")
    run = simulation.simulate(0.7, output=400, method="dop853", rtol=rtol)
    tighter = simulation.simulate(0.7, output=400, rtol=1e-9)
    assert np.abs(run.q - tighter.q).max() < 10.0 * rtol


BALL = """
parameters: {c: 0.2 mm, x0: 0.2 mm, vx: 0 m/s}
materials: {steel: {E: 207 GPa, nu: 0.3}}
bodies: {ball: {mass: 0.5 kg, inertia: 2e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, ball.origin]}}
start: {play: {A: {e: [x0, 0], rate: [vx, 0]}}}
freedoms: 1
bearings: {pin: {radius: 10 mm, clearance: c, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts:
  dry: {normal: {law: lankarani_nikravesh, restitution: 0.9}}
  oil:
    normal: {law: lankarani_nikravesh, restitution: 0.9}
    film: {law: pinkus_sternlicht, viscosity: 0.01 Pa*s}
    transition: 0.01 mm
scenes:
  dry: {play: {A: {bearing: pin, contact: dry}}}
  oil: {play: {A: {bearing: pin, contact: oil}}}
"""


@needs_compiler
@pytest.mark.parametrize("overlap", [0.0, 1e-16, 9e-14])
@pytest.mark.parametrize("vx", [0.0, -0.1])
def test_a_start_at_the_clearance(overlap: float, vx: float, tmp_path: Path) -> None:
    """What overlaps by less than 1e-13 m has not touched: the ball goes on as a free one."""
    run = loader(tmp_path)(BALL, "dry").simulate(2e-3, output=20, parameters={"x0": 2e-4 + overlap, "vx": vx})
    np.testing.assert_allclose(run["ball.x"], 2e-4 + overlap + vx * run.t, rtol=0, atol=1e-13)
    assert run.check(200) and not audit_notes(run)


@needs_compiler
@pytest.mark.parametrize(("share", "vx"), [(0.9999, -1e-3), (1.0, -1e-3), (1.0, -0.1)])
def test_a_film_that_has_come_to_rest(share: float, vx: float, tmp_path: Path) -> None:
    """What is left of a film's force, 1e-9 of its largest one, is rounding of the gap."""
    run = loader(tmp_path)(BALL, "oil").simulate(2e-3, output=20, parameters={"x0": share * 2e-4, "vx": vx})
    assert not audit_notes(run) and abs(run["ball.vx"][-1]) < 1e-9


@pytest.mark.parametrize(("method", "rtol", "t_end"), [("auto", 1e-12, 200.0), ("taylor", 1e-14, 2e4)])
def test_samples_that_are_all_at_rest_between_fast_steps(method: str, rtol: float, t_end: float) -> None:
    """Samples at multiples of the period have no energy; that of the steps between them measures the residual."""
    pendulum = gudgeon.load("pendulum", scene="two_seconds")
    run = pendulum.simulate(t_end, output=100, method=method, rtol=rtol)
    energy = run.evaluation.energy.sum(axis=1)
    assert np.abs(run.v[:, :2]).max() < 1e-4 and np.abs(energy).max() < 1e-9
    findings = {finding.check: finding.worst for finding in run.diagnostics.audit}
    assert 0.0 < findings["energy"] <= 1.0


@pytest.mark.parametrize("gravity", ["", "gravity: [0, -9.81 m/s^2]\n"], ids=["free", "hanging"])
def test_a_link_at_rest_before_a_pulse(gravity: str, tmp_path: Path) -> None:
    """Rates of a body at rest are rounding; those of a drive before its pulse are as small as 1e-300."""
    file = tmp_path / "rest.yaml"
    file.write_text(DRIVEN_PIVOT + gravity, encoding="utf-8")
    scene, rng = gudgeon.load(file), np.random.default_rng(3)
    for _ in range(12):
        width, time, rtol = 10.0 ** rng.uniform(-3.0, -0.5), rng.uniform(20.0, 95.0), 10.0 ** rng.uniform(-13.0, -11.5)
        for method in ("dop853", "taylor", "radau9"):
            run = scene.simulate(100.0, output=2, rtol=rtol, method=method, parameters={"w": width, "tc": time})
            assert not audit_notes(run), (width, time, rtol, method)
