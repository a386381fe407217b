"""Starts of pages: closed in the page where the guess closes, else followed from the file's, or refused."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from gudgeon.web.description import build_description
from tests.scenes import loader
from tests.slow import slow_but
from tests.web.node import Answer, in_node, needs_node, same_bits

pytest.importorskip("ziglang", reason="the extra web is not installed: no compiler for pages")


@needs_node
def test_a_start_that_is_its_guess_is_closed_in_the_page(tmp_path: Path) -> None:
    """The pendulum's, for another gravity and another length: nothing is followed from the start of the file."""
    pendulum = gudgeon.load("pendulum")
    options: dict[str, Any] = {"t_end": 2.0, "output": 37}
    weaker, longer = in_node(
        pendulum,
        tmp_path,
        [
            {"parameters": {"g": 1.62}, "options": options},
            {"parameters": {"length": 2.0}, "options": options},
        ],
    )
    options["method"] = "dop853"  # as auto in pages, which have no Taylor series
    assert same_bits(weaker, pendulum.simulate(parameters={"g": 1.62}, **options))
    assert not weaker.is_continued and not longer.is_continued
    assert_near(longer, pendulum.simulate(parameters={"length": 2.0}, **options))


def assert_near(found: Answer, run: Result) -> None:
    """Start and motion, where two ways to the start round differently."""
    assert found.error == ""
    for name in ("q", "v"):
        assert np.abs(found.arrays[name] - np.ravel(getattr(run, name))).max() < 1e-9, name


FAR_GUESS = """
parameters: {omega: 2*pi rad/s, a: 40 mm}
bodies:
  crank: {length: a, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  coupler: {length: 120 mm, mass: 0.5 kg, inertia: 6e-4 kg*m^2}
  rocker: {length: 80 mm, mass: 0.4 kg, inertia: 2e-4 kg*m^2}
ground: {O: [0, 0], C: [100 mm, 10 mm]}
joints:
  A: {revolute: [ground.O, crank.tail]}
  B: {revolute: [crank.head, coupler.tail]}
  C: {revolute: [coupler.head, rocker.head]}
  D: {revolute: [rocker.tail, ground.C]}
drives: {motor: {angle: crank, value: 60 deg + omega*t}}
start: {guess: {rocker.head: [130 mm, 80 mm], coupler.theta: 10 deg, rocker.theta: 60 deg}}
"""
BRIEF: dict[str, Any] = {"t_end": 0.02, "output": 4}
MOVED: dict[str, list[dict[str, float]]] = {
    "jansen_leg": [
        {"turn": 7.0},
        {"bodies.m.mass": 0.1, "bodies.lower.inertia": 1e-4},
        {"bodies.j.length": 0.052},
        {"bodies.j.length": 0.049, "bodies.c.length": 0.0405, "ground.Y.x": -0.039, "turn": 5.0},
    ],
    "four_bar": [
        {"omega": 5.0},
        {"bodies.rocker.mass": 1.0},
        {"a": 0.042},
        {"a": 0.036, "bodies.coupler.length": 0.125},
        {"start.guess.coupler.theta": 0.4},
    ],
}


@needs_node
@pytest.mark.parametrize("name", slow_but(["four_bar"], MOVED))
def test_a_start_that_only_python_finds_is_followed(name: str, tmp_path: Path) -> None:
    """Speeds and masses leave it; from other lengths the file's assembly is Python's, some per cent away."""
    simulation = (
        gudgeon.load("mechanisms/gallery/jansen_leg.yaml") if name == "jansen_leg" else loader(tmp_path)(FAR_GUESS)
    )
    assert '"start":null' not in build_description(simulation.compiled)
    requested: list[dict[str, Any]] = [{"parameters": one, "options": BRIEF} for one in MOVED[name]]
    found = in_node(simulation, tmp_path, requested)
    for one, parameters in zip(found, MOVED[name], strict=True):
        assert_near(one, simulation.simulate(parameters=parameters, **BRIEF))
    assert not any(one.is_continued for one in found[:2]) and any(one.is_continued for one in found)


@needs_node
def test_the_other_assembly_is_not_taken_and_the_end_of_one_is_told(tmp_path: Path) -> None:
    """By the cosine rule: coupler and rocker reach from the crank's pin to C while they are long enough together."""
    four_bar = loader(tmp_path)(FAR_GUESS)
    name, options = "bodies.coupler.length", BRIEF
    lengths = (0.16, 0.1, 0.03, 0.3, 0.001)
    requested: list[dict[str, Any]] = [{"parameters": {name: one}, "options": options} for one in lengths]
    both: dict[str, Any] = {"parameters": {name: 0.001, "bodies.rocker.mass": 1.0}, "options": options}
    *found, long, short, part = in_node(four_bar, tmp_path, [*requested, both])
    pin = 0.04 * np.exp(1j * np.pi / 3)
    apart = abs(0.1 + 0.01j - pin)
    at = four_bar.source.coordinates.index("coupler.theta")

    def turned(q: Any) -> float:
        """The coupler, from the line between the crank's pin and C."""
        return float(np.angle((0.1 + 0.01j - pin) / np.exp(1j * q[at])))

    side = np.sign(turned(four_bar.simulate(**options).q[0]))
    for one, length in zip(found, lengths, strict=False):
        assert one.error == ""
        cosine = (length**2 + apart**2 - 0.08**2) / (2.0 * length * apart)
        assert turned(one.arrays["q"]) == pytest.approx(side * np.arccos(cosine), abs=1e-9)
    for one, end in ((long, apart + 0.08), (short, apart - 0.08)):
        message = re.search(rf"no longer closes beyond {name} = ([\d.]+) mm", one.error)
        assert message and float(message[1]) == pytest.approx(1e3 * end, rel=1e-3)
    message = re.search(r"beyond ([\d.]+) % of the way", part.error)
    assert message and float(message[1]) == pytest.approx(100 * (0.2 - apart) / 0.119, rel=1e-2)


@needs_node
def test_rows_that_depend_on_each_other_are_followed_too(tmp_path: Path) -> None:
    """A third equal crank under a parallelogram: no step of C closes its rows where each must give its own."""
    text = (
        FAR_GUESS.replace("60 deg + omega*t}", "50 deg + omega*t}")
        .replace("120 mm", "b")
        .replace("80 mm, mass", "a, mass")
    )
    text = text.replace("a: 40 mm}", "a: 40 mm, b: 100 mm}").replace("C: [100 mm, 10 mm]", "C: [b, 0], E: [b/2, 0]")
    text = text.replace("inertia: 6e-4 kg*m^2}", "inertia: 6e-4 kg*m^2, points: {M: [b/2, 0]}}")
    text = text.replace("ground: {", "  third: {length: a, mass: 0.1 kg, inertia: 1e-4 kg*m^2}\nground: {")
    text = text.replace(
        "joints:", "joints:\n  E: {revolute: [ground.E, third.tail]}\n  F: {revolute: [third.head, coupler.M]}"
    )
    text = (
        text[: text.index("start:")] + "start: {guess: {coupler.theta: 0, rocker.theta: 50 deg, third.theta: 50 deg}}"
    )
    simulation = loader(tmp_path)(text)
    moved: list[dict[str, float]] = [{"a": 0.042}, {"b": 0.11, "omega": 5.0}]
    found = in_node(simulation, tmp_path, [{"parameters": one, "options": BRIEF} for one in moved])
    for one, parameters in zip(found, moved, strict=True):
        assert_near(one, simulation.simulate(parameters=parameters, **BRIEF))
