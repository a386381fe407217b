"""What a study's file claims of its runs: published numbers and trends, still texts with places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from gudgeon.generator.yaml.tree import Text

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
