"""Wear as a loop, `gudgeon.wear_loop(simulation, "A", 1.0, k=1e-4, hardness=2e9, rounds=5)`: run, deepen, run again.

Each round runs the scene with the contours that the rounds before have left, and deepens the bearing where it was
rubbed: Archard's depth over the cells of its circumference, or Reye's, times what a run stands for, is laid on the
contour's slots. Sums stay those of the cells, so that what the contour is deeper is k/H ∫ F_n ds. The journal's wear is
told round by round, in its own frame, and changes no contour: at the angle φ of the bearing the gap would be wider by
w(φ) + w_journal(φ − ψ), ψ the journal's angle in the bearing, which is one contour of the bearing only where ψ stands
still or the journal is worn evenly. Laws keep the numbers of the file.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.errors import BadValueError, UnknownNameError
from gudgeon.language.shown import one_line
from gudgeon.language.wanted import function, instance, number_of, positive, refuse, text, told, whole
from gudgeon.language.wanted import names as joint_names
from gudgeon.model.contours import contour_of, taken_contours
from gudgeon.model.parameter_sets import ParameterSets, given_each, rows_of
from gudgeon.results.wear import LAWS, POINTS, Rubbed, Rubbing, Worn, WornJoint
from gudgeon.simulation.wear import CONTACT, MOST_POINTS, check_rubs, rate_of

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.batch import Batch
    from gudgeon.results.state import Array
    from gudgeon.simulation.simulation import Simulation

MOST_ROUNDS, MOST_PASSES = 10_000, 100


@dataclass(frozen=True)
class Wearing:
    """How bearings wear: of which joints, by which law and k/H (1/Pa), what a run stands for, how it is looked at."""

    joints: tuple[str, ...]
    rate: float
    law: str = LAWS[0]
    scale: float = 1.0
    points: int = POINTS
    overlap: bool = False
    passes: int = 1
    begin: float = -np.inf

    @property
    def rubbing(self) -> tuple[Rubbing, ...]:
        """What is asked of the runs."""
        return tuple(Rubbing(joint, self.points, self.begin, np.inf, self.overlap) for joint in self.joints)

    def deeper(self, rubbed: Rubbed, slots: int) -> tuple[Array, Array]:
        """Depths (m) that a run wears: (points,) over the cells, (slots,) of the contour."""
        depth = self.scale * rubbed.depth(0, self.law, self.rate)
        return depth, smoothed(on_slots(depth, slots), self.passes)


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
    """What wear makes of bearings that have a `contour`, over so many rounds of one run or of many.

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

    names = _joints(instance(simulation, "simulation", Simulation), joints)
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
    loop = Loop(simulation, wearing, taken_contours(simulation.source, contour, runs=True))
    function(progress, "progress")
    count = whole(rounds, "rounds", 1, MOST_ROUNDS)
    for k_round in range(count):
        tick = share(progress, k_round, count)
        loop.round({} if parameters is None else parameters, t_end, progress=tick, **options)
    return loop.found()


class Loop:
    """Rounds of the same runs, each with the contours that the last one left."""

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
        """Runs once more; contours are deeper then."""
        if not any(self.contours.values()):
            self._first(parameters)
        batch = self.simulation.simulate_many(
            parameters, t_end, **{"output": 1, "keep": [], **options}, contour=self.given, peaks=self.wearing.rubbing
        )
        if batch.interrupted:
            raise KeyboardInterrupt
        self.failures |= {one.run: str(one.error) for one in batch.failures if one.run not in self.failures}
        for place, joint in enumerate(self.wearing.joints):
            self._take(batch, place, joint)
        return batch

    def _take(self, batch: Batch, place: int, joint: str) -> None:
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

    def _first(self, parameters: ParameterSets) -> None:
        """Contours of the first round, where none are given those of the file by the numbers of each run."""
        compiled, source = self.simulation.compiled, self.simulation.source
        given, is_given = given_each(source, rows_of(parameters)[0])
        for joint in self.wearing.joints:
            own = contour_of(source, compiled.prepare_each(given, is_given), joint)
            if own is not None:
                self.given.setdefault(joint, own if len(own) > 1 else own[0])

    def found(self) -> Worn:
        """All rounds so far."""
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


def on_slots(depth: Array, slots: int) -> Array:
    """Means of depths (points,) over the arcs around the slots' angles, (slots,): both have the same mean."""
    points = len(depth)
    below = np.concatenate([[0.0], np.cumsum(depth)])
    edges = (np.arange(slots + 1) - 0.5) * (points / slots)
    whole_turns, rest = np.divmod(edges, points)
    upto = whole_turns * below[-1] + np.interp(rest, np.arange(points + 1), below)
    return np.asarray(np.diff(upto) * (slots / points))


def smoothed(depth: Array, passes: int) -> Array:
    """Depths of slots, each mixed with a quarter of both neighbours so often; sums stay."""
    for _ in range(passes):
        depth = 0.5 * depth + 0.25 * (np.roll(depth, 1) + np.roll(depth, -1))
    return depth


def _joints(simulation: Simulation, joints: str | Iterable[str]) -> tuple[str, ...]:
    able = [one.joint for one in simulation.source.contours]
    names = tuple(joint_names(joints, "joints", "a name or names"))
    if not names:
        raise BadValueError(f"joints is {told(joints)}: expected a name or names", hint=", ".join(able))
    for joint in names:
        check_rubs(simulation.source, joint)
        if joint not in able:
            hint = f"joints with one: {', '.join(able)}" if able else "write contour: 128 into its play"
            raise UnknownNameError(f"{joint} has no contour that wear could deepen", hint=hint)
    if len(set(names)) < len(names):
        raise BadValueError("joints: one is named twice", hint="name each once")
    return names


def share(progress: Progress | None, k: int, rounds: int) -> Progress | None:
    """Of round k among all."""
    if progress is None:
        return None
    return lambda fraction, words: progress((k + fraction) / rounds, f"round {k + 1} of {rounds}: {words}")
