"""Sketches of joint types and force elements, as their files have them, and the letters in them."""

from __future__ import annotations

import importlib
import inspect
import re
import unicodedata
from collections.abc import Iterator

_RAISED = str.maketrans(dict.fromkeys("²³⁰¹⁻", " "))


def sketch_of(folder: str, kind: str) -> list[str]:
    """What the file of a joint type or force element says at its top: a line, then its sketch."""
    doc = inspect.cleandoc(importlib.import_module(f"gudgeon.generator.kinds.{folder}.{kind}").__doc__ or "")
    summary, _, rest = doc.partition("\n")
    return [summary, *rest.strip("\n").splitlines()]


def letters_of(lines: list[str]) -> Iterator[str]:
    """Letters that stand alone in a sketch, with their subscripts; those with dots without them too.

    No part of a drawing ("o---"), no initial ("L. C. Bo"), no article.
    """
    alone = re.compile(r"(?<![\w.'-])(?!(?:a|A|I) [a-z]{2})([^\W\d_]\u0307?\u0307?(?:_\w+)?)(?![\w.'-])")
    for line in lines:
        for found in alone.findall(unicodedata.normalize("NFD", line).translate(_RAISED)):
            yield from dict.fromkeys((found, found.replace("\u0307", "")))
