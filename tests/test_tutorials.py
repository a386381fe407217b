"""Run every code block of the tutorials and of the guides to Python in order and compare the printed output."""

from __future__ import annotations

import io
import math
import re
import shlex
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from gudgeon.cli import app
from tests.kinds.own import forgotten
from tests.programs import needs_compiler

pytestmark = needs_compiler
DOCS = Path(__file__).parents[1] / "docs"
PAGES = sorted((DOCS / "tutorials").glob("*.md"))
GUIDES = [
    DOCS / f"{name}.md"
    for name in ("runs_and_results", "audit", "wear", "plots_and_animation", "ensembles", "exchange")
]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"(?:#|//) (\w+\.\w+)\n")


def run(kind: str, text: str, names: dict[str, Any]) -> str:
    """A block: a file where its first line names one, commands, or Python that goes on where the last one ended.

    Returns what it prints.
    """
    if (named := NAMED.match(text)) and kind in ("yaml", "python", "javascript"):
        Path(named[1]).write_text(text, encoding="utf-8")
        return ""
    printed = io.StringIO()
    if kind == "sh":
        for line in text.splitlines():
            done = CliRunner().invoke(app, shlex.split(line)[1:])
            assert done.exit_code == 0, f"{line}\n{done.output}"
            printed.write(done.stdout)
    elif kind == "python":
        with redirect_stdout(printed):
            exec(compile(text, "tutorial", "exec"), names)
    else:
        raise AssertionError(f"a block of a kind that is not run: {kind}")
    return printed.getvalue()


def same(shown: str, printed: str) -> bool:
    """Word by word; numbers to three digits."""
    words = [re.sub(r"[\[\],]+", " ", line).split() for line in (shown, printed)]
    return len(words[0]) == len(words[1]) and all(map(_same_word, *words))


def _same_word(shown: str, printed: str) -> bool:
    try:
        return shown == printed or math.isclose(float(shown), float(printed), rel_tol=1e-3)  # NaN is not close to NaN
    except ValueError:
        return shown == printed


def missing(shown: str, printed: str) -> list[str]:
    """Lines of a shown output that are not printed where they stand; a line of … stands for some that are left out."""
    lines, skipped, lost = printed.splitlines(), False, []
    for line in shown.splitlines():
        if line == "…":
            skipped = True
            continue
        at = next((k for k, one in enumerate(lines) if same(line, one)), None) if skipped else 0
        if at is None or at >= len(lines) or not same(line, lines[at]):
            lost.append(line)
        else:
            lines, skipped = lines[at + 1 :], False
    return lost + [line for line in lines if line.strip() and not skipped]


@pytest.mark.parametrize("page", [*PAGES, *GUIDES], ids=lambda page: page.stem)
def test_every_block_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text, names, printed = page.read_text(encoding="utf-8"), dict[str, Any](), ""
    blocks = BLOCK.findall(text)
    assert blocks and text.count("```") == 2 * len(blocks)
    with forgotten():
        for kind, block in blocks:
            if kind == "text":
                assert missing(block, printed) == []
                continue
            printed = run(kind, block, names)


def test_one_leads_to_the_next() -> None:
    """From the first on, each named once."""
    first = next(page for page in PAGES if page.stem == "first_linkage")
    seen = [first]
    while found := re.search(r"^Next: \[.*\]\((\w+\.md)\)", seen[-1].read_text(encoding="utf-8"), re.MULTILINE):
        seen.append(first.parent / found[1])
    assert sorted(seen) == PAGES
