"""Mechanisms written out in a test, loaded from a file of their own."""

from __future__ import annotations

import itertools
import textwrap
from collections.abc import Callable
from pathlib import Path

import gudgeon
from gudgeon.simulation.simulation import Simulation

Load = Callable[..., Simulation]
_HEAD = "format: gudgeon/1\nname: attacked\n"


def loader(folder: Path, formulation: str = "reduced") -> Load:
    """`load(text, scene)`: the text without its head, as a file in `folder`."""
    numbers = itertools.count()

    def load(text: str, scene: str | None = None) -> Simulation:
        file = folder / f"attacked_{next(numbers)}.yaml"
        file.write_text(_HEAD + textwrap.dedent(text), encoding="utf-8")
        return gudgeon.load(file, scene, formulation=formulation)

    return load
