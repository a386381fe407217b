"""Parts of a study file: each is the study that it would be alone, in its own folder; all their mistakes at once."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import xarray as xr

import gudgeon
from gudgeon.errors import GudgeonError, InputError, InputErrors
from gudgeon.studies.ensemble.study import resolve_plans
from tests.programs import needs_compiler
from tests.pump import Gudgeon

pytestmark = needs_compiler
TEXT = """\
format: gudgeon-study/1
title: two parts
mechanism: pendulum
t_end: 10 ms
output: 5
measures: {y: {final: bob.y}}
parts:
  planets:
    parameters: {g: [1.62, 9.81]}
  lengths:
    title: of rods
    parameters: {length: [1 m, 2 m, 3 m]}
    t_end: 20 ms
    measures: {x: {final: bob.x}}
    keep: [bob.y]
"""
ALONE = {
    "title": "of rods",
    "mechanism": "pendulum",
    "parameters": {"length": ["1 m", "2 m", "3 m"]},
    "t_end": "20 ms",
    "output": 5,
    "measures": {"x": {"final": "bob.x"}},
    "keep": ["bob.y"],
}


def test_a_part_is_the_study_that_it_is_alone(tmp_path: Path) -> None:
    """Its keys take the place of the file's, whole; folders, tree and file hold the same."""
    (tmp_path / "s.yaml").write_text(TEXT)
    done: list[float] = []
    found = gudgeon.study(tmp_path / "s.yaml", tmp_path / "s", progress=lambda fraction, text: done.append(fraction))
    assert done == sorted(done) and done[-1] == 1.0
    assert list(found.parts) == ["planets", "lengths"] and (found.runs, found.failed) == (5, 0)
    assert found.measures == ("y", "x") and (tmp_path / "s" / "planets" / "study.nc").is_file()
    own, alone = found.parts["lengths"].dataset, gudgeon.study(ALONE).dataset
    xr.testing.assert_equal(own, alone)
    assert own.attrs["title"] == "of rods" and found.parts["planets"].dataset.attrs["title"] == "two parts"
    again = gudgeon.load_study(tmp_path / "s")
    for name, part in again.parts.items():
        xr.testing.assert_identical(part.dataset, found.parts[name].dataset)
        xr.testing.assert_identical(again.tree[name].to_dataset(), part.dataset)
    again.save(tmp_path / "all.nc")
    with xr.open_datatree(tmp_path / "all.nc", engine="h5netcdf") as tree:
        xr.testing.assert_equal(tree["lengths"].to_dataset().load(), own)
    with pytest.raises(GudgeonError, match=r"study.parts\['planets'\].dataset"):
        _ = found.dataset
    assert not found.parts["planets"].parts and gudgeon.study(ALONE).tree.dataset["x"].sizes == {"length": 3}


def test_it_goes_on_from_the_parts_that_are_there(tmp_path: Path) -> None:
    """Ctrl-C in the second part; then only what is missing is run, and load_study waits for all."""

    def stop(fraction: float, text: str) -> None:
        if text.startswith("lengths"):
            raise KeyboardInterrupt

    (tmp_path / "s.yaml").write_text(TEXT)
    with pytest.raises(KeyboardInterrupt):
        gudgeon.study(tmp_path / "s.yaml", tmp_path / "s", progress=stop)
    before = (tmp_path / "s" / "planets" / "study.nc").stat().st_mtime_ns
    with pytest.raises(InputError, match="lengths is not finished|not a study folder"):
        (tmp_path / "s" / "lengths" / "study.nc").unlink(missing_ok=True)
        gudgeon.load_study(tmp_path / "s")
    found = gudgeon.study(tmp_path / "s.yaml", tmp_path / "s")
    assert (tmp_path / "s" / "planets" / "study.nc").stat().st_mtime_ns == before and found.runs == 5
    changed = TEXT.replace("3 m]", "4 m]")
    (tmp_path / "s.yaml").write_text(changed)
    with pytest.raises(InputError, match=r"lengths contains another study:\n  parameters.length\[2\] was '3 m'"):
        gudgeon.study(tmp_path / "s.yaml", tmp_path / "s")
    found = gudgeon.study(tmp_path / "s.yaml", tmp_path / "s", restart=True)
    assert found.parts["lengths"].dataset["length"].values.tolist() == [1.0, 2.0, 4.0]


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    (tmp_path / "s.yaml").write_text(TEXT)
    gudgeon.study(ALONE, tmp_path / "alone")
    with pytest.raises(InputError, match="a study without parts"):
        gudgeon.study(tmp_path / "s.yaml", tmp_path / "alone")
    with pytest.raises(InputError, match="is not a study folder: it contains alone"):
        gudgeon.study(tmp_path / "s.yaml", tmp_path)
    gudgeon.study(tmp_path / "s.yaml", tmp_path / "s")
    with pytest.raises(InputError, match="another study"):
        gudgeon.study(ALONE, tmp_path / "s")
    (tmp_path / "s" / "study.json").write_text(json.dumps({"parts": ["../alone", 3]}))
    with pytest.raises(InputError, match="not finished"):
        gudgeon.load_study(tmp_path / "s")


def test_mistakes_of_all_parts_at_once(tmp_path: Path) -> None:
    """What they share is told once; names and units of what is run too."""
    path = tmp_path / "s.yaml"
    path.write_text(
        TEXT.replace("final: bob.y", "finale: bob.y")
        .replace("length: [1", "length: [1 m, 1")
        .replace("planets:", "1planets:")
        .replace("    keep", "    kept")
    )
    with pytest.raises(InputErrors) as message:
        resolve_plans(path)
    places = [str(error).removeprefix(f"{path}:").split(": ")[0] for error in message.value.errors]
    assert places == ["8:3", "15:5"], places
    path.write_text(TEXT.replace("bob.y}", "bob.q}").replace("20 ms", "20 kg").replace("g: [1.62", "gg: [1.62"))
    with pytest.raises(InputErrors) as message:
        resolve_plans(path)
    assert [str(error).split(":")[1] for error in message.value.errors] == ["9", "13"], str(message.value)
    for text, words in (("parts: {}", "parts is empty"), ("parts: [a]", "a list"), ("parts: {a: 3}", "parts.a is '3'")):
        path.write_text(TEXT.partition("parts:")[0] + text)
        with pytest.raises(InputError, match=words):
            resolve_plans(path)
    path.write_text("format: gudgeon-study/1\nparts: {a: {keep: [bob.x]}, b: {mechanism: pendulum}}\n")
    with pytest.raises(
        InputErrors, match=r"(?s)2:12: parts.a has no mechanism.*2:32: parts.b has neither measures nor keep"
    ):
        resolve_plans(path)


def test_the_command(tmp_path: Path, call: Gudgeon) -> None:
    (tmp_path / "s.yaml").write_text(TEXT)
    plan = json.loads(call("study", "s.yaml", "--runs", "--json").output)
    assert {name: part["runs"] for name, part in plan["parts"].items()} == {"planets": 2, "lengths": 3}
    assert "all parts: 5 runs" in call("study", "s.yaml", "--runs").output
    done = call("study", "s.yaml")
    assert done.exit_code == 0 and "part lengths:" in done.output, done.output
    document = json.loads(call("study", "s.yaml", "--json").output)
    assert document["runs"] == 5 and set(document["parts"]["lengths"]["measures"]) == {"x"}
    done = call("study", "s.yaml", "--set", "length=3 m", "--out", "t.study")  # one part varies it
    assert (
        done.exit_code == 0
        and "note: length is set for all runs, in place of 3 values in the study file" in done.output
    )
    parts = gudgeon.load_study(tmp_path / "t.study").parts
    assert parts["planets"].runs == 2 and parts["lengths"].dataset["x"].dims == ()
    assert all(one.dataset["length"].values == 3.0 for one in parts.values())
