"""The gallery against closed forms: circles that meet, sines, ratios of times, inversion, moments and energies."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.commands.assembly_report import assemble_scenes
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.loading.shipped import find_shipped_file, list_generated_scenes, list_shipped_mechanisms
from gudgeon.results.results import Result
from tests.mechanisms.circles import Array, Points, meet, point, smooth
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
ROOT = Path(__file__).resolve().parents[2]
GALLERY = sorted(set(list_shipped_mechanisms()) - set(list_generated_scenes()))


@cache
def run(name: str, t_end: float) -> Result:
    """Its ideal scene."""
    return gudgeon.load(name).simulate(t_end, output=240)


def chebyshev(t: Array) -> dict[str, Points]:
    """The coupler's direction is known: its middle M is as far from A0 − half as from B0 + half."""
    half = 0.04 * np.exp(2j * np.pi * t)  # from B to the middle, and on to A
    middle = meet(-half, 0.2, 0.16 + half, 0.2, 1.0)
    return {"left.head": middle + half, "coupler.middle": middle, "right.head": middle - half}


def yoke(t: Array) -> dict[str, Points]:
    """A sine, and nothing else."""
    return {"yoke.origin": 0.04 * np.cos(10 * np.pi * t) + 0j, "crank.head": 0.04 * np.exp(10j * np.pi * t)}


def whitworth(t: Array) -> dict[str, Points]:
    pivot, pin = -0.05j, 0.1 * np.exp(1j * (np.pi / 2 - np.pi * t))
    short = pivot - 0.08 * (pin - pivot) / abs(pin - pivot)
    ram = short.real + np.sqrt(0.26**2 - (short.imag + 0.05) ** 2)
    return {"arm.pin": short, "ram.origin": ram - 0.05j}


def peaucellier(t: Array) -> dict[str, Points]:
    """The inverse of A in the circle about O whose radius squared is L² − s²."""
    A = 0.04 + 0.04 * np.exp(1j * np.radians(50) * np.sin(np.pi * t))
    P = 0.0112 / np.conj(A)
    return {"crank.head": A, "c.head": P, "upper.head": meet(0 * A, 0.13, A, np.sqrt(0.13**2 - 0.0112), 1.0)}


def jansen(t: Array) -> dict[str, Points]:
    """Jansen's table of lengths, circle by circle."""
    Y, X = -0.038 - 0.0078j, 0.015 * np.exp(2j * np.pi * t)
    W = meet(Y, 0.0415, X, 0.050, 1.0)  # above
    V = meet(Y, 0.0393, X, 0.0619, -1.0)  # below
    U = meet(Y, 0.0401, W, 0.0558, 1.0)  # outside of the triangle b d e
    T = meet(U, 0.0394, V, 0.0367, -1.0)
    return {"upper.Q": W, "c.head": V, "upper.R": U, "f.head": T, "lower.R": meet(T, 0.0657, V, 0.049, -1.0)}


def lift(t: Array) -> dict[str, Points]:
    base = 0.95 - 0.55 * smooth(t, 4.0)
    height = np.sqrt(1.0 - base**2)
    return {"a.head": base + 1j * height, "platform.origin": 2j * height, "c.head": base + 2j * height}


def clamp(t: Array) -> dict[str, Points]:
    """From the handle's angle: H lies on a circle about G, K on one about B, and H K is given as a vector."""
    G = -0.045 - 0.045j
    turn = np.exp(1j * (np.pi + np.arctan2(4, 3) + np.radians(75 - 76.5 * smooth(t, 2.0))))
    K = meet(0 * turn, abs(0.015 + 0.035j), G - 0.045 * turn, 0.055, -1.0)
    return {"arm.K": K, "link.head": K + 0.045 * turn, "arm.pad": 0.1 * K / (0.015 + 0.035j)}


def boom(t: Array) -> dict[str, Points]:
    """The law of cosines about the pin."""
    pin, foot, lug = 1.5j, 0.8 + 0.2j, 1.2 - 0.2j
    r, d, s = abs(lug), abs(foot - pin), 1.25 + 0.5 * smooth(t, 6.0)
    opened = np.arccos((r**2 + d**2 - s**2) / (2 * r * d))
    turn = np.exp(1j * (np.angle(foot - pin) + opened - np.angle(lug)))
    return {"boom.head": pin + 4 * turn, "boom.lug": pin + lug * turn, "hook.origin": pin + 4 * turn}


def gear(t: Array) -> dict[str, Points]:
    crosshead, P, T = 1j * (1.5 + 0.3 * np.cos(np.pi * t)), 1.0 + 1.85j, 1.45 + 1.05j
    L = meet(crosshead, 0.7, P + 0 * crosshead, 0.49 + 0.514, 1.0)
    A = P + (L - P) / -1.004j * (0.723 - 0.49j)
    B = meet(A, 1.08, T + 0 * A, 0.36, -1.0)
    return {"plate.link": L, "plate.brace": A, "leg.brace": B, "leg.head": T + (B - T) * 1.2 / 0.36}


def slider_crank(t: Array) -> dict[str, Points]:
    pin = 0.05 * np.exp(1j * np.pi / 30 * 5000 * t)
    return {"crank.head": pin, "slider.origin": pin.real + np.sqrt(0.12**2 - pin.imag**2) + 0j}


def guided(t: Array, aside: float = 0.0) -> dict[str, Points]:
    """The line of its guide may lie aside of the crank's middle."""
    pin = 0.153 * np.exp(150j * t)
    along = pin.real + np.sqrt(0.306**2 - (pin.imag - aside) ** 2)
    return {"crank.head": pin, "slider.origin": along + 1j * aside}


CLOSED: dict[str, tuple[Callable[[Array], dict[str, Points]], float]] = {
    "double_rocker": (chebyshev, 1.0),
    "scotch_yoke": (yoke, 0.2),
    "whitworth": (whitworth, 2.0),
    "peaucellier": (peaucellier, 2.0),
    "jansen_leg": (jansen, 1.0),
    "scissor_lift": (lift, 4.0),
    "toggle_clamp": (clamp, 2.0),
    "cylinder_boom": (boom, 6.0),
    "landing_gear": (gear, 2.0),
    "flores_slider_crank": (slider_crank, 0.012),
    "guided_slider_crank": (guided, 0.084),
}


@pytest.mark.parametrize("name", GALLERY)
def test_it_moves_as_its_closed_form_says(name: str) -> None:
    """To 1e-12 of a metre: the straight line is straight, the sine a sine, the leg steps where Jansen's table says."""
    form, t_end = CLOSED[name]
    found = run(name, t_end)
    for of, expected in form(found.t).items():
        np.testing.assert_allclose(point(found, of), expected, rtol=0, atol=1e-12, err_msg=of)


@pytest.mark.parametrize("name", slow_but(["landing_gear", "scotch_yoke", "cylinder_boom"], GALLERY))
def test_nothing_is_free_and_guesses_are_followed(name: str) -> None:
    scenes = assemble_scenes(read_mechanism(find_shipped_file(name).read_bytes(), name), branches=False).scenes
    assert (
        scenes["ideal"].closed_mobility.freedoms,
        scenes["ideal"].closed_mobility.unconnected_bodies,
        scenes["ideal"].guess_deviations,
    ) == (0, (), {})


@pytest.mark.parametrize("name", GALLERY)
def test_drives_and_forces_pay_for_the_energy(name: str) -> None:
    """Work of drives and forces is the change of energy, by an integral over samples that knows nothing of it."""
    found = run(name, CLOSED[name][1])
    held = found["energy.kinetic"] + found["energy.potential"]
    work = found["work.drives"] + found["work.forces"]
    scale = np.abs(held).max() + np.abs(work).max()
    assert work - work[0] == pytest.approx(held - held[0], abs=2e-6 * scale)


def test_the_straight_line_is_straight() -> None:
    found = run("peaucellier", 2.0)
    assert np.abs(found["off_line"]).max() < 1e-12 and np.ptp(found["c.head.y"]) > 0.1


def test_chebyshevs_line_is_nearly_straight() -> None:
    """Exact where the coupler stands upright and where it lies level, within 0.4 % of the base between them."""
    found = run("double_rocker", 1.0)
    off, upright = found["off_line"], 60  # a quarter turn
    assert abs(off[0]) < 1e-12 and abs(off[upright]) < 1e-12 and abs(off[-1 - upright]) < 1e-12
    line = np.r_[off[: upright + 1], off[-1 - upright :]]
    assert 1e-4 < np.abs(line).max() < 0.004 * 0.16
    swing = [np.ptp(np.unwrap(found[f"{arm}.theta"])) for arm in ("left", "right")]
    assert max(swing) < np.pi and np.ptp(np.unwrap(found["coupler.theta"])) == pytest.approx(2 * np.pi)


def test_whitworths_time_ratio() -> None:
    """The ram turns where the pin is level with the pivot: 240 degrees of the crank one way, 120 the other."""
    times = run("whitworth", 4.0).events_of("turns")
    gaps = np.diff(times)
    angles = np.degrees(np.pi * gaps)
    assert sorted(np.round(angles[:2], 9)) == pytest.approx([120.0, 240.0], abs=1e-6)


def test_the_leg_walks() -> None:
    """The foot's path has a flat part: a third of a turn within a millimetre and a half."""
    y = run("jansen_leg", 1.0)["foot_height"]
    assert (y < y.min() + 1.5e-3).mean() > 0.3 and np.ptp(y) > 0.01


def test_the_cylinders_force_by_virtual_work() -> None:
    """At rest, F ds = (m_boom dy/2 + m_load dy) g; of the scissor lift F ds = (m_load dy + 4 m dy/2) g: its ratio."""
    found = run("cylinder_boom", 6.0)
    r, d = abs(1.2 - 0.2j), abs(0.8 - 1.3j)
    for k in (0, -1):  # smooth_step begins and ends without acceleration
        s, arm = (1.25, 1.75)[k], found["boom.head.x"][k]  # dy/dangle of the head
        lever = r * d * np.sin(np.arccos((r**2 + d**2 - s**2) / (2 * r * d))) / s
        weight = 9.81 * (200 * arm / 2 + 400 * arm)
        assert abs(found["cylinder.force"][k]) == pytest.approx(weight / lever, rel=1e-9)
    scissor = run("scissor_lift", 4.0)
    for k, base in ((0, 0.95), (-1, 0.4)):
        rate = 2 * base / np.sqrt(1 - base**2)  # of the platform by the roller
        weight = 9.81 * (50 + 40 / 2)
        assert abs(scissor["cylinder.force"][k]) == pytest.approx(weight * rate, rel=1e-9)


def test_the_toggle_multiplies_without_bound() -> None:
    """The hand's moment vanishes in the dead centre while the pad presses hardest, and behind it changes its sign."""
    found = run("toggle_clamp", 2.0)
    past = np.radians(75 - 76.5 * smooth(found.t, 2.0))
    pad, moment = found["opening"], found["hand.torque"]
    k = int(np.argmin(np.abs(past)))
    assert pad.min() == pad[k] and abs(pad[k]) < 2e-5 and 1e-4 < pad[-1] < 1e-3  # still pressed behind it
    near = (past > np.radians(1.0)) & (past < np.radians(3.0))
    assert (moment[near] < 0).all() and moment[-1] > 0.0
    rate = np.gradient(pad, past)[near]  # dpad/dangle: the hand pays for the pad's work, and for little else
    assert moment[near] == pytest.approx(-rate * 1e6 * (0.002 - pad[near]), rel=0.05)


def test_a_slider_lies_on_its_guide_as_on_a_line_aside() -> None:
    """Between its bounces, four times a turn on the other wall; there it does not turn, and friction at its corners is
    in balance with what presses the one behind more. What the wall bears is the ideal reaction but for the 1 mm."""
    ideal, found = run("guided_slider_crank", 0.084), gudgeon.load("guided_slider_crank", "hard").simulate(output=240)
    sides = []
    for wall, aside in (("upper", 1e-3), ("lower", -1e-3)):
        front, rear = (f"guide.{end}_{wall}" for end in ("front", "rear"))
        lies = (found[f"{front}.state"] > 0) & (found[f"{rear}.state"] > 0)
        line = guided(found.t, aside)["slider.origin"]
        assert lies.sum() > 40 and np.abs(point(found, "slider.origin") - line)[lies].max() < 1e-12
        force = np.abs(found["guide.F"])[lies].max()
        assert np.abs(found["guide.F"] - ideal["guide.F"])[lies].max() < 0.03 * force
        assert np.abs(found["guide.M"])[lies].max() < 1e-9 * force * 0.05
        more, rubs = found[f"{front}.Fn"] - found[f"{rear}.Fn"], found[f"{front}.Ft"] + found[f"{rear}.Ft"]
        np.testing.assert_allclose(np.sign(aside) * 0.048 * more[lies], 0.025 * rubs[lies], atol=1e-9 * force)
        sides.append(lies)
    walls = np.where(sides[0], 1, np.where(sides[1], -1, 0))
    assert np.count_nonzero(np.diff(walls[walls != 0])) == 7
    assert found.diagnostics.energy_residual < 1e-8 * found.diagnostics.energy_turned_over


@pytest.mark.slow
def test_worn_pins_of_the_landing_gear() -> None:
    """It begins in the middle of its clearances, falls into them under its weight, and stays with the ideal one."""
    worn = gudgeon.load("landing_gear", "worn").simulate(0.02, output=200)
    ideal = gudgeon.load("landing_gear").simulate(0.02, output=200)
    for joint in "AB":
        (first, *_) = worn.impacts[worn.impacts["joint"] == "AB".index(joint)]
        # a free fall over 50 µm takes 3.2 ms
        assert 2e-3 < first["t_on"] < 6e-3
        assert worn[f"{joint}.e"].max() < 1.5 * 0.05e-3
        assert worn[f"{joint}.F"].max() > 2 * ideal[f"{joint}.F"].max()
    lever = 0.36 * np.sin(np.radians(35.0))  # of the brace about the trunnion, at least
    assert np.abs(worn["leg_angle"] - ideal["leg_angle"]).max() < (worn["A.e"] + worn["B.e"]).max() / lever
    assert worn.diagnostics.energy_residual < 1e-6 * worn.diagnostics.energy_turned_over
