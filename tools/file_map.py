"""Write docs/map.md: each source file with the first sentence of its docstring or head comment (`make tables`)."""

from __future__ import annotations

import ast
import os
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("runtime", "generator", "engine", "templates", "tools", "benchmarks")
SUFFIXES = (".py", ".c", ".h", ".js", ".jinja")
HEAD = """# Map of the files

This page lists each source file with the first sentence of its docstring or of its head comment.
Use it to find the file that owns a subject; the browser's search within the page helps.
`make tables` writes the page, and `tests/test_map.py` keeps it current.

[Architecture](architecture.md) describes the layers.
[Where to change what](recipes/where_to_change.md) maps tasks to files.
The tests mirror these folders: `tests/integrators` tests `runtime/integrators`, for example.
"""
MARKUP = re.compile(r"([\\*_<>|$\[\]{}#~])")
END_OF_SENTENCE = re.compile(r"(?<=[a-z0-9)`][.!?])\s+(?=[A-Z`])|:\s*$")
COMMENT = re.compile(r"/\*(.*?)\*/|\{#-?(.*?)-?#\}", re.DOTALL)


def make_file_map() -> str:
    """Return the text of docs/map.md: a heading for each folder, below it the files."""
    parts = [HEAD]
    for top in FOLDERS:
        parts.append(f"\n## {top}\n")
        for folder, files in iterate_source_folders(ROOT / top):
            if folder != ROOT / top:
                parts.append(f"\n### {folder.relative_to(ROOT).as_posix()}\n")
            purpose = find_first_sentence(folder / "__init__.py") if (folder / "__init__.py").is_file() else ""
            if purpose:
                parts.append(f"\n{escape_markdown(purpose)}\n")
            lines = (f"- `{file.name}`: {escape_markdown(find_first_sentence(file))}\n" for file in files)
            parts.append("\n" + "".join(lines).replace(": \n", "\n"))
    return "".join(parts)


def iterate_source_folders(top: Path) -> Iterator[tuple[Path, list[Path]]]:
    """Yield each folder below `top` that has source files, with these files in the order of their names."""
    for name, folders, files in os.walk(top):
        folders[:] = sorted(one for one in folders if not one.startswith((".", "__")))
        found = [Path(name) / file for file in sorted(files) if file.endswith(SUFFIXES) and file != "__init__.py"]
        if found:
            yield Path(name), found


def find_first_sentence(file: Path) -> str:
    """Return the first sentence of a file's docstring or head comment, without its full stop; "" if it has none."""
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".py":
        head = ast.get_docstring(ast.parse(text)) or ""
    else:
        found = COMMENT.search(text)
        head = (found[1] or found[2] or "") if found else ""
    lines = [re.sub(r"^\s*\*(?:\s|$)", "", line).strip() for line in head.strip().splitlines()]
    paragraph = " ".join(lines[: lines.index("")] if "" in lines else lines)
    return END_OF_SENTENCE.split(paragraph, maxsplit=1)[0].strip().rstrip(".:")


def escape_markdown(text: str) -> str:
    """Return the text with Markdown's characters escaped, except between backticks."""
    return "`".join(part if k % 2 else MARKUP.sub(r"\\\1", part) for k, part in enumerate(text.split("`")))


if __name__ == "__main__":
    (ROOT / "docs" / "map.md").write_text(make_file_map(), encoding="utf-8")
