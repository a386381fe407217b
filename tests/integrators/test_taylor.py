"""Taylor's method: coefficients of every operation, order, tight tolerances, loops, events, and what it refuses."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp

import gudgeon
from gudgeon.errors import BadValueError
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.series import derive_taylor_series
from gudgeon.generator.ir.series_rules import NoTaylorSeries, StoreRow
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.symbols.storage import Key, StorageLocation, find_value_key
from gudgeon.integrators import lanes
from gudgeon.results.batch import Batch
from gudgeon.simulation.simulation import Simulation
from tests.integrators.test_methods import digits, observed_order, scene_of
from tests.integrators.test_side_by_side import COUNT, Seen, assert_same_batches, both
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same

HERE = Path(__file__).parent.parent
Links = Callable[[int], Simulation]
T, X, Y, W = (sp.Symbol(name, real=True) for name in ("time", "x", "y", "w"))
MOTION = ((0.3, 0.5, -0.2, 0.1), (0.7, -0.4, 0.3, 0.05))  # x and y as polynomials of time


def coefficients(value: sp.Expr, orders: int) -> list[float]:
    """Of an expression of time, x and y along MOTION, by both functions of its series."""
    lines = (
        Statement("time", StorageLocation("t")),
        Statement("x", StorageLocation("q")[0]),
        Statement("y", StorageLocation("q")[1]),
        Statement("w", StorageLocation("p")["w"]),
        Statement("result", value),
        Statement(StorageLocation("a")[0], sp.Symbol("result", real=True)),
    )
    made = derive_taylor_series(Kernel("f", (), (), (Section("", lines),)), lambda target: target, "f")
    rows = dict[tuple[str, int], list[float]]()
    names: dict[Key, float] = {StorageLocation("p")["w"]: 0.6}
    found: list[float] = []
    for k in range(orders + 1):
        kept = (name for name in names if k == 0 or (isinstance(name, StorageLocation) and name.base in ("p", "at")))
        known = {name: names[name] for name in kept}
        known |= {StorageLocation("q")[i]: float(c[k]) if k < len(c) else 0.0 for i, c in enumerate(MOTION)}
        known |= {StorageLocation("t"): float(k == 1), "k": k, "share": 1 / max(k, 1), "next": 1 / (k + 1)}
        for i, product in enumerate(made.products):
            left, right = (rows.get((side, i), []) for side in ("left", "right"))
            known[StorageLocation("sum")[product.name]] = sum(left[j - 1] * right[k - j - 1] for j in range(1, k))
        kernel = made.values if k == 0 else made.terms
        for line in (line for section in kernel.sections for line in section.statements):
            follow(line, known, rows)
        found.append(known[StorageLocation("a")[0]] * (k + 1 if k else 1))
        names = names | known
    return found


def follow(line: Instruction, known: dict[Key, float], rows: dict[tuple[str, int], list[float]]) -> None:
    """What a line does, with numbers by their names."""
    if isinstance(line, StoreRow):
        for i, value in enumerate(line.values):
            rows.setdefault((line.array, 8 * line.row + i), []).append(number(value, known))
    elif isinstance(line, Statement):
        value = line.value
        known[line.target] = known[value] if isinstance(value, StorageLocation) else number(value, known)


def number(value: object, known: dict[Key, float]) -> float:
    """Of an expression."""
    expression = sp.sympify(value)
    return float(expression.evalf(25, subs={s: known[find_value_key(s)] for s in expression.free_symbols}))


@pytest.mark.parametrize(
    "value",
    [
        X * Y,
        X**2 * Y - T / Y,
        X / (1 + Y**2),
        sp.sqrt(2 + X * Y),
        (1 + X) ** W,
        Y ** sp.Rational(-3, 2),
        X**7,
        sp.sin(X * T) + sp.cos(Y),
        sp.tan(X) * sp.tanh(Y),
        sp.exp(-X * Y),
        sp.log(1 + X**2),
        sp.sinh(X) / sp.cosh(Y),
        sp.asin(X * W),
        sp.acos(X / 2) + sp.atan(Y),
        sp.atan2(Y, X) + sp.atan2(X, W),
        1 / sp.sqrt(X**2 + Y**2),
        (sp.cos(X) * sp.cos(Y) + sp.sin(X) * sp.sin(Y)) / Y**3,
        sp.exp(sp.sin(X)) * (X + Y) * (X - Y) * (T + 2),
    ],
    ids=str,
)
def test_coefficients_of_every_operation(value: sp.Expr) -> None:
    """Against derivatives by mpmath in 40 digits, to order 8."""
    function = sp.lambdify((T, X, Y, W), value, "mpmath")
    with mpmath.workdps(40):
        x, y = ([mpmath.mpf(c) for c in reversed(some)] for some in MOTION)
        exact = mpmath.taylor(lambda t: function(t, mpmath.polyval(x, t), mpmath.polyval(y, t), mpmath.mpf(0.6)), 0, 8)
    assert coefficients(value, 8) == pytest.approx([float(c) for c in exact], rel=1e-12, abs=1e-13)


def test_what_has_no_series_is_told() -> None:
    for value, why in ((sp.Abs(X), "abs"), (X**Y, "exponent"), (sp.Max(X, Y), "max")):
        with pytest.raises(NoTaylorSeries, match=why):
            coefficients(value, 1)


@needs_compiler
@pytest.mark.parametrize("inside", [False, True])
def test_a_series_as_long_as_1e_8_wants_has_order_14_at_least(inside: bool) -> None:
    """Order ceil(1 - 0.7 ln 1e-8) with fixed steps, at their ends and between them; more where a step is no small part

    of the way to the next pole, and shorter ones err by less than can be seen.
    """
    assert 14.0 < observed_order("swing", "taylor", 1.0, (16, 44, 14), inside) < 17.5


@cache
def swing() -> Simulation:
    return scene_of("swing")


@needs_compiler
@pytest.mark.parametrize("rtol", [1e-5, 1e-8, 1e-11, 1e-13])
def test_errors_follow_the_tolerance_at_every_output(rtol: float) -> None:
    """Samples lie on the series themselves."""
    times = np.sort(np.random.default_rng(3).uniform(0.0, 3.0, 300))
    exact = swing().simulate(output=times, method="dop853", rtol=1e-14)
    run = swing().simulate(output=times, method="taylor", rtol=rtol)
    assert 1e-3 * rtol < abs(run.q - exact.q).max() < 300 * rtol
    assert run.diagnostics.rejected == 0 and run.diagnostics.method == "taylor"


@needs_compiler
def test_energy_and_work_to_twelve_digits() -> None:
    run = swing().simulate(10.0, output=10, method="taylor", rtol=1e-14)
    assert run.diagnostics.energy_residual < 1e-12 * abs(run.work).max()


@needs_compiler
@pytest.mark.plain
def test_loops_closed_by_rows() -> None:
    """Andrews' squeezer: six rows, by the series of its multipliers; in a fifth of the steps of order 8."""
    run = scene_of("andrews_squeezer").simulate(0.03, output=1, method="taylor", rtol=1e-13)
    assert digits(run) > 11.5
    assert run.diagnostics.steps < 80 and run.diagnostics.phi_max < 1e-15


@pytest.mark.slow
@needs_compiler
def test_a_drive_and_its_works() -> None:
    """The car axis: a driven angle asin(r sin(omega t)), a slot that turns with it, springs with roots."""
    axis = scene_of("car_axis")
    exact, run = (axis.simulate(3.0, output=20, method=method, rtol=1e-13) for method in ("dop853", "taylor"))
    assert abs(run.q - exact.q).max() < 1e-11 and abs(run.work - exact.work).max() < 1e-11


@pytest.mark.slow
@needs_compiler
def test_where_links_stand_in_one_line_another_method_takes_the_step() -> None:
    """Four-bars of equal links pass singular positions; their couplers keep their direction."""
    bars = scene_of("n_four_bar")
    exact, run = (bars.simulate(5.0, output=50, method=method, rtol=1e-10) for method in ("dop853", "taylor"))
    assert abs(run.q - exact.q).max() < 1e-6


@needs_compiler
def test_events_on_the_way(at_once: Seen, tmp_path: Path) -> None:
    """A pendulum passes its lowest point: many crossings in few steps, each where its period says; in lanes too.

    The bob turns on its own at a rate that no equation reads.
    """
    text = (HERE.parent / "mechanisms/pendulum.yaml").read_text(encoding="utf-8").replace("omega: 0", "omega: 0.25")
    file = tmp_path / "watched.yaml"
    file.write_text(text + "\nevents:\n  lowest: {zero: bob.x}\n", encoding="utf-8")
    pendulum = gudgeon.load(file, scene="two_seconds")
    run = pendulum.simulate(20.0, output=1, method="taylor", rtol=1e-12)
    assert run.events["t"] == pytest.approx(np.arange(0.5, 20.0, 1.0), abs=1e-10)
    lengths = np.linspace(0.5, 1.5, COUNT)
    batch = assert_same_in_lanes(pendulum, {"length": lengths}, 5.0, at_once, rtol=1e-12)
    for length, events in zip(lengths, batch.events, strict=True):
        assert events["t"] == pytest.approx(np.sqrt(length) * np.arange(0.5, 5.0 / np.sqrt(length), 1.0), abs=1e-10)
    assert abs(batch.q[:, :, 2] - 0.25 * batch.t).max() < 1e-15 * 5.0


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> Seen:
    """Runs go side by side however short their batch is; those that do."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    return Seen(monkeypatch)


def assert_same_in_lanes(simulation: Simulation, sets: Any, t_end: Any, seen: Seen, **options: Any) -> Batch:
    """A batch whose runs went side by side, bit by bit what they are one after the other, its counts too."""
    batch, singly = both(simulation, sets, t_end, method="taylor", **options)
    assert_same_batches(batch, singly)
    for name in ("steps", "right_hand_sides", "rejected", "phi_max", "phi_dot_max"):
        assert (batch.diagnostics[name] == singly.diagnostics[name]).all(), name
    assert set(seen.used) == set(range(COUNT)) and not batch.failures
    assert len({q.tobytes() for q in batch.q}) == COUNT
    return batch


@needs_compiler
def test_many_runs_are_the_same_as_single_ones(at_once: Seen) -> None:
    """Of several lengths: lanes take the next run where one is over."""
    masses, ends = np.linspace(0.8, 1.2, COUNT), np.linspace(0.3, 1.5, COUNT)[::-1]
    batch = assert_same_in_lanes(swing(), {"bodies.L1.mass": masses}, ends, at_once, rtol=1e-10)
    for k in (3, 11):
        one = swing().simulate(ends[k], output=7, method="taylor", rtol=1e-10, parameters={"bodies.L1.mass": masses[k]})
        assert_same(batch[k], one)
    steps = np.linspace(0.02, 0.05, COUNT)
    assert_same_in_lanes(swing(), {"bodies.L1.mass": masses}, 0.5, at_once, step=steps)


@needs_compiler
@pytest.mark.parametrize(("t_end", "output"), [(2.0, 3), pytest.param(600.0, 1, marks=pytest.mark.slow)])
def test_steps_that_are_taken_in_lanes(t_end: float, output: int, at_once: Seen) -> None:
    """Of which nothing but their ends is wanted; so many of them that a run looks at its pace meanwhile."""
    pendulum = gudgeon.load(HERE / "mechanisms" / "valid" / "double_pendulum.yaml", scene="ideal")
    sets = {"bodies.L1.mass": np.linspace(0.8, 1.2, COUNT)}
    batch = assert_same_in_lanes(pendulum, sets, t_end, at_once, output=output, rtol=1e-6)
    assert output > 1 or batch.diagnostics["steps"].min() > 4096


@pytest.mark.slow
@needs_compiler
def test_loops_and_singular_positions_in_lanes(at_once: Seen) -> None:
    """Where a pivot vanishes in a lane, its own run takes the step, by another method."""
    bars, gravity = scene_of("n_four_bar"), np.linspace(-12.0, -3.0, COUNT)
    assert_same_in_lanes(bars, {"gravity.y": gravity}, 1.0, at_once, rtol=1e-8)


@pytest.mark.parametrize(
    ("name", "scene", "why"),
    [
        ("slider_crank", "dry", "wristpin has play"),
        ("belt_block", "ideal", "friction of rub"),
        ("four_bar", "ideal", "the scene integrates no coordinates of a tree"),
    ],
)
@needs_compiler
def test_motion_that_is_not_smooth_is_refused(name: str, scene: str, why: str) -> None:
    with pytest.raises(BadValueError, match=f"smooth motion: .*{why}"):
        scene_of(name, scene).simulate(0.1, output=1, method="taylor")


@needs_compiler
def test_a_fixed_step_is_taken() -> None:
    run = swing().simulate(1.0, output=1, method="taylor", step=0.05)
    assert run.diagnostics.steps == 20 and math.isnan(run.diagnostics.last_step)


@pytest.fixture(scope="module")
def links(tmp_path_factory: pytest.TempPathFactory) -> Links:
    """Chains of uniform links under gravity, at rest at angles a0, a1, ..."""

    @cache
    def chain(count: int) -> Simulation:
        names = ["ground.O", *(f"L{k}.head" for k in range(count))]
        bodies = "".join(f"  L{k}: {{length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}}\n" for k in range(count))
        joints = "".join(f"  J{k}: {{revolute: [{names[k]}, L{k}.tail]}}\n" for k in range(count))
        angles = ", ".join(f"L{k}.theta: a{k}" for k in range(count))
        rates = ", ".join(f"L{k}.omega: 0" for k in range(count))
        file = tmp_path_factory.mktemp("chain") / "links.yaml"
        file.write_text(
            "format: gudgeon/1\nname: links\ngravity: [0, -9.81]\nground: {O: [0, 0]}\n"
            f"parameters: {{{', '.join(f'a{k}: 0 rad' for k in range(count))}}}\nbodies:\n{bodies}joints:\n{joints}"
            f"start: {{set: {{{angles}}}, rates: {{{rates}}}}}\n",
            encoding="utf-8",
        )
        return gudgeon.load(file)

    return chain


@needs_compiler
@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-9, 1e-12, 1e-14])
@pytest.mark.parametrize("angle", [0.0, 1e-6, math.pi])
def test_a_symmetric_start(links: Links, rtol: float, angle: float) -> None:
    """At rest and horizontal only every fourth coefficient of the series is not zero. The energy bounds the speed."""
    options: dict[str, Any] = {"output": 40, "parameters": {"a0": angle}}
    run = links(1).simulate(10.0, method="taylor", rtol=rtol, **options)
    exact = links(1).simulate(10.0, method="dop853", rtol=1e-13, **options)
    assert abs(run["L0.theta"] - exact["L0.theta"]).max() < 100.0 * rtol + 1e-11
    assert abs(run["L0.omega"]).max() < math.sqrt(9.81 / 0.35) * (1.0 + 100.0 * rtol)


@needs_compiler
def test_random_symmetric_starts(links: Links) -> None:
    """Links at rest at multiples of a right angle, and a little beside them: energy is conserved."""
    random = np.random.default_rng(15)
    for rtol in (1e-3, 1e-4, 1e-5, 1e-7, 1e-9, 1e-10, 1e-13):
        for _ in range(4):
            angles = random.integers(-2, 3, 3) * 0.5 * math.pi + random.choice([0.0, 1e-12, 1e-6], 3)
            parameters = {f"a{k}": float(angle) for k, angle in enumerate(angles)}
            run = links(3).simulate(2.0, output=1, method="taylor", rtol=rtol, parameters=parameters)
            assert run.diagnostics.energy_residual < 1e3 * rtol + 1e-12


@needs_compiler
def test_an_equilibrium_stays(links: Links) -> None:
    """A link that hangs at rest: no term of its series counts, and the run stays within the tolerance."""
    run = links(1).simulate(100.0, output=4, method="taylor", parameters={"a0": -0.5 * math.pi})
    assert abs(run["L0.theta"] + 0.5 * math.pi).max() < 1e-8


@needs_compiler
def test_symmetric_starts_in_lanes(links: Links, at_once: Seen) -> None:
    """A step that its defect refuses is made once more there as well, with the same bits."""
    for rtol in (1e-2, 1e-4, 1e-9):
        assert_same_in_lanes(links(1), {"bodies.L0.mass": np.linspace(0.8, 1.2, COUNT)}, 1.5, at_once, rtol=rtol)


PULSE = """\
format: gudgeon/1
name: struck
parameters: {kick: 0.5 N*m*s, width: 5 ms, middle: 3.3 s}
ground: {O: [0, 0]}
bodies:
  L0: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2, com: [0, 0]}
joints:
  J0: {revolute: [ground.O, L0.origin]}
forces:
  strike: {torque: L0, value: kick / (width * sqrt(pi)) * exp(-((t - middle) / width)**2)}
start: {set: {L0.theta: 0}, rates: {L0.omega: 0}}
"""


@pytest.mark.parametrize("method", ["taylor", "auto", "dop853"])
def test_a_pulse_within_a_long_rest_is_not_missed(method: str, tmp_path: Path) -> None:
    """The series at rest is zero; the impulse of the torque is `kick`, so that omega is kick / inertia after it."""
    file = tmp_path / "struck.yaml"
    file.write_text(PULSE, encoding="utf-8")
    run = gudgeon.load(file).simulate(10.0, output=10, method=method, rtol=1e-9)
    assert run["L0.omega"][-1] == pytest.approx(5.0, rel=1e-8)
    assert run["L0.theta"][-1] == pytest.approx(5.0 * (10.0 - 3.3), rel=1e-8)


WELL = """\
format: gudgeon/1
name: well
bodies: {p: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
forces:
  spring: {force: p.com, value: ["-100 N/m*p.x", 0]}
  hidden: {force: p.com, value: ["VALUE", 0]}
start: {set: {p.x: 0, p.y: 0}, rates: {p.vx: 10 m/s, p.vy: 1 m/s}}
"""
WELL_AT = "0.6 m"  # where the hidden force acts: far from the start, within a first step of the series
HIDDEN: dict[str, tuple[str, Callable[[float], float]]] = {  # a force that vanishes in rounding at the start; potential
    "exp": (
        f"4 kN/m*(p.x - {WELL_AT})*exp(-((p.x - {WELL_AT})/(5 mm))**2)",
        lambda x: 0.05 * math.exp(-(((x - 0.6) / 5e-3) ** 2)),
    ),
    "tanh": (
        f"-30 N*(1 + tanh((p.x - {WELL_AT})/(4 mm)))",
        lambda x: 30.0 * (x + 4e-3 * math.log(math.cosh((x - 0.6) / 4e-3))),
    ),
    "a high power": (f"-30 N*(p.x/({WELL_AT}))**81", lambda x: 30.0 * 0.6 / 82.0 * (x / 0.6) ** 82),
}


@pytest.mark.parametrize("name", HIDDEN)
def test_forces_that_a_series_does_not_show_from_afar(name: str, tmp_path: Path) -> None:
    """`auto` keeps the energy of the closed form; `taylor` names the function."""
    value, potential = HIDDEN[name]
    file = tmp_path / "well.yaml"
    file.write_text(WELL.replace("VALUE", value), encoding="utf-8")
    simulation = gudgeon.load(file)
    run = simulation.simulate(2.0, output=400, rtol=1e-10)
    x, v = run["p.x"], run["p.vx"]
    energy = 0.5 * v**2 + 50.0 * x**2 + np.array([potential(one) for one in x.tolist()])
    assert "taylor" not in run.diagnostics.method
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)
    with pytest.raises(BadValueError, match=f"{name} of coordinates or velocities"):
        simulation.simulate(0.1, method="taylor")


def test_functions_of_time_and_algebraic_ones_of_coordinates_have_series(tmp_path: Path) -> None:
    file = tmp_path / "well.yaml"
    value = "1 N*exp(-t/(1 s)) + 1 N*tanh(t/(1 s)) - 1 N*atan(p.x/(1 m)) - 1 N*(p.x/(1 m))**3"
    file.write_text(WELL.replace("VALUE", value), encoding="utf-8")
    simulation = gudgeon.load(file)
    series, other = (simulation.simulate(1.0, output=4, method=method, rtol=1e-12) for method in ("taylor", "dop853"))
    np.testing.assert_allclose(series.q, other.q, atol=1e-10)
