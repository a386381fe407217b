"""A compiled scene beside the complex step of its equations, and how their Jacobians are compared."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from gudgeon.generator.equations.model import Model
from gudgeon.generator.pipeline import derive_scene, generate_c
from gudgeon.loading.build import compile_kernels
from gudgeon.loading.shipped import find_shipped_file
from gudgeon.model.compiled import CompiledModel
from tests.equations.complex_step import ComplexStep

NAN = float("nan")
GAINS = ("baumgarte.alpha", "baumgarte.beta")


@dataclass(frozen=True)
class Subject:
    """A library and what it is compared with; `p` are its numbers."""

    model: Model
    library: CompiledModel
    p: np.ndarray
    exact: ComplexStep

    @property
    def n(self) -> int:
        return self.library.n

    @cached_property
    def eccentricity(self) -> Callable[..., np.ndarray]:
        """That of the first joint with play, and its rate, as a function of (t, q, v)."""
        joint = self.model.clearances[0]
        return self.exact.function((*joint.eccentricity, *joint.eccentricity_rate))

    def compare(self, t: float, y: np.ndarray, memory: np.ndarray, tolerance: float = 1e-10) -> np.ndarray:
        """Checks f, J and f_t; gives J."""
        f, works = self.library.rhs(t, y, self.p, memory), slice(2 * self.n, 2 * self.n + 3)
        assert_columns(f[:, None], self.exact(t, y, memory).real[: works.stop, None], self.n, tolerance)
        J, f_t = self.library.jacobian(t, y, self.p, memory)
        want, want_t = self.exact.jacobian(t, y, memory)
        assert_columns(np.delete(J, works, axis=1), want, self.n, tolerance)
        assert_columns(f_t[:, None], want_t[:, None], self.n, tolerance)
        assert not J[:, works].any()
        return J


def assert_columns(got: np.ndarray, want: np.ndarray, n: int, tolerance: float) -> None:
    """Velocities, accelerations, powers, rates of internal states, each column relative to its largest entry.

    Not less than 1e-4 of the block's largest, and 1e-2, below which nothing in these mechanisms matters.
    """
    for block in (slice(0, n), slice(n, 2 * n), slice(2 * n, 2 * n + 3), slice(2 * n + 3, None)):
        if not want[block].size:
            continue
        scale = np.maximum(np.abs(want[block]).max(axis=0), max(1e-4 * np.abs(want[block]).max(), 1e-2))
        assert (np.abs(got[block] - want[block]).max(axis=0, initial=0.0) <= tolerance * scale).all()


def make(data: bytes, name: str, scene: str, values: Mapping[str, float] | None = None, **options: object) -> Subject:
    """A scene; `values` by slot, `options` change the file itself."""
    return _made(data, name, scene, tuple((values or {}).items()), tuple(options.items()))


@cache
def _made(
    data: bytes, name: str, scene: str, pairs: tuple[tuple[str, float], ...], options: tuple[tuple[str, object], ...]
) -> Subject:
    model, library = _derived(data, name, scene, options)
    source, values = library.source, dict(pairs)
    given, mask = np.zeros(len(source.parameters)), np.zeros(len(source.parameters), dtype=bool)
    for k, slot in enumerate(source.parameters):
        if slot.address in values:
            given[k], mask[k] = values[slot.address], True
    return Subject(model, library, library.prepare(given, mask), ComplexStep(model, values))


@cache
def _derived(
    data: bytes, name: str, scene: str, options: tuple[tuple[str, object], ...]
) -> tuple[Model, CompiledModel]:
    """What the numbers have no part in."""
    model = derive_scene(data, name, scene, {key.replace("__", "."): x for key, x in options})  # type: ignore[misc]
    source = generate_c(model, "full")
    return model, CompiledModel(source, compile_kernels(source))


@cache
def shipped_subject(name: str, scene: str, gains: float = 50.0) -> Subject:
    return make(find_shipped_file(name).read_bytes(), name, scene, dict.fromkeys(GAINS, gains))
