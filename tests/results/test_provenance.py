"""A saved run records version, platform, compiler, date and the mechanism's text, and only the date differs."""

from __future__ import annotations

import platform
from dataclasses import replace
from pathlib import Path

import pytest

import gudgeon
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from tests.programs import needs_compiler

h5py = pytest.importorskip("h5py")
pytestmark = needs_compiler
TEXT = """\
format: gudgeon/1
name: ball
freedoms: 3
bodies: {bob: {mass: 1 kg, inertia: 1 kg*m^2}}
# δ: a remark stays
"""


def ball(folder: Path) -> gudgeon.Simulation:
    (folder / "ball.yaml").write_text(TEXT, encoding="utf-8")
    return gudgeon.load(folder / "ball.yaml")


def test_a_saved_run_says_where_it_comes_from(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    simulation = ball(tmp_path)
    (tmp_path / "ball.yaml").write_text("edited", encoding="utf-8")
    run = simulation.simulate(0.1, output=2)
    run.save(tmp_path / "run.nc")
    with h5py.File(tmp_path / "run.nc") as file:
        found = {name: text.decode() for name, text in file["provenance"].attrs.items()}
    assert found == run.provenance == Result.load(tmp_path / "run.nc").provenance
    assert found["version"] == gudgeon.__version__ and platform.machine() in found["platform"]
    assert found["date"] == "1970-01-02T00:00:00+00:00" and found["mechanism"] == TEXT
    assert any(word in found["compiler"].lower() for word in ("gcc", "cc", "clang"))


def test_the_date_is_that_of_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs of two days are the same but for their date; what is saved twice is the same file."""
    simulation, runs = ball(tmp_path), []
    for day in ("0", "86400"):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", day)
        runs.append(simulation.simulate(0.1, output=2))
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    one, other = (run.provenance for run in runs)
    assert one | {"date": ""} == other | {"date": ""} and one["date"] != other["date"]
    same = replace(runs[1], diagnostics=runs[0].diagnostics, provenance=one)
    for name, run in (("one", runs[0]), ("twice", runs[0]), ("same", same)):
        run.save(tmp_path / name)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "twice").read_bytes() == (tmp_path / "same").read_bytes()
    assert simulation.simulate(0.1, output=2).provenance["date"] > "2026"


def test_a_batch_and_an_output_of_that_name(tmp_path: Path) -> None:
    simulation = ball(tmp_path)
    batch = simulation.simulate_many([{}, {}], 0.1, output=2)
    batch.save(tmp_path / "batch.nc")
    again = Batch.load(tmp_path / "batch.nc")[1].provenance
    assert again | {"date": ""} == batch[1].provenance | {"date": ""} and again["date"]
    run = simulation.simulate(0.1, output=2)
    odd = replace(run, source=replace(run.source, outputs={"provenance": ["*", 2.0, "t"]}), stored={})
    odd.save(tmp_path / "odd.nc")
    assert Result.load(tmp_path / "odd.nc")["provenance"].tolist() == (2 * run.t).tolist()
