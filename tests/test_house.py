"""The house's own rules: short functions, short files, every room with its purpose."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from gudgeon.loading.generated_scenes import read_scenes

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = [*sorted((ROOT / "runtime").rglob("*.py")), *sorted((ROOT / "generator").rglob("*.py"))]
MAX_LINES = 500  # of a file; statements of a function: pyproject.toml, max-statements


@pytest.mark.parametrize("file", PACKAGE, ids=lambda file: str(file.relative_to(ROOT)))
def test_lengths(file: Path) -> None:
    assert len(file.read_text(encoding="utf-8").splitlines()) <= MAX_LINES


def test_every_room_says_its_purpose() -> None:
    rooms = {file.parent for file in PACKAGE} - {ROOT / "runtime", ROOT / "generator"}
    silent = [room for room in sorted(rooms) if not ast.get_docstring(ast.parse((room / "__init__.py").read_text()))]
    assert silent == []


def test_no_regular_expression_looks_at_emitted_text() -> None:
    """Those that are left read what people wrote: comments, titles, sketches, a parameter's own name (omega4 is ω).

    The page of the laws reads words and equations that the laws' declarations contain.

    equal_parts.py compares printed parts: only the text has the order of terms, which decides the bits of a sum.
    """
    names = ("ir", "kernels", "solvers", "reduction", "targets", "targets/c", "targets/latex", "targets/numpy")
    rooms = [ROOT / "generator" / room for room in names]
    users = {(file.name, name) for room in rooms for file in room.glob("*.py") for name in _with_regexes(file)}
    read = {
        ("printer.py", "sanitize_comment"),
        ("readme.py", "_escape_markdown"),
        ("letters.py", "make_user_symbol_name"),
    }
    read |= {("theory.py", "find_sketch_symbols")}
    read |= {("equal_parts.py", function) for function in ("", "_replace_tokens", "_print_joined_part")}
    read |= {("law_page.py", function) for function in ("_format_source", "_name_film_clearance")}
    read |= {("law_symbols.py", name) for name in ("", "_brace_index", "_normalize_latex")}
    read |= {("law_symbols.py", name) for name in ("find_symbols", "list_symbol_rows")}
    assert users == read


# An arrow, a word of a type, an indexed or dereferenced name, the end of a declaration.
C_SYNTAX = re.compile(r"->|\b(double|void|unsigned|struct|const)\b|\w\[(\d+|{})\]|\w \*$|^\*\w|;$")


@pytest.mark.parametrize("room", ["equations", "ir", "kernels", "kinds", "reduction", "solvers", "symbols"])
def test_c_syntax_is_written_by_the_target_alone(room: str) -> None:
    """What is stored where, and arguments, are values in front of it (generator/symbols/storage.py)."""
    files = [*(ROOT / "generator" / room).rglob("*.py")]
    found = [(file.name, text) for file in files for text in _strings(file) if C_SYNTAX.search(text)]
    assert files and found == []


def _strings(file: Path) -> Iterator[str]:
    """Texts of a file, with {} for what is put in; without docstrings and the comments of kernels (`..._DOC`)."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    apart = {id(x) for node in ast.walk(tree) if isinstance(node, ast.Expr) for x in [node.value]}
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "").endswith("_DOC"):
            apart |= {id(x) for x in ast.walk(node.value)}
        if isinstance(node, ast.JoinedStr):
            apart |= {id(x) for x in node.values}
            yield "".join(str(x.value) if isinstance(x, ast.Constant) else "{}" for x in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in apart:
            yield node.value


def _with_regexes(file: Path) -> Iterator[str]:
    """Functions that use `re`; "" stands for the file's own level."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    for node in tree.body:
        names = {x.value.id for x in ast.walk(node) if isinstance(x, ast.Attribute) and isinstance(x.value, ast.Name)}
        if "re" in names:
            yield getattr(node, "name", "")


ENGINE = [*sorted((ROOT / "engine").rglob("*.c")), *sorted((ROOT / "engine").rglob("*.h"))]


@pytest.mark.parametrize("file", ENGINE, ids=lambda file: str(file.relative_to(ROOT)))
def test_the_engine_is_plain_c(file: Path) -> None:
    """No Jinja, no mechanism's name; a comment first that says what the file is for; lines and files of a length."""
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines()
    assert text.startswith("/*") and "{%" not in text and not re.search(r"\{\{-? *\w+ *-?\}\}", text)
    assert len(lines) <= MAX_LINES and max(map(len, lines)) <= 120
    assert not [path.stem for path in (ROOT / "mechanisms").glob("*_*.yaml") if path.stem in text]


def test_the_engines_readme_names_each_of_its_files_once() -> None:
    """With a word on it; and each room, in front of its files."""
    text = (ROOT / "engine" / "README.md").read_text(encoding="utf-8")
    message = re.findall(r"^- `([\w./]+)`: \S.*$", text, re.M)
    assert sorted(message) == sorted(file.relative_to(ROOT / "engine").as_posix() for file in ENGINE)
    rooms = re.split(r"^`(\w+/)`: \S.*$", text, flags=re.M)
    for room, files in zip(rooms[1::2], rooms[2::2], strict=True):
        assert all(file.startswith(room) for file in re.findall(r"^- `([\w./]+)`", files, re.M)), room
    named = set(re.findall(r"`(\w+/[\w.]+)`", text))
    assert named <= {*message, "generated/"} and max(map(len, text.splitlines())) <= 120


def test_what_is_derived_is_committed_and_the_engine_once() -> None:
    generated = [path for path in (ROOT / "generated").rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    assert len(generated) <= 200
    definition = re.compile(r"^\w[\w *]*?(\w+)\([^;{]*\)\n\{", re.M)
    functions_of_engine = {name for file in ENGINE for name in definition.findall(file.read_text(encoding="utf-8"))}
    assert {"gudgeon_adaptive_run", "dop853_try_step", "project_state"} <= functions_of_engine
    sources = (source for folder in (ROOT / "generated").glob("*/") for source in read_scenes(folder))
    texts = "".join(text for source in sources for name, text in source.files.items() if name.endswith((".c", ".h")))
    assert texts
    assert not functions_of_engine & set(definition.findall(texts))
