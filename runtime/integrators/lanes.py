"""Runs of a batch side by side in vector registers (engine/batch/lanes.h): rk4 with one step for all.

Their library is compiled when a batch first asks for it. It moves runs on as far as they go together; what is then
not over goes on alone, from where it is.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.model.arrays import address
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.times import Times

NEW, OVER = 0, 2  # phases of a run
NOT_CLOSED = -9  # status: the start is left to the search in Python
NONE = -1  # in place of the number of a run
LEAST = 2  # runs that are worth a vector


class Lanes:
    """The library of a scene's runs side by side; `count` of them."""

    def __init__(self, compiled: CompiledModel) -> None:
        from gudgeon.loading.build import compile_kernels
        from gudgeon.loading.engine import lane_declarations

        source = replace(compiled.source, main=compiled.source.lanes, cdef=lane_declarations())
        module: Any = compile_kernels(source, portable=compiled.portable)
        self.lib, self.ffi = module.lib, module.ffi
        self.count = int(self.lib.gudgeon_lane_count())
        single = compiled.ffi.cast("uintptr_t", compiled.lib.gudgeon_single())
        self.single = self.ffi.cast("void *", int(single))

    def groups(self, numbers: list[int], steps: Array, times: Times) -> list[list[int]]:
        """Runs that go side by side: neighbours with the same step and times."""
        groups: list[list[int]] = []
        for i in numbers:
            first = groups[-1][0] if groups and len(groups[-1]) < self.count else i
            if first != i and steps[first] == steps[i] and times.same(first, i):
                groups[-1].append(i)
            else:
                groups.append([i])
        return groups

    def together(self, runs: Runs, group: list[int], memories: NDArray[np.uint8]) -> None:
        """Moves these runs on, each in a row of `memories`, until none goes on with others."""
        rows = [address(runs.compiled.ffi, memory) for memory in memories[: self.count]]
        pointers = self.ffi.new("void *[]", [self.ffi.cast("void *", row) for row in rows])
        number = self.ffi.new("long[]", [*group, *[NONE] * (self.count - len(group))])
        batch = self.ffi.cast("void *", int(runs.compiled.ffi.cast("uintptr_t", runs.struct)))
        listed = bool(runs.compiled.source.clearances or runs.compiled.source.events)
        goes_on = True
        while goes_on and not runs.stopping:
            before = list(number)
            goes_on = bool(self.lib.gudgeon_lanes(batch, self.single, pointers, number))
            for k, i in enumerate(group):
                if listed and before[k] != NONE and runs.arrays["status"][i] != NOT_CLOSED:
                    over = bool(runs.arrays["phase"][i] == OVER)
                    runs.fetch(i, runs.compiled.pointer(memories[k], "void *"), over)


def wanted(compiled: CompiledModel, method: str, steps: Array) -> bool:
    """Whether a batch has runs that may go side by side."""
    return method == "rk4" and bool(compiled.source.lanes) and bool((steps[1:] == steps[:-1]).any())
