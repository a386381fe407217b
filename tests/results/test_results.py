"""Names, units and series of a result against what they mean."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError, UnknownNameError
from gudgeon.language.output_units import derive_unit, parse_exponents
from gudgeon.language.tree import from_json
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.results.results import Result


def test_a_body_is_read_from_its_columns(run: Result) -> None:
    for axis, names in enumerate((("x", "vx", "ax"), ("y", "vy", "ay"), ("theta", "omega", "alpha"))):
        for name, array in zip(names, (run.q, run.v, run.a), strict=True):
            np.testing.assert_array_equal(run[f"S9.{name}"], array[:, 3 + axis])


def test_a_point_moves_as_the_crank_carries_it(run: Result) -> None:
    """L1's head is at 80 mm on a crank that turns with ω about the origin (p[3] = L/2 from the centre)."""
    w, t, length = 2 * np.pi, run.t, 0.08
    cos, sin = np.cos(w * t), np.sin(w * t)
    exact = {
        "x": length * cos,
        "y": length * sin,
        "vx": -w * length * sin,
        "vy": w * length * cos,
        "ax": -(w**2) * length * cos,
        "ay": -(w**2) * length * sin,
    }
    for name, values in exact.items():
        np.testing.assert_allclose(run[f"L1.head.{name}"], values, rtol=0, atol=1e-13)
        np.testing.assert_allclose(run[f"L1.tail.{name}"], 0.0, rtol=0, atol=1e-13)


def test_a_point_of_the_ground_rests_and_a_point_at_the_centre_of_mass_is_the_body(run: Result) -> None:
    np.testing.assert_array_equal(run["ground.O1.x"], np.full(run.t.shape, 0.08))
    assert "ground.O1.vx" not in run
    np.testing.assert_array_equal(run["S9.origin.ay"], run["S9.ay"])


def test_point_velocities_are_the_derivatives_of_positions(make: object) -> None:
    run = make("dry", samples=20001)  # type: ignore[operator]
    for axis in "xy":
        for low, high in ((axis, f"v{axis}"), (f"v{axis}", f"a{axis}")):
            rate = np.gradient(run[f"L1.head.{low}"], run.t, edge_order=2)
            np.testing.assert_allclose(rate, run[f"L1.head.{high}"], atol=2e-4)


def test_forces_are_evaluated_once_and_only_when_asked_for(run: Result) -> None:
    calls = run.compiled.calls  # type: ignore[union-attr]
    _ = run["S9.y"], run["L1.head.x"], run["A.state"], run["work.drives"]
    assert calls == []
    _ = run["A.Fx"], run["guide.M"], run["crank.torque"], run["energy.kinetic"], run["lambda.guide.offset"]
    assert calls == [len(run.t)]


def test_forces_of_joints(run: Result, ideal: Result) -> None:
    for result in (run, ideal):
        np.testing.assert_array_equal(result["A.F"], np.hypot(result["A.Fx"], result["A.Fy"]))
    np.testing.assert_array_equal(ideal["A.M"], ideal.evaluation.reactions[:, 1, 2])
    np.testing.assert_allclose(run["A.delta"], np.hypot(run["A.ex"], run["A.ey"]) - 0.3e-3, atol=1e-18)
    np.testing.assert_allclose(run["A.eps"] * 0.3e-3, run["A.e"])
    assert run["A.state"].dtype == np.int8
    assert "A.Fn" not in ideal and "A.M" not in run


def test_energy_residual_is_energy_less_its_start_less_work(run: Result) -> None:
    energy = run["energy.kinetic"] + run["energy.potential"]
    np.testing.assert_allclose(run["energy.residual"], energy - energy[0] - run.work.sum(1), atol=1e-15)


def test_outputs_know_series_parameters_and_units(run: Result) -> None:
    np.testing.assert_allclose(run["lift"], run["S9.y"] + 0.08)
    np.testing.assert_allclose(run["speed"], np.full(run.t.shape, 2 * np.pi * 0.04))
    assert (run.unit("lift"), run.unit("speed")) == ("m", "m/s")


def test_an_unknown_name_names_the_nearest(run: Result) -> None:
    with pytest.raises(UnknownNameError, match=r"S9\.y"):
        run["S9.yy"]
    with pytest.raises(UnknownNameError, match=r"parameters\[\"omega\"\]"):
        run["omega"]
    with pytest.raises(UnknownNameError, match="no series 0"):
        run[0]  # type: ignore[index]


def test_names_are_listed_like_those_of_a_mapping(run: Result) -> None:
    """Python asked for run[0] instead: a TypeError from within."""
    assert list(run) == list(run.names)
    assert "S9.y" in run
    assert "S9.yy" not in run


def test_every_listed_name_can_be_read_and_has_one_number_a_sample(run: Result, ideal: Result) -> None:
    for result in (run, ideal):
        for name, unit in result.names.items():
            assert result[name].shape == result.t.shape
            assert result.unit(name) == unit
            assert result.meaning(name)
        assert len(set(result.names)) == len(result.names)


def test_series_cannot_be_changed(run: Result) -> None:
    for name in ("S9.y", "A.F", "lift"):
        with pytest.raises(ValueError):
            run[name][0] = 1.0


def test_parameters_and_constants_by_name(run: Result) -> None:
    assert run.parameters["parameters.omega"] == run.parameters["omega"] == 2 * np.pi
    assert run.parameters["bodies.L1.length"] == 0.08
    assert dict(run.constants) == {"A.c": 0.3e-3, "A.K": 1e10}


def test_final_is_the_last_sample_with_the_overrides(run: Result) -> None:
    final = run.final
    assert (final.t, final.scene, dict(final.parameters)) == (1.0, "dry", {"parameters.c": 0.3e-3})
    np.testing.assert_array_equal(final.q, run.q[-1])
    final.q[0] = 7.0
    assert run.q[-1, 0] != 7.0


def test_without_a_compiled_model_forces_are_refused_with_a_reason(stripped: Result) -> None:
    assert stripped["S9.y"].shape == stripped.t.shape
    with pytest.raises(GudgeonError, match="run the scene again"):
        stripped["A.F"]


@pytest.mark.parametrize(
    ("tree", "unit"),
    [
        (["*", 2.0, "x"], "m"),
        (["/", "x", "t"], "m/s"),
        (["**", "x", 2.0], "m^2"),
        (["sqrt", ["*", "x", "x"]], "m"),
        (["*", "F", "x"], "J"),
        (["/", "F", "x"], "N/m"),
        (["*", "F", ["/", "x", "t"]], "W"),
        (["cos", "a"], ""),
        (["*", "w", "x"], "m/s"),
        (["atan2", "x", "x"], "rad"),
        (["+", 1.0, "x"], "m"),
        (["abs", ["-", "x"]], "m"),
        (["**", "x", "x"], ""),
        (["/", 1.0, "t"], "1/s"),
        (["hypot", "x", "x"], "m"),
        (["*", "w", "t"], "rad"),
    ],
)
def test_units_of_expressions(tree: object, unit: str) -> None:
    units = {"x": "m", "t": "s", "F": "N", "a": "rad", "w": "rad/s"}
    assert derive_unit(from_json(tree), units.get) == unit


def test_units_are_read_as_products_of_powers() -> None:
    assert parse_exponents("kg*m^2/s^2") == parse_exponents("N*m") == parse_exponents("J")
    with pytest.raises(ValueError):
        parse_exponents("furlong")


def test_an_output_of_play_is_left_out_where_there_is_none(tmp_path: Path) -> None:
    text = find_shipped_file("slider_crank").read_text(encoding="utf-8")
    joint = next(iter(gudgeon.load("slider_crank", "dry").source.clearances)).name
    file = tmp_path / "slider.yaml"
    file.write_text(text.partition("\noutputs:")[0] + f"\noutputs: {{press: 2 * {joint}.Fn, twice: 2 * t}}\n")
    run = gudgeon.load(file, "ideal").simulate(0.01, output=4)
    assert run["twice"] == pytest.approx(2 * run.t)
    assert "press" not in run.names
    with pytest.raises(UnknownNameError, match=f"output 'press' needs {joint}.Fn"):
        run["press"]
    run.save(tmp_path / "run.nc")
    assert "press" in gudgeon.load(file, "dry").simulate(1e-4, output=4).names
