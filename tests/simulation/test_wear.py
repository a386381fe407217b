"""Wear of a joint with play against closed forms: steady sliding, a pendulum's bearing, the work of friction."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.results.wear import compute_shortest_arc, distribute_loads
from gudgeon.simulation.wear import check_joint_can_wear
from tests.programs import needs_compiler

R, C, L, M, G = 10e-3, 0.2e-3, 20e-3, 2.0, 9.81
PLACE = C + (M * G * math.cos(math.radians(40)) / 1e9) ** (2 / 3)  # of the bob at rest, where its weight is carried
RIG = f"""
format: gudgeon/1
name: rig
title: rig
gravity: [0, -{G} m/s^2]
parameters: {{of_ring: 1 rad/s, of_pin: 4 rad/s, swing: 40 deg, arm: 0.3 m, K: 1e9}}
materials: {{steel: {{E: 207 GPa, nu: 0.3}}}}
ground: {{O: [0, 0]}}
bearings: {{b: {{radius: {R}, clearance: {C}, length: {L}, bearing_material: steel, journal_material: steel}}}}
contacts: {{dry: {{normal: {{law: hertz, stiffness: K, restitution: 1, dissipation: none}}}}}}
"""
TURNING = (
    RIG
    + f"""
bodies: {{ring: {{mass: 1 kg, inertia: 1e-3}}, pin: {{mass: {M} kg, inertia: 1e-3}}}}
joints: {{O: {{revolute: [ground.O, ring.origin]}}, J: {{revolute: [ring.origin, pin.origin]}}}}
drives: {{one: {{angle: ring, value: of_ring * t}}, two: {{angle: pin, value: of_pin * t}}}}
start: {{play: {{J: {{e: [0, -({C} + ({M * G} / K)**(2/3))]}}}}}}
scenes: {{loose: {{play: {{J: {{bearing: b, contact: dry}}}}}}}}
"""
)
PENDULUM = (
    RIG
    + f"""
bodies: {{bob: {{mass: {M} kg, inertia: 1e-5, points: {{pin: [0, arm]}}}}}}
joints: {{J: {{revolute: [ground.O, bob.pin]}}}}
start: {{set: {{bob.theta: swing}},
        play: {{J: {{e: [{PLACE} m * sin(swing), -{PLACE} m * cos(swing)]}}}}}}
scenes: {{loose: {{play: {{J: {{bearing: b, contact: dry}}}}}}}}
"""
)


def test_loads_on_arcs_are_integrals_over_cells() -> None:
    """A box by its antiderivative, around 0; with parabolas by a sum over many places; short arcs are in one cell."""
    edges, low, high, half = np.linspace(0.0, 2 * np.pi, 101), -0.7, 1.1, 0.3
    boxes = [np.clip((edges - away - low) / (high - low), 0.0, 1.0) for away in (0.0, 2 * np.pi)]
    box = 5.0 * sum(np.diff(x) for x in boxes)
    places = np.linspace(low, high, 20001)[:-1] + (high - low) / 40000
    s = [np.clip((edges[:, None] - away - places) / half, -1.0, 1.0) for away in (0.0, 2 * np.pi)]
    parabolas = 5.0 * sum(np.diff(((2 + 3 * x - x**3) / 4).mean(axis=1)) for x in s)
    for away in 2 * np.pi * np.array([-3, 0, 2]):
        arcs = np.array([low + away]), np.array([high + away]), np.array([[5.0]])
        np.testing.assert_allclose(distribute_loads(100, *arcs)[0], box, atol=1e-12)
        np.testing.assert_allclose(distribute_loads(100, *arcs, np.array([half]))[0], parabolas, atol=1e-7)
    same = np.array([3.0])
    point = distribute_loads(100, same, same, np.array([[2.0], [7.0]]))
    assert point.sum(axis=1).tolist() == [2.0, 7.0] and (point[0] > 0).sum() == 1
    one = distribute_loads(1000, same, same, np.array([[2.0]]), np.array([half]))[0]
    x = (np.arange(1000) + 0.5) * 2 * np.pi / 1000
    exact = 2.0 * 0.75 * np.maximum(1 - ((x - 3.0) / half) ** 2, 0.0) / half * 2 * np.pi / 1000
    np.testing.assert_allclose(one, exact, atol=2e-3 * exact.max())


def test_the_worn_arc_is_the_shortest() -> None:
    """Of a box over the end of the circle 90 % of it; of two heaps what spans the way between them."""
    worn = np.zeros(360)
    worn[350:], worn[:30] = 1.0, 1.0
    assert compute_shortest_arc(worn) == pytest.approx(math.radians(36)) and compute_shortest_arc(
        worn, 1.0
    ) == pytest.approx(math.radians(40))
    two = np.zeros(360)
    two[[10, 300]] = 1.0
    assert compute_shortest_arc(two) == pytest.approx(math.radians(71)) and compute_shortest_arc(
        two, 0.5
    ) == pytest.approx(math.radians(1))
    assert math.isnan(compute_shortest_arc(np.zeros(8)))


@needs_compiler
def test_a_pin_that_slides_under_its_weight(tmp_path: Path) -> None:
    """V = k m g s/H; the contact stays below, and goes evenly over both circumferences, as far as each body turns."""
    (tmp_path / "rig.yaml").write_text(TURNING, encoding="utf-8")
    simulation, k, hardness = gudgeon.load(tmp_path / "rig.yaml", "loose"), 1e-4, 2e9
    run = simulation.simulate(0.5 * np.pi, output=3)
    found = gudgeon.wear(simulation, run, "J", k=k, hardness="2 GPa", points=360, journal_k=3e-4)
    depth = (M * G / 1e9) ** (2 / 3)
    slip = (4.0 * (R - C - depth / 2) - 1.0 * (R + depth / 2)) * 0.5 * np.pi
    volume = k * M * G * slip / hardness
    assert found.slip == pytest.approx(slip, rel=1e-7, abs=0.0)
    assert found.bearing.volume == pytest.approx(volume, rel=1e-7, abs=0.0)
    assert found.journal.volume == pytest.approx(3 * volume, rel=1e-7, abs=0.0)
    assert found.bearing.volume_per_hour == pytest.approx(volume * 3600 / (0.5 * np.pi), rel=1e-7, abs=0.0)
    ring = np.where((found.angle > np.pi) & (found.angle < 1.5 * np.pi), volume / (R * L * 0.5 * np.pi), 0.0)
    pin = 3 * volume / ((R - C) * L * 2 * np.pi)  # once around
    np.testing.assert_allclose(found.bearing.depth, ring, atol=1e-6 * ring.max())
    np.testing.assert_allclose(found.journal.depth, pin, rtol=1e-6)
    assert math.degrees(found.bearing.arc()) == pytest.approx(81.0, abs=1.1)
    half = gudgeon.wear(simulation, run, "J", k=k / hardness, since=0.25 * np.pi, points=360)
    assert half.bearing.volume == pytest.approx(volume / 2, rel=1e-7, abs=0.0)
    wide = gudgeon.wear(simulation, run, "J", k="5e-5 mm^3/N/m", contact="overlap")
    assert wide.bearing.volume == pytest.approx(volume, rel=1e-7, abs=0.0)
    assert wide.bearing.deepest < (1 + 1e-6) * ring.max()
    beta = math.acos(C / (C + depth))
    worn = wide.angle[wide.bearing.depth > 1e-9 * wide.bearing.deepest]
    assert worn.min() == pytest.approx(np.pi - beta, abs=3e-3)
    assert worn.max() == pytest.approx(1.5 * np.pi + beta, abs=3e-3)


@needs_compiler
def test_a_pendulums_bearing(tmp_path: Path) -> None:
    """Each swing takes k F(θ)/(H L) where it passes θ, F = m g cos θ + m l θ̇² by its energy; the pin at one place."""
    (tmp_path / "rig.yaml").write_text(PENDULUM, encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "rig.yaml", "loose")
    inertia, arm, swing = 1e-5, 0.3, math.radians(40)
    half = math.pi * math.sqrt((inertia + M * arm**2) / (M * G * arm)) * (1 + swing**2 / 16 + 11 * swing**4 / 3072)
    run = simulation.simulate(2 * half, output=10)
    found = gudgeon.wear(simulation, run, "J", k=1e-4, hardness=2e9, points=360)
    theta = found.angle - 1.5 * np.pi
    rate2 = 2 * M * G * arm * (np.cos(theta) - math.cos(swing)) / (inertia + M * arm**2)
    force = M * G * np.cos(theta) + M * arm * rate2
    inner, outer = np.abs(theta) < swing - 0.05, np.abs(theta) > swing + 0.05
    np.testing.assert_allclose(found.bearing.depth[inner], 2 * 1e-4 * force[inner] / (2e9 * L), rtol=0.03)
    assert found.bearing.depth[outer].max() == 0.0 and math.degrees(found.journal.arc()) < 3.0
    assert found.bearing.volume == pytest.approx(found.journal.volume, rel=1e-12, abs=0.0)


RIGID = (
    RIG.replace(
        "contacts: {",
        "contacts: {hard: {normal: {law: newton_restitution, restitution: 0.4}, friction: "
        "{law: coulomb, mu: mu, v0: 1e-3}}, ",
    ).replace("K: 1e9", "K: 1e9, mu: 0.1")
    + f"""
bodies: {{pin: {{mass: {M} kg, inertia: 1e-3}}}}
joints: {{J: {{revolute: [ground.O, pin.origin]}}}}
drives: {{turn: {{angle: pin, value: of_pin * t}}}}
forces: {{sway: {{force: pin.origin, value: [SWAY*sin(30 rad/s*t), 0]}}}}
start: {{play: {{J: {{e: [-{C}*sin(atan(mu)), -{C}*cos(atan(mu))]}}}}}}
scenes: {{loose: {{play: {{J: {{bearing: b, contact: hard}}}}}}}}
"""
)


@needs_compiler
@pytest.mark.parametrize("mu", [0.0, 0.1])
def test_a_rigid_contact_wears_where_it_is_closed(tmp_path: Path, mu: float) -> None:
    """A pin at rest in surfaces that do not give, δ = ±1e-17 m: m g cos(atan μ) s, and μ times that by friction."""
    (tmp_path / "rig.yaml").write_text(RIGID.replace("SWAY", "0 N"), encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "rig.yaml", "loose")
    load = M * G * math.cos(math.atan(mu)) * 4.0 * (R - C)
    for options in ({"method": "dop853"}, {"method": "rk4", "step": 1e-3}):
        run = simulation.simulate(1.0, output=2, parameters={"mu": mu}, **options)
        found = [gudgeon.wear(simulation, run, "J", k=1.0, law=law).bearing.volume for law in ("archard", "reye")]
        assert found == pytest.approx([load, mu * load], rel=1e-6, abs=1e-12)


@needs_compiler
def test_friction_of_a_rigid_contact_is_told(tmp_path: Path) -> None:
    """All that a joint that only slides takes is friction's; surfaces that do not give take and return nothing."""
    (tmp_path / "rig.yaml").write_text(RIGID.replace("SWAY", "8 N"), encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "rig.yaml", "loose")
    run = simulation.simulate(1.0, output=100)
    examined = gudgeon.examine(simulation, run).diagnostics.examined
    assert examined is not None and len(run.impacts) == 1
    (message,) = examined.joints
    assert message.friction == pytest.approx(-run["work.clearances"][-1], rel=1e-6) and message.friction > 0.05
    assert math.isnan(message.used) and math.isnan(message.returned)
    worn = gudgeon.wear(simulation, run, "J", k=1.0, law="reye")
    assert worn.bearing.volume == pytest.approx(message.friction, rel=1e-6)


OILED = (
    RIG.replace(
        "contacts: {",
        "contacts: {oiled: {normal: {law: hertz, stiffness: K, restitution: 1, dissipation: "
        "none}, friction: {law: coulomb, mu: 0.1, v0: 1e-6}, mixed: {law: christensen, roughness: 20 um}, "
        "film: {law: ocvirk, viscosity: 0.02, shear: true}}, ",
    )
    + f"""
bodies: {{pin: {{mass: {M} kg, inertia: 1e-3}}}}
joints: {{J: {{revolute: [ground.O, pin.origin]}}}}
drives: {{turn: {{angle: pin, value: 50 rad/s * t}}}}
start: {{play: {{J: {{e: [0, -{C}]}}}}}}
scenes: {{loose: {{play: {{J: {{bearing: b, contact: oiled}}}}}}}}
"""
)


@needs_compiler
def test_oil_wears_nothing(tmp_path: Path) -> None:
    """A pin that rests on film and tips: k b F_n s/H of the tips' share b alone, and friction's work by it."""
    (tmp_path / "rig.yaml").write_text(OILED, encoding="utf-8")
    simulation = gudgeon.load(tmp_path / "rig.yaml", "loose")
    run = simulation.simulate(0.5, output=10, method="rodas5p", rtol=1e-9)
    delta, slip = float(run["J.delta"][-1]), float(run["J.vt"][-1]) * 0.1
    ratio = 1.0 - delta / 120e-6
    tips = (1.0 - ratio**4 * (35 - ratio * (84 - ratio * (70 - 20 * ratio)))) * 1e9 * delta**1.5
    assert run["J.delta"][-3] == pytest.approx(delta, rel=1e-9) and 0.01 * M * G < tips < 0.7 * M * G
    for law, share in (("archard", 1.0), ("reye", 0.1)):
        found = gudgeon.wear(simulation, run, "J", k=1e-9, law=law, since=0.4)
        assert found.journal.volume == pytest.approx(1e-9 * share * tips * slip, rel=1e-6, abs=0.0)
    examined = gudgeon.examine(simulation, run).diagnostics.examined
    assert examined is not None
    (message,), total = examined.joints, -run["work.clearances"][-1]
    assert message.used - message.returned + message.friction + message.film == pytest.approx(total, rel=1e-6)
    rubbed = gudgeon.wear(simulation, run, "J", k=1.0, law="reye").journal.volume
    assert message.friction == pytest.approx(rubbed, rel=1e-5)
    with pytest.raises(BadValueError, match="the force of its film is not known with user-defined laws"):
        check_joint_can_wear(replace(run.source, laws=(("syrup", "0"),)), "J")


@pytest.fixture(scope="module")
def crank() -> tuple[gudgeon.Simulation, gudgeon.Result]:
    simulation = gudgeon.load("slider_crank", "dry")
    return simulation, simulation.simulate(0.1, output=7)


@needs_compiler
def test_reyes_volume_is_frictions_work(crank: tuple[gudgeon.Simulation, gudgeon.Result]) -> None:
    """As the second pass of a report finds it, which is held against what the time loop integrates; of any samples."""
    simulation, run = crank
    found = gudgeon.wear(simulation, run, "wristpin", k=1e-9, law="reye")
    examined = gudgeon.examine(simulation, simulation.simulate(0.1, output=4000)).diagnostics.examined
    assert examined is not None
    assert found.bearing.volume == pytest.approx(1e-9 * examined.joints[0].friction, rel=1e-6, abs=0.0)
    sampled = simulation.simulate(0.1, output=900)
    again = gudgeon.wear(simulation, sampled, "wristpin", k=1e-9, law="reye")
    np.testing.assert_allclose(again.bearing.depth, found.bearing.depth, atol=1e-9 * found.bearing.deepest)


@needs_compiler
def test_a_study_measures_it() -> None:
    """For k/H = 1/Pa, as of the runs made one by one; nowhere in an ideal scene."""
    study = gudgeon.study(
        {
            "mechanism": "slider_crank",
            "scenes": ["ideal", "dry"],
            "parameters": {"c": ["0.1 mm", "0.3 mm"]},
            "t_end": "0.05 s",
            "output": 10,
            "measures": {
                "depth": {"wear_depth": "wristpin"},
                "arc": {"wear_arc": "wristpin"},
                "F": {"peak_force": "wristpin"},
                "ax": {"peak_of_steps": "slider.ax"},
            },
        }
    ).dataset
    assert study["depth"].sel(scene="ideal").isnull().all() and study["arc"].attrs["units"] == "rad"
    simulation = gudgeon.load("slider_crank", "dry")
    for c in (1e-4, 3e-4):
        run = simulation.simulate(0.05, output=10, parameters={"c": c}, peaks=["slider.ax"])
        found, own = gudgeon.wear(simulation, run, "wristpin", k=1.0), study.sel(scene="dry", c=c)
        assert float(own["depth"]) == found.bearing.deepest and float(own["arc"]) == found.bearing.arc()
        assert float(own["ax"]) == run.peak("slider.ax").abs


@needs_compiler
def test_it_is_written_and_drawn(crank: tuple[gudgeon.Simulation, gudgeon.Result], tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    found = gudgeon.wear(*crank, "wristpin", k=1e-4, hardness=1e9)
    found.to_csv(tmp_path / "wear.csv")
    table = np.loadtxt(tmp_path / "wear.csv", delimiter=",", skiprows=1)
    assert np.array_equal(table, np.column_stack([found.angle, found.bearing.depth, found.journal.depth]))
    assert np.array_equal(found.to_dataframe()["journal"], found.journal.depth)
    lines = found.plot().get_lines()
    ratio = np.asarray(lines[0].get_ydata()).max() / np.asarray(lines[1].get_ydata()).max()
    assert ratio == pytest.approx(found.bearing.deepest / found.journal.deepest)


@needs_compiler
def test_what_cannot_be_is_refused(crank: tuple[gudgeon.Simulation, gudgeon.Result]) -> None:
    simulation, run = crank
    with pytest.raises(UnknownNameError, match="joint with play"):
        gudgeon.wear(simulation, run, "crankpin", k=1e-4, hardness=1e9)
    for wrong in (
        {"k": 0.0},
        {"k": "1 mm"},
        {"k": 1.0, "hardness": "1 m"},
        {"k": 1.0, "law": "holm"},
        {"k": 1.0, "since": 0.2},
        {"k": 1.0, "contact": "line"},
        {"k": 1.0, "points": 3},
    ):
        with pytest.raises(gudgeon.InputError):
            gudgeon.wear(simulation, run, "wristpin", **wrong)
    for one, other in ((simulation, "run"), ("rig", run)):
        with pytest.raises(BadValueError, match="expected a (Result|Simulation)"):
            gudgeon.wear(one, other, "wristpin", k=1.0)  # type: ignore[arg-type]
    with pytest.raises(BadValueError, match="expected the simulation of the run"):
        gudgeon.wear(gudgeon.load("bouncing_ball", "elastic"), run, "wristpin", k=1.0)
