"""A prepared run returns, bit for bit, the series of `simulate` and of `simulate_many`, and raises the same errors."""

from __future__ import annotations

import os
import pickle
import re
import signal
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import ArrayError, BadValueError, GudgeonError, InputError, UnknownNameError
from gudgeon.integrators.adaptive import compute_tolerances
from gudgeon.integrators.reusable_run import ReusableRun
from gudgeon.model.parameters import has_valid_values, read_given_parameters
from gudgeon.model.sizes import compute_mechanism_sizes
from gudgeon.results.results import Result
from gudgeon.results.series import get_catalogue
from gudgeon.simulation.prepared_run import PreparedRun
from gudgeon.simulation.simulation import Simulation
from tests.audit_mutants import mutant
from tests.programs import needs_compiler

pytestmark = needs_compiler
SWING = """\
format: gudgeon/1
name: stopping_swing
gravity: [0, -g]
parameters: {g: 9.81 m/s^2, l: 1 m}
bodies: {bob: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
freedoms: 2
joints: {rod: {distance: [ground.O, bob.origin], length: l}}
start: {set: {bob.x: l, bob.theta: 0}, rates: {bob.omega: 0}}
scenes: {ideal: {simulate: {t_end: 0.5*sqrt(l/g), output: 20}}}
events: {low: {zero: bob.x - 0.2 m, action: stop}}
outputs: {swing: atan2(bob.x, -bob.y)}
"""
# mechanism, scene, parameters, series, arguments
CASES: list[tuple[str, str, tuple[str, ...], tuple[str, ...], dict[str, Any]]] = [
    ("nine_bar_press", "dry", ("c", "bodies.S9.mass"), ("S9.ay", "A.F", "A.state", "energy.residual", "t"), {}),
    ("nine_bar_press", "lubricated", ("c",), ("S9.y", "A.e", "lift"), {"t_end": 0.002, "rtol": 1e-6}),
    ("slider_crank", "dry", ("omega",), ("slider.x", "wristpin.F"), {"method": "rk4", "step": 2e-5}),
    ("andrews_squeezer", "ideal", ("bodies.OF.mass",), ("OF.theta", "OF.alpha", "work.drives"), {"t_end": 0.005}),
    ("andrews_squeezer", "ideal", ("bodies.OF.mass",), ("OF.x",), {"output": [0.001, 0.004], "method": "radau5"}),
    ("pendulum", "ideal", ("g", "length"), ("bob.x", "swing"), {"t_end": 0.3}),
    ("bouncing_ball", "damped", ("gravity",), ("ball.y", "fall.F"), {"t_end": 0.6}),
    ("belt_block", "ideal", ("bodies.block.mass",), ("block.x", "block.vx"), {"t_end": 0.6}),
    ("bouncing_ball", "elastic", ("bodies.ball.mass",), ("ball.y",), {"t_end": 300.0}),  # more contacts than a list has
    ("slider_crank", "ideal", ("omega",), ("slider.x", "slider.ax"), {}),
    ("four_bar", "ideal", (), (), {"t_end": 0.1}),
]
SCALES = 1.0 + 0.01 * np.random.default_rng(5).uniform(-1.0, 1.0, 6)


@cache
def load(mechanism: str, scene: str) -> Simulation:
    return gudgeon.load(mechanism, scene)


def fitting(sim: Simulation, names: tuple[str, ...]) -> tuple[tuple[str, ...], np.ndarray[Any, Any]]:
    """Those of the names that the scene has, else its first number that is not zero; and the file's values."""
    defaults = {slot.address: slot.default for slot in sim.source.parameters if not slot.words}
    known = tuple(x for x in names if x in defaults or f"parameters.{x}" in defaults)
    known = known or tuple([next(name for name in defaults if defaults[name] != 0.0)][: len(names)])
    return known, np.array([defaults.get(x, defaults.get(f"parameters.{x}", 0.0)) for x in known])


def rows(result: Result, series: tuple[str, ...], n: int) -> np.ndarray[Any, Any]:
    values = np.full((len(series), n), np.nan)
    for row, name in zip(values, series, strict=True):
        row[: len(result[name])] = result[name]
    return values


@pytest.mark.parametrize(("mechanism", "scene", "names", "series", "options"), CASES)
def test_the_same_bits(mechanism: str, scene: str, names: Any, series: Any, options: dict[str, Any]) -> None:
    """Of single runs in any order, and of many, which may be in vector lanes."""
    sim = load(mechanism, scene)
    names, base = fitting(sim, names)
    arguments = {"t_end": 0.01, "output": 12} | options
    arguments |= {"t_end": None} if isinstance(arguments["output"], list) else {}
    prepared = sim.prepare(names, series, **arguments)
    values = base * SCALES[:, None]
    n = len(prepared.t)
    expected = []
    for x in values[[0, 1, 1, 0, 2, 3, 4, 5, 5]]:
        run = sim.simulate(parameters=dict(zip(names, x.tolist(), strict=True)), **arguments, peaks=())
        expected.append(rows(run, series, n))
        assert prepared(x).tobytes() == expected[-1].tobytes()
    assert prepared(base).shape == (len(series), n)
    many = prepared(values)
    batch = sim.simulate_many(
        [dict(zip(names, x.tolist(), strict=True)) for x in values], **arguments, keep=[x for x in series if x != "t"]
    )
    for j, name in enumerate(series):
        assert many[:, j].tobytes() == batch[name].tobytes() and not prepared.failures
        assert not name.endswith(".F") or many[:, j].max() > 0.0  # there are contacts
    assert many.shape == (len(values), len(series), n)


def test_most_scenes_are_run_in_reused_memory() -> None:
    """Those of CASES that the fast path shall take."""
    for mechanism, scene, names, series, options in CASES[:9]:
        sim = load(mechanism, scene)
        prepared = sim.prepare(
            fitting(sim, names)[0],
            series,
            **{"t_end": 0.01, "output": 12}
            | options
            | ({"t_end": None} if isinstance(options.get("output"), list) else {}),
        )
        assert isinstance(prepared._run, ReusableRun), mechanism


@pytest.fixture
def swing(tmp_path: Path) -> Simulation:
    (tmp_path / "swing.yaml").write_text(SWING)
    return gudgeon.load(tmp_path / "swing.yaml", "ideal")


def test_runs_that_an_event_ends_are_filled_with_nan(swing: Simulation) -> None:
    prepared = swing.prepare(["g", "l"], ["bob.x", "swing", "bob.ax", "t"], 1.0, output=50)
    for x in ((9.81, 1.0), (3.7, 1.0), (1.62, 1.0), (9.81, 0.5)):
        run = swing.simulate(1.0, output=50, parameters={"g": x[0], "l": x[1]})
        values = prepared(x)
        assert values.tobytes() == rows(run, prepared.series, 51).tobytes()
        assert np.isnan(values[:, -1]).all() == (run.t[-1] < 1.0)
    assert not np.isnan(swing.prepare("g", "bob.x", 1.0, output=50, stop=False)([9.81])).any()
    late = swing.prepare("g", "bob.x", output=[0.9, 1.0])
    assert late([9.81]).tobytes() == rows(swing.simulate(output=[0.9, 1.0]), ("bob.x",), 2).tobytes()


def test_times_that_depend_on_parameters(swing: Simulation) -> None:
    """Of the file, and of the argument."""
    for t_end in (None, "0.6*sqrt(l/g)"):
        prepared = swing.prepare(["g", "l"], "bob.x", t_end)
        for x in ((9.81, 1.0), (1.62, 2.0), (9.81, 1.5)):
            run = swing.simulate(t_end, parameters={"g": x[0], "l": x[1]})
            assert prepared(x).tobytes() == run["bob.x"].tobytes()
            np.testing.assert_array_equal(prepared.t, run.t)
        assert prepared([[9.81, 1.0], [1.62, 2.0]])[0].tobytes() == prepared([9.81, 1.0]).tobytes()


def failure(call: Callable[[], Any]) -> tuple[type, str]:
    with pytest.raises((GudgeonError, MemoryError)) as caught:
        call()
    return caught.type, str(caught.value)


@pytest.mark.parametrize("c", [-1e-4, 0.02, 1e-20, np.nan, np.inf, 1e-320])
def test_values_are_checked_as_simulate_checks_them(c: float) -> None:
    """And a refused value changes nothing of later runs, whose start is copied from the last run."""
    press = load("nine_bar_press", "dry")
    prepared = press.prepare("c", ["S9.y", "A.F"], 0.01, output=5)
    good = prepared([3e-4])
    expected = failure(lambda: press.simulate(0.01, output=5, parameters={"c": c}))
    assert failure(lambda: prepared([c])) == expected
    assert prepared([3e-4]).tobytes() == good.tobytes()
    many = prepared([[3e-4], [c], [4e-4]])
    assert list(prepared.failures) == [1] and np.isnan(many[1]).all() and not np.isnan(many[[0, 2]]).any()
    assert many[0].tobytes() == good.tobytes()
    assert np.isnan(prepared([[c], [c]])).all() and list(prepared.failures) == [0, 1]


def test_starts_follow_their_parameters() -> None:
    """A start is copied from the last run only if it was computed from equal numbers."""
    sim = load("pendulum", "ideal")
    prepared = sim.prepare(["length", "g"], ["bob.x", "bob.y"], 0.1, output=3)
    for x in ((1.0, 9.81), (2.0, 9.81), (-1.0, 9.81), (2.0, 5.0), (1.0, 5.0), (1.0, 9.81)):
        try:
            expected = rows(
                sim.simulate(0.1, output=3, parameters={"length": x[0], "g": x[1]}), prepared.series, 4
            ).tobytes()
        except InputError:
            with pytest.raises(InputError):
                prepared(x)
        else:
            assert prepared(x).tobytes() == expected


@pytest.mark.filterwarnings("ignore:bob.P begins")
def test_starts_with_guessed_points_follow_all_parameters(tmp_path: Path) -> None:
    """The place of the guessed point on its body is in no equation of the closed linkage."""
    text = SWING.replace("inertia: 1 kg*m^2}", "inertia: 1 kg*m^2, points: {P: [px, 0]}}").replace(
        "l: 1 m}", "l: 1 m, px: 0.1 m}"
    )
    guess = "start: {set: {bob.theta: 0}, guess: {bob.P: [0.5 m, -0.5 m]}, rates: {bob.omega: 0}}"
    file = tmp_path / "guessed.yaml"
    file.write_text(re.sub("start: .*", guess, text))
    sim = gudgeon.load(file, "ideal")
    prepared = sim.prepare(["px", "g"], ["bob.x", "bob.y"], 0.1, output=3)
    assert prepared._run
    for x in ((0.1, 9.81), (0.3, 9.81), (0.3, 1.62), (-0.4, 9.81), (0.1, 9.81), (0.1, 1.62), (0.3, 1.62)):
        run = sim.simulate(0.1, output=3, parameters={"px": x[0], "g": x[1]})
        assert prepared(x).tobytes() == rows(run, prepared.series, 4).tobytes()


def test_a_failed_run_raises_its_error_and_the_next_one_is_right() -> None:
    """Step size underflow, contact laws left, an audit: C's status becomes the error of `simulate`."""
    press = load("nine_bar_press", "dry")
    arguments: dict[str, Any] = {"t_end": 0.05, "output": 10, "method": "rk4", "step": 5e-4}
    prepared = press.prepare("c", "S9.y", **arguments)
    kind, text = failure(lambda: press.simulate(parameters={"c": 8e-4}, **arguments))
    assert failure(lambda: prepared([8e-4])) == (kind, text)
    many = prepared([[8e-4], [8e-4]])
    assert [type(error) for error in prepared.failures.values()] == [kind, kind] and np.isnan(many).all()


def test_a_failed_audit_is_an_error(tmp_path: Path) -> None:
    """A method with a wrong coefficient: the C of a prepared run audits its steps as that of `simulate`."""
    edit = ("engine/scalar_simd/dop853.h", "step->k[0][i] = run->dy[i];", "step->k[0][i] = 0.9 * run->dy[i];")
    wrong = mutant(load("pendulum", "ideal"), tmp_path, edit)
    arguments: dict[str, Any] = {"t_end": 1e-3, "output": 500, "method": "dop853"}
    prepared = wrong.prepare("g", "bob.x", **arguments)
    expected = failure(lambda: wrong.simulate(parameters={"g": 9.81}, **arguments))
    assert expected[0] is gudgeon.AuditError and failure(lambda: prepared([9.81])) == expected
    wrong.prepare("g", "bob.x", **arguments, audit=False)([9.81])


def test_peaks_over_all_steps() -> None:
    crank = load("slider_crank", "dry")
    prepared = crank.prepare("c", "slider.x", 0.01, output=20, peaks=["slider.ax"])
    run = crank.simulate(0.01, output=20, parameters={"c": 2e-4}, peaks=["slider.ax"])
    peak = run.peak("slider.ax")
    assert prepared([2e-4])[0].tobytes() == run["slider.x"].tobytes()
    np.testing.assert_array_equal(prepared.extremes, [[peak.min, peak.max]])
    prepared([[2e-4], [3e-4]])
    np.testing.assert_array_equal(prepared.extremes[0], [[peak.min, peak.max]])


def test_arguments() -> None:
    press = load("nine_bar_press", "dry")
    for names, fixed, error in (
        (["nothing"], {}, UnknownNameError),
        (["c", "c"], {}, BadValueError),
        (["c", "parameters.c"], {}, BadValueError),
        (["c"], {"c": 1e-4}, BadValueError),
        (["c"], {"omega": "1 m"}, InputError),
    ):
        with pytest.raises(error):
            press.prepare(names, "S9.y", 0.01, fixed=fixed)
    with pytest.raises(UnknownNameError):
        press.prepare("c", "S9.z", 0.01)
    with pytest.raises(BadValueError, match="threads"):
        press.prepare("c", "S9.y", 0.01, threads=0)
    prepared = press.prepare("c", "S9.y", 0.01, output=4, fixed={"omega": "3*pi rad/s"})
    for values in ([3e-4, 1.0], 3e-4, [[[3e-4]]], ["x"]):
        with pytest.raises(ArrayError):
            prepared(values)
    run = press.simulate(0.01, output=4, parameters={"c": 3e-4, "omega": "3*pi rad/s"})
    assert prepared([3e-4])[0].tobytes() == run["S9.y"].tobytes()
    assert "1 parameters" in repr(prepared) and prepared(np.zeros((0, 1))).shape == (0, 1, 5)


@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 1e-3}])
def test_gains_of_the_full_formulation(options: dict[str, Any]) -> None:
    """Methods that project run without them, fixed or varied; rk4 uses them."""
    swing = gudgeon.load("pendulum", formulation="full")
    results = []
    for gain in (5.0, 50.0):
        run = swing.simulate(1.0, output=3, parameters={"gains": gain, "g": 9.0}, **options)
        fixed = swing.prepare("g", "bob.x", 1.0, output=3, fixed={"gains": gain}, **options)
        varied = swing.prepare(["gains", "g"], "bob.x", 1.0, output=3, **options)
        assert fixed([9.0])[0].tobytes() == varied([gain, 9.0])[0].tobytes() == run["bob.x"].tobytes()
        results.append(run["bob.x"].tobytes())
    assert (results[0] == results[1]) == (not options)


def test_it_can_be_pickled_and_used_in_threads() -> None:
    press = load("nine_bar_press", "dry")
    prepared = press.prepare("c", ["S9.y", "A.F"], 0.01, output=5)
    values = [[2e-4 + 1e-5 * k] for k in range(8)]
    expected = [prepared(x).tobytes() for x in values]
    times = np.array([0.005, 0.01])
    of_times = press.prepare("c", "S9.y", output=times)
    end = of_times([3e-4]).tobytes()
    times[:] = 1.0
    assert of_times([3e-4]).tobytes() == pickle.loads(pickle.dumps(of_times))([3e-4]).tobytes() == end
    copy: PreparedRun = pickle.loads(pickle.dumps(prepared))
    assert [copy(x).tobytes() for x in values] == expected
    with ThreadPoolExecutor(4) as pool:  # one object, which makes one call at a time
        assert [x.tobytes() for x in pool.map(prepared, values)] == expected


def test_results_are_not_changed_by_later_calls() -> None:
    pendulum = load("pendulum", "ideal")
    prepared = pendulum.prepare("g", "bob.x", 0.5, output=5)
    first = prepared([9.81])
    kept = first.copy()
    prepared([1.62])
    np.testing.assert_array_equal(first, kept)


def test_ctrl_c_ends_a_call() -> None:
    """In the main thread; the object can be used again."""
    pendulum = load("pendulum", "ideal")
    prepared, long = (pendulum.prepare("g", "bob.x", t_end, output=5, rtol=1e-12) for t_end in (0.5, 1e6))
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long([9.81])
    timer.join()
    expected = pendulum.simulate(0.5, output=5, rtol=1e-12)["bob.x"]
    assert prepared([9.81])[0].tobytes() == expected.tobytes()


def test_an_optimizer_finds_gravity() -> None:
    """scipy.optimize calls it as any function of an array."""
    optimize = pytest.importorskip("scipy.optimize")
    prepared = load("pendulum", "ideal").prepare("g", "bob.x", 1.0, output=20)
    measured = prepared([9.81])
    found = optimize.least_squares(lambda x: (prepared(x) - measured)[0], [9.0], xtol=1e-12)
    assert abs(found.x[0] - 9.81) < 1e-6


@pytest.mark.parametrize(("mechanism", "scene", "names"), [(x[0], x[1], x[2]) for x in CASES[:7]])
def test_tolerances_are_those_of_simulate(mechanism: str, scene: str, names: tuple[str, ...]) -> None:
    """Bit for bit, for lengths and clearances that change."""
    sim = load(mechanism, scene)
    lengths = [x.address for x in sim.source.parameters if x.dimension == (1, 0, 0) and x.default > 0.0][:12]
    prepared = sim.prepare(lengths, (), 0.01, output=1, rtol=1e-7, fixed={})
    base = np.array([default for default in (fitting(sim, (name,))[1][0] for name in lengths)])
    run = prepared._run
    assert run and lengths
    for scale in (1.0, 1.001, 0.99):
        assert run.set_row(base * scale, 1)
        p = run.columns.p[1]
        expected = compute_tolerances(sim.compiled, p, 1e-7)
        assert run.arrays["scale"][1].tobytes() == expected[0].tobytes()
        assert run.arrays["min_size"][1].tobytes() == expected[1].tobytes()
        assert run.arrays["size"][1] == compute_mechanism_sizes(sim.source, p)


@pytest.mark.parametrize(
    ("mechanism", "scene"), [("nine_bar_press", "dry"), ("slider_crank", "dry"), ("belt_block", "ideal")]
)
def test_valid_values_are_those_of_simulate(mechanism: str, scene: str) -> None:
    """For random values of all numbers, of which some violate limits or relations of the file, or are not normal."""
    sim, rng = load(mechanism, scene), np.random.default_rng(8)
    slots = [slot for slot in sim.source.parameters if not slot.words]
    prepared = sim.prepare([slot.address for slot in slots], (), 0.01, output=1)
    run, base = prepared._run, np.array([slot.default for slot in slots])
    assert run
    values = base * 10.0 ** rng.normal(0.0, 0.05, (400, len(base)))
    values[np.arange(400), rng.integers(len(base), size=400)] *= rng.choice([-1.0, 0.0, 1e-15, 1.0], 400)
    found = []
    for x in values:
        given, is_given = read_given_parameters(
            sim.source, {slot.address: value for slot, value in zip(slots, x.tolist(), strict=True)}
        )
        p = sim.compiled.prepare(given, is_given)
        found.append(run.set_row(x, 1))
        assert found[-1] == has_valid_values(sim.source, p, is_given)
        assert not found[-1] or run.columns.p[1].tobytes() == p.tobytes()
    assert 20 < sum(found) < 380
    for x in (np.nan, np.inf, 1e-310):
        assert not run.set_row(np.where(np.arange(len(base)) == 1, x, base), 1)


MATERIALS = """\
format: gudgeon/1
name: drop
gravity: [0, -9.81 m/s^2]
parameters: {soft: 110 GPa}
materials: {steel: {E: 206 GPa, nu: 0.3}, bronze: {E: soft, nu: 0.34}}
ground: {o: [0, 0]}
bodies: {ball: {mass: 0.1 kg, inertia: 1e-5 kg*m^2}}
joints: {A: {revolute: [ground.o, ball.origin]}}
bearings: {pin: {radius: 10 mm, clearance: 0.3 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {dry: {normal: {law: lankarani_nikravesh, restitution: 0.9}}}
scenes: {dry: {play: {A: {bearing: pin, contact: dry, contour: 16}}, simulate: {t_end: 20 ms, output: 20}}}
"""


def test_chosen_materials_and_contours(tmp_path: Path) -> None:
    """A chosen material follows the run's parameters; a contour that leaves no clearance is refused as by simulate."""
    (tmp_path / "drop.yaml").write_text(MATERIALS)
    sim = gudgeon.load(tmp_path / "drop.yaml", "dry")
    fixed = {"bearings.pin.journal_material": "bronze"}
    depth = next(slot.address for k, slot in enumerate(sim.source.parameters) if k == sim.source.contours[0].first + 3)
    prepared = sim.prepare(["soft", depth], ["A.F", "ball.y"], fixed=fixed)
    assert isinstance(prepared._run, ReusableRun)
    forces = []
    for x in ((110e9, 0.0), (60e9, 0.0), (60e9, -1e-4), (60e9, 1e-5)):
        run = sim.simulate(parameters=fixed | {"soft": x[0], depth: x[1]})
        assert prepared(x).tobytes() == rows(run, prepared.series, 21).tobytes()
        forces.append(run["A.F"].max())
    assert forces[0] > 0.0 and forces[1] > 0.0 and forces[0] != forces[1]
    wrong = (60e9, -3e-4)
    assert failure(lambda: prepared(wrong)) == failure(
        lambda: sim.simulate(parameters=fixed | {"soft": wrong[0], depth: wrong[1]})
    )


def test_all_kinds_of_series_are_those_of_simulate() -> None:
    """Of columns that C reads and of functions in Python, in turns, for runs of either row."""
    sim = load("nine_bar_press", "dry")
    names = list(get_catalogue(sim.source))
    prepared = sim.prepare("c", names, 0.004, output=7)
    for c in (3e-4, 4e-4, 3e-4):
        run = sim.simulate(0.004, output=7, parameters={"c": c}, peaks=())
        assert prepared([c]).tobytes() == rows(run, prepared.series, 8).tobytes()


def test_tables_with_labels_are_read_by_name() -> None:
    """In any order of the labels; other labels are refused with a remedy that works."""
    pandas = pytest.importorskip("pandas", reason="its tables have labels")
    names = ["g", "length"]
    pendulum = gudgeon.load("pendulum")
    prepared, stepper = pendulum.prepare(names, "bob.x", t_end=0.1, output=3), pendulum.stepper(names, "bob.x")
    table = pandas.DataFrame({"length": [1.0, 3.0], "g": [2.0, 9.81]})
    ordered = prepared([[2.0, 1.0], [9.81, 3.0]]).tobytes()
    for values in (table, table[names], table[names].to_numpy(), [row for _, row in table.iterrows()]):
        assert prepared(values).tobytes() == ordered
    assert prepared(pandas.DataFrame(table[names].to_numpy())).tobytes() == ordered  # columns 0 and 1
    assert prepared(table.iloc[0]).tobytes() == prepared([2.0, 1.0]).tobytes()
    assert stepper.reset(table.iloc[0]).tobytes() == stepper.reset([2.0, 1.0]).tobytes()
    for unordered in (table.assign(mass=1.0), table.assign(mass=1.0).iloc[0]):
        with pytest.raises(ArrayError, match="values has the labels .*length.* expected g, length") as caught:
            prepared(unordered)
        remedy = str(caught.value).splitlines()[-1].strip()
        assert remedy == "values[['g', 'length']].to_numpy()"
        assert prepared(eval(remedy, {"values": unordered})).tobytes() in (ordered, prepared([2.0, 1.0]).tobytes())
    renamed = table[names].rename(columns={"g": "gravity"})
    with pytest.raises(ArrayError, match=r"rename the labels, or .*: values\.to_numpy\(\)"):
        prepared(renamed)
    assert prepared(renamed.to_numpy()).tobytes() == ordered
    with pytest.raises(ArrayError, match="inputs has the labels"):
        stepper.reset(renamed.iloc[0])


def test_arrays_of_xarray_are_read_by_name() -> None:
    xarray = pytest.importorskip("xarray", reason="its arrays have labels")
    prepared = gudgeon.load("pendulum").prepare(["g", "length"], "bob.x", t_end=0.1, output=3)
    values = xarray.DataArray([[1.0, 2.0, 7.0]], dims=["run", "name"], coords={"name": ["length", "g", "mass"]})
    expected = prepared([[2.0, 1.0]]).tobytes()
    assert prepared(values[:, :2]).tobytes() == prepared(values[:, [1, 0]].drop_vars("name")).tobytes() == expected
    with pytest.raises(ArrayError, match="has the labels") as caught:
        prepared(values)
    assert prepared(eval(str(caught.value).splitlines()[-1], {"values": values})).tobytes() == expected
