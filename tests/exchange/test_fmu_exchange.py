"""Model exchange: FMPy's CVODE integrates an FMU's equations, and comes to where gudgeon's own methods come."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import c_double
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.boundary import VR_INDICATORS as INDICATORS
from gudgeon.contract.boundary import VR_OUTPUTS as OUTPUTS
from gudgeon.contract.boundary import VR_RATES as RATES
from gudgeon.contract.boundary import VR_STATES as STATES
from gudgeon.exchange.fmu_description import explain_exchange_obstacle, iterate_outputs, list_states
from tests.exchange.test_fmu import instance, scene, written
from tests.programs import needs_compiler

fmpy = pytest.importorskip("fmpy")
pytestmark = [needs_compiler, pytest.mark.plain]

SWITCHED = """
format: gudgeon/1
name: switched
bodies: {block: {mass: 2 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, block.origin], axis: [1, 0]}}
forces: {pull: {force: block.origin, value: [-16 N * sign(block.x), 0]}}
start: {set: {block.x: 1 m}}
"""


@contextmanager
def model(fmu: str, c: float | None = None) -> Iterator[Any]:
    """One that others integrate, past its initialization and its first event; `c` in place of its parameters.c."""
    description, unpacked = fmpy.read_model_description(fmu), fmpy.extract(fmu)
    made = fmpy.fmi3.FMU3Model(
        guid=description.guid,
        unzipDirectory=unpacked,
        instanceName="one",
        modelIdentifier=description.modelExchange.modelIdentifier,
    )
    made.instantiate()
    for variable in description.modelVariables if c is not None else ():
        if variable.name == "parameters.c":
            made.setFloat64([variable.valueReference], [c])
    made.enterInitializationMode(startTime=0.0)
    made.exitInitializationMode()
    made.updateDiscreteStates()
    made.enterContinuousTimeMode()
    yield made
    made.terminate()
    made.freeInstance()


def vector(made: Any, get: str, count: int) -> np.ndarray:
    values = (c_double * count)()
    getattr(made, get)(values, count)
    return np.array(values)


@pytest.mark.parametrize(
    ("name", "which", "t_end", "series", "bound"),
    [
        ("pendulum", "ideal", 1.0, ["bob.x", "bob.y", "rod.F"], 1e-7),
        ("andrews_squeezer", "ideal", 0.03, ["OF.theta", "AG.theta", "work.forces"], 1e-7),
        ("nine_bar_press", "lubricated", 0.05, ["S9.y", "A.ex", "B.ey", "A.Fx", "work.drives"], 1e-6),
        ("nine_bar_press", "dry", 0.0085, ["S9.y", "A.ex", "B.ey", "work.drives"], 1e-5),  # three contacts
    ],
)
def test_it_is_valid_and_moves_as_the_native_run(
    name: str, which: str, t_end: float, series: list[str], bound: float, tmp_path: Path
) -> None:
    from fmpy.validation import validate_fmu

    simulation = scene(name, which)
    fmu = written(simulation, tmp_path)
    assert validate_fmu(fmu) == []
    series = [one for one in series if one in {name for name, *_ in iterate_outputs(simulation.source)}]
    found = fmpy.simulate_fmu(
        fmu,
        stop_time=t_end,
        output_interval=t_end / 50,
        relative_tolerance=1e-10,
        output=series,
        fmi_type="ModelExchange",
        solver="CVode",
    )
    found = found[np.unique(np.round(found["time"], 12), return_index=True)[1]]
    run = simulation.simulate(output=found["time"], rtol=1e-10)
    assert len(series) >= 2
    for one in series:
        assert abs(found[one] - run[one]).max() <= bound * abs(run[one]).max(), one
    if which == "dry":
        assert run.diagnostics.onsets == 3


FREE_FOUR_BAR = """\
format: gudgeon/1
name: free
bodies:
  a: {length: 0.1, mass: 0.3, inertia: 3e-4}
  b: {length: 0.25, mass: 0.4, inertia: 2e-3}
  c: {length: 0.2, mass: 0.4, inertia: 1.5e-3}
ground: {O: [0, 0], P: [0.25, 0]}
joints:
  O: {revolute: [ground.O, a.tail]}
  A: {revolute: [a.head, b.tail]}
  B: {revolute: [b.head, c.head]}
  P: {revolute: [ground.P, c.tail]}
start: {set: {a.theta: 1.0}, guess: {b.theta: 0.3, c.theta: 1.8}, rates: {a.omega: 8 rad/s}}
"""


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_directional_derivatives_of_a_loop_that_turns(formulation: str, tmp_path: Path) -> None:
    """Terms of Baumgarte's show in them where a closed loop moves."""
    file = tmp_path / "free.yaml"
    file.write_text(FREE_FOUR_BAR, encoding="utf-8")
    expect_directional_derivatives(gudgeon.load(file, formulation=formulation), tmp_path, 1e-6)  # a loop that is closed


@pytest.mark.parametrize(("name", "which"), [("nine_bar_press", "lubricated"), ("andrews_squeezer", "ideal")])
def test_directional_derivatives(name: str, which: str, tmp_path: Path) -> None:
    expect_directional_derivatives(scene(name, which), tmp_path)


def expect_directional_derivatives(simulation: gudgeon.Simulation, tmp_path: Path, outputs_off: float = 1e-8) -> None:
    """Of rates beside central differences of the FMU's own rates, of outputs beside those of its own outputs."""
    count = len(list_states(simulation.source))
    shown = [k for k, (one, *_) in enumerate(iterate_outputs(simulation.source)) if one.endswith((".x", ".omega"))][:4]
    rng = np.random.default_rng(7)
    with model(written(simulation, tmp_path)) as made:
        nominal = vector(made, "getNominalsOfContinuousStates", count)
        size = np.where(nominal < 1.0, nominal, 1e-3)
        size[-3:] = 1.0  # works: nothing depends on them
        x = vector(made, "getContinuousStates", count) + 0.05 * size * rng.normal(size=count)
        seed = size * rng.normal(size=count)

        def at(moved: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            made.setContinuousStates((c_double * count)(*moved), count)
            message = np.array(made.getFloat64([OUTPUTS + k for k in shown]))
            return vector(made, "getContinuousStateDerivatives", count), message

        steps = [[at(x + h * seed) for h in (1e-4, -1e-4)], [at(x + h * seed) for h in (2e-4, -2e-4)]]
        expected = [
            (4.0 * (near[0][k] - near[1][k]) / 2e-4 - (far[0][k] - far[1][k]) / 4e-4) / 3.0
            for near, far in [steps]
            for k in (0, 1)
        ]
        at(x)
        knowns = [STATES + k for k in range(count)]
        rates = np.array(made.getDirectionalDerivative([RATES + k for k in range(count)], knowns, seed))
        message = np.array(made.getDirectionalDerivative([OUTPUTS + k for k in shown], knowns, seed))
        assert (vector(made, "getContinuousStates", count) == x).all()
        assert made.getFloat64([RATES + 1]) == [vector(made, "getContinuousStateDerivatives", count)[1]]
    for part in (slice(None, -3), slice(-3, None)):
        assert abs(rates - expected[0])[part].max() <= 1e-6 * abs(expected[0][part]).max()
    assert abs(message - expected[1]).max() <= outputs_off * abs(expected[1]).max() and abs(message).max() > 0.0


@contextmanager
def contact(simulation: gudgeon.Simulation, folder: Path) -> Iterator[tuple[str, int, Any, Iterator[Any]]]:
    """The first contact's joint and number, the row of its onset, and states before, within, late in, and behind it."""
    onset = simulation.simulate(0.008, output=2, rtol=1e-11).impacts[0]
    on, off = onset["t_on"], onset["t_off"]
    with instance(written(simulation, folder), 0.02) as slave:

        def states_there() -> Iterator[Any]:
            now, count = 0.0, len(list_states(simulation.source))
            for t in (on - 1e-9, on + 1e-9, 0.9 * off + 0.1 * on, off + 1e-9):
                slave.doStep(now, t - now)
                now = t
                own = slave.getFloat64([slave.place[f"{'AB'[onset['joint']]}.state"]])[0]
                yield t, slave.getFloat64([STATES + k for k in range(count)]), own

        yield "AB"[onset["joint"]], onset["joint"], onset, states_there()


def test_nominals_are_what_counts_in_the_motion(tmp_path: Path) -> None:
    """Of angles c over the mechanism's size, of their velocities the largest so far, of works the kinetic energy."""
    simulation = scene("nine_bar_press", "dry")
    energy = simulation.simulate(0.001, output=2)["energy.kinetic"][0]
    with model(written(simulation, tmp_path)) as made:
        first, x = (vector(made, f"get{which}ContinuousStates", 13) for which in ("NominalsOf", ""))
        assert first[:5] == pytest.approx(np.full(5, 6e-4), rel=1e-12)
        assert first[5:10] == pytest.approx(np.full(5, abs(x[5:10]).max()), rel=1e-12)
        assert first[10:] == pytest.approx(np.full(3, energy), rel=1e-9)
        put(made, 0.0, [*x[:5], *(3.0 * x[5:10]), *x[10:]])
        for changed in (True, False):
            made.enterEventMode()
            assert made.updateDiscreteStates()[2] == changed
            made.enterContinuousTimeMode()
        later, x = (vector(made, f"get{which}ContinuousStates", 13) for which in ("NominalsOf", ""))
        assert later[5] == pytest.approx(abs(x[5:10]).max(), rel=1e-12) and later[5] > 2.0 * first[5]


def put(made: Any, t: float, x: list[float]) -> None:
    made.setTime(t)
    made.setContinuousStates((c_double * len(x))(*x), len(x))


def event(made: Any) -> None:
    made.enterEventMode()
    made.updateDiscreteStates()
    made.enterContinuousTimeMode()


def test_contacts_are_events(tmp_path: Path) -> None:
    """An indicator is the penetration; a contact begins with the speed of its onset, and ends where it is free.

    It counts as an impact until a completed step no longer compresses it, as in the native run.
    """
    simulation = scene("nine_bar_press", "dry")
    place = {name: OUTPUTS + k for k, (name, *_) in enumerate(iterate_outputs(simulation.source))}
    marks = []
    with contact(simulation, tmp_path) as (joint, k, onset, ways), model(written(simulation, tmp_path)) as made:
        for t, x, own in ways:
            put(made, t, x)
            z = vector(made, "getEventIndicators", 2)
            assert z[k] == made.getFloat64([INDICATORS + k])[0]
            event(made)
            made.completedIntegratorStep()
            remembered, state = made.getFloat64([place[f"{joint}.{name}"] for name in ("deltadot_minus", "state")])
            assert state == own
            marks.append((z[k] > 0.0, state, remembered))
    assert [mark[:2] for mark in marks] == [(False, 0), (True, 1), (True, 2), (False, 0)]
    assert marks[1][2] == marks[2][2] == pytest.approx(onset["deltadot"], rel=1e-4) and np.isnan(marks[3][2])


def test_an_event_located_at_zero_itself_counts(tmp_path: Path) -> None:
    """Penetrations of 0.0 to the bit, which importers' searches come to: an approach begins, a retreat ends there."""
    simulation = scene("nine_bar_press", "dry")
    fmu, c = (
        written(simulation, tmp_path),
        simulation.source.parameters[simulation.source.parameter_indices["parameters.c"]].default,
    )
    with contact(simulation, tmp_path) as (joint, k, _, ways):
        _, (t_on, x_on, _), within, (t_off, x_off, _) = ways
    minus = OUTPUTS + [name for name, *_ in iterate_outputs(simulation.source)].index(f"{joint}.deltadot_minus")
    for t, x, begins in ((t_on, x_on, True), (t_off, x_off, False)):
        with model(fmu) as made:
            put(made, t, x)
            e = vector(made, "getEventIndicators", 2)[k] + c
        with model(fmu, e) as made:
            if not begins:
                put(made, *within[:2])
                event(made)
                assert np.isfinite(made.getFloat64([minus])[0])
            put(made, t, x)
            assert vector(made, "getEventIndicators", 2)[k] == 0.0
            event(made)
            assert np.isfinite(made.getFloat64([minus])[0]) == begins


def test_a_jump_of_a_force_is_an_event(tmp_path: Path) -> None:
    """x'' = -8 sign(x) from rest at 1: parabolas of half a second to each zero, back after two."""
    file = tmp_path / "switched.yaml"
    file.write_text(SWITCHED, encoding="utf-8")
    fmu = written(gudgeon.load(file), tmp_path)
    found = fmpy.simulate_fmu(
        fmu,
        stop_time=2.0,
        output_interval=0.04,
        relative_tolerance=1e-9,
        output=["block.x"],
        fmi_type="ModelExchange",
        solver="CVode",
        record_events=False,
    )
    t = found["time"]
    x = np.where(t < 0.5, 1 - 4 * t**2, np.where(t < 1.5, 4 * (t - 1) ** 2 - 1, 1 - 4 * (t - 2) ** 2))
    assert len(t) == 51 and abs(found["block.x"] - x).max() < 1e-8
    with model(fmu) as made:
        for speed in (-4.0, 4.0):  # at zero to the bit: what comes next counts, however often it is asked
            put(made, 0.5, [0.0, speed, 0.0, 0.0, 0.0])
            for _ in range(2):
                event(made)
                assert vector(made, "getContinuousStateDerivatives", 5)[1] == pytest.approx(-2.0 * speed)


def test_a_state_goes_through_bytes(tmp_path: Path) -> None:
    fmu = written(scene("nine_bar_press", "dry"), tmp_path)
    with instance(fmu, 0.02) as one, instance(fmu, 0.02) as two:
        expected = [OUTPUTS + k for k in range(6)]
        for k in range(8):
            one.doStep(k * 1e-3, 1e-3)
        kept = one.getFMUState()
        message = one.serializeFMUState(kept)
        one.freeFMUState(kept)
        again = two.deserializeFMUState(message)
        two.setFMUState(again)
        two.freeFMUState(again)
        for each in (one, two):
            each.doStep(8e-3, 2e-3)
        assert one.getFloat64(expected) == two.getFloat64(expected)
        with pytest.raises(Exception, match="DeserializeFMUState"):
            two.deserializeFMUState(message[: len(message) // 2])


def test_what_others_cannot_integrate_says_why(tmp_path: Path) -> None:
    for name, why in (("four_bar", "no degrees of freedom"), ("shaker", "only drives")):
        simulation = scene(name, "ideal")
        assert why in explain_exchange_obstacle(simulation.source)
        assert fmpy.read_model_description(written(simulation, tmp_path)).modelExchange is None
    assert not explain_exchange_obstacle(gudgeon.load("pendulum").source)
