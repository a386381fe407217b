"""A joint type is one file: two that gudgeon does not have, from tests/kinds/made_up, are read, drawn, printed and run.

`roller` declares its symbol and its gap, `level` nothing but its row.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.failures import format_length
from gudgeon.drawing.failures import draw_gaps
from gudgeon.drawing.picture import build_figure, encode_figure
from gudgeon.drawing.shapes import Disc, Line
from gudgeon.drawing.sketch import make_sketch
from gudgeon.generator.kinds import joints
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.pipeline import derive_scene
from gudgeon.generator.targets.format_tables import print_format_tables
from gudgeon.generator.targets.json_schema import make_schema
from gudgeon.generator.targets.latex import render_equations_tex, render_equations_text
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals
from tests.drawing.drawn import drawn

LENGTH, RADIUS, OMEGA, MASS, GRAVITY = 0.04, 0.01, 20.0, 0.3, 9.81
MACHINE = f"""format: gudgeon/1
name: made_up
gravity: [0, -{GRAVITY}]
bodies:
  crank: {{length: {LENGTH}, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}
  push: {{mass: {MASS} kg, inertia: 1e-4 kg*m^2}}
  twin: {{mass: 0.2 kg, inertia: 1e-4 kg*m^2}}
ground: {{O: [0, 0], P: [100 mm, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  way: {{translational: [ground.O, push.origin], axis: [0, 1], angle: 0}}
  other: {{translational: [ground.P, twin.origin], axis: [0, 1], angle: 0}}
  face: {{roller: [crank.head, push.origin], direction: [-2, 0], radius: {RADIUS}}}
  even: {{level: [push.origin, twin.origin]}}
drives: {{motor: {{angle: crank, value: 30 deg + {OMEGA} rad/s * t}}}}
"""
OPEN = MACHINE + "start: {set: {push.y: 70 mm, twin.y: 20 mm}}\n"


@pytest.fixture(autouse=True)
def made_up(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The folder of joint types has two files more."""
    folder = Path(__file__).parent / "made_up"
    monkeypatch.setattr(joints, "__path__", [*joints.__path__, str(folder)])
    find_joint_types.cache_clear()
    yield
    find_joint_types.cache_clear()
    for file in folder.glob("*.py"):
        sys.modules.pop(f"{joints.__name__}.{file.stem}", None)


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_it_runs_by_its_closed_form(tmp_path: Path, formulation: str) -> None:
    """The follower is a radius above the crank pin, its twin as high; the roller bears the weight of both."""
    file = tmp_path / "made_up.yaml"
    file.write_text(MACHINE)  # derived anew: the key of what is stored does not contain files of tests
    run = gudgeon.load(file, formulation=formulation, regenerate=True).simulate(0.2, output=21)
    angle = np.radians(30.0) + OMEGA * run.t
    np.testing.assert_allclose(run["push.y"], LENGTH * np.sin(angle) + RADIUS, atol=1e-12)
    np.testing.assert_allclose(run["twin.y"], run["push.y"], atol=1e-12)
    force = (MASS + 0.2) * (GRAVITY - LENGTH * OMEGA**2 * np.sin(angle))
    np.testing.assert_allclose(run["face.Fy"], force, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(run["face.M"], 0.0, atol=1e-12)
    assert run.compiled is not None
    assert compute_newton_euler_residuals(run.compiled, run.p, run.q, run.evaluation).max() < 1e-9
    assert run.meaning("face.Fy").endswith("on push at the pin, ground axes")


def test_it_is_drawn_by_its_own_symbol_or_by_squares() -> None:
    found = drawn(MACHINE)
    sketch = make_sketch(found.configuration)
    (roller,) = (shape for shape in sketch.of("joint face") if shape.role == "roller")
    assert isinstance(roller, Disc) and roller.radius == RADIUS
    np.testing.assert_allclose(roller.centre, found.configuration.get_position("crank.head"))
    (face,) = (shape for shape in sketch.of("joint face") if shape.role == "rail")
    assert isinstance(face, Line)
    np.testing.assert_allclose(face.points[:, 1], found.configuration.get_position("push.origin")[1])
    assert [shape.role for shape in sketch.of("joint even")] == ["block", "block"]
    svg = encode_figure(build_figure([sketch], [""], "x"), ".svg").decode()
    assert all(f'id="{kind}joint-{name}"' in svg for kind in ("", "name-") for name in ("face", "even"))


def test_its_gap_is_what_its_row_lacks() -> None:
    """Of the roller a line along the normal, of the other one a number: the distance of its points means nothing."""
    found = drawn(OPEN)
    residual = dict(zip(found.problem.names, found.problem.compute_residual(found.configuration.q), strict=True))
    shapes, labels = draw_gaps(found.problem, found.configuration)
    texts = {label.part: label.text for label in labels}
    lines = {shape.part: shape for shape in shapes}
    face, even = residual["face.distance"], residual["even.height"]
    assert min(abs(face), abs(even)) > 1e-3
    line = lines["gap face"]
    assert isinstance(line, Line)
    tilt = found.configuration.get_angle("push")
    np.testing.assert_allclose(line.points[1] - line.points[0], [-face * np.sin(tilt), face * np.cos(tilt)], atol=1e-15)
    assert texts["gap face"] == f"face: {format_length(abs(face))}"
    assert "gap even" not in lines and texts["gap even"] == f"even: {format_length(even)}"


def test_documents_and_tables_have_it() -> None:
    model = derive_scene(MACHINE.encode(), "made_up.yaml", "ideal")
    for text in (render_equations_text(model), render_equations_tex(model)):
        assert "roller on a flat face" in text and "points at one height" in text
        assert "a point of the first body keeps a distance from a line of the second" in text
    assert "=====---=====>" in render_equations_text(model)
    assert "radius of the roller" in str(print_format_tables()) and "radius of the roller" in str(make_schema())
