"""Sketches of joint types and force elements, as their declarations have them, and the letters in them."""

from __future__ import annotations

import inspect
import re
import unicodedata
from collections.abc import Iterator

from gudgeon.generator.kinds.forces.force_type import ElementType
from gudgeon.generator.kinds.joints.joint_type import JointType

_RAISED = str.maketrans(dict.fromkeys("²³⁰¹⁻", " "))


def sketch_of(of: JointType | ElementType) -> list[str]:
    """Return what documents say of a joint type or force element: a line, then its sketch."""
    summary, _, rest = inspect.cleandoc(of.doc or "").partition("\n")
    return [summary, *rest.strip("\n").splitlines()]


def letters_of(lines: list[str]) -> Iterator[str]:
    """Letters that stand alone in a sketch, with their subscripts; those with dots without them too.

    No part of a drawing ("o---"), no initial ("L. C. Bo"), no article.
    """
    alone = re.compile(r"(?<![\w.'-])(?!(?:a|A|I) [a-z]{2})([^\W\d_]\u0307?\u0307?(?:_\w+)?)(?![\w.'-])")
    for line in lines:
        for found in alone.findall(unicodedata.normalize("NFD", line).translate(_RAISED)):
            yield from dict.fromkeys((found, found.replace("\u0307", "")))
