"""What is deprecated says so, with version and dates, and does not outlive the version that it names."""

from __future__ import annotations

from datetime import date
from pathlib import Path

import pytest
from packaging.version import Version
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.language.deprecations import DEPRECATIONS, STRESS, Deprecation, warn_deprecated

CHANGES = (Path(__file__).parents[2] / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("one", DEPRECATIONS, ids=lambda one: one.what)
def test_each_is_in_the_changes_and_not_overdue(one: Deprecation) -> None:
    assert date.fromisoformat(one.date) and Version(one.since) < Version(one.gone)
    assert Version(gudgeon.__version__) < Version(one.gone), f"{one.what} was to be gone by now"
    line = next(line for line in CHANGES.splitlines() if line.startswith("- ") and one.what in line)
    assert all(part in line for part in (one.since, one.date, one.gone, one.instead))


def test_a_call_is_told_where_it_stands() -> None:
    def old() -> None:
        warn_deprecated(STRESS)

    with pytest.warns(
        DeprecationWarning, match=r"since gudgeon 0\.1\.0 \(2026-11-26\) and will be removed in 0\.3\.0"
    ) as message:
        old()
    assert message[0].filename == __file__


def test_an_old_command_tells_the_new_one_and_works() -> None:
    done = CliRunner().invoke(app, ["stress", "there_is_no_such_file.yaml"])
    assert done.exit_code == 2 and "use gudgeon map" in done.output and "there_is_no_such_file" in done.output
    assert "deprecated" not in CliRunner().invoke(app, ["map", "there_is_no_such_file.yaml"]).output
