"""Friction that sticks: the belt's limit cycle against its closed form, a block at rest, a block between two."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

import gudgeon
from gudgeon.loading.shipped import find_shipped_file
from tests.equations.subjects import make
from tests.programs import needs_compiler

PERIOD, STICK = 0.8008322171201989, 0.3924  # k = 100 N/m, m = 1 kg, Fs = .6 m g, Fk = .4 m g, belt .1 m/s


@pytest.mark.parametrize(("step", "error"), [(1e-2, 4e-7), (5e-3, 4e-8), (1e-3, 1e-9)])
def test_stick_slip_period(step: float, error: float) -> None:
    """In stick x = x0 + v (t − t0): each cycle's t0 follows from any of its stick samples."""
    belt = gudgeon.load("belt_block")
    run = belt.simulate(20.0, step=step, output=20_000)
    mode, x = run["rub.mode"], run["block.x"]
    begins = np.flatnonzero((mode[1:] == 0) & (mode[:-1] != 0)) + 1
    offsets = [run.t[i + 10] - x[i + 10] / 0.1 for i in begins]
    assert len(begins) > 20
    assert np.diff(offsets)[1:] == pytest.approx(PERIOD, abs=error)
    ends = np.flatnonzero((mode[1:] != 0) & (mode[:-1] == 0)) + 1
    assert np.median([run.t[j] - run.t[i] for i, j in zip(begins[1:-1], ends[ends > begins[1]], strict=False)]) == (
        pytest.approx(STICK, abs=2e-3)  # two samples
    )
    assert np.abs(run["rub.F"]).max() <= 5.886 * (1 + 1e-12)
    assert run.diagnostics.energy_residual < max(1e-8, error)


def test_a_block_at_rest_does_not_creep() -> None:
    belt = gudgeon.load("belt_block")
    run = belt.simulate(10.0, step=1e-2, output=100, parameters={"belt_speed": 0.0, "start_at": 0.05})
    assert np.ptp(run["block.x"]) < 1e-12  # 5 N of spring against 5.886 N at most
    assert run["rub.F"] == pytest.approx(5.0, abs=1e-9)
    assert (run["rub.mode"] == 0).all()


def test_a_block_slides_to_rest(tmp_path: Path) -> None:
    """Without spring and belt: x = v0²/(2 μ g) after v0/(μ g), then nothing."""
    text = find_shipped_file("belt_block").read_text(encoding="utf-8")
    file = tmp_path / "block.yaml"
    file.write_text(text.replace("block.x: start_at", "block.x: start_at\n  rates: {block.vx: 1 m/s}"))
    block = gudgeon.load(file)
    values = {"belt_speed": 0.0, "forces.spring.stiffness": 0.0}
    run = block.simulate(1.0, step=1e-2, output=[0.0, 0.1, 0.5, 1.0], parameters=values)
    stop = 1.0 / 3.924
    assert run["block.x"][1:] == pytest.approx([0.1 - 0.5 * 3.924 * 0.01, 0.5 * stop, 0.5 * stop], abs=1e-12)
    assert run["work.forces"][-1] == pytest.approx(-0.5, abs=1e-12)
    assert math.isclose(run["block.vx"][-1], 0.0, abs_tol=1e-15)


FALLS = 0.05  # m/s, Stribeck velocity
METHODS = ({"method": "rk4", "step": 1e-3}, {"method": "dop853", "rtol": 1e-10}, {"method": "rodas5p", "rtol": 1e-10})


@pytest.fixture(scope="module")
def stribeck(tmp_path_factory: pytest.TempPathFactory) -> gudgeon.Simulation:
    """The belt's block with friction that falls with the slip."""
    text = find_shipped_file("belt_block").read_text(encoding="utf-8")
    file = tmp_path_factory.mktemp("stribeck") / "belt.yaml"
    text = text.replace("kinetic: 3.924 N", f"kinetic: 3.924 N, stribeck_velocity: {FALLS}")
    text = text.replace("  start_at: 0 m\n", "  start_at: 0 m\n  speed: 0 m/s\n")
    file.write_text(text.replace("block.x: start_at", "block.x: start_at\n  rates: {block.vx: speed}"))
    return gudgeon.load(file)


def falling(v: float, falls: float = FALLS) -> float:
    return 3.924 + (5.886 - 3.924) * math.exp(-((v / falls) ** 2))


@needs_compiler
@pytest.mark.parametrize("how", METHODS, ids=lambda how: how["method"])
def test_stick_slip_of_friction_that_falls(how: dict[str, str | float], stribeck: gudgeon.Simulation) -> None:
    """The cycle: slip by scipy from the limit of stick to the belt's speed, then stick from there to the limit."""

    def rates(t: float, y: np.ndarray) -> list[float]:
        return [y[1], -100.0 * y[0] + math.copysign(falling(y[1] - 0.1), 0.1 - y[1])]

    def together(t: float, y: np.ndarray) -> float:
        return float(y[1] - 0.1) if t > 0.05 else -1.0

    together.terminal = True  # type: ignore[attr-defined]
    slip = solve_ivp(rates, (0.0, 2.0), [0.05886, 0.1 - 1e-12], events=together, rtol=1e-12, atol=1e-14, max_step=0.01)
    period = slip.t[-1] + (0.05886 - slip.y[0, -1]) / 0.1
    run = stribeck.simulate(8.0, output=8000, **how)  # type: ignore[arg-type]
    mode, x = run["rub.mode"], run["block.x"]
    begins = np.flatnonzero((mode[1:] == 0) & (mode[:-1] != 0)) + 1
    offsets = [run.t[i + 10] - x[i + 10] / 0.1 for i in begins]
    assert len(begins) > 7
    assert np.diff(offsets)[1:] == pytest.approx(period, abs=1e-6)
    assert np.abs(run["rub.F"]).max() <= 5.886 * (1 + 1e-12)
    assert run.diagnostics.energy_residual < 1e-7
    slips = mode != 0
    expected = -mode[slips] * np.array([falling(v) for v in run["rub.v"][slips]])
    assert run["rub.F"][slips] == pytest.approx(expected, rel=1e-12)


@needs_compiler
@pytest.mark.parametrize("how", METHODS, ids=lambda how: how["method"])
def test_a_block_slides_to_rest_on_friction_that_falls(
    how: dict[str, str | float], stribeck: gudgeon.Simulation
) -> None:
    """x = ∫ m v/F dv and t = ∫ m/F dv from rest to 1 m/s; all of its energy goes, and it stays."""
    falls = 0.4
    way, time = (quad(lambda v, k=k: v**k / falling(v, falls), 0.0, 1.0, epsabs=1e-14)[0] for k in (1, 0))
    values = {"belt_speed": 0.0, "forces.spring.stiffness": 0.0, "forces.rub.stribeck_velocity": falls, "speed": 1.0}
    times = [0.0, time - 1e-3, time + 1e-3, 1.0]
    run = stribeck.simulate(1.0, output=times, parameters=values, **how)  # type: ignore[arg-type]
    assert run["block.x"][2:] == pytest.approx([way, way], abs=1e-9)
    assert run["rub.mode"][1] != 0 and (run["rub.mode"][2:] == 0).all()
    assert run["work.forces"][-1] == pytest.approx(-0.5, abs=1e-8)


@needs_compiler
@pytest.mark.parametrize("mode", [0.0, 1.0, -1.0])
def test_slopes_of_friction_that_falls(mode: float) -> None:
    """By the complex step, where it slips either way and where it sticks."""
    kinetic, text = b"kinetic: 3.924 N", find_shipped_file("belt_block").read_bytes()
    subject = make(text.replace(kinetic, kinetic + b", stribeck_velocity: 0.05"), "belt", "ideal")
    for v in (0.03, 0.13, -0.4):
        subject.compare(0.0, np.array([0.01, 0.0, 0.0, v, 0.0, 0.0]), np.array([mode]))


DWELLS = """
format: gudgeon/1
name: dwells
bodies: {block: {mass: 2 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, block.origin], axis: [1, 0]}}
drives:
  m: {coordinate: block.x, value: "10 mm + 1 m*smooth_step(t, 0.2 s, 0.2 s) - 0.5 m*smooth_step(t, 0.6 s, 0.2 s)"}
forces: {rub: {dry_friction: [ground.O, block.origin], direction: [1, 0], static: 12 N, kinetic: 8 N}}
scenes: {ideal: {}}
"""


@needs_compiler
def test_friction_of_what_a_drive_holds_at_rest_is_noted(tmp_path: Path) -> None:
    """The drive dwells until .2, from .4 to .6 and from .8 s on: there any force up to 12 N fits; said once."""
    (tmp_path / "dwells.yaml").write_text(DWELLS, encoding="utf-8")
    block = gudgeon.load(tmp_path / "dwells.yaml")
    run = block.simulate(1.0, output=100)
    (note,) = [note for note in run.diagnostics.notes if "rub" in note]
    assert "hold friction rub at rest from t = 0 s on" in note and "not determined" in note
    assert (run["rub.mode"][:20] == 2).all() and "2 held at rest" in run.meaning("rub.mode")
    late = block.simulate(output=np.linspace(0.25, 0.5, 26))
    (note,) = [note for note in late.diagnostics.notes if "rub" in note]
    assert "from t = 0.4 s on, in 11 of 26 samples" in note
    moving = block.simulate(output=[0.25, 0.3, 0.35, 0.65, 0.7])
    assert not [note for note in moving.diagnostics.notes if "rub" in note]
    batch = block.simulate_many([{}], 1.0, output=100)
    assert [note for note in batch[0].diagnostics.notes if "from t = 0 s on" in note]


@needs_compiler
@pytest.mark.parametrize(
    ("limits", "noted"),
    [("mu*12 N, kinetic: mu*8 N", False), ("0 N, kinetic: 0 N", False), ("0 N + 12 N, kinetic: 0 N", True)],
)
def test_friction_without_a_force_is_determined_at_rest(limits: str, noted: bool, tmp_path: Path) -> None:
    text = DWELLS.replace("12 N, kinetic: 8 N", limits).replace("bodies:", "parameters: {mu: 1}\nbodies:")
    (tmp_path / "dwells.yaml").write_text(text, encoding="utf-8")
    run = gudgeon.load(tmp_path / "dwells.yaml").simulate(1.0, output=100, parameters={"mu": 0.0})
    assert any("rub" in note for note in run.diagnostics.notes) == noted


@pytest.mark.parametrize("output", [3, 300])
@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
def test_works_of_a_scene_without_integrated_coordinates_have_a_tolerance(
    output: int, method: str, tmp_path: Path
) -> None:
    """The drive moves the block from rest to rest: without friction its work is 0, and some 300 J flow to and fro."""
    text = DWELLS.replace("12 N, kinetic: 8 N", "0 N, kinetic: 0 N")
    (tmp_path / "dwells.yaml").write_text(text, encoding="utf-8")
    scene = gudgeon.load(tmp_path / "dwells.yaml")
    run, batch = scene.simulate(1.0, output=output, method=method), scene.simulate_many([{}] * 2, 1.0, output=output)
    assert abs(run["work.drives"][-1]) < 1e-4 and abs(batch["work.drives"][0, -1]) < 1e-4
