"""Mass, inertia and points that follow from shapes and lengths: against integrals, in every run; what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, GudgeonError, InputError, MissingKeyError, UnknownNameError
from gudgeon.generator.mechanism import Body
from gudgeon.generator.reader.read import read_mechanism

FILE = """format: gudgeon/1
name: swing
gravity: [0, -9.81]
parameters: {{s: 0.1 m, h: 4 mm}}
bodies:
  body: {{{body}}}
ground: {{O: [0, 0]}}
joints:
  pin: {{revolute: [ground.O, body.origin]}}
start: {{rates: {{body.omega: 1 rad/s}}}}
"""
PLATE = "density: 2700 kg/m^3, thickness: h"
SIDES = "sides: {PQ: s, QR: 80 mm, PR: 60 mm, side: right}"
Numbers = dict[str, float]


def run(body: str, tmp_path: Path, parameters: dict[str, float | str] | None = None) -> gudgeon.Result:
    """A short run of one body that swings."""
    file = tmp_path / "swing.yaml"
    file.write_text(FILE.format(body=body))
    return gudgeon.load(file).simulate(t_end=1e-3, output=1, method="dop853", parameters=parameters)


def read_body(body: str) -> Body:
    return read_mechanism(FILE.format(body=body).encode(), "swing.yaml").bodies["body"]


def plate(corners: np.ndarray, density: float, thickness: float, cells: int = 64) -> tuple[float, np.ndarray, float]:
    """Mass, centre, and inertia about it: a polygon as a fan of triangles, each cut into small ones.

    Three midpoints integrate what is quadratic exactly, so no closed form of a moment is used.
    """
    mass, first, second = 0.0, np.zeros(2), 0.0
    for b, c in zip(corners[1:-1], corners[2:], strict=True):
        a = corners[0]
        area = 0.5 * abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]))
        for middle in ((a + b) / 2, (b + c) / 2, (c + a) / 2):
            part = density * thickness * area / 3
            mass, first, second = mass + part, first + part * middle, second + part * float(middle @ middle)
    centre = first / mass
    return mass, centre, second - mass * float(centre @ centre)


def rectangle(a: float, b: float) -> np.ndarray:
    return np.array([[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]])


def triangle(s: float) -> np.ndarray:
    """P, Q and R by trigonometry, R on the right."""
    angle = np.arccos((s**2 + 0.06**2 - 0.08**2) / (2 * s * 0.06))
    return np.array([[0.0, 0.0], [s, 0.0], [0.06 * np.cos(angle), -0.06 * np.sin(angle)]])


def disc(radius: float, sides: int = 20_000) -> np.ndarray:
    turn = 2 * np.pi * np.arange(sides) / sides
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])


@pytest.mark.parametrize("s", [0.1, 0.12])  # the file's, and that of another run of the same library
@pytest.mark.parametrize(
    ("body", "corners"),
    [
        (f"length: s, shape: {{bar: 20 mm, {PLATE}}}", lambda s: rectangle(s, 0.02)),
        (f"shape: {{rectangle: [s, 30 mm], {PLATE}}}", lambda s: rectangle(s, 0.03)),
        (f"shape: {{disc: s, {PLATE}}}", disc),
        (f"{SIDES}, shape: {{triangle: [P, Q, R], {PLATE}}}", triangle),
        (
            f"length: s, points: {{c: [20 mm, -70 mm]}}, shape: {{triangle: [c, head, tail], {PLATE}}}",
            lambda s: np.array([[0.02, -0.07], [s, 0.0], [0.0, 0.0]]),
        ),
    ],
)
def test_shapes_are_their_integrals(body: str, corners, s: float, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    found = run(body, tmp_path, {"s": s})
    mass, centre, inertia = plate(corners(s), 2700.0, 0.004)
    assert found.parameters["bodies.body.mass"] == pytest.approx(mass, rel=1e-7)  # the disc is a polygon
    assert found.parameters["bodies.body.inertia"] == pytest.approx(inertia, rel=1e-7)
    if "triangle" in body:
        assert [found.parameters[f"bodies.body.com.{axis}"] for axis in "xy"] == pytest.approx(centre, rel=1e-13)
    # by the parallel axis theorem about the pin, where it is: T = I_O ω²/2
    arm = centre if "triangle" in body else np.array([s / 2 if "bar" in body else 0.0, 0.0])
    expected = 0.5 * (inertia + mass * float(arm @ arm))
    assert found["energy.kinetic"][0] == pytest.approx(expected, rel=1e-7)


def test_a_shape_takes_a_mass_too(tmp_path: Path) -> None:
    found = run(f"{SIDES}, mass: 2 kg, shape: {{triangle: [P, Q, R]}}", tmp_path, {"bodies.body.mass": "3 kg"})
    mass, _, inertia = plate(triangle(0.1), 1.0, 1.0)
    assert found.parameters["bodies.body.inertia"] == pytest.approx(3.0 * inertia / mass, rel=1e-13)


def test_auto_is_a_slender_bar_in_every_run(tmp_path: Path) -> None:
    """The rule of 5 points integrates x² along the bar exactly; lengths of a sweep change the inertia."""
    file = tmp_path / "swing.yaml"
    file.write_text(FILE.format(body="length: 0.2 m, mass: 0.3 kg, inertia: auto"))
    lengths, masses = np.array([0.2, 0.3, 0.4]), np.array([0.3, 0.3, 0.6])
    batch = gudgeon.load(file).simulate_many(
        {"bodies.body.length": lengths, "bodies.body.mass": masses}, t_end=1e-3, output=1, method="dop853"
    )
    x, w = np.polynomial.legendre.leggauss(5)
    about_tail = [m / 2 * float(w @ (length * (x + 1) / 2) ** 2) for length, m in zip(lengths, masses, strict=True)]
    np.testing.assert_allclose(batch["energy.kinetic"][:, 0], 0.5 * np.array(about_tail), rtol=1e-13)
    own = gudgeon.load(file).simulate(
        t_end=1e-3, output=1, method="dop853", parameters={"bodies.body.inertia": 7.0, "bodies.body.length": 0.4}
    )
    assert own.parameters["bodies.body.inertia"] == 7.0  # what is given is not followed by anything


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_sides_are_distances(side: str, sign: int, tmp_path: Path) -> None:
    body = f"mass: 1 kg, inertia: 1 kg*m^2, {SIDES.replace('right', side)}"
    for s in (0.1, 0.05, 0.1399999):
        found = run(body, tmp_path, {"s": s})
        P, Q, R = (np.array([found[f"body.{name}.{axis}"][0] for axis in "xy"]) for name in "PQR")
        lengths = [np.linalg.norm(Q - P), np.linalg.norm(R - Q), np.linalg.norm(R - P)]
        np.testing.assert_allclose(lengths, [s, 0.08, 0.06], rtol=1e-14, atol=1e-16)
        along = Q - P
        assert sign * (along[0] * (R - P)[1] - along[1] * (R - P)[0]) > 0.0


def test_sides_that_make_no_triangle(tmp_path: Path) -> None:
    """Told with numbers: in the file, at a run, of one run of many."""
    body = f"mass: 1 kg, inertia: 1 kg*m^2, {SIDES}"
    words = r"swing.yaml:6:\d+: bodies.body.sides.PQ is 0.2 m: each side .*\n.* = 0.14 m"
    with pytest.raises(BadValueError, match=words):
        read_body(body.replace("PQ: s", "PQ: 2*s"))
    for wrong in (0.14, 0.15, 0.02, 0.01):  # degenerate ones too
        with pytest.raises(BadValueError, match=r"bodies.body.sides.\w+ is [\d.]+ m.*: each side .* is 0\.\d+ m\)"):
            run(body, tmp_path, {"s": wrong})
    batch = gudgeon.load(tmp_path / "swing.yaml").simulate_many(
        {"s": [0.1, 0.15, 0.12]}, t_end=1e-3, output=1, method="dop853"
    )
    assert [failure.run for failure in batch.failures] == [1]
    assert "(bodies.body.sides.PR + bodies.body.sides.QR is 0.14 m)" in str(batch.failures[0].error)


WRONG: list[tuple[str, type[InputError], str]] = [
    ("mass: 1, inertia: auto", BadValueError, "the body has no length"),
    ("mass: 1, length: s, com: [0, 0], inertia: auto", BadValueError, "the body has com"),
    ("mass: 1, shape: {disc: s, density: 1, thickness: h}", BadValueError, "has mass and a shape with density"),
    ("mass: 1, inertia: 1, shape: {disc: s}", BadValueError, "has inertia and a shape"),
    ("length: s, inertia: auto, mass: 1, shape: {bar: h}", BadValueError, "has inertia and a shape"),
    ("shape: {disc: s, density: 1}", MissingKeyError, "has no thickness"),
    ("shape: {disc: s, thickness: h}", MissingKeyError, "has no density"),
    ("mass: 1, shape: {bar: h}", BadValueError, "the body has no length"),
    ("mass: 1, shape: {}", MissingKeyError, "has no kind"),
    ("mass: 1, shape: {disc: s, rectangle: [s, s]}", InputError, "is both"),
    ("mass: 1, shape: {triangle: [P, Q]}", BadValueError, "triangle"),
    ("mass: 1, shape: {triangle: 3}", BadValueError, "triangle"),
    ("mass: 1, shape: {triangle: [P, Q, R]}", UnknownNameError, "unknown point of body 'P'"),
    ("mass: 1, shape: {triangle: [origin, com, origin]}", UnknownNameError, "unknown point of body 'com'"),
    (f"mass: 1, com: [0, 0], {SIDES}, shape: {{triangle: [P, Q, R]}}", BadValueError, "has com and a triangle"),
    (f"mass: 1, inertia: 1, points: {{Q: [0, 1]}}, {SIDES}", InputError, "the key sides defines it"),
    ("shape: {disc: 0 m, density: 1, thickness: h}", BadValueError, "a radius is positive"),
    ("shape: {disc: s, density: -1, thickness: h}", BadValueError, "a density is positive"),
    ("shape: {disc: s, density: 1, thickness: 0}", BadValueError, "a thickness is positive"),
    ("mass: 1, shape: {rectangle: [s, -s]}", BadValueError, "a side is positive"),
    ("mass: 1, shape: {disc: 1e200 m}", BadValueError, "inertia is inf"),
    ("shape: {disc: 1e-200 m, density: 1, thickness: h}", BadValueError, "mass is 0"),
    (
        "points: {a: [s, s], b: [2*s, 2*s]}, shape: {triangle: [origin, a, b], density: 1, thickness: h}",
        BadValueError,
        "mass is 0",
    ),
    ("mass: 1, shape: {disc: 1 kg}", InputError, "expected a length"),
    ("shape: {disc: s, density: 1 kg, thickness: h}", InputError, "expected a density"),
    ("mass: 1, inertia: automatic", InputError, "automatic"),
    ("mass: 1, inertia: 1, sides: {PQ: s, QR: s}", MissingKeyError, "has no PR"),
    ("mass: 1, inertia: 1, sides: {PQ: s, QR: s, PR: s, side: up}", BadValueError, "side is 'up'"),
]


@pytest.mark.parametrize(("body", "error", "words"), WRONG)
def test_what_is_refused(body: str, error: type[InputError], words: str) -> None:
    with pytest.raises(error, match=words) as caught:
        read_body(body)
    assert caught.value.where is not None and (caught.value.where.file, caught.value.where.line) == ("swing.yaml", 6)


def test_hostile_numbers_go_through_the_compiler(tmp_path: Path) -> None:
    """What a run is given meets the conditions again: no inertia that is none, nowhere a NaN."""
    body = f"{SIDES}, shape: {{triangle: [P, Q, R], {PLATE}}}"
    run(body, tmp_path)
    linkage = gudgeon.load(tmp_path / "swing.yaml")
    for name in ("s", "h", "bodies.body.sides.QR", "bodies.body.shape.density", "bodies.body.mass"):
        for value in (0.0, -1.0, float("nan"), float("inf"), 1e308, 1e-320):
            try:
                found = linkage.simulate(t_end=1e-3, output=1, method="dop853", parameters={name: value})
            except GudgeonError:
                continue
            assert np.isfinite(found.q).all() and np.isfinite(found["energy.kinetic"]).all(), (name, value)
            assert min(found.parameters["bodies.body.mass"], found.parameters["bodies.body.inertia"]) > 0.0
