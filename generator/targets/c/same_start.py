"""When the starts of two runs are the same: when nothing that closing the linkage reads of their numbers differs."""

from __future__ import annotations

import re
from collections.abc import Iterable

NAME = "same_start"
_READ = re.compile(r"\bp->(\w+)\b(?!\[)")
_OTHERWISE = re.compile(r"\bp\b")  # handed over whole, or a table of it
_HARMLESS = ("const Parameters *p", "(void)p")


def same_start(read: Iterable[str]) -> str:
    """The function that tells it, from the texts of those that a start calls (`engine/scene/start.c`)."""
    text = "\n".join(read)
    names = dict.fromkeys(_READ.findall(text))
    left = _READ.sub("", text)
    for word in _HARMLESS:
        left = left.replace(word, "")
    tests = "\n        && ".join(f"same_number(p->{name}, other->{name})" for name in names)
    known = not _OTHERWISE.search(left)
    body = f"    return {tests};\n" if known and tests else f"    (void)p, (void)other;\n    return {int(known)};\n"
    return (
        "\n/* Whether a start with these numbers is that with the others: what closing the linkage reads. */\n"
        f"int {NAME}(const Parameters *p, const Parameters *other)\n{{\n{body}}}\n"
    )
