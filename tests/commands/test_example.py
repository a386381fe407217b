"""Example: a command is called as a user types it, on a file in an empty folder.

`call` and `pump` are fixtures of `tests/conftest.py`; the mechanism is in `tests/pump.py`.
"""

from __future__ import annotations

from tests.pump import Gudgeon


def test_check_accepts_a_valid_file(call: Gudgeon, pump: str) -> None:
    done = call("check", pump)
    assert done.exit_code == 0 and done.stdout.startswith("valid: 3 bodies, 4 joints, 1 drive")


def test_check_reports_where_a_file_is_wrong(call: Gudgeon, pump: str) -> None:
    with open(pump, "a", encoding="utf-8") as file:
        file.write("sceens: {}\n")
    done = call("check", pump)
    assert done.exit_code == 2 and "did you mean 'scenes'?" in done.output
