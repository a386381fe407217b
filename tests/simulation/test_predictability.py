"""The horizon of a run: infinite where nothing multiplies small differences, early where contacts do."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.figures.plots import draw_run_figure
from gudgeon.results.figures.run_plots import Plot
from gudgeon.results.reports.comparison import build_tables, compute_scene_report
from gudgeon.results.results import Result
from gudgeon.simulation.predictability_horizon import compute_horizon
from tests.programs import needs_compiler

compiled = needs_compiler
PRESS = "nine_bar_press"
VALID = Path(__file__).parent.parent / "mechanisms" / "valid"


@compiled
def test_smooth_scenes_have_none() -> None:
    for name, scene, t_end, method in (
        ("pendulum", None, 5.0, "dop853"),
        (PRESS, "ideal", 0.1, "kinematic"),
        (PRESS, "lubricated", 0.005, "dop853"),
    ):
        run = gudgeon.load(name, scene=scene).simulate(t_end, output=10, method=method, horizon=True)
        assert run.diagnostics.horizon == math.inf
    asked_for_nothing = gudgeon.load("pendulum").simulate(0.1, output=2)
    assert math.isnan(asked_for_nothing.diagnostics.horizon)


@compiled
def test_the_dry_press_is_chaotic() -> None:
    """Tolerance buys time until rounding is what grows; paths a hundredth of the clearance apart come before."""
    press = gudgeon.load(PRESS, scene="dry")
    options: dict[str, Any] = {"output": 10, "method": "dop853", "parameters": {"l5": 0.25, "gravity.y": 0.0}}
    loose, tight = (press.simulate(0.4, rtol=rtol, horizon=True, **options) for rtol in (1e-6, 1e-13))
    contact = loose.diagnostics.peak("A").first_contact
    assert contact < loose.diagnostics.horizon < tight.diagnostics.horizon
    assert 0.2 < tight.diagnostics.horizon < 0.4
    assert contact < compute_horizon(press, tight, max_difference=0.01) < tight.diagnostics.horizon


@compiled
def test_a_fixed_step_is_compared_with_a_smaller_one() -> None:
    """RK4 at a step that leaves few of them to a contact: what it finds after the first ones is its own."""
    run = gudgeon.load(PRESS, scene="dry").simulate(0.1, output=10, method="rk4", step=2e-5, horizon=True)
    assert 0.006 < run.diagnostics.horizon < 0.08


@compiled
@pytest.mark.parametrize(
    ("file", "scene", "options", "runs"),
    [
        (PRESS, "dry", {"parameters": {"c": 0.5e-3, "omega": "4*pi"}}, ((0.2, 200), (1.0, 2000))),
        (PRESS, "dry", {"parameters": {"c": 0.5e-3}, "method": "rk4", "step": 2e-5}, ((0.2, 333), (1.5, 200))),
        pytest.param(
            VALID / "double_pendulum.yaml", "fast", {}, ((0.2, 200), (0.24, 20), (4.0, 2000)), marks=pytest.mark.slow
        ),
        pytest.param(
            PRESS,
            "dry",
            {"parameters": {"c": 0.5e-3, "omega": "4*pi"}},
            ((0.2, 200), (4.0, 500)),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_neither_t_end_nor_output_move_it(
    file: str | Path, scene: str, options: dict[str, Any], runs: tuple[tuple[float, int], ...]
) -> None:
    simulation = gudgeon.load(file, scene)
    found = [simulation.simulate(t_end, output=n, horizon=True, **options).diagnostics.horizon for t_end, n in runs]
    assert max(found) <= 1.2 * min(found) < math.inf


@compiled
def test_a_run_without_play_parts_where_a_longer_one_does(tmp_path: Path) -> None:
    """Three bars in a row, let go: chaotic, and slowly so."""
    bars = "".join(f"  L{k}: {{length: 150 mm, mass: .1 kg, inertia: 3e-4 kg*m^2}}\n" for k in (1, 2, 3))
    pins = "".join(f"  J{k}: {{revolute: [L{k}.head, L{k + 1}.tail]}}\n" for k in (1, 2))
    (tmp_path / "bars.yaml").write_text(
        f"format: gudgeon/1\nname: bars\ngravity: [0, -9.81 m/s^2]\nbodies:\n{bars}ground: {{O: [0, 0]}}\n"
        f"joints:\n  J0: {{revolute: [ground.O, L1.tail]}}\n{pins}"
        "start: {set: {L1.theta: 120 deg, L2.theta: 60 deg, L3.theta: 10 deg}}\n",
        encoding="utf-8",
    )
    run = gudgeon.load(tmp_path / "bars.yaml").simulate
    found = [run(t, output=n, rtol=1e-6, horizon=True).diagnostics.horizon for t, n in ((4.0, 20), (8.0, 99))]
    assert min(found) > 1.0 and max(found) <= 1.2 * min(found) < math.inf
    assert run(1.0, output=20, rtol=1e-6, horizon=True).diagnostics.horizon == math.inf


@compiled
@pytest.mark.parametrize("options", [{}, {"method": "rodas5p"}, {"method": "rk4", "step": 2e-5}])
def test_the_steps_of_a_longer_run_are_those_of_a_shorter_one(options: dict[str, Any]) -> None:
    """Bit for bit before a step would reach its end: t_end enters no tolerance and no first step."""
    press = gudgeon.load(PRESS, scene="dry")
    short, long = (press.simulate(output=[0.0, 0.01, 0.02, t_end], **options) for t_end in (0.1, 0.3))
    assert len(short.impacts[short.impacts["t_on"] < 0.02]) > 2
    assert short.q[:3].tobytes() == long.q[:3].tobytes() and short.v[:3].tobytes() == long.v[:3].tobytes()


def with_horizon(run: Result, value: float) -> Result:
    return replace(run, diagnostics=replace(run.diagnostics, horizon=value))


def test_it_is_stored_and_shown(make: Callable[..., Result], tmp_path: Path) -> None:
    run = with_horizon(make(), 0.28)
    stored = Diagnostics.from_json(run.diagnostics.to_json())
    assert stored.horizon == 0.28
    assert Diagnostics.from_json(with_horizon(run, math.inf).diagnostics.to_json()).horizon == math.inf
    for value, text in ((0.28, "0.28 s"), (math.inf, "to the end"), (math.nan, None)):
        shown = with_horizon(run, value)
        table = build_tables("", [compute_scene_report(shown, None, ["S9.y"])], 200)[0]
        names = list(table.columns[0].cells)
        if text is None:
            assert "  predictable until" not in names
        else:
            assert list(table.columns[1].cells)[names.index("  predictable until")] == text


def test_figures_mark_it(make: Callable[..., Result]) -> None:
    run, ideal = make(), make("ideal")
    plain, marked = Plot(run).series("S9.y"), Plot(with_horizon(run, 0.28)).series("S9.y")
    assert len(marked.lines) == len(plain.lines) + 1 and len(marked.patches) == len(plain.patches) + 1
    assert np.asarray(marked.lines[-1].get_xdata())[0] == 0.28
    pictures = [draw_run_figure({"dry": shown}, ideal, ["S9.y"]) for shown in (run, with_horizon(run, 0.28))]
    spans = [sum(len(ax.patches) for part in picture.subfigs for ax in part.axes) for picture in pictures]
    assert spans[1] - spans[0] == 4  # three of the motion, one of the force
