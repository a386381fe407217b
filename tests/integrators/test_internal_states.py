"""Internal states of laws: Dahl's bristles in a joint with play."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError
from gudgeon.generator.targets.latex import render_equations_tex
from gudgeon.integrators import lanes
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.targets_c.test_c_compiles import COMPILERS, FLAGS, compile_c, write

pytestmark = needs_compiler
COULOMB = "{law: modified_coulomb, mu: 0.15, v0: 1e-4 m/s, v1: 1e-3 m/s}"
LUGRE = "{law: lugre, mu: 0.15, mu_s: 0.2, v_s: 1 cm/s, stiffness: 2e4 1/m, damping: 3 s/m}"
PRESLIDING = 20e-6
Press = Callable[..., Simulation]


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Press:
    text = find_shipped_file("nine_bar_press").read_text(encoding="utf-8")
    assert COULOMB in text
    file = tmp_path_factory.mktemp("states") / "press.yaml"
    file.write_text(text.replace(COULOMB, "{law: dahl, mu: 0.15, presliding: 20 um}"), encoding="utf-8")
    return cache(lambda formulation="reduced": gudgeon.load(file, "dry", formulation=formulation))


TWO = """
parameters: {c: 0.3 mm}
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}, k: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}}
ground: {O: [0, 0], Q: [50 mm, 0]}
joints: {A: {revolute: [ground.O, j.origin]}, B: {revolute: [j.origin, k.origin]}}
forces:
  load: {force: j.origin, value: [0, -8 N]}
  other: {force: k.origin, value: [4 N, 20 N]}
  turn: {torque: j, value: 1e-2 N*m}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings: {p: {radius: 10 mm, clearance: c, length: 20 mm, bearing_material: s, journal_material: s}}
contacts:
  c: {normal: {law: lankarani_nikravesh, restitution: 0.8}, friction: {law: dahl, mu: 0.15, presliding: 20 um}}
scenes: {m: {play: {A: {bearing: p, contact: c}, B: {bearing: p, contact: c}}}}
"""


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    """A journal in a bearing, and another one in it."""
    return loader(tmp_path_factory.mktemp("two"))(TWO, "m")


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_bristles_follow_the_slip(press: Press, formulation: str) -> None:
    """The force is the law's of the stored state, and between onsets the state obeys its equation."""
    fine = press(formulation).simulate(0.012, output=24000, rtol=1e-10)
    for joint in ("A", "B"):
        z, slip, closed = fine[f"{joint}.z"], fine[f"{joint}.vt"], fine[f"{joint}.state"] > 0
        force = -0.15 * fine[f"{joint}.Fn"] * z / PRESLIDING * closed
        np.testing.assert_allclose(fine[f"{joint}.Ft"], force, atol=1e-12)
        assert 0.5 * PRESLIDING < abs(z).max() < PRESLIDING
        inside = (
            closed[:-2]
            & closed[1:-1]
            & closed[2:]
            & (fine[f"{joint}.deltadot_minus"][:-2] == fine[f"{joint}.deltadot_minus"][2:])
        )
        rate = ((z[2:] - z[:-2]) / (fine.t[2:] - fine.t[:-2]))[inside]
        expected = (slip - abs(slip) * z / PRESLIDING)[1:-1][inside]
        assert inside.sum() > 50
        np.testing.assert_allclose(rate, expected, atol=3e-3 * abs(expected).max())


def test_the_functions_of_numpy_agree(two: Simulation) -> None:
    """Force and rate of the state, in contact and bent, as the compiled functions have them."""
    model, start, rng = two.model.numpy(), two.start(), np.random.default_rng(3)
    p, bent = model.prepare(), np.array([[7e-6], [-1.2e-5]])
    q, v = start.q + rng.normal(0, 3e-4, start.q.size), start.v + rng.normal(0, 0.1, start.v.size)
    got = model.dynamics(0.1, q, v, p, [0.05, 0.2], states=bent)
    want = two.compiled.rhs(0.1, np.concatenate([q, v]), two.p, discrete_states=[0.05, 0.2, *bent.ravel()])
    np.testing.assert_allclose(got.a, want[q.size : 2 * q.size], rtol=0, atol=1e-12 * abs(got.a).max())
    assert any(joint.delta > 0 for joint in got.clearance)
    for joint, (z,) in zip(got.clearance, bent, strict=True):
        in_contact = joint.delta > 0
        rate = (joint.v_t - abs(joint.v_t) * z / PRESLIDING) * in_contact
        np.testing.assert_allclose(joint.state_rate, [rate], rtol=1e-13)
        np.testing.assert_allclose(joint.F_t, -0.15 * -joint.F_n * z / PRESLIDING * in_contact, rtol=1e-13)


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_methods_and_formulations_agree(press: Press, formulation: str) -> None:
    exact = press().simulate(0.012, output=20, rtol=1e-12)
    others = [press(formulation).simulate(0.012, output=20, rtol=1e-12)]
    others += [press(formulation).simulate(0.012, output=20, method="rk4", step=1e-7)]
    others += [press(formulation).simulate(0.012, output=20, method="rodas5p", rtol=1e-7)]
    for run in others[formulation == "reduced" :]:
        assert abs(run["S9.y"] - exact["S9.y"]).max() < 1e-9
        assert abs(run["A.z"] - exact["A.z"]).max() < 1e-3 * PRESLIDING


@pytest.mark.parametrize("mechanism", ["two", *(pytest.param(x, marks=pytest.mark.slow) for x in ("press", LUGRE))])
def test_runs_side_by_side(
    press: Press, two: Simulation, tmp_path: Path, mechanism: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To the last bit those of single runs, while journals come, bend, slide and go."""
    scene, place = (two, "j.y") if mechanism == "two" else (press(), "S9.y")
    if mechanism == LUGRE:
        text = find_shipped_file("nine_bar_press").read_text(encoding="utf-8")
        (tmp_path / "press.yaml").write_text(text.replace(COULOMB, mechanism), encoding="utf-8")
        scene = gudgeon.load(tmp_path / "press.yaml", "dry")
    c = np.linspace(2.5e-4, 5e-4, 8)
    batch = scene.simulate_many({"c": c}, t_end=0.01, output=50, method="rk4", step=1e-6)
    assert scene.source.lane_file
    for k, value in enumerate(c):
        run = scene.simulate(0.01, output=50, method="rk4", step=1e-6, parameters={"c": value})
        for name in ("A.z", "B.z", place, "A.Ft"):
            assert (run[name] == batch[name][k]).all(), (k, name)
    assert abs(batch["A.z"]).max() > 1e-6
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    c = np.linspace(2.5e-4, 5e-4, 17)
    for method in ("dop853", "rodas5p"):
        batches = [
            scene.simulate_many({"c": c}, 0.008, output=30, method=method, rtol=1e-6, threads=1, side_by_side=side)
            for side in (True, False)
        ]
        for name in ("A.z", "B.z", place, "A.Ft"):
            assert batches[0][name].tobytes() == batches[1][name].tobytes(), (method, name)
        for count in ("steps", "right_hand_sides", "jacobians"):
            assert (batches[0].diagnostics[count] == batches[1].diagnostics[count]).all(), (method, count)


def test_a_run_goes_on_with_its_states(press: Press) -> None:
    """In contact: as bent as it was; a state that is forgotten would be 0."""
    whole = press().simulate(0.012, output=2400, rtol=1e-12)
    k = int(np.flatnonzero(whole["A.state"] > 0)[3])
    begun = press().simulate(output=whole.t[: k + 1], rtol=1e-12)
    assert begun.final.memory[2] == begun["A.z"][-1] != 0.0
    rest = press().simulate(output=whole.t[k:], rtol=1e-12, start=begun.final)
    assert abs(rest["A.z"][:20] - whole["A.z"][k:][:20]).max() < 1e-4 * PRESLIDING


def test_batches_and_files_hold_them(press: Press, tmp_path: Path) -> None:
    batch = press().simulate_many({"c": [3e-4, 5e-4]}, t_end=0.01, output=50)
    for k, c in enumerate((3e-4, 5e-4)):
        run = press().simulate(0.01, output=50, parameters={"c": c})
        assert (run["A.z"] == batch["A.z"][k]).all()
    run.save(tmp_path / "z.nc")
    assert (Result.load(tmp_path / "z.nc")["A.z"] == run["A.z"]).all()


def test_peers_do_not_integrate_them(two: Simulation) -> None:
    fitting = "rk4, dop853, dopri5, rodas5p, radau5 and radau9 fit it"
    with pytest.raises(BadValueError, match=rf"an internal state \(A\.z\).*{fitting}"):
        two.simulate(0.01, method="scipy:Radau")


RUBBED = """
parameters: {stiffness: 2e4 1/m}
bodies: {j: {mass: 2 kg, inertia: 1e-4 kg*m^2}}
ground: {O: [0, 0]}
joints: {A: {revolute: [ground.O, j.origin]}}
forces: {load: {force: j.origin, value: [0, -20 N]}, turn: {torque: j, value: 0.05 N*m * sin(40 rad/s * t)}}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings:
  p: {radius: 10 mm, clearance: 0.3 mm, length: 20 mm, bearing_material: s, journal_material: s}
contacts:
  c:
    normal: {law: hertz, stiffness: 1e9, exponent: 1.5, restitution: 0.8, dissipation: flores}
    friction: {law: lugre, mu: 0.15, mu_s: 0.2, v_s: 1 cm/s, stiffness: stiffness, damping: 3 s/m}
start: {play: {A: {e: [0, -0.30759 mm], rate: [0, 0]}}}
scenes: {m: {play: {A: {bearing: p, contact: c}}}}
"""


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_rodas5p_is_of_its_order(tmp_path: Path, formulation: str) -> None:
    """A journal that lies in its bearing and is turned to and fro: fixed steps, of which none meets an onset."""
    journal = loader(tmp_path, formulation)(RUBBED, "m")
    exact = journal.simulate(0.008, output=4, method="dop853", rtol=1e-13)
    assert (exact["A.state"] > 0).all() and abs(exact["A.z"][1:]).min() > 1e-8
    off = [
        abs(journal.simulate(0.008, output=4, method="rodas5p", step=h)["A.z"] - exact["A.z"]).max()
        for h in (1.6e-4, 8e-5, 4e-5)
    ]
    orders = np.log2(np.divide(off[:-1], off[1:]))
    assert (orders > 4.6).all(), (off, orders)


def test_stiff_bristles_cost_rodas5p_little(tmp_path: Path) -> None:
    """A hundred times as stiff: dop853 follows their own time, rodas5p the motion."""
    journal = loader(tmp_path)(RUBBED, "m")
    explicit, implicit, exact = (
        journal.simulate(0.05, output=20, method=method, rtol=rtol, parameters={"stiffness": 2e7})
        for method, rtol in (("dop853", 1e-6), ("rodas5p", 1e-6), ("rodas5p", 1e-11))
    )
    for run in (explicit, implicit):
        assert abs(run["j.theta"] - exact["j.theta"]).max() < 1e-5 * abs(exact["j.theta"]).max()
    assert implicit.diagnostics.right_hand_sides < 0.1 * explicit.diagnostics.right_hand_sides


def test_a_class_reads_its_equation(two: Simulation) -> None:
    text = render_equations_tex(two.model)
    assert r"\eq{\dot{z}}{v_{t}" in text
    assert "is the deflection of the bristles, 0 at each onset" in text


JOURNAL = """
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}}
ground: {O: [0, 0], Q: [50 mm, 0]}
joints: {A: {revolute: [ground.O, j.origin]}}
parameters: {z: 3.0, z_rate: 2 mm}
forces:
  load: {force: j.origin, value: [0, -8 N]}
  turn: {torque: j, value: 1e-2 N*m}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings:
  p: {radius: 10 mm, clearance: 0.3 mm, length: 20 mm, bearing_material: s, journal_material: s}
contacts:
  c:
    normal: {law: hertz, stiffness: 1e9, exponent: 1.5, restitution: 0.8, dissipation: flores}
    friction: {law: dahl, mu: z/10, presliding: z_rate/100}
scenes: {m: {play: {A: {bearing: p, contact: c}}}}
"""


def test_rk4_bends_from_the_moment_of_the_onset(tmp_path: Path) -> None:
    """As exact at a contact as without internal states; parameters may be called as they are."""
    journal = loader(tmp_path)(JOURNAL, "m")
    exact = journal.simulate(0.0046, output=4, method="dop853", rtol=1e-13)
    assert len(exact.impacts) == 1 and exact["A.z"][-1] == 0.0  # free again: nothing is bent
    off = [abs(journal.simulate(0.0046, output=4, method="rk4", step=h).q - exact.q).max() for h in (8e-7, 1e-7)]
    assert max(off) < 4e-11  # a step ends at the onset: of order 1 it was 6e-6 and 1e-6, of order 2 still 4e-9


MIXED = """
bodies: {j: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}, k: {mass: 0.2 kg, inertia: 1e-5 kg*m^2}}
ground: {O: [0, 0], Q: [50 mm, 0]}
joints: {A: {revolute: [ground.O, j.origin]}, B: {revolute: [ground.Q, k.origin]}}
forces: {load: {force: j.origin, value: [0, -8 N]}, other: {force: k.origin, value: [1 N, -8 N]}}
materials: {s: {E: 207 GPa, nu: 0.3}}
bearings:
  p: {radius: 10 mm, clearance: 0.3 mm, length: 20 mm, bearing_material: s, journal_material: s}
contacts:
  c: {normal: {law: lankarani_nikravesh, restitution: 0.8}, friction: {law: dahl, mu: 0.3, presliding: 20 um}}
  d: {film: {law: pinkus_sternlicht, viscosity: 0.05 Pa*s}}
scenes: {m: {play: {A: {bearing: p, contact: d}, B: {bearing: p, contact: c}}}}
"""


def test_a_joint_without_states_beside_one_with_them(tmp_path: Path) -> None:
    """No word of the compiler, and every bit comes back from a file."""
    mixed = loader(tmp_path)(MIXED, "m")
    (tmp_path / "c").mkdir()
    scene = write(mixed.source, tmp_path / "c")
    for file in (scene, scene.with_name("lanes.c")):
        compile_c(COMPILERS[0], file, [*FLAGS, "-c", "-o", "scene.o"])
    run = mixed.simulate(0.01, output=50, method="dop853", rtol=1e-6)
    run.save(tmp_path / "mixed.nc")
    again = Result.load(tmp_path / "mixed.nc")
    np.testing.assert_array_equal(again.memory, run.memory)
    np.testing.assert_array_equal(again.final.memory, run.final.memory)


def test_a_state_by_hand_says_how_far_it_is_bent(press: Press) -> None:
    final = press().simulate(0.01, output=20).final
    memory = final.memory.copy()
    memory[2] = np.inf
    with pytest.raises(BadValueError, match=r"the internal state A\.z, is inf: expected a length"):
        press().simulate(0.011, start=replace(final, memory=memory))


def test_between_its_steps_dop853_knows_the_bristles(tmp_path: Path) -> None:
    """At the bound of stability its interpolant errs ten times as much as the ends of its steps."""
    text = JOURNAL.replace("{law: dahl, mu: z/10, presliding: z_rate/100}", LUGRE.replace("2e4", "2e5"))
    journal = loader(tmp_path)(text + "start: {rates: {j.omega: 80}}\n", "m")
    exact = journal.simulate(0.006, output=6000, method="radau9", rtol=1e-12)
    breakaway = 0.2 / 2e5
    assert abs(exact["A.z"]).max() > 0.5 * breakaway
    for rtol in (1e-5, 1e-6, 1e-7):
        run = journal.simulate(0.006, output=6000, method="dop853", rtol=rtol, audit="full")
        both = (exact["A.state"] > 0) & (run["A.state"] > 0)
        assert both.sum() > 100
        assert abs(run["A.z"] - exact["A.z"])[both].max() < 1e2 * rtol * breakaway, rtol
