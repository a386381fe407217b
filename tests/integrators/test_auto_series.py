"""`auto` integrates smooth motion of small linkages by Taylor series: which, how exactly, and when it leaves them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.methods import EXPLICIT, STIFF, TAYLOR
from gudgeon.exchange.fmu import _format_header
from gudgeon.generator.kernels.taylor import predict_crossover_tolerance
from gudgeon.integrators.adaptive import RTOL, select_first_method
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.simulation import arguments
from gudgeon.simulation.arguments import find_required_variant
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.description import build_description
from tests.integrators.test_methods import scene_of
from tests.integrators.test_side_by_side import COUNT, Seen, assert_same_batches, both
from tests.integrators.test_taylor import at_once  # noqa: F401
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same

HERE = Path(__file__).parent.parent
DOUBLE = HERE / "mechanisms" / "valid" / "double_pendulum.yaml"
DAMPED = """\
format: gudgeon/1
name: damped
gravity: [0, -9.81]
parameters: {d: 0.1 N*m*s/rad}
ground: {O: [0, 0]}
bodies:
  L0: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}
joints:
  J0: {revolute: [ground.O, L0.tail]}
forces:
  s: {rotational_spring_damper: [ground, L0], stiffness: 20 N*m/rad, damping: d}
start: {set: {L0.theta: 1 rad}, rates: {L0.omega: 0}}
"""
pytestmark = needs_compiler


@pytest.fixture(scope="module")
def damped(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    """Return a link with a torsion spring and a damper, whose coefficient `d` can make it stiff."""
    file = tmp_path_factory.mktemp("damped") / "damped.yaml"
    file.write_text(DAMPED, encoding="utf-8")
    return gudgeon.load(file)


def load_double_pendulum() -> Simulation:
    return gudgeon.load(DOUBLE, scene="ideal")


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("load", [load_double_pendulum, lambda: scene_of("pendulum")], ids=["double", "pendulum"])
def test_no_less_accurate_than_dop853(load: Callable[[], Simulation], rtol: float) -> None:
    """Against series of twenty-five orders and more at 1e-15."""
    simulation = load()
    exact = simulation.simulate(3.0, output=30, method="taylor", rtol=1e-15)
    runs = [simulation.simulate(3.0, output=30, method=method, rtol=rtol) for method in ("auto", "dop853")]
    by_auto, by_dop853 = (max(abs(run.q - exact.q).max(), abs(run.v - exact.v).max()) for run in runs)
    assert by_auto <= by_dop853
    assert runs[0].diagnostics.method == (TAYLOR if rtol < 1e-5 else EXPLICIT)


def test_the_method_follows_from_scene_and_tolerance() -> None:
    """Contacts, films and jumps have no series; larger scenes have none in their library; nor has the full one."""
    double = load_double_pendulum()
    assert [select_first_method(double.source, rtol) for rtol in (1e-3, 1e-8)] == [EXPLICIT, TAYLOR]
    for name, scene in [("slider_crank", "dry"), ("belt_block", "ideal"), ("shaker", "ideal")]:
        source = scene_of(name, scene).source
        assert (
            not source.taylor_file
            and source.max_taylor_tolerance == 0.0
            and select_first_method(source, 1e-12) == EXPLICIT
        )
    squeezer = scene_of("andrews_squeezer", "ideal").source
    assert not squeezer.taylor_file and 1e-12 < squeezer.max_taylor_tolerance < RTOL
    assert [find_required_variant(squeezer, "auto", rtol, False) for rtol in (None, "1e-8", 1e-12)] == ["", "", TAYLOR]
    assert find_required_variant(squeezer, "auto", 1e-12, True) == ""
    assert select_first_method(double.full.source, 1e-12) == EXPLICIT
    assert double.of_method("taylor") is double


def test_the_prediction_is_monotone() -> None:
    """Tighter tolerances never return to dop853; more operations and closures never extend the use of series."""
    for n_rows in (0, 1, 6):
        limits = [predict_crossover_tolerance(n, n_rows, False) for n in (0, 30, 80, 160, 400, 1200, 10**5)]
        assert limits == sorted(limits, reverse=True) and limits[-1] == 0.0
        assert all(
            predict_crossover_tolerance(n, n_rows, True) >= predict_crossover_tolerance(n, n_rows, False)
            for n in (30, 160)
        )


def test_tight_tolerances_load_the_series_on_request(tmp_path: Path, at_once: Seen) -> None:  # noqa: F811
    """Single runs, batches and prepared calls have the same bits; the file is not needed after loading."""
    file = tmp_path / "spring.yaml"
    file.write_bytes(find_shipped_file("slider_crank_spring").read_bytes())
    spring, rtol = gudgeon.load(file), 1e-11
    file.unlink()
    assert spring.simulate(0.1, output=1).diagnostics.method == EXPLICIT
    name = next(name for name in spring.source.parameter_indices if name.endswith(".mass"))
    mass = spring.source.parameters[spring.source.parameter_indices[name]].default
    batch, singly = both(spring, {name: np.linspace(mass, 1.2 * mass, COUNT)}, 0.2, rtol=rtol)
    assert_same_batches(batch, singly)
    assert len(at_once.used) >= COUNT
    run = spring.simulate(0.2, output=7, rtol=rtol, parameters={name: mass})
    assert run.diagnostics.method == TAYLOR
    assert_same(batch[0], run)
    series = "rod.theta"
    assert spring.prepare(name, [series], t_end=0.2, output=7, rtol=rtol)([mass])[0].tobytes() == run[series].tobytes()
    exact = spring.simulate(0.2, output=7, method="dop853", rtol=1e-13, parameters={name: mass})
    assert abs(run.q - exact.q).max() < 1e-9


def test_without_a_compiler_the_library_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(arguments, "has_compiler", lambda: False)
    squeezer = scene_of("andrews_squeezer", "ideal").source
    assert find_required_variant(squeezer, "auto", 1e-12, False) == ""


def test_a_stiff_motion_is_left_to_the_stiff_method(damped: Simulation) -> None:
    """Overdamped: theta decays with k/d, and omega with d/J, in far less time."""
    run = damped.simulate(3.0, output=30, parameters={"d": 1e4})
    exact = damped.simulate(3.0, output=30, method="radau9", rtol=1e-12, parameters={"d": 1e4})
    assert run.diagnostics.method == f"{TAYLOR}+{STIFF}" and run.diagnostics.steps < 100
    assert abs(run.q - exact.q).max() < 1e-9
    gentle = damped.simulate(3.0, output=30)
    assert gentle.diagnostics.method == TAYLOR and gentle.diagnostics.stiff_steps == 0


def test_smooth_motion_is_seldom_tested_for_stiffness() -> None:
    """`auto` has the bits of a series of a tenth of its tolerance, and needs at most 3 % more right-hand sides."""
    double = load_double_pendulum()
    runs = [double.simulate(600.0, output=5, method=method, rtol=r) for method, r in (("auto", 1e-8), (TAYLOR, 1e-9))]
    assert runs[0].q.tobytes() == runs[1].q.tobytes()
    counts = [run.diagnostics.right_hand_sides for run in runs]
    assert counts[1] > 10_000 and counts[0] < 1.03 * counts[1]


@pytest.mark.parametrize("rtol", [1e-6, 1e-10])
def test_lanes_with_and_without_stiffness(damped: Simulation, at_once: Seen, rtol: float) -> None:  # noqa: F811
    """Runs that become stiff leave the lanes of the series; the bits are those of single runs."""
    sets: dict[str, Any] = {"d": np.geomspace(0.1, 1e4, COUNT)}
    batch, singly = both(damped, sets, 2.0, rtol=rtol)
    assert_same_batches(batch, singly)
    for name in ("steps", "stiff_steps", "right_hand_sides", "rejected"):
        assert (batch.diagnostics[name] == singly.diagnostics[name]).all(), name
    assert batch.diagnostics["stiff_steps"][0] == 0 < batch.diagnostics["stiff_steps"][-1]
    assert_same(batch[COUNT - 1], damped.simulate(2.0, output=7, rtol=rtol, parameters={"d": sets["d"][-1]}))


def test_every_method_of_a_scene_with_the_series_has_lanes(damped: Simulation, at_once: Seen) -> None:  # noqa: F811
    for method in ("auto", "taylor", "dop853", "rodas5p"):
        batch, singly = both(damped, {"d": np.linspace(0.1, 0.2, COUNT)}, 0.5, method=method)
        assert_same_batches(batch, singly)
    assert len(at_once.used) >= 4 * COUNT


def test_prepared_calls_and_steps_of_a_controller(damped: Simulation) -> None:
    prepared = damped.prepare("d", ["L0.theta"], t_end=1.0, output=4)
    run = damped.simulate(1.0, output=4, parameters={"d": 0.3})
    assert prepared([0.3])[0].tobytes() == run["L0.theta"].tobytes()
    stepper = damped.stepper("d", ["L0.theta"])
    stepper.reset([0.3])
    state = None
    for k in range(1, 4):
        run = damped.simulate(0.1 * k, output=1, parameters={"d": 0.3}, start=state)
        state = run.final
        assert stepper.step(0.1 * k - stepper.t) == pytest.approx(run["L0.theta"][-1:], abs=1e-14)


def test_a_page_has_no_series_and_an_fmu_has(damped: Simulation) -> None:
    assert f'"begins": "{EXPLICIT}"' in build_description(damped.compiled).replace('":"', '": "')
    header = _format_header(damped)
    assert f'#define FMU_FIRST_METHOD_FINE "{TAYLOR}"' in header and f'#define FMU_FIRST_METHOD "{EXPLICIT}"' in header


def test_an_unoptimized_library_has_the_same_bits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    file = tmp_path / "damped.yaml"
    file.write_text(DAMPED, encoding="utf-8")
    quick, optimized = (gudgeon.load(file, quick=quick).simulate(1.0, output=9) for quick in (True, False))
    assert quick.diagnostics.method == TAYLOR and quick.q.tobytes() == optimized.q.tobytes()
