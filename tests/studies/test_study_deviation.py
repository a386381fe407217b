"""What runs deviate by from another scene: closed forms of a falling ball, runs made one by one, made once for all."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import InputError
from gudgeon.model.compiled import Array
from gudgeon.studies.ensemble import reference_series
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler

pytestmark = needs_compiler
G, M, K = 9.81, 0.092, 1.4e8  # of bouncing_ball
CRANK: dict[str, Any] = {
    "mechanism": "slider_crank",
    "scenes": ["ideal", "dry"],
    "parameters": {"c": ["0.1 mm", "0.3 mm"], "omega": ["300 rpm", "600 rpm"]},
    "starts": {"count": 3, "seed": 2, "relative": {"c": 0.01}},
    "t_end": "pi/omega",
    "output": 200,
    "windows": {"late": {"from": "t_end/2"}},
    "measures": {
        "x": {"deviation": "slider.x", "from": "ideal"},
        "v": {"rms": "slider.vx", "from": "ideal", "window": "late"},
        "a": {"deviation_of_steps": "slider.ax", "from": "ideal"},
        "least": {"min_of_steps": "slider.ax", "from": "ideal"},
        "force": {"peak_force": "wristpin"},
    },
    "keep": ["slider.x", "slider.vx"],
    "titles": {"dry": "loose"},
}


def test_a_ball_that_falls_and_one_that_hangs() -> None:
    """Without play it hangs at 0: the falling one deviates by g t²/2, its rate by g t, sqrt(2 g h) at the floor."""
    found = gudgeon.study(
        {
            "mechanism": "bouncing_ball",
            "scenes": "elastic",
            "parameters": {"height": ["1 m", "0.25 m"]},
            "t_end": "1.5 * sqrt(2*height/(9.81 m/s^2))",
            "output": 300,
            "windows": {"fall": {"to": "0.8 * sqrt(2*height/(9.81 m/s^2))"}},
            "measures": {
                "y": {"deviation": "ball.y", "from": "ideal", "window": "fall"},
                "v": {"deviation": "ball.vy", "from": "ideal", "window": "fall"},
                "most": {"deviation_of_steps": "ball.vy", "from": "ideal"},
                "mean": {"mean": "ball.vy", "from": "ideal", "window": "fall"},
            },
        }
    ).dataset
    height = found["height"].values
    fall = 0.8 * np.sqrt(2 * height / G)
    np.testing.assert_allclose(found["y"], G * fall**2 / 2, rtol=1e-9)
    np.testing.assert_allclose(found["v"], G * fall, rtol=1e-9)
    np.testing.assert_allclose(found["mean"], -G * fall / 2, rtol=1e-9)
    depth = (M * G / K) ** (2 / 3)  # there the contact carries its weight, and it grows no faster
    most = np.sqrt(2 * G * height + 2 * G * depth - 2 / M * K * depth**2.5 / 2.5)
    np.testing.assert_allclose(found["most"], most, rtol=1e-8)
    assert found["y"].attrs == {"units": "m", "long_name": "deviation of ball.y from scene ideal in window fall"}


def test_two_balls_are_the_same_until_they_touch() -> None:
    """Then one has its speed back, the other a share of it: what they differ by is known from each alone."""
    own = {"mechanism": "bouncing_ball", "t_end": "0.8 s", "output": 4000, "windows": {"fall": {"to": "0.45 s"}}}
    found = gudgeon.study(
        own
        | {
            "scenes": ["damped", "elastic"],
            "measures": {
                "fall": {"deviation": "ball.vy", "from": "elastic", "window": "fall"},
                "v": {"deviation": "ball.vy", "from": "elastic"},
                "steps": {"deviation_of_steps": "ball.vy", "from": "elastic"},
            },
        }
    ).dataset
    assert (found["fall"] == 0.0).all() and (found.sel(scene="elastic")[["v", "steps"]].to_array() == 0.0).all()
    runs = [gudgeon.load("bouncing_ball", scene).simulate(0.8, output=4000) for scene in ("damped", "elastic")]
    assert found["v"].sel(scene="damped") == np.abs(runs[0]["ball.vy"] - runs[1]["ball.vy"]).max()
    beside = gudgeon.load("bouncing_ball", "elastic")
    run = gudgeon.load("bouncing_ball", "damped").simulate(0.8, output=4000, peaks=["ball.vy"], against=beside)
    assert found["steps"].sel(scene="damped") == run.peak_error("ball.vy").abs


@pytest.fixture(scope="module")
def crank() -> gudgeon.Study:
    return gudgeon.study(CRANK)


def test_deviations_are_those_of_runs_made_one_by_one(crank: gudgeon.Study) -> None:
    """Also of numbers that the other scene has not, c, and of perturbed starts."""
    found = crank.dataset.sel(scene="dry")
    ideal, dry = (gudgeon.load("slider_crank", scene) for scene in ("ideal", "dry"))
    for c, omega, k in ((0, 0, 0), (1, 1, 2)):
        own = found.isel(c=c, omega=omega, start=k)
        numbers = {"omega": float(own["omega"]), "c": float(own["c"] + own["c"] * own["c.relative"])}
        end = math.pi / numbers["omega"]
        run = dry.simulate(end, output=200, parameters=numbers, peaks=["slider.ax"], against=ideal)
        beside = ideal.simulate(end, output=200, parameters=numbers)
        assert float(own["x"]) == pytest.approx(np.abs(run["slider.x"] - beside["slider.x"]).max(), rel=1e-9)
        off, t = run["slider.vx"] - beside["slider.vx"], run.t
        late = t >= end / 2 * (1 - 1e-12)
        rms = math.sqrt(np.trapezoid(off[late] ** 2, t[late]) / (t[late][-1] - t[late][0]))
        assert float(own["v"]) == pytest.approx(rms, rel=1e-9)
        error = run.peak_error("slider.ax")
        assert (float(own["a"]), float(own["least"])) == (error.abs, error.min)


def test_a_scenes_deviation_from_itself_is_none(crank: gudgeon.Study) -> None:
    own = crank.dataset.sel(scene="ideal")
    assert (own[["x", "v", "a"]].to_array() == 0.0).all() and own["force"].isnull().all()


def test_a_motion_that_is_followed_alone_is_that_of_a_whole_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without works and events, samples of positions and velocities are the same, accelerations to rounding."""
    study = CRANK | {
        "scenes": "dry",
        "keep": [],
        "measures": {"a": {"deviation": "slider.ax", "from": "ideal"}, "x": {"rms": "slider.x", "from": "ideal"}},
    }
    found = []
    ways: list[Any] = [reference_series._compute_kinematic_series, lambda *arguments: {}]
    for follow in ways:
        monkeypatch.setattr(reference_series, "_recent", reference_series.SeriesCache())
        monkeypatch.setattr(reference_series, "_compute_kinematic_series", follow)
        found.append(gudgeon.study(study).dataset)
    assert (found[0]["x"] == found[1]["x"]).all() and float(found[0]["x"].min()) > 0.0
    np.testing.assert_allclose(found[0]["a"], found[1]["a"], rtol=1e-12)


def test_the_other_scene_is_run_once_for_its_own_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two speeds decide the ideal crank; clearances and starts, which it does not read, do not."""
    made: list[Array] = []
    before = reference_series._compute_kinematic_series

    def count(job: Any, simulation: Any, alike: Any, runs: list[int], expected: list[str]) -> Any:
        made.extend(alike.columns["parameters.omega"][runs])
        return before(job, simulation, alike, runs, expected)

    monkeypatch.setattr(reference_series, "_compute_kinematic_series", count)
    monkeypatch.setattr(reference_series, "_recent", reference_series.SeriesCache())
    monkeypatch.setattr("gudgeon.studies.ensemble.resolve.MAX_BLOCK_RUNS", 5)
    found = gudgeon.study(CRANK | {"scenes": "dry", "keep": []})
    assert found.runs == 12 and sorted(made) == sorted({*found.dataset["omega"].values})
    monkeypatch.setattr(reference_series, "MAX_CACHE_BYTES", 0)
    monkeypatch.setattr(reference_series, "_recent", reference_series.SeriesCache())
    again = gudgeon.study(CRANK | {"scenes": "dry", "keep": []})
    np.testing.assert_array_equal(again.dataset["x"], found.dataset["x"])
    assert len(made) > 4


def test_what_the_other_scene_cannot_run_is_a_row_with_its_reason() -> None:
    """A rod 0.1 mm shorter than the crank passes by the play of its pin, 0.3 mm, and without it gets stuck."""
    found = gudgeon.study(
        {
            "mechanism": "slider_crank",
            "scenes": "dry",
            "t_end": "88 deg/omega",
            "output": 50,
            "zip": {"run": {"bodies.rod.length": ["49.9 mm", "120 mm"], "c": ["0.3 mm", "0.3 mm"]}},
            "measures": {"x": {"deviation": "slider.x", "from": "ideal"}, "force": {"peak_force": "wristpin"}},
        }
    )
    message = found.dataset["failure"].values
    assert message[0].startswith("scene ideal: ") and message[1] == "" and found.failed == 1
    assert any("70.1 mm from its guess" in note for note in found.notes), found.notes
    np.testing.assert_array_equal(found.dataset["x"].isnull(), [True, False])


@pytest.mark.parametrize(
    ("measure", "place", "words"),
    [
        ("{deviation: slider.x}", "4:15", "has no from"),
        ("{deviation: slider.x, from: idael}", "4:43", "idael"),
        ("{deviation: wristpin.e, from: ideal}", "4:27", "scene ideal: "),
        ("{impacts: wristpin, from: ideal}", "4:35", "is not a statistic of a series"),
        ("{deviation_of_steps: slider.x, from: ideal, window: late}", "4:67", "and has no window"),
        (
            "{deviation_of_steps: slider.x, from: ideal}, b: {max_of_steps: slider.x, from: dry}",
            "4:94",
            "subtract both scene",
        ),
    ],
)
def test_mistakes_are_told_at_their_place(measure: str, place: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    path.write_text(f"format: gudgeon-study/1\nmechanism: slider_crank\nscenes: dry\nmeasures: {{a: {measure}}}\n")
    with pytest.raises(InputError) as message:
        resolve_plans(path)
    assert str(message.value).startswith(f"{path}:{place}: ") and words in str(message.value), str(message.value)


def test_what_has_no_number_stands_in_no_legend_and_zeros_have_no_map(crank: gudgeon.Study) -> None:
    """The ideal scene has no force in a pin with play, and deviates from itself by nothing."""
    pytest.importorskip("matplotlib")
    from gudgeon.studies.show.study_data import StudyData
    from gudgeon.studies.show.study_page import _iterate_measure_figures

    plot: Any = crank.plot
    for ax, message in ((plot.measure("force", "c"), ["loose"]), (plot.measure("x", "c"), ["ideal", "loose"])):
        assert [word.get_text() for word in ax.get_legend().get_texts()] == message
    maps = [
        message
        for message, _ in _iterate_measure_figures(StudyData(crank))
        if message.startswith(("x:", "least:")) and "quart" not in message
    ]
    assert sorted(maps) == ["least: median, loose", "x: median, loose"]
    title = plot.heat_map("x", "c", "omega", at={"scene": "dry"}).get_title()
    assert " ".join(title.split()).endswith(": scene = loose")
