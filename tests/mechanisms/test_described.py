"""Linkages as a newcomer describes them from README alone, against intersections of circles and closed forms."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import gudgeon
from gudgeon.commands.assembly_story import assemble_scenes
from gudgeon.generator.reader.read import read_mechanism
from gudgeon.results.results import Result

pytestmark = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")
HERE = Path(__file__).parent / "described"
FILES = sorted(path.stem for path in HERE.glob("*.yaml"))
Points = Any  # complex numbers or arrays of them, x + iy
Array = NDArray[np.float64]


@cache
def run(name: str, t_end: float = 1.0) -> Result:
    """Points are x + iy."""
    return gudgeon.load(HERE / f"{name}.yaml").simulate(t_end, output=120)


def point(of: Result, name: str) -> Points:
    return np.asarray(of[f"{name}.x"] + 1j * of[f"{name}.y"])


def meet(one: Points, r1: float, two: Points, r2: float, side: float) -> Points:
    """Where two circles meet: left of the way from the first centre to the second (side 1), or right of it."""
    d = abs(two - one)
    along = (r1**2 - r2**2 + d**2) / (2 * d)
    return np.asarray(one + (two - one) / d * (along + side * 1j * np.sqrt(r1**2 - along**2)))


def beside(tail: Points, head: Points, x: float, y: float) -> Points:
    """A point of a bar, in its frame."""
    return np.asarray(tail + (head - tail) / abs(head - tail) * (x + 1j * y))


def jansen(t: Array) -> dict[str, Points]:
    Y, X = -0.038 - 0.0078j, 0.015 * np.exp(2j * np.pi * t)
    W = meet(Y, 0.0415, X, 0.050, 1.0)  # above
    V = meet(Y, 0.0393, X, 0.0619, -1.0)  # below
    U = meet(Y, 0.0401, W, 0.0558, 1.0)  # outside of the triangle b d e
    T = meet(U, 0.0394, V, 0.0367, -1.0)
    return {"upper.head": W, "c.head": V, "upper.U": U, "f.head": T, "lower.foot": meet(T, 0.0657, V, 0.049, -1.0)}


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


def smooth(t: Array, duration: float) -> Array:
    """smooth_step of the format: 10 s³ − 15 s⁴ + 6 s⁵."""
    s = np.clip(t / duration, 0.0, 1.0)
    return np.asarray(s**3 * (10 - 15 * s + 6 * s**2))


def lift(t: Array) -> dict[str, Points]:
    base = 0.9 - 0.5 * smooth(t, 2.0)
    height = np.sqrt(1.0 - base**2)
    return {"a.head": base + 1j * height, "platform.origin": 2j * height, "c.head": base + 2j * height}


def boom(t: Array) -> dict[str, Points]:
    """The law of cosines about the pin."""
    pin, foot, lug = 1.5j, 0.8 + 0.2j, 1.2 - 0.2j
    r, d, s = abs(lug), abs(foot - pin), 1.25 + 0.5 * smooth(t, 3.0)
    opened = np.arccos((r**2 + d**2 - s**2) / (2 * r * d))
    turn = np.exp(1j * (np.angle(foot - pin) + opened - np.angle(lug)))
    return {"boom.head": pin + 4 * turn, "boom.lug": pin + lug * turn}


CLOSED: dict[str, tuple[Callable[[Array], dict[str, Points]], float]] = {
    "jansen_leg": (jansen, 1.0), "shaper": (shaper, 1.0), "toggle_press": (toggle, 1.0),
    "stephenson": (stephenson, 2 * np.pi), "scissor_lift": (lift, 2.0), "boom": (boom, 3.0),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_it_moves_as_its_circles_say(name: str) -> None:
    form, t_end = CLOSED[name]
    found = run(name, t_end)
    for of, wanted in form(found.t).items():
        np.testing.assert_allclose(point(found, of), wanted, rtol=0, atol=1e-11, err_msg=of)


@pytest.mark.parametrize("name", FILES)
def test_it_says_that_nothing_is_free(name: str) -> None:
    file = HERE / f"{name}.yaml"
    scene = assemble_scenes(read_mechanism(file.read_bytes(), name), branches=False).scenes["ideal"]
    assert (scene.closed.freedoms, scene.closed.loose, scene.off) == (0, (), {})


def test_the_leg_walks() -> None:
    """The foot's path has a flat part: a third of a turn within a millimetre and a half."""
    y = run("jansen_leg")["lower.foot.y"]
    assert (y < y.min() + 1.5e-3).mean() > 0.3 and np.ptp(y) > 0.01


def test_the_shaper_returns_quickly() -> None:
    """Cutting takes 360° − 2 arccos(r/d) of the crank's turn, whatever the link does (long, it hardly matters)."""
    found = run("shaper")
    angle = np.unwrap(found["arm.theta"])
    forward = (np.diff(angle) > 0).mean()
    share = 1 - np.arccos(0.1 / 0.3) / np.pi
    assert forward == pytest.approx(share, abs=0.02)
