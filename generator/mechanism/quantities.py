"""All numbers in a part of a mechanism."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass

from gudgeon.generator.mechanism.mechanism import Quantity
from gudgeon.language.curves import Curve


def quantities(part: object) -> Iterator[Quantity]:
    """Those of a frozen value, of what it holds and of what that holds."""
    if isinstance(part, Quantity):
        yield part
        return
    inner: Iterable[object] = ()
    if isinstance(part, Curve):  # its numbers are no quantities, and may be millions
        return
    if is_dataclass(part):
        inner = (getattr(part, one.name) for one in fields(part))
    elif isinstance(part, Mapping):
        inner = part.values()
    elif isinstance(part, (tuple, list)):
        inner = part
    for one in inner:
        yield from quantities(one)
