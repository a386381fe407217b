"""Check the language of documentation and docstrings against the style guide (`make lint`).

Pages: no sentence over 30 words, no paragraph over 100 words, no private term. Docstrings of Python: the first sentence
begins with a capital letter and ends with a full stop. Older docstrings do not all comply; `ALLOWED` is the number that
may remain in each folder. That number may only fall: the check also fails if a folder has fewer than allowed, and
`python tools/prose.py --lower` then writes the lower number into this file. `--all` lists the docstrings that remain.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MAX_SENTENCE_WORDS = 30
MAX_PARAGRAPH_WORDS = 100
# Pages that other tools write, or whose text comes from data.
GENERATED_PAGES = ("format", "laws", "checks", "race", "map", "reference", "gallery", "benchmarks")
# Docstrings in each folder whose first sentence does not comply: lower a number when some have been mended.
ALLOWED = {"runtime": 1, "generator": 3, "benchmarks": 0, "tools": 0}

PRIVATE_TERMS = re.compile(
    r"\b(told|tells?|wanted|beside|behind|hangs? on|nobody|somebody|whoever|whatever|ledger|freedoms"
    r"|(?<!there )is no(?= an? | \w+ of )|looks? at|looked at|lets? go|goes on|asked for)\b",
    re.IGNORECASE,
)
FENCE = re.compile(r"^\s*(```|~~~|:::|\$\$)")
ITEM = re.compile(r"^\s*([-*+]|\d+\.)\s+")
SENTENCE_END = re.compile(r"(?<=[.!?:])[)\"”*]*\s+(?=[^a-z])")
WORD = re.compile(r"[^\W_]")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|cf|vs|no|eq|fig|et al|approx)\.", re.IGNORECASE)
FIRST_SENTENCE_END = re.compile(r"[.!?][)`'\"]*(\s|$)")


def list_checked_pages() -> list[Path]:
    """Return the pages that people write: README, CONTRIBUTING and docs/*.md without the generated ones."""
    pages = sorted(page for page in (ROOT / "docs").glob("*.md") if page.stem not in GENERATED_PAGES)
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *pages]


def check_page(text: str) -> Iterator[tuple[int, str]]:
    """Yield the line number and a message for each long sentence, long paragraph and private term of a page."""
    for line, paragraph in iterate_paragraphs(text):
        total = count_words(paragraph)
        if total > MAX_PARAGRAPH_WORDS:
            yield line, f"paragraph of {total} words: {format_first_words(paragraph)}"
        for sentence in split_sentences(paragraph):
            n = count_words(sentence)
            if n > MAX_SENTENCE_WORDS:
                yield line, f"sentence of {n} words: {format_first_words(sentence)}"
    for line, words in iterate_prose_lines(text):
        for found in PRIVATE_TERMS.finditer(words):
            yield line, f"private term `{found[0]}`"


def iterate_prose_lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield the number and the plain words of each line outside code blocks, displayed formulas and comments.

    Code spans and formulas become one word, links become their text.
    """
    text = re.sub(r"<!--.*?-->", lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL)
    fence = ""
    for number, line in enumerate(text.splitlines(), start=1):
        mark = FENCE.match(line)
        if fence:
            if line.strip().endswith(fence):
                fence = ""
        elif mark:
            if line.strip() == mark[1] or not line.strip().endswith(mark[1]):
                fence = mark[1]
        else:
            line = re.sub(r"`[^`]*`", "`code`", line)
            line = re.sub(r"\$[^$]+\$", "$x$", line)
            yield number, re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)


def iterate_paragraphs(text: str) -> Iterator[tuple[int, str]]:
    """Yield the first line and the words of each paragraph and list item; headings and tables are left out."""
    start, parts, last = 0, list[str](), 0
    for number, line in iterate_prose_lines(text):
        is_break = not line.strip() or line.lstrip().startswith(("#", "|", "<", "("))
        if parts and (is_break or ITEM.match(line) or number != last + 1):
            yield start, " ".join(parts)
            parts = []
        if not is_break:
            start = start if parts else number
            parts.append(ITEM.sub("", line).strip())
        last = number
    if parts:
        yield start, " ".join(parts)


def split_sentences(paragraph: str) -> list[str]:
    """Return the sentences of a paragraph. A colon before a capital letter ends a sentence too."""
    return SENTENCE_END.split(ABBREVIATION.sub(r"\1", paragraph))


def count_words(text: str) -> int:
    """Return the number of words: parts between spaces that contain a letter or a digit."""
    return sum(bool(WORD.search(part)) for part in text.split())


def format_first_words(text: str) -> str:
    """Return the first eight words of a text, for a message."""
    return " ".join(text.split()[:8]) + " …"


def check_docstrings(source: str) -> Iterator[tuple[int, str]]:
    """Yield the line and a message for each docstring whose first sentence is not formed as a sentence."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            text = ast.get_docstring(node)
            if text is not None and not is_sentence(text):
                line = node.body[0].lineno
                yield line, f"first sentence of the docstring: {format_first_words(text)}"


def is_sentence(docstring: str) -> bool:
    """Return whether the first sentence begins with a capital letter and ends with a full stop.

    The first sentence lies in the first paragraph. A code span or a symbol may stand at the start.
    """
    paragraph = docstring.strip().split("\n\n")[0]
    begins = paragraph[:1].isupper() or not paragraph[:1].isalpha()
    return bool(paragraph) and begins and bool(FIRST_SENTENCE_END.search(paragraph))


def check_ratchet(counts: dict[str, int], allowed: dict[str, int]) -> list[str]:
    """Return a message for each folder whose number of wrong docstrings differs from the allowed one."""
    messages = []
    for folder, limit in allowed.items():
        n = counts.get(folder, 0)
        if n > limit:
            messages.append(f"{folder}: {n} docstrings with a wrong first sentence, {limit} allowed")
        elif n < limit:
            messages.append(f"{folder}: {n} docstrings with a wrong first sentence: run tools/prose.py --lower")
    return messages


def lower_allowed(source: str, counts: dict[str, int]) -> str:
    """Return this file's text with the smaller of the allowed and the present number for each folder."""
    lowered = {folder: min(limit, counts[folder]) for folder, limit in ALLOWED.items()}
    entries = ", ".join(f'"{folder}": {n}' for folder, n in lowered.items())
    return re.sub(r"^ALLOWED = \{.*\}$", f"ALLOWED = {{{entries}}}", source, flags=re.MULTILINE)


def main() -> int:
    """Print what does not comply, with file and line. Return 1 if there is anything, otherwise 0."""
    pages = [
        f"{page.relative_to(ROOT)}:{line}: {message}"
        for page in list_checked_pages()
        for line, message in check_page(page.read_text(encoding="utf-8"))
    ]
    docstrings = {
        folder: [
            f"{file.relative_to(ROOT)}:{line}: {message}"
            for file in sorted((ROOT / folder).rglob("*.py"))
            for line, message in check_docstrings(file.read_text(encoding="utf-8"))
        ]
        for folder in ALLOWED
    }
    counts = {folder: len(found) for folder, found in docstrings.items()}
    if "--lower" in sys.argv:
        file = Path(__file__)
        file.write_text(lower_allowed(file.read_text(encoding="utf-8"), counts), encoding="utf-8")
        return 0
    listed = [folder for folder in ALLOWED if counts[folder] > ALLOWED[folder] or "--all" in sys.argv]
    messages = [*pages, *check_ratchet(counts, ALLOWED)]
    for text in [*(text for folder in listed for text in docstrings[folder]), *messages]:
        print(text)
    return int(bool(messages))


if __name__ == "__main__":
    sys.exit(main())
