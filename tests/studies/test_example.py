"""Example: a study's table as a file that other programs read."""

from __future__ import annotations

import csv
from pathlib import Path

from gudgeon.studies.show.tables import write_rows_as_csv


def test_rows_of_a_table_come_back(tmp_path: Path) -> None:
    rows = [{"clearance": "0.1 mm", "verdict": "stable"}, {"clearance": "0.5 mm", "verdict": "diverged"}]
    write_rows_as_csv(tmp_path / "map.csv", rows)
    with (tmp_path / "map.csv").open(newline="") as file:
        assert list(csv.DictReader(file)) == rows
