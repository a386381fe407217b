"""Every command that the command line has: its help, and its --json on a small input (tests/minimum.py)."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.main import get_command

from gudgeon.cli import app
from tests.minimum import CALLS, write_inputs
from tests.programs import needs_compiler
from tests.pump import Gudgeon

COMMANDS = get_command(app).commands  # type: ignore[attr-defined]
WITH_JSON = [name for name, one in COMMANDS.items() if any("--json" in parameter.opts for parameter in one.params)]


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_each_command(name: str, call: Gudgeon) -> None:
    done = call(name, "--help")
    assert done.exit_code == 0 and done.stderr == ""
    assert done.stdout.startswith(f"Usage: gudgeon {name} ") and "--help" in done.stdout
    assert "Example: gudgeon " in done.stdout


@needs_compiler
@pytest.mark.parametrize("name", [name for name in WITH_JSON if not COMMANDS[name].hidden])
def test_json_of_each_command_is_one_document(name: str, call: Gudgeon, tmp_path: Path) -> None:
    write_inputs(tmp_path)
    done = call(*CALLS[name][0], "--json")
    assert done.exit_code == 0, done.output
    assert isinstance(json.loads(done.stdout), dict)
