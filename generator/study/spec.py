"""Defines a study as its file describes it: frozen values whose numbers are still texts with locations.

Units and the existence of names are known only to the loaded scenes (runtime/studies/ensemble/plan.py).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.yaml import Text
from gudgeon.language.deprecations import BELIEVABLE_MEASURE
from gudgeon.language.tree import Expr

TRENDS_ALONG_DIMENSION = ("grows_along", "alike_along", "spreads_along")  # kinds of statements along a dimension
SELECTION_COMPARISONS = ("larger", "most_lowered")  # kinds that compare two selections of runs
MEASURE_COMPARISONS = ("exceeds",)  # kinds that compare two measures of the same runs
NUMBER_COMPARISONS = ("above", "below", "near")  # kinds that compare with a number
COUNTS = "counts"  # the kind that counts parts of the scene
KINDS = (*TRENDS_ALONG_DIMENSION, *SELECTION_COMPARISONS, *MEASURE_COMPARISONS, *NUMBER_COMPARISONS, COUNTS)
COUNTED_PARTS = ("bodies", "joints", "drives", "freedoms", "rows", "coordinates", "play")


@dataclass(frozen=True)
class Selection:
    """Represent runs of a part with given coordinate values, and any value of other coordinates; `where` locates it."""

    part: Text | None
    at: Mapping[Text, Text]
    where: Text


@dataclass(frozen=True)
class NumberClaim:
    """Represent a published number that is compared with a measure; without a value only the measure is reported.

    `reference_claim`: another claim of the same measure, from which the deviation is reported. `heading`: the claim's
    heading on a page.
    """

    name: Text
    figure: str
    measure: Text
    selection: Selection
    value: Text | None
    says: str
    note: str
    reference_claim: Text | None = None
    heading: str = ""


@dataclass(frozen=True)
class TrendStatement:
    """Represent one testable statement of a trend: its kind, its measures and the runs that it concerns."""

    kind: str
    measures: tuple[Text, ...]
    selection: Selection
    text: Text  # value of the kind's key: a dimension, a measure, a number
    than: Selection | None = None
    others: tuple[Text, ...] = ()  # measures to compare with
    by: Text | None = None  # a factor, or a relative tolerance
    counts: Mapping[Text, int] = field(default_factory=dict)


@dataclass(frozen=True)
class TrendClaim:
    """Represent a published statement about runs; it is tested by `statements`, or `not_computed` tells why not."""

    name: Text
    figure: str
    says: str
    statements: tuple[TrendStatement, ...]
    not_computed: str
    note: str
    heading: str = ""


@dataclass(frozen=True)
class Claims:
    """Contain all claims of a study file and their source."""

    source: str = ""
    numbers: tuple[NumberClaim, ...] = ()
    trends: tuple[TrendClaim, ...] = ()


FORMAT = "gudgeon-study/1"
LINEAR, GEOMETRIC = "linear", "geometric"
NORMAL, UNIFORM = "normal", "uniform"
SAMPLING_METHODS = (
    "random",
    "latin_hypercube",
    "sobol",
    "halton",
)  # how points are drawn: numpy's generator, or scipy.stats.qmc
SAMPLES = ("max", "min", "peak", "range", "mean", "rms", "final")  # statistics of a series' samples in a window
STEPS = ("max_of_steps", "min_of_steps", "peak_of_steps")  # of a series over all steps of a run
DEVIATIONS = ("deviation", "deviation_of_steps")  # largest magnitude of a series less that of another scene
CONTACTS = ("impacts", "first_impact", "impact_speed")  # of a joint's contacts that begin in a window
JOINT = ("peak_force", "eccentricity")  # of a joint with play over all steps
WEAR_LAWS = ("archard", "reye")
WEAR = ("wear_depth", "wear_arc")  # of a joint with dry contact over all steps, of its bearing, for k/H = 1/Pa
CROSSINGS = ("crossings", "first_crossing")  # of an event in a window
NEIGHBOUR_STATISTICS = (
    "lyapunov",
    "lyapunov_error",
    "lyapunov_per_return",
    "mean_horizon",
    "motion",
    "motion_confidence",
)  # statistics of a neighbouring run, or of the returns to a section, in a window
DEPRECATED_STATISTICS = {"believable": ("mean_horizon", BELIEVABLE_MEASURE)}  # old name: new name, deprecation
STATISTICS = (*SAMPLES, *STEPS, *DEVIATIONS, *CONTACTS, *JOINT, *WEAR, *CROSSINGS, *NEIGHBOUR_STATISTICS)
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
)  # names that the dataset itself uses


@dataclass(frozen=True)
class ParsedExpression:
    """Contain an expression and its text."""

    expr: Expr
    text: Text


@dataclass(frozen=True)
class ParameterValues:
    """Represent the values of a parameter: a list, or `count` values from the first text to the second."""

    texts: tuple[Text, ...]
    count: int = 0
    spacing: str = ""


@dataclass(frozen=True)
class Axis:
    """Represent a dimension of the study: parameters that vary together, by address, with equally many values."""

    name: str
    where: Location
    columns: Mapping[Text, ParameterValues]
    grouped: bool = False  # from `zip`: the dimension's name is not that of a parameter

    @property
    def length(self) -> int:
        """Return the number of values along the dimension."""
        numbers = next(iter(self.columns.values()))
        return numbers.count or len(numbers.texts)


@dataclass(frozen=True)
class Distribution:
    """Represent the distribution of a drawn parameter: normal by mean and deviation, else by its two ends."""

    kind: str
    ends: tuple[Text, Text]


@dataclass(frozen=True)
class Draw:
    """Represent random points in parameter space, which are the same in every run of the study."""

    count: int
    seed: int
    method: str
    distributions: Mapping[Text, Distribution]
    names: tuple[str, ...]  # all drawn parameters of the file: the points of one do not change if another one is set


@dataclass(frozen=True)
class Deviation:
    """Represent the perturbation of a number: relative to its value, or absolute."""

    relative: bool
    size: Text


@dataclass(frozen=True)
class Starts:
    """Represent perturbed starts: `count` runs with slightly perturbed parameters, for each ensemble."""

    count: int
    seed: int
    distribution: str
    ensembles: Mapping[str, Mapping[Text, Deviation]]
    named: bool  # whether ensembles are a dimension


@dataclass(frozen=True)
class Choice:
    """Represent a dimension of structure: options by name, each a set of overrides for loading the mechanism."""

    name: str
    where: Location
    options: Mapping[str, Mapping[str, Text]]


@dataclass(frozen=True)
class Window:
    """Represent a span of time; None is the begin or the end of the run."""

    begin: ParsedExpression | None
    end: ParsedExpression | None


@dataclass(frozen=True)
class Measure:
    """Represent one number of a run: a statistic of a series, joint or event in a window ("": the whole run).

    `measured_name`: the name of the series, joint or event, WHOLE_RUN, or the period of a section. `reference_scene`:
    the scene whose series is subtracted, at the same times and with the same parameters (key `from`).
    """

    name: str
    statistic: str
    measured_name: Text
    window: str = ""
    reference_scene: Text | None = None


@dataclass(frozen=True)
class WearRounds:
    """Represent the rounds of wear of bearings with contours before the measured runs, `scale` runs a round."""

    joints: tuple[Text, ...]
    rounds: int
    k: Text
    hardness: Text | None
    scale: Text | None
    law: str


@dataclass(frozen=True)
class StudyFile:
    """Contain one study; `specified` is its tree as plain texts, by which two studies are compared."""

    file: str  # "" for a mapping of Python
    title: str
    mechanism: Text
    scenes: tuple[Text, ...]
    one_scene: bool  # the file names one scene, not a list: no dimension
    choices: tuple[Choice, ...]
    fixed: Mapping[Text, Text]
    axes: tuple[Axis, ...]
    draw: Draw | None
    starts: Starts | None
    t_end: ParsedExpression | None
    output: ParsedExpression | None
    step: ParsedExpression | None
    windows: Mapping[str, Window]
    measures: tuple[Measure, ...]
    keep: tuple[Text, ...]
    method: Text
    rtol: Text | None
    stop: bool
    specified: Mapping[str, Any]
    wear: WearRounds | None = None
    left_out: tuple[Axis, ...] = ()  # dimensions of the file that `--set` replaces by one value

    def replace_perturbed_starts(self, count: int | None, seed: int | None) -> StudyFile:
        """Return the study with another count or seed of its perturbed starts; None keeps the value, also a count of 0.

        The settings as written in the file (`specified`) are changed too, for the report. A study without perturbed
        starts is returned unchanged.
        """
        changed_settings = {name: str(value) for name, value in (("count", count), ("seed", seed)) if value is not None}
        if self.starts is None or not changed_settings:
            return self
        starts = replace(self.starts, count=count or self.starts.count, seed=self.starts.seed if seed is None else seed)
        return replace(
            self, starts=starts, specified={**self.specified, "starts": self.specified["starts"] | changed_settings}
        )


@dataclass(frozen=True)
class StudySet:
    """Contain a whole study file: one study, named "", or several parts by name."""

    file: str
    title: str
    parts: Mapping[str, StudyFile]
    named: bool  # whether the file has parts
    claims: Claims
    titles: Mapping[str, str] = field(default_factory=dict)  # of names, for people
    about: tuple[str, ...] = ()  # paragraphs, for people

    def replace_perturbed_starts(self, count: int | None, seed: int | None) -> StudySet:
        """Return the studies with another count or seed of their perturbed starts; None keeps the value.

        Parts without perturbed starts stay unchanged. Raises BadValueError if a value is given and no part has any.
        """
        changed_settings = [name for name, value in (("count", count), ("seed", seed)) if value is not None]
        if changed_settings and not any(part.starts for part in self.parts.values()):
            hint = "expected starts: in the file, with the deviations of parameters"
            raise BadValueError(
                f"no run has perturbed starts, whose {' and '.join(changed_settings)} is given", None, hint
            )
        return replace(
            self, parts={name: part.replace_perturbed_starts(count, seed) for name, part in self.parts.items()}
        )
