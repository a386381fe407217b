"""Finds joint types, force laws and force elements: each is defined by one file in its folder."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from typing import TypeVar

T = TypeVar("T")


def iterate_declarations(package: str, attribute: str, declared_type: type[T]) -> Iterator[T]:
    """Yield `attribute` of each module of `package` whose value is of type `declared_type`, in the order of module
    names.

    The modules are imported; modules without such a value are skipped.
    """
    for info in pkgutil.iter_modules(importlib.import_module(package).__path__):
        value = getattr(importlib.import_module(f"{package}.{info.name}"), attribute, None)
        if isinstance(value, declared_type):
            yield value
