"""`gudgeon bench`: run time against error over the steps, scene by scene.

The error of a run is taken against the same method with a step at least four times shorter than the
shortest one that is tested; how much the two finest references differ is told beside it. Times are
the least of several runs on one thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.measure import work as measured
from gudgeon.measure.rhs import RhsTime, time_rhs
from gudgeon.measure.work import NAN, Attempt, Error, Parameters, Work, difference, natural_step, size
from gudgeon.simulation import Simulation
from gudgeon.step import scene_end

FINEST, COARSEST = 1 / 5, 200  # steps that are tested, of the step that a plain run takes
FINER = (4, 8)  # the references' steps: the finest tested one divided by these
REFERENCE_STEPS = 1_600_000  # of the reference: what bounds a smooth scene's window
KINEMATIC = (10, 100, 1_000, 10_000)  # samples of a scene without a degree of freedom
TRUSTED = 20  # times the references' difference: smaller errors are rounding
SMALL = 1e-3  # the largest error that tells an order
STRAIGHT = math.log(2.5)  # the deviation from a line that still tells one


@dataclass(frozen=True)
class Row:
    """One step, or with the kinematic method one number of samples."""

    step: float  # s; kinematic: between samples
    samples: int  # of a kinematic run, else 0
    seconds: float  # a simulated second; NaN if the run failed
    right_hand_sides: int
    error: Error
    failure: str = ""
    failed_at: float = NAN  # s


@dataclass(frozen=True)
class SceneBench:
    """All rows of one scene, from the longest step to the shortest."""

    scene: str
    method: str
    t_end: float
    why: str  # this window
    rows: tuple[Row, ...]
    reference: float  # s, its step; NaN: the error is max |Φ|, by the mechanism's size
    agreement: Error  # of the two finest references
    contact: float  # s, the shortest contact in the window; NaN: none
    rhs: tuple[RhsTime, ...]

    def order(self, measure: str) -> float:
        """Slope of log(error) over log(step), over the errors that are neither rounding nor large.

        NaN for fewer than three, or where they lie on no line (a stiff scene at its stability limit).
        """
        floor = TRUSTED * getattr(self.agreement, measure)
        points = [(row.step, getattr(row.error, measure)) for row in self.rows if not row.failure]
        kept = np.log([(h, e) for h, e in points if floor < e < SMALL])
        if len(kept) < 3:
            return NAN
        line = np.polyfit(kept[:, 0], kept[:, 1], 1)
        return float(line[0]) if np.std(np.polyval(line, kept[:, 0]) - kept[:, 1]) < STRAIGHT else NAN

    def row(self, step: float) -> Row | None:
        """The row of a step (s), if it was tested."""
        return next((row for row in self.rows if math.isclose(row.step, step, rel_tol=1e-6)), None)


Report = Callable[[float, str], None]


def bench(
    simulation: Simulation, steps: Sequence[float] | None = None, *, t_end: float | None = None,
    parameters: Parameters | None = None, quick: bool = False, progress: Report | None = None,
) -> SceneBench:  # fmt: skip
    """Measure one scene. `steps` (s) default to 1, 2, 5 · 10^k around the step of a plain run.

    `t_end` (s) defaults to the first few contacts or, without contact, to as many steps of the
    reference as are affordable. `quick` takes fewer steps and a tenth of the window.
    """
    parameters = dict(parameters or {})
    if simulation.source.degrees_of_freedom == 0:
        return _kinematic(simulation, parameters, KINEMATIC[:3] if quick else KINEMATIC, t_end, progress)
    usual = natural_step(simulation, parameters)
    steps = sorted(steps or measured.round_numbers(usual * (1 if quick else FINEST), usual * COARSEST), reverse=True)
    if not steps[-1] > 0:
        raise BadValueError(f"step is {steps[-1]:g} s: expected a positive time")
    longest = max(REFERENCE_STEPS * steps[-1] / FINER[-1] / (10 if quick else 1), 2 * steps[0])
    work = Work(simulation, t_end, parameters) if t_end else measured.window(simulation, longest, usual, parameters)
    return _measure(work, steps, 1 if quick else 2, progress or (lambda fraction, text: None))


def _measure(work: Work, steps: Sequence[float], rounds: int, progress: Report) -> SceneBench:
    """References first, then every step: a run to compare and runs to time."""
    cost = [factor / steps[-1] for factor in FINER] + [rounds / step for step in steps]
    done = 0.0

    def attempt(step: float) -> Attempt:
        share = 1 / step / sum(cost)
        return work.run(step, lambda fraction, _: progress(done + share * fraction, f"step {step:.3g} s"))

    references = []
    for factor in FINER:
        references.append(attempt(steps[-1] / factor))
        done += factor / steps[-1] / sum(cost)
    coarse, fine = (reference.run for reference in references)
    if coarse is None or fine is None or references[-1].failure:
        agreement, contact = Error(), NAN
    else:
        agreement = difference(coarse, fine)
        lengths = fine.impacts["t_off"] - fine.impacts["t_on"]
        contact = float(np.nanmin(lengths)) if np.isfinite(lengths).any() else NAN
    rows = []
    for step in steps:
        rows.append(_row(work, attempt(step), references[-1]))
        done += rounds / step / sum(cost)
    rhs = tuple(time_rhs(work.simulation, work.t_end))
    name, method = work.simulation.source.scene, "rk4"
    return SceneBench(
        name, method, work.t_end, work.why, tuple(rows), steps[-1] / FINER[-1], agreement, contact, rhs
    )  # fmt: skip


def _row(work: Work, found: Attempt, reference: Attempt) -> Row:
    if found.failure or found.run is None:
        return Row(found.step, 0, NAN, 0, Error(), found.failure or "no result", found.failed_at)
    seconds = work.seconds(found.step) / work.t_end
    error = difference(found.run, reference.run) if reference.run is not None and not reference.failure else Error()
    diagnostics = found.run.diagnostics
    return Row(diagnostics.step, 0, seconds, diagnostics.right_hand_sides, error)


def _kinematic(
    simulation: Simulation, parameters: Parameters, counts: Sequence[int], t_end: float | None,
    progress: Report | None,
) -> SceneBench:  # fmt: skip
    """No step and no reference: the error is what Newton's method leaves open of the constraints."""
    work = Work(simulation, t_end or scene_end(simulation.source), parameters)
    rows = []
    for done, count in enumerate(counts):
        if progress:
            progress(done / len(counts), f"{count} samples")
        found = work.sampled(math.inf, np.linspace(0.0, work.t_end, count + 1))
        step = work.t_end / count
        if found.run is None or found.failure:
            rows.append(Row(step, count, NAN, 0, Error(), found.failure or "no result", found.failed_at))
            continue
        seconds = work.seconds(math.inf, count) / work.t_end
        error = Error(found.run.diagnostics.phi_max / size(found.run))
        rows.append(Row(step, count, seconds, 0, error))
    rhs = tuple(time_rhs(simulation, work.t_end))
    return SceneBench(simulation.source.scene, "kinematic", work.t_end, "", tuple(rows), NAN, Error(), NAN, rhs)
