"""Example: a script of the page is one that Node reads, as it stands in the folder."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import gudgeon.web
from tests.web.node import needs_node, node

FILES = sorted(Path(gudgeon.web.__path__[0]).glob("*.js"))


@needs_node
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_a_script_has_no_error_of_syntax(file: Path) -> None:
    done = subprocess.run([node() or "", "--check", str(file)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
