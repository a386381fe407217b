"""Simulate wear in rounds: `gudgeon.wear_loop(simulation, "A", 1.0, k=1e-4, hardness=2e9, rounds=5)`.

Each round runs the scene with the bearing contours that the previous rounds left, and deepens them by the wear depth of
Archard or Reye over the circumference. Sums over the cells are preserved, so that the contour deepens by k/H ∫ F_n ds.

The journal's wear is reported per round, in its own frame, and changes no contour. At the angle φ of the bearing the
gap would be wider by w(φ) + w_journal(φ − ψ), with the journal's angle ψ. This is a contour of the bearing only if ψ is
constant or the journal wears evenly. Laws keep the parameter values of the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language.argument_checks import function, instance, message, number_of, positive, refuse, text, whole
from gudgeon.language.argument_checks import names as joint_names
from gudgeon.language.shown import one_line
from gudgeon.model.contours import contour_of, read_contours
from gudgeon.model.parameter_sets import ParameterSets, given_each, rows_of
from gudgeon.results.wear import LAWS, POINTS, SlidingLoads, SlidingRequest, Worn, WornJoint
from gudgeon.simulation.wear import CONTACT, MOST_POINTS, check_rubs, rate_of

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.batch import Batch
    from gudgeon.results.state import Array
    from gudgeon.simulation.simulation import Simulation

MOST_ROUNDS, MOST_PASSES = 10_000, 100


@dataclass(frozen=True)
class Wearing:
    """Hold how bearings wear: joints, law, wear rate k/H (1/Pa), number of runs that a run stands for, resolution."""

    joints: tuple[str, ...]
    rate: float
    law: str = LAWS[0]
    scale: float = 1.0
    points: int = POINTS
    overlap: bool = False
    passes: int = 1
    begin: float = -np.inf

    @property
    def rubbing(self) -> tuple[SlidingRequest, ...]:
        """Return the requests to observe the wear of all joints in a run."""
        return tuple(SlidingRequest(joint, self.points, self.begin, np.inf, self.overlap) for joint in self.joints)

    def deeper(self, rubbed: SlidingLoads, slots: int) -> tuple[Array, Array]:
        """Return the wear depths (m) of a run: (points,) over the cells, (slots,) over the contour."""
        depth = self.scale * rubbed.depth(0, self.law, self.rate)
        return depth, smoothed(means_on_slots(depth, slots), self.passes)


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
) -> Worn:
    """Return the wear of bearings that have a `contour`, over a number of rounds of one run or of many.

    `k`, `hardness`, `law`, `contact`, `points`, `since`: as in `gudgeon.wear`, of the bearings. `scale`: how many runs
    each run stands for, revolutions of a round over those of a run: contours deepen by as much at once. `passes`: how
    often depths of neighbouring slots are mixed, a quarter from each side, before they deepen a contour; it keeps sums.
    `parameters`: of one run, or of many as in `simulate_many`; each has contours of its own. `contour`: with which the
    first round begins, else those of the file. `options`: further arguments of `simulate_many`, such as method, rtol,
    step, threads. Every round begins at the scene's start.

    A run that fails goes no further. Raises UnknownNameError for a joint without a contour, BadValueError for numbers.
    Ctrl-C is passed on.
    """
    from gudgeon.simulation.simulation import Simulation

    names = _check_joints(instance(simulation, "simulation", Simulation), joints)
    if text(law, "law") not in LAWS:
        refuse("law", law, " or ".join(LAWS))
    if text(contact, "contact") not in CONTACT:
        refuse("contact", contact, " or ".join(CONTACT))
    wearing = Wearing(
        names,
        rate_of(k, hardness, "k", "hardness"),
        law,
        positive(scale, "scale"),
        whole(points, "points", 8, MOST_POINTS),
        contact == "overlap",
        whole(passes, "passes", 0, MOST_PASSES),
        -np.inf if since is None else number_of(since, "since"),
    )
    loop = Loop(simulation, wearing, read_contours(simulation.source, contour, runs=True))
    function(progress, "progress")
    count = whole(rounds, "rounds", 1, MOST_ROUNDS)
    for k_round in range(count):
        tick = share(progress, k_round, count)
        loop.round({} if parameters is None else parameters, t_end, progress=tick, **options)
    return loop.found()


class Loop:
    """Repeat the same runs, each round with the contours that the last one left."""

    def __init__(self, simulation: Simulation, wearing: Wearing, contour: Mapping[str, Array]) -> None:
        self.simulation, self.wearing, self.given = simulation, wearing, dict(contour)
        self.slots = {one.joint: one.count for one in simulation.source.contours}
        self.contours: dict[str, list[Array]] = {joint: [] for joint in wearing.joints}
        self.depths: dict[str, list[Array]] = {joint: [] for joint in wearing.joints}
        self.journals: dict[str, list[Array]] = {joint: [] for joint in wearing.joints}
        self.works: dict[str, list[Array]] = {joint: [] for joint in wearing.joints}
        self.peaks: dict[str, list[Array]] = {joint: [] for joint in wearing.joints}
        self.sizes: dict[str, Array] = {}
        self.failures: dict[int, str] = {}

    def round(self, parameters: ParameterSets, t_end: Any, **options: Any) -> Batch:
        """Run all runs once with the present contours, deepen these, and return the Batch."""
        if not any(self.contours.values()):
            self._set_first_contours(parameters)
        batch = self.simulation.simulate_many(
            parameters, t_end, **{"output": 1, "keep": [], **options}, contour=self.given, peaks=self.wearing.rubbing
        )
        if batch.interrupted:
            raise KeyboardInterrupt
        self.failures |= {one.run: str(one.error) for one in batch.failures if one.run not in self.failures}
        for place, joint in enumerate(self.wearing.joints):
            self._add_round(batch, place, joint)
        return batch

    def _add_round(self, batch: Batch, place: int, joint: str) -> None:
        """Add the results of a round for one joint: depths, works, peaks and the new contour."""
        n, slots = len(batch), self.slots[joint]
        if not self.contours[joint]:
            self.contours[joint].append(np.array(np.broadcast_to(self.given[joint], (n, slots))))
        depth, more = np.full((n, self.wearing.points), np.nan), np.full((n, slots), np.nan)
        work, journal = np.full(n, np.nan), np.full_like(depth, np.nan)
        sizes = self.sizes.setdefault(joint, np.full((3, n), np.nan))
        for i in (i for i in range(n) if i not in self.failures):
            rubbed = batch.rubbed[i][place]
            depth[i], more[i] = self.wearing.deeper(rubbed, slots)
            work[i] = (rubbed.load if self.wearing.law == LAWS[0] else rubbed.friction)[0].sum()
            journal[i] = self.wearing.scale * rubbed.depth(1, self.wearing.law, self.wearing.rate)
            sizes[:, i] = rubbed.radii[0], rubbed.length, rubbed.radii[1]
        own = [one.name for one in batch.source.clearances].index(joint)
        self.depths[joint].append(depth)
        self.journals[joint].append(journal)
        self.works[joint].append(work)
        self.peaks[joint].append(np.where(np.isnan(work), np.nan, batch.peaks["F"][:, own]))
        self.contours[joint].append(self.contours[joint][-1] + more)
        self.given[joint] = np.where(np.isnan(more), 0.0, self.contours[joint][-1])

    def _set_first_contours(self, parameters: ParameterSets) -> None:
        """Set the contours of the first round: those given, else those of the file for each run's parameter values."""
        compiled, source = self.simulation.compiled, self.simulation.source
        given, is_given = given_each(source, rows_of(parameters)[0])
        for joint in self.wearing.joints:
            own = contour_of(source, compiled.prepare_each(given, is_given), joint)
            if own is not None:
                self.given.setdefault(joint, own if len(own) > 1 else own[0])

    def found(self) -> Worn:
        """Return the results of all rounds so far."""
        source, wearing = self.simulation.source, self.wearing
        joints = {
            joint: WornJoint(
                np.stack(self.contours[joint]),
                np.stack(self.depths[joint]),
                np.stack(self.works[joint]),
                np.stack(self.peaks[joint]),
                self.sizes[joint][0],
                self.sizes[joint][1],
                np.stack(self.journals[joint]),
                self.sizes[joint][2],
            )
            for joint in wearing.joints
        }
        title = f"{one_line(source.title)}: {source.scene}"
        return Worn(joints, wearing.law, wearing.rate, wearing.scale, self.failures, title)


def means_on_slots(depth: Array, slots: int) -> Array:
    """Return the means (slots,) of depths (points,) over the arcs around the slots' angles; the total mean is kept."""
    points = len(depth)
    below = np.concatenate([[0.0], np.cumsum(depth)])
    edges = (np.arange(slots + 1) - 0.5) * (points / slots)
    whole_turns, rest = np.divmod(edges, points)
    upto = whole_turns * below[-1] + np.interp(rest, np.arange(points + 1), below)
    return np.asarray(np.diff(upto) * (slots / points))


def smoothed(depth: Array, passes: int) -> Array:
    """Return the depths of slots after `passes` averages with a quarter of both neighbours; the sum is kept."""
    for _ in range(passes):
        depth = 0.5 * depth + 0.25 * (np.roll(depth, 1) + np.roll(depth, -1))
    return depth


def _check_joints(simulation: Simulation, joints: str | Iterable[str]) -> tuple[str, ...]:
    """Return the checked names of joints with a contour. Raise UnknownNameError, BadValueError."""
    able = [one.joint for one in simulation.source.contours]
    names = tuple(joint_names(joints, "joints", "a name or names"))
    if not names:
        raise BadValueError(f"joints is {message(joints)}: expected a name or names", hint=", ".join(able))
    for joint in names:
        check_rubs(simulation.source, joint)
        if joint not in able:
            hint = f"joints with one: {', '.join(able)}" if able else "write contour: 128 into its play"
            raise UnknownNameError(f"{joint} has no contour that wear could deepen", hint=hint)
    if len(set(names)) < len(names):
        raise BadValueError("joints: one is named twice", hint="name each once")
    return names


def share(progress: Progress | None, k: int, rounds: int) -> Progress | None:
    """Return the progress function of round k of `rounds`, or None without one."""
    if progress is None:
        return None
    return lambda fraction, words: progress((k + fraction) / rounds, f"round {k + 1} of {rounds}: {words}")
