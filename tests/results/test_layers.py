"""The data of results load neither their files, figures nor reports: methods such as `run.plot()` import when called.

lint-imports holds the order of all modules; it cannot say whether an import that it ignores is in a method.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import gudgeon.results

DATA = sorted(file.stem for file in Path(gudgeon.results.__path__[0]).glob("*.py"))
FORMER = ("__init__", "trust")


@pytest.mark.parametrize("room", ["files", "figures", "reports"])
def test_data_load_no_folder_above_them(room: str) -> None:
    names = [f"gudgeon.results.{name}" for name in DATA if name not in FORMER]
    code = f"import sys, {', '.join(names)}\nprint([x for x in sys.modules if x.startswith('gudgeon.results.{room}')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


def test_the_name_of_the_report_in_the_reference_of_before_still_works() -> None:
    from gudgeon.results.reports.run_report import RunReport
    from gudgeon.results.trust import RunReport as former

    assert former is RunReport
