"""Audit a few samples of a run in reusable memory by the checks in C: power, torques, constraint equations.

These are those of `audit._check_random_samples`. The other checks of samples in audit.py need all quantities at all
samples, which only `simulate` evaluates.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import AUDIT_FAILS, COUNT_NAMES, N_WORK
from gudgeon.integrators.reusable_run import N_ROWS, ReusableRun
from gudgeon.simulation.audit import (
    LIMITS,
    MAX_CALLS_OF_SHORT_RUN,
    SAMPLE_POSITIONS,
    list_inapplicable_checks,
    select_audit_samples,
)

Arguments = tuple[Any, ...]
RIGHT_HAND_SIDES = COUNT_NAMES.index("right_hand_sides")  # column of the counts of a run


class ReusableSampleAudit:
    """Audit samples of the runs of a ReusableRun; `is_resumed`: the first sample is the resumed state, not checked."""

    def __init__(self, run: ReusableRun, is_resumed: bool) -> None:
        self.run, self.is_resumed = run, is_resumed
        left_out = list_inapplicable_checks(run.compiled.source, run.method)
        self._limits = np.array([np.inf if check in left_out else AUDIT_FAILS * x for check, x in LIMITS.items()])
        pointer, x = run.compiled.pointer, run.arrays
        self._errors = np.zeros((len(SAMPLE_POSITIONS), len(LIMITS)))
        self._errors_pointer = pointer(self._errors, is_written=True)
        self._t = pointer(run.times.t)
        self._rows = [(pointer(x["y"][k]), pointer(x["discrete_states"][k]), pointer(x["p"][k])) for k in range(N_ROWS)]
        # by row, number of samples, and whether the run is short
        self._arguments: dict[tuple[int, int, bool], list[tuple[Arguments, Any]]] = {}

    def audit_samples(self, k: int) -> bool:
        """Audit samples of the run in row k, and return whether one exceeds the error at which `simulate` fails.

        Return False without an audit. Errors that are not finite do not count: the check "finite" of `simulate`
        reports them.
        """
        run, arrays = self.run, self.run.arrays
        if not run.audit:
            return False
        n_samples, right_hand_sides = arrays["done"].item(k), arrays["counts"].item(k, RIGHT_HAND_SIDES)
        key = k, n_samples, run.audit <= 1 and right_hand_sides <= MAX_CALLS_OF_SHORT_RUN
        if key not in self._arguments:
            self._arguments[key] = self._list_arguments(k, select_audit_samples(n_samples, run.audit, right_hand_sides))
        size, arguments = arrays["size"].item(k), self._arguments[key]
        for pointers, errors_of_sample in arguments:
            run.compiled.lib.gudgeon_audit_samples(1, *pointers, size, errors_of_sample)
        errors = self._errors[: len(arguments)]
        if b"\0" not in (errors <= self._limits).tobytes():  # quicker than all()
            return False
        return bool(((errors > self._limits) & (errors < np.inf)).any())

    def _list_arguments(self, k: int, samples: NDArray[np.intp]) -> list[tuple[Arguments, Any]]:
        """Return the arguments of gudgeon_audit_samples for each of these samples of row k: pairs of pointers.

        The first of a pair are pointers to t, q, v, discrete states and p, the second a pointer to the len(LIMITS)
        errors that C writes. The first sample of a resumed run is left out if there are others.
        """
        compiled, (y, discrete_states, p) = self.run.compiled, self._rows[k]
        if self.is_resumed and len(samples) > 1:
            samples = samples[samples > 0]
        width, n_discrete = 2 * compiled.n + N_WORK, max(compiled.n_discrete_states, 1)
        return [
            (
                (self._t + i, y + width * i, y + (width * i + compiled.n), discrete_states + n_discrete * i, p),
                self._errors_pointer + len(LIMITS) * j,
            )
            for j, i in enumerate(samples.tolist())
        ]
