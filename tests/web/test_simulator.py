"""The simulator of pages beside the native one: the same C, compiled by another compiler and run by V8."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BuildError, SolverError
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.web.module import compile_simulator
from gudgeon.web.page import embed_scene
from tests.integrators.test_guide import ARM
from tests.integrators.test_guide import HEAD as GUIDED_HEAD
from tests.integrators.test_newton_restitution import BALL, HEAD
from tests.scenes import loader
from tests.slow import slow_but
from tests.web.node import Answer, browser, in_browser, in_node, needs_node, same_bits

pytest.importorskip("ziglang", reason="the extra web is not installed: no compiler for pages")

# Runs whose numbers the native run gives too
RUNS: dict[tuple[str, str], list[dict[str, Any]]] = {
    ("pendulum", "ideal"): [
        {"t_end": 2, "output": 50, "method": "dop853"},
        {"t_end": 2, "output": 50, "method": "rodas5p"},
        {"t_end": 2, "output": 50, "method": "rk4", "step": 1e-3},
    ],
    ("four_bar", "ideal"): [{"t_end": 1, "output": 100}],
    ("slider_crank", "dry"): [
        {"t_end": 0.2, "output": 100},
        {"t_end": 0.02, "output": 20, "method": "rk4"},
        {"t_end": 0.02, "output": 20, "method": "rodas5p"},
    ],
    ("nine_bar_press", "lubricated"): [
        {"t_end": 0.02, "output": 20, "method": "dop853"},
        {"t_end": 0.01, "output": 9, "step": 5e-6},
    ],
    ("andrews_squeezer", "ideal"): [{"t_end": 0.03, "output": 60}],
}

FAST: dict[str, Any] = {"t_end": 0.05, "output": 10, "method": "rk4", "step": 2e-4}
SOON: dict[str, Any] = {"t_end": 0.02, "output": 20, "method": "dop853"}
WHILE: dict[str, Any] = {"t_end": 2.0, "output": 37}


def check_series(found: Answer, run: Result, share: float) -> None:
    """Each series within a share of the largest value of those with its unit; names and units are the same."""
    assert found.units == dict(run.names)
    largest: dict[str, float] = {}
    for name, unit in run.names.items():
        largest[unit] = max(largest.get(unit, 0.0), float(np.nanmax(np.abs(run[name]), initial=0.0)))
    for name, unit in run.names.items():
        assert np.allclose(found.series[name], run[name], rtol=0.0, atol=share * largest[unit], equal_nan=True), name


@needs_node
@pytest.mark.parametrize("scene", slow_but([*RUNS][:4], RUNS), ids="/".join)
def test_numbers_are_those_of_the_native_run(scene: tuple[str, str], tmp_path: Path) -> None:
    simulation = gudgeon.load(*scene)
    native = [simulation.simulate(**options) for options in RUNS[scene]]
    names = [{"options": options, "names": [*run.names]} for options, run in zip(RUNS[scene], native, strict=True)]
    for found, run in zip(in_node(simulation, tmp_path, names), native, strict=True):
        assert found.error == ""
        assert found.counts["steps"] == run.diagnostics.steps
        assert same_bits(found, run)
        check_series(found, run, 1e-13)
        assert len(found.impacts) == len(run.impacts)


@pytest.mark.slow  # those that are shipped are the native ones in the default run too
@needs_node
def test_slopes_of_contacts_are_the_native_ones(tmp_path: Path) -> None:
    """What implicit steps are solved with; derived here and now, with another mass."""
    engine = gudgeon.load("slider_crank", "dry", overrides={"bodies.rod.mass": "50 g"})
    options: dict[str, Any] = {"t_end": 0.02, "output": 20, "method": "rodas5p"}
    (found,) = in_node(engine, tmp_path, [{"options": options}])
    native = engine.simulate(**options)
    assert len(native.impacts) > 3
    assert same_bits(found, native)


@needs_node
def test_a_slider_in_its_guide_and_the_sum_of_its_corners(tmp_path: Path) -> None:
    file = tmp_path / "guided.yaml"
    file.write_text(GUIDED_HEAD + ARM, encoding="utf-8")
    engine, options = gudgeon.load(file, "elastic"), {"t_end": 0.01, "output": 20, "method": "dop853"}
    native = engine.simulate(**options)  # type: ignore[arg-type]
    (found,) = in_node(engine, tmp_path, [{"options": options, "names": [*native.names]}])
    assert same_bits(found, native) and len(found.impacts) == len(native.impacts) > 3
    check_series(found, native, 1e-13)


@needs_node
def test_surfaces_that_do_not_give_stay_with_the_explicit_method(tmp_path: Path) -> None:
    """A stiff damper would send `auto` to the implicit one, whose slopes know of no blow."""
    file = tmp_path / "stiff.yaml"
    options: dict[str, Any] = {"t_end": 0.6, "output": 10}
    damped = "forces: {oil: {rotational_spring_damper: [ball, ground], damping: 0.07 N*m*s}}\n"
    file.write_text(HEAD + BALL.replace("start: {", "start: {rates: {ball.omega: 1 rad/s}, ") + damped)
    engine = gudgeon.load(file, "hard")
    found, refused = in_node(engine, tmp_path, [{"options": options}, {"options": options | {"method": "rodas5p"}}])
    native = engine.simulate(**options)
    assert native.diagnostics.rejected > 0 and len(native.impacts) == 1
    assert found.counts["jacobians"] == 0 and same_bits(found, native)
    assert "method is rodas5p: expected auto, rk4, dop853" in refused.error


@needs_node
def test_numbers_of_a_page_and_what_it_refuses(tmp_path: Path) -> None:
    """A choice brings numbers of its own; conditions of the file hold; options that are none are refused."""
    press, options = gudgeon.load("nine_bar_press", "lubricated"), SOON
    clearance, material = "bearings.pin.clearance", "bearings.pin.bearing_material"
    parameters: dict[str, Any] = {material: "steel_45", clearance: 4e-4}
    wrong = {
        f"{clearance} is -0.0001": {clearance: -1e-4},
        "bearings.pon": {"bearings.pon.clearance": 1.0},
        f"{clearance} is 1 mm: expected a number": {clearance: "1 mm"},
        f"{material} is lead": {material: "lead"},
    }
    odd: dict[str, dict[str, Any]] = {
        "method is": {"method": "kinematic"},
        "t_end is": {"t_end": 0},
        "rtol is": {"rtol": 2},
        "output is": {"output": 0},
        "slice is 0: expected a whole number": {"slice": 0},
        "slice is -1": {"slice": -1},
        "slice is 0.5": {"slice": 0.5},
        "slice is 2,3: expected a number": {"slice": [2, 3]},
        "rtol is 1e-6: expected a number": {"rtol": "1e-6"},
        "tend is no option: expected t_end": {"tend": 1},
    }
    kinds: list[tuple[str, dict[str, Any]]] = [
        ("options is null: expected an object", {"options": None}),
        ("options is 5", {"options": 5}),
        ("options is 1: expected an object", {"options": [1]}),
        *(
            (f"parameters is {message}: expected an object", {"parameters": one, "options": options})
            for message, one in (("null", None), ("5", 5), ("omega", "omega"), ("", []))
        ),
        ("omega is [object Object]: expected a number", {"parameters": {"omega": {}}, "options": options}),
    ]
    runs: list[dict[str, Any]] = [{"parameters": parameters, "options": options}]
    runs += [{"parameters": one, "options": options} for one in wrong.values()]
    runs += [{"options": options | one} for one in odd.values()]
    right, *refused = in_node(press, tmp_path, [*runs, *(one for _, one in kinds)])
    native = press.simulate(parameters=parameters, **options)
    assert same_bits(right, native)
    assert not np.array_equal(native.q, press.simulate(**options).q)
    for found, text in zip(refused, (*wrong, *odd, *(text for text, _ in kinds)), strict=True):
        assert text in found.error


@needs_node
def test_a_journal_that_is_too_deep_is_named(tmp_path: Path) -> None:
    """Which one, and how deep, as the native run says it."""
    crank, options = gudgeon.load("slider_crank", "dry"), FAST | {"step": 1e-3}
    with pytest.raises(SolverError) as caught:
        crank.simulate(**options)
    (found,) = in_node(crank, tmp_path, [{"options": options}])
    message = str(caught.value).partition(", at t = ")[0]
    assert "the journal of wristpin lies 3.52 mm deep" in message and found.error.startswith(f"{message}: t = 0.002")


FREE: dict[str, float] = {"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0}


def kept_rows(simulation: Simulation, t: Any, parts: int, gain: float) -> Any:
    """q at times t (N,) of a driven scene, (N, n): rk4 over Φ̈ + 2α Φ̇ + β² Φ = 0, solved in plain Python."""
    model = simulation.full.model.numpy()
    run, p, n = simulation.simulate(1e-3, output=1), model.prepare(), model.n

    def rate(at: float, y: Any) -> Any:
        q, v = y[:n], y[n:]
        jacobian = model.phi_q(at, q, p)
        open_, rate_ = model.phi(at, q, p), jacobian @ v - model.nu(at, q, p)
        rhs = model.gamma(at, q, v, p) - 2 * gain * rate_ - gain**2 * open_
        return np.concatenate([v, np.linalg.solve(jacobian, rhs)])

    y = np.concatenate([run.q[0], run.v[0]])
    rows, h = [y[:n]], (t[1] - t[0]) / parts
    for at in np.arange((len(t) - 1) * parts) * h:
        k1 = rate(at, y)
        k2 = rate(at + h / 2, y + h / 2 * k1)
        k3 = rate(at + h / 2, y + h / 2 * k2)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(at + h, y + h * k3))
        rows.append(y[:n])
    return np.array(rows)[::parts]


@needs_node
def test_rows_of_a_driven_scene_drift_with_the_square_of_time(tmp_path: Path) -> None:
    """Φ̈ = 0 is all that holds them: an error of Φ̇ in each turn adds up once, one of Φ twice. Baumgarte's bound it."""
    four_bar, requested = gudgeon.load("four_bar"), {"t_end": 40.0, "output": 2000, "method": "rk4"}
    runs: list[dict[str, Any]] = [
        {"parameters": free, "options": requested | {"step": step}, "names": ["Phi.max"]}
        for free, step in ((FREE, 0.02), (FREE, 0.01), (dict.fromkeys(FREE, 5.0), 0.02))
    ]
    coarse, fine, held = in_node(four_bar, tmp_path, runs)
    t, begun, second = coarse.arrays["t"], slice(250, None), slice(1000, None)
    drifts = [np.maximum.accumulate(one.series["Phi.max"]) for one in (coarse, fine)]
    for one in drifts:
        assert np.polyfit(np.log(t[begun]), np.log(one[begun]), 1)[0] == pytest.approx(2.0, abs=0.1)
    assert np.log2(drifts[0][-1] / drifts[1][-1]) == pytest.approx(4.0, abs=0.2)  # the order of rk4
    bounded = held.series["Phi.max"]
    assert bounded[second].max() < 1.01 * bounded[:1000].max() < 1e-2 * drifts[0][-1]
    for found, gain in ((coarse, 0.0), (held, 5.0)):
        q = found.arrays["q"].reshape(len(t), -1)[:201]
        assert np.abs(q - kept_rows(four_bar, t[:201], 1, gain)).max() < 1e-11
    assert coarse.counts == {"steps": 2000, "right_hand_sides": 8000}


BODY = "mass: .1 kg, inertia: 1e-4 kg*m^2"
SWING = f"""
title: </script><script>alert(1)</script>
bodies: {{bob: {{length: 1 m, {BODY}}}}}
ground: {{O: [0, 0]}}
gravity: [0, -9.81 m/s^2]
joints: {{O: {{revolute: [ground.O, bob.tail]}}}}
start: {{set: {{bob.theta: -10 deg}}}}
events:
  below: {{zero: bob.theta + 45 deg, direction: falling}}
  side: {{zero: bob.theta + 150 deg, direction: falling, action: stop}}
"""
CRANK = f"""
parameters: {{rod: 80 mm, half: 30 deg}}
bodies:
  crank: {{length: 100 mm, {BODY}}}
  rod: {{length: rod, {BODY}}}
  block: {{{BODY}}}
ground: {{O: [0, 0], G: [0, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  A: {{revolute: [crank.head, rod.tail]}}
  B: {{revolute: [rod.head, block.origin]}}
  guide: {{translational: [ground.G, block.origin], axis: [1, 0]}}
drives: {{turn: {{angle: crank, value: -40 deg + 2 rad/s * t}}}}
start: {{guess: {{rod.theta: 30 deg}}}}
events:
  through: {{zero: crank.theta}}
  half: {{zero: crank.theta - half}}
scenes:
  stopped: {{events: {{half: {{zero: crank.theta - half, action: stop}}}}}}
"""


@needs_node
@pytest.mark.parametrize(("text", "scene"), [(SWING, "ideal"), (CRANK, "stopped")])
def test_events_are_noted_and_end_a_run(text: str, scene: str, tmp_path: Path) -> None:
    simulation = loader(tmp_path)(text, scene)
    method = "dop853" if simulation.source.taylor_file else "auto"  # a page has no Taylor series
    native = simulation.simulate(method=method, **WHILE)
    (found,) = in_node(simulation, tmp_path, [{"options": WHILE, "slices": True}])
    names = [event.name for event in simulation.source.events]
    assert native.t[-1] < 2.0
    assert same_bits(found, native)
    assert [(one["name"], one["t"]) for one in found.events] == [(names[k], t) for k, t in native.events.tolist()]
    assert len(native.events) == 2
    assert list(found.fractions) == sorted(found.fractions)


LONG: dict[str, Any] = {"t_end": 2000.0, "output": 2}


@needs_node
@pytest.mark.parametrize("scene", slow_but(["stopped"], ["ideal", "stopped"]))
def test_few_samples_of_a_long_time_come_in_pieces(scene: str, tmp_path: Path) -> None:
    """A page freezes between two pieces: none of 50,000 steps to two samples has more than some thousand of them."""
    simulation, requested = loader(tmp_path)(CRANK, scene), LONG
    moved = {"rod": 0.2, "half": 1000.5}
    native = simulation.simulate(parameters=moved, **requested)
    (found,) = in_node(simulation, tmp_path, [{"parameters": moved, "options": requested, "slices": True}])
    assert found.error == "" and found.arrays["t"] == pytest.approx(native.t, rel=1e-13)
    assert (native.t[-1] < 501.0) == (scene == "stopped")
    assert found.counts["steps"] / len(found.fractions) < 3000 and list(found.fractions) == sorted(found.fractions)
    for name, most in (("q", 1e-12), ("v", 1e-12), ("work", 1e-8)):
        assert np.abs(found.arrays[name] - np.ravel(getattr(native, name))).max() < most
    assert [one["t"] for one in found.events] == pytest.approx(native.events["t"].tolist(), rel=1e-12)


@needs_node
def test_a_run_that_fails_gives_what_it_has(tmp_path: Path) -> None:
    """The rod is too short to let the crank turn on."""
    simulation, never = loader(tmp_path)(CRANK, "stopped"), {"half": 3.0}
    with pytest.raises(SolverError) as caught:
        simulation.simulate(parameters=never, **WHILE)
    (found,) = in_node(simulation, tmp_path, [{"parameters": never, "options": WHILE}])
    message, _, t = found.error.removesuffix(" s").partition(": t = ")
    assert "singular" in message or "cannot follow" in message
    assert float(t) == pytest.approx(caught.value.time, rel=1e-8) and len(t) <= 11  # as it is written, 9 digits
    assert same_bits(found, caught.value.partial)


SIGNAL = f"""
curves: {{wave: {{table: wave.csv, x: s}}}}
bodies: {{crank: {{length: 50 mm, {BODY}}}}}
ground: {{O: [0, 0]}}
joints: {{O: {{revolute: [ground.O, crank.tail]}}}}
drives: {{motor: {{angle: crank, value: 1 rad/s * t}}}}
outputs: {{signal: wave(t)}}
"""


@needs_node
@pytest.mark.parametrize("n_points", [20, 4500])
def test_a_curve_in_an_output_is_interpolated(n_points: int, tmp_path: Path) -> None:
    """A page gets the table of a long curve as bytes, that of a short one as numbers; both give a sine."""
    t = np.linspace(0.0, 1.0, n_points)
    np.savetxt(tmp_path / "wave.csv", np.column_stack([t, np.sin(np.pi * t)]), delimiter=",", fmt="%.17g")
    simulation, options = loader(tmp_path)(SIGNAL), {"t_end": 0.9, "output": 30}
    (found,) = in_node(simulation, tmp_path, [{"options": options, "names": ["signal"]}])
    assert found.error == ""
    assert np.abs(found.series["signal"] - np.sin(np.pi * found.arrays["t"])).max() < 10.0 / n_points**4


@pytest.mark.slow  # test_page.py's lie on disk too
@pytest.mark.skipif(browser() is None, reason="no Chromium is installed")
def test_a_page_opened_from_disk_computes_the_same(tmp_path: Path) -> None:
    """One file, all in it; within the 400 kB that a page may have."""
    press = gudgeon.load("nine_bar_press", "lubricated")
    (found,) = in_browser(press, tmp_path, [{"options": SOON}])
    assert same_bits(found, press.simulate(**SOON))
    assert (tmp_path / "page.html").stat().st_size < 400_000


def test_without_its_compiler_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ziglang", None)
    with pytest.raises(BuildError, match=r"pip install 'gudgeon\[web\]'"):
        compile_simulator(gudgeon.load("pendulum").source)


def test_nothing_of_a_file_ends_the_element_that_carries_it(tmp_path: Path) -> None:
    message = embed_scene(loader(tmp_path)(SWING).compiled)
    assert message.count("</script>") == 3 and "alert(1)<" not in message
