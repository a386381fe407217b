"""Located events against closed forms: dead centres of a driven slider-crank, the period of a pendulum."""

from __future__ import annotations

import json
import re
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import UnknownNameError
from gudgeon.results.results import State
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler

OMEGA = 20 * np.pi  # rad/s, of the shipped slider-crank: a turn in 0.1 s, dead centres every 0.05 s
CLOSE = 1e-11  # s; the times are found to 1e-12 s
EVENTS = """
events:
  dead: {zero: slider.vx}
  inner: {zero: slider.vx, direction: rising}
  outer: {zero: slider.vx, direction: falling}
  clock: {zero: t - 33 ms}
  up: {zero: crank.head.y - 25 mm, direction: rising}
"""
STOP = "  far: {zero: crank.theta - 9, action: stop}\n  too_late: {zero: t - 0.1432394488 s}\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("events")


def load(folder: Path, name: str, events: str, scene: str = "ideal") -> Simulation:
    """A shipped mechanism with events."""
    text = resources.files("gudgeon.mechanisms").joinpath(f"{name}.yaml").read_text(encoding="utf-8")
    path = folder / f"{name}.yaml"
    path.write_text(text + events, encoding="utf-8")
    return gudgeon.load(path, scene)


@pytest.fixture(scope="module")
def slider(folder: Path) -> Simulation:
    return load(folder, "slider_crank", EVENTS)


@pytest.mark.parametrize("output", [1, 7, 500])
def test_dead_centres(slider: Simulation, output: int) -> None:
    """However few samples are asked for: what is looked at are the steps that follow the motion."""
    run = slider.simulate(0.42, output=output)
    half_turns = np.arange(1, 9) * 0.05
    np.testing.assert_allclose(run.events_of("dead"), half_turns, rtol=0, atol=CLOSE)
    np.testing.assert_allclose(run.events_of("inner"), half_turns[::2], rtol=0, atol=CLOSE)
    np.testing.assert_allclose(run.events_of("outer"), half_turns[1::2], rtol=0, atol=CLOSE)
    np.testing.assert_allclose(run.events_of("clock"), [0.033], rtol=0, atol=CLOSE)
    up = np.arange(5) * 0.1 + np.pi / 6 / OMEGA  # the crank's head is 50 mm · sin ωt high
    np.testing.assert_allclose(run.events_of("up"), up, rtol=0, atol=CLOSE)
    assert (np.diff(run.events["t"]) >= 0).all()
    with pytest.raises(UnknownNameError, match="no event named 'outr'"):
        run.events_of("outr")


def test_more_events_than_there_is_room_for_at_once(slider: Simulation) -> None:
    run = slider.simulate(39.98, output=1)
    np.testing.assert_allclose(run.events_of("dead"), np.arange(1, 800) * 0.05, rtol=0, atol=1e-10)


def test_a_run_ends_at_an_event_and_another_goes_on_from_there(folder: Path) -> None:
    crank = load(folder, "slider_crank", EVENTS + STOP)
    end = 9 / OMEGA
    run = crank.simulate(0.5, output=100)
    np.testing.assert_allclose(run.t, [*np.arange(29) * 0.005, end], rtol=0, atol=CLOSE)
    assert abs(run["crank.theta"][-1] - 9.0) < OMEGA * CLOSE
    assert run.events_of("far") == [run.t[-1]] and len(run.events_of("too_late")) == 0
    assert run.diagnostics.notes[-1] == f"event far ended the run at t = {end:.9g} s"
    assert run.diagnostics.energy_residual < 1e-6 * run.diagnostics.energy_turned_over
    rest = crank.simulate(0.5, start=run.final)
    assert rest.t[-1] == 0.5 and len(rest.events_of("far")) == 0 and len(rest.events_of("too_late")) == 1
    both = np.concatenate([run.events_of("dead"), rest.events_of("dead")])
    np.testing.assert_allclose(both, np.arange(1, 11)[: len(both)] * 0.05, rtol=0, atol=CLOSE)
    through = crank.simulate(0.5, output=10, stop=False)
    assert through.t[-1] == 0.5
    np.testing.assert_allclose(through.events_of("far"), end, rtol=0, atol=CLOSE)


def test_a_file_gives_the_events_back(slider: Simulation, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    run = slider.simulate(0.2, output=5)
    run.save(tmp_path / "run.nc")
    back = gudgeon.Result.load(tmp_path / "run.nc")
    assert back.events.dtype == run.events.dtype and back.events.tobytes() == run.events.tobytes()
    assert back.source.events == run.source.events
    assert (back.events_of("dead") == run.events_of("dead")).all()


def test_commands_tell_of_events(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The ideal run that the scene with play is compared with goes on where the ideal scene itself ends."""
    load(folder, "slider_crank", EVENTS + "  soon: {zero: crank.theta - 0.4, action: stop}\n")
    monkeypatch.chdir(tmp_path)
    file = str(folder / "slider_crank.yaml")
    done = CliRunner().invoke(app, ["check", "-v", file])
    ideal, _ = done.output.split("scene dry")
    assert "events dead (both, recorded), inner (rising, recorded)" in " ".join(ideal.split())
    assert "soon (both, ends the run)" in done.output
    done = CliRunner().invoke(app, ["run", file, "--t-end", "0.01", "--output", "10"])
    assert done.exit_code == 0, done.output
    assert re.search(r"soon +at 0\.00636619[78] s", done.output) and re.search(r"clock +none", done.output)
    assert re.search(r"slider\.x +– +-?[\d.]+ mm at", done.output)
    done = CliRunner().invoke(app, ["run", file, "--t-end", "0.01", "--output", "10", "--scene", "ideal", "--json"])
    (soon,) = json.loads(done.stdout)["scenes"]["ideal"]["events"]["soon"]
    assert abs(soon - 0.4 / OMEGA) < CLOSE


SWING = "\nevents:\n  below: {zero: bob.x}\n  third: {zero: t - 2.75, action: stop}\n"


@pytest.mark.parametrize(
    ("method", "step", "rtol"), [("rk4", 1e-3, None), ("dop853", None, 1e-12), ("rodas5p", None, 1e-10)]
)
def test_period_of_a_pendulum(folder: Path, method: str, step: float | None, rtol: float | None) -> None:
    """Released from the horizontal with a period of exactly 2 s, it passes its lowest place at ½, 1½, 2½ s."""
    pendulum = load(folder, "pendulum", SWING, "two_seconds")
    run = pendulum.simulate(4.0, output=4, method=method, step=step, rtol=rtol)
    np.testing.assert_allclose(run.events_of("below"), [0.5, 1.5, 2.5], rtol=0, atol=1e-8)
    np.testing.assert_allclose(run.t, [0.0, 1.0, 2.0, 2.75], rtol=0, atol=1e-12)
    assert run.events_of("third") == [run.t[-1]]


WHEEL = """
format: gudgeon/1
name: wheel
parameters: {P: 1 rad, c: 0 rad, l: 0.5 rad, T: 0.3 s, s: 0.1 s}
bodies: {wheel: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {hub: {revolute: [ground.O, wheel.com]}}
freedoms: 1
start: {rates: {wheel.omega: 5 rad/s^1}}
events:
  both: {zero: "mod(wheel.theta - c, P) - l"}
  rising: {zero: "mod(wheel.theta - c, P) - l", direction: rising}
  falling: {zero: "mod(t + s, T) - T/2", direction: falling}
  pulse: {zero: "where(mod(wheel.theta - c, P) < l, -1, 2)"}
  signs: {zero: "sin(wheel.theta) * where(mod(t, T) < s, 1, -1)"}
"""


@pytest.mark.parametrize("method", ["dop853", pytest.param("rodas5p", marks=pytest.mark.slow)])
def test_events_of_periods_that_steps_leap_over(method: str, folder: Path) -> None:
    """A wheel turns freely, so that steps grow beyond every period: 40 drawn phases, each crossing by its closed form.

    Where mod begins anew its own events leap across zero; from there they were on the wrong side, and lost.
    """
    path, rng, n, t_end = folder / "wheel.yaml", np.random.default_rng(1), 40, 6.0
    path.write_text(WHEEL, encoding="utf-8")
    P, c, T = rng.uniform(0.3, 7.0, n), rng.uniform(-3.0, 3.0, n), rng.uniform(0.05, 2.0, n)
    level, s = P * rng.uniform(0.05, 0.95, n), T * rng.uniform(0.1, 0.9, n)
    batch = gudgeon.load(path).simulate_many({"P": P, "c": c, "l": level, "T": T, "s": s}, t_end, method=method)
    k = np.arange(-200, 300)
    for i in range(n):
        begins, passes = (c[i] + k * P[i]) / 5.0, (c[i] + level[i] + k * P[i]) / 5.0
        expected = {
            "both": [begins, passes],
            "rising": [passes],
            "falling": [k * T[i] - s[i]],
            "pulse": [begins, passes],
            "signs": [k * np.pi / 5.0, k * T[i], k * T[i] + s[i]],
        }
        for name, times in expected.items():
            every = np.sort(np.concatenate(times))
            np.testing.assert_allclose(
                batch[i].events_of(name), every[(every > 0.0) & (every < t_end)], rtol=0, atol=1e-9, err_msg=name
            )


LEAPS = """
format: gudgeon/1
name: leaps
parameters: {T: 0.5 s}
bodies: {slug: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, slug.origin], axis: [1, 0]}}
freedoms: 1
start: {rates: {slug.vx: 1 m/s}}
events:
  period: {zero: "mod(t, T) - T/2", direction: falling}
  less: {zero: "mod(slug.x, T * (1 m/s)) - 0.7*T * (1 m/s)", direction: falling} # to less than it comes from
  on: {zero: "where(t < T, -1, 1)"}
  place: {zero: "where(slug.x < T * (1 m/s), -1, 1)"}
  plain: {zero: t - T}
"""


@pytest.mark.parametrize("method", ["dop853", pytest.param("rodas5p", marks=pytest.mark.slow), "rk4"])
def test_leaps_at_the_end_and_at_the_start_of_runs(method: str, folder: Path) -> None:
    """n periods to their end, then piece by piece: each leap happens once, at an end, as a zero does."""
    (folder / "leaps.yaml").write_text(LEAPS, encoding="utf-8")
    slug, periods = gudgeon.load(folder / "leaps.yaml"), [0.5, 0.25, 0.3, 0.1, 1 / 3, 0.07]
    given: dict[str, Any] = {"method": method, "step": 1e-2 if method == "rk4" else None}
    for n in (1, 2, 3):
        batch = slug.simulate_many({"T": periods}, [n * T for T in periods], **given)
        for i, T in enumerate(periods):
            for name in ("period", "less"):
                np.testing.assert_allclose(batch[i].events_of(name), T * np.arange(1, n + 1), rtol=0, atol=1e-11)
            for name in ("on", "place", "plain"):
                np.testing.assert_allclose(batch[i].events_of(name), [T], rtol=0, atol=1e-11)
    for T in periods:
        found: list[tuple[Any, ...]] = []
        start: State | None = None
        for k in range(1, 8):
            run = slug.simulate(k * T, output=1, parameters={"T": T}, start=start, **given)
            found += [(name, *run.events_of(name)) for name in ("period", "less", "on", "place", "plain")]
            start = run.final
        times = {name: [x for other, *some in found for x in some if other == name] for name, *_ in found}
        for name in ("period", "less"):
            np.testing.assert_allclose(times.pop(name), T * np.arange(1, 8), rtol=0, atol=1e-11)
        assert [len(some) for some in times.values()] == [1, 1, 1]


@pytest.mark.parametrize(("method", "step"), [("auto", None), ("rk4", 1e-3)])
def test_events_in_driven_loops(method: str, step: float | None, folder: Path) -> None:
    """The shaker's table is at the length l of its rod where sin θ = a/(2 l), with the crank a at θ = ω t."""
    text = (resources.files("gudgeon") / "mechanisms/shaker.yaml").read_text(encoding="utf-8")
    path = folder / f"shaker_{method}.yaml"
    path.write_text(text.replace("outputs:", "events: {level: {zero: table.y - 60 mm}}\noutputs:"), encoding="utf-8")
    run = gudgeon.load(path).simulate(0.5, output=5, method=method, step=step)
    omega, first = 60 * np.pi, np.arcsin(1.0 / 12.0)
    expected = [(angle + 2 * np.pi * turn) / omega for turn in range(15) for angle in (first, np.pi - first)]
    assert np.abs(run.events_of("level") - expected).max() < CLOSE
