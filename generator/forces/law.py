"""What a force law declares. One file in this folder is one law; it exports `LAW`.

This module and the top level of every law file import no SymPy: reading a YAML file needs a law's
parameters and options, not its equations. Equations are built inside functions.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from gudgeon.generator.units import Dimension


@dataclass(frozen=True)
class LawParameter:
    """A number of a law: a run-time slot `contacts.<contact>.<role>.<name>`."""

    name: str
    symbol: str  # as in the paper, in LaTeX
    meaning: str
    dimension: Dimension
    default: float | None = None  # None: the user must give it
    bounds: tuple[tuple[str, float | str], ...] = ()  # (relation, number or name of another parameter)


@dataclass(frozen=True)
class LawOption:
    """A structural choice of a law; bool options have values (False, True)."""

    name: str
    values: tuple[str | bool, ...]
    default: str | bool
    meaning: str


@dataclass(frozen=True)
class Law:
    """A force law: its equation is `expression(...)`, whose arguments depend on the role."""

    name: str
    role: str  # "normal", "friction" or "film": the key under a contact in the YAML
    title: str
    source: str
    validity: str
    parameters: tuple[LawParameter, ...]
    options: tuple[LawOption, ...]
    build: Callable[..., Any]


@cache
def laws() -> Mapping[str, Law]:
    """All the laws in this folder by name."""
    package = importlib.import_module("gudgeon.generator.forces")
    found = {}
    for info in pkgutil.iter_modules(package.__path__):
        law = getattr(importlib.import_module(f"gudgeon.generator.forces.{info.name}"), "LAW", None)
        if isinstance(law, Law):
            found[law.name] = law
    return found
