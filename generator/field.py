"""One key of a mechanism file, declared once.

The reader, `--set`, the JSON Schema and the tables of docs/format.md ask nothing else what a key may hold.
Sections are declared in generator/format/sections.py, the rest in the files of generator/kinds.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

from gudgeon.language.units import DIMENSIONLESS, FORCE, LENGTH, Dimension

# what a field is
NUMBER = "number"  # an expression with a dimension
VECTOR = "vector"  # two of them
PLACE = "place"  # a number, or two, as its key says: a coordinate, or a point
WORD = "word"  # one of `values`
FLAG = "flag"  # true or false
TEXT = "text"
RESULTS = "results"  # names of results: a list, or a text with commas between
POINTS = "points"  # a list of pairs of numbers
DEPTHS = "depths"  # a list of numbers, or how many of them are 0
NAME = "name"  # of an entry of the section `names`
BODY = "body"  # a body or the ground
CORNERS = "corners"  # three names of points of the same body
RECORD = "record"  # a mapping with the keys `fields`
MAPPING = "mapping"  # names, each with an `entry`
KINDS = "kinds"  # a mapping with one key that is a kind, and that kind's fields
LAW = "law"  # a mapping with `law:`, a kind, and that kind's fields
SCALARS = frozenset((NUMBER, WORD, FLAG, TEXT, NAME, BODY))

# what the expression of a number may use besides parameters
OF_TIME = "t"
OF_MOTION = "t, coordinates and velocities"
OF_RESULTS = "t and anything that a result has"
OF_PENETRATION = "delta"
OF_CAM_ANGLE = "phi"
CONSTANT_IN_TIME = ("", OF_PENETRATION, OF_CAM_ANGLE)  # what may not use t


RELATIONS: Mapping[str, Callable[[float, float], bool]] = {
    ">": operator.gt,
    ">=": operator.ge,
    "<": operator.lt,
    "<=": operator.le,
}


class Bound(NamedTuple):
    """A condition: `relation` to a number, or to another field of the same mapping."""

    relation: str  # ">" ">=" "<" "<="
    limit: float | str
    why: str = ""  # in a message: "a mass is positive"; {name} is the field's own. "": its meaning

    def reason(self, field: Field, owner: str) -> str:
        """What an error says of a number that breaks it."""
        return self.why.format(name=field.name) if self.why else f"{field.meaning} ({owner})"


POSITIVE = (Bound(">", 0.0, "{name} is positive"),)
NOT_NEGATIVE = (Bound(">=", 0.0, "{name} is not negative"),)


@dataclass(frozen=True)
class Kind:
    """A kind of joint, drive, force or law: what its own key lists, and the keys beside it."""

    title: str
    fields: tuple[Field, ...]
    targets: str = ""  # "points", "bodies" or "coordinates"; a law has none
    counts: tuple[int, ...] = ()  # how many targets there may be
    also: tuple[str, ...] = ()  # what others call it: told to whoever writes that
    like: str = ""  # the kind whose keys it has, but those that its name chooses


@dataclass(frozen=True)
class Field:
    """A key, what it holds, and what that means in one sentence or less."""

    name: str
    kind: str  # one of those above
    meaning: str
    dimension: Dimension | None = DIMENSIONLESS  # None: any, or another key says which
    required: bool = False
    default: float | str | bool | None = None  # what the reader fills in (SI)
    either: str = ""  # the key of which it is needed, or this one
    otherwise: str = ""  # what holds where nothing is written and nothing is filled in
    bounds: tuple[Bound, ...] = ()
    per: str = ""  # of a force by a power of a length: the key whose number is the power, and says the dimension
    varies: str = ""  # what its expression may use besides parameters
    whole: bool = False  # of a number: 1, 2, 3
    nonzero: bool = False  # of a vector: not both components zero
    values: tuple[str | bool, ...] = ()  # of a word; a flag has (False, True)
    words: tuple[str, ...] = ()  # that may stand in place of a number
    sources: Mapping[str, str] | None = None  # of words that are somebody's
    symbol: str = ""  # as in the literature, in LaTeX
    names: str = ""  # the section that a name is of
    fields: tuple[Field, ...] = ()
    entry: Field | None = None
    keys: Mapping[str, Dimension] | None = None  # of a mapping with keys BODY.key: which, and what dimension they have
    addresses: tuple[str, ...] = ()  # of a mapping whose keys are addresses: bearings.NAME.journal_material
    given: tuple[str, ...] = ()  # names of a mapping that exist without being written
    kinds: Callable[[], Mapping[str, Kind]] | None = None

    @property
    def any_dimension(self) -> bool:
        """Whether its unit is not checked."""
        return self.dimension is None

    @property
    def choice(self) -> str | bool:
        """The default of a word, a flag or a body."""
        assert isinstance(self.default, (str, bool)), self.name
        return self.default

    def below(self, name: str, node: Any = ()) -> Field | None:
        """The field of the key `name` in what stands here; `node` is that, to see its kind. None: no such key."""
        if self.kind == MAPPING:
            return self.entry
        return next((field for field in self.known(node) if field.name == name), None)

    def known(self, node: Any = ()) -> tuple[Field, ...]:
        """The keys that a mapping here may have: of the kinds that `node` names, or of all, if it names none."""
        if self.kinds is None:
            return self.fields
        kinds = self.kinds()
        chosen = [str(node["law"])] if self.kind == LAW and "law" in node else list(node)
        return tuple(f for kind in [k for k in chosen if k in kinds] or kinds for f in kinds[kind].fields)


def with_dimensions(fields: Iterable[Field], written: Mapping[str, Any]) -> list[Field]:
    """Of a field that says `per`, N/m^n: n is a number as `written`, or the default; any where a parameter says it."""
    found = list(fields)
    defaults = {own.name: str(own.default) for own in found}
    for k, own in enumerate(found):
        power = str(written.get(own.per, defaults[own.per])) if own.per else ""
        if re.fullmatch(r"\d{1,3}(\.\d{1,9}|/[1-9])?", power):
            dimension = FORCE / LENGTH ** Fraction(power)
            found[k] = replace(own, dimension=dimension if dimension.has_halves_at_most else None)
    return found


def number(name: str, meaning: str, dimension: Dimension | None, **more: Any) -> Field:
    """A number with a dimension; None: any."""
    return Field(name, NUMBER, meaning, dimension, **more)


def vector(name: str, meaning: str, dimension: Dimension | None, **more: Any) -> Field:
    """Two numbers: [x, y]."""
    return Field(name, VECTOR, meaning, dimension, **more)


def word(
    name: str, meaning: str, words: Iterable[str], default: str, sources: Mapping[str, str] | None = None
) -> Field:
    """One of some words."""
    return Field(name, WORD, meaning, values=tuple(words), default=default, sources=sources)


def flag(name: str, meaning: str) -> Field:
    """true or false, which is the default."""
    return Field(name, FLAG, meaning, values=(False, True), default=False)


def body_or_ground(name: str, meaning: str) -> Field:
    """A body, or the ground, which is the default."""
    return Field(name, BODY, meaning, default="ground")


def name_in(names: str, name: str, meaning: str, required: bool = True, either: str = "", otherwise: str = "") -> Field:
    """A name of an entry of the section `names`; where another key may stand in its place it is not `required`."""
    return Field(name, NAME, meaning, names=names, required=required, either=either, otherwise=otherwise)


def record(name: str, meaning: str, *fields: Field, required: bool = False) -> Field:
    """A mapping with known keys."""
    return Field(name, RECORD, meaning, fields=fields, required=required)


def mapping(name: str, meaning: str, entry: Field, **more: Any) -> Field:
    """Names of the user's, each with an `entry`."""
    return Field(name, MAPPING, meaning, entry=entry, **more)
