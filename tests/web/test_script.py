"""What a page carries of our JavaScript is the same program as what is read."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import gudgeon.generator.targets.latex
import gudgeon.web
from gudgeon.generator.targets.javascript.compression import compress_script
from gudgeon.web.page import SIMULATOR_FILES, read_file

FOLDERS = (gudgeon.web, gudgeon.generator.targets.latex)
FILES = [file for folder in FOLDERS for file in sorted(Path(str(folder.__file__)).parent.glob("*.js"))]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_comments_and_spaces_alone_are_left_out(file: Path) -> None:
    """By the words of another reader of JavaScript; lines that end statements are the same."""
    lexers, tokens = pytest.importorskip("pygments.lexers"), pytest.importorskip("pygments.token")
    text = file.read_text(encoding="utf-8")
    carried = compress_script(text)

    def words(of: str) -> list[tuple[object, str]]:
        every = lexers.JavascriptLexer().get_tokens(of)
        return [(kind, word) for kind, word in every if kind not in tokens.Comment and word.strip()]

    def ends(of: str) -> list[str]:
        message = "".join(word for kind, word in lexers.JavascriptLexer().get_tokens(of) if kind not in tokens.Comment)
        joined = re.sub(r"(?<=[{;,(])\s*\n", "", message)  # such an end of a line ends no statement
        return ["".join(line.split()) for line in joined.split("\n") if line.strip()]

    assert words(carried) == words(text) and ends(carried) == ends(text)
    assert len(carried) < 0.85 * len(text) and "/*" not in carried


def test_files_that_share_a_scope_declare_each_name_once() -> None:
    """Of two functions with one name, the later would silently replace the earlier."""
    text = "\n".join(map(read_file, SIMULATOR_FILES))
    names = re.findall(r"^(?:async )?(?:function\*?|class|const|let) (\w+)", text, re.MULTILINE)
    assert len(names) > 40 and sorted(names) == sorted(set(names))
