"""Files of other programs with ordinary names, old ones, damaged ones: what is imported is accepted, all else refused.

Nothing but an InputError may come of a file, whatever stands in it; and a file of twice the size takes twice as long.
"""

from __future__ import annotations

import copy
import json
import math
import random
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.errors import InputError
from gudgeon.exchange.mechanism_yaml import write_mechanism_text
from gudgeon.exchange.pmks import find_query, read_old_pmks, read_pmks
from gudgeon.exchange.pylinkage import read_pylinkage
from gudgeon.exchange.read import convert_to_mechanism, read_linkage
from gudgeon.generator.reader.read import read_mechanism
from tests.exchange.test_import import MOVED, SIX_BAR
from tests.programs import needs_compiler

DATA = Path(__file__).parents[1] / "data/exchange"
LINKS = json.loads((DATA / "pmks_links.json").read_text(encoding="utf-8"))
NAMES = [
    "Four-bar (test)",
    "pin (left) 1",
    "gudgeon pin",
    "crank-1 (drive)",
    "A_B",
    "A_B_motor",
    "x",
    "y",
    "theta",
    "t",
] + ["B" * 300, "ground", "tail", "omega", "Käfer", "Ω", "  ", "1", "m", "N", "kg", "__a__", "A.b", "a: b", "*/"]
ODD: list[Any] = [None, True, 0, -1, 10**400, -1e300, 1e-300, math.nan, math.inf, "", "A", [], [1], {}, {"ref": 3}, 5]
ODD += [0.5, "ground", "arc_driver", "tracker", "prismatic", "Fixed", "Linear"]


def documents() -> list[Any]:
    names = ("pylinkage_fourbar", "pylinkage_slider", "pylinkage_linkage", "pylinkage_arc")
    stored = [json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))["file"] for name in names]
    return [*stored, MOVED]


def accepted(linkage: Any) -> None:
    read_mechanism(write_mechanism_text(linkage).encode(), "imported.yaml")


def renamed(data: Any, names: dict[str, str]) -> Any:
    """A document with its names replaced wherever they stand."""
    if isinstance(data, dict):
        return {key: value if key == "type" else renamed(value, names) for key, value in data.items()}
    if isinstance(data, list):
        return [renamed(value, names) for value in data]
    return names.get(data, data) if isinstance(data, str) else data


def test_ordinary_names_become_legal_ones() -> None:
    """Any names, also names that fall together once they are legal: what is made of them is read."""
    rng = random.Random(1)
    for document in documents():
        own = [str(joint.get("id", joint.get("name"))) for joint in document["joints"]]
        own += [str(link["id"]) for link in document.get("links", [])]
        for _ in range(12):
            selected = rng.sample(NAMES, len(own))
            accepted(
                read_pylinkage(renamed(document, dict(zip(own, selected, strict=True))) | {"name": rng.choice(NAMES)})
            )


def test_a_link_may_be_called_as_a_joint_is() -> None:
    document = documents()[0]
    document["links"][2]["id"] = document["joints"][0]["id"]
    accepted(read_pylinkage(document))


def mutated(document: Any, rng: random.Random) -> Any:
    """A document in which some values are odd, left out, doubled or exchanged."""
    root = copy.deepcopy(document)
    for _ in range(rng.randint(1, 3)):
        holders = [root]
        for holder in holders:
            values = holder.values() if isinstance(holder, dict) else holder
            holders += [value for value in values if isinstance(value, (dict, list)) and value]
        holder = rng.choice(holders)
        key = rng.choice(list(holder)) if isinstance(holder, dict) else rng.randrange(len(holder))
        other = rng.choice(list(holder.values()) if isinstance(holder, dict) else holder)
        match rng.randrange(4):
            case 0:
                holder[key] = rng.choice(ODD)
            case 1:
                del holder[key]
                if not holder:
                    break
            case 2:
                holder[key] = copy.deepcopy(other)
            case 3 if isinstance(holder, list):
                holder.append(copy.deepcopy(other))
    return root


def test_damaged_files_of_pylinkage_are_refused_or_read() -> None:
    rng, read = random.Random(2), 0
    for k in range(700):
        document = documents()[k % 5] if k < 5 else mutated(documents()[k % 5], rng)
        try:
            linkage = read_pylinkage(document)
            text = write_mechanism_text(linkage)
        except InputError:
            continue
        try:
            read_mechanism(text.encode(), "imported.yaml")
        except InputError as error:
            pytest.fail(f"{error} of {json.dumps(document)}")
        read += 1
    assert read > 150


def damaged(text: str, rng: random.Random) -> str:
    """A link in which some characters or parts are exchanged, left out or doubled."""
    for _ in range(rng.randint(1, 3)):
        for mark in (rng.choice(["", ".", ","]),):
            parts = list(text) if not mark else text.split(mark)
            k, other = rng.randrange(len(parts)), rng.choice(parts)
            match rng.randrange(4):
                case 0:
                    parts[k] = other
                case 1:
                    del parts[k]
                case 2:
                    parts.insert(k, other)
                case 3:
                    parts[k] = rng.choice(["0", "zzzzz", "z" * 400, "~", "A", "-1", "%0A", "nan", "t", "f", "|"])
            text = mark.join(parts) or "."
    return text


def test_damaged_links_of_pmks_are_refused_or_read(tmp_path: Path) -> None:
    rng, read, file = random.Random(3), 0, tmp_path / "link.txt"
    links = [SIX_BAR, *LINKS.values()]
    for k in range(700):
        address = links[k % len(links)]
        host, _, query = address.partition("?")
        text = f"{host}?{damaged(query, rng) if k >= len(links) else query}"
        file.write_text(text, encoding="utf-8")
        try:
            made = write_mechanism_text(read_linkage(file))
        except InputError:
            assert k >= len(links)
            continue
        try:
            read_mechanism(made.encode(), "imported.yaml")
        except InputError as error:
            pytest.fail(f"{error} of {text}")
        read += 1
    assert read > 150


def test_work_grows_with_the_size_of_a_file() -> None:
    """A megabyte of addresses without an end; joints that are placed by joints that come later in the file."""
    assert find_query("https://pmks" * 80_000) is None  # a search of cubic cost would not come back

    def chain(count: int) -> Any:
        joints = [{"type": "Static", "name": "P0", "x": 0, "y": 0}, {"type": "Static", "name": "Q", "x": 1, "y": 9}]
        joints += [
            {
                "type": "Revolute",
                "name": f"P{k}",
                "x": k,
                "y": 0,
                "joint0": {"ref": f"P{k - 1}"},
                "joint1": {"ref": "Q"},
                "distance0": 1,
                "distance1": 9,
            }
            for k in range(1, count)
        ]
        return {"joints": joints[::-1]}

    def calls(document: Any) -> int:
        counted = [0]

        def count(*_: Any) -> None:
            counted[0] += 1

        sys.setprofile(count)
        try:
            write_mechanism_text(read_pylinkage(document))
        finally:
            sys.setprofile(None)
        return counted[0]

    assert calls(chain(800)) < 9 * calls(chain(100))


def test_old_links_have_the_points_of_today() -> None:
    """The six-bar of the authors of PMKS+ as it was shared before 2023, and as today; a welded linkage of May 2023."""
    today = read_pmks(find_query(SIX_BAR) or "")
    old = read_old_pmks(find_query(LINKS["pr92_old_sixbar"]) or "")
    assert old.positions == {name: pytest.approx(at) for name, at in today.positions.items()}
    assert set(old.ground) == set(today.ground) == {"A", "G"}
    assert {frozenset(b.point_positions) for b in old.bodies} == {frozenset(b.point_positions) for b in today.bodies}
    assert old.drives[0].rate == pytest.approx(10 * math.pi / 30.0) and old.unit == "cm"
    welded = read_pmks(find_query(LINKS["pr35_welded"]) or "")
    assert [body.name for body in welded.bodies] == ["ab", "cd", "gh", "hi", "bcefgj"]
    body, parts = welded.bodies[-1], [(-4.048, -1.016), (-14.153, 3.773)]
    assert set(body.point_positions) == set("bcefgj") and body.mass == pytest.approx(2.0)
    assert body.com == pytest.approx(np.mean(parts, axis=0), abs=2e-3)
    apart = (parts[0][0] - parts[1][0]) ** 2 + (parts[0][1] - parts[1][1]) ** 2
    assert body.inertia == pytest.approx(2.0 + apart / 2.0, rel=1e-3)


@needs_compiler
def test_an_input_at_a_floating_pin_turns_one_link_against_the_other(tmp_path: Path) -> None:
    file, target = tmp_path / "link.txt", tmp_path / "imported.yaml"
    file.write_text(LINKS["pr230_driven_floating"], encoding="utf-8")
    target.write_text(convert_to_mechanism(file), encoding="utf-8")
    drive = read_linkage(file).drives[0]
    run = gudgeon.load(target).simulate(0.1, output=10)
    turned = np.ptp(run["CD.theta"] - run["ACT.theta"])
    assert turned == pytest.approx(0.1 * abs(drive.rate), rel=1e-9) and turned > 0.05


@pytest.mark.parametrize(
    ("joint", "message"),
    [("4A,A,0,0,0", "A: it is an input of no link"), ("2A,A,0,0,0", "A: it is an input of no link")],
)
def test_no_input_is_left_out(joint: str, message: str) -> None:
    """An input that joins nothing is refused, and so is one among three links."""
    flags = int(joint[0]) | 2
    lone = f"0.0.A.1.{flags}{joint[1:]}.0B,B,1,0,0.0C,C,0,1,0..YRBC,BC,1,1,0,0,ccc,B,C,,...NT"
    with pytest.raises(InputError, match=message):
        read_pmks(lone)
    three = ".".join(f"YRA{k},A{k},1,1,0,0,ccc,A,{k},," for k in "BCD")
    points = "2A,A,0,0,0.0B,B,1,0,0.0C,C,0,1,0.0D,D,1,1,0"
    with pytest.raises(InputError, match="A: it is an input of 3 links"):
        read_pmks(f"0.0.A.1.{points}..{three}...NT")


def test_import_refuses_what_check_would(tmp_path: Path) -> None:
    """A linkage whose bars do not reach each other, and motors that contradict each other."""
    document = json.loads(json.dumps(MOVED))
    document["joints"][3]["distance0"] = 0.25
    file, target = tmp_path / "far.json", tmp_path / "far.yaml"
    file.write_text(json.dumps(document), encoding="utf-8")
    done = CliRunner().invoke(app, ["import", str(file), "-o", str(target)])
    assert done.exit_code == 2 and "does not assemble" in done.stderr
    assert not target.exists()
