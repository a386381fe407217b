"""Play of a slider in its guide: closed forms of rest, of a blow and of sliding to rest, an oracle, exact slopes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import AssemblyError
from gudgeon.exchange.fmu_description import iterate_outputs
from gudgeon.language.text_output import make_plain_console
from gudgeon.results.reports.comparison import build_tables, compute_scene_report
from gudgeon.simulation.simulation import Simulation
from tests.equations.subjects import make
from tests.kernels.test_tree_jacobian import Tree, slope
from tests.oracles.guided_block import GuidedBlock
from tests.programs import needs_compiler
from tests.slow import slow_rows_but

pytestmark = needs_compiler
HEAD = """\
format: gudgeon/1
name: guided
materials: {steel: {E: 206 GPa, nu: 0.3}}
guides:
  slot:
    gap: 0.2 mm
    half_length: 30 mm
    half_height: 12 mm
    corner_radius: 2 mm
    guide_material: steel
    slider_material: steel
"""
BLOCK = """\
gravity: [0, -9.81 m/s^2]
parameters: {lift: 0 mm, tilt: 0, v: 0 m/s, up: 0 m/s, turning: 0 rad/s}
bodies: {block: {mass: 0.5 kg, inertia: 2e-4 kg*m^2, com: [4 mm, -3 mm]}}
ground: {O: [0, 0]}
joints: {way: {translational: [ground.O, block.origin], axis: [1, 0]}}
start:
  set: {block.x: 4 mm}
  rates: {block.vx: v}
  play: {way: {offset: lift, tilt: tilt, offset_rate: up, tilt_rate: turning}}
contacts:
  soft: {normal: {law: hertz, stiffness: 3e8, restitution: 1, dissipation: none}}
  hard: {normal: {law: newton_restitution, restitution: 0.6}}
  rough:
    normal: {law: newton_restitution, restitution: 0}
    friction: {law: modified_coulomb, mu: 0.2, v0: 1e-4 m/s, v1: 1e-3 m/s}
events: {slow: {zero: block.vx - 1e-3 m/s, direction: falling, action: stop}}
scenes:
  soft: {play: {way: {guide: slot, contact: soft}}, simulate: {t_end: 10 ms}}
  hard: {play: {way: {guide: slot, contact: hard}}, simulate: {t_end: 10 ms}}
  rough: {play: {way: {guide: slot, contact: rough}}, simulate: {t_end: 1 s}}
"""
ARM = """\
gravity: [0, -9.81 m/s^2]
bodies:
  arm: {mass: 0.8 kg, inertia: 5e-3 kg*m^2, com: [0.1 m, 0], points: {slot: [0, 20 mm]}}
  block: {mass: 0.3 kg, inertia: 8e-5 kg*m^2}
ground: {O: [0, 0]}
joints:
  pivot: {revolute: [ground.O, arm.origin]}
  way: {translational: [arm.slot, block.origin], axis: [2, 0], angle: 0.3}
start:
  guess: {block.y: 0.04}
  set: {arm.theta: 0.2, block.x: 0.15}
  rates: {arm.omega: -3 rad/s, block.vx: 0.5}
  play: {way: {tilt_rate: 6 rad/s}}
contacts:
  elastic:
    normal: {law: hertz, stiffness: 2e8, restitution: 1, dissipation: none}
    friction: {law: threlfall, mu: 0.15, v_r: 0.2 m/s}
  bristles:
    normal: {law: hertz, restitution: 0.5, dissipation: hunt_crossley}
    friction: {law: dahl, mu: 0.15, presliding: 10 um}
  hard:
    normal: {law: newton_restitution, restitution: 0.3}
    friction: {law: threlfall, mu: 0.15, v_r: 0.2 m/s}
scenes:
  elastic: {play: {way: {guide: slot, contact: elastic}}, simulate: {t_end: 60 ms}}
  bristles: {play: {way: {guide: slot, contact: bristles}}, simulate: {t_end: 60 ms}}
  hard: {play: {way: {guide: slot, contact: hard}}, simulate: {t_end: 0.2 s}}
"""
FRAME = """\
gravity: [0, -9.81 m/s^2]
parameters: {lift: 0 mm}
bodies: {frame: {mass: 0.5 kg, inertia: 2e-4 kg*m^2}}
ground: {O: [10 mm, 0]}
joints: {way: {translational: [frame.origin, ground.O], axis: [1, 0]}}
start: {set: {frame.x: 10 mm}, play: {way: {offset: lift}}}
contacts: {soft: {normal: {law: hertz, stiffness: 3e8, restitution: 1, dissipation: none}}}
scenes: {soft: {play: {way: {guide: slot, contact: soft}}, simulate: {t_end: 10 ms}}}
"""
A, B, RHO, C = 0.03, 0.012, 0.002, 2e-4
M, J, COM, G = 0.5, 2e-4, (4e-3, -3e-3), 9.81


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("guide")


@cache
def made(folder: Path, text: str, scene: str, formulation: str = "reduced") -> Simulation:
    file = folder / f"guided_{abs(hash(text))}.yaml"
    file.write_text(HEAD + text, encoding="utf-8")
    return gudgeon.load(file, scene, formulation=formulation)


def lying(K: float, n: float) -> tuple[float, float, float, float]:
    """Tilt, offset and the penetrations (front, rear) of the block at rest: F = K δⁿ in each, moments in balance.

    A corner presses straight down where its disc's centre is, ±(a − ρ) cos φ + (b − ρ) sin φ from the block's point.
    """
    tilt = 0.0
    for _ in range(60):
        centre = COM[0] * math.cos(tilt) - COM[1] * math.sin(tilt)
        lever = (A - RHO) * math.cos(tilt)
        share = 0.5 + (centre - (B - RHO) * math.sin(tilt)) / (2.0 * lever)
        front, rear = ((M * G * x / K) ** (1.0 / n) for x in (share, 1.0 - share))
        tilt = math.asin((rear - front) / (2.0 * (A - RHO)))
    offset = -0.5 * (front + rear) + (B - RHO) * (math.cos(tilt) - 1.0) - C
    return tilt, offset, front, rear


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_a_block_lies_on_its_lower_wall_as_the_closed_form_says(folder: Path, formulation: str) -> None:
    tilt, offset, front, rear = lying(3e8, 1.5)
    simulation = made(folder, BLOCK, "soft", formulation)
    x = COM[0] * math.cos(tilt) - COM[1] * math.sin(tilt)
    given = {"parameters.lift": offset, "parameters.tilt": tilt, "start.set.block.x": x}
    run = simulation.simulate(1e-3, parameters=given, rtol=1e-10)
    assert run["way.front_lower.delta"][0] == pytest.approx(front, rel=1e-9)
    assert run["way.rear_lower.delta"][0] == pytest.approx(rear, rel=1e-9)
    assert front > 1.2 * rear and tilt < 0.0
    assert abs(run.a[0] / [G, G, G / A]).max() < 1e-9
    np.testing.assert_allclose(run["way.front_lower.Fn"] + run["way.rear_lower.Fn"], M * G, rtol=1e-9)
    assert run["way.front_upper.F"].max() == run["way.rear_upper.F"].max() == 0.0
    assert run["way.Fy"][-1] == pytest.approx(M * G, rel=1e-9)
    assert run["way.M"] == pytest.approx(M * G * x, rel=1e-8)  # about the slider's point, against its weight
    for corner in ("front_upper", "rear_upper"):  # never nearer to its wall than in the middle
        assert run.diagnostics.peak(f"way.{corner}").e_max == pytest.approx(run[f"way.{corner}.e"].max(), rel=1e-9)
        assert run[f"way.{corner}.e"].max() < -C


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_guide_hangs_on_a_slider_that_is_fixed(folder: Path, formulation: str) -> None:
    """Both upper corners are the ground's, and carry half of the frame each on its upper wall."""
    depth = (M * G / 2.0 / 3e8) ** (1.0 / 1.5)
    simulation = made(folder, FRAME, "soft", formulation)
    run = simulation.simulate(1e-3, parameters={"parameters.lift": C + depth}, rtol=1e-10)
    assert run["frame.y"][0] == pytest.approx(-C - depth, rel=1e-12)
    assert abs(run.a / [G, G, G / A]).max() < 1e-8
    for corner in ("front_upper", "rear_upper"):
        assert run[f"way.{corner}.Fn"] == pytest.approx(M * G / 2.0, rel=1e-8)
    assert run["way.front_lower.F"].max() == run["way.rear_lower.F"].max() == 0.0


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_a_corner_bounces_off_its_wall_by_newtons_law(folder: Path, formulation: str) -> None:
    """Λ = (1 + e) u m J/(J + m l²), l how far in front of the centre of mass the corner meets its wall."""
    given = {"parameters.tilt": 2e-3, "parameters.up": 0.4, "parameters.turning": 1.5, "parameters.v": 0.3}
    simulation = made(folder, BLOCK, "hard", formulation)
    run = simulation.simulate(output=np.array([0.0, 5e-4]), parameters=given | {"gravity.y": -1e-300}, rtol=1e-12)
    (blow,) = run.impacts
    assert simulation.source.clearances[int(blow["joint"])].name == "way.front_upper"
    tilt = 2e-3 + 1.5 * blow["t_on"]
    lever = (A - RHO) * math.cos(tilt) - (B - RHO) * math.sin(tilt)
    lever -= COM[0] * math.cos(tilt) - COM[1] * math.sin(tilt)
    vy, omega = run["block.vy"][0], 1.5
    u = vy + omega * lever
    impulse = 1.6 * u / (1 / M + lever**2 / J)
    assert blow["deltadot"] == pytest.approx(u, rel=1e-9)
    assert blow["F_peak"] == pytest.approx(impulse, rel=1e-9)
    assert run["block.vy"][1] == pytest.approx(vy - impulse / M, rel=1e-9)
    assert run["block.omega"][1] == pytest.approx(omega - impulse * lever / J, rel=1e-9)
    assert run["block.vx"][1] == pytest.approx(run["block.vx"][0], rel=1e-12)
    lost = 0.5 * (1 - 0.6**2) * u**2 / (1 / M + lever**2 / J)
    assert run["work.clearances"][1] == pytest.approx(-lost, rel=1e-8)
    assert run["energy.kinetic"][0] - run["energy.kinetic"][1] == pytest.approx(lost, rel=1e-8)


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_friction_stops_a_block_behind_its_closed_form_way(folder: Path, formulation: str) -> None:
    """(v² − v₁²)/(2 μ g), the loads of both corners in balance with friction below the centre of mass."""
    given = {"parameters.lift": -C, "parameters.v": 0.8}
    run = made(folder, BLOCK, "rough", formulation).simulate(1.0, parameters=given, rtol=1e-10, step=None)
    assert run.events["t"][0] == pytest.approx((0.8 - 1e-3) / (0.2 * G), rel=1e-8)
    assert run["block.x"][-1] - run["block.x"][0] == pytest.approx((0.64 - 1e-6) / (0.4 * G), rel=1e-8)
    front, rear = A - RHO - COM[0], A - RHO + COM[0]
    height = B + COM[1]  # of the centre of mass over the wall
    N_front = M * G * (rear + 0.2 * height) / (front + rear)
    middle = len(run.t) // 2
    assert run["way.front_lower.Fn"][middle] == pytest.approx(N_front, rel=1e-8)
    assert run["way.rear_lower.Fn"][middle] == pytest.approx(M * G - N_front, rel=1e-8)
    assert run["way.F"][middle] == pytest.approx(M * G * math.hypot(1.0, 0.2), rel=1e-8)
    assert abs(run["energy.residual"]).max() < 1e-9


def test_a_hard_start_within_the_wall_is_told(folder: Path) -> None:
    with pytest.raises(AssemblyError, match="way"):
        made(folder, BLOCK, "hard").simulate(1e-3, parameters={"parameters.lift": 1.1 * C})


ORACLE = GuidedBlock((0.8, 5e-3, 0.1), (0.3, 8e-5), 0.02, (A, B, RHO), C, 0.3, 2e8, 1.5, 0.15, 0.2)


@cache
def swung() -> tuple[Any, Any]:
    """The oracle's run from the file's start."""
    t = np.linspace(0.0, 0.025, 51)
    phi, omega = 0.2, -3.0
    s = (0.15 + 0.02 * math.sin(phi)) / math.cos(phi)  # along the slot
    y = s * math.sin(phi) + 0.02 * math.cos(phi)
    rate = (0.5 + omega * y) / math.cos(phi)
    vy = omega * 0.15 + rate * math.sin(phi)
    return t, ORACLE.run(np.array([phi, 0.15, y, phi + 0.3, omega, 0.5, vy, omega + 6.0]), t)


@pytest.mark.parametrize(
    ("method", "formulation"),
    slow_rows_but(
        [("dop853", "reduced"), ("rodas5p", "reduced"), ("rk4", "reduced")],
        [
            ("dop853", "reduced"),
            ("dop853", "full"),
            ("rodas5p", "reduced"),
            ("radau5", "full"),
            ("rk4", "reduced"),
        ],
    ),
)
def test_a_slot_that_swings_against_an_oracle(folder: Path, method: str, formulation: str) -> None:
    t, expected = swung()
    settings: dict[str, Any] = {"step": 2e-6} if method == "rk4" else {"rtol": 1e-9}
    run = made(folder, ARM, "elastic", formulation).simulate(output=t, method=method, **settings)
    assert len(run.impacts) > 12 and {*run.impacts["joint"].tolist()} == {0, 1, 2, 3}
    names = ("arm.theta", "block.x", "block.y", "block.theta", "arm.omega", "block.vx", "block.vy", "block.omega")
    found = np.stack([run[name] for name in names], axis=1)
    np.testing.assert_allclose(found[:, :4], expected[:, :4], atol=1e-6, rtol=0.0)
    np.testing.assert_allclose(found[:, 4:], expected[:, 4:], atol=2e-3, rtol=0.0)  # of 17 rad/s
    wrench = np.stack([run[f"way.{name}"] for name in ("Fx", "Fy", "M")], axis=1)  # Newton and Euler: the block has it
    moved = np.stack([0.3 * run["block.ax"], 0.3 * (run["block.ay"] + G), 8e-5 * run["block.alpha"]], axis=1)
    np.testing.assert_allclose(wrench, moved, atol=1e-9 * abs(moved).max(), rtol=0.0)
    at = [ORACLE.contacts(y) for y in found]
    for k, corner in enumerate(("front_upper", "front_lower", "rear_upper", "rear_lower")):
        own = [one[k] for one in at]
        np.testing.assert_allclose(run[f"way.{corner}.delta"], [delta for delta, *_ in own], atol=1e-13)
        np.testing.assert_allclose(run[f"way.{corner}.Fn"], [F_n for _, F_n, *_ in own], rtol=1e-6, atol=1e-5)
        np.testing.assert_allclose(run[f"way.{corner}.Ft"], [F_t for _, _, F_t, *_ in own], rtol=1e-6, atol=1e-5)


def accelerated(q: Any, v: Any, a: Any, h: float) -> np.ndarray:
    """Penetrations that corners would have a moment later, by the oracle's geometry: (4,), of arm and block."""
    x = q + h * v + 0.5 * h**2 * a
    return np.array([delta for delta, *_ in ORACLE.contacts(np.array([x[2], x[3], x[4], x[5], *[0.0] * 4]))])


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_rigid_corners_stay_on_walls_that_swing(folder: Path, formulation: str) -> None:
    """δ̈ = 0 where closed, with ω̇ and ω of the guide in it; forces push, and what they take is in the works."""
    run = made(folder, ARM, "hard", formulation).simulate(0.15, output=300, rtol=1e-10)
    closed = run.state > 0
    assert closed.sum(axis=1).max() == 2 and closed.any(axis=1).sum() > 50
    assert abs(run["energy.residual"]).max() < 1e-8 * run.diagnostics.energy_turned_over
    for k in np.flatnonzero(closed.any(axis=1))[::10]:
        now, h = (run.q[k], run.v[k], run.a[k]), 1e-4
        ahead, here, behind = (accelerated(*now, step) for step in (h, 0.0, -h))
        assert abs(((ahead - 2.0 * here + behind) / h**2)[closed[k]]).max() < 1e-3
        assert abs(((ahead - behind) / (2.0 * h))[closed[k]]).max() < 1e-6
        assert abs(here[closed[k]]).max() < 1e-14
    names = [f"way.{one}.Fn" for one in ("front_upper", "front_lower", "rear_upper", "rear_lower")]
    forces = np.stack([run[name] for name in names], axis=1)
    assert (forces[closed] > 0.0).all() and not forces[~closed].any()


@pytest.mark.parametrize("seed", range(4))
def test_slopes_are_those_of_the_equations(folder: Path, seed: int) -> None:
    """Against a complex step of forces at the place of contact: corners in and out of walls, latched and not."""
    subject, rng = make((HEAD + ARM).encode(), "guided", "bristles"), np.random.default_rng(seed)
    start = made(folder, ARM, "elastic").start()
    y = np.concatenate([start.q + rng.uniform(-0.3, 0.3, 6), rng.uniform(-0.05, 0.05, 6)])
    phi, along = y[2], rng.uniform(-0.2, 0.2)
    rotation = np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
    turned, offset = phi + 0.3, rng.uniform(-1.5, 1.5) * C
    pivot = y[:2] - rotation @ [0.1, 0.0]
    y[5] = turned + rng.choice([-1.0, 1.0]) * rng.uniform(1.1, 2.0) * C / (A - RHO)
    y[3:5] = pivot + rotation @ [along, 0.02 + offset]
    memory = np.concatenate([np.where(rng.uniform(size=4) < 0.5, 0.1, math.nan), rng.uniform(-1e-5, 1e-5, 4)])
    J = subject.compare(0.0, y, memory)
    assert abs(J[6:12, :6]).max() > 1e6  # some corner is pressed


def test_slopes_in_tree_coordinates(folder: Path) -> None:
    tree = Tree(made(folder, ARM, "elastic"), 1.5e-3)
    assert np.isfinite(tree.memory).sum() >= 2
    J, _ = tree.jacobian()
    scale = abs(J).max(axis=1) + 1e-300
    for k in range(2 * tree.n):
        h = 2e-8 if k < tree.n else 1e-4 * max(1.0, abs(tree.y[k]))
        found = slope(lambda x, k=k: tree.rates(tree.t, tree.y + x * np.eye(len(tree.y))[k]), h)
        assert abs(J[:, k] - found) / scale == pytest.approx(0.0, abs=1e-5)


def test_equations_in_numpy_are_those_in_c(folder: Path) -> None:
    simulation = made(folder, ARM, "elastic")
    run = simulation.simulate(2e-3, output=40)
    numpy_model, compiled = simulation.model.numpy(), simulation.compiled
    p, parameters = numpy_model.prepare(), compiled.prepare(*np.zeros((2, len(compiled.source.parameters))))
    assert (run.state > 0).any()
    for t, q, v, contact_state in zip(run.t, run.q, run.v, run.memory, strict=True):
        actual = numpy_model.dynamics(t, q, v, p, contact_state)
        expected = compiled.rhs(t, np.concatenate([q, v]), parameters, contact_state)[6:12]
        np.testing.assert_allclose(actual.a, expected, rtol=1e-9, atol=1e-9 * abs(expected).max())


def test_many_runs_are_the_single_ones(folder: Path) -> None:
    simulation = made(folder, ARM, "elastic")
    speeds = [{"start.rates.arm.omega": -3.0 + 0.2 * k} for k in range(6)]
    for method in ("dop853", "rodas5p"):
        batch = simulation.simulate_many(speeds, 0.01, output=10, method=method, rtol=1e-10)
        for k, one in enumerate(speeds):
            run = simulation.simulate(0.01, output=10, method=method, rtol=1e-10, parameters=one)
            np.testing.assert_allclose(batch["block.theta"][k], run["block.theta"], atol=1e-7)
            np.testing.assert_allclose(batch["way.rear_lower.Fn"][k], run["way.rear_lower.Fn"], atol=1e-2)
    assert simulation.source.lane_file


def test_a_run_goes_on_in_contact(folder: Path) -> None:
    simulation = made(folder, ARM, "elastic")
    whole = simulation.simulate(output=np.array([0.0, 1.5e-3, 5e-3]), rtol=1e-11)
    first = simulation.simulate(1.5e-3, output=1, rtol=1e-11)
    assert (first.state[-1] > 0).sum() >= 2
    rest = simulation.simulate(5e-3, output=1, rtol=1e-11, start=first.final)
    np.testing.assert_allclose(rest.q[-1], whole.q[-1], atol=1e-9)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"tilt": 3.0}, "tilt is 171.9 deg"),
        ({"tilt": -math.pi / 2}, "tilt is 90 deg"),
        (
            {"guides.slot.half_length": 6e-3, "guides.slot.half_height": 9e-3, "guides.slot.gap": 3e-3},
            "can turn over in its",
        ),
    ],
)
def test_a_slider_that_turns_over_is_refused(numbers: dict[str, float], message: str, folder: Path) -> None:
    """Its corners know the wall on their own side alone: it went through the other one without a word."""
    block = made(folder, BLOCK, "soft")
    with pytest.raises(AssemblyError, match=message):
        block.simulate(1e-3, parameters=numbers)
    assert message in str(block.simulate_many([{}, numbers], 1e-3).failures[0].error)


def test_force_and_moment_of_a_guide_are_shown(folder: Path) -> None:
    """In the table of runs, the figure, a run's report and an FMU: at samples, as its corners' over all steps are."""
    pytest.importorskip("matplotlib")
    from gudgeon.results.figures.plots import draw_run_figure

    run = made(folder, BLOCK, "rough").simulate(0.02, parameters={"parameters.lift": -C, "parameters.v": 0.8})
    report = compute_scene_report(run, None, ["block.x"])
    (force, moment), at = report.guides, np.abs(run["way.M"]).argmax()
    assert (force.name, moment.name) == ("way.F", "way.M") and force.peak == run["way.F"].max()
    assert moment.peak == run["way.M"][at] and moment.t == run.t[at] and moment.peak != 0.0
    console = make_plain_console(200)
    with console.capture() as message:
        for table in build_tables("", [report], 200):
            console.print(table)
    assert "way.M" in message.get() and "N·m" in message.get()
    (ax,) = [ax for ax in _axes(draw_run_figure({"rough": run}, {}, ["block.x"])) if "moment at way" in ax.get_ylabel()]
    np.testing.assert_allclose(ax.lines[0].get_ydata(), 1e3 * run["way.M"], rtol=1e-14)  # mN m
    assert {"way.Fx", "way.Fy", "way.M"} <= {name for name, *_ in iterate_outputs(run.source)}  # of an FMU
    shown = run.report()
    assert "moment on the slider" in str(shown) and shown.to_dict()["guides"]["way"]["M"]["peak"] == moment.peak


def _axes(picture: Any) -> Iterator[Any]:
    for part in picture.subfigs or [picture]:
        yield from part.axes if part is picture else _axes(part)
