"""Drawings of runs: places, paths and arrows against the series of the run."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.drawing.drives_and_forces import ARROW_LENGTH  # noqa: E402
from gudgeon.drawing.labels import NameLabels, count_crossings  # noqa: E402
from gudgeon.errors import BadValueError, UnknownNameError  # noqa: E402
from gudgeon.results.figures import plots  # noqa: E402
from gudgeon.results.figures.configurations import compute_configuration, evaluate_loads  # noqa: E402
from gudgeon.results.figures.mechanism_plots import draw_sketch_at_time  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402


@pytest.fixture(scope="module")
def press() -> Result:
    return gudgeon.load("nine_bar_press", "dry").simulate(0.05, output=100)


@pytest.fixture(scope="module")
def four_bar() -> Result:
    return gudgeon.load("four_bar").simulate(1.0, output=200)


def by_gid(ax: Any) -> dict[str, Any]:
    return {artist.get_gid(): artist for artist in ax.get_children() if artist.get_gid()}


@pytest.mark.parametrize("k", [0, 37, 100])
def test_pins_lie_where_the_run_says(press: Result, k: int) -> None:
    found = by_gid(press.plot.mechanism(float(press.t[k])))
    pins = {"O4": "L4.tail", "P2": "L7.tail", "Q6": "L6.head", "slider": "S9.origin"}
    for joint, point in pins.items():
        own = [artist for name, artist in found.items() if re.fullmatch(rf"joint-{joint}(-\d+)?", name)]
        circles = [artist for artist in own if hasattr(artist, "center")]
        assert circles[-1].center == pytest.approx((press[f"{point}.x"][k], press[f"{point}.y"][k]), abs=1e-12)
    inset = [a for gid, a in found.items() if gid.startswith("inset-A") and hasattr(a, "center")]
    hole, journal = inset[1], inset[3] if inset[2].get_linestyle() == "--" else inset[2]
    c, e = press.constants["A.c"], np.array([press["A.ex"][k], press["A.ey"][k]])
    gap = hole.get_radius() - journal.get_radius()
    assert (np.array(journal.center) - hole.center) / gap == pytest.approx(e / c, abs=1e-9)


def test_between_samples_the_error_falls_with_the_fourth_power_of_their_distance() -> None:
    """Of what is free: against samples at that very time."""
    simulation, errors = gudgeon.load("pendulum"), []
    for count in (20, 40, 80):
        run = simulation.simulate(1.0, output=count, rtol=1e-12)
        middles = (run.t[1:] + run.t[:-1]) / 2
        exact = simulation.simulate(output=[0.0, *middles], rtol=1e-12).q[1:]
        drawn = [compute_configuration(run, float(t)).q for t in middles]
        errors.append(np.abs(np.array(drawn) - exact).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 4.0, atol=0.3)


def test_joints_stay_together_between_coarse_samples(four_bar: Result) -> None:
    """What drives determine is where the linkage is at that very time, four samples a turn or not."""
    simulation = gudgeon.load("four_bar")
    run = simulation.simulate(1.0, output=9)
    for t in (0.03, 0.17, 0.555):
        exact = simulation.simulate(output=[0.0, t])
        np.testing.assert_allclose(compute_configuration(run, t).q, exact.q[-1], atol=1e-12)


def test_the_rate_between_samples_is_that_of_the_place(four_bar: Result) -> None:
    t, h = 0.2525, 1e-6
    before, at, after = (compute_configuration(four_bar, t + shift) for shift in (-h, 0.0, h))
    assert at.v is not None
    np.testing.assert_allclose(at.v, (after.q - before.q) / (2 * h), rtol=1e-6, atol=1e-7)


def test_a_path_is_the_series(four_bar: Result) -> None:
    ax = four_bar.plot.path("coupler.tracer", ["rocker"])
    found = by_gid(ax)
    for name in ("coupler.tracer", "rocker"):
        x, y = found[f"path-{name}"].get_data()
        assert (x == four_bar[f"{name}.x"]).all() and (y == four_bar[f"{name}.y"]).all()
        low, high = ax.get_xlim(), ax.get_ylim()
        assert low[0] < x.min() and x.max() < low[1] and high[0] < y.min() and y.max() < high[1]
    assert {"body-crank", "joint-A0", "drive-motor"} <= set(found)


@pytest.mark.parametrize(
    "points",
    [
        np.array(["coupler.tracer", "", "rocker"])[::2],
        np.array(["coupler.tracer", "rocker"], object),
        {"coupler.tracer": 1, "rocker": 2}.keys(),
        ("coupler.tracer", "rocker"),
    ],
)
def test_points_are_named_by_any_sequence(points: Any, four_bar: Result) -> None:
    found = by_gid(four_bar.plot.path(points))
    assert {"path-coupler.tracer", "path-rocker"} == {name for name in found if name.startswith("path-")}


def test_arrows_are_the_series_to_the_scale_that_is_drawn(press: Result) -> None:
    k = 60
    ax = press.plot.mechanism(float(press.t[k]), velocities=True, forces=True)
    found = by_gid(ax)
    (names,) = [artist for artist in ax.get_children() if isinstance(artist, NameLabels)]
    message = {label.part: label.text for label in names.sketch.labels}
    for role, on, unit, letter, of_these in (
        ("velocity", "", "m/s", "v", ("L1.head", "L7.com", "L8.head")),
        ("reaction", " on the second body", "N", "F", ("O1", "Q8", "slider", "B")),
    ):
        expected = {name: [press[f"{name}.{letter}{axis}"][k] for axis in "xy"] for name in of_these}
        stands, of = re.fullmatch(rf"{role}{on}: ([\d.]+) (m?{unit})", message[f"scale {role}"]).groups()  # type: ignore[union-attr]
        tail, tip = found[f"scale-{role}"].get_xy()[0], found[f"scale-{role}-2"].get_xy()[0]
        metres = np.hypot(*(tip - tail)) / (float(stands) * (1e-3 if of.startswith("m") and of != "m/s" else 1.0))
        for name, vector in expected.items():
            if f"{role}-{name}" in found:
                span = found[f"{role}-{name}-2"].get_xy()[0] - found[f"{role}-{name}"].get_xy()[0]
                assert span == pytest.approx(np.array(vector) * metres, rel=1e-9, abs=1e-12), name
            else:
                assert np.hypot(*vector) * metres < 1e-3


@pytest.fixture(scope="module")
def pushed() -> Result:
    return gudgeon.load("slider_crank_spring").simulate(0.5, output=50)


def test_applied_forces_are_to_the_scale_of_reactions(pushed: Result) -> None:
    """Both against the series, by the arrow of a round number; without reactions a force has one length."""
    ax = pushed.plot.mechanism(float(pushed.t[20]), forces=True)
    found = by_gid(ax)
    (names,) = [artist for artist in ax.get_children() if isinstance(artist, NameLabels)]
    message = {label.part: label.text for label in names.sketch.labels}["scale reaction"]
    stands, unit = re.fullmatch(r"reaction on the second body, applied force: ([\d.]+) (m?N)", message).groups()  # type: ignore[union-attr]
    length = np.hypot(*(found["scale-reaction-2"].get_xy()[0] - found["scale-reaction"].get_xy()[0]))
    metres = length / (float(stands) * (1e-3 if unit == "mN" else 1.0))
    for gid, series in (("force-push", "push"), *((f"reaction-{joint}", joint) for joint in ("O", "slider"))):
        span = found[f"{gid}-2"].get_xy()[0] - found[gid].get_xy()[0]
        assert span == pytest.approx([metres * pushed[f"{series}.F{axis}"][20] for axis in "xy"], rel=1e-9, abs=1e-12)
    plain = by_gid(pushed.plot.mechanism(float(pushed.t[20])))
    shaft = plain["force-push-2"].get_xy()[0] - plain["force-push"].get_xy()[0]
    assert np.hypot(*shaft) == pytest.approx(ARROW_LENGTH * names.sketch.unit)


def test_a_force_has_an_arrow_in_every_drawing_of_a_run(pushed: Result) -> None:
    picture: Any = plots.draw_run_figure({"ideal": pushed}, pushed, ["rod.x"])
    (drawn,) = [ax for ax in picture.get_axes() if "body-rod" in by_gid(ax)]
    assert drawn.get_title() == "t = 0 s"
    scene = gudgeon.load("slider_crank_spring")
    for found in (by_gid(drawn), by_gid(pushed.plot.path("rod.tip"))):
        assert {"force-push", "force-push-2"} <= set(found)  # a shaft and a head
    start = scene.start()
    (push,) = evaluate_loads(scene.source, scene.p, start.q, start.v).values()
    assert push == pytest.approx((pushed["push.Fx"][0], pushed["push.Fy"][0])) == (1.0, 0.0)


def test_a_paths_legend_lies_beside_the_drawing(four_bar: Result) -> None:
    ax = four_bar.plot.path("coupler.tracer", "rocker")
    assert "t\u00a0=\u00a00\u00a0s" in ax.get_title()  # one word, wherever the title is folded
    figure: Any = ax.figure
    figure.draw_without_rendering()
    legend: Any = ax.get_legend()
    ends = [text.get_window_extent().x1 for text in legend.get_texts()]
    assert legend.get_window_extent().x0 >= ax.get_window_extent().x1 and max(ends) <= figure.bbox.x1


def test_what_cannot_be_drawn_is_told(four_bar: Result) -> None:
    for requested, kind, message in (
        (lambda: four_bar.plot.mechanism(None), BadValueError, "t is None: expected a time"),  # type: ignore[arg-type]
        (lambda: four_bar.plot.mechanism(2.0), BadValueError, "of the run, 0 s to 1 s"),
        (lambda: four_bar.plot.mechanism("0.1 kg"), gudgeon.InputError, "time"),
        (lambda: four_bar.plot.mechanism(float("nan")), BadValueError, "not a finite number"),
        (lambda: four_bar.plot.mechanism(0.1, forces=1), BadValueError, "forces is 1"),  # type: ignore[arg-type]
        (lambda: four_bar.plot.path(), BadValueError, "at least one name of a point"),
        (lambda: four_bar.plot.path("coupler.trace"), UnknownNameError, "nearest: coupler.tracer"),
        (lambda: four_bar.plot.path("ground.A0"), UnknownNameError, "that moves"),
        (lambda: four_bar.plot.path(3), BadValueError, "points is 3: expected the name of a point"),  # type: ignore[arg-type]
        (lambda: four_bar.plot.path([["rocker"]]), BadValueError, "points is list"),  # type: ignore[list-item]
    ):
        with pytest.raises(kind, match=message):
            requested()
    axes = four_bar.plot.mechanism("250 ms")
    title = f"{four_bar.source.title}: {four_bar.source.scene}, t = 0.25 s"  # what `gudgeon draw` puts above it
    assert " ".join(axes.get_title().split()) == title and four_bar.plot.mechanism(0.1, ax=axes) is axes


def test_a_file_of_a_run_is_drawn_as_the_run_is(press: Result, tmp_path: Path) -> None:
    press.save(tmp_path / "press.nc")
    pictures = []
    for run in (press, Result.load(tmp_path / "press.nc")):
        axes: Any = run.plot.mechanism(0.02, forces=True)
        plots.save_figure(axes.figure, tmp_path / "x.png")
        pictures.append((tmp_path / "x.png").read_bytes())
    assert pictures[0] == pictures[1]


def test_the_figure_of_a_command_shows_the_mechanism(press: Result, tmp_path: Path) -> None:
    picture: Any = plots.draw_run_figure({"dry": press}, press, ["S9.y"])
    drawn = [ax for ax in picture.get_axes() if "body-L7" in by_gid(ax)]
    assert len(drawn) == 1
    plots.save_figure(picture, tmp_path / "x.png")
    (names,) = [artist for artist in drawn[0].get_children() if isinstance(artist, NameLabels)]
    assert {f"joint {name}" for name in ("A", "guide", "P2")} <= set(names.boxes)


def test_walls_stand_still() -> None:
    """What a spring and a cylinder hold on the ground lies where it lay, across the mean of their motion."""
    for name, part in (("andrews_squeezer", "force spring"), ("cylinder_boom", "drive cylinder")):
        run = gudgeon.load(name).simulate()
        shapes = [draw_sketch_at_time(run, share * float(run.t[-1])).shapes for share in (0.0, 0.37, 1.0)]
        walls = [next(one.points for one in own if (one.part, one.role) == (part, "rail")) for own in shapes]  # type: ignore[union-attr]
        assert np.ptp(walls, axis=0).max() < 1e-12, name
        fixed, moving = sorted(
            next(one.ends for one in run.source.parts if one.name == part.split()[1]),
            key=lambda end: not end.startswith("ground"),
        )
        configurations = [compute_configuration(run, float(t)) for t in run.t[:: max(1, len(run.t) // 20)]]
        spans = [
            configuration.get_position(moving) - configuration.get_position(fixed) for configuration in configurations
        ]
        mean = np.mean([span / np.hypot(*span) for span in spans], axis=0)
        across = walls[0][1] - walls[0][0]
        assert abs(float(across @ mean)) < 0.05 * float(np.hypot(*across)), name


def test_no_line_leads_under_a_name() -> None:
    """From the screw of the landing gear past the crosshead and its way."""
    run = gudgeon.load("landing_gear").simulate(1.0)
    for t in np.linspace(0.0, 1.0, 6):
        ax: Any = run.plot.mechanism(float(t))
        ax.figure.draw_without_rendering()
        names = next(artist for artist in ax.get_children() if isinstance(artist, NameLabels))
        leads: Any = names.leader_lines
        for line in leads:
            segment = line.get_xydata().reshape(1, 4)
            inner = [np.array(box) + [1.0, 1.0, -1.0, -1.0] for box in names.boxes.values()]
            assert sum(count_crossings(box, segment) for box in inner) == 0, t


def test_a_title_fits_a_narrow_figure() -> None:
    figure: Any = gudgeon.load("shaker").simulate(0.01).plot.mechanism().figure
    figure.draw_without_rendering()
    box = figure.axes[0].title.get_window_extent()
    assert 0.0 <= box.x0 < box.x1 <= figure.bbox.x1 and "\u00a0=\u00a0" in figure.axes[0].get_title()
