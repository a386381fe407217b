"""The tutorials keep their word: every block is run, in order, in a folder of its own."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from gudgeon.cli import app
from tests.kinds.own import forgotten
from tests.programs import needs_compiler

pytestmark = needs_compiler
PAGES = sorted((Path(__file__).parents[1] / "docs/tutorials").glob("*.md"))
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"# (\w+\.\w+)\n")


def run(kind: str, text: str, names: dict[str, Any]) -> None:
    """A block: a file where its first line names one, commands, or Python that goes on where the last one ended."""
    if (named := NAMED.match(text)) and kind in ("yaml", "python"):
        Path(named[1]).write_text(text, encoding="utf-8")
    elif kind == "sh":
        for line in text.splitlines():
            done = CliRunner().invoke(app, shlex.split(line)[1:])
            assert done.exit_code == 0, f"{line}\n{done.output}"
    elif kind == "python":
        exec(compile(text, "tutorial", "exec"), names)
    else:
        raise AssertionError(f"a block of a kind that is not run: {kind}")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_block_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text, names = page.read_text(encoding="utf-8"), dict[str, Any]()
    blocks = BLOCK.findall(text)
    assert blocks and text.count("```") == 2 * len(blocks)
    with forgotten():
        for kind, block in blocks:
            run(kind, block, names)


def test_one_leads_to_the_next() -> None:
    """From the first on, each named once."""
    first = next(page for page in PAGES if page.stem == "first_linkage")
    seen = [first]
    while found := re.search(r"^Next: \[.*\]\((\w+\.md)\)", seen[-1].read_text(encoding="utf-8"), re.MULTILINE):
        seen.append(first.parent / found[1])
    assert sorted(seen) == PAGES
