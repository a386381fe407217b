"""README and CONTRIBUTING keep their word: every block is run, every quotation occurs, every name exists."""

from __future__ import annotations

import ast
import re
import shlex
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from gudgeon.cli import app

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
needs_compiler = pytest.mark.skipif(not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler")
Gudgeon = Callable[[str], Result]


def blocks(language: str) -> list[str]:
    """The fenced blocks of README in that language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


ENGINE = blocks("yaml")[0]
COMMANDS = [line for block in blocks("sh") for line in block.splitlines()]
QUICK = {"run": " --t-end 0.001 --output 20", "bench": " --quick", "stress": " --quick"}


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gudgeon:
    """Types a line in a folder that holds README's mechanism."""
    (tmp_path / "engine.yaml").write_text(ENGINE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return lambda line: CliRunner().invoke(app, shlex.split(line)[1:])


def test_every_block_is_of_a_kind_that_is_tested() -> None:
    assert len(blocks("yaml")) == len(blocks("python")) == len(blocks("c")) == len(blocks("diff")) == 1
    assert README.count("```") == 2 * sum(len(blocks(kind)) for kind in ("yaml", "sh", "python", "text", "c", "diff"))
    assert {shlex.split(line)[1] for line in COMMANDS} == {"check", "run", "emit", "equations", "bench", "stress"}


@needs_compiler
@pytest.mark.parametrize("line", COMMANDS)
def test_commands(line: str, call: Gudgeon, tmp_path: Path) -> None:
    done = call(line + QUICK.get(shlex.split(line)[1], ""))
    assert done.exit_code == 0, done.output
    written = [text.split()[1].rstrip(":") for text in done.output.splitlines() if text.startswith("wrote ")]
    assert written or " check " in line
    assert all((tmp_path / path).exists() for path in written)


def test_a_mistake_looks_as_shown(call: Gudgeon, tmp_path: Path) -> None:
    text = ENGINE
    for old, new in re.findall(r"^-(.*)\n\+(.*)$", blocks("diff")[0], re.MULTILINE):
        assert text.count(old) == 1
        text = text.replace(old, new)
    (tmp_path / "engine.yaml").write_text(text, encoding="utf-8")
    done = call("gudgeon check engine.yaml")
    assert done.exit_code == 2
    assert done.stderr in blocks("text")


@needs_compiler
def test_python_prints_what_is_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks("python")[0], "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert re.sub(r"\d+e-\d+ J", "", printed) in [re.sub(r"\d+e-\d+ J", "", text) for text in blocks("text")]
    assert float(re.search(r"([\d.e-]+) J", printed)[1]) < 5e-8  # type: ignore[index]  # rtol of the 5 J turned over
    assert (tmp_path / "press.nc").exists() and (tmp_path / "orbit.png").exists()


def test_the_c_is_quoted_from_committed_files() -> None:
    folder = ROOT / "generated/nine_bar_press/dry"
    lines = {line for path in folder.glob("*.c") for line in path.read_text(encoding="utf-8").splitlines()}
    assert [line for line in blocks("c")[0].splitlines() if line and line not in lines] == []


def test_every_test_that_the_table_names_exists() -> None:
    named = re.findall(r"`(test_\w+\.py)::(\w+)`", README)
    assert len(named) > 10
    for file, function in named:
        (path,) = (ROOT / "tests").rglob(file)
        tree = ast.parse(path.read_text(encoding="utf-8"))
        assert function in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}, (file, function)


PAGES = ["README.md", "CONTRIBUTING.md", *(f"docs/{name}.md" for name in ("format", "methods", "physics", "race"))]


@pytest.mark.parametrize("name", PAGES)
def test_links_paths_and_targets_exist(name: str) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert set(re.findall(r"`make ([a-z-]+)", text)) - targets == set()
    links = [link for link in re.findall(r"\]\(([^)]+)\)", text) if "://" not in link]
    folders = "runtime|engine|generator|templates|generated|mechanisms|tests|benchmarks|docs|tools"
    paths = re.findall(rf"`((?:{folders})/[\w./-]*)`", text)
    assert [link for link in links if not (ROOT / name).parent.joinpath(link).exists()] == []
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_pictures_are_small() -> None:
    assert all(path.stat().st_size < 300_000 for path in (ROOT / "docs").glob("*.png"))
