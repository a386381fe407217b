"""Starts whose journals are out of the middle and move: against the quadratic of a free flight, and by hand."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.assembly.journals import check_journal_positions
from gudgeon.assembly.start import search_start
from gudgeon.cli import app
from gudgeon.errors import AssemblyError, UnknownNameError
from gudgeon.model.parameters import compute_parameter_values
from gudgeon.simulation.simulation import Simulation

C, R, M = 3e-4, 1e-2, 0.1
FREE = f"""
format: gudgeon/1
name: free_journal
parameters: {{ex: 0.1 mm, ey: -0.05 mm, vx: 3 mm/s, vy: 8 mm/s}}
materials: {{steel: {{E: 206 GPa, nu: 0.3}}}}
bodies: {{ball: {{mass: {M} kg, inertia: 1e-5 kg*m^2}}}}
ground: {{o: [2 mm, -1 mm]}}
joints: {{A: {{revolute: [ground.o, ball.origin]}}}}
start: {{play: {{A: {{e: [ex, ey], rate: [vx, vy]}}}}}}
bearings:
  pin: {{radius: {R} m, clearance: {C} m, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {{dry: {{normal: {{law: lankarani_nikravesh, restitution: 0.9}}}}}}
scenes: {{dry: {{play: {{A: {{bearing: pin, contact: dry}}}}, simulate: {{t_end: 0.1 s, output: 10}}}}}}
"""
CRANK = """
format: gudgeon/1
name: driven
gravity: [0, -9.81 m/s^2]
parameters: {out: 0.02 mm}
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies:
  crank: {length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.21 kg, inertia: 2.5e-4 kg*m^2}
  piston: {mass: 0.14 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  A: {revolute: [crank.head, rod.tail]}
  B: {revolute: [rod.head, piston.origin]}
  guide: {translational: [ground.O, piston.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 50 deg + 20 rad/s * t}}
start:
  guess: {piston.x: 150 mm}
  play: {A: {e: [out, 0.04 mm], rate: [3 mm/s, 0]}, B: {rate: [0, -2 mm/s]}}
bearings:
  pin: {radius: 10 mm, clearance: 0.1 mm, length: 10 mm, bearing_material: steel, journal_material: steel}
contacts: {dry: {normal: {law: lankarani_nikravesh, restitution: 0.9}}}
scenes:
  dry:
    play: {A: {bearing: pin, contact: dry}, B: {bearing: pin, contact: dry}}
    simulate: {t_end: 2 ms, output: 20}
"""


@dataclass
class Scenes:
    """Loaded once for all tests here."""

    free: Simulation
    full: Simulation
    driven: Simulation
    folder: Path

    def file(self, name: str, text: str) -> Path:
        path = self.folder / f"{name}.yaml"
        path.write_text(text, encoding="utf-8")
        return path


@pytest.fixture(scope="module")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> Scenes:
    folder = tmp_path_factory.mktemp("journals")
    (folder / "free.yaml").write_text(FREE)
    (folder / "driven.yaml").write_text(CRANK)
    free = gudgeon.load(folder / "free.yaml", "dry")
    return Scenes(free, free.full, gudgeon.load(folder / "driven.yaml", "dry"), folder)


def touching(e: Any, v: Any) -> float:
    """When |e + v t| = c first."""
    a, b = float(np.dot(v, v)), float(np.dot(e, v))
    return (-b + math.sqrt(b * b - a * (float(np.dot(e, e)) - C * C))) / a


def numbers(e: Any, v: Any) -> dict[str, float]:
    return dict(zip((f"start.play.A.{name}" for name in ("e.x", "e.y", "rate.x", "rate.y")), (*e, *v), strict=True))


@pytest.mark.parametrize("method", [{"method": "dop853"}, {"method": "rodas5p"}, {"method": "rk4", "step": 1e-5}])
@pytest.mark.parametrize("formulation", ["free", "full"])
def test_free_flight_ends_where_the_quadratic_says(scenes: Scenes, formulation: str, method: dict[str, Any]) -> None:
    scene, rng = getattr(scenes, formulation), np.random.default_rng(4)
    for _ in range(4):
        e, v = rng.uniform(-1.4e-4, 1.4e-4, 2), rng.uniform(5e-3, 2e-2) * np.array([1.0, rng.uniform(-1, 1)])
        run = scene.simulate(parameters=numbers(e, v), **method)
        t, onset = touching(e, v), run.impacts[0]
        near = 1e-4 if "step" in method else 1e-9  # the step of rk4 ends in contact, and feels it
        np.testing.assert_allclose([run["A.ex"][0], run["A.ey"][0]], e, atol=1e-16)
        assert onset["t_on"] == pytest.approx(t, rel=near)
        assert onset["deltadot"] == pytest.approx(float((e + v * t) @ v) / C, rel=near)


def relative(q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
    """e and ė of A and B of the crank drive, with its lengths written out."""

    def end(body: int, length: float) -> tuple[np.ndarray, np.ndarray]:
        x, y, theta = q[3 * body : 3 * body + 3]
        vx, vy, omega = v[3 * body : 3 * body + 3]
        c, s = length * math.cos(theta), length * math.sin(theta)
        return np.array([x + c, y + s]), np.array([vx - omega * s, vy + omega * c])

    (head, head_v), (tail, tail_v), (end_r, end_v) = end(0, 0.025), end(1, -0.06), end(1, 0.06)
    return tail - head, tail_v - head_v, q[6:8] - end_r, v[6:8] - end_v


def test_a_linkage_closes_around_its_journals(scenes: Scenes) -> None:
    """Both as the file says, the crank as its motor, the piston on its line; the search in Python agrees with C."""
    p = compute_parameter_values(scenes.driven.compiled, {"start.play.B.e.y": "-0.03 mm"})[0]
    start = scenes.driven.start({"start.play.B.e.y": "-0.03 mm"})
    expected = ([2e-5, 4e-5], [3e-3, 0.0], [0.0, -3e-5], [0.0, -2e-3])
    for got, each in zip(relative(start.q, start.v), expected, strict=True):
        np.testing.assert_allclose(got, each, atol=1e-13)
    np.testing.assert_allclose([start.q[2], start.q[7], start.v[2]], [math.radians(50), 0.0, 20.0], atol=1e-12)
    found = search_start(scenes.driven.compiled, p)
    np.testing.assert_allclose(found.q, start.q, atol=1e-12)
    np.testing.assert_allclose(found.v, start.v, atol=1e-10)
    assert start.residual < 1e-12 > found.residual


@pytest.mark.parametrize("options", [{"method": "rk4", "step": 5e-6}, {"method": "dop853"}])
def test_columns_are_single_runs(scenes: Scenes, options: dict[str, Any]) -> None:
    """Side by side too: e of one joint, ė of the other, some of them in contact from the start."""
    rng = np.random.default_rng(2)
    columns = {"out": rng.uniform(-1.5e-4, 1.5e-4, 9), "start.play.B.rate.x": rng.uniform(-0.02, 0.02, 9)}
    batch = scenes.driven.simulate_many(columns, **options)
    assert not batch.failures
    for i in range(9):
        alone = scenes.driven.simulate(parameters={name: x[i] for name, x in columns.items()}, **options)
        np.testing.assert_array_equal(batch.q[i], alone.q)
        np.testing.assert_array_equal(batch.v[i], alone.v)
        assert batch.impacts[i].tobytes() == alone.impacts.tobytes()
        assert batch[i].diagnostics.notes == alone.diagnostics.notes


DEEP = 2e-6


@pytest.mark.parametrize("method", ["dop853", "rk4", "scipy:DOP853"])
@pytest.mark.parametrize(("speed", "message"), [(0.02, ""), (-0.02, "separate at 0.02 m/s"), (0.0, "are at rest")])
def test_a_run_that_begins_in_contact(scenes: Scenes, method: str, speed: float, message: str) -> None:
    """δ̇⁻ of an onset without loss: m δ̇⁻²/2 = m δ̇²/2 + K δ^2.5/2.5; the first force by hand; the run tells of it."""
    n = np.array([0.6, 0.8])
    given = numbers((C + DEEP) * n, speed * n)
    run = scenes.free.simulate(1e-5, output=4, method=method, parameters=given, step=1e-7 if method == "rk4" else None)
    assert run.state[0, 0] == (1 if speed > 0.0 else 2)
    K = 2.0 / 3.0 * 206e9 / (1 - 0.09) * math.sqrt(R * (R - C) / (2 * R - C))
    onset = math.sqrt(speed**2 + 2.0 * K * DEEP**2.5 / 2.5 / M)
    assert run.memory[0, 0] == pytest.approx(onset, rel=1e-6)
    force = K * DEEP**1.5 * (1 + 0.75 * (1 - 0.81) * speed / onset)
    assert run["A.Fn"][0] == pytest.approx(force, rel=1e-6)
    notes = [note for note in run.diagnostics.notes if "begins in contact" in note]
    assert [message in note for note in notes] == [True] * bool(message)
    assert run.impacts["deltadot"][0] == run.memory[0, 0]  # where the note says that it is


@pytest.mark.parametrize(
    "law", ["{law: hertz, restitution: 1}", "{law: kelvin_voigt, stiffness: 1e7 N/m, damping: 10 N*s/m}"]
)
def test_damping_that_knows_no_onset_hangs_on_no_choice(scenes: Scenes, law: str) -> None:
    file = scenes.file("none", FREE.replace("{law: lankarani_nikravesh, restitution: 0.9}", law))
    run = gudgeon.load(file, "dry").simulate(1e-4, output=2, parameters=numbers([C + DEEP, 0.0], [-0.02, 0.0]))
    assert run["A.Fn"][0] > 0.0 and not [note for note in run.diagnostics.notes if "begins in contact" in note]


@pytest.mark.parametrize(
    ("law", "K", "n"),
    [
        ("law: hunt_crossley, stiffness: 2e8, restitution: 1", 2e8, 1.5),
        ("law: flores, stiffness: 2e8, restitution: 0.5, exponent: 1.2", 2e8, 1.2),
        ("law: kelvin_voigt, stiffness: 3e6 N/m, damping: 90 N*s/m", 3e6, 1.0),
    ],
)
def test_an_onset_without_loss_by_the_exponent_of_its_law(law: str, K: float, n: float, scenes: Scenes) -> None:
    """m δ̇⁻²/2 = m δ̇²/2 + K δⁿ⁺¹/(n + 1), whatever the damping is; at rest by the velocity floor at least."""
    file = scenes.file("law", FREE.replace("law: lankarani_nikravesh, restitution: 0.9", law))
    scene, away = gudgeon.load(file, "dry"), np.array([0.6, 0.8])
    for deep, speed in ((DEEP, 0.03), (DEEP, -0.03), (DEEP, 0.0), (1e-12, 0.0)):
        run = scene.simulate(1e-6, output=1, parameters=numbers((C + deep) * away, speed * away))
        onset = math.sqrt(speed**2 + 2.0 * K * deep ** (n + 1.0) / (n + 1.0) / M)
        assert run.impacts["deltadot"][0] == pytest.approx(max(onset, 1e-6), rel=1e-6)


def test_what_contradicts_it_is_named(scenes: Scenes) -> None:
    play = "play: {A: {e: [ex, ey], rate: [vx, vy]}}"
    file = scenes.file("held", FREE.replace(play, f"{play}, set: {{ball.x: 1 mm}}"))
    with pytest.raises(AssemblyError, match=r"A\.x.*set ball\.x|set ball\.x.*A\.x"):
        gudgeon.load(file, "dry").start()
    file = scenes.file("pushed", FREE.replace(play, f"{play}, rates: {{ball.vx: 1 mm/s}}"))
    with pytest.raises(AssemblyError, match=r"start\.rates ball\.vx cannot be met.*A") as caught:
        gudgeon.load(file, "dry").start()
    assert "play: {A:" in str(caught.value)


def test_scenes_without_that_play_do_not_know_it(scenes: Scenes) -> None:
    ideal = gudgeon.load(scenes.folder / "free.yaml", "ideal")
    np.testing.assert_allclose(ideal.start().q[:2], [2e-3, -1e-3], atol=1e-15)
    with pytest.raises(UnknownNameError, match=r"start\.play\.A\.e\.x"):
        ideal.start({"start.play.A.e.x": 1e-4})


def test_an_override_brings_it_into_any_file(scenes: Scenes) -> None:
    """One component alone; the other three are 0, and numbers of the run all the same."""
    file = scenes.file("plain", FREE.replace("start: {play: {A: {e: [ex, ey], rate: [vx, vy]}}}\n", ""))
    scene = gudgeon.load(file, "dry", overrides={"start.play.A.e.x": "0.1 mm"})
    run = scene.simulate(1e-3, output=2, parameters={"start.play.A.rate.y": "1 mm/s"})
    np.testing.assert_allclose([run["A.ex"][-1], run["A.ey"][-1]], [1e-4, 1e-6], rtol=1e-9)


@pytest.mark.parametrize("e", ["[0.02, 0]", pytest.param("[0.5, 0.5]", marks=pytest.mark.slow)])
def test_an_eccentricity_in_metres_by_mistake_is_told(e: str, scenes: Scenes) -> None:
    """It was a start that does not close, or a journal that lies deep at once: bare numbers are m."""
    file = scenes.file("metres", CRANK.replace("e: [out, 0.04 mm]", f"e: {e}"))
    with pytest.raises(
        AssemblyError, match=r"(?s)start\.play\.A\.e has a length of \d+.* mm.*number without a unit is in m"
    ):
        gudgeon.load(file, "dry").simulate(1e-4)
    done = CliRunner().invoke(app, ["check", str(file)])
    assert done.exit_code != 0 and "start.play.A.e has a length of" in done.output


def test_a_journal_too_deep_is_refused_alike_alone_and_as_a_column(scenes: Scenes) -> None:
    """Its length and the most there may be in digits that tell them apart; no unit is blamed where one is plausible."""
    most = C + R / 10.0
    texts = []
    for e in (2.0 * most, most * (1.0 + 1e-7)):
        with pytest.raises(AssemblyError, match=r"start\.play\.A\.e has a length of") as alone:
            scenes.free.simulate(1e-4, parameters=numbers([e, 0.0], [0.0, 0.0]))
        texts.append(str(alone.value))
    columns = numbers([0.0, 0.0], [0.0, 0.0]) | {"start.play.A.e.x": [2.0 * most, most * (1.0 + 1e-7), 1e-5]}
    batch = scenes.free.simulate_many(columns, 1e-4)
    assert {failure.run: str(failure.error) for failure in batch.failures} == dict(enumerate(texts))
    nearly = numbers([most * (1.0 - 1e-7), 0.0], [0.0, 0.0])
    check_journal_positions(
        scenes.free.compiled, compute_parameter_values(scenes.free.compiled, nearly)[0]
    )  # so deep may it lie
    assert "a length of 2.6 mm: expected 1.3 mm at most" in texts[0] and "without a unit" not in texts[0]
    length, limit = re.findall(r"a length of (\S+) mm: expected (\S+) mm at most", texts[1])[0]
    assert float(length) > float(limit) == pytest.approx(1.3)


def test_a_start_in_a_worn_place_of_a_bearing_that_is_turned(tmp_path: Path) -> None:
    """5 µm are worn off at 67.5° of a plate that stands at 0.7 rad: 3 µm behind the circle is no contact there."""
    file = tmp_path / "worn.yaml"
    text = FREE.replace("bodies: {", "bodies: {plate: {mass: 1 kg, inertia: 1e-3 kg*m^2}, ")
    plate = "joints: {P: {revolute: [ground.o, plate.origin]}, A: {revolute: [plate.origin,"
    text = text.replace("joints: {A: {revolute: [ground.o,", plate)
    text = text.replace("contact: dry}", "contact: dry, contour: 16}")
    text = text.replace("start: {", "start: {set: {plate.theta: 0.7}, ")
    file.write_text(text, encoding="utf-8")
    simulation = gudgeon.load(file, "dry")
    depths = np.where(np.arange(16) == 3, 5e-6, 0.0)
    for angle, touches in ((67.5, False), (67.5 + 45.0, True), (67.5 - 90.0, True)):
        turned = math.radians(angle) + 0.7
        e = (C + 3e-6) * np.array([math.cos(turned), math.sin(turned)])
        run = simulation.simulate(1e-9, output=2, parameters=numbers(e, [0.0, 0.0]), contour={"A": depths})
        assert any("begins in contact" in note for note in run.diagnostics.notes) == touches, angle


def test_check_tells_of_a_start_in_the_wall(scenes: Scenes) -> None:
    for y, message in ((-0.28, ""), (-0.2836, "A begins 0.7141 µm inside its bearing's wall"), (-0.4, "e/c = 1.37")):
        file = scenes.file("wall", FREE.replace("ex: 0.1 mm, ey: -0.05 mm", f"ex: 0.1 mm, ey: {y} mm"))
        shown = " ".join(CliRunner().invoke(app, ["check", str(file)]).output.split())
        assert ("inside its bearing's wall" in shown) == bool(message) and message in shown


def test_a_deep_start_is_not_the_steps_fault(scenes: Scenes) -> None:
    run = scenes.free.simulate(1e-6, output=2, parameters=numbers([C + 0.2e-3, 0.0], [-0.01, 0.0]))
    notes = [note for note in run.diagnostics.notes if "outside the validity of contact laws" in note]
    assert len(notes) == 1 and "the start is that deep" in notes[0] and "step" not in notes[0]
