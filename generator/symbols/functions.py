"""SymPy's classes of the functions that expressions may use (gudgeon.language.functions)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from gudgeon.language.functions import IN_SYMPY, Function

CLASSES: Mapping[Any, Function] = {getattr(sp, name): function for name, function in IN_SYMPY.items()}


def classes_where(has: Callable[[Function], bool]) -> tuple[Any, ...]:
    """Return SymPy's classes of the functions for which `has` holds."""
    return tuple(kind for kind, function in CLASSES.items() if has(function))
