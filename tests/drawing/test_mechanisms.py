"""Every mechanism that comes with gudgeon, and those of the tests, drawn at their start: what is where."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.assembly.branches import find_assemblies  # noqa: E402
from gudgeon.assembly.mobility import compute_admissible_velocities, find_mobility  # noqa: E402
from gudgeon.drawing.configuration import Configuration  # noqa: E402
from gudgeon.drawing.failures import draw_degrees_of_freedom, draw_gaps  # noqa: E402
from gudgeon.drawing.labels import NameLabels  # noqa: E402
from gudgeon.drawing.layout import make_layout  # noqa: E402
from gudgeon.drawing.picture import build_figure, encode_figure  # noqa: E402
from gudgeon.drawing.shapes import Disc, Label, Line  # noqa: E402
from gudgeon.drawing.sketch import make_sketch  # noqa: E402
from gudgeon.errors import GudgeonError  # noqa: E402
from tests.drawing.drawn import ROOT, boxes, drawn  # noqa: E402
from tests.slow import slow_but  # noqa: E402

FILES = [
    *sorted((ROOT / "mechanisms").rglob("*.yaml")),
    *sorted((ROOT / "tests/mechanisms/described").glob("*.yaml")),
    *(ROOT / f"tests/mechanisms/valid/{name}.yaml" for name in ("every_kind", "shapes")),
    *(ROOT / f"tests/mechanisms/methods/{name}.yaml" for name in ("geared_chain", "trammel")),
]

CROWDED = "every_kind", "nine_bar_press", "shapes", "geared_chain", "car_axis", "slider_crank_spring", "belt_block"
KINDS = [file for file in FILES if file.stem in CROWDED]


@pytest.mark.parametrize("file", slow_but(KINDS, FILES), ids=lambda file: file.stem)
def test_everything_is_drawn_once_and_no_name_lies_on_another(file: Path) -> None:
    found = drawn(file)
    sketch = make_sketch(found.configuration)
    picture = build_figure([sketch], [""], "x")
    svg = encode_figure(picture, ".svg").decode()
    ids = re.findall(r'<g id="([^"]+)"', svg)
    mechanism = found.mechanism
    expected = [f"body-{name}" for name in mechanism.bodies] + [f"joint-{name}" for name in mechanism.joints]
    expected += [f"drive-{name}" for name in mechanism.drives] + [f"force-{name}" for name in mechanism.forces]
    expected += ["gravity"] if mechanism.gravity and not all(g.is_zero for g in mechanism.gravity) else []
    assert set(expected) <= set(ids)
    assert {f"name-{name}" for name in expected} <= set(ids)
    assert len(set(ids)) == len(ids)
    placed = dict(boxes(picture))
    assert len(placed) == len(sketch.labels)
    for (one, a), (other, b) in combinations(placed.items(), 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], (one, other)
    width, height = picture.get_size_inches() * picture.dpi
    assert all(a[0] >= 0 and a[1] >= 0 and a[2] <= width * 1.01 and a[3] <= height for a in placed.values())
    assert encode_figure(build_figure([make_sketch(found.configuration)], [""], "x"), ".svg").decode() == svg


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_pins_and_bodies_are_where_the_start_has_them(file: Path) -> None:
    """Pins at the points of both bodies, which a closed start joins; outlines around all points of a body."""
    configuration = drawn(file).configuration
    sketch = make_sketch(configuration)
    for part in configuration.iterate_parts("joints", "revolute"):
        (pin,) = [shape for shape in sketch.of(f"joint {part.name}") if shape.role == "pin"]
        for end in part.ends:
            assert isinstance(pin, Disc) and pin.centre == pytest.approx(configuration.get_position(end), abs=1e-9)
    for part in configuration.iterate_parts("joints", "distance"):
        (rod,) = [shape for shape in sketch.of(f"joint {part.name}") if shape.role == "rod"]
        assert isinstance(rod, Line)
        length = configuration.get_parameter(f"joints.{part.name}.length")
        assert float(np.hypot(*(rod.points[1] - rod.points[0]))) == pytest.approx(length, rel=1e-9)
    for part in configuration.iterate_parts("joints", "gear"):
        wheels = [shape for shape in sketch.of(f"joint {part.name}") if shape.role in ("wheel", "ring")]
        one, other = (shape for shape in wheels if isinstance(shape, Disc))
        span, inside = float(np.hypot(*(other.centre - one.centre))), part.options["internal"] == "true"
        assert span == pytest.approx(other.radius - one.radius if inside else other.radius + one.radius, rel=1e-6)


def test_names_without_room_are_left_out_and_counted() -> None:
    """As many names as do not fit at one place: those that are there lie apart, the others are told."""
    sketch = make_sketch(drawn(ROOT / "mechanisms/pendulum.yaml").configuration)
    crowd = tuple(Label(f"joint x{k}", "joint", f"a_long_name_{k}", np.zeros(2)) for k in range(400))
    picture = build_figure([replace(sketch, labels=crowd)], [""], "x")
    svg = encode_figure(picture, ".svg").decode()
    placed = dict(boxes(picture))
    assert 10 < len(placed) < 400 and f"{400 - len(placed)} names omitted" in svg
    for a, b in combinations(placed.values(), 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


BAR = """format: gudgeon/1
name: bar
bodies:
  crank: {length: 40 mm, mass: 31 g, inertia: 5.2e-6 kg*m^2}
  coupler: {length: 60 mm, mass: 94 g, inertia: 1.16e-4 kg*m^2}
  rocker: {length: 50 mm, mass: 63 g, inertia: 3.5e-5 kg*m^2}
ground: {A0: [0, 0], B0: [180 mm, 0]}
joints:
  A0: {revolute: [ground.A0, crank.tail]}
  A: {revolute: [crank.head, coupler.tail]}
  B: {revolute: [coupler.head, rocker.head]}
  B0: {revolute: [ground.B0, rocker.tail]}
drives: {motor: {angle: crank, value: 90 deg}}
start: {guess: {coupler.theta: 20 deg, rocker.theta: 80 deg}}
"""
RODS = """format: gudgeon/1
name: rods
bodies:
  slide: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  beam: {length: 100 mm, mass: 1 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0], P: [300 mm, 0], Q: [0, 50 mm]}
joints:
  way: {translational: [ground.O, slide.origin], axis: [1, 0]}
  rod: {distance: [ground.P, slide.origin], length: 80 mm}
  foot: {revolute: [ground.Q, beam.tail]}
  slot: {point_on_line: [beam.head, ground.P], direction: [1, 0]}
drives: {push: {coordinate: slide.x, value: 100 mm}}
start: {set: {beam.theta: 10 deg}}
"""


@pytest.mark.parametrize("text", [BAR, RODS])
def test_a_gap_is_as_long_as_the_linkage_is_open(text: str) -> None:
    """Of each joint or drive the length of its rows' residual, joined at one end; no other has a gap."""
    found = drawn(text)
    residual, problem = found.problem.compute_residual(found.configuration.q), found.problem
    shapes, labels = draw_gaps(problem, found.configuration)
    lengths = dict[str, list[float]]()
    for owner, unit, left in zip(problem.owners, problem.units, residual, strict=True):
        if unit == "m" and owner != "start":
            lengths.setdefault(owner, []).append(left)
    sizes = {f"gap {owner}": float(np.linalg.norm(left)) for owner, left in lengths.items()}
    spans = {s.part: float(np.hypot(*(s.points[1] - s.points[0]))) for s in shapes if isinstance(s, Line)}
    expected = {part: size for part, size in sizes.items() if size > 2e-3 * max(sizes.values())}
    assert len(expected) > 1 and set(expected) <= set(spans)
    for part, size in expected.items():
        if part != "gap rod":  # whose row is quadratic in its length
            assert spans[part] == pytest.approx(size, rel=1e-9), part
    rod = next((s for s in shapes if s.part == "gap rod"), None)
    if isinstance(rod, Line):
        reach = float(np.hypot(*(found.configuration.get_position("slide.origin") - [0.3, 0.0])))
        assert spans["gap rod"] == pytest.approx(abs(reach - 0.08), rel=1e-12)
    assert {label.part for label in labels} >= set(expected)
    svg = encode_figure(
        build_figure([make_sketch(found.configuration, shapes_on_top=shapes, labels=labels)], [""], "x"), ".svg"
    ).decode()
    assert all(f'id="{part.replace(" ", "-")}"' in svg for part in spans)


LOOSE = """format: gudgeon/1
name: loose
bodies:
  crank: {length: 40 mm, mass: 31 g, inertia: 5.2e-6 kg*m^2}
  coupler: {length: 60 mm, mass: 94 g, inertia: 1.16e-4 kg*m^2}
  stray: {length: 50 mm, mass: 63 g, inertia: 3.5e-5 kg*m^2}
  block: {mass: 63 g, inertia: 3.5e-5 kg*m^2}
ground: {A0: [0, 0]}
joints:
  A0: {revolute: [ground.A0, crank.tail]}
  A: {revolute: [crank.head, coupler.tail]}
  way: {translational: [ground.A0, block.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 90 deg}}
start: {guess: {coupler.theta: 20 deg, stray.x: 80 mm, block.x: 70 mm}}
"""


def test_what_may_move_is_told_by_arrows_along_it() -> None:
    found = drawn(LOOSE)
    linkage, configuration = found.linkage, found.configuration
    motions = compute_admissible_velocities(linkage, linkage.p, configuration.q)
    mobility = find_mobility(linkage, linkage.p, configuration.q)
    assert motions.shape[1] == mobility.freedoms == 5 and mobility.unconnected_bodies == ("stray",)
    assert np.abs(linkage.closed_phi_q(0.0, configuration.q, linkage.p) @ motions).max() < 1e-12
    shapes, labels = draw_degrees_of_freedom(found.problem, configuration, 1e-3, mobility.unconnected_bodies)
    heads = {part: [s for s in shapes if s.part == part and s.role == "free head"] for part in {s.part for s in shapes}}
    assert {part: len(found) for part, found in heads.items()} == {"free coupler": 2, "free stray": 5, "free block": 2}
    assert [label.part for label in labels] == ["free stray"]
    for part, along in (("free coupler", configuration.get_angle("coupler") + np.pi / 2), ("free block", 0.0)):
        tips = [head.points[0] for head in heads[part] if isinstance(head, Line)]
        span = tips[0] - tips[1]
        assert abs(span @ [-np.sin(along), np.cos(along)]) < 1e-12 * float(np.hypot(*span)) + 1e-15
    sketch = make_sketch(
        configuration, shapes_on_top=shapes, labels=labels, unconnected_bodies=frozenset(mobility.unconnected_bodies)
    )
    assert {s.role for s in sketch.of("body stray")} == {"loose"} and {s.role for s in sketch.of("body crank")} == {
        "body"
    }


def test_assemblies_share_a_scale_and_differ_in_what_is_drawn() -> None:
    found = drawn(ROOT / "mechanisms/four_bar.yaml")
    closed = find_assemblies(found.linkage, found.linkage.p, found.configuration.q, ())
    assert len(closed) == 2
    places = [make_sketch(replace(found.configuration, q=one.q)).of("joint B")[0] for one in closed]
    one, other = (disc.centre for disc in places if isinstance(disc, Disc))
    # mirror images in the line from the crank's head to the rocker's pivot
    a, b = found.configuration.get_position("crank.head"), np.array([0.1, 0.0])
    along = (b - a) / np.hypot(*(b - a))
    mirrored = a + 2 * ((one - a) @ along) * along - (one - a)
    assert other == pytest.approx(mirrored, abs=1e-9)


def test_the_plan_of_a_motion_holds_all_of_it() -> None:
    """Rails reach as far as their sliders go."""
    configuration = drawn(ROOT / "mechanisms/slider_crank.yaml").configuration
    configurations = [
        replace(configuration, q=configuration.q + [0, 0, 0, 0, 0, 0, shift, 0, 0]) for shift in (0.0, -0.03, 0.02)
    ]
    plan = make_layout(configurations)
    low, high = plan.travel["cylinder"]
    assert (low, high) == pytest.approx((0.14, 0.19), abs=1e-9)
    rail = next(s for s in make_sketch(configuration, plan).of("joint cylinder") if s.role == "rail")
    assert isinstance(rail, Line) and rail.points[0, 0] < 0.14 and rail.points[1, 0] > 0.19


def test_what_leads_to_a_name_begins_at_the_edge_of_what_is_named() -> None:
    sketch, clear = make_sketch(drawn(ROOT / "mechanisms/pendulum.yaml").configuration), 0.02
    crowd = tuple(Label(f"joint x{k}", "joint", f"name_{k}", np.zeros(2), clear) for k in range(60))
    picture = build_figure([replace(sketch, labels=crowd)], [""], "x")
    picture.draw_without_rendering()
    (ax,) = picture.axes
    (names,) = [artist for artist in ax.get_children() if isinstance(artist, NameLabels)]
    feet = np.array([np.asarray(line.get_xydata(), float)[0] for line in names.leader_lines])
    begins = ax.transData.inverted().transform(feet)
    assert len(begins) > 10
    assert np.hypot(*begins.T) == pytest.approx(clear, rel=1e-9)


def test_a_name_stands_outside_the_arrow_around_its_pin() -> None:
    sketch = make_sketch(drawn(ROOT / "mechanisms/four_bar.yaml").configuration)
    (bow, *_) = (s.points for s in sketch.of("drive motor") if isinstance(s, Line))
    (label,) = (label for label in sketch.labels if label.part == "joint A0")
    assert label.clearance == pytest.approx(np.hypot(*(bow[0] - label.position)))


def test_what_an_earlier_version_wrote_is_told() -> None:
    configuration = drawn(ROOT / "mechanisms/four_bar.yaml").configuration
    with pytest.raises(GudgeonError, match="run the scene again"):
        Configuration(replace(configuration.source, parts=()), configuration.p, configuration.q)
