"""Long conservative runs: the energy error of Taylor's method, whose sums keep their rounding errors."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipk

import gudgeon
from gudgeon.errors import BadValueError
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

HERE = Path(__file__).parent.parent
GRAVITY, LENGTH, INERTIA = 9.81, 1.0, 0.1  # m/s^2, m, kg m^2; links have a mass of 1 kg
PERIOD = 2.1  # s: about that of a link that swings by a right angle
Links = Callable[[int], Simulation]


@pytest.fixture(scope="module")
def links(tmp_path_factory: pytest.TempPathFactory) -> Links:
    """Chains of equal links that begin at rest at the angles a0, a1, ..."""

    @cache
    def chain(count: int) -> Simulation:
        heads = ["ground.O", *(f"L{k}.head" for k in range(count))]
        lines = [
            f"format: gudgeon/1\nname: links\ngravity: [0, -{GRAVITY}]\nground: {{O: [0, 0]}}",
            f"parameters: {{{', '.join(f'a{k}: 0 rad' for k in range(count))}}}\nbodies:",
            *(f"  L{k}: {{length: {LENGTH} m, mass: 1 kg, inertia: {INERTIA} kg*m^2}}" for k in range(count)),
            "joints:",
            *(f"  J{k}: {{revolute: [{heads[k]}, L{k}.tail]}}" for k in range(count)),
            f"start: {{set: {{{', '.join(f'L{k}.theta: a{k}' for k in range(count))}}},",
            f"  rates: {{{', '.join(f'L{k}.omega: 0' for k in range(count))}}}}}",
        ]
        file = tmp_path_factory.mktemp("links") / "links.yaml"
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return gudgeon.load(file)

    return chain


def swing(simulation: Simulation, angles: tuple[float, ...], t_end: float, rtol: float) -> Result:
    """A run with two samples in its last second, not at positions of rest."""
    parameters: dict[str, Any] = {f"a{k}": angle for k, angle in enumerate(angles)}
    times = [0.0, t_end - 0.7, t_end]
    return simulation.simulate(output=times, method="taylor", rtol=rtol, parameters=parameters)


def energy_error(run: Result, count: int) -> float:
    """The largest change of the energy of a chain, of its range m g l of potential energies, in long double.

    Energies by hand: m/2 (x'^2 + y'^2) + J/2 theta'^2 + m g y of each link's middle.
    """
    theta, omega = (
        np.array([run[f"L{k}.{of}"] for k in range(count)]).astype(np.longdouble) for of in ("theta", "omega")
    )
    sines, cosines = np.sin(theta), np.cos(theta)
    energy = np.zeros(theta.shape[1], dtype=np.longdouble)
    for k in range(count):
        shares = np.array([1.0] * k + [0.5])[:, None] * LENGTH  # of the links up to the middle of link k
        x_rate, y_rate = ((shares * omega[: k + 1] * of[: k + 1]).sum(axis=0) for of in (-sines, cosines))
        height = (shares * sines[: k + 1]).sum(axis=0)
        energy += (x_rate**2 + y_rate**2 + INERTIA * omega[k] ** 2) / 2 + np.longdouble(GRAVITY) * height
    return float(abs(energy - energy[0]).max() / (GRAVITY * LENGTH))


@needs_compiler
def test_two_links_before_chaos(links: Links) -> None:
    """Errors of 100 times as many swings: less than linear growth, by the rms over four starts.

    Growth like the root of time is a factor 10. A truncation of 1e-14 in each step, as at rtol 1e-14, makes it 100.
    """
    starts = ((-1.2, -1.0), (-1.3, -1.6), (-1.5, -1.8), (-1.4, -1.2))
    short, long = (
        math.hypot(*(energy_error(swing(links(2), start, t_end, 1e-16), 2) for start in starts)) / 2.0
        for t_end in (100.0, 10_000.0)
    )
    assert long < 3e-14
    assert long < 40.0 * max(short, 2.0**-52)


@needs_compiler
def test_one_link_over_ten_thousand_periods(links: Links) -> None:
    """The errors of a periodic motion repeat, so that they add up; each period adds less than a rounding error."""
    for angle in (0.0, -0.3, 0.2):
        short, long = (energy_error(swing(links(1), (angle,), count * PERIOD, 1e-16), 1) for count in (100, 10_000))
        assert long < 10_000 * 2.0**-52
        assert short < 100 * 2.0**-52


@needs_compiler
@pytest.mark.parametrize("rtol", [1e-6, 1e-10, 1e-14])
def test_steps_of_one_link_follow_the_poles_of_its_motion(links: Links, rtol: float) -> None:
    """A step is 1/e of the distance R to the nearest pole, because the order is near -ln rtol.

    With the modulus k = sin(amplitude / 2), the angular velocity is proportional to the elliptic function cn. Its poles
    have the distance K' from the real axis, opposite to the passages of the lowest position. A quarter of a period K
    has the integral of e dt / R steps, e asinh(K / K').
    """
    frequency = math.sqrt(GRAVITY * LENGTH / 2.0 / (INERTIA + LENGTH**2 / 4.0))
    for angle in (0.0, -0.6, 0.6):
        modulus = math.sin((math.pi / 2.0 + angle) / 2.0)
        quarter, distance = ellipk(modulus**2), ellipk(1.0 - modulus**2)
        n_quarters = 400
        run = swing(links(1), (angle,), n_quarters * quarter / frequency, rtol)
        expected = n_quarters * math.e * math.asinh(quarter / distance)
        assert 0.8 * expected < run.diagnostics.steps < 1.15 * expected


@pytest.mark.slow
@needs_compiler
def test_closed_loops(tmp_path: Path) -> None:
    """Andrews' squeezer without spring and motor keeps its kinetic energy over 300 turns of the crank OF.

    Each step is projected onto six constraint equations. A turn adds less than 30 rounding errors: the crank's angle
    grows to 1900 rad, and the rounding error of its sine with it.
    """
    text = (HERE.parent / "mechanisms/andrews_squeezer.yaml").read_text(encoding="utf-8")
    without_forces = re.sub(r"^forces:\n(  .*\n)+", "", text, flags=re.MULTILINE)
    file = tmp_path / "free.yaml"
    file.write_text(
        without_forces.replace("  guess:\n", "  rates: {OF.omega: 1000 1/s}\n  guess:\n", 1), encoding="utf-8"
    )
    simulation = gudgeon.load(file)
    run = simulation.simulate(2.15, output=10, method="taylor", rtol=1e-16)
    assert abs(run["OF.theta"][-1] - run["OF.theta"][0]) > 300 * 2.0 * math.pi
    energy = (simulation.mass() * run.v.astype(np.longdouble) ** 2).sum(axis=1)
    assert float(abs(energy / energy[0] - 1.0).max()) < 30 * 300 * 2.0**-52


@needs_compiler
def test_smallest_tolerances(links: Links) -> None:
    """Taylor's method accepts 1e-16: its truncation may be below the rounding errors of the state."""
    assert swing(links(1), (0.0,), 3.0, 1e-16).diagnostics.rtol == 1e-16
    with pytest.raises(BadValueError, match="from 1e-16 to less than 1"):
        swing(links(1), (0.0,), 3.0, 9e-17)
    with pytest.raises(BadValueError, match="from 1e-14 to less than 1"):
        links(1).simulate(1.0, method="dop853", rtol=1e-15)
