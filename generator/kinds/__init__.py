"""One-file extensions, found by being in their folder: a new joint, law or force element is one new file."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from typing import TypeVar

T = TypeVar("T")


def declared(package: str, attribute: str, kind: type[T]) -> Iterator[T]:
    """`attribute` of every module of `package` that has one of that kind, in the order of their names."""
    for info in pkgutil.iter_modules(importlib.import_module(package).__path__):
        value = getattr(importlib.import_module(f"{package}.{info.name}"), attribute, None)
        if isinstance(value, kind):
            yield value
