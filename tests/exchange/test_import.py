"""Linkages of pylinkage and PMKS+ as mechanisms: where the other program has each point, and what is refused.

The files in tests/data/exchange were written by pylinkage 0.8.0 (a Linkage of the old kinds of joints) and 1.3.0
(Mechanisms; in one of them the crank goes to and fro in an arc), each with the positions of its joints that
pylinkage itself finds step by step.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import InputError
from gudgeon.exchange.mechanism_yaml import LINE_MASS, write_mechanism_text
from gudgeon.exchange.pmks import read_pmks
from gudgeon.exchange.pylinkage import read_pylinkage
from gudgeon.exchange.read import convert_to_mechanism, read_linkage
from tests.programs import needs_compiler

DATA = Path(__file__).parents[1] / "data/exchange"
# The six-bar that the authors of PMKS+ verify it with, as they share it (README of PMKSWeb).
SIX_BAR = (
    "https://app.pmksplus.com/?0P.SS.K,0.101.MA,A,0wS,0bg,0.GB,B,0gW,EE,0.GC,C,Oi,6k,0.GD,D,03m,_g,0.GE,E,1FO,1I_,0"
    ".GF,F,1-C,qM,0.KG,G,1oO,0ss,0..YRAB,AB,Fe,Fe,0oU,0Bk,c5cae9,A,B,,.YRBCD,BCD,Fe,Fe,07C,Rt,303e9f,B,C,D,,"
    ".YRDE,DE,Fe,Fe,bq,18q,0d125a,D,E,,.YREF,EF,Fe,Fe,1dI,13g,B2DFDB,E,F,,.YRFCG,FCG,Fe,Fe,1Om,1Q,26A69A,F,C,G,,...JGp"
)


def written(data: Any, folder: Path) -> Path:
    file = folder / "linkage.json"
    file.write_text(json.dumps(data), encoding="utf-8")
    return file


def as_mechanism(text: str, folder: Path) -> gudgeon.Simulation:
    file = folder / "imported.yaml"
    file.write_text(text, encoding="utf-8")
    return gudgeon.load(file)


@needs_compiler
@pytest.mark.parametrize("name", ["pylinkage_fourbar", "pylinkage_slider", "pylinkage_linkage", "pylinkage_arc"])
def test_points_move_as_in_pylinkage(name: str, tmp_path: Path) -> None:
    """A crank's step is a second: all points to rounding, pins in slots and tracers too."""
    stored = json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))
    file = written(stored["file"], tmp_path)
    linkage, steps = read_linkage(file), np.array(stored["steps"])
    run = as_mechanism(convert_to_mechanism(file), tmp_path).simulate(float(len(steps)), output=len(steps))
    compared = 0
    for k, joint in enumerate(stored["ids"]):
        for body in (body for body in linkage.bodies if joint in body.point_positions):
            at = list(body.point_positions).index(joint)
            point = f"{body.name}.{('tail', 'head')[at] if at < 2 else joint}"
            found = np.stack([run[f"{point}.x"], run[f"{point}.y"]], axis=1)[1:]
            assert abs(found - steps[:, k]).max() < 1e-13 * max(1.0, abs(steps).max())
            compared += 1
    assert compared >= len(stored["ids"])


@needs_compiler
def test_a_shared_link_of_pmks(tmp_path: Path) -> None:
    """Its positions in cm, centres of mass, and a crank that turns clockwise by 20 revolutions a minute."""
    file = tmp_path / "shared.md"
    file.write_text(f"Look at [this]({SIX_BAR}).\n", encoding="utf-8")
    linkage = read_linkage(file)
    assert linkage.positions["A"] == (-3.74, -2.41) and linkage.positions["G"] == (7.32, -3.51)
    assert [body.name for body in linkage.bodies] == ["AB", "BCD", "DE", "EF", "FCG"]
    assert set(linkage.ground) == {"A", "G"} and linkage.gravity is None
    simulation = as_mechanism(convert_to_mechanism(file), tmp_path)
    run = simulation.simulate(0.04, output=4)  # its crank swings by some degrees to either side
    assert run["AB.theta"][-1] - run["AB.theta"][0] == pytest.approx(-0.04 * 20.0 * math.pi / 30.0, abs=1e-12)
    for body, point in (("AB.tail", "A"), ("BCD.D", "D"), ("EF.head", "F"), ("FCG.G", "G")):
        place = np.array([run[f"{body}.x"][0], run[f"{body}.y"][0]]) * 100.0
        assert place == pytest.approx(linkage.positions[point], abs=2e-3)  # positions are rounded to .001 cm
    centroid = np.mean([linkage.positions[p] for p in "BCD"], axis=0)
    assert [100.0 * run["BCD.x"][0], 100.0 * run["BCD.y"][0]] == pytest.approx(centroid, abs=3e-3)


@needs_compiler
def test_inches_are_centimetres_of_other_size(tmp_path: Path) -> None:
    """All that is a length grows alike: points, lengths, centres of mass."""
    file, sizes = tmp_path / "six_bar.txt", []
    for units, unit in (("0", 0.0254), ("1", 0.01), ("2", 1.0)):
        file.write_text(SIX_BAR.replace(".K,0.1", f".K,0.{units}"), encoding="utf-8")
        text = convert_to_mechanism(file)
        assert "no units" not in text and "name: six_bar" in text
        run = as_mechanism(text, tmp_path).simulate(0.01, output=2)
        sizes.append(np.array([run[f"{body}.{axis}"][0] / unit for body in ("AB", "BCD", "FCG") for axis in "xy"]))
    np.testing.assert_allclose(sizes[0], sizes[1], rtol=1e-9)
    np.testing.assert_allclose(sizes[2], sizes[1], rtol=1e-9)


def test_numbers_of_pmks() -> None:
    """To the base 64, a 0 in front for a negative one, thousandths."""
    joints = "4A,A,0wS,10,0.0B,B,_-,0,0.4C,C,0Fe,Fe,0"
    linkage = read_pmks(f"0.SS.K,0.201.{joints}..YRAB,AB,Fe,Fe,0,0,fff,A,B,,.YRBC,BC,Fe,Fe,0,0,fff,B,C,,...")
    assert linkage.positions == {"A": (-3.740, 0.064), "B": ((62 * 64 + 63) / 1000, 0.0), "C": (-1.0, 1.0)}
    assert linkage.unit == "m" and linkage.gravity is None and not linkage.drives


def test_what_is_not_said_is_told(tmp_path: Path) -> None:
    stored = json.loads((DATA / "pylinkage_fourbar.json").read_text(encoding="utf-8"))
    text = write_mechanism_text(read_pylinkage(stored["file"]))
    head = text.partition("format:")[0]
    assert "counts steps" in head and "Masses are not in the file" in head and "no units" in head
    assert f"mass: {3.0 * LINE_MASS:g} kg" in text
    assert (
        "\n"
        not in write_mechanism_text(read_pylinkage({**stored["file"], "name": "a\nname: b"})).split("format:")[0][1:20]
    )


MOVED = {
    "joints": [
        {"type": "Static", "name": "A", "x": 0, "y": 0},
        {"type": "Static", "name": "D", "x": 4, "y": 0},
        {"type": "Crank", "name": "B", "x": 1, "y": 0, "joint0": {"ref": "A"}, "distance": 1, "angle": 0.1},
        {
            "type": "Revolute",
            "name": "C",
            "x": 3,
            "y": 2,
            "joint0": {"ref": "B"},
            "joint1": {"ref": "D"},
            "distance0": 3,
            "distance1": 2.5,
        },
    ]
}


def changed(k: int, **values: Any) -> dict[str, Any]:
    joints = [dict(joint) for joint in MOVED["joints"]]
    joints[k] |= values
    return {"joints": joints}


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ([], "no joints"),
        ({"joints": []}, "no joints"),
        ({"joints": [1]}, "no joints"),
        (changed(3, type="Cam"), "'Cam' is not a joint of pylinkage"),
        (changed(3, joint0={"ref": "X"}), "depends on .X., which is not in the file"),
        (changed(3, joint1=None), "depends is missing"),
        (changed(2, distance="long"), "distance is 'long'"),
        (changed(2, distance=True), "distance is True"),
        (changed(2, distance=float("nan")), "distance is nan"),
        (changed(3, type="Fixed", distance=1, angle=0.2), "which are not points of one rigid body"),
        (changed(3, type="Prismatic", revolute_radius=3, joint1={"ref": "B"}, joint2={"ref": "D"}), "no body contains"),
        ({"joints": [{"id": "A", "type": "ground", "position": [0, 0]}]}, "no links"),
        ({"joints": [{"id": "A", "type": "ground", "position": None}], "links": []}, "has no position"),
        ({"joints": [{"id": "A", "type": "ground", "position": [0, 0]}], "links": []}, "no moving body"),
    ],
)
def test_what_cannot_be_read_is_refused(data: Any, message: str, tmp_path: Path) -> None:
    file = tmp_path / "odd.json"
    file.write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(InputError, match=message):
        convert_to_mechanism(file)
    done = CliRunner().invoke(app, ["import", str(file), "-o", str(tmp_path / "x.yaml")])
    assert done.exit_code == 2 and not (tmp_path / "x.yaml").exists()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "\x00",
        "[" * 100_000,
        "https://app.pmksplus.com/?1.2",
        "https://app.pmksplus.com/?0.S.K,0.101.ZA,A..x...",
        SIX_BAR.replace(",A,B,,", ",A,Q,,"),
        SIX_BAR.replace("MA,A,0wS", "MA,A,~wS"),
    ],
)
def test_what_is_neither_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / "odd.txt"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=str(file)):
        convert_to_mechanism(file)


def test_the_command_writes_what_check_accepts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Names as pylinkage has them are no names of ours: they are made ones. A file that is there stays."""
    monkeypatch.chdir(tmp_path)
    stored = json.loads((DATA / "pylinkage_linkage.json").read_text(encoding="utf-8"))
    written(stored["file"] | {"name": "ground"}, tmp_path)
    call = CliRunner()
    first, again = (call.invoke(app, ["import", "linkage.json"]) for _ in range(2))
    assert first.exit_code == 0, first.output
    target = next(tmp_path.glob("*.yaml"))
    assert "wrote" in first.output and call.invoke(app, ["check", str(target)]).exit_code == 0
    assert again.exit_code == 2
