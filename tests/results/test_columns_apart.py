"""What was given to the runs of a batch and series of the same name stand in columns of their own."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

import gudgeon
from tests.programs import needs_compiler

BAR = """\
format: gudgeon/1
name: names_twice
gravity: [0, -9.81]
bodies:
  gravity: {length: 0.3, mass: 0.4, inertia: auto}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, gravity.tail]}}
"""


@needs_compiler
def test_a_body_whose_series_is_called_as_what_is_given(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    (tmp_path / "bar.yaml").write_text(BAR, encoding="utf-8")
    batch = gudgeon.load(tmp_path / "bar.yaml").simulate_many({"gravity.y": [-9.81, -1.0]}, 0.1, output=2)
    table = batch.to_dataframe()
    assert sorted(set(table["given.gravity.y"])) == [-9.81, -1.0]
    assert table["gravity.y"].tolist() == batch["gravity.y"].ravel().tolist()
    dataset = batch.to_xarray()
    assert dataset["given.gravity.y"].values.tolist() == [-9.81, -1.0]
    batch.to_csv(tmp_path / "table.csv")
    with (tmp_path / "table.csv").open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert [float(row["given.gravity.y"]) for row in rows[:3]] == [-9.81] * 3


@needs_compiler
def test_an_output_that_is_called_run(tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    (tmp_path / "bar.yaml").write_text(BAR + "outputs: {run: 2*gravity.theta}\n", encoding="utf-8")
    batch = gudgeon.load(tmp_path / "bar.yaml").simulate_many([{}] * 2, 0.1, output=2)
    table = batch.to_dataframe()
    assert table["run"].tolist() == [0, 0, 0, 1, 1, 1]
    assert table["output.run"].tolist() == batch["run"].ravel().tolist()
    assert batch.to_xarray(["run"])["output.run"].values.tolist() == batch["run"].tolist()


def test_an_output_called_like_its_parameter_or_like_a_dimension(tmp_path: Path) -> None:
    """In an output's expression a parameter wins; files of runs and batches have the output under its name."""
    file = tmp_path / "m.yaml"
    file.write_text(
        "format: gudgeon/1\nname: m\nparameters: {row: 3 m, run: 2 m}\n"
        "bodies: {bob: {mass: 1 kg, inertia: 0.1 kg*m^2}}\nground: {O: [0, 0]}\n"
        "joints: {pin: {revolute: [ground.O, bob.origin]}}\nstart: {set: {bob.theta: 0}}\nfreedoms: 1\n"
        "outputs: {row: 2*row + bob.x, run: run*row, number: row}\n"
    )
    simulation = gudgeon.load(file)
    run = simulation.simulate(output=[0.1, 0.2])
    batch = simulation.simulate_many({"row": [3.0, 4.0]}, output=[0.1, 0.2])
    batch.save(tmp_path / "batch.nc")
    again = gudgeon.Batch.load(tmp_path / "batch.nc")
    assert run["row"].tolist() == [6.0, 6.0] and run["run"].tolist() == [6.0, 6.0] and run.unit("run") == "m^2"
    for name, values in (("row", [6.0, 8.0]), ("run", [6.0, 8.0]), ("number", [3.0, 4.0])):
        assert batch[name][:, 1].tolist() == again[name][:, 1].tolist() == values
