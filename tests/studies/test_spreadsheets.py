"""CSV files as spreadsheets read them: texts are texts, numbers are numbers."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from gudgeon.language.text_output import escape_for_spreadsheet
from gudgeon.studies.show.tables import write_rows_as_csv


@pytest.mark.parametrize("text", ["=1+1", "+cmd", "-x", "@SUM(A1)", "-1 m", "=", "=1\n2"])
def test_a_text_is_not_a_formula(text: str, tmp_path: Path) -> None:
    write_rows_as_csv(tmp_path / "x.csv", [{"failure": text, "step": -1.5}])
    with (tmp_path / "x.csv").open(newline="") as file:
        assert list(csv.DictReader(file)) == [{"failure": f"'{text}", "step": "-1.5"}]


def test_a_carriage_return_begins_no_row() -> None:
    assert escape_for_spreadsheet("\r=1") == r"\r=1"


@pytest.mark.parametrize("value", ["-1.5", "+3", "-1e-3", "-inf", "rk4", "a=b", "", -1.5, None, True])
def test_numbers_and_other_texts_stay(value: object) -> None:
    assert escape_for_spreadsheet(value) == value
