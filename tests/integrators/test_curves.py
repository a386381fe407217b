"""Curves in drives and forces: against SciPy's splines, closed forms and differences; knots, ends, tables."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError, InputError, SolverError
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags
from tests.equations.subjects import make
from tests.scenes import loader
from tests.slow import slow_rows_but

ANGLES, LIFTS = [0, 60, 120, 180, 240, 300, 360], [0, 2, 7, 10, 6, 1.5, 0]
LIFT = f"points: {[list(p) for p in zip(ANGLES, LIFTS, strict=True)]}, x: deg, y: mm, ends: periodic"
TIMES, THRUSTS = [0, 0.1, 0.2, 0.33, 0.5, 0.6, 0.8, 1], [0, 5, 30, 1, -10, -3, 9, 5]
THRUST = f"points: {[list(p) for p in zip(TIMES, THRUSTS, strict=True)]}, x: s, y: N"

CAM = f"""
gravity: [0, -9.81 m/s^2]
parameters: {{omega: 10 rad/s, clear: 20 mm}}
curves: {{lift: {{{LIFT}}}}}
bodies: {{follower: {{mass: 0.5 kg, inertia: 1e-3 kg*m^2}}}}
ground: {{O: [0, 0]}}
joints: {{guide: {{translational: [ground.O, follower.origin], axis: [0, 1]}}}}
drives: {{cam: {{coordinate: follower.y, value: clear + lift(omega * t)}}}}
events: {{high: {{zero: lift(omega * t) - 9 mm}}}}
outputs: {{lifted: lift(omega * t)}}
"""
SLUG = (
    """
parameters: {k: 1}
curves:
  pull: {points: [[-100, -50], [-50, -20], [0, 0], [50, 20], [100, 60]], x: mm, y: N, ends: not_a_knot, %s}
  thrust: {"""
    + THRUST
    + """}
bodies: {slug: {mass: 0.3 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, slug.origin], axis: [1, 0]}}
forces: {spring: {force: slug.com, value: ["%s", 0]}}
start: {rates: {slug.vx: 1 m/s}}
"""
)


def lift() -> CubicSpline:
    return CubicSpline(np.radians(ANGLES), np.array(LIFTS) * 1e-3, bc_type="periodic")


def slug(force: str, extrapolate: str = "line") -> str:
    return SLUG % (f"extrapolate: {extrapolate}", force)


def test_a_follower_is_where_its_cam_says(tmp_path: Path) -> None:
    """Place, rate, second rate and the drive's force, from the spline's own derivatives; over several turns."""
    run = loader(tmp_path)(CAM).simulate(2.0, output=777)
    s, angle = lift(), 10.0 * run.t
    np.testing.assert_allclose(run["follower.y"], 0.02 + s(angle), atol=1e-15)
    np.testing.assert_allclose(run["follower.vy"], 10.0 * s(angle, 1), atol=1e-14)
    np.testing.assert_allclose(run["follower.ay"], 100.0 * s(angle, 2), atol=1e-12)
    np.testing.assert_allclose(np.abs(run["cam.force"]), np.abs(0.5 * (9.81 + 100.0 * s(angle, 2))), atol=1e-11)
    np.testing.assert_allclose(run["lifted"], s(angle), atol=1e-15)
    found = np.array(run.events_of("high"))
    assert len(found) == sum(np.diff(np.sign(s(10.0 * np.linspace(0, 2, 4001)) - 9e-3)) != 0)
    assert np.abs(s(10.0 * found) - 9e-3).max() < 1e-12


ENDS = [("natural", 1), ("not_a_knot", 1), ("clamped", 2), ("periodic", None)]


@pytest.mark.parametrize(("ends", "order"), slow_rows_but([("natural", 1), ("periodic", None)], ENDS))
def test_a_cam_whose_end_does_not_meet_its_beginning_is_told(tmp_path: Path, ends: str, order: int | None) -> None:
    """By the run that passes there, and by check; the rate jumps by what SciPy's spline says."""
    text = CAM.replace("ends: periodic", f"ends: {ends}").replace("lift(omega * t)", "lift(mod(omega * t, 2*pi))")
    scene, turn = loader(tmp_path)(text), 2.0 * np.pi / 10.0
    run = scene.simulate(turn + 0.1, output=np.array([0.0, turn - 1e-9, turn + 1e-9, turn + 0.1]))
    notes = [note for note in run.diagnostics.notes if note.startswith("drive cam: where mod restarts curve lift, ")]
    checked = CliRunner().invoke(app, ["check", *map(str, tmp_path.glob("*.yaml"))]).output
    assert bool(notes) == ("curve: drive cam: where mod restarts" in checked) == (order is not None)
    assert not [note for note in scene.simulate(turn - 0.1).diagnostics.notes if "mod restarts" in note]
    if order is not None:
        scipys = {"not_a_knot": "not-a-knot"}.get(ends, ends)
        spline = CubicSpline(np.radians(ANGLES), np.array(LIFTS) * 1e-3, bc_type=scipys)
        end, begin = spline(2.0 * np.pi, order), spline(0.0, order)
        assert f"from {end:.4g} to {begin:.4g} " in notes[0] and "ends: periodic in curves.lift" in notes[0]
        name = ("vy", "ay")[order - 1]
        got = run[f"follower.{name}"]
        assert got[2] - got[1] == pytest.approx(10.0**order * (begin - end), rel=1e-5)


def test_second_rates_are_the_differences_of_rates(tmp_path: Path) -> None:
    """A crank that a curve turns moves a rod and a slider: a square loop, whose positions follow the drive."""
    text = f"""
curves: {{way: {{{THRUST.replace("y: N", "y: deg")}}}}}
bodies:
  crank: {{length: 0.1 m, mass: 1 kg, inertia: 1e-3 kg*m^2}}
  rod: {{length: 0.3 m, mass: 1 kg, inertia: 1e-3 kg*m^2}}
  slider: {{mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {{O: [0, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  A: {{revolute: [crank.head, rod.tail]}}
  B: {{revolute: [rod.head, slider.origin]}}
  guide: {{translational: [ground.O, slider.origin], axis: [1, 0]}}
drives: {{d: {{angle: crank, value: 40 deg + 2 * way(t)}}}}
start: {{guess: {{rod.theta: -10 deg, slider.x: 0.35 m}}}}
"""
    h, at = 1e-5, np.array([0.05, 0.15, 0.4, 0.55, 0.7, 0.9])
    run = loader(tmp_path)(text).simulate(output=np.sort(np.concatenate([[0.0], at - h, at, at + h])).tolist())
    for name in ("slider", "rod"):
        a, b = ("vx", "ax") if name == "slider" else ("omega", "alpha")
        rates, second = run[f"{name}.{a}"][1:].reshape(-1, 3), run[f"{name}.{b}"][1:].reshape(-1, 3)
        np.testing.assert_allclose((rates[:, 2] - rates[:, 0]) / (2 * h), second[:, 1], rtol=1e-7, atol=1e-6)


@pytest.mark.parametrize(("method", "within"), [("dop853", 1e-12), ("rodas5p", 1e-10)])
def test_steps_end_at_knots_in_time(tmp_path: Path, method: str, within: float) -> None:
    """The force is a polynomial within each step: the methods' orders hold."""
    run = loader(tmp_path)(slug("thrust(t)")).simulate(1.0, rtol=1e-10, method=method, output=10)
    force = CubicSpline(TIMES, THRUSTS, bc_type="natural")
    speed = force.antiderivative(1)
    assert run["slug.vx"][-1] == pytest.approx(1.0 + (speed(1.0) - speed(0.0)) / 0.3, abs=1e-12)
    place = force.antiderivative(2)
    want = 1.0 + (place(1.0) - place(0.0) - speed(0.0)) / 0.3
    assert run["slug.x"][-1] == pytest.approx(want, abs=within)


@pytest.mark.parametrize(("method", "left"), [pytest.param("dop853", 1e-8, marks=pytest.mark.slow), ("rodas5p", 1e-7)])
def test_knots_in_the_state_and_the_tangent_beyond(tmp_path: Path, method: str, left: float) -> None:
    """`left` of the energy (J): what an error of 1e-7 m/s at 3.5 m/s makes of .3 kg."""
    text = slug("-pull(slug.x)").replace("vx: 1 m/s", "vx: 5 m/s")
    run = loader(tmp_path)(text).simulate(1.0, rtol=1e-10, method=method, output=10)
    s = CubicSpline(np.array([-100, -50, 0, 50, 100]) * 1e-3, [-50, -20, 0, 20, 60], bc_type="not-a-knot")

    def pull(x: float) -> float:
        return float(s(np.clip(x, -0.1, 0.1)) + s(-0.1, 1) * min(x + 0.1, 0) + s(0.1, 1) * max(x - 0.1, 0))

    end = solve_ivp(
        lambda _, y: [y[1], -pull(y[0]) / 0.3], (0, 1), [0, 5], "DOP853", rtol=1e-13, atol=1e-15, max_step=1e-3
    ).y[:, -1]
    assert np.abs(run["slug.x"]).max() > 0.1
    assert run["slug.x"][-1] == pytest.approx(end[0], abs=5e-9)
    assert run["slug.vx"][-1] == pytest.approx(end[1], abs=2e-7)
    assert run.diagnostics.energy_residual < left


def test_the_jacobian_is_that_of_differences(tmp_path: Path) -> None:
    sim = loader(tmp_path)(slug("-pull(slug.x) + thrust(t) * (1 + slug.vx / (3 m/s))"))
    rng = np.random.default_rng(3)
    for _ in range(20):
        y = np.zeros(6)
        y[0], y[3], t, h = rng.uniform(-0.15, 0.15), rng.normal(), rng.uniform(0, 1), 1e-6
        found = sim.jacobian(t, y)[3, [0, 3]]
        steps = [np.eye(6)[k] * h for k in (0, 3)]
        want = [(sim.rhs(t, y + d)[3] - sim.rhs(t, y - d)[3]) / (2 * h) for d in steps]
        np.testing.assert_allclose(found, want, rtol=1e-6, atol=1e-6)


def test_a_batch_has_the_bits_of_single_runs(tmp_path: Path) -> None:
    sim = loader(tmp_path)(slug("-k * pull(slug.x) + thrust(t)"))
    factors = np.linspace(0.5, 1.5, 9)
    for requested in ({"method": "rk4", "step": 1e-3}, {"method": "dop853"}):
        batch = sim.simulate_many({"k": factors}, t_end=1.0, output=20, **requested)
        for k, factor in enumerate(factors):
            one = sim.simulate(1.0, output=20, parameters={"k": float(factor)}, **requested)
            assert (batch[k]["slug.x"] == one["slug.x"]).all()


def test_outside_the_points_a_run_ends_with_the_curve_the_argument_and_the_range(tmp_path: Path) -> None:
    load = loader(tmp_path)
    with pytest.raises(SolverError, match=r"curve thrust at 1\.0\d*.*outside its range, from 0 to 1 \(SI") as caught:
        load(slug("thrust(t)")).simulate(1.5)
    assert caught.value.partial.t[-1] == pytest.approx(1.0, abs=0.01)
    with pytest.raises(SolverError, match=r"curve pull at .*outside its range, from -0\.1 to 0\.1 \(SI"):
        load(slug("-pull(slug.x)", "none").replace("vx: 1 m/s", "vx: 5 m/s")).simulate(1.0)
    driven = CAM.replace(", ends: periodic", "").replace("events:", "#").replace("outputs:", "#")
    with pytest.raises((SolverError, InputError), match=r"outside its range, .*, from 0 to 360 deg") as over:
        load(driven).simulate(1.0)
    found = re.search(r"curve lift at (\S+), outside its range, from 0 to (\S+) ", str(over.value))
    assert found is not None
    at, end = map(float, found.groups())
    assert at > end == pytest.approx(2.0 * np.pi, rel=1e-5) and "ends: periodic" in str(over.value)


def test_a_drive_that_is_held_jumps_in_its_rate(tmp_path: Path) -> None:
    """The impulse at the end of the points is counted as that of a ramp's corner."""
    text = CAM.replace("ends: periodic", "extrapolate: hold").replace("events:", "#")
    run = loader(tmp_path)(text).simulate(output=[0.6, 0.62, 0.64, 0.8])
    s = CubicSpline(np.radians(ANGLES), np.array(LIFTS) * 1e-3, bc_type="natural")
    np.testing.assert_allclose(run["follower.vy"][-4:], [*(10 * s([6.0, 6.2], 1)), 0, 0], atol=1e-14)
    np.testing.assert_allclose(run["follower.y"][-2:], 0.02, atol=1e-15)
    assert run.diagnostics.energy_residual < 1e-9


def test_another_table_is_another_scene(tmp_path: Path) -> None:
    """What the kernels were made from is part of their key; equations and states of another one are refused."""
    table, file = tmp_path / "thrust.csv", tmp_path / "n.yaml"
    text = slug("thrust(t)").replace(THRUST, "table: thrust.csv, x: s, y: N")
    file.write_text("format: gudgeon/1\nname: n\n" + text)
    ends = []
    for scale in (1.0, 2.0, 1.0):
        table.write_text("".join(f"{x},{scale * y}\n" for x, y in zip(TIMES, THRUSTS, strict=True)))
        sim = gudgeon.load(file)
        ends.append(sim.simulate(0.9, output=3))
    assert sim.loading and sim.loading.origin == "cache"
    speeds = [run["slug.vx"][-1] - 1.0 for run in ends]
    assert speeds[1] == pytest.approx(2.0 * speeds[0]) and speeds[2] == speeds[0]
    with pytest.raises(BadValueError, match="another table thrust.csv"):
        sim.simulate(0.1, start=ends[1].final)
    assert sim.simulate(1.0, start=ends[0].final).t[-1] == 1.0
    table.write_text("0,1\n1,2\n")
    with pytest.raises(InputError, match="a table of .* was edited"):
        _ = sim.model
    table.unlink()
    with pytest.raises(InputError, match=r"cannot read the table thrust\.csv"):
        gudgeon.load(file)


def test_numpy_and_the_complex_step_agree_with_c() -> None:
    text = "format: gudgeon/1\nname: n\n" + slug("-pull(slug.x) + thrust(t)") + "drives: {}\n"
    subject = make(text.encode(), "n.yaml", "ideal")
    numpy = subject.model.numpy()
    p, rng = numpy.prepare(), np.random.default_rng(4)
    for _ in range(20):
        q, v, t = np.zeros(3), np.zeros(3), rng.uniform(0, 1)
        q[0], v[0] = rng.uniform(-0.15, 0.15), rng.normal()
        theirs = numpy.dynamics(t, q, v, p).a
        assert theirs[0] == pytest.approx(subject.library.rhs(t, np.append(q, v), subject.p)[3], rel=1e-14)
    assert "CURVE_pull_ = (" in numpy.source


@pytest.mark.parametrize("text", [CAM, slug("-pull(slug.x) + thrust(t)")])
def test_c_has_no_warnings(text: str, tmp_path: Path) -> None:
    source = generate_kernel_source(("format: gudgeon/1\nname: n\n" + text).encode(), "n.yaml", "ideal")
    for file, content in source.files.items():
        (tmp_path / file).write_text(content, encoding="utf-8")
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *build_include_flags()]
    for main in filter(None, (source.main, source.lane_file)):
        line = [*find_compiler(), *flags, main]
        done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr[:2000]
    assert "- `curves.c`: the file's curves" in source.files["README.md"]


def test_an_extent_of_nothing_is_no_number_of_c(tmp_path: Path) -> None:
    """A follower and its guide at one point: a slide had no length that its steps are measured by."""
    free = "\n  slug: {mass: 1 kg, inertia: 1 kg*m^2}"
    text = CAM.replace("bodies: {", "bodies:\n  ").replace("1e-3 kg*m^2}}", f"1e-3 kg*m^2}}{free}")
    text = text.replace("coordinate: follower.y", "distance: [ground.O, follower.origin]")
    run = loader(tmp_path)(text + "start: {guess: {follower.y: 20 mm}}\n").simulate(0.5, output=50)
    np.testing.assert_allclose(run["follower.y"], 0.02 + lift()(10.0 * run.t), atol=1e-12)


@pytest.mark.parametrize("n", [5000, 60_000])
def test_a_long_table_is_the_curve_that_scipy_makes_of_it(tmp_path: Path, n: int) -> None:
    """A measured signal, more points than are printed as numbers; of 60,000 the table is read at once."""
    t = np.linspace(0.0, 10.0, n)
    y = 5.0 * np.sin(3.0 * t) + 0.01 * np.random.default_rng(1).standard_normal(n)
    rows = "".join(f"{a:.12g},{b:.12g}\n" for a, b in zip(t, y, strict=True))
    (tmp_path / "signal.csv").write_text("time,force\n" + rows, encoding="utf-8")
    text = slug("signal(t)").replace("curves:", "curves:\n  signal: {table: signal.csv, x: s, y: N}")
    text = text.replace("start:", "outputs: {pulled: signal(t)}\nstart:")
    run = loader(tmp_path)(text).simulate(0.1, rtol=1e-10, output=500)
    data = np.loadtxt(tmp_path / "signal.csv", delimiter=",", skiprows=1)
    s = CubicSpline(data[:, 0], data[:, 1], bc_type="natural")
    np.testing.assert_allclose(run["pulled"], s(run.t), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(run["slug.ax"], s(run.t) / 0.3, rtol=1e-12, atol=1e-11)
    assert run["slug.vx"][-1] == pytest.approx(1.0 + s.integrate(0.0, 0.1) / 0.3, abs=1e-12)


@pytest.mark.parametrize("rtol", [1e-6, 1e-10])
def test_steps_do_not_reach_beyond_the_next_piece_of_a_curve(tmp_path: Path, rtol: float) -> None:
    """Noise, 600 points in 0.1 s: each piece is a cubic, whose integral methods of order 4 and more give exactly.

    Steps that led over several pieces were accepted by chance and erred by 3e-7 m/s at any tolerance.
    """
    t = np.linspace(0.0, 0.2, 1200)
    y = 0.01 * np.random.default_rng(4).standard_normal(len(t))
    rows = "".join(f"{a:.12g},{b:.12g}\n" for a, b in zip(t, y, strict=True))
    (tmp_path / "signal.csv").write_text("time,force\n" + rows, encoding="utf-8")
    text = slug("signal(t)").replace("curves:", "curves:\n  signal: {table: signal.csv, x: s, y: N}")
    run = loader(tmp_path)(text).simulate(0.1, rtol=rtol, output=500)
    data = np.loadtxt(tmp_path / "signal.csv", delimiter=",", skiprows=1)
    s = CubicSpline(data[:, 0], data[:, 1], bc_type="natural")
    np.testing.assert_allclose(run["slug.vx"], [1.0 + s.integrate(0.0, end) / 0.3 for end in run.t], atol=1e-12)
