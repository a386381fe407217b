"""A study as its file says it: frozen values, numbers still as texts with their places.

What a number's unit is, and whether a name exists, only the loaded scenes know (runtime/studies/ensemble/plan.py). Its
claims are published numbers and trends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.yaml import Text
from gudgeon.language.tree import Expr

ALONG = ("grows_along", "alike_along", "spreads_along")  # a dimension
BETWEEN = ("larger", "most_lowered")  # of two selections, and how measures change from one to the other
SAME = ("exceeds",)  # another measure of the same runs
AGAINST = ("above", "below", "near")  # a number
COUNTS = "counts"  # what the scene has
KINDS = (*ALONG, *BETWEEN, *SAME, *AGAINST, COUNTS)
COUNTED = ("bodies", "joints", "drives", "freedoms", "rows", "coordinates", "play")


@dataclass(frozen=True)
class Selection:
    """Runs of a part with these values of its coordinates, and of all others; `text` is where it stands."""

    part: Text | None
    at: Mapping[Text, Text]
    where: Text


@dataclass(frozen=True)
class NumberClaim:
    """A number that somebody published, beside a measure of ours; without a value ours alone is told.

    `beside`: another one of these, of the same measure, from which ours is told to be off then. `heading`: under which
    it stands on a page.
    """

    name: Text
    figure: str
    measure: Text
    selection: Selection
    value: Text | None
    says: str
    note: str
    beside: Text | None = None
    heading: str = ""


@dataclass(frozen=True)
class Trial:
    """One thing that a trend says: its kind, of which measures, of which runs."""

    kind: str
    measures: tuple[Text, ...]
    selection: Selection
    text: Text  # what stands at the kind: a dimension, a measure, a number
    than: Selection | None = None
    others: tuple[Text, ...] = ()  # measures beside
    by: Text | None = None  # so many times, or within such a share
    counts: Mapping[Text, int] = field(default_factory=dict)


@dataclass(frozen=True)
class TrendClaim:
    """What somebody says of runs in words; without trials it is one that no run can judge, and says why."""

    name: Text
    figure: str
    says: str
    trials: tuple[Trial, ...]
    not_computed: str
    note: str
    heading: str = ""


@dataclass(frozen=True)
class Claims:
    """All of a file."""

    source: str = ""
    numbers: tuple[NumberClaim, ...] = ()
    trends: tuple[TrendClaim, ...] = ()


FORMAT = "gudgeon-study/1"
LINEAR, GEOMETRIC = "linear", "geometric"
NORMAL, UNIFORM = "normal", "uniform"
DRAWN = ("random", "latin_hypercube", "sobol", "halton")  # how points are drawn: numpy's generator, or scipy.stats.qmc
SAMPLES = ("max", "min", "peak", "range", "mean", "rms", "final")  # statistics of a series' samples in a window
STEPS = ("max_of_steps", "min_of_steps", "peak_of_steps")  # of a series over all steps of a run
DEVIATIONS = ("deviation", "deviation_of_steps")  # largest magnitude of a series less that of another scene
CONTACTS = ("impacts", "first_impact", "impact_speed")  # of a joint's contacts that begin in a window
JOINT = ("peak_force", "eccentricity")  # of a joint with play over all steps
WEAR_LAWS = ("archard", "reye")
WEAR = ("wear_depth", "wear_arc")  # of a joint with dry contact over all steps, of its bearing, for k/H = 1/Pa
CROSSINGS = ("crossings", "first_crossing")  # of an event in a window
FOLLOWED = (
    "lyapunov",
    "lyapunov_error",
    "lyapunov_per_return",
    "believable",
    "motion",
    "motion_confidence",
)  # of a neighbour of the run, or of its returns to a section, in a window
STATISTICS = (*SAMPLES, *STEPS, *DEVIATIONS, *CONTACTS, *JOINT, *WEAR, *CROSSINGS, *FOLLOWED)
RESERVED = (
    "run",
    "time",
    "t",
    "sample",
    "scene",
    "draw",
    "start",
    "ensemble",
    "failure",
    "t_last",
)  # what a dataset has of its own


@dataclass(frozen=True)
class Written:
    """An expression and its text."""

    expr: Expr
    text: Text


@dataclass(frozen=True)
class Numbers:
    """A list of values, or `count` of them from the first text to the second one."""

    texts: tuple[Text, ...]
    count: int = 0
    spacing: str = ""


@dataclass(frozen=True)
class Axis:
    """A dimension of the study: numbers that change together, by their addresses, all of one length."""

    name: str
    where: Location
    columns: Mapping[Text, Numbers]
    grouped: bool = False  # of `zip`: the dimension's name is no number's

    @property
    def length(self) -> int:
        """How many values it has."""
        numbers = next(iter(self.columns.values()))
        return numbers.count or len(numbers.texts)


@dataclass(frozen=True)
class Spread:
    """How a number is drawn: normal by mean and standard deviation, uniform or geometric between two ends."""

    kind: str
    ends: tuple[Text, Text]


@dataclass(frozen=True)
class Draw:
    """Random points, the same every time."""

    count: int
    seed: int
    method: str
    numbers: Mapping[Text, Spread]
    names: tuple[str, ...]  # of all that the file draws: the points of one are the same where another one is set


@dataclass(frozen=True)
class Deviation:
    """How far a number is off: by a share of itself, or by so much."""

    relative: bool
    size: Text


@dataclass(frozen=True)
class Starts:
    """Each run again `count` times, its numbers a little off; once for each ensemble."""

    count: int
    seed: int
    distribution: str
    ensembles: Mapping[str, Mapping[Text, Deviation]]
    named: bool  # whether ensembles are a dimension


@dataclass(frozen=True)
class Choice:
    """A dimension of structure: options by name, each some overrides with which the mechanism is loaded."""

    name: str
    where: Location
    options: Mapping[str, Mapping[str, Text]]


@dataclass(frozen=True)
class Window:
    """A span of time; None: the run's own begin or end."""

    begin: Written | None
    end: Written | None


@dataclass(frozen=True)
class Measure:
    """One number a run: a statistic of a series, a joint or an event, in a window ("": the whole run).

    `origin`: the scene whose series is subtracted, at the same times and with the same numbers.
    """

    name: str
    statistic: str
    of: Text
    window: str = ""
    origin: Text | None = None


@dataclass(frozen=True)
class WearRounds:
    """What bearings with contours wear before the runs that are measured, by a law, `scale` runs each round."""

    joints: tuple[Text, ...]
    rounds: int
    k: Text
    hardness: Text | None
    scale: Text | None
    law: str


@dataclass(frozen=True)
class StudyFile:
    """All of a file; `said` is its tree as plain texts, by which two studies are compared."""

    file: str  # "" for a mapping of Python
    title: str
    mechanism: Text
    scenes: tuple[Text, ...]
    one_scene: bool  # named as a text, not as a list: no dimension
    choices: tuple[Choice, ...]
    fixed: Mapping[Text, Text]
    axes: tuple[Axis, ...]
    draw: Draw | None
    starts: Starts | None
    t_end: Written | None
    output: Written | None
    step: Written | None
    windows: Mapping[str, Window]
    measures: tuple[Measure, ...]
    keep: tuple[Text, ...]
    method: Text
    rtol: Text | None
    stop: bool
    said: Mapping[str, Any]
    wear: WearRounds | None = None
    left_out: tuple[Axis, ...] = ()  # what varies in the file, and is set for all runs

    def begun(self, count: int | None, seed: int | None) -> StudyFile:
        """With another count or seed of its starts, if it has any."""
        told = {name: str(value) for name, value in (("count", count), ("seed", seed)) if value is not None}
        if self.starts is None or not told:
            return self
        starts = replace(self.starts, count=count or self.starts.count, seed=self.starts.seed if seed is None else seed)
        return replace(self, starts=starts, said={**self.said, "starts": self.said["starts"] | told})


@dataclass(frozen=True)
class StudySet:
    """A whole file: one study, named "", or its parts by name."""

    file: str
    title: str
    parts: Mapping[str, StudyFile]
    named: bool  # whether the file has parts
    claims: Claims
    titles: Mapping[str, str] = field(default_factory=dict)  # of names, for people
    about: tuple[str, ...] = ()  # paragraphs, for people

    def begun(self, count: int | None, seed: int | None) -> StudySet:
        """With so many perturbed starts, by another seed, in every part that has any. BadValueError where none has."""
        told = [name for name, value in (("count", count), ("seed", seed)) if value is not None]
        if told and not any(part.starts for part in self.parts.values()):
            hint = "starts: in the file says which number is how far off"
            raise BadValueError(f"no run has perturbed starts, whose {' and '.join(told)} is given", None, hint)
        return replace(self, parts={name: part.begun(count, seed) for name, part in self.parts.items()})
