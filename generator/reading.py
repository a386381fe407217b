"""The first stages, which import no SymPy: YAML → Mechanism → Scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
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


def touches(data: bytes, file: str, scene: str, overrides: Overrides) -> bool:
    """Whether overrides change anything that a scene is derived from. Raises InputError as read_scene does."""
    with_them, without = (read_scene(data, file, scene, own) for own in (overrides, None))
    return _alone(with_them) != _alone(without)


def _alone(scene: Scene) -> Scene:
    """Without the mechanism's other scenes."""
    return replace(scene, mechanism=replace(scene.mechanism, scenes={}))


@contextmanager
def stage(name: str, seconds: Seconds | None) -> Iterator[None]:
    """A stage of the compiler, which notes how long it took where somebody wants to know."""
    begun = perf_counter()
    yield
    if seconds is not None:
        seconds[name] = perf_counter() - begun
