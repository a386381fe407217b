"""Drawings that move without being drawn again: every shipped mechanism beside its drawing, in Python and in Node."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.drawing.configuration import Configuration  # noqa: E402
from gudgeon.drawing.layout import Layout, make_layout  # noqa: E402
from gudgeon.drawing.rig import FRAME_TOL, Rig, make_rig  # noqa: E402
from gudgeon.drawing.shapes import Disc, Shape, Sketch  # noqa: E402
from gudgeon.drawing.sketch import compute_common_box, make_sketch  # noqa: E402
from gudgeon.loading.shipped import list_shipped_mechanisms  # noqa: E402
from gudgeon.model.parameters import compute_parameter_values  # noqa: E402
from gudgeon.results.figures.configurations import compute_configuration, select_configurations  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402
from gudgeon.web.description import build_description  # noqa: E402
from gudgeon.web.page import read_file  # noqa: E402
from tests.slow import slow_but  # noqa: E402
from tests.web.node import needs_node, node  # noqa: E402

SHORT = {"nine_bar_press": 0.1, "andrews_squeezer": 0.03}  # s of these; a second of the others
# what is not carried where lengths change too, and how far off it is then (share of the size): corners of plates whose
# sides turn. Where the file's numbers hold they are exact as well.
NEAR = 1e-3


def keyed(sketch: Sketch) -> Iterator[tuple[tuple[str, int], Shape]]:
    counts = dict[str, int]()
    for shape in sketch.shapes:
        counts[shape.part] = counts.get(shape.part, -1) + 1
        yield (shape.part, counts[shape.part]), shape


def points(shape: Shape) -> Any:
    return shape.centre[None] if isinstance(shape, Disc) else shape.points


Box = tuple[Any, Any]
KINDS = ["andrews_squeezer", "belt_block", "car_axis", "nine_bar_press", "scotch_yoke", "slider_crank_spring"]


def ran(name: str, scene: str = "ideal") -> tuple[Result, Rig, Layout, Box]:
    run = gudgeon.load(name, scene).simulate(SHORT.get(name, 1.0), output=120)
    motion = select_configurations(run, 13)
    plan = make_layout(motion)
    return run, make_rig(motion, plan), plan, compute_common_box(motion, [plan])


def off(rig: Rig, configuration: Configuration, plan: Layout, box: Box) -> float:
    """How far the worst point is from where it is drawn, a share of the size."""
    drawn = dict(keyed(make_sketch(configuration, plan, box=box, shows_insets=False)))
    carried = {id(one.shape): one for one in rig.shapes}
    worst = 0.0
    for key, shape in keyed(rig.sketch):
        there, here = drawn[key], carried[id(shape)].move_to(configuration)
        worst = max(worst, float(np.abs(points(here) - points(there)).max()))
        if isinstance(here, Disc) and isinstance(there, Disc):
            worst = max(worst, abs(here.radius - there.radius))
    return worst / rig.size


@pytest.mark.parametrize("name", slow_but(KINDS, list_shipped_mechanisms()))
def test_points_are_where_they_are_drawn(name: str) -> None:
    """At samples that the rig was not made from, arrows of drives in the sense that they had."""
    run, rig, plan, box = ran(name)
    rows = np.random.default_rng(4).integers(0, len(run.t), 12)
    first = run.v[0]
    others = [replace(compute_configuration(run, float(run.t[k])), v=first) for k in rows]
    assert max(off(rig, configuration, plan, box) for configuration in others) < FRAME_TOL
    assert max(one.max_error for one in rig.shapes) < NEAR * rig.size


def test_a_slider_with_play_is_carried_between_its_walls() -> None:
    run, rig, plan, box = ran("guided_slider_crank", "hard")
    others = [replace(compute_configuration(run, float(t)), v=run.v[0]) for t in run.t[5::9]]
    assert np.ptp([configuration.q[7] for configuration in others]) > 1.9e-3  # from wall to wall
    assert max(off(rig, configuration, plan, box) for configuration in others) < FRAME_TOL
    numbers = compute_parameter_values(gudgeon.load("guided_slider_crank", "hard").compiled, {"parameters.c": 2e-4})[0]
    assert off(rig, replace(others[0], p=numbers), plan, box) < FRAME_TOL


def test_a_length_moves_what_it_carries() -> None:
    """The four-bar with another crank and another coupler point, at coordinates that close nothing."""
    run, rig, plan, box = ran("four_bar")
    place = {slot.address: k for k, slot in enumerate(run.source.parameters)}
    p, *_ = compute_parameter_values(
        gudgeon.load("four_bar").compiled, {"bodies.rocker.length": 0.09, "ground.B0.x": 0.13}
    )
    assert p[place["bodies.rocker.length"]] == 0.09
    configuration = replace(select_configurations(run, 2)[1], p=p, v=run.v[0])
    assert off(rig, configuration, plan, box) < NEAR
    drawn = make_sketch(configuration, plan, box=box, shows_insets=False).of("joint B0")
    carried = {id(one.shape): one for one in rig.shapes}
    for shape, there in zip(rig.sketch.of("joint B0"), drawn, strict=True):
        assert np.allclose(points(carried[id(shape)].move_to(configuration)), points(there), atol=FRAME_TOL * rig.size)


PLACES = """
const fs = require("fs"), asked = JSON.parse(fs.readFileSync(0, "utf-8")), rig = new Rig(asked.rig, asked.points);
console.log(JSON.stringify(asked.configurations.map(({q, p, loads}) => {
    rig.update(q, p, (name) => loads[name]);
    return rig.shapes.map((shape) => rig.computePoints(shape).flat());
})));
"""


LINKAGES = ("slider_crank_spring", "andrews_squeezer", "car_axis")


@needs_node
@pytest.mark.parametrize("name", slow_but(LINKAGES[1:], LINKAGES))
def test_a_page_places_them_alike(name: str, tmp_path: Path) -> None:
    """drawing.js against MovingShape.move_to; the page has numbers to 1e-11 of the size."""
    run, rig, *_ = ran(name)
    program = node()
    assert program
    file = tmp_path / "places.js"
    file.write_text(read_file("drawing.js") + PLACES, encoding="utf-8")
    rows, about = [0, 40, 99], json.loads(build_description(gudgeon.load(name).compiled))
    configurations = [replace(compute_configuration(run, float(run.t[k])), v=run.v[0]) for k in rows]
    message = [{"q": one.q.tolist(), "p": one.p.tolist(), "loads": dict(one.loads)} for one in configurations]
    requested = {"rig": rig.to_json_data(), "points": about["points"], "configurations": message}
    done = subprocess.run([program, str(file)], input=json.dumps(requested), capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    for configuration, placed in zip(configurations, json.loads(done.stdout), strict=True):
        for carried, found in zip(rig.shapes, placed, strict=True):
            there = points(carried.move_to(configuration))
            assert np.abs(np.reshape(found, (-1, 2)) - there).max() < 0.1 * FRAME_TOL * rig.size
