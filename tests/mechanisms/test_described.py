"""Linkages as a newcomer describes them from README alone, against intersections of circles and closed forms."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.commands.assembly_report import assemble_scenes
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.results.results import Result
from tests.mechanisms.circles import Array, Points, beside, meet, point
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
HERE = Path(__file__).parent / "described"
FILES = sorted(path.stem for path in HERE.glob("*.yaml"))


@cache
def run(name: str, t_end: float = 1.0) -> Result:
    """Points are x + iy."""
    return gudgeon.load(HERE / f"{name}.yaml").simulate(t_end, output=120)


def shaper(t: Array) -> dict[str, Points]:
    pin = 0.3j + 0.1 * np.exp(2j * np.pi * t)
    top = 0.6 * pin / abs(pin)
    ram = top.real - np.sqrt(0.15**2 - (0.62 - top.imag) ** 2)
    return {"arm.head": top, "ram.origin": ram + 0.62j}


def toggle(t: Array) -> dict[str, Points]:
    pin = -0.33 + 0.21j + 0.06 * np.exp(3j * np.pi * t)
    knee = meet(pin, 0.32, 0.4j, 0.2, -1.0)
    slide = knee.imag - np.sqrt(0.22**2 - knee.real**2)
    return {"rod.head": knee, "slide.origin": 1j * slide}


def stephenson(t: Array) -> dict[str, Points]:
    A = 0.04 * np.exp(1j * (np.radians(20.0) + t))
    B = meet(A, 0.12, 0.13 + 0j, 0.09, 1.0)
    P = beside(A, B, 0.07, 0.06)
    return {"rocker.head": B, "coupler.P": P, "follower.head": meet(P, 0.12, 0.2 + 0.09j, 0.13, -1.0)}


CLOSED: dict[str, tuple[Callable[[Array], dict[str, Points]], float]] = {
    "shaper": (shaper, 1.0),
    "toggle_press": (toggle, 1.0),
    "stephenson": (stephenson, 2 * np.pi),
}


@pytest.mark.parametrize("name", slow_but(["stephenson"], FILES))
def test_it_moves_as_its_circles_say(name: str) -> None:
    form, t_end = CLOSED[name]
    found = run(name, t_end)
    for of, expected in form(found.t).items():
        np.testing.assert_allclose(point(found, of), expected, rtol=0, atol=1e-11, err_msg=of)


@pytest.mark.parametrize("name", FILES)
def test_it_says_that_nothing_is_free(name: str) -> None:
    file = HERE / f"{name}.yaml"
    scene = assemble_scenes(read_mechanism(file.read_bytes(), name), branches=False).scenes["ideal"]
    assert (scene.closed_mobility.freedoms, scene.closed_mobility.unconnected_bodies, scene.guess_deviations) == (
        0,
        (),
        {},
    )


def test_the_shaper_returns_quickly() -> None:
    """Cutting takes 360° − 2 arccos(r/d) of the crank's turn, whatever the link does (long, it hardly matters)."""
    found = run("shaper")
    angle = np.unwrap(found["arm.theta"])
    forward = (np.diff(angle) > 0).mean()
    share = 1 - np.arccos(0.1 / 0.3) / np.pi
    assert forward == pytest.approx(share, abs=0.02)
