"""Example: a linkage of another program becomes a mechanism file that reads."""

from __future__ import annotations

import json
from pathlib import Path

from gudgeon.exchange.read import convert_to_mechanism
from gudgeon.generator.reader.read import read_mechanism

DATA = Path(__file__).parents[1] / "data/exchange"


def test_a_four_bar_of_pylinkage_reads(tmp_path: Path) -> None:
    file = tmp_path / "linkage.json"
    file.write_text(json.dumps(json.loads((DATA / "pylinkage_fourbar.json").read_text())["file"]), encoding="utf-8")
    mechanism = read_mechanism(convert_to_mechanism(file).encode(), "imported.yaml")
    assert len(mechanism.bodies) == 3 and len(mechanism.drives) == 1
