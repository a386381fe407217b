"""The first stages, which import no SymPy: YAML → Mechanism → Scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter

from gudgeon.generator.mechanism.scene import Scene, make_scene
from gudgeon.generator.reader.read import read_mechanism

Overrides = Mapping[str, str | float | bool]
Seconds = dict[str, float]


def read_scene(
    data: bytes, file: str, scene: str, overrides: Overrides | None = None, seconds: Seconds | None = None
) -> Scene:
    """One scene of a mechanism file."""
    with stage("reading", seconds):
        return make_scene(read_mechanism(data, file, overrides), scene)


@contextmanager
def stage(name: str, seconds: Seconds | None) -> Iterator[None]:
    """A stage of the compiler, which notes how long it took where somebody wants to know."""
    begun = perf_counter()
    yield
    if seconds is not None:
        seconds[name] = perf_counter() - begun
