"""Simulate wear in rounds of a run and an update of the worn bearing: `gudgeon.wear_loop(simulation, "A", …)`.

Each round runs the scene with the bearing contours that the previous rounds left, and deepens them by the wear depth of
Archard or Reye over the circumference. Sums over the cells are preserved, so that the contour deepens by k/H ∫ F_n ds.

The journal's wear is reported per round, in its own frame, and changes no contour. At the angle φ of the bearing the
gap would be wider by w(φ) + w_journal(φ − ψ), with the journal's angle ψ. This is a contour of the bearing only if ψ is
constant or the journal wears evenly. Laws keep the parameter values of the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language.argument_checks import (
    check_callable,
    check_instance,
    check_integer,
    check_names,
    check_number,
    check_positive,
    check_text,
    raise_bad_value,
    shorten_value,
)
from gudgeon.language.text_output import format_one_line
from gudgeon.model.contours import get_contour_depths, read_contours
from gudgeon.model.parameter_sets import ParameterSets, read_given_parameters_of_runs, read_parameter_sets
from gudgeon.results.wear import LAWS, POINTS, JointWearResult, SlidingLoads, SlidingRequest, WearRoundsResult
from gudgeon.simulation.wear import CONTACT_MODELS, MAX_POINTS, check_joint_can_wear, parse_wear_rate

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.batch import Batch
    from gudgeon.results.state import Array
    from gudgeon.simulation.simulation import Simulation

MAX_ROUNDS, MAX_PASSES = 10_000, 100  # largest numbers of rounds and of smoothing passes


@dataclass(frozen=True)
class WearModel:
    """Hold how bearings wear: joints, law, wear rate k/H (1/Pa), factor of the wear of each run, and resolution."""

    joints: tuple[str, ...]
    rate: float
    law: str = LAWS[0]
    scale: float = 1.0
    points: int = POINTS
    overlap: bool = False
    passes: int = 1
    begin: float = -np.inf

    @property
    def sliding_requests(self) -> tuple[SlidingRequest, ...]:
        """Return the requests, one per joint, to observe the wear of a run from `begin` (s) on."""
        return tuple(SlidingRequest(joint, self.points, self.begin, np.inf, self.overlap) for joint in self.joints)

    def compute_depths(self, loads: SlidingLoads, n_angles: int) -> tuple[Array, Array]:
        """Return the wear depths (m) of a round from the loads of one run: (points,) over the cells, (n_angles,) over
        the contour.

        Depths are `scale` times those of the loads; over the contour they are averaged and smoothed.
        """
        depth = self.scale * loads.compute_depth(0, self.law, self.rate)
        return depth, smooth_depths(average_depths_over_arcs(depth, n_angles), self.passes)


def wear_loop(
    simulation: Simulation,
    joints: str | Iterable[str],
    t_end: float | str | None = None,
    *,
    rounds: int,
    k: float | str,
    hardness: float | str | None = None,
    law: str = "archard",
    scale: float = 1.0,
    contact: str = "point",
    points: int = POINTS,
    passes: int = 1,
    since: float | None = None,
    parameters: ParameterSets | None = None,
    contour: Mapping[str, ArrayLike] | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> WearRoundsResult:
    """Alternate between runs of a scene and wear of its bearings with a `contour`, and return wear and contours.

    `rounds`: number of runs, each from the scene's start, with the contours that the runs before it have worn.
    `k`, `hardness`, `law`, `contact`, `points`, `since`: as in `gudgeon.wear`, for the bearings. `scale`: factor of the
    wear of each run, for example the revolutions that a round represents divided by those of its run. `passes`: number
    of times that depths are smoothed around the circumference before a round deepens a contour, with weights 1/4, 1/2,
    1/4, which conserve the worn volume.
    `parameters`: for one run, or for many as in `simulate_many`; each run has its own contours. `contour`: depths (m)
    of the first round; None for those of the file. `options`: further arguments of `simulate_many`, such as method,
    rtol, step, threads.

    A run that fails has no further rounds. Raises UnknownNameError for a joint without a contour, BadValueError for
    arguments, KeyboardInterrupt after Ctrl-C.
    """
    from gudgeon.simulation.simulation import Simulation

    names = _check_joints(check_instance(simulation, "simulation", Simulation), joints)
    if check_text(law, "law") not in LAWS:
        raise_bad_value("law", law, " or ".join(LAWS))
    if check_text(contact, "contact") not in CONTACT_MODELS:
        raise_bad_value("contact", contact, " or ".join(CONTACT_MODELS))
    wear_model = WearModel(
        names,
        parse_wear_rate(k, hardness, "k", "hardness"),
        law,
        check_positive(scale, "scale"),
        check_integer(points, "points", 8, MAX_POINTS),
        contact == "overlap",
        check_integer(passes, "passes", 0, MAX_PASSES),
        -np.inf if since is None else check_number(since, "since"),
    )
    loop = WearLoop(simulation, wear_model, read_contours(simulation.source, contour, allows_runs=True))
    check_callable(progress, "progress")
    count = check_integer(rounds, "rounds", 1, MAX_ROUNDS)
    for k_round in range(count):
        round_progress = scale_progress(progress, k_round, count)
        loop.run_round({} if parameters is None else parameters, t_end, progress=round_progress, **options)
    return loop.build_result()


class _JointSizes(NamedTuple):
    """Dimensions of a joint in each run, (n_runs,), in m; NaN for failed runs."""

    bearing_radius: Array
    length: Array
    journal_radius: Array


class WearLoop:
    """Repeat the same runs, each round with the contours that the last one left."""

    def __init__(self, simulation: Simulation, wear_model: WearModel, contour: Mapping[str, Array]) -> None:
        self.simulation, self.wear_model, self.given = simulation, wear_model, dict(contour)
        self.n_angles = {contour_info.joint: contour_info.count for contour_info in simulation.source.contours}
        self.contours: dict[str, list[Array]] = {joint: [] for joint in wear_model.joints}
        self.depths: dict[str, list[Array]] = {joint: [] for joint in wear_model.joints}
        self.journals: dict[str, list[Array]] = {joint: [] for joint in wear_model.joints}
        self.works: dict[str, list[Array]] = {joint: [] for joint in wear_model.joints}
        self.peaks: dict[str, list[Array]] = {joint: [] for joint in wear_model.joints}
        self.sizes: dict[str, _JointSizes] = {}
        self.failures: dict[int, str] = {}

    def run_round(self, parameters: ParameterSets, t_end: Any, **options: Any) -> Batch:
        """Run all runs once with the current contours, deepen the contours by the wear, and return the Batch.

        `options`: further arguments of simulate_many. Failed runs are recorded and deepen nothing. Raises
        KeyboardInterrupt after Ctrl-C.
        """
        if not any(self.contours.values()):
            self._set_initial_contours(parameters)
        batch = self.simulation.simulate_many(
            parameters,
            t_end,
            **{"output": 1, "keep": [], **options},
            contour=self.given,
            peaks=self.wear_model.sliding_requests,
        )
        if batch.interrupted:
            raise KeyboardInterrupt
        self.failures |= {
            failure.run: str(failure.error) for failure in batch.failures if failure.run not in self.failures
        }
        for index, joint in enumerate(self.wear_model.joints):
            self._append_round_results(batch, index, joint)
        return batch

    def _append_round_results(self, batch: Batch, index: int, joint: str) -> None:
        """Append the results of a round for one joint: depths, works, peaks and the new contour; NaN for failed runs.

        `index`: index of the joint among those that wear.
        """
        n, n_angles = len(batch), self.n_angles[joint]
        if not self.contours[joint]:
            self.contours[joint].append(np.array(np.broadcast_to(self.given[joint], (n, n_angles))))
        depth, contour_depth = np.full((n, self.wear_model.points), np.nan), np.full((n, n_angles), np.nan)
        work, journal = np.full(n, np.nan), np.full_like(depth, np.nan)
        sizes = self.sizes.setdefault(joint, _JointSizes(*np.full((3, n), np.nan)))
        for i in (i for i in range(n) if i not in self.failures):
            loads = batch.sliding_loads[i][index]
            depth[i], contour_depth[i] = self.wear_model.compute_depths(loads, n_angles)
            work[i] = (loads.load if self.wear_model.law == LAWS[0] else loads.friction)[0].sum()
            journal[i] = self.wear_model.scale * loads.compute_depth(1, self.wear_model.law, self.wear_model.rate)
            sizes.bearing_radius[i], sizes.journal_radius[i] = loads.radii
            sizes.length[i] = loads.length
        joint_index = [clearance.name for clearance in batch.source.clearances].index(joint)
        self.depths[joint].append(depth)
        self.journals[joint].append(journal)
        self.works[joint].append(work)
        self.peaks[joint].append(np.where(np.isnan(work), np.nan, batch.peaks["F"][:, joint_index]))
        self.contours[joint].append(self.contours[joint][-1] + contour_depth)
        self.given[joint] = np.where(np.isnan(contour_depth), 0.0, self.contours[joint][-1])

    def _set_initial_contours(self, parameters: ParameterSets) -> None:
        """Set the contours of the first round where none are given: those of the file for each run's parameter
        values.
        """
        compiled, source = self.simulation.compiled, self.simulation.source
        given, is_given = read_given_parameters_of_runs(source, read_parameter_sets(parameters)[0])
        for joint in self.wear_model.joints:
            contour = get_contour_depths(source, compiled.prepare_parameters_of_runs(given, is_given), joint)
            if contour is not None:
                self.given.setdefault(joint, contour if len(contour) > 1 else contour[0])

    def build_result(self) -> WearRoundsResult:
        """Return the results of all rounds so far, with arrays over rounds and runs for each joint."""
        source, wear_model = self.simulation.source, self.wear_model
        joints = {
            joint: JointWearResult(
                np.stack(self.contours[joint]),
                np.stack(self.depths[joint]),
                np.stack(self.works[joint]),
                np.stack(self.peaks[joint]),
                self.sizes[joint].bearing_radius,
                self.sizes[joint].length,
                np.stack(self.journals[joint]),
                self.sizes[joint].journal_radius,
            )
            for joint in wear_model.joints
        }
        title = f"{format_one_line(source.title)}: {source.scene}"
        return WearRoundsResult(joints, wear_model.law, wear_model.rate, wear_model.scale, self.failures, title)


def average_depths_over_arcs(depth: Array, n_angles: int) -> Array:
    """Return the means (n_angles,) of depths (points,) over the arcs around the contour's equally spaced angles.

    The total mean does not change.
    """
    points = len(depth)
    cumulative = np.concatenate([[0.0], np.cumsum(depth)])
    edges = (np.arange(n_angles + 1) - 0.5) * (points / n_angles)
    whole_turns, remainders = np.divmod(edges, points)
    depth_integrals = whole_turns * cumulative[-1] + np.interp(remainders, np.arange(points + 1), cumulative)
    return np.asarray(np.diff(depth_integrals) * (n_angles / points))


def smooth_depths(depth: Array, n_passes: int) -> Array:
    """Return the depths of a contour after `n_passes` averages of half itself and a quarter of both neighbours.

    The contour is periodic, and the sum does not change.
    """
    for _ in range(n_passes):
        depth = 0.5 * depth + 0.25 * (np.roll(depth, 1) + np.roll(depth, -1))
    return depth


def _check_joints(simulation: Simulation, joints: str | Iterable[str]) -> tuple[str, ...]:
    """Check the argument `joints`, a name or names, and return the names as a tuple: joints with a contour that can
    wear.

    Raises UnknownNameError for a joint without one, BadValueError for none or repeated names.
    """
    joints_with_contour = [contour.joint for contour in simulation.source.contours]
    names = tuple(check_names(joints, "joints", "a name or names"))
    if not names:
        raise BadValueError(
            f"joints is {shorten_value(joints)}: expected a name or names", hint=", ".join(joints_with_contour)
        )
    for joint in names:
        check_joint_can_wear(simulation.source, joint)
        if joint not in joints_with_contour:
            hint = (
                f"joints with one: {', '.join(joints_with_contour)}"
                if joints_with_contour
                else "write contour: 128 into its play"
            )
            raise UnknownNameError(f"{joint} has no contour that wear could deepen", hint=hint)
    return names


def scale_progress(progress: Progress | None, round_index: int, n_rounds: int) -> Progress | None:
    """Return a progress function for one of n_rounds rounds, which passes the fraction of all rounds to `progress`.

    Return None without `progress`.
    """
    if progress is None:
        return None
    return lambda fraction, text: progress(
        (round_index + fraction) / n_rounds, f"round {round_index + 1} of {n_rounds}: {text}"
    )
