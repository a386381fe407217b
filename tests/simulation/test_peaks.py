"""Peaks of series over all steps: closed forms, method against method, dense output, whatever the output is."""

from __future__ import annotations

import importlib.util
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import gudgeon
from gudgeon.errors import BadValueError, SolverError, UnknownNameError
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.pump import TEXT

pytestmark = needs_compiler
METHODS: dict[str, dict[str, Any]] = {
    "auto": {},
    "dop853": {"method": "dop853"},
    "rodas5p": {"method": "rodas5p"},
    "rk4": {"step": 3e-4},
    "scipy": {"method": "scipy:DOP853"},
}
VALID = Path(__file__).resolve().parents[1] / "mechanisms" / "valid"

# A driven cart whose acceleration grows as 6 b t until it drops to nothing at t1, and a load on a spring behind it.
CART = """\
format: gudgeon/1
name: cart
parameters: {b: 2 m/s^3, t1: 0.3 s, k: 100 N/m}
bodies:
  cart: {mass: 2 kg, inertia: 1 kg*m^2}
  load: {mass: 1 kg, inertia: 1 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  other: {translational: [ground.O, load.origin], axis: [1, 0]}
drives:
  motor: {coordinate: cart.x, value: b*min(t, t1)**3 + 3*b*t1**2*max(t - t1, 0 s)}
forces:
  spring: {spring_damper: [cart.origin, load.origin], stiffness: k, free_length: 1 m}
start: {set: {load.x: 1.05 m}}
scenes:
  ideal: {peaks: [cart.ax, motor.force]}
  stopped: {peaks: "load.vx, push", events: {fast: {zero: load.vx - 0.2 m/s, action: stop, direction: rising}}}
  both: {extends: stopped, peaks: [load.x]}
outputs: {push: k*(load.x - cart.x - 1 m)}
"""


@pytest.fixture(scope="module")
def pendulum() -> Simulation:
    return gudgeon.load("pendulum")


@pytest.fixture(scope="module")
def cart(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Simulation]:
    file = tmp_path_factory.mktemp("cart") / "cart.yaml"
    file.write_text(CART)
    return {scene: gudgeon.load(file, scene) for scene in ("ideal", "both")}


@pytest.fixture(scope="module")
def pump(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Simulation]:
    file = tmp_path_factory.mktemp("pump") / "pump.yaml"
    file.write_text(TEXT)
    return {scene: gudgeon.load(file, scene) for scene in ("ideal", "worn")}


@pytest.mark.parametrize("formulation", ["reduced", "full"])
@pytest.mark.parametrize("method", METHODS)
def test_a_pendulum_from_the_horizontal(pendulum: Simulation, method: str, formulation: str) -> None:
    """At its lowest place the rod holds 3 m g, the bob has v² = 2 g l (energy); no output is near."""
    if method == "scipy" and (formulation == "full" or not importlib.util.find_spec("scipy")):
        pytest.skip("the same as with the reduced one")
    simulation = pendulum if formulation == "reduced" else pendulum.full
    run = simulation.simulate(1.0, output=3, peaks=["rod.F", "bob.vx", "bob.y", "swing"], **METHODS[method])
    force, speed, lowest = run.peak("rod.F"), run.peak("bob.vx"), run.peak("bob.y")
    assert force.max == pytest.approx(3.0 * 9.81, rel=2e-8)
    assert force.t_max == pytest.approx(2.367841947576 / 4.0, abs=1e-5)
    assert (speed.abs, speed.t_abs) == (-speed.min, speed.t_min)
    assert speed.abs == pytest.approx(math.sqrt(2.0 * 9.81), rel=2e-8)
    assert lowest.min == pytest.approx(-1.0, abs=1e-9)
    assert force.unit == "N" and run.peak("swing").max == pytest.approx(math.pi / 2.0, abs=1e-9)
    assert run["rod.F"].max() < 0.99 * force.max  # samples do not know it


def test_no_freedom_is_left() -> None:
    """A slider-crank: x = r cos φ + √(l² − r² sin² φ), its largest acceleration sought on the closed form."""
    crank = gudgeon.load("slider_crank")
    r, length, omega = 0.05, 0.12, 2.0 * math.pi * 10.0

    def ax(t: float) -> float:
        c, s = math.cos(omega * t), math.sin(omega * t)
        root = math.sqrt(length**2 - r**2 * s**2)
        return omega**2 * (-r * c - r**2 * (c * c - s * s) / root - (r**2 * s * c) ** 2 / root**3)

    top = minimize_scalar(lambda t: -ax(t), bounds=(0.02, 0.048), method="bounded", options={"xatol": 1e-9})
    run = crank.simulate(0.3, output=[0.0, 0.3], peaks=["slider.ax", "slider.x", "energy.residual"])
    peak = run.peak("slider.ax")
    assert (peak.max, peak.min) == pytest.approx((-top.fun, ax(0.0)), rel=1e-12)
    turns = (peak.t_max * 10.0) % 1.0
    assert min(abs(turns - 10.0 * top.x), abs(turns - (1.0 - 10.0 * top.x))) < 1e-5
    assert run.peak("slider.x").max == pytest.approx(0.17, abs=1e-15)
    assert run.peak("energy.residual").abs < 1e-7
    other = crank.simulate(0.3, output=777, peaks=["slider.ax"]).peak("slider.ax")
    assert (other.max, other.min) == pytest.approx((peak.max, peak.min), rel=1e-13)


@pytest.mark.parametrize("method", ["auto", "rodas5p", "rk4"])
def test_both_sides_of_a_jump(cart: dict[str, Simulation], method: str) -> None:
    """The cart's acceleration is 6 b t1 right before it drops, which no state behind it shows. The load follows the
    cubic of the cart on its spring, ẍ = ω² (x_c − x + 1 m), from rest; later it oscillates about the cart."""
    runs = [cart["ideal"].simulate(1.0, output=out, **METHODS[method]) for out in (1, 400)]
    for run in runs:
        assert run.peak("cart.ax").max == pytest.approx(6.0 * 2.0 * 0.3, rel=2e-8)
        assert run.peak("cart.ax").t_max == pytest.approx(0.3, rel=2e-8)
        assert run.peak("cart.ax").min == pytest.approx(0.0, abs=2e-9)  # a sample may be the least
    assert runs[0].diagnostics.extremes == runs[1].diagnostics.extremes
    w, b, t1 = 10.0, 2.0, 0.3  # with u = x − 1 m, until t1: u = b t³ − 6 b t/ω² + 6 b sin(ωt)/ω³ + 0.05 cos(ωt)
    apart = -6.0 * b * t1 / w**2 + 6.0 * b * math.sin(w * t1) / w**3 + 0.05 * math.cos(w * t1)
    rate = -6.0 * b / w**2 + 6.0 * b * math.cos(w * t1) / w**2 - 0.05 * w * math.sin(w * t1)
    largest = cart["ideal"].simulate(2.0, output=1, peaks=["push"], **METHODS[method]).peak("push")
    assert largest.abs == pytest.approx(100.0 * math.hypot(apart, rate / w), rel=2e-8)


def test_a_jump_where_no_freedom_is_left(tmp_path: Path) -> None:
    """Nothing ends a step there: the place is closed in upon."""
    lines = [line for line in CART.splitlines() if not any(word in line for word in ("load", "both", "spring"))]
    (tmp_path / "cart.yaml").write_text("\n".join(lines).replace("forces:", "") + "\n")
    run = gudgeon.load(tmp_path / "cart.yaml").simulate(1.0, output=2)
    assert run.diagnostics.method == "kinematic"
    assert run.peak("cart.ax").max == pytest.approx(3.6, rel=1e-8)
    assert run.peak("cart.ax").t_max == pytest.approx(0.3, rel=1e-8)
    assert run.peak("motor.force").max == pytest.approx(7.2, rel=1e-8)


def test_friction_that_tears_loose() -> None:
    """Right before a block of 1 kg tears loose it is held by Fs, right behind by Fk; then it swings about Fk/k."""
    block = gudgeon.load("belt_block")
    every: list[dict[str, Any]] = [{"rtol": 1e-10}, {"step": 1e-3}]
    for selected in every:
        run = block.simulate(0.8, output=7, peaks=["block.ax", "rub.F"], **selected)
        assert run.peak("rub.F").max == pytest.approx(5.886, rel=1e-9)
        assert run.peak("block.ax").min == pytest.approx(-math.hypot(5.886 - 3.924, 0.1 * 10.0), rel=1e-9)
        assert run.peak("block.ax").max == pytest.approx(3.924, rel=1e-12)


def test_an_event_that_stops_and_what_goes_on(cart: dict[str, Simulation]) -> None:
    """The scene's own list, `extends` followed; what lies beyond an end does not count, nor what lay before a start."""
    assert cart["both"].source.peaks == ("load.vx", "push", "load.x")
    run = cart["both"].simulate(2.0, output=3)
    assert run.t[-1] < 0.5 and run.peak("load.vx").max == pytest.approx(0.2, rel=1e-9)
    assert run.peak("load.vx").t_max == pytest.approx(run.t[-1], abs=1e-9)
    assert run.peak("push").max == pytest.approx(5.0, rel=1e-12) and run.peak("push").t_max == 0.0
    later = cart["both"].simulate(0.33, start=run.final, stop=False)
    assert (later.peak("push").max, later.peak("push").t_max) == (run["push"][-1], run.t[-1])


def test_contacts_against_dense_output(pump: dict[str, Simulation]) -> None:
    """And the joint's force against what C finds in its own loop; errors against the ideal scene at the same times."""
    names = ["B.F", "piston.ax", "rod.omega", "piston.x", "energy.residual"]
    run = pump["worn"].simulate(0.02, output=5, peaks=names, against=pump["ideal"])
    dense = pump["worn"].simulate(0.02, output=100_000, peaks=())
    ideal = pump["ideal"].simulate(output=dense.t)
    assert run.peak("B.F").max == pytest.approx(run.diagnostics.peak("B").F, rel=1e-6)
    for name in names[:4]:
        size = np.ptp(dense[name])
        for found, values in ((run.peak(name), dense[name]), (run.peak_error(name), dense[name] - ideal[name])):
            assert 0.0 <= found.max - values.max() + 1e-7 * size < 2e-3 * size
            assert 0.0 <= values.min() - found.min + 1e-7 * size < 2e-3 * size
            assert found.max == pytest.approx(np.interp(found.t_max, dense.t, values), abs=2e-3 * size)
    assert run.peak_error("B.F").against == "ideal" and run.peak("B.F").against == ""
    assert run.peak("energy.residual").abs < 1e-6 * run.diagnostics.energy_turned_over
    fixed = pump["worn"].simulate(0.02, output=5, peaks=names, against=pump["ideal"], step=1e-6)
    assert fixed.peak("B.F").max == pytest.approx(run.peak("B.F").max, rel=1e-3)
    assert fixed.peak_error("piston.x").max == pytest.approx(run.peak_error("piston.x").max, rel=1e-3)


def test_an_ideal_scene_that_is_integrated() -> None:
    """A driven crank with a free pendulum on it, worn and not: the other one is followed from block to block."""
    worn, ideal = (gudgeon.load(VALID / "double_pendulum.yaml", scene) for scene in ("dry", "ideal"))
    run = worn.simulate(0.05, output=2, peaks=["L2.theta", "L2.head.y", "work.drives"], against=ideal)
    dense = worn.simulate(0.05, output=20_000)
    other = ideal.simulate(output=dense.t)
    for name in ("L2.theta", "L2.head.y", "work.drives"):
        error, size = dense[name] - other[name], np.ptp(dense[name] - other[name])
        found = run.peak_error(name)
        assert (found.max, found.min) == pytest.approx((error.max(), error.min()), abs=1e-3 * size + 1e-9)


def test_batches(pump: dict[str, Simulation], tmp_path: Path) -> None:
    """Each run as it is alone; as columns, and from a file again."""
    names, many = ["piston.ax", "B.F"], {"c": [1e-4, 2e-4, -1.0]}
    for more in ({}, {"step": 2e-6}):
        selected: dict[str, Any] = {"output": 3, "peaks": names, "against": pump["ideal"]} | more
        batch = pump["worn"].simulate_many(many, 0.005, **selected)
        alone = [pump["worn"].simulate(0.005, parameters={"c": c}, **selected) for c in (1e-4, 2e-4)]
        assert [batch[i].diagnostics.extremes for i in (0, 1)] == [run.diagnostics.extremes for run in alone]
        assert batch.peak("piston.ax").abs[:2].tolist() == [run.peak("piston.ax").abs for run in alone]
        assert batch.peak_error("piston.ax").t_min[:2].tolist() == [run.peak_error("piston.ax").t_min for run in alone]
        assert np.isnan(batch.peak("B.F").max[2]) and [f.run for f in batch.failures] == [2]
    assert pickle.loads(pickle.dumps(batch))[1].peak("B.F") == alone[1].peak("B.F")
    pytest.importorskip("h5py")
    pytest.importorskip("xarray")
    batch.save(tmp_path / "batch.nc")
    loaded = Batch.load(tmp_path / "batch.nc")
    assert loaded.extremes == batch.extremes and loaded.peak("B.F").unit == "N"
    columns = batch.to_xarray()
    assert columns["B.F.peak.max"].values[:2].tolist() == [run.peak("B.F").max for run in alone]
    assert columns["piston.ax.error.t_max"].attrs["units"] == "s"


def test_a_batch_without_a_freedom(pump: dict[str, Simulation]) -> None:
    batch = pump["ideal"].simulate_many({"omega": [10.0, 20.0]}, t_end="2*pi/(10 rad/s)", output=2, peaks=["piston.ax"])
    low, high = batch.peak("piston.ax").max
    assert high == pytest.approx(4.0 * low, rel=1e-9)  # accelerations go with ω²


def test_files(pump: dict[str, Simulation], tmp_path: Path) -> None:
    """They hold peaks, bit for bit and as a table for people; a run without any has none of it."""
    pytest.importorskip("h5py")
    pytest.importorskip("xarray")
    run = pump["worn"].simulate(0.002, output=3, peaks=["piston.ax"], against=pump["ideal"])
    run.save(tmp_path / "run.nc")
    loaded = Result.load(tmp_path / "run.nc")
    assert loaded.diagnostics.extremes == run.diagnostics.extremes != ()
    assert loaded.peak_error("piston.ax") == run.peak_error("piston.ax")
    table = loaded.to_xarray("peaks")
    assert table["max"].values.tolist() == [run.peak("piston.ax").max, run.peak_error("piston.ax").max]
    assert table["against"].values.tolist() == ["", "ideal"]
    plain = pump["worn"].simulate(0.002, output=3)
    assert "extremes" not in plain.diagnostics.to_json() and not plain.to_xarray("peaks").sizes.get("row", 0)


@pytest.mark.parametrize("selected", [{}, {"step": 2e-6}, {"method": "rodas5p"}], ids=["auto", "rk4", "rodas5p"])
def test_who_looks_changes_nothing(pump: dict[str, Simulation], selected: dict[str, Any]) -> None:
    seen, unseen = (pump["worn"].simulate(0.01, output=50, peaks=peaks, **selected) for peaks in (["piston.ax"], None))
    for name in ("q", "v", "work", "memory", "state", "impacts"):
        assert getattr(seen, name).tobytes() == getattr(unseen, name).tobytes(), name
    assert seen.diagnostics.peaks == unseen.diagnostics.peaks and seen.diagnostics.steps == unseen.diagnostics.steps


@pytest.mark.filterwarnings("ignore:slider.x begins")
def test_a_run_that_comes_to_no_end() -> None:
    """A crank that is longer than its rod cannot turn on: what was reached has its peaks."""
    crank = gudgeon.load("slider_crank")
    with pytest.raises(SolverError) as stopped:
        crank.simulate(0.1, output=10, parameters={"bodies.rod.length": 0.045}, peaks=["rod.theta", "crank.theta"])
    run = stopped.value.partial
    assert run.peak("crank.theta").max == pytest.approx(math.asin(0.9), abs=0.01)
    assert run.peak("crank.theta").t_max >= run.t[-1] - 1e-12


def test_what_was_not_asked_for(pendulum: Simulation) -> None:
    run = pendulum.simulate(0.1, output=2, peaks=["rod.F"])
    with pytest.raises(BadValueError, match=r"the peak of bob.y over all steps was not requested"):
        run.peak("bob.y")
    with pytest.raises(BadValueError, match=r"the error of rod.F over all steps is not known"):
        run.peak_error("rod.F")
    with pytest.raises(UnknownNameError, match=r"nothing named 'rod.G'"):
        run.peak("rod.G")
    with pytest.raises(UnknownNameError, match=r"nearest: rod.F"):
        pendulum.simulate(0.1, peaks=["rod.Fz"])
    with pytest.raises(BadValueError, match=r"against is a scene of slider_crank"):
        pendulum.simulate(0.1, peaks=["rod.F"], against=gudgeon.load("slider_crank"))


def test_a_long_run_in_blocks(pendulum: Simulation) -> None:
    """More states than a block of them has room for: each block knows the end of the one before."""
    runs = [pendulum.simulate(2.4, output=2, step=step, peaks=["bob.vx"]) for step in (1e-3, 1e-4)]
    short, long = (run.peak("bob.vx") for run in runs)
    assert (short.max, short.min) == pytest.approx((long.max, long.min), rel=1e-10)
    assert long.abs == pytest.approx(math.sqrt(2.0 * 9.81), rel=1e-10)


def test_a_parameter_is_no_series_and_a_time_is_a_float(cart: dict[str, Simulation], tmp_path: Path) -> None:
    """Suggestions were parameters, the name itself among them; t_min a number of NumPy's."""
    path = tmp_path / "cart.yaml"
    wrong = {"k": "'k' is a parameter, not a series", "puhs": "unknown series 'puhs'\n  did you mean 'push'"}
    for name, message in wrong.items():
        path.write_text(CART.replace("[cart.ax, motor.force]", f"[{name}]"), encoding="utf-8")
        with pytest.raises(UnknownNameError) as error:
            gudgeon.load(path, "ideal")
        assert message in str(error.value)
    found = cart["ideal"].simulate(0.1).diagnostics.extremes[0]
    assert {type(x) for x in (found.max, found.t_max, found.min, found.t_min)} == {float}
