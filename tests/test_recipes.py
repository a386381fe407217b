"""docs/recipes: the steps of each recipe are followed in a copy of the sources, and its commands print what it shows.

A block below "Create `FILE`" is that file. A `diff` block below a sentence with `FILE` is a change of that file. The
commands of an `sh` block are run in order; a `text` block after it is a part of what they print.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.programs import needs_compiler

ROOT = Path(__file__).resolve().parents[1]
RECIPES = ROOT / "docs" / "recipes"
COPIED = (
    "runtime",
    "generator",
    "engine",
    "templates",
    "mechanisms",
    "studies",
    "generated",
    "src",
    "tools",
    "tests",
    "docs",
    "benchmarks",
)
FILES = ("pyproject.toml", "Makefile", "README.md", "CONTRIBUTING.md", "constraints.txt", "LICENSE")
BLOCK = re.compile(r"^( *)```(\w+)\n(.*?)^\1```$", re.DOTALL | re.MULTILINE)
MAKE = {"make tables": "python tools/tables.py", "make generated": "python tools/regenerate.py"}
TRIED = [path.stem for path in sorted(RECIPES.glob("*.md")) if "```sh" in path.read_text(encoding="utf-8")]


def blocks(page: str) -> Iterator[tuple[str, str, str]]:
    """Yield kind, text, and the sentence above of each block of a page."""
    end = 0
    for found in BLOCK.finditer(page):
        above = page[end : found.start()].strip().rpartition("\n")[2]
        yield found[2], textwrap.dedent(found[3]), above
        end = found.end()


def changed(text: str, diff: str) -> str:
    """Return the text with the lines of a diff changed, which stand in it once."""
    lines = [line for line in diff.splitlines() if line]
    before = "".join(f"{line[1:]}\n" for line in lines if line[0] in " -")
    after = "".join(f"{line[1:]}\n" for line in lines if line[0] in " +")
    assert text.count(before) == 1, before
    return text.replace(before, after)


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Copy the sources."""
    for name in COPIED:
        ignored = shutil.ignore_patterns("__pycache__", "build")
        shutil.copytree(ROOT / name, tmp_path / "clone" / name, symlinks=True, ignore=ignored)
    for name in FILES:
        shutil.copy2(ROOT / name, tmp_path / "clone" / name)
    return tmp_path / "clone"


def typed(line: str, copy: Path) -> str:
    """Return what a command prints in the copy, whose package it imports."""
    shims = copy.parent / "bin"
    shims.mkdir(exist_ok=True)
    for name, call in (("python", ""), ("gudgeon", "-m gudgeon")):
        (shims / name).write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} {call} "$@"\n', encoding="utf-8")
        (shims / name).chmod(0o755)
    environment = os.environ | {
        "PATH": f"{shims}:{os.environ['PATH']}",
        "PYTHONPATH": str(copy / "src"),
        "GUDGEON_QUICK": "0",
        "GUDGEON_CACHE": str(copy.parent / "cache"),
        "NO_COLOR": "1",
        "COLUMNS": "100",
    }
    done = subprocess.run(
        ["bash", "-c", MAKE.get(line, line)], cwd=copy, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{line}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def follow(page: str, copy: Path) -> int:
    """Follow the steps of a page; return how many commands were run."""
    printed, count = "", 0
    for kind, text, above in blocks(page):
        named = re.findall(r"`([\w./-]+\.\w+)`", above)
        if kind == "text":
            parts = [line.strip() for line in text.splitlines() if line.strip() not in ("", "…")]
            assert [line for line in parts if line not in printed] == [], printed
        elif kind == "sh":
            printed = "\n".join(typed(line, copy) for line in text.splitlines())
            count += 1
        elif kind == "diff":
            file = copy / named[-1]
            file.write_text(changed(file.read_text(encoding="utf-8"), text), encoding="utf-8")
        elif "is an example" not in above:
            file = copy / named[-1]
            assert "Create" in above and not file.exists(), above
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
    return count


def test_the_table_names_each_recipe() -> None:
    """Those that are followed have a mark."""
    index = (RECIPES / "index.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| \[[^\]]+\]\((\w+)\.md\) \| [^|]+ \| (✓|–) \|$", index, re.MULTILINE)
    pages = {path.stem for path in RECIPES.glob("*.md")} - {"index", "where_to_change"}
    assert {name for name, _ in rows} == pages and [name for name, mark in rows if mark == "✓"] == [
        name for name, _ in rows if name in TRIED
    ]


@pytest.mark.parametrize("name", TRIED)
def test_the_changes_of_a_recipe_apply_to_the_files_as_they_are(name: str) -> None:
    """A rename in the sources breaks recipes; this finds it without following them."""
    texts: dict[str, str] = {}
    for kind, text, above in blocks((RECIPES / f"{name}.md").read_text(encoding="utf-8")):
        named = re.findall(r"`([\w./-]+\.\w+)`", above)
        if kind == "diff":
            file = named[-1]
            texts[file] = changed(texts.get(file) or (ROOT / file).read_text(encoding="utf-8"), text)
        elif kind not in ("sh", "text") and "is an example" not in above:
            assert "Create" in above and not (ROOT / named[-1]).exists(), above
            texts[named[-1]] = text


PLACED = re.compile(r"`([\w/.]+/[\w.]+\.\w+)`: ((?:`[\w.]+`(?:, )?)+)")
NAMED = re.compile(r"((?:`[\w.]+`(?:, | and | or )?)+) (?:of|in) `([\w/.]+/[\w.]+\.\w+)`")


@pytest.mark.parametrize("page", [*sorted(RECIPES.glob("*.md")), ROOT / "CONTRIBUTING.md"], ids=lambda page: page.stem)
def test_names_that_pages_find_in_a_file_are_there(page: Path) -> None:
    """As in "`locate_zero` of `engine/watch/zeros.h`" or "`engine/watch/zeros.h`: `locate_zero`".

    Files that a recipe creates are left out.
    """
    text = page.read_text(encoding="utf-8")
    pairs = [*NAMED.findall(text), *((names, file) for file, names in PLACED.findall(text))]
    found = [(name, file) for names, file in pairs for name in re.findall(r"`([\w.]+)`", names)]
    found = [(name, file) for name, file in found if f"Create `{file}`" not in text]
    texts = {file: (ROOT / file).read_text(encoding="utf-8") for _, file in found}
    assert [(name, file) for name, file in found if name.rpartition(".")[2] not in texts[file]] == []


def test_a_change_stands_in_a_file_once() -> None:
    assert changed("a\nb\nc\n", " a\n-b\n+d\n") == "a\nd\nc\n"
    with pytest.raises(AssertionError):
        changed("a\na\n", " a\n+b\n")


@needs_compiler
@pytest.mark.slow
@pytest.mark.parametrize("name", TRIED)
def test_the_steps_work(name: str, copy: Path) -> None:
    assert follow((RECIPES / f"{name}.md").read_text(encoding="utf-8"), copy) > 0
