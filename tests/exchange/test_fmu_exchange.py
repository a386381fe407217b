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
from gudgeon.exchange.fmu_description import INDICATORS, OUTPUTS, RATES, STATES, kept_from_exchange, outputs, states
from tests.exchange.test_fmu import instance, scene, written
from tests.programs import needs_compiler

fmpy = pytest.importorskip("fmpy")
pytestmark = needs_compiler


@contextmanager
def model(fmu: str) -> Iterator[Any]:
    """One that others integrate, past its initialization and its first event."""
    description, unpacked = fmpy.read_model_description(fmu), fmpy.extract(fmu)
    made = fmpy.fmi3.FMU3Model(
        guid=description.guid, unzipDirectory=unpacked, instanceName="one",
        modelIdentifier=description.modelExchange.modelIdentifier,
    )  # fmt: skip
    made.instantiate()
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
    series = [one for one in series if one in {name for name, *_ in outputs(simulation.source)}]
    found = fmpy.simulate_fmu(
        fmu, stop_time=t_end, output_interval=t_end / 50, relative_tolerance=1e-10, output=series,
        fmi_type="ModelExchange", solver="CVode",
    )  # fmt: skip
    found = found[np.unique(np.round(found["time"], 12), return_index=True)[1]]
    run = simulation.simulate(output=found["time"], rtol=1e-10)
    assert len(series) >= 2
    for one in series:
        assert abs(found[one] - run[one]).max() <= bound * abs(run[one]).max(), one
    if which == "dry":
        assert run.diagnostics.onsets == 3


@pytest.mark.parametrize(("name", "which"), [("nine_bar_press", "lubricated"), ("andrews_squeezer", "ideal")])
def test_directional_derivatives(name: str, which: str, tmp_path: Path) -> None:
    """Of rates beside central differences of the FMU's own rates, of outputs beside those of its own outputs."""
    simulation = scene(name, which)
    count = len(states(simulation.source))
    shown = [k for k, (one, *_) in enumerate(outputs(simulation.source)) if one.endswith((".x", ".omega"))][:4]
    rng = np.random.default_rng(7)
    with model(written(simulation, tmp_path)) as made:
        nominal = vector(made, "getNominalsOfContinuousStates", count)
        size = np.where(nominal < 1.0, nominal, 1e-3)
        size[-3:] = 1.0  # works: nothing depends on them
        x = vector(made, "getContinuousStates", count) + 0.05 * size * rng.normal(size=count)
        seed = size * rng.normal(size=count)

        def at(moved: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            made.setContinuousStates((c_double * count)(*moved), count)
            told = np.array(made.getFloat64([OUTPUTS + k for k in shown]))
            return vector(made, "getContinuousStateDerivatives", count), told

        steps = [[at(x + h * seed) for h in (1e-4, -1e-4)], [at(x + h * seed) for h in (2e-4, -2e-4)]]
        wanted = [
            (4.0 * (near[0][k] - near[1][k]) / 2e-4 - (far[0][k] - far[1][k]) / 4e-4) / 3.0
            for near, far in [steps]
            for k in (0, 1)
        ]
        at(x)
        knowns = [STATES + k for k in range(count)]
        rates = np.array(made.getDirectionalDerivative([RATES + k for k in range(count)], knowns, seed))
        told = np.array(made.getDirectionalDerivative([OUTPUTS + k for k in shown], knowns, seed))
        assert (vector(made, "getContinuousStates", count) == x).all()
        assert made.getFloat64([RATES + 1]) == [vector(made, "getContinuousStateDerivatives", count)[1]]
    for part in (slice(None, -3), slice(-3, None)):
        assert abs(rates - wanted[0])[part].max() <= 1e-6 * abs(wanted[0][part]).max()
    assert abs(told - wanted[1]).max() <= 1e-7 * abs(wanted[1]).max() and abs(told).max() > 0.0


def test_contacts_are_events(tmp_path: Path) -> None:
    """An indicator is the penetration; a contact begins with the speed of its onset, and ends where it is free."""
    simulation = scene("nine_bar_press", "dry")
    onset = simulation.simulate(0.008, output=2, rtol=1e-11).impacts[0]
    run = simulation.simulate(output=[0.0, onset["t_on"] - 1e-9, onset["t_on"] + 1e-9, onset["t_off"] + 1e-9],
                              rtol=1e-11)  # fmt: skip
    place = {name: OUTPUTS + k for k, (name, *_) in enumerate(outputs(simulation.source))}
    count, joint = len(states(simulation.source)), ("A", "B")[onset["joint"]]
    with model(written(simulation, tmp_path)) as made, instance(written(simulation, tmp_path)) as slave:
        marks, now = [], 0.0
        for t in run.t[1:]:
            slave.doStep(now, t - now)
            now = t
            x = slave.getFloat64([STATES + k for k in range(count)])
            made.setTime(t)
            made.setContinuousStates((c_double * count)(*x), count)
            z = vector(made, "getEventIndicators", 2)
            assert z[onset["joint"]] == made.getFloat64([INDICATORS + onset["joint"]])[0]
            made.enterEventMode()
            made.updateDiscreteStates()
            made.enterContinuousTimeMode()
            remembered = made.getFloat64([place[f"{joint}.deltadot_minus"]])[0]
            marks.append((z[onset["joint"]] > 0.0, remembered))
    (before, _), (during, remembered), (after, gone) = marks
    assert (before, during, after) == (False, True, False) and np.isnan(gone)
    assert remembered == pytest.approx(onset["deltadot"], rel=1e-4)


def test_a_state_goes_through_bytes(tmp_path: Path) -> None:
    fmu = written(scene("nine_bar_press", "dry"), tmp_path)
    with instance(fmu, 0.02) as one, instance(fmu, 0.02) as two:
        wanted = [OUTPUTS + k for k in range(6)]
        for k in range(8):
            one.doStep(k * 1e-3, 1e-3)
        kept = one.getFMUState()
        told = one.serializeFMUState(kept)
        one.freeFMUState(kept)
        again = two.deserializeFMUState(told)
        two.setFMUState(again)
        two.freeFMUState(again)
        for each in (one, two):
            each.doStep(8e-3, 2e-3)
        assert one.getFloat64(wanted) == two.getFloat64(wanted)
        with pytest.raises(Exception, match="DeserializeFMUState"):
            two.deserializeFMUState(told[: len(told) // 2])


def test_what_others_cannot_integrate_says_why(tmp_path: Path) -> None:
    for name, why in (("four_bar", "no freedom"), ("shaker", "drives alone")):
        simulation = scene(name, "ideal")
        assert why in kept_from_exchange(simulation.source)
        assert fmpy.read_model_description(written(simulation, tmp_path)).modelExchange is None
    assert not kept_from_exchange(gudgeon.load("pendulum").source)
