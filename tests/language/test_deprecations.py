"""What is deprecated says so, with version and dates, and does not outlive the version that it names."""

from __future__ import annotations

from datetime import date
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from packaging.version import Version
from typer.testing import CliRunner

import gudgeon
from gudgeon.cli import app
from gudgeon.generator.study.read import read_study
from gudgeon.language.deprecations import DEPRECATIONS, STRESS, Deprecation, warn_deprecated
from gudgeon.results.lyapunov import Lyapunov
from gudgeon.web import page

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


def test_old_names_of_the_exponent_warn_and_give_the_same() -> None:
    t = np.linspace(0.0, 10.0, 101)
    found = Lyapunov("two_trajectory", "", t, np.full(100, 0.2), 0.0, 3, False, None, cast(Any, None))
    with pytest.warns(DeprecationWarning, match="use Lyapunov.mean_horizon") as message:
        assert found.believable(1e-8, apart=0.5) == found.mean_horizon(1e-8, limit=0.5)
    assert message[0].filename == __file__
    with pytest.warns(DeprecationWarning, match="use Lyapunov.coincidences"):
        assert found.merged == found.coincidences == 3
    assert "3 coincidences, by the two-trajectory method" in repr(found)


def test_the_old_name_of_a_statistic_warns_and_is_read_as_the_new_one() -> None:
    study = {"mechanism": "pendulum", "t_end": "1 s", "measures": {"far": {"believable": "run"}}}
    with pytest.warns(DeprecationWarning, match="use mean_horizon") as message:
        (measure,) = read_study(study).measures
    assert measure.statistic == "mean_horizon" and message[0].filename == __file__


def test_the_old_name_for_a_scene_in_a_page_warns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "embed_scene", lambda compiled: f"<{compiled}>")
    with pytest.warns(DeprecationWarning, match=r"use gudgeon\.web\.page\.embed_scene"):
        assert page.carried(cast(Any, "press")) == "<press>"
