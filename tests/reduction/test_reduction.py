"""The reduced formulation against the absolute one, which other tests compare with dense oracles."""

from __future__ import annotations

from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.kernels.reduced import DYNAMICS, make_reduced_kernels
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.generator.reduction.reduction import reduce_model
from gudgeon.loading import compiler
from gudgeon.loading.build import compile_kernels
from gudgeon.model.compiled import CompiledModel
from gudgeon.simulation.simulation import Simulation
from tests.equations.models import random_model
from tests.oracles import numpy_linkage
from tests.oracles.linkage_yaml import to_yaml
from tests.oracles.random_linkage import Case
from tests.oracles.random_mechanism import random_mechanism
from tests.programs import needs_compiler
from tests.reduction.reduced import Numbers, Reduced
from tests.slow import slow_but

pytestmark = needs_compiler
SHIPPED = [
    ("nine_bar_press", "ideal"),
    ("nine_bar_press", "dry"),
    ("nine_bar_press", "lubricated"),
    ("andrews_squeezer", "ideal"),
    ("four_bar", "ideal"),
    ("slider_crank", "ideal"),
    ("slider_crank_spring", "ideal"),
    ("pendulum", "ideal"),
    ("car_axis", "ideal"),
    ("belt_block", "ideal"),
    ("bouncing_ball", "ideal"),
    ("n_four_bar", "ideal"),
    ("shaker", "ideal"),
]
LARGE = [("nine_bar_press", "dry"), ("andrews_squeezer", "ideal"), ("car_axis", "ideal"), ("n_four_bar", "ideal")]


def but(*rare: tuple[str, str]) -> list[Any]:
    """Shipped scenes; `rare` ones are slow, and so are large ones."""
    return [case if case not in (*LARGE, *rare) else pytest.param(*case, marks=pytest.mark.slow) for case in SHIPPED]


QUICK = (4, 5, 8, 25)  # every joint, drive and force element; 25: a slide on a turning body closes a loop
NAN = np.full(1, np.nan)


@pytest.fixture(autouse=True)
def not_optimised(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiling would take longer than everything else."""
    monkeypatch.setattr(compiler, "FLAGS", ("-O0", *(flag for flag in compiler.FLAGS if not flag.startswith("-O"))))


@cache
def shipped(name: str, scene: str) -> tuple[Model, Simulation]:
    data = resources.files("gudgeon.mechanisms").joinpath(f"{name}.yaml").read_bytes()
    model = derive_scene(data, f"{name}.yaml", scene)
    source = generate_c(model)
    return model, Simulation(CompiledModel(source, compile_kernels(source)), Path(f"{name}.yaml"))


def close(got: np.ndarray, want: np.ndarray, relative: float, least: float = 1e-3) -> bool:
    """Relative to the largest entry, or to `least`."""
    return bool(np.all(abs(got - want) <= relative * max(least, float(np.max(abs(want), initial=0.0)))))


def check_state(
    reduced: Reduced, numbers: Numbers, t: float, s: np.ndarray, rate: np.ndarray, memory: np.ndarray
) -> None:
    """Accelerations of all bodies, multipliers and powers at a state that closes its loops."""
    library = reduced.library
    numbers.chains = reduced.chains(t, s)
    q, v = reduced.expand(t, s, rate)
    assert close(library.phi(t, q, reduced.p), np.zeros(len(library.source.equations)), 1e-12, 1.0)
    assert close(
        library.phi_q(t, q, reduced.p) @ v - library.nu(t, q, reduced.p), np.zeros(1), 1e-11, abs(v).max() + 1.0
    )
    want = library.evaluate([t], q[None], v[None], memory[None], reduced.p)
    a, multipliers, power = reduced.accelerations(t, s, rate, memory)
    system = numbers.system
    entries = [(body, c) for body in system.model.bodies for c in range(3)]
    bias = numbers([system.motions[body.name].bias[c] for body, c in entries], t, s, rate)
    jacobian = [(i, k, e) for i, (b, c) in enumerate(entries) for k, e in system.motions[b.name].jacobian[c].items()]
    got = bias.copy()
    for (i, k, _), value in zip(jacobian, numbers([e for *_, e in jacobian], t, s, rate), strict=True):
        got[i] += value * a[k]
    assert close(got, want.a[0], 1e-9, 1.0)
    index = {row.name: r for r, row in enumerate(library.source.equations)}
    shares = [numbers.system.tree.find_multiplier_terms(name) for name in library.source.closures]
    carried = [sum(sign * want.multipliers[0][index[row]] for row, sign in share.items()) for share in shares]
    assert close(multipliers, np.array(carried), 1e-8, float(abs(want.multipliers).max(initial=0.1)))
    assert close(power, want.power[0], 1e-9, max(1.0, float(abs(want.multipliers).max(initial=0.0))))
    if hasattr(library.lib, "gudgeon_accelerations_by_absolute_equations"):
        assert close(reduced.rescue(t, s, rate, memory), a, 1e-8, 1.0)


@pytest.mark.parametrize(("name", "scene"), but(("nine_bar_press", "ideal")))
def test_shipped_mechanisms(name: str, scene: str) -> None:
    """At the start and at states around it; journals free, then in contact."""
    model, simulation = shipped(name, scene)
    library, start = simulation.compiled, simulation.start()
    reduced, numbers = Reduced(library, simulation.p), Numbers(model, simulation.p)
    s, rate = reduced.reduce(0.0, start.q, start.v)
    q, v = reduced.expand(0.0, s, rate)
    size = float(abs(start.q).max())
    assert close(q, start.q, 1e-12, size)
    assert close(v, start.v, 1e-12, float(abs(start.v).max(initial=1.0)))
    for seed in range(4):
        rng = np.random.default_rng(seed)
        t = 0.01 * seed
        near = s + rng.normal(0.0, 1e-3 * seed, len(s)) * size
        here = reduced.close(t, near, rate + rng.normal(0.0, 0.1 * seed, len(s)))
        memory = np.full(library.n_discrete_states, np.nan) if seed % 2 else np.full(library.n_discrete_states, 0.02)
        memory[len(model.clearances) :] = seed % 3 - 1.0  # frictions: stick, or slip either way
        check_state(reduced, numbers, t, *here, memory if memory.size else NAN)


def reduced_case(case: Case) -> tuple[Model, Reduced]:
    model = derive_scene(to_yaml(case).encode(), f"random_{case.seed}.yaml", "ideal")
    source = generate_c(model)
    library = CompiledModel(source, compile_kernels(source))
    slots = len(source.parameters)
    return model, Reduced(library, library.prepare(np.zeros(slots), np.zeros(slots, dtype=bool)))


@pytest.mark.parametrize("seed", slow_but(QUICK, range(500)))
def test_random_mechanisms(seed: int) -> None:
    """Every joint, drive and force element; the dense oracle too."""
    case = random_mechanism(seed)
    model, reduced = reduced_case(case)
    numbers = Numbers(model, reduced.p)
    s, rate = reduced.reduce(0.0, case.q, case.v)
    q, v = reduced.expand(0.0, s, rate)
    assert close(q, case.q, 1e-12, 1.0)
    assert close(v, case.v, 1e-11, 1.0)
    check_state(reduced, numbers, 0.0, s, rate, NAN)
    a, _ = numpy_linkage.accelerations(case.linkage, 0.0, case.q, case.v, 0.0, 0.0)
    picked = [
        3 * int(name[1:]) + 2
        for name in reduced.library.source.tree_coordinates
        if f"{name}.theta" in reduced.library.source.coordinates
    ]
    angles = [
        k
        for k, name in enumerate(reduced.library.source.tree_coordinates)
        if f"{name}.theta" in reduced.library.source.coordinates
    ]
    assert close(reduced.accelerations(0.0, s, rate, NAN)[0][angles], a[picked], 1e-9, 1.0)


@pytest.mark.parametrize("seed", slow_but([1], range(6)))
def test_random_linkages(seed: int) -> None:
    case, _ = random_model(seed)
    model, reduced = reduced_case(case)
    s, rate = reduced.reduce(0.0, case.q, case.v)
    check_state(reduced, Numbers(model, reduced.p), 0.0, s, rate, NAN)


@pytest.mark.parametrize(
    "name", ["four_bar", "slider_crank", pytest.param("car_axis", marks=pytest.mark.slow), "belt_block"]
)
def test_rules_are_the_derivatives_of_the_definitions(name: str) -> None:
    """Every derived symbol by every coordinate, rate and t, against differences of what it stands for."""
    model, simulation = shipped(name, "ideal")
    start = simulation.start()
    reduced, numbers = Reduced(simulation.compiled, simulation.p), Numbers(model, simulation.p)
    system = numbers.system
    symbols = system.model.symbols
    s, rate = reduced.reduce(0.0, start.q, start.v)
    s, rate, t, h = s + 0.1, rate + 0.3, 0.2, 1e-5
    ruled = [x for x in symbols.derivative_rules if x in symbols.definitions]
    rules = numbers(
        [symbols.differentiate(x, by) for x in ruled for by in (*system.q, *system.v, system.model.t)], t, s, rate
    )
    rules = rules.reshape(len(ruled), -1)
    y = np.concatenate([s, rate, [t]])
    for k in range(len(y)):
        up, down = (y + sign * h * np.eye(len(y))[k] for sign in (1.0, -1.0))
        n = len(s)
        high, low = (numbers(ruled, z[-1], z[:n], z[n : 2 * n]) for z in (up, down))
        assert close(rules[:, k], (high - low) / (2.0 * h), 1e-6, 1.0)


def test_the_press_has_five_angles_and_one_closure() -> None:
    """Driven cranks are functions of t, the slide of the slider follows the rod, its angle does not move."""
    _, simulation = shipped("nine_bar_press", "lubricated")
    source = simulation.compiled.source
    assert sorted(source.tree_coordinates) == ["L2", "L3", "L6", "L7", "L8"]
    assert source.closures == ("guide.offset",)
    assert source.operations["reduced_dynamics"] < 0.35 * source.operations["dynamics"]


@pytest.mark.parametrize("pair", ["a.origin, b.origin", "b.origin, a.origin"])
def test_two_slides_that_a_pin_couples_are_one_coordinate(pair: str) -> None:
    """Which body has the slot decides the signs in its row: both go along with the one slide that is left, alike."""
    text = f"""
format: gudgeon/1
name: slides
bodies: {{a: {{mass: 1 kg, inertia: 0.1 kg*m^2}}, b: {{mass: 2 kg, inertia: 0.1 kg*m^2}}}}
ground: {{O: [0, 0], P: [0, 1 m]}}
joints:
  low: {{translational: [ground.O, a.origin], axis: [1, 0]}}
  high: {{translational: [ground.P, b.origin], axis: [1, 0]}}
  pin: {{point_on_line: [{pair}], direction: [0, 1]}}
"""
    system = reduce_model(derive_scene(text.encode(), "slides.yaml", "ideal").copy_mutable())
    assert len(system.unknowns) == 1 and not system.rows
    assert [[row.get(0, 0) for row in system.motions[body].jacobian] for body in "ab"] == [[1, 0, 0], [1, 0, 0]]


@pytest.mark.slow
def test_a_chain_is_cut_where_that_is_cheaper() -> None:
    """M of a hanging chain is full in its angles: a long one is cut, so that operations grow with its length."""
    operations = {}
    for n in (16, 32):
        kernels, *_ = make_reduced_kernels(reduce_model(chain(n).copy_mutable()))
        operations[n] = next(kernel.n_operations for kernel in kernels if kernel.name == DYNAMICS)
    assert operations[32] < 2.4 * operations[16]


def chain(n: int) -> Model:
    lines = ["format: gudgeon/1", "name: chain", "gravity: [0, -9.81 m/s^2]", "ground: {O: [0, 0]}", "bodies:"]
    lines += [f"  c{k}: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}" for k in range(n)]
    lines += ["joints:", "  j0: {revolute: [ground.O, c0.tail]}"]
    lines += [f"  j{k}: {{revolute: [c{k - 1}.head, c{k}.tail]}}" for k in range(1, n)]
    return derive_scene("\n".join(lines).encode(), "chain.yaml", "ideal")


def test_sines_and_cosines() -> None:
    """The vector of four against the library, small and large angles: a few units in the last place."""
    angles = np.concatenate(
        [np.random.default_rng(0).uniform(-scale, scale, 400) for scale in (1e-3, 1.0, 50.0, 9e4, 1e9)]
    )
    _, simulation = shipped("nine_bar_press", "lubricated")
    reduced = Reduced(simulation.compiled, simulation.p)
    names = [f"{body.name}.theta" for body in simulation.source.bodies]
    assert set(names) <= set(simulation.source.coordinates)
    place = {name: k for k, name in enumerate(simulation.source.tree_coordinates)}
    length = 0.18
    k, at = place["L6"], simulation.source.coordinates.index("L6.x")
    for angle in angles:
        s = np.zeros(reduced.n)
        s[k] = angle
        q, _ = reduced.expand(0.0, s, np.zeros(reduced.n))
        assert abs(q[at] - 0.5 - 0.5 * length * np.cos(angle)) < 1e-15
        assert abs(q[at + 1] - 0.5 * length * np.sin(angle)) < 1e-16 * 3
    assert sp.Integer(0) == 0
