"""Step × clearance: what is known to diverge is said to diverge, what is known to be good is stable."""

from __future__ import annotations

import csv
import math
import threading
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import Axis, make_axis, make_clearance_axis, parse_axis
from gudgeon.studies.map import VerdictMap, compute_verdict_map, list_default_clearances, list_map_steps
from gudgeon.studies.runs import Attempt, Error, SceneWindow, Setting
from gudgeon.studies.show.map import describe_marked_step, format_run_command
from gudgeon.studies.show.tables import format_fraction, format_seconds
from gudgeon.studies.verdicts import Cell, Limits, Status, classify_runs
from tests.programs import needs_compiler

PENDULUM = str(Path(__file__).parents[1] / "mechanisms" / "valid" / "double_pendulum.yaml")
C = 0.3e-3


@cache
def press(scene: str) -> Simulation:
    return gudgeon.load("nine_bar_press", scene=scene)


def by_step(scene: str, steps: list[float], play: list[float], **options: Any) -> VerdictMap:
    """Steps of rk4 × clearance."""
    axes = [make_axis(press(scene), "step", steps), make_clearance_axis(press(scene), play)]
    return compute_verdict_map(press(scene), axes, method="rk4", **options)


def rk4(step: float) -> Setting:
    return Setting("rk4", step)


@cache
def lubricated() -> VerdictMap:
    return by_step("lubricated", [5e-6, 2e-5, 1e-4], [0.2e-3, C], t_long=0.03, t_short=0.01)


@needs_compiler
def test_film_is_lost_with_the_papers_step_and_not_with_a_short_one() -> None:
    """RK4 is stable while step × rate < 2.785; the film's rate near e = 0 is πS/(c m), ∝ 1/c³."""
    found = lubricated()
    for c in found.columns.values:
        assert found.get_cell(1e-4, c).status is not Status.STABLE
        assert found.get_cell(5e-6, c).status is Status.STABLE
    assert found.get_cell(2e-5, 0.2e-3).status is not Status.STABLE
    assert found.find_stability_limit(0.2e-3) == 5e-6
    assert found.find_stability_limit(C) in (5e-6, 2e-5)  # at the brink: 2e-5 s times 1.4e5 1/s is 2.8


@needs_compiler
def test_dry_contact_is_less_accurate_with_the_papers_step() -> None:
    found = by_step("dry", [2e-6, 1e-4], [C], t_long=0.03)
    assert found.get_cell(2e-6, C).status is Status.STABLE
    assert found.get_cell(1e-4, C).error.force > 20 * found.get_cell(2e-6, C).error.force


@needs_compiler
def test_every_verdict_but_stable_has_its_reason() -> None:
    for cell in lubricated().cells:
        assert bool(cell.reason) == (cell.status is not Status.STABLE)
        assert cell.label
    line = describe_marked_step([lubricated()], 1e-4)
    assert len(line) == 1 and "2 inaccurate" in line[0] and "5 µs" in line[0]
    assert not describe_marked_step([lubricated()], None)


@needs_compiler
def test_soft_contact_is_outside_the_model_and_not_a_failure_of_the_step() -> None:
    found = by_step("dry", [5e-6], [C], t_long=0.02, t_short=0.02, parameters={"materials.aluminium.E": 2e7})
    cell = found.get_cell(5e-6, C)
    assert cell.status is Status.OUTSIDE and "clearance" in cell.reason
    assert cell.penetration > C / 2


@needs_compiler
def test_limits_decide() -> None:
    """The same runs judged by other limits."""
    work = SceneWindow(press("dry"), 9e-3)
    long, fine = work.run(rk4(1e-5)), work.run(rk4(1e-6))

    def status(**limits: float) -> Status:
        return classify_runs({}, long, [(long, fine)], Limits(**limits)).status

    assert status() is Status.STABLE
    assert status(force=1e-6) is Status.INACCURATE
    assert status(path=1e-9) is Status.INACCURATE
    assert status(energy=1e-15) is Status.INACCURATE
    assert status(phi=1e-18) is Status.INACCURATE
    assert status(closed=1e-18) is Status.INACCURATE
    assert status(lost=1e-15) is Status.DIVERGED
    assert status(half=1e-3) is Status.OUTSIDE
    assert status(thin=1e-6) is Status.OUTSIDE
    assert status(through=1e-6) is Status.DIVERGED


@needs_compiler
def test_run_that_nothing_vouches_for_is_not_stable() -> None:
    work = SceneWindow(press("dry"), 2e-3)
    run = work.run(rk4(1e-5))
    failed = Attempt(rk4(1e-6), None, "no longer finite", 1e-4)
    assert classify_runs({}, run, [(run, failed)]).status is Status.INACCURATE
    assert classify_runs({}, failed, [(run, run)]).status is Status.DIVERGED


@needs_compiler
def test_lost_contact_is_seen() -> None:
    """A run whose surfaces overlap while it counts as free: what a missed onset would look like."""
    from dataclasses import replace

    work = SceneWindow(press("dry"), 9e-3)
    run = work.run(rk4(1e-5))
    assert run.run is not None and run.run.state.any()
    blind = replace(run, run=replace(run.run, state=0 * run.run.state, stored={}))
    cell = classify_runs({}, blind, [(run, run)])
    assert cell.status is Status.DIVERGED and "missed contact" in cell.reason


def made(statuses: list[Status]) -> VerdictMap:
    steps = tuple(10.0 ** (k - 6) for k in range(len(statuses)))
    cells = tuple(Cell(rk4(h), {}, s, "", "", Error()) for h, s in zip(steps, statuses, strict=True))
    return VerdictMap("made", rk4(1e-6), Axis("step", steps, "s"), Axis("clearance", (C,), "m"), cells, 1.0)


def test_largest_stable_step_has_only_stable_ones_below() -> None:
    good, bad = Status.STABLE, Status.INACCURATE
    assert made([good, good, bad, good]).find_stability_limit(C) == pytest.approx(1e-5)
    assert math.isnan(made([bad, good]).find_stability_limit(C))
    assert made([good, good]).find_stability_limit(C) == pytest.approx(1e-5)


@pytest.mark.parametrize("c", [0.3e-3, 0.5e-3, 1e-3, 7.7e-5])
def test_axis_of_clearances_holds_the_files_own(c: float) -> None:
    found = list_default_clearances(c)
    assert c in [pytest.approx(x) for x in found]
    assert list(found) == sorted(set(found)) and len(found) >= 4
    assert c / 10 < found[0] and found[-1] < 5 * c


@needs_compiler
def test_axis_of_steps_starts_at_the_shortest_scene() -> None:
    steps = list_map_steps([press("lubricated"), press("dry")])
    assert steps[0] == pytest.approx(1e-6) and any(math.isclose(x, 1e-4) for x in steps)


@needs_compiler
def test_scene_without_freedom_has_no_step_to_choose() -> None:
    with pytest.raises(BadValueError, match="no degree of freedom"):
        compute_verdict_map(press("ideal"))


@needs_compiler
def test_clearance_beyond_the_radius_is_refused() -> None:
    with pytest.raises(BadValueError, match="radius"):
        by_step("dry", [1e-5], [0.02])


@needs_compiler
def test_scene_without_play_has_one_column() -> None:
    pendulum = gudgeon.load(PENDULUM, scene="ideal")
    found = compute_verdict_map(pendulum, [make_axis(pendulum, "step", [1e-3, 2e-1])], method="rk4", t_long=2.0)
    assert len(found.columns.values) == 1 and math.isnan(found.columns.values[0])
    assert found.get_cell(1e-3, math.nan).status is Status.STABLE
    assert found.get_cell(2e-1, math.nan).status is not Status.STABLE


@needs_compiler
def test_interruption_ends_all_threads() -> None:
    def stop(fraction: float, text: str) -> None:
        raise KeyboardInterrupt

    before = threading.active_count()
    with pytest.raises(KeyboardInterrupt):
        by_step("dry", [1e-6, 1e-5], [C, 2 * C], progress=stop)
    assert threading.active_count() == before


@needs_compiler
def test_tolerance_times_clearance_is_the_usual_map() -> None:
    found = compute_verdict_map(press("lubricated"), t_long=0.01, quick=True)
    assert found.rows.name == "rtol" and found.columns.name == "clearance" and not found.setting.has_fixed_step
    assert all(cell.status is Status.STABLE for cell in found.cells)
    assert found.get_cell(1e-8, C).error.path < found.get_cell(1e-6, C).error.path
    assert found.get_cell(1e-8, C).parameters == {"bearings.pin.clearance": C}


@needs_compiler
def test_two_axes_of_numbers_take_one_tolerance_and_give_what_runs_them_again() -> None:
    dry = press("dry")
    axes = [parse_axis(dry, "omega=20,60"), parse_axis(dry, "stiffness=1GPa..400GPa:2")]
    found = compute_verdict_map(dry, axes, t_long=0.02)
    assert found.columns.values == (20.0, 60.0) and found.rows.values == (1e9, 4e11)
    soft, hard = found.get_cell(1e9, 60.0), found.get_cell(4e11, 20.0)
    assert soft.status is Status.OUTSIDE and hard.status is Status.STABLE
    assert (
        hard.parameters == {"parameters.omega": 20.0, "materials.aluminium.E": 4e11} and hard.setting == found.setting
    )
    message = format_run_command("nine_bar_press", "dry", hard, 0.02)
    assert "--rtol 1e-08" in message and "--set parameters.omega=20.0" in message and message.endswith("--t-end 0.02")
    assert (
        format_run_command("x.yaml", "dry", hard, 0.02, laws=["my laws/soft.py"]).count(" --laws 'my laws/soft.py' ")
        == 1
    )


@needs_compiler
def test_axes_that_do_not_fit_are_refused() -> None:
    dry = press("dry")
    for axes, method in (
        ([make_axis(dry, "step", [1e-5])], "auto"),
        ([make_axis(dry, "rtol", [1e-5])], "rk4"),
        ([make_axis(dry, "rtol", [1e-5])] * 2, "auto"),
        ([make_axis(dry, "rtol", [0.0])], "auto"),
    ):
        with pytest.raises(BadValueError, match="axis|axes"):
            compute_verdict_map(dry, axes, method=method)
    for text in ("omega", "omega=2..1", "omega=1..2:x"):
        with pytest.raises(BadValueError, match="expected"):
            parse_axis(dry, text)
    with pytest.raises(BadValueError, match="no such parameter"):
        parse_axis(dry, "viscosity=1,2")
    with pytest.raises(UnknownNameError):
        parse_axis(dry, "omegga=1,2")


@needs_compiler
def test_groups_keep_the_ratios_of_their_numbers() -> None:
    gains = make_axis(press("dry"), "gains", [10.0])
    p = press("dry").p
    place = {slot.address: k for k, slot in enumerate(press("dry").source.parameters)}
    first, second = p[place["baumgarte.alpha"]], p[place["baumgarte.beta"]]
    assert gains.build_parameters(10.0) == {
        "baumgarte.alpha": 10.0,
        "baumgarte.beta": pytest.approx(10.0 * second / first),
    }
    assert parse_axis(press("dry"), "clearance=.05mm..1mm:3").values == pytest.approx(
        (5e-5, math.sqrt(5e-8), 1e-3), rel=1e-5
    )


@needs_compiler
def test_command_writes_map(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["map", PENDULUM, "--scene", "dry", "--quick", "--out", str(tmp_path)]
    app([*arguments, "--method", "rk4"], standalone_mode=False)
    with open(tmp_path / "double_pendulum_map.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["status"] for row in rows} <= {status.value for status in Status}
    assert len({row["step_or_tolerance"] for row in rows}) == 3
    assert (tmp_path / "double_pendulum_map.png").stat().st_size > 5_000
    assert "largest stable step" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("value", "text"), [(0.5, "50 %"), (0.049, "4.9 %"), (2e-3, "0.20 %"), (4e-7, "4e-7"), (math.nan, "–")]
)
def test_shares_in_words(value: float, text: str) -> None:
    assert format_fraction(value) == text


@pytest.mark.parametrize(("value", "text"), [(1e-4, "100 µs"), (2.5e-8, "25 ns"), (0.0098, "9.8 ms"), (2.0, "2 s")])
def test_steps_in_words(value: float, text: str) -> None:
    assert format_seconds(value) == text
