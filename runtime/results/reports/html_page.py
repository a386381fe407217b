"""Build a self-contained HTML page of headings, tables and figures; light and dark, for screens, phones and paper.

Text from a file must be escaped: use `escape`, or pass it to `build_table` or `build_paragraphs`, which escape it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from gudgeon.language.text_output import escape_invisible, format_one_line

Section = tuple[str, str]  # heading, text; what is under it, HTML
_HEADING_ID = "chapter-"  # of a heading to which a link goes

STYLE = """
.g-report { --ink: #1c1c1e; --paper: #fff; --quiet: #62656a; --line: #d9dce0; --panel: #f5f6f7; --accent: #0067a8;
  --second: #c2410c; color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
@media (prefers-color-scheme: dark) { .g-report { --ink: #e7e8ea; --paper: #16181b; --quiet: #a3a8ae; --line: #383c42;
  --panel: #1f2226; --accent: #6cb8f0; --second: #f59e6b; } }
.g-report { background: var(--paper); }
.g-report h1 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 .3rem; }
.g-report h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; border-bottom: 1px solid var(--line); }
.g-report h3 { font-size: 1rem; margin: 1rem 0 .3rem; }
.g-report :is(h1, h2, h3, p, li, td, th, figcaption) { overflow-wrap: anywhere; }
.g-report .g-wide { overflow-x: auto; max-width: 100%; }
.g-report table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .4rem 0; font-size: .92em; }
.g-report :is(td, th) { padding: .2rem .7rem .2rem 0; text-align: right; vertical-align: top; overflow-wrap: normal;
  white-space: nowrap; }
.g-report :is(td, th):first-child { text-align: left; }
.g-report .g-words :is(td, th) { text-align: left; white-space: normal; min-width: 4rem; max-width: 30rem; }
@media (max-width: 40rem) { .g-report .g-words :is(td, th):nth-child(n + 2) { min-width: 7rem; }
  .g-report .g-words :is(td, th):first-child { min-width: 2.5rem; }
  .g-report .g-words :is(td, th):last-child { min-width: 14rem; } }
.g-report .g-pairs td { white-space: normal; }
.g-report .g-side-by-side > div { min-width: 0; max-width: 100%; }
.g-report th { font-weight: 600; border-bottom: 1px solid var(--line); }
.g-report tbody tr + tr td { border-top: 1px solid var(--line); }
.g-report .g-quiet { color: var(--quiet); }
.g-report .g-contents ul { list-style: none; padding: 0; columns: 16rem; font-size: .92em; }
.g-report .g-contents a { color: var(--accent); text-decoration: none; }
.g-report .g-warning { border-left: 3px solid var(--second); padding-left: .7rem; }
.g-report figure { margin: .6rem 0; break-inside: avoid; }
.g-report figcaption { color: var(--quiet); font-size: .9em; }
.g-report .g-side-by-side { display: flex; flex-wrap: wrap; gap: .5rem 2rem; align-items: flex-start; }
.g-report .g-figures { display: grid; gap: 1rem;
  grid-template-columns: repeat(auto-fit, minmax(min(27rem, 100%), 1fr)); }
.g-report svg { max-width: 100%; height: auto; }
.g-report .g-figures svg { width: 100%; background: #fff; border-radius: 4px; }
.g-report .g-circle { fill: var(--panel); stroke: var(--quiet); }
.g-report .g-path { fill: none; stroke: var(--accent); stroke-linejoin: round; }
.g-report .g-start { fill: var(--paper); stroke: var(--ink); }
@media print { .g-report { --ink: #000; --paper: #fff; --quiet: #444; --line: #bbb; --panel: #f6f6f6; --accent: #0067a8;
  --second: #c2410c; font-size: 10pt; } .g-report .g-wide { overflow: visible; } .g-report tr { break-inside: avoid; } }
"""
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><title>{title}</title>
<style>html {{ background: #fff; }} @media (prefers-color-scheme: dark) {{ html {{ background: #16181b; }} }}
@media print {{ html {{ background: #fff; }} }}
body {{ margin: 0; }} body > .g-report {{ max-width: 68rem; margin: 0 auto; padding: 1.5rem max(1rem, 2vw) 3rem; }}
</style></head>
<body>{article}</body></html>
"""


def build_page(title: str, description: str, sections: Iterable[Section], chapters: Iterable[str] = ()) -> str:
    """Return the text of a complete HTML file; sections without content are left out.

    `title` and `description` are text; `chapters` are headings to which links are listed at the top.
    """
    head = f"<h1>{escape_line(title)}</h1><p class='g-quiet'>{escape(escape_invisible(description))}</p>"
    filled_sections = [(name, content) for name, content in sections if content]
    linked_headings = [
        name for name in dict.fromkeys(chapters) if any(name == section_name for section_name, _ in filled_sections)
    ]
    links = "".join(
        f'<li><a href="#{_HEADING_ID}{k}">{escape(escape_invisible(name))}</a></li>'
        for k, name in enumerate(linked_headings)
    )
    table_of_contents = f"<nav class='g-contents'><ul>{links}</ul></nav>" if links else ""
    return PAGE.format(
        title=escape_line(title), article=build_article(filled_sections, head + table_of_contents, linked_headings)
    )


def build_article(sections: Iterable[Section], head: str = "", linked_headings: Sequence[str] = ()) -> str:
    """Return the HTML article of a page with its style, as a notebook displays it; sections without content are left
    out.

    `head` is HTML above the sections, `linked_headings` the headings that get an id for links.
    """
    id_attributes = {name: f' id="{_HEADING_ID}{k}"' for k, name in enumerate(linked_headings)}
    section_elements = [
        f"<section{id_attributes.pop(name, '')}><h2>{escape(escape_invisible(name))}</h2>{content}</section>"
        for name, content in sections
        if content
    ]
    return f"<article class='g-report'><style>{STYLE}</style>{head}{''.join(section_elements)}</article>"


def escape_line(content: str) -> str:
    """Return a text of a file as one escaped line."""
    return escape(format_one_line(content))


def build_table(column_names: Sequence[str], rows: Iterable[Sequence[str]], has_text_cells: bool = False) -> str:
    """Return an HTML table of escaped cells; "" without rows.

    `has_text_cells`: the cells are words, with the CSS class of words instead of that of numbers. Empty `column_names`
    leave out the header.
    """
    body_rows = "".join(
        f"<tr>{''.join(f'<td>{escape(escape_invisible(cell))}</td>' for cell in row)}</tr>" for row in rows
    )
    if not body_rows:
        return ""
    header_cells = "".join(f"<th scope='col'>{escape(escape_invisible(name))}</th>" for name in column_names)
    head_element = f"<thead><tr>{header_cells}</tr></thead>" if any(column_names) else ""
    class_attribute = " class='g-words'" if has_text_cells else "" if any(column_names) else " class='g-pairs'"
    element = f"<table{class_attribute}>{head_element}<tbody>{body_rows}</tbody></table>"
    return f"<div class='g-wide' tabindex='0'>{element}</div>"


def build_paragraphs(texts: Iterable[str], css_class: str = "") -> str:
    """Return an HTML paragraph of escaped text for each text, of the CSS class `css_class` if it is not empty."""
    class_attribute = f" class='{css_class}'" if css_class else ""
    return "".join(f"<p{class_attribute}>{escape(escape_invisible(text))}</p>" for text in texts)
