"""Driven chains: what the drives determine through loops is evaluated; against closed forms and all coordinates."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import SingularError, SolverError
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.reduction.driven_loops import find_blocks
from gudgeon.generator.reduction.reduction import reduce_model
from gudgeon.loading import compiler
from gudgeon.loading.build import compile_kernels
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.kernels.test_tree_jacobian import slope
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_mechanism import random_mechanism
from tests.programs import needs_compiler
from tests.reduction.reduced import Numbers, Reduced
from tests.reduction.test_reduction import NAN, check_state
from tests.slow import slow_but

pytestmark = needs_compiler
METHODS = Path(__file__).parents[1] / "mechanisms/methods"
FOUR_BAR = (METHODS / "driven_four_bar.yaml").read_text(encoding="utf-8")
MOTOR = "{angle: crank, value: 0.5 + omega * t}"
RUB = "  rub: {dry_friction: [%s, %s], direction: [1, 0], static: 0.5 N, kinetic: 0.3 N}\n"
PLAY = """
materials: {steel: {E: 207 GPa, nu: 0.3}}
bearings: {bush: {radius: 10 mm, clearance: 0.2 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts:
  metal:
    normal: {law: lankarani_nikravesh, restitution: 0.9}
    friction: {law: modified_coulomb, mu: 0.03, v0: 1e-3 m/s, v1: 1e-2 m/s}
scenes: {worn: {play: {pivot: {bearing: bush, contact: metal}}}}
"""


@pytest.fixture(autouse=True)
def not_optimised(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiling would take longer than everything else."""
    monkeypatch.setattr(compiler, "FLAGS", ("-O0", *(flag for flag in compiler.FLAGS if not flag.startswith("-O"))))


def changed_four_bar(motor: str = MOTOR, forces: str = "", other: str = "", more: str = "") -> str:
    """The driven four-bar with other drives or forces."""
    text = FOUR_BAR.replace(MOTOR, motor).replace("forces:\n", "forces:\n" + forces)
    for old, new in (pair.split(" -> ") for pair in other.split("; ") if pair):
        assert old in text
        text = text.replace(old, new)
    return text + more


def four_bar(tmp_path: Path, scene: str = "ideal", formulation: str = "reduced", **changed: str) -> Simulation:
    file = tmp_path / "driven_four_bar.yaml"
    file.write_text(changed_four_bar(**changed), encoding="utf-8")
    return gudgeon.load(str(file), scene=scene, formulation=formulation)


def test_blocks_of_a_pattern() -> None:
    """Square parts only: what a free coordinate reaches is free, what is banned takes its followers with it."""
    pattern = [{0, 1}, {0, 1}, {1, 2}, {3, 4}, {2, 5}]  # a dyad, two that follow it, a free loop
    assert [set(block.columns) for block in find_blocks(pattern, 6, set())] == [{0, 1}, {2}, {5}]
    assert [set(block.columns) for block in find_blocks(pattern, 6, {2})] == [{0, 1}]
    assert find_blocks(pattern, 6, {0}) == []
    assert find_blocks([{0, 1}, {1, 2}], 3, set()) == []
    assert find_blocks([set(range(9)) for _ in range(9)], 9, set()) == []  # too large: solved with its multipliers


@pytest.mark.parametrize(("method", "step"), [("dop853", None), ("rodas5p", None), ("rk4", 1e-4)])
def test_table_of_the_shaker_in_closed_form(method: str, step: float | None) -> None:
    """y = r sin θ + √(l² − r² cos² θ), exactly at every sample, whatever is integrated beside it.

    ωt up to 19 rad is rounded to 4e-15: times ω r and ω² r that is what rates may differ by.
    """
    r, rod, omega = 0.01, 0.06, 60.0 * math.pi
    shaker = gudgeon.load("shaker")
    assert (shaker.source.tree_coordinates, shaker.source.closures) == (("arm",), ())
    assert (shaker.source.driven_loop_coordinates, shaker.source.driven_loop_equations) == (("rod",), ("guide.offset",))
    run = shaker.simulate(0.1, output=300, method=method, step=step)
    s, c = np.sin(omega * run.t), np.cos(omega * run.t)
    root = np.sqrt(rod**2 - (r * c) ** 2)
    assert run["table.y"] == pytest.approx(r * s + root, abs=2e-16)
    assert run["table.vy"] == pytest.approx(omega * r * c * (1.0 + r * s / root), abs=5e-14)
    bend = r**2 * (c**2 - s**2) / root - (r**2 * s * c) ** 2 / root**3
    assert run["table.ay"] == pytest.approx(omega**2 * (bend - r * s), abs=5e-11)


def test_the_shaker_holds_its_pendulum_upright_when_it_is_fast_enough() -> None:
    """Stephenson's condition a ω > √(2 g l) for a small swing; l = .08 m asks for 1196 rpm."""
    shaker = gudgeon.load("shaker")
    fast, slow = (shaker.simulate(2.0, parameters={"omega": f"{rpm} rpm"}) for rpm in (1800, 700))
    assert abs(fast["lean"]).max() < math.radians(25.0)
    assert abs(slow["lean"]).max() > math.pi / 2.0
    assert fast.diagnostics.energy_residual < 1e-7 * fast.diagnostics.energy_turned_over


VARIANTS = {
    "as it is": ({}, ("coupler", "rocker")),
    "a drive with corners": (
        {"motor": "{angle: crank, value: 0.5 + smooth_step(t, 0.1 s, 0.3 s) * 2}"},
        ("coupler", "rocker"),
    ),
    "a cylinder": (
        {
            "motor": "{distance: [ground.W, rocker.head], value: 170 mm + 10 mm * sin(8*t)}",
            "other": "guess: { -> guess: {crank.theta: 30 deg, ",
        },
        ("crank", "coupler", "rocker"),
    ),
    "a spring within": (
        {"forces": "  twist: {rotational_spring_damper: [coupler, rocker], stiffness: 2 N*m/rad, free_angle: 0.2}\n"},
        ("coupler", "rocker"),
    ),
    "friction on what is free": ({"forces": RUB % ("rocker.head", "bob.origin")}, ("coupler", "rocker")),
    "friction within: it stays solved": ({"forces": RUB % ("crank.head", "rocker.head")}, ()),
    "a rate that jumps: it stays solved": ({"motor": "{angle: crank, value: 0.5 + ramp(t, 0.1 s, 0.3 s) * 2}"}, ()),
    "play": ({"more": PLAY, "scene": "worn"}, ("coupler", "rocker")),
}


APART = "a drive with corners", "friction on what is free", "play"


@pytest.mark.parametrize("name", [name for name in VARIANTS if name not in APART])
def test_what_is_evaluated_and_what_stays_solved(name: str) -> None:
    changed, chain = VARIANTS[name]
    found = reduce_model(derive_scene(changed_four_bar(**changed).encode(), "f", "ideal").copy_mutable()).driven_loops
    assert sorted(found.names if found else ()) == sorted(chain)


@pytest.mark.parametrize("name", slow_but(APART, VARIANTS))
def test_trajectories_reactions_and_drives_of_all_coordinates(name: str, tmp_path: Path) -> None:
    """Both formulations from start to end; drives, joints within the chain, and the balance of energy."""
    changed, chain = VARIANTS[name]
    reduced, full = (four_bar(tmp_path, formulation=kind, **changed) for kind in ("reduced", "full"))
    assert sorted(reduced.source.driven_loop_coordinates) == sorted(chain)
    t_end = 0.02 if name == "play" else 0.5
    for method in ("dop853", "rodas5p"):
        one, two = (scene.simulate(t_end, output=50, rtol=1e-10, method=method) for scene in (reduced, full))
        assert one.q == pytest.approx(two.q, abs=1e-8)
        assert one.v == pytest.approx(two.v, abs=1e-6)
        if name != "play":  # whose forces, of 1e10 N/m, are no smoother than the positions
            drive = "motor.force" if name == "a cylinder" else "motor.torque"
            for series in (drive, "pin.Fx", "base.Fy", "pivot.Fx"):
                assert one[series] == pytest.approx(two[series], rel=1e-6, abs=1e-6 * abs(two[series]).max())
            assert one.diagnostics.energy_residual < 1e-7 * one.diagnostics.energy_turned_over


@pytest.mark.parametrize(
    ("name", "chain"),
    [
        pytest.param("geared_chain", ("coupler", "rocker", "rod"), marks=pytest.mark.slow),
        ("trammel", ("bar.x", "bar.y")),
    ],
)
def test_chains_in_a_row_and_of_lengths(name: str, chain: tuple[str, ...]) -> None:
    """One group drives the next through a gear; positions of a body that no other one places."""
    reduced, full = (gudgeon.load(str(METHODS / f"{name}.yaml"), formulation=kind) for kind in ("reduced", "full"))
    assert (reduced.source.tree_coordinates, tuple(sorted(reduced.source.driven_loop_coordinates))) == (("arm",), chain)
    for method in ("dop853", "rodas5p"):
        one, two = (scene.simulate(1.0, output=50, rtol=1e-10, method=method) for scene in (reduced, full))
        assert one.q == pytest.approx(two.q, abs=1e-8)
        assert one["motor.torque"] == pytest.approx(two["motor.torque"], abs=1e-6 * abs(two["motor.torque"]).max())
        if name == "trammel":  # the points slide along the axes: r = (b cos θ, −a sin θ)
            angle = 0.5 + 5.0 * one.t
            assert one["bar.x"] == pytest.approx(0.1 * np.cos(angle), abs=1e-16)
            assert one["bar.y"] == pytest.approx(-0.2 * np.sin(angle), abs=1e-16)


def test_rates_are_the_derivatives(tmp_path: Path) -> None:
    """Of each coordinate in turn: its rate, second and third rate against differences in t."""
    simulation = four_bar(tmp_path)
    start = simulation.start()
    reduced = Reduced(simulation.compiled, simulation.p)
    s, _ = reduced.reduce(0.0, start.q, start.v)

    def along(t: float) -> np.ndarray:
        c, rates = reduced.chains(t, s)
        return np.concatenate([c[None], rates])

    for t in (0.0, 0.01, -0.02):
        found = slope(lambda h, t=t: along(t + h), 1e-3)
        assert along(t)[1:] == pytest.approx(found[:3], rel=1e-9, abs=1e-9)


def with_chain(text: str, seed: int) -> str:
    """A driven crank-rocker beside a random linkage; a slide that follows it carries a spring to the last body."""
    rng = np.random.default_rng(1000 + seed)
    a, b, c, d = np.array([0.1, 0.35, 0.3, 0.25]) * rng.uniform(0.95, 1.05, 4)
    last = [line.split(":")[0].strip() for line in text.splitlines() if line.startswith("  b")][-1]
    x, y = rng.uniform(-0.5, 0.5, 2)
    bodies = "".join(
        f"  {name}: {{length: {length}, mass: {rng.uniform(0.5, 1.5)}, inertia: {rng.uniform(0.01, 0.05)}}}\n"
        for name, length in (("crank", a), ("coupler", b), ("rocker", c), ("rod", 0.8))
    )
    bodies += "  slider: {mass: 1.5, inertia: 0.01}\n"
    joints = (
        "  k0: {revolute: [ground.K, crank.tail]}\n  k1: {revolute: [crank.head, coupler.tail]}\n"
        "  k2: {revolute: [coupler.head, rocker.head]}\n  k3: {revolute: [ground.L, rocker.tail]}\n"
        "  k4: {revolute: [rocker.head, rod.tail]}\n  k5: {revolute: [rod.head, slider.origin]}\n"
        f"  k6: {{translational: [ground.K, slider.origin], axis: [1, {rng.uniform(-0.2, 0.2)}]}}\n"
    )
    angle = rng.uniform(0.0, 6.0)
    drive = f"  turn: {{angle: crank, value: {angle} + {rng.uniform(1.0, 4.0)} * t + 0.2 * sin(3 * t)}}\n"
    tie = f"  tie: {{spring_damper: [slider.origin, {last}.com], stiffness: 50, free_length: 0.1, damping: 0.3}}\n"
    text = text.replace("bodies:\n", "bodies:\n" + bodies).replace("joints:\n", "joints:\n" + joints)
    text = text.replace("ground: {", f"ground: {{K: [{x}, {y}], L: [{x + d}, {y}], ")
    for section, line in (("drives", drive), ("forces", tie)):
        has = f"{section}:\n" in text
        text = text.replace(f"{section}:\n", f"{section}:\n{line}") if has else text + f"{section}:\n{line}"
    guess = f"crank.theta: {angle}, coupler.theta: 0.8, rocker.theta: 1.6, rod.theta: -0.3, slider.x: {x + 1.0}, "
    return text.replace("start: {guess: {", "start: {guess: {" + guess)


@pytest.mark.parametrize("seed", slow_but([0], range(8)))
def test_random_mechanisms_beside_a_driven_chain(seed: int) -> None:
    """Accelerations, powers and remaining multipliers at the start and at states around it."""
    text = with_chain(to_yaml(random_mechanism(seed)), seed)
    model = derive_scene(text.encode(), f"random_{seed}.yaml", "ideal")
    source = generate_c(model)
    simulation = Simulation(CompiledModel(source, compile_kernels(source)), Path("random.yaml"))
    start = simulation.start()
    reduced, numbers = Reduced(simulation.compiled, simulation.p), Numbers(model, simulation.p)
    assert ({"coupler", "rocker"} <= set(source.driven_loop_coordinates)) == (model.degrees_of_freedom > 0)
    s, rate = reduced.reduce(0.0, start.q, start.v)
    for k in range(3):
        rng = np.random.default_rng(k)
        near = reduced.close(0.01 * k, s + rng.normal(0.0, 1e-3 * k, len(s)), rate + rng.normal(0.0, 0.1 * k, len(s)))
        check_state(reduced, numbers, 0.01 * k, *near, NAN)


def test_a_parallelogram_keeps_its_branch_where_links_lie_in_line(tmp_path: Path) -> None:
    """Crank and rocker stay parallel through four change points; the other branch would be a crossed one."""
    other = "crank: {length: 40 mm -> crank: {length: 80 mm; coupler: {length: 120 mm -> coupler: {length: 100 mm; "
    other += "coupler.theta: 30 deg, rocker.theta: 80 deg -> coupler.theta: 0 deg, rocker.theta: 0.5"
    simulation = four_bar(tmp_path, other=other)
    assert simulation.source.driven_loop_coordinates
    for method, step in (("dop853", None), ("rk4", 1e-3)):
        run = simulation.simulate(2.3, output=100, method=method, step=step)
        assert run["rocker.theta"] == pytest.approx(run["crank.theta"], abs=1e-11)


def test_a_dead_centre_is_named_where_it_is(tmp_path: Path) -> None:
    """A table that is driven beyond the reach of crank and rod: t = arcsin(10/12)/3 s; also at the start."""
    text = (Path(gudgeon.load("shaker").file)).read_text(encoding="utf-8")
    driven = "{coordinate: table.y, value: middle + 12 mm * sin(3*t) - sinking * t}"
    text = text.replace("{angle: crank, value: omega * t}", driven).replace("guess: {", "guess: {crank.theta: 10 deg, ")
    text = text.replace("parameters:\n", "parameters:\n  middle: 60 mm\n  sinking: 0 mm/s\n")
    file = tmp_path / "shaker.yaml"
    file.write_text(text, encoding="utf-8")
    table = gudgeon.load(str(file))
    assert set(table.source.driven_loop_coordinates) == {"crank", "rod"}
    for method, step, close in (("dop853", None, 1e-8), ("rodas5p", None, 1e-8), ("rk4", 1e-4, 1e-4)):
        with pytest.raises(SolverError, match="dead centre.*(motor|guide.offset)") as failed:
            table.simulate(1.0, method=method, step=step)
        assert failed.value.time == pytest.approx(math.asin(10.0 / 12.0) / 3.0, abs=close)
    with pytest.raises(SingularError, match="dead centre at t = 0 s"):
        table.simulate(1.0, parameters={"middle": "70 mm", "sinking": "37 mm/s"})


def test_a_run_goes_on_from_where_another_ended(tmp_path: Path) -> None:
    """Half and half is the whole, and many runs are bit for bit what single ones are."""
    simulation = four_bar(tmp_path)
    whole = simulation.simulate(0.4, output=[0.0, 0.2, 0.4], rtol=1e-11)
    half = simulation.simulate(0.2, output=2, rtol=1e-11)
    rest = simulation.simulate(0.4, output=2, start=half.final, rtol=1e-11)
    assert rest.q[-1] == pytest.approx(whole.q[-1], abs=1e-10)
    batch = simulation.simulate_many({"omega": [4.0, 6.0]}, 0.2, output=4)
    single = simulation.simulate(0.2, output=4, parameters={"omega": 6.0})
    assert np.array_equal(batch["arm.theta"][1], single["arm.theta"])
