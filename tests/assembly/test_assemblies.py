"""What can move, which assemblies there are, what is too short: against counting, closed forms and circles' points."""

from __future__ import annotations

import json
import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.commands.assembly_report import assemble_scenes, yield_remarks
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.generator.reader.read import read_mechanism
from tests.slow import slow_rows_but

CRANK, COUPLER, ROCKER, GROUND, ALPHA = 0.05, 0.1, 0.06, 0.08, math.radians(30.0)
FOUR_BAR = """
format: gudgeon/1
name: four
{freedoms}
bodies:
  crank: {{length: 50 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}
  coupler: {{length: 100 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2, points: {{tip: [50 mm, 20 mm]}}}}
  rocker: {{length: 60 mm, mass: 0.1 kg, inertia: 1e-4 kg*m^2}}
ground: {{O: [0, 0], Q: [{ground}, 0]}}
joints:
{joints}
{drives}
{start}
"""
A, B, C, D = (
    f"  {name}: {{revolute: [{one}, {other}]}}\n"
    for name, one, other in (
        ("A", "ground.O", "crank.tail"),
        ("B", "crank.head", "coupler.tail"),
        ("C", "coupler.head", "rocker.head"),
        ("D", "ground.Q", "rocker.tail"),
    )
)
MOTOR = "drives: {motor: {angle: crank, value: 30 deg + 1 rad/s * t}}"


def four_bar(
    joints: str = A + B + C + D, drives: str = MOTOR, start: str = "", ground: str = "80 mm", freedoms: str = ""
) -> bytes:
    return FOUR_BAR.format(joints=joints, drives=drives, start=start, ground=ground, freedoms=freedoms).encode()


def found(text: bytes, branches: bool = False):  # type: ignore[no-untyped-def]
    return assemble_scenes(read_mechanism(text, "four.yaml"), branches)


def elbow(side: float) -> tuple[float, float]:
    """Angles of coupler and rocker where two circles meet: from the crank's end and from Q."""
    x, y = CRANK * math.cos(ALPHA), CRANK * math.sin(ALPHA)
    d = math.hypot(GROUND - x, -y)
    along = (COUPLER**2 - ROCKER**2 + d**2) / (2 * d)
    up = side * math.sqrt(COUPLER**2 - along**2)
    ux, uy = (GROUND - x) / d, -y / d
    px, py = x + along * ux - up * uy, y + along * uy + up * ux
    return math.atan2(py - y, px - x), math.atan2(py, px - GROUND)


def test_both_assemblies_of_a_four_bar_are_found_and_their_guess_picks_them(tmp_path: Path) -> None:
    expected = sorted(elbow(side)[0] for side in (1.0, -1.0))
    assemblies = found(four_bar()).assemblies
    angles = sorted(float(one.q[5] + np.pi) % (2 * np.pi) - np.pi for one in assemblies)
    assert angles == pytest.approx(expected, abs=1e-9)
    for number, one in enumerate(assemblies):
        guess = ", ".join(f"{name}: {math.degrees(x):.4g} deg" for name, x in one.guess.items())
        file = tmp_path / f"four{number}.yaml"
        file.write_bytes(four_bar(start=f"start: {{guess: {{{guess}}}}}"))
        start = gudgeon.load(file).start()
        assert np.cos(start.q[5] - one.q[5]) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_guessed_point_picks_the_assembly(side: float, tmp_path: Path) -> None:
    coupler, _ = elbow(side)
    x, y = CRANK * math.cos(ALPHA), CRANK * math.sin(ALPHA)
    c, s = math.cos(coupler), math.sin(coupler)
    tip = (x + 0.05 * c - 0.02 * s + 0.004, y + 0.05 * s + 0.02 * c - 0.003)  # about there
    file = tmp_path / "four.yaml"
    file.write_bytes(four_bar(start=f"start: {{guess: {{coupler.tip: [{tip[0]}, {tip[1]}]}}}}"))
    start = gudgeon.load(file).start()
    assert np.cos(start.q[5] - coupler) == pytest.approx(1.0, abs=1e-12)
    batch = gudgeon.load(file).simulate_many({"bodies.rocker.mass": [0.1, 0.2]}, t_end=0.1, output=1)
    assert np.cos(batch.q[:, 0, 5] - coupler) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(
    ("joints", "drives", "freedoms", "along"),
    [
        (A + B + C + D, MOTOR, 0, ()),
        (A + B + C + D, "", 1, ("crank.theta",)),
        (B + C + D, "", 3, ("crank.theta", "crank.x", "crank.y")),
        (A + B + C, "", 3, ("crank.theta", "coupler.theta", "rocker.theta")),
    ],
)
def test_degrees_of_freedom(joints: str, drives: str, freedoms: int, along: tuple[str, ...]) -> None:
    scene = found(four_bar(joints, drives)).scenes["ideal"]
    assert (
        scene.closed_mobility.freedoms,
        scene.closed_mobility.independent_coordinates,
        scene.closed_mobility.unconnected_bodies,
    ) == (
        freedoms,
        along,
        (),
    )
    assert scene.closed_mobility.redundant == 0


def test_a_driven_crank_without_its_shaft_is_named() -> None:
    def message(joints: str) -> list[str]:
        mechanism = read_mechanism(four_bar(joints), "four.yaml")
        return [text for whose, text in yield_remarks(mechanism, assemble_scenes(mechanism, False)) if whose == "shaft"]

    assert message(B + C + D) == ["no joint connects crank to the ground, the reference of drive motor"]
    assert message(A + B + C) == [] == message(A + B + C + D)


def test_bodies_that_nothing_holds_and_rows_that_say_nothing_new() -> None:
    loose = found(four_bar(C + D, "")).scenes["ideal"].closed_mobility
    assert loose.unconnected_bodies == ("crank",) and loose.freedoms == 5
    twice = found(four_bar(A + A.replace("A:", "A2:") + B + C + D)).scenes["ideal"].closed_mobility
    assert (twice.gruebler, twice.freedoms, twice.redundant) == (-2, 0, 2)


@pytest.mark.parametrize(("span", "guess", "aligned"), [(0.3, 0, 1), (0.29, 20, 0)])
def test_a_start_at_a_dead_centre_is_told(span: float, guess: int, aligned: int) -> None:
    """Two bars over a span: rank 5 of 6 where they are stretched (y of the pin is free to first order), 6 elsewhere."""
    flat = f"""
format: gudgeon/1
name: flat
bodies: {{a: {{length: 0.1}}, b: {{length: 0.2}}}}
ground: {{A: [0, 0], B: [{span}, 0]}}
joints: {{j: {{revolute: [ground.A, a.tail]}}, k: {{revolute: [a.head, b.tail]}}, l: {{revolute: [b.head, ground.B]}}}}
start: {{guess: {{a.theta: {guess} deg, b.theta: {-guess / 2} deg}}}}
"""
    mechanism = read_mechanism(flat.encode(), "flat.yaml")
    scenes = assemble_scenes(mechanism, False)
    closed = scenes.scenes["ideal"].closed_mobility
    assert (closed.n_dependent_at_start, closed.freedoms, closed.redundant) == (aligned, 0, 0)
    assert [whose for whose, _ in yield_remarks(mechanism, scenes)].count("singular") == aligned


@pytest.mark.parametrize(("given", "fits"), [(1, True), (0, False), (3, False)])
def test_freedoms_that_are_given_are_checked(given: int, fits: bool, tmp_path: Path) -> None:
    file = tmp_path / "four.yaml"
    file.write_bytes(four_bar(drives="", freedoms=f"freedoms: {given}"))
    message = CliRunner().invoke(app, ["check", str(file)])
    assert (message.exit_code == 0) is fits
    if fits:
        gudgeon.load(file)
        assert "freedoms" not in message.output.replace("degrees of freedom", "")
    else:
        with pytest.raises(BadValueError, match=rf"four.yaml:4:11: freedoms is {given}, .* there are 1: crank.theta"):
            gudgeon.load(file)


@pytest.mark.parametrize("text", ["-1", "1.5", "1 m", "k"])
def test_freedoms_are_a_whole_number(text: str) -> None:
    with pytest.raises(Exception, match="4:11"):
        read_mechanism(four_bar(freedoms=f"freedoms: {text}"), "four.yaml")


def test_a_link_that_is_too_short_is_told_by_how_much(tmp_path: Path) -> None:
    """The coupler's end must reach the rocker's circle: what is missing is what the straight line is longer by."""
    far = 0.3
    x, y = CRANK * math.cos(ALPHA), CRANK * math.sin(ALPHA)
    missing = math.hypot(far - x, y) - COUPLER - ROCKER
    file = tmp_path / "four.yaml"
    file.write_bytes(four_bar(ground="300 mm").replace(b"tip: [50 mm, 20 mm]", b"tip: [500 mm, 20 mm]"))
    with pytest.raises(AssemblyError, match="line 1[0-9]") as message:
        gudgeon.load(file).start()
    assert f"coupler (100 mm) longer by {1e3 * missing:.4g} mm" in str(message.value)
    assert f"rocker (60 mm) longer by {1e3 * missing:.4g} mm" in str(message.value)
    reached = math.sqrt(0.09 - 0.16**2)  # of a straight line to Q that is as long as coupler and rocker
    crank = 0.3 * math.cos(ALPHA) - math.sqrt(0.16**2 - (0.3 * math.sin(ALPHA)) ** 2) - CRANK
    assert reached > 0 and f"crank (50 mm) longer by {1e3 * crank:.4g} mm" in str(message.value)


def test_what_is_too_short_is_measured_between_points_that_joints_use(tmp_path: Path) -> None:
    """A tracer far off belongs to no length; the points of a body without length are named, farthest ones first."""
    missing = math.hypot(0.3 - CRANK * math.cos(ALPHA), CRANK * math.sin(ALPHA)) - COUPLER - ROCKER
    held = A + B.replace("coupler.tail", "coupler.in") + C.replace("coupler.head", "coupler.out") + D
    bell = four_bar(ground="300 mm", joints=held).replace(b"length: 100 mm", b"com: [30 mm, 10 mm]")
    bell = bell.replace(b"tip: [50 mm", b"in: [0, 0], out: [80 mm, 60 mm], tip: [50 mm")
    file = tmp_path / "four.yaml"
    file.write_bytes(bell.replace(b"tip: [50 mm, 20 mm]", b"tip: [500 mm, 20 mm]"))
    with pytest.raises(AssemblyError) as caught:
        gudgeon.load(file).start()
    assert f"coupler, in–out (100 mm) longer by {1e3 * missing:.4g} mm" in str(caught.value)


def test_a_length_left_in_metres_is_named(tmp_path: Path) -> None:
    """One that is by hundreds longer than all others; not one that is only too long."""
    file = tmp_path / "four.yaml"
    for ground, message in (("180", "times the next longest: is it 180 mm?"), ("5", "")):
        file.write_bytes(four_bar(ground=ground))
        with pytest.raises(AssemblyError) as caught:
            gudgeon.load(file).start()
        assert message in str(caught.value) and ("is it" in str(caught.value)) == bool(message)


def test_a_link_that_is_too_long_is_told_by_how_much(tmp_path: Path) -> None:
    """A rocker longer than what crank's end, coupler and ground can reach around."""
    file = tmp_path / "four.yaml"
    file.write_bytes(four_bar().replace(b"length: 60 mm", b"length: 200 mm"))
    x, y = CRANK * math.cos(ALPHA), CRANK * math.sin(ALPHA)
    most = math.hypot(GROUND - x, y) + COUPLER
    with pytest.raises(AssemblyError) as message:
        gudgeon.load(file).start()
    assert f"rocker (200 mm) shorter by {1e3 * (0.2 - most):.4g} mm" in str(message.value)


def test_a_guess_that_is_not_followed_is_told(tmp_path: Path) -> None:
    angle = math.degrees(elbow(1.0)[0]) + 50.0
    text = four_bar(start=f"start: {{guess: {{coupler.theta: {angle} deg}}}}")
    off = found(text).scenes["ideal"].guess_deviations
    file = tmp_path / "four.yaml"
    file.write_bytes(text)
    if "coupler.theta" in off:
        assert math.degrees(abs(off["coupler.theta"])) == pytest.approx(50.0, abs=1e-6)
    with pytest.warns(UserWarning, match="coupler.theta begins 50° from its guess") as alone:
        gudgeon.load(file).simulate(0.1, output=1)
    assert alone[0].filename == __file__
    angles = [math.radians(angle + away) for away in (0.0, 5.0, -45.0)]
    free = tmp_path / "free.yaml"  # its runs go from start to end in C
    free.write_bytes(four_bar(start="start: {set: {crank.theta: 30 deg}, guess: {coupler.theta: 0}}", drives=""))
    for bars in (file, free):
        with pytest.warns(UserWarning) as caught:  # once for all runs
            gudgeon.load(bars).simulate_many({"start.guess.coupler.theta": angles}, t_end=0.1, output=1)
        (one,) = caught
        message = str(one.message)
        assert message.startswith("starts deviate from their guess: coupler.theta in 2 of 3 runs by up to 55°:")
        assert one.filename == __file__
    close = four_bar(start=f"start: {{guess: {{coupler.theta: {angle - 45} deg}}}}")
    assert found(close).scenes["ideal"].guess_deviations == {}


def engine_of(guess: str) -> bytes:
    """A slider-crank whose crank stands at α, with a guess of its start."""
    return f"""
format: gudgeon/1
name: engine
bodies: {{crank: {{length: 50 mm}}, rod: {{length: 120 mm}}, piston: {{}}}}
ground: {{O: [0, 0]}}
joints:
  shaft: {{revolute: [ground.O, crank.tail]}}
  crankpin: {{revolute: [crank.head, rod.tail]}}
  wristpin: {{revolute: [rod.head, piston.origin]}}
  cylinder: {{translational: [ground.O, piston.origin], axis: [1, 0]}}
drives: {{motor: {{angle: crank, value: 30 deg + 1 rad/s * t}}}}
start: {{guess: {{{guess}}}}}
""".encode()


@pytest.mark.parametrize(
    ("guess", "side", "off"),
    slow_rows_but([(160, 1, 0), (-100, -1, 25.9)], [(160, 1, 0), (-74, -1, 0), (-100, -1, 25.9), (-160, -1, 85.9)]),
)
def test_a_guessed_place_picks_the_branch(tmp_path: Path, guess: float, side: int, off: float) -> None:
    """x = r cos α ± √(l² − r² sin² α) of a slider-crank: the nearer of the two, told where it is far."""
    file = tmp_path / "engine.yaml"
    file.write_bytes(engine_of("piston.x: 160 mm"))
    x = CRANK * math.cos(ALPHA) + side * math.sqrt(0.12**2 - (CRANK * math.sin(ALPHA)) ** 2)
    engine = gudgeon.load(file)
    with warnings.catch_warnings(record=True) as message:
        warnings.simplefilter("always")
        run = engine.simulate(0.1, output=1, parameters={"start.guess.piston.x": 1e-3 * guess})
        many = engine.simulate_many({"start.guess.piston.x": [1e-3 * guess, 0.16]}, 0.1, output=1)
    assert run["piston.x"][0] == pytest.approx(x, abs=1e-12)
    assert many["piston.x"][0, 0] == pytest.approx(x, abs=1e-12) and many["piston.x"][1, 0] > 0.16
    assert ([f"piston.x begins {off} mm" in str(word.message) for word in message[:1]]) == [True] * bool(off)


PLACE, POINT = "coupler.x: 60 mm", "coupler.tip: [60 mm, 30 mm], rocker.theta: 1"


@pytest.mark.parametrize(
    ("guess", "n"), slow_rows_but([(PLACE, 6)], [(PLACE, 6), (POINT, 3), (PLACE, 60), (POINT, 60)])
)
def test_the_assembly_nearest_to_the_guesses(guess: str, n: int, tmp_path: Path) -> None:
    """Of the two places where the circles of the coupler's head meet the one nearer to all guesses is taken.

    Newton's steps from a guessed x led to the other one for a third of such guesses; beside a point an angle was lost.
    """
    file, rng = tmp_path / "bars.yaml", np.random.default_rng(8)
    file.write_text(f"""
format: gudgeon/1
name: bars
parameters: {{phi: 90 deg, l: 120 mm}}
bodies:
  crank: {{length: 40 mm}}
  coupler: {{length: l, points: {{tip: [60 mm, 50 mm]}}}}
  rocker: {{length: 80 mm}}
ground: {{A: [0, 0], D: [100 mm, 0]}}
joints:
  A: {{revolute: [ground.A, crank.tail]}}
  B: {{revolute: [crank.head, coupler.tail]}}
  C: {{revolute: [coupler.head, rocker.head]}}
  D: {{revolute: [ground.D, rocker.tail]}}
drives: {{motor: {{angle: crank, value: phi + 6 rad/s * t}}}}
start: {{guess: {{{guess}}}}}
""")
    phi, rod = rng.uniform(0.0, 2 * np.pi, n), rng.uniform(0.105, 0.135, n)
    crank = 0.04 * np.exp(1j * phi)
    way = 0.1 - crank  # from the crank's head to the rocker's tail
    along = (np.abs(way) ** 2 + rod**2 - 0.08**2) / (2 * np.abs(way))
    aside = 1j * np.sqrt(rod**2 - along**2) * np.array([[1.0], [-1.0]])
    coupler = (along + aside) * way / np.abs(way)
    tip, rocker = crank + coupler / rod * (0.06 + 0.05j), np.angle(crank + coupler - 0.1)
    places = {"coupler.x": (crank + 0.5 * coupler).real, "coupler.tip.x": tip.real, "coupler.tip.y": tip.imag}
    guesses, off = {}, np.zeros((2, n))
    for name in ["coupler.x"] if "coupler.x" in guess else ["coupler.tip.x", "coupler.tip.y", "rocker.theta"]:
        if name in places:
            guesses[name] = rng.uniform(0.02, 0.12, n)
            off += ((places[name] - guesses[name]) / 0.1) ** 2
        else:
            guesses[name] = rng.uniform(-3.0, 3.0, n)
            off += ((rocker - guesses[name] + np.pi) % (2 * np.pi) - np.pi) ** 2
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of guesses that are far from both
        columns = {"phi": phi, "l": rod} | {f"start.guess.{name}": values for name, values in guesses.items()}
        batch = gudgeon.load(file).simulate_many(columns, 1e-3, output=1)
    nearest = places["coupler.x"][off.argmin(axis=0), np.arange(n)]
    np.testing.assert_allclose(batch["coupler.x"][:, 0], nearest, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("guess", "alike"), [("piston.x: 160 mm", False), ("piston.x: -74 mm", False), ("crank.head: [43 mm, 25 mm]", True)]
)
def test_guesses_that_tell_assemblies_apart(guess: str, alike: bool) -> None:
    """The piston stands at 160.7 or -74.1 mm: its place tells them apart, that of the driven crank does not."""
    message = found(engine_of(guess), branches=True)
    assert len(message.assemblies) == 2 and len(message.equivalent_assemblies) == alike


JANSEN = Path(__file__).parents[2] / "mechanisms" / "gallery" / "jansen_leg.yaml"


def test_what_else_to_guess_of_jansens_leg(tmp_path: Path) -> None:
    """Two angles leave two assemblies that follow them alike; a third that picks each is told."""
    file = tmp_path / "jansen.yaml"
    text = JANSEN.read_text(encoding="utf-8")
    assert ", f.theta: -65 deg" in text
    file.write_text(text.replace(", f.theta: -65 deg", ""), encoding="utf-8")
    message = assemble_scenes(read_mechanism(file.read_bytes(), "jansen.yaml"), branches=True)
    assert len(message.assemblies) == 8 and len(message.equivalent_assemblies) == 1
    output = CliRunner().invoke(app, ["check", str(file), "--branches"]).output
    assert "2 assemblies follow the guesses of the start equally well: also guess f.theta, -29.82 deg" in " ".join(
        output.split()
    )
    assert "8 assemblies found" in output
    document = json.loads(CliRunner().invoke(app, ["check", str(JANSEN), "--json"]).output)
    assert document["assembled"]["ideal"]["degrees of freedom"] == 0
    assert len(document["assemblies"]) == 8
    assert "alike" not in CliRunner().invoke(app, ["check", str(JANSEN)]).output


@pytest.mark.slow
def test_the_link_that_is_told_has_its_own_length(tmp_path: Path) -> None:
    """A rod that does not reach down to the piston's line: it is told before anything is compiled."""
    file = tmp_path / "engine.yaml"
    file.write_text("""
format: gudgeon/1
name: engine
bodies:
  crank: {length: 50 mm}
  rod: {length: 20 mm}
  piston: {}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, piston.origin]}
  cylinder: {translational: [ground.O, piston.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 30 deg + t * 1 rad/s}}
start: {guess: {piston.x: 60 mm}}
""")
    with pytest.raises(AssemblyError, match=r"rod \(20 mm\) longer by 5 mm, or crank \(50 mm\) shorter by 10 mm"):
        gudgeon.load(file).start()
