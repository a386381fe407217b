"""Select the kinematic runs of a batch that Python must check: those with an error in the audit in C, or all runs.

All runs are checked if C cannot decide: with `audit="full"`, resumed runs, redundant equations or periodic drives.

C audits the samples of kinematic runs as `audit.SampleAudit` does (engine/kinematic/ensemble.c), and finds samples that
are not finite, at change points, or with steep accelerations. Only those runs are evaluated in full.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gudgeon.assembly.rank import list_redundant_equations
from gudgeon.integrators.batch import Runs
from gudgeon.model.period_jumps import list_periodic_drives
from gudgeon.model.sizes import compute_mechanism_sizes
from gudgeon.simulation.audit import (
    LIMITS,
    SHORT_RUN_POSITIONS,
    find_deviating_starts,
    list_given_coordinates,
    list_inapplicable_checks,
)
from gudgeon.simulation.stored_series import find_evaluation_times_of_run


class SuspectRuns:
    """Select the runs to be checked in Python; without a kinematic ensemble these are all runs.

    `is_resumed`: the runs begin at the states of earlier runs, whose violations Python reports. `checks_all`: all runs
    are selected.
    """

    def __init__(self, runs: Runs, is_resumed: bool) -> None:
        self._runs = runs
        compiled, source = runs.compiled, runs.compiled.source
        self.checks_all = (
            runs.kinematic is None
            or runs.audit > 1
            or is_resumed
            or bool(list_redundant_equations(compiled) or list_periodic_drives(source))
        )
        if runs.kinematic and runs.audit == 1:
            left_out = list_inapplicable_checks(source, runs.method)
            limits = [np.inf if check in left_out else limit for check, limit in LIMITS.items()]
            runs.kinematic.set_sample_audit(SHORT_RUN_POSITIONS, np.array(limits))

    def select_runs_to_check(self, finished_runs: Sequence[int]) -> list[int]:
        """Return the indices of those of the finished runs that Python must check.

        They are runs that the audit in C reports, starts that differ from `start.set`, and accelerations that jump at
        the last sample. With `checks_all` they are all runs.
        """
        if self.checks_all:
            return list(finished_runs)
        arrays, indices, compiled = self._runs.arrays, np.array(finished_runs, np.intp), self._runs.compiled
        is_suspect = arrays["is_suspect"][indices] > 0
        if self._runs.audit and list_given_coordinates(compiled.source):
            p = arrays["p"][indices]
            size = compute_mechanism_sizes(compiled.source, p)
            is_suspect |= find_deviating_starts(compiled.source, p, arrays["start"][indices], size)
        if compiled.may_drive_acceleration_jump:
            is_suspect |= [self._ends_at_jump(i) for i in finished_runs]
        return [int(i) for i in indices[is_suspect]]

    def _ends_at_jump(self, i: int) -> bool:
        """Return whether an acceleration jumps at the last sample of run i; Python must then store its left limit."""
        return bool(find_evaluation_times_of_run(self._runs, i)[-1] < self._runs.get_samples(i)[0][-1])
