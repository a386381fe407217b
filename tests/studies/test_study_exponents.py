"""Lyapunov exponents, kinds of motion and mean horizons as measures of a study against closed forms."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import InputError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.simulation.test_lyapunov import DUFFING, LINEAR, RAIL, on_a_rail

pytestmark = needs_compiler


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("rail")


@pytest.fixture(scope="module")
def rail(folder: Path) -> Simulation:
    return on_a_rail(folder, DUFFING)


@pytest.fixture(scope="module")
def own(folder: Path, rail: Simulation) -> dict[str, Any]:
    """Linear oscillators on a rail: m ẍ = A cos ωt − d ẋ − k x, m = 1 kg."""
    return {"mechanism": str(folder / "rail.yaml"), "parameters": LINEAR | {"w": 5.0}, "output": 10}


@pytest.mark.slow
def test_exponents_of_hill_and_valley(own: dict[str, Any]) -> None:
    """√(k/m) on a hill of stiffness −k, −d/2m in a valley; a run that overflows is a row with its reason."""
    found = gudgeon.study(
        own
        | {
            "parameters": {"k3": 0.0, "A": 0.0},
            "zip": {"case": {"k": [-4.0, 4.0, -4.0], "d": [0.0, 0.4, 0.0], "x0": [0.0, 1.0, 1.0]}},
            "t_end": "where(x0 > 0 m, 80 s, 10 s)",
            "rtol": "1e-9",
            "windows": {"late": {"from": "1 s", "to": "60 s"}},
            "measures": {
                "rate": {"lyapunov": "run"},
                "error": {"lyapunov_error": "run"},
                "far": {"mean_horizon": "run"},
                "late": {"lyapunov": "run", "window": "late"},
            },
        }
    )
    data = found.dataset
    hill, valley = data.isel(case=0), data.isel(case=1)
    for name in ("rate", "late"):
        assert float(hill[name]) == pytest.approx(2.0, rel=1e-3)
        assert float(valley[name]) == pytest.approx(-0.2, rel=0.01)
    assert float(hill["far"]) == pytest.approx(math.log(0.25 / 1e-9) / float(hill["rate"]), rel=1e-12)
    assert float(valley["far"]) == math.inf and float(valley["error"]) < 0.1
    assert found.failed == 1 and "no longer advances" in str(data["failure"][2].item())
    assert all(math.isnan(float(data[name][2])) for name in found.measures)
    assert (data["rate"].attrs["units"], data["far"].attrs["units"]) == ("1/s", "s")


@pytest.mark.parametrize("damping", [[1.6], pytest.param([0.8, 1.6], marks=pytest.mark.slow)])
def test_kinds_of_motion_once_a_period(damping: list[float], own: dict[str, Any]) -> None:
    """Forced and damped, transients gone, it repeats itself with the force: by −d/2m · 2π/ω a return."""
    found = gudgeon.study(
        own
        | {
            "parameters": own["parameters"] | {"k": 4.0, "A": 7.5, "d": damping},
            "t_end": "140*pi/w",
            "windows": {"late": {"from": "20 s"}},
            "measures": {
                "kind": {"motion": "2*pi/w", "window": "late"},
                "per": {"lyapunov_per_return": "2*pi/w"},
                "sure": {"motion_confidence": "2*pi/w", "window": "late"},
            },
        }
    ).dataset
    np.testing.assert_allclose(found["per"], -found["d"] / 2 * 2 * np.pi / 5.0, rtol=0.02)
    assert (found["kind"] == 1.0).all() and (found["sure"] >= 0.8).all()


def test_a_run_is_followed_to_where_it_ended(tmp_path: Path) -> None:
    """From x0 on a hill of stiffness −k it comes to x = 1 m after acosh(1/x0)/√k, and ends there or is braked for good.

    By a second run, for the force jumps, whose tolerance is its own, however loose that of the runs is.
    """
    text = RAIL.format(parameters="k: 4 N/m, x0: 1e-6 m", force="where(m.x < 1 m, k*m.x, m.x * 0 N/m - m.vx * 5 kg/s)")
    path = tmp_path / "edge.yaml"
    path.write_text(text.replace("events: {", "events: {edge: {zero: m.x - 1 m, action: stop}, "), encoding="utf-8")
    measures = {
        "rate": {"lyapunov": "run"},
        "far": {"mean_horizon": "run"},
        "kind": {"motion": "9 s"},
        "late": {"lyapunov": "run", "window": "late"},
        "ups": {"crossings": "up", "window": "late"},
        "edges": {"crossings": "edge"},
    }
    expected = {
        "mechanism": str(path),
        "t_end": "20 s",
        "output": 10,
        "rtol": 1e-6,
        "measures": measures,
        "windows": {"late": {"from": "10 s"}},
    }
    stopped, on = gudgeon.study(expected), gudgeon.study(expected | {"stop": False}).dataset
    ended = stopped.dataset
    assert float(ended["t_last"]) == pytest.approx(math.acosh(1e6) / 2.0, rel=1e-5) and not stopped.failed
    assert float(ended["rate"]) == pytest.approx(2.0, rel=0.02)
    assert float(ended["far"]) == pytest.approx(math.log(0.25e6) / float(ended["rate"]), rel=1e-12)
    assert math.isnan(float(ended["late"])) and math.isnan(float(ended["kind"]))
    assert float(on["t_last"]) == 20.0 and float(on["rate"]) < 0.0 and math.isfinite(float(on["late"]))
    assert float(ended["edges"]) == float(on["edges"]) == 1.0  # and in a window that a run did not come to:
    assert math.isnan(float(ended["ups"])) and float(on["ups"]) == 0.0


def test_a_run_in_place_of_a_time(rail: Simulation) -> None:
    """The same start, numbers and method as the run's: the same exponent to the last bit."""
    numbers = LINEAR | {"k": 4.0, "d": 0.4, "x0": 0.5}
    run = rail.simulate(5.0, parameters=numbers, output=10, method="dop853")
    one, two = rail.lyapunov(run), rail.lyapunov(5.0, parameters=numbers, method="dop853")
    assert one.exponent == two.exponent and one.t[-1] == 5.0
    with pytest.raises(InputError, match="parameters are those of the run"):
        rail.lyapunov(run, parameters=numbers)
    with pytest.raises(InputError, match="expected the simulation"):
        gudgeon.load("pendulum").lyapunov(run)


BAD: list[tuple[dict[str, Any], str, str]] = [
    ({}, "{motion: run}", "a period: 2*pi/omega"),
    ({}, "{lyapunov: upp}", "unknown name"),
    ({}, "{lyapunov: 2*w}", "a time"),
    ({"step": "1 ms"}, "{mean_horizon: run}", "fixed step"),
    ({"mechanism": "slider_crank", "scenes": "ideal", "parameters": {}}, "{lyapunov: run}", "no degree of freedom"),
]


@pytest.mark.parametrize(("more", "measure", "words"), BAD, ids=[str(k) for k in range(len(BAD))])
def test_what_cannot_be_followed_is_told(
    more: dict[str, Any], measure: str, words: str, own: dict[str, Any], tmp_path: Path
) -> None:
    statistic, of = measure.strip("{}").split(": ")
    with pytest.raises(InputError) as message:
        resolve_plans(own | {"t_end": "1 s", "measures": {"m": {statistic: of}}} | more)
    assert words in str(message.value) and f"measures.m.{statistic}" in str(message.value), str(message.value)
