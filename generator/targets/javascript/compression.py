"""Minifies the JavaScript and CSS of this package for embedding in a page."""

from __future__ import annotations

import re

# comments alone on their lines, or after code with a space on either side
_COMMENT = re.compile(r"^ *(?:/\*.*?\*/|//[^\n]*)\n|(?<=\S) // [^\n]*$", re.DOTALL | re.MULTILINE)
# strings within a line of JavaScript, template strings included
_TEXT = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|`[^`]*`)""")
_SPACED_PUNCTUATION = re.compile(
    r" ?(=>|[!=]==|\?\?=?|&&|\|\||[=,?:;(){}]) ?"
    r"|(?<![-+]) ([-+*/%<>]|[<>]=|>>) (?![-+])"  # not in a - -b
)
_SUPERFLUOUS_LINE_END = re.compile(r"(?<=[{;,(])\n$")  # after a character that cannot end a statement, or ";"


def compress_script(text: str) -> str:
    """Return a JavaScript file minified: without comments, indents and spaces around punctuation.

    Line breaks stay where they may end a statement. Lines of a template string over several lines, or with a nested
    template string, keep their spaces. The text must be code of this package: comments are found by their position.
    """
    lines, in_template_string = list[str](), False
    for line in re.sub(r"(?m)^ +|^\n", "", _COMMENT.sub("", text)).split("\n"):
        ends_template_string = line.count("`") % 2 == 1
        if in_template_string or ends_template_string or re.search(r"\${[^}]*`", line):
            lines.append(f"{line}\n")
        else:
            parts = _TEXT.split(line)
            parts[::2] = (_SPACED_PUNCTUATION.sub(lambda match: match[1] or match[2], part) for part in parts[::2])
            lines.append(_SUPERFLUOUS_LINE_END.sub("", "".join(parts) + "\n"))
        in_template_string ^= ends_template_string
    return "".join(lines)


def compress_style_sheet(text: str) -> str:
    """Return CSS minified: without comments, spaces around punctuation and the last semicolon of a rule."""
    without_comments = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return re.sub(r"\s*([{};,>])\s*|(?<=:) ", r"\1", without_comments).replace(";}", "}").strip()
