"""Compress the JavaScript and CSS of this package for embedding in a page."""

from __future__ import annotations

import re

# comments alone on their lines, or after code with a space on either side
_COMMENT = re.compile(r"^ *(?:/\*.*?\*/|//[^\n]*)\n|(?<=\S) // [^\n]*$", re.DOTALL | re.MULTILINE)
# strings within a line of JavaScript, template strings included
_TEXT = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|`[^`]*`)""")
_SPACED = re.compile(
    r" ?(=>|[!=]==|\?\?=?|&&|\|\||[=,?:;(){}]) ?"
    r"|(?<![-+]) ([-+*/%<>]|[<>]=|>>) (?![-+])"  # not in a - -b
)
_LINE_END = re.compile(r"(?<=[{;,(])\n$")  # that ends no statement


def compress_script(text: str) -> str:
    """Return a JavaScript file without comments, indents and spaces around punctuation, for embedding in a page.

    Ends of lines are kept where they may end statements. Lines keep their spaces within template strings over several
    lines, and if template strings are nested.
    """
    lines, in_template_string = list[str](), False
    for line in re.sub(r"(?m)^ +|^\n", "", _COMMENT.sub("", text)).split("\n"):
        ends_template_string = line.count("`") % 2 == 1
        if in_template_string or ends_template_string or re.search(r"\${[^}]*`", line):
            lines.append(f"{line}\n")
        else:
            parts = _TEXT.split(line)
            parts[::2] = (_SPACED.sub(lambda match: match[1] or match[2], part) for part in parts[::2])
            lines.append(_LINE_END.sub("", "".join(parts) + "\n"))
        in_template_string ^= ends_template_string
    return "".join(lines)


def compress_style_sheet(text: str) -> str:
    """Return CSS without comments, and without spaces around punctuation, for embedding in a page."""
    without_comments = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return re.sub(r"\s*([{};,>])\s*|(?<=:) ", r"\1", without_comments).replace(";}", "}").strip()
