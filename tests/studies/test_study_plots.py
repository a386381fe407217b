"""Figures of a study beside NumPy on its dataset, and its sections beside a harmonic oscillator's closed form."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import gudgeon  # noqa: E402
from gudgeon.errors import BadValueError, UnknownNameError  # noqa: E402
from gudgeon.studies.show import study_plots  # noqa: E402
from gudgeon.studies.show.study_data import describe_changes  # noqa: E402
from gudgeon.studies.show.study_signals import find_values_at_crossings, have_equal_times, resample_over_fractions  # noqa: E402
from tests.programs import needs_compiler  # noqa: E402

pytestmark = needs_compiler
OSCILLATOR = """\
format: gudgeon/1
name: mass
parameters: {k: 100 N/m, x0: 0.1 m}
bodies: {load: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, load.origin], axis: [1, 0]}}
forces: {spring: {spring_damper: [ground.O, load.origin], stiffness: k, free_length: 1 m}}
start: {set: {load.x: 1 m + x0}}
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> gudgeon.Study:
    """x = 1 + x0 cos ωt, ω = √k; the amplitude is one of a Latin hypercube of nine."""
    folder = tmp_path_factory.mktemp("oscillator")
    (folder / "mass.yaml").write_text(OSCILLATOR, encoding="utf-8")
    return gudgeon.study(
        {
            "mechanism": str(folder / "mass.yaml"),
            "parameters": {"k": [100, 400, 900]},
            "zip": {"way": {"bodies.load.mass": ["1 kg", "4 kg"]}},
            "draw": {
                "count": 9,
                "seed": 2,
                "method": "latin_hypercube",
                "parameters": {"x0": {"from": "5 cm", "to": "20 cm"}},
            },
            "t_end": 2.0,
            "output": 400,
            "measures": {"far": {"max": "load.x"}, "fast": {"peak": "load.vx"}},
            "keep": ["load.x", "load.vx"],
        }
    )


def plots(study: gudgeon.Study) -> Any:
    """matplotlib's own types have too many forms."""
    return study.plot


def test_a_measure_over_a_parameter_has_quartiles(study: gudgeon.Study) -> None:
    ax = plots(study).measure("fast", "k", "way", published={250.0: 3.0})
    x, y = ax.lines[0].get_data()
    np.testing.assert_allclose(x, [100, 400, 900])
    expected = np.median(study.dataset["fast"].values[:, 0], axis=1)
    np.testing.assert_allclose(y, expected)
    np.testing.assert_allclose(y, np.median(study.dataset["x0"]) * np.sqrt([100, 400, 900]), rtol=1e-3)
    assert len(ax.collections) == 4  # quartiles and extremes of both masses
    low = ax.collections[1].get_paths()[0].vertices[:, 1]
    assert low.min() == pytest.approx(np.quantile(study.dataset["fast"].values[0, 0], 0.25))
    assert ax.lines[2].get_xydata().tolist() == [[250.0, 3.0]]


def test_over_words_there_are_bars_and_no_line(study: gudgeon.Study) -> None:
    """A zip's places have no order: medians are dots, bars reach from quartile to quartile and from end to end."""
    ax = plots(study).measure("fast", "way", at={"k": 400})
    assert ax.lines[0].get_linestyle() == "None"
    rows = study.dataset["fast"].values[1]
    expected = np.quantile(rows, (0.0, 1.0, 0.25, 0.75), axis=1).T
    ends = [[bar[:, 1] for bar in bars.get_segments()] for bars in ax.collections]
    np.testing.assert_allclose(np.hstack(ends), expected)
    np.testing.assert_allclose(ax.lines[0].get_ydata(), np.median(rows, axis=1))
    assert [word.get_text() for word in ax.get_xticklabels()] == ["1 kg", "4 kg"]


def test_a_long_zip_is_told_by_what_differs() -> None:
    """From what most of its places have; by all of its numbers where there is no such value."""
    columns: dict[tuple[str, ...], str] = {("1 kg", "1 kg", "2 kg", "1 kg"): "m", ("3 N", "3 N", "3 N", "5 N"): "F"}
    assert describe_changes(columns) == ["unchanged", "unchanged", "m = 2 kg", "F = 5 N"]
    assert describe_changes(columns | {("a", "a", "b", "b"): "c"}) == []


def test_samples_a_hundredth_apart_are_alike() -> None:
    """Ends that follow a number a millionth off; amplitudes of such runs stand over the same frequencies."""
    t = np.linspace(0.0, 2.0, 401)
    assert have_equal_times(np.array([t, t * (1 + 2e-6), t])) and have_equal_times(np.array([t, t * (1 + 2.4e-5)]))
    assert not have_equal_times(np.array([t, t * (1 + 2.6e-5)])) and not have_equal_times(
        np.array([t, np.append(t[:-1], np.nan)])
    )
    stopped = np.where(t < 1.0, t, np.nan)
    assert have_equal_times(np.array([stopped, stopped]))


def test_bands_are_quantiles_by_hand(study: gudgeon.Study) -> None:
    """Of nine sorted runs the third and the seventh are the quartiles, the fifth is the median."""
    ax = plots(study).bands("load.x", at={"k": 400, "way": 0})
    rows = np.sort(study.dataset["load.x"].values[1, 0], axis=0)
    np.testing.assert_allclose(ax.lines[0].get_ydata(), rows[4])
    quartiles = ax.collections[1].get_paths()[0].vertices
    at = np.flatnonzero(quartiles[:, 0] == study.dataset["time"].values[123])
    assert sorted(quartiles[at, 1])[:: len(at) - 1] == pytest.approx([rows[2, 123], rows[6, 123]])


def test_bands_over_shares_are_of_the_same_share_of_each_run(tmp_path: Path) -> None:
    """One turn of x = 1 + x0 cos ωt at 314, 157 and 105 samples: one line, to what chords leave of an arc; from any."""
    (tmp_path / "mass.yaml").write_text(OSCILLATOR, encoding="utf-8")
    turn: Any = gudgeon.study(
        {
            "mechanism": str(tmp_path / "mass.yaml"),
            "parameters": {"k": [400, 100, 900], "bodies.load.mass": ["1 kg", -1]},
            "t_end": "2*pi*sqrt(1 kg/k)",
            "output": "t_end/2 ms",
            "keep": ["load.x"],
        }
    )
    assert turn.dataset.sizes["sample"] == 315 and turn.failed == 3
    atol = 0.1 * (2 * np.pi / 105) ** 2 / 8 + 1e-9
    for at, samples in (({}, 315), ({"k": 900}, 106)):
        line = turn.plot.bands("load.x", share=True, at=at).lines[0]
        s, x = line.get_data()
        assert len(s) == samples and s[0] == 0.0 and s[-1] == 1.0
        np.testing.assert_allclose(x, 1.0 + 0.1 * np.cos(2 * np.pi * s), atol=atol)
    found: Any = resample_over_fractions(turn.dataset["t"].values, turn.dataset["load.x"])
    runs = found[1].values
    assert np.ptp(runs[:, 0], axis=0).max() < 2 * atol and np.isnan(runs[:, 1]).all()
    with pytest.raises(BadValueError, match="no run has a duration"):
        turn.plot.bands("load.x", share=True, at={"bodies.load.mass": -1})
    assert "over fractions of the run" in turn.report().to_html()


def test_a_map_of_two_dimensions_is_its_medians(study: gudgeon.Study) -> None:
    ax = plots(study).heat_map("far", "x0", "k", at={"way": 1})
    (image,) = ax.images
    np.testing.assert_allclose(image.get_array(), study.dataset["far"].values[:, 1])
    assert [tick.get_text() for tick in ax.get_yticklabels()] == ["100", "400", "900"]
    with pytest.raises(BadValueError, match="both x and y"):
        plots(study).heat_map("far", "k", "k")


def test_a_map_has_words_where_there_is_room(study: gudgeon.Study, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study_plots, "MAX_Y_TICKS", 2)
    monkeypatch.setattr(study_plots, "MAX_X_TICKS", 4)
    ax = plots(study).heat_map("far", "x0", "k", at={"way": 1})
    assert [tick.get_text() for tick in ax.get_yticklabels()] == ["100", "900"]
    assert list(ax.get_xticks()) == [0, 3, 6] and len(ax.images[0].get_array()[0]) == 9


def test_a_section_of_an_oscillator_is_a_point_a_run(study: gudgeon.Study) -> None:
    """Where x rises through its middle its rate is x0 ω; over the parameter k a dot a turn and amplitude."""
    ax: Any = plots(study).section("load.x", "load.x", "load.vx", level=1.0, at={"k": 400, "way": 0})
    x, rate = ax.lines[0].get_data()
    np.testing.assert_allclose(x, 1.0, atol=1e-9)
    apart = np.abs(rate[:, None] - 20 * study.dataset["x0"].values)
    assert apart.min(axis=1).max() < 5e-3 and (apart.min(axis=0) < 5e-3).all()
    dots = plots(study).bifurcation("load.vx", "k", "load.x", level=1.0, after=0.5, at={"way": 0}).lines[0]
    found = np.array(dots.get_xydata())
    turns = [int((np.sqrt(k) * 2.0 - 1.5 * np.pi) // (2 * np.pi) + 1) for k in (100, 400, 900)]
    early = [int((np.sqrt(k) * 0.5 - 1.5 * np.pi) // (2 * np.pi) + 1) for k in (100, 400, 900)]
    for k, all_turns, before in zip((100, 400, 900), turns, early, strict=True):
        own = found[found[:, 0] == k]
        assert len(own) == 9 * (all_turns - before)
        assert own[:, 1].max() == pytest.approx(float(study.dataset["x0"].max()) * np.sqrt(k), rel=1e-2)


def test_crossings_are_found_between_samples() -> None:
    t = np.linspace(0.0, 10.0, 401)
    (rising,) = find_values_at_crossings(t, np.sin(t), [t], 0.5, False, 0.0)
    np.testing.assert_allclose(rising, [np.pi / 6, np.pi / 6 + 2 * np.pi], atol=1e-4)
    (falling,) = find_values_at_crossings(t, np.sin(t), [t], 0.5, True, 3.0)
    np.testing.assert_allclose(falling, [5 * np.pi / 6 + 2 * np.pi], atol=1e-4)
    assert find_values_at_crossings(t, np.full(401, np.nan), [t], 0.0, False, 0.0)[0].size == 0


def test_curves_and_phases_have_a_colour_a_value(study: gudgeon.Study, tmp_path: Path) -> None:
    ax: Any = plots(study).overlay("load.x", "k", at={"way": 0})
    assert len(ax.lines) == 27 and len({line.get_color() for line in ax.lines}) == 3
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [f"k = {k} kg/s²" for k in (100, 400, 900)]
    phase = plots(study).phase("load.x", "load.vx", "k", at={"way": 0, "x0": 0.1})
    own = np.array(phase.lines[1].get_xydata())
    a = 0.5 * np.ptp(own[:, 0])
    np.testing.assert_allclose(((own[:, 0] - 1.0) / a) ** 2 + (own[:, 1] / (20 * a)) ** 2, 1.0, atol=1e-3)
    phase.figure.savefig(tmp_path / "x.svg")
    phase.figure.savefig(tmp_path / "x.png")
    given = plots(study).bands("load.x", "k", ax=phase)
    assert given is phase


def test_a_number_of_a_draw_picks_the_run_that_is_nearest(study: gudgeon.Study) -> None:
    x0 = study.dataset["x0"].values
    for k in (0, 5, 8):
        ax: Any = plots(study).overlay("load.x", at={"k": 390, "way": 1, "x0": float(x0[k]) + 1e-6})
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), study.dataset["load.x"].values[1, 1, k])
        assert ax.get_title().endswith(f"k = 400 kg/s², way = 4 kg, x0 = {x0[k]:.4g} m"), ax.get_title()


def test_names_that_do_not_exist_are_told(study: gudgeon.Study) -> None:
    for call in (
        lambda plot: plot.measure("fats"),
        lambda plot: plot.measure("fast", "kk"),
        lambda plot: plot.bands("load.y"),
        lambda plot: plot.bands("load.x", at={"c": 1.0}),
    ):
        with pytest.raises(UnknownNameError):
            call(plots(study))
    with pytest.raises(BadValueError, match="does not vary"):
        plots(study).measure("fast", "scene")
    with pytest.raises(UnknownNameError, match="stored no series 'load.y'"):
        study.to_dataframe("load.y")


def test_odd_arguments_are_told(study: gudgeon.Study) -> None:
    odd: list[tuple[str, tuple[Any, ...], dict[str, Any]]] = [
        ("measure", ("fast",), {"at": "k"}),
        ("bands", ("load.x",), {"at": np.zeros(2)}),
        ("measure", ("fast", "k"), {"published": 2}),
        ("measure", ("fast", "k"), {"published": "k"}),
        ("measure", ("fast", "k", "k"), {}),
        ("bands", ("load.x",), {"share": np.zeros(2)}),
    ]
    for name, given, options in odd:
        with pytest.raises(BadValueError, match=next(iter(options), "over and by")):
            getattr(study.plot, name)(*given, **options)
    assert "0.333333 Hz" in plots(study).low_pass("load.x", Fraction(1, 3)).get_title()


def test_spectra_have_the_amplitude_and_the_frequency(study: gudgeon.Study) -> None:
    """x0 cos ωt over whole turns: all of it is in the line at ω/2π, which flattop reads to 0.1 %."""
    ax: Any = plots(study).spectrum("load.x", "k", window="flattop", at={"way": 0})
    assert len(ax.lines) == 3 and ax.get_xlabel() == "f [Hz]"
    for line, k in zip(ax.lines, (100, 400, 900), strict=True):
        f, amplitude = line.get_data()
        assert abs(f[np.argmax(amplitude)] - np.sqrt(k) / (2 * np.pi)) <= 0.5 * (f[1] - f[0]) + 1e-12
        x0 = float(np.median(study.dataset["x0"]))
        assert amplitude[1:].max() == pytest.approx(x0, rel=0.15 if k == 100 else 0.02)  # three turns, and more
    low = ax.collections[0].get_paths()[0].vertices[:, 1]
    assert low.max() == pytest.approx(float(study.dataset["x0"].max()), rel=0.15)
    with pytest.raises(BadValueError, match="window"):
        plots(study).spectrum("load.x", window="none")


def test_a_low_pass_of_every_run(study: gudgeon.Study) -> None:
    """As scipy makes it of one run; Butterworth's gain 1/√(1 + (ω/ω_c)⁴) at twice its cutoff is 1/√17."""
    from gudgeon.results.signals import apply_low_pass

    own = study.dataset["load.x"].isel(k=2, way=0)
    cutoff = 30.0 / (4 * np.pi)
    ax: Any = plots(study).low_pass("load.x", cutoff, "k", at={"way": 0})
    assert len(ax.lines) == 27 and "low-pass 2.387" in ax.get_title()
    t = study.dataset["time"].values
    np.testing.assert_allclose(ax.lines[-1].get_ydata(), apply_low_pass(t, own[-1].values, cutoff))
    late = ax.lines[-1].get_ydata()[t > 1.0]
    assert np.ptp(late) / 2 / float(study.dataset["x0"][-1]) == pytest.approx(1 / np.sqrt(17), rel=0.02)
