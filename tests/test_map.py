"""docs/map.md and docs/notation.md are what `make tables` writes; each source file says in a sentence what it owns."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MAP = runpy.run_path(str(ROOT / "tools" / "file_map.py"))
NO_COMMENT = (".jinja",)  # what a template writes first may be its `else`


def test_the_map_is_current() -> None:
    assert (ROOT / "docs" / "map.md").read_text(encoding="utf-8") == MAP["make_file_map"]()


def test_the_notation_is_current_and_each_symbol_has_one_meaning() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "notation.py"))
    written = tool["make_notation_page"]()
    assert (ROOT / "docs" / "notation.md").read_text(encoding="utf-8") == written
    for row in ("| $c$ | radial clearance", "`JOINT.deltadot` | `deltadot` | m/s |", "| `hertz` |"):
        assert row in written
    physics = (ROOT / "docs" / "physics.md").read_text(encoding="utf-8")
    assert tool["find_missing_symbols"](written, physics) == []
    assert tool["find_missing_symbols"](written.replace("| $e_r$ |", "| $e$ |"), physics) == ["e_r"]
    find = tool["find_ambiguous_symbols"]
    assert find(written) == []
    assert find(written.replace("| $V$ | potential energy", "| $T$ | potential energy")) != []
    assert find(written.replace("| $v_1$ | slip above", "| $v_0$ | slip above")) == ["$v_0$ in modified_coulomb"]


def test_each_source_file_has_a_first_sentence() -> None:
    files = [file for top in MAP["FOLDERS"] for _, files in MAP["iterate_source_folders"](ROOT / top) for file in files]
    silent = [str(file.relative_to(ROOT)) for file in files if not MAP["find_first_sentence"](file)]
    assert len(files) > 500
    assert [name for name in silent if not name.endswith(NO_COMMENT)] == []


def test_the_first_sentence_of_a_comment(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_text("/*\n * Steps of\n * a run. It ends\n *\n * there. */\nint a;\n", encoding="utf-8")
    (tmp_path / "b.py").write_text('"""Numbers of J. Doe: x. Further ones."""\n', encoding="utf-8")
    (tmp_path / "c.py").write_text("x = 1\n", encoding="utf-8")
    assert [MAP["find_first_sentence"](tmp_path / name) for name in ("a.c", "b.py", "c.py")] == [
        "Steps of a run",
        "Numbers of J. Doe: x",
        "",
    ]
