"""Integrators against closed forms: corners that come often, powers at a corner, starts that fail, free bodies."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError, NonFiniteError, SolverError
from tests.scenes import Load, loader

ADAPTIVE = ["auto", "rodas5p"]

BLOCK = """
bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}}}
ground: {{o: [0, 0]}}
joints: {{g: {{translational: [ground.o, a.origin], axis: [1, 0]}}}}
start: {{set: {{a.x: {x} m}}}}
forces: {{f: {{force: a.origin, value: [{force}, 0]}}}}
"""


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_square_wave_force(load: Load, method: str) -> None:
    """1 N sgn sin(20πt) on 1 kg: after whole periods T the velocity is 0 and x = t T/4."""
    run = load(BLOCK.format(x=0, force="1 N * sign(sin(20*pi*t))")).simulate(10.0, output=10, method=method)
    assert run["a.vx"][-1] == pytest.approx(0.0, abs=1e-6)
    assert run["a.x"][-1] == pytest.approx(10 * 0.1 / 4, abs=1e-6)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_pulse_once_a_turn(load: Load, method: str) -> None:
    """20 N m max(0, cos θ − .9): ω against the potential of the torque, whatever the time."""
    text = """
    bodies: {a: {mass: 1 kg, inertia: 1 kg*m^2}}
    ground: {o: [0, 0]}
    joints: {g: {revolute: [ground.o, a.origin]}}
    start: {set: {a.theta: 0.5}, rates: {a.omega: 10 rad/s}}
    forces: {cam: {torque: a, value: 20 N*m * max(0, cos(a.theta) - 0.9)}}
    """
    run = load(text).simulate(20.0, output=200, method=method)
    edge = math.acos(0.9)

    def work(theta: np.ndarray) -> np.ndarray:
        """∫ of the torque from 0: an even pulse about every 2πk."""
        turns = np.round(theta / (2 * np.pi))
        x = np.clip(theta - 2 * np.pi * turns, -edge, edge)
        return 20 * (2 * turns * (math.sin(edge) - 0.9 * edge) + np.sin(x) - 0.9 * x)

    theta, omega = run["a.theta"], run["a.omega"]
    assert omega**2 / 2 - work(theta) == pytest.approx(50 - work(np.array(0.5)), rel=1e-5)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_event_that_comes_often(load: Load, method: str) -> None:
    """sin(20πt) rises through zero ten times a second, whatever the mechanism does meanwhile."""
    text = BLOCK.format(x=0, force="1 N") + "events: {tick: {zero: sin(20*pi*t), direction: rising}}\n"
    run = load(text).simulate(9.95, output=10, method=method)
    assert run.events_of("tick") == pytest.approx(np.arange(1, 100) * 0.1, abs=1e-9)


@pytest.mark.parametrize(
    ("zero", "height"), [("sqrt(ball.y / (1 m)) - 0.5", 0.25), ("(ball.y / (1 m))**1.5 - 0.3", 0.3 ** (2 / 3))]
)
@pytest.mark.parametrize("rtol", [1e-3, 1e-8])
def test_event_whose_expression_has_an_end(load: Load, zero: str, height: float, rtol: float) -> None:
    """A ball falls from 1 m: steps end below the ground, where the expression is no number."""
    text = f"""
    gravity: [0, -9.81 m/s^2]
    bodies: {{ball: {{mass: 1 kg, inertia: 1e-2 kg*m^2}}}}
    start: {{set: {{ball.x: 0, ball.y: 1, ball.theta: 0}}}}
    events: {{low: {{zero: "{zero}"}}}}
    """
    run = load(text).simulate(2.0, output=3, method="dop853", rtol=rtol)
    assert run.events_of("low") == pytest.approx([math.sqrt(2 * (1 - height) / 9.81)], abs=1e-9)


def test_what_flies_off_is_no_dead_centre(tmp_path: Path) -> None:
    """A bead on an arm that turns evenly: r = r0 cosh ωt without end."""
    file = tmp_path / "fly.yaml"
    file.write_text(
        """
format: gudgeon/1
name: fly
bodies: {arm: {mass: 1 kg, inertia: 0.1 kg*m^2}, bead: {mass: 1 kg, inertia: 0.1 kg*m^2}}
ground: {O: [0, 0]}
joints:
  pin: {revolute: [ground.O, arm.origin]}
  guide: {translational: [arm.origin, bead.origin], axis: [1, 0]}
drives: {turn: {angle: arm, value: 10 rad/s * t}}
start: {set: {bead.x: 0.1}, rates: {bead.vx: 0}}
""",
        encoding="utf-8",
    )
    with pytest.raises(SolverError, match=r"diverged|no longer advances"):
        gudgeon.load(file, formulation="full").simulate(4.0, output=5, method="dop853")


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
@pytest.mark.parametrize("start", [0.0, 0.3])
def test_power_of_a_magnitude_through_zero(load: Load, method: str, start: float) -> None:
    """ẍ = −100 x − |ẋ|^1.5 sgn ẋ swings through ẋ = 0; rk4, which holds no sides, knows the answer to 1e-8."""
    force = "-100 N * a.x/(1 m) - 1 N * abs(a.vx/(1 m/s))**1.5 * sign(a.vx)"
    text = BLOCK.format(x=1, force=force).replace("}}\nforces", f"}}, rates: {{a.vx: {start} m/s}}}}\nforces")
    simulation = load(text)
    run = simulation.simulate(1.0, output=10, method=method, rtol=1e-10)
    fixed = simulation.simulate(1.0, output=10, method="rk4", step=1e-4)
    assert run["a.x"] == pytest.approx(fixed["a.x"], abs=1e-8)


@pytest.mark.parametrize(
    "force", ["6 N - 5 N*exp(-0.1 m/abs(a.x))", '"6 N + 5 N*exp(1/min(a.x*10/(1 m), -a.x*10/(1 m)))"']
)
def test_a_branch_that_grows_beyond_all_bounds_behind_its_corner(load: Load, force: str) -> None:
    """Held on its side, the exponent changes its sign at x = 0: steps shrank before it and never came through."""
    simulation = load(BLOCK.format(x=-0.5, force=force))
    sign = -1.0 if "6 N -" in force else 1.0

    def rates(_: float, y: NDArray[np.float64]) -> list[float]:
        return [y[1], 6.0 + sign * 5.0 * math.exp(-0.1 / abs(y[0])) if y[0] else 6.0]

    exact = solve_ivp(rates, (0.0, 1.0), [-0.5, 0.0], method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    for method in ("dop853", "rodas5p"):
        run = simulation.simulate(1.0, output=9, rtol=1e-9, method=method)
        np.testing.assert_allclose([run["a.x"][-1], run["a.vx"][-1]], exact, rtol=0, atol=2e-7)
        assert run["a.x"][-1] > 0.0


@pytest.mark.parametrize("speed", ["hypot(b.vx, b.vy)", "sqrt(b.vx**2 + b.vy**2)"])
def test_quadratic_drag_from_rest(load: Load, speed: str) -> None:
    """1 kg falls: y = -10 m ln cosh(t sqrt(g 0.1 1/m)). The slope of the drag was 0/0 at rest, and rodas5p no start."""
    drag = f'"-0.1 N*s^2/m^2*{speed}*b.vx", "-0.1 N*s^2/m^2*{speed}*b.vy"'
    fall = load(
        "gravity: [0, -9.81 m/s^2]\nbodies: {b: {mass: 1 kg, inertia: 1 kg*m^2}}\n"
        f"forces: {{drag: {{force: b.origin, value: [{drag}]}}}}\n"
    )
    exact = -10.0 * math.log(math.cosh(math.sqrt(0.981)))
    for method in ("dop853", "rodas5p"):
        run = fall.simulate(1.0, output=2, rtol=1e-9, method=method)
        assert run["b.y"][-1] == pytest.approx(exact, abs=1e-8)


@pytest.mark.parametrize("method", ["dop853", "rk4"])
def test_a_force_that_overflows_on_the_way_is_named(load: Load, method: str) -> None:
    """rk4 said that its step was too long."""
    simulation = load(BLOCK.format(x=0.3, force="1 N + 1 N*exp(a.x*1e3/(1 m))/(exp(a.x*1e3/(1 m)) + exp(400))"))
    with pytest.raises(NonFiniteError, match=r"forces\.f\.value.* is not finite at t = .*exp of 7\d\d"):
        simulation.simulate(2.0, method=method, step=0.01 if method == "rk4" else None)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_contact_written_as_a_force(load: Load, method: str) -> None:
    """A ball on K max(0, −y)^1.5: no loss, so it comes back to its height, and its speed follows from energy."""
    force = "-0.981 N + 1e6 N * max(0, -a.x/(1 m))**1.5"
    run = load(BLOCK.format(x=0.5, force=force)).simulate(1.5, output=300, method=method)
    x, v = run["a.x"], run["a.vx"]
    assert v**2 / 2 + 0.981 * x + 1e6 / 2.5 * np.maximum(0, -x) ** 2.5 == pytest.approx(0.981 * 0.5, abs=1e-6)


@pytest.mark.parametrize("method", ["auto", "rodas5p", pytest.param("scipy:Radau", marks=pytest.mark.slow)])
@pytest.mark.parametrize("force", ["1 N / (a.x/(1 m))", "1 N * sqrt(a.x/(1 m) - 1)"])
def test_motion_that_is_not_finite_at_the_start(load: Load, method: str, force: str) -> None:
    """1/0 and √−1 at t = 0 are errors of the solver, as with rk4."""
    simulation = load(BLOCK.format(x=0, force=force))
    with pytest.raises(SolverError, match="finite"):
        simulation.simulate(1.0, step=1e-3)
    with pytest.raises(SolverError):
        simulation.simulate(1.0, output=10, method=method)


def test_events_with_backends(load: Load) -> None:
    """They look for contacts only: an event that would end the run is refused, one that is noted is told not to be."""
    text = BLOCK.format(x=0, force="1 N") + "events: {half: {zero: a.x - 0.5 m, action: stop}}\n"
    with pytest.raises(BadValueError, match="half"):
        load(text).simulate(2.0, output=10, method="scipy:DOP853")
    run = load(text).simulate(2.0, output=10, method="scipy:DOP853", stop=False)
    assert run.t[-1] == 2.0
    assert any("does not locate events" in note for note in run.diagnostics.notes)


DRIVEN = """
bodies: {{a: {{mass: 1 kg, inertia: 1 kg*m^2}}, b: {{mass: 2 kg, inertia: 1 kg*m^2}}}}
ground: {{o: [0, 0]}}
joints:
  g: {{translational: [ground.o, a.origin], axis: [1, 0]}}
  h: {{translational: [ground.o, b.origin], axis: [1, 0]}}
drives: {{d: {{coordinate: a.x, value: {value}}}}}
forces: {{s: {{spring_damper: [a.origin, b.origin], stiffness: 8 N/m, free_length: 1 m}}}}
start: {{set: {{b.x: 1 m}}}}
"""


def test_a_drive_that_jumps_is_refused(load: Load) -> None:
    """A position cannot jump: the corner of sign would be in Φ alone."""
    with pytest.raises(BadValueError, match=r"drives\.d\.value jumps"):
        load(DRIVEN.format(value="0.01 m * sign(cos(2*t))"))


def test_driven_coordinate_is_its_drive(load: Load) -> None:
    """Samples of a driven coordinate are the file's expression, whatever was integrated."""
    run = load(DRIVEN.format(value="0.01 m * max(0, sin(40*t) - 0.9)")).simulate(4.0, output=100)
    assert run["a.x"] == pytest.approx(0.01 * np.maximum(0, np.sin(40 * run.t) - 0.9), abs=1e-9)


FREE = """
materials: {steel: {E: 207 GPa, nu: 0.3}}
bodies:
  a: {mass: 2 kg, inertia: 0.02 kg*m^2, points: {p: [0.1 m, 0.02 m]}}
  b: {mass: 1 kg, inertia: 0.01 kg*m^2, points: {p: [-0.15 m, 0.01 m], r: [0.1 m, 0]}}
  d: {mass: 0.5 kg, inertia: 0.005 kg*m^2, points: {p: [-0.05 m, 0.0 m]}}
ground: {o: [0, 0]}
joints:
  j: {revolute: [a.p, b.p]}
  k: {revolute: [b.r, d.p]}
start:
  set: {a.x: 0, a.y: 0, a.theta: 0.2, b.theta: 0.7, d.theta: -1}
  rates: {a.vx: 1 m/s, a.vy: 0.3 m/s, a.omega: 5 rad/s, b.omega: -7 rad/s, d.omega: 20 rad/s}
bearings:
  pin: {radius: 10 mm, clearance: 0.5 mm, length: 15 mm, bearing_material: steel, journal_material: steel}
contacts:
  dry:
    normal: {law: hertz, stiffness: 1e9, restitution: 0.5, dissipation: flores}
    friction: {law: modified_coulomb, mu: 0.2, v0: 1e-4 m/s, v1: 1e-3 m/s}
  oil: {film: {law: pinkus_sternlicht, viscosity: 0.4}}
scenes:
  both: {play: {j: {bearing: pin, contact: oil}, k: {bearing: pin, contact: dry}}}
"""


@pytest.mark.parametrize("method", [pytest.param("dop853", marks=pytest.mark.slow), "rodas5p"])
def test_momentum_of_three_bodies_in_flight(load: Load, method: str) -> None:
    """What a film, a contact and its friction do to one body they do back to the other: p and L stay."""
    run = load(FREE, "both").simulate(0.1, output=200, method=method, rtol=1e-10)
    assert len(run.impacts)
    bodies = {"a": (2, 0.02), "b": (1, 0.01), "d": (0.5, 0.005)}
    for axis in "xy":
        p = sum(m * run[f"{n}.v{axis}"] for n, (m, _) in bodies.items())
        assert np.ptp(p) < 1e-11
    turn = sum(
        m * (run[f"{n}.x"] * run[f"{n}.vy"] - run[f"{n}.y"] * run[f"{n}.vx"]) + i * run[f"{n}.omega"]
        for n, (m, i) in bodies.items()
    )
    assert np.ptp(turn) < 1e-11


@pytest.mark.parametrize(("method", "code"), [("rodas5p", 0), ("nonsense", 2)])
def test_run_takes_the_method_that_is_asked_for(tmp_path: Path, method: str, code: int) -> None:
    """`--scene ideal --method rodas5p`, as `gudgeon map` prints it to see a cell again."""
    options = ["--scene", "ideal", "--method", method, "--t-end", "0.1s", "--out", str(tmp_path), "--json"]
    result = CliRunner().invoke(app, ["run", "pendulum", *options])
    assert result.exit_code == code
    assert code or '"method": "rodas5p"' in result.stdout


ENGINE = """
gravity: [0, -9.81]
materials: {steel: {E: 207e9, nu: 0.3, density: 7850}}
bodies:
  crank: {length: 50 mm, mass: 0.3, inertia: 1e-4}
  rod: {length: 0.12, shape: {bar: 0.02, density: 7850, thickness: 0.005}}
  slider: {mass: 0.14, inertia: 1e-4}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 0.5235987755982988 + 62.83185307179586 rad/s * t}}
forces:
  coil: {spring_damper: [ground.O, slider.origin], stiffness: 500, free_length: 0.1, damping: 2}
  load: {force: slider.com, value: [-20 N*tanh(slider.vx/(0.01 m/s)), 0]}
start: {guess: {rod.theta: 0, slider.x: 0.17}}
bearings: {pin: {radius: 0.01, clearance: 2e-4, length: 0.02, bearing_material: steel, journal_material: steel}}
contacts:
  dry:
    normal: {law: lankarani_nikravesh, restitution: 0.9}
    friction: {law: modified_coulomb, mu: 0.03, v0: 1e-3, v1: 1e-2}
scenes: {dry: {play: {wristpin: {bearing: pin, contact: dry}}}}
"""

BRISTLES = """
gravity: [0, -9.81]
bodies:
  crank: {length: 0.09233574592306923, mass: 0.6784338406886801, inertia: 0.0005074849523498463}
  rod: {length: 0.38306294302680044, mass: 0.25395981354477287, inertia: 0.0030353442196275017}
  rocker: {length: 0.26783593510095566, mass: 0.2003203154975771, inertia: 0.0011300012169926069}
ground: {O: [0, 0], P: [0.34658927996353667, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  rockerpin: {revolute: [rod.head, rocker.head]}
  P: {revolute: [ground.P, rocker.tail]}
drives: {motor: {angle: crank, value: 0.3015112990502933 + 85.3310591267858 rad/s * t}}
start: {guess: {rod.theta: 0.644163896964609, rocker.theta: 1.3955901160166482}}
materials: {steel: {E: 201030062847.03894, nu: 0.2985957851711123}}
bearings:
  pin:
    radius: 0.007635186264425689
    clearance: 0.00039614509774595004
    length: 0.011570106330705428
    bearing_material: steel
    journal_material: steel
contacts:
  touch:
    normal: {law: gonthier, restitution: 0.35915545057288384, geometry: external}
    friction: {law: lugre, mu: 0.09918979574669233, v_s: 0.05048661313193051, mu_s: 0.14806005418705806,
      stiffness: 98960.35732041352, damping: 2.971429428843311}
scenes: {dry: {play: {crankpin: {bearing: pin, contact: touch}}}}
"""


@pytest.mark.parametrize(
    ("text", "end", "rtol"),
    [(ENGINE, 1.36, 1e-8), (BRISTLES, 0.0237, 4.088910741989136e-10), (BRISTLES, 0.0237, 3.819718299566743e-08)],
    ids=["corner", "return", "loose"],
)
def test_auto_does_not_try_steps_that_are_known_to_be_too_long(
    tmp_path: Path, text: str, end: float, rtol: float
) -> None:
    """Far too long a step is accepted where its estimate vanishes by chance; the audit found errors of 11 to 44 limits.

    `corner`: behind a corner of friction a step was as long as once fitted there, three times one just refused.
    `return`: a fast mode at rest was not seen when the explicit method took over, 30 times too long for its stability.
    """
    run = loader(tmp_path)(text, "dry").simulate(end, rtol=rtol, output=3, audit="full")
    assert run.diagnostics.notes == ()


RESTING = """
gravity: [0, -10]
materials: {steel: {E: 207 GPa, nu: 0.3}}
bodies: {rotor: {mass: 2 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, rotor.origin]}}
drives: {motor: {angle: rotor, value: 20 rad/s * t}}
bearings: {b: {radius: 10 mm, clearance: 0.5 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts: {metal: {normal: {law: flores, restitution: 0.4}}}
scenes: {dry: {play: {pin: {bearing: b, contact: metal}}}}
start: {play: {pin: {e: [0, -0.5 mm], rate: [0, 0]}}}
"""


def test_a_fixed_step_that_loses_energy_is_told(tmp_path: Path) -> None:
    """A pin that rests on metal: rk4's own step gives 4 % of the weight as the mean force."""
    simulation = loader(tmp_path)(RESTING, "dry")
    coarse = simulation.simulate(0.5, method="rk4", output=200)
    assert any(re.search("energy throughput of .* J: a step", note) for note in coarse.diagnostics.notes)
    assert simulation.simulate(0.5, output=200).diagnostics.notes == ()


JUMPS = BLOCK.replace("start: {{", "start: {{rates: {{a.vx: {v} m/s}}, ")
SPRING = "-(100 N/m)*a.x - "


@pytest.mark.parametrize("force", ["5 N*sign(a.vx)", "5 N*sign(a.vx - 0.1 m/s)", "where(a.vx > 0.1 m/s, 5 N, 0 N)"])
def test_a_force_that_jumps_at_a_speed_gets_a_remedy_that_works(load: Load, force: str) -> None:
    """Such a run ends where the force jumps to and fro; both messages give the remedies for both kinds of a jump."""
    with pytest.raises(SolverError, match=r"(?s)(without end|no longer advances).*dry_friction.*tanh\(\(v - v1\) / v0"):
        load(JUMPS.format(x=0.2, v=0, force=SPRING + force)).simulate(3.0, output=10)
    v1 = "0 m/s" if force.endswith("sign(a.vx)") else "0.1 m/s"
    smooth = f"5 N*tanh((a.vx - {v1}) / (1 mm/s))"
    smooth = smooth.replace("*tanh", "/2*(1 + tanh") + ")" if "where" in force else smooth
    assert load(JUMPS.format(x=0.2, v=0, force=SPRING + smooth)).simulate(3.0, output=10).t[-1] == 3.0
    rub = f"dry_friction: [ground.o, a.origin], direction: [1, 0], static: 5 N, kinetic: 5 N, speed: {v1}"
    stuck = JUMPS.format(x=0.2, v=0, force=SPRING + "0 N").replace("0 N, 0]}}", f"0 N, 0]}}, rub: {{{rub}}}}}")
    assert load(stuck).simulate(3.0, output=10).t[-1] == 3.0


def test_a_speed_that_friction_takes_for_rest_is_named(load: Load) -> None:
    """A belt at the speed below which a slip may stick: the message names that limit, and not the element in use."""
    rub = "{dry_friction: [ground.o, a.origin], direction: [1, 0], static: 5.886 N, kinetic: 3.924 N, speed: 1e-9 m/s}"
    spring = "{spring_damper: [ground.o, a.origin], stiffness: 1e10 N/m, free_length: 1 m}"
    text = BLOCK.format(x=1, force="0 N").replace("mass: 1 kg", "mass: 1e8 kg")
    text = text.replace("forces: {", f"forces: {{rub: {rub}, spring: {spring}, ")
    with pytest.raises(SolverError, match="slip below 1e-09 m/s") as caught:
        load(text).simulate(5.0)
    assert "use a dry_friction element" not in str(caught.value)
