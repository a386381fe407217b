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


def patched(text: str, *replacements: tuple[str, str]) -> str:
    """Return `text` with every (old, new) replaced in turn. AssertionError where `old` is not in it once."""
    for old, new in replacements:
        assert text.count(old) == 1, f"{old!r} is in the text {text.count(old)} times"
        text = text.replace(old, new)
    return text


def loader(folder: Path, formulation: str = "reduced") -> Load:
    """`load(text, scene)`: the text without its head, as a file in `folder`."""
    numbers = itertools.count()

    def load(text: str, scene: str | None = None) -> Simulation:
        file = folder / f"attacked_{next(numbers)}.yaml"
        file.write_text(_HEAD + textwrap.dedent(text), encoding="utf-8")
        return gudgeon.load(file, scene, formulation=formulation)

    return load
