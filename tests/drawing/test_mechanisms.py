"""Every mechanism that comes with gudgeon, and those of the tests, drawn at their start: what is where."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.assembly.branches import find_assemblies  # noqa: E402
from gudgeon.assembly.closure import Closure  # noqa: E402
from gudgeon.assembly.mobility import find_mobility, free_motions  # noqa: E402
from gudgeon.drawing.failures import freedoms, gaps  # noqa: E402
from gudgeon.drawing.insets import eccentricity, magnification  # noqa: E402
from gudgeon.drawing.labels import Names  # noqa: E402
from gudgeon.drawing.picture import as_bytes, figure_of  # noqa: E402
from gudgeon.drawing.plan import make_plan  # noqa: E402
from gudgeon.drawing.posture import Posture  # noqa: E402
from gudgeon.drawing.shapes import Disc, Label, Line, Sketch, unit_vector  # noqa: E402
from gudgeon.drawing.sketch import make_sketch  # noqa: E402
from gudgeon.errors import GudgeonError  # noqa: E402
from gudgeon.generator.pipeline import closed_linkage  # noqa: E402
from gudgeon.generator.reader.read import read_mechanism  # noqa: E402
from gudgeon.model.compiled import Array  # noqa: E402
from tests.integrators.test_guide import ARM, HEAD, ORACLE, C  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FILES = [
    *sorted((ROOT / "mechanisms").rglob("*.yaml")),
    *sorted((ROOT / "tests/mechanisms/described").glob("*.yaml")),
    *(ROOT / f"tests/mechanisms/valid/{name}.yaml" for name in ("every_kind", "shapes")),
    *(ROOT / f"tests/mechanisms/methods/{name}.yaml" for name in ("geared_chain", "trammel")),
]


@dataclass(frozen=True)
class Drawn:
    mechanism: Any
    linkage: Any
    closure: Closure
    posture: Posture


@cache
def drawn(file: Path | str) -> Drawn:
    """The last scene of a file (where it has play, one with it) at its start; of a text its own."""
    text = file.encode() if isinstance(file, str) else file.read_bytes()
    mechanism = read_mechanism(text, "drawn.yaml", None)
    linkage, _ = closed_linkage(mechanism, list(mechanism.scenes)[-1])
    closure = Closure(linkage, linkage.p, 0.0)
    with np.errstate(all="ignore"):
        q, _ = closure.nearest()
    return Drawn(mechanism, linkage, closure, Posture(linkage.source, linkage.p, q))


def boxes(picture: Any) -> Iterator[tuple[str, tuple[float, ...]]]:
    for ax in picture.axes:
        for artist in ax.get_children():
            if isinstance(artist, Names):
                yield from artist.boxes.items()


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_everything_is_drawn_once_and_no_name_lies_on_another(file: Path) -> None:
    found = drawn(file)
    sketch = make_sketch(found.posture)
    picture = figure_of([sketch], [""], "x")
    svg = as_bytes(picture, ".svg").decode()
    ids = re.findall(r'<g id="([^"]+)"', svg)
    mechanism = found.mechanism
    wanted = [f"body-{name}" for name in mechanism.bodies] + [f"joint-{name}" for name in mechanism.joints]
    wanted += [f"drive-{name}" for name in mechanism.drives] + [f"force-{name}" for name in mechanism.forces]
    wanted += ["gravity"] if mechanism.gravity and not all(g.is_zero for g in mechanism.gravity) else []
    assert set(wanted) <= set(ids)
    assert {f"name-{name}" for name in wanted} <= set(ids)
    assert len(set(ids)) == len(ids)
    placed = dict(boxes(picture))
    assert len(placed) == len(sketch.labels)
    for (one, a), (other, b) in combinations(placed.items(), 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], (one, other)
    width, height = picture.get_size_inches() * picture.dpi
    assert all(a[0] >= 0 and a[1] >= 0 and a[2] <= width * 1.01 and a[3] <= height for a in placed.values())
    assert as_bytes(figure_of([make_sketch(found.posture)], [""], "x"), ".svg").decode() == svg


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_pins_and_bodies_are_where_the_start_has_them(file: Path) -> None:
    """Pins at the points of both bodies, which a closed start joins; outlines around all points of a body."""
    posture = drawn(file).posture
    sketch = make_sketch(posture)
    for part in posture.parts("joints", "revolute"):
        (pin,) = [shape for shape in sketch.of(f"joint {part.name}") if shape.role == "pin"]
        for end in part.ends:
            assert isinstance(pin, Disc) and pin.centre == pytest.approx(posture.place(end), abs=1e-9)
    for part in posture.parts("joints", "distance"):
        (rod,) = [shape for shape in sketch.of(f"joint {part.name}") if shape.role == "rod"]
        assert isinstance(rod, Line)
        length = posture.number(f"joints.{part.name}.length")
        assert float(np.hypot(*(rod.points[1] - rod.points[0]))) == pytest.approx(length, rel=1e-9)
    for part in posture.parts("joints", "gear"):
        wheels = [shape for shape in sketch.of(f"joint {part.name}") if shape.role in ("wheel", "ring")]
        one, other = (shape for shape in wheels if isinstance(shape, Disc))
        span, inside = float(np.hypot(*(other.centre - one.centre))), part.options["internal"] == "true"
        assert span == pytest.approx(other.radius - one.radius if inside else other.radius + one.radius, rel=1e-6)


def test_names_without_room_are_left_out_and_counted() -> None:
    """As many names as do not fit at one place: those that are there lie apart, the others are told."""
    sketch = make_sketch(drawn(ROOT / "mechanisms/pendulum.yaml").posture)
    crowd = tuple(Label(f"joint x{k}", "joint", f"a_long_name_{k}", np.zeros(2)) for k in range(400))
    picture = figure_of([replace(sketch, labels=crowd)], [""], "x")
    svg = as_bytes(picture, ".svg").decode()
    placed = dict(boxes(picture))
    assert 10 < len(placed) < 400 and f"{400 - len(placed)} names left out" in svg
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
    residual, closure = found.closure.residual(found.posture.q), found.closure
    shapes, labels = gaps(closure, found.posture)
    lengths = dict[str, list[float]]()
    for owner, unit, left in zip(closure.owners, closure.units, residual, strict=True):
        if unit == "m" and owner != "start":
            lengths.setdefault(owner, []).append(left)
    sizes = {f"gap {owner}": float(np.linalg.norm(left)) for owner, left in lengths.items()}
    spans = {s.part: float(np.hypot(*(s.points[1] - s.points[0]))) for s in shapes if isinstance(s, Line)}
    wanted = {part: size for part, size in sizes.items() if size > 2e-3 * max(sizes.values())}
    assert len(wanted) > 1 and set(wanted) <= set(spans)
    for part, size in wanted.items():
        if part != "gap rod":  # whose row is quadratic in its length
            assert spans[part] == pytest.approx(size, rel=1e-9), part
    rod = next((s for s in shapes if s.part == "gap rod"), None)
    if isinstance(rod, Line):
        reach = float(np.hypot(*(found.posture.place("slide.origin") - [0.3, 0.0])))
        assert spans["gap rod"] == pytest.approx(abs(reach - 0.08), rel=1e-12)
    assert {label.part for label in labels} >= set(wanted)
    svg = as_bytes(figure_of([make_sketch(found.posture, more=shapes, labels=labels)], [""], "x"), ".svg").decode()
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
    linkage, posture = found.linkage, found.posture
    motions = free_motions(linkage, linkage.p, posture.q)
    mobility = find_mobility(linkage, linkage.p, posture.q)
    assert motions.shape[1] == mobility.freedoms == 5 and mobility.loose == ("stray",)
    assert np.abs(linkage.closed_phi_q(0.0, posture.q, linkage.p) @ motions).max() < 1e-12
    shapes, labels = freedoms(found.closure, posture, 1e-3, mobility.loose)
    heads = {part: [s for s in shapes if s.part == part and s.role == "free head"] for part in {s.part for s in shapes}}
    assert {part: len(found) for part, found in heads.items()} == {"free coupler": 2, "free stray": 5, "free block": 2}
    assert [label.part for label in labels] == ["free stray"]
    for part, along in (("free coupler", posture.theta("coupler") + np.pi / 2), ("free block", 0.0)):
        tips = [head.points[0] for head in heads[part] if isinstance(head, Line)]
        span = tips[0] - tips[1]
        assert abs(span @ [-np.sin(along), np.cos(along)]) < 1e-12 * float(np.hypot(*span)) + 1e-15
    sketch = make_sketch(posture, more=shapes, labels=labels, loose=frozenset(mobility.loose))
    assert {s.role for s in sketch.of("body stray")} == {"loose"} and {s.role for s in sketch.of("body crank")} == {
        "body"
    }


def test_a_journal_is_drawn_where_it_is_at_the_scale_that_is_told() -> None:
    """Against the eccentricity that the start is given, and the clearance of the file."""
    text = (ROOT / "mechanisms/slider_crank.yaml").read_text()
    text = text.replace("start:\n", "start:\n  play: {wristpin: {e: [0.05 mm, -0.12 mm]}}\n")
    posture = drawn(text).posture
    e = eccentricity(posture, "wristpin")
    assert e == pytest.approx([5e-5, -1.2e-4], abs=1e-12)
    sketch = make_sketch(posture)
    by_role = {s.role: s for s in sketch.of("inset wristpin") if isinstance(s, Disc)}
    times = magnification(posture, "wristpin", sketch.unit)
    assert by_role["journal"].centre - by_role["hole"].centre == pytest.approx(times * e)
    assert by_role["clearance"].radius == pytest.approx(times * 2e-4)
    assert by_role["hole"].radius - by_role["journal"].radius == pytest.approx(times * 2e-4)  # the gap is to scale
    assert "touching" not in by_role
    told = next(label.text for label in sketch.labels if label.part == "inset wristpin")
    assert f"×{times:g}" in told and "e/c = 0.65" in told
    assert any(f"×{times:g}" in note and "0.2 mm" in note for note in sketch.notes)


@pytest.mark.parametrize(("share", "role"), [(0.999, "journal"), (1.001, "touching")])
def test_a_journal_that_begins_in_the_wall_is_red(share: float, role: str) -> None:
    """e = share · c, 3-4-5."""
    text = (ROOT / "mechanisms/slider_crank.yaml").read_text()
    x, y = 0.12 * share, -0.16 * share  # mm, of 0.2 mm
    posture = drawn(text.replace("start:\n", f"start:\n  play: {{wristpin: {{e: [{x} mm, {y} mm]}}}}\n")).posture
    assert {"journal", "touching"} & {s.role for s in make_sketch(posture).of("inset wristpin")} == {role}


def test_a_slider_is_drawn_between_its_walls_where_it_is() -> None:
    """A slot on an arm that is turned: corners' ways to their walls are the oracle's, at the told scale."""
    text = (HEAD + ARM).replace("tilt_rate: 6 rad/s", "tilt: 2.5e-3, offset: 0.15 mm")
    posture = drawn(text).posture
    delta = [one[0] for one in ORACLE.contacts(np.array([posture.q[2], *posture.q[3:6], *[0.0] * 4]))]
    assert sorted(np.sign(delta)) == [-1.0, -1.0, -1.0, 1.0]
    sketch = make_sketch(posture)
    times, up = magnification(posture, "way", sketch.unit), np.array([-np.sin(0.2), np.cos(0.2)])
    shapes = sketch.of("inset way")
    heights = [shape.points @ up for shape in shapes if isinstance(shape, Line) and shape.role == "bearing"]
    discs = [shape for shape in shapes if isinstance(shape, Disc)]
    for disc, depth, role in zip(discs, delta, ("touching", *["journal"] * 3), strict=True):
        upper = disc in (discs[0], discs[2])
        gap = heights[0].min() - disc.centre @ up if upper else disc.centre @ up - heights[1].max()
        assert gap == pytest.approx(-times * depth, abs=1e-12) and disc.role == role
    told = next(label.text for label in sketch.labels if label.part == "inset way")
    assert f"×{times:g}" in told and f"e/c = {max(delta) / C + 1:.2f}" in told
    assert any(f"×{times:g}" in note and "gap 0.2 mm on each side" in note for note in sketch.notes)
    block = next(shape.points for shape in sketch.of("body block") if isinstance(shape, Line))
    assert unit_vector(block[1] - block[0]) == pytest.approx([np.cos(0.2025), np.sin(0.2025)])
    assert {"guide", "channel"} <= {shape.role for shape in sketch.of("body arm")}


def test_a_play_as_large_as_the_mechanism_needs_no_inset() -> None:
    sketch = make_sketch(drawn(ROOT / "mechanisms/bouncing_ball.yaml").posture)
    (circle,) = [s for s in sketch.of("joint fall") if s.role == "clearance"]
    assert isinstance(circle, Disc) and circle.radius == 1.0 and not sketch.of("inset fall")


def test_assemblies_share_a_scale_and_differ_in_what_is_drawn() -> None:
    found = drawn(ROOT / "mechanisms/four_bar.yaml")
    closed = find_assemblies(found.linkage, found.linkage.p, found.posture.q, ())
    assert len(closed) == 2
    places = [make_sketch(replace(found.posture, q=one.q)).of("joint B")[0] for one in closed]
    one, other = (disc.centre for disc in places if isinstance(disc, Disc))
    # mirror images in the line from the crank's head to the rocker's pivot
    a, b = found.posture.place("crank.head"), np.array([0.1, 0.0])
    along = (b - a) / np.hypot(*(b - a))
    mirrored = a + 2 * ((one - a) @ along) * along - (one - a)
    assert other == pytest.approx(mirrored, abs=1e-9)


def test_the_plan_of_a_motion_holds_all_of_it() -> None:
    """Rails reach as far as their sliders go."""
    posture = drawn(ROOT / "mechanisms/slider_crank.yaml").posture
    postures = [replace(posture, q=posture.q + [0, 0, 0, 0, 0, 0, shift, 0, 0]) for shift in (0.0, -0.03, 0.02)]
    plan = make_plan(postures)
    low, high = plan.travel["cylinder"]
    assert (low, high) == pytest.approx((0.14, 0.19), abs=1e-9)
    rail = next(s for s in make_sketch(posture, plan).of("joint cylinder") if s.role == "rail")
    assert isinstance(rail, Line) and rail.points[0, 0] < 0.14 and rail.points[1, 0] > 0.19


BELL = """format: gudgeon/1
name: bell
bodies:
  push: {mass: 0.4 kg, inertia: 1e-4 kg*m^2}
  link: {length: 90 mm, mass: 0.2 kg, inertia: auto}
  bell: {mass: 0.8 kg, inertia: 2e-3 kg*m^2, points: {in: [0, 80 mm], out: [120 mm, 0]}}
  strut: {length: 100 mm, mass: 0.25 kg, inertia: auto}
  ram: {mass: 2 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0], floor: [-120 mm, 80 mm], guide: [130 mm, 0]}
joints:
  rail: {translational: [ground.floor, push.origin], axis: [1, 0]}
  a: {revolute: [push.origin, link.tail]}
  b: {revolute: [link.head, bell.in]}
  pivot: {revolute: [ground.O, bell.origin]}
  c: {revolute: [bell.out, strut.tail]}
  d: {revolute: [strut.head, ram.origin]}
  column: {translational: [ground.guide, ram.origin], axis: [0, 1]}
drives: {cam: {coordinate: push.x, value: PLACE}}
forces: {load: {force: ram.origin, value: [0, -20 N]}}
start: {guess: {link.x: -60 mm, link.y: 80 mm, ram.y: 100 mm, strut.head: [130 mm, 100 mm]}}
"""


def test_the_ground_stays_on_its_side_of_a_guide() -> None:
    """Away from the ground's other points, wherever the motion is and whichever assembly it has."""
    starts = [drawn(BELL.replace("PLACE", f"{x} mm")) for x in (-110, -90, -70)]
    first = starts[0]
    others = find_assemblies(first.linkage, first.linkage.p, first.posture.q, ())
    assert len(others) > 1
    postures = [start.posture for start in starts] + [replace(first.posture, q=one.q) for one in others]
    for plan in (make_plan(postures), make_plan(postures[::-1]), *(make_plan([posture]) for posture in postures)):
        assert plan.ways["rail"] == pytest.approx([0.0, 1.0], abs=1e-15)
        assert plan.ways["column"] == pytest.approx([1.0, 0.0], abs=1e-15)


TROLLEY = """format: gudgeon/1
name: trolley
bodies:
  cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  arm: {length: 100 mm, mass: 1 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  pin: {revolute: [cart.origin, arm.tail]}
freedoms: 2
start: {set: {cart.x: 0 m, arm.theta: ANGLE}}
"""


@pytest.mark.parametrize(("angle", "up"), [("-90 deg", 1.0), ("90 deg", -1.0), ("0 deg", -1.0)])
def test_a_guide_alone_lies_away_from_what_it_carries_at_the_start(angle: str, up: float) -> None:
    start = drawn(TROLLEY.replace("ANGLE", angle)).posture
    swung = replace(start, q=start.q + [0.0, 0.0, 0.0, 0.0, 0.0, 2.0])
    for plan in (make_plan([start]), make_plan([start, swung]), make_plan([swung], start)):
        assert plan.ways["rail"] == pytest.approx([0.0, up], abs=1e-15)


@pytest.mark.parametrize("rate", [-1.0, 0.0, 1.0])
def test_a_drives_arrow_lies_away_from_the_ground_that_guides(rate: float) -> None:
    """Below the block, whose ground is above, and the name below the arrow; it points where the body goes."""
    posture = drawn(BELL.replace("PLACE", "-110 mm")).posture
    sketch = make_sketch(replace(posture, v=np.full(len(posture.q), rate)))
    block = np.vstack([s.points for s in sketch.of("body push") if isinstance(s, Line)])
    shaft, head = (s.points for s in sketch.of("drive cam") if isinstance(s, Line))
    assert max(shaft[:, 1].max(), head[:, 1].max()) < block[:, 1].min()
    assert np.sign(shaft[1, 0] - shaft[0, 0]) == (-1.0 if rate < 0.0 else 1.0)
    placed = named(sketch)
    assert placed["drive cam"][3] < placed["body link"][1]


def test_a_forces_name_is_beside_its_arrow() -> None:
    """On the arrow's side of the guide's wall, nearer to it than half the arrow is long."""
    posture = drawn(BELL.replace("PLACE", "-110 mm")).posture
    sketch = make_sketch(replace(posture, loads={"load": (0.0, -20.0)}))
    shaft, head = (s.points for s in sketch.of("force load") if isinstance(s, Line))
    (wall,) = (s.points for s in sketch.of("joint column") if s.role == "rail" and isinstance(s, Line))
    assert wall[0, 0] > shaft[0, 0]
    left, low, right, high = named(sketch)["force load"]
    assert right < wall[0, 0] and high > head[0, 1] and low < shaft[0, 1]
    assert shaft[0, 0] - right < 0.5 * (shaft[0, 1] - head[0, 1])


def named(sketch: Sketch) -> dict[str, Array]:
    """Boxes of names (left, low, right, high) in metres."""
    picture = figure_of([sketch], [""], "x")
    picture.draw_without_rendering()
    back = picture.axes[0].transData.inverted().transform
    return {part: np.ravel(back(np.reshape(box, (2, 2)))) for part, box in boxes(picture)}


def test_what_leads_to_a_name_begins_at_the_edge_of_what_is_named() -> None:
    sketch, clear = make_sketch(drawn(ROOT / "mechanisms/pendulum.yaml").posture), 0.02
    crowd = tuple(Label(f"joint x{k}", "joint", f"name_{k}", np.zeros(2), clear) for k in range(60))
    picture = figure_of([replace(sketch, labels=crowd)], [""], "x")
    picture.draw_without_rendering()
    (ax,) = picture.axes
    (names,) = [artist for artist in ax.get_children() if isinstance(artist, Names)]
    feet = np.array([np.asarray(line.get_xydata(), float)[0] for line in names.leads])
    begins = ax.transData.inverted().transform(feet)
    assert len(begins) > 10
    assert np.hypot(*begins.T) == pytest.approx(clear, rel=1e-9)


def test_a_name_stands_outside_the_arrow_around_its_pin() -> None:
    sketch = make_sketch(drawn(ROOT / "mechanisms/four_bar.yaml").posture)
    (bow, *_) = (s.points for s in sketch.of("drive motor") if isinstance(s, Line))
    (label,) = (label for label in sketch.labels if label.part == "joint A0")
    assert label.clear == pytest.approx(np.hypot(*(bow[0] - label.place)))


def test_what_an_earlier_version_wrote_is_told() -> None:
    posture = drawn(ROOT / "mechanisms/four_bar.yaml").posture
    with pytest.raises(GudgeonError, match="run the scene again"):
        Posture(replace(posture.source, parts=()), posture.p, posture.q)


CAR = """
format: gudgeon/1
name: car
freedoms: 1
bodies: {car: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, car.origin], axis: [1, 0]}}
forces: {spring: {spring_damper: [ground.O, car.origin], stiffness: 40 N/m, damping: 0.2 N*s/m, free_length: 0.1 m}}
start: {guess: {car.x: 150 mm}}
"""


def test_a_spring_at_a_rails_own_point_has_its_wall_and_keeps_off_the_rail() -> None:
    of = drawn(CAR)
    plan = make_plan([of.posture])
    sketch = make_sketch(of.posture, plan)
    lines = [shape for shape in (*sketch.of("joint rail"), *sketch.of("force spring")) if isinstance(shape, Line)]
    wires = [line for line in lines if line.part == "force spring"]
    strokes = [line for line in wires if line.role == "hatch"]
    assert len(strokes) > 2 and all(np.abs(stroke.points).max() < 3.0 * plan.unit for stroke in strokes)
    rail = next(line for line in lines if line.role == "rail" and line not in wires).points[0, 1]
    wire = np.vstack([line.points for line in wires if line.role in ("spring", "piston")])
    assert rail < 0.0 and wire[:, 1].min() > rail
