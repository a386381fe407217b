"""tools/prose.py: pages and docstrings comply with the style guide; each rule reports what breaks it."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROSE = runpy.run_path(str(ROOT / "tools" / "prose.py"))


def test_the_pages_comply() -> None:
    pages = PROSE["list_checked_pages"]()
    found = [(page.name, *one) for page in pages for one in PROSE["check_page"](page.read_text(encoding="utf-8"))]
    assert len(pages) > 20 and found == []


def test_a_long_sentence_is_reported_with_its_line() -> None:
    long = "Long" + " word" * 30 + ".\n"
    assert list(PROSE["check_page"](f"# Title\n\nShort. {long}")) == [
        (3, "sentence of 31 words: Long word word word word word word word …")
    ]
    assert list(PROSE["check_page"](f"```\n{long}```\n| {long}$$\n{long}$$\n")) == []


def test_a_long_paragraph_is_reported_and_items_are_paragraphs() -> None:
    sentence = "One two three four five six seven eight nine ten.\n"
    assert [message.split(":")[0] for _, message in PROSE["check_page"](sentence * 11)] == ["paragraph of 110 words"]
    assert list(PROSE["check_page"](f"- {sentence}" * 11)) == []


def test_private_terms_are_reported_outside_code() -> None:
    text = "It is told here.\n`told` and ``\n\n```\ntold\n```\nThe force hangs on the slip.\n"
    assert list(PROSE["check_page"](text)) == [(1, "private term `told`"), (7, "private term `hangs on`")]


def test_the_first_sentence_of_a_docstring() -> None:
    is_sentence = PROSE["is_sentence"]
    assert is_sentence("Return the time.") and is_sentence("`x` in m.\n\nMore.") and is_sentence("Two\nlines. more")
    assert not is_sentence("s, of user and system.") and not is_sentence("No full stop") and not is_sentence("")
    assert [line for line, _ in PROSE["check_docstrings"]('"""Fine."""\ndef f():\n    """not."""\n')] == [3]


def test_the_number_of_docstrings_may_only_fall() -> None:
    check, lower = PROSE["check_ratchet"], PROSE["lower_allowed"]
    assert check({"a": 2}, {"a": 2}) == []
    assert "3 docstrings" in check({"a": 3}, {"a": 2})[0] and "--lower" in check({"a": 1}, {"a": 2})[0]
    counts = dict.fromkeys(PROSE["ALLOWED"], 0)
    assert '{"runtime": 0, "generator": 0,' in lower("ALLOWED = {}\n", counts)
    assert lower("x = 1\n", counts) == "x = 1\n"
