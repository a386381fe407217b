"""README, CONTRIBUTING and the pages keep their word: blocks are run, quotations occur, names exist."""

from __future__ import annotations

import ast
import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from gudgeon.cli import app
from tests.programs import needs_compiler

ROOT = Path(__file__).resolve().parents[1]
QUOTED = ("commands", "limits", "checks", "speed")
MESSAGES = ("README.md", *(f"docs/{name}.md" for name in QUOTED))
README = "\n".join((ROOT / name).read_text(encoding="utf-8") for name in MESSAGES)
Gudgeon = Callable[[str], Result]


def blocks(language: str) -> list[str]:
    """The fenced blocks of README and its pages in that language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


ENGINE = blocks("yaml")[0]
COMMANDS = [line for block in blocks("sh") for line in block.splitlines()]
QUICK = {"run": " --t-end 0.001 --output 20", "bench": " --quick --methods dop853", "map": " --quick"}


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Gudgeon:
    """Types a line in a folder that holds README's mechanism."""
    (tmp_path / "engine.yaml").write_text(ENGINE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return lambda line: CliRunner().invoke(app, shlex.split(line)[1:])


def test_every_block_is_of_a_kind_that_is_tested() -> None:
    assert len(blocks("python")) >= 1 and len(blocks("yaml")) >= 1 and len(blocks("sh")) >= 1
    assert README.count("```") == 2 * sum(len(blocks(kind)) for kind in ("yaml", "sh", "python", "text", "diff"))
    expected = {"check", "draw", "run", "emit", "equations", "laws", "exercise", "bench", "map"}
    assert {shlex.split(line)[1] for line in COMMANDS} == expected


@needs_compiler
@pytest.mark.parametrize("line", COMMANDS)
def test_commands(line: str, call: Gudgeon, tmp_path: Path) -> None:
    done = call(line + QUICK.get(shlex.split(line)[1], ""))
    assert done.exit_code == 0, done.output
    written = [text.split()[1].rstrip(":") for text in done.output.splitlines() if text.startswith("wrote ")]
    assert written or shlex.split(line)[1] in ("check", "laws")
    assert all((tmp_path / path).exists() for path in written)


@needs_compiler
def test_the_mechanism_is_drawn_as_it_is(call: Gudgeon, tmp_path: Path) -> None:
    """docs/engine.svg is what its caption's command writes: the same parts in the same order, on as large a page."""
    (line,) = re.findall(r"!\[[^\]`]*`([^`]+)`[^\]]*\]\(docs/engine\.svg\)", README)
    assert call(f"{line} -o now.svg").exit_code == 0
    now, shown = ((path / name).read_text("utf-8") for path, name in ((tmp_path, "now.svg"), (ROOT, "docs/engine.svg")))
    parts = r'viewBox="[^"]*"|id="(?:body|joint|drive|inset|force)-[^"]*"'
    assert re.findall(parts, shown) == re.findall(parts, now) and 'id="body-piston"' in shown


@needs_compiler
@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize("setting", dict.fromkeys(re.findall(r"--set ([\w.]+=[\w.]+|[\w.]+='[^']+')", README)))
def test_settings_that_it_shows_are_taken(setting: str, call: Gudgeon) -> None:
    done = call(f"gudgeon run engine.yaml --scene ideal --t-end 0.001 --output 2 --set {setting}")
    known = setting.startswith(("c=", "bodies", "gains")) and done.exit_code == 0
    assert known, done.output


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


def test_every_test_that_the_table_names_exists() -> None:
    named = re.findall(r"`(test_\w+\.py)::(\w+)`", README)
    assert len(named) > 10
    for file, function in named:
        (path,) = (ROOT / "tests").rglob(file)
        tree = ast.parse(path.read_text(encoding="utf-8"))
        assert function in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}, (file, function)


DOCS = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md"))
PAGES = ["README.md", "CONTRIBUTING.md", *DOCS]


def leads_somewhere(page: Path, link: str) -> bool:
    """To a file that is there; in a page of ours also to a heading that it has."""
    name, _, heading = link.partition("#")
    file = page.parent / name if name else page
    if not heading or file.suffix != ".md":
        return file.exists()
    heads = re.findall(r"^#+ (.*)$", file.read_text(encoding="utf-8"), re.MULTILINE)
    return heading in {re.sub(r"[^\w -]", "", head.lower()).strip().replace(" ", "-") for head in heads}


@pytest.mark.parametrize("name", PAGES)
def test_links_paths_and_targets_exist(name: str) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert set(re.findall(r"`make ([a-z-]+)", text)) - targets == set()
    links = [link for link in re.findall(r"\]\(([^)]+)\)", text) if "://" not in link]
    folders = "runtime|engine|generator|templates|generated|mechanisms|tests|benchmarks|docs|tools"
    paths = re.findall(rf"(?<!Create )`((?:{folders})/[\w./-]*)`", text)
    paths = [path for path in paths if f"Create `{path}`" not in text]  # by the steps of a recipe
    assert [link for link in links if not leads_somewhere(ROOT / name, link)] == []
    assert [path for path in paths if not (ROOT / path).exists()] == []


@pytest.mark.parametrize(("name", "count"), [("README.md", 900), ("CONTRIBUTING.md", 1500)])
def test_entry_pages_are_short(name: str, count: int) -> None:
    assert len((ROOT / name).read_text(encoding="utf-8").split()) <= count


def test_pictures_are_small() -> None:
    assert all(path.stat().st_size < 300_000 for path in (ROOT / "docs").glob("*.png"))
