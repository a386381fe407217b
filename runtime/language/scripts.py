"""JavaScript of ours as a page carries it: what runs, without comments and indents; both are read here."""

from __future__ import annotations

import re

# as we write them: alone on their lines, or behind code with a space on either side
_COMMENT = re.compile(r"^ *(?:/\*.*?\*/|//[^\n]*)\n|(?<=\S) // [^\n]*$", re.DOTALL | re.MULTILINE)


def carried_script(text: str) -> str:
    """The text of a file, half as much again shorter; lines stay lines, for they end statements."""
    return re.sub(r"(?m)^ +|^\n", "", _COMMENT.sub("", text))
