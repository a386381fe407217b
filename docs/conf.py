"""The documentation as a site: `make docs`. Pages are the files beside this one, references come from docstrings."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from importlib.metadata import version as installed
from pathlib import Path

from docutils.nodes import SkipNode
from latex2mathml.converter import convert

project, author, version = "gudgeon", "The gudgeon authors", installed("gudgeon")
copyright = author
extensions = ["myst_parser", "sphinx.ext.autodoc"]
html_math_renderer = "mathml"  # of setup(): no page loads a script from elsewhere
exclude_patterns = ["build"]
html_theme = "furo"
html_title = f"gudgeon {version}"
html_static_path: list[str] = []
html_search_scorer = str(Path(__file__).with_name("scorer.js"))
html_extra_path = ["../build/pages"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_maximum_signature_line_length = 100
autodoc_preserve_defaults = True
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}
nitpicky = False


ARGUMENT = re.compile(r"(``)?[a-z_\\]+(``)?(, (``)?[a-z_\\]+(``)?)*( \([^)]*\))?: \S")


def as_text(app, what, name, obj, options, lines):  # type: ignore[no-untyped-def]
    """Docstrings are plain: stars, bars and backticks in them stand for themselves, lists and indents stay.

    A line that begins with an argument's name and a colon is a paragraph of its own, and so is a list.
    """
    plain = [_plain(line) for line in lines]
    lines[:], listed = [], False
    for line in plain:
        was, listed = listed, line.startswith("- ") or (listed and line.startswith("  "))
        lines += ["", line] if listed != was or ARGUMENT.match(line) else [line]


def _plain(line: str) -> str:
    """What stands between backticks stays, of the rest what looks like markup stands for itself."""
    parts = line.split("`")
    return "``".join(part if k % 2 else re.sub(r"([*|\\_])", r"\\\1", part) for k, part in enumerate(parts))


def beyond(app, docname, source):  # type: ignore[no-untyped-def]
    """Replace links to files of the sources that are not pages of the site by their text; pictures stay."""
    docs = Path(__file__).parent
    folder = (docs / docname).parent

    def shown(link: re.Match[str]) -> str:
        file = (folder / link[2].partition("#")[0]).resolve()
        return link[0] if file.suffix == ".md" and file.is_file() and docs in file.parents else link[1]

    source[0] = re.sub(r"(?<!!)\[([^\]]+)\]\((\.\./[^)]*)\)", shown, source[0])


# Pages whose text is another file's of the sources
INCLUDED = {
    "benchmarks": "benchmarks/README.md",
    "clearance": "benchmarks/clearance/README.md",
    "contributing": "CONTRIBUTING.md",
}


def include_text(app, docname, source):  # type: ignore[no-untyped-def]
    """Fill the pages of INCLUDED with the text of their files, with links as from docs/."""
    if docname not in INCLUDED:
        return
    text = (Path(__file__).parents[1] / INCLUDED[docname]).read_text("utf-8").partition("\n")[2]
    text = text.replace("](figures/", "](../benchmarks/figures/").replace("](clearance/README.md)", "](clearance.md)")
    text = re.sub(r"\]\((\.\./)*docs/", "](", text)
    docs = Path(__file__).parent
    own = {path.relative_to(docs).as_posix() for path in docs.rglob("*.md")}

    def shown(link: re.Match[str]) -> str:  # what is no page of the site is its name
        target = link[2].partition("#")[0]
        return link[0] if target in own or "://" in target else link[1]

    text = re.sub(r"(?<!!)\[([^\]]+)\]\(([^)]*)\)", shown, text)
    source[0] = source[0].partition("\n")[0] + "\n" + text


WRITES = re.compile(r"^```sh\ngudgeon (equations .* -o (\w+\.html))\n```$", re.MULTILINE)
RUNNING = r'\g<0>\n\n<p><a href="gallery/\g<2>">The page that it writes, on which this linkage runs</a></p>'


def running(app, config):  # type: ignore[no-untyped-def]
    """The gallery's pages, as its commands write them: `html_extra_path` takes them to the site. Not with `-t text`."""
    here = Path(__file__).parent
    folder = here.parent / "build/pages/gallery"
    folder.mkdir(parents=True, exist_ok=True)
    if app.tags.has("text"):
        return
    for specified, _ in WRITES.findall((here / "gallery.md").read_text("utf-8")):
        line = [sys.executable, "-m", "gudgeon", *specified.split()]
        subprocess.run(line, cwd=folder, check=True, stdout=subprocess.DEVNULL)


def linked(app, docname, source):  # type: ignore[no-untyped-def]
    """Each command of the gallery with its page."""
    if docname == "gallery":
        source[0] = WRITES.sub(RUNNING, source[0])


def first_pages():  # type: ignore[no-untyped-def]
    """Return the terms of search_terms.toml by the page that the search shows first for them."""
    docs = Path(__file__).parent
    pages: dict[str, list[str]] = {}
    for term, candidates in tomllib.loads((docs / "search_terms.toml").read_text("utf-8")).items():
        page = next(name for name in candidates if (docs / f"{name}.md").is_file())
        pages.setdefault(page, []).append(term)
    return pages


def indexed(app, docname, source):  # type: ignore[no-untyped-def]
    """Add the index entries of a page below its title; main entries ("!") come first in the search."""
    if terms := first_pages().get(docname):
        entries = ", ".join(f"! {term}" for term in terms)
        directive = f"\n\n```{{index}} {entries}\n```\n"
        source[0] = re.sub(r"^# .*$", lambda title: title[0] + directive, source[0], count=1, flags=re.MULTILINE)


def inline_math(writer, node):  # type: ignore[no-untyped-def]
    """Write a formula within a line as MathML."""
    writer.body.append(convert(node.astext()))
    raise SkipNode


def displayed_math(writer, node):  # type: ignore[no-untyped-def]
    """Write a formula in a line of its own as MathML."""
    writer.body.append(f'<div class="math">{convert(node.astext(), display="block")}</div>')
    raise SkipNode


def setup(app):  # type: ignore[no-untyped-def]
    """Connect the functions of this file to the stages of a build."""
    app.add_html_math_renderer("mathml", (inline_math, None), (displayed_math, None))
    app.connect("config-inited", running)  # before Sphinx looks whether the folder is there
    app.connect("source-read", linked)
    app.connect("source-read", include_text)
    app.connect("autodoc-process-docstring", as_text)
    app.connect("source-read", beyond)
    app.connect("source-read", indexed)
